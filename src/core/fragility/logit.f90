!> Logistic regression of collapses on ln x, P = 1/(1 + exp(-(b1 + b2 ln x))), by maximum likelihood: beside the lognormal, which is
!> a probit regression, the other usual curve.
!>
!> Standard errors are those of dondolo_fragility_clustered: with s_g the score of cluster g and I_g its part of the Fisher
!> information I, the covariance is the sum over the clusters of d_g d_g^T, d_g = (I - I_g)^-1 s_g (Mancl and DeRouen 2001).
module dondolo_fragility_logit
   use dondolo_base_invariant, only : assert, checked, is_covariance
   use dondolo_base_kinds, only : wp
   use dondolo_base_lapack, only : invert_symmetric, solve_symmetric
   use dondolo_fragility, only : outer
   use dondolo_fragility_clustered, only : determinant, fewest_clusters
   implicit none
   private

   public :: logit_type, fit_logit

   !> A fitted logistic curve
   type :: logit_type
      !> Intercept and slope on ln x
      real(wp) :: b(2) = 0.0_wp
      !> Their covariance, from clusters of histories, or as if all were independent
      real(wp) :: covariance(2, 2) = 0.0_wp
      !> Logarithm of the likelihood of the histories one by one, without binomial coefficients
      real(wp) :: log_likelihood = 0.0_wp
      !> Has it a finite maximum?
      logical :: has_fit = .false.
      !> Do clusters determine the covariance?
      logical :: is_clustered = .false.
   end type logit_type

contains

   !> Fit a logistic curve
   subroutine fit_logit(curve, levels, z, n, cluster)
      type(logit_type), intent(out) :: curve
      !> Level of intensity of each count, positive
      real(wp), intent(in) :: levels(:)
      !> Collapses and histories of each count
      real(wp), intent(in) :: z(:), n(:)
      !> Cluster of each, numbered from 1 without a gap; all 1: the histories are independent
      integer, intent(in) :: cluster(:)

      integer, parameter :: most_steps = 200, most_halvings = 60
      real(wp), parameter :: rounding = 1.0e-12_wp
      real(wp), allocatable :: x(:), p(:)
      real(wp) :: b(2), change(2), information(2, 2), centre, spread, height, trial
      integer :: i, k
      logical :: ok

      x = log(levels)
      centre = sum(n*x)/sum(n)
      spread = sqrt(sum(n*(x - centre)**2)/sum(n))
      if (.not. spread > 0.0_wp) return
      x = (x - centre)/spread
      b = 0.0_wp
      height = log_likelihood(b, x, z, n)
      ok = .false.
      do i = 1, most_steps
         p = logistic(b(1) + b(2)*x)
         information = outer(n*p*(1.0_wp - p), x)
         call solve_symmetric(information, [sum(z - n*p), sum((z - n*p)*x)], change, ok)
         if (.not. ok) return
         do k = 1, most_halvings
            trial = log_likelihood(b + change, x, z, n)
            if (trial >= height - rounding*abs(height)) exit
            change = 0.5_wp*change
         end do
         b = b + change
         height = trial
         if (maxval(abs(change)) <= rounding*maxval(abs(b))) exit
      end do
      if (i > most_steps) return
      p = logistic(b(1) + b(2)*x)
      curve%has_fit = .true.
      curve%log_likelihood = height
      call set_covariance(curve, b, x, z, n, cluster)
      ! From the scaled predictor to ln x
      curve%b = [b(1) - b(2)*centre/spread, b(2)/spread]
      information = reshape([1.0_wp, 0.0_wp, -centre/spread, 1.0_wp/spread], [2, 2])
      curve%covariance = matmul(information, matmul(curve%covariance, transpose(information)))
      if (checked) call assert(is_covariance(curve%covariance), 'the covariance of a curve is symmetric and not negative')
   end subroutine fit_logit

   !> Set the covariance of a curve on the scaled predictor
   subroutine set_covariance(curve, b, x, z, n, cluster)
      type(logit_type), intent(inout) :: curve
      !> Intercept and slope
      real(wp), intent(in) :: b(2)
      !> Scaled predictor, collapses and histories of each count
      real(wp), intent(in) :: x(:), z(:), n(:)
      !> Cluster of each
      integer, intent(in) :: cluster(:)

      real(wp), allocatable :: score(:, :), part(:, :, :)
      real(wp) :: information(2, 2), rest(2, 2), change(2), covariance(2, 2), p
      integer :: i, g
      logical :: ok

      allocate (score(2, maxval(cluster)), part(2, 2, maxval(cluster)), source=0.0_wp)
      do i = 1, size(x)
         g = cluster(i)
         p = logistic(b(1) + b(2)*x(i))
         score(:, g) = score(:, g) + (z(i) - n(i)*p)*[1.0_wp, x(i)]
         part(:, :, g) = part(:, :, g) + n(i)*p*(1.0_wp - p)*spread_of([1.0_wp, x(i)])
      end do
      information = sum(part, dim=3)
      call invert_symmetric(information, covariance, ok)
      curve%has_fit = ok
      if (ok) curve%covariance = covariance
      if (.not. ok .or. size(score, 2) < fewest_clusters) return
      covariance = 0.0_wp
      do g = 1, size(score, 2)
         rest = information - part(:, :, g)
         ok = determinant(rest) > 1.0e-12_wp*determinant(information)
         if (ok) call solve_symmetric(rest, score(:, g), change, ok)
         ! One cluster alone determines the curve.
         if (.not. ok) return
         covariance = covariance + spread_of(change)
      end do
      curve%is_clustered = .true.
      curve%covariance = covariance
   end subroutine set_covariance

   !> Log likelihood without binomial coefficients
   pure real(wp) function log_likelihood(b, x, z, n) result(height)
      !> Intercept and slope
      real(wp), intent(in) :: b(2)
      !> Predictor, collapses and histories
      real(wp), intent(in) :: x(:), z(:), n(:)

      height = -sum(z*log_one_plus_exp(-b(1) - b(2)*x) + (n - z)*log_one_plus_exp(b(1) + b(2)*x))
   end function log_likelihood

   !> 1/(1 + exp(-t)), accurate in both tails
   elemental real(wp) function logistic(t)
      real(wp), intent(in) :: t

      logistic = exp(-log_one_plus_exp(-t))
   end function logistic

   !> ln(1 + exp(t)) without overflow
   elemental real(wp) function log_one_plus_exp(t) result(value)
      real(wp), intent(in) :: t

      real(wp) :: small

      small = exp(-abs(t))
      value = max(t, 0.0_wp) + log(1.0_wp + small)
      ! Where 1 + small is 1 to rounding
      if (small < epsilon(small)) value = max(t, 0.0_wp) + small
   end function log_one_plus_exp

   !> v v^T
   pure function spread_of(v) result(matrix)
      real(wp), intent(in) :: v(2)
      real(wp) :: matrix(2, 2)

      matrix = reshape([v(1)**2, v(1)*v(2), v(1)*v(2), v(2)**2], [2, 2])
   end function spread_of

end module dondolo_fragility_logit
