!> Walls of two blocks: 'two_block'. Its name, its properties, and how it becomes a mechanism (dondolo_wall_two_block).
module dondolo_wall_two_block_model
   use dondolo_base_error, only : error_type, not_given, not_together, out_of_range, problems_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_property, only : blank, choices_length, is_text, most_choices, name_length, property_type
   use dondolo_base_settings, only : settings_type
   use dondolo_base_text, only : brief, rounded, to_text
   use dondolo_building_input, only : spans
   use dondolo_wall_block, only : block_type, new_block
   use dondolo_wall_hinge_depth, only : check_hinge, read_hinge_depth
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_model, only : wall_model_type
   use dondolo_wall_restitution, only : impact_models_type
   use dondolo_wall_two_block, only : new_two_block, overburden_type, two_block_impulse, two_block_sorrentino, two_block_type
   implicit none
   private

   public :: two_block_model_type, two_block_name, two_block_hinge_rows, two_block_load_rows

   !> Name of the mechanism
   character(len=choices_length), parameter :: two_block_name = 'two_block'

   !> Owners of what it alone has
   character(len=choices_length), parameter :: two_block(most_choices) = reshape([two_block_name], [most_choices], pad=blank)

   !> Where an overburden can bear on the top of a wall
   character(len=choices_length), parameter :: bearing_names(*) = &
      & [character(len=choices_length) :: 'inner', 'outer', 'centre']

   !> Properties of its geometry
   type(property_type), parameter :: two_block_hinge_rows(*) = [ &
      & property_type('hinge', default=0.5_wp, smallest=0.01_wp, largest=0.99_wp, owners=two_block, &
      &   meaning='height of the intermediate hinge / height of the wall')]

   !> Properties of what it carries
   type(property_type), parameter :: two_block_load_rows(*) = [ &
      & property_type('overburden', unit='N/m', default=0.0_wp, smallest=0.0_wp, largest=1.0e9_wp, owners=two_block, &
      &   meaning='vertical load on the top, per metre of wall', usual_least=200.0_wp, usual_most=1.0e6_wp, &
      &   if_more='is it per metre of wall?'), &
      & property_type('overburden_inertia', smallest=0.0_wp, largest=1.0_wp, owners=two_block, optional=.true., &
      &   example='1.0', meaning='part of that load whose mass the wall lifts', &
      &   more='0 for a force alone (springs, tendons), 1 for a storey above; given with it'), &
      & property_type('eccentricity', unit='m', default=0.0_wp, owners=two_block, usual_most=3.0_wp, &
      &   meaning='distance of that load '// &
      &   'from the centreline towards the active top hinge', more='the outer face where the wall folds outwards; '// &
      &   'negative for an inner bearing'), &
      & property_type('bearing', is_text, optional=.true., owners=two_block, replaced=.true., example='centre', &
      &   choices=reshape(bearing_names, [most_choices], pad=blank), meaning='where that load bears, '// &
      &   'instead of the eccentricity'), &
      & property_type('bearing_distance', unit='m', optional=.true., owners=two_block, replaced=.true., &
      &   example='0.06', usual_most=3.0_wp, &
      &   meaning='distance of the load''s resultant from the inner or the outer face', &
      &   more='half the length that joists bear')]

   !> A wall of two blocks
   type, extends(wall_model_type) :: two_block_model_type
      !> Was a bearing given, and was an eccentricity?
      logical :: bears = .false., is_eccentric = .false.
   contains
      procedure :: prepare
      procedure :: read
      procedure :: make_mechanism
      procedure :: describe
   end type two_block_model_type

