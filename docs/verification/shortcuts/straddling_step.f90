!> One Dormand-Prince step that may cross samples: every stage interpolates the accelerogram at its own time.
!>
!> The library's step stays within one sample interval and therefore keeps its order; this one does not.
module straddling_step
   use dondolo_base_kinds, only : wp
   use dondolo_motion_dormand_prince, only : angular_acceleration, excitation_type
   use dondolo_record, only : record_type
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: step_over_samples, ground_acceleration

   !> Stages
   integer, parameter :: n = 7

   !> Nodes of the pair (Dormand and Prince 1980)
   real(wp), parameter :: c(n) = [0.0_wp, 1.0_wp/5.0_wp, 3.0_wp/10.0_wp, 4.0_wp/5.0_wp, 8.0_wp/9.0_wp, 1.0_wp, 1.0_wp]

   !> Its weights, a column each stage; the last column is the fifth order result
   real(wp), parameter :: a(n, n) = reshape([ &
      & 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
      & 1.0_wp/5.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
      & 3.0_wp/40.0_wp, 9.0_wp/40.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
      & 44.0_wp/45.0_wp, -56.0_wp/15.0_wp, 32.0_wp/9.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
      & 19372.0_wp/6561.0_wp, -25360.0_wp/2187.0_wp, 64448.0_wp/6561.0_wp, -212.0_wp/729.0_wp, &
      & 0.0_wp, 0.0_wp, 0.0_wp, &
      & 9017.0_wp/3168.0_wp, -355.0_wp/33.0_wp, 46732.0_wp/5247.0_wp, 49.0_wp/176.0_wp, -5103.0_wp/18656.0_wp, &
      & 0.0_wp, 0.0_wp, &
      & 35.0_wp/384.0_wp, 0.0_wp, 500.0_wp/1113.0_wp, 125.0_wp/192.0_wp, -2187.0_wp/6784.0_wp, 11.0_wp/84.0_wp, &
      & 0.0_wp], [n, n])

   !> Fifth order less fourth
   real(wp), parameter :: e(n) = [71.0_wp/57600.0_wp, 0.0_wp, -71.0_wp/16695.0_wp, 71.0_wp/1920.0_wp, &
      & -17253.0_wp/339200.0_wp, 22.0_wp/525.0_wp, -1.0_wp/40.0_wp]

contains

   !> One step
   pure subroutine step_over_samples(mechanism, record, side, interval, time, h, q, v, f, q_new, v_new, f_new, &
      & q_error, v_error)
      class(mechanism_type), intent(in) :: mechanism
      !> The accelerogram, scaled
      type(record_type), intent(in) :: record
      !> Side of the wall
      real(wp), intent(in) :: side
      !> Start of the step: sample interval and time since its first sample [s]
      integer, intent(in) :: interval
      real(wp), intent(in) :: time
      !> Step [s]
      real(wp), intent(in) :: h
      !> State at the start and at the end, estimate of the error
      real(wp), intent(in) :: q, v, f
      real(wp), intent(out) :: q_new, v_new, f_new, q_error, v_error

      real(wp) :: speed(n), force(n)
      integer :: i

      speed = 0.0_wp
      force = 0.0_wp
      speed(1) = v
      force(1) = f
      do i = 2, n
         speed(i) = v + h*dot_product(a(:, i), force)
         q_new = q + h*dot_product(a(:, i), speed)
         force(i) = angular_acceleration(mechanism, excitation_type(side* &
            & ground_acceleration(record, interval, time + c(i)*h)), 0.0_wp, q_new, speed(i))
      end do
      v_new = speed(n)
      f_new = force(n)
      q_error = h*dot_product(e, speed)
      v_error = h*dot_product(e, force)
   end subroutine step_over_samples

   !> The accelerogram at a time after a sample; zero after the last one [m/s2]
   pure real(wp) function ground_acceleration(record, interval, time)
      type(record_type), intent(in) :: record
      integer, intent(in) :: interval
      !> Time since the first sample of the interval [s]
      real(wp), intent(in) :: time

      integer :: i
      real(wp) :: x

      i = interval + int(time/record%dt)
      x = time/record%dt - real(int(time/record%dt), wp)
      ground_acceleration = 0.0_wp
      associate (samples => record%acceleration)
         if (i == size(samples)) ground_acceleration = samples(i)
         if (i < size(samples)) ground_acceleration = samples(i) + x*(samples(i + 1) - samples(i))
      end associate
   end function ground_acceleration

end module straddling_step
