!> Run a case: from walls, records and levels to responses, curves and warnings. Nothing is printed, and no report is
!> written here.
module dondolo_case_run_case
   use dondolo_base_error, only : error_type
   use dondolo_base_interrupt, only : check_interrupt
   use dondolo_building_floor_motion, only : filter_record
   use dondolo_building_floors, only : floors_type
   use dondolo_case, only : case_type
   use dondolo_case_check_case, only : check_stripes
   use dondolo_case_check_rows, only : check_wall
   use dondolo_case_event_warnings, only : warn_of_events
   use dondolo_case_job_group, only : history_task, stripes_task, typology_task
   use dondolo_case_motion_warnings, only : scale_warnings_type, warn_of_fall, warn_of_records
   use dondolo_case_population_case, only : run_population_case
   use dondolo_case_result_warnings, only : warn_of_error, warn_of_errors, warn_of_fit
   use dondolo_case_results, only : results_type
   use dondolo_case_survey, only : check_size
   use dondolo_case_wall_warnings, only : wall_warnings_type
   use dondolo_fragility_certified, only : bound_states, certify_stripes
   use dondolo_fragility_stripes, only : mark_lifts, multiple_stripe, plan_stripes, planned_work, stripes_type
   use dondolo_fragility_study, only : study_type
   use dondolo_fragility_tie_tallies, only : tally_ties
   use dondolo_motion_certificate, only : check_certificates
   use dondolo_motion_queue, only : progress_interface
   use dondolo_motion_simulate, only : simulate
   use dondolo_motion_work, only : work_type
   use dondolo_population_reader, only : population_reader_type
   use dondolo_population_wall_row, only : wall_row_type
   use dondolo_record, only : record_type
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: run_case, plan_case

