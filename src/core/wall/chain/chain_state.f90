!> Whether a chain stands at rest, and can move: its joints do not depend on one another, its bodies do not lie in one another, its
!> hinges are on the side on which joints open, and its moment holds it.
module dondolo_wall_chain_state
   use dondolo_base_error, only : error_type, not_at_rest, out_of_range, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : rounded, to_text
   use dondolo_wall_chain, only : chain_type, is_pin, motion_type, point_motion
   use dondolo_wall_chain_equations, only : factor_type
   use dondolo_wall_chain_overlap, only : depth_of_overlap, outline_type, overlap_of_bodies
   use dondolo_wall_chain_terms, only : chain_terms_type, set_at_rest, terms_at, walk_to
   implicit none
   private

   public :: check_chain, deepest_overlap_type, find_overlap

   !> Two bodies that move into each other
   type :: deepest_overlap_type
      integer :: body = 0, other = 0
      !> How deep [m], and at which rotation [rad]
      real(wp) :: depth = 0.0_wp, rotation = 0.0_wp
   end type deepest_overlap_type

   !> Area in which two bodies may overlap at rest [m2]: corners are given in millimetres
   real(wp), parameter :: least_overlap = 1.0e-4_wp

   !> Rotation at which the sides of joints are seen [rad]
   real(wp), parameter :: little = 1.0e-3_wp

