!> One step of the Dormand-Prince 5(4) pair for q'' = f(t, q, q'), and the dense output of its result.
!>
!> The last stage is the acceleration at the end of the step, where the next one begins (first same as last).
!> Dormand and Prince (1980), A family of embedded Runge-Kutta formulae, J. Comput. Appl. Math. 6, 19-26.
module dondolo_dormand_prince
   use dondolo_kinds, only : wp
   use dondolo_mechanism, only : mechanism_type
   implicit none
   private

   public :: excitation_type, angular_acceleration, dormand_prince_step, dense_rotation, is_beyond

   !> What drives the motion between two samples: a ground acceleration linear in time, seen from one side
   type :: excitation_type
      !> Side of the wall, +1 or -1
      real(wp) :: side = 1.0_wp
      !> Ground acceleration at the first sample [m/s2]
      real(wp) :: start = 0.0_wp
      !> Its rate of change [m/s3]
      real(wp) :: slope = 0.0_wp
   end type excitation_type

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
   !> q'' = (Q - G - s L u_g'' - C q'^2)/J
   pure function angular_acceleration(mechanism, excitation, time, q, v) result(f)
      !> The mechanism
      class(mechanism_type), intent(in) :: mechanism
      !> What drives it
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
      f = (load - g - excitation%side*l*(excitation%start + excitation%slope*time) - c*v**2)/j
   end function angular_acceleration

   !> Does a rotation lie where the terms of a mechanism are not defined?
   pure logical function is_beyond(mechanism, q)
      !> The mechanism
      class(mechanism_type), intent(in) :: mechanism
      !> Rotation [rad]
      real(wp), intent(in) :: q

      is_beyond = q <= mechanism%lowest .or. q >= mechanism%highest
   end function is_beyond

   !> One step. If one of its stages goes beyond the geometry it ends there, with a rotation that `is_beyond`, the
   !> velocity and the acceleration of the start, and no errors: a step to be rejected
   pure subroutine dormand_prince_step(mechanism, excitation, time, h, q, v, f, q_new, v_new, f_new, q_error, v_error)
      !> The mechanism
      class(mechanism_type), intent(in) :: mechanism
      !> What drives it
      type(excitation_type), intent(in) :: excitation
      !> Time of the start since the first sample of the interval [s]
      real(wp), intent(in) :: time
      !> Step [s]
      real(wp), intent(in) :: h
      !> Rotation at the start [rad]
      real(wp), intent(in) :: q
      !> Angular velocity at the start [rad/s]
      real(wp), intent(in) :: v
      !> Angular acceleration at the start [rad/s2]
      real(wp), intent(in) :: f
      !> Rotation at the end [rad]
      real(wp), intent(out) :: q_new
      !> Angular velocity at the end [rad/s]
      real(wp), intent(out) :: v_new
      !> Angular acceleration at the end [rad/s2]
      real(wp), intent(out) :: f_new
      !> Embedded estimate of the error of the rotation [rad]
      real(wp), intent(out) :: q_error
      !> Embedded estimate of the error of the velocity [rad/s]
      real(wp), intent(out) :: v_error

      real(wp) :: v2, v3, v4, v5, v6, f2, f3, f4, f5, f6

      v_new = v
      f_new = f
      q_error = 0.0_wp
      v_error = 0.0_wp
      v2 = v + h*a21*f
      q_new = q + h*a21*v
      if (is_beyond(mechanism, q_new)) return
      f2 = angular_acceleration(mechanism, excitation, time + c2*h, q_new, v2)
      v3 = v + h*(a31*f + a32*f2)
      q_new = q + h*(a31*v + a32*v2)
      if (is_beyond(mechanism, q_new)) return
      f3 = angular_acceleration(mechanism, excitation, time + c3*h, q_new, v3)
      v4 = v + h*(a41*f + a42*f2 + a43*f3)
      q_new = q + h*(a41*v + a42*v2 + a43*v3)
      if (is_beyond(mechanism, q_new)) return
      f4 = angular_acceleration(mechanism, excitation, time + c4*h, q_new, v4)
      v5 = v + h*(a51*f + a52*f2 + a53*f3 + a54*f4)
      q_new = q + h*(a51*v + a52*v2 + a53*v3 + a54*v4)
      if (is_beyond(mechanism, q_new)) return
      f5 = angular_acceleration(mechanism, excitation, time + c5*h, q_new, v5)
      v6 = v + h*(a61*f + a62*f2 + a63*f3 + a64*f4 + a65*f5)
      q_new = q + h*(a61*v + a62*v2 + a63*v3 + a64*v4 + a65*v5)
      if (is_beyond(mechanism, q_new)) return
      f6 = angular_acceleration(mechanism, excitation, time + h, q_new, v6)
      q_new = q + h*(b1*v + b3*v3 + b4*v4 + b5*v5 + b6*v6)
      if (is_beyond(mechanism, q_new)) return
      v_new = v + h*(b1*f + b3*f3 + b4*f4 + b5*f5 + b6*f6)
      f_new = angular_acceleration(mechanism, excitation, time + h, q_new, v_new)
      v_error = h*(e1*f + e3*f3 + e4*f4 + e5*f5 + e6*f6 + e7*f_new)
      q_error = h*(e1*v + e3*v3 + e4*v4 + e5*v5 + e6*v6 + e7*v_new)
   end subroutine dormand_prince_step

   !> Dense output of the rotation: the polynomial of degree five through rotation, velocity and acceleration
   !> at both ends of a step, all of which the step knows. Its error is of the order of the step's own
   pure function dense_rotation(h, q, v, f, q_new, v_new, f_new) result(b)
      !> Step [s]
      real(wp), intent(in) :: h
      !> Rotation at the start [rad]
      real(wp), intent(in) :: q
      !> Angular velocity at the start [rad/s]
      real(wp), intent(in) :: v
      !> Angular acceleration at the start [rad/s2]
      real(wp), intent(in) :: f
      !> Rotation at the end [rad]
      real(wp), intent(in) :: q_new
      !> Angular velocity at the end [rad/s]
      real(wp), intent(in) :: v_new
      !> Angular acceleration at the end [rad/s2]
      real(wp), intent(in) :: f_new
      !> Its Bernstein coefficients over the step [rad]
      real(wp) :: b(0:5)

      b(0) = q
      b(1) = q + h*v/5.0_wp
      b(2) = q + h*(2.0_wp*v/5.0_wp + h*f/20.0_wp)
      b(3) = q_new - h*(2.0_wp*v_new/5.0_wp - h*f_new/20.0_wp)
      b(4) = q_new - h*v_new/5.0_wp
      b(5) = q_new
   end function dense_rotation

end module dondolo_dormand_prince
