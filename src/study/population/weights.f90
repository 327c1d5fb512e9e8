!> Weighted means and fractiles of what the rows or the walls of a part of a population have.
!>
!> The fractile of a share q is the smallest number such that the numbers up to it have at least the share q of the weight.
module dondolo_population_weights
   use dondolo_base_kinds, only : wp
   use dondolo_base_order, only : make_order
   use dondolo_population, only : part_type, population_type
   implicit none
   private

   public :: weights_type, weighted_fractiles

   !> The members of a part of a population, whose weighted mean is its curve
   type :: weights_type
      !> Columns of the population: rows, or walls behind them
      integer, allocatable :: column(:)
      !> Their weights, positive
      real(wp), allocatable :: weight(:)
   contains
      !> Take the members of a part
      procedure :: take
      !> At how many levels the probabilities of all members are computed at a time
      procedure :: levels_at_a_time
      !> Weighted mean
      procedure :: mean
      !> Weighted fractiles
      procedure :: fractiles
   end type weights_type

contains

   !> Take the members of a part; what has no weight is left out
   subroutine take(self, population, part)
      class(weights_type), intent(out) :: self
      type(population_type), intent(in) :: population
      type(part_type), intent(in) :: part

      real(wp) :: weight
      integer :: i, n, pass

      ! Counted first: of a large population no more is held than is needed.
      do pass = 1, 2
         n = 0
         do i = 1, population%rows + population%walls
            weight = population%weight_in(part, i)
            if (.not. weight > 0.0_wp) cycle
            n = n + 1
            if (pass == 1) cycle
            self%column(n) = i
            self%weight(n) = weight
         end do
         if (pass == 1) allocate (self%column(n), self%weight(n))
      end do
   end subroutine take

   !> At how many levels the probabilities of all members are computed at a time: a few MB, or a single level
   pure integer function levels_at_a_time(self) result(levels)
      class(weights_type), intent(in) :: self

      integer, parameter :: most_numbers = 500000

      levels = max(1, most_numbers/max(1, size(self%column)))
   end function levels_at_a_time

   !> Weighted mean; of what is at most 1 it is at most 1, whatever rounding does
   pure function mean(self, p)
      class(weights_type), intent(in) :: self
      !> Fractions or probabilities of the members (members, x)
      real(wp), intent(in) :: p(:, :)
      !> Mean at each x
      real(wp) :: mean(size(p, 2))

      integer :: i, k

      mean = 0.0_wp
      do k = 1, size(p, 2)
         do i = 1, size(p, 1)
            mean(k) = mean(k) + self%weight(i)*p(i, k)
         end do
      end do
      mean = min(mean/sum(self%weight), 1.0_wp)
   end function mean

   !> Weighted fractiles
   pure function fractiles(self, p, shares)
      class(weights_type), intent(in) :: self
      !> Probabilities of the members (members, x)
      real(wp), intent(in) :: p(:, :)
      !> Shares of the weight, above 0 and up to 1
      real(wp), intent(in) :: shares(:)
      !> Fractiles (shares, x)
      real(wp) :: fractiles(size(shares), size(p, 2))

      integer :: k

      do k = 1, size(p, 2)
         call weighted_fractiles(p(:, k), self%weight, shares, fractiles(:, k))
      end do
   end function fractiles

   !> Fractiles of some numbers
   pure subroutine weighted_fractiles(numbers, weights, shares, fractiles)
      !> The numbers, one at least, none negative
      real(wp), intent(in) :: numbers(:)
      !> Their weights, positive
      real(wp), intent(in) :: weights(:)
      !> Shares of the weight, above 0 and up to 1, in any order
      real(wp), intent(in) :: shares(:)
      !> Fractile of each share, one of the numbers
      real(wp), intent(out) :: fractiles(:)

      ! Weights such as 0.1 do not add up to a share exactly.
      real(wp), parameter :: rounding = 1.0e-12_wp
      real(wp) :: total, reached
      integer, allocatable :: order(:), from_least(:)
      integer :: i, k

      if (size(shares) == 0) return
      ! In the order of the population: the fractiles do not depend on how the last digit of another sum is rounded.
      total = sum(weights)
      call make_order(shares, from_least)
      call make_order(numbers, order)
      ! The first number at which a share is reached; the last one if rounding lets none
      reached = weights(order(1))
      i = 1
      do k = 1, size(shares)
         do while (i < size(order) .and. .not. reached >= (shares(from_least(k)) - rounding)*total)
            i = i + 1
            reached = reached + weights(order(i))
         end do
         ! A zero with a sign is a zero
         fractiles(from_least(k)) = abs(numbers(order(i)))
      end do
   end subroutine weighted_fractiles

end module dondolo_population_weights
