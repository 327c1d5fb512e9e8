!> Tables in CSV files (RFC 4180), row by row, within a memory that does not depend on their length.
!>
!> The first row names the columns. Cells are separated by commas; a cell in double quotes may hold commas, line ends and,
!> doubled, quotes. Blank lines and lines that begin with # are skipped; blanks around cells without quotes do not count.
module dondolo_csv_reader
   use dondolo_error, only : error_type, raise_input
   use dondolo_kinds, only : wp
   use dondolo_line_reader, only : line_reader_type, longest_line
   use dondolo_name_index, only : name_index_type
   use dondolo_numbers, only : parse_real
   use dondolo_text, only : lower, to_text
   use dondolo_text_file, only : padding
   implicit none
   private

   public :: csv_reader_type, cell_type

   !> Blanks around cells
   character(len=*), parameter :: blanks = ' '//achar(9)

   !> More cells in a row are surely no table
   integer, parameter :: most_cells = 10000

   !> One cell
   type :: cell_type
      !> Its text
      character(len=:), allocatable :: text
   end type cell_type

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
   contains
      !> Open a table and read its header
      procedure :: open => open_table
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
      !> The reader
      class(csv_reader_type), intent(inout) :: self
      !> Path of the file
      character(len=*), intent(in) :: file
      !> The file is missing, or its header is wrong
      type(error_type), allocatable, intent(out) :: error

      if (allocated(self%columns)) deallocate (self%columns)
      call self%lines%open(file, error)
      if (allocated(error)) return
      call read_cells(self, error)
      if (.not. allocated(error)) then
         if (self%line == 0) then
            call raise_input(error, file//': no header: the first line must name the columns')
         else
            call take_header(self, error)
         end if
      end if
      if (allocated(error)) call self%close()
   end subroutine open_table

   !> Read the next row; after an error the rows behind it can be read
   subroutine next(self, found, error)
      !> The reader: its cells are set
      class(csv_reader_type), intent(inout) :: self
      !> Was there a row, right or wrong?
      logical, intent(out) :: found
      !> The row is wrong
      type(error_type), allocatable, intent(out) :: error

      call read_cells(self, error)
      found = self%line > 0
      if (allocated(error) .or. .not. found) return
      if (size(self%cells) /= size(self%columns)) call raise_input(error, self%place()//': '// &
         & to_text(size(self%cells))//' cells: must be '//to_text(size(self%columns))//' as in the header')
   end subroutine next

   !> Take the row that was read as the names of the columns
   subroutine take_header(self, error)
      !> The reader
      type(csv_reader_type), intent(inout) :: self
      !> A name is empty or stands there twice
      type(error_type), allocatable, intent(out) :: error

      type(name_index_type) :: names
      integer :: i, before

      associate (row => self%cells)
         if (size(row) == 1 .and. index(row(1)%text, ';') > 0) then
            call raise_input(error, self%place()//': header '''//row(1)%text// &
               & ''': columns must be separated by commas')
            return
         end if
         do i = 1, size(row)
            if (len_trim(row(i)%text) == 0) then
               call raise_input(error, self%place()//': column '//to_text(i)//' has no name')
               return
            end if
            call names%note(lower(row(i)%text), i, before)
            if (before > 0) then
               call raise_input(error, self%place()//': column '''//row(i)%text//''' stands there twice')
               return
            end if
         end do
      end associate
      self%columns = self%cells
   end subroutine take_header

   !> Read the cells of the next row
   subroutine read_cells(self, error)
      !> The reader: its line is 0 if there are no more rows
      type(csv_reader_type), intent(inout) :: self
      !> A quote that is not closed or stands where it may not, or more cells or bytes than a row of a table has
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: line, more, problem
      integer :: at, cells, length, quotes
      logical :: found

      self%line = 0
      do
         call self%lines%next(line, found, error)
         if (allocated(error) .or. .not. found) return
         if (verify(line, padding) == 0) cycle
         if (line(1:1) /= '#') exit
      end do
      self%line = self%lines%number
      quotes = occurrences(line, '"')
      length = len(line)
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
         call append(line, length, new_line('a')//more)
      end do
      line = line(:length)
      if (allocated(self%cells)) deallocate (self%cells)
      allocate (self%cells(min(occurrences(line, ',') + 1, most_cells)))
      at = 1
      cells = 0
      do while (at <= len(line) + 1)
         if (cells == most_cells) then
            call raise_input(error, self%place()//': more than '//to_text(most_cells)//' cells')
            return
         end if
         cells = cells + 1
         call take_cell(line, at, self%cells(cells)%text, problem)
         if (len(problem) == 0) cycle
         call raise_input(error, self%place()//': cell '//to_text(cells)//': '//problem)
         return
      end do
      self%cells = self%cells(:cells)
   end subroutine read_cells

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

   !> Read one cell
   pure subroutine take_cell(line, at, cell, problem)
      !> Line, or several joined where a quoted cell holds line ends
      character(len=*), intent(in) :: line
      !> Position: where the cell begins, then after the comma that ends it
      integer, intent(inout) :: at
      !> Its text
      character(len=:), allocatable, intent(out) :: cell
      !> What is wrong, or empty
      character(len=:), allocatable, intent(out) :: problem

      integer :: first, mark, length

      problem = ''
      cell = ''
      first = verify(line(at:), blanks) + at - 1
      if (first >= at) then
         if (line(first:first) == '"') then
            call take_quoted(line, first, mark, cell)
            length = length_to_comma(line(mark:))
            if (verify(line(mark:mark + length - 1), blanks) > 0) problem = 'text after the closing double quote'
            at = mark + length + 1
            return
         end if
      end if
      length = length_to_comma(line(at:))
      if (index(line(at:at + length - 1), '"') > 0) then
         problem = 'a double quote inside: put the cell in double quotes and double the ones inside'
      end if
      if (length > 0) cell = stripped(line(at:at + length - 1))
      at = at + length + 1
   end subroutine take_cell

   !> Length of a text up to its first comma, or its end
   pure integer function length_to_comma(text) result(length)
      !> Text
      character(len=*), intent(in) :: text

      length = index(text, ',') - 1
      if (length < 0) length = len(text)
   end function length_to_comma

   !> Read a cell in double quotes
   pure subroutine take_quoted(line, first, mark, cell)
      !> Line, with an even number of double quotes
      character(len=*), intent(in) :: line
      !> Position of the opening quote
      integer, intent(in) :: first
      !> Position after the closing quote
      integer, intent(out) :: mark
      !> Text between them, doubled quotes made single
      character(len=:), allocatable, intent(out) :: cell

      integer :: i, at, doubled

      doubled = 0
      mark = first + 1
      do
         ! The quotes of a line are even in number, so one is found
         mark = mark + index(line(mark:), '"')
         if (mark > len(line)) exit
         if (line(mark:mark) /= '"') exit
         doubled = doubled + 1
         mark = mark + 1
      end do
      allocate (character(len=mark - first - 2 - doubled) :: cell)
      at = first
      do i = 1, len(cell)
         at = at + 1
         cell(i:i) = line(at:at)
         if (line(at:at) == '"') at = at + 1
      end do
   end subroutine take_quoted

   !> How often a character stands in a text
   pure function occurrences(text, character) result(count)
      !> Text
      character(len=*), intent(in) :: text
      !> Character
      character(len=1), intent(in) :: character
      !> How often
      integer :: count

      integer :: i

      count = 0
      do i = 1, len(text)
         if (text(i:i) == character) count = count + 1
      end do
   end function occurrences

   !> A text without the blanks and tabs around it
   pure function stripped(text)
      !> Text
      character(len=*), intent(in) :: text
      !> The same without blanks around
      character(len=:), allocatable :: stripped

      stripped = text(max(verify(text, blanks), 1):verify(text, blanks, back=.true.))
   end function stripped

   !> Number of a column from its name
   pure integer function column(self, name)
      !> Reader
      class(csv_reader_type), intent(in) :: self
      !> Name, in upper or lower case; there is none with number 0
      character(len=*), intent(in) :: name

      do column = size(self%columns), 1, -1
         if (lower(self%columns(column)%text) == lower(name)) exit
      end do
   end function column

   !> Where the row is, for messages
   pure function place(self)
      !> Reader
      class(csv_reader_type), intent(in) :: self
      !> 'file: line 7'
      character(len=:), allocatable :: place

      place = self%lines%file//': line '//to_text(self%line)
   end function place

   !> A cell of the row as text
   pure function get_text(self, column) result(text)
      !> Reader
      class(csv_reader_type), intent(in) :: self
      !> Number of the column; 0 gives an empty text
      integer, intent(in) :: column
      !> Text of the cell
      character(len=:), allocatable :: text

      text = ''
      if (column > 0) text = self%cells(column)%text
   end function get_text

   !> A cell of the row as a number
   subroutine get_real(self, column, value, error)
      !> Reader
      class(csv_reader_type), intent(in) :: self
      !> Number of the column, from 1
      integer, intent(in) :: column
      !> Number in the cell
      real(wp), intent(out) :: value
      !> The cell is not one finite decimal number; the place is left to be added
      type(error_type), allocatable, intent(out) :: error

      logical :: ok

      associate (cell => self%cells(column)%text)
         call parse_real(cell, value, ok)
         if (.not. ok) call raise_input(error, self%columns(column)%text//' = '''//cell// &
            & ''': must be a number, with a decimal point')
      end associate
   end subroutine get_real

   !> Close the file before the end is reached
   subroutine close_table(self)
      !> Reader
      class(csv_reader_type), intent(inout) :: self

      call self%lines%close()
   end subroutine close_table

end module dondolo_csv_reader
