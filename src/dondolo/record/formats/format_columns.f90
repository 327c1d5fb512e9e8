!> Plain columns of numbers: accelerations alone, one a line, or times and one or more columns of accelerations.
!>
!> At the top may stand comment lines that begin with # and one line of titles. Columns are separated by semicolons,
!> commas, or blanks and tabs. Comments `# key: value` are metadata; `# units: cm/s2` and `# dt: 0.02` are what the file
!> states. A title may hold units in brackets. Of three columns or more, each but the first is a channel with its title
!> for a name, else `column 2` and so on.
!>
!> Decimal commas are read where they cannot be anything else: columns are separated by semicolons or blanks, and no value
!> has a point. Rows of empty cells at the end are dropped.
module dondolo_format_columns
   use dondolo_column_titles, only : find_units, is_other_quantity, is_seconds
   use dondolo_equal_steps, only : check_equal_steps
   use dondolo_error, only : add_place, error_type
   use dondolo_kinds, only : wp
   use dondolo_limits, only : most_columns
   use dondolo_memory, only : check_room
   use dondolo_numbers, only : parse_real, take_real
   use dondolo_plain, only : shown
   use dondolo_record_format, only : raise_at, samples_type
   use dondolo_text, only : blanks, lower, to_text
   use dondolo_text_file, only : text_file_type
   implicit none
   private

   public :: recognises_columns, read_columns

   !> Cells that are found in a line: one that is too many tells that there are
   integer, parameter :: most_cells = most_columns + 1

   !> Relative difference allowed between the step of the times and one that a comment states
   real(wp), parameter :: step_tolerance = 0.01_wp

   !> What may stand around a title
   character(len=*), parameter :: around = blanks//'"'''

