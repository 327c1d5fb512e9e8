!> What went wrong, as a value: the library never prints and never stops.
!>
!> An `error_type` that is not allocated means success. The message is one sentence without a final
!> full stop; callers put the place before it (file, namelist group), so that a user reads
!> `walls.nml: &wall: thickness = -0.25: must be positive`.
module dondolo_error
   implicit none
   private

   public :: error_type, raise_input, raise_failure, add_place
   public :: status_failure, status_input

   !> The work failed while running (exit code of the executable)
   integer, parameter :: status_failure = 1

   !> What the user gave is wrong (exit code of the executable)
   integer, parameter :: status_input = 2

   !> An error: its kind and its sentence
   type :: error_type
      !> `status_failure` or `status_input`
      integer :: stat = status_failure
      !> One sentence: where, what, and what is allowed
      character(len=:), allocatable :: message
   end type error_type

contains

   !> Report wrong input
   pure subroutine raise_input(error, message)
      !> Error to allocate
      type(error_type), allocatable, intent(out) :: error
      !> Sentence for the user
      character(len=*), intent(in) :: message

      allocate(error)
      error%stat = status_input
      error%message = message
   end subroutine raise_input

   !> Report work that failed while running
   pure subroutine raise_failure(error, message)
      !> Error to allocate
      type(error_type), allocatable, intent(out) :: error
      !> Sentence for the user
      character(len=*), intent(in) :: message

      allocate(error)
      error%stat = status_failure
      error%message = message
   end subroutine raise_failure

   !> Put the place (a file, a group) before the sentence of an error, if there is one
   pure subroutine add_place(error, place)
      !> Error to extend; left alone when not allocated
      type(error_type), allocatable, intent(inout) :: error
      !> Where it happened
      character(len=*), intent(in) :: place

      if (allocated(error)) error%message = place//': '//error%message
   end subroutine add_place

end module dondolo_error
