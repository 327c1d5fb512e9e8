!> A restraint: a force that holds a wall back, and depends on its present rotation and on the largest one so far.
!>
!> A tie is linear up to its yield force, then plastic up to a strain at which it breaks. It cannot push. Its elongation D(q)
!> only grows with the rotation, and it yields only in tension, thus only at a new largest D: its plastic elongation and whether
!> it is broken follow from the largest rotation so far, q_m, alone (docs/theory.md, section 2).
!>
!> Friction that resists only a motion to new rotations is the same with other numbers: a tie that flows from the start, with a
!> force that falls with D, and is slack on every way back. So one type is enough for both, and arrays of it are elemental.
module dondolo_wall_restraint
   use dondolo_base_kinds, only : wp
   use dondolo_wall_travel, only : lever, rotation_after, travel
   use dondolo_wall_travel_series, only : travel_series_type
   implicit none
   private

   public :: link_type, restraint_type, tie_input_type, new_friction, new_tie, new_tie_along
   public :: elastic, flowing, slack, broken

   !> Modes, in each of which the force is smooth: T_0 + k (D - D_p); F_y, for friction F_y (1 - D/D_u); none until the wall is
   !> back at a larger rotation; none for good
   integer, parameter :: elastic = 1, flowing = 2, slack = 3, broken = 4

   !> Smallest cosine of the angle of the diagonal of an upper block: it vanishes where the block lies flat
   real(wp), parameter :: smallest_cosine = 1.0e-5_wp

   !> A tie as a user describes it
   type :: tie_input_type
      !> Place of its anchor: depth behind the outer face and height above the base [m]
      real(wp) :: depth = 0.0_wp, height = 0.0_wp
      !> Section per metre of wall [m2/m], and length that is free to stretch [m]
      real(wp) :: area = 0.0_wp, length = 0.0_wp
      !> Modulus of elasticity, yield stress and stress at rest [Pa]
      real(wp) :: modulus = 0.0_wp, strength = 0.0_wp, preload = 0.0_wp
      !> Strain at which it breaks, from the unstressed bar
      real(wp) :: strain = 0.0_wp
      !> Force at which its anchor breaks [N/m]; huge: it holds
      real(wp) :: anchor_force = huge(1.0_wp)
   end type tie_input_type

   !> How the upper block of a strip turns with its lower one, by q: its hinges at base and top remain on one vertical line,
   !> R2 sin(alpha2 - p) = R1 sin(alpha1 - q) (docs/theory.md, section 2)
   type :: link_type
      !> R1, alpha1, R2, alpha2 [m, rad]
      real(wp) :: lower_radius = 0.0_wp, lower_alpha = 0.0_wp, upper_radius = 0.0_wp, upper_alpha = 0.0_wp
      !> Is what it is of on the upper block? Else it turns by q
      logical :: is_upper = .false.
   contains
      !> Rotation p of the block
      procedure :: turned
      !> dp/dq
      procedure :: rate
      !> Rotation q at which the block has turned by p
      procedure :: rotation
   end type link_type

   !> A tie or friction, per metre of wall or of a whole body
   type :: restraint_type
      !> Anchor from the hinge, of the upper block of a strip from the hinge at its top downwards, and radius of the edge that the
      !> wall rolls on [m]
      real(wp) :: e = 0.0_wp, f = 0.0_wp, edge = 0.0_wp
      !> The block of a strip that it holds
      type(link_type) :: link
      !> Instead of these: its elongation along any mechanism
      type(travel_series_type) :: along
      !> Stiffness k [N/m per m], force at rest T_0 and largest force F_y [N/m]
      real(wp) :: stiffness = 0.0_wp, preload = 0.0_wp, strength = 0.0_wp
      !> Elongations from rest at which it yields, D_y, and breaks, D_u [m]
      real(wp) :: yield_travel = 0.0_wp, fracture_travel = 0.0_wp
      !> Rotations at which it does [rad]; huge: never
      real(wp) :: yield = huge(1.0_wp), fracture = huge(1.0_wp)
      !> Is it friction, F_y (1 - D/D_u) at new rotations and nothing on the way back?
      logical :: is_friction = .false.
   contains
      !> Elongation D from rest, and its lever dD/dq
      procedure :: elongation
      procedure :: lever_at
      !> Take the tie of a wall of one block for one of the upper block of a strip
      procedure :: move_up
      !> Plastic elongation D_p
      procedure :: plastic_elongation
      !> Rotation below which it is slack
      procedure :: slack_below
      !> Force as a constant and a stiffness
      procedure :: linear_force
      procedure, private :: rotation_at
      procedure, private :: set_forces
   end type restraint_type

