!> A mechanism: what the motion needs to know of a wall, and nothing more.
!>
!> Every mechanism has one rotation q >= 0 and a side s = +1 or -1 (docs/theory.md, section 1):
!>
!>     J(q) q'' + C(q) q'^2 + G(q) (1 + v_g''(t)/g) = -s L(q) u_g''(t) + Q(q)
!>
!> All terms are per metre of wall length.
module dondolo_wall_mechanism
   use dondolo_base_kinds, only : wp
   use dondolo_wall_elastic_joint, only : elastic_joint_type
   use dondolo_wall_restitution_scatter, only : restitution_scatter_type
   use dondolo_wall_restraint, only : restraint_type
   implicit none
   private

   public :: mechanism_type

   !> One-degree-of-freedom rocking mechanism
   type, abstract :: mechanism_type
      !> Can it rock to both sides? If so the side changes at every impact
      logical :: two_sided = .false.
      !> Is its motion not known, so that it has no time histories?
      logical :: is_static = .false.
      !> Gravity [m/s2], which vertical ground acceleration adds to
      real(wp) :: gravity = 0.0_wp
      !> Rotation q_c at which the restoring moment G - Q vanishes [rad]
      real(wp) :: capacity = 0.0_wp
      !> Speed after an impact / speed before it, 0 <= e < 1: as built the mean of all impacts, in a history that of the next one
      real(wp) :: restitution = 0.0_wp
      !> How it varies from impact to impact
      type(restitution_scatter_type) :: scatter
      !> Joints that bend before they open
      type(elastic_joint_type) :: joint
      !> Rotations between which the terms are defined; no step goes to them or beyond [rad]
      real(wp) :: lowest = -huge(1.0_wp), highest = huge(1.0_wp)
      !> Rotation at which a load loses its seat, which counts as collapse [rad]; huge: none does
      real(wp) :: unseating = huge(1.0_wp)
      !> Ties, then friction; not allocated: none. As built no tie has yielded, and terms and potential are those of a wall
      !> that its ties hold with T_0 + k D and friction with F (1 - D/D_u); `set_restraints` puts other forces in their place
      type(restraint_type), allocatable :: restraints(:)
      !> How many of them are ties
      integer :: ties = 0
      !> Moment of the ties at rest, as built [N m]
      real(wp) :: preload = 0.0_wp
   contains
      !> J, C, G, L and Q at a rotation
      procedure(terms_interface), deferred :: terms
      !> Potential energy V with V' = G - Q
      procedure(potential_interface), deferred :: potential
      !> Rotation that the geometry cannot pass
      procedure(rotation_interface), deferred :: geometric_end
      !> How the motion of its supports moves it
      procedure(support_interface), deferred :: support
      !> Set the forces of ties and friction
      procedure :: set_restraints
      !> Whether friction acts on it
      procedure :: has_friction
      !> Whether it is the same to both sides
      procedure :: is_symmetric
      !> Whether it knows which part of its moment vertical motion of the ground changes
      procedure :: knows_vertical
      !> Restoring moment G - Q
      procedure :: moment
      !> Ground acceleration that balances it at a rotation
      procedure :: balancing_acceleration
      !> Ground acceleration at which it begins to rock
      procedure :: trigger_acceleration
      !> Frequency parameter p
      procedure :: frequency_parameter
      !> Largest speed ratio of an impact
      procedure :: largest_restitution
   end type mechanism_type

   abstract interface

      !> The terms of the equation of motion
      pure subroutine terms_interface(self, q, j, c, g, l, load)
         import :: mechanism_type, wp
         class(mechanism_type), intent(in) :: self
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
      end subroutine terms_interface

      !> Potential energy of gravity and of carried loads
      pure function potential_interface(self, q) result(v)
         import :: mechanism_type, wp
         class(mechanism_type), intent(in) :: self
         !> Rotation [rad]
         real(wp), intent(in) :: q
         !> V [J]
         real(wp) :: v
      end function potential_interface

      !> A rotation that is a property of the mechanism
      pure function rotation_interface(self) result(q)
         import :: mechanism_type, wp
         class(mechanism_type), intent(in) :: self
         !> Rotation [rad]
         real(wp) :: q
      end function rotation_interface

      !> How the motion of its supports moves a wall: with h the height of the line through them, a the acceleration of each and
      !> delta the displacement of the upper less that of the lower one, it moves as on a ground that accelerates by
      !> a_base + k (a_top - a_base) - tau delta (docs/theory.md, section 1)
      pure subroutine support_interface(self, share, tilt)
         import :: mechanism_type, wp
         class(mechanism_type), intent(in) :: self
         !> k h [m]; 0: the wall touches nothing but its base
         real(wp), intent(out) :: share
         !> tau h [m/s2]
         real(wp), intent(out) :: tilt
      end subroutine support_interface

   end interface

