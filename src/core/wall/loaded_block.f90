!> One rigid body with a hinge at some depth, what it carries and what holds it: loads, pushed masses, thrusts, springs, ties.
!>
!> A point at depth d and height z, e = d - u and f = z - a from the hinge, moves by (docs/theory.md, section 2)
!>
!>     X = dx/dq = a + f cos q + e sin q        Y = dy/dq = e cos q - f sin q        y = X
!>
!> Every term is a sum over points that is linear or quadratic in e and f, so that a few sums made once hold any number of
!> things; only a thrust that decays is asked one by one. A tie is a thrust inwards and a spring, as long as it neither
!> yields nor breaks nor becomes slack, and so is friction, whose spring pushes: `set_restraints` changes those sums.
module dondolo_wall_loaded_block
   use dondolo_base_bracket, only : bracket_type
   use dondolo_base_error, only : error_type, not_at_rest, out_of_range, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : rounded, to_text
   use dondolo_wall_carried, only : actions_type, spring_type
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_restraint, only : elastic, flowing
   use dondolo_wall_rigid_body, only : rigid_body_type
   use dondolo_wall_travel, only : lever, rotation_after, travel, versine
   implicit none
   private

   public :: loaded_block_type, new_loaded_block

   !> Sums over points with weights w, which are masses, forces or stiffnesses
   type :: sums_type
      !> Sums of w, w f, w e, w f^2, w e^2 and w f e
      real(wp) :: w = 0.0_wp, f = 0.0_wp, e = 0.0_wp, ff = 0.0_wp, ee = 0.0_wp, fe = 0.0_wp
   contains
      !> Add a point
      procedure :: add
      !> Sum of w X, and of w y
      procedure :: x
      !> Sum of w Y
      procedure :: y
      !> Sum of w X^2
      procedure :: xx
   end type sums_type

   !> A thrust that decays
   type :: fading_type
      !> Force at rest [N/m], travel over which it falls to 1/e of it, and place from the hinge [m]
      real(wp) :: force, decay, e, f
   end type fading_type

   !> One block with what it carries
   type, extends(mechanism_type) :: loaded_block_type
      private
      !> Radius of the edge a [m]
      real(wp) :: edge = 0.0_wp
      !> Gravity in the plane of the motion [m/s2]
      real(wp) :: down = 0.0_wp
      !> Centroid of the masonry from the hinge [m]
      real(wp) :: e = 0.0_wp, f = 0.0_wp
      !> Part of J that does not change [kg m2]
      real(wp) :: inertia = 0.0_wp
      !> Masses that move with the wall, that are only pushed and that are only lifted [kg/m]
      type(sums_type) :: whole, pushed, lifted
      !> Dead weights and constant thrusts [N/m], stiffnesses [N/m per m]
      type(sums_type) :: dead, thrust, spring
      !> Thrusts and stiffnesses without the ties
      type(sums_type) :: free_thrust, free_spring
      !> Are there stiffnesses? Those of ties and of friction may cancel in some of the sums
      logical :: is_sprung = .false.
      !> Thrusts that decay
      type(fading_type), allocatable :: fading(:)
   contains
      procedure :: terms
      procedure :: potential
      procedure :: geometric_end
      procedure :: support
      procedure :: set_restraints
   end type loaded_block_type

