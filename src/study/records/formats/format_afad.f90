!> Text files of the national network of Turkey (AFAD): a title, lines `KEY : value`, a line with the names of the components, and
!> one column for each of them. The values are in gal, the unit of the peaks in the header. Raw values contain the offset of the
!> instrument.
module dondolo_records_format_afad
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_real
   use dondolo_base_text, only : blanks, first_word, lower, to_text
   use dondolo_files_text_file, only : text_file_type
   use dondolo_record_metadata, only : metadata_type
   use dondolo_records_header_fields, only : field_type, header_type
   use dondolo_records_header_text, only : after, before, leading_number
   use dondolo_records_labels, only : labels_type, read_labels
   use dondolo_records_format, only : channel_type, most_extra, name_listed, note_extra, raise_at, read_block, samples_type, &
      & step_tolerance
   use dondolo_records_units, only : unit_factor
   implicit none
   private

   public :: recognises_afad, read_afad

   !> Lines of a header at most
   integer, parameter :: most_lines = 60

   !> Channels at most
   integer, parameter :: most_channels = 6

   !> Relative difference allowed between a peak and the header's
   real(wp), parameter :: peak_tolerance = 0.01_wp

   character(len=*), parameter :: count_key = 'NUMBER OF DATA', step_key = 'SAMPLING INTERVAL (sec)', &
      & rate_keys(2) = [character(len=18) :: 'SAMPLING RATE (Hz)', 'SAMPLING FREQ (Hz)'], peak_word = 'PGA VALUES'

   !> What the header says
   type(field_type), parameter :: fields(7) = [ &
      & field_type('date', 'EARTHQUAKE DATE', 'dmy'), &
      & field_type('event latitude', 'EPICENTER COORDINATES', 'NS'), &
      & field_type('event longitude', 'EPICENTER COORDINATES', 'EW', then='-'), &
      & field_type('station', 'STATION ID'), &
      & field_type('magnitude', 'EARTHQUAKE MAGNITUDE', 'number'), &
      & field_type('latitude', 'STATION COORDINATES', 'NS'), &
      & field_type('longitude', 'STATION COORDINATES', 'EW', then='-')]

