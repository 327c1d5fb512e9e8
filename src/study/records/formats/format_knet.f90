!> Files of the Japanese networks K-NET and KiK-net: 17 lines of header with keys of 18 characters, then counts of the
!> recorder, which its scale factor turns into gal.
!>
!> The counts hold the offset of the instrument, so their mean is removed, which the metadata say. Times are those of
!> Japan. (National Research Institute for Earth Science and Disaster Resilience, format of the ASCII files.)
module dondolo_records_format_knet
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_real
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : to_text
   use dondolo_files_text_file, only : text_file_type
   use dondolo_records_header_fields, only : field_type, header_type
   use dondolo_records_labels, only : labels_type, read_labels
   use dondolo_records_format, only : raise_at, read_block, samples_type
   implicit none
   private

   public :: recognises_knet, read_knet, knet_fields

   !> Lines of the header
   integer, parameter :: header_lines = 17

   !> Characters of a key
   integer, parameter :: key_width = 18

   !> What the header says, in tables (dondolo_records_format_nied) too
   type(field_type), parameter :: knet_fields(8) = [ &
      & field_type('date', 'Origin Time', 'dmy', zone='+09:00'), &
      & field_type('event latitude', 'Lat.'), field_type('event longitude', 'Long.'), &
      & field_type('station', 'Station Code'), &
      & field_type('component', 'Dir.'), &
      & field_type('magnitude', 'Mag.'), &
      & field_type('latitude', 'Station Lat.'), field_type('longitude', 'Station Long.')]

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

      type(header_type) :: header
      real(wp) :: frequency, duration, factor, mean
      integer :: direction

      call read_labels(text, 1, min(header_lines, text%lines()), header%labels, key_width)
      call header%labels%get_positive(text, 'Sampling Freq(Hz)', frequency, error, 'Hz')
      if (.not. allocated(error)) call header%labels%get_positive(text, 'Duration Time(s)', duration, error)
      if (.not. allocated(error)) call get_factor(text, header%labels, factor, error)
      if (allocated(error)) return
      if (frequency*duration > real(len(text%text), wp)) then
         call raise_at(error, text, max(header%labels%line_of('Duration Time(s)'), 1), 'Duration Time(s) = '// &
            & to_text(duration)//': the file is too short for it')
         return
      end if
      allocate (samples%channels(1))
      associate (channel => samples%channels(1), labels => header%labels)
         call read_block(text, header_lines + 1, nint(frequency*duration), channel%values, error, samples%metadata)
         if (allocated(error)) return
         mean = sum(channel%values)/real(max(size(channel%values), 1), wp)
         channel%values = factor*(channel%values - mean)
         channel%dt = 1.0_wp/frequency
         channel%units = 'gal'
         channel%name = labels%value_of('Dir.')
         direction = index('123456', channel%name)
         if (len(channel%name) == 1 .and. direction > 0) channel%name = directions(direction)
         channel%peak = labels%value_of('Max. Acc. (gal)')
         channel%peak_line = max(labels%line_of('Max. Acc. (gal)'), 1)
         call header%keep(text, knet_fields, samples%metadata)
         call samples%metadata%set('component', channel%name)
         call samples%metadata%set('processing', 'mean of '//to_text(anint(mean))//' counts removed')
      end associate
      call header%labels%add_to(samples%metadata)
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

end module dondolo_records_format_knet
