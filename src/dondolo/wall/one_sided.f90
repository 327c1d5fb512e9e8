!> One-sided wall: a facade or parapet that leans on transverse walls and can only fall outwards.
module dondolo_wall_one_sided
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_wall_block, only : block_type
   use dondolo_wall_restitution, only : restitution_type
   use dondolo_wall_single_block, only : single_block_type
   implicit none
   private

   public :: one_sided_type, new_one_sided, one_sided_restitution

   !> One-sided rocking block, equation (1) of Nale et al.
   type, extends(single_block_type) :: one_sided_type
   end type one_sided_type

contains

   !> Make the mechanism of a one-sided wall
   subroutine new_one_sided(mechanism, block, restitution, gravity, error)
      type(one_sided_type), intent(out) :: mechanism
      !> The wall as one block
      type(block_type), intent(in) :: block
      !> Model of restitution: equation (2), which is the impulse model of a bare block too
      type(restitution_type), intent(in) :: restitution
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> A model that does not exist for this mechanism, a speed ratio of 1 or more
      type(error_type), allocatable, intent(out) :: error

      mechanism%two_sided = .false.
      call mechanism%take_block(block, gravity)
      ! The velocity reverses, so that the speed ratio is minus the coefficient.
      call restitution%speed_ratio(mechanism%restitution, error, &
         & sorrentino=-one_sided_restitution(block%alpha), impulse=-one_sided_restitution(block%alpha))
   end subroutine new_one_sided

   !> Ratio of the angular velocities after and before an impact, equation (2) of Nale et al.
   !> (Sorrentino, AlShawa and Decanini 2011); negative: the wall bounces off the transverse wall
   pure function one_sided_restitution(alpha) result(eta)
      !> Slenderness angle [rad]
      real(wp), intent(in) :: alpha
      !> eta_1s
      real(wp) :: eta

      eta = (1.0_wp - 1.5_wp*sin(alpha)**2)**2*(1.0_wp - 1.5_wp*cos(alpha)**2)
   end function one_sided_restitution

end module dondolo_wall_one_sided
