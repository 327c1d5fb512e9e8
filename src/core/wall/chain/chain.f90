!> A planar chain of rigid bodies with one degree of freedom: what it is made of, and how it moves.
!>
!> Body i has the position y_i = (x, y, phi), phi from the vertical towards +x. Joints are equations between positions,
!>
!>     F(y) = 0, phi_driver = +-q        A y' = e        A y'' = -(dA/dq) y'
!>
!> with the same matrix A = dF/dy, and e = 1 in the row of the driver. The positions come from Newton's method, which begins where
!> the rates of a rotation nearby lead; those of this one are then exact.
module dondolo_wall_chain
   use dondolo_base_kinds, only : wp
   use dondolo_wall_chain_equations, only : factor_type, factorise
   use dondolo_wall_chain_part, only : chain_mass_type
   use dondolo_wall_restraint, only : tie_input_type
   implicit none
   private

   public :: chain_action_type, chain_joint_type, chain_tie_type, chain_type, guide, motion_type, pin, point_motion

   !> Equations of a pin and of a guide
   integer, parameter, public :: is_pin = 2, is_guide = 1

   !> Most steps of Newton's method; it converges in two to four
   integer, parameter :: most_steps = 30

   !> Step of it after which the next is below rounding, since it is of the order of the square, and what that may be / size of the
   !> positions
   real(wp), parameter :: small_step = 0.1_wp*sqrt(epsilon(1.0_wp)), smallest_step = 4.0_wp*epsilon(1.0_wp)

   !> A joint between two bodies, or of one with the ground
   type :: chain_joint_type
      !> Equations: that of a pin or that of a guide
      integer :: kind = is_pin
      !> The bodies; 0: the ground
      integer :: body = 0, other = 0
      !> The point of each at rest [m]; they are one point of a pin
      real(wp) :: at(2) = 0.0_wp, other_at(2) = 0.0_wp
      !> Direction of a guide, in which the difference of both points stays
      real(wp) :: direction(2) = 0.0_wp
   end type chain_joint_type

   !> A load, a mass that is pushed, or a thrust at a point of a body
   type :: chain_action_type
      !> The body, and the point of it at rest [m]
      integer :: body = 0
      real(wp) :: at(2) = 0.0_wp
      !> Weight N [N]; masses that the chain pushes and lifts [kg]
      real(wp) :: weight = 0.0_wp, pushed = 0.0_wp, lifted = 0.0_wp
      !> Force of a thrust outwards and upwards [N]
      real(wp) :: thrust(2) = 0.0_wp
      !> Does something else hold the load sideways? It then counts in the moment alone
      logical :: is_held = .false.
   end type chain_action_type

   !> A tie between a body and the ground, or between two bodies
   type :: chain_tie_type
      !> The bodies; 0: the ground
      integer :: body = 0, other = 0
      !> Its anchors on them at rest [m]; of one on the ground none is known
      real(wp) :: at(2) = 0.0_wp, other_at(2) = 0.0_wp
      !> Of a tie to the ground: in which direction it gets longer, which it keeps
      real(wp) :: direction(2) = 0.0_wp
      !> Bar and strength of its anchors; depth and height do not count
      type(tie_input_type) :: given
   end type chain_tie_type

   !> A chain
   type :: chain_type
      !> Its bodies at rest, its joints and what acts on it
      type(chain_mass_type), allocatable :: bodies(:)
      type(chain_joint_type), allocatable :: joints(:)
      type(chain_action_type), allocatable :: actions(:)
      !> Its ties, which no motion of the kernel knows
      type(chain_tie_type), allocatable :: ties(:)
      !> The body whose turn is q, and its sense: 1 towards +x, -1 towards -x
      integer :: driver = 1
      real(wp) :: sense = 1.0_wp
      !> Gravity [m/s2], and the share c of it that acts in the plane: 1 for a vertical plane, 0 for one of a plan
      real(wp) :: gravity = 0.0_wp, gravity_share = 1.0_wp
   contains
      !> Positions of its bodies at rest
      procedure :: rest
      !> Its matrix at rest
      procedure :: at_rest
      !> Its motion at a rotation
      procedure :: move
      !> Right-hand side of second derivatives
      procedure :: bend
   end type chain_type

   !> The motion of the bodies at a rotation
   type :: motion_type
      !> q [rad]
      real(wp) :: q = 0.0_wp
      !> Positions (x, y, phi; body), and their first and second derivatives by q
      real(wp), allocatable :: y(:, :), rate(:, :), bend(:, :)
      !> Sign of the determinant of A
      real(wp) :: sign = 0.0_wp
   end type motion_type

