!> What the title of a column says: units in its brackets, whether its values are times, numbers of samples or accelerations.
module dondolo_record_column_titles
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : lower
   use dondolo_record_units, only : unit_factor
   implicit none
   private

   public :: find_units, has_word, is_acceleration_unit, is_index, is_other_quantity, is_other_unit, is_seconds, is_time
   public :: is_title_of_other, says_nothing

   character(len=*), parameter :: letters = 'abcdefghijklmnopqrstuvwxyz'

   !> Words of titles whose values are no accelerations of the ground in time
   character(len=*), parameter :: others(*) = [character(len=12) :: 'velocity', 'veloc', 'vel', 'displacement', &
      & 'displ', 'disp', 'period', 'frequency', 'freq', 'spectrum', 'spectral', 'pseudo', 'sa', 'psa', 'sv', 'psv', 'sd', &
      & 'velocit', 'velocita', 'spostamento', 'periodo', 'frequenza', 'spettro', 'spettrale', 'slo', 'sld', 'slv', 'slc']

   !> Words of free text that is about velocities, displacements or spectra: fewer, since a comment may name a frequency
   character(len=*), parameter :: others_in_text(*) = [character(len=15) :: 'velocity', 'velocities', 'veloc', 'vel', &
      & 'displacement', 'displacements', 'displ', 'disp', 'spectrum', 'spectra', 'velocita', 'spostamento', 'spostamenti', &
      & 'velocit', 'spettro', 'velocidad', 'desplazamiento', 'vitesse', 'deplacement', 'geschwindigkeit', 'verschiebung']

   !> Words that titles of times begin with
   character(len=*), parameter :: times(*) = [character(len=8) :: 'time', 'times', 't', 'tempo', 'tempi', 'zeit', 'temps', &
      & 'tiempo', 'tiempos', 'zaman', 'sec', 'secs', 'second', 'seconds', 'secondi', 'segundos', 's']

   !> Words of titles of numbers of samples
   character(len=*), parameter :: indices(*) = [character(len=11) :: 'index', 'idx', 'sample', 'samples', 'no', 'nr', &
      & 'num', 'number', 'id', 'row', 'rows', 'rownames', 'i', 'point', 'points', 'unnamed', 'campione', 'campioni', &
      & 'indice', 'numero', 'obs', 'observation', 'count', 'counter', 'step', 'rn']

   !> Words of titles that programs give where nobody did
   character(len=*), parameter :: nothing(*) = [character(len=8) :: 'column', 'col', 'var', 'variable', 'field', 'unnamed', &
      & 'colonna', 'spalte', 'columna']

   !> Units of other quantities
   character(len=*), parameter :: other_units(*) = [character(len=4) :: 'm', 'cm', 'mm', 'in', 'ft', 'm/s', 'cm/s', &
      & 'mm/s', 'in/s', 'ft/s', 'hz', 's', 'sec', 'rad', 'deg']

   !> Words for seconds, and for nothing that tells otherwise
   character(len=*), parameter :: seconds(*) = [character(len=7) :: 's', 'sec', 'secs', 'second', 'seconds']

   !> Words of a title of times that are in no seconds
   character(len=*), parameter :: no_seconds(*) = [character(len=12) :: 'ms', 'msec', 'millisecond', 'milliseconds', &
      & 'us', 'min', 'minute', 'minutes', 'hour', 'hours', 'h', 'hz', 'period', 'frequency', 'freq', 'periodo', 'frequenza']

