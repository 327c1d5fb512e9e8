!> Joined records, and the search for the next sample outside a range against a plain loop over all samples.
program test_record_set
   use checks, only : check, finish, suite
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_record, only : record_type
   use dondolo_record_random, only : new_random, random_type
   use dondolo_record_set, only : new_record_set, record_set_type
   use motion_inputs, only : accelerogram
   use random_history, only : between, choice
   implicit none

   !> Around the size of a block, 64, and its multiples; the shortest records
   integer, parameter :: lengths(14) = [2, 3, 5, 63, 64, 65, 66, 127, 128, 129, 130, 192, 193, 1000]

   type(record_type) :: records(size(lengths))
   type(record_set_type) :: set
   type(random_type) :: random
   integer :: i, j, team

   random = new_random(4711, 0)
   do i = 1, size(lengths)
      records(i) = accelerogram([(between(random, -1.0_wp, 1.0_wp), j=1, lengths(i))], 0.01_wp)
   end do
   ! One thread and three join them alike
   do team = 1, 3, 2
      call new_record_set(set, records, team)
      call test_samples()
      call test_search()
   end do
   call test_single_sample()
   call test_strong_motion()
   call finish()

contains

   !> Samples one after another, two zeros after each record
   subroutine test_samples()

      call suite('samples')
      call check(size(set%samples) == sum(lengths) + 2*size(lengths), 'number of samples')
      do i = 1, size(lengths)
         call check(set%length(i) == lengths(i), 'length')
         associate (first => set%offset(i) + 1, n => lengths(i))
            call check(all(set%samples(first:first + n - 1) == records(i)%acceleration), 'record '//to_text(i))
            call check(all(set%samples(first + n:first + n + 1) == 0.0_wp), 'zeros after record '//to_text(i))
         end associate
      end do
   end subroutine test_samples

   !> Random ranges, from narrow to all that there is, both signs of the scale, every sample to begin with
   subroutine test_search()
      real(wp) :: scale, low, high
      integer :: first, found, steps

      call suite('search')
      do i = 1, size(lengths)
         found = 0
         do steps = 1, 60
            scale = merge(-1.0_wp, 1.0_wp, choice(random, 2) == 1)*between(random, 0.1_wp, 10.0_wp)
            if (steps == 1) scale = 0.0_wp
            low = -abs(scale)*random%next()**0.1_wp
            high = merge(abs(scale)*random%next()**0.1_wp, huge(high), choice(random, 2) == 1)
            ! A range that ends just on a sample, which then lies inside
            if (choice(random, 5) == 1) low = -abs(scale*records(i)%acceleration(choice(random, lengths(i))))
            do first = 1, lengths(i) + 1
               if (set%next_outside(i, first, scale, low, high) == plain(i, first, scale, low, high)) cycle
               found = found + 1
            end do
         end do
         call check(found == 0, 'length '//to_text(lengths(i))//': '//to_text(found)//' searches that differ')
      end do
   end subroutine test_search

   !> The only sample outside is found wherever it stands, and none is where there is none
   subroutine test_single_sample()
      type(record_type) :: one(1)
      type(record_set_type) :: alone
      integer, parameter :: n = 200
      integer :: place, wrong

      call suite('a single sample')
      wrong = 0
      do place = 1, n
         one(1) = accelerogram([(merge(-2.0_wp, 0.5_wp, j == place), j=1, n)], 0.01_wp)
         call new_record_set(alone, one)
         if (alone%next_outside(1, 1, 1.0_wp, -1.0_wp, huge(1.0_wp)) /= place) wrong = wrong + 1
         if (alone%next_outside(1, place, 1.0_wp, -1.0_wp, huge(1.0_wp)) /= place) wrong = wrong + 1
         if (alone%next_outside(1, place + 1, 1.0_wp, -1.0_wp, huge(1.0_wp)) /= n + 1) wrong = wrong + 1
         if (alone%next_outside(1, 1, 1.0_wp, -2.0_wp, huge(1.0_wp)) /= n + 1) wrong = wrong + 1
         ! Reversed it pushes to the other side.
         if (alone%next_outside(1, 1, -1.0_wp, -1.0_wp, huge(1.0_wp)) /= n + 1) wrong = wrong + 1
         if (alone%next_outside(1, 1, -1.0_wp, -1.0_wp, 1.0_wp) /= place) wrong = wrong + 1
      end do
      call check(wrong == 0, to_text(wrong)//' wrong places')
   end subroutine test_single_sample

   !> A loop over all samples
   pure integer function plain(record, first, scale, low, high) result(sample)
      integer, intent(in) :: record, first
      real(wp), intent(in) :: scale, low, high

      do sample = first, lengths(record)
         associate (a => scale*records(record)%acceleration(sample))
            if (a < low .or. a > high) return
         end associate
      end do
   end function plain

   !> Blocks of 64 samples from the first to the last with a sample of a tenth of the largest
   subroutine test_strong_motion()
      type(record_type) :: record
      real(wp) :: a(500)

      call suite('strong motion')
      a = 0.099_wp
      a(130) = -1.0_wp
      record = accelerogram(a, 0.01_wp)
      call new_record_set(set, [record])
      call check(set%strong_blocks(1) == 1, 'one block')
      a(64) = 0.1_wp
      a(449) = -0.2_wp
      a(500) = 0.0_wp
      record = accelerogram(a, 0.01_wp)
      call new_record_set(set, [record])
      call check(set%strong_blocks(1) == 8, 'from the first to the last')
      a = 0.0_wp
      record = accelerogram(a, 0.01_wp)
      call new_record_set(set, [record])
      call check(set%strong_blocks(1) == 8, 'all of still ground')
   end subroutine test_strong_motion

end program test_record_set
