!> The motion of a closed wall under a whole accelerogram, computed once for all factors on it (docs/theory.md, section 7).
!>
!> Until its joints open a wall of one period is one linear filter X(t) of the accelerogram, times the factor on it. Of each block
!> of samples the filter keeps where it begins and a bound of the amplitude (X^2 + (X'/w)^2)^1/2 within. After an opening the
!> motion is the same and a free swing, which decays: blocks where both together stay below q_y are jumped over, since nothing
!> happens there that is not linear.
module dondolo_motion_elastic_filter
   use dondolo_base_kinds, only : wp
   use dondolo_motion_elastic_flow, only : at_level, at_turn, bent_type, elastic_flow_type, longest_angle, new_elastic_flow
   use dondolo_record, only : record_type
   use dondolo_record_oscillators, only : block_size => block, let_swing => swing, oscillators_type, side_by_side
   use dondolo_wall_elastic_joint, only : elastic_joint_type
   implicit none
   private

   public :: elastic_filter_type, new_elastic_filter, new_elastic_filters

   !> Sample intervals of a block, and blocks that are filtered at a time
   integer, parameter :: length = 32, blocks = block_size/length

   !> The filter of an accelerogram
   type :: elastic_filter_type
      private
      !> Joints of the wall
      type(elastic_joint_type), public :: joint
      !> From a sample to the next: of the state, and of the accelerations at both
      real(wp) :: by_state(2, 2), by_ground(2, 2)
      !> State at the first sample of each block, and at the last sample of the record
      type(bent_type), allocatable :: start(:)
      !> Bound of the amplitude in each block [rad]
      real(wp), allocatable :: reach(:)
      !> Most that a unit of ground acceleration adds to the amplitude from a sample to the next [rad per m/s2]
      real(wp) :: push = 0.0_wp
      !> Part of a free swing that is left after a block
      real(wp) :: fading = 1.0_wp
      !> Sample interval [s]; what the motion differs by from the cubic through both samples at most, per unit of the amplitude and
      !> of the ground acceleration [1, rad per m/s2], and the same of its rate [1/s, rad/s per m/s2]
      real(wp) :: dt = 0.0_wp, bulge(2) = 0.0_wp, bulge_of_rate(2) = 0.0_wp
      !> Largest |X| [rad] and its time [s], free motion after the record included
      real(wp), public :: peak = 0.0_wp, time_of_peak = 0.0_wp
      !> Largest |X'| with which X = 0 is passed [rad/s]
      real(wp) :: fastest = 0.0_wp
   contains
      !> Whether the whole motion is linear
      procedure :: is_whole_motion
      !> State at a sample
      procedure :: at_sample
      !> Whether a block begins at a sample
      procedure :: begins_block
      !> Jump over what is linear
      procedure :: jump
      !> Go on as long as nothing can happen
      procedure :: skip
      !> The state at the next sample, and whether nothing can happen before it
      procedure :: look_ahead
      !> State at a later sample of a motion that stays linear
      procedure :: linear_state
   end type elastic_filter_type

contains

   !> The filter of an accelerogram
   pure function new_elastic_filter(joint, record) result(filter)
      type(elastic_joint_type), intent(in) :: joint
      type(record_type), intent(in) :: record
      type(elastic_filter_type) :: filter

      type(elastic_filter_type) :: filters(1)

      call new_elastic_filters(joint, [record], [1], filters)
      filter = filters(1)
   end function new_elastic_filter

   !> The filters of several accelerograms, which go side by side
   pure subroutine new_elastic_filters(joint, records, numbers, filters)
      type(elastic_joint_type), intent(in) :: joint
      type(record_type), intent(in) :: records(:)
      !> Numbers of those that are filtered, no more than go side by side
      integer, intent(in) :: numbers(:)
      !> One for each record, empty; those of these numbers are set
      type(elastic_filter_type), intent(inout) :: filters(:)

      type(oscillators_type) :: oscillators
      ! On the heap: threads may have small stacks.
      real(wp), dimension(:, :), allocatable :: ground, x, v
      integer :: first, k, longest

      longest = 0
      allocate (ground(side_by_side, 0:block_size), source=0.0_wp)
      allocate (x(side_by_side, 0:block_size), v(side_by_side, 0:block_size))
      x(:, 0) = 0.0_wp
      v(:, 0) = 0.0_wp
      do k = 1, size(numbers)
         associate (filter => filters(numbers(k)), last => size(records(numbers(k))%acceleration) - 1, dt => records(numbers(k))%dt)
            filter%joint = joint
            call set_step(filter, dt)
            filter%push = joint%lever*dt/joint%frequency
            filter%fading = exp(-joint%damping*joint%frequency*dt*real(length, wp))
            allocate (filter%start((last - 1)/length + 2), filter%reach((last - 1)/length + 1))
            oscillators%by_u(k, :) = filter%by_state(:, 1)
            oscillators%by_w(k, :) = filter%by_state(:, 2)
            oscillators%by_start(k, :) = filter%by_ground(:, 1)
            oscillators%by_end(k, :) = filter%by_ground(:, 2)
            ground(k, 0) = records(numbers(k))%acceleration(1)
            longest = max(longest, last)
         end associate
      end do
      do first = 0, longest - 1, block_size
         do k = 1, size(numbers)
            associate (a => records(numbers(k))%acceleration)
               associate (steps => min(block_size, size(a) - 1 - first))
                  if (steps > 0) ground(k, 1:steps) = a(first + 2:first + steps + 1)
               end associate
            end associate
         end do
         call let_swing(oscillators, block_size, ground, x, v)
         do k = 1, size(numbers)
            call take_states(filters(numbers(k)), first, size(records(numbers(k))%acceleration) - 1, ground(k, :), x(k, :), v(k, :))
         end do
         x(:, 0) = x(:, block_size)
         v(:, 0) = v(:, block_size)
         ground(:, 0) = ground(:, block_size)
      end do
      do k = 1, size(numbers)
         call find_largest(filters(numbers(k)), records(numbers(k)))
      end do
   end subroutine new_elastic_filters

   !> Take the states of a filter in some blocks
   pure subroutine take_states(filter, before, last, a, x, v)
      type(elastic_filter_type), intent(inout) :: filter
      !> Samples before the first, and number of the last sample interval of the record
      integer, intent(in) :: before, last
      !> Acceleration of the ground and states, from the first sample on
      real(wp), dimension(0:), intent(in) :: a, x, v

      integer :: block, first, i, n

      do i = 1, blocks
         first = (i - 1)*length
         n = min(length, last - before - first)
         if (n <= 0) return
         block = (before + first)/length + 1
         associate (amplitude => (filter%joint%frequency*x(first:first + n - 1))**2 + v(first:first + n - 1)**2, &
            & shaking => max(maxval(abs(a(first:first + n - 1))), maxval(abs(a(first + 1:first + n)))))
            filter%start(block) = bent_type(x(first), v(first))
            filter%reach(block) = sqrt(maxval(amplitude))/filter%joint%frequency + filter%push*shaking
         end associate
         filter%start(block + 1) = bent_type(x(first + n), v(first + n))
      end do
   end subroutine take_states

   !> Find the peak of a filter whose states are known, and its fastest passage
   pure subroutine find_largest(filter, record)
      type(elastic_filter_type), intent(inout) :: filter
      type(record_type), intent(in) :: record

      type(elastic_flow_type) :: flow
      type(bent_type) :: last
      integer :: block

      ! The block that reaches farthest leaves little to look for in the others.
      call look_in_block(filter, record, maxloc(filter%reach, 1))
      do block = 1, size(filter%reach)
         if (filter%reach(block) > known(filter)) call look_in_block(filter, record, block)
      end do
      ! The swing after the record is largest in its first turn.
      last = filter%start(size(filter%start))
      flow = new_elastic_flow(filter%joint, last, 0.0_wp, 0.0_wp)
      call look_for_largest(filter, flow, record%duration(), filter%joint%period, last)
   end subroutine find_largest

   !> Look for the peak and the fastest passage in a block
   pure subroutine look_in_block(filter, record, block)
      type(elastic_filter_type), intent(inout) :: filter
      type(record_type), intent(in) :: record
      !> Its number
      integer, intent(in) :: block

      type(elastic_flow_type) :: flow
      type(bent_type) :: state
      real(wp) :: amplitude
      integer :: sample

      state = filter%start(block)
      associate (a => record%acceleration, w => filter%joint%frequency)
         do sample = (block - 1)*length + 1, min(block*length, size(a) - 1)
            amplitude = sqrt((w*state%x)**2 + state%v**2)/w + filter%push*max(abs(a(sample)), abs(a(sample + 1)))
            if (amplitude > known(filter)) then
               flow = new_elastic_flow(filter%joint, state, a(sample), (a(sample + 1) - a(sample))/record%dt)
               call look_for_largest(filter, flow, real(sample - 1, wp)*record%dt, record%dt, state)
            end if
            state = filter_step(filter, state, a(sample), a(sample + 1))
         end do
      end associate
   end subroutine look_in_block

   !> Amplitude below which there is neither a new peak nor a faster passage [rad]
   pure real(wp) function known(filter)
      type(elastic_filter_type), intent(in) :: filter

      known = min(filter%peak, filter%fastest/filter%joint%frequency)
   end function known

   !> From a sample to the next: what a unit of each of the two states and of the two accelerations becomes
   pure subroutine set_step(filter, dt)
      type(elastic_filter_type), intent(inout) :: filter
      !> Sample interval [s]
      real(wp), intent(in) :: dt

      type(bent_type) :: units(4)
      real(wp) :: angle

      associate (joint => filter%joint, rest => bent_type())
         units(1) = moved(new_elastic_flow(joint, bent_type(1.0_wp, 0.0_wp), 0.0_wp, 0.0_wp))
         units(2) = moved(new_elastic_flow(joint, bent_type(0.0_wp, 1.0_wp), 0.0_wp, 0.0_wp))
         units(3) = moved(new_elastic_flow(joint, rest, 1.0_wp, -1.0_wp/dt))
         units(4) = moved(new_elastic_flow(joint, rest, 0.0_wp, 1.0_wp/dt))
         ! The fourth derivative is less than w^4 (2.1 a + 2 (1 + 1/w dt) L u/J w^2), with a the amplitude: the equation of motion,
         ! derived twice, for the largest damping that there may be.
         angle = joint%frequency*dt
         filter%bulge = [2.1_wp, 2.0_wp*(1.0_wp + 1.0_wp/angle)*joint%lever/joint%frequency**2]*angle**4/384.0_wp
         filter%bulge_of_rate = filter%bulge*(384.0_wp/72.0_wp)/dt
      end associate
      filter%dt = dt
      filter%by_state = reshape([units(1)%x, units(1)%v, units(2)%x, units(2)%v], [2, 2])
      filter%by_ground = reshape([units(3)%x, units(3)%v, units(4)%x, units(4)%v], [2, 2])

   contains

      !> The state after a sample interval
      pure type(bent_type) function moved(flow)
         type(elastic_flow_type), intent(in) :: flow

         moved = flow%at(dt)
      end function moved

   end subroutine set_step

   !> The state at the next sample
   pure type(bent_type) function filter_step(filter, state, here, there) result(next)
      type(elastic_filter_type), intent(in) :: filter
      !> State at a sample
      type(bent_type), intent(in) :: state
      !> Ground acceleration at this sample and at the next [m/s2]
      real(wp), intent(in) :: here, there

      associate (m => filter%by_state, n => filter%by_ground)
         next%x = (m(1, 1)*state%x + m(1, 2)*state%v) + (n(1, 1)*here + n(1, 2)*there)
         next%v = (m(2, 1)*state%x + m(2, 2)*state%v) + (n(2, 1)*here + n(2, 2)*there)
      end associate
   end function filter_step

   !> Look for a new peak, and for a faster passage of X = 0, in a motion
   pure subroutine look_for_largest(filter, flow, begin, duration, state)
      type(elastic_filter_type), intent(inout) :: filter
      type(elastic_flow_type), intent(in) :: flow
      !> Time of its begin, and how long it lasts [s]
      real(wp), intent(in) :: begin, duration
      !> State at its begin
      type(bent_type), intent(in) :: state

      type(bent_type) :: here, next, top
      real(wp) :: step, turn, from, to
      integer :: part, parts

      parts = max(1, ceiling(filter%joint%frequency*duration/longest_angle))
      step = duration/real(parts, wp)
      here = state
      do part = 1, parts
         from = step*real(part - 1, wp)
         to = step*real(part, wp)
         next = flow%at(to)
         if (here%v*next%v < 0.0_wp) then
            turn = flow%time_of(at_turn, 0.0_wp, sign(1.0_wp, next%v), from, to)
            top = flow%at(turn)
            if (abs(top%x) > filter%peak) then
               filter%peak = abs(top%x)
               filter%time_of_peak = begin + turn
            end if
            call look_for_passage(filter, flow, from, turn, here, top)
            call look_for_passage(filter, flow, turn, to, top, next)
         else
            call look_for_passage(filter, flow, from, to, here, next)
         end if
         here = next
      end do
   end subroutine look_for_largest

   !> Look for a faster passage of X = 0 on a way without a turn
   pure subroutine look_for_passage(filter, flow, from, to, here, next)
      type(elastic_filter_type), intent(inout) :: filter
      type(elastic_flow_type), intent(in) :: flow
      !> Times at which it begins and ends [s], and the states there
      real(wp), intent(in) :: from, to
      type(bent_type), intent(in) :: here, next

      type(bent_type) :: middle

      if (.not. here%x*next%x < 0.0_wp) return
      middle = flow%at(flow%time_of(at_level, 0.0_wp, sign(1.0_wp, next%x), from, to))
      filter%fastest = max(filter%fastest, abs(middle%v))
   end subroutine look_for_passage

   !> Whether the whole motion is linear: the joints do not open, and no passage of x = 0 is faster than v_y
   elemental logical function is_whole_motion(self, scale)
      class(elastic_filter_type), intent(in) :: self
      !> Factor on the accelerogram
      real(wp), intent(in) :: scale

      is_whole_motion = abs(scale)*self%peak < self%joint%opening .and. .not. abs(scale)*self%fastest > self%joint%speed
   end function is_whole_motion

   !> State at a sample, under the accelerogram as it is
   pure type(bent_type) function at_sample(self, record, sample) result(state)
      class(elastic_filter_type), intent(in) :: self
      type(record_type), intent(in) :: record
      !> Number of the sample, from 1
      integer, intent(in) :: sample

      integer :: i, block

      block = (sample - 1)/length + 1
      if (sample == size(record%acceleration)) then
         state = self%start(size(self%start))
         return
      end if
      state = self%start(block)
      do i = (block - 1)*length + 1, sample - 1
         state = filter_step(self, state, record%acceleration(i), record%acceleration(i + 1))
      end do
   end function at_sample

   !> Whether a block begins at a sample
   elemental logical function begins_block(self, sample)
      class(elastic_filter_type), intent(in) :: self
      !> Number of the sample, from 1
      integer, intent(in) :: sample

      associate (of => self)
      end associate
      begins_block = modulo(sample - 1, length) == 0
   end function begins_block

   !> Jump over blocks in which the motion stays linear
   pure subroutine jump(self, record, scale, sample, state)
      class(elastic_filter_type), intent(in) :: self
      type(record_type), intent(in) :: record
      !> Factor on it
      real(wp), intent(in) :: scale
      !> In: number of the sample, less than the last; out: that of the first which is not jumped over
      integer, intent(inout) :: sample
      !> State at the sample
      type(bent_type), intent(inout) :: state

      type(bent_type) :: swing
      real(wp) :: bound, decay, damped
      integer :: block, first, last

      last = size(record%acceleration)
      swing = swing_beside(self, record, scale, sample, state)
      decay = self%joint%damping*self%joint%frequency
      damped = self%joint%frequency*sqrt(1.0_wp - self%joint%damping**2)
      bound = sqrt(1.0_wp + self%joint%damping)*hypot(swing%x, (swing%v + decay*swing%x)/damped)
      first = sample
      block = (sample - 1)/length + 1
      do while (sample < last)
         if (.not. abs(scale)*self%reach(block) + bound < self%joint%opening) exit
         ! Of the first block, which may be a part of one, the swing is taken not to decay.
         if (sample > first) bound = bound*self%fading
         sample = min(block*length + 1, last)
         block = block + 1
      end do
      if (sample > first) state = swung(self, record, scale, swing, first, sample)
   end subroutine jump

   !> Go on from sample to sample as long as nothing can happen that is not linear: over blocks, and within one by single steps
   pure subroutine skip(self, record, scale, sample, state)
      class(elastic_filter_type), intent(in) :: self
      type(record_type), intent(in) :: record
      !> Factor on it
      real(wp), intent(in) :: scale
      !> In: number of the sample; out: that at whose beginning something may happen, or the last
      integer, intent(inout) :: sample
      !> State at the sample
      type(bent_type), intent(inout) :: state

      type(bent_type) :: next
      logical :: is_quiet

      do while (sample < size(record%acceleration))
         if (modulo(sample - 1, length) == 0) then
            call self%jump(record, scale, sample, state)
            if (sample == size(record%acceleration)) exit
         end if
         do
            call self%look_ahead(state, scale*record%acceleration(sample), scale*record%acceleration(sample + 1), next, is_quiet)
            if (.not. is_quiet) return
            state = next
            sample = sample + 1
            if (modulo(sample - 1, length) == 0 .or. sample == size(record%acceleration)) exit
         end do
      end do
   end subroutine skip

   !> The state at the next sample, unless something may happen before that is not linear: the joints open, or a passage of x = 0 is
   !> faster than v_y
   elemental subroutine look_ahead(self, state, here, there, next, is_quiet)
      class(elastic_filter_type), intent(in) :: self
      !> State at a sample
      type(bent_type), intent(in) :: state
      !> Ground acceleration at this sample and at the next [m/s2]
      real(wp), intent(in) :: here, there
      !> State at the next, if nothing can happen
      type(bent_type), intent(out) :: next
      logical, intent(out) :: is_quiet

      real(wp) :: ground, room, square, amplitude, bulge, early, late, fastest

      next = filter_step(self, state, here, there)
      associate (w => self%joint%frequency)
         ground = max(abs(here), abs(there))
         room = self%joint%opening - self%push*ground
         square = (w*state%x)**2 + state%v**2
         is_quiet = room > 0.0_wp .and. square < (w*room)**2
         if (is_quiet) return
         ! The Bernstein coefficients of the cubic through both samples are x, early, late and the next x.
         amplitude = sqrt(square)/w + self%push*ground
         bulge = self%bulge(1)*amplitude + self%bulge(2)*ground
         early = state%x + state%v*self%dt*(1.0_wp/3.0_wp)
         late = next%x - next%v*self%dt*(1.0_wp/3.0_wp)
         if (.not. max(max(abs(state%x), abs(early)), max(abs(late), abs(next%x))) + bulge < self%joint%opening) return
         is_quiet = min(min(state%x, early), min(late, next%x)) > bulge .or. max(max(state%x, early), max(late, next%x)) < -bulge
         if (is_quiet) return
         fastest = max(max(abs(state%v), abs(next%v)), 3.0_wp*abs(late - early)/self%dt)
         is_quiet = fastest + (self%bulge_of_rate(1)*amplitude + self%bulge_of_rate(2)*ground) < self%joint%speed
      end associate
   end subroutine look_ahead

   !> State at a later sample of a motion that stays linear
   pure type(bent_type) function linear_state(self, record, scale, first, state, sample) result(later)
      class(elastic_filter_type), intent(in) :: self
      type(record_type), intent(in) :: record
      !> Factor on it
      real(wp), intent(in) :: scale
      !> Number of a sample, and the state there
      integer, intent(in) :: first
      type(bent_type), intent(in) :: state
      !> Number of the later sample
      integer, intent(in) :: sample

      later = swung(self, record, scale, swing_beside(self, record, scale, first, state), first, sample)
   end function linear_state

   !> What the motion at a sample has beside that of the filter
   pure type(bent_type) function swing_beside(self, record, scale, sample, state) result(swing)
      class(elastic_filter_type), intent(in) :: self
      type(record_type), intent(in) :: record
      !> Factor on it
      real(wp), intent(in) :: scale
      !> Number of the sample, and the state there
      integer, intent(in) :: sample
      type(bent_type), intent(in) :: state

      type(bent_type) :: forced

      forced = self%at_sample(record, sample)
      swing = bent_type(state%x - scale*forced%x, state%v - scale*forced%v)
   end function swing_beside

   !> State at a later sample of a motion that has a free swing beside that of the filter
   pure type(bent_type) function swung(self, record, scale, swing, first, sample) result(state)
      class(elastic_filter_type), intent(in) :: self
      type(record_type), intent(in) :: record
      !> Factor on it
      real(wp), intent(in) :: scale
      !> The free swing at the first sample
      type(bent_type), intent(in) :: swing
      !> Numbers of the two samples
      integer, intent(in) :: first, sample

      type(elastic_flow_type) :: flow
      type(bent_type) :: forced, left

      flow = new_elastic_flow(self%joint, swing, 0.0_wp, 0.0_wp)
      left = flow%at(real(sample - first, wp)*record%dt)
      forced = self%at_sample(record, sample)
      state = bent_type(scale*forced%x + left%x, scale*forced%v + left%v)
   end function swung

end module dondolo_motion_elastic_filter
