!> What must hold of every history, whatever it is made of.
module history_properties
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use checks, only : check
   use counting_mechanism, only : counting_type, evaluations, new_counting
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_motion_response, only : response_type, trace_type
   use dondolo_motion_rk45, only : simulate_rk45
   use dondolo_motion_solver, only : check_limit, check_solver, solver_type
   use dondolo_motion_work, only : work_type
   use dondolo_record, only : record_type
   use energy_balance, only : balance_type, energy_balance_of
   use dondolo_motion_simulate, only : simulate
   use lane_runs, only : run_alone, runs_in_lanes
   use random_history, only : history_type
   use same_response, only : is_same
   implicit none
   private

   public :: check_properties, print_extremes

   !> Most evaluations of the equation of motion for each sample and impact. The most are those of the time of a late
   !> peak after a record of two samples
   real(wp), parameter :: most_evaluations = 2.0e3_wp

   !> Most steps of a lane for each sample and impact
   real(wp), parameter :: most_steps = 2.0e3_wp

   !> Longest time of a history, which no machine should need [s]
   real(wp), parameter :: longest = 3.0_wp

   !> Largest error of the energy over one interval / what the tolerances allow one step
   real(wp), parameter :: largest_imbalance = 100.0_wp

   ! What the histories came to, for one line at the end
   integer :: moved = 0, collapsed = 0, impacts = 0, balanced = 0, conditioned = 0, in_lanes = 0
   real(wp) :: most_work = 0.0_wp, worst_balance = 0.0_wp, worst_midpoints = 0.0_wp, slowest = 0.0_wp
   real(wp) :: most_lane_steps = 0.0_wp, worst_lanes = 0.0_wp

