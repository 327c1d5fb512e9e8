!> The first event in the step of each flagged lane: most of them all at once, in vectors, the others one by one.
module dondolo_motion_lane_events
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_kinds, only : wp
   use dondolo_motion_events, only : no_event, turning
   use dondolo_motion_lane_constants, only : lane_constants_type
   use dondolo_motion_lane_restraints, only : lane_restraints_type, longest_without_levels
   use dondolo_motion_lane_series, only : allowed_part, find_first, find_first_level, find_room, find_simple, rate, &
      & undecided, value
   use dondolo_motion_lane_state, only : lane_width, lanes_type, part_if_restrained, step_taken, step_too_long, whole_vectors
   use dondolo_motion_step_limits, only : shortest_motion, smallest_step
   implicit none
   private

   public :: found_type, find_event, find_lane_events

   !> What is found in the steps of flagged lanes, one after another
   type :: found_type
      !> Number of flagged lanes, and which they are
      integer :: n = 0, lane(lane_width) = 0
      !> The series of their motions, the part of the step that is allowed, and their largest y so far
      real(wp) :: d(lane_width, 0:9) = 0.0_wp, last(lane_width) = 1.0_wp, peak(lane_width) = 0.0_wp
      !> Of walls with ties: the nearest levels, and by how much the motion is certain to stay between them
      real(wp) :: low(lane_width) = 0.0_wp, high(lane_width) = 0.0_wp, room(lane_width) = 0.0_wp
      !> The first event, or `undecided`
      integer(int64) :: event(lane_width) = no_event
      !> Its place, the coordinate there, and its rate of change
      real(wp) :: x(lane_width) = 1.0_wp, y(lane_width) = 0.0_wp, v(lane_width) = 0.0_wp
   end type found_type

contains

   !> Find the first event in the step of each flagged lane
   pure subroutine find_lane_events(found, lanes, active, constants)
      type(found_type), intent(inout) :: found
      !> The lanes; those whose step is too long get shorter ones
      type(lanes_type), intent(inout) :: lanes
      !> Number of those at work
      integer, intent(in) :: active
      !> The wall
      type(lane_constants_type), intent(in) :: constants

      real(wp) :: counted, d(0:9)
      integer :: i, n

      counted = merge(part_if_restrained, 1.0_wp, constants%form%is_restrained)
      n = 0
      ! Without a branch, which no processor could foresee
      do i = 1, active
         found%lane(n + 1) = i
         n = n + merge(1, 0, lanes%flag(i) /= step_taken)
      end do
      found%n = n
      do n = 1, found%n
         i = found%lane(n)
         found%d(n, 0) = lanes%y(i)
         found%d(n, 1) = lanes%v(i)*lanes%step(i)
         found%d(n, 2:) = lanes%series(i, :)*lanes%step(i)
         ! Where a motion begins its acceleration is zero, whatever rounding gives.
         if (lanes%v(i) == 0.0_wp) then
            if (lanes%y(i) == 0.0_wp .or. lanes%released(i) > 0.0_wp) found%d(n, 2) = max(0.0_wp, found%d(n, 2))
            if (lanes%released(i) < 0.0_wp) found%d(n, 2) = min(0.0_wp, found%d(n, 2))
         end if
         found%peak(n) = lanes%peak(i)
         if (constants%form%is_restrained) then
            found%low(n) = merge(lanes%below(i), -huge(1.0_wp), lanes%below(i) > 0.0_wp)
            found%high(n) = lanes%above(i)
         end if
         found%last(n) = 1.0_wp
         if (lanes%flag(i) == step_too_long) then
            associate (part => found%last(n), step => lanes%step(i))
               d = found%d(n, :)
               part = allowed_part(d, step, smallest_step*lanes%dt(i), counted, &
                  & constants%form%fifth(lanes%fifth_a(i), lanes%u(i), lanes%heavier(i)), constants%solver%rtol, constants%atol)
               if (part < 1.0_wp) then
                  lanes%next_span(i) = part*step
                  lanes%span(i) = part*step
               end if
            end associate
         end if
      end do
      if (found%n == 0) return
      call find_simple(whole_vectors(found%n), found%d, found%peak, found%last, found%x, found%y, found%v, found%event)
      if (constants%form%is_restrained) call find_room(whole_vectors(found%n), found%d, found%last, found%low, &
         & found%high, found%room)
   end subroutine find_lane_events

   !> The first event in the step of a flagged lane, and the motion there
   pure subroutine find_event(found, n, lanes, restraints, part, event)
      !> What is found, and the place of the lane in it
      type(found_type), intent(in) :: found
      integer, intent(in) :: n
      !> The lanes: y and v become those at the event
      type(lanes_type), intent(inout) :: lanes
      !> The ties; absent for a wall without
      type(lane_restraints_type), intent(inout), optional :: restraints
      !> The part of its step up to the event, or to where the step ends
      real(wp), intent(out) :: part
      !> The event
      integer, intent(out) :: event

      real(wp) :: d(0:9)
      logical :: moves, looks

      associate (i => found%lane(n))
         part = found%last(n)
         event = no_event
         moves = part*lanes%step(i) > shortest_motion*lanes%dt(i)
         looks = present(restraints) .and. moves .and. .not. found%room(n) > 0.0_wp
         if (moves) then
            part = found%x(n)
            event = int(found%event(n))
            if (event /= undecided .and. .not. looks) then
               lanes%y(i) = found%y(n)
               lanes%v(i) = found%v(n)/lanes%step(i)
               return
            end if
         end if
         d = found%d(n, :)
         if (event == undecided) then
            part = found%last(n)
            call find_first(d, lanes%peak(i), part, event)
         end if
         if (looks) then
            call restraints%looks_for_levels(i, looks)
            if (looks) then
               call find_first_level(d, found%low(n), found%high(n), part, event)
            else if (part*lanes%step(i) > longest_without_levels*lanes%dt(i)) then
               event = no_event
               part = longest_without_levels*lanes%dt(i)/lanes%step(i)
            end if
         end if
         ! A motion that begins where it turns does not turn there again: that is rounding, and would be found forever, since no
         ! time passes. It goes on a little instead.
         if (event == turning .and. d(1) == 0.0_wp .and. part*lanes%step(i) <= shortest_motion*lanes%dt(i)) then
            event = no_event
            part = min(found%last(n), shortest_motion*lanes%dt(i)/lanes%step(i))
         end if
         lanes%y(i) = value(d, part)
         if (part*lanes%step(i) > 0.0_wp) lanes%v(i) = rate(d, part)/lanes%step(i)
      end associate
   end subroutine find_event

end module dondolo_motion_lane_events
