!> Events where they are hardest: two in one step, on a sample, on the edge of a threshold, a dip that only grazes.
!>
!> All is compared to the closed forms of the linear block, under an outward push x = -s u_g''/(alpha g).
program test_events
   use checks, only : check, check_close, finish, suite
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_motion_adaptive_step, only : advance, motion_type
   use dondolo_motion_dormand_prince, only : angular_acceleration
   use dondolo_motion_events, only : impact
   use dondolo_motion_initial_state, only : initial_state_type
   use dondolo_motion_response, only : response_type, trace_type
   use dondolo_motion_rk45, only : simulate_rk45
   use dondolo_motion_solver, only : solver_type
   use dondolo_motion_wall_constants, only : new_wall_constants
   use linear_block, only : linear_block_type, new_linear_block
   use motion_inputs, only : accelerogram, loose, tight
   implicit none

   real(wp), parameter :: p = 2.0_wp, alpha = 0.1_wp, e = 0.7_wp

   !> The block to both sides; in closed form it moves as the block to one
   type(linear_block_type) :: block

   !> Bits by which numbers are moved off their place
   integer :: bits

   block = new_linear_block(p, alpha, e, .true.)
   call test_dip_in_a_step()
   call test_peak_in_a_step()
   call test_impact_on_a_sample()
   call test_peak_on_a_sample()
   call test_limit_on_a_sample()
   call test_start_on_a_sample()
   call test_edge_of_both_sides()
   call test_touch()
   call test_last_interval()
   call test_grazing()
   call finish()

