!> What a reader of the check of a free element should know.
module dondolo_check_free_notes
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : rounded
   use dondolo_base_warning, only : warning_type, warnings_type
   use dondolo_check_sheet, only : sheet_type
   implicit none
   private

   public :: add_free_notes

   !> Codes
   character(len=*), parameter :: modulus_missing = 'modulus_missing', perhaps_free = 'perhaps_free', &
      & free_behaviour = 'free_behaviour', period_between = 'period_between'

contains

   !> Add the notes on a free element
   subroutine add_free_notes(sheet, notes)
      type(sheet_type), intent(in) :: sheet
      type(warnings_type), intent(inout) :: notes

      type(warning_type) :: note
      real(wp) :: behaviour

      if (.not. sheet%value('mechanism', '', 'free_element') >= 0.0_wp) return
      if (.not. sheet%value('mechanism', '', 'free_element') > 0.0_wp) then
         call notes%add(warning_type(perhaps_free), 'the wall begins above the ground or ends above its building, and '// &
            & 'neither ties nor interlocking hold it: if it is a free element, such as a parapet or the upper part of a '// &
            & 'facade, give free or young_modulus (C8.7.1.2.1.3), else free = .false.')
         return
      end if
      if (.not. sheet%value('mechanism', '', 'young_modulus') > 0.0_wp) then
         call notes%add(warning_type(modulus_missing), 'young_modulus is not given: of a free element the code asks for '// &
            & 'S_eZ(T_0) (C8.7.1.2.1.5), so that the linear checks of SLD and SLV are not applicable, and the nonlinear ones '// &
            & 'count displacements alone')
         return
      end if
      behaviour = sheet%value('linear', 'SLV', 'behaviour')
      if (behaviour > 1.0_wp) then
         note = warning_type(free_behaviour)
         call note%with('behaviour', behaviour)
         call notes%add(note, 'the behaviour factor of the linear check of SLV is '//rounded(behaviour)// &
            & '; for parapets Table C7.2.I has q_a = 1')
      end if
      if (sheet%value('mechanism', '', 'longest_t0') > 0.0_wp) then
         note = warning_type(period_between)
         call note%with('shortest_s', sheet%value('mechanism', '', 'shortest_t0'))
         call note%with('longest_s', sheet%value('mechanism', '', 'longest_t0'))
         call notes%add(note, 'the elastic period of the free element lies between '// &
            & rounded(sheet%value('mechanism', '', 'shortest_t0'))//' and '// &
            & rounded(sheet%value('mechanism', '', 'longest_t0'))//' s, by the range of young_modulus or by what [C8.7.1.7] '// &
            & 'does not know (sections that differ, masses, ties, springs); the demand is the greatest between')
      end if
   end subroutine add_free_notes

end module dondolo_check_free_notes
