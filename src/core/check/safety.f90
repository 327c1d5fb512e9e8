!> Result of a check, by which walls are compared: multiplier, acceleration, safety index and return period.
module dondolo_check_safety
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : rounded
   use dondolo_check_sheet, only : sheet_type
   implicit none
   private

   public :: safety_type, new_safety, shown_years

   !> Result of a check
   type :: safety_type
      !> Is there a check?
      logical :: is_known = .false.
      !> Multiplier that starts the mechanism, and its spectral acceleration [m/s2]
      real(wp) :: multiplier = 0.0_wp, activation = 0.0_wp
      !> Safety index of SLV by the linear check, negative where that is not applicable, and of the ultimate state by the nonlinear
      real(wp) :: linear = -1.0_wp, nonlinear = -1.0_wp
      !> Return period of the capacity by the latter [years]; negative: not known
      real(wp) :: years = -1.0_wp
      !> '<' or '>' where it is only a bound
      character(len=1) :: bound = ''
   end type safety_type

contains

   !> Take it from a sheet
   pure function new_safety(sheet) result(safety)
      type(sheet_type), intent(in) :: sheet
      !> Its result
      type(safety_type) :: safety

      safety%is_known = sheet%has_ratios()
      safety%multiplier = sheet%value('mechanism', '', 'alpha_0')
      safety%activation = sheet%value('mechanism', '', 'a_0')
      safety%linear = sheet%value('linear', 'SLV', 'zeta_e')
      safety%nonlinear = sheet%value('nonlinear', sheet%ultimate(), 'zeta_e')
      safety%years = sheet%value('nonlinear', sheet%ultimate(), 'return_period_capacity')
      safety%bound = sheet%bound('nonlinear', sheet%ultimate(), 'return_period_capacity')
   end function new_safety

   !> A return period of the capacity with its bound, for people
   pure function shown_years(safety) result(text)
      type(safety_type), intent(in) :: safety
      !> Filled up with blanks
      character(len=32) :: text

      text = rounded(safety%years)//' years'
      if (safety%bound /= '') text = safety%bound//' '//trim(text)
   end function shown_years

end module dondolo_check_safety
