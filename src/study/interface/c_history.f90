!> Single motions of the C interface.
module dondolo_interface_c_history
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t, c_null_ptr, c_ptr
   use dondolo_base_error, only : error_type, out_of_range, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_text, only : to_text
   use dondolo_base_warning, only : warnings_type
   use dondolo_building_floors, only : floors_type
   use dondolo_case_motion_warnings, only : warn_of_fall, warn_of_records
   use dondolo_case_result_warnings, only : warn_of_error
   use dondolo_case_wall_warnings, only : wall_warnings_type
   use dondolo_interface_c_error, only : failure_type, is_ready
   use dondolo_interface_c_settings, only : solver_of
   use dondolo_interface_c_text, only : as_handle, as_pointer, check_finite
   use dondolo_interface_c_walls, only : find_wall
   use dondolo_interface_felt_motions, only : check_scale, find_motions
   use dondolo_interface_handles, only : find_suite, hold
   use dondolo_motion_initial_state, only : initial_state_type
   use dondolo_motion_response, only : response_type, trace_type
   use dondolo_motion_simulate, only : simulate
   use dondolo_motion_solver, only : solver_type
   use dondolo_record_suite, only : suite_type
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: c_history_type

   !> A motion
   type :: c_history_type
      type(response_type) :: response
      !> Its time history
      type(trace_type) :: trace
      !> Sentences of warnings
      type(lines_type) :: warnings
   end type c_history_type

contains

   !> Compute the motion of a wall under one record, with its time history
   type(c_ptr) function c_run_history(error, wall, records, number, scale, initial_rotation, initial_velocity, solver) &
      & result(made) bind(c, name='dondolo_run_history')
      type(c_ptr), intent(in), value :: error, wall, records
      !> Number of the record, from 0
      integer(c_int), intent(in), value :: number
      !> Factor on it, negative to reverse its polarity
      real(c_double), intent(in), value :: scale
      !> Rotation [rad] and velocity [rad/s] at the start
      real(c_double), intent(in), value :: initial_rotation, initial_velocity
      !> Settings of the group solver; NULL: the defaults
      type(c_ptr), intent(in), value :: solver

      type(failure_type), pointer :: failure
      type(wall_type), pointer :: one
      type(suite_type), pointer :: suite, motions
      type(floors_type), target :: own
      type(solver_type) :: how
      type(initial_state_type) :: initial
      type(c_history_type), pointer :: held
      type(error_type), allocatable :: problem
      class(*), pointer :: content
      integer(c_int64_t) :: handle

      made = c_null_ptr
      if (.not. is_ready(error, failure)) return
      nullify (suite, motions)
      call find_wall(wall, one, problem)
      if (.not. allocated(problem)) call find_suite(as_handle(records), suite, problem)
      if (.not. allocated(problem)) then
         if (number < 0 .or. number >= size(suite%records)) call raise_input(problem, 'number = '//to_text(int(number))// &
            & ': must lie between 0 and '//to_text(size(suite%records) - 1), out_of_range, 'number')
      end if
      if (.not. allocated(problem)) call check_finite([scale], 'scale', problem)
      if (.not. allocated(problem)) call check_scale(suite, int(number) + 1, real(scale, wp), problem)
      if (.not. allocated(problem)) call solver_of(solver, how, problem)
      if (.not. allocated(problem)) call find_motions(one, suite, 1, own, motions, problem)
      if (.not. allocated(problem)) then
         allocate (held)
         initial = initial_state_type(real(initial_rotation, wp), real(initial_velocity, wp))
         call simulate(one%mechanism, motions%records(number + 1), real(scale, wp), how, held%response, problem, held%trace, &
            & initial)
         if (allocated(problem)) then
            deallocate (held)
         else
            call warn(held, one, suite, int(number) + 1)
            content => held
            call hold(content, handle)
            made = as_pointer(handle)
         end if
      end if
      call failure%take(problem)

   contains

      !> Note the warnings of a run
      subroutine warn(held, wall, suite, record)
         type(c_history_type), intent(inout) :: held
         type(wall_type), intent(in) :: wall
         type(suite_type), intent(in) :: suite
         !> Number of the record, from 1
         integer, intent(in) :: record

         type(wall_warnings_type) :: wall_warnings
         type(warnings_type) :: warnings

         call wall_warnings%look(wall)
         call wall_warnings%warn(warnings, suite%records(record:record))
         call warn_of_records(suite, wall%gravity, warnings, record, initial%moves())
         call warn_of_fall(suite%records(record), real(scale, wp), wall%gravity, warnings)
         call warn_of_error(held%response, how%edp_limit, warnings)
         call warnings%put_sentences(held%warnings)
      end subroutine warn

   end function c_run_history

end module dondolo_interface_c_history
