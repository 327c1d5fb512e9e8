!> The group &solver: how the motions are computed.
module dondolo_solver_group
   use dondolo_error, only : error_type
   use dondolo_kinds, only : wp
   use dondolo_namelist_group, only : group_type
   use dondolo_settings, only : settings_type
   use dondolo_solver, only : check_solver, engine_names, solver_type
   use dondolo_text, only : join, lower
   use dondolo_wall, only : standard_gravity
   implicit none
   private

   public :: solver_input_type, read_solver_group, echo_solver
   public :: solver_variables

   !> Variables of the group
   character(len=14), parameter :: solver_variables(6) = &
      & [character(len=14) :: 'engine', 'rtol', 'atol', 'edp_limit', 'estimate_error', 'gravity']

   !> Largest gravity that makes sense [m/s2]
   real(wp), parameter :: largest_gravity = 1.0e3_wp

   !> What is said of the computation
   type :: solver_input_type
      !> Engine, tolerances and limit
      type(solver_type) :: solver
      !> Gravity [m/s2]
      real(wp) :: gravity = standard_gravity
   end type solver_input_type

contains

   !> Read the group
   subroutine read_solver_group(group, input, error)
      !> The group as it stands in the file
      type(group_type), intent(in) :: group
      !> What is said of the computation
      type(solver_input_type), intent(out) :: input
      !> What is wrong with it
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: engine

      engine = input%solver%engine
      call group%check_names(solver_variables, error)
      if (.not. allocated(error)) call group%get_text('engine', engine, error)
      if (.not. allocated(error)) call group%get_real('rtol', input%solver%rtol, error)
      if (.not. allocated(error)) call group%get_real('atol', input%solver%atol, error)
      if (.not. allocated(error)) call group%get_real('edp_limit', input%solver%edp_limit, error)
      if (.not. allocated(error)) call group%get_logical('estimate_error', input%solver%estimate_error, error)
      if (.not. allocated(error)) call group%get_real('gravity', input%gravity, error)
      if (allocated(error)) return
      engine = lower(trim(engine))
      if (.not. any(engine == engine_names)) then
         call group%refuse('engine', 'must be one of '//join(engine_names), error)
      else if (.not. (input%gravity > 0.0_wp .and. input%gravity <= largest_gravity)) then
         call group%refuse('gravity', 'must be positive and at most 1000 m/s2', error)
      else
         input%solver%engine = engine
         call check_solver(input%solver, error)
         call group%locate(error)
      end if
   end subroutine read_solver_group

   !> Write the group as namelist text with every value in force
   subroutine echo_solver(input, settings)
      !> What is said of the computation
      type(solver_input_type), intent(in) :: input
      !> Settings to add to
      type(settings_type), intent(inout) :: settings

      call settings%add('solver', 'engine', trim(input%solver%engine))
      call settings%add('solver', 'rtol', input%solver%rtol)
      call settings%add('solver', 'atol', input%solver%atol, joins=.true.)
      call settings%add('solver', 'edp_limit', input%solver%edp_limit)
      call settings%add('solver', 'estimate_error', input%solver%estimate_error)
      call settings%add('solver', 'gravity', input%gravity)
   end subroutine echo_solver

end module dondolo_solver_group
