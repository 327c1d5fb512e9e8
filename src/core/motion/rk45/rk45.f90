!> The engine rk45: the hybrid motion of one wall under one accelerogram, by adaptive Dormand-Prince steps.
!>
!> At rest, rocking, collapsed (docs/theory.md, section 4). No step crosses a sample, where the piecewise linear
!> accelerogram has its corners.
module dondolo_motion_rk45
   use, intrinsic :: iso_c_binding, only : c_int
   use dondolo_base_interrupt, only : look_for_interrupt
   use dondolo_base_invariant, only : assert, checked
   use dondolo_base_kinds, only : wp
   use dondolo_motion_adaptive_step, only : advance, motion_type
   use dondolo_motion_dormand_prince, only : angular_acceleration
   use dondolo_motion_events, only : impact, level_above, level_below, limit_reached, no_event, turning
   use dondolo_motion_history, only : starting_acceleration
   use dondolo_motion_initial_state, only : initial_state_type
   use dondolo_motion_interval, only : add_row, aim, enter_interval, next_interval, set_peak, time_of
   use dondolo_motion_response, only : intervals_after, response_type, trace_type
   use dondolo_motion_rest, only : new_rest
   use dondolo_motion_restrained_tail, only : restrained_motion
   use dondolo_motion_restraint_state, only : restraint_state_type
   use dondolo_motion_solver, only : solver_type
   use dondolo_motion_stick, only : look_for_stick, stay
   use dondolo_motion_tail, only : tail_type
   use dondolo_motion_wall_constants, only : new_wall_constants, wall_constants_type
   use dondolo_motion_work, only : work_type
   use dondolo_record, only : record_type
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: simulate_rk45

   !> How rocking ends; `broken_off` leaves no result
   integer, parameter :: at_rest = 1, collapsed = 2, record_over = 3, broken_off = 4

