!> Elastic response spectrum: the largest displacements of damped oscillators under the piecewise linear accelerogram.
!>
!> Within a step the ground acceleration is linear, and the motion of an oscillator follows exactly from its state at
!> the start (Nigam and Jennings 1969). Its power series in the time within the step gives the coefficients of the
!> recursion without the cancellation of their closed form. Steps longer than a tenth of the period are divided, so that
!> the series is short. Oscillators of several periods swing side by side, in blocks (dondolo_record_oscillators). The peak is
!> that of the continuous motion: where a bound says that the motion of a block may exceed the largest so far, its steps are
!> looked at, and in those in which it may, the turning point is found. After the record the oscillator swings freely, and that
!> counts too.
module dondolo_record_response_spectrum
   use dondolo_base_bracket, only : bracket_type
   use dondolo_base_kinds, only : pi, wp
   use dondolo_record, only : record_type
   use dondolo_record_oscillators, only : block, lanes => side_by_side, let_swing => swing, oscillators_type
   implicit none
   private

   public :: spectral_displacement, pseudo_acceleration
   public :: smallest_period, largest_period, standard_damping

   !> Shortest period of an oscillator [s]
   real(wp), parameter :: smallest_period = 0.01_wp

   !> Longest period of an oscillator [s]
   real(wp), parameter :: largest_period = 20.0_wp

   !> Damping ratio of the spectra of building codes
   real(wp), parameter :: standard_damping = 0.05_wp

   !> Fewest steps in a period
   real(wp), parameter :: steps_in_period = 10.0_wp

   !> Longest power series
   integer, parameter :: terms = 40

