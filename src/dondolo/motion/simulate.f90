!> The motion of a wall under an accelerogram, and how far its result can be trusted.
!>
!> Rocking amplifies errors, in a few histories by more than 10^8, and nothing in a step's own error tells which.
!> So the history is run twice more, with a slightly stronger and a slightly weaker record, one of them with halved steps:
!> the differences tell the size of the error of the first run, and are no bound (dondolo_error_estimate).
module dondolo_simulate
   use dondolo_ensemble, only : check_engine, ensemble_type, run_ensemble
   use dondolo_error, only : error_type, raise_input
   use dondolo_error_estimate, only : estimated_error, other_run, runs_of_estimate
   use dondolo_kinds, only : wp
   use dondolo_mechanism, only : mechanism_type
   use dondolo_record, only : record_type
   use dondolo_response, only : response_type, trace_type
   use dondolo_rk45, only : simulate_rk45
   use dondolo_solver, only : solver_type
   use dondolo_suite, only : new_suite, suite_type
   implicit none
   private

   public :: simulate, check_history

contains

   !> The motion of a wall, at rest at the start
   subroutine simulate(mechanism, record, scale, solver, response, trace)
      class(mechanism_type), intent(in) :: mechanism
      type(record_type), intent(in) :: record
      !> Factor on it, negative to reverse its polarity
      real(wp), intent(in) :: scale
      !> Engine ('lanes' only without a trace), tolerances and limit; whether the error of the EDP is to be estimated
      type(solver_type), intent(in) :: solver
      type(response_type), intent(out) :: response
      !> Time history, until rest or 10 s past the end of the record; computed only if present
      type(trace_type), intent(inout), optional :: trace

      type(response_type) :: others(runs_of_estimate - 1)
      type(solver_type) :: other_solver
      real(wp) :: other_scale
      integer :: k
      type(ensemble_type) :: ensemble
      type(suite_type) :: suite
      type(record_type), allocatable :: records(:)

      if (solver%engine == 'lanes' .and. .not. present(trace)) then
         ensemble%record = [1]
         ensemble%scale = [scale]
         records = [record]
         call new_suite(suite, records)
         call run_ensemble(ensemble, mechanism, suite, solver, 1)
         response = ensemble%response(1)
         return
      end if
      call simulate_rk45(mechanism, record, scale, solver, response, trace)
      if (.not. solver%estimate_error) return
      do k = 1, size(others)
         call other_run(k, solver, scale, other_solver, other_scale)
         call simulate_rk45(mechanism, record, other_scale, other_solver, others(k))
      end do
      response%edp_error = estimated_error(response, others(1), others(2), mechanism%frequency_parameter(), solver%edp_limit)
   end subroutine simulate

   !> Check that an engine can compute one history
   subroutine check_history(solver, mechanism, with_trace, error, is_shaken)
      type(solver_type), intent(in) :: solver
      class(mechanism_type), intent(in) :: mechanism
      !> Is its time history wanted?
      logical, intent(in) :: with_trace
      !> The engine lanes was asked for, and cannot
      type(error_type), allocatable, intent(out) :: error
      !> Is there vertical motion? No, if absent
      logical, intent(in), optional :: is_shaken

      call check_engine(solver, mechanism, error, is_shaken)
      if (allocated(error) .or. .not. (with_trace .and. solver%engine == 'lanes')) return
      call raise_input(error, 'engine = ''lanes'': gives no time history; must be ''auto'' or ''rk45''')
   end subroutine check_history

end module dondolo_simulate
