!> Tables in CSV files (RFC 4180), row by row, within a memory that does not depend on their length.
!>
!> The first row names the columns. Cells are separated by commas; a cell in double quotes may hold commas, line ends and,
!> doubled, quotes. Blank lines and lines that begin with # are skipped; blanks around cells without quotes do not count.
!>
!> Tables of spreadsheets may differ from this: semicolons or tabs between the columns, then with decimal commas if the
!> numbers show them (`find_decimal_mark`); a title above the names of the columns; rows and columns of empty cells at the
!> end. `note` says how such a table was read.
module dondolo_csv_reader
   use dondolo_csv_row, only : cell_type, is_title, separator_of, split_row
   use dondolo_decimal_mark, only : decimal_mark_type
   use dondolo_error, only : error_type, raise_input
   use dondolo_kinds, only : wp
   use dondolo_limits, only : longest_line
   use dondolo_line_reader, only : line_reader_type
   use dondolo_name_index, only : name_index_type
   use dondolo_odd_character, only : odd_character, odd_length
   use dondolo_text, only : lower, occurrences, to_text
   use dondolo_text_file, only : padding
   implicit none
   private

   public :: csv_reader_type

   character(len=1), parameter :: tab = achar(9)

   !> What comes before the peculiarities of a table
   character(len=*), parameter :: read_with = ': read with'

   !> Separator of cells as long as the header was not read
   character(len=1), parameter :: unknown = ' '

   !> A table that is being read
   type :: csv_reader_type
      !> Names of the columns
      type(cell_type), allocatable :: columns(:)
      !> Cells of the row that was read last
      type(cell_type), allocatable :: cells(:)
      !> Line in which it begins
      integer :: line = 0
      !> Lines of the file
      type(line_reader_type) :: lines
      !> What separates the cells: a comma, a semicolon or a tab
      character(len=1), private :: separator = ','
      !> The same, of the row that is or may be the header, and how many it has
      character(len=1), private :: header_separator = unknown
      integer, private :: header_separators = 0
      !> Decimal mark of its numbers: a point, unless they show another
      type(decimal_mark_type), private :: mark
      !> Cells of the header, with those at its end that name no column
      integer, private :: width = 0
      !> Line of the title, 0 if there is none
      integer, private :: title_line = 0
      !> Text and line of a row that was read to know the header, and is the next; not allocated: none
      character(len=:), allocatable, private :: held
      integer, private :: held_line = 0
   contains
      !> Open a table and read its header
      procedure :: open => open_table
      !> Find out the decimal mark
      procedure :: find_decimal_mark
      !> How the table was read, for messages
      procedure :: note
      !> Read the next row
      procedure :: next
      !> Number of a column from its name
      procedure :: column
      !> Where the row is, for messages
      procedure :: place
      !> A cell of the row as text
      procedure :: get_text
      !> A cell of the row as a number
      procedure :: get_real
      !> Close the file before the end is reached
      procedure :: close => close_table
   end type csv_reader_type

