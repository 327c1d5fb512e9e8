!> Equally spaced levels: one rule for first, last and count of a case and for lists that are equally spaced but for rounding,
!> such as numpy.linspace gives, so that both are the same numbers to the last bit.
module dondolo_fragility_even_levels
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: even_levels, settle_levels

   !> Rounding of an equally spaced list, in units of the last place of its largest number
   real(wp), parameter :: rounding = 16.0_wp

   !> Smallest step of an equally spaced list, in the same units: levels that differ by little more than rounding are as they
   !> were given
   real(wp), parameter :: smallest_step = 1.0e4_wp

   !> Powers of ten up to this one are exact
   integer, parameter :: exact_powers = 22

   !> Distance to the nearest whole number up to which the product's own rounding cannot make it another
   real(wp), parameter :: sure = 0.4_wp

contains

   !> Equally spaced levels, both ends included, each the nearest number of 14 decimal digits: the third of 0.2, 0.4, ... is
   !> 0.6, not 0.6000000000000001
   pure function even_levels(first, last, count) result(levels)
      !> Both ends
      real(wp), intent(in) :: first, last
      !> Number of levels, 2 at least
      integer, intent(in) :: count
      !> The levels; the ends are those that were given
      real(wp) :: levels(count)

      integer :: i

      do i = 1, count
         levels(i) = decimal(between(first, last, count, i))
      end do
      levels(1) = first
      levels(count) = last
   end function even_levels

   !> Give a list that is equally spaced but for rounding the levels of even_levels; any other stays
   pure subroutine settle_levels(levels)
      !> Levels of intensity
      real(wp), intent(inout) :: levels(:)

      real(wp) :: ends(2), limit
      integer :: i, number

      number = size(levels)
      if (number < 3) return
      limit = rounding*spacing(levels(number))
      ! Also excludes NaN and infinity
      if (.not. (levels(1) > 0.0_wp .and. levels(number) > levels(1) .and. levels(number) <= huge(limit))) return
      if (levels(number) - levels(1) < smallest_step*spacing(levels(number))*real(number - 1, wp)) return
      ! Sums of steps, such as numpy.arange gives, miss their end
      ends = decimal(levels([1, number]))
      if (any(abs(ends - levels([1, number])) > limit)) ends = levels([1, number])
      do i = 1, number
         if (.not. abs(levels(i) - between(ends(1), ends(2), number, i)) <= limit) return
      end do
      levels = even_levels(ends(1), ends(2), number)
   end subroutine settle_levels

   !> A level on the line between both ends
   pure real(wp) function between(first, last, count, i)
      !> Both ends
      real(wp), intent(in) :: first, last
      !> Number of levels, and that of the level
      integer, intent(in) :: count, i

      between = (real(count - i, wp)*first + real(i - 1, wp)*last)/real(count - 1, wp)
   end function between

   !> The nearest number of 14 decimal digits
   elemental function decimal(value) result(rounded)
      !> Number
      real(wp), intent(in) :: value
      !> The nearest short one
      real(wp) :: rounded

      character(len=32) :: buffer
      real(wp) :: power, digits
      integer :: places

      if (value > 0.0_wp .and. value <= huge(value)) then
         ! A whole number of 14 digits over a power of ten, both exact, is the nearest number, and found without printing.
         places = 13 - floor(log10(value))
         if (places >= 0 .and. places <= exact_powers) then
            power = 10.0_wp**places
            digits = value*power
            if (abs(digits - anint(digits)) < sure .and. digits > 1.0e13_wp .and. digits < 9.9e13_wp) then
               rounded = anint(digits)/power
               return
            end if
         end if
      end if
      write (buffer, '(es32.13e4)') value
      read (buffer, *) rounded
   end function decimal

end module dondolo_fragility_even_levels
