!> Wedges of transverse walls that turn out with a facade: compound overturning.
!>
!> A facade that is bonded to transverse walls takes a wedge of each of them along, behind its inner face and above a crack that
!> rises from the face at an angle psi with the vertical. At the height zeta above its bottom a wedge is min(zeta tan psi, length)
!> long. It adds weight behind the hinge, and mass; nothing else holds it (docs/mechanisms.md).
module dondolo_wall_wedge
   use dondolo_base_error, only : not_together, out_of_range, problems_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : choices_length, is_list, most_choices, property_type
   use dondolo_base_settings, only : settings_type
   use dondolo_base_text, only : rounded, to_text
   use dondolo_wall_elevation, only : eaves_of_elevation
   use dondolo_wall_lists, only : take
   use dondolo_wall_rigid_body, only : joined, rigid_body_type, same, section_type
   implicit none
   private

   public :: read_wedges, wedge_reach, wedge_rows, wedge_type

   !> Owner: walls that lean on transverse walls
   character(len=choices_length), parameter :: one_sided(most_choices) = [character(len=choices_length) :: 'one_sided', &
      & '', '', '', '', '', '', '']

   !> Their properties
   type(property_type), parameter :: wedge_rows(*) = [ &
      & property_type('facade_length', unit='m', owners=one_sided, optional=.true., positive=.true., smallest=0.1_wp, &
      &   largest=1.0e3_wp, usual_least=0.5_wp, usual_most=100.0_wp, example='6.0', &
      &   meaning='length of the facade: the masses of its wedges, and of an elevation, are divided by it'), &
      & property_type('wedge_thickness', is_list, unit='m', owners=one_sided, optional=.true., positive=.true., &
      &   smallest=1.0e-2_wp, largest=10.0_wp, usual_most=3.0_wp, example='0.45, 0.45', &
      &   not_with='leaves, mass, interlock_overlap', &
      &   because='wedges of transverse walls hold one solid facade, and by their weight alone', &
      &   meaning='thickness of each transverse wall of which a wedge turns with the facade'), &
      & property_type('wedge_angle', is_list, unit='deg', owners=one_sided, optional=.true., smallest=0.0_wp, &
      &   largest=80.0_wp, usual_least=5.0_wp, usual_most=45.0_wp, if_less='is it in radians?', example='20.0', &
      &   meaning='angle of the crack below each wedge with the vertical; 0: no wedge'), &
      & property_type('wedge_bottom', is_list, unit='m', owners=one_sided, optional=.true., smallest=0.0_wp, &
      &   largest=1.0e3_wp, usual_most=60.0_wp, example='0.0', &
      &   meaning='height above the base at which each wedge begins, in a point'), &
      & property_type('wedge_top', is_list, unit='m', owners=one_sided, optional=.true., positive=.true., &
      &   largest=1.0e3_wp, usual_most=60.0_wp, example='7.0', &
      &   meaning='height at which each wedge ends'), &
      & property_type('wedge_length', is_list, unit='m', owners=one_sided, optional=.true., positive=.true., &
      &   smallest=1.0e-2_wp, largest=1.0e3_wp, usual_most=30.0_wp, example='2.5, 9.0', &
      &   meaning='greatest length of each wedge behind the inner face, up to the first opening of the transverse wall')]

   !> Half a turn [deg], and in radians
   real(wp), parameter :: half_turn = 180.0_wp, pi = acos(-1.0_wp)

   !> A wedge
   type :: wedge_type
      !> Thickness of the transverse wall, heights between which the wedge lies, and its greatest length [m]
      real(wp) :: thickness = 0.0_wp, bottom = 0.0_wp, top = 0.0_wp, length = 0.0_wp
      !> Tangent of the angle of its crack with the vertical
      real(wp) :: slope = 0.0_wp
      !> The wedge as a body, per metre of facade
      type(rigid_body_type) :: body
   end type wedge_type

