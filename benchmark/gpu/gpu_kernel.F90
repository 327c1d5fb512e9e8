!> Histories on a graphics processor, a thread each: the step of the engine lanes (lane_step.inc, of one lane) and the rules of
!> dondolo_motion_history and dondolo_motion_rest for walls without ties under horizontal motion.
!>
!> Compiled for each kind of normal form by itself (LANE_KIND and LANE_DEGREE, whose step is GPU_STEP), under another name.
module dondolo_gpu_kernel
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_kinds, only : wp
   use dondolo_gpu_events, only : allowed_part, find_first, impact, limit_reached, no_event, rate, turning, value
   use dondolo_gpu_ground, only : aim, begin_at, chain_ends, find_start, ground_type, leave_edge
   use dondolo_gpu_state, only : gpu_history_type, gpu_wall_type, lane_width, lanes_type, normal_form_type
   use dondolo_motion_lane_state, only : event_possible, part_if_restrained, record_over, step_taken, step_too_long
   use dondolo_motion_normal_form, only : y_limit
   use dondolo_motion_step_limits, only : shortest_motion, smallest_step
   implicit none
   private

   public :: run_on_gpu

   !> Most steps that the threads of a warp take before those with an event are seen to, all at once: every 18th step or so has one.
   !> Warps in a block
   integer, parameter :: patience = 16, warps = 4

   !> The course of a history, besides its lane
   type :: course_type
      !> Where it rests, or struck last: sample interval, time in it [s]; where it began to rock last
      integer :: interval = 1, start_interval = 0
      real(wp) :: time = 0.0_wp, start_time = 0.0_wp
      real(wp) :: side = 1.0_wp, time_of_peak = 0.0_wp
      !> Bounces in a row that are low, and lowest; the sample that stopped the last look at a chain
      integer :: low = 0, lowest = 0, stopper = 0, impacts = 0, steps = 0
      logical :: at_rest = .true., collapsed = .false.
   end type course_type

