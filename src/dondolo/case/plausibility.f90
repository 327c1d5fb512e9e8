!> Values of walls that no masonry has: correct input, but most likely typed in another unit.
module dondolo_plausibility
   use dondolo_kinds, only : wp
   use dondolo_lines, only : line_type
   use dondolo_wall, only : wall_type
   use dondolo_warning, only : warning_type, warnings_type
   implicit none
   private

   public :: wall_warning_type

   !> Values that masonry can have, and the warning where a value lies outside
   type :: range_type
      !> Code of the warning
      character(len=16) :: code
      !> Variable of a wall
      character(len=10) :: name
      !> Its unit
      character(len=5) :: unit
      !> Smallest and largest value
      real(wp) :: low, high
   end type range_type

   !> A bound that is never reached
   real(wp), parameter :: none = huge(1.0_wp)

   !> The limits, in the order in which look() fills in the values
   type(range_type), parameter :: ranges(6) = [ &
      & range_type('height_large', 'height', 'm', 0.0_wp, 60.0_wp), &
      & range_type('thickness_large', 'thickness', 'm', 0.0_wp, 3.0_wp), &
      & range_type('density_small', 'density', 'kg/m3', 500.0_wp, none), &
      & range_type('density_large', 'density', 'kg/m3', 0.0_wp, 4000.0_wp), &
      & range_type('overburden_small', 'overburden', 'N/m', 200.0_wp, none), &
      & range_type('overburden_large', 'overburden', 'N/m', 0.0_wp, 1.0e6_wp)]

   !> What there is to say of the values of walls
   type :: wall_warning_type
      !> Walls looked at
      integer :: walls = 0
      !> Walls outside each of the ranges
      integer :: number(size(ranges)) = 0
      !> Name and value of the first of them
      type(line_type) :: first(size(ranges))
      real(wp) :: value(size(ranges)) = 0.0_wp
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
      !> The wall
      type(wall_type), intent(in) :: wall

      real(wp) :: value(size(ranges))
      integer :: i

      associate (input => wall%input)
         value = [input%height, input%thickness, input%density, input%density, 0.0_wp, 0.0_wp]
         if (allocated(input%overburden)) value(5:) = input%overburden
      end associate
      self%walls = self%walls + 1
      do i = 1, size(ranges)
         ! No overburden is no mistake
         if (.not. value(i) > 0.0_wp .or. (value(i) >= ranges(i)%low .and. value(i) <= ranges(i)%high)) cycle
         self%number(i) = self%number(i) + 1
         if (self%number(i) > 1) cycle
         self%first(i)%text = wall%input%name
         self%value(i) = value(i)
      end do
   end subroutine look

   !> Warn, if there is reason to
   subroutine warn(self, warnings)
      !> What there is to say
      class(wall_warning_type), intent(in) :: self
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning
      integer :: i

      do i = 1, size(ranges)
         if (self%number(i) == 0) cycle
         warning = warning_type(ranges(i)%code)
         call warning%about('wall', self%first(i)%text)
         call warning%about('variable', trim(ranges(i)%name))
         call warning%about('unit', trim(ranges(i)%unit))
         call warning%with('value', self%value(i))
         call warning%with('limit', merge(ranges(i)%low, ranges(i)%high, self%value(i) < ranges(i)%low))
         call warning%with('walls_beyond', self%number(i))
         call warning%with('walls', self%walls)
         call warnings%add(warning)
      end do
   end subroutine warn

end module dondolo_plausibility
