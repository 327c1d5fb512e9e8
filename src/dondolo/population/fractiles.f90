!> Weighted fractiles: the fractile of a share q is the smallest number such that the numbers up to it have at least the
!> share q of the weight.
module dondolo_fractiles
   use dondolo_kinds, only : wp
   use dondolo_order, only : find_order
   implicit none
   private

   public :: weighted_fractiles

contains

   !> Fractiles of some numbers
   pure subroutine weighted_fractiles(numbers, weights, total, shares, fractiles)
      !> The numbers, one at least, none negative
      real(wp), intent(in) :: numbers(:)
      !> Their weights, positive
      real(wp), intent(in) :: weights(:)
      !> Sum of the weights, as its owner has added it up
      real(wp), intent(in) :: total
      !> Shares of the weight, above 0 and up to 1, in any order
      real(wp), intent(in) :: shares(:)
      !> Fractile of each share, one of the numbers
      real(wp), intent(out) :: fractiles(:)

      ! Weights such as 0.1 do not add up to a share exactly.
      real(wp), parameter :: rounding = 1.0e-12_wp
      real(wp), allocatable :: reached(:)
      integer, allocatable :: order(:)
      integer :: k, low, high, middle

      call find_order(numbers, order)
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

end module dondolo_fractiles
