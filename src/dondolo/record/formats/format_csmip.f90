!> Volume 2 files of the California Strong Motion Instrumentation Program (.V2): for each channel 25 lines of text,
!> tables of 100 integers and 100 reals, then accelerations, velocities and displacements, each after a line that
!> states count, step and units.
!>
!> Source: Shakal and Huang (1985), Standard tape format for CSMIP strong-motion data tapes, report OSMS 85-03. Later
!> files state the Fortran format as well: `in cm/sec2. (8f10.6)`.
module dondolo_record_format_csmip
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_integer, parse_real
   use dondolo_base_text, only : first_word, lower, to_text
   use dondolo_base_text_file, only : text_file_type
   use dondolo_record_dates, only : find_moment
   use dondolo_record_format, only : after_block_type, channel_type, check_duration, raise_at, read_fixed, samples_type
   use dondolo_record_header_text, only : after, before, leading_number, parse_format, squeezed
   use dondolo_record_metadata, only : metadata_type
   implicit none
   private

   public :: recognises_csmip, read_csmip

   !> Beginning of a channel
   character(len=*), parameter :: title = 'corrected accelerogram'

   !> What the line before the accelerations says
   character(len=*), parameter :: announcement = 'points of accel data equally spaced at'

   !> Lines of text at the beginning of a channel
   integer, parameter :: text_lines = 25

   !> Format of the values where the file does not state it: 8F10.3
   integer, parameter :: usual_width = 10, usual_per_line = 8

