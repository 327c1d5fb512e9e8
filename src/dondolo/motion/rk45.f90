!> The engine rk45: the hybrid motion of one wall under one accelerogram, by adaptive Dormand-Prince steps.
!>
!> At rest, rocking, collapsed (docs/theory.md, section 4). No step crosses a sample, where the piecewise linear
!> accelerogram has its corners. Events - impact, turning point, limit - are found on the dense output of a
!> step; the step is then taken again so that it ends on the event, which thus has the accuracy of a step.
module dondolo_rk45
   use dondolo_bernstein, only : first_descent, nowhere
   use dondolo_dormand_prince, only : angular_acceleration, dense_rotation, dormand_prince_step, excitation_type
   use dondolo_kinds, only : wp
   use dondolo_mechanism, only : mechanism_type
   use dondolo_record, only : record_type
   use dondolo_response, only : response_type, trace_type
   use dondolo_rest, only : new_rest, rest_type
   use dondolo_solver, only : solver_type
   use dondolo_tail, only : free_motion, tail_type
   implicit none
   private

   public :: simulate_rk45

   !> How rocking ends
   integer, parameter :: at_rest = 1, collapsed = 2, record_over = 3

   !> Events within a step
   integer, parameter :: no_event = 0, impact = 1, turning = 2, limit_reached = 3

   !> A bounce that would rise less than this part of q_c in still ground is tiny; after this many tiny ones in a
   !> row the wall is called at rest, which only guards against a chain without end (restitution next to 1)
   real(wp), parameter :: tiny_height = 1.0e-12_wp
   integer, parameter :: most_tiny_bounces = 1000

   !> A motion shorter than this part of the sample interval cannot be told from rest
   real(wp), parameter :: shortest_motion = 1.0e3_wp*epsilon(1.0_wp)

   !> Smallest step / sample interval
   real(wp), parameter :: smallest_step = 2.0_wp**(-20)

   !> Time after the record for which a trace goes on [s]
   real(wp), parameter :: trace_after = 10.0_wp

   !> Where the motion is
   type :: motion_type
      !> Sample interval, from 1
      integer :: interval = 1
      !> Time since the first sample of the interval [s]
      real(wp) :: time = 0.0_wp
      !> What drives it: the accelerogram in this interval and the side
      type(excitation_type) :: excitation
      !> Rotation [rad]
      real(wp) :: q = 0.0_wp
      !> Angular velocity, positive outwards [rad/s]
      real(wp) :: v = 0.0_wp
      !> Angular acceleration [rad/s2]
      real(wp) :: f = 0.0_wp
      !> Step proposed by the error control [s]
      real(wp) :: step = 0.0_wp
      !> Scaled error of the last accepted step
      real(wp) :: last_error = 1.0e-4_wp
      !> Largest rotation so far [rad] and its time [s]
      real(wp) :: peak = 0.0_wp, time_of_peak = 0.0_wp
      !> Impacts so far
      integer :: impacts = 0
      !> Tiny bounces in a row
      integer :: tiny_bounces = 0
   end type motion_type

   !> What stays the same during a history
   type :: scene_type
      !> Rest of the wall
      type(rest_type) :: rest
      !> Factor on the accelerogram, negative to reverse it
      real(wp) :: scale
      !> Tolerances
      type(solver_type) :: solver
      !> Rotation that counts as collapse [rad]
      real(wp) :: limit
      !> Units of rotation [rad] and velocity [rad/s] of the error: q_c and p q_c
      real(wp) :: q_unit, v_unit
   end type scene_type

