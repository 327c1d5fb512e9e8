!> The closed motion of a wall whose joints bend before they open, in the engine lanes (docs/theory.md, section 7).
!>
!> Lanes hold open walls alone. One whose joints close goes on here until they open again: over blocks of samples and single
!> samples in which nothing can happen (dondolo_motion_elastic_filter), and by series where it may. After the record the wall swings
!> freely, and its energy says whether it rises once more.
module dondolo_motion_lane_bending
   use dondolo_base_kinds, only : wp
   use dondolo_motion_bent_part, only : bent_part_type, new_bent_part, nothing, opens, passes
   use dondolo_motion_elastic_filter, only : elastic_filter_type
   use dondolo_motion_elastic_flow, only : bent_type, longest_angle
   use dondolo_motion_history, only : history_type
   use dondolo_motion_response, only : trace_type
   use dondolo_motion_tail, only : fall_time, leave, rise, tail_type, work_between
   use dondolo_motion_wall_constants, only : wall_constants_type
   use dondolo_record, only : record_type
   use dondolo_wall_elastic_joint, only : elastic_joint_type
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: bend, free_bent_motion, side_of

contains

   !> Closed motion, until the joints open or the record is over, which its interval tells
   pure subroutine bend(constants, filter, record, history, state, trace, start, without_jumps)
      !> Constants of the wall
      class(wall_constants_type), intent(in) :: constants
      !> The motion of the closed wall under the whole accelerogram
      type(elastic_filter_type), intent(in) :: filter
      type(record_type), intent(in) :: record
      !> The history: its interval and time are those of the state, peaks and passages are added
      class(history_type), intent(inout) :: history
      !> Signed rotation and its rate
      type(bent_type), intent(inout) :: state
      !> Time history, and the time at which the record begins in it [s]
      type(trace_type), intent(inout), optional :: trace
      real(wp), intent(in), optional :: start
      !> Whether to look at every sample, so that no peak below the opening is missed. No, if absent
      logical, intent(in), optional :: without_jumps

      type(bent_type) :: before
      integer :: first, sample
      logical :: is_open, jumps

      is_open = .false.
      jumps = .true.
      if (present(without_jumps)) jumps = .not. without_jumps
      do while (history%interval < size(record%acceleration))
         if (jumps .and. .not. history%time > 0.0_wp) then
            first = history%interval
            before = state
            call filter%skip(record, history%scale, history%interval, state)
            if (present(trace)) then
               do sample = first + 1, history%interval - 1
                  call add_row(trace, record, history, filter%linear_state(record, history%scale, first, before, sample), sample, &
                     & 0.0_wp, start)
               end do
               if (history%interval > first) call add_row(trace, record, history, state, history%interval, 0.0_wp, start)
            end if
            if (history%interval == size(record%acceleration)) return
         end if
         call history%count_step(constants, history%interval, record%dt)
         if (history%given_up) return
         call take_part(filter%joint, record, history, state, is_open, trace, start)
         if (is_open) return
      end do

   end subroutine bend

   !> Closed motion up to the next event, or to the end of a part of the sample interval
   pure subroutine take_part(joint, record, history, state, is_open, trace, start)
      type(elastic_joint_type), intent(in) :: joint
      type(record_type), intent(in) :: record
      class(history_type), intent(inout) :: history
      type(bent_type), intent(inout) :: state
      !> Set to true if the joints open
      logical, intent(inout) :: is_open
      type(trace_type), intent(inout), optional :: trace
      !> Time at which the record begins in the time history [s]
      real(wp), intent(in), optional :: start

      type(bent_part_type) :: part
      type(bent_type) :: next
      real(wp) :: acceleration, slope, remaining, place, top, place_of_top, begin
      integer :: parts, event

      associate (a => record%acceleration, i => history%interval)
         slope = history%scale*(a(i + 1) - a(i))/record%dt
         acceleration = history%scale*a(i) + slope*history%time
      end associate
      remaining = record%dt - history%time
      parts = max(1, ceiling(joint%frequency*remaining/longest_angle))
      remaining = remaining/real(parts, wp)
      part = new_bent_part(joint, state, acceleration, slope, remaining)
      call part%find_first(joint, state, next, event, place, top, place_of_top)
      begin = real(history%interval - 1, wp)*record%dt
      if (top > history%peak) then
         history%peak = top
         history%time_of_peak = begin + (history%time + place_of_top*remaining)
      end if
      state = next
      history%time = min(history%time + place*remaining, record%dt)
      select case (event)
      case (passes)
         history%impacts = history%impacts + 1
         if (present(trace)) call add_row(trace, record, history, state, history%interval, history%time, start)
         state%v = sign(joint%passed(abs(state%v)), state%v)
         if (present(trace)) then
            call add_row(trace, record, history, state, history%interval, history%time, start)
            if (.not. trace%lacks_memory) trace%after_impact(trace%rows) = .true.
         end if
      case (opens)
         is_open = .true.
         if (joint%opening > history%peak) then
            history%peak = joint%opening
            history%time_of_peak = begin + history%time
         end if
      end select
      if (event == nothing .and. parts == 1) history%time = record%dt
      if (history%time < record%dt) return
      history%interval = history%interval + 1
      history%time = 0.0_wp
      if (present(trace)) call add_row(trace, record, history, state, history%interval, history%time, start)

   end subroutine take_part

   !> Add a row to a time history
   pure subroutine add_row(trace, record, history, state, interval, time, start)
      type(trace_type), intent(inout) :: trace
      type(record_type), intent(in) :: record
      !> Factor on the record, and side of a wall that does not move
      class(history_type), intent(in) :: history
      !> Signed rotation and its rate
      type(bent_type), intent(in) :: state
      !> Sample interval, and time since its first sample [s]
      integer, intent(in) :: interval
      real(wp), intent(in) :: time
      !> Time at which the record begins in the time history [s]
      real(wp), intent(in) :: start

      real(wp) :: ground

      associate (a => record%acceleration)
         ground = history%scale*a(interval)
         if (time > 0.0_wp) ground = history%scale*(a(interval) + (time/record%dt)*(a(interval + 1) - a(interval)))
      end associate
      ! Adding zero makes no row show a negative zero.
      call trace%add(start + (real(interval - 1, wp)*record%dt + time), ground, state%x + 0.0_wp, state%v + 0.0_wp, &
         & side_of(state, history%side))
   end subroutine add_row

   !> Side of a state; at x = 0 that to which it moves
   elemental real(wp) function side_of(state, side) result(now)
      type(bent_type), intent(in) :: state
      !> Side if it does not move either
      real(wp), intent(in) :: side

      now = side
      if (abs(state%x) > 0.0_wp) then
         now = sign(1.0_wp, state%x)
      else if (abs(state%v) > 0.0_wp) then
         now = sign(1.0_wp, state%v)
      end if
   end function side_of

   !> The largest rotation after the end of the record, if it exceeds what was reached before
   pure subroutine free_bent_motion(mechanism, limit, reached, is_open, motion, tail)
      !> A wall with joints that bend
      class(mechanism_type), intent(in) :: mechanism
      !> Rotation that counts as collapse, and the largest so far [rad]
      real(wp), intent(in) :: limit, reached
      !> Are the joints open?
      logical, intent(in) :: is_open
      !> Rotation and its rate at the end of the record; of an open wall outwards
      type(bent_type), intent(in) :: motion
      type(tail_type), intent(out) :: tail

      type(bent_part_type) :: part
      type(bent_type) :: state, next
      real(wp) :: kinetic, energy, barrier, at_opening, duration, place, top, place_of_top
      integer :: event
      logical :: falls

      associate (joint => mechanism%joint)
         ! Energies of the open wall are those of its rigid blocks, and differ from those of the closed wall by a constant.
         at_opening = mechanism%potential(joint%opening) - 0.5_wp*joint%stiffness*joint%opening**2
         barrier = min(reached, limit, mechanism%capacity)
         if (barrier > joint%opening) then
            barrier = mechanism%potential(barrier) - at_opening
         else
            barrier = 0.5_wp*joint%stiffness*barrier**2
         end if
         state = motion
         if (is_open) then
            call leave(mechanism, limit, reached, state%x, state%v, tail, kinetic, falls)
            energy = kinetic + mechanism%potential(state%x)
            if (.not. falls .or. energy - at_opening <= barrier) return
            tail%delay = fall_time(mechanism, kinetic, state%x, joint%opening)
            kinetic = max(0.0_wp, kinetic - work_between(mechanism, state%x, joint%opening - state%x))
            state = bent_type(joint%opening, -sqrt(2.0_wp*kinetic/joint%inertia))
         end if
         duration = longest_angle/joint%frequency
         ! At its next turn a closed wall has no energy beyond the barrier.
         do while (0.5_wp*(joint%inertia*state%v**2 + joint%stiffness*state%x**2) > barrier)
            part = new_bent_part(joint, state, 0.0_wp, 0.0_wp, duration)
            call part%find_first(joint, state, next, event, place, top, place_of_top)
            if (top > reached) then
               tail%peak = top
               tail%delay = tail%delay + place_of_top*duration
            end if
            if (top > 0.0_wp) return
            tail%delay = tail%delay + place*duration
            state = next
            if (event == passes) state%v = sign(joint%passed(abs(state%v)), state%v)
            if (event /= opens) cycle
            kinetic = 0.5_wp*joint%inertia*state%v**2
            call rise(mechanism, limit, reached, joint%opening, mechanism%potential(joint%opening) + kinetic, kinetic, tail)
            return
         end do
      end associate
   end subroutine free_bent_motion

end module dondolo_motion_lane_bending
