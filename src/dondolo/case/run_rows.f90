!> Some rows of a population: the histories of each, their counts and curves.
!>
!> As many rows as go round evenly are shared out among the threads; on each of the others, all threads work together.
!> Results do not depend on it.
module dondolo_run_rows
   use, intrinsic :: omp_lib, only : omp_get_thread_num
   use dondolo_counts, only : counts_type
   use dondolo_error, only : add_place, error_type
   use dondolo_population, only : member_type
   use dondolo_queue, only : progress_interface
   use dondolo_stripes, only : plan_stripes, run_histories, stripes_type
   use dondolo_study, only : study_type
   use dondolo_threads, only : team_of
   use dondolo_wall, only : mechanism_names
   use dondolo_work, only : work_type
   implicit none
   private

   public :: run_rows

contains

   !> Run some rows
   subroutine run_rows(study, members, rows, work, error, done, total, progress)
      !> What their walls are tried with
      type(study_type), intent(in) :: study
      !> The rows
      type(member_type), intent(in) :: members(:)
      !> Their counts and curves; their numbers and groups are not set
      type(counts_type), allocatable, intent(out) :: rows(:)
      !> What was computed
      type(work_type), intent(out) :: work
      !> What cannot be run: of the first such row
      type(error_type), allocatable, intent(out) :: error
      !> Histories that are done already, and those of the whole work
      integer, intent(in) :: done, total
      !> Hears how far the work is, after a row
      procedure(progress_interface), optional :: progress

      integer :: i, threads, shared_out, failed

      allocate (rows(size(members)))
      failed = size(members) + 1
      threads = team_of(study%threads, huge(1))
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
         call run_row(study, members(i), rows(i), own, trouble, crew)
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
            if (omp_get_thread_num() == 0) call progress(now, total)
         end if
      end subroutine one_row

   end subroutine run_rows

   !> Run one row
   subroutine run_row(study, member, row, work, error, team)
      !> What its wall is tried with
      type(study_type), intent(in) :: study
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

      row%continues = member%continues
      row%mechanism = findloc(mechanism_names == member%wall%mechanism_name(), .true., dim=1)
      row%weight = member%weight
      row%p_occ = member%p_occ
      call plan_stripes(stripes, member%wall, study, error)
      if (.not. allocated(error)) then
         call run_histories(stripes, member%wall, study, team)
         call row%of(stripes, study%thresholds, error)
         work = stripes%work
         if (study%keeps_histories) call move_alloc(stripes%response, row%response)
      end if
      call add_place(error, 'wall '''//member%wall%name()//'''')
   end subroutine run_row

end module dondolo_run_rows
