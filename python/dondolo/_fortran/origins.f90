!> Whose files are: what may be replaced, and what a run replaces.
module origins
   use, intrinsic :: iso_c_binding, only : c_int64_t
   use dondolo_base_error, only : error_type
   use dondolo_case_replaced, only : describe_replaced, list_outdated
   use dondolo_files_origin, only : check => check_replaced, mark_of => derived_mark
   use dondolo_parcel, only : parcel_type, report, send
   implicit none
   private

   public :: check_replaced, derived_mark, replaced, outdated

contains

   !> May a file be replaced by one of a kind, a word of dondolo_files_origin?
   subroutine check_replaced(path, kind, failure)
      character(len=*), intent(in) :: path, kind
      integer(c_int64_t), intent(out) :: failure(5)
      type(error_type), allocatable :: error

      call check(path, kind, error)
      call report(error, failure)
   end subroutine check_replaced

   !> The mark of a file that is made of the results of a run, or of none if its name is blank
   subroutine derived_mark(kind, run, mark)
      character(len=*), intent(in) :: kind, run
      character(len=128), intent(out) :: mark

      mark = mark_of(kind, run)
   end subroutine derived_mark

   !> Whose results with a prefix a run would replace: one line, or none
   subroutine replaced(prefix, sent)
      character(len=*), intent(in) :: prefix
      integer(c_int64_t), intent(out) :: sent(5)
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      call describe_replaced(prefix, parcel%lines)
      call send(parcel, error, sent)
   end subroutine replaced

   !> What was made of other results than those with a prefix: a line for each file
   subroutine outdated(prefix, sent)
      character(len=*), intent(in) :: prefix
      integer(c_int64_t), intent(out) :: sent(5)
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      call list_outdated(prefix, parcel%lines)
      call send(parcel, error, sent)
   end subroutine outdated

end module origins
