!> Designs of one wall compared on the same records: for people and tables.
module dondolo_case_design_rows
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : rounded
   use dondolo_case_table, only : table_type
   use dondolo_check_safety, only : safety_type, shown_years
   use dondolo_fragility, only : fit_status_names
   use dondolo_population_designs, only : design_type
   implicit none
   private

   public :: put_design, make_design_sentence, make_safety_sentence

contains

   !> A design as a row
   subroutine put_design(table, design, first, im)
      class(table_type), intent(inout) :: table
      type(design_type), intent(in) :: design, first
      !> Intensity measure
      character(len=*), intent(in) :: im

      real(wp) :: gain
      logical :: has_fit, has_gain

      has_fit = design%curve%has_fit()
      has_gain = design%is_compared .and. design%steel > first%steel
      gain = 0.0_wp
      if (has_gain) gain = design%gain_per_kg(first)
      call table%put('design', design%name)
      call table%put('im', im)
      call table%put('theta', design%curve%theta, has_fit)
      call table%put('beta', design%curve%beta, has_fit)
      call table%put('se_ln_theta', design%curve%se_ln_theta(), has_fit .and. design%curve%has_errors())
      call table%put('status', trim(fit_status_names(design%curve%status)))
      call table%put('ratio', design%ratio, design%is_compared)
      call table%put('ratio_low', design%low, design%is_compared)
      call table%put('ratio_high', design%high, design%is_compared)
      call table%put('p_value', design%p_value, design%is_compared)
      call table%put('steel_kg_m', design%steel)
      call table%put('gain_per_kg', gain, has_gain)
      call table%put('alpha_0_g', design%alpha_0)
      call table%put('static_ratio', design%alpha_0/first%alpha_0)
      call put_safety(table, design%safety, first%safety)
   end subroutine put_design

   !> The check of a design by a building code, and its differences to that of the first
   subroutine put_safety(table, safety, first)
      class(table_type), intent(inout) :: table
      type(safety_type), intent(in) :: safety, first

      logical :: are_both, is_period

      are_both = safety%is_known .and. first%is_known
      is_period = are_both .and. min(safety%years, first%years) > 0.0_wp
      call table%put('alpha_0', safety%multiplier, safety%is_known)
      call table%put('a_0_m_s2', safety%activation, safety%is_known)
      call table%put('zeta_e_linear', safety%linear, safety%is_known .and. safety%linear >= 0.0_wp)
      call table%put('zeta_e', safety%nonlinear, safety%is_known)
      call table%put('return_period_capacity', safety%years, safety%is_known .and. safety%years > 0.0_wp)
      call table%put('return_period_bound', trim(safety%bound))
      call table%put('alpha_0_change', safety%multiplier - first%multiplier, are_both)
      call table%put('a_0_change_m_s2', safety%activation - first%activation, are_both)
      call table%put('zeta_e_linear_change', safety%linear - first%linear, are_both .and. &
         & min(safety%linear, first%linear) >= 0.0_wp)
      call table%put('zeta_e_change', safety%nonlinear - first%nonlinear, are_both)
      ! Bounds have no difference.
      call table%put('return_period_change', safety%years - first%years, is_period .and. safety%bound//first%bound == '')
   end subroutine put_safety

   !> A design beside the first, for people
   subroutine make_design_sentence(design, first, line)
      type(design_type), intent(in) :: design, first
      !> Line
      character(len=:), allocatable, intent(out) :: line

      real(wp) :: percent

      line = design%name//': '
      if (design%is_compared) then
         line = line//'median x '//rounded(design%ratio)//' ('//rounded(design%low)//' to '//rounded(design%high)//')'
      else
         line = line//'no ratio of medians'
      end if
      line = line//', static acceleration x '//rounded(design%alpha_0/first%alpha_0)
      if (design%steel > 0.0_wp) line = line//', steel '//rounded(design%steel)//' kg/m'
      percent = 100.0_wp*design%gain_per_kg(first)
      if (design%is_compared .and. design%steel > first%steel) line = line//', gain '//rounded(percent)//' % per kg/m'
   end subroutine make_design_sentence

   !> The check of a design by a building code, with its differences to that of the first, for people
   subroutine make_safety_sentence(design, first, line)
      !> Designs, the first with a check or without
      type(design_type), intent(in) :: design, first
      !> Line
      character(len=:), allocatable, intent(out) :: line

      associate (safety => design%safety, other => first%safety)
         if (.not. safety%is_known) then
            line = design%name//': not checked; the table of checks gives the reason'
            return
         end if
         line = design%name//': alpha_0 '//rounded(safety%multiplier)//trim(change(safety%multiplier, other%multiplier))// &
            & ', a_0* '//rounded(safety%activation)//trim(change(safety%activation, other%activation))//' m/s2, zeta_E '// &
            & rounded(safety%nonlinear)//trim(change(safety%nonlinear, other%nonlinear))//', linear '
         if (safety%linear < 0.0_wp) then
            line = line//'not applicable'
         else
            line = line//rounded(safety%linear)
            if (other%linear >= 0.0_wp) line = line//trim(change(safety%linear, other%linear))
         end if
         if (safety%years > 0.0_wp) line = line//', T_R,C '//trim(shown_years(safety))
      end associate

   contains

      !> Difference to the first in brackets; empty for the first itself
      function change(value, of_first) result(text)
         !> A number of the design and of the first
         real(wp), intent(in) :: value, of_first
         !> Filled up with blanks
         character(len=32) :: text

         text = ''
         if (design%name == first%name .or. .not. first%safety%is_known) return
         text = rounded(value - of_first)
         if (value >= of_first) text = '+'//trim(text)
         text = ' ('//trim(text)//')'
      end function change

   end subroutine make_safety_sentence

end module dondolo_case_design_rows
