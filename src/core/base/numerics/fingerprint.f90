!> Fingerprint of data: two runs that have the same one began with the same input.
!>
!> Two polynomials in the data, modulo primes of 31 bits: different data have the same fingerprint once in 4e18 times.
!> It is to notice a mistake, not an attack.
module dondolo_base_fingerprint
   use, intrinsic :: iso_fortran_env, only : int32, int64
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: fingerprint_type

   !> Moduli, the largest primes below 2^31, and a base for each
   integer(int64), parameter :: prime(2) = [2147483647_int64, 2147483629_int64]
   integer(int64), parameter :: base(2) = [1103515245_int64, 1597334677_int64]

   !> Fingerprint of what was added
   type :: fingerprint_type
      !> Values of the polynomials
      integer(int64) :: value(2) = [1_int64, 2_int64]
   contains
      !> Add an integer
      procedure :: add_integer
      !> Add reals
      procedure :: add_reals
      !> Add a text
      procedure :: add_text
      !> The fingerprint as a text
      procedure :: text
   end type fingerprint_type

contains

   !> Add an integer
   pure subroutine add_integer(self, number)
      class(fingerprint_type), intent(inout) :: self
      !> The integer
      integer(int32), intent(in) :: number

      self%value = modulo(self%value*base + modulo(int(number, int64), prime) + 1_int64, prime)
   end subroutine add_integer

   !> Add reals, bit by bit
   pure subroutine add_reals(self, numbers)
      class(fingerprint_type), intent(inout) :: self
      !> The reals
      real(wp), intent(in) :: numbers(:)

      integer(int32) :: words(storage_size(1.0_wp)/32)
      integer :: i, k

      call self%add_integer(size(numbers, kind=int32))
      do i = 1, size(numbers)
         words = transfer(numbers(i), words)
         do k = 1, size(words)
            call self%add_integer(words(k))
         end do
      end do
   end subroutine add_reals

   !> Add a text, four characters at a time
   pure subroutine add_text(self, text)
      class(fingerprint_type), intent(inout) :: self
      !> The text
      character(len=*), intent(in) :: text

      integer, parameter :: bytes = 4
      character(len=bytes) :: rest
      integer :: i, whole

      call self%add_integer(len(text, kind=int32))
      whole = len(text) - modulo(len(text), bytes)
      do i = 1, whole, bytes
         call self%add_integer(transfer(text(i:i + bytes - 1), 0_int32))
      end do
      if (whole == len(text)) return
      rest = text(whole + 1:)
      call self%add_integer(transfer(rest, 0_int32))
   end subroutine add_text

   !> The fingerprint as a text of 16 hexadecimal digits
   pure function text(self)
      class(fingerprint_type), intent(in) :: self
      !> Its text
      character(len=16) :: text

      write (text, '(2z8.8)') self%value
   end function text

end module dondolo_base_fingerprint
