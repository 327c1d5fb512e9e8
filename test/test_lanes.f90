!> The engine lanes against the engine rk45 and against closed forms, and what must not change its results: place,
!> neighbours, order, threads.
program test_lanes
   use checks, only : check, check_close, check_ok, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_motion_error_estimate, only : estimated_error, other_run, runs_of_estimate
   use dondolo_motion_response, only : response_type
   use dondolo_motion_rk45, only : simulate_rk45
   use dondolo_motion_simulate, only : simulate
   use dondolo_motion_solver, only : solver_type
   use dondolo_motion_work, only : work_type
   use dondolo_record, only : record_type
   use dondolo_record_random, only : new_random, random_type
   use dondolo_wall, only : wall_type
   use dondolo_wall_mechanism, only : mechanism_type
   use lane_runs, only : run_alone, run_lanes, runs_in_lanes
   use linear_block, only : linear_block_type, new_linear_block
   use motion_inputs, only : a_wall, accelerogram, loose, made, tight
   use random_history, only : across, between, choice, history_type, new_history, random_record
   use same_response, only : is_same
   implicit none

   real(wp), parameter :: p = 2.0_wp, alpha = 0.1_wp, e = 0.7_wp

   !> The block to both sides; in closed form it moves as the block to one
   type(linear_block_type) :: block

   !> Bits by which numbers are moved off their place
   integer :: bits

   block = new_linear_block(p, alpha, e, .true.)
   call test_random_histories()
   call test_order()
   call test_impact_on_a_sample()
   call test_peak_on_a_sample()
   call test_limit()
   call test_start()
   call test_bounces_in_a_sample()
   call test_turn_below_the_peak()
   call test_grazing()
   call test_edges()
   call test_time_steps()
   call test_restitution()
   call test_places()
   call test_counts()
   call test_estimate()
   call finish()