contains

   !> Find the units in a title
   subroutine find_units(title, units)
      !> Title
      character(len=*), intent(in) :: title
      !> The last text in ( ) or [ ] that is a known unit of acceleration, else the last text in brackets, if any
      character(len=:), allocatable, intent(out) :: units

      type(error_type), allocatable :: error
      character(len=:), allocatable :: content
      real(wp) :: factor
      integer :: opening, closing, from

      units = ''
      from = 1
      do
         opening = scan(title(from:), '([')
         if (opening == 0) return
         opening = from - 1 + opening
         closing = scan(title(opening:), ')]')
         if (closing == 0) return
         closing = opening - 1 + closing
         from = closing + 1
         content = trim(adjustl(title(opening + 1:closing - 1)))
         if (len(content) == 0) cycle
         call unit_factor(content, factor, error)
         units = content
         if (.not. allocated(error)) return
      end do
   end subroutine find_units

   !> Do units belong to another quantity?
   pure logical function is_other_unit(units)
      !> Units in any case, perhaps in brackets
      character(len=*), intent(in) :: units

      is_other_unit = any(other_units == without_sec(lower(bare(units))))
   end function is_other_unit

   !> Are units those of an acceleration?
   logical function is_acceleration_unit(units)
      !> Units, perhaps in brackets
      character(len=*), intent(in) :: units

      type(error_type), allocatable :: unknown
      real(wp) :: factor

      call unit_factor(trim(bare(units)), factor, unknown)
      is_acceleration_unit = .not. allocated(unknown)
   end function is_acceleration_unit

   !> Units without brackets and quotes around
   pure function bare(units)
      character(len=*), intent(in) :: units
      !> The same, filled up with blanks
      character(len=len(units)) :: bare

      integer :: i

      bare = units
      do i = 1, len(units)
         if (index('()[]"''', units(i:i)) > 0) bare(i:i) = ' '
      end do
      bare = adjustl(bare)
   end function bare

   !> Is free text about velocities, displacements or spectra?
   pure logical function is_title_of_other(text)
      character(len=*), intent(in) :: text

      is_title_of_other = has_word(text, others_in_text)
   end function is_title_of_other

   !> Does a title name times?
   pure logical function is_time(title, units)
      character(len=*), intent(in) :: title
      !> Units in it
      character(len=*), intent(in) :: units

      is_time = any(seconds == lower(units))
      if (is_time .or. .not. any(times == first_letters(title))) return
      ! Not a time history of accelerations in g
      is_time = len_trim(units) == 0 .or. has_word(units, no_seconds)
   end function is_time

   !> Does a title name numbers of samples?
   pure logical function is_index(title)
      character(len=*), intent(in) :: title

      is_index = any(indices == first_letters(title)) .or. title == '#'
   end function is_index

   !> Does a title say nothing of what is below it? A letter may be a direction, or any name
   pure logical function says_nothing(title)
      character(len=*), intent(in) :: title

      integer :: letters_in_title, i

      letters_in_title = 0
      do i = 1, len(title)
         if (index(letters, lower(title(i:i))) > 0) letters_in_title = letters_in_title + 1
      end do
      says_nothing = letters_in_title < 2 .or. any(nothing == first_letters(title))
   end function says_nothing

   !> The first letters of a title
   pure function first_letters(title) result(word)
      character(len=*), intent(in) :: title
      !> In lower case, filled up with blanks
      character(len=len(title)) :: word

      integer :: first, last

      word = ''
      first = scan(lower(title), letters)
      if (first == 0) return
      last = first - 2 + verify(lower(title(first:))//' ', letters)
      word = lower(title(first:last))
   end function first_letters

   !> Does a title name something else than accelerations?
   pure function is_other_quantity(title, units) result(other)
      !> Title
      character(len=*), intent(in) :: title
      !> Units in it
      character(len=*), intent(in) :: units
      !> A word of it, or its units, belong to another quantity. Se is a spectrum of Eurocode 8, SE is a direction
      logical :: other

      other = has_word(title, others) .or. any(other_units == without_sec(lower(units))) .or. &
         & index(' '//title//' ', ' Se ') > 0 .or. index(' '//title, ' Se(') > 0
   end function is_other_quantity

   !> May the values under a title be seconds?
   pure function is_seconds(title, units)
      !> Title
      character(len=*), intent(in) :: title
      !> Units in it
      character(len=*), intent(in) :: units
      !> The units are seconds, or there are none and no word tells otherwise
      logical :: is_seconds

      if (len_trim(units) > 0) then
         is_seconds = any(seconds == lower(units))
      else
         is_seconds = .not. has_word(title, no_seconds)
      end if
   end function is_seconds

   !> Is one of some words in a title?
   pure function has_word(title, words)
      !> Title
      character(len=*), intent(in) :: title
      !> The words, in lower case
      character(len=*), intent(in) :: words(:)
      !> One of them stands there, between characters that are no letters
      logical :: has_word

      character(len=:), allocatable :: rest
      integer :: first, last

      has_word = .true.
      rest = lower(title)//' '
      do
         first = scan(rest, letters)
         if (first == 0) exit
         last = first - 2 + verify(rest(first:), letters)
         if (any(words == rest(first:last))) return
         rest = rest(last + 1:)
      end do
      has_word = .false.
   end function has_word

   !> Units with s for sec
   pure function without_sec(units) result(plain)
      !> Units in lower case
      character(len=*), intent(in) :: units
      !> The same; `sec` at the end is `s`
      character(len=len(units)) :: plain

      plain = units
      associate (last => len_trim(units))
         if (last < 4) return
         if (units(last - 3:last) == '/sec') plain(last - 1:) = ''
      end associate
   end function without_sec

end module dondolo_record_column_titles
