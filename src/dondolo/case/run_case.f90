!> Run a case: from walls, records and levels to responses, curves and warnings. Nothing is printed, and no report is
!> written here.
module dondolo_run_case
   use dondolo_case, only : case_type
   use dondolo_error, only : error_type, raise_failure
   use dondolo_fragility, only : fit_fragility
   use dondolo_kinds, only : wp
   use dondolo_memory, only : raise_shortage
   use dondolo_plausibility, only : wall_warning_type
   use dondolo_population, only : member_type, population_reader_type
   use dondolo_queue, only : progress_interface
   use dondolo_results, only : results_type
   use dondolo_run_population, only : run_population
   use dondolo_simulate, only : simulate
   use dondolo_stripes, only : plan_stripes, planned_work, run_histories, stripes_type
   use dondolo_survey, only : check_size
   use dondolo_wall, only : wall_type
   use dondolo_warnings, only : scale_warning_type, warn_of_error, warn_of_errors, warn_of_fit, warn_of_records
   use dondolo_work, only : work_type
   implicit none
   private

   public :: run_case, plan_case

   !> Memory that a row of a time history takes while it grows [bytes]
   real(wp), parameter :: bytes_of_row = 140.0_wp

contains

   !> Run a case
   subroutine run_case(case, results, error, threads, progress)
      !> The case
      type(case_type), intent(in) :: case
      !> Its results
      type(results_type), intent(out) :: results
      !> What cannot be run
      type(error_type), allocatable, intent(out) :: error
      !> Number of threads instead of the case's
      integer, intent(in), optional :: threads
      !> Hears how far the work is, in histories
      procedure(progress_interface), optional :: progress

      type(wall_warning_type) :: oddities
      integer :: team

      team = case%job%threads
      if (present(threads)) team = threads
      if (case%job%task /= 'typology') then
         call oddities%look(case%wall)
         call oddities%warn(results%warnings)
      end if
      select case (case%job%task)
      case ('history')
         call warn_of_records(case%records(case%history%record:case%history%record), case%solver%gravity, &
            & results%warnings)
         call simulate(case%wall%mechanism, case%records(case%history%record), case%history_scale(), &
            & case%solver%solver, results%response, results%trace)
         if (results%trace%lacks_memory) call raise_shortage(bytes_of_row*real(results%trace%rows, wp), error)
         if (allocated(error)) return
         call warn_of_error(results%response, case%solver%solver%edp_limit, results%warnings)
      case ('stripes')
         call run_stripes(case, results, error, team, progress)
      case ('typology')
         call run_population(case, results, error, team, progress)
      end select
   end subroutine run_case

   !> What can be told of the work of a case before it is run
   subroutine plan_case(case, work, scales, error)
      !> The case, its task 'stripes' or 'typology'
      type(case_type), intent(in) :: case
      !> Work of all walls, see planned_work; a second run to estimate errors is not counted
      type(work_type), intent(out) :: work
      !> What there is to say of scale factors
      type(scale_warning_type), intent(out) :: scales
      !> What cannot be run
      type(error_type), allocatable, intent(out) :: error

      type(population_reader_type) :: reader
      type(member_type) :: member
      logical :: found

      if (case%job%task == 'stripes') then
         call plan_wall(case%wall)
         return
      end if
      call check_size(case%population_path(), case%survey%histories, error)
      if (.not. allocated(error)) &
         & call reader%open(case%population_path(), error, case%solver%gravity, is_checked=.false.)
      if (.not. allocated(error)) call reader%skip(case%survey%first - 1, error)
      do while (reader%row < case%survey%last .and. .not. allocated(error))
         call reader%next(member, found, error)
         if (.not. found .and. .not. allocated(error)) &
            & call raise_failure(error, case%population_path()//': has changed while it was read')
         if (.not. allocated(error)) call plan_wall(member%wall)
      end do
      call reader%close()

   contains

      !> Plan the histories of one wall
      subroutine plan_wall(wall)
         !> The wall
         type(wall_type), intent(in) :: wall

         type(stripes_type) :: stripes

         call choose_histories(case, wall, stripes, error)
         if (allocated(error)) return
         call work%add(planned_work(stripes, wall, case%record_set))
         call scales%look(stripes, case%records)
      end subroutine plan_wall

   end subroutine plan_case

   !> Stripes of the one wall, all histories kept
   subroutine run_stripes(case, results, error, team, progress)
      !> The case
      type(case_type), intent(in) :: case
      !> Its results
      type(results_type), intent(inout) :: results
      !> What cannot be run
      type(error_type), allocatable, intent(out) :: error
      !> Number of threads; 0: all
      integer, intent(in) :: team
      !> Hears how far the work is
      procedure(progress_interface), optional :: progress

      type(stripes_type) :: stripes
      type(scale_warning_type) :: scales
      real(wp), allocatable :: histories(:)
      integer :: k

      call choose_histories(case, case%wall, stripes, error)
      if (allocated(error)) return
      call run_histories(stripes, case%wall, case%records, case%record_set, case%solver%solver, 1, &
         & size(stripes%response), team, progress)
      associate (row => results%row, thresholds => case%stripes%thresholds)
         row%histories = size(stripes%record)
         allocate (row%reached(size(stripes%levels), size(thresholds)), row%curve(size(thresholds)))
         histories = spread(real(row%histories, wp), 1, size(stripes%levels))
         do k = 1, size(thresholds)
            row%reached(:, k) = stripes%exceedances(thresholds(k))
            call fit_fragility(row%curve(k), stripes%levels, real(row%reached(:, k), wp), histories, error)
            if (allocated(error)) return
         end do
         results%work = stripes%work
         call warn_of_records(case%records, case%solver%gravity, results%warnings)
         call scales%look(stripes, case%records)
         call scales%warn(results%warnings)
         call warn_of_fit(case%wall, stripes, row%curve(size(thresholds)), results%warnings)
         call warn_of_errors(stripes, case%records, case%solver%solver%edp_limit, results%warnings)
      end associate
      call move_alloc(stripes%response, results%row%response)
   end subroutine run_stripes

   !> Choose the histories of a wall
   subroutine choose_histories(case, wall, stripes, error)
      !> The case
      type(case_type), intent(in) :: case
      !> The wall
      type(wall_type), intent(in) :: wall
      !> The plan
      type(stripes_type), intent(out) :: stripes
      !> What cannot be run
      type(error_type), allocatable, intent(out) :: error

      call plan_stripes(stripes, wall, case%records, case%stripes%levels, case%stripes%scaling, case%values, &
         & case%peaks, case%records_input%polarity, case%solver%solver, error)
   end subroutine choose_histories

end module dondolo_run_case
