!> A population through the stripes, block after block, so that memory holds the histories of one block only: rows that a
!> store lacks are read, run, and put into it.
module dondolo_population_run_population
   use dondolo_base_error, only : error_type
   use dondolo_base_interrupt, only : check_interrupt
   use dondolo_base_text, only : to_text
   use dondolo_base_threads, only : team_of
   use dondolo_fragility_study, only : study_type
   use dondolo_motion_queue, only : progress_interface
   use dondolo_population_reader, only : population_reader_type
   use dondolo_population_row_result, only : row_result_type
   use dondolo_population_run_rows, only : run_rows
   use dondolo_population_store, only : store_type
   use dondolo_population_table, only : population_table_type
   use dondolo_population_wall_row, only : wall_row_type
   implicit none
   private

   public :: run_population

   !> Histories that a block has for each thread: a second or two of work, which is what a run that is killed loses
   integer, parameter :: histories_of_thread = 100000

   !> Rows that it has for each thread at most: about 4 kB each
   integer, parameter :: rows_of_thread = 1000

contains

   !> Run the rows that a store lacks
   subroutine run_population(study, table, store, histories, error, progress)
      !> What the walls are tried with
      type(study_type), intent(in) :: study
      !> The table of walls, which was checked
      type(population_table_type), intent(in) :: table
      !> The store, claimed; complete at the end
      type(store_type), intent(inout) :: store
      !> Histories of all rows that the store is for
      integer, intent(in) :: histories
      !> What cannot be run
      type(error_type), allocatable, intent(out) :: error
      !> Hears how far the work is, in histories
      procedure(progress_interface), optional :: progress

      type(population_reader_type) :: reader
      type(wall_row_type), allocatable :: rows(:)
      type(row_result_type), allocatable :: results(:)
      integer, allocatable :: numbers(:)
      integer :: block

      block = block_size(study, histories, store%identity%last - store%identity%first + 1)
      reader%names%is_checked = .false.
      do while (.not. allocated(error))
         call read_block(reader, table, store, block, rows, numbers, error)
         if (allocated(error) .or. size(rows) == 0) exit
         call run_rows(study, rows, results, error, int(store%work%histories), histories, progress)
         if (allocated(error)) exit
         call check_interrupt(error)
         if (allocated(error)) then
            error%message = error%message//': '//to_text(store%done)//' of '// &
               & to_text(store%identity%last - store%identity%first + 1)//' rows are '
            if (len(store%path) == 0) error%message = error%message//'complete'
            if (len(store%path) > 0) error%message = error%message//'kept in '//store%path// &
               & '; the same command resumes from there'
            exit
         end if
         results%row = numbers
         call store%put(results, error)
      end do
      if (present(progress) .and. .not. allocated(error)) call progress(histories, histories)
   end subroutine run_population

   !> Read the next rows that a store lacks
   subroutine read_block(reader, table, store, most, rows, numbers, error)
      type(population_reader_type), intent(inout) :: reader
      type(population_table_type), intent(in) :: table
      type(store_type), intent(in) :: store
      !> How many at most
      integer, intent(in) :: most
      !> The rows; none at the end
      type(wall_row_type), allocatable, intent(out) :: rows(:)
      !> Their numbers
      integer, allocatable, intent(out) :: numbers(:)
      !> A row that is wrong
      type(error_type), allocatable, intent(out) :: error

      integer :: i, row
      logical :: found

      allocate (numbers(min(most, store%identity%last)))
      i = 0
      do row = max(reader%row, store%identity%first - 1) + 1, store%identity%last
         if (i == size(numbers)) exit
         if (store%has(row)) cycle
         i = i + 1
         numbers(i) = row
      end do
      numbers = numbers(:i)
      allocate (rows(i))
      do i = 1, size(numbers)
         call reader%skip(table, numbers(i) - 1 - reader%row, error)
         if (.not. allocated(error)) call reader%next(table, rows(i), found, error)
         if (allocated(error)) return
      end do
   end subroutine read_block

   !> Rows of a block, a multiple of the number of threads
   integer function block_size(study, histories, rows)
      !> What the walls are tried with
      type(study_type), intent(in) :: study
      !> Histories of all rows
      integer, intent(in) :: histories
      !> Number of rows
      integer, intent(in) :: rows

      integer :: threads

      threads = team_of(study%threads, huge(1))
      block_size = threads*min(rows_of_thread, max(1, histories_of_thread/max(1, histories/rows)))
   end function block_size

end module dondolo_population_run_population
