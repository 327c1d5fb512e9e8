!> Observed orders of convergence against those of the theory (docs/theory.md, section 5).
!>
!> The walls are squat, so that the terms of the equation of motion change much along the way. Every order is read
!> from halved steps, where the error is far above rounding.
program test_convergence
   use checks, only : check, finish, suite
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_motion_dormand_prince, only : angular_acceleration, dense_rotation, dormand_prince_step, excitation_type, &
      & state_type
   use dondolo_motion_initial_state, only : initial_state_type
   use dondolo_motion_response, only : response_type, trace_type
   use dondolo_motion_rk45, only : simulate_rk45
   use dondolo_record, only : record_type
   use dondolo_wall, only : wall_type
   use dondolo_wall_mechanism, only : mechanism_type
   use linear_block, only : new_linear_block
   use motion_inputs, only : accelerogram, loose, made
   implicit none

   !> How far an observed order may be from the theory
   real(wp), parameter :: tolerance = 0.2_wp

   call test_fixed_steps()
   call test_single_step()
   call test_dense_output()
   call test_time_of_impact()
   call test_histories()
   call finish()

contains

   !> The walls of these tests
   function squat(number) result(wall)
      integer, intent(in) :: number
      type(wall_type) :: wall

      if (number == 1) wall = made('one_sided', 2.0_wp, 1.0_wp)
      if (number == 2) wall = made('two_block', 3.0_wp, 0.6_wp)
   end function squat

   !> A ground acceleration that changes along the way
   function push(mechanism) result(excitation)
      class(mechanism_type), intent(in) :: mechanism
      type(excitation_type) :: excitation

      excitation%start = -0.5_wp*mechanism%trigger_acceleration()
      excitation%slope = mechanism%trigger_acceleration()*mechanism%frequency_parameter()
   end function push

   !> The state after a number of equal steps from a fifth of the capacity; p times the duration is given
   function after_steps(mechanism, duration, steps) result(state)
      class(mechanism_type), intent(in) :: mechanism
      real(wp), intent(in) :: duration
      integer, intent(in) :: steps
      type(state_type) :: state, next
      type(excitation_type) :: excitation
      real(wp) :: h, p, ignored(2)
      integer :: i

      p = mechanism%frequency_parameter()
      h = duration/(p*steps)
      excitation = push(mechanism)
      state%q = 0.2_wp*mechanism%capacity
      state%v = 0.8_wp*p*mechanism%capacity
      state%f = angular_acceleration(mechanism, excitation, 0.0_wp, state%q, state%v)
      do i = 1, steps
         call dormand_prince_step(mechanism, excitation, h*(i - 1), h, state, next, ignored(1), ignored(2))
         state = next
      end do
   end function after_steps

   !> The order that errors at halved steps show
   subroutine check_order(errors, order, what)
      real(wp), intent(in) :: errors(:)
      integer, intent(in) :: order
      character(len=*), intent(in) :: what
      real(wp) :: observed
      integer :: i

      do i = 2, size(errors)
         observed = log(abs(errors(i - 1)/errors(i)))/log(2.0_wp)
         call check(abs(observed - order) < tolerance, what//' has order '//to_text(observed)//', should have '// &
            & to_text(order))
      end do
   end subroutine check_order

   !> Many equal steps: order five
   subroutine test_fixed_steps()
      type(wall_type) :: wall
      type(state_type) :: reference, states(4)
      integer :: i, m

      call suite('equal steps')
      do m = 1, 2
         wall = squat(m)
         reference = after_steps(wall%mechanism, 1.0_wp, 2000)
         do i = 1, size(states)
            states(i) = after_steps(wall%mechanism, 1.0_wp, 4*2**i)
         end do
         call check(all([states%q, reference%q] > 0.0_wp), 'no impact on the way')
         call check_order(states%q - reference%q, 5, 'rotation')
         call check_order(states%v - reference%v, 5, 'velocity')
      end do
   end subroutine test_fixed_steps

   !> One step: its error has order six, the embedded estimate of it, which belongs to the fourth order, five
   subroutine test_single_step()
      type(wall_type) :: wall
      type(state_type) :: start, state, reference
      type(excitation_type) :: excitation
      real(wp) :: h, q_error(4), v_error(4), q_true(4), v_true(4)
      integer :: i, m

      call suite('one step')
      do m = 1, 2
         wall = squat(m)
         start = after_steps(wall%mechanism, 1.0_wp, 0)
         excitation = push(wall%mechanism)
         do i = 1, size(q_error)
            h = 2.0_wp**(-2 - i)/wall%mechanism%frequency_parameter()
            call dormand_prince_step(wall%mechanism, excitation, 0.0_wp, h, start, state, q_error(i), v_error(i))
            reference = after_steps(wall%mechanism, h*wall%mechanism%frequency_parameter(), 500)
            q_true(i) = state%q - reference%q
            v_true(i) = state%v - reference%v
         end do
         call check_order(q_true(2:3), 6, 'error of the rotation')
         call check_order(v_true(2:3), 6, 'error of the velocity')
         call check_order(q_error, 5, 'estimate for the rotation')
         call check_order(v_error, 5, 'estimate for the velocity')
      end do
   end subroutine test_single_step

   !> Dense output: of the order of the step's own error everywhere inside it
   subroutine test_dense_output()
      type(wall_type) :: wall
      type(state_type) :: start, state, reference
      real(wp) :: h, b(0:5), errors(2), x
      integer :: i, k, m

      call suite('dense output')
      do m = 1, 2
         wall = squat(m)
         start = after_steps(wall%mechanism, 1.0_wp, 0)
         do i = 1, size(errors)
            h = 2.0_wp**(-3 - i)/wall%mechanism%frequency_parameter()
            state = after_steps(wall%mechanism, h*wall%mechanism%frequency_parameter(), 1)
            b = dense_rotation(h, start, state)
            errors(i) = 0.0_wp
            do k = 1, 15
               x = k/16.0_wp
               reference = after_steps(wall%mechanism, x*h*wall%mechanism%frequency_parameter(), 200)
               errors(i) = max(errors(i), abs(bernstein_sum(b, x) - reference%q))
            end do
         end do
         call check_order(errors, 6, 'dense output')
      end do
   end subroutine test_dense_output

   !> A polynomial by its Bernstein coefficients, by their definition
   pure real(wp) function bernstein_sum(b, x)
      real(wp), intent(in) :: b(0:5), x
      real(wp), parameter :: binomial(0:5) = [1.0_wp, 5.0_wp, 10.0_wp, 10.0_wp, 5.0_wp, 1.0_wp]
      integer :: i

      bernstein_sum = sum([(binomial(i)*b(i)*x**i*(1.0_wp - x)**(5 - i), i=0, 5)])
   end function bernstein_sum

   !> The instant and the speed of the first impact of a wall released from half its capacity: order five in the
   !> sample interval, which sets the step
   subroutine test_time_of_impact()
      type(wall_type) :: wall
      real(wp) :: reference(2), impact(2, 3)
      integer :: i, m

      call suite('instant of impact')
      do m = 0, 2
         do i = 1, size(impact, 2)
            if (m == 0) impact(:, i) = first_impact(new_linear_block(2.0_wp, 0.1_wp, 0.5_wp, .true.), 16*2**i)
            if (m > 0) wall = squat(m)
            if (m > 0) impact(:, i) = first_impact(wall%mechanism, 16*2**i)
         end do
         if (m == 0) reference = [0.5_wp*acosh(2.0_wp), -2.0_wp*0.1_wp*sqrt(0.75_wp)]
         if (m > 0) reference = first_impact(wall%mechanism, 1000)
         call check_order(impact(1, :) - reference(1), 5, 'instant')
         call check_order(impact(2, :) - reference(2), 5, 'speed')
      end do
   end subroutine test_time_of_impact

   !> Time and velocity of the first impact, with a number of samples in 1.6/p
   function first_impact(mechanism, samples) result(impact)
      class(mechanism_type), intent(in) :: mechanism
      integer, intent(in) :: samples
      real(wp) :: impact(2)
      type(response_type) :: response
      type(trace_type) :: trace
      integer :: i

      call simulate_rk45(mechanism, accelerogram(spread(0.0_wp, 1, samples + 1), &
         & 1.6_wp/(samples*mechanism%frequency_parameter())), 1.0_wp, loose(1.0_wp), response, trace, &
         & initial=initial_state_type(0.5_wp*mechanism%capacity))
      i = findloc(trace%rotation, 0.0_wp, dim=1)
      impact = [trace%time(i), trace%velocity(i)]
   end function first_impact

   !> Whole histories of the same piecewise linear accelerogram, with more and more samples on its lines. The largest
   !> rotation comes after one, two and three impacts
   subroutine test_histories()
      real(wp), parameter :: a(9, 3) = reshape([ &
         & 0.0_wp, -1.5_wp, 1.3_wp, 0.8_wp, -1.1_wp, -1.3_wp, -1.5_wp, -1.3_wp, -1.3_wp, &
         & 0.0_wp, -1.5_wp, -1.0_wp, 0.6_wp, -1.0_wp, -1.4_wp, -1.1_wp, -1.4_wp, -1.2_wp, &
         & 0.0_wp, -1.5_wp, -0.6_wp, -1.1_wp, -0.3_wp, -0.8_wp, 0.9_wp, 1.4_wp, 1.4_wp], [9, 3])
      integer, parameter :: number(3) = [1, 1, 2]
      type(wall_type) :: wall
      type(response_type) :: response, reference
      real(wp) :: edp(4)
      integer :: i, m

      call suite('whole histories')
      do m = 1, 3
         wall = squat(number(m))
         call simulate_rk45(wall%mechanism, refined(a(:, m), wall%mechanism, 256), 1.0_wp, loose(1.0_wp), reference)
         call check(reference%impacts == m .and. reference%edp > 0.1_wp, 'impacts before a peak worth the name')
         do i = 1, size(edp)
            call simulate_rk45(wall%mechanism, refined(a(:, m), wall%mechanism, 2**i), 1.0_wp, loose(1.0_wp), response)
            edp(i) = response%edp
         end do
         call check_order(edp - reference%edp, 5, 'EDP')
      end do
   end subroutine test_histories

   !> An accelerogram in units of the trigger, with each interval of 0.3/p divided into parts
   function refined(a, mechanism, parts) result(record)
      real(wp), intent(in) :: a(:)
      class(mechanism_type), intent(in) :: mechanism
      integer, intent(in) :: parts
      type(record_type) :: record
      real(wp) :: fine(0:parts*(size(a) - 1)), x
      integer :: i, j

      do i = 0, ubound(fine, 1)
         j = min(i/parts, size(a) - 2)
         x = real(i - j*parts, wp)/real(parts, wp)
         fine(i) = (1.0_wp - x)*a(j + 1) + x*a(j + 2)
      end do
      record = accelerogram(fine*mechanism%trigger_acceleration(), 0.3_wp/(parts*mechanism%frequency_parameter()))
   end function refined

end program test_convergence
