!> Walls that are chains of rigid bodies: 'chain'. Its name, its properties, and how it becomes a mechanism: its joints decide how
!> it moves, and its terms are sampled into a table (dondolo_wall_tabulated).
module dondolo_wall_chain_model
   use dondolo_base_error, only : error_type, not_given, out_of_range, problems_type, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_property, only : blank, choices_length, is_integer, is_list, is_text, most_choices, property_type
   use dondolo_base_settings, only : settings_type
   use dondolo_base_text, only : rounded, to_text
   use dondolo_building_input, only : spans
   use dondolo_wall_chain, only : chain_type
   use dondolo_wall_chain_input, only : read_chain, stands_between
   use dondolo_wall_chain_overlap, only : outline_type
   use dondolo_wall_chain_state, only : check_chain
   use dondolo_wall_chain_table, only : chain_table_type, sample_chain
   use dondolo_wall_chain_terms, only : chain_support, find_end
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_restitution, only : impact_models_type
   use dondolo_wall_tabulated, only : new_tabulated, tabulated_type
   use dondolo_wall_tabulated_model, only : chain_name, tabulated_model_type
   implicit none
   private

   public :: chain_model_type, chain_rows

   !> Owners of what it alone has
   character(len=choices_length), parameter :: chain(most_choices) = reshape([chain_name], [most_choices], pad=blank)

   !> Its properties
   type(property_type), parameter :: chain_rows(*) = [ &
      & property_type('bodies', is_text, owners=chain, optional=.true., replaced=.true., example='data/walls/portal_bodies.csv', &
      &   meaning='CSV file of the rigid bodies', &
      &   more='columns body, width [m], density [kg/m3], depth [m], height [m]'), &
      & property_type('joints', is_text, owners=chain, optional=.true., replaced=.true., example='data/walls/portal_joints.csv', &
      &   meaning='CSV file of the hinges and guides between them', &
      &   more='columns type, body, other, depth [m], height [m], angle [deg]'), &
      & property_type('actions', is_text, owners=chain, optional=.true., replaced=.true., &
      &   example='data/walls/portal_actions.csv', &
      &   meaning='CSV file of loads, pushed masses and thrusts at points of the bodies', &
      &   more='columns body, depth [m], height [m], load [N], inertia'), &
      & property_type('driver', is_integer, owners=chain, optional=.true., smallest=1.0_wp, largest=8.0_wp, absent=1.0_wp, &
      &   example='1', meaning='number of the body whose turn is the rotation q', more='1 if not given'), &
      & property_type('gravity_share', owners=chain, optional=.true., smallest=0.0_wp, largest=1.0_wp, absent=1.0_wp, &
      &   example='1.0', meaning='part of gravity that acts in the plane of the motion', &
      &   more='1 if not given; 0 for horizontal bending, whose plane is the plan'), &
      & property_type('body_table', is_list, owners=chain, optional=.true., smallest=-1.0e9_wp, largest=1.0e9_wp, &
      &   example='1.0, 1.0, 0.0', meaning='rows of the bodies as numbers, 11 a row, instead of their file'), &
      & property_type('joint_table', is_list, owners=chain, optional=.true., smallest=-1.0e9_wp, largest=1.0e9_wp, &
      &   example='2.0, 1.0, 0.0', meaning='rows of the joints as numbers, 8 a row, instead of their file'), &
      & property_type('action_table', is_list, owners=chain, optional=.true., smallest=-1.0e9_wp, largest=1.0e9_wp, &
      &   example='1.0, 0.2, 3.5', meaning='rows of the actions as numbers, 10 a row, instead of their file')]

   !> A wall that is a chain
   type, extends(tabulated_model_type) :: chain_model_type
      type(chain_type) :: chain
      !> Outlines of its parts
      type(outline_type), allocatable :: outlines(:)
   contains
      procedure :: prepare
      procedure :: read
      procedure :: make_mechanism
      procedure :: describe
   end type chain_model_type

   !> Last rotation of its table / capacity, and / geometric end
   real(wp), parameter :: beyond = 1.1_wp, before_end = 0.999_wp

