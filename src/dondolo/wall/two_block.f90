!> Two-block wall: a strip held at its base and at its top that breaks at an intermediate hinge and folds out.
!>
!> Equation (3) of Nale et al. (Sorrentino, Masiani and Griffith 2008) in the common form (docs/theory.md,
!> section 2). q is the rotation of the lower block; the hinges at base and top stay on one vertical line, so that
!> sin(beta2) = R1 sin(beta1)/R2 with beta1 = alpha1 - q.
module dondolo_wall_two_block
   use dondolo_base_bracket, only : bracket_type
   use dondolo_base_error, only : error_type, not_at_rest, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : rounded
   use dondolo_wall_block, only : block_type
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: two_block_type, overburden_type, new_two_block
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
   contains
      procedure :: terms
      procedure :: potential
      procedure :: geometric_end
      procedure :: support
   end type two_block_type

contains

   !> Make the mechanism of a two-block wall
   subroutine new_two_block(mechanism, lower, upper, overburden, gravity, error)
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

      mechanism%two_sided = .true.
      mechanism%lower = lower
      mechanism%upper = upper
      mechanism%gravity = gravity
      mechanism%overburden = overburden
      mechanism%load_lever = lower%b - overburden%eccentricity
      call check_rest(mechanism, error)
      if (allocated(error)) return
      mechanism%capacity = moment_root(mechanism)
      ! A longer upper block never lies flat; else beta1 has the same bound to both sides.
      if (upper%radius <= lower%radius) then
         mechanism%highest = mechanism%geometric_end()
         mechanism%lowest = 2.0_wp*lower%alpha - mechanism%highest
      end if
   end subroutine new_two_block

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
      end associate
   end subroutine terms

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
      end associate
   end function potential

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
      end associate
   end subroutine support

   !> Check that the wall stands: a load beyond an inner hinge far behind the face can fold it by itself
   pure subroutine check_rest(mechanism, error)
      !> The mechanism, its capacity not yet known
      type(two_block_type), intent(in) :: mechanism
      !> It does not; both moments are in the message
      type(error_type), allocatable, intent(out) :: error

      type(two_block_type) :: bare
      real(wp) :: j, c, l, own, total, load

      call mechanism%terms(0.0_wp, j, c, total, l, load)
      if (total - load > 0.0_wp) return
      bare = mechanism
      bare%overburden = overburden_type()
      call bare%terms(0.0_wp, j, c, own, l, load)
      call mechanism%terms(0.0_wp, j, c, total, l, load)
      call raise_input(error, 'overburden: the wall is not stable at rest; its own weight resists with '//rounded(own)// &
         & ' N m per metre, the overburden folds it with '//rounded(own - total + load), not_at_rest, 'overburden')
   end subroutine check_rest

   !> Rotation at which G - Q vanishes: alpha1, or less where an overburden pushes out before
   pure function moment_root(mechanism) result(root)
      !> The mechanism, its capacity not yet known
      type(two_block_type), intent(in) :: mechanism
      !> Capacity rotation [rad]
      real(wp) :: root

      type(bracket_type) :: bracket

      root = mechanism%lower%alpha
      if (.not. (mechanism%overburden%weight > 0.0_wp .and. mechanism%load_lever > 0.0_wp)) return
      bracket%last = root
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
   pure function two_block_impulse(lower, upper, overburden) result(eta)
      type(block_type), intent(in) :: lower
      type(block_type), intent(in) :: upper
      !> The load on the top; what is dead of it has no impulse
      type(overburden_type), intent(in) :: overburden
      !> Ratio of the angular velocities after and before an impact
      real(wp) :: eta

      real(wp) :: t, inertia, chain, load

      t = tan(upper%alpha)/tan(lower%alpha)
      inertia = lower%corner_inertia + t**2*upper%corner_inertia &
         & + 4.0_wp*sin(upper%alpha)**2*(1.0_wp + t)*upper%mass*upper%radius**2
      chain = lower%b**2*(lower%mass + upper%mass*(2.0_wp + t)**2)
      load = overburden%lifted*(lower%b*(2.0_wp + t) + overburden%eccentricity*t)**2
      eta = 1.0_wp - 2.0_wp*(chain + load)/(inertia + load)
   end function two_block_impulse

end module dondolo_wall_two_block
