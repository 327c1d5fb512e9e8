!> Walls that are chains of rigid bodies: 'chain', and 'horizontal', whose chain follows from its geometry. Properties of the first,
!> and how they become mechanisms: joints decide how they move, and terms are sampled into a table (dondolo_wall_tabulated).
module dondolo_wall_chain_model
   use dondolo_base_error, only : error_type, not_at_rest, not_given, out_of_range, problems_type, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_property, only : blank, choices_length, is_integer, is_list, is_text, most_choices, property_type
   use dondolo_base_settings, only : settings_type
   use dondolo_base_text, only : rounded, to_text
   use dondolo_building_input, only : spans
   use dondolo_wall_anchor, only : anchor_type
   use dondolo_wall_chain, only : chain_type, motion_type
   use dondolo_wall_chain_check, only : chain_weights
   use dondolo_wall_chain_input, only : body_numbers, chain_rows_type, joint_numbers, read_chain
   use dondolo_wall_chain_masonry, only : impact_bound, is_symmetric, masonry_type
   use dondolo_wall_chain_overlap, only : outline_type
   use dondolo_wall_chain_sides, only : make_inward
   use dondolo_wall_chain_state, only : check_chain, deepest_overlap_type, find_overlap
   use dondolo_wall_chain_table, only : chain_table_type, sample_chain
   use dondolo_wall_chain_terms, only : chain_support, chain_terms_type, find_end, set_at_rest, terms_at
   use dondolo_wall_chain_ties, only : anchors_of, tie_chain
   use dondolo_wall_horizontal, only : check_horizontal, read_horizontal, take_length
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_restitution, only : impact_models_type
   use dondolo_wall_tabulated, only : new_tabulated, tabulated_type
   use dondolo_wall_tabulated_model, only : chain_name, horizontal_name, tabulated_model_type
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
      & property_type('ties', is_text, owners=chain, optional=.true., replaced=.true., example='data/walls/portal_ties.csv', &
      &   meaning='CSV file of ties, which hold its bodies outwards', &
      &   more='columns body, depth [m], height [m], area [m2], length [m]'), &
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
      &   example='1.0, 0.2, 3.5', meaning='rows of the actions as numbers, 10 a row, instead of their file'), &
      & property_type('tie_table', is_list, owners=chain, optional=.true., smallest=-1.0e9_wp, largest=1.0e12_wp, &
      &   example='1.0, 0.0, 0.0', meaning='rows of the ties as numbers, 14 a row, instead of their file')]

   !> A wall that is a chain
   type, extends(tabulated_model_type) :: chain_model_type
      type(chain_type) :: chain
      !> Its rows, as given or as they follow from its geometry
      type(chain_rows_type) :: rows
      !> Its masonry, with what stands still
      type(masonry_type) :: masonry
      !> Anchors of its ties; forces are those of a whole tie
      type(anchor_type), allocatable :: anchors(:)
      !> alpha_0 outwards and inwards; huge: it moves to one side, or inwards as its mirror image
      real(wp) :: multiplier(2) = huge(1.0_wp)
      !> Are its terms those of the motion inwards, so that the chain and its outlines are seen from behind?
      logical :: is_inward = .false.
      !> Is the motion inwards taken as the mirror image of that outwards, because other joints may open?
      logical :: is_mirrored = .false.
      !> Is all of the masonry, with what acts on it, its mirror image?
      logical :: is_image = .false.
      !> Upper bound of the restitution; huge: it is not known where the joints end
      real(wp) :: bound = huge(1.0_wp)
      !> Was the place of a hinge looked for?
      logical :: is_weakest = .false.
      !> Bodies that move into each other
      type(deepest_overlap_type) :: overlap
   contains
      procedure :: prepare
      procedure :: read
      procedure :: make_mechanism
      procedure :: describe
   end type chain_model_type

   !> How much the two directions may differ / the lesser, and what is rounding of it
   real(wp), parameter :: alike = 0.02_wp, same = 1.0e-9_wp

   !> Last rotation of its table / capacity, and / geometric end
   real(wp), parameter :: beyond = 1.1_wp, before_end = 0.999_wp