contains

   !> The linear block under outward pushes x at the samples, in lanes and by rk45
   subroutine compare(two_sided, x, dt, solver, tolerance, what, response)
      logical, intent(in) :: two_sided
      real(wp), intent(in) :: x(:), dt, tolerance
      type(solver_type), intent(in) :: solver
      character(len=*), intent(in) :: what
      type(response_type), intent(out), optional :: response
      type(linear_block_type) :: linear
      type(response_type) :: lane

      linear = new_linear_block(p, alpha, e, two_sided)
      call compare_engines(linear, accelerogram(-x*linear%trigger_acceleration(), dt), 1.0_wp, solver, tolerance, &
         & what, lane)
      if (present(response)) response = lane
   end subroutine compare

   !> One history in lanes and by rk45
   subroutine compare_engines(mechanism, record, scale, solver, tolerance, what, response)
      class(mechanism_type), intent(in) :: mechanism
      type(record_type), intent(in) :: record
      real(wp), intent(in) :: scale, tolerance
      type(solver_type), intent(in) :: solver
      character(len=*), intent(in) :: what
      type(response_type), intent(out), optional :: response
      type(response_type) :: lane, other

      call run_alone(mechanism, record, scale, solver, lane)
      call simulate_rk45(mechanism, record, scale, solver, other)
      call check(lane%collapsed .eqv. other%collapsed, what//': collapse')
      call check_close(lane%edp, other%edp, tolerance, what//': EDP', 1.0e-14_wp)
      ! The time of a peak is the root of a derivative.
      call check_close(lane%time_of_peak, other%time_of_peak, 1.0e-7_wp + tolerance, what//': time of the peak')
      if (present(response)) response = lane
   end subroutine compare_engines

   !> Random histories at tight tolerances: flags, and EDPs that no small change moves far
   subroutine test_random_histories()
      integer, parameter :: histories = 400
      type(history_type) :: history
      type(response_type) :: lane, other
      type(error_type), allocatable :: refused
      real(wp) :: error
      integer :: i, sure

      call suite('random histories')
      sure = 0
      do i = 1, histories
         history = new_history(50000 + i)
         history%solver%rtol = 1.0e-12_wp
         history%solver%atol = 1.0e-14_wp
         history%solver%estimate_error = .true.
         if (.not. runs_in_lanes(history%wall%mechanism, history%solver)) cycle
         call run_alone(history%wall%mechanism, history%record, history%scale, history%solver, lane)
         history%solver%engine = 'rk45'
         call simulate(history%wall%mechanism, history%record, history%scale, history%solver, other, refused)
         call check_ok(refused, to_text(50000 + i))
         if (lane%is_ill_conditioned() .or. other%is_ill_conditioned()) cycle
         sure = sure + 1
         call check((lane%collapsed .eqv. other%collapsed) .or. other%is_unsure(history%solver%edp_limit), &
            & to_text(50000 + i)//': collapse')
         error = max(lane%edp_error, other%edp_error)
         call check_close(lane%edp, other%edp, 1.0e-10_wp, to_text(50000 + i)//': EDP', 1.0e-13_wp + 20.0_wp*error)
         ! Some collapse in slow motion.
         if (lane%collapsed .and. other%collapsed .and. error == 0.0_wp) call check_close(lane%time_of_peak, &
            & other%time_of_peak, 1.0e-5_wp, to_text(50000 + i)//': time of the collapse')
      end do
      call check(sure > (3*histories)/4, 'most of them are well-conditioned: '//to_text(sure))
   end subroutine test_random_histories

   !> Steps of a half, a quarter, an eighth of a long sample interval. The series goes to t^9, but leaves out the fifth
   !> derivatives of a and b, which are small
   subroutine test_order()
      type(wall_type) :: wall
      type(solver_type) :: solver
      type(response_type) :: exact, response
      real(wp) :: error(4), order
      integer :: i, m

      call suite('order')
      do m = 1, 3
         if (m == 1) wall = made('one_sided', 2.0_wp, 1.0_wp)
         if (m == 2) wall = made('free_standing', 3.0_wp, 0.25_wp)
         if (m == 3) wall = made('two_block', 3.0_wp, 0.4_wp)
         solver = tight(1.0_wp)
         solver%steps_per_sample = 64
         call run_pushed(wall%mechanism, solver, exact)
         call check(exact%edp > 0.1_wp .and. .not. exact%collapsed, 'it rocks')
         solver = loose(1.0_wp)
         do i = 1, size(error)
            solver%steps_per_sample = 2**(i - 1)
            call run_pushed(wall%mechanism, solver, response)
            error(i) = abs(response%edp - exact%edp)
         end do
         call check(error(1) > 1.0e-9_wp, 'a first error above rounding: '//to_text(error(1)))
         order = log(error(1)/error(4))/log(8.0_wp)
         call check(order > 5.5_wp, 'order '//to_text(order))
      end do
   end subroutine test_order

   !> Pushed out from the first sample on for two intervals, then left alone: the peak follows from the energy
   subroutine run_pushed(mechanism, solver, response)
      class(mechanism_type), intent(in) :: mechanism
      type(solver_type), intent(in) :: solver
      type(response_type), intent(out) :: response
      real(wp), parameter :: push(3) = [-1.0_wp, -1.6_wp, -0.2_wp]

      call run_alone(mechanism, accelerogram(push*mechanism%trigger_acceleration(), &
         & 0.8_wp/mechanism%frequency_parameter()), 1.0_wp + 1.0e-9_wp, solver, response)
   end subroutine run_pushed

   !> The first sample interval for which a time lies on sample k, by bisection
   real(wp) function interval_for(time_of, k) result(dt)
      interface
         pure real(wp) function time_of(dt)
            import :: wp
            real(wp), intent(in) :: dt
         end function time_of
      end interface
      integer, intent(in) :: k
      real(wp) :: low, high
      integer :: i

      low = 1.0e-2_wp
      high = 0.6_wp
      do i = 1, digits(dt)
         dt = 0.5_wp*(low + high)
         if (time_of(dt) > k*dt) then
            high = dt
         else
            low = dt
         end if
      end do
   end function interval_for

   !> State after pushes of 2, 2, 0
   pure function pushed(dt) result(state)
      real(wp), intent(in) :: dt
      real(wp) :: state(2)

      state = block%motion([0.0_wp, 0.0_wp], 2.0_wp, 0.0_wp, dt)
      state = block%motion(state, 2.0_wp, -2.0_wp/dt, dt)
   end function pushed

   !> Time of the peak after them; beyond the speed that overturns it never comes back
   pure real(wp) function time_of_peak(dt)
      real(wp), intent(in) :: dt
      real(wp) :: state(2), peak(2)

      state = pushed(dt)
      time_of_peak = huge(dt)
      if (.not. state(2) < p*(alpha - state(1))) return
      peak = block%peak_after(state)
      time_of_peak = 2.0_wp*dt + peak(1)
   end function time_of_peak

   !> Time of the impact after that: the fall from the peak takes acosh(alpha/(alpha - peak))/p
   pure real(wp) function time_of_impact(dt)
      real(wp), intent(in) :: dt
      real(wp) :: peak(2)

      time_of_impact = time_of_peak(dt)
      if (time_of_impact > 1.0e3_wp) return
      peak = block%peak_after(pushed(dt))
      time_of_impact = time_of_impact + acosh(alpha/(alpha - peak(2)))/p
   end function time_of_impact

   !> The impact falls on a sample, or some bits before or after it; then the ground pushes again
   subroutine test_impact_on_a_sample()
      type(response_type) :: response
      real(wp) :: dt, side
      integer :: k, m

      call suite('an impact on a sample')
      do m = 1, 2
         side = merge(1.0_wp, -1.0_wp, m == 1)
         do k = 6, 14
            do bits = -5, 5
               dt = interval_for(time_of_impact, k)*(1.0_wp + bits*epsilon(dt))
               call compare(m == 2, [2.0_wp, 2.0_wp, spread(0.0_wp, 1, k - 1), side*[2.0_wp, 2.5_wp, 0.0_wp, 0.0_wp]], &
                  & dt, tight(1.0_wp), 1.0e-9_wp, 'sample '//to_text(k), response)
               call check(response%impacts >= 1, 'it is seen')
               ! The last sample is the impact.
               call compare(m == 2, [2.0_wp, 2.0_wp, spread(0.0_wp, 1, k - 1)], dt, tight(1.0_wp), 1.0e-10_wp, &
                  & 'the last sample', response)
               call check_close(response%time_of_peak, time_of_peak(dt), 1.0e-8_wp, 'the peak is the first')
            end do
         end do
      end do
   end subroutine test_impact_on_a_sample

   !> The peak falls on a sample
   subroutine test_peak_on_a_sample()
      type(response_type) :: response
      real(wp) :: dt, peak(2)
      integer :: k, extra

      call suite('a peak on a sample')
      do k = 4, 8
         do bits = -5, 5
            dt = interval_for(time_of_peak, k)*(1.0_wp + bits*epsilon(dt))
            peak = block%peak_after(pushed(dt))
            do extra = 0, 2, 2
               call compare(.true., [2.0_wp, 2.0_wp, spread(0.0_wp, 1, k + extra - 1)], dt, tight(1.0_wp), 1.0e-10_wp, &
                  & 'peak on '//to_text(k), response)
               call check_close(response%edp, peak(2)/alpha, 1.0e-10_wp, 'EDP')
               call check_close(response%time_of_peak, time_of_peak(dt), 1.0e-7_wp, 'time')
            end do
         end do
      end do
   end subroutine test_peak_on_a_sample

   !> A push of 2 from the first sample on reaches the limit where p t = acosh(1 + limit): within a step from rest,
   !> within a later one, on a sample, in the last interval, after the record; small limits are reached at once
   subroutine test_limit()
      real(wp), parameter :: parts(10) = [0.013_wp, 0.3_wp, 0.7_wp, 1.0_wp, 1.4_wp, 2.0_wp, 3.0_wp, 7.0_wp, 16.0_wp, &
         & 50.0_wp]
      type(response_type) :: response
      real(wp) :: limit, time, dt, rise
      integer :: i, k, extra

      call suite('the limit')
      do i = 1, size(parts)
         do k = -8, 3
            limit = 0.5_wp*k
            if (k <= 0) limit = 10.0_wp**(k - 1)
            ! acosh(1 + x), without the loss of digits for small x
            time = 2.0_wp*asinh(sqrt(0.5_wp*limit))/p
            do bits = -3, 3
               dt = time/parts(i)*(1.0_wp + bits*epsilon(dt))
               do extra = 0, 2, 2
                  call run_alone(block, accelerogram(spread(-2.0_wp*block%trigger_acceleration(), 1, &
                     & 1 + ceiling(parts(i) - 1.0e-9_wp) + extra), dt), 1.0_wp, tight(limit), response)
                  call check(response%collapsed .and. response%edp == limit, 'collapse')
                  call check_close(response%time_of_peak, time, 1.0e-10_wp, 'its time, '//to_text(parts(i))//' '// &
                     & to_text(limit))
               end do
            end do
         end do
      end do
      ! A push that rises from 1: alpha (sinh(p t) - p t) r/p is reached in the first step from rest.
      do k = 1, 6
         limit = 10.0_wp**(-k)
         do i = 1, 4
            rise = 10.0_wp**i
            call compare(.true., [1.0_wp, 1.0_wp + rise], 1.0_wp, tight(limit), 1.0e-10_wp, 'rising push', response)
            call check(response%collapsed, 'reached in the first step')
            time = response%time_of_peak
            call check_close(rise*(sinh(p*time) - p*time)/p, limit, 1.0e-6_wp, 'the limit by the closed form')
         end do
      end do
   end subroutine test_limit

   !> Starts on a sample, on the first, in the last interval, in a record of two samples
   subroutine test_start()
      type(response_type) :: response
      real(wp) :: dt, scale, last, crossing, peak(2)
      integer :: i, k, m

      call suite('a start')
      do m = 1, 2
         do i = 1, 5
            dt = 0.3_wp*10.0_wp**(1 - i)
            do bits = -5, 5
               scale = 1.0_wp + bits*epsilon(dt)
               call compare(m == 2, scale*[0.0_wp, 0.5_wp, 1.0_wp, 2.0_wp, 1.0_wp], dt, tight(5.0_wp), 1.0e-9_wp, &
                  & 'on the third sample')
               call compare(m == 2, scale*[1.0_wp, 2.0_wp, 1.0_wp], dt, tight(5.0_wp), 1.0e-9_wp, 'on the first')
               call compare(m == 2, scale*[1.0_wp, 2.0_wp], dt, tight(5.0_wp), 1.0e-9_wp, 'in two samples')
               call compare(m == 2, scale*[1.0_wp, 0.0_wp, 1.0_wp, 0.5_wp], dt, tight(5.0_wp), 1.0e-9_wp, 'a touch', &
                  & response)
               call check(response%edp < 1.0e-12_wp, 'a touch moves nothing')
            end do
         end do
      end do
      do i = 1, 3
         dt = 0.3_wp*10.0_wp**(1 - i)
         do k = 1, 2
            last = 1.0_wp + 10.0_wp**(1 - k)
            crossing = dt/last
            peak = block%peak_after(block%motion([0.0_wp, 0.0_wp], 1.0_wp, last/dt, dt - crossing))
            call compare(.true., [0.0_wp, 0.0_wp, 0.0_wp, last], dt, tight(1.0_wp), 1.0e-9_wp, 'last interval', &
               & response)
            call check_close(response%edp, peak(2)/alpha, 1.0e-8_wp, 'EDP', 1.0e-15_wp)
            call check_close(response%time_of_peak, 3.0_wp*dt + peak(1), 1.0e-9_wp, 'time of the peak')
         end do
      end do
   end subroutine test_start

   !> Long sample intervals: a wall is pushed, falls back and bounces many times before the next sample
   subroutine test_bounces_in_a_sample()
      type(response_type) :: response
      real(wp) :: push
      integer :: k, m

      call suite('bounces in a sample')
      do m = 1, 2
         do k = 1, 20
            push = 1.0_wp + 0.02_wp*k
            call compare(m == 2, [0.0_wp, push, -0.9_wp, 0.9_wp, 0.3_wp, push, -push], 0.5_wp, tight(1.0_wp), &
               & 1.0e-8_wp, 'push of '//to_text(push), response)
            if (m == 2 .and. k < 16) call check(response%impacts > 6, 'more impacts than samples')
         end do
      end do
   end subroutine test_bounces_in_a_sample

   !> Between two impacts within one step a wall turns below its peak, which stays what it was
   subroutine test_turn_below_the_peak()
      type(response_type) :: response
      real(wp) :: first, push
      integer :: k

      call suite('a turn below the peak')
      do k = 1, 20
         ! Pushed, then held inwards, and far out once the record is over: the Bernstein form of that step is high.
         push = 1.0_wp + 0.05_wp*k
         call compare(.true., [0.0_wp, push, -0.95_wp], 0.1_wp, tight(1.0_wp), 1.0e-9_wp, 'first', response)
         first = response%edp
         call compare(.true., [0.0_wp, push, -0.95_wp, 0.95_wp, -0.95_wp, 0.95_wp, -0.95_wp], 0.1_wp, tight(1.0_wp), &
            & 1.0e-9_wp, 'and more', response)
         call check(response%edp >= first*(1.0_wp - 1.0e-12_wp), 'a peak is never lost')
      end do
   end subroutine test_turn_below_the_peak

   !> A second pulse, bisected to the last bit between an impact and none: the motion after is the same but for the root
   !> of the error of a step
   subroutine test_grazing()
      type(response_type) :: hit, missed, trial
      real(wp) :: bounds(2), middle
      integer :: m

      call suite('a grazing impact')
      do m = 1, 2
         bounds = [0.0_wp, 10.0_wp]
         do
            middle = 0.5_wp*sum(bounds)
            if (middle <= bounds(1) .or. middle >= bounds(2)) exit
            call run_grazing(m == 2, middle, trial)
            bounds(merge(1, 2, trial%impacts > 0)) = middle
         end do
         call run_grazing(m == 2, bounds(1), hit)
         call run_grazing(m == 2, bounds(2), missed)
         call check(hit%impacts > 0 .and. missed%impacts == 0, 'an impact on one side, none on the other')
         call check(missed%edp > 0.3_wp .and. .not. missed%collapsed, 'the wall goes on rocking')
         call check_close(hit%edp, missed%edp, 1.0e-7_wp, 'EDP across the edge')
      end do
   end subroutine test_grazing

   !> Pushed out, falling back, and pushed out again by a pulse of some size
   subroutine run_grazing(two_sided, pulse, response)
      logical, intent(in) :: two_sided
      real(wp), intent(in) :: pulse
      type(response_type), intent(out) :: response

      call run_alone(new_linear_block(p, alpha, e, two_sided), accelerogram(-block%trigger_acceleration()* &
         & [2.0_wp, 2.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, pulse, 6.0_wp, 0.0_wp], 0.1_wp), 1.0_wp, tight(1.0_wp), response)
   end subroutine run_grazing

   !> Samples that are the trigger, its negative or nothing, to the bit and some bits off
   subroutine test_edges()
      type(random_type) :: random
      type(response_type) :: lane, other
      real(wp) :: x(60)
      integer :: i, j, m

      call suite('edges of the threshold')
      random = new_random(99, 0)
      do m = 1, 2
         do i = 1, 60
            x = [(real(choice(random, 3) - 2, wp), j=1, size(x))]
            if (choice(random, 3) == 1) x(choice(random, size(x))) = 1.0_wp + across(random, 1.0e-12_wp, 1.0e-3_wp)
            do bits = -2, 2
               call run_alone(new_linear_block(p, alpha, e, m == 2), &
                  & accelerogram(-x*block%trigger_acceleration(), 0.01_wp), 1.0_wp + bits*epsilon(e), tight(1.0_wp), &
                  & lane)
               call simulate_rk45(new_linear_block(p, alpha, e, m == 2), &
                  & accelerogram(-x*block%trigger_acceleration(), 0.01_wp), 1.0_wp + bits*epsilon(e), tight(1.0_wp), &
                  & other)
               call check_close(lane%edp, other%edp, 1.0e-6_wp, 'EDP', 1.0e-13_wp)
            end do
         end do
      end do
   end subroutine test_edges

   !> The same function of time with 0.0005 s and 0.5 s from sample to sample, and a record of 1e5 samples
   subroutine test_time_steps()
      type(wall_type) :: wall
      type(response_type) :: coarse, fine
      real(wp) :: a(13), b(12001)
      real(wp), allocatable :: long(:)
      integer :: i, m

      call suite('time steps')
      a = [(2.5_wp*sin(1.3_wp*i)*cos(0.4_wp*i), i=1, 13)]
      b = [(a(1 + i/1000) + (a(min(13, 2 + i/1000)) - a(1 + i/1000))*modulo(i, 1000)/1000.0_wp, i=0, 12000)]
      do m = 1, 4
         wall = a_wall(m)
         call run_alone(wall%mechanism, accelerogram(a, 0.5_wp), 1.2_wp*m, tight(1.0_wp), coarse)
         call run_alone(wall%mechanism, accelerogram(b, 0.0005_wp), 1.2_wp*m, tight(1.0_wp), fine)
         call check(fine%edp > 0.0_wp .and. (coarse%collapsed .eqv. fine%collapsed), 'it moves')
         call check_close(fine%edp, coarse%edp, 1.0e-9_wp, 'EDP of wall '//to_text(m))
         call check_close(fine%time_of_peak, coarse%time_of_peak, 1.0e-8_wp, 'time of the peak')
      end do
      allocate(long(100000))
      long = [(1.3_wp*sin(0.031_wp*i)*sin(0.00057_wp*i), i=1, size(long))]
      do m = 1, 2
         wall = a_wall(m)
         call compare_engines(wall%mechanism, accelerogram(long, 0.005_wp), 0.75_wp*m**2, tight(1.0_wp), 1.0e-6_wp, &
            & '1e5 samples')
      end do
   end subroutine test_time_steps

   !> Restitutions from none to next to 1
   subroutine test_restitution()
      real(wp), parameter :: ratios(5) = [0.0_wp, 1.0e-300_wp, 0.5_wp, 0.99_wp, 0.9999_wp]
      type(wall_type) :: wall
      integer :: i, j, m

      call suite('restitution')
      do i = 1, size(ratios)
         do m = 1, 2
            wall = made(merge('one_sided    ', 'free_standing', m == 1), 3.0_wp, 0.25_wp, ratios(i))
            call compare_engines(wall%mechanism, accelerogram([(1.2_wp*sin(0.3_wp*j), j=1, 100)], 0.01_wp), 1.0_wp, &
               & tight(1.0_wp), 1.0e-7_wp, 'restitution '//to_text(ratios(i)))
         end do
      end do
   end subroutine test_restitution

   !> What a history gives depends neither on its place nor on its neighbours, nor on order, number or threads
   subroutine test_places()
      integer, parameter :: histories = 150
      integer, parameter :: numbers(6) = [1, 7, 8, 9, 64, 65]
      type(random_type) :: random
      type(wall_type) :: wall
      type(record_type) :: records(6)
      type(response_type), allocatable :: alone(:), together(:)
      integer :: record(histories), order(histories), i, j, k, m
      real(wp) :: scale(histories)

      call suite('places')
      random = new_random(7, 0)
      do m = 1, 4
         wall = a_wall(m)
         do i = 1, size(records)
            records(i) = random_record(random, wall%mechanism%trigger_acceleration(), choice(random, 500) + 1)
            ! The last record is quiet at its end, where a lane that is left behind would run on.
            records(i)%acceleration(size(records(i)%acceleration)) = 0.0_wp
         end do
         do i = 1, histories
            record(i) = choice(random, size(records))
            scale(i) = between(random, -2.0_wp, 2.0_wp)
            if (choice(random, 6) == 1) scale(i) = 0.0_wp
            order(i) = i
         end do
         allocate(alone(histories))
         do i = 1, histories
            call run_alone(wall%mechanism, records(record(i)), scale(i), solver_type(), alone(i))
         end do
         call check(count(alone%edp > 0.0_wp) > 20 .and. any(alone%edp == 0.0_wp) .and. any(alone%impacts > 2), &
            & 'they differ')
         call run_lanes(wall%mechanism, records, record, scale, solver_type(), together)
         call check(all(is_same(alone, together)), 'together')
         do i = histories, 2, -1
            j = choice(random, i)
            order([i, j]) = order([j, i])
         end do
         call run_lanes(wall%mechanism, records, record(order), scale(order), solver_type(), together)
         call check(all(is_same(alone(order), together)), 'in another order')
         do i = 1, size(numbers)
            call run_lanes(wall%mechanism, records, record(:numbers(i)), scale(:numbers(i)), solver_type(), together)
            call check(all(is_same(alone(:numbers(i)), together)), to_text(numbers(i))//' of them')
         end do
         do i = 2, 4
            call run_lanes(wall%mechanism, records, record, scale, solver_type(), together, threads=i)
            call check(all(is_same(alone, together)), to_text(i)//' threads')
         end do
         do k = 1, histories, 10
            call run_lanes(wall%mechanism, records, spread(record(k), 1, 64), spread(scale(k), 1, 64), solver_type(), &
               & together)
            call check(all(is_same(alone(k), together)), '64 times the same')
         end do
         deallocate(alone)
      end do
   end subroutine test_places

   !> Counts of what is computed, and of what is not
   subroutine test_counts()
      type(wall_type) :: wall
      type(record_type) :: records(2)
      type(response_type), allocatable :: response(:)
      type(response_type) :: other
      type(work_type) :: work, expected
      integer, parameter :: record(12) = [1, 2, 1, 2, 1, 2, 1, 2, 1, 2, 1, 2]
      real(wp) :: scale(12)
      integer :: i, m

      call suite('counts')
      do m = 1, 4
         wall = a_wall(m)
         records(1) = accelerogram([(sin(0.2_wp*i), i=1, 400)], 0.01_wp)
         records(2) = accelerogram([(sin(0.1_wp*i)*sin(0.01_wp*i), i=1, 300)], 0.02_wp)
         scale = wall%mechanism%trigger_acceleration()*[(0.9_wp + 0.02_wp*i, i=1, 12)]
         call run_lanes(wall%mechanism, records, record, scale, tight(1.0_wp), response, work)
         expected = work_type()
         do i = 1, size(record)
            call simulate_rk45(wall%mechanism, records(record(i)), scale(i), tight(1.0_wp), other, work=expected)
         end do
         call check(work%histories == 12 .and. expected%histories == 12, 'histories')
         call check(work%still == count(response%edp == 0.0_wp) .and. work%still > 0 .and. work%still < 12, 'still')
         call check(work%intervals == 6*399 + 6*299, 'intervals')
         call check(work%intervals == expected%intervals .and. work%still == expected%still .and. &
            & work%rocked == expected%rocked, 'the same as by rk45')
         call check(work%rocked > 0 .and. work%rocked < work%intervals, 'rocked')
         call check(work%impacts == sum(response%impacts), 'impacts')
         call check(work%steps >= work%rocked + work%impacts .and. work%evaluations == work%steps, 'steps')
         call run_lanes(wall%mechanism, records, record, 0.85_wp/1.2_wp*scale, tight(1.0_wp), response, work)
         call check(work%still == 12 .and. work%steps == 0 .and. work%evaluations == 0 .and. work%rocked == 0, &
            & 'below the threshold nothing is integrated')
      end do
   end subroutine test_counts

   !> The estimated error is that of the other two runs, and changes nothing
   subroutine test_estimate()
      type(wall_type) :: wall
      type(record_type) :: record
      type(solver_type) :: solver, other_solver
      type(response_type) :: response, estimated, others(runs_of_estimate - 1)
      real(wp) :: other_scale
      integer :: i, k, m

      call suite('estimated error')
      record = accelerogram([(sin(0.2_wp*i)*cos(0.031_wp*i), i=1, 500)], 0.01_wp)
      do m = 1, 4
         wall = a_wall(m)
         do i = 1, 5
            solver = solver_type()
            call run_alone(wall%mechanism, record, i*1.3_wp, solver, response)
            do k = 1, size(others)
               call other_run(k, solver, i*1.3_wp, other_solver, other_scale)
               call run_alone(wall%mechanism, record, other_scale, other_solver, others(k))
            end do
            solver%estimate_error = .true.
            call run_alone(wall%mechanism, record, i*1.3_wp, solver, estimated)
            call check(is_same(response, estimated) .and. response%edp_error == 0.0_wp, 'the result is the same')
            call check(estimated%edp_error == estimated_error(response, others(1), others(2), &
               & wall%mechanism%frequency_parameter(), 1.0_wp), 'the differences')
         end do
      end do
   end subroutine test_estimate

end program test_lanes
