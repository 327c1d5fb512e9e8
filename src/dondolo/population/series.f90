!> Mechanisms of a wall in series, independent of each other given the intensity: the wall collapses if any of them does,
!> P = 1 - prod_m (1 - p_occ,m P_m), with p_occ,m the probability that mechanism m can occur in the wall at all
!> (docs/theory.md, section 6).
module dondolo_population_series
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_fragility, only : fit_fragility, fragility_type
   implicit none
   private

   public :: in_series, occurrence_of, series_slopes, fit_share

contains

   !> 1 - prod_m (1 - p_occ,m P_m)
   pure function in_series(p_occ, p) result(whole)
      !> Probability that each mechanism can occur
      real(wp), intent(in) :: p_occ(:)
      !> Probabilities of collapse (levels, mechanisms)
      real(wp), intent(in) :: p(:, :)
      !> Those of the wall at each level
      real(wp) :: whole(size(p, 1))

      integer :: m

      ! One mechanism that always can occur keeps its probabilities to the last digit.
      whole = p_occ(1)*p(:, 1)
      do m = 2, size(p_occ)
         whole = whole + (1.0_wp - whole)*p_occ(m)*p(:, m)
      end do
      whole = min(whole, 1.0_wp)
   end function in_series

   !> Probability that any mechanism can occur: what the probability of collapse tends to
   pure real(wp) function occurrence_of(p_occ)
      !> Probability that each mechanism can occur
      real(wp), intent(in) :: p_occ(:)

      real(wp) :: certain(1, size(p_occ)), whole(1)

      certain = 1.0_wp
      whole = in_series(p_occ, certain)
      occurrence_of = whole(1)
   end function occurrence_of

   !> Derivative of 1 - prod_m (1 - p_occ,m P_m) with respect to each P_m
   pure function series_slopes(p_occ, p) result(slopes)
      !> Probability that each mechanism can occur
      real(wp), intent(in) :: p_occ(:)
      !> Probabilities of collapse (levels, mechanisms)
      real(wp), intent(in) :: p(:, :)
      !> Derivatives (levels, mechanisms)
      real(wp) :: slopes(size(p, 1), size(p, 2))

      integer :: l, m

      do m = 1, size(p_occ)
         slopes(:, m) = p_occ(m)
         do l = 1, size(p_occ)
            if (l /= m) slopes(:, m) = slopes(:, m)*(1.0_wp - p_occ(l)*p(:, l))
         end do
      end do
   end function series_slopes

   !> Fit the lognormal of what can collapse
   subroutine fit_share(fit, levels, fraction, saturation, histories, error)
      type(fragility_type), intent(out) :: fit
      !> Levels of intensity, fractions of collapse, and histories that count
      real(wp), intent(in) :: levels(:), fraction(:), histories(:)
      !> What the fractions tend to: probability that any mechanism can occur
      real(wp), intent(in) :: saturation
      !> Fractions that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: share(size(levels))

      ! Divided first: where all that can collapse does, the share is 1 to the last bit and no survivor is made up.
      share = fraction
      if (saturation > 0.0_wp) share = min(share/saturation, 1.0_wp)
      call fit_fragility(fit, levels, histories*share, histories, error)
   end subroutine fit_share

end module dondolo_population_series
