!> Variables as namelist text: `name = value`, for the echo of a case.
module dondolo_assignment
   use dondolo_kinds, only : wp
   use dondolo_text, only : to_text
   implicit none
   private

   public :: assignment_text

   !> `name = value`
   interface assignment_text
      module procedure :: text_assignment
      module procedure :: real_assignment
      module procedure :: integer_assignment
      module procedure :: list_assignment
      module procedure :: logical_assignment
   end interface assignment_text

contains

   !> A text in quotes
   pure function text_assignment(name, value) result(text)
      !> Name of the variable
      character(len=*), intent(in) :: name
      !> Its value
      character(len=*), intent(in) :: value
      !> name = 'value', quotes inside doubled
      character(len=:), allocatable :: text

      integer :: i, at

      text = name//' = '''//repeat('''', count([(value(i:i) == '''', i=1, len(value))]) + len(value) + 1)
      at = len(name) + 4
      do i = 1, len(value)
         at = at + 1
         text(at:at) = value(i:i)
         if (value(i:i) == '''') at = at + 1
      end do
   end function text_assignment

   !> A real number
   pure function real_assignment(name, value) result(text)
      !> Name of the variable
      character(len=*), intent(in) :: name
      !> Its value
      real(wp), intent(in) :: value
      !> name = value
      character(len=:), allocatable :: text

      text = name//' = '//to_text(value)
   end function real_assignment

   !> An integer
   pure function integer_assignment(name, value) result(text)
      !> Name of the variable
      character(len=*), intent(in) :: name
      !> Its value
      integer, intent(in) :: value
      !> name = value
      character(len=:), allocatable :: text

      text = name//' = '//to_text(value)
   end function integer_assignment

   !> A list of real numbers
   pure function list_assignment(name, values) result(text)
      !> Name of the variable
      character(len=*), intent(in) :: name
      !> Its values
      real(wp), intent(in) :: values(:)
      !> name = value, value, ...
      character(len=:), allocatable :: text

      integer :: i

      text = name//' = '
      do i = 1, size(values)
         if (i > 1) text = text//', '
         text = text//to_text(values(i))
      end do
   end function list_assignment

   !> True or false
   pure function logical_assignment(name, value) result(text)
      !> Name of the variable
      character(len=*), intent(in) :: name
      !> Its value
      logical, intent(in) :: value
      !> name = .true. or name = .false.
      character(len=:), allocatable :: text

      text = name//' = '//trim(merge('.true. ', '.false.', value))
   end function logical_assignment

end module dondolo_assignment
