!> Which of several uncertain quantities an outcome owes its scatter to: Sobol indices from any sample.
!>
!> The outcome is regressed on polynomials of the ranks of each quantity, up to the third degree, and on the products of
!> two first-degree ones (Blatman and Sudret 2010, Reliability Engineering and System Safety 95:1216-1229, for polynomial
!> chaos). The polynomials of a quantity are orthonormal over the sample, so that the squares of the coefficients are
!> the parts of the variance; each is reduced by the square of its standard error, which is what noise adds to it. The part
!> that the polynomials leave is `rest`. Quantities must be independent of each other.
module dondolo_population_sensitivity
   use dondolo_base_error, only : error_type, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_lapack, only : invert_symmetric
   use dondolo_base_student, only : student_quantile
   use dondolo_base_text, only : to_text
   implicit none
   private

   public :: sensitivity_type, new_sensitivity
   public :: smallest_sample

   !> Highest degree of the polynomials of one quantity
   integer, parameter :: degree = 3

   !> Confidence of the intervals
   real(wp), parameter :: confidence = 0.95_wp

   !> Parts of the variance of an outcome
   type :: sensitivity_type
      !> First-order indices: the part of the variance that a quantity alone explains, 0 to 1
      real(wp), allocatable :: first(:)
      !> Total indices: with its products with others
      real(wp), allocatable :: total(:)
      !> 95 % intervals (2, quantities), by the jackknife; for a Latin hypercube: of independent samples they are too narrow
      real(wp), allocatable :: first_interval(:, :), total_interval(:, :)
      !> Part that the polynomials do not explain
      real(wp) :: rest = 0.0_wp
   end type sensitivity_type

