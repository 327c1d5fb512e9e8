!> A wall: what the user says of it, and the mechanism that follows. Here names become types.
module dondolo_wall
   use dondolo_block, only : block_type, new_block
   use dondolo_error, only : error_type, problems_type
   use dondolo_free_standing, only : free_standing_type, new_free_standing
   use dondolo_kinds, only : wp
   use dondolo_mechanism, only : mechanism_type
   use dondolo_one_sided, only : one_sided_type, new_one_sided
   use dondolo_restitution, only : restitution_type
   use dondolo_text, only : join, must_be_plain, plain, to_text
   use dondolo_two_block, only : two_block_type, new_two_block
   implicit none
   private

   public :: wall_input_type, wall_type, new_wall
   public :: mechanism_names, standard_gravity

   !> Names of the mechanisms
   character(len=13), parameter :: mechanism_names(3) = &
      & [character(len=13) :: 'one_sided', 'free_standing', 'two_block']

   !> Where an overburden can bear on the top of a wall
   character(len=6), parameter :: bearing_names(3) = [character(len=6) :: 'inner', 'outer', 'centre']

   !> Gravity unless the user sets it [m/s2]
   real(wp), parameter :: standard_gravity = 9.81_wp

   !> What a user says of a wall. Components that are not allocated were not given
   type :: wall_input_type
      !> Name of the wall
      character(len=:), allocatable :: name
      !> Mechanism, one of mechanism_names; required
      character(len=:), allocatable :: mechanism
      !> Height [m]; required
      real(wp), allocatable :: height
      !> Thickness [m]; required
      real(wp), allocatable :: thickness
      !> Density [kg/m3], 1800 if not given
      real(wp), allocatable :: density
      !> two_block: height of the intermediate hinge / height, 0.5 if not given
      real(wp), allocatable :: hinge
      !> Model of restitution, 'default' if not given
      character(len=:), allocatable :: restitution
      !> Speed ratio of the model 'constant'
      real(wp), allocatable :: restitution_value
      !> Factor on the speed ratio, 1 if not given
      real(wp), allocatable :: restitution_factor
      !> two_block: vertical load on the top [N/m], 0 if not given
      real(wp), allocatable :: overburden
      !> two_block: its distance from the centreline towards the active top hinge [m], 0 if not given; the hinge of a
      !> wall that folds outwards is at the outer face
      real(wp), allocatable :: eccentricity
      !> two_block, instead of the eccentricity: where the load bears, one of bearing_names
      character(len=:), allocatable :: bearing
      !> two_block: distance of the load's resultant from the inner or the outer face [m]
      real(wp), allocatable :: bearing_distance
   end type wall_input_type

   !> A wall: what was said of it with every default filled in, and its mechanism
   type :: wall_type
      !> Every component that applies to the mechanism is allocated; a bearing has become an eccentricity
      type(wall_input_type) :: input
      !> Gravity [m/s2]
      real(wp) :: gravity = standard_gravity
      !> Half diagonal of the wall, of the lower block for two_block [m]
      real(wp) :: radius = 0.0_wp
      !> Slenderness angle of the wall, of the lower block for two_block [rad]
      real(wp) :: alpha = 0.0_wp
      !> What the motion integrates
      class(mechanism_type), allocatable :: mechanism
   end type wall_type

