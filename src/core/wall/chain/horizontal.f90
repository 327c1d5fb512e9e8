!> Horizontal bending of a wall between two transverse walls (flessione orizzontale): its properties, and the chain that it is.
!>
!> A band of 1 m height bends as an arch of two leaves L_1 and L_2 in its thickness t. Its ends are held by a constant thrust H per
!> metre of height, its hinges lie u behind the faces, and its weight W neither holds nor pushes it. Pushes F at places x lower the
!> multiplier, whose least gives the place of the hinge between the leaves:
!>
!>     alpha_0 = [H (t - 2 u) (1 + L_1/L_2) - sum F min(x, L_1/L_2 (L - x))]/(W L_1/2)
!>
!> The plane of the motion is the plan: heights of the chain are places along the wall (docs/chains.md).
module dondolo_wall_horizontal
   use dondolo_base_error, only : not_given, out_of_range, problems_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : blank, choices_length, is_list, most_choices, name_length, property_type
   use dondolo_base_settings, only : settings_type
   use dondolo_base_text, only : rounded, to_text
   use dondolo_wall_chain, only : is_guide, is_pin
   use dondolo_wall_chain_input, only : action_numbers, body_numbers, chain_rows_type, joint_numbers
   use dondolo_wall_hinge_depth, only : check_hinge, read_hinge_depth
   use dondolo_wall_lists, only : take
   use dondolo_wall_tabulated_model, only : horizontal_name
   implicit none
   private

   public :: check_horizontal, horizontal_rows, read_horizontal, take_length

   !> Owners of what it alone has
   character(len=choices_length), parameter :: horizontal(most_choices) = reshape([horizontal_name], [most_choices], pad=blank)

   !> Its properties
   type(property_type), parameter :: horizontal_rows(*) = [ &
      & property_type('length', unit='m', owners=horizontal, optional=.true., positive=.true., smallest=0.1_wp, &
      &   largest=1.0e3_wp, usual_most=30.0_wp, example='5.0', &
      &   meaning='length of a wall that bends horizontally, between the transverse walls'), &
      & property_type('end_thrust', unit='N/m', owners=horizontal, optional=.true., positive=.true., largest=1.0e9_wp, &
      &   usual_least=500.0_wp, usual_most=1.0e6_wp, example='25.0e3', &
      &   meaning='thrust that holds both its ends, per metre of height: the least of what ties and transverse walls can '// &
      &   'take'), &
      & property_type('hinge_x', unit='m', owners=horizontal, optional=.true., positive=.true., largest=1.0e3_wp, &
      &   example='2.2', meaning='place of the hinge along it, from its first end', more='where it is weakest if not given'), &
      & property_type('push', is_list, unit='N/m', owners=horizontal, optional=.true., smallest=0.0_wp, largest=1.0e9_wp, &
      &   usual_most=1.0e5_wp, example='400.0', &
      &   meaning='forces that push it outwards, per metre of height, such as thrusts of a roof'), &
      & property_type('push_x', is_list, unit='m', owners=horizontal, optional=.true., positive=.true., largest=1.0e3_wp, &
      &   one_each=.true., example='1.5', meaning='places of these forces along it, from its first end')]

   !> Places of the hinge that are compared in each interval between pushes, halvings of the step about the best of them, and what
   !> the place is a whole number of / metre, since the multiplier is flat there
   integer, parameter :: places = 200, halvings = 60
   real(wp), parameter :: micrometres = 1.0e6_wp

