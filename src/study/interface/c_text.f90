!> What crosses between C and Fortran: handles, texts and arrays.
module dondolo_interface_c_text
   use, intrinsic :: iso_c_binding, only : c_associated, c_char, c_double, c_f_pointer, c_int, c_int64_t, c_null_char, &
      & c_null_ptr, c_ptr, c_size_t
   use dondolo_base_error, only : error_type, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   implicit none
   private

   public :: as_handle, as_pointer, take_text, take_numbers, give_text, check_finite

   interface
      !> Number of characters of a text of C before the one that ends it
      pure integer(c_size_t) function strlen(text) bind(c, name='strlen')
         import :: c_ptr, c_size_t
         type(c_ptr), intent(in), value :: text
      end function strlen
   end interface

contains

   !> A pointer of C as a handle
   pure integer(c_int64_t) function as_handle(pointer)
      type(c_ptr), intent(in) :: pointer

      as_handle = transfer(pointer, as_handle)
   end function as_handle

   !> A handle as a pointer of C
   pure type(c_ptr) function as_pointer(handle)
      integer(c_int64_t), intent(in) :: handle

      as_pointer = transfer(handle, c_null_ptr)
   end function as_pointer

   !> Take a text
   subroutine take_text(given, what, text, error)
      !> A text of C
      type(c_ptr), intent(in) :: given
      !> What it is, for a message
      character(len=*), intent(in) :: what
      !> The same; empty if there is an error
      character(len=:), allocatable, intent(out) :: text
      !> It is NULL
      type(error_type), allocatable, intent(out) :: error

      character(kind=c_char), pointer :: characters(:)
      integer :: i

      text = ''
      if (.not. c_associated(given)) then
         call raise_input(error, what//': must be a string, not NULL')
         return
      end if
      call c_f_pointer(given, characters, [strlen(given)])
      deallocate (text)
      allocate (character(len=size(characters)) :: text)
      do i = 1, len(text)
         text(i:i) = characters(i)
      end do
   end subroutine take_text

   !> Take an array of numbers
   subroutine take_numbers(given, count, what, numbers, error)
      !> An array of C
      type(c_ptr), intent(in) :: given
      !> How many it has
      integer(c_int), intent(in) :: count
      !> What it is, for a message
      character(len=*), intent(in) :: what
      !> The same; none if there is an error
      real(c_double), pointer, intent(out) :: numbers(:)
      !> It is NULL or has none
      type(error_type), allocatable, intent(out) :: error

      numbers => null()
      if (count < 1) then
         call raise_input(error, what//': has '//to_text(int(count))//' values, must have 1 at least')
      else if (.not. c_associated(given)) then
         call raise_input(error, what//': must be numbers, not NULL')
      else
         call c_f_pointer(given, numbers, [count])
      end if
   end subroutine take_numbers

   !> Check that numbers are such: no NaN, no infinity
   pure subroutine check_finite(numbers, what, error)
      real(c_double), intent(in) :: numbers(:)
      !> What they are, for a message
      character(len=*), intent(in) :: what
      !> The first that is none
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      do i = 1, size(numbers)
         if (abs(numbers(i)) <= huge(1.0_wp)) cycle
         call raise_input(error, what//' = '//to_text(real(numbers(i), wp))//': must be a number')
         return
      end do
   end subroutine check_finite

   !> Give a text, cut where there is no more room
   subroutine give_text(text, given, size)
      character(len=*), intent(in) :: text
      !> Room of C for it; NULL: none
      type(c_ptr), intent(in) :: given
      !> Its bytes, the one that ends the text included
      integer(c_int), intent(in) :: size

      character(kind=c_char), pointer :: characters(:)
      integer :: i, length

      if (.not. c_associated(given) .or. size < 1) return
      call c_f_pointer(given, characters, [size])
      length = min(len(text), int(size) - 1)
      do i = 1, length
         characters(i) = text(i:i)
      end do
      characters(length + 1) = c_null_char
   end subroutine give_text

end module dondolo_interface_c_text
