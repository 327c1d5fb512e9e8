!> Overlaps of the polygons of a chain: bodies that lie in one another at rest, and hinges on the wrong side of a joint.
!>
!> Two convex polygons overlap in one, which is found by cutting the first at each side of the second (Sutherland and Hodgman 1974).
module dondolo_wall_chain_overlap
   use dondolo_base_kinds, only : wp
   use dondolo_wall_chain, only : chain_type, motion_type, point_motion
   implicit none
   private

   public :: depth_of_overlap, is_within, outline_type, overlap_of_bodies

   !> The outline of a part of a body, or a piece of it
   type :: outline_type
      !> 0: of masonry that stands still
      integer :: body = 0
      !> Number of the part among those of all bodies
      integer :: part = 0
      !> Its corners at rest (x and y, corner) [m]
      real(wp), allocatable :: corners(:, :)
   end type outline_type

contains

   !> Area that the convex parts of two bodies share at a motion [m2]
   pure real(wp) function overlap_of_bodies(chain, outlines, motion, body, other) result(area)
      type(chain_type), intent(in) :: chain
      !> Parts of masonry; openings are not among them
      type(outline_type), intent(in) :: outlines(:)
      type(motion_type), intent(in) :: motion
      integer, intent(in) :: body, other

      type(outline_type), allocatable :: pieces(:), others(:)
      integer :: i, k

      area = 0.0_wp
      call find_pieces(chain, outlines, motion, body, pieces)
      call find_pieces(chain, outlines, motion, other, others)
      do i = 1, size(pieces)
         do k = 1, size(others)
            if (are_near(pieces(i)%corners, others(k)%corners)) area = area + shared_area(pieces(i)%corners, others(k)%corners)
         end do
      end do
   end function overlap_of_bodies

   !> How deep a corner of a convex part of one of two bodies lies in one of the other at a motion [m]
   pure real(wp) function depth_of_overlap(chain, outlines, motion, body, other) result(depth)
      type(chain_type), intent(in) :: chain
      type(outline_type), intent(in) :: outlines(:)
      type(motion_type), intent(in) :: motion
      integer, intent(in) :: body, other

      type(outline_type), allocatable :: pieces(:), others(:)
      integer :: i, k

      depth = 0.0_wp
      call find_pieces(chain, outlines, motion, body, pieces)
      call find_pieces(chain, outlines, motion, other, others)
      do i = 1, size(pieces)
         do k = 1, size(others)
            associate (one => pieces(i)%corners, two => others(k)%corners)
               if (are_near(one, two)) depth = max(depth, depth_within(one, two), depth_within(two, one))
            end associate
         end do
      end do
   end function depth_of_overlap

   !> Find the convex parts of a body at a motion, anticlockwise
   pure subroutine find_pieces(chain, outlines, motion, body, pieces)
      type(chain_type), intent(in) :: chain
      type(outline_type), intent(in) :: outlines(:)
      type(motion_type), intent(in) :: motion
      integer, intent(in) :: body
      type(outline_type), allocatable, intent(out) :: pieces(:)

      real(wp), allocatable :: corners(:, :)
      integer :: i, n

      allocate (pieces(count(outlines%body == body)))
      n = 0
      do i = 1, size(outlines)
         if (outlines(i)%body /= body) cycle
         call move_corners(chain, outlines(i), motion, corners)
         if (.not. is_convex(corners)) cycle
         n = n + 1
         pieces(n) = outline_type(body, outlines(i)%part, corners)
      end do
      pieces = pieces(:n)
   end subroutine find_pieces

   !> May two polygons share a point? Not if one is wholly on one side of the other
   pure logical function are_near(one, two)
      real(wp), intent(in) :: one(:, :), two(:, :)

      are_near = minval(one(1, :)) <= maxval(two(1, :)) .and. minval(two(1, :)) <= maxval(one(1, :))
      if (are_near) are_near = minval(one(2, :)) <= maxval(two(2, :)) .and. minval(two(2, :)) <= maxval(one(2, :))
   end function are_near

   !> How deep a corner lies within a convex anticlockwise polygon
   pure real(wp) function depth_within(corners, polygon) result(depth)
      real(wp), intent(in) :: corners(:, :), polygon(:, :)

      integer :: i, k, n

      n = size(polygon, 2)
      depth = 0.0_wp
      do i = 1, size(corners, 2)
         depth = max(depth, minval([(turn(polygon(:, k), polygon(:, modulo(k, n) + 1), corners(:, i)) &
            & /norm2(polygon(:, modulo(k, n) + 1) - polygon(:, k)), k=1, n)]))
      end do
   end function depth_within

   !> Corners of an outline at a motion, anticlockwise
   pure subroutine move_corners(chain, outline, motion, corners)
      type(chain_type), intent(in) :: chain
      type(outline_type), intent(in) :: outline
      type(motion_type), intent(in) :: motion
      real(wp), allocatable, intent(out) :: corners(:, :)

      real(wp) :: rate(2), second(2)
      integer :: i

      corners = outline%corners
      do i = 1, size(corners, 2)
         if (outline%body == 0) exit
         call point_motion(chain, motion, outline%body, outline%corners(:, i), corners(:, i), rate, second)
      end do
      if (area_of(corners) < 0.0_wp) corners = corners(:, size(corners, 2):1:-1)
   end subroutine move_corners

   !> Area of a polygon, positive anticlockwise
   pure real(wp) function area_of(corners)
      real(wp), intent(in) :: corners(:, :)

      integer :: i

      area_of = 0.0_wp
      do i = 2, size(corners, 2) - 1
         area_of = area_of + 0.5_wp*turn(corners(:, 1), corners(:, i), corners(:, i + 1))
      end do
   end function area_of

   !> Twice the area of a triangle, positive anticlockwise
   pure real(wp) function turn(a, b, c)
      real(wp), intent(in) :: a(2), b(2), c(2)

      turn = (b(1) - a(1))*(c(2) - a(2)) - (b(2) - a(2))*(c(1) - a(1))
   end function turn

   !> Is an anticlockwise polygon convex?
   pure logical function is_convex(corners)
      real(wp), intent(in) :: corners(:, :)

      integer :: i, n

      n = size(corners, 2)
      is_convex = all([(turn(corners(:, i), corners(:, modulo(i, n) + 1), corners(:, modulo(i + 1, n) + 1)) >= &
         & -1.0e-12_wp*maxval(abs(corners))**2, i=1, n)])
   end function is_convex

   !> Area of the overlap of two convex anticlockwise polygons
   pure real(wp) function shared_area(one, two)
      real(wp), intent(in) :: one(:, :), two(:, :)

      real(wp), allocatable :: left(:, :), cut(:, :)
      real(wp) :: here, next
      integer :: i, k, m, n

      left = one
      do i = 1, size(two, 2)
         associate (a => two(:, i), b => two(:, modulo(i, size(two, 2)) + 1))
            n = size(left, 2)
            allocate (cut(2, 2*n))
            m = 0
            do k = 1, n
               here = turn(a, b, left(:, k))
               next = turn(a, b, left(:, modulo(k, n) + 1))
               if (here >= 0.0_wp) then
                  m = m + 1
                  cut(:, m) = left(:, k)
               end if
               if (here*next < 0.0_wp) then
                  m = m + 1
                  cut(:, m) = left(:, k) + here/(here - next)*(left(:, modulo(k, n) + 1) - left(:, k))
               end if
            end do
            left = cut(:, :m)
            deallocate (cut)
         end associate
         if (size(left, 2) == 0) exit
      end do
      shared_area = area_of(left)
   end function shared_area

   !> Does a point lie within a polygon?
   pure logical function is_within(corners, at)
      real(wp), intent(in) :: corners(:, :), at(2)

      integer :: i, n

      is_within = .false.
      n = size(corners, 2)
      do i = 1, n
         associate (a => corners(:, i), b => corners(:, modulo(i, n) + 1))
            if (a(2) > at(2) .eqv. b(2) > at(2)) cycle
            if (at(1) < a(1) + (at(2) - a(2))/(b(2) - a(2))*(b(1) - a(1))) is_within = .not. is_within
         end associate
      end do
   end function is_within

end module dondolo_wall_chain_overlap
