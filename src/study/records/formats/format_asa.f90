!> Standard accelerograms of Mexico (ASA 2.0): lines `KEY : value` in Spanish, then one row a sample, one column of 10
!> characters a channel.
module dondolo_records_format_asa
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_integer, parse_real
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : first_word, to_text
   use dondolo_files_text_file, only : text_file_type
   use dondolo_record_metadata, only : metadata_type
   use dondolo_records_header_fields, only : field_type, header_type
   use dondolo_records_header_text, only : after
   use dondolo_records_labels, only : labels_type, read_labels
   use dondolo_records_format, only : block_type, channel_type, check_duration, most_extra, note_extra, raise_at, read_fixed, &
      & samples_type, step_tolerance
   implicit none
   private

   public :: recognises_asa, read_asa

   !> Characters of a column
   integer, parameter :: width = 10

   !> Channels that the header has places for
   integer, parameter :: most_channels = 12

   !> What the header says
   type(field_type), parameter :: fields(2) = [ &
      & field_type('date', 'FECHA DEL SISMO [GMT]', 'dmy', clock='HORA EPICENTRO (GMT)', zone='Z'), &
      & field_type('station', 'CLAVE DE LA ESTACION')]

   !> Line that says what the file is
   character(len=*), parameter :: kind = 'ARCHIVO ESTANDAR DE ACELERACION'

   !> Line before the values
   character(len=*), parameter :: data_title = 'DATOS DE ACELERACION'

