!> Suggestions for a misspelt name.
module dondolo_base_spelling
   use dondolo_base_text, only : join
   implicit none
   private

   public :: meant, say_allowed

   !> More names than this hide the one that was meant, and what a message says
   integer, parameter :: most_names = 20

   !> Letters that a hint has besides the name
   integer, parameter :: extra = len('; did you mean ''''?')

contains

   !> A hint behind a message: '; did you mean 'height'?', filled up with blanks; blank if no name is near
   pure function meant(written, names) result(hint)
      !> What was written, in lower case
      character(len=*), intent(in) :: written
      !> The names that there are
      character(len=*), intent(in) :: names(:)
      !> The hint
      character(len=len(names) + extra) :: hint

      integer :: far(size(names)), i

      hint = ''
      if (size(names) == 0) return
      far = [(distance(trim(written), trim(names(i))), i=1, size(names))]
      i = minloc(far, dim=1)
      if (far(i) <= 2 .and. 3*far(i) <= len_trim(names(i))) hint = '; did you mean '''//trim(names(i))//'''?'
   end function meant

   !> What is allowed in place of a name: one that is near, and the names, unless they are too many
   pure subroutine say_allowed(written, names, template, text)
      !> What was written, in lower case
      character(len=*), intent(in) :: written
      !> The names that there are
      character(len=*), intent(in) :: names(:)
      !> What makes dondolo print a template that has them all
      character(len=*), intent(in) :: template
      !> To follow a message
      character(len=:), allocatable, intent(out) :: text

      character(len=len(names) + extra) :: hint

      hint = meant(written, names)
      if (size(names) <= most_names) then
         text = '; there are '//join(names)//trim(hint)
      else
         if (len_trim(hint) == 0) hint = ';'
         text = trim(hint)//' dondolo '//template//' lists all'
      end if
   end subroutine say_allowed

   !> Letters that must be changed, put in, left out or swapped with the next (Damerau 1964)
   pure integer function distance(a, b)
      character(len=*), intent(in) :: a, b

      integer :: steps(0:len(a), 0:len(b)), i, j

      steps(:, 0) = [(i, i=0, len(a))]
      steps(0, :) = [(j, j=0, len(b))]
      do j = 1, len(b)
         do i = 1, len(a)
            steps(i, j) = min(steps(i - 1, j) + 1, steps(i, j - 1) + 1, steps(i - 1, j - 1) + merge(0, 1, a(i:i) == b(j:j)))
            if (i == 1 .or. j == 1) cycle
            if (a(i:i) == b(j - 1:j - 1) .and. a(i - 1:i - 1) == b(j:j)) steps(i, j) = min(steps(i, j), steps(i - 2, j - 2) + 1)
         end do
      end do
      distance = steps(len(a), len(b))
   end function distance

end module dondolo_base_spelling
