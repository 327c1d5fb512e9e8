!> How far a point of a wall of one block goes when the wall turns about its hinge or rolls on its edge.
!>
!> A point e behind the hinge and f above it has the horizontal travel D = a q + f sin q + e (1 - cos q) and the lever
!> X = dD/dq = a + f cos q + e sin q (docs/theory.md, section 2).
module dondolo_travel
   use dondolo_kinds, only : wp
   implicit none
   private

   public :: lever, rotation_after, travel, versine

contains

   !> Horizontal travel D [m]
   elemental real(wp) function travel(edge, e, f, q)
      !> Radius of the edge a, and place of the point from the hinge [m]
      real(wp), intent(in) :: edge, e, f
      !> Rotation [rad]
      real(wp), intent(in) :: q

      travel = edge*q + f*sin(q) + e*versine(q)
   end function travel

   !> Lever X of a horizontal force [m]
   elemental real(wp) function lever(edge, e, f, q)
      !> Radius of the edge a, and place of the point from the hinge [m]
      real(wp), intent(in) :: edge, e, f
      !> Rotation [rad]
      real(wp), intent(in) :: q

      lever = edge + f*cos(q) + e*sin(q)
   end function lever

   !> Rotation after which a point has gone a distance, by bisection [rad]; huge: it never goes as far
   elemental real(wp) function rotation_after(edge, e, f, distance) result(q)
      !> Radius of the edge a, and place of the point from the hinge [m]
      real(wp), intent(in) :: edge, e, f
      !> The distance, at least 0 [m]
      real(wp), intent(in) :: distance

      real(wp), parameter :: right_angle = acos(0.0_wp)
      real(wp) :: below, above

      ! Beyond this rotation X < 0, and the point comes back.
      above = atan2(e, f) + right_angle
      q = huge(q)
      if (.not. travel(edge, e, f, above) > distance) return
      below = 0.0_wp
      do
         q = 0.5_wp*(below + above)
         if (q <= below .or. q >= above) exit
         if (travel(edge, e, f, q) > distance) then
            above = q
         else
            below = q
         end if
      end do
   end function rotation_after

   !> 1 - cos q, without the cancellation of small rotations
   elemental real(wp) function versine(q)
      !> Rotation [rad]
      real(wp), intent(in) :: q

      versine = 2.0_wp*sin(0.5_wp*q)**2
   end function versine

end module dondolo_travel
