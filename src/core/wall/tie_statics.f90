!> What follows from a wall with ties without a history: what a largest rotation does to them, and the accelerations that the
!> wall withstands statically: at which it begins to move, the greatest of all, and that of a mechanism whose ties all yield
!> at once, which design calls alpha_0 g (docs/theory.md, section 2).
module dondolo_wall_tie_statics
   use dondolo_base_kinds, only : wp
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_restraint, only : broken, elastic, flowing
   implicit none
   private

   public :: greatest_acceleration, set_plastic_restraints, plastic_acceleration, ties_after

   !> Parts of the rotation between two events in which a maximum is looked for
   integer, parameter :: parts = 64

contains

   !> Acceleration of the rigid-plastic mechanism: all ties at their largest force, the wall at rest [m/s2]
   pure function plastic_acceleration(mechanism) result(a)
      class(mechanism_type), intent(in) :: mechanism
      !> [G(0) - Q(0) + sum F_y X(0)]/L(0), friction among the forces
      real(wp) :: a

      real(wp) :: j, c, g, l, load

      call mechanism%terms(0.0_wp, j, c, g, l, load)
      a = (g - load)/l
      if (.not. allocated(mechanism%restraints)) return
      associate (ties => mechanism%restraints)
         a = a + (sum(ties%strength*ties%lever_at(0.0_wp)) - mechanism%preload)/l
      end associate
   end function plastic_acceleration

   !> Hold a wall as design has it at a rotation that it is pushed to for the first time: all ties that are not broken by then
   !> at their largest force, and what is left of the friction
   pure subroutine set_plastic_restraints(wall, q)
      !> Has ties
      class(mechanism_type), intent(inout) :: wall
      !> Rotation; that at which a tie breaks is one of those at which it holds [rad]
      real(wp), intent(in) :: q

      !> Rotations that differ by this part are the same
      real(wp), parameter :: same = 1.0e-9_wp
      real(wp), dimension(size(wall%restraints)) :: force, stiffness
      integer :: mode(size(wall%restraints))

      mode = merge(broken, flowing, q > wall%restraints%fracture*(1.0_wp + same))
      call wall%restraints%linear_force(mode, 0.0_wp, force, stiffness)
      call wall%set_restraints(force, stiffness)
   end subroutine set_plastic_restraints

   !> Greatest acceleration that the wall withstands at any rotation up to its capacity, pushed out for the first time [m/s2]
   function greatest_acceleration(mechanism) result(a)
      class(mechanism_type), intent(in) :: mechanism
      !> Greatest value of [G - Q + sum T X]/L
      real(wp) :: a

      class(mechanism_type), allocatable :: restrained
      real(wp), allocatable :: force(:), stiffness(:)
      integer, allocatable :: mode(:)
      real(wp) :: from, to

      a = 0.0_wp
      allocate (restrained, source=mechanism)
      from = 0.0_wp
      do
         to = restrained%capacity
         if (allocated(restrained%restraints)) then
            associate (ties => restrained%restraints)
               allocate (mode(size(ties)), force(size(ties)), stiffness(size(ties)))
               mode = merge(flowing, elastic, from >= ties%yield)
               where (from >= ties%fracture) mode = broken
               call ties%linear_force(mode, 0.0_wp, force, stiffness)
               to = min(to, minval(ties%yield, mask=mode == elastic), minval(ties%fracture, mask=mode /= broken))
            end associate
            call restrained%set_restraints(force, stiffness)
            deallocate (mode, force, stiffness)
         end if
         a = max(a, greatest_between(restrained, from, to))
         if (to >= restrained%capacity) exit
         from = to
      end do
   end function greatest_acceleration

   !> What a history leaves of the ties: all of it follows from its largest rotation
   pure subroutine ties_after(mechanism, edp, elongation, is_broken)
      !> Has ties
      class(mechanism_type), intent(in) :: mechanism
      !> Largest rotation / capacity
      real(wp), intent(in) :: edp
      !> Plastic elongation of each tie [m]
      real(wp), intent(out) :: elongation(:)
      !> Whether it is broken
      logical, intent(out) :: is_broken(:)

      ! A load that loses its seat ends a history at less than the limit that is its EDP.
      associate (ties => mechanism%restraints(:mechanism%ties), peak => min(edp, mechanism%unseating/mechanism%capacity))
         ! A division by the capacity made the EDP; the same division keeps the order of the rotations to the bit.
         is_broken = peak >= ties%fracture/mechanism%capacity
         elongation = ties%plastic_elongation(peak*mechanism%capacity)
         where (is_broken) elongation = ties%plastic_elongation(ties%fracture)
         where (peak <= ties%yield/mechanism%capacity) elongation = 0.0_wp
      end associate
   end subroutine ties_after

   !> Greatest acceleration between two rotations, by parts and the golden section of the best of them
   pure real(wp) function greatest_between(mechanism, from, to) result(greatest)
      class(mechanism_type), intent(in) :: mechanism
      !> Rotations [rad]
      real(wp), intent(in) :: from, to

      real(wp), parameter :: golden = 0.5_wp*(sqrt(5.0_wp) - 1.0_wp)
      integer, parameter :: halvings = 40
      real(wp) :: a(0:parts), low, high, first, second
      integer :: i

      a = mechanism%balancing_acceleration([(from + (to - from)*real(i, wp)/real(parts, wp), i=0, parts)])
      greatest = maxval(a)
      i = maxloc(a, dim=1) - 1
      if (i == 0 .or. i == parts) return
      low = from + (to - from)*real(i - 1, wp)/real(parts, wp)
      high = from + (to - from)*real(i + 1, wp)/real(parts, wp)
      do i = 1, halvings
         first = high - golden*(high - low)
         second = low + golden*(high - low)
         if (mechanism%balancing_acceleration(first) > mechanism%balancing_acceleration(second)) then
            high = second
         else
            low = first
         end if
      end do
      greatest = max(greatest, mechanism%balancing_acceleration(0.5_wp*(low + high)))
   end function greatest_between

end module dondolo_wall_tie_statics
