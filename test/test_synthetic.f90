!> Random numbers, the model of synthetic motion, and the stored suite.
program test_synthetic
   use, intrinsic :: iso_fortran_env, only : int64
   use checks, only : check, check_close, check_error, check_ok, check_text, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_record, only : record_type
   use dondolo_record_random, only : new_hashed_random, new_random, random_type, split_mix
   use dondolo_record_synthetic, only : motion_model_type, new_motion_model, synthetic_dt, synthetic_record
   use dondolo_record_synthetic_suite, only : suite_record, synthetic44
   use dondolo_records_catalogue, only : read_catalogue
   implicit none

   real(wp), parameter :: pi = acos(-1.0_wp)

   call test_random()
   call test_model()
   call test_record_of_model()
   call test_statistics(5.8_wp, 8.0_wp, 'rock', 'M 5.8 R 8 rock')
   call test_statistics(5.0_wp, 15.0_wp, 'deep', 'M 5 R 15 deep')
   call test_suite()
   call test_hashed_seeds()
   call finish()

contains

   !> SplitMix64 against published values, and numbers of neighbouring seeds against each other
   subroutine test_hashed_seeds()
      ! The first words of the seed 1234567, https://rosettacode.org/wiki/Pseudo-random_numbers/Splitmix64, as signed numbers
      integer(int64), parameter :: published(5) = [6457827717110365317_int64, 3203168211198807973_int64, &
         & -8629252141511181193_int64, 4593380528125082431_int64, -2037821214251327795_int64]
      integer, parameter :: seeds = 2000, draws = 6
      type(random_type) :: random
      integer(int64) :: state, word
      real(wp) :: number(seeds, draws), plain(seeds)
      integer :: i, k

      call suite('hashed seeds')
      state = 1234567_int64
      do i = 1, size(published)
         call split_mix(state, word)
         call check(word == published(i), 'word '//to_text(i)//' of SplitMix64')
      end do
      do i = 1, seeds
         random = new_hashed_random(i, 0)
         do k = 1, draws
            number(i, k) = random%next()
         end do
         random = new_random(i, 0)
         plain(i) = random%next()
      end do
      ! Four standard errors of a correlation that is none
      do k = 1, draws
         call check(abs(related([(real(i, wp), i=1, seeds)], number(:, k))) < 4.0_wp/sqrt(real(seeds, wp)), &
            & 'number '//to_text(k)//' does not follow the seed')
         call check(abs(related(number(2:, k), number(:seeds - 1, k))) < 4.0_wp/sqrt(real(seeds, wp)), &
            & 'number '//to_text(k)//' does not follow that of the seed before')
         call check(abs(sum(number(:, k))/real(seeds, wp) - 0.5_wp) < 4.0_wp/sqrt(12.0_wp*real(seeds, wp)), &
            & 'mean of number '//to_text(k))
      end do
      call check(related([(real(i, wp), i=1, seeds)], plain) > 0.999_wp, 'the first number of plain seeds follows them')
      random = new_hashed_random(7, 3)
      number(1, 1) = random%next()
      random = new_hashed_random(7, 3)
      call check_close(random%next(), number(1, 1), 0.0_wp, 'same seed and stream, same number')
      random = new_hashed_random(7, 4)
      call check(abs(random%next() - number(1, 1)) > 0.0_wp, 'other stream, other number')
   end subroutine test_hashed_seeds

   !> Correlation of two samples
   pure real(wp) function related(one, other)
      real(wp), intent(in) :: one(:), other(:)
      real(wp) :: x(size(one)), y(size(one))

      x = one - sum(one)/real(size(one), wp)
      y = other - sum(other)/real(size(one), wp)
      related = dot_product(x, y)/sqrt(dot_product(x, x)*dot_product(y, y))
   end function related

   !> The generator against published values and against whole-number arithmetic done elsewhere
   subroutine test_random()
      type(random_type) :: random, again
      real(wp) :: number, mean, square, lag
      real(wp), allocatable :: numbers(:)
      integer :: i

      call suite('random')
      ! The published default state; the numerators were computed with integers of any size
      random = new_random(12345, 0)
      call check_close(random%next(), 545508589.0_wp/4294967088.0_wp, 0.0_wp, 'first number')
      call check_close(random%next(), 1368065410.0_wp/4294967088.0_wp, 0.0_wp, 'second number')
      call check_close(random%next(), 1327943761.0_wp/4294967088.0_wp, 0.0_wp, 'third number')
      random = new_random(12345, 0)
      mean = 0.0_wp
      do i = 1, 10000
         mean = mean + random%next()
      end do
      call check_close(mean, 5001.4937692542335_wp, 1.0e-14_wp, 'sum of 10000 numbers')
      ! Stream 1 begins at the published state (3692455944, 1366884236, ...), 2**127 numbers later
      random = new_random(12345, 1)
      call check_close(random%next(), 3262379099.0_wp/4294967088.0_wp, 0.0_wp, 'first number of stream 1')
      random = new_random(12345, 5)
      call check_close(random%next(), 1419483923.0_wp/4294967088.0_wp, 0.0_wp, 'first number of stream 5')
      random = new_random(19722016, 43)
      number = random%next()
      call check_close(random%next(), 2037467796.0_wp/4294967088.0_wp, 0.0_wp, 'second number of stream 43')
      random = new_random(7, 3)
      again = new_random(7, 3)
      allocate (numbers(100000))
      do i = 1, size(numbers)
         numbers(i) = random%next()
         if (abs(numbers(i) - again%next()) > 0.0_wp) exit
      end do
      call check(i > size(numbers), 'same seed and stream, same numbers')
      call check(all(numbers > 0.0_wp .and. numbers < 1.0_wp), 'numbers are between 0 and 1')
      ! Standard errors of these for 1e5 uniform numbers: 9.1e-4, 2.4e-4, 2.6e-4; four of them are allowed
      mean = sum(numbers)/1.0e5_wp
      square = sum((numbers - 0.5_wp)**2)/1.0e5_wp
      lag = sum((numbers(2:) - 0.5_wp)*(numbers(:size(numbers) - 1) - 0.5_wp))/1.0e5_wp
      call check_close(mean, 0.5_wp, 0.0_wp, 'mean', atol=3.7e-3_wp)
      call check_close(square, 1.0_wp/12.0_wp, 0.0_wp, 'variance', atol=9.5e-4_wp)
      call check_close(lag, 0.0_wp, 0.0_wp, 'covariance of neighbours', atol=1.1e-3_wp)
   end subroutine test_random

   !> The model's quantities, worked by hand for M 6, R 10 km, and their changes with site and k
   subroutine test_model()
      type(motion_model_type) :: rock, shallow, deep, above
      type(error_type), allocatable :: error
      real(wp) :: time, energy, peak, time_of_peak
      integer :: i

      call suite('model')
      call new_motion_model(rock, 6.0_wp, 10.0_wp, 'rock', 0.0_wp, error)
      call check_ok(error, 'rock')
      call new_motion_model(shallow, 6.0_wp, 10.0_wp, 'shallow', 0.0_wp, error)
      call check_ok(error, 'shallow')
      call new_motion_model(deep, 6.0_wp, 10.0_wp, 'deep', 0.0_wp, error)
      call check_ok(error, 'deep')
      call new_motion_model(above, 6.0_wp, 10.0_wp, 'rock', 1.0_wp, error)
      call check_ok(error, 'one deviation above')
      ! log10 sqrt(126.01) = 1.0502025, log10 sqrt(128.09) = 1.0537576
      call check_close(log10(rock%strong_duration), -0.783_wp + 1.158_wp + 0.208_wp*1.0502025_wp, 1.0e-6_wp, 'log DV')
      call check_close(log10(1.0e4_wp*rock%energy), 0.729_wp + 5.466_wp - 1.818_wp*1.0537576_wp, 1.0e-6_wp, 'log Ia')
      call check_close(rock%delay, 10.0_wp/7.0_wp, 1.0e-14_wp, 'T1')
      call check_close(rock%length, 1.3_wp*(10.0_wp/7.0_wp + 2.5_wp*rock%strong_duration), 1.0e-14_wp, 'T')
      call check_close(log10(shallow%strong_duration/rock%strong_duration), -0.133_wp, 1.0e-12_wp, 'DV, shallow')
      call check_close(log10(deep%strong_duration/rock%strong_duration), 0.138_wp, 1.0e-12_wp, 'DV, deep')
      call check_close(log10(shallow%energy/rock%energy), 0.244_wp, 1.0e-12_wp, 'Ia on shallow alluvium')
      call check_close(log10(deep%energy/rock%energy), 0.139_wp, 1.0e-12_wp, 'Ia on deep alluvium')
      call check_close(log10(above%strong_duration/rock%strong_duration), 0.247_wp, 1.0e-12_wp, 'deviation of DV')
      call check_close(log10(above%energy/rock%energy), 0.397_wp, 1.0e-12_wp, 'deviation of Ia')
      call check_close(rock%spectrum_spread, sqrt(log(1.0_wp + 0.86_wp**2)), 1.0e-14_wp, 'd')
      call check_close(deep%spectrum_spread, sqrt(log(1.0_wp + 0.89_wp**2)), 1.0e-14_wp, 'd on deep alluvium')
      call check_close(rock%central_frequency(0.0_wp), exp(3.4_wp - 1.308_wp), 1.0e-14_wp, 'Fc at the beginning')
      call check_close(rock%central_frequency(30.0_wp), rock%central_frequency(10.0_wp/7.0_wp + rock%strong_duration), &
         & 1.0e-14_wp, 'Fc after Tc')
      call check_close(log(rock%central_frequency(30.0_wp)), 3.4_wp - 1.308_wp &
         & - 0.35_wp*log(0.5_wp*rock%strong_duration + 3.5_wp + 0.2_wp), 1.0e-13_wp, 'ln Fc at the end')
      call check_close(log(deep%central_frequency(0.0_wp)/rock%central_frequency(0.0_wp)), -0.15_wp, 1.0e-12_wp, &
         & 'Fc on deep alluvium')
      energy = 0.0_wp
      peak = 0.0_wp
      time_of_peak = 0.0_wp
      do i = 1, 200000
         time = 0.001_wp*i
         energy = energy + 0.001_wp*rock%power(time)
         if (rock%power(time) > peak) time_of_peak = time
         peak = max(peak, rock%power(time))
      end do
      call check_close(energy, rock%energy, 1.0e-6_wp, 'integral of the power')
      call check_close(time_of_peak, rock%time_of_peak, 0.0_wp, 'time of the largest power', atol=1.0e-3_wp)
   end subroutine test_model

   !> One record: name, reproducibility, wrong arguments
   subroutine test_record_of_model()
      type(record_type) :: record, again, other
      type(error_type), allocatable :: error
      real(wp) :: nan

      call suite('record of the model')
      call synthetic_record(record, 5.5_wp, 12.0_wp, 'shallow', 4, 2, 0.0_wp, error)
      call check_ok(error, 'record')
      call check_text(record%name, 'synthetic_m5.5_r12_shallow_4_2', 'name')
      call check_close(record%dt, 0.005_wp, 0.0_wp, 'dt')
      call synthetic_record(again, 5.5_wp, 12.0_wp, 'shallow', 4, 2, 0.0_wp, error)
      call check(maxval(abs(record%acceleration - again%acceleration)) <= 0.0_wp, 'same seed, same values')
      call synthetic_record(other, 5.5_wp, 12.0_wp, 'shallow', 4, 3, 0.0_wp, error)
      call check(abs(correlation(record, other)) < 0.3_wp, 'another stream, another realisation')
      call synthetic_record(other, 5.5_wp, 12.0_wp, 'shallow', 5, 2, 0.0_wp, error)
      call check(abs(correlation(record, other)) < 0.3_wp, 'another seed, another realisation')
      nan = 0.0_wp
      nan = sqrt(nan - 1.0_wp)
      call synthetic_record(other, nan, 12.0_wp, 'rock', 4, 2, 0.0_wp, error)
      call check_error(error, 'magnitude = NaN: must be between 4 and 7.5', 'magnitude')
      call synthetic_record(other, 6.0_wp, -1.0_wp, 'rock', 4, 2, 0.0_wp, error)
      call check_error(error, 'distance = -1 km: must be between 0 and 150', 'distance')
      call synthetic_record(other, 6.0_wp, 12.0_wp, 'sand', 4, 2, 0.0_wp, error)
      call check_error(error, 'site = ''sand'': must be one of ''rock'', ''shallow'', ''deep''', 'site')
      call synthetic_record(other, 6.0_wp, 12.0_wp, 'rock', 0, 2, 0.0_wp, error)
      call check_error(error, 'seed = 0: must be positive', 'seed')
      call synthetic_record(other, 6.0_wp, 12.0_wp, 'rock', 1, -1, 0.0_wp, error)
      call check_error(error, 'stream = -1: must not be negative', 'stream')
      call synthetic_record(other, 6.0_wp, 12.0_wp, 'rock', 1, 0, 4.0_wp, error)
      call check_error(error, 'deviations = 4: must be between -3 and 3', 'deviations')
   end subroutine test_record_of_model

   !> 200 realisations against the model
   !>
   !> DV is the strong-motion duration of Vanmarcke and Lai (1980), which follows from energy and peak. The time
   !> between 5 and 95 % of the energy is a property of the envelope: exp(m +- 1.645 s) with m = ln T2 + s**2.
   subroutine test_statistics(magnitude, distance, site, what)
      real(wp), intent(in) :: magnitude, distance
      character(len=*), intent(in) :: site, what

      integer, parameter :: realisations = 200
      type(motion_model_type) :: model
      type(record_type) :: record
      type(error_type), allocatable :: error
      real(wp), allocatable :: husid(:)
      real(wp) :: energy, all_energy, strong, drift, shift, velocity, displacement, early, late, m, s, want
      real(wp) :: spectrum_early(100), spectrum_late(100)
      integer :: i

      call suite('statistics, '//what)
      call new_motion_model(model, magnitude, distance, site, 0.0_wp, error)
      call check_ok(error, 'model')
      all_energy = 0.0_wp
      strong = 0.0_wp
      drift = 0.0_wp
      shift = 0.0_wp
      spectrum_early = 0.0_wp
      spectrum_late = 0.0_wp
      early = model%time_of_peak
      late = model%frequency_end + 1.0_wp
      do i = 1, realisations
         call synthetic_record(record, magnitude, distance, site, 2024, i, 0.0_wp, error)
         if (allocated(error)) exit
         if (i == 1) allocate (husid(size(record%acceleration)), source=0.0_wp)
         associate (a => record%acceleration)
            energy = synthetic_dt*sum(a**2)
            all_energy = all_energy + energy/realisations
            husid = husid + a**2
            strong = strong + vanmarcke_duration(energy, record%pga(), 1.0_wp/model%central_frequency(early)) &
               & /realisations
            call integrate(a, velocity, displacement)
            drift = max(drift, velocity)
            shift = max(shift, displacement)
            call add_spectrum(a, early, spectrum_early)
            call add_spectrum(a, late, spectrum_late)
         end associate
      end do
      call check_ok(error, 'records')
      ! The scatter of one energy is some 20 %, that of the mean of 200 some 1.5 %
      call check_close(all_energy, model%energy, 0.05_wp, 'mean integral of the squared acceleration')
      s = model%envelope_spread
      m = log(model%time_of_peak) + s**2
      want = exp(m + 1.6448536_wp*s) - exp(m - 1.6448536_wp*s)
      call check_close(significant_duration(husid), want, 0.05_wp, 'time from 5 to 95 % of the energy')
      call check_close(strong, model%strong_duration, 0.1_wp, 'mean duration after Vanmarcke and Lai')
      ! A window of 2 s and 200 realisations leave a per cent or two of scatter and leakage
      call check_close(mean_frequency(spectrum_early), model%central_frequency(early), 0.05_wp, 'mean frequency at T2')
      call check_close(mean_frequency(spectrum_late), model%central_frequency(late), 0.05_wp, 'mean frequency after Tc')
      call check(drift < 0.01_wp, 'final velocity is below 1 % of the largest')
      call check(shift < 0.03_wp, 'final displacement is below 3 % of the largest')
   end subroutine test_statistics

   !> The stored suite is what the generator makes
   subroutine test_suite()
      type(record_type), allocatable :: records(:)
      type(record_type) :: record
      type(error_type), allocatable :: error
      real(wp) :: worst, worst_velocity, velocity, displacement, smallest, largest
      integer :: scenario, component, i

      call suite('synthetic44')
      call read_catalogue('data/records/synthetic44.csv', records, error)
      call check_ok(error, 'catalogue')
      if (allocated(error)) return
      call check(size(records) == 2*size(synthetic44) .and. size(records) == 44, '44 records')
      if (size(records) /= 44) return
      worst = 0.0_wp
      worst_velocity = 0.0_wp
      smallest = huge(1.0_wp)
      largest = 0.0_wp
      do scenario = 1, 22
         do component = 1, 2
            i = 2*(scenario - 1) + component
            call suite_record(scenario, component, record, error)
            call check_ok(error, records(i)%name)
            call check_text(records(i)%name, record%name, 'name')
            call check(size(records(i)%acceleration) == size(record%acceleration), record%name//': length')
            if (size(records(i)%acceleration) /= size(record%acceleration)) cycle
            worst = max(worst, maxval(abs(records(i)%acceleration - record%acceleration))/record%pga())
            call integrate(records(i)%acceleration, velocity, displacement)
            worst_velocity = max(worst_velocity, velocity)
            smallest = min(smallest, record%pga())
            largest = max(largest, record%pga())
         end do
      end do
      call check_close(worst, 0.0_wp, 0.0_wp, 'largest difference over PGA', atol=1.0e-9_wp)
      call check(worst_velocity < 0.01_wp, 'final velocities are below 1 % of the largest')
      call check(smallest > 0.2_wp .and. smallest < 0.5_wp, 'smallest PGA is some 0.03 g')
      call check(largest > 5.0_wp .and. largest < 6.5_wp, 'largest PGA is some 0.6 g')
   end subroutine test_suite

   !> Duration after Vanmarcke and Lai (1980): T0 = 2 ln(2 T0/period) I0/peak**2 [s]
   function vanmarcke_duration(energy, peak, period) result(duration)
      real(wp), intent(in) :: energy, peak, period
      real(wp) :: duration
      integer :: i

      duration = 4.0_wp*energy/peak**2
      do i = 1, 50
         duration = 2.0_wp*log(max(2.0_wp*duration/period, exp(1.0_wp)))*energy/peak**2
      end do
   end function vanmarcke_duration

   !> Time from 5 to 95 % of a sum [s]
   function significant_duration(square) result(duration)
      real(wp), intent(in) :: square(:)
      real(wp) :: duration, total, part
      integer :: i, first, last

      total = sum(square)
      part = 0.0_wp
      first = 0
      last = 0
      do i = 1, size(square)
         part = part + square(i)
         if (part < 0.05_wp*total) first = i
         if (part < 0.95_wp*total) last = i
      end do
      duration = synthetic_dt*(last - first)
   end function significant_duration

   !> Final velocity and displacement, over the largest
   subroutine integrate(a, velocity, displacement)
      real(wp), intent(in) :: a(:)
      real(wp), intent(out) :: velocity, displacement
      real(wp) :: v, d, after, largest_v, largest_d
      integer :: i

      v = 0.0_wp
      d = 0.0_wp
      largest_v = 0.0_wp
      largest_d = 0.0_wp
      do i = 2, size(a)
         after = v + 0.5_wp*synthetic_dt*(a(i) + a(i - 1))
         d = d + 0.5_wp*synthetic_dt*(v + after)
         v = after
         largest_v = max(largest_v, abs(v))
         largest_d = max(largest_d, abs(d))
      end do
      velocity = abs(v)/largest_v
      displacement = abs(d)/largest_d
   end subroutine integrate

   !> Add the power spectrum in a window of 2 s around a time, at 0.5, 1, ... 50 Hz
   subroutine add_spectrum(a, middle, spectrum)
      real(wp), intent(in) :: a(:), middle
      real(wp), intent(inout) :: spectrum(:)
      integer, parameter :: window = 400
      real(wp) :: part(window)
      complex(wp) :: coefficient, turn, factor
      integer :: i, k, first

      first = nint(middle/synthetic_dt) - window/2
      do i = 1, window
         part(i) = 0.0_wp
         if (first + i < 1 .or. first + i > size(a)) cycle
         part(i) = a(first + i)*sin(pi*(i - 0.5_wp)/window)**2
      end do
      do k = 1, size(spectrum)
         coefficient = 0.0_wp
         turn = exp(cmplx(0.0_wp, -2.0_wp*pi*k/window, wp))
         factor = 1.0_wp
         do i = 1, window
            coefficient = coefficient + part(i)*factor
            factor = factor*turn
         end do
         spectrum(k) = spectrum(k) + abs(coefficient)**2
      end do
   end subroutine add_spectrum

   !> First moment of a spectrum at 0.5, 1, ... Hz [Hz]
   function mean_frequency(spectrum) result(frequency)
      real(wp), intent(in) :: spectrum(:)
      real(wp) :: frequency
      integer :: k

      frequency = sum([(0.5_wp*k*spectrum(k), k=1, size(spectrum))])/sum(spectrum)
   end function mean_frequency

   !> Correlation of two records of the same length
   function correlation(one, two)
      type(record_type), intent(in) :: one, two
      real(wp) :: correlation

      correlation = sum(one%acceleration*two%acceleration) &
         & /sqrt(sum(one%acceleration**2)*sum(two%acceleration**2))
   end function correlation

end program test_synthetic
