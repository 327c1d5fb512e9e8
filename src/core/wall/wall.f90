!> A wall: its properties as the user gives them, and the mechanism that follows.
module dondolo_wall
   use dondolo_base_error, only : error_type, not_together, out_of_range, problems_type, wrong_length
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : check_number
   use dondolo_base_settings_check, only : check_settings
   use dondolo_base_text, only : to_text
   use dondolo_building_input, only : new_building
   use dondolo_wall_chain_model, only : chain_model_type
   use dondolo_wall_elastic_branch, only : add_elastic_joint, usual_damping
   use dondolo_wall_gravity, only : gravity_property
   use dondolo_wall_hinge_level, only : cut_wall, read_hinge_levels, has_hinge_level
   use dondolo_wall_mechanism_words, only : check_mechanism
   use dondolo_wall_model, only : wall_model_type
   use dondolo_wall_one_block_model, only : one_block_model_type
   use dondolo_wall_properties, only : is_beyond_bare, is_of_building, masonry_names, mechanism_names, wall_input_type
   use dondolo_wall_restitution, only : impact_models_type, restitution_type
   use dondolo_wall_restitution_scatter, only : new_restitution_scatter
   use dondolo_wall_specimen, only : specimen_type
   use dondolo_wall_tabulated_model, only : chain_name, horizontal_name, tabulated_model_type, tabulated_name
   use dondolo_wall_two_block_model, only : two_block_model_type, two_block_name
   implicit none
   private

   public :: wall_input_type, wall_type, new_wall
   public :: masonry_names, mechanism_names

   !> A wall: what was said of it with every default filled in, and its mechanism
   type, extends(specimen_type) :: wall_type
      !> Every property that applies to the mechanism has a value; a bearing has become an eccentricity
      type(wall_input_type) :: input
      !> What its mechanism is made of
      class(wall_model_type), allocatable :: model
      !> Speed ratio of its impacts by each model of restitution
      type(impact_models_type) :: impacts
   contains
      !> Its name
      procedure :: name
      !> Name of its mechanism
      procedure :: mechanism_name
   end type wall_type

