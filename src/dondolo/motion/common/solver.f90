!> How a motion is to be computed: engine, tolerances, and the rotation that counts as collapse.
module dondolo_solver
   use dondolo_error, only : error_type, raise_input
   use dondolo_kinds, only : wp
   use dondolo_mechanism, only : mechanism_type
   use dondolo_text, only : join, to_text
   implicit none
   private

   public :: solver_type, check_solver, check_limit, refined, perturbed
   public :: engine_names

   !> Names of the engines; 'auto' takes the one that suits the task
   character(len=5), parameter :: engine_names(3) = [character(len=5) :: 'auto', 'rk45', 'lanes']

   !> Settings of the computation
   type :: solver_type
      !> Engine, one of engine_names
      character(len=16) :: engine = 'auto'
      !> Relative tolerance of a step
      real(wp) :: rtol = 1.0e-8_wp
      !> Absolute tolerance of a step, in units of q_c (rotation) and p q_c (velocity)
      real(wp) :: atol = 1.0e-10_wp
      !> Rotation / capacity at which the wall has collapsed
      real(wp) :: edp_limit = 1.0_wp
      !> Run every history a second time, to estimate the error of its EDP?
      logical :: estimate_error = .false.
      !> Are only collapses wanted, and no EDPs? The engine lanes then leaves out what only peaks need
      logical :: collapses_only = .false.
      !> Least number of steps from sample to sample, and from an event to the next sample
      integer :: steps_per_sample = 1
   end type solver_type

contains

   !> Check the ranges of the settings
   subroutine check_solver(solver, error)
      !> Settings
      type(solver_type), intent(in) :: solver
      !> `variable = value: what is allowed`
      type(error_type), allocatable, intent(out) :: error

      real(wp), parameter :: loosest = 1.0e-2_wp, tightest_rtol = 10.0_wp*epsilon(1.0_wp), tightest_atol = tiny(1.0_wp)

      if (.not. any(solver%engine == engine_names)) then
         call raise_input(error, 'engine = '''//trim(solver%engine)//''': must be one of '//join(engine_names))
      else if (.not. (solver%rtol >= tightest_rtol .and. solver%rtol <= loosest)) then
         call raise_input(error, 'rtol = '//to_text(solver%rtol)//': must lie between '// &
            & to_text(tightest_rtol)//' and '//to_text(loosest))
      else if (.not. (solver%atol >= tightest_atol .and. solver%atol <= loosest)) then
         call raise_input(error, 'atol = '//to_text(solver%atol)//': must be positive and at most '//to_text(loosest))
      else if (.not. (solver%edp_limit > 0.0_wp .and. solver%edp_limit <= huge(1.0_wp))) then
         call raise_input(error, 'edp_limit = '//to_text(solver%edp_limit)//': must be positive')
      end if
   end subroutine check_solver

   !> Settings that halve the steps, whether samples or tolerances limit them; where a tolerance is so tight that
   !> rounding would undo that, they double the steps
   elemental function refined(solver) result(other)
      !> Settings
      type(solver_type), intent(in) :: solver
      !> Other settings
      type(solver_type) :: other

      ! Half a step has a 32nd of the error that the control of the step looks at.
      real(wp), parameter :: ratio = 32.0_wp, least_rtol = 50.0_wp*epsilon(1.0_wp)
      real(wp) :: factor

      factor = merge(ratio, 1.0_wp/ratio, solver%rtol < ratio*least_rtol)
      other = solver
      other%rtol = factor*solver%rtol
      other%atol = factor*solver%atol
      other%steps_per_sample = 2*solver%steps_per_sample
   end function refined

   !> Factor on a record that differs by as much as all rounding of a history comes to: what it changes tells what
   !> rounding may have changed, where that is more than the steps do
   elemental real(wp) function perturbed(scale)
      !> Factor
      real(wp), intent(in) :: scale

      real(wp), parameter :: units_in_the_last_place = 8.0_wp

      perturbed = scale*(1.0_wp + units_in_the_last_place*epsilon(scale))
   end function perturbed

   !> Check that a mechanism can reach the limit rotation
   subroutine check_limit(solver, mechanism, error)
      !> Settings
      type(solver_type), intent(in) :: solver
      !> The mechanism
      class(mechanism_type), intent(in) :: mechanism
      !> The limit lies beyond its geometric end
      type(error_type), allocatable, intent(out) :: error

      if (solver%edp_limit*mechanism%capacity < mechanism%geometric_end()) return
      call raise_input(error, 'edp_limit = '//to_text(solver%edp_limit)//': must be less than '// &
         & to_text(mechanism%geometric_end()/mechanism%capacity)//', where the geometry of this wall ends')
   end subroutine check_limit

end module dondolo_solver
