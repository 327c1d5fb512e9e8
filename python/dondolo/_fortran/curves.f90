!> Fragility curves of walls and populations.
module curves
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use dondolo_base_error, only : error_type
   use dondolo_base_lines, only : lines_type
   use dondolo_base_student, only : quantile => student_quantile
   use dondolo_boundary, only : check_room, split_lines
   use dondolo_case_result_warnings, only : fit_warnings_type, warn_of_fit, warn_of_the_union => warn_of_union
   use dondolo_case_warning, only : warnings_type
   use dondolo_fragility, only : error_names, fit_fragility, fit_ok, fragility_type
   use dondolo_fragility_clustered, only : cluster_errors
   use dondolo_fragility_ordinal, only : ordinal_fit => fit_ordinal, ordinal_errors
   use dondolo_fragility_stripes, only : stripes_type
   use dondolo_interface_handles, only : find_walls
   use dondolo_parcel, only : parcel_type, report, send
   use dondolo_population, only : population_type
   use dondolo_population_series, only : series => in_series
   use dondolo_population_typology, only : combine_population, typology_type
   use dondolo_population_weights, only : weights_of, weights_type
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: fit_curves, cluster_curves, cluster_changes, fit_ordinal, probability, in_series, warn_of_curve, fit_walls
   public :: curve_of_population, student_quantile, warn_of_union

