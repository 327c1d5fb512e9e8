!> Plain columns of numbers: accelerations alone, one a line, or times and one or more columns of accelerations.
!>
!> Above them may be comments, titles, a row of units, and lines of words (dondolo_record_column_top). Columns are separated by
!> semicolons, commas, or blanks and tabs. Comments `# key: value` are metadata. Units, time step, sampling rate, number of samples
!> and quantity that these lines state are used, or contradict the values or what is given, and are an error.
!> Times, numbers of samples and channels are told apart in dondolo_record_column_roles. Of two channels or more, each has
!> its title for a name, else `column 2` and so on.
module dondolo_record_format_columns
   use dondolo_base_error, only : add_place, error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_limits, only : most_columns
   use dondolo_base_memory, only : check_room
   use dondolo_base_numbers, only : parse_printed, parse_real, take_real
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : to_text
   use dondolo_base_text_file, only : text_file_type
   use dondolo_record_column_cells, only : find_cells, first_value_line, most_cells, separator_of
   use dondolo_record_column_counts, only : are_names, check_count, drop_row, has_count_line, take_count_line
   use dondolo_record_column_roles, only : find_roles, roles_type, table_type
   use dondolo_record_column_text, only : look_at_columns, make_plain, irregularities_type
   use dondolo_record_column_titles, only : is_other_quantity
   use dondolo_record_column_top, only : read_top, top_type
   use dondolo_record_format, only : raise_at, samples_type
   use dondolo_record_last_number, only : find_cut
   use dondolo_record_units, only : unit_factor
   implicit none
   private

   public :: recognises_columns, read_columns

   !> Relative difference allowed between the step of the times and one that a line states
   real(wp), parameter :: step_tolerance = 0.01_wp