contains

   !> Add a point
   pure subroutine add(self, w, e, f)
      class(sums_type), intent(inout) :: self
      !> Weight
      real(wp), intent(in) :: w
      !> Place from the hinge [m]
      real(wp), intent(in) :: e, f

      self%w = self%w + w
      self%f = self%f + w*f
      self%e = self%e + w*e
      self%ff = self%ff + w*f**2
      self%ee = self%ee + w*e**2
      self%fe = self%fe + w*f*e
   end subroutine add

   !> Sum of w X, and of w y
   elemental real(wp) function x(self, a, s, c)
      class(sums_type), intent(in) :: self
      !> Edge radius [m], sine and cosine of the rotation
      real(wp), intent(in) :: a, s, c

      x = a*self%w + c*self%f + s*self%e
   end function x

   !> Sum of w Y
   elemental real(wp) function y(self, s, c)
      class(sums_type), intent(in) :: self
      !> Sine and cosine of the rotation
      real(wp), intent(in) :: s, c

      y = c*self%e - s*self%f
   end function y

   !> Sum of w X^2
   elemental real(wp) function xx(self, a, s, c)
      class(sums_type), intent(in) :: self
      !> Edge radius [m], sine and cosine of the rotation
      real(wp), intent(in) :: a, s, c

      xx = a*(a*self%w + 2.0_wp*(c*self%f + s*self%e)) + c**2*self%ff + 2.0_wp*s*c*self%fe + s**2*self%ee
   end function xx

   !> Make the mechanism
   subroutine new_loaded_block(mechanism, body, actions, gravity, two_sided, error)
      type(loaded_block_type), intent(out) :: mechanism
      !> The masonry
      type(rigid_body_type), intent(in) :: body
      !> What acts on it, checked
      type(actions_type), intent(in) :: actions
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> Does it rock to both sides?
      logical, intent(in) :: two_sided
      !> The wall does not stand at rest, or does not fall over however far it rotates
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: e, f, both
      integer :: i

      mechanism%two_sided = two_sided
      mechanism%gravity = gravity
      mechanism%down = actions%gravity_share*gravity
      mechanism%edge = actions%edge
      mechanism%e = body%depth - actions%hinge
      mechanism%f = body%height - actions%edge
      call mechanism%whole%add(body%mass, mechanism%e, mechanism%f)
      do i = 1, size(actions%carried)
         associate (thing => actions%carried(i))
            e = thing%depth - actions%hinge
            f = thing%height - actions%edge
            both = min(thing%pushed, thing%lifted)
            call mechanism%whole%add(both, e, f)
            call mechanism%pushed%add(thing%pushed - both, e, f)
            call mechanism%lifted%add(thing%lifted - both, e, f)
            call mechanism%dead%add(actions%gravity_share*thing%dead, e, f)
         end associate
      end do
      ! X^2 + Y^2 = a^2 + e^2 + f^2 + 2 a (f cos q + e sin q): without an edge J stays the same to the bit.
      associate (whole => mechanism%whole)
         mechanism%inertia = body%inertia + whole%ff + whole%ee + actions%edge**2*whole%w
      end associate
      allocate (mechanism%fading(0))
      do i = 1, size(actions%thrusts)
         associate (thrust => actions%thrusts(i))
            e = thrust%depth - actions%hinge
            f = thrust%height - actions%edge
            if (thrust%decay < huge(thrust%decay)) then
               mechanism%fading = [mechanism%fading, fading_type(thrust%force, thrust%decay, e, f)]
            else
               call mechanism%thrust%add(thrust%force, e, f)
            end if
         end associate
      end do
      do i = 1, size(actions%springs)
         call add_spring(mechanism%spring, actions%springs(i), actions)
      end do
      mechanism%is_sprung = mechanism%spring%w > 0.0_wp
      mechanism%free_thrust = mechanism%thrust
      mechanism%free_spring = mechanism%spring
      call check_rest(mechanism, body, actions, error)
      if (.not. allocated(error)) call compute_capacity(mechanism, error)
      if (allocated(error)) return
      call compute_unseating(mechanism, actions)
      if (size(actions%restraints) > 0) call add_ties(mechanism, actions, error)
   end subroutine new_loaded_block

   !> Add the ties, none of which has yielded yet
   subroutine add_ties(mechanism, actions, error)
      type(loaded_block_type), intent(inout) :: mechanism
      !> What acts on the wall
      type(actions_type), intent(in) :: actions
      !> A tie that is released before the wall falls: it is hardly above a hinge far behind it
      type(error_type), allocatable, intent(out) :: error

      real(wp), dimension(size(actions%restraints)) :: force, stiffness
      integer, allocatable :: mode(:)
      integer :: at

      mechanism%restraints = actions%restraints
      mechanism%ties = count(.not. actions%restraints%is_friction)
      associate (ties => mechanism%restraints)
         mechanism%preload = sum(ties%preload*lever(ties%edge, ties%e, ties%f, 0.0_wp))
         mode = merge(flowing, elastic, ties%is_friction)
         call ties%linear_force(mode, 0.0_wp, force, stiffness)
      end associate
      call mechanism%set_restraints(force, stiffness)
      associate (ties => mechanism%restraints)
         at = findloc(lever(ties%edge, ties%e, ties%f, mechanism%capacity) > 0.0_wp, .false., dim=1)
         if (at > 0) call raise_input(error, 'tie '//to_text(at)//': its tie_height is too low for the depth of the hinge; '// &
            & 'the tie would become shorter before the wall has rotated by '//to_text(mechanism%capacity)//' rad, its capacity', &
            & out_of_range, 'tie_height')
      end associate
   end subroutine add_ties

   !> Set the forces of ties and friction
   pure subroutine set_restraints(self, force, stiffness)
      class(loaded_block_type), intent(inout) :: self
      !> Of each of them: T = force + stiffness D [N/m] and [N/m per m]
      real(wp), intent(in) :: force(:), stiffness(:)

      integer :: i

      self%thrust = self%free_thrust
      self%spring = self%free_spring
      self%is_sprung = self%free_spring%w > 0.0_wp .or. any(abs(stiffness) > 0.0_wp)
      do i = 1, size(force)
         if (force(i) == 0.0_wp .and. stiffness(i) == 0.0_wp) cycle
         associate (tie => self%restraints(i))
            call self%thrust%add(-force(i), tie%e, tie%f)
            call self%spring%add(stiffness(i), tie%e, tie%f)
         end associate
      end do
   end subroutine set_restraints

   !> Add a spring or a distributed one, whose sums are integrals over its height
   pure subroutine add_spring(sums, spring, actions)
      type(sums_type), intent(inout) :: sums
      type(spring_type), intent(in) :: spring
      !> Says where the hinge is
      type(actions_type), intent(in) :: actions

      real(wp) :: e, below, above, first, second

      e = spring%depth - actions%hinge
      below = spring%bottom - actions%edge
      above = spring%top - actions%edge
      if (.not. above > below) then
         call sums%add(spring%stiffness, e, above)
         return
      end if
      first = spring%stiffness*(above - below)
      second = spring%stiffness*(above**2 - below**2)/2.0_wp
      sums%w = sums%w + first
      sums%f = sums%f + second
      sums%e = sums%e + e*first
      sums%ff = sums%ff + spring%stiffness*(above**3 - below**3)/3.0_wp
      sums%ee = sums%ee + e**2*first
      sums%fe = sums%fe + e*second
   end subroutine add_spring

   !> Terms of the equation of motion
   pure subroutine terms(self, q, j, c, g, l, load)
      class(loaded_block_type), intent(in) :: self
      !> Rotation [rad]
      real(wp), intent(in) :: q
      !> Inertia J [kg m2]
      real(wp), intent(out) :: j
      !> C = 1/2 dJ/dq [kg m2]
      real(wp), intent(out) :: c
      !> Restoring moment G of all that moves up and down with the wall [N m]
      real(wp), intent(out) :: g
      !> Excitation lever L [kg m]
      real(wp), intent(out) :: l
      !> Generalised force Q of dead weights, thrusts and springs [N m]
      real(wp), intent(out) :: load

      real(wp) :: s, k, v, double, cross
      integer :: i

      s = sin(q)
      k = cos(q)
      associate (a => self%edge, whole => self%whole, pushed => self%pushed, lifted => self%lifted, spring => self%spring)
         double = k**2 - s**2
         cross = s*k
         j = self%inertia + 2.0_wp*a*(k*whole%f + s*whole%e) + pushed%xx(a, s, k) &
            & + (k**2*lifted%ee - 2.0_wp*cross*lifted%fe + s**2*lifted%ff)
         c = a*(whole%y(s, k) + pushed%y(s, k)) + double*(pushed%fe - lifted%fe) &
            & + cross*((pushed%ee - pushed%ff) - (lifted%ee - lifted%ff))
         g = self%down*(whole%y(s, k) + lifted%y(s, k))
         l = whole%x(a, s, k) + pushed%x(a, s, k)
         load = self%thrust%x(a, s, k) - self%dead%y(s, k)
         if (self%is_sprung) then
            v = versine(q)
            load = load - (a*q*spring%x(a, s, k) + s*(a*spring%f + k*spring%ff + s*spring%fe) &
               & + v*(a*spring%e + k*spring%fe + s*spring%ee))
         end if
         do i = 1, size(self%fading)
            associate (fading => self%fading(i))
               load = load + fading%force*exp(-travel(a, fading%e, fading%f, q)/fading%decay) &
                  & *(a + fading%f*k + fading%e*s)
            end associate
         end do
      end associate
   end subroutine terms

   !> Potential energy of all weights above the base, and of thrusts and springs from rest
   pure function potential(self, q) result(v)
      class(loaded_block_type), intent(in) :: self
      !> Rotation [rad]
      real(wp), intent(in) :: q
      !> V [J]
      real(wp) :: v

      real(wp) :: s, k, t, r
      integer :: i

      s = sin(q)
      k = cos(q)
      associate (a => self%edge, thrust => self%thrust, spring => self%spring)
         r = a*q
         t = versine(q)
         v = self%down*(self%whole%x(a, s, k) + self%lifted%x(a, s, k)) + self%dead%x(a, s, k) &
            & - (r*thrust%w + s*thrust%f + t*thrust%e)
         if (self%is_sprung) v = v + 0.5_wp*(r**2*spring%w + s**2*spring%ff + t**2*spring%ee) &
            & + r*s*spring%f + r*t*spring%e + s*t*spring%fe
      end associate
      do i = 1, size(self%fading)
         associate (fading => self%fading(i))
            v = v - fading%force*fading%decay*(1.0_wp - exp(-travel(self%edge, fading%e, fading%f, q)/fading%decay))
         end associate
      end do
   end function potential

   !> The rotation at which the centroid of the masonry is level with the ground
   pure function geometric_end(self) result(q)
      class(loaded_block_type), intent(in) :: self
      !> Rotation [rad]
      real(wp) :: q

      q = atan2(self%e, self%f) + acos(max(-1.0_wp, -self%edge/hypot(self%e, self%f)))
   end function geometric_end

   !> What a one-sided block carries turns with it and with what it leans on; ties and springs are fixed to what it leans on
   !> (docs/theory.md, section 1): k h = J(0)/L(0) and tau h = B/L(0)
   pure subroutine support(self, share, tilt)
      class(loaded_block_type), intent(in) :: self
      !> k h [m]
      real(wp), intent(out) :: share
      !> tau h [m/s2]
      real(wp), intent(out) :: tilt

      real(wp) :: j, c, g, l, load

      share = 0.0_wp
      tilt = 0.0_wp
      ! What turns about an inclined line leans on nothing that turns about a level one.
      if (self%two_sided .or. self%down < self%gravity) return
      call self%terms(0.0_wp, j, c, g, l, load)
      share = j/l
      tilt = turning(self)/l
   end subroutine support

   !> The static quantity B: minus the slope of the moment of all weights and thrusts over the rotation, at rest [N m]
   pure real(wp) function turning(block)
      type(loaded_block_type), intent(in) :: block

      associate (thrust => block%free_thrust)
         turning = block%down*(block%whole%f + block%lifted%f) + block%dead%f + thrust%e &
            & + sum(block%fading%force*block%fading%e)
      end associate
   end function turning

   !> Check that the wall stands
   subroutine check_rest(mechanism, body, actions, error)
      type(loaded_block_type), intent(in) :: mechanism
      !> The masonry
      type(rigid_body_type), intent(in) :: body
      !> What acts on it
      type(actions_type), intent(in) :: actions
      !> It does not; both moments are in the message
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: holds

      if (mechanism%moment(0.0_wp) > 0.0_wp) return
      associate (carried => actions%carried, thrusts => actions%thrusts)
         holds = mechanism%down*body%mass*mechanism%e + actions%gravity_share*sum(carried%weight*(carried%depth - actions%hinge))
         call raise_input(error, trim(merge('thrust_total', 'thrust      ', actions%is_whole))// &
            & ': the wall is not stable at rest'//trim(merge(' without its ties', '                 ', &
            & size(actions%restraints) > 0))//'; its weights resist with '//rounded(holds)// &
            & trim(merge(' N m          ', ' N m per metre', actions%is_whole))//', thrusts push it out with '// &
            & rounded(sum(thrusts%force*thrusts%height)), not_at_rest, &
            & trim(merge('thrust_total', 'thrust      ', actions%is_whole)))
      end associate
   end subroutine check_rest

   !> The rotation at which the restoring moment vanishes: in closed form, or where forces change with the rotation by
   !> bisection of the first change of sign
   subroutine compute_capacity(mechanism, error)
      type(loaded_block_type), intent(inout) :: mechanism
      !> There is none, or more than one
      type(error_type), allocatable, intent(out) :: error

      integer, parameter :: parts = 2000
      type(bracket_type) :: bracket
      real(wp) :: holding, end_of_all
      logical :: falls(0:parts)
      integer :: i

      end_of_all = mechanism%geometric_end()
      if (.not. mechanism%spring%w > 0.0_wp .and. size(mechanism%fading) == 0) then
         associate (m => mechanism)
            holding = m%down*(m%whole%e + m%lifted%e) + m%dead%e - m%thrust%f
            if (m%edge*m%thrust%w > 0.0_wp) then
               mechanism%capacity = acos(m%edge*m%thrust%w/hypot(holding, turning(m))) - atan2(turning(m), holding)
            else
               mechanism%capacity = atan2(holding, turning(m))
            end if
         end associate
         return
      end if
      falls = [(.not. mechanism%moment(end_of_all*real(i, wp)/real(parts, wp)) > 0.0_wp, i=0, parts)]
      i = findloc(falls, .true., dim=1) - 1
      if (i < 0) then
         call raise_input(error, 'spring: holds the wall at every rotation up to '//to_text(end_of_all)// &
            & ' rad, where it lies on the ground; there is no capacity', not_at_rest, 'spring')
         return
      end if
      if (.not. all(falls(i:))) then
         call raise_input(error, 'thrust_decay, spring: the wall is held again beyond the rotation at which it falls; '// &
            & 'two positions of rest are not covered', not_at_rest, 'thrust_decay')
         return
      end if
      bracket = bracket_type(end_of_all*real(i - 1, wp)/real(parts, wp), end_of_all*real(i, wp)/real(parts, wp))
      do while (bracket%is_divisible())
         call bracket%halve(mechanism%moment(bracket%middle()) > 0.0_wp)
      end do
      mechanism%capacity = bracket%middle()
   end subroutine compute_capacity

   !> The rotation at which the first load loses its seat
   pure subroutine compute_unseating(mechanism, actions)
      type(loaded_block_type), intent(inout) :: mechanism
      !> What acts on the wall
      type(actions_type), intent(in) :: actions

      integer :: i

      do i = 1, size(actions%carried)
         associate (thing => actions%carried(i))
            mechanism%unseating = min(mechanism%unseating, rotation_after(actions%edge, thing%depth - actions%hinge, &
               & thing%height - actions%edge, thing%seat))
         end associate
      end do
   end subroutine compute_unseating

end module dondolo_wall_loaded_block
