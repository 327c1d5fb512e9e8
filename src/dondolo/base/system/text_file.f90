!> A text file as a whole: read at once, with an index of its lines.
module dondolo_text_file
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_error, only : add_place, error_type, raise_input, raise_missing
   use dondolo_kinds, only : wp
   use dondolo_memory, only : check_room
   use dondolo_text, only : to_text
   implicit none
   private

   public :: text_file_type, read_text_file, open_text
   public :: byte_order_mark, padding

   !> Byte order mark that some programs put before UTF-8 text
   character(len=*), parameter :: byte_order_mark = achar(239)//achar(187)//achar(191)

   !> Memory that a text, the index of its lines and the numbers in it may take, in parts of its size
   real(wp), parameter :: bytes_of_byte = 16.0_wp

   !> What may follow the last line: NUL, tab, line feed, carriage return, Ctrl-Z (end of file under DOS), blank
   character(len=*), parameter :: padding = achar(0)//achar(9)//achar(10)//achar(13)//achar(26)//' '

   !> The text of a file and where its lines are
   type :: text_file_type
      !> Path of the file
      character(len=:), allocatable :: file
      !> Everything in it, line ends included
      character(len=:), allocatable :: text
      !> Position of the first character of each line
      integer, allocatable :: first(:)
      !> Position of the last character of each line, without the line end (first - 1 if the line is empty)
      integer, allocatable :: last(:)
   contains
      !> Number of lines
      procedure :: lines
      !> The text of one line
      procedure :: line
      !> Where a line is, for messages
      procedure :: place
      !> The next word of a line
      procedure :: next_word
   end type text_file_type

