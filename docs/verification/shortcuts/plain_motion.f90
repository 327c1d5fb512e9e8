!> The hybrid motion in a separate loop, with the shortcuts that are common in programs of this kind, one switch each.
!>
!> Without any switch it is the motion of docs/theory.md, section 4. It shares the terms, the step, the start of
!> rocking, the chain of bounces and the free motion after the record with the library, but neither the control of
!> the steps nor the order of operations.
module plain_motion
   use dondolo_base_kinds, only : wp
   use dondolo_motion_bernstein, only : first_descent, nowhere
   use dondolo_motion_dormand_prince, only : angular_acceleration, dense_rotation, dormand_prince_step, excitation_type, &
      & state_type
   use dondolo_motion_response, only : response_type
   use dondolo_motion_rest, only : bounce_type, new_rest, rest_type
   use dondolo_motion_solver, only : solver_type
   use dondolo_motion_step_limits, only : shortest_motion
   use dondolo_motion_tail, only : free_motion, tail_type
   use dondolo_record, only : record_type
   use dondolo_wall_mechanism, only : mechanism_type
   use straddling_step, only : ground_acceleration, step_over_samples
   implicit none
   private

   public :: shortcut_type, simulate_plain

   !> Shortcuts, all off by default
   type :: shortcut_type
      !> Name in the table
      character(len=60) :: name = 'none'
      !> Rebounds that would rise less than this part of q_c in still ground are rest; 0: use the bound on the chain
      real(wp) :: rest_height = 0.0_wp
      !> Rocking starts at the next sample instead of inside the interval
      logical :: late_start = .false.
      !> An impact is applied at the end of the step in which q < 0
      logical :: unlocated = .false.
      !> Number of samples between checks of the peak and collapse; 0: they are located
      integer :: every = 0
      !> Steps cross samples, as far as the error allows
      logical :: straddling = .false.
      !> The EDP is that reached by the end of the record
      logical :: no_tail = .false.
   end type shortcut_type

   !> Events within a step
   integer, parameter :: no_event = 0, impact = 1, turning = 2, limit_reached = 3

   !> State of a motion
   type :: motion_type
      !> Sample interval, from 1, and time since its first sample [s]
      integer :: interval = 1
      real(wp) :: time = 0.0_wp
      !> Side, rotation [rad], velocity [rad/s] and acceleration [rad/s2]
      real(wp) :: side = 1.0_wp, q = 0.0_wp, v = 0.0_wp, f = 0.0_wp
      !> Proposed step [s] and largest rotation so far [rad]
      real(wp) :: step = 0.0_wp, peak = 0.0_wp
      !> Whether the wall is at rest
      logical :: resting = .true.
   end type motion_type

   !> Constants of a history
   type :: scene_type
      !> Rest of the wall
      type(rest_type) :: rest
      !> The accelerogram, scaled
      type(record_type) :: record
      !> Tolerances
      type(solver_type) :: solver
      !> Shortcuts
      type(shortcut_type) :: shortcut
      !> Rotation that counts as collapse, and units of the error in rotation [rad] and velocity [rad/s]
      real(wp) :: limit, q_unit, v_unit
   end type scene_type

