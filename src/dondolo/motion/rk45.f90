!> The engine rk45: the hybrid motion of one wall under one accelerogram, by adaptive Dormand-Prince steps.
!>
!> At rest, rocking, collapsed (docs/theory.md, section 4). No step crosses a sample, where the piecewise linear
!> accelerogram has its corners.
module dondolo_rk45
   use, intrinsic :: iso_c_binding, only : c_int
   use dondolo_adaptive_step, only : advance, motion_type, scene_type
   use dondolo_dormand_prince, only : angular_acceleration
   use dondolo_events, only : impact, limit_reached
   use dondolo_interrupt, only : look_for_interrupt
   use dondolo_kinds, only : wp
   use dondolo_mechanism, only : mechanism_type
   use dondolo_record, only : record_type
   use dondolo_response, only : response_type, trace_type
   use dondolo_rest, only : leave_edge, new_rest, shortest_motion
   use dondolo_solver, only : solver_type
   use dondolo_tail, only : free_motion, tail_type
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
      !> The mechanism
      class(mechanism_type), intent(in) :: mechanism
      !> The accelerogram
      type(record_type), intent(in) :: record
      !> Factor on it, negative to reverse its polarity
      real(wp), intent(in) :: scale
      !> Tolerances and limit
      type(solver_type), intent(in) :: solver
      !> Result
      type(response_type), intent(out) :: response
      !> Time history, until rest or 10 s past the end of the record; computed only if present
      type(trace_type), intent(inout), optional :: trace
      !> Rotation from which the wall is released at the start, less than the limit [rad]; absent: it starts at rest
      real(wp), intent(in), optional :: release
      !> Counts, added to
      type(work_type), intent(inout), optional :: work

      type(scene_type) :: scene
      type(motion_type) :: motion
      type(tail_type) :: tail
      real(wp) :: start
      integer :: last, ending, first, rocked, last_rocked

      rocked = 0
      last_rocked = 0
      scene%rest = new_rest(mechanism)
      scene%scale = scale
      scene%solver = solver
      scene%limit = solver%edp_limit*mechanism%capacity
      scene%q_unit = mechanism%capacity
      scene%v_unit = mechanism%frequency_parameter()*mechanism%capacity
      motion%step = record%dt
      last = size(record%acceleration) - 1
      if (present(release)) motion%q = release
      motion%peak = motion%q
      if (present(trace)) call add_row(motion, record, scale, trace)

      ending = merge(record_over, at_rest, motion%q > 0.0_wp)
      do
         if (ending == at_rest) then
            call wait(scene, record, last, motion, ending, trace)
            if (ending == at_rest) exit
         end if
         first = motion%interval
         start = motion%time
         call rock(mechanism, scene, record, last, motion, ending, trace)
         rocked = rocked + min(motion%interval, last) - max(first - 1, last_rocked)
         last_rocked = min(motion%interval, last)
         if (ending /= at_rest) exit
         ! A start on the very edge of the threshold that rounding undoes at once must not be tried for ever.
         if (motion%interval == first .and. motion%time - start <= shortest_motion*record%dt) &
            & call cross_edge(scene, record, motion, trace)
      end do

      response%collapsed = ending == collapsed
      if (ending == record_over) then
         call free_motion(mechanism, scene%limit, motion%q, motion%v, tail)
         response%collapsed = tail%collapsed
         if (tail%peak > motion%peak) then
            motion%peak = tail%peak
            motion%time_of_peak = record%duration() + tail%delay
         end if
      end if
      response%edp = motion%peak/mechanism%capacity
      ! A peak that only rounding tells from the limit is a collapse too.
      response%collapsed = response%collapsed .or. response%edp >= solver%edp_limit
      if (response%collapsed) response%edp = solver%edp_limit
      response%impacts = motion%impacts
      response%time_of_peak = motion%time_of_peak

      if (present(work)) call work%add(work_type(histories=1, still=merge(1, 0, rocked == 0), intervals=last, &
         & rocked=rocked, steps=motion%steps, evaluations=motion%evaluations, impacts=motion%impacts))
      if (present(trace)) then
         if (ending == record_over) then
            last = last + ceiling(min(trace_after/record%dt, most_after))
            call rock(mechanism, scene, record, last, motion, ending, trace)
         end if
         call trace%trim_rows()
      end if
   end subroutine simulate_rk45

   !> At rest: go to the instant at which rocking begins
   pure subroutine wait(scene, record, last, motion, ending, trace)
      !> What stays the same
      type(scene_type), intent(in) :: scene
      !> The accelerogram
      type(record_type), intent(in) :: record
      !> Last sample interval of the record
      integer, intent(in) :: last
      !> Where the motion is
      type(motion_type), intent(inout) :: motion
      !> `at_rest` if it stays so, 0 if rocking begins
      integer, intent(out) :: ending
      !> Time history
      type(trace_type), intent(inout), optional :: trace

      real(wp) :: side
      integer :: from, i
      logical :: found

      motion%q = 0.0_wp
      motion%v = 0.0_wp
      motion%tiny_bounces = 0
      ending = at_rest
      if (motion%interval > last) return
      from = motion%interval
      side = motion%excitation%side
      call scene%rest%next_start(record, scene%scale, motion%interval, motion%time, motion%excitation%side, found)
      if (found) ending = 0
      if (.not. present(trace)) return
      i = merge(motion%interval, last + 1, found)
      do from = from + 1, i
         call trace%add(real(from - 1, wp)*record%dt, scene%scale*record%acceleration(from), 0.0_wp, 0.0_wp, side)
      end do
   end subroutine wait

   !> Rocking, until rest, collapse, or the end of the last interval
   pure subroutine rock(mechanism, scene, record, last, motion, ending, trace)
      !> The mechanism
      class(mechanism_type), intent(in) :: mechanism
      !> What stays the same
      type(scene_type), intent(in) :: scene
      !> The accelerogram
      type(record_type), intent(in) :: record
      !> Last interval to go through; beyond the record the ground is still
      integer, intent(in) :: last
      !> Where the motion is
      type(motion_type), intent(inout) :: motion
      !> How it ends
      integer, intent(out) :: ending
      !> Time history
      type(trace_type), intent(inout), optional :: trace

      logical :: sample_reached
      integer :: event
      integer(c_int) :: interrupted

      call enter_interval(scene, record, motion)
      motion%f = angular_acceleration(mechanism, motion%excitation, motion%time, motion%q, motion%v)
      ! A wall at rest begins to rock where its moment is zero: never inwards, whatever the rounding says.
      if (motion%q == 0.0_wp .and. motion%v == 0.0_wp) motion%f = max(0.0_wp, motion%f)
      ending = 0
      do while (motion%interval <= last)
         call look_for_interrupt(interrupted)
         if (present(trace)) interrupted = merge(1_c_int, interrupted, trace%lacks_memory)
         if (interrupted == 1) then
            ending = broken_off
            return
         end if
         call advance(mechanism, scene, record%dt, motion, event, sample_reached)
         select case (event)
         case (impact)
            call bounce(mechanism, scene, record, motion, ending, trace)
         case (limit_reached)
            ending = collapsed
            motion%q = scene%limit
            call set_peak(motion, record)
            if (present(trace)) call add_row(motion, record, scene%scale, trace)
         case default
            if (motion%q > motion%peak) call set_peak(motion, record)
         end select
         if (sample_reached) then
            if (ending == collapsed) return
            call next_interval(scene, record, motion, trace)
         end if
         if (ending /= 0) return
      end do
      ending = record_over
   end subroutine rock

   !> Leave the edge of a threshold
   pure subroutine cross_edge(scene, record, motion, trace)
      !> What stays the same
      type(scene_type), intent(in) :: scene
      !> The accelerogram
      type(record_type), intent(in) :: record
      !> Where the motion is: at rest
      type(motion_type), intent(inout) :: motion
      !> Time history
      type(trace_type), intent(inout), optional :: trace

      integer :: first

      first = motion%interval
      call leave_edge(record, motion%interval, motion%time)
      if (motion%interval == first) return
      call enter_interval(scene, record, motion)
      if (present(trace)) call add_row(motion, record, scene%scale, trace)
   end subroutine cross_edge

   !> Go on to the next sample
   pure subroutine next_interval(scene, record, motion, trace)
      !> What stays the same
      type(scene_type), intent(in) :: scene
      !> The accelerogram
      type(record_type), intent(in) :: record
      !> Where the motion is
      type(motion_type), intent(inout) :: motion
      !> Time history
      type(trace_type), intent(inout), optional :: trace

      motion%interval = motion%interval + 1
      motion%time = 0.0_wp
      call enter_interval(scene, record, motion)
      if (present(trace)) call add_row(motion, record, scene%scale, trace)
   end subroutine next_interval

   !> The accelerogram in the interval of the motion
   pure subroutine enter_interval(scene, record, motion)
      !> What stays the same
      type(scene_type), intent(in) :: scene
      !> The accelerogram
      type(record_type), intent(in) :: record
      !> Where the motion is
      type(motion_type), intent(inout) :: motion

      call motion%limit_steps(scene%solver, record%dt)
      motion%excitation%start = 0.0_wp
      motion%excitation%slope = 0.0_wp
      associate (a => record%acceleration, i => motion%interval)
         if (i >= size(a)) return
         motion%excitation%start = scene%scale*a(i)
         motion%excitation%slope = scene%scale*(a(i + 1) - a(i))/record%dt
      end associate
   end subroutine enter_interval

   !> An impact: lose speed, change side, and see whether the wall comes to rest
   pure subroutine bounce(mechanism, scene, record, motion, ending, trace)
      !> The mechanism
      class(mechanism_type), intent(in) :: mechanism
      !> What stays the same
      type(scene_type), intent(in) :: scene
      !> The accelerogram
      type(record_type), intent(in) :: record
      !> Where the motion is
      type(motion_type), intent(inout) :: motion
      !> `at_rest` if it comes to rest, else 0
      integer, intent(out) :: ending
      !> Time history
      type(trace_type), intent(inout), optional :: trace

      logical :: rests

      ending = 0
      motion%impacts = motion%impacts + 1
      motion%v = min(motion%v, 0.0_wp)
      if (present(trace)) call add_row(motion, record, scene%scale, trace)
      motion%v = -mechanism%restitution*motion%v
      if (mechanism%two_sided) motion%excitation%side = -motion%excitation%side
      if (present(trace)) then
         call add_row(motion, record, scene%scale, trace)
         if (.not. trace%lacks_memory) trace%after_impact(trace%rows) = .true.
      end if

      associate (ground => motion%excitation)
         call scene%rest%settle(record, scene%scale, motion%interval, motion%time, &
            & ground%start + ground%slope*motion%time, ground%side, motion%v, motion%peak, motion%impacts, &
            & motion%tiny_bounces, rests)
      end associate
      if (rests) ending = at_rest
      motion%f = angular_acceleration(mechanism, motion%excitation, motion%time, motion%q, motion%v)
   end subroutine bounce

   !> The rotation is a new peak
   pure subroutine set_peak(motion, record)
      !> Where the motion is
      type(motion_type), intent(inout) :: motion
      !> The accelerogram
      type(record_type), intent(in) :: record

      motion%peak = motion%q
      motion%time_of_peak = real(motion%interval - 1, wp)*record%dt + motion%time
   end subroutine set_peak

   !> Add the present state to the time history
   pure subroutine add_row(motion, record, scale, trace)
      !> Where the motion is
      type(motion_type), intent(in) :: motion
      !> The accelerogram
      type(record_type), intent(in) :: record
      !> Factor on it
      real(wp), intent(in) :: scale
      !> Time history
      type(trace_type), intent(inout) :: trace

      real(wp) :: acceleration, x

      associate (a => record%acceleration, i => motion%interval, s => motion%excitation%side)
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