contains

   !> Set the forces of ties and friction, T = force + stiffness D: terms and potential then contain them. Mechanisms that can have
   !> neither inherit this, which does nothing
   pure subroutine set_restraints(self, force, stiffness)
      class(mechanism_type), intent(inout) :: self
      !> Of each of them [N/m] and [N/m per m]
      real(wp), intent(in) :: force(:), stiffness(:)

      associate (of => self, that => force, and => stiffness)
      end associate
   end subroutine set_restraints

   !> Whether friction acts on the wall
   pure logical function has_friction(self)
      class(mechanism_type), intent(in) :: self

      has_friction = .false.
      if (allocated(self%restraints)) has_friction = any(self%restraints%is_friction)
   end function has_friction

   !> Whether the wall is the same to both sides: ties hold it outwards alone
   pure logical function is_symmetric(self)
      class(mechanism_type), intent(in) :: self

      is_symmetric = self%two_sided .and. .not. allocated(self%restraints)
   end function is_symmetric

   !> Whether the wall knows which part of its moment vertical motion of the ground changes: it does
   pure logical function knows_vertical(self)
      class(mechanism_type), intent(in) :: self

      associate (of => self)
      end associate
      knows_vertical = .true.
   end function knows_vertical

   !> Restoring moment G - Q, ties included [N m]
   elemental real(wp) function moment(self, q)
      class(mechanism_type), intent(in) :: self
      !> Rotation [rad]
      real(wp), intent(in) :: q

      real(wp) :: j, c, g, l, load

      call self%terms(q, j, c, g, l, load)
      moment = g - load
   end function moment

   !> Ground acceleration that balances the wall at a rotation: (G - Q)/L [m/s2]
   elemental real(wp) function balancing_acceleration(self, q) result(a)
      class(mechanism_type), intent(in) :: self
      !> Rotation [rad]
      real(wp), intent(in) :: q

      real(wp) :: j, c, g, l, load

      call self%terms(q, j, c, g, l, load)
      a = (g - load)/l
   end function balancing_acceleration

   !> Ground acceleration at which rocking begins (docs/theory.md, section 2) [m/s2]
   pure real(wp) function trigger_acceleration(self) result(a)
      class(mechanism_type), intent(in) :: self

      a = self%balancing_acceleration(0.0_wp)
   end function trigger_acceleration

   !> Frequency parameter of the wall without its ties, p^2 = (G(0) - Q(0))/(J(0) sin q_c), 3g/(4R) for one block
   !> (docs/theory.md, section 2)
   pure function frequency_parameter(self) result(p)
      class(mechanism_type), intent(in) :: self
      !> p [rad/s]
      real(wp) :: p

      real(wp) :: j, c, g, l, load

      call self%terms(0.0_wp, j, c, g, l, load)
      p = sqrt((g - load - self%preload)/(j*sin(self%capacity)))
   end function frequency_parameter

   !> Largest speed after an impact / speed before it, of all impacts that there may be
   pure real(wp) function largest_restitution(self)
      class(mechanism_type), intent(in) :: self

      largest_restitution = self%restitution
      if (self%scatter%exists()) largest_restitution = self%scatter%largest()
   end function largest_restitution

end module dondolo_wall_mechanism
