!> Numbers of plain columns, and of values along the rows.
module dondolo_records_column_rows
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_printed, take_real
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : to_text
   use dondolo_files_text_file, only : text_file_type
   use dondolo_records_column_cells, only : find_cells, most_cells, separator_of
   use dondolo_records_column_layout, only : layout_type, raise_unclear
   use dondolo_records_column_lead, only : check_first, take_lead
   use dondolo_records_column_roles, only : table_type
   use dondolo_records_column_top, only : top_type
   use dondolo_records_column_values, only : are_times, check_thousands, may_have_thousands
   use dondolo_records_format, only : given_type, raise_at
   implicit none
   private

   public :: read_rows, read_table

   !> What stands between values along the rows
   character(len=*), parameter :: separators = ' ,;'//achar(9)

contains

   !> Read columns
   subroutine read_table(text, given, layout, table, top, note, error)
      type(text_file_type), intent(in) :: text
      type(given_type), intent(in) :: given
      type(layout_type), intent(in) :: layout
      type(table_type), intent(inout) :: table
      type(top_type), intent(inout) :: top
      !> What to report, empty if there is nothing
      character(len=:), allocatable, intent(out) :: note
      !> A line that holds other values than the others, or something else
      type(error_type), allocatable, intent(out) :: error

      integer :: line, i
      logical :: ok

      note = ''
      associate (begin => table%begin, cells => table%cells)
         if (cells == 1 .and. begin < text%lines()) then
            call take_lead(text, begin, text%lines() - begin, given, top%statements, i, note, error)
            if (i == 0 .and. .not. allocated(error)) call check_first(text, begin, given, error)
            if (allocated(error)) return
            begin = begin + i
         end if
         allocate (table%values(cells*(text%lines() - begin + 1)))
         do line = begin, text%lines()
            i = cells*(line - begin)
            call read_row(text, line, table%separator, table%values(i + 1:i + cells), ok)
            if (ok) cycle
            call raise_bad_line(text, line, table, given, layout, error)
            return
         end do
         do i = 1, cells
            if (.not. allocated(error) .and. may_have_thousands(table%values(i::cells))) call check_thousands(text, begin, &
               & table%separator, i, error)
         end do
      end associate
   end subroutine read_table

   !> Read values along the rows: as many in each row but the last
   subroutine read_rows(text, given, table, top, note, error)
      type(text_file_type), intent(in) :: text
      type(given_type), intent(in) :: given
      type(table_type), intent(inout) :: table
      type(top_type), intent(inout) :: top
      !> What to report, empty if there is nothing
      character(len=:), allocatable, intent(out) :: note
      !> A row that holds something else, or other numbers of values
      type(error_type), allocatable, intent(out) :: error

      real(wp), allocatable :: values(:)
      integer, allocatable :: found(:)
      integer :: line, at, begin, finish, count, row, lead
      logical :: ok

      note = ''
      allocate (values(len(text%text)/2 + 1), found(text%lines()))
      found = 0
      count = 0
      do line = table%begin, text%lines()
         at = text%first(line)
         do
            begin = at - 1 + verify(text%text(at:text%last(line)), separators)
            if (begin < at) exit
            finish = begin - 2 + scan(text%text(begin:text%last(line))//' ', separators)
            count = count + 1
            found(line) = found(line) + 1
            call parse_printed(text%text(begin:finish), values(count), ok)
            if (.not. ok) then
               call raise_at(error, text, line, 'value '''//shown(text%text(begin:finish))//''': must be a number')
               return
            end if
            at = finish + 1
         end do
      end do
      row = table%begin
      if (text%lines() - row > 1) then
         ! A line of another length above the rows is a count
         call take_lead(text, row, count - found(row), given, top%statements, lead, note, error)
         if (lead == 0 .and. found(row) /= found(row + 1) .and. .not. allocated(error)) call raise_unclear(error, text, row, &
            & ''''//shown(text%line(row))//''' is not the number of values below it, '//to_text(count - found(row))// &
            & ', and their step', given, 3)
         if (allocated(error)) return
         begin = sum(found(row:row + lead - 1))
         count = count - begin
         values = values(begin + 1:)
         table%begin = row + lead
      end if
      row = table%begin
      do line = row, text%lines()
         if (found(line) == found(row) .or. (line == text%lines() .and. found(line) < found(row))) cycle
         call raise_at(error, text, line, to_text(found(line))//' values in the row: must be '//to_text(found(row))// &
            & ' as in line '//to_text(row))
         return
      end do
      table%values = values(:count)
      if (may_have_thousands(table%values)) call check_thousands(text, row, table%separator, 0, error)
      do at = 1, found(row)
         if (found(row) > 1 .and. are_times(values(at:count:found(row)))) call raise_at(error, text, row, 'values along the '// &
            & 'rows, but those of column '//to_text(at)//' increase by equal steps, as times do')
         if (allocated(error)) return
      end do
   end subroutine read_rows

   !> Read the numbers of a line
   pure subroutine read_row(text, line, separator, values, ok)
      type(text_file_type), intent(in) :: text
      !> Number of the line
      integer, intent(in) :: line
      !> What separates the columns
      character(len=1), intent(in) :: separator
      !> Its numbers, as many as there must be
      real(wp), intent(out) :: values(:)
      !> The line holds these numbers and nothing else; a separator may end it
      logical, intent(out) :: ok

      integer :: at, finish, begin, k
      logical :: by_blanks

      by_blanks = separator == ' '
      at = text%first(line)
      finish = text%last(line)
      do k = 1, size(values)
         begin = at
         call pass_blanks(text%text, at, finish)
         ok = k == 1 .or. at > begin .or. .not. by_blanks
         if (.not. ok) return
         begin = at
         call take_real(text%text, at, finish, values(k), ok)
         if (ok .and. at <= finish) ok = scan(text%text(at:at), ' ,;'//achar(9)) > 0
         if (.not. ok) then
            at = begin - 1 + scan(text%text(begin:finish)//' ', ' ,;'//achar(9))
            call parse_printed(text%text(begin:at - 1), values(k), ok)
         end if
         if (.not. ok) return
         if (by_blanks) cycle
         call pass_blanks(text%text, at, finish)
         ok = k == size(values)
         if (at <= finish) then
            ok = text%text(at:at) == separator
            at = at + 1
         end if
         if (.not. ok) return
      end do
      call pass_blanks(text%text, at, finish)
      ok = at > finish
   end subroutine read_row

   !> As `skip_blanks` of a text file, but private, so that the compiler puts it into the loop over the lines
   pure subroutine pass_blanks(text, at, last)
      !> Text
      character(len=*), intent(in) :: text
      !> Position
      integer, intent(inout) :: at
      !> Last position of the line
      integer, intent(in) :: last

      do at = at, last
         if (iachar(text(at:at)) /= iachar(' ') .and. iachar(text(at:at)) /= 9) exit
      end do
   end subroutine pass_blanks

   !> Say what is wrong in a line
   subroutine raise_bad_line(text, line, table, given, layout, error)
      type(text_file_type), intent(in) :: text
      !> Number of the line
      integer, intent(in) :: line
      type(table_type), intent(in) :: table
      type(given_type), intent(in) :: given
      type(layout_type), intent(in) :: layout
      !> What is wrong
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: problem
      real(wp) :: value
      integer :: cell, found, first(most_cells), last(most_cells)
      logical :: ok

      ! The line may have another separator than the first one has
      call find_cells(text, line, separator_of(text, line), first, last, found)
      if (found /= table%cells) then
         problem = to_text(found)//' values: must be '//to_text(table%cells)//' as in line '//to_text(table%begin)
         if (line == table%begin) problem = ''''//shown(text%line(line))//''' above lines of one value, but not '// &
            & 'their number and step'
         if (table%cells == 1 .and. line > table%begin .and. line - table%begin < 3) problem = problem//'; a number of '// &
            & 'samples and a step may stand only above a single column'
         if (layout%is_given) then
            call raise_at(error, text, line, problem)
         else
            call raise_unclear(error, text, line, problem, given, found)
         end if
         return
      end if
      do cell = 1, table%cells
         call parse_printed(text%text(first(cell):last(cell)), value, ok)
         if (ok) cycle
         call raise_at(error, text, line, 'value '''//shown(text%text(first(cell):last(cell)))//''': must be a number')
         return
      end do
      call raise_at(error, text, line, 'columns must be separated as in line '//to_text(table%begin))
   end subroutine raise_bad_line

end module dondolo_records_column_rows