contains

   !> Pseudo-spectral accelerations: (2 pi / T)**2 times the displacements [m/s2]
   pure function pseudo_acceleration(record, periods, damping) result(sa)
      type(record_type), intent(in) :: record
      !> Periods [s]
      real(wp), intent(in) :: periods(:)
      !> Damping ratio, at least 0 and below 1
      real(wp), intent(in) :: damping
      !> Pseudo-spectral accelerations [m/s2]
      real(wp) :: sa(size(periods))

      sa = (2.0_wp*pi/periods)**2*spectral_displacement(record, periods, damping)
   end function pseudo_acceleration

   !> Spectral displacements: the largest displacement of each oscillator relative to the ground [m]
   pure function spectral_displacement(record, periods, damping) result(sd)
      type(record_type), intent(in) :: record
      !> Periods, from smallest_period to largest_period [s]
      real(wp), intent(in) :: periods(:)
      !> Damping ratio, at least 0 and below 1
      real(wp), intent(in) :: damping
      !> Displacements [m]
      real(wp) :: sd(size(periods))

      integer :: parts(size(periods)), chosen(lanes), count, k
      logical :: waiting(size(periods))
      real(wp) :: peak(lanes)

      parts = max(1, ceiling(steps_in_period*record%dt/periods))
      waiting = .true.
      ! Oscillators that divide the steps alike go together, so that a value does not depend on its companions.
      do while (any(waiting))
         chosen = findloc(waiting, .true., dim=1)
         count = 0
         do k = chosen(1), size(periods)
            if (.not. waiting(k) .or. parts(k) /= parts(chosen(1)) .or. count == lanes) cycle
            count = count + 1
            chosen(count) = k
            waiting(k) = .false.
         end do
         call swing(record, periods(chosen), damping, parts(chosen(1)), peak)
         sd(chosen(:count)) = peak(:count)
      end do
   end function spectral_displacement

   !> Largest displacements of some oscillators that divide the steps alike
   pure subroutine swing(record, periods, damping, parts, peak)
      type(record_type), intent(in) :: record
      !> Periods [s]
      real(wp), intent(in) :: periods(lanes)
      !> Damping ratio
      real(wp), intent(in) :: damping
      !> Steps that a step of the record is divided into
      integer, intent(in) :: parts
      !> Largest displacements [m]
      real(wp), intent(out) :: peak(lanes)

      ! The motion of each lane in units of a step h, and displacements over h**2: u, w = u', q = u''
      type(oscillators_type) :: oscillators
      ! On the heap: threads may have small stacks.
      real(wp), dimension(:, :), allocatable :: ground, u, w
      real(wp), dimension(lanes) :: damper, spring, curb, high, bend
      real(wp) :: h, q
      integer :: i, k, first, steps, order(lanes)

      allocate (ground(lanes, 0:block), u(lanes, 0:block), w(lanes, 0:block))
      h = record%dt/real(parts, wp)
      damper = 2.0_wp*damping*(2.0_wp*pi*h/periods)
      spring = (2.0_wp*pi*h/periods)**2
      ! q is a free oscillation of the same damping: within a step it exceeds its ends by no more than this, and u its
      ! chord by an eighth of it.
      curb = exp(0.5_wp*damper)/cos(pi*h/periods)/8.0_wp
      do k = 1, lanes
         order(k) = order_of(spring(k))
         call set_step(oscillators, k, damper(k), spring(k), order(k))
      end do
      u(:, 0) = 0.0_wp
      w(:, 0) = 0.0_wp
      peak = 0.0_wp
      associate (a => record%acceleration)
         ground(:, 0) = a(1)
         do first = 0, (size(a) - 1)*parts - 1, block
            steps = min(block, (size(a) - 1)*parts - first)
            do i = 1, steps
               associate (sample => (first + i - 1)/parts + 1, part => modulo(first + i - 1, parts) + 1)
                  ground(:, i) = a(sample + 1)
                  if (part < parts) ground(:, i) = a(sample) + (a(sample + 1) - a(sample))*real(part, wp)/real(parts, wp)
               end associate
            end do
            call let_swing(oscillators, steps, ground, u, w)
            high = 0.0_wp
            bend = 0.0_wp
            do i = 0, steps
               !$omp simd private(q)
               do k = 1, lanes
                  q = ground(k, i) + (damper(k)*w(k, i) + spring(k)*u(k, i))
                  high(k) = max(high(k), abs(u(k, i)))
                  bend(k) = max(bend(k), abs(q))
               end do
            end do
            do k = 1, lanes
               if (high(k) + curb(k)*bend(k) > peak(k)) call look_in_block(ground(k, :steps), u(k, :steps), w(k, :steps), &
                  & damper(k), spring(k), order(k), curb(k), peak(k))
            end do
            u(:, 0) = u(:, steps)
            w(:, 0) = w(:, steps)
            ground(:, 0) = ground(:, steps)
         end do
      end associate
      peak = h**2*max(peak, last_swing(u(:, 0), w(:, 0)/h, periods, damping))

   end subroutine swing

   !> Look for a new peak in the steps of a block
   pure subroutine look_in_block(ground, u, w, damper, spring, n, curb, peak)
      !> Acceleration of the ground, displacement and velocity of an oscillator, from the start of the first step
      real(wp), intent(in) :: ground(0:), u(0:), w(0:)
      !> 2 zeta omega h, and (omega h)**2
      real(wp), intent(in) :: damper, spring
      !> Order of the power series
      integer, intent(in) :: n
      !> What the displacement exceeds its ends by in a step, over the acceleration there
      real(wp), intent(in) :: curb
      !> Largest displacement so far
      real(wp), intent(inout) :: peak

      real(wp) :: before, after
      integer :: i

      after = -(ground(0) + damper*w(0) + spring*u(0))
      do i = 1, ubound(u, 1)
         before = after
         after = -(ground(i) + damper*w(i) + spring*u(i))
         peak = max(peak, abs(u(i)))
         if (.not. max(abs(u(i - 1)), abs(u(i))) + curb*max(abs(before), abs(after)) > peak) cycle
         ! The velocity vanishes within the step if it changes sign, or if it turns towards zero and back
         if (w(i - 1)*w(i) < 0.0_wp .or. (before*w(i - 1) < 0.0_wp .and. after*w(i) > 0.0_wp)) peak = max(peak, &
            & turn(series(u(i - 1), w(i - 1), ground(i - 1), ground(i) - ground(i - 1), damper, spring, n)))
      end do
   end subroutine look_in_block

   !> Set what an oscillator becomes in a step
   pure subroutine set_step(oscillators, k, damper, spring, n)
      type(oscillators_type), intent(inout) :: oscillators
      !> Its number
      integer, intent(in) :: k
      !> 2 zeta omega h
      real(wp), intent(in) :: damper
      !> (omega h)**2
      real(wp), intent(in) :: spring
      !> Order of the power series
      integer, intent(in) :: n

      real(wp) :: rise(2)

      oscillators%by_u(k, :) = at_end(series(1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, damper, spring, n))
      oscillators%by_w(k, :) = at_end(series(0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, damper, spring, n))
      rise = at_end(series(0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, damper, spring, n))
      oscillators%by_start(k, :) = at_end(series(0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, damper, spring, n)) - rise
      oscillators%by_end(k, :) = rise

   contains

      !> Displacement and velocity at the end of the step
      pure function at_end(c) result(state)
         !> Power series of the displacement
         real(wp), intent(in) :: c(0:)
         real(wp) :: state(2)

         state = [value(c, 1.0_wp), value(derivative(c), 1.0_wp)]
      end function at_end

   end subroutine set_step

   !> Order of a power series whose next terms are below rounding: they fall as (omega h)**n / n!
   pure function order_of(spring) result(n)
      !> (omega h)**2
      real(wp), intent(in) :: spring
      !> Order
      integer :: n

      real(wp) :: term

      term = 1.0_wp
      do n = 1, terms - 2
         term = term*sqrt(spring)/real(n, wp)
         if (term < 0.01_wp*epsilon(term)) exit
      end do
      ! Beside the critical damping the terms are up to n times as large
      n = min(max(n, 2) + 2, terms)
   end function order_of

   !> Power series of the displacement within a step: u'' + damper u' + spring u = -(start + rise s), s from 0 to 1
   pure function series(u, w, start, rise, damper, spring, n) result(c)
      !> Displacement at the start
      real(wp), intent(in) :: u
      !> Velocity at the start
      real(wp), intent(in) :: w
      !> Ground acceleration at the start
      real(wp), intent(in) :: start
      !> Its rise over the step
      real(wp), intent(in) :: rise
      !> 2 zeta omega h
      real(wp), intent(in) :: damper
      !> (omega h)**2
      real(wp), intent(in) :: spring
      !> Order, at least 3
      integer, intent(in) :: n
      !> Coefficients
      real(wp) :: c(0:n)

      integer :: k

      c(0) = u
      c(1) = w
      c(2) = -(damper*w + spring*u + start)/2.0_wp
      c(3) = -(2.0_wp*damper*c(2) + spring*w + rise)/6.0_wp
      do k = 4, n
         c(k) = -(real(k - 1, wp)*damper*c(k - 1) + spring*c(k - 2))/real(k*(k - 1), wp)
      end do
   end function series

   !> Value of a power series
   pure function value(c, s)
      !> Coefficients
      real(wp), intent(in) :: c(0:)
      !> Part of the step
      real(wp), intent(in) :: s
      !> Value
      real(wp) :: value

      integer :: k

      value = c(ubound(c, 1))
      do k = ubound(c, 1) - 1, 0, -1
         value = value*s + c(k)
      end do
   end function value

   !> Derivative of a power series
   pure function derivative(c) result(d)
      !> Coefficients
      real(wp), intent(in) :: c(0:)
      !> Coefficients of the derivative
      real(wp) :: d(0:ubound(c, 1) - 1)

      integer :: k

      do k = 1, ubound(c, 1)
         d(k - 1) = real(k, wp)*c(k)
      end do
   end function derivative

   !> Largest |u| where the velocity vanishes within a step
   pure function turn(c) result(largest)
      !> Power series of the displacement
      real(wp), intent(in) :: c(0:)
      !> The largest; 0 if the velocity does not vanish
      real(wp) :: largest

      real(wp) :: velocity(0:ubound(c, 1) - 1), middle, at_middle

      velocity = derivative(c)
      if (velocity(0)*value(velocity, 1.0_wp) < 0.0_wp) then
         largest = abs(value(c, zero(velocity, 0.0_wp, 1.0_wp)))
         return
      end if
      ! The velocity is nearest to zero where the acceleration vanishes; its zeros lie on both sides
      largest = 0.0_wp
      middle = zero(derivative(velocity), 0.0_wp, 1.0_wp)
      at_middle = value(velocity, middle)
      if (velocity(0)*at_middle < 0.0_wp) largest = max(abs(value(c, zero(velocity, 0.0_wp, middle))), &
         & abs(value(c, zero(velocity, middle, 1.0_wp))))
   end function turn

   !> Where a power series changes its sign: Newton's method within a bracket
   pure function zero(c, from, to) result(s)
      !> Coefficients
      real(wp), intent(in) :: c(0:)
      !> Begin of the interval
      real(wp), intent(in) :: from
      !> End of the interval, where the series has the other sign
      real(wp), intent(in) :: to
      !> The zero
      real(wp) :: s

      type(bracket_type) :: bracket
      real(wp) :: at_first, at_last, at_s, next
      integer :: k

      bracket = bracket_type(from, to)
      at_first = value(c, from)
      at_last = value(c, to)
      s = from + (to - from)*at_first/(at_first - at_last)
      do k = 1, digits(s)
         at_s = value(c, s)
         call bracket%narrow(s, at_s*at_first > 0.0_wp)
         next = s - at_s/value(derivative(c), s)
         if (.not. (next >= bracket%first .and. next <= bracket%last)) next = bracket%middle()
         ! A displacement is flat where its velocity vanishes, and the step after this one would be the square of it
         if (abs(next - s) < sqrt(epsilon(s))) exit
         s = next
      end do
      s = next
   end function zero

   !> First turning point of free oscillations, which is their largest displacement [m]
   elemental function last_swing(u, velocity, period, damping) result(largest)
      !> Displacement at the end of the record [m]
      real(wp), intent(in) :: u
      !> Velocity there [m/s]
      real(wp), intent(in) :: velocity
      !> Period [s]
      real(wp), intent(in) :: period
      !> Damping ratio
      real(wp), intent(in) :: damping
      !> The displacement where the velocity first vanishes [m]
      real(wp) :: largest

      real(wp) :: omega, damped, angle

      omega = 2.0_wp*pi/period
      damped = sqrt(1.0_wp - damping**2)
      angle = atan2(velocity*damped, omega*u + damping*velocity)
      if (angle < 0.0_wp) angle = angle + pi
      largest = exp(-damping/damped*angle) &
         & *sqrt(max(0.0_wp, u**2 + 2.0_wp*damping*u*velocity/omega + (velocity/omega)**2))
   end function last_swing

end module dondolo_record_response_spectrum