contains

   !> Is a text in this format? It says so
   logical function recognises_asa(text) result(recognised)
      type(text_file_type), intent(in) :: text

      recognised = line_with(text, 1, 20, kind) > 0
   end function recognises_asa

   !> Read a file
   subroutine read_asa(text, samples, error)
      type(text_file_type), intent(in) :: text
      !> What it says
      type(samples_type), intent(out) :: samples
      !> What is wrong, with file and line
      type(error_type), allocatable, intent(out) :: error

      type(header_type) :: header
      real(wp), allocatable :: values(:)
      integer :: title, begin, channels, rows, stated, i

      title = line_with(text, 1, text%lines(), data_title)
      ! Two rulers stand around the numbers and the names of the channels
      begin = line_with(text, line_with(text, title + 1, title + 6, '----') + 1, title + 6, '----') + 1
      if (title == 0 .or. begin == 1) then
         call raise_at(error, text, text%lines(), 'no line '//data_title//', or no two rulers after it')
         return
      end if
      call read_labels(text, line_with(text, 1, title, kind) + 1, title - 1, header%labels)
      call header%labels%get_count(text, 'NUMERO DE CANALES', channels, error)
      if (allocated(error)) return
      if (channels > most_channels) then
         call raise_at(error, text, header%labels%line_of('NUMERO DE CANALES'), 'NUMERO DE CANALES = '//to_text(channels)// &
            & ': must be at most '//to_text(most_channels))
         return
      end if
      rows = text%lines() - begin + 1
      stated = number_of(header%labels, 1)
      do i = 1, channels
         ! Some files hold the samples at both ends of the duration, one more than they state, or two
         if (rows >= stated .and. rows <= stated + most_extra .and. number_of(header%labels, i) == stated) cycle
         call raise_at(error, text, text%lines(), to_text(rows)//' rows of values: the header states '// &
            & to_text(number_of(header%labels, i)))
         return
      end do
      call read_fixed(text, block_type(begin, channels*stated, width, channels), values, error)
      if (allocated(error)) return
      call note_extra(rows - stated, stated, samples%metadata)
      allocate (samples%channels(channels))
      do i = 1, channels
         associate (channel => samples%channels(i))
            channel%values = values(i::channels)
            call read_channel(text, header%labels, i, channel, error)
            if (allocated(error)) return
            channel%units = first_word(header%labels%value_of('UNIDADES DE LOS DATOS'), ' ')
            channel%peak_units = 'gal'
            channel%peak_line = max(header%labels%line_of('ACEL. MAX.(Gal), C1-C6'), 1)
            call channel%metadata%set('component', channel%name)
         end associate
      end do
      call add_metadata(text, header, samples%metadata)
   end subroutine read_asa

   !> What the header says of a channel
   subroutine read_channel(text, labels, number, channel, error)
      type(text_file_type), intent(in) :: text
      type(labels_type), intent(in) :: labels
      !> Number of the channel
      integer, intent(in) :: number
      !> The channel, with its values
      type(channel_type), intent(inout) :: channel
      !> Its step is missing, or contradicts rate or duration
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: key, value
      real(wp) :: frequency
      logical :: ok, has_rate

      call find_value(labels, 'ORIENTACION C', ' (rumbo;orientacion)', number, channel%name)
      call find_value(labels, 'ACEL. MAX.(Gal), C', '', number, channel%peak)
      call find_value(labels, 'VEL. DE MUESTREO, C', ' (muestras/s)', number, value)
      call parse_real(value, frequency, has_rate)
      has_rate = has_rate .and. frequency > 0.0_wp
      call find_value(labels, 'INTERVALO DE MUESTREO, C', ' (s)', number, value, key)
      call parse_real(value, channel%dt, ok)
      ! The rate serves where no interval is stated
      if (len(value) == 0 .and. has_rate) then
         channel%dt = 1.0_wp/frequency
         ok = .true.
      end if
      if (.not. (ok .and. channel%dt > 0.0_wp)) then
         call raise_at(error, text, max(labels%line_of(key), 1), key//' = '''//shown(labels%value_of(key))// &
            & ''': must be a positive number for channel '//to_text(number))
         return
      end if
      if (has_rate .and. abs(channel%dt*frequency - 1.0_wp) > step_tolerance) then
         call raise_at(error, text, max(labels%line_of(key), 1), key//' = '//to_text(channel%dt)// &
            & ': the header states a rate of '//to_text(frequency)//' samples per second')
         return
      end if
      call find_value(labels, 'DURACION DEL REGISTRO (s), C', '', number, value, key)
      call check_duration(text, max(labels%line_of(key), 1), value, channel, error)
   end subroutine read_channel

   !> Number of samples that the header states for a channel, 0 if none
   function number_of(labels, number) result(count)
      type(labels_type), intent(in) :: labels
      !> Number of the channel
      integer, intent(in) :: number
      !> Number of samples
      integer :: count

      character(len=:), allocatable :: value
      logical :: ok

      call find_value(labels, 'NUM. TOTAL DE MUESTRAS, C', '', number, value)
      call parse_integer(value, count, ok)
   end function number_of

   !> Find the value for one channel in a line such as `/2455/2455/2455`
   pure subroutine find_value(labels, start, rest, number, value, key)
      type(labels_type), intent(in) :: labels
      !> The key of its line: what is before the channels and what is after them
      character(len=*), intent(in) :: start, rest
      !> Number of the channel
      integer, intent(in) :: number
      !> Its value, empty if there is none
      character(len=:), allocatable, intent(out) :: value
      !> The key
      character(len=:), allocatable, intent(out), optional :: key

      character(len=*), parameter :: channels(2) = [character(len=5) :: '1-C6', '7-C12']
      character(len=:), allocatable :: name
      integer :: i

      name = start//trim(channels(merge(1, 2, number <= 6)))//rest
      value = labels%value_of(name)//'/'
      do i = 1, modulo(number - 1, 6) + 1
         value = value(index(value, '/') + 1:)
      end do
      value = trim(adjustl(value(:index(value, '/') - 1)))
      if (present(key)) key = name
   end subroutine find_value

   !> What the header says
   subroutine add_metadata(text, header, metadata)
      type(text_file_type), intent(in) :: text
      type(header_type), intent(in) :: header
      !> What it says
      type(metadata_type), intent(inout) :: metadata

      character(len=:), allocatable :: key
      integer :: i

      call header%keep(text, fields, metadata)
      associate (labels => header%labels)
         ! /Mb=5.30/Ms=4.80: the first
         call metadata%set('magnitude', first_word(after(labels%value_of('MAGNITUD(ES)'), '='), '/ '))
         key = ''
         do i = 1, size(labels%labels)
            associate (label => labels%labels(i))
               if (label%key == 'COORDENADAS DE LA ESTACION' .and. i < size(labels%labels)) then
                  call metadata%set('latitude', coordinate(label%value))
                  call metadata%set('longitude', coordinate(labels%labels(i + 1)%value))
               else if (label%key == 'COORDENADAS DEL EPICENTRO' .and. i < size(labels%labels)) then
                  call metadata%set('event latitude', coordinate(label%value))
                  call metadata%set('event longitude', coordinate(labels%labels(i + 1)%value))
               end if
               if (len(label%key) == 0) then
                  call metadata%set(key, metadata%get(key)//' '//label%value)
               else
                  key = label%key
                  call metadata%set(key, label%value)
               end if
            end associate
         end do
      end associate
   end subroutine add_metadata

   !> A coordinate in degrees, north and east positive: `99.85157 LONG. W`
   pure function coordinate(stated) result(degrees)
      !> What the header states
      character(len=*), intent(in) :: stated
      !> The number with its sign, or what is stated if it is not written so; filled up with blanks
      character(len=len(stated) + 1) :: degrees

      real(wp) :: value
      integer :: side
      logical :: ok

      degrees = first_word(stated, ' ')
      side = len_trim(stated)
      call parse_real(degrees, value, ok)
      if (.not. ok .or. index(stated, 'L') == 0) then
         degrees = stated
      else if (scan(stated(side:side), 'SW') > 0) then
         degrees = '-'//trim(degrees)
      end if
   end function coordinate

   !> First line that holds a text
   pure function line_with(text, from, to, part) result(line)
      type(text_file_type), intent(in) :: text
      !> First line to look at
      integer, intent(in) :: from
      !> Last line to look at
      integer, intent(in) :: to
      !> The text
      character(len=*), intent(in) :: part
      !> Number of the line, 0 if there is none
      integer :: line

      do line = max(from, 1), min(to, text%lines())
         if (index(text%text(text%first(line):text%last(line)), part) > 0) return
      end do
      line = 0
   end function line_with

end module dondolo_records_format_asa
