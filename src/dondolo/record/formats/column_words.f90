!> Words in which files state time step, sampling rate, number of samples and units, and amounts with their units.
module dondolo_record_column_words
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_real
   use dondolo_base_text, only : blanks, first_word, lower, stripped
   implicit none
   private

   public :: step_keys, rate_keys, count_keys, quantity_keys, unit_words, acceleration_words, second_units, milli_units, rate_units
   public :: has_letter, split_number, without_brackets

   !> Keys in lower case, without brackets and with single blanks
   character(len=*), parameter :: step_keys(*) = [character(len=27) :: 'dt', 'delta t', 'delta_t', 'deltat', 'delt', &
      & 'delta time', 'time step', 'timestep', 'time_step', 'tstep', 'step size', 'sampling interval', 'sample interval', &
      & 'sampling_interval', 'sampling step', 'sampling time', 'sampling period', 'sample period', 'time increment', &
      & 'time interval', 'digitization interval', 'intervallo di campionamento', 'passo di campionamento', &
      & 'passo temporale', 'pas de temps', 'intervalo de muestreo', 'zeitschritt', 'abtastintervall', 'dt_s', &
      & 'sampling_interval_s', 'time spacing', 'sample spacing']
   character(len=*), parameter :: rate_keys(*) = [character(len=27) :: 'sampling rate', 'sample rate', 'samplerate', &
      & 'sampling_rate', 'sample_rate', 'sampling frequency', 'sampling freq', 'sample frequency', 'sampling_frequency', &
      & 'fs', 'sps', 'samples per second', 'sampling', 'frequenza di campionamento', 'frecuencia de muestreo', &
      & 'abtastrate', 'abtastfrequenz', 'sampling_rate_hz', 'data rate', 'samples/sec', 'samples/s']
   character(len=*), parameter :: count_keys(*) = [character(len=27) :: 'npts', 'npt', 'ndata', 'nsamples', 'n samples', &
      & 'n points', 'number of points', 'number of data', 'number of data points', 'number of samples', &
      & 'number of values', 'no of points', 'no. of points', 'no of data', 'no. of data', 'no of samples', &
      & 'no. of samples', 'num points', 'num_points', 'num_samples', 'num samples', 'n_samples', 'n_points', &
      & 'number_of_samples', 'number_of_points', 'points', 'data points', 'samples', 'numero di punti', &
      & 'numero di campioni', 'numero di dati', 'numero de muestras', 'numero de datos', 'anzahl']
   character(len=*), parameter :: quantity_keys(*) = [character(len=27) :: 'quantity', 'data type', 'data_type', 'type', &
      & 'type of data', 'data', 'measurement', 'grandezza', 'motion', 'series']
   !> Words of keys of units
   character(len=*), parameter :: unit_words(*) = [character(len=12) :: 'unit', 'units', 'unita', 'unidades', 'unidad', &
      & 'einheit', 'einheiten', 'unites']
   !> Words of accelerations
   character(len=*), parameter :: acceleration_words(*) = [character(len=16) :: 'acceleration', 'accelerations', 'accel', &
      & 'acc', 'accelerogram', 'accelerograms', 'accelerazione', 'accelerazioni', 'aceleracion', 'beschleunigung', &
      & 'accelerogramma', 'acelerograma', 'xacc', 'yacc', 'zacc']

   !> Words of seconds, of milliseconds and of samples per second after a number
   character(len=*), parameter :: second_units(*) = [character(len=8) :: '', 's', 'sec', 'secs', 'sec.', 's.', 'second', &
      & 'seconds', 'secondi', 'segundos', 'sekunden'], milli_units(*) = [character(len=12) :: 'ms', 'msec', 'msecs', &
      & 'millisecond', 'milliseconds'], rate_units(*) = [character(len=18) :: 'hz', 'sps', 'samples/s', 'samples/sec', &
      & 'samples/second', 'samples per second', '1/s', 's-1', 's^-1', 'hertz', 'spl/s', 'sample/s', 'sample/sec']

contains

   !> Split a text into the number that it begins with, perhaps a fraction such as 1/200, and what follows
   subroutine split_number(text, rest, number, ok)
      character(len=*), intent(in) :: text
      !> What follows the number, in lower case and without brackets
      character(len=:), allocatable, intent(out) :: rest
      real(wp), intent(out) :: number
      !> It begins with a number
      logical, intent(out) :: ok

      character(len=*), parameter :: characters = '0123456789.+-eEdD'
      real(wp) :: divisor
      integer :: last

      rest = ''
      number = 0.0_wp
      ok = .false.
      do last = verify(text//' ', characters) - 1, 1, -1
         call parse_real(text(:last), number, ok)
         if (ok) exit
      end do
      if (.not. ok) return
      rest = lower(stripped(text(last + 1:)))
      if (index(rest, '/') == 1) then
         call parse_real(first_word(rest(2:)//' ', blanks), divisor, ok)
         if (.not. ok .or. .not. divisor > 0.0_wp) then
            ok = .false.
            return
         end if
         number = number/divisor
         rest = rest(2:)
         rest = stripped(rest(len(first_word(rest, blanks)) + 1:))
      end if
      rest = without_brackets(rest)
   end subroutine split_number

   !> Length of a text without the brackets and points around it
   pure integer function inner_length(text) result(length)
      character(len=*), intent(in) :: text

      length = verify(text, ' ()[].''"', back=.true.) - max(verify(text, ' ()[]''"'), 1) + 1
   end function inner_length

   !> A text without the brackets around it and a point at its end
   pure function without_brackets(text) result(inner)
      character(len=*), intent(in) :: text
      character(len=max(0, inner_length(text))) :: inner

      inner = text(max(verify(text, ' ()[]''"'), 1):)
   end function without_brackets

   !> Does a text hold a letter?
   pure logical function has_letter(text)
      character(len=*), intent(in) :: text

      has_letter = scan(lower(text), 'abcdefghijklmnopqrstuvwxyz') > 0
   end function has_letter

end module dondolo_record_column_words
