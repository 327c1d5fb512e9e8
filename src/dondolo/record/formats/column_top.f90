!> Lines above columns of numbers: titles, a row of units, metadata, and statements in words.
!>
!> Titles are in the last line, or in the last but one above a row of units. Comments are titles only if a word or a unit in them
!> is known; words separated by blanks too, since a sentence may have as many words as there are columns.
module dondolo_record_column_top
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : line_type
   use dondolo_base_numbers, only : parse_real
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : blanks, lower, stripped
   use dondolo_base_text_file, only : text_file_type
   use dondolo_record_column_cells, only : find_titles, mark_length, most_cells, unquoted
   use dondolo_record_column_statements, only : statements_type
   use dondolo_record_column_titles, only : find_units, has_word, is_acceleration_unit, is_index, is_other_quantity, &
      & is_other_unit, is_seconds, is_time, is_title_of_other, says_nothing
   use dondolo_record_format, only : raise_at
   use dondolo_record_metadata, only : metadata_type
   implicit none
   private

   public :: top_type, read_top

   !> Words of titles of components
   character(len=*), parameter :: components(*) = [character(len=13) :: 'acceleration', 'accel', 'acc', 'ns', 'ew', 'ud', &
      & 'vertical', 'accelerazione', 'horizontal', 'hne', 'hnn', 'hnz', 'transverse', 'longitudinal']

   !> Words of a title that make it a sentence
   integer, parameter :: many_words = 3

   !> What is above the values
   type :: top_type
      !> Statements in words
      type(statements_type) :: statements
      !> Line of the titles, 0 if there are none
      integer :: title_line = 0
      !> Title of each column, empty if it has none
      type(line_type), allocatable :: titles(:)
      !> Units of each column, empty if they are not stated
      type(line_type), allocatable :: units(:)
      !> The first column has no title, but all others do
      logical :: is_shifted = .false.
      !> A line of words above one column, or above two without titles, that names another quantity; not allocated: there is none
      character(len=:), allocatable :: refusal
   end type top_type

