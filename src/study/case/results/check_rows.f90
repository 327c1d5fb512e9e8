!> Kinematic checks by a building code of the walls of a case: the sheet of one, and of a population a row for each wall.
module dondolo_case_check_rows
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : lower
   use dondolo_case_table, only : table_type
   use dondolo_check_calculation, only : is_given, item_type
   use dondolo_check_input, only : check_input_type
   use dondolo_check_sheet, only : sheet_type
   use dondolo_check_strip_check, only : check_by_ntc
   use dondolo_fragility, only : fragility_type
   use dondolo_population_wall_row, only : wall_row_type
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: check_wall, count_verdict, put_check, put_item, put_sheet_row, verdicts_type
   public :: check_methods, check_states, shown_verdicts, verdict_type

   !> The kinematic checks: method and limit state
   character(len=*), parameter :: check_methods(4) = [character(len=9) :: 'linear', 'linear', 'nonlinear', 'nonlinear'], &
      & check_states(4) = [character(len=3) :: 'SLD', 'SLV', 'SLV', 'SLC']

   !> Note on a wall whose check has no ratios
   character(len=*), parameter :: without_spectrum = 'no ratios: the spectrum at the level of its base is not given (&building)'

   !> Rows that are shown one by one
   integer, parameter :: shown_verdicts = 20

   !> What came of the check of a row; no name: it was not checked
   type :: verdict_type
      !> Name of the wall
      character(len=:), allocatable :: name
      !> Its mechanism
      character(len=:), allocatable :: mechanism
      !> Multiplier alpha_0
      real(wp) :: multiplier = 0.0_wp
      !> Capacity / demand of each check
      real(wp) :: ratio(size(check_states)) = 0.0_wp
      !> Is each check one for the wall?
      logical :: is_applicable(size(check_states)) = .true.
      !> Probability of collapse at the peak acceleration of the site; negative: none
      real(wp) :: probability = -1.0_wp
   end type verdict_type

   !> What came of the checks of a population
   type :: verdicts_type
      !> Rows that were checked, and others
      integer :: checked = 0, others = 0
      !> Of the first, those with open ties, those of floors that the ground governs, those with the FC of LC1 in place of the one
      !> that is given, those with a hinge that slides first, those that satisfy what the verdict rests on, those without open ties
      !> and sliding hinges that each check verifies, and the least capacity / demand where the check is applicable
      integer :: open = 0, of_ground = 0, raised = 0, sliding = 0, satisfied = 0
      integer :: verified(size(check_states)) = 0
      real(wp) :: least(size(check_states)) = huge(1.0_wp)
      !> The first rows, one by one
      type(verdict_type) :: first(shown_verdicts)
   end type verdicts_type

