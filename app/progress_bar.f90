!> How far the work is, on one line of the terminal.
module dondolo_progress_bar
   use, intrinsic :: iso_fortran_env, only : error_unit, int64
   implicit none
   private

   public :: start_progress, show_progress, erase_progress

   !> Seconds between two showings
   real, parameter :: pause = 0.1

   !> Clock at the start, and when the line was last shown: a callback of the library carries no data of its own
   integer(int64), save :: clock_start = 0, clock_shown = 0

contains

   !> Start the clock
   subroutine start_progress()

      call system_clock(clock_start)
      clock_shown = clock_start
   end subroutine start_progress

   !> Show how far the work is
   subroutine show_progress(done, total)
      !> Histories computed
      integer, intent(in) :: done
      !> Histories in all
      integer, intent(in) :: total

      integer, parameter :: width = 30
      integer(int64) :: now, rate
      character(len=100) :: text
      integer :: filled
      real :: share, elapsed

      call system_clock(now, rate)
      if (real(now - clock_shown) < pause*real(rate)) return
      clock_shown = now
      share = real(done)/real(max(total, 1))
      filled = nint(share*width)
      elapsed = real(now - clock_start)/real(rate)
      write (text, '(a, i3, a, i0, a, i0, a, i0, a)') '['//repeat('#', filled)//repeat('.', width - filled)//'] ', &
         & int(100.0*share), ' %  ', done, ' of ', total, ' histories, ', &
         & nint(elapsed*(1.0 - share)/max(share, tiny(share))), ' s left'
      write (error_unit, '(a)', advance='no') achar(13)//trim(text)//achar(27)//'[K'
      flush (error_unit)
   end subroutine show_progress

   !> Leave the line empty
   subroutine erase_progress()

      write (error_unit, '(a)', advance='no') achar(13)//achar(27)//'[K'
      flush (error_unit)
   end subroutine erase_progress

end module dondolo_progress_bar