contains

   !> Note whether a building holds its top
   subroutine prepare(self, input, problems)
      class(chain_model_type), intent(inout) :: self
      !> Properties as given
      class(settings_type), intent(inout) :: input
      !> Takes what does not agree
      type(problems_type), intent(inout) :: problems

      ! Both ends of a wall that bends horizontally move with the transverse walls at its level.
      if (input%word('mechanism') == horizontal_name) call take_length(input, problems)
      if (stands_between(input%list('joint_table'), input%list('body_table'))) self%contact = spans
   end subroutine prepare

   !> Do joints with the ground lie at two levels?
   pure logical function stands_between(list, bodies)
      !> Rows of the joints, and of the bodies, one after the other
      real(wp), intent(in) :: list(:), bodies(:)

      real(wp) :: low, high
      integer :: i

      low = huge(1.0_wp)
      high = -huge(1.0_wp)
      do i = 0, size(list)/joint_numbers - 1
         associate (row => list(joint_numbers*i + 1:joint_numbers*(i + 1)))
            if (nint(row(2)) /= 0 .and. nint(row(3)) /= 0) cycle
            low = min(low, row(5))
            high = max(high, row(5))
         end associate
      end do
      stands_between = high > low
      ! A hinge on masonry that stands still is at no floor.
      if (size(bodies) > 0) stands_between = stands_between .and. .not. any(nint(bodies(::body_numbers)) == 0)
   end function stands_between

   !> Read the rows, and check that they make a mechanism of one degree of freedom
   subroutine read(self, input, gravity, problems)
      class(chain_model_type), intent(inout) :: self
      !> Properties, defaults filled in
      class(settings_type), intent(inout) :: input
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> In: values beyond their ranges; takes what is wrong
      type(problems_type), intent(inout) :: problems

      associate (is_band => input%word('mechanism') == horizontal_name)
         if (.not. input%has('sides')) call problems%note('sides: must be given with mechanism = '''//trim(merge(horizontal_name, &
            & chain_name, is_band))//''': 1 (one side only) or 2 (both, as mirror images)', not_given, 'sides')
         if (is_band) then
            call check_horizontal(input, problems)
         else
            if (.not. input%has('body_table')) call problems%note('bodies: must be given with mechanism = ''chain''', not_given, &
               & 'bodies')
            if (.not. input%has('joint_table')) call problems%note('joints: must be given with mechanism = ''chain''', &
               & not_given, 'joints')
         end if
         if (problems%count > 0) return
         self%is_whole = .true.
         self%chain%gravity = gravity
         self%chain%driver = 1
         if (is_band) then
            self%chain%gravity_share = 0.0_wp
            self%is_weakest = .not. input%has('hinge_x')
            call read_horizontal(input, problems, self%rows, self%hinge_depth)
            if (problems%count > 0) return
         else
            if (input%has('driver')) self%chain%driver = nint(input%number('driver'))
            if (input%has('gravity_share')) self%chain%gravity_share = input%number('gravity_share')
            self%rows = chain_rows_type(input%list('body_table'), input%list('joint_table'), input%list('action_table'), &
               & input%list('tie_table'))
         end if
      end associate
      call read_chain(self%chain, self%masonry, self%rows, input%number('height'), problems)
      if (problems%count > 0) return
      self%anchors = anchors_of(self%chain)
      if (any(self%chain%ties%other > 0) .and. input%number('sides') > 1.0_wp) call problems%note('ties: tie '// &
         & to_text(findloc(self%chain%ties%other > 0, .true., dim=1))//' between two bodies would act to both sides, and ties '// &
         & 'are followed outwards alone; give sides = 1', out_of_range, 'ties')
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
      type(chain_type) :: outward
      real(wp) :: capacity, end
      logical :: is_known, is_smooth

      ! No model: which joints open after an impact does not follow from those that open before (dondolo_wall_chain_impact).
      impacts = impact_models_type()
      call check_chain(self%chain, self%masonry%outlines, error)
      if (.not. allocated(error)) call find_capacity(self%chain, capacity, end, error)
      outward = self%chain
      if (.not. allocated(error)) call look_inward(self, input%number('sides') > 1.0_wp, capacity, end, is_known, error)
      if (allocated(error)) return
      ! Where other joints may open that are not known, no bound is.
      if (is_known .or. self%is_image) then
         call impact_bound(self%chain, self%masonry, self%is_image, self%bound, is_known)
         if (.not. is_known) self%bound = huge(1.0_wp)
      end if
      call find_overlap(self%chain, self%masonry%outlines, capacity, self%overlap)
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
      ! Ties hold the motion outwards, whichever side the terms are of.
      if (size(outward%ties) > 0) call tie_chain(outward, self%table%rotation, made, error)
      if (allocated(error)) return
      call move_alloc(made, mechanism)
   end subroutine make_mechanism

   !> Find the capacity of a chain
   subroutine find_capacity(chain, capacity, end, error)
      type(chain_type), intent(in) :: chain
      !> Capacity and geometric end [rad]
      real(wp), intent(out) :: capacity, end
      !> It has no capacity
      type(error_type), allocatable, intent(out) :: error

      call find_end(chain, capacity, end)
      if (capacity < huge(1.0_wp)) return
      if (end < huge(1.0_wp)) then
         call raise_input(error, 'joints: the chain closes on itself at '//rounded(end)//' rad, before its moment '// &
            & 'vanishes; its joints must let it move further', out_of_range, 'joints')
      else
         call raise_input(error, 'moment: does not vanish up to 1.5 rad; the chain does not fall', out_of_range, 'moment')
      end if
   end subroutine find_capacity

   !> Look at the motion inwards: of a chain that moves to both sides take the one of the lesser multiplier, if they are about alike
   subroutine look_inward(model, moves_inwards, capacity, end, is_known, error)
      type(chain_model_type), intent(inout) :: model
      !> Does it move to both sides?
      logical, intent(in) :: moves_inwards
      !> In: outwards; out: on the side that is taken [rad]
      real(wp), intent(inout) :: capacity, end
      !> Is it known which joints open inwards?
      logical, intent(out) :: is_known
      !> The sides differ
      type(error_type), allocatable, intent(out) :: error

      type(chain_type) :: inward
      type(outline_type), allocatable :: outlines(:)
      real(wp) :: inward_capacity, inward_end

      call make_inward(model%chain, model%masonry%outlines, inward, outlines, is_known)
      if (is_known .and. moves_inwards) call check_chain(inward, outlines, error)
      if (allocated(error)) then
         if (error%problem(1)%code == not_at_rest) then
            error%message = 'sides = 2: inwards the chain falls by itself ('//error%message//'); give sides = 1'
            return
         end if
         deallocate (error)
         is_known = .false.
      end if
      if (.not. is_known) model%is_image = is_symmetric(model%masonry, model%chain%actions)
      model%is_mirrored = moves_inwards .and. .not. is_known
      if (.not. (is_known .and. moves_inwards)) return
      call find_capacity(inward, inward_capacity, inward_end, error)
      if (allocated(error)) return
      model%multiplier = [multiplier_of(model%chain), multiplier_of(inward)]
      associate (alpha => model%multiplier, q => [capacity, inward_capacity])
         if (max(maxval(alpha)/minval(alpha), maxval(q)/minval(q)) > 1.0_wp + alike) then
            call raise_input(error, 'sides = 2: outwards and inwards differ (alpha_0 '//rounded(alpha(1))//' and '// &
               & rounded(alpha(2))//', capacity '//rounded(q(1))//' and '//rounded(q(2))//' rad) by more than '// &
               & rounded(100.0_wp*alike)//' %; give two walls of one facade, with sides = 1', out_of_range, 'sides')
            return
         end if
         if (alpha(1) <= alpha(2)*(1.0_wp + same)) return
      end associate
      model%is_inward = .true.
      model%chain = inward
      model%masonry%outlines = outlines
      model%masonry%parts%at(1) = -model%masonry%parts%at(1)
      capacity = inward_capacity
      end = inward_end
   end subroutine look_inward

   !> Multiplier that starts a chain
   real(wp) function multiplier_of(chain) result(alpha)
      type(chain_type), intent(in) :: chain

      type(motion_type) :: motion
      type(chain_terms_type) :: terms
      real(wp), allocatable :: weight(:), displacement(:)

      call set_at_rest(chain, motion)
      terms = terms_at(chain, motion)
      call chain_weights(chain, motion, weight, displacement)
      alpha = terms%moment/sum(weight*displacement)
   end function multiplier_of

   !> Describe bodies, joints and table
   subroutine describe(self, input, gravity, lines)
      class(chain_model_type), intent(in) :: self
      !> Properties
      class(settings_type), intent(in) :: input
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> `subject: numbers with their units`
      type(lines_type), intent(inout) :: lines

      real(wp) :: side
      integer :: i

      associate (ignored => gravity)
      end associate
      side = merge(-1.0_wp, 1.0_wp, self%is_inward)
      if (input%word('mechanism') == horizontal_name) call describe_leaves(self, input, lines)
      do i = 1, size(self%chain%bodies)
         associate (body => self%chain%bodies(i))
            call lines%add('body '//to_text(i)//': '//rounded(body%mass)//' kg at depth '//rounded(0.0_wp - side*body%at(1))// &
               & ' m, height '//rounded(body%at(2))//' m; inertia '//rounded(body%inertia)//' kg m2')
         end associate
      end do
      do i = 1, size(self%chain%actions)
         associate (action => self%chain%actions(i))
            call lines%add('action '//to_text(i)//': '//rounded(action%weight)//' N, thrust '//rounded(norm2(action%thrust))// &
               & ' N at depth '//rounded(0.0_wp - side*action%at(1))//' m, height '//rounded(action%at(2))//' m; pushed '// &
               & rounded(action%pushed)//' kg, lifted '//rounded(action%lifted)//' kg')
         end associate
      end do
      do i = 1, size(self%chain%ties)
         associate (tie => self%chain%ties(i), given => self%chain%ties(i)%given)
            call lines%add('tie '//to_text(i)//': yields at '//rounded(given%strength*given%area)//' N, '//rounded(given%length)// &
               & ' m free to stretch, at depth '//rounded(0.0_wp - tie%at(1))//' m, height '//rounded(tie%at(2))//' m')
         end associate
      end do
      if (self%multiplier(1) < huge(1.0_wp)) call lines%add('sides: alpha_0 '//rounded(self%multiplier(1))//' outwards and '// &
         & rounded(self%multiplier(2))//' inwards; the terms of the lesser are used for both')
      if (self%is_mirrored .and. self%is_image) then
         call lines%add('sides: it moves inwards as its mirror image, which all of it is')
      else if (self%is_mirrored) then
         call lines%add('sides: inwards it is taken to move as the mirror image; that the masonry is one is not known')
      end if
      if (self%bound < huge(1.0_wp)) then
         call lines%add('restitution: '//rounded(input%number('restitution_value'))//' given; an impact on all joints leaves '// &
            & rounded(self%bound)//', an upper bound with unlimited friction')
      else
         call lines%add('restitution: '//rounded(input%number('restitution_value'))//' given; no upper bound, because not all '// &
            & 'joints that an impact may open are known')
      end if
      call self%tabulated_model_type%describe(input, gravity, lines)
   end subroutine describe

   !> Describe where a wall that bends horizontally has its hinge
   subroutine describe_leaves(model, input, lines)
      type(chain_model_type), intent(in) :: model
      !> Properties
      class(settings_type), intent(in) :: input
      !> `subject: numbers with their units`
      type(lines_type), intent(inout) :: lines

      associate (hinge => model%chain%joints(2)%at(2), length => input%number('length'))
         call lines%add('leaves: '//rounded(hinge)//' and '//rounded(length - hinge)//' m long, of a band of 1 m height; the '// &
            & 'hinge between them is '//trim(merge('given                 ', 'where alpha_0 is least', .not. model%is_weakest)))
      end associate
   end subroutine describe_leaves

end module dondolo_wall_chain_model
