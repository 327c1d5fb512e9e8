!> Walls above a hinge that is not at their base: the part of a facade that turns out while what is below it stays.
!>
!> It is a wall like any other: sections, loads, thrusts, springs and ties above the hinge, heights measured from it,
!> depths from the outer face there, and the floor of the building at its level (docs/theory.md, section 2).
module dondolo_wall_hinge_level
   use dondolo_base_error, only : not_together, out_of_range, problems_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : is_list, is_words, number_of_words, property_type, word_of
   use dondolo_base_text, only : rounded, to_text
   use dondolo_wall_elevation, only : top_of_elevation
   use dondolo_wall_properties, only : is_of_building, wall_input_type
   implicit none
   private

   public :: has_hinge_level, read_hinge_levels, cut_wall

   !> What asks for a hinge at the bottom of every section
   character(len=*), parameter :: storeys = 'storeys'

   !> Heights that differ by this part of the wall are the same
   real(wp), parameter :: same = 1.0e-9_wp

contains

   !> Is a hinge asked for, at the base or above?
   pure logical function has_hinge_level(input)
      !> Input of the wall
      class(wall_input_type), intent(in) :: input

      has_hinge_level = input%has('hinge_level') .or. input%has('hinge_at')
   end function has_hinge_level

   !> Heights of the hinges that are asked for
   subroutine read_hinge_levels(input, problems, levels)
      !> Input of the wall, ranges checked
      class(wall_input_type), intent(in) :: input
      !> Takes levels that the wall does not have
      type(problems_type), intent(inout) :: problems
      !> Heights above the base [m], increasing
      real(wp), allocatable, intent(out) :: levels(:)

      real(wp), allocatable :: heights(:)
      real(wp) :: tall
      integer :: i

      heights = input%list('section_height')
      ! Of an elevation the height may not be set yet
      if (size(heights) == 0) heights = [max(input%number('height'), top_of_elevation(input))]
      tall = sum(heights)
      if (.not. input%has('hinge_at')) then
         levels = input%list('hinge_level')
      else
         levels = [(sum(heights(:i)), i=0, size(heights) - 1)]
         if (input%has('hinge_level')) call problems%note('hinge_at: give either hinge_at or hinge_level', not_together, 'hinge_at')
         if (input%word('hinge_at') /= storeys) call problems%note('hinge_at: must be '//storeys, out_of_range, 'hinge_at')
         if (.not. input%has('section_height')) call problems%note('hinge_at = '''//input%word('hinge_at')// &
            & ''': only with section_height, the heights of the storeys', not_together, 'hinge_at')
      end if
      do i = 1, size(levels)
         if (.not. levels(i) < tall*(1.0_wp - same)) call problems%note('hinge_level = '//to_text(levels(i))// &
            & ': must be less than the height of the wall, '//rounded(tall)//' m', out_of_range, 'hinge_level')
         if (i == 1) cycle
         if (.not. levels(i) > levels(i - 1)) call problems%note('hinge_level = '//to_text(levels(i))// &
            & ': must be more than '//to_text(levels(i - 1))//' before it', out_of_range, 'hinge_level')
      end do
   end subroutine read_hinge_levels

   !> The wall above a hinge
   subroutine cut_wall(input, level, problems)
      !> Input of the whole wall, checked; out: of what is above the hinge
      class(wall_input_type), intent(inout) :: input
      !> Height of the hinge above the base, less than that of the wall [m]
      real(wp), intent(in) :: level
      !> Takes what cannot be cut
      type(problems_type), intent(inout) :: problems

      real(wp) :: face
      logical :: has_plates

      has_plates = gives_plates(input)
      call input%clear('hinge_level')
      call input%clear('hinge_at')
      if (.not. level > 0.0_wp) return
      if (input%gives(is_of_building)) then
         if (input%has('participation')) call problems%note('participation: not with hinge_level = '//to_text(level)// &
            & ', give storeys, level and building_height, from which every hinge takes its own', not_together, 'participation')
         call input%set('level', input%number('level') + level)
         ! A part above level_top leans on no support
         if (input%has('level_top')) call input%set('level_top', max(input%number('level_top'), input%number('level')))
      else
         call input%set('base_level', input%number('base_level') + level)
      end if
      if (problems%count > 0) return
      call cut_sections(input, level, face)
      call keep_above(input, level, face, 'load')
      call keep_above(input, level, face, 'inertia')
      call keep_above(input, level, face, 'thrust')
      call keep_above(input, level, face, 'spring')
      call keep_above(input, level, face, 'tie')
      if (has_plates .and. .not. gives_plates(input)) call forget_masonry(input)
      call cut_beds(input, level, face)
      call cut_wedges(input, level)
   end subroutine cut_wall

   !> The storeys above a hinge
   subroutine cut_sections(input, level, face)
      !> Input of the wall
      class(wall_input_type), intent(inout) :: input
      !> Height of the hinge [m]
      real(wp), intent(in) :: level
      !> Depth of the outer face there behind that of the base [m]
      real(wp), intent(out) :: face

      real(wp), allocatable :: heights(:), base(:), top(:), offset(:)
      logical, allocatable :: above(:)
      real(wp) :: below
      integer :: first

      face = 0.0_wp
      heights = input%list('section_height')
      if (size(heights) == 0) then
         call input%set('height', input%number('height') - level)
         call cut_elevation(input, level)
         return
      end if
      below = 0.0_wp
      do first = 1, size(heights) - 1
         if (below + heights(first) > level + same*sum(heights)) exit
         below = below + heights(first)
      end do
      above = spread(.true., 1, size(heights))
      above(:first - 1) = .false.
      ! They follow from the sections
      call input%clear('height')
      call input%clear('thickness')
      offset = of_each(input%list('section_offset'), size(heights))
      if (size(offset) > 0) then
         face = offset(first)
         call input%set('section_offset', pack(offset - face, above))
      end if
      base = of_each(input%list('section_base_width'), size(heights))
      top = of_each(input%list('section_top_width'), size(heights))
      if (level > below + same*sum(heights)) then
         if (size(top) > 0) then
            if (size(base) == 0) base = spread(1.0_wp, 1, size(heights))
            base(first) = base(first) + (top(first) - base(first))*(level - below)/heights(first)
         end if
         heights(first) = below + heights(first) - level
      end if
      call input%set('section_height', pack(heights, above))
      if (size(base) > 0) call input%set('section_base_width', pack(base, above))
      if (size(top) > 0) call input%set('section_top_width', pack(top, above))
      call choose(input, 'section_thickness', above)
      call choose(input, 'section_fill', above)
   end subroutine cut_sections

   !> The elevation as a hinge has it: reading leaves out what is below
   subroutine cut_elevation(input, level)
      !> Input of the wall
      class(wall_input_type), intent(inout) :: input
      !> Height of the hinge [m]
      real(wp), intent(in) :: level

      if (.not. input%has('elevation_z')) return
      call input%set('elevation_z', input%list('elevation_z') - level)
      if (input%has('opening_z')) call input%set('opening_z', of_each(input%list('opening_z') - level, &
         & size(input%list('opening_x'))))
      ! It follows from the highest corner
      call input%clear('height')
   end subroutine cut_elevation

   !> Keep the actions of a kind that act above a hinge: their heights are from the hinge, their depths from the outer face there
   subroutine keep_above(input, level, face, kind)
      !> Input of the wall, whose actions have a height each
      class(wall_input_type), intent(inout) :: input
      !> Height of the hinge, and depth of the outer face there [m]
      real(wp), intent(in) :: level, face
      !> First word of the names of their properties: 'load', 'tie', ...
      character(len=*), intent(in) :: kind

      real(wp), allocatable :: heights(:), depths(:)

      heights = input%list(kind//'_height')
      if (size(heights) == 0) return
      depths = input%list(kind//'_depth')
      if (size(depths) > 0) call input%set(kind//'_depth', depths - face)
      call input%set(kind//'_height', heights - level)
      ! At the hinge itself nothing has a lever
      call choose_all(input, kind, heights > level*(1.0_wp + same))
   end subroutine keep_above

   !> Has a wall ties with plates?
   pure logical function gives_plates(input)
      class(wall_input_type), intent(in) :: input

      gives_plates = any([input%list('tie_plate_width'), input%list('tie_plate_diameter')] > 0.0_wp)
   end function gives_plates

   !> Leave out the strengths of the masonry at plates, of which none is left
   subroutine forget_masonry(input)
      !> Input of the wall, its ties cut
      class(wall_input_type), intent(inout) :: input

      type(property_type), pointer :: table(:)
      integer :: i

      call input%get_table(table)
      do i = 1, size(table)
         if (index(table(i)%name, 'masonry_') == 1 .or. table(i)%name == 'bearing_factor') call input%clear(trim(table(i)%name))
      end do
   end subroutine forget_masonry

   !> Leave only some actions of a kind: of each of their properties the values that belong to these. A property that the table
   !> gets in future is among them
   subroutine choose_all(input, kind, chosen)
      !> Input of the wall
      class(wall_input_type), intent(inout) :: input
      !> First word of the names of their properties
      character(len=*), intent(in) :: kind
      !> Which of them stay
      logical, intent(in) :: chosen(:)

      type(property_type), pointer :: table(:)
      integer :: i

      call input%get_table(table)
      do i = 1, size(table)
         if (index(trim(table(i)%name)//'_', kind//'_') /= 1) cycle
         if (table(i)%kind == is_list) call choose(input, trim(table(i)%name), chosen)
         if (table(i)%kind == is_words) call choose_words(input, trim(table(i)%name), chosen)
      end do
   end subroutine choose_all

   !> Leave only some words of a list of choices; one that is that of all stays unless nothing is left
   subroutine choose_words(input, name, chosen)
      !> Input of the wall
      class(wall_input_type), intent(inout) :: input
      !> Name of the list
      character(len=*), intent(in) :: name
      !> Which actions stay
      logical, intent(in) :: chosen(:)

      character(len=:), allocatable :: words, left
      integer :: i

      words = input%word(name)
      if (.not. any(chosen)) call input%clear(name)
      if (.not. any(chosen) .or. number_of_words(words) < 2) return
      left = ''
      do i = 1, size(chosen)
         if (chosen(i)) left = left//','//trim(word_of(words, i))
      end do
      call input%set(name, left(2:))
   end subroutine choose_words

   !> The parts of distributed springs above a hinge
   subroutine cut_beds(input, level, face)
      !> Input of the wall
      class(wall_input_type), intent(inout) :: input
      !> Height of the hinge, and depth of the outer face there [m]
      real(wp), intent(in) :: level, face

      real(wp), allocatable :: bottom(:), top(:), depth(:)
      logical, allocatable :: above(:)
      integer :: number

      number = size(input%list('distributed_spring'))
      if (number == 0) return
      bottom = of_each(input%list('distributed_spring_bottom'), number)
      top = of_each(input%list('distributed_spring_top'), number)
      depth = of_each(input%list('distributed_spring_depth'), number)
      above = top > level*(1.0_wp + same)
      call input%set('distributed_spring_bottom', max(bottom, level) - level)
      call input%set('distributed_spring_top', top - level)
      call input%set('distributed_spring_depth', depth - face)
      call choose_all(input, 'distributed_spring', above)
   end subroutine cut_beds

   !> The wedges of transverse walls above a hinge: their cracks begin at the hinge, or above it
   subroutine cut_wedges(input, level)
      !> Input of the wall
      class(wall_input_type), intent(inout) :: input
      !> Height of the hinge [m]
      real(wp), intent(in) :: level

      real(wp), allocatable :: bottom(:), top(:)
      logical, allocatable :: above(:)
      integer :: number

      number = size(input%list('wedge_thickness'))
      if (number == 0) return
      bottom = of_each(input%list('wedge_bottom'), number)
      top = of_each(input%list('wedge_top'), number)
      above = top > level*(1.0_wp + same)
      call input%set('wedge_bottom', max(bottom, level) - level)
      call input%set('wedge_top', top - level)
      call choose_all(input, 'wedge', above)
      if (.not. (any(above) .or. input%has('elevation_x'))) call input%clear('facade_length')
   end subroutine cut_wedges

   !> Values of a list for each of several things: as given, or one for all
   pure function of_each(given, number) result(values)
      !> As many as things, one, or none
      real(wp), intent(in) :: given(:)
      !> Number of things
      integer, intent(in) :: number
      !> As many as things, or none
      real(wp), allocatable :: values(:)

      values = given
      if (size(given) == 1) values = spread(given(1), 1, number)
   end function of_each

   !> Leave only some values of a list; one that stands for all stays unless nothing is left
   subroutine choose(input, name, chosen)
      !> Input of the wall
      class(wall_input_type), intent(inout) :: input
      !> Name of the list
      character(len=*), intent(in) :: name
      !> Which things stay
      logical, intent(in) :: chosen(:)

      real(wp), allocatable :: values(:)

      if (.not. input%has(name)) return
      values = input%list(name)
      if (.not. any(chosen)) then
         call input%clear(name)
      else if (size(values) == size(chosen)) then
         call input%set(name, pack(values, chosen))
      end if
   end subroutine choose

end module dondolo_wall_hinge_level
