!> What stays the same for all histories of a wall in the engine lanes.
module dondolo_lane_stage
   use dondolo_kinds, only : wp
   use dondolo_mechanism, only : mechanism_type
   use dondolo_normal_form, only : new_normal_form, normal_form_type, y_limit
   use dondolo_rest, only : new_rest, rest_type
   use dondolo_solver, only : solver_type
   implicit none
   private

   public :: stage_type, new_stage

   !> A wall, prepared
   type :: stage_type
      !> The wall in normal form; check that it exists
      type(normal_form_type) :: form
      !> The wall at rest
      type(rest_type) :: rest
      !> Tolerances and limit
      type(solver_type) :: solver
      !> Absolute tolerance of the velocity of y [1/s]
      real(wp) :: atol = 0.0_wp
      !> Largest y and rotation [rad] so far at the start of a history: peaks below them are not wanted
      real(wp) :: first_peak = 0.0_wp, first_rotation = 0.0_wp
   end type stage_type

contains

   !> Prepare a wall
   pure function new_stage(mechanism, solver) result(stage)
      !> The mechanism
      class(mechanism_type), intent(in) :: mechanism
      !> Tolerances and limit
      type(solver_type), intent(in) :: solver
      !> The wall
      type(stage_type) :: stage

      stage%form = new_normal_form(mechanism, solver%edp_limit*mechanism%capacity)
      stage%rest = new_rest(mechanism)
      stage%solver = solver
      if (stage%form%exists) &
         & stage%atol = solver%atol*mechanism%frequency_parameter()*mechanism%capacity/stage%form%unit
      if (.not. solver%collapses_only) return
      stage%first_peak = y_limit
      stage%first_rotation = solver%edp_limit*mechanism%capacity
   end function new_stage

end module dondolo_lane_stage
