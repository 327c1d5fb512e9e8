!> Curves of capacity of a wall that its ties hold less: C8.7.1.2.1 lets ties be considered, it does not oblige.
!>
!> A wall with less help in its model is a bound on the safe side. The ties are put in the order of the rotations at which they
!> break, and the first k of them are left out, k = 1 .. n; each strip then has the weakest hinge of its own. A strip that does not
!> stand without some of its ties has no such curve. Friction of transverse walls stays.
module dondolo_check_tie_curves
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_check_checked_wall, only : find_checked, make_again, move_hinge
   use dondolo_check_kinematic, only : kinematic_type, new_kinematic
   use dondolo_check_sheet, only : item_length
   use dondolo_wall, only : new_wall, wall_type
   use dondolo_wall_chain_model, only : chain_model_type
   use dondolo_wall_chain_ties, only : tie_numbers
   use dondolo_wall_one_block_model, only : one_block_model_type
   use dondolo_wall_properties, only : is_beyond_bare, is_of_tie
   use dondolo_wall_restraint, only : restraint_type
   use dondolo_wall_two_block_model, only : two_block_model_type
   implicit none
   private

   public :: tie_curve_type, make_tie_curves

   !> How close to the weakest a hinge is that was not given, of the height
   real(wp), parameter :: same = 1.0e-9_wp

   !> A wall without some of its ties
   type :: tie_curve_type
      !> Which are left out, 'tie 1', 'ties 1, 3'
      character(len=item_length) :: item = ''
      !> The wall and its kinematic chain
      type(wall_type) :: wall
      type(kinematic_type) :: kinematic
   end type tie_curve_type

contains

   !> Make the curves of a wall without its ties, the more without the more; none of a wall without ties
   subroutine make_tie_curves(curves, wall)
      type(tie_curve_type), allocatable, intent(out) :: curves(:)
      !> As it is given
      type(wall_type), intent(in) :: wall

      type(tie_curve_type) :: curve
      type(error_type), allocatable :: error
      logical, allocatable :: is_left_out(:)
      real(wp), allocatable :: fracture(:)
      integer :: k

      allocate (curves(0))
      if (.not. allocated(wall%mechanism%restraints)) return
      fracture = wall%mechanism%restraints(:wall%mechanism%ties)%fracture
      allocate (is_left_out(size(fracture)), source=.false.)
      do k = 1, size(fracture)
         is_left_out(minloc(fracture, dim=1, mask=.not. is_left_out)) = .true.
         curve%wall = wall
         call leave_out(curve%wall, is_left_out, error)
         if (.not. allocated(error)) call new_kinematic(curve%kinematic, curve%wall, error)
         if (allocated(error)) cycle
         curve%item = names_of(is_left_out)
         curves = [curves, curve]
      end do
   end subroutine make_tie_curves

   !> Leave ties out
   subroutine leave_out(wall, is_left_out, error)
      type(wall_type), intent(inout) :: wall
      !> Of each tie
      logical, intent(in) :: is_left_out(:)
      !> The wall does not stand so
      type(error_type), allocatable, intent(out) :: error

      type(wall_type) :: checked
      real(wp) :: hinge, least
      integer :: i
      logical :: is_moved, is_chain

      is_chain = .false.
      select type (model => wall%model)
      type is (chain_model_type)
         is_chain = .true.
      type is (one_block_model_type)
         call drop(model%body%actions%restraints)
         ! Without its ties it may be a bare rectangle, which is what it has to equal to the last bit
         if (all(is_left_out)) model%is_bare = .not. wall%input%gives(is_beyond_bare .and. .not. is_of_tie)
         call make_again(wall, error)
      type is (two_block_model_type)
         call model%strip%find_weakest(model%hinge_range, hinge, least)
         is_moved = abs(wall%input%number('hinge') - hinge) > same
         call drop(model%body%actions%restraints)
         associate (points => model%strip%points)
            model%strip%points = pack(points, [(.true., i=1, size(points) - size(is_left_out)), .not. is_left_out])
         end associate
         ! A hinge that is given is that of the wall without the ties too, unless it is far from its weakest
         if (is_moved) then
            call make_again(wall, error)
            if (.not. allocated(error)) call find_checked(wall, checked, is_moved, error)
            if (.not. allocated(error)) wall = checked
         else
            call model%strip%find_weakest(model%hinge_range, hinge, least)
            call move_hinge(wall, hinge, error)
         end if
      end select
      ! Its motion follows from its rows.
      if (is_chain) then
         associate (rows => wall%input%list('tie_table'))
            call wall%input%set('tie_table', pack(rows, [(.not. spread(is_left_out(i), 1, tie_numbers), &
               & i=1, size(is_left_out))]))
         end associate
         call new_wall(checked, wall%input, error, wall%gravity)
         if (.not. allocated(error)) wall = checked
      end if

   contains

      !> Drop the ties, which stand before friction
      subroutine drop(restraints)
         type(restraint_type), allocatable, intent(inout) :: restraints(:)

         integer :: k

         restraints = pack(restraints, [.not. is_left_out, (.true., k=size(is_left_out) + 1, size(restraints))])
      end subroutine drop

   end subroutine leave_out

   !> Names of the ties that are left out; their number where these are too long
   pure function names_of(is_left_out) result(item)
      logical, intent(in) :: is_left_out(:)
      character(len=item_length) :: item

      integer :: i

      item = trim(merge('ties', 'tie ', count(is_left_out) > 1))//' '
      do i = 1, size(is_left_out)
         if (.not. is_left_out(i)) cycle
         if (any(is_left_out(:i - 1))) item = trim(item)//','
         if (len_trim(item) + len(to_text(i)) >= len(item) - 1) then
            item = 'ties ('//to_text(count(is_left_out))//')'
            return
         end if
         item = trim(item)//' '//to_text(i)
      end do
   end function names_of

end module dondolo_check_tie_curves
