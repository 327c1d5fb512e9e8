!> Printed digits: which decimals the samples of a record are, and a record that would be printed by the same.
!>
!> A sample that was read from a file is the double next to a decimal number of few digits, times the unit of the file. The
!> decimals are found again from the doubles: in m/s2 or one of its decimal parts, or in g, every sample of a file has at most
!> twelve digits, while of samples that were computed next to none has. Zeros at the end of a number are not seen in one sample,
!> but all samples of a file are printed alike: either to one decimal place or to one number of digits.
module dondolo_record_printed_digits
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_kinds, only : wp
   use dondolo_base_unit_hint, only : standard_gravity
   use dondolo_record, only : record_type
   use dondolo_record_random, only : split_mix
   implicit none
   private

   public :: printed_type, find_printed, move_within_rounding

   !> Digits that no file has so few or so many of: a pulse of 1, 0 and -1 is no print, and doubles have less than sixteen
   integer, parameter :: fewest_digits = 3, most_digits = 12

   !> By how much a sample may be off from a decimal: roundings of two conversions [relative]
   real(wp), parameter :: slack = 16.0_wp*epsilon(1.0_wp)

   !> Units of files but for powers of ten [m/s2]
   real(wp), parameter :: units(2) = [1.0_wp, standard_gravity]

   !> How samples are printed
   type :: printed_type
      !> Unit of the numbers but for a power of ten [m/s2]; 0: they are no decimals of few digits
      real(wp) :: unit = 0.0_wp
      !> Most digits of a number, from the first that is not 0
      integer :: digits = 0
      !> Power of ten of the last decimal place of any number
      integer :: finest = 0
   contains
      !> Is it known how the samples are printed?
      procedure :: is_known
   end type printed_type

contains

   !> Find how samples are printed
   pure subroutine find_printed(samples, printed)
      !> Samples [m/s2]
      real(wp), intent(in) :: samples(:)
      type(printed_type), intent(out) :: printed

      type(printed_type) :: one
      integer :: i, k, leading, digits

      ! A few digits of g are more digits of m/s2, and the other way round: the fewest are those of the file.
      do k = 1, size(units)
         one = printed_type(units(k), 0, huge(0))
         do i = 1, size(samples)
            if (.not. abs(samples(i)) > 0.0_wp) cycle
            call find_digits(abs(samples(i))/units(k), leading, digits)
            if (digits > most_digits) exit
            one%digits = max(one%digits, digits)
            one%finest = min(one%finest, leading - digits + 1)
         end do
         if (i <= size(samples) .or. one%digits < fewest_digits) cycle
         if (.not. printed%is_known() .or. one%digits < printed%digits) printed = one
      end do
   end subroutine find_printed

   !> Is it known how the samples are printed?
   elemental logical function is_known(self)
      class(printed_type), intent(in) :: self

      is_known = self%unit > 0.0_wp
   end function is_known

   !> A record that would be printed by the same digits: each of its samples, and those of its vertical component, moved at random
   !> within half a unit of the last digit
   subroutine move_within_rounding(record, moved, is_known)
      type(record_type), intent(in) :: record
      type(record_type), intent(out) :: moved
      !> Is it known how it is printed? Otherwise it is not moved
      logical, intent(out) :: is_known

      type(printed_type) :: printed, vertical

      moved = record
      call find_printed(record%acceleration, printed)
      is_known = printed%is_known()
      if (.not. is_known) return
      if (allocated(record%vertical)) then
         call find_printed(record%vertical, vertical)
         is_known = vertical%is_known()
         if (.not. is_known) return
         call move_samples(moved%vertical, vertical)
      end if
      call move_samples(moved%acceleration, printed)
   end subroutine move_within_rounding

   !> Move samples at random within half a unit of their last digit
   pure subroutine move_samples(samples, printed)
      !> Samples [m/s2]
      real(wp), intent(inout) :: samples(:)
      type(printed_type), intent(in) :: printed

      integer(int64) :: state, word
      integer :: i, leading, digits, last

      ! The numbers of a record follow from itself, not from its place among others.
      state = ieor(transfer(maxval(abs(samples)), state), int(size(samples), int64))
      do i = 1, size(samples)
         last = printed%finest
         if (abs(samples(i)) > 0.0_wp) then
            call find_digits(abs(samples(i))/printed%unit, leading, digits)
            last = max(last, leading - printed%digits + 1)
         end if
         call split_mix(state, word)
         samples(i) = samples(i) + printed%unit*times_ten(1.0_wp, last)*(real(ishft(word, -11), wp)*2.0_wp**(-53) - 0.5_wp)
      end do
   end subroutine move_samples

   !> Find the fewest digits of a decimal that a number is
   pure subroutine find_digits(number, leading, digits)
      !> Positive number
      real(wp), intent(in) :: number
      !> Power of ten of its first digit
      integer, intent(out) :: leading
      !> Digits from the first to the last that is not 0; more than `most_digits` if it has more
      integer, intent(out) :: digits

      real(wp) :: shifted

      ! A logarithm may be rounded to either side of a whole number.
      leading = floor(log10(number))
      if (times_ten(number, -leading) < 1.0_wp) leading = leading - 1
      if (times_ten(number, -leading) >= 10.0_wp) leading = leading + 1
      do digits = 1, most_digits
         shifted = times_ten(number, digits - 1 - leading)
         if (abs(shifted - anint(shifted)) <= slack*shifted) return
      end do
   end subroutine find_digits

   !> A number times a power of ten
   elemental real(wp) function times_ten(number, power)
      real(wp), intent(in) :: number
      integer, intent(in) :: power

      if (power >= 0) then
         times_ten = number*10.0_wp**power
      else
         times_ten = number/10.0_wp**(-power)
      end if
   end function times_ten

end module dondolo_record_printed_digits
