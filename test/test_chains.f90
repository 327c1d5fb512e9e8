!> Chains of bounces: their closed sums, and the rule that ends them (docs/theory.md, section 4), against bounces
!> that are integrated one by one.
program test_chains
   use checks, only : check, check_close, finish, suite
   use dondolo_base_kinds, only : wp
   use dondolo_motion_adaptive_step, only : advance, motion_type
   use dondolo_motion_dormand_prince, only : angular_acceleration, excitation_type
   use dondolo_motion_events, only : impact
   use dondolo_motion_initial_state, only : initial_state_type
   use dondolo_motion_response, only : response_type, trace_type
   use dondolo_motion_rest, only : bounce_type, new_rest, rest_type
   use dondolo_motion_rk45, only : simulate_rk45
   use dondolo_motion_wall_constants, only : new_wall_constants, wall_constants_type
   use dondolo_record, only : record_type
   use dondolo_record_random, only : new_random, random_type
   use dondolo_wall, only : wall_type
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_single_block, only : one_sided_restitution
   use linear_block, only : new_linear_block
   use motion_inputs, only : a_wall, accelerogram, made, stillness, tight
   implicit none

   call test_time_to_rest()
   call test_closed_sums()
   call test_rule()
   call test_rule_of_both()
   call test_worst_case()
   call test_rest_is_kept()
   call finish()

