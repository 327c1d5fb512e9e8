!> The ground under a thread of a graphics processor: what dondolo_motion_lane_ground and dondolo_motion_rest decide from the
!> samples of a horizontal record.
module dondolo_gpu_ground
   use dondolo_base_kinds, only : wp
   use dondolo_gpu_state, only : lanes_type
   use dondolo_motion_rest, only : rest_type
   use dondolo_motion_step_limits, only : shortest_motion
   implicit none
   private

   public :: block_size, ground_type, aim, begin_at, chain_ends, find_start, leave_edge

   !> Samples in a block
   integer, parameter :: block_size = 64

   !> A record among joined ones, and the factor on it
   type :: ground_type
      !> Samples before its first, and their number
      integer :: before, n
      !> Time step [s], and the factor
      real(wp) :: dt, scale
   end type ground_type

contains

   !> See the ground from a side of the wall
   pure subroutine aim(lane, samples, factor)
      !$acc routine seq
      type(lanes_type), intent(inout) :: lane
      real(wp), intent(in) :: samples(*)
      !> Side * scale
      real(wp), intent(in) :: factor

      lane%factor(1) = factor
      lane%u_next(1) = factor*samples(lane%next(1))
      lane%slope(1) = (lane%u_next(1) - factor*samples(lane%next(1) - 1))*lane%rate(1)
      lane%u(1) = factor*samples(lane%next(1) - 1) + lane%slope(1)*lane%time(1)
   end subroutine aim

   !> Begin to rock
   pure subroutine begin_at(lane, ground, samples, interval, time, side)
      !$acc routine seq
      type(lanes_type), intent(inout) :: lane
      type(ground_type), intent(in) :: ground
      real(wp), intent(in) :: samples(*)
      !> Sample interval, time in it [s], side
      integer, intent(in) :: interval
      real(wp), intent(in) :: time, side

      lane%next(1) = ground%before + interval + 1
      lane%time(1) = time
      lane%next_span(1) = huge(time)
      lane%span(1) = lane%next_span(1)
      call aim(lane, samples, side*ground%scale)
   end subroutine begin_at

   !> When a wall at rest begins to rock
   pure subroutine find_start(rest, ground, samples, smallest, largest, interval, time, side, found)
      !$acc routine seq
      type(rest_type), intent(in) :: rest
      type(ground_type), intent(in) :: ground
      !> Samples of all records, and the smallest and largest of each block of them [m/s2]
      real(wp), intent(in) :: samples(*), smallest(*), largest(*)
      !> Sample interval and time in it [s]; in: where to look from, out: where rocking begins
      integer, intent(inout) :: interval
      real(wp), intent(inout) :: time
      !> Side that opens
      real(wp), intent(inout) :: side
      !> Does rocking begin before the end of the record?
      logical, intent(out) :: found

      real(wp) :: here, next, threshold, high
      integer :: block

      found = .false.
      if (interval >= ground%n) return
      threshold = rest%moment/rest%lever
      high = merge(threshold, huge(threshold), rest%two_sided)
      associate (first => ground%before, scale => ground%scale)
         here = scale*(samples(first + interval) &
            & + (samples(first + interval + 1) - samples(first + interval))*(time/ground%dt))
         do
            ! Records are long: jump over the blocks in which nothing can start.
            if (modulo(first + interval, block_size) == 0 .and. interval + block_size < ground%n) then
               block = (first + interval)/block_size + 1
               if (min(scale*smallest(block), scale*largest(block)) >= -threshold .and. &
                  & max(scale*smallest(block), scale*largest(block)) <= high .and. here >= -threshold .and. here <= high) then
                  interval = interval + block_size
                  time = 0.0_wp
                  here = scale*samples(first + interval)
                  cycle
               end if
            end if
            next = scale*samples(first + interval + 1)
            found = here < -threshold .or. here > high .or. next < -threshold .or. next > high
            if (found) exit
            if (interval >= ground%n - 1) return
            interval = interval + 1
            time = 0.0_wp
            here = next
         end do
      end associate
      if (here < -threshold .or. here > high) then
         side = -sign(1.0_wp, here)
      else
         side = -sign(1.0_wp, next)
         time = time + (ground%dt - time)*((-side*threshold - here)/(next - here))
      end if
   end subroutine find_start

   !> Leave the edge of the trigger, if rounding undid the last start at once
   pure subroutine leave_edge(ground, samples, start_interval, start_time, interval, time)
      !$acc routine seq
      type(ground_type), intent(in) :: ground
      real(wp), intent(in) :: samples(*)
      !> Where it last began to rock
      integer, intent(in) :: start_interval
      real(wp), intent(in) :: start_time
      !> Where it is
      integer, intent(inout) :: interval
      real(wp), intent(inout) :: time

      real(wp) :: here, next, crossing

      if (interval /= start_interval .or. time - start_time > shortest_motion*ground%dt) return
      here = samples(ground%before + interval)
      next = samples(ground%before + interval + 1)
      crossing = 0.0_wp
      if (here > 0.0_wp .neqv. next > 0.0_wp) crossing = ground%dt*(here/(here - next))
      if (crossing > time) then
         time = crossing
      else
         interval = interval + 1
         time = 0.0_wp
      end if
   end subroutine leave_edge

   !> Does the chain of bounces after an impact end at rest (dondolo_motion_rest)?
   pure subroutine chain_ends(rest, ground, samples, interval, time, side, speed, peak, stopper, ends)
      !$acc routine seq
      type(rest_type), intent(in) :: rest
      type(ground_type), intent(in) :: ground
      real(wp), intent(in) :: samples(*)
      !> The impact: sample interval, time in it [s], side, speed [rad/s], largest rotation so far [rad]
      integer, intent(in) :: interval
      real(wp), intent(in) :: time, side, speed, peak
      !> The sample that stopped the last look
      integer, intent(inout) :: stopper
      !> True only if it is certain
      logical, intent(out) :: ends

      real(wp), parameter :: margin = 1.03_wp, largest_growth = 10.0_wp, largest_divisor = 1.0e100_wp
      real(wp) :: push_of_ground, loss, highest, energy, longest, growth, divisor, elapsed, push, here, other
      real(wp) :: here_next, other_next, least_here, least_other, least
      integer :: i

      ends = .false.
      push_of_ground = side*ground%scale*rest%lever
      loss = 1.0_wp - rest%restitution**2
      highest = min(rest%height, peak)
      energy = 0.5_wp*margin*rest%inertia*speed**2
      longest = 8.0_wp*energy*rest%inertia
      growth = 1.0_wp
      divisor = 1.0_wp
      elapsed = -time
      ! The two samples after a record are zero.
      i = ground%before + interval
      push = push_of_ground*(samples(i) + (samples(i + 1) - samples(i))*(time/ground%dt))
      if (interval >= ground%n) push = 0.0_wp
      here = least_moment(rest, push, push)
      other = merge(least_moment(rest, push, -push), here, rest%two_sided)
      if (stopper > interval) then
         if (longest*(other + rest%restitution*here)**2 &
            & > (((real(stopper - 1 - interval, wp)*ground%dt - time)*loss)*here*other)**2) return
      end if
      least_here = here
      least_other = other
      do i = min(interval, ground%n), ground%n
         push = push_of_ground*samples(ground%before + i + 1)
         here_next = least_moment(rest, push, push)
         other_next = merge(least_moment(rest, push, -push), here_next, rest%two_sided)
         if (.not. min(here_next, other_next) > 0.0_wp) stopper = i + 1
         least_here = min(least_here, here_next)
         least_other = min(least_other, other_next)
         least = min(least_here, least_other)
         if (.not. least > 0.0_wp) return
         growth = growth*max(here*other, max(here_next*other, here*other_next))
         divisor = divisor*(here*other)
         if (energy*growth > highest*least*divisor .or. growth > largest_growth*divisor) return
         elapsed = elapsed + ground%dt
         if (longest*growth*(least_other + rest%restitution*least_here)**2 &
            & <= (elapsed*loss*least_here*least_other)**2*divisor) exit
         if (divisor > largest_divisor .or. divisor*largest_divisor < 1.0_wp) then
            growth = growth/divisor
            divisor = 1.0_wp
         end if
         here = here_next
         other = other_next
      end do
      ends = .true.
   end subroutine chain_ends

   !> Lower bound of the inward moment of a side within the height of a chain [N m]
   pure real(wp) function least_moment(rest, push, inward) result(least)
      !$acc routine seq
      type(rest_type), intent(in) :: rest
      !> Moment of the ground, and the same as it is seen from the side [N m]
      real(wp), intent(in) :: push, inward

      least = (1.0_wp - rest%slack)*rest%moment - rest%slack*abs(push) + inward
   end function least_moment

end module dondolo_gpu_ground
