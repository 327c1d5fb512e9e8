!> The state of the ties and of the friction of a wall in the course of a history.
!>
!> Each is in a mode, in which the motion is smooth. Modes change only at rotations that are known beforehand, called levels, and
!> where a motion outwards ends; what remains in them of the past is the largest rotation at which one did (docs/theory.md,
!> section 4). Friction flows whenever the wall goes where it has not been.
module dondolo_motion_restraint_state
   use dondolo_base_kinds, only : wp
   use dondolo_motion_response, only : never, tie_response_type
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_restraint, only : broken, elastic, flowing, slack, restraint_type
   implicit none
   private

   public :: restraint_state_type

   !> A tie, or friction, at present: mode, plastic elongation [m], rotation below which it is slack [rad], and times of yield and
   !> fracture [s]
   type :: tie_state_type
      integer :: mode = elastic
      real(wp) :: plastic_elongation = 0.0_wp, slack_below = 0.0_wp, time_of_yield = never, time_of_fracture = never
   end type tie_state_type

   !> Ties and friction of a wall at present
   type :: restraint_state_type
      !> Are there any?
      logical :: exists = .false.
      !> Do they hold on the side that the wall is on? The ties of a wall that rocks to both sides hold it outwards alone
      logical :: holds = .true.
      !> Does one of them flow?
      logical :: flows = .false.
      !> Have their forces at rest changed since `strike` was called last?
      logical :: changed = .false.
      !> Does a tie that has stretched become slack where the wall strikes its base? It may be taut until then by rounding
      logical :: slackens_at_base = .false.
      !> Nearest rotations above and below the present one at which a mode changes [rad]; huge and -huge: none
      real(wp) :: above = huge(1.0_wp), below = -huge(1.0_wp)
      !> Force of each tie T = force + stiffness D at present [N/m] and [N/m per m]; `set_restraints` of a wall takes them
      real(wp), allocatable :: force(:), stiffness(:)
      !> Largest rotation at which a motion outwards has ended [rad]
      real(wp), private :: reached = 0.0_wp
      !> The state of each tie
      type(tie_state_type), allocatable, private :: tie(:)
   contains
      !> The start of a history
      procedure :: begin
      !> A level is crossed
      procedure :: cross
      !> A motion outwards ends
      procedure :: turn
      !> The wall strikes its base
      procedure :: strike
      !> The wall goes to a side
      procedure :: face
      !> Rotation beyond which the end of a motion outwards must be known
      procedure :: known_peak
      !> Would friction resist a motion outwards that goes on?
      procedure :: rubs_beyond
      !> What the history did to the ties
      procedure :: responses
      procedure, private :: update
   end type restraint_state_type

