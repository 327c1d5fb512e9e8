!> The first event in the step of a thread on a graphics processor, as dondolo_motion_lane_series finds it; without recursion, for
!> which such a thread has no stack.
module dondolo_gpu_events
   use dondolo_base_kinds, only : wp
   use dondolo_motion_events, only : impact, limit_reached, no_event, turning
   use dondolo_motion_normal_form, only : y_limit
   implicit none
   private

   public :: allowed_part, find_first, rate, value
   public :: impact, limit_reached, no_event, turning

   real(wp), parameter :: second_order = epsilon(1.0_wp)**0.5_wp, third_order = epsilon(1.0_wp)**0.35_wp
   integer, parameter :: most_iterations = 60

   !> Answer of first_descent where there is none, and the most halvings on the way to one
   real(wp), parameter :: nowhere = 2.0_wp
   integer, parameter :: most_halvings = 50

contains

   !> The part of a step that the tolerance allows
   pure real(wp) function allowed_part(d, step, shortest, fifth, rtol, atol) result(x)
      !$acc routine seq
      !> The series of the motion
      real(wp), intent(in) :: d(0:9)
      !> Step, and the shortest to try [s]
      real(wp), intent(in) :: step, shortest
      !> Bound of the fifth derivative of y''/5! by y [1/s2]
      real(wp), intent(in) :: fifth
      real(wp), intent(in) :: rtol, atol

      real(wp) :: error, tolerance

      x = 1.0_wp
      do while (x*step > shortest)
         tolerance = rtol*max(abs(d(1)), abs(rate(d, x))) + atol*step
         error = (7.0_wp*abs(d(7)) + x*(8.0_wp*abs(d(8)) + x*9.0_wp*abs(d(9))))*x**6 &
            & + fifth*step**2*x*(abs(d(1))*x + abs(d(2))*x**2)**5
         if (error < tolerance) return
         x = max(0.2_wp*x, 0.9_wp*x*(tolerance/error)**(1.0_wp/6.0_wp))
      end do
   end function allowed_part

   !> The first event of a step
   pure subroutine find_first(d, peak, x, event)
      !$acc routine seq
      !> The series of the motion
      real(wp), intent(in) :: d(0:9)
      !> Largest y so far
      real(wp), intent(in) :: peak
      !> In: where the step ends; out: the place of the event
      real(wp), intent(inout) :: x
      integer, intent(out) :: event

      real(wp) :: y, v, most_bent, least_third, turn, highest, reached(0:9)

      event = no_event
      y = value(d, x)
      v = rate(d, x)
      most_bent = max(2.0_wp*d(2), bend(d, x)) &
         & + x**2*(3.0_wp*abs(d(4)) + x*16.0_wp*(abs(d(5)) + x*3.0_wp*abs(d(6))))
      least_third = d(3) - x*(4.0_wp*abs(d(4)) + x*(10.0_wp*abs(d(5)) + x*20.0_wp*abs(d(6))))
      ! A start, in which the third derivative rules
      if (abs(d(0)) + abs(d(1)) <= 0.0_wp .and. y < y_limit .and. least_third > 0.0_wp) return
      if (rises_throughout(-d, -v, x) .or. (most_bent < 0.0_wp .and. d(1) <= 0.0_wp)) then
         ! It falls all the way.
         if (y > 0.0_wp) return
         event = impact
         x = place_of_zero(d, x)
         return
      end if
      if (most_bent < 0.0_wp .and. d(1) > 0.0_wp .and. v < 0.0_wp) then
         ! It rises and then falls.
         turn = place_of_turn(d, x)
         highest = value(d, turn)
         if (highest < y_limit) then
            if (highest > peak) then
               event = turning
               x = turn
            else if (y <= 0.0_wp) then
               event = impact
               x = place_of_zero(d, x)
            end if
            return
         end if
      end if
      if (rises_throughout(d, v, x)) then
         if (y < y_limit) return
         event = limit_reached
         reached = -d
         reached(0) = y_limit - d(0)
         x = place_of_zero(reached, x)
         return
      end if
      call find_in_bernstein_form(d, peak, x, event)
   end subroutine find_first

   !> The first event of a step of another shape: no root of a Bernstein form is missed
   pure subroutine find_in_bernstein_form(d, peak, x, event)
      !$acc routine seq
      real(wp), intent(in) :: d(0:9)
      real(wp), intent(in) :: peak
      real(wp), intent(inout) :: x
      integer, intent(inout) :: event

      real(wp) :: b(0:9), c(0:9), first, place, highest
      integer :: j, k, changes

      b(0) = 1.0_wp
      do k = 1, 9
         b(k) = b(k - 1)*x*real(k, wp)/real(10 - k, wp)
      end do
      b = b*d
      do k = 9, 1, -1
         do j = k, 9
            b(j) = b(j) + b(j - 1)
         end do
      end do
      first = nowhere
      highest = b(0)
      changes = 0
      do j = 1, 9
         highest = max(highest, b(j))
         if (b(j) < 0.0_wp) changes = changes + 1
      end do
      if (changes > 0 .or. b(9) <= 0.0_wp) then
         call first_descent(b, 9, first)
         if (first < nowhere) event = impact
      end if
      if (highest > peak) then
         do j = 0, 8
            c(j) = b(j + 1) - b(j)
         end do
         place = nowhere
         do j = 0, 8
            if (c(j) /= 0.0_wp) exit
         end do
         if (j < 9) then
            if (c(j) < 0.0_wp) c = -c
            call first_descent(c, 8, place)
         end if
         if (place < first) then
            first = place
            event = turning
         end if
         if (highest >= y_limit) then
            c = y_limit - b
            call first_descent(c, 9, place)
            if (place < first) then
               first = place
               event = limit_reached
            end if
         end if
      end if
      if (event /= no_event) x = first*x
   end subroutine find_in_bernstein_form

   !> First place at which a polynomial that starts positive falls to zero: parts are halved until a root stands alone
   pure subroutine first_descent(coefficients, degree, x)
      !$acc routine seq
      !> Bernstein coefficients
      real(wp), intent(in) :: coefficients(0:9)
      integer, intent(in) :: degree
      !> The place, or `nowhere`
      real(wp), intent(out) :: x

      real(wp) :: b(0:9), c(0:9), width
      integer :: halvings, part, changes, n, j

      b = coefficients
      n = degree
      ! A root at the start is where the step began.
      do while (b(0) == 0.0_wp .and. n > 0)
         do j = 0, n - 1
            b(j) = b(j + 1)*real(n, wp)/real(j + 1, wp)
         end do
         n = n - 1
      end do
      x = nowhere
      halvings = 0
      part = 0
      width = 1.0_wp
      do
         c = b
         call restrict(c, n, real(part, wp)*width, width)
         changes = 0
         do j = 1, n
            if (c(j) > 0.0_wp .neqv. c(j - 1) > 0.0_wp) changes = changes + 1
         end do
         if (c(0) <= 0.0_wp .or. (halvings >= most_halvings .and. changes > 0)) then
            x = real(part, wp)*width
            return
         else if (changes == 0) then
            ! On to the next part, of twice the width where both halves are done
            part = part + 1
            do while (modulo(part, 2) == 0 .and. halvings > 0)
               part = part/2
               halvings = halvings - 1
               width = 2.0_wp*width
            end do
            if (halvings == 0 .or. part > 1000000000) return
         else if (c(n) <= 0.0_wp .and. changes == 1) then
            x = real(part, wp)*width + width*single_root(c, n)
            return
         else if (part > 500000000) then
            x = real(part, wp)*width
            return
         else
            halvings = halvings + 1
            part = 2*part
            width = 0.5_wp*width
         end if
      end do
   end subroutine first_descent

   !> Bernstein coefficients on a part of the interval
   pure subroutine restrict(c, n, start, width)
      !$acc routine seq
      real(wp), intent(inout) :: c(0:9)
      integer, intent(in) :: n
      real(wp), intent(in) :: start, width

      real(wp) :: part
      integer :: j, k

      do k = 1, n
         do j = 0, n - k
            c(j) = (1.0_wp - start)*c(j) + start*c(j + 1)
         end do
      end do
      part = width/max(1.0_wp - start, tiny(start))
      if (part >= 1.0_wp) return
      do k = 1, n
         do j = n, k, -1
            c(j) = (1.0_wp - part)*c(j - 1) + part*c(j)
         end do
      end do
   end subroutine restrict

   !> The only root of a polynomial that is positive at 0 and not at 1: bisection, hastened by Newton's step
   pure real(wp) function single_root(c, n) result(x)
      !$acc routine seq
      real(wp), intent(in) :: c(0:9)
      integer, intent(in) :: n

      real(wp) :: below, above, next, b(0:9), slope
      integer :: j, k, iteration

      below = 0.0_wp
      above = 1.0_wp
      x = c(0)/(c(0) - c(n))
      do iteration = 1, 2*digits(x)
         b = c
         slope = 0.0_wp
         do k = n, 1, -1
            if (k == 1) slope = real(n, wp)*(b(1) - b(0))
            do j = 0, k - 1
               b(j) = (1.0_wp - x)*b(j) + x*b(j + 1)
            end do
         end do
         if (b(0) > 0.0_wp) then
            below = x
         else
            above = x
         end if
         next = 0.5_wp*(below + above)
         if (slope < 0.0_wp) next = x - b(0)/slope
         if (abs(next - x) <= 2.0_wp*epsilon(x)*x) exit
         if (.not. (next > below .and. next < above)) next = 0.5_wp*(below + above)
         if (next <= below .or. next >= above) exit
         x = next
      end do
   end function single_root

   !> Does a motion rise all the way?
   pure logical function rises_throughout(d, last_rate, last)
      !$acc routine seq
      real(wp), intent(in) :: d(0:9)
      !> Its rate at the end, and the place of that
      real(wp), intent(in) :: last_rate, last

      rises_throughout = min(d(1), last_rate) > last**2*(0.75_wp*abs(d(3)) + last*(3.0_wp*abs(d(4)) + last*8.0_wp*abs(d(5))))
   end function rises_throughout

   !> Where a motion that falls all the way, or rises and then falls, is at zero: Halley's method, in a bracket
   pure real(wp) function place_of_zero(d, last) result(x)
      !$acc routine seq
      real(wp), intent(in) :: d(0:9)
      !> A place after it
      real(wp), intent(in) :: last

      real(wp) :: before, after, y, v, slowness, change
      integer :: iteration

      before = 0.0_wp
      after = last
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

   !> Where a motion that rises and then falls turns: Newton's method, in a bracket
   pure real(wp) function place_of_turn(d, last) result(x)
      !$acc routine seq
      real(wp), intent(in) :: d(0:9)
      !> A place after it
      real(wp), intent(in) :: last

      real(wp) :: before, after, v, change
      integer :: iteration

      before = 0.0_wp
      after = last
      x = last*d(1)/(d(1) - rate(d, last))
      do iteration = 1, most_iterations
         v = rate(d, x)
         if (v > 0.0_wp) then
            before = x
         else
            after = x
         end if
         change = -v/bend(d, x)
         x = x + change
         if (abs(change) <= second_order*x) exit
         if (.not. (x > before .and. x < after)) x = 0.5_wp*(before + after)
      end do
      x = min(max(x, 0.0_wp), last)
   end function place_of_turn

   !> A series
   pure real(wp) function value(d, x)
      !$acc routine seq
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
      !$acc routine seq
      real(wp), intent(in) :: d(0:9)
      real(wp), intent(in) :: x

      real(wp) :: x2, x4

      x2 = x*x
      x4 = x2*x2
      rate = (d(1) + 2.0_wp*d(2)*x) + x2*(3.0_wp*d(3) + 4.0_wp*d(4)*x) &
         & + x4*((5.0_wp*d(5) + 6.0_wp*d(6)*x) + x2*(7.0_wp*d(7) + 8.0_wp*d(8)*x) + x4*(9.0_wp*d(9)))
   end function rate

   !> Second derivative of a series, up to what matters for the next step of an iteration
   pure real(wp) function bend(d, x)
      !$acc routine seq
      real(wp), intent(in) :: d(0:9)
      real(wp), intent(in) :: x

      real(wp) :: x2

      x2 = x*x
      bend = (2.0_wp*d(2) + 6.0_wp*d(3)*x) + x2*((12.0_wp*d(4) + 20.0_wp*d(5)*x) + x2*(30.0_wp*d(6)))
   end function bend

end module dondolo_gpu_events
