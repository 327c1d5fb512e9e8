!> Random numbers that are the same on every machine and with every compiler.
!>
!> MRG32k3a: L'Ecuyer (1999), Good parameters and implementations for combined multiple recursive random number
!> generators, Operations Research 47(1):159-164. Streams: L'Ecuyer, Simard, Chen, Kelton (2002), An object-oriented
!> random-number package with many long streams and substreams, Operations Research 50(6):1073-1075: stream k begins
!> 2**127 k numbers after stream 0. Seeding: all six words of the state of stream 0 are the seed (the seed 12345 is
!> the published default). All arithmetic is on integers that fit 64 bits, so nothing depends on rounding.
module dondolo_record_random
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: random_type, new_random

   !> Modulus of the first recursion
   integer(int64), parameter :: m1 = 4294967087_int64

   !> Modulus of the second recursion
   integer(int64), parameter :: m2 = 4294944443_int64

   !> x(n) = (a12 x(n-2) - a13 x(n-3)) mod m1
   integer(int64), parameter :: a12 = 1403580_int64, a13 = 810728_int64

   !> y(n) = (a21 y(n-1) - a23 y(n-3)) mod m2
   integer(int64), parameter :: a21 = 527612_int64, a23 = 1370589_int64

   !> log2 of the distance between two streams
   integer, parameter :: log2_stream_distance = 127

   !> A generator: its state
   type :: random_type
      private
      !> x(n-3), x(n-2), x(n-1)
      integer(int64) :: x(3) = 12345_int64
      !> y(n-3), y(n-2), y(n-1)
      integer(int64) :: y(3) = 12345_int64
   contains
      !> The next number
      procedure :: next
      !> The same in pure procedures
      procedure :: draw
   end type random_type

contains

   !> Start a generator
   pure function new_random(seed, stream) result(random)
      !> Seed, positive
      integer, intent(in) :: seed
      !> Number of the stream, from 0
      integer, intent(in) :: stream
      !> Generator at the beginning of the stream
      type(random_type) :: random

      integer(int64) :: a(3, 3), b(3, 3)
      integer :: i, rest

      random%x = int(seed, int64)
      random%y = int(seed, int64)
      a = transpose(reshape([0_int64, 1_int64, 0_int64, 0_int64, 0_int64, 1_int64, m1 - a13, a12, 0_int64], [3, 3]))
      b = transpose(reshape([0_int64, 1_int64, 0_int64, 0_int64, 0_int64, 1_int64, m2 - a23, 0_int64, a21], [3, 3]))
      do i = 1, log2_stream_distance
         a = product_modulo(a, a, m1)
         b = product_modulo(b, b, m2)
      end do
      ! Powers of these by the binary digits of the stream's number
      rest = stream
      do while (rest > 0)
         if (modulo(rest, 2) == 1) then
            random%x = reshape(product_modulo(a, reshape(random%x, [3, 1]), m1), [3])
            random%y = reshape(product_modulo(b, reshape(random%y, [3, 1]), m2), [3])
         end if
         a = product_modulo(a, a, m1)
         b = product_modulo(b, b, m2)
         rest = rest/2
      end do
   end function new_random

   !> The next number, uniform between 0 and 1, both excluded
   function next(self) result(uniform)
      class(random_type), intent(inout) :: self
      !> Number, a multiple of 1/(m1 + 1)
      real(wp) :: uniform

      call self%draw(uniform)
   end function next

   !> Draw the next number
   pure subroutine draw(self, uniform)
      class(random_type), intent(inout) :: self
      !> Number between 0 and 1, both excluded, a multiple of 1/(m1 + 1)
      real(wp), intent(out) :: uniform

      integer(int64) :: x, y

      x = modulo(a12*self%x(2) - a13*self%x(1), m1)
      self%x = [self%x(2:3), x]
      y = modulo(a21*self%y(3) - a23*self%y(1), m2)
      self%y = [self%y(2:3), y]
      x = x - y
      if (x <= 0) x = x + m1
      uniform = real(x, wp)/real(m1 + 1, wp)
   end subroutine draw

   !> Product of two matrices modulo m
   pure function product_modulo(a, b, m) result(c)
      !> Left matrix, 0 <= a < m
      integer(int64), intent(in) :: a(:, :)
      !> Right matrix, 0 <= b < m
      integer(int64), intent(in) :: b(:, :)
      !> Modulus, below 2**32
      integer(int64), intent(in) :: m
      !> a b modulo m
      integer(int64) :: c(size(a, 1), size(b, 2))

      !> Factors are cut into halves of 16 bits, so that products stay below 2**63
      integer(int64), parameter :: half = 65536_int64
      integer(int64) :: high
      integer :: i, j, k

      c = 0
      do j = 1, size(b, 2)
         do k = 1, size(a, 2)
            do i = 1, size(a, 1)
               high = modulo((a(i, k)/half)*b(k, j), m)
               c(i, j) = modulo(c(i, j) + high*half + modulo(a(i, k), half)*b(k, j), m)
            end do
         end do
      end do
   end function product_modulo

end module dondolo_record_random