contains

   !> Read the wedges of a wall
   subroutine read_wedges(input, sections, problems, wedges)
      !> Settings of the wall, ranges checked
      class(settings_type), intent(in) :: input
      !> Its storeys
      type(section_type), intent(in) :: sections(:)
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> Wedges; those without a mass too
      type(wedge_type), allocatable, intent(out) :: wedges(:)

      real(wp), allocatable :: angle(:), bottom(:), top(:), length(:)
      character(len=:), allocatable :: of
      real(wp) :: tall
      integer :: i

      call take(input, problems, 'wedge_angle', 'wedge_thickness', angle)
      call take(input, problems, 'wedge_bottom', 'wedge_thickness', bottom)
      call take(input, problems, 'wedge_top', 'wedge_thickness', top)
      call take(input, problems, 'wedge_length', 'wedge_thickness', length)
      allocate (wedges(size(angle)))
      if (input%has('facade_length') .neqv. (size(wedges) > 0 .or. input%has('elevation_x'))) call problems%note( &
         & 'facade_length: must be given with wedges of transverse walls or an elevation, and only with them', not_together, &
         & 'facade_length')
      if (size(wedges) == 0 .or. problems%count > 0) return
      wedges%thickness = input%list('wedge_thickness')
      wedges%bottom = bottom
      wedges%top = top
      wedges%length = length
      wedges%slope = tan(angle*pi/half_turn)
      tall = sum(sections%height)
      of = 'wall'
      if (input%has('elevation_x')) then
         tall = eaves_of_elevation(input)
         of = 'elevation at its ends'
      end if
      if (.not. sum(wedges%thickness) < input%number('facade_length')) call problems%note('wedge_thickness: '// &
         & rounded(sum(wedges%thickness))//' m in all, must be less than facade_length = '// &
         & to_text(input%number('facade_length')), out_of_range, 'wedge_thickness')
      do i = 1, size(wedges)
         if (.not. top(i) > bottom(i)) call problems%note('wedge '//to_text(i)//': its top '//to_text(top(i))//' must be above '// &
            & 'its bottom, '//to_text(bottom(i)), out_of_range, 'wedge_top')
         if (top(i) > tall*(1.0_wp + same)) call problems%note('wedge '//to_text(i)//': its top '//to_text(top(i))//' must be '// &
            & 'at most '//rounded(tall)//' m, the height of the '//of, out_of_range, 'wedge_top')
         if (problems%count == 0) wedges(i)%body = body_of(wedges(i), sections, &
            & input%number('density')/input%number('facade_length'))
      end do
   end subroutine read_wedges

   !> A wedge as a body: in each storey it begins at the inner face of that storey
   pure function body_of(wedge, sections, density) result(body)
      type(wedge_type), intent(in) :: wedge
      !> From the bottom
      type(section_type), intent(in) :: sections(:)
      !> Density of the masonry / length of the facade [kg/m4]
      real(wp), intent(in) :: density
      type(rigid_body_type) :: body

      real(wp) :: below, full, ends(3)
      integer :: i, k

      ! Above `full` the wedge is as long as it may be
      full = wedge%top
      if (wedge%slope*(wedge%top - wedge%bottom) > wedge%length) full = wedge%bottom + wedge%length/wedge%slope
      below = 0.0_wp
      do i = 1, size(sections)
         associate (part => sections(i))
            ends = [max(below, wedge%bottom), full, min(below + part%height, wedge%top)]
            ends(2) = max(ends(1), min(ends(2), ends(3)))
            do k = 1, 2
               if (ends(k + 1) > ends(k)) body = joined(body, trapezoid(density*wedge%thickness, part%offset + part%thickness, &
                  & ends(k:k + 1), min((ends(k:k + 1) - wedge%bottom)*wedge%slope, wedge%length)))
            end do
            below = below + part%height
         end associate
      end do
   end function body_of

   !> A trapezoid with one upright side; without a length a body without mass
   pure function trapezoid(density, face, ends, lengths) result(body)
      !> Mass per area of its side [kg/m3]
      real(wp), intent(in) :: density
      !> Depth of the upright side, heights of its bottom and its top, lengths there [m]
      real(wp), intent(in) :: face, ends(2), lengths(2)
      type(rigid_body_type) :: body

      real(wp) :: rise, depth

      associate (tall => ends(2) - ends(1), w0 => lengths(1), w1 => lengths(2))
         body%mass = density*tall*(w0 + w1)/2.0_wp
         if (.not. body%mass > 0.0_wp) return
         rise = tall*(w0 + 2.0_wp*w1)/(3.0_wp*(w0 + w1))
         depth = (w0**2 + w0*w1 + w1**2)/(3.0_wp*(w0 + w1))
         body%depth = face + depth
         body%height = ends(1) + rise
         body%inertia = density*tall*(tall**2*(w0 + 3.0_wp*w1) + (w0 + w1)*(w0**2 + w1**2))/12.0_wp &
            & - body%mass*(rise**2 + depth**2)
      end associate
   end function trapezoid

   !> How far the longest wedge reaches behind the inner face at a height [m]
   pure real(wp) function wedge_reach(wedges, height) result(reach)
      type(wedge_type), intent(in) :: wedges(:)
      !> Above the base [m]
      real(wp), intent(in) :: height

      associate (above => height - wedges%bottom, slack => same*wedges%top)
         reach = maxval([0.0_wp, pack(min(wedges%slope*above, wedges%length), above > 0.0_wp .and. &
            & height <= wedges%top + slack)])
      end associate
   end function wedge_reach

end module dondolo_wall_wedge