contains

   !> Fit k curves, each to m levels. A status of 0 is a fit that failed; the failure is that of the first that went wrong
   subroutine fit_curves(levels, collapses, histories, m, k, curves, statuses, failure)
      !f2py threadsafe
      integer(c_int), intent(in) :: m, k
      real(c_double), intent(in) :: levels(m), collapses(m, k), histories(m, k)
      real(c_double), intent(out) :: curves(8, k)
      integer(c_int), intent(out) :: statuses(k)
      integer(c_int64_t), intent(out) :: failure(5)
      type(fragility_type) :: curve
      type(error_type), allocatable :: error, first
      integer :: i, worst

      curves = 0
      statuses = 0
      call check_room(error, reals=40.0_c_double*m)
      call report(error, failure)
      if (allocated(error)) return
      worst = k + 1
      !$omp parallel do if(k > 1) default(none) private(curve, error) &
      !$omp & shared(k, levels, collapses, histories, curves, statuses, worst, first)
      do i = 1, k
         call fit_fragility(curve, levels, collapses(:, i), histories(:, i), error)
         if (allocated(error)) then
            !$omp critical (first_error)
            if (i < worst) then
               worst = i
               call move_alloc(error, first)
            end if
            !$omp end critical (first_error)
         else
            statuses(i) = curve%status
         end if
         curves(:, i) = pack_curve(curve)
      end do
      !$omp end parallel do
      call report(first, failure)
   end subroutine fit_curves

   !> Clustered covariances (var ln theta, covariance, var beta) of k fitted curves from the collapses and histories of each of
   !> g clusters at each of m levels; the histories are the same for all curves if h is 1, else h is k. errors are places among
   !> the names, and clusters count those that have histories
   subroutine cluster_curves(levels, collapses, histories, curves, statuses, m, g, k, h, covariances, errors, clusters, failure)
      !f2py threadsafe
      integer(c_int), intent(in) :: m, g, k, h, statuses(k)
      real(c_double), intent(in) :: levels(m), collapses(m, g, k), histories(m, g, h), curves(8, k)
      real(c_double), intent(out) :: covariances(3, k)
      integer(c_int), intent(out) :: errors(k), clusters(k)
      integer(c_int64_t), intent(out) :: failure(5)
      type(fragility_type) :: curve
      type(error_type), allocatable :: error
      real(c_double) :: changes(2, g)
      integer :: i

      covariances = 0
      errors = 0
      clusters = 0
      call check_room(error, reals=40.0_c_double*m)
      call report(error, failure)
      if (allocated(error)) return
      !$omp parallel do if(k > 1) default(none) private(curve, changes) &
      !$omp & shared(k, h, levels, collapses, histories, curves, statuses, covariances) &
      !$omp & shared(errors, clusters)
      do i = 1, k
         curve = fragility_type(status=statuses(i), theta=curves(1, i), beta=curves(2, i))
         call cluster_errors(curve, levels, collapses(:, :, i), histories(:, :, min(i, h)), changes)
         covariances(:, i) = [curve%covariance(1, 1), curve%covariance(1, 2), curve%covariance(2, 2)]
         errors(i) = findloc(error_names, curve%errors, dim=1)
         clusters(i) = curve%clusters
      end do
      !$omp end parallel do
   end subroutine cluster_curves

   !> Change of ln theta and beta of a fitted curve if each of g clusters is left out, to first order; errors as cluster_curves
   subroutine cluster_changes(levels, collapses, histories, theta, beta, m, g, changes, errors, failure)
      integer(c_int), intent(in) :: m, g
      real(c_double), intent(in) :: levels(m), collapses(m, g), histories(m, g), theta, beta
      real(c_double), intent(out) :: changes(2, g)
      integer(c_int), intent(out) :: errors
      integer(c_int64_t), intent(out) :: failure(5)
      type(fragility_type) :: curve
      type(error_type), allocatable :: error

      changes = 0
      errors = 0
      call check_room(error, reals=40.0_c_double*m)
      call report(error, failure)
      if (allocated(error)) return
      curve = fragility_type(status=fit_ok, theta=theta, beta=beta)
      call cluster_errors(curve, levels, collapses, histories, changes)
      errors = findloc(error_names, curve%errors, dim=1)
   end subroutine cluster_changes

   !> Curves of k damage states with one dispersion, from the histories of each of g clusters that reach each state at each of
   !> m levels; changes and errors are as cluster_changes has them
   subroutine fit_ordinal(levels, reached, histories, m, k, g, curves, statuses, changes, errors, failure)
      integer(c_int), intent(in) :: m, k, g
      real(c_double), intent(in) :: levels(m), reached(m, k, g), histories(m, g)
      real(c_double), intent(out) :: curves(8, k), changes(2, k, g)
      integer(c_int), intent(out) :: statuses(k), errors(k)
      integer(c_int64_t), intent(out) :: failure(5)
      type(fragility_type) :: curve(k)
      type(error_type), allocatable :: error
      integer :: i

      curves = 0
      changes = 0
      statuses = 0
      errors = 0
      call check_room(error, reals=8.0_c_double*m*(real(k, c_double)*g + g))
      if (.not. allocated(error)) call ordinal_fit(curve, levels, sum(reached, 3), sum(histories, 2), error)
      if (.not. allocated(error)) then
         do i = 1, k
            curves(:, i) = pack_curve(curve(i))
            statuses(i) = curve(i)%status
         end do
         call ordinal_errors(curve, levels, reached, histories, changes)
         errors = [(findloc(error_names, curve(i)%errors, dim=1), i=1, k)]
      end if
      call report(error, failure)
   end subroutine fit_ordinal

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

   !> Quantile of Student's t
   subroutine student_quantile(p, degrees, t)
      real(c_double), intent(in) :: p, degrees
      real(c_double), intent(out) :: t

      t = quantile(p, degrees)
   end subroutine student_quantile

   !> Probability that any mechanism of each wall happens, of k probabilities of each row; rows: how many each wall has
   subroutine in_series(p, k, r, rows, w, whole)
      !f2py threadsafe
      integer(c_int), intent(in) :: k, r, w, rows(w)
      real(c_double), intent(in) :: p(k, r)
      real(c_double), intent(out) :: whole(k, w)
      real(c_double) :: certain(r)
      integer :: i, first

      certain = 1
      first = 1
      do i = 1, w
         whole(:, i) = series(certain(:rows(i)), p(:, first:first + rows(i) - 1))
         first = first + rows(i)
      end do
   end subroutine in_series

   !> Warnings of the executable for the curve of one wall, or for walls = 0 of counts without a wall; numbers and status
   !> as fit_curves has them
   subroutine warn_of_curve(walls, levels, m, largest_edp, curve, status, sent)
      integer(c_int64_t), intent(in) :: walls
      integer(c_int), intent(in) :: m, status
      real(c_double), intent(in) :: levels(m), largest_edp, curve(8)
      integer(c_int64_t), intent(out) :: sent(5)
      type(wall_type), pointer :: list(:), wall
      type(stripes_type) :: stripes
      type(fragility_type) :: fragility
      type(warnings_type) :: warnings
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      wall => null()
      if (walls /= 0) call find_walls(walls, list, error)
      if (.not. allocated(error)) then
         if (walls /= 0) wall => list(1)
         fragility%status = status
         fragility%theta = curve(1)
         fragility%beta = curve(2)
         fragility%bracket = curve(7:8)
         stripes%levels = levels
         ! Of the responses the sentences need the largest only
         allocate (stripes%response(1, 1))
         stripes%response%edp = largest_edp
         call warn_of_fit(wall, stripes, fragility, warnings)
         call warnings%put_objects(parcel%lines)
      end if
      call send(parcel, error, sent)
   end subroutine warn_of_curve

   !> What the executable would warn of, of the curve of one facade or wall with several mechanisms; status as fit_curves has it
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

   !> Curves of rows (mechanisms of walls), of their walls and of the population. texts: mechanism and group of each row; names:
   !> of its wall; shares: weight and probability of occurrence of each row; rows: how many each wall has. Integers: number of
   !> the population's curves, statuses of the rows, of the walls and of the population's curves, and the number of walls in
   !> each of these; reals: numbers of the curves of the rows and of the walls, fractions of collapse of the walls, then for
   !> each of the population's curves weight, dispersions between walls and between records, share with a curve, saturation,
   !> histories, mean fractions, mean curve, fractiles (3 a level), numbers; text: group and mechanism of the population's
   !> curves, then warnings
   subroutine fit_walls(texts, names, levels, collapses, m, r, histories, shares, rows, w, sent)
      character(len=*), intent(in) :: texts, names
      integer(c_int), intent(in) :: m, r, w, collapses(m, r), histories(m, r), rows(w)
      real(c_double), intent(in) :: levels(m), shares(2, r)
      integer(c_int64_t), intent(out) :: sent(5)
      type(population_type) :: population
      type(typology_type), allocatable :: groups(:)
      type(fit_warnings_type) :: fits
      type(lines_type) :: words
      type(warnings_type) :: warnings
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      integer :: i

      call check_room(error, r + w, reals=16.0_c_double*m*(real(r, c_double) + w))
      if (.not. allocated(error)) call new_population(population, texts, levels, collapses, histories, shares, rows, error)
      if (.not. allocated(error)) call population%fit(error)
      if (.not. allocated(error)) call combine_population(groups, population, 1, error)
      if (.not. allocated(error)) then
         call split_lines(names, words)
         do i = 1, r
            call fits%look(population%curve(1, i), words%line(i)%text)
         end do
         parcel%integers = [size(groups), (population%curve(1, i)%status, i=1, r + w), &
            & (groups(i)%fit%status, i=1, size(groups)), (groups(i)%walls, i=1, size(groups))]
         parcel%reals = [(pack_curve(population%curve(1, i)), i=1, r + w), (population%fraction(r + i, 1), i=1, w), &
            & (groups(i)%weight, groups(i)%beta_walls, groups(i)%beta_records, groups(i)%fitted, &
            & groups(i)%saturation, groups(i)%histories, groups(i)%mean_fraction, groups(i)%mean_curve, groups(i)%fractile, &
            & pack_curve(groups(i)%fit), i=1, size(groups))]
         do i = 1, size(groups)
            call parcel%lines%add(groups(i)%group)
            call parcel%lines%add(groups(i)%mechanism)
         end do
         ! The number of one wall with several mechanisms is their union, of which warn_of_union says what there is to say.
         if (w == 1 .and. r > 1) then
            call fits%warn(groups(:0), warnings)
         else
            call fits%warn(groups, warnings)
         end if
         call warnings%put_objects(parcel%lines)
      end if
      call send(parcel, error, sent)
   end subroutine fit_walls

   !> A curve of a population at n levels x: its weighted mean, and its fractiles for k shares of the weight. curves and
   !> statuses are those of the rows; mechanism 'all': the walls as a whole; group: empty for the whole population. With
   !> probabilities = 1 a parcel has their number as integer and their probabilities as reals (rows or walls, n)
   subroutine curve_of_population(texts, levels, collapses, m, r, histories, shares, rows, w, curves, statuses, mechanism, group, &
         & x, n, q, k, probabilities, mean, fractiles, sent)
      character(len=*), intent(in) :: texts, mechanism, group
      integer(c_int), intent(in) :: m, r, w, n, k, probabilities, collapses(m, r), histories(m, r), rows(w), statuses(r)
      real(c_double), intent(in) :: levels(m), shares(2, r), curves(8, r), x(n), q(k)
      real(c_double), intent(out) :: mean(n), fractiles(k, n)
      integer(c_int64_t), intent(out) :: sent(5)
      ! Numbers that are held at a time: a few tens of MB
      integer, parameter :: most = 2000000
      type(population_type) :: population
      type(weights_type) :: weights
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      real(c_double), allocatable :: p(:, :), all(:, :)
      integer :: first, last, part

      mean = 0
      fractiles = 0
      call check_room(error, r + w, reals=real(most, c_double))
      if (.not. allocated(error)) call new_population(population, texts, levels, collapses, histories, shares, rows, error)
      if (.not. allocated(error)) then
         call set_curves(population, curves, statuses)
         weights = weights_of(population, population%part(mechanism, group))
         if (probabilities == 1) then
            call check_room(error, reals=4.0_c_double*real(size(weights%column), c_double)*n)
            if (.not. allocated(error)) allocate (all(size(weights%column), n))
         end if
      end if
      part = max(1, most/(r + w))
      do first = 1, n, part
         if (allocated(error)) exit
         last = min(first + part - 1, n)
         call population%probabilities(1, x(first:last), p, error, weights%column)
         if (allocated(error)) exit
         mean(first:last) = weights%mean(p)
         fractiles(:, first:last) = weights%fractiles(p, q)
         if (probabilities == 1) all(:, first:last) = transpose(p(:, weights%column))
      end do
      if (.not. allocated(error) .and. probabilities == 1) then
         parcel%integers = [size(weights%column)]
         parcel%reals = reshape(all, [size(all)])
      end if
      call send(parcel, error, sent)
   end subroutine curve_of_population

   !> A population with the counts of one damage state, without curves
   subroutine new_population(population, texts, levels, collapses, histories, shares, rows, error)
      !> The population
      type(population_type), intent(out) :: population
      !> Two lines a row: mechanism and group
      character(len=*), intent(in) :: texts
      !> Levels of intensity
      real(c_double), intent(in) :: levels(:)
      !> Histories that reach the state (levels, rows)
      integer(c_int), intent(in) :: collapses(:, :)
      !> Histories of each stripe (levels, rows)
      integer(c_int), intent(in) :: histories(:, :)
      !> Weight of the wall and probability that the mechanism can occur (2, rows)
      real(c_double), intent(in) :: shares(:, :)
      !> How many rows each wall has
      integer(c_int), intent(in) :: rows(:)
      !> Lack of memory
      type(error_type), allocatable, intent(out) :: error

      type(lines_type) :: words
      integer :: i, k, row

      call split_lines(texts, words)
      row = 0
      do i = 1, size(rows)
         do k = 1, rows(i)
            row = row + 1
            call population%add(words%line(2*row - 1)%text, words%line(2*row)%text, shares(1, row), shares(2, row), k > 1)
         end do
      end do
      call population%begin(levels, 1, error)
      if (allocated(error)) return
      population%histories = histories
      population%reached(:, 1, :) = collapses
   end subroutine new_population

   !> Set the curves of the rows of a population: those that were fitted to it before
   subroutine set_curves(population, curves, statuses)
      !> The population
      type(population_type), intent(inout) :: population
      !> Their numbers, of which theta and beta come first (8, rows)
      real(c_double), intent(in) :: curves(:, :)
      !> Places of their statuses among the names
      integer(c_int), intent(in) :: statuses(:)

      integer :: i

      do i = 1, size(statuses)
         population%curve(1, i)%status = statuses(i)
         population%curve(1, i)%theta = curves(1, i)
         population%curve(1, i)%beta = curves(2, i)
      end do
   end subroutine set_curves

   !> A curve as flat numbers: theta, beta, var ln theta, covariance, var beta, log likelihood, bracket
   pure function pack_curve(curve) result(numbers)
      !> The curve
      type(fragility_type), intent(in) :: curve
      !> Its numbers
      real(c_double) :: numbers(8)

      numbers = [curve%theta, curve%beta, curve%covariance(1, 1), curve%covariance(1, 2), curve%covariance(2, 2), &
         & curve%log_likelihood, curve%bracket]
   end function pack_curve

end module curves
