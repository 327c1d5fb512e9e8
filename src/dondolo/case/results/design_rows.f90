!> Designs of one wall compared on the same records: for people and tables.
module dondolo_case_design_rows
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : rounded
   use dondolo_case_table, only : table_type
   use dondolo_fragility, only : fit_status_names
   use dondolo_population_designs, only : design_type
   implicit none
   private

   public :: put_design, make_design_sentence

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
   end subroutine put_design

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
      if (.not. design%steel > 0.0_wp) return
      line = line//', steel '//rounded(design%steel)//' kg/m'
      percent = 100.0_wp*design%gain_per_kg(first)
      if (design%is_compared .and. design%steel > first%steel) line = line//', gain '//rounded(percent)//' % per kg/m'
   end subroutine make_design_sentence

end module dondolo_case_design_rows