contains

   !> The motion of a wall under an accelerogram
   pure subroutine simulate_rk45(mechanism, record, scale, solver, response, trace, release)
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

      type(scene_type) :: scene
      type(motion_type) :: motion
      type(tail_type) :: tail
      real(wp) :: start
      integer :: last, ending, first

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
         if (ending /= at_rest) exit
         ! A start on the very edge of the threshold that rounding undoes at once must not be tried for ever.
         if (motion%interval == first .and. motion%time - start <= shortest_motion*record%dt) &
            & call next_interval(scene, record, motion, trace)
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
      if (response%collapsed) response%edp = solver%edp_limit
      response%impacts = motion%impacts
      response%time_of_peak = motion%time_of_peak

      if (present(trace)) then
         if (ending == record_over) then
            last = last + ceiling(trace_after/record%dt)
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

      integer :: from, i
      logical :: found

      motion%q = 0.0_wp
      motion%v = 0.0_wp
      motion%tiny_bounces = 0
      ending = at_rest
      if (motion%interval > last) return
      from = motion%interval
      call scene%rest%next_start(record, scene%scale, motion%interval, motion%time, motion%excitation%side, found)
      if (found) ending = 0
      if (.not. present(trace)) return
      i = merge(motion%interval, last + 1, found)
      do from = from + 1, i
         call trace%add(real(from - 1, wp)*record%dt, scene%scale*record%acceleration(from), 0.0_wp, 0.0_wp)
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

      call enter_interval(scene, record, motion)
      motion%f = angular_acceleration(mechanism, motion%excitation, motion%time, motion%q, motion%v)
      ! A wall at rest begins to rock where its moment is zero: never inwards, whatever the rounding says.
      if (motion%q == 0.0_wp .and. motion%v == 0.0_wp) motion%f = max(0.0_wp, motion%f)
      ending = 0
      do while (motion%interval <= last)
         call advance(mechanism, scene, record, motion, event, sample_reached)
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
            ! The acceleration is continuous at a sample, save at the last, after which the ground is still.
            if (motion%interval == size(record%acceleration)) &
               & motion%f = angular_acceleration(mechanism, motion%excitation, 0.0_wp, motion%q, motion%v)
         end if
         if (ending /= 0) return
      end do
      ending = record_over
   end subroutine rock

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

      motion%excitation%start = 0.0_wp
      motion%excitation%slope = 0.0_wp
      associate (a => record%acceleration, i => motion%interval)
         if (i >= size(a)) return
         motion%excitation%start = scene%scale*a(i)
         motion%excitation%slope = scene%scale*(a(i + 1) - a(i))/record%dt
      end associate
   end subroutine enter_interval

   !> One accepted step: to the next sample, less where the error asks for it, or to the first event on the way
   pure subroutine advance(mechanism, scene, record, motion, event, sample_reached)
      !> The mechanism
      class(mechanism_type), intent(in) :: mechanism
      !> What stays the same
      type(scene_type), intent(in) :: scene
      !> The accelerogram
      type(record_type), intent(in) :: record
      !> Where the motion is
      type(motion_type), intent(inout) :: motion
      !> The event the step ends on
      integer, intent(out) :: event
      !> Does it end on the next sample?
      logical, intent(out) :: sample_reached

      real(wp) :: remaining, h, q, v, f, q_error, v_error, error, x
      logical :: accepted
      integer :: parts

      remaining = record%dt - motion%time
      event = no_event
      sample_reached = .not. remaining > 0.0_wp
      if (sample_reached) return
      do
         parts = max(1, ceiling(remaining/motion%step))
         h = remaining/real(parts, wp)
         call dormand_prince_step(mechanism, motion%excitation, motion%time, h, motion%q, motion%v, motion%f, &
            & q, v, f, q_error, v_error)
         ! The sum, since unlike the maximum it is never deaf to a value that is not a number.
         error = abs(q_error)/(scene%solver%atol*scene%q_unit + scene%solver%rtol*max(abs(motion%q), abs(q))) &
            & + abs(v_error)/(scene%solver%atol*scene%v_unit + scene%solver%rtol*max(abs(motion%v), abs(v)))
         call control_step(error, h, smallest_step*record%dt, motion, accepted)
         if (accepted) exit
      end do

      ! In a step too short to be told from none, signs are rounding; what happened shows in the next.
      if (h > shortest_motion*record%dt) call find_event(scene, motion, h, q, v, f, event, x)
      if (event /= no_event) call land(mechanism, scene, motion, h, event, x, q, v, f)
      sample_reached = parts == 1 .and. event == no_event
      motion%time = merge(record%dt, min(motion%time + h, record%dt), sample_reached)
      if (event /= no_event) sample_reached = motion%time >= record%dt
      motion%q = q
      motion%v = v
      motion%f = f
   end subroutine advance

   !> Accept or reject a step and propose the next (PI control; Hairer, Norsett and Wanner 1993, section II.4)
   pure subroutine control_step(error, h, smallest, motion, accepted)
      !> Scaled error of the step
      real(wp), intent(in) :: error
      !> The step [s]
      real(wp), intent(in) :: h
      !> Smallest step, always accepted [s]
      real(wp), intent(in) :: smallest
      !> Where the motion is: the proposal and the last error
      type(motion_type), intent(inout) :: motion
      !> Is it accepted?
      logical, intent(out) :: accepted

      real(wp), parameter :: safety = 0.9_wp, largest_rise = 5.0_wp, largest_fall = 0.2_wp
      real(wp), parameter :: exponent = 0.17_wp, damping = 0.04_wp, negligible = 1.0e-5_wp
      real(wp) :: factor

      accepted = error <= 1.0_wp .or. h <= smallest
      if (.not. accepted) then
         factor = largest_fall
         if (error < 1.0e6_wp) factor = max(largest_fall, safety*error**(-0.2_wp))
         motion%step = max(smallest, h*factor)
         return
      end if
      factor = largest_rise
      if (error > negligible) factor = min(largest_rise, safety*error**(-exponent)*motion%last_error**damping)
      motion%last_error = max(error, 1.0e-4_wp)
      ! A step that was cut at a sample must not shorten the proposal.
      if (factor >= 1.0_wp) then
         motion%step = max(motion%step, h*factor)
      else
         motion%step = max(smallest, h*factor)
      end if
   end subroutine control_step

   !> The first event within a step, on its dense output
   pure subroutine find_event(scene, motion, h, q, v, f, event, x)
      !> What stays the same
      type(scene_type), intent(in) :: scene
      !> Start of the step
      type(motion_type), intent(in) :: motion
      !> The step [s]
      real(wp), intent(in) :: h
      !> Rotation [rad], velocity [rad/s] and acceleration [rad/s2] at its end
      real(wp), intent(in) :: q, v, f
      !> The event
      integer, intent(out) :: event
      !> Its place, as a part of the step
      real(wp), intent(out) :: x

      real(wp) :: b(0:5), d(0:4), highest, place

      b = dense_rotation(h, motion%q, motion%v, motion%f, q, v, f)
      highest = maxval(b)
      event = no_event
      x = nowhere
      if (minval(b) <= 0.0_wp) then
         x = first_descent(b)
         if (x < nowhere) event = impact
      end if
      ! A turning point matters only where it may be a new peak.
      if (highest > motion%peak) then
         d = b(1:) - b(:4)
         place = nowhere
         if (any(d < 0.0_wp) .and. any(d > 0.0_wp)) place = first_descent(d*initial_sign(d))
         if (place < x) then
            x = place
            event = turning
         end if
         if (highest >= scene%limit) then
            place = first_descent(scene%limit - b)
            if (place < x) then
               x = place
               event = limit_reached
            end if
         end if
      end if
   end subroutine find_event

   !> Sign of the first coefficient that is not zero
   pure function initial_sign(c) result(s)
      !> Coefficients, not all zero
      real(wp), intent(in) :: c(:)
      !> +1 or -1
      real(wp) :: s

      s = sign(1.0_wp, c(findloc(c /= 0.0_wp, .true., dim=1)))
   end function initial_sign

   !> Take a step again so that it ends on an event: Newton's method on the step itself, kept in a bracket by
   !> bisection, from the place found on the dense output
   pure subroutine land(mechanism, scene, motion, h, event, x, q, v, f)
      !> The mechanism
      class(mechanism_type), intent(in) :: mechanism
      !> What stays the same
      type(scene_type), intent(in) :: scene
      !> Start of the step
      type(motion_type), intent(in) :: motion
      !> In: the whole step; out: the step to the event [s]
      real(wp), intent(inout) :: h
      !> The event; `no_event` if the step, taken again, only grazes it
      integer, intent(inout) :: event
      !> Its place on the dense output, as a part of the step
      real(wp), intent(in) :: x
      !> Rotation [rad], velocity [rad/s] and acceleration [rad/s2] at the end
      real(wp), intent(inout) :: q, v, f

      integer, parameter :: most_trials = 60
      real(wp) :: before, after, trial, gap, rate, change, sense, q_error, v_error
      logical :: crossed
      integer :: i

      before = 0.0_wp
      after = h
      trial = x*h
      crossed = .false.
      sense = 1.0_wp
      if (motion%v < 0.0_wp .or. (motion%v == 0.0_wp .and. motion%f < 0.0_wp)) sense = -1.0_wp
      do i = 1, most_trials
         call dormand_prince_step(mechanism, motion%excitation, motion%time, trial, motion%q, motion%v, motion%f, &
            & q, v, f, q_error, v_error)
         ! The gap is positive before the event and falls to zero at it.
         select case (event)
         case (impact)
            gap = q
            rate = v
         case (limit_reached)
            gap = scene%limit - q
            rate = -v
         case default
            gap = sense*v
            rate = sense*f
         end select
         if (gap > 0.0_wp) then
            before = trial
         else
            after = trial
            crossed = .true.
         end if
         change = huge(change)
         if (rate < 0.0_wp) change = -gap/rate
         if (abs(change) <= sqrt(epsilon(h))*trial) exit
         if (after - before <= 2.0_wp*epsilon(h)*after) then
            change = 0.0_wp
            exit
         end if
         trial = trial + change
         if (.not. (trial > before .and. trial < after)) trial = 0.5_wp*(before + after)
      end do
      if (i > most_trials) change = 0.0_wp
      if (gap > 0.0_wp .and. change == 0.0_wp .and. .not. crossed) then
         ! The dense output dipped, the motion does not: the whole step was right.
         event = no_event
         return
      end if
      h = trial + change
      q = q + change*(v + 0.5_wp*change*f)
      v = v + change*f
      if (event == impact) q = 0.0_wp
      if (event == turning) v = 0.0_wp
      f = angular_acceleration(mechanism, motion%excitation, motion%time + h, q, v)
   end subroutine land

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

      real(wp) :: moment, flight
      logical :: is_tiny

      ending = 0
      motion%impacts = motion%impacts + 1
      motion%v = min(motion%v, 0.0_wp)
      if (present(trace)) call add_row(motion, record, scene%scale, trace)
      motion%v = -mechanism%restitution*motion%v
      if (mechanism%two_sided) motion%excitation%side = -motion%excitation%side
      if (present(trace)) call add_row(motion, record, scene%scale, trace)

      associate (rest => scene%rest, ground => motion%excitation)
         is_tiny = 0.5_wp*rest%inertia*motion%v**2 < tiny_height*scene%q_unit*rest%moment
         motion%tiny_bounces = merge(motion%tiny_bounces + 1, 0, is_tiny)
         moment = rest%inward_moment(ground%side, ground%start + ground%slope*motion%time)
         if (motion%v == 0.0_wp .or. motion%tiny_bounces > most_tiny_bounces) then
            ending = at_rest
         else if (moment > 0.0_wp) then
            flight = 2.0_wp*motion%v*rest%inertia/moment
            if (flight <= shortest_motion*record%dt) ending = at_rest
            if (rest%chain_ends(record, scene%scale, motion%interval, motion%time, ground%side, motion%v, motion%peak)) &
               & ending = at_rest
         end if
      end associate
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
         call trace%add(real(i - 1, wp)*record%dt + motion%time, acceleration, s*motion%q, s*motion%v)
      end associate
   end subroutine add_row

end module dondolo_rk45
