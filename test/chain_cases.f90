!> Chains of rigid bodies whose terms are known to 16 digits from a program of its own that works in 30 digits.
module chain_cases
   use dondolo_base_kinds, only : pi, wp
   use dondolo_wall_chain, only : chain_action_type, chain_type, guide, pin
   use dondolo_wall_chain_impact, only : contact_type
   use dondolo_wall_chain_part, only : chain_mass_type, point_mass, polygon, sector, together
   implicit none
   private

   public :: arch, arch_contacts, arch_joint, arch_parts, cavity, corner, frame, gable, horizontal, loaded, mirrored, portal, &
      & block, compound, portal_contacts, portal_parts, rectangle, strip

   real(wp), parameter, public :: g = 9.81_wp

contains

   !> A rectangle of masonry between two x and two y
   pure type(chain_mass_type) function rectangle(x, y, density)
      real(wp), intent(in) :: x(2), y(2), density

      rectangle = polygon(reshape([x(1), y(1), x(2), y(1), x(2), y(2), x(1), y(2)], [2, 4]), density)
   end function rectangle

   !> A load on a body
   pure type(chain_action_type) function loaded(body, at, weight, is_pushed, is_lifted, is_held)
      integer, intent(in) :: body
      real(wp), intent(in) :: at(2), weight
      logical, intent(in) :: is_pushed, is_lifted
      logical, intent(in), optional :: is_held

      loaded = chain_action_type(body=body, at=at, weight=weight)
      if (is_pushed) loaded%pushed = weight/g
      if (is_lifted) loaded%lifted = weight/g
      if (present(is_held)) loaded%is_held = is_held
   end function loaded

   !> A thrust on a body
   pure type(chain_action_type) function thrust(body, at, force)
      integer, intent(in) :: body
      real(wp), intent(in) :: at(2), force(2)

      thrust = chain_action_type(body=body, at=at, thrust=force)
   end function thrust

   !> One block between its outer face and a thickness behind it
   pure type(chain_type) function block(height, thickness, density, hinge)
      real(wp), intent(in) :: height, thickness, density, hinge

      block%bodies = [rectangle([-thickness, 0.0_wp], [0.0_wp, height], density)]
      block%joints = [pin(1, 0, [-hinge, 0.0_wp])]
      allocate (block%actions(0))
      block%gravity = g
   end function block

   !> W: a facade with two wedges of transverse walls
   pure type(chain_type) function compound()
      real(wp), parameter :: t = 0.55_wp, h = 7.0_wp, rho = 1900.0_wp, u = 0.02_wp

      associate (long => h*tan(20.0_wp*pi/180.0_wp))
         compound%bodies = [together([rectangle([-t, 0.0_wp], [0.0_wp, h], 6.0_wp*rho), &
            & polygon(reshape([-t, 0.0_wp, -t, h, -t - long, h], [2, 3]), 0.9_wp*rho)])]
      end associate
      compound%joints = [pin(1, 0, [-u, 0.0_wp])]
      compound%actions = [loaded(1, [-0.40_wp, 3.5_wp], 48.0e3_wp, .true., .true.), &
         & loaded(1, [-0.35_wp, 7.0_wp], 24.0e3_wp, .true., .true.), thrust(1, [-0.35_wp, 7.0_wp], [1.5e3_wp, 0.0_wp])]
      compound%gravity = g
   end function compound

   !> C: a corner, of mass, centroid and inertia in closed form
   pure type(chain_type) function corner()
      corner%bodies = [point_mass(7136.463418676679_wp, [-0.8353932042949779_wp, 2.019738318673118_wp], 5903.577167197559_wp)]
      corner%joints = [pin(1, 0, [-0.03_wp, 0.0_wp])]
      corner%actions = [loaded(1, [-0.45_wp, 3.2_wp], 6.0e3_wp, .true., .true.), &
         & thrust(1, [-0.4_wp, 3.2_wp], [2.0e3_wp, 0.0_wp])]
      corner%gravity = g
   end function corner

   !> G: half of a gable above a line in its face that rises at beta; y is the distance from that line
   pure type(chain_type) function gable()
      real(wp), parameter :: t = 0.4_wp, u = 0.01_wp, rho = 1900.0_wp, beta = atan(1.5_wp/1.8_wp)
      type(chain_mass_type) :: face
      real(wp) :: apex, area, second

      ! A triangle on that line; of it the mean and the mean square of the distance from the line are 1/3 and 1/6 of its height
      apex = 2.4_wp*cos(beta)
      area = 0.5_wp*2.4_wp*1.8_wp
      second = area*apex**2/18.0_wp
      face = point_mass(rho*t*area, [-0.5_wp*t, apex/3.0_wp], rho*t*(second + area*t**2/12.0_wp))
      gable%bodies = [face]
      gable%joints = [pin(1, 0, [-u, 0.0_wp])]
      gable%actions = [loaded(1, [-0.2_wp, apex], 4.5e3_wp, .true., .true.)]
      gable%gravity = g
      gable%gravity_share = cos(beta)
   end function gable

   !> H: horizontal bending of a band of 1 m, y along the wall
   pure type(chain_type) function horizontal()
      real(wp), parameter :: t = 0.45_wp, u = 0.01_wp, rho = 1900.0_wp

      horizontal%bodies = [rectangle([-t, 0.0_wp], [0.0_wp, 2.2_wp], rho), rectangle([-t, 0.0_wp], [2.2_wp, 4.0_wp], rho)]
      horizontal%joints = [pin(1, 0, [-u, 0.0_wp]), pin(1, 2, [u - t, 2.2_wp]), guide(2, 0, [-u, 4.0_wp], 0.0_wp)]
      horizontal%actions = [thrust(2, [-u, 4.0_wp], [0.0_wp, -25.0e3_wp])]
      horizontal%gravity = g
      horizontal%gravity_share = 0.0_wp
   end function horizontal

   !> V: a strip over two storeys
   pure type(chain_type) function strip()
      real(wp), parameter :: rho = 1900.0_wp, u = 0.01_wp, z = 4.2_wp

      strip%bodies = [together([rectangle([-0.5_wp, 0.0_wp], [0.0_wp, 3.6_wp], rho), &
         & rectangle([-0.4_wp, 0.0_wp], [3.6_wp, z], rho)]), rectangle([-0.4_wp, 0.0_wp], [z, 6.8_wp], rho)]
      strip%joints = [pin(1, 0, [-u, 0.0_wp]), pin(1, 2, [u - 0.4_wp, z]), guide(2, 0, [-u, 6.8_wp], 0.0_wp)]
      strip%actions = [loaded(1, [-0.38_wp, 3.6_wp], 12.0e3_wp, .true., .true.), &
         & loaded(2, [-0.2_wp, 6.8_wp], 8.0e3_wp, .false., .true., is_held=.true.)]
      strip%gravity = g
   end function strip

   !> D: two leaves with rigid ties at the hinge level; the inner one drives and comes first
   pure type(chain_type) function cavity()
      real(wp), parameter :: z = 1.62_wp, h = 2.7_wp, inner(2) = [-0.28_wp, -0.16_wp], outer(2) = [-0.10_wp, 0.0_wp]

      cavity%bodies = [rectangle(inner, [0.0_wp, z], 1900.0_wp), rectangle(inner, [z, h], 1900.0_wp), &
         & rectangle(outer, [0.0_wp, z], 1800.0_wp), rectangle(outer, [z, h], 1800.0_wp)]
      cavity%joints = [pin(1, 0, [-0.16_wp, 0.0_wp]), pin(1, 2, [-0.28_wp, z]), guide(2, 0, [-0.16_wp, h], 0.0_wp), &
         & pin(3, 0, [0.0_wp, 0.0_wp]), pin(3, 4, [-0.10_wp, z]), guide(4, 0, [0.0_wp, h], 0.0_wp), &
         & guide(1, 3, [-0.22_wp, z], 0.0_wp, other_at=[-0.05_wp, z])]
      cavity%actions = [loaded(2, [-0.22_wp, h], 4.0e3_wp, .false., .true., is_held=.true.)]
      cavity%gravity = g
   end function cavity

   !> F: a block on four equal piers, two in each body
   pure type(chain_type) function frame()
      real(wp), parameter :: b = 0.6_wp, h = 3.2_wp

      frame%bodies = [rectangle([-b, 0.0_wp], [0.0_wp, h], 1900.0_wp), rectangle([-b - 3.0_wp, -3.0_wp], [0.0_wp, h], 1900.0_wp), &
         & point_mass(6000.0_wp, [-1.8_wp, 4.0_wp], 5000.0_wp)]
      frame%joints = [pin(1, 0, [0.0_wp, 0.0_wp]), pin(2, 0, [-3.0_wp, 0.0_wp]), pin(1, 3, [-b, h]), pin(2, 3, [-b - 3.0_wp, h])]
      allocate (frame%actions(0))
      frame%gravity = g
   end function frame

   !> End of a joint of Oppenheim's arch of n voussoirs, at the intrados or the extrados; joint 0 is the left one
   pure function arch_joint(joint, n, is_extrados) result(at)
      integer, intent(in) :: joint, n
      logical, intent(in) :: is_extrados
      real(wp) :: at(2)

      real(wp) :: angle

      angle = 0.5_wp*pi + (0.5_wp - real(joint, wp)/real(n, wp))*157.5_wp*pi/180.0_wp
      at = merge(10.75_wp, 9.25_wp, is_extrados)*[cos(angle), sin(angle)]
   end function arch_joint

   !> Its voussoirs
   pure function arch_parts(n) result(parts)
      integer, intent(in) :: n
      type(chain_mass_type) :: parts(n)

      real(wp) :: step, left
      integer :: i

      step = 157.5_wp*pi/180.0_wp/real(n, wp)
      do i = 1, n
         left = 0.5_wp*pi + 0.5_wp*157.5_wp*pi/180.0_wp - real(i - 1, wp)*step
         parts(i) = sector([0.0_wp, 0.0_wp], [9.25_wp, 10.75_wp], [left - step, left], 2400.0_wp)
      end do
   end function arch_parts

   !> A: Oppenheim's arch, hinges in joints 0, 3, 5 and 7
   pure type(chain_type) function arch()
      type(chain_mass_type) :: parts(7)

      parts = arch_parts(7)
      arch%bodies = [together(parts(:3)), together(parts(4:5)), together(parts(6:))]
      arch%joints = [pin(1, 0, arch_joint(0, 7, .false.)), pin(1, 2, arch_joint(3, 7, .true.)), &
         & pin(2, 3, arch_joint(5, 7, .false.)), pin(3, 0, arch_joint(7, 7, .true.))]
      allocate (arch%actions(0))
      arch%gravity = g
   end function arch

   !> Its joints: each voussoir opens away from the one before it
   pure function arch_contacts() result(contacts)
      type(contact_type) :: contacts(8)

      real(wp) :: ends(2, 2)
      integer :: i

      do i = 0, 7
         ends = reshape([arch_joint(i, 7, .false.), arch_joint(i, 7, .true.)], [2, 2])
         contacts(i + 1) = across(merge(i + 1, 0, i < 7), i, ends)
         ! On the right the ground lies behind: the part is the last voussoir
         if (i == 7) contacts(8) = contact_type(7, 0, ends, -contacts(8)%normal)
      end do
   end function arch_contacts

   !> A joint whose part lies to the right of the way from its first end to the second
   pure type(contact_type) function across(part, other, ends)
      integer, intent(in) :: part, other
      real(wp), intent(in) :: ends(2, 2)

      real(wp) :: along(2)

      along = (ends(:, 2) - ends(:, 1))/norm2(ends(:, 2) - ends(:, 1))
      across = contact_type(part, other, ends, [along(2), -along(1)])
   end function across

   !> End of a joint of the portal, from the left base (0) to the right one (10)
   pure function portal_joint(joint, is_extrados) result(at)
      integer, intent(in) :: joint
      logical, intent(in) :: is_extrados
      real(wp) :: at(2)

      real(wp) :: angle

      if (joint == 0 .or. joint == 10) then
         at = [merge(2.5_wp, 1.5_wp, is_extrados)*merge(-1.0_wp, 1.0_wp, joint == 0), 0.0_wp]
      else
         angle = pi*(1.0_wp - real(joint - 1, wp)/8.0_wp)
         at = [0.0_wp, 3.5_wp] + merge(2.0_wp, 1.5_wp, is_extrados)*[cos(angle), sin(angle)]
      end if
   end function portal_joint

   !> Its piers and voussoirs
   pure function portal_parts() result(parts)
      type(chain_mass_type) :: parts(10)

      integer :: i

      parts(1) = rectangle([-2.5_wp, -1.5_wp], [0.0_wp, 3.5_wp], 1900.0_wp)
      parts(10) = rectangle([1.5_wp, 2.5_wp], [0.0_wp, 3.5_wp], 1900.0_wp)
      do i = 1, 8
         parts(i + 1) = sector([0.0_wp, 3.5_wp], [1.5_wp, 2.0_wp], pi*(1.0_wp - [real(i, wp), real(i - 1, wp)]/8.0_wp), 1900.0_wp)
      end do
   end function portal_parts

   !> P: a semicircle on piers, hinges in joints 2, 5, 7 and 10
   pure type(chain_type) function portal()
      type(chain_mass_type) :: parts(10)

      ! The left pier and the first voussoir do not move.
      parts = portal_parts()
      portal%bodies = [together(parts(3:5)), together(parts(6:7)), together(parts(8:))]
      portal%joints = [pin(1, 0, portal_joint(2, .false.)), pin(1, 2, portal_joint(5, .true.)), &
         & pin(2, 3, portal_joint(7, .false.)), pin(3, 0, portal_joint(10, .true.))]
      allocate (portal%actions(0))
      portal%gravity = g
   end function portal

   !> Its joints
   pure function portal_contacts() result(contacts)
      type(contact_type) :: contacts(11)

      real(wp) :: ends(2, 2)
      integer :: i

      do i = 0, 10
         ends = reshape([portal_joint(i, .false.), portal_joint(i, .true.)], [2, 2])
         contacts(i + 1) = across(merge(i + 1, 0, i < 10), i, ends)
         if (i == 10) contacts(11) = contact_type(10, 0, ends, -contacts(11)%normal)
      end do
   end function portal_contacts

   !> The mirror image of a chain, which moves towards -x; its driver keeps its number
   pure type(chain_type) function mirrored(chain)
      type(chain_type), intent(in) :: chain

      mirrored = chain
      mirrored%bodies%at(1) = -mirrored%bodies%at(1)
      mirrored%joints%at(1) = -mirrored%joints%at(1)
      mirrored%joints%other_at(1) = -mirrored%joints%other_at(1)
      mirrored%joints%direction(1) = -mirrored%joints%direction(1)
      mirrored%actions%at(1) = -mirrored%actions%at(1)
      mirrored%actions%thrust(1) = -mirrored%actions%thrust(1)
      mirrored%sense = -mirrored%sense
   end function mirrored

end module chain_cases
