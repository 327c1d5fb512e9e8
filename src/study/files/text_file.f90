!> A text file as a whole: read at once, with an index of its lines.
module dondolo_files_text_file
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_encoding, only : byte_order_mark, encoding_problem, from_latin, is_ascii, is_utf8, mend_line_ends, &
      & from_utf16, utf16_order
   use dondolo_base_error, only : add_place, error_type, raise_input, raise_missing
   use dondolo_base_kinds, only : wp
   use dondolo_base_memory, only : check_room
   use dondolo_base_odd_character, only : odd_character
   use dondolo_base_text, only : to_text
   use dondolo_files_file_kinds, only : describe_binary, head_length, is_archive
   use dondolo_files_origin, only : check_regular
   use dondolo_files_reader, only : reader_type
   use dondolo_files_system, only : file_exists
   implicit none
   private

   public :: text_file_type, read_text_file, load_text, decode_text, check_nul, find_lines, find_content, is_blank
   public :: padding

   !> Memory that a text, the index of its lines and the numbers in it may take, in parts of its size
   real(wp), parameter :: bytes_of_byte = 16.0_wp

   !> Bytes at the end of an archive of ZIP that are searched for the names of its files
   integer(int64), parameter :: list_length = 2_int64**16

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
      !> Where the next word begins
      procedure :: skip_blanks
   end type text_file_type

