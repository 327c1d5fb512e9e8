!> Tests of numbers as text: what arithmetic finds is what formatted output and input say, for numbers of all sizes, and
!> above all where rounding is close: next to powers of ten and of two, and at ties.
program test_decimals
   use, intrinsic :: iso_fortran_env, only : int64
   use checks, only : check, check_text, finish, skip, suite
   use dondolo_base_decimals, only : make_figures
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : brief, rounded, to_table, to_text
   implicit none

   integer, parameter :: kinds = 8

   call test_edges()
   if (precision(1.0_wp) > 17) then
      call skip('random numbers are those of double precision')
   else
      call test_random(40000)
   end if
   call finish()

contains

   !> Numbers that are written as nobody expects
   subroutine test_edges()
      character(len=4) :: figures
      integer :: exponent

      call suite('decimals')
      call make_figures(0.0_wp, figures, exponent)
      call check(figures == '0000' .and. exponent == 0, 'zero is zero')
      call make_figures(-9999.6_wp, figures, exponent)
      call check(figures == '1000' .and. exponent == 4, 'a number next to a power of ten takes its exponent')
      call make_figures(0.00012345_wp, figures, exponent)
      call check(figures == '1234' .and. exponent == -4, 'a number below a tie is rounded down')
      call make_figures(0.125_wp, figures(:2), exponent)
      call check(figures(:2) == '12' .and. exponent == -1, 'a tie is rounded to even')
      call check_text(to_text(-0.0625_wp**4), '-1.52587890625e-5', 'a power of two')
      call check_text(to_table(-1.0_wp/3.0_wp), merge('-3.3333333333333331E-01                   ', &
         & '-3.33333333333333333333333333333333317E-01', precision(1.0_wp) < 18), 'a third in a table')
      call check_text(to_table(-1.5e-150_wp), merge('-1.5000000000000001E-150                    ', &
         & '-1.50000000000000000000000000000000005E-0150', precision(1.0_wp) < 18), 'an exponent of three digits')
      call check_text(rounded(99.996_wp), '100', 'rounded up to another power of ten')
      call check_text(rounded(-2.0_wp/3.0e7_wp), '-6.667e-8', 'a small number')
      call check(rounded(huge(1.0_wp)) == to_text(huge(1.0_wp)), 'nothing is above the largest number')
      call check_text(to_table(0.0_wp/draw_zero()), 'NaN', 'no number in a table')
      call check_text(rounded(-1.0_wp/draw_zero()), '-Infinity', 'less than all numbers')
   end subroutine test_edges

   !> Zero, which no compiler sees
   real(wp) function draw_zero()
      character(len=1) :: text

      text = '0'
      read (text, *) draw_zero
   end function draw_zero

   !> Random numbers of several kinds
   subroutine test_random(number)
      !> How many of each
      integer, intent(in) :: number

      real(wp) :: value, draws(3)
      integer :: wrong(4), i, kind

      call suite('random decimals')
      do kind = 1, kinds
         wrong = 0
         do i = 1, number
            call random_number(draws)
            value = drawn(kind, draws)
            if (to_table(value) /= formatted(value)) wrong(1) = wrong(1) + 1
            if (.not. is_shortest(to_text(value), value)) wrong(2) = wrong(2) + 1
            if (rounded(value) /= to_text(read_back(value, '(es24.3e4)'))) wrong(3) = wrong(3) + 1
            if (brief(value) /= to_text(read_back(value, '(es24.7e4)'))) wrong(4) = wrong(4) + 1
         end do
         call check(wrong(1) == 0, to_text(wrong(1))//' numbers of kind '//to_text(kind)//' are others in tables')
         call check(wrong(2) == 0, to_text(wrong(2))//' numbers of kind '//to_text(kind)//' are not the shortest')
         call check(wrong(3) == 0, to_text(wrong(3))//' numbers of kind '//to_text(kind)//' have four other digits')
         call check(wrong(4) == 0, to_text(wrong(4))//' numbers of kind '//to_text(kind)//' have eight other digits')
      end do
   end subroutine test_random

   !> A number
   real(wp) function drawn(kind, draws)
      !> Its kind, 1 to kinds
      integer, intent(in) :: kind
      !> Random numbers in 0 to 1
      real(wp), intent(in) :: draws(3)

      associate (a => draws(1), b => draws(2), c => draws(3))
         select case (kind)
         case (1)
            drawn = (a - 0.5_wp)*10.0_wp**(12.0_wp*b - 8.0_wp)
         case (2)
            drawn = (a - 0.5_wp)*10.0_wp**(220.0_wp*b - 110.0_wp)
         case (3)
            ! Next to powers of two
            drawn = 2.0_wp**int(300.0_wp*b - 150.0_wp)*(1.0_wp + real(int(5.0_wp*a) - 2, wp)*epsilon(a))
         case (4)
            ! Next to powers of ten
            drawn = 10.0_wp**int(60.0_wp*b - 30.0_wp)*(1.0_wp + real(int(9.0_wp*a) - 4, wp)*epsilon(a))
         case (5)
            ! Ties
            drawn = anint(1.0e5_wp*a)*0.5_wp**int(30.0_wp*b)
         case (6)
            ! Any bits but those of huge numbers
            drawn = transfer(int(real(int(z'7fa0000000000000', int64), wp)*a, int64), drawn)
         case (7)
            ! Few decimals
            drawn = anint(1.0e8_wp*a)/10.0_wp**int(20.0_wp*b)
         case default
            ! Nines
            drawn = (10.0_wp - 10.0_wp**(-int(18.0_wp*a)))*10.0_wp**int(30.0_wp*c - 15.0_wp)
         end select
      end associate
   end function drawn

   !> A number as a WRITE has it in tables
   function formatted(value) result(text)
      !> Number
      real(wp), intent(in) :: value
      !> Its text
      character(len=:), allocatable :: text

      character(len=32) :: buffer

      if (abs(value) <= 0.0_wp .or. (abs(value) >= 1.0e-99_wp .and. abs(value) < 1.0e99_wp)) then
         write (buffer, '(es24.16e2)') value
      else
         write (buffer, '(es25.16e3)') value
      end if
      text = trim(adjustl(buffer))
   end function formatted

   !> The number that a format makes of a number
   real(wp) function read_back(value, format)
      !> Number
      real(wp), intent(in) :: value
      !> Format
      character(len=*), intent(in) :: format

      character(len=32) :: buffer

      write (buffer, format) value
      read (buffer, *) read_back
   end function read_back

   !> Does a text read back as a number, and has it no more digits than that needs?
   logical function is_shortest(text, value)
      !> Text
      character(len=*), intent(in) :: text
      !> Number
      real(wp), intent(in) :: value

      character(len=32) :: buffer, format
      real(wp) :: again, shorter
      integer :: digits, mark

      read (text, *) again
      is_shortest = again == value
      mark = scan(text//'e', 'e')
      ! Leading zeros, and those at the end of a whole number, are no digits of it.
      call count_digits(text(:mark - 1), digits)
      if (digits <= precision(value)) return
      write (format, '(a, i0, a)') '(es32.', digits - 2, 'e4)'
      write (buffer, format) value
      read (buffer, *) shorter
      is_shortest = is_shortest .and. shorter /= value
   end function is_shortest

   !> Significant digits of a plain decimal
   subroutine count_digits(text, digits)
      !> Decimal
      character(len=*), intent(in) :: text
      !> How many
      integer, intent(out) :: digits

      integer :: i, zeros

      digits = 0
      zeros = 0
      do i = 1, len(text)
         if (index('0123456789', text(i:i)) == 0) cycle
         if (text(i:i) == '0') then
            if (digits > 0) zeros = zeros + 1
         else
            digits = digits + zeros + 1
            zeros = 0
         end if
      end do
   end subroutine count_digits

end program test_decimals
