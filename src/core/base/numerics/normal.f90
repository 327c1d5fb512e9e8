!> Standard normal distribution.
module dondolo_base_normal
   use dondolo_base_bracket, only : bracket_type
   use dondolo_base_invariant, only : are_probabilities, assert, checked
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: normal_cdf, normal_quantile

contains

   !> Distribution function of the standard normal distribution
   elemental real(wp) function normal_cdf(x)
      real(wp), intent(in) :: x

      normal_cdf = 0.5_wp*erfc(-x/sqrt(2.0_wp))
   end function normal_cdf

   !> Quantile of the standard normal distribution, by halving: to rounding of the distribution function
   pure real(wp) function normal_quantile(p) result(x)
      !> Probability, between 0 and 1
      real(wp), intent(in) :: p

      !> Beyond which there is nothing in double precision
      real(wp), parameter :: furthest = 40.0_wp
      type(bracket_type) :: bracket
      real(wp) :: tail

      if (checked) call assert(are_probabilities([p]), 'a quantile is that of a probability')
      ! The smaller tail keeps its digits
      tail = min(p, 1.0_wp - p)
      bracket%first = -furthest
      do while (bracket%is_divisible())
         call bracket%halve(normal_cdf(bracket%middle()) < tail)
      end do
      x = bracket%middle()
      if (p > 0.5_wp) x = -x
   end function normal_quantile

end module dondolo_base_normal
