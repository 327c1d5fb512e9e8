!> Which mechanisms of a wall occur, and how likely the wall collapses by them.
!>
!> Independent: each mechanism m can occur with its probability p_m, whatever the others do, and the wall collapses if any does
!> that can: P = 1 - prod_m (1 - p_m P_m). Exclusive: one of several alternatives a occurs, with the probability p_a, and the
!> wall collapses if any of the mechanisms of this alternative does: P = sum_a p_a (1 - prod_m (1 - P_m)). Given the intensity,
!> mechanisms that can occur together are independent of each other (docs/theory.md, section 6).
!>
!> `alternative` is the number of the alternative of each mechanism of a wall, from 1 on and one after the other; 0: the
!> mechanisms are independent.
module dondolo_population_occurrence
   use dondolo_base_error, only : error_type
   use dondolo_base_invariant, only : are_probabilities, assert, checked
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : choices_length
   use dondolo_fragility, only : fit_fragility, fragility_type
   implicit none
   private

   public :: wall_probability, occurrence_of, wall_slopes, fit_share
   public :: occurrence_names, independent, exclusive, sum_tolerance

   !> How the mechanisms of a wall occur
   character(len=choices_length), parameter :: occurrence_names(2) = [character(len=choices_length) :: 'independent', 'exclusive']
   !> Their places among the names
   integer, parameter :: independent = 1, exclusive = 2

   !> By how much a sum of probabilities may miss 1, for those that were given with a few digits
   real(wp), parameter :: sum_tolerance = 1.0e-6_wp

contains

   !> Probability that a wall collapses by any of its mechanisms
   pure function wall_probability(p_occ, alternative, p) result(whole)
      !> Probability that each mechanism can occur
      real(wp), intent(in) :: p_occ(:)
      !> Its alternative
      integer, intent(in) :: alternative(:)
      !> Probabilities of collapse if it can occur (levels, mechanisms)
      real(wp), intent(in) :: p(:, :)
      !> Those of the wall at each level
      real(wp) :: whole(size(p, 1))

      real(wp) :: any_of_them(size(p, 1))
      integer :: m, last

      if (checked) call assert(are_probabilities(p_occ) .and. are_probabilities(pack(p, .true.)), 'probabilities lie in [0, 1]')
      if (alternative(1) == 0) then
         ! One mechanism that always can occur keeps its probabilities to the last digit.
         whole = p_occ(1)*p(:, 1)
         do m = 2, size(p_occ)
            whole = whole + (1.0_wp - whole)*p_occ(m)*p(:, m)
         end do
      else
         whole = 0.0_wp
         last = 0
         do m = 1, size(p_occ)
            if (alternative(m) /= last) any_of_them = 0.0_wp
            last = alternative(m)
            any_of_them = any_of_them + (1.0_wp - any_of_them)*p(:, m)
            ! The last mechanism of an alternative
            if (m < size(p_occ)) then
               if (alternative(m + 1) == last) cycle
            end if
            whole = whole + p_occ(m)*any_of_them
         end do
      end if
      whole = min(whole, 1.0_wp)
   end function wall_probability

   !> Probability that any mechanism can occur: what the probability of collapse tends to
   pure real(wp) function occurrence_of(p_occ, alternative)
      !> Probability that each mechanism can occur, and its alternative
      real(wp), intent(in) :: p_occ(:)
      integer, intent(in) :: alternative(:)

      real(wp) :: certain(1, size(p_occ)), whole(1)

      certain = 1.0_wp
      whole = wall_probability(p_occ, alternative, certain)
      occurrence_of = whole(1)
   end function occurrence_of

   !> Derivative of the probability of a wall with respect to that of each of its mechanisms
   pure function wall_slopes(p_occ, alternative, p) result(slopes)
      !> Probability that each mechanism can occur
      real(wp), intent(in) :: p_occ(:)
      !> Its alternative
      integer, intent(in) :: alternative(:)
      !> Probabilities of collapse if it can occur (levels, mechanisms)
      real(wp), intent(in) :: p(:, :)
      !> Derivatives (levels, mechanisms)
      real(wp) :: slopes(size(p, 1), size(p, 2))

      integer :: l, m

      do m = 1, size(p_occ)
         slopes(:, m) = p_occ(m)
         do l = 1, size(p_occ)
            if (l == m .or. alternative(l) /= alternative(m)) cycle
            ! In an alternative all of its mechanisms can occur.
            slopes(:, m) = slopes(:, m)*(1.0_wp - merge(p_occ(l), 1.0_wp, alternative(l) == 0)*p(:, l))
         end do
      end do
   end function wall_slopes

   !> Fit the lognormal of what can collapse
   subroutine fit_share(fit, levels, fraction, upper_asymptote, histories, error)
      type(fragility_type), intent(out) :: fit
      !> Levels of intensity, fractions of collapse, and histories that count
      real(wp), intent(in) :: levels(:), fraction(:), histories(:)
      !> What the fractions tend to: probability that any mechanism can occur
      real(wp), intent(in) :: upper_asymptote
      !> Fractions that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: share(size(levels))

      ! Divided first: where all that can collapse does, the share is 1 to the last bit and no survivor is made up.
      share = fraction
      if (upper_asymptote > 0.0_wp) share = min(share/upper_asymptote, 1.0_wp)
      call fit_fragility(fit, levels, histories*share, histories, error)
   end subroutine fit_share

end module dondolo_population_occurrence
