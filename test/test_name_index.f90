!> Tests of the index of names: a name is known if and only if it was added, however many there are.
program test_name_index
   use checks, only : check, finish, suite
   use dondolo_name_index, only : name_index_type
   use dondolo_text, only : to_text
   implicit none

   call test_few()
   call test_many()
   call finish()

contains

   !> Names one by one
   subroutine test_few()
      type(name_index_type) :: names
      logical :: known

      call suite('few names')
      call names%add('wall', known)
      call check(.not. known, 'the first name is new')
      call names%add('wall', known)
      call check(known, 'the same name is known')
      call names%add('Wall', known)
      call check(.not. known, 'upper case is another name')
      call names%add('', known)
      call check(.not. known, 'the empty name is new')
      call names%add('', known)
      call check(known, 'the empty name is known')
      call names%add('wall  ', known)
      call check(known, 'blanks at the end do not count')
      call names%add(' wall', known)
      call check(.not. known, 'blanks at the beginning do')
   end subroutine test_few

   !> So many that slots collide and their number grows
   subroutine test_many()
      integer, parameter :: many = 100000
      type(name_index_type) :: names
      logical :: known
      integer :: i, wrong

      call suite('many names')
      wrong = 0
      do i = 1, many
         call names%add('wall '//to_text(i), known)
         if (known) wrong = wrong + 1
      end do
      call check(wrong == 0, 'all were new')
      do i = 1, many
         call names%add('wall '//to_text(i), known)
         if (.not. known) wrong = wrong + 1
      end do
      call check(wrong == 0, 'all are known')
      call names%add('wall '//to_text(many + 1), known)
      call check(.not. known, 'one that was not added is new')
   end subroutine test_many

end program test_name_index
