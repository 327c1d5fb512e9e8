!> Warnings of the values of walls: those that no masonry has, or that do not go together. Such input is correct, but most likely
!> a slip.
module dondolo_case_wall_warnings
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : hint_of, property_type
   use dondolo_base_text, only : rounded, to_text
   use dondolo_base_warning, only : warning_type, warnings_type
   use dondolo_wall, only : wall_type
   use dondolo_wall_properties, only : gravity_property, wall_properties
   use dondolo_wall_rigid_body, only : same
   use dondolo_wall_two_block_model, only : two_block_model_type
   implicit none
   private

   public :: wall_warnings_type

   !> Codes
   character(len=*), parameter :: value_below_usual = 'value_below_usual', value_above_usual = 'value_above_usual', &
      & height_below_thickness = 'height_below_thickness', load_place_without_load = 'load_place_without_load', &
      & overlap_above_thickness = 'overlap_above_thickness'

   !> Places after the properties: the gravity of a wall, and values that do not go together
   integer, parameter :: gravity = size(wall_properties) + 1, pairs = size(wall_properties) + 2
   !> How many pairs of values are compared
   integer, parameter :: n_pairs = 3

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
      !> thicker than high (1), have the place of a load without a load (2), and have stones that overlap by more than the wall
      !> is thick (3). Not allocated: there are none
      type(odd_walls_type), allocatable :: odd(:, :)
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
      integer :: i

      self%walls = self%walls + 1
      do i = 1, size(wall_properties)
         ! No overburden is no mistake: the least positive value
         call wall%input%find_range(i, low, high)
         if (.not. high > 0.0_wp) cycle
         associate (property => wall_properties(i))
            call note(self, wall, i, [low < property%usual_least], low)
            call note(self, wall, i, [.false., high > property%usual_most], high)
         end associate
      end do
      associate (pull => wall%gravity, usual => gravity_property)
         call note(self, wall, gravity, [pull < usual%usual_least, pull > usual%usual_most], pull)
      end associate
      bears = .false.
      select type (model => wall%model)
      type is (two_block_model_type)
         bears = model%bears
      end select
      associate (input => wall%input)
         outside(1) = input%number('height') < input%number('thickness')
         outside(2) = (bears .or. abs(input%number('eccentricity')) > 0.0_wp) &
            & .and. .not. input%number('overburden') > 0.0_wp
         outside(3) = input%number('interlock_overlap') > thickest(wall)*(1.0_wp + same)
         call note(self, wall, pairs, outside, 0.0_wp)
      end associate
   end subroutine look

   !> Thickness of a wall, of storeys the largest [m]
   pure real(wp) function thickest(wall)
      type(wall_type), intent(in) :: wall

      thickest = wall%input%number('thickness')
      if (wall%input%has('section_thickness')) thickest = maxval(wall%input%list('section_thickness'))
   end function thickest

   !> Note a wall
   subroutine note(self, wall, i, outside, value)
      class(wall_warnings_type), intent(inout) :: self
      type(wall_type), intent(in) :: wall
      !> Number of a property, `gravity` or `pairs`
      integer, intent(in) :: i
      !> What to note
      logical, intent(in) :: outside(:)
      !> A value of the wall
      real(wp), intent(in) :: value

      integer :: k

      do k = 1, size(outside)
         if (.not. outside(k)) cycle
         if (.not. allocated(self%odd)) allocate (self%odd(n_pairs, pairs))
         associate (odd => self%odd(k, i))
            odd%number = odd%number + 1
            if (odd%number > 1) cycle
            odd%name = wall%name()
            odd%value = value
         end associate
      end do
   end subroutine note

   !> Warn, if there is reason to
   subroutine warn(self, warnings)
      class(wall_warnings_type), intent(in) :: self
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      integer :: i

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
            if (k == 1) then
               warning = warning_type(value_below_usual)
               text = text//' is less than '//to_text(limit)//unit
            else
               warning = warning_type(value_above_usual)
               text = text//' is more than '//to_text(limit)//unit
            end if
            hint = trim(hint_of(property, odd%value))
            if (len(hint) > 0) text = text//': '//hint
            call warning%about('wall', odd%name)
            call warning%about('variable', trim(property%name))
            call warning%about('unit', trim(property%unit))
            call warning%with('value', odd%value)
            call warning%with('limit', limit)
            call add(self, odd, warning, text, warnings)
         end associate
      end do
   end subroutine warn_of_value

   !> Warn of two values that do not go together
   subroutine warn_of_pair(self, k, code, text, warnings)
      class(wall_warnings_type), intent(in) :: self
      !> Place of the pair
      integer, intent(in) :: k
      !> Code of the warning, and its sentence without the wall
      character(len=*), intent(in) :: code, text
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning

      associate (odd => self%odd(k, pairs))
         if (odd%number == 0) return
         warning = warning_type(code)
         call warning%about('wall', odd%name)
         call add(self, odd, warning, text, warnings)
      end associate
   end subroutine warn_of_pair

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
