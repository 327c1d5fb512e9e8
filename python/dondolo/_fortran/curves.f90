!> Fragility curves.
module curves
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use dondolo_base_error, only : error_type
   use dondolo_base_student, only : quantile => student_quantile
   use dondolo_base_threads, only : team_of
   use dondolo_base_warning, only : warnings_type
   use dondolo_boundary, only : check_room
   use dondolo_case_elastic_warnings, only : elastic_warnings_type
   use dondolo_case_result_warnings, only : warn_of_fit, warn_of_the_union => warn_of_union
   use dondolo_curve_parcel, only : put_curves, put_fits
   use dondolo_fragility, only : error_names, fit_fragility, fit_ok, fragility_type, refuse_fractions
   use dondolo_fragility_clustered, only : cluster_errors
   use dondolo_fragility_logit, only : fit_one_logit => fit_logit, logit_type
   use dondolo_fragility_ordinal, only : ordinal_fit => fit_ordinal, ordinal_errors
   use dondolo_fragility_ratio, only : compare => compare_parameters
   use dondolo_fragility_stripes, only : stripes_type
   use dondolo_interface_handles, only : find_walls
   use dondolo_parcel, only : parcel_type, report, send
   use dondolo_population, only : interpolated
   use dondolo_population_occurrence, only : probability_of => wall_probability, slopes_of => wall_slopes
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: fit_curves, cluster_changes, fit_logit, fit_ordinal, probability, row_probability, wall_probability, wall_slopes
   public :: warn_of_curve, compare_parameters, student_quantile, warn_of_union

   !> Fits that take a thread longer, by a few times, than it takes a team to begin and to end: some milliseconds
   integer, parameter :: fits_of_thread = 200

