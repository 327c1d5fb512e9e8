!> A wall: what the user says of it, and the mechanism that follows. Here names become types.
module dondolo_wall
   use dondolo_block, only : block_type, new_block
   use dondolo_error, only : error_type, raise_input
   use dondolo_free_standing, only : free_standing_type, new_free_standing
   use dondolo_kinds, only : wp
   use dondolo_mechanism, only : mechanism_type
   use dondolo_one_sided, only : one_sided_type, new_one_sided
   use dondolo_restitution, only : restitution_type
   use dondolo_text, only : join, to_text
   use dondolo_two_block, only : two_block_type, new_two_block
   implicit none
   private

   public :: wall_input_type, wall_type, new_wall
   public :: mechanism_names, standard_gravity

   !> Names of the mechanisms
   character(len=13), parameter :: mechanism_names(3) = &
      & [character(len=13) :: 'one_sided', 'free_standing', 'two_block']

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
      !> two_block: its distance from the centreline towards the active top hinge [m], 0 if not given
      real(wp), allocatable :: eccentricity
   end type wall_input_type

   !> A wall: what was said of it with every default filled in, and its mechanism
   type :: wall_type
      !> Every component that applies to the mechanism is allocated
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
      !> What is wrong with it: `variable = value: what is allowed`
      type(error_type), allocatable, intent(out) :: error
      !> Gravity [m/s2]
      real(wp), intent(in), optional :: gravity

      if (present(gravity)) wall%gravity = gravity
      wall%input = input
      call fill_defaults(wall%input)
      call check_input(wall%input, error)
      if (allocated(error)) return
      call check_positive(error, 'gravity', wall%gravity, 1.0e3_wp)
      if (allocated(error)) return
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
         call set_default(input%eccentricity, 0.0_wp)
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

   !> Check names and ranges
   subroutine check_input(input, error)
      !> What is said of the wall, defaults filled in
      type(wall_input_type), intent(in) :: input
      !> The first thing that is wrong
      type(error_type), allocatable, intent(out) :: error

      if (.not. allocated(input%mechanism)) then
         call raise_input(error, 'mechanism: must be given, one of '//join(mechanism_names))
         return
      end if
      if (.not. any(input%mechanism == mechanism_names)) then
         call raise_input(error, 'mechanism = '''//input%mechanism//''': must be one of '//join(mechanism_names))
         return
      end if
      call check_required(error, 'height', input%height)
      if (.not. allocated(error)) call check_required(error, 'thickness', input%thickness)
      if (.not. allocated(error)) call check_positive(error, 'height', input%height, 1.0e3_wp)
      if (.not. allocated(error)) call check_positive(error, 'thickness', input%thickness, 1.0e3_wp)
      if (.not. allocated(error)) call check_positive(error, 'density', input%density, 1.0e5_wp)
      if (allocated(error)) return
      if (input%mechanism == 'two_block') then
         call check_two_block(input, error)
      else
         call check_absent(error, 'hinge', input%hinge)
         if (.not. allocated(error)) call check_absent(error, 'overburden', input%overburden)
         if (.not. allocated(error)) call check_absent(error, 'eccentricity', input%eccentricity)
      end if
   end subroutine check_input

   !> Check what only a two-block wall has
   subroutine check_two_block(input, error)
      !> What is said of the wall, defaults filled in
      type(wall_input_type), intent(in) :: input
      !> The first thing that is wrong
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: half

      if (.not. (input%hinge >= 0.01_wp .and. input%hinge <= 0.99_wp)) then
         call raise_input(error, 'hinge = '//to_text(input%hinge)//': must lie between 0.01 and 0.99')
         return
      end if
      if (.not. (input%overburden >= 0.0_wp .and. input%overburden <= 1.0e9_wp)) then
         call raise_input(error, 'overburden = '//to_text(input%overburden)// &
            & ': must lie between 0 and 1e9 N per metre of wall')
         return
      end if
      half = 0.5_wp*input%thickness
      if (.not. abs(input%eccentricity) <= half) &
         & call raise_input(error, 'eccentricity = '//to_text(input%eccentricity)// &
         & ': must lie between -'//to_text(half)//' and '//to_text(half)//' (half the thickness)')
   end subroutine check_two_block

   !> A number that must be given
   subroutine check_required(error, name, value)
      !> Raised when it was not
      type(error_type), allocatable, intent(out) :: error
      !> Name of the variable
      character(len=*), intent(in) :: name
      !> Its value
      real(wp), allocatable, intent(in) :: value

      if (.not. allocated(value)) call raise_input(error, name//': must be given')
   end subroutine check_required

   !> A number that belongs to two-block walls only
   subroutine check_absent(error, name, value)
      !> Raised when it was given
      type(error_type), allocatable, intent(out) :: error
      !> Name of the variable
      character(len=*), intent(in) :: name
      !> Its value
      real(wp), allocatable, intent(in) :: value

      if (allocated(value)) call raise_input(error, name//' = '//to_text(value)// &
         & ': only for mechanism = ''two_block''')
   end subroutine check_absent

   !> A number that must be positive and not beyond reason
   subroutine check_positive(error, name, value, largest)
      !> Raised when it is not
      type(error_type), allocatable, intent(out) :: error
      !> Name of the variable
      character(len=*), intent(in) :: name
      !> Its value
      real(wp), intent(in) :: value
      !> The largest value that makes sense
      real(wp), intent(in) :: largest

      real(wp), parameter :: smallest = 1.0e-3_wp

      if (.not. value > 0.0_wp) then
         call raise_input(error, name//' = '//to_text(value)//': must be positive')
      else if (.not. (value >= smallest .and. value <= largest)) then
         call raise_input(error, name//' = '//to_text(value)//': must lie between '//to_text(smallest)//' and '// &
            & to_text(largest))
      end if
   end subroutine check_positive

end module dondolo_wall
