!> The masonry of a chain as parts that may all move, those that stand still in its mechanism among them: whether it is its own
!> mirror image, and the impact on all of its joints.
!>
!> Joints are the edges that the outlines of two parts share, and on the ground those at which a hinge opens. Where a hinge lies
!> within its joint, by the depth of the crushed edge, joints open as far from both of their ends.
module dondolo_wall_chain_masonry
   use dondolo_base_kinds, only : wp
   use dondolo_wall_chain, only : chain_action_type, chain_type, is_pin, motion_type
   use dondolo_wall_chain_impact, only : attached_type, cone_ratio, contact_type, velocity_of
   use dondolo_wall_chain_overlap, only : is_within, outline_type
   use dondolo_wall_chain_part, only : chain_mass_type
   use dondolo_wall_chain_terms, only : set_at_rest
   implicit none
   private

   public :: find_nearest, impact_bound, is_symmetric, masonry_type

   !> How near points of one joint are [m]
   real(wp), parameter :: near = 1.0e-6_wp

   !> Parts of masonry
   type :: masonry_type
      !> Outlines of masonry; openings have none
      type(outline_type), allocatable :: outlines(:)
      type(chain_mass_type), allocatable :: parts(:)
      !> The body that each belongs to; 0: it stands still
      integer, allocatable :: body(:)
      !> What acts on those that stand still
      type(chain_action_type), allocatable :: standing(:)
   end type masonry_type

   !> Two points of an edge, and the direction away from the part that it is of
   type :: edge_type
      real(wp) :: ends(2, 2) = 0.0_wp, normal(2) = 0.0_wp
      integer :: part = 0
   end type edge_type

