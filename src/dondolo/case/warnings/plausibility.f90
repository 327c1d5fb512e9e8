!> Values of walls that no masonry has, or that do not go together: correct input, but most likely a slip.
module dondolo_case_plausibility
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : property_type
   use dondolo_case_warning, only : warning_type, warnings_type
   use dondolo_wall, only : wall_type
   use dondolo_wall_properties, only : gravity_property, wall_properties
   use dondolo_wall_rigid_body, only : same
   implicit none
   private

   public :: wall_warning_type

   !> Places behind the properties: the gravity of a wall, and what is said of values that do not go together
   integer, parameter :: gravity = size(wall_properties) + 1, together = size(wall_properties) + 2

   !> Codes of values that are less than usual, and more, and of those that do not go together
   character(len=24), parameter :: beyond_codes(2) = [character(len=24) :: 'value_below_usual', 'value_above_usual'], &
      & together_codes(3) = [character(len=24) :: 'height_below_thickness', 'load_place_without_load', &
      & 'overlap_above_thickness']

   !> Walls of which there is something to say
   type :: odd_walls_type
      !> How many there are
      integer :: number = 0
      !> Name and value of the first of them
      character(len=:), allocatable :: name
      real(wp) :: value = 0.0_wp
   end type odd_walls_type

   !> What there is to say of the values of walls
   type :: wall_warning_type
      !> Walls looked at
      integer :: walls = 0
      !> Those with values of each property that are less than usual (1), and more (2); and behind the properties those that
      !> are thicker than high (1), that have the place of a load without a load (2), and stones that overlap by more than
      !> the wall is thick (3). Not allocated: there is nothing to say
      type(odd_walls_type), allocatable :: odd(:, :)
   contains
      !> Look at a wall
      procedure :: look
      !> Warn, if there is reason to
      procedure :: warn
   end type wall_warning_type

contains

   !> Look at the values of a wall, or of one of its mechanisms
   subroutine look(self, wall)
      !> What there is to say
      class(wall_warning_type), intent(inout) :: self
      type(wall_type), intent(in) :: wall

      real(wp) :: low, high
      logical :: outside(size(together_codes))
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
      associate (input => wall%input)
         outside(1) = input%number('height') < input%number('thickness')
         outside(2) = (wall%bears .or. abs(input%number('eccentricity')) > 0.0_wp) &
            & .and. .not. input%number('overburden') > 0.0_wp
         outside(3) = input%number('interlock_overlap') > thickest(wall)*(1.0_wp + same)
         call note(self, wall, together, outside, 0.0_wp)
      end associate
   end subroutine look

   !> Thickness of a wall, of storeys the largest [m]
   pure real(wp) function thickest(wall)
      type(wall_type), intent(in) :: wall

      thickest = wall%input%number('thickness')
      if (wall%input%has('section_thickness')) thickest = maxval(wall%input%list('section_thickness'))
   end function thickest

   !> Note what there is to say of a wall
   subroutine note(self, wall, i, outside, value)
      class(wall_warning_type), intent(inout) :: self
      type(wall_type), intent(in) :: wall
      !> Number of a property, `gravity` or `together`
      integer, intent(in) :: i
      !> What there is to say
      logical, intent(in) :: outside(:)
      !> A value of the wall
      real(wp), intent(in) :: value

      integer :: k

      do k = 1, size(outside)
         if (.not. outside(k)) cycle
         if (.not. allocated(self%odd)) allocate (self%odd(size(together_codes), together))
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
      !> What there is to say
      class(wall_warning_type), intent(in) :: self
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning
      type(property_type) :: property
      integer :: i, k

      if (.not. allocated(self%odd)) return
      do i = 1, together
         do k = 1, size(together_codes)
            if (self%odd(k, i)%number == 0) cycle
            warning = warning_type(together_codes(k))
            if (i < together) warning%code = beyond_codes(k)
            call warning%about('wall', self%odd(k, i)%name)
            if (i < together) then
               property = gravity_property
               if (i < gravity) property = wall_properties(i)
               call warning%about('variable', trim(property%name))
               call warning%about('unit', trim(property%unit))
               call warning%with('value', self%odd(k, i)%value)
               call warning%with('limit', merge(property%usual_least, property%usual_most, k == 1))
            end if
            call warning%with('walls_beyond', self%odd(k, i)%number)
            call warning%with('walls', self%walls)
            call warnings%add(warning)
         end do
      end do
   end subroutine warn

end module dondolo_case_plausibility