contains

   !> The kinematic check of a wall at a site
   subroutine check_wall(wall, site, im, sheet, error, curve, searches)
      type(wall_type), intent(in) :: wall
      type(check_input_type), intent(in) :: site
      !> Intensity measure of the curve
      character(len=*), intent(in) :: im
      type(sheet_type), intent(out) :: sheet
      !> The wall cannot be checked so
      type(error_type), allocatable, intent(out) :: error
      !> Curve of collapse, for probabilities where its measure is the peak acceleration
      type(fragility_type), intent(in), optional :: curve
      !> Is the least safety index of a strip looked for, over all its hinges? No, if absent
      logical, intent(in), optional :: searches

      if (im == 'pga') then
         call check_by_ntc(sheet, wall, site, error, curve, searches)
      else
         call check_by_ntc(sheet, wall, site, error, searches=searches)
      end if
   end subroutine check_wall

   !> The check of a row of a population; why there is none in its last cell
   subroutine put_check(table, group, sheet, error)
      class(table_type), intent(inout) :: table
      !> Group of the wall
      character(len=*), intent(in) :: group
      type(sheet_type), intent(in) :: sheet
      !> Why there is no sheet
      type(error_type), allocatable, intent(in) :: error

      character(len=:), allocatable :: note, name
      integer :: i

      note = ''
      if (allocated(error)) then
         note = error%message
      else if (.not. sheet%has_ratios()) then
         note = without_spectrum
      end if
      call table%put('group', group)
      call put_value('alpha_0', 'mechanism', '', 'alpha_0')
      call put_value('mass_ratio', 'mechanism', '', 'mass_ratio')
      call put_value('d_0_m', 'mechanism', '', 'd_0')
      do i = 1, size(check_states)
         name = trim(check_methods(i))//'_'//lower(check_states(i))
         call put_outcome(name//'_g', 'capacity_pga')
         call put_outcome(name//'_ratio', 'ratio')
      end do
      name = 'SLV'
      if (.not. allocated(error)) name = sheet%ultimate()
      call put_value('zeta_e', 'nonlinear', name, 'zeta_e')
      call table%put('satisfied', merge(1, 0, is_satisfied()), .not. allocated(error))
      call put_value('probability_site', 'site', 'SLV', 'probability')
      call put_value('probability_nonlinear_slv', 'nonlinear', 'SLV', 'probability')
      call put_flag('anchors_checked', 'anchor_checked')
      call put_flag('hierarchy', 'hierarchy')
      call put_flag('plates_verified', 'plate_verified')
      call table%put('note', note)

   contains

      !> Are the checks that the verdict rests on satisfied?
      logical function is_satisfied()
         is_satisfied = .not. allocated(error)
         if (is_satisfied) is_satisfied = sheet%is_satisfied()
      end function is_satisfied

      !> Put the result of a check, empty if it is not applicable to the wall
      subroutine put_outcome(name, quantity)
         !> Name of the column
         character(len=*), intent(in) :: name
         !> Quantity of the sheet
         character(len=*), intent(in) :: quantity

         real(wp) :: value
         logical :: is_given

         value = -1.0_wp
         is_given = .not. allocated(error)
         if (is_given) is_given = sheet%is_all_one(check_methods(i), 'applicable', check_states(i))
         if (is_given) value = sheet%value(check_methods(i), check_states(i), quantity)
         call table%put(name, value, is_given)
      end subroutine put_outcome

      !> Put a value of the sheet; a probability is less than 0 where there is none
      subroutine put_value(name, method, state, quantity)
         !> Name of the column
         character(len=*), intent(in) :: name
         !> Part of the check, limit state and quantity
         character(len=*), intent(in) :: method, state, quantity

         real(wp) :: value

         value = -1.0_wp
         if (.not. allocated(error)) value = sheet%value(method, state, quantity)
         call table%put(name, value, .not. allocated(error) .and. .not. (quantity == 'probability' .and. value < 0.0_wp))
      end subroutine put_value

      !> Put 1 if all ties have 1 in the sheet, 0 if one has not; nothing where none is asked
      subroutine put_flag(name, quantity)
         !> Name of the column
         character(len=*), intent(in) :: name
         !> Quantity of the sheet
         character(len=*), intent(in) :: quantity

         call table%put(name, merge(1, 0, sheet%is_all_one('tie', quantity)), .not. allocated(error) .and. &
            & sheet%value('tie', '', quantity) >= 0.0_wp)
      end subroutine put_flag

   end subroutine put_check

   !> Count the check of a row
   subroutine count_verdict(verdicts, row, sheet, is_checked)
      type(verdicts_type), intent(inout) :: verdicts
      type(wall_row_type), intent(in) :: row
      type(sheet_type), intent(in) :: sheet
      !> Can the wall be checked?
      logical, intent(in) :: is_checked

      real(wp) :: ratio(size(check_states))
      logical :: is_applicable(size(check_states)), has_ratios
      integer :: i

      has_ratios = is_checked
      if (has_ratios) has_ratios = sheet%has_ratios()
      if (.not. has_ratios) then
         verdicts%others = verdicts%others + 1
         return
      end if
      verdicts%checked = verdicts%checked + 1
      ratio = [(sheet%value(check_methods(i), check_states(i), 'ratio'), i=1, size(check_states))]
      is_applicable = [(sheet%is_all_one(check_methods(i), 'applicable', check_states(i)), i=1, size(check_states))]
      if (sheet%is_of_ground()) verdicts%of_ground = verdicts%of_ground + 1
      if (sheet%value('mechanism', '', 'knowledge_given') > 0.0_wp) verdicts%raised = verdicts%raised + 1
      if (sheet%has_open_ties()) verdicts%open = verdicts%open + 1
      if (sheet%slides()) verdicts%sliding = verdicts%sliding + 1
      if (sheet%is_satisfied()) verdicts%satisfied = verdicts%satisfied + 1
      if (.not. (sheet%has_open_ties() .or. sheet%slides())) then
         verdicts%verified = verdicts%verified + merge(1, 0, [(sheet%value(check_methods(i), check_states(i), 'verified') &
            & > 0.0_wp, i=1, size(check_states))])
      end if
      where (is_applicable) verdicts%least = min(verdicts%least, ratio)
      if (verdicts%checked > shown_verdicts) return
      associate (verdict => verdicts%first(verdicts%checked))
         verdict%name = row%wall%name()
         verdict%mechanism = row%wall%mechanism_name()
         verdict%multiplier = sheet%value('mechanism', '', 'alpha_0')
         verdict%ratio = ratio
         verdict%is_applicable = is_applicable
         verdict%probability = sheet%value('site', 'SLV', 'probability')
      end associate
   end subroutine count_verdict

   !> A line of a sheet; the meaning of a quantity may have commas
   subroutine put_sheet_row(table, sheet, number)
      class(table_type), intent(inout) :: table
      type(sheet_type), intent(in) :: sheet
      !> Number of the line
      integer, intent(in) :: number

      associate (row => sheet%rows(number))
         call table%put('method', trim(row%method))
         call table%put('limit_state', trim(row%state))
         call table%put('quantity', trim(row%quantity%name))
         call table%put('symbol', trim(row%quantity%symbol))
         call table%put('value', row%value)
         call table%put('unit', trim(row%quantity%unit))
         call table%put('formula', trim(row%formula))
         call table%put('meaning', trim(row%quantity%meaning), is_quoted=.true.)
         call table%put('item', trim(row%item))
         call table%put('expression', trim(row%working%expression), is_quoted=.true.)
         call table%put('numbers', trim(row%working%numbers), is_quoted=.true.)
         call table%put('bound', trim(row%bound))
      end associate
   end subroutine put_sheet_row

   !> An item of the calculation
   subroutine put_item(table, item, is_whole)
      class(table_type), intent(inout) :: table
      type(item_type), intent(in) :: item
      !> Are forces and moments those of a whole body, and not per metre of wall?
      logical, intent(in) :: is_whole

      character(len=:), allocatable :: per

      per = '_m'
      if (is_whole) per = ''
      call table%put('item', trim(item%name))
      call table%put('force_n'//per, item%force, is_given(item%force))
      call table%put('depth_m', item%depth, is_given(item%depth))
      call table%put('arm_m', item%arm, is_given(item%arm))
      call table%put('lever_m', item%lever, is_given(item%lever))
      call table%put('stabilising_nm'//per, item%stabilising, is_given(item%stabilising))
      call table%put('overturning_nm'//per, item%overturning, is_given(item%overturning))
      call table%put('force_lever_nm'//per, item%first, is_given(item%first))
      call table%put('force_lever2_nm2'//per, item%second, is_given(item%second))
   end subroutine put_item

end module dondolo_case_check_rows
