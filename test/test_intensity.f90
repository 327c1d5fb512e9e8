!> Intensity measures: closed forms, what must not change them, their names, and the El Centro accelerogram of 1940.
program test_intensity
   use checks, only : check, check_close, check_error, check_ok, check_text, finish, skip, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_fragility_scaling, only : new_scaling, scaling_names, scaling_type
   use dondolo_fragility_stripes, only : stripes_type
   use dondolo_motion_solver, only : solver_type
   use dondolo_record, only : new_record, record_type
   use dondolo_record_energy_measures, only : significant_times
   use dondolo_record_ground_motion, only : ground_displacement, ground_velocity
   use dondolo_record_intensity, only : im_names, measure_type, new_measure
   use dondolo_record_random, only : new_random, random_type
   use dondolo_record_response_spectrum, only : pseudo_acceleration, spectral_displacement
   use dondolo_record_suite, only : suite_type
   use dondolo_records_record_reader, only : read_record
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   use stripe_runs, only : run_stripes, suite_of
   implicit none

   real(wp), parameter :: pi = 3.14159265358979323846264338327950288_wp
   real(wp), parameter :: g = 9.81_wp

   !> One name of every kind
   character(len=12), parameter :: names(12) = [character(len=12) :: 'pga', 'pgv', 'pgd', 'arias', 'cav', 'arias-trapz', &
      & 'cav-trapz', 'd5-75', 'd5-95', 'hi', 'sa(0.3)', 'saavg(0.2:2)']

   call test_shapes()
   call test_oscillators()
   call test_sine()
   call test_invariance()
   call test_names()
   call test_levels()
   call test_el_centro()
   call finish()