contains

   !> A pin
   pure type(chain_joint_type) function pin(body, other, at)
      !> The bodies; 0: the ground
      integer, intent(in) :: body, other
      !> The point that they share [m]
      real(wp), intent(in) :: at(2)

      pin = chain_joint_type(is_pin, body, other, at, at)
   end function pin

   !> A guide
   pure type(chain_joint_type) function guide(body, other, at, angle, other_at)
      !> The bodies; 0: the ground
      integer, intent(in) :: body, other
      !> Point of the first [m]
      real(wp), intent(in) :: at(2)
      !> Direction that is held, from x towards y [rad]
      real(wp), intent(in) :: angle
      !> Point of the other, if it is not the same [m]
      real(wp), intent(in), optional :: other_at(2)

      guide = chain_joint_type(is_guide, body, other, at, at, [cos(angle), sin(angle)])
      if (present(other_at)) guide%other_at = other_at
   end function guide

   !> Positions of the bodies at rest
   pure function rest(self) result(y)
      class(chain_type), intent(in) :: self
      !> Positions (x, y, phi; body)
      real(wp), allocatable :: y(:, :)

      integer :: i

      allocate (y(3, size(self%bodies)), source=0.0_wp)
      do i = 1, size(self%bodies)
         y(:2, i) = self%bodies(i)%at
      end do
   end function rest

   !> The factors of A at rest: of less than full rank if the joints depend on one another
   pure subroutine at_rest(self, factor)
      class(chain_type), intent(in) :: self
      type(factor_type), intent(out) :: factor

      real(wp), allocatable :: left(:), a(:, :)

      call set_equations(self, 0.0_wp, self%rest(), left, a)
      call factorise(factor, a)
   end subroutine at_rest

   !> The motion at a rotation
   pure subroutine move(self, q, motion, is_there)
      class(chain_type), intent(in) :: self
      !> Rotation [rad]
      real(wp), intent(in) :: q
      !> In: the motion at a rotation nearby; out: that at this one
      type(motion_type), intent(inout) :: motion
      !> False: no position was found, or its matrix is singular: the chain ends before, and the motion is undefined
      logical, intent(out) :: is_there

      type(factor_type) :: factor
      real(wp), allocatable :: left(:), a(:, :)
      real(wp) :: change, before, large
      integer :: i, n

      n = 3*size(self%bodies)
      if (allocated(motion%rate)) then
         associate (ahead => q - motion%q)
            motion%y = motion%y + ahead*(motion%rate + 0.5_wp*ahead*motion%bend)
         end associate
      end if
      motion%q = q
      is_there = .false.
      before = huge(1.0_wp)
      do i = 1, most_steps
         call set_equations(self, q, motion%y, left, a)
         call factorise(factor, a)
         if (factor%rank < n) return
         associate (step => reshape(factor%solve(left), shape(motion%y)))
            motion%y = motion%y - step
            change = maxval(abs(step))
         end associate
         large = max(1.0_wp, maxval(abs(motion%y)))
         ! The last step changes no derivative. Where equations are ill-conditioned steps end above rounding, and no longer shrink.
         if (before <= small_step*large .and. (change <= smallest_step*large .or. change >= 0.5_wp*before)) exit
         before = change
      end do
      if (i > most_steps) return
      motion%sign = factor%sign
      left = 0.0_wp
      left(n) = 1.0_wp
      motion%rate = reshape(factor%solve(left), shape(motion%y))
      motion%bend = reshape(factor%solve(self%bend(motion%y(3, :), motion%rate(3, :), motion%rate(3, :))), shape(motion%y))
      is_there = .true.
   end subroutine move

   !> The equations at some positions
   pure subroutine set_equations(chain, q, y, left, a)
      class(chain_type), intent(in) :: chain
      !> Rotation [rad]
      real(wp), intent(in) :: q
      !> Positions
      real(wp), intent(in) :: y(:, :)
      !> F, and its derivatives A
      real(wp), allocatable, intent(out) :: left(:), a(:, :)

      integer :: i, n, row

      n = 3*size(chain%bodies)
      allocate (left(n), a(n, n), source=0.0_wp)
      row = 1
      do i = 1, size(chain%joints)
         associate (joint => chain%joints(i))
            if (joint%kind == is_pin) then
               call add(left(row), a(row, :), joint%body, joint%at, [1.0_wp, 0.0_wp])
               call add(left(row), a(row, :), joint%other, joint%other_at, [-1.0_wp, 0.0_wp])
               row = row + 1
               call add(left(row), a(row, :), joint%body, joint%at, [0.0_wp, 1.0_wp])
               call add(left(row), a(row, :), joint%other, joint%other_at, [0.0_wp, -1.0_wp])
            else
               call add(left(row), a(row, :), joint%body, joint%at, joint%direction)
               call add(left(row), a(row, :), joint%other, joint%other_at, -joint%direction)
               left(row) = left(row) - sum(joint%direction*(joint%at - joint%other_at))
            end if
            row = row + 1
         end associate
      end do
      left(n) = chain%sense*y(3, chain%driver) - q
      a(n, 3*chain%driver) = chain%sense

   contains

      !> Add a point to the equation of this row
      pure subroutine add(sum_of, derivatives, body, at, along)
         real(wp), intent(inout) :: sum_of, derivatives(:)
         integer, intent(in) :: body
         real(wp), intent(in) :: at(2), along(2)

         real(wp) :: r(2)

         if (body == 0) then
            sum_of = sum_of + sum(along*at)
            return
         end if
         r = turned(at - chain%bodies(body)%at, y(3, body))
         sum_of = sum_of + sum(along*(y(:2, body) + r))
         derivatives(3*body - 2:3*body) = derivatives(3*body - 2:3*body) + [along, along(1)*r(2) - along(2)*r(1)]
      end subroutine add

   end subroutine set_equations

   !> Right-hand side of the equations of second derivatives by two parameters
   pure function bend(self, turn, one, two) result(right)
      class(chain_type), intent(in) :: self
      !> Turns of the bodies [rad], and their derivatives by one parameter and by the other
      real(wp), intent(in) :: turn(:), one(:), two(:)
      !> One for each equation
      real(wp) :: right(3*size(self%bodies))

      real(wp) :: r(2)
      integer :: i, row

      right = 0.0_wp
      row = 1
      do i = 1, size(self%joints)
         associate (joint => self%joints(i))
            r = pull(joint%body, joint%at) - pull(joint%other, joint%other_at)
            if (joint%kind == is_pin) then
               right(row:row + 1) = r
            else
               right(row) = sum(joint%direction*r)
            end if
            row = row + joint%kind
         end associate
      end do

   contains

      !> What a turn of a body adds to the second derivative of a point of it, with the other sign
      pure function pull(body, at) result(r)
         integer, intent(in) :: body
         real(wp), intent(in) :: at(2)
         real(wp) :: r(2)

         r = 0.0_wp
         if (body > 0) r = one(body)*two(body)*turned(at - self%bodies(body)%at, turn(body))
      end function pull

   end function bend

   !> An offset in a body that has turned towards +x
   pure function turned(offset, turn) result(r)
      !> [m]
      real(wp), intent(in) :: offset(2)
      !> [rad]
      real(wp), intent(in) :: turn
      !> [m]
      real(wp) :: r(2)

      r = [offset(1)*cos(turn) + offset(2)*sin(turn), offset(2)*cos(turn) - offset(1)*sin(turn)]
   end function turned

   !> Place of a point of a body, and its first and second derivatives by q
   pure subroutine point_motion(chain, motion, body, at, place, rate, second)
      class(chain_type), intent(in) :: chain
      type(motion_type), intent(in) :: motion
      integer, intent(in) :: body
      !> The point at rest [m]
      real(wp), intent(in) :: at(2)
      !> [m], [m/rad], [m/rad2]
      real(wp), intent(out) :: place(2), rate(2), second(2)

      real(wp) :: r(2)

      r = turned(at - chain%bodies(body)%at, motion%y(3, body))
      associate (y => motion%y(:, body), v => motion%rate(:, body), w => motion%bend(:, body))
         place = y(:2) + r
         rate = v(:2) + v(3)*[r(2), -r(1)]
         second = w(:2) + w(3)*[r(2), -r(1)] - v(3)**2*r
      end associate
   end subroutine point_motion

end module dondolo_wall_chain
