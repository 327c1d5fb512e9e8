!> SHA-256 of files (FIPS 180-4), the number that `sha256sum` prints: it says which inputs a result is of.
!>
!> Words of 32 bits are held in 64 and masked, since Fortran's integers must not overflow.
module dondolo_sha256
   use, intrinsic :: iso_fortran_env, only : int64
   implicit none
   private

   public :: sha256_of_file, sha256_length

   !> Length of a checksum in hexadecimal figures
   integer, parameter :: sha256_length = 64

   !> Bytes of a block, and bytes that are read from a file at once
   integer, parameter :: block = 64, chunk = 1024*block

   integer(int64), parameter :: mask = int(z'ffffffff', int64)

   !> Fractional parts of the square roots of the first 8 primes
   integer(int64), parameter :: initial(8) = [int(z'6a09e667', int64), int(z'bb67ae85', int64), &
      & int(z'3c6ef372', int64), int(z'a54ff53a', int64), int(z'510e527f', int64), int(z'9b05688c', int64), &
      & int(z'1f83d9ab', int64), int(z'5be0cd19', int64)]

   !> Fractional parts of the cube roots of the first 64 primes
   integer(int64), parameter :: k(64) = [ &
      & int(z'428a2f98', int64), int(z'71374491', int64), int(z'b5c0fbcf', int64), int(z'e9b5dba5', int64), &
      & int(z'3956c25b', int64), int(z'59f111f1', int64), int(z'923f82a4', int64), int(z'ab1c5ed5', int64), &
      & int(z'd807aa98', int64), int(z'12835b01', int64), int(z'243185be', int64), int(z'550c7dc3', int64), &
      & int(z'72be5d74', int64), int(z'80deb1fe', int64), int(z'9bdc06a7', int64), int(z'c19bf174', int64), &
      & int(z'e49b69c1', int64), int(z'efbe4786', int64), int(z'0fc19dc6', int64), int(z'240ca1cc', int64), &
      & int(z'2de92c6f', int64), int(z'4a7484aa', int64), int(z'5cb0a9dc', int64), int(z'76f988da', int64), &
      & int(z'983e5152', int64), int(z'a831c66d', int64), int(z'b00327c8', int64), int(z'bf597fc7', int64), &
      & int(z'c6e00bf3', int64), int(z'd5a79147', int64), int(z'06ca6351', int64), int(z'14292967', int64), &
      & int(z'27b70a85', int64), int(z'2e1b2138', int64), int(z'4d2c6dfc', int64), int(z'53380d13', int64), &
      & int(z'650a7354', int64), int(z'766a0abb', int64), int(z'81c2c92e', int64), int(z'92722c85', int64), &
      & int(z'a2bfe8a1', int64), int(z'a81a664b', int64), int(z'c24b8b70', int64), int(z'c76c51a3', int64), &
      & int(z'd192e819', int64), int(z'd6990624', int64), int(z'f40e3585', int64), int(z'106aa070', int64), &
      & int(z'19a4c116', int64), int(z'1e376c08', int64), int(z'2748774c', int64), int(z'34b0bcb5', int64), &
      & int(z'391c0cb3', int64), int(z'4ed8aa4a', int64), int(z'5b9cca4f', int64), int(z'682e6ff3', int64), &
      & int(z'748f82ee', int64), int(z'78a5636f', int64), int(z'84c87814', int64), int(z'8cc70208', int64), &
      & int(z'90befffa', int64), int(z'a4506ceb', int64), int(z'bef9a3f7', int64), int(z'c67178f2', int64)]

