!> Files that are read: bytes at any place of a regular file. gfortran's OPEN takes the names of Windows in the code page of the
!> process, which only the executable can set to UTF-8, and refuses a file that is open already.
module dondolo_files_reader
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_int64_t, c_null_char, c_size_t
   use, intrinsic :: iso_fortran_env, only : int64
   implicit none
   private

   public :: reader_type, file_size

   !> A file being read
   type :: reader_type
      private
      !> File descriptor; negative: not open
      integer(c_int) :: descriptor = -1_c_int
   contains
      !> Open it
      procedure :: open => open_reader
      !> Is it open?
      procedure :: is_open
      !> Bytes in it now
      procedure :: size => size_now
      !> Read bytes
      procedure :: read => read_bytes
      !> Close it
      procedure :: close => close_reader
   end type reader_type

   interface

      !> Open a regular file to read it, links followed: its descriptor, negative if that fails
      integer(c_int) function c_open_to_read(path) bind(c, name='dondolo_open_to_read')
         import :: c_char, c_int
         !> Path
         character(kind=c_char), intent(in) :: path(*)
      end function c_open_to_read

      !> Bytes in an open file; negative if that is not known
      integer(c_int64_t) function c_size_of(descriptor) bind(c, name='dondolo_size_of')
         import :: c_int, c_int64_t
         !> File descriptor
         integer(c_int), value :: descriptor
      end function c_size_of

      !> Bytes in what is at a path, links followed; negative: nothing is there
      integer(c_int64_t) function c_size(path) bind(c, name='dondolo_size')
         import :: c_char, c_int64_t
         !> Path
         character(kind=c_char), intent(in) :: path(*)
      end function c_size

      !> Read bytes; 1: all of them
      integer(c_int) function c_read(descriptor, at, bytes, count) bind(c, name='dondolo_read')
         import :: c_char, c_int, c_int64_t, c_size_t
         !> File descriptor
         integer(c_int), value :: descriptor
         !> Number of bytes before the first
         integer(c_int64_t), value :: at
         !> The bytes
         character(kind=c_char), intent(inout) :: bytes(*)
         !> Number of bytes
         integer(c_size_t), value :: count
      end function c_read

      !> Close a file
      subroutine c_close_reader(descriptor) bind(c, name='dondolo_close_reader')
         import :: c_int
         !> File descriptor
         integer(c_int), value :: descriptor
      end subroutine c_close_reader

   end interface

contains

   !> Bytes in a file
   function file_size(path) result(bytes)
      !> Path
      character(len=*), intent(in) :: path
      !> Bytes; negative: there is nothing
      integer(int64) :: bytes

      bytes = int(c_size(trim(path)//c_null_char), int64)
   end function file_size

   !> Open a file
   subroutine open_reader(self, path, ok)
      class(reader_type), intent(inout) :: self
      !> Path
      character(len=*), intent(in) :: path
      !> It is a regular file that can be read
      logical, intent(out) :: ok

      self%descriptor = c_open_to_read(trim(path)//c_null_char)
      ok = self%is_open()
   end subroutine open_reader

   !> Is the file open?
   pure logical function is_open(self)
      class(reader_type), intent(in) :: self

      is_open = self%descriptor >= 0
   end function is_open

   !> Bytes in the file now
   integer(int64) function size_now(self)
      class(reader_type), intent(in) :: self

      size_now = int(c_size_of(self%descriptor), int64)
   end function size_now

   !> Read bytes
   subroutine read_bytes(self, at, bytes, ok)
      class(reader_type), intent(in) :: self
      !> Number of the first, from 1
      integer(int64), intent(in) :: at
      !> The bytes, as many as fit in
      character(len=*), intent(inout) :: bytes
      !> All of them are there
      logical, intent(out) :: ok

      ok = c_read(self%descriptor, int(at - 1, c_int64_t), bytes, len(bytes, c_size_t)) == 1
   end subroutine read_bytes

   !> Close the file; nothing happens if it is not open
   subroutine close_reader(self)
      class(reader_type), intent(inout) :: self

      if (self%is_open()) call c_close_reader(self%descriptor)
      self%descriptor = -1_c_int
   end subroutine close_reader

end module dondolo_files_reader
