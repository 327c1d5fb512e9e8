!> Fragility curves of damage states that never cross: lognormals with one dispersion, fitted together.
!>
!> A history is in the highest state that it reaches. With states 1 to K, each a part of the one before, the cumulative
!> probit model is P(state >= k | IM = x) = Phi(ln(x/theta_k)/beta), theta_1 <= ... <= theta_K (McCullagh 1980, J. R.
!> Stat. Soc. B 42, 109-142). Its likelihood is multinomial, of the numbers of histories between one threshold and the
!> next, and concave in ln theta_k/beta and 1/beta (Pratt 1981, J. Am. Stat. Assoc. 76, 103-106). States that none or
!> all of the histories reach have no curve, as in a fit of their own; states that the same histories reach share one. A
!> state for which reaching and not reaching do not overlap has a curve if that of another makes the slope finite.
module dondolo_fragility_ordinal
   use dondolo_base_error, only : error_type, out_of_range, raise_input
   use dondolo_base_invariant, only : checked
   use dondolo_base_kinds, only : wp
   use dondolo_base_lapack, only : invert_symmetric, solve_symmetric
   use dondolo_base_text, only : to_text
   use dondolo_fragility, only : assert_curve, fit_all_collapse, fit_decreasing, fit_extrapolated, fit_fragility, fit_nearly_flat, &
      & fit_no_collapse, fit_not_converged, fit_ok, fit_separated, fit_single_level, fragility_type, is_flat, log_normal_cdf, &
      & log_share, mills
   use dondolo_fragility_clustered, only : cluster_errors, fewest_clusters
   implicit none
   private

   public :: fit_ordinal, ordinal_errors

