!> The sums behind a kinematic check, item by item, so that they can be made again by hand: of a wall that turns about its base its
!> storeys, wedges of transverse walls, loads, masses, thrusts and ties; of a corner its square and its wings in place of storeys;
!> of a strip that bends its two blocks, the load on top, and what acts between; of a chain its bodies, and what acts on and holds
!> them.
!>
!> A unit of rotation lifts an item by its arm and moves it outwards by its lever:
!>
!>     alpha_0 = [sum stabilising - sum overturning]/sum P lever          M* = (sum P lever)^2/(g sum P lever^2)
!>
!> The masonry of a wall that turns about its base is one rigid body, one point in the second sum (dondolo_check_kinematic); its
!> storeys stand in the others.
module dondolo_check_calculation
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_wall, only : wall_type
   use dondolo_wall_body, only : wall_body_type
   use dondolo_wall_chain, only : chain_type, motion_type, point_motion
   use dondolo_wall_chain_model, only : chain_model_type
   use dondolo_wall_chain_terms, only : set_at_rest
   use dondolo_wall_corner, only : body_of_wing, edge_of_corner
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_one_block_model, only : one_block_model_type
   use dondolo_wall_rigid_body, only : body_of_sections, rigid_body_type, same
   use dondolo_wall_tabulated_model, only : tabulated_model_type
   use dondolo_wall_travel, only : lever
   use dondolo_wall_two_block, only : two_block_type
   use dondolo_wall_two_block_model, only : two_block_model_type
   implicit none
   private

   public :: item_type, list_items, is_given, wedge_word, wing_word

   !> How the names of wedges of transverse walls begin, and those of the wings of a corner
   character(len=*), parameter :: wedge_word = 'wedge', wing_word = 'wing'

   !> Value of a number that an item does not have
   real(wp), parameter :: none = -huge(1.0_wp)

   !> A term of the sums, per metre of wall; of a chain and of a corner whole
   type :: item_type
      !> Name
      character(len=24) :: name = ''
      !> Weight P or Q, horizontal force outwards, or largest force of a tie [N/m]
      real(wp) :: force = none
      !> Depth behind the outer face [m]
      real(wp) :: depth = none
      !> Rise and horizontal travel for a unit of rotation [m]
      real(wp) :: arm = none, lever = none
      !> Terms of the sums [N m/m]; the last [N m2/m]
      real(wp) :: stabilising = none, overturning = none, first = none, second = none
   end type item_type

