!> Measures that grow while the ground shakes: integrals of the piecewise linear acceleration, exactly.
module dondolo_record_energy_measures
   use dondolo_base_bracket, only : bracket_type
   use dondolo_base_kinds, only : wp
   use dondolo_record, only : record_type
   implicit none
   private

   public :: acceleration_energy, cumulative_absolute_velocity, significant_duration, significant_times, trapezoid

contains

   !> Integral of the squared acceleration over time [m2/s3]; Arias's intensity is pi/(2 g) times it (Arias 1970)
   pure function acceleration_energy(record) result(energy)
      type(record_type), intent(in) :: record
      !> The integral [m2/s3]
      real(wp) :: energy

      energy = sum(step_energies(record))
   end function acceleration_energy

   !> Cumulative absolute velocity: the integral of |a| over time [m/s] (EPRI 1988, without a threshold)
   pure function cumulative_absolute_velocity(record) result(cav)
      type(record_type), intent(in) :: record
      !> The integral [m/s]
      real(wp) :: cav

      real(wp) :: both
      integer :: i

      cav = 0.0_wp
      associate (a => record%acceleration)
         do i = 2, size(a)
            both = abs(a(i - 1)) + abs(a(i))
            ! Two triangles where the acceleration passes zero
            if (a(i - 1)*a(i) < 0.0_wp) both = (a(i - 1)**2 + a(i)**2)/both
            cav = cav + 0.5_wp*record%dt*both
         end do
      end associate
   end function cumulative_absolute_velocity

   !> Integral over time by the trapezoidal rule, as other programs take it of a**2 and |a|: too large, since both are convex
   !> where the acceleration is a straight line
   pure function trapezoid(values, dt) result(integral)
      !> Values at the samples
      real(wp), intent(in) :: values(:)
      !> Time step [s]
      real(wp), intent(in) :: dt
      !> The integral
      real(wp) :: integral

      integral = dt*(sum(values) - 0.5_wp*(values(1) + values(size(values))))
   end function trapezoid

   !> Significant duration: the time in which the integral of a**2 grows from one share of its end value to another [s]
   !> (Trifunac and Brady 1975)
   pure function significant_duration(record, from, to) result(duration)
      type(record_type), intent(in) :: record
      !> Share at which it begins, between 0 and 1
      real(wp), intent(in) :: from
      !> Share at which it ends, above `from`
      real(wp), intent(in) :: to
      !> Duration [s]; 0 for a record without motion
      real(wp) :: duration

      real(wp) :: times(2)

      times = significant_times(record, from, to)
      duration = times(2) - times(1)
   end function significant_duration

   !> Times at which the integral of a**2 reaches two shares of its end value [s]; the shares 0 and 1 are where the
   !> motion begins and ends
   pure function significant_times(record, from, to) result(times)
      type(record_type), intent(in) :: record
      !> The first share, between 0 and 1
      real(wp), intent(in) :: from
      !> The second share, above `from`
      real(wp), intent(in) :: to
      !> Times [s]; 0 for a record without motion
      real(wp) :: times(2)

      real(wp) :: step(size(record%acceleration) - 1), total

      step = step_energies(record)
      total = sum(step)
      times = 0.0_wp
      if (total > 0.0_wp) times = [time_of(record, step, from*total), time_of(record, step, to*total)]
   end function significant_times

   !> Integral of the squared acceleration over every step [m2/s3]
   pure function step_energies(record) result(step)
      type(record_type), intent(in) :: record
      !> Integrals [m2/s3]
      real(wp) :: step(size(record%acceleration) - 1)

      integer :: i

      associate (a => record%acceleration)
         do i = 1, size(step)
            step(i) = record%dt*(a(i)**2 + a(i)*a(i + 1) + a(i + 1)**2)/3.0_wp
         end do
      end associate
   end function step_energies

   !> When the integral of the squared acceleration reaches a value [s]
   pure function time_of(record, step, energy) result(time)
      type(record_type), intent(in) :: record
      !> Integrals over the steps [m2/s3]
      real(wp), intent(in) :: step(:)
      !> The value, from 0 to the sum of all, which is positive [m2/s3]
      real(wp), intent(in) :: energy
      !> Time [s]
      real(wp) :: time

      type(bracket_type) :: bracket
      real(wp) :: rest, slope
      integer :: i, k

      rest = energy
      ! Rest before and after the motion is passed over, where rounding could send the shares 0 and 1
      do i = findloc(step > 0.0_wp, .true., dim=1), findloc(step > 0.0_wp, .true., dim=1, back=.true.) - 1
         if (rest <= step(i)) exit
         rest = rest - step(i)
      end do
      ! Within a step the integral is a cubic that never falls: halving finds the part of the step to rounding
      bracket%last = 1.0_wp
      associate (a => record%acceleration(i))
         slope = record%acceleration(i + 1) - a
         do k = 1, digits(slope)
            associate (x => bracket%middle())
               call bracket%halve(record%dt*x*(a**2 + x*slope*(a + x*slope/3.0_wp)) < rest)
            end associate
         end do
      end associate
      time = record%dt*(real(i - 1, wp) + bracket%last)
   end function time_of

end module dondolo_record_energy_measures
