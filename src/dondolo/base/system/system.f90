!> The few things of the operating system that Fortran does not give: folders, renaming, writing that notices a full
!> disk (gfortran's own WRITE and CLOSE report success there), terminals. All are C and POSIX functions, or in files.c.
module dondolo_base_system
   use, intrinsic :: iso_c_binding, only : c_associated, c_char, c_int, c_intptr_t, c_null_char, c_long, &
      & c_null_ptr, c_ptr, c_size_t
   use, intrinsic :: iso_fortran_env, only : int64, output_unit
   implicit none
   private

   public :: make_folder, remove_folder, rename_file, remove_file, cut_file, is_folder, same_file, synchronize_folder, try_file
   public :: writer_type, stderr_is_terminal, output_arrives, outlive_file_limit

   !> A file being written
   type :: writer_type
      !> Handle of the C library
      type(c_ptr) :: handle = c_null_ptr
   contains
      !> Make a file that is not there yet
      procedure :: create
      !> Open a file to write behind what is there
      procedure :: append_to
      !> Write a text
      procedure :: write => write_text
      !> Give what was written to the system
      procedure :: flush => flush_writer
      !> Bring what was written to the disk
      procedure :: synchronize
      !> Close the file
      procedure :: close => close_writer
   end type writer_type

   interface

      !> Make a folder
      integer(c_int) function c_mkdir(path, mode) bind(c, name='mkdir')
         import :: c_char, c_int
         !> Path
         character(kind=c_char), intent(in) :: path(*)
         !> Permissions
         integer(c_int), value :: mode
      end function c_mkdir

      !> Remove an empty folder
      integer(c_int) function c_rmdir(path) bind(c, name='rmdir')
         import :: c_char, c_int
         !> Path
         character(kind=c_char), intent(in) :: path(*)
      end function c_rmdir

      !> Give a file another name, in place of a file that has it
      integer(c_int) function c_rename(from, to) bind(c, name='rename')
         import :: c_char, c_int
         !> Present path
         character(kind=c_char), intent(in) :: from(*)
         !> New path
         character(kind=c_char), intent(in) :: to(*)
      end function c_rename

      !> Remove a file
      integer(c_int) function c_unlink(path) bind(c, name='unlink')
         import :: c_char, c_int
         !> Path
         character(kind=c_char), intent(in) :: path(*)
      end function c_unlink

      !> Cut a file to a length; 1: it has it
      integer(c_int) function c_cut(path, length) bind(c, name='dondolo_cut')
         import :: c_char, c_int, c_long
         !> Path
         character(kind=c_char), intent(in) :: path(*)
         !> Length [bytes]; off_t is a long on 64-bit systems
         integer(c_long), value :: length
      end function c_cut

      !> The one absolute path of a file
      type(c_ptr) function c_realpath(path, resolved) bind(c, name='realpath')
         import :: c_char, c_ptr
         !> Path
         character(kind=c_char), intent(in) :: path(*)
         !> Room for the result
         character(kind=c_char), intent(out) :: resolved(*)
      end function c_realpath

      !> Is a file descriptor a terminal?
      integer(c_int) function c_isatty(descriptor) bind(c, name='isatty')
         import :: c_int
         !> File descriptor
         integer(c_int), value :: descriptor
      end function c_isatty

      !> Number of the last error of the system
      integer(c_int) function c_errno() bind(c, name='dondolo_errno')
         import :: c_int
      end function c_errno

      !> Say what a signal is to do
      type(c_ptr) function c_signal(number, handler) bind(c, name='signal')
         import :: c_int, c_intptr_t, c_ptr
         !> Number of the signal
         integer(c_int), value :: number
         !> A handler; 1: none, the signal is ignored
         integer(c_intptr_t), value :: handler
      end function c_signal

      !> Open a regular file to write behind what is there; it is made if it is not, and no link is followed
      type(c_ptr) function c_append(path) bind(c, name='dondolo_append')
         import :: c_char, c_ptr
         !> Path
         character(kind=c_char), intent(in) :: path(*)
      end function c_append

      !> Make a file and open it to write; it must not be there yet, and no link is followed
      type(c_ptr) function c_create(path) bind(c, name='dondolo_create')
         import :: c_char, c_ptr
         !> Path
         character(kind=c_char), intent(in) :: path(*)
      end function c_create

      !> Write bytes
      integer(c_size_t) function c_fwrite(bytes, size, count, handle) bind(c, name='fwrite')
         import :: c_char, c_ptr, c_size_t
         !> The bytes
         character(kind=c_char), intent(in) :: bytes(*)
         !> Bytes of an item
         integer(c_size_t), value :: size
         !> Number of items
         integer(c_size_t), value :: count
         !> File
         type(c_ptr), value :: handle
      end function c_fwrite

      !> Give what was written to the system
      integer(c_int) function c_fflush(handle) bind(c, name='fflush')
         import :: c_int, c_ptr
         !> File
         type(c_ptr), value :: handle
      end function c_fflush

      !> Bring what was written to the disk; 1: it is there
      integer(c_int) function c_synchronize(handle) bind(c, name='dondolo_synchronize')
         import :: c_int, c_ptr
         !> File
         type(c_ptr), value :: handle
      end function c_synchronize

      !> Make an empty file and remove it; 1: that can be done
      integer(c_int) function c_try_file(path) bind(c, name='dondolo_try_file')
         import :: c_char, c_int
         !> Path
         character(kind=c_char), intent(in) :: path(*)
      end function c_try_file

      !> Bring the names of the files of a folder to the disk; 1: they are there
      integer(c_int) function c_synchronize_folder(path) bind(c, name='dondolo_synchronize_folder')
         import :: c_char, c_int
         !> Path
         character(kind=c_char), intent(in) :: path(*)
      end function c_synchronize_folder

      !> Close a file
      integer(c_int) function c_fclose(handle) bind(c, name='fclose')
         import :: c_int, c_ptr
         !> File
         type(c_ptr), value :: handle
      end function c_fclose

   end interface

contains

   !> Make a folder
   subroutine make_folder(path, ok)
      !> Path; the folder above it must exist
      character(len=*), intent(in) :: path
      !> It was made
      logical, intent(out) :: ok

      integer(c_int), parameter :: everybody = int(o'777', c_int)

      ok = c_mkdir(path//c_null_char, everybody) == 0
   end subroutine make_folder

   !> Remove an empty folder
   subroutine remove_folder(path)
      !> Path
      character(len=*), intent(in) :: path

      integer(c_int) :: stat

      stat = c_rmdir(path//c_null_char)
   end subroutine remove_folder

   !> Give a file another name, in place of a file that has it
   subroutine rename_file(from, to, ok)
      !> Present path
      character(len=*), intent(in) :: from
      !> New path
      character(len=*), intent(in) :: to
      !> It has the new name
      logical, intent(out) :: ok

      ok = c_rename(from//c_null_char, to//c_null_char) == 0
   end subroutine rename_file

   !> Remove a file, if there is one
   subroutine remove_file(path)
      !> Path
      character(len=*), intent(in) :: path

      integer(c_int) :: stat

      stat = c_unlink(path//c_null_char)
   end subroutine remove_file

   !> Cut a file to a length; a link is not followed
   subroutine cut_file(path, bytes, ok)
      !> Path
      character(len=*), intent(in) :: path
      !> Bytes that stay
      integer(int64), intent(in) :: bytes
      !> It has this length now
      logical, intent(out) :: ok

      ok = c_cut(path//c_null_char, int(bytes, c_long)) == 1
   end subroutine cut_file

   !> Bring the names of the files of a folder to the disk
   subroutine synchronize_folder(path, ok)
      !> Path of one of its files
      character(len=*), intent(in) :: path
      !> Set to false when that failed; left alone otherwise
      logical, intent(inout) :: ok

      if (c_synchronize_folder('./'(:merge(0, 2, path(1:1) == '/'))//path(:index(path, '/', back=.true.))//c_null_char) &
         & /= 1) ok = .false.
   end subroutine synchronize_folder

   !> Try whether a file can be made; an empty one that a killed trial has left is removed, any other stays
   subroutine try_file(path, ok)
      !> Path
      character(len=*), intent(in) :: path
      !> It can be written
      logical, intent(out) :: ok

      ok = c_try_file(path//c_null_char) == 1
   end subroutine try_file

   !> Is a path a folder that exists?
   function is_folder(path)
      !> Path
      character(len=*), intent(in) :: path
      !> It is
      logical :: is_folder

      inquire (file=path//'/.', exist=is_folder)
   end function is_folder

   !> Are two paths one file that exists?
   function same_file(first, second)
      !> A path
      character(len=*), intent(in) :: first
      !> Another
      character(len=*), intent(in) :: second
      !> They are
      logical :: same_file

      ! PATH_MAX of Linux and macOS is 4096 or less
      integer, parameter :: room = 8192
      character(kind=c_char, len=:), allocatable :: real_first, real_second

      real_first = repeat(' ', room)
      real_second = real_first
      same_file = .false.
      if (.not. c_associated(c_realpath(first//c_null_char, real_first))) return
      if (.not. c_associated(c_realpath(second//c_null_char, real_second))) return
      same_file = real_first(:index(real_first, c_null_char)) == real_second(:index(real_second, c_null_char))
   end function same_file

   !> Is standard error a terminal?
   function stderr_is_terminal()
      !> It is
      logical :: stderr_is_terminal

      integer(c_int), parameter :: standard_error = 2_c_int

      stderr_is_terminal = c_isatty(standard_error) == 1
   end function stderr_is_terminal

   !> Does all that was printed reach standard output? FLUSH of gfortran reports no error, but leaves its number
   function output_arrives()
      !> It does
      logical :: output_arrives

      integer(c_int) :: number

      ! Nothing sets the number to 0, but a call that fails sets it: to remove a folder without a name.
      call remove_folder('')
      number = c_errno()
      flush (output_unit)
      output_arrives = c_errno() == number
   end function output_arrives

   !> Go on where a file would grow beyond the limit of the process (ulimit -f): writing then fails as on a full disk
   subroutine outlive_file_limit()

      ! SIGXFSZ has this number on Linux and macOS; SIG_IGN is 1 there.
      integer(c_int), parameter :: file_limit = 25_c_int
      integer(c_intptr_t), parameter :: ignore = 1_c_intptr_t
      type(c_ptr) :: before

      before = c_signal(file_limit, ignore)
   end subroutine outlive_file_limit

   !> Make a file that is not there yet; nothing is replaced, and no link followed
   subroutine create(self, path, ok)
      class(writer_type), intent(inout) :: self
      !> Path
      character(len=*), intent(in) :: path
      !> It can be written
      logical, intent(out) :: ok

      self%handle = c_create(path//c_null_char)
      ok = c_associated(self%handle)
   end subroutine create

   !> Open a regular file to write behind what is there; it is made if it is not. A link is not followed
   subroutine append_to(self, path, ok)
      class(writer_type), intent(inout) :: self
      !> Path
      character(len=*), intent(in) :: path
      !> It can be written
      logical, intent(out) :: ok

      self%handle = c_append(path//c_null_char)
      ok = c_associated(self%handle)
   end subroutine append_to

   !> Write a text
   subroutine write_text(self, text, ok)
      class(writer_type), intent(inout) :: self
      !> Text, with its line ends
      character(len=*), intent(in) :: text
      !> Set to false when it could not be written; left alone otherwise
      logical, intent(inout) :: ok

      integer(c_size_t) :: length

      length = len(text, c_size_t)
      if (c_fwrite(text, 1_c_size_t, length, self%handle) /= length) ok = .false.
   end subroutine write_text

   !> Give what was written to the system: it then outlives the process
   subroutine flush_writer(self, ok)
      class(writer_type), intent(inout) :: self
      !> Set to false when it could not be written; left alone otherwise
      logical, intent(inout) :: ok

      if (c_fflush(self%handle) /= 0) ok = .false.
   end subroutine flush_writer

   !> Bring what was written to the disk: it then outlives a loss of power
   subroutine synchronize(self, ok)
      class(writer_type), intent(inout) :: self
      !> Set to false when it could not be written; left alone otherwise
      logical, intent(inout) :: ok

      if (c_synchronize(self%handle) /= 1) ok = .false.
   end subroutine synchronize

   !> Close the file; nothing happens if it is not open
   subroutine close_writer(self, ok)
      class(writer_type), intent(inout) :: self
      !> Set to false when what was written last did not reach the disk; left alone otherwise
      logical, intent(inout) :: ok

      if (.not. c_associated(self%handle)) return
      if (c_fclose(self%handle) /= 0) ok = .false.
      self%handle = c_null_ptr
   end subroutine close_writer

end module dondolo_base_system
