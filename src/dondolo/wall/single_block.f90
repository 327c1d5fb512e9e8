!> One block that rotates about its base corner: the terms shared by the one-sided and the free-standing wall.
!>
!> Equation (1) of Nale et al. in the common form (docs/theory.md, section 2):
!>
!>     J = I_0    C = 0    G = M g R sin(alpha - q)    L = M R cos(alpha - q)    Q = 0    q_c = alpha
module dondolo_wall_single_block
   use dondolo_base_kinds, only : wp
   use dondolo_wall_block, only : block_type
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: single_block_type

   !> One rocking block
   type, extends(mechanism_type) :: single_block_type
      !> Slenderness angle alpha [rad]
      real(wp) :: alpha
      !> Inertia about the corner I_0 [kg m2/m]
      real(wp) :: inertia
      !> M R [kg]
      real(wp) :: lever
      !> M g R [N]
      real(wp) :: weight_moment
   contains
      !> Take geometry and gravity
      procedure :: take_block
      procedure :: terms
      procedure :: potential
      procedure :: geometric_end
      procedure :: support
   end type single_block_type

contains

   !> Take the geometry of a block and the gravity it stands in
   pure subroutine take_block(self, block, gravity)
      class(single_block_type), intent(inout) :: self
      type(block_type), intent(in) :: block
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity

      self%gravity = gravity
      self%alpha = block%alpha
      self%capacity = block%alpha
      self%inertia = block%corner_inertia
      self%lever = block%mass*block%radius
      self%weight_moment = block%mass*gravity*block%radius
   end subroutine take_block

   !> Terms of equation (1)
   pure subroutine terms(self, q, j, c, g, l, load)
      class(single_block_type), intent(in) :: self
      !> Rotation [rad]
      real(wp), intent(in) :: q
      !> Inertia J [kg m2]
      real(wp), intent(out) :: j
      !> C = 1/2 dJ/dq [kg m2]
      real(wp), intent(out) :: c
      !> Restoring moment of gravity G [N m]
      real(wp), intent(out) :: g
      !> Excitation lever L [kg m]
      real(wp), intent(out) :: l
      !> Generalised force Q of carried loads [N m]
      real(wp), intent(out) :: load

      j = self%inertia
      c = 0.0_wp
      g = self%weight_moment*sin(self%alpha - q)
      l = self%lever*cos(self%alpha - q)
      load = 0.0_wp
   end subroutine terms

   !> Potential energy V = M g R cos(alpha - q)
   pure function potential(self, q) result(v)
      class(single_block_type), intent(in) :: self
      !> Rotation [rad]
      real(wp), intent(in) :: q
      !> V [J]
      real(wp) :: v

      v = self%weight_moment*cos(self%alpha - q)
   end function potential

   !> The rotation at which the centroid is level with the corner: the block lies on the ground long before
   pure function geometric_end(self) result(q)
      class(single_block_type), intent(in) :: self
      !> Rotation [rad]
      real(wp) :: q

      real(wp), parameter :: right_angle = acos(0.0_wp)

      q = self%alpha + right_angle
   end function geometric_end

   !> A one-sided block turns with what it leans on until it leaves it: k h = J/L and tau h = g at q = 0, with L = M h_c.
   !> A free-standing one touches its base alone
   pure subroutine support(self, share, tilt)
      class(single_block_type), intent(in) :: self
      !> k h [m]
      real(wp), intent(out) :: share
      !> tau h [m/s2]
      real(wp), intent(out) :: tilt

      share = 0.0_wp
      tilt = 0.0_wp
      if (self%two_sided) return
      share = self%inertia/(self%lever*cos(self%alpha))
      tilt = self%gravity
   end subroutine support

end module dondolo_wall_single_block
