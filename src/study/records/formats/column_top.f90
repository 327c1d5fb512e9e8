!> Lines above plain columns: titles, a row of units, and statements.
!>
!> Titles are in the last line, or in the last but one above a row of units. A comment is one of titles only if a word or a unit in
!> each is known.
module dondolo_records_column_top
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : line_type
   use dondolo_base_numbers, only : parse_printed
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : blanks, lower, stripped
   use dondolo_files_text_file, only : text_file_type
   use dondolo_record_metadata, only : metadata_type
   use dondolo_records_column_cells, only : find_titles, mark_length, most_cells, unquoted
   use dondolo_records_column_layout, only : layout_type
   use dondolo_records_column_letters, only : folded
   use dondolo_records_column_statements, only : statements_type
   use dondolo_records_column_titles, only : find_units, is_acceleration, is_acceleration_unit, is_other_quantity, &
      & is_other_unit, is_seconds, is_time, says_nothing
   use dondolo_records_column_words, only : within_brackets
   use dondolo_records_direction, only : names_vertical
   use dondolo_records_format, only : given_type, raise_at
   implicit none
   private

   public :: top_type, read_top

   !> What may stand for a value that is missing
   character(len=*), parameter :: missing(*) = [character(len=4) :: '-', '--', '?', '.', '..', '...', '*', 'na', 'n/a', 'null', &
      & 'none', 'nil', 'miss', 'void']

   !> What is above the values
   type :: top_type
      !> Statements
      type(statements_type) :: statements
      !> Line of the titles or of the units, 0 if there are none
      integer :: title_line = 0
      !> Title of each column, empty if it has none
      type(line_type), allocatable :: titles(:)
      !> Units of each column, empty if they are not stated
      type(line_type), allocatable :: units(:)
   end type top_type

