!> The ties of a wall as a user describes them.
module dondolo_wall_ties
   use dondolo_base_error, only : not_given, not_together, out_of_range, problems_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_settings, only : settings_type
   use dondolo_base_text, only : rounded, to_text
   use dondolo_base_unit_hint, only : unit_question
   use dondolo_wall_anchor, only : anchor_type, compute_anchor, masonry_type
   use dondolo_wall_lists, only : take
   use dondolo_wall_restraint, only : new_tie, tie_input_type, restraint_type
   use dondolo_wall_rigid_body, only : faces_at, same, section_type
   implicit none
   private

   public :: read_corner_ties, read_ties

   !> How far outside the outer face an anchor may be [m]
   real(wp), parameter :: outside = 0.1_wp

contains

   !> Read the ties, and check each
   subroutine read_ties(input, sections, hinge, edge, problems, ties, anchors)
      !> Settings of the wall
      class(settings_type), intent(in) :: input
      !> Its storeys
      type(section_type), intent(in) :: sections(:)
      !> Depth of the hinge, and radius of the edge [m]
      real(wp), intent(in) :: hinge, edge
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> Ties; undefined if something is wrong
      type(restraint_type), allocatable, intent(out) :: ties(:)
      !> Their anchors
      type(anchor_type), allocatable, intent(out) :: anchors(:)

      real(wp), allocatable :: depth(:), length(:), modulus(:), strength(:), preload(:), strain(:), anchor(:)
      type(tie_input_type), allocatable :: given(:)
      integer :: i, before

      call take(input, problems, 'tie_depth', 'tie_height', depth, input%absent('tie_depth'))
      call take(input, problems, 'tie_length', 'tie_height', length)
      call take(input, problems, 'tie_modulus', 'tie_height', modulus, input%absent('tie_modulus'))
      call take(input, problems, 'tie_strength', 'tie_height', strength, input%absent('tie_strength'))
      call take(input, problems, 'tie_preload', 'tie_height', preload, input%absent('tie_preload'))
      call take(input, problems, 'tie_strain', 'tie_height', strain, input%absent('tie_strain'))
      call take(input, problems, 'tie_anchor_force', 'tie_height', anchor, input%absent('tie_anchor_force'))
      before = problems%count
      call read_anchors(input, problems, anchors)
      allocate (given(size(depth)), ties(size(depth)))
      given%depth = depth
      given%height = input%list('tie_height')
      given%area = anchors%area
      given%length = length
      given%modulus = modulus
      given%strength = strength
      given%preload = preload
      given%strain = strain
      given%anchor_force = anchor
      anchors%length = length
      anchors%strength = strength
      if (problems%count == before) call compute_anchors(input, sections, given, problems, anchors)
      do i = 1, size(given)
         if (.not. (anchors(i)%area > 0.0_wp .and. length(i) > 0.0_wp)) return
         call check_tie('tie '//to_text(i), given(i), sections, edge, problems)
         ties(i) = new_tie(given(i), hinge, edge)
      end do
   end subroutine read_ties

   !> Read the ties of a corner, each along one of its walls. On the bisector the anchor goes sqrt 2 times as far as the tie gets
   !> longer, and the tie pulls with 1/sqrt 2 of its force: a bar of A/sqrt 2 and l sqrt 2 does the same along the bisector
   subroutine read_corner_ties(input, sections, hinge, edge, problems, ties, anchors)
      !> Settings of the corner
      class(settings_type), intent(in) :: input
      !> What its square covers of the bisector
      type(section_type), intent(in) :: sections(:)
      !> Depth of the hinge, and radius of the edge [m]
      real(wp), intent(in) :: hinge, edge
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> Ties, along the bisector; undefined if something is wrong
      type(restraint_type), allocatable, intent(out) :: ties(:)
      !> Their anchors, whole; those that are 0 long are not known
      type(anchor_type), allocatable, intent(out) :: anchors(:)

      real(wp), parameter :: share = sqrt(0.5_wp), pi = acos(-1.0_wp)
      type(tie_input_type), allocatable :: given(:)
      real(wp), allocatable :: values(:)
      integer :: before, i

      before = problems%count
      allocate (given(size(input%list('tie_height'))))
      allocate (anchors(size(given)), ties(size(given)))
      given%height = input%list('tie_height')
      call take(input, problems, 'tie_depth', 'tie_height', values, input%absent('tie_depth'))
      given%depth = values
      call take(input, problems, 'tie_bar', 'tie_height', values)
      anchors%bar = values
      anchors%area = 0.25_wp*pi*values**2
      if (any(.not. values > 0.0_wp)) call problems%note('tie_bar: must be positive for each tie of a corner', out_of_range, &
         & 'tie_bar')
      call take(input, problems, 'tie_length', 'tie_height', values)
      anchors%length = values
      call take(input, problems, 'tie_modulus', 'tie_height', values, input%absent('tie_modulus'))
      given%modulus = values
      call take(input, problems, 'tie_strength', 'tie_height', values, input%absent('tie_strength'))
      given%strength = values
      anchors%strength = values
      call take(input, problems, 'tie_preload', 'tie_height', values, input%absent('tie_preload'))
      given%preload = values
      call take(input, problems, 'tie_strain', 'tie_height', values, input%absent('tie_strain'))
      given%strain = values
      call take(input, problems, 'tie_anchor_total', 'tie_height', values, input%absent('tie_anchor_total'))
      anchors%force_per_metre = values
      if (problems%count > before) return
      given%area = share*anchors%area
      given%length = anchors%length/share
      given%anchor_force = share*anchors%force_per_metre
      do i = 1, size(given)
         call check_tie('tie '//to_text(i), given(i), sections, edge, problems)
         if (problems%count > before) cycle
         ties(i) = new_tie(given(i), hinge, edge)
      end do
   end subroutine read_corner_ties

   !> Read bars and plates
   subroutine read_anchors(input, problems, anchors)
      !> Settings of the wall
      class(settings_type), intent(in) :: input
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> Their section is 0 where something is wrong
      type(anchor_type), allocatable, intent(out) :: anchors(:)

      character(len=*), parameter :: names(9) = [character(len=19) :: 'tie_area', 'tie_bar', 'tie_spacing', 'tie_plate_width', &
         & 'tie_plate_height', 'tie_plate_diameter', 'tie_plate_thickness', 'tie_leaf', 'tie_compression']
      real(wp), parameter :: pi = acos(-1.0_wp)
      real(wp), allocatable :: values(:), table(:, :)
      integer :: i

      allocate (table(size(input%list('tie_height')), size(names)), anchors(size(input%list('tie_height'))))
      do i = 1, size(names)
         call take(input, problems, trim(names(i)), 'tie_height', values, input%absent(trim(names(i))))
         table(:, i) = values
      end do
      anchors%area = table(:, 1)
      anchors%bar = table(:, 2)
      anchors%spacing = table(:, 3)
      anchors%width = table(:, 4)
      anchors%height = table(:, 5)
      anchors%diameter = table(:, 6)
      anchors%thickness = table(:, 7)
      anchors%leaf = table(:, 8)
      anchors%compression = table(:, 9)
      if (.not. all(anchors%area + anchors%bar + anchors%spacing > 0.0_wp)) call problems%note( &
         & 'tie_area: must be given with tie_height, or tie_bar and tie_spacing', not_given, 'tie_area')
      do i = 1, size(anchors)
         call check_bar('tie '//to_text(i), anchors(i), problems)
         call check_plate('tie '//to_text(i), anchors(i), problems)
         if (anchors(i)%bar > 0.0_wp .and. anchors(i)%spacing > 0.0_wp) anchors(i)%area = &
            & 0.25_wp*pi*anchors(i)%bar**2/anchors(i)%spacing
      end do
   end subroutine read_anchors

   !> Check that a bar is given once
   subroutine check_bar(name, anchor, problems)
      !> What it is called in messages
      character(len=*), intent(in) :: name
      type(anchor_type), intent(in) :: anchor
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems

      if (anchor%area > 0.0_wp .and. anchor%bar > 0.0_wp) then
         call problems%note('tie_area: '//name//' has a tie_bar, give either tie_area or tie_bar and tie_spacing', &
            & not_together, 'tie_area')
      else if (anchor%bar > 0.0_wp .neqv. anchor%spacing > 0.0_wp) then
         call problems%note(trim(merge('tie_spacing', 'tie_bar    ', anchor%bar > 0.0_wp))//': must be given for '//name// &
            & ' with '//trim(merge('tie_bar    ', 'tie_spacing', anchor%bar > 0.0_wp)), &
            & not_given, trim(merge('tie_spacing', 'tie_bar    ', anchor%bar > 0.0_wp)))
      end if
   end subroutine check_bar

   !> Check that a plate is described, and that it is larger than the bar
   subroutine check_plate(name, anchor, problems)
      !> What its tie is called in messages
      character(len=*), intent(in) :: name
      type(anchor_type), intent(in) :: anchor
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems

      real(wp) :: size

      if (anchor%width > 0.0_wp .neqv. anchor%height > 0.0_wp) call problems%note(trim(merge('tie_plate_height', &
         & 'tie_plate_width ', anchor%width > 0.0_wp))//': must be given for '//name//' with '// &
         & trim(merge('tie_plate_width ', 'tie_plate_height', anchor%width > 0.0_wp)), &
         & not_given, trim(merge('tie_plate_height',  'tie_plate_width ', anchor%width > 0.0_wp)))
      if (anchor%width > 0.0_wp .and. anchor%diameter > 0.0_wp) call problems%note('tie_plate_diameter: '//name// &
         & ' has a tie_plate_width, give either a width and a height or a diameter', not_together, 'tie_plate_diameter')
      if (anchor%has_plate() .neqv. anchor%thickness > 0.0_wp) call problems%note(trim(merge('tie_plate_thickness', &
         & 'tie_plate_width    ', anchor%has_plate()))//': must be given for '//name//' with its plate', &
         & not_given, trim(merge('tie_plate_thickness',  'tie_plate_width    ', anchor%has_plate())))
      if (.not. anchor%has_plate()) then
         if (anchor%leaf > 0.0_wp) call problems%note('tie_leaf: only with a plate, which '//name//' does not have', &
            & not_together, 'tie_leaf')
         if (anchor%compression > 0.0_wp) call problems%note('tie_compression: only with a plate, which '//name// &
            & ' does not have', not_together, 'tie_compression')
         return
      end if
      if (.not. anchor%bar > 0.0_wp) call problems%note('tie_bar: must be given for '//name//' with its plate, and tie_spacing', &
         & not_given, 'tie_bar')
      size = merge(anchor%diameter, min(anchor%width, anchor%height), anchor%diameter > 0.0_wp)
      if (.not. anchor%bar < size .and. size > 0.0_wp) call problems%note('tie_bar = '//to_text(anchor%bar)// &
         & ': must be less than the plate of '//name//', '//to_text(size)//' m', out_of_range, 'tie_bar')
      if (anchor%spacing > 0.0_wp .and. .not. max(anchor%width, anchor%diameter) < anchor%spacing) call problems%note( &
         & 'tie_spacing = '//to_text(anchor%spacing)//': must be more than the plate of '//name//' is wide, '// &
         & to_text(max(anchor%width, anchor%diameter))//' m', out_of_range, 'tie_spacing')
   end subroutine check_plate

   !> Compute the strength of anchors from their plates and the masonry
   subroutine compute_anchors(input, sections, ties, problems, anchors)
      !> Settings of the wall
      class(settings_type), intent(in) :: input
      !> Its storeys
      type(section_type), intent(in) :: sections(:)
      !> The ties; out: with the force of anchors that have a plate
      type(tie_input_type), intent(inout) :: ties(:)
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      type(anchor_type), intent(inout) :: anchors(:)

      type(masonry_type) :: masonry
      integer :: i, before

      before = problems%count
      call read_masonry(input, any(anchors%has_plate()), problems, masonry)
      do i = 1, size(anchors)
         associate (tie => ties(i), anchor => anchors(i))
            if (.not. anchor%has_plate()) then
               anchor%force_per_metre = tie%anchor_force
               cycle
            end if
            if (tie%anchor_force < huge(1.0_wp)) call problems%note('tie_anchor_force: tie '//to_text(i)// &
               & ' has a plate, give either tie_anchor_force or tie_plate_width and the others of its plate', &
               & not_together, 'tie_anchor_force')
            call place_plate('tie '//to_text(i), sections, tie%height, problems, anchor)
            if (problems%count > before) cycle
            anchor%masonry = masonry
            call compute_anchor(anchor)
            tie%anchor_force = anchor%force_per_metre
         end associate
      end do
   end subroutine compute_anchors

   !> The masonry that a plate bears on, and what is above it
   subroutine place_plate(name, sections, height, problems, anchor)
      !> What its tie is called in messages
      character(len=*), intent(in) :: name
      !> Storeys of the wall
      type(section_type), intent(in) :: sections(:)
      !> Height of the tie [m]
      real(wp), intent(in) :: height
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      type(anchor_type), intent(inout) :: anchor

      real(wp) :: half, behind, slack

      half = 0.5_wp*max(anchor%height, anchor%diameter)
      slack = same*sum(sections%height)
      anchor%edge = sum(sections%height) - height - half
      if (anchor%edge < -slack .or. height - half < -slack) call problems%note(name//': its tie_height = '//to_text(height)// &
         & ' must be at least '//rounded(half)//' m, half its plate, from the base and from the top of the wall', &
         & out_of_range, 'tie_height')
      behind = least_thickness(sections, height - half, height + half)
      ! The frustum spreads by its depth on all sides: of a thinner storey that it would reach, only that thickness is certain
      if (.not. anchor%leaf > 0.0_wp) anchor%leaf = least_thickness(sections, height - half - behind, height + half + behind)
      if (anchor%leaf > behind*(1.0_wp + same)) call problems%note(name//': its tie_leaf = '//to_text(anchor%leaf)// &
         & ' must be at most '//rounded(behind)//' m, the thickness of the wall there', out_of_range, 'tie_leaf')
   end subroutine place_plate

   !> The thickness of the thinnest storey between two heights; of one that they only touch, nothing counts
   pure real(wp) function least_thickness(sections, from, to) result(thickness)
      !> Storeys of the wall
      type(section_type), intent(in) :: sections(:)
      !> The two heights above the base [m]
      real(wp), intent(in) :: from, to

      real(wp) :: bottom, slack
      integer :: i

      slack = same*sum(sections%height)
      thickness = huge(1.0_wp)
      bottom = 0.0_wp
      do i = 1, size(sections)
         if (to > bottom + slack .and. from < bottom + sections(i)%height - slack) then
            thickness = min(thickness, sections(i)%thickness)
         end if
         bottom = bottom + sections(i)%height
      end do
   end function least_thickness

   !> Strengths of the masonry at anchors
   subroutine read_masonry(input, has_plates, problems, masonry)
      !> Settings of the wall
      class(settings_type), intent(in) :: input
      !> Is there a plate?
      logical, intent(in) :: has_plates
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      type(masonry_type), intent(out) :: masonry

      character(len=*), parameter :: names(6) = [character(len=24) :: 'masonry_shear', 'masonry_tension', 'masonry_compression', &
         & 'masonry_friction', 'masonry_knowledge_factor', 'bearing_factor']
      integer :: i

      do i = 1, size(names)
         if (input%has(trim(names(i))) .and. .not. has_plates) call problems%note(trim(names(i))// &
            & ': only with the plates of ties, tie_plate_width and the others', not_together, trim(names(i)))
      end do
      if (.not. has_plates) return
      do i = 1, 2
         if (.not. input%has(trim(names(i)))) call problems%note(trim(names(i))//': must be given with the plates of ties', &
            & not_given, trim(names(i)))
      end do
      if (input%has('masonry_compression')) then
         masonry%compression = input%number('masonry_compression')
      else if (input%has('compressive_strength')) then
         masonry%compression = input%number('compressive_strength')
      else
         call problems%note('masonry_compression: must be given with the plates of ties, or compressive_strength', &
            & not_given, 'masonry_compression')
      end if
      masonry%shear = input%number('masonry_shear')
      masonry%tension = input%number('masonry_tension')
      if (input%has('masonry_friction')) masonry%friction = input%number('masonry_friction')
      if (input%has('masonry_knowledge_factor')) masonry%knowledge_factor = input%number('masonry_knowledge_factor')
      if (input%has('bearing_factor')) masonry%bearing_factor = input%number('bearing_factor')
      if (any(input%list('tie_compression') > 0.0_wp) .neqv. masonry%friction > 0.0_wp) call problems%note( &
         & 'masonry_friction: goes with tie_compression, the stress that presses the masonry there', &
         & not_together, 'masonry_friction')
   end subroutine read_masonry

   !> Check one tie
   subroutine check_tie(name, tie, sections, edge, problems)
      !> What it is called in messages
      character(len=*), intent(in) :: name
      type(tie_input_type), intent(in) :: tie
      !> Storeys of the wall
      type(section_type), intent(in) :: sections(:)
      !> Radius of the edge [m]
      real(wp), intent(in) :: edge
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems

      real(wp) :: faces(2), tall

      tall = sum(sections%height)
      faces = faces_at(sections, tie%height)
      if (.not. tie%height > edge + same*tall .or. faces(1) > faces(2)) then
         call problems%note(name//': its tie_height = '//to_text(tie%height)//' must be above the hinge, '//to_text(edge)// &
            & ' m, and at most '//rounded(tall)//' m, the top of the wall'//trim(unit_question('m', tie%height, edge, tall, &
            & tall)), out_of_range, 'tie_height')
      else if (tie%depth < faces(1) - outside - same*tall .or. tie%depth > faces(2) + same*tall) then
         call problems%note(name//': its tie_depth = '//to_text(tie%depth)//' must lie between '// &
            & rounded(faces(1) - outside)//' and '//rounded(faces(2))//' m, the faces of the wall at its height and 0.1 m '// &
            & 'outside for a plate'//trim(unit_question('m', tie%depth, 0.0_wp, faces(2), 0.5_wp*faces(2))), &
            & out_of_range, 'tie_depth')
      end if
      ! A strength or a modulus that is not positive has an error of its own
      if (.not. tie%preload < tie%strength .and. tie%strength > 0.0_wp) then
         call problems%note(name//': its tie_preload = '//to_text(tie%preload)//' must be less than its tie_strength = '// &
            & to_text(tie%strength)//' Pa, at which it yields', out_of_range, 'tie_preload')
      else if (.not. tie%preload*tie%area < tie%anchor_force) then
         call problems%note(name//': its tie_preload = '//to_text(tie%preload)//' must be less than '// &
            & rounded(tie%anchor_force/tie%area)//' Pa, at which its anchor gives way', out_of_range, 'tie_preload')
      end if
      if (.not. tie%modulus > 0.0_wp) return
      if (.not. tie%strain > tie%strength/tie%modulus) call problems%note(name//': its tie_strain = '// &
         & to_text(tie%strain)//' must be more than '//rounded(tie%strength/tie%modulus)//', at which it yields', &
         & out_of_range, 'tie_strain')
   end subroutine check_tie

end module dondolo_wall_ties
