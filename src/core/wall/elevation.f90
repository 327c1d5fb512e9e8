!> The elevation of a facade: a polygon with doors and windows, in place of storeys of which a part is masonry.
!>
!> Its corners are points (x, z), x along the facade and z above the base. Rectangles are taken away. Only what is above the base
!> turns: the polygon and the openings are cut there. With the area A, and the first and the second moment B and C of the area about
!> the base, the density rho, the thickness t and the length b that values per metre refer to, the facade has per metre
!>
!>     mass  rho t A/b          height of the centroid  B/A          inertia about it  rho t (C - B^2/A + A t^2/12)/b
!>
!> Of a panel that turns about another line of its face, this line is in place of the base (dondolo_wall_axis).
!> by Green's theorem from the corners (docs/mechanisms.md).
module dondolo_wall_elevation
   use dondolo_base_error, only : not_given, not_together, out_of_range, problems_type, wrong_length
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : choices_length, is_list, most_choices, property_type
   use dondolo_base_settings, only : settings_type
   use dondolo_base_text, only : rounded, to_text
   use dondolo_wall_axis, only : axis_of, axis_type, check_axis
   use dondolo_wall_lists, only : take
   use dondolo_wall_rigid_body, only : rigid_body_type, same
   implicit none
   private

   public :: eaves_of_elevation, elevation_rows, read_elevation, top_of_elevation

   !> Owner: walls that lean on transverse walls
   character(len=choices_length), parameter :: one_sided(most_choices) = [character(len=choices_length) :: 'one_sided', &
      & '', '', '', '', '', '', '']

   !> Its properties
   type(property_type), parameter :: elevation_rows(*) = [ &
      & property_type('elevation_x', is_list, unit='m', owners=one_sided, optional=.true., smallest=-1.0e3_wp, largest=1.0e3_wp, &
      &   example='0.0, 6.0, 6.0, 0.0', one_each=.true., &
      &   not_with='section_height, leaves, mass, young_modulus, interlock_overlap', &
      &   because='which describe the masonry in another way or are of constant section', &
      &   meaning='places along the facade of the corners of its elevation, around it, instead of height'), &
      & property_type('elevation_z', is_list, unit='m', owners=one_sided, optional=.true., smallest=-1.0e3_wp, largest=1.0e3_wp, &
      &   example='0.0, 0.0, 7.0, 7.0', one_each=.true., meaning='heights of these corners above the base'), &
      & property_type('opening_x', is_list, unit='m', owners=one_sided, optional=.true., smallest=-1.0e3_wp, largest=1.0e3_wp, &
      &   example='1.0, 4.0', one_each=.true., meaning='place along the facade at which each door or window begins'), &
      & property_type('opening_z', is_list, unit='m', owners=one_sided, optional=.true., smallest=-1.0e3_wp, largest=1.0e3_wp, &
      &   example='0.9, 0.9', meaning='height above the base at which each of them begins'), &
      & property_type('opening_width', is_list, unit='m', owners=one_sided, optional=.true., positive=.true., &
      &   smallest=1.0e-3_wp, largest=1.0e3_wp, usual_most=20.0_wp, example='1.1, 1.1', meaning='width of each of them'), &
      & property_type('opening_height', is_list, unit='m', owners=one_sided, optional=.true., positive=.true., &
      &   smallest=1.0e-3_wp, largest=1.0e3_wp, usual_most=20.0_wp, example='1.4, 1.4', meaning='height of each of them')]

   !> Part of the width of an elevation by which facade_length may differ from it
   real(wp), parameter :: length_tolerance = 0.01_wp

