!> Numbers out of text, strictly: the whole text is one number, or it is refused.
!>
!> Fortran's own list-directed READ takes '3*1.0', '1/' and '1,5' for numbers; here the characters are checked first.
module dondolo_base_numbers
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: parse_real, parse_printed, parse_integer, take_real, take_column

   !> Powers of ten that are exact in real64, hence in every working precision
   real(wp), parameter :: power(0:22) = [1e0_wp, 1e1_wp, 1e2_wp, 1e3_wp, 1e4_wp, 1e5_wp, 1e6_wp, 1e7_wp, &
      & 1e8_wp, 1e9_wp, 1e10_wp, 1e11_wp, 1e12_wp, 1e13_wp, 1e14_wp, 1e15_wp, 1e16_wp, 1e17_wp, 1e18_wp, &
      & 1e19_wp, 1e20_wp, 1e21_wp, 1e22_wp]

   !> Largest integer up to which all integers are exact in real64
   integer(int64), parameter :: largest_exact = 9007199254740992_int64

   !> Below these one more digit, and eight more, surely fit a 64-bit integer
   integer(int64), parameter :: room_for_digit = 100000000000000000_int64, room_for_eight = 10000000000_int64

   !> Does the first character of a text become the lowest byte of an integer?
   logical, parameter :: first_is_lowest = transfer(1_int64, 'a') == achar(1)

   !> Codes of characters between numbers
   integer, parameter :: blank = iachar(' '), tab = 9, line_feed = 10, return = 13

   !> Exponents beyond this overflow or underflow in any precision
   integer, parameter :: largest_exponent = 99999

