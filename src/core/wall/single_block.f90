!> One rectangular block that rocks about the edge of its base, to one side or to both.
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

   public :: single_block_type, new_single_block, housner_restitution, one_sided_restitution

   !> One rocking block
   type, extends(mechanism_type) :: single_block_type
      private
      !> Slenderness angle alpha [rad]
      real(wp) :: alpha
      !> Inertia about the corner I_0 [kg m2/m]
      real(wp) :: inertia
      !> M R [kg]
      real(wp) :: lever
      !> M g R [N]
      real(wp) :: weight_moment
   contains
      procedure :: terms
      procedure :: potential
      procedure :: geometric_end
      procedure :: support
   end type single_block_type

contains

   !> Make the mechanism
   pure subroutine new_single_block(mechanism, block, gravity, two_sided)
      type(single_block_type), intent(out) :: mechanism
      !> The wall as one block
      type(block_type), intent(in) :: block
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> Does it rock to both sides?
      logical, intent(in) :: two_sided

      mechanism%two_sided = two_sided
      mechanism%gravity = gravity
      mechanism%alpha = block%alpha
      mechanism%capacity = block%alpha
      mechanism%inertia = block%corner_inertia
      mechanism%lever = block%mass*block%radius
      mechanism%weight_moment = block%mass*gravity*block%radius
   end subroutine new_single_block

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

   !> Ratio of the angular velocities after and before an impact of a block that rocks to both sides: balance of angular momentum
   !> about the new corner (Housner 1963)
   pure function housner_restitution(alpha) result(eta)
      !> Slenderness angle [rad]
      real(wp), intent(in) :: alpha
      !> eta
      real(wp) :: eta

      eta = 1.0_wp - 1.5_wp*sin(alpha)**2
   end function housner_restitution

   !> The same of a block against transverse walls, equation (2) of Nale et al. (Sorrentino, AlShawa and Decanini 2011); negative:
   !> it bounces off them
   pure function one_sided_restitution(alpha) result(eta)
      !> Slenderness angle [rad]
      real(wp), intent(in) :: alpha
      !> eta_1s
      real(wp) :: eta

      eta = (1.0_wp - 1.5_wp*sin(alpha)**2)**2*(1.0_wp - 1.5_wp*cos(alpha)**2)
   end function one_sided_restitution

end module dondolo_wall_single_block
