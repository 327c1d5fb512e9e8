!> Tables in CSV files (RFC 4180). The text is read at once and stays in memory; rows are taken from it one after the other, as
!> often as is wanted, and always those of the file as it was read.
!>
!> The first row names the columns. Cells are separated by commas; a cell in double quotes may hold commas, line ends and,
!> doubled, quotes. Blank lines and lines that begin with # are skipped; blanks around cells without quotes do not count.
!>
!> Tables of spreadsheets may differ from this: semicolons or tabs between the columns, then with decimal commas if the
!> numbers show them (`find_decimal_mark`); a title above the names of the columns; rows and columns of empty cells at the
!> end. `note` says how such a table was read.
module dondolo_files_csv_reader
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_encoding, only : byte_order_mark, encoding_problem, is_ascii, is_utf8
   use dondolo_base_error, only : error_type, not_a_number, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_limits, only : longest_line, longest_table
   use dondolo_base_odd_character, only : odd_character, odd_length
   use dondolo_base_text, only : lower, occurrences, to_text
   use dondolo_files_checksum, only : crc32_length, crc32_of_text
   use dondolo_files_csv_row, only : cell_type, is_title, separator_of, split_row
   use dondolo_files_decimal_mark, only : decimal_mark_type
   use dondolo_files_name_index, only : name_index_type
   use dondolo_files_text_file, only : check_nul, decode_text, load_text, padding, text_file_type
   implicit none
   private

   public :: csv_table_type, csv_row_type

   character(len=1), parameter :: tab = achar(9)

   !> What comes before the peculiarities of a table
   character(len=*), parameter :: read_with = ': read with'

   !> Separator of cells as long as the header was not read
   character(len=1), parameter :: unknown = ' '

   !> Memory that the text takes while it is read, in parts of the size of the file: UTF-16 is decoded
   real(wp), parameter :: bytes_of_byte = 3.0_wp

   !> A row of a table, and what is behind it. Without a value it stands before the first row
   type :: csv_row_type
      !> Its cells
      type(cell_type), allocatable :: cells(:)
      !> Line in which it begins; 0: there are no more rows
      integer :: line = 0
      !> Position of what follows it in the text, and number of the line before that; 0: no row was read
      integer, private :: at = 0, number = 0
   contains
      !> A cell as text
      procedure :: get_text
   end type csv_row_type

   !> A table
   type :: csv_table_type
      !> Path of the file, its length, and its checksum when it was read
      character(len=:), allocatable :: file
      integer(int64) :: bytes = 0
      character(len=crc32_length) :: checksum = ''
      !> Names of the columns
      type(cell_type), allocatable :: columns(:)
      !> The text as UTF-8, whose lines end in LF or CRLF, and whether it is ASCII
      character(len=:), allocatable, private :: text
      logical, private :: is_ascii = .true.
      !> The header, behind which the rows begin
      type(csv_row_type), private :: header
      !> What separates the cells: a comma, a semicolon or a tab
      character(len=1), private :: separator = ','
      !> The same, of the row that is or may be the header, and how many it has
      character(len=1), private :: header_separator = unknown
      integer, private :: header_separators = 0
      !> Decimal mark of its numbers: a point, unless they show another
      type(decimal_mark_type), private :: mark
      !> Line of the title, 0 if there is none
      integer, private :: title_line = 0
   contains
      !> Read a table and its header
      procedure :: read => read_table
      !> Find out the decimal mark
      procedure :: find_decimal_mark
      !> How the table was read, for messages
      procedure :: note
      !> Take the next row
      procedure :: next
      !> Number of a column from its name
      procedure :: column
      !> Where a row is, for messages
      procedure :: place
      !> A cell of a row as a number
      procedure :: get_real
   end type csv_table_type

