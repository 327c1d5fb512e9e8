!> Quantiles of Student's t distribution.
module dondolo_student
   use dondolo_kinds, only : wp
   implicit none
   private

   public :: student_cdf, student_quantile

contains

   !> Distribution function of Student's t with a whole number of degrees of freedom: finite sums, 26.7.3 and 26.7.4 of
   !> Abramowitz and Stegun (1964)
   pure real(wp) function student_cdf(t, degrees) result(p)
      real(wp), intent(in) :: t
      !> Degrees of freedom, positive
      integer, intent(in) :: degrees

      real(wp), parameter :: pi = acos(-1.0_wp)
      real(wp) :: angle, cosine2, term, total
      integer :: i

      angle = atan2(t, sqrt(real(degrees, wp)))
      cosine2 = cos(angle)**2
      term = 1.0_wp
      if (modulo(degrees, 2) == 1) term = cos(angle)
      total = term
      do i = merge(3, 2, modulo(degrees, 2) == 1), degrees - 2, 2
         term = term*cosine2*real(i - 1, wp)/real(i, wp)
         total = total + term
      end do
      if (modulo(degrees, 2) == 0) then
         p = sin(angle)*total
      else if (degrees == 1) then
         p = 2.0_wp*angle/pi
      else
         p = 2.0_wp*(angle + sin(angle)*total)/pi
      end if
      p = 0.5_wp*(1.0_wp + p)
   end function student_cdf

   !> Quantile of Student's t, exact to rounding of the distribution function
   pure real(wp) function student_quantile(p, degrees) result(t)
      !> Probability, at least 0.5 and below 1
      real(wp), intent(in) :: p
      !> Degrees of freedom, positive
      integer, intent(in) :: degrees

      real(wp) :: below, above

      below = 0.0_wp
      above = 1.0_wp
      do while (student_cdf(above, degrees) < p .and. above < 1.0e100_wp)
         above = 2.0_wp*above
      end do
      do
         t = 0.5_wp*(below + above)
         if (t <= below .or. t >= above) exit
         if (student_cdf(t, degrees) < p) then
            below = t
         else
            above = t
         end if
      end do
   end function student_quantile

end module dondolo_student