contains

   !> Checksum of a file
   subroutine sha256_of_file(path, checksum, bytes, ok)
      !> Path
      character(len=*), intent(in) :: path
      !> Checksum in lower case
      character(len=sha256_length), intent(out) :: checksum
      !> Length of the file
      integer(int64), intent(out) :: bytes
      !> The file could be read
      logical, intent(out) :: ok

      character(len=chunk) :: part
      character(len=2*block) :: tail
      integer(int64) :: state(8), left
      integer :: unit, stat, length, i

      checksum = ''
      inquire (file=path, size=bytes)
      open (newunit=unit, file=path, access='stream', form='unformatted', action='read', status='old', iostat=stat)
      ok = stat == 0 .and. bytes >= 0
      if (.not. ok) return
      state = initial
      length = 0
      left = bytes
      do while (left > 0)
         length = int(min(left, int(chunk, int64)))
         read (unit, iostat=stat) part(:length)
         if (stat /= 0) exit
         left = left - length
         do i = 1, length - block + 1, block
            call add_block(state, part(i:i + block - 1))
         end do
         length = modulo(length, block)
         if (length > 0) tail(:length) = part(i:i + length - 1)
      end do
      close (unit)
      ok = stat == 0
      if (.not. ok) return
      call pad(tail, length, bytes)
      do i = 1, length - block + 1, block
         call add_block(state, tail(i:i + block - 1))
      end do
      write (checksum, '(8z8.8)') state
      do i = 1, sha256_length
         if (checksum(i:i) >= 'A') checksum(i:i) = achar(iachar(checksum(i:i)) + 32)
      end do
   end subroutine sha256_of_file

   !> End a message: a bit 1, zeros, and its length in bits as the last 8 bytes of a block
   pure subroutine pad(tail, length, bytes)
      !> What is left of the message beyond its last whole block
      character(len=2*block), intent(inout) :: tail
      !> Its length, on return one block or two
      integer, intent(inout) :: length
      !> Length of the message
      integer(int64), intent(in) :: bytes

      integer :: end, i

      end = merge(block, 2*block, length + 9 <= block)
      tail(length + 1:length + 1) = achar(128)
      tail(length + 2:end) = repeat(achar(0), end - length - 1)
      do i = 0, 7
         tail(end - i:end - i) = char(int(ibits(8*bytes, 8*i, 8)))
      end do
      length = end
   end subroutine pad

   !> Take in a block
   pure subroutine add_block(state, text)
      !> State of the hash
      integer(int64), intent(inout) :: state(8)
      !> The block
      character(len=block), intent(in) :: text

      integer(int64) :: w(64), a, b, c, d, e, f, g, h, first, second
      integer :: i

      do i = 1, 16
         w(i) = ior(ior(shiftl(byte(4*i - 3), 24), shiftl(byte(4*i - 2), 16)), ior(shiftl(byte(4*i - 1), 8), byte(4*i)))
      end do
      do i = 17, 64
         w(i) = iand(w(i - 16) + ieor(ieor(turned(w(i - 15), 7), turned(w(i - 15), 18)), shiftr(w(i - 15), 3)) + w(i - 7) &
            & + ieor(ieor(turned(w(i - 2), 17), turned(w(i - 2), 19)), shiftr(w(i - 2), 10)), mask)
      end do
      a = state(1); b = state(2); c = state(3); d = state(4)
      e = state(5); f = state(6); g = state(7); h = state(8)
      do i = 1, 64
         first = h + ieor(ieor(turned(e, 6), turned(e, 11)), turned(e, 25)) + ieor(iand(e, f), iand(ieor(e, mask), g)) &
            & + k(i) + w(i)
         second = ieor(ieor(turned(a, 2), turned(a, 13)), turned(a, 22)) + ieor(ieor(iand(a, b), iand(a, c)), iand(b, c))
         h = g; g = f; f = e
         e = iand(d + first, mask)
         d = c; c = b; b = a
         a = iand(first + second, mask)
      end do
      state = iand(state + [a, b, c, d, e, f, g, h], mask)

   contains

      !> A byte of the block
      pure integer(int64) function byte(j)
         integer, intent(in) :: j

         byte = int(ichar(text(j:j)), int64)
      end function byte

   end subroutine add_block

   !> A word of 32 bits, rotated to the right
   pure elemental integer(int64) function turned(word, bits)
      integer(int64), intent(in) :: word
      integer, intent(in) :: bits

      turned = iand(ior(shiftr(word, bits), shiftl(word, 32 - bits)), mask)
   end function turned

end module dondolo_sha256
