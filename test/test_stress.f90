!> The motion under stress: random walls, accelerograms, scales, tolerances and limits, edges on purpose.
!> Whatever comes in, a result comes out that keeps every property of test/history_properties.f90.
!>
!> Arguments: number of random histories, and number of the first, to run one again by itself. For every thousand there
!> is one with a record of up to a million samples
program test_stress
   use checks, only : check, check_ok, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_motion_response, only : response_type
   use dondolo_motion_rk45, only : simulate_rk45
   use dondolo_motion_solver, only : solver_type
   use dondolo_record, only : new_record, record_type
   use dondolo_record_random, only : new_random, random_type
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   use history_properties, only : check_properties, print_extremes
   use kept_histories, only : kept_count, kept_history
   use random_history, only : across, argument, between, history_type, new_history, random_record
   use same_response, only : is_same
   implicit none

   type(history_type) :: history
   character(len=60) :: what
   integer :: i, histories, first

   histories = argument(1, 3000)
   first = argument(2, 1)
   call suite('exact thresholds')
   call test_exact_thresholds()
   call suite('kept histories')
   do i = 1, merge(kept_count, 0, first == 1)
      call kept_history(i, history, what)
      call check_properties(history, to_text(i)//', '//trim(what))
   end do
   call suite('random histories')
   do i = first, first + histories - 1
      call check_properties(new_history(i), 'history '//to_text(i))
   end do
   call suite('long records')
   do i = first, first + histories/1000 - 1
      call test_long_record(i)
   end do
   call print_extremes()
   call finish()

contains

   !> A long record, mostly quiet: a random one again and again, ever weaker and with random scales
   subroutine test_long_record(number)
      integer, intent(in) :: number
      type(history_type) :: history
      type(random_type) :: random
      type(response_type) :: response, again
      real(wp), allocatable :: a(:)
      integer :: j, pieces

      history = new_history(number)
      random = new_random(number, 0)
      pieces = nint(across(random, 1.0e4_wp, 1.0e6_wp)/1000.0_wp)
      allocate(a(1000*pieces))
      do j = 1, pieces
         history%record = random_record(random, history%wall%mechanism%trigger_acceleration(), 1000)
         a(1000*j - 999:1000*j) = history%record%acceleration*across(random, 1.0e-3_wp, 1.0_wp)
      end do
      history%record%acceleration = a
      call simulate_rk45(history%wall%mechanism, history%record, history%scale, history%solver, response)
      call check(response%edp >= 0.0_wp .and. response%edp <= history%solver%edp_limit .and. &
         & (response%collapsed .eqv. response%edp == history%solver%edp_limit), 'long record '//to_text(number))
      history%record%acceleration = -2.0_wp*a
      call simulate_rk45(history%wall%mechanism, history%record, -0.5_wp*history%scale, history%solver, again)
      call check(is_same(response, again), 'long record '//to_text(number)//' reversed')
   end subroutine test_long_record

   !> A free-standing wall whose trigger is a quarter of gravity, and records whose peak is just that:
   !> to the bit, a few bits above, a few bits below
   subroutine test_exact_thresholds()
      type(wall_type) :: wall
      type(wall_input_type) :: input
      type(error_type), allocatable :: error
      type(record_type) :: record
      type(response_type) :: response
      type(random_type) :: random
      real(wp) :: scale
      integer :: j, k

      random = new_random(20260101, 0)
      call input%set('mechanism', 'free_standing')
      call input%set('height', 2.0_wp)
      call input%set('thickness', 0.5_wp)
      call new_wall(wall, input, error)
      call check_ok(error, 'wall')
      do j = 1, 50
         call new_record(record, [0.0_wp, between(random, -1.0_wp, 1.0_wp), 1.0_wp, &
            & between(random, 0.0_wp, 1.0_wp), 1.0_wp, 1.0_wp], across(random, 1.0e-4_wp, 1.0e-2_wp), 'edge', error)
         call check_ok(error, 'record')
         do k = -8, 8
            scale = wall%mechanism%trigger_acceleration()*(1.0_wp + k*epsilon(scale))
            call simulate_rk45(wall%mechanism, record, scale, solver_type(), response)
            call check(response%edp >= 0.0_wp .and. response%edp < 1.0e-6_wp, 'next to nothing moves')
         end do
      end do
   end subroutine test_exact_thresholds

end program test_stress
