!> Random numbers that are the same on every machine and with every compiler.
!>
!> MRG32k3a: L'Ecuyer (1999), Good parameters and implementations for combined multiple recursive random number
!> generators, Operations Research 47(1):159-164. Streams: L'Ecuyer, Simard, Chen, Kelton (2002), An object-oriented
!> random-number package with many long streams and substreams, Operations Research 50(6):1073-1075: stream k begins
!> 2**127 k numbers after stream 0. Seeding: all six words of the state of stream 0 are the seed (the seed 12345 is
!> the published default). All arithmetic is on integers that fit 64 bits, so nothing depends on rounding.
!>
!> The first numbers of neighbouring seeds are then nearly proportional to the seeds. Where users compare seeds, the state comes
!> from SplitMix64: Steele, Lea and Flood (2014), Fast splittable pseudorandom number generators, OOPSLA '14, 453-472. Streams of
!> one seed are as far apart as before; states of different seeds are as good as random, among 2**191.
module dondolo_record_random
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: random_type, new_random, new_hashed_random, split_mix

   !> Modulus of the first recursion
   integer(int64), parameter :: m1 = 4294967087_int64

   !> Modulus of the second recursion
   integer(int64), parameter :: m2 = 4294944443_int64

   !> x(n) = (a12 x(n-2) - a13 x(n-3)) mod m1
   integer(int64), parameter :: a12 = 1403580_int64, a13 = 810728_int64

   !> y(n) = (a21 y(n-1) - a23 y(n-3)) mod m2
   integer(int64), parameter :: a21 = 527612_int64, a23 = 1370589_int64

   !> Limbs of 16 bits of a word of 64 bits, the lowest first: Fortran's integers must not overflow
   integer, parameter :: limbs = 4, bits = 16

   !> Step of SplitMix64, and its multipliers: 9e3779b97f4a7c15, bf58476d1ce4e5b9 and 94d049bb133111eb
   integer(int64), parameter :: golden(limbs) = [integer(int64) :: 31765, 32586, 31161, 40503]
   integer(int64), parameter :: first_factor(limbs) = [integer(int64) :: 58809, 7396, 18285, 48984]
   integer(int64), parameter :: second_factor(limbs) = [integer(int64) :: 4587, 4913, 18875, 38096]

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

   !> Start a generator whose state is the seed
   pure function new_random(seed, stream) result(random)
      !> Seed, positive
      integer, intent(in) :: seed
      !> Number of the stream, from 0
      integer, intent(in) :: stream
      !> Generator at the beginning of the stream
      type(random_type) :: random

      random%x = int(seed, int64)
      random%y = int(seed, int64)
      call jump(random, stream)
   end function new_random

   !> Start a generator whose state is a hash of the seed: no number of one seed follows from those of another
   pure function new_hashed_random(seed, stream) result(random)
      !> Seed, positive
      integer, intent(in) :: seed
      !> Number of the stream, from 0
      integer, intent(in) :: stream
      !> Generator at the beginning of the stream
      type(random_type) :: random

      integer(int64) :: state, word
      integer :: i

      state = int(seed, int64)
      do i = 1, 6
         call split_mix(state, word)
         ! Without its last bit it is not negative; no word is 0, so that not all are.
         word = ishft(word, -1)
         if (i <= 3) random%x(i) = 1 + modulo(word, m1 - 1)
         if (i > 3) random%y(i - 3) = 1 + modulo(word, m2 - 1)
      end do
      call jump(random, stream)
   end function new_hashed_random

   !> The next word of SplitMix64
   pure subroutine split_mix(state, word)
      !> State, at first the seed
      integer(int64), intent(inout) :: state
      !> Word of 64 random bits
      integer(int64), intent(out) :: word

      state = sum_of(state, golden)
      word = product_of(ieor(state, ishft(state, -30)), first_factor)
      word = product_of(ieor(word, ishft(word, -27)), second_factor)
      word = ieor(word, ishft(word, -31))
   end subroutine split_mix

   !> Sum of two words modulo 2**64
   pure integer(int64) function sum_of(word, other)
      integer(int64), intent(in) :: word
      !> Its limbs
      integer(int64), intent(in) :: other(limbs)

      sum_of = carried(limbs_of(word) + other)
   end function sum_of

   !> Product of two words modulo 2**64
   pure integer(int64) function product_of(word, other)
      integer(int64), intent(in) :: word
      !> Its limbs
      integer(int64), intent(in) :: other(limbs)

      integer(int64) :: own(limbs), products(limbs)
      integer :: i

      own = limbs_of(word)
      do i = 1, limbs
         products(i) = dot_product(own(:i), other(i:1:-1))
      end do
      product_of = carried(products)
   end function product_of

   !> Limbs of a word
   pure function limbs_of(word)
      integer(int64), intent(in) :: word
      integer(int64) :: limbs_of(limbs)

      integer :: i

      limbs_of = [(ibits(word, bits*i, bits), i=0, limbs - 1)]
   end function limbs_of

   !> Word of limbs that may be too large, without what is beyond 64 bits
   pure integer(int64) function carried(large) result(word)
      !> Limbs, less than 2**62
      integer(int64), intent(in) :: large(limbs)

      integer(int64) :: rest
      integer :: i

      word = 0
      rest = 0
      do i = 1, limbs
         rest = rest + large(i)
         word = ior(word, ishft(ibits(rest, 0, bits), bits*(i - 1)))
         rest = ishft(rest, -bits)
      end do
   end function carried

   !> Jump from the beginning of stream 0 to that of another
   pure subroutine jump(random, stream)
      type(random_type), intent(inout) :: random
      !> Number of the stream, from 0
      integer, intent(in) :: stream

      integer(int64) :: a(3, 3), b(3, 3)
      integer :: i, rest

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
   end subroutine jump

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