contains

   !> Run a case
   subroutine run_case(case, results, error, threads, progress, in_memory)
      !> The case; the rows of its population are handed over to the results
      type(case_type), intent(inout) :: case
      type(results_type), intent(out) :: results
      !> What cannot be run
      type(error_type), allocatable, intent(out) :: error
      !> Number of threads instead of the case's
      integer, intent(in), optional :: threads
      !> Hears how far the work is, in histories
      procedure(progress_interface), optional :: progress
      !> Does the store of a population stay in memory, and not in a file from which a killed run goes on?
      logical, intent(in), optional :: in_memory

      type(wall_warnings_type) :: wall_warnings
      type(record_type) :: floor
      integer :: team
      logical :: stays

      team = case%job%threads
      if (present(threads)) team = threads
      stays = .false.
      if (present(in_memory)) stays = in_memory
      if (case%job%task /= typology_task) then
         call wall_warnings%look(case%wall)
         if (case%job%task == history_task) then
            call wall_warnings%warn(results%warnings, case%suite%records(case%history%record:case%history%record))
         else
            call wall_warnings%warn(results%warnings, case%suite%records, case%stripes%thresholds)
         end if
      end if
      select case (case%job%task)
      case (history_task)
         associate (one => case%history%record)
            call warn_of_records(case%suite, case%solver%gravity, results%warnings, one, case%history%initial%moves())
         end associate
         associate (record => case%suite%records(case%history%record))
            call warn_of_fall(record, case%history_scale(), case%wall%gravity, results%warnings)
            if (allocated(case%wall%building)) then
               call filter_record(case%wall%building, record, floor, error)
               if (allocated(error)) return
               call simulate(case%wall%mechanism, floor, case%history_scale(), case%solver%solver, results%response, &
                  & error, results%trace, case%history%initial)
            else
               call simulate(case%wall%mechanism, record, case%history_scale(), case%solver%solver, results%response, &
                  & error, results%trace, case%history%initial)
            end if
         end associate
         if (allocated(error)) return
         results%work = results%trace%work
         call warn_of_error(results%response, case%solver%solver%edp_limit, results%warnings)
      case (stripes_task)
         call run_stripes(case, results, error, team, progress)
      case (typology_task)
         call run_population_case(case, results, error, team, stays, progress)
      end select
   end subroutine run_case

   !> Work of a case, as far as it is known before the run
   subroutine plan_case(case, work, scales, error)
      !> The case, its task 'stripes' or 'typology'
      type(case_type), intent(in), target :: case
      !> Work of all walls, see planned_work; a second run to estimate errors is not counted
      type(work_type), intent(out) :: work
      !> Warnings of scale factors
      type(scale_warnings_type), intent(out) :: scales
      !> What cannot be run
      type(error_type), allocatable, intent(out) :: error

      type(study_type) :: study
      type(floors_type), target :: floors
      type(population_reader_type) :: reader
      type(wall_row_type) :: row
      logical :: found

      call case%make_study(study)
      study%floors => floors
      if (case%job%task == stripes_task) then
         call plan_wall(case%wall)
         return
      end if
      call check_size(case%population_path(), case%survey%histories, error)
      reader%names%is_checked = .false.
      if (.not. allocated(error)) call reader%skip(case%table, case%survey%first - 1, error)
      do while (reader%row < case%survey%last .and. .not. allocated(error))
         call reader%next(case%table, row, found, error)
         if (.not. allocated(error)) call plan_wall(row%wall)
      end do

   contains

      !> Plan the histories of one wall
      subroutine plan_wall(wall)
         type(wall_type), intent(in) :: wall

         type(stripes_type) :: stripes

         call plan_stripes(stripes, wall, study, error)
         if (study%solver%certify .and. .not. allocated(error)) call check_certificates(wall, error)
         if (allocated(error)) return
         call work%add(planned_work(stripes, wall, study))
         call scales%look(stripes, study, wall)
      end subroutine plan_wall

   end subroutine plan_case

   !> Stripes of the one wall, all histories kept
   subroutine run_stripes(case, results, error, team, progress)
      type(case_type), intent(in), target :: case
      type(results_type), intent(inout) :: results
      !> What cannot be run
      type(error_type), allocatable, intent(out) :: error
      !> Number of threads; 0: all
      integer, intent(in) :: team
      !> Hears how far the work is
      procedure(progress_interface), optional :: progress

      type(study_type) :: study
      type(stripes_type) :: stripes
      type(scale_warnings_type) :: scales
      logical, allocatable :: lifts(:, :)

      call case%make_study(study, team)
      if (study%solver%certify) call check_certificates(case%wall, error)
      if (.not. allocated(error)) call multiple_stripe(stripes, case%wall, study, error, progress)
      if (.not. allocated(error)) call check_interrupt(error)
      if (study%solver%certify .and. .not. allocated(error)) then
         call certify_stripes(stripes, case%wall, study, error, progress)
         if (.not. allocated(error)) then
            call check_interrupt(error)
            if (allocated(error)) error%message = error%message//': nothing is written, and the certificates so far are lost'
         end if
      end if
      if (.not. allocated(error)) call results%row%of(stripes, study%thresholds, study%suite%clusters, &
         & case%stripes%states == 'ordinal', error)
      if (allocated(error)) return
      results%work = stripes%work
      call warn_of_records(case%suite, case%solver%gravity, results%warnings)
      call warn_of_events(case%suite, results%warnings)
      call scales%look(stripes, study, case%wall)
      call scales%warn(results%warnings)
      call warn_of_fit(case%wall, stripes, results%row%curve(size(study%thresholds)), results%warnings)
      call warn_of_errors(stripes, case%suite%records, study%solver%edp_limit, results%warnings)
      if (allocated(case%check)) then
         call check_wall(case%wall, case%check, case%stripes%scaling%name, results%check, error, &
            & results%row%curve(size(study%thresholds)), searches=.true.)
         if (.not. allocated(error)) call check_stripes(case, stripes, results%check, error, team)
         if (.not. allocated(error)) call check_interrupt(error)
         if (allocated(error)) return
      end if
      if (allocated(stripes%certified)) then
         call bound_states(stripes, study%thresholds, case%stripes%states == 'ordinal', results%row%bounds, error)
         if (allocated(error)) return
         call move_alloc(stripes%certified, results%row%certified)
      end if
      call tally_ties(case%wall%mechanism, stripes%response, stripes%ran, results%row%tallies)
      if (case%suite%has_vertical) then
         call mark_lifts(stripes, case%suite%falls, case%wall%gravity, lifts)
         results%row%uplift = count(lifts, dim=1)
      end if
      call move_alloc(stripes%response, results%row%response)
   end subroutine run_stripes

end module dondolo_case_run_case
