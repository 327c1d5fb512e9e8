!> Walls with ties and friction in the engine lanes: against independently computed values, and the engine rk45 at tight tolerances.
program test_lane_ties
   use checks, only : check, check_close, check_ok, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_motion_response, only : response_type, trace_type
   use dondolo_motion_rk45, only : simulate_rk45
   use dondolo_motion_solver, only : solver_type
   use dondolo_record, only : record_type
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   use lane_runs, only : run_alone, run_lanes, runs_in_lanes
   use motion_inputs, only : accelerogram, tight
   use random_history, only : history_type
   use same_response, only : is_same
   use tied_history, only : new_tied_history
   implicit none

   real(wp), parameter :: exact = 1.0e-12_wp

   call test_known_histories()
   call test_what_moves_with_the_wall()
   call test_random_histories()
   call test_collapses_only()
   call test_places()
   call test_friction()
   call finish()

contains

   !> A facade of 9 m by 0.5 m with one tie, 8.5 m above the base
   function tied() result(input)
      type(wall_input_type) :: input

      call input%set('mechanism', 'one_sided')
      call input%set('height', 9.0_wp)
      call input%set('thickness', 0.5_wp)
      call input%set('tie_height', [8.5_wp])
      call input%set('tie_area', [5.0e-5_wp])
      call input%set('tie_length', [8.0_wp])
      call input%set('tie_preload', [3.0e7_wp])
   end function tied

   !> A wall
   function made(input) result(wall)
      type(wall_input_type), intent(in) :: input
      type(wall_type) :: wall
      type(error_type), allocatable :: error

      call new_wall(wall, input, error)
      call check_ok(error, 'wall')
   end function made

   !> The facade under an accelerogram of 0.1 s from sample to sample
   subroutine run(a, response)
      real(wp), intent(in) :: a(:)
      type(response_type), intent(out) :: response
      type(wall_type) :: wall

      wall = made(tied())
      call run_alone(wall%mechanism, accelerogram(a, 0.1_wp), 1.0_wp, tight(1.0_wp), response)
   end subroutine run

   subroutine test_known_histories()
      real(wp), parameter :: still = 0.0_wp
      type(response_type) :: response
      type(wall_type) :: wall
      real(wp) :: q

      wall = made(tied())
      q = wall%mechanism%capacity
      call suite('yields')
      call run([0.0_wp, -3.5_wp, -3.5_wp, -3.5_wp, -1.0_wp, 2.0_wp, 2.0_wp, still, still, still, still, still], response)
      call check_close(response%edp*q, 0.012578250461766_wp, 0.0_wp, 'peak', exact)
      call check_close(response%time_of_peak, 0.484121051148929_wp, 0.0_wp, 'time of the peak', 1.0e-9_wp)

      call suite('breaks')
      call run([0.0_wp, -6.0_wp, -6.0_wp, -6.0_wp, -1.0_wp, 2.0_wp, 2.0_wp, still, still, still, still, still], response)
      call check(response%collapsed, 'collapses')
      call check_close(response%time_of_peak, 0.506199998997781_wp, 0.0_wp, 'time of the limit', exact)

      call suite('elastic')
      call run([0.0_wp, -1.5_wp, -1.5_wp, still, still], response)
      call check_close(response%edp*q, 0.000460090131684594_wp, 0.0_wp, 'peak', exact)
      call check_close(response%time_of_peak, 0.224910192845897_wp, 0.0_wp, 'time of the peak', 1.0e-9_wp)

      call suite('yields again and breaks')
      call run([0.0_wp, -3.5_wp, -3.5_wp, -3.5_wp, -1.0_wp, 2.0_wp, 2.0_wp, still, -3.0_wp, -3.0_wp, -3.0_wp, still, 1.0_wp, &
         & 1.0_wp, still, still], response)
      call check_close(response%time_of_peak, 1.24423791104001_wp, 0.0_wp, 'time of the limit', exact)
   end subroutine test_known_histories

   !> Loads that are lifted make J change with the rotation; vertical motion, an edge, several ties
   subroutine test_what_moves_with_the_wall()
      type(wall_input_type) :: input
      type(wall_type) :: wall
      type(record_type) :: record
      type(response_type) :: lane, other
      integer :: i

      call suite('what moves with the wall')
      record = accelerogram([0.0_wp, -3.5_wp, -3.0_wp, -2.5_wp, 2.0_wp, 3.0_wp, 1.0_wp, -4.0_wp, -3.0_wp, 1.5_wp, 3.0_wp, &
         & -1.0_wp, -3.5_wp, -4.0_wp, 1.0_wp, 0.0_wp, 0.5_wp, 0.0_wp, 0.0_wp], 0.08_wp)
      do i = 1, 3
         input = tied()
         call input%set('tie_height', [8.5_wp, 5.0_wp])
         call input%set('tie_strain', [0.02_wp, 0.1_wp])
         if (i >= 2) then
            call input%set('load', [12.0e3_wp])
            call input%set('load_depth', [0.35_wp])
            call input%set('load_height', [4.5_wp])
            call input%set('load_inertia', 'vertical')
            call input%set('edge_radius', 0.02_wp)
         end if
         if (i == 3) record%vertical = -0.6_wp*cshift(record%acceleration, 3)
         wall = made(input)
         call run_alone(wall%mechanism, record, 1.0_wp, tight(1.0_wp), lane)
         call simulate_rk45(wall%mechanism, record, 1.0_wp, tight(1.0_wp), other)
         call check_close(lane%edp, other%edp, 0.0_wp, to_text(i)//': EDP', 1.0e-11_wp)
         call check_close(lane%time_of_peak, other%time_of_peak, 0.0_wp, to_text(i)//': time of the peak', 1.0e-7_wp)
         call check(lane%edp > 0.02_wp .and. lane%edp < 1.0_wp .and. lane%impacts == other%impacts .and. lane%impacts > 0, &
            & to_text(i)//': rocks, '//to_text(lane%impacts)//' impacts')
      end do
   end subroutine test_what_moves_with_the_wall

   !> Random walls with one to four ties of any kind
   subroutine test_random_histories()
      integer, parameter :: histories = 1500
      type(history_type) :: history
      type(solver_type) :: solver, fine
      type(response_type) :: lane, other
      integer :: i, run, off, flags

      call suite('random histories')
      run = 0
      off = 0
      flags = 0
      fine%rtol = 1.0e-12_wp
      fine%atol = 1.0e-14_wp
      do i = 1, histories
         history = new_tied_history(70000 + i)
         solver%edp_limit = history%solver%edp_limit
         fine%edp_limit = solver%edp_limit
         if (.not. runs_in_lanes(history%wall%mechanism, solver)) cycle
         run = run + 1
         call run_alone(history%wall%mechanism, history%record, history%scale, solver, lane)
         call simulate_rk45(history%wall%mechanism, history%record, history%scale, fine, other)
         if (abs(lane%edp - other%edp) > 1.0e-6_wp) off = off + 1
         if (lane%collapsed .neqv. other%collapsed) flags = flags + 1
      end do
      call check(run > histories/2, 'most run in lanes: '//to_text(run))
      call check(100*off <= 2*run, 'EDPs that differ: '//to_text(off)//' of '//to_text(run))
      call check(1000*flags <= 2*run, 'flags that differ: '//to_text(flags)//' of '//to_text(run))
   end subroutine test_random_histories

   !> Ties need every peak: a run for collapses alone gives the same
   subroutine test_collapses_only()
      type(history_type) :: history
      type(solver_type) :: solver
      type(response_type) :: one, other
      integer :: i

      call suite('collapses only')
      do i = 1, 100
         history = new_tied_history(80000 + i)
         solver = solver_type()
         if (.not. runs_in_lanes(history%wall%mechanism, solver)) cycle
         call run_alone(history%wall%mechanism, history%record, history%scale, solver, one)
         solver%collapses_only = .true.
         call run_alone(history%wall%mechanism, history%record, history%scale, solver, other)
         call check(is_same(one, other), to_text(i)//': the same')
      end do
   end subroutine test_collapses_only

   !> The same to the bit whatever runs beside it, in any order and on any number of threads
   subroutine test_places()
      integer, parameter :: histories = 60
      type(history_type) :: history
      type(wall_type) :: wall
      type(record_type) :: records(histories)
      type(response_type), allocatable :: forwards(:), backwards(:)
      type(response_type) :: alone
      real(wp) :: scale(histories)
      integer :: i

      call suite('places')
      wall = made(tied())
      do i = 1, histories
         history = new_tied_history(90000 + i)
         records(i) = accelerogram(history%record%acceleration/maxval(abs(history%record%acceleration)), 0.01_wp)
         scale(i) = 1.0_wp + 0.1_wp*real(i, wp)
      end do
      call run_lanes(wall%mechanism, records, [(i, i=1, histories)], scale, solver_type(), forwards)
      call run_lanes(wall%mechanism, records, [(i, i=histories, 1, -1)], scale(histories:1:-1), solver_type(), backwards, &
         & threads=3)
      call check(all(is_same(forwards, backwards(histories:1:-1))), 'any order and number of threads')
      do i = 1, histories, 7
         call run_alone(wall%mechanism, records(i), scale(i), solver_type(), alone)
         call check(is_same(alone, forwards(i)), to_text(i)//': alone')
      end do
      call check(any(forwards%edp > 0.0_wp), 'some rock')
   end subroutine test_places

   !> Random walls with friction, which holds some of them out, with and without ties
   subroutine test_friction()
      integer, parameter :: histories = 4000
      type(history_type) :: history
      type(solver_type) :: solver, fine
      type(response_type) :: lane, other
      type(trace_type) :: trace
      integer :: i, run, left, off, flags, held

      call suite('friction')
      run = 0
      left = 0
      off = 0
      flags = 0
      held = 0
      fine%rtol = 1.0e-12_wp
      fine%atol = 1.0e-14_wp
      do i = 1, histories
         history = new_tied_history(60000 + i)
         if (.not. history%wall%mechanism%has_friction()) cycle
         solver%edp_limit = history%solver%edp_limit
         fine%edp_limit = solver%edp_limit
         if (.not. runs_in_lanes(history%wall%mechanism, solver)) then
            left = left + 1
            cycle
         end if
         run = run + 1
         call run_alone(history%wall%mechanism, history%record, history%scale, solver, lane)
         trace = trace_type()
         call simulate_rk45(history%wall%mechanism, history%record, history%scale, fine, other, trace)
         if (is_held(trace)) held = held + 1
         if (abs(lane%edp - other%edp) > 1.0e-6_wp) off = off + 1
         if (lane%collapsed .neqv. other%collapsed) flags = flags + 1
      end do
      call check(run > 1000 .and. left < run/10, 'nearly all run in lanes: '//to_text(run)//', not '//to_text(left))
      call check(held > 3, 'friction holds some: '//to_text(held))
      call check(100*off <= 2*run, 'EDPs that differ: '//to_text(off)//' of '//to_text(run))
      call check(1000*flags <= 2*run, 'flags that differ: '//to_text(flags)//' of '//to_text(run))
   end subroutine test_friction

   !> Is a wall at the same rotation, not at rest, in two rows of its motion that follow each other?
   pure logical function is_held(trace)
      type(trace_type), intent(in) :: trace

      associate (q => trace%rotation, v => trace%velocity)
         is_held = any(q(2:) > 0.0_wp .and. v(2:) == 0.0_wp .and. v(:size(v) - 1) == 0.0_wp .and. q(2:) == q(:size(q) - 1))
      end associate
   end function is_held

end program test_lane_ties