contains

   !> Read a decimal number, blanks around it allowed
   pure subroutine parse_real(text, value, ok)
      !> Text
      character(len=*), intent(in) :: text
      !> Its number, 0 unless ok
      real(wp), intent(out) :: value
      !> The text is one finite number
      logical, intent(out) :: ok

      integer :: at, last

      call inner(text, at, last)
      call take_real(text, at, last, value, ok)
      if (.not. ok .or. at > last) return
      ok = .false.
      value = 0.0_wp
   end subroutine parse_real

   !> Read a decimal number as Fortran prints it: an exponent of three digits may lack its letter, as in 0.1000000-104
   pure subroutine parse_printed(text, value, ok)
      !> Text
      character(len=*), intent(in) :: text
      !> Its number, 0 unless ok
      real(wp), intent(out) :: value
      !> The text is one finite number
      logical, intent(out) :: ok

      integer :: first, last, sign

      call parse_real(text, value, ok)
      if (ok) return
      call inner(text, first, last)
      sign = last - 3
      if (sign <= first) return
      if (scan(text(sign:sign), '+-') == 0 .or. verify(text(sign + 1:last), '0123456789') > 0) return
      ! Only after a mantissa with a point, for a date or two integers have none
      if (index(text(first:sign - 1), '.') == 0 .or. verify(text(first:sign - 1), '+-.0123456789') > 0) return
      call parse_real(text(first:sign - 1)//'E'//text(sign:last), value, ok)
   end subroutine parse_printed

   !> Take a decimal number: [sign] digits [. digits] [e|d [sign] digits]
   !>
   !> Up to 2**53 units times or over an exact power of ten, one multiplication or division rounds correctly
   !> (Clinger 1990, How to read floating point numbers accurately); all else goes to the compiler's READ.
   pure subroutine take_real(text, at, last, value, ok)
      !> Text
      character(len=*), intent(in) :: text
      !> Position: where the number begins, then what follows it
      integer, intent(inout) :: at
      !> Last position to look at
      integer, intent(in) :: last
      !> The number, 0 unless ok
      real(wp), intent(out) :: value
      !> A finite number begins there
      logical, intent(out) :: ok

      integer(int64) :: units, eight
      integer :: first, digits, decimals, exponent, stat
      logical :: exact, minus

      value = 0.0_wp
      ok = .false.
      first = at
      call take_sign(text(:last), at, minus)
      units = 0
      exact = .true.
      digits = 0
      decimals = 0
      call take_digits(text(:last), at, units, exact, digits)
      if (at <= last) then
         if (iachar(text(at:at)) == iachar('.')) then
            at = at + 1
            decimals = digits
            ! Most files have so many decimals
            if (first_is_lowest .and. at + 7 <= last .and. units < room_for_eight) then
               call take_eight(text(at:at + 7), eight, ok)
               if (ok) then
                  units = 100000000_int64*units + eight
                  at = at + 8
                  digits = digits + 8
               end if
               ok = .false.
            end if
            call take_digits(text(:last), at, units, exact, digits)
            decimals = digits - decimals
         end if
      end if
      if (digits == 0) return
      exponent = 0
      if (at <= last) then
         select case (iachar(text(at:at)))
         case (iachar('e'), iachar('E'), iachar('d'), iachar('D'))
            at = at + 1
            call take_whole(text(:last), at, largest_exponent, exponent, ok)
            if (.not. ok) return
         end select
      end if
      ok = .true.
      exponent = exponent - decimals
      if (exact .and. units <= largest_exact .and. abs(exponent) <= ubound(power, 1)) then
         value = real(units, wp)
         if (exponent >= 0) then
            value = value*power(exponent)
         else
            value = value/power(-exponent)
         end if
         if (minus) value = -value
         return
      end if
      read (text(first:at - 1), *, iostat=stat) value
      ok = stat == 0 .and. abs(value) <= huge(value)
      if (.not. ok) value = 0.0_wp
   end subroutine take_real

   !> Take a column of decimal numbers: one a line and nothing else, blanks around it allowed
   pure subroutine take_column(text, values, count, ok)
      !> Lines that end in LF or CRLF, but the last
      character(len=*), intent(in) :: text
      !> The numbers; room for one of every two characters is enough
      real(wp), intent(out) :: values(:)
      !> How many there are before anything else
      integer, intent(out) :: count
      !> The whole text is such a column
      logical, intent(out) :: ok

      integer :: at

      count = 0
      at = 1
      ok = .false.
      do while (at <= len(text))
         ! Further blanks are rare, and a call of the loop takes longer than a number
         if (iachar(text(at:at)) <= blank) call pass_blanks(text, at)
         call take_usual(text, at, values(count + 1), ok)
         if (.not. ok) call take_real(text, at, len(text), values(count + 1), ok)
         if (.not. ok) return
         count = count + 1
         if (at > len(text)) return
         if (iachar(text(at:at)) == blank .or. iachar(text(at:at)) == tab) then
            call pass_blanks(text, at)
            if (at > len(text)) return
         end if
         if (at < len(text) .and. iachar(text(at:at)) == return) at = at + 1
         ok = at < len(text) .and. iachar(text(at:at)) == line_feed
         if (.not. ok) return
         at = at + 1
      end do
   end subroutine take_column

   !> Take a decimal number as most files of records print it, [-] digit . eight digits, before a blank or the end of a
   !> line: the same as `take_real` gives, in a few instructions
   pure subroutine take_usual(text, at, value, ok)
      !> Text
      character(len=*), intent(in) :: text
      !> Position: where the number begins, then what follows it; stays unless ok
      integer, intent(inout) :: at
      !> The number; of no use unless ok
      real(wp), intent(out) :: value
      !> There is one
      logical, intent(out) :: ok

      integer(int64) :: eight
      integer :: first, digit
      logical :: minus

      ok = first_is_lowest .and. at + 11 <= len(text)
      if (.not. ok) return
      minus = iachar(text(at:at)) == iachar('-')
      first = at
      if (minus) first = first + 1
      digit = iachar(text(first:first)) - iachar('0')
      call take_eight(text(first + 2:first + 9), eight, ok)
      ok = ok .and. digit >= 0 .and. digit <= 9 .and. iachar(text(first + 1:first + 1)) == iachar('.') .and. &
         & iachar(text(first + 10:first + 10)) <= blank
      if (.not. ok) return
      at = first + 10
      value = real(100000000_int64*digit + eight, wp)/power(8)
      if (minus) value = -value
   end subroutine take_usual

   !> Read an integer: [sign] digits, blanks around it allowed
   pure subroutine parse_integer(text, value, ok)
      !> Text
      character(len=*), intent(in) :: text
      !> Its number, 0 unless ok
      integer, intent(out) :: value
      !> The text is one integer that fits
      logical, intent(out) :: ok

      integer :: at, last

      call inner(text, at, last)
      call take_whole(text(:last), at, huge(value), value, ok)
      if (at > last) return
      ok = .false.
      value = 0
   end subroutine parse_integer

   !> Bounds of a text without the blanks and tabs around it; last < first if nothing is left
   pure subroutine inner(text, first, last)
      !> Text
      character(len=*), intent(in) :: text
      !> Position of its first character that is no blank
      integer, intent(out) :: first
      !> Position of its last character that is no blank
      integer, intent(out) :: last

      ! Loops, for VERIFY takes longer than all the rest of a number; and codes, for gfortran calls LEN_TRIM to compare a
      ! character with a blank
      do last = len(text), 1, -1
         if (iachar(text(last:last)) /= blank .and. iachar(text(last:last)) /= tab) exit
      end do
      do first = 1, last
         if (iachar(text(first:first)) /= blank .and. iachar(text(first:first)) /= tab) exit
      end do
   end subroutine inner

   !> Go on to what is no blank and no tab
   pure subroutine pass_blanks(text, at)
      !> Text
      character(len=*), intent(in) :: text
      !> Position; beyond the text where nothing but blanks follows
      integer, intent(inout) :: at

      do at = at, len(text)
         if (iachar(text(at:at)) /= blank .and. iachar(text(at:at)) /= tab) exit
      end do
   end subroutine pass_blanks

   !> Add decimal digits to an integer, up to the first other character
   pure subroutine take_digits(text, i, units, exact, digits)
      !> Text
      character(len=*), intent(in) :: text
      !> Position: where to begin, then the first character that is no digit
      integer, intent(inout) :: i
      !> The digits so far, as an integer
      integer(int64), intent(inout) :: units
      !> All digits so far are in `units`
      logical, intent(inout) :: exact
      !> How many digits so far
      integer, intent(inout) :: digits

      integer(int64) :: sum
      integer :: begin, at, digit

      begin = i
      sum = units
      do at = begin, len(text)
         digit = iachar(text(at:at)) - iachar('0')
         if (digit < 0 .or. digit > 9) exit
         if (sum >= room_for_digit) exit
         sum = 10_int64*sum + int(digit, int64)
      end do
      units = sum
      do i = at, len(text)
         digit = iachar(text(i:i)) - iachar('0')
         if (digit < 0 .or. digit > 9) exit
         exact = .false.
      end do
      digits = digits + i - begin
   end subroutine take_digits

   !> Eight digits as an integer, all at once: neighbouring bytes are joined to pairs, pairs to fours, fours to eight
   pure subroutine take_eight(text, value, are_digits)
      !> Eight characters
      character(len=8), intent(in) :: text
      !> The integer; of no use unless they are digits
      integer(int64), intent(out) :: value
      !> Are they digits?
      logical, intent(out) :: are_digits

      ! In each byte: its lower half, the upper half of all digits, and what brings the codes after 9 to the next upper half
      integer(int64), parameter :: low = int(z'0f0f0f0f0f0f0f0f', int64), zeros = int(z'3030303030303030', int64), &
         & beyond = int(z'0606060606060606', int64), pairs = int(z'00ff00ff00ff00ff', int64), &
         & fours = int(z'0000ffff0000ffff', int64), whole = int(z'00000000ffffffff', int64)

      value = transfer(text, value)
      are_digits = iand(value, not(low)) == zeros
      ! Only then the sum cannot overflow
      if (are_digits) are_digits = iand(value + beyond, not(low)) == zeros
      if (.not. are_digits) return
      value = iand(value, low)
      value = iand(10_int64*value + shiftr(value, 8), pairs)
      value = iand(100_int64*value + shiftr(value, 16), fours)
      value = iand(10000_int64*value + shiftr(value, 32), whole)
   end subroutine take_eight

   !> Take [sign] digits
   pure subroutine take_whole(text, at, largest, value, ok)
      !> Text
      character(len=*), intent(in) :: text
      !> Position: where the integer begins, then what follows it
      integer, intent(inout) :: at
      !> Largest absolute value
      integer, intent(in) :: largest
      !> The integer, 0 unless ok
      integer, intent(out) :: value
      !> An integer that is not too large begins there
      logical, intent(out) :: ok

      integer(int64) :: units
      integer :: digits
      logical :: exact, minus

      value = 0
      call take_sign(text, at, minus)
      units = 0
      exact = .true.
      digits = 0
      call take_digits(text, at, units, exact, digits)
      ok = digits > 0 .and. exact .and. units <= largest
      if (ok) value = int(merge(-units, units, minus))
   end subroutine take_whole

   !> Take a sign, if there is one
   pure subroutine take_sign(text, i, minus)
      !> Text
      character(len=*), intent(in) :: text
      !> Position: where a sign may stand, then what follows it
      integer, intent(inout) :: i
      !> It is a minus
      logical, intent(out) :: minus

      minus = .false.
      if (i > len(text)) return
      minus = iachar(text(i:i)) == iachar('-')
      if (minus .or. iachar(text(i:i)) == iachar('+')) i = i + 1
   end subroutine take_sign

end module dondolo_base_numbers
