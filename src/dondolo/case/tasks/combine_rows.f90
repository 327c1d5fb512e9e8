!> The curves of a population out of what its stores hold (docs/theory.md, section 6).
module dondolo_case_combine_rows
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_memory, only : check_room
   use dondolo_case, only : case_type
   use dondolo_case_motion_warnings, only : warn_of_events, warn_of_records
   use dondolo_case_result_warnings, only : fit_warnings_type, warn_of_union
   use dondolo_case_results, only : results_type, shown_rows
   use dondolo_fragility_clustered, only : cluster_errors
   use dondolo_fragility_study, only : runs_of, study_type
   use dondolo_population_designs, only : compare_designs
   use dondolo_population_errors, only : population_errors_type
   use dondolo_population_reader, only : population_reader_type
   use dondolo_population_row_result, only : row_result_type
   use dondolo_population_sensitivity, only : new_sensitivity
   use dondolo_population_store, only : read_result
   use dondolo_population_typology, only : combine_population, typology_type
   use dondolo_population_unions, only : mean_unions, union_builder_type, union_type, wall_union
   use dondolo_population_wall_row, only : wall_row_type
   implicit none
   private

   public :: combine_rows

contains

   !> Curves of the population, and what there is to warn of
   subroutine combine_rows(case, results, error)
      type(case_type), intent(in), target :: case
      !> Its results: the stores are there; counts, curves and warnings are set
      type(results_type), intent(inout) :: results
      !> What cannot be combined
      type(error_type), allocatable, intent(out) :: error

      type(study_type) :: study
      type(typology_type), allocatable :: typologies(:)
      type(fit_warnings_type) :: fits
      integer :: k, states

      states = size(case%stripes%thresholds)
      results%population = case%survey%population
      call results%population%begin(case%stripes%levels, states, error)
      call case%make_study(study)
      if (.not. allocated(error)) call gather(results, study%share(), error)
      if (.not. allocated(error)) call results%population%fit(error)
      if (allocated(error)) return
      ! Designs are alternatives: nothing is a mean over them.
      if (case%designs) allocate (results%typologies(0, states))
      do k = 1, merge(0, states, case%designs)
         call combine_population(typologies, results%population, k, error)
         if (allocated(error)) return
         if (k == 1) allocate (results%typologies(size(typologies), states))
         results%typologies(:, k) = typologies
      end do
      if (case%designs) allocate (results%designs(results%population%rows))
      call look_at_rows(case, results, study, fits, error)
      if (allocated(error)) return
      if (case%designs) call compare_designs(results%designs)
      if (allocated(case%uncertainty)) call compute_sensitivity(case, results)
      call case%survey%wall_warnings%warn(results%warnings)
      call warn_of_records(case%suite, case%solver%gravity, results%warnings)
      call warn_of_events(case%suite, results%warnings)
      call case%survey%scales%warn(results%warnings)
      if (results%population%walls == 1 .and. results%unions%count() > 0) then
         ! The number of one facade is its union.
         call fits%warn(results%typologies(:0, states), results%warnings)
         call warn_of_union(results%unions%name(1)%text, results%unions%curve(states, 1), results%warnings)
      else
         call fits%warn(results%typologies(:, states), results%warnings)
      end if
   end subroutine combine_rows

   !> What the scatter of the medians of a wall with variants is owed to
   subroutine compute_sensitivity(case, results)
      type(case_type), intent(in) :: case
      !> Its results: the curves are there; the indices are set
      type(results_type), intent(inout) :: results

      type(error_type), allocatable :: error
      logical, allocatable :: fitted(:)
      integer :: n, k, i

      n = case%table%base_wall%samples
      associate (curves => results%population%curve(size(case%stripes%thresholds), :n), values => case%table%base_wall%values)
         fitted = [(curves(i)%has_fit(), i=1, n)]
         allocate (results%sensitivity)
         call new_sensitivity(results%sensitivity, reshape([(pack(values(k, :n), fitted), k=1, size(values, 1))], &
            & [count(fitted), size(values, 1)]), log(pack(curves%theta, fitted)), error)
      end associate
      if (.not. allocated(error)) return
      deallocate (results%sensitivity)
      results%no_sensitivity = error%message
   end subroutine compute_sensitivity

   !> Counts of all rows
   subroutine gather(results, share, error)
      !> Results: the counts of the population are set
      type(results_type), intent(inout) :: results
      !> Share of the records that run at each level
      real(wp), intent(in) :: share(:)
      !> A store has changed
      type(error_type), allocatable, intent(out) :: error

      type(row_result_type) :: outcome
      integer :: i

      associate (population => results%population)
         do i = 1, population%rows
            call read_result(results%stores, i, outcome, error)
            if (allocated(error)) exit
            population%histories(:, i) = nint(real(outcome%histories, wp)*share)
            population%reached(:, :, i) = count(outcome%flags, dim=1)
         end do
      end associate
      call results%stores%close()
   end subroutine gather

   !> Go through the rows with all that is known of each: standard errors of the curves of rows, walls and population,
   !> unions of the walls with several mechanisms, what there is to say of the curves, and the rows that are shown
   subroutine look_at_rows(case, results, study, fits, error)
      type(case_type), intent(in) :: case
      !> Its results: the population and its curves are there
      type(results_type), intent(inout) :: results
      type(study_type), intent(in) :: study
      !> What there is to say of the curves
      type(fit_warnings_type), intent(inout) :: fits
      !> A store has changed, counts that cannot be fitted, or lack of memory
      type(error_type), allocatable, intent(out) :: error

      type(population_reader_type) :: reader
      type(wall_row_type) :: row
      type(row_result_type) :: outcome
      type(population_errors_type) :: errors
      type(union_builder_type) :: builder
      type(union_type) :: union
      character(len=:), allocatable :: name
      real(wp), allocatable :: counts(:, :, :, :)
      real(wp) :: share(size(study%levels), maxval(study%suite%clusters))
      logical :: runs(size(study%suite%clusters), size(study%levels)), found
      integer :: i, states, wall, united, rows(2)

      runs = runs_of(study)
      call share_clusters(study%suite%clusters, runs, share)
      states = size(case%stripes%thresholds)
      allocate (results%shown(min(shown_rows, case%survey%rows)))
      associate (population => results%population)
         united = count(population%is_several([(i, i=1, population%walls)]))
         call check_room(real(size(study%levels)*8, wp)*(real(2*united, wp)*real(states + 1, wp) &
            & + real(population%rows + population%walls, wp)), error)
         if (.not. allocated(error)) call errors%begin(results%typologies, population, share, error)
         if (allocated(error)) return
         if (united > 0) call results%unions%reserve(united, size(study%levels), states)
         reader%names%is_checked = .false.
         united = 0
         do i = 1, population%rows
            call reader%next(case%table, row, found, error)
            if (.not. allocated(error)) call read_result(results%stores, i, outcome, error)
            if (allocated(error)) exit
            wall = population%row(i)%wall
            rows = population%rows_of(population%rows + wall)
            if (i == rows(1)) then
               name = row%wall%name()
               if (len(row%facade) > 0) name = row%facade
               if (allocated(counts)) deallocate (counts)
               allocate (counts(size(share, 1), size(share, 2), states, rows(2) - rows(1) + 1))
            end if
            call count_clusters(results, outcome, study%suite%clusters, runs, counts(:, :, :, i - rows(1) + 1))
            associate (curve => population%curve(states, i))
               call fits%look(curve, row%wall%name())
               if (case%designs) call results%designs(i)%take_wall(row%wall)
               if (i <= shown_rows) then
                  results%shown(i)%name = row%wall%name()
                  results%shown(i)%mechanism = row%wall%mechanism_name()
                  results%shown(i)%curve = curve
               end if
            end associate
            if (population%is_several(wall)) call builder%add(outcome, population%row(i)%p_occ)
            if (i < rows(2)) cycle
            call errors%add(population, wall, counts)
            if (.not. population%is_several(wall)) cycle
            united = united + 1
            call wall_union(union, builder, population, wall, study%suite%clusters, runs, error)
            if (allocated(error)) exit
            union%name = name
            call results%unions%keep(united, wall, union)
            deallocate (builder%survival)
         end do
         call results%stores%close()
         if (allocated(error)) return
         call errors%finish(results%typologies)
         if (united > 0) call mean_unions(results%unions, population, results%typologies, error)
      end associate
   end subroutine look_at_rows

   !> Share of all records that each cluster has and that run at each level
   pure subroutine share_clusters(clusters, runs, share)
      !> Number of the cluster of each record
      integer, intent(in) :: clusters(:)
      !> Whether a record runs at a level (records, levels)
      logical, intent(in) :: runs(:, :)
      !> Shares (levels, clusters)
      real(wp), intent(out) :: share(:, :)

      integer :: i, j

      share = 0.0_wp
      do j = 1, size(runs, 2)
         do i = 1, size(runs, 1)
            associate (g => clusters(i))
               if (runs(i, j)) share(j, g) = share(j, g) + 1.0_wp/real(size(runs, 1), wp)
            end associate
         end do
      end do
   end subroutine share_clusters

   !> Count the histories of a row by clusters of records, and set the clustered standard errors of its curves
   subroutine count_clusters(results, outcome, clusters, runs, counts)
      !> Results: the errors of the row are set, and of a design its curve
      type(results_type), intent(inout) :: results
      !> What came of a row
      type(row_result_type), intent(in) :: outcome
      !> Number of the cluster of each record
      integer, intent(in) :: clusters(:)
      !> Whether a record runs at a level (records, levels)
      logical, intent(in) :: runs(:, :)
      !> Histories of each cluster that reach each state, over all records (levels, clusters, states)
      real(wp), intent(out) :: counts(:, :, :)

      real(wp) :: histories(size(counts, 1), size(counts, 2)), changes(2, size(counts, 2))
      integer :: k

      associate (curves => results%population%curve(:, outcome%row))
         do k = 1, size(counts, 3)
            call outcome%by_cluster(k, clusters, runs, counts(:, :, k), histories)
            call cluster_errors(curves(k), results%population%levels, counts(:, :, k), histories, changes)
            counts(:, :, k) = counts(:, :, k)/real(outcome%histories, wp)
         end do
         if (.not. allocated(results%designs)) return
         results%designs(outcome%row)%curve = curves(size(curves))
         results%designs(outcome%row)%change = changes(1, :)
      end associate
   end subroutine count_clusters

end module dondolo_case_combine_rows
