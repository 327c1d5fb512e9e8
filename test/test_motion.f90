!> The hybrid motion against closed forms and published results.
!>
!> Housner (1963), Bull. Seismol. Soc. Am. 53, 403-417; Makris and Roussos (2000), Geotechnique 50, 243-262; Zhang and
!> Makris (2001), J. Eng. Mech. 127, 473-483. Digits that these do not print were computed independently by
!> quadrature or by an eighth-order method with tolerance 1e-11.
program test_motion
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use checks, only : check, check_close, check_error, check_ok, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_motion_initial_state, only : initial_state_type
   use dondolo_motion_response, only : response_type, trace_type
   use dondolo_motion_rk45, only : simulate_rk45
   use dondolo_motion_simulate, only : simulate
   use dondolo_motion_solver, only : solver_type
   use dondolo_record, only : record_type
   use dondolo_wall, only : wall_type
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_single_block, only : one_sided_restitution
   use linear_block, only : new_linear_block
   use motion_inputs, only : a_wall, accelerogram, made, stillness, tight
   implicit none

   real(wp), parameter :: g = 9.81_wp, pi = acos(-1.0_wp)

   call test_free_fall()
   call test_bounces()
   call test_decay()
   call test_restart()
   call test_initial_refusals()
   call test_rest()
   call test_symmetries()
   call test_trace()
   call test_doubt()
   call test_refusals()
   call finish()

