!> CRC-32 of files (ISO 3309, as zlib and gzip have it): it says which inputs a result is of.
!>
!> Eight bytes at a time by tables (slicing by 8): the files of a run are read again for it, which must not cost more than
!> a hundredth of a short run. It finds what was changed by mistake, not what was forged; SHA-256 would take thirty times
!> as long.
module dondolo_files_checksum
   use, intrinsic :: iso_fortran_env, only : int32, int64
   use dondolo_base_kinds, only : dp, wp
   use dondolo_files_reader, only : reader_type
   implicit none
   private

   public :: crc32_of_file, crc32_of_reals, crc32_of_text, crc32_length

   !> Length of a checksum in hexadecimal figures
   integer, parameter :: crc32_length = 8

   !> Bytes that are read at once, a multiple of 8
   integer, parameter :: chunk = 65536

   !> The polynomial, its bits reversed: EDB88320, a negative number of 32 bits
   integer(int32), parameter :: polynomial = not(int(z'12477cdf', int32))

contains

   !> Checksum of a file
   subroutine crc32_of_file(path, checksum, bytes, ok, behind)
      !> Path
      character(len=*), intent(in) :: path
      !> Checksum, hexadecimal in lower case
      character(len=crc32_length), intent(out) :: checksum
      !> Length of the file
      integer(int64), intent(out) :: bytes
      !> The file could be read
      logical, intent(out) :: ok
      !> Bytes at its beginning that are left out; none unless given
      integer, intent(in), optional :: behind

      ! Not on the stack, of which there may be little
      character(len=:), allocatable :: part
      type(reader_type) :: reader
      integer(int32) :: table(0:255, 8), crc
      integer(int64) :: at
      integer :: i, count

      checksum = ''
      bytes = -1
      call reader%open(path, ok)
      if (.not. ok) return
      bytes = reader%size()
      allocate (character(len=chunk) :: part)
      call make_tables(table)
      crc = not(0_int32)
      at = 0
      if (present(behind)) at = behind
      count = 0
      ok = at <= bytes
      do while (ok)
         count = int(min(bytes - at, int(chunk, int64)))
         call reader%read(at + 1, part(:count), ok)
         if (.not. ok) exit
         do i = 0, count - 8, 8
            call add_bytes(crc, transfer(part(i + 1:i + 8), 0_int64), table)
         end do
         at = at + count
         if (at == bytes) exit
      end do
      call reader%close()
      if (.not. ok) return
      call add_tail(crc, part(count - mod(count, 8) + 1:count), table)
      checksum = hexadecimal(not(crc))
   end subroutine crc32_of_file

   !> Checksum of the bytes of a text
   pure function crc32_of_text(text) result(checksum)
      character(len=*), intent(in) :: text
      !> Checksum, hexadecimal in lower case
      character(len=crc32_length) :: checksum

      integer(int32) :: table(0:255, 8), crc
      integer :: i

      call make_tables(table)
      crc = not(0_int32)
      do i = 1, len(text) - 7, 8
         call add_bytes(crc, transfer(text(i:i + 7), 0_int64), table)
      end do
      call add_tail(crc, text(i:), table)
      checksum = hexadecimal(not(crc))
   end function crc32_of_text

   !> Checksum of numbers in double precision
   pure function crc32_of_reals(values) result(checksum)
      real(wp), intent(in) :: values(:)
      !> Checksum, hexadecimal in lower case
      character(len=crc32_length) :: checksum

      integer(int32) :: table(0:255, 8), crc
      integer :: i

      call make_tables(table)
      crc = not(0_int32)
      do i = 1, size(values)
         call add_bytes(crc, transfer(real(values(i), dp), 0_int64), table)
      end do
      checksum = hexadecimal(not(crc))
   end function crc32_of_reals

   !> Hexadecimal figures in lower case
   pure function hexadecimal(number) result(text)
      integer(int32), intent(in) :: number
      character(len=crc32_length) :: text

      integer :: i

      write (text, '(z8.8)') number
      do i = 1, len(text)
         if (text(i:i) >= 'A') text(i:i) = achar(iachar(text(i:i)) + 32)
      end do
   end function hexadecimal

   !> Take in what is left, less than eight bytes
   pure subroutine add_tail(crc, tail, table)
      !> Remainder so far
      integer(int32), intent(inout) :: crc
      !> The bytes
      character(len=*), intent(in) :: tail
      !> Tables of make_tables
      integer(int32), intent(in) :: table(0:255, 8)

      integer :: i

      do i = 1, len(tail)
         crc = ieor(table(iand(ieor(crc, int(ichar(tail(i:i)), int32)), 255), 1), shiftr(crc, 8))
      end do
   end subroutine add_tail

   !> Take in eight bytes; the word is little-endian, as those of all processors that dondolo runs on
   pure subroutine add_bytes(crc, word, table)
      !> Remainder so far
      integer(int32), intent(inout) :: crc
      !> Eight bytes
      integer(int64), intent(in) :: word
      !> Tables of make_tables
      integer(int32), intent(in) :: table(0:255, 8)

      integer(int64) :: mixed

      mixed = ieor(word, iand(int(crc, int64), int(z'ffffffff', int64)))
      crc = ieor(ieor(ieor(table(byte(0), 8), table(byte(1), 7)), ieor(table(byte(2), 6), table(byte(3), 5))), &
         & ieor(ieor(table(byte(4), 4), table(byte(5), 3)), ieor(table(byte(6), 2), table(byte(7), 1))))

   contains

      !> A byte of the word
      pure integer function byte(i)
         !> Its place from the lowest
         integer, intent(in) :: i

         byte = int(ibits(mixed, 8*i, 8))
      end function byte

   end subroutine add_bytes

   !> Remainders of each byte, followed by 0 to 7 zero bytes
   pure subroutine make_tables(table)
      !> Remainder of (byte, zero bytes + 1)
      integer(int32), intent(out) :: table(0:255, 8)

      integer(int32) :: crc
      integer :: i, k

      do i = 0, 255
         crc = int(i, int32)
         do k = 1, 8
            crc = ieor(shiftr(crc, 1), iand(polynomial, -iand(crc, 1_int32)))
         end do
         table(i, 1) = crc
      end do
      do k = 2, 8
         do i = 0, 255
            table(i, k) = ieor(shiftr(table(i, k - 1), 8), table(iand(table(i, k - 1), 255), 1))
         end do
      end do
   end subroutine make_tables

end module dondolo_files_checksum