contains

   !> The height at the lower one of both ends, up to which transverse walls meet the facade [m]; huge: there is no elevation
   pure real(wp) function eaves_of_elevation(input) result(eaves)
      !> Settings of the wall
      class(settings_type), intent(in) :: input

      real(wp), allocatable :: x(:), z(:)

      eaves = huge(1.0_wp)
      x = input%list('elevation_x')
      z = input%list('elevation_z')
      if (size(x) == 0 .or. size(x) /= size(z)) return
      associate (slack => same*(maxval(x) - minval(x)))
         eaves = min(maxval(z, x <= minval(x) + slack), maxval(z, x >= maxval(x) - slack))
      end associate
   end function eaves_of_elevation

   !> The height of the highest corner above the base, or above the line that the facade turns about; 0: there is no elevation
   pure real(wp) function top_of_elevation(input) result(top)
      !> Settings of the wall
      class(settings_type), intent(in) :: input

      real(wp), allocatable :: x(:), z(:)
      type(axis_type) :: axis

      x = input%list('elevation_x')
      z = input%list('elevation_z')
      axis = axis_of(input)
      if (size(x) == size(z)) z = axis%above(x, z)
      top = max(0.0_wp, maxval([0.0_wp, z]))
   end function top_of_elevation

   !> Read the elevation of a facade, and check it; nothing where there is none
   subroutine read_elevation(input, problems, body)
      !> Settings of the wall, ranges checked
      class(settings_type), intent(in) :: input
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> The facade per metre; not allocated: it has no elevation
      type(rigid_body_type), allocatable, intent(out) :: body

      real(wp), allocatable :: x(:), z(:), left(:), low(:), width(:), height(:), corner_x(:, :), corner_z(:, :)
      type(axis_type) :: axis
      real(wp) :: sums(3), area
      integer :: before, i

      before = problems%count
      call check_axis(input, problems)
      call take(input, problems, 'opening_z', 'opening_x', low)
      call take(input, problems, 'opening_width', 'opening_x', width)
      call take(input, problems, 'opening_height', 'opening_x', height)
      left = input%list('opening_x')
      x = input%list('elevation_x')
      z = input%list('elevation_z')
      if (size(x) == 0 .and. size(z) == 0) then
         if (size(left) > 0) call problems%note('opening_x: only with elevation_x and elevation_z, the corners of the facade', &
            & not_together, 'opening_x')
         return
      end if
      if (.not. input%has('facade_length')) call problems%note('facade_length: must be given with elevation_x, the length that '// &
         & 'values per metre refer to', not_given, 'facade_length')
      if (size(x) == 0) call problems%note('elevation_x: must be given with elevation_z', not_given, 'elevation_x')
      if (size(z) == 0) call problems%note('elevation_z: must be given with elevation_x', not_given, 'elevation_z')
      ! Doors shorten the base, and so what bears is not known from a length.
      if (input%has('compressive_strength')) call problems%note('compressive_strength: not with elevation_x, for doors shorten '// &
         & 'the masonry that is crushed; give hinge_depth, the weight over 2 x 0.85 f and the length of masonry at the base', &
         & not_together, 'compressive_strength')
      if (problems%count > before) return
      if (size(x) /= size(z)) call problems%note('elevation_z: has '//to_text(size(z))//' values, must have '//to_text(size(x))// &
         & ' as elevation_x', wrong_length, 'elevation_z')
      if (problems%count > before) return
      if (size(x) < 3) call problems%note('elevation_x: has '//to_text(size(x))//' corners, must have at least 3', wrong_length, &
         & 'elevation_x')
      if (problems%count > before) return
      call check_edges(x, z, problems)
      if (problems%count > before) return
      associate (b => input%number('facade_length'), wide => maxval(x) - minval(x))
         if (abs(b - wide) > length_tolerance*wide) call problems%note('facade_length = '//to_text(b)//': must be '// &
            & rounded(wide)//' m, the width of the elevation', out_of_range, 'facade_length')
      end associate
      axis = axis_of(input)
      sums = moments(axis%along(x, z), axis%above(x, z))
      allocate (corner_x(4, size(left)), corner_z(4, size(left)))
      do i = 1, size(left)
         ! What the elevation has within the rectangle is all of the rectangle
         associate (right => left(i) + width(i), top => low(i) + height(i))
            area = area_within(x, z, left(i), right, low(i), top)
            if (area < width(i)*height(i)*(1.0_wp - same)) call problems%note('opening '//to_text(i)//': '// &
               & rounded(width(i)*height(i) - area)//' m2 of its '//rounded(width(i)*height(i))//' m2 lie outside the '// &
               & 'elevation, it must lie within', out_of_range, 'opening_x')
            if (overlaps(i)) call problems%note('opening '//to_text(i)//': overlaps one before it', out_of_range, 'opening_x')
            corner_x(:, i) = axis%along([left(i), right, right, left(i)], [low(i), low(i), top, top])
            corner_z(:, i) = axis%above([left(i), right, right, left(i)], [low(i), low(i), top, top])
         end associate
         sums = sums - moments(corner_x(:, i), corner_z(:, i))
      end do
      if (problems%count > before) return
      if (.not. sums(1) > same*(maxval(x) - minval(x))*(maxval(z) - minval(z))) then
         call problems%note('opening_x: the openings leave no masonry above the '//line(), out_of_range, 'opening_x')
         return
      end if
      call check_levels(axis%along(x, z), axis%above(x, z), corner_x, corner_z, line(), problems)
      if (problems%count > before) return
      allocate (body)
      associate (t => input%number('thickness'), per => input%number('density')/input%number('facade_length'))
         body%mass = per*t*sums(1)
         body%depth = 0.5_wp*t
         body%height = sums(2)/sums(1)
         body%inertia = per*t*(sums(3) - sums(2)**2/sums(1) + sums(1)*t**2/12.0_wp)
      end associate

   contains

      !> The line that the facade turns about, in a word
      pure function line() result(word)
         character(len=4) :: word

         word = 'base'
         if (input%has('axis_x')) word = 'axis'
      end function line

      !> Does an opening overlap one before it?
      pure logical function overlaps(number)
         integer, intent(in) :: number

         integer :: k

         overlaps = .false.
         do k = 1, number - 1
            overlaps = overlaps .or. (min(left(k) + width(k), left(number) + width(number)) - max(left(k), left(number)) &
               & > same*width(number) .and. min(low(k) + height(k), low(number) + height(number)) - max(low(k), low(number)) &
               & > same*height(number))
         end do
      end function overlaps

   end subroutine read_elevation

   !> Area of what is above the base, and its first and second moments about the base [m2, m3, m4]
   pure function moments(x, z) result(sums)
      !> Corners of a polygon in their order, either way round [m]
      real(wp), intent(in) :: x(:), z(:)
      real(wp) :: sums(3)

      real(wp), allocatable :: u(:), v(:)
      real(wp) :: cross
      integer :: i, next

      call cut(x, z, 0.0_wp, u, v)
      sums = 0.0_wp
      do i = 1, size(u)
         next = modulo(i, size(u)) + 1
         cross = u(i)*v(next) - u(next)*v(i)
         sums = sums + cross*[1.0_wp/2.0_wp, (v(i) + v(next))/6.0_wp, (v(i)**2 + v(i)*v(next) + v(next)**2)/12.0_wp]
      end do
      if (sums(1) < 0.0_wp) sums = -sums
   end function moments

   !> Area that a polygon has within an upright rectangle [m2]
   pure real(wp) function area_within(x, z, left, right, low, top) result(area)
      !> Corners [m]
      real(wp), intent(in) :: x(:), z(:)
      !> The rectangle [m]
      real(wp), intent(in) :: left, right, low, top

      real(wp), allocatable :: a(:), b(:), c(:), d(:)
      integer :: i, next

      ! Above its lower side, below its upper one, and both turned by a right angle
      call cut(x, z, low, a, b)
      call cut(a, -b, -top, c, d)
      call cut(d, c, left, a, b)
      call cut(a, -b, -right, c, d)
      area = 0.0_wp
      do i = 1, size(c)
         next = modulo(i, size(c)) + 1
         area = area + 0.5_wp*(c(i)*d(next) - c(next)*d(i))
      end do
      area = abs(area)
   end function area_within

   !> The part of a polygon above a level
   pure subroutine cut(x, z, level, u, v)
      !> Corners [m]
      real(wp), intent(in) :: x(:), z(:)
      !> The level [m]
      real(wp), intent(in) :: level
      !> Corners of the part; where it falls apart, edges on the level join the parts
      real(wp), allocatable, intent(out) :: u(:), v(:)

      real(wp) :: share
      integer :: i, next

      allocate (u(0), v(0))
      do i = 1, size(x)
         next = modulo(i, size(x)) + 1
         if (.not. z(i) < level) then
            u = [u, x(i)]
            v = [v, z(i)]
         end if
         if ((z(i) < level) .eqv. (z(next) < level)) cycle
         share = (level - z(i))/(z(next) - z(i))
         u = [u, x(i) + share*(x(next) - x(i))]
         v = [v, level]
      end do
   end subroutine cut

   !> Check that masonry is at every level from the base to the top
   subroutine check_levels(x, z, hole_x, hole_z, line, problems)
      !> Corners [m]
      real(wp), intent(in) :: x(:), z(:)
      !> Corners of openings, a column each, which lie within the polygon and apart from each other [m]
      real(wp), intent(in) :: hole_x(:, :), hole_z(:, :)
      !> What z = 0 is
      character(len=*), intent(in) :: line
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems

      real(wp), allocatable :: edges(:)
      real(wp) :: bottom, top, area, taken, least
      character(len=:), allocatable :: levels
      integer :: i

      ! Between two neighbours of these levels no edge begins or ends
      edges = [0.0_wp, z, hole_z]
      bottom = 0.0_wp
      do while (any(edges > bottom + same*maxval(z)))
         top = minval(edges, edges > bottom + same*maxval(z))
         area = area_within(x, z, minval(x), maxval(x), bottom, top)
         taken = 0.0_wp
         do i = 1, size(hole_x, 2)
            taken = taken + area_within(hole_x(:, i), hole_z(:, i), minval(x), maxval(x), bottom, top)
         end do
         least = same*(maxval(x) - minval(x))*(top - bottom)
         levels = 'from '//rounded(bottom)//' to '//rounded(top)//' m above the '//line//', what is above rests on nothing'
         if (.not. area > least) then
            call problems%note('elevation_z: no masonry is '//levels//'; heights are from the '//line, out_of_range, 'elevation_z')
            return
         else if (.not. area - taken > least) then
            call problems%note('opening_x: openings take the whole width of the facade '//levels, out_of_range, 'opening_x')
            return
         end if
         bottom = top
      end do
   end subroutine check_levels

   !> Check that no two edges of a polygon cross or touch, but at the corner that both have
   subroutine check_edges(x, z, problems)
      !> Corners [m]
      real(wp), intent(in) :: x(:), z(:)
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems

      real(wp) :: slack
      integer :: i, k, n

      n = size(x)
      slack = same*max(maxval(x) - minval(x), maxval(z) - minval(z))
      do i = 1, n - 1
         do k = i + 1, n
            if (crosses(i, after(i), k, after(k))) then
               call problems%note('elevation_x: the edges after corners '//to_text(i)//' and '//to_text(k)//' cross, corners '// &
                  & 'must be in their order around the facade', out_of_range, 'elevation_x')
               return
            else if (touches(i, k)) then
               call problems%note('elevation_x: the edges after corners '//to_text(i)//' and '//to_text(k)//' touch or '// &
                  & 'overlap, each corner must be given once, in their order around the facade', out_of_range, 'elevation_x')
               return
            end if
         end do
      end do

   contains

      !> The corner after one
      pure integer function after(number)
         integer, intent(in) :: number

         after = modulo(number, n) + 1
      end function after

      !> Do two edges touch, but at the corner that both have?
      pure logical function touches(one, other)
         !> Numbers of the corners at which they begin
         integer, intent(in) :: one, other

         if (after(one) == other) then
            touches = near(one, other) .or. near(after(other), one)
         else if (after(other) == one) then
            touches = near(other, one) .or. near(after(one), other)
         else
            touches = near(one, other) .or. near(after(one), other) .or. near(other, one) .or. near(after(other), one)
         end if
      end function touches

      !> Is a corner on an edge?
      pure logical function near(corner, edge)
         !> Numbers of the corner, and of that at which the edge begins
         integer, intent(in) :: corner, edge

         real(wp) :: along(2), to(2)

         along = [x(after(edge)) - x(edge), z(after(edge)) - z(edge)]
         to = [x(corner) - x(edge), z(corner) - z(edge)]
         if (sum(along**2) > 0.0_wp) to = to - along*max(0.0_wp, min(1.0_wp, sum(to*along)/sum(along**2)))
         near = norm2(to) <= slack
      end function near

      !> Do two edges cross?
      pure logical function crosses(a, b, c, d)
         !> Numbers of the corners from and to which they go
         integer, intent(in) :: a, b, c, d

         crosses = side(a, b, c)*side(a, b, d) < 0.0_wp .and. side(c, d, a)*side(c, d, b) < 0.0_wp
      end function crosses

      !> On which side of the line through two corners a third one is
      pure real(wp) function side(a, b, c)
         !> Numbers of corners
         integer, intent(in) :: a, b, c

         side = sign(1.0_wp, (x(b) - x(a))*(z(c) - z(a)) - (z(b) - z(a))*(x(c) - x(a)))
         if (.not. abs((x(b) - x(a))*(z(c) - z(a)) - (z(b) - z(a))*(x(c) - x(a))) > 0.0_wp) side = 0.0_wp
      end function side

   end subroutine check_edges

end module dondolo_wall_elevation
