!> Tables in CSV files (RFC 4180): a header with the names of the columns, then one row a line.
!>
!> Cells are separated by commas; a cell in double quotes may hold commas, line ends and, doubled, quotes.
!> Blank lines and lines that begin with # are skipped; blanks around cells without quotes do not count.
module dondolo_csv
   use dondolo_error, only : error_type, raise_input
   use dondolo_kinds, only : wp
   use dondolo_numbers, only : parse_real
   use dondolo_text, only : lower, to_text
   use dondolo_text_file, only : read_text_file, text_file_type
   implicit none
   private

   public :: csv_table_type, read_csv

   !> Blanks around cells
   character(len=*), parameter :: blanks = ' '//achar(9)

   !> One cell
   type :: cell_type
      !> Its text
      character(len=:), allocatable :: text
   end type cell_type

   !> A table
   type :: csv_table_type
      !> Path of the file
      character(len=:), allocatable :: file
      !> Names of the columns
      type(cell_type), allocatable :: columns(:)
      !> Cells, cells(column, row)
      type(cell_type), allocatable :: cells(:, :)
      !> Line of the file in which each row begins
      integer, allocatable :: line(:)
   contains
      !> Number of rows
      procedure :: rows
      !> Number of a column from its name
      procedure :: column
      !> Where a row is, for messages
      procedure :: place
      !> A cell as text
      procedure :: get_text
      !> A cell as a number
      procedure :: get_real
   end type csv_table_type

