!> Corners of buildings that overturn along the bisector of their two walls (ribaltamento del cantonale).
!>
!> Two walls of thickness t meet at right angles. Cracks rise in both from the base of the corner, at an angle with the vertical
!> whose tangent is T: at the height z above the hinge a wing of each wall is w = min(z T, length) long, measured from the inner
!> face of the other wall. The corner is the square t x t with both wings. Depths are measured on the bisector from the outer
!> edge: a point (x, y) of the plan is (x + y)/sqrt(2) deep. Per height, and divided by the density,
!>
!>     mass                           t^2 + 2 t w
!>     mass times depth               (t^3 + 3 t^2 w + t w^2)/sqrt(2)
!>     mass times depth squared       7/12 t^4 + 7/3 t^3 w + 3/2 t^2 w^2 + t w^3/3
!>
!> All numbers are those of the whole corner, not per metre (docs/mechanisms.md).
module dondolo_wall_corner
   use dondolo_base_error, only : not_given, problems_type
   use dondolo_base_kinds, only : pi, wp
   use dondolo_base_property, only : blank, choices_length, most_choices, property_type
   use dondolo_base_settings, only : settings_type
   use dondolo_base_text, only : rounded
   use dondolo_wall_hinge_depth, only : check_hinge
   use dondolo_wall_rigid_body, only : rigid_body_type
   implicit none
   private

   public :: corner_name, corner_rows, corner_type
   public :: body_of_corner, body_of_wing, check_corner_hinge, corner_reach, edge_of_corner, read_corner

   !> Name of the mechanism
   character(len=choices_length), parameter :: corner_name = 'corner'

   !> Owners of what it alone has
   character(len=choices_length), parameter :: corner(most_choices) = reshape([corner_name], [most_choices], pad=blank)

   !> Its properties
   type(property_type), parameter :: corner_rows(*) = [ &
      & property_type('wing_angle', unit='deg', owners=corner, optional=.true., smallest=0.0_wp, largest=80.0_wp, &
      &   usual_least=5.0_wp, usual_most=45.0_wp, if_less='is it in radians?', example='20.0', &
      &   meaning='angle of the cracks in both walls of a corner with the vertical; 0: no wings'), &
      & property_type('wing_length', unit='m', owners=corner, optional=.true., positive=.true., smallest=1.0e-2_wp, &
      &   largest=1.0e3_wp, usual_most=30.0_wp, example='1.2', &
      &   meaning='greatest length of each wing behind the inner face of the other wall, up to the first opening; none if '// &
      &   'not given')]

   real(wp), parameter :: half_turn = 180.0_wp, sqrt2 = sqrt(2.0_wp)

   !> A corner
   type :: corner_type
      !> Thickness of both walls, height above the hinge, and greatest length of a wing [m]
      real(wp) :: thickness = 0.0_wp, height = 0.0_wp, length = huge(1.0_wp)
      !> Tangent of the angle of the cracks with the vertical
      real(wp) :: slope = 0.0_wp
      !> Density of the masonry [kg/m3]
      real(wp) :: density = 0.0_wp
   end type corner_type