contains

   !> A record
   function record_of(acceleration, dt) result(record)
      real(wp), intent(in) :: acceleration(:), dt
      type(record_type) :: record
      type(error_type), allocatable :: error

      call new_record(record, acceleration, dt, 'test', error)
      call check_ok(error, 'record')
   end function record_of

   !> A measure of a record in the unit of its levels
   function measured(record, name) result(value)
      type(record_type), intent(in) :: record
      character(len=*), intent(in) :: name
      real(wp) :: value
      type(measure_type) :: measure
      type(error_type), allocatable :: error

      value = 0.0_wp
      call new_measure(measure, name, error)
      call check_ok(error, name)
      if (.not. allocated(error)) value = measure%of(record)/measure%level_size(g)
   end function measured

   !> Constants, ramps and triangles: everything in closed form, peaks within the steps too
   subroutine test_shapes()
      type(record_type) :: record
      real(wp), parameter :: exact = 100*epsilon(1.0_wp)
      real(wp), allocatable :: velocity(:), displacement(:)
      real(wp) :: s, times(2)

      call suite('shapes')
      record = record_of(spread(2.0_wp, 1, 101), 0.05_wp)
      call check_close(measured(record, 'pga'), 2.0_wp/g, exact, 'PGA of a constant')
      call check_close(measured(record, 'pgv'), 10.0_wp, exact, 'PGV of a constant')
      call check_close(measured(record, 'pgd'), 25.0_wp, exact, 'PGD of a constant')
      call check_close(measured(record, 'arias'), pi/(2.0_wp*g)*20.0_wp, exact, 'Arias intensity of a constant')
      call check_close(measured(record, 'cav'), 10.0_wp, exact, 'CAV of a constant')
      call check_close(measured(record, 'd5-75'), 3.5_wp, exact, 'duration 5-75 % of a constant')
      call check_close(measured(record, 'd5-95'), 4.5_wp, exact, 'duration 5-95 % of a constant')
      record = record_of([0.0_wp, 3.0_wp, 0.0_wp], 0.5_wp)
      call check_close(measured(record, 'pgv'), 1.5_wp, exact, 'PGV of a triangle')
      call check_close(measured(record, 'cav'), 1.5_wp, exact, 'CAV of a triangle')
      call check_close(measured(record, 'arias'), pi/(2.0_wp*g)*3.0_wp, exact, 'Arias intensity of a triangle')
      ! The trapezoidal rule draws a straight line where a**2 is a parabola, and misses where the acceleration passes zero
      call check_close(measured(record, 'cav-trapz'), 1.5_wp, exact, 'CAV of a triangle by the trapezoidal rule')
      call check_close(measured(record, 'arias-trapz'), pi/(2.0_wp*g)*4.5_wp, exact, 'Arias intensity by the rule')
      call check_close(measured(record_of([1.0_wp, -1.0_wp], 0.5_wp), 'cav-trapz'), 0.5_wp, exact, 'CAV by the rule, past zero')
      call check_close(measured(record_of([1.0_wp, -1.0_wp], 0.5_wp), 'cav'), 0.25_wp, exact, 'CAV past zero')
      ! The energy of the ramp grows with the cube of time, of the falling side with 2 minus a cube
      call check_close(measured(record, 'd5-95'), 1.0_wp - 2.0_wp*0.5_wp*0.1_wp**(1.0_wp/3.0_wp), exact, &
         & 'duration of a triangle')
      ! Rest before and after does not count: the shares 0 and 1 are where the triangle begins and ends
      record = record_of([0.0_wp, 0.0_wp, 0.0_wp, 3.0_wp, 0.0_wp, 0.0_wp], 0.5_wp)
      times = significant_times(record, 0.0_wp, 1.0_wp)
      call check_close(times(1), 1.0_wp, exact, 'beginning of motion')
      ! The cubic is flat there: a rounding of the energy is its cube root in time
      call check_close(times(2), 2.0_wp, epsilon(1.0_wp)**(1.0_wp/3.0_wp), 'end of motion')
      ! From 1 to -1 in a step of 1: the velocity t - t**2 peaks half way, at 1/4
      record = record_of([1.0_wp, -1.0_wp], 1.0_wp)
      call check_close(measured(record, 'pgv'), 0.25_wp, exact, 'PGV within a step')
      call check_close(measured(record, 'pgd'), 1.0_wp/6.0_wp, exact, 'PGD at the end of a step')
      call check_close(measured(record, 'cav'), 0.5_wp, exact, 'CAV through zero')
      ! From 1 to -2: the velocity t - 3/2 t**2 is zero at 2/3, where the displacement is 2/27, and 0 at the end
      record = record_of([1.0_wp, -2.0_wp], 1.0_wp)
      call check_close(measured(record, 'pgd'), 2.0_wp/27.0_wp, exact, 'PGD within a step')
      call check_close(measured(record, 'cav'), 0.5_wp*5.0_wp/3.0_wp, exact, 'CAV of unequal triangles')
      ! In the second step v = 0.3 - t + t**2/4 vanishes at s = 2 - 2 sqrt 0.7, the smaller of two zeros
      record = record_of([1.6_wp, -1.0_wp, -0.5_wp], 1.0_wp)
      s = 2.0_wp - 2.0_wp*sqrt(0.7_wp)
      call check_close(measured(record, 'pgd'), 1.1_wp/3.0_wp + s*(0.3_wp + s*(-0.5_wp + s/12.0_wp)), exact, &
         & 'PGD at the smaller zero')
      velocity = ground_velocity(record)
      displacement = ground_displacement(record)
      call check_close(velocity(2), 0.3_wp, exact, 'velocity at a sample')
      call check_close(displacement(2), 1.1_wp/3.0_wp, exact, 'displacement at a sample')
      record = record_of([0.0_wp, 0.0_wp, 0.0_wp], 0.01_wp)
      call check_close(measured(record, 'd5-95'), 0.0_wp, exact, 'duration of nothing')
      call check_close(measured(record, 'saavg(0.1:1)'), 0.0_wp, exact, 'average of nothing')
   end subroutine test_shapes

   !> Oscillators under a sudden constant acceleration and under a rectangular pulse: Sd in closed form
   subroutine test_oscillators()
      real(wp), parameter :: periods(7) = [0.01_wp, 0.037_wp, 0.1_wp, 0.33_wp, 0.5_wp, 1.7_wp, 6.1_wp]
      real(wp), parameter :: dampings(4) = [0.0_wp, 0.02_wp, 0.05_wp, 0.6_wp]
      real(wp), parameter :: exact = 2.0e4_wp*epsilon(1.0_wp)
      type(record_type) :: record
      real(wp) :: sd(7), want
      integer :: i, j

      call suite('oscillators')
      record = record_of(spread(1.5_wp, 1, 1001), 0.02_wp)
      do j = 1, size(dampings)
         sd = spectral_displacement(record, periods, dampings(j))
         do i = 1, size(periods)
            ! The overshoot comes half a period after the start, never at a sample
            want = 1.5_wp*(periods(i)/(2.0_wp*pi))**2*(1.0_wp + exp(-dampings(j)*pi/sqrt(1.0_wp - dampings(j)**2)))
            call check_close(sd(i), want, exact, 'overshoot at T = '//to_text(periods(i)))
         end do
      end do
      ! A pulse of 0.06 s shorter than half a period: undamped, 2 a / omega**2 sin(omega d / 2), after the record
      record = record_of(spread(-4.0_wp, 1, 7), 0.01_wp)
      sd = spectral_displacement(record, periods, 0.0_wp)
      do i = 4, size(periods)
         want = 8.0_wp*(periods(i)/(2.0_wp*pi))**2*sin(pi*0.06_wp/periods(i))
         call check_close(sd(i), want, exact, 'pulse at T = '//to_text(periods(i)))
      end do
      ! With damping: the state at the end of the pulse, by Duhamel's integral, decays to its first turning point
      sd = spectral_displacement(record, periods, 0.05_wp)
      do i = 4, size(periods)
         call check_close(sd(i), damped_pulse(4.0_wp, 0.06_wp, periods(i), 0.05_wp), 1.0e-9_wp, &
            & 'damped pulse at T = '//to_text(periods(i)))
      end do
   end subroutine test_oscillators

   !> Largest displacement after a rectangular pulse, by the superposition of two steps, searched on a fine grid
   pure function damped_pulse(a, pulse, period, damping) result(largest)
      real(wp), intent(in) :: a, pulse, period, damping
      real(wp) :: largest, here, t, middle, width
      integer :: i, k

      largest = 0.0_wp
      middle = 0.5_wp*period
      width = 0.5_wp*period
      do k = 1, 12
         do i = -50, 50
            t = middle + width*real(i, wp)/50.0_wp
            if (t < pulse) cycle
            here = abs(after_step(a, t, period, damping) - after_step(a, t - pulse, period, damping))
            if (here <= largest) cycle
            largest = here
            middle = t
         end do
         width = width/20.0_wp
      end do
   end function damped_pulse

   !> Displacement of an oscillator a time after a step of the ground acceleration
   pure real(wp) function after_step(a, t, period, damping)
      real(wp), intent(in) :: a, t, period, damping
      real(wp) :: omega, damped

      omega = 2.0_wp*pi/period
      damped = omega*sqrt(1.0_wp - damping**2)
      after_step = a/omega**2*(1.0_wp - exp(-damping*omega*t)*(cos(damped*t) + damping*omega/damped*sin(damped*t)))
   end function after_step

   !> Six cycles of a sine, finely sampled
   subroutine test_sine()
      real(wp), parameter :: period = 0.8_wp, amplitude = 3.0_wp
      integer, parameter :: samples = 4000, cycles = 6
      type(record_type) :: record
      real(wp) :: sa(1)
      integer :: i

      call suite('sine')
      record = record_of([(amplitude*sin(2.0_wp*pi*real(i, wp)/samples), i=0, samples*cycles)], period/samples)
      call check_close(measured(record, 'pgv'), amplitude*period/pi, 1.0e-6_wp, 'PGV')
      call check_close(measured(record, 'pgd'), amplitude*period*period*cycles/(2.0_wp*pi), 1.0e-6_wp, 'PGD')
      call check_close(measured(record, 'arias'), pi/(4.0_wp*g)*amplitude**2*period*cycles, 1.0e-6_wp, 'Arias')
      call check_close(measured(record, 'cav'), 2.0_wp/pi*amplitude*period*cycles, 1.0e-6_wp, 'CAV')
      ! Undamped resonance: u'' + omega**2 u = -a sin(omega t) has u = a n pi / omega**2 after n cycles
      sa = pseudo_acceleration(record, [period], 0.0_wp)
      call check_close(sa(1), amplitude*pi*cycles, 1.0e-6_wp, 'resonance')
   end subroutine test_sine

   !> What must not change a value: a finer sampling of the same lines, the sign; what changes it in proportion: a scale
   subroutine test_invariance()
      integer, parameter :: n = 401
      ! The velocity of an oscillator vanishes twice in one step of this record, and there lies its peak
      real(wp), parameter :: twice(7) = [1.0_wp, -4.0_wp, 8.0_wp, -9.0_wp, 8.0_wp, -3.0_wp, 2.0_wp]
      type(random_type) :: random
      type(measure_type) :: measure
      type(record_type) :: record, fine, scaled
      type(error_type), allocatable :: error
      real(wp) :: a(n), spectrum(40), periods(40), value
      integer :: i

      call suite('invariance')
      random = new_random(7, 0)
      do i = 1, n
         a(i) = (random%next() - 0.5_wp)*sin(pi*real(i, wp)/n)
      end do
      record = record_of(a, 0.02_wp)
      fine = refined(record)
      scaled = record_of(-2.5_wp*a, 0.02_wp)
      do i = 1, size(names)
         call new_measure(measure, trim(names(i)), error)
         call check_ok(error, names(i))
         value = measure%of(record)
         call check(value > 0.0_wp, names(i)//' is positive')
         if (index(names(i), 'trapz') > 0) then
            call check(measure%of(fine) < value, names(i)//' is too large, less so with more samples')
         else
            call check_close(measure%of(fine), value, 2.0e4_wp*epsilon(1.0_wp), names(i)//' of the same lines')
         end if
         call check_close(measure%of(scaled), value*2.5_wp**measure%power(), 1.0e3_wp*epsilon(1.0_wp), &
            & names(i)//' of a scaled record')
      end do
      periods = [(0.01_wp*1.19_wp**(i - 1), i=1, size(periods))]
      ! Without damping one peak hardly exceeds the one before: those within steps must not be missed
      spectrum = spectral_displacement(fine, periods, 0.0_wp)/spectral_displacement(record, periods, 0.0_wp)
      do i = 1, size(periods)
         call check_close(spectrum(i), 1.0_wp, 1.0e-9_wp, 'undamped, of the same lines, T = '//to_text(periods(i)))
      end do
      record = record_of(twice, 0.1_wp)
      call check_close(sum(spectral_displacement(record, [1.0_wp], 0.95_wp)), &
         & sum(spectral_displacement(refined(record), [1.0_wp], 0.95_wp)), 1.0e-12_wp, 'two turning points in a step')
      record = fine
      spectrum = spectral_displacement(record, periods, 0.05_wp)
      do i = 1, size(periods)
         call check(all(.not. abs(spectral_displacement(record, [periods(i)], 0.05_wp) - spectrum(i)) > 0.0_wp), &
            & 'an oscillator does not depend on its companions, T = '//to_text(periods(i)))
      end do
   end subroutine test_invariance

   !> The same lines with seven steps for each
   function refined(record) result(fine)
      type(record_type), intent(in) :: record
      type(record_type) :: fine
      integer, parameter :: parts = 7
      real(wp) :: a(parts*(size(record%acceleration) - 1) + 1)
      integer :: i, k

      do i = 1, size(record%acceleration) - 1
         do k = 0, parts - 1
            a(parts*(i - 1) + k + 1) = (real(parts - k, wp)*record%acceleration(i) &
               & + real(k, wp)*record%acceleration(i + 1))/parts
         end do
      end do
      a(size(a)) = record%acceleration(size(record%acceleration))
      fine = record_of(a, record%dt/parts)
   end function refined

   !> Names, units, and what is refused
   subroutine test_names()
      character(len=14), parameter :: refused(15) = [character(len=14) :: 'PG', 'sa', 'sa(T)', 'sa()', 'sa(0)', &
         & 'sa(-1)', 'sa(21)', 'sa(nan)', 'sa( 1)', 'sa(1', 'sa(1))', 'saavg(1)', 'saavg(2:1)', &
         & 'saavg(1:1)', 'saavg(:1)']
      type(measure_type) :: measure
      type(scaling_type) :: scaling
      type(error_type), allocatable :: error
      integer :: i

      call suite('names')
      call check(size(names) == size(im_names), 'a name of every kind is tested')
      do i = 1, size(names)
         call new_measure(measure, trim(names(i)), error)
         call check_ok(error, names(i))
         call check_text(measure%name, trim(names(i)), 'name')
         call check(len(measure%title()) > 0 .and. len(measure%unit()) > 0, names(i)//' has words and a unit')
         call new_scaling(scaling, trim(names(i)), error)
         if (names(i) (1:2) == 'd5') then
            call check_error(error, 'im = '''//trim(names(i))//''': a duration does not change', names(i))
         else
            call check_ok(error, names(i))
         end if
      end do
      call new_measure(measure, 'saavg(0.20:02.0)', error)
      call check_text(measure%name, 'saavg(0.2:2)', 'name with short periods')
      call new_measure(measure, 'SA(0.50)', error)
      call check_text(measure%name, 'sa(0.5)', 'capital letters')
      call new_scaling(scaling, 'PGA/a0', error)
      call check_text(scaling%name, 'pga/a0', 'capital letters of a measure of a wall')
      do i = 1, size(refused)
         call new_measure(measure, trim(refused(i)), error)
         call check_error(error, 'im = '''//trim(refused(i))//''': must be one of ''pga''', refused(i))
      end do
      call new_measure(measure, 'pga ', error)
      call check_error(error, 'im = ''pga ''', 'a blank')
      call new_scaling(scaling, 'pga/a1', error)
      call check_error(error, '''p*pgv/a0''', 'a list with the measures of a wall')
      call new_measure(measure, 'pga/a0', error)
      call check_error(error, 'im = ''pga/a0''', 'a measure of a wall for a record alone')
      call check(size(scaling_names) == 12, 'scaling names')
   end subroutine test_names

   !> A record scaled to a level has that level, whatever the measure
   subroutine test_levels()
      type(record_type) :: records(1), scaled
      type(random_type) :: random
      type(wall_input_type) :: input
      type(wall_type) :: wall
      type(scaling_type) :: scaling
      type(suite_type) :: whole
      type(stripes_type) :: stripes, by_pga
      type(error_type), allocatable :: error
      character(len=12) :: name
      real(wp) :: a(500), value, level, unit, factors(1)
      integer :: i

      call suite('levels')
      random = new_random(3, 0)
      do i = 1, size(a)
         a(i) = (random%next() - 0.5_wp)
      end do
      records(1) = record_of(a, 0.01_wp)
      call input%set('mechanism', 'one_sided')
      call input%set('height', 2.0_wp)
      call input%set('thickness', 0.3_wp)
      call new_wall(wall, input, error)
      call check_ok(error, 'wall')
      level = 0.37_wp
      do i = 1, size(names) + 2
         name = 'pga/a0'
         if (i <= size(names)) name = names(i)
         if (i == size(names) + 2) name = 'p*pgv/a0'
         if (name(1:2) == 'd5') cycle
         call new_scaling(scaling, trim(name), error)
         call check_ok(error, name)
         value = scaling%measure%of(records(1))
         factors = scaling%factors(level, [value], wall)
         scaled = record_of(factors(1)*a, 0.01_wp)
         unit = scaling%measure%level_size(wall%gravity)
         if (name == 'pga/a0') unit = wall%mechanism%trigger_acceleration()
         if (name == 'p*pgv/a0') unit = g*tan(wall%model%alpha)/sqrt(0.75_wp*g/sqrt(1.0_wp + 0.15_wp**2))
         call check_close(scaling%measure%of(scaled)/unit, level, 1.0e-12_wp, name)
         call check(scaling%needs_wall() .eqv. i > size(names), name//' needs a wall')
      end do
      ! The same accelerations by another name move the wall alike
      call run_stripes(by_pga, wall, records, [0.8_wp], 'pga', 'both', solver_type(), 1)
      level = 0.8_wp*wall%gravity/wall%mechanism%trigger_acceleration()
      call run_stripes(stripes, wall, records, [level], 'pga/a0', 'both', solver_type(), 1)
      call check_text(stripes%im, 'pga/a0', 'im')
      call check_close(stripes%response(1, 1)%edp, by_pga%response(1, 1)%edp, 1.0e-9_wp, 'EDP')
      call new_scaling(scaling, 'sa(0.5)', error)
      whole = suite_of(records)
      call check_close(sum(whole%values(scaling%measure, 2)), scaling%measure%of(records(1)), 0.0_wp, 'values of records')
      do i = 1, 100
         ! The first time they are computed, then they are kept; a suite that has no room for more computes them again
         call new_scaling(scaling, 'sa('//to_text(0.1_wp + 0.01_wp*real(i, wp))//')', error)
         call whole%measure(scaling%measure, 1)
         call whole%measure(scaling%measure, 1)
         call check_close(sum(whole%values(scaling%measure, 1)), scaling%measure%of(records(1)), 0.0_wp, &
            & 'values that are kept')
      end do
   end subroutine test_levels

   !> El Centro 1940, north-south, 1560 samples of 0.02 s. Chopra (Dynamics of Structures, section 6.4 and figure 6.6.2,
   !> damping 2 %): peak acceleration 0.319 g; deformations 2.67, 5.97 and 7.47 inches at 0.5, 1 and 2 s, the peaks
   !> of samples: the continuous motion may exceed them, by no more than 1/cos(pi dt/T)
   subroutine test_el_centro()
      real(wp), parameter :: periods(3) = [0.5_wp, 1.0_wp, 2.0_wp], inches(3) = [2.67_wp, 5.97_wp, 7.47_wp]
      type(record_type) :: record
      type(error_type), allocatable :: error
      character(len=4096) :: folder
      real(wp) :: sd(3)
      logical :: there
      integer :: i

      call suite('El Centro')
      call get_environment_variable('DONDOLO_RECORDS', folder)
      inquire (file=trim(folder)//'/elcentro/elcentro_NS_trunc.dat', exist=there)
      if (.not. there) then
         call skip('no El Centro record: DONDOLO_RECORDS names the folder of recorded accelerograms')
         return
      end if
      call read_record(trim(folder)//'/elcentro/elcentro_NS_trunc.dat', record, error, units='m/s2')
      call check_ok(error, 'El Centro')
      if (allocated(error)) return
      call check_close(measured(record, 'pga'), 0.319_wp, 1.0e-3_wp, 'PGA')
      sd = spectral_displacement(record, periods, 0.02_wp)/0.0254_wp
      do i = 1, size(periods)
         call check(sd(i) > inches(i) - 0.005_wp .and. sd(i) < (inches(i) + 0.005_wp)/cos(pi*0.02_wp/periods(i)), &
            & 'deformation at T = '//to_text(periods(i))//' is '//to_text(sd(i)))
      end do
   end subroutine test_el_centro

end program test_intensity
