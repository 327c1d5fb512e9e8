!> Files that appear whole or not at all, whoever writes them: a part `FILE.RUN.new` beside the file is written, brought to the
!> disk, and takes its place. RUN names no other; of two that write one file the later one stays. The part is locked while it is
!> written, so that those of killed processes are known; they are removed when the file is written again.
module dondolo_files_whole_file
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_null_char, c_size_t
   use dondolo_base_error, only : error_type, raise_failure
   use dondolo_files_lock, only : new_run, run_length
   use dondolo_files_system, only : folder_of, last_separator, remove_file
   implicit none
   private

   public :: whole_file_type

   !> A file in the making
   type :: whole_file_type
      !> Name in the name of its part
      character(len=run_length) :: run = ''
      !> Paths of the file and of its part, and the descriptor that holds the lock
      character(len=:), allocatable, private :: path, part
      integer(c_int), private :: descriptor = -1
   contains
      !> Make the part, empty
      procedure :: begin
      !> Let the part take the place of the file
      procedure :: publish
      !> End, whatever has happened: the part is gone
      procedure :: close => close_file
   end type whole_file_type

   !> How often a part is made that another process takes for a dead one
   integer, parameter :: tries = 5

   interface

      integer(c_int) function c_make(path, descriptor) bind(c, name='dondolo_make_part')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int), intent(out) :: descriptor
      end function c_make

      integer(c_int) function c_publish(part, path) bind(c, name='dondolo_publish_part')
         import :: c_char, c_int
         character(kind=c_char), intent(in) :: part(*), path(*)
      end function c_publish

      subroutine c_remove_dead(folder, file) bind(c, name='dondolo_remove_dead_parts')
         import :: c_char
         character(kind=c_char), intent(in) :: folder(*), file(*)
      end subroutine c_remove_dead

      subroutine c_describe(number, text, room) bind(c, name='dondolo_describe_error')
         import :: c_char, c_int, c_size_t
         integer(c_int), value :: number
         character(kind=c_char), intent(inout) :: text(*)
         integer(c_size_t), value :: room
      end subroutine c_describe

      subroutine c_give_back(descriptor) bind(c, name='dondolo_give_back_lock')
         import :: c_int
         integer(c_int), value :: descriptor
      end subroutine c_give_back

   end interface

contains

   !> Make the part of a file, empty
   subroutine begin(self, path, error)
      class(whole_file_type), intent(inout) :: self
      !> Path of the file
      character(len=*), intent(in) :: path
      !> It cannot be written
      type(error_type), allocatable, intent(out) :: error

      integer(c_int) :: number
      integer :: i

      call c_remove_dead(folder_of(path)//c_null_char, path(last_separator(path) + 1:)//c_null_char)
      self%path = path
      do i = 1, tries
         call new_run(self%run)
         self%part = path//'.'//self%run//'.new'
         number = c_make(self%part//c_null_char, self%descriptor)
         if (number == 0) return
      end do
      self%descriptor = -1
      call refuse(path, number, error)
   end subroutine begin

   !> Bring the part to the disk, and let it take the place of the file
   subroutine publish(self, error)
      class(whole_file_type), intent(inout) :: self
      !> It cannot
      type(error_type), allocatable, intent(out) :: error

      integer(c_int) :: number

      number = c_publish(self%part//c_null_char, self%path//c_null_char)
      if (number /= 0) call refuse(self%path, number, error)
   end subroutine publish

   !> Say why a file cannot be written
   subroutine refuse(path, number, error)
      character(len=*), intent(in) :: path
      !> Number of the error of the system
      integer(c_int), intent(in) :: number
      type(error_type), allocatable, intent(out) :: error

      integer, parameter :: room = 200
      character(kind=c_char, len=room) :: text

      call c_describe(number, text, int(room, c_size_t))
      call raise_failure(error, path//': cannot be written: '//text(:index(text, c_null_char) - 1))
   end subroutine refuse

   !> End, whatever has happened: the part is gone, and its lock is given back
   subroutine close_file(self)
      class(whole_file_type), intent(inout) :: self

      if (self%descriptor < 0) return
      call remove_file(self%part)
      call c_give_back(self%descriptor)
      self%descriptor = -1
   end subroutine close_file

end module dondolo_files_whole_file
