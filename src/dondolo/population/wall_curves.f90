!> One wall of a population: what its mechanisms came to, and the wall as a whole.
!>
!> Mechanisms are in series and independent of each other given the intensity: the wall collapses if any of them does,
!> P = 1 - prod_m (1 - p_occ,m P_m), with p_occ,m the probability that mechanism m can occur in the wall at all
!> (docs/theory.md, section 6).
module dondolo_wall_curves
   use dondolo_error, only : error_type
   use dondolo_fragility, only : fit_fragility, fragility_type
   use dondolo_kinds, only : wp
   use dondolo_wall, only : mechanism_names
   implicit none
   private

   public :: wall_curves_type, in_series, mechanism_length, series_slopes

   !> Room for the name of a mechanism
   integer, parameter :: mechanism_length = len(mechanism_names)

   !> A wall with the curves of its mechanisms
   type :: wall_curves_type
      !> Name of its group, empty if none was given
      character(len=:), allocatable :: group
      !> Its weight, >= 0
      real(wp) :: weight = 1.0_wp
      !> Its mechanisms
      character(len=mechanism_length), allocatable :: mechanism(:)
      !> Probability that each can occur
      real(wp), allocatable :: p_occ(:)
      !> Curve of each
      type(fragility_type), allocatable :: curve(:)
      !> Fractions of collapse (levels, mechanisms)
      real(wp), allocatable :: fraction(:, :)
      !> Histories of each in each stripe (levels, mechanisms)
      integer, allocatable :: histories(:, :)
      !> Lognormal of the wall as a whole if a mechanism can occur in it: fitted to its fractions / occurrence; that of its
      !> mechanism, if one always can occur
      type(fragility_type) :: combined
   contains
      !> Fit the wall as a whole
      procedure :: fit
      !> Can the wall do anything but collapse by one mechanism?
      procedure :: is_mixed
      !> Probability that any mechanism can occur
      procedure :: occurrence
      !> Histories of the wall as a whole in each stripe
      procedure :: combined_histories
      !> Fractions of collapse of the mechanisms and of the wall as a whole
      procedure :: fractions
      !> Probabilities of collapse of the mechanisms and of the wall as a whole
      procedure :: probabilities
   end type wall_curves_type

contains

   !> Fit the wall as a whole
   subroutine fit(self, levels, error)
      !> The wall: `combined` is set
      class(wall_curves_type), intent(inout) :: self
      !> Levels of intensity
      real(wp), intent(in) :: levels(:)
      !> Counts that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: n(size(levels)), part(size(levels), size(self%p_occ) + 1)

      self%combined = self%curve(1)
      if (.not. self%is_mixed()) return
      n = real(self%combined_histories(), wp)
      part = self%fractions()
      if (self%occurrence() > 0.0_wp) part = min(part/self%occurrence(), 1.0_wp)
      call fit_fragility(self%combined, levels, n*part(:, size(part, 2)), n, error)
   end subroutine fit

   !> Can the wall do anything but collapse by one mechanism?
   pure logical function is_mixed(self)
      class(wall_curves_type), intent(in) :: self

      is_mixed = size(self%p_occ) > 1 .or. any(self%p_occ < 1.0_wp)
   end function is_mixed

   !> Probability that any mechanism can occur: what the probability of collapse tends to
   pure real(wp) function occurrence(self)
      class(wall_curves_type), intent(in) :: self

      real(wp) :: certain(1, size(self%p_occ)), whole(1)

      certain = 1.0_wp
      whole = in_series(self%p_occ, certain)
      occurrence = whole(1)
   end function occurrence

   !> Histories of the wall as a whole in each stripe: no more than its mechanisms have
   pure function combined_histories(self)
      class(wall_curves_type), intent(in) :: self
      integer :: combined_histories(size(self%histories, 1))

      combined_histories = minval(self%histories, dim=2)
   end function combined_histories

   !> Fractions of collapse of the mechanisms, if they can occur, and of the wall as a whole
   pure function fractions(self) result(f)
      class(wall_curves_type), intent(in) :: self
      !> Fractions (levels, mechanisms and last the wall)
      real(wp) :: f(size(self%fraction, 1), size(self%p_occ) + 1)

      f(:, :size(self%p_occ)) = self%fraction
      f(:, size(f, 2)) = in_series(self%p_occ, self%fraction)
   end function fractions

   !> Probabilities of collapse of the mechanisms, if they can occur, and of the wall as a whole. A mechanism without a
   !> fit takes part with its fractions: between the levels they are interpolated linearly, from 0 at x = 0; above the
   !> highest level they stay
   pure function probabilities(self, levels, x) result(p)
      class(wall_curves_type), intent(in) :: self
      !> Levels of intensity of the fractions
      real(wp), intent(in) :: levels(:)
      !> Levels that are asked for
      real(wp), intent(in) :: x(:)
      !> Probabilities (x, mechanisms and last the wall)
      real(wp) :: p(size(x), size(self%p_occ) + 1)

      integer :: m

      do m = 1, size(self%p_occ)
         if (self%curve(m)%has_fit()) then
            p(:, m) = self%curve(m)%probability(x)
         else
            p(:, m) = interpolated(levels, self%fraction(:, m), x)
         end if
      end do
      p(:, size(p, 2)) = in_series(self%p_occ, p(:, :size(self%p_occ)))
   end function probabilities

   !> Fractions at any levels, on the lines between those that are known
   pure function interpolated(levels, fractions, x) result(p)
      !> Levels of intensity, positive and increasing
      real(wp), intent(in) :: levels(:)
      !> Fractions there
      real(wp), intent(in) :: fractions(:)
      !> Levels that are asked for
      real(wp), intent(in) :: x(:)
      !> Fractions at these
      real(wp) :: p(size(x))

      real(wp) :: below, before
      integer :: i, j

      do i = 1, size(x)
         j = count(levels <= x(i))
         below = 0.0_wp
         before = 0.0_wp
         if (j > 0) then
            below = fractions(j)
            before = levels(j)
         end if
         p(i) = below
         if (j < size(levels) .and. x(i) > before) then
            p(i) = below + (fractions(j + 1) - below)*(x(i) - before)/(levels(j + 1) - before)
         end if
      end do
   end function interpolated

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

end module dondolo_wall_curves