contains

   !> Is the whole its own mirror image about a vertical line, with all that acts on it?
   pure logical function is_symmetric(masonry, actions)
      type(masonry_type), intent(in) :: masonry
      type(chain_action_type), intent(in) :: actions(:)

      integer :: i, k

      is_symmetric = size(masonry%outlines) > 0
      if (.not. is_symmetric) return
      associate (twice => twice_middle(masonry%outlines), all_actions => [actions, masonry%standing])
         do i = 1, size(masonry%parts)
            is_symmetric = any([(is_image(masonry%parts(i), masonry%parts(k), twice), k=1, size(masonry%parts))])
            if (.not. is_symmetric) return
         end do
         do i = 1, size(all_actions)
            is_symmetric = any([(is_same_action(all_actions(i), all_actions(k), twice), k=1, size(all_actions))])
            if (.not. is_symmetric) return
         end do
      end associate
   end function is_symmetric

   !> Twice the middle of outlines [m]
   pure real(wp) function twice_middle(outlines) result(twice)
      type(outline_type), intent(in) :: outlines(:)

      real(wp) :: low, high
      integer :: i

      low = huge(1.0_wp)
      high = -huge(1.0_wp)
      do i = 1, size(outlines)
         low = min(low, minval(outlines(i)%corners(1, :)))
         high = max(high, maxval(outlines(i)%corners(1, :)))
      end do
      twice = low + high
   end function twice_middle

   !> Is a part the mirror image of another?
   pure logical function is_image(one, other, twice)
      type(chain_mass_type), intent(in) :: one, other
      !> Twice the x of the line [m]
      real(wp), intent(in) :: twice

      is_image = max(abs(one%at(1) + other%at(1) - twice), abs(one%at(2) - other%at(2))) <= near .and. &
         & abs(one%mass - other%mass) <= near*abs(one%mass) .and. abs(one%inertia - other%inertia) <= near*abs(one%inertia)
   end function is_image

   !> Is an action the mirror image of another?
   pure logical function is_same_action(one, other, twice)
      type(chain_action_type), intent(in) :: one, other
      !> Twice the x of the line [m]
      real(wp), intent(in) :: twice

      real(wp) :: size_of

      size_of = near*max(one%weight, norm2(one%thrust), one%pushed, one%lifted)
      is_same_action = max(abs(one%at(1) + other%at(1) - twice), abs(one%at(2) - other%at(2))) <= near .and. &
         & max(abs(one%weight - other%weight), abs(one%thrust(1) + other%thrust(1)), abs(one%thrust(2) - other%thrust(2)), &
         & abs(one%pushed - other%pushed), abs(one%lifted - other%lifted)) <= size_of .and. (one%is_held .eqv. other%is_held)
   end function is_same_action

   !> Restitution that an impact on all joints leaves, whose parts may open at both ends of each and do not slide: an upper bound
   !> (dondolo_wall_chain_impact)
   subroutine impact_bound(chain, masonry, is_mirrored, bound, is_known)
      type(chain_type), intent(in) :: chain
      type(masonry_type), intent(in) :: masonry
      !> Does it move to its other side as its mirror image, so that the hinges on the ground have images?
      logical, intent(in) :: is_mirrored
      !> e = sqrt(T+/T-)
      real(wp), intent(out) :: bound
      !> False: it is not known where the joints are, and the bound is undefined
      logical, intent(out) :: is_known

      type(motion_type) :: motion
      type(contact_type), allocatable :: contacts(:)
      type(attached_type), allocatable :: attached(:)
      type(edge_type) :: edge
      real(wp) :: before(3, size(masonry%parts)), inset
      integer :: i

      bound = 1.0_wp
      call set_at_rest(chain, motion)
      allocate (contacts(0), attached(0))
      call add_shared(contacts, masonry%outlines)
      inset = 0.0_wp
      do i = 1, size(chain%joints)
         associate (joint => chain%joints(i))
            is_known = .true.
            if (joint%kind == is_pin) then
               call add_hinge(joint%body, joint%other, joint%at)
            else
               call add_guide(contacts, joint%direction, joint%at, joint%other_at, part_at(joint%body, joint%at), &
                  & part_at(joint%other, joint%other_at), is_known)
            end if
            if (.not. is_known) return
         end associate
      end do
      do i = 1, size(contacts)
         if (contacts(i)%is_guide) cycle
         associate (along => contacts(i)%ends(:, 2) - contacts(i)%ends(:, 1))
            is_known = inset < 0.5_wp*norm2(along)
            if (.not. is_known) return
            contacts(i)%ends = contacts(i)%ends + inset/norm2(along)*reshape([along, -along], [2, 2])
         end associate
      end do
      before = 0.0_wp
      do i = 1, size(masonry%parts)
         associate (body => masonry%body(i))
            if (body > 0) before(:, i) = -velocity_of(masonry%parts(i)%at, chain%bodies(body)%at, motion%rate(:, body))
         end associate
      end do
      call add_actions(chain%actions)
      call add_actions(masonry%standing)
      bound = cone_ratio(masonry%parts, contacts, attached, before)
      ! A velocity that vanishes but for rounding
      if (bound < near) bound = 0.0_wp

   contains

      !> Add the joint of a hinge, if it is no joint of two parts, and note how far the hinge lies within it
      subroutine add_hinge(body, other, at)
         !> 0: the ground
         integer, intent(in) :: body, other
         !> [m]
         real(wp), intent(in) :: at(2)

         integer :: k, one, two

         do k = 1, size(contacts)
            if (contacts(k)%is_guide .or. contacts(k)%other == 0) cycle
            one = masonry%body(contacts(k)%part)
            two = masonry%body(contacts(k)%other)
            if (.not. (one == body .and. two == other .or. one == other .and. two == body)) cycle
            if (is_on(contacts(k)%ends, at)) then
               inset = max(inset, min(norm2(at - contacts(k)%ends(:, 1)), norm2(at - contacts(k)%ends(:, 2))))
               return
            end if
         end do
         call find_opening(body, other, at, edge, is_known)
         if (.not. is_known) call find_opening(other, body, at, edge, is_known)
         if (.not. is_known) return
         k = merge(other, body, masonry%body(edge%part) == body)
         inset = max(inset, min(norm2(at - edge%ends(:, 1)), norm2(at - edge%ends(:, 2))))
         contacts = [contacts, contact_type(edge%part, part_at(k, at), edge%ends, -edge%normal)]
         if (.not. is_mirrored .or. body*other /= 0) return
         ! The part on the other side stands on the ground alike.
         associate (twice => twice_middle(masonry%outlines))
            k = findloc([(is_image(masonry%parts(edge%part), masonry%parts(k), twice), k=1, size(masonry%parts))], .true., dim=1)
            if (k == edge%part) return
            is_known = k > 0
            if (.not. is_known) return
            edge%ends(1, :) = twice - edge%ends(1, :)
            edge%normal(1) = -edge%normal(1)
            if (.not. any([(contacts(k)%other == 0 .and. is_on(contacts(k)%ends, 0.5_wp*sum(edge%ends, dim=2)), &
               & k=1, size(contacts))])) contacts = [contacts, contact_type(findloc([(is_image(masonry%parts(edge%part), &
               & masonry%parts(k), twice), k=1, size(masonry%parts))], .true., dim=1), 0, edge%ends, -edge%normal)]
         end associate
      end subroutine add_hinge

      !> Find the edge of a body at a hinge, at whose other end the body moves away from what it turns on
      subroutine find_opening(body, other, at, found, is_found)
         integer, intent(in) :: body, other
         !> [m]
         real(wp), intent(in) :: at(2)
         type(edge_type), intent(out) :: found
         logical, intent(out) :: is_found

         type(edge_type) :: piece
         real(wp) :: turn, far(2), r(2)
         integer :: k, m, n

         is_found = .false.
         if (body == 0) return
         turn = motion%rate(3, body)
         if (other > 0) turn = turn - motion%rate(3, other)
         do k = 1, size(masonry%outlines)
            if (masonry%outlines(k)%body /= body) cycle
            n = size(masonry%outlines(k)%corners, 2)
            do m = 1, n
               piece = edge_of(masonry%outlines(k), m)
               if (.not. is_on(piece%ends, at)) cycle
               far = piece%ends(:, 1)
               if (norm2(piece%ends(:, 2) - at) > norm2(far - at)) far = piece%ends(:, 2)
               r = far - at
               if (.not. turn*dot_product([r(2), -r(1)], -piece%normal) > near*norm2(r)*abs(turn)) cycle
               ! Of several the longest
               if (is_found) then
                  if (norm2(piece%ends(:, 2) - piece%ends(:, 1)) <= norm2(found%ends(:, 2) - found%ends(:, 1))) cycle
               end if
               found = piece
               is_found = .true.
            end do
         end do
      end subroutine find_opening

      !> The part of a body that is nearest to a point; 0: the ground
      integer function part_at(body, at) result(part)
         integer, intent(in) :: body
         !> [m]
         real(wp), intent(in) :: at(2)

         real(wp) :: distance

         call find_nearest(masonry, body, at, part, distance)
         if (body > 0) then
            if (part == 0) part = findloc(masonry%body, body, dim=1)
         else if (distance > near) then
            part = 0
         end if
      end function part_at

      !> Attach the masses of loads to the parts that they rest on
      subroutine add_actions(actions)
         type(chain_action_type), intent(in) :: actions(:)

         integer :: k, part

         do k = 1, size(actions)
            part = part_at(actions(k)%body, actions(k)%at)
            if (part > 0) attached = [attached, attached_type(part, actions(k)%at, [actions(k)%pushed, actions(k)%lifted])]
         end do
      end subroutine add_actions

   end subroutine impact_bound

   !> Find the part of a body whose outline is nearest to a point
   pure subroutine find_nearest(masonry, body, at, part, distance)
      type(masonry_type), intent(in) :: masonry
      integer, intent(in) :: body
      !> [m]
      real(wp), intent(in) :: at(2)
      !> 0: the body has no outlines
      integer, intent(out) :: part
      !> From the outline, 0 within it; huge without outlines [m]
      real(wp), intent(out) :: distance

      real(wp) :: here
      integer :: k, m

      part = 0
      distance = huge(1.0_wp)
      do k = 1, size(masonry%outlines)
         if (masonry%outlines(k)%body /= body) cycle
         here = merge(0.0_wp, huge(1.0_wp), is_within(masonry%outlines(k)%corners, at))
         do m = 1, size(masonry%outlines(k)%corners, 2)
            here = min(here, distance_to(edge_of(masonry%outlines(k), m), at))
         end do
         if (here >= distance) cycle
         distance = here
         part = masonry%outlines(k)%part
      end do
   end subroutine find_nearest

   !> Add the joints between parts that share an edge
   pure subroutine add_shared(contacts, outlines)
      type(contact_type), allocatable, intent(inout) :: contacts(:)
      type(outline_type), intent(in) :: outlines(:)

      type(edge_type), allocatable :: edges(:)
      type(edge_type) :: one, two
      real(wp) :: along(2), places(4), first, last
      integer :: before(size(outlines) + 1), i, k, m, n

      ! Numbers of the edges before those of each outline
      before(1) = 0
      do i = 1, size(outlines)
         before(i + 1) = before(i) + size(outlines(i)%corners, 2)
      end do
      allocate (edges(before(size(outlines) + 1)))
      do i = 1, size(outlines)
         do m = before(i) + 1, before(i + 1)
            edges(m) = edge_of(outlines(i), m - before(i))
         end do
      end do
      do i = 1, size(outlines)
         do k = i + 1, size(outlines)
            if (outlines(i)%part == outlines(k)%part) cycle
            do m = before(i) + 1, before(i + 1)
               one = edges(m)
               along = one%ends(:, 2) - one%ends(:, 1)
               along = along/norm2(along)
               do n = before(k) + 1, before(k + 1)
                  two = edges(n)
                  if (max(abs(dot_product(one%normal, two%ends(:, 1) - one%ends(:, 1))), &
                     & abs(dot_product(one%normal, two%ends(:, 2) - one%ends(:, 1)))) > near) cycle
                  if (dot_product(one%normal, two%normal) > 0.0_wp) cycle
                  places = [matmul(along, one%ends), matmul(along, two%ends)]
                  first = max(minval(places(:2)), minval(places(3:)))
                  last = min(maxval(places(:2)), maxval(places(3:)))
                  if (last - first <= near) cycle
                  contacts = [contacts, contact_type(two%part, one%part, reshape([one%ends(:, 1) + (first - places(1))*along, &
                     & one%ends(:, 1) + (last - places(1))*along], [2, 2]), one%normal)]
               end do
            end do
         end do
      end do
   end subroutine add_shared

   !> Add a guide whose points move alike with a turn; others are not known
   pure subroutine add_guide(contacts, direction, at, other_at, part, other, is_known)
      type(contact_type), allocatable, intent(inout) :: contacts(:)
      !> Direction that is held
      real(wp), intent(in) :: direction(2)
      !> Its points [m], and their parts
      real(wp), intent(in) :: at(2), other_at(2)
      integer, intent(in) :: part, other
      logical, intent(out) :: is_known

      is_known = abs(dot_product([-direction(2), direction(1)], at - other_at)) <= near .and. part + other > 0
      if (.not. is_known) return
      contacts = [contacts, contact_type(max(part, other), min(part, other), spread(at, 2, 2), direction, is_guide=.true.)]
   end subroutine add_guide

   !> Side of an outline from a corner to the next
   pure type(edge_type) function edge_of(outline, corner) result(edge)
      type(outline_type), intent(in) :: outline
      integer, intent(in) :: corner

      real(wp) :: area
      integer :: i, n

      n = size(outline%corners, 2)
      edge%part = outline%part
      edge%ends = outline%corners(:, [corner, modulo(corner, n) + 1])
      area = 0.0_wp
      do i = 1, n
         associate (a => outline%corners(:, i), b => outline%corners(:, modulo(i, n) + 1))
            area = area + a(1)*b(2) - a(2)*b(1)
         end associate
      end do
      associate (along => edge%ends(:, 2) - edge%ends(:, 1))
         edge%normal = sign(1.0_wp, area)*[along(2), -along(1)]/max(norm2(along), tiny(1.0_wp))
      end associate
   end function edge_of

   !> Does a point lie on an edge?
   pure logical function is_on(ends, at)
      real(wp), intent(in) :: ends(2, 2), at(2)

      is_on = distance_to(edge_type(ends), at) <= near
   end function is_on

   !> Distance of a point from an edge [m]
   pure real(wp) function distance_to(edge, at) result(distance)
      type(edge_type), intent(in) :: edge
      real(wp), intent(in) :: at(2)

      real(wp) :: part

      associate (along => edge%ends(:, 2) - edge%ends(:, 1))
         part = min(1.0_wp, max(0.0_wp, dot_product(at - edge%ends(:, 1), along)/max(sum(along**2), tiny(1.0_wp))))
         distance = norm2(at - edge%ends(:, 1) - part*along)
      end associate
   end function distance_to

end module dondolo_wall_chain_masonry
