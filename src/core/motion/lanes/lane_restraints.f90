!> Ties and friction of a wall in the lanes of the engine lanes: their modes, and the coefficients of a lane that follow from them.
!>
!> All engines share the rules by which modes change (dondolo_motion_restraint_state). Here the rotations at which they do become
!> values of y, and the forces the polynomial a of the lane (dondolo_motion_normal_form).
module dondolo_motion_lane_restraints
   use dondolo_base_kinds, only : wp
   use dondolo_motion_events, only : level_above
   use dondolo_motion_lane_constants, only : lane_constants_type
   use dondolo_motion_lane_state, only : lanes_type
   use dondolo_motion_normal_form, only : highest_restrained
   use dondolo_motion_response, only : tie_response_type
   use dondolo_motion_rest, only : new_rest, rest_type
   use dondolo_motion_restrained_tail, only : restrained_motion
   use dondolo_motion_restraint_state, only : restraint_state_type
   use dondolo_motion_tail, only : tail_type
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: lane_restraints_type, longest_without_levels

   !> The ties and the friction of a wall in one lane
   type :: restrained_lane_type
      !> Their modes
      type(restraint_state_type) :: state
      !> Levels in a row that were reached without any time passing
      integer :: stalled = 0
   end type restrained_lane_type

   !> The same in all lanes
   type :: lane_restraints_type
      !> The wall, for all lanes: whatever forces its ties have, it gets those of a lane where they are needed
      class(mechanism_type), allocatable, private :: wall
      !> The lanes
      type(restrained_lane_type), allocatable, private :: lane(:)
   contains
      !> No history yet
      procedure :: make
      !> The state of a lane goes to another
      procedure :: move
      !> The start of a history
      procedure :: begin
      !> Are levels looked for?
      procedure :: looks_for_levels
      !> A level is crossed
      procedure :: cross
      !> A motion outwards ends
      procedure :: turn
      !> Where friction holds a wall: the pushes of the ground between which it does
      procedure :: held_between
      !> A motion outwards that friction has held goes on
      procedure :: go_on
      !> The wall strikes its base
      procedure :: strike
      !> The wall goes to a side
      procedure :: face
      !> The motion after the record
      procedure :: after_record
      !> What the history has done to the ties
      procedure :: responses
      procedure, private :: update
   end type lane_restraints_type

   !> Levels in a row, none of which took time, after which a step goes on without them
   integer, parameter :: most_stalled = 8

   !> Longest such step, in sample intervals: a wall that balances at a level moves as if the tie or the friction that begins to
   !> act there did not
   real(wp), parameter :: longest_without_levels = 1.0e-3_wp

