!> The linearised rocking block of the classic papers (sin(alpha - q) -> alpha - q, cos -> 1), for tests only:
!> q'' = -p^2 (alpha - q) - s p^2 u_g''/g.
module linear_block
   use dondolo_base_kinds, only : wp
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: linear_block_type, new_linear_block

   !> Linearised block, J = 1
   type, extends(mechanism_type) :: linear_block_type
      real(wp) :: p2
   contains
      procedure :: terms
      procedure :: potential
      procedure :: geometric_end
      procedure :: support
      procedure :: motion
      procedure :: peak_after
   end type linear_block_type

contains

   !> Linearised block of given p, alpha and speed ratio
   pure function new_linear_block(p, alpha, restitution, two_sided) result(block)
      real(wp), intent(in) :: p, alpha, restitution
      logical, intent(in) :: two_sided
      type(linear_block_type) :: block

      block%p2 = p**2
      block%capacity = alpha
      block%restitution = restitution
      block%two_sided = two_sided
   end function new_linear_block

   pure subroutine terms(self, q, j, c, g, l, load)
      class(linear_block_type), intent(in) :: self
      real(wp), intent(in) :: q
      real(wp), intent(out) :: j, c, g, l, load

      j = 1.0_wp
      c = 0.0_wp
      g = self%p2*(self%capacity - q)
      l = self%p2/9.81_wp
      load = 0.0_wp
   end subroutine terms

   pure function potential(self, q) result(v)
      class(linear_block_type), intent(in) :: self
      real(wp), intent(in) :: q
      real(wp) :: v

      v = -0.5_wp*self%p2*(self%capacity - q)**2
   end function potential

   pure function geometric_end(self) result(q)
      class(linear_block_type), intent(in) :: self
      real(wp) :: q

      q = huge(self%p2)
   end function geometric_end

   pure subroutine support(self, share, tilt)
      class(linear_block_type), intent(in) :: self
      real(wp), intent(out) :: share, tilt

      share = 0.0_wp*self%p2
      tilt = 0.0_wp
   end subroutine support

   !> Rotation and velocity after a time t, in closed form, under a push -s u_g''/(alpha g) = x + r t
   pure function motion(self, start, x, r, t) result(state)
      class(linear_block_type), intent(in) :: self
      real(wp), intent(in) :: start(2), x, r, t
      real(wp) :: state(2), c, d, p

      p = sqrt(self%p2)
      associate (alpha => self%capacity)
         c = start(1) - alpha*(1.0_wp - x)
         d = (start(2) + alpha*r)/p
         state(1) = alpha*(1.0_wp - x - r*t) + c*cosh(p*t) + d*sinh(p*t)
         state(2) = -alpha*r + p*(c*sinh(p*t) + d*cosh(p*t))
      end associate
   end function motion

   !> Time and rotation of the peak that follows a state moving outwards in still ground
   pure function peak_after(self, state) result(peak)
      class(linear_block_type), intent(in) :: self
      real(wp), intent(in) :: state(2)
      real(wp) :: peak(2), p

      p = sqrt(self%p2)
      associate (alpha => self%capacity)
         peak(1) = atanh(state(2)/(p*(alpha - state(1))))/p
         peak(2) = alpha - sqrt((alpha - state(1))**2 - (state(2)/p)**2)
      end associate
   end function peak_after

end module linear_block
