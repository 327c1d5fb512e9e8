!> The wall that a check is of: a strip whose hinge is not close to the weakest is checked at the weakest.
module dondolo_check_checked_wall
   use dondolo_base_error, only : add_place, error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : rounded
   use dondolo_wall, only : wall_type
   use dondolo_wall_elastic_branch, only : add_elastic_joint
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_restitution, only : impact_models_type
   use dondolo_wall_two_block_model, only : two_block_model_type
   implicit none
   private

   public :: find_checked, make_again, move_hinge

   !> How much greater than the least the multiplier of a hinge may be that is checked as it is
   real(wp), parameter :: close = 1.01_wp

contains

   !> The wall that is checked: a strip whose hinge is not close to the weakest with the weakest, any other wall as it is
   subroutine find_checked(wall, checked, is_moved, error)
      type(wall_type), intent(in) :: wall
      type(wall_type), intent(out) :: checked
      !> Has its hinge been moved?
      logical, intent(out) :: is_moved
      !> The strip does not stand at rest with its weakest hinge
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: hinge, least

      checked = wall
      is_moved = .false.
      select type (model => checked%model)
      type is (two_block_model_type)
         call model%strip%find_weakest(model%hinge_range, hinge, least)
         is_moved = .not. model%strip%multiplier(checked%input%number('hinge')) <= close*least
      end select
      if (.not. is_moved) return
      call move_hinge(checked, hinge, error)
      call add_place(error, 'hinge = '//rounded(hinge)//', the weakest of the strip')
   end subroutine find_checked

   !> Give a strip another hinge
   subroutine move_hinge(wall, hinge, error)
      type(wall_type), intent(inout) :: wall
      !> Height of the hinge / height of the strip
      real(wp), intent(in) :: hinge
      !> It does not stand at rest
      type(error_type), allocatable, intent(out) :: error

      call wall%input%set('hinge', hinge)
      call make_again(wall, error)
   end subroutine move_hinge

   !> Make the mechanism of a wall whose properties have been changed
   subroutine make_again(wall, error)
      type(wall_type), intent(inout) :: wall
      !> It does not stand at rest
      type(error_type), allocatable, intent(out) :: error

      class(mechanism_type), allocatable :: mechanism
      type(impact_models_type) :: impacts
      type(error_type), allocatable :: opens_late

      call wall%model%make_mechanism(wall%input, wall%gravity, mechanism, impacts, error)
      if (allocated(error)) return
      ! Joints that would open too late about another hinge are information that is left out
      if (wall%input%has('elastic_period')) call add_elastic_joint(mechanism, wall%input%number('elastic_period'), &
         & wall%input%number('elastic_damping'), opens_late)
      call move_alloc(mechanism, wall%mechanism)
   end subroutine make_again

end module dondolo_check_checked_wall
