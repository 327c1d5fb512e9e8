!> Limits on the length of a step, shared by the engines.
module dondolo_motion_step_limits
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: fewest_steps, shortest_motion, smallest_step
   public :: longest_step, most_steps

   !> Fraction of the sample interval below which a motion is treated as rest, and a step as no step
   real(wp), parameter :: shortest_motion = 1.0e3_wp*epsilon(1.0_wp)

   !> Fraction of the sample interval below which the error control does not shorten a step
   real(wp), parameter :: smallest_step = 2.0_wp**(-20)

   !> Steps from one sample to the next of which a history may always take as many
   integer, parameter :: fewest_steps = nint(1.0_wp/smallest_step)

contains

   !> Longest step from a sample or an event to the next sample, so that there are at least `steps_per_sample` [s]
   elemental real(wp) function longest_step(steps_per_sample, dt, time)
      !> Least number of steps, as the solver demands it
      integer, intent(in) :: steps_per_sample
      !> Sample interval [s]
      real(wp), intent(in) :: dt
      !> Time of the sample or event since the last sample [s]
      real(wp), intent(in) :: time

      ! Slightly longer, so that rounding never adds a step
      real(wp), parameter :: slack = 1.0001_wp

      longest_step = huge(dt)
      ! A step too short to advance the time would be repeated forever.
      if (steps_per_sample > 1) then
         longest_step = max(shortest_motion*dt, slack*(dt - time)/real(steps_per_sample, wp))
      end if
   end function longest_step

   !> Most steps and events of a history from one sample to the next, after which it is given up, far more than any needs: as many
   !> as smallest steps, while the guard of low bounces (dondolo_motion_rest) follows 20 000, and those that a smooth motion takes a
   !> radian at the tightest tolerances
   elemental integer function most_steps(dt, rate)
      !> Sample interval [s]
      real(wp), intent(in) :: dt
      !> Largest natural frequency of the wall [rad/s]
      real(wp), intent(in) :: rate

      real(wp), parameter :: largest = 1.0e9_wp, steps_of_radian = 10.0_wp*epsilon(1.0_wp)**(-0.2_wp)

      most_steps = int(min(largest, fewest_steps + steps_of_radian*rate*dt))
   end function most_steps

end module dondolo_motion_step_limits
