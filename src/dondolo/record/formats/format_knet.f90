!> Files of the Japanese networks K-NET and KiK-net: 17 lines of header with keys of 18 characters, then counts of the
!> recorder, which its scale factor turns into gal.
!>
!> The counts hold the offset of the instrument, so their mean is removed, which the metadata say. Times are those of
!> Japan. (National Research Institute for Earth Science and Disaster Resilience, format of the ASCII files.)
module dondolo_record_format_knet
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_real
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : to_text
   use dondolo_base_text_file, only : text_file_type
   use dondolo_record_dates, only : find_moment
   use dondolo_record_format, only : raise_at, read_block, samples_type
   use dondolo_record_labels, only : labels_type, read_labels
   use dondolo_record_metadata, only : metadata_type
   implicit none
   private

   public :: recognises_knet, read_knet

   !> Lines of the header
   integer, parameter :: header_lines = 17

   !> Characters of a key
   integer, parameter :: key_width = 18

   !> Directions of KiK-net by their numbers: in the borehole, then at the surface
   character(len=*), parameter :: directions(6) = ['NS1', 'EW1', 'UD1', 'NS2', 'EW2', 'UD2']

contains

   !> Is a text in this format? Its header states origin time, sampling frequency and scale factor
   logical function recognises_knet(text) result(recognised)
      type(text_file_type), intent(in) :: text

      type(labels_type) :: labels

      call read_labels(text, 1, min(header_lines, text%lines()), labels, key_width)
      recognised = labels%line_of('Origin Time') == 1 .and. labels%line_of('Sampling Freq(Hz)') > 0 .and. &
         & labels%line_of('Scale Factor') > 0
   end function recognises_knet

   !> Read a file
   subroutine read_knet(text, samples, error)
      type(text_file_type), intent(in) :: text
      !> What it says
      type(samples_type), intent(out) :: samples
      !> What is wrong, with file and line
      type(error_type), allocatable, intent(out) :: error

      type(labels_type) :: labels
      character(len=:), allocatable :: note
      real(wp) :: frequency, duration, factor, mean
      integer :: direction

      call read_labels(text, 1, min(header_lines, text%lines()), labels, key_width)
      call labels%get_positive(text, 'Sampling Freq(Hz)', frequency, error, 'Hz')
      if (.not. allocated(error)) call labels%get_positive(text, 'Duration Time(s)', duration, error)
      if (.not. allocated(error)) call get_factor(text, labels, factor, error)
      if (allocated(error)) return
      if (frequency*duration > real(len(text%text), wp)) then
         call raise_at(error, text, max(labels%line_of('Duration Time(s)'), 1), 'Duration Time(s) = '// &
            & to_text(duration)//': the file is too short for it')
         return
      end if
      allocate (samples%channels(1))
      associate (channel => samples%channels(1))
         call read_block(text, header_lines + 1, nint(frequency*duration), channel%values, error, note)
         if (allocated(error)) return
         call samples%metadata%append('reading', note)
         mean = sum(channel%values)/real(max(size(channel%values), 1), wp)
         channel%values = factor*(channel%values - mean)
         channel%dt = 1.0_wp/frequency
         channel%units = 'gal'
         channel%name = labels%value_of('Dir.')
         direction = index('123456', channel%name)
         if (len(channel%name) == 1 .and. direction > 0) channel%name = directions(direction)
         channel%peak = labels%value_of('Max. Acc. (gal)')
         channel%peak_line = max(labels%line_of('Max. Acc. (gal)'), 1)
         call add_metadata(labels, channel%name, samples%metadata)
         call samples%metadata%set('processing', 'mean of '//to_text(anint(mean))//' counts removed')
      end associate
      call labels%add_to(samples%metadata)
   end subroutine read_knet

   !> Find the scale factor: `7845(gal)/8223790`
   subroutine get_factor(text, labels, factor, error)
      type(text_file_type), intent(in) :: text
      type(labels_type), intent(in) :: labels
      !> Its size of a count [gal]
      real(wp), intent(out) :: factor
      !> It is not written so, or not positive
      type(error_type), allocatable, intent(out) :: error

      character(len=*), parameter :: middle = '(gal)/'
      character(len=:), allocatable :: value
      real(wp) :: counts
      integer :: at
      logical :: ok

      value = labels%value_of('Scale Factor')
      at = index(value, middle)
      factor = 0.0_wp
      ok = at > 0
      if (ok) call parse_real(value(:at - 1), factor, ok)
      if (ok) call parse_real(value(at + len(middle):), counts, ok)
      if (ok) ok = factor > 0.0_wp .and. counts > 0.0_wp
      if (ok) factor = factor/counts
      if (.not. ok) call raise_at(error, text, max(labels%line_of('Scale Factor'), 1), 'Scale Factor = '''// &
         & shown(value)//''': must be two positive numbers, as 3920(gal)/6170801')
   end subroutine get_factor

   !> What the header says under the common keys
   subroutine add_metadata(labels, component, metadata)
      type(labels_type), intent(in) :: labels
      !> The component
      character(len=*), intent(in) :: component
      !> What it says
      type(metadata_type), intent(inout) :: metadata

      character(len=:), allocatable :: date

      call find_moment(labels%value_of('Origin Time')//'+09:00', 'dmy', date)
      call metadata%set('date', date)
      call metadata%set('event time', date)
      call metadata%set('event latitude', labels%value_of('Lat.'))
      call metadata%set('event longitude', labels%value_of('Long.'))
      call metadata%set('station', labels%value_of('Station Code'))
      call metadata%set('component', component)
      call metadata%set('magnitude', labels%value_of('Mag.'))
      call metadata%set('latitude', labels%value_of('Station Lat.'))
      call metadata%set('longitude', labels%value_of('Station Long.'))
   end subroutine add_metadata

end module dondolo_record_format_knet