contains

   !> Has an item this number?
   elemental logical function is_given(number)
      real(wp), intent(in) :: number

      is_given = number > none
   end function is_given

   !> List the items of a wall; none of a mechanism that has no kinematic check
   subroutine list_items(wall, items)
      type(wall_type), intent(in) :: wall
      type(item_type), allocatable, intent(out) :: items(:)

      allocate (items(0))
      select type (model => wall%model)
      type is (one_block_model_type)
         call list_masonry(items, model%body, wall%gravity)
         call list_actions(items, model%body, wall%gravity)
         ! Of weights about an inclined axis only their share in the plane of the motion holds
         where (is_given(items%stabilising) .and. is_given(items%arm)) &
            & items%stabilising = model%body%actions%gravity_share*items%stabilising
      type is (two_block_model_type)
         select type (mechanism => wall%mechanism)
         type is (two_block_type)
            call list_blocks(items, mechanism)
            call list_points(items, mechanism, model, wall%gravity)
         end select
      type is (chain_model_type)
         call list_chain(items, model%chain)
         call list_ties(items, model%chain, wall%mechanism)
      class is (tabulated_model_type)
         call list_bodies(items, model, wall%mechanism%moment(0.0_wp))
      end select
   end subroutine list_items

   !> List the bodies of a chain and what acts on them. A vertical share c of gravity lifts a weight by c y'
   subroutine list_chain(items, chain)
      type(item_type), allocatable, intent(inout) :: items(:)
      type(chain_type), intent(in) :: chain

      type(motion_type) :: motion
      type(item_type) :: item
      real(wp) :: place(2), rate(2), second(2)
      integer :: i, loads, masses, thrusts

      call set_at_rest(chain, motion)
      do i = 1, size(chain%bodies)
         items = [items, weight_of('body '//to_text(i), chain%gravity*chain%bodies(i)%mass, motion%rate(:2, i))]
      end do
      loads = 0
      masses = 0
      thrusts = 0
      do i = 1, size(chain%actions)
         associate (action => chain%actions(i))
            call point_motion(chain, motion, action%body, action%at, place, rate, second)
            if (action%weight > 0.0_wp) then
               loads = loads + 1
               item = weight_of('load '//to_text(loads), action%weight, rate)
               if (action%is_held) then
                  item%lever = none
                  item%first = none
                  item%second = none
               end if
            else if (action%pushed > 0.0_wp) then
               masses = masses + 1
               item = weight_of('mass '//to_text(masses), chain%gravity*action%pushed, rate)
               item%arm = none
               item%stabilising = none
            else
               thrusts = thrusts + 1
               item = item_type('thrust '//to_text(thrusts), norm2(action%thrust))
               item%lever = sum(action%thrust*rate)/item%force
               ! A thrust that the mechanism pushes back holds it.
               if (item%lever >= 0.0_wp) then
                  item%overturning = item%force*item%lever
               else
                  item%stabilising = -item%force*item%lever
               end if
            end if
            items = [items, item]
         end associate
      end do

   contains

      !> A weight: what it rises and how far it moves outwards
      pure function weight_of(name, force, rate) result(item)
         character(len=*), intent(in) :: name
         !> [N], and velocity for a unit of rotation [m]
         real(wp), intent(in) :: force, rate(2)
         type(item_type) :: item

         associate (rise => chain%gravity_share*rate(2), moved => rate(1))
            item = item_type(name, force, arm=rise, lever=moved, stabilising=force*rise, first=force*moved, &
               & second=force*moved**2)
         end associate
      end function weight_of

   end subroutine list_chain

   !> List bodies and loads of a tabulated wall, and its moment, in which all that holds it and pushes it is one
   subroutine list_bodies(items, model, moment)
      type(item_type), allocatable, intent(inout) :: items(:)
      class(tabulated_model_type), intent(in) :: model
      !> At rest [N m/m]
      real(wp), intent(in) :: moment

      type(item_type) :: item
      integer :: i

      do i = 1, size(model%weight)
         item = item_type('body '//to_text(i), model%weight(i), lever=model%displacement(i))
         item%first = item%force*item%lever
         item%second = item%force*item%lever**2
         items = [items, item]
      end do
      if (size(items) > 0) items = [items, item_type('moment', stabilising=moment)]
   end subroutine list_bodies

   !> List the storeys and the wedges, and the masonry as one point
   subroutine list_masonry(items, wall, gravity)
      type(item_type), allocatable, intent(inout) :: items(:)
      type(wall_body_type), intent(in) :: wall
      !> [m/s2]
      real(wp), intent(in) :: gravity

      type(rigid_body_type) :: part, whole
      type(item_type) :: item
      real(wp) :: bottom, density
      integer :: i

      if (allocated(wall%corner)) then
         call list_corner(items, wall, gravity)
         return
      end if
      whole = body_of_sections(wall%sections, 1.0_wp)
      density = (wall%body%mass - sum(wall%wedges%body%mass))/whole%mass
      bottom = 0.0_wp
      ! A body whose centroid is given has no sections to sum.
      if (allocated(wall%facade)) then
         associate (facade => wall%facade)
            item = weighed('section 1', gravity*facade%mass, facade%depth, facade%height, wall%actions%hinge)
         end associate
         item%second = none
         items = [items, item]
         call list_wedges(items, wall, gravity)
      else if (size(wall%wedges) > 0 .or. abs(whole%height - wall%body%height) + abs(whole%depth - wall%body%depth) &
         & <= same*whole%height) then
         do i = 1, size(wall%sections)
            part = body_of_sections(wall%sections(i:i), density)
            item = weighed('section '//to_text(i), gravity*part%mass, part%depth, bottom + part%height, wall%actions%hinge)
            item%second = none
            items = [items, item]
            bottom = bottom + wall%sections(i)%height
         end do
         call list_wedges(items, wall, gravity)
      else
         item = weighed('section 1', gravity*wall%body%mass, wall%body%depth, wall%body%height, wall%actions%hinge)
         item%second = none
         items = [items, item]
      end if
      items = [items, as_one_point(wall, gravity)]
   end subroutine list_masonry

   !> List the wedges of transverse walls
   pure subroutine list_wedges(items, wall, gravity)
      type(item_type), allocatable, intent(inout) :: items(:)
      type(wall_body_type), intent(in) :: wall
      !> [m/s2]
      real(wp), intent(in) :: gravity

      type(item_type) :: item
      integer :: i

      do i = 1, size(wall%wedges)
         associate (wedge => wall%wedges(i)%body)
            item = weighed(wedge_word//' '//to_text(i), gravity*wedge%mass, wedge%depth, wedge%height, wall%actions%hinge)
         end associate
         item%second = none
         items = [items, item]
      end do
   end subroutine list_wedges

   !> List the square of a corner and its wings, and the masonry as one point
   subroutine list_corner(items, wall, gravity)
      type(item_type), allocatable, intent(inout) :: items(:)
      type(wall_body_type), intent(in) :: wall
      !> [m/s2]
      real(wp), intent(in) :: gravity

      type(rigid_body_type) :: part
      type(item_type) :: item
      integer :: i

      part = edge_of_corner(wall%corner)
      item = weighed('corner 1', gravity*part%mass, part%depth, part%height, wall%actions%hinge)
      item%second = none
      items = [items, item]
      part = body_of_wing(wall%corner)
      do i = 1, merge(2, 0, part%mass > 0.0_wp)
         item = weighed(wing_word//' '//to_text(i), gravity*part%mass, part%depth, part%height, wall%actions%hinge)
         item%second = none
         items = [items, item]
      end do
      items = [items, as_one_point(wall, gravity)]
   end subroutine list_corner

   !> The masonry as one point, which its parts are in the sums of moments
   pure function as_one_point(wall, gravity) result(item)
      type(wall_body_type), intent(in) :: wall
      !> [m/s2]
      real(wp), intent(in) :: gravity
      type(item_type) :: item

      item = weighed('masonry', gravity*wall%body%mass, wall%body%depth, wall%body%height, wall%actions%hinge)
      item%stabilising = none
      item%first = none
   end function as_one_point

   !> List the ties of a chain
   subroutine list_ties(items, chain, mechanism)
      type(item_type), allocatable, intent(inout) :: items(:)
      type(chain_type), intent(in) :: chain
      !> Has them
      class(mechanism_type), intent(in) :: mechanism

      type(item_type) :: item
      integer :: i

      do i = 1, mechanism%ties
         associate (tie => mechanism%restraints(i))
            item = item_type('tie '//to_text(i), tie%strength, 0.0_wp - chain%ties(i)%at(1), lever=tie%lever_at(0.0_wp))
            item%stabilising = item%force*item%lever
            items = [items, item]
         end associate
      end do
   end subroutine list_ties

   !> List what acts on a wall
   subroutine list_actions(items, wall, gravity)
      type(item_type), allocatable, intent(inout) :: items(:)
      type(wall_body_type), intent(in) :: wall
      !> [m/s2]
      real(wp), intent(in) :: gravity

      type(item_type) :: item
      integer :: i, masses, friction

      masses = 0
      associate (hinge => wall%actions%hinge, edge => wall%actions%edge)
         do i = 1, size(wall%actions%carried)
            associate (load => wall%actions%carried(i))
               if (load%weight > 0.0_wp) then
                  item = weighed('load '//to_text(i), load%weight, load%depth, load%height, hinge)
               else
                  ! A mass that the wall only pushes lifts nothing
                  masses = masses + 1
                  item = weighed('mass '//to_text(masses), gravity*load%pushed, load%depth, load%height, hinge)
                  item%stabilising = none
               end if
               items = [items, item]
            end associate
         end do
         do i = 1, size(wall%actions%thrusts)
            associate (thrust => wall%actions%thrusts(i))
               items = [items, item_type('thrust '//to_text(i), thrust%force, thrust%depth, lever=thrust%height, &
                  & overturning=thrust%force*thrust%height)]
            end associate
         end do
         friction = 0
         do i = 1, size(wall%actions%restraints)
            associate (tie => wall%actions%restraints(i))
               if (tie%is_friction) friction = friction + 1
               item = item_type('tie '//to_text(i), tie%strength, tie%e + hinge, lever=lever(edge, tie%e, tie%f, 0.0_wp))
               if (tie%is_friction) item%name = 'friction '//to_text(friction)
               item%stabilising = item%force*item%lever
               items = [items, item]
            end associate
         end do
      end associate
   end subroutine list_actions

   !> A weight that goes with the wall
   pure function weighed(name, force, depth, height, hinge) result(item)
      character(len=*), intent(in) :: name
      !> [N/m]
      real(wp), intent(in) :: force
      !> Place, and depth of the hinge [m]
      real(wp), intent(in) :: depth, height, hinge
      type(item_type) :: item

      item = item_type(name, force, depth, depth - hinge, height, force*(depth - hinge), none, force*height, force*height**2)
   end function weighed

   !> List the blocks of a strip, and the load on top, which a floor holds sideways: with T = r/(1 - r) they rise by w, w (2 + T)
   !> and w (2 + T) + e T
   subroutine list_blocks(items, strip)
      type(item_type), allocatable, intent(inout) :: items(:)
      type(two_block_type), intent(in) :: strip

      real(wp) :: travel, ratio, rise
      integer :: i

      associate (lower => strip%lower, upper => strip%upper, w => strip%lower%b, load => strip%overburden)
         travel = lower%radius*cos(lower%alpha)
         ratio = travel/(upper%radius*cos(upper%alpha))
         rise = w*(2.0_wp + ratio)
         items = [item_type('lower block', strip%gravity*lower%mass, arm=w, lever=travel), &
            & item_type('upper block', strip%gravity*upper%mass, arm=rise, lever=travel)]
         if (load%weight > 0.0_wp) items = [items, item_type('load on top', load%weight, arm=rise + load%eccentricity*ratio, &
            & lever=0.0_wp)]
      end associate
      do i = 1, size(items)
         items(i)%stabilising = items(i)%force*items(i)%arm
         items(i)%first = items(i)%force*items(i)%lever
         items(i)%second = items(i)%force*items(i)%lever**2
      end do
   end subroutine list_blocks

   !> List what acts on a strip between base and top. Loads stand with their weight, and in the last sums with that of their mass
   !> that moves
   subroutine list_points(items, strip, model, gravity)
      type(item_type), allocatable, intent(inout) :: items(:)
      type(two_block_type), intent(in) :: strip
      type(two_block_model_type), intent(in) :: model
      !> [m/s2]
      real(wp), intent(in) :: gravity

      type(item_type) :: item
      real(wp) :: ratio
      integer :: i, loads, masses

      loads = 0
      masses = 0
      ratio = strip%lower%radius*cos(strip%lower%alpha)/(strip%upper%radius*cos(strip%upper%alpha))
      associate (actions => model%body%actions)
         do i = 1, size(actions%carried)
            associate (thing => actions%carried(i), point => strip%points(i), moving => model%strip%points(i)%moving)
               item = item_type(depth=thing%depth, lever=strip%lever_of(0.0_wp, point%e, point%f, point%is_upper))
               if (thing%weight > 0.0_wp) then
                  loads = loads + 1
                  item%name = 'load '//to_text(loads)
                  item%force = thing%weight
                  item%arm = merge(2.0_wp*strip%lower%b*(1.0_wp + ratio) - ratio*point%e, point%e, point%is_upper)
                  item%stabilising = item%force*item%arm
               else
                  masses = masses + 1
                  item%name = 'mass '//to_text(masses)
                  item%force = gravity*thing%pushed
               end if
               if (moving > 0.0_wp) then
                  item%first = moving*item%lever
                  item%second = moving*item%lever**2
               end if
               items = [items, item]
            end associate
         end do
         do i = 1, size(actions%thrusts)
            associate (thrust => actions%thrusts(i), point => strip%points(size(actions%carried) + i))
               item = item_type('thrust '//to_text(i), thrust%force, thrust%depth, &
                  & lever=strip%lever_of(0.0_wp, point%e, point%f, point%is_upper))
               item%overturning = item%force*item%lever
               items = [items, item]
            end associate
         end do
         do i = 1, strip%ties
            associate (tie => strip%restraints(i))
               item = item_type('tie '//to_text(i), tie%strength, tie%e + actions%hinge, lever=tie%lever_at(0.0_wp))
               item%stabilising = item%force*item%lever
               items = [items, item]
            end associate
         end do
      end associate
   end subroutine list_points

end module dondolo_check_calculation
