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
   public :: jumps_type, new_jumps

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

   !> Matrices of both recursions to the power 2**127, the distance between two streams, column by column
   integer(int64), parameter :: to_next_x(3, 3) = reshape([2427906178_int64, 226153695_int64, 1988835001_int64, &
      & 3580155704_int64, 1230515664_int64, 986791581_int64, 949770784_int64, 3580155704_int64, 1230515664_int64], [3, 3])
   integer(int64), parameter :: to_next_y(3, 3) = reshape([1464411153_int64, 32183930_int64, 2824425944_int64, &
      & 277697599_int64, 1464411153_int64, 32183930_int64, 1610723613_int64, 1022607788_int64, 2093834863_int64], [3, 3])

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

   !> Jumps to streams: the powers of these matrices by the binary digits of a stream's number
   type :: jumps_type
      private
      integer(int64) :: x(3, 3, digits(1)) = 0, y(3, 3, digits(1)) = 0
   end type jumps_type

contains

   !> Jumps to streams, for generators of which many are started
   pure function new_jumps() result(jumps)
      type(jumps_type) :: jumps

      integer :: i

      jumps%x(:, :, 1) = to_next_x
      jumps%y(:, :, 1) = to_next_y
      do i = 2, digits(1)
         jumps%x(:, :, i) = product_modulo(jumps%x(:, :, i - 1), jumps%x(:, :, i - 1), m1)
         jumps%y(:, :, i) = product_modulo(jumps%y(:, :, i - 1), jumps%y(:, :, i - 1), m2)
      end do
   end function new_jumps

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
      call jump(random, stream, new_jumps())
   end function new_random

   !> Start a generator whose state is a hash of the seed: no number of one seed follows from those of another
   pure function new_hashed_random(seed, stream, jumps) result(random)
      !> Seed, positive
      integer, intent(in) :: seed
      !> Number of the stream, from 0
      integer, intent(in) :: stream
      !> Jumps to streams; absent: they are made
      type(jumps_type), intent(in), optional :: jumps
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
      if (present(jumps)) then
         call jump(random, stream, jumps)
      else
         call jump(random, stream, new_jumps())
      end if
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
   pure subroutine jump(random, stream, jumps)
      type(random_type), intent(inout) :: random
      !> Number of the stream, from 0
      integer, intent(in) :: stream
      type(jumps_type), intent(in) :: jumps

      integer :: i

      do i = 1, digits(stream)
         if (.not. btest(stream, i - 1)) cycle
         random%x = reshape(product_modulo(jumps%x(:, :, i), reshape(random%x, [3, 1]), m1), [3])
         random%y = reshape(product_modulo(jumps%y(:, :, i), reshape(random%y, [3, 1]), m2), [3])
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

      !> Factors are cut into halves of 16 bits, so that products stay below 2**48, and sums of all of them below 2**63
      integer, parameter :: half = 16
      integer(int64) :: high
      integer :: i, j, k

      c = 0
      do j = 1, size(b, 2)
         do k = 1, size(a, 2)
            do i = 1, size(a, 1)
               high = modulo(ishft(a(i, k), -half)*b(k, j), m)
               c(i, j) = c(i, j) + ishft(high, half) + ibits(a(i, k), 0, half)*b(k, j)
            end do
         end do
      end do
      c = modulo(c, m)
   end function product_modulo

end module dondolo_record_random
