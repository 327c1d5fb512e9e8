!> Volume 2 files of the California Strong Motion Instrumentation Program (.V2): for each channel 25 lines of text,
!> tables of 100 integers and 100 reals, then accelerations, velocities and displacements, each after a line that
!> states count, step and units.
!>
!> Source: Shakal and Huang (1985), Standard tape format for CSMIP strong-motion data tapes, report OSMS 85-03. Later
!> files state the Fortran format as well: `in cm/sec2. (8f10.6)`.
module dondolo_records_format_csmip
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_integer, parse_real
   use dondolo_base_text, only : first_word, lower, to_text
   use dondolo_files_text_file, only : text_file_type
   use dondolo_record_metadata, only : metadata_type
   use dondolo_records_dates, only : find_moment
   use dondolo_records_days, only : find_short_moment
   use dondolo_records_header_fields, only : field_type, header_type
   use dondolo_records_header_text, only : after, before, leading_number, parse_format, squeezed
   use dondolo_records_format, only : block_type, channel_type, check_duration, raise_at, read_fixed, samples_type
   implicit none
   private

   public :: recognises_csmip, read_csmip

   !> Beginning of a channel
   character(len=*), parameter :: title = 'corrected accelerogram'

   !> What the line before the accelerations says
   character(len=*), parameter :: announcement = 'points of accel data equally spaced at'

   !> Lines of text at the beginning of a channel
   integer, parameter :: text_lines = 25

   !> Name of the earthquake: in the third line, or else before two blanks in the ninth
   type(field_type), parameter :: events(2) = [ &
      & field_type('event', form='as is', line=9, until='__'), field_type('event', line=3)]

   !> What the header says of the station
   type(field_type), parameter :: sites(3) = [ &
      & field_type('station name', line=7), &
      & field_type('component', ':', line=8, until='location'), &
      & field_type('location', 'location:', 'as is', line=8)]

   !> All other fields; the moment magnitude is the last one
   type(field_type), parameter :: others(14) = [ &
      & field_type('magnitude', 'hypocenter', 'number', then='mb='), field_type('magnitude', 'hypocenter', 'number', then='ms='), &
      & field_type('magnitude', 'hypocenter', 'number', then='ml='), field_type('magnitude', 'hypocenter', 'number', then='mw='), &
      & field_type('processing', 'filtered', lead='corrected; filtered'), &
      & field_type('processed', 'processed:'), &
      & field_type('record', line=5), &
      & field_type('time', line=4), &
      & field_type('hypocenter', 'hypocenter'), &
      & field_type('instr period', 'instr period ='), &
      & field_type('record length', 'record length ='), &
      & field_type('uncor max', 'uncor max ='), &
      & field_type('rms accel', 'rms accel of (uncor) record ='), &
      & field_type('initial velocity', 'initial velocity =')]

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
      call read_fixed(text, block_type(begin + 1, count, width, per_line), channel%values, error, next, channel%metadata)
      if (allocated(error)) return
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

      type(header_type) :: header
      character(len=:), allocatable :: line, rest

      channel%peak_line = line_with(text, first, last, 'peak acceleration')
      if (channel%peak_line > 0) then
         line = after(text%line(channel%peak_line), '=')
         channel%peak = leading_number(line)
         channel%peak_units = before(after(line, channel%peak), ' at')
      end if
      header = header_type(first_line=first, last_line=last)
      associate (metadata => channel%metadata)
         call header%keep(text, events, metadata)
         call find_origin(text%line(first + 3), line)
         call metadata%set('event time', line)
         if (len(line) == 0) call find_day(line)
         call metadata%set('date', line)
         call header%find(text, field_type(label='station no.'), rest)
         line = before(rest, ' ')
         call metadata%set('station', line)
         call read_place(after(rest, line), '', metadata)
         call header%keep(text, sites, metadata)
         channel%name = metadata%get('component')
         call header%find(text, field_type(label='hypocenter', then=':'), rest)
         call read_place(rest, 'event ', metadata)
         call header%keep(text, others, metadata)
      end associate

   contains

      !> Find the day of the earthquake where its origin is not stated: by its local time, else that on which the record begins.
      !> Of a year of two digits the century is that since 1933, from which the first accelerograms are
      subroutine find_day(day)
         !> The day, or the local time as it is written; empty if neither is stated
         character(len=:), allocatable, intent(out) :: day

         character(len=*), parameter :: starts(7) = [character(len=16) :: 'rcrd of', 'record of', 'start time:', 'start date:', &
            & 'trigger time:', 'trig time:', 'recording start:']
         character(len=:), allocatable :: moment
         integer :: i

         day = squeezed(before(text%line(first + 3), '(origin'))
         call find_moment(day, 'mdy', moment)
         if (len(moment) > 0) return
         do i = 1, size(starts)
            call header%find(text, field_type(label=starts(i)), rest)
            call find_moment(rest, 'mdy', moment)
            if (len(moment) == 0) call find_short_moment(rest, 'mdy', moment)
            if (len(moment) == 0) cycle
            day = moment(:10)
            return
         end do
         ! That of the processing is another one
         do i = first, last
            if (index('  '//lower(text%line(i)), '  date:') == 0) cycle
            call find_moment(squeezed(after('  '//text%line(i), '  date:')), 'mdy', moment)
            if (len(moment) > 0) day = moment(:10)
         end do
      end subroutine find_day

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

end module dondolo_records_format_csmip