contains

   !> Is a text in this format? Its title names records of strong motion, and its header states number and step of the data
   logical function recognises_afad(text) result(recognised)
      type(text_file_type), intent(in) :: text

      type(labels_type) :: labels

      recognised = index(lower(text%line(1)), 'strong ground motion record') > 0
      if (.not. recognised) return
      call read_labels(text, 1, min(most_lines, text%lines()), labels)
      recognised = labels%line_of(count_key) > 0
   end function recognises_afad

   !> Read a file
   subroutine read_afad(text, samples, error)
      type(text_file_type), intent(in) :: text
      !> What it says
      type(samples_type), intent(out) :: samples
      !> What is wrong, with file and line
      type(error_type), allocatable, intent(out) :: error

      type(header_type) :: header
      character(len=:), allocatable :: units
      real(wp), allocatable :: values(:)
      real(wp) :: dt
      integer :: begin, channels, count, rows, i

      begin = first_row(text)
      call read_labels(text, 1, begin - 1, header%labels)
      call header%labels%get_count(text, count_key, count, error)
      if (.not. allocated(error)) call read_step(text, header%labels, dt, error)
      if (allocated(error)) return
      ! N-S          E-W          U-D
      call name_listed(text%line(begin - 1), blanks, most_channels, samples%channels)
      channels = size(samples%channels)
      if (channels == 0) then
         call raise_at(error, text, max(begin - 1, 1), 'must be the names of the components')
         return
      end if
      rows = text%lines() - begin + 1
      if (rows < count .or. rows > count + most_extra) then
         call raise_at(error, text, text%lines(), to_text(rows)//' rows of values: the header states '//to_text(count))
         return
      end if
      ! All rows, since the last one may be cut off
      call read_block(text, begin, channels*rows, values, error, samples%metadata)
      if (allocated(error)) return
      call note_extra(rows - count, count, samples%metadata)
      call find_units(header%labels, units)
      do i = 1, channels
         associate (channel => samples%channels(i))
            channel%values = values(i:channels*count:channels)
            channel%dt = dt
            channel%units = units
            call channel%metadata%set('component', channel%name)
            call take_peak(text, header%labels, channel)
         end associate
      end do
      call keep_header(text, header, samples%metadata)
   end subroutine read_afad

   !> Line of the first row of values, beyond the last if there is none
   integer function first_row(text) result(line)
      type(text_file_type), intent(in) :: text

      real(wp) :: value
      logical :: ok

      do line = 2, text%lines()
         call parse_real(first_word(text%line(line), blanks), value, ok)
         ! Touching columns begin with a number too
         if (.not. ok) ok = scan(adjustl(text%line(line)), '-+.0123456789') == 1 .and. index(text%line(line), ':') == 0
         if (ok) return
      end do
   end function first_row

   !> Read the time step: the interval, or the rate in its place
   subroutine read_step(text, labels, dt, error)
      type(text_file_type), intent(in) :: text
      type(labels_type), intent(in) :: labels
      !> Time step [s]
      real(wp), intent(out) :: dt
      !> Neither is stated, or the two differ
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: rate
      integer :: i

      dt = 0.0_wp
      rate = 0.0_wp
      do i = 1, size(rate_keys)
         if (len(labels%value_of(trim(rate_keys(i)))) > 0 .and. .not. allocated(error)) then
           call labels%get_positive(text, trim(rate_keys(i)), rate, error, 'Hz')
         end if
      end do
      if (allocated(error)) return
      if (len(labels%value_of(step_key)) == 0 .and. rate > 0.0_wp) then
         dt = 1.0_wp/rate
         return
      end if
      call labels%get_positive(text, step_key, dt, error)
      if (allocated(error) .or. .not. rate > 0.0_wp) return
      if (abs(dt*rate - 1.0_wp) > step_tolerance) call raise_at(error, text, labels%line_of(step_key), step_key//' = '// &
         & to_text(dt)//': the header states a rate of '//to_text(rate)//' samples per second')
   end subroutine read_step

   !> Find the units of the values: those of the peaks, which are in the brackets of their key
   subroutine find_units(labels, units)
      type(labels_type), intent(in) :: labels
      !> The units, empty if they are not stated
      character(len=:), allocatable, intent(out) :: units

      integer :: i

      units = ''
      do i = 1, size(labels%labels)
         if (index(labels%labels(i)%key, peak_word) == 0) cycle
         units = before(after(labels%labels(i)%key, '('), ')')
      end do
   end subroutine find_units

   !> Take the peak of a channel: `(N-S) 146.18 (E-W) 102.33 (U-D) 14.62`; the peak of raw values may be that without their mean
   subroutine take_peak(text, labels, channel)
      type(text_file_type), intent(in) :: text
      type(labels_type), intent(in) :: labels
      type(channel_type), intent(inout) :: channel

      type(error_type), allocatable :: unknown
      character(len=:), allocatable :: stated
      real(wp) :: peak, mean, factor
      integer :: i
      logical :: ok

      do i = 1, size(labels%labels)
         associate (label => labels%labels(i))
            if (index(label%key, peak_word) == 0) cycle
            stated = leading_number(after(label%value, '('//channel%name//')'))
            call parse_real(stated, peak, ok)
            call unit_factor(before(after(label%key, '('), ')'), factor, unknown)
            if (.not. ok .or. allocated(unknown)) cycle
            mean = sum(channel%values)/real(size(channel%values), wp)
            if (abs(maxval(abs(channel%values - mean)) - abs(peak)) <= peak_tolerance*abs(peak)) cycle
            channel%peak = stated
            channel%peak_line = min(label%line, text%lines())
         end associate
      end do
   end subroutine take_peak

   !> Keep what the header says; times are those of Greenwich
   subroutine keep_header(text, header, metadata)
      type(text_file_type), intent(in) :: text
      type(header_type), intent(in) :: header
      !> What it says
      type(metadata_type), intent(inout) :: metadata

      call header%keep(text, fields, metadata)
      if (index(metadata%get('date'), 'T') > 0) then
         call metadata%set('date', metadata%get('date')//'Z')
         call metadata%set('event time', metadata%get('date'))
      end if
      call header%labels%add_to(metadata)
   end subroutine keep_header

end module dondolo_records_format_afad
