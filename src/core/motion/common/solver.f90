!> How a motion is to be computed: engine, tolerances, and the rotation that counts as collapse.
module dondolo_motion_solver
   use dondolo_base_error, only : error_type, not_a_word, out_of_range, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : blank, check_number, check_word, choices_length, is_logical, is_text, most_choices, &
      & property_type
   use dondolo_base_settings, only : settings_type
   use dondolo_base_text, only : brief, to_text
   use dondolo_wall_gravity, only : gravity_property
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: solver_type, check_solver, check_limit, refined
   public :: solver_properties, take_solver, put_solver, engine_names

   !> Names of the engines; 'auto' takes the one that suits the task
   character(len=choices_length), parameter :: engine_names(*) = &
      & [character(len=choices_length) :: 'auto', 'rk45', 'lanes']

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
      !> Whether to run every history twice more, to estimate the error of its EDP
      logical :: estimate_error = .false.
      !> Whether to rerun in 33 digits the histories whose error leaves their outcome in doubt
      logical :: certify = .false.
      !> Are only collapses wanted, and no EDPs? The engine lanes then leaves out what only peaks need
      logical :: collapses_only = .false.
      !> Least number of steps from sample to sample, and from an event to the next sample
      integer :: steps_per_sample = 1
   end type solver_type

   !> Settings unless the user sets them
   type(solver_type), parameter :: standard = solver_type()

   !> Tasks that keep every EDP
   character(len=choices_length), parameter :: with_edps(most_choices) = &
      & reshape([character(len=choices_length) :: 'history', 'stripes'], [most_choices], pad=blank)

   !> Tasks that count outcomes and keep every EDP
   character(len=choices_length), parameter :: stripes_only(most_choices) = &
      & reshape([character(len=choices_length) :: 'stripes'], [most_choices], pad=blank)

   !> Settings of a user; they include gravity, which belongs to walls, for all walls of a case
   type(property_type), target, protected :: solver_properties(7) = [ &
      & property_type('engine', is_text, word=standard%engine, meaning='engine; ''auto'' selects the one that suits the task', &
      &   choices=reshape(engine_names, [most_choices], pad=blank)), &
      & property_type('rtol', default=standard%rtol, smallest=10.0_wp*epsilon(1.0_wp), largest=1.0e-2_wp, &
      &   meaning='relative error of a step'), &
      & property_type('atol', default=standard%atol, positive=.true., largest=1.0e-2_wp, &
      &   meaning='absolute error of a step, 1 = the capacity'), &
      & property_type('edp_limit', default=standard%edp_limit, positive=.true., &
      &   meaning='rotation / capacity rotation that counts as collapse'), &
      & property_type('estimate_error', is_logical, owners=with_edps, changes_results=.false., &
      &   meaning='estimate the error of each EDP; takes about three times as long'), &
      & property_type('certify', is_logical, owners=stripes_only, changes_results=.false., &
      &   meaning='estimate errors, and rerun every history that they leave in doubt in 33 digits'), &
      & gravity_property]

contains

   !> Read the settings of a user
   subroutine take_solver(solver, settings)
      !> Settings of the computation
      type(solver_type), intent(out) :: solver
      !> Values of solver_properties, defaults filled in
      class(settings_type), intent(in) :: settings

      solver%engine = settings%word('engine')
      solver%rtol = settings%number('rtol')
      solver%atol = settings%number('atol')
      solver%edp_limit = settings%number('edp_limit')
      solver%certify = settings%holds('certify')
      solver%estimate_error = solver%certify .or. settings%holds('estimate_error')
   end subroutine take_solver

   !> Write settings as a user would
   subroutine put_solver(solver, settings)
      !> Settings of the computation
      type(solver_type), intent(in) :: solver
      !> Values of solver_properties
      class(settings_type), intent(inout) :: settings

      call settings%set('engine', solver%engine)
      call settings%set('rtol', solver%rtol)
      call settings%set('atol', solver%atol)
      call settings%set('edp_limit', solver%edp_limit)
      call settings%set('estimate_error', solver%estimate_error)
      call settings%set('certify', solver%certify)
   end subroutine put_solver

   !> Check the ranges of the settings
   subroutine check_solver(solver, error)
      type(solver_type), intent(in) :: solver
      !> `variable = value: what is allowed`
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: allowed, code
      integer :: i

      do i = 1, size(solver_properties)
         associate (property => solver_properties(i))
            code = out_of_range
            select case (property%name)
            case ('engine')
               code = not_a_word
               call check_word(property, trim(solver%engine), allowed)
               if (allocated(allowed)) allowed = ''''//trim(solver%engine)//''': '//allowed
            case ('rtol')
               call check_range(property, solver%rtol, allowed)
            case ('atol')
               call check_range(property, solver%atol, allowed)
            case ('edp_limit')
               call check_range(property, solver%edp_limit, allowed)
            end select
            if (.not. allocated(allowed)) cycle
            call raise_input(error, trim(property%name)//' = '//allowed, code, trim(property%name))
            return
         end associate
      end do
   end subroutine check_solver

   !> Check a number of the settings
   subroutine check_range(property, value, allowed)
      type(property_type), intent(in) :: property
      !> Its value
      real(wp), intent(in) :: value
      !> `value: what is allowed`; not allocated: it is right
      character(len=:), allocatable, intent(out) :: allowed

      call check_number(property, value, allowed)
      if (allocated(allowed)) allowed = to_text(value)//': '//allowed
   end subroutine check_range

   !> Settings that halve the steps, whether samples or tolerances limit them; where a tolerance is so tight that
   !> rounding would undo that, they double the steps
   elemental function refined(solver) result(other)
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

   !> Check that a mechanism can reach the limit rotation
   subroutine check_limit(solver, mechanism, error)
      type(solver_type), intent(in) :: solver
      class(mechanism_type), intent(in) :: mechanism
      !> The limit lies beyond its geometric end, or where its joints are closed
      type(error_type), allocatable, intent(out) :: error

      if (solver%edp_limit*mechanism%capacity <= mechanism%joint%opening) then
         call raise_input(error, 'edp_limit = '//to_text(solver%edp_limit)//': must be more than '// &
            & brief(mechanism%joint%opening/mechanism%capacity)//', where the joints of this wall open', out_of_range, 'edp_limit')
         return
      end if
      if (solver%edp_limit*mechanism%capacity < mechanism%geometric_end()) return
      call raise_input(error, 'edp_limit = '//to_text(solver%edp_limit)//': must be less than '// &
         & brief(mechanism%geometric_end()/mechanism%capacity)//', where the geometry of this wall ends', out_of_range, 'edp_limit')
   end subroutine check_limit

end module dondolo_motion_solver
