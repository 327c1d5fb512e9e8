!> Two blocks between two supports, by their Lagrangian: base and top move by themselves.
module strip
   use rocking_wall, only : gravity, shortest, state_type, wall_type
   use support_motion, only : base, delta, rise, rk, speed
   implicit none
   private

   public :: strip_type, new_strip

   !> y is the opening from the straight wall, the mode its side, 0 at rest
   type, extends(wall_type) :: strip_type
      private
      real(rk) :: b
      real(rk) :: h1, h2
      real(rk) :: m1, m2
      real(rk) :: i1, i2
      real(rk) :: r1, r2
      real(rk) :: load, lifted_mass, arm
      real(rk) :: ratio
   contains
      procedure :: moves
      procedure :: rate
      procedure :: urge
      procedure :: leave
      procedure :: carry
      procedure :: level
      procedure :: counts
      procedure :: jump
      procedure, private :: balance
      procedure, private :: push
      procedure, private :: capacity
   end type strip_type

contains

   !> Height, thickness and depth of the hinges behind the faces in m, height of the hinge as a part; ratio of speeds (0: by
   !> balance, times `factor`); load in N/m, the part of it whose mass moves, and its eccentricity in m; density in kg/m3
   pure function new_strip(height, thickness, hinge, ratio, factor, load, lifted, eccentricity, depth, density) result(wall)
      real(rk), intent(in) :: height, thickness, hinge, ratio, factor, load, lifted, eccentricity, depth, density
      type(strip_type) :: wall

      wall%urges = 2
      wall%levels = 1
      wall%span = height
      wall%b = 0.5_rk*thickness - depth
      wall%h1 = 0.5_rk*hinge*height
      wall%h2 = 0.5_rk*(1.0_rk - hinge)*height
      wall%m1 = 2.0_rk*density*thickness*wall%h1
      wall%m2 = 2.0_rk*density*thickness*wall%h2
      wall%i1 = wall%m1*(0.25_rk*thickness**2 + wall%h1**2)/3.0_rk
      wall%i2 = wall%m2*(0.25_rk*thickness**2 + wall%h2**2)/3.0_rk
      wall%r1 = hypot(wall%b, wall%h1)
      wall%r2 = hypot(wall%b, wall%h2)
      wall%load = load
      wall%lifted_mass = lifted*load/gravity
      wall%arm = wall%b - eccentricity
      wall%limit = wall%capacity()
      wall%ratio = ratio
      if (ratio <= 0.0_rk) wall%ratio = factor*wall%balance()
   end function new_strip

   !> Ratio of speeds by the balance of angular momentum about the new base hinge
   pure real(rk) function balance(wall)
      class(strip_type), intent(in) :: wall
      real(rk) :: i1, i2, fixed, top, sine, cosine, cot, ratio, after

      i1 = wall%m1*wall%r1**2/3.0_rk
      i2 = wall%m2*wall%r2**2/3.0_rk
      sine = wall%b/wall%r1
      cosine = wall%h1/wall%r1
      cot = wall%h2/wall%b
      ratio = wall%h1/wall%h2
      fixed = wall%m1*wall%r1**2 + i1 - i2*ratio
      top = wall%m2*wall%r1**2
      after = fixed + top*(2.0_rk + sine*cosine*(cot + 1.0_rk/cot))
      balance = (fixed - 2.0_rk*wall%m1*(wall%r1*sine)**2 &
         & + top*(2.0_rk + sine*cosine*cot - sine**2*(4.0_rk + ratio)))/after
   end function balance

   !> What drives the lower block back, and its inertia: rotation q and speed of the lower block, drift d of the top and its
   !> derivatives, acceleration of the base, all of the side that opens
   pure subroutine push(wall, q, turning, d, d1, d2, ground, moment, inertia)
      class(strip_type), intent(in) :: wall
      real(rk), intent(in) :: q, turning, d, d1, d2, ground
      real(rk), intent(out) :: moment, inertia
      real(rk) :: sine, cosine, s1, c1, s2, c2, k, p, k_q, k_d, p_d, w, w_q, w_d, z, z_d, c, mixed, e, f
      real(rk) :: cos_psi, sin_psi, y, y_q, y_d, up, up_d

      sine = sin(q)
      cosine = cos(q)
      s1 = wall%b*cosine - wall%h1*sine
      c1 = wall%h1*cosine + wall%b*sine
      s2 = s1 + 0.5_rk*d
      c2 = sqrt(wall%r2**2 - s2*s2)
      p = 0.5_rk/c2
      k = 2.0_rk*c1*p
      k_q = 2.0_rk*p*(s1 - k*k*s2)
      k_d = 2.0_rk*p*k*p*s2
      p_d = 2.0_rk*p*p*p*s2
      w = 2.0_rk*s1 + s2*k
      w_q = -2.0_rk*c1 - c1*k + s2*k_q
      w_d = s2*k_d + 0.5_rk*k
      z = -s2*p
      z_d = -0.5_rk*p - s2*p_d
      inertia = wall%m1*wall%r1**2 + wall%i1 + wall%m2*(c1*c1 + w*w) + wall%i2*k*k
      c = wall%m2*(c1*s1 + w*w_q) + wall%i2*k*k_q
      mixed = wall%m2*w*w_d + wall%i2*k*k_d
      e = wall%m2*w*z_d - wall%i2*k*p_d
      f = wall%m2*(0.5_rk*c1 + z*w) - wall%i2*k*p
      moment = gravity*(wall%m1*s1 + wall%m2*w)
      if (wall%load > 0.0_rk) then
         ! psi, the upper block's rotation, with tan a2 = b/h2
         cos_psi = (wall%h2*c2 + wall%b*s2)/wall%r2**2
         sin_psi = (wall%b*c2 - wall%h2*s2)/wall%r2**2
         y = 2.0_rk*s1 + 2.0_rk*s2*k - wall%arm*k*cos_psi
         moment = moment + wall%load*y
         if (wall%lifted_mass > 0.0_rk) then
            up = -2.0_rk*s2*p + wall%arm*p*cos_psi
            y_q = -2.0_rk*c1*(1.0_rk + k) + 2.0_rk*s2*k_q - wall%arm*(k_q*cos_psi - k*k*sin_psi)
            y_d = k + 2.0_rk*s2*k_d - wall%arm*(k_d*cos_psi + k*p*sin_psi)
            up_d = -p - 2.0_rk*s2*p_d + wall%arm*(p_d*cos_psi + p*p*sin_psi)
            inertia = inertia + wall%lifted_mass*y*y
            c = c + wall%lifted_mass*y*y_q
            mixed = mixed + wall%lifted_mass*y*y_d
            f = f + wall%lifted_mass*y*up
            e = e + wall%lifted_mass*y*up_d
         end if
      end if
      moment = moment + c*turning**2 + 2.0_rk*mixed*turning*d1 + e*d1**2 + f*d2 + (wall%m1 + wall%m2)*c1*ground
   end subroutine push

   !> Rotation at which the restoring moment vanishes
   pure real(rk) function capacity(wall)
      class(strip_type), intent(in) :: wall
      real(rk) :: low, high, middle

      low = 0.0_rk
      high = atan2(wall%b, wall%h1)
      if (restoring(wall, high) < 0.0_rk) then
         do
            middle = 0.5_rk*(low + high)
            if (middle <= low .or. middle >= high) exit
            if (restoring(wall, middle) > 0.0_rk) then
               low = middle
            else
               high = middle
            end if
         end do
      end if
      capacity = high
   end function capacity

   pure real(rk) function restoring(wall, q)
      class(strip_type), intent(in) :: wall
      real(rk), intent(in) :: q
      real(rk) :: inertia

      call wall%push(q, 0.0_rk, 0.0_rk, 0.0_rk, 0.0_rk, 0.0_rk, restoring, inertia)
   end function restoring

   pure logical function moves(wall, mode)
      class(strip_type), intent(in) :: wall
      integer, intent(in) :: mode

      moves = mode /= 0
   end function moves

   !> Acceleration of the opening
   pure function rate(wall, state, y, v, x) result(a)
      class(strip_type), intent(in) :: wall
      type(state_type), intent(in) :: state
      real(rk), intent(in) :: y, v, x(4)
      real(rk) :: a

      a = opening(wall, real(state%mode, rk), y, v, x)
   end function rate

   pure real(rk) function opening(wall, side, y, v, x)
      type(strip_type), intent(in) :: wall
      real(rk), intent(in) :: side, y, v, x(4)
      real(rk) :: d, d1, d2, root, moment, inertia

      d = side*x(delta)
      d1 = side*x(speed)
      d2 = side*x(rise)
      root = sqrt(wall%span**2 - d*d)
      ! The straight wall is at asin(d/H)
      call wall%push(y + asin(d/wall%span), v + d1/root, d, d1, d2, side*x(base), moment, inertia)
      opening = -moment/inertia - d2/root - d*d1*d1/root**3
   end function opening

   !> Each side
   pure function urge(wall, number, state, x) result(a)
      class(strip_type), intent(in) :: wall
      integer, intent(in) :: number
      type(state_type), intent(in) :: state
      real(rk), intent(in) :: x(4)
      real(rk) :: a

      a = opening(wall, real(3 - 2*number, rk), state%y, state%v, x)
   end function urge

   pure subroutine leave(wall, number, state, x)
      class(strip_type), intent(in) :: wall
      integer, intent(in) :: number
      type(state_type), intent(inout) :: state
      real(rk), intent(in) :: x(4)

      state%mode = 3 - 2*number
   end subroutine leave

   !> It rests between its supports, wherever they are, and has no memory
   pure subroutine carry(wall, state, x)
      class(strip_type), intent(in) :: wall
      type(state_type), intent(inout) :: state
      real(rk), intent(in) :: x(4)

   end subroutine carry

   !> The opening closes
   pure subroutine level(wall, number, state, y, v, a, x, g, slope)
      class(strip_type), intent(in) :: wall
      integer, intent(in) :: number
      type(state_type), intent(in) :: state
      real(rk), intent(in) :: y, v, a, x(4)
      real(rk), intent(out) :: g, slope

      g = y
      slope = v
   end subroutine level

   pure logical function counts(wall, number, state, y, x)
      class(strip_type), intent(in) :: wall
      integer, intent(in) :: number
      type(state_type), intent(in) :: state
      real(rk), intent(in) :: y, x(4)

      counts = .true.
   end function counts

   !> All joints close: the wall opens to its other side with a part of its speed, or is at rest
   pure subroutine jump(wall, number, state, x)
      class(strip_type), intent(in) :: wall
      integer, intent(in) :: number
      type(state_type), intent(inout) :: state
      real(rk), intent(in) :: x(4)
      real(rk) :: there, back, side

      side = -real(state%mode, rk)
      state%y = 0.0_rk
      state%v = wall%ratio*abs(state%v)
      there = opening(wall, side, 0.0_rk, 0.0_rk, x)
      back = opening(wall, -side, 0.0_rk, 0.0_rk, x)
      state%mode = -state%mode
      if (there < 0.0_rk .and. back < 0.0_rk .and. 2.0_rk*state%v < shortest*abs(there)) then
         state%mode = 0
         state%v = 0.0_rk
      end if
   end subroutine jump

end module strip
