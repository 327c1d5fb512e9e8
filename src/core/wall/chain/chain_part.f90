!> Parts of the bodies of a chain: polygons and annular sectors of masonry, and masses that are given.
!>
!> Area, centroid and polar moment of a polygon follow from its corners (Green's theorem), those of a sector from its angles. The
!> plane is that of the motion: x outwards, y upwards.
module dondolo_wall_chain_part
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: chain_mass_type, point_mass, polygon, sector, together

   !> A rigid body at rest
   type :: chain_mass_type
      !> Mass [kg]; that of an opening is negative
      real(wp) :: mass = 0.0_wp
      !> Its centroid (x, y) [m]
      real(wp) :: at(2) = 0.0_wp
      !> Its inertia about the centroid [kg m2]
      real(wp) :: inertia = 0.0_wp
   end type chain_mass_type

contains

   !> A mass that is given
   pure type(chain_mass_type) function point_mass(mass, at, inertia)
      !> [kg]
      real(wp), intent(in) :: mass
      !> Centroid [m]
      real(wp), intent(in) :: at(2)
      !> Inertia about the centroid [kg m2]
      real(wp), intent(in) :: inertia

      point_mass = chain_mass_type(mass, at, inertia)
   end function point_mass

   !> A polygon, whichever way round its corners are given
   pure type(chain_mass_type) function polygon(corners, density)
      !> Corners (x and y, corner) [m]
      real(wp), intent(in) :: corners(:, :)
      !> Density times width, negative for an opening [kg/m2]
      real(wp), intent(in) :: density

      real(wp) :: a(2), b(2), cross, area, first(2), second
      integer :: i, n

      n = size(corners, 2)
      area = 0.0_wp
      first = 0.0_wp
      second = 0.0_wp
      ! About the first corner, so that places far from the origin keep their digits
      do i = 2, n - 1
         a = corners(:, i) - corners(:, 1)
         b = corners(:, i + 1) - corners(:, 1)
         cross = 0.5_wp*(a(1)*b(2) - a(2)*b(1))
         area = area + cross
         first = first + cross*(a + b)/3.0_wp
         second = second + cross*(sum(a*a) + sum(a*b) + sum(b*b))/6.0_wp
      end do
      polygon%mass = abs(area)*density
      if (.not. abs(area) > 0.0_wp) return
      polygon%at = first/area
      polygon%inertia = polygon%mass*(second/area - sum(polygon%at**2))
      polygon%at = corners(:, 1) + polygon%at
   end function polygon

   !> A part of a ring between two radii and two angles
   pure type(chain_mass_type) function sector(centre, radii, angles, density)
      !> Centre of the ring [m]
      real(wp), intent(in) :: centre(2)
      !> Its radii [m], and the angles from x towards y between which it lies [rad]
      real(wp), intent(in) :: radii(2), angles(2)
      !> Density times width, negative for an opening [kg/m2]
      real(wp), intent(in) :: density

      real(wp) :: half, middle, distance, area

      half = 0.5_wp*abs(angles(2) - angles(1))
      middle = 0.5_wp*(angles(1) + angles(2))
      area = half*abs(radii(2)**2 - radii(1)**2)
      sector%mass = density*area
      distance = 2.0_wp/3.0_wp*(radii(2)**3 - radii(1)**3)/(radii(2)**2 - radii(1)**2)*sin(half)/half
      sector%at = centre + distance*[cos(middle), sin(middle)]
      sector%inertia = sector%mass*(0.5_wp*(radii(1)**2 + radii(2)**2) - distance**2)
   end function sector

   !> Parts as one body
   pure type(chain_mass_type) function together(parts) result(body)
      type(chain_mass_type), intent(in) :: parts(:)

      integer :: i

      body%mass = sum(parts%mass)
      if (.not. body%mass > 0.0_wp) return
      do i = 1, 2
         body%at(i) = sum(parts%mass*parts%at(i))/body%mass
      end do
      body%inertia = sum(parts%inertia)
      do i = 1, size(parts)
         body%inertia = body%inertia + parts(i)%mass*sum((parts(i)%at - body%at)**2)
      end do
   end function together

end module dondolo_wall_chain_part
