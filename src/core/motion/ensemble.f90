!> Many histories of one wall, on several threads, by the engine that suits them.
!>
!> Histories are independent, and each is computed by one thread from data that no thread changes: results are the same
!> to the bit for any number of threads and any grouping.
module dondolo_motion_ensemble
   use dondolo_base_error, only : error_type, not_given, not_together, raise_failure, raise_input
   use dondolo_base_interrupt, only : get_watched, watch, watched_type
   use dondolo_base_invariant, only : assert, checked, lies_between
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : brief
   use dondolo_base_threads, only : team_of
   use dondolo_motion_elastic_filter, only : elastic_filter_type, new_elastic_filter
   use dondolo_motion_elastic_motion, only : simulate_filtered
   use dondolo_motion_error_estimate, only : estimated_error, other_run, runs_of_estimate
   use dondolo_motion_initial_state, only : initial_state_type
   use dondolo_motion_lane_constants, only : lane_constants_type, new_lane_constants
   use dondolo_motion_lane_variants, only : build_variant, check_variant, first_variant, simulate_variant
   use dondolo_motion_one_history, only : simulate_one
   use dondolo_motion_queue, only : progress_interface, queue_type
   use dondolo_motion_response, only : response_type
   use dondolo_motion_rest, only : new_rest, rest_type
   use dondolo_motion_solver, only : solver_type
   use dondolo_motion_work, only : work_type
   use dondolo_record, only : record_type
   use dondolo_record_suite, only : suite_type
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: ensemble_type, run_ensemble, check_engine, name_engines, raise_given_up

   !> Histories that take a thread of the engine lanes longer, by many times, than it takes a team to begin and to end
   integer, parameter :: histories_of_thread = 32

   !> Histories of one wall
   type :: ensemble_type
      !> Record of each history
      integer, allocatable :: record(:)
      !> Factor on it, negative to reverse it
      real(wp), allocatable :: scale(:)
      !> Rotation and velocity of the wall at the start of each
      type(initial_state_type) :: initial
      !> Results
      type(response_type), allocatable :: response(:)
      !> What was computed
      type(work_type) :: work
   end type ensemble_type