contains

   !> Read a corner
   subroutine read_corner(input, problems, corner)
      !> Settings of the wall, ranges checked
      class(settings_type), intent(in) :: input
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      type(corner_type), intent(out) :: corner

      if (.not. input%has('wing_angle')) call problems%note('wing_angle: must be given with mechanism = ''corner'', the angle '// &
         & 'of the cracks with the vertical; 0 for no wings', not_given, 'wing_angle')
      if (.not. (input%number('hinge_depth') > 0.0_wp .or. input%has('compressive_strength'))) call problems%note( &
         & 'hinge_depth: must be given and positive with mechanism = ''corner'', or compressive_strength: all its weight bears '// &
         & 'on one point otherwise', not_given, 'hinge_depth')
      corner%thickness = input%number('thickness')
      corner%height = input%number('height')
      corner%density = input%number('density')
      corner%slope = tan(input%number('wing_angle')*pi/half_turn)
      if (input%has('wing_length')) corner%length = input%number('wing_length')
   end subroutine read_corner

   !> The corner as one body, whole
   pure function body_of_corner(corner) result(body)
      type(corner_type), intent(in) :: corner
      type(rigid_body_type) :: body

      !> Gauss's rule of two points on (0, 1), exact for polynomials of degree 3
      real(wp), parameter :: points(2) = 0.5_wp*(1.0_wp + [-1.0_wp, 1.0_wp]/sqrt(3.0_wp))
      real(wp) :: ends(3), z, part, w, area, first, second
      integer :: i, k

      ! Above the second of these levels a wing is as long as it may be
      ends = [0.0_wp, corner%height, corner%height]
      if (corner%slope*corner%height > corner%length) ends(2) = corner%length/corner%slope
      first = 0.0_wp
      second = 0.0_wp
      associate (t => corner%thickness)
         do i = 1, 2
            do k = 1, 2
               z = ends(i) + points(k)*(ends(i + 1) - ends(i))
               part = 0.5_wp*corner%density*(ends(i + 1) - ends(i))
               w = wing_at(corner, z)
               area = t**2 + 2.0_wp*t*w
               body%mass = body%mass + part*area
               body%height = body%height + part*area*z
               first = first + part*t*(t**2 + 3.0_wp*t*w + w**2)/sqrt2
               second = second + part*(t*(7.0_wp/12.0_wp*t**3 + 7.0_wp/3.0_wp*t**2*w + 1.5_wp*t*w**2 + w**3/3.0_wp) + area*z**2)
            end do
         end do
      end associate
      body%depth = first/body%mass
      body%height = body%height/body%mass
      body%inertia = second - body%mass*(body%depth**2 + body%height**2)
   end function body_of_corner

   !> The corner without its wings
   pure function edge_of_corner(corner) result(body)
      type(corner_type), intent(in) :: corner
      type(rigid_body_type) :: body

      type(corner_type) :: edge

      edge = corner
      edge%slope = 0.0_wp
      body = body_of_corner(edge)
   end function edge_of_corner

   !> One of the two wings, which are mirror images: mass and centroid; without a mass if there are none
   pure function body_of_wing(corner) result(body)
      type(corner_type), intent(in) :: corner
      type(rigid_body_type) :: body

      type(rigid_body_type) :: whole, edge

      if (.not. corner%slope > 0.0_wp) return
      whole = body_of_corner(corner)
      edge = edge_of_corner(corner)
      body%mass = 0.5_wp*(whole%mass - edge%mass)
      body%depth = (whole%mass*whole%depth - edge%mass*edge%depth)/(2.0_wp*body%mass)
      body%height = (whole%mass*whole%height - edge%mass*edge%height)/(2.0_wp*body%mass)
   end function body_of_wing

   !> Length of a wing at a height [m]
   elemental real(wp) function wing_at(corner, height)
      type(corner_type), intent(in) :: corner
      !> Above the hinge [m]
      real(wp), intent(in) :: height

      wing_at = min(corner%slope*height, corner%length)
   end function wing_at

   !> Depth of the ends of the wings at a height [m]
   elemental real(wp) function corner_reach(corner, height)
      type(corner_type), intent(in) :: corner
      !> Above the hinge [m]
      real(wp), intent(in) :: height

      corner_reach = (2.0_wp*corner%thickness + wing_at(corner, height))/sqrt2
   end function corner_reach

   !> Check that the stress block of the base, a triangle whose resultant is the hinge, lies within half of the square
   subroutine check_corner_hinge(corner, input, problems, name, depth)
      type(corner_type), intent(in) :: corner
      !> Settings of the wall
      class(settings_type), intent(in) :: input
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> Name of the property that the depth follows from
      character(len=*), intent(in) :: name
      !> Depth of the hinge [m]
      real(wp), intent(in) :: depth

      associate (limit => sqrt2*corner%thickness/3.0_wp)
         call check_hinge(input, problems, name, depth, limit, 'a third of the diagonal of the base, '//rounded(limit)// &
            & ' m, where the crushed masonry is half of it', 'thickness')
      end associate
   end subroutine check_corner_hinge

end module dondolo_wall_corner
