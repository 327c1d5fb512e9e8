!> The curves of a population out of what its stores hold (docs/theory.md, section 6).
module dondolo_combine_rows
   use dondolo_case, only : case_type
   use dondolo_clustered, only : cluster_errors
   use dondolo_error, only : error_type, raise_failure
   use dondolo_kinds, only : wp
   use dondolo_memory, only : check_room
   use dondolo_population, only : member_type, population_reader_type
   use dondolo_population_counts, only : new_population_counts
   use dondolo_results, only : results_type, shown_rows
   use dondolo_row_result, only : row_result_type
   use dondolo_study, only : study_type
   use dondolo_typology, only : combine_population, typology_type
   use dondolo_unions, only : mean_unions, union_builder_type, union_type, wall_union
   use dondolo_warnings, only : fit_warning_type, warn_of_records
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
      call new_population_counts(results%population, case%survey%roster, case%stripes%levels, states, error)
      call case%make_study(study)
      if (.not. allocated(error)) call gather(results, study%share(), error)
      if (.not. allocated(error)) call results%population%fit(error)
      if (.not. allocated(error)) call cluster_rows(results, study, error)
      if (.not. allocated(error)) call look_at_rows(case, results, fits, error)
      if (allocated(error)) return
      do k = 1, states
         call combine_population(typologies, results%population, k, error)
         if (allocated(error)) return
         if (k == 1) allocate (results%typologies(size(typologies), states))
         results%typologies(:, k) = typologies
      end do
      call unite_rows(case, results, study, error)
      if (allocated(error)) return
      call case%survey%oddities%warn(results%warnings)
      call warn_of_records(case%suite%records, case%suite%peaks, case%solver%gravity, results%warnings)
      call case%survey%scales%warn(results%warnings)
      call fits%warn(results%typologies(:, states), results%warnings)
   end subroutine combine_rows

   !> Unions of the walls with several mechanisms, one wall in memory at a time, and their means
   subroutine unite_rows(case, results, study, error)
      type(case_type), intent(in) :: case
      !> Its results: curves are there, unions are set
      type(results_type), intent(inout) :: results
      type(study_type), intent(in) :: study
      !> A store has changed, or the table, or what cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      type(union_builder_type) :: builder
      type(union_type), allocatable :: means(:)
      type(row_result_type) :: row
      logical :: runs(size(study%suite%clusters), size(study%levels))
      integer :: i, k, wall, number

      associate (population => results%population)
         number = count(population%first(2:) - population%first(:population%walls()) > 1)
         if (number == 0) return
         call check_room(real(number, wp)*real(size(study%levels)*16*(size(population%curve, 1) + 1), wp), error)
         if (allocated(error)) return
         allocate (results%unions(number))
         runs = runs_of(study)
         wall = 1
         number = 0
         do k = 1, size(results%stores)
            associate (store => results%stores(k))
               do i = store%identity%first, store%identity%last
                  if (i == population%first(wall + 1)) wall = wall + 1
                  if (population%first(wall + 1) - population%first(wall) == 1) cycle
                  call store%read(i, row, error)
                  if (allocated(error)) exit
                  call builder%add(row, population%p_occ(i), store%identity%shape)
                  if (i < population%first(wall + 1) - 1) cycle
                  number = number + 1
                  call wall_union(results%unions(number), builder, population, wall, study%suite%clusters, runs, error)
                  if (allocated(error)) exit
                  deallocate (builder%survival)
               end do
               call store%close()
               if (allocated(error)) return
            end associate
         end do
         call name_unions(case, results%unions, error)
         if (allocated(error) .or. population%walls() == 1) return
         call mean_unions(means, results%unions, population, results%typologies, error)
         if (.not. allocated(error)) results%unions = [results%unions, means]
      end associate
   end subroutine unite_rows

   !> Name the unions after their facades, or after their walls
   subroutine name_unions(case, unions, error)
      type(case_type), intent(in) :: case
      !> Unions of walls, in the order of rows: name and group are set
      type(union_type), intent(inout) :: unions(:)
      !> The table has changed
      type(error_type), allocatable, intent(out) :: error

      type(population_reader_type) :: reader
      type(member_type) :: member
      integer :: i, next
      logical :: found

      next = 1
      call reader%open(case%population_path(), error, case%solver%gravity, is_checked=.false., &
         & facade=case%facade)
      do i = 1, unions(size(unions))%rows(1)
         if (.not. allocated(error)) call reader%next(member, found, error)
         if (.not. allocated(error) .and. .not. found) then
            call raise_failure(error, case%population_path()//': has changed while it was read')
         end if
         if (allocated(error)) exit
         if (unions(next)%rows(1) /= i) cycle
         unions(next)%name = member%wall%name()
         if (len(member%facade) > 0) unions(next)%name = member%facade
         unions(next)%group = member%group
         next = next + 1
      end do
      call reader%close()
   end subroutine name_unions

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
               population%reached(:, :, i) = row%reached(store%identity%shape)
            end do
            call store%close()
            if (allocated(error)) return
         end associate
      end do
   end subroutine gather

   !> Set the clustered standard errors of the curves of the rows
   subroutine cluster_rows(results, study, error)
      type(results_type), intent(inout) :: results
      type(study_type), intent(in) :: study
      !> A store has changed
      type(error_type), allocatable, intent(out) :: error

      type(row_result_type) :: row
      real(wp), dimension(size(study%levels), maxval(study%suite%clusters)) :: counts, histories
      real(wp) :: changes(2, maxval(study%suite%clusters))
      logical :: runs(size(study%suite%clusters), size(study%levels))
      integer :: i, k, state

      runs = runs_of(study)
      do k = 1, size(results%stores)
         associate (store => results%stores(k), population => results%population)
            do i = store%identity%first, store%identity%last
               if (.not. any(population%curve(:, i)%has_fit())) cycle
               call store%read(i, row, error)
               if (allocated(error)) exit
               do state = 1, size(population%curve, 1)
                  call row%by_cluster(state, study%suite%clusters, runs, counts, histories)
                  call cluster_errors(population%curve(state, i), population%levels, counts, histories, changes)
               end do
            end do
            call store%close()
            if (allocated(error)) return
         end associate
      end do
   end subroutine cluster_rows

   !> Whether each record runs at each level
   function runs_of(study) result(runs)
      type(study_type), intent(in) :: study
      !> An answer for each (records, levels)
      logical :: runs(size(study%suite%clusters), size(study%levels))

      integer :: i, j

      do j = 1, size(runs, 2)
         do i = 1, size(runs, 1)
            runs(i, j) = study%runs(i, j)
         end do
      end do
   end function runs_of

   !> Go through the rows and their names: what there is to say of the curves, and those that are shown
   subroutine look_at_rows(case, results, fits, error)
      type(case_type), intent(in) :: case
      !> Its results: the rows that are shown are set
      type(results_type), intent(inout) :: results
      !> What there is to say of the curves
      type(fit_warning_type), intent(inout) :: fits
      !> The table has changed
      type(error_type), allocatable, intent(out) :: error

      type(population_reader_type) :: reader
      type(member_type) :: member
      integer :: i
      logical :: found

      allocate (results%shown(min(shown_rows, case%survey%rows)))
      call reader%open(case%population_path(), error, case%solver%gravity, is_checked=.false., &
         & facade=case%facade)
      do i = 1, case%survey%rows
         if (.not. allocated(error)) call reader%next(member, found, error)
         if (.not. allocated(error) .and. .not. found) then
            call raise_failure(error, case%population_path()//': has changed while it was read')
         end if
         if (allocated(error)) exit
         associate (curve => results%population%curve(size(case%stripes%thresholds), i))
            call fits%look(curve, member%wall%name())
            if (i > shown_rows) cycle
            results%shown(i)%name = member%wall%name()
            results%shown(i)%mechanism = member%wall%mechanism_name()
            results%shown(i)%curve = curve
         end associate
      end do
      call reader%close()
   end subroutine look_at_rows

end module dondolo_combine_rows
