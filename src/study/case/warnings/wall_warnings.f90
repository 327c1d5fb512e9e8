!> Warnings of the values of walls: those that no masonry has, or that do not go together. Such input is correct, but most likely
!> a slip.
module dondolo_case_wall_warnings
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : find_property, hint_of, property_type
   use dondolo_base_text, only : rounded, to_text
   use dondolo_base_warning, only : warning_type, warnings_type
   use dondolo_case_chain_warnings, only : chain_warnings_type
   use dondolo_case_elastic_warnings, only : elastic_warnings_type
   use dondolo_record, only : record_type
   use dondolo_wall, only : wall_type
   use dondolo_wall_gravity, only : gravity_property
   use dondolo_wall_properties, only : wall_properties
   use dondolo_wall_rigid_body, only : same
   use dondolo_wall_strip_bending, only : bends_before_opening, median_reduction, shown_periods
   use dondolo_wall_two_block_model, only : two_block_model_type
   implicit none
   private

   public :: wall_warnings_type

   !> Codes
   character(len=*), parameter :: value_below_usual = 'value_below_usual', value_above_usual = 'value_above_usual', &
      & height_below_thickness = 'height_below_thickness', load_place_without_load = 'load_place_without_load', &
      & overlap_above_thickness = 'overlap_above_thickness', bending_neglected = 'bending_neglected', &
      & opening_above_usual = 'opening_above_usual', lifted_while_closed = 'lifted_while_closed', &
      & floor_without_period = 'floor_without_period', mass_beside_size = 'mass_beside_size', &
      & restitution_of_solid = 'restitution_of_solid'

   !> Opening of joints / capacity above which a strip is bent rather than rocking
   real(wp), parameter :: usual_opening = 0.1_wp
   !> Period of the first mode of a house that is not listed with its second one / period of that
   real(wp), parameter :: second_mode = 3.0_wp
   !> A mass that is given belongs to a body of any shape: over height times thickness it may exceed the usual density, or fall
   !> short of it, by this factor. Tonnes, quintals and kilonewtons in place of kilograms differ by more
   real(wp), parameter :: any_shape = 10.0_wp

   !> Places after the properties: the gravity of a wall, and values that do not go together
   integer, parameter :: gravity = size(wall_properties) + 1, pairs = size(wall_properties) + 2
   !> How many pairs of values are compared, strips that bend among them: without a period; with one those that open late, that
   !> lift a mass, and that are on a building of one mode. Last: a mass beside the size of the wall, and storeys with different
   !> shares of masonry beside the restitution of a solid block
   integer, parameter :: n_pairs = 9, strips = 4, late = 5, lifting = 6, alone = 7, heavy = 8, filled = 9

   !> Walls with the same warning
   type :: odd_walls_type
      !> How many there are
      integer :: number = 0
      !> Name and value of the first of them
      character(len=:), allocatable :: name
      real(wp) :: value = 0.0_wp
   end type odd_walls_type

   !> Walls looked at, and what to warn of
   type :: wall_warnings_type
      private
      !> Walls looked at
      integer :: walls = 0
      !> Those with values of each property, and gravities, that are less than usual (1) and more (2). At `pairs` those that are
      !> thicker than high (1), have the place of a load without a load (2), have stones that overlap by more than the wall is
      !> thick (3), bend before they rock (4), with their frequency parameter, and of those with a period: open late (5), with
      !> opening / capacity, lift a mass (6), and are on a building of one mode (7), with its period; and have a mass that does not
      !> go with their size (8), with the density that it means; and have the restitution of a solid block though their storeys have
      !> different shares of masonry (9), with what it is with these. Not allocated: there are none
      type(odd_walls_type), allocatable :: odd(:, :)
      !> Strips with a period, beside their records and damage states
      type(elastic_warnings_type) :: elastic
      !> Chains
      type(chain_warnings_type) :: chains
   contains
      !> Look at a wall
      procedure :: look
      !> Warn, if there is reason to
      procedure :: warn
   end type wall_warnings_type

