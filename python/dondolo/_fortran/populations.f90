!> Curves of populations.
module populations
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_error, only : error_type
   use dondolo_base_lines, only : lines_type
   use dondolo_base_warning, only : warnings_type
   use dondolo_boundary, only : check_room, split_lines
   use dondolo_case_occurrence_warnings, only : occurrence_warnings_type
   use dondolo_case_result_warnings, only : fit_warnings_type, warn_of_union
   use dondolo_curve_parcel, only : put_curves
   use dondolo_parcel, only : parcel_type, send
   use dondolo_population, only : population_type
   use dondolo_population_curves, only : population_curves_type
   use dondolo_population_errors, only : curve_sums_type
   use dondolo_population_row_result, only : bytes_of_flags, row_result_type, shape_type, unpack_flags
   use dondolo_population_typology, only : combine_population, typology_type
   use dondolo_population_weights, only : weights_type
   implicit none
   private

   public :: fit_population, curve_of_population, warn_of_occurrence

contains

   !> Curves of rows (mechanisms of walls), of their walls and of the population in a damage state. texts: mechanism and group
   !> of each row; names: of its wall, and of its wall or facade as a whole; shares: weight and probability of occurrence of
   !> each row; alternative: its number, as dondolo_population_occurrence has it; rows: how many each wall has. With flags:
   !> sizes are the histories of a stripe of each row in which every record runs, bits the flags of all rows, eight a byte and
   !> four bytes an integer, each row from a byte of its own on; clusters has the number of the cluster of each record, runs is
   !> 1 where a record runs at a level; there are `states` of them, and state is the one that is asked for. Without flags
   !> (states = 0) standard errors are naive, and there are no unions. designs = 1: nothing is a mean over the walls. All that
   !> is sent is named: curves of rows and of walls (row_*, wall_*, as put_curves has them), fractions of walls, curves of the
   !> population (group, mechanism, n_walls ... and fit_*), unions (union_*) and their means (mean_*), and warnings
   subroutine fit_population(texts, names, levels, collapses, m, r, histories, shares, alternative, rows, w, designs, states, &
         & state, sizes, bits, b, clusters, runs, c, sent)
      !f2py threadsafe
      character(len=*), intent(in) :: texts, names
      integer(c_int), intent(in) :: m, r, w, b, c, designs, states, state, sizes(r), bits(b), clusters(c), runs(c, m)
      integer(c_int), intent(in) :: collapses(m, r), histories(m, r), alternative(r), rows(w)
      real(c_double), intent(in) :: levels(m), shares(2, r)
      integer(c_int64_t), intent(out) :: sent(5)
      type(population_type) :: population
      type(population_curves_type), allocatable :: curves
      type(typology_type), allocatable :: groups(:)
      type(lines_type) :: words
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      ! On the heap: stacks may be small.
      allocate (curves)
      call check_room(error, r + w, reals=16.0_c_double*m*(real(r, c_double) + w))
      if (.not. allocated(error)) call new_population(population, texts, levels, collapses, histories, shares, &
         & alternative, rows, error)
      if (.not. allocated(error)) call population%fit(error)
      call split_lines(names, words)
      if (.not. allocated(error) .and. states > 0) call add_flags(curves, population, words, designs == 1, &
         & shape_type(m, states), state, sizes, bits, clusters, runs == 1, error)
      if (.not. allocated(error) .and. states == 0 .and. designs == 0) then
         call combine_population(groups, population, 1, error)
         if (.not. allocated(error)) curves%typologies = reshape(groups, [size(groups), 1])
      end if
      if (.not. allocated(error)) then
         if (.not. allocated(curves%typologies)) allocate (curves%typologies(0, 1))
         call put_curves(parcel, 'row_', population%curve(1, :r))
         call put_curves(parcel, 'wall_', population%curve(1, population%place_of_wall))
         call put_fractions(parcel, population)
         call put_groups(parcel, curves%typologies(:, 1))
         if (states > 0) call put_changes(parcel, 'fit_', curves%errors%curve(:, 1))
         if (states > 0) call put_unions(parcel, curves)
         call put_warnings(parcel, population, curves, words)
      end if
      call send(parcel, error, sent)
   end subroutine fit_population

   !> Set the standard errors of curves, and count unions, from the flags of all rows
   subroutine add_flags(curves, population, names, are_alternatives, shape, state, sizes, bits, clusters, runs, error)
      type(population_curves_type), intent(out) :: curves
      !> The population, fitted
      type(population_type), intent(inout) :: population
      !> Of each row two names, the second that of its wall or facade as a whole
      type(lines_type), intent(in) :: names
      !> Is nothing a mean over the walls?
      logical, intent(in) :: are_alternatives
      !> How many levels and states the flags are of
      type(shape_type), intent(in) :: shape
      !> The state that is asked for
      integer, intent(in) :: state
      !> Histories of a stripe of each row
      integer(c_int), intent(in) :: sizes(:)
      !> Flags, eight a byte, four bytes an integer
      integer(c_int), intent(in) :: bits(:)
      !> Number of the cluster of each record
      integer(c_int), intent(in) :: clusters(:)
      !> Whether a record runs at a level (records, levels)
      logical, intent(in) :: runs(:, :)
      !> Counts that cannot be fitted, or lack of memory
      type(error_type), allocatable, intent(out) :: error

      type(row_result_type) :: row
      character(len=:), allocatable :: bytes
      real(c_double) :: change(2, maxval(clusters))
      integer(int64) :: at, length
      integer :: i

      call curves%begin(population, clusters, runs, are_alternatives, .true., error)
      allocate (character(len=4*size(bits, kind=int64)) :: bytes)
      bytes = transfer(bits, bytes)
      at = 0
      do i = 1, size(sizes)
         if (allocated(error)) return
         row%row = i
         row%histories = sizes(i)
         length = bytes_of_flags(shape, row%histories)
         if (allocated(row%flags)) deallocate (row%flags)
         allocate (row%flags(row%histories, shape%levels, shape%states))
         call unpack_flags(bytes(at + 1:at + length), row%flags)
         at = at + length
         row%flags = row%flags(:, :, state:state)
         call curves%add(row, names%line(2*i)%text, population, change, error)
      end do
      if (.not. allocated(error)) call curves%finish(population, error)
   end subroutine add_flags

   !> Put in of each wall its fractions and its histories (levels, walls), and the probability that it can collapse
   subroutine put_fractions(parcel, population)
      type(parcel_type), intent(inout) :: parcel
      !> The population, fitted
      type(population_type), intent(in) :: population

      integer :: i, m, columns(population%walls)

      m = size(population%levels)
      columns = [(population%rows + i, i=1, population%walls)]
      call parcel%put('wall_fraction', [(population%fraction(columns(i), 1), i=1, population%walls)], [m, population%walls])
      call parcel%put('wall_histories', [(real(population%histories_of(columns(i)), c_double), i=1, population%walls)], &
         & [m, population%walls])
      call parcel%put('wall_upper_asymptote', [(population%occurrence(columns(i)), i=1, population%walls)])
   end subroutine put_fractions

   !> Put curves of the population in
   subroutine put_groups(parcel, groups)
      type(parcel_type), intent(inout) :: parcel
      type(typology_type), intent(in) :: groups(:)

      type(lines_type) :: group, mechanism
      integer :: i, m, n

      n = size(groups)
      m = 0
      if (n > 0) m = size(groups(1)%levels)
      do i = 1, n
         call group%add(groups(i)%group)
         call mechanism%add(groups(i)%mechanism)
      end do
      call parcel%put('group', group)
      call parcel%put('mechanism', mechanism)
      call parcel%put('n_walls', int(groups%walls, c_int))
      call parcel%put('weight', groups%weight)
      call parcel%put('beta_walls', groups%beta_walls)
      call parcel%put('beta_records', groups%beta_records)
      call parcel%put('fitted', groups%fitted)
      call parcel%put('upper_asymptote', groups%upper_asymptote)
      call parcel%put('histories', [(groups(i)%histories, i=1, n)], [m, n])
      call parcel%put('mean_fraction', [(groups(i)%mean_fraction, i=1, n)], [m, n])
      call parcel%put('mean_curve', [(groups(i)%mean_curve, i=1, n)], [m, n])
      call parcel%put('level_fractiles', [(transpose(groups(i)%fractile), i=1, n)], [m, 3, n])
      call put_curves(parcel, 'fit_', groups%fit)
   end subroutine put_groups

   !> Put in by how much curves change if each cluster of records, or each wall, is left out: of a curve after the other
   subroutine put_changes(parcel, prefix, sums)
      type(parcel_type), intent(inout) :: parcel
      !> What the names begin with
      character(len=*), intent(in) :: prefix
      type(curve_sums_type), intent(in) :: sums(:)

      integer :: i

      call parcel%put(prefix//'walls', [(int(size(sums(i)%wall_change, 2), c_int), i=1, size(sums))])
      call parcel%put(prefix//'record_change', [(sums(i)%record_change, i=1, size(sums))], &
         & [2, sum([(size(sums(i)%record_change, 2), i=1, size(sums))])])
      call parcel%put(prefix//'wall_change', [(sums(i)%wall_change, i=1, size(sums))], &
         & [2, sum([(size(sums(i)%wall_change, 2), i=1, size(sums))])])
   end subroutine put_changes

   !> Put in unions of walls with several mechanisms, in the order of walls, and their means
   subroutine put_unions(parcel, curves)
      type(parcel_type), intent(inout) :: parcel
      type(population_curves_type), intent(in) :: curves

      type(lines_type) :: group
      integer :: i, m, n

      n = 0
      if (allocated(curves%unions%mean)) n = size(curves%unions%mean)
      m = size(curves%errors%levels)
      associate (unions => curves%unions)
         call parcel%put('unions', curves%unions%count() - n)
         if (unions%count() == 0) return
         call parcel%put('union_histories', [unions%histories], shape(unions%histories))
         call parcel%put('union_collapses', [unions%collapses(:, 1, :)], shape(unions%histories))
         call parcel%put('union_change', [unions%change(:, :, 1, :)], shape(unions%change(:, :, 1, :)))
         call put_curves(parcel, 'union_', unions%curve(1, :))
         do i = 1, n
            call group%add(unions%mean(i)%group)
         end do
         call parcel%put('mean_group', group)
         call parcel%put('mean_histories', [(unions%mean(i)%histories, i=1, n)], [m, n])
         call parcel%put('mean_upper_asymptote', [(unions%mean(i)%upper_asymptote, i=1, n)])
         call parcel%put('mean_union_fraction', [(unions%mean(i)%fraction(:, 1), i=1, n)], [m, n])
         call put_curves(parcel, 'mean_', [(unions%mean(i)%curve(1), i=1, n)])
         call put_changes(parcel, 'mean_', curves%errors%mean(:, 1))
      end associate
   end subroutine put_unions

   !> Put in what there is to warn of
   subroutine put_warnings(parcel, population, curves, names)
      type(parcel_type), intent(inout) :: parcel
      type(population_type), intent(in) :: population
      type(population_curves_type), intent(in) :: curves
      !> Of each row two names, the second that of its wall or facade as a whole
      type(lines_type), intent(in) :: names

      type(fit_warnings_type) :: fits
      type(warnings_type) :: warnings
      type(lines_type) :: lines
      integer :: i

      do i = 1, population%rows
         call fits%look(population%curve(1, i), names%line(2*i - 1)%text)
      end do
      if (population%walls == 1 .and. population%rows > 1) then
         ! The number of one facade is its union.
         call fits%warn(curves%typologies(:0, 1), warnings)
         if (curves%unions%count() > 0) call warn_of_union(names%line(2)%text, curves%unions%curve(1, 1), warnings)
      else
         call fits%warn(curves%typologies(:, 1), warnings)
      end if
      call warnings%put_objects(lines)
      call parcel%put('warnings', lines)
   end subroutine put_warnings

   !> A curve of a population at n levels x: its weighted mean, and its fractiles for k shares of the weight. curves and
   !> statuses are those of the rows; mechanism 'all': the walls as a whole; group: empty for the whole population. With
   !> probabilities = 1 a parcel has their probabilities (rows or walls, n)
   subroutine curve_of_population(texts, levels, collapses, m, r, histories, shares, alternative, rows, w, mechanism, group, x, n, &
         & q, k, probabilities, theta, beta, statuses, mean, fractiles, sent)
      character(len=*), intent(in) :: texts, mechanism, group
      integer(c_int), intent(in) :: m, r, w, n, k, probabilities, collapses(m, r), histories(m, r), alternative(r), rows(w)
      integer(c_int), intent(in) :: statuses(r)
      real(c_double), intent(in) :: levels(m), shares(2, r), theta(r), beta(r), x(n), q(k)
      real(c_double), intent(out) :: mean(n), fractiles(k, n)
      integer(c_int64_t), intent(out) :: sent(5)
      type(population_type) :: population
      type(weights_type) :: weights
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      real(c_double), allocatable :: p(:, :), all(:, :)
      integer :: first, last

      mean = 0
      fractiles = 0
      call check_room(error, r + w)
      if (.not. allocated(error)) call new_population(population, texts, levels, collapses, histories, shares, &
         & alternative, rows, error)
      if (.not. allocated(error)) then
         call set_curves(population, theta, beta, statuses)
         call weights%take(population, population%part(mechanism, group))
         if (probabilities == 1) then
            call check_room(error, reals=4.0_c_double*real(size(weights%column), c_double)*n)
            if (.not. allocated(error)) allocate (all(size(weights%column), n))
         end if
      end if
      first = 1
      do while (first <= n .and. .not. allocated(error))
         last = min(first + weights%levels_at_a_time() - 1, n)
         call population%probabilities(1, weights%column, x(first:last), p, error)
         if (allocated(error)) exit
         mean(first:last) = weights%mean(p)
         fractiles(:, first:last) = weights%fractiles(p, q)
         if (probabilities == 1) all(:, first:last) = p
         first = last + 1
      end do
      if (.not. allocated(error) .and. probabilities == 1) then
         call parcel%put('probabilities', reshape(all, [size(all)]), shape(all))
      end if
      call send(parcel, error, sent)
   end subroutine curve_of_population

   !> Warnings of the executable for the probabilities that mechanisms can occur: of r rows with the names of their walls or
   !> facades, a line each; rows: how many each wall has
   subroutine warn_of_occurrence(names, p_occ, alternative, r, rows, w, sent)
      character(len=*), intent(in) :: names
      integer(c_int), intent(in) :: r, w, alternative(r), rows(w)
      real(c_double), intent(in) :: p_occ(r)
      integer(c_int64_t), intent(out) :: sent(5)
      type(occurrence_warnings_type) :: looked
      type(warnings_type) :: warnings
      type(lines_type) :: lines
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      integer :: i, k, row

      call split_lines(names, lines)
      row = 0
      do i = 1, w
         do k = 1, rows(i)
            row = row + 1
            call looked%look_at(lines%line(row)%text, p_occ(row), alternative(row), k > 1)
         end do
      end do
      call looked%warn(warnings)
      call warnings%put_objects(parcel%lines)
      call send(parcel, error, sent)
   end subroutine warn_of_occurrence

   !> A population with the counts of one damage state, without curves
   subroutine new_population(population, texts, levels, collapses, histories, shares, alternative, rows, error)
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
      !> Number of the alternative of each row
      integer(c_int), intent(in) :: alternative(:)
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
            call population%add(words%line(2*row - 1)%text, words%line(2*row)%text, shares(1, row), shares(2, row), &
               & alternative(row), k > 1)
         end do
      end do
      call population%begin(levels, 1, error)
      if (allocated(error)) return
      population%histories = histories
      population%reached(:, 1, :) = collapses
   end subroutine new_population

   !> Set the curves of the rows of a population: those that were fitted to it before
   subroutine set_curves(population, theta, beta, statuses)
      !> The population
      type(population_type), intent(inout) :: population
      !> Their medians and dispersions
      real(c_double), intent(in) :: theta(:), beta(:)
      !> Places of their statuses among the names
      integer(c_int), intent(in) :: statuses(:)

      integer :: i

      do i = 1, size(statuses)
         population%curve(1, i)%status = statuses(i)
         population%curve(1, i)%theta = theta(i)
         population%curve(1, i)%beta = beta(i)
      end do
   end subroutine set_curves

end module populations
