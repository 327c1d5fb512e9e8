!> One accepted step of the engine rk45: to the next sample, less where the error asks for it, or to the first
!> event on the way.
!>
!> Events - impact, turning point, limit, a level of the ties - are found on the dense output of a step; the step is then
!> taken again so that it ends on the event, which thus has the accuracy of a step (docs/theory.md, section 5).
module dondolo_motion_adaptive_step
   use dondolo_base_bracket, only : bracket_type
   use dondolo_base_kinds, only : wp
   use dondolo_motion_dormand_prince, only : angular_acceleration, dense_rotation, dormand_prince_step, excitation_type, &
      & is_beyond, state_type
   use dondolo_motion_events, only : find_event, find_level, impact, level_above, level_below, limit_reached, no_event, turning
   use dondolo_motion_history, only : history_type
   use dondolo_motion_restraint_state, only : restraint_state_type
   use dondolo_motion_step_limits, only : longest_step, shortest_motion, smallest_step
   use dondolo_motion_wall_constants, only : wall_constants_type
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: motion_type, advance
   public :: most_stalled

   !> Evaluations of the terms in a step, the first of which the step before has done
   integer, parameter :: stages = 6

   !> A history in the engine rk45
   type, extends(history_type) :: motion_type
      !> Excitation in the present sample interval
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
      !> Rotation at which joints close that bend before they open; negative: they do not [rad]
      real(wp) :: closing = -1.0_wp
      !> State of its ties and friction
      type(restraint_state_type) :: restraints
      !> Levels in a row that were reached without any time passing
      integer :: stalled = 0
      !> Does friction hold it where it is, and how often was it released in this sample interval?
      logical :: sticks = .false.
      integer :: released = 0
      !> Scaled error of the last accepted step
      real(wp) :: last_error = 1.0e-4_wp
      !> Steps taken, and evaluations of the terms
      integer :: steps = 0, evaluations = 0
   end type motion_type

   !> Levels are not looked for in the step after this many in a row that took no time: the wall balances on one of them
   integer, parameter :: most_stalled = 8

