!> Synthetic accelerograms after Italian earthquakes.
!>
!> Model: Sabetta and Pugliese (1996), Estimation of response spectra and simulation of nonstationary earthquake ground
!> motions, Bulletin of the Seismological Society of America 86(2):337-352. A sum of harmonics with random phases whose
!> power follows the physical spectrum of the model: a lognormal envelope in time, a lognormal density in frequency
!> whose centre falls with time. Two steps are this project's own: harmonics are weighted by the modulus of
!> a Butterworth high-pass filter of 4th order at 0.1 Hz (no phase is moved, nothing rings), and the
!> straight line of least squares is taken off, which makes the final velocity and displacement vanish.
module dondolo_record_synthetic
   use dondolo_base_error, only : error_type, raise_input
   use dondolo_base_kinds, only : pi, wp
   use dondolo_base_text, only : join, to_text
   use dondolo_record, only : new_record, record_type
   use dondolo_record_random, only : new_random, random_type
   implicit none
   private

   public :: synthetic_record, motion_model_type, new_motion_model, synthetic_dt

   !> Time step of synthetic records [s]
   real(wp), parameter :: synthetic_dt = 0.005_wp

   !> Ratio of a circle's circumference to its diameter
   !> Corner of the high-pass filter [Hz]
   real(wp), parameter :: corner = 0.1_wp

   !> Site classes of the model
   character(len=*), parameter :: sites(3) = [character(len=7) :: 'rock', 'shallow', 'deep']

   !> The model's quantities for one earthquake and site
   type :: motion_model_type
      !> Duration of the strong motion DV [s]
      real(wp) :: strong_duration = 0.0_wp
      !> Integral of the squared acceleration [m2/s3]
      real(wp) :: energy = 0.0_wp
      !> Delay of the S waves T1 [s]
      real(wp) :: delay = 0.0_wp
      !> Time of the largest power T2 [s]
      real(wp) :: time_of_peak = 0.0_wp
      !> End of the motion T3 [s]
      real(wp) :: time_of_end = 0.0_wp
      !> Length of the record T [s]
      real(wp) :: length = 0.0_wp
      !> Spread of the logarithm of time in the envelope
      real(wp) :: envelope_spread = 0.0_wp
      !> Spread of the logarithm of frequency in the spectrum d
      real(wp) :: spectrum_spread = 0.0_wp
      !> ln of the central frequency at t' = 1 s [ln Hz]
      real(wp) :: ln_first_frequency = 0.0_wp
      !> Time from which t' counts Tf [s]
      real(wp) :: frequency_origin = 0.0_wp
      !> Time after which the central frequency stays Tc [s]
      real(wp) :: frequency_end = 0.0_wp
   contains
      !> Power at a time
      procedure :: power
      !> Central frequency at a time
      procedure :: central_frequency
   end type motion_model_type

