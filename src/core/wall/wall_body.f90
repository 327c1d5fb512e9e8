!> What a user says of a wall of one block, as sections, a rigid body and what acts on it.
module dondolo_wall_body
   use dondolo_base_error, only : not_given, not_together, out_of_range, problems_type, wrong_length
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : name_length, number_of_words, word_of
   use dondolo_base_settings, only : settings_type
   use dondolo_base_text, only : rounded, to_text
   use dondolo_base_unit_hint, only : unit_question
   use dondolo_wall_anchor, only : anchor_type
   use dondolo_wall_axis, only : axis_of, axis_type, take_heights
   use dondolo_wall_carried, only : actions_type, carried_type, spring_type, thrust_type
   use dondolo_wall_corner, only : body_of_corner, check_corner_hinge, corner_reach, corner_type, read_corner
   use dondolo_wall_hinge_depth, only : check_hinge, read_hinge_depth
   use dondolo_wall_interlocking, only : read_interlocking
   use dondolo_wall_lists, only : take
   use dondolo_wall_panel_places, only : check_panel_places
   use dondolo_wall_rigid_body, only : body_of_sections, faces_at, joined, rigid_body_type, same, section_type
   use dondolo_wall_ties, only : read_corner_ties, read_ties
   use dondolo_wall_elevation, only : read_elevation, top_of_elevation
   use dondolo_wall_wedge, only : read_wedges, wedge_reach, wedge_type
   implicit none
   private

   public :: wall_body_type, take_sections, read_corner_body, read_strip_body, read_wall_body

   !> A wall of one block
   type :: wall_body_type
      !> Its storeys from the bottom; of a corner what its square base covers of the bisector, from the outer to the inner edge
      type(section_type), allocatable :: sections(:)
      !> The facade without its wedges, of which the elevation is given; not allocated: it is that of the sections
      type(rigid_body_type), allocatable :: facade
      !> The corner that it is; not allocated: it is none
      type(corner_type), allocatable :: corner
      !> Wedges of transverse walls that turn with it; not allocated: of a strip
      type(wedge_type), allocatable :: wedges(:)
      !> The masonry, with its wedges, as one body
      type(rigid_body_type) :: body
      !> What acts on it
      type(actions_type) :: actions
      !> Anchors of its ties, in their order
      type(anchor_type), allocatable :: anchors(:)
   end type wall_body_type

