!> Tests of the index of names: a name is known if and only if it was added, however many there are.
program test_name_index
   use checks, only : check, finish, suite
   use dondolo_base_text, only : to_text
   use dondolo_files_name_index, only : name_index_type
   implicit none

   call test_few()
   call test_many()
   call finish()

contains

   !> Names one by one
   subroutine test_few()
      type(name_index_type) :: names
      integer :: line

      call suite('few names')
      call names%note('wall', 1, line)
      call check(line == 0, 'the first name is new')
      call names%note('wall', 2, line)
      call check(line > 0, 'the same name is known')
      call names%note('Wall', 3, line)
      call check(line == 0, 'upper case is another name')
      call names%note('', 4, line)
      call check(line == 0, 'the empty name is new')
      call names%note('', 5, line)
      call check(line > 0, 'the empty name is known')
      call names%note('wall  ', 6, line)
      call check(line > 0, 'blanks at the end do not count')
      call names%note(' wall', 7, line)
      call check(line == 0, 'blanks at the beginning do')
   end subroutine test_few

   !> So many that slots collide and their number grows
   subroutine test_many()
      integer, parameter :: many = 100000
      type(name_index_type) :: names
      integer :: line
      integer :: i, wrong

      call suite('many names')
      wrong = 0
      do i = 1, many
         call names%note('wall '//to_text(i), i, line)
         if (line /= 0) wrong = wrong + 1
      end do
      call check(wrong == 0, 'all were new')
      do i = 1, many
         call names%note('wall '//to_text(i), i, line)
         if (line /= i) wrong = wrong + 1
      end do
      call check(wrong == 0, 'all are known')
      call names%note('wall '//to_text(many + 1), 8, line)
      call check(line == 0, 'one that was not added is new')
   end subroutine test_many

end program test_name_index
