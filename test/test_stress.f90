!> The motion under stress: random walls, accelerograms, scales, tolerances and limits, edges on purpose.
!> Whatever comes in, a result comes out: finite, within its limits, the same when the record is reversed twice.
program test_stress
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use checks, only : check, check_ok, finish, suite
   use dondolo_error, only : error_type
   use dondolo_kinds, only : wp
   use dondolo_random, only : new_random, random_type
   use dondolo_record, only : new_record, record_type
   use dondolo_response, only : response_type
   use dondolo_rk45, only : simulate_rk45
   use dondolo_solver, only : check_limit, solver_type
   use dondolo_text, only : to_text
   use dondolo_wall, only : mechanism_names, new_wall, wall_input_type, wall_type
   implicit none

   type(random_type) :: random
   character(len=12) :: argument
   integer :: i, histories

   ! The number of random histories can be given, for longer runs.
   histories = 3000
   call get_command_argument(1, argument)
   if (argument /= '') read (argument, *) histories
   random = new_random(20260101, 0)
   call suite('exact thresholds')
   call test_exact_thresholds()
   call suite('random histories')
   do i = 1, histories
      call test_random_history(i)
   end do
   call finish()

contains

   !> Uniform number between two bounds
   real(wp) function between(low, high)
      real(wp), intent(in) :: low, high

      between = low + (high - low)*random%next()
   end function between

   !> Number between two bounds, uniform in its logarithm
   real(wp) function across(low, high)
      real(wp), intent(in) :: low, high

      across = exp(between(log(low), log(high)))
   end function across

   !> One of n choices
   integer function choice(n)
      integer, intent(in) :: n

      choice = min(n, 1 + int(random%next()*n))
   end function choice

   !> A wall of any size, shape and restitution
   function random_wall() result(wall)
      type(wall_type) :: wall
      type(wall_input_type) :: input
      type(error_type), allocatable :: error
      real(wp), parameter :: ratios(4) = [0.0_wp, 0.5_wp, 0.99_wp, 0.9999_wp]

      input%mechanism = trim(mechanism_names(choice(3)))
      input%height = across(0.2_wp, 30.0_wp)
      input%thickness = input%height/across(2.0_wp, 60.0_wp)
      if (input%mechanism == 'two_block') then
         input%hinge = between(0.05_wp, 0.95_wp)
         if (choice(2) == 1) input%overburden = across(1.0_wp, 1.0e5_wp)
         input%eccentricity = between(-0.5_wp, 0.5_wp)*input%thickness
      end if
      if (choice(3) == 1) then
         input%restitution = 'constant'
         input%restitution_value = ratios(choice(4))
      else
         input%restitution_factor = between(0.5_wp, 1.0_wp)
      end if
      call new_wall(wall, input, error)
      call check_ok(error, 'random wall')
   end function random_wall

   !> Noise, plateaus, spikes, and values exactly at the threshold
   function random_record(trigger) result(record)
      real(wp), intent(in) :: trigger
      type(record_type) :: record
      type(error_type), allocatable :: error
      real(wp), allocatable :: a(:)
      real(wp) :: peak
      integer :: n, j

      n = 2
      if (choice(8) > 1) n = 2 + choice(600)
      allocate(a(n))
      peak = min(trigger*across(0.5_wp, 50.0_wp), 98.1_wp)
      if (choice(20) == 1) peak = 9.0e3_wp
      select case (choice(4))
      case (1)
         a = [(peak*between(-1.0_wp, 1.0_wp), j=1, n)]
      case (2)
         a = [(peak*sin(0.05_wp*j)*sin(0.37_wp*j)*exp(-((j - 0.4_wp*n)/(0.2_wp*n))**2), j=1, n)]
      case (3)
         ! Only -1, 0 and 1 times the trigger: the motion starts, and stops, on the edge
         a = [(trigger*real(choice(3) - 2, wp), j=1, n)]
      case default
         a = [(peak*real(choice(3) - 2, wp)*merge(1.0_wp, 0.0_wp, choice(5) == 1), j=1, n)]
      end select
      call new_record(record, a, across(5.0e-4_wp, 5.0e-2_wp), 'random', error)
      call check_ok(error, 'random record')
   end function random_record

   !> One random history
   subroutine test_random_history(number)
      integer, intent(in) :: number
      type(wall_type) :: wall
      type(record_type) :: record
      type(solver_type) :: solver
      type(response_type) :: response, again
      type(error_type), allocatable :: error
      character(len=:), allocatable :: what

      wall = random_wall()
      record = random_record(min(wall%mechanism%trigger_acceleration(), 9.0e3_wp))
      solver%rtol = across(1.0e-12_wp, 1.0e-3_wp)
      solver%atol = 0.01_wp*solver%rtol
      solver%edp_limit = across(0.01_wp, 3.0_wp)
      call check_limit(solver, wall%mechanism, error)
      if (allocated(error)) solver%edp_limit = 1.0_wp
      what = ' (history '//to_text(number)//')'
      call simulate_rk45(wall%mechanism, record, 1.0_wp, solver, response)
      call check(ieee_is_finite(response%edp) .and. ieee_is_finite(response%time_of_peak), 'finite'//what)
      call check(response%edp >= 0.0_wp .and. response%edp <= solver%edp_limit, 'within the limit'//what)
      call check(response%collapsed .eqv. response%edp == solver%edp_limit, 'collapsed at the limit'//what)
      call check(response%time_of_peak >= 0.0_wp, 'time of the peak'//what)
      record%acceleration = -record%acceleration
      call simulate_rk45(wall%mechanism, record, -1.0_wp, solver, again)
      call check(again%edp == response%edp .and. again%impacts == response%impacts, 'reversed twice'//what)
      if (wall%mechanism%two_sided) then
         call simulate_rk45(wall%mechanism, record, 1.0_wp, solver, again)
         call check(again%edp == response%edp, 'symmetric'//what)
      end if
   end subroutine test_random_history

   !> A free-standing wall whose trigger is a quarter of gravity, and records whose peak is just that:
   !> to the bit, a few bits above, a few bits below
   subroutine test_exact_thresholds()
      type(wall_type) :: wall
      type(wall_input_type) :: input
      type(error_type), allocatable :: error
      type(record_type) :: record
      type(response_type) :: response
      real(wp) :: scale
      integer :: j, k

      input%mechanism = 'free_standing'
      input%height = 2.0_wp
      input%thickness = 0.5_wp
      call new_wall(wall, input, error)
      call check_ok(error, 'wall')
      do j = 1, 50
         call new_record(record, [0.0_wp, between(-1.0_wp, 1.0_wp), 1.0_wp, between(0.0_wp, 1.0_wp), 1.0_wp, 1.0_wp], &
            & across(1.0e-4_wp, 1.0e-2_wp), 'edge', error)
         call check_ok(error, 'record')
         do k = -8, 8
            scale = wall%mechanism%trigger_acceleration()*(1.0_wp + k*epsilon(scale))
            call simulate_rk45(wall%mechanism, record, scale, solver_type(), response)
            call check(response%edp >= 0.0_wp .and. response%edp < 1.0e-6_wp, 'next to nothing moves')
         end do
      end do
   end subroutine test_exact_thresholds

end program test_stress
