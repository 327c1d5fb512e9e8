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
   use dondolo_column_cells, only : find_cells, first_value_line, most_cells, separator_of, unquoted
   use dondolo_column_top, only : read_top
   use dondolo_equal_steps, only : check_equal_steps
   use dondolo_error, only : add_place, error_type
   use dondolo_kinds, only : wp
   use dondolo_limits, only : most_columns
   use dondolo_memory, only : check_room
   use dondolo_numbers, only : parse_real, take_real
   use dondolo_plain, only : shown
   use dondolo_record_format, only : raise_at, samples_type
   use dondolo_text, only : blanks, to_text
   use dondolo_text_file, only : text_file_type
   implicit none
   private

   public :: recognises_columns, read_columns

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
      real(wp) :: dt, doubt
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
      doubt = 0.0_wp
      if (cells > 1) call check_equal_steps(text, begin, values(1::cells), time_first, time_last, dt, doubt, error)
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
         samples%channels(i)%dt_doubt = doubt
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

end module dondolo_format_columns
