!> Weighted means and fractiles of what the rows or the walls of a part of a population have.
!>
!> The fractile of a share q is the smallest number such that the numbers up to it have at least the share q of the weight.
module dondolo_population_weights
   use dondolo_base_kinds, only : wp
   use dondolo_base_order, only : make_order
   use dondolo_population, only : part_type, population_type
   implicit none
   private

   public :: weights_type, weights_of, weighted_fractiles

   !> The members of a part of a population, whose weighted mean is its curve
   type :: weights_type
      !> Columns of the population: rows, or walls behind them
      integer, allocatable :: column(:)
      !> Their weights, positive
      real(wp), allocatable :: weight(:)
   contains
      !> Weighted mean
      procedure :: mean
      !> Weighted fractiles
      procedure :: fractiles
   end type weights_type

contains

   !> Weights of a part; what has none is left out
   pure function weights_of(population, part) result(weights)
      type(population_type), intent(in) :: population
      type(part_type), intent(in) :: part
      type(weights_type) :: weights

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
            weights%column(n) = i
            weights%weight(n) = weight
         end do
         if (pass == 1) allocate (weights%column(n), weights%weight(n))
      end do
   end function weights_of

   !> Weighted mean; of what is at most 1 it is at most 1, whatever rounding does
   pure function mean(self, p)
      class(weights_type), intent(in) :: self
      !> Fractions or probabilities of the population (x, columns)
      real(wp), intent(in) :: p(:, :)
      !> Mean at each x
      real(wp) :: mean(size(p, 1))

      integer :: i

      mean = 0.0_wp
      do i = 1, size(self%column)
         mean = mean + self%weight(i)*p(:, self%column(i))
      end do
      mean = min(mean/sum(self%weight), 1.0_wp)
   end function mean

   !> Weighted fractiles
   pure function fractiles(self, p, shares)
      class(weights_type), intent(in) :: self
      !> Probabilities of the population (x, columns)
      real(wp), intent(in) :: p(:, :)
      !> Shares of the weight, above 0 and up to 1
      real(wp), intent(in) :: shares(:)
      !> Fractiles (shares, x)
      real(wp) :: fractiles(size(shares), size(p, 1))

      real(wp), allocatable :: numbers(:)
      integer :: i

      if (size(shares) == 0) return
      do i = 1, size(p, 1)
         numbers = p(i, self%column)
         call weighted_fractiles(numbers, self%weight, shares, fractiles(:, i))
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
      real(wp), allocatable :: reached(:)
      real(wp) :: total
      integer, allocatable :: order(:)
      integer :: k, low, high, middle

      ! In the order of the population: the fractiles do not depend on how the last digit of another sum is rounded.
      total = sum(weights)
      call make_order(numbers, order)
      reached = weights(order)
      do k = 2, size(reached)
         reached(k) = reached(k - 1) + reached(k)
      end do
      do k = 1, size(shares)
         ! The first place that reaches the share; the last one if rounding lets none
         low = 1
         high = size(reached)
         do while (low < high)
            middle = low + (high - low)/2
            if (reached(middle) >= (shares(k) - rounding)*total) then
               high = middle
            else
               low = middle + 1
            end if
         end do
         ! A zero with a sign is a zero
         fractiles(k) = abs(numbers(order(low)))
      end do
   end subroutine weighted_fractiles

end module dondolo_population_weights
