!> Pulses that overturn: closed forms of the linear block, and published thresholds with and without impacts.
!>
!> Housner (1963), Bull. Seismol. Soc. Am. 53, 403-417; Makris and Roussos (2000), Geotechnique 50, 243-262; Zhang and
!> Makris (2001), J. Eng. Mech. 127, 473-483. Digits that these do not print were computed independently by
!> quadrature or by an eighth-order method with tolerance 1e-11.
program test_pulses
   use checks, only : check, check_close, finish, suite
   use dondolo_base_kinds, only : wp
   use dondolo_motion_response, only : response_type
   use dondolo_motion_rk45, only : simulate_rk45
   use dondolo_record, only : record_type
   use dondolo_wall, only : wall_type
   use dondolo_wall_mechanism, only : mechanism_type
   use linear_block, only : linear_block_type, new_linear_block
   use motion_inputs, only : accelerogram, made, tight
   implicit none

   real(wp), parameter :: g = 9.81_wp, pi = acos(-1.0_wp)

   !> A pulse of the ground acceleration: minus amplitude times sin or cos of omega t
   type :: pulse_type
      character(len=3) :: shape
      real(wp) :: amplitude, omega, duration
   end type pulse_type

   call test_rectangles()
   call test_without_impact()
   call test_with_impacts()
   call test_published()
   call finish()