contains

   !> Time of the first impact of a wall released from a rotation, and the speed of it
   subroutine fall(mechanism, q, time, speed)
      class(mechanism_type), intent(in) :: mechanism
      real(wp), intent(in) :: q
      real(wp), intent(out) :: time, speed
      type(response_type) :: response
      type(trace_type) :: trace
      integer :: i

      call simulate_rk45(mechanism, stillness(6.0_wp), 1.0_wp, tight(1.0_wp), response, trace, initial=initial_state_type(q))
      i = findloc(trace%rotation, 0.0_wp, dim=1)
      time = trace%time(i)
      speed = abs(trace%velocity(i))
   end subroutine fall

   !> Quarter periods
   subroutine test_free_fall()
      real(wp), parameter :: phi(3) = [0.25_wp, 0.5_wp, 0.9_wp]
      real(wp), parameter :: linear(3) = [0.795365461224_wp, 1.31695789692_wp, 2.99322284613_wp]
      real(wp), parameter :: at_025(3) = [0.797982105434_wp, 1.31937581374_wp, 2.99463660388_wp]
      real(wp), parameter :: at_010(3) = [0.79578307976_wp, 1.31734420059_wp, 2.99344887551_wp]
      type(wall_type) :: wall
      real(wp) :: time, speed
      integer :: i

      call suite('free fall')
      do i = 1, 3
         call fall(new_linear_block(2.0_wp, 0.1_wp, 0.5_wp, .true.), phi(i)*0.1_wp, time, speed)
         call check_close(2.0_wp*time, linear(i), 1.0e-11_wp, 'linear p T/4')
         wall = made('free_standing', 2.0_wp*cos(0.25_wp), 2.0_wp*sin(0.25_wp))
         call fall(wall%mechanism, phi(i)*0.25_wp, time, speed)
         call check_close(wall%mechanism%frequency_parameter()*time, at_025(i), 1.0e-11_wp, 'p T/4, alpha = 0.25')
         wall = made('free_standing', 2.0_wp*cos(0.1_wp), 2.0_wp*sin(0.1_wp))
         call fall(wall%mechanism, phi(i)*0.1_wp, time, speed)
         call check_close(wall%mechanism%frequency_parameter()*time, at_010(i), 1.0e-11_wp, 'p T/4, alpha = 0.10')
      end do
      wall = made('one_sided', 3.0_wp, 0.25_wp)
      call fall(wall%mechanism, 0.5_wp*wall%model%alpha, time, speed)
      call check_close(time, 0.595788073312152_wp, 1.0e-12_wp, 'H = 3: time of fall')
      call check_close(speed, 0.159132483304546_wp, 1.0e-12_wp, 'H = 3: speed')
      wall = made('one_sided', 6.0_wp, 0.4_wp)
      call fall(wall%mechanism, 0.5_wp*wall%model%alpha, time, speed)
      call check_close(time, 0.841986836828467_wp, 1.0e-12_wp, 'H = 6: time of fall')
      call check_close(speed, 0.0901612647250664_wp, 1.0e-12_wp, 'H = 6: speed')
   end subroutine test_free_fall

   !> Decay of free rocking: amplitudes from the speeds after each impact, and the sum of the flights
   subroutine test_bounces()
      real(wp), parameter :: housner(6) = [0.445924_wp, 0.282435_wp, 0.187332_wp, 0.126901_wp, 0.086977_wp, 0.060039_wp]
      real(wp), parameter :: one_sided(3) = [0.0868391703_wp, 0.0185735566_wp, 0.0040844798_wp]
      type(response_type) :: response
      type(trace_type) :: trace
      real(wp) :: amplitude(200), time(200), expected, p, alpha, e
      integer :: i, n

      call suite('free rocking')
      p = 2.0_wp
      alpha = 0.1_wp
      e = sqrt(0.7_wp)
      call simulate_rk45(new_linear_block(p, alpha, e, .true.), stillness(12.0_wp), 1.0_wp, tight(1.0_wp), response, &
         & trace, initial=initial_state_type(0.9_wp*alpha))
      call bounces(trace, p, alpha, amplitude, time, n)
      call check(n >= 6, 'six impacts are seen')
      do i = 1, min(n, 6)
         call check_close(amplitude(i), housner(i), 0.0_wp, 'Housner''s amplitude', 6.0e-7_wp)
      end do
      call check_close(response%edp, 0.9_wp, 0.0_wp, 'the peak is where it was released')

      ! Equation (2) for alpha = 0.1 rad, -0.470655 rounded
      e = -one_sided_restitution(alpha)
      call simulate_rk45(new_linear_block(p, alpha, e, .false.), stillness(12.0_wp), 1.0_wp, tight(1.0_wp), response, &
         & trace, initial=initial_state_type(0.5_wp*alpha))
      call bounces(trace, p, alpha, amplitude, time, n)
      call check(n >= 3, 'three impacts are seen')
      do i = 1, min(n, 3)
         call check_close(amplitude(i), one_sided(i), 0.0_wp, 'one-sided amplitude', 6.0e-11_wp)
      end do
      ! Every flight lasts 2 atanh(e^n sqrt(1 - (1 - phi_0)^2))/p.
      expected = acosh(1.0_wp/0.5_wp)
      call check_close(p*time(1), expected, 1.0e-11_wp, 'first impact')
      do i = 2, n
         expected = expected + 2.0_wp*atanh(e**(i - 1)*sqrt(1.0_wp - 0.5_wp**2))
         call check_close(p*time(i), expected, 1.0e-11_wp, 'impact after the flights before')
      end do
      ! What is left of the geometric sum when the chain is closed
      do i = n + 1, 200
         expected = expected + 2.0_wp*atanh(e**(i - 1)*sqrt(1.0_wp - 0.5_wp**2))
      end do
      call check_close(expected, 2.912595889_wp, 1.0e-9_wp, 'total time to rest')
   end subroutine test_bounces

   !> Decay of walls of each mechanism, given a rotation and a velocity: after n impacts all their energy above that of rest is
   !> e^(2 n) of that at the start
   subroutine test_decay()
      type(wall_type) :: wall
      type(response_type) :: response
      type(trace_type) :: trace
      type(initial_state_type) :: initial
      type(error_type), allocatable :: error
      real(wp) :: at_start, q, v
      integer :: i, m, n

      call suite('decay of free rocking')
      do m = 1, 8
         wall = a_wall(1 + modulo(m - 1, 4))
         associate (mechanism => wall%mechanism)
            ! Outwards, and inwards
            initial%rotation = 0.3_wp*mechanism%capacity
            initial%velocity = merge(0.4_wp, -0.4_wp, m > 4)*mechanism%frequency_parameter()*mechanism%capacity
            if (mechanism%two_sided) initial = initial%times(-1.0_wp)
            trace%rows = 0
            call simulate(mechanism, stillness(8.0_wp), 1.0_wp, tight(1.0_wp), response, error, trace, initial=initial)
            call check_ok(error, 'free rocking')
            call check(trace%rotation(1) == initial%rotation .and. trace%velocity(1) == initial%velocity, 'it begins as it is told')
            at_start = above_rest(mechanism, abs(initial%rotation), initial%velocity)
            n = 0
            do i = 1, trace%rows
               if (.not. trace%after_impact(i)) cycle
               n = n + 1
               v = trace%velocity(i)
               call check_close(above_rest(mechanism, 0.0_wp, v), mechanism%restitution**(2*n)*at_start, 1.0e-9_wp, &
                  & 'energy after impacts')
               if (n == 4) exit
            end do
            call check(n == 4, 'impacts are seen')
            ! The peak: of a motion outwards the energy gives it, one inwards may rise higher than its start after an impact
            q = response%edp*mechanism%capacity
            if (initial%velocity*initial%side() < 0.0_wp) at_start = max(above_rest(mechanism, abs(initial%rotation), 0.0_wp), &
               & mechanism%restitution**2*at_start)
            call check_close(above_rest(mechanism, q, 0.0_wp), at_start, 1.0e-9_wp, 'energy of the peak')
         end associate
      end do
   end subroutine test_decay

   !> Energy above that of rest
   real(wp) function above_rest(mechanism, q, v) result(energy)
      class(mechanism_type), intent(in) :: mechanism
      real(wp), intent(in) :: q, v

      real(wp) :: j, c, g, l, load

      call mechanism%terms(q, j, c, g, l, load)
      energy = 0.5_wp*j*v**2 + mechanism%potential(q) - mechanism%potential(0.0_wp)
   end function above_rest

   !> A motion that goes on from the state at one of its samples is the same motion
   subroutine test_restart()
      type(wall_type) :: wall
      type(record_type) :: record
      type(response_type) :: whole, rest
      type(trace_type) :: trace
      type(initial_state_type) :: initial
      type(error_type), allocatable :: error
      real(wp) :: a(400)
      integer :: i, m, row, sides(2)

      call suite('a motion that goes on')
      sides = 0
      do m = 1, 4
         wall = a_wall(m)
         a = [(wall%mechanism%trigger_acceleration()*1.5_wp*sin(0.3_wp*i)*exp(-0.006_wp*i), i=1, 400)]
         record = accelerogram(a, 0.02_wp)
         trace%rows = 0
         call simulate(wall%mechanism, record, 1.0_wp, tight(1.0_wp), whole, error, trace)
         call check_ok(error, 'the whole motion')
         do i = 20, 180, 20
            row = minloc(abs(trace%time - 0.02_wp*(i - 1)), dim=1)
            if (whole%collapsed .and. 0.02_wp*(i - 1) > whole%time_of_peak) exit
            initial = initial_state_type(trace%rotation(row), trace%velocity(row))
            if (.not. initial%moves()) cycle
            sides = sides + merge(1, 0, [1.0_wp, -1.0_wp] == trace%side(row))
            call simulate(wall%mechanism, accelerogram(a(i:), 0.02_wp), 1.0_wp, tight(1.0_wp), rest, error, initial=initial)
            call check_ok(error, 'the rest of it')
            call check(rest%collapsed .eqv. whole%collapsed, 'the same end')
            if (whole%time_of_peak > 0.02_wp*(i - 1)) call check_close(rest%edp, whole%edp, 1.0e-8_wp, 'the same peak')
         end do
      end do
      call check(all(sides > 3), 'on both sides')
   end subroutine test_restart

   !> States that a wall cannot be in
   subroutine test_initial_refusals()
      type(wall_type) :: one, two
      type(solver_type) :: lanes
      real(wp) :: nan

      call suite('refused states')
      one = made('one_sided', 3.0_wp, 0.3_wp)
      two = made('free_standing', 3.0_wp, 0.3_wp)
      lanes%engine = 'lanes'
      call refuse_state(one, initial_state_type(-0.01_wp), solver_type(), 'initial_rotation = -0.01: must not be negative,')
      call refuse_state(two, initial_state_type(-0.1_wp), solver_type(), 'initial_rotation = -0.1: must lie within 0.0996')
      call refuse_state(one, initial_state_type(velocity=-0.01_wp), solver_type(), 'initial_velocity = -0.01: must not be')
      nan = ieee_value(nan, ieee_quiet_nan)
      call refuse_state(two, initial_state_type(nan), solver_type(), 'initial_rotation = NaN: must be a number')
      call refuse_state(two, initial_state_type(velocity=nan), solver_type(), 'initial_velocity = NaN: must be a number')
      call refuse_state(two, initial_state_type(0.01_wp), lanes, 'engine = ''lanes'': begins every history at rest')
      call refuse_state(two, initial_state_type(velocity=-0.01_wp), solver_type(), '')
   end subroutine test_initial_refusals

   !> A motion from a state is refused with a sentence that begins so; empty: it is not
   subroutine refuse_state(wall, initial, solver, sentence)
      type(wall_type), intent(in) :: wall
      type(initial_state_type), intent(in) :: initial
      type(solver_type), intent(in) :: solver
      character(len=*), intent(in) :: sentence

      type(response_type) :: response
      type(error_type), allocatable :: error

      call simulate(wall%mechanism, stillness(1.0_wp), 1.0_wp, solver, response, error, initial=initial)
      if (len(sentence) == 0) then
         call check_ok(error, 'allowed')
         call check(response%edp > 0.0_wp, 'it moves')
      else
         call check_error(error, sentence, 'refused state')
      end if
   end subroutine refuse_state

   !> Impacts of a trace: amplitude phi = 1 - sqrt(1 - (w/(p alpha))^2) that follows each, and its time
   subroutine bounces(trace, p, alpha, amplitude, time, n)
      type(trace_type), intent(inout) :: trace
      real(wp), intent(in) :: p, alpha
      real(wp), intent(out) :: amplitude(:), time(:)
      integer, intent(out) :: n
      integer :: i

      n = 0
      do i = 2, trace%rows
         if (.not. trace%after_impact(i)) cycle
         n = n + 1
         amplitude(n) = 1.0_wp - sqrt(1.0_wp - (trace%velocity(i)/(p*alpha))**2)
         time(n) = trace%time(i)
      end do
      trace%rows = 0
   end subroutine bounces

   !> Rest and its end
   subroutine test_rest()
      type(wall_type) :: wall
      type(response_type) :: response
      type(record_type) :: record
      real(wp) :: trigger

      call suite('rest')
      wall = made('one_sided', 3.0_wp, 0.25_wp)
      trigger = wall%mechanism%trigger_acceleration()
      record = accelerogram(-trigger*[0.0_wp, 1.0_wp, 0.0_wp, 1.0_wp], 0.01_wp)
      call simulate_rk45(wall%mechanism, record, 1.0_wp, solver_type(), response)
      call check(response%edp == 0.0_wp .and. .not. response%collapsed, 'a threshold only reached moves nothing')
      call simulate_rk45(wall%mechanism, record, 1.0_wp + 1.0e-9_wp, solver_type(), response)
      call check(response%edp > 0.0_wp, 'a threshold that is exceeded does')
      call simulate_rk45(wall%mechanism, record, -10.0_wp, solver_type(), response)
      call check(response%edp == 0.0_wp, 'pushed against its restraint a one-sided wall stays')
      ! A constant push of twice the trigger from rest: q'' = p^2 alpha at the start
      wall = made('free_standing', 3.0_wp, 0.25_wp)
      record = accelerogram(spread(2.0_wp*trigger, 1, 3), 1.0e-4_wp)
      call simulate_rk45(wall%mechanism, record, 1.0_wp, tight(1.0_wp), response)
      call check(response%edp > 0.0_wp, 'a two-sided wall opens the other side')
      call check(response%impacts == 0, 'nothing has hit anything yet')
   end subroutine test_rest

   !> What must not change a result
   subroutine test_symmetries()
      type(wall_type) :: wall
      type(response_type) :: one, other
      type(record_type) :: record, finer
      real(wp) :: a(400), b(799)
      integer :: i, m

      call suite('symmetries')
      a = [(3.0_wp*sin(0.13_wp*i)*cos(0.031_wp*i**1.1_wp)*exp(-((i - 150)/90.0_wp)**2), i=1, 400)]
      b(1::2) = a
      b(2::2) = 0.5_wp*(a(:399) + a(2:))
      record = accelerogram(a, 0.01_wp)
      finer = accelerogram(b, 0.005_wp)
      do m = 1, 3
         wall = a_wall(m)
         do i = 1, 10
            call simulate_rk45(wall%mechanism, record, 0.2_wp*i, tight(1.0_wp), one)
            call simulate_rk45(wall%mechanism, finer, 0.2_wp*i, tight(1.0_wp), other)
            call check_close(other%edp, one%edp, 0.0_wp, 'half the time step', 1.0e-9_wp)
            call simulate_rk45(wall%mechanism, accelerogram(-a, 0.01_wp), -0.2_wp*i, tight(1.0_wp), other)
            call check(other%edp == one%edp .and. other%impacts == one%impacts, 'reversed twice')
            if (.not. wall%mechanism%two_sided) cycle
            call simulate_rk45(wall%mechanism, record, -0.2_wp*i, tight(1.0_wp), other)
            call check(other%edp == one%edp, 'a two-sided wall is symmetric')
         end do
      end do
   end subroutine test_symmetries

   !> A time history agrees with the result that goes without
   subroutine test_trace()
      type(wall_type) :: wall
      type(response_type) :: one, other
      type(trace_type) :: trace
      type(record_type) :: record
      integer :: i

      call suite('time history')
      wall = made('free_standing', 2.0_wp, 0.5_wp)
      record = accelerogram([(4.0_wp*sin(0.15_wp*i), i=1, 300)], 0.01_wp)
      call simulate_rk45(wall%mechanism, record, 1.0_wp, tight(1.0_wp), one)
      call simulate_rk45(wall%mechanism, record, 1.0_wp, tight(1.0_wp), other, trace)
      call check(one%edp == other%edp .and. one%time_of_peak == other%time_of_peak, 'same result')
      call check(one%edp > 0.01_wp .and. .not. one%collapsed .and. one%impacts > 2, 'it rocks')
      call check(all(trace%time(2:) >= trace%time(:trace%rows - 1)), 'time does not go back')
      call check(maxval(abs(trace%rotation))/wall%mechanism%capacity <= one%edp + 1.0e-12_wp, 'within the peak')
      call check(maxval(abs(trace%rotation))/wall%mechanism%capacity >= 0.99_wp*one%edp, 'near the peak')
      do i = 1, 300
         if (any(abs(trace%time - 0.01_wp*(i - 1)) < 1.0e-12_wp)) cycle
         call check(.false., 'every sample has a row')
      end do
      call check(trace%rotation(trace%rows) == 0.0_wp .or. trace%time(trace%rows) >= 12.98_wp, 'until rest or 10 s')

      ! A pulse that ends while the wall is far out: it rocks on in still ground
      wall = made('free_standing', 6.0_wp, 0.9_wp)
      record = accelerogram([(2.0_wp*sin(2.0_wp*pi*0.01_wp*i), i=0, 400)], 0.01_wp)
      trace%rows = 0
      call simulate_rk45(wall%mechanism, record, 1.0_wp, tight(1.0_wp), one, trace)
      call check(count(trace%rotation == 0.0_wp .and. trace%velocity /= 0.0_wp .and. trace%time > 4.0_wp) >= 6, &
         & 'three impacts after the record')
      call check(trace%time(trace%rows) >= 13.98_wp .or. trace%velocity(trace%rows) == 0.0_wp, &
         & 'until rest or 10 s after it')
      call check(maxval(abs(trace%rotation))/wall%mechanism%capacity >= 0.999_wp*one%edp, 'the peak after the record')
      call check(count(trace%after_impact .and. trace%time <= record%duration()) == one%impacts, &
         & 'marks of impacts in the record')
      call check(count(trace%after_impact .and. trace%time > record%duration()) >= 3, 'marks of impacts after it')
   end subroutine test_trace

   !> Which results an estimated error leaves in doubt
   subroutine test_doubt()
      type(response_type) :: response

      call suite('doubt')
      response = response_type(edp=0.9_wp, edp_error=0.9e-6_wp)
      call check(.not. response%is_ill_conditioned() .and. .not. response%is_unsure(1.0_wp), 'a small error')
      response%edp_error = 1.1e-6_wp
      call check(response%is_ill_conditioned() .and. .not. response%is_unsure(1.0_wp), &
         & 'a large one, far from the limit')
      response%edp_error = 0.006_wp
      response%edp = 0.99_wp
      call check(response%is_unsure(1.0_wp) .and. .not. response%is_unsure(1.1_wp), &
         & 'twice the error reaches the limit')
      response = response_type(edp=0.3_wp, edp_error=0.02_wp)
      call check(response%is_unsure(1.0_wp), 'errors as large as the motion')
      response = response_type(edp=1.0_wp, collapsed=.true.)
      call check(.not. response%is_unsure(1.0_wp), 'both runs collapse')
      response%edp_error = 0.3_wp
      call check(response%is_unsure(1.0_wp), 'one of them does not')
   end subroutine test_doubt

   !> What no motion is computed with
   subroutine test_refusals()
      real(wp) :: nan

      call suite('refusals')
      nan = ieee_value(nan, ieee_quiet_nan)
      call refuse(solver_type(rtol=-1.0e-8_wp), 1.0_wp, 'rtol = -1e-8: ')
      call refuse(solver_type(rtol=nan), 1.0_wp, 'rtol = NaN: ')
      call refuse(solver_type(atol=0.0_wp), 1.0_wp, 'atol = 0: ')
      call refuse(solver_type(edp_limit=0.0_wp), 1.0_wp, 'edp_limit = 0: ')
      call refuse(solver_type(edp_limit=100.0_wp), 1.0_wp, 'edp_limit = 100: must be less than ')
      call refuse(solver_type(engine='fast'), 1.0_wp, 'engine = ''fast'': ')
      call refuse(solver_type(), nan, 'scale = NaN: must be a number')
   end subroutine test_refusals

   !> Check that no motion is computed with a solver and a scale
   subroutine refuse(solver, scale, sentence)
      type(solver_type), intent(in) :: solver
      real(wp), intent(in) :: scale
      character(len=*), intent(in) :: sentence
      type(wall_type) :: wall
      type(response_type) :: response
      type(error_type), allocatable :: error

      wall = a_wall(1)
      call simulate(wall%mechanism, accelerogram([0.0_wp, 5.0_wp, -5.0_wp, 0.0_wp], 0.1_wp), scale, solver, response, error)
      call check_error(error, sentence, sentence)
      call check(.not. response%edp > 0.0_wp, sentence//'no result')
   end subroutine refuse

end program test_motion
