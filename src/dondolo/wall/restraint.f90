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
   use dondolo_wall_travel, only : rotation_after, travel
   implicit none
   private

   public :: restraint_type, tie_input_type, new_friction, new_tie
   public :: elastic, flowing, slack, broken

   !> Modes, in each of which the force is smooth: T_0 + k (D - D_p); F_y, for friction F_y (1 - D/D_u); none until the wall is
   !> back at a larger rotation; none for good
   integer, parameter :: elastic = 1, flowing = 2, slack = 3, broken = 4

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

   !> A tie or friction, all per metre of wall
   type :: restraint_type
      !> Anchor from the hinge, and radius of the edge that the wall rolls on [m]
      real(wp) :: e = 0.0_wp, f = 0.0_wp, edge = 0.0_wp
      !> Stiffness k [N/m per m], force at rest T_0 and largest force F_y [N/m]
      real(wp) :: stiffness = 0.0_wp, preload = 0.0_wp, strength = 0.0_wp
      !> Elongations from rest at which it yields, D_y, and breaks, D_u [m]
      real(wp) :: yield_travel = 0.0_wp, fracture_travel = 0.0_wp
      !> Rotations at which it does [rad]; huge: never
      real(wp) :: yield = huge(1.0_wp), fracture = huge(1.0_wp)
      !> Is it friction, F_y (1 - D/D_u) at new rotations and nothing on the way back?
      logical :: is_friction = .false.
   contains
      !> Plastic elongation D_p
      procedure :: plastic_elongation
      !> Rotation below which it is slack
      procedure :: slack_below
      !> Force as a constant and a stiffness
      procedure :: linear_force
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
      tie%stiffness = input%modulus*input%area/input%length
      tie%preload = input%preload*input%area
      tie%strength = min(input%strength*input%area, input%anchor_force)
      tie%yield_travel = (tie%strength - tie%preload)/tie%stiffness
      tie%fracture_travel = input%strain*input%length - tie%preload/tie%stiffness
      ! An anchor that gives way does so at once.
      if (input%anchor_force < input%strength*input%area) tie%fracture_travel = tie%yield_travel
      tie%yield = rotation_after(edge, tie%e, tie%f, tie%yield_travel)
      tie%fracture = rotation_after(edge, tie%e, tie%f, tie%fracture_travel)
   end function new_tie

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

   !> Plastic elongation D_p after a largest rotation; of a broken tie that at which it broke [m]
   elemental real(wp) function plastic_elongation(self, largest)
      class(restraint_type), intent(in) :: self
      !> Largest rotation so far q_m [rad]
      real(wp), intent(in) :: largest

      plastic_elongation = 0.0_wp
      if (largest >= self%fracture) then
         plastic_elongation = self%fracture_travel - self%yield_travel
      else if (largest > self%yield) then
         plastic_elongation = max(0.0_wp, travel(self%edge, self%e, self%f, largest) - self%yield_travel)
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
      if (distance > 0.0_wp) slack_below = rotation_after(self%edge, self%e, self%f, distance)
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
