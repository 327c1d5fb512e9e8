!> Polynomials of Chebyshev that interpolate a smooth function on -1 <= z <= 1 to rounding.
!>
!> A series c_0 T_0 + c_1 T_1 + ... through the roots of the next polynomial; its coefficients fall geometrically for an
!> analytic function, so that their tail tells the error (Trefethen 2013, Approximation Theory and Approximation
!> Practice, chapters 3 and 8).
module dondolo_base_chebyshev
   use dondolo_base_kinds, only : pi, wp
   implicit none
   private

   public :: chebyshev_nodes, chebyshev_series, chebyshev_integral, chebyshev_slope, chebyshev_value, as_powers

contains

   !> The nodes: roots of T_n, from the right
   pure function chebyshev_nodes(n) result(z)
      !> Number of nodes
      integer, intent(in) :: n
      !> The nodes
      real(wp) :: z(n)

      integer :: i

      do i = 1, n
         z(i) = cos(pi*(real(i, wp) - 0.5_wp)/real(n, wp))
      end do
   end function chebyshev_nodes

   !> Series of the polynomial through values at the nodes
   pure function chebyshev_series(values) result(c)
      !> Values at chebyshev_nodes
      real(wp), intent(in) :: values(:)
      !> Coefficients
      real(wp) :: c(0:size(values) - 1)

      real(wp) :: cosine(0:4*size(values) - 1)
      integer :: i, k, n

      ! Angles are multiples of a part of a turn, in integers, so that each cosine has all its digits.
      n = size(values)
      do i = 0, 4*n - 1
         cosine(i) = cos(pi*real(i, wp)/real(2*n, wp))
      end do
      do k = 0, n - 1
         c(k) = 0.0_wp
         do i = 1, n
            c(k) = c(k) + values(i)*cosine(modulo(k*(2*i - 1), 4*n))
         end do
         c(k) = 2.0_wp*c(k)/real(n, wp)
      end do
      c(0) = 0.5_wp*c(0)
   end function chebyshev_series

   !> Series of the integral from -1
   pure function chebyshev_integral(c) result(integral)
      !> Coefficients, two at least
      real(wp), intent(in) :: c(0:)
      !> Coefficients of the integral
      real(wp) :: integral(0:size(c))

      real(wp) :: padded(0:size(c) + 1)
      integer :: k

      padded = 0.0_wp
      padded(:size(c) - 1) = c
      padded(0) = 2.0_wp*c(0)
      do k = 1, size(c)
         integral(k) = (padded(k - 1) - padded(k + 1))/real(2*k, wp)
      end do
      integral(0) = 0.0_wp
      integral(0) = -chebyshev_value(integral, -1.0_wp)
   end function chebyshev_integral

   !> Series of the derivative; of a constant 0
   pure function chebyshev_slope(c) result(slope)
      !> Coefficients
      real(wp), intent(in) :: c(0:)
      !> Coefficients of the derivative
      real(wp) :: slope(0:max(0, ubound(c, 1) - 1))

      real(wp) :: padded(0:ubound(c, 1) + 1)
      integer :: k

      ! c'_(k-1) = c'_(k+1) + 2 k c_k
      padded = 0.0_wp
      do k = ubound(c, 1), 1, -1
         padded(k - 1) = padded(k + 1) + 2.0_wp*real(k, wp)*c(k)
      end do
      padded(0) = 0.5_wp*padded(0)
      slope = padded(:ubound(slope, 1))
   end function chebyshev_slope

   !> Value of a series (Clenshaw's recurrence)
   pure function chebyshev_value(c, z) result(value)
      !> Coefficients
      real(wp), intent(in) :: c(0:)
      !> Place, -1 <= z <= 1
      real(wp), intent(in) :: z
      !> Value
      real(wp) :: value

      real(wp) :: b, b1, b2
      integer :: k

      b1 = 0.0_wp
      b2 = 0.0_wp
      do k = ubound(c, 1), 1, -1
         b = c(k) + 2.0_wp*z*b1 - b2
         b2 = b1
         b1 = b
      end do
      value = c(0) + z*b1 - b2
   end function chebyshev_value

   !> The same polynomial in powers of z
   pure function as_powers(c) result(a)
      !> Coefficients of a series
      real(wp), intent(in) :: c(0:)
      !> Coefficients of 1, z, z^2, ...
      real(wp) :: a(0:ubound(c, 1))

      real(wp) :: before(0:ubound(c, 1)), this(0:ubound(c, 1)), next(0:ubound(c, 1))
      integer :: k, n

      ! T_(k+1) = 2 z T_k - T_(k-1)
      n = ubound(c, 1)
      this = 0.0_wp
      this(0) = 1.0_wp
      before = 0.0_wp
      if (n > 0) before(1) = 1.0_wp
      a = c(0)*this
      do k = 1, n
         next(0) = -before(0)
         next(1:) = 2.0_wp*this(:n - 1) - before(1:)
         before = this
         this = next
         a = a + c(k)*this
      end do
   end function as_powers

end module dondolo_base_chebyshev
