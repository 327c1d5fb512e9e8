!> Fits of fragility curves against closed forms and published data (docs/theory.md, section 6).
program test_fragility
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use checks, only : check, check_close, check_error, check_ok, check_text, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_student, only : student_cdf, student_quantile
   use dondolo_base_warning, only : warnings_type
   use dondolo_case_result_warnings, only : warn_of_fit
   use dondolo_fragility, only : fit_fragility, fit_status_names, fragility_type, normal_cdf, refuse_fractions
   use dondolo_fragility_clustered, only : cluster_errors, parameter_intervals
   use dondolo_fragility_even_levels, only : even_levels, settle_levels
   use dondolo_fragility_logit, only : fit_logit, logit_type
   use dondolo_fragility_ordinal, only : fit_ordinal, ordinal_errors
   use dondolo_fragility_stripes, only : stripes_type
   use dondolo_wall, only : wall_type
   implicit none

   call test_two_stripes()
   call test_published()
   call test_statuses()
   call test_nearly_flat()
   call test_even_levels()
   call test_invariances()
   call test_wrong_counts()
   call test_clusters()
   call test_ordinal()
   call test_student()
   call finish()

contains

   !> Fit that must succeed
   function fitted(levels, collapses, histories, what) result(curve)
      real(wp), intent(in) :: levels(:), collapses(:), histories(:)
      character(len=*), intent(in) :: what
      type(fragility_type) :: curve
      type(error_type), allocatable :: error

      call fit_fragility(curve, levels, collapses, histories, error)
      call check_ok(error, what)
   end function fitted

   !> With two stripes the curve goes through both fractions
   subroutine test_two_stripes()
      real(wp), parameter :: quartile = 0.674489750196082_wp, variance = acos(-1.0_wp)/88.0_wp
      type(fragility_type) :: curve

      call suite('two stripes')
      curve = fitted([0.2_wp, 0.4_wp], [11.0_wp, 33.0_wp], [44.0_wp, 44.0_wp], 'fit')
      call check_text(trim(fit_status_names(curve%status)), 'ok', 'status')
      call check_close(curve%theta, sqrt(0.08_wp), 1.0e-12_wp, 'theta')
      call check_close(curve%beta, 0.513830774_wp, 1.0e-9_wp, 'beta')
      call check_close(curve%probability(0.2_wp), 0.25_wp, 1.0e-12_wp, 'P(0.2)')
      call check_close(curve%probability(0.4_wp), 0.75_wp, 1.0e-12_wp, 'P(0.4)')
      call check_close(curve%level(0.25_wp), 0.2_wp, 1.0e-12_wp, 'level of 25 %')
      call check_close(curve%level(0.5_wp), curve%theta, 1.0e-14_wp, 'level of 50 %')
      call check_close(curve%level(0.84_wp), curve%theta*exp(0.994457883209753_wp*curve%beta), 1.0e-14_wp, &
         & 'level of 84 %')
      call check_close(curve%bracket(1), 0.2_wp, 0.0_wp, 'bracket below')
      call check_close(curve%bracket(2), 0.4_wp, 0.0_wp, 'bracket above')

      ! The probit of a half has the variance 2 pi 1/4 / 44; ln theta depends on it alone, beta on that of a quarter, too.
      curve = fitted([0.2_wp, 0.4_wp], [11.0_wp, 22.0_wp], [44.0_wp, 44.0_wp], 'the median is a level')
      call check_close(curve%beta, log(2.0_wp)/quartile, 1.0e-12_wp, 'beta')
      call check_close(curve%covariance(1, 1), variance*curve%beta**2, 1.0e-10_wp, 'variance of ln theta')
      call check_close(curve%covariance(1, 2), variance*curve%beta**2/quartile, 1.0e-10_wp, 'covariance')
   end subroutine test_two_stripes

   !> Two public data sets with their standard errors
   subroutine test_published()
      real(wp), parameter :: levels(16) = [0.178_wp, 0.274_wp, 0.444_wp, 0.56_wp, 0.652_wp, 0.79_wp, 0.982_wp, &
         & 1.246_wp, 1.564_wp, 2.014_wp, 2.417_wp, 3.021_wp, 3.625_wp, 4.028_wp, 4.431_wp, 5.035_wp]
      real(wp), parameter :: collapses(16) = [0, 0, 0, 0, 0, 4, 13, 23, 38, 41, 44, 45, 45, 45, 45, 45]
      type(fragility_type) :: curve
      type(logit_type) :: logit
      type(wall_type) :: wall
      type(stripes_type) :: stripes
      type(warnings_type) :: warnings
      type(lines_type) :: sentences

      call suite('published data')
      curve = fitted(levels, collapses, spread(45.0_wp, 1, 16), 'sixteen stripes of 45')
      call check_text(trim(fit_status_names(curve%status)), 'ok', 'status')
      call check_close(curve%theta, 1.2194475_wp, 5.0e-8_wp, 'theta')
      call check_close(curve%beta, 0.3100660_wp, 2.0e-7_wp, 'beta')
      call check_close(curve%log_likelihood, -12.8704444_wp, 5.0e-9_wp, 'log likelihood')
      call check_close(curve%deviance, 5.432952609028534_wp, 1.0e-9_wp, 'deviance')
      call check(curve%deviance_dof == 14, 'degrees of freedom of the deviance')
      ! statsmodels 0.14
      call fit_logit(logit, levels, collapses, spread(45.0_wp, 1, 16), spread(1, 1, 16))
      call check(logit%has_fit .and. .not. logit%is_clustered, 'logistic curve')
      call check_close(logit%b(1), -1.12548946_wp, 1.0e-8_wp, 'intercept')
      call check_close(logit%b(2), 5.84207005_wp, 1.0e-8_wp, 'slope')
      call check_close(sqrt(logit%covariance(1, 1)), 0.19802024_wp, 1.0e-7_wp, 'standard error of the intercept')
      call check_close(sqrt(logit%covariance(2, 2)), 0.53136118_wp, 1.0e-7_wp, 'standard error of the slope')
      call check_close(curve%se_ln_theta(), 0.02926_wp, 2.0e-4_wp, 'standard error of ln theta')
      call check_close(curve%se_beta(), 0.02532_wp, 2.0e-4_wp, 'standard error of beta')

      curve = fitted([1.0_wp, 1.5_wp, 2.0_wp], [0.0_wp, 2.0_wp, 2.0_wp], [59.0_wp, 50.0_wp, 44.0_wp], 'unequal stripes')
      call check_text(trim(fit_status_names(curve%status)), 'extrapolated', 'status')
      call check_close(curve%theta, 5.85981_wp, 1.0e-6_wp, 'theta')
      call check_close(curve%beta, 0.684495_wp, 1.0e-6_wp, 'beta')
      stripes%levels = [1.0_wp, 1.5_wp, 2.0_wp]
      allocate(stripes%response(59, 3))
      call warn_of_fit(wall, stripes, curve, warnings)
      call check(warnings%count == 1, 'one warning')
      call warnings%put_sentences(sentences)
      call check_text(sentences%line(1)%text, &
         & 'theta = 5.86 lies outside the levels 1 to 2: the fit extrapolates, higher levels are needed', 'warning')
   end subroutine test_published

   !> Every case without a finite maximum has a status, and a bracket instead of a number
   subroutine test_statuses()
      real(wp), parameter :: n(3) = 44.0_wp, x(3) = [0.1_wp, 0.2_wp, 0.3_wp]

      call suite('statuses')
      call expect('no_collapse', x, [0.0_wp, 0.0_wp, 0.0_wp], n, 0.3_wp, huge(0.0_wp))
      call expect('all_collapse', x, n, n, 0.0_wp, 0.1_wp)
      call expect('separated', x, [0.0_wp, 0.0_wp, 44.0_wp], n, 0.2_wp, 0.3_wp)
      call expect('separated', x, [0.0_wp, 5.0_wp, 44.0_wp], n, 0.2_wp, 0.3_wp)
      call expect('separated', x, [0.0_wp, 40.0_wp, 44.0_wp], n, 0.1_wp, 0.2_wp)
      call expect('separated', x, [0.0_wp, 0.0_wp, 5.0_wp], n, 0.3_wp, huge(0.0_wp))
      call expect('single_level', [0.2_wp], [10.0_wp], [44.0_wp], 0.2_wp, huge(0.0_wp))
      call expect('decreasing', x, [30.0_wp, 20.0_wp, 10.0_wp], n, 0.3_wp, 0.1_wp)
      call expect('decreasing', x, [10.0_wp, 10.0_wp, 10.0_wp], n, 0.3_wp, huge(0.0_wp))
      call expect('decreasing', x, [44.0_wp, 44.0_wp, 0.0_wp], n, 0.3_wp, 0.1_wp)
      ! Newton's method does not reach the top of a likelihood that is flat but for rounding
      call expect('not_converged', [0.2_wp, 0.4_wp, 0.8_wp], 1.0e-12_wp*[1.0_wp, 10.0_wp, 30.0_wp], n, 0.8_wp, &
         & huge(0.0_wp))
      ! Rising by so little that the median is beyond all numbers
      call expect('decreasing', [0.1_wp, 0.2_wp, 0.4001_wp], [1.0_wp, 0.0_wp, 1.0_wp], n, 0.4001_wp, huge(0.0_wp))
   end subroutine test_statuses

   !> Collapses that hardly become more frequent: the curve stays, with a status. For two levels the probit model is saturated, so
   !> that the likelihood ratio against no slope is that of two fractions, in closed form
   subroutine test_nearly_flat()
      real(wp), parameter :: x(2) = [0.3_wp, 0.6_wp], n(2) = [60.0_wp, 60.0_wp], quantile = 3.841458820694124_wp
      type(fragility_type) :: curve, curves(2)
      type(wall_type) :: wall
      type(stripes_type) :: stripes
      type(warnings_type) :: warnings
      type(lines_type) :: sentences
      type(error_type), allocatable :: error
      real(wp) :: low, high, middle
      integer :: i

      call suite('nearly flat curves')
      ! Collapses at the second level for which the ratio is the quantile
      low = 27.0_wp
      high = 50.0_wp
      do i = 1, 100
         middle = 0.5_wp*(low + high)
         if (ratio_of_two(27.0_wp, middle) < quantile) then
            low = middle
         else
            high = middle
         end if
      end do
      curve = fitted(x, [27.0_wp, low - 1.0e-6_wp], n, 'just not significant')
      call check_text(trim(fit_status_names(curve%status)), 'nearly_flat', 'status below the quantile')
      call check(curve%has_fit(), 'a nearly flat curve is a curve')
      curve = fitted(x, [27.0_wp, high + 1.0e-6_wp], n, 'just significant')
      call check_text(trim(fit_status_names(curve%status)), 'ok', 'status above the quantile')
      curve = fitted([0.1_wp, 0.2_wp, 0.4_wp, 0.8_wp], [9.0_wp, 11.0_wp, 9.0_wp, 11.0_wp], spread(20.0_wp, 1, 4), 'hardly rising')
      call check_text(trim(fit_status_names(curve%status)), 'nearly_flat', 'status of counts that hardly rise')
      call check(curve%beta > 5.0_wp, 'its dispersion is large')
      ! A slope that is certain is no fault, however flat
      curve = fitted([0.1_wp, 10.0_wp], [4.0e4_wp, 6.0e4_wp], spread(1.0e5_wp, 1, 2), 'flat and certain')
      call check_text(trim(fit_status_names(curve%status)), 'ok', 'status of a flat curve of many histories')
      ! A median outside the levels is the first thing to say
      curve = fitted([1.0_wp, 2.0_wp], [1.0_wp, 2.0_wp], [44.0_wp, 44.0_wp], 'beyond the levels')
      call check_text(trim(fit_status_names(curve%status)), 'extrapolated', 'status of a median outside the levels')

      call fit_ordinal(curves, x, reshape([28.0_wp, 33.0_wp, 27.0_wp, 32.0_wp], [2, 2]), n, error)
      call check_ok(error, 'two states')
      call check_text(trim(fit_status_names(curves(1)%status)), 'nearly_flat', 'the first of two states with one dispersion')
      call check_text(trim(fit_status_names(curves(2)%status)), 'nearly_flat', 'the second of them')

      stripes%levels = x
      curve = fitted(x, [29.0_wp, 31.0_wp], n, 'of a wall')
      call warn_of_fit(wall, stripes, curve, warnings)
      call check(warnings%count == 1, 'one warning')
      call warnings%put_sentences(sentences)
      call check(index(sentences%line(1)%text, 'collapses hardly become more frequent with the level') == 1, 'its sentence')
   end subroutine test_nearly_flat

   !> Likelihood ratio statistic of two fractions of 60 against one
   pure real(wp) function ratio_of_two(first, second) result(ratio)
      !> Collapses
      real(wp), intent(in) :: first, second

      ratio = 2.0_wp*(height(first, 60.0_wp) + height(second, 60.0_wp) - height(first + second, 120.0_wp))
   end function ratio_of_two

   !> Largest log likelihood of a count
   pure real(wp) function height(z, n)
      real(wp), intent(in) :: z, n

      height = z*log(z/n) + (n - z)*log(1.0_wp - z/n)
   end function height

   !> Equally spaced levels are decimals, and lists that are equally spaced but for rounding become the same
   subroutine test_even_levels()
      real(wp), parameter :: tenths(9) = [0.1_wp, 0.2_wp, 0.3_wp, 0.4_wp, 0.5_wp, 0.6_wp, 0.7_wp, 0.8_wp, 0.9_wp]
      real(wp) :: levels(9), thirds(4), other(5), step
      integer :: i

      call suite('equally spaced levels')
      call check(all(abs(even_levels(0.1_wp, 0.9_wp, 9) - tenths) <= 0.0_wp), 'decimals to the last bit')
      step = (0.9_wp - 0.1_wp)/8.0_wp
      levels = [(0.1_wp + real(i, wp)*step, i=0, 8)]
      call check(any(abs(levels - tenths) > 0.0_wp), 'steps from the first level miss decimals')
      call settle_levels(levels)
      call check(all(abs(levels - tenths) <= 0.0_wp), 'settled')
      ! Sums of steps miss the end, too
      levels(1) = 0.1_wp
      do i = 2, 9
         levels(i) = levels(i - 1) + 0.1_wp
      end do
      call check(abs(levels(9) - 0.9_wp) > 0.0_wp, 'a sum of steps misses its end')
      call settle_levels(levels)
      call check(all(abs(levels - tenths) <= 0.0_wp), 'a sum of steps settled')
      thirds = [0.1_wp, 0.1_wp + 0.8_wp/3.0_wp, 0.1_wp + 1.6_wp/3.0_wp, 0.9_wp]
      call settle_levels(thirds)
      call check(all(abs(thirds - even_levels(0.1_wp, 0.9_wp, 4)) <= 0.0_wp), 'levels that are no decimals')
      other = [0.1_wp, 0.2_wp, 0.3_wp + 1.0e-12_wp, 0.4_wp, 0.5_wp]
      thirds = other(:4)
      call settle_levels(other)
      call check(all(abs(other(:4) - thirds) <= 0.0_wp), 'a list that is not equally spaced stays')
   end subroutine test_even_levels

   !> A status without a curve
   subroutine expect(status, levels, collapses, histories, below, above)
      character(len=*), intent(in) :: status
      real(wp), intent(in) :: levels(:), collapses(:), histories(:), below, above
      type(fragility_type) :: curve

      curve = fitted(levels, collapses, histories, status)
      call check_text(trim(fit_status_names(curve%status)), status, 'status')
      call check(.not. curve%has_fit(), status//' has no curve')
      call check(curve%theta == 0.0_wp .and. curve%beta == 0.0_wp, status//' has no number')
      call check_close(curve%bracket(1), below, 0.0_wp, status//': bracket below')
      call check_close(curve%bracket(2), above, 0.0_wp, status//': bracket above')
   end subroutine expect

   !> Order and unit of the levels, and splitting a stripe, change nothing
   subroutine test_invariances()
      real(wp), parameter :: x(4) = [0.1_wp, 0.2_wp, 0.4_wp, 0.7_wp], z(4) = [1, 9, 30, 41], n(4) = 44
      integer, parameter :: order(4) = [3, 1, 4, 2]
      type(fragility_type) :: curve, other

      call suite('invariances of the fit')
      curve = fitted(x, z, n, 'fit')
      other = fitted(x(order), z(order), n(order), 'other order')
      call check_close(other%theta, curve%theta, 1.0e-13_wp, 'theta in another order')
      other = fitted(x*981.0_wp, z, n, 'other unit')
      call check_close(other%theta, 981.0_wp*curve%theta, 1.0e-13_wp, 'theta in another unit')
      call check_close(other%beta, curve%beta, 1.0e-13_wp, 'beta in another unit')
      other = fitted([x, x], [z - 1.0_wp, spread(1.0_wp, 1, 4)], [n - 4.0_wp, spread(4.0_wp, 1, 4)], 'split stripes')
      call check_close(other%theta, curve%theta, 1.0e-13_wp, 'theta of split stripes')
      call check_close(other%se_beta(), curve%se_beta(), 1.0e-11_wp, 'standard error of split stripes')
      other = fitted(x, 100.0_wp*z, 100.0_wp*n, 'a hundred times the histories')
      call check_close(other%se_beta(), 0.1_wp*curve%se_beta(), 1.0e-11_wp, 'standard error of a hundredfold sample')
      ! Fractions that lie on a curve give that curve back, steep or flat.
      call recover(0.31_wp, 0.01_wp)
      call recover(0.31_wp, 0.4_wp)
      call recover(0.31_wp, 20.0_wp)
   end subroutine test_invariances

   !> Exact fractions of a known curve
   subroutine recover(theta, beta)
      real(wp), intent(in) :: theta, beta
      real(wp) :: x(5)
      type(fragility_type) :: curve

      x = theta*exp(beta*[-1.5_wp, -0.4_wp, 0.1_wp, 0.9_wp, 1.7_wp])
      curve = fitted(x, 50.0_wp*normal_cdf(log(x/theta)/beta), spread(50.0_wp, 1, 5), 'exact fractions')
      call check_close(curve%theta, theta, 1.0e-12_wp*max(1.0_wp, beta), 'theta recovered')
      call check_close(curve%beta, beta, 1.0e-10_wp, 'beta recovered')
   end subroutine recover

   !> Counts that cannot be
   subroutine test_wrong_counts()
      type(fragility_type) :: curve
      type(error_type), allocatable :: error
      real(wp), parameter :: one(1) = 1.0_wp

      call suite('wrong counts')
      call fit_fragility(curve, one, 2.0_wp*one, one, error)
      call check_error(error, 'collapses = 2: must lie between 0 and the histories, 1', 'too many collapses')
      call fit_fragility(curve, -one, one, one, error)
      call check_error(error, 'levels = -1: must be positive', 'negative level')
      call fit_fragility(curve, one, one, [1.0_wp, 2.0_wp], error)
      call check_error(error, 'must be as many', 'unequal sizes')
      call fit_fragility(curve, one, 0.0_wp*one, 0.0_wp*one, error)
      call check_error(error, 'there are none', 'no histories')
      call fit_fragility(curve, one, [ieee_value(0.0_wp, ieee_quiet_nan)], one, error)
      call check_error(error, 'collapses = NaN', 'not a number')
      call refuse_fractions([0.0_wp, 0.2_wp, 1.0_wp], [44.0_wp, 44.0_wp, 44.0_wp], error)
      call check_error(error, 'collapses: look like fractions of the histories: must be counts', 'fractions')
      call refuse_fractions([0.2_wp, 0.8_wp], [1.0_wp, 1.0_wp], error)
      call check(.not. allocated(error), 'fractions of one history')
      call refuse_fractions([0.2_wp, 8.5_wp], [44.0_wp, 44.0_wp], error)
      call check(.not. allocated(error), 'weighted counts')
      call refuse_fractions([0.0_wp, 1.0_wp], [44.0_wp, 44.0_wp], error)
      call check(.not. allocated(error), 'counts of at most one')
   end subroutine test_wrong_counts

   !> Clustered standard errors: changes are those of fits without each cluster, copies add nothing, and what has no
   !> standard errors says why
   subroutine test_clusters()
      integer, parameter :: clusters = 400
      real(wp), parameter :: x(4) = [0.3_wp, 0.5_wp, 0.8_wp, 1.2_wp]
      real(wp) :: z(4, clusters), n(4, clusters), changes(2, clusters), twice(2, 2*clusters), few(2, 2), bounds(2, 2), capacity
      type(fragility_type) :: curve, other
      integer :: g, j

      call suite('clustered standard errors')
      n = 1.0_wp
      do g = 1, clusters
         ! A capacity of each, and chance in every fifth stripe
         capacity = 0.6_wp*exp(0.4_wp*sin(37.0_wp*real(g, wp)) + 0.2_wp*cos(11.0_wp*real(g, wp)))
         do j = 1, 4
            z(j, g) = merge(1.0_wp, 0.0_wp, (x(j) >= capacity) .neqv. modulo(3*g + 7*j, 20) == 0)
         end do
      end do
      curve = fitted(x, sum(z, 2), sum(n, 2), 'all clusters')
      call check_text(curve%errors, 'naive', 'without clusters')
      call cluster_errors(curve, x, z, n, changes)
      call check_text(curve%errors, 'clustered', 'errors')
      call check(curve%clusters == clusters, 'number of clusters')
      do g = 1, clusters, 57
         other = fitted(x, sum(z, 2) - z(:, g), sum(n, 2) - n(:, g), 'one left out')
         call check_close(changes(1, g), log(other%theta/curve%theta), 0.02_wp, 'change of ln theta', atol=2.0e-5_wp)
         call check_close(changes(2, g), other%beta - curve%beta, 0.02_wp, 'change of beta', atol=4.0e-5_wp)
      end do
      call check(curve%se_ln_theta() > sqrt(curve%naive(1, 1)), 'wider than if stripes were independent')

      ! Every history twice in its cluster: no new evidence, though the naive errors say so
      other = fitted(x, 2.0_wp*sum(z, 2), 2.0_wp*sum(n, 2), 'twice')
      call cluster_errors(other, x, 2.0_wp*z, 2.0_wp*n, changes)
      call check_close(other%se_ln_theta(), curve%se_ln_theta(), 1.0e-9_wp, 'copies in a cluster')
      call check_close(other%naive(1, 1), 0.5_wp*curve%naive(1, 1), 1.0e-9_wp, 'naive variance of copies')
      other = curve
      call cluster_errors(other, x, reshape([z, 0.0_wp*z], [4, 2*clusters]), reshape([n, 0.0_wp*n], [4, 2*clusters]), twice)
      call check(other%clusters == clusters, 'clusters without histories do not count')
      call check_close(other%se_beta(), curve%se_beta(), 1.0e-12_wp, 'clusters without histories')

      bounds = parameter_intervals(curve)
      call check_close(sqrt(bounds(1, 1)*bounds(2, 1)), curve%theta, 1.0e-12_wp, 'interval of theta about it')
      call check_close(0.5_wp/bounds(1, 2) + 0.5_wp/bounds(2, 2), 1.0_wp/curve%beta, 1.0e-12_wp, 'interval of 1/beta about it')
      call check_close(log(bounds(2, 1)/curve%theta)/curve%se_ln_theta(), 1.9659_wp, 1.0e-3_wp, 'quantile of Student')

      call cluster_errors(other, x, z(:, :2), n(:, :2), few)
      call check_text(other%errors, 'few_clusters', 'two clusters')
      call check(.not. other%has_errors(), 'two clusters have no standard errors')
      n(2:, 2:) = 0.0_wp
      z(2:, 2:) = 0.0_wp
      call cluster_errors(other, x, z, n, changes)
      call check_text(other%errors, 'one_cluster', 'one cluster has all but one stripe')
      call check(all(changes == 0.0_wp) .and. all(other%covariance == 0.0_wp), 'no number without standard errors')
   end subroutine test_clusters

   !> Damage states with one dispersion: exact fractions give their curves back, in any order of levels and with states that
   !> share a curve; one state alone is the fit alone
   subroutine test_ordinal()
      real(wp), parameter :: x(5) = [0.6_wp, 0.1_wp, 0.2_wp, 0.9_wp, 0.35_wp], n(5) = [40, 44, 30, 44, 50]
      real(wp), parameter :: theta(4) = [0.2_wp, 0.30_wp, 0.30_wp, 0.95_wp]
      real(wp) :: z(5, 6), by_cluster(5, 6, 10), of_cluster(5, 10), changes(2, 6, 10), single(2, 10)
      type(fragility_type) :: curves(6), own
      type(error_type), allocatable :: error
      integer :: g, k

      call suite('damage states with one dispersion')
      z(:, 1) = n
      z(:, 6) = 0.0_wp
      do k = 1, 4
         z(:, k + 1) = n*normal_cdf(log(x/theta(k))/0.45_wp)
      end do
      call fit_ordinal(curves, x, z, n, error)
      call check_ok(error, 'fit')
      call check_text(trim(fit_status_names(curves(1)%status)), 'all_collapse', 'every history reaches the first')
      call check_text(trim(fit_status_names(curves(6)%status)), 'no_collapse', 'none reaches the last')
      do k = 1, 4
         call check_close(curves(k + 1)%theta, theta(k), 1.0e-12_wp, 'theta of state '//achar(48 + k))
         call check_close(curves(k + 1)%beta, 0.45_wp, 1.0e-12_wp, 'beta of state '//achar(48 + k))
      end do
      call check_text(trim(fit_status_names(curves(4)%status)), 'ok', 'status')
      call check_text(trim(fit_status_names(curves(5)%status)), 'extrapolated', 'theta beyond the levels')
      call check(curves(3)%theta >= curves(4)%theta .and. curves(3)%theta <= curves(4)%theta, 'states that share a curve')

      ! Each cluster a tenth of all: nothing differs between clusters, so that there is no error at all.
      by_cluster = spread(0.1_wp*z, 3, 10)
      of_cluster = spread(0.1_wp*n, 2, 10)
      call ordinal_errors(curves, x, by_cluster, of_cluster, changes)
      call check_text(curves(2)%errors, 'clustered', 'errors')
      call check(curves(2)%clusters == 10, 'clusters')
      call check(maxval(abs(changes)) < 1.0e-12_wp, 'equal clusters')
      do g = 1, 10
         by_cluster(:, :, g) = by_cluster(:, :, g)*(1.0_wp + 0.03_wp*real(g - 5, wp))
         of_cluster(:, g) = of_cluster(:, g)*(1.0_wp + 0.01_wp*real(g*g + 10, wp))
      end do
      call fit_ordinal(curves(:1), x, sum(by_cluster(:, 3:3, :), 3), sum(of_cluster, 2), error)
      call check_ok(error, 'one state')
      own = fitted(x, sum(by_cluster(:, 3, :), 2), sum(of_cluster, 2), 'the same alone')
      call ordinal_errors(curves(:1), x, by_cluster(:, 3:3, :), of_cluster, changes(:, :1, :))
      call cluster_errors(own, x, by_cluster(:, 3, :), of_cluster, single)
      call check_close(curves(1)%theta, own%theta, 0.0_wp, 'theta of one state alone')
      call check_close(curves(1)%covariance(1, 2), own%covariance(1, 2), 0.0_wp, 'covariance of one state alone')
      call check(all(abs(changes(:, 1, :) - single) <= 0.0_wp), 'changes of one state alone')

      call fit_ordinal(curves(:2), x, z(:, [3, 2]), n, error)
      call check_error(error, 'at level 0.6: must be at most', 'a state that more reach than the one before')
      call fit_ordinal(curves(:2), x(:2), z(:, 2:3), n(:2), error)
      call check_error(error, 'must be as many', 'unequal sizes')
   end subroutine test_ordinal

   !> Tables of Student's t
   subroutine test_student()
      call suite('Student''s t')
      call check_close(student_quantile(0.975_wp, 1.0_wp), 12.7062047362_wp, 1.0e-10_wp, 'one degree')
      call check_close(student_quantile(0.975_wp, 2.0_wp), 4.30265272991_wp, 1.0e-10_wp, 'two degrees')
      call check_close(student_quantile(0.975_wp, 21.0_wp), 2.07961384473_wp, 1.0e-10_wp, '21 degrees')
      call check_close(student_quantile(0.995_wp, 10.0_wp), 3.16927267262_wp, 1.0e-10_wp, 'ten degrees')
      ! P(|t| < x) = 2/pi atan(x) of one degree, and x/sqrt(2 + x^2) of two
      call check_close(student_cdf(-3.0_wp, 1.0_wp), 0.5_wp - atan(3.0_wp)/acos(-1.0_wp), 1.0e-15_wp, 'left of one degree')
      call check_close(student_cdf(0.3_wp, 2.0_wp), 0.5_wp + 0.15_wp/sqrt(2.09_wp), 1.0e-15_wp, 'two degrees, near 0')
      call check_close(student_cdf(0.0_wp, 5.0_wp), 0.5_wp, 1.0e-15_wp, 'middle')
      ! By SciPy 1.17
      call check_close(student_quantile(0.975_wp, 7.3_wp), 2.345066736547703_wp, 1.0e-13_wp, '7.3 degrees')
      call check_close(student_quantile(0.975_wp, 0.7_wp), 36.611415031588656_wp, 1.0e-13_wp, '0.7 degrees')
      call check_close(student_quantile(0.975_wp, 250.5_wp), 1.969479272051676_wp, 1.0e-13_wp, '250.5 degrees')
      call check_close(student_cdf(-2.0_wp, 3.5_wp), 0.06306926128795672_wp, 1.0e-13_wp, 'left of 3.5 degrees')
      call check_close(student_cdf(1.96_wp, 1.0e5_wp), normal_cdf(1.96_wp), 2.0e-6_wp, 'many degrees')
   end subroutine test_student

end program test_fragility