contains

   !> Note how the place of the overburden was given
   subroutine prepare(self, input, problems)
      class(two_block_model_type), intent(inout) :: self
      !> Properties as given
      class(settings_type), intent(inout) :: input
      !> Takes nothing: what does not agree is noted once defaults are filled in
      type(problems_type), intent(inout) :: problems

      associate (those => problems)
      end associate
      self%contact = spans
      self%bears = input%has('bearing') .or. input%has('bearing_distance')
      self%is_eccentric = input%has('eccentricity')
   end subroutine prepare

   !> Read the place of the overburden and the depth of the hinges
   subroutine read(self, input, gravity, problems)
      class(two_block_model_type), intent(inout) :: self
      !> Properties, defaults filled in; out: a bearing has become an eccentricity
      class(settings_type), intent(inout) :: input
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> In: values beyond their ranges; takes what is wrong
      type(problems_type), intent(inout) :: problems

      ! Beside a bearing the default would be a second place of the load
      if (self%bears .and. .not. self%is_eccentric) call input%clear('eccentricity')
      call check_load(problems, input)
      if (problems%count > 0) return
      if (self%bears) call replace_bearing(input)
      call read_hinges(input, gravity, problems, self%hinge_depth)
   end subroutine read

   !> Make the mechanism
   subroutine make_mechanism(self, input, gravity, mechanism, impacts, error)
      class(two_block_model_type), intent(inout) :: self
      !> Properties
      class(settings_type), intent(in) :: input
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> The mechanism
      class(mechanism_type), allocatable, intent(out) :: mechanism
      !> Speed ratios of its impacts: equation (4) repaired, which knows no mass on the top, and 'impulse'
      type(impact_models_type), intent(out) :: impacts
      !> It does not stand at rest
      type(error_type), allocatable, intent(out) :: error

      type(two_block_type), allocatable :: made
      type(block_type) :: lower, upper
      type(overburden_type) :: overburden
      real(wp) :: height, thickness, density, hinge, weight, inertia

      height = input%number('height')
      thickness = input%number('thickness')
      density = input%number('density')
      weight = input%number('overburden')
      inertia = input%number('overburden_inertia')
      hinge = input%number('hinge')
      lower = new_block(hinge*height, thickness, density, self%hinge_depth)
      upper = new_block((1.0_wp - hinge)*height, thickness, density, self%hinge_depth)
      self%radius = lower%radius
      self%alpha = lower%alpha
      overburden = overburden_type(weight, input%number('eccentricity'), (1.0_wp - inertia)*weight, inertia*weight/gravity)
      allocate (made)
      call new_two_block(made, lower, upper, overburden, gravity, error)
      call move_alloc(made, mechanism)
      if (allocated(error)) return
      if (.not. overburden%lifted > 0.0_wp) impacts%sorrentino = two_block_sorrentino(lower, upper)
      impacts%impulse = two_block_impulse(lower, upper, overburden)
   end subroutine make_mechanism

   !> Describe the blocks and the overburden
   subroutine describe(self, input, gravity, lines)
      class(two_block_model_type), intent(in) :: self
      !> Properties
      class(settings_type), intent(in) :: input
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> `subject: numbers with their units`
      type(lines_type), intent(inout) :: lines

      real(wp) :: mass, load, inertia

      associate (of => self)
      end associate
      mass = input%number('density')*input%number('height')*input%number('thickness')
      load = input%number('overburden')
      inertia = input%number('overburden_inertia')
      call lines%add('masonry: '//rounded(mass)//' kg/m, '//rounded(input%number('hinge')*mass)//' below the hinge at '// &
         & rounded(input%number('hinge')*input%number('height'))//' m, '//rounded((1.0_wp - input%number('hinge'))*mass)// &
         & ' above; centroids half as deep as the blocks are thick')
      if (load > 0.0_wp) call lines%add('load: '//rounded(load)//' N/m, lifted '//rounded(inertia*load/gravity)// &
         & ' kg/m, dead '//rounded((1.0_wp - inertia)*load)//' N/m')
   end subroutine describe

   !> The depth of the hinges of a wall of two blocks: those at base and top and the intermediate one
   subroutine read_hinges(input, gravity, problems, depth)
      !> Settings of the wall, its eccentricity known
      class(settings_type), intent(in) :: input
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> Depth behind the faces [m], that of the base hinge, which carries the most
      real(wp), intent(out) :: depth

      character(len=name_length) :: name
      real(wp) :: half, load

      half = 0.5_wp*input%number('thickness')
      call read_hinge_depth(input, gravity*input%number('density')*2.0_wp*half*input%number('height') &
         & + input%number('overburden'), problems, depth, name)
      call check_hinge(input, problems, name, depth, half, 'half the thickness, '//rounded(half)//' m', &
         & 'thickness')
      load = half - input%number('eccentricity')
      if (input%number('overburden') > 0.0_wp .and. depth > 0.0_wp) call check_hinge(input, problems, name, depth, load, &
         & 'the overburden, '//rounded(load)//' m behind the face of the active top hinge', 'eccentricity')
   end subroutine read_hinges

   !> Turn the bearing into the eccentricity of a wall that folds outwards: its top rotates about the outer face
   subroutine replace_bearing(input)
      !> Settings of the wall, checked
      class(settings_type), intent(inout) :: input

      real(wp) :: half, distance

      half = 0.5_wp*input%number('thickness')
      distance = input%number('bearing_distance')
      select case (input%word('bearing'))
      case ('inner')
         call input%set('eccentricity', distance - half)
      case ('outer')
         call input%set('eccentricity', half - distance)
      case ('centre')
         call input%set('eccentricity', 0.0_wp)
      end select
      call input%clear('bearing')
      call input%clear('bearing_distance')
   end subroutine replace_bearing

   !> Check where a load bears against the thickness of the wall, and whether its mass is known
   subroutine check_load(problems, input)
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> Settings of the wall, defaults filled in
      class(settings_type), intent(in) :: input

      real(wp) :: thickness, half, distance, eccentricity

      if (input%number('overburden') > 0.0_wp .and. .not. input%has('overburden_inertia')) call problems%note( &
         & 'overburden_inertia: must be given with overburden: 0 (a dead force, as of springs or tendons) to 1 (a mass '// &
         & 'that the wall lifts, as of a storey above)', not_given, 'overburden_inertia')
      if (input%number('overburden')*input%number('overburden_inertia') > 0.0_wp &
         & .and. input%word('restitution') == 'sorrentino') call problems%note( &
         & 'restitution = ''sorrentino'': does not include the mass of an overburden; with overburden_inertia = '// &
         & to_text(input%number('overburden_inertia'))//' use ''impulse''', not_together, 'restitution')
      thickness = input%number('thickness')
      half = 0.5_wp*thickness
      distance = input%number('bearing_distance')
      eccentricity = input%number('eccentricity')
      if (.not. (input%has('bearing') .or. input%has('bearing_distance'))) then
         if (half > 0.0_wp .and. .not. abs(eccentricity) <= half) call problems%note('eccentricity = '// &
            & to_text(eccentricity)//': must lie between -'//brief(half)//' and '// &
            & brief(half)// &
            & ' (half the thickness)', out_of_range, 'eccentricity')
      else if (input%has('eccentricity')) then
         call problems%note('eccentricity = '//to_text(eccentricity)// &
            & ': give either eccentricity or bearing and bearing_distance', not_together, 'eccentricity')
      else if (.not. input%has('bearing')) then
         call problems%note('bearing_distance = '//to_text(distance)//': only with bearing = ''inner'' or ''outer''', &
            & not_together, 'bearing_distance')
      else if (input%word('bearing') == 'centre') then
         if (input%has('bearing_distance')) call problems%note('bearing_distance = '//to_text(distance)// &
            & ': not with bearing = ''centre'', measure it from a face', not_together, 'bearing_distance')
      else if (.not. input%has('bearing_distance')) then
         call problems%note('bearing_distance: must be given with bearing = '''//input%word('bearing')//'''', &
            & not_given, 'bearing_distance')
      else if (thickness > 0.0_wp .and. .not. (distance >= 0.0_wp .and. distance <= thickness)) then
         call problems%note('bearing_distance = '//to_text(distance)//': must lie between 0 and '// &
            & brief(thickness)//' (the thickness)', out_of_range, 'bearing_distance')
      end if
   end subroutine check_load

end module dondolo_wall_two_block_model
