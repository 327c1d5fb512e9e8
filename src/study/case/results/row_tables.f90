!> Tables of walls, row by row: of the one wall of a case, or of a population as its rows come out of its table and of the
!> files of counts.
module dondolo_case_row_tables
   use dondolo_base_error, only : error_type
   use dondolo_case, only : case_type
   use dondolo_case_check_rows, only : check_wall, count_verdict, put_check, verdicts_type
   use dondolo_case_job_group, only : stripes_task, typology_task
   use dondolo_case_report_rows, only : put_certified, put_fragility, put_history, put_names, put_stripe, put_wall
   use dondolo_case_results, only : results_type, row_counts_type
   use dondolo_case_table, only : table_type
   use dondolo_case_tie_rows, only : put_tally
   use dondolo_check_sheet, only : sheet_type
   use dondolo_fragility_stripes, only : mark_lifts, plan_stripes, stripes_type
   use dondolo_fragility_study, only : study_type
   use dondolo_population_reader, only : population_reader_type
   use dondolo_population_row_result, only : row_result_type
   use dondolo_population_store, only : read_result
   use dondolo_population_wall_row, only : wall_row_type
   implicit none
   private

   public :: row_interface, each_row
   public :: put_wall_row, put_history_rows, put_stripe_rows, put_fragility_rows, put_tie_rows, put_check_row

   abstract interface

      !> Put the rows of a table for a row of a population, or for the one wall of a case
      subroutine row_interface(case, row, counts, verdicts, table, error)
         import :: case_type, wall_row_type, row_counts_type, verdicts_type, table_type, error_type
         type(case_type), intent(in), target :: case
         type(wall_row_type), intent(in) :: row
         type(row_counts_type), intent(in) :: counts
         !> Counts of what came of the checks
         type(verdicts_type), intent(inout) :: verdicts
         class(table_type), intent(inout) :: table
         type(error_type), allocatable, intent(out) :: error
      end subroutine row_interface

   end interface

