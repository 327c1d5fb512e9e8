!> Significant digits of numbers, rounded correctly, by arithmetic: a WRITE takes six times as long, so that tables of many
!> histories would take longer to write than to compute.
!>
!> A number in double precision, times a power of ten, is known to 112 bits in real128, and 17 digits are 57 of them. Cases
!> that these do not decide, such as ties, are left to a WRITE, and so are numbers with three digits in their exponent.
module dondolo_base_decimals
   use, intrinsic :: iso_fortran_env, only : int64, real128
   use dondolo_base_kinds, only : dp, wp
   implicit none
   private

   public :: make_figures, make_shortest, rounded_to, put_digits, is_short

   integer, parameter :: qp = real128

   !> Digits that arithmetic finds at most
   integer, parameter :: most_digits = 17

   !> Numbers between these have exponents of two digits, and the powers of ten that these need
   real(wp), parameter :: smallest = 1.0e-99_wp, beyond = 1.0e99_wp
   integer, parameter :: largest_power = 99 + most_digits
   integer :: k
   real(qp), parameter :: powers(0:largest_power) = [(10.0_qp**k, k=0, largest_power)]

   !> Powers of ten up to this one are exact in double precision
   integer, parameter :: exact_power = 22

   !> More than any error here, in units of the last digit or bit that counts
   real(qp), parameter :: doubt = 1.0e-12_qp

