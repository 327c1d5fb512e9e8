!> The motion of a wall under an accelerogram, by the engine that runs its stripes: result and estimated error are those of the
!> same history in a stripe, to the bit.
module dondolo_motion_simulate
   use dondolo_base_error, only : error_type, not_a_number, raise_input
   use dondolo_base_interrupt, only : check_interrupt
   use dondolo_base_kinds, only : wp
   use dondolo_base_memory, only : raise_shortage
   use dondolo_base_text, only : to_text
   use dondolo_motion_ensemble, only : check_engine, ensemble_type, raise_given_up, run_ensemble
   use dondolo_motion_initial_state, only : check_initial_state, initial_state_type
   use dondolo_motion_lane_constants, only : lane_constants_type, new_lane_constants
   use dondolo_motion_lane_variants, only : trace_variant
   use dondolo_motion_one_history, only : simulate_one
   use dondolo_motion_response, only : response_type, trace_type
   use dondolo_motion_rest, only : new_rest, rest_type
   use dondolo_motion_solver, only : check_limit, check_solver, solver_type
   use dondolo_record, only : record_type
   use dondolo_record_suite, only : new_suite, suite_type
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: simulate

   !> Memory that a row of a time history takes while it grows [bytes]
   real(wp), parameter :: bytes_of_row = 140.0_wp

contains

   !> The motion of a wall, at rest at the start unless that is given
   subroutine simulate(mechanism, record, scale, solver, response, error, trace, initial)
      class(mechanism_type), intent(in) :: mechanism
      type(record_type), intent(in) :: record
      !> Factor on it, negative to reverse its polarity
      real(wp), intent(in) :: scale
      !> Engine, tolerances and limit; whether the error of the EDP is to be estimated
      type(solver_type), intent(in) :: solver
      type(response_type), intent(out) :: response
      !> What cannot be run: `variable = value: what is allowed`; an interrupt; lack of memory for the time history; a history
      !> that was given up
      type(error_type), allocatable, intent(out) :: error
      !> Time history, until rest or 10 s past the end of the record; computed only if present
      type(trace_type), intent(inout), optional :: trace
      !> Rotation and velocity at the start; absent: none
      type(initial_state_type), intent(in), optional :: initial

      ! Large ones are on the heap: stacks may be small.
      type(lane_constants_type), allocatable :: constants
      type(response_type) :: again
      type(ensemble_type), allocatable :: ensemble
      type(suite_type), allocatable :: suite
      type(record_type), allocatable :: records(:)
      type(initial_state_type) :: start
      type(rest_type) :: rest
      real(wp) :: time, side
      integer :: interval
      logical :: found

      if (present(initial)) start = initial
      call check_solver(solver, error)
      if (.not. allocated(error)) call check_limit(solver, mechanism, error)
      if (.not. allocated(error)) call check_engine(solver, mechanism, error, allocated(record%vertical))
      if (.not. allocated(error)) call check_initial_state(start, mechanism, solver, error)
      if (allocated(error)) return
      if (.not. abs(scale) <= huge(scale)) then
         call raise_input(error, 'scale = '//to_text(scale)//': must be a number', not_a_number, 'scale')
         return
      end if
      if (.not. (present(trace) .or. solver%estimate_error .or. start%moves() .or. mechanism%joint%exists)) then
         ! A wall that never moves costs a look at the record and no more.
         rest = new_rest(mechanism)
         interval = 1
         time = 0.0_wp
         call rest%next_start(record, scale, interval, time, side, found)
         if (.not. found) return
      end if
      allocate (constants, ensemble, suite)
      ensemble%record = [1]
      ensemble%scale = [scale]
      ensemble%initial = start
      records = [record]
      call new_suite(suite, records)
      call run_ensemble(ensemble, mechanism, suite, solver, 1, error)
      response = ensemble%response(1)
      if (present(trace)) trace%work = ensemble%work
      if (.not. allocated(error)) call check_interrupt(error)
      if (allocated(error) .or. .not. present(trace)) return
      ! Once more, row by row: the loop over lanes knows nothing of rows, nor does it pay for them.
      if (solver%engine /= 'rk45' .and. .not. start%moves()) constants = new_lane_constants(mechanism, solver, suite%has_vertical)
      if (constants%form%exists) then
         call trace_variant(mechanism, constants, record, scale, trace)
         if (.not. allocated(trace%ties)) allocate (trace%ties(0))
      else
         call simulate_one(mechanism, record, scale, solver, again, trace, start)
      end if
      call check_interrupt(error)
      if (allocated(error)) return
      if (trace%lacks_memory) then
         call raise_shortage(bytes_of_row*real(trace%rows, wp), error)
      else if (.not. trace%is_whole) then
         again%time_of_peak = trace%time(trace%rows)
         call raise_given_up(record, scale, again, error)
      end if
   end subroutine simulate

end module dondolo_motion_simulate
