!> A wall: what the user says of it, and the mechanism that follows. Here names become types.
module dondolo_wall
   use dondolo_base_error, only : error_type, problems_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : check_number, name_length
   use dondolo_base_settings_check, only : check_settings
   use dondolo_base_text, only : brief, rounded, to_text
   use dondolo_building, only : building_type
   use dondolo_building_input, only : leans, new_building, spans, touches_base
   use dondolo_wall_block, only : block_type, new_block
   use dondolo_wall_body, only : is_bare, read_wall_body, take_sections, wall_body_type
   use dondolo_wall_free_standing, only : free_standing_type, new_free_standing
   use dondolo_wall_hinge_depth, only : check_hinge, read_hinge_depth
   use dondolo_wall_hinge_level, only : cut_wall, find_hinge_levels, has_hinge_level
   use dondolo_wall_loaded_block, only : loaded_block_type, new_loaded_block
   use dondolo_wall_loaded_impact, only : one_sided_impulse, two_sided_impulse
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_one_sided, only : new_one_sided, one_sided_restitution, one_sided_type
   use dondolo_wall_properties, only : gravity_property, is_of_building, mechanism_names, &
      & standard_gravity, wall_input_type
   use dondolo_wall_restitution, only : restitution_type
   use dondolo_wall_two_block, only : new_two_block, overburden_type, two_block_type
   implicit none
   private

   public :: wall_input_type, wall_type, new_wall
   public :: mechanism_names, standard_gravity

   !> A wall: what was said of it with every default filled in, and its mechanism
   type :: wall_type
      !> Every property that applies to the mechanism has a value; a bearing has become an eccentricity
      type(wall_input_type) :: input
      !> Gravity [m/s2]
      real(wp) :: gravity = standard_gravity
      !> Half diagonal of the wall, of the lower block for two_block [m]
      real(wp) :: radius = 0.0_wp
      !> Slenderness angle of the wall, of the lower block for two_block [rad]
      real(wp) :: alpha = 0.0_wp
      !> Depth of the hinge at the base behind the face [m]
      real(wp) :: hinge_depth = 0.0_wp
      !> Was a bearing given?
      logical :: bears = .false.
      !> What it stands on; not allocated: the ground
      type(building_type), allocatable :: building
      !> What the motion integrates
      class(mechanism_type), allocatable :: mechanism
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
      !> What is said of it
      type(wall_input_type), intent(in) :: input
      !> Everything that is wrong with it, one thing a line: `variable = value: what is allowed`
      type(error_type), allocatable, intent(out) :: error
      !> Gravity [m/s2]
      real(wp), intent(in), optional :: gravity

      type(problems_type) :: problems
      type(wall_body_type) :: body
      type(wall_input_type) :: above
      real(wp), allocatable :: levels(:)
      real(wp) :: share, tilt

      if (present(gravity)) wall%gravity = gravity
      call understand(wall, input, problems, body)
      if (problems%count == 0 .and. has_hinge_level(input)) then
         call find_hinge_levels(wall%input, problems, levels)
         if (problems%count == 0 .and. size(levels) > 1) call problems%note('hinge_level: has '//to_text(size(levels))// &
            & ' values, a wall has one; a facade with several is a population, task = ''typology''')
         above = input
         if (problems%count == 0) call cut_wall(above, levels(1), problems)
         if (problems%count == 0) call understand(wall, above, problems, body)
      end if
      call problems%raise(error)
      if (allocated(error)) return
      if (wall%mechanism_name() == 'two_block') then
         call build_two_block(wall, error)
      else if (is_bare(wall%input)) then
         call build_mechanism(wall, error)
      else
         call build_loaded(wall, body, error)
      end if
      if (allocated(error) .or. .not. allocated(wall%building)) return
      call wall%mechanism%support(share, tilt)
      call wall%building%lean(share, tilt)
   end subroutine new_wall

   !> What a wall touches of the building that it stands on
   pure integer function contact_of(mechanism) result(contact)
      !> Name of its mechanism
      character(len=*), intent(in) :: mechanism

      select case (mechanism)
      case ('one_sided')
         contact = leans
      case ('two_block')
         contact = spans
      case default
         contact = touches_base
      end select
   end function contact_of

   !> Fill in defaults and check all that is said of a wall, but whether it stands
   subroutine understand(wall, input, problems, body)
      !> The wall: all but its mechanism is set
      type(wall_type), intent(inout) :: wall
      !> What is said of it
      type(wall_input_type), intent(in) :: input
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> Sections and actions, of one block that is more than a rectangle
      type(wall_body_type), intent(out) :: body

      character(len=:), allocatable :: mechanism, allowed

      wall%input = input
      wall%hinge_depth = 0.0_wp
      if (allocated(wall%building)) deallocate (wall%building)
      mechanism = input%word('mechanism')
      if (.not. any(mechanism == mechanism_names)) mechanism = ''
      if (mechanism /= 'two_block') call take_sections(problems, wall%input)
      wall%bears = input%has('bearing') .or. input%has('bearing_distance')
      call wall%input%fill(mechanism)
      call wall%input%set('name', trim(wall%input%word('name')))
      if (wall%bears .and. .not. input%has('eccentricity')) call wall%input%clear('eccentricity')
      call check_settings(wall%input, problems, 'mechanism', mechanism)
      if (problems%count == 0 .and. wall%input%gives(is_of_building)) then
         allocate (wall%building)
         call new_building(wall%building, wall%input, problems, contact_of(mechanism), wall%input%number('height'))
      end if
      call check_number(gravity_property, wall%gravity, allowed)
      if (allocated(allowed)) call problems%note('gravity = '//to_text(wall%gravity)//': '//allowed)
      if (mechanism == 'two_block') call check_load(problems, wall%input)
      if (problems%count > 0) return
      if (wall%bears) call replace_bearing(wall%input)
      if (mechanism == 'two_block') then
         call read_hinges(wall%input, wall%gravity, problems, wall%hinge_depth)
      else if (.not. is_bare(wall%input)) then
         call read_wall_body(wall%input, wall%gravity, problems, body)
         wall%hinge_depth = body%actions%hinge
      end if
   end subroutine understand

   !> The depth of the hinges of a wall of two blocks: those at base and top and the intermediate one
   subroutine read_hinges(input, gravity, problems, depth)
      !> What is said of the wall, its eccentricity known
      type(wall_input_type), intent(in) :: input
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
      call check_hinge(input, problems, name, depth, half, 'half the thickness, '//rounded(half)//' m')
      load = half - input%number('eccentricity')
      if (input%number('overburden') > 0.0_wp .and. depth > 0.0_wp) call check_hinge(input, problems, name, depth, load, &
         & 'the overburden, '//rounded(load)//' m behind the face of the active top hinge')
   end subroutine read_hinges

   !> What the user asks of the impacts
   pure function restitution_of(input) result(restitution)
      !> What is said of the wall
      type(wall_input_type), intent(in) :: input
      !> The same as one thing
      type(restitution_type) :: restitution

      restitution%model = input%word('restitution')
      if (input%has('restitution_value')) restitution%value = input%number('restitution_value')
      restitution%factor = input%number('restitution_factor')
   end function restitution_of

   !> The mechanism of a block that is more than a rectangle on its edge
   subroutine build_loaded(wall, body, error)
      !> The wall, its input checked
      type(wall_type), intent(inout) :: wall
      !> Its sections and what acts on it
      type(wall_body_type), intent(in) :: body
      !> It does not stand at rest, or what is wrong with its restitution
      type(error_type), allocatable, intent(out) :: error

      type(loaded_block_type) :: block
      type(restitution_type) :: restitution
      real(wp) :: depth, height

      restitution = restitution_of(wall%input)
      depth = body%body%depth - body%actions%hinge
      height = body%body%height - body%actions%edge
      wall%radius = hypot(depth, height)
      wall%alpha = atan2(depth, height)
      if (wall%input%word('mechanism') == 'free_standing') then
         call new_loaded_block(block, body%body, body%actions, wall%gravity, .true., error)
         if (.not. allocated(error)) call restitution%speed_ratio(block%restitution, error, impulse=two_sided_impulse(body))
      else
         call new_loaded_block(block, body%body, body%actions, wall%gravity, .false., error)
         if (.not. allocated(error)) call restitution%speed_ratio(block%restitution, error, &
            & sorrentino=-one_sided_restitution(atan2(body%body%depth, body%body%height)), impulse=-one_sided_impulse(body))
      end if
      wall%mechanism = block
   end subroutine build_loaded

   !> The mechanism of a rectangular block that turns about its edge
   subroutine build_mechanism(wall, error)
      !> The wall, its input checked
      type(wall_type), intent(inout) :: wall
      !> What is wrong with its restitution
      type(error_type), allocatable, intent(out) :: error

      type(restitution_type) :: restitution
      type(one_sided_type) :: one_sided
      type(free_standing_type) :: free_standing
      type(block_type) :: whole
      real(wp) :: height, thickness, density

      associate (input => wall%input)
         height = input%number('height')
         thickness = input%number('thickness')
         density = input%number('density')
         restitution = restitution_of(input)
         whole = new_block(height, thickness, density)
         wall%radius = whole%radius
         wall%alpha = whole%alpha
         select case (input%word('mechanism'))
         case ('one_sided')
            call new_one_sided(one_sided, whole, restitution, wall%gravity, error)
            wall%mechanism = one_sided
         case ('free_standing')
            call new_free_standing(free_standing, whole, restitution, wall%gravity, error)
            wall%mechanism = free_standing
         end select
      end associate
   end subroutine build_mechanism

   !> The mechanism of two blocks
   subroutine build_two_block(wall, error)
      !> The wall, its input checked, its hinges known
      type(wall_type), intent(inout) :: wall
      !> It does not stand at rest, or what is wrong with its restitution
      type(error_type), allocatable, intent(out) :: error

      type(two_block_type) :: two_block
      type(block_type) :: lower, upper
      type(overburden_type) :: overburden
      real(wp) :: height, thickness, density, hinge, weight, inertia

      associate (input => wall%input)
         height = input%number('height')
         thickness = input%number('thickness')
         density = input%number('density')
         weight = input%number('overburden')
         inertia = input%number('overburden_inertia')
         hinge = input%number('hinge')
         lower = new_block(hinge*height, thickness, density, wall%hinge_depth)
         upper = new_block((1.0_wp - hinge)*height, thickness, density, wall%hinge_depth)
         wall%radius = lower%radius
         wall%alpha = lower%alpha
         overburden = overburden_type(weight, input%number('eccentricity'), (1.0_wp - inertia)*weight, &
            & inertia*weight/wall%gravity)
         call new_two_block(two_block, lower, upper, overburden, restitution_of(input), wall%gravity, error)
         wall%mechanism = two_block
      end associate
   end subroutine build_two_block

   !> Turn the bearing into the eccentricity of a wall that folds outwards: its top rotates about the outer face
   subroutine replace_bearing(input)
      !> What is said of the wall, checked
      type(wall_input_type), intent(inout) :: input

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
      !> What is said of the wall, defaults filled in
      type(wall_input_type), intent(in) :: input

      real(wp) :: thickness, half, distance, eccentricity

      if (input%number('overburden') > 0.0_wp .and. .not. input%has('overburden_inertia')) call problems%note( &
         & 'overburden_inertia: must be given with overburden: 0 (a dead force, as of springs or tendons) to 1 (a mass '// &
         & 'that the wall lifts, as of a storey above)')
      if (input%number('overburden')*input%number('overburden_inertia') > 0.0_wp &
         & .and. input%word('restitution') == 'sorrentino') call problems%note( &
         & 'restitution = ''sorrentino'': knows no mass of an overburden; with overburden_inertia = '// &
         & to_text(input%number('overburden_inertia'))//' use ''impulse''')
      thickness = input%number('thickness')
      half = 0.5_wp*thickness
      distance = input%number('bearing_distance')
      eccentricity = input%number('eccentricity')
      if (.not. (input%has('bearing') .or. input%has('bearing_distance'))) then
         if (half > 0.0_wp .and. .not. abs(eccentricity) <= half) call problems%note('eccentricity = '// &
            & to_text(eccentricity)//': must lie between -'//brief(half)//' and '// &
            & brief(half)// &
            & ' (half the thickness)')
      else if (input%has('eccentricity')) then
         call problems%note('eccentricity = '//to_text(eccentricity)// &
            & ': give either eccentricity or bearing and bearing_distance')
      else if (.not. input%has('bearing')) then
         call problems%note('bearing_distance = '//to_text(distance)//': only with bearing = ''inner'' or ''outer''')
      else if (input%word('bearing') == 'centre') then
         if (input%has('bearing_distance')) call problems%note('bearing_distance = '//to_text(distance)// &
            & ': not with bearing = ''centre'', measure it from a face')
      else if (.not. input%has('bearing_distance')) then
         call problems%note('bearing_distance: must be given with bearing = '''//input%word('bearing')//'''')
      else if (thickness > 0.0_wp .and. .not. (distance >= 0.0_wp .and. distance <= thickness)) then
         call problems%note('bearing_distance = '//to_text(distance)//': must lie between 0 and '// &
            & brief(thickness)//' (the thickness)')
      end if
   end subroutine check_load

end module dondolo_wall