contains

   !> Are two digits enough for the exponent of a number?
   pure logical function is_short(value)
      !> Number
      real(wp), intent(in) :: value

      is_short = value == 0.0_wp .or. (abs(value) > smallest .and. abs(value) < beyond)
   end function is_short

   !> The significant digits of a number
   pure subroutine make_figures(value, figures, exponent)
      !> Number, finite
      real(wp), intent(in) :: value
      !> As many digits as there is room for
      character(len=*), intent(out) :: figures
      !> Power of ten of the first of them
      integer, intent(out) :: exponent

      integer(int64) :: whole
      logical :: is_sure

      call make_digits(value, len(figures), whole, exponent, is_sure)
      if (is_sure) then
         call put_digits(whole, figures)
      else
         call write_figures(value, figures, exponent)
      end if
   end subroutine make_figures

   !> Few digits that read back as a number: the nearest 15, 16 or 17 of real64; zeros may stand at their end
   pure subroutine make_shortest(value, figures, exponent)
      !> Number, finite
      real(wp), intent(in) :: value
      !> Digits; blanks after them
      character(len=*), intent(out) :: figures
      !> Power of ten of the first of them
      integer, intent(out) :: exponent

      character(len=48) :: buffer
      integer(int64) :: whole
      real(wp) :: again
      integer :: digits, stat
      logical :: is_sure, is_nearest

      do digits = precision(value), precision(value) + 2
         call make_digits(value, digits, whole, exponent, is_sure)
         if (is_sure) call see_nearest(value, digits, whole, exponent, is_nearest, is_sure)
         if (.not. is_sure) exit
         if (.not. is_nearest) cycle
         call put_digits(whole, figures(:digits))
         figures(digits + 1:) = ''
         return
      end do
      do digits = precision(value), precision(value) + 3
         figures = ''
         call write_figures(value, figures(:digits), exponent)
         write (buffer, '(a, ''E'', i0)') figures(:digits), exponent - digits + 1
         read (buffer, *, iostat=stat) again
         if (stat == 0 .and. again == abs(value)) exit
      end do
   end subroutine make_shortest

   !> The number that is nearest to some significant digits of another
   pure real(wp) function rounded_to(value, digits) result(nearest)
      !> Number; one that is not finite stays as it is
      real(wp), intent(in) :: value
      !> How many digits, at most 15
      integer, intent(in) :: digits

      character(len=48) :: buffer
      character(len=16) :: figures
      integer(int64) :: whole
      integer :: exponent, stat
      logical :: is_sure

      nearest = value
      if (.not. abs(value) <= huge(value)) return
      call make_digits(value, digits, whole, exponent, is_sure)
      associate (power => exponent - digits + 1)
         if (is_sure .and. abs(power) <= exact_power) then
            ! One operation with exact numbers
            nearest = real(whole, wp)
            if (power >= 0) nearest = nearest*real(powers(power), wp)
            if (power < 0) nearest = nearest/real(powers(-power), wp)
         else
            call make_figures(value, figures(:digits), exponent)
            write (buffer, '(a, ''E'', i0)') figures(:digits), exponent - digits + 1
            read (buffer, *, iostat=stat) nearest
            ! Up from the largest number there is none.
            if (stat /= 0 .or. nearest > huge(nearest)) nearest = abs(value)
         end if
      end associate
      nearest = sign(nearest, value)
   end function rounded_to

   !> The significant digits of a number, by a WRITE
   pure subroutine write_figures(value, figures, exponent)
      !> Number, finite
      real(wp), intent(in) :: value
      !> As many digits as there is room for
      character(len=*), intent(out) :: figures
      !> Power of ten of the first of them
      integer, intent(out) :: exponent

      character(len=48) :: buffer
      character(len=16) :: format
      integer :: mark

      write (format, '(a, i0, a)') '(es48.', len(figures) - 1, 'e4)'
      write (buffer, format) abs(value)
      buffer = adjustl(buffer)
      mark = index(buffer, 'E')
      figures = buffer(1:1)//buffer(3:mark - 1)
      read (buffer(mark + 1:), *) exponent
   end subroutine write_figures

   !> The significant digits of a number, by arithmetic
   pure subroutine make_digits(value, digits, whole, exponent, is_sure)
      !> Number
      real(wp), intent(in) :: value
      !> How many digits, at most most_digits
      integer, intent(in) :: digits
      !> The digits, without the sign
      integer(int64), intent(out) :: whole
      !> Power of ten of the first of them
      integer, intent(out) :: exponent
      !> Are they sure? Else they are not found
      logical, intent(out) :: is_sure

      real(qp) :: scaled
      integer :: attempt

      whole = 0
      exponent = 0
      is_sure = abs(value) <= 0.0_wp
      if (is_sure .or. .not. is_short(value) .or. precision(value) > precision(1.0_dp)) return
      exponent = floor(log10(abs(value)))
      ! Next to a power of ten the logarithm may be one off.
      do attempt = 1, 2
         scaled = times_power(abs(real(value, qp)), digits - 1 - exponent)
         whole = int(scaled, int64)
         if (whole < 10_int64**(digits - 1)) then
            exponent = exponent - 1
            cycle
         end if
         scaled = scaled - real(whole, qp)
         if (scaled > 0.5_qp) whole = whole + 1
         is_sure = whole < 10_int64**digits .and. abs(scaled - 0.5_qp) > doubt
         if (is_sure) return
         exponent = exponent + 1
      end do
   end subroutine make_digits

   !> Is a number the one nearest to its digits?
   pure subroutine see_nearest(value, digits, whole, exponent, is_nearest, is_sure)
      !> Number, and what make_digits has found, for sure
      real(wp), intent(in) :: value
      integer, intent(in) :: digits
      integer(int64), intent(in) :: whole
      integer, intent(in) :: exponent
      !> Is it?
      logical, intent(out) :: is_nearest
      !> Is that sure?
      logical, intent(out) :: is_sure

      real(qp) :: off

      off = abs(times_power(real(whole, qp), exponent - digits + 1) - abs(real(value, qp)))/spacing(value)
      is_nearest = off < 0.5_qp
      is_sure = abs(off - 0.5_qp) > doubt
      ! Below a power of two numbers are twice as dense.
      if (fraction(abs(value)) <= 0.5_wp) is_sure = is_sure .and. (off < 0.25_qp - doubt .or. .not. is_nearest)
   end subroutine see_nearest

   !> A number times a power of ten
   pure real(qp) function times_power(number, power)
      real(qp), intent(in) :: number
      !> Power, positive or not
      integer, intent(in) :: power

      if (power >= 0) then
         times_power = number*powers(power)
      else
         times_power = number/powers(-power)
      end if
   end function times_power

   !> Fill a text with the digits of a whole number
   pure subroutine put_digits(whole, text)
      !> Number, positive or 0
      integer(int64), intent(in) :: whole
      !> Its digits, zeros before them
      character(len=*), intent(out) :: text

      integer(int64) :: left, tenth
      integer :: i

      left = whole
      do i = len(text), 1, -1
         tenth = left/10
         text(i:i) = achar(iachar('0') + int(left - 10*tenth))
         left = tenth
      end do
   end subroutine put_digits

end module dondolo_base_decimals
