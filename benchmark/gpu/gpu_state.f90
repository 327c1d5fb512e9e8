!> Walls and histories as a graphics processor keeps them: types without pointers, of which a thread has one.
module dondolo_gpu_state
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_kinds, only : wp
   use dondolo_motion_lane_constants, only : lane_constants_type
   use dondolo_motion_normal_form, only : highest_degree, highest_harmonic
   use dondolo_motion_rest, only : rest_type
   implicit none
   private

   public :: gpu_history_type, gpu_wall_type, lanes_type, normal_form_type, new_gpu_wall, lane_width

   !> Lanes of a thread: its one history
   integer, parameter :: lane_width = 1

   !> The lane of a thread, as in dondolo_motion_lane_state
   type :: lanes_type
      real(wp), dimension(lane_width) :: y, v, time, dt, rate, u, u_next, slope, factor, span, next_span, peak, step
      real(wp), dimension(lane_width) :: heavier, heavier_next, heavier_slope, vertical_factor
      real(wp) :: series(lane_width, 2:9)
      integer(int64), dimension(lane_width) :: next, last, flag
   end type lanes_type

   !> The wall in normal form, as in dondolo_motion_normal_form
   type :: normal_form_type
      real(wp) :: a(0:highest_degree), b(0:highest_degree), d(0:highest_degree)
      real(wp) :: fifth_a, fifth_b, fifth_d
      real(wp) :: even(3), odd(3), cosine(0:highest_harmonic/2), sine(0:highest_harmonic/2 - 1), unit
   end type normal_form_type

   !> Constants of a wall
   type :: gpu_wall_type
      type(normal_form_type) :: form
      type(rest_type) :: rest
      !> Tolerances of the velocity: relative, and absolute [1/s]; rotation at y = 2 [rad]
      real(wp) :: rtol, atol, limit
   end type gpu_wall_type

   !> What a history leaves to be finished
   type :: gpu_history_type
      !> Coordinate and its velocity at the end [1/s]; the largest coordinate at a turning point
      real(wp) :: y, v, peak
      !> When that was [s]
      real(wp) :: time_of_peak
      !> Side of the wall at the end
      real(wp) :: side
      integer :: impacts, steps
      logical :: collapsed
   end type gpu_history_type

contains

   !> Constants of a wall, from those of the engine lanes
   pure function new_gpu_wall(constants) result(wall)
      type(lane_constants_type), intent(in) :: constants
      type(gpu_wall_type) :: wall

      associate (form => constants%form)
         wall%form = normal_form_type(form%a, form%b, form%d, form%fifth_a, form%fifth_b, form%fifth_d, form%even, form%odd, &
            & form%cosine, form%sine, form%unit)
      end associate
      wall%rest = constants%rest
      wall%rtol = constants%solver%rtol
      wall%atol = constants%atol
      wall%limit = constants%limit
   end function new_gpu_wall

end module dondolo_gpu_state