contains

   !> One accepted step: to the next sample, less where the error asks for it, or to the first event on the way
   pure subroutine advance(mechanism, constants, dt, motion, event, sample_reached)
      class(mechanism_type), intent(in) :: mechanism
      type(wall_constants_type), intent(in) :: constants
      !> Sample interval [s]
      real(wp), intent(in) :: dt
      type(motion_type), intent(inout) :: motion
      !> The event the step ends on
      integer, intent(out) :: event
      !> Does it end on the next sample?
      logical, intent(out) :: sample_reached

      type(state_type) :: start, next
      real(wp) :: remaining, h, q_error, v_error, error, x, b(0:5)
      logical :: accepted
      integer :: parts

      remaining = dt - motion%time
      event = no_event
      sample_reached = .not. remaining > 0.0_wp
      if (sample_reached) return
      start = state_type(motion%q, motion%v, motion%f)
      do
         parts = max(1, ceiling(remaining/min(motion%step, motion%longest)))
         h = remaining/real(parts, wp)
         call dormand_prince_step(mechanism, motion%excitation, motion%time, h, start, next, q_error, v_error)
         motion%evaluations = motion%evaluations + stages
         associate (rtol => constants%solver%rtol, atol => constants%solver%atol)
            ! The sum, since the maximum may drop a NaN
            error = abs(q_error)/(atol*constants%capacity + rtol*max(abs(start%q), abs(next%q))) &
               & + abs(v_error)/(atol*constants%velocity_unit + rtol*max(abs(start%v), abs(next%v)))
         end associate
         ! A step that left the geometry has no error to judge it by. The smallest step is accepted all the same, but
         ! then it contains an event, on which it ends: the limit, since that lies within the geometry, or an impact.
         if (is_beyond(mechanism, next%q)) error = huge(error)
         call control_step(error, h, smallest_step*dt, motion, accepted)
         if (accepted) exit
      end do
      motion%steps = motion%steps + 1

      ! The signs in a shorter step are rounding; the next step shows what happened.
      if (h > shortest_motion*dt) then
         b = dense_rotation(h, start, next)
         call find_event(b, motion%restraints%known_peak(mechanism, motion%peak), constants%limit, event, x)
         if (motion%restraints%exists .and. motion%stalled < most_stalled) then
            call find_level(b, motion%restraints%above, motion%restraints%below, event, x)
         else if (motion%closing > 0.0_wp) then
            call find_level(b, huge(b), motion%closing, event, x)
         end if
      end if
      if (event /= no_event) then
         call land(mechanism, constants%limit, dt, motion, h, event, x, next)
         ! What is only grazed may have hidden the event that the step has gone beyond.
         if (event == no_event .and. (next%q < 0.0_wp .or. next%q >= constants%limit)) then
            event = merge(impact, limit_reached, next%q < 0.0_wp)
            call land(mechanism, constants%limit, dt, motion, h, event, 1.0_wp, next)
         end if
      end if
      sample_reached = parts == 1 .and. event == no_event
      motion%time = merge(dt, min(motion%time + h, dt), sample_reached)
      motion%q = next%q
      motion%v = next%v
      motion%f = next%f
      if (motion%restraints%exists) motion%stalled = merge(motion%stalled + 1, 0, &
         & event >= level_above .and. h <= shortest_motion*dt)
      if (event /= no_event) motion%longest = longest_step(constants%solver%steps_per_sample, dt, motion%time)
   end subroutine advance

   !> Accept or reject a step and propose the next (PI control; Hairer, Norsett and Wanner 1993, section II.4)
   pure subroutine control_step(error, h, smallest, motion, accepted)
      !> Scaled error of the step
      real(wp), intent(in) :: error
      !> The step [s]
      real(wp), intent(in) :: h
      !> Smallest step, always accepted [s]
      real(wp), intent(in) :: smallest
      !> The motion: the proposal and the last error
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
   pure subroutine land(mechanism, limit, dt, motion, h, event, x, next)
      class(mechanism_type), intent(in) :: mechanism
      !> Rotation that counts as collapse [rad], and sample interval [s]
      real(wp), intent(in) :: limit, dt
      !> The motion at the start of the step
      type(motion_type), intent(inout) :: motion
      !> In: the whole step; out: the step to the event [s]
      real(wp), intent(inout) :: h
      !> The event; `no_event` if the step, taken again, only grazes it. A motion that begins where it turns does not turn there
      !> again: such a turn is rounding, and would be found forever, since no time passes. A wall at rest that turns as it
      !> leaves has not left: that is an impact without speed
      integer, intent(inout) :: event
      !> Its place on the dense output, as a part of the step
      real(wp), intent(in) :: x
      !> State at the end
      type(state_type), intent(inout) :: next

      integer, parameter :: most_trials = 60
      type(state_type) :: start, whole
      type(bracket_type) :: bracket
      real(wp) :: whole_step, trial, gap, rate, change, sense, level, q_error, v_error
      logical :: crossed
      integer :: i

      level = limit
      if (event == level_above) level = motion%restraints%above
      if (event == level_below) level = merge(motion%closing, motion%restraints%below, motion%closing > 0.0_wp)
      start = state_type(motion%q, motion%v, motion%f)
      whole = next
      whole_step = h
      bracket%last = h
      trial = x*h
      crossed = .false.
      sense = 1.0_wp
      if (start%v < 0.0_wp .or. (start%v == 0.0_wp .and. start%f < 0.0_wp)) sense = -1.0_wp
      do i = 1, most_trials
         call dormand_prince_step(mechanism, motion%excitation, motion%time, trial, start, next, q_error, v_error)
         motion%evaluations = motion%evaluations + stages
         ! The gap is positive before the event and falls to zero at it.
         select case (event)
         case (impact)
            gap = next%q
            rate = next%v
         case (limit_reached, level_above)
            gap = level - next%q
            rate = -next%v
         case (level_below)
            gap = next%q - level
            rate = next%v
         case default
            gap = sense*next%v
            rate = sense*next%f
         end select
         call bracket%narrow(trial, gap > 0.0_wp)
         crossed = crossed .or. .not. gap > 0.0_wp
         change = huge(change)
         if (rate < 0.0_wp) change = -gap/rate
         if (abs(change) <= sqrt(epsilon(h))*trial) exit
         if (bracket%last - bracket%first <= 2.0_wp*epsilon(h)*bracket%last) then
            change = 0.0_wp
            exit
         end if
         trial = trial + change
         if (.not. (trial > bracket%first .and. trial < bracket%last)) trial = bracket%middle()
      end do
      if (i > most_trials) change = 0.0_wp
      if (gap > 0.0_wp .and. change == 0.0_wp .and. .not. crossed) then
         ! The dense output dipped, the motion does not: the whole step was right.
         event = no_event
         return
      end if
      h = trial + change
      next%q = next%q + change*(next%v + 0.5_wp*change*next%f)
      next%v = next%v + change*next%f
      if (event == turning .and. h <= shortest_motion*dt .and. start%v == 0.0_wp) then
         if (start%q > 0.0_wp) then
            event = no_event
            h = whole_step
            next = whole
            return
         end if
         event = impact
         next%v = 0.0_wp
      end if
      if (event == impact) next%q = 0.0_wp
      if (event >= level_above) next%q = level
      if (event == turning) then
         next%v = 0.0_wp
         if (next%q >= limit) event = limit_reached
      end if
      next%f = angular_acceleration(mechanism, motion%excitation, motion%time + h, next%q, next%v)
   end subroutine land

end module dondolo_motion_adaptive_step
