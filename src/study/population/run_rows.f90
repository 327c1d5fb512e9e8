!> Some rows of a population through the stripes.
!>
!> As many rows as go round evenly are shared out among the threads; on each of the others, all threads work together.
!> Results do not depend on it.
module dondolo_population_run_rows
   use, intrinsic :: omp_lib, only : omp_get_thread_num
   use dondolo_base_error, only : add_place, error_type
   use dondolo_base_interrupt, only : get_watched, watch, watched_type
   use dondolo_base_threads, only : team_of
   use dondolo_fragility_stripes, only : plan_stripes, run_histories, stripes_type
   use dondolo_fragility_study, only : study_type
   use dondolo_fragility_tie_tallies, only : tally_ties
   use dondolo_motion_queue, only : progress_interface
   use dondolo_motion_work, only : work_type
   use dondolo_population_row_result, only : row_result_type
   use dondolo_population_wall_row, only : wall_row_type
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: run_rows

contains

   !> Run some rows
   subroutine run_rows(study, rows, results, error, done, total, progress)
      !> What their walls are tried with
      type(study_type), intent(in) :: study
      type(wall_row_type), intent(in) :: rows(:)
      !> What came of them; their numbers in the population are not set
      type(row_result_type), allocatable, intent(out) :: results(:)
      !> What cannot be run: of the first such row
      type(error_type), allocatable, intent(out) :: error
      !> Histories that are done already, and those of the whole work
      integer, intent(in) :: done, total
      !> Hears how far the work is, after a row
      procedure(progress_interface), optional :: progress

      type(work_type) :: work
      type(watched_type) :: watched
      integer :: i, threads, shared_out, failed

      call get_watched(watched)
      allocate (results(size(rows)))
      failed = size(rows) + 1
      threads = team_of(study%threads, huge(1))
      shared_out = size(rows) - modulo(size(rows), threads)
      !$omp parallel do schedule(dynamic) num_threads(threads) if(shared_out > 0) default(none) &
      !$omp & shared(shared_out, watched)
      do i = 1, shared_out
         call watch(watched)
         call one_row(i, 1)
      end do
      !$omp end parallel do
      do i = shared_out + 1, size(rows)
         call one_row(i, threads)
      end do

   contains

      !> Run one row, unless one before it could not be run
      subroutine one_row(i, crew)
         !> Its number among these
         integer, intent(in) :: i
         !> Threads that work on it
         integer, intent(in) :: crew

         type(error_type), allocatable :: trouble
         integer :: first_failed, now

         !$omp atomic read
         first_failed = failed
         if (i > first_failed) return
         call run_row(study, rows(i)%wall, results(i), trouble, crew)
         !$omp critical (gather_row)
         if (.not. allocated(trouble)) then
            call work%add(results(i)%work)
         else if (i < failed) then
            !$omp atomic write
            failed = i
            call move_alloc(trouble, error)
         end if
         now = done + int(work%histories)
         !$omp end critical (gather_row)
         if (present(progress)) then
            if (omp_get_thread_num() == 0) call progress(now, total)
         end if
      end subroutine one_row

   end subroutine run_rows

   !> Run one row
   subroutine run_row(study, wall, row, error, threads)
      !> What its wall is tried with
      type(study_type), intent(in) :: study
      type(wall_type), intent(in) :: wall
      !> What came of it
      type(row_result_type), intent(out) :: row
      !> What cannot be run
      type(error_type), allocatable, intent(out) :: error
      !> Number of threads; 0: all
      integer, intent(in) :: threads

      type(stripes_type) :: stripes

      call plan_stripes(stripes, wall, study, error)
      if (.not. allocated(error)) call run_histories(stripes, wall, study, threads, error)
      if (allocated(error)) then
         call add_place(error, 'wall '''//wall%name()//'''')
         return
      end if
      row%work = stripes%work
      call row%set_flags(stripes%response, study%thresholds)
      row%ties = wall%mechanism%ties
      call tally_ties(wall%mechanism, stripes%response, stripes%ran, row%tallies)
      if (study%keeps_histories) call move_alloc(stripes%response, row%response)
   end subroutine run_row

end module dondolo_population_run_rows