contains

   !> Height and thickness of a wall of sections, and the mean density of a body whose mass is given
   subroutine take_sections(problems, input)
      !> Takes what does not agree
      type(problems_type), intent(inout) :: problems
      !> Settings of the wall
      class(settings_type), intent(inout) :: input

      real(wp), allocatable :: heights(:), thicknesses(:)

      heights = input%list('section_height')
      thicknesses = input%list('section_thickness')
      if (size(heights) > 0) call follow('height', sum(heights), 'the sum of section_height')
      if (size(thicknesses) > 0) call follow('thickness', thicknesses(1), 'that of the lowest section')
      if (top_of_elevation(input) > 0.0_wp) then
         call follow('height', top_of_elevation(input), 'that of the highest corner')
      else if (input%has('elevation_z')) then
         call problems%note('elevation_z: no masonry is above the '//trim(merge('axis                 ', 'base, at the height 0', &
            & input%has('axis_x'))), out_of_range, 'elevation_z')
         ! That of all of it, so that no height is asked for
         if (.not. input%has('height')) call input%set('height', maxval(input%list('elevation_z')) &
            & - minval(input%list('elevation_z')))
      end if
      if (input%has('mass') .and. input%number('height')*input%number('thickness') > 0.0_wp) call follow('density', &
         & input%number('mass')/(input%number('height')*input%number('thickness')), 'that of the mass')

   contains

      !> Set what follows from something else, or check it
      subroutine follow(name, value, from)
         !> Name of the property
         character(len=*), intent(in) :: name
         !> Its value
         real(wp), intent(in) :: value
         !> What it follows from
         character(len=*), intent(in) :: from

         if (input%has(name)) then
            if (abs(input%number(name) - value) > same*abs(value)) call problems%note(name//' = '// &
               & to_text(input%number(name))//': must be '//to_text(value)//', '//from//'; leave it out', out_of_range, name)
         end if
         ! To the bit, however few digits are given
         call input%set(name, value)
      end subroutine follow

   end subroutine take_sections

   !> Read sections, body and actions, and check what belongs together
   subroutine read_wall_body(input, gravity, two_sided, problems, wall)
      !> Settings of the wall, defaults filled in, ranges checked
      class(settings_type), intent(in) :: input
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> Does it rock to both sides?
      logical, intent(in) :: two_sided
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> The wall; undefined if something is wrong
      type(wall_body_type), intent(out) :: wall

      type(axis_type) :: axis
      integer :: before, i

      before = problems%count
      call read_sections(input, problems, wall%sections)
      call read_wedges(input, wall%sections, problems, wall%wedges)
      call read_elevation(input, problems, wall%facade)
      call read_loads(input, gravity, problems, wall%actions%carried, 'load')
      call read_thrusts(input, wall%sections, problems, wall%actions%thrusts, 'thrust')
      call read_springs(input, problems, wall%actions%springs)
      if (problems%count > before) return
      wall%body = body_of_sections(wall%sections, input%number('density'))
      if (allocated(wall%facade)) wall%body = wall%facade
      axis = axis_of(input)
      wall%actions%gravity_share = axis%cosine
      call read_mass(input, problems, wall%body)
      if (problems%count > before) return
      do i = 1, size(wall%wedges)
         wall%body = joined(wall%body, wall%wedges(i)%body)
      end do
      call read_hinge(input, gravity, problems, wall)
      call check_places(input, problems, wall)
      if (input%has('axis_x')) call check_panel_places(input, problems)
      call read_ties(input, wall%sections, wall%actions%hinge, wall%actions%edge, problems, wall%actions%restraints, &
         & wall%anchors)
      call read_interlocking(input, wall%sections, gravity, wall%actions%hinge, wall%actions%edge, problems, &
         & wall%actions%restraints)
      if (problems%count > before) return
      if (input%has('mass')) call take_inertia(input, problems, wall)
      if (two_sided) call check_symmetry(input, problems, wall)
   end subroutine read_wall_body

   !> Read a corner, what it carries and what pushes it, whole and in the plane of its bisector
   subroutine read_corner_body(input, gravity, problems, wall)
      !> Settings of the wall, defaults filled in, ranges checked
      class(settings_type), intent(in) :: input
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> The wall; undefined if something is wrong
      type(wall_body_type), intent(out) :: wall

      integer :: before

      before = problems%count
      allocate (wall%corner, wall%wedges(0), wall%actions%springs(0))
      wall%actions%is_whole = .true.
      call read_corner(input, problems, wall%corner)
      wall%sections = [section_type(wall%corner%height, sqrt(2.0_wp)*wall%corner%thickness)]
      call read_loads(input, gravity, problems, wall%actions%carried, 'load_total')
      call read_thrusts(input, wall%sections, problems, wall%actions%thrusts, 'thrust_total')
      if (problems%count > before) return
      wall%body = body_of_corner(wall%corner)
      call read_hinge(input, gravity, problems, wall)
      call check_places(input, problems, wall)
      call read_corner_ties(input, wall%sections, wall%actions%hinge, wall%actions%edge, problems, wall%actions%restraints, &
         & wall%anchors)
   end subroutine read_corner_body

   !> Read what acts between base and top of a strip: loads, masses, thrusts and ties
   subroutine read_strip_body(input, gravity, hinge, problems, strip)
      !> Settings of the strip, defaults filled in, ranges checked
      class(settings_type), intent(in) :: input
      !> Gravity [m/s2], and depth of its hinges [m]
      real(wp), intent(in) :: gravity, hinge
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> The strip as a rectangle; undefined if something is wrong
      type(wall_body_type), intent(out) :: strip

      strip%sections = [section_type(input%number('height'), input%number('thickness'))]
      strip%body = body_of_sections(strip%sections, input%number('density'))
      strip%actions%hinge = hinge
      call read_loads(input, gravity, problems, strip%actions%carried, 'load')
      call read_thrusts(input, strip%sections, problems, strip%actions%thrusts, 'thrust')
      allocate (strip%actions%springs(0))
      call check_places(input, problems, strip)
      call read_ties(input, strip%sections, hinge, 0.0_wp, problems, strip%actions%restraints, strip%anchors)
   end subroutine read_strip_body

   !> The storeys
   subroutine read_sections(input, problems, sections)
      !> Settings of the wall
      class(settings_type), intent(in) :: input
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> From the bottom; one if none is given
      type(section_type), allocatable, intent(out) :: sections(:)

      real(wp), allocatable :: thickness(:), fill(:), offset(:), base(:), top(:)

      call take(input, problems, 'section_thickness', 'section_height', thickness)
      call take(input, problems, 'section_fill', 'section_height', fill, 1.0_wp)
      call take(input, problems, 'section_offset', 'section_height', offset, 0.0_wp)
      call take(input, problems, 'section_base_width', 'section_height', base, 1.0_wp)
      call take(input, problems, 'section_top_width', 'section_height', top, -1.0_wp)
      if (.not. input%has('section_height')) then
         sections = [section_type(input%number('height'), input%number('thickness')/leaves_of(input))]
         return
      end if
      where (top < 0.0_wp) top = base
      allocate (sections(size(thickness)))
      sections%height = input%list('section_height')
      sections%thickness = thickness/leaves_of(input)
      if (leaves_of(input) > 1.0_wp .and. any(abs(thickness - thickness(1)) > same*thickness(1))) call problems%note( &
         & 'section_thickness: must be the same of all storeys with leaves = '//to_text(leaves_of(input))//', which are not '// &
         & 'equal where the wall becomes thinner; describe each leaf as a wall, both in one facade', not_together, &
         & 'section_thickness')
      sections%fill = fill
      sections%offset = offset
      sections%base_width = base
      sections%top_width = top
      if (any(.not. base + top > 0.0_wp)) call problems%note('section_top_width: must be positive where '// &
         & 'section_base_width is 0', out_of_range, 'section_top_width')
      if (abs(offset(1)) > 0.0_wp) call problems%note('section_offset = '//to_text(offset(1))// &
         & ': must be 0 for the lowest section, from whose outer face depths are measured', out_of_range, 'section_offset')
   end subroutine read_sections

   !> Number of leaves; equal ones rock with nearly the same rotation, so that one of them is as good as all
   pure real(wp) function leaves_of(input)
      !> Settings of the wall
      class(settings_type), intent(in) :: input

      leaves_of = 1.0_wp
      if (input%has('leaves')) leaves_of = input%number('leaves')
   end function leaves_of

   !> Mass and centroid where they are given
   subroutine read_mass(input, problems, body)
      !> Settings of the wall
      class(settings_type), intent(in) :: input
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> The body of the sections; out: as given
      type(rigid_body_type), intent(inout) :: body

      character(len=*), parameter :: names(4) = [character(len=16) :: 'mass', 'centroid_depth', 'centroid_height', &
         & 'hinge_inertia']
      logical :: given(4)
      integer :: i

      given = [(input%has(trim(names(i))), i=1, 4)]
      if (.not. any(given)) return
      do i = 1, 4
         if (.not. given(i)) call problems%note(trim(names(i))//': must be given with '// &
            & trim(names(findloc(given, .true., dim=1))), not_given, trim(names(i)))
      end do
      body = rigid_body_type(input%number('mass'), input%number('centroid_depth'), input%number('centroid_height'))
   end subroutine read_mass

   !> The inertia of a body about its centroid from that about the hinge
   subroutine take_inertia(input, problems, wall)
      !> Settings of the wall
      class(settings_type), intent(in) :: input
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> The wall, its hinge known
      type(wall_body_type), intent(inout) :: wall

      real(wp) :: least

      associate (body => wall%body)
         least = body%mass*((body%depth - wall%actions%hinge)**2 + body%height**2)
         body%inertia = input%number('hinge_inertia') - least
         if (body%inertia < 0.0_wp) call problems%note('hinge_inertia = '//to_text(input%number('hinge_inertia'))// &
            & ': must be at least '//to_text(least)//', which the mass has at its centroid', out_of_range, 'hinge_inertia')
      end associate
   end subroutine take_inertia

   !> Loads, and masses that are pushed alone
   subroutine read_loads(input, gravity, problems, carried, name)
      !> Settings of the wall
      class(settings_type), intent(in) :: input
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> Loads and masses
      type(carried_type), allocatable, intent(out) :: carried(:)
      !> Name of the list of loads
      character(len=*), intent(in) :: name

      real(wp), allocatable :: load(:), depth(:), height(:), seat(:), mass(:), mass_depth(:), mass_height(:)
      real(wp), allocatable :: lifted(:), pushed(:)
      integer :: words, i
      logical :: by_parts

      load = input%list(name)
      call take(input, problems, 'load_depth', name, depth)
      call take_heights(input, problems, 'load', name, height)
      call take(input, problems, 'load_seat', name, seat, huge(1.0_wp))
      mass = input%list('inertia_mass')
      call take(input, problems, 'inertia_depth', 'inertia_mass', mass_depth)
      call take_heights(input, problems, 'inertia', 'inertia_mass', mass_height)
      words = number_of_words(input%word('load_inertia'))
      by_parts = input%has('load_lifted') .or. input%has('load_pushed')
      if (by_parts) then
         call take(input, problems, 'load_lifted', name, lifted)
         call take(input, problems, 'load_pushed', name, pushed)
      else if (size(load) > 0 .and. words == 0) then
         call problems%note('load_inertia: must be given with '//name//': ''none'' (a dead force), ''vertical'' (a mass that '// &
            & 'other walls hold sideways) or ''both'' (a mass that the wall pushes too); or load_lifted and load_pushed', &
            & not_given, 'load_inertia')
      else if (size(load) == 0 .and. words > 0) then
         call problems%note('load_inertia: only with '//name, not_together, 'load_inertia')
      else if (words > 1 .and. words /= size(load)) then
         call problems%note('load_inertia: has '//to_text(words)//' values, must have '//to_text(size(load))// &
            & ' as '//name//', or one for all', wrong_length, 'load_inertia')
      end if
      allocate (carried(size(load) + size(mass)))
      do i = 1, size(load)
         carried(i) = carried_type(depth(i), height(i), load(i), seat=seat(i))
         if (by_parts) then
            carried(i)%dead = (1.0_wp - lifted(i))*load(i)
            carried(i)%lifted = lifted(i)*load(i)/gravity
            carried(i)%pushed = pushed(i)*load(i)/gravity
            cycle
         end if
         select case (word_of(input%word('load_inertia'), merge(1, i, words == 1)))
         case ('none')
            carried(i)%dead = load(i)
         case ('vertical')
            carried(i)%lifted = load(i)/gravity
         case ('both')
            carried(i)%lifted = load(i)/gravity
            carried(i)%pushed = load(i)/gravity
         end select
      end do
      do i = 1, size(mass)
         carried(size(load) + i) = carried_type(mass_depth(i), mass_height(i), pushed=mass(i))
      end do
   end subroutine read_loads

   !> Thrusts; their depth is that of the inner face unless it is given
   subroutine read_thrusts(input, sections, problems, thrusts, name)
      !> Settings of the wall
      class(settings_type), intent(in) :: input
      !> Its storeys
      type(section_type), intent(in) :: sections(:)
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> Thrusts
      type(thrust_type), allocatable, intent(out) :: thrusts(:)
      !> Name of the list of thrusts
      character(len=*), intent(in) :: name

      real(wp), allocatable :: depth(:), height(:), decay(:)
      real(wp) :: faces(2)
      integer :: i

      call take_heights(input, problems, 'thrust', name, height)
      call take(input, problems, 'thrust_depth', name, depth, -huge(1.0_wp))
      call take(input, problems, 'thrust_decay', name, decay, huge(1.0_wp))
      do i = 1, size(depth)
         if (depth(i) > -huge(1.0_wp)) cycle
         faces = faces_at(sections, height(i))
         depth(i) = faces(2)
      end do
      allocate (thrusts(size(depth)))
      thrusts%depth = depth
      thrusts%height = height
      thrusts%force = input%list(name)
      thrusts%decay = decay
   end subroutine read_thrusts

   !> Springs at a height and distributed ones
   subroutine read_springs(input, problems, springs)
      !> Settings of the wall
      class(settings_type), intent(in) :: input
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> Both
      type(spring_type), allocatable, intent(out) :: springs(:)

      real(wp), allocatable :: depth(:), height(:), distributed_spring_depth(:), bottom(:), top(:)

      call take(input, problems, 'spring_depth', 'spring', depth)
      call take(input, problems, 'spring_height', 'spring', height)
      call take(input, problems, 'distributed_spring_depth', 'distributed_spring', distributed_spring_depth)
      call take(input, problems, 'distributed_spring_bottom', 'distributed_spring', bottom)
      call take(input, problems, 'distributed_spring_top', 'distributed_spring', top)
      if (any(.not. top > bottom)) call problems%note('distributed_spring_top: must be above '// &
         & 'distributed_spring_bottom', out_of_range, 'distributed_spring_top')
      allocate (springs(size(depth) + size(distributed_spring_depth)))
      springs%depth = [depth, distributed_spring_depth]
      springs%bottom = [height, bottom]
      springs%top = [height, top]
      springs%stiffness = [input%list('spring'), input%list('distributed_spring')]
   end subroutine read_springs

   !> The hinge: its depth, given or from the strength of the masonry under all weights, or where the edge begins
   subroutine read_hinge(input, gravity, problems, wall)
      !> Settings of the wall
      class(settings_type), intent(in) :: input
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> The wall, its loads known
      type(wall_body_type), intent(inout) :: wall

      real(wp) :: hinge, edge, depth
      character(len=name_length) :: name
      integer :: i

      call read_hinge_depth(input, gravity*wall%body%mass + sum(wall%actions%carried%weight), problems, hinge, name, &
         & allocated(wall%corner))
      edge = input%number('edge_radius')
      if (edge > 0.0_wp) then
         hinge = edge
         name = 'edge_radius'
      end if
      wall%actions%hinge = hinge
      wall%actions%edge = edge
      call check_hinge(input, problems, name, hinge, wall%body%depth, 'the centroid of the wall, '// &
         & rounded(wall%body%depth)//' m', 'section_offset')
      if (allocated(wall%corner)) call check_corner_hinge(wall%corner, input, problems, name, hinge)
      ! What is behind the facade does not bear on its base
      if (any(wall%wedges%body%mass > 0.0_wp)) call check_hinge(input, problems, name, hinge, &
         & 0.5_wp*wall%sections(1)%thickness, 'half the thickness of the facade, '// &
         & rounded(0.5_wp*wall%sections(1)%thickness)//' m', 'section_thickness')
      if (.not. edge < wall%body%height) call problems%note('edge_radius = '//to_text(edge)// &
         & ': must be less than the height of the centroid, '//rounded(wall%body%height)//' m', out_of_range, 'edge_radius')
      do i = 1, size(wall%actions%carried)
         depth = wall%actions%carried(i)%depth
         if (.not. wall%actions%carried(i)%weight > 0.0_wp .or. depth < 0.0_wp) cycle
         call check_hinge(input, problems, name, hinge, depth, 'load '//to_text(i)//', load_depth = '//to_text(depth), &
            & 'load_depth')
      end do
   end subroutine read_hinge

   !> Check that everything acts within the wall
   subroutine check_places(input, problems, wall)
      !> Settings of the wall
      class(settings_type), intent(in) :: input
      !> Takes what does not
      type(problems_type), intent(inout) :: problems
      type(wall_body_type), intent(in) :: wall

      integer :: i, loads, springs

      loads = size(input%list(trim(merge('load_total', 'load      ', allocated(wall%corner)))))
      springs = size(input%list('spring'))
      associate (actions => wall%actions)
         do i = 1, size(actions%carried)
            associate (thing => actions%carried(i))
               if (i <= loads) call inside('load', i, thing%depth, thing%height)
               if (i > loads) call inside('inertia', i - loads, thing%depth, thing%height)
            end associate
         end do
         do i = 1, size(actions%thrusts)
            call inside('thrust', i, actions%thrusts(i)%depth, actions%thrusts(i)%height)
         end do
         do i = 1, size(actions%springs)
            associate (thing => actions%springs(i))
               if (i <= springs) call inside('spring', i, thing%depth, thing%top)
               if (i > springs) call inside('distributed_spring', i - springs, thing%depth, thing%top)
               if (i > springs) call inside('distributed_spring', i - springs, thing%depth, thing%bottom)
            end associate
         end do
      end associate

   contains

      !> Check one place
      subroutine inside(what, number, depth, height)
         !> What acts there, and which of its kind
         character(len=*), intent(in) :: what
         integer, intent(in) :: number
         !> Where [m]
         real(wp), intent(in) :: depth, height

         real(wp) :: faces(2), tall

         tall = sum(wall%sections%height)
         faces = faces_at(wall%sections, height)
         if (allocated(wall%wedges)) faces(2) = faces(2) + wedge_reach(wall%wedges, height)
         if (allocated(wall%corner) .and. faces(1) <= faces(2)) faces(2) = corner_reach(wall%corner, height)
         if (faces(1) > faces(2) .and. input%has('axis_x')) then
            call problems%note(what//' '//to_text(number)//': lies '//rounded(height)//' m above the axis, must lie between 0 '// &
               & 'and '//rounded(tall)//' m, the panel', out_of_range, what//'_height')
         else if (faces(1) > faces(2)) then
            call problems%note(what//' '//to_text(number)//': its height '//to_text(height)//' must lie between 0 and '// &
               & rounded(tall)//' m, the wall'//trim(unit_question('m', height, 0.0_wp, tall, 0.5_wp*tall)), out_of_range, &
               & what//trim(merge('_top   ', '_height', what == 'distributed_spring')))
         else if (depth < faces(1) - same*tall .or. depth > faces(2) + same*tall) then
            call problems%note(what//' '//to_text(number)//': its depth '//to_text(depth)//' must lie between '// &
               & rounded(faces(1))//' and '//rounded(faces(2))//' m, '//trim(merge('the outer edge and the ends of the wings', &
               & 'the faces of the wall                   ', allocated(wall%corner)))//' at its height'// &
               & trim(unit_question('m', depth, faces(1), faces(2), 0.5_wp*sum(faces))), out_of_range, what//'_depth')
         end if
      end subroutine inside

   end subroutine check_places

   !> Check that a wall that rocks to both sides is the same from both
   subroutine check_symmetry(input, problems, wall)
      !> Settings of the wall
      class(settings_type), intent(in) :: input
      !> Takes what is not
      type(problems_type), intent(inout) :: problems
      type(wall_body_type), intent(in) :: wall

      real(wp) :: centre

      centre = 0.5_wp*wall%sections(1)%thickness
      associate (sections => wall%sections, actions => wall%actions)
         if (any(is_off(sections%offset + 0.5_wp*sections%thickness))) call refuse('section_offset', 'sections')
         if (is_off(wall%body%depth)) call refuse('centroid_depth', 'a body')
         if (any(is_off(actions%carried%depth))) call refuse(trim(merge('load_depth   ', 'inertia_depth', &
            & input%has('load'))), 'loads and masses')
         if (any(is_off(actions%springs%depth))) call refuse(trim(merge('spring_depth            ', 'distributed_spring_depth', &
            & input%has('spring'))), 'springs')
         if (size(actions%thrusts) > 0) call problems%note('thrust: not for mechanism = ''free_standing'', which rocks to '// &
            & 'both sides', not_together, 'thrust')
      end associate

   contains

      !> Is a depth not the middle of the wall?
      elemental logical function is_off(depth)
         !> Depth [m]
         real(wp), intent(in) :: depth

         is_off = abs(depth - centre) > same*centre
      end function is_off

      !> Note what is not in the middle
      subroutine refuse(name, what)
         !> Name of the property, and what it places
         character(len=*), intent(in) :: name, what

         call problems%note(name//': a wall of mechanism = ''free_standing'' has '//what//' at half its thickness, '// &
            & to_text(centre)//', since it rocks to both sides', not_together, name)
      end subroutine refuse

   end subroutine check_symmetry

end module dondolo_wall_body
