!> The engine rk45: the hybrid motion of one wall under one accelerogram, by adaptive Dormand-Prince steps.
!>
!> At rest, rocking, collapsed (docs/theory.md, section 4). No step crosses a sample, where the piecewise linear
!> accelerogram has its corners.
module dondolo_rk45
   use, intrinsic :: iso_c_binding, only : c_int
   use dondolo_adaptive_step, only : advance, motion_type
   use dondolo_dormand_prince, only : angular_acceleration, excitation_type
   use dondolo_events, only : impact, limit_reached
   use dondolo_history, only : starting_acceleration
   use dondolo_interrupt, only : look_for_interrupt
   use dondolo_kinds, only : wp
   use dondolo_mechanism, only : mechanism_type
   use dondolo_record, only : record_type
   use dondolo_response, only : response_type, trace_type
   use dondolo_solver, only : solver_type
   use dondolo_step_limits, only : longest_step
   use dondolo_wall_constants, only : new_wall_constants, wall_constants_type
   use dondolo_work, only : work_type
   implicit none
   private

   public :: simulate_rk45

   !> How rocking ends; `broken_off` leaves no result
   integer, parameter :: at_rest = 1, collapsed = 2, record_over = 3, broken_off = 4

   !> Time after the record for which a trace goes on [s], and most sample intervals of it: a time step may be tiny
   real(wp), parameter :: trace_after = 10.0_wp, most_after = 1.0e5_wp

