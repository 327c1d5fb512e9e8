!> Free-standing wall: a parapet, pinnacle or statue that rocks to both sides (Housner's block).
module dondolo_wall_free_standing
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_wall_block, only : block_type
   use dondolo_wall_restitution, only : restitution_type
   use dondolo_wall_single_block, only : single_block_type
   implicit none
   private

   public :: free_standing_type, new_free_standing, housner_restitution

   !> Two-sided rocking block
   type, extends(single_block_type) :: free_standing_type
   end type free_standing_type

contains

   !> Make the mechanism of a free-standing wall
   subroutine new_free_standing(mechanism, block, restitution, gravity, error)
      type(free_standing_type), intent(out) :: mechanism
      !> The wall as one block
      type(block_type), intent(in) :: block
      !> Model of restitution: 'default' and 'impulse' are Housner's balance
      type(restitution_type), intent(in) :: restitution
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> A model that does not exist for this mechanism, a speed ratio of 1 or more
      type(error_type), allocatable, intent(out) :: error

      mechanism%two_sided = .true.
      call mechanism%take_block(block, gravity)
      call restitution%speed_ratio(mechanism%restitution, error, impulse=housner_restitution(block%alpha))
   end subroutine new_free_standing

   !> Ratio of the angular velocities after and before an impact: balance of angular momentum about
   !> the new corner (Housner 1963)
   pure function housner_restitution(alpha) result(eta)
      !> Slenderness angle [rad]
      real(wp), intent(in) :: alpha
      !> eta
      real(wp) :: eta

      eta = 1.0_wp - 1.5_wp*sin(alpha)**2
   end function housner_restitution

end module dondolo_wall_free_standing