contains

   !> Make room for a number of lanes
   pure subroutine make(self, wall, number)
      class(lane_restraints_type), intent(inout) :: self
      !> The wall as built
      class(mechanism_type), intent(in) :: wall
      !> The number
      integer, intent(in) :: number

      allocate (self%wall, source=wall)
      allocate (self%lane(number))
   end subroutine make

   !> Move the state of a lane to another
   pure subroutine move(self, from, to)
      class(lane_restraints_type), intent(inout) :: self
      !> The lane, and where it goes
      integer, intent(in) :: from, to

      self%lane(to) = self%lane(from)
   end subroutine move

   !> Begin a history, at rest
   pure subroutine begin(self, constants, lanes, i)
      class(lane_restraints_type), intent(inout) :: self
      type(lane_constants_type), intent(in) :: constants
      !> The lanes, and the one
      type(lanes_type), intent(inout) :: lanes
      integer, intent(in) :: i

      self%lane(i) = restrained_lane_type()
      call self%lane(i)%state%begin(self%wall, 0.0_wp)
      call self%update(constants, lanes, i)
   end subroutine begin

   !> Are levels looked for in the next step? Not after many in a row that took no time: the wall balances on one of them
   pure subroutine looks_for_levels(self, i, looks)
      class(lane_restraints_type), intent(inout) :: self
      !> The lane
      integer, intent(in) :: i
      !> Are they?
      logical, intent(out) :: looks

      looks = self%lane(i)%stalled < most_stalled
      if (.not. looks) self%lane(i)%stalled = 0
   end subroutine looks_for_levels

   !> Cross a level
   pure subroutine cross(self, constants, lanes, i, event, time, took_time, may_hold)
      class(lane_restraints_type), intent(inout) :: self
      type(lane_constants_type), intent(in) :: constants
      !> The lanes, and the one
      type(lanes_type), intent(inout) :: lanes
      integer, intent(in) :: i
      !> `level_above` or `level_below`
      integer, intent(in) :: event
      !> Time [s]
      real(wp), intent(in) :: time
      !> Has any time passed since the last level?
      logical, intent(in) :: took_time
      !> Has a motion outwards ended, where friction may hold the wall?
      logical, intent(out) :: may_hold

      associate (state => self%lane(i)%state, wall => self%wall)
         self%lane(i)%stalled = merge(0, self%lane(i)%stalled + 1, took_time)
         may_hold = .false.
         if (event == level_above) then
            lanes%y(i) = lanes%above(i)
            call state%cross(wall, state%above, .true., time)
         else if (state%flows) then
            call state%turn(wall, constants%form%rotation(lanes%y(i)))
            may_hold = state%rubs_beyond(wall)
         else
            lanes%y(i) = lanes%below(i)
            call state%cross(wall, state%below, .false., time)
         end if
         call self%update(constants, lanes, i)
      end associate
   end subroutine cross

   !> End a motion outwards
   pure subroutine turn(self, constants, lanes, i, may_hold)
      class(lane_restraints_type), intent(inout) :: self
      type(lane_constants_type), intent(in) :: constants
      !> The lanes, and the one
      type(lanes_type), intent(inout) :: lanes
      integer, intent(in) :: i
      !> May friction hold the wall there?
      logical, intent(out) :: may_hold

      associate (state => self%lane(i)%state, wall => self%wall)
         self%lane(i)%stalled = 0
         may_hold = .false.
         if (.not. state%flows) return
         call state%turn(wall, constants%form%rotation(lanes%y(i)))
         may_hold = state%rubs_beyond(wall)
         call self%update(constants, lanes, i)
      end associate
   end subroutine turn

   !> Where a motion outwards has ended: the pushes of the ground between which friction holds the wall
   pure subroutine held_between(self, constants, lanes, i, back, on)
      class(lane_restraints_type), intent(inout) :: self
      type(lane_constants_type), intent(in) :: constants
      !> The lanes, and the one
      type(lanes_type), intent(in) :: lanes
      integer, intent(in) :: i
      !> Outward acceleration of y by the ground below which the wall falls back, and above which it goes on [1/s2]
      real(wp), intent(out) :: back, on

      real(wp) :: a(0:highest_restrained), fifth, largest

      associate (state => self%lane(i)%state, wall => self%wall)
         back = -constants%form%restrained_value(lanes%a(i, :), lanes%y(i))
         ! With the friction that a further motion wakes
         largest = state%above
         call state%cross(wall, largest, .true., 0.0_wp)
         call constants%form%restrained(state%force, state%stiffness, a, fifth)
         call state%turn(wall, largest)
         on = -constants%form%restrained_value(a, lanes%y(i))
      end associate
   end subroutine held_between

   !> Go on outwards, against friction
   pure subroutine go_on(self, constants, lanes, i, time)
      class(lane_restraints_type), intent(inout) :: self
      type(lane_constants_type), intent(in) :: constants
      !> The lanes, and the one
      type(lanes_type), intent(inout) :: lanes
      integer, intent(in) :: i
      !> Time [s]
      real(wp), intent(in) :: time

      call self%lane(i)%state%cross(self%wall, self%lane(i)%state%above, .true., time)
      call self%update(constants, lanes, i)
   end subroutine go_on

   !> Strike the base
   pure subroutine strike(self, constants, lanes, i, rest)
      class(lane_restraints_type), intent(inout) :: self
      type(lane_constants_type), intent(in) :: constants
      !> The lanes, and the one
      type(lanes_type), intent(inout) :: lanes
      integer, intent(in) :: i
      !> The wall at rest, which changes where its ties have stretched
      type(rest_type), intent(inout) :: rest

      logical :: changed

      associate (state => self%lane(i)%state, wall => self%wall)
         self%lane(i)%stalled = 0
         if (.not. (state%flows .or. state%changed .or. state%slackens_at_base)) return
         ! Rounding may end a motion outwards unseen.
         if (state%flows) call state%turn(wall, constants%form%rotation(merge(lanes%y(i), lanes%peak(i), wall%two_sided)))
         changed = state%changed
         call state%strike(wall)
         if (changed) then
            call wall%set_restraints(state%force, state%stiffness)
            rest = new_rest(wall)
         end if
         call self%update(constants, lanes, i)
      end associate
   end subroutine strike

   !> Go to a side, at rest or at an impact
   pure subroutine face(self, constants, lanes, i, side, peak)
      class(lane_restraints_type), intent(inout) :: self
      type(lane_constants_type), intent(in) :: constants
      !> The lanes, and the one
      type(lanes_type), intent(inout) :: lanes
      integer, intent(in) :: i
      !> Positive: outwards; and largest rotation so far [rad]
      real(wp), intent(in) :: side, peak

      if (.not. self%wall%two_sided) return
      call self%lane(i)%state%face(self%wall, side)
      call self%update(constants, lanes, i)
      lanes%peak(i) = 0.0_wp
      associate (known => self%lane(i)%state%known_peak(self%wall, peak))
         if (known > 0.0_wp) lanes%peak(i) = constants%form%coordinate(known)
      end associate
   end subroutine face

   !> The motion after the record
   pure subroutine after_record(self, constants, i, ratio, y, v, duration, tail)
      class(lane_restraints_type), intent(inout) :: self
      type(lane_constants_type), intent(in) :: constants
      !> The lane
      integer, intent(in) :: i
      !> Speed ratio of its next impact
      real(wp), intent(in) :: ratio
      !> Coordinate, and its velocity [1/s], at the end of the record
      real(wp), intent(in) :: y, v
      !> Duration of the record [s]
      real(wp), intent(in) :: duration
      type(tail_type), intent(out) :: tail

      real(wp) :: q, j, c, g, l, load

      associate (state => self%lane(i)%state, wall => self%wall)
         q = constants%form%rotation(y)
         wall%restitution = ratio
         call wall%set_restraints(state%force, state%stiffness)
         call wall%terms(q, j, c, g, l, load)
         call restrained_motion(wall, state, constants%limit, q, v*constants%form%unit*sqrt(constants%rest%inertia/j), &
            & duration, tail)
      end associate
   end subroutine after_record

   !> What the history has done to each of the ties
   pure subroutine responses(self, i, peak, ties)
      class(lane_restraints_type), intent(in) :: self
      !> The lane
      integer, intent(in) :: i
      !> Largest rotation [rad]
      real(wp), intent(in) :: peak
      type(tie_response_type), allocatable, intent(out) :: ties(:)

      call self%lane(i)%state%responses(self%wall, peak, ties)
   end subroutine responses

   !> Give a lane the forces and the next levels of its ties
   pure subroutine update(self, constants, lanes, i)
      class(lane_restraints_type), intent(in) :: self
      type(lane_constants_type), intent(in) :: constants
      !> The lanes, and the one
      type(lanes_type), intent(inout) :: lanes
      integer, intent(in) :: i

      real(wp) :: a(0:highest_restrained)

      associate (state => self%lane(i)%state)
         call constants%form%restrained(state%force, state%stiffness, a, lanes%fifth_a(i))
         lanes%a(i, :constants%form%last) = a(:constants%form%last)
         lanes%above(i) = constants%form%coordinate(state%above)
         lanes%below(i) = 0.0_wp
         if (state%below > 0.0_wp) lanes%below(i) = constants%form%coordinate(state%below)
         ! A tie flows outwards only; rounding may end such a motion unseen.
         if (state%flows) lanes%below(i) = max(lanes%below(i), lanes%y(i))
      end associate
   end subroutine update

end module dondolo_motion_lane_restraints
