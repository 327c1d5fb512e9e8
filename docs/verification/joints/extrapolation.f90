!> Histories of a bent strip by extrapolated midpoint steps (Gragg, Bulirsch and Stoer), in both branches.
!>
!> No step crosses a sample or a turn. Between two turns the rotation is monotone, so that the first level in its way is the next
!> event; the length of the step that reaches it is found by regula falsi (Illinois) on whole steps.
module extrapolation
   use bent_strip, only : rk, strip_type
   implicit none
   private

   public :: follow, outcome_type

   integer, parameter :: columns = 9
   !> Local error over the rotation and the opening
   real(rk), parameter :: tolerance = 1.0e-14_rk
   !> Longest step of closed joints over their period
   real(rk), parameter :: longest = 1.0_rk/16.0_rk
   integer, parameter :: most_events = 1000000

   !> Peak with its side and its time, whether it is collapse, openings, and passages that lose energy
   type :: outcome_type
      real(rk) :: peak = 0.0_rk, time = 0.0_rk
      logical :: collapsed = .false.
      integer :: openings = 0, passages = 0
   end type outcome_type

contains

   !> Follow a strip, at rest at first, under a ground acceleration at intervals h, and `after` it
   subroutine follow(strip, ground, h, after, limit, outcome)
      type(strip_type), intent(in) :: strip
      real(rk), intent(in) :: ground(:), h, after
      !> Rotation that ends it
      real(rk), intent(in) :: limit
      type(outcome_type), intent(out) :: outcome

      real(rk) :: y(2), last, left, step, to(2), reached, level, from, slope, side
      logical :: is_open
      integer :: k, events

      y = 0.0_rk
      is_open = .false.
      last = longest*2.0_rk*acos(-1.0_rk)/strip%w
      events = 0
      samples: do k = 1, size(ground)
         from = ground(k)
         slope = 0.0_rk
         left = after
         if (k < size(ground)) then
            left = h
            slope = (ground(k + 1) - ground(k))/h
         else
            from = 0.0_rk
         end if
         reached = 0.0_rk
         do while (left - reached > 1.0e-13_rk*left)
            step = min(left - reached, last)
            ! It turned back at the very opening
            if (abs(y(1)) <= strip%opening .and. y(1)*y(2) < 0.0_rk) is_open = .false.
            call advance(strip, is_open, y, step, from + slope*reached, slope, to)
            ! A turn ends the step
            if (y(2)*to(2) < 0.0_rk) call find(2, 0.0_rk, step, to)
            side = sign(1.0_rk, to(1) - y(1))
            level = next_level(y(1), side)
            if ((to(1) - level)*side > 0.0_rk) then
               call find(1, level, step, to)
               call pass(level, side, reached + step, to)
               if (outcome%collapsed) exit samples
            else if (abs(to(1)) > abs(outcome%peak)) then
               outcome%peak = to(1)
               outcome%time = h*(k - 1) + reached + step
            end if
            y = to
            reached = reached + step
            events = events + 1
            if (events > most_events) error stop 'a history without end'
         end do
      end do samples

   contains

      !> First level beyond a rotation on the way to a side
      pure real(rk) function next_level(x, side) result(level)
         real(rk), intent(in) :: x, side

         real(rk) :: levels(5)

         levels = [0.0_rk, strip%opening, -strip%opening, limit, -limit]
         level = side*minval(side*levels, mask=side*(levels - x) > 0.0_rk)
      end function next_level

      !> What happens at a level
      subroutine pass(level, side, instant, y)
         real(rk), intent(in) :: level, side, instant
         real(rk), intent(inout) :: y(2)

         if (abs(level) >= limit) then
            outcome%collapsed = .true.
            outcome%peak = level
            outcome%time = h*(k - 1) + instant
         else if (abs(level) > 0.0_rk) then
            is_open = level*side > 0.0_rk
            if (is_open) outcome%openings = outcome%openings + 1
         else if (abs(y(2)) > strip%speed) then
            outcome%passages = outcome%passages + 1
            y(2) = side*sqrt(strip%speed**2 + strip%ratio**2*(y(2)**2 - strip%speed**2))
         end if
      end subroutine pass

      !> Shorten a step to where a component of the state has a value
      subroutine find(part, value, step, to)
         integer, intent(in) :: part
         real(rk), intent(in) :: value
         real(rk), intent(inout) :: step, to(2)

         real(rk) :: a, b, fa, fb, f, s
         integer :: n

         a = 0.0_rk
         b = step
         fa = y(part) - value
         fb = to(part) - value
         do n = 1, 100
            s = (a*fb - b*fa)/(fb - fa)
            if (.not. (s > min(a, b) .and. s < max(a, b))) s = 0.5_rk*(a + b)
            call advance(strip, is_open, y, s, from + slope*reached, slope, to)
            f = to(part) - value
            if (.not. abs(f) > 0.0_rk .or. abs(b - a) <= 4.0_rk*epsilon(1.0_rk)*step) exit
            if (f*fb < 0.0_rk) then
               a = b
               fa = fb
            else
               fa = 0.5_rk*fa
            end if
            b = s
            fb = f
         end do
         to(part) = value
         step = s
      end subroutine find

   end subroutine follow

   !> A step of midpoint rules with more and more parts, extrapolated; halved until it is accurate
   recursive subroutine advance(strip, is_open, y, step, ground, slope, to)
      type(strip_type), intent(in) :: strip
      logical, intent(in) :: is_open
      real(rk), intent(in) :: y(2), step, ground, slope
      real(rk), intent(out) :: to(2)

      real(rk) :: table(2, columns), old(2), before(2), now(2), next(2), part, ratio, half(2), scale
      integer :: k, m, n

      scale = abs(y(1)) + strip%opening
      do k = 1, columns
         n = 2*k
         part = step/n
         before = y
         now = y + part*rate(y, 0.0_rk)
         do m = 1, n - 1
            next = before + 2.0_rk*part*rate(now, m*part)
            before = now
            now = next
         end do
         next = 0.5_rk*(now + before + part*rate(now, step))
         old = next
         do m = 1, k - 1
            ratio = (real(k, rk)/real(k - m, rk))**2
            half = table(:, m)
            table(:, m) = old
            old = old + (old - half)/(ratio - 1.0_rk)
         end do
         table(:, k) = old
         if (k < 4) cycle
         if (abs(old(1) - table(1, k - 1)) <= tolerance*scale .and. abs(old(2) - table(2, k - 1)) <= tolerance*scale*strip%w) then
            to = old
            return
         end if
      end do
      to = old
      if (step*strip%w < 1.0e-4_rk) return
      call advance(strip, is_open, y, 0.5_rk*step, ground, slope, half)
      call advance(strip, is_open, half, 0.5_rk*step, ground + 0.5_rk*step*slope, slope, to)

   contains

      !> Speed and acceleration
      pure function rate(y, instant)
         real(rk), intent(in) :: y(2), instant
         real(rk) :: rate(2)

         real(rk) :: j, c, m, l, side

         if (is_open) then
            side = sign(1.0_rk, y(1))
            call strip%terms(abs(y(1)), j, c, m, l)
            rate = [y(2), -(l*(ground + slope*instant) + side*(c*y(2)**2 + m))/j]
         else
            rate = [y(2), -strip%lever/strip%inertia*(ground + slope*instant) - strip%w*(2.0_rk*strip%xi*y(2) + strip%w*y(1))]
         end if
      end function rate

   end subroutine advance

end module extrapolation
