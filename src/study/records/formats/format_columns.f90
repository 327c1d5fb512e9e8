!> Plain columns of numbers: accelerations alone, one a line; times and accelerations; columns titled as such; and whatever the
!> caller or the row of a catalogue says that they are (dondolo_records_column_layout), values along the rows too.
!>
!> Above them may be titles, a row of units, and statements (dondolo_records_column_statements), above a single column or values
!> along the rows also a line of their number and step (dondolo_records_column_lead). Columns are separated by semicolons, commas,
!> or blanks and tabs. What lines state is used, or contradicts the values or what is given, and is an error. Of two channels or
!> more, each has its title for a name, else `column 2` and so on.
module dondolo_records_format_columns
   use dondolo_base_error, only : add_place, error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_limits, only : most_columns
   use dondolo_base_memory, only : check_room
   use dondolo_base_numbers, only : parse_real
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : to_text
   use dondolo_files_text_file, only : text_file_type
   use dondolo_record_metadata, only : metadata_type
   use dondolo_records_column_cells, only : find_cells, first_value_line, is_values, most_cells, separator_of
   use dondolo_records_column_layout, only : a_time, an_acceleration, layout_type, raise_unclear, read_layout
   use dondolo_records_column_prints, only : check_prints
   use dondolo_records_column_roles, only : find_roles, roles_type, table_type, take_times
   use dondolo_records_column_rows, only : read_rows, read_table
   use dondolo_records_column_text, only : look_at_columns, make_plain, irregularities_type
   use dondolo_records_column_titles, only : is_other_quantity
   use dondolo_records_column_top, only : read_top, top_type
   use dondolo_records_direction, only : names_vertical
   use dondolo_records_last_number, only : find_cut
   use dondolo_records_format, only : check_duration, channel_type, given_type, most_extra, note_extra, raise_at, samples_type, &
      & step_tolerance
   use dondolo_records_units, only : unit_factor
   implicit none
   private

   public :: recognises_columns, read_columns