contains

   !> Fewest samples that the indices of some quantities are estimated from: two for each polynomial
   pure integer function smallest_sample(quantities)
      integer, intent(in) :: quantities

      smallest_sample = 2*(1 + degree*quantities + quantities*(quantities - 1)/2)
   end function smallest_sample

   !> Estimate the indices
   subroutine new_sensitivity(found, values, outcome, error)
      type(sensitivity_type), intent(out) :: found
      !> Values of the quantities (samples, quantities)
      real(wp), intent(in) :: values(:, :)
      !> Outcome of each sample
      real(wp), intent(in) :: outcome(:)
      !> Too few samples
      type(error_type), allocatable, intent(out) :: error

      real(wp), allocatable :: basis(:, :), inverse(:, :), coefficients(:), residuals(:), projected(:), moved(:, :, :)
      integer, allocatable :: owners(:, :)
      real(wp) :: noise, own(size(values, 2), 2), leverage, rest, half
      integer :: n, m, i, k
      logical :: ok

      n = size(outcome)
      k = size(values, 2)
      if (n < smallest_sample(k)) then
         call raise_input(error, to_text(n)//' samples with a curve: must be at least '//to_text(smallest_sample(k))// &
            & ' for indices of '//to_text(k)//' quantities')
         return
      end if
      call make_basis(values, basis, owners)
      m = size(basis, 2)
      allocate (inverse(m, m), moved(k, 2, n))
      call invert_symmetric(matmul(transpose(basis), basis), inverse, ok)
      if (.not. ok) then
         call raise_input(error, 'two quantities have the same ranks: indices are of independent ones')
         return
      end if
      coefficients = matmul(inverse, matmul(transpose(basis), outcome))
      residuals = outcome - matmul(basis, coefficients)
      noise = sum(residuals**2)/real(n - m, wp)
      call split(coefficients, noise, inverse, owners, own, found%rest)
      do i = 1, n
         ! The estimate without one sample (jackknife) follows from its leverage
         projected = matmul(inverse, basis(i, :))
         leverage = dot_product(basis(i, :), projected)
         if (.not. leverage < 1.0_wp) leverage = 0.0_wp
         associate (change => residuals(i)/(1.0_wp - leverage))
            call split(coefficients - projected*change, (noise*real(n - m, wp) - residuals(i)*change)/real(n - m - 1, wp), &
               & inverse, owners, moved(:, :, i), rest)
         end associate
      end do
      found%first = own(:, 1)
      found%total = own(:, 2)
      allocate (found%first_interval(2, k), found%total_interval(2, k))
      do i = 1, k
         half = width(moved(i, 1, :), n - m)
         found%first_interval(:, i) = min(1.0_wp, max(0.0_wp, own(i, 1) + [-half, half]))
         half = width(moved(i, 2, :), n - m)
         found%total_interval(:, i) = min(1.0_wp, max(0.0_wp, own(i, 2) + [-half, half]))
      end do
   end subroutine new_sensitivity

   !> Half the width of the interval of an estimate, of the estimates without one sample each
   pure real(wp) function width(without, degrees)
      real(wp), intent(in) :: without(:)
      !> Degrees of freedom
      integer, intent(in) :: degrees

      real(wp) :: n

      n = real(size(without), wp)
      width = student_quantile(0.5_wp*(1.0_wp + confidence), real(degrees, wp))* &
         & sqrt((n - 1.0_wp)/n*sum((without - sum(without)/n)**2))
   end function width

   !> Parts of the variance out of the coefficients
   pure subroutine split(coefficients, noise, inverse, owners, own, rest)
      !> Coefficients of the polynomials
      real(wp), intent(in) :: coefficients(:)
      !> Variance of what the polynomials leave
      real(wp), intent(in) :: noise
      !> Covariance of the coefficients / noise
      real(wp), intent(in) :: inverse(:, :)
      !> The quantities of each polynomial (2, polynomials); 0: none, or no second
      integer, intent(in) :: owners(:, :)
      !> First-order and total index of each quantity
      real(wp), intent(out) :: own(:, :)
      !> Index of what is left
      real(wp), intent(out) :: rest

      real(wp) :: part, whole
      integer :: j

      own = 0.0_wp
      whole = noise
      do j = 1, size(coefficients)
         if (owners(1, j) == 0) cycle
         part = coefficients(j)**2 - noise*inverse(j, j)
         whole = whole + part
         own(owners(1, j), 2) = own(owners(1, j), 2) + part
         if (owners(2, j) > 0) own(owners(2, j), 2) = own(owners(2, j), 2) + part
         if (owners(2, j) == 0) own(owners(1, j), 1) = own(owners(1, j), 1) + part
      end do
      rest = 0.0_wp
      if (.not. whole > 0.0_wp) then
         own = 0.0_wp
         return
      end if
      own = min(1.0_wp, max(0.0_wp, own/whole))
      own(:, 2) = max(own(:, 1), own(:, 2))
      rest = noise/whole
   end subroutine split

   !> The polynomials at the samples
   subroutine make_basis(values, basis, owners)
      !> Values of the quantities (samples, quantities)
      real(wp), intent(in) :: values(:, :)
      !> Values of the polynomials (samples, polynomials); the first is 1
      real(wp), allocatable, intent(out) :: basis(:, :)
      !> The quantities of each (2, polynomials); 0: none, or no second
      integer, allocatable, intent(out) :: owners(:, :)

      real(wp) :: polynomial(size(values, 1)), rank(size(values, 1)), norm
      integer :: i, k, power, m, before, first(size(values, 2))

      m = smallest_sample(size(values, 2))/2
      allocate (basis(size(rank), m))
      allocate (owners(2, m), source=0)
      basis(:, 1) = 1.0_wp
      m = 1
      first = 0
      do k = 1, size(values, 2)
         call compute_ranks(values(:, k), rank)
         before = m
         do power = 1, degree
            polynomial = rank**power
            ! Orthogonalised twice: rounding leaves components along the others the first time
            do i = 1, 2
               call project(polynomial, basis(:, 1:1))
               call project(polynomial, basis(:, before + 1:m))
            end do
            norm = sqrt(sum(polynomial**2)/real(size(rank), wp))
            ! A quantity of few distinct values has no polynomial of higher degree
            if (norm < 1.0e-6_wp) exit
            m = m + 1
            if (power == 1) first(k) = m
            basis(:, m) = polynomial/norm
            owners(1, m) = k
         end do
      end do
      do k = 1, size(values, 2)
         do i = 1, k - 1
            if (first(i) == 0 .or. first(k) == 0) cycle
            m = m + 1
            basis(:, m) = basis(:, first(i))*basis(:, first(k))
            owners(:, m) = [i, k]
         end do
      end do
      basis = basis(:, :m)
      owners = owners(:, :m)
   end subroutine make_basis

   !> Take out of a polynomial what lies along others of unit mean square
   pure subroutine project(polynomial, others)
      real(wp), intent(inout) :: polynomial(:)
      real(wp), intent(in) :: others(:, :)

      integer :: j

      do j = 1, size(others, 2)
         polynomial = polynomial - others(:, j)*dot_product(others(:, j), polynomial)/real(size(polynomial), wp)
      end do
   end subroutine project

   !> Ranks of values, from -1 to 1; those that are equal share their mean rank
   pure subroutine compute_ranks(values, rank)
      real(wp), intent(in) :: values(:)
      real(wp), intent(out) :: rank(:)

      integer :: i

      do i = 1, size(values)
         rank(i) = real(count(values < values(i)) - count(values > values(i)), wp)/real(size(values), wp)
      end do
   end subroutine compute_ranks

end module dondolo_population_sensitivity