contains

   !> Histories of many walls
   subroutine run_on_gpu(walls, wall, record, scale, samples, smallest, largest, offset, length, dt, histories)
      !> The walls
      type(gpu_wall_type), intent(in), contiguous :: walls(:)
      !> Wall and record of each history, and the factor on the record. Neighbours should be alike
      integer, intent(in), contiguous :: wall(:), record(:)
      real(wp), intent(in), contiguous :: scale(:)
      !> Samples of all records, as in dondolo_record_set, the smallest and largest of each block of them [m/s2]; samples before
      !> each record, number of each, its time step [s]
      real(wp), intent(in), contiguous :: samples(:), smallest(:), largest(:)
      integer, intent(in), contiguous :: offset(:), length(:)
      real(wp), intent(in), contiguous :: dt(:)
      !> What becomes of each
      type(gpu_history_type), intent(inout), contiguous :: histories(:)

      integer :: i

      !$acc parallel loop gang worker vector num_workers(warps) vector_length(32) &
      !$acc & copyin(walls, wall, record, scale, samples, smallest, largest, offset, length, dt) copyout(histories)
      do i = 1, size(histories)
         call follow(walls(wall(i)), ground_type(offset(record(i)), length(record(i)), dt(record(i)), scale(i)), samples, &
            & smallest, largest, histories(i))
      end do
   end subroutine run_on_gpu

   !> One history
   pure subroutine follow(wall, ground, samples, smallest, largest, history)
      !$acc routine seq
      type(gpu_wall_type), intent(in) :: wall
      !> Its record
      type(ground_type), intent(in) :: ground
      real(wp), intent(in) :: samples(*), smallest(*), largest(*)
      type(gpu_history_type), intent(out) :: history

      type(lanes_type) :: lane
      type(course_type) :: course
      integer :: k
      logical :: found

      course = course_type()
      lane%dt(1) = ground%dt
      lane%rate(1) = 1.0_wp/ground%dt
      lane%peak(1) = 0.0_wp
      lane%y(1) = 0.0_wp
      lane%v(1) = 0.0_wp
      lane%last(1) = ground%before + ground%n
      do
         if (course%at_rest) then
            call find_start(wall%rest, ground, samples, smallest, largest, course%interval, course%time, course%side, found)
            if (.not. found) exit
            course%start_interval = course%interval
            course%start_time = course%time
            call begin_at(lane, ground, samples, course%interval, course%time, course%side)
            course%at_rest = .false.
         end if
         do k = 1, patience
            call GPU_STEP(lane, 1, wall%form, samples, wall%rtol, wall%atol)
            course%steps = course%steps + 1
            if (lane%flag(1) /= step_taken) exit
         end do
         if (lane%flag(1) == step_taken) cycle
         if (lane%flag(1) >= event_possible) call resolve(wall, ground, samples, lane, course)
         if (course%collapsed .or. lane%next(1) > lane%last(1)) exit
      end do
      history = gpu_history_type(lane%y(1), lane%v(1), lane%peak(1), course%time_of_peak, course%side, course%impacts, &
         & course%steps, course%collapsed)
   end subroutine follow

   !> Take a step up to the first event in it
   pure subroutine resolve(wall, ground, samples, lane, course)
      !$acc routine seq
      type(gpu_wall_type), intent(in) :: wall
      type(ground_type), intent(in) :: ground
      real(wp), intent(in) :: samples(*)
      type(lanes_type), intent(inout) :: lane
      type(course_type), intent(inout) :: course

      real(wp) :: d(0:9), part, h
      integer :: event

      d(0) = lane%y(1)
      d(1) = lane%v(1)*lane%step(1)
      d(2:) = lane%step(1)*lane%series(1, :)
      if (lane%y(1) == 0.0_wp .and. lane%v(1) == 0.0_wp) d(2) = max(0.0_wp, d(2))
      part = 1.0_wp
      if (lane%flag(1) == step_too_long) then
         part = allowed_part(d, lane%step(1), smallest_step*lane%dt(1), &
            & wall%form%fifth_a + wall%form%fifth_b*abs(lane%u(1)), wall%rtol, wall%atol)
         if (part < 1.0_wp) then
            lane%next_span(1) = part*lane%step(1)
            lane%span(1) = lane%next_span(1)
         end if
      end if
      event = no_event
      if (part*lane%step(1) > shortest_motion*lane%dt(1)) call find_first(d, lane%peak(1), part, event)
      lane%y(1) = value(d, part)
      if (part*lane%step(1) > 0.0_wp) lane%v(1) = rate(d, part)/lane%step(1)
      h = part*lane%step(1)
      if (event == no_event .and. .not. lane%time(1) + h < lane%dt(1)) then
         lane%time(1) = 0.0_wp
         lane%next(1) = lane%next(1) + 1
         lane%u(1) = lane%u_next(1)
         lane%u_next(1) = lane%factor(1)*samples(lane%next(1))
         lane%slope(1) = (lane%u_next(1) - lane%u(1))*lane%rate(1)
         lane%span(1) = lane%next_span(1)
      else
         lane%time(1) = min(lane%time(1) + h, lane%dt(1))
         lane%u(1) = lane%factor(1)*samples(lane%next(1) - 1) + lane%slope(1)*lane%time(1)
         if (event /= no_event) lane%span(1) = lane%next_span(1)
      end if
      if (event == impact) then
         call bounce(wall, ground, samples, lane, course)
      else if (event == turning .or. event == limit_reached) then
         if (event == turning) lane%v(1) = 0.0_wp
         if (event == limit_reached) lane%y(1) = y_limit
         if (lane%y(1) > lane%peak(1)) then
            lane%peak(1) = lane%y(1)
            course%time_of_peak = real(int(lane%next(1)) - 2 - ground%before, wp)*lane%dt(1) + lane%time(1)
         end if
         course%collapsed = .not. lane%y(1) < y_limit
      end if
   end subroutine resolve

   !> An impact: the wall turns back, or rocks on to the other side, or comes to rest
   pure subroutine bounce(wall, ground, samples, lane, course)
      !$acc routine seq
      type(gpu_wall_type), intent(in) :: wall
      type(ground_type), intent(in) :: ground
      real(wp), intent(in) :: samples(*)
      type(lanes_type), intent(inout) :: lane
      type(course_type), intent(inout) :: course

      real(wp) :: speed, moment, energy, highest

      associate (rest => wall%rest)
         course%interval = int(lane%next(1)) - 1 - ground%before
         course%time = lane%time(1)
         course%impacts = course%impacts + 1
         moment = course%side*lane%u(1)
         if (rest%two_sided) course%side = -course%side
         moment = rest%moment + course%side*rest%lever*moment
         lane%y(1) = 0.0_wp
         lane%v(1) = -rest%restitution*min(lane%v(1), 0.0_wp)
         speed = lane%v(1)*wall%form%unit
         energy = 0.5_wp*rest%inertia*speed**2
         course%low = merge(course%low + 1, 0, energy < rest%low_energy(1))
         course%lowest = merge(course%lowest + 1, 0, energy < rest%low_energy(2))
         course%at_rest = speed == 0.0_wp .or. course%low > rest%most_low_bounces(1) .or. &
            & course%lowest > rest%most_low_bounces(2)
         if (.not. course%at_rest .and. moment > 0.0_wp) then
            course%at_rest = 2.0_wp*speed*rest%inertia <= shortest_motion*lane%dt(1)*moment
            ! The rotation is no less than y times its unit.
            highest = lane%peak(1)*wall%form%unit
            if (.not. course%at_rest .and. energy <= moment*min(rest%height, highest) &
               & .and. modulo(course%impacts, rest%bounces_per_look) == 0) call chain_ends(rest, ground, samples, &
               & course%interval, course%time, course%side, speed, highest, course%stopper, course%at_rest)
         end if
         if (course%at_rest) then
            lane%v(1) = 0.0_wp
            course%low = 0
            course%lowest = 0
            call leave_edge(ground, samples, course%start_interval, course%start_time, course%interval, course%time)
         else
            call aim(lane, samples, course%side*ground%scale)
         end if
      end associate
   end subroutine bounce

#define LANES_IN_TURN 1
#include "lane_step.inc"

end module dondolo_gpu_kernel