contains

   !> Is a text in this format? The first line of values holds as many as the second or the third does, or is their number, and
   !> one of them is a number
   logical function recognises_columns(text) result(recognised)
      type(text_file_type), intent(in) :: text

      type(text_file_type) :: plain
      type(irregularities_type) :: odd

      call look_at_columns(text, odd)
      if (odd%any()) then
         call make_plain(text, odd, plain)
         recognised = recognises_plain(plain)
      else
         recognised = recognises_plain(text)
      end if
   end function recognises_columns

   !> Is a plain text in this format?
   function recognises_plain(text) result(recognised)
      type(text_file_type), intent(in) :: text
      !> As of `recognises_columns`
      logical :: recognised

      integer :: begin, line, first(most_cells), last(most_cells), cells, others, count
      real(wp) :: value, dt
      logical :: a_number, alike

      recognised = .false.
      begin = first_value_line(text)
      if (begin > text%lines()) return
      if (has_count_line(text, begin, count, dt)) begin = begin + 1
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
   subroutine read_columns(text, samples, error, dt)
      type(text_file_type), intent(in) :: text
      !> What it says
      type(samples_type), intent(out) :: samples
      !> What is wrong, with file and line
      type(error_type), allocatable, intent(out) :: error
      !> Time step that the caller gives [s]: a column that is not a time for sure is none
      real(wp), intent(in), optional :: dt

      type(text_file_type) :: plain
      type(irregularities_type) :: odd

      call look_at_columns(text, odd)
      if (.not. odd%any()) then
         call read_plain(text, present(dt), samples, error)
         return
      end if
      call make_plain(text, odd, plain)
      call read_plain(plain, present(dt), samples, error)
      if (odd%has_commas .and. .not. allocated(error)) call samples%metadata%append('processing', 'decimal commas read')
   end subroutine read_columns

   !> Read plain columns without quotes and decimal commas
   subroutine read_plain(text, is_given, samples, error)
      type(text_file_type), intent(in) :: text
      !> Does the caller give a time step?
      logical, intent(in) :: is_given
      !> What it says
      type(samples_type), intent(out) :: samples
      !> What is wrong, with file and line
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: note
      type(table_type) :: table
      type(top_type) :: top
      type(roles_type) :: roles
      integer :: after_top, line, rows, i, first(most_cells), last(most_cells), count
      real(wp) :: dt
      logical :: ok

      after_top = first_value_line(text)
      table%begin = after_top
      if (after_top > text%lines()) then
         call raise_at(error, text, text%lines(), 'no line of values')
         return
      end if
      if (has_count_line(text, after_top, count, dt)) then
         call top%statements%take_count(text, after_top, count, error)
         if (dt > 0.0_wp) call top%statements%take_step(text, after_top, dt, error)
         table%begin = after_top + 1
      end if
      table%separator = separator_of(text, table%begin)
      call find_cells(text, table%begin, table%separator, first, last, table%cells)
      if (table%cells >= most_cells) then
         call raise_at(error, text, table%begin, 'more than '//to_text(most_columns)//' columns')
         return
      end if
      call check_room(32.0_wp*real(table%cells, wp)*real(text%lines(), wp), error)
      call add_place(error, text%file)
      if (allocated(error)) return
      rows = text%lines() - table%begin + 1
      allocate (table%values(table%cells*rows))
      do line = table%begin, text%lines()
         i = table%cells*(line - table%begin)
         call read_row(text, line, table%separator, table%values(i + 1:i + table%cells), ok)
         if (ok) cycle
         call raise_bad_line(text, line, table%begin, table%cells, error)
         return
      end do
      ! pandas names columns 0, 1, 2 ...
      if (table%cells > 1 .and. are_names(text, table)) call drop_row(table, rows)
      call read_top(text, after_top, table%cells, top, samples%metadata, error)
      if (allocated(error)) return
      if (table%cells == 1) call take_count_line(text, table, rows, top, error)
      if (.not. allocated(error)) call check_count(text, top, rows, note, error)
      if (allocated(error)) return
      call samples%metadata%append('reading', note)
      if (size(table%values) > table%cells*rows) table%values = table%values(:table%cells*rows)
      call find_roles(text, table, top, is_given, roles, error)
      if (allocated(error)) return
      call samples%metadata%append('reading', roles%note)
      call settle_step(text, table%begin, top, roles, error)
      if (.not. allocated(error)) call make_channels(text, top, roles, table, samples, error)
      if (allocated(error) .or. table%begin + rows - 1 < text%lines()) return
      call find_cut(text, table%begin, text%lines(), ok, i, 0, .false.)
      if (ok) call samples%metadata%append('reading', 'the last value, '''// &
         & shown(text%text(i:text%last(text%lines())))//''', is printed shorter than the others, or far larger: '// &
         & 'the file may be cut off')
   end subroutine read_plain

   !> The step of the times must be the one that is stated
   subroutine settle_step(text, begin, top, roles, error)
      type(text_file_type), intent(in) :: text
      !> First line of values
      integer, intent(in) :: begin
      type(top_type), intent(in) :: top
      !> The stated step takes the place of that of the times
      type(roles_type), intent(inout) :: roles
      !> The two differ
      type(error_type), allocatable, intent(out) :: error

      associate (stated => top%statements%dt, step => roles%dt)
         if (.not. stated > 0.0_wp) return
         if (step > 0.0_wp .and. abs(stated - step) > max(step_tolerance*step, roles%doubt)) then
            call raise_at(error, text, begin, 'the step of the times is '//to_text(step)//': a comment states dt = '// &
               & to_text(stated))
            return
         end if
         if (.not. step > 0.0_wp .or. abs(stated - step) <= roles%doubt) step = stated
         roles%doubt = 0.0_wp
      end associate
   end subroutine settle_step

   !> Make the channels
   subroutine make_channels(text, top, roles, table, samples, error)
      type(text_file_type), intent(in) :: text
      type(top_type), intent(in) :: top
      type(roles_type), intent(in) :: roles
      !> The values, moved away if they are of a single column
      type(table_type), intent(inout) :: table
      type(samples_type), intent(inout) :: samples
      !> Units of a title and of another line differ
      type(error_type), allocatable, intent(out) :: error

      type(error_type), allocatable :: unknown, other
      real(wp) :: factor, stated
      integer :: i, k

      allocate (samples%channels(size(roles%channels)))
      do i = 1, size(samples%channels)
         k = roles%channels(i)
         associate (channel => samples%channels(i), statements => top%statements)
            if (table%cells == 1) then
               call move_alloc(table%values, channel%values)
            else
               channel%values = table%values(k::table%cells)
            end if
            channel%dt = roles%dt
            channel%dt_doubt = roles%doubt
            if (size(samples%channels) > 1) channel%name = 'column '//to_text(k)
            if (size(samples%channels) > 1 .and. len(top%titles(k)%text) > 0) channel%name = top%titles(k)%text
            if (len(top%units(k)%text) > 0) channel%units = top%units(k)%text
            if (is_other_quantity(top%titles(k)%text, top%units(k)%text)) channel%refusal = &
               & text%place(top%title_line)//': channel '''//shown(top%titles(k)%text)//''' is not an acceleration'
            if (statements%other_line > 0 .and. .not. statements%has_acceleration) channel%refusal = &
               & text%place(statements%other_line)//': '''//shown(statements%other)//''' is not an acceleration'
            if (allocated(top%refusal)) channel%refusal = top%refusal
            if (statements%units_line == 0 .or. allocated(channel%refusal)) cycle
            if (.not. allocated(channel%units)) then
               channel%units = statements%units
               cycle
            end if
            call unit_factor(channel%units, factor, unknown)
            call unit_factor(statements%units, stated, other)
            if (allocated(unknown) .or. allocated(other) .or. (factor >= stated .and. factor <= stated)) cycle
            call raise_at(error, text, statements%units_line, 'units '''//shown(statements%units)// &
               & ''': the title '''//shown(top%titles(k)%text)//''' states '''//shown(channel%units)//'''')
            return
         end associate
      end do
   end subroutine make_channels

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
         call parse_printed(text%text(first(cell):last(cell)), value, ok)
         if (ok) cycle
         call raise_at(error, text, line, 'value '''//shown(text%text(first(cell):last(cell)))//''': must be a number')
         return
      end do
      call raise_at(error, text, line, 'columns must be separated as in line '//to_text(begin))
   end subroutine raise_bad_line

end module dondolo_record_format_columns
