!> What is printed of a check by a building code.
module dondolo_check_lines
   use, intrinsic :: iso_fortran_env, only : output_unit
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_text, only : brief, counted, right, rounded, to_text
   use dondolo_base_warning, only : warnings_type
   use dondolo_case_check_rows, only : check_methods, check_states, verdicts_type
   use dondolo_check_input, only : check_input_type, full_factor, state_names
   use dondolo_check_notes, only : make_check_notes
   use dondolo_check_safety, only : new_safety, shown_years
   use dondolo_check_sheet, only : sheet_type
   use dondolo_files_probability, only : probability_text
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
      if (sheet%value('site', '', 'latitude') > 0.0_wp) call print_place(sheet)
      call print_states(sheet)
      if (sheet%has_ratios()) then
         call print_verdict(sheet)
      else
         write (output_unit, '(a)') 'verdict: none, there is no spectrum at the level of the wall'
      end if
      if (sheet%value('nonlinear', sheet%ultimate(), 'return_period_capacity') > 0.0_wp) then
         write (output_unit, '(a)', advance='no') 'return period of '// &
            & 'the capacity, nonlinear '//sheet%ultimate()//': '//trim(shown_years(new_safety(sheet)))//', of the hazard '// &
            & rounded(sheet%value('site', sheet%ultimate(), 'return_period_demand'))//' years'
         if (sheet%value('nonlinear', sheet%ultimate(), 'extrapolated') > 0.0_wp) write (output_unit, '(a)', advance='no') &
            & '; extrapolated beyond the hazards of the limit states'
         write (output_unit, '(a)') ''
      end if
      call print_ties(sheet)
      do k = 2, size(state_names)
         if (sheet%value('dynamic', state_names(k), 'histories') > 0.0_wp) then
            call print_histories(sheet, state_names(k))
         else if (was_run .and. sheet%has_ratios()) then
            write (output_unit, '(a)') 'dynamic '//state_names(k)//': left out, since each level has records of its own '// &
               & 'and none is followed to d_0* at a_g S = '//rounded(sheet%value('site', state_names(k), 'pga'))//' g'
         end if
      end do
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

   end subroutine print_check

   !> Print a line for each kinematic check: what the wall withstands beside what is asked of it, and how likely collapse is at
   !> the peak acceleration that the check allows and at that of the site
   subroutine print_states(sheet)
      type(sheet_type), intent(in) :: sheet

      integer, parameter :: width = 12
      !> Above 1 by more than products of rounded numbers are
      real(wp), parameter :: rounding = 1.0_wp + 1.0e-9_wp
      character(len=:), allocatable :: line
      real(wp) :: capacity, demand
      integer :: i

      line = 'kinematic     '//right('capacity', 14)//right('demand', 14)//right('ratio', width)//right('a_g S, g', width)// &
         & right('allowed, g', width)//'  '//left('verified', 16)
      if (has_curve()) line = line//left('P(collapse) where allowed', 32)//'at a_g S'
      write (output_unit, '(a)') trim(line)
      do i = 1, size(check_states)
         line = check_methods(i)//' '//check_states(i)//' '
         if (sheet%is_all_one(check_methods(i), 'applicable', check_states(i))) then
            capacity = sheet%value(trim(taken()), check_states(i), 'displacement')
            demand = sheet%value(trim(taken()), check_states(i), 'demand')
            if (check_methods(i) == 'linear') then
               capacity = sheet%value('mechanism', '', 'a_0')
               if (check_states(i) == 'SLV') capacity = capacity*sheet%value('linear', 'SLV', 'behaviour')
               demand = capacity/sheet%value('linear', check_states(i), 'ratio')
            end if
            line = line//length(capacity)//length(demand)//cell(check_methods(i), 'ratio')//cell('site', 'pga')// &
               & cell(check_methods(i), 'capacity_pga')//'  '//left(outcome(), 16)
            if (has_curve()) line = line//left(chance(check_methods(i)), 32)//chance('site')
         else
            line = line//'  not applicable: '//trim(reason())
         end if
         write (output_unit, '(a)') trim(line)
      end do
      do i = 1, size(check_states)
         if (check_methods(i) /= 'nonlinear' .or. .not. sheet%has_ratios()) cycle
         if (taken() == 'untied') write (output_unit, '(a)') 'nonlinear '//check_states(i)//': without the ties whose anchors '// &
            & 'or bars would lower it, see the note'
         if (sheet%value('nonlinear', check_states(i), 'ratio')*sheet%value(trim(taken()), check_states(i), 'demand') > &
            & rounding*sheet%value(trim(taken()), check_states(i), 'displacement')) write (output_unit, '(a)') 'nonlinear '// &
            & check_states(i)//': the ratio is that of accelerations at activation, which is greater (C8.7.1.2.1.8)'
      end do
      if (has_curve()) write (output_unit, '(a)') 'P(collapse): by the fragility curve, with its 95 % interval, at the peak '// &
         & 'acceleration that the check allows and at that of the site'

   contains

      !> Why a check is not applicable
      function reason()
         character(len=41) :: reason

         reason = 'an anchor gives way before its bar yields'
         if (sheet%lacks_modulus()) reason = 'a free element without young_modulus'
         if (.not. sheet%has_ratios()) reason = 'no spectrum at the level of the wall'
      end function reason

      !> The curve that a nonlinear check takes: with all ties, or without some
      function taken() result(method)
         character(len=9) :: method

         method = 'nonlinear'
         associate (state => check_states(i))
            if (sheet%value(method, state, 'less_zeta') > sheet%value(method, state, 'tied_zeta')) method = 'untied'
         end associate
      end function taken

      !> Does the sheet have probabilities?
      logical function has_curve()
         has_curve = sheet%value('site', 'SLV', 'probability') >= 0.0_wp
      end function has_curve

      !> Whether the check is verified
      function outcome()
         character(len=16) :: outcome

         outcome = 'yes'
         if (sheet%slides()) outcome = 'if none slides'
         if (sheet%has_open_ties()) outcome = 'if its ties are'
         if (.not. sheet%value(check_methods(i), check_states(i), 'verified') > 0.0_wp) outcome = 'no'
      end function outcome

      !> A number of the sheet in the table, right in its column
      function cell(method, name)
         character(len=*), intent(in) :: method, name
         !> Its text, a dash where there is none
         character(len=width) :: cell

         real(wp) :: value

         value = sheet%value(method, check_states(i), name)
         cell = right('-', len(cell))
         if (value >= 0.0_wp) cell = right(rounded(value), len(cell))
      end function cell

      !> Capacity or demand of the check with its unit
      function length(value)
         real(wp), intent(in) :: value
         !> Its text, a dash where there is none
         character(len=14) :: length

         length = right('-', len(length))
         if (value >= 0.0_wp) length = right(rounded(value)//' '//trim(merge('m/s2', 'm   ', check_methods(i) == 'linear')), &
            & len(length))
      end function length

      !> A probability with its interval
      function chance(method)
         !> Part of the check
         character(len=*), intent(in) :: method
         !> Its text, filled up with blanks
         character(len=30) :: chance

         character(len=:), allocatable :: high

         chance = probability_text(sheet%value(method, check_states(i), 'probability'))
         high = trim(probability_text(sheet%value(method, check_states(i), 'probability_high')))
         ! Of tails of the fit no more is known than that they are small
         if (sheet%value(method, check_states(i), 'probability_low') >= 0.0_wp .and. high /= chance) chance = trim(chance)// &
            & ' ('//trim(probability_text(sheet%value(method, check_states(i), 'probability_low')))//' to '//high//')'
      end function chance

      !> A text at the left of its column
      function left(text, room)
         character(len=*), intent(in) :: text
         !> Width of the column
         integer, intent(in) :: room
         !> Text, filled up with blanks
         character(len=room) :: left

         left = text
      end function left

   end subroutine print_states

   !> Print the safety index of the wall, and the verdict on what it rests on
   subroutine print_verdict(sheet)
      type(sheet_type), intent(in) :: sheet

      character(len=:), allocatable :: checks, verdict
      integer :: i

      checks = ''
      verdict = 'satisfied'
      if (sheet%slides()) verdict = 'satisfied if no hinge slides'
      if (sheet%has_open_ties()) verdict = 'satisfied if its ties are'
      do i = 1, size(check_states)
         if (.not. sheet%is_required(check_methods(i), check_states(i))) cycle
         checks = checks//' and '//trim(check_methods(i))//' '//check_states(i)
         if (.not. sheet%value(check_methods(i), check_states(i), 'verified') > 0.0_wp) verdict = 'not satisfied'
      end do
      write (output_unit, '(a)') 'verdict: '//verdict//' ('//checks(6:)//', NTC 8.3; the rest is information); zeta_E '// &
         & rounded(sheet%value('nonlinear', sheet%ultimate(), 'ratio'))
   end subroutine print_verdict

   !> Print the hazard of a site that its coordinates give
   subroutine print_place(sheet)
      type(sheet_type), intent(in) :: sheet

      character(len=:), allocatable :: nodes
      integer :: i

      nodes = ''
      do i = 1, size(sheet%rows)
         if (sheet%rows(i)%quantity%name == 'distance') nodes = nodes//', '//trim(sheet%rows(i)%item(6:))
      end do
      write (output_unit, '(a)') 'site '//brief(sheet%value('site', '', 'latitude'))//', '// &
         & brief(sheet%value('site', '', 'longitude'))//' (ED50 '//brief(sheet%value('site', '', 'latitude_ed50'))//', '// &
         & brief(sheet%value('site', '', 'longitude_ed50'))//'), between nodes '//nodes(3:)//' of the grid of hazard; V_R = '// &
         & rounded(sheet%value('site', '', 'use_coefficient'))//' * '//rounded(sheet%value('site', '', 'nominal_life'))//' years'
      do i = 1, size(state_names)
         write (output_unit, '(a)') 'hazard of '//state_names(i)//': a_g '//shown('ag')//' g, F_0 '//shown('f0')//', T_C* '// &
            & shown('tc_star')//' s, T_R '//shown('return_period_demand')//' years'
      end do

   contains

      !> A number of the limit state
      function shown(name)
         character(len=*), intent(in) :: name
         character(len=len(rounded(sheet%value('site', state_names(i), name)))) :: shown

         shown = rounded(sheet%value('site', state_names(i), name))
      end function shown

   end subroutine print_place

   !> Print what each tie holds, and which of its parts gives way first
   subroutine print_ties(sheet)
      type(sheet_type), intent(in) :: sheet

      character(len=*), parameter :: parts(5) = [character(len=7) :: 'bar', 'bearing', 'shear', 'cone', 'band']
      character(len=:), allocatable :: item, text, per
      real(wp) :: forces(size(parts))
      integer :: i, k

      i = 1
      item = 'tie 1'
      per = trim(merge('  ', '/m', sheet%is_whole))
      do while (sheet%value('tie', '', 'tie_force_per_m', item) >= 0.0_wp)
         text = item//': holds '//rounded(sheet%value('tie', '', 'tie_force_per_m', item))//' N'//per
         forces = [(sheet%value('tie', '', trim(parts(k))//'_force', item), k=1, size(parts))]
         if (forces(1) > 0.0_wp) text = text//', by its '//trim(parts(minloc(forces, dim=1, mask=forces > 0.0_wp)))//':'
         do k = 1, size(parts)
            if (forces(k) > 0.0_wp) text = text//trim(merge(',', ' ', k > 1))//' '//trim(parts(k))//' '//rounded(forces(k))// &
               & ' N'
         end do
         if (.not. forces(1) > 0.0_wp) text = text//'; bar '//rounded(sheet%value('tie', '', 'bar_force_per_m', item))// &
            & ' N'//per//', anchor '//trim(merge('not checked', 'given      ', &
            & sheet%value('tie', '', 'anchor_checked', item) <= 0.0_wp))
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
         write (output_unit, '(a)') 'satisfied where the verdict rests on it (nonlinear '//input%ultimate_state// &
            & trim(merge(', SLD', '     ', input%requires('linear', 'SLD')))//'): '//counted(verdicts%satisfied, 'row')
         if (verdicts%sliding > 0) write (output_unit, '(a)') 'a hinge slides before it turns: '// &
            & counted(verdicts%sliding, 'row')//', not counted as verified'
         if (verdicts%open > 0) write (output_unit, '(a)') 'ties open (anchor not checked or weaker than the bar, plate too '// &
            & 'thin): '//counted(verdicts%open, 'row')//', not counted as verified'
         if (verdicts%of_ground > 0) write (output_unit, '(a)') 'the ground governs: '//counted(verdicts%of_ground, 'row')// &
            & ', on floors that the modes of their building move less; by analogy with [C7.2.11]'
         if (verdicts%raised > 0) write (output_unit, '(a)') 'FC = '//rounded(full_factor)//' in place of '// &
            & rounded(input%knowledge_factor)//': '//counted(verdicts%raised, 'row')//' without compressive_strength (C8.7.1.2.1.3)'
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

      character(len=:), allocatable :: untied
      character(len=32) :: verdict

      untied = ''
      if (sheet%value('dynamic', state, 'untied_displacement') > 0.0_wp) untied = ' (without counting the ties '// &
         & rounded(sheet%value('dynamic', state, 'untied_displacement'))//' m)'
      verdict = 'verified'
      if (sheet%slides()) verdict = 'verified if no hinge slides'
      if (sheet%has_open_ties()) verdict = 'verified if its ties are'
      if (.not. sheet%value('dynamic', state, 'verified') > 0.0_wp) verdict = 'not verified'
      write (output_unit, '(a)') 'dynamic '//state//' at a_g S = '//rounded(sheet%value('dynamic', state, 'pga'))//' g: '// &
         & to_text(nint(sheet%value('dynamic', state, 'beyond')))//' of '// &
         & to_text(nint(sheet%value('dynamic', state, 'histories')))// &
         & trim(merge(' history of  ', ' histories of', nint(sheet%value('dynamic', state, 'histories')) == 1))//' '// &
         & counted(nint(sheet%value('dynamic', state, 'records')), 'record')//' beyond d_0*, mean of the largest d '// &
         & rounded(sheet%value('dynamic', state, 'mean_displacement'))//' m, allowed '// &
         & rounded(sheet%value('dynamic', state, 'displacement'))//' m'//untied//': '//trim(verdict)
   end subroutine print_histories

end module dondolo_check_lines
