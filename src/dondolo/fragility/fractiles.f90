!> Weighted fractiles of numbers between 0 and 1 that come by one after the other, pass after pass, and are not kept.
!>
!> The fractile of a share q is the smallest number such that the numbers up to it have at least the share q of the
!> weight. It is found exactly, by radix selection: non-negative IEEE numbers order as the integers of their bits, so
!> that a histogram of the weights over a few bits tells in each pass the next bits of the fractile. Memory does not
!> depend on how many numbers there are. Numbers are taken as real64, also where wp has more digits.
module dondolo_fractiles
   use, intrinsic :: iso_fortran_env, only : int64, real64
   use dondolo_kinds, only : wp
   implicit none
   private

   public :: fractiles_type, new_fractiles, bits_within

   !> Bits of a number up to 1 that are not all zero: the sign and the highest bit of the exponent are
   integer, parameter :: key_bits = 62
   !> Most bits that a pass tells: more hardly save a pass
   integer, parameter :: most_bits = 13

   !> Fractiles of several series of numbers (such as one a level) with common weights
   type :: fractiles_type
      private
      !> Shares of the weight
      real(wp), allocatable :: share(:)
      !> Sum of the weights
      real(wp) :: total = 0.0_wp
      !> Bits that a pass tells
      integer :: bits = most_bits
      !> Bits below those that this pass tells; negative when there are no more
      integer :: shift = -1
      !> The bits of the fractiles that are known (shares, series)
      integer(int64), allocatable :: known(:, :)
      !> Weight of the numbers that are smaller in the known bits (shares, series)
      real(wp), allocatable :: below(:, :)
      !> Weights by the bits of this pass, of numbers that agree in the known ones (bins, shares, series)
      real(wp), allocatable :: histogram(:, :, :)
   contains
      !> Take in one number of each series
      procedure :: add
      !> All numbers have come by
      procedure :: end_pass
      !> Are the fractiles found?
      procedure :: complete
      !> The fractiles
      procedure :: values
   end type fractiles_type

contains

   !> How many bits a pass can tell within some memory
   pure function bits_within(bytes, fractiles) result(bits)
      !> Memory for the histograms [bytes]
      integer(int64), intent(in) :: bytes
      !> How many fractiles are looked for, of all series together
      integer(int64), intent(in) :: fractiles
      !> Bits, 1 at least
      integer :: bits

      do bits = most_bits, 2, -1
         if (shiftl(fractiles, bits)*(storage_size(1.0_wp)/8) <= bytes) exit
      end do
   end function bits_within

   !> Begin to look for fractiles
   pure subroutine new_fractiles(fractiles, shares, series, total, bits)
      !> The fractiles
      type(fractiles_type), intent(out) :: fractiles
      !> Shares of the weight, between 0 and 1
      real(wp), intent(in) :: shares(:)
      !> Number of series
      integer, intent(in) :: series
      !> Sum of the weights of all numbers of a series, positive
      real(wp), intent(in) :: total
      !> Bits that a pass tells
      integer, intent(in) :: bits

      fractiles%share = shares
      fractiles%total = total
      fractiles%bits = bits
      fractiles%shift = ((key_bits + bits - 1)/bits - 1)*bits
      allocate (fractiles%known(size(shares), series), source=0_int64)
      allocate (fractiles%below(size(shares), series), source=0.0_wp)
      allocate (fractiles%histogram(0:2**bits - 1, size(shares), series), source=0.0_wp)
   end subroutine new_fractiles

   !> Take in one number of each series
   pure subroutine add(self, numbers, weight)
      !> The fractiles
      class(fractiles_type), intent(inout) :: self
      !> The numbers, between 0 and 1
      real(wp), intent(in) :: numbers(:)
      !> Their weight, positive
      real(wp), intent(in) :: weight

      integer(int64) :: key, higher
      integer :: bin, j, k

      do j = 1, size(numbers)
         ! The bits of -0 are those of a large number.
         key = shiftr(transfer(abs(real(numbers(j), real64)), key), self%shift)
         bin = int(ibits(key, 0, self%bits))
         higher = shiftr(key, self%bits)
         do k = 1, size(self%share)
            if (higher == self%known(k, j)) self%histogram(bin, k, j) = self%histogram(bin, k, j) + weight
         end do
      end do
   end subroutine add

   !> All numbers have come by: the next bits are known
   pure subroutine end_pass(self)
      !> The fractiles
      class(fractiles_type), intent(inout) :: self

      ! Weights such as 0.1 do not add up to a share exactly.
      real(wp), parameter :: rounding = 1.0e-12_wp
      real(wp) :: target_weight
      integer :: bin, last, j, k

      do j = 1, size(self%known, 2)
         do k = 1, size(self%share)
            target_weight = (self%share(k) - rounding)*self%total
            associate (below => self%below(k, j), weight => self%histogram(:, k, j))
               ! Sums in another order may miss what the pass before found: it is the last number there is, then.
               last = findloc(weight > 0.0_wp, .true., dim=1, back=.true.)
               do bin = 1, last - 1
                  if (below + weight(bin) >= target_weight) exit
                  below = below + weight(bin)
               end do
               self%known(k, j) = shiftl(self%known(k, j), self%bits) + int(bin - 1, int64)
            end associate
         end do
      end do
      self%histogram = 0.0_wp
      self%shift = self%shift - self%bits
      if (self%shift < 0) deallocate (self%histogram)
   end subroutine end_pass

   !> Are the fractiles found?
   pure logical function complete(self)
      !> The fractiles
      class(fractiles_type), intent(in) :: self

      complete = self%shift < 0
   end function complete

   !> The fractiles
   pure function values(self)
      !> The fractiles, complete
      class(fractiles_type), intent(in) :: self
      !> Their values (shares, series)
      real(wp) :: values(size(self%share), size(self%known, 2))

      integer :: j

      do j = 1, size(values, 2)
         values(:, j) = real(transfer(self%known(:, j), 1.0_real64, size(values, 1)), wp)
      end do
   end function values

end module dondolo_fractiles
