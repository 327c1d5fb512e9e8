!> Fits of fragility curves against closed forms and published data (docs/theory.md, section 6).
program test_fragility
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use checks, only : check, check_close, check_error, check_ok, check_text, finish, suite
   use dondolo_error, only : error_type
   use dondolo_fragility, only : fit_fragility, fragility_type, normal_cdf
   use dondolo_kinds, only : dp
   use dondolo_typology, only : combine_population, combine_walls, typology_type
   implicit none

   call test_two_stripes()
   call test_published()
   call test_statuses()
   call test_invariances()
   call test_wrong_counts()
   call test_typology()
   call finish()

contains

   !> Fit that must succeed
   function fitted(levels, collapses, histories, what) result(curve)
      real(dp), intent(in) :: levels(:), collapses(:), histories(:)
      character(len=*), intent(in) :: what
      type(fragility_type) :: curve
      type(error_type), allocatable :: error

      call fit_fragility(curve, levels, collapses, histories, error)
      call check_ok(error, what)
   end function fitted

   !> With two stripes the curve goes through both fractions
   subroutine test_two_stripes()
      type(fragility_type) :: curve

      call suite('two stripes')
      curve = fitted([0.2_dp, 0.4_dp], [11.0_dp, 33.0_dp], [44.0_dp, 44.0_dp], 'fit')
      call check_text(curve%status, 'ok', 'status')
      call check_close(curve%theta, sqrt(0.08_dp), 1.0e-12_dp, 'theta')
      call check_close(curve%beta, 0.513830774_dp, 1.0e-9_dp, 'beta')
      call check_close(curve%probability(0.2_dp), 0.25_dp, 1.0e-12_dp, 'P(0.2)')
      call check_close(curve%probability(0.4_dp), 0.75_dp, 1.0e-12_dp, 'P(0.4)')
      call check_close(curve%bracket(1), 0.2_dp, 0.0_dp, 'bracket below')
      call check_close(curve%bracket(2), 0.4_dp, 0.0_dp, 'bracket above')
   end subroutine test_two_stripes

   !> Two public data sets with their standard errors
   subroutine test_published()
      real(dp), parameter :: levels(16) = [0.178_dp, 0.274_dp, 0.444_dp, 0.56_dp, 0.652_dp, 0.79_dp, 0.982_dp, &
         & 1.246_dp, 1.564_dp, 2.014_dp, 2.417_dp, 3.021_dp, 3.625_dp, 4.028_dp, 4.431_dp, 5.035_dp]
      real(dp), parameter :: collapses(16) = [0, 0, 0, 0, 0, 4, 13, 23, 38, 41, 44, 45, 45, 45, 45, 45]
      type(fragility_type) :: curve

      call suite('published data')
      curve = fitted(levels, collapses, spread(45.0_dp, 1, 16), 'sixteen stripes of 45')
      call check_text(curve%status, 'ok', 'status')
      call check_close(curve%theta, 1.2194475_dp, 5.0e-8_dp, 'theta')
      call check_close(curve%beta, 0.3100660_dp, 2.0e-7_dp, 'beta')
      call check_close(curve%log_likelihood, -12.8704444_dp, 5.0e-9_dp, 'log likelihood')
      call check_close(curve%se_ln_theta(), 0.02926_dp, 2.0e-4_dp, 'standard error of ln theta')
      call check_close(curve%se_beta(), 0.02532_dp, 2.0e-4_dp, 'standard error of beta')

      curve = fitted([1.0_dp, 1.5_dp, 2.0_dp], [0.0_dp, 2.0_dp, 2.0_dp], [59.0_dp, 50.0_dp, 44.0_dp], 'unequal stripes')
      call check_text(curve%status, 'extrapolated', 'status')
      call check_close(curve%theta, 5.85981_dp, 1.0e-6_dp, 'theta')
      call check_close(curve%beta, 0.684495_dp, 1.0e-6_dp, 'beta')
   end subroutine test_published

   !> Every case without a finite maximum has a status, and a bracket instead of a number
   subroutine test_statuses()
      real(dp), parameter :: n(3) = 44.0_dp, x(3) = [0.1_dp, 0.2_dp, 0.3_dp]

      call suite('statuses')
      call expect('no_collapse', x, [0.0_dp, 0.0_dp, 0.0_dp], n, 0.3_dp, huge(0.0_dp))
      call expect('all_collapse', x, n, n, 0.0_dp, 0.1_dp)
      call expect('separated', x, [0.0_dp, 0.0_dp, 44.0_dp], n, 0.2_dp, 0.3_dp)
      call expect('separated', x, [0.0_dp, 5.0_dp, 44.0_dp], n, 0.2_dp, 0.3_dp)
      call expect('separated', x, [0.0_dp, 40.0_dp, 44.0_dp], n, 0.1_dp, 0.2_dp)
      call expect('separated', x, [0.0_dp, 0.0_dp, 5.0_dp], n, 0.3_dp, huge(0.0_dp))
      call expect('single_level', [0.2_dp], [10.0_dp], [44.0_dp], 0.2_dp, huge(0.0_dp))
      call expect('decreasing', x, [30.0_dp, 20.0_dp, 10.0_dp], n, 0.3_dp, 0.1_dp)
      call expect('decreasing', x, [10.0_dp, 10.0_dp, 10.0_dp], n, 0.3_dp, huge(0.0_dp))
      call expect('decreasing', x, [44.0_dp, 44.0_dp, 0.0_dp], n, 0.3_dp, 0.1_dp)
   end subroutine test_statuses

   !> A status without a curve
   subroutine expect(status, levels, collapses, histories, below, above)
      character(len=*), intent(in) :: status
      real(dp), intent(in) :: levels(:), collapses(:), histories(:), below, above
      type(fragility_type) :: curve

      curve = fitted(levels, collapses, histories, status)
      call check_text(trim(curve%status), status, 'status')
      call check(.not. curve%has_fit(), status//' has no curve')
      call check(curve%theta == 0.0_dp .and. curve%beta == 0.0_dp, status//' has no number')
      call check_close(curve%bracket(1), below, 0.0_dp, status//': bracket below')
      call check_close(curve%bracket(2), above, 0.0_dp, status//': bracket above')
   end subroutine expect

   !> Order and unit of the levels, and splitting a stripe, change nothing
   subroutine test_invariances()
      real(dp), parameter :: x(4) = [0.1_dp, 0.2_dp, 0.4_dp, 0.7_dp], z(4) = [1, 9, 30, 41], n(4) = 44
      integer, parameter :: order(4) = [3, 1, 4, 2]
      type(fragility_type) :: curve, other

      call suite('invariances of the fit')
      curve = fitted(x, z, n, 'fit')
      other = fitted(x(order), z(order), n(order), 'other order')
      call check_close(other%theta, curve%theta, 1.0e-13_dp, 'theta in another order')
      other = fitted(x*981.0_dp, z, n, 'other unit')
      call check_close(other%theta, 981.0_dp*curve%theta, 1.0e-13_dp, 'theta in another unit')
      call check_close(other%beta, curve%beta, 1.0e-13_dp, 'beta in another unit')
      other = fitted([x, x], [z - 1.0_dp, spread(1.0_dp, 1, 4)], [n - 4.0_dp, spread(4.0_dp, 1, 4)], 'split stripes')
      call check_close(other%theta, curve%theta, 1.0e-13_dp, 'theta of split stripes')
      call check_close(other%se_beta(), curve%se_beta(), 1.0e-11_dp, 'standard error of split stripes')
      other = fitted(x, 100.0_dp*z, 100.0_dp*n, 'a hundred times the histories')
      call check_close(other%se_beta(), 0.1_dp*curve%se_beta(), 1.0e-11_dp, 'standard error of a hundredfold sample')
      ! Fractions that lie on a curve give that curve back, steep or flat.
      call recover(0.31_dp, 0.01_dp)
      call recover(0.31_dp, 0.4_dp)
      call recover(0.31_dp, 20.0_dp)
   end subroutine test_invariances

   !> Exact fractions of a known curve
   subroutine recover(theta, beta)
      real(dp), intent(in) :: theta, beta
      real(dp) :: x(5)
      type(fragility_type) :: curve

      x = theta*exp(beta*[-1.5_dp, -0.4_dp, 0.1_dp, 0.9_dp, 1.7_dp])
      curve = fitted(x, 50.0_dp*normal_cdf(log(x/theta)/beta), spread(50.0_dp, 1, 5), 'exact fractions')
      call check_close(curve%theta, theta, 1.0e-12_dp*max(1.0_dp, beta), 'theta recovered')
      call check_close(curve%beta, beta, 1.0e-10_dp, 'beta recovered')
   end subroutine recover

   !> Counts that cannot be
   subroutine test_wrong_counts()
      type(fragility_type) :: curve
      type(error_type), allocatable :: error
      real(dp), parameter :: one(1) = 1.0_dp

      call suite('wrong counts')
      call fit_fragility(curve, one, 2.0_dp*one, one, error)
      call check_error(error, 'collapses = 2: must lie between 0 and the histories, 1', 'too many collapses')
      call fit_fragility(curve, -one, one, one, error)
      call check_error(error, 'levels = -1: must be positive', 'negative level')
      call fit_fragility(curve, one, one, [1.0_dp, 2.0_dp], error)
      call check_error(error, 'must be as many', 'unequal sizes')
      call fit_fragility(curve, one, 0.0_dp*one, 0.0_dp*one, error)
      call check_error(error, 'there are none', 'no histories')
      call fit_fragility(curve, one, [ieee_value(0.0_dp, ieee_quiet_nan)], one, error)
      call check_error(error, 'collapses = NaN', 'not a number')
   end subroutine test_wrong_counts

   !> A population
   subroutine test_typology()
      real(dp), parameter :: x(3) = [0.1_dp, 0.2_dp, 0.4_dp]
      integer, parameter :: z(3, 2) = reshape([4, 20, 40, 0, 0, 10], [3, 2])
      type(fragility_type) :: curves(2)
      type(typology_type) :: typology
      type(typology_type), allocatable :: typologies(:)
      type(error_type), allocatable :: error

      call suite('typology')
      curves(1) = fitted(x, real(z(:, 1), dp), spread(44.0_dp, 1, 3), 'wall 1')
      curves(2) = fitted(x, real(z(:, 2), dp), spread(44.0_dp, 1, 3), 'wall 2')
      call combine_walls(typology, x, z, [44, 44], curves, [3.0_dp, 1.0_dp], error)
      call check_ok(error, 'combine')
      call check_close(typology%weight, 4.0_dp, 0.0_dp, 'weight')
      call check_close(typology%mean_fraction(3), (0.75_dp*40.0_dp + 0.25_dp*10.0_dp)/44.0_dp, 1.0e-14_dp, 'fraction')
      ! The second wall has no curve and takes part with its fractions.
      call check_close(typology%mean_curve(3), 0.75_dp*curves(1)%probability(0.4_dp) + 0.25_dp*10.0_dp/44.0_dp, &
         & 1.0e-14_dp, 'curve')
      call combine_walls(typology, x, z(:, [1, 1]), [44, 44], curves([1, 1]), [1.0_dp, 1.0_dp], error)
      call check_close(typology%fit%theta, curves(1)%theta, 1.0e-12_dp, 'theta of two equal walls')
      call check_close(typology%fit%se_beta(), curves(1)%se_beta()*sqrt(0.5_dp), 1.0e-10_dp, 'standard error of two')

      call combine_population(typologies, ['b', 'a', 'b', 'c'], x, z(:, [1, 2, 1, 2]), [44, 44, 44, 44], &
         & curves([1, 2, 1, 2]), [2.0_dp, 1.0_dp, 1.0_dp, 0.0_dp], error)
      call check_ok(error, 'combine a population')
      call check(size(typologies) == 3, 'two mechanisms have weight')
      call check_text(typologies(1)%mechanism//typologies(2)%mechanism//typologies(3)%mechanism, 'baall', 'mechanisms')
      call check_close(typologies(1)%fit%theta, curves(1)%theta, 1.0e-12_dp, 'theta of the first mechanism')
      call check_close(typologies(3)%mean_fraction(3), 130.0_dp/176.0_dp, 1.0e-14_dp, 'mean fraction of all')
   end subroutine test_typology

end program test_fragility
