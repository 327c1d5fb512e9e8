!> What a reader of a check by a building code should know of it.
module dondolo_check_notes
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : rounded
   use dondolo_base_warning, only : warning_type, warnings_type
   use dondolo_check_sheet, only : sheet_type
   implicit none
   private

   public :: make_check_notes

   !> Codes
   character(len=*), parameter :: hinge_above_usual = 'hinge_above_usual', hinge_not_weakest = 'hinge_not_weakest', &
      & diaphragm_not_in_demand = 'diaphragm_not_in_demand', anchor_before_bar = 'anchor_before_bar', &
      & plate_too_thin = 'plate_too_thin', anchor_factor_differs = 'anchor_factor_differs', &
      & anchor_not_checked = 'anchor_not_checked', period_beyond_spectrum = 'period_beyond_spectrum'

   !> How much greater than at the weakest hinge alpha_0 may be, and the highest hinge of a strip that bends rather than overturns
   !> from the floor below
   real(wp), parameter :: close = 1.02_wp, highest_hinge = 0.9_wp
   !> Period from which displacements of the spectrum fall on some soil [s]: NTC 2018, 3.2.3.2.3
   real(wp), parameter :: long_period = 4.5_wp

contains

   !> Make the notes
   subroutine make_check_notes(sheet, notes)
      type(sheet_type), intent(in) :: sheet
      type(warnings_type), intent(out) :: notes

      type(warning_type) :: note
      real(wp) :: alpha, hinge, least, period

      alpha = sheet%value('mechanism', '', 'alpha_0')
      hinge = sheet%value('mechanism', '', 'weakest_hinge')
      least = sheet%value('mechanism', '', 'weakest_alpha_0')
      if (hinge > 0.0_wp .and. alpha > close*least) then
         note = warning_type(hinge_not_weakest)
         if (hinge > highest_hinge) note = warning_type(hinge_above_usual)
         call note%with('alpha_0', alpha)
         call note%with('weakest_alpha_0', least)
         call note%with('weakest_hinge', hinge)
         if (hinge > highest_hinge) then
            call notes%add(note, 'alpha_0 decreases with the height of the hinge of the strip, down to '//rounded(least)// &
               & ' at hinge = '//rounded(hinge)//'; with so high a hinge the strip rather overturns as a wall from the floor '// &
               & 'below')
         else
            call notes%add(note, 'the check is not at the weakest hinge of the strip: alpha_0 is least, '//rounded(least)// &
               & ', at hinge = '//rounded(hinge))
         end if
      end if
      if (sheet%value('mechanism', '', 'diaphragm_period') > 0.0_wp) call notes%add(warning_type(diaphragm_not_in_demand), &
         & 'the flexible diaphragm at the top moves the strip in its histories, but is not in the spectrum of the code: the '// &
         & 'demand of the kinematic check may be too small')
      call add_tie_notes(sheet, notes)
      period = max(sheet%value('nonlinear', 'SLV', 'period'), sheet%value('nonlinear', 'SLC', 'period'))
      if (period > long_period) then
         note = warning_type(period_beyond_spectrum)
         call note%with('period_s', period)
         call note%with('limit_s', long_period)
         call notes%add(note, 'the equivalent period reaches '//rounded(period)//' s; beyond T_E, '//rounded(long_period)// &
            & ' s or more by the soil, the displacements of NTC 2018, 3.2.3.2.3 fall, and the demand of the check does not')
      end if
   end subroutine make_check_notes

   !> Notes on ties whose anchors are not checked, give way before the bar yields, or have a plate that is too thin
   subroutine add_tie_notes(sheet, notes)
      type(sheet_type), intent(in) :: sheet
      type(warnings_type), intent(inout) :: notes

      type(warning_type) :: note
      character(len=len(sheet%rows%item)) :: item
      integer :: i

      do i = 1, size(sheet%rows)
         associate (row => sheet%rows(i))
            item = row%item
            if (row%method /= 'tie' .or. row%value > 0.0_wp) cycle
            select case (row%quantity%name)
            case ('hierarchy')
               call begin(anchor_before_bar, [character(len=18) :: 'anchor_force_per_m', 'bar_force_per_m'])
               call notes%add(note, 'hierarchy of strengths not respected: the anchor of '//trim(item)//' gives way at '// &
                  & trim(of_tie('anchor_force_per_m'))//' N/m, before its bar yields at '//trim(of_tie('bar_force_per_m'))// &
                  & ' N/m, and at once; a linear check of SLV with q > 1 is not applicable')
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
