!> Rocking histories by the pair of Cash and Karp (orders 5 and 4) with error control, from event to event.
!>
!> No step crosses a sample. Events are bracketed on the cubic through the ends of a step, then found by Newton steps on the
!> Runge-Kutta step itself, whose length is the unknown.
module stepper
   use rocking_wall, only : gravity, state_type, wall_type
   use support_motion, only : motion_type, rk
   implicit none
   private

   public :: follow, outcome_type

   !> A history begins where what the wall feels, from above, first exceeds this part of g times its limit, and ends where a
   !> wall that hardly moves will no longer feel that other part
   real(rk), parameter :: calm = 0.5_rk
   real(rk), parameter :: calm_again = 0.9_rk

   !> Most events within a sample interval
   integer, parameter :: most_events = 5000

   !> Events are found to this part of a step or of a sample interval
   real(rk), parameter :: precision_of_events = 1.0e-11_rk
   integer, parameter :: most_iterations = 60

   !> The largest rotation as a part of the limit, 1 for collapse; times of the first start and of the peak, s; was the history
   !> given up
   type :: outcome_type
      real(rk) :: peak = 0.0_rk
      real(rk) :: start = -1.0_rk
      real(rk) :: turn = -1.0_rk
      logical :: given_up = .false.
   end type outcome_type

   integer, parameter :: stages = 6
   !> The stage at the end of a step
   integer, parameter :: at_end = 5
   real(rk), parameter :: nodes(stages) = [0.0_rk, 0.2_rk, 0.3_rk, 0.6_rk, 1.0_rk, 0.875_rk]
   real(rk), parameter :: weights(stages - 1, 2:stages) = reshape([ &
      & 1.0_rk/5.0_rk, 0.0_rk, 0.0_rk, 0.0_rk, 0.0_rk, &
      & 3.0_rk/40.0_rk, 9.0_rk/40.0_rk, 0.0_rk, 0.0_rk, 0.0_rk, &
      & 3.0_rk/10.0_rk, -9.0_rk/10.0_rk, 6.0_rk/5.0_rk, 0.0_rk, 0.0_rk, &
      & -11.0_rk/54.0_rk, 5.0_rk/2.0_rk, -70.0_rk/27.0_rk, 35.0_rk/27.0_rk, 0.0_rk, &
      & 1631.0_rk/55296.0_rk, 175.0_rk/512.0_rk, 575.0_rk/13824.0_rk, 44275.0_rk/110592.0_rk, 253.0_rk/4096.0_rk], &
      & [stages - 1, stages - 1])
   real(rk), parameter :: fifth(stages) = [37.0_rk/378.0_rk, 0.0_rk, 250.0_rk/621.0_rk, 125.0_rk/594.0_rk, 0.0_rk, &
      & 512.0_rk/1771.0_rk]
   real(rk), parameter :: fourth(stages) = [2825.0_rk/27648.0_rk, 0.0_rk, 18575.0_rk/48384.0_rk, 13525.0_rk/55296.0_rk, &
      & 277.0_rk/14336.0_rk, 0.25_rk]

   !> A history on its way
   type :: history_type
      class(wall_type), pointer :: wall => null()
      type(motion_type), pointer :: motion => null()
      real(rk) :: scale = 1.0_rk
      real(rk) :: tolerance = 0.0_rk
      integer :: i = 0
      real(rk) :: z = 0.0_rk
      !> Step that the error allows, in sample intervals
      real(rk) :: step = 1.0_rk
      type(state_type) :: state
      type(outcome_type) :: outcome
   end type history_type

   !> Where a step of some length ends
   type :: end_type
      real(rk) :: y = 0.0_rk
      real(rk) :: v = 0.0_rk
      real(rk) :: a = 0.0_rk
      real(rk) :: x(4) = 0.0_rk
      real(rk) :: error = 0.0_rk
   end type end_type

