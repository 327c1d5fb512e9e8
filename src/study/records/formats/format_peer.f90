!> PEER strong motion files (.AT2): three lines of text, a line with count and time step, then the values.
!>
!> The second line names event, date, station and component, between commas, and a station may hold commas too. In
!> older files event and date stand together. The fourth line reads `NPTS=   7999, DT=   .0050 SEC,` or, in older
!> files, `7999    .0050    NPTS, DT`.
module dondolo_records_format_peer
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_integer, parse_real
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : first_word, lower, occurrences
   use dondolo_files_text_file, only : text_file_type
   use dondolo_record_metadata, only : metadata_type
   use dondolo_records_dates, only : find_moment, take_moment
   use dondolo_records_format, only : raise_at, read_block, samples_type
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

      character(len=:), allocatable :: line
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
      call read_block(text, count_line + 1, count, samples%channels(1)%values, error, samples%metadata)
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

      character(len=*), parameter :: component_words(5) = [character(len=10) :: 'component', 'comp', 'componente', 'composante', &
         & 'komponente']
      character(len=:), allocatable :: rest, date, time, word
      integer :: first, next, comma, last

      call metadata%set('description', line)
      call find_date(line, first, next, date)
      if (first == 0) then
         ! Four parts are event, date, station and component, whatever stands for the date
         first = index(line, ',') + 1
         next = first - 1 + index(line(first:), ',')
         if (occurrences(line, ',') < 3) return
         date = line(first:next - 1)
      end if
      rest = trim(line(:first - 1))
      if (len(rest) > 0) then
         if (rest(len(rest):) == ',') rest = rest(:len(rest) - 1)
      end if
      call metadata%set('event', rest)
      rest = line(next:)
      comma = index(rest, ',')
      if (comma == 0) comma = len(rest) + 1
      time = trim(adjustl(rest(:comma - 1)))
      if (index(date, '-') == 5 .and. len(date) == 10) then
         call find_moment(date//' '//time, 'mdy', date)
      end if
      call metadata%set('date', date)
      last = index(rest, ',', back=.true.)
      if (last <= comma) return
      call metadata%set('station', rest(comma + 1:last - 1))
      ! After the component older files name the station again, in brackets
      rest = rest(last + 1:)
      word = lower(first_word(rest, ' ('))
      if (any(component_words == word)) rest = rest(index(lower(rest), word) + len(word):)
      call metadata%set('component', first_word(rest, ' ('))
   end subroutine add_metadata

   !> Find the date: the first word with two strokes, or else a date in words. A year of two digits is one of the 1900s
   subroutine find_date(line, first, next, date)
      !> The line
      character(len=*), intent(in) :: line
      !> Where it begins, 0 if there is none, and where what follows begins
      integer, intent(out) :: first, next
      !> The date as ISO 8601 has it, or the word where it is none of the calendar
      character(len=:), allocatable, intent(out) :: date

      character(len=*), parameter :: digits = '0123456789'
      character(len=:), allocatable :: word
      integer :: i

      do i = 1, len(line)
         if (scan(line(i:i), ' ,') > 0) cycle
         if (i > 1) then
            if (scan(line(i - 1:i - 1), ' ,') == 0) cycle
         end if
         first = i
         next = i
         call take_moment(line, 'mdy', next, date)
         if (len(date) > 0) return
         word = first_word(line(i:), ' ,')
         if (occurrences(word, '/') /= 2 .or. scan(word(1:1), digits) == 0) cycle
         next = i + len(word)
         date = word
         if (len(word) > 3) then
            if (word(len(word) - 2:len(word) - 2) == '/') call find_moment(word(:len(word) - 2)//'19'//word(len(word) - 1:), &
               & 'mdy', date)
         end if
         if (len(date) == 0) date = word
         return
      end do
      first = 0
      next = 1
      date = ''
   end subroutine find_date

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

end module dondolo_records_format_peer
