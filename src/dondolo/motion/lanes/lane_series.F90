!> The motion within one step of a lane, a power series in time, and the first event in it.
module dondolo_lane_series
   use dondolo_events, only : find_event, impact, no_event, turning
   use dondolo_kinds, only : wp
   use dondolo_normal_form, only : y_limit
   implicit none
   private

   public :: allowed_step, find_first, rate, value

   !> Part of the step that the tolerance allows by the last terms of a series
   real(wp), parameter :: safety = 0.9_wp

   !> Relative change after which an iteration of second or third order has nothing left to gain
   real(wp), parameter :: second_order = epsilon(1.0_wp)**0.5_wp, third_order = epsilon(1.0_wp)**0.35_wp

   !> Most steps of an iteration, or of the bisection that guards it
   integer, parameter :: most_iterations = 60

contains

   !> A step that is as short as the tolerance asks for; the loop over lanes judges steps in the same way
   pure real(wp) function allowed_step(d, step, shortest, fifth, rtol, atol) result(h)
      !> The series of the motion
      real(wp), intent(in) :: d(0:9)
      !> Step [s]
      real(wp), intent(in) :: step
      !> Shortest step to try [s]
      real(wp), intent(in) :: shortest
      !> Bound of the fifth derivative of y''/5! by y [1/s2]
      real(wp), intent(in) :: fifth
      !> Tolerances of the velocity: relative, and absolute [1/s]
      real(wp), intent(in) :: rtol, atol

      real(wp) :: error, tolerance

      h = step
      do while (h > shortest)
         tolerance = rtol*max(abs(d(1)), abs(rate(d, h))) + atol
         error = (7.0_wp*abs(d(7)) + h*(8.0_wp*abs(d(8)) + h*9.0_wp*abs(d(9))))*h**6 &
            & + fifth*h*(abs(d(1))*h + abs(d(2))*h**2)**5
         if (error < tolerance) return
         h = max(0.2_wp*h, safety*h*(tolerance/error)**(1.0_wp/6.0_wp))
      end do
   end function allowed_step

   !> The first event of a step: at once where the motion is of a simple shape, else from its Bernstein form
   pure subroutine find_first(d, peak, h, event)
      !> The series of the motion
      real(wp), intent(in) :: d(0:9)
      !> Largest y so far
      real(wp), intent(in) :: peak
      !> In: the step; out: the time of the event [s]
      real(wp), intent(inout) :: h
      !> The event
      integer, intent(out) :: event

      real(wp) :: y, v, fastest, most_bent, turn, x, b(0:9)

      event = no_event
      y = value(d, h)
      ! A start: y''' > 0 rules.
      if (d(0) == 0.0_wp .and. d(1) == 0.0_wp .and. y < y_limit .and. &
         & d(3) > 4.0_wp*h*(abs(d(4)) + h*(abs(d(5)) + h*abs(d(6))))) return
      v = rate(d, h)
      ! y' and y'' exceed the larger of their ends by no more than their second derivatives allow.
      fastest = max(d(1), v) + h**2*(0.75_wp*abs(d(3)) + h*(3.0_wp*abs(d(4)) + h*8.0_wp*abs(d(5))))
      most_bent = max(2.0_wp*d(2), bend(d, h)) &
         & + h**2*(3.0_wp*abs(d(4)) + h*16.0_wp*(abs(d(5)) + h*3.0_wp*abs(d(6))))
      if (fastest < 0.0_wp) then
         ! It falls all the way.
         if (y > 0.0_wp) return
         event = impact
         h = time_of_zero(d, h)
         return
      end if
      if (most_bent < 0.0_wp .and. d(1) > 0.0_wp .and. v < 0.0_wp) then
         ! It rises and then falls.
         turn = time_of_turn(d, h)
         x = value(d, turn)
         if (x < y_limit) then
            if (x > peak) then
               event = turning
               h = turn
            else if (y <= 0.0_wp) then
               event = impact
               h = time_of_zero(d, h)
            end if
            return
         end if
      end if
      b = bernstein(d, h)
      if (maxval(b) <= peak .and. b(9) < 0.0_wp .and. count(b(:8) > 0.0_wp .and. b(1:) <= 0.0_wp) == 1 &
         & .and. .not. any(b(:8) < 0.0_wp .and. b(1:) > 0.0_wp)) then
         ! One change of sign: it falls to zero once.
         event = impact
         h = time_of_zero(d, h)
      else
         call find_event(b, peak, y_limit, event, x)
         if (event /= no_event) h = x*h
      end if
   end subroutine find_first

   !> When a motion that falls all the way, or rises and then falls, is at zero: Halley's method, in a bracket
   pure real(wp) function time_of_zero(d, h) result(t)
      !> The series of the motion
      real(wp), intent(in) :: d(0:9)
      !> A time after it [s]
      real(wp), intent(in) :: h

      real(wp) :: before, after, y, v, slowness, change
      integer :: iteration

      before = 0.0_wp
      after = h
      ! From the zero of the parabola at the start
      t = sqrt(max(0.0_wp, d(1)**2 - 4.0_wp*d(0)*d(2)))
      if (d(1) < 0.0_wp) then
         t = 2.0_wp*d(0)/(t - d(1))
      else if (d(2) < 0.0_wp) then
         t = -(d(1) + t)/(2.0_wp*d(2))
      end if
      if (.not. (t > 0.0_wp .and. t < h)) t = h
      do iteration = 1, most_iterations
         y = value(d, t)
         v = rate(d, t)
         if (y > 0.0_wp) then
            before = t
         else
            after = t
         end if
         change = huge(change)
         if (v < 0.0_wp) then
            slowness = 1.0_wp/v
            change = -y*slowness
            change = change*(1.0_wp - 0.5_wp*change*bend(d, t)*slowness)
         end if
         t = t + change
         if (abs(change) <= third_order*t) exit
         if (.not. (t > before .and. t < after)) t = 0.5_wp*(before + after)
      end do
      t = min(max(t, 0.0_wp), h)
   end function time_of_zero

   !> When a motion that rises and then falls turns: Newton's method, in a bracket
   pure real(wp) function time_of_turn(d, h) result(t)
      !> The series of the motion
      real(wp), intent(in) :: d(0:9)
      !> A time after it [s]
      real(wp), intent(in) :: h

      real(wp) :: before, after, v, change
      integer :: iteration

      before = 0.0_wp
      after = h
      t = h*d(1)/(d(1) - rate(d, h))
      do iteration = 1, most_iterations
         v = rate(d, t)
         if (v > 0.0_wp) then
            before = t
         else
            after = t
         end if
         change = -v/bend(d, t)
         t = t + change
         if (abs(change) <= second_order*t) exit
         if (.not. (t > before .and. t < after)) t = 0.5_wp*(before + after)
      end do
      t = min(max(t, 0.0_wp), h)
   end function time_of_turn

   !> A series. Estrin's scheme here and below: half the waiting of Horner's
   pure real(wp) function value(d, t)
      !> Coefficients of 1, t, t^2, ...
      real(wp), intent(in) :: d(0:9)
      !> Time [s]
      real(wp), intent(in) :: t

      real(wp) :: t2, t4

      t2 = t*t
      t4 = t2*t2
      value = (d(0) + t*d(1)) + t2*(d(2) + t*d(3)) + t4*((d(4) + t*d(5)) + t2*(d(6) + t*d(7)) + t4*(d(8) + t*d(9)))
   end function value

   !> Rate of change of a series
   pure real(wp) function rate(d, t)
      !> Coefficients of 1, t, t^2, ...
      real(wp), intent(in) :: d(0:9)
      !> Time [s]
      real(wp), intent(in) :: t

      real(wp) :: t2, t4

      t2 = t*t
      t4 = t2*t2
      rate = (d(1) + 2.0_wp*d(2)*t) + t2*(3.0_wp*d(3) + 4.0_wp*d(4)*t) &
         & + t4*((5.0_wp*d(5) + 6.0_wp*d(6)*t) + t2*(7.0_wp*d(7) + 8.0_wp*d(8)*t) + t4*(9.0_wp*d(9)))
   end function rate

   !> Second derivative of a series, up to what matters for the next step of an iteration
   pure real(wp) function bend(d, t)
      !> Coefficients of 1, t, t^2, ...
      real(wp), intent(in) :: d(0:9)
      !> Time [s]
      real(wp), intent(in) :: t

      real(wp) :: t2

      t2 = t*t
      bend = (2.0_wp*d(2) + 6.0_wp*d(3)*t) + t2*((12.0_wp*d(4) + 20.0_wp*d(5)*t) + t2*(30.0_wp*d(6)))
   end function bend

   !> Bernstein coefficients of a series over a step
   pure function bernstein(d, h) result(b)
      !> Coefficients of 1, t, t^2, ...
      real(wp), intent(in) :: d(0:)
      !> The step [s]
      real(wp), intent(in) :: h
      !> Coefficients
      real(wp) :: b(0:ubound(d, 1))

      integer :: j, k, n

      ! Differences at 0 are d_k h^k/binomial(n, k); summing them gives the coefficients.
      n = ubound(d, 1)
      b(0) = 1.0_wp
      do k = 1, n
         b(k) = b(k - 1)*h*real(k, wp)/real(n - k + 1, wp)
      end do
      b = b*d
      do k = n, 1, -1
         do j = k, n
            b(j) = b(j) + b(j - 1)
         end do
      end do
   end function bernstein

end module dondolo_lane_series
