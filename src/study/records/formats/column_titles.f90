!> What the title of a column says: units in its brackets, and whether its values are times, accelerations or something else.
!> Accelerations and times are known by closed lists of words and by their units; all other titles are of something else.
module dondolo_records_column_titles
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : blanks, first_word, lower
   use dondolo_records_column_letters, only : digits, folded, has_factor, has_word, letters
   use dondolo_records_units, only : unit_factor
   implicit none
   private

   public :: find_units, is_acceleration, is_acceleration_unit, is_other_quantity, is_other_unit, is_seconds, is_time
   public :: names_acceleration, names_counter, names_counts, names_factor, names_other, says_nothing

   !> Words of accelerations
   character(len=*), parameter :: accelerations(*) = [character(len=16) :: 'acc', 'accel', 'acel', 'acceleration', &
      & 'accelerations', 'accelerogram', 'accelerograms', 'accelerazione', 'accelerazioni', 'accelerogramma', 'aceleracion', &
      & 'acelerograma', 'beschl', 'beschleunigung', 'ivme', 'xacc', 'yacc', 'zacc', 'accx', 'accy', 'accz']

   !> Words that only begin a title of accelerations
   character(len=*), parameter :: symbols(*) = [character(len=2) :: 'a', 'ag', 'ax', 'ay', 'az']

   !> Words of titles whose values are no accelerations of the ground in time
   character(len=*), parameter :: spectra(*) = [character(len=10) :: 'period', 'frequency', 'freq', 'spectral', 'pseudo', 'sa', &
      & 'psa', 'sv', 'psv', 'sd', 'periodo', 'frequenza', 'spettrale', 'slo', 'sld', 'slv', 'slc']

   !> Words of velocities, displacements, spectra, and what else instruments measure, in titles and above
   !> the values
   character(len=*), parameter :: others(*) = [character(len=15) :: 'velocity', 'velocities', 'veloc', 'vel', &
      & 'displacement', 'displacements', 'displ', 'disp', 'dis', 'dsp', 'spectrum', 'spectra', 'velocita', &
      & 'spostamento', 'spostamenti', 'spost', 'spettro', 'velocidad', 'desplazamiento', 'desp', 'espectro', 'vitesse', &
      & 'vit', 'deplacement', 'depl', 'spectre', 'geschwindigkeit', 'geschw', 'verschiebung', 'versch', 'weg', &
      & 'spektrum', 'hiz', 'deplasman', 'tilt', 'rotation', 'rotazione', 'strain', 'deformazione', 'force', 'forza', 'fuerza', &
      & 'kraft', 'pressure', 'pressione', 'temperature', 'temperatura', 'temperatur', 'humidity', 'jerk']

   !> Words of values as a digitizer writes them
   character(len=*), parameter :: counters(*) = [character(len=12) :: 'count', 'counts', 'cts', 'lsb', 'conteggi', 'cuentas', &
      & 'coups', 'uncalibrated'], digitized(*) = [character(len=9) :: 'adc', 'digit', 'digits', 'bit', 'bits', 'volt', 'volts', &
      & 'mv', 'millivolt']

   !> Words of values that something multiplies or divides, and numbers in words
   character(len=*), parameter :: multiples(*) = [character(len=15) :: 'factor', 'factors', 'scale', 'scaled', 'scaling', &
      & 'multiply', 'multiplied', 'multiplier', 'divide', 'divided', 'gain', 'sensitivity', 'conversion', 'percent', &
      & 'tenth', 'tenths', 'hundredth', 'hundredths', 'thousandth', 'thousandths', 'fattore', 'moltiplicare', 'moltiplicato', &
      & 'moltiplicati', 'dividere', 'diviso', 'divisi', 'scalato', 'scalati', 'guadagno', 'sensibilita', 'decimi', 'centesimi', &
      & 'millesimi', 'faktor', 'skaliert', 'multipliziert', 'geteilt', 'empfindlichkeit', 'zehntel', 'hundertstel', &
      & 'tausendstel', 'facteur', 'multiplie', 'divise', 'diviser', 'dixiemes', 'centiemes', &
      & 'milliemes', 'multiplicado', 'multiplicar', 'dividido', 'dividir', 'escalado', 'ganancia', 'centesimas', 'milesimas'], &
      & numerals(*) = [character(len=9) :: 'ten', 'hundred', 'hundreds', 'thousand', 'thousands', 'dieci', 'cento', 'mille', &
      & 'zehn', 'hundert', 'tausend', 'dix', 'cent', 'diez', 'cien', 'mil']

   !> Words that titles of times begin with
   character(len=*), parameter :: times(*) = [character(len=8) :: 'time', 'times', 't', 'tempo', 'tempi', 'zeit', 'temps', &
      & 'tiempo', 'tiempos', 'zaman', 'sec', 'secs', 'second', 'seconds', 'secondi', 'segundos', 's']

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
      !> The last text in ( ) or [ ] that is a known unit of acceleration, else the last text in brackets, if any, else a word
      !> such as cm/s2 or the g of `acc_g`
      character(len=:), allocatable, intent(out) :: units

      type(error_type), allocatable :: error
      character(len=:), allocatable :: content
      real(wp) :: factor
      integer :: opening, closing, from

      units = ''
      from = 1
      do
         opening = scan(title(from:), '([')
         if (opening == 0) exit
         opening = from - 1 + opening
         closing = scan(title(opening:), ')]')
         if (closing == 0) exit
         closing = opening - 1 + closing
         from = closing + 1
         content = trim(adjustl(title(opening + 1:closing - 1)))
         ! The t of a(t) is no unit
         if (len(content) == 0 .or. lower(content) == 't') cycle
         call unit_factor(content, factor, error)
         units = content
         if (.not. allocated(error)) return
      end do
      if (len(units) > 0 .or. .not. names_acceleration(title)) return
      from = 1
      do
         content = first_word(title(from:), blanks//'_,;')
         if (len(content) == 0) return
         from = from - 1 + index(title(from:), content) + len(content)
         if (is_acceleration_unit(content)) units = content
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

   !> Does a text name accelerations?
   pure logical function names_acceleration(text)
      character(len=*), intent(in) :: text

      names_acceleration = has_word(text, accelerations)
   end function names_acceleration

   !> Does a text name velocities, displacements or spectra?
   pure logical function names_other(text)
      character(len=*), intent(in) :: text

      names_other = has_word(text, others)
   end function names_other

   !> Does a text name counts or volts of a digitizer?
   pure logical function names_counts(text)
      character(len=*), intent(in) :: text

      names_counts = has_word(text, digitized) .or. names_counter(text)
   end function names_counts

   !> Does a text name counts, by a word that no description of an instrument has?
   pure logical function names_counter(text)
      character(len=*), intent(in) :: text

      names_counter = has_word(text, counters)
   end function names_counter

   !> Does a text name a factor, or a number in words?
   pure logical function names_factor(text, by_numeral)
      character(len=*), intent(in) :: text
      !> Is a number in words alone one? Oaks may be Thousand
      logical, intent(in) :: by_numeral

      names_factor = has_word(text, multiples) .or. has_factor(text)
      if (.not. names_factor .and. has_word(text, numerals)) names_factor = by_numeral .or. has_word(text, ['times', 'by   '])
   end function names_factor

   !> Does a title name accelerations, by a word or by its units, and nothing else?
   logical function is_acceleration(title, units)
      character(len=*), intent(in) :: title
      !> Units in it, or in the row below it
      character(len=*), intent(in) :: units

      is_acceleration = has_word(title, accelerations) .or. any(symbols == first_letters(title))
      if (.not. is_acceleration .and. len(units) > 0) is_acceleration = is_acceleration_unit(units)
      ! Not 100*acc, or acc x 100
      if (is_acceleration) is_acceleration = .not. (is_other_quantity(title, units) .or. names_counts(title) .or. &
         & names_factor(title, .true.))
      if (is_acceleration .and. scan(adjustl(title), digits) == 1) is_acceleration = .not. any(accelerations == &
         & first_letters(title))
   end function is_acceleration

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

   !> Does a title say nothing of what is below it? One that a program gives: no word, a generic word, or a letter and a number
   pure logical function says_nothing(title)
      character(len=*), intent(in) :: title

      character(len=len(title)) :: word

      word = first_letters(title)
      says_nothing = len_trim(word) == 0 .or. any(nothing == word)
      if (len_trim(word) == 1 .and. len_trim(title) > 1) says_nothing = verify(trim(title(2:)), '0123456789') == 0
   end function says_nothing

   !> The first letters of a title
   pure function first_letters(title) result(word)
      character(len=*), intent(in) :: title
      !> In lower case, filled up with blanks
      character(len=len(title)) :: word

      character(len=len(title)) :: plain
      integer :: first, last

      word = ''
      plain = folded(title)
      first = scan(plain, letters)
      if (first == 0) return
      last = first - 2 + verify(plain(first:)//' ', letters)
      word = plain(first:last)
   end function first_letters

   !> Does a title name something else than accelerations?
   pure function is_other_quantity(title, units) result(other)
      !> Title
      character(len=*), intent(in) :: title
      !> Units in it
      character(len=*), intent(in) :: units
      !> A word of it, or its units, belong to another quantity. Se is a spectrum of Eurocode 8, SE is a direction
      logical :: other

      other = has_word(title, others) .or. has_word(title, spectra) .or. any(other_units == without_sec(lower(units))) .or. &
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

end module dondolo_records_column_titles
