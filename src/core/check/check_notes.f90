!> What a reader of a check by a building code should know of it.
module dondolo_check_notes
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : rounded
   use dondolo_base_warning, only : warning_type, warnings_type
   use dondolo_check_curve_notes, only : add_building_note, add_index_note, add_level_note
   use dondolo_check_free_notes, only : add_free_notes
   use dondolo_check_input, only : state_names
   use dondolo_check_sheet, only : sheet_type
   implicit none
   private

   public :: make_check_notes

   !> Codes
   character(len=*), parameter :: halves_jam = 'halves_jam'
   character(len=*), parameter :: hinge_above_usual = 'hinge_above_usual', hinge_below_usual = 'hinge_below_usual', &
      & hinge_not_weakest = 'hinge_not_weakest', least_elsewhere = 'least_elsewhere', top_without_load = 'top_without_load', &
      & diaphragm_not_in_demand = 'diaphragm_not_in_demand', anchor_before_bar = 'anchor_before_bar', &
      & plate_too_thin = 'plate_too_thin', anchor_factor_differs = 'anchor_factor_differs', &
      & anchor_not_checked = 'anchor_not_checked', period_beyond_spectrum = 'period_beyond_spectrum', &
      & ground_governs = 'ground_governs', return_period_held = 'return_period_held', knowledge_raised = 'knowledge_raised', &
      & serviceability = 'serviceability', slides_first = 'slides_first', friction_not_given = 'friction_not_given', &
      & sliding_unknown = 'sliding_unknown'

   !> How much greater than the least safety index over the hinges that of the weakest hinge may be, and how close to an end of
   !> their range a hinge is at it
   real(wp), parameter :: close = 1.02_wp, same = 1.0e-9_wp
   !> Friction that a hinge may need without a note where none is given
   real(wp), parameter :: usual_friction = 0.4_wp
   !> Period from which displacements of the spectrum fall on some soil [s]: NTC 2018, 3.2.3.2.3
   real(wp), parameter :: long_period = 4.5_wp

