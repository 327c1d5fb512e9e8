!> Joints that bend before they open: what a history needs to know of them (docs/theory.md, section 7).
!>
!> Up to the rotation q_y the joints are closed, and the wall is a linear oscillator of the period T_1; beyond it they are open, and
!> the wall rocks as one of rigid blocks does.
module dondolo_wall_elastic_joint
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: elastic_joint_type

   !> The closed branch of a wall
   type :: elastic_joint_type
      !> Does the wall have one?
      logical :: exists = .false.
      !> Period T_1 of the closed wall [s], and its damping ratio
      real(wp) :: period = 0.0_wp, damping = 0.0_wp
      !> Circular frequency w = 2 pi/T_1 [rad/s]
      real(wp) :: frequency = 0.0_wp
      !> Rotation q_y at which the joints open [rad]
      real(wp) :: opening = 0.0_wp
      !> Inertia J(q_y) [kg m2], and lever L(q_y)/J(q_y) of the ground acceleration [1/m]
      real(wp) :: inertia = 0.0_wp, lever = 0.0_wp
      !> Rotational stiffness k = J(q_y) w^2 [N m/rad]
      real(wp) :: stiffness = 0.0_wp
      !> Speed v_y = w q_y, below which a passage of x = 0 loses nothing [rad/s]
      real(wp) :: speed = 0.0_wp
      !> Speed ratio e_0 of a passage, that of the wall less what damping takes of it
      real(wp) :: restitution = 0.0_wp
   contains
      !> Speed after a passage of x = 0
      procedure :: passed
      !> Spectral acceleration that opens the joints
      procedure :: opening_acceleration
   end type elastic_joint_type

contains

   !> Speed after a passage of x = 0: the wall loses the share 1 - e_0^2 of the energy with which its joints closed
   elemental real(wp) function passed(self, v)
      class(elastic_joint_type), intent(in) :: self
      !> Speed before it, at least v_y [rad/s]
      real(wp), intent(in) :: v

      associate (e => self%restitution)
         passed = sqrt(e**2*v**2 + (1.0_wp - e**2)*self%speed**2)
      end associate
   end function passed

   !> Spectral acceleration at T_1 that opens the joints, k q_y/L(q_y) [m/s2]
   elemental real(wp) function opening_acceleration(self) result(a)
      class(elastic_joint_type), intent(in) :: self

      a = self%frequency**2*self%opening/self%lever
   end function opening_acceleration

end module dondolo_wall_elastic_joint
