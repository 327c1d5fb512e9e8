!> A part of the closed motion of a wall whose joints bend before they open, as a power series in time:
!>
!>     x'' + 2 xi w x' + w^2 x = f + f' t
!>
!> Parts are so short, w t <= 0.4, that twelve terms hold the motion to 1e-13 of its size, and it turns once at most. An event is
!> found in less time than by the sines of the closed form (dondolo_motion_elastic_flow), which the engine rk45 evaluates.
module dondolo_motion_bent_part
   use dondolo_base_bracket, only : bracket_type
   use dondolo_base_kinds, only : wp
   use dondolo_motion_elastic_flow, only : at_level, at_turn, bent_type
   use dondolo_wall_elastic_joint, only : elastic_joint_type
   implicit none
   private

   public :: bent_part_type, new_bent_part
   public :: nothing, opens, passes

   !> What a part ends with
   integer, parameter :: nothing = 0, opens = 1, passes = 2

   !> Last power
   integer, parameter :: n = 11

   integer :: power
   !> Factors of the recursion
   real(wp), parameter :: by_two(2:n) = [(1.0_wp/real(power*(power - 1), wp), power=2, n)]
   real(wp), parameter :: by_one(2:n) = [(1.0_wp/real(power, wp), power=2, n)]

   !> The motion from one state on, under an acceleration that is linear in time
   type :: bent_part_type
      private
      !> Coefficients of 1, s, s^2, ... in x, with s the part of the time that has passed [rad]
      real(wp) :: c(0:n)
      !> Time that it takes [s], and rates by s over rates by time
      real(wp) :: duration = 0.0_wp, rate = 0.0_wp
   contains
      !> State at a place
      procedure :: at
      !> The first event
      procedure :: find_first
      !> The first event on a way without a turn
      procedure, private :: find_on_way
      !> Place at which a level is reached, or the motion turns
      procedure, private :: place_of
   end type bent_part_type

