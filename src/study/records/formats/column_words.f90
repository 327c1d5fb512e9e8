!> The closed list of keys that lines above plain columns may have before a number, and amounts with their units.
module dondolo_records_column_words
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_real
   use dondolo_base_text, only : blanks, first_word, lower, replaced, stripped
   use dondolo_records_column_letters, only : digits, folded, has_factor, letters
   implicit none
   private

   public :: kind_of_key, take_amount, has_number, split_key, within_brackets
   public :: step_key, rate_key, count_key, peak_key, duration_key, factor_key, quantity_key, remark_key
   public :: second_units, milli_units, micro_units, rate_units, kilo_units

   !> Kinds of keys; 0 is one that is not known
   integer, parameter :: step_key = 1, rate_key = 2, count_key = 3, peak_key = 4, duration_key = 5, factor_key = 6, &
      & quantity_key = 7, remark_key = 8

   !> Keys in lower case, without accents and brackets, with single blanks for underscores and points
   character(len=*), parameter :: steps(*) = [character(len=27) :: 'dt', 'd t', 'dt s', 'delta', 'delta t', 'deltat', 'delt', &
      & 'delta time', 'time step', 'timestep', 'tstep', 'step', 'step size', 'sampling interval', 'sampling interval s', &
      & 'sample interval', 'sampling step', 'sampling time', 'sampling period', 'sample period', 'time increment', &
      & 'time interval', 'time spacing', 'sample spacing', 'digitization interval', 'intervallo di campionamento', &
      & 'passo di campionamento', 'passo temporale', 'passo', 'pas de temps', 'pas d''echantillonnage', &
      & 'intervalo de muestreo', 'paso de tiempo', 'zeitschritt', 'abtastintervall', 'zeitinkrement']
   character(len=*), parameter :: rates(*) = [character(len=27) :: 'sampling rate', 'sampling rate hz', 'sample rate', &
      & 'samplerate', 'sampling frequency', 'sampling freq', 'sample frequency', 'fs', 'sps', 'samples per second', &
      & 'samples/sec', 'samples/s', 'data rate', 'frequenza di campionamento', 'frecuencia de muestreo', &
      & 'frequence d''echantillonnage', 'abtastrate', 'abtastfrequenz']
   character(len=*), parameter :: counts(*) = [character(len=27) :: 'npts', 'npt', 'ndata', 'nsamples', 'n samples', &
      & 'n points', 'number of points', 'number of data', 'number of data points', 'number of samples', 'number of values', &
      & 'no of points', 'no of data', 'no of samples', 'num points', 'num samples', 'points', 'data points', 'samples', &
      & 'count', 'numero di punti', 'numero di campioni', 'numero di dati', 'numero de muestras', 'numero de datos', &
      & 'nombre de points', 'nombre d''echantillons', 'anzahl', 'anzahl der werte', 'anzahl der punkte', 'numero de puntos']
   character(len=*), parameter :: peaks(*) = [character(len=27) :: 'pga', 'peak', 'peak value', 'peak acceleration', &
      & 'peak ground acceleration', 'max', 'maximum', 'max acceleration', 'maximum acceleration', 'picco', 'massimo', &
      & 'accelerazione massima', 'accelerazione di picco', 'aceleracion maxima', 'acceleration maximale', &
      & 'maximale beschleunigung']
   character(len=*), parameter :: durations(*) = [character(len=27) :: 'duration', 'duration s', 'total duration', &
      & 'record length', 'record duration', 'durata', 'duracion', 'duree', 'dauer']
   character(len=*), parameter :: factors(*) = [character(len=27) :: 'factor', 'scale', 'scale factor', 'scaling', &
      & 'scaling factor', 'scalefactor', 'multiplier', 'multiply by', 'conversion', 'conversion factor', 'gain', &
      & 'sensitivity', 'calibration', 'calibration factor', 'fattore', 'fattore di scala', 'fattore di conversione', &
      & 'factor de escala', 'facteur d''echelle', 'faktor', 'skalierungsfaktor']
   character(len=*), parameter :: quantities(*) = [character(len=27) :: 'quantity', 'data type', 'type', 'type of data', &
      & 'data', 'measurement', 'grandezza', 'motion', 'series', 'parameter', 'signal', 'tipo', 'magnitud']
   character(len=*), parameter :: remarks(*) = [character(len=27) :: 'event', 'event id', 'event name', 'earthquake', &
      & 'date', 'exported', 'exported on', 'created on', 'event date', 'event time', 'origin', 'origin time', 'start time', &
      & 'station', 'station code', 'station name', 'network', 'component', 'channel', 'location', 'site', 'site class', &
      & 'magnitude', 'mw', 'ml', 'ms', 'mb', 'm', 'latitude', 'longitude', 'lat', 'lon', 'station latitude', &
      & 'station longitude', 'event latitude', 'event longitude', 'elevation', 'altitude', 'depth', 'hypocentral depth', &
      & 'distance', 'distance km', 'epicentral distance', 'moment magnitude', 'pgv', 'pgd', 'arias intensity', 'rjb', &
      & 'rrup', 'repi', 'rhyp', 'vs30', 'azimuth', 'orientation', 'filter', 'high-pass', 'low-pass', 'highpass', 'lowpass', &
      & 'high pass', 'low pass', 'bandpass', 'band-pass', 'corner frequency', 'corner frequencies', 'processing', &
      & 'instrument', 'recorder', 'sensor', 'serial number', 'file', 'file name', 'filename', 'record', 'record id', 'rsn', &
      & 'id', 'name', 'title', 'author', 'version', 'created', 'generated', 'source', 'damping', 'return period', 'evento', &
      & 'terremoto', 'data del terremoto', 'stazione', 'componente', 'magnitudo', 'latitudine', 'longitudine', 'distanza']

   !> Units after an amount
   character(len=*), parameter :: second_units(*) = [character(len=8) :: '', 's', 'sec', 'secs', 'sec.', 's.', 'second', &
      & 'seconds', 'secondi', 'segundos', 'sekunden'], milli_units(*) = [character(len=12) :: 'ms', 'msec', 'msecs', &
      & 'millisecond', 'milliseconds', 'millisecondi'], micro_units(*) = [character(len=12) :: 'us', 'microsecond', &
      & 'microseconds'], kilo_units(*) = ['khz'], rate_units(*) = [character(len=18) :: 'hz', 'sps', 'samples/s', 'samples/sec', &
      & 'samples/second', 'samples per second', '1/s', 'hertz']

