!> Terms of the equation of motion of a chain, and how its supports move it:
!>
!>     J = sum m (x'^2 + y'^2) + I phi'^2 + sum m_h x'^2 + m_v y'^2        J' = 2 sum m (x' x'' + y' y'') + I phi' phi'' + ...
!>     L = sum m x' + sum m_h x'        S = c (sum m y' + sum m_v y')      M = g S + c sum (N - g m_v) y' - sum H_x x' + H_y y'
!>
!> of masses m with pushed and lifted masses m_h and m_v of loads N, thrusts H, and the share c of gravity in the plane.
module dondolo_wall_chain_terms
   use dondolo_base_bracket, only : bracket_type
   use dondolo_base_kinds, only : wp
   use dondolo_wall_chain, only : chain_type, motion_type, point_motion
   use dondolo_wall_chain_equations, only : factor_type
   implicit none
   private

   public :: chain_terms_type, find_end, chain_support, set_at_rest, terms_at, walk_to

   !> Shortest and longest steps of a march, and the rotation beyond which no mechanism is followed [rad]
   real(wp), parameter :: shortest = 2.0e-3_wp, longest = 2.0e-2_wp, farthest = 1.5_wp

   !> Change of the turns in a step that their rates do not foretell, which a march keeps its steps below [rad]
   real(wp), parameter :: unforeseen = 1.0e-3_wp

   !> Terms at a rotation
   type :: chain_terms_type
      !> J [kg m2], its slope, L [kg m], S [kg m], M [N m], its slope, and V from rest [J]
      real(wp) :: inertia = 0.0_wp, slope = 0.0_wp, lever = 0.0_wp, vertical_lever = 0.0_wp, moment = 0.0_wp, &
         & moment_slope = 0.0_wp, potential = 0.0_wp
   end type chain_terms_type