contains

   !> Is a text in this format? It begins with corrected and uncorrected accelerogram
   logical function recognises_csmip(text) result(recognised)
      type(text_file_type), intent(in) :: text

      recognised = is_title(text, 1) .and. index(lower(adjustl(text%line(2))), 'uncorrected accelerogram') == 1
   end function recognises_csmip

   !> Read a CSMIP file
   subroutine read_csmip(text, samples, error)
      type(text_file_type), intent(in) :: text
      !> What it says
      type(samples_type), intent(out) :: samples
      !> What is wrong, with file and line
      type(error_type), allocatable, intent(out) :: error

      integer :: i, line
      integer, allocatable :: begins(:)

      begins = pack([(line, line=1, text%lines())], [(is_title(text, line), line=1, text%lines())])
      allocate (samples%channels(size(begins)))
      begins = [begins, text%lines() + 1]
      do i = 1, size(samples%channels)
         call read_channel(text, begins(i), begins(i + 1) - 1, samples%channels(i), error)
         if (allocated(error)) return
      end do
      if (size(samples%channels) > 0) return
      call raise_at(error, text, 1, ''''//squeezed(text%line(1))//''': must be CORRECTED ACCELEROGRAM')
   end subroutine read_csmip

   !> Does a channel begin in a line?
   pure function is_title(text, line)
      type(text_file_type), intent(in) :: text
      !> Number of the line
      integer, intent(in) :: line
      !> It begins with the title
      logical :: is_title

      is_title = index(lower(adjustl(text%line(line))), title) == 1
   end function is_title

   !> Read a channel
   subroutine read_channel(text, first, last, channel, error)
      type(text_file_type), intent(in) :: text
      !> Its first line
      integer, intent(in) :: first
      !> Its last line
      integer, intent(in) :: last
      type(channel_type), intent(out) :: channel
      !> What is wrong, with file and line
      type(error_type), allocatable, intent(out) :: error

      type(after_block_type) :: rest
      integer :: begin, block, next, count, width, per_line
      real(wp) :: dt
      character(len=:), allocatable :: units

      begin = line_with(text, first, last, announcement)
      if (begin == 0) then
         call raise_at(error, text, first, 'no line POINTS OF ACCEL DATA EQUALLY SPACED AT ... for this channel')
         return
      end if
      call read_announcement(text, begin, count, channel%dt, channel%units, width, per_line, error)
      if (allocated(error)) return
      call read_fixed(text, begin + 1, count, width, per_line, channel%values, error, rest)
      if (allocated(error)) return
      next = rest%line
      call channel%metadata%append('reading', rest%note)
      if (next > last) then
         call raise_at(error, text, last, 'the channel ends with its accelerations: velocities must follow')
         return
      end if
      ! Velocities and displacements are skipped, but they must be there: else the file is cut off
      do while (is_skipped(text%line(next)))
         block = next
         call read_announcement(text, block, count, dt, units, width, per_line, error)
         if (allocated(error)) return
         if ((count - 1)/per_line >= last - block) then
            call raise_at(error, text, last, 'the channel ends within the '//to_text(count)// &
               & ' values that line '//to_text(block)//' states')
            return
         end if
         next = block + (count - 1)/per_line + 2
      end do
      if (next <= last .and. index(text%line(next), '/&') /= 1) then
         call raise_at(error, text, next, 'after the '//to_text(count)//' values that the header states: '// &
            & 'must be the next values or the end of the channel')
         return
      end if
      call read_header(text, first, min(first + text_lines, begin) - 1, channel)
      call check_duration(text, max(line_with(text, first, begin, 'record length'), first), &
         & leading_number(channel%metadata%get('record length')), channel, error)
   end subroutine read_channel

   !> Does a line announce velocities or displacements?
   pure function is_skipped(line)
      !> The line
      character(len=*), intent(in) :: line
      !> It does
      logical :: is_skipped

      is_skipped = index(lower(line), 'points of veloc data') > 0 .or. index(lower(line), 'points of displ data') > 0
   end function is_skipped

   !> Read a line before values
   subroutine read_announcement(text, begin, count, dt, units, width, per_line, error)
      type(text_file_type), intent(in) :: text
      !> Number of the line
      integer, intent(in) :: begin
      !> Number of values
      integer, intent(out) :: count
      !> Time step [s]
      real(wp), intent(out) :: dt
      !> Units
      character(len=:), allocatable, intent(out) :: units
      !> Characters of a value
      integer, intent(out) :: width
      !> Values in a line
      integer, intent(out) :: per_line
      !> The line does not say what it must
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: line, rest, format
      logical :: ok, positive

      line = text%line(begin)
      rest = after(line, 'equally spaced at')
      call parse_integer(before(line, 'points'), count, ok)
      call parse_real(leading_number(rest), dt, positive)
      if (.not. (ok .and. count > 0 .and. positive .and. dt > 0.0_wp)) then
         call raise_at(error, text, begin, ''''//squeezed(line)//''': must begin with count and step, both positive')
         return
      end if
      width = usual_width
      per_line = usual_per_line
      if (index(lower(rest), '(units:') > 0) then
         units = before(after(rest, '(units:'), ')')
         return
      end if
      units = before(before(after(rest, ' in '), '('), '.')
      format = after(rest, '(')
      if (len(format) == 0) return
      call parse_format('('//format, width, per_line, ok)
      if (ok) return
      call raise_at(error, text, begin, 'format ''('//format//''': must be a Fortran format such as (8F10.3)')
   end subroutine read_announcement

   !> Keep what the text lines of a channel say
   subroutine read_header(text, first, last, channel)
      type(text_file_type), intent(in) :: text
      !> First line of the channel
      integer, intent(in) :: first
      !> Last of its text lines
      integer, intent(in) :: last
      type(channel_type), intent(inout) :: channel

      character(len=:), allocatable :: line, rest

      channel%name = squeezed(before(after(text%line(first + 7), ':'), 'location'))
      channel%peak_line = line_with(text, first, last, 'peak acceleration')
      if (channel%peak_line > 0) then
         line = after(text%line(channel%peak_line), '=')
         channel%peak = leading_number(line)
         channel%peak_units = before(after(line, channel%peak), ' at')
      end if
      associate (metadata => channel%metadata)
         line = squeezed(text%line(first + 2))
         if (len(line) == 0) line = before(text%line(first + 8), '  ')
         call metadata%set('event', line)
         call find_origin(text%line(first + 3), line)
         call metadata%set('event time', line)
         if (len(line) == 0) line = squeezed(before(text%line(first + 3), '(origin'))
         call metadata%set('date', line)
         call find_rest('station no.')
         call read_station(rest, metadata)
         call metadata%set('station name', squeezed(text%line(first + 6)))
         call metadata%set('component', channel%name)
         call metadata%set('location', after(text%line(first + 7), 'location:'))
         call find_rest('hypocenter')
         call read_place(after(rest, ':'), 'event ', metadata)
         call read_magnitude(rest, metadata)
         call find_rest('filtered')
         call metadata%set('processing', 'corrected; filtered '//rest)
         call keep_rest('processed', 'processed:')
         call metadata%set('record', squeezed(text%line(first + 4)))
         call metadata%set('time', squeezed(text%line(first + 3)))
         call keep_rest('hypocenter', 'hypocenter')
         call keep_rest('instr period', 'instr period =')
         call keep_rest('record length', 'record length =')
         call keep_rest('uncor max', 'uncor max =')
         call keep_rest('rms accel', 'rms accel of (uncor) record =')
         call keep_rest('initial velocity', 'initial velocity =')
      end associate

   contains

      !> Find the text after a label in the first of the lines that holds it
      subroutine find_rest(label)
         !> Label in lower case
         character(len=*), intent(in) :: label

         integer :: at

         rest = ''
         do at = first, last
            if (len(rest) == 0) rest = after(squeezed(text%line(at)), label)
         end do
      end subroutine find_rest

      !> Keep the text after a label
      subroutine keep_rest(key, label)
         !> Key to keep it under, and label in lower case
         character(len=*), intent(in) :: key, label

         call find_rest(label)
         call channel%metadata%set(key, rest)
      end subroutine keep_rest

   end subroutine read_header

   !> Time of the earthquake: MAY 2, 1983 16:42 PDT     (ORIGIN(BRK): 05/02/83, 23:42:38.5 UTC)
   pure subroutine find_origin(line, origin)
      !> The line: local time, then the origin time, whose year has two digits
      character(len=*), intent(in) :: line
      !> The origin time; empty if the line does not state it
      character(len=:), allocatable, intent(out) :: origin

      character(len=:), allocatable :: date, year
      integer :: at

      origin = ''
      date = after(after(line, '(origin'), ':')
      at = index(date, '/', back=.true.)
      if (at == 0 .or. at + 2 > len(date)) return
      ! The local time has the whole year
      year = first_word(after(before(line, '(origin'), ','), ' ')
      if (len(year) /= 4 .or. year(max(len(year) - 1, 1):) /= date(at + 1:at + 2)) return
      call find_moment(date(:at)//year//date(at + 3:), 'mdy', origin)
   end subroutine find_origin

   !> Number and coordinates of a station: 36456   35.908N, 120.458W     SMA-1  S/N 4384
   subroutine read_station(line, metadata)
      !> What stands after the label
      character(len=*), intent(in) :: line
      !> Where to keep them
      type(metadata_type), intent(inout) :: metadata

      character(len=:), allocatable :: number

      if (len(line) == 0) return
      number = before(line, ' ')
      call metadata%set('station', number)
      call read_place(after(line, number), '', metadata)
   end subroutine read_station

   !> Coordinates of a place: 35.908N, 120.458W
   subroutine read_place(line, whose, metadata)
      !> They and what follows
      character(len=*), intent(in) :: line
      !> What stands before their keys
      character(len=*), intent(in) :: whose
      !> Where to keep them
      type(metadata_type), intent(inout) :: metadata

      character(len=:), allocatable :: number, rest
      integer :: i

      rest = line
      do i = 1, 2
         number = leading_number(rest)
         if (len(number) == 0) return
         rest = after(rest, number)
         if (index('sw', lower(rest(1:min(1, len(rest))))) > 0 .and. len(rest) > 0) number = '-'//number
         call metadata%set(whose//trim(merge('latitude ', 'longitude', i == 1)), number)
         rest = after(rest, ',')
      end do
   end subroutine read_place

   !> Magnitude, the moment magnitude first
   subroutine read_magnitude(line, metadata)
      !> Line of the hypocentre
      character(len=*), intent(in) :: line
      !> Where to keep it
      type(metadata_type), intent(inout) :: metadata

      character(len=*), parameter :: labels(4) = ['mb=', 'ms=', 'ml=', 'mw=']
      integer :: i

      do i = 1, size(labels)
         call metadata%set('magnitude', leading_number(after(line, labels(i))))
      end do
   end subroutine read_magnitude

   !> First line of a range that holds a text
   pure function line_with(text, first, last, part) result(line)
      type(text_file_type), intent(in) :: text
      !> First line of the range
      integer, intent(in) :: first
      !> Last line of the range
      integer, intent(in) :: last
      !> The text in lower case
      character(len=*), intent(in) :: part
      !> Number of the line, 0 if there is none
      integer :: line

      do line = first, min(last, text%lines())
         if (index(lower(text%line(line)), part) > 0) return
      end do
      line = 0
   end function line_with

end module dondolo_record_format_csmip
