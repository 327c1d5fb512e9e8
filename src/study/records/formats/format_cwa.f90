!> Files of the Central Weather Administration of Taiwan: header lines `#key: value`, then times and components in
!> columns of 10 characters. Times are those of Taiwan.
module dondolo_records_format_cwa
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_real
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : first_word, to_text
   use dondolo_files_text_file, only : text_file_type
   use dondolo_record_metadata, only : metadata_type
   use dondolo_records_equal_steps, only : check_equal_steps, step_type
   use dondolo_records_header_fields, only : field_type, header_type
   use dondolo_records_labels, only : labels_type, read_labels
   use dondolo_records_format, only : block_type, most_extra, name_listed, note_extra, raise_at, read_fixed, samples_type, &
      & step_tolerance
   implicit none
   private

   public :: recognises_cwa, read_cwa

   !> Characters of a column
   integer, parameter :: width = 10

   !> Channels at most
   integer, parameter :: most_channels = 16

   !> What the header says
   type(field_type), parameter :: fields(7) = [ &
      & field_type('date', '#Origin Time(GMT+08)', 'dmy', zone='+08:00'), &
      & field_type('event latitude', '#EpicenterLatitude(N)'), field_type('event longitude', '#EpicenterLongitude(E)'), &
      & field_type('station', '#StationCode'), &
      & field_type('magnitude', '#Magnitude(Ml)'), &
      & field_type('latitude', '#StationLatitude(N)'), field_type('longitude', '#StationLongitude(E)')]