contains

   !> Before defaults are filled in: its length is what others have as their height
   subroutine take_length(input, problems)
      !> Settings of the wall
      class(settings_type), intent(inout) :: input
      !> Takes what does not agree
      type(problems_type), intent(inout) :: problems

      if (input%has('length') .and. input%has('height')) then
         if (abs(input%number('height') - input%number('length')) > 0.0_wp) call problems%note('height = '// &
            & to_text(input%number('height'))//': must be '//to_text(input%number('length'))//', the length; leave it out', &
            & out_of_range, 'height')
      end if
      ! Without a length, that is what is asked for, and no height.
      if (input%has('length')) then
         call input%set('height', input%number('length'))
      else if (.not. input%has('height')) then
         call input%set('height', 1.0_wp)
      end if
   end subroutine take_length

   !> Check that all that it needs is given
   subroutine check_horizontal(input, problems)
      !> Settings of the wall
      class(settings_type), intent(in) :: input
      !> Takes what is missing
      type(problems_type), intent(inout) :: problems

      if (.not. input%has('length')) call problems%note('length: must be given with mechanism = ''horizontal'', between the '// &
         & 'transverse walls', not_given, 'length')
      if (.not. input%has('end_thrust')) call problems%note('end_thrust: must be given with mechanism = ''horizontal'', which '// &
         & 'nothing else holds', not_given, 'end_thrust')
      if (.not. (input%has('hinge_depth') .or. input%has('compressive_strength'))) call problems%note('hinge_depth: must be '// &
         & 'given with mechanism = ''horizontal'', or compressive_strength in its place', not_given, 'hinge_depth')
   end subroutine check_horizontal

   !> The chain of a wall, as rows
   subroutine read_horizontal(input, problems, rows, depth)
      !> Settings of the wall, ranges checked; out: the place of its hinge is one of them
      class(settings_type), intent(inout) :: input
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      type(chain_rows_type), intent(out) :: rows
      !> Depth of its hinges behind the faces [m]
      real(wp), intent(out) :: depth

      character(len=name_length) :: name
      real(wp), allocatable :: push(:), at(:)
      real(wp) :: hinge
      integer :: i

      associate (length => input%number('length'), thickness => input%number('thickness'), thrust => input%number('end_thrust'))
         call read_hinge_depth(input, thrust, problems, depth, name)
         call check_hinge(input, problems, name, depth, 0.5_wp*thickness, 'half of the thickness, '// &
            & rounded(0.5_wp*thickness)//' m', 'thickness')
         push = input%list('push')
         call take(input, problems, 'push_x', 'push', at)
         do i = 1, size(at)
            if (at(i) > 0.0_wp .and. .not. at(i) < length) call problems%note('push_x = '//to_text(at(i))//': must lie within '// &
               & 'the length of '//to_text(length)//' m', out_of_range, 'push_x')
         end do
         hinge = input%number('hinge_x')
         if (input%has('hinge_x') .and. .not. hinge < length) call problems%note('hinge_x = '//to_text(hinge)//': must lie '// &
            & 'within the length of '//to_text(length)//' m', out_of_range, 'hinge_x')
         if (problems%count > 0) return
         if (.not. input%has('hinge_x')) hinge = weakest_place(length, thickness*input%number('density'), &
            & thrust*(thickness - 2.0_wp*depth), push, at)
         ! The same in results, and in 33 digits
         call input%set('hinge_x', hinge)
         rows%bodies = [leaf(1, 0.0_wp, hinge), leaf(2, hinge, length)]
         rows%joints = [joint(is_pin, 0, depth, 0.0_wp), joint(is_pin, 2, thickness - depth, hinge), &
            & joint(is_guide, 0, depth, length)]
         rows%actions = [force(2, depth, length, thrust, -90.0_wp)]
         do i = 1, size(push)
            if (push(i) > 0.0_wp) rows%actions = [rows%actions, force(merge(2, 1, at(i) > hinge), thickness, at(i), push(i), &
               & 0.0_wp)]
         end do
         allocate (rows%ties(0))
      end associate

   contains

      !> Corners of a leaf between two places
      function leaf(body, first, last) result(corners)
         integer, intent(in) :: body
         !> [m]
         real(wp), intent(in) :: first, last
         real(wp) :: corners(4*body_numbers)

         real(wp) :: table(body_numbers, 4)

         table = 0.0_wp
         ! The first part of its body, 1 m wide
         table(1, :) = real(body, wp)
         table(2, :) = 1.0_wp
         table(4, :) = 1.0_wp
         table(5, :) = input%number('density')
         table(6, :) = [0.0_wp, input%number('thickness'), input%number('thickness'), 0.0_wp]
         table(7, :) = [first, first, last, last]
         corners = reshape(table, [size(table)])
      end function leaf

      !> A joint of the first leaf, or a guide of the second
      pure function joint(kind, other, at_depth, place) result(row)
         integer, intent(in) :: kind, other
         !> [m]
         real(wp), intent(in) :: at_depth, place
         real(wp) :: row(joint_numbers)

         row = [real(kind, wp), real(merge(1, 2, kind == is_pin), wp), real(other, wp), at_depth, place, 0.0_wp, at_depth, place]
      end function joint

      !> A thrust
      pure function force(body, at_depth, place, size_of, angle) result(row)
         integer, intent(in) :: body
         !> [m], [N], [deg]
         real(wp), intent(in) :: at_depth, place, size_of, angle
         real(wp) :: row(action_numbers)

         row = 0.0_wp
         row([1, 2, 3, 8, 9]) = [real(body, wp), at_depth, place, size_of, angle]
      end function force

   end subroutine read_horizontal

   !> Place of the hinge at which the multiplier is least [m]
   real(wp) function weakest_place(length, weight, moment, push, at) result(best)
      !> [m]; mass per metre of it, whose size does not matter
      real(wp), intent(in) :: length, weight
      !> H (t - 2 u) [N m]; forces [N], and their places [m]
      real(wp), intent(in) :: moment, push(:), at(:)

      real(wp) :: ends(0:size(at) + 1), step, here, least, trial(3)
      integer :: i, k

      best = 0.5_wp*length
      if (size(push) == 0) return
      ends(0) = 0.0_wp
      ends(size(at) + 1) = length
      do i = 1, size(at)
         ! Behind those that are nearer to the first end
         k = i
         do while (ends(k - 1) > at(i))
            ends(k) = ends(k - 1)
            k = k - 1
         end do
         ends(k) = at(i)
      end do
      least = huge(1.0_wp)
      step = 0.0_wp
      do i = 0, size(at)
         step = max(step, ends(i + 1) - ends(i))
         do k = 0, places
            here = ends(i) + (ends(i + 1) - ends(i))*real(k, wp)/real(places, wp)
            if (here > 0.0_wp .and. here < length) call compare(here)
         end do
      end do
      step = step/real(places, wp)
      do i = 1, halvings
         step = 0.5_wp*step
         trial = [best, best - step, best + step]
         do k = 2, 3
            if (trial(k) > 0.0_wp .and. trial(k) < length) call compare(trial(k))
         end do
      end do
      best = anint(best*micrometres)/micrometres

   contains

      !> Take a place if it is weaker than the best so far
      subroutine compare(place)
         !> [m]
         real(wp), intent(in) :: place

         real(wp) :: ratio, multiplier

         ratio = place/(length - place)
         multiplier = (moment*(1.0_wp + ratio) - sum(push*min(at, ratio*(length - at))))/(0.5_wp*weight*place*length)
         if (.not. multiplier < least) return
         least = multiplier
         best = place
      end subroutine compare

   end function weakest_place

end module dondolo_wall_horizontal
