!> Standard errors of a fragility curve whose histories are not independent of each other.
!>
!> The same records are run at every level, in both polarities and with both components, so that the Fisher information
!> counts the same evidence several times. Histories of one cluster, a record or an earthquake, may depend on each other
!> in any way; clusters are independent. With s_g the score of cluster g and I_g its part of the Fisher information I of
!> the probit regression, the covariance of b is
!>
!>    I^-1 [ sum_g r_g r_g^T ] I^-1,   r_g = I (I - I_g)^-1 s_g
!>
!> (Liang and Zeger 1986; Mancl and DeRouen 2001, Biometrics 57, 126-134), the sandwich estimator in which (I - I_g)^-1 s_g
!> is the change of b if the cluster is left out, to first order. Intervals use Student's t with one degree of freedom
!> less than there are clusters. docs/reading_a_curve.md compares it with others.
module dondolo_fragility_clustered
   use dondolo_base_invariant, only : assert, checked, lies_between
   use dondolo_base_kinds, only : wp
   use dondolo_base_lapack, only : solve_symmetric
   use dondolo_base_normal, only : normal_quantile
   use dondolo_base_student, only : student_quantile
   use dondolo_fragility, only : assert_curve, fragility_type, mills, normal_cdf
   implicit none
   private

   public :: cluster_errors, leave_out_type, parameter_intervals, probability_interval
   public :: confidence, determinant, fewest_clusters, correction

   !> Confidence of the intervals that the executable gives
   real(wp), parameter :: confidence = 0.95_wp
   !> Fewer clusters than this cannot determine the covariance of two parameters
   integer, parameter :: fewest_clusters = 3
   !> Name of the small-sample correction
   character(len=*), parameter :: correction = 'CR3 (Mancl and DeRouen 2001), Student''s t'

   !> A fitted curve and the histories behind it, cluster after cluster of which is left out.
   !>
   !> P = Phi(b1 + b2 x) with b = (0, 1): to first order b1 is -d ln theta/beta, and b2 is 1 - d beta/beta.
   type :: leave_out_type
      !> Dispersion
      real(wp) :: beta = 0.0_wp
      !> ln(level/theta)/beta, probability there, and what score and information are made of
      real(wp), allocatable :: x(:), chance(:), steep(:), part(:)
      !> Fisher information of all histories on b
      real(wp) :: information(2, 2) = 0.0_wp
   contains
      !> Take a curve and its histories
      procedure :: begin
      !> Change of ln theta and beta without one of the clusters
      procedure :: without
   end type leave_out_type

