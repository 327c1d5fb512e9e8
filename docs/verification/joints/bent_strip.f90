!> A strip of two blocks whose joints bend before they open: its Lagrangian from the places of its points as complex numbers.
!>
!> Real parts are horizontal, towards the side that the strip folds to, imaginary parts upwards; the origin is the hinge at the
!> base. Turned by q the middle hinge is at C = (-t + i h_1) exp(-i q), and the top at C + (t + i h_2) exp(i p), whose real part
!> stays 0: that gives p(q). Inertia, weight moment and lever are sums over masses m at z(q):
!>
!>     J = sum m |z'|^2 + I p'^2     J'/2 = sum m Re(conj(z') z'') + I p' p''     M = sum m g Im z'     L = sum m Re z'
!>
!> The load on the top has M alone, and J by the part of it that is lifted.
module bent_strip
   implicit none
   private

   public :: new_strip, rk, strip_type

   integer, parameter :: rk = kind(1.0d0)
   complex(rk), parameter :: i = (0.0_rk, 1.0_rk)
   real(rk), parameter :: turn = 2.0_rk*acos(-1.0_rk)

   type :: strip_type
      !> Thickness and heights of the blocks [m], masses [kg/m], load [N/m], its mass that is lifted [kg/m], eccentricity [m],
      !> gravity [m/s2]
      real(rk) :: t = 0.0_rk, h1 = 0.0_rk, h2 = 0.0_rk, m1 = 0.0_rk, m2 = 0.0_rk
      real(rk) :: load = 0.0_rk, lifted = 0.0_rk, eccentricity = 0.0_rk, g = 0.0_rk
      !> Rotation at which the moment vanishes
      real(rk) :: capacity = 0.0_rk
      !> Closed joints: circular frequency, damping ratio, opening, J and L there, speed at it, speed ratio of a passage
      real(rk) :: w = 0.0_rk, xi = 0.0_rk, opening = 0.0_rk, inertia = 0.0_rk, lever = 0.0_rk, speed = 0.0_rk, ratio = 0.0_rk
   contains
      procedure :: terms
      procedure :: potential
   end type strip_type

contains

   !> Make a strip with the speed ratio `measured` of fast passages
   function new_strip(height, thickness, density, hinge, load, inertia, eccentricity, measured, period, damping, gravity) &
         & result(strip)
      real(rk), intent(in) :: height, thickness, density, hinge, load, inertia, eccentricity, measured, period, damping, gravity
      type(strip_type) :: strip

      real(rk) :: low, high, q, j, c, m, l, fall
      integer :: k

      strip%t = thickness
      strip%h1 = hinge*height
      strip%h2 = height - strip%h1
      strip%m1 = density*thickness*strip%h1
      strip%m2 = density*thickness*strip%h2
      strip%load = load
      strip%g = gravity
      strip%lifted = inertia*load/gravity
      strip%eccentricity = eccentricity
      strip%w = turn/period
      strip%xi = damping
      ! The moment falls from the start on, the line of the closed joints rises.
      low = 0.0_rk
      high = atan(thickness/strip%h1)
      do k = 1, 200
         q = 0.5_rk*(low + high)
         call strip%terms(q, j, c, m, l)
         if (m > 0.0_rk) then
            low = q
         else
            high = q
         end if
      end do
      strip%capacity = q
      low = 0.0_rk
      do k = 1, 200
         q = 0.5_rk*(low + high)
         call strip%terms(q, j, c, m, l)
         if (j*strip%w**2*q < m) then
            low = q
         else
            high = q
         end if
      end do
      strip%opening = q
      strip%inertia = j
      strip%lever = l
      strip%speed = strip%w*q
      fall = sqrt(2.0_rk*(strip%potential(0.5_rk*strip%capacity) - strip%potential(q))/j)
      strip%ratio = min(1.0_rk, measured + 4.0_rk*damping*strip%speed/fall)
   end function new_strip

   !> Inertia J, half its derivative, moment M and lever L at a rotation
   pure subroutine terms(self, q, j, c, m, l)
      class(strip_type), intent(in) :: self
      real(rk), intent(in) :: q
      real(rk), intent(out) :: j, c, m, l

      complex(rk) :: hinge, arm, first, second, lower, top
      real(rk) :: spin, bend

      call turned(self, q, hinge, arm, spin, bend)
      lower = -i*0.5_rk*hinge
      first = -i*hinge + i*spin*0.5_rk*arm
      second = -hinge + 0.5_rk*arm*(i*bend - spin**2)
      j = self%m1*(self%t**2 + self%h1**2)/3.0_rk + self%m2*abs(first)**2 + block_inertia(self)*spin**2
      c = self%m2*real(conjg(first)*second, rk) + block_inertia(self)*spin*bend
      m = self%g*(self%m1*aimag(lower) + self%m2*aimag(first))
      l = self%m1*real(lower, rk) + self%m2*real(first, rk)
      if (.not. self%load > 0.0_rk) return
      top = loaded(self)*arm/cmplx(self%t, self%h2, rk)
      first = -i*hinge + i*spin*top
      second = -hinge + top*(i*bend - spin**2)
      j = j + self%lifted*aimag(first)**2
      c = c + self%lifted*aimag(first)*aimag(second)
      m = m + self%load*aimag(first)
   end subroutine terms

   !> Potential energy at a rotation [J/m]
   pure real(rk) function potential(self, q) result(v)
      class(strip_type), intent(in) :: self
      real(rk), intent(in) :: q

      complex(rk) :: hinge, arm
      real(rk) :: spin, bend

      call turned(self, q, hinge, arm, spin, bend)
      v = self%g*(self%m1*aimag(0.5_rk*hinge) + self%m2*aimag(hinge + 0.5_rk*arm)) &
         & + self%load*aimag(hinge + loaded(self)*arm/cmplx(self%t, self%h2, rk))
   end function potential

   !> Middle hinge and from it the top at a rotation of the lower block, p' and p'' of the upper one
   pure subroutine turned(self, q, hinge, arm, spin, bend)
      class(strip_type), intent(in) :: self
      real(rk), intent(in) :: q
      complex(rk), intent(out) :: hinge, arm
      real(rk), intent(out) :: spin, bend

      complex(rk) :: rest

      hinge = cmplx(-self%t, self%h1, rk)*exp(-i*q)
      rest = cmplx(self%t, self%h2, rk)
      arm = rest*exp(i*(acos(-real(hinge, rk)/abs(rest)) - atan2(self%h2, self%t)))
      spin = aimag(hinge)/aimag(arm)
      bend = -(real(hinge, rk) + spin**2*real(arm, rk))/aimag(arm)
   end subroutine turned

   !> Place of the load from the middle hinge, at rest
   pure complex(rk) function loaded(self)
      class(strip_type), intent(in) :: self

      loaded = cmplx(0.5_rk*self%t + self%eccentricity, self%h2, rk)
   end function loaded

   !> Inertia of the upper block about its centroid
   pure real(rk) function block_inertia(self)
      class(strip_type), intent(in) :: self

      block_inertia = self%m2*(self%t**2 + self%h2**2)/12.0_rk
   end function block_inertia

end module bent_strip