contains

   !> Run the histories of an ensemble
   subroutine run_ensemble(ensemble, mechanism, suite, solver, threads, error, progress)
      !> The histories: records and factors are given, results and counts set
      type(ensemble_type), intent(inout) :: ensemble
      class(mechanism_type), intent(in) :: mechanism
      type(suite_type), intent(in) :: suite
      !> Engine, tolerances and limit; whether errors are to be estimated
      type(solver_type), intent(in) :: solver
      !> Number of threads; 0: all that OpenMP gives
      integer, intent(in) :: threads
      !> A history was given up; the results are not whole then
      type(error_type), allocatable, intent(out) :: error
      !> Progress callback
      procedure(progress_interface), optional :: progress

      type(queue_type) :: queue
      type(solver_type) :: other_solver
      type(initial_state_type) :: other_initial
      type(response_type), allocatable :: stronger(:)
      real(wp), allocatable :: scale(:)
      real(wp) :: change
      integer :: i, k

      call queue%announce(merge(runs_of_estimate, 1, solver%estimate_error)*size(ensemble%record), progress)
      call queue%fill(ensemble%record, ensemble%scale, suite%by_duration)
      call run_queue(queue, mechanism, suite, solver, ensemble%initial, threads, ensemble%work, error)
      call move_alloc(queue%response, ensemble%response)
      if (allocated(error) .or. .not. solver%estimate_error) return
      scale = ensemble%scale
      do k = 1, runs_of_estimate - 1
         if (k > 1) call move_alloc(queue%response, stronger)
         other_solver = solver
         do i = 1, size(scale)
            call other_run(k, solver, ensemble%scale(i), other_solver, scale(i))
         end do
         ! As much further out or in as the record is stronger or weaker
         call other_run(k, solver, 1.0_wp, other_solver, change)
         other_initial = ensemble%initial%times(change)
         call queue%fill(ensemble%record, scale, suite%by_duration)
         call run_queue(queue, mechanism, suite, other_solver, other_initial, threads, ensemble%work, error)
         if (allocated(error)) return
      end do
      ensemble%response%edp_error = estimated_error(ensemble%response, stronger, queue%response, &
         & mechanism%frequency_parameter(), solver%edp_limit)
   end subroutine run_ensemble

   !> Run every history in a queue
   subroutine run_queue(queue, mechanism, suite, solver, initial, threads, work, error)
      !> The histories, and their results
      type(queue_type), intent(inout) :: queue
      class(mechanism_type), intent(in) :: mechanism
      type(suite_type), intent(in) :: suite
      !> Engine, tolerances and limit
      type(solver_type), intent(in) :: solver
      !> Rotation and velocity of the wall at the start
      type(initial_state_type), intent(in) :: initial
      !> Number of threads; 0: all that OpenMP gives
      integer, intent(in) :: threads
      !> Counts, added to
      type(work_type), intent(inout) :: work
      !> A history was given up
      type(error_type), allocatable, intent(out) :: error

      type(lane_constants_type) :: constants
      type(rest_type) :: rest
      type(elastic_filter_type), allocatable :: filter(:)
      type(work_type) :: own
      character(len=16) :: variant
      type(watched_type) :: watched
      integer :: number, team
      logical :: stays

      if (checked) call assert(mechanism%capacity > 0.0_wp .and. mechanism%capacity <= huge(0.0_wp), 'a capacity is positive')
      variant = build_variant()
      call get_watched(watched)
      ! Lanes begin at rest.
      if (solver%engine /= 'rk45' .and. .not. initial%moves()) constants = new_lane_constants(mechanism, solver, suite%has_vertical)
      if (.not. constants%form%exists) rest = new_rest(mechanism)
      ! What all levels of a record have in common as long as the joints of the wall are closed
      allocate (filter(merge(size(suite%records), 0, mechanism%joint%exists .and. .not. initial%moves())))
      team = team_of(threads, size(queue%record)/merge(histories_of_thread, 1, constants%form%exists))
      !$omp parallel num_threads(team) default(none) &
      !$omp & private(own, number, stays) &
      !$omp & shared(variant, constants, rest, filter, mechanism, suite, solver, initial, queue, work, watched)
      call watch(watched)
      own = work_type()
      !$omp do schedule(dynamic)
      do number = 1, size(filter)
         if (any(queue%record == number)) filter(number) = new_elastic_filter(mechanism%joint, suite%records(number))
      end do
      !$omp end do
      if (constants%form%exists) then
         call simulate_variant(variant, mechanism, constants, suite%records, suite%set, filter, queue, own)
      else
         do
            number = queue%next()
            if (number == 0) exit
            associate (record => queue%record(number), scale => queue%scale(number))
               stays = .not. initial%moves()
               if (stays) stays = rest%stays(suite%records(record), suite%set, record, scale)
               if (stays) then
                  call own%add(work_type(histories=1, still=1, intervals=suite%set%length(record) - 1))
               else if (size(filter) > 0) then
                  call simulate_filtered(mechanism, filter(record), suite%records(record), scale, solver, &
                     & queue%response(number), own)
               else
                  call simulate_one(mechanism, suite%records(record), scale, solver, queue%response(number), initial=initial, &
                     & work=own)
               end if
            end associate
            call queue%report()
         end do
      end if
      !$omp critical (add_work)
      call work%add(own)
      !$omp end critical (add_work)
      !$omp end parallel
      call queue%report_all()
      if (checked) call assert(all(lies_between(queue%response%edp, 0.0_wp, solver%edp_limit)), &
         & 'an EDP lies between 0 and its limit')
      number = findloc(queue%response%is_whole, .false., dim=1)
      if (number > 0) call raise_given_up(suite%records(queue%record(number)), queue%scale(number), queue%response(number), error)
   end subroutine run_queue

   !> Report a history that was given up
   subroutine raise_given_up(record, scale, response, error)
      type(record_type), intent(in) :: record
      !> Factor on it
      real(wp), intent(in) :: scale
      !> What is left of it
      type(response_type), intent(in) :: response
      type(error_type), allocatable, intent(out) :: error

      call raise_failure(error, 'record '''//record%name//''', scale factor '//brief(scale)//': the time history does not get '// &
         & 'beyond the sample at '//brief(response%time_of_peak)//' s and was given up; another rtol, atol or engine may '// &
         & 'complete it')
   end subroutine raise_given_up

   !> The engines that have computed histories, each with the build variant that ran
   subroutine name_engines(work, text, variant)
      !> What was computed
      type(work_type), intent(in) :: work
      !> `lanes (avx512)`, `rk45 (baseline)` or both
      character(len=:), allocatable, intent(out) :: text
      !> Build variant of the engine lanes, if it ran elsewhere
      character(len=*), intent(in), optional :: variant

      text = 'rk45 ('//first_variant//')'
      if (work%in_lanes == 0) return
      if (work%in_lanes < work%histories) then
         text = ' and '//text
      else
         text = ''
      end if
      if (present(variant)) then
         text = 'lanes ('//trim(variant)//')'//text
      else
         text = 'lanes ('//trim(build_variant())//')'//text
      end if
   end subroutine name_engines

   !> Check that an engine can compute a mechanism
   subroutine check_engine(solver, mechanism, error, is_shaken)
      type(solver_type), intent(in) :: solver
      class(mechanism_type), intent(in) :: mechanism
      !> The engine lanes was asked for, and cannot; or a build variant that there is not; or vertical motion of a wall that does
      !> not know what it changes
      type(error_type), allocatable, intent(out) :: error
      !> Is there vertical motion? No, if absent
      logical, intent(in), optional :: is_shaken

      type(lane_constants_type) :: constants

      call check_variant(error)
      if (allocated(error)) return
      if (mechanism%is_static) then
         call raise_input(error, 'half_gable: has a check and no time histories, since both halves of a gable cross the plane '// &
            & 'of its axis as they turn, and jam', not_together, 'half_gable')
         return
      end if
      if (present(is_shaken)) then
         if (is_shaken .and. .not. mechanism%knows_vertical()) then
            call raise_input(error, 'vertical_lever: must be given for records with vertical motion: without it the table does '// &
               & 'not say which part of the moment is that of masses which move up', not_given, 'vertical_lever')
            return
         end if
         if (is_shaken .and. mechanism%joint%exists) then
            call raise_input(error, 'elastic_period: joints that bend know no vertical motion; leave it out, or the vertical '// &
               & 'component of the records', not_together, 'elastic_period')
            return
         end if
      end if
      if (solver%engine /= 'lanes') return
      if (mechanism%scatter%exists()) then
         call raise_input(error, 'engine = ''lanes'': has one restitution e for all impacts of a wall; must be ''auto'' or '// &
            & '''rk45'' with restitution_sd', not_together, 'engine')
         return
      end if
      constants = new_lane_constants(mechanism, solver, is_shaken)
      if (constants%form%exists) return
      call raise_input(error, 'engine = ''lanes'': cannot follow this wall up to its edp_limit; '// &
         & 'must be ''auto'' or ''rk45'', or another edp_limit', not_together, 'engine')
   end subroutine check_engine

end module dondolo_motion_ensemble
