!> Errors of the C interface: a handle that keeps the first one, its code and its text. With an error in it every other procedure
!> does nothing, so that a C program may look once, at the end.
module dondolo_interface_c_error
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_int64_t, c_loc, c_null_char, c_ptr
   use dondolo_base_error, only : error_type, status_input
   use dondolo_interface_c_text, only : as_handle, as_pointer, give_text, take_text
   use dondolo_interface_handles, only : content_of, hold, release
   implicit none
   private

   public :: failure_type, is_ready, status_without_handle

   !> The object of a handle of errors
   type :: failure_type
      !> The first error since the last clearing
      type(error_type), allocatable :: error
      !> Its text as C has it
      character(kind=c_char), allocatable :: text(:)
   contains
      !> Take an error, if there is one
      procedure :: take
      !> Code of the error, 0 if there is none
      procedure :: status
   end type failure_type

   !> What procedures return that were given no handle of errors
   integer(c_int), parameter :: status_without_handle = status_input

   !> The text where there is no handle
   character(len=*), parameter :: no_handle = 'error: handle is not valid, see dondolo_new_error'//c_null_char
   integer :: k
   character(kind=c_char), target :: without_handle(len(no_handle)) = [(no_handle(k:k), k=1, len(no_handle))]

contains

   !> Is there a handle of errors, and no error in it?
   logical function is_ready(error, failure)
      !> Handle of errors
      type(c_ptr), intent(in) :: error
      !> Its object; null: it is not valid
      type(failure_type), pointer, intent(out) :: failure

      call find_failure(error, failure)
      is_ready = associated(failure)
      if (is_ready) is_ready = .not. allocated(failure%error)
   end function is_ready

   !> The object of a handle of errors
   subroutine find_failure(error, failure)
      !> Handle of errors
      type(c_ptr), intent(in) :: error
      !> Its object; null: it is not valid
      type(failure_type), pointer, intent(out) :: failure

      class(*), pointer :: content

      failure => null()
      content => content_of(as_handle(error))
      select type (content)
      type is (failure_type)
         failure => content
      end select
   end subroutine find_failure

   !> Take an error, if there is one
   subroutine take(self, error)
      class(failure_type), intent(inout) :: self
      !> The error; not allocated afterwards
      type(error_type), allocatable, intent(inout) :: error

      integer :: i

      if (.not. allocated(error)) return
      self%text = [(error%message(i:i), i=1, len(error%message)), c_null_char]
      call move_alloc(error, self%error)
   end subroutine take

   !> Code of the error, 0 if there is none
   integer(c_int) function status(self)
      class(failure_type), intent(in) :: self

      status = 0
      if (allocated(self%error)) status = self%error%stat
   end function status

   !> Make a handle of errors
   type(c_ptr) function new_error() result(error) bind(c, name='dondolo_new_error')

      type(failure_type), pointer :: failure
      class(*), pointer :: content
      integer(c_int64_t) :: handle

      allocate (failure)
      failure%text = [c_null_char]
      content => failure
      call hold(content, handle)
      error = as_pointer(handle)
   end function new_error

   !> Code of the error in a handle, 0 if there is none
   integer(c_int) function get_status(error) result(status) bind(c, name='dondolo_status')
      type(c_ptr), intent(in), value :: error

      type(failure_type), pointer :: failure

      call find_failure(error, failure)
      status = status_without_handle
      if (associated(failure)) status = failure%status()
   end function get_status

   !> Text of the error in a handle, empty if there is none; it stays until the handle takes another, is cleared or freed
   type(c_ptr) function get_message(error) result(text) bind(c, name='dondolo_message')
      type(c_ptr), intent(in), value :: error

      type(failure_type), pointer :: failure

      call find_failure(error, failure)
      text = c_loc(without_handle)
      if (associated(failure)) text = c_loc(failure%text)
   end function get_message

   !> Code, variable or place of a problem of the error in a handle; its length, -1 if there is no such problem or name
   integer(c_int) function get_problem(error, number, name, text, size) result(length) bind(c, name='dondolo_get_problem')
      type(c_ptr), intent(in), value :: error
      !> Number of the problem, from 0
      integer(c_int), intent(in), value :: number
      !> 'code', 'variable' or 'place'
      type(c_ptr), intent(in), value :: name
      !> Room for it, NULL: none, and its bytes
      type(c_ptr), intent(in), value :: text
      integer(c_int), intent(in), value :: size

      type(failure_type), pointer :: failure
      type(error_type), allocatable :: no_name
      character(len=:), allocatable :: what, found

      length = -1
      call give_text('', text, size)
      call find_failure(error, failure)
      call take_text(name, 'name', what, no_name)
      if (allocated(no_name) .or. .not. associated(failure)) return
      if (.not. allocated(failure%error)) return
      if (number < 0 .or. number >= ubound(failure%error%problem, 1)) return
      associate (problem => failure%error%problem(number + 1))
         select case (what)
         case ('code')
            found = trim(problem%code)
         case ('variable')
            found = problem%variable
         case ('place')
            found = problem%place
         case default
            return
         end select
      end associate
      length = len(found)
      call give_text(found, text, size)
   end function get_problem

   !> Take the error out of a handle
   subroutine clear_error(error) bind(c, name='dondolo_clear_error')
      type(c_ptr), intent(in), value :: error

      type(failure_type), pointer :: failure

      call find_failure(error, failure)
      if (.not. associated(failure)) return
      if (allocated(failure%error)) deallocate (failure%error)
      failure%text = [c_null_char]
   end subroutine clear_error

   !> Free the object of any handle; nothing, if it is NULL or was freed before
   subroutine free_handle(handle) bind(c, name='dondolo_free')
      type(c_ptr), intent(in), value :: handle

      call release(as_handle(handle))
   end subroutine free_handle

end module dondolo_interface_c_error
