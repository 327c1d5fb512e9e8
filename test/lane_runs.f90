!> Histories through the engine lanes, as an ensemble runs them.
module lane_runs
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_motion_ensemble, only : ensemble_type, run_ensemble
   use dondolo_motion_normal_form, only : new_normal_form, normal_form_type
   use dondolo_motion_response, only : response_type
   use dondolo_motion_solver, only : solver_type
   use dondolo_motion_work, only : work_type
   use dondolo_record, only : record_type
   use dondolo_record_suite, only : new_suite, suite_type
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: run_lanes, run_alone, runs_in_lanes

contains

   !> Does the engine lanes follow a mechanism up to its limit?
   logical function runs_in_lanes(mechanism, solver)
      class(mechanism_type), intent(in) :: mechanism
      type(solver_type), intent(in) :: solver
      type(normal_form_type) :: form

      form = new_normal_form(mechanism, solver%edp_limit*mechanism%capacity)
      runs_in_lanes = form%exists
   end function runs_in_lanes

   !> Many histories: record and scale of each
   subroutine run_lanes(mechanism, records, record, scale, solver, response, work, threads)
      class(mechanism_type), intent(in) :: mechanism
      type(record_type), intent(in) :: records(:)
      integer, intent(in) :: record(:)
      real(wp), intent(in) :: scale(:)
      type(solver_type), intent(in) :: solver
      type(response_type), allocatable, intent(out) :: response(:)
      type(work_type), intent(out), optional :: work
      integer, intent(in), optional :: threads
      type(ensemble_type) :: ensemble
      type(suite_type) :: suite
      type(record_type), allocatable :: copies(:)
      type(solver_type) :: in_lanes
      type(error_type), allocatable :: error
      integer :: team

      team = 1
      if (present(threads)) team = threads
      ! Not by assignment, for which gfortran compares bounds that are not there yet: a sanitizer takes that for an overflow
      allocate (ensemble%record, source=record)
      allocate (ensemble%scale, source=scale)
      in_lanes = solver
      in_lanes%engine = 'lanes'
      copies = records
      call new_suite(suite, copies)
      ! That a history was given up is seen in its response.
      call run_ensemble(ensemble, mechanism, suite, in_lanes, team, error)
      call move_alloc(ensemble%response, response)
      if (present(work)) work = ensemble%work
   end subroutine run_lanes

   !> One history by itself
   subroutine run_alone(mechanism, record, scale, solver, response, work)
      class(mechanism_type), intent(in) :: mechanism
      type(record_type), intent(in) :: record
      real(wp), intent(in) :: scale
      type(solver_type), intent(in) :: solver
      type(response_type), intent(out) :: response
      type(work_type), intent(out), optional :: work
      type(response_type), allocatable :: responses(:)

      call run_lanes(mechanism, [record], [1], [scale], solver, responses, work)
      response = responses(1)
   end subroutine run_alone

end module lane_runs
