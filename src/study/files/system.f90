!> The few things of the operating system that Fortran does not give: folders, renaming, writing that notices a full
!> disk (gfortran's own WRITE and CLOSE report success there), terminals. Every function in C is dondolo's: standard.c has what all
!> systems have, files.c and process.c what POSIX has, windows_*.c the same for Windows.
module dondolo_files_system
   use, intrinsic :: iso_c_binding, only : c_associated, c_char, c_int, c_int64_t, c_null_char, c_null_ptr, &
      & c_ptr, c_size_t
   use, intrinsic :: iso_fortran_env, only : int64, output_unit
   implicit none
   private

   public :: make_folder, remove_folder, rename_file, remove_file, cut_file, is_folder, file_exists, same_file
   public :: synchronize_folder, try_file
   public :: is_free, is_absolute, last_separator, folder_of
   public :: writer_type, stderr_is_terminal, output_arrives, set_up_process

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

      !> Make a folder; 1: done, as in all that follow
      integer(c_int) function c_make_folder(path) bind(c, name='dondolo_make_folder')
         import :: c_char, c_int
         !> Path
         character(kind=c_char), intent(in) :: path(*)
      end function c_make_folder

      !> Remove an empty folder
      integer(c_int) function c_remove_folder(path) bind(c, name='dondolo_remove_folder')
         import :: c_char, c_int
         !> Path
         character(kind=c_char), intent(in) :: path(*)
      end function c_remove_folder

      !> Give a file another name, in place of a file that has it
      integer(c_int) function c_rename(from, to) bind(c, name='dondolo_rename')
         import :: c_char, c_int
         !> Present path
         character(kind=c_char), intent(in) :: from(*)
         !> New path
         character(kind=c_char), intent(in) :: to(*)
      end function c_rename

      !> Remove a file
      integer(c_int) function c_remove_file(path) bind(c, name='dondolo_remove_file')
         import :: c_char, c_int
         !> Path
         character(kind=c_char), intent(in) :: path(*)
      end function c_remove_file

      !> Does no other program keep a file from being replaced?
      integer(c_int) function c_is_free(path) bind(c, name='dondolo_is_free')
         import :: c_char, c_int
         !> Path
         character(kind=c_char), intent(in) :: path(*)
      end function c_is_free

      !> Cut a file to a length
      integer(c_int) function c_cut(path, length) bind(c, name='dondolo_cut')
         import :: c_char, c_int, c_int64_t
         !> Path
         character(kind=c_char), intent(in) :: path(*)
         !> Length [bytes]
         integer(c_int64_t), value :: length
      end function c_cut

      !> What is at a path: 0 is nothing, 3 a folder
      integer(c_int) function c_thing(path, follows) bind(c, name='dondolo_thing')
         import :: c_char, c_int
         !> Path
         character(kind=c_char), intent(in) :: path(*)
         !> 1: what a link leads to
         integer(c_int), value :: follows
      end function c_thing

      !> Are two paths one file that exists?
      integer(c_int) function c_same_file(first, second) bind(c, name='dondolo_same_file')
         import :: c_char, c_int
         !> A path
         character(kind=c_char), intent(in) :: first(*)
         !> Another
         character(kind=c_char), intent(in) :: second(*)
      end function c_same_file

      !> Where the folders of a path end: number of bytes with the last separator
      pure integer(c_size_t) function c_last_separator(path) bind(c, name='dondolo_last_separator')
         import :: c_char, c_size_t
         !> Path
         character(kind=c_char), intent(in) :: path(*)
      end function c_last_separator

      !> Is a path independent of the current folder?
      pure integer(c_int) function c_is_absolute(path) bind(c, name='dondolo_is_absolute')
         import :: c_char, c_int
         !> Path
         character(kind=c_char), intent(in) :: path(*)
      end function c_is_absolute

      !> Is a file descriptor a terminal?
      integer(c_int) function c_is_terminal(descriptor) bind(c, name='dondolo_is_terminal')
         import :: c_int
         !> File descriptor
         integer(c_int), value :: descriptor
      end function c_is_terminal

      !> Number of the last error of the C library
      integer(c_int) function c_errno() bind(c, name='dondolo_errno')
         import :: c_int
      end function c_errno

      !> Forget the last error of the C library
      subroutine c_forget_error() bind(c, name='dondolo_forget_error')
      end subroutine c_forget_error

      !> Settle what a program of its own may meet; see process.c and windows_process.c
      subroutine set_up_process() bind(c, name='dondolo_set_up_process')
      end subroutine set_up_process

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
      integer(c_int) function c_write(bytes, count, handle) bind(c, name='dondolo_write')
         import :: c_char, c_int, c_ptr, c_size_t
         !> The bytes
         character(kind=c_char), intent(in) :: bytes(*)
         !> Number of bytes
         integer(c_size_t), value :: count
         !> File
         type(c_ptr), value :: handle
      end function c_write

      !> Give what was written to the system
      integer(c_int) function c_flush(handle) bind(c, name='dondolo_flush')
         import :: c_int, c_ptr
         !> File
         type(c_ptr), value :: handle
      end function c_flush

      !> Bring what was written to the disk
      integer(c_int) function c_synchronize(handle) bind(c, name='dondolo_synchronize')
         import :: c_int, c_ptr
         !> File
         type(c_ptr), value :: handle
      end function c_synchronize

      !> Make an empty file and remove it
      integer(c_int) function c_try_file(path) bind(c, name='dondolo_try_file')
         import :: c_char, c_int
         !> Path
         character(kind=c_char), intent(in) :: path(*)
      end function c_try_file

      !> Bring the names of the files of a folder to the disk
      integer(c_int) function c_synchronize_folder(path) bind(c, name='dondolo_synchronize_folder')
         import :: c_char, c_int
         !> Path
         character(kind=c_char), intent(in) :: path(*)
      end function c_synchronize_folder

      !> Close a file
      integer(c_int) function c_close(handle) bind(c, name='dondolo_close')
         import :: c_int, c_ptr
         !> File
         type(c_ptr), value :: handle
      end function c_close

   end interface

contains

   !> Make a folder
   subroutine make_folder(path, ok)
      !> Path; the folder above it must exist
      character(len=*), intent(in) :: path
      !> It was made
      logical, intent(out) :: ok

      ok = c_make_folder(path//c_null_char) == 1
   end subroutine make_folder

   !> Remove an empty folder
   subroutine remove_folder(path)
      !> Path
      character(len=*), intent(in) :: path

      integer(c_int) :: stat

      stat = c_remove_folder(path//c_null_char)
   end subroutine remove_folder

   !> Give a file another name, in place of a file that has it
   subroutine rename_file(from, to, ok)
      !> Present path
      character(len=*), intent(in) :: from
      !> New path
      character(len=*), intent(in) :: to
      !> It has the new name
      logical, intent(out) :: ok

      ok = c_rename(from//c_null_char, to//c_null_char) == 1
   end subroutine rename_file

   !> Remove a file, if there is one
   subroutine remove_file(path)
      !> Path
      character(len=*), intent(in) :: path

      integer(c_int) :: stat

      stat = c_remove_file(path//c_null_char)
   end subroutine remove_file

   !> Cut a file to a length; a link is not followed
   subroutine cut_file(path, bytes, ok)
      !> Path
      character(len=*), intent(in) :: path
      !> Bytes that stay
      integer(int64), intent(in) :: bytes
      !> It has this length now
      logical, intent(out) :: ok

      ok = c_cut(path//c_null_char, int(bytes, c_int64_t)) == 1
   end subroutine cut_file

   !> Bring the names of the files of a folder to the disk
   subroutine synchronize_folder(path, ok)
      !> Path of one of its files
      character(len=*), intent(in) :: path
      !> Set to false when that failed; left alone otherwise
      logical, intent(inout) :: ok

      if (c_synchronize_folder(folder_of(path)//c_null_char) /= 1) ok = .false.
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

      integer(c_int), parameter :: follows = 1_c_int, folder = 3_c_int

      is_folder = c_thing(trim(path)//c_null_char, follows) == folder
   end function is_folder

   !> Is there anything at a path, links followed?
   function file_exists(path)
      !> Path
      character(len=*), intent(in) :: path
      !> There is
      logical :: file_exists

      integer(c_int), parameter :: follows = 1_c_int, nothing = 0_c_int

      file_exists = c_thing(trim(path)//c_null_char, follows) /= nothing
   end function file_exists

   !> May a file be replaced? On Windows not while another program has it open
   function is_free(path)
      !> Path of a file; one that is not there is free
      character(len=*), intent(in) :: path
      !> It may
      logical :: is_free

      is_free = c_is_free(path//c_null_char) == 1
   end function is_free

   !> Does a path begin at a root, so that it does not depend on the current folder?
   pure logical function is_absolute(path)
      !> Path
      character(len=*), intent(in) :: path

      is_absolute = c_is_absolute(path//c_null_char) == 1
   end function is_absolute

   !> Where the folders of a path end: position of the last separator, 0 if there is none
   pure integer function last_separator(path)
      !> Path, as users of the system write it
      character(len=*), intent(in) :: path

      last_separator = int(c_last_separator(path//c_null_char))
   end function last_separator

   !> The folder of a file, with a separator at its end
   pure function folder_of(path) result(folder)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Its folder, the current one if it names none
      character(len=max(last_separator(path), 2*merge(0, 1, last_separator(path) > 0))) :: folder

      folder = './'
      if (last_separator(path) > 0) folder = path(:last_separator(path))
   end function folder_of

   !> Are two paths one file that exists?
   function same_file(first, second)
      !> A path
      character(len=*), intent(in) :: first
      !> Another
      character(len=*), intent(in) :: second
      !> They are
      logical :: same_file

      same_file = c_same_file(first//c_null_char, second//c_null_char) == 1
   end function same_file

   !> Is standard error a terminal?
   function stderr_is_terminal()
      !> It is
      logical :: stderr_is_terminal

      integer(c_int), parameter :: standard_error = 2_c_int

      stderr_is_terminal = c_is_terminal(standard_error) == 1
   end function stderr_is_terminal

   !> Does all that was printed reach standard output? FLUSH of gfortran reports no error, but leaves its number
   function output_arrives()
      !> It does
      logical :: output_arrives

      call c_forget_error()
      flush (output_unit)
      output_arrives = c_errno() == 0
   end function output_arrives

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

      if (c_write(text, len(text, c_size_t), self%handle) /= 1) ok = .false.
   end subroutine write_text

   !> Give what was written to the system: it then outlives the process
   subroutine flush_writer(self, ok)
      class(writer_type), intent(inout) :: self
      !> Set to false when it could not be written; left alone otherwise
      logical, intent(inout) :: ok

      if (c_flush(self%handle) /= 1) ok = .false.
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
      if (c_close(self%handle) /= 1) ok = .false.
      self%handle = c_null_ptr
   end subroutine close_writer

end module dondolo_files_system
