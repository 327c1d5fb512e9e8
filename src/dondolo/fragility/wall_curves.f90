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

   public :: wall_curves_type, mechanism_counts_type, new_wall_curves, mechanism_length

   !> Room for the name of a mechanism
   integer, parameter :: mechanism_length = len(mechanism_names)

   !> What one mechanism of a wall came to
   type :: mechanism_counts_type
      !> The mechanism
      character(len=mechanism_length) :: mechanism = ''
      !> Probability that it can occur
      real(wp) :: p_occ = 1.0_wp
      !> Its curve
      type(fragility_type) :: curve
      !> Collapses at each level
      integer, allocatable :: collapses(:)
      !> Histories of a stripe
      integer :: histories = 0
   end type mechanism_counts_type

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
      !> Histories of a stripe of each
      integer, allocatable :: histories(:)
      !> Lognormal of the wall as a whole if a mechanism can occur in it: fitted to its fractions / occurrence; that of its
      !> mechanism, if one always can occur
      type(fragility_type) :: combined
   contains
      !> Can the wall do anything but collapse by one mechanism?
      procedure :: is_mixed
      !> Probability that any mechanism can occur
      procedure :: occurrence
      !> Histories of a stripe of the wall as a whole
      procedure :: combined_histories
      !> Fractions of collapse of the mechanisms and of the wall as a whole
      procedure :: fractions
      !> Probabilities of collapse of the mechanisms and of the wall as a whole
      procedure :: probabilities
   end type wall_curves_type

contains

   !> A wall from the counts and curves of its mechanisms
   subroutine new_wall_curves(wall, group, weight, counts, levels, error, is_fitted)
      !> The wall
      type(wall_curves_type), intent(out) :: wall
      !> Name of its group, empty if none was given
      character(len=*), intent(in) :: group
      !> Its weight, >= 0
      real(wp), intent(in) :: weight
      !> Its mechanisms, one at least
      type(mechanism_counts_type), intent(in) :: counts(:)
      !> Levels of intensity
      real(wp), intent(in) :: levels(:)
      !> Counts that cannot be fitted
      type(error_type), allocatable, intent(out) :: error
      !> Is the wall as a whole to be fitted? Yes if absent
      logical, intent(in), optional :: is_fitted

      real(wp) :: n(size(levels)), part(size(levels), size(counts) + 1)
      integer :: i

      wall%group = group
      wall%weight = weight
      wall%mechanism = counts%mechanism
      wall%p_occ = counts%p_occ
      wall%curve = counts%curve
      wall%histories = counts%histories
      allocate (wall%fraction(size(levels), size(counts)))
      do i = 1, size(counts)
         wall%fraction(:, i) = real(counts(i)%collapses, wp)/real(counts(i)%histories, wp)
      end do
      wall%combined = counts(1)%curve
      if (.not. wall%is_mixed()) return
      if (present(is_fitted)) then
         if (.not. is_fitted) return
      end if
      n = real(wall%combined_histories(), wp)
      part = wall%fractions()
      if (wall%occurrence() > 0.0_wp) part = min(part/wall%occurrence(), 1.0_wp)
      call fit_fragility(wall%combined, levels, n*part(:, size(part, 2)), n, error)
   end subroutine new_wall_curves

   !> Can the wall do anything but collapse by one mechanism?
   pure logical function is_mixed(self)
      !> The wall
      class(wall_curves_type), intent(in) :: self

      is_mixed = size(self%p_occ) > 1 .or. any(self%p_occ < 1.0_wp)
   end function is_mixed

   !> Probability that any mechanism can occur: what the probability of collapse tends to
   pure real(wp) function occurrence(self)
      !> The wall
      class(wall_curves_type), intent(in) :: self

      real(wp) :: certain(1, size(self%p_occ)), whole(1)

      certain = 1.0_wp
      whole = in_series(self%p_occ, certain)
      occurrence = whole(1)
   end function occurrence

   !> Histories of a stripe of the wall as a whole: no more than its mechanisms have
   pure integer function combined_histories(self)
      !> The wall
      class(wall_curves_type), intent(in) :: self

      combined_histories = minval(self%histories)
   end function combined_histories

   !> Fractions of collapse of the mechanisms, if they can occur, and of the wall as a whole
   pure function fractions(self) result(f)
      !> The wall
      class(wall_curves_type), intent(in) :: self
      !> Fractions (levels, mechanisms and last the wall)
      real(wp) :: f(size(self%fraction, 1), size(self%p_occ) + 1)

      f(:, :size(self%p_occ)) = self%fraction
      f(:, size(f, 2)) = in_series(self%p_occ, self%fraction)
   end function fractions

   !> Probabilities of collapse of the mechanisms, if they can occur, and of the wall as a whole. A mechanism without a
   !> fit takes part with its fractions
   pure function probabilities(self, levels) result(p)
      !> The wall
      class(wall_curves_type), intent(in) :: self
      !> Levels of intensity, those of the fractions
      real(wp), intent(in) :: levels(:)
      !> Probabilities (levels, mechanisms and last the wall)
      real(wp) :: p(size(levels), size(self%p_occ) + 1)

      integer :: m

      do m = 1, size(self%p_occ)
         if (self%curve(m)%has_fit()) then
            p(:, m) = self%curve(m)%probability(levels)
         else
            p(:, m) = self%fraction(:, m)
         end if
      end do
      p(:, size(p, 2)) = in_series(self%p_occ, p(:, :size(self%p_occ)))
   end function probabilities

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

end module dondolo_wall_curves
