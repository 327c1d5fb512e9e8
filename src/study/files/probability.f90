!> Probabilities as people read them.
module dondolo_files_probability
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : rounded
   implicit none
   private

   public :: probability_text

contains

   !> A probability with four decimals; of tails of a fitted curve no more is known than that they are small
   pure function probability_text(value) result(text)
      !> Probability
      real(wp), intent(in) :: value
      !> Text, filled up with blanks
      character(len=24) :: text

      if (value > 0.0_wp .and. value < 5.0e-5_wp) then
         text = '< 0.0001'
      else if (value < 1.0_wp .and. value >= 0.99995_wp) then
         text = '> 0.9999'
      else if (value > 0.0_wp .and. value < 1.0_wp) then
         write (text, '(f6.4)') value
      else
         text = rounded(value)
      end if
   end function probability_text

end module dondolo_files_probability
