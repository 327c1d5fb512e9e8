!> A row of a CSV table: what separates its cells, and the cells.
module dondolo_csv_row
   use dondolo_limits, only : most_cells
   use dondolo_text, only : blanks, occurrences, stripped, to_text
   implicit none
   private

   public :: cell_type, split_row, separator_of, is_title

   character(len=1), parameter :: tab = achar(9)

   !> One cell
   type :: cell_type
      !> Its text
      character(len=:), allocatable :: text
   end type cell_type

contains

   !> Split a row into its cells
   pure subroutine split_row(row, separator, cells, problem)
      !> Text of the row, with an even number of double quotes
      character(len=*), intent(in) :: row
      !> What separates the cells
      character(len=1), intent(in) :: separator
      !> The cells
      type(cell_type), allocatable, intent(out) :: cells(:)
      !> A quote where it may not be, or more cells than a row of a table has; empty if there is none
      character(len=:), allocatable, intent(out) :: problem

      integer :: at, count

      allocate (cells(min(occurrences(row, separator) + 1, most_cells)))
      at = 1
      count = 0
      problem = ''
      do while (at <= len(row) + 1)
         if (count == most_cells) then
            problem = 'more than '//to_text(most_cells)//' cells'
            return
         end if
         count = count + 1
         call take_cell(row, separator, at, cells(count)%text, problem)
         if (len(problem) == 0) cycle
         problem = 'cell '//to_text(count)//': '//problem
         return
      end do
      cells = cells(:count)
   end subroutine split_row

   !> Read one cell
   pure subroutine take_cell(line, separator, at, cell, problem)
      !> Line, or several joined where a quoted cell holds line ends
      character(len=*), intent(in) :: line
      !> What separates the cells
      character(len=1), intent(in) :: separator
      !> Position: where the cell begins, then after the separator that ends it
      integer, intent(inout) :: at
      !> Its text
      character(len=:), allocatable, intent(out) :: cell
      !> What is wrong, or empty
      character(len=:), allocatable, intent(out) :: problem

      character(len=2) :: spaces
      integer :: first, mark, length

      problem = ''
      cell = ''
      spaces = blanks
      if (separator == tab) spaces = ' '
      first = verify(line(at:), spaces) + at - 1
      if (first >= at) then
         if (line(first:first) == '"') then
            call take_quoted(line, first, mark, cell)
            length = length_to(separator, line(mark:))
            if (verify(line(mark:mark + length - 1), spaces) > 0) problem = 'text after the closing double quote'
            at = mark + length + 1
            return
         end if
      end if
      length = length_to(separator, line(at:))
      if (index(line(at:at + length - 1), '"') > 0) then
         problem = 'a double quote inside: put the cell in double quotes and double the ones inside'
      end if
      if (length > 0) cell = stripped(line(at:at + length - 1))
      at = at + length + 1
   end subroutine take_cell

   !> Length of a text up to the first separator, or its end
   pure integer function length_to(separator, text) result(length)
      !> Separator
      character(len=1), intent(in) :: separator
      !> Text
      character(len=*), intent(in) :: text

      length = index(text, separator) - 1
      if (length < 0) length = len(text)
   end function length_to

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

   !> Is the first row a title above the names of the columns?
   pure logical function is_title(first, second)
      !> Texts of the first two rows
      character(len=*), intent(in) :: first, second

      is_title = .not. is_one_cell(second) .and. (is_one_cell(first) .or. &
         & (separator_of(first) == ',' .and. separator_of(second) /= ','))
   end function is_title

   !> Is only one cell of a row not empty?
   pure logical function is_one_cell(row)
      !> Text of the row
      character(len=*), intent(in) :: row

      character(len=1) :: separator

      separator = separator_of(row)
      associate (first => verify(row, blanks//separator), last => verify(row, blanks//separator, back=.true.))
         is_one_cell = .not. has_outside_quotes(row(first:last), separator)
      end associate
   end function is_one_cell

   !> What separates the cells of a row
   pure function separator_of(row) result(separator)
      !> Text of the row
      character(len=*), intent(in) :: row
      !> A comma where there is one, unless empty cells at the end are separated by semicolons or tabs; else a semicolon
      !> or a tab, if there is one
      character(len=1) :: separator

      separator = ','
      if (has_outside_quotes(row, ',') .and. scan(row(len(row):), ';'//tab) == 0) return
      if (has_outside_quotes(row, tab)) separator = tab
      if (has_outside_quotes(row, ';')) separator = ';'
   end function separator_of

   !> Is a character in a row, outside of double quotes?
   pure logical function has_outside_quotes(row, character) result(has)
      !> Text of the row
      character(len=*), intent(in) :: row
      !> Character
      character(len=1), intent(in) :: character

      integer :: i
      logical :: is_quoted

      has = .false.
      is_quoted = .false.
      do i = 1, len(row)
         if (row(i:i) == '"') is_quoted = .not. is_quoted
         has = row(i:i) == character .and. .not. is_quoted
         if (has) return
      end do
   end function has_outside_quotes

end module dondolo_csv_row