contains

   !> Check a chain, and set its sense: towards +x
   subroutine check_chain(chain, outlines, error)
      type(chain_type), intent(inout) :: chain
      type(outline_type), intent(in) :: outlines(:)
      !> It does not move, or does not stand
      type(error_type), allocatable, intent(out) :: error

      type(factor_type) :: factor
      type(motion_type) :: motion
      type(chain_terms_type) :: terms

      call chain%at_rest(factor)
      if (factor%rank < size(factor%row)) then
         call raise_input(error, 'joints: '//trim(names_of(chain, factor%row(factor%rank + 1:)))// &
            & ' at rest depend on the others: they hold what is held already, and the chain has another degree of freedom', &
            & out_of_range, 'joints')
         return
      end if
      call set_at_rest(chain, motion)
      terms = terms_at(chain, motion)
      if (terms%lever < 0.0_wp) then
         chain%sense = -chain%sense
         call set_at_rest(chain, motion)
         terms = terms_at(chain, motion)
      end if
      call check_overlaps(chain, outlines, motion, error)
      if (allocated(error)) return
      if (.not. terms%lever > 0.0_wp) then
         call raise_input(error, 'lever: vanishes at rest, so that horizontal motion does not move the chain', out_of_range, &
            & 'lever')
      else if (.not. terms%moment > 0.0_wp) then
         call raise_input(error, 'moment: is '//rounded(terms%moment)//' N m at rest, must be positive: the mechanism falls by '// &
            & 'itself; '//trim(culprit(chain, motion))//' pushes it', not_at_rest, 'moment')
      end if
   end subroutine check_chain

   !> Check that bodies and what stands still do not lie in one another, and that hinges are on the side on which joints open
   subroutine check_overlaps(chain, outlines, motion, error)
      type(chain_type), intent(in) :: chain
      type(outline_type), intent(in) :: outlines(:)
      !> At rest
      type(motion_type), intent(in) :: motion
      type(error_type), allocatable, intent(out) :: error

      type(motion_type) :: ahead, back
      real(wp) :: area
      logical :: is_there
      integer :: i, k

      do i = 0, size(chain%bodies)
         do k = i + 1, size(chain%bodies)
            area = overlap_of_bodies(chain, outlines, motion, i, k)
            if (area <= least_overlap) cycle
            call raise_input(error, 'bodies: bodies '//to_text(i)//' and '//to_text(k)//' overlap at rest by '//rounded(area)// &
               & ' m2', out_of_range, 'bodies')
            return
         end do
      end do
      ahead = motion
      back = motion
      call chain%move(little, ahead, is_there)
      if (is_there) call chain%move(-little, back, is_there)
      if (.not. is_there) return
      do i = 1, size(chain%joints)
         associate (joint => chain%joints(i))
            if (joint%kind /= is_pin) cycle
            ! The joint opens by as much as it would close if the chain moved backwards.
            if (overlap_of_bodies(chain, outlines, ahead, joint%body, joint%other) <= overlap_of_bodies(chain, outlines, back, &
               & joint%body, joint%other)) cycle
            call raise_input(error, 'joints: the joint at depth '//rounded(0.0_wp - joint%at(1))//' m, height '// &
               & rounded(joint%at(2))//' m would close: bodies '//to_text(joint%body)//' and '//to_text(joint%other)// &
               & ' move into each other, the hinge is on the wrong side', out_of_range, 'joints')
            return
         end associate
      end do
   end subroutine check_overlaps

   !> Find where bodies are deepest in each other, or in what stands still (body 0), up to a rotation
   subroutine find_overlap(chain, outlines, last, overlap)
      type(chain_type), intent(in) :: chain
      type(outline_type), intent(in) :: outlines(:)
      !> [rad]
      real(wp), intent(in) :: last
      type(deepest_overlap_type), intent(out) :: overlap

      !> Rotations that are looked at
      integer, parameter :: places = 10
      type(motion_type) :: motion
      real(wp) :: depth
      logical :: is_there
      integer :: i, k, place

      call set_at_rest(chain, motion)
      do place = 1, places
         call walk_to(chain, last*real(place, wp)/real(places, wp), motion, is_there)
         if (.not. is_there) return
         do i = 0, size(chain%bodies)
            do k = i + 1, size(chain%bodies)
               depth = depth_of_overlap(chain, outlines, motion, i, k)
               if (depth > overlap%depth) overlap = deepest_overlap_type(i, k, depth, motion%q)
            end do
         end do
      end do
   end subroutine find_overlap

   !> Names of the joints of some equations: 'pin 2, guide 1'
   pure function names_of(chain, rows) result(text)
      type(chain_type), intent(in) :: chain
      integer, intent(in) :: rows(:)
      character(len=40*size(rows)) :: text

      integer :: i, row

      text = ''
      row = 0
      do i = 1, size(chain%joints)
         associate (kind => chain%joints(i)%kind)
            if (any(rows > row .and. rows <= row + kind)) text = trim(text)//', '//trim(merge('pin  ', 'guide', kind == is_pin))// &
               & ' (joint '//to_text(i)//')'
            row = row + kind
         end associate
      end do
      if (any(rows > row)) text = trim(text)//', the turn of the driver'
      text = text(3:)
   end function names_of

   !> What contributes most to overturn a chain
   pure function culprit(chain, motion) result(text)
      type(chain_type), intent(in) :: chain
      !> At rest
      type(motion_type), intent(in) :: motion
      character(len=120) :: text

      real(wp) :: place(2), rate(2), second(2), least, moment
      integer :: i

      least = huge(1.0_wp)
      text = ''
      do i = 1, size(chain%bodies)
         moment = chain%gravity*chain%gravity_share*chain%bodies(i)%mass*motion%rate(2, i)
         if (moment >= least) cycle
         least = moment
         text = 'body '//to_text(i)
      end do
      do i = 1, size(chain%actions)
         associate (action => chain%actions(i))
            call point_motion(chain, motion, action%body, action%at, place, rate, second)
            moment = chain%gravity_share*action%weight*rate(2) - sum(action%thrust*rate)
            if (moment >= least) cycle
            least = moment
            text = merge('the load  ', 'the thrust', action%weight > 0.0_wp)
            text = trim(text)//' at depth '//rounded(0.0_wp - action%at(1))//' m, height '//rounded(action%at(2))//' m'
         end associate
      end do
   end function culprit

end module dondolo_wall_chain_state