contains

   !> Make the notes
   subroutine make_check_notes(sheet, notes)
      type(sheet_type), intent(in) :: sheet
      type(warnings_type), intent(out) :: notes

      type(warning_type) :: note
      real(wp) :: period

      call add_knowledge_note(sheet, notes)
      if (sheet%is_required('linear', 'SLD')) call notes%add(warning_type(serviceability), 'class of use IV: the verdict rests '// &
         & 'on SLD too (NTC 8.3, which allows reduced levels there); SLO has no formula for local mechanisms')
      call add_free_notes(sheet, notes)
      call add_sliding_notes(sheet, notes)
      if (sheet%value('mechanism', '', 'weakest_hinge') > 0.0_wp) call add_strip_notes(sheet, notes)
      if (sheet%value('mechanism', '', 'halves_overlap') > 0.0_wp) then
         note = warning_type(halves_jam)
         call note%with('overlap_m', sheet%value('mechanism', '', 'halves_overlap'))
         call notes%add(note, 'both halves of the gable cross the plane of its axis, and would overlap by '// &
            & rounded(sheet%value('mechanism', '', 'halves_overlap'))//' m at d_0*: they jam, so that alpha_0 is on the safe '// &
            & 'side, and displacements and what follows from them are not proved')
      end if
      if (sheet%value('mechanism', '', 'diaphragm_period') > 0.0_wp) call notes%add(warning_type(diaphragm_not_in_demand), &
         & 'the flexible diaphragm at the top moves the strip in its histories, but is not in the spectrum of the code: the '// &
         & 'demand of the kinematic check may be too small')
      if (sheet%value('mechanism', '', 'level') > 0.0_wp .and. .not. sheet%has_ratios()) call add_level_note(sheet, notes)
      call add_ground_note(sheet, notes)
      call add_building_note(sheet, notes)
      call add_tie_notes(sheet, notes)
      if (sheet%value('nonlinear', 'SLV', 'tied_zeta') > 0.0_wp) call add_index_note(sheet, notes)
      call add_hazard_notes(sheet, notes)
      period = max(sheet%value('nonlinear', 'SLV', 'period'), sheet%value('nonlinear', 'SLC', 'period'))
      if (period > long_period) then
         note = warning_type(period_beyond_spectrum)
         call note%with('period_s', period)
         call note%with('limit_s', long_period)
         call notes%add(note, 'the equivalent period reaches '//rounded(period)//' s; beyond T_E, '//rounded(long_period)// &
            & ' s or more by the soil, the displacements of NTC 2018, 3.2.3.2.3 fall, and the demand of the check does not')
      end if
   end subroutine make_check_notes

   !> Note on a confidence factor that is not enough without a compressive strength
   subroutine add_knowledge_note(sheet, notes)
      type(sheet_type), intent(in) :: sheet
      type(warnings_type), intent(inout) :: notes

      type(warning_type) :: note
      real(wp) :: given, used

      given = sheet%value('mechanism', '', 'knowledge_given')
      if (.not. given > 0.0_wp) return
      used = sheet%value('mechanism', '', 'knowledge_factor')
      note = warning_type(knowledge_raised)
      call note%with('knowledge_given', given)
      call note%with('knowledge_factor', used)
      call notes%add(note, 'the confidence factor of the check is '//rounded(used)//', that of LC1, in place of '// &
         & rounded(given)//': no compressive_strength is given, so that alpha_0 does not account for it (C8.7.1.2.1.3)')
   end subroutine add_knowledge_note

   !> Notes on hinges that slide before they turn, or need much friction where none is given
   subroutine add_sliding_notes(sheet, notes)
      type(sheet_type), intent(in) :: sheet
      type(warnings_type), intent(inout) :: notes

      type(warning_type) :: note
      real(wp) :: friction
      integer :: i

      if (.not. sheet%value('mechanism', '', 'friction_needed') >= 0.0_wp) call notes%add(warning_type(sliding_unknown), &
         & 'the forces at the hinges of a table, a chain or an inclined axis are not known: whether they slide before they '// &
         & 'turn is not checked')
      friction = sheet%value('mechanism', '', 'friction')
      do i = 1, size(sheet%rows)
         associate (row => sheet%rows(i))
            if (row%method /= 'mechanism' .or. row%quantity%name /= 'friction_needed') cycle
            if (friction > 0.0_wp) then
               if (sheet%value('mechanism', '', 'turns_first', row%item) > 0.0_wp) cycle
               call begin(slides_first)
               call note%with('friction', friction)
               call notes%add(note, 'the '//trim(row%item)//' slides before it turns: friction = '//rounded(friction)// &
                  & ', and it needs '//rounded(row%value)//' when the mechanism starts, at '// &
                  & 'alpha_0 = '//rounded(sheet%value('mechanism', '', 'alpha_0')))
            else if (row%value > usual_friction) then
               call begin(friction_not_given)
               call notes%add(note, 'the '//trim(row%item)//' needs a friction of '//rounded(row%value)//' to turn rather '// &
                  & 'than slide when the mechanism starts; whether it has it is not checked: friction is not given')
            end if
         end associate
      end do

   contains

      !> Begin a note on the hinge
      subroutine begin(code)
         character(len=*), intent(in) :: code

         note = warning_type(code)
         call note%about('item', trim(sheet%rows(i)%item))
         call note%with('friction_needed', sheet%rows(i)%value)
         call note%with('alpha_0', sheet%value('mechanism', '', 'alpha_0'))
      end subroutine begin

   end subroutine add_sliding_notes

   !> Note on a floor that the modes of the building move less than the ground does
   subroutine add_ground_note(sheet, notes)
      type(sheet_type), intent(in) :: sheet
      type(warnings_type), intent(inout) :: notes

      type(warning_type) :: note
      character(len=:), allocatable :: symbol
      integer :: i

      do i = 1, size(sheet%rows)
         ! The row after it is what counts, that of the ground
         associate (row => sheet%rows(i))
            if (row%quantity%name /= 'modal_pga' .and. row%quantity%name /= 'modal_demand') cycle
            note = warning_type(ground_governs)
            symbol = trim(merge('a_Z ', 'S_eZ', row%quantity%name == 'modal_pga'))
            call note%about('quantity', symbol)
            call note%with('modal_g', row%value)
            call note%with('ground_g', sheet%rows(i + 1)%value)
            call notes%add(note, 'the modes of the building give '//symbol//' = '//rounded(row%value)// &
               & ' g at the level of the wall, less than '//rounded(sheet%rows(i + 1)%value)//' g of the ground, which '// &
               & 'governs: dondolo takes at least a_g S for a_Z and S_e(T) for S_eZ at every T, by analogy with [C7.2.11]; '// &
               & '[C7.2.5] says so for T > T_1 only')
            return
         end associate
      end do
   end subroutine add_ground_note

   !> Notes on limit states whose return period the grid of hazard does not have
   subroutine add_hazard_notes(sheet, notes)
      type(sheet_type), intent(in) :: sheet
      type(warnings_type), intent(inout) :: notes

      type(warning_type) :: note
      real(wp) :: asked, held
      integer :: i

      do i = 1, size(state_names)
         asked = sheet%value('site', state_names(i), 'return_period_asked')
         if (.not. asked > 0.0_wp) cycle
         held = sheet%value('site', state_names(i), 'return_period_demand')
         note = warning_type(return_period_held)
         call note%about('limit_state', state_names(i))
         call note%with('return_period_year', asked)
         call note%with('held_year', held)
         call notes%add(note, 'the return period of '//state_names(i)//', '//rounded(asked)//' years, is beyond those of the '// &
            & 'grid of hazard: the hazard is that of '//rounded(held)//' years, which is '// &
            & trim(merge('less   ', 'greater', held < asked)))
      end do
   end subroutine add_hazard_notes

   !> Notes on the hinge of a strip, and on the floor above it
   subroutine add_strip_notes(sheet, notes)
      type(sheet_type), intent(in) :: sheet
      type(warnings_type), intent(inout) :: notes

      type(warning_type) :: note
      real(wp) :: hinge, least, given, zeta, top

      hinge = sheet%value('mechanism', '', 'weakest_hinge')
      least = sheet%value('mechanism', '', 'weakest_alpha_0')
      given = sheet%value('assigned', '', 'hinge')
      if (given > 0.0_wp) then
         note = warning_type(hinge_not_weakest)
         call note%with('hinge', given)
         call note%with('alpha_0', sheet%value('assigned', '', 'alpha_0'))
         call note%with('weakest_alpha_0', least)
         call note%with('weakest_hinge', hinge)
         call notes%add(note, 'the check is at the weakest hinge of the strip, hinge = '//rounded(hinge)//', where alpha_0 is '// &
            & rounded(least)//'; at the hinge that is given, '//rounded(given)//', it is '// &
            & rounded(sheet%value('assigned', '', 'alpha_0'))//', and time histories and P(collapse) belong to that hinge')
      end if
      if (abs(hinge - sheet%value('mechanism', '', 'highest_hinge')) <= same) then
         note = warning_type(hinge_above_usual)
         call note%with('weakest_alpha_0', least)
         call note%with('weakest_hinge', hinge)
         call notes%add(note, 'alpha_0 decreases with the height of the hinge of the strip, down to '//rounded(least)// &
            & ' at hinge = '//rounded(hinge)//', the end of hinge_range; with so high a hinge the strip rather overturns as a '// &
            & 'wall from the floor below')
      else if (abs(hinge - sheet%value('mechanism', '', 'lowest_hinge')) <= same) then
         note = warning_type(hinge_below_usual)
         call note%with('weakest_alpha_0', least)
         call note%with('weakest_hinge', hinge)
         call notes%add(note, 'alpha_0 increases with the height of the hinge of the strip, from '//rounded(least)// &
            & ' at hinge = '//rounded(hinge)//', the beginning of hinge_range; a lower hinge would be weaker')
      end if
      zeta = sheet%value('nonlinear', 'SLV', 'ratio')
      least = sheet%value('nonlinear', 'SLV', 'least_zeta')
      if (least > 0.0_wp .and. zeta > close*least) then
         note = warning_type(least_elsewhere)
         call note%with('zeta_e', zeta)
         call note%with('least_zeta', least)
         call note%with('least_zeta_hinge', sheet%value('nonlinear', 'SLV', 'least_zeta_hinge'))
         call notes%add(note, 'zeta_E is not least at the weakest hinge of the strip, where it is '//rounded(zeta)// &
            & ': at hinge = '//rounded(sheet%value('nonlinear', 'SLV', 'least_zeta_hinge'))//' it is '//rounded(least)// &
            & ', where the mechanism needs a greater acceleration to start')
      end if
      top = sheet%value('mechanism', '', 'floor_top')
      if (.not. sheet%value('mechanism', '', 'friction_needed', 'top hinge') >= 0.0_wp) then
         note = warning_type(top_without_load)
         call note%with('floor_top_n_m', top)
         call notes%add(note, 'no load presses on the top of the strip: the floor must hold it there by fixings, for '// &
            & rounded(top)//' N per metre when the mechanism starts')
      end if
   end subroutine add_strip_notes

   !> Notes on ties whose anchors are not checked, give way before the bar yields, or have a plate that is too thin
   subroutine add_tie_notes(sheet, notes)
      type(sheet_type), intent(in) :: sheet
      type(warnings_type), intent(inout) :: notes

      type(warning_type) :: note
      character(len=len(sheet%rows%item)) :: item
      character(len=:), allocatable :: per
      logical :: is_whole
      integer :: i

      is_whole = any(sheet%rows%quantity%name == 'tie_force_per_m' .and. sheet%rows%quantity%unit == 'N')
      per = trim(merge('  ', '/m', is_whole))
      do i = 1, size(sheet%rows)
         associate (row => sheet%rows(i))
            item = row%item
            if (row%method /= 'tie' .or. row%value > 0.0_wp) cycle
            select case (row%quantity%name)
            case ('hierarchy')
               call begin(anchor_before_bar, [character(len=18) :: 'anchor_force_per_m', 'bar_force_per_m'])
               call notes%add(note, 'hierarchy of strengths not respected: the anchor of '//trim(item)//' gives way at '// &
                  & trim(of_tie('anchor_force_per_m'))//' N'//per//', before its bar yields at '// &
                  & trim(of_tie('bar_force_per_m'))//' N'//per//', and at once; a linear check of SLV with q > 1 is not applicable')
            case ('plate_verified')
               call begin(plate_too_thin, [character(len=18) :: 'plate_thickness', 'plate_needed'])
               call notes%add(note, 'the plate of '//trim(item)//' is too thin: '//trim(of_tie('plate_thickness'))// &
                  & ' m, must be '//trim(of_tie('plate_needed'))//' m; the check assumes a uniform pressure on the masonry')
            case ('anchor_checked')
               if (sheet%value('tie', '', 'anchor_force', item) > 0.0_wp) then
                  call begin(anchor_factor_differs, [character(len=18) :: 'anchor_knowledge'])
                  call notes%add(note, 'the anchor of '//trim(item)//' is not checked with the confidence factor of the '// &
                     & 'check: its masonry has masonry_knowledge_factor = '//trim(of_tie('anchor_knowledge')))
               else
                  call begin(anchor_not_checked, [character(len=18) ::])
                  call notes%add(note, 'the anchor of '//trim(item)//' is not checked: neither its plate nor a force at '// &
                     & 'which it gives way is given')
               end if
            end select
         end associate
      end do

   contains

      !> Begin a note on the tie, with numbers of it
      subroutine begin(code, names)
         character(len=*), intent(in) :: code
         character(len=*), intent(in) :: names(:)

         integer :: k

         note = warning_type(code)
         call note%about('item', trim(item))
         if (is_whole .and. code == anchor_before_bar) call note%about('of', 'whole')
         do k = 1, size(names)
            call note%with(trim(names(k)), sheet%value('tie', '', trim(names(k)), item))
         end do
      end subroutine begin

      !> A number of the tie
      function of_tie(name)
         !> Name of the quantity
         character(len=*), intent(in) :: name
         !> Its text
         character(len=24) :: of_tie

         of_tie = rounded(sheet%value('tie', '', name, item))
      end function of_tie

   end subroutine add_tie_notes

end module dondolo_check_notes
