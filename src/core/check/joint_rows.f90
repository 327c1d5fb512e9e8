!> Joints that bend before they open in the sheet of a check: information beside the checks, which are those of rigid blocks.
!>
!>     a_y = J_y w^2 q_y/L_y against S_eZ(T_e, xi_e), T_e = 2 pi/w           docs/theory.md, "Joints that bend"
module dondolo_check_joint_rows
   use dondolo_base_kinds, only : wp
   use dondolo_check_floor_spectrum, only : floor_spectrum_type
   use dondolo_check_kinematic, only : kinematic_type
   use dondolo_check_sheet, only : sheet_type, shown, working_type
   implicit none
   private

   public :: put_joint, put_joint_demand

contains

   !> Put period and damping of a strip whose joints bend, and where they open
   pure subroutine put_joint(sheet, kinematic)
      type(sheet_type), intent(inout) :: sheet
      type(kinematic_type), intent(in) :: kinematic

      associate (joint => kinematic%joint)
         if (.not. joint%exists) return
         call sheet%add('mechanism', '', 'elastic_period', joint%period)
         call sheet%add('mechanism', '', 'elastic_damping', joint%damping)
         call sheet%add('mechanism', '', 'opening_acceleration', joint%opening_acceleration())
      end associate
   end subroutine put_joint

   !> Put the spectral acceleration at that period, and capacity / demand of the opening
   pure subroutine put_joint_demand(sheet, state, kinematic, knowledge_factor, spectrum)
      type(sheet_type), intent(inout) :: sheet
      !> Limit state
      character(len=*), intent(in) :: state
      type(kinematic_type), intent(in) :: kinematic
      !> Confidence factor FC
      real(wp), intent(in) :: knowledge_factor
      type(floor_spectrum_type), intent(in) :: spectrum

      real(wp) :: demand

      associate (joint => kinematic%joint, g => kinematic%gravity)
         if (.not. joint%exists) return
         demand = spectrum%acceleration(joint%period, joint%damping)
         call sheet%add('linear', state, 'opening_demand', demand)
         call sheet%add('linear', state, 'opening_ratio', joint%opening_acceleration()/(knowledge_factor*g*demand), &
            & working=working_type('a_y/[g FC S_eZ(T_e)]', trim(shown(joint%opening_acceleration()))//'/('//trim(shown(g))// &
            & ' * '//trim(shown(knowledge_factor))//' * '//trim(shown(demand))//')'))
      end associate
   end subroutine put_joint_demand

end module dondolo_check_joint_rows