contains

   !> Make a tie
   pure function new_tie(input, hinge, edge) result(tie)
      !> Its input, checked
      type(tie_input_type), intent(in) :: input
      !> Depth of the hinge, and radius of the edge [m]
      real(wp), intent(in) :: hinge, edge
      type(restraint_type) :: tie

      tie%e = input%depth - hinge
      tie%f = input%height - edge
      tie%edge = edge
      call tie%set_forces(input)
   end function new_tie

   !> Make a tie of any mechanism
   pure function new_tie_along(input, along) result(tie)
      !> Its input, checked; its depth and its height do not count
      type(tie_input_type), intent(in) :: input
      !> Its elongation
      type(travel_series_type), intent(in) :: along
      type(restraint_type) :: tie

      tie%along = along
      call tie%set_forces(input)
   end function new_tie_along

   !> Set what follows from the bar and its anchor
   pure subroutine set_forces(self, input)
      !> Its elongation is known
      class(restraint_type), intent(inout) :: self
      type(tie_input_type), intent(in) :: input

      self%stiffness = input%modulus*input%area/input%length
      self%preload = input%preload*input%area
      self%strength = min(input%strength*input%area, input%anchor_force)
      self%yield_travel = (self%strength - self%preload)/self%stiffness
      self%fracture_travel = input%strain*input%length - self%preload/self%stiffness
      ! An anchor that gives way does so at once.
      if (input%anchor_force < input%strength*input%area) self%fracture_travel = self%yield_travel
      self%yield = self%rotation_at(self%yield_travel)
      self%fracture = self%rotation_at(self%fracture_travel)
   end subroutine set_forces

   !> Make a friction that resists only a motion to new rotations
   pure function new_friction(depth, height, force, travelled, hinge, edge) result(tie)
      !> Where it acts: depth behind the outer face and height above the base [m]
      real(wp), intent(in) :: depth, height
      !> Force at rest [N/m], and travel over which it falls to nothing [m]
      real(wp), intent(in) :: force, travelled
      !> Depth of the hinge, and radius of the edge [m]
      real(wp), intent(in) :: hinge, edge
      type(restraint_type) :: tie

      tie%is_friction = .true.
      tie%e = depth - hinge
      tie%f = height - edge
      tie%edge = edge
      tie%preload = force
      tie%strength = force
      tie%yield_travel = 0.0_wp
      tie%fracture_travel = travelled
      tie%yield = 0.0_wp
      tie%fracture = rotation_after(edge, tie%e, tie%f, travelled)
   end function new_friction

   !> Rotation p of the block of a strip when its lower block has turned by q [rad]
   elemental real(wp) function turned(self, q) result(p)
      class(link_type), intent(in) :: self
      real(wp), intent(in) :: q

      p = q
      if (self%is_upper) p = self%upper_alpha - asin(max(-1.0_wp, min(1.0_wp, &
         & self%lower_radius*sin(self%lower_alpha - q)/self%upper_radius)))
   end function turned

   !> dp/dq
   elemental real(wp) function rate(self, q)
      class(link_type), intent(in) :: self
      !> [rad]
      real(wp), intent(in) :: q

      rate = 1.0_wp
      if (self%is_upper) rate = self%lower_radius*cos(self%lower_alpha - q) &
         & /(self%upper_radius*max(smallest_cosine, cos(self%upper_alpha - self%turned(q))))
   end function rate

   !> Rotation q at which the block has turned by p; huge: it never has [rad]
   elemental real(wp) function rotation(self, p) result(q)
      class(link_type), intent(in) :: self
      real(wp), intent(in) :: p

      real(wp) :: sine

      q = p
      if (.not. (self%is_upper .and. p < huge(p))) return
      sine = self%upper_radius*sin(self%upper_alpha - p)/self%lower_radius
      q = huge(q)
      if (sine > -1.0_wp) q = self%lower_alpha - asin(min(1.0_wp, sine))
   end function rotation

   !> Elongation D from rest [m]
   elemental real(wp) function elongation(self, q)
      class(restraint_type), intent(in) :: self
      !> Rotation [rad]
      real(wp), intent(in) :: q

      if (self%along%exists()) then
         elongation = self%along%travelled(q)
      else
         elongation = travel(self%edge, self%e, self%f, self%link%turned(q))
      end if
   end function elongation

   !> Its lever dD/dq [m]
   elemental real(wp) function lever_at(self, q)
      class(restraint_type), intent(in) :: self
      !> Rotation [rad]
      real(wp), intent(in) :: q

      if (self%along%exists()) then
         lever_at = self%along%lever_at(q)
      else
         lever_at = self%link%rate(q)*lever(self%edge, self%e, self%f, self%link%turned(q))
      end if
   end function lever_at

   !> Rotation at which its elongation is a distance; huge: it never is [rad]
   elemental real(wp) function rotation_at(self, distance) result(q)
      class(restraint_type), intent(in) :: self
      !> At least 0 [m]
      real(wp), intent(in) :: distance

      if (self%along%exists()) then
         q = self%along%rotation_after(distance)
      else
         q = self%link%rotation(rotation_after(self%edge, self%e, self%f, distance))
      end if
   end function rotation_at

   !> Take the tie of a wall of one block for one of the upper block of a strip
   elemental subroutine move_up(self, height, link)
      class(restraint_type), intent(inout) :: self
      !> Height of the strip [m]
      real(wp), intent(in) :: height
      !> How that block turns
      type(link_type), intent(in) :: link

      self%f = height - self%f
      self%link = link
      self%yield = self%rotation_at(self%yield_travel)
      self%fracture = self%rotation_at(self%fracture_travel)
   end subroutine move_up

   !> Plastic elongation D_p after a largest rotation; of a broken tie that at which it broke [m]
   elemental real(wp) function plastic_elongation(self, largest)
      class(restraint_type), intent(in) :: self
      !> Largest rotation so far q_m [rad]
      real(wp), intent(in) :: largest

      plastic_elongation = 0.0_wp
      if (largest >= self%fracture) then
         plastic_elongation = self%fracture_travel - self%yield_travel
      else if (largest > self%yield) then
         plastic_elongation = max(0.0_wp, self%elongation(largest) - self%yield_travel)
      end if
   end function plastic_elongation

   !> Rotation below which it is slack, 0 if it never is [rad]
   elemental real(wp) function slack_below(self, plastic_elongation)
      class(restraint_type), intent(in) :: self
      !> Plastic elongation D_p [m]
      real(wp), intent(in) :: plastic_elongation

      real(wp) :: distance

      distance = plastic_elongation - self%preload/self%stiffness
      slack_below = 0.0_wp
      if (distance > 0.0_wp) slack_below = self%rotation_at(distance)
   end function slack_below

   !> Its force as a constant and a stiffness: T = force + stiffness D
   elemental subroutine linear_force(self, mode, plastic_elongation, force, stiffness)
      class(restraint_type), intent(in) :: self
      !> One of the modes
      integer, intent(in) :: mode
      !> Plastic elongation D_p [m]
      real(wp), intent(in) :: plastic_elongation
      !> Constant part [N/m] and stiffness [N/m per m]
      real(wp), intent(out) :: force, stiffness

      force = 0.0_wp
      stiffness = 0.0_wp
      select case (mode)
      case (elastic)
         force = self%preload - self%stiffness*plastic_elongation
         stiffness = self%stiffness
      case (flowing)
         force = self%strength
         if (self%is_friction) stiffness = -self%strength/self%fracture_travel
      end select
   end subroutine linear_force

end module dondolo_wall_restraint
