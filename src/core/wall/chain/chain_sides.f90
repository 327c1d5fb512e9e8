!> The motion of a chain to its other side.
!>
!> A joint is the edge that the outlines of two bodies share, or the edge of one on the ground. If all joints are horizontal, the
!> motion inwards opens the same joints at their other ends: each hinge lies as far from the other end as from its own before.
!> Loads stay where they are, thrusts at a hinge go with it. Of joints that are inclined, as those of arches, others open.
module dondolo_wall_chain_sides
   use dondolo_base_kinds, only : wp
   use dondolo_wall_chain, only : chain_type, is_pin
   use dondolo_wall_chain_overlap, only : outline_type
   implicit none
   private

   public :: make_inward

   !> How near points of one joint are [m]
   real(wp), parameter :: near = 1.0e-6_wp

contains

   !> The chain as it moves inwards, seen from behind, so that there it moves towards +x
   pure subroutine make_inward(chain, outlines, inward, inward_outlines, is_known)
      type(chain_type), intent(in) :: chain
      type(outline_type), intent(in) :: outlines(:)
      type(chain_type), intent(out) :: inward
      type(outline_type), allocatable, intent(out) :: inward_outlines(:)
      !> False: a joint is not horizontal, or no outline shows where it ends, and the rest is undefined
      logical, intent(out) :: is_known

      real(wp) :: span(2), before(2)
      integer :: i, k

      inward = chain
      is_known = .true.
      do i = 1, size(inward%joints)
         associate (joint => inward%joints(i))
            before = joint%at
            call find_span(outlines, joint%body, joint%other, joint%at, span, is_known)
            ! A guide may hold a point that is at no joint: it stays.
            if (.not. is_known .and. joint%kind == is_pin) return
            if (is_known) joint%at(1) = sum(span) - joint%at(1)
            is_known = .true.
            if (all(abs(joint%other_at - before) <= near)) joint%other_at = joint%at
            do k = 1, size(inward%actions)
               associate (action => inward%actions(k))
                  if (norm2(action%thrust) > 0.0_wp .and. all(abs(chain%actions(k)%at - before) <= near)) action%at = joint%at
               end associate
            end do
         end associate
      end do
      inward%bodies%at(1) = -inward%bodies%at(1)
      inward%joints%at(1) = -inward%joints%at(1)
      inward%joints%other_at(1) = -inward%joints%other_at(1)
      inward%joints%direction(1) = -inward%joints%direction(1)
      inward%actions%at(1) = -inward%actions%at(1)
      inward%actions%thrust(1) = -inward%actions%thrust(1)
      inward%sense = 1.0_wp
      inward_outlines = outlines
      do i = 1, size(inward_outlines)
         inward_outlines(i)%corners(1, :) = -inward_outlines(i)%corners(1, :)
      end do
   end subroutine make_inward

   !> Find where the horizontal joint at a point begins and ends
   pure subroutine find_span(outlines, body, other, at, span, is_found)
      type(outline_type), intent(in) :: outlines(:)
      !> Its bodies; 0: the ground
      integer, intent(in) :: body, other
      !> A point of it [m]
      real(wp), intent(in) :: at(2)
      !> Least and largest x [m]
      real(wp), intent(out) :: span(2)
      logical, intent(out) :: is_found

      real(wp) :: edge(2)
      integer :: bodies(2), i
      logical :: has_edge

      bodies = [body, other]
      span = [-huge(1.0_wp), huge(1.0_wp)]
      is_found = .false.
      do i = 1, 2
         ! The ground, and a body whose mass alone is given, have no edges.
         if (.not. any(outlines%body == bodies(i))) cycle
         call find_edge(outlines, bodies(i), at, edge, has_edge)
         if (.not. has_edge .and. bodies(i) == 0) cycle
         if (.not. has_edge) then
            is_found = .false.
            return
         end if
         span = [max(span(1), edge(1)), min(span(2), edge(2))]
         is_found = .true.
      end do
   end subroutine find_span

   !> Find the horizontal edge of a body at a point: of several, all that they cover
   pure subroutine find_edge(outlines, body, at, edge, is_found)
      type(outline_type), intent(in) :: outlines(:)
      integer, intent(in) :: body
      !> [m]
      real(wp), intent(in) :: at(2)
      !> Least and largest x [m]
      real(wp), intent(out) :: edge(2)
      logical, intent(out) :: is_found

      real(wp) :: low, high
      integer :: i, k, n

      is_found = .false.
      edge = at(1)
      do i = 1, size(outlines)
         if (outlines(i)%body /= body) cycle
         n = size(outlines(i)%corners, 2)
         do k = 1, n
            associate (one => outlines(i)%corners(:, k), two => outlines(i)%corners(:, modulo(k, n) + 1))
               if (max(abs(one(2) - at(2)), abs(two(2) - at(2))) > near) cycle
               low = min(one(1), two(1))
               high = max(one(1), two(1))
               if (high - low <= near .or. at(1) < low - near .or. at(1) > high + near) cycle
               edge = [min(edge(1), low), max(edge(2), high)]
               is_found = .true.
            end associate
         end do
      end do
   end subroutine find_edge

end module dondolo_wall_chain_sides
