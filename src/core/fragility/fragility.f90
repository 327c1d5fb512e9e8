!> Fragility curve: the lognormal fitted to stripes by maximum likelihood.
!>
!> P(C | IM = x) = Phi(ln(x/theta)/beta), equation (5) of Nale et al. With z_j collapses among n_j histories at
!> level x_j the binomial likelihood (Baker 2015) is that of a probit regression on ln x, P = Phi(b0 + b1 ln x), with
!> beta = 1/b1 and theta = exp(-b0/b1). It is concave, and has a finite maximum with b1 > 0 only if collapses and
!> survivals overlap and collapses become more frequent; otherwise there is a status and no number
!> (docs/theory.md, section 6).
module dondolo_fragility
   use dondolo_base_bracket, only : bracket_type
   use dondolo_base_error, only : error_type, not_given, out_of_range, raise_input
   use dondolo_base_invariant, only : assert, checked, is_covariance
   use dondolo_base_kinds, only : wp
   use dondolo_base_lapack, only : invert_symmetric, solve_symmetric
   use dondolo_base_text, only : to_text
   implicit none
   private

   public :: fragility_type, fit_fragility, refuse_fractions
   public :: fit_ok, fit_extrapolated, fit_nearly_flat, fit_no_collapse, fit_all_collapse, fit_separated, fit_single_level, &
      & fit_decreasing, fit_not_converged, fit_status_names, statuses_with_curve
   public :: assert_curve, deviance_of, error_names, is_flat, least_ratio, log_normal_cdf, log_share, mills, normal_cdf, outer

   !> Statuses of a fit, and their names in files. The first three have a curve: `extrapolated` has its theta outside the levels,
   !> `nearly_flat` a slope that is not significant
   integer, parameter :: fit_ok = 1, fit_extrapolated = 2, fit_nearly_flat = 3, fit_no_collapse = 4, fit_all_collapse = 5, &
      & fit_separated = 6, fit_single_level = 7, fit_decreasing = 8, fit_not_converged = 9
   character(len=13), parameter :: fit_status_names(9) = [character(len=13) :: 'ok', 'extrapolated', 'nearly_flat', &
      & 'no_collapse', 'all_collapse', 'separated', 'single_level', 'decreasing', 'not_converged']
   integer, parameter :: statuses_with_curve = fit_nearly_flat

   !> Likelihood ratio against no slope from which on a slope is significant: the 95 % quantile of chi-square with one
   !> degree of freedom
   real(wp), parameter :: least_ratio = 3.841458820694124_wp

   !> What the standard errors of a curve are: those of independent histories, or of clusters of them (dondolo_fragility_clustered);
   !> the others have none, for too few clusters of records, or walls of a population, or since one of them determines
   !> the curve
   character(len=12), parameter :: error_names(6) = [character(len=12) :: 'naive', 'clustered', 'few_clusters', &
      & 'one_cluster', 'few_walls', 'one_wall']

   !> A fitted fragility curve, or why there is none
   type :: fragility_type
      !> Whether there is a curve, or why there is none
      integer :: status = fit_no_collapse
      !> Levels less parameters: the mean that the deviance would have if all histories were independent. Beside the status, with
      !> which it fills eight bytes: a large population has many curves
      integer :: deviance_dof = 0
      !> Median, in the unit of the levels
      real(wp) :: theta = 0.0_wp
      !> Dispersion: standard deviation of the logarithm
      real(wp) :: beta = 0.0_wp
      !> Covariance of ln theta and beta, of the kind that `errors` says
      real(wp) :: covariance(2, 2) = 0.0_wp
      !> One of error_names
      character(len=len(error_names)) :: errors = 'naive'
      !> Number of clusters; 0 if the histories are taken for independent
      integer :: clusters = 0
      !> Degrees of freedom of Student's t in intervals; 0 without clustered errors
      real(wp) :: degrees_of_freedom = 0.0_wp
      !> Covariance of ln theta and beta from the Fisher information, as if all histories were independent
      real(wp) :: naive(2, 2) = 0.0_wp
      !> Logarithm of the likelihood, binomial coefficients included
      real(wp) :: log_likelihood = 0.0_wp
      !> Deviance: twice what the likelihood is below that of the fractions themselves
      real(wp) :: deviance = 0.0_wp
      !> Levels between which half of the histories begin to collapse; 0 or huge where the side is open
      real(wp) :: bracket(2) = [0.0_wp, huge(0.0_wp)]
   contains
      !> Is there a curve?
      procedure :: has_fit
      !> Whether the curve has standard errors
      procedure :: has_errors
      !> Standard error of ln theta
      procedure :: se_ln_theta
      !> Standard error of beta
      procedure :: se_beta
      !> Probability of collapse at a level
      procedure :: probability
      !> Level at which collapse has a probability
      procedure :: level
   end type fragility_type

   real(wp), parameter :: root_half = sqrt(0.5_wp), ln_2 = log(2.0_wp)
   real(wp), parameter :: root_2_over_pi = sqrt(2.0_wp/acos(-1.0_wp))

