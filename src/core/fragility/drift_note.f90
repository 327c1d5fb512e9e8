!> Limit of the relative drift of the supports of a wall, and the note of a run on histories that exceed it.
module dondolo_fragility_drift_note
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : rounded, to_text
   use dondolo_motion_work, only : work_type
   implicit none
   private

   public :: largest_drift, make_drift_note, share_of

   !> Drift of the supports, as a part of the capacity rotation, up to which the motion that a wall feels is measured to be good
   real(wp), parameter :: largest_drift = 0.2_wp

contains

   !> Make the sentence
   subroutine make_drift_note(work, line)
      !> Counts of the histories
      type(work_type), intent(in) :: work
      !> The sentence; empty if none drifts as far
      character(len=:), allocatable, intent(out) :: line

      line = ''
      if (work%drifted > 0) line = 'the supports of walls drift apart by more than '//rounded(largest_drift)// &
         & ' of the capacity rotation in '//trim(share_of(work%drifted, work%histories))//' histories, where the motion that '// &
         & 'the wall feels is approximate: beyond the capacity rotation itself the median of a facade with ties may be too high'
   end subroutine make_drift_note

   !> A part of a whole: the percentage and both counts
   pure function share_of(part, whole) result(text)
      !> The part
      integer(int64), intent(in) :: part
      !> The whole
      integer(int64), intent(in) :: whole
      !> Text that the name of what is counted can follow, filled up with blanks
      character(len=56) :: text

      character(len=8) :: percent

      write (percent, '(f8.1)') 100.0_wp*real(part, wp)/real(max(whole, 1_int64), wp)
      text = trim(adjustl(percent))//' %, '//to_text(part)//' of '//to_text(whole)
   end function share_of

end module dondolo_fragility_drift_note
