!> The curves of a population out of what its stores hold (docs/theory.md, section 6).
module dondolo_case_combine_rows
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_case, only : case_type
   use dondolo_case_check_rows, only : check_wall
   use dondolo_case_event_warnings, only : warn_of_events
   use dondolo_case_motion_warnings, only : warn_of_records
   use dondolo_case_result_warnings, only : fit_warnings_type, warn_of_union
   use dondolo_case_results, only : results_type, shown_rows
   use dondolo_case_survey, only : hand_rows_over
   use dondolo_check_safety, only : new_safety
   use dondolo_check_sheet, only : sheet_type
   use dondolo_fragility_study, only : runs_of, study_type
   use dondolo_population_curves, only : population_curves_type
   use dondolo_population_designs, only : compare_designs, design_type
   use dondolo_population_reader, only : population_reader_type
   use dondolo_population_row_result, only : row_result_type
   use dondolo_population_sensitivity, only : new_sensitivity
   use dondolo_population_store, only : read_result
   use dondolo_population_wall_row, only : wall_row_type
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: combine_rows

contains

   !> Curves of the population, and what there is to warn of
   subroutine combine_rows(case, results, error)
      !> The case: it hands its rows over
      type(case_type), intent(inout), target :: case
      !> Its results: the stores are there; counts, curves and warnings are set
      type(results_type), intent(inout) :: results
      !> What cannot be combined
      type(error_type), allocatable, intent(out) :: error

      type(study_type) :: study
      type(fit_warnings_type) :: fits
      integer :: states

      states = size(case%stripes%thresholds)
      call hand_rows_over(case%survey, case%table, results%population, error)
      if (.not. allocated(error)) call results%population%begin(case%stripes%levels, states, error)
      call case%make_study(study)
      if (.not. allocated(error)) call gather(results, study%share(), error)
      if (.not. allocated(error)) call results%population%fit(error)
      if (.not. allocated(error)) call look_at_rows(case, results, study, fits, error)
      if (allocated(error)) return
      if (case%designs) call compare_designs(results%designs)
      if (allocated(case%uncertainty)) call compute_sensitivity(case, results)
      call case%survey%wall_warnings%warn(results%warnings, case%suite%records, case%stripes%thresholds)
      call warn_of_records(case%suite, case%solver%gravity, results%warnings)
      call warn_of_events(case%suite, results%warnings)
      call case%survey%scales%warn(results%warnings)
      call case%survey%occurrence_warnings%warn(results%warnings)
      if (results%population%walls == 1 .and. results%unions%count() > 0) then
         ! The result of a single facade is the curve of its union.
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

   !> Go through the rows with all that is known of each: curves of the population and standard errors, unions of the walls
   !> with several mechanisms, what there is to say of the curves, and the rows that are shown
   subroutine look_at_rows(case, results, study, fits, error)
      type(case_type), intent(in) :: case
      !> Its results: the population and the curves of its rows are there
      type(results_type), intent(inout) :: results
      type(study_type), intent(in) :: study
      !> Warnings of the curves
      type(fit_warnings_type), intent(inout) :: fits
      !> A store has changed, counts that cannot be fitted, or lack of memory
      type(error_type), allocatable, intent(out) :: error

      type(population_reader_type) :: reader
      type(wall_row_type) :: row
      type(row_result_type) :: outcome
      type(population_curves_type), allocatable :: curves
      character(len=:), allocatable :: name
      real(wp) :: change(2, maxval(study%suite%clusters))
      logical :: found
      integer :: i, states

      ! On the heap: stacks may be small.
      allocate (curves)
      states = size(case%stripes%thresholds)
      allocate (results%shown(min(shown_rows, case%survey%rows)))
      if (case%designs) allocate (results%designs(results%population%rows))
      call curves%begin(results%population, study%suite%clusters, runs_of(study), case%designs, .false., error)
      if (allocated(error)) return
      reader%names%is_checked = .false.
      do i = 1, results%population%rows
         call reader%next(case%table, row, found, error)
         if (.not. allocated(error)) call read_result(results%stores, i, outcome, error)
         if (allocated(error)) exit
         name = row%wall%name()
         if (len(row%facade) > 0) name = row%facade
         call curves%add(outcome, name, results%population, change, error)
         if (allocated(error)) exit
         associate (curve => results%population%curve(states, i))
            call fits%look(curve, row%wall%name())
            if (case%designs) then
               call results%designs(i)%take_wall(row%wall)
               if (allocated(case%check)) call take_check(case, row%wall, results%designs(i))
               results%designs(i)%curve = curve
               results%designs(i)%change = change(1, :)
            end if
            if (i > shown_rows) cycle
            results%shown(i)%name = row%wall%name()
            results%shown(i)%mechanism = row%wall%mechanism_name()
            results%shown(i)%curve = curve
         end associate
      end do
      call results%stores%close()
      if (.not. allocated(error)) call curves%finish(results%population, error)
      if (allocated(error)) return
      call move_alloc(curves%typologies, results%typologies)
      call results%unions%take(curves%unions)
   end subroutine look_at_rows

   !> Take the result of the check of a design; if there is none, the table of checks has the reason
   subroutine take_check(case, wall, design)
      !> The case, with a check
      type(case_type), intent(in) :: case
      type(wall_type), intent(in) :: wall
      !> The design
      type(design_type), intent(inout) :: design

      type(sheet_type) :: sheet
      type(error_type), allocatable :: error

      call check_wall(wall, case%check, case%stripes%scaling%name, sheet, error)
      if (.not. allocated(error)) design%safety = new_safety(sheet)
   end subroutine take_check

end module dondolo_case_combine_rows
