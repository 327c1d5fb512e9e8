!> The motion of a wall whose joints bend before they open (docs/theory.md, section 7): closed in closed form, sample by sample,
!> open by the adaptive steps of the engine rk45.
!>
!> Events are known beforehand, and none has a memory: the joints open where |x| grows beyond q_y and close where q falls to it; a
!> passage of x = 0 faster than v_y loses speed. The wall is never at rest, so that there are no chains of bounces.
module dondolo_motion_elastic_motion
   use, intrinsic :: iso_c_binding, only : c_int
   use dondolo_base_interrupt, only : look_for_interrupt
   use dondolo_base_invariant, only : assert, checked
   use dondolo_base_kinds, only : wp
   use dondolo_motion_adaptive_step, only : advance, motion_type
   use dondolo_motion_dormand_prince, only : angular_acceleration
   use dondolo_motion_elastic_filter, only : elastic_filter_type, new_elastic_filter
   use dondolo_motion_elastic_flow, only : at_level, at_turn, bent_type, elastic_flow_type, longest_angle, new_elastic_flow
   use dondolo_motion_events, only : level_below, limit_reached
   use dondolo_motion_initial_state, only : initial_state_type
   use dondolo_motion_interval, only : add_row, enter_interval, next_interval, set_peak
   use dondolo_motion_response, only : intervals_after, response_type, trace_type
   use dondolo_motion_solver, only : solver_type
   use dondolo_motion_wall_constants, only : new_wall_constants, wall_constants_type
   use dondolo_motion_work, only : work_type
   use dondolo_record, only : record_type
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: simulate_elastic, simulate_filtered

   !> Time after the record at which a history that may still have a new peak is given up [s]: free motion comes back sooner
   real(wp), parameter :: longest_tail = 200.0_wp

   !> What the closed motion meets
   integer, parameter :: nothing = 0, opens = 1, passes = 2, turns = 3

