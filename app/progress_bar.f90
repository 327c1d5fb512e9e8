!> How far the work is, on one line of the terminal.
module dondolo_progress_bar
   use, intrinsic :: iso_fortran_env, only : error_unit, int64
   implicit none
   private

   public :: start_progress, show_progress, erase_progress, duration

   !> Seconds between two showings
   real, parameter :: pause = 0.1

   !> Clock and histories done when the first were heard of, and when the line was last shown: a callback of the library
   !> carries no data of its own
   integer(int64) :: clock_start = 0, clock_shown = 0
   integer :: done_start = -1

contains

   !> Start the clock
   subroutine start_progress()

      call system_clock(clock_shown)
      done_start = -1
   end subroutine start_progress

   !> Show how far the work is
   subroutine show_progress(done, total)
      !> Histories computed
      integer, intent(in) :: done
      !> Histories in all
      integer, intent(in) :: total

      integer, parameter :: width = 30
      integer(int64) :: now, rate
      character(len=120) :: text
      character(len=:), allocatable :: left
      integer :: filled
      real :: elapsed

      call system_clock(now, rate)
      ! What an earlier run has left took this one no time.
      if (done_start < 0) then
         done_start = done
         clock_start = now
      end if
      if (real(now - clock_shown) < pause*real(rate)) return
      clock_shown = now
      filled = int(real(width)*(real(done)/real(max(total, 1))))
      elapsed = real(now - clock_start)/real(rate)
      left = ''
      if (done > done_start) left = ', '// &
         & trim(duration(elapsed*(real(total - done)/real(done - done_start))))//' left'
      write (text, '(a, i3, a, i0, a, i0, a)') '['//repeat('#', filled)//repeat('.', width - filled)//'] ', &
         & int(100.0*(real(done)/real(max(total, 1)))), ' %  ', done, ' of ', total, ' histories'//left
      write (error_unit, '(a)', advance='no') achar(13)//trim(text)//achar(27)//'[K'
      flush (error_unit)
   end subroutine show_progress

   !> A duration as a person says it
   pure function duration(seconds) result(text)
      !> Duration [s]
      real, intent(in) :: seconds
      !> Its text, filled up with blanks
      character(len=24) :: text

      integer :: minutes

      minutes = nint(min(seconds, 1.0e8)/60.0)
      if (seconds < 100.0) then
         write (text, '(i0, a)') nint(seconds), ' s'
      else if (minutes < 100) then
         write (text, '(i0, a)') minutes, ' min'
      else
         write (text, '(i0, a, i0, a)') minutes/60, ' h ', modulo(minutes, 60), ' min'
      end if
   end function duration

   !> Leave the line empty
   subroutine erase_progress()

      write (error_unit, '(a)', advance='no') achar(13)//achar(27)//'[K'
      flush (error_unit)
   end subroutine erase_progress

end module dondolo_progress_bar