contains

   !> Is a text in this format? There is a line of numbers
   logical function recognises_columns(text) result(recognised)
      type(text_file_type), intent(in) :: text

      recognised = first_value_line(text) <= text%lines()
   end function recognises_columns

   !> Read plain columns
   subroutine read_columns(text, given, samples, error)
      type(text_file_type), intent(in) :: text
      type(given_type), intent(in) :: given
      !> What it says
      type(samples_type), intent(out) :: samples
      !> What is wrong, with file and line
      type(error_type), allocatable, intent(out) :: error

      type(text_file_type) :: plain
      type(irregularities_type) :: odd
      type(layout_type) :: layout

      call read_layout(given, layout, error)
      call add_place(error, text%file)
      if (allocated(error)) return
      call look_at_columns(text, size(layout%kinds) == 1 .and. .not. layout%is_rows, odd)
      if (.not. odd%any()) then
         call read_plain(text, given, layout, samples, error)
         return
      end if
      call make_plain(text, odd, plain)
      call read_plain(plain, given, layout, samples, error)
      if (odd%has_commas .and. .not. allocated(error)) call samples%metadata%append('processing', 'decimal commas read')
   end subroutine read_columns

   !> Read plain columns without quotes and decimal commas
   subroutine read_plain(text, given, layout, samples, error)
      type(text_file_type), intent(in) :: text
      type(given_type), intent(in) :: given
      !> What is said of the columns
      type(layout_type), intent(in) :: layout
      !> What it says
      type(samples_type), intent(out) :: samples
      !> What is wrong, with file and line
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: note
      type(table_type) :: table
      type(top_type) :: top
      type(roles_type) :: roles
      integer :: begin, at, above, rows, first(most_cells), last(most_cells)
      logical :: is_cut

      if (layout%passes .and. .not. layout%is_rows) then
         begin = first_value_line(text, size(layout%kinds))
         call pass_over(text, layout, begin, note)
         call samples%metadata%append('reading', note)
      else
         begin = first_value_line(text)
      end if
      if (begin > text%lines()) then
         if (layout%is_given) call raise_at(error, text, text%lines(), 'no line of values as columns = '''// &
            & shown(given%columns)//''' says')
         if (.not. layout%is_given) call raise_at(error, text, text%lines(), 'no line of values')
         return
      end if
      ! The line after a count tells what the columns are
      at = begin
      if (begin < text%lines()) then
         if (is_values(text%line(begin + 1))) at = begin + 1
      end if
      table%begin = begin
      table%separator = separator_of(text, at)
      call find_cells(text, begin, separator_of(text, begin), first, last, above)
      call find_cells(text, at, table%separator, first, last, table%cells)
      if (layout%is_rows) table%cells = 1
      if ((above /= table%cells .or. table%separator /= separator_of(text, begin)) .and. table%cells > 1) then
         call raise_unclear(error, text, begin, ''''//shown(text%line(begin))//''' above lines of '//to_text(table%cells)// &
            & ' values, where a number of samples and a step may stand only above a single column', given, table%cells)
         return
      end if
      if (table%cells >= most_cells) then
         call raise_unclear(error, text, at, 'more than '//to_text(most_columns)//' columns, or values along the rows', given, &
            & table%cells)
         return
      end if
      call read_top(text, begin, table%cells, given, layout, top, samples%metadata, error)
      if (.not. allocated(error)) call find_roles(text, table, top, given, layout, roles, error)
      if (allocated(error)) return
      call check_room(32.0_wp*real(table%cells, wp)*real(text%lines(), wp), error)
      call add_place(error, text%file)
      if (allocated(error)) return
      if (layout%is_rows) then
         call read_rows(text, given, table, top, note, error)
      else
         call read_table(text, given, layout, table, top, note, error)
      end if
      if (allocated(error)) return
      call samples%metadata%append('reading', note)
      rows = size(table%values)/table%cells
      call check_count(text, top, rows, samples%metadata, error)
      if (allocated(error)) return
      if (size(table%values) > table%cells*rows) table%values = table%values(:table%cells*rows)
      if (roles%time > 0) call take_times(text, table, top, given, roles, error)
      if (allocated(error)) return
      call samples%metadata%append('reading', roles%note)
      call check_prints(text, table%begin, table%cells, roles%kinds == an_acceleration, table%values, error)
      if (allocated(error)) return
      call settle_step(text, table%begin, top, roles, error)
      if (.not. allocated(error)) call make_channels(text, given, top, roles, table, samples, error)
      if (allocated(error) .or. (table%begin + rows - 1 < text%lines() .and. .not. layout%is_rows)) return
      call find_cut(text, table%begin, text%lines(), is_cut, at, 0, layout%is_rows)
      if (is_cut) call samples%metadata%append('reading', 'the last value, '''// &
         & shown(text%text(at:text%last(text%lines())))//''', is printed shorter than the others, or far larger: '// &
         & 'the file may be cut off')
   end subroutine read_plain

   !> Pass over a first row that is not one of those below it: a number of samples and a step, after which times begin again
   subroutine pass_over(text, layout, begin, note)
      type(text_file_type), intent(in) :: text
      type(layout_type), intent(in) :: layout
      !> First line of values
      integer, intent(inout) :: begin
      !> What to report, empty if there is nothing
      character(len=:), allocatable, intent(out) :: note

      integer :: first(most_cells), last(most_cells), time, cells, i
      real(wp) :: times(3)
      logical :: ok

      note = ''
      time = findloc(layout%kinds, a_time, dim=1)
      if (time == 0 .or. begin + 2 > text%lines()) return
      do i = 1, 3
         call find_cells(text, begin + i - 1, separator_of(text, begin + i - 1), first, last, cells)
         if (cells /= size(layout%kinds)) return
         call parse_real(text%text(first(time):last(time)), times(i), ok)
         if (.not. ok) return
      end do
      if (times(1) < times(2) .or. times(2) >= times(3)) return
      note = 'line '//to_text(begin)//', '''//shown(text%line(begin))//''', is passed over'
      begin = begin + 1
   end subroutine pass_over

   !> The number of rows must be the one that is stated, or one or two more
   subroutine check_count(text, top, rows, metadata, error)
      type(text_file_type), intent(in) :: text
      type(top_type), intent(in) :: top
      !> Number of rows; those that are ignored are taken off
      integer, intent(inout) :: rows
      !> What to report of them is kept there
      type(metadata_type), intent(inout) :: metadata
      !> It is another
      type(error_type), allocatable, intent(out) :: error

      associate (stated => top%statements)
         if (stated%count_line == 0 .or. rows == stated%count) return
         if (rows < stated%count .or. rows > stated%count + most_extra) then
            call raise_at(error, text, stated%count_line, to_text(stated%count)//' samples stated: the file has '// &
               & to_text(rows))
            return
         end if
         call note_extra(rows - stated%count, stated%count, metadata)
         rows = stated%count
      end associate
   end subroutine check_count

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
            call raise_at(error, text, begin, 'the step of the times is '//to_text(step)//': the file states dt = '// &
               & to_text(stated))
            return
         end if
         if (.not. step > 0.0_wp .or. abs(stated - step) <= roles%doubt) step = stated
         roles%doubt = 0.0_wp
      end associate
   end subroutine settle_step

   !> Make the channels
   subroutine make_channels(text, given, top, roles, table, samples, error)
      type(text_file_type), intent(in) :: text
      type(given_type), intent(in) :: given
      type(top_type), intent(in) :: top
      type(roles_type), intent(in) :: roles
      !> The values, moved away if they are of a single column
      type(table_type), intent(inout) :: table
      type(samples_type), intent(inout) :: samples
      !> What is stated of units, of the largest value or of the duration differs
      type(error_type), allocatable, intent(out) :: error

      integer, allocatable :: columns(:)
      integer :: i, k

      columns = pack([(i, i=1, table%cells)], roles%is_channel)
      allocate (samples%channels(size(columns)))
      do i = 1, size(columns)
         k = columns(i)
         associate (channel => samples%channels(i), statements => top%statements)
            if (table%cells == 1) then
               call move_alloc(table%values, channel%values)
            else
               channel%values = table%values(k::table%cells)
            end if
            channel%dt = roles%dt
            channel%dt_doubt = roles%doubt
            if (size(columns) > 1) channel%name = 'column '//to_text(k)
            if (size(columns) > 1 .and. len(top%titles(k)%text) > 0) channel%name = top%titles(k)%text
            if (size(columns) == 1) then
               if (names_vertical(top%titles(k)%text)) call channel%metadata%set('component', top%titles(k)%text)
            end if
            if (len(top%units(k)%text) > 0) channel%units = top%units(k)%text
            if (roles%kinds(k) /= an_acceleration .or. is_other_quantity(top%titles(k)%text, top%units(k)%text)) channel%refusal = &
               & text%place(top%title_line)//': channel '''//shown(top%titles(k)%text)//''' is not an acceleration'
            if (statements%other_line > 0) channel%refusal = &
               & text%place(statements%other_line)//': '''//shown(statements%other)//''' is not an acceleration'
            if (allocated(channel%refusal)) cycle
            if (statements%units_line > 0) call settle_units(text, top, k, channel, error)
            if (.not. allocated(error)) call take_peak(text, given, top, count(roles%kinds == an_acceleration), &
               & channel, error)
            if (allocated(error)) return
         end associate
      end do
   end subroutine make_channels

   !> Units of a title and those that a line states must be the same
   subroutine settle_units(text, top, k, channel, error)
      type(text_file_type), intent(in) :: text
      type(top_type), intent(in) :: top
      !> Column of the channel
      integer, intent(in) :: k
      type(channel_type), intent(inout) :: channel
      !> They differ
      type(error_type), allocatable, intent(out) :: error

      type(error_type), allocatable :: unknown, other
      real(wp) :: factor, stated

      associate (statements => top%statements)
         if (.not. allocated(channel%units)) channel%units = statements%units
         call unit_factor(channel%units, factor, unknown)
         call unit_factor(statements%units, stated, other)
         if (allocated(unknown) .or. allocated(other) .or. (factor >= stated .and. factor <= stated)) return
         call raise_at(error, text, statements%units_line, 'units '''//shown(statements%units)// &
            & ''': the title '''//shown(top%titles(k)%text)//''' states '''//shown(channel%units)//'''')
      end associate
   end subroutine settle_units

   !> Take the largest value that is stated, and check the duration
   subroutine take_peak(text, given, top, channels, channel, error)
      type(text_file_type), intent(in) :: text
      type(given_type), intent(in) :: given
      type(top_type), intent(in) :: top
      !> Number of channels
      integer, intent(in) :: channels
      type(channel_type), intent(inout) :: channel
      !> The duration is another, or the largest value may be that of any channel
      type(error_type), allocatable, intent(out) :: error

      type(channel_type) :: timed

      associate (statements => top%statements)
         if (statements%duration_line > 0) then
            timed = channel
            if (allocated(given%dt)) timed%dt = given%dt
            call check_duration(text, statements%duration_line, statements%duration, timed, error)
         end if
         if (statements%peak_line == 0 .or. allocated(error)) return
         if (channels > 1) then
            call raise_unclear(error, text, statements%peak_line, 'a largest value of '//to_text(channels)//' channels', &
               & given, size(top%titles))
            return
         end if
         channel%peak = statements%peak
         channel%peak_line = statements%peak_line
         if (len(statements%peak_units) > 0) channel%peak_units = statements%peak_units
      end associate
   end subroutine take_peak

end module dondolo_records_format_columns
