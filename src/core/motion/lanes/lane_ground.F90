!> The ground under a lane: its record from sample to sample, seen from the side of the wall, and how far a step may go.
module dondolo_motion_lane_ground
   use dondolo_base_kinds, only : wp
   use dondolo_motion_lane_state, only : lanes_type
   use dondolo_motion_step_limits, only : longest_step
   use dondolo_record_set, only : record_set_type
   implicit none
   private

   public :: aim, limit_span, next_sample, stop_between

contains

   !> The lane reaches its next sample
   pure subroutine next_sample(lanes, i, set)
      !> The lanes, and the one
      type(lanes_type), intent(inout) :: lanes
      integer, intent(in) :: i
      !> Accelerograms
      type(record_set_type), intent(in) :: set

      lanes%time(i) = 0.0_wp
      lanes%next(i) = lanes%next(i) + 1
      lanes%u(i) = lanes%u_next(i)
      lanes%u_next(i) = lanes%factor(i)*set%samples(lanes%next(i))
      lanes%slope(i) = (lanes%u_next(i) - lanes%u(i))*lanes%rate(i)
      if (allocated(set%verticals)) then
         lanes%heavier(i) = lanes%heavier_next(i)
         lanes%heavier_next(i) = lanes%vertical_factor(i)*set%verticals(lanes%next(i))
         lanes%heavier_slope(i) = (lanes%heavier_next(i) - lanes%heavier(i))*lanes%rate(i)
      end if
      lanes%span(i) = lanes%next_span(i)
   end subroutine next_sample

   !> The lane stops between two samples
   pure subroutine stop_between(lanes, i, set, h)
      !> The lanes, and the one
      type(lanes_type), intent(inout) :: lanes
      integer, intent(in) :: i
      !> Accelerograms
      type(record_set_type), intent(in) :: set
      !> Time since the last stop [s]
      real(wp), intent(in) :: h

      lanes%time(i) = min(lanes%time(i) + h, lanes%dt(i))
      ! Of the time in the interval, not of the step: a sum of steps below the rounding of u would never move it, and a
      ! wall on the edge of its trigger would turn forever.
      lanes%u(i) = lanes%factor(i)*set%samples(lanes%next(i) - 1) + lanes%slope(i)*lanes%time(i)
      if (allocated(set%verticals)) lanes%heavier(i) = lanes%vertical_factor(i)*set%verticals(lanes%next(i) - 1) &
         & + lanes%heavier_slope(i)*lanes%time(i)
   end subroutine stop_between

   !> Limit the steps from an event to the next sample
   pure subroutine limit_span(lanes, i, steps_per_sample)
      !> The lanes, and the one just after an event
      type(lanes_type), intent(inout) :: lanes
      integer, intent(in) :: i
      !> Least number of steps
      integer, intent(in) :: steps_per_sample

      lanes%span(i) = min(lanes%next_span(i), longest_step(steps_per_sample, lanes%dt(i), lanes%time(i)))
   end subroutine limit_span

   !> The ground seen from the side of the wall, at the lane's time
   pure subroutine aim(lanes, i, set, factor, gravity)
      !> The lanes, and the one
      type(lanes_type), intent(inout) :: lanes
      integer, intent(in) :: i
      !> Accelerograms
      type(record_set_type), intent(in) :: set
      !> Factor on them: side * scale
      real(wp), intent(in) :: factor
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity

      associate (here => set%samples(lanes%next(i) - 1), next => set%samples(lanes%next(i)))
         lanes%factor(i) = factor
         lanes%u_next(i) = lanes%factor(i)*next
         lanes%slope(i) = (lanes%u_next(i) - lanes%factor(i)*here)*lanes%rate(i)
         lanes%u(i) = lanes%factor(i)*here + lanes%slope(i)*lanes%time(i)
      end associate
      if (.not. allocated(set%verticals)) return
      associate (here => set%verticals(lanes%next(i) - 1), next => set%verticals(lanes%next(i)))
         lanes%vertical_factor(i) = abs(factor)/gravity
         lanes%heavier_next(i) = lanes%vertical_factor(i)*next
         lanes%heavier_slope(i) = (lanes%heavier_next(i) - lanes%vertical_factor(i)*here)*lanes%rate(i)
         lanes%heavier(i) = lanes%vertical_factor(i)*here + lanes%heavier_slope(i)*lanes%time(i)
      end associate
   end subroutine aim

end module dondolo_motion_lane_ground
