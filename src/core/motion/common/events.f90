!> What happens within a step: an impact, a turning point, the limit, a level at which the ties of a wall change.
!>
!> The rotation in the step is a polynomial in Bernstein form, so that no event is missed and none is found that the
!> polynomial does not have (docs/theory.md, section 5).
module dondolo_motion_events
   use dondolo_base_kinds, only : wp
   use dondolo_motion_bernstein, only : first_descent, most_coefficients, nowhere
   implicit none
   private

   public :: find_event, find_level
   public :: no_event, impact, turning, limit_reached, level_above, level_below

   !> Events within a step
   integer, parameter :: no_event = 0, impact = 1, turning = 2, limit_reached = 3, level_above = 4, level_below = 5

contains

   !> The first event within a step
   pure subroutine find_event(b, peak, limit, event, x)
      !> Bernstein coefficients of the rotation [rad]
      real(wp), intent(in) :: b(0:)
      !> Largest rotation so far [rad]
      real(wp), intent(in) :: peak
      !> Rotation that counts as collapse [rad]
      real(wp), intent(in) :: limit
      !> The event
      integer, intent(out) :: event
      !> Its place, as a part of the step
      real(wp), intent(out) :: x

      real(wp) :: d(0:most_coefficients - 2), highest, place
      integer :: n

      n = ubound(b, 1)
      highest = maxval(b)
      event = no_event
      x = nowhere
      ! Where no coefficient is negative there are no roots but at the ends; that at the start is no event.
      if (any(b < 0.0_wp) .or. b(n) <= 0.0_wp) then
         x = first_descent(b)
         if (x < nowhere) event = impact
      end if
      ! A turning point matters only where it may be a new peak.
      if (highest > peak) then
         d(:n - 1) = b(1:) - b(:n - 1)
         place = nowhere
         if (any(d(:n - 1) < 0.0_wp) .and. any(d(:n - 1) > 0.0_wp)) then
            place = first_descent(d(:n - 1)*initial_sign(d(:n - 1)))
         end if
         if (place < x) then
            x = place
            event = turning
         end if
         if (highest >= limit) then
            place = first_descent(limit - b)
            if (place < x) then
               x = place
               event = limit_reached
            end if
         end if
      end if
   end subroutine find_event

   !> A level that is crossed within a step before its first event
   pure subroutine find_level(b, above, below, event, x)
      !> Bernstein coefficients of the rotation [rad]
      real(wp), intent(in) :: b(0:)
      !> Nearest levels above and below the rotation at the start [rad]
      real(wp), intent(in) :: above, below
      !> The first event; out: the level, if that comes before it
      integer, intent(inout) :: event
      !> Its place, as a part of the step
      real(wp), intent(inout) :: x

      real(wp) :: place

      if (maxval(b) >= above) then
         place = first_descent(above - b)
         if (place < x) then
            x = place
            event = level_above
         end if
      end if
      if (minval(b) <= below) then
         place = first_descent(b - below)
         if (place < x) then
            x = place
            event = level_below
         end if
      end if
   end subroutine find_level

   !> Sign of the first coefficient that is not zero
   pure function initial_sign(c) result(s)
      !> Coefficients, not all zero
      real(wp), intent(in) :: c(:)
      !> +1 or -1
      real(wp) :: s

      s = sign(1.0_wp, c(findloc(c /= 0.0_wp, .true., dim=1)))
   end function initial_sign

end module dondolo_motion_events
