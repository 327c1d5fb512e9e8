!> Chebyshev series against functions whose series, integral and powers are known.
program test_chebyshev
   use checks, only : check, check_close, finish, suite
   use dondolo_base_chebyshev, only : as_powers, chebyshev_integral, chebyshev_nodes, chebyshev_series, chebyshev_value
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   implicit none

   real(wp), parameter :: eps = epsilon(1.0_wp)

   !> Places where series are compared with functions: both ends, the middle, and between
   real(wp), parameter :: places(9) = [-1.0_wp, -0.93_wp, -0.5_wp, -0.1_wp, 0.0_wp, 0.2_wp, 0.61_wp, 0.99_wp, 1.0_wp]

   call test_nodes()
   call test_polynomials()
   call test_known_series()
   call test_values()
   call test_integrals()
   call test_powers()
   call finish()

contains

   !> The nodes are the roots of T_n(cos x) = cos(n x)
   subroutine test_nodes()
      integer, parameter :: numbers(4) = [1, 2, 7, 40]
      integer :: i, n

      call suite('nodes')
      do i = 1, size(numbers)
         n = numbers(i)
         associate (z => chebyshev_nodes(n))
            call check(all(abs(cos(n*acos(z))) < 10.0_wp*n*eps), 'roots for n = '//to_text(n))
            call check(all(z(2:) < z(:n - 1)) .and. all(abs(z) < 1.0_wp), 'from the right, within (-1, 1)')
         end associate
      end do
   end subroutine test_nodes

   !> A polynomial of Chebyshev has itself alone in its series
   subroutine test_polynomials()
      integer, parameter :: n = 12
      real(wp) :: c(0:n - 1), expected(0:n - 1)
      integer :: k

      call suite('one polynomial')
      do k = 0, n - 1
         c = chebyshev_series(cos(real(k, wp)*acos(chebyshev_nodes(n))))
         expected = 0.0_wp
         expected(k) = 1.0_wp
         call check(all(abs(c - expected) < 20.0_wp*eps), 'series of T_'//to_text(k))
      end do
      c(:0) = chebyshev_series([3.0_wp])
      call check(c(0) == 3.0_wp, 'one node, one constant')
   end subroutine test_polynomials

   !> exp has the series I_0(1) + 2 sum I_k(1) T_k with the modified Bessel functions; |T_k| coefficients of
   !> 1/(z - 2) are -2/sqrt(3) (2 - sqrt(3))^k
   subroutine test_known_series()
      real(wp), parameter :: bessel(0:5) = [1.2660658777520084_wp, 0.56515910399248503_wp, 0.13574766976703829_wp, &
         & 0.022168424924331902_wp, 0.0027371202210468663_wp, 2.7146315595697187e-4_wp]
      integer, parameter :: n = 40
      real(wp) :: c(0:n - 1)
      integer :: k

      call suite('known series')
      c = chebyshev_series(exp(chebyshev_nodes(n)))
      call check_close(c(0), bessel(0), 1.0e-15_wp, 'exp, T_0')
      do k = 1, 5
         call check_close(c(k), 2.0_wp*bessel(k), 0.0_wp, 'exp, T_'//to_text(k), 1.0e-15_wp)
      end do
      call check(all(abs(c(20:)) < 10.0_wp*eps), 'the tail of exp is rounding')
      c = chebyshev_series(1.0_wp/(chebyshev_nodes(n) - 2.0_wp))
      call check_close(c(0), -1.0_wp/sqrt(3.0_wp), 4.0_wp*eps, '1/(z - 2), T_0')
      do k = 1, 20
         call check_close(c(k), -2.0_wp/sqrt(3.0_wp)*(2.0_wp - sqrt(3.0_wp))**k, 0.0_wp, '1/(z - 2), T_'//to_text(k), &
            & 4.0_wp*eps)
      end do
   end subroutine test_known_series

   !> Values between the nodes
   subroutine test_values()
      integer, parameter :: n = 40
      real(wp) :: c(0:n - 1)
      integer :: i

      call suite('values')
      c = chebyshev_series(exp(chebyshev_nodes(n))*sin(3.0_wp*chebyshev_nodes(n)))
      do i = 1, size(places)
         call check_close(chebyshev_value(c, places(i)), exp(places(i))*sin(3.0_wp*places(i)), 0.0_wp, &
            & 'at '//to_text(places(i)), 20.0_wp*eps)
      end do
      call check(chebyshev_value([5.0_wp], 0.3_wp) == 5.0_wp, 'a constant')
      call check_close(chebyshev_value([1.0_wp, 2.0_wp], 0.3_wp), 1.6_wp, 2.0_wp*eps, 'a straight line')
   end subroutine test_values

   !> The integral from -1, where it is zero
   subroutine test_integrals()
      integer, parameter :: n = 40
      real(wp) :: c(0:n), short(0:2)
      integer :: i

      call suite('integrals')
      c = chebyshev_integral(chebyshev_series(cos(2.0_wp*chebyshev_nodes(n))))
      do i = 1, size(places)
         call check_close(chebyshev_value(c, places(i)), 0.5_wp*(sin(2.0_wp*places(i)) + sin(2.0_wp)), 0.0_wp, &
            & 'of cos 2z at '//to_text(places(i)), 20.0_wp*eps)
      end do
      ! 1 + 2 z has the integral z + z^2, which is 0 at -1; z^2 = (1 + T_2)/2
      short = chebyshev_integral([1.0_wp, 2.0_wp])
      call check(all(abs(short - [0.5_wp, 1.0_wp, 0.5_wp]) <= 2.0_wp*eps), 'of 1 + 2 z')
   end subroutine test_integrals

   !> Powers of z: T_5 = 16 z^5 - 20 z^3 + 5 z, and the coefficients 1/k! of exp
   subroutine test_powers()
      real(wp) :: a(0:22), series(0:39), factorial
      integer :: i, k

      call suite('powers')
      call check(all(as_powers([0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp]) == &
         & [0.0_wp, 5.0_wp, 0.0_wp, -20.0_wp, 0.0_wp, 16.0_wp]), 'T_5')
      call check(all(as_powers([7.0_wp]) == [7.0_wp]), 'T_0')
      call check(all(as_powers([7.0_wp, 2.0_wp]) == [7.0_wp, 2.0_wp]), 'T_0 and T_1')
      call check(all(as_powers([1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp]) == [-2.0_wp, -10.0_wp, 6.0_wp, 16.0_wp]), 'T_0 to T_3')
      series = chebyshev_series(exp(chebyshev_nodes(40)))
      a(:14) = as_powers(series(:14))
      factorial = 1.0_wp
      do k = 0, 8
         factorial = factorial*max(k, 1)
         call check_close(a(k), 1.0_wp/factorial, 0.0_wp, 'exp, z^'//to_text(k), 1.0e-11_wp)
      end do
      a = as_powers(series(:22))
      do i = 1, size(places)
         call check_close(horner(a, places(i)), exp(places(i)), 0.0_wp, 'exp in powers at '//to_text(places(i)), &
            & 30.0_wp*eps)
      end do
   end subroutine test_powers

   !> Value of a polynomial in powers
   pure real(wp) function horner(a, z)
      real(wp), intent(in) :: a(0:), z
      integer :: k

      horner = 0.0_wp
      do k = ubound(a, 1), 0, -1
         horner = horner*z + a(k)
      end do
   end function horner

end program test_chebyshev