contains

   !> Make a wall and check all that is said of it
   subroutine new_wall(wall, input, error, gravity)
      !> The wall
      type(wall_type), intent(out) :: wall
      !> What is said of it
      type(wall_input_type), intent(in) :: input
      !> Everything that is wrong with it, one thing a line: `variable = value: what is allowed`
      type(error_type), allocatable, intent(out) :: error
      !> Gravity [m/s2]
      real(wp), intent(in), optional :: gravity

      if (present(gravity)) wall%gravity = gravity
      wall%input = input
      call fill_defaults(wall%input)
      call check_input(wall%input, wall%gravity, error)
      if (allocated(error)) return
      if (allocated(wall%input%bearing)) call replace_bearing(wall%input)
      call build_mechanism(wall, error)
   end subroutine new_wall

   !> Names become types: the one place that knows all mechanisms
   subroutine build_mechanism(wall, error)
      !> The wall, its input checked
      type(wall_type), intent(inout) :: wall
      !> What is wrong with its restitution
      type(error_type), allocatable, intent(out) :: error

      type(restitution_type) :: restitution
      type(one_sided_type) :: one_sided
      type(free_standing_type) :: free_standing
      type(two_block_type) :: two_block
      type(block_type) :: whole, lower, upper

      associate (input => wall%input)
         restitution%model = input%restitution
         if (allocated(input%restitution_value)) restitution%value = input%restitution_value
         restitution%factor = input%restitution_factor
         whole = new_block(input%height, input%thickness, input%density)
         wall%radius = whole%radius
         wall%alpha = whole%alpha
         select case (input%mechanism)
         case ('one_sided')
            call new_one_sided(one_sided, whole, restitution, wall%gravity, error)
            wall%mechanism = one_sided
         case ('free_standing')
            call new_free_standing(free_standing, whole, restitution, wall%gravity, error)
            wall%mechanism = free_standing
         case ('two_block')
            lower = new_block(input%hinge*input%height, input%thickness, input%density)
            upper = new_block((1.0_wp - input%hinge)*input%height, input%thickness, input%density)
            wall%radius = lower%radius
            wall%alpha = lower%alpha
            call new_two_block(two_block, lower, upper, input%overburden, input%eccentricity, restitution, &
               & wall%gravity, error)
            wall%mechanism = two_block
         end select
      end associate
   end subroutine build_mechanism

   !> Give every variable that was left out, and applies, its default
   subroutine fill_defaults(input)
      !> What is said of the wall
      type(wall_input_type), intent(inout) :: input

      if (.not. allocated(input%name)) input%name = 'wall'
      if (.not. allocated(input%restitution)) input%restitution = 'default'
      call set_default(input%density, 1800.0_wp)
      call set_default(input%restitution_factor, 1.0_wp)
      if (.not. allocated(input%mechanism)) return
      if (input%mechanism == 'two_block') then
         call set_default(input%hinge, 0.5_wp)
         call set_default(input%overburden, 0.0_wp)
         if (.not. (allocated(input%bearing) .or. allocated(input%bearing_distance))) &
            & call set_default(input%eccentricity, 0.0_wp)
      end if
   end subroutine fill_defaults

   !> A default for a number that was not given
   pure subroutine set_default(variable, default)
      !> The number
      real(wp), allocatable, intent(inout) :: variable
      !> Its default
      real(wp), intent(in) :: default

      if (.not. allocated(variable)) variable = default
   end subroutine set_default

   !> Turn the bearing into the eccentricity of a wall that folds outwards: its top rotates about the outer face
   subroutine replace_bearing(input)
      !> What is said of the wall, checked
      type(wall_input_type), intent(inout) :: input

      real(wp) :: half

      half = 0.5_wp*input%thickness
      select case (input%bearing)
      case ('inner')
         input%eccentricity = input%bearing_distance - half
      case ('outer')
         input%eccentricity = half - input%bearing_distance
      case ('centre')
         input%eccentricity = 0.0_wp
      end select
      deallocate (input%bearing)
      if (allocated(input%bearing_distance)) deallocate (input%bearing_distance)
   end subroutine replace_bearing

   !> Check names and ranges
   subroutine check_input(input, gravity, error)
      !> What is said of the wall, defaults filled in
      type(wall_input_type), intent(in) :: input
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> Everything that is wrong
      type(error_type), allocatable, intent(out) :: error

      type(problems_type) :: problems

      if (plain(input%name) /= input%name) call problems%note('name = '''//input%name//''': '//must_be_plain)
      call check_positive(problems, 'height', input%height, 1.0e3_wp)
      call check_positive(problems, 'thickness', input%thickness, 1.0e3_wp)
      call check_positive(problems, 'density', input%density, 1.0e5_wp)
      call check_positive(problems, 'gravity', gravity, 1.0e3_wp)
      if (.not. allocated(input%mechanism)) then
         call problems%note('mechanism: must be given, one of '//join(mechanism_names))
      else if (.not. any(input%mechanism == mechanism_names)) then
         call problems%note('mechanism = '''//input%mechanism//''': must be one of '//join(mechanism_names))
      else if (input%mechanism == 'two_block') then
         call check_two_block(problems, input)
      else
         call check_absent(problems, 'hinge', input%hinge)
         call check_absent(problems, 'overburden', input%overburden)
         call check_absent(problems, 'eccentricity', input%eccentricity)
         if (allocated(input%bearing)) &
            & call problems%note('bearing = '''//input%bearing//''': only for mechanism = ''two_block''')
         call check_absent(problems, 'bearing_distance', input%bearing_distance)
      end if
      call problems%raise(error)
   end subroutine check_input

   !> Check what only a two-block wall has
   subroutine check_two_block(problems, input)
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> What is said of the wall, defaults filled in
      type(wall_input_type), intent(in) :: input

      real(wp) :: half

      if (.not. (input%hinge >= 0.01_wp .and. input%hinge <= 0.99_wp)) &
         & call problems%note('hinge = '//to_text(input%hinge)//': must lie between 0.01 and 0.99')
      if (.not. (input%overburden >= 0.0_wp .and. input%overburden <= 1.0e9_wp)) &
         & call problems%note('overburden = '//to_text(input%overburden)// &
         & ': must lie between 0 and 1e9 N per metre of wall')
      if (allocated(input%bearing) .or. allocated(input%bearing_distance)) then
         call check_bearing(problems, input)
         return
      end if
      if (.not. allocated(input%thickness)) return
      half = 0.5_wp*input%thickness
      if (half > 0.0_wp .and. .not. abs(input%eccentricity) <= half) &
         & call problems%note('eccentricity = '//to_text(input%eccentricity)//': must lie between -'// &
         & to_text(half)//' and '//to_text(half)//' (half the thickness)')
   end subroutine check_two_block

   !> Check where a load bears
   subroutine check_bearing(problems, input)
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> What is said of the wall: its bearing, or a distance without one
      type(wall_input_type), intent(in) :: input

      if (allocated(input%eccentricity)) then
         call problems%note('eccentricity = '//to_text(input%eccentricity)// &
            & ': give either eccentricity or bearing and bearing_distance')
      else if (.not. allocated(input%bearing)) then
         call problems%note('bearing_distance = '//to_text(input%bearing_distance)// &
            & ': only with bearing = ''inner'' or ''outer''')
      else if (.not. any(input%bearing == bearing_names)) then
         call problems%note('bearing = '''//input%bearing//''': must be one of '//join(bearing_names))
      else if (input%bearing == 'centre') then
         if (allocated(input%bearing_distance)) call problems%note('bearing_distance = '// &
            & to_text(input%bearing_distance)//': not with bearing = ''centre'', measure it from a face')
      else if (.not. allocated(input%bearing_distance)) then
         call problems%note('bearing_distance: must be given with bearing = '''//input%bearing//'''')
      else if (allocated(input%thickness)) then
         if (input%thickness > 0.0_wp .and. .not. &
            & (input%bearing_distance >= 0.0_wp .and. input%bearing_distance <= input%thickness)) &
            & call problems%note('bearing_distance = '//to_text(input%bearing_distance)//': must lie between 0 and '// &
            & to_text(input%thickness)//' (the thickness)')
      end if
   end subroutine check_bearing

   !> A number that belongs to two-block walls only
   subroutine check_absent(problems, name, value)
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> Name of the variable
      character(len=*), intent(in) :: name
      !> Its value, absent where it was not given
      real(wp), intent(in), optional :: value

      if (present(value)) &
         & call problems%note(name//' = '//to_text(value)//': only for mechanism = ''two_block''')
   end subroutine check_absent

   !> A number that must be given, positive and not beyond reason
   subroutine check_positive(problems, name, value, largest)
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> Name of the variable
      character(len=*), intent(in) :: name
      !> Its value, absent where it was not given
      real(wp), intent(in), optional :: value
      !> The largest value that makes sense
      real(wp), intent(in) :: largest

      real(wp), parameter :: smallest = 1.0e-3_wp

      if (.not. present(value)) then
         call problems%note(name//': must be given')
      else if (.not. value > 0.0_wp) then
         call problems%note(name//' = '//to_text(value)//': must be positive')
      else if (.not. (value >= smallest .and. value <= largest)) then
         call problems%note(name//' = '//to_text(value)//': must lie between '//to_text(smallest)//' and '// &
            & to_text(largest))
      end if
   end subroutine check_positive

end module dondolo_wall
