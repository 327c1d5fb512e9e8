!> Walls of two blocks: 'two_block'. Its name, its properties, and how it becomes a mechanism (dondolo_wall_two_block).
module dondolo_wall_two_block_model
   use dondolo_base_kinds, only : wp
   use dondolo_wall_block, only : block_type, new_block
   use dondolo_base_lines, only : lines_type
   use dondolo_base_property, only : blank, choices_length, is_list, is_text, most_choices, name_length, property_type
   use dondolo_base_settings, only : settings_type
   use dondolo_base_text, only : brief, rounded, to_text
   use dondolo_building_input, only : spans
   use dondolo_wall_body, only : read_strip_body, wall_body_type
   use dondolo_wall_carried, only : describe_actions
   use dondolo_wall_elastic_branch, only : usual_damping
   use dondolo_wall_hinge_depth, only : check_hinge, read_hinge_depth
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_model, only : wall_model_type
   use dondolo_wall_restitution, only : impact_models_type
   use dondolo_wall_strip_statics, only : strip_type
   use dondolo_wall_two_block, only : new_two_block, overburden_type, two_block_impulse, two_block_sorrentino, two_block_type
   ! Last, for gfortran 12 crashes where it comes first
   use dondolo_base_error, only : error_type, not_given, not_increasing, not_together, out_of_range, problems_type, &
      & wrong_length
   implicit none
   private

   public :: two_block_model_type, two_block_name, two_block_hinge_rows, two_block_joint_rows, two_block_load_rows

   !> Name of the mechanism
   character(len=choices_length), parameter :: two_block_name = 'two_block'

   !> Owners of what it alone has
   character(len=choices_length), parameter :: two_block(most_choices) = reshape([two_block_name], [most_choices], pad=blank)

   !> Where an overburden can bear on the top of a wall
   character(len=choices_length), parameter :: bearing_names(*) = &
      & [character(len=choices_length) :: 'inner', 'outer', 'centre']

   !> Properties of its geometry
   type(property_type), parameter :: two_block_hinge_rows(*) = [ &
      & property_type('hinge', optional=.true., smallest=0.01_wp, largest=0.99_wp, owners=two_block, example='0.6', &
      &   meaning='height of the intermediate hinge / height of the wall', &
      &   more='where alpha_0 is least if not given, as the code asks'), &
      & property_type('hinge_range', is_list, optional=.true., smallest=0.01_wp, largest=0.99_wp, owners=two_block, &
      &   example='0.1, 0.9', one_each=.true., &
      &   meaning='lowest and highest such height among which the weakest hinge is looked for, 0.1 and 0.9 if not given')]

   !> Properties of joints that bend before they open
   type(property_type), parameter :: two_block_joint_rows(*) = [ &
      & property_type('elastic_period', unit='s', optional=.true., smallest=1.0e-4_wp, largest=10.0_wp, owners=two_block, &
      &   example='0.12', usual_least=0.01_wp, usual_most=1.0_wp, if_less='is it in s?', &
      &   not_with='restitution_sd, thrust, tie_height', because='of which closed joints know nothing', &
      &   meaning='period of the small vibrations of the strip between its supports, load included, before its joints open', &
      &   more='rigid blocks if not given'), &
      & property_type('elastic_damping', optional=.true., smallest=0.0_wp, largest=0.2_wp, owners=two_block, &
      &   absent=usual_damping, example='0.05', &
      &   meaning='damping ratio of these vibrations, with elastic_period; 0.05 if not given')]

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
      !> What acts between base and top
      type(wall_body_type) :: body
      !> Its statics at any hinge, and the hinges among which the weakest is looked for
      type(strip_type) :: strip
      real(wp) :: hinge_range(2) = [0.1_wp, 0.9_wp]
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

      real(wp) :: alpha, hinge

      ! Beside a bearing the default would be a second place of the load
      if (self%bears .and. .not. self%is_eccentric) call input%clear('eccentricity')
      call check_load(problems, input)
      if (problems%count > 0) return
      if (self%bears) call replace_bearing(input)
      call read_hinges(input, gravity, problems, self%hinge_depth)
      call read_range(input, problems, self%hinge_range)
      if (problems%count > 0) return
      call read_strip_body(input, gravity, self%hinge_depth, problems, self%body)
      if (problems%count > 0) return
      call check_masses(input, problems, self%body)
      self%strip = new_strip(input, gravity, self%body)
      if (input%has('hinge')) return
      call self%strip%find_weakest(self%hinge_range, hinge, alpha)
      call input%set('hinge', hinge)
   end subroutine read

   !> The statics of the strip at any hinge
   function new_strip(input, gravity, body) result(strip)
      !> Properties
      class(settings_type), intent(in) :: input
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> What acts between base and top
      type(wall_body_type), intent(in) :: body
      type(strip_type) :: strip

      real(wp) :: half

      half = 0.5_wp*input%number('thickness')
      strip%height = input%number('height')
      strip%lever = half - body%actions%hinge
      strip%weight = gravity*input%number('density')*input%number('thickness')*strip%height
      strip%load = input%number('overburden')
      strip%eccentricity = input%number('eccentricity')
      associate (carried => body%actions%carried, thrusts => body%actions%thrusts, ties => body%actions%restraints)
         allocate (strip%points(size(carried) + size(thrusts) + size(ties)))
         strip%points%x = half - [carried%depth, thrusts%depth, body%actions%hinge + ties%e]
         strip%points%z = [carried%height, thrusts%height, ties%f]
         strip%points(:size(carried))%weight = carried%weight
         strip%points(:size(carried))%moving = gravity*max(carried%lifted, carried%pushed)
         strip%points(size(carried) + 1:)%push = [thrusts%force, -ties%strength]
      end associate
   end function new_strip

   !> The hinges among which the weakest is looked for
   subroutine read_range(input, problems, range)
      !> Properties
      class(settings_type), intent(in) :: input
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> Lowest and highest; unchanged if not given
      real(wp), intent(inout) :: range(2)

      real(wp), allocatable :: given(:)

      given = input%list('hinge_range')
      if (size(given) == 0) return
      if (size(given) /= 2) then
         call problems%note('hinge_range: has '//to_text(size(given))//' values, must have two, the lowest and the highest '// &
            & 'hinge', wrong_length, 'hinge_range')
      else if (.not. given(1) < given(2)) then
         call problems%note('hinge_range = '//to_text(given(1))//', '//to_text(given(2))//': must increase', not_increasing, &
            & 'hinge_range')
      else
         range = given
      end if
   end subroutine read_range

   !> Check that masses that move have the restitution of a strip with masses
   subroutine check_masses(input, problems, body)
      !> Properties
      class(settings_type), intent(in) :: input
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> What acts between base and top
      type(wall_body_type), intent(in) :: body

      if (input%word('restitution') == 'sorrentino' .and. moves_masses(body)) call problems%note('restitution = '// &
         & '''sorrentino'': does not include masses that the strip lifts or pushes; use ''impulse''', not_together, 'restitution')
   end subroutine check_masses

   !> Does the strip move masses between its base and its top?
   pure logical function moves_masses(body)
      type(wall_body_type), intent(in) :: body

      moves_masses = any(body%actions%carried%lifted + body%actions%carried%pushed > 0.0_wp)
   end function moves_masses

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
      logical :: above(size(self%strip%points))

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
      if (size(above) > 0) then
         above = self%strip%is_above(hinge, self%strip%rides_below(hinge))
         call new_two_block(made, lower, upper, overburden, gravity, error, self%body%actions, above)
      else
         call new_two_block(made, lower, upper, overburden, gravity, error)
      end if
      if (.not. allocated(error)) then
         if (.not. (overburden%lifted > 0.0_wp .or. moves_masses(self%body))) impacts%sorrentino = &
            & two_block_sorrentino(lower, upper)
         impacts%impulse = two_block_impulse(lower, upper, overburden, made%points)
      end if
      call move_alloc(made, mechanism)
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

      mass = input%number('density')*input%number('height')*input%number('thickness')
      load = input%number('overburden')
      inertia = input%number('overburden_inertia')
      call lines%add('masonry: '//rounded(mass)//' kg/m, '//rounded(input%number('hinge')*mass)//' below the hinge at '// &
         & rounded(input%number('hinge')*input%number('height'))//' m, '//rounded((1.0_wp - input%number('hinge'))*mass)// &
         & ' above; centroids half as deep as the blocks are thick')
      if (load > 0.0_wp) call lines%add('load: '//rounded(load)//' N/m, lifted '//rounded(inertia*load/gravity)// &
         & ' kg/m, dead '//rounded((1.0_wp - inertia)*load)//' N/m')
      call describe_actions(self%body%actions, lines)
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
         & + input%number('overburden') + sum(input%list('load')), problems, depth, name)
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