contains

   !> Begin a history: the wall is at rest, or was taken to a rotation
   pure subroutine begin(self, wall, q)
      class(restraint_state_type), intent(inout) :: self
      class(mechanism_type), intent(in) :: wall
      !> Rotation, also the largest so far [rad]
      real(wp), intent(in) :: q

      integer :: ties

      self%exists = allocated(wall%restraints)
      if (.not. self%exists) return
      ties = size(wall%restraints)
      allocate (self%tie(ties))
      self%tie%mode = merge(flowing, elastic, wall%restraints%is_friction)
      allocate (self%force(ties), self%stiffness(ties), source=0.0_wp)
      if (q > 0.0_wp) call self%cross(wall, q, .true., 0.0_wp)
      call self%turn(wall, q)
   end subroutine begin

   !> Cross a level
   pure subroutine cross(self, wall, q, outwards, time)
      class(restraint_state_type), intent(inout) :: self
      class(mechanism_type), intent(in) :: wall
      !> Rotation [rad]
      real(wp), intent(in) :: q
      !> Does it move outwards?
      logical, intent(in) :: outwards
      !> Time [s]
      real(wp), intent(in) :: time

      integer :: i

      if (.not. self%holds) return
      do i = 1, size(self%tie)
         associate (tie => wall%restraints(i))
            if (.not. outwards) then
               if (self%tie(i)%mode == elastic .and. q <= self%tie(i)%slack_below) self%tie(i)%mode = slack
               cycle
            end if
            if (self%tie(i)%mode == slack .and. q >= self%tie(i)%slack_below) self%tie(i)%mode = elastic
            if (self%tie(i)%mode == elastic .and. q >= yields_at(self, tie)) then
               self%tie(i)%mode = flowing
               if (tie%fracture > tie%yield .and. self%tie(i)%time_of_yield < 0.0_wp) self%tie(i)%time_of_yield = time
            end if
            if (self%tie(i)%mode == flowing .and. q >= tie%fracture) then
               self%tie(i)%mode = broken
               self%tie(i)%plastic_elongation = tie%plastic_elongation(q)
               self%tie(i)%time_of_fracture = time
               self%changed = .true.
            end if
         end associate
      end do
      call self%update(wall)
   end subroutine cross

   !> End a motion outwards
   pure subroutine turn(self, wall, q)
      class(restraint_state_type), intent(inout) :: self
      class(mechanism_type), intent(in) :: wall
      !> Rotation [rad]
      real(wp), intent(in) :: q

      integer :: i

      if (.not. self%holds) return
      self%reached = max(self%reached, q)
      do i = 1, size(self%tie)
         if (self%tie(i)%mode /= flowing) cycle
         if (wall%restraints(i)%is_friction) then
            ! As long as the wall has not moved at all friction acts in full.
            if (.not. self%reached > 0.0_wp) cycle
            self%tie(i)%mode = slack
            self%tie(i)%slack_below = self%reached
         else
            self%tie(i)%mode = elastic
            self%tie(i)%plastic_elongation = wall%restraints(i)%plastic_elongation(merge(self%reached, q, wall%two_sided))
            self%tie(i)%slack_below = wall%restraints(i)%slack_below(self%tie(i)%plastic_elongation)
         end if
         self%changed = .true.
      end do
      call self%update(wall)
   end subroutine turn

   !> Strike the base
   pure subroutine strike(self, wall)
      class(restraint_state_type), intent(inout) :: self
      class(mechanism_type), intent(in) :: wall

      where (self%tie%mode == elastic .and. self%tie%slack_below > 0.0_wp) self%tie%mode = slack
      self%changed = .false.
      call self%update(wall)
   end subroutine strike

   !> Go to a side, at rest or at an impact
   pure subroutine face(self, wall, side)
      class(restraint_state_type), intent(inout) :: self
      class(mechanism_type), intent(in) :: wall
      !> Positive: outwards
      real(wp), intent(in) :: side

      if (.not. (self%exists .and. wall%two_sided)) return
      self%holds = side > 0.0_wp
      call self%update(wall)
   end subroutine face

   !> Rotation beyond which the end of a motion outwards must be known: the largest so far, of a wall that rocks to both sides and
   !> is on the side where its ties hold the largest there [rad]
   pure real(wp) function known_peak(self, wall, peak)
      class(restraint_state_type), intent(in) :: self
      class(mechanism_type), intent(in) :: wall
      !> Largest rotation so far [rad]
      real(wp), intent(in) :: peak

      known_peak = peak
      if (self%exists .and. wall%two_sided .and. self%holds) known_peak = min(peak, self%reached)
   end function known_peak

   !> Would a motion outwards, which has ended at the largest rotation so far, wake friction if it went on?
   pure logical function rubs_beyond(self, wall)
      class(restraint_state_type), intent(in) :: self
      class(mechanism_type), intent(in) :: wall

      rubs_beyond = any(self%tie%mode == slack .and. wall%restraints%is_friction)
   end function rubs_beyond

   !> What a history that is over did to the ties
   pure subroutine responses(self, wall, peak, response)
      class(restraint_state_type), intent(in) :: self
      class(mechanism_type), intent(in) :: wall
      !> Largest rotation [rad]
      real(wp), intent(in) :: peak
      !> Of each tie
      type(tie_response_type), allocatable, intent(out) :: response(:)

      allocate (response(wall%ties))
      associate (ties => wall%restraints(:wall%ties))
         response%plastic_elongation = ties%plastic_elongation(peak)
         response%energy = ties%strength*response%plastic_elongation
         response%broken = peak >= ties%fracture
         response%time_of_yield = self%tie(:wall%ties)%time_of_yield
         response%time_of_fracture = self%tie(:wall%ties)%time_of_fracture
      end associate
   end subroutine responses

   !> Rotation at which an elastic tie yields [rad]
   pure real(wp) function yields_at(self, tie)
      type(restraint_state_type), intent(in) :: self
      type(restraint_type), intent(in) :: tie

      yields_at = max(tie%yield, self%reached)
   end function yields_at

   !> Find the forces of the ties and of friction, and the levels that come next
   pure subroutine update(self, wall)
      class(restraint_state_type), intent(inout) :: self
      class(mechanism_type), intent(in) :: wall

      integer :: i

      self%flows = .false.
      self%slackens_at_base = .false.
      self%above = huge(self%above)
      self%below = -huge(self%below)
      if (.not. self%holds) then
         self%force = 0.0_wp
         self%stiffness = 0.0_wp
         return
      end if
      call wall%restraints%linear_force(self%tie%mode, self%tie%plastic_elongation, self%force, self%stiffness)
      do i = 1, size(self%tie)
         select case (self%tie(i)%mode)
         case (elastic)
            self%above = min(self%above, yields_at(self, wall%restraints(i)))
            if (.not. self%tie(i)%slack_below > 0.0_wp) cycle
            self%below = max(self%below, self%tie(i)%slack_below)
            self%slackens_at_base = .true.
         case (flowing)
            self%flows = .true.
            self%above = min(self%above, wall%restraints(i)%fracture)
         case (slack)
            self%above = min(self%above, self%tie(i)%slack_below)
         end select
      end do
   end subroutine update

end module dondolo_motion_restraint_state