contains

   !> The pulse sampled at the ends of a number of intervals
   function sampled(pulse, intervals) result(record)
      type(pulse_type), intent(in) :: pulse
      integer, intent(in) :: intervals
      type(record_type) :: record
      real(wp) :: dt, a(0:intervals)
      integer :: i

      dt = pulse%duration/real(intervals, wp)
      if (pulse%shape == 'sin') a = [(sin(pulse%omega*dt*i), i=0, intervals)]
      if (pulse%shape == 'cos') a = [(cos(pulse%omega*dt*i), i=0, intervals)]
      record = accelerogram(-pulse%amplitude*a, dt)
   end function sampled

   !> Does a wall overturn in truth? Blocks pass their capacity and come back
   logical function overturns(mechanism, record, scale)
      class(mechanism_type), intent(in) :: mechanism
      type(record_type), intent(in) :: record
      real(wp), intent(in) :: scale
      type(response_type) :: response

      call simulate_rk45(mechanism, record, scale, tight(5.0_wp), response)
      overturns = response%collapsed
   end function overturns

   !> A threshold of overturning: the two states just below and just above it
   subroutine check_sides(mechanism, record, threshold, tolerance, above, what)
      class(mechanism_type), intent(in) :: mechanism
      type(record_type), intent(in) :: record
      real(wp), intent(in) :: threshold, tolerance
      logical, intent(in) :: above
      character(len=*), intent(in) :: what

      call check(overturns(mechanism, record, threshold*(1.0_wp + tolerance)) .eqv. above, what//', above')
      call check(overturns(mechanism, record, threshold*(1.0_wp - tolerance)) .neqv. above, what//', below')
   end subroutine check_sides

   !> The threshold of a sampled pulse next to that of the smooth one. Only one lies in so narrow a bracket
   function sampled_threshold(mechanism, pulse, intervals, near, above) result(threshold)
      class(mechanism_type), intent(in) :: mechanism
      type(pulse_type), intent(in) :: pulse
      integer, intent(in) :: intervals
      real(wp), intent(in) :: near
      logical, intent(in) :: above
      real(wp) :: threshold
      real(wp), parameter :: width = 2.0e-4_wp
      type(record_type) :: record
      real(wp) :: bounds(2)
      integer :: i

      record = sampled(pulse, intervals)
      call check_sides(mechanism, record, near, width, above, 'bracket')
      bounds = near*[1.0_wp - width, 1.0_wp + width]
      do i = 1, 24
         threshold = 0.5_wp*sum(bounds)
         bounds(merge(2, 1, overturns(mechanism, record, threshold) .eqv. above)) = threshold
      end do
   end function sampled_threshold

   !> A threshold of a smooth pulse. The chords between samples make an error of the second order: from the
   !> thresholds at 400 and 800 samples follows the one of the smooth pulse, and that 40000 samples are as good
   subroutine check_threshold(mechanism, pulse, threshold, tolerance, above, what)
      class(mechanism_type), intent(in) :: mechanism
      type(pulse_type), intent(in) :: pulse
      real(wp), intent(in) :: threshold, tolerance
      logical, intent(in) :: above
      character(len=*), intent(in) :: what
      integer, parameter :: n = 800
      real(wp) :: coarse, fine

      call check_sides(mechanism, sampled(pulse, 40000), threshold, tolerance, above, what)
      coarse = sampled_threshold(mechanism, pulse, n/2, threshold, above)
      fine = sampled_threshold(mechanism, pulse, n, threshold, above)
      call check_close((4.0_wp*fine - coarse)/3.0_wp, threshold, tolerance, what//', extrapolated')
      call check(abs(coarse - fine)/3.0_wp*(n/4.0e4_wp)**2 < 0.5_wp*tolerance*threshold, &
         & what//': the error of sampling is below the tolerance')
   end subroutine check_threshold

   !> A rectangle of duration t1 overturns the linear block if its amplitude / alpha g is 1/(1 - exp(-p t1))
   subroutine test_rectangles()
      real(wp), parameter :: t1(3) = [0.5_wp, 1.0_wp, 2.0_wp]
      real(wp), parameter :: digits(3) = [2.54149408_wp, 1.58197671_wp, 1.15651764_wp]
      real(wp), parameter :: p = 2.0_wp, unit = 0.1_wp*g
      real(wp) :: exact
      integer :: i

      call suite('rectangular pulses')
      do i = 1, 3
         exact = 1.0_wp/(1.0_wp - exp(-t1(i)))
         call check_close(exact, digits(i), 0.0_wp, 'closed form', 5.0e-9_wp)
         call check_sides(new_linear_block(p, 0.1_wp, 0.5_wp, .true.), accelerogram([-unit, -unit], t1(i)/p), exact, &
            & 1.0e-11_wp, .true., 'rectangular pulse')
      end do
   end subroutine test_rectangles

   !> Pulses that overturn the linear block without impact: the integral of p exp(-p t) a/(alpha g) from the start
   !> of rocking exceeds 1. Amplitudes in units of alpha g
   subroutine test_without_impact()
      real(wp), parameter :: p = 2.0_wp, unit = 0.1_wp*g
      real(wp), parameter :: w_sine(4) = [1.0_wp, 2.0_wp, 3.0_wp, 5.0_wp]
      real(wp), parameter :: half_sine(4) = [1.3223965979_wp, 1.8007239306_wp, 2.2938723134_wp, 3.2891467775_wp]
      real(wp), parameter :: w_cosine(3) = [2.0_wp, 3.0_wp, 4.0_wp]
      real(wp), parameter :: cosine(3) = [5.2258285268_wp, 11.4043903552_wp, 21.4613832600_wp]
      type(linear_block_type) :: block
      real(wp) :: omega
      integer :: i

      call suite('pulses without impact')
      block = new_linear_block(p, 0.1_wp, 0.5_wp, .true.)
      do i = 1, 4
         omega = w_sine(i)*p
         call check_threshold(block, pulse_type('sin', unit, omega, pi/omega), half_sine(i), 1.0e-8_wp, .true., &
            & 'half-sine pulse')
      end do
      omega = 5.0_wp*p
      call check_threshold(block, pulse_type('sin', unit, omega, 2.0_wp*pi/omega), 7.1681287971_wp, 1.0e-8_wp, .true., &
         & 'one-sine pulse')
      do i = 1, 3
         omega = w_cosine(i)*p
         call check_close((1.0_wp + w_cosine(i)**2)/(1.0_wp - exp(-2.0_wp*pi/w_cosine(i))), cosine(i), 5.0e-11_wp, &
            & 'closed form of the one-cosine pulse')
         call check_threshold(block, pulse_type('cos', unit, omega, 2.0_wp*pi/omega), cosine(i), 1.0e-8_wp, .true., &
            & 'one-cosine pulse')
      end do
   end subroutine test_without_impact

   !> Zhang and Makris, figures 7 and 8: overturning with impacts, a safe window above it, overturning without impact
   subroutine test_with_impacts()
      real(wp), parameter :: p = 2.14_wp, unit = 0.25_wp*g
      type(linear_block_type) :: block
      type(pulse_type) :: sine

      call suite('one-sine pulse with impacts')
      block = new_linear_block(p, 0.25_wp, 0.9_wp, .true.)
      sine = pulse_type('sin', unit, 5.0_wp*p, 2.0_wp*pi/(5.0_wp*p))
      call check_threshold(block, sine, 3.0186_wp, 2.0e-5_wp, .true., 'overturns with impacts')
      call check_threshold(block, sine, 6.3181_wp, 2.0e-5_wp, .false., 'safe again')
      call check_threshold(block, sine, 7.1681_wp, 2.0e-5_wp, .true., 'overturns without impact')
   end subroutine test_with_impacts

   !> Published overturning accelerations, in g
   subroutine test_published()
      type(wall_type) :: wall
      type(pulse_type) :: cosine
      real(wp) :: alpha, radius

      call suite('published overturning')
      ! Makris and Roussos, figure 2: half-sine, b = 0.2 m, h = 0.6 m, linear; they read 0.5535 to 0.5545 g.
      alpha = atan(0.2_wp/0.6_wp)
      radius = hypot(0.2_wp, 0.6_wp)
      call check_threshold(new_linear_block(sqrt(0.75_wp*g/radius), alpha, 0.5_wp, .true.), &
         & pulse_type('sin', g, 2.0_wp*pi, 0.5_wp), 0.554586_wp, 2.0e-6_wp, .true., 'half sine')
      ! Figure 11: one cosine, b = 0.5 m, h = 1.5 m, nonlinear; 0.6245 to 0.6255 g
      wall = made('free_standing', 3.0_wp, 1.0_wp, 0.85_wp)
      call check_threshold(wall%mechanism, pulse_type('cos', g, 2.0_wp*pi, 1.0_wp), 0.625845_wp, 2.0e-6_wp, .true., &
         & 'one cosine')
      ! alpha = 15 degrees, p = 2 rad/s, Housner's restitution, two seconds of A cos(pi t): the strongest of them
      alpha = pi/12.0_wp
      radius = 3.0_wp*g/16.0_wp
      wall = made('free_standing', 2.0_wp*radius*cos(alpha), 2.0_wp*radius*sin(alpha))
      cosine = pulse_type('cos', g, pi, 2.0_wp)
      call check_threshold(wall%mechanism, cosine, 0.315034018_wp, 1.0e-8_wp, .true., 'first overturning')
      call check_threshold(wall%mechanism, cosine, 0.328168_wp, 2.0e-6_wp, .false., 'safe window opens')
      call check_threshold(wall%mechanism, cosine, 0.331450_wp, 2.0e-6_wp, .true., 'safe window closes')
      call check_threshold(wall%mechanism, cosine, 0.346045_wp, 2.0e-6_wp, .false., 'second window opens')
   end subroutine test_published

end program test_pulses
