!> One step of the Dormand-Prince 5(4) pair for q'' = f(t, q, q'), and the dense output of its result.
!>
!> The last stage is the acceleration at the end of the step, where the next one begins (first same as last).
!> Dormand and Prince (1980), A family of embedded Runge-Kutta formulae, J. Comput. Appl. Math. 6, 19-26.
module dondolo_motion_dormand_prince
   use dondolo_base_kinds, only : wp
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: excitation_type, state_type
   public :: angular_acceleration, dormand_prince_step, dense_rotation, is_beyond

   !> Excitation between two samples: u = s u_g'', the ground acceleration seen from side s of the wall, and v_g''/g, the part
   !> by which vertical motion makes the wall heavier, linear in time
   type :: excitation_type
      !> u at the first sample [m/s2]
      real(wp) :: start = 0.0_wp
      !> Its rate of change [m/s3]
      real(wp) :: slope = 0.0_wp
      !> v_g''/g at the first sample, and its rate of change [1/s]
      real(wp) :: heavier = 0.0_wp, heavier_slope = 0.0_wp
   end type excitation_type

   !> State at one instant
   type :: state_type
      !> Rotation [rad]
      real(wp) :: q = 0.0_wp
      !> Angular velocity, positive outwards [rad/s]
      real(wp) :: v = 0.0_wp
      !> Angular acceleration [rad/s2]
      real(wp) :: f = 0.0_wp
   end type state_type

   ! Nodes and weights of the pair: c, a, b (fifth order) and e = b - b^ (error of the fourth)
   real(wp), parameter :: c2 = 1.0_wp/5.0_wp, c3 = 3.0_wp/10.0_wp, c4 = 4.0_wp/5.0_wp, c5 = 8.0_wp/9.0_wp
   real(wp), parameter :: a21 = 1.0_wp/5.0_wp
   real(wp), parameter :: a31 = 3.0_wp/40.0_wp, a32 = 9.0_wp/40.0_wp
   real(wp), parameter :: a41 = 44.0_wp/45.0_wp, a42 = -56.0_wp/15.0_wp, a43 = 32.0_wp/9.0_wp
   real(wp), parameter :: a51 = 19372.0_wp/6561.0_wp, a52 = -25360.0_wp/2187.0_wp
   real(wp), parameter :: a53 = 64448.0_wp/6561.0_wp, a54 = -212.0_wp/729.0_wp
   real(wp), parameter :: a61 = 9017.0_wp/3168.0_wp, a62 = -355.0_wp/33.0_wp, a63 = 46732.0_wp/5247.0_wp
   real(wp), parameter :: a64 = 49.0_wp/176.0_wp, a65 = -5103.0_wp/18656.0_wp
   real(wp), parameter :: b1 = 35.0_wp/384.0_wp, b3 = 500.0_wp/1113.0_wp, b4 = 125.0_wp/192.0_wp
   real(wp), parameter :: b5 = -2187.0_wp/6784.0_wp, b6 = 11.0_wp/84.0_wp
   real(wp), parameter :: e1 = 71.0_wp/57600.0_wp, e3 = -71.0_wp/16695.0_wp, e4 = 71.0_wp/1920.0_wp
   real(wp), parameter :: e5 = -17253.0_wp/339200.0_wp, e6 = 22.0_wp/525.0_wp, e7 = -1.0_wp/40.0_wp

contains

   !> Angular acceleration of the common form (docs/theory.md, section 1):
   !> q'' = (Q - G (1 + v_g''/g) - L u - C q'^2)/J
   pure function angular_acceleration(mechanism, excitation, time, q, v) result(f)
      class(mechanism_type), intent(in) :: mechanism
      type(excitation_type), intent(in) :: excitation
      !> Time since the first sample of the interval [s]
      real(wp), intent(in) :: time
      !> Rotation [rad]
      real(wp), intent(in) :: q
      !> Angular velocity [rad/s]
      real(wp), intent(in) :: v
      !> Angular acceleration [rad/s2]
      real(wp) :: f

      real(wp) :: j, c, g, l, load

      call mechanism%terms(q, j, c, g, l, load)
      ! Without vertical motion g is multiplied by 1, which changes no bit.
      f = (load - g*(1.0_wp + (excitation%heavier + excitation%heavier_slope*time)) &
         & - l*(excitation%start + excitation%slope*time) - c*v**2)/j
   end function angular_acceleration

   !> Does a rotation lie where the terms of a mechanism are not defined?
   pure logical function is_beyond(mechanism, q)
      class(mechanism_type), intent(in) :: mechanism
      !> Rotation [rad]
      real(wp), intent(in) :: q

      is_beyond = q <= mechanism%lowest .or. q >= mechanism%highest
   end function is_beyond

   !> One step. If one of its stages goes beyond the geometry it ends there, with a rotation that `is_beyond`, the
   !> velocity and the acceleration of the start, and no errors: a step to be rejected
   pure subroutine dormand_prince_step(mechanism, excitation, time, h, start, next, q_error, v_error)
      class(mechanism_type), intent(in) :: mechanism
      type(excitation_type), intent(in) :: excitation
      !> Time of the start since the first sample of the interval [s]
      real(wp), intent(in) :: time
      !> Step [s]
      real(wp), intent(in) :: h
      !> State at the start and at the end
      type(state_type), intent(in) :: start
      type(state_type), intent(out) :: next
      !> Embedded estimates of the errors of the rotation [rad] and of the velocity [rad/s]
      real(wp), intent(out) :: q_error, v_error

      real(wp) :: v2, v3, v4, v5, v6, f2, f3, f4, f5, f6

      q_error = 0.0_wp
      v_error = 0.0_wp
      associate (q => start%q, v => start%v, f => start%f)
         next%v = v
         next%f = f
         v2 = v + h*a21*f
         next%q = q + h*a21*v
         if (is_beyond(mechanism, next%q)) return
         f2 = angular_acceleration(mechanism, excitation, time + c2*h, next%q, v2)
         v3 = v + h*(a31*f + a32*f2)
         next%q = q + h*(a31*v + a32*v2)
         if (is_beyond(mechanism, next%q)) return
         f3 = angular_acceleration(mechanism, excitation, time + c3*h, next%q, v3)
         v4 = v + h*(a41*f + a42*f2 + a43*f3)
         next%q = q + h*(a41*v + a42*v2 + a43*v3)
         if (is_beyond(mechanism, next%q)) return
         f4 = angular_acceleration(mechanism, excitation, time + c4*h, next%q, v4)
         v5 = v + h*(a51*f + a52*f2 + a53*f3 + a54*f4)
         next%q = q + h*(a51*v + a52*v2 + a53*v3 + a54*v4)
         if (is_beyond(mechanism, next%q)) return
         f5 = angular_acceleration(mechanism, excitation, time + c5*h, next%q, v5)
         v6 = v + h*(a61*f + a62*f2 + a63*f3 + a64*f4 + a65*f5)
         next%q = q + h*(a61*v + a62*v2 + a63*v3 + a64*v4 + a65*v5)
         if (is_beyond(mechanism, next%q)) return
         f6 = angular_acceleration(mechanism, excitation, time + h, next%q, v6)
         next%q = q + h*(b1*v + b3*v3 + b4*v4 + b5*v5 + b6*v6)
         if (is_beyond(mechanism, next%q)) return
         next%v = v + h*(b1*f + b3*f3 + b4*f4 + b5*f5 + b6*f6)
         next%f = angular_acceleration(mechanism, excitation, time + h, next%q, next%v)
         v_error = h*(e1*f + e3*f3 + e4*f4 + e5*f5 + e6*f6 + e7*next%f)
         q_error = h*(e1*v + e3*v3 + e4*v4 + e5*v5 + e6*v6 + e7*next%v)
      end associate
   end subroutine dormand_prince_step

   !> Dense output of the rotation: the polynomial of degree five through rotation, velocity and acceleration at both ends
   !> of a step. Its error is of the order of the step's own
   pure function dense_rotation(h, start, next) result(b)
      !> Step [s]
      real(wp), intent(in) :: h
      !> States at its ends
      type(state_type), intent(in) :: start, next
      !> Its Bernstein coefficients over the step [rad]
      real(wp) :: b(0:5)

      b(0) = start%q
      b(1) = start%q + h*start%v/5.0_wp
      b(2) = start%q + h*(2.0_wp*start%v/5.0_wp + h*start%f/20.0_wp)
      b(3) = next%q - h*(2.0_wp*next%v/5.0_wp - h*next%f/20.0_wp)
      b(4) = next%q - h*next%v/5.0_wp
      b(5) = next%q
   end function dense_rotation

end module dondolo_motion_dormand_prince
