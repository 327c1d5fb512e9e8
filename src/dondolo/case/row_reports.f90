!> Tables of a population, row by row, as they come out of its table and of the files of counts.
module dondolo_row_reports
   use dondolo_case, only : case_type
   use dondolo_counts, only : counts_type
   use dondolo_counts_stream, only : counts_stream_type
   use dondolo_error, only : error_type, raise_failure
   use dondolo_population, only : member_type, population_reader_type
   use dondolo_report_rows, only : fragility_head, fragility_row, history_head, history_row, stripes_head, &
      & stripes_row, wall_cells, wall_head, wall_row
   use dondolo_result_files, only : result_files_type
   use dondolo_stripes, only : plan_stripes, stripes_type
   implicit none
   private

   public :: write_rows

contains

   !> Write one table of a population
   subroutine write_rows(case, counts, name, files, error)
      !> The case
      type(case_type), intent(in) :: case
      !> Counts of all rows
      type(counts_stream_type), intent(inout) :: counts
      !> What the name of the file ends with
      character(len=*), intent(in) :: name
      !> Files, one of which was begun
      type(result_files_type), intent(inout) :: files
      !> The population or the counts have changed
      type(error_type), allocatable, intent(out) :: error

      type(population_reader_type) :: reader
      type(member_type) :: member
      type(counts_type) :: row
      logical :: found, is_there

      select case (name)
      case ('_walls.csv')
         call files%line(wall_head)
      case ('_histories.csv')
         call files%line(history_head)
      case ('_stripes.csv')
         call files%line(stripes_head)
      case ('_fragility.csv')
         call files%line(fragility_head)
      end select
      call counts%open(error)
      if (.not. allocated(error)) &
         & call reader%open(case%population_path(), error, case%solver%gravity, checks_names=.false.)
      do while (.not. allocated(error))
         call reader%next(member, found, error)
         if (.not. allocated(error)) call counts%next(row, is_there, error)
         if (allocated(error)) exit
         if (found .neqv. is_there) call raise_failure(error, case%population_path()//': has changed while it was read')
         if (allocated(error) .or. .not. found) exit
         select case (name)
         case ('_walls.csv')
            call files%line(wall_row(member))
         case ('_histories.csv')
            call write_histories(case, member, row, files, error)
         case ('_stripes.csv')
            call write_stripes(case, member, row, files)
         case ('_fragility.csv')
            call write_fragility(case, member, row, files)
         end select
      end do
      call reader%close()
   end subroutine write_rows

   !> All histories of a row
   subroutine write_histories(case, member, row, files, error)
      !> The case
      type(case_type), intent(in) :: case
      !> The row
      type(member_type), intent(in) :: member
      !> Its counts
      type(counts_type), intent(in) :: row
      !> Files
      type(result_files_type), intent(inout) :: files
      !> They cannot be chosen again
      type(error_type), allocatable, intent(out) :: error

      type(stripes_type) :: plan
      character(len=:), allocatable :: cells
      integer :: i, j

      call plan_stripes(plan, member%wall, case%records, case%stripes%levels, case%stripes%scaling, case%values, &
         & case%peaks, case%records_input%polarity, case%solver%solver, error)
      if (allocated(error)) return
      cells = wall_cells(member%wall)
      do j = 1, size(plan%levels)
         do i = 1, size(plan%record)
            call files%line(history_row(cells, case%records(plan%record(i))%name, plan%polarity(i), plan%im, &
               & plan%levels(j), plan%scale(i, j), row%response(i, j)))
         end do
      end do
   end subroutine write_histories

   !> Histories of a row that reach each threshold at every level
   subroutine write_stripes(case, member, row, files)
      !> The case
      type(case_type), intent(in) :: case
      !> The row
      type(member_type), intent(in) :: member
      !> Its counts
      type(counts_type), intent(in) :: row
      !> Files
      type(result_files_type), intent(inout) :: files

      integer :: j, k

      do k = 1, size(case%stripes%thresholds)
         do j = 1, size(case%stripes%levels)
            call files%line(stripes_row(wall_cells(member%wall), case%stripes%scaling%name, case%stripes%levels(j), &
               & row%histories, row%reached(j, k), case%stripes%thresholds(k)))
         end do
      end do
   end subroutine write_stripes

   !> Curves of a row
   subroutine write_fragility(case, member, row, files)
      !> The case
      type(case_type), intent(in) :: case
      !> The row
      type(member_type), intent(in) :: member
      !> Its counts
      type(counts_type), intent(in) :: row
      !> Files
      type(result_files_type), intent(inout) :: files

      integer :: k

      do k = 1, size(case%stripes%thresholds)
         call files%line(fragility_row(wall_cells(member%wall), case%stripes%scaling%name, row%curve(k), &
            & case%stripes%thresholds(k)))
      end do
   end subroutine write_fragility

end module dondolo_row_reports