contains

   !> Open a table and read its header
   subroutine open_table(self, file, error)
      class(csv_reader_type), intent(inout) :: self
      !> Path of the file
      character(len=*), intent(in) :: file
      !> The file is missing, or its header is wrong
      type(error_type), allocatable, intent(out) :: error

      if (allocated(self%columns)) deallocate (self%columns)
      if (allocated(self%held)) deallocate (self%held)
      self%title_line = 0
      self%mark = decimal_mark_type()
      call self%lines%open(file, error)
      if (allocated(error)) return
      call read_header(self, error)
      if (.not. allocated(error)) then
         if (self%line == 0) then
            call raise_input(error, file//': no header: the first line must name the columns')
         else
            call take_header(self, error)
         end if
      end if
      if (allocated(error)) call self%close()
   end subroutine open_table

   !> Find out the decimal mark of a table that was opened; it is open as before afterwards
   !>
   !> All rows are read once, unless the cells are separated by commas, where it is a point.
   subroutine find_decimal_mark(self, columns, error)
      !> The reader, no row read
      class(csv_reader_type), intent(inout) :: self
      !> Numbers of the columns that hold numbers; 0 for one that there is not
      integer, intent(in) :: columns(:)
      !> The file cannot be opened again
      type(error_type), allocatable, intent(out) :: error

      type(decimal_mark_type) :: mark
      logical :: found
      integer :: i

      if (self%separator == ',') return
      mark%has_point = .false.
      do
         call self%next(found, error)
         if (.not. found) exit
         ! What is wrong in a row is found once more where it is read
         if (allocated(error)) cycle
         do i = 1, size(columns)
            if (columns(i) > 0) call mark%look(self%cells(columns(i))%text)
         end do
      end do
      call self%close()
      call self%open(self%lines%file, error)
      self%mark = mark
   end subroutine find_decimal_mark

   !> What is not as RFC 4180 has it in a table
   pure function peculiarities(self) result(text)
      class(csv_reader_type), intent(in) :: self
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
      class(csv_reader_type), intent(in) :: self

      note_length = len_trim(peculiarities(self))
      if (note_length > 0) note_length = note_length + len(self%lines%file) + len(read_with) - 1
   end function note_length

   !> How the table was read, where it is not as RFC 4180 has it
   pure function note(self)
      class(csv_reader_type), intent(in) :: self
      !> 'file: ...', empty if there is nothing to say
      character(len=note_length(self)) :: note

      character(len=100) :: text

      if (len(note) == 0) return
      text = peculiarities(self)
      note = self%lines%file//read_with//text(2:)
   end function note

   !> Read the next row; after an error the rows behind it can be read
   subroutine next(self, found, error)
      !> The reader: its cells are set
      class(csv_reader_type), intent(inout) :: self
      !> Was there a row, right or wrong?
      logical, intent(out) :: found
      !> The row is wrong
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: row, hint
      integer :: i

      call read_row(self, row, error)
      found = self%line > 0
      if (allocated(error) .or. .not. found) return
      call split(self, row, error)
      if (allocated(error)) return
      if (size(self%cells) /= self%width) then
         hint = ''
         if (self%separator == ',' .and. size(self%cells) > self%width) then
            hint = ' (columns separated by commas need decimal points)'
         end if
         call raise_input(error, self%place()//': '//to_text(size(self%cells))//' cells: must be '// &
            & to_text(self%width)//' as in the header'//hint)
         return
      end if
      do i = size(self%columns) + 1, self%width
         if (len_trim(self%cells(i)%text) == 0) cycle
         call raise_input(error, self%place()//': cell '//to_text(i)//' = '''//self%cells(i)%text// &
            & ''': its column has no name')
         return
      end do
   end subroutine next

   !> Read the names of the columns; a title above them is passed over
   subroutine read_header(self, error)
      !> The reader: its line is 0 if there are no rows, its separator is known
      type(csv_reader_type), intent(inout) :: self
      !> A row that is none
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: first, second
      integer :: line

      self%separator = unknown
      self%header_separators = 0
      call read_row(self, first, error)
      if (allocated(error) .or. self%line == 0) return
      line = self%line
      call count_separators(self, first)
      call read_row(self, second, error)
      if (allocated(error)) return
      if (self%line > 0) then
         if (is_title(first, second)) then
            self%title_line = line
            line = self%line
            call move_alloc(second, first)
            call count_separators(self, first)
         else
            call move_alloc(second, self%held)
            self%held_line = self%line
         end if
      end if
      self%line = line
      self%separator = self%header_separator
      call split(self, first, error)
   end subroutine read_header

   !> Note the separators of a row that may be the header
   subroutine count_separators(self, row)
      type(csv_reader_type), intent(inout) :: self
      !> Text of the row
      character(len=*), intent(in) :: row

      self%header_separator = separator_of(row)
      self%header_separators = occurrences(row, self%header_separator)
   end subroutine count_separators

   !> Take the row that was read as the names of the columns
   subroutine take_header(self, error)
      type(csv_reader_type), intent(inout) :: self
      !> A name is empty or is a duplicate
      type(error_type), allocatable, intent(out) :: error

      type(name_index_type) :: names
      integer :: i, last, before

      self%width = size(self%cells)
      do last = self%width, 2, -1
         if (len_trim(self%cells(last)%text) > 0) exit
      end do
      associate (row => self%cells)
         if (index(row(1)%text, 'PK'//achar(3)//achar(4)) == 1) then
            call raise_input(error, self%lines%file//': is a workbook of a spreadsheet or another archive: save its table as CSV')
            return
         end if
         do i = 1, last
            if (len_trim(row(i)%text) == 0) then
               call raise_input(error, self%place()//': column '//to_text(i)//' has no name')
               return
            end if
            if (len_trim(unseen_end(row(i)%text)) > 0) then
               call raise_input(error, self%place()//': column '''//row(i)%text//''': has '//trim(unseen_end(row(i)%text)))
               return
            end if
            call names%note(lower(row(i)%text), i, before)
            if (before > 0) then
               call raise_input(error, self%place()//': column '''//row(i)%text//''' is a duplicate')
               return
            end if
         end do
      end associate
      self%columns = self%cells(:last)
   end subroutine take_header

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
   subroutine read_row(self, row, error)
      !> The reader: its line is 0 if there are no more rows
      type(csv_reader_type), intent(inout) :: self
      !> Its text, lines joined where a quoted cell holds line ends
      character(len=:), allocatable, intent(out) :: row
      !> A quote that is not closed, more bytes than a row of a table has, a line that is refused
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: more
      integer :: length, quotes
      logical :: found

      self%line = 0
      if (allocated(self%held)) then
         call move_alloc(self%held, row)
         self%line = self%held_line
         return
      end if
      do
         call self%lines%next(row, found, error)
         if (allocated(error) .or. .not. found) return
         ! Blank lines, and rows of empty cells
         if (self%separator == unknown) then
            if (verify(row, padding//',;') == 0) cycle
         else if (verify(row, padding//self%separator) == 0) then
            cycle
         end if
         if (index(adjustl(row), '#') /= 1) exit
         ! A spreadsheet writes #N/A into a cell, and a wall may have the name #12.
         if (self%header_separators == 0) cycle
         if (occurrences(row, self%header_separator) /= self%header_separators) cycle
         self%line = self%lines%number
         call raise_input(error, self%place()//': begins with # as a comment does, but has as many cells as the header: '// &
            & 'mend the cell or put it in double quotes, or remove the line')
         return
      end do
      self%line = self%lines%number
      quotes = occurrences(row, '"')
      length = len(row)
      ! An odd number of quotes: the last one opens a cell that goes on in the next line
      do while (modulo(quotes, 2) == 1)
         call self%lines%next(more, found, error)
         if (allocated(error)) return
         if (.not. found) then
            call raise_input(error, self%place()//': a double quote is not closed')
            return
         end if
         quotes = quotes + occurrences(more, '"')
         if (length + len(more) >= longest_line) then
            call raise_input(error, self%place()//': a double quote is not closed within '//to_text(longest_line)// &
               & ' bytes')
            return
         end if
         call append(row, length, new_line('a')//more)
      end do
      row = row(:length)
   end subroutine read_row

   !> Split a row into its cells
   subroutine split(self, row, error)
      !> The reader: its cells are set
      type(csv_reader_type), intent(inout) :: self
      !> Text of the row
      character(len=*), intent(in) :: row
      !> A quote where it may not be, or more cells than a row of a table has
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: problem

      call split_row(row, self%separator, self%cells, problem)
      if (len(problem) > 0) call raise_input(error, self%place()//': '//problem)
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
      class(csv_reader_type), intent(in) :: self
      !> Name, in upper or lower case; there is none with number 0
      character(len=*), intent(in) :: name

      do column = size(self%columns), 1, -1
         if (lower(self%columns(column)%text) == lower(name)) exit
      end do
   end function column

   !> Length of the place
   pure integer function place_length(self)
      class(csv_reader_type), intent(in) :: self

      place_length = len(self%lines%file//': line '//to_text(self%line))
   end function place_length

   !> Where the row is, for messages
   pure function place(self)
      class(csv_reader_type), intent(in) :: self
      !> 'file: line 7'
      character(len=place_length(self)) :: place

      place = self%lines%file//': line '//to_text(self%line)
   end function place

   !> Length of a cell
   pure integer function cell_length(self, column)
      class(csv_reader_type), intent(in) :: self
      !> Number of the column, or 0
      integer, intent(in) :: column

      cell_length = 0
      if (column > 0) cell_length = len(self%cells(column)%text)
   end function cell_length

   !> A cell of the row as text
   pure function get_text(self, column) result(text)
      class(csv_reader_type), intent(in) :: self
      !> Number of the column; 0 gives an empty text
      integer, intent(in) :: column
      !> Text of the cell
      character(len=cell_length(self, column)) :: text

      if (column > 0) text = self%cells(column)%text
   end function get_text

   !> A cell of the row as a number
   subroutine get_real(self, column, value, error)
      class(csv_reader_type), intent(in) :: self
      !> Number of the column, from 1
      integer, intent(in) :: column
      !> Number in the cell
      real(wp), intent(out) :: value
      !> The cell is not one finite decimal number, or may be one of two; the place is left to be added
      type(error_type), allocatable, intent(out) :: error

      logical :: ok

      associate (cell => self%cells(column)%text)
         call self%mark%parse(cell, value, ok)
         if (.not. ok) call raise_input(error, self%columns(column)%text//' = '''//cell//''': '//trim(self%mark%problem(cell)))
      end associate
   end subroutine get_real

   !> Close the file before the end is reached
   subroutine close_table(self)
      class(csv_reader_type), intent(inout) :: self

      call self%lines%close()
   end subroutine close_table

end module dondolo_csv_reader
