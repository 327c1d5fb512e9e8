!> Files of the archives ITACA and ESM (DYNA 1.0 to 1.2, ITACA 1.x): lines `KEY: value`, then one value a line.
!>
!> Values of keys may be empty. Dates may be 19971014, 1997/10/14 or 14/10/1997.
module dondolo_records_format_dyna
   use dondolo_base_error, only : error_type
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : lower
   use dondolo_files_text_file, only : text_file_type
   use dondolo_records_event_name, only : clean_event
   use dondolo_records_header_fields, only : field_type, header_type
   use dondolo_records_labels, only : labels_type, read_labels
   use dondolo_records_format, only : check_duration, raise_at, read_block, samples_type
   implicit none
   private

   public :: recognises_dyna, read_dyna

   !> Key of the largest value, in the units it names
   character(len=*), parameter :: peak_key = 'PGA_CM/S^2'

   !> What the header says. ITACA 1.x does not state the processing: its type of data tells whether the values were processed
   type(field_type), parameter :: fields(15) = [ &
      & field_type('date', 'EVENT_DATE_YYYYMMDD', 'dmy', clock='EVENT_TIME_HHMMSS'), &
      & field_type('event latitude', 'EVENT_LATITUDE_DEGREE'), field_type('event longitude', 'EVENT_LONGITUDE_DEGREE'), &
      & field_type('network', 'NETWORK'), &
      & field_type('station', 'STATION_NAME'), field_type('station', 'STATION_CODE'), &
      & field_type('component', 'COMPONENT'), field_type('component', 'STREAM'), &
      & field_type('magnitude', 'MAGNITUDE_S'), field_type('magnitude', 'MAGNITUDE_L'), field_type('magnitude', 'MAGNITUDE_W'), &
      & field_type('latitude', 'STATION_LATITUDE_DEGREE'), field_type('longitude', 'STATION_LONGITUDE_DEGREE'), &
      & field_type('processing', 'DATA_TYPE'), field_type('processing', 'PROCESSING')]

contains

   !> Is a text in this format? It begins with lines `KEY: value`, among them the sampling interval
   logical function recognises_dyna(text) result(recognised)
      type(text_file_type), intent(in) :: text

      type(labels_type) :: labels

      call read_labels(text, 1, header_lines(text), labels)
      recognised = labels%line_of('SAMPLING_INTERVAL_S') > 0
   end function recognises_dyna

   !> Read a DYNA file
   subroutine read_dyna(text, samples, error)
      type(text_file_type), intent(in) :: text
      !> What it says
      type(samples_type), intent(out) :: samples
      !> What is wrong, with file and line
      type(error_type), allocatable, intent(out) :: error

      type(header_type) :: header
      character(len=:), allocatable :: event
      integer :: count

      call read_labels(text, 1, header_lines(text), header%labels)
      call check_quantity(text, header%labels, error)
      if (allocated(error)) return
      allocate (samples%channels(1))
      associate (channel => samples%channels(1), labels => header%labels)
         call labels%get_positive(text, 'SAMPLING_INTERVAL_S', channel%dt, error)
         if (.not. allocated(error)) call labels%get_count(text, 'NDATA', count, error)
         if (allocated(error)) return
         channel%units = labels%value_of('UNITS')
         channel%peak = labels%value_of(peak_key)
         channel%peak_units = 'cm/s2'
         channel%peak_line = labels%line_of(peak_key)
         call read_block(text, header_lines(text) + 1, count, channel%values, error, samples%metadata)
         if (.not. allocated(error)) call check_duration(text, max(labels%line_of('DURATION_S'), 1), &
            & labels%value_of('DURATION_S'), channel, error)
         call name_event(labels%value_of('EVENT_NAME'), labels%value_of('EVENT_ID'), event)
         call samples%metadata%set('event', event)
         call header%keep(text, fields, samples%metadata)
         call labels%add_to(samples%metadata)
         channel%name = samples%metadata%get('component')
      end associate
   end subroutine read_dyna

   !> The values must be accelerations
   subroutine check_quantity(text, labels, error)
      type(text_file_type), intent(in) :: text
      type(labels_type), intent(in) :: labels
      !> They are something else, or the file does not say
      type(error_type), allocatable, intent(out) :: error

      select case (lower(labels%value_of('DATA_TYPE')))
      case ('acceleration', 'corrected acceleration', 'unprocessed acceleration')
      case default
         call raise_at(error, text, max(labels%line_of('DATA_TYPE'), 1), 'DATA_TYPE = '''// &
            & shown(labels%value_of('DATA_TYPE'))//''': must be ACCELERATION')
      end select
   end subroutine check_quantity

   !> Earthquake: its name and identifier, since names are often those of regions, in which there are many
   pure subroutine name_event(name, identifier, event)
      !> Name
      character(len=*), intent(in) :: name
      !> Identifier
      character(len=*), intent(in) :: identifier
      !> Earthquake; empty if neither is known
      character(len=:), allocatable, intent(out) :: event

      character(len=:), allocatable :: code

      call clean_event(name, event)
      call clean_event(identifier, code)
      if (len(event) > 0 .and. len(code) > 0) event = event//' '
      event = event//code
   end subroutine name_event

   !> Number of lines `KEY: value` at the top
   pure function header_lines(text) result(count)
      type(text_file_type), intent(in) :: text
      !> Number of lines before the first that holds no colon
      integer :: count

      do count = 0, text%lines() - 1
         if (index(text%text(text%first(count + 1):text%last(count + 1)), ':') == 0) exit
      end do
   end function header_lines

end module dondolo_records_format_dyna