contains

   !> Look at the values of a wall, or of one of its mechanisms
   subroutine look(self, wall)
      class(wall_warnings_type), intent(inout) :: self
      type(wall_type), intent(in) :: wall

      real(wp) :: low, high
      logical :: outside(n_pairs), bears
      real(wp) :: values(n_pairs)
      integer :: i, density

      density = find_property(wall_properties, 'density')
      self%walls = self%walls + 1
      call self%elastic%look(wall)
      call self%chains%look(wall)
      outside = .false.
      values = 0.0_wp
      do i = 1, size(wall_properties)
         ! No overburden is no mistake: the least positive value
         call wall%input%find_range(i, low, high)
         if (.not. high > 0.0_wp) cycle
         if (i == density .and. wall%input%has('mass')) then
            associate (usual => wall_properties(i))
               values(heavy) = low
               outside(heavy) = low < usual%usual_least/any_shape .or. low > usual%usual_most*any_shape
            end associate
            cycle
         end if
         associate (property => wall_properties(i))
            call note(self, wall, i, [low < property%usual_least], [low])
            call note(self, wall, i, [.false., high > property%usual_most], [low, high])
         end associate
      end do
      associate (pull => wall%gravity, usual => gravity_property)
         call note(self, wall, gravity, [pull < usual%usual_least, pull > usual%usual_most], &
            & [pull, pull])
      end associate
      bears = .false.
      select type (model => wall%model)
      type is (two_block_model_type)
         bears = model%bears
         call look_at_strip(wall, outside(strips:alone), values(strips:alone))
      end select
      associate (input => wall%input)
         outside(1) = input%number('height') < input%number('thickness')
         outside(2) = (bears .or. abs(input%number('eccentricity')) > 0.0_wp) &
            & .and. .not. input%number('overburden') > 0.0_wp
         outside(3) = input%number('interlock_overlap') > thickest(wall)*(1.0_wp + same)
         if (allocated(wall%impacts%sorrentino) .and. allocated(wall%impacts%impulse) .and. size(input%list('section_fill')) > 1 &
            & .and. input%word('mechanism') == 'one_sided' .and. input%word('restitution') /= 'impulse') then
            values(filled) = wall%impacts%impulse
            outside(filled) = maxval(input%list('section_fill')) > minval(input%list('section_fill')) &
               & .and. .not. input%has('restitution_value')
         end if
         call note(self, wall, pairs, outside, values)
      end associate
   end subroutine look

   !> Look at a strip: does it bend before it rocks?
   subroutine look_at_strip(wall, outside, values)
      type(wall_type), intent(in) :: wall
      !> What to note, and a value of each
      logical, intent(inout) :: outside(strips:alone)
      real(wp), intent(inout) :: values(strips:alone)

      associate (input => wall%input, joint => wall%mechanism%joint)
         if (.not. joint%exists) then
            values(strips) = wall%mechanism%frequency_parameter()
            outside(strips) = bends_before_opening(input%number('height'), input%number('thickness'), input%number('density'), &
               & input%number('overburden'), wall%gravity, values(strips))
            return
         end if
         values(late) = joint%opening/wall%mechanism%capacity
         outside(late) = values(late) > usual_opening
         outside(lifting) = input%number('overburden')*input%number('overburden_inertia') > 0.0_wp
         if (.not. allocated(wall%building)) return
         if (size(wall%building%period) > 1) return
         values(alone) = wall%building%period(1)
         outside(alone) = values(alone) > joint%period
      end associate
   end subroutine look_at_strip

   !> Thickness of a wall, of storeys the largest [m]
   pure real(wp) function thickest(wall)
      type(wall_type), intent(in) :: wall

      thickest = wall%input%number('thickness')
      if (wall%input%has('section_thickness')) thickest = maxval(wall%input%list('section_thickness'))
   end function thickest

   !> Note a wall
   subroutine note(self, wall, i, outside, values)
      class(wall_warnings_type), intent(inout) :: self
      type(wall_type), intent(in) :: wall
      !> Number of a property, `gravity` or `pairs`
      integer, intent(in) :: i
      !> What to note
      logical, intent(in) :: outside(:)
      !> A value of the wall for each
      real(wp), intent(in) :: values(:)

      integer :: k

      do k = 1, size(outside)
         if (.not. outside(k)) cycle
         if (.not. allocated(self%odd)) allocate (self%odd(n_pairs, pairs))
         associate (odd => self%odd(k, i))
            odd%number = odd%number + 1
            if (odd%number > 1) cycle
            odd%name = wall%name()
            odd%value = values(k)
         end associate
      end do
   end subroutine note

   !> Warn, if there is reason to
   subroutine warn(self, warnings, records, thresholds)
      class(wall_warnings_type), intent(in) :: self
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings
      !> Accelerograms under which the walls are looked at; absent: none
      type(record_type), intent(in), optional :: records(:)
      !> EDP thresholds; absent: none
      real(wp), intent(in), optional :: thresholds(:)

      integer :: i

      if (present(records)) call self%elastic%warn_of_records(records, warnings)
      if (present(thresholds)) call self%elastic%warn_of_thresholds(thresholds, warnings)
      call self%chains%warn(self%walls, warnings)
      if (.not. allocated(self%odd)) return
      do i = 1, size(wall_properties)
         call warn_of_value(self, i, wall_properties(i), warnings)
      end do
      call warn_of_value(self, gravity, gravity_property, warnings)
      call warn_of_pair(self, 1, height_below_thickness, 'the height is less than the thickness: are they swapped?', warnings)
      call warn_of_pair(self, 2, load_place_without_load, 'a bearing or an eccentricity without overburden changes nothing: '// &
         & 'is the overburden missing?', warnings)
      call warn_of_pair(self, 3, overlap_above_thickness, 'interlock_overlap is more than the thickness of the wall: is it '// &
         & 'the length of a stone?', warnings)
      call warn_of_mass(self, warnings)
      associate (odd => self%odd(filled, pairs))
         call warn_of_pair(self, filled, restitution_of_solid, 'the restitution e is that of a solid block, though '// &
            & 'section_fill differs between its storeys; restitution = ''impulse'' has the masses where they are, e = '// &
            & rounded(odd%value), warnings, 'impulse')
      end associate
      call warn_of_bending(self, warnings)
      call warn_of_joints(self, warnings)
      call warn_of_pair(self, lifting, lifted_while_closed, 'the mass of its overburden is not lifted while the joints are '// &
         & 'closed, but counts there too: medians are 3 % too low to 6 % too high', warnings)
      call warn_of_alone(self, warnings)
   end subroutine warn

   !> Warn of a value that no masonry has: the table of properties asks what may have happened
   subroutine warn_of_value(self, i, property, warnings)
      class(wall_warnings_type), intent(in) :: self
      !> Place of the property
      integer, intent(in) :: i
      type(property_type), intent(in) :: property
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning
      character(len=:), allocatable :: unit, text, hint
      real(wp) :: limit
      integer :: k

      unit = trim(' '//property%unit)
      do k = 1, 2
         associate (odd => self%odd(k, i))
            if (odd%number == 0) cycle
            limit = merge(property%usual_least, property%usual_most, k == 1)
            text = trim(property%name)//' = '//rounded(odd%value)//unit
            warning = begun(merge(value_below_usual, value_above_usual, k == 1), odd)
            text = text//' is '//merge('less', 'more', k == 1)//' than '//to_text(limit)//unit
            hint = trim(hint_of(property, odd%value))
            if (len(hint) > 0) text = text//': '//hint
            call warning%about('variable', trim(property%name))
            call warning%about('unit', trim(property%unit))
            call warning%with('value', odd%value)
            call warning%with('limit', limit)
            call add(self, odd, warning, text, warnings)
         end associate
      end do
   end subroutine warn_of_value

   !> Warn of two values that do not go together
   subroutine warn_of_pair(self, k, code, text, warnings, value)
      class(wall_warnings_type), intent(in) :: self
      !> Place of the pair
      integer, intent(in) :: k
      !> Code of the warning, and its sentence without the wall
      character(len=*), intent(in) :: code, text
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings
      !> What the value of the wall is; absent: it has none
      character(len=*), intent(in), optional :: value

      type(warning_type) :: warning

      associate (odd => self%odd(k, pairs))
         if (odd%number == 0) return
         warning = begun(code, odd)
         if (present(value)) call warning%with(value, odd%value)
         call add(self, odd, warning, text, warnings)
      end associate
   end subroutine warn_of_pair

   !> Warn of a mass that does not go with the size of its wall
   subroutine warn_of_mass(self, warnings)
      class(wall_warnings_type), intent(in) :: self
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning
      character(len=:), allocatable :: text
      real(wp) :: limit

      associate (odd => self%odd(heavy, pairs), usual => wall_properties(find_property(wall_properties, 'density')))
         if (odd%number == 0) return
         if (odd%value < usual%usual_least) then
            limit = usual%usual_least/any_shape
            text = 'less than '
         else
            limit = usual%usual_most*any_shape
            text = 'more than '
         end if
         warning = begun(mass_beside_size, odd)
         call warning%with('density', odd%value)
         call warning%with('limit', limit)
         call add(self, odd, warning, 'its mass over height times thickness is '//rounded(odd%value)//' kg/m3, '//text// &
            & to_text(limit)//' kg/m3: is it in kg, and of the whole body?', warnings)
      end associate
   end subroutine warn_of_mass

   !> Warn of strips whose joints bend before they open, which the rigid blocks leave out
   subroutine warn_of_bending(self, warnings)
      class(wall_warnings_type), intent(in) :: self
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning
      real(wp) :: lower(size(shown_periods))

      associate (odd => self%odd(strips, pairs))
         if (odd%number == 0) return
         ! They are good to 4 %
         lower = anint(100.0_wp*median_reduction(odd%value*shown_periods))
         warning = begun(bending_neglected, odd)
         call warning%with('frequency_1_s', odd%value)
         call warning%with('lower_010', lower(1))
         call warning%with('lower_015', lower(2))
         call add(self, odd, warning, 'joints that bend before they open are neglected: strips like this open at about half of '// &
            & 'the trigger, and medians are 6 to 22 % lower at a period of 0.10 s, 7 to 37 % at 0.15 s (dead load); of this '// &
            & 'wall about '//to_text(nint(lower(1)))//' and '//to_text(nint(lower(2)))//' %, by 4 more or less; '// &
            & 'give elastic_period', warnings)
      end associate
   end subroutine warn_of_bending

   !> Warn of strips whose joints bend, where the model is at its limits
   subroutine warn_of_joints(self, warnings)
      class(wall_warnings_type), intent(in) :: self
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning

      associate (odd => self%odd(late, pairs))
         if (odd%number == 0) return
         warning = begun(opening_above_usual, odd)
         call warning%with('opening_edp', odd%value)
         call warning%with('limit', usual_opening)
         call add(self, odd, warning, 'its joints open at '//rounded(odd%value)//' of the capacity, more than '// &
            & to_text(usual_opening)//': it bends rather than rocks; is elastic_period too long?', warnings)
      end associate
   end subroutine warn_of_joints

   !> Warn of strips whose joints bend on a building of which one mode is given
   subroutine warn_of_alone(self, warnings)
      class(wall_warnings_type), intent(in) :: self
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning

      associate (odd => self%odd(alone, pairs))
         if (odd%number == 0) return
         warning = begun(floor_without_period, odd)
         call warning%with('building_period_s', odd%value)
         call warning%with('second_period_s', odd%value/second_mode)
         call add(self, odd, warning, 'floors of a building of one mode, '//rounded(odd%value)//' s, have no motion near '// &
            & 'elastic_period: list the second mode (about '//rounded(odd%value/second_mode)//' s)', warnings)
      end associate
   end subroutine warn_of_alone

   !> The warning of a code, about the first of some walls
   function begun(code, odd) result(warning)
      character(len=*), intent(in) :: code
      type(odd_walls_type), intent(in) :: odd
      type(warning_type) :: warning

      warning = warning_type(code)
      call warning%about('wall', odd%name)
   end function begun

   !> Add a warning of the first of some walls, and how many there are
   subroutine add(self, odd, warning, text, warnings)
      class(wall_warnings_type), intent(in) :: self
      type(odd_walls_type), intent(in) :: odd
      type(warning_type), intent(inout) :: warning
      !> What is wrong with the first wall
      character(len=*), intent(in) :: text
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      character(len=:), allocatable :: sentence

      call warning%with('walls_beyond', odd%number)
      call warning%with('walls', self%walls)
      sentence = 'wall '''//odd%name//''': '//text
      if (self%walls > 1) sentence = sentence//' ('//to_text(odd%number)//' of '//to_text(self%walls)//' in all)'
      call warnings%add(warning, sentence)
   end subroutine add

end module dondolo_case_wall_warnings
