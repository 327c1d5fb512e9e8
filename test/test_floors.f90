!> Motions of floors: exact values, limits in closed form, convergence; walls share them, whatever threads there are.
program test_floors
   use, intrinsic :: omp_lib, only : omp_get_max_threads
   use checks, only : check, check_close, check_error, check_ok, finish, suite
   use dondolo_base_error, only : error_type, problems_type
   use dondolo_base_kinds, only : pi, wp
   use dondolo_base_settings, only : group_settings_type, new_settings
   use dondolo_base_settings_check, only : check_settings
   use dondolo_building, only : building_type, diaphragm_type
   use dondolo_building_floor_motion, only : filter_record, filter_records
   use dondolo_building_floors, only : check_floor, floors_type
   use dondolo_building_input, only : building_properties, new_building, period_of_displacement, proposed_period
   use dondolo_record, only : new_record, record_type
   use dondolo_record_suite, only : new_suite, suite_type
   implicit none

   real(wp), parameter :: exact = 1.0e-12_wp

   call test_periods()
   call test_values()
   call test_limits()
   call test_convergence()
   call test_refusals()
   call test_sharing()
   call test_side_by_side()
   call test_long_record()
   call finish()

contains

   !> A building of given modes
   function building_of(period, damping, participation, refine) result(building)
      real(wp), intent(in) :: period(:), damping(:), participation(:)
      integer, intent(in) :: refine
      type(building_type) :: building

      type(group_settings_type) :: settings
      type(problems_type) :: problems

      call new_settings(settings, building_properties)
      call settings%set('period', period)
      call settings%set('damping', damping)
      call settings%set('participation', participation)
      call settings%set('refine', refine)
      call check_settings(settings, problems)
      call new_building(building, settings, problems)
      call check(problems%count == 0, 'building')
   end function building_of

   !> Motion of a floor of a building of one mode
   function floor_of(acceleration, dt, period, damping, participation, refine) result(floor)
      real(wp), intent(in) :: acceleration(:), dt, period, damping, participation
      integer, intent(in) :: refine
      type(record_type) :: floor

      type(record_type) :: ground
      type(error_type), allocatable :: error

      call new_record(ground, acceleration, dt, 'test', error)
      call check_ok(error, 'record')
      call filter_record(building_of([period], [damping], [participation], refine), ground, floor, error)
      call check_ok(error, 'floor')
   end function floor_of

   !> Periods of the first mode by the code, against an independent computation of 40 digits; a displacement gives the period
   subroutine test_periods()
      real(wp), parameter :: heights(3) = [6.0_wp, 9.0_wp, 12.5_wp], &
         & expected(3) = [0.191682931273882_wp, 0.259807621135332_wp, 0.332393493559062_wp], &
         & top = 0.02_wp, of_top = 0.282842712474619_wp
      type(group_settings_type) :: settings
      type(problems_type) :: problems
      type(building_type) :: building, again
      integer :: i

      call suite('periods')
      do i = 1, size(heights)
         call check_close(proposed_period(heights(i)), expected(i), exact, '0.05 H^0.75')
      end do
      call check_close(period_of_displacement(top), of_top, exact, '2 sqrt(d)')
      call new_settings(settings, building_properties)
      call settings%set('top_displacement', top)
      call settings%set('participation', [1.2_wp])
      call settings%fill()
      call check_settings(settings, problems)
      call new_building(building, settings, problems)
      call check(problems%count == 0, 'building of a displacement')
      call check_close(building%period(1), of_top, exact, 'its period')
      ! Settings that have been filled are taken again, and a period of another building is not
      call new_building(again, settings, problems)
      call check(problems%count == 0, 'its own period')
      call settings%set('period', [0.3_wp])
      call new_building(again, settings, problems)
      call check(problems%count == 1, 'a period and a displacement')
   end subroutine test_periods

   !> Values of an independent computation, to 15 digits
   subroutine test_values()
      real(wp), parameter :: expected(6) = [0.242368726536159_wp, 1.270141621728928_wp, -1.617148261753259_wp, &
         & -1.188387990685767_wp, 1.377756139428014_wp, 1.020644044396175_wp]
      type(record_type) :: floor, other
      integer :: i

      call suite('values')
      floor = floor_of([0.0_wp, 1.0_wp, -1.0_wp, 0.0_wp], 0.05_wp, 0.2_wp, 0.05_wp, 9.0_wp/7.0_wp, 1)
      do i = 1, size(expected)
         call check_close(floor%acceleration(i + 1), expected(i), exact, 'acceleration of the floor')
      end do
      ! Parts of the steps do not change what is at their ends.
      other = floor_of([0.0_wp, 1.0_wp, -1.0_wp, 0.0_wp], 0.05_wp, 0.2_wp, 0.05_wp, 9.0_wp/7.0_wp, 7)
      do i = 1, size(expected)
         call check_close(other%acceleration(7*i + 1), expected(i), exact, 'the same at refined samples')
      end do
      call check_close(other%dt, 0.05_wp/7.0_wp, epsilon(1.0_wp), 'step')
      i = size(floor%acceleration)
      call check_close((i - 4)*0.05_wp, log(1.0e4_wp)*0.2_wp/(2.0_wp*pi*0.05_wp), 0.0_wp, 'free vibration', atol=0.05_wp)
      call check(abs(floor%acceleration(i)) < 2.0e-4_wp*maxval(abs(floor%acceleration)), 'it has died out')
   end subroutine test_values

   !> Without participation, with very short periods, and without damping
   subroutine test_limits()
      real(wp), parameter :: ground(5) = [0.3_wp, 1.0_wp, -1.5_wp, 0.2_wp, 0.0_wp]
      real(wp), parameter :: step = 0.01_wp
      type(record_type) :: record, floor, first, second
      type(error_type), allocatable :: error
      integer :: i

      call suite('limits')
      floor = floor_of(ground, step, 0.2_wp, 0.05_wp, 0.0_wp, 0)
      call check(size(floor%acceleration) == 5, 'without participation nothing is added')
      call check(all(abs(floor%acceleration - ground) <= 0.0_wp), 'it is the motion of the ground')
      floor = floor_of(ground, step, 1.0e-6_wp, 0.05_wp, 1.3_wp, 1)
      call check(maxval(abs(floor%acceleration(2:5) - ground(2:))) < 1.0e-9_wp, 'a stiff building moves with the ground')
      ! Without damping a^2 + (a'/omega)^2 of the free motion stays, here of samples a quarter of the period apart.
      floor = floor_of([ground, spread(0.0_wp, 1, 200)], step, 0.48_wp, 0.0_wp, 1.0_wp, 1)
      do i = 6, 180, 7
         call check_close(hypot(floor%acceleration(i), floor%acceleration(i + 12)), &
            & hypot(floor%acceleration(6), floor%acceleration(18)), exact, 'amplitude without damping')
      end do
      ! Modes add up.
      call new_record(record, ground, step, 'test', error)
      call filter_record(building_of([0.48_wp, 0.11_wp], [0.05_wp, 0.02_wp], [1.2_wp, -0.3_wp], 2), record, floor, error)
      call check_ok(error, 'two modes')
      first = floor_of(ground, step, 0.48_wp, 0.05_wp, 1.2_wp, 2)
      second = floor_of(ground, step, 0.11_wp, 0.02_wp, -0.3_wp, 2)
      do i = 1, 2*size(ground) - 1
         call check_close(floor%acceleration(i), first%acceleration(i) + second%acceleration(i) &
            & - 0.5_wp*(ground((i + 1)/2) + ground(i/2 + 1)), exact, 'two modes', atol=exact)
      end do
   end subroutine test_limits

   !> Straight lines between refined samples miss the motion by an error of second order, as the choice of parts says
   subroutine test_convergence()
      real(wp) :: ground(41), misses(4)
      type(building_type) :: building
      type(record_type) :: fine, coarse
      integer :: i, j, k, n

      call suite('convergence')
      ground = [(sin(0.9_wp*i)*exp(-0.05_wp*i), i=0, 40)]
      fine = floor_of(ground, 0.02_wp, 0.1_wp, 0.05_wp, 1.3_wp, 64)
      do k = 1, 4
         n = 2**k
         coarse = floor_of(ground, 0.02_wp, 0.1_wp, 0.05_wp, 1.3_wp, n)
         misses(k) = 0.0_wp
         do i = 1, 40*n
            do j = 0, 64/n - 1
               associate (part => real(j*n, wp)/64.0_wp)
                  misses(k) = max(misses(k), abs((1.0_wp - part)*coarse%acceleration(i) &
                     & + part*coarse%acceleration(i + 1) - fine%acceleration((i - 1)*(64/n) + j + 1)))
               end associate
            end do
         end do
      end do
      call check(all(abs(misses(:3)/misses(2:) - 4.0_wp) < 0.7_wp), 'order 2')
      building = building_of([0.1_wp], [0.05_wp], [1.3_wp], 0)
      call check(building%parts(0.02_wp) == ceiling(2.0_wp*pi*0.2_wp/sqrt(0.008_wp)), 'parts')
      call check(building%parts(1.0e-4_wp) == 1, 'fine records are not refined')
   end subroutine test_convergence

   !> Motions that would be too long
   subroutine test_refusals()
      type(record_type), allocatable :: records(:)
      type(suite_type) :: ground
      type(error_type), allocatable :: error

      call suite('refusals')
      allocate (records(1))
      call new_record(records(1), spread(0.0_wp, 1, 200000), 0.01_wp, 'long', error)
      call new_suite(ground, records)
      call check_floor(building_of([0.3_wp], [0.05_wp], [1.0_wp], 100), ground, error)
      call check_error(error, 'period: the motion of the floor under record ''long'' has more than 10000000 samples', &
         & 'a floor that is too long')
      deallocate (error)
      call check_floor(building_of([0.3_wp], [0.05_wp], [1.0_wp], 1), ground, error)
      call check_ok(error, 'a floor that is short enough')
   end subroutine test_refusals

   !> Walls on equal buildings get the same motions, from any number of threads
   subroutine test_sharing()
      integer, parameter :: walls = 60, kinds = 6
      type(floors_type), target :: floors
      type(suite_type), target :: ground
      type(suite_type), pointer :: motions, here
      type(record_type), allocatable :: records(:)
      type(record_type) :: floor
      type(building_type) :: building(kinds)
      type(error_type), allocatable :: error
      integer :: i, place, wrong

      call suite('sharing')
      allocate (records(2))
      call new_record(records(1), [0.0_wp, 1.0_wp, -1.0_wp, 0.0_wp], 0.05_wp, 'a', error)
      call new_record(records(2), [0.0_wp, 2.0_wp, -0.5_wp, 0.5_wp], 0.02_wp, 'b', error)
      call new_suite(ground, records)
      here => ground
      do i = 1, kinds
         ! Three buildings, each felt by two kinds of walls; the last has a diaphragm
         building(i) = building_of([0.1_wp*modulo(i, 3) + 0.1_wp], [0.05_wp], [1.0_wp], 0)
         building(i)%participation_top = [1.3_wp]
         building(i)%height = 3.0_wp
         if (modulo(i, 3) == 2) building(i)%diaphragm = diaphragm_type(0.4_wp, 0.08_wp, 1.27_wp)
         call building(i)%lean(1.5_wp + 0.1_wp*i, 9.81_wp - 0.5_wp*i)
      end do
      wrong = 0
      !$omp parallel do num_threads(max(4, omp_get_max_threads())) private(motions, floor, error, place) &
      !$omp & shared(floors, here, building) reduction(+:wrong)
      do i = 1, walls
         call floors%take(building(1 + modulo(i, kinds)), here, 1, place, motions)
         call filter_record(building(1 + modulo(i, kinds)), here%records(2), floor, error)
         if (place > kinds .or. size(motions%records(2)%acceleration) /= size(floor%acceleration)) then
            wrong = wrong + 1
         else if (any(abs(motions%records(2)%acceleration - floor%acceleration) > 0.0_wp)) then
            wrong = wrong + 1
         end if
         call floors%give_back(place)
      end do
      !$omp end parallel do
      call check(wrong == 0, 'one place for each kind of wall, and the motions of each')
   end subroutine test_sharing

   !> Records that are filtered side by side have the motions that each has alone, to the bit: of several steps and lengths, in any
   !> order, by any number of threads
   subroutine test_side_by_side()
      integer, parameter :: number = 19
      type(record_type) :: ground(number), alone
      type(record_type), allocatable :: floors(:)
      type(building_type) :: building
      type(error_type), allocatable :: error
      real(wp), allocatable :: drift(:), drifts(:)
      integer :: i, j, k, threads

      call suite('side by side')
      do i = 1, number
         call new_record(ground(i), [(sin(0.37_wp*real(j*i, wp)) + real(modulo(j, 5), wp), j=1, 2 + modulo(i*i*37, 301))], &
            & 0.004_wp*real(1 + modulo(i, 4), wp), 'r', error)
         call check_ok(error, 'record')
      end do
      do k = 1, 3
         building = building_of([0.21_wp, 0.09_wp], [0.05_wp, 0.02_wp], [1.2_wp, -0.3_wp], 0)
         building%height = 3.0_wp
         if (k > 1) building%participation_top = [1.4_wp, 0.2_wp]
         if (k > 2) building%diaphragm = diaphragm_type(0.4_wp, 0.08_wp, 1.27_wp)
         call building%lean(1.6_wp, 9.0_wp)
         do threads = 1, 4, 3
            call filter_records(building, ground(number:1:-1), threads, floors, drift)
            call check(all((drift > 0.0_wp) .eqv. k > 1), 'supports that move alike do not drift')
            do i = 1, number
               call filter_record(building, ground(i), alone, error)
               call check_ok(error, 'one record')
               associate (together => floors(number + 1 - i))
                  call check(size(together%acceleration) == size(alone%acceleration), 'as many samples')
                  call check(.not. any(abs(together%acceleration - alone%acceleration) > 0.0_wp), 'the same motion')
               end associate
            end do
            if (threads == 1) drifts = drift
            call check(.not. any(abs(drift - drifts) > 0.0_wp), 'the same drifts')
         end do
      end do
   end subroutine test_side_by_side

   !> Steps of a third of the size give the same motion: no block has a seam
   subroutine test_long_record()
      real(wp) :: acceleration(1000)
      type(record_type) :: floor, fine
      integer :: i

      call suite('long record')
      acceleration = [(sin(0.3_wp*real(i, wp))*cos(0.011_wp*real(i, wp)), i=1, size(acceleration))]
      floor = floor_of(acceleration, 0.01_wp, 0.3_wp, 0.03_wp, 1.3_wp, 1)
      fine = floor_of(acceleration, 0.01_wp, 0.3_wp, 0.03_wp, 1.3_wp, 3)
      do i = 1, size(floor%acceleration) - 1
         call check_close(floor%acceleration(i), fine%acceleration(3*i - 2), exact, 'at every sample', atol=1.0e-12_wp)
      end do
   end subroutine test_long_record

end program test_floors