contains

   !> The motion of a wall under an accelerogram
   pure subroutine simulate_rk45(mechanism, record, scale, solver, response, trace, release, work)
      class(mechanism_type), intent(in) :: mechanism
      type(record_type), intent(in) :: record
      !> Factor on it, negative to reverse its polarity
      real(wp), intent(in) :: scale
      !> Tolerances and limit
      type(solver_type), intent(in) :: solver
      type(response_type), intent(out) :: response
      !> Time history, until rest or 10 s past the end of the record; computed only if present
      type(trace_type), intent(inout), optional :: trace
      !> Rotation from which the wall is released at the start, less than the limit [rad]; absent: it starts at rest
      real(wp), intent(in), optional :: release
      !> Counts, added to
      type(work_type), intent(inout), optional :: work

      type(wall_constants_type) :: constants
      type(motion_type) :: motion
      integer :: last, ending

      constants = new_wall_constants(mechanism, solver)
      motion%scale = scale
      motion%step = record%dt
      last = size(record%acceleration) - 1
      if (present(release)) motion%q = release
      motion%peak = motion%q
      if (present(trace)) call add_row(motion, record, trace)

      ending = merge(record_over, at_rest, motion%q > 0.0_wp)
      do
         if (ending == at_rest) then
            call wait(constants, record, last, motion, ending, trace)
            if (ending == at_rest) exit
         end if
         call motion%begin_rocking()
         call rock(mechanism, constants, record, last, motion, ending, trace)
         call motion%end_rocking(record)
         if (ending /= at_rest) exit
         call cross_edge(record, motion, trace)
      end do

      motion%collapsed = ending == collapsed
      if (ending == record_over) call motion%add_free_motion(mechanism, record, constants%limit, motion%q, motion%v)
      call motion%finish(constants, record, response, work)
      if (present(work)) then
         work%steps = work%steps + motion%steps
         work%evaluations = work%evaluations + motion%evaluations
      end if
      if (present(trace)) then
         if (ending == record_over) then
            last = last + ceiling(min(trace_after/record%dt, most_after))
            call rock(mechanism, constants, record, last, motion, ending, trace)
         end if
         call trace%trim_rows()
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

   !> Rocking, until rest, collapse, or the end of the last interval
   pure subroutine rock(mechanism, constants, record, last, motion, ending, trace)
      class(mechanism_type), intent(in) :: mechanism
      !> Constants of the wall
      type(wall_constants_type), intent(in) :: constants
      type(record_type), intent(in) :: record
      !> Last interval to go through; beyond the record the ground is still
      integer, intent(in) :: last
      type(motion_type), intent(inout) :: motion
      !> How it ends
      integer, intent(out) :: ending
      type(trace_type), intent(inout), optional :: trace

      logical :: sample_reached
      integer :: event
      integer(c_int) :: interrupted

      call enter_interval(constants%solver, record, motion)
      motion%f = starting_acceleration(motion%q, motion%v, &
         & angular_acceleration(mechanism, motion%excitation, motion%time, motion%q, motion%v))
      ending = 0
      do while (motion%interval <= last)
         call look_for_interrupt(interrupted)
         if (present(trace)) interrupted = merge(1_c_int, interrupted, trace%lacks_memory)
         if (interrupted == 1) then
            ending = broken_off
            return
         end if
         call advance(mechanism, constants, record%dt, motion, event, sample_reached)
         select case (event)
         case (impact)
            call bounce(mechanism, constants, record, motion, ending, trace)
         case (limit_reached)
            ending = collapsed
            motion%q = constants%limit
            call set_peak(motion, record)
            if (present(trace)) call add_row(motion, record, trace)
         case default
            if (motion%q > motion%peak) call set_peak(motion, record)
         end select
         if (sample_reached) then
            if (ending == collapsed) return
            call next_interval(constants%solver, record, motion, trace)
         end if
         if (ending /= 0) return
      end do
      ending = record_over
   end subroutine rock

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

   !> Go on to the next sample
   pure subroutine next_interval(solver, record, motion, trace)
      type(solver_type), intent(in) :: solver
      type(record_type), intent(in) :: record
      type(motion_type), intent(inout) :: motion
      type(trace_type), intent(inout), optional :: trace

      motion%interval = motion%interval + 1
      motion%time = 0.0_wp
      call enter_interval(solver, record, motion)
      if (present(trace)) call add_row(motion, record, trace)
   end subroutine next_interval

   !> A new sample interval, or a new start in one
   pure subroutine enter_interval(solver, record, motion)
      type(solver_type), intent(in) :: solver
      type(record_type), intent(in) :: record
      type(motion_type), intent(inout) :: motion

      motion%longest = longest_step(solver%steps_per_sample, record%dt, motion%time)
      call aim(record, motion)
   end subroutine enter_interval

   !> The excitation in the present interval, seen from the side of the wall
   pure subroutine aim(record, motion)
      type(record_type), intent(in) :: record
      type(motion_type), intent(inout) :: motion

      motion%excitation = excitation_type()
      associate (a => record%acceleration, i => motion%interval)
         if (i >= size(a)) return
         motion%excitation%start = motion%side*motion%scale*a(i)
         motion%excitation%slope = motion%side*motion%scale*(a(i + 1) - a(i))/record%dt
      end associate
   end subroutine aim

   !> An impact: lose speed, change side, and see whether the wall comes to rest
   pure subroutine bounce(mechanism, constants, record, motion, ending, trace)
      class(mechanism_type), intent(in) :: mechanism
      !> Constants of the wall
      type(wall_constants_type), intent(in) :: constants
      type(record_type), intent(in) :: record
      type(motion_type), intent(inout) :: motion
      !> `at_rest` if it comes to rest, else 0
      integer, intent(out) :: ending
      type(trace_type), intent(inout), optional :: trace

      real(wp) :: v
      logical :: rests

      motion%v = min(motion%v, 0.0_wp)
      if (present(trace)) call add_row(motion, record, trace)
      v = motion%v
      call motion%strike(constants%rest, record, motion%excitation%start + motion%excitation%slope*motion%time, v, &
         & 1.0_wp, rests)
      motion%v = v
      ending = merge(at_rest, 0, rests)
      call aim(record, motion)
      if (present(trace)) then
         call add_row(motion, record, trace)
         if (.not. trace%lacks_memory) trace%after_impact(trace%rows) = .true.
      end if
      motion%f = angular_acceleration(mechanism, motion%excitation, motion%time, motion%q, motion%v)
   end subroutine bounce

   !> The rotation is a new peak
   pure subroutine set_peak(motion, record)
      type(motion_type), intent(inout) :: motion
      type(record_type), intent(in) :: record

      motion%peak = motion%q
      motion%time_of_peak = real(motion%interval - 1, wp)*record%dt + motion%time
   end subroutine set_peak

   !> Add the present state to the time history
   pure subroutine add_row(motion, record, trace)
      type(motion_type), intent(in) :: motion
      type(record_type), intent(in) :: record
      type(trace_type), intent(inout) :: trace

      real(wp) :: acceleration, x

      associate (a => record%acceleration, i => motion%interval, scale => motion%scale, s => motion%side)
         acceleration = 0.0_wp
         x = motion%time/record%dt
         if (i < size(a)) acceleration = scale*(a(i) + x*(a(i + 1) - a(i)))
         if (i == size(a) .and. x == 0.0_wp) acceleration = scale*a(i)
         ! Adding zero makes no row show a negative zero.
         call trace%add(real(i - 1, wp)*record%dt + motion%time, acceleration, s*motion%q + 0.0_wp, &
            & s*motion%v + 0.0_wp, s)
      end associate
   end subroutine add_row

end module dondolo_rk45