contains

   !> EDP and collapse of a wall under an accelerogram
   pure subroutine simulate_plain(mechanism, record, scale, solver, shortcut, response)
      class(mechanism_type), intent(in) :: mechanism
      type(record_type), intent(in) :: record
      !> Factor on the accelerogram
      real(wp), intent(in) :: scale
      type(solver_type), intent(in) :: solver
      type(shortcut_type), intent(in) :: shortcut
      type(response_type), intent(out) :: response

      type(scene_type) :: scene
      type(motion_type) :: motion
      type(tail_type) :: tail
      integer :: last

      scene%rest = new_rest(mechanism)
      scene%record = record
      scene%record%acceleration = scale*record%acceleration
      scene%solver = solver
      scene%shortcut = shortcut
      scene%limit = solver%edp_limit*mechanism%capacity
      scene%q_unit = mechanism%capacity
      scene%v_unit = mechanism%frequency_parameter()*mechanism%capacity
      motion%step = record%dt
      last = size(record%acceleration) - 1
      do while (motion%interval <= last .and. motion%peak < scene%limit)
         if (motion%resting) call start(mechanism, scene, motion)
         if (motion%interval > last) exit
         call rock(mechanism, scene, motion)
      end do

      response%collapsed = motion%peak >= scene%limit
      if (.not. (response%collapsed .or. motion%resting .or. shortcut%no_tail)) then
         call free_motion(mechanism, scene%limit, motion%peak, motion%q, motion%v, mechanism%restitution, tail)
         response%collapsed = tail%collapsed
         motion%peak = max(motion%peak, tail%peak)
      end if
      response%edp = merge(solver%edp_limit, motion%peak/mechanism%capacity, response%collapsed)
   end subroutine simulate_plain

   !> Advance from rest to the start of rocking, or beyond the last interval if there is none
   pure subroutine start(mechanism, scene, motion)
      class(mechanism_type), intent(in) :: mechanism
      type(scene_type), intent(in) :: scene
      type(motion_type), intent(inout) :: motion

      logical :: found

      do
         found = motion%interval < size(scene%record%acceleration)
         if (found) call scene%rest%next_start(scene%record, 1.0_wp, motion%interval, motion%time, motion%side, found)
         if (.not. found) motion%interval = size(scene%record%acceleration)
         if (.not. found .or. motion%time == 0.0_wp .or. .not. scene%shortcut%late_start) exit
         motion%interval = motion%interval + 1
         motion%time = 0.0_wp
      end do
      if (.not. found) return
      motion%resting = .false.
      motion%f = max(0.0_wp, acceleration_now(mechanism, scene, motion))
   end subroutine start

   !> Take one accepted step and apply the event at its end
   pure subroutine rock(mechanism, scene, motion)
      class(mechanism_type), intent(in) :: mechanism
      type(scene_type), intent(in) :: scene
      type(motion_type), intent(inout) :: motion

      real(wp) :: h, remaining, q, v, f, q_error, v_error, error, factor
      integer :: parts, event, target
      logical :: fresh

      associate (dt => scene%record%dt, solver => scene%solver)
         target = motion%interval + 1
         if (scene%shortcut%straddling) target = size(scene%record%acceleration)
         remaining = real(target - motion%interval, wp)*dt - motion%time
         do
            parts = max(1, ceiling(remaining/motion%step))
            h = remaining/real(parts, wp)
            call step_by(mechanism, scene, motion, h, q, v, f, q_error, v_error)
            error = abs(q_error)/(solver%atol*scene%q_unit + solver%rtol*max(abs(motion%q), abs(q))) &
               & + abs(v_error)/(solver%atol*scene%v_unit + solver%rtol*max(abs(motion%v), abs(v)))
            if (error <= 1.0_wp .or. h <= 1.0e-6_wp*dt) exit
            motion%step = h*max(0.2_wp, 0.9_wp*error**(-0.2_wp))
         end do
         ! A step that was cut at a sample must not shorten the proposal.
         factor = min(5.0_wp, 0.9_wp*max(error, 1.0e-5_wp)**(-0.2_wp))
         motion%step = merge(max(motion%step, h*factor), h*factor, factor >= 1.0_wp)

         event = no_event
         if (h > shortest_motion*dt) call find_and_land(mechanism, scene, motion, h, event, q, v, f)
         if (scene%shortcut%every > 0) call sample_peak(scene, motion, h, q, v, f)
         fresh = motion%q == 0.0_wp .and. motion%v == 0.0_wp .and. h <= shortest_motion*dt
         if (event == no_event .and. parts == 1) then
            motion%interval = target
            motion%time = 0.0_wp
         else
            motion%time = motion%time + h
            do while (motion%time >= dt)
               motion%time = motion%time - dt
               motion%interval = motion%interval + 1
            end do
         end if
      end associate
      motion%q = q
      motion%v = v
      motion%f = f
      if (scene%shortcut%every == 0) motion%peak = max(motion%peak, q)
      if (event == impact .or. (scene%shortcut%unlocated .and. q < 0.0_wp)) call bounce(mechanism, scene, motion)
      if (event /= no_event) motion%f = acceleration_now(mechanism, scene, motion)
      ! A start exactly at the threshold that rounding undoes at once must not be repeated endlessly.
      if (fresh .and. motion%resting) then
         motion%interval = motion%interval + 1
         motion%time = 0.0_wp
      end if
   end subroutine rock

   !> Take a step within an interval, or across samples
   pure subroutine step_by(mechanism, scene, motion, h, q, v, f, q_error, v_error)
      class(mechanism_type), intent(in) :: mechanism
      type(scene_type), intent(in) :: scene
      type(motion_type), intent(in) :: motion
      real(wp), intent(in) :: h
      !> State at the end and the estimate of its error
      real(wp), intent(out) :: q, v, f, q_error, v_error

      type(state_type) :: next

      if (scene%shortcut%straddling) then
         call step_over_samples(mechanism, scene%record, motion%side, motion%interval, motion%time, h, &
            & motion%q, motion%v, motion%f, q, v, f, q_error, v_error)
      else
         associate (a => scene%record%acceleration, i => motion%interval, side => motion%side)
            call dormand_prince_step(mechanism, excitation_type(side*a(i), side*(a(i + 1) - a(i))/scene%record%dt), &
               & motion%time, h, state_type(motion%q, motion%v, motion%f), next, q_error, v_error)
         end associate
         q = next%q
         v = next%v
         f = next%f
      end if
   end subroutine step_by

   !> Find the first event within a step and repeat the step so that it ends there
   pure subroutine find_and_land(mechanism, scene, motion, h, event, q, v, f)
      class(mechanism_type), intent(in) :: mechanism
      type(scene_type), intent(in) :: scene
      type(motion_type), intent(in) :: motion
      !> The step [s], whole on entry, to the event on return
      real(wp), intent(inout) :: h
      integer, intent(out) :: event
      !> State at the end
      real(wp), intent(inout) :: q, v, f

      real(wp) :: b(0:5), x, before, after, trial, gap, rate, change, q_error, v_error
      integer :: i

      b = dense_rotation(h, state_type(motion%q, motion%v, motion%f), state_type(q, v, f))
      event = no_event
      x = nowhere
      if (.not. scene%shortcut%unlocated) call take_if_earlier(impact, first_descent(b), event, x)
      if (scene%shortcut%every == 0 .and. maxval(b) > motion%peak) then
         if (motion%v > 0.0_wp) call take_if_earlier(turning, first_descent(b(1:) - b(:4)), event, x)
         call take_if_earlier(limit_reached, first_descent(scene%limit - b), event, x)
      end if
      if (event == no_event) return

      before = 0.0_wp
      after = h
      trial = x*h
      do i = 1, 60
         call step_by(mechanism, scene, motion, trial, q, v, f, q_error, v_error)
         gap = v
         rate = f
         if (event == impact) gap = q
         if (event == limit_reached) gap = scene%limit - q
         if (event /= turning) rate = merge(v, -v, event == impact)
         if (gap > 0.0_wp) before = trial
         if (.not. gap > 0.0_wp) after = trial
         change = huge(change)
         if (rate < 0.0_wp) change = -gap/rate
         if (abs(change) <= sqrt(epsilon(h))*trial) exit
         if (after - before <= 2.0_wp*epsilon(h)*after) exit
         trial = trial + change
         if (.not. (trial > before .and. trial < after)) trial = 0.5_wp*(before + after)
      end do
      if (abs(change) <= sqrt(epsilon(h))*trial) then
         trial = trial + change
         q = q + change*(v + 0.5_wp*change*f)
         v = v + change*f
      else if (gap > 0.0_wp) then
         ! The dense output only grazed the event: treat the step up to here as an ordinary one.
         event = no_event
      end if
      h = trial
      if (event == impact) q = 0.0_wp
      if (event == limit_reached) q = scene%limit
   end subroutine find_and_land

   !> Replace the event found so far by an earlier one
   pure subroutine take_if_earlier(candidate, at, event, x)
      integer, intent(in) :: candidate
      real(wp), intent(in) :: at
      !> The event found so far and its position, as a fraction of the step
      integer, intent(inout) :: event
      real(wp), intent(inout) :: x

      if (.not. at < x) return
      event = candidate
      x = at
   end subroutine take_if_earlier

   !> Largest rotation at the samples that a step reaches
   pure subroutine sample_peak(scene, motion, h, q, v, f)
      type(scene_type), intent(in) :: scene
      !> Start of the step; the peak is set
      type(motion_type), intent(inout) :: motion
      !> The step [s], and the state at its end
      real(wp), intent(in) :: h, q, v, f

      !> Binomial coefficients
      real(wp), parameter :: binomial(0:5) = [1.0_wp, 5.0_wp, 10.0_wp, 10.0_wp, 5.0_wp, 1.0_wp]
      real(wp) :: b(0:5), x
      integer :: sample, j

      b = dense_rotation(h, state_type(motion%q, motion%v, motion%f), state_type(q, v, f))
      sample = motion%interval
      do
         sample = sample + 1
         x = (real(sample - motion%interval, wp)*scene%record%dt - motion%time)/h
         if (x > 1.0_wp + 1.0e-9_wp) exit
         if (modulo(sample - 1, scene%shortcut%every) /= 0) cycle
         motion%peak = max(motion%peak, sum([(binomial(j)*b(j)*x**j*(1.0_wp - x)**(5 - j), j=0, 5)]))
      end do
   end subroutine sample_peak

   !> Apply an impact: reduce the speed, change side, and check whether the wall is at rest
   pure subroutine bounce(mechanism, scene, motion)
      class(mechanism_type), intent(in) :: mechanism
      type(scene_type), intent(in) :: scene
      type(motion_type), intent(inout) :: motion

      real(wp) :: ground, moment
      integer :: stopper

      motion%q = 0.0_wp
      motion%v = mechanism%restitution*abs(motion%v)
      if (mechanism%two_sided) motion%side = -motion%side
      associate (rest => scene%rest, shortcut => scene%shortcut)
         if (shortcut%rest_height > 0.0_wp) then
            motion%resting = 0.5_wp*rest%inertia*motion%v**2 < shortcut%rest_height*scene%q_unit*rest%moment
         else
            ground = ground_acceleration(scene%record, motion%interval, motion%time)
            moment = rest%inward_moment(motion%side, ground)
            motion%resting = motion%v == 0.0_wp
            if (moment > 0.0_wp .and. .not. motion%resting) then
               motion%resting = 2.0_wp*motion%v*rest%inertia/moment <= shortest_motion*scene%record%dt
               stopper = 0
               if (.not. motion%resting) call rest%chain_ends(scene%record, 1.0_wp, &
                  & bounce_type(motion%interval, motion%time, motion%side, motion%v, motion%peak), stopper, motion%resting)
            end if
         end if
      end associate
      if (motion%resting) motion%v = 0.0_wp
      motion%f = acceleration_now(mechanism, scene, motion)
   end subroutine bounce

   !> Acceleration of the wall in its present state
   pure real(wp) function acceleration_now(mechanism, scene, motion)
      class(mechanism_type), intent(in) :: mechanism
      type(scene_type), intent(in) :: scene
      type(motion_type), intent(in) :: motion

      acceleration_now = angular_acceleration(mechanism, excitation_type(motion%side* &
         & ground_acceleration(scene%record, motion%interval, motion%time)), 0.0_wp, motion%q, motion%v)
   end function acceleration_now

end module plain_motion
