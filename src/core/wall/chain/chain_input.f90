!> The rows of a chain: bodies, joints and what acts on it, as numbers.
!>
!> Depths are those of walls, from the outer face inwards: x = -depth. Angles are in degrees from outwards to upwards.
module dondolo_wall_chain_input
   use dondolo_base_error, only : not_given, not_together, out_of_range, problems_type, wrong_length
   use dondolo_base_kinds, only : pi, wp
   use dondolo_base_text, only : rounded, to_text
   use dondolo_wall_chain, only : chain_action_type, chain_type, guide, is_guide, is_pin, pin
   use dondolo_wall_chain_masonry, only : find_nearest, masonry_type
   use dondolo_wall_chain_overlap, only : outline_type
   use dondolo_wall_chain_part, only : chain_mass_type, point_mass, polygon, sector, together
   use dondolo_wall_chain_ties, only : read_chain_ties, tie_numbers
   implicit none
   private

   public :: chain_rows_type, read_chain

   !> Bodies that a chain can have
   integer, parameter, public :: most_bodies = 8

   !> Numbers of a row: body, part, kind, width, density, depth, height, and four that depend on the kind (none of a corner; mass
   !> and inertia; radii and angles of a sector)
   integer, parameter, public :: body_numbers = 11

   !> Kinds of rows of bodies
   integer, parameter, public :: is_corner = 0, is_mass = 1, is_sector = 2

   !> Kind (2: pin, 1: guide), body, other, depth, height, angle, and depth and height of the point of the other
   integer, parameter, public :: joint_numbers = 8

   !> Body, depth, height, load, part of it lifted, part of it pushed, mass that is only pushed, thrust, its angle, 1 if something
   !> else holds the load sideways
   integer, parameter, public :: action_numbers = 10

   !> Rows of a chain, one after the other
   type :: chain_rows_type
      real(wp), allocatable :: bodies(:), joints(:), actions(:), ties(:)
   end type chain_rows_type

   !> Densities that masonry, and what is carried, can have [kg/m3]
   real(wp), parameter :: least_density = 100.0_wp, most_density = 1.0e4_wp

   !> Convex slices that the outline of a sector is cut into
   integer, parameter :: slices = 12

   !> How far a pin may lie from the outlines of its bodies [m], and / height: those of sectors have straight sides
   real(wp), parameter :: least_gap = 1.0e-3_wp, height_gap = 0.01_wp

   !> How far what acts on a body may lie from its outlines, such as on a corbel [m]
   real(wp), parameter :: corbel = 0.5_wp

