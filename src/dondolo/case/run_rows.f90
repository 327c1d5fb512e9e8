!> Some rows of a population: the histories of each, their counts and curves.
!>
!> As many rows as go round evenly are shared out among the threads; on each of the others, all threads work together.
!> Results do not depend on it.
module dondolo_run_rows
   use, intrinsic :: omp_lib, only : omp_get_thread_num
   use dondolo_case, only : case_type
   use dondolo_counts, only : counts_type
   use dondolo_ensemble, only : team_of
   use dondolo_error, only : add_place, error_type
   use dondolo_fragility, only : fit_fragility
   use dondolo_kinds, only : wp
   use dondolo_population, only : member_type
   use dondolo_queue, only : progress_interface
   use dondolo_solver, only : solver_type
   use dondolo_stripes, only : plan_stripes, run_histories, stripes_type
   use dondolo_survey, only : number_of_group
   use dondolo_wall, only : mechanism_names
   use dondolo_work, only : work_type
   implicit none
   private

   public :: run_rows

contains

   !> Run some rows
   subroutine run_rows(case, members, first, rows, work, error, team, done, progress)
      !> The case
      type(case_type), intent(in) :: case
      !> The rows
      type(member_type), intent(in) :: members(:)
      !> Number of the first of them in the population
      integer, intent(in) :: first
      !> Their counts and curves
      type(counts_type), allocatable, intent(out) :: rows(:)
      !> What was computed
      type(work_type), intent(out) :: work
      !> What cannot be run: of the first such row
      type(error_type), allocatable, intent(out) :: error
      !> Number of threads; 0: all
      integer, intent(in) :: team
      !> Histories of the case that are done already
      integer, intent(in) :: done
      !> Hears how far the work is, after a row
      procedure(progress_interface), optional :: progress

      integer :: i, threads, shared_out, failed

      allocate (rows(size(members)))
      failed = size(members) + 1
      threads = team_of(team, huge(1))
      shared_out = size(members) - modulo(size(members), threads)
      !$omp parallel do schedule(dynamic) num_threads(threads) if(shared_out > 0) default(none) shared(shared_out)
      do i = 1, shared_out
         call one_row(i, 1)
      end do
      !$omp end parallel do
      do i = shared_out + 1, size(members)
         call one_row(i, threads)
      end do

   contains

      !> Run one row, unless one before it could not be run
      subroutine one_row(i, crew)
         !> Its number among these
         integer, intent(in) :: i
         !> Threads that work on it
         integer, intent(in) :: crew

         type(work_type) :: own
         type(error_type), allocatable :: trouble
         integer :: first_failed, now

         !$omp atomic read
         first_failed = failed
         if (i > first_failed) return
         call run_row(case, members(i), rows(i), own, trouble, crew)
         rows(i)%row = first + i - 1
         !$omp critical (gather_row)
         if (.not. allocated(trouble)) then
            call work%add(own)
         else if (i < failed) then
            !$omp atomic write
            failed = i
            call move_alloc(trouble, error)
         end if
         now = done + int(work%histories)
         !$omp end critical (gather_row)
         if (present(progress)) then
            if (omp_get_thread_num() == 0) call progress(now, int(case%survey%histories))
         end if
      end subroutine one_row

   end subroutine run_rows

   !> Run one row
   subroutine run_row(case, member, row, work, error, team)
      !> The case
      type(case_type), intent(in) :: case
      !> The row
      type(member_type), intent(in) :: member
      !> Its counts and curves
      type(counts_type), intent(out) :: row
      !> What was computed
      type(work_type), intent(out) :: work
      !> What cannot be run
      type(error_type), allocatable, intent(out) :: error
      !> Number of threads; 0: all
      integer, intent(in) :: team

      type(stripes_type) :: stripes
      type(solver_type) :: solver
      real(wp), allocatable :: histories(:)
      integer :: k

      row%continues = member%continues
      row%mechanism = findloc(mechanism_names == member%wall%mechanism_name(), .true., dim=1)
      row%group = number_of_group(case%survey%groups, member%group)
      row%weight = member%weight
      row%p_occ = member%p_occ
      associate (thresholds => case%stripes%thresholds)
         solver = case%solver%solver
         solver%collapses_only = size(thresholds) == 1 .and. .not. case%job%histories
         call plan_stripes(stripes, member%wall, case%records, case%stripes%levels, case%stripes%scaling, case%values, &
            & case%peaks, case%records_input%polarity, solver, error)
         if (.not. allocated(error)) then
            call run_histories(stripes, member%wall, case%records, case%record_set, solver, 1, size(stripes%response), &
               & team)
            row%histories = size(stripes%record)
            allocate (row%reached(size(stripes%levels), size(thresholds)), row%curve(size(thresholds)))
            histories = spread(real(row%histories, wp), 1, size(stripes%levels))
            do k = 1, size(thresholds)
               row%reached(:, k) = stripes%exceedances(thresholds(k))
               call fit_fragility(row%curve(k), stripes%levels, real(row%reached(:, k), wp), histories, error)
               if (allocated(error)) exit
            end do
            work = stripes%work
            if (case%job%histories) call move_alloc(stripes%response, row%response)
         end if
         call add_place(error, 'wall '''//member%wall%name()//'''')
      end associate
   end subroutine run_row

end module dondolo_run_rows
