!> What acts on a wall besides its own weight: loads, masses that it pushes, thrusts, springs, ties and friction, per metre of wall
!> or, of a body that is no wall, in all.
!>
!> Places are a depth behind the outer face of the base and a height above the base (docs/theory.md, section 2).
module dondolo_wall_carried
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_text, only : rounded
   use dondolo_wall_restraint, only : restraint_type
   implicit none
   private

   public :: actions_type, carried_type, describe_actions, spring_type, thrust_type

   !> A load or a mass that goes with the wall
   type :: carried_type
      !> Place [m]
      real(wp) :: depth = 0.0_wp, height = 0.0_wp
      !> Its weight N [N/m]
      real(wp) :: weight = 0.0_wp
      !> Part of the weight that is a force alone: no mass moves up and down with the wall [N/m]
      real(wp) :: dead = 0.0_wp
      !> Mass that the wall pushes along and mass that it lifts [kg/m]
      real(wp) :: pushed = 0.0_wp, lifted = 0.0_wp
      !> Horizontal travel at which it loses its seat [m]; huge: never
      real(wp) :: seat = huge(1.0_wp)
   end type carried_type

   !> A horizontal force outwards
   type :: thrust_type
      !> Place [m]
      real(wp) :: depth = 0.0_wp, height = 0.0_wp
      !> Force at rest H [N/m]
      real(wp) :: force = 0.0_wp
      !> Travel D_H over which it falls to H/e, H exp(-D/D_H) [m]; huge: constant
      real(wp) :: decay = huge(1.0_wp)
   end type thrust_type

   !> A linear spring that pulls and pushes, at a point or over a height
   type :: spring_type
      !> Its depth and the heights between which it acts, equal for one at a point [m]
      real(wp) :: depth = 0.0_wp, bottom = 0.0_wp, top = 0.0_wp
      !> Stiffness: of a spring at a point [N/m per m], of a distributed one [N/m2 per m]
      real(wp) :: stiffness = 0.0_wp
   end type spring_type

   !> All that acts on a wall, and the hinge that it turns about
   type :: actions_type
      !> Loads and masses
      type(carried_type), allocatable :: carried(:)
      !> Thrusts
      type(thrust_type), allocatable :: thrusts(:)
      !> Springs
      type(spring_type), allocatable :: springs(:)
      !> Ties, then friction
      type(restraint_type), allocatable :: restraints(:)
      !> Depth u of the hinge behind the outer face [m]
      real(wp) :: hinge = 0.0_wp
      !> Radius a of the edge that the wall rolls on; the hinge at rest is then as deep [m]
      real(wp) :: edge = 0.0_wp
      !> Share of gravity in the plane of the motion: cos beta of a panel that turns about a line which rises at beta
      real(wp) :: gravity_share = 1.0_wp
      !> Are forces and masses those of a whole body, and not per metre of wall?
      logical :: is_whole = .false.
   contains
      !> What follows the units of forces and masses
      procedure :: per_metre
   end type actions_type

contains

   !> What follows the units of forces and masses: '/m', or nothing of a whole body
   pure function per_metre(self) result(text)
      class(actions_type), intent(in) :: self
      !> Filled up with blanks
      character(len=2) :: text

      text = merge('  ', '/m', self%is_whole)
   end function per_metre

   !> Describe loads and masses, a line each
   subroutine describe_actions(actions, lines)
      type(actions_type), intent(in) :: actions
      !> `subject: numbers with their units`
      type(lines_type), intent(inout) :: lines

      integer :: i

      do i = 1, size(actions%carried)
         associate (thing => actions%carried(i))
            if (thing%weight > 0.0_wp) call lines%add('load: '//rounded(thing%weight)//' N'//trim(actions%per_metre())// &
               & ' at depth '//rounded(thing%depth)//' m, height '//rounded(thing%height)//' m; pushed '// &
               & rounded(thing%pushed)//' kg'//trim(actions%per_metre())//', lifted '//rounded(thing%lifted)//' kg'// &
               & trim(actions%per_metre()))
            if (.not. thing%weight > 0.0_wp) call lines%add('mass: '//rounded(thing%pushed)//' kg/m pushed at depth '// &
               & rounded(thing%depth)//' m, height '//rounded(thing%height)//' m')
         end associate
      end do
   end subroutine describe_actions

end module dondolo_wall_carried
