!> Studies, and the multiple stripes of walls under them.
module stripes
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use dondolo_base_error, only : add_place, error_type
   use dondolo_base_interrupt, only : check_interrupt, get_watched, watch, watched_type
   use dondolo_base_lines, only : lines_type
   use dondolo_base_text, only : to_text
   use dondolo_base_threads, only : check_threads, team_of
   use dondolo_base_warning, only : warnings_type
   use dondolo_boundary, only : as_solver, check_room, unpack_response
   use dondolo_case_event_warnings, only : warn_of_events
   use dondolo_case_motion_warnings, only : scale_warnings_type, warn_of_records
   use dondolo_case_wall_warnings, only : wall_warnings_type
   use dondolo_fragility_even_levels, only : settle_levels
   use dondolo_fragility_scaling, only : new_scaling, scaling_type, unscaled
   use dondolo_fragility_stripes, only : histories_of, plan_stripes, run_part, stripes_type
   use dondolo_fragility_study, only : make_study => new_study, study_type
   use dondolo_interface_handles, only : find_study, find_suite, find_walls, held_study_type, hold
   use dondolo_motion_ensemble, only : ensemble_type
   use dondolo_motion_solver, only : check_limit
   use dondolo_motion_work, only : work_type
   use dondolo_parcel, only : parcel_type, report, send
   use dondolo_record_rows, only : record_rows_type
   use dondolo_record_suite, only : suite_type
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: new_study, settle, choose_records, runs_of_records, plan, check_wall, run_block