contains

   !> The response of the linear block to the outward pushes x at its samples
   subroutine respond(two_sided, x, dt, solver, response, trace, initial)
      logical, intent(in) :: two_sided
      real(wp), intent(in) :: x(:), dt
      type(solver_type), intent(in) :: solver
      type(response_type), intent(out) :: response
      type(trace_type), intent(inout), optional :: trace
      type(initial_state_type), intent(in), optional :: initial

      call simulate_rk45(new_linear_block(p, alpha, e, two_sided), accelerogram(-x*block%trigger_acceleration(), dt), &
         & 1.0_wp, solver, response, trace, initial)
   end subroutine respond

   !> Signed rotation and velocity in the last row of a time history that belongs to a time
   function state_at(trace, time) result(state)
      type(trace_type), intent(in) :: trace
      real(wp), intent(in) :: time
      real(wp) :: state(2)
      integer :: row

      row = findloc(abs(trace%time - time) <= 1.0e-9_wp*time, .true., dim=1, back=.true.)
      call check(row > 0, 'a row at time '//to_text(time))
      state = 0.0_wp
      if (row > 0) state = [trace%rotation(row), trace%velocity(row)]
   end function state_at

   !> One advance of the linear block from a state, over a sample interval of constant push
   subroutine one_step(solver, start, x, dt, motion, event)
      type(solver_type), intent(in) :: solver
      real(wp), intent(in) :: start(2), x, dt
      type(motion_type), intent(out) :: motion
      integer, intent(out) :: event
      logical :: sample_reached

      motion%excitation%start = -x*block%trigger_acceleration()
      motion%q = start(1)
      motion%v = start(2)
      motion%f = angular_acceleration(block, motion%excitation, 0.0_wp, motion%q, motion%v)
      motion%step = dt
      call advance(block, new_wall_constants(block, solver), dt, motion, event, sample_reached)
   end subroutine one_step

   !> A dip below q = 0 that begins and ends inside one step is an impact; one that stays above is not
   subroutine test_dip_in_a_step()
      real(wp), parameter :: x = 5.0_wp, dt = 0.04_wp, floor = alpha*(1.0_wp - x)
      type(motion_type) :: motion
      real(wp) :: start(2), ending(2), depth, a, b, time, state(2)
      integer :: event, k

      call suite('a dip inside a step')
      do k = 1, 6
         ! The lowest rotation is floor + sqrt((q0 - floor)^2 - (v0/p)^2).
         depth = alpha*10.0_wp**(-2 - k)
         start(2) = -0.4_wp*dt*p**2*alpha*(x - 1.0_wp)
         start(1) = floor + sqrt((-depth - floor)**2 + (start(2)/p)**2)
         ending = block%motion(start, x, 0.0_wp, dt)
         call check(ending(1) > 0.0_wp .and. ending(2) > 0.0_wp, 'it ends above')
         call one_step(loose(1.0_wp), start, x, dt, motion, event)
         call check(event == impact .and. motion%q == 0.0_wp, 'dip of 1e-'//to_text(2 + k)//' of the capacity')
         ! exp(p t) at q = 0 is the root of a u^2 + floor u + b.
         a = 0.5_wp*(start(1) - floor + start(2)/p)
         b = 0.5_wp*(start(1) - floor - start(2)/p)
         time = log(2.0_wp*b/(-floor + sqrt(floor**2 - 4.0_wp*a*b)))/p
         state = block%motion(start, x, 0.0_wp, time)
         call check_close(motion%time, time, 1.0e-5_wp, 'instant of the impact')
         call check_close(motion%v, state(2), 1.0e-3_wp, 'speed of the impact')

         start(1) = floor + sqrt((depth - floor)**2 + (start(2)/p)**2)
         call one_step(loose(1.0_wp), start, x, dt, motion, event)
         call check(event /= impact .and. motion%q > 0.0_wp, 'no dip by 1e-'//to_text(2 + k))
      end do
   end subroutine test_dip_in_a_step

   !> A peak inside a step, however long the step
   subroutine test_peak_in_a_step()
      type(motion_type) :: motion
      real(wp) :: start(2), peak(2), dt
      integer :: event, k

      call suite('a peak inside a step')
      start = [0.3_wp*alpha, 0.1_wp*p*alpha]
      peak = block%peak_after(start)
      do k = 1, 8
         dt = peak(1)*(1.0_wp + 0.25_wp*k)
         call one_step(loose(1.0_wp), start, 0.0_wp, dt, motion, event)
         call check(event /= 0 .and. event /= impact .and. motion%v == 0.0_wp, 'a turning point')
         call check_close(motion%q, peak(2), 1.0e-8_wp, 'its rotation')
         call check_close(motion%time, peak(1), 1.0e-8_wp, 'its instant')
      end do
   end subroutine test_peak_in_a_step

   !> Free fall from half the capacity takes acosh(2)/p. Sample intervals that divide this time, and such a few
   !> bits off, make the impact fall on a sample; then the ground moves
   subroutine test_impact_on_a_sample()
      integer, parameter :: parts(9) = [1, 2, 3, 4, 5, 7, 16, 50, 128]
      type(response_type) :: response
      type(trace_type) :: trace
      real(wp) :: fall, dt, duration, state(2), expected(2)
      real(wp), allocatable :: x(:)
      integer :: i, k, m

      call suite('an impact on a sample')
      fall = acosh(2.0_wp)/p
      do m = 1, 2
         do i = 1, size(parts)
            k = parts(i)
            do bits = -5, 5
               dt = fall/k*(1.0_wp + bits*epsilon(dt))
               ! Still ground until the impact, then an outward push that grows, on the side that is then active
               allocate(x(k + 2), source=0.0_wp)
               x(k + 2) = merge(1.0_wp, -1.0_wp, m == 1)*0.2_wp/k
               trace%rows = 0
               call respond(m == 2, x, dt, tight(1.0_wp), response, trace, initial=initial_state_type(0.5_wp*alpha))
               deallocate(x)
               call check(response%impacts == 1, 'counted once')
               duration = (k + 1)*dt
               call check(count(trace%rotation == 0.0_wp .and. trace%time < duration) == 2, 'two rows in the history')
               state = state_at(trace, duration)*merge(1.0_wp, -1.0_wp, m == 1)
               expected = block%motion([0.0_wp, e*p*alpha*sqrt(0.75_wp)], 0.0_wp, 0.2_wp/(k*dt), duration - fall)
               call check_close(state(1), expected(1), 1.0e-10_wp, 'rotation after it')
               call check_close(state(2), expected(2), 1.0e-10_wp, 'velocity after it')
               ! The last sample is the impact.
               call respond(m == 2, spread(0.0_wp, 1, k + 1), dt, tight(1.0_wp), response, initial=initial_state_type(0.5_wp*alpha))
               call check(response%edp == 0.5_wp .and. response%time_of_peak == 0.0_wp, 'at the end of the record')
            end do
         end do
      end do
   end subroutine test_impact_on_a_sample

   !> Pushed by 2, 2, 0 and then left alone; the sample interval is made such that the peak falls on sample k
   subroutine test_peak_on_a_sample()
      real(wp) :: low, high, dt, peak(2)
      type(response_type) :: response
      integer :: i, k, extra

      call suite('a peak on a sample')
      do k = 4, 8
         low = 1.0e-2_wp
         high = 0.6_wp
         do i = 1, digits(dt)
            dt = 0.5_wp*(low + high)
            peak = peak_after_push(dt)
            if (peak(1) > k*dt) then
               high = dt
            else
               low = dt
            end if
         end do
         do bits = -5, 5
            dt = low*(1.0_wp + bits*epsilon(dt))
            peak = peak_after_push(dt)
            do extra = 0, 2, 2
               call respond(.true., [2.0_wp, 2.0_wp, spread(0.0_wp, 1, k + extra - 1)], dt, tight(1.0_wp), response)
               call check_close(response%edp, peak(2)/alpha, 1.0e-10_wp, 'EDP')
               call check_close(response%time_of_peak, peak(1), 1.0e-7_wp, 'time of the peak')
            end do
         end do
      end do
   end subroutine test_peak_on_a_sample

   !> Time and height of the peak after that push
   pure function peak_after_push(dt) result(peak)
      real(wp), intent(in) :: dt
      real(wp) :: peak(2), state(2)

      state = block%motion([0.0_wp, 0.0_wp], 2.0_wp, 0.0_wp, dt)
      state = block%motion(state, 2.0_wp, -2.0_wp/dt, dt)
      ! Beyond the speed that overturns it never comes back.
      peak = huge(dt)
      if (state(2) < p*(alpha - state(1))) peak = block%peak_after(state)
      peak(1) = 2.0_wp*dt + peak(1)
   end function peak_after_push

   !> A push of 2 from the first sample on: the limit is reached where p t = acosh(1 + limit)
   subroutine test_limit_on_a_sample()
      integer, parameter :: parts(6) = [1, 2, 3, 7, 16, 50]
      type(response_type) :: response
      type(trace_type) :: trace
      real(wp) :: limit, time, dt
      integer :: i, k, extra

      call suite('the limit on a sample')
      do i = 1, size(parts)
         do k = 1, 3
            limit = 0.5_wp*k
            time = acosh(1.0_wp + limit)/p
            do bits = -5, 5
               dt = time/parts(i)*(1.0_wp + bits*epsilon(dt))
               do extra = 0, 2, 2
                  trace%rows = 0
                  call respond(.true., spread(2.0_wp, 1, parts(i) + 1 + extra), dt, tight(limit), response, trace)
                  if (extra == 2) call check(trace%rotation(trace%rows) == limit*alpha, 'the history ends on it')
                  call check(response%collapsed .and. response%edp == limit, 'collapse')
                  call check_close(response%time_of_peak, time, 1.0e-11_wp, 'its time')
               end do
            end do
         end do
      end do
   end subroutine test_limit_on_a_sample

   !> The push reaches 1 on a sample and goes on; and it falls back to 1 on a sample
   subroutine test_start_on_a_sample()
      type(response_type) :: response
      type(trace_type) :: trace
      real(wp) :: dt, scale, expected(2), state(2)
      integer :: i, m

      call suite('a start on a sample')
      do m = 1, 2
         do i = 1, 5
            dt = 0.3_wp*10.0_wp**(1 - i)
            do bits = -5, 5
               scale = 1.0_wp + bits*epsilon(dt)
               trace%rows = 0
               call respond(m == 2, scale*[0.0_wp, 0.5_wp, 1.0_wp, 2.0_wp, 1.0_wp], dt, tight(5.0_wp), response, trace)
               expected = block%motion([0.0_wp, 0.0_wp], 1.0_wp, 1.0_wp/dt, dt)
               expected = block%motion(expected, 2.0_wp, -1.0_wp/dt, dt)
               state = state_at(trace, 4.0_wp*dt)
               call check_close(state(1), expected(1), 1.0e-9_wp, 'rotation after a start on the third sample', &
                  & 1.0e-15_wp)
               trace%rows = 0
               call respond(m == 2, scale*[1.0_wp, 2.0_wp, 1.0_wp], dt, tight(5.0_wp), response, trace)
               state = state_at(trace, 2.0_wp*dt)
               call check_close(state(1), expected(1), 1.0e-9_wp, 'rotation after a start on the first', 1.0e-15_wp)
               call respond(m == 2, scale*[1.0_wp, 1.0_wp, 1.0_wp], dt, tight(5.0_wp), response)
               call check(response%edp < 1.0e-12_wp, 'a push of 1 moves nothing')
            end do
         end do
      end do
   end subroutine test_start_on_a_sample

   !> A push that begins at 1, where one side could all but open, and within the same interval opens the other
   subroutine test_edge_of_both_sides()
      type(response_type) :: response
      type(trace_type) :: trace
      real(wp) :: dt, edge, expected(2), state(2)
      integer :: i, k

      call suite('both sides in one interval')
      do i = 1, 4
         dt = 0.3_wp*10.0_wp**(1 - i)
         do k = -5, 25
            edge = 1.0_wp + k*epsilon(dt)
            if (k > 5) edge = 1.0_wp + epsilon(dt)*2.0_wp**k
            trace%rows = 0
            call respond(.true., [edge, -3.0_wp], dt, tight(5.0_wp), response, trace)
            expected = -block%motion([0.0_wp, 0.0_wp], 1.0_wp, 4.0_wp/dt, 0.5_wp*dt)
            state = state_at(trace, dt)
            call check_close(state(1), expected(1), 1.0e-6_wp, 'rotation to the other side')
         end do
      end do
   end subroutine test_edge_of_both_sides

   !> A push that touches 1 at one sample moves nothing; a little more moves a little
   subroutine test_touch()
      type(response_type) :: response
      real(wp) :: before, push
      integer :: k, m

      call suite('a touch of the threshold')
      do m = 1, 2
         before = 0.0_wp
         do k = -5, 50
            push = 1.0_wp + sign(epsilon(push)*2.0_wp**abs(k), real(k, wp))
            call respond(m == 2, push*[0.5_wp, 1.0_wp, 0.5_wp], 0.01_wp, tight(1.0_wp), response)
            if (k < 0) call check(response%edp == 0.0_wp, 'a touch')
            if (k > 45) call check(response%edp > 0.0_wp, 'more than a touch')
            call check(response%edp >= before .and. response%edp < 1.0e-3_wp, 'more motion for more push')
            before = response%edp
         end do
      end do
   end subroutine test_touch

   !> Rocking that begins in the last interval: the peak comes after the record
   subroutine test_last_interval()
      type(response_type) :: response
      real(wp) :: dt, crossing, peak(2), last
      integer :: i, k

      call suite('a start in the last interval')
      do i = 1, 3
         dt = 0.3_wp*10.0_wp**(1 - i)
         do k = 1, 2
            last = 1.0_wp + 10.0_wp**(1 - k)
            crossing = dt/last
            peak = block%peak_after(block%motion([0.0_wp, 0.0_wp], 1.0_wp, last/dt, dt - crossing))
            call respond(.true., [0.0_wp, 0.0_wp, 0.0_wp, last], dt, tight(1.0_wp), response)
            call check_close(response%edp, peak(2)/alpha, 1.0e-8_wp, 'EDP', 1.0e-15_wp)
            call check_close(response%time_of_peak, 3.0_wp*dt + peak(1), 1.0e-9_wp, 'time of the peak')
         end do
      end do
   end subroutine test_last_interval

   !> Pushed out, falling back, and pushed out again by a pulse whose size is bisected between an impact and none:
   !> on one side of the last bit the wall hits its base, on the other not, and the motion after is the same but for
   !> the root of the error of a step
   subroutine test_grazing()
      integer :: m

      call suite('a grazing impact')
      do m = 1, 2
         call check_grazing(m == 2, loose(1.0_wp), 1.0e-5_wp)
         call check_grazing(m == 2, tight(1.0_wp), 1.0e-7_wp)
      end do
   end subroutine test_grazing

   !> One bisection, and the largest rotations on both sides of it
   subroutine check_grazing(two_sided, solver, tolerance)
      logical, intent(in) :: two_sided
      type(solver_type), intent(in) :: solver
      real(wp), intent(in) :: tolerance
      type(response_type) :: hit, missed, trial
      real(wp) :: bounds(2), middle

      bounds = [0.0_wp, 10.0_wp]
      do
         middle = 0.5_wp*sum(bounds)
         if (middle <= bounds(1) .or. middle >= bounds(2)) exit
         call respond(two_sided, grazing_push(middle), 0.1_wp, solver, trial)
         bounds(merge(1, 2, trial%impacts > 0)) = middle
      end do
      call respond(two_sided, grazing_push(bounds(1)), 0.1_wp, solver, hit)
      call respond(two_sided, grazing_push(bounds(2)), 0.1_wp, solver, missed)
      call check(hit%impacts > 0 .and. missed%impacts == 0, 'an impact on one side, none on the other')
      call check(missed%edp > 0.3_wp .and. .not. missed%collapsed, 'the wall goes on rocking')
      call check_close(hit%edp, missed%edp, tolerance, 'EDP across the edge')
   end subroutine check_grazing

   !> The push with a second pulse of a given size
   pure function grazing_push(pulse) result(x)
      real(wp), intent(in) :: pulse
      real(wp) :: x(8)

      x = [2.0_wp, 2.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, pulse, 6.0_wp, 0.0_wp]
   end function grazing_push

end program test_events