contains

   !> Read a table
   subroutine read_csv(file, table, error)
      !> Path of the file
      character(len=*), intent(in) :: file
      !> The table
      type(csv_table_type), intent(out) :: table
      !> The file is missing or not a table
      type(error_type), allocatable, intent(out) :: error

      type(text_file_type) :: text
      type(cell_type), allocatable :: row(:)
      integer :: next, begin, rows

      call read_text_file(file, text, error)
      if (allocated(error)) return
      table%file = file
      allocate (table%line(text%lines()))
      rows = 0
      next = 1
      do
         call next_row(text, next, begin, row, error)
         if (allocated(error)) return
         if (begin == 0) exit
         if (.not. allocated(table%columns)) then
            call take_header(text, begin, row, table, error)
            if (allocated(error)) return
            allocate (table%cells(size(row), text%lines()))
            cycle
         end if
         if (size(row) /= size(table%columns)) then
            call raise_input(error, text%place(begin)//': '//to_text(size(row))//' cells: must be '// &
               & to_text(size(table%columns))//' as in the header')
            return
         end if
         rows = rows + 1
         table%cells(:, rows) = row
         table%line(rows) = begin
      end do
      if (.not. allocated(table%columns)) then
         call raise_input(error, file//': no header: the first line must name the columns')
         return
      end if
      table%line = table%line(:rows)
      table%cells = table%cells(:, :rows)
   end subroutine read_csv

   !> Take the first row as the names of the columns
   subroutine take_header(text, line, row, table, error)
      !> The file
      type(text_file_type), intent(in) :: text
      !> Line of the header
      integer, intent(in) :: line
      !> Its cells
      type(cell_type), intent(in) :: row(:)
      !> The table
      type(csv_table_type), intent(inout) :: table
      !> A name is empty or stands there twice
      type(error_type), allocatable, intent(out) :: error

      integer :: i, j

      if (size(row) == 1 .and. index(row(1)%text, ';') > 0) then
         call raise_input(error, text%place(line)//': header '''//row(1)%text// &
            & ''': columns must be separated by commas')
         return
      end if
      do i = 1, size(row)
         if (len_trim(row(i)%text) == 0) then
            call raise_input(error, text%place(line)//': column '//to_text(i)//' has no name')
            return
         end if
         do j = 1, i - 1
            if (lower(row(i)%text) /= lower(row(j)%text)) cycle
            call raise_input(error, text%place(line)//': column '''//row(i)%text//''' stands there twice')
            return
         end do
      end do
      table%columns = row
   end subroutine take_header

   !> Read the cells of the next row
   subroutine next_row(text, next, begin, row, error)
      !> The file
      type(text_file_type), intent(in) :: text
      !> Line to go on from
      integer, intent(inout) :: next
      !> Line in which the row begins, 0 if there are no more
      integer, intent(out) :: begin
      !> Its cells
      type(cell_type), allocatable, intent(out) :: row(:)
      !> A quote that is not closed or stands where it may not
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: line, problem
      integer :: at, cells, separators, quotes

      begin = 0
      do while (next <= text%lines())
         line = text%line(next)
         next = next + 1
         if (verify(line, blanks) == 0) cycle
         if (line(1:1) == '#') cycle
         begin = next - 1
         exit
      end do
      if (begin == 0) return
      quotes = occurrences(line, '"')
      if (modulo(quotes, 2) == 1) then
         ! The last quote opens a cell that goes on in the next line
         do while (modulo(quotes, 2) == 1 .and. next <= text%lines())
            quotes = quotes + occurrences(text%text(text%first(next):text%last(next)), '"')
            next = next + 1
         end do
         if (modulo(quotes, 2) == 1) then
            call raise_input(error, text%place(begin)//': a double quote is not closed')
            return
         end if
         line = text%text(text%first(begin):text%last(next - 1))
      end if
      separators = occurrences(line, ',')
      allocate (row(separators + 1))
      at = 1
      cells = 0
      do while (at <= len(line) + 1)
         cells = cells + 1
         call take_cell(line, at, row(cells)%text, problem)
         if (len(problem) == 0) cycle
         call raise_input(error, text%place(begin)//': cell '//to_text(cells)//': '//problem)
         return
      end do
      row = row(:cells)
   end subroutine next_row

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
            length = index(line(mark:)//',', ',') - 1
            if (verify(line(mark:mark + length - 1), blanks) > 0) problem = 'text after the closing double quote'
            at = mark + length + 1
            return
         end if
      end if
      length = index(line(at:)//',', ',') - 1
      if (index(line(at:at + length - 1), '"') > 0) then
         problem = 'a double quote inside: put the cell in double quotes and double the ones inside'
      end if
      if (length > 0) cell = stripped(line(at:at + length - 1))
      at = at + length + 1
   end subroutine take_cell

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

      integer :: length

      cell = ''
      mark = first + 1
      do
         ! The quotes of a line are even in number, so one is found, or the cell ends the line
         length = index(line(mark:), '"') - 1
         cell = cell//line(mark:mark + length - 1)
         mark = mark + length + 1
         if (mark > len(line)) return
         if (line(mark:mark) /= '"') return
         cell = cell//'"'
         mark = mark + 1
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

   !> Number of rows
   pure function rows(self)
      !> Table
      class(csv_table_type), intent(in) :: self
      !> Number of rows, without the header
      integer :: rows

      rows = size(self%line)
   end function rows

   !> Number of a column from its name
   pure function column(self, name)
      !> Table
      class(csv_table_type), intent(in) :: self
      !> Name, in upper or lower case
      character(len=*), intent(in) :: name
      !> Number of the column, 0 if there is none
      integer :: column

      do column = size(self%columns), 1, -1
         if (lower(self%columns(column)%text) == lower(name)) exit
      end do
   end function column

   !> Where a row is, for messages
   pure function place(self, row)
      !> Table
      class(csv_table_type), intent(in) :: self
      !> Number of the row
      integer, intent(in) :: row
      !> 'file: line 7'
      character(len=:), allocatable :: place

      place = self%file//': line '//to_text(self%line(row))
   end function place

   !> A cell as text
   pure function get_text(self, row, column) result(text)
      !> Table
      class(csv_table_type), intent(in) :: self
      !> Number of the row
      integer, intent(in) :: row
      !> Number of the column; 0 gives an empty text
      integer, intent(in) :: column
      !> Text of the cell
      character(len=:), allocatable :: text

      text = ''
      if (column > 0) text = self%cells(column, row)%text
   end function get_text

   !> A cell as a number
   subroutine get_real(self, row, column, value, error)
      !> Table
      class(csv_table_type), intent(in) :: self
      !> Number of the row
      integer, intent(in) :: row
      !> Number of the column
      integer, intent(in) :: column
      !> Number in the cell
      real(wp), intent(out) :: value
      !> The cell is not one finite decimal number
      type(error_type), allocatable, intent(out) :: error

      logical :: ok

      call parse_real(self%cells(column, row)%text, value, ok)
      if (ok) return
      call raise_input(error, self%place(row)//': '//self%columns(column)%text//' = '''// &
         & self%cells(column, row)%text//''': must be a number, with a decimal point')
   end subroutine get_real

end module dondolo_csv
