!> The project's test helper: count what holds, say what does not, fail at the end.
module checks
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   implicit none
   private

   public :: suite, check, check_close, check_text, check_ok, check_error, skip, finish

   integer :: passed = 0, failed = 0, skipped = 0
   character(len=:), allocatable :: current

contains

   !> Begin a suite: its name stands before every failure
   subroutine suite(name)
      !> Name of the suite
      character(len=*), intent(in) :: name

      current = name
   end subroutine suite

   !> A statement that must hold
   subroutine check(holds, what)
      !> The statement
      logical, intent(in) :: holds
      !> What it says
      character(len=*), intent(in) :: what

      if (holds) then
         passed = passed + 1
      else
         failed = failed + 1
         print '(a)', 'FAILED  '//current//': '//what
      end if
   end subroutine check

   !> |actual - expected| <= rtol |expected| + atol
   subroutine check_close(actual, expected, rtol, what, atol)
      !> What was computed
      real(wp), intent(in) :: actual
      !> What it should be
      real(wp), intent(in) :: expected
      !> Relative tolerance
      real(wp), intent(in) :: rtol
      !> What it is
      character(len=*), intent(in) :: what
      !> Absolute tolerance, 0 if absent
      real(wp), intent(in), optional :: atol

      real(wp) :: allowed

      allowed = rtol*abs(expected)
      if (present(atol)) allowed = allowed + atol
      call check(abs(actual - expected) <= allowed, what//' is '//to_text(actual)//', should be '//to_text(expected))
   end subroutine check_close

   !> Two equal texts
   subroutine check_text(actual, expected, what)
      !> What was computed
      character(len=*), intent(in) :: actual
      !> What it should be
      character(len=*), intent(in) :: expected
      !> What it is
      character(len=*), intent(in) :: what

      call check(actual == expected, what//' is "'//actual//'", should be "'//expected//'"')
   end subroutine check_text

   !> No error
   subroutine check_ok(error, what)
      !> The error that should not be
      type(error_type), allocatable, intent(in) :: error
      !> What was done
      character(len=*), intent(in) :: what

      if (allocated(error)) then
         call check(.false., what//': '//error%message)
      else
         call check(.true., what)
      end if
   end subroutine check_ok

   !> An error whose sentence holds a given part
   subroutine check_error(error, part, what)
      !> The error that should be
      type(error_type), allocatable, intent(in) :: error
      !> Part of its sentence
      character(len=*), intent(in) :: part
      !> What was done
      character(len=*), intent(in) :: what

      if (.not. allocated(error)) then
         call check(.false., what//': no error, should say "'//part//'"')
      else
         call check(index(error%message, part) > 0, what//': "'//error%message//'", should say "'//part//'"')
      end if
   end subroutine check_error

   !> Say that something could not be tested, and why
   subroutine skip(why)
      !> Reason
      character(len=*), intent(in) :: why

      skipped = skipped + 1
      print '(a)', 'SKIPPED '//current//': '//why
   end subroutine skip

   !> Close the program: the counts, and a failure for the caller if anything failed
   subroutine finish()
      character(len=80) :: line

      write (line, '(i0, a, i0, a, i0, a)') passed, ' passed, ', failed, ' failed, ', skipped, ' skipped'
      print '(a)', trim(line)
      if (failed > 0) error stop 1
   end subroutine finish

end module checks