contains

   !> Read what is above the values
   subroutine read_top(text, begin, columns, given, layout, top, metadata, error)
      type(text_file_type), intent(in) :: text
      !> First line of values
      integer, intent(in) :: begin
      !> Number of columns
      integer, intent(in) :: columns
      type(given_type), intent(in) :: given
      !> What is said of the columns
      type(layout_type), intent(in) :: layout
      type(top_type), intent(out) :: top
      !> Keys and values are added
      type(metadata_type), intent(inout) :: metadata
      !> What is not clear, or contradicts other lines
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: content
      integer :: line, last, before, mark, unit_line, i
      logical :: is_own

      allocate (top%titles(columns), top%units(columns))
      do i = 1, columns
         top%titles(i)%text = ''
         top%units(i)%text = ''
      end do
      last = line_before(text, begin)
      before = line_before(text, last)
      unit_line = 0
      if (last > 0) then
         if (is_row_of_units(text, last, columns)) unit_line = last
         call take_titles(text, merge(before, last, unit_line > 0), columns, top)
         if (unit_line > 0) call take_unit_row(text, unit_line, columns, top)
         if (layout%passes) then
            ! Titles are names, by which a channel is chosen
            do i = 1, columns
               top%units(i)%text = ''
            end do
         end if
      end if
      ! A file that dondolo wrote states units and step in its last two comments; all others are metadata of its record
      is_own = index(text%line(before), '# units: m/s2') == 1 .and. index(text%line(last), '# dt: ') == 1
      do line = 1, last
         content = text%line(line)
         mark = mark_length(content)
         content = stripped(content(mark + 1:))
         if (len(content) == 0 .or. line == top%title_line .or. line == unit_line) cycle
         mark = scan(content, '=:')
         if (mark > 1) then
            if (lower(content(:mark - 1)) /= 'reading') call metadata%set(content(:mark - 1), content(mark + 1:))
         end if
         if (line == last .and. columns == 1 .and. any(missing == folded(unquoted(content)))) then
            call raise_at(error, text, line, ''''//shown(text%line(line))//''' in place of a first value, which is missing')
            return
         end if
         if (mark == 0 .and. len(metadata%get('component')) == 0) then
            if (names_vertical(content)) call metadata%set('component', content)
         end if
         if (layout%passes .or. (is_own .and. line < before) .or. verify(content, '-=+|_* ') == 0) cycle
         content = unquoted(content)
         if (line == last .and. columns == 1 .and. mark_length(text%line(line)) == 0 .and. scan(content, '=:') == 0) then
            top%title_line = line
            top%titles(1)%text = content
            call find_units(content, top%units(1)%text)
         end if
         call top%statements%take(text, line, content, given, columns, error)
         if (allocated(error)) return
      end do
   end subroutine read_top

   !> The last line before another that is not empty, 0 if there is none
   pure integer function line_before(text, line) result(before)
      type(text_file_type), intent(in) :: text
      integer, intent(in) :: line

      do before = line - 1, 1, -1
         if (verify(text%text(text%first(before):text%last(before)), blanks) > 0) return
      end do
      before = 0
   end function line_before

   !> Take the titles in a line above several columns, if it has any
   subroutine take_titles(text, line, columns, top)
      type(text_file_type), intent(in) :: text
      !> Number of the line, 0 for none
      integer, intent(in) :: line
      !> Number of columns
      integer, intent(in) :: columns
      type(top_type), intent(inout) :: top

      integer :: first(most_cells), last(most_cells), i
      character(len=:), allocatable :: content
      real(wp) :: number
      logical :: found, is_known, all_known, is_comment, is_sentence

      if (line == 0 .or. columns < 2) return
      content = text%line(line)
      call find_titles(text, line, columns, first, last, found)
      if (.not. found) return
      is_comment = mark_length(content) > 0
      all_known = .true.
      do i = 1, columns
         top%titles(i)%text = unquoted(text%text(first(i):last(i)))
         ! A number is no title, but one of a row in which another is missing
         call parse_printed(top%titles(i)%text, number, found)
         if (found) exit
         call find_units(top%titles(i)%text, top%units(i)%text)
         associate (title => top%titles(i)%text, units => top%units(i)%text)
            is_known = is_time(title, units) .or. is_acceleration(title, units) .or. is_other_quantity(title, units)
            ! Unnamed: 0
            all_known = all_known .and. (is_known .or. (.not. is_comment .and. says_nothing(title)))
         end associate
      end do
      ! Acceleration in m/s2
      is_sentence = found .or. any([(any(['in', 'of', 'di', 'de'] == lower(top%titles(i)%text)), i=1, columns)])
      if (all_known .and. .not. found .or. .not. (is_comment .or. is_sentence .or. scan(content, '=:') > 0)) then
         top%title_line = line
         return
      end if
      do i = 1, columns
         top%titles(i)%text = ''
         top%units(i)%text = ''
      end do
   end subroutine take_titles

   !> Is a line a row of units, one for each column?
   logical function is_row_of_units(text, line, columns) result(is_row)
      type(text_file_type), intent(in) :: text
      integer, intent(in) :: line
      !> Number of columns
      integer, intent(in) :: columns

      integer :: first(most_cells), last(most_cells), i, known
      character(len=:), allocatable :: cell
      logical :: is_acceleration_beside

      call find_titles(text, line, columns, first, last, is_row)
      if (.not. is_row) return
      known = 0
      is_acceleration_beside = .false.
      do i = 1, columns
         cell = within_brackets(text%text(first(i):last(i)))
         if (len(cell) == 0 .or. cell == '-') cycle
         is_row = is_acceleration_unit(cell) .or. is_other_unit(cell) .or. is_seconds('', cell)
         if (.not. is_row) return
         known = known + 1
         is_acceleration_beside = is_acceleration_unit(cell)
      end do
      ! Letters alone may be titles: s, g, m
      is_row = known > 0
      if (known < columns .or. columns == 1) return
      is_row = is_acceleration_beside .or. is_seconds('', within_brackets(text%text(first(1):last(1))))
   end function is_row_of_units

   !> Take a row of units
   subroutine take_unit_row(text, line, columns, top)
      type(text_file_type), intent(in) :: text
      integer, intent(in) :: line
      !> Number of columns
      integer, intent(in) :: columns
      type(top_type), intent(inout) :: top

      integer :: first(most_cells), last(most_cells), i
      character(len=:), allocatable :: unit
      logical :: found

      call find_titles(text, line, columns, first, last, found)
      if (top%title_line == 0) top%title_line = line
      do i = 1, columns
         unit = within_brackets(text%text(first(i):last(i)))
         if (len(unit) > 0 .and. unit /= '-') top%units(i)%text = unit
      end do
   end subroutine take_unit_row

end module dondolo_records_column_top
