!> Walls with ties and friction under stress: random ones under random accelerograms, whose energy must be balanced.
!>
!> Arguments: number of random histories, and number of the first, to run one again by itself
program test_tied_histories
   use checks, only : finish, suite
   use dondolo_base_text, only : to_text
   use random_history, only : argument
   use tied_history, only : check_tied_history, new_tied_history, print_ties
   implicit none

   !> Histories that failed once. Where a motion back reversed next to the largest rotation so far, friction took the wall
   !> there at once; an impact hid behind an event that was only grazed; friction awoke where a motion outwards ended, and pulled
   !> the wall back
   integer, parameter :: kept(5) = [316, 2025, 8392, 2921, 93822]
   integer :: i, first

   first = argument(2, 1)
   call suite('kept walls with ties')
   do i = 1, merge(size(kept), 0, first == 1)
      call check_tied_history(new_tied_history(kept(i)), 'tied history '//to_text(kept(i)))
   end do
   call suite('walls with ties')
   do i = first, first + argument(1, 300) - 1
      call check_tied_history(new_tied_history(i), 'tied history '//to_text(i))
   end do
   call print_ties()
   call finish()

end program test_tied_histories