contains

   !> Note whether a building holds its top
   subroutine prepare(self, input, problems)
      class(chain_model_type), intent(inout) :: self
      !> Properties as given
      class(settings_type), intent(inout) :: input
      !> Takes nothing
      type(problems_type), intent(inout) :: problems

      associate (those => problems)
      end associate
      if (stands_between(input%list('joint_table'))) self%contact = spans
   end subroutine prepare

   !> Read the rows, and check that they make a mechanism of one degree of freedom
   subroutine read(self, input, gravity, problems)
      class(chain_model_type), intent(inout) :: self
      !> Properties, defaults filled in
      class(settings_type), intent(inout) :: input
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> In: values beyond their ranges; takes what is wrong
      type(problems_type), intent(inout) :: problems

      if (.not. input%has('sides')) call problems%note('sides: must be given with mechanism = ''chain'': 1 (one side only) '// &
         & 'or 2 (both, as mirror images)', not_given, 'sides')
      if (.not. input%has('body_table')) call problems%note('bodies: must be given with mechanism = ''chain''', not_given, &
         & 'bodies')
      if (.not. input%has('joint_table')) call problems%note('joints: must be given with mechanism = ''chain''', not_given, &
         & 'joints')
      if (problems%count > 0) return
      self%chain%gravity = gravity
      self%chain%driver = 1
      if (input%has('driver')) self%chain%driver = nint(input%number('driver'))
      if (input%has('gravity_share')) self%chain%gravity_share = input%number('gravity_share')
      call read_chain(self%chain, self%outlines, input, problems)
   end subroutine read

   !> Make the mechanism
   subroutine make_mechanism(self, input, gravity, mechanism, impacts, error)
      class(chain_model_type), intent(inout) :: self
      !> Properties
      class(settings_type), intent(in) :: input
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> The mechanism
      class(mechanism_type), allocatable, intent(out) :: mechanism
      !> It has no model of its impacts
      type(impact_models_type), intent(out) :: impacts
      !> It does not move, or does not stand
      type(error_type), allocatable, intent(out) :: error

      type(tabulated_type), allocatable :: made
      type(chain_table_type) :: table
      real(wp) :: capacity, end
      logical :: is_smooth

      ! No model: which joints open after an impact does not follow from those that open before (dondolo_wall_chain_impact).
      impacts = impact_models_type()
      call check_chain(self%chain, self%outlines, error)
      if (allocated(error)) return
      call find_end(self%chain, capacity, end)
      if (.not. capacity < huge(1.0_wp)) then
         if (end < huge(1.0_wp)) then
            call raise_input(error, 'joints: the chain closes on itself at '//rounded(end)//' rad, before its moment '// &
               & 'vanishes; its joints must let it move further', out_of_range, 'joints')
         else
            call raise_input(error, 'moment: does not vanish up to 1.5 rad; the chain does not fall', out_of_range, 'moment')
         end if
         return
      end if
      call sample_chain(self%chain, min(beyond*capacity, before_end*end), table, is_smooth)
      if (.not. is_smooth) then
         call raise_input(error, 'joints: the terms change too fast near '//rounded(capacity)//' rad for a table of 129 '// &
            & 'rotations; a joint is nearly in line with others there', out_of_range, 'joints')
         return
      end if
      self%table = table%terms
      self%weight = table%weight
      self%displacement = table%displacement
      self%travel = table%travel
      self%weighted_lever = table%weighted_lever
      allocate (made)
      call new_tabulated(made, self%table, gravity, input%number('sides') > 1.0_wp, self%misfit, error)
      if (allocated(error)) return
      if (self%contact == spans) call chain_support(self%chain, made%share, made%tilt)
      call move_alloc(made, mechanism)
   end subroutine make_mechanism

   !> Describe bodies, joints and table
   subroutine describe(self, input, gravity, lines)
      class(chain_model_type), intent(in) :: self
      !> Properties
      class(settings_type), intent(in) :: input
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> `subject: numbers with their units`
      type(lines_type), intent(inout) :: lines

      integer :: i

      associate (of => input, ignored => gravity)
      end associate
      do i = 1, size(self%chain%bodies)
         associate (body => self%chain%bodies(i))
            call lines%add('body '//to_text(i)//': '//rounded(body%mass)//' kg at depth '//rounded(0.0_wp - body%at(1))// &
               & ' m, height '//rounded(body%at(2))//' m; inertia '//rounded(body%inertia)//' kg m2')
         end associate
      end do
      do i = 1, size(self%chain%actions)
         associate (action => self%chain%actions(i))
            call lines%add('action '//to_text(i)//': '//rounded(action%weight)//' N, thrust '//rounded(norm2(action%thrust))// &
               & ' N at depth '//rounded(0.0_wp - action%at(1))//' m, height '//rounded(action%at(2))//' m; pushed '// &
               & rounded(action%pushed)//' kg, lifted '//rounded(action%lifted)//' kg')
         end associate
      end do
      call self%tabulated_model_type%describe(input, gravity, lines)
   end subroutine describe

end module dondolo_wall_chain_model
