!> The group &solver: how the motions are computed.
module dondolo_case_solver_group
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_settings, only : group_settings_type, new_settings
   use dondolo_case_namelist_group, only : group_type
   use dondolo_case_settings_group, only : read_settings
   use dondolo_motion_solver, only : put_solver, solver_properties, solver_type, take_solver
   use dondolo_wall_gravity, only : standard_gravity
   implicit none
   private

   public :: solver_input_type, read_solver_group

   !> Input of the computation
   type :: solver_input_type
      !> Engine, tolerances and limit
      type(solver_type) :: solver
      !> Gravity [m/s2]
      real(wp) :: gravity = standard_gravity
   contains
      !> The same as settings
      procedure :: put
   end type solver_input_type

contains

   !> Read the group
   subroutine read_solver_group(group, input, error)
      !> The group as read from the file
      type(group_type), intent(in) :: group
      !> Input of the computation
      type(solver_input_type), intent(out) :: input
      !> What is wrong with it
      type(error_type), allocatable, intent(out) :: error

      type(group_settings_type) :: settings

      call new_settings(settings, solver_properties)
      call read_settings(group, settings, error)
      if (allocated(error)) return
      call take_solver(input%solver, settings)
      input%gravity = settings%number('gravity')
   end subroutine read_solver_group

   !> Input of the computation as settings
   subroutine put(self, settings)
      !> Input of the computation
      class(solver_input_type), intent(in) :: self
      !> Values of solver_properties
      type(group_settings_type), intent(out) :: settings

      call new_settings(settings, solver_properties)
      call put_solver(self%solver, settings)
      call settings%set('gravity', self%gravity)
   end subroutine put

end module dondolo_case_solver_group
