!> The curves of a population out of what its stores hold (docs/theory.md, section 6).
module dondolo_combine_rows
   use dondolo_case, only : case_type
   use dondolo_clustered, only : cluster_errors
   use dondolo_designs, only : compare_designs
   use dondolo_error, only : error_type
   use dondolo_kinds, only : wp
   use dondolo_member, only : member_type
   use dondolo_population_errors, only : population_errors_type
   use dondolo_results, only : results_type, shown_rows
   use dondolo_row_result, only : row_result_type
   use dondolo_rows_again, only : rows_again_type
   use dondolo_sensitivity, only : new_sensitivity
   use dondolo_study, only : runs_of, study_type
   use dondolo_typology, only : combine_population, typology_type
   use dondolo_unite_rows, only : unite_rows
   use dondolo_warnings, only : fit_warning_type, warn_of_events, warn_of_records, warn_of_union
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
      type(fit_warning_type) :: fits
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
      call set_errors(results, study, error)
      if (.not. allocated(error)) call look_at_rows(case, results, fits, error)
      if (.not. allocated(error)) call unite_rows(case, results, study, error)
      if (allocated(error)) return
      if (case%designs) call compare_designs(results%designs)
      if (allocated(case%uncertainty)) call find_sensitivity(case, results)
      call case%survey%oddities%warn(results%warnings)
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
   subroutine find_sensitivity(case, results)
      type(case_type), intent(in) :: case
      !> Its results: the curves are there; the indices are set
      type(results_type), intent(inout) :: results

      type(error_type), allocatable :: error
      logical, allocatable :: fitted(:)
      integer :: n, k, i

      n = case%facade%samples
      associate (curves => results%population%curve(size(case%stripes%thresholds), :n), values => case%facade%values)
         fitted = [(curves(i)%has_fit(), i=1, n)]
         allocate (results%sensitivity)
         call new_sensitivity(results%sensitivity, reshape([(pack(values(k, :n), fitted), k=1, size(values, 1))], &
            & [count(fitted), size(values, 1)]), log(pack(curves%theta, fitted)), error)
      end associate
      if (.not. allocated(error)) return
      deallocate (results%sensitivity)
      results%no_sensitivity = error%message
   end subroutine find_sensitivity

   !> Counts of all rows
   subroutine gather(results, share, error)
      !> Results: the counts of the population are set
      type(results_type), intent(inout) :: results
      !> Share of the records that run at each level
      real(wp), intent(in) :: share(:)
      !> A store has changed
      type(error_type), allocatable, intent(out) :: error

      type(row_result_type) :: row
      integer :: i, k

      do k = 1, size(results%stores)
         associate (store => results%stores(k), population => results%population)
            do i = store%identity%first, store%identity%last
               call store%read(i, row, error)
               if (allocated(error)) exit
               population%histories(:, i) = nint(real(row%histories, wp)*share)
               population%reached(:, :, i) = count(row%flags, dim=1)
            end do
            call store%close()
            if (allocated(error)) return
         end associate
      end do
   end subroutine gather

   !> Set the clustered standard errors of the curves of the rows and of the population
   subroutine set_errors(results, study, error)
      !> Results: the population and its curves are there
      type(results_type), intent(inout) :: results
      type(study_type), intent(in) :: study
      !> A store has changed
      type(error_type), allocatable, intent(out) :: error

      type(row_result_type) :: row
      type(population_errors_type) :: sums
      real(wp), dimension(size(study%levels), maxval(study%suite%clusters)) :: histories, part
      real(wp), allocatable :: counts(:, :, :, :)
      real(wp) :: changes(2, maxval(study%suite%clusters))
      logical :: runs(size(study%suite%clusters), size(study%levels))
      integer :: g, i, j, k, state, wall

      part = 0.0_wp
      runs = runs_of(study)
      do j = 1, size(runs, 2)
         do i = 1, size(runs, 1)
            g = study%suite%clusters(i)
            if (runs(i, j)) part(j, g) = part(j, g) + 1.0_wp/real(size(runs, 1), wp)
         end do
      end do
      associate (population => results%population)
         call sums%begin(results%typologies, population, part, error)
         if (allocated(error)) return
         wall = 1
         do k = 1, size(results%stores)
            do i = results%stores(k)%identity%first, results%stores(k)%identity%last
               call results%stores(k)%read(i, row, error)
               if (allocated(error)) exit
               if (i == population%first(wall)) then
                  if (allocated(counts)) deallocate (counts)
                  allocate (counts(size(part, 1), size(part, 2), size(population%curve, 1), &
                     & population%first(wall + 1) - population%first(wall)))
               end if
               do state = 1, size(population%curve, 1)
                  associate (own => counts(:, :, state, i - population%first(wall) + 1))
                     call row%by_cluster(state, study%suite%clusters, runs, own, histories)
                     call cluster_errors(population%curve(state, i), population%levels, own, histories, changes)
                     own = own/real(row%histories, wp)
                  end associate
                  if (.not. allocated(results%designs) .or. state < size(population%curve, 1)) cycle
                  results%designs(i)%curve = population%curve(state, i)
                  results%designs(i)%change = changes(1, :)
               end do
               if (i + 1 < population%first(wall + 1)) cycle
               call sums%add(population, wall, counts)
               wall = wall + 1
            end do
            call results%stores(k)%close()
            if (allocated(error)) return
         end do
         call sums%finish(results%typologies)
      end associate
   end subroutine set_errors

   !> Go through the rows and their names: what there is to say of the curves, and those that are shown
   subroutine look_at_rows(case, results, fits, error)
      type(case_type), intent(in) :: case
      !> Its results: the rows that are shown are set
      type(results_type), intent(inout) :: results
      !> What there is to say of the curves
      type(fit_warning_type), intent(inout) :: fits
      !> The table has changed
      type(error_type), allocatable, intent(out) :: error

      type(rows_again_type) :: rows
      type(member_type) :: member
      integer :: i

      allocate (results%shown(min(shown_rows, case%survey%rows)))
      call rows%open(case, error)
      do i = 1, case%survey%rows
         call rows%next(member, error)
         if (allocated(error)) exit
         associate (curve => results%population%curve(size(case%stripes%thresholds), i))
            call fits%look(curve, member%wall%name())
            if (case%designs) call results%designs(i)%take_wall(member%wall)
            if (i > shown_rows) cycle
            results%shown(i)%name = member%wall%name()
            results%shown(i)%mechanism = member%wall%mechanism_name()
            results%shown(i)%curve = curve
         end associate
      end do
      call rows%close()
   end subroutine look_at_rows

end module dondolo_combine_rows
