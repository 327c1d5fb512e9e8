!> Constants of a wall and a solver, shared by all histories and by the engines.
module dondolo_motion_wall_constants
   use dondolo_base_kinds, only : wp
   use dondolo_motion_rest, only : new_rest, rest_type
   use dondolo_motion_solver, only : solver_type
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: wall_constants_type, new_wall_constants

   !> Constants of a wall
   type :: wall_constants_type
      !> The wall at rest
      type(rest_type) :: rest
      !> Tolerances of a step, and limit
      type(solver_type) :: solver
      !> Capacity q_c and rotation that counts as collapse [rad]
      real(wp) :: capacity, limit
      !> Gravity [m/s2]
      real(wp) :: gravity
      !> Velocity p q_c, the unit of the absolute tolerance [rad/s]
      real(wp) :: velocity_unit
      !> Largest natural frequency: p, or that of the wall on its ties [rad/s]
      real(wp) :: fastest
   end type wall_constants_type

   !> Factor on the tolerances of the engine rk45 for walls with ties, and what it does not tighten them beyond. They
   !> vibrate on their ties between many impacts, each of which enlarges errors
   real(wp), parameter :: with_ties = 1.0e-4_wp, least_rtol = 1.0e-12_wp, least_atol = 1.0e-14_wp

contains

   !> Constants of a mechanism
   pure function new_wall_constants(mechanism, solver) result(constants)
      class(mechanism_type), intent(in) :: mechanism
      !> Tolerances and limit
      type(solver_type), intent(in) :: solver
      !> Its constants
      type(wall_constants_type) :: constants

      real(wp) :: part

      constants%rest = new_rest(mechanism)
      constants%solver = solver
      if (allocated(mechanism%restraints)) then
         ! A run with halved steps, which estimates errors, has a 32nd of them.
         part = 0.5_wp**(5*(solver%steps_per_sample - 1))
         constants%solver%rtol = max(with_ties*solver%rtol, min(solver%rtol, part*least_rtol))
         constants%solver%atol = max(with_ties*solver%atol, min(solver%atol, part*least_atol))
      end if
      constants%capacity = mechanism%capacity
      constants%gravity = mechanism%gravity
      constants%limit = min(solver%edp_limit*mechanism%capacity, mechanism%unseating)
      constants%velocity_unit = mechanism%frequency_parameter()*mechanism%capacity
      constants%fastest = sqrt(max(mechanism%frequency_parameter()**2, constants%rest%stiffness/constants%rest%inertia))
   end function new_wall_constants

end module dondolo_motion_wall_constants
