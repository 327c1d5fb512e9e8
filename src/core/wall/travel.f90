!> How far a point of a wall of one block goes when the wall turns about its hinge or rolls on its edge.
!>
!> A point e behind the hinge and f above it has the horizontal travel D = a q + f sin q + e (1 - cos q) and the lever
!> X = dD/dq = a + f cos q + e sin q (docs/theory.md, section 2).
module dondolo_wall_travel
   use dondolo_base_bracket, only : bracket_type
   use dondolo_base_kinds, only : wp
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

   !> Rotation after which a point has gone a distance: Newton's method, then bisection of what rounding leaves [rad]; huge: it
   !> never goes as far
   elemental real(wp) function rotation_after(edge, e, f, distance) result(q)
      !> Radius of the edge a, and place of the point from the hinge [m]
      real(wp), intent(in) :: edge, e, f
      !> The distance, at least 0 [m]
      real(wp), intent(in) :: distance

      real(wp), parameter :: right_angle = acos(0.0_wp), near = 16.0_wp*epsilon(1.0_wp)
      integer, parameter :: most_iterations = 12
      type(bracket_type) :: bracket
      real(wp) :: furthest, change
      integer :: i

      ! Beyond this rotation X < 0, and the point comes back.
      furthest = atan2(e, f) + right_angle
      q = huge(q)
      if (.not. travel(edge, e, f, furthest) > distance) return
      bracket%last = furthest
      q = bracket%middle()
      if (lever(edge, e, f, 0.0_wp)*q > distance) q = distance/lever(edge, e, f, 0.0_wp)
      do i = 1, most_iterations
         change = (distance - travel(edge, e, f, q))/lever(edge, e, f, q)
         if (.not. (q + change > bracket%first .and. q + change < bracket%last)) exit
         q = q + change
         if (abs(change) > near*q) cycle
         if (.not. travel(edge, e, f, (1.0_wp - near)*q) > distance) bracket%first = (1.0_wp - near)*q
         if (travel(edge, e, f, (1.0_wp + near)*q) > distance) bracket%last = (1.0_wp + near)*q
         exit
      end do
      do while (bracket%is_divisible())
         call bracket%halve(.not. travel(edge, e, f, bracket%middle()) > distance)
      end do
      q = bracket%middle()
   end function rotation_after

   !> 1 - cos q, without the cancellation of small rotations
   elemental real(wp) function versine(q)
      !> Rotation [rad]
      real(wp), intent(in) :: q

      versine = 2.0_wp*sin(0.5_wp*q)**2
   end function versine

end module dondolo_wall_travel
