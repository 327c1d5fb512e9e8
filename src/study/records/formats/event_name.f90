!> Names of earthquakes in headers and catalogues: only what is a name is one.
!>
!> Records of one event are taken together in standard errors. Free text in the place of a name (a time of recording, a
!> placeholder, a program) would put records of several earthquakes together, or those of one apart.
module dondolo_records_event_name
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_real
   use dondolo_base_text, only : first_word, lower
   use dondolo_records_dates, only : make_stamp, take_moment
   use dondolo_records_day_times, only : digits, take_time
   use dondolo_records_header_text, only : squeezed
   use dondolo_records_month_names, only : pass_weekday
   implicit none
   private

   public :: clean_event

   !> Marks around names
   character(len=*), parameter :: marks = ' ,;:-([/)]'

   !> What headers write before the name of an earthquake, or before the time of a record
   character(len=12), parameter :: prefixes(5) = [character(len=12) :: 'record of ', 'records of ', 'rcrd of ', 'recording of', &
      & 'recorded on ']

   !> Words for an earthquake and for what names one, which are no names
   character(len=10), parameter :: nouns(15) = [character(len=10) :: 'event', 'events', 'earthquake', 'eq', 'quake', 'name', &
      & 'evento', 'terremoto', 'sisma', 'sismo', 'seisme', 'deprem', 'record', 'rcrd', 'recording']

   !> Words in the place of a name
   character(len=12), parameter :: placeholders(38) = [character(len=12) :: 'unknown', 'unnamed', 'noname', 'nameless', 'no', &
      & 'none', 'n/a', 'na', 'nan', 'nil', 'null', 'n/d', 'nd', 's/n', 'tbd', 'tba', 'tbc', 'missing', 'undefined', &
      & 'undetermined', 'unspecified', 'unidentified', 'untitled', 'pending', 'blank', 'empty', 'placeholder', 'default', &
      & 'sconosciuto', 'ignoto', 'desconocido', 'inconnu', 'unbekannt', 'namenlos', 'bilinmiyor', 'bilinmeyen', 'isimsiz', &
      & 'not']

   !> Phrases that say that there is no name
   character(len=15), parameter :: phrases(32) = [character(len=15) :: 'unknown', 'to be', 'not yet', 'not named', 'not known', &
      & 'not determined', 'not available', 'not applicable', 'not specified', 'not defined', 'not assigned', 'not identified', &
      & 'not stated', 'not provided', 'not reported', 'not given', 'not associated', 'not found', 'no name', 'no event', &
      & 'no earthquake', 'no information', 'no data', 'non disponibile', 'non definito', 'senza nome', 'sin nombre', &
      & 'no disponible', 'sin dato', 'sin datos', 'sans nom', 'ohne namen']

   !> Words of those who describe a file or a program
   character(len=12), parameter :: programs(12) = [character(len=12) :: 'software', 'program', 'programme', 'processed', &
      & 'processing', 'accelerogram', 'uncorrected', 'corrected', 'format', 'prism', 'version', 'src']

   !> Words for a version before its number
   character(len=7), parameter :: versions(5) = [character(len=7) :: 'v', 'ver', 'vers', 'rev', 'release']

   !> Words that may follow a time
   character(len=6), parameter :: after_times(15) = [character(len=6) :: 'cst', 'est', 'mst', 'cet', 'cest', 'eet', 'eest', &
      & 'ist', 'lt', 'local', 'time', 'hrs', 'hours', 'h', 'z']

   !> Words that lead to a date
   character(len=3), parameter :: leading(4) = [character(len=3) :: 'of', 'on', 'at', 'del']

