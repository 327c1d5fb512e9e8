!> The motion of a wall whose joints are closed, in closed form between two samples (docs/theory.md, section 7):
!>
!>     x'' + 2 xi w x' + w^2 x = -(L/J) (u + u' t)
!>     x = P + Q t + exp(-xi w t) (A cos w_d t + B sin w_d t)        w_d = w sqrt(1 - xi^2)
!>
!> as Nigam and Jennings (1969) have it for spectra.
module dondolo_motion_elastic_flow
   use dondolo_base_bracket, only : bracket_type
   use dondolo_base_kinds, only : wp
   use dondolo_wall_elastic_joint, only : elastic_joint_type
   implicit none
   private

   public :: elastic_flow_type, bent_type, new_elastic_flow
   public :: at_level, at_turn, longest_angle

   !> What a place of the motion is looked for by: a rotation, or its velocity
   integer, parameter :: at_level = 0, at_turn = 1

   !> Longest part of the motion in which one turn at most is looked for, as an angle w t
   real(wp), parameter :: longest_angle = 0.4_wp

   !> State of a closed wall
   type :: bent_type
      !> Rotation, signed [rad], and its rate [rad/s]
      real(wp) :: x = 0.0_wp, v = 0.0_wp
   end type bent_type

   !> The motion from one state on, under an acceleration that is linear in time
   type :: elastic_flow_type
      private
      !> Frequency, its damped part and the rate of decay [1/s]
      real(wp) :: w = 0.0_wp, wd = 0.0_wp, decay = 0.0_wp
      !> The four constants
      real(wp) :: p = 0.0_wp, q = 0.0_wp, a = 0.0_wp, b = 0.0_wp
      !> Right side at the start [1/s2] and its rate [1/s3]
      real(wp) :: start = 0.0_wp, slope = 0.0_wp
   contains
      !> State at a time
      procedure :: at
      !> Time at which a level is reached, or the motion turns
      procedure :: time_of
   end type elastic_flow_type

contains

   !> The motion from a state on
   pure function new_elastic_flow(joint, state, acceleration, slope) result(flow)
      type(elastic_joint_type), intent(in) :: joint
      !> State at its start
      type(bent_type), intent(in) :: state
      !> Ground acceleration then [m/s2], and its rate of change [m/s3]
      real(wp), intent(in) :: acceleration, slope
      type(elastic_flow_type) :: flow

      associate (w => joint%frequency, xi => joint%damping)
         flow%w = w
         flow%wd = w*sqrt(1.0_wp - xi**2)
         flow%decay = xi*w
         flow%start = -joint%lever*acceleration
         flow%slope = -joint%lever*slope
         flow%q = flow%slope/w**2
         flow%p = (flow%start - 2.0_wp*flow%decay*flow%q)/w**2
         flow%a = state%x - flow%p
         flow%b = (state%v - flow%q + flow%decay*flow%a)/flow%wd
      end associate
   end function new_elastic_flow

   !> State at a time
   elemental function at(self, t) result(state)
      class(elastic_flow_type), intent(in) :: self
      !> Time since the start [s]
      real(wp), intent(in) :: t
      type(bent_type) :: state

      real(wp) :: c, s, fading

      fading = exp(-self%decay*t)
      c = fading*cos(self%wd*t)
      s = fading*sin(self%wd*t)
      state%x = (self%p + self%q*t) + (self%a*c + self%b*s)
      state%v = self%q + ((self%b*self%wd - self%decay*self%a)*c - (self%a*self%wd + self%decay*self%b)*s)
   end function at

   !> Time at which a level is reached, or the motion turns, between two times of which the first is before it: Newton's method,
   !> kept in the bracket by bisection
   pure function time_of(self, what, level, sense, first, last) result(t)
      class(elastic_flow_type), intent(in) :: self
      !> `at_level` or `at_turn`
      integer, intent(in) :: what
      !> The rotation, 0 for a turn [rad]
      real(wp), intent(in) :: level
      !> +1 if the rotation, or the velocity, grows there, -1 if it falls
      real(wp), intent(in) :: sense
      !> The two times [s]
      real(wp), intent(in) :: first, last
      real(wp) :: t

      integer, parameter :: most_trials = 80
      type(bracket_type) :: bracket
      type(bent_type) :: state
      real(wp) :: gap, rate, step
      integer :: i

      bracket = bracket_type(first, last)
      t = bracket%middle()
      do i = 1, most_trials
         state = self%at(t)
         if (what == at_level) then
            gap = sense*(level - state%x)
            rate = -sense*state%v
         else
            gap = -sense*state%v
            rate = -sense*(self%start + self%slope*t - 2.0_wp*self%decay*state%v - self%w**2*state%x)
         end if
         call bracket%narrow(t, gap > 0.0_wp)
         step = huge(step)
         if (rate < 0.0_wp) step = -gap/rate
         if (abs(step) <= epsilon(t)*last .or. .not. bracket%is_divisible()) return
         if (t + step > bracket%first .and. t + step < bracket%last) then
            t = t + step
         else
            t = bracket%middle()
         end if
      end do
   end function time_of

end module dondolo_motion_elastic_flow