contains

   !> The motion from a state on
   pure function new_bent_part(joint, state, acceleration, slope, duration) result(part)
      type(elastic_joint_type), intent(in) :: joint
      !> State at its start
      type(bent_type), intent(in) :: state
      !> Ground acceleration then [m/s2], and its rate of change [m/s3]
      real(wp), intent(in) :: acceleration, slope
      !> Time that it takes [s]
      real(wp), intent(in) :: duration
      type(bent_part_type) :: part

      real(wp) :: angle, damping, square
      integer :: k

      part%duration = duration
      if (duration > 0.0_wp) part%rate = 1.0_wp/duration
      angle = joint%frequency*duration
      damping = 2.0_wp*joint%damping*angle
      square = angle**2
      associate (c => part%c)
         c(0) = state%x
         c(1) = state%v*duration
         c(2) = ((-joint%lever*acceleration*duration**2 - square*c(0)) - damping*c(1))*by_two(2)
         c(3) = (-joint%lever*slope*duration**3 - square*c(1))*by_two(3) - damping*c(2)*by_one(3)
         do k = 4, n
            c(k) = -(square*c(k - 2)*by_two(k) + damping*c(k - 1)*by_one(k))
         end do
      end associate
   end function new_bent_part

   !> State at a place
   pure type(bent_type) function at(self, s) result(state)
      class(bent_part_type), intent(in) :: self
      !> Part of the time that has passed
      real(wp), intent(in) :: s

      real(wp) :: x, v
      integer :: i

      x = self%c(n)
      v = 0.0_wp
      do i = n - 1, 0, -1
         v = v*s + x
         x = x*s + self%c(i)
      end do
      state = bent_type(x, v*self%rate)
   end function at

   !> The first event, and the state there or at the end
   pure subroutine find_first(self, joint, here, next, event, place, top, place_of_top)
      class(bent_part_type), intent(in) :: self
      type(elastic_joint_type), intent(in) :: joint
      !> State at its start
      type(bent_type), intent(in) :: here
      !> State at the event, or at the end
      type(bent_type), intent(out) :: next
      !> `opens`, `passes` (a passage of x = 0 that loses speed) or `nothing`
      integer, intent(out) :: event
      !> Place of the event, or the end
      real(wp), intent(out) :: place
      !> Largest |x| at a turn before it, 0 without one [rad], and its place
      real(wp), intent(out) :: top, place_of_top

      type(bent_type) :: turned

      top = 0.0_wp
      place_of_top = 0.0_wp
      next = self%at(1.0_wp)
      if (.not. here%v*next%v < 0.0_wp) then
         call self%find_on_way(joint, 0.0_wp, 1.0_wp, here, next, event, place)
         return
      end if
      place_of_top = self%place_of(at_turn, 0.0_wp, sign(1.0_wp, next%v), 0.0_wp, 1.0_wp, here%v/(here%v - next%v))
      turned = self%at(place_of_top)
      turned%v = 0.0_wp
      call self%find_on_way(joint, 0.0_wp, place_of_top, here, turned, event, place)
      if (event /= nothing) then
         next = turned
         return
      end if
      top = abs(turned%x)
      call self%find_on_way(joint, place_of_top, 1.0_wp, turned, next, event, place)
   end subroutine find_first

   !> The first event on a way without a turn
   pure subroutine find_on_way(self, joint, first, last, here, next, event, place)
      class(bent_part_type), intent(in) :: self
      type(elastic_joint_type), intent(in) :: joint
      !> Places at which it begins and ends
      real(wp), intent(in) :: first, last
      !> State at the first
      type(bent_type), intent(in) :: here
      !> State at the last; out: that of the event, if there is one
      type(bent_type), intent(inout) :: next
      !> The event, and its place
      integer, intent(out) :: event
      real(wp), intent(out) :: place

      type(bent_type) :: found
      real(wp) :: sense, guess

      event = nothing
      place = last
      sense = sign(1.0_wp, next%x - here%x)
      if (sense*here%x < 0.0_wp .and. .not. sense*next%x < 0.0_wp) then
         guess = first + (last - first)*(here%x/(here%x - next%x))
         place = self%place_of(at_level, 0.0_wp, sense, first, last, guess)
         found = self%at(place)
         if (abs(found%v) > joint%speed) then
            event = passes
            next = bent_type(0.0_wp, found%v)
            return
         end if
         place = last
      end if
      if (sense*next%x >= joint%opening) then
         event = opens
         guess = first + (last - first)*((joint%opening - sense*here%x)/max(sense*(next%x - here%x), epsilon(guess)*joint%opening))
         place = self%place_of(at_level, sense*joint%opening, sense, first, last, guess)
         found = self%at(place)
         next = bent_type(sense*joint%opening, found%v)
      end if
   end subroutine find_on_way

   !> Place at which a level is reached, or the motion turns, between two of which the first is before it: Newton's method, kept in
   !> the bracket by bisection
   pure real(wp) function place_of(self, what, level, sense, first, last, guess) result(s)
      class(bent_part_type), intent(in) :: self
      !> `at_level` or `at_turn`
      integer, intent(in) :: what
      !> The rotation, 0 for a turn [rad]
      real(wp), intent(in) :: level
      !> +1 if the rotation, or the velocity, grows there, -1 if it falls
      real(wp), intent(in) :: sense
      !> The two places, and one to begin with
      real(wp), intent(in) :: first, last, guess

      integer, parameter :: most_trials = 80
      type(bracket_type) :: bracket
      real(wp) :: x, v, f, gap, rate, step
      integer :: i, j

      bracket = bracket_type(first, last)
      s = guess
      if (.not. (s > first .and. s < last)) s = bracket%middle()
      do i = 1, most_trials
         x = self%c(n)
         v = 0.0_wp
         f = 0.0_wp
         if (what == at_level) then
            do j = n - 1, 0, -1
               v = v*s + x
               x = x*s + self%c(j)
            end do
            gap = sense*(level - x)
            rate = -sense*v
         else
            do j = n - 1, 0, -1
               f = f*s + v
               v = v*s + x
               x = x*s + self%c(j)
            end do
            gap = -sense*v
            rate = -2.0_wp*sense*f
         end if
         call bracket%narrow(s, gap > 0.0_wp)
         step = huge(step)
         if (rate < 0.0_wp) step = -gap/rate
         if (.not. bracket%is_divisible()) return
         if (s + step > bracket%first .and. s + step < bracket%last) then
            s = s + step
            ! The error of Newton's step is of the order of its square.
            if (abs(step) <= sqrt(epsilon(s))) return
         else
            if (abs(step) <= epsilon(s)) return
            s = bracket%middle()
         end if
      end do
   end function place_of

end module dondolo_motion_bent_part