contains

   !> Fit the curves of all damage states with one dispersion
   subroutine fit_ordinal(curves, levels, reached, histories, error)
      !> Curve of each state; log likelihood and deviance are those of all together
      type(fragility_type), intent(out) :: curves(:)
      !> Levels of intensity
      real(wp), intent(in) :: levels(:)
      !> Histories that reach each state (levels, states), from the lowest state to collapse
      real(wp), intent(in) :: reached(:, :)
      !> Histories at each level
      real(wp), intent(in) :: histories(:)
      !> Counts that cannot be, also a state that more histories reach than the one before
      type(error_type), allocatable, intent(out) :: error

      real(wp), allocatable :: counts(:, :), b(:), information(:, :), covariance(:, :), jacobian(:, :)
      real(wp) :: x(size(levels)), centre, spread, height, flat
      integer :: of(size(curves)), k, last
      logical :: ok

      do k = 1, size(curves)
         if (k > 1) call check_order(levels, reached(:, k - 1), reached(:, k), error)
         if (allocated(error)) return
         call fit_fragility(curves(k), levels, reached(:, k), histories, error)
         if (allocated(error)) return
      end do
      call choose_states(reached, curves%status /= fit_no_collapse .and. curves%status /= fit_all_collapse, of)
      last = maxval(of)
      if (last < 2) return
      if (all(curves%status == fit_separated .or. curves%status == fit_single_level .or. of == 0)) return

      call between(reached, histories, of, counts)
      x = log(levels)
      centre = sum(histories*x)/sum(histories)
      spread = sqrt(sum(histories*(x - centre)**2)/sum(histories))
      x = (x - centre)/spread
      allocate (b(last + 1), information(last + 1, last + 1), covariance(last + 1, last + 1), jacobian(2, last + 1))
      call maximise(x, counts, b, information, height, flat, ok)
      if (ok) call invert_symmetric(information, covariance, ok)
      if (.not. b(last + 1) > 0.0_wp) ok = .false.
      do k = 1, size(curves)
         if (of(k) == 0) cycle
         curves(k) = fragility_type(bracket=curves(k)%bracket, status=merge(fit_decreasing, fit_not_converged, &
            & .not. b(last + 1) > 0.0_wp))
         if (.not. ok) cycle
         associate (curve => curves(k), cut => b(of(k)), slope => b(last + 1))
            curve%beta = spread/slope
            if (.not. abs(centre + curve%beta*cut) < 0.5_wp*log(huge(cut))) then
               curve%beta = 0.0_wp
               curve%status = fit_decreasing
               cycle
            end if
            curve%theta = exp(centre + curve%beta*cut)
            curve%status = fit_ok
            if (is_flat(height - flat)) curve%status = fit_nearly_flat
            if (curve%theta < minval(levels) .or. curve%theta > maxval(levels)) curve%status = fit_extrapolated
            curve%deviance = max(2.0_wp*(saturated(counts, histories) - height), 0.0_wp)
            curve%deviance_dof = last*count(histories > 0.0_wp) - (last + 1)
            curve%log_likelihood = height + sum(log_gamma(histories + 1.0_wp)) - sum(log_gamma(counts + 1.0_wp))
            jacobian = 0.0_wp
            jacobian(1, of(k)) = curve%beta
            jacobian(:, last + 1) = -curve%beta/slope*[cut, 1.0_wp]
            curve%naive = matmul(jacobian, matmul(covariance, transpose(jacobian)))
            curve%covariance = curve%naive
            if (checked) call assert_curve(curve)
         end associate
      end do
   end subroutine fit_ordinal

   !> Set the clustered covariances of curves that were fitted together, as cluster_errors does for one
   pure subroutine ordinal_errors(curves, levels, reached, histories, changes)
      !> Curves of fit_ordinal: covariance, clusters and errors of those with a fit are set
      type(fragility_type), intent(inout) :: curves(:)
      !> Levels of intensity
      real(wp), intent(in) :: levels(:)
      !> Histories of each cluster that reach each state (levels, states, clusters)
      real(wp), intent(in) :: reached(:, :, :)
      !> Histories of each cluster (levels, clusters)
      real(wp), intent(in) :: histories(:, :)
      !> Change of ln theta and beta if each cluster is left out, to first order (parameter, state, cluster)
      real(wp), intent(out) :: changes(:, :, :)

      real(wp), allocatable :: b(:), information(:, :), rest(:, :), score(:), change(:), counts(:, :)
      real(wp) :: x(size(levels))
      integer :: of(size(curves)), g, k, last, first
      logical :: ok

      changes = 0.0_wp
      call choose_states(sum(reached, dim=3), curves%has_fit(), of)
      last = maxval(of)
      if (last < 2) then
         do k = 1, size(curves)
            call cluster_errors(curves(k), levels, reached(:, k, :), histories, changes(:, k, :))
         end do
         return
      end if
      curves%clusters = merge(count(any(histories > 0.0_wp, dim=1)), 0, of > 0)
      do k = 1, size(curves)
         if (of(k) == 0) cycle
         curves(k)%covariance = 0.0_wp
         curves(k)%errors = 'few_clusters'
      end do
      first = findloc(of, 1, dim=1)
      if (curves(first)%clusters < fewest_clusters) return

      ! Cuts and slope in units in which the slope is 1
      allocate (b(last + 1), information(last + 1, last + 1), rest(last + 1, last + 1), score(last + 1), change(last + 1))
      associate (theta => curves(first)%theta, beta => curves(first)%beta)
         x = log(levels/theta)/beta
         do k = 1, size(curves)
            if (of(k) > 0) b(of(k)) = log(curves(k)%theta/theta)/beta
         end do
         b(last + 1) = 1.0_wp
         call expect(x, sum(histories, dim=2), b, information)
         ok = .true.
         do g = 1, size(histories, 2)
            if (.not. any(histories(:, g) > 0.0_wp)) cycle
            call between(reached(:, :, g), histories(:, g), of, counts)
            call gradient_of(x, counts, b, score)
            call expect(x, histories(:, g), b, rest)
            rest = information - rest
            ok = is_definite(rest, information)
            if (ok) call solve_symmetric(rest, score, change, ok)
            if (.not. ok) exit
            do k = 1, size(curves)
               if (of(k) == 0) cycle
               changes(:, k, g) = beta*[b(of(k))*change(last + 1) - change(of(k)), change(last + 1)]
            end do
         end do
      end associate
      if (.not. ok) changes = 0.0_wp
      do k = 1, size(curves)
         if (of(k) == 0) cycle
         curves(k)%errors = 'one_cluster'
         if (.not. ok) cycle
         curves(k)%errors = 'clustered'
         curves(k)%degrees_of_freedom = real(curves(k)%clusters - 1, wp)
         curves(k)%covariance = matmul(changes(:, k, :), transpose(changes(:, k, :)))
      end do
   end subroutine ordinal_errors

   !> Check that no more histories reach a state than the one before
   subroutine check_order(levels, before, reached, error)
      !> Levels of intensity
      real(wp), intent(in) :: levels(:)
      !> Histories that reach the state before, and the state
      real(wp), intent(in) :: before(:), reached(:)
      !> They do at a level
      type(error_type), allocatable, intent(out) :: error

      integer :: at

      if (size(before) /= size(levels)) return
      at = findloc(reached > before, .true., dim=1)
      if (at > 0) call raise_input(error, 'reached = '//to_text(reached(at))//' at level '//to_text(levels(at))// &
         & ': must be at most '//to_text(before(at))//', as many as reach the state before', out_of_range, 'reached')
   end subroutine check_order

   !> Number the states that differ: those that the same histories reach share a number
   pure subroutine choose_states(reached, takes_part, of)
      !> Histories that reach each state (levels, states)
      real(wp), intent(in) :: reached(:, :)
      !> Which states take part
      logical, intent(in) :: takes_part(:)
      !> Number of each state from 1; 0 for one that takes no part
      integer, intent(out) :: of(:)

      integer :: k, before

      of = 0
      before = 0
      do k = 1, size(of)
         if (.not. takes_part(k)) cycle
         of(k) = 1
         if (before > 0) of(k) = of(before) + merge(1, 0, any(reached(:, k) < reached(:, before)))
         before = k
      end do
   end subroutine choose_states

   !> Histories between one state and the next (levels, 0 to the number of states)
   pure subroutine between(reached, histories, of, counts)
      !> Histories that reach each state (levels, states)
      real(wp), intent(in) :: reached(:, :)
      !> Histories at each level
      real(wp), intent(in) :: histories(:)
      !> Number of each state
      integer, intent(in) :: of(:)
      !> Numbers of histories
      real(wp), allocatable, intent(out) :: counts(:, :)

      integer :: c

      allocate (counts(size(histories), 0:maxval(of)))
      counts(:, 0) = histories
      do c = 1, maxval(of)
         counts(:, c) = reached(:, findloc(of, c, dim=1))
         counts(:, c - 1) = counts(:, c - 1) - counts(:, c)
      end do
   end subroutine between

   !> Newton's method with halved steps on the concave log likelihood
   subroutine maximise(x, counts, b, information, height, flat, ok)
      !> Predictor
      real(wp), intent(in) :: x(:)
      !> Histories between one state and the next (levels, 0 to states)
      real(wp), intent(in) :: counts(:, 0:)
      !> Cuts and slope at the maximum; with a slope that is not positive they are those of no slope
      real(wp), intent(out) :: b(:)
      !> Fisher information there
      real(wp), intent(out) :: information(:, :)
      !> Log likelihood without the multinomial coefficients
      real(wp), intent(out) :: height
      !> The same without a slope
      real(wp), intent(out) :: flat
      !> Has it converged?
      logical, intent(out) :: ok

      integer, parameter :: most_steps = 200, most_halvings = 60
      real(wp), parameter :: rounding = 1.0e-12_wp
      type(fragility_type) :: unit
      real(wp) :: gradient(size(b)), hessian(size(b), size(b)), change(size(b)), trial
      integer :: c, i, k, last

      ! Without a slope the cuts follow from the fractions; there the slope of the likelihood has the sign of that of the
      ! curve.
      last = size(b) - 1
      unit%theta = 1.0_wp
      unit%beta = 1.0_wp
      do c = 1, last
         b(c) = -log(unit%level(sum(counts(:, c:))/sum(counts)))
      end do
      b(last + 1) = 0.0_wp
      information = 0.0_wp
      flat = 0.0_wp
      ok = .false.
      call gradient_of(x, counts, b, gradient, hessian)
      if (.not. gradient(last + 1) > 16.0_wp*epsilon(x)*sum(counts)) return
      flat = log_likelihood(x, counts, b)
      height = flat
      do i = 1, most_steps
         call gradient_of(x, counts, b, gradient, hessian)
         call solve_symmetric(hessian, gradient, change, ok)
         if (.not. ok) return
         do k = 1, most_halvings
            trial = log_likelihood(x, counts, b + change)
            if (trial >= height - rounding*abs(height)) exit
            change = 0.5_wp*change
         end do
         b = b + change
         height = trial
         if (maxval(abs(change)) <= rounding*maxval(abs(b))) exit
      end do
      ok = i <= most_steps
      call expect(x, sum(counts, dim=2), b, information)
   end subroutine maximise

   !> Largest log likelihood that there is, without the multinomial coefficients: that of the fractions themselves
   pure real(wp) function saturated(counts, histories)
      !> Histories between one state and the next (levels, 0 to states)
      real(wp), intent(in) :: counts(:, 0:)
      !> Histories at each level
      real(wp), intent(in) :: histories(:)

      saturated = sum(log_share(counts, spread(histories, 2, size(counts, 2))))
   end function saturated

   !> Log likelihood without the multinomial coefficients; -huge where the cuts do not increase
   pure real(wp) function log_likelihood(x, counts, b) result(height)
      !> Predictor
      real(wp), intent(in) :: x(:)
      !> Histories between one state and the next (levels, 0 to states)
      real(wp), intent(in) :: counts(:, 0:)
      !> Cuts and slope
      real(wp), intent(in) :: b(:)

      real(wp) :: log_p, parts(2), ends(2)
      integer :: c, j, last

      last = size(b) - 1
      height = -huge(height)
      if (any(b(2:last) <= b(:last - 1))) return
      height = 0.0_wp
      do c = 0, last
         do j = 1, size(x)
            if (.not. counts(j, c) > 0.0_wp) cycle
            call look_at(x(j), b, c, log_p, ends, parts)
            height = height + counts(j, c)*log_p
         end do
      end do
   end function log_likelihood

   !> Gradient of the log likelihood and the negative of its second derivatives
   pure subroutine gradient_of(x, counts, b, gradient, hessian)
      !> Predictor
      real(wp), intent(in) :: x(:)
      !> Histories between one state and the next (levels, 0 to states)
      real(wp), intent(in) :: counts(:, 0:)
      !> Cuts and slope
      real(wp), intent(in) :: b(:)
      !> Derivatives with respect to b
      real(wp), intent(out) :: gradient(:)
      !> Second derivatives, with the sign turned
      real(wp), intent(out), optional :: hessian(:, :)

      real(wp) :: log_p, ends(2), parts(2), sides(size(b), 2), slope(size(b)), curvature
      integer :: c, i, j

      gradient = 0.0_wp
      if (present(hessian)) hessian = 0.0_wp
      do c = 0, size(b) - 1
         do j = 1, size(x)
            if (.not. counts(j, c) > 0.0_wp) cycle
            call look_at(x(j), b, c, log_p, ends, parts, sides)
            slope = matmul(sides, parts)
            gradient = gradient + counts(j, c)*slope
            if (.not. present(hessian)) cycle
            ! ln p has second derivatives only through the ends and through p itself.
            hessian = hessian + counts(j, c)*product_of(slope)
            do i = 1, 2
               curvature = counts(j, c)*ends(i)*parts(i)
               hessian = hessian + curvature*product_of(sides(:, i))
            end do
         end do
      end do
   end subroutine gradient_of

   !> Fisher information
   pure subroutine expect(x, histories, b, information)
      !> Predictor
      real(wp), intent(in) :: x(:)
      !> Histories at each level
      real(wp), intent(in) :: histories(:)
      !> Cuts and slope
      real(wp), intent(in) :: b(:)
      real(wp), intent(out) :: information(:, :)

      real(wp) :: log_p, ends(2), parts(2), sides(size(b), 2)
      integer :: c, j

      information = 0.0_wp
      do c = 0, size(b) - 1
         do j = 1, size(x)
            if (.not. histories(j) > 0.0_wp) cycle
            call look_at(x(j), b, c, log_p, ends, parts, sides)
            information = information + histories(j)*exp(log_p)*product_of(matmul(sides, parts))
         end do
      end do
   end subroutine expect

   !> The probability p = Phi(u) - Phi(v) to be between two states, with u = slope x - cut of the lower and v of the upper
   pure subroutine look_at(x, b, c, log_p, ends, parts, sides)
      !> Predictor
      real(wp), intent(in) :: x
      !> Cuts and slope
      real(wp), intent(in) :: b(:)
      !> Number of the lower state, 0 for none; the last has none above it
      integer, intent(in) :: c
      !> ln p
      real(wp), intent(out) :: log_p
      !> u and v; 0 where there is none
      real(wp), intent(out) :: ends(2)
      !> Derivatives of ln p with respect to u and v
      real(wp), intent(out) :: parts(2)
      !> Derivatives of u and v with respect to b
      real(wp), intent(out), optional :: sides(:, :)

      real(wp), parameter :: log_root_2_pi = 0.5_wp*log(2.0_wp*acos(-1.0_wp))
      real(wp) :: near, far
      integer :: last

      last = size(b) - 1
      ends = 0.0_wp
      parts = 0.0_wp
      if (c > 0) ends(1) = b(last + 1)*x - b(c)
      if (c < last) ends(2) = b(last + 1)*x - b(c + 1)
      if (c == 0) then
         log_p = log_normal_cdf(-ends(2))
         parts(2) = -mills(ends(2))
      else if (c == last) then
         log_p = log_normal_cdf(ends(1))
         parts(1) = mills(-ends(1))
      else
         ! In the tail that keeps the digits
         near = log_normal_cdf(merge(-ends(2), ends(1), sum(ends) > 0.0_wp))
         far = log_normal_cdf(merge(-ends(1), ends(2), sum(ends) > 0.0_wp))
         log_p = near + log(max(1.0_wp - exp(far - near), tiny(near)))
         parts = exp(-0.5_wp*ends**2 - log_root_2_pi - log_p)*[1.0_wp, -1.0_wp]
      end if
      if (.not. present(sides)) return
      sides = 0.0_wp
      if (c > 0) sides(c, 1) = -1.0_wp
      if (c < last) sides(c + 1, 2) = -1.0_wp
      sides(last + 1, :) = x
   end subroutine look_at

   !> v v^T
   pure function product_of(v) result(matrix)
      real(wp), intent(in) :: v(:)
      real(wp) :: matrix(size(v), size(v))

      matrix = spread(v, 1, size(v))*spread(v, 2, size(v))
   end function product_of

   !> Is a matrix positive definite, by more than rounding of a larger one?
   pure logical function is_definite(matrix, larger)
      real(wp), intent(in) :: matrix(:, :)
      !> What it is a part of
      real(wp), intent(in) :: larger(:, :)

      real(wp) :: less(size(matrix, 1), size(matrix, 1)), zeros(size(matrix, 1)), solution(size(matrix, 1))
      integer :: i

      zeros = 0.0_wp
      less = matrix
      do i = 1, size(matrix, 1)
         less(i, i) = less(i, i) - 1.0e-12_wp*larger(i, i)
      end do
      call solve_symmetric(less, zeros, solution, is_definite)
   end function is_definite

end module dondolo_fragility_ordinal