contains

   !> A wall under `scale` times a motion; `tolerance` is the largest local error of rotations, as a part of the limit, and of
   !> their speeds, as a part of the limit each second
   subroutine follow(wall, motion, scale, tolerance, outcome)
      class(wall_type), intent(in), target :: wall
      type(motion_type), intent(in), target :: motion
      real(rk), intent(in) :: scale, tolerance
      type(outcome_type), intent(out) :: outcome
      type(history_type) :: history
      real(rk) :: quiet
      integer :: i

      history%wall => wall
      history%motion => motion
      history%scale = scale
      history%tolerance = tolerance
      quiet = gravity*wall%limit/abs(scale)
      do i = 1, motion%intervals
         if (history%outcome%start < 0.0_rk .and. motion%strength(i) < calm*quiet) cycle
         if (motion%to_come(i) < calm_again*quiet .and. abs(history%state%y) < 1.0e-3_rk*wall%limit) exit
         call cross(history, i)
         if (history%outcome%given_up .or. history%outcome%peak >= 1.0_rk) exit
      end do
      outcome = history%outcome
   end subroutine follow

   !> One sample interval
   subroutine cross(history, i)
      type(history_type), intent(inout) :: history
      integer, intent(in) :: i
      integer :: events

      history%i = i
      history%z = 0.0_rk
      events = 0
      do while (history%z < 1.0_rk .and. history%outcome%peak < 1.0_rk)
         if (history%wall%moves(history%state%mode)) then
            call fly(history)
         else
            call rest(history)
         end if
         events = events + 1
         history%outcome%given_up = events > most_events
         if (history%outcome%given_up) exit
      end do
   end subroutine cross

   pure function felt(history, z) result(x)
      type(history_type), intent(in) :: history
      real(rk), intent(in) :: z
      real(rk) :: x(4)

      x = history%scale*history%motion%at(history%i, z)
   end function felt

   !> Half a sample interval, at most, of a wall at rest
   subroutine rest(history)
      type(history_type), intent(inout) :: history
      real(rk) :: from, to, begins, where
      integer :: number, first

      from = history%z
      to = min(1.0_rk, from + 0.5_rk)
      first = 0
      begins = to
      do number = 1, history%wall%urges
         where = beginning(history, number, from, to)
         if (where < begins .or. (where <= to .and. first == 0)) then
            begins = where
            first = number
         end if
      end do
      history%z = begins
      if (first == 0) then
         call history%wall%carry(history%state, felt(history, to))
         return
      end if
      call history%wall%leave(first, history%state, felt(history, begins))
      if (history%outcome%start < 0.0_rk .and. history%wall%moves(history%state%mode)) then
        history%outcome%start = (real(history%i - 1, rk) + begins)*history%motion%h
      end if
   end subroutine rest

   !> Where an urge first is positive, beyond `to` if it is not; of urges that are not forces only a change counts
   real(rk) function beginning(history, number, from, to)
      type(history_type), intent(in) :: history
      integer, intent(in) :: number
      real(rk), intent(in) :: from, to
      real(rk) :: low, high, middle

      beginning = from
      if (history%wall%urge(number, history%state, felt(history, from)) > 0.0_rk) return
      beginning = 2.0_rk
      if (history%wall%urge(number, history%state, felt(history, to)) <= 0.0_rk) return
      low = from
      high = to
      do
         middle = 0.5_rk*(low + high)
         if (middle <= low .or. middle >= high) exit
         if (history%wall%urge(number, history%state, felt(history, middle)) > 0.0_rk) then
            high = middle
         else
            low = middle
         end if
      end do
      beginning = high
   end function beginning

   !> One step, to its first event if there is one
   subroutine fly(history)
      type(history_type), intent(inout) :: history
      type(end_type) :: there, found
      real(rk) :: k1, length, where, until
      integer :: event, number

      k1 = history%wall%rate(history%state, history%state%y, history%state%v, felt(history, history%z))
      do
         length = min(history%step, 1.0_rk - history%z)
         there = advance(history, k1, length)
         if (there%error <= 1.0_rk) exit
         history%step = length*max(0.2_rk, 0.9_rk*there%error**(-0.2_rk))
      end do
      if (there%error < 0.5_rk) history%step = max(history%step, length*min(4.0_rk, 0.9_rk*max(there%error, &
         & 1.0e-6_rk)**(-0.2_rk)))
      until = length
      event = 0
      do number = 1, history%wall%levels
         call find_passage(history, number, k1, until, there, where, found)
         ! Of events at the same time the first counts
         if (where > until .or. (event > 0 .and. where > until - precision_of_events)) cycle
         event = number
         until = where
         there = found
      end do
      call see_peak(history, k1, until, there)
      history%z = history%z + until
      if (event == 0 .and. until >= 1.0_rk - (history%z - until)) history%z = 1.0_rk
      history%state%y = there%y
      history%state%v = there%v
      if (event > 0) then
         call history%wall%jump(event, history%state, there%x)
      else
         call history%wall%carry(history%state, there%x)
      end if
   end subroutine fly

   !> Step of a length in sample intervals
   function advance(history, k1, length) result(there)
      type(history_type), intent(in) :: history
      real(rk), intent(in) :: k1, length
      type(end_type) :: there
      real(rk) :: k(stages), speeds(stages), h, y, x(4)
      integer :: j

      h = length*history%motion%h
      there%x = felt(history, history%z + length)
      k(1) = k1
      speeds(1) = history%state%v
      do j = 2, stages
         y = history%state%y + h*dot_product(weights(:j - 1, j), speeds(:j - 1))
         speeds(j) = history%state%v + h*dot_product(weights(:j - 1, j), k(:j - 1))
         if (j == at_end) then
            x = there%x
         else
            x = felt(history, history%z + nodes(j)*length)
         end if
         k(j) = history%wall%rate(history%state, y, speeds(j), x)
      end do
      there%y = history%state%y + h*dot_product(fifth, speeds)
      there%v = history%state%v + h*dot_product(fifth, k)
      there%error = h*max(abs(dot_product(fifth - fourth, speeds)), abs(dot_product(fifth - fourth, k)))/ &
         & (history%tolerance*history%wall%limit)
      there%a = history%wall%rate(history%state, there%y, there%v, there%x)
   end function advance

   !> Level at the end of a step; number 0 is the speed, whose fall through zero is a peak
   subroutine look(history, number, there, g, slope)
      type(history_type), intent(in) :: history
      integer, intent(in) :: number
      type(end_type), intent(in) :: there
      real(rk), intent(out) :: g, slope

      if (number == 0) then
         g = there%v
         slope = there%a
      else
         call history%wall%level(number, history%state, there%y, there%v, there%a, there%x, g, slope)
      end if
   end subroutine look

   !> Length of the step after which a level is passed, more than `until` if it is not, and where this ends
   subroutine find_passage(history, number, k1, until, there, where, found)
      type(history_type), intent(in) :: history
      integer, intent(in) :: number
      real(rk), intent(in) :: k1, until
      type(end_type), intent(in) :: there
      real(rk), intent(out) :: where
      type(end_type), intent(out) :: found
      type(end_type) :: here
      real(rk) :: g0, s0, g1, s1, h, z

      where = 2.0_rk
      h = history%motion%h*until
      call look(history, number, there, g1, s1)
      ! Rounding alone passes a level that is only touched, again and again
      if (abs(g1) < spacing(history%wall%limit)) g1 = 0.0_rk
      if (g1 >= 0.0_rk .and. s1 <= 0.0_rk) return
      here = end_type(history%state%y, history%state%v, k1, felt(history, history%z), 0.0_rk)
      call look(history, number, here, g0, s0)
      g0 = max(g0, 0.0_rk)
      if (g1 < 0.0_rk) then
         z = falls(g0, h*s0, g1, h*s1, 1.0_rk)
         found = advance(history, k1, z*until)
         if (history%wall%counts(number, history%state, found%y, found%x)) then
           call find_root(history, number, k1, until, 1.0_rk, z, where, found)
         end if
      else if (s0 < 0.0_rk) then
         ! It may dip below zero within the step
         z = lowest(g0, h*s0, g1, h*s1)
         if (cubic(g0, h*s0, g1, h*s1, z) >= 0.0_rk) return
         found = advance(history, k1, z*until)
         call look(history, number, found, g1, s1)
         if (g1 < 0.0_rk .and. history%wall%counts(number, history%state, found%y, found%x)) then
           call find_root(history, number, k1, until, z, 0.5_rk*z, where, found)
         end if
      end if
   end subroutine find_passage

   !> Length of a step at which a level is zero that is negative at the part `last` of it, by Newton steps from a guess
   subroutine find_root(history, number, k1, length, last, guess, where, found)
      type(history_type), intent(in) :: history
      integer, intent(in) :: number
      real(rk), intent(in) :: k1, length, last, guess
      real(rk), intent(out) :: where
      type(end_type), intent(out) :: found
      real(rk) :: low, high, part, g, slope, next
      integer :: k

      low = 0.0_rk
      high = last
      part = guess
      do k = 1, most_iterations
         found = advance(history, k1, part*length)
         call look(history, number, found, g, slope)
         if (g > 0.0_rk) then
            low = part
         else
            high = part
         end if
         next = 0.5_rk*(low + high)
         if (slope < 0.0_rk) then
            if (abs(g/(slope*length*history%motion%h)) <= precision_of_events) exit
            if (part - g/(slope*length*history%motion%h) > low .and. part - g/(slope*length*history%motion%h) < high) then
              next = part - g/(slope*length*history%motion%h)
            end if
         end if
         if (high - low <= precision_of_events) exit
         part = next
      end do
      where = part*length
   end subroutine find_root

   !> The largest rotation so far, within a step or at its end
   subroutine see_peak(history, k1, until, there)
      type(history_type), intent(inout) :: history
      real(rk), intent(in) :: k1, until
      type(end_type), intent(in) :: there
      type(end_type) :: top
      real(rk) :: where, h

      h = history%motion%h*until
      where = until
      top = there
      if (history%state%v > 0.0_rk .and. there%v < 0.0_rk) then
         if (max(history%state%y, there%y) + h*history%state%v < history%outcome%peak*history%wall%limit) return
         call find_root(history, 0, k1, until, 1.0_rk, falls(history%state%v, h*k1, there%v, h*there%a, 1.0_rk), where, top)
      end if
      if (top%y <= history%outcome%peak*history%wall%limit) return
      history%outcome%peak = min(top%y/history%wall%limit, 1.0_rk)
      history%outcome%turn = (real(history%i - 1, rk) + history%z + where)*history%motion%h
   end subroutine see_peak

   !> Cubic through values and slopes, for a span of one, at both ends
   pure real(rk) function cubic(g0, s0, g1, s1, z)
      real(rk), intent(in) :: g0, s0, g1, s1, z

      cubic = (g0*(1.0_rk + 2.0_rk*z) + s0*z)*(1.0_rk - z)**2 + (g1*(3.0_rk - 2.0_rk*z) + s1*(z - 1.0_rk))*z**2
   end function cubic

   !> Where the cubic is zero between a positive beginning and `last`
   pure real(rk) function falls(g0, s0, g1, s1, last)
      real(rk), intent(in) :: g0, s0, g1, s1, last
      real(rk) :: low, high
      integer :: k

      low = 0.0_rk
      high = last
      do k = 1, 10
         falls = 0.5_rk*(low + high)
         if (cubic(g0, s0, g1, s1, falls) > 0.0_rk) then
            low = falls
         else
            high = falls
         end if
      end do
   end function falls

   !> Where the cubic is lowest, if it falls at first and rises at last
   pure real(rk) function lowest(g0, s0, g1, s1)
      real(rk), intent(in) :: g0, s0, g1, s1
      real(rk) :: b, c

      ! Slope s0 + 2 z b + 3 z2 c
      b = 3.0_rk*(g1 - g0) - 2.0_rk*s0 - s1
      c = s0 + s1 - 2.0_rk*(g1 - g0)
      lowest = -s0/(b + sqrt(max(b*b - 3.0_rk*s0*c, 0.0_rk)))
   end function lowest

end module stepper