contains

   !> Read a text file: UTF-8, or UTF-16 with a byte order mark; lines end in LF, CRLF or CR; Ctrl-Z at the end is dropped
   subroutine read_text_file(file, text, error, longest)
      !> Path of the file
      character(len=*), intent(in) :: file
      type(text_file_type), intent(out) :: text
      !> The file is missing, unreadable, empty, too large, for the memory too, or no text
      type(error_type), allocatable, intent(out) :: error
      !> Most bytes that it may have, less than 2 GiB
      integer(int64), intent(in) :: longest

      call load_text(file, text, error, longest)
      if (.not. allocated(error)) call find_lines(text, error)
   end subroutine read_text_file

   !> Read the bytes of a text file, in which no lines are known yet
   subroutine load_text(file, text, error, longest, room)
      !> Path of the file
      character(len=*), intent(in) :: file
      type(text_file_type), intent(out) :: text
      !> The file is missing, unreadable, empty or too large, for the memory too
      type(error_type), allocatable, intent(out) :: error
      !> Most bytes that it may have, less than 2 GiB
      integer(int64), intent(in) :: longest
      !> Memory that is needed, in parts of its size; if absent as much as the index of its lines and numbers in it may take
      real(wp), intent(in), optional :: room

      real(wp) :: parts

      parts = bytes_of_byte
      if (present(room)) parts = room
      text%file = file
      call load(file, longest, parts, text%text, error)
   end subroutine load_text

   !> Find the lines of a text, and make UTF-8 of it
   subroutine find_lines(text, error, has_latin)
      !> Text file as `load_text` gives it
      type(text_file_type), intent(inout) :: text
      !> It is empty or no text
      type(error_type), allocatable, intent(out) :: error
      !> May it be Latin-1 too? Where nothing but remarks can have other characters than ASCII; no if absent
      logical, intent(in), optional :: has_latin

      character(len=:), allocatable :: bytes_read

      call decode_text(text%text)
      call index_lines(text)
      if (text%lines() == 0) then
         call raise_input(error, text%file//': the file is empty')
         return
      end if
      if (is_ascii(text%text(text%first(1):text%last(text%lines())))) return
      call check_nul(text%file, text%text, error)
      if (allocated(error)) return
      call check_encoding(text, error)
      if (.not. (allocated(error) .and. present(has_latin))) return
      if (.not. has_latin) return
      deallocate (error)
      call move_alloc(text%text, bytes_read)
      call from_latin(bytes_read, text%text)
      deallocate (text%first, text%last)
      call index_lines(text)
   end subroutine find_lines

   !> The bytes of a file
   subroutine load(file, longest, room, content, error)
      !> Path of the file
      character(len=*), intent(in) :: file
      !> Most bytes that it may have
      integer(int64), intent(in) :: longest
      !> Memory that is needed, in parts of its size
      real(wp), intent(in) :: room
      !> What is in it
      character(len=:), allocatable, intent(out) :: content
      !> The file is missing, unreadable, empty or too large, for the memory too
      type(error_type), allocatable, intent(out) :: error

      type(reader_type) :: reader
      integer(int64) :: bytes
      logical :: ok

      call open_text(file, reader, bytes, error)
      if (allocated(error)) return
      call check_kind(file, reader, bytes, error)
      if (allocated(error)) then
         call reader%close()
         return
      end if
      if (bytes > longest) then
         call reader%close()
         call raise_input(error, file//': has '//to_text(bytes)//' bytes: must be at most '//to_text(longest))
         return
      end if
      call check_room(room*real(bytes, wp), error)
      if (allocated(error)) then
         call reader%close()
         call add_place(error, file)
         return
      end if
      allocate (character(len=bytes) :: content)
      call reader%read(1_int64, content, ok)
      call reader%close()
      if (.not. ok) call raise_input(error, file//': cannot be read')
   end subroutine load

   !> Refuse a file of a kind that is no text
   subroutine check_kind(file, reader, bytes, error)
      !> Path of the file
      character(len=*), intent(in) :: file
      !> The file, open
      type(reader_type), intent(in) :: reader
      !> Bytes in it
      integer(int64), intent(in) :: bytes
      !> Says what it seems to be
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: head, tail, problem
      logical :: ok

      allocate (character(len=min(bytes, int(head_length, int64))) :: head)
      call reader%read(1_int64, head, ok)
      if (.not. ok) then
         call raise_input(error, file//': cannot be read')
         return
      end if
      if (is_archive(head)) then
         allocate (character(len=min(bytes, list_length)) :: tail)
         call reader%read(bytes - len(tail) + 1_int64, tail, ok)
         if (ok) head = head//tail
      end if
      call describe_binary(head, problem)
      if (len(problem) > 0) call raise_input(error, file//': '//problem)
   end subroutine check_kind

   !> Make UTF-8 with lines that end in LF or CRLF of what was read
   subroutine decode_text(text)
      !> Everything in a file
      character(len=:), allocatable, intent(inout) :: text

      character(len=:), allocatable :: decoded
      integer :: order

      order = utf16_order(text)
      if (order > 0) then
         call from_utf16(text, order, decoded)
         call move_alloc(decoded, text)
      end if
      call mend_line_ends(text)
   end subroutine decode_text

   !> Refuse what has a NUL before its padding: it is no text, whatever else is wrong with it
   subroutine check_nul(file, text, error)
      !> Path of the file
      character(len=*), intent(in) :: file
      !> Everything in it
      character(len=*), intent(in) :: text
      !> Names the first line with a NUL
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: problem
      integer :: begin, finish, at, first, last, line

      call find_content(text, begin, finish)
      at = index(text(begin:finish), achar(0)) + begin - 1
      if (at < begin) return
      line = 1
      first = begin
      do
         last = index(text(first:finish), achar(10)) + first - 2
         if (last < first - 1) last = finish
         if (last >= at) exit
         line = line + 1
         first = last + 2
      end do
      call encoding_problem(text(first:last), problem)
      call raise_input(error, file//': line '//to_text(line)//': '//problem)
   end subroutine check_nul

   !> Refuse a line that is not UTF-8
   subroutine check_encoding(text, error)
      type(text_file_type), intent(in) :: text
      !> Names the first such line
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: problem
      integer :: i

      do i = 1, text%lines()
         if (is_utf8(text%text(text%first(i):text%last(i)))) cycle
         call encoding_problem(text%line(i), problem)
         call raise_input(error, text%place(i)//': '//problem)
         return
      end do
   end subroutine check_encoding

   !> Open a text file
   subroutine open_text(file, reader, bytes, error)
      !> Path of the file
      character(len=*), intent(in) :: file
      !> The file; not open after an error
      type(reader_type), intent(out) :: reader
      !> Bytes in it
      integer(int64), intent(out) :: bytes
      !> The file is missing, unreadable or empty
      type(error_type), allocatable, intent(out) :: error

      logical :: ok

      bytes = 0
      if (.not. file_exists(file)) then
         call raise_missing(error, file//': no such file')
         if (len_trim(odd_character(file)) > 0) error%message = error%message//'; its name has '//trim(odd_character(file))
         return
      end if
      call check_regular(file, .true., error)
      if (allocated(error)) return
      call reader%open(file, ok)
      if (ok) bytes = reader%size()
      if (.not. ok .or. bytes < 0) then
         call raise_input(error, file//': cannot be opened for reading')
      else if (bytes == 0) then
         call raise_input(error, file//': the file is empty')
      end if
      if (allocated(error)) call reader%close()
   end subroutine open_text

   !> Find the lines of a text
   pure subroutine index_lines(text)
      !> Text file, its `text` known
      type(text_file_type), intent(inout) :: text

      integer, parameter :: line_feed = 10, return = 13
      integer :: begin, finish, count, i

      call find_content(text%text, begin, finish)
      if (finish < begin) then
         allocate (text%first(0), text%last(0))
         return
      end if
      associate (content => text%text)
         count = 1
         do i = begin, finish
            count = count + merge(1, 0, iachar(content(i:i)) == line_feed)
         end do
         allocate (text%first(count), text%last(count))
         text%first(1) = begin
         text%last(count) = finish
         count = 1
         do i = begin, finish
            if (iachar(content(i:i)) /= line_feed) cycle
            text%last(count) = i - 1
            count = count + 1
            text%first(count) = i + 1
         end do
         do i = 1, count - 1
            do while (text%last(i) >= text%first(i))
               if (iachar(content(text%last(i):text%last(i))) /= return) exit
               text%last(i) = text%last(i) - 1
            end do
         end do
      end associate
   end subroutine index_lines

   !> Where a text begins, after a byte order mark, and where it ends
   pure subroutine find_content(text, begin, finish)
      !> Everything in a file
      character(len=*), intent(in) :: text
      !> Position of the first character
      integer, intent(out) :: begin
      !> Position of the last one that is no padding, before `begin` if there is none
      integer, intent(out) :: finish

      begin = 1
      if (len(text) >= 3) then
         if (text(1:3) == byte_order_mark) begin = 4
      end if
      finish = verify(text, padding, back=.true.)
   end subroutine find_content

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

      first = at
      call self%skip_blanks(first, last)
      do finish = first, last - 1
         if (is_blank(self%text(finish + 1:finish + 1))) exit
      end do
   end subroutine next_word

   !> Go on to what is no blank and no tab
   pure subroutine skip_blanks(self, at, last)
      class(text_file_type), intent(in) :: self
      !> Position
      integer, intent(inout) :: at
      !> Last position of the line; `at` is beyond it where nothing but blanks follows
      integer, intent(in) :: last

      ! A loop, for VERIFY takes several times longer on short words
      do while (at <= last)
         if (.not. is_blank(self%text(at:at))) exit
         at = at + 1
      end do
   end subroutine skip_blanks

   !> Is a character a blank or a tab?
   elemental logical function is_blank(character)
      character(len=1), intent(in) :: character

      ! Codes, for gfortran calls LEN_TRIM to compare a character with a blank
      is_blank = iachar(character) == iachar(' ') .or. iachar(character) == 9
   end function is_blank

end module dondolo_files_text_file
