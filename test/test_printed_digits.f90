!> Tests of printed digits: that they are found from samples, whatever the print, and that a record which is moved within their
!> rounding would be printed alike.
program test_printed_digits
   use checks, only : check, check_close, check_ok, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_record, only : new_record, record_type
   use dondolo_record_printed_digits, only : find_printed, move_within_rounding, printed_type
   implicit none

   integer, parameter :: n = 2000
   real(wp), parameter :: g = 9.80665_wp

   call test_prints()
   call test_unknown()
   call test_moved()
   call finish()

contains

   !> Samples of a motion that grows and decays, of all sizes down to zeros
   pure function motion(size) result(samples)
      !> Largest sample
      real(wp), intent(in) :: size
      real(wp) :: samples(n)

      integer :: i

      samples = [(size*exp(-((i - 700)/300.0_wp)**2)*sin(0.1_wp*i + 1.0e-5_wp*i**2), i=1, n)]
   end function motion

   !> Numbers printed by a format and read again
   function printed_by(format, numbers) result(values)
      character(len=*), intent(in) :: format
      real(wp), intent(in) :: numbers(:)
      real(wp) :: values(size(numbers))

      character(len=40) :: text
      integer :: i

      do i = 1, size(numbers)
         write (text, format) numbers(i)
         read (text, *) values(i)
      end do
   end function printed_by

   !> Decimal places and digits of usual prints
   subroutine test_prints()
      call suite('printed digits')
      call check_print('(f12.5)', 3.0_wp, 1.0_wp, 1.0_wp, -5, 6)
      call check_print('(f10.3)', 300.0_wp, 0.01_wp, 1.0_wp, -5, 6)
      call check_print('(f12.6)', 0.3_wp, g, g, -6, 6)
      call check_print('(es13.5)', 250.0_wp, 0.01_wp, 1.0_wp, -999, 6)
      call check_print('(es14.6)', 0.35_wp, g, g, -999, 7)
      call check_print('(f8.0)', 412.0_wp, 0.01_wp, 1.0_wp, -2, 3)
   end subroutine test_prints

   !> Check what is found of a print, and that no sample leaves it
   subroutine check_print(format, largest, factor, unit, finest, digits)
      !> Format of the numbers, and the largest of them
      character(len=*), intent(in) :: format
      real(wp), intent(in) :: largest
      !> Unit of the file [m/s2]
      real(wp), intent(in) :: factor
      !> What must be found; the last decimal place of a print with one number of digits is that of the smallest number
      real(wp), intent(in) :: unit
      integer, intent(in) :: finest, digits

      type(printed_type) :: printed
      type(record_type) :: record, moved
      type(error_type), allocatable :: error
      real(wp) :: numbers(n), again(n)
      logical :: is_known

      numbers = printed_by(format, motion(largest))
      call find_printed(factor*numbers, printed)
      call check_close(printed%unit, unit, 0.0_wp, 'unit of '//format)
      call check(printed%digits == digits, 'digits of '//format)
      if (finest > -999) call check(printed%finest == finest, 'last place of '//format)
      call new_record(record, factor*numbers, 0.01_wp, 'a', error)
      call check_ok(error, 'a record of '//format)
      call move_within_rounding(record, moved, is_known)
      call check(is_known, 'the print of '//format//' is known')
      again = printed_by(format, moved%acceleration/factor)
      call check(all(abs(again - numbers) <= 1.0e-9_wp*largest), 'moved samples are printed alike by '//format)
      call check(count(abs(moved%acceleration - record%acceleration) > 0.0_wp) > 9*n/10, 'samples of '//format//' are moved')
   end subroutine check_print

   !> Samples that no file has printed, or that are too few digits to say
   subroutine test_unknown()
      type(printed_type) :: printed
      type(record_type) :: record, moved
      type(error_type), allocatable :: error
      logical :: is_known

      call suite('no printed digits')
      call find_printed(motion(3.0_wp), printed)
      call check(.not. printed%is_known(), 'computed samples are not printed')
      call find_printed(3920.0_wp/6182761.0_wp*0.01_wp*anint(motion(1.0e5_wp)), printed)
      call check(.not. printed%is_known(), 'counts times a factor are not printed')
      call find_printed([0.0_wp, 5.0_wp, -5.0_wp, 0.0_wp], printed)
      call check(.not. printed%is_known(), 'a pulse of one digit says nothing')
      call find_printed([0.0_wp, 0.0_wp], printed)
      call check(.not. printed%is_known(), 'nor do zeros')
      call new_record(record, printed_by('(f12.5)', motion(3.0_wp)), 0.01_wp, 'a', error)
      call record%set_vertical(motion(1.0_wp), 0.01_wp, 1.0_wp, error)
      call check_ok(error, 'a vertical component')
      call move_within_rounding(record, moved, is_known)
      call check(.not. is_known .and. all(abs(moved%acceleration - record%acceleration) <= 0.0_wp), &
         & 'a record with a vertical component of unknown print is not moved')
   end subroutine test_unknown

   !> How samples are moved
   subroutine test_moved()
      type(record_type) :: record, moved, again
      type(error_type), allocatable :: error
      real(wp) :: by(n)
      logical :: is_known

      call suite('moved within the rounding')
      call new_record(record, printed_by('(f12.4)', motion(3.0_wp)), 0.01_wp, 'a', error)
      call move_within_rounding(record, moved, is_known)
      call move_within_rounding(record, again, is_known)
      call check(all(abs(again%acceleration - moved%acceleration) <= 0.0_wp), 'always by the same')
      by = (moved%acceleration - record%acceleration)*1.0e4_wp
      call check(maxval(abs(by)) <= 0.5_wp .and. maxval(abs(by)) > 0.49_wp, 'by up to half a unit of the last place')
      ! Uniform: mean 0 and variance 1/12, within five standard errors
      call check_close(sum(by)/n, 0.0_wp, 0.0_wp, 'with mean 0', atol=5.0_wp/sqrt(12.0_wp*n))
      call check_close(sum(by**2)/n, 1.0_wp/12.0_wp, 0.0_wp, 'and the variance of a rounding', atol=5.0_wp/sqrt(180.0_wp*n))
      call check(abs(sum(by(2:)*by(:n - 1)))/n < 5.0_wp/12.0_wp/sqrt(real(n, wp)), 'each by itself')
      call check(abs(sum(by*sign(1.0_wp, record%acceleration)))/n < 5.0_wp/sqrt(12.0_wp*n), 'to either side')
      record%vertical = 0.5_wp*record%acceleration
      call move_within_rounding(record, moved, is_known)
      call check(is_known .and. count(abs(moved%vertical - record%vertical) > 0.0_wp) > 9*n/10, 'the vertical component too')
   end subroutine test_moved

end program test_printed_digits