contains

   !> Kind of a key
   pure integer function kind_of_key(name) result(kind)
      !> As `split_key` gives it
      character(len=*), intent(in) :: name

      kind = 0
      if (any(steps == name)) kind = step_key
      if (any(rates == name)) kind = rate_key
      if (any(counts == name)) kind = count_key
      if (any(peaks == name)) kind = peak_key
      if (any(durations == name)) kind = duration_key
      if (any(factors == name)) kind = factor_key
      if (any(quantities == name)) kind = quantity_key
      if (any(remarks == name)) kind = remark_key
   end function kind_of_key

   !> Split a key such as `Time_step (ms)` into its name and its units
   pure subroutine split_key(key, name, unit)
      character(len=*), intent(in) :: key
      !> Name in lower case, with single blanks for underscores and points
      character(len=:), allocatable, intent(out) :: name
      !> What stands in brackets, as it is written; empty if there are none
      character(len=:), allocatable, intent(out) :: unit

      integer :: opening, last

      opening = scan(key//'(', '([')
      unit = ''
      if (opening < len(key)) unit = within_brackets(key(opening:))
      name = trim(folded(key(:opening - 1)))
      name = replaced(replaced(replaced(name, '_', ' '), '.', ' '), '"', ' ')
      do while (index(stripped(name), '  ') > 0)
         name = replaced(stripped(name), '  ', ' ')
      end do
      name = stripped(name)
      last = index(name, ' ', back=.true.)
      if (len(unit) > 0 .or. last == 0 .or. kind_of_key(name) /= 0) return
      ! dt_ms, time step in milliseconds
      associate (word => name(last + 1:))
         if (.not. (any(second_units == word) .or. any(milli_units == word) .or. any(micro_units == word) .or. &
            & any(rate_units == word))) return
         unit = word
      end associate
      name = trim(name(:last - 1))
      if (index(name//'|', ' in|') > 0) name = trim(name(:len(name) - 3))
   end subroutine split_key

   !> Take an amount and its unit: a number, or a fraction such as 1/200, and nothing but a unit after it
   pure subroutine take_amount(text, amount, unit, ok)
      character(len=*), intent(in) :: text
      real(wp), intent(out) :: amount
      !> As it is written, without brackets; empty if there is none
      character(len=:), allocatable, intent(out) :: unit
      !> The whole text is read
      logical, intent(out) :: ok

      character(len=:), allocatable :: number
      real(wp) :: divisor
      integer :: slash, last

      unit = text(:verify(text, blanks//',;"''', back=.true.))
      unit = unit(max(1, verify(unit, blanks//'"''')):)
      number = first_word(unit//' ', blanks)
      unit = within_brackets(unit(len(number) + 1:))
      ! 20ms
      last = verify(lower(number), letters, back=.true.)
      if (len(unit) == 0 .and. last < len(number) .and. last > 0) then
         unit = number(last + 1:)
         number = number(:last)
      end if
      slash = index(number//'/', '/')
      call parse_real(number(:slash - 1), amount, ok)
      if (ok) ok = .not. has_number(unit)
      if (.not. ok .or. slash > len(number)) return
      call parse_real(number(slash + 1:), divisor, ok)
      if (ok) ok = divisor > 0.0_wp
      if (ok) amount = amount/divisor
   end subroutine take_amount

   !> Does a text hold a number, as a factor too? The figures of m/s2, s-2, SMA-1 and HN1 are none
   pure logical function has_number(text)
      character(len=*), intent(in) :: text

      integer :: i, before

      has_number = has_factor(text)
      if (has_number) return
      do i = 1, len(text)
         if (index(digits, text(i:i)) == 0) cycle
         before = verify(text(:i - 1), '+-.', back=.true.)
         has_number = before == 0
         if (.not. has_number) has_number = index(letters//digits//'_^*', lower(text(before:before))) == 0
         if (has_number) return
      end do
   end function has_number

   !> Length of a text without the brackets and blanks around it
   pure integer function inner_length(text) result(length)
      character(len=*), intent(in) :: text

      length = max(0, verify(text, ' ()[]''"'//achar(9), back=.true.) - max(verify(text, ' ()[]''"'//achar(9)), 1) + 1)
   end function inner_length

   !> A text without the brackets and blanks around it
   pure function within_brackets(text) result(inner)
      character(len=*), intent(in) :: text
      character(len=inner_length(text)) :: inner

      inner = text(max(verify(text, ' ()[]''"'//achar(9)), 1):)
   end function within_brackets

end module dondolo_records_column_words
