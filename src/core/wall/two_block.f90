!> Two-block wall: a strip held at its base and at its top that breaks at an intermediate hinge and folds out.
!>
!> Equation (3) of Nale et al. (Sorrentino, Masiani and Griffith 2008) in the common form (docs/theory.md,
!> section 2). q is the rotation of the lower block; the hinges at base and top stay on one vertical line, so that
!> sin(beta2) = R1 sin(beta1)/R2 with beta1 = alpha1 - q.
module dondolo_wall_two_block
   use dondolo_base_bracket, only : bracket_type
   use dondolo_base_error, only : error_type, not_at_rest, out_of_range, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : rounded, to_text
   use dondolo_wall_block, only : block_type
   use dondolo_wall_carried, only : actions_type
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_restraint, only : elastic, link_type
   use dondolo_wall_travel, only : travel
   implicit none
   private

   public :: carried_point_type, two_block_type, overburden_type, new_two_block
   public :: two_block_sorrentino, two_block_impulse

   !> Smallest cos(beta2)^2 that the terms are evaluated with: it vanishes at the geometric end, next to which
   !> the terms must stay finite
   real(wp), parameter :: smallest_square = 1.0e-9_wp

   !> A vertical load on the top
   type :: overburden_type
      !> Weight N [N/m]
      real(wp) :: weight = 0.0_wp
      !> Distance e from the centreline towards the active top hinge [m]
      real(wp) :: eccentricity = 0.0_wp
      !> Part of the weight that is a force alone [N/m]
      real(wp) :: dead = 0.0_wp
      !> Mass m_v of the rest, which the wall lifts [kg/m]
      real(wp) :: lifted = 0.0_wp
   end type overburden_type

   !> What acts on one of the blocks at a point
   type :: carried_point_type
      !> Place from the hinge that its block turns about: behind it, and above that at the base or below that on top [m]
      real(wp) :: e = 0.0_wp, f = 0.0_wp
      !> Is it on the upper block?
      logical :: is_upper = .false.
      !> Masses that the block pushes and lifts [kg/m]; weight that is a force alone, and horizontal force outwards [N/m]
      real(wp) :: pushed = 0.0_wp, lifted = 0.0_wp, dead = 0.0_wp, thrust = 0.0_wp
   end type carried_point_type

   !> Two blocks hinged to each other
   type, extends(mechanism_type) :: two_block_type
      !> Lower block
      type(block_type) :: lower
      !> Upper block
      type(block_type) :: upper
      !> Vertical load on the top
      type(overburden_type) :: overburden
      !> Lever b - e of that load about the top hinge [m]
      real(wp) :: load_lever
      !> What acts between base and top; not allocated: nothing
      type(carried_point_type), allocatable :: points(:)
      !> How the upper block turns
      type(link_type) :: link
      !> Forces of the ties, T = force + stiffness D; not allocated: they have none
      real(wp), allocatable, private :: force(:), stiffness(:)
   contains
      procedure :: terms
      procedure :: potential
      procedure :: geometric_end
      procedure :: support
      procedure :: set_restraints
      !> Horizontal lever X of a point
      procedure :: lever_of
   end type two_block_type

