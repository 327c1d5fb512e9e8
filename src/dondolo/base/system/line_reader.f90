!> The lines of a text file, one after the other, within a memory that does not depend on its length.
module dondolo_line_reader
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_encoding, only : byte_order_mark, encoding_problem, is_ascii, is_utf8, mend_line_ends, take_utf16, &
      & utf16_order
   use dondolo_error, only : error_type, raise_input
   use dondolo_limits, only : longest_line
   use dondolo_text, only : to_text
   use dondolo_text_file, only : open_text, padding
   implicit none
   private

   public :: line_reader_type

   !> Bytes that are read at once, unless a line is longer
   integer, parameter :: chunk = 65536

   !> A file that is being read
   type :: line_reader_type
      !> Path of the file
      character(len=:), allocatable :: file
      !> Number of the line that was read last
      integer :: number = 0
      !> Its unit; 0: not open
      integer :: unit = 0
      !> Bytes that are left in the file beyond the chunk
      integer(int64) :: left = 0
      !> Part of the file
      character(len=:), allocatable :: text
      !> Position in it of what was not given out yet
      integer :: at = 1
      !> Is it ASCII?
      logical, private :: is_ascii = .true.
      !> Byte order of UTF-16, 0: UTF-8, -1: nothing was read yet
      integer, private :: order = -1
      !> Bytes of a character that was not whole
      character(len=:), allocatable, private :: rest
      !> Has the end of a line been seen, and is it a CR alone?
      logical, private :: knows_end = .false., ends_in_return = .false.
   contains
      !> Open a file
      procedure :: open => open_reader
      !> Read the next line
      procedure :: next
      !> Close the file
      procedure :: close => close_reader
   end type line_reader_type

contains

   !> Open a file
   subroutine open_reader(self, file, error)
      class(line_reader_type), intent(inout) :: self
      !> Path
      character(len=*), intent(in) :: file
      !> The file is missing, unreadable or empty
      type(error_type), allocatable, intent(out) :: error

      call self%close()
      self%file = file
      self%number = 0
      self%at = 1
      self%text = ''
      self%order = -1
      self%rest = ''
      self%knows_end = .false.
      self%ends_in_return = .false.
      call open_text(file, self%unit, self%left, error)
      if (allocated(error)) return
      call refill(self, error)
      if (allocated(error)) return
      if (index(self%text, byte_order_mark) == 1) self%at = 1 + len(byte_order_mark)
   end subroutine open_reader

   !> Read the next line: lines end in LF, CRLF or CR
   subroutine next(self, line, found, error)
      class(line_reader_type), intent(inout) :: self
      !> The line without its end; what may follow the last line, such as NUL or Ctrl-Z, is dropped from it
      character(len=:), allocatable, intent(out) :: line
      !> Was there one?
      logical, intent(out) :: found
      !> The file cannot be read, or the line is too long or not UTF-8; the file is closed then
      type(error_type), allocatable, intent(out) :: error

      character(len=*), parameter :: line_feed = achar(10), return = achar(13)
      character(len=:), allocatable :: problem
      integer :: length

      line = ''
      found = .false.
      do
         length = index(self%text(self%at:), line_feed) - 1
         if (length > longest_line .or. (length < 0 .and. len(self%text) - self%at >= longest_line)) then
            call raise_input(error, self%file//': line '//to_text(self%number + 1)//': longer than '// &
               & to_text(longest_line)//' bytes')
            call self%close()
            return
         end if
         if (length >= 0 .or. self%left == 0) exit
         call refill(self, error)
         if (allocated(error)) return
      end do
      if (length < 0 .and. self%at > len(self%text)) then
         call self%close()
         return
      end if
      found = .true.
      self%number = self%number + 1
      if (length < 0) then
         line = self%text(self%at:self%at - 1 + verify(self%text(self%at:), padding, back=.true.))
         self%at = len(self%text) + 1
      else
         line = self%text(self%at:self%at - 1 + verify(self%text(self%at:self%at + length - 1), return, back=.true.))
         self%at = self%at + length + 1
      end if
      if (self%is_ascii) return
      if (is_utf8(line)) return
      call encoding_problem(line, problem)
      call raise_input(error, self%file//': line '//to_text(self%number)//': '//problem)
      found = .false.
      call self%close()
   end subroutine next

   !> Read the next chunk behind what was not given out yet
   subroutine refill(self, error)
      class(line_reader_type), intent(inout) :: self
      !> The file cannot be read
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: more, bytes
      integer :: stat, used

      ! As much again as is there: a long line is not copied chunk by chunk.
      allocate (character(len=int(min(self%left, int(max(chunk, len(self%text) - self%at + 1), int64)))) :: more)
      read (self%unit, iostat=stat) more
      if (stat /= 0) then
         call raise_input(error, self%file//': cannot be read')
         call self%close()
         return
      end if
      self%left = self%left - len(more)
      if (self%order < 0) self%order = utf16_order(more)
      if (self%order > 0) then
         bytes = self%rest//more
         call take_utf16(bytes, self%order, self%left == 0, more, used)
         self%rest = bytes(used + 1:)
      end if
      self%text = self%text(self%at:)//more
      self%at = 1
      call mend_line_ends(self%text, self%knows_end, self%ends_in_return)
      self%is_ascii = is_ascii(self%text)
   end subroutine refill

   !> Close the file: there are no more lines; nothing happens if it is not open
   subroutine close_reader(self)
      class(line_reader_type), intent(inout) :: self

      if (self%unit /= 0) close (self%unit)
      self%unit = 0
      self%left = 0
      self%text = ''
      self%at = 1
   end subroutine close_reader

end module dondolo_line_reader
