!> One history by steps: of rigid blocks, or of a wall whose joints bend before they open.
module dondolo_motion_one_history
   use dondolo_base_kinds, only : wp
   use dondolo_motion_elastic_motion, only : simulate_elastic
   use dondolo_motion_initial_state, only : initial_state_type
   use dondolo_motion_response, only : response_type, trace_type
   use dondolo_motion_rk45, only : simulate_rk45
   use dondolo_motion_solver, only : solver_type
   use dondolo_motion_work, only : work_type
   use dondolo_record, only : record_type
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: simulate_one

contains

   !> The motion of a wall under an accelerogram, by the engine rk45
   subroutine simulate_one(mechanism, record, scale, solver, response, trace, initial, work)
      class(mechanism_type), intent(in) :: mechanism
      type(record_type), intent(in) :: record
      !> Factor on it, negative to reverse its polarity
      real(wp), intent(in) :: scale
      !> Tolerances and limit
      type(solver_type), intent(in) :: solver
      type(response_type), intent(out) :: response
      !> Time history; computed only if present
      type(trace_type), intent(inout), optional :: trace
      !> Rotation and velocity at the start; absent: at rest
      type(initial_state_type), intent(in), optional :: initial
      !> Counts, added to
      type(work_type), intent(inout), optional :: work

      if (mechanism%joint%exists) then
         call simulate_elastic(mechanism, record, scale, solver, response, trace, initial, work)
      else
         call simulate_rk45(mechanism, record, scale, solver, response, trace, initial, work)
      end if
   end subroutine simulate_one

end module dondolo_motion_one_history