contains

   !> Set the clustered covariance of a fitted curve
   pure subroutine cluster_errors(curve, levels, collapses, histories, changes)
      !> Curve with a fit: covariance, clusters and errors are set; without one it stays as it is
      type(fragility_type), intent(inout) :: curve
      !> Levels of intensity
      real(wp), intent(in) :: levels(:)
      !> Collapses of each cluster (levels, clusters), that add up to those that were fitted
      real(wp), intent(in) :: collapses(:, :)
      !> Histories of each cluster (levels, clusters); a cluster without any does not count
      real(wp), intent(in) :: histories(:, :)
      !> Change of ln theta and beta if each cluster is left out, to first order (parameter, cluster); 0 without errors
      real(wp), intent(out) :: changes(:, :)

      type(leave_out_type) :: data
      integer :: g
      logical :: ok

      changes = 0.0_wp
      if (.not. curve%has_fit()) return
      curve%clusters = count([(any(histories(:, g) > 0.0_wp), g=1, size(histories, 2))])
      curve%covariance = 0.0_wp
      curve%errors = 'few_clusters'
      if (curve%clusters < fewest_clusters) return
      call data%begin(curve, levels, sum(histories, dim=2))
      do g = 1, size(histories, 2)
         if (.not. any(histories(:, g) > 0.0_wp)) cycle
         call data%without(collapses(:, g), histories(:, g), changes(:, g), ok)
         if (ok) cycle
         changes = 0.0_wp
         curve%errors = 'one_cluster'
         return
      end do
      curve%errors = 'clustered'
      curve%covariance = matmul(changes, transpose(changes))
      curve%degrees_of_freedom = real(curve%clusters - 1, wp)
      if (checked) call assert_curve(curve)
   end subroutine cluster_errors

   !> Take a curve and its histories
   pure subroutine begin(self, curve, levels, histories)
      class(leave_out_type), intent(inout) :: self
      !> Curve with a fit
      type(fragility_type), intent(in) :: curve
      !> Levels of intensity
      real(wp), intent(in) :: levels(:)
      !> Histories of all clusters at each level
      real(wp), intent(in) :: histories(:)

      integer :: j

      self%beta = curve%beta
      self%x = log(levels/curve%theta)/curve%beta
      self%steep = mills(self%x) + mills(-self%x)
      self%part = mills(self%x)*mills(-self%x)
      self%chance = normal_cdf(self%x)
      self%information = 0.0_wp
      do j = 1, size(levels)
         self%information = self%information + histories(j)*self%part(j)*square(self%x(j))
      end do
   end subroutine begin

   !> Change of ln theta and beta if a cluster is left out, to first order
   pure subroutine without(self, collapses, histories, change, ok)
      class(leave_out_type), intent(in) :: self
      !> Collapses and histories of the cluster at each level
      real(wp), intent(in) :: collapses(:), histories(:)
      !> Changes
      real(wp), intent(out) :: change(2)
      !> False: without the cluster there is no information on both parameters
      logical, intent(out) :: ok

      real(wp) :: rest(2, 2), score(2)
      integer :: j

      if (checked) call assert(all(lies_between(collapses, 0.0_wp, histories)), 'collapses of a cluster are some of its histories')
      change = 0.0_wp
      score = 0.0_wp
      rest = self%information
      do j = 1, size(collapses)
         score = score + (collapses(j) - histories(j)*self%chance(j))*self%steep(j)*[1.0_wp, self%x(j)]
         rest = rest - histories(j)*self%part(j)*square(self%x(j))
      end do
      ok = determinant(rest) > 1.0e-12_wp*determinant(self%information)
      if (ok) call solve_symmetric(rest, score, change, ok)
      change = self%beta*change
   end subroutine without

   !> Confidence intervals of theta and beta, symmetric in ln theta and in 1/beta, the slope of the regression
   pure function parameter_intervals(curve) result(bounds)
      !> Curve with standard errors
      type(fragility_type), intent(in) :: curve
      !> Bounds of theta and of beta (lower and upper, parameter); huge where there is none above
      real(wp) :: bounds(2, 2)

      real(wp) :: quantile, half

      quantile = quantile_of(curve)
      bounds(:, 1) = curve%theta*exp(quantile*curve%se_ln_theta()*[-1.0_wp, 1.0_wp])
      half = quantile*curve%se_beta()/curve%beta
      bounds(1, 2) = curve%beta/(1.0_wp + half)
      bounds(2, 2) = huge(half)
      if (half < 1.0_wp) bounds(2, 2) = curve%beta/(1.0_wp - half)
      bounds = min(bounds, huge(half))
   end function parameter_intervals

   !> Confidence interval of the probability of collapse at a level, symmetric in its normal quantile
   pure function probability_interval(curve, level) result(bounds)
      !> Curve with standard errors
      type(fragility_type), intent(in) :: curve
      !> Level of intensity, positive
      real(wp), intent(in) :: level
      !> Lower and upper bound
      real(wp) :: bounds(2)

      real(wp) :: probit, gradient(2), half

      probit = log(level/curve%theta)/curve%beta
      ! Of the probit with respect to ln theta and beta
      gradient = -[1.0_wp, probit]/curve%beta
      half = quantile_of(curve)*sqrt(max(0.0_wp, dot_product(gradient, matmul(curve%covariance, gradient))))
      bounds = normal_cdf(probit + half*[-1.0_wp, 1.0_wp])
   end function probability_interval

   !> Quantile of the intervals of a curve: of Student's t where its errors are clustered
   pure real(wp) function quantile_of(curve)
      !> Curve with standard errors
      type(fragility_type), intent(in) :: curve

      if (curve%errors == 'naive') then
         quantile_of = normal_quantile(0.5_wp*(1.0_wp + confidence))
      else
         quantile_of = student_quantile(0.5_wp*(1.0_wp + confidence), curve%degrees_of_freedom)
      end if
   end function quantile_of

   !> (1, x)(1, x)^T
   pure function square(x) result(matrix)
      real(wp), intent(in) :: x
      real(wp) :: matrix(2, 2)

      matrix = reshape([1.0_wp, x, x, x**2], [2, 2])
   end function square

   !> Determinant of a symmetric matrix
   pure real(wp) function determinant(matrix)
      real(wp), intent(in) :: matrix(2, 2)

      determinant = matrix(1, 1)*matrix(2, 2) - matrix(1, 2)**2
   end function determinant

end module dondolo_fragility_clustered
