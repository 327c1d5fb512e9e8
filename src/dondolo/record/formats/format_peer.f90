!> PEER strong motion files (.AT2): three lines of text, a line with count and time step, then the values.
!>
!> The second line names event, date, station and component, between commas, and a station may hold commas too. In
!> older files event and date stand together. The fourth line reads `NPTS=   7999, DT=   .0050 SEC,` or, in older
!> files, `7999    .0050    NPTS, DT`.
module dondolo_format_peer
   use dondolo_dates, only : iso_date
   use dondolo_error, only : error_type
   use dondolo_kinds, only : wp
   use dondolo_metadata, only : metadata_type
   use dondolo_numbers, only : parse_integer, parse_real
   use dondolo_plain, only : shown
   use dondolo_record_format, only : raise_at, read_block, samples_type
   use dondolo_text, only : first_word, lower
   use dondolo_text_file, only : text_file_type
   implicit none
   private

   public :: recognises_peer, read_peer

   !> Line that states event, date, station and component
   integer, parameter :: event_line = 2

   !> Line that states quantity and units
   integer, parameter :: quantity_line = 3

   !> Line that states count and time step
   integer, parameter :: count_line = 4

contains

   !> Is a text in this format? The third line states units and the fourth count and step
   logical function recognises_peer(text) result(recognised)
      type(text_file_type), intent(in) :: text

      recognised = index(lower(text%line(quantity_line)), 'in units of') > 0 .and. &
         & index(lower(text%line(count_line)), 'npts') > 0 .and. index(lower(text%line(count_line)), 'dt') > 0
   end function recognises_peer

   !> Read a PEER file
   subroutine read_peer(text, samples, error)
      type(text_file_type), intent(in) :: text
      !> What it says
      type(samples_type), intent(out) :: samples
      !> What is wrong, with file and line
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: line, note
      integer :: count, at
      logical :: ok

      allocate (samples%channels(1))
      line = adjustl(lower(text%line(quantity_line)))
      if (index(line, 'acceleration') /= 1) then
         call raise_at(error, text, quantity_line, ''''//shown(trim(text%line(quantity_line)))// &
            & ''': must be ACCELERATION TIME SERIES IN UNITS OF ...')
         return
      end if
      at = index(line, 'in units of') + len('in units of')
      samples%channels(1)%units = first_word(line(at:), ' ,.;()')
      call read_count(lower(text%line(count_line)), count, samples%channels(1)%dt, ok)
      if (.not. ok) then
         call raise_at(error, text, count_line, ''''//shown(trim(text%line(count_line)))// &
            & ''': must be NPTS= count, DT= step SEC, both positive')
         return
      end if
      call read_block(text, count_line + 1, count, samples%channels(1)%values, error, note)
      call samples%metadata%append('reading', note)
      call add_metadata(text%line(event_line), samples%metadata)
      call samples%metadata%set('title', text%line(1))
      line = text%line(quantity_line)
      at = at - 1 + index(lower(line(at:)), samples%channels(1)%units) + len(samples%channels(1)%units)
      call samples%metadata%set('processing', first_sentence(line(min(at, len(line) + 1):)))
   end subroutine read_peer

   !> What the second line says
   subroutine add_metadata(line, metadata)
      !> The line
      character(len=*), intent(in) :: line
      !> What it says
      type(metadata_type), intent(inout) :: metadata

      character(len=:), allocatable :: rest, word, date, time
      integer :: at, comma, last

      call metadata%set('description', line)
      ! The date is the first word with two strokes; a year of two digits is one of the 1900s
      rest = line
      at = 1
      do
         word = first_word(rest, ' ,')
         if (len(word) == 0) return
         at = at + index(rest, word) - 1
         date = word
         if (len(date) > 3) then
            if (date(len(date) - 2:len(date) - 2) == '/') date = date(:len(date) - 2)//'19'//date(len(date) - 1:)
         end if
         date = trim(iso_date(date, 'mdy'))
         if (index(word, '/') > 0 .and. index(date, '/') == 0) exit
         rest = rest(index(rest, word) + len(word):)
         at = at + len(word)
      end do
      rest = trim(line(:at - 1))
      if (len(rest) > 0) then
         if (rest(len(rest):) == ',') rest = rest(:len(rest) - 1)
      end if
      call metadata%set('event', rest)
      rest = line(at + len(word):)
      comma = index(rest, ',')
      if (comma == 0) comma = len(rest) + 1
      time = trim(adjustl(rest(:comma - 1)))
      if (len(time) == 4 .and. verify(time, '0123456789') == 0) date = date//'T'//time(:2)//':'//time(3:)
      if (len(time) == 5 .and. index(time, ':') == 3 .and. verify(time, '0123456789:') == 0) date = date//'T'//time
      call metadata%set('date', date)
      last = index(rest, ',', back=.true.)
      if (last <= comma) return
      call metadata%set('station', rest(comma + 1:last - 1))
      ! After the component older files name the station again, in brackets
      call metadata%set('component', first_word(rest(last + 1:), ' ('))
   end subroutine add_metadata

   !> A text without the punctuation before it
   pure function first_sentence(text) result(sentence)
      !> Text
      character(len=*), intent(in) :: text
      !> The same from the first letter or digit on, filled up with blanks
      character(len=len(text)) :: sentence

      integer :: first

      first = verify(text, ' .,;:)'//achar(9))
      sentence = ''
      if (first > 0) sentence = text(first:)
   end function first_sentence

   !> Find count and time step in the fourth line
   subroutine read_count(line, count, dt, ok)
      !> The line, in lower case
      character(len=*), intent(in) :: line
      !> Number of values
      integer, intent(out) :: count
      !> Time step [s]
      real(wp), intent(out) :: dt
      !> Both were found and are positive
      logical, intent(out) :: ok

      character(len=*), parameter :: separators = ' ,='//achar(9)
      character(len=:), allocatable :: number, rest
      integer :: at

      number = first_word(line, separators)
      call parse_integer(number, count, ok)
      if (ok) then
         rest = line(index(line, number) + len(number):)
      else
         call parse_integer(first_word(line(index(line, 'npts') + len('npts'):), separators), count, ok)
         rest = line(index(line, 'dt') + len('dt'):)
      end if
      ok = ok .and. count > 0
      dt = 0.0_wp
      if (.not. ok) return
      number = first_word(rest, separators)
      at = index(number, 'sec')
      if (at > 0) number = number(:at - 1)
      call parse_real(number, dt, ok)
      ok = ok .and. dt > 0.0_wp
   end subroutine read_count

end module dondolo_format_peer
