!> Records that hold no ground motion: channels that were dead, or stuck at one value.
!>
!> No factor makes an earthquake of them, and a wall survives them at any level. An analysis that scales records to levels,
!> or counts them, therefore refuses them by this rule.
module dondolo_record_dead_channel
   use dondolo_base_error, only : error_type, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : brief, to_text
   use dondolo_record, only : compute_extremes, record_type
   implicit none
   private

   public :: check_motion, check_vertical_motion, is_motion

   !> Smallest PGA that is a motion [m/s2]: less than any accelerograph resolves, and more than processing leaves of a channel
   !> of zeros
   real(wp), parameter :: least_motion = 1.0e-6_wp

   !> Range of the samples, as a part of the largest, that is their rounding
   real(wp), parameter :: rounding = 1.0e-9_wp

contains

   !> Are the smallest and the largest sample those of a motion?
   pure logical function is_motion(lowest, highest)
      !> The two [m/s2]
      real(wp), intent(in) :: lowest, highest

      associate (peak => max(-lowest, highest))
         is_motion = peak >= least_motion .and. highest - lowest > rounding*peak
      end associate
   end function is_motion

   !> Check that the ground moves
   subroutine check_motion(record, error)
      type(record_type), intent(in) :: record
      !> It does not
      type(error_type), allocatable, intent(out) :: error

      call check_samples(record%acceleration, 'record '''//record%name//''': has no motion', 'PGA', &
         & 'must be left out', error)
   end subroutine check_motion

   !> Check that a vertical component is one
   subroutine check_vertical_motion(vertical, error)
      !> Vertical ground acceleration, before a factor on it [m/s2]
      real(wp), intent(in) :: vertical(:)
      !> The ground does not move vertically
      type(error_type), allocatable, intent(out) :: error

      call check_samples(vertical, 'vertical: has no motion', 'largest sample', 'must be another component, or none', error)
   end subroutine check_vertical_motion

   !> Check samples
   subroutine check_samples(samples, statement, measure, demand, error)
      !> Samples [m/s2]
      real(wp), intent(in) :: samples(:)
      !> How the sentence begins, what their largest is called, and what is asked for
      character(len=*), intent(in) :: statement, measure, demand
      !> They are no motion
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: reason
      real(wp) :: lowest, highest, peak

      call compute_extremes(samples, lowest, highest)
      if (is_motion(lowest, highest)) return
      peak = max(-lowest, highest)
      if (.not. peak > 0.0_wp) then
         reason = 'its '//measure//' is 0'
      else if (peak < least_motion) then
         reason = 'its '//measure//' of '//brief(peak)//' m/s2 is below '//to_text(least_motion)//' m/s2'
      else
         reason = 'all its samples are '//brief(samples(1))//' m/s2'
      end if
      call raise_input(error, statement//' ('//reason//'): '//demand)
   end subroutine check_samples

end module dondolo_record_dead_channel
