!> Hinges that slide: the friction that each needs when the mechanism starts, and with a friction that is given the multiplier at
!> which the hinge of a wall that turns about its base slides (C8.7.1.2.1, which lets friction be considered):
!>
!>     H = alpha_0 sum (P + Q) + sum H - sum T      mu = |H|/V      alpha_s = [mu V - sum H + sum T]/sum (P + Q)
!>
!> Below alpha_0 nothing determines the forces at the hinges of a strip, so that it has the friction alone.
module dondolo_check_sliding_rows
   use dondolo_base_kinds, only : wp
   use dondolo_check_kinematic, only : kinematic_type
   use dondolo_check_sheet, only : sheet_type, shown, working_type
   implicit none
   private

   public :: put_sliding

   !> How much less than the other a number must be to be counted so
   real(wp), parameter :: same = 1.0e-12_wp

contains

   !> Put the hinges of a wall
   subroutine put_sliding(sheet, kinematic, friction)
      type(sheet_type), intent(inout) :: sheet
      type(kinematic_type), intent(in) :: kinematic
      !> Coefficient of friction at the hinges; 0: not given
      real(wp), intent(in) :: friction

      character(len=*), parameter :: hinges(3) = [character(len=12) :: 'base hinge', 'middle hinge', 'top hinge']
      integer :: i

      if (friction > 0.0_wp) call sheet%add('mechanism', '', 'friction', friction, 'C8.7.1.2.1')
      if (kinematic%hinge > 0.0_wp) then
         associate (floors => kinematic%floors)
            do i = 1, size(hinges)
               if (floors%down(i) > 0.0_wp) call put_hinge(hinges(i), floors%across(i), floors%down(i))
            end do
         end associate
      else if (kinematic%carried > 0.0_wp) then
         call put_base(trim(hinges(1)))
      end if

   contains

      !> Put the friction that a hinge needs, and whether it has it
      subroutine put_hinge(item, across, down)
         character(len=*), intent(in) :: item
         !> Horizontal and vertical force at the hinge [N/m]
         real(wp), intent(in) :: across, down

         call put_needed(item, across, down)
         if (friction > 0.0_wp) call put_verdict(item, .not. friction < across/down*(1.0_wp - same))
      end subroutine put_hinge

      !> Put the hinge of a wall that turns about its base
      subroutine put_base(item)
         character(len=*), intent(in) :: item

         real(wp) :: multiplier

         associate (down => kinematic%carried, thrust => kinematic%thrust, tie => kinematic%restraint, moved => kinematic%weight)
            call put_needed(item, abs(kinematic%multiplier*moved + thrust - tie), down)
            if (.not. friction > 0.0_wp) return
            multiplier = (friction*down - thrust + tie)/moved
            call sheet%add('mechanism', '', 'sliding_alpha', multiplier, item=item, working=working_type( &
               & '(mu_d V - sum H + sum T)/sum P', '('//trim(shown(friction))//' * '//trim(shown(down))//' - '// &
               & trim(shown(thrust))//' + '//trim(shown(tie))//')/'//shown(moved)))
         end associate
         call put_verdict(item, .not. multiplier < kinematic%multiplier*(1.0_wp - same))
      end subroutine put_base

      !> Put the friction that a hinge needs
      subroutine put_needed(item, across, down)
         character(len=*), intent(in) :: item
         !> Horizontal and vertical force at the hinge [N/m]
         real(wp), intent(in) :: across, down

         call sheet%add('mechanism', '', 'friction_needed', across/down, item=item, working=working_type('H/V', &
            & trim(shown(across))//'/'//shown(down)))
      end subroutine put_needed

      !> Put whether a hinge turns before it slides
      subroutine put_verdict(item, turns_first)
         character(len=*), intent(in) :: item
         logical, intent(in) :: turns_first

         call sheet%add('mechanism', '', 'turns_first', merge(1.0_wp, 0.0_wp, turns_first), item=item)
      end subroutine put_verdict

   end subroutine put_sliding

end module dondolo_check_sliding_rows