contains

   !> Is a text in this format? Its header states sampling rate, units and sequence of the columns
   logical function recognises_cwa(text) result(recognised)
      type(text_file_type), intent(in) :: text

      type(labels_type) :: labels

      call read_labels(text, 1, header_lines(text), labels)
      recognised = labels%line_of('#SampleRate(Hz)') > 0 .and. labels%line_of('#AmplitudeUnit') > 0 .and. &
         & labels%line_of('#DataSequence') > 0
   end function recognises_cwa

   !> Read a file
   subroutine read_cwa(text, samples, error)
      type(text_file_type), intent(in) :: text
      !> What it says
      type(samples_type), intent(out) :: samples
      !> What is wrong, with file and line
      type(error_type), allocatable, intent(out) :: error

      type(header_type) :: header
      character(len=:), allocatable :: units
      type(step_type) :: step
      real(wp), allocatable :: values(:)
      real(wp) :: rate
      integer :: begin, rows, columns, i

      begin = header_lines(text) + 1
      call read_labels(text, 1, begin - 1, header%labels)
      call header%labels%get_positive(text, '#SampleRate(Hz)', rate, error)
      if (allocated(error)) return
      call name_channels(header%labels%value_of('#DataSequence'), samples)
      columns = size(samples%channels) + 1
      if (columns == 1) then
         call raise_at(error, text, max(header%labels%line_of('#DataSequence'), 1), 'DataSequence = '''// &
            & shown(header%labels%value_of('#DataSequence'))//''': must be Time and the components')
         return
      end if
      rows = text%lines() - begin + 1
      call read_fixed(text, block_type(begin, columns*rows, width, columns), values, error)
      if (.not. allocated(error)) call check_rows(text, header%labels, rate, rows, samples%metadata, error)
      if (allocated(error)) return
      call check_equal_steps(text, begin, values(1:columns*rows:columns), &
         & text%first(begin:begin + rows - 1), text%first(begin:begin + rows - 1) + width - 1, step, &
         & error, 1.0_wp/rate)
      if (allocated(error)) return
      call samples%metadata%append('reading', step%note)
      if (abs(step%dt*rate - 1.0_wp) > step_tolerance) then
         call raise_at(error, text, header%labels%line_of('#SampleRate(Hz)'), 'SampleRate(Hz) = '//to_text(rate)// &
            & ': the step of the times is '//to_text(step%dt))
         return
      end if
      units = header%labels%value_of('#AmplitudeUnit')
      do i = 1, columns - 1
         associate (channel => samples%channels(i))
            channel%values = values(1 + i:columns*rows:columns)
            channel%dt = 1.0_wp/rate
            channel%units = first_word(units, ' .')
            channel%peak = trim(larger(header%labels%value_of('#AmplitudeMAX. '//channel%name)))
            channel%peak_line = max(header%labels%line_of('#AmplitudeMAX. '//channel%name), 1)
            call channel%metadata%set('component', channel%name)
         end associate
      end do
      call header%keep(text, fields, samples%metadata)
      do i = 1, size(header%labels%labels)
         associate (label => header%labels%labels(i))
            if (len(label%key) > 1) call samples%metadata%set(label%key(2:), label%value)
         end associate
      end do
      if (index(units, '. ') > 0) call samples%metadata%set('processing', units(index(units, '. ') + 2:))
   end subroutine read_cwa

   !> The number of rows must be the one that duration and sampling rate make, or one or two more
   subroutine check_rows(text, labels, rate, rows, metadata, error)
      type(text_file_type), intent(in) :: text
      type(labels_type), intent(in) :: labels
      !> Sampling rate [1/s]
      real(wp), intent(in) :: rate
      !> Number of rows; those that are ignored are taken off
      integer, intent(inout) :: rows
      !> What to report of them is kept there
      type(metadata_type), intent(inout) :: metadata
      !> It is another
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: duration
      integer :: stated

      call labels%get_positive(text, '#RecordLength(sec)', duration, error)
      if (allocated(error)) return
      ! The duration may count from the first to the last sample
      if (abs(real(rows, wp) - rate*duration) <= 1.0_wp) return
      if (rate*duration < real(rows, wp)) then
         stated = nint(rate*duration)
         if (rows <= stated + most_extra) then
            call note_extra(rows - stated, stated, metadata)
            rows = stated
            return
         end if
      end if
      call raise_at(error, text, text%lines(), to_text(rows)//' rows of values: the header states '// &
         & to_text(rate*duration))
   end subroutine check_rows

   !> Name the channels from the sequence of the columns: `Time U(+); N(+); E(+)`
   subroutine name_channels(sequence, samples)
      !> The sequence
      character(len=*), intent(in) :: sequence
      !> Channels with names are set in it
      type(samples_type), intent(inout) :: samples

      character(len=*), parameter :: separators = ' ;,'//achar(9)
      integer :: i

      i = len(sequence) + 1
      if (first_word(sequence, separators) == 'Time') i = index(sequence, 'Time') + len('Time')
      call name_listed(sequence(i:), separators, most_channels, samples%channels)
      do i = 1, size(samples%channels)
         samples%channels(i)%name = first_word(samples%channels(i)%name, '(')
      end do
   end subroutine name_channels

   !> The larger of two numbers: `0.658~   -0.837`
   pure function larger(range) result(number)
      !> The numbers, smallest and largest in any order
      character(len=*), intent(in) :: range
      !> The text of the one that is larger in size, or all if they are no numbers; filled up with blanks
      character(len=len(range)) :: number

      real(wp) :: one, other
      integer :: mark
      logical :: ok, ok_other

      number = range
      mark = index(range, '~')
      if (mark == 0) return
      call parse_real(range(:mark - 1), one, ok)
      call parse_real(range(mark + 1:), other, ok_other)
      if (.not. (ok .and. ok_other)) return
      if (abs(one) >= abs(other)) then
         number = adjustl(range(:mark - 1))
      else
         number = adjustl(range(mark + 1:))
      end if
   end function larger

   !> Number of lines of the header
   pure function header_lines(text) result(count)
      type(text_file_type), intent(in) :: text
      !> Number of the last line at the top that begins with #; empty lines may stand between
      integer :: count

      integer :: line

      count = 0
      do line = 1, text%lines()
         if (text%last(line) < text%first(line)) cycle
         if (text%text(text%first(line):text%first(line)) /= '#') return
         count = line
      end do
   end function header_lines

end module dondolo_records_format_cwa