contains

   !> Check all properties of a history
   subroutine check_properties(history, what)
      type(history_type), intent(in) :: history
      character(len=*), intent(in) :: what
      type(response_type) :: response, lane
      type(trace_type) :: trace

      call check_work(history, response, what)
      call check_result(response, history%solver%edp_limit, what)
      call check_estimate(history, response, what)
      call check_symmetries(history, response, what)
      call check_limit_at_peak(history, response, what)
      call check_lanes(history, lane, what//' in lanes')
      call check_midpoints(history, response, lane, what)
      call check_trace(history, response, trace, what)
      call check_energy(history, trace, what)
      if (response%edp > 0.0_wp) moved = moved + 1
      if (response%collapsed) collapsed = collapsed + 1
      impacts = impacts + response%impacts
   end subroutine check_properties

   !> Print what the histories came to
   subroutine print_extremes()

      print '(a)', to_text(moved)//' moved, '//to_text(collapsed)//' collapsed, '//to_text(impacts)//' impacts; '// &
         & 'most evaluations a sample '//short(most_work)//'; '//to_text(balanced)//' intervals balance, worst '// &
         & short(worst_balance)//'; '//to_text(conditioned)//' with midpoints, worst '//short(worst_midpoints)// &
         & '; slowest '//short(slowest)//' s'
      print '(a)', to_text(in_lanes)//' in lanes, most steps a sample '//short(most_lane_steps)// &
         & ', worst difference from rk45 '//short(worst_lanes)
   end subroutine print_extremes

   !> A number with three digits
   function short(value) result(text)
      real(wp), intent(in) :: value
      character(len=:), allocatable :: text
      character(len=12) :: buffer

      write (buffer, '(es9.2e2)') value
      text = trim(adjustl(buffer))
   end function short

   !> The number of steps is bounded
   subroutine check_work(history, response, what)
      type(history_type), intent(in) :: history
      type(response_type), intent(out) :: response
      character(len=*), intent(in) :: what
      type(counting_type) :: counting
      real(wp) :: work, start, end

      counting = new_counting(history%wall%mechanism)
      evaluations = 0
      call cpu_time(start)
      call simulate_rk45(counting, history%record, history%scale, history%solver, response)
      call cpu_time(end)
      slowest = max(slowest, end - start)
      call check(end - start <= longest, what//': seconds '//to_text(end - start))
      work = real(evaluations, wp)/real(size(history%record%acceleration) + response%impacts, wp)
      most_work = max(most_work, work)
      call check(work <= most_evaluations, what//': evaluations a sample '//to_text(work))
   end subroutine check_work

   !> The result is finite, and within the limit, which is reached by collapses only
   subroutine check_result(response, limit, what)
      type(response_type), intent(in) :: response
      real(wp), intent(in) :: limit
      character(len=*), intent(in) :: what

      call check(ieee_is_finite(response%edp) .and. ieee_is_finite(response%time_of_peak), what//': finite')
      call check(response%edp >= 0.0_wp .and. response%edp <= limit, what//': within the limit')
      call check(response%collapsed .eqv. response%edp == limit, what//': collapsed at the limit')
      call check(response%time_of_peak >= 0.0_wp .and. response%impacts >= 0, what//': time of the peak, impacts')
   end subroutine check_result

   !> An estimated error is finite and changes nothing else
   subroutine check_estimate(history, response, what)
      type(history_type), intent(in) :: history
      type(response_type), intent(in) :: response
      character(len=*), intent(in) :: what
      type(response_type) :: again
      type(solver_type) :: solver
      type(error_type), allocatable :: error, refused

      solver = history%solver
      solver%estimate_error = .true.
      solver%engine = 'rk45'
      call simulate(history%wall%mechanism, history%record, history%scale, solver, again, error)
      ! A solver that has lost its digits to underflow is refused.
      call check_solver(solver, refused)
      call check(allocated(error) .eqv. allocated(refused), what//': refused')
      if (allocated(refused)) return
      call check(is_same(again, response), what//': the same with an estimated error')
      call check(again%edp_error >= 0.0_wp .and. again%edp_error <= solver%edp_limit, what//': estimated error '// &
         & to_text(again%edp_error))
   end subroutine check_estimate

   !> What changes nothing, to the bit: record and scale reversed, the record of a two-sided wall reversed, a power of
   !> two in the record and out of the scale
   subroutine check_symmetries(history, response, what)
      type(history_type), intent(in) :: history
      type(response_type), intent(in) :: response
      character(len=*), intent(in) :: what

      call check(is_same(response, again(-1.0_wp, -1.0_wp)), what//': record and polarity reversed')
      if (history%wall%mechanism%two_sided) then
         call check(is_same(response, again(-1.0_wp, 1.0_wp)), what//': a two-sided wall is symmetric')
      end if
      call check(is_same(response, again(64.0_wp, 1.0_wp/64.0_wp)), what//': record times 64, scale by 64')
      call check(is_same(response, again(1.0_wp/1024.0_wp, 1024.0_wp)), what//': record by 1024, scale times 1024')

   contains

      !> The response with the record and the scale multiplied
      type(response_type) function again(record_factor, scale_factor)
         real(wp), intent(in) :: record_factor, scale_factor
         type(record_type) :: record

         record = history%record
         record%acceleration = record_factor*record%acceleration
         call simulate_rk45(history%wall%mechanism, record, scale_factor*history%scale, history%solver, again)
      end function again

   end subroutine check_symmetries

   !> In lanes: bounded steps, a result, an estimate that changes nothing else, the same symmetries to the bit. Where
   !> the wall has no normal form up to its limit, rk45 computes it
   subroutine check_lanes(history, response, what)
      type(history_type), intent(in) :: history
      type(response_type), intent(out) :: response
      character(len=*), intent(in) :: what
      type(response_type) :: estimated
      type(work_type) :: work
      type(solver_type) :: solver
      real(wp) :: steps, start, end

      if (.not. runs_in_lanes(history%wall%mechanism, history%solver)) return
      in_lanes = in_lanes + 1
      call cpu_time(start)
      call run_alone(history%wall%mechanism, history%record, history%scale, history%solver, response, work)
      call cpu_time(end)
      call check(end - start <= longest, what//': seconds '//to_text(end - start))
      steps = real(work%steps, wp)/real(size(history%record%acceleration) + response%impacts, wp)
      most_lane_steps = max(most_lane_steps, steps)
      call check(steps <= most_steps, what//': steps a sample '//to_text(steps))
      call check(work%histories == 1 .and. work%still <= 1 .and. work%rocked <= work%intervals .and. &
         & work%intervals == size(history%record%acceleration) - 1 .and. work%impacts == response%impacts .and. &
         & (work%still == 0 .eqv. work%steps > 0), what//': counts')
      call check_result(response, history%solver%edp_limit, what)
      solver = history%solver
      solver%estimate_error = .true.
      call run_alone(history%wall%mechanism, history%record, history%scale, solver, estimated)
      call check(is_same(estimated, response), what//': the same with an estimated error')
      call check(estimated%edp_error >= 0.0_wp .and. estimated%edp_error <= solver%edp_limit, &
         & what//': estimated error '//to_text(estimated%edp_error))
      call check(is_same(response, again(-1.0_wp, -1.0_wp)), what//': record and polarity reversed')
      if (history%wall%mechanism%two_sided) then
         call check(is_same(response, again(-1.0_wp, 1.0_wp)), what//': a two-sided wall is symmetric')
      end if
      call check(is_same(response, again(64.0_wp, 1.0_wp/64.0_wp)), what//': record times 64, scale by 64')

   contains

      !> The response with the record and the scale multiplied
      type(response_type) function again(record_factor, scale_factor)
         real(wp), intent(in) :: record_factor, scale_factor
         type(record_type) :: record

         record = history%record
         record%acceleration = record_factor*record%acceleration
         call run_alone(history%wall%mechanism, record, scale_factor*history%scale, history%solver, again)
      end function again

   end subroutine check_lanes

   !> A limit that is just the peak, some bits less or more
   subroutine check_limit_at_peak(history, response, what)
      type(history_type), intent(in) :: history
      type(response_type), intent(in) :: response
      character(len=*), intent(in) :: what
      type(solver_type) :: solver
      type(response_type) :: limited
      type(error_type), allocatable :: error
      integer, parameter :: bits(7) = [-256, -2, -1, 0, 1, 2, 256]
      integer :: i

      if (response%collapsed .or. .not. response%edp > 0.0_wp) return
      solver = history%solver
      do i = 1, size(bits)
         solver%edp_limit = response%edp*(1.0_wp + real(bits(i), wp)*epsilon(1.0_wp))
         call check_limit(solver, history%wall%mechanism, error)
         if (allocated(error)) return
         call simulate_rk45(history%wall%mechanism, history%record, history%scale, solver, limited)
         call check_result(limited, solver%edp_limit, what//', limit at the peak and '//to_text(bits(i))//' bits')
      end do
   end subroutine check_limit_at_peak

   !> A record with the midpoints of its samples is the same function of time, so its result - the peak, the time of a
   !> collapse - differs by errors of the steps alone. How much they grow shows in a change of the scale as large as
   !> they are; where that, or half of it, is amplified more than a thousandfold no tolerance tells what the result
   !> should be. Every one of hundreds of steps may err by the tolerance
   subroutine check_midpoints(history, response, lane, what)
      type(history_type), intent(in) :: history
      type(response_type), intent(in) :: response, lane
      character(len=*), intent(in) :: what
      real(wp), parameter :: largest_growth = 1.0e3_wp, in_hand = 100.0_wp, parts(4) = [-1.0_wp, -0.5_wp, 0.5_wp, 1.0_wp]
      type(record_type) :: finer
      type(response_type) :: fine, other
      real(wp) :: relative, change, ratio
      integer :: i

      if (.not. response%edp > 0.0_wp) return
      associate (solver => history%solver, a => history%record%acceleration, n => size(history%record%acceleration))
         relative = solver%rtol + solver%atol/response%edp
         if (relative > 1.0e-3_wp) return
         change = 0.0_wp
         do i = 1, size(parts)
            call simulate_rk45(history%wall%mechanism, history%record, history%scale*(1.0_wp + parts(i)*relative), solver, other)
            if (other%collapsed .neqv. response%collapsed) return
            change = max(change, abs(outcome(other) - outcome(response)))
            if (change > largest_growth*relative*outcome(response)) return
         end do
         finer = history%record
         finer%dt = 0.5_wp*finer%dt
         deallocate(finer%acceleration)
         allocate(finer%acceleration(2*n - 1))
         finer%acceleration(1::2) = a
         finer%acceleration(2::2) = 0.5_wp*(a(:n - 1) + a(2:))
         call simulate_rk45(history%wall%mechanism, finer, history%scale, solver, fine)
      end associate
      conditioned = conditioned + 1
      ratio = abs(outcome(fine) - outcome(response))/(change + relative*outcome(response))
      worst_midpoints = max(worst_midpoints, ratio)
      call check(ratio <= in_hand, what//': half the time step changes the result by '// &
         & to_text(outcome(fine) - outcome(response))//', tolerance '//to_text(change + relative*outcome(response)))
      if (.not. runs_in_lanes(history%wall%mechanism, history%solver)) return
      call check(lane%collapsed .eqv. response%collapsed, what//': lanes and rk45 agree on the collapse')
      if (lane%collapsed .neqv. response%collapsed) return
      ratio = abs(outcome(lane) - outcome(response))/(change + relative*outcome(response))
      worst_lanes = max(worst_lanes, ratio)
      call check(ratio <= in_hand, what//': lanes differ from rk45 by '// &
         & to_text(outcome(lane) - outcome(response))//', tolerance '//to_text(change + relative*outcome(response)))

   contains

      !> What a history comes to: the peak, or the time of collapse
      pure real(wp) function outcome(of)
         type(response_type), intent(in) :: of

         outcome = merge(of%time_of_peak, of%edp, of%collapsed)
      end function outcome

   end subroutine check_midpoints

   !> A time history changes nothing, has the rows it should have, and none beyond the peak
   subroutine check_trace(history, response, trace, what)
      type(history_type), intent(in) :: history
      type(response_type), intent(in) :: response
      type(trace_type), intent(out) :: trace
      character(len=*), intent(in) :: what
      type(response_type) :: traced
      logical, allocatable :: at_rest(:)
      real(wp) :: highest
      integer :: rows

      call simulate_rk45(history%wall%mechanism, history%record, history%scale, history%solver, traced, trace)
      call check(is_same(response, traced), what//': with a time history')
      call check(all(ieee_is_finite(trace%rotation)) .and. all(ieee_is_finite(trace%velocity)), what//': finite rows')
      call check(all(trace%time(2:) >= trace%time(:trace%rows - 1)), what//': times of the rows')
      ! After the record the peak follows from the energy, and the rows from steps: see the balance of energy.
      rows = count(trace%time <= history%record%duration())
      call check(rows <= size(history%record%acceleration) + 2*response%impacts + 1, what//': number of rows')
      call check(count(trace%after_impact(:rows)) == response%impacts, what//': marks of impacts')
      call check(all(abs(trace%side) == 1.0_wp .and. trace%side*trace%rotation >= 0.0_wp), what//': sides')
      ! It changes at an impact, or when the wall starts from rest, to which it may have come just after an impact.
      at_rest = .not. (abs(trace%rotation) > 0.0_wp .or. abs(trace%velocity) > 0.0_wp)
      call check(all(trace%after_impact(2:) .or. trace%side(2:) == trace%side(:trace%rows - 1) &
         & .or. at_rest(:trace%rows - 1) .or. trace%after_impact(:trace%rows - 1)), what//': changes of side')
      highest = maxval(abs(trace%rotation(:rows)))/history%wall%mechanism%capacity
      call check(highest <= response%edp*(1.0_wp + 4.0_wp*epsilon(highest)), what//': a row beyond the peak')
   end subroutine check_trace

   !> Energy changes by the work of the ground and by impacts alone
   subroutine check_energy(history, trace, what)
      type(history_type), intent(in) :: history
      type(trace_type), intent(in) :: trace
      character(len=*), intent(in) :: what
      type(balance_type) :: balance

      balance = energy_balance_of(history%wall%mechanism, history%record, history%solver, trace)
      call check(balance%wrong_impacts == 0, what//': speed after an impact')
      call check(balance%worst <= largest_imbalance, what//': energy out of balance '//to_text(balance%worst))
      balanced = balanced + balance%intervals
      worst_balance = max(worst_balance, balance%worst)
   end subroutine check_energy

end module history_properties
