!> Designs of one wall compared on the same records: for people and tables.
module dondolo_design_rows
   use dondolo_csv_row, only : text_cell
   use dondolo_designs, only : design_type
   use dondolo_kinds, only : wp
   use dondolo_text, only : rounded, to_table
   implicit none
   private

   public :: design_head, make_design_row, make_design_sentence

   !> Names of the columns of the table of designs
   character(len=*), parameter :: design_head = 'design,im,theta,beta,se_ln_theta,status,ratio,ratio_low,ratio_high,p_value,'// &
      & 'steel_kg_m,gain_per_kg,alpha_0_g,static_ratio'

contains

   !> A design as a row
   subroutine make_design_row(design, first, im, is_safe, row)
      type(design_type), intent(in) :: design, first
      !> Intensity measure
      character(len=*), intent(in) :: im
      !> Are texts to be no formulas in a spreadsheet?
      logical, intent(in) :: is_safe
      !> Row
      character(len=:), allocatable, intent(out) :: row

      row = text_cell(design%name, is_safe)//','//im//','
      if (design%curve%has_fit()) then
         row = row//to_table(design%curve%theta)//','//to_table(design%curve%beta)//','
         if (design%curve%has_errors()) row = row//to_table(design%curve%se_ln_theta())
         row = row//','
      else
         row = row//',,,'
      end if
      row = row//trim(design%curve%status)//','
      if (design%is_compared) then
         row = row//to_table(design%ratio)//','//to_table(design%low)//','//to_table(design%high)//','// &
            & to_table(design%p_value)//','
      else
         row = row//',,,,'
      end if
      row = row//to_table(design%steel)//','
      if (design%is_compared .and. design%steel > first%steel) row = row//to_table(design%gain_per_kg(first))
      row = row//','//to_table(design%alpha_0)//','//to_table(design%alpha_0/first%alpha_0)
   end subroutine make_design_row

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

end module dondolo_design_rows
