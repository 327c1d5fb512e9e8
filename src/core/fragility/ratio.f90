!> Ratio of a parameter of two curves: its interval, and how likely a ratio as far from 1 is if they are equal.
module dondolo_fragility_ratio
   use dondolo_base_kinds, only : wp
   use dondolo_base_normal, only : normal_cdf, normal_quantile
   use dondolo_base_student, only : student_cdf, student_quantile
   implicit none
   private

   public :: compare_parameters

   !> Degrees of freedom beyond which Student's t is the normal distribution
   real(wp), parameter :: most_degrees = 1.0e5_wp

contains

   !> Compare a parameter of two curves
   pure subroutine compare_parameters(ratio, changes, degrees, confidence, interval, p_value)
      !> Parameter of the one / that of the other
      real(wp), intent(in) :: ratio
      !> Change of the logarithm of this ratio if each cluster is left out, to first order
      real(wp), intent(in) :: changes(:)
      !> Degrees of freedom of Student's t
      real(wp), intent(in) :: degrees
      !> Of the interval
      real(wp), intent(in) :: confidence
      !> Its ends
      real(wp), intent(out) :: interval(2)
      !> Probability of a ratio as far from 1 if the parameters were equal
      real(wp), intent(out) :: p_value

      real(wp) :: difference, error, quantile

      difference = log(ratio)
      error = norm2(changes)
      ! Curves of the same histories do not differ at all.
      p_value = merge(1.0_wp, 0.0_wp, .not. abs(difference) > 0.0_wp)
      if (degrees > most_degrees) then
         quantile = normal_quantile(0.5_wp*(1.0_wp + confidence))
         if (error > 0.0_wp) p_value = 2.0_wp*normal_cdf(-abs(difference)/error)
      else
         quantile = student_quantile(0.5_wp*(1.0_wp + confidence), degrees)
         if (error > 0.0_wp) p_value = 2.0_wp*student_cdf(-abs(difference)/error, degrees)
      end if
      interval = exp(difference + quantile*error*[-1.0_wp, 1.0_wp])
   end subroutine compare_parameters

end module dondolo_fragility_ratio