contains

   !> Fit a lognormal fragility curve
   subroutine fit_fragility(fragility, levels, collapses, histories, error)
      type(fragility_type), intent(out) :: fragility
      !> Levels of intensity
      real(wp), intent(in) :: levels(:)
      !> Collapses at each level; need not be whole numbers (weighted counts)
      real(wp), intent(in) :: collapses(:)
      !> Histories at each level
      real(wp), intent(in) :: histories(:)
      !> Counts that cannot be
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: x(size(levels)), b(2), information(2, 2), covariance(2, 2), jacobian(2, 2)
      real(wp) :: centre, spread, logarithm, height
      logical :: ok

      call check_counts(levels, collapses, histories, error)
      if (allocated(error)) return
      call set_bracket(fragility, levels, collapses, histories)
      fragility%status = status_without_fit(levels, collapses, histories)
      if (fragility%status /= fit_ok) return

      ! ln x centred and scaled, so that the equations are well conditioned
      x = log(levels)
      centre = sum(histories*x)/sum(histories)
      spread = sqrt(sum(histories*(x - centre)**2)/sum(histories))
      x = (x - centre)/spread
      call maximise(x, collapses, histories, b, information, ok)
      if (ok) call invert_symmetric(information, covariance, ok)
      if (.not. ok) then
         fragility%status = fit_not_converged
         return
      end if

      fragility%beta = spread/b(2)
      logarithm = centre - fragility%beta*b(1)
      if (.not. abs(logarithm) < 0.5_wp*log(huge(logarithm))) then
         ! Flat to rounding: the median is not finite
         fragility%beta = 0.0_wp
         fragility%status = fit_decreasing
         return
      end if
      fragility%theta = exp(logarithm)
      height = log_likelihood(b, x, collapses, histories)
      if (is_flat(height - log_likelihood_of_share(collapses, histories))) fragility%status = fit_nearly_flat
      if (fragility%theta < minval(levels) .or. fragility%theta > maxval(levels)) fragility%status = fit_extrapolated
      fragility%deviance = deviance_of(height, collapses, histories)
      fragility%deviance_dof = count(histories > 0.0_wp) - 2
      fragility%log_likelihood = height &
         & + sum(log_gamma(histories + 1.0_wp) - log_gamma(collapses + 1.0_wp) &
         & - log_gamma(histories - collapses + 1.0_wp))

      ! The covariance of b is the inverse of its information; that of (ln theta, beta) follows by the delta method.
      jacobian(1, :) = [-spread/b(2), spread*b(1)/b(2)**2]
      jacobian(2, :) = [0.0_wp, -spread/b(2)**2]
      fragility%naive = matmul(jacobian, matmul(covariance, transpose(jacobian)))
      fragility%covariance = fragility%naive
      if (checked) call assert_curve(fragility)
   end subroutine fit_fragility

   !> What holds of every fitted curve
   pure subroutine assert_curve(curve)
      !> Curve with a fit
      type(fragility_type), intent(in) :: curve

      call assert(curve%has_fit(), 'a fitted curve has the status of one')
      call assert(curve%theta > 0.0_wp .and. curve%theta <= huge(curve%theta), 'a fitted theta is positive and finite')
      call assert(curve%beta > 0.0_wp .and. curve%beta <= huge(curve%beta), 'a fitted beta is positive and finite')
      call assert(is_covariance(curve%covariance), 'the covariance of a curve is symmetric and not negative')
   end subroutine assert_curve

   !> Newton's method with halved steps on the concave log likelihood
   subroutine maximise(x, z, n, b, information, ok)
      !> Predictor
      real(wp), intent(in) :: x(:)
      !> Collapses
      real(wp), intent(in) :: z(:)
      !> Histories
      real(wp), intent(in) :: n(:)
      !> Intercept and slope at the maximum
      real(wp), intent(out) :: b(2)
      !> Fisher information of b there
      real(wp), intent(out) :: information(2, 2)
      !> Has it converged?
      logical, intent(out) :: ok

      integer, parameter :: most_steps = 200, most_halvings = 60
      ! Newton's method doubles its digits: a step of this size leaves no error.
      real(wp), parameter :: rounding = 1.0e-12_wp
      real(wp) :: gradient(2), hessian(2, 2), change(2), height, trial_height
      real(wp), dimension(size(x)) :: eta, up, down, weight
      integer :: i, k

      b = 0.0_wp
      height = log_likelihood(b, x, z, n)
      do i = 1, most_steps
         eta = b(1) + b(2)*x
         up = mills(-eta)
         down = mills(eta)
         weight = z*up - (n - z)*down
         gradient = [sum(weight), sum(weight*x)]
         weight = z*up*(up + eta) + (n - z)*down*(down - eta)
         hessian = outer(weight, x)
         call solve_symmetric(hessian, gradient, change, ok)
         if (.not. ok) return
         do k = 1, most_halvings
            trial_height = log_likelihood(b + change, x, z, n)
            ! At the top the likelihood is flat to rounding, and Newton's step is right.
            if (trial_height >= height - rounding*abs(height)) exit
            change = 0.5_wp*change
         end do
         b = b + change
         height = trial_height
         if (maxval(abs(change)) <= rounding*maxval(abs(b))) exit
      end do
      ok = i <= most_steps
      eta = b(1) + b(2)*x
      ! phi^2/(P (1 - P)) is the product of the two Mills ratios.
      information = outer(n*mills(eta)*mills(-eta), x)
   end subroutine maximise

   !> Sum over the levels of weight (1, x)(1, x)^T
   pure function outer(weight, x) result(matrix)
      !> Weights
      real(wp), intent(in) :: weight(:)
      !> Predictor
      real(wp), intent(in) :: x(:)
      !> The sum
      real(wp) :: matrix(2, 2)

      matrix(1, 1) = sum(weight)
      matrix(1, 2) = sum(weight*x)
      matrix(2, 1) = matrix(1, 2)
      matrix(2, 2) = sum(weight*x**2)
   end function outer

   !> Log likelihood without the binomial coefficients
   pure function log_likelihood(b, x, z, n) result(height)
      !> Intercept and slope
      real(wp), intent(in) :: b(2)
      !> Predictor
      real(wp), intent(in) :: x(:)
      !> Collapses
      real(wp), intent(in) :: z(:)
      !> Histories
      real(wp), intent(in) :: n(:)
      !> sum z ln P + (n - z) ln(1 - P)
      real(wp) :: height

      height = sum(z*log_normal_cdf(b(1) + b(2)*x) + (n - z)*log_normal_cdf(-b(1) - b(2)*x))
   end function log_likelihood

   !> Log likelihood of one probability for all levels, without the binomial coefficients
   pure function log_likelihood_of_share(z, n) result(height)
      !> Collapses, some and not all
      real(wp), intent(in) :: z(:)
      !> Histories
      real(wp), intent(in) :: n(:)
      !> Its maximum
      real(wp) :: height

      height = sum(z)*log(sum(z)/sum(n)) + sum(n - z)*log(sum(n - z)/sum(n))
   end function log_likelihood_of_share

   !> Deviance of a curve
   pure function deviance_of(height, z, n) result(deviance)
      !> Its log likelihood, without the binomial coefficients
      real(wp), intent(in) :: height
      !> Collapses
      real(wp), intent(in) :: z(:)
      !> Histories
      real(wp), intent(in) :: n(:)
      !> Twice what it is below the largest that there is
      real(wp) :: deviance

      deviance = max(2.0_wp*(sum(log_share(z, n) + log_share(n - z, n)) - height), 0.0_wp)
   end function deviance_of

   !> What histories of one outcome add to the largest log likelihood that there is: part ln(part/whole), 0 for none
   elemental real(wp) function log_share(part, whole)
      !> Those of the outcome, and all
      real(wp), intent(in) :: part, whole

      log_share = 0.0_wp
      if (part > 0.0_wp) log_share = part*log(part/whole)
   end function log_share

   !> Is a slope so small that it is not significant?
   pure logical function is_flat(gain)
      !> Log likelihood of the curve - that without a slope, half of the likelihood ratio statistic
      real(wp), intent(in) :: gain

      is_flat = 2.0_wp*gain < least_ratio
   end function is_flat

   !> Standard normal distribution function
   elemental function normal_cdf(t) result(p)
      !> Argument
      real(wp), intent(in) :: t
      !> Phi(t)
      real(wp) :: p

      p = 0.5_wp*erfc(-t*root_half)
   end function normal_cdf

   !> ln Phi(t), accurate in both tails
   elemental function log_normal_cdf(t) result(lnp)
      !> Argument
      real(wp), intent(in) :: t
      !> ln Phi(t)
      real(wp) :: lnp

      if (t < 0.0_wp) then
         lnp = log(erfc_scaled(-t*root_half)) - 0.5_wp*t**2 - ln_2
      else
         lnp = log(normal_cdf(t))
      end if
   end function log_normal_cdf

   !> Inverse Mills ratio phi(t)/(1 - Phi(t)), accurate in both tails
   elemental function mills(t) result(ratio)
      !> Argument
      real(wp), intent(in) :: t
      !> The ratio
      real(wp) :: ratio

      if (t > -5.0_wp) then
         ratio = root_2_over_pi/erfc_scaled(t*root_half)
      else
         ! erfc_scaled overflows far to the left, where 1 - Phi is 1 to rounding.
         ratio = 0.5_wp*root_2_over_pi*exp(-0.5_wp*t**2)/normal_cdf(-t)
      end if
   end function mills

   !> `fit_ok` if the likelihood has a finite maximum with b1 > 0, else why not
   pure integer function status_without_fit(levels, z, n) result(status)
      !> Levels of intensity
      real(wp), intent(in) :: levels(:)
      !> Collapses
      real(wp), intent(in) :: z(:)
      !> Histories
      real(wp), intent(in) :: n(:)

      real(wp) :: score, x(size(levels))
      logical :: counted(size(levels))

      counted = n > 0.0_wp
      x = log(levels)
      ! Derivative of the likelihood with respect to the slope where the slope is zero: it has the sign of b1.
      score = sum((x - sum(n*x)/sum(n))*(z - n*sum(z)/sum(n)))
      status = fit_ok
      if (.not. any(z > 0.0_wp)) then
         status = fit_no_collapse
      else if (.not. any(z < n)) then
         status = fit_all_collapse
      else if (minval(levels, counted) == maxval(levels, counted)) then
         status = fit_single_level
      else if (score <= 16.0_wp*epsilon(score)*sum(n)) then
         status = fit_decreasing
      else if (minval(levels, z > 0.0_wp) >= maxval(levels, z < n)) then
         status = fit_separated
      end if
   end function status_without_fit

   !> The levels between which collapse becomes more likely than survival
   pure subroutine set_bracket(fragility, levels, z, n)
      type(fragility_type), intent(inout) :: fragility
      !> Levels of intensity
      real(wp), intent(in) :: levels(:)
      !> Collapses
      real(wp), intent(in) :: z(:)
      !> Histories
      real(wp), intent(in) :: n(:)

      logical :: above(size(levels))

      above = 2.0_wp*z >= n .and. n > 0.0_wp
      if (any(above)) fragility%bracket(2) = minval(levels, above)
      above = above .or. n <= 0.0_wp
      if (.not. all(above)) fragility%bracket(1) = maxval(levels, .not. above)
   end subroutine set_bracket

   !> Check levels and counts
   subroutine check_counts(levels, z, n, error)
      !> Levels of intensity
      real(wp), intent(in) :: levels(:)
      !> Collapses
      real(wp), intent(in) :: z(:)
      !> Histories
      real(wp), intent(in) :: n(:)
      !> The first thing that is wrong
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      if (size(levels) == 0) then
         call raise_input(error, 'levels: must be given', not_given, 'levels')
         return
      end if
      if (size(z) /= size(levels) .or. size(n) /= size(levels)) then
         call raise_input(error, to_text(size(levels))//' levels, '//to_text(size(z))//' collapses, '// &
            & to_text(size(n))//' histories: must be as many')
         return
      end if
      do i = 1, size(levels)
         if (.not. (levels(i) > 0.0_wp .and. levels(i) <= huge(levels))) then
            call raise_input(error, 'levels = '//to_text(levels(i))//': must be positive', out_of_range, 'levels')
            return
         end if
         if (.not. (n(i) >= 0.0_wp .and. n(i) <= huge(n))) then
            call raise_input(error, 'histories = '//to_text(n(i))//': must not be negative', out_of_range, 'histories')
            return
         end if
         if (.not. (z(i) >= 0.0_wp .and. z(i) <= n(i))) then
            call raise_input(error, 'collapses = '//to_text(z(i))//': must lie between 0 and the histories, '// &
               & to_text(n(i)), out_of_range, 'collapses')
            return
         end if
      end do
      if (.not. sum(n) > 0.0_wp) call raise_input(error, 'histories: there are none', not_given, 'histories')
   end subroutine check_counts

   !> Refuse fractions that somebody gives for counts: none exceeds 1, some are not whole, and there are more histories. Counts
   !> that are computed, such as weighted means of many walls, may be as small
   subroutine refuse_fractions(collapses, histories, error)
      !> Collapses and histories at each level, as they are given
      real(wp), intent(in) :: collapses(:), histories(:)
      !> They look like fractions
      type(error_type), allocatable, intent(out) :: error

      if (any(collapses > 1.0_wp) .or. all(histories <= 1.0_wp)) return
      if (any(collapses > 0.0_wp .and. collapses < 1.0_wp)) call raise_input(error, 'collapses: look like fractions of the '// &
         & 'histories: must be counts, fraction times histories', out_of_range, 'collapses')
   end subroutine refuse_fractions

   !> Is there a curve?
   elemental function has_fit(self)
      class(fragility_type), intent(in) :: self
      !> True if theta, beta and what follows from them have values
      logical :: has_fit

      has_fit = self%status <= statuses_with_curve
   end function has_fit

   !> Whether the curve has standard errors
   elemental function has_errors(self)
      class(fragility_type), intent(in) :: self
      !> True if `covariance` has values
      logical :: has_errors

      has_errors = self%has_fit() .and. (self%errors == 'naive' .or. self%errors == 'clustered')
   end function has_errors

   !> Standard error of ln theta
   elemental function se_ln_theta(self) result(se)
      class(fragility_type), intent(in) :: self
      !> Its standard error
      real(wp) :: se

      se = sqrt(self%covariance(1, 1))
   end function se_ln_theta

   !> Standard error of beta
   elemental function se_beta(self) result(se)
      class(fragility_type), intent(in) :: self
      !> Its standard error
      real(wp) :: se

      se = sqrt(self%covariance(2, 2))
   end function se_beta

   !> Level at which collapse has a given probability, exact to rounding
   pure function level(self, probability)
      !> The curve; there must be a fit
      class(fragility_type), intent(in) :: self
      !> Probability between 0 and 1
      real(wp), intent(in) :: probability
      !> Level of intensity
      real(wp) :: level

      ! Phi is 0 and 1 to rounding at these
      type(bracket_type) :: bracket

      bracket = bracket_type(-40.0_wp, 40.0_wp)
      do while (bracket%is_divisible())
         call bracket%halve(normal_cdf(bracket%middle()) < probability)
      end do
      level = self%theta*exp(self%beta*bracket%middle())
   end function level

   !> Probability of collapse at a level, equation (5) of Nale et al.
   elemental function probability(self, level) result(p)
      !> The curve; must have a fit
      class(fragility_type), intent(in) :: self
      !> Level of intensity
      real(wp), intent(in) :: level
      !> P(C | IM = level)
      real(wp) :: p

      if (checked) call assert(self%has_fit(), 'a curve whose probability is asked has a fit')
      p = normal_cdf(log(level/self%theta)/self%beta)
   end function probability

end module dondolo_fragility
