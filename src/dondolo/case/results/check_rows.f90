!> Kinematic checks by a building code of the walls of a case: the sheet of one, and of a population a row for each wall.
module dondolo_check_rows
   use dondolo_case, only : case_type
   use dondolo_check_sheet, only : sheet_type
   use dondolo_csv_row, only : text_cell
   use dondolo_error, only : error_type
   use dondolo_fragility, only : fragility_type
   use dondolo_kinds, only : wp
   use dondolo_kinematic, only : kinematic_type, new_kinematic
   use dondolo_ntc_check, only : check_ntc
   use dondolo_member, only : member_type
   use dondolo_report_rows, only : make_wall_cells
   use dondolo_text, only : to_table
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: check_wall, make_check_row, verdicts_type
   public :: check_row_head, check_methods, check_states, shown_verdicts

   !> The kinematic checks: method and limit state
   character(len=*), parameter :: check_methods(4) = [character(len=9) :: 'linear', 'linear', 'nonlinear', 'nonlinear'], &
      & check_states(4) = [character(len=3) :: 'SLD', 'SLV', 'SLV', 'SLC']

   !> Names of the columns of the table of checks
   character(len=*), parameter :: check_row_head = 'wall,mechanism,group,alpha_0,mass_ratio,d_0_m,'// &
      & 'linear_sld_g,linear_sld_ratio,linear_slv_g,linear_slv_ratio,nonlinear_slv_g,nonlinear_slv_ratio,'// &
      & 'nonlinear_slc_g,nonlinear_slc_ratio,probability_site,probability_nonlinear_slv,note'

   !> Rows that are shown one by one
   integer, parameter :: shown_verdicts = 20

   !> What came of the check of a row; no name: it was not checked
   type :: verdict_type
      !> Name of the wall
      character(len=:), allocatable :: name
      !> Multiplier alpha_0
      real(wp) :: multiplier = 0.0_wp
      !> Capacity / demand of each check
      real(wp) :: ratio(size(check_states)) = 0.0_wp
      !> Probability of collapse at the peak acceleration of the site; negative: none
      real(wp) :: probability = -1.0_wp
   end type verdict_type

   !> What came of the checks of a population
   type :: verdicts_type
      !> Rows that were checked, and others
      integer :: checked = 0, others = 0
      !> Of the first, those that each check verifies, and the least capacity / demand
      integer :: verified(size(check_states)) = 0
      real(wp) :: least(size(check_states)) = huge(1.0_wp)
      !> The first rows, one by one
      type(verdict_type) :: first(shown_verdicts)
   end type verdicts_type

contains

   !> The kinematic check of a wall of a case that has one
   subroutine check_wall(case, wall, sheet, error, curve)
      type(case_type), intent(in) :: case
      type(wall_type), intent(in) :: wall
      type(sheet_type), intent(out) :: sheet
      !> The wall cannot be checked so
      type(error_type), allocatable, intent(out) :: error
      !> Curve of collapse, for probabilities where its measure is the peak acceleration
      type(fragility_type), intent(in), optional :: curve

      type(kinematic_type) :: kinematic

      call new_kinematic(kinematic, wall, error)
      if (allocated(error)) return
      if (case%stripes%scaling%name == 'pga') then
         call check_ntc(sheet, kinematic, case%check, curve)
      else
         call check_ntc(sheet, kinematic, case%check)
      end if
   end subroutine check_wall

   !> The check of a row of a population as a row of a table; why there is none in its last cell
   subroutine make_check_row(case, member, curve, verdicts, row)
      type(case_type), intent(in) :: case
      type(member_type), intent(in) :: member
      !> Its curve of collapse
      type(fragility_type), intent(in) :: curve
      !> Counts the row
      type(verdicts_type), intent(inout) :: verdicts
      !> Row
      character(len=:), allocatable, intent(out) :: row

      type(sheet_type) :: sheet
      type(error_type), allocatable :: error
      character(len=:), allocatable :: cells
      integer :: i

      call make_wall_cells(member%wall, case%job%spreadsheet_safe, cells)
      row = cells//','//text_cell(member%group, case%job%spreadsheet_safe)
      call check_wall(case, member%wall, sheet, error, curve)
      if (allocated(error)) then
         verdicts%others = verdicts%others + 1
         row = row//repeat(',', 14)//text_cell(error%message, case%job%spreadsheet_safe)
         return
      end if
      verdicts%checked = verdicts%checked + 1
      row = row//','//to_table(sheet%value('mechanism', '', 'alpha_0'))//','// &
         & to_table(sheet%value('mechanism', '', 'mass_ratio'))//','//to_table(sheet%value('mechanism', '', 'd_0'))
      do i = 1, size(check_states)
         associate (ratio => sheet%value(check_methods(i), check_states(i), 'ratio'))
            row = row//','//to_table(sheet%value(check_methods(i), check_states(i), 'capacity_pga'))//','//to_table(ratio)
            if (ratio >= 1.0_wp) verdicts%verified(i) = verdicts%verified(i) + 1
            verdicts%least(i) = min(verdicts%least(i), ratio)
            if (verdicts%checked <= shown_verdicts) verdicts%first(verdicts%checked)%ratio(i) = ratio
         end associate
      end do
      if (verdicts%checked <= shown_verdicts) then
         associate (verdict => verdicts%first(verdicts%checked))
            verdict%name = member%wall%name()
            verdict%multiplier = sheet%value('mechanism', '', 'alpha_0')
            verdict%probability = sheet%value('site', 'SLV', 'probability')
         end associate
      end if
      row = row//','//trim(chance('site'))//','//trim(chance('nonlinear'))//','

   contains

      !> Probability of collapse at the peak acceleration of SLV; empty where there is none
      function chance(method) result(cell)
         !> 'site', or the check that says what the wall withstands
         character(len=*), intent(in) :: method
         !> Cell
         character(len=48) :: cell

         real(wp) :: value

         value = sheet%value(method, 'SLV', 'probability')
         cell = ''
         if (value >= 0.0_wp) cell = to_table(value)
      end function chance

   end subroutine make_check_row

end module dondolo_check_rows