contains

   !> Make the mechanism of a two-block wall
   subroutine new_two_block(mechanism, lower, upper, overburden, gravity, error, actions, above)
      type(two_block_type), intent(out) :: mechanism
      !> Block below the intermediate hinge
      type(block_type), intent(in) :: lower
      !> Block above it
      type(block_type), intent(in) :: upper
      !> Vertical load on the top, its eccentricity at most b
      type(overburden_type), intent(in) :: overburden
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> It does not stand at rest
      type(error_type), allocatable, intent(out) :: error
      !> What acts between base and top, and which loads, thrusts and ties of it are on the upper block; absent: nothing
      type(actions_type), intent(in), optional :: actions
      logical, intent(in), optional :: above(:)

      mechanism%two_sided = .true.
      mechanism%lower = lower
      mechanism%upper = upper
      mechanism%gravity = gravity
      mechanism%overburden = overburden
      mechanism%load_lever = lower%b - overburden%eccentricity
      mechanism%link = link_type(lower%radius, lower%alpha, upper%radius, upper%alpha, .true.)
      if (present(actions) .and. present(above)) call add_points(mechanism, actions, above)
      call check_rest(mechanism, error)
      if (allocated(error)) return
      mechanism%capacity = moment_root(mechanism)
      ! A longer upper block never lies flat; else beta1 has the same bound to both sides.
      if (upper%radius <= lower%radius) then
         mechanism%highest = mechanism%geometric_end()
         mechanism%lowest = 2.0_wp*lower%alpha - mechanism%highest
      end if
      if (present(actions) .and. present(above)) call add_ties(mechanism, actions, above(size(above) &
         & - size(actions%restraints) + 1:), error)
   end subroutine new_two_block

   !> Add loads, masses and thrusts
   subroutine add_points(mechanism, actions, above)
      type(two_block_type), intent(inout) :: mechanism
      type(actions_type), intent(in) :: actions
      !> Which of them are on the upper block
      logical, intent(in) :: above(:)

      real(wp) :: height
      integer :: i, n

      n = size(actions%carried)
      allocate (mechanism%points(n + size(actions%thrusts)))
      mechanism%points%is_upper = above(:size(mechanism%points))
      mechanism%points%e = [actions%carried%depth, actions%thrusts%depth] - actions%hinge
      mechanism%points%f = [actions%carried%height, actions%thrusts%height]
      height = 2.0_wp*(mechanism%lower%radius*cos(mechanism%lower%alpha) + mechanism%upper%radius*cos(mechanism%upper%alpha))
      where (mechanism%points%is_upper) mechanism%points%f = height - mechanism%points%f
      do i = 1, n
         associate (thing => actions%carried(i), point => mechanism%points(i))
            point%pushed = thing%pushed
            point%lifted = thing%lifted
            point%dead = thing%dead
         end associate
      end do
      mechanism%points(n + 1:)%thrust = actions%thrusts%force
   end subroutine add_points

   !> Add the ties, none of which has yielded yet
   subroutine add_ties(mechanism, actions, above, error)
      type(two_block_type), intent(inout) :: mechanism
      type(actions_type), intent(in) :: actions
      !> Which of the ties are on the upper block
      logical, intent(in) :: above(:)
      !> A tie that would become shorter as the strip folds
      type(error_type), allocatable, intent(out) :: error

      real(wp), dimension(size(above)) :: force, stiffness
      real(wp) :: height
      integer :: at

      if (size(above) == 0) return
      mechanism%restraints = actions%restraints
      mechanism%ties = size(above)
      height = 2.0_wp*(mechanism%lower%radius*cos(mechanism%lower%alpha) + mechanism%upper%radius*cos(mechanism%upper%alpha))
      associate (ties => mechanism%restraints)
         do at = 1, size(ties)
            if (above(at)) call ties(at)%move_up(height, mechanism%link)
         end do
         mechanism%preload = sum(ties%preload*ties%lever_at(0.0_wp))
         call ties%linear_force(spread(elastic, 1, size(ties)), 0.0_wp, force, stiffness)
         at = findloc(ties%lever_at(mechanism%capacity) > 0.0_wp, .false., dim=1)
         if (at > 0) call raise_input(error, 'tie '//to_text(at)//': would become shorter before the strip has folded by '// &
            & to_text(mechanism%capacity)//' rad, its capacity; it is too near the base or the top', out_of_range, 'tie_height')
      end associate
      call mechanism%set_restraints(force, stiffness)
   end subroutine add_ties

   !> Set the forces of the ties
   pure subroutine set_restraints(self, force, stiffness)
      class(two_block_type), intent(inout) :: self
      !> Of each of them: T = force + stiffness D [N/m] and [N/m per m]
      real(wp), intent(in) :: force(:), stiffness(:)

      self%force = force
      self%stiffness = stiffness
   end subroutine set_restraints

   !> Horizontal lever X = dx/dq of a point [m]
   elemental real(wp) function lever_of(self, q, e, f, is_upper) result(x)
      class(two_block_type), intent(in) :: self
      !> Rotation [rad]
      real(wp), intent(in) :: q
      !> Place from the hinge that its block turns about, as of carried_point_type [m]
      real(wp), intent(in) :: e, f
      !> Is it on the upper block?
      logical, intent(in) :: is_upper

      real(wp) :: p, a

      if (.not. is_upper) then
         x = f*cos(q) + e*sin(q)
         return
      end if
      a = self%lower%radius*sin(self%lower%alpha - q)/self%upper%radius
      p = self%link%turned(q)
      x = self%lower%radius*cos(self%lower%alpha - q)/(self%upper%radius*sqrt(max(1.0_wp - a**2, smallest_square))) &
         & *(f*cos(p) + e*sin(p))
   end function lever_of

   !> Terms of equation (3), in the forms without 0/0 at q = alpha1
   pure subroutine terms(self, q, j, c, g, l, load)
      class(two_block_type), intent(in) :: self
      !> Rotation of the lower block [rad]
      real(wp), intent(in) :: q
      !> Inertia J [kg m2]
      real(wp), intent(out) :: j
      !> C = 1/2 dJ/dq [kg m2]
      real(wp), intent(out) :: c
      !> Restoring moment G of all that moves up and down with the wall [N m]
      real(wp), intent(out) :: g
      !> Excitation lever L [kg m]
      real(wp), intent(out) :: l
      !> Generalised force Q of the dead overburden [N m]
      real(wp), intent(out) :: load

      real(wp) :: sin1, cos1, a, cos2, k, b1, b2, c1, c2, m2r2, sin_psi, cos_psi, y, slope_k, slope_y

      associate (lower => self%lower, upper => self%upper)
         sin1 = lower%radius*sin(lower%alpha - q)
         cos1 = lower%radius*cos(lower%alpha - q)
         a = sin1/upper%radius
         cos2 = sqrt(max(1.0_wp - a**2, smallest_square))
         k = cos1/(upper%radius*cos2)
         m2r2 = upper%mass*upper%radius**2

         b1 = k**2
         b2 = 4.0_wp*a**2*(1.0_wp + k)
         c1 = k*(1.0_wp - k**2)*a/cos2
         c2 = -4.0_wp*a*(1.0_wp + k)*cos1/upper%radius + 2.0_wp*a**2*(1.0_wp - k**2)*a/cos2

         j = lower%corner_inertia + b1*upper%corner_inertia + b2*m2r2
         c = c1*upper%corner_inertia + c2*m2r2
         g = self%gravity*sin1*(lower%mass + upper%mass*(2.0_wp + k))
         l = (lower%mass + upper%mass)*cos1
         load = 0.0_wp
         if (self%overburden%weight > 0.0_wp) then
            ! cos(psi) with psi = alpha2 - beta2, whose rate is k; y is the rise of the load for a unit of rotation
            cos_psi = cos(upper%alpha)*cos2 + sin(upper%alpha)*a
            y = 2.0_wp*sin1*(1.0_wp + k) - self%load_lever*k*cos_psi
            load = -self%overburden%dead*y
            if (self%overburden%lifted > 0.0_wp) then
               sin_psi = sin(upper%alpha)*cos2 - cos(upper%alpha)*a
               slope_k = (1.0_wp - k**2)*a/cos2
               slope_y = 2.0_wp*(sin1*slope_k - cos1*(1.0_wp + k)) &
                  & - self%load_lever*(slope_k*cos_psi - k**2*sin_psi)
               j = j + self%overburden%lifted*y**2
               c = c + self%overburden%lifted*y*slope_y
               g = g + self%gravity*self%overburden%lifted*y
            end if
         end if
         if (allocated(self%points)) call add_terms_of_points(self, q, j, c, g, l, load)
      end associate
      if (allocated(self%force)) load = load - sum((self%force + self%stiffness*self%restraints%elongation(q)) &
         & *self%restraints%lever_at(q))
   end subroutine terms

   !> Add what acts between base and top to the terms: X and Y are the levers of a point, horizontal and vertical, and Y, of the
   !> upper block, that of the hinge on top among it
   pure subroutine add_terms_of_points(self, q, j, c, g, l, load)
      type(two_block_type), intent(in) :: self
      !> Rotation [rad]
      real(wp), intent(in) :: q
      !> Terms of the blocks; out: of all
      real(wp), intent(inout) :: j, c, g, l, load

      real(wp) :: sin1, cos1, sin2, cos2, k, slope_k, p, across, along, x, y, slope_x, slope_y
      integer :: i

      sin1 = self%lower%radius*sin(self%lower%alpha - q)
      cos1 = self%lower%radius*cos(self%lower%alpha - q)
      sin2 = sin1/self%upper%radius
      cos2 = sqrt(max(1.0_wp - sin2**2, smallest_square))
      k = cos1/(self%upper%radius*cos2)
      slope_k = (1.0_wp - k**2)*sin2/cos2
      p = self%link%turned(q)
      do i = 1, size(self%points)
         associate (point => self%points(i))
            if (point%is_upper) then
               across = point%f*cos(p) + point%e*sin(p)
               along = point%f*sin(p) - point%e*cos(p)
               x = k*across
               slope_x = slope_k*across - k**2*along
               y = 2.0_wp*sin1*(1.0_wp + k) + k*along
               slope_y = 2.0_wp*(sin1*slope_k - cos1*(1.0_wp + k)) + slope_k*along + k**2*across
            else
               x = point%f*cos(q) + point%e*sin(q)
               y = point%e*cos(q) - point%f*sin(q)
               slope_x = y
               slope_y = -x
            end if
            j = j + point%pushed*x**2 + point%lifted*y**2
            c = c + point%pushed*x*slope_x + point%lifted*y*slope_y
            g = g + self%gravity*point%lifted*y
            l = l + point%pushed*x
            load = load + point%thrust*x - point%dead*y
         end associate
      end do
   end subroutine add_terms_of_points

   !> Potential energy of both blocks and of the overburden
   pure function potential(self, q) result(v)
      class(two_block_type), intent(in) :: self
      !> Rotation of the lower block [rad]
      real(wp), intent(in) :: q
      !> V [J]
      real(wp) :: v

      real(wp) :: rise1, rise2, a, cos2, sin_psi

      associate (lower => self%lower, upper => self%upper)
         a = lower%radius*sin(lower%alpha - q)/upper%radius
         cos2 = sqrt(max(1.0_wp - a**2, smallest_square))
         rise1 = lower%radius*cos(lower%alpha - q)
         rise2 = upper%radius*cos2
         sin_psi = sin(upper%alpha)*cos2 - cos(upper%alpha)*a
         v = self%gravity*(lower%mass*rise1 + upper%mass*(2.0_wp*rise1 + rise2)) &
            & + self%overburden%weight*(2.0_wp*(rise1 + rise2) - self%load_lever*sin_psi)
         if (allocated(self%points)) v = v + sum(potential_of(self%points, self%gravity, q, self%link%turned(q), &
            & 2.0_wp*(rise1 + rise2)))
      end associate
      if (allocated(self%force)) v = v + sum((self%force + 0.5_wp*self%stiffness*self%restraints%elongation(q)) &
         & *self%restraints%elongation(q))
   end function potential

   !> Potential energy of what acts at a point: of a weight above the base, of a force outwards from rest [J]
   elemental real(wp) function potential_of(point, gravity, q, p, top) result(v)
      type(carried_point_type), intent(in) :: point
      !> Gravity [m/s2], rotations of the lower and of the upper block [rad], and height of the hinge on top [m]
      real(wp), intent(in) :: gravity, q, p, top

      real(wp) :: height

      associate (turned => merge(p, q, point%is_upper))
         height = merge(top - point%f*cos(turned) - point%e*sin(turned), point%f*cos(turned) + point%e*sin(turned), &
            & point%is_upper)
         v = (point%dead + gravity*point%lifted)*height - point%thrust*travel(0.0_wp, point%e, point%f, turned)
      end associate
   end function potential_of

   !> The rotation at which the upper block lies flat, R1 sin(q - alpha1) = R2
   pure function geometric_end(self) result(q)
      class(two_block_type), intent(in) :: self
      !> Rotation [rad]
      real(wp) :: q

      real(wp), parameter :: right_angle = acos(0.0_wp)

      q = self%lower%alpha + right_angle
      if (self%upper%radius < self%lower%radius) then
         q = self%lower%alpha + asin(self%upper%radius/self%lower%radius)
      end if
   end function geometric_end

   !> The supports of a strip are the hinges at its base and its top, h = H apart (docs/theory.md, section 1):
   !>
   !>     k = (1 + r)/3 + [4 b^2 + 2 (m_v/M) Y(0) (b - e)]/(r H^2)      Y(0) = b (2 + K) + e K      K = r/(1 - r)
   !>     tau = (g/H) {1 - 4 [b^2 + nu b (b + e)]/(r (1 - r) H^2)}      nu = N/(g M (1 - r))
   pure subroutine support(self, share, tilt)
      class(two_block_type), intent(in) :: self
      !> k H [m]
      real(wp), intent(out) :: share
      !> tau H [m/s2]
      real(wp), intent(out) :: tilt

      real(wp) :: height, r, k, mass, rise, nu

      associate (lower => self%lower, upper => self%upper, b => self%lower%b, load => self%overburden)
         r = lower%radius*cos(lower%alpha)
         height = r + upper%radius*cos(upper%alpha)
         r = r/height
         height = 2.0_wp*height
         k = r/(1.0_wp - r)
         mass = lower%mass + upper%mass
         rise = b*(2.0_wp + k) + load%eccentricity*k
         nu = load%weight/(self%gravity*mass*(1.0_wp - r))
         share = (1.0_wp + r)*height/3.0_wp + (4.0_wp*b**2 + 2.0_wp*load%lifted/mass*rise*self%load_lever)/(r*height)
         tilt = self%gravity*(1.0_wp - 4.0_wp*(b**2 + nu*b*(b + load%eccentricity))/(r*(1.0_wp - r)*height**2))
         if (allocated(self%points)) call add_support_of_points(self, height, 0.5_wp*mass*r*height, share, tilt)
      end associate
   end subroutine support

   !> Add what acts between base and top: with e = w - x, below the hinge e' = e, z' = z, above it e' = x + w, z' = z - r H,
   !>
   !>     k L = k_0 L_0 + [sum m_h X z + sum m_v Y e]/H                                                 (X, Y at rest)
   !>     tau L = tau_0 L_0 - sum P (y_pd + y_qq/H) + sum F (x_pd + x_qq/H)
   !>
   !> where x, y are the place of the point, d the displacement of the upper support and q the rotation: with h = (1 - r) H
   !>
   !>     below:  x_pd = y_pd = 0    x_qq = e    y_qq = -z
   !>     above:  y_pd = z' T/h + 2 w T e'/h^2     y_qq = -r H - z' T^2 + 2 w e' (1 - T^2)/h
   !>             x_pd = e' T/h - 2 w T z'/h^2     x_qq = 2 w - e' T^2 - 2 w z' (1 - T^2)/h
   pure subroutine add_support_of_points(self, height, lever, share, tilt)
      type(two_block_type), intent(in) :: self
      !> Height H [m], and lever L_0 of the blocks [kg m]
      real(wp), intent(in) :: height, lever
      !> Of the blocks and the load on top; out: of all
      real(wp), intent(inout) :: share, tilt

      real(wp) :: below, above, t, w, x, y, e, z, mixed(2), curved(2), all, k, turning
      integer :: i

      w = self%lower%b
      below = 2.0_wp*self%lower%radius*cos(self%lower%alpha)
      above = height - below
      t = below/above
      all = lever
      k = 0.0_wp
      turning = 0.0_wp
      do i = 1, size(self%points)
         associate (point => self%points(i))
            if (point%is_upper) then
               x = t*point%f
               y = 2.0_wp*w*(1.0_wp + t) - t*point%e
               z = above - point%f
               e = 2.0_wp*w - point%e
               mixed = [e*t/above - 2.0_wp*w*t*z/above**2, z*t/above + 2.0_wp*w*t*e/above**2]
               curved = [2.0_wp*w - e*t**2 - 2.0_wp*w*z*(1.0_wp - t**2)/above, &
                  & -below - z*t**2 + 2.0_wp*w*e*(1.0_wp - t**2)/above]
               z = z + below
            else
               x = point%f
               y = point%e
               z = point%f
               mixed = 0.0_wp
               curved = [point%e, -point%f]
            end if
            all = all + point%pushed*x
            k = k + point%pushed*x*z + point%lifted*y*point%e
            turning = turning + point%thrust*(height*mixed(1) + curved(1)) &
               & - (point%dead + self%gravity*point%lifted)*(height*mixed(2) + curved(2))
         end associate
      end do
      share = (share*lever + k)/all
      tilt = (tilt*lever + turning)/all
   end subroutine add_support_of_points

   !> Check that the wall stands: a load beyond an inner hinge far behind the face can fold it by itself
   pure subroutine check_rest(mechanism, error)
      !> The mechanism, its capacity not yet known
      type(two_block_type), intent(in) :: mechanism
      !> It does not; both moments are in the message
      type(error_type), allocatable, intent(out) :: error

      type(two_block_type) :: bare
      character(len=:), allocatable :: what
      real(wp) :: own, total

      total = mechanism%moment(0.0_wp)
      if (total > 0.0_wp) return
      bare = mechanism
      bare%overburden = overburden_type()
      what = 'overburden'
      if (allocated(bare%points)) then
         deallocate (bare%points)
         if (.not. mechanism%overburden%weight > 0.0_wp) what = 'load'
      end if
      own = bare%moment(0.0_wp)
      if (allocated(mechanism%points)) then
         call raise_input(error, what//': the wall is not stable at rest'//' without its ties; its own weight resists with '// &
            & rounded(own)//' N m per metre, loads and thrusts fold it with '//rounded(own - total), not_at_rest, what)
      else
         call raise_input(error, 'overburden: the wall is not stable at rest; its own weight resists with '//rounded(own)// &
            & ' N m per metre, the overburden folds it with '//rounded(own - total), not_at_rest, 'overburden')
      end if
   end subroutine check_rest

   !> Rotation at which G - Q vanishes: alpha1, or less where an overburden pushes out before
   pure function moment_root(mechanism) result(root)
      !> The mechanism, its capacity not yet known
      type(two_block_type), intent(in) :: mechanism
      !> Capacity rotation [rad]
      real(wp) :: root

      !> Parts of the rotation up to the geometric end in which a change of sign is looked for, where points act
      integer, parameter :: parts = 256
      type(bracket_type) :: bracket
      real(wp) :: furthest
      integer :: i

      root = mechanism%lower%alpha
      if (allocated(mechanism%points)) then
         furthest = mechanism%geometric_end()
         i = findloc(mechanism%moment([(furthest*real(i, wp)/real(parts, wp), i=1, parts - 1)]) > 0.0_wp, .false., dim=1)
         if (i == 0) i = parts
         bracket = bracket_type(furthest*real(i - 1, wp)/real(parts, wp), furthest*real(i, wp)/real(parts, wp))
      else
         if (.not. (mechanism%overburden%weight > 0.0_wp .and. mechanism%load_lever > 0.0_wp)) return
         bracket%last = root
      end if
      do while (bracket%is_divisible())
         call bracket%halve(mechanism%moment(bracket%middle()) > 0.0_wp)
      end do
      root = bracket%middle()
   end function moment_root

   !> Equation (4) of Nale et al. with its lost term restored and centroidal inertias (docs/theory.md,
   !> section 3): balance of angular momentum of both blocks about the new base hinge
   pure function two_block_sorrentino(lower, upper) result(eta)
      type(block_type), intent(in) :: lower
      type(block_type), intent(in) :: upper
      !> Ratio of the angular velocities after and before an impact
      real(wp) :: eta

      real(wp) :: t, sin1, cos1, tan2, m1r1, m2r1, core

      sin1 = sin(lower%alpha)
      cos1 = cos(lower%alpha)
      tan2 = tan(upper%alpha)
      t = tan2/tan(lower%alpha)
      m1r1 = lower%mass*lower%radius**2
      m2r1 = upper%mass*lower%radius**2
      core = m1r1 + lower%central_inertia - upper%central_inertia*t
      eta = (core - 2.0_wp*m1r1*sin1**2 + m2r1*(2.0_wp + sin1*cos1/tan2 - sin1**2*(4.0_wp + t))) &
         & /(core + m2r1*(2.0_wp + sin1*cos1*(1.0_wp/tan2 + tan2)))
   end function two_block_sorrentino

   !> Inelastic impact of the two-body chain, and of the mass that it lifts, with the horizontal impulse of the top
   !> support (docs/theory.md, section 3)
   pure function two_block_impulse(lower, upper, overburden, points) result(eta)
      type(block_type), intent(in) :: lower
      type(block_type), intent(in) :: upper
      !> The load on the top; what is dead of it has no impulse
      type(overburden_type), intent(in) :: overburden
      !> What acts between base and top; absent, or not allocated: nothing
      type(carried_point_type), intent(in), optional :: points(:)
      !> Ratio of the angular velocities after and before an impact
      real(wp) :: eta

      real(wp) :: t, inertia, chain, load, pushed

      t = tan(upper%alpha)/tan(lower%alpha)
      inertia = lower%corner_inertia + t**2*upper%corner_inertia &
         & + 4.0_wp*sin(upper%alpha)**2*(1.0_wp + t)*upper%mass*upper%radius**2
      chain = lower%b**2*(lower%mass + upper%mass*(2.0_wp + t)**2)
      load = overburden%lifted*(lower%b*(2.0_wp + t) + overburden%eccentricity*t)**2
      pushed = 0.0_wp
      if (present(points)) then
         load = load + sum(points%lifted*merge(2.0_wp*lower%b*(1.0_wp + t) - t*points%e, points%e, points%is_upper)**2)
         pushed = sum(points%pushed*merge(t*points%f, points%f, points%is_upper)**2)
      end if
      eta = 1.0_wp - 2.0_wp*(chain + load)/(inertia + load + pushed)
   end function two_block_impulse

end module dondolo_wall_two_block
