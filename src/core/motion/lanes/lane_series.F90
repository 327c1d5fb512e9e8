!> The motion within one step of a lane, a power series in the part x of the step that has passed, and the first event in it.
module dondolo_motion_lane_series
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_kinds, only : wp
   use dondolo_motion_bernstein, only : nowhere
   use dondolo_motion_events, only : find_event, find_level, impact, level_above, level_below, limit_reached, no_event, turning
   use dondolo_motion_lane_state, only : lane_width
   use dondolo_motion_normal_form, only : y_limit
   implicit none
   private

   public :: allowed_part, find_first, find_first_level, find_room, find_simple, rate, undecided, value

   !> Not an event: the motion is not of a shape that find_simple knows
   integer, parameter :: undecided = -1

   !> Part that is taken of what the tolerance allows by the last terms of a series
   real(wp), parameter :: safety = 0.9_wp

   !> Relative change after which an iteration of third order has nothing left to gain
   real(wp), parameter :: third_order = epsilon(1.0_wp)**0.35_wp

   !> Most steps of an iteration, or of the bisection that guards it
   integer, parameter :: most_iterations = 60

contains

   !> The part of a step that the tolerance allows; the loop over lanes judges steps in the same way
   pure real(wp) function allowed_part(d, step, shortest, counted, fifth, rtol, atol) result(x)
      !> The series of the motion
      real(wp), intent(in) :: d(0:9)
      !> Step, and the shortest to try [s]
      real(wp), intent(in) :: step, shortest
      !> Part of the last three terms that counts as the error
      real(wp), intent(in) :: counted
      !> Bound of the fifth derivative of y''/5! by y [1/s2]
      real(wp), intent(in) :: fifth
      !> Tolerances of the velocity: relative, and absolute [1/s]
      real(wp), intent(in) :: rtol, atol

      real(wp) :: error, tolerance

      x = 1.0_wp
      do while (x*step > shortest)
         tolerance = rtol*max(abs(d(1)), abs(rate(d, x))) + atol*step
         error = counted*(7.0_wp*abs(d(7)) + x*(8.0_wp*abs(d(8)) + x*9.0_wp*abs(d(9))))*x**6 &
            & + fifth*step**2*x*(abs(d(1))*x + abs(d(2))*x**2)**5
         if (error < tolerance) return
         x = max(0.2_wp*x, safety*x*(tolerance/error)**(1.0_wp/6.0_wp))
      end do
   end function allowed_part

   !> The first events of several steps of a simple shape, most of those that are looked at: a start; a fall; a rise and a
   !> fall, to a new peak or below the largest y so far. Nothing branches here either
   pure subroutine find_simple(n, d, peak, last_part, x, y, v, event)
      !> Steps, in whole vectors
      integer, intent(in) :: n
      !> The series of their motions
      real(wp), intent(in) :: d(lane_width, 0:9)
      !> Largest y so far
      real(wp), intent(in) :: peak(lane_width)
      !> Where the steps end
      real(wp), intent(in) :: last_part(lane_width)
      !> Places of the events or ends, coordinates there, and their rates of change; of steps in whole vectors
      real(wp), intent(inout) :: x(lane_width), y(lane_width), v(lane_width)
      !> No event, impact, turning or undecided
      integer(int64), intent(inout) :: event(lane_width)

      integer, parameter :: iterations = 3
      integer(int64), parameter :: is_impact = impact, is_turning = turning, is_none = no_event, is_undecided = undecided
      ! Motions of another shape give nonsense, which must not overflow.
      real(wp), parameter :: smallest = 1.0e-60_wp
      real(wp) :: last, z, zz, z4, y_end, v_end, bend_end, fastest, most_bent, least_third, root, slow, change, y_z, v_z, bend_z
      real(wp) :: starts, rises, falls, turns, is_found, is_simple, f, bent
      logical :: to_turn, to_zero
      integer :: i, iteration

      !$omp simd
      do i = 1, n
         associate (d0 => d(i, 0), d1 => d(i, 1), d2 => d(i, 2), d3 => d(i, 3), d4 => d(i, 4), d5 => d(i, 5), d6 => d(i, 6), &
            & d7 => d(i, 7), d8 => d(i, 8), d9 => d(i, 9))
            last = last_part(i)
            zz = last*last
            z4 = zz*zz
            y_end = (d0 + last*d1) + zz*(d2 + last*d3) + z4*((d4 + last*d5) + zz*(d6 + last*d7) + z4*(d8 + last*d9))
            v_end = (d1 + 2.0_wp*d2*last) + zz*(3.0_wp*d3 + 4.0_wp*d4*last) &
               & + z4*((5.0_wp*d5 + 6.0_wp*d6*last) + zz*(7.0_wp*d7 + 8.0_wp*d8*last) + z4*(9.0_wp*d9))
            bend_end = (2.0_wp*d2 + 6.0_wp*d3*last) + zz*((12.0_wp*d4 + 20.0_wp*d5*last) + zz*(30.0_wp*d6))
            ! The velocity and its rate exceed the larger of their ends by no more than their second derivatives allow.
            fastest = max(d1, v_end) + zz*(0.75_wp*abs(d3) + last*(3.0_wp*abs(d4) + last*8.0_wp*abs(d5)))
            most_bent = max(2.0_wp*d2, bend_end) &
               & + zz*(3.0_wp*abs(d4) + last*16.0_wp*(abs(d5) + last*3.0_wp*abs(d6)))
            least_third = d3 - last*(4.0_wp*abs(d4) + last*(10.0_wp*abs(d5) + last*20.0_wp*abs(d6)))
            ! Conditions hold where they are positive: a start, in which the third derivative rules; a fall, from the start on
            ! or after a rise that stays below the peak, as the tangent or the parabola that bends least does. Where the third
            ! derivative is positive the motion has one maximum at most, and crosses zero once if it ends below.
            starts = min(y_limit - y_end, least_third)
            starts = merge(starts, -1.0_wp, abs(d0) + abs(d1) <= 0.0_wp)
            rises = min(d1, d0 + last*d1 - peak(i))
            falls = max(max(-fastest, min(min(least_third, -y_end), -rises)), min(min(-most_bent, -v_end), &
               & -min(rises, d1*d1 + 2.0_wp*(peak(i) - d0)*most_bent)))
            ! A rise and a fall that may reach beyond the peak
            turns = min(min(min(-most_bent, -v_end), d1), -falls)
            to_turn = turns > 0.0_wp
            to_zero = y_end <= 0.0_wp
            ! Halley's method: for the zero of y from that of the parabola at the start, for the turn from that of the secant of y'
            root = sqrt(max(0.0_wp, d1*d1 - 4.0_wp*d0*d2))
            z = merge(last*d1, merge(2.0_wp*d0, d1 + root, d1 < 0.0_wp), to_turn) &
               & /max(merge(d1 - v_end, merge(root - d1, -2.0_wp*d2, d1 < 0.0_wp), to_turn), smallest)
            z = merge(z, last, z > 0.0_wp .and. z < last)
            !GCC$ unroll 3
            do iteration = 1, iterations
               zz = z*z
               z4 = zz*zz
               y_z = (d0 + z*d1) + zz*(d2 + z*d3) + z4*((d4 + z*d5) + zz*(d6 + z*d7) + z4*(d8 + z*d9))
               v_z = (d1 + 2.0_wp*d2*z) + zz*(3.0_wp*d3 + 4.0_wp*d4*z) &
                  & + z4*((5.0_wp*d5 + 6.0_wp*d6*z) + zz*(7.0_wp*d7 + 8.0_wp*d8*z) + z4*(9.0_wp*d9))
               bend_z = (2.0_wp*d2 + 6.0_wp*d3*z) + zz*((12.0_wp*d4 + 20.0_wp*d5*z) + zz*(30.0_wp*d6))
               f = merge(v_z, y_z, to_turn)
               slow = 1.0_wp/min(merge(bend_z, v_z, to_turn), -smallest)
               bent = merge(6.0_wp*d3 + 24.0_wp*d4*z, bend_z, to_turn)
               change = -f*slow
               change = change*(1.0_wp - 0.5_wp*change*bent*slow)
               z = min(max(z + change, 0.0_wp), last)
            end do
            is_found = min(third_order*z - abs(change), z)
            zz = z*z
            z4 = zz*zz
            y_z = (d0 + z*d1) + zz*(d2 + z*d3) + z4*((d4 + z*d5) + zz*(d6 + z*d7) + z4*(d8 + z*d9))
            v_z = (d1 + 2.0_wp*d2*z) + zz*(3.0_wp*d3 + 4.0_wp*d4*z) &
               & + z4*((5.0_wp*d5 + 6.0_wp*d6*z) + zz*(7.0_wp*d7 + 8.0_wp*d8*z) + z4*(9.0_wp*d9))
            turns = min(is_found, min(turns, min(y_z - peak(i), y_limit - y_z)))
            falls = min(falls, merge(min(is_found, -v_z), falls, to_zero))
            is_simple = max(starts, max(falls, turns))
            x(i) = merge(z, last, to_zero .or. to_turn)
            y(i) = merge(y_z, merge(0.0_wp, y_end, to_zero), to_turn)
            v(i) = merge(v_z, v_end, to_zero .or. to_turn)
            event(i) = merge(merge(is_turning, merge(is_impact, is_none, to_zero), to_turn), is_undecided, is_simple > 0.0_wp)
         end associate
      end do
   end subroutine find_simple

   !> By how much several motions are certain to stay between two levels, negative if they are not: the cubic through both ends
   !> does, and the higher terms add little to it, as in the loop over lanes
   pure subroutine find_room(n, d, last_part, low, high, room)
      !> Steps, in whole vectors
      integer, intent(in) :: n
      !> The series of their motions
      real(wp), intent(in) :: d(lane_width, 0:9)
      !> Where the steps end
      real(wp), intent(in) :: last_part(lane_width)
      !> The levels y; -huge and huge: there is none
      real(wp), intent(in) :: low(lane_width), high(lane_width)
      !> The least distance from them
      real(wp), intent(inout) :: room(lane_width)

      real(wp) :: last, zz, z4, y_end, third, late_third, margin
      integer :: i

      !$omp simd
      do i = 1, n
         last = last_part(i)
         zz = last*last
         z4 = zz*zz
         y_end = (d(i, 0) + last*d(i, 1)) + zz*(d(i, 2) + last*d(i, 3)) &
            & + z4*((d(i, 4) + last*d(i, 5)) + zz*(d(i, 6) + last*d(i, 7)) + z4*(d(i, 8) + last*d(i, 9)))
         third = d(i, 0) + last*d(i, 1)*(1.0_wp/3.0_wp)
         late_third = y_end - last*((d(i, 1) + 2.0_wp*d(i, 2)*last) + zz*(3.0_wp*d(i, 3) + 4.0_wp*d(i, 4)*last) &
            & + z4*((5.0_wp*d(i, 5) + 6.0_wp*d(i, 6)*last) + zz*(7.0_wp*d(i, 7) + 8.0_wp*d(i, 8)*last) &
            & + z4*(9.0_wp*d(i, 9))))*(1.0_wp/3.0_wp)
         margin = 2.0_wp*z4*((abs(d(i, 4)) + last*abs(d(i, 5))) + zz*(abs(d(i, 6)) + last*abs(d(i, 7))))
         room(i) = min(min(min(third, late_third), y_end) - low(i), high(i) - max(max(third, late_third), max(d(i, 0), y_end))) &
            & - margin
      end do
   end subroutine find_room

   !> The first event of a step that find_simple leaves undecided: at once where the motion rises, else from its Bernstein form
   pure subroutine find_first(d, peak, x, event)
      !> The series of the motion
      real(wp), intent(in) :: d(0:9)
      !> Largest y so far
      real(wp), intent(in) :: peak
      !> In: where the step ends; out: the place of the event
      real(wp), intent(inout) :: x
      !> The event
      integer, intent(out) :: event

      real(wp) :: place, b(0:9)

      event = no_event
      if (rises_throughout(d, rate(d, x), x)) then
         if (value(d, x) < y_limit) return
         event = limit_reached
         x = place_of_level(d, y_limit, x)
         return
      end if
      b = bernstein(d, x)
      if (maxval(b) <= peak .and. b(9) < 0.0_wp .and. count(b(:8) > 0.0_wp .and. b(1:) <= 0.0_wp) == 1 &
         & .and. .not. any(b(:8) < 0.0_wp .and. b(1:) > 0.0_wp)) then
         ! One change of sign: it falls to zero once.
         event = impact
         x = place_of_zero(d, x)
      else
         call find_event(b, peak, y_limit, event, place)
         if (event /= no_event) x = place*x
      end if
   end subroutine find_first

   !> The first of two levels that a motion crosses before its first event; one on which it begins is crossed only if the
   !> motion leaves it beyond
   pure subroutine find_first_level(d, low, high, x, event)
      !> The series of the motion
      real(wp), intent(in) :: d(0:9)
      !> The levels y; -huge and huge: there is none
      real(wp), intent(in) :: low, high
      !> In: the place of that event, or where the step ends; out: that of the level, if it comes before it
      real(wp), intent(inout) :: x
      !> The event, or no event
      integer, intent(inout) :: event

      real(wp) :: y, v, most_bent, place

      y = value(d, x)
      v = rate(d, x)
      if (event == turning) v = max(v, 0.0_wp)
      most_bent = max(2.0_wp*d(2), bend(d, x)) &
         & + x**2*(3.0_wp*abs(d(4)) + x*16.0_wp*(abs(d(5)) + x*3.0_wp*abs(d(6))))
      if (rises_throughout(d, v, x) .or. (most_bent < 0.0_wp .and. v >= 0.0_wp)) then
         if (y < high) return
         x = place_of_level(d, high, x)
         event = level_above
      else if (rises_throughout(-d, -v, x) .or. (most_bent < 0.0_wp .and. d(1) <= 0.0_wp)) then
         ! It falls all the way.
         if (y > low) return
         x = place_of_level(-d, -low, x)
         event = level_below
      else
         place = nowhere
         call find_level(bernstein(d, x), high, low, event, place)
         if (place < nowhere) x = place*x
      end if
   end subroutine find_first_level

   !> Does a motion rise all the way? Its rate leaves the range of its ends by no more than its second derivative allows
   pure logical function rises_throughout(d, last_rate, last)
      !> The series of the motion
      real(wp), intent(in) :: d(0:9)
      !> Its rate at the end, and the place of that
      real(wp), intent(in) :: last_rate, last

      rises_throughout = min(d(1), last_rate) > last**2*(0.75_wp*abs(d(3)) + last*(3.0_wp*abs(d(4)) + last*8.0_wp*abs(d(5))))
   end function rises_throughout

   !> Where a motion that rises all the way reaches a level, the start if it begins there or beyond
   pure real(wp) function place_of_level(d, level, last) result(x)
      !> The series of the motion
      real(wp), intent(in) :: d(0:9)
      !> The level
      real(wp), intent(in) :: level
      !> A place after it
      real(wp), intent(in) :: last

      real(wp) :: below(0:9)

      below = -d
      below(0) = level - d(0)
      x = 0.0_wp
      if (below(0) > 0.0_wp) x = place_of_zero(below, last)
   end function place_of_level

   !> Where a motion that falls all the way, or rises and then falls, is at zero: Halley's method, in a bracket
   pure real(wp) function place_of_zero(d, last) result(x)
      !> The series of the motion
      real(wp), intent(in) :: d(0:9)
      !> A place after it
      real(wp), intent(in) :: last

      real(wp) :: before, after, y, v, slowness, change
      integer :: iteration

      before = 0.0_wp
      after = last
      ! From the zero of the parabola at the start
      x = sqrt(max(0.0_wp, d(1)**2 - 4.0_wp*d(0)*d(2)))
      if (d(1) < 0.0_wp) then
         x = 2.0_wp*d(0)/(x - d(1))
      else if (d(2) < 0.0_wp) then
         x = -(d(1) + x)/(2.0_wp*d(2))
      end if
      if (.not. (x > 0.0_wp .and. x < last)) x = last
      do iteration = 1, most_iterations
         y = value(d, x)
         v = rate(d, x)
         if (y > 0.0_wp) then
            before = x
         else
            after = x
         end if
         change = huge(change)
         if (v < 0.0_wp) then
            slowness = 1.0_wp/v
            change = -y*slowness
            change = change*(1.0_wp - 0.5_wp*change*bend(d, x)*slowness)
         end if
         x = x + change
         if (abs(change) <= third_order*x) exit
         if (.not. (x > before .and. x < after)) x = 0.5_wp*(before + after)
      end do
      x = min(max(x, 0.0_wp), last)
   end function place_of_zero

   !> A series. Estrin's scheme here and below: half the waiting of Horner's
   pure real(wp) function value(d, x)
      !> Coefficients of 1, x, x^2, ...
      real(wp), intent(in) :: d(0:9)
      !> Part of the step
      real(wp), intent(in) :: x

      real(wp) :: x2, x4

      x2 = x*x
      x4 = x2*x2
      value = (d(0) + x*d(1)) + x2*(d(2) + x*d(3)) + x4*((d(4) + x*d(5)) + x2*(d(6) + x*d(7)) + x4*(d(8) + x*d(9)))
   end function value

   !> Rate of change of a series
   pure real(wp) function rate(d, x)
      !> Coefficients of 1, x, x^2, ...
      real(wp), intent(in) :: d(0:9)
      !> Part of the step
      real(wp), intent(in) :: x

      real(wp) :: x2, x4

      x2 = x*x
      x4 = x2*x2
      rate = (d(1) + 2.0_wp*d(2)*x) + x2*(3.0_wp*d(3) + 4.0_wp*d(4)*x) &
         & + x4*((5.0_wp*d(5) + 6.0_wp*d(6)*x) + x2*(7.0_wp*d(7) + 8.0_wp*d(8)*x) + x4*(9.0_wp*d(9)))
   end function rate

   !> Second derivative of a series, up to what matters for the next step of an iteration
   pure real(wp) function bend(d, x)
      !> Coefficients of 1, x, x^2, ...
      real(wp), intent(in) :: d(0:9)
      !> Part of the step
      real(wp), intent(in) :: x

      real(wp) :: x2

      x2 = x*x
      bend = (2.0_wp*d(2) + 6.0_wp*d(3)*x) + x2*((12.0_wp*d(4) + 20.0_wp*d(5)*x) + x2*(30.0_wp*d(6)))
   end function bend

   !> Bernstein coefficients of a series over a part of the step
   pure function bernstein(d, x) result(b)
      !> Coefficients of 1, x, x^2, ...
      real(wp), intent(in) :: d(0:)
      !> The part
      real(wp), intent(in) :: x
      !> Coefficients
      real(wp) :: b(0:ubound(d, 1))

      integer :: j, k, n

      ! Differences at 0 are d_k x^k/binomial(n, k); summing them gives the coefficients.
      n = ubound(d, 1)
      b(0) = 1.0_wp
      do k = 1, n
         b(k) = b(k - 1)*x*real(k, wp)/real(n - k + 1, wp)
      end do
      b = b*d
      do k = n, 1, -1
         do j = k, n
            b(j) = b(j) + b(j - 1)
         end do
      end do
   end function bernstein

end module dondolo_motion_lane_series
