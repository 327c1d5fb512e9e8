!> Quantiles of Student's t distribution.
module dondolo_base_student
   use dondolo_base_bracket, only : bracket_type
   use dondolo_base_invariant, only : assert, checked
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: student_cdf, student_quantile

contains

   !> Distribution function of Student's t, by the incomplete beta function: P(|t| > x) = I_{n/(n + x^2)}(n/2, 1/2),
   !> 26.7.1 of Abramowitz and Stegun (1964)
   pure real(wp) function student_cdf(t, degrees) result(p)
      real(wp), intent(in) :: t
      !> Degrees of freedom, positive; they need not be a whole number
      real(wp), intent(in) :: degrees

      real(wp) :: tail

      tail = 0.5_wp*incomplete_beta(degrees/(degrees + t**2), t**2/(degrees + t**2), 0.5_wp*degrees, 0.5_wp)
      p = merge(tail, 1.0_wp - tail, t < 0.0_wp)
   end function student_cdf

   !> Quantile of Student's t, exact to rounding of the distribution function
   pure real(wp) function student_quantile(p, degrees) result(t)
      !> Probability, at least 0.5 and below 1
      real(wp), intent(in) :: p
      !> Degrees of freedom, positive
      real(wp), intent(in) :: degrees

      type(bracket_type) :: bracket

      if (checked) call assert(p >= 0.5_wp .and. p < 1.0_wp .and. degrees > 0.0_wp, 'a quantile of t is in its upper half')
      bracket%last = 1.0_wp
      do while (student_cdf(bracket%last, degrees) < p .and. bracket%last < 1.0e100_wp)
         bracket%last = 2.0_wp*bracket%last
      end do
      do while (bracket%is_divisible())
         call bracket%halve(student_cdf(bracket%middle(), degrees) < p)
      end do
      t = bracket%middle()
   end function student_quantile

   !> Regularized incomplete beta function I_x(a, b)
   pure recursive real(wp) function incomplete_beta(x, rest, a, b) result(value)
      !> Argument between 0 and 1, and 1 - x to all digits
      real(wp), intent(in) :: x, rest
      !> Parameters, positive
      real(wp), intent(in) :: a, b

      real(wp) :: front

      value = 0.0_wp
      if (.not. x > 0.0_wp) return
      ! The fraction converges fast below about the mean.
      if (x > (a + 1.0_wp)/(a + b + 2.0_wp)) then
         value = 1.0_wp - incomplete_beta(rest, x, b, a)
         return
      end if
      front = exp(a*log(x) + b*log(rest) + log_gamma(a + b) - log_gamma(a) - log_gamma(b))/a
      value = front*beta_fraction(x, a, b)
   end function incomplete_beta

   !> Continued fraction of the incomplete beta function, 26.5.8 of Abramowitz and Stegun (1964), from the front by
   !> Lentz's method
   pure real(wp) function beta_fraction(x, a, b) result(value)
      real(wp), intent(in) :: x, a, b

      !> Terms at most: about the root of the larger parameter would do
      integer, parameter :: most = 100000
      real(wp), parameter :: least = tiny(1.0_wp)/epsilon(1.0_wp)
      real(wp) :: c, d, term, m
      integer :: k

      value = 1.0_wp
      c = huge(1.0_wp)
      d = 1.0_wp
      do k = 1, most
         m = real(k/2, wp)
         if (modulo(k, 2) == 0) then
            term = m*(b - m)*x/((a + 2.0_wp*m - 1.0_wp)*(a + 2.0_wp*m))
         else
            term = -(a + m)*(a + b + m)*x/((a + 2.0_wp*m)*(a + 2.0_wp*m + 1.0_wp))
         end if
         d = 1.0_wp + term*d
         if (abs(d) < least) d = least
         d = 1.0_wp/d
         c = 1.0_wp + term/c
         if (abs(c) < least) c = least
         value = value*c*d
         if (abs(c*d - 1.0_wp) < epsilon(1.0_wp)) return
      end do
   end function beta_fraction

end module dondolo_base_student
