!> Run a case: from walls, records and levels to responses, curves and warnings. Nothing is printed or written here.
module dondolo_run_case
   use, intrinsic :: omp_lib, only : omp_get_thread_num
   use dondolo_case, only : case_type
   use dondolo_ensemble, only : team_of
   use dondolo_error, only : add_place, error_type
   use dondolo_fragility, only : fit_fragility, fragility_type
   use dondolo_kinds, only : wp
   use dondolo_lines, only : lines_type
   use dondolo_queue, only : progress_interface
   use dondolo_response, only : response_type, trace_type
   use dondolo_simulate, only : simulate
   use dondolo_solver, only : solver_type
   use dondolo_stripes, only : plan_stripes, planned_work, run_histories, stripes_type
   use dondolo_typology, only : combine_population, typology_type
   use dondolo_wall_curves, only : mechanism_length, new_wall_curves, wall_curves_type
   use dondolo_warnings, only : fit_warning_type, scale_warning_type, warn_of_error, warn_of_errors, warn_of_fit, &
      & warn_of_records
   use dondolo_work, only : work_type
   implicit none
   private

   public :: results_type, run_case, plan_case

   !> Results of a case; what its task does not make stays empty
   type :: results_type
      !> All histories: task 'stripes'
      type(stripes_type) :: stripes
      !> Collapses (levels, walls): tasks 'stripes' and 'typology'
      integer, allocatable :: collapses(:, :)
      !> Histories of a stripe of each wall: tasks 'stripes' and 'typology'
      integer, allocatable :: histories(:)
      !> Curve of each wall: tasks 'stripes' and 'typology'
      type(fragility_type), allocatable :: fragility(:)
      !> Curves of the population, the last that of all its walls: task 'typology'
      type(typology_type), allocatable :: typologies(:)
      !> The one response: task 'history'
      type(response_type) :: response
      !> Its time history
      type(trace_type) :: trace
      !> What was computed, of all walls: tasks 'stripes' and 'typology'
      type(work_type) :: work
      !> What the user should know
      type(lines_type) :: warnings
   end type results_type

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

      integer :: team

      team = case%job%threads
      if (present(threads)) team = threads
      select case (case%job%task)
      case ('history')
         call warn_of_records(case%records(case%history%record:case%history%record), results%warnings)
         call simulate(case%population%walls(1)%mechanism, case%records(case%history%record), &
            & case%history_scale(), case%solver%solver, results%response, results%trace)
         call warn_of_error(results%response, case%solver%solver%edp_limit, results%warnings)
      case ('stripes')
         call run_stripes(case, results, error, team, progress)
      case ('typology')
         call run_typology(case, results, error, team, progress)
      end select
   end subroutine run_case

   !> What can be told of the work of a case before it is run: see planned_work
   subroutine plan_case(case, work, error)
      !> The case, its task 'stripes' or 'typology'
      type(case_type), intent(in) :: case
      !> Work of all walls; a second run to estimate errors is not counted
      type(work_type), intent(out) :: work
      !> What cannot be run
      type(error_type), allocatable, intent(out) :: error

      type(stripes_type) :: stripes
      integer :: i

      do i = 1, size(case%population%walls)
         call plan_wall(case, i, stripes, error)
         if (allocated(error)) return
         call work%add(planned_work(stripes, case%population%walls(i), case%record_set))
      end do
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

      type(scale_warning_type) :: scales

      call make_room(case, results)
      call run_wall(case, 1, results, results%stripes, error, team, progress)
      if (allocated(error)) return
      results%work = results%stripes%work
      call warn_of_records(case%records, results%warnings)
      call scales%look(results%stripes, case%records, 1)
      call scales%warn(results%warnings)
      call warn_of_fit(case%population%walls(1), results%stripes, results%fragility(1), results%warnings)
      call warn_of_errors(results%stripes, case%records, case%solver%solver%edp_limit, results%warnings)
   end subroutine run_stripes

   !> Stripes of every wall of the population, counts kept
   subroutine run_typology(case, results, error, team, progress)
      !> The case
      type(case_type), intent(in) :: case
      !> Its results
      type(results_type), intent(inout) :: results
      !> What cannot be run
      type(error_type), allocatable, intent(out) :: error
      !> Number of threads; 0: all
      integer, intent(in) :: team
      !> Hears how far the work is, after a wall
      procedure(progress_interface), optional :: progress

      type(scale_warning_type) :: scales
      type(fit_warning_type) :: fits
      type(wall_curves_type), allocatable :: walls(:)
      integer :: i

      call make_room(case, results)
      call run_walls(case, results, scales, error, team, progress)
      if (.not. allocated(error)) call join_mechanisms(case, results, walls, error)
      if (.not. allocated(error)) call combine_population(results%typologies, walls, case%stripes%levels, error)
      if (allocated(error)) return
      call warn_of_records(case%records, results%warnings)
      call scales%warn(results%warnings)
      do i = 1, size(results%fragility)
         call fits%look(results%fragility(i), case%population%walls(i)%input%name)
      end do
      call fits%warn(results%typologies, results%warnings)
   end subroutine run_typology

   !> The curves of each wall with all its mechanisms
   subroutine join_mechanisms(case, results, walls, error)
      !> The case
      type(case_type), intent(in) :: case
      !> Its results: counts and curves of the rows
      type(results_type), intent(in) :: results
      !> The walls
      type(wall_curves_type), allocatable, intent(out) :: walls(:)
      !> Counts that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      character(len=mechanism_length), allocatable :: mechanism(:)
      integer :: first, last, i, wall

      allocate (walls(case%population%number_of_walls()))
      last = 0
      associate (population => case%population)
         do wall = 1, size(walls)
            first = last + 1
            last = population%last_row(first)
            allocate (mechanism(first:last))
            do i = first, last
               mechanism(i) = population%walls(i)%input%mechanism
            end do
            call new_wall_curves(walls(wall), population%group(first)%text, population%weight(first), mechanism, &
               & population%p_occ(first:last), results%fragility(first:last), results%collapses(:, first:last), &
               & results%histories(first:last), case%stripes%levels, error)
            call add_place(error, 'wall '''//population%walls(first)%input%name//'''')
            if (allocated(error)) return
            deallocate (mechanism)
         end do
      end associate
   end subroutine join_mechanisms

   !> Every wall of the population. As many walls as go round evenly are shared out among the threads; on each of the
   !> others, all threads work together. Results do not depend on it
   subroutine run_walls(case, results, scales, error, team, progress)
      !> The case
      type(case_type), intent(in) :: case
      !> Its results: counts, curves and work of the walls are set
      type(results_type), intent(inout) :: results
      !> What there is to say of the scale factors
      type(scale_warning_type), intent(inout) :: scales
      !> What cannot be run: of the first such wall
      type(error_type), allocatable, intent(out) :: error
      !> Number of threads; 0: all
      integer, intent(in) :: team
      !> Hears how far the work is
      procedure(progress_interface), optional :: progress

      integer :: i, walls, threads, shared_out, failed, done, total

      walls = size(case%population%walls)
      total = size(case%stripes%levels)*sum(results%histories)
      done = 0
      failed = walls + 1
      threads = team_of(team, huge(1))
      shared_out = walls - modulo(walls, threads)
      !$omp parallel do schedule(dynamic) num_threads(threads) if(shared_out > 0) default(none) shared(shared_out)
      do i = 1, shared_out
         call one_wall(i, 1)
      end do
      !$omp end parallel do
      do i = shared_out + 1, walls
         call one_wall(i, threads)
      end do
      if (present(progress)) call progress(done, total)

   contains

      !> Run one wall, unless one before it could not be run
      subroutine one_wall(wall, crew)
         !> Number of the wall
         integer, intent(in) :: wall
         !> Threads that work on it
         integer, intent(in) :: crew

         type(stripes_type) :: stripes
         type(error_type), allocatable :: trouble
         integer :: first_failed, now

         !$omp atomic read
         first_failed = failed
         if (wall > first_failed) return
         call run_wall(case, wall, results, stripes, trouble, crew)
         !$omp critical (gather_wall)
         if (.not. allocated(trouble)) then
            call scales%look(stripes, case%records, wall)
            call results%work%add(stripes%work)
         else if (wall < failed) then
            !$omp atomic write
            failed = wall
            call move_alloc(trouble, error)
         end if
         done = done + size(case%stripes%levels)*results%histories(wall)
         now = done
         !$omp end critical (gather_wall)
         if (present(progress)) then
            if (omp_get_thread_num() == 0) call progress(now, total)
         end if
      end subroutine one_wall

   end subroutine run_walls

   !> Room for the counts and curves of all walls
   subroutine make_room(case, results)
      !> The case
      type(case_type), intent(in) :: case
      !> Its results
      type(results_type), intent(inout) :: results

      integer :: i, walls

      walls = size(case%population%walls)
      allocate (results%collapses(size(case%stripes%levels), walls), results%fragility(walls))
      results%histories = [(case%histories(i), i=1, walls)]
   end subroutine make_room

   !> Stripes and curve of one wall
   subroutine run_wall(case, wall, results, stripes, error, team, progress)
      !> The case
      type(case_type), intent(in) :: case
      !> Number of the wall
      integer, intent(in) :: wall
      !> Results: counts and curve of the wall are set
      type(results_type), intent(inout) :: results
      !> All histories of the wall
      type(stripes_type), intent(out) :: stripes
      !> What cannot be run
      type(error_type), allocatable, intent(out) :: error
      !> Number of threads; 0: all
      integer, intent(in) :: team
      !> Hears how far the work is
      procedure(progress_interface), optional :: progress

      real(wp) :: histories(size(case%stripes%levels))
      type(solver_type) :: solver

      solver = case%solver%solver
      solver%collapses_only = case%job%task == 'typology'
      call plan_wall(case, wall, stripes, error)
      if (.not. allocated(error)) then
         call run_histories(stripes, case%population%walls(wall), case%records, case%record_set, solver, 1, &
            & size(stripes%response), team, progress)
         results%collapses(:, wall) = stripes%collapses()
         histories = real(results%histories(wall), wp)
         call fit_fragility(results%fragility(wall), case%stripes%levels, &
            & real(results%collapses(:, wall), wp), histories, error)
      end if
      call add_place(error, 'wall '''//case%population%walls(wall)%input%name//'''')
   end subroutine run_wall

   !> Choose the histories of one wall
   subroutine plan_wall(case, wall, stripes, error)
      !> The case
      type(case_type), intent(in) :: case
      !> Number of the wall
      integer, intent(in) :: wall
      !> The plan
      type(stripes_type), intent(out) :: stripes
      !> What cannot be run
      type(error_type), allocatable, intent(out) :: error

      call plan_stripes(stripes, case%population%walls(wall), case%records, case%stripes%levels, &
         & case%stripes%scaling, case%values, case%records_input%polarity, case%solver%solver, error)
   end subroutine plan_wall

end module dondolo_run_case
