!> Values of walls that no masonry has: correct input, but most likely typed in another unit.
module dondolo_plausibility
   use dondolo_kinds, only : wp
   use dondolo_property, only : is_list
   use dondolo_lines, only : line_type
   use dondolo_wall, only : wall_type
   use dondolo_wall_properties, only : wall_properties
   use dondolo_warning, only : warning_type, warnings_type
   implicit none
   private

   public :: wall_warning_type

   !> What there is to say of the values of walls: of those that are less than usual (1), and more (2)
   type :: wall_warning_type
      !> Walls looked at
      integer :: walls = 0
      !> Walls outside the usual range of each property
      integer :: number(2, size(wall_properties)) = 0
      !> Name and value of the first of them
      type(line_type) :: first(2, size(wall_properties))
      real(wp) :: value(2, size(wall_properties)) = 0.0_wp
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

      real(wp), allocatable :: values(:)
      logical :: outside(2)
      integer :: i, k, m

      self%walls = self%walls + 1
      do i = 1, size(wall_properties)
         associate (property => wall_properties(i))
            values = [wall%input%number(property%name)]
            if (property%kind == is_list) values = wall%input%list(property%name)
            ! No overburden is no mistake
            outside = [any(values > 0.0_wp .and. values < property%usual_least), any(values > property%usual_most)]
            do k = 1, 2
               if (.not. outside(k)) cycle
               self%number(k, i) = self%number(k, i) + 1
               if (self%number(k, i) > 1) cycle
               self%first(k, i)%text = wall%name()
               m = findloc(merge(values > 0.0_wp .and. values < property%usual_least, values > property%usual_most, &
                  & k == 1), .true., dim=1)
               self%value(k, i) = values(m)
            end do
         end associate
      end do
   end subroutine look

   !> Warn, if there is reason to
   subroutine warn(self, warnings)
      !> What there is to say
      class(wall_warning_type), intent(in) :: self
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning
      integer :: i, k

      do i = 1, size(wall_properties)
         associate (property => wall_properties(i))
            do k = 1, 2
               if (self%number(k, i) == 0) cycle
               warning = warning_type('value_below_usual')
               if (k == 2) warning%code = 'value_above_usual'
               call warning%about('wall', self%first(k, i)%text)
               call warning%about('variable', trim(property%name))
               call warning%about('unit', trim(property%unit))
               call warning%with('value', self%value(k, i))
               call warning%with('limit', merge(property%usual_least, property%usual_most, k == 1))
               call warning%with('walls_beyond', self%number(k, i))
               call warning%with('walls', self%walls)
               call warnings%add(warning)
            end do
         end associate
      end do
   end subroutine warn

end module dondolo_plausibility