contains

   !> Is a text in this format? The first line of values holds as many as the second or the third does, and one of them is a
   !> number
   logical function recognises_columns(text) result(recognised)
      type(text_file_type), intent(in) :: text

      type(text_file_type) :: plain
      integer :: lines
      logical :: has_commas

      call look_for_commas(text, lines, has_commas)
      if (lines == text%lines() .and. .not. has_commas) then
         recognised = recognises_plain(text)
      else
         call make_plain(text, lines, has_commas, plain)
         recognised = recognises_plain(plain)
      end if
   end function recognises_columns

   !> Is a text in this format, without decimal commas?
   function recognises_plain(text) result(recognised)
      type(text_file_type), intent(in) :: text
      !> As of `recognises_columns`
      logical :: recognised

      integer :: begin, line, first(most_cells), last(most_cells), cells, others
      real(wp) :: value
      logical :: a_number, alike

      recognised = .false.
      begin = first_value_line(text)
      if (begin > text%lines()) return
      call find_cells(text, begin, separator_of(text, begin), first, last, cells)
      if (cells >= most_cells) return
      call parse_real(text%text(first(1):last(1)), value, a_number)
      alike = begin == text%lines()
      do line = begin + 1, min(begin + 2, text%lines())
         call find_cells(text, line, separator_of(text, line), first, last, others)
         if (others == cells) alike = .true.
         if (.not. a_number) call parse_real(text%text(first(1):last(1)), value, a_number)
      end do
      recognised = alike .and. a_number
   end function recognises_plain

   !> Read plain columns
   subroutine read_columns(text, samples, error)
      type(text_file_type), intent(in) :: text
      !> What it says
      type(samples_type), intent(out) :: samples
      !> What is wrong, with file and line
      type(error_type), allocatable, intent(out) :: error

      type(text_file_type) :: plain
      character(len=:), allocatable :: processing
      integer :: lines
      logical :: has_commas

      call look_for_commas(text, lines, has_commas)
      if (lines == text%lines() .and. .not. has_commas) then
         call read_plain(text, samples, error)
         return
      end if
      call make_plain(text, lines, has_commas, plain)
      call read_plain(plain, samples, error)
      if (.not. has_commas .or. allocated(error)) return
      processing = samples%metadata%get('processing')
      if (len(processing) > 0) processing = processing//'; '
      call samples%metadata%set('processing', processing//'decimal commas read')
   end subroutine read_columns

   !> Find out whether a text has decimal commas or rows of empty cells at the end
   subroutine look_for_commas(text, lines, has_commas)
      type(text_file_type), intent(in) :: text
      !> Its lines without rows of empty cells at the end
      integer, intent(out) :: lines
      !> Does it have decimal commas?
      logical, intent(out) :: has_commas

      character(len=:), allocatable :: line
      integer :: begin

      do lines = text%lines(), 1, -1
         if (verify(text%text(text%first(lines):text%last(lines)), blanks//';,') > 0) exit
      end do
      has_commas = .false.
      begin = first_value_line(text)
      if (begin > lines) return
      associate (values => text%text(text%first(begin):text%last(lines)))
         ! A point is soon found, so that most files are not searched to their end.
         if (index(values, '.') > 0) return
         has_commas = index(values, ',') > 0
         line = unquoted(text%line(begin))
         ! A comma beside a blank separates
         if (has_commas .and. index(line, ';') == 0) has_commas = scan(line, blanks) > 0 .and. &
            & index(values, ', ') == 0 .and. index(values, ' ,') == 0 .and. &
            & index(values, ','//achar(9)) == 0 .and. index(values, achar(9)//',') == 0
      end associate
   end subroutine look_for_commas

   !> Replace decimal commas by points, and drop rows of empty cells at the end
   subroutine make_plain(text, lines, has_commas, plain)
      type(text_file_type), intent(in) :: text
      !> Its lines without rows of empty cells at the end
      integer, intent(in) :: lines
      !> Does it have decimal commas?
      logical, intent(in) :: has_commas
      !> The same with decimal points
      type(text_file_type), intent(out) :: plain

      integer :: i

      plain%file = text%file
      plain%text = text%text
      plain%first = text%first(:lines)
      plain%last = text%last(:lines)
      if (.not. has_commas) return
      do i = plain%first(first_value_line(plain)), plain%last(lines)
         if (plain%text(i:i) == ',') plain%text(i:i) = '.'
      end do
   end subroutine make_plain

   !> Read plain columns without decimal commas
   subroutine read_plain(text, samples, error)
      type(text_file_type), intent(in) :: text
      !> What it says
      type(samples_type), intent(out) :: samples
      !> What is wrong, with file and line
      type(error_type), allocatable, intent(out) :: error

      character(len=1) :: separator
      integer :: begin, line, rows, cell, cells, i, first(most_cells), last(most_cells)
      ! Line by line, so that those of a single column are the channel's
      real(wp), allocatable :: values(:)
      integer, allocatable :: time_first(:), time_last(:)
      real(wp) :: dt
      logical :: ok

      begin = first_value_line(text)
      if (begin > text%lines()) then
         call raise_at(error, text, text%lines(), 'no line of values')
         return
      end if
      separator = separator_of(text, begin)
      call find_cells(text, begin, separator, first, last, cells)
      if (cells >= most_cells) then
         call raise_at(error, text, begin, 'more than '//to_text(most_columns)//' columns')
         return
      end if
      call check_room(32.0_wp*real(cells, wp)*real(text%lines(), wp), error)
      call add_place(error, text%file)
      if (allocated(error)) return
      rows = text%lines() - begin + 1
      allocate (values(cells*rows))
      ! Where the times stand; in a single column there are none
      allocate (time_first(merge(rows, 0, cells > 1)), time_last(merge(rows, 0, cells > 1)))
      do line = begin, text%lines()
         i = line - begin + 1
         call read_row(text, line, separator, values(cells*(i - 1) + 1:cells*i), first(1), last(1), ok)
         if (ok .and. cells > 1) then
            time_first(i) = first(1)
            time_last(i) = last(1)
         end if
         if (ok) cycle
         call raise_bad_line(text, line, begin, cells, error)
         return
      end do
      dt = 0.0_wp
      if (cells > 1) call check_equal_steps(text, begin, values(1::cells), time_first, time_last, dt, error)
      if (allocated(error)) then
         if (separator == ',' .and. index(text%text(text%first(begin):), '.') == 0) then
            error%message = error%message//' (columns separated by commas need decimal points)'
         end if
         return
      end if
      allocate (samples%channels(max(cells - 1, 1)))
      do i = 1, size(samples%channels)
         cell = min(i + 1, cells)
         if (cells > 1) samples%channels(i)%values = values(cell::cells)
         samples%channels(i)%dt = dt
         if (cells > 2) samples%channels(i)%name = 'column '//to_text(cell)
      end do
      if (cells == 1) call move_alloc(values, samples%channels(1)%values)
      call read_top(text, begin, cells, samples, error)
   end subroutine read_plain

   !> Read the numbers of a line
   pure subroutine read_row(text, line, separator, values, first, last, ok)
      type(text_file_type), intent(in) :: text
      !> Number of the line
      integer, intent(in) :: line
      !> What separates the columns
      character(len=1), intent(in) :: separator
      !> Its numbers, as many as there must be
      real(wp), intent(out) :: values(:)
      !> Position of the first character of the first number
      integer, intent(out) :: first
      !> Position of its last character
      integer, intent(out) :: last
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
         if (k == 1) first = at
         ok = k == 1 .or. at > begin .or. .not. by_blanks
         if (ok) call take_real(text%text, at, finish, values(k), ok)
         if (.not. ok) return
         if (k == 1) last = at - 1
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
   subroutine raise_bad_line(text, line, begin, cells, error)
      type(text_file_type), intent(in) :: text
      !> Number of the line
      integer, intent(in) :: line
      !> First line of values
      integer, intent(in) :: begin
      !> How many values it holds
      integer, intent(in) :: cells
      !> What is wrong
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: value
      integer :: cell, found, first(most_cells), last(most_cells)
      logical :: ok

      ! The line may have another separator than the first one has
      call find_cells(text, line, separator_of(text, line), first, last, found)
      if (found /= cells) then
         call raise_at(error, text, line, to_text(found)//' values: must be '//to_text(cells)//' as in line '// &
            & to_text(begin))
         return
      end if
      do cell = 1, cells
         call parse_real(text%text(first(cell):last(cell)), value, ok)
         if (ok) cycle
         call raise_at(error, text, line, 'value '''//shown(text%text(first(cell):last(cell)))//''': must be a number')
         return
      end do
      call raise_at(error, text, line, 'columns must be separated as in line '//to_text(begin))
   end subroutine raise_bad_line

   !> Read comments and titles
   subroutine read_top(text, begin, cells, samples, error)
      type(text_file_type), intent(in) :: text
      !> First line of values
      integer, intent(in) :: begin
      !> Number of columns
      integer, intent(in) :: cells
      !> What the file says
      type(samples_type), intent(inout) :: samples
      !> Times that are no seconds, or a time step that is another than that of the times
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: content, units
      integer :: line, mark, i, k, titles, first(most_cells), last(most_cells)

      do line = 1, begin - 1
         content = trim(adjustl(text%line(line)))
         if (index(content, '#') == 1) then
            mark = index(content, ':')
            if (mark > 2) call samples%metadata%set(content(2:mark - 1), content(mark + 1:))
            cycle
         end if
         call find_cells(text, line, separator_of(text, line), first, last, titles)
         ! Titles may hold blanks: between tabs; in a single column; and those of a time and one channel, where the last units
         ! of acceleration in the line are the channel's
         if (titles /= cells) call find_cells(text, line, achar(9), first, last, titles)
         if (cells == 1) then
            titles = 1
            first(1) = text%first(line)
            last(1) = text%last(line)
         else if (cells == 2 .and. titles /= 2 .and. line == begin - 1) then
            content = unquoted(text%line(line))
            call find_units(content, units)
            if (len(units) > 0) samples%channels(1)%units = units
            if (is_other_quantity(content, units)) samples%channels(1)%refusal = text%place(line)//': channel '''// &
               & shown(content)//''' is no acceleration'
         end if
         if (titles /= cells) cycle
         content = unquoted(text%text(first(1):last(1)))
         call find_units(content, units)
         if (cells > 1 .and. .not. is_seconds(content, units)) then
            call raise_at(error, text, line, 'title '''//shown(content)//''' of the times: they must be in s')
            return
         end if
         do i = 1, size(samples%channels)
            k = min(i + 1, cells)
            content = unquoted(text%text(first(k):last(k)))
            call find_units(content, units)
            if (len(units) > 0) samples%channels(i)%units = units
            if (is_other_quantity(content, units)) samples%channels(i)%refusal = text%place(line)//': channel '''// &
               & shown(content)//''' is no acceleration'
            if (cells > 2 .and. len(content) > 0) samples%channels(i)%name = content
         end do
      end do
      call take_comments(text, begin, samples, error)
   end subroutine read_top

   !> Take units and time step that comments state
   subroutine take_comments(text, begin, samples, error)
      type(text_file_type), intent(in) :: text
      !> First line of values
      integer, intent(in) :: begin
      !> What the file says
      type(samples_type), intent(inout) :: samples
      !> The time step is no positive number, or not that of the times
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: stated
      real(wp) :: dt
      integer :: i
      logical :: ok

      stated = samples%metadata%get('dt')
      if (len(stated) > 0) then
         i = len(stated) - merge(1, 0, lower(stated(len(stated):)) == 's')
         call parse_real(stated(:i), dt, ok)
         if (ok) ok = dt > 0.0_wp
         if (.not. ok) then
            call raise_at(error, text, begin, 'the comment dt = '''//shown(stated)//''': must be a positive number')
            return
         end if
         associate (step => samples%channels(1)%dt)
            if (step > 0.0_wp .and. abs(dt - step) > step_tolerance*step) then
               call raise_at(error, text, begin, 'the step of the times is '//to_text(step)// &
                  & ': a comment states dt = '//to_text(dt))
               return
            end if
            if (.not. step > 0.0_wp) step = dt
         end associate
      end if
      stated = samples%metadata%get('units')
      do i = 1, size(samples%channels)
         if (.not. allocated(samples%channels(i)%units)) samples%channels(i)%units = stated
      end do
   end subroutine take_comments

   !> A title without blanks and quotes around it
   pure function unquoted(title)
      !> Title
      character(len=*), intent(in) :: title
      !> The same without blanks and quotes around
      character(len=verify(title, around, back=.true.) - max(verify(title, around), 1) + 1) :: unquoted

      unquoted = title(max(verify(title, around), 1):)
   end function unquoted

   !> First line that holds values: after comments and one line of titles
   function first_value_line(text) result(line)
      type(text_file_type), intent(in) :: text
      !> Number of the line, beyond the last if there is none
      integer :: line

      logical :: titled

      titled = .false.
      do line = 1, text%lines()
         associate (content => text%text(text%first(line):text%last(line)))
            if (verify(content, blanks) == 0) cycle
            if (index(adjustl(content), '#') == 1) cycle
            if (titled .or. .not. is_title(content)) exit
            titled = .true.
         end associate
      end do
   end function first_value_line

   !> Is a line one of titles, and not a value that cannot be read?
   pure function is_title(line)
      !> The line
      character(len=*), intent(in) :: line
      !> It begins with a letter, a quote or a bracket, and not with NaN or Infinity
      logical :: is_title

      character(len=:), allocatable :: word

      word = lower(line(verify(line, blanks):))
      is_title = scan(word(1:1), 'abcdefghijklmnopqrstuvwxyz"''([%!') == 1 .and. &
         & index(word, 'nan') /= 1 .and. index(word, 'inf') /= 1
   end function is_title

   !> What separates the columns of a line
   pure function separator_of(text, line) result(separator)
      type(text_file_type), intent(in) :: text
      !> Number of the line
      integer, intent(in) :: line
      !> A semicolon, a comma, or a blank for blanks and tabs
      character(len=1) :: separator

      separator = ' '
      if (index(text%text(text%first(line):text%last(line)), ',') > 0) separator = ','
      if (index(text%text(text%first(line):text%last(line)), ';') > 0) separator = ';'
   end function separator_of

   !> Find the columns of a line
   pure subroutine find_cells(text, line, separator, first, last, cells)
      type(text_file_type), intent(in) :: text
      !> Number of the line
      integer, intent(in) :: line
      !> What separates them
      character(len=1), intent(in) :: separator
      !> Position of the first character of each cell; an empty line has one that is empty
      integer, intent(out) :: first(most_cells)
      !> Position of the last character of each cell
      integer, intent(out) :: last(most_cells)
      !> Number of cells, `most_cells` if there are more
      integer, intent(out) :: cells

      integer :: at, begin, finish
      logical :: by_blanks

      by_blanks = separator == ' '
      first(1) = 1
      last(1) = 0
      cells = 0
      at = text%first(line)
      do while (cells < most_cells .and. at <= text%last(line))
         if (by_blanks) then
            call text%next_word(at, text%last(line), begin, finish)
            if (begin > text%last(line)) return
         else
            begin = at
            do finish = begin, text%last(line)
               if (text%text(finish:finish) == separator) exit
            end do
            finish = finish - 1
         end if
         cells = cells + 1
         first(cells) = begin
         last(cells) = finish
         at = finish + 2
      end do
   end subroutine find_cells

end module dondolo_format_columns
