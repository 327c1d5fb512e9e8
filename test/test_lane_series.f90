!> The first event in the step of a lane: what is found at once must be what the motion does.
program test_lane_series
   use, intrinsic :: iso_fortran_env, only : int64
   use checks, only : check, finish, suite
   use dondolo_base_kinds, only : wp
   use dondolo_motion_events, only : impact, limit_reached, no_event, turning
   use dondolo_motion_lane_series, only : find_first, find_simple, rate, undecided, value
   use dondolo_motion_lane_state, only : lane_width
   use dondolo_motion_normal_form, only : y_limit
   use dondolo_record_random, only : new_random, random_type
   use random_history, only : across, argument, between, choice
   implicit none

   !> Places at which a motion is looked at, and how far two of its values may differ by rounding
   integer, parameter :: places = 500
   real(wp), parameter :: near = 1.0e-11_wp

   type(random_type) :: random
   real(wp) :: d(lane_width, 0:9), peak(lane_width), last(lane_width), x(lane_width), y(lane_width), v(lane_width)
   integer(int64) :: event(lane_width)
   real(wp) :: series(0:9), place
   integer :: batch, first, i, found(undecided:limit_reached, 2)

   random = new_random(argument(1, 17), 0)
   found = 0
   call suite('first event in a step')
   do batch = 1, argument(2, 1000)
      do i = 1, lane_width
         call new_step(series, peak(i), last(i))
         d(i, :) = series
      end do
      call find_simple(lane_width, d, peak, last, x, y, v, event)
      do i = 1, lane_width
         series = d(i, :)
         call see(series, peak(i), last(i), int(event(i)), x(i), 1)
         if (event(i) /= undecided) cycle
         place = last(i)
         call find_first(series, peak(i), place, first)
         call see(series, peak(i), last(i), first, place, 2)
      end do
   end do
   ! Motions of every kind were among them.
   call check(all(found([no_event, impact, turning], 1) > 1000), 'find_simple decides')
   call check(all(found(no_event:limit_reached, 2) > 100), 'find_first decides')
   call finish()

contains

   !> A step of some motion: from rest, from the ground, towards the ground, towards the limit, or of any kind
   subroutine new_step(d, peak, last)
      !> Its series
      real(wp), intent(out) :: d(0:9)
      !> Largest y so far
      real(wp), intent(out) :: peak
      !> Where it ends
      real(wp), intent(out) :: last

      real(wp) :: size, part
      integer :: k

      size = across(random, 1.0e-8_wp, 0.1_wp)
      part = across(random, 1.0e-3_wp, 0.4_wp)
      do k = 0, 9
         d(k) = size*part**max(0, k - 1)*between(random, -1.0_wp, 1.0_wp)
      end do
      d(3) = d(3)*choice(random, 4)
      select case (choice(random, 5))
      case (1)
         d(0:1) = 0.0_wp
         d(2) = max(0.0_wp, d(2))*(choice(random, 2) - 1)
      case (2)
         d(0) = 0.0_wp
         d(1) = abs(d(1))*across(random, 1.0e-3_wp, 1.0_wp)
      case (3)
         d(0) = abs(d(1))*between(random, 0.0_wp, 1.5_wp)
         d(1) = -abs(d(1))
      case (4)
         d(0) = y_limit - size*between(random, 0.0_wp, 1.5_wp)
      case default
         d(0) = abs(d(0))
      end select
      ! A motion that falls has turned before; at the limit it would be over.
      peak = max(0.0_wp, d(0) + size*between(random, -1.0_wp, 1.0_wp))
      if (d(1) <= 0.0_wp) peak = max(peak, d(0))
      peak = min(peak, y_limit)
      last = 1.0_wp
      if (choice(random, 4) == 1) last = between(random, 0.01_wp, 1.0_wp)
   end subroutine new_step

   !> Does a motion do up to a place what is said of it?
   subroutine see(d, peak, last, event, x, finder)
      !> The step, as above
      real(wp), intent(in) :: d(0:9), peak, last
      !> The event and its place
      integer, intent(in) :: event
      real(wp), intent(in) :: x
      !> Who said it
      integer, intent(in) :: finder

      real(wp) :: before(places), rates(places), tolerance
      integer :: k

      found(event, finder) = found(event, finder) + 1
      if (event == undecided) return
      tolerance = near*maxval(abs(d))
      before = [(value(d, x*(k - 0.5_wp)/places), k=1, places)]
      rates = [(rate(d, x*(k - 0.5_wp)/places), k=1, places)]
      call check(all(before > -tolerance) .and. all(before < y_limit + tolerance), 'nothing comes before it')
      ! A maximum below the peak is no event; one above is
      call check(all(before <= max(peak, d(0)) + tolerance .or. rates > -tolerance .or. event == turning), &
         & 'no new peak before it')
      select case (event)
      case (no_event)
         call check(x == last, 'the step has no event')
      case (impact)
         call check(abs(value(d, x)) < tolerance .and. rate(d, x) < tolerance, 'an impact')
      case (turning)
         call check(abs(rate(d, x)) < 1.0e-6_wp*maxval(abs(d(1:))) + 10.0_wp*epsilon(x)*d(0), 'a turn')
      case (limit_reached)
         call check(abs(value(d, x) - y_limit) < tolerance .and. rate(d, x) > -tolerance, 'the limit')
      end select
   end subroutine see

end program test_lane_series
