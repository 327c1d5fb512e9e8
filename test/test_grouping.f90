!> Histories are independent: any number of threads and any grouping give the same responses to the bit.
!>
!> Arguments: number of random walls, and number of the first
program test_grouping
   use checks, only : check, check_ok, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_fragility_scaling, only : new_scaling, scaling_type
   use dondolo_fragility_stripes, only : plan_stripes, run_histories, stripes_type
   use dondolo_fragility_study, only : new_study, study_type
   use dondolo_motion_lane_variants, only : build_variant
   use dondolo_motion_solver, only : solver_type
   use dondolo_record, only : record_type
   use dondolo_record_dead_channel, only : check_motion
   use dondolo_record_random, only : new_random, random_type
   use dondolo_record_suite, only : suite_type
   use dondolo_wall, only : wall_type
   use random_history, only : across, argument, between, choice, random_record, random_solver, random_wall
   use same_response, only : is_same
   use stripe_runs, only : run_stripes, suite_of
   implicit none

   integer :: i, walls, first

   walls = argument(1, 25)
   first = argument(2, 1)
   call test_variant()
   call suite('threads and grouping')
   do i = first, first + walls - 1
      call test_wall(i)
   end do
   call finish()

contains

   !> All threads are told the same build variant
   subroutine test_variant()
      character(len=8) :: variant, told
      integer, parameter :: calls = 1000000
      integer :: i, others

      call suite('variant')
      variant = build_variant()
      others = 0
      !$omp parallel do num_threads(8) reduction(+: others) default(none) private(told) shared(variant)
      do i = 1, calls
         told = build_variant()
         if (told /= variant) others = others + 1
      end do
      !$omp end parallel do
      call check(len_trim(variant) > 0 .and. others == 0, to_text(others)//' of '//to_text(calls)//' were told another')
   end subroutine test_variant

   !> Stripes of one random wall under random records
   subroutine test_wall(number)
      integer, intent(in) :: number
      type(random_type) :: random
      type(wall_type) :: wall
      type(record_type) :: records(5)
      type(solver_type) :: solver
      type(scaling_type) :: scaling
      type(suite_type), target :: whole
      type(study_type) :: study
      type(stripes_type) :: one, other
      type(error_type), allocatable :: error
      character(len=:), allocatable :: what
      integer, parameter :: threads(3) = [2, 3, 8]
      real(wp) :: trigger, levels(6)
      integer :: j, first, last, total

      what = 'wall '//to_text(number)
      random = new_random(10000 + number, 0)
      do j = 1, 10
         trigger = random%next()
      end do
      wall = random_wall(random)
      trigger = min(wall%mechanism%trigger_acceleration(), 500.0_wp)
      do j = 1, size(records)
         ! Stripes refuse records that do not move, which chance makes too
         do
            records(j) = random_record(random, trigger, 1 + choice(random, 300))
            call check_motion(records(j), error)
            if (.not. allocated(error)) exit
         end do
      end do
      solver = random_solver(random, wall)
      levels(1) = trigger/wall%gravity*across(random, 0.5_wp, 2.0_wp)
      do j = 2, size(levels)
         levels(j) = levels(j - 1)*between(random, 1.01_wp, 1.6_wp)
      end do
      call run_stripes(one, wall, records, levels, 'pga', 'both', solver, 1)
      do j = 1, size(threads)
         call run_stripes(other, wall, records, levels, 'pga', 'both', solver, threads(j))
         call check(all(is_same(one%response, other%response)), what//' with '//to_text(threads(j))//' threads')
      end do
      call new_scaling(scaling, 'pga', error)
      call check_ok(error, what)
      whole = suite_of(records)
      call new_study(study, whole, scaling, levels, 'both', solver, threads=1)
      call plan_stripes(other, wall, study, error)
      call check_ok(error, what)
      total = size(other%ran)
      first = 1
      do while (first <= total)
         last = min(total, first + choice(random, total/2) - 1)
         call run_histories(other, wall, study, choice(random, 3), error, first, last)
         call check_ok(error, what)
         first = last + 1
      end do
      call check(all(is_same(one%response, other%response)), what//' in pieces')
   end subroutine test_wall

end program test_grouping
