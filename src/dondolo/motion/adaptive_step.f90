!> One accepted step of the engine rk45: to the next sample, less where the error asks for it, or to the first
!> event on the way.
!>
!> Events - impact, turning point, limit - are found on the dense output of a step; the step is then taken again so
!> that it ends on the event, which thus has the accuracy of a step (docs/theory.md, section 5).
module dondolo_adaptive_step
      use dondolo_dormand_prince, only : angular_acceleration, dense_rotation, dormand_prince_step, excitation_type, &
      & is_beyond
   use dondolo_events, only : find_event, impact, limit_reached, no_event, turning
   use dondolo_kinds, only : wp
   use dondolo_mechanism, only : mechanism_type
   use dondolo_rest, only : rest_type, shortest_motion
   use dondolo_solver, only : solver_type
   implicit none
   private

   public :: motion_type, scene_type, advance

   !> Evaluations of the terms in a step, the first of which the step before has done
   integer, parameter :: stages = 6

   !> Smallest step / sample interval
   real(wp), parameter :: smallest_step = 2.0_wp**(-20)

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
      !> Longest step from the last sample or event to the next [s]
      real(wp) :: longest = huge(1.0_wp)
      !> Scaled error of the last accepted step
      real(wp) :: last_error = 1.0e-4_wp
      !> Largest rotation so far [rad] and its time [s]
      real(wp) :: peak = 0.0_wp, time_of_peak = 0.0_wp
      !> Impacts so far
      integer :: impacts = 0
      !> Tiny bounces in a row
      integer :: tiny_bounces = 0
      !> Steps taken, and evaluations of the terms
      integer :: steps = 0, evaluations = 0
   contains
      !> Take note of a sample or an event
      procedure :: limit_steps
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

   !> One accepted step: to the next sample, less where the error asks for it, or to the first event on the way
   pure subroutine advance(mechanism, scene, dt, motion, event, sample_reached)
      !> The mechanism
      class(mechanism_type), intent(in) :: mechanism
      !> What stays the same
      type(scene_type), intent(in) :: scene
      !> Sample interval [s]
      real(wp), intent(in) :: dt
      !> Where the motion is
      type(motion_type), intent(inout) :: motion
      !> The event the step ends on
      integer, intent(out) :: event
      !> Does it end on the next sample?
      logical, intent(out) :: sample_reached

      real(wp) :: remaining, h, q, v, f, q_error, v_error, error, x
      logical :: accepted
      integer :: parts

      remaining = dt - motion%time
      event = no_event
      sample_reached = .not. remaining > 0.0_wp
      if (sample_reached) return
      do
         parts = max(1, ceiling(remaining/min(motion%step, motion%longest)))
         h = remaining/real(parts, wp)
         call dormand_prince_step(mechanism, motion%excitation, motion%time, h, motion%q, motion%v, motion%f, &
            & q, v, f, q_error, v_error)
         motion%evaluations = motion%evaluations + stages
         ! The sum, since unlike the maximum it is never deaf to a value that is not a number.
         error = abs(q_error)/(scene%solver%atol*scene%q_unit + scene%solver%rtol*max(abs(motion%q), abs(q))) &
            & + abs(v_error)/(scene%solver%atol*scene%v_unit + scene%solver%rtol*max(abs(motion%v), abs(v)))
         ! A step that left the geometry has no error to judge it by. The smallest step is accepted all the same, but
         ! then it contains an event, on which it ends: the limit, since that lies within the geometry, or an impact.
         if (is_beyond(mechanism, q)) error = huge(error)
         call control_step(error, h, smallest_step*dt, motion, accepted)
         if (accepted) exit
      end do
      motion%steps = motion%steps + 1

      ! In a step too short to be told from none, signs are rounding; what happened shows in the next.
      if (h > shortest_motion*dt) &
         & call find_event(dense_rotation(h, motion%q, motion%v, motion%f, q, v, f), motion%peak, scene%limit, event, x)
      if (event /= no_event) call land(mechanism, scene, motion, h, event, x, q, v, f)
      sample_reached = parts == 1 .and. event == no_event
      motion%time = merge(dt, min(motion%time + h, dt), sample_reached)
      motion%q = q
      motion%v = v
      motion%f = f
      if (event /= no_event) call motion%limit_steps(scene%solver, dt)
   end subroutine advance

   !> From a sample or an event to the next sample there are at least as many steps as the solver asks for
   elemental subroutine limit_steps(self, solver, dt)
      !> Where the motion is: just after the sample or event
      class(motion_type), intent(inout) :: self
      !> The solver
      type(solver_type), intent(in) :: solver
      !> Sample interval [s]
      real(wp), intent(in) :: dt

      ! Longer by a little, so that rounding never asks for one step more
      real(wp), parameter :: slack = 1.0001_wp

      self%longest = huge(dt)
      ! A step too short to move the time on would be taken for ever.
      if (solver%steps_per_sample > 1) &
         & self%longest = max(shortest_motion*dt, slack*(dt - self%time)/real(solver%steps_per_sample, wp))
   end subroutine limit_steps

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

   !> Take a step again so that it ends on an event: Newton's method on the step itself, kept in a bracket by
   !> bisection, from the place found on the dense output
   pure subroutine land(mechanism, scene, motion, h, event, x, q, v, f)
      !> The mechanism
      class(mechanism_type), intent(in) :: mechanism
      !> What stays the same
      type(scene_type), intent(in) :: scene
      !> Start of the step
      type(motion_type), intent(inout) :: motion
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
         motion%evaluations = motion%evaluations + stages
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
      if (event == turning) then
         v = 0.0_wp
         if (q >= scene%limit) event = limit_reached
      end if
      f = angular_acceleration(mechanism, motion%excitation, motion%time + h, q, v)
   end subroutine land

end module dondolo_adaptive_step