contains

   !> Read a text file: lines end in LF or CRLF; a byte order mark and Ctrl-Z at the end are dropped
   subroutine read_text_file(file, text, error, longest)
      !> Path of the file
      character(len=*), intent(in) :: file
      type(text_file_type), intent(out) :: text
      !> The file is missing, unreadable, empty or too large, for the memory too
      type(error_type), allocatable, intent(out) :: error
      !> Most bytes that it may have; 2 GiB if absent
      integer(int64), intent(in), optional :: longest

      integer(int64) :: bytes
      integer :: unit, stat

      text%file = file
      call open_text(file, unit, bytes, error)
      if (allocated(error)) return
      if (bytes >= int(huge(stat), int64)) then
         close (unit)
         call raise_input(error, file//': larger than 2 GiB or no file')
         return
      end if
      if (present(longest)) then
         if (bytes > longest) then
            close (unit)
            call raise_input(error, file//': has '//to_text(bytes)//' bytes: must be at most '//to_text(longest))
            return
         end if
      end if
      call check_room(bytes_of_byte*real(bytes, wp), error)
      if (allocated(error)) then
         close (unit)
         call add_place(error, file)
         return
      end if
      allocate (character(len=max(bytes, 0_int64)) :: text%text)
      stat = 0
      if (bytes > 0) read (unit, iostat=stat) text%text
      close (unit)
      if (stat /= 0) then
         call raise_input(error, file//': cannot be read')
         return
      end if
      call index_lines(text)
      if (text%lines() == 0) call raise_input(error, file//': the file is empty')
   end subroutine read_text_file

   !> Open a text file
   subroutine open_text(file, unit, bytes, error)
      !> Path of the file
      character(len=*), intent(in) :: file
      !> Its unit, for unformatted stream access; 0 after an error
      integer, intent(out) :: unit
      !> Bytes in it
      integer(int64), intent(out) :: bytes
      !> The file is missing, unreadable or empty
      type(error_type), allocatable, intent(out) :: error

      integer :: stat
      logical :: exists

      unit = 0
      inquire (file=file, exist=exists, size=bytes)
      if (.not. exists) then
         call raise_missing(error, file//': no such file')
         return
      end if
      ! Seen before it is opened: a pipe has no size either, and would be waited for.
      if (bytes == 0) then
         call raise_input(error, file//': the file is empty')
         return
      end if
      open (newunit=unit, file=file, access='stream', form='unformatted', action='read', status='old', iostat=stat)
      if (stat /= 0) then
         call raise_input(error, file//': cannot be opened for reading')
         unit = 0
         return
      end if
      inquire (unit=unit, size=bytes)
      if (bytes >= 0) return
      close (unit)
      unit = 0
      call raise_input(error, file//': larger than 2 GiB or no file')
   end subroutine open_text

   !> Find the lines of a text
   pure subroutine index_lines(text)
      !> Text file, its `text` known
      type(text_file_type), intent(inout) :: text

      character(len=*), parameter :: line_feed = achar(10), return = achar(13)
      integer :: begin, finish, count, i

      begin = 1
      if (len(text%text) >= 3) then
         if (text%text(1:3) == byte_order_mark) begin = 4
      end if
      finish = verify(text%text, padding, back=.true.)
      count = 0
      if (finish >= begin) count = 1
      do i = begin, finish
         if (text%text(i:i) == line_feed) count = count + 1
      end do
      allocate (text%first(count), text%last(count))
      if (count == 0) return
      count = 1
      text%first(1) = begin
      do i = begin, finish
         if (text%text(i:i) /= line_feed) cycle
         text%last(count) = i - 1
         count = count + 1
         text%first(count) = i + 1
      end do
      text%last(count) = finish
      do i = 1, count - 1
         if (text%last(i) < text%first(i)) cycle
         if (text%text(text%last(i):text%last(i)) == return) text%last(i) = text%last(i) - 1
      end do
   end subroutine index_lines

   !> Number of lines
   pure function lines(self)
      class(text_file_type), intent(in) :: self
      !> Number of lines; empty lines after the last text do not count
      integer :: lines

      lines = size(self%first)
   end function lines

   !> Length of a line
   pure integer function line_length(self, i)
      class(text_file_type), intent(in) :: self
      !> Number of the line
      integer, intent(in) :: i

      line_length = 0
      if (i >= 1 .and. i <= self%lines()) line_length = self%last(i) - self%first(i) + 1
   end function line_length

   !> The text of one line
   pure function line(self, i)
      class(text_file_type), intent(in) :: self
      !> Number of the line; one that there is not gives an empty text
      integer, intent(in) :: i
      !> Its text without the line end
      character(len=line_length(self, i)) :: line

      if (len(line) > 0) line = self%text(self%first(i):self%last(i))
   end function line

   !> Length of the place of a line
   pure integer function place_length(self, i)
      class(text_file_type), intent(in) :: self
      !> Number of the line
      integer, intent(in) :: i

      place_length = len(self%file//': line '//to_text(i))
   end function place_length

   !> Where a line is, for messages
   pure function place(self, i)
      class(text_file_type), intent(in) :: self
      !> Number of the line
      integer, intent(in) :: i
      !> 'file: line 7'
      character(len=place_length(self, i)) :: place

      place = self%file//': line '//to_text(i)
   end function place

   !> The next word of a line: what stands between blanks and tabs
   pure subroutine next_word(self, at, last, first, finish)
      class(text_file_type), intent(in) :: self
      !> Position from which to look
      integer, intent(in) :: at
      !> Last position of the line
      integer, intent(in) :: last
      !> Position of the first character of the word, beyond `last` if there is none
      integer, intent(out) :: first
      !> Position of its last character
      integer, intent(out) :: finish

      integer, parameter :: blank = iachar(' '), tab = 9

      ! Loops, for SCAN and VERIFY take several times longer on short words; and codes, for gfortran calls LEN_TRIM to
      ! compare a character with a blank
      do first = at, last
         if (iachar(self%text(first:first)) /= blank .and. iachar(self%text(first:first)) /= tab) exit
      end do
      do finish = first, last - 1
         if (iachar(self%text(finish + 1:finish + 1)) == blank .or. iachar(self%text(finish + 1:finish + 1)) == tab) exit
      end do
   end subroutine next_word

end module dondolo_text_file