contains

   !> Read a table and its header
   subroutine read_table(self, file, error)
      class(csv_table_type), intent(out) :: self
      !> Path of the file
      character(len=*), intent(in) :: file
      !> The file is missing, too large or none of text, or its header is wrong
      type(error_type), allocatable, intent(out) :: error

      type(text_file_type) :: text

      self%file = file
      call load_text(file, text, error, longest_table, bytes_of_byte)
      if (allocated(error)) return
      self%bytes = len(text%text, int64)
      self%checksum = crc32_of_text(text%text)
      call decode_text(text%text)
      call move_alloc(text%text, self%text)
      self%is_ascii = is_ascii(self%text)
      if (.not. self%is_ascii) call check_nul(file, self%text, error)
      if (allocated(error)) return
      self%header%at = 1
      if (index(self%text, byte_order_mark) == 1) self%header%at = 1 + len(byte_order_mark)
      call read_header(self, error)
      if (allocated(error)) return
      if (self%header%line == 0) then
         call raise_input(error, file//': no header: the first line must name the columns')
      else
         call check_header(self, error)
      end if
   end subroutine read_table

   !> Find out the decimal mark of a table
   !>
   !> All rows are gone through, unless the cells are separated by commas, where it is a point.
   subroutine find_decimal_mark(self, columns)
      class(csv_table_type), intent(inout) :: self
      !> Numbers of the columns that hold numbers; 0 for one that there is not
      integer, intent(in) :: columns(:)

      type(csv_row_type) :: row
      type(error_type), allocatable :: error
      logical :: found
      integer :: i

      if (self%separator == ',') return
      self%mark%has_point = .false.
      do
         call self%next(row, found, error)
         if (.not. found) exit
         ! An error in a row is reported where the row is read
         if (allocated(error)) cycle
         do i = 1, size(columns)
            if (columns(i) > 0) call self%mark%look(row%cells(columns(i))%text)
         end do
      end do
   end subroutine find_decimal_mark

   !> What is not as RFC 4180 has it in a table
   pure function peculiarities(self) result(text)
      class(csv_table_type), intent(in) :: self
      !> ', this, that'
      character(len=100) :: text

      text = ''
      if (self%separator == ';') text = ', columns separated by semicolons'
      if (self%separator == tab) text = ', columns separated by tabs'
      if (self%mark%has_comma) text = trim(text)//', decimal commas'
      if (self%title_line > 0) text = trim(text)//', line '//to_text(self%title_line)//' is a title'
   end function peculiarities

   !> Length of the note
   pure integer function note_length(self)
      class(csv_table_type), intent(in) :: self

      note_length = len_trim(peculiarities(self))
      if (note_length > 0) note_length = note_length + len(self%file) + len(read_with) - 1
   end function note_length

   !> How the table was read, where it is not as RFC 4180 has it
   pure function note(self)
      class(csv_table_type), intent(in) :: self
      !> 'file: ...', empty if there is nothing to say
      character(len=note_length(self)) :: note

      character(len=100) :: text

      if (len(note) == 0) return
      text = peculiarities(self)
      note = self%file//read_with//text(2:)
   end function note

   !> Take the next row; after an error the rows behind it can be taken
   subroutine next(self, row, found, error)
      class(csv_table_type), intent(in) :: self
      !> The row before, or one without a value
      type(csv_row_type), intent(inout) :: row
      !> Was there a row, right or wrong?
      logical, intent(out) :: found
      !> The row is wrong
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: text, hint
      integer :: i

      if (row%at == 0) row = self%header
      call read_row(self, row, text, error)
      found = row%line > 0
      if (allocated(error) .or. .not. found) return
      call split(self, row, text, error)
      if (allocated(error)) return
      associate (width => size(self%header%cells))
         if (size(row%cells) /= width) then
            hint = ''
            if (self%separator == ',' .and. size(row%cells) > width) then
               hint = ' (columns separated by commas need decimal points)'
            end if
            call raise_input(error, self%place(row)//': '//to_text(size(row%cells))//' cells: must be '// &
               & to_text(width)//' as in the header'//hint)
            return
         end if
         do i = size(self%columns) + 1, width
            if (len_trim(row%cells(i)%text) == 0) cycle
            call raise_input(error, self%place(row)//': cell '//to_text(i)//' = '''//row%cells(i)%text// &
               & ''': its column has no name')
            return
         end do
      end associate
   end subroutine next

   !> Read the names of the columns; a title above them is passed over
   subroutine read_header(self, error)
      !> The table, its text known: the header is found, its line 0 if there are no rows, and the separator
      type(csv_table_type), intent(inout) :: self
      !> A row that is none
      type(error_type), allocatable, intent(out) :: error

      type(csv_row_type) :: first, second
      character(len=:), allocatable :: text, below

      self%separator = unknown
      first = self%header
      call read_row(self, first, text, error)
      if (allocated(error) .or. first%line == 0) return
      call count_separators(self, text)
      second = first
      call read_row(self, second, below, error)
      if (allocated(error)) return
      if (second%line > 0) then
         if (is_title(text, below)) then
            self%title_line = first%line
            first = second
            call move_alloc(below, text)
            call count_separators(self, text)
         end if
      end if
      self%separator = self%header_separator
      call split(self, first, text, error)
      self%header = first
   end subroutine read_header

   !> Note the separators of a row that may be the header
   subroutine count_separators(self, row)
      type(csv_table_type), intent(inout) :: self
      !> Text of the row
      character(len=*), intent(in) :: row

      self%header_separator = separator_of(row)
      self%header_separators = occurrences(row, self%header_separator)
   end subroutine count_separators

   !> Check the names of the columns and take them
   subroutine check_header(self, error)
      !> The table, its header known: its columns are set
      type(csv_table_type), intent(inout) :: self
      !> A name is empty or is a duplicate
      type(error_type), allocatable, intent(out) :: error

      type(name_index_type) :: names
      integer :: i, last, before

      associate (cells => self%header%cells)
         do last = size(cells), 2, -1
            if (len_trim(cells(last)%text) > 0) exit
         end do
         do i = 1, last
            if (len_trim(cells(i)%text) == 0) then
               call raise_input(error, self%place(self%header)//': column '//to_text(i)//' has no name')
               return
            end if
            if (len_trim(unseen_end(cells(i)%text)) > 0) then
               call raise_input(error, self%place(self%header)//': column '''//cells(i)%text//''': has '// &
                  & trim(unseen_end(cells(i)%text)))
               return
            end if
            call names%note(lower(cells(i)%text), i, before)
            if (before > 0) then
               call raise_input(error, self%place(self%header)//': column '''//cells(i)%text//''' is a duplicate')
               return
            end if
         end do
         self%columns = cells(:last)
      end associate
   end subroutine check_header

   !> A character at one of the ends of a name that nobody sees, so that the name looks like another; blank if there is none
   pure function unseen_end(name) result(character_name)
      character(len=*), intent(in) :: name
      character(len=odd_length) :: character_name

      ! No such character has more than three bytes
      character_name = odd_character(name(:min(3, len(name))))
      if (len_trim(character_name) == 0) character_name = odd_character(name(max(1, len(name) - 2):))
      if (index(character_name, 'space') == 0 .and. index(character_name, 'invisible') == 0) character_name = ''
   end function unseen_end

   !> Read the text of the next row
   subroutine read_row(self, row, text, error)
      type(csv_table_type), intent(in) :: self
      !> The row before: where the next is is set, line 0 if there are no more rows
      type(csv_row_type), intent(inout) :: row
      !> Its text, lines joined where a quoted cell holds line ends
      character(len=:), allocatable, intent(out) :: text
      !> A quote that is not closed, more bytes than a row of a table has, a line that is refused
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: more
      integer :: length, quotes
      logical :: found

      row%line = 0
      do
         call read_line(self, row, text, found, error)
         if (allocated(error) .or. .not. found) return
         ! Blank lines, and rows of empty cells
         if (self%separator == unknown) then
            if (verify(text, padding//',;') == 0) cycle
         else if (verify(text, padding//self%separator) == 0) then
            cycle
         end if
         if (index(adjustl(text), '#') /= 1) exit
         ! A spreadsheet writes #N/A into a cell, and a wall may have the name #12.
         if (self%header_separators == 0) cycle
         if (occurrences(text, self%header_separator) /= self%header_separators) cycle
         row%line = row%number
         call raise_input(error, self%place(row)//': begins with # as a comment does, but has as many cells as the header: '// &
            & 'mend the cell or put it in double quotes, or remove the line')
         return
      end do
      row%line = row%number
      quotes = occurrences(text, '"')
      length = len(text)
      ! An odd number of quotes: the last one opens a cell that goes on in the next line
      do while (modulo(quotes, 2) == 1)
         call read_line(self, row, more, found, error)
         if (allocated(error)) return
         if (.not. found) then
            call raise_input(error, self%place(row)//': a double quote is not closed')
            return
         end if
         quotes = quotes + occurrences(more, '"')
         if (length + len(more) >= longest_line) then
            call raise_input(error, self%place(row)//': a double quote is not closed within '//to_text(longest_line)// &
               & ' bytes')
            return
         end if
         call append(text, length, new_line('a')//more)
      end do
      text = text(:length)
   end subroutine read_row

   !> Read the next line: lines end in LF or CRLF
   subroutine read_line(self, row, line, found, error)
      type(csv_table_type), intent(in) :: self
      !> Where it is
      type(csv_row_type), intent(inout) :: row
      !> The line without its end; what may follow the last line, such as NUL or Ctrl-Z, is dropped from it
      character(len=:), allocatable, intent(out) :: line
      !> Was there one?
      logical, intent(out) :: found
      !> The line is too long or not UTF-8; there are no more then
      type(error_type), allocatable, intent(out) :: error

      character(len=*), parameter :: line_feed = achar(10), return = achar(13)
      character(len=:), allocatable :: problem
      integer :: length, last

      line = ''
      found = row%at <= len(self%text)
      if (.not. found) return
      length = index(self%text(row%at:), line_feed) - 1
      last = row%at + length - 1
      if (length < 0) last = len(self%text)
      if (last - row%at >= longest_line) then
         call raise_input(error, self%file//': line '//to_text(row%number + 1)//': longer than '//to_text(longest_line)//' bytes')
      else if (length < 0) then
         line = self%text(row%at:row%at - 1 + verify(self%text(row%at:), padding, back=.true.))
      else
         line = self%text(row%at:row%at - 1 + verify(self%text(row%at:last), return, back=.true.))
      end if
      row%at = last + 2
      row%number = row%number + 1
      if (.not. (self%is_ascii .or. allocated(error))) then
         if (.not. is_utf8(line)) then
            call encoding_problem(line, problem)
            call raise_input(error, self%file//': line '//to_text(row%number)//': '//problem)
         end if
      end if
      if (.not. allocated(error)) return
      found = .false.
      row%at = len(self%text) + 1
   end subroutine read_line

   !> Split a row into its cells
   subroutine split(self, row, text, error)
      type(csv_table_type), intent(in) :: self
      !> The row: its cells are set
      type(csv_row_type), intent(inout) :: row
      !> Text of the row
      character(len=*), intent(in) :: text
      !> A quote where it may not be, or more cells than a row of a table has
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: problem

      call split_row(text, self%separator, row%cells, problem)
      if (len(problem) > 0) call raise_input(error, self%place(row)//': '//problem)
   end subroutine split

   !> Append a text; the room for it is doubled, so that not all is copied each time
   pure subroutine append(line, length, more)
      !> Room, at least as long as what is in it
      character(len=:), allocatable, intent(inout) :: line
      !> Length of what is in it
      integer, intent(inout) :: length
      !> What comes behind it
      character(len=*), intent(in) :: more

      if (length + len(more) > len(line)) line = line(:length)//repeat(' ', max(length, len(more)))
      line(length + 1:length + len(more)) = more
      length = length + len(more)
   end subroutine append

   !> Number of a column from its name
   pure integer function column(self, name)
      class(csv_table_type), intent(in) :: self
      !> Name, in upper or lower case; there is none with number 0
      character(len=*), intent(in) :: name

      do column = size(self%columns), 1, -1
         if (lower(self%columns(column)%text) == lower(name)) exit
      end do
   end function column

   !> Length of the place
   pure integer function place_length(self, row)
      class(csv_table_type), intent(in) :: self
      type(csv_row_type), intent(in) :: row

      place_length = len(self%file//': line '//to_text(row%line))
   end function place_length

   !> Where a row is, for messages
   pure function place(self, row)
      class(csv_table_type), intent(in) :: self
      type(csv_row_type), intent(in) :: row
      !> 'file: line 7'
      character(len=place_length(self, row)) :: place

      place = self%file//': line '//to_text(row%line)
   end function place

   !> Length of a cell
   pure integer function cell_length(self, column)
      class(csv_row_type), intent(in) :: self
      !> Number of the column, or 0
      integer, intent(in) :: column

      cell_length = 0
      if (column > 0) cell_length = len(self%cells(column)%text)
   end function cell_length

   !> A cell of the row as text
   pure function get_text(self, column) result(text)
      class(csv_row_type), intent(in) :: self
      !> Number of the column; 0 gives an empty text
      integer, intent(in) :: column
      !> Text of the cell
      character(len=cell_length(self, column)) :: text

      if (column > 0) text = self%cells(column)%text
   end function get_text

   !> A cell of a row as a number
   subroutine get_real(self, row, column, value, error)
      class(csv_table_type), intent(in) :: self
      type(csv_row_type), intent(in) :: row
      !> Number of the column, from 1
      integer, intent(in) :: column
      !> Number in the cell
      real(wp), intent(out) :: value
      !> The cell is not one finite decimal number, or may be one of two; the place is left to be added
      type(error_type), allocatable, intent(out) :: error

      logical :: ok

      associate (cell => row%cells(column)%text)
         call self%mark%parse(cell, value, ok)
         if (.not. ok) call raise_input(error, self%columns(column)%text//' = '''//cell//''': '// &
            & trim(self%mark%problem(cell)), not_a_number, self%columns(column)%text)
      end associate
   end subroutine get_real

end module dondolo_files_csv_reader
