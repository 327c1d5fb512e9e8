!> Tables of K-NET and KiK-net as NIED of Japan publishes them: comments `# key, value`, a comment with the titles of the columns,
!> then a time and the components, separated by commas. Times are dates with a time of the day, of Japan, or seconds.
module dondolo_records_format_nied
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_integer, parse_printed, parse_real
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : lower, stripped, to_text
   use dondolo_files_text_file, only : text_file_type
   use dondolo_records_column_cells, only : find_cells, most_cells, unquoted
   use dondolo_records_column_titles, only : find_units, is_other_quantity
   use dondolo_records_dates, only : day_number, find_moment
   use dondolo_records_equal_steps, only : check_equal_steps, step_type
   use dondolo_records_header_text, only : leading_number
   use dondolo_records_format_knet, only : knet_fields
   use dondolo_records_header_fields, only : header_type
   use dondolo_records_last_number, only : find_cut
   use dondolo_records_format, only : raise_at, samples_type, step_tolerance
   implicit none
   private

   public :: recognises_nied, read_nied

contains

   !> Is a text in this format? Comments with commas state origin time or station and sampling frequency, and name the columns
   logical function recognises_nied(text) result(recognised)
      type(text_file_type), intent(in) :: text

      type(header_type) :: header
      integer :: titles

      call read_header(text, header, titles)
      recognised = titles > 0 .and. len(header%entries%get('Sampling Freq(Hz)')) > 0
   end function recognises_nied

   !> Read the comments
   subroutine read_header(text, header, titles)
      type(text_file_type), intent(in) :: text
      !> Keys and values
      type(header_type), intent(out) :: header
      !> Line of the titles, the last comment: `# Time, N-S(gal), ...`; 0 if there are none
      integer, intent(out) :: titles

      character(len=:), allocatable :: line
      integer :: i, comma

      titles = 0
      do i = 1, text%lines()
         line = stripped(text%line(i))
         if (len(line) == 0) cycle
         if (line(1:1) /= '#') return
         line = stripped(line(2:))
         comma = index(line, ',')
         titles = 0
         if (comma < 2) cycle
         if (lower(stripped(line(:comma - 1))) == 'time') titles = i
         if (titles == 0) call header%entries%set(line(:comma - 1), line(comma + 1:))
      end do
   end subroutine read_header

   !> Read a file
   subroutine read_nied(text, samples, error)
      type(text_file_type), intent(in) :: text
      !> What it says
      type(samples_type), intent(out) :: samples
      !> What is wrong, with file and line
      type(error_type), allocatable, intent(out) :: error

      type(header_type) :: header
      character(len=:), allocatable :: title, units, note
      real(wp), allocatable :: time(:)
      real(wp) :: rate
      integer :: titles, columns, rows, i, k, cells, begin, first(most_cells), last(most_cells)
      integer, allocatable :: from(:), to(:)
      logical :: ok, is_cut

      call read_header(text, header, titles)
      call parse_real(leading_number(header%entries%get('Sampling Freq(Hz)')), rate, ok)
      if (titles == 0 .or. .not. (ok .and. rate > 0.0_wp)) then
         call raise_at(error, text, 1, 'Sampling Freq(Hz) = '''//shown(header%entries%get('Sampling Freq(Hz)'))// &
            & ''': must be positive, and the last comment the titles of the columns, the first of them Time')
         return
      end if
      call find_cells(text, titles, ',', first, last, columns)
      begin = titles + 1
      rows = text%lines() - titles
      if (columns < 2 .or. columns >= most_cells .or. rows < 1) then
         call raise_at(error, text, titles, 'no titles of components, or no rows of values after them')
         return
      end if
      allocate (samples%channels(columns - 1))
      do k = 2, columns
         associate (channel => samples%channels(k - 1))
            title = unquoted(text%text(first(k):last(k)))
            call find_units(title, units)
            channel%name = stripped(title(:scan(title//'(', '([') - 1))
            channel%units = units
            if (is_other_quantity(title, units)) channel%refusal = text%place(titles)//': channel '''//shown(title)// &
               & ''' is not an acceleration'
            allocate (channel%values(rows))
            call channel%metadata%set('component', channel%name)
         end associate
      end do
      allocate (time(rows), from(rows), to(rows))
      do i = 1, rows
         call find_cells(text, titles + i, ',', first, last, cells)
         if (cells /= columns) then
            call raise_at(error, text, titles + i, to_text(cells)//' values: must be '//to_text(columns)//' as the titles')
            return
         end if
         do k = 1, columns
            if (k == 1) then
               call read_time(text%text(first(1):last(1)), time(i), ok)
            else
               call parse_printed(text%text(first(k):last(k)), samples%channels(k - 1)%values(i), ok)
            end if
            if (ok) cycle
            call raise_at(error, text, titles + i, 'value '''//shown(text%text(first(k):last(k)))//''': must be a '// &
               & trim(merge('time  ', 'number', k == 1)))
            return
         end do
         from(i) = first(1)
         to(i) = last(1)
      end do
      call check_times(text, begin, time, from, to, rate, note, error)
      if (allocated(error)) return
      call samples%metadata%append('reading', note)
      samples%channels%dt = 1.0_wp/rate
      call find_cut(text, begin, text%lines(), is_cut, i, 0, .false.)
      if (is_cut) then
         call raise_at(error, text, text%lines(), 'the file is cut off: its last value, '''// &
            & shown(text%text(i:text%last(text%lines())))//''', is printed shorter than the others')
         return
      end if
      call header%keep(text, pack(knet_fields, knet_fields%key /= 'component'), samples%metadata)
      call samples%metadata%include(header%entries)
   end subroutine read_nied

   !> The times must be as far apart as the sampling frequency makes them
   subroutine check_times(text, begin, time, from, to, rate, note, error)
      type(text_file_type), intent(in) :: text
      !> Line of the first time
      integer, intent(in) :: begin
      !> Times [s]
      real(wp), intent(in) :: time(:)
      !> Positions of the first and the last character of each
      integer, intent(in) :: from(:), to(:)
      !> Sampling frequency [1/s]
      real(wp), intent(in) :: rate
      !> What to report of times that are coarser than that, empty if there is nothing
      character(len=:), allocatable, intent(out) :: note
      type(error_type), allocatable, intent(out) :: error

      type(step_type) :: step

      call check_equal_steps(text, begin, time - time(1), from, to, step, error, 1.0_wp/rate)
      note = step%note
      if (allocated(error)) return
      if (abs(step%dt*rate - 1.0_wp) > step_tolerance) call raise_at(error, text, begin, 'the step of the times is '// &
         & to_text(step%dt)//' s: Sampling Freq(Hz) = '//to_text(rate))
   end subroutine check_times

   !> Read a time: seconds, or `2031/03/04 05:06:00.02`
   subroutine read_time(text, time, ok)
      character(len=*), intent(in) :: text
      !> Time since any instant [s]
      real(wp), intent(out) :: time
      logical, intent(out) :: ok

      character(len=:), allocatable :: content, moment, clock
      integer :: at, hour, minute
      real(wp) :: second

      call parse_real(text, time, ok)
      if (ok) return
      content = unquoted(text)
      at = scan(content, ' T'//achar(9))
      if (at < 2) return
      call find_moment(content(:at - 1), 'dmy', moment)
      clock = stripped(content(at + 1:))
      if (len(clock) < 8 .or. len(moment) /= 10) return
      call parse_integer(clock(1:2), hour, ok)
      if (ok) call parse_integer(clock(4:5), minute, ok)
      if (ok) call parse_real(clock(7:), second, ok)
      if (ok) ok = clock(3:3) == ':' .and. clock(6:6) == ':' .and. hour >= 0 .and. hour < 24 .and. minute >= 0 .and. &
         & minute < 60 .and. second >= 0.0_wp .and. second < 61.0_wp
      ! Days from 2000 on, so that seconds keep their decimals
      if (ok) time = 86400.0_wp*real(day_number(moment) - day_number('2000-01-01'), wp) + 3600.0_wp*hour + 60.0_wp*minute + second
   end subroutine read_time

end module dondolo_records_format_nied