contains

   !> Read what is above the values
   subroutine read_top(text, begin, columns, top, metadata, error)
      type(text_file_type), intent(in) :: text
      !> First line of values
      integer, intent(in) :: begin
      !> Number of columns
      integer, intent(in) :: columns
      type(top_type), intent(inout) :: top
      !> Keys and values are added
      type(metadata_type), intent(inout) :: metadata
      !> Statements that cannot be read or contradict each other
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: content
      integer :: line, last, before, mark, unit_line
      logical :: is_own

      allocate (top%titles(columns), top%units(columns))
      do mark = 1, columns
         top%titles(mark)%text = ''
         top%units(mark)%text = ''
      end do
      last = line_before(text, begin)
      before = line_before(text, last)
      unit_line = 0
      if (last > 0) then
         if (is_row_of_units(text, last, columns)) unit_line = last
      end if
      if (unit_line > 0) then
         call take_titles(text, before, columns, top)
         call take_unit_row(text, unit_line, columns, top)
      else
         call take_titles(text, last, columns, top)
      end if
      ! A file that dondolo wrote states units and step in its last two comments; all others are metadata of its record
      is_own = index(text%line(before), '# units: m/s2') == 1 .and. index(text%line(last), '# dt: ') == 1
      do line = 1, last
         content = text%line(line)
         mark = mark_length(content)
         content = stripped(content(mark + 1:))
         if (len(content) == 0 .or. line == top%title_line .or. line == unit_line) cycle
         mark = index(content, ':')
         if (mark > 1) then
            if (lower(content(:mark - 1)) /= 'reading') call metadata%set(content(:mark - 1), content(mark + 1:))
         end if
         if (is_own .and. line < before) cycle
         call take_words(text, line, line == last, columns, content, top, error)
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

   !> Take what a line that is no row of titles states
   subroutine take_words(text, line, is_last, columns, content, top, error)
      type(text_file_type), intent(in) :: text
      integer, intent(in) :: line
      !> Is it the last line above the values?
      logical, intent(in) :: is_last
      !> Number of columns
      integer, intent(in) :: columns
      !> The line without marks
      character(len=*), intent(in) :: content
      type(top_type), intent(inout) :: top
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: title, units
      integer :: known

      known = top%statements%dt_line + top%statements%count_line
      call top%statements%take(text, line, unquoted(content), error)
      if (allocated(error) .or. .not. is_last .or. known < top%statements%dt_line + top%statements%count_line) return
      if (mark_length(text%line(line)) > 0 .or. scan(content, '=:') > 0) return
      title = unquoted(content)
      call find_units(title, units)
      if (columns > 2) then
         if (is_title_of_other(title)) call raise_at(error, text, line, 'titles '''//shown(title)// &
            & ''': must be as many as the columns')
         return
      end if
      if (is_other_quantity(title, units)) top%refusal = text%place(line)//': channel '''//shown(title)// &
         & ''' is not an acceleration'
      ! Of a time and a channel the last units are the channel's, known or not
      if (len(units) > 0 .and. top%statements%units_line == 0) then
         top%statements%units = units
         top%statements%units_line = line
      end if
   end subroutine take_words

   !> Take the titles in a line, if it has any
   subroutine take_titles(text, line, columns, top)
      type(text_file_type), intent(in) :: text
      !> Number of the line, 0 for none
      integer, intent(in) :: line
      !> Number of columns
      integer, intent(in) :: columns
      type(top_type), intent(inout) :: top

      integer :: first(most_cells), last(most_cells), titles, i, shift
      character(len=:), allocatable :: title, units, content
      logical :: is_comment, is_known, all_known, has_number, has_marks, is_sentence, has_first

      if (line == 0 .or. columns < 2) return
      content = text%line(line)
      is_comment = mark_length(content) > 0
      call find_titles(text, line, columns, first, last, titles)
      if (titles == 0) return
      is_known = .false.
      all_known = .true.
      has_number = .false.
      is_sentence = .false.
      has_first = .false.
      do i = 1, titles
         title = unquoted(text%text(first(i):last(i)))
         call find_units(title, units)
         is_known = is_known .or. is_known_title(title, units)
         all_known = all_known .and. is_known_title(title, units)
         is_sentence = is_sentence .or. words_in(title(:scan(title//'(', '([') - 1)) >= many_words
         ! A time, an index, or nothing, comes first
         if (i == 1 .and. (len(title) == 0 .or. is_time(title, units) .or. is_index(title))) has_first = .true.
         has_number = has_number .or. is_number(title)
      end do
      has_marks = scan(content, ',;'//achar(9)) > 0
      if (.not. has_first .and. (is_sentence .or. (is_comment .and. .not. all_known))) return
      if (scan(content, '=:') > 0 .and. .not. (is_known .and. has_marks)) return
      if ((is_comment .or. .not. has_marks) .and. .not. (is_known .and. .not. has_number)) then
         ! Names that a program gives, or quotes, are no sentence
         if (is_comment .or. .not. (index(adjustl(content), '"') == 1 .or. all_say_nothing())) return
      end if
      shift = columns - titles
      top%is_shifted = shift > 0
      top%title_line = line
      do i = 1, titles
         title = unquoted(text%text(first(i):last(i)))
         call find_units(title, units)
         top%titles(i + shift)%text = title
         top%units(i + shift)%text = units
      end do

   contains

      !> Does no title say anything?
      logical function all_say_nothing()
         integer :: k

         all_say_nothing = .true.
         do k = 1, titles
            all_say_nothing = all_say_nothing .and. says_nothing(unquoted(text%text(first(k):last(k))))
         end do
      end function all_say_nothing

   end subroutine take_titles

   !> Number of words
   pure integer function words_in(text) result(words)
      character(len=*), intent(in) :: text

      character(len=:), allocatable :: rest

      words = 0
      rest = text
      do while (verify(rest, blanks) > 0)
         rest = rest(verify(rest, blanks):)
         words = words + 1
         if (scan(rest, blanks) == 0) exit
         rest = rest(scan(rest, blanks):)
      end do
   end function words_in

   !> Is a title one of a time, a number of samples, an acceleration or another quantity?
   logical function is_known_title(title, units) result(is_known)
      character(len=*), intent(in) :: title
      !> Units in it
      character(len=*), intent(in) :: units

      is_known = is_time(title, units) .or. is_index(title) .or. has_word(title, components) .or. is_title_of_other(title)
      if (len(units) > 0) is_known = is_known .or. is_acceleration_unit(units) .or. is_other_unit(units)
   end function is_known_title

   !> Is a text a number?
   logical function is_number(title)
      character(len=*), intent(in) :: title

      real(wp) :: value

      call parse_real(title, value, is_number)
   end function is_number

   !> Is a line a row of units, one for each column?
   logical function is_row_of_units(text, line, columns) result(is_row)
      type(text_file_type), intent(in) :: text
      integer, intent(in) :: line
      !> Number of columns
      integer, intent(in) :: columns

      integer :: first(most_cells), last(most_cells), cells, i, known
      character(len=:), allocatable :: cell

      is_row = .false.
      call find_titles(text, line, columns, first, last, cells)
      if (cells == 0) return
      known = 0
      do i = 1, cells
         cell = inner(unquoted(text%text(first(i):last(i))))
         if (len(cell) == 0 .or. cell == '-') cycle
         if (.not. (is_acceleration_unit(cell) .or. is_other_unit(cell) .or. is_seconds('', cell))) return
         known = known + 1
      end do
      is_row = known > 0
      ! Letters alone may be titles: s, g, m
      if (is_row .and. columns > 1 .and. cells == known) is_row = is_seconds('', first_cell()) .or. is_acceleration_unit(cell)

   contains

      !> The first cell
      function first_cell() result(word)
         character(len=len(text%text(first(1):last(1)))) :: word

         word = inner(unquoted(text%text(first(1):last(1))))
      end function first_cell

   end function is_row_of_units

   !> Take a row of units
   subroutine take_unit_row(text, line, columns, top)
      type(text_file_type), intent(in) :: text
      integer, intent(in) :: line
      !> Number of columns
      integer, intent(in) :: columns
      type(top_type), intent(inout) :: top

      integer :: first(most_cells), last(most_cells), cells, i, shift
      character(len=:), allocatable :: unit

      call find_titles(text, line, columns, first, last, cells)
      shift = columns - cells
      if (top%title_line == 0) top%title_line = line
      do i = 1, cells
         unit = inner(unquoted(text%text(first(i):last(i))))
         if (len(unit) > 0 .and. unit /= '-') top%units(i + shift)%text = unit
      end do
   end subroutine take_unit_row

   !> Length of a unit without brackets
   pure integer function inner_length(text) result(length)
      character(len=*), intent(in) :: text

      length = max(0, verify(text, ' ()[]', back=.true.) - max(verify(text, ' ()[]'), 1) + 1)
   end function inner_length

   !> A unit without brackets around it
   pure function inner(text)
      character(len=*), intent(in) :: text
      character(len=inner_length(text)) :: inner

      inner = text(max(verify(text, ' ()[]'), 1):)
   end function inner

end module dondolo_record_column_top
