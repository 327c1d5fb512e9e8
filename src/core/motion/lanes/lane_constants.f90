!> Constants of a wall in the engine lanes.
module dondolo_motion_lane_constants
   use dondolo_base_kinds, only : wp
   use dondolo_motion_normal_form, only : new_normal_form, normal_form_type, y_limit
   use dondolo_motion_solver, only : solver_type
   use dondolo_motion_wall_constants, only : new_wall_constants, wall_constants_type
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: lane_constants_type, new_lane_constants

   !> Constants of a wall, with its normal form
   type, extends(wall_constants_type) :: lane_constants_type
      !> The wall in normal form; check that it exists
      type(normal_form_type) :: form
      !> Absolute tolerance of the velocity of y [1/s]
      real(wp) :: atol = 0.0_wp
      !> Largest y and rotation [rad] at the start of a history: peaks below them are not located
      real(wp) :: first_peak = 0.0_wp, first_rotation = 0.0_wp
   end type lane_constants_type

contains

   !> Constants of a mechanism
   function new_lane_constants(mechanism, solver, is_shaken) result(constants)
      class(mechanism_type), intent(in) :: mechanism
      !> Tolerances and limit
      type(solver_type), intent(in) :: solver
      !> Is there vertical motion? No, if absent
      logical, intent(in), optional :: is_shaken
      !> Its constants
      type(lane_constants_type) :: constants

      constants%wall_constants_type = new_wall_constants(mechanism, solver)
      if (mechanism%joint%exists) constants%fastest = max(constants%fastest, mechanism%joint%frequency)
      ! The tighter tolerances of walls with ties are for steps of a lower order.
      constants%solver = solver
      constants%form = new_normal_form(mechanism, constants%limit, is_shaken)
      if (constants%form%exists) then
         constants%atol = solver%atol*mechanism%frequency_parameter()*mechanism%capacity/constants%form%unit
      end if
      ! Ties remember every peak.
      if (.not. solver%collapses_only .or. constants%form%is_restrained) return
      constants%first_peak = y_limit
      constants%first_rotation = constants%limit
   end function new_lane_constants

end module dondolo_motion_lane_constants