contains

   !> Put each row of a population, or the one wall of a case
   subroutine each_row(case, results, put_row, is_stored, table, error)
      type(case_type), intent(in), target :: case
      !> Its verdicts are counted, if the table has any
      type(results_type), intent(inout) :: results
      procedure(row_interface) :: put_row
      !> Whether the rows need more than counts and curves: their histories, or what happens to their ties
      logical, intent(in) :: is_stored
      class(table_type), intent(inout) :: table
      !> A store has changed, or histories cannot be chosen again
      type(error_type), allocatable, intent(out) :: error

      type(population_reader_type) :: reader
      type(wall_row_type) :: row
      type(row_counts_type) :: counts
      type(verdicts_type) :: verdicts
      integer :: i
      logical :: found

      if (case%job%task /= typology_task) then
         row%wall = case%wall
         row%group = ''
         row%facade = ''
         row%alternative = ''
         call put_row(case, row, results%row, verdicts, table, error)
         return
      end if
      reader%names%is_checked = .false.
      do i = 1, results%population%rows
         call reader%next(case%table, row, found, error)
         if (allocated(error)) exit
         counts%histories = results%population%histories(:, i)
         counts%reached = results%population%reached(:, :, i)
         counts%curve = results%population%curve(:, i)
         if (is_stored) call read_stored(results, i, counts, error)
         if (.not. allocated(error)) call put_row(case, row, counts, verdicts, table, error)
         if (allocated(error)) exit
      end do
      call results%stores%close()
      if (verdicts%checked + verdicts%others > 0) results%verdicts = verdicts
   end subroutine each_row

   !> What a store has of a row of a population
   subroutine read_stored(results, number, counts, error)
      type(results_type), intent(inout) :: results
      !> Number of the row
      integer, intent(in) :: number
      !> Counts and curves of the row: what happens to its ties is set, and its histories if they are kept
      type(row_counts_type), intent(inout) :: counts
      !> A store has changed
      type(error_type), allocatable, intent(out) :: error

      type(row_result_type) :: stored

      call read_result(results%stores, number, stored, error)
      if (allocated(error)) return
      call move_alloc(stored%tallies, counts%tallies)
      if (allocated(counts%response)) deallocate (counts%response)
      if (allocated(stored%response)) call move_alloc(stored%response, counts%response)
   end subroutine read_stored

   !> A wall
   subroutine put_wall_row(case, row, counts, verdicts, table, error)
      type(case_type), intent(in), target :: case
      type(wall_row_type), intent(in) :: row
      type(row_counts_type), intent(in) :: counts
      type(verdicts_type), intent(inout) :: verdicts
      class(table_type), intent(inout) :: table
      type(error_type), allocatable, intent(out) :: error

      integer, allocatable :: lengths(:)

      if (case%job%task == typology_task) then
         lengths = case%survey%lengths
      else
         lengths = case%wall%input%lengths()
      end if
      call put_wall(table, row, lengths, case%survey%has_facades, case%survey%has_alternatives, case%table%notes)
      call table%end_row()
   end subroutine put_wall_row

   !> All histories of a row
   subroutine put_history_rows(case, row, counts, verdicts, table, error)
      type(case_type), intent(in), target :: case
      type(wall_row_type), intent(in) :: row
      type(row_counts_type), intent(in) :: counts
      type(verdicts_type), intent(inout) :: verdicts
      class(table_type), intent(inout) :: table
      !> They cannot be chosen again
      type(error_type), allocatable, intent(out) :: error

      type(study_type) :: study
      type(stripes_type) :: plan
      logical, allocatable :: lifts(:, :)
      integer :: i, j

      call case%make_study(study)
      call plan_stripes(plan, row%wall, study, error)
      if (allocated(error)) return
      if (tells_uplift(case)) call mark_lifts(plan, case%suite%falls, row%wall%gravity, lifts)
      do j = 1, size(plan%levels)
         do i = 1, size(plan%record)
            if (.not. plan%ran(i, j)) cycle
            call put_names(table, row%wall%name(), row%wall%mechanism_name())
            call put_history(table, case%suite%records(plan%record(i))%name, plan%polarity(i), plan%im, plan%levels(j), &
               & plan%scale(i, j), counts%response(i, j))
            if (case%solver%solver%estimate_error) call table%put('edp_error', counts%response(i, j)%edp_error)
            if (case%solver%solver%certify) call put_certified(table, counts%certified(i, j))
            if (allocated(lifts)) call table%put('uplift', lifts(i, j))
            call table%end_row()
         end do
      end do
   end subroutine put_history_rows

   !> Do the tables say in which histories the ground falls away from the wall? Those of one wall do
   pure logical function tells_uplift(case)
      type(case_type), intent(in) :: case

      tells_uplift = case%job%task == stripes_task .and. case%suite%has_vertical
   end function tells_uplift

   !> Histories of a row that reach each threshold at every level
   subroutine put_stripe_rows(case, row, counts, verdicts, table, error)
      type(case_type), intent(in), target :: case
      type(wall_row_type), intent(in) :: row
      type(row_counts_type), intent(in) :: counts
      type(verdicts_type), intent(inout) :: verdicts
      class(table_type), intent(inout) :: table
      type(error_type), allocatable, intent(out) :: error

      integer :: j, k

      do k = 1, size(case%stripes%thresholds)
         do j = 1, size(case%stripes%levels)
            call put_names(table, row%wall%name(), row%wall%mechanism_name())
            call put_stripe(table, case%stripes%scaling%name, case%stripes%levels(j), counts%histories(j), counts%reached(j, k), &
               & case%stripes%thresholds(k))
            if (allocated(counts%uplift)) call table%put('uplift', counts%uplift(j))
            call table%end_row()
         end do
      end do
   end subroutine put_stripe_rows

   !> Curves of a row
   subroutine put_fragility_rows(case, row, counts, verdicts, table, error)
      type(case_type), intent(in), target :: case
      type(wall_row_type), intent(in) :: row
      type(row_counts_type), intent(in) :: counts
      type(verdicts_type), intent(inout) :: verdicts
      class(table_type), intent(inout) :: table
      type(error_type), allocatable, intent(out) :: error

      integer :: k

      do k = 1, size(case%stripes%thresholds)
         call put_names(table, row%wall%name(), row%wall%mechanism_name())
         call put_fragility(table, case%stripes%scaling%name, counts%curve(k), case%stripes%thresholds(k))
         call table%end_row()
      end do
   end subroutine put_fragility_rows

   !> What the histories of a wall do to its ties
   subroutine put_tie_rows(case, row, counts, verdicts, table, error)
      type(case_type), intent(in), target :: case
      type(wall_row_type), intent(in) :: row
      type(row_counts_type), intent(in) :: counts
      type(verdicts_type), intent(inout) :: verdicts
      class(table_type), intent(inout) :: table
      type(error_type), allocatable, intent(out) :: error

      integer :: i, j

      if (row%wall%mechanism%ties == 0) return
      do j = 1, size(case%stripes%levels)
         do i = 1, size(counts%tallies, 1)
            call put_names(table, row%wall%name(), row%wall%mechanism_name())
            call put_tally(table, case%stripes%scaling%name, case%stripes%levels(j), i, counts%tallies(i, j), counts%histories(j))
            call table%end_row()
         end do
      end do
   end subroutine put_tie_rows

   !> The check of a wall by a building code
   subroutine put_check_row(case, row, counts, verdicts, table, error)
      type(case_type), intent(in), target :: case
      type(wall_row_type), intent(in) :: row
      type(row_counts_type), intent(in) :: counts
      type(verdicts_type), intent(inout) :: verdicts
      class(table_type), intent(inout) :: table
      type(error_type), allocatable, intent(out) :: error

      type(sheet_type) :: sheet
      type(error_type), allocatable :: reason

      call put_names(table, row%wall%name(), row%wall%mechanism_name())
      call check_wall(row%wall, case%check, case%stripes%scaling%name, sheet, reason, counts%curve(size(counts%curve)))
      call count_verdict(verdicts, row, sheet, .not. allocated(reason))
      call put_check(table, row%group, sheet, reason)
      call table%end_row()
   end subroutine put_check_row

end module dondolo_case_row_tables
