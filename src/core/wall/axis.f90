!> The line in the face of a facade that its panel turns about: through two points of the face, level or inclined.
!>
!> A line that rises at an angle beta turns what lies above it about itself. The plane of the motion is normal to the line, and
!> gravity acts in it with its share cos beta alone. Heights are distances from the line,
!>
!>     f = (z - z_0) cos beta - (x - x_0) sin beta
!>
!> A wall without such a line turns about its base: the line is that of z = 0, and f is z to the bit (docs/mechanisms.md).
module dondolo_wall_axis
   use dondolo_base_error, only : not_given, not_together, out_of_range, problems_type, wrong_length
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : choices_length, is_list, is_logical, most_choices, property_type
   use dondolo_base_settings, only : settings_type
   use dondolo_base_text, only : rounded, to_text
   use dondolo_wall_lists, only : take
   implicit none
   private

   public :: axis_rows, axis_type, axis_of, check_axis, take_heights

   !> Owner: walls that lean on transverse walls
   character(len=choices_length), parameter :: one_sided(most_choices) = [character(len=choices_length) :: 'one_sided', &
      & '', '', '', '', '', '', '']

   !> Its properties
   type(property_type), parameter :: axis_rows(*) = [ &
      & property_type('axis_x', is_list, unit='m', owners=one_sided, optional=.true., smallest=-1.0e3_wp, largest=1.0e3_wp, &
      &   usual_least=-1.0e3_wp, example='0.0, 3.0', one_each=.true., &
      &   not_with='hinge_level, hinge_at, wedge_thickness, tie_height, edge_radius', &
      &   because='the axis is where the panel turns, and no other part of the building turns or holds it', &
      &   meaning='places along the facade of two points of the line about which what is above it turns'), &
      & property_type('axis_z', is_list, unit='m', owners=one_sided, optional=.true., smallest=-1.0e3_wp, largest=1.0e3_wp, &
      &   usual_least=-1.0e3_wp, example='6.0, 7.5', one_each=.true., not_with='spring, distributed_spring, free, young_modulus', &
      &   because='which are of a wall that turns about its base', &
      &   meaning='heights of these two points above the base'), &
      & property_type('half_gable', is_logical, owners=one_sided, optional=.true., example='.true.', &
      &   meaning='is the panel one half of a gable that its ridge pushes out?', &
      &   more='it then has a check, and no time histories')]

   !> A line
   type :: axis_type
      !> A point of it [m]
      real(wp) :: x = 0.0_wp, z = 0.0_wp
      !> Of the angle at which it rises
      real(wp) :: cosine = 1.0_wp, sine = 0.0_wp
   contains
      !> Place of a point along the line [m]
      procedure :: along
      !> Distance of a point above it [m]
      procedure :: above
      !> Does it rise or fall?
      procedure :: is_inclined
   end type axis_type

   !> Cosine of the steepest line, of 80 degrees
   real(wp), parameter :: steepest = 0.17364817766693036_wp

contains

   !> Place of a point along the line [m]
   elemental real(wp) function along(self, x, z)
      class(axis_type), intent(in) :: self
      !> Place along the facade, and height [m]
      real(wp), intent(in) :: x, z

      along = (x - self%x)*self%cosine + (z - self%z)*self%sine
   end function along

   !> Distance of a point above the line [m]
   elemental real(wp) function above(self, x, z)
      class(axis_type), intent(in) :: self
      !> Place along the facade, and height [m]
      real(wp), intent(in) :: x, z

      above = (z - self%z)*self%cosine - (x - self%x)*self%sine
   end function above

   !> Does it rise or fall?
   pure logical function is_inclined(self)
      class(axis_type), intent(in) :: self

      is_inclined = abs(self%sine) > 0.0_wp
   end function is_inclined

   !> The line of a wall: that of its base if it has none, or one that `check_axis` refuses
   pure type(axis_type) function axis_of(input) result(axis)
      !> Settings of the wall
      class(settings_type), intent(in) :: input

      real(wp), allocatable :: x(:), z(:)
      real(wp) :: length

      x = input%list('axis_x')
      z = input%list('axis_z')
      if (size(x) /= 2 .or. size(z) /= 2) return
      length = hypot(x(2) - x(1), z(2) - z(1))
      if (.not. abs(x(2) - x(1)) > 0.0_wp) return
      axis = axis_type(x(1), z(1), abs(x(2) - x(1))/length, sign(1.0_wp, x(2) - x(1))*(z(2) - z(1))/length)
   end function axis_of

   !> Check the line of a wall
   subroutine check_axis(input, problems)
      !> Settings of the wall, ranges checked
      class(settings_type), intent(in) :: input
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems

      character(len=*), parameter :: names(2) = ['axis_x', 'axis_z']
      type(axis_type) :: axis
      integer :: i

      if (input%has('half_gable')) then
         axis = axis_of(input)
         ! Cells of tables may be any number
         if (all(abs(input%number('half_gable') - [0.0_wp, 1.0_wp]) > 0.0_wp)) then
            call problems%note('half_gable = '//to_text(input%number('half_gable'))//': must be 1 or 0, .true. or .false. in a '// &
               & 'case', out_of_range, 'half_gable')
         else if (input%number('half_gable') > 0.0_wp .and. .not. axis%is_inclined()) then
            call problems%note('half_gable: only with an inclined axis, from a point on the axis of the gable to a roof slope', &
               & not_together, 'half_gable')
         end if
      end if
      if (.not. (input%has(names(1)) .or. input%has(names(2)))) return
      do i = 1, 2
         associate (count => size(input%list(names(i))))
            if (count == 0) then
               call problems%note(names(i)//': must be given with '//names(3 - i), not_given, names(i))
            else if (count /= 2) then
               call problems%note(names(i)//': has '//to_text(count)//' values, must have 2, of two points of the line', &
                  & wrong_length, names(i))
            end if
         end associate
      end do
      if (.not. input%has('elevation_x')) call problems%note('axis_x: only with elevation_x and elevation_z, the corners of '// &
         & 'the facade', not_together, 'axis_x')
      if (size(input%list(names(1))) /= 2 .or. size(input%list(names(2))) /= 2) return
      axis = axis_of(input)
      associate (x => input%list(names(1)))
         if (abs(x(2) - x(1)) > 0.0_wp .and. .not. axis%cosine < steepest) return
         call problems%note('axis_x: the two points are '//rounded(abs(x(2) - x(1)))//' m from each other along the facade, '// &
            & 'the line through them must rise by at most 80 degrees', out_of_range, 'axis_x')
      end associate
   end subroutine check_axis

   !> Heights of what acts on a wall above the line that it turns about
   subroutine take_heights(input, problems, kind, of, heights)
      !> Settings of the wall
      class(settings_type), intent(in) :: input
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> First word of the names of their properties, and name of the list that has one for each
      character(len=*), intent(in) :: kind, of
      !> As many as that list has [m]
      real(wp), allocatable, intent(out) :: heights(:)

      real(wp), allocatable :: places(:)
      type(axis_type) :: axis

      call take(input, problems, kind//'_height', of, heights)
      if (.not. input%has('axis_x')) then
         if (input%has(kind//'_x')) call problems%note(kind//'_x: only with axis_x, above which heights depend on it', &
            & not_together, kind//'_x')
         return
      end if
      call take(input, problems, kind//'_x', of, places)
      if (size(places) /= size(heights)) return
      axis = axis_of(input)
      heights = axis%above(places, heights)
   end subroutine take_heights

end module dondolo_wall_axis
