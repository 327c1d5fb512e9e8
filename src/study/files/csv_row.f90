!> A row of a CSV table: what separates its cells, and the cells, read and written.
!>
!> A spreadsheet takes a cell that begins with = + - or @ for a formula, and with an apostrophe before it for a text. So
!> such an apostrophe is no part of a text that is read, and one that is part of a text is written twice.
module dondolo_files_csv_row
   use dondolo_base_limits, only : most_cells
   use dondolo_base_text, only : blanks, occurrences, stripped, to_text
   implicit none
   private

   public :: cell_type, split_row, separator_of, is_title, text_cell

   character(len=1), parameter :: tab = achar(9)

   !> What begins a formula, and what guards a text that begins so
   character(len=*), parameter :: formula = '=+-@', guard = ''''

   !> One cell
   type :: cell_type
      !> Its text
      character(len=:), allocatable :: text
   end type cell_type

contains

   !> Does an apostrophe guard a text?
   pure logical function is_guarded(text)
      !> Text
      character(len=*), intent(in) :: text

      is_guarded = .false.
      if (len(text) > 1) is_guarded = text(1:1) == guard .and. index(formula//guard, text(2:2)) > 0
   end function is_guarded

   !> Is an apostrophe to be written before a text?
   pure logical function needs_guard(text, is_safe)
      !> Text
      character(len=*), intent(in) :: text
      !> Is the cell to be no formula in a spreadsheet?
      logical, intent(in) :: is_safe

      needs_guard = is_guarded(text)
      if (is_safe .and. len(text) > 0) needs_guard = needs_guard .or. index(formula, text(1:1)) > 0
   end function needs_guard

   !> Must a text stand in quotes, by RFC 4180, or since its # would begin a comment, or its blanks would be lost?
   pure logical function needs_quotes(text)
      !> Text
      character(len=*), intent(in) :: text

      needs_quotes = scan(text, ',"#'//new_line('a')//achar(13)) > 0
      if (len(text) > 0) needs_quotes = needs_quotes .or. scan(text(1:1)//text(len(text):), blanks) > 0
   end function needs_quotes

   !> Length of a text as a cell
   pure integer function text_length(text, is_safe) result(length)
      !> Text
      character(len=*), intent(in) :: text
      !> Is the cell to be no formula in a spreadsheet?
      logical, intent(in) :: is_safe

      length = len(text)
      if (needs_quotes(text)) length = length + 2 + occurrences(text, '"')
      if (needs_guard(text, is_safe)) length = length + 1
   end function text_length

   !> A text as a cell, which `split_row` reads as the same text
   pure function text_cell(text, is_safe) result(cell)
      !> Text
      character(len=*), intent(in) :: text
      !> Is the cell to be no formula in a spreadsheet?
      logical, intent(in) :: is_safe
      !> Cell
      character(len=text_length(text, is_safe)) :: cell

      integer :: i, at

      if (len(cell) == len(text)) then
         cell = text
         return
      end if
      cell = '"'
      at = merge(1, 0, needs_quotes(text))
      if (needs_guard(text, is_safe)) at = at + 1
      if (needs_guard(text, is_safe)) cell(at:at) = guard
      do i = 1, len(text)
         at = at + 1
         cell(at:at) = text(i:i)
         if (text(i:i) /= '"') cycle
         at = at + 1
         cell(at:at) = '"'
      end do
      if (needs_quotes(text)) cell(at + 1:) = '"'
   end function text_cell

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
         if (is_guarded(cells(count)%text)) cells(count)%text = cells(count)%text(2:)
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
      !> A comma where there is one, unless empty cells at the end are separated by semicolons or tabs, or all commas are
      !> decimal ones; else a semicolon or a tab, if there is one
      character(len=1) :: separator

      separator = ','
      if (has_outside_quotes(row, ',') .and. scan(row(len(row):), ';'//tab) == 0 .and. .not. has_decimal_commas(row)) return
      if (has_outside_quotes(row, tab)) separator = tab
      if (has_outside_quotes(row, ';')) separator = ';'
   end function separator_of

   !> Does every comma of a row stand between two figures, beside semicolons or tabs? Sa(0,5);poe
   pure logical function has_decimal_commas(row) result(has)
      !> Text of the row
      character(len=*), intent(in) :: row

      character(len=*), parameter :: figures = '0123456789'
      integer :: i

      has = scan(row, ';'//tab) > 0
      do i = 1, len(row)
         if (row(i:i) /= ',') cycle
         has = has .and. i > 1 .and. i < len(row)
         if (has) has = index(figures, row(i - 1:i - 1)) > 0 .and. index(figures, row(i + 1:i + 1)) > 0
      end do
   end function has_decimal_commas

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

end module dondolo_files_csv_row
