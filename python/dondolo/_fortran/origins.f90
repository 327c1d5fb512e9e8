!> Whose files are: what may be replaced, and what a run replaces.
module origins
   use, intrinsic :: iso_c_binding, only : c_int, c_int64_t
   use dondolo_boundary, only : report
   use dondolo_error, only : error_type
   use dondolo_origin, only : check => check_replaced, mark_of => derived_mark
   use dondolo_parcel, only : parcel_type, send
   use dondolo_replaced, only : describe_replaced, list_outdated
   implicit none
   private

   public :: check_replaced, derived_mark, replaced, outdated

contains

   !> May a file be replaced by one of a kind, a word of dondolo_origin?
   subroutine check_replaced(path, kind, stat, message)
      character(len=*), intent(in) :: path, kind
      integer(c_int), intent(out) :: stat
      character(len=2048), intent(out) :: message
      type(error_type), allocatable :: error

      call check(path, kind, error)
      call report(error, stat, message)
   end subroutine check_replaced

   !> The mark of a file that is made of the results of a run, or of none if its name is blank
   subroutine derived_mark(kind, run, mark)
      character(len=*), intent(in) :: kind, run
      character(len=128), intent(out) :: mark

      mark = mark_of(kind, run)
   end subroutine derived_mark

   !> Whose results with a prefix a run would replace: one line, or none
   subroutine replaced(prefix, sent, stat, message)
      character(len=*), intent(in) :: prefix
      integer(c_int64_t), intent(out) :: sent(4)
      integer(c_int), intent(out) :: stat
      character(len=2048), intent(out) :: message
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      call describe_replaced(prefix, parcel%lines)
      call send(parcel, error, sent, stat, message)
   end subroutine replaced

   !> What was made of other results than those with a prefix: a line for each file
   subroutine outdated(prefix, sent, stat, message)
      character(len=*), intent(in) :: prefix
      integer(c_int64_t), intent(out) :: sent(4)
      integer(c_int), intent(out) :: stat
      character(len=2048), intent(out) :: message
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      call list_outdated(prefix, parcel%lines)
      call send(parcel, error, sent, stat, message)
   end subroutine outdated

end module origins