contains

   !> Make a synthetic record
   subroutine synthetic_record(record, magnitude, distance, site, seed, stream, deviations, error)
      !> The record, named after its arguments
      type(record_type), intent(out) :: record
      !> Magnitude of the earthquake, 4 to 7.5 (the model was calibrated on 4.6 to 6.8)
      real(wp), intent(in) :: magnitude
      !> Epicentral distance [km], 0 to 150 (calibrated up to 100)
      real(wp), intent(in) :: distance
      !> Site: 'rock', 'shallow' or 'deep' alluvium
      character(len=*), intent(in) :: site
      !> Seed of the phases, positive
      integer, intent(in) :: seed
      !> Stream of random numbers, from 0: another stream, another realisation
      integer, intent(in) :: stream
      !> Standard deviations k by which duration and energy exceed their medians
      real(wp), intent(in) :: deviations
      !> An argument outside its range
      type(error_type), allocatable, intent(out) :: error

      type(motion_model_type) :: model
      real(wp), allocatable :: acceleration(:)

      call new_motion_model(model, magnitude, distance, site, deviations, error)
      if (allocated(error)) return
      if (seed < 1) then
         call raise_input(error, 'seed = '//to_text(seed)//': must be positive')
         return
      end if
      if (stream < 0) then
         call raise_input(error, 'stream = '//to_text(stream)//': must not be negative')
         return
      end if
      call sum_harmonics(model, new_random(seed, stream), acceleration)
      call remove_line(acceleration)
      call new_record(record, acceleration, synthetic_dt, 'synthetic_m'//to_text(magnitude)//'_r'//to_text(distance)// &
         & '_'//trim(site)//'_'//to_text(seed)//'_'//to_text(stream), error)
   end subroutine synthetic_record

   !> Find the model's quantities (Sabetta and Pugliese 1996, as in their own program)
   subroutine new_motion_model(model, magnitude, distance, site, deviations, error)
      type(motion_model_type), intent(out) :: model
      !> Magnitude of the earthquake
      real(wp), intent(in) :: magnitude
      !> Epicentral distance [km]
      real(wp), intent(in) :: distance
      !> Site
      character(len=*), intent(in) :: site
      !> Standard deviations k above the median
      real(wp), intent(in) :: deviations
      !> An argument outside its range
      type(error_type), allocatable, intent(out) :: error

      !> 1 cm2/s3 [m2/s3]
      real(wp), parameter :: square_cm = 1.0e-4_wp
      real(wp) :: shallow, deep

      if (.not. (magnitude >= 4.0_wp .and. magnitude <= 7.5_wp)) then
         call raise_input(error, 'magnitude = '//to_text(magnitude)//': must be between 4 and 7.5')
      else if (.not. (distance >= 0.0_wp .and. distance <= 150.0_wp)) then
         call raise_input(error, 'distance = '//to_text(distance)//' km: must be between 0 and 150')
      else if (.not. any(sites == site)) then
         call raise_input(error, 'site = '''//trim(site)//''': must be one of '//join(sites))
      else if (.not. abs(deviations) <= 3.0_wp) then
         call raise_input(error, 'deviations = '//to_text(deviations)//': must be between -3 and 3')
      end if
      if (allocated(error)) return
      shallow = merge(1.0_wp, 0.0_wp, site == 'shallow')
      deep = merge(1.0_wp, 0.0_wp, site == 'deep')
      model%strong_duration = 10.0_wp**(-0.783_wp + 0.193_wp*magnitude + 0.208_wp*log10(hypot(distance, 5.1_wp)) &
         & - 0.133_wp*shallow + 0.138_wp*deep + 0.247_wp*deviations)
      model%energy = square_cm*10.0_wp**(0.729_wp + 0.911_wp*magnitude - 1.818_wp*log10(hypot(distance, 5.3_wp)) &
         & + 0.244_wp*shallow + 0.139_wp*deep + 0.397_wp*deviations)
      model%delay = distance/7.0_wp
      model%time_of_peak = model%delay + 0.5_wp*model%strong_duration
      model%time_of_end = model%delay + 2.5_wp*model%strong_duration
      model%length = 1.3_wp*model%time_of_end
      model%envelope_spread = log(model%time_of_end/model%time_of_peak)/3.0_wp
      model%spectrum_spread = sqrt(log(1.0_wp + (0.44_wp + 0.07_wp*magnitude - 0.08_wp*shallow + 0.03_wp*deep)**2))
      model%ln_first_frequency = 3.4_wp - 0.218_wp*magnitude - 0.15_wp*deep
      model%frequency_origin = model%time_of_peak - 3.5_wp - distance/50.0_wp
      model%frequency_end = model%time_of_peak + 0.5_wp*model%strong_duration
   end subroutine new_motion_model

   !> Power at a time: mean squared acceleration of all realisations, Pa(t)
   pure function power(self, time)
      class(motion_model_type), intent(in) :: self
      !> Time [s]
      real(wp), intent(in) :: time
      !> Power [m2/s4]: the energy times a lognormal density whose largest value is at T2
      real(wp) :: power

      power = 0.0_wp
      if (.not. time > 0.0_wp) return
      associate (s => self%envelope_spread)
         power = self%energy/(time*s*sqrt(2.0_wp*pi)) &
            & *exp(-(log(time/self%time_of_peak) - s**2)**2/(2.0_wp*s**2))
      end associate
   end function power

   !> Central frequency at a time: the mean frequency of the spectrum, Fc(t)
   pure function central_frequency(self, time) result(frequency)
      class(motion_model_type), intent(in) :: self
      !> Time [s]
      real(wp), intent(in) :: time
      !> Frequency [Hz]
      real(wp) :: frequency

      frequency = exp(self%ln_first_frequency &
         & - 0.35_wp*log(max(min(time, self%frequency_end) - self%frequency_origin, 1.0_wp)))
   end function central_frequency

   !> Sum the harmonics, a(t) = sum over n of sqrt(2 PS_n(t)) cos(2 pi f_n t + phase_n), f_n = n/T up to Nyquist
   subroutine sum_harmonics(model, random_at_start, acceleration)
      type(motion_model_type), intent(in) :: model
      !> Generator of the phases
      type(random_type), intent(in) :: random_at_start
      !> Acceleration [m/s2]
      real(wp), allocatable, intent(out) :: acceleration(:)

      type(random_type) :: random
      real(wp), allocatable :: ln_f(:), weight(:), shape(:), re(:), im(:), turn_re(:), turn_im(:)
      real(wp) :: angle, d, f, last_f, time, old, total
      integer :: i, n, samples, harmonics

      random = random_at_start
      d = model%spectrum_spread
      samples = int(model%length/synthetic_dt) + 1
      harmonics = int(0.5_wp*model%length/synthetic_dt)
      allocate (ln_f(harmonics), weight(harmonics), shape(harmonics), re(harmonics), im(harmonics))
      allocate (turn_re(harmonics), turn_im(harmonics), acceleration(samples))
      do n = 1, harmonics
         f = real(n, wp)/model%length
         ln_f(n) = log(f)
         weight(n) = sqrt(2.0_wp/(real(n, wp)*d*sqrt(2.0_wp*pi)*(1.0_wp + (corner/f)**8)))
         angle = 2.0_wp*pi*random%next()
         re(n) = cos(angle)
         im(n) = sin(angle)
         turn_re(n) = cos(2.0_wp*pi*f*synthetic_dt)
         turn_im(n) = sin(2.0_wp*pi*f*synthetic_dt)
      end do
      last_f = 0.0_wp
      do i = 1, samples
         time = real(i - 1, wp)*synthetic_dt
         f = model%central_frequency(time)
         ! The spectrum's shape moves with the central frequency only
         if (f < last_f .or. f > last_f) then
            shape = weight*exp(-(ln_f - (log(f) - 0.5_wp*d**2))**2/(4.0_wp*d**2))
            last_f = f
         end if
         total = 0.0_wp
         do n = 1, harmonics
            total = total + shape(n)*re(n)
            old = re(n)
            re(n) = old*turn_re(n) - im(n)*turn_im(n)
            im(n) = old*turn_im(n) + im(n)*turn_re(n)
         end do
         acceleration(i) = sqrt(model%power(time))*total
      end do
   end subroutine sum_harmonics

   !> Take off the straight line of least squares
   !>
   !> What is left has no sum and no first moment, hence (by the trapezoidal rule, but for half the end values)
   !> no final velocity and no final displacement.
   pure subroutine remove_line(values)
      !> Values at equal steps
      real(wp), intent(inout) :: values(:)

      real(wp) :: mean, slope, middle
      integer :: i, n

      n = size(values)
      middle = 0.5_wp*real(n + 1, wp)
      mean = sum(values)/real(n, wp)
      slope = 0.0_wp
      do i = 1, n
         slope = slope + (real(i, wp) - middle)*values(i)
      end do
      slope = 12.0_wp*slope/(real(n, wp)*(real(n, wp)**2 - 1.0_wp))
      do i = 1, n
         values(i) = values(i) - mean - slope*(real(i, wp) - middle)
      end do
   end subroutine remove_line

end module dondolo_record_synthetic
