!> Values of walls that no masonry has: correct input, but most likely typed in another unit.
module dondolo_plausibility
   use dondolo_kinds, only : wp
   use dondolo_lines, only : line_type, lines_type
   use dondolo_text, only : rounded, to_text
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: wall_warning_type

   !> Values that masonry can have, and the question where a value lies outside
   type :: range_type
      !> Variable of a wall
      character(len=10) :: name
      !> Its unit
      character(len=5) :: unit
      !> Smallest and largest value
      real(wp) :: low, high
      !> What may have happened
      character(len=32) :: question
   end type range_type

   !> A bound that is never reached
   real(wp), parameter :: none = huge(1.0_wp)

   !> The limits, in the order in which look() fills in the values
   type(range_type), parameter :: ranges(6) = [ &
      & range_type('height', 'm', 0.0_wp, 60.0_wp, 'is it in centimetres?'), &
      & range_type('thickness', 'm', 0.0_wp, 3.0_wp, 'is it in centimetres?'), &
      & range_type('density', 'kg/m3', 500.0_wp, none, 'is it in kN/m3 or t/m3?'), &
      & range_type('density', 'kg/m3', 0.0_wp, 4000.0_wp, 'is it in N/m3?'), &
      & range_type('overburden', 'N/m', 200.0_wp, none, 'is it in kN/m?'), &
      & range_type('overburden', 'N/m', 0.0_wp, 1.0e6_wp, 'is it per metre of wall?')]

   !> What there is to say of the values of walls
   type :: wall_warning_type
      !> Walls looked at
      integer :: walls = 0
      !> Walls outside each of the ranges
      integer :: number(size(ranges)) = 0
      !> Name and value of the first of them
      type(line_type) :: first(size(ranges))
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
         if (self%number(i) == 1) self%first(i)%text = 'wall '''//wall%input%name//''': '// &
            & trim(ranges(i)%name)//' = '//rounded(value(i))//' '//trim(ranges(i)%unit)
      end do
   end subroutine look

   !> Warn, if there is reason to
   subroutine warn(self, warnings)
      !> What there is to say
      class(wall_warning_type), intent(in) :: self
      !> Warnings to add to
      type(lines_type), intent(inout) :: warnings

      character(len=:), allocatable :: limit, which
      integer :: i

      do i = 1, size(ranges)
         if (self%number(i) == 0) cycle
         limit = ' is more than '//to_text(ranges(i)%high)
         if (ranges(i)%low > 0.0_wp) limit = ' is less than '//to_text(ranges(i)%low)
         which = ''
         if (self%walls > 1) which = ' ('//to_text(self%number(i))//' of '//to_text(self%walls)//' in all)'
         call warnings%add(self%first(i)%text//limit//' '//trim(ranges(i)%unit)//': '//trim(ranges(i)%question)//which)
      end do
   end subroutine warn

end module dondolo_plausibility