contains

   !> The motion of a wall under an accelerogram
   subroutine simulate_rk45(mechanism, record, scale, solver, response, trace, initial, work)
      class(mechanism_type), intent(in) :: mechanism
      type(record_type), intent(in) :: record
      !> Factor on it, negative to reverse its polarity
      real(wp), intent(in) :: scale
      !> Tolerances and limit
      type(solver_type), intent(in) :: solver
      type(response_type), intent(out) :: response
      !> Time history, until rest or 10 s past the end of the record; computed only if present
      type(trace_type), intent(inout), optional :: trace
      !> Rotation and velocity at the start, which `check_initial_state` has passed; absent: at rest
      type(initial_state_type), intent(in), optional :: initial
      !> Counts, added to
      type(work_type), intent(inout), optional :: work

      class(mechanism_type), allocatable :: wall
      type(wall_constants_type) :: constants
      type(motion_type) :: motion
      integer :: last, ending

      ! A copy, whose ties and speed ratio change in the course of the history
      allocate (wall, source=mechanism)
      constants = new_wall_constants(wall, solver)
      motion%scale = scale
      motion%step = record%dt
      last = size(record%acceleration) - 1
      ending = at_rest
      if (present(initial)) then
         if (initial%moves()) then
            ending = record_over
            motion%side = initial%side()
            motion%q = abs(initial%rotation)
            motion%v = motion%side*initial%velocity
         end if
      end if
      motion%peak = motion%q
      ! The mirror image of the motion of a wall that is the same to both sides is the same motion.
      call wall%scatter%begin(record%name, scale < 0.0_wp .and. .not. wall%is_symmetric())
      call wall%scatter%draw(wall%restitution)
      call motion%restraints%begin(wall, motion%q)
      if (motion%restraints%exists) call wall%set_restraints(motion%restraints%force, motion%restraints%stiffness)
      if (present(trace)) call add_row(motion, record, trace)

      do
         if (ending == at_rest) then
            call wait(constants, record, last, motion, ending, trace)
            if (ending == at_rest) exit
         end if
         call motion%begin_rocking()
         call face_ties(wall, motion)
         call rock(wall, constants, record, last, motion, ending, trace)
         call motion%end_rocking(record)
         if (ending /= at_rest) exit
         call cross_edge(record, motion, trace)
      end do

      motion%collapsed = ending == collapsed
      if (motion%restraints%exists) then
         call finish_ties(wall, constants, record, ending == record_over, motion, trace)
      else if (ending == record_over) then
         call motion%add_free_motion(wall, record, constants%limit, motion%q, motion%v, wall%restitution)
      end if
      call motion%finish(constants, record, response, work)
      if (present(work)) then
         work%steps = work%steps + motion%steps
         work%evaluations = work%evaluations + motion%evaluations
      end if
      if (present(trace)) then
         if (ending == record_over) then
            last = last + intervals_after(record%dt)
            call rock(wall, constants, record, last, motion, ending, trace)
         end if
         trace%is_whole = .not. motion%given_up
         call trace%trim_rows()
         if (.not. allocated(trace%ties)) allocate (trace%ties(0))
      end if
   end subroutine simulate_rk45

   !> At rest: go to the instant at which rocking begins
   pure subroutine wait(constants, record, last, motion, ending, trace)
      !> Constants of the wall
      type(wall_constants_type), intent(in) :: constants
      type(record_type), intent(in) :: record
      !> Last sample interval of the record
      integer, intent(in) :: last
      type(motion_type), intent(inout) :: motion
      !> `at_rest` if it stays so, 0 if rocking begins
      integer, intent(out) :: ending
      type(trace_type), intent(inout), optional :: trace

      real(wp) :: side
      integer :: from, i
      logical :: found

      motion%q = 0.0_wp
      motion%v = 0.0_wp
      ending = at_rest
      if (motion%interval > last) return
      from = motion%interval
      side = motion%side
      call constants%rest%next_start(record, motion%scale, motion%interval, motion%time, motion%side, found)
      if (found) ending = 0
      if (.not. present(trace)) return
      i = merge(motion%interval, last + 1, found)
      do from = from + 1, i
         call trace%add(real(from - 1, wp)*record%dt, motion%scale*record%acceleration(from), 0.0_wp, 0.0_wp, side)
      end do
   end subroutine wait

   !> Add the free motion after the record of a wall with ties, and say what the history did to them
   subroutine finish_ties(wall, constants, record, still_rocks, motion, trace)
      !> The wall as its ties hold it
      class(mechanism_type), intent(in) :: wall
      !> Its constants
      type(wall_constants_type), intent(in) :: constants
      type(record_type), intent(in) :: record
      !> Does it rock when the record ends?
      logical, intent(in) :: still_rocks
      !> The history; its peak is that of all times afterwards
      type(motion_type), intent(inout) :: motion
      !> Gets what it did to each of the ties
      type(trace_type), intent(inout), optional :: trace

      class(mechanism_type), allocatable :: after
      type(restraint_state_type) :: restraints
      type(tail_type) :: tail

      ! Copies: a trace goes on from the end of the record.
      restraints = motion%restraints
      if (still_rocks) then
         allocate (after, source=wall)
         call restrained_motion(after, restraints, constants%limit, motion%q, motion%v, record%duration(), tail)
         call motion%take_tail(tail, record)
      end if
      if (present(trace)) call restraints%responses(wall, motion%peak, trace%ties)
   end subroutine finish_ties

   !> Rocking, until rest, collapse, or the end of the last interval
   pure subroutine rock(wall, constants, record, last, motion, ending, trace)
      !> The wall; its ties change
      class(mechanism_type), intent(inout) :: wall
      !> Constants of the wall; how it rests changes with its ties
      type(wall_constants_type), intent(inout) :: constants
      type(record_type), intent(in) :: record
      !> Last interval to go through; beyond the record the ground is still
      integer, intent(in) :: last
      type(motion_type), intent(inout) :: motion
      !> How it ends
      integer, intent(out) :: ending
      type(trace_type), intent(inout), optional :: trace

      logical :: sample_reached, every_step
      integer :: event
      integer(c_int) :: interrupted
      real(wp) :: before

      every_step = .false.
      if (present(trace)) every_step = trace%every_step
      call enter_interval(constants, record, motion)
      motion%f = starting_acceleration(motion%q, motion%v, &
         & angular_acceleration(wall, motion%excitation, motion%time, motion%q, motion%v))
      ending = 0
      if (every_step) call add_row(motion, record, trace)
      do while (motion%interval <= last)
         call look_for_interrupt(interrupted)
         if (present(trace)) interrupted = merge(1_c_int, interrupted, trace%lacks_memory)
         call motion%count_step(constants, motion%interval, record%dt)
         if (interrupted == 1 .or. motion%given_up) then
            ending = broken_off
            return
         end if
         if (checked) before = time_of(motion, record)
         if (motion%sticks) then
            event = no_event
            call stay(wall, constants%solver%steps_per_sample, record%dt, motion, sample_reached)
         else
            call advance(wall, constants, record%dt, motion, event, sample_reached)
         end if
         if (checked) call assert(time_of(motion, record) >= before, 'time does not go back')
         select case (event)
         case (impact)
            call bounce(wall, constants, record, motion, ending, trace)
         case (limit_reached)
            ending = collapsed
            motion%q = constants%limit
            call set_peak(motion, record)
            if (present(trace)) call add_row(motion, record, trace)
         case default
            if (motion%q > motion%peak) call set_peak(motion, record)
            if (motion%restraints%exists) call change_ties(wall, record, event, motion)
            if (every_step .and. .not. sample_reached) call add_row(motion, record, trace)
         end select
         if (sample_reached) then
            if (ending == collapsed) return
            call next_interval(constants, record, motion, trace)
         end if
         if (ending /= 0) return
      end do
      ending = record_over
   end subroutine rock

   !> Change the forces of the ties where that is due
   pure subroutine change_ties(wall, record, event, motion)
      !> The wall
      class(mechanism_type), intent(inout) :: wall
      type(record_type), intent(in) :: record
      !> The event that the last step ended on
      integer, intent(in) :: event
      type(motion_type), intent(inout) :: motion

      select case (event)
      case (level_above, level_below)
         call motion%restraints%cross(wall, motion%q, event == level_above, time_of(motion, record))
         ! A motion outwards that ends just there goes back without what flows.
         if (motion%restraints%flows .and. motion%v < 0.0_wp) call motion%restraints%turn(wall, outwards(wall, motion))
         call wall%set_restraints(motion%restraints%force, motion%restraints%stiffness)
      case default
         ! A tie flows outwards only; rounding may end such a motion unseen.
         if (.not. (event == turning .or. (motion%restraints%flows .and. motion%v < 0.0_wp))) return
         call motion%restraints%turn(wall, outwards(wall, motion))
         call wall%set_restraints(motion%restraints%force, motion%restraints%stiffness)
         ! Not where a motion inwards has ended: it goes on outwards until it is where friction has not been overcome before.
         if (event == turning .and. .not. motion%f > 0.0_wp .and. wall%has_friction()) call look_for_stick(wall, motion)
      end select
      motion%f = angular_acceleration(wall, motion%excitation, motion%time, motion%q, motion%v)
   end subroutine change_ties

   !> Leave the edge of the trigger, where rounding undid a start at once
   pure subroutine cross_edge(record, motion, trace)
      type(record_type), intent(in) :: record
      !> The motion: at rest
      type(motion_type), intent(inout) :: motion
      type(trace_type), intent(inout), optional :: trace

      integer :: interval

      interval = motion%interval
      call motion%leave_edge(record)
      if (present(trace) .and. motion%interval > interval) call add_row(motion, record, trace)
   end subroutine cross_edge

   !> An impact: lose speed, change side, and see whether the wall comes to rest
   pure subroutine bounce(wall, constants, record, motion, ending, trace)
      !> The wall; its ties and its speed ratio change
      class(mechanism_type), intent(inout) :: wall
      !> Constants of the wall; how it rests changes with its ties
      type(wall_constants_type), intent(inout) :: constants
      type(record_type), intent(in) :: record
      type(motion_type), intent(inout) :: motion
      !> `at_rest` if it comes to rest, else 0
      integer, intent(out) :: ending
      type(trace_type), intent(inout), optional :: trace

      real(wp) :: v
      logical :: rests

      motion%v = min(motion%v, 0.0_wp)
      if (present(trace)) call add_row(motion, record, trace)
      if (motion%restraints%exists) call strike_ties(wall, constants, motion)
      v = motion%v
      call motion%strike(constants%rest, wall%restitution, record, motion%excitation%start + motion%excitation%slope*motion%time, &
         & v, 1.0_wp, rests)
      call face_ties(wall, motion)
      call wall%scatter%draw(wall%restitution)
      motion%v = v
      ending = merge(at_rest, 0, rests)
      call aim(constants%gravity, record, motion)
      if (present(trace)) then
         call add_row(motion, record, trace)
         if (.not. trace%lacks_memory) trace%after_impact(trace%rows) = .true.
      end if
      motion%f = angular_acceleration(wall, motion%excitation, motion%time, motion%q, motion%v)
   end subroutine bounce

   !> Give the ties of a wall that rocks to both sides the forces that they have on its side
   pure subroutine face_ties(wall, motion)
      !> The wall
      class(mechanism_type), intent(inout) :: wall
      type(motion_type), intent(inout) :: motion

      if (.not. (motion%restraints%exists .and. wall%two_sided)) return
      call motion%restraints%face(wall, motion%side)
      call wall%set_restraints(motion%restraints%force, motion%restraints%stiffness)
   end subroutine face_ties

   !> Largest rotation outwards, where a motion outwards has ended: the peak of a wall that rocks to both sides may be inwards
   pure real(wp) function outwards(wall, motion)
      class(mechanism_type), intent(in) :: wall
      type(motion_type), intent(in) :: motion

      outwards = merge(motion%q, motion%peak, wall%two_sided)
   end function outwards

   !> Ties at an impact: those that have stretched are slack, and the wall rests in another way than before
   pure subroutine strike_ties(wall, constants, motion)
      !> The wall
      class(mechanism_type), intent(inout) :: wall
      !> Its constants
      type(wall_constants_type), intent(inout) :: constants
      type(motion_type), intent(inout) :: motion

      logical :: changed

      if (motion%restraints%flows) call motion%restraints%turn(wall, outwards(wall, motion))
      changed = motion%restraints%changed
      call motion%restraints%strike(wall)
      call wall%set_restraints(motion%restraints%force, motion%restraints%stiffness)
      if (changed) constants%rest = new_rest(wall)
   end subroutine strike_ties

end module dondolo_motion_rk45