contains

   !> Speed of an impact after which the wall rises to a part of the height up to which the rule looks
   real(wp) function speed_for(rest, part) result(speed)
      type(rest_type), intent(in) :: rest
      real(wp), intent(in) :: part

      speed = sqrt(2.0_wp*part*rest%height*rest%moment/rest%inertia)
   end function speed_for

   !> Integrate bounces from an impact at the first sample until their speed is all but gone or the record is over:
   !> the time that takes and the largest rotation
   subroutine let_bounce(mechanism, record, speed, duration, highest, ended)
      class(mechanism_type), intent(in) :: mechanism
      type(record_type), intent(in) :: record
      real(wp), intent(in) :: speed
      real(wp), intent(out) :: duration, highest
      logical, intent(out) :: ended
      real(wp), parameter :: all_but_gone = 1.0e-10_wp
      type(wall_constants_type) :: constants
      type(motion_type) :: motion
      logical :: sample_reached
      integer :: event, i

      constants = new_wall_constants(mechanism, tight(1.0_wp))
      ended = .false.
      motion%v = speed
      motion%step = record%dt
      intervals: do i = 1, size(record%acceleration) - 1
         motion%interval = i
         motion%time = 0.0_wp
         motion%excitation%start = motion%side*record%acceleration(i)
         motion%excitation%slope = motion%side*(record%acceleration(i + 1) - record%acceleration(i))/record%dt
         if (allocated(record%vertical)) then
            motion%excitation%heavier = record%vertical(i)/mechanism%gravity
            motion%excitation%heavier_slope = (record%vertical(i + 1) - record%vertical(i))/(mechanism%gravity*record%dt)
         end if
         motion%f = angular_acceleration(mechanism, motion%excitation, 0.0_wp, motion%q, motion%v)
         sample_reached = .false.
         do while (.not. sample_reached)
            call advance(mechanism, constants, record%dt, motion, event, sample_reached)
            motion%peak = max(motion%peak, motion%q)
            if (event /= impact) cycle
            motion%v = -mechanism%restitution*motion%v
            if (mechanism%two_sided) then
               motion%side = -motion%side
               motion%excitation = excitation_type(-motion%excitation%start, -motion%excitation%slope, &
                  & motion%excitation%heavier, motion%excitation%heavier_slope)
            end if
            motion%f = angular_acceleration(mechanism, motion%excitation, motion%time, motion%q, motion%v)
            ended = motion%v < all_but_gone*speed
            if (ended) exit intervals
         end do
      end do intervals
      duration = (min(i, size(record%acceleration) - 1) - 1)*record%dt + motion%time
      highest = motion%peak
   end subroutine let_bounce

   !> Duration of a chain under constant moments: 2 w (1/a_1 + e/a_2)/(1 - e^2), which is 2 w/(a (1 - e)) to one side
   real(wp) function closed_sum(rest, acceleration, speed)
      type(rest_type), intent(in) :: rest
      real(wp), intent(in) :: acceleration, speed
      real(wp) :: first, second

      first = rest%inward_moment(1.0_wp, acceleration)/rest%inertia
      second = first
      if (rest%two_sided) second = rest%inward_moment(-1.0_wp, acceleration)/rest%inertia
      closed_sum = 2.0_wp*speed*(1.0_wp/first + rest%restitution/second)/(1.0_wp - rest%restitution**2)
   end function closed_sum

   !> The linear block with one side, alpha = 0.1 rad, released from alpha/2: the fall and all flights after it last
   !> acosh(2)/p + sum over n of 2 atanh(e^n sqrt(3/4))/p
   subroutine test_time_to_rest()
      real(wp), parameter :: p = 2.0_wp, alpha = 0.1_wp
      real(wp) :: e, duration, highest
      logical :: ended

      call suite('time to rest')
      e = -one_sided_restitution(alpha)
      call check_close(e, 0.470655_wp, 0.0_wp, 'speed ratio', 5.0e-7_wp)
      call let_bounce(new_linear_block(p, alpha, e, .false.), stillness(3.0_wp), e*p*alpha*sqrt(0.75_wp), duration, &
         & highest, ended)
      call check(ended, 'the bounces end')
      call check_close(acosh(2.0_wp) + p*duration, 2.912595889_wp, 0.0_wp, 'p T', 1.0e-9_wp)
      call check_close(highest/alpha, 0.0868391703_wp, 0.0_wp, 'the first of them is the highest', 5.0e-11_wp)
   end subroutine test_time_to_rest

   !> Constant ground acceleration: the sum of the bounces, and the bound of the rule a little above it
   subroutine test_closed_sums()
      real(wp), parameter :: pushes(5) = [0.0_wp, 0.5_wp, -0.5_wp, 0.9_wp, -0.9_wp]
      type(wall_type) :: wall
      type(rest_type) :: rest
      real(wp) :: acceleration, speed, duration, highest, expected, bound
      logical :: ended
      integer :: i, m

      call suite('sums of bounces')
      do m = 1, 4
         wall = a_wall(m)
         rest = new_rest(wall%mechanism)
         do i = 1, size(pushes)
            acceleration = pushes(i)*wall%mechanism%trigger_acceleration()
            ! So low that the moments are all but constant.
            speed = speed_for(rest, 1.0e-5_wp)
            expected = closed_sum(rest, acceleration, speed)
            call let_bounce(wall%mechanism, accelerogram(spread(acceleration, 1, 21), 0.1_wp*expected), speed, &
               & duration, highest, ended)
            call check(ended, 'the bounces end')
            call check_close(duration, expected, 1.0e-6_wp, 'duration of the chain')
            bound = least_time([acceleration, acceleration], rest, speed, expected)
            call check(bound >= expected .and. bound <= 1.06_wp*expected, 'the bound is little more')
         end do
      end do
   end subroutine test_closed_sums

   !> The shortest sample interval with which the rule finds rest before the last sample, where both sides open
   real(wp) function least_time(a, rest, speed, scale, vertical) result(dt)
      real(wp), intent(in) :: a(:)
      real(wp), intent(in), optional :: vertical(:)
      type(rest_type), intent(in) :: rest
      real(wp), intent(in) :: speed, scale
      real(wp) :: bounds(2)
      integer :: i

      bounds = scale*[0.0_wp, 100.0_wp]
      do i = 1, 60
         dt = 0.5_wp*sum(bounds)
         if (finds_rest(a, rest, speed, dt, vertical)) then
            bounds(2) = dt
         else
            bounds(1) = dt
         end if
      end do
      dt = bounds(2)
   end function least_time

   !> Does the rule find that a chain ends at rest before the end of these samples?
   logical function finds_rest(a, rest, speed, dt, vertical)
      real(wp), intent(in) :: a(:), speed, dt
      type(rest_type), intent(in) :: rest
      real(wp), intent(in), optional :: vertical(:)
      type(record_type) :: record
      real(wp) :: opening
      integer :: stopper

      opening = -2.0_wp*rest%moment/rest%lever
      record = accelerogram([a, opening, opening], dt)
      if (present(vertical)) record%vertical = [vertical, 0.0_wp, 0.0_wp]
      stopper = 0
      call rest%chain_ends(record, 1.0_wp, bounce_type(1, 0.0_wp, 1.0_wp, speed, huge(dt)), stopper, finds_rest)
   end function finds_rest

   !> Random accelerograms that keep all moments positive: where the rule finds rest, with not a bit of time to
   !> spare, the bounces that are integrated have ended, and rose no higher than it says
   subroutine test_rule()
      integer, parameter :: samples = 6, trials = 60
      type(random_type) :: random
      type(wall_type) :: wall
      type(rest_type) :: rest
      real(wp) :: a(samples), speed, dt, duration, highest
      logical :: ended
      integer :: i, k, m, found

      call suite('the rule that ends chains')
      random = new_random(20260102, 0)
      do m = 1, 4
         wall = a_wall(m)
         rest = new_rest(wall%mechanism)
         found = 0
         do k = 1, trials
            do i = 1, samples
               a(i) = (1.96_wp*random%next() - 0.98_wp)*wall%mechanism%trigger_acceleration()
            end do
            speed = speed_for(rest, 10.0_wp**(-4.0_wp*random%next()))
            dt = closed_sum(rest, 0.0_wp, speed)/samples
            if (.not. finds_rest(a, rest, speed, 100.0_wp*dt)) cycle
            found = found + 1
            dt = least_time(a, rest, speed, dt)
            call let_bounce(wall%mechanism, accelerogram(a, dt), speed, duration, highest, ended)
            call check(ended, 'the chain has ended')
            call check(highest <= rest%height, 'it stayed low')
         end do
         call check(found > trials/4, 'the rule finds rest')
      end do
   end subroutine test_rule

   !> The same under both components
   subroutine test_rule_of_both()
      integer, parameter :: samples = 6, trials = 60
      type(random_type) :: random
      type(wall_type) :: wall
      type(rest_type) :: rest
      type(record_type) :: record
      real(wp) :: a(samples), v(samples), speed, dt, duration, highest, without, with
      logical :: ended
      integer :: i, k, m, found

      call suite('the rule that ends chains, both components')
      random = new_random(20260103, 0)
      do m = 1, 4
         wall = a_wall(m)
         rest = new_rest(wall%mechanism)
         found = 0
         do k = 1, trials
            do i = 1, samples
               a(i) = (1.2_wp*random%next() - 0.6_wp)*wall%mechanism%trigger_acceleration()
               v(i) = 7.0_wp*random%next() - 3.5_wp
            end do
            speed = speed_for(rest, 10.0_wp**(-4.0_wp*random%next()))
            dt = closed_sum(rest, 0.0_wp, speed)/samples
            if (.not. finds_rest(a, rest, speed, 100.0_wp*dt, v)) cycle
            found = found + 1
            dt = least_time(a, rest, speed, dt, v)
            record = accelerogram(a, dt)
            record%vertical = v
            call let_bounce(wall%mechanism, record, speed, duration, highest, ended)
            call check(ended, 'the chain has ended')
            call check(highest <= rest%height, 'it stayed low')
         end do
         call check(found > trials/4, 'the rule finds rest')
         ! A ground that falls lets the chain last longer, and the rule knows.
         speed = speed_for(rest, 1.0e-3_wp)
         a = 0.0_wp
         dt = closed_sum(rest, 0.0_wp, speed)/samples
         without = least_time(a, rest, speed, dt)
         with = least_time(a, rest, speed, dt, spread(-3.0_wp, 1, samples))
         call check(with > without, 'falling ground')
      end do
   end subroutine test_rule_of_both

   !> The moment is small, grows eightfold at the top of the first flight and is small again from the next impact
   !> on: the speed grows nearly by the root of eight, which a rule that knows only the least moment would not see
   subroutine test_worst_case()
      integer, parameter :: parts = 40, longest = 4000
      real(wp), parameter :: low = 0.2_wp, high = 1.6_wp
      type(wall_type) :: wall
      type(rest_type) :: rest
      real(wp) :: a(longest), speed, dt, flight, duration, highest, without_rises
      logical :: ended
      integer :: n

      call suite('the worst chain')
      wall = made('one_sided', 3.0_wp, 0.25_wp, 0.9_wp)
      rest = new_rest(wall%mechanism)
      speed = speed_for(rest, 1.0e-3_wp)
      flight = 2.0_wp*speed*rest%inertia/(low*rest%moment)
      dt = flight/parts
      a = low
      ! Sample parts/2 + 1 is the top; a fall with eight times the moment takes 0.35 of the rise.
      a(parts/2 + 2:parts/2 + 1 + int(0.35_wp*0.5_wp*parts)) = high
      a = (a - 1.0_wp)*wall%mechanism%trigger_acceleration()
      do n = 2, longest
         if (finds_rest(a(:n), rest, speed, dt)) exit
      end do
      call check(n < longest, 'the rule finds rest')
      call let_bounce(wall%mechanism, accelerogram(a(:n), dt), speed, duration, highest, ended)
      call check(ended .and. highest <= rest%height, 'the chain has ended, and stayed low')
      without_rises = 2.0_wp*speed*rest%inertia/(low*rest%moment*(1.0_wp - 0.9_wp))
      call check(duration > 1.5_wp*without_rises, 'it lasts longer than the least moment says')
   end subroutine test_worst_case

   !> In still ground a wall that is let go comes to rest and stays there
   subroutine test_rest_is_kept()
      type(wall_type) :: wall
      type(response_type) :: response
      type(trace_type) :: trace
      integer :: m, row

      call suite('rest is kept')
      do m = 1, 4
         wall = a_wall(m)
         trace%rows = 0
         call simulate_rk45(wall%mechanism, stillness(60.0_wp), 1.0_wp, tight(1.0_wp), response, trace, &
            & initial=initial_state_type(0.3_wp*wall%mechanism%capacity))
         row = findloc(trace%rotation == 0.0_wp .and. trace%velocity == 0.0_wp, .true., dim=1)
         call check(row > 0, 'it comes to rest')
         call check(all(trace%rotation(row:) == 0.0_wp .and. trace%velocity(row:) == 0.0_wp), 'it stays at rest')
      end do
   end subroutine test_rest_is_kept

end program test_chains