contains

   ! The length precedes the functions whose results it sizes; otherwise gfortran 12 reports an implicit interface.

   !> Length of a text of a wall
   pure integer function text_length(wall, property)
      class(wall_type), intent(in) :: wall
      !> Name of the property
      character(len=*), intent(in) :: property

      text_length = len(wall%input%word(property))
   end function text_length

   !> Name of a wall
   pure function name(self)
      class(wall_type), intent(in) :: self
      !> Its name
      character(len=text_length(self, 'name')) :: name

      name = self%input%word('name')
   end function name

   !> Name of a wall's mechanism
   pure function mechanism_name(self)
      class(wall_type), intent(in) :: self
      !> One of mechanism_names
      character(len=text_length(self, 'mechanism')) :: mechanism_name

      mechanism_name = self%input%word('mechanism')
   end function mechanism_name

   !> Make a wall and check all that is said of it
   subroutine new_wall(wall, input, error, gravity)
      type(wall_type), intent(out) :: wall
      !> Its input
      type(wall_input_type), intent(in) :: input
      !> Everything that is wrong with it, one thing a line: `variable = value: what is allowed`
      type(error_type), allocatable, intent(out) :: error
      !> Gravity [m/s2]
      real(wp), intent(in), optional :: gravity

      type(problems_type) :: problems
      type(wall_input_type) :: above
      type(restitution_type) :: restitution
      real(wp), allocatable :: levels(:)
      real(wp) :: share, tilt

      if (present(gravity)) wall%gravity = gravity
      call understand(wall, input, problems)
      if (problems%count == 0 .and. has_hinge_level(input)) then
         call read_hinge_levels(wall%input, problems, levels)
         if (problems%count == 0 .and. size(levels) > 1) call problems%note('hinge_level: has '//to_text(size(levels))// &
            & ' values, a wall has one; a facade with several is a population, task = ''typology''', wrong_length, 'hinge_level')
         above = input
         if (problems%count == 0) call cut_wall(above, levels(1), problems)
         if (problems%count == 0) call understand(wall, above, problems)
      end if
      call problems%raise(error)
      if (allocated(error)) return
      call wall%model%make_mechanism(wall%input, wall%gravity, wall%mechanism, wall%impacts, error)
      if (allocated(error)) return
      restitution = restitution_of(wall%input)
      call restitution%speed_ratio(wall%impacts, wall%mechanism%restitution, error)
      if (.not. allocated(error) .and. wall%input%has('restitution_sd')) call new_restitution_scatter(wall%mechanism%scatter, &
         & wall%mechanism%restitution, wall%input%number('restitution_sd'), nint(wall%input%number('restitution_seed')), error)
      if (.not. allocated(error) .and. wall%input%has('elastic_period')) call add_elastic_joint(wall%mechanism, &
         & wall%input%number('elastic_period'), wall%input%number('elastic_damping'), error)
      if (allocated(error) .or. .not. allocated(wall%building)) return
      call wall%mechanism%support(share, tilt)
      call wall%building%lean(share, tilt)
   end subroutine new_wall

   !> The model of a mechanism, nothing of it known. Mechanisms other than those of one block are listed here
   subroutine new_model(model, mechanism)
      class(wall_model_type), allocatable, intent(out) :: model
      !> Name of the mechanism, one of mechanism_names or empty
      character(len=*), intent(in) :: mechanism

      select case (mechanism)
      case (two_block_name)
         allocate (two_block_model_type :: model)
      case (tabulated_name)
         allocate (tabulated_model_type :: model)
      case (chain_name, horizontal_name)
         allocate (chain_model_type :: model)
      case default
         allocate (one_block_model_type :: model)
      end select
   end subroutine new_model

   !> Fill in defaults and check the properties of a wall, but not whether it stands
   subroutine understand(wall, input, problems)
      !> The wall: all but its mechanism is set
      type(wall_type), intent(inout) :: wall
      !> Its input
      type(wall_input_type), intent(in) :: input
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems

      character(len=:), allocatable :: mechanism, allowed

      wall%input = input
      if (allocated(wall%building)) deallocate (wall%building)
      mechanism = input%word('mechanism')
      if (.not. any(mechanism == mechanism_names)) mechanism = ''
      call new_model(wall%model, mechanism)
      call wall%model%prepare(wall%input, problems)
      call take_seed(wall%input, problems)
      call take_damping(wall%input, problems)
      call wall%input%fill(mechanism)
      call wall%input%set('name', trim(wall%input%word('name')))
      if (input%has('mechanism')) call check_mechanism(input%word('mechanism'), mechanism_names, problems)
      call check_settings(wall%input, problems, 'mechanism', mechanism)
      if (problems%count == 0 .and. wall%input%gives(is_of_building)) then
         if (wall%input%has('base_level')) call problems%note('base_level = '//to_text(wall%input%number('base_level'))// &
            & ': not on a building that is given, whose level it is', not_together, 'base_level')
         allocate (wall%building)
         call new_building(wall%building, wall%input, problems, wall%model%contact, wall%input%number('height'))
      end if
      call check_number(gravity_property, wall%gravity, allowed)
      if (allocated(allowed)) call problems%note('gravity = '//to_text(wall%gravity)//': '//allowed, out_of_range, &
         & 'gravity')
      wall%model%is_bare = .not. wall%input%gives(is_beyond_bare)
      call wall%model%read(wall%input, wall%gravity, problems)
   end subroutine understand

   !> Set the seed of speed ratios that vary, and check it
   subroutine take_seed(input, problems)
      !> Input of the wall
      type(wall_input_type), intent(inout) :: input
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems

      if (input%has('restitution_sd') .and. .not. input%has('restitution_seed')) call input%set('restitution_seed', 1.0_wp)
      if (input%has('restitution_seed') .and. .not. input%has('restitution_sd')) call problems%note( &
         & 'restitution_seed: only with restitution_sd', not_together, 'restitution_seed')
   end subroutine take_seed

   !> Set the damping of joints that bend, and check it
   subroutine take_damping(input, problems)
      !> Input of the wall
      type(wall_input_type), intent(inout) :: input
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems

      if (input%has('elastic_period') .and. .not. input%has('elastic_damping')) call input%set('elastic_damping', usual_damping)
      if (input%has('elastic_damping') .and. .not. input%has('elastic_period')) call problems%note( &
         & 'elastic_damping: only with elastic_period', not_together, 'elastic_damping')
   end subroutine take_damping

   !> What the user asks of the impacts
   pure function restitution_of(input) result(restitution)
      !> Input of the wall
      type(wall_input_type), intent(in) :: input
      !> The same as one thing
      type(restitution_type) :: restitution

      restitution%model = input%word('restitution')
      if (input%has('restitution_value')) restitution%value = input%number('restitution_value')
      restitution%factor = input%number('restitution_factor')
   end function restitution_of

end module dondolo_wall
