!> What a reader of a check should know of the curve that it takes, and of the floor that the wall stands on.
module dondolo_check_curve_notes
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : rounded, to_text
   use dondolo_base_warning, only : warning_type, warnings_type
   use dondolo_check_sheet, only : sheet_type
   implicit none
   private

   public :: add_building_note, add_index_note, add_level_note

   !> Codes
   character(len=*), parameter :: ties_counted = 'ties_counted', ties_left_out = 'ties_left_out', &
      & floor_not_given = 'floor_not_given', building_softened = 'building_softened'

contains

   !> Note on a wall whose base is on a building that is not given, with the line to add
   subroutine add_level_note(sheet, notes)
      type(sheet_type), intent(in) :: sheet
      type(warnings_type), intent(inout) :: notes

      type(warning_type) :: note
      !> Usual height of a storey, for the number of them in the proposal [m]
      real(wp), parameter :: storey = 4.0_wp
      real(wp) :: level, height, period
      integer :: storeys

      level = sheet%value('mechanism', '', 'level')
      height = sheet%value('mechanism', '', 'wall_top')
      period = sheet%value('mechanism', '', 'proposed_period')
      storeys = max(1, nint(height/storey))
      note = warning_type(floor_not_given)
      call note%with('level_m', level)
      call note%with('building_height_m', height)
      call note%with('building_period_s', period)
      call note%with('storeys', real(storeys, wp))
      call notes%add(note, 'the base of the wall is '//rounded(level)//' m above the ground, and the building that it stands '// &
         & 'on is not given: there is no spectrum at this level (C8.7.1.2.1.5, C8.7.1.2.1.8), and the check gives alpha_0, '// &
         & 'a_0* and d_0* but no ratio; add &building period = '//rounded(1.0e-3_wp*nint(1.0e3_wp*period))// &
         & ', building_height = '//rounded(height)//', storeys = '//to_text(storeys)//', level = '//rounded(level)// &
         & ' with the values of the building (here H is the top of the wall and the period 0.05 H^0.75, C7.3.3.2)')
   end subroutine add_level_note

   !> Note on period and damping of the building that govern the ultimate state
   subroutine add_building_note(sheet, notes)
      type(sheet_type), intent(in) :: sheet
      type(warnings_type), intent(inout) :: notes

      type(warning_type) :: note
      real(wp) :: period, damping, index, given

      associate (state => sheet%ultimate())
         given = sheet%value('nonlinear', state, 'building_zeta', 'T_1')
         if (.not. given > 0.0_wp) return
         period = sheet%value('nonlinear', state, 'building_period')
         damping = sheet%value('nonlinear', state, 'building_damping')
         index = sheet%value('nonlinear', state, 'zeta_e')
         note = warning_type(building_softened)
         call note%about('limit_state', state)
         call note%with('building_period_s', period)
         call note%with('building_damping', damping)
         call note%with('zeta_e', index)
         call note%with('zeta_given', given)
         call notes%add(note, 'at '//state//' the period of the building is taken as '//rounded(period)//' s and its damping '// &
            & 'ratio as '//rounded(damping)//', for which zeta_E is least between T_1 and 2 T_1 (C8.7.1.2.1.4): '// &
            & rounded(index)//', with the building as given '//rounded(given)//'; building_period and building_damping give '// &
            & 'the values of a pushover analysis instead')
      end associate
   end subroutine add_building_note

   !> Note on the two safety indices of a wall with ties: with all, and the greatest without some
   subroutine add_index_note(sheet, notes)
      type(sheet_type), intent(in) :: sheet
      type(warnings_type), intent(inout) :: notes

      type(warning_type) :: note
      character(len=len(sheet%rows%item)) :: item
      character(len=:), allocatable :: reason
      real(wp) :: tied, less, fewer, all
      integer :: at

      tied = sheet%value('nonlinear', 'SLV', 'tied_zeta')
      less = sheet%value('nonlinear', 'SLV', 'less_zeta')
      at = findloc(sheet%rows%quantity%name == 'less_zeta' .and. sheet%rows%state == 'SLV', .true., dim=1)
      item = sheet%rows(at)%item
      fewer = sheet%value('nonlinear', 'SLV', 'less_sld')
      all = sheet%value('linear', 'SLD', 'ratio')
      note = warning_type(trim(merge(ties_left_out, ties_counted//' ', less > tied)))
      call note%about('item', trim(item))
      call note%with('tied_zeta', tied)
      call note%with('less_zeta', less)
      call note%with('less_sld', fewer)
      call note%with('tied_sld', all)
      reason = ''
      if (less > tied) reason = ': with '//trim(item)//' that of SLV does not increase, and the ratio of activation (SLD) goes '// &
         & 'from '//rounded(fewer)//' to '//rounded(all)
      call notes%add(note, 'zeta_E of SLV with the ties up to the rotations at which they break is '//rounded(tied)// &
         & ' (C8.7.1.2.1.6, second dash), without counting '//trim(item)//' it is '//rounded(less)//'; '// &
         & rounded(max(tied, less))//' is taken'//reason)
   end subroutine add_index_note

end module dondolo_check_curve_notes