contains

   !> The motion at rest of a chain whose joints do not depend on one another
   pure subroutine set_at_rest(chain, motion)
      class(chain_type), intent(in) :: chain
      type(motion_type), intent(out) :: motion

      logical :: is_there

      motion%y = chain%rest()
      call chain%move(0.0_wp, motion, is_there)
   end subroutine set_at_rest

   !> Go to a rotation in steps, so that Newton's method stays on its way
   pure subroutine walk_to(chain, q, motion, is_there)
      class(chain_type), intent(in) :: chain
      !> [rad]
      real(wp), intent(in) :: q
      !> In: at any rotation; out: at q
      type(motion_type), intent(inout) :: motion
      !> False: the chain ends before
      logical, intent(out) :: is_there

      real(wp), parameter :: longest = 0.02_wp
      real(wp) :: first
      integer :: i, steps

      first = motion%q
      steps = max(1, ceiling(abs(q - first)/longest))
      do i = 1, steps
         call chain%move(first + (q - first)*real(i, wp)/real(steps, wp), motion, is_there)
         if (.not. is_there) return
      end do
   end subroutine walk_to

   !> The terms of a motion
   pure type(chain_terms_type) function terms_at(chain, motion) result(terms)
      class(chain_type), intent(in) :: chain
      type(motion_type), intent(in) :: motion

      real(wp) :: place(2), rate(2), second(2)
      integer :: i

      do i = 1, size(chain%bodies)
         associate (body => chain%bodies(i), v => motion%rate(:, i), w => motion%bend(:, i))
            terms%inertia = terms%inertia + body%mass*sum(v(:2)**2) + body%inertia*v(3)**2
            terms%slope = terms%slope + 2.0_wp*(body%mass*sum(v(:2)*w(:2)) + body%inertia*v(3)*w(3))
            terms%lever = terms%lever + body%mass*v(1)
            terms%vertical_lever = terms%vertical_lever + chain%gravity_share*body%mass*v(2)
            terms%moment_slope = terms%moment_slope + chain%gravity*chain%gravity_share*body%mass*w(2)
            terms%potential = terms%potential + chain%gravity*chain%gravity_share*body%mass*(motion%y(2, i) - body%at(2))
         end associate
      end do
      terms%moment = chain%gravity*terms%vertical_lever
      do i = 1, size(chain%actions)
         associate (action => chain%actions(i), c => chain%gravity_share)
            call point_motion(chain, motion, action%body, action%at, place, rate, second)
            terms%inertia = terms%inertia + action%pushed*rate(1)**2 + action%lifted*rate(2)**2
            terms%slope = terms%slope + 2.0_wp*(action%pushed*rate(1)*second(1) + action%lifted*rate(2)*second(2))
            terms%lever = terms%lever + action%pushed*rate(1)
            terms%vertical_lever = terms%vertical_lever + c*action%lifted*rate(2)
            terms%moment = terms%moment + c*action%weight*rate(2) - sum(action%thrust*rate)
            terms%moment_slope = terms%moment_slope + c*action%weight*second(2) - sum(action%thrust*second)
            terms%potential = terms%potential + c*action%weight*(place(2) - action%at(2)) &
               & - sum(action%thrust*(place - action%at))
         end associate
      end do
   end function terms_at

   !> Find where a chain ends: where its moment vanishes, or where its joints cannot close any more
   pure subroutine find_end(chain, capacity, geometric_end)
      class(chain_type), intent(in) :: chain
      !> Rotation at which the moment vanishes [rad]; huge: it does not before the geometric end
      real(wp), intent(out) :: capacity
      !> Last rotation at which the joints close, as far as a little beyond the capacity [rad]; huge: they do there
      real(wp), intent(out) :: geometric_end

      type(motion_type) :: first, last, middle
      type(chain_terms_type) :: terms
      type(bracket_type) :: bracket
      real(wp) :: stride
      logical :: is_there

      capacity = huge(1.0_wp)
      geometric_end = huge(1.0_wp)
      stride = shortest
      call set_at_rest(chain, first)
      do while (first%q < min(farthest, 1.2_wp*min(capacity, farthest)))
         last = first
         call chain%move(first%q + stride, last, is_there)
         if (is_there) is_there = last%sign*first%sign > 0.0_wp
         ! Where the motion changes fast, as next to its end, steps are the shortest.
         if (stride > shortest) then
            if (.not. (is_there .and. surprise() <= unforeseen)) then
               stride = max(shortest, 0.5_wp*stride)
               cycle
            end if
         end if
         bracket = bracket_type(first%q, first%q + stride)
         if (.not. is_there) then
            do while (bracket%is_divisible())
               middle = first
               call chain%move(bracket%middle(), middle, is_there)
               if (is_there) is_there = middle%sign*first%sign > 0.0_wp
               call bracket%halve(is_there)
               if (is_there) first = middle
            end do
            geometric_end = bracket%first
            last = first
         end if
         terms = terms_at(chain, last)
         if (terms%moment <= 0.0_wp .and. .not. capacity < huge(1.0_wp)) then
            bracket%last = last%q
            if (geometric_end < huge(1.0_wp)) bracket%first = 0.0_wp
            call find_root(chain, first, bracket, capacity)
         end if
         if (geometric_end < huge(1.0_wp)) return
         if (surprise() <= 0.1_wp*unforeseen) stride = min(longest, 2.0_wp*stride)
         first = last
      end do

   contains

      !> Change of the turns from `first` to `last` that the rates do not foretell [rad]
      pure real(wp) function surprise()
         associate (ahead => last%q - first%q)
            surprise = maxval(abs(last%y(3, :) - first%y(3, :) - ahead*(first%rate(3, :) + 0.5_wp*ahead*first%bend(3, :))))
         end associate
      end function surprise

   end subroutine find_end

   !> Find the rotation at which the moment vanishes, by Newton's method, of which steps beyond the bracket halve it
   pure subroutine find_root(chain, near, bracket, root)
      class(chain_type), intent(in) :: chain
      !> The motion at a rotation nearby
      type(motion_type), intent(in) :: near
      !> In: the moment is positive at its first end and not at its last; out: what is left of it
      type(bracket_type), intent(inout) :: bracket
      !> [rad]
      real(wp), intent(out) :: root

      type(motion_type) :: motion
      type(chain_terms_type) :: terms
      real(wp) :: step
      logical :: is_there

      root = bracket%middle()
      do while (bracket%is_divisible())
         motion = near
         call chain%move(root, motion, is_there)
         terms = terms_at(chain, motion)
         call bracket%narrow(root, terms%moment > 0.0_wp)
         step = -terms%moment/terms%moment_slope
         if (abs(step) <= 2.0_wp*epsilon(root)*root) return
         root = root + step
         if (.not. (root > min(bracket%first, bracket%last) .and. root < max(bracket%first, bracket%last))) root = bracket%middle()
      end do
   end subroutine find_root

   !> How supports move the closed chain: with o its opening and f the tilt of the line through its supports, at rest
   !>
   !>     k h L = sum m r_o . r_f + I phi_o phi_f        tau h L = -d2V/(do df)
   !>
   !> where r_f is a rigid turn about the lowest of its points on the ground.
   pure subroutine chain_support(chain, share, tilt)
      class(chain_type), intent(in) :: chain
      !> k h [m] and tau h [m/s2]
      real(wp), intent(out) :: share, tilt

      type(motion_type) :: motion
      type(factor_type) :: factor
      type(chain_terms_type) :: terms
      real(wp) :: foot(2), place(2), rate(2), second(2), mixed(3, size(chain%bodies))
      integer :: i

      foot = [0.0_wp, huge(1.0_wp)]
      do i = 1, size(chain%joints)
         associate (joint => chain%joints(i))
            if (joint%other == 0 .and. joint%at(2) < foot(2)) foot = joint%at
            if (joint%body == 0 .and. joint%other_at(2) < foot(2)) foot = joint%other_at
         end associate
      end do
      call set_at_rest(chain, motion)
      terms = terms_at(chain, motion)
      call chain%at_rest(factor)
      mixed = reshape(factor%solve(chain%bend(motion%y(3, :), motion%rate(3, :), [(1.0_wp, i=1, size(chain%bodies))])), &
         & shape(mixed))
      share = 0.0_wp
      tilt = 0.0_wp
      do i = 1, size(chain%bodies)
         associate (body => chain%bodies(i), v => motion%rate(:, i))
            place = body%at - foot
            share = share + body%mass*(v(1)*place(2) - v(2)*place(1)) + body%inertia*v(3)
            tilt = tilt - chain%gravity*chain%gravity_share*body%mass*mixed(2, i)
         end associate
      end do
      do i = 1, size(chain%actions)
         associate (action => chain%actions(i), w => mixed(:, chain%actions(i)%body), v => motion%rate(:, chain%actions(i)%body))
            call point_motion(chain, motion, action%body, action%at, place, rate, second)
            place = place - foot
            share = share + action%pushed*rate(1)*place(2) - action%lifted*rate(2)*place(1)
            place = action%at - chain%bodies(action%body)%at
            second = w(:2) + w(3)*[place(2), -place(1)] - v(3)*place
            tilt = tilt - chain%gravity_share*action%weight*second(2) + sum(action%thrust*second)
         end associate
      end do
      share = share/terms%lever
      tilt = tilt/terms%lever
   end subroutine chain_support

end module dondolo_wall_chain_terms