contains

   !> A study: a suite and how walls are tried under it. Without a measure its levels are factors on the records
   subroutine new_study(suite, im, levels, m, polarity, engine, threads, rtol, atol, edp_limit, estimate_error, collapses_only, &
         & handle, failure)
      integer(c_int64_t), intent(in) :: suite
      character(len=*), intent(in) :: im, polarity, engine
      integer(c_int), intent(in) :: m, threads, estimate_error, collapses_only
      real(c_double), intent(in) :: levels(m), rtol, atol, edp_limit
      integer(c_int64_t), intent(out) :: handle
      integer(c_int64_t), intent(out) :: failure(5)
      type(suite_type), pointer :: records
      type(scaling_type) :: scaling
      type(held_study_type), pointer :: held
      class(*), pointer :: content
      type(error_type), allocatable :: error

      handle = 0
      call find_suite(suite, records, error)
      if (.not. allocated(error)) call check_threads(threads, error)
      if (.not. allocated(error)) then
         scaling = unscaled()
         if (len(im) > 0) call new_scaling(scaling, im, error)
      end if
      if (.not. allocated(error)) then
         allocate (held)
         held%suite = suite
         call make_study(held%study, records, scaling, levels, polarity, as_solver(engine, rtol, atol, edp_limit, &
            & estimate_error, collapses_only), threads)
         held%study%floors => held%floors
         call held%study%check_once(error)
         if (allocated(error)) then
            deallocate (held)
         else
            content => held
            call hold(content, handle)
         end if
      end if
      call report(error, failure)
   end subroutine new_study

   !> Levels as a case has them: a list that is equally spaced but for rounding becomes that of first, last and count
   subroutine settle(levels, m, settled)
      integer(c_int), intent(in) :: m
      real(c_double), intent(in) :: levels(m)
      real(c_double), intent(out) :: settled(m)

      settled = levels
      call settle_levels(settled)
   end subroutine settle

   !> Choose the records of each level: n rows of record (from 1), level and factor, as those of a catalogue; 0: every
   !> level, and a factor computed from the measure
   subroutine choose_records(study, record, level, factor, n, failure)
      integer(c_int64_t), intent(in) :: study
      integer(c_int), intent(in) :: n, record(n)
      real(c_double), intent(in) :: level(n), factor(n)
      integer(c_int64_t), intent(out) :: failure(5)
      type(study_type), pointer :: chosen
      type(record_rows_type) :: rows
      type(error_type), allocatable :: error
      integer :: i

      call find_study(study, chosen, error)
      if (.not. allocated(error)) then
         rows%have_levels = .true.
         rows%record = record
         rows%level = level
         rows%factor = factor
         do i = 1, n
            call rows%place%add('row '//to_text(i))
         end do
         call chosen%set_rows(rows, error)
      end if
      call report(error, failure)
   end subroutine choose_records

   !> Which of the n records run at each of the m levels of a study: 1 or 0
   subroutine runs_of_records(study, n, m, runs, failure)
      integer(c_int64_t), intent(in) :: study
      integer(c_int), intent(in) :: n, m
      integer(c_int), intent(out) :: runs(n, m)
      integer(c_int64_t), intent(out) :: failure(5)
      type(study_type), pointer :: chosen
      type(error_type), allocatable :: error
      integer :: i, j

      runs = 0
      call find_study(study, chosen, error)
      if (.not. allocated(error)) then
         do j = 1, m
            do i = 1, n
               if (chosen%runs(i, j)) runs(i, j) = 1
            end do
         end do
      end if
      call report(error, failure)
   end subroutine runs_of_records

   !> Check what stripes of walls would be, without running them, and what EDP thresholds make of them: whether walls of the same
   !> gravity and number of sides have the same plan; the warnings, those of the walls alone first, and how many these are; the
   !> histories of each wall in a stripe in which every record runs; of those of the last wall record (from 0) and polarity, the
   !> scales, stripe by stripe, and, unless all run at every level, which run
   subroutine plan(study, walls, w, thresholds, k, sent)
      integer(c_int64_t), intent(in) :: study, walls
      integer(c_int), intent(in) :: w, k
      real(c_double), intent(in) :: thresholds(k)
      integer(c_int64_t), intent(out) :: sent(5)
      type(study_type), pointer :: chosen
      type(wall_type), pointer :: wall(:)
      type(stripes_type) :: stripes
      type(scale_warnings_type) :: scales
      type(wall_warnings_type) :: wall_warnings
      type(warnings_type) :: warnings
      type(lines_type) :: found
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      integer :: histories(w), i, of_walls
      logical :: fresh

      call find_study(study, chosen, error)
      if (.not. allocated(error)) call find_walls(walls, wall, error)
      if (.not. allocated(error)) call chosen%check_motions(error)
      do i = 1, w
         if (allocated(error)) exit
         ! Of a wall, sides and gravity alone count in most plans: most walls of a population share one.
         fresh = i == 1 .or. chosen%scaling%needs_wall()
         if (.not. fresh) fresh = wall(i)%gravity < wall(i - 1)%gravity .or. wall(i)%gravity > wall(i - 1)%gravity &
            & .or. (wall(i)%mechanism%two_sided .neqv. wall(i - 1)%mechanism%two_sided)
         if (fresh) then
            call plan_stripes(stripes, wall(i), chosen, error)
         else
            call check_limit(chosen%solver, wall(i)%mechanism, error)
         end if
         if (allocated(error)) then
            if (w > 1) call add_place(error, 'wall '''//wall(i)%name()//'''')
            exit
         end if
         histories(i) = size(stripes%record)
         call scales%look(stripes, chosen, wall(i))
         call wall_warnings%look(wall(i))
      end do
      if (.not. allocated(error)) then
         call wall_warnings%warn(warnings, chosen%suite%records, thresholds)
         of_walls = warnings%count
         call warn_of_records(chosen%suite, wall(1)%gravity, warnings)
         ! Histories of one stripe whose level is the factor are points, not counts of clusters
         if (len(chosen%scaling%name) > 0) call warn_of_events(chosen%suite, warnings)
         call scales%warn(warnings)
         call parcel%put('is_shared', merge(0, 1, chosen%scaling%needs_wall()))
         call parcel%put('warnings_of_walls', of_walls)
         call parcel%put('histories', histories)
         call parcel%put('record', stripes%record - 1)
         call parcel%put('polarity', stripes%polarity)
         if (allocated(chosen%factor)) call parcel%put('ran', reshape(merge(1, 0, stripes%ran), [size(stripes%ran)]), &
            & shape(stripes%ran))
         call parcel%put('scale', reshape(stripes%scale, [size(stripes%scale)]), shape(stripes%scale))
         call warnings%put_objects(found)
         call parcel%put('warnings', found)
      end if
      call send(parcel, error, sent)
   end subroutine plan

   !> Check a wall whose plan is known from another wall; the parcel's lines are the warnings of the wall alone
   subroutine check_wall(study, walls, sent)
      integer(c_int64_t), intent(in) :: study, walls
      integer(c_int64_t), intent(out) :: sent(5)
      type(study_type), pointer :: chosen
      type(wall_type), pointer :: wall(:)
      type(wall_warnings_type) :: wall_warnings
      type(warnings_type) :: warnings
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      call find_study(study, chosen, error)
      if (.not. allocated(error)) call find_walls(walls, wall, error)
      if (.not. allocated(error)) call chosen%check(wall(1), error)
      if (.not. allocated(error)) then
         call wall_warnings%look(wall(1))
         call wall_warnings%warn(warnings, chosen%suite%records)
         call warnings%put_objects(parcel%lines)
      end if
      call send(parcel, error, sent)
   end subroutine check_wall

   !> Run `count` histories of walls `one` to `last`, which plan has checked, from number `first` of wall `one` on; they are
   !> numbered wall by wall and stripe by stripe. Counts of what was computed come in the order of work_names
   subroutine run_block(study, walls, one, last, first, count, edp, collapsed, impacts, time_of_peak, edp_error, work, &
         & failure)
      !f2py threadsafe
      integer(c_int64_t), intent(in) :: study, walls
      integer(c_int), intent(in) :: one, last, first, count
      real(c_double), intent(inout) :: edp(count), time_of_peak(count), edp_error(count)
      integer(c_int), intent(inout) :: collapsed(count), impacts(count)
      integer(c_int64_t), intent(out) :: work(8)
      integer(c_int64_t), intent(out) :: failure(5)
      type(study_type), pointer :: chosen
      type(wall_type), pointer :: wall(:)
      type(ensemble_type), allocatable :: part(:)
      type(work_type) :: total
      type(error_type), allocatable :: error, trouble
      integer, allocatable :: range(:, :)
      type(watched_type) :: watched
      integer :: i, k, left, crew, shared_out

      call get_watched(watched)
      call check_room(error, walls=last - one + 1, histories=real(count, c_double))
      if (.not. allocated(error)) call find_study(study, chosen, error)
      if (.not. allocated(error)) call find_walls(walls, wall, error)
      if (.not. allocated(error)) then
         allocate (part(one:last), range(2, one:last))
         left = count
         range(1, :) = 1
         range(1, one) = first
         do i = one, last
            range(2, i) = min(histories_of(chosen, wall(i)), range(1, i) + left - 1)
            left = left - (range(2, i) - range(1, i) + 1)
         end do
         ! As in run_rows: as many walls as go round evenly are shared out, all threads work on each of the others.
         crew = team_of(chosen%threads, huge(1))
         shared_out = last - modulo(last - one + 1, crew)
         !$omp parallel do schedule(dynamic) num_threads(crew) if(shared_out >= one) default(none) &
         !$omp & shared(one, shared_out, chosen, wall, range, part, watched, error) private(trouble)
         do i = one, shared_out
            call watch(watched)
            call run_part(part(i), wall(i), chosen, 1, range(:, i), trouble)
            if (.not. allocated(trouble)) cycle
            !$omp critical (note_trouble)
            call move_alloc(trouble, error)
            !$omp end critical (note_trouble)
         end do
         !$omp end parallel do
         do i = shared_out + 1, last
            if (.not. allocated(error)) call run_part(part(i), wall(i), chosen, chosen%threads, range(:, i), error)
         end do
      end if
      if (.not. allocated(error)) then
         k = 0
         do i = one, last
            call total%add(part(i)%work)
            associate (to => k + size(part(i)%response))
               call unpack_response(part(i)%response, edp(k + 1:to), collapsed(k + 1:to), impacts(k + 1:to), &
                  & time_of_peak(k + 1:to), edp_error(k + 1:to))
            end associate
            k = k + size(part(i)%response)
         end do
         call check_interrupt(error)
      end if
      work = total%counts()
      call report(error, failure)
   end subroutine run_block

end module stripes
