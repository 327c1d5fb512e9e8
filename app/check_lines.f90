!> What is printed of a check by a building code.
module dondolo_check_lines
   use, intrinsic :: iso_fortran_env, only : output_unit
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_probability, only : probability_text
   use dondolo_base_text, only : counted, right, rounded, to_text
   use dondolo_base_warning, only : warnings_type
   use dondolo_case_check_rows, only : check_methods, check_states, verdicts_type
   use dondolo_check_input, only : check_input_type, state_names
   use dondolo_check_notes, only : make_check_notes
   use dondolo_check_safety, only : new_safety, shown_years
   use dondolo_check_sheet, only : sheet_type
   implicit none
   private

   public :: print_check, print_verdicts

contains

   !> Print a check at a glance; the whole sheet is in its table
   subroutine print_check(sheet, was_run)
      type(sheet_type), intent(in) :: sheet
      !> Have histories been run?
      logical, intent(in) :: was_run

      type(warnings_type) :: notes
      type(lines_type) :: sentences
      integer :: i, k

      write (output_unit, '(a)') 'check by NTC 2018 and Circolare 7/2019, C8.7.1.2.1: alpha_0 '// &
         & rounded(sheet%value('mechanism', '', 'alpha_0'))//', e* '//rounded(sheet%value('mechanism', '', 'mass_ratio'))// &
         & ', a_0* '//rounded(sheet%value('mechanism', '', 'a_0'))//' m/s2, d_0* '// &
         & rounded(sheet%value('mechanism', '', 'd_0'))//' m'
      write (output_unit, '(a, 5a14)') 'kinematic    ', 'limit state', 'a_g S, g', 'capacity, g', 'ratio', 'P(collapse)'
      do i = 1, size(check_states)
         write (output_unit, '(a, 2a14)', advance='no') check_methods(i)//'    ', check_states(i), cell('site', 'pga')
         if (sheet%is_all_one(check_methods(i), 'applicable', check_states(i))) then
            write (output_unit, '(3a14)') cell(check_methods(i), 'capacity_pga'), cell(check_methods(i), 'ratio'), &
               & cell(check_methods(i), 'probability')
         else
            write (output_unit, '(a)') '  not applicable: an anchor gives way before its bar yields'
         end if
      end do
      if (sheet%value('nonlinear', 'SLV', 'return_period_capacity') > 0.0_wp) then
         write (output_unit, '(a)', advance='no') 'return period of '// &
            & 'the capacity, nonlinear SLV: '//trim(shown_years(new_safety(sheet)))//', of the hazard '// &
            & rounded(sheet%value('site', 'SLV', 'return_period_demand'))//' years'
         if (sheet%value('nonlinear', 'SLV', 'extrapolated') > 0.0_wp) write (output_unit, '(a)', advance='no') &
            & '; extrapolated beyond the hazards of the limit states'
         write (output_unit, '(a)') ''
      end if
      call print_ties(sheet)
      do k = 2, size(state_names)
         if (sheet%value('dynamic', state_names(k), 'histories') > 0.0_wp) then
            call print_histories(sheet, state_names(k))
         else if (was_run) then
            write (output_unit, '(a)') 'dynamic '//state_names(k)//': left out, since each level has records of its own '// &
               & 'and none is followed to d_0* at a_g S = '//rounded(sheet%value('site', state_names(k), 'pga'))//' g'
         end if
      end do
      if (sheet%value('site', 'SLV', 'probability') >= 0.0_wp) write (output_unit, '(a)') 'probability of collapse at a_g S = '// &
         & rounded(sheet%value('site', 'SLV', 'pga'))//' g: '//trim(probability_text(sheet%value('site', 'SLV', 'probability')))// &
         & '; P(collapse) above is evaluated at the capacity'
      if (sheet%value('dynamic', 'SLV', 'histories') > 0.0_wp) then
         write (output_unit, '(a)') 'note: NTC 2018, 3.2.3.6 requires records that are compatible with the spectrum of the '// &
            & 'site, which is not checked'
      end if
      if (sheet%value('site', 'SLD', 'pga') >= sheet%value('site', 'SLC', 'pga')) then
         write (output_unit, '(a)') 'note: one hazard is given for all limit states; that of the code '// &
            & 'is lower for SLD, and higher for SLC'
      end if
      call make_check_notes(sheet, notes)
      call notes%put_sentences(sentences)
      do i = 1, sentences%count
         write (output_unit, '(a)') 'note: '//sentences%line(i)%text
      end do
      write (output_unit, '(a)') ''

   contains

      !> A number of the sheet in the table, right in its column
      function cell(method, name)
         character(len=*), intent(in) :: method, name
         !> Its text, a dash where there is none
         character(len=14) :: cell

         real(wp) :: value

         value = sheet%value(method, check_states(i), name)
         cell = right('-', len(cell))
         if (value >= 0.0_wp) cell = right(rounded(value), len(cell))
         if (name == 'probability' .and. value >= 0.0_wp) cell = right(trim(probability_text(value)), len(cell))
      end function cell

   end subroutine print_check

   !> Print what each tie holds, and which of its parts gives way first
   subroutine print_ties(sheet)
      type(sheet_type), intent(in) :: sheet

      character(len=*), parameter :: parts(5) = [character(len=7) :: 'bar', 'bearing', 'shear', 'cone', 'band']
      character(len=:), allocatable :: item, text
      real(wp) :: forces(size(parts))
      integer :: i, k

      i = 1
      item = 'tie 1'
      do while (sheet%value('tie', '', 'tie_force_per_m', item) >= 0.0_wp)
         text = item//': holds '//rounded(sheet%value('tie', '', 'tie_force_per_m', item))//' N/m'
         forces = [(sheet%value('tie', '', trim(parts(k))//'_force', item), k=1, size(parts))]
         if (forces(1) > 0.0_wp) text = text//', by its '//trim(parts(minloc(forces, dim=1, mask=forces > 0.0_wp)))//':'
         do k = 1, size(parts)
            if (forces(k) > 0.0_wp) text = text//trim(merge(',', ' ', k > 1))//' '//trim(parts(k))//' '//rounded(forces(k))// &
               & ' N'
         end do
         if (.not. forces(1) > 0.0_wp) text = text//'; bar '//rounded(sheet%value('tie', '', 'bar_force_per_m', item))// &
            & ' N/m, anchor '//trim(merge('not checked', 'given      ', sheet%value('tie', '', 'anchor_checked', item) <= 0.0_wp))
         write (output_unit, '(a)') text
         i = i + 1
         item = 'tie '//to_text(i)
      end do
   end subroutine print_ties

   !> Print the checks of a population at a glance; those of each row are in their table
   subroutine print_verdicts(verdicts, input)
      type(verdicts_type), intent(in) :: verdicts
      type(check_input_type), intent(in) :: input

      integer :: i

      write (output_unit, '(a)') 'check by NTC 2018 and Circolare 7/2019, C8.7.1.2.1, of '//counted(verdicts%checked, 'row')
      if (verdicts%others > 0) write (output_unit, '(a)') 'not checked: '//counted(verdicts%others, 'row')// &
         & '; the table of checks gives the reason'
      if (verdicts%checked > 0) then
         write (output_unit, '(a, 4a14)') 'kinematic    ', 'limit state', 'a_g S, g', 'verified', 'least ratio'
         do i = 1, size(check_states)
            associate (spectrum => input%spectrum(findloc(state_names, check_states(i), dim=1)))
               write (output_unit, '(a, 4a14)') check_methods(i)//'    ', check_states(i), right(rounded(spectrum%pga), 14), &
                  & right(to_text(verdicts%verified(i)), 14), least(verdicts%least(i))
            end associate
         end do
         if (verdicts%open > 0) write (output_unit, '(a)') 'ties open (anchor not checked or weaker than the bar, plate too '// &
            & 'thin): '//counted(verdicts%open, 'row')//', not counted as verified'
      end if
      write (output_unit, '(a)') ''

   contains

      !> The least ratio of the rows that the check is applicable to, a dash if it is to none
      function least(ratio) result(cell)
         real(wp), intent(in) :: ratio
         !> Its text
         character(len=14) :: cell

         cell = right('-', len(cell))
         if (ratio < huge(ratio)) cell = right(rounded(ratio), len(cell))
      end function least

   end subroutine print_verdicts

   !> Print the criterion for time histories
   subroutine print_histories(sheet, state)
      type(sheet_type), intent(in) :: sheet
      !> Limit state
      character(len=*), intent(in) :: state

      character(len=24) :: verdict

      verdict = 'verified'
      if (sheet%has_open_ties()) verdict = 'verified if its ties are'
      if (.not. sheet%value('dynamic', state, 'verified') > 0.0_wp) verdict = 'not verified'
      write (output_unit, '(a)') 'dynamic '//state//' at a_g S = '//rounded(sheet%value('dynamic', state, 'pga'))//' g: '// &
         & to_text(nint(sheet%value('dynamic', state, 'beyond')))//' of '// &
         & to_text(nint(sheet%value('dynamic', state, 'histories')))//' histories of '// &
         & counted(nint(sheet%value('dynamic', state, 'records')), 'record')//' beyond d_0*, mean of the largest d '// &
         & rounded(sheet%value('dynamic', state, 'mean_displacement'))//' m, allowed '// &
         & rounded(sheet%value('dynamic', state, 'displacement'))//' m: '// &
         & trim(verdict)
   end subroutine print_histories

end module dondolo_check_lines