contains

   !> The name of an earthquake
   pure subroutine clean_event(text, name)
      !> What stands in its place
      character(len=*), intent(in) :: text
      !> The name without times of the day; empty if there is none
      character(len=:), allocatable, intent(out) :: name

      logical :: is_recording
      integer :: i

      name = squeezed(text)
      if (is_placeholder(name) .or. is_program(name)) name = ''
      is_recording = .false.
      do i = 1, size(prefixes)
         if (index(lower(name), trim(prefixes(i))//' ') /= 1) cycle
         name = squeezed(name(len_trim(prefixes(i)) + 1:))
         is_recording = .true.
      end do
      call settle_moment(name, is_recording)
      call drop_times(name)
      call drop_dates(name)
      call trim_marks(name)
      if (is_placeholder(name)) name = ''
   end subroutine clean_event

   !> A name that is a moment is that of the earthquake, unless it is that of a recording
   pure subroutine settle_moment(name, is_recording)
      character(len=:), allocatable, intent(inout) :: name
      !> It stands after 'record of'
      logical, intent(in) :: is_recording

      character(len=:), allocatable :: moment, stamp
      integer :: at

      at = 1
      if (is_recording) call pass_weekday(lower(name), at)
      if (at > 1) name = ''
      at = 1
      call take_moment(name, '', at, moment)
      if (len(moment) == 0 .or. verify(name(at:), marks) > 0) return
      if (is_recording) then
         name = ''
      else if (index(name, ':') > 0) then
         call make_stamp(moment, stamp)
         name = stamp
      end if
   end subroutine settle_moment

   !> Drop times of the day, their zones, and the dates beside them
   pure subroutine drop_times(name)
      character(len=:), allocatable, intent(inout) :: name

      character(len=:), allocatable :: before, after, time, moment
      integer :: first, at, next

      do
         call find_time(name, first, at)
         if (first == 0) return
         next = first
         call take_time(lower(name), next, time)
         if (len(time) > 0) at = next
         do while (any(after_times == lower(first_word(name(at:), ' ,)'))) .and. len(first_word(name(at:), ' ,)')) > 0)
            at = at - 1 + index(name(at:), first_word(name(at:), ' ,)')) + len(first_word(name(at:), ' ,)'))
         end do
         before = name(:first - 1)
         ! 2010-02-27T06:34:11
         if (first > 2) then
            if (scan(before(first - 1:), 'tT') > 0 .and. scan(before(first - 2:), digits) > 0) before = before(:first - 2)
         end if
         after = name(at:)
         call drop_last_date(before)
         after = after(verify(after//'x', marks):)
         at = 1
         call take_moment(after, 'dmy', at, moment)
         if (len(moment) > 0) after = after(at:)
         name = squeezed(before//' '//after)
      end do
   end subroutine drop_times

   !> Find a time of the day: digits, a colon and two digits
   pure subroutine find_time(name, first, next)
      character(len=*), intent(in) :: name
      !> Where it begins, 0 if there is none, and where what follows begins
      integer, intent(out) :: first, next

      integer :: i

      first = 0
      next = 1
      do i = 2, len(name) - 2
         if (name(i:i) /= ':' .or. verify(name(i - 1:i - 1)//name(i + 1:i + 2), digits) > 0) cycle
         first = i - 1
         if (first > 1) then
            if (scan(name(first - 1:first - 1), digits) > 0) first = first - 1
         end if
         next = i + verify(name(i:)//'x', digits//':.') - 1
         return
      end do
   end subroutine find_time

   !> Drop a date at the end of a text
   pure subroutine drop_last_date(text)
      character(len=:), allocatable, intent(inout) :: text

      character(len=*), parameter :: orders(2) = ['dmy', 'mdy']
      character(len=:), allocatable :: moment
      integer :: i, k, at

      call trim_marks(text)
      do i = 1, len(text)
         if (i > 1) then
            if (verify(text(i - 1:i - 1), marks) > 0) cycle
         end if
         do k = 1, size(orders)
            at = i
            call take_moment(text, orders(k), at, moment)
            if (len(moment) == 0 .or. at <= len(text)) cycle
            text = text(:i - 1)
            call trim_marks(text)
            return
         end do
         ! A date with two digits of a year
         if (verify(text(i:), digits//'/') == 0 .and. index(text(i:), '/') > 0) then
            text = text(:i - 1)
            call trim_marks(text)
            return
         end if
      end do
   end subroutine drop_last_date

   !> Drop a date that a word leads to: Whittier Narrows of Thu Oct 1, 1987
   pure subroutine drop_dates(name)
      character(len=:), allocatable, intent(inout) :: name

      character(len=:), allocatable :: rest, word

      rest = name
      call drop_last_date(rest)
      if (len(rest) == len(name)) return
      word = lower(first_word(name(len(rest) + 1:), marks))
      if (any(leading == word)) name = rest
   end subroutine drop_dates

   !> Drop marks around a name, and words that would lead to a date
   pure subroutine trim_marks(name)
      character(len=:), allocatable, intent(inout) :: name

      integer :: last, at

      do
         last = verify(name, marks(:len(marks) - 2), back=.true.)
         name = name(max(verify(name, marks(:len(marks) - 2)), 1):last)
         at = scan(name, ' ', back=.true.)
         if (.not. any(leading == lower(name(at + 1:)))) return
         name = name(:at)
      end do
   end subroutine trim_marks

   !> Does a text say that there is no name?
   pure logical function is_placeholder(text)
      character(len=*), intent(in) :: text

      character(len=:), allocatable :: plain, word
      real(wp) :: value
      integer :: i
      logical :: ok

      ! A negative number marks that there is none
      call parse_real(text, value, ok)
      is_placeholder = ok .and. value < 0.0_wp
      if (is_placeholder) return
      plain = squeezed(words_of(text))
      do i = 1, size(phrases)
         is_placeholder = is_placeholder .or. index(' '//plain//' ', ' '//trim(phrases(i))//' ') > 0
      end do
      do while (len(plain) > 0)
         word = first_word(plain, ' ')
         if (.not. any(nouns == word)) exit
         plain = squeezed(plain(len(word) + 1:))
      end do
      do while (len(plain) > 0)
         word = plain(scan(plain, ' ', back=.true.) + 1:)
         if (.not. any(nouns == word)) exit
         plain = squeezed(plain(:len(plain) - len(word)))
      end do
      is_placeholder = is_placeholder .or. len(plain) == 0 .or. any(placeholders == plain)
   end function is_placeholder

   !> A text in lower case, with blanks in place of marks
   pure function words_of(text) result(words)
      character(len=*), intent(in) :: text
      character(len=len(text)) :: words

      integer :: i, length

      words = ''
      length = 0
      do i = 1, len(text)
         ! N.A. is NA, and a letter of another alphabet is one
         if (scan(text(i:i), '.''"`') > 0) cycle
         length = length + 1
         if (scan(text(i:i), '_-*?!()[]{}<>:;,#=~') == 0) words(length:length) = text(i:i)
      end do
      words = lower(words)
   end function words_of

   !> Does a text describe a program, its version, or a file?
   pure logical function is_program(text)
      character(len=*), intent(in) :: text

      character(len=:), allocatable :: rest, word, next, moment
      integer :: at

      is_program = .false.
      rest = lower(text)//' '
      do
         word = first_word(rest, ' ,;()')
         if (len(word) == 0) return
         rest = rest(index(rest, word) + len(word):)
         next = first_word(rest, ' ,;()')
         at = 1
         call take_moment(word, 'dmy', at, moment)
         is_program = any(programs == first_word(word, ':')) .or. is_version(word)
         if (len(next) > 0) is_program = is_program .or. (any(versions == first_word(word, '.')) .and. index(digits, next(1:1)) > 0)
         is_program = is_program .or. (len(moment) == 0 .and. has_two_points(word))
         if (is_program) return
      end do
   end function is_program

   !> Is a word a version, as v1.20?
   pure logical function is_version(word)
      character(len=*), intent(in) :: word

      is_version = .false.
      if (len(word) < 2) return
      is_version = word(1:1) == 'v' .and. verify(word(2:), digits//'.') == 0 .and. scan(word(2:), digits) > 0
   end function is_version

   !> Is a word three numbers with points between, as 1.0.2?
   pure logical function has_two_points(word)
      character(len=*), intent(in) :: word

      has_two_points = verify(word, digits//'.') == 0 .and. index(word, '.') > 1 .and. &
         & index(word, '.', back=.true.) > index(word, '.') + 1 .and. index(word, '.', back=.true.) < len(word)
   end function has_two_points

end module dondolo_records_event_name