contains

   !> The motion of a wall under an accelerogram; arguments as of `simulate_rk45`
   subroutine simulate_elastic(mechanism, record, scale, solver, response, trace, initial, work)
      !> A wall with joints that bend
      class(mechanism_type), intent(in) :: mechanism
      type(record_type), intent(in) :: record
      !> Factor on it, negative to reverse its polarity
      real(wp), intent(in) :: scale
      !> Tolerances and limit
      type(solver_type), intent(in) :: solver
      type(response_type), intent(out) :: response
      !> Time history, until 10 s past the end of the record; computed only if present
      type(trace_type), intent(inout), optional :: trace
      !> Rotation and velocity at the start; absent: at rest
      type(initial_state_type), intent(in), optional :: initial
      !> Counts, added to
      type(work_type), intent(inout), optional :: work

      type(wall_constants_type) :: constants
      type(motion_type) :: motion
      type(elastic_filter_type) :: filter
      logical :: starts

      starts = .false.
      if (present(initial)) starts = initial%moves()
      if (.not. (starts .or. present(trace))) then
         filter = new_elastic_filter(mechanism%joint, record)
         call simulate_filtered(mechanism, filter, record, scale, solver, response, work)
         return
      end if
      call begin(mechanism, record, scale, solver, constants, motion)
      if (starts) then
         motion%side = initial%side()
         motion%q = abs(initial%rotation)
         motion%v = motion%side*initial%velocity
         motion%peak = motion%q
      end if
      if (present(trace)) call add_row(motion, record, trace)
      call follow(mechanism, constants, record, motion, trace)
      call finish(constants, record, motion, response, work)
      if (present(trace)) then
         trace%is_whole = .not. motion%given_up
         call trace%trim_rows()
         if (.not. allocated(trace%ties)) allocate (trace%ties(0))
      end if
   end subroutine simulate_elastic

   !> The motion of a wall at rest under an accelerogram whose filter is known
   subroutine simulate_filtered(mechanism, filter, record, scale, solver, response, work)
      !> A wall with joints that bend
      class(mechanism_type), intent(in) :: mechanism
      !> Its motion while they are closed
      type(elastic_filter_type), intent(in) :: filter
      type(record_type), intent(in) :: record
      !> Factor on it, negative to reverse its polarity
      real(wp), intent(in) :: scale
      !> Tolerances and limit
      type(solver_type), intent(in) :: solver
      type(response_type), intent(out) :: response
      !> Counts, added to
      type(work_type), intent(inout), optional :: work

      type(wall_constants_type) :: constants
      type(motion_type) :: motion

      call begin(mechanism, record, scale, solver, constants, motion)
      if (filter%is_whole_motion(scale)) then
         motion%peak = abs(scale)*filter%peak
         motion%time_of_peak = filter%time_of_peak
      else
         call follow(mechanism, constants, record, motion, filter=filter)
         if (.not. (motion%given_up .or. motion%peak > motion%closing)) then
            ! It never opened. Jumps passed over its peak, which is where nothing else happened.
            call begin(mechanism, record, scale, solver, constants, motion)
            call follow(mechanism, constants, record, motion)
         end if
      end if
      call finish(constants, record, motion, response, work)
   end subroutine simulate_filtered

   !> Constants of a wall, and its motion before the accelerogram
   subroutine begin(mechanism, record, scale, solver, constants, motion)
      class(mechanism_type), intent(in) :: mechanism
      type(record_type), intent(in) :: record
      !> Factor on it
      real(wp), intent(in) :: scale
      !> Tolerances and limit
      type(solver_type), intent(in) :: solver
      type(wall_constants_type), intent(out) :: constants
      type(motion_type), intent(out) :: motion

      constants = new_wall_constants(mechanism, solver)
      constants%fastest = max(constants%fastest, mechanism%joint%frequency)
      motion%scale = scale
      motion%step = record%dt
      motion%closing = mechanism%joint%opening
   end subroutine begin

   !> Result and counts of a motion
   subroutine finish(constants, record, motion, response, work)
      type(wall_constants_type), intent(in) :: constants
      type(record_type), intent(in) :: record
      type(motion_type), intent(inout) :: motion
      type(response_type), intent(out) :: response
      type(work_type), intent(inout), optional :: work

      call motion%finish(constants, record, response, work)
      if (.not. present(work)) return
      work%steps = work%steps + motion%steps
      work%evaluations = work%evaluations + motion%evaluations
   end subroutine finish

   !> Follow a motion until no new peak may come, or as far as its time history goes
   subroutine follow(mechanism, constants, record, motion, trace, filter)
      class(mechanism_type), intent(in) :: mechanism
      type(wall_constants_type), intent(in) :: constants
      type(record_type), intent(in) :: record
      type(motion_type), intent(inout) :: motion
      type(trace_type), intent(inout), optional :: trace
      !> Its motion while the joints are closed, of a wall that begins at rest and has no time history
      type(elastic_filter_type), intent(in), optional :: filter

      logical :: is_open
      integer(c_int) :: interrupted
      integer :: last, shown

      last = size(record%acceleration) - 1
      shown = last
      if (present(trace)) shown = last + intervals_after(record%dt)
      is_open = motion%q > motion%closing
      if (is_open) call open(mechanism, constants, record, motion, trace)
      do
         call look_for_interrupt(interrupted)
         if (present(trace)) interrupted = merge(1_c_int, interrupted, trace%lacks_memory)
         if (interrupted == 1 .or. motion%given_up) exit
         if (motion%interval > last) then
            if (motion%interval > shown .and. .not. may_rise(mechanism, constants, motion, is_open)) exit
            motion%given_up = real(motion%interval - last, wp)*record%dt > longest_tail
            if (motion%given_up) exit
         end if
         if (is_open) then
            call rock(mechanism, constants, record, max(last, motion%interval), motion, is_open, trace)
            if (motion%collapsed) exit
         else
            call bend(mechanism, constants, record, motion, is_open, trace, filter)
            if (is_open) call open(mechanism, constants, record, motion, trace)
         end if
      end do
      if (is_open) call motion%end_rocking(record)
   end subroutine follow

   !> Whether a wall on ground that is still may rise beyond its peak: its energy only falls
   pure logical function may_rise(mechanism, constants, motion, is_open)
      class(mechanism_type), intent(in) :: mechanism
      type(wall_constants_type), intent(in) :: constants
      type(motion_type), intent(in) :: motion
      !> Are the joints open?
      logical, intent(in) :: is_open

      real(wp) :: barrier, energy, j, c, g, l, load

      may_rise = motion%peak < constants%limit
      if (.not. may_rise) return
      associate (joint => mechanism%joint)
         barrier = min(motion%peak, constants%capacity)
         if (barrier <= joint%opening) then
            barrier = 0.5_wp*joint%stiffness*barrier**2
         else
            barrier = 0.5_wp*joint%stiffness*joint%opening**2 + mechanism%potential(barrier) - mechanism%potential(joint%opening)
         end if
         if (is_open) then
            if (motion%q > constants%capacity) return
            call mechanism%terms(motion%q, j, c, g, l, load)
            energy = 0.5_wp*j*motion%v**2 + 0.5_wp*joint%stiffness*joint%opening**2 + mechanism%potential(motion%q) &
               & - mechanism%potential(joint%opening)
         else
            energy = 0.5_wp*joint%inertia*motion%v**2 + 0.5_wp*joint%stiffness*motion%q**2
         end if
      end associate
      may_rise = energy > barrier
   end function may_rise

   !> The joints open: rocking begins
   pure subroutine open(mechanism, constants, record, motion, trace)
      class(mechanism_type), intent(in) :: mechanism
      type(wall_constants_type), intent(in) :: constants
      type(record_type), intent(in) :: record
      type(motion_type), intent(inout) :: motion
      type(trace_type), intent(inout), optional :: trace

      call motion%begin_rocking()
      call enter_interval(constants, record, motion)
      motion%f = angular_acceleration(mechanism, motion%excitation, motion%time, motion%q, motion%v)
      if (.not. present(trace)) return
      if (trace%every_step) call add_row(motion, record, trace)
   end subroutine open

   !> Rocking, until the joints close, collapse, or the end of the last interval
   pure subroutine rock(mechanism, constants, record, last, motion, is_open, trace)
      class(mechanism_type), intent(in) :: mechanism
      type(wall_constants_type), intent(in) :: constants
      type(record_type), intent(in) :: record
      !> Last interval to go through; beyond the record the ground is still
      integer, intent(in) :: last
      type(motion_type), intent(inout) :: motion
      !> Set to false if the joints close
      logical, intent(inout) :: is_open
      type(trace_type), intent(inout), optional :: trace

      integer :: event
      logical :: sample_reached, every_step

      every_step = .false.
      if (present(trace)) every_step = trace%every_step
      do while (motion%interval <= last)
         call motion%count_step(constants, motion%interval, record%dt)
         if (motion%given_up) return
         call advance(mechanism, constants, record%dt, motion, event, sample_reached)
         if (event == limit_reached) then
            motion%collapsed = .true.
            motion%q = constants%limit
            call set_peak(motion, record)
            if (present(trace)) call add_row(motion, record, trace)
            return
         end if
         if (motion%q > motion%peak) call set_peak(motion, record)
         ! A step too short to look for events may end below the level.
         is_open = .not. (event == level_below .or. (motion%q <= motion%closing .and. motion%v <= 0.0_wp))
         if (.not. is_open) motion%q = min(max(motion%q, 0.0_wp), motion%closing)
         if (every_step .and. .not. sample_reached) call add_row(motion, record, trace)
         if (.not. is_open) call motion%end_rocking(record)
         if (sample_reached) call next_interval(constants, record, motion, trace)
         if (.not. is_open) return
      end do
   end subroutine rock

   !> Bending, until the joints open or the end of the record; after it one interval
   pure subroutine bend(mechanism, constants, record, motion, is_open, trace, filter)
      class(mechanism_type), intent(in) :: mechanism
      type(wall_constants_type), intent(in) :: constants
      type(record_type), intent(in) :: record
      type(motion_type), intent(inout) :: motion
      !> Set to true if the joints open
      logical, intent(inout) :: is_open
      type(trace_type), intent(inout), optional :: trace
      !> The motion while the joints are closed, by which parts of it are jumped over
      type(elastic_filter_type), intent(in), optional :: filter

      type(elastic_flow_type) :: flow
      type(bent_type) :: here, next
      real(wp) :: slope, acceleration, from, to, step, time
      integer :: parts, part, event, last
      logical :: looks

      here = bent_type(motion%side*motion%q, motion%side*motion%v)
      last = max(size(record%acceleration) - 1, motion%interval)
      looks = present(filter)
      do while (motion%interval <= last)
         if (looks .and. motion%interval < size(record%acceleration) .and. .not. motion%time > 0.0_wp) then
            call filter%jump(record, motion%scale, motion%interval, here)
            call show(here, motion)
            looks = .false.
            if (motion%interval > last) return
         end if
         call motion%count_step(constants, motion%interval, record%dt)
         if (motion%given_up) return
         acceleration = 0.0_wp
         slope = 0.0_wp
         associate (a => record%acceleration, i => motion%interval)
            if (i < size(a)) then
               slope = motion%scale*(a(i + 1) - a(i))/record%dt
               acceleration = motion%scale*a(i) + slope*motion%time
            end if
         end associate
         flow = new_elastic_flow(mechanism%joint, here, acceleration, slope)
         parts = max(1, ceiling(mechanism%joint%frequency*(record%dt - motion%time)/longest_angle))
         step = (record%dt - motion%time)/real(parts, wp)
         event = nothing
         to = 0.0_wp
         do part = 1, parts
            from = to
            to = step*real(part, wp)
            next = flow%at(to)
            call find_first(mechanism, flow, motion%peak, [from, to], here, next, event, time)
            if (event /= nothing) exit
            here = next
            if (present(trace) .and. part < parts) call show_part(here, to, record, motion, trace)
         end do
         if (event == nothing) then
            call show(here, motion)
            call next_interval(constants, record, motion, trace)
            if (present(filter)) looks = looks .or. filter%begins_block(motion%interval)
            cycle
         end if
         next = flow%at(time)
         motion%time = min(motion%time + time, record%dt)
         select case (event)
         case (opens)
            next%x = sign(motion%closing, next%v)
            is_open = .true.
         case (passes)
            next%x = 0.0_wp
         case (turns)
            next%v = 0.0_wp
         end select
         here = next
         call show(here, motion)
         if (motion%q > motion%peak) call set_peak(motion, record)
         if (is_open) return
         looks = present(filter)
         if (event == passes) call lose(mechanism, record, here, motion, trace)
      end do
   end subroutine bend

   !> Add the end of a part of the closed motion to a time history that has every step
   pure subroutine show_part(state, passed, record, motion, trace)
      !> State then
      type(bent_type), intent(in) :: state
      !> Time since the motion began in this interval [s]
      real(wp), intent(in) :: passed
      type(record_type), intent(in) :: record
      !> The history
      type(motion_type), intent(in) :: motion
      type(trace_type), intent(inout) :: trace

      type(motion_type) :: shown

      if (.not. trace%every_step) return
      shown = motion
      shown%time = motion%time + passed
      call show(state, shown)
      call add_row(shown, record, trace)
   end subroutine show_part

   !> A passage of x = 0 that loses speed
   pure subroutine lose(mechanism, record, state, motion, trace)
      class(mechanism_type), intent(in) :: mechanism
      type(record_type), intent(in) :: record
      !> State before and after it
      type(bent_type), intent(inout) :: state
      type(motion_type), intent(inout) :: motion
      type(trace_type), intent(inout), optional :: trace

      if (motion%interval < size(record%acceleration)) motion%impacts = motion%impacts + 1
      if (present(trace)) call add_row(motion, record, trace)
      state%v = sign(mechanism%joint%passed(abs(state%v)), state%v)
      call show(state, motion)
      if (.not. present(trace)) return
      call add_row(motion, record, trace)
      if (.not. trace%lacks_memory) trace%after_impact(trace%rows) = .true.
   end subroutine lose

   !> Say a signed state as side, rotation and velocity outwards
   pure subroutine show(state, motion)
      type(bent_type), intent(in) :: state
      type(motion_type), intent(inout) :: motion

      if (abs(state%x) > 0.0_wp) then
         motion%side = sign(1.0_wp, state%x)
      else if (abs(state%v) > 0.0_wp) then
         motion%side = sign(1.0_wp, state%v)
      end if
      motion%q = abs(state%x)
      motion%v = motion%side*state%v
   end subroutine show

   !> The first event in a part of the closed motion that turns once at most
   pure subroutine find_first(mechanism, flow, peak, times, here, next, event, time)
      class(mechanism_type), intent(in) :: mechanism
      type(elastic_flow_type), intent(in) :: flow
      !> Largest rotation so far: turns below it are not looked for [rad]
      real(wp), intent(in) :: peak
      !> Begin and end of the part [s], and the states there
      real(wp), intent(in) :: times(2)
      type(bent_type), intent(in) :: here, next
      !> The event, `nothing` if there is none, and its time [s]
      integer, intent(out) :: event
      real(wp), intent(out) :: time

      type(bent_type) :: top
      real(wp) :: turn

      if (.not. here%v*next%v < 0.0_wp) then
         call find_in_way(mechanism, flow, times, here, next, event, time)
         return
      end if
      turn = flow%time_of(at_turn, 0.0_wp, sign(1.0_wp, next%v), times(1), times(2))
      top = flow%at(turn)
      call find_in_way(mechanism, flow, [times(1), turn], here, top, event, time)
      if (event /= nothing) return
      ! One at the very begin is where the last event was.
      if (abs(top%x) > peak .and. turn > times(1)) then
         event = turns
         time = turn
         return
      end if
      call find_in_way(mechanism, flow, [turn, times(2)], top, next, event, time)
   end subroutine find_first

   !> The first event on a way without a turn
   pure subroutine find_in_way(mechanism, flow, times, here, next, event, time)
      class(mechanism_type), intent(in) :: mechanism
      type(elastic_flow_type), intent(in) :: flow
      !> Begin and end of the way [s], and the states there
      real(wp), intent(in) :: times(2)
      type(bent_type), intent(in) :: here, next
      !> The event, `nothing` if there is none, and its time [s]
      integer, intent(out) :: event
      real(wp), intent(out) :: time

      type(bent_type) :: middle
      real(wp) :: sense

      if (checked) call assert(times(2) >= times(1), 'a way ends after it begins')
      event = nothing
      time = times(2)
      sense = sign(1.0_wp, next%x - here%x)
      if (sense*here%x < 0.0_wp .and. .not. sense*next%x < 0.0_wp) then
         time = flow%time_of(at_level, 0.0_wp, sense, times(1), times(2))
         middle = flow%at(time)
         if (abs(middle%v) > mechanism%joint%speed) then
            event = passes
            return
         end if
         time = times(2)
      end if
      if (sense*next%x >= mechanism%joint%opening) then
         event = opens
         time = flow%time_of(at_level, sense*mechanism%joint%opening, sense, times(1), times(2))
      end if
   end subroutine find_in_way

end module dondolo_motion_elastic_motion
