!> Lanes: the state of many histories of one wall, each with its own time, in arrays that one loop runs over.
module dondolo_motion_lane_state
   use, intrinsic :: iso_c_binding, only : c_f_pointer, c_intptr_t, c_loc
   use, intrinsic :: iso_fortran_env, only : int64, int8
   use dondolo_base_kinds, only : wp
   use dondolo_motion_normal_form, only : highest_restrained
   implicit none
   private

   public :: lanes_type, lane_integer, lane_width, move_lane, part_if_restrained, place_lanes, vector_width, whole_vectors
   public :: step_taken, record_over, event_possible, step_too_long

   !> Most lanes: so many that those with an event in the same step fill a vector, and so few that all stay in the caches of
   !> the processor's core. An odd number of cache lines of 64 bytes, for arrays of other sizes share places of the first
   integer, parameter :: lane_width = 184

   !> Lanes in a vector of the widest kind. Loops run over whole ones, so that a lane's arithmetic does not depend on its place
   integer, parameter :: vector_width = 8

   !> Kind of integers as wide as the reals: a vector holds as many of them, and all numbers of a lane move as words of one width
   integer, parameter :: lane_integer = merge(int64, selected_int_kind(38), storage_size(1.0_wp) == storage_size(1_int64))

   !> Part of the last three terms of a step that counts as its error where ties hold the wall. It vibrates on them, and
   !> the first term that is left out is (w h)^3/504 of the first of these three, less than 1/4000 where w h < 1/2
   real(wp), parameter :: part_if_restrained = 1.0e-2_wp

   !> What becomes of a step: it is taken; it is taken, and the record is over; it is not taken, since something may
   !> happen in it, or since it is too long for the tolerance
   integer(int64), parameter :: step_taken = 0, record_over = 1, event_possible = 2, step_too_long = 3

   !> Lanes. y is the coordinate of dondolo_motion_normal_form; u, the ground acceleration seen from the lane's side. Every
   !> component is real(wp) or integer(lane_integer) and has the lane as its first dimension: `move_lane` takes them all as one
   !> array of words
   type :: lanes_type
      sequence
      !> Coordinate and its velocity [1/s]
      real(wp) :: y(lane_width) = 0.0_wp, v(lane_width) = 0.0_wp
      !> Time since the last sample, and from sample to sample [s]; samples per time [1/s]
      real(wp) :: time(lane_width) = 0.0_wp, dt(lane_width) = 1.0_wp, rate(lane_width) = 1.0_wp
      !> u now and at the next sample [m/s2], and its slope [m/s3]
      real(wp) :: u(lane_width) = 0.0_wp, u_next(lane_width) = 0.0_wp, slope(lane_width) = 0.0_wp
      !> v_g''/g now and at the next sample, its slope [1/s], and the factor from a vertical sample to it: |scale|/g
      real(wp) :: heavier(lane_width) = 0.0_wp, heavier_next(lane_width) = 0.0_wp, heavier_slope(lane_width) = 0.0_wp
      real(wp) :: vertical_factor(lane_width) = 0.0_wp
      !> Factor from a sample of the record to u: side * scale
      real(wp) :: factor(lane_width) = 0.0_wp
      !> Longest step from here to the next sample, and from that sample on [s]
      real(wp) :: span(lane_width) = 0.0_wp, next_span(lane_width) = 0.0_wp
      !> Largest y so far at a turning point
      real(wp) :: peak(lane_width) = 0.0_wp
      !> Place of the next sample in the set of records, and of the record's last
      integer(lane_integer) :: next(lane_width) = 1, last(lane_width) = 1
      !> Length of the last step [s], and the step as a series: y + step (v x + sum_k series(:, k) x^k), k = 2 to 9, with x the
      !> part of it that has passed
      real(wp) :: step(lane_width) = 0.0_wp, series(lane_width, 2:9) = 0.0_wp
      !> What became of the last step
      integer(lane_integer) :: flag(lane_width) = step_taken
      !> Of walls with ties: coefficients of a with the forces that they have at present (dondolo_motion_normal_form), the bound of
      !> its fifth derivative, and the nearest y above and below at which these forces change
      real(wp) :: a(lane_width, 0:highest_restrained) = 0.0_wp, fifth_a(lane_width) = 0.0_wp
      real(wp) :: above(lane_width) = huge(1.0_wp), below(lane_width) = 0.0_wp
      !> Of walls that friction has held and the ground releases: 1 if they go on outwards, -1 if they fall back; 0 after their
      !> next event
      real(wp) :: released(lane_width) = 0.0_wp
   end type lanes_type

   !> Lanes at their beginning. They are copied from here: they are larger than the stack that a thread may have
   type(lanes_type), protected :: empty

contains

   !> Place lanes in memory, at their beginning. Each component begins with a cache line: vectors that lie across two of them take
   !> up to 6 % more of the time of histories
   subroutine place_lanes(room, lanes)
      !> The memory; what it belongs to is a target
      integer(int8), allocatable, intent(out), target :: room(:)
      !> The lanes, for as long as it is there
      type(lanes_type), pointer, intent(out) :: lanes

      integer, parameter :: cache_line = 64
      integer :: first

      allocate (room(storage_size(empty)/storage_size(room) + cache_line - 1))
      first = 1 + int(modulo(-transfer(c_loc(room), 0_c_intptr_t), int(cache_line, c_intptr_t)))
      call c_f_pointer(c_loc(room(first)), lanes)
      lanes = empty
   end subroutine place_lanes

   !> Number of lanes, rounded up to whole vectors
   pure integer function whole_vectors(n)
      !> Number of lanes
      integer, intent(in) :: n

      whole_vectors = (n + vector_width - 1)/vector_width*vector_width
   end function whole_vectors

   !> Move the state of a lane to another: all of it, whatever components there are
   subroutine move_lane(lanes, from, to)
      type(lanes_type), intent(inout), target :: lanes
      !> The lane, and where it goes
      integer, intent(in) :: from, to

      integer(lane_integer), pointer :: words(:, :)

      call c_f_pointer(c_loc(lanes), words, [lane_width, storage_size(lanes)/storage_size(words)/lane_width])
      words(to, :) = words(from, :)
   end subroutine move_lane

end module dondolo_motion_lane_state
