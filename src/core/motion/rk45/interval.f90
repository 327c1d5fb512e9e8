!> The way of the engine rk45 through an accelerogram: its sample intervals, the peak, and the rows of a time history.
module dondolo_motion_interval
   use dondolo_base_kinds, only : wp
   use dondolo_motion_adaptive_step, only : motion_type
   use dondolo_motion_dormand_prince, only : excitation_type
   use dondolo_motion_response, only : trace_type
   use dondolo_motion_step_limits, only : longest_step
   use dondolo_motion_wall_constants, only : wall_constants_type
   use dondolo_record, only : record_type
   implicit none
   private

   public :: add_row, aim, enter_interval, next_interval, set_peak, time_of

contains

   !> A new sample interval, or a new start in one
   pure subroutine enter_interval(constants, record, motion)
      !> Constants of the wall
      type(wall_constants_type), intent(in) :: constants
      type(record_type), intent(in) :: record
      type(motion_type), intent(inout) :: motion

      motion%longest = longest_step(constants%solver%steps_per_sample, record%dt, motion%time)
      call aim(constants%gravity, record, motion)
   end subroutine enter_interval

   !> The excitation in the present interval, seen from the side of the wall
   pure subroutine aim(gravity, record, motion)
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      type(record_type), intent(in) :: record
      type(motion_type), intent(inout) :: motion

      motion%excitation = excitation_type()
      associate (a => record%acceleration, i => motion%interval)
         if (i >= size(a)) return
         motion%excitation%start = motion%side*motion%scale*a(i)
         motion%excitation%slope = motion%side*motion%scale*(a(i + 1) - a(i))/record%dt
         if (.not. allocated(record%vertical)) return
         associate (v => record%vertical, unit => abs(motion%scale)/gravity)
            motion%excitation%heavier = unit*v(i)
            motion%excitation%heavier_slope = unit*(v(i + 1) - v(i))/record%dt
         end associate
      end associate
   end subroutine aim

   !> Go on to the next sample
   pure subroutine next_interval(constants, record, motion, trace)
      !> Constants of the wall
      type(wall_constants_type), intent(in) :: constants
      type(record_type), intent(in) :: record
      type(motion_type), intent(inout) :: motion
      type(trace_type), intent(inout), optional :: trace

      motion%interval = motion%interval + 1
      motion%time = 0.0_wp
      motion%released = 0
      call enter_interval(constants, record, motion)
      if (present(trace)) call add_row(motion, record, trace)
   end subroutine next_interval

   !> The rotation is a new peak
   pure subroutine set_peak(motion, record)
      type(motion_type), intent(inout) :: motion
      type(record_type), intent(in) :: record

      motion%peak = motion%q
      motion%time_of_peak = time_of(motion, record)
   end subroutine set_peak

   !> Time since the start of the record [s]
   pure real(wp) function time_of(motion, record)
      type(motion_type), intent(in) :: motion
      type(record_type), intent(in) :: record

      time_of = real(motion%interval - 1, wp)*record%dt + motion%time
   end function time_of

   !> Add the present state to the time history
   pure subroutine add_row(motion, record, trace)
      type(motion_type), intent(in) :: motion
      type(record_type), intent(in) :: record
      type(trace_type), intent(inout) :: trace

      real(wp) :: acceleration, x

      associate (a => record%acceleration, i => motion%interval, scale => motion%scale, s => motion%side)
         acceleration = 0.0_wp
         x = motion%time/record%dt
         if (i < size(a)) acceleration = scale*(a(i) + x*(a(i + 1) - a(i)))
         if (i == size(a) .and. x == 0.0_wp) acceleration = scale*a(i)
         ! Adding zero makes no row show a negative zero.
         call trace%add(real(i - 1, wp)*record%dt + motion%time, acceleration, s*motion%q + 0.0_wp, &
            & s*motion%v + 0.0_wp, s)
      end associate
   end subroutine add_row

end module dondolo_motion_interval