contains

   !> Fit k curves, each to m levels: what is sent is named as put_fits has it. The error is that of the first that goes wrong.
   !> Counts that somebody gives (given: 1) must not be fractions
   subroutine fit_curves(levels, collapses, histories, given, m, k, sent)
      !f2py threadsafe
      integer(c_int), intent(in) :: given, m, k
      real(c_double), intent(in) :: levels(m), collapses(m, k), histories(m, k)
      integer(c_int64_t), intent(out) :: sent(5)
      type(fragility_type), allocatable :: curves(:)
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error, first
      integer :: i, worst, team

      call check_room(first, reals=40.0_c_double*(real(m, c_double) + k))
      if (.not. allocated(first)) then
         allocate (curves(k))
         worst = k + 1
         team = team_of(0, k/fits_of_thread)
         !$omp parallel do num_threads(team) default(none) private(error) &
         !$omp & shared(k, given, levels, collapses, histories, curves, worst, first)
         do i = 1, k
            call fit_fragility(curves(i), levels, collapses(:, i), histories(:, i), error)
            if (given == 1 .and. .not. allocated(error)) call refuse_fractions(collapses(:, i), histories(:, i), error)
            if (allocated(error)) then
               !$omp critical (first_error)
               if (i < worst) then
                  worst = i
                  call move_alloc(error, first)
               end if
               !$omp end critical (first_error)
            end if
         end do
         !$omp end parallel do
         if (.not. allocated(first)) call put_fits(parcel, '', curves)
      end if
      call send(parcel, first, sent)
   end subroutine fit_curves

   !> Change of ln theta and beta of a fitted curve if each of g clusters is left out, to first order; errors are
   !> places among the names; covariance is that of ln theta and beta
   subroutine cluster_changes(levels, collapses, histories, theta, beta, m, g, changes, covariance, errors, failure)
      integer(c_int), intent(in) :: m, g
      real(c_double), intent(in) :: levels(m), collapses(m, g), histories(m, g), theta, beta
      real(c_double), intent(out) :: changes(2, g), covariance(2, 2)
      integer(c_int), intent(out) :: errors
      integer(c_int64_t), intent(out) :: failure(5)
      type(fragility_type) :: curve
      type(error_type), allocatable :: error

      changes = 0
      covariance = 0
      errors = 0
      call check_room(error, reals=40.0_c_double*m)
      call report(error, failure)
      if (allocated(error)) return
      curve = fragility_type(status=fit_ok, theta=theta, beta=beta)
      call cluster_errors(curve, levels, collapses, histories, changes)
      covariance = curve%covariance
      errors = findloc(error_names, curve%errors, dim=1)
   end subroutine cluster_changes

   !> Curves of k damage states with one dispersion, from the histories of each of g clusters that reach each state at each of
   !> m levels: what is sent is named as put_curves has it, and changes (2, k, g) and covariance (2, 2, k) are as
   !> cluster_changes has them
   subroutine fit_ordinal(levels, reached, histories, m, k, g, sent)
      integer(c_int), intent(in) :: m, k, g
      real(c_double), intent(in) :: levels(m), reached(m, k, g), histories(m, g)
      integer(c_int64_t), intent(out) :: sent(5)
      type(fragility_type), allocatable :: curves(:)
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      real(c_double), allocatable :: changes(:, :, :)
      integer :: i

      call check_room(error, reals=8.0_c_double*m*(real(k, c_double)*g + g))
      if (.not. allocated(error)) then
         allocate (curves(k), changes(2, k, g))
         call ordinal_fit(curves, levels, sum(reached, 3), sum(histories, 2), error)
      end if
      if (.not. allocated(error)) then
         call ordinal_errors(curves, levels, reached, histories, changes)
         call put_curves(parcel, '', curves)
         call parcel%put('changes', [changes], shape(changes))
         call parcel%put('covariance', [(curves(i)%covariance, i=1, k)], [2, 2, k])
      end if
      call send(parcel, error, sent)
   end subroutine fit_ordinal

   !> A logistic curve of k counts, each of a cluster from 1; all 1: the histories are independent. Numbers: b0, b1, var b0,
   !> covariance, var b1, log likelihood; done: 0 without a finite maximum, 1 with naive errors, 2 with clustered
   subroutine fit_logit(levels, collapses, histories, cluster, k, numbers, done, failure)
      !f2py threadsafe
      integer(c_int), intent(in) :: k, cluster(k)
      real(c_double), intent(in) :: levels(k), collapses(k), histories(k)
      real(c_double), intent(out) :: numbers(6)
      integer(c_int), intent(out) :: done
      integer(c_int64_t), intent(out) :: failure(5)
      type(logit_type) :: curve
      type(error_type), allocatable :: error

      numbers = 0
      done = 0
      call check_room(error, reals=20.0_c_double*k)
      call report(error, failure)
      if (allocated(error)) return
      call fit_one_logit(curve, levels, collapses, histories, cluster)
      numbers = [curve%b, curve%covariance(1, 1), curve%covariance(1, 2), curve%covariance(2, 2), curve%log_likelihood]
      if (curve%has_fit) done = merge(2, 1, curve%is_clustered)
   end subroutine fit_logit

   !> Compare a parameter of two curves, from their ratio and the changes of its logarithm if each cluster is left out
   subroutine compare_parameters(ratio, changes, n, degrees, confidence, interval, p_value)
      integer(c_int), intent(in) :: n
      real(c_double), intent(in) :: ratio, changes(n), degrees, confidence
      real(c_double), intent(out) :: interval(2), p_value

      call compare(ratio, changes, degrees, confidence, interval, p_value)
   end subroutine compare_parameters

   !> Probabilities of collapse of a lognormal curve, equation (5) of Nale et al.
   subroutine probability(theta, beta, x, n, p)
      !f2py threadsafe
      integer(c_int), intent(in) :: n
      real(c_double), intent(in) :: theta, beta, x(n)
      real(c_double), intent(out) :: p(n)
      type(fragility_type) :: curve

      curve%theta = theta
      curve%beta = beta
      p = curve%probability(x)
   end subroutine probability

   !> Probabilities (x, rows) of the rows of a population at n levels: by their curves, or without one, for a theta that is not
   !> finite, by their fractions
   subroutine row_probability(levels, fractions, theta, beta, x, m, r, n, p)
      !f2py threadsafe
      integer(c_int), intent(in) :: m, r, n
      real(c_double), intent(in) :: levels(m), fractions(m, r), theta(r), beta(r), x(n)
      real(c_double), intent(out) :: p(n, r)
      integer :: i

      do i = 1, r
         if (ieee_is_finite(theta(i))) then
            call probability(theta(i), beta(i), x, n, p(:, i))
         else
            p(:, i) = interpolated(levels, fractions(:, i), x)
         end if
      end do
   end subroutine row_probability

   !> Quantile of Student's t
   subroutine student_quantile(p, degrees, t)
      real(c_double), intent(in) :: p, degrees
      real(c_double), intent(out) :: t

      t = quantile(p, degrees)
   end subroutine student_quantile

   !> Probability that each wall collapses, of k probabilities of each row if it can occur; alternative: as
   !> dondolo_population_occurrence has it; rows: how many each wall has
   subroutine wall_probability(p_occ, alternative, p, k, r, rows, w, whole)
      !f2py threadsafe
      integer(c_int), intent(in) :: k, r, w, rows(w), alternative(r)
      real(c_double), intent(in) :: p_occ(r), p(k, r)
      real(c_double), intent(out) :: whole(k, w)
      integer :: i, first, last

      first = 1
      do i = 1, w
         last = first + rows(i) - 1
         whole(:, i) = probability_of(p_occ(first:last), alternative(first:last), p(:, first:last))
         first = last + 1
      end do
   end subroutine wall_probability

   !> Derivative of the probability of each wall with respect to that of each of its rows if it can occur, of k probabilities
   subroutine wall_slopes(p_occ, alternative, p, k, r, rows, w, slopes)
      !f2py threadsafe
      integer(c_int), intent(in) :: k, r, w, rows(w), alternative(r)
      real(c_double), intent(in) :: p_occ(r), p(k, r)
      real(c_double), intent(out) :: slopes(k, r)
      integer :: i, first, last

      first = 1
      do i = 1, w
         last = first + rows(i) - 1
         slopes(:, first:last) = slopes_of(p_occ(first:last), alternative(first:last), p(:, first:last))
         first = last + 1
      end do
   end subroutine wall_slopes

   !> Warnings of the executable for the curve of one wall, or for walls = 0 of counts without a wall; from histories of so many
   !> records, 0 for counts; status, its place among the names
   subroutine warn_of_curve(walls, levels, m, largest_edp, edp_threshold, records, theta, beta, bracket, status, sent)
      integer(c_int64_t), intent(in) :: walls
      integer(c_int), intent(in) :: m, records, status
      real(c_double), intent(in) :: levels(m), largest_edp, edp_threshold, theta, beta, bracket(2)
      integer(c_int64_t), intent(out) :: sent(5)
      type(wall_type), pointer :: list(:), wall
      type(stripes_type) :: stripes
      type(fragility_type) :: fragility
      type(elastic_warnings_type) :: elastic
      type(warnings_type) :: warnings
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      integer :: i

      wall => null()
      if (walls /= 0) call find_walls(walls, list, error)
      if (.not. allocated(error)) then
         if (walls /= 0) wall => list(1)
         fragility%status = status
         fragility%theta = theta
         fragility%beta = beta
         fragility%bracket = bracket
         stripes%levels = levels
         stripes%record = [(i, i=1, records)]
         ! Of the responses the sentences need the largest only
         allocate (stripes%response(1, 1))
         stripes%response%edp = largest_edp
         call warn_of_fit(wall, stripes, fragility, warnings)
         if (walls /= 0) call elastic%look(wall)
         call elastic%warn_of_thresholds([edp_threshold], warnings)
         call warnings%put_objects(parcel%lines)
      end if
      call send(parcel, error, sent)
   end subroutine warn_of_curve

   !> What the executable would warn of, of the curve of one facade or wall with several mechanisms; status, its place among
   !> the names
   subroutine warn_of_union(name, theta, status, sent)
      character(len=*), intent(in) :: name
      real(c_double), intent(in) :: theta
      integer(c_int), intent(in) :: status
      integer(c_int64_t), intent(out) :: sent(5)
      type(fragility_type) :: fragility
      type(warnings_type) :: warnings
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      fragility%status = status
      fragility%theta = theta
      call warn_of_the_union(name, fragility, warnings)
      call warnings%put_objects(parcel%lines)
      call send(parcel, error, sent)
   end subroutine warn_of_union

end module curves