contains

   !> Read a chain
   subroutine read_chain(chain, masonry, rows, height, problems)
      !> Its driver and gravity are known
      type(chain_type), intent(inout) :: chain
      !> Parts of all bodies, and of masonry that stands still
      type(masonry_type), intent(out) :: masonry
      type(chain_rows_type), intent(in) :: rows
      !> Height of the wall [m]
      real(wp), intent(in) :: height
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems

      integer :: equations

      allocate (chain%bodies(0), chain%joints(0), chain%actions(0))
      allocate (masonry%outlines(0), masonry%parts(0), masonry%body(0), masonry%standing(0))
      call check_size('body_table', size(rows%bodies), body_numbers)
      call check_size('joint_table', size(rows%joints), joint_numbers)
      call check_size('action_table', size(rows%actions), action_numbers)
      call check_size('tie_table', size(rows%ties), tie_numbers)
      if (problems%count > 0) return
      call read_bodies(chain, masonry, as_rows(rows%bodies, body_numbers), problems)
      if (problems%count > 0) return
      if (chain%driver > size(chain%bodies)) call problems%note('driver = '//to_text(chain%driver)//': must be one of '// &
         & to_text(size(chain%bodies))//' bodies', out_of_range, 'driver')
      call read_joints(chain, as_rows(rows%joints, joint_numbers), problems)
      call read_actions(chain, masonry, as_rows(rows%actions, action_numbers), problems)
      call read_chain_ties(chain, rows%ties, problems)
      if (problems%count > 0) return
      call check_places(chain, masonry, as_rows(rows%bodies, body_numbers), max(least_gap, height_gap*height), &
         & problems)
      if (problems%count > 0) return
      equations = sum(chain%joints%kind)
      associate (n => size(chain%bodies))
         if (equations < 3*n - 1) then
            call problems%note('joints: '//to_text(n)//' bodies with '//to_text(equations)//' equations have '//to_text(3*n)// &
               & ' - '//to_text(equations)//' = '//to_text(3*n - equations)//' degrees of freedom, must have 1: a pin (2) or a '// &
               & 'guide (1) is missing', out_of_range, 'joints')
         else if (equations > 3*n - 1) then
            call problems%note('joints: '//to_text(n)//' bodies with '//to_text(equations)//' equations have '//to_text(3*n)// &
               & ' - '//to_text(equations)//' = '//to_text(3*n - equations)//' degrees of freedom, must have 1: it is a '// &
               & 'structure, not a mechanism', out_of_range, 'joints')
         end if
      end associate

   contains

      !> Check that a list is made of whole rows
      subroutine check_size(name, length, numbers)
         character(len=*), intent(in) :: name
         integer, intent(in) :: length, numbers

         if (modulo(length, numbers) /= 0) call problems%note(name//': has '//to_text(length)//' values, must have rows of '// &
            & to_text(numbers), wrong_length, name)
      end subroutine check_size

      !> A list as rows
      pure function as_rows(list, numbers) result(table)
         real(wp), intent(in) :: list(:)
         integer, intent(in) :: numbers
         real(wp), allocatable :: table(:, :)

         table = reshape(list, [numbers, size(list)/numbers])
      end function as_rows

   end subroutine read_chain

   !> Read the bodies: those of one number are one body, corners of one part one polygon; those of body 0 stand still
   subroutine read_bodies(chain, masonry, rows, problems)
      type(chain_type), intent(inout) :: chain
      type(masonry_type), intent(inout) :: masonry
      real(wp), intent(in) :: rows(:, :)
      type(problems_type), intent(inout) :: problems

      type(chain_mass_type), allocatable :: parts(:)
      type(outline_type), allocatable :: pieces(:)
      integer :: body, first, last, most

      if (size(rows, 2) == 0) return
      if (any(abs(rows(1, :) - anint(rows(1, :))) > 0.0_wp .or. rows(1, :) < 0.0_wp) .or. &
         & maxval(rows(1, :)) > real(most_bodies, wp) .or. maxval(rows(1, :)) < 1.0_wp) then
         call problems%note('bodies: their numbers must be integers from 1 to '//to_text(most_bodies)//', 0 of masonry that '// &
            & 'stands still', out_of_range, 'bodies')
         return
      end if
      most = nint(maxval(rows(1, :)))
      do body = 0, most
         if (body > 0 .and. .not. any(nint(rows(1, :)) == body)) then
            call problems%note('bodies: body '//to_text(body)//' has no rows, but body '//to_text(most)//' has', not_given, &
               & 'bodies')
            return
         end if
         ! Openings and masses that are given make one part of a body: it is not known what could come off.
         associate (is_whole => any(nint(rows(1, :)) == body .and. (nint(rows(3, :)) == is_mass .or. rows(4, :) < 0.0_wp)), &
            & before => size(masonry%parts))
            if (is_whole .and. body == 0) then
               call problems%note('bodies: body 0 stands still, its parts must be polygons or sectors of masonry', out_of_range, &
                  & 'bodies')
               return
            end if
            parts = [chain_mass_type ::]
            last = 0
            do while (last < size(rows, 2))
               first = last + 1
               last = first
               if (nint(rows(3, first)) == is_corner) then
                  do while (last < size(rows, 2))
                     if (any(nint(rows(:3, last + 1)) /= nint(rows(:3, first)))) exit
                     last = last + 1
                  end do
               end if
               if (nint(rows(1, first)) /= body) cycle
               call read_part(rows(:, first:last), parts, pieces, problems)
               if (problems%count > 0) return
               pieces%part = before + merge(1, size(parts), is_whole)
               if (rows(4, first) > 0.0_wp) masonry%outlines = [masonry%outlines, pieces]
            end do
            if (body > 0) then
               chain%bodies = [chain%bodies, together(parts)]
               if (.not. (chain%bodies(body)%mass > 0.0_wp .and. chain%bodies(body)%inertia > 0.0_wp)) call problems%note( &
                  & 'bodies: body '//to_text(body)//' has a mass of '//rounded(chain%bodies(body)%mass)//' kg and an inertia '// &
                  & 'of '//rounded(chain%bodies(body)%inertia)//' kg m2, both must be positive', out_of_range, 'bodies')
               if (is_whole) parts = chain%bodies(body:body)
            end if
            masonry%parts = [masonry%parts, parts]
            masonry%body = [masonry%body, spread(body, 1, size(parts))]
         end associate
      end do
   end subroutine read_bodies

   !> Read a part
   subroutine read_part(rows, parts, pieces, problems)
      !> Its row, or those of its corners
      real(wp), intent(in) :: rows(:, :)
      type(chain_mass_type), allocatable, intent(inout) :: parts(:)
      !> Its outline, in one piece or several; of size 0: it has none
      type(outline_type), allocatable, intent(out) :: pieces(:)
      type(problems_type), intent(inout) :: problems

      real(wp), allocatable :: corners(:, :)
      real(wp) :: angles(2)
      integer :: i

      associate (row => rows(:, 1), at => [-rows(6, 1), rows(7, 1)], density => rows(4, 1)*rows(5, 1))
         allocate (pieces(0))
         if (nint(row(3)) /= is_mass .and. (row(5) < least_density .or. row(5) > most_density)) then
            call problems%note('bodies: a part of body '//to_text(nint(row(1)))//' has a density of '//rounded(row(5))// &
               & ' kg/m3, must lie between '//rounded(least_density)//' and '//rounded(most_density)// &
               & trim(merge(': is it in kN/m3? ', ': is it in N/m3?  ', row(5) < least_density)), out_of_range, 'bodies')
            return
         end if
         select case (nint(row(3)))
         case (is_mass)
            parts = [parts, point_mass(row(8), at, row(9))]
         case (is_sector)
            angles = row(10:11)*pi/180.0_wp
            if (.not. (row(8) >= 0.0_wp .and. row(9) > row(8) .and. abs(row(11) - row(10)) > 0.0_wp &
               & .and. abs(row(11) - row(10)) <= 360.0_wp)) then
               call problems%note('bodies: a sector of body '//to_text(nint(row(1)))//' has radii of '//rounded(row(8))//' and '// &
                  & rounded(row(9))//' m and angles of '//rounded(row(10))//' and '//rounded(row(11))//' deg, the second must '// &
                  & 'be another', out_of_range, 'bodies')
               return
            end if
            parts = [parts, sector(at, row(8:9), angles, density)]
            do i = 1, slices
               corners = reshape([at + row(8)*direction(i - 1), at + row(8)*direction(i), at + row(9)*direction(i), &
                  & at + row(9)*direction(i - 1)], [2, 4])
               pieces = [pieces, outline_type(nint(row(1)), corners=corners)]
            end do
         case default
            corners = rows(6:7, :)
            corners(1, :) = -corners(1, :)
            if (size(rows, 2) < 3) then
               call problems%note('bodies: a part of body '//to_text(nint(row(1)))//' has '//to_text(size(rows, 2))// &
                  & ' corners, must have 3 at least', wrong_length, 'bodies')
               return
            end if
            parts = [parts, polygon(corners, density)]
            pieces = [outline_type(nint(row(1)), corners=corners)]
            if (abs(parts(size(parts))%mass) > 0.0_wp) return
            call problems%note('bodies: a part of body '//to_text(nint(row(1)))//' has no area, width or density', out_of_range, &
               & 'bodies')
         end select
      end associate

   contains

      !> Direction of a corner on an arc
      pure function direction(i)
         integer, intent(in) :: i
         real(wp) :: direction(2)

         associate (angle => angles(1) + (angles(2) - angles(1))*real(i, wp)/real(slices, wp))
            direction = [cos(angle), sin(angle)]
         end associate
      end function direction

   end subroutine read_part

   !> Read the joints
   subroutine read_joints(chain, rows, problems)
      type(chain_type), intent(inout) :: chain
      real(wp), intent(in) :: rows(:, :)
      type(problems_type), intent(inout) :: problems

      integer :: i

      do i = 1, size(rows, 2)
         associate (row => rows(:, i), ends => nint(rows(2:3, i)), at => [-rows(4, i), rows(5, i)])
            if (any(ends < 0) .or. any(ends > size(chain%bodies)) .or. ends(1) == ends(2)) then
               call problems%note('joints: joint '//to_text(i)//' is between '//to_text(ends(1))//' and '//to_text(ends(2))// &
                  & ', must be between two of '//to_text(size(chain%bodies))//' bodies, or one and 0, the ground', out_of_range, &
                  & 'joints')
            else if (nint(row(1)) == is_pin) then
               chain%joints = [chain%joints, pin(ends(1), ends(2), at)]
            else if (nint(row(1)) == is_guide) then
               chain%joints = [chain%joints, guide(ends(1), ends(2), at, row(6)*pi/180.0_wp, [-row(7), row(8)])]
            else
               call problems%note('joints: joint '//to_text(i)//' is of kind '//rounded(row(1))//', must be 2 (pin) or 1 (guide)', &
                  & out_of_range, 'joints')
            end if
         end associate
      end do
   end subroutine read_joints

   !> Read the actions
   subroutine read_actions(chain, masonry, rows, problems)
      type(chain_type), intent(inout) :: chain
      type(masonry_type), intent(inout) :: masonry
      real(wp), intent(in) :: rows(:, :)
      type(problems_type), intent(inout) :: problems

      type(chain_action_type) :: action
      integer :: i

      do i = 1, size(rows, 2)
         associate (row => rows(:, i))
            if (nint(row(1)) < 0 .or. nint(row(1)) > size(chain%bodies) .or. &
               & (nint(row(1)) == 0 .and. .not. any(masonry%body == 0))) then
               call problems%note('actions: action '//to_text(i)//' is on body '//to_text(nint(row(1)))//', must be one of '// &
                  & to_text(size(chain%bodies)), out_of_range, 'actions')
            else if (any(row([4, 7, 8]) < 0.0_wp) .or. any(row(5:6) < 0.0_wp) .or. any(row(5:6) > 1.0_wp)) then
               call problems%note('actions: action '//to_text(i)//' has a negative load, mass or thrust, or parts beyond 0 and 1', &
                  & out_of_range, 'actions')
            else if (count(row([4, 7, 8]) > 0.0_wp) /= 1) then
               call problems%note('actions: action '//to_text(i)//' must be one of a load, a mass and a thrust', not_together, &
                  & 'actions')
            else
               action = chain_action_type(body=nint(row(1)), at=[-row(2), row(3)], weight=row(4))
               action%lifted = row(5)*row(4)/chain%gravity
               action%pushed = row(6)*row(4)/chain%gravity + row(7)
               action%thrust = row(8)*[cosine(row(9)), cosine(row(9) - 90.0_wp)]
               action%is_held = nint(row(10)) == 1
               if (action%body > 0) then
                  chain%actions = [chain%actions, action]
               else
                  masonry%standing = [masonry%standing, action]
               end if
            end if
         end associate
      end do

   contains

      !> Cosine of degrees, exact at right angles: a horizontal thrust lifts nothing
      pure real(wp) function cosine(angle)
         real(wp), intent(in) :: angle

         cosine = cos(angle*pi/180.0_wp)
         if (.not. abs(modulo(angle, 180.0_wp) - 90.0_wp) > 0.0_wp) cosine = 0.0_wp
      end function cosine

   end subroutine read_actions

   !> Check that pins lie on their bodies, and that what acts on a body is at it
   subroutine check_places(chain, masonry, rows, gap, problems)
      type(chain_type), intent(in) :: chain
      type(masonry_type), intent(in) :: masonry
      !> Rows of the bodies: one that has a given mass has an outline that is not known
      real(wp), intent(in) :: rows(:, :)
      !> How far a pin may lie from a body [m]
      real(wp), intent(in) :: gap
      type(problems_type), intent(inout) :: problems

      integer :: ends(2), i, k

      do i = 1, size(chain%joints)
         if (chain%joints(i)%kind /= is_pin) cycle
         ends = [chain%joints(i)%body, chain%joints(i)%other]
         do k = 1, 2
            ! Body 0 is the ground too, which has no outline.
            if (ends(k) > 0) call check_place('joints: joint '//to_text(i)//', a pin,', ends(k), chain%joints(i)%at, gap, 'joints')
         end do
      end do
      do i = 1, size(chain%actions)
         call check_place('actions: the action', chain%actions(i)%body, chain%actions(i)%at, corbel, 'actions')
      end do
      do i = 1, size(chain%ties)
         associate (tie => chain%ties(i))
            call check_place('ties: tie '//to_text(i), tie%body, tie%at, corbel, 'ties')
            if (tie%other > 0) call check_place('ties: tie '//to_text(i), tie%other, tie%other_at, corbel, 'ties')
         end associate
      end do
      do i = 1, size(masonry%standing)
         call check_place('actions: the action', 0, masonry%standing(i)%at, corbel, 'actions')
      end do

   contains

      !> Check the distance of a point from a body
      subroutine check_place(what, body, at, most, name)
         !> What lies there, and the table that has it
         character(len=*), intent(in) :: what, name
         integer, intent(in) :: body
         !> The point, and its largest distance [m]
         real(wp), intent(in) :: at(2), most

         real(wp) :: distance
         integer :: part

         if (any(nint(rows(1, :)) == body .and. nint(rows(3, :)) == is_mass)) return
         call find_nearest(masonry, body, at, part, distance)
         if (part > 0 .and. distance > most) call problems%note(what//' at depth '//rounded(0.0_wp - at(1))//' m, height '// &
            & rounded(at(2))//' m is '//rounded(distance)//' m off body '//to_text(body)//', must be at most '//rounded(most)// &
            & ' m', out_of_range, name)
      end subroutine check_place

   end subroutine check_places

end module dondolo_wall_chain_input
