!> Tables of walls, row by row: of the one wall of a case, or of a population as its rows come out of its table and of the
!> files of counts.
module dondolo_row_reports
   use dondolo_case, only : case_type
   use dondolo_check_rows, only : check_row_head, make_check_row
   use dondolo_csv_row, only : text_cell
   use dondolo_error, only : error_type, raise_failure
   use dondolo_member, only : member_type
   use dondolo_population, only : population_reader_type
   use dondolo_report_rows, only : certified_head, fragility_head, history_head, make_certified_cells, make_fragility_row, &
      & make_history_row, make_stripes_row, make_wall_cells, make_wall_head, make_wall_row, stripes_head, &
      & uplift_head
   use dondolo_result_files, only : result_files_type
   use dondolo_results, only : results_type, row_counts_type
   use dondolo_row_result, only : row_result_type
   use dondolo_stripes, only : find_lifts, plan_stripes, stripes_type
   use dondolo_study, only : study_type
   use dondolo_text, only : to_table, to_text
   use dondolo_tie_rows, only : make_tie_row, tie_head
   implicit none
   private

   public :: write_rows, write_one_row

contains

   !> Write one table of a population
   subroutine write_rows(case, results, name, files, error)
      type(case_type), intent(in) :: case
      type(results_type), intent(inout) :: results
      !> What the name of the file ends with
      character(len=*), intent(in) :: name
      !> Files, one of which was begun
      type(result_files_type), intent(inout) :: files
      !> The population or a store has changed
      type(error_type), allocatable, intent(out) :: error

      type(population_reader_type) :: reader
      type(member_type) :: member
      type(row_counts_type) :: row
      character(len=:), allocatable :: line
      integer :: i
      logical :: found

      call write_names(case, name, files)
      call reader%open(case%population_path(), error, case%solver%gravity, is_checked=.false., &
         & facade=case%facade)
      associate (population => results%population)
         do i = 1, population%rows() + 1
            if (allocated(error)) exit
            call reader%next(member, found, error)
            if (.not. allocated(error) .and. (found .neqv. i <= population%rows())) then
               call raise_failure(error, case%population_path()//': has changed while it was read')
            end if
            if (allocated(error) .or. .not. found) exit
            row%histories = population%histories(:, i)
            row%reached = population%reached(:, :, i)
            row%curve = population%curve(:, i)
            if (name == '_histories.csv' .or. (name == '_ties.csv' .and. member%wall%mechanism%ties > 0)) then
               call read_stored(results, i, row, error)
            end if
            if (allocated(error)) exit
            if (name == '_checks.csv') then
               call make_check_row(case, member, row%curve(size(row%curve)), results%verdicts, line)
               call files%line(line)
            else
               call write_row(case, member, row, name, files, error)
            end if
         end do
      end associate
      call reader%close()
      do i = 1, size(results%stores)
         call results%stores(i)%close()
      end do
   end subroutine write_rows

   !> What a store has of a row of a population
   subroutine read_stored(results, number, row, error)
      type(results_type), intent(inout) :: results
      !> Number of the row
      integer, intent(in) :: number
      !> The row: what happens to its ties is set, and its histories if they are kept
      type(row_counts_type), intent(inout) :: row
      !> A store has changed
      type(error_type), allocatable, intent(out) :: error

      type(row_result_type) :: stored
      integer :: k

      do k = 1, size(results%stores) - 1
         if (number <= results%stores(k)%identity%last) exit
      end do
      call results%stores(k)%read(number, stored, error)
      if (allocated(error)) return
      call move_alloc(stored%tallies, row%tallies)
      if (allocated(row%response)) deallocate (row%response)
      if (allocated(stored%response)) call move_alloc(stored%response, row%response)
   end subroutine read_stored

   !> Write one table of the one wall of a case
   subroutine write_one_row(case, row, name, files, error)
      type(case_type), intent(in) :: case
      !> Counts of the wall, with all its histories
      type(row_counts_type), intent(in) :: row
      !> What the name of the file ends with
      character(len=*), intent(in) :: name
      !> Files, one of which was begun
      type(result_files_type), intent(inout) :: files
      !> The histories cannot be chosen again
      type(error_type), allocatable, intent(out) :: error

      type(member_type) :: member

      member%wall = case%wall
      member%group = ''
      member%facade = ''
      call write_names(case, name, files)
      call write_row(case, member, row, name, files, error)
   end subroutine write_one_row

   !> Names of the columns of a table
   subroutine write_names(case, name, files)
      type(case_type), intent(in) :: case
      !> What the name of the file ends with
      character(len=*), intent(in) :: name
      type(result_files_type), intent(inout) :: files

      character(len=:), allocatable :: line

      select case (name)
      case ('_walls.csv')
         call make_wall_head(list_lengths(case), case%survey%has_facades, line)
         call files%line(line)
      case ('_histories.csv')
         line = history_head
         if (case%solver%solver%estimate_error) line = line//',edp_error'
         if (case%solver%solver%certify) line = line//certified_head
         if (tells_uplift(case)) line = line//uplift_head
         call files%line(line)
      case ('_stripes.csv')
         line = stripes_head
         if (tells_uplift(case)) line = line//uplift_head
         call files%line(line)
      case ('_fragility.csv')
         call files%line(fragility_head)
      case ('_ties.csv')
         call files%line(tie_head)
      case ('_checks.csv')
         call files%line(check_row_head)
      end select
   end subroutine write_names

   !> Do the tables say in which histories the ground falls away from the wall? Those of one wall do
   pure logical function tells_uplift(case)
      type(case_type), intent(in) :: case

      tells_uplift = case%job%task == 'stripes' .and. case%suite%has_vertical
   end function tells_uplift

   !> How many values each property of the walls has at most
   function list_lengths(case) result(lengths)
      type(case_type), intent(in) :: case
      !> Their numbers, in the order of the table of properties
      integer, allocatable :: lengths(:)

      if (case%job%task == 'typology') then
         lengths = case%survey%lengths
      else
         lengths = case%wall%input%lengths()
      end if
   end function list_lengths

   !> Lines of a wall, or of one of its mechanisms, in a table
   subroutine write_row(case, member, row, name, files, error)
      type(case_type), intent(in) :: case
      type(member_type), intent(in) :: member
      type(row_counts_type), intent(in) :: row
      !> What the name of the file ends with
      character(len=*), intent(in) :: name
      type(result_files_type), intent(inout) :: files
      !> Its histories cannot be chosen again
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: line

      select case (name)
      case ('_walls.csv')
         call make_wall_row(member, list_lengths(case), case%survey%has_facades, case%job%spreadsheet_safe, line)
         call files%line(line)
      case ('_histories.csv')
         call write_histories(case, member, row, files, error)
      case ('_stripes.csv')
         call write_stripes(case, member, row, files)
      case ('_fragility.csv')
         call write_fragility(case, member, row, files)
      case ('_ties.csv')
         call write_ties(case, member, row, files)
      end select
   end subroutine write_row

   !> All histories of a row
   subroutine write_histories(case, member, row, files, error)
      type(case_type), intent(in), target :: case
      type(member_type), intent(in) :: member
      type(row_counts_type), intent(in) :: row
      type(result_files_type), intent(inout) :: files
      !> They cannot be chosen again
      type(error_type), allocatable, intent(out) :: error

      type(study_type) :: study
      type(stripes_type) :: plan
      character(len=:), allocatable :: cells, line, last, certified
      logical, allocatable :: lifts(:, :)
      integer :: i, j

      call case%make_study(study)
      call plan_stripes(plan, member%wall, study, error)
      if (allocated(error)) return
      if (tells_uplift(case)) call find_lifts(plan, case%suite%falls, member%wall%gravity, lifts)
      call make_wall_cells(member%wall, case%job%spreadsheet_safe, cells)
      do j = 1, size(plan%levels)
         do i = 1, size(plan%record)
            if (.not. plan%ran(i, j)) cycle
            last = ''
            if (case%solver%solver%estimate_error) last = ','//to_table(row%response(i, j)%edp_error)
            if (case%solver%solver%certify) then
               call make_certified_cells(row%certified(i, j), certified)
               last = last//certified
            end if
            if (allocated(lifts)) last = last//','//to_text(merge(1, 0, lifts(i, j)))
            call make_history_row(cells, text_cell(case%suite%records(plan%record(i))%name, &
               & case%job%spreadsheet_safe), plan%polarity(i), plan%im, &
               & plan%levels(j), plan%scale(i, j), row%response(i, j), line)
            call files%line(line//last)
         end do
      end do
   end subroutine write_histories

   !> What the histories of a wall do to its ties
   subroutine write_ties(case, member, row, files)
      type(case_type), intent(in) :: case
      type(member_type), intent(in) :: member
      type(row_counts_type), intent(in) :: row
      type(result_files_type), intent(inout) :: files

      character(len=:), allocatable :: cells, line
      integer :: i, j

      if (member%wall%mechanism%ties == 0) return
      call make_wall_cells(member%wall, case%job%spreadsheet_safe, cells)
      do j = 1, size(case%stripes%levels)
         do i = 1, size(row%tallies, 1)
            call make_tie_row(cells, case%stripes%scaling%name, case%stripes%levels(j), i, row%tallies(i, j), &
               & row%histories(j), line)
            call files%line(line)
         end do
      end do
   end subroutine write_ties

   !> Histories of a row that reach each threshold at every level
   subroutine write_stripes(case, member, row, files)
      type(case_type), intent(in) :: case
      type(member_type), intent(in) :: member
      type(row_counts_type), intent(in) :: row
      type(result_files_type), intent(inout) :: files

      character(len=:), allocatable :: cells, line
      integer :: j, k

      call make_wall_cells(member%wall, case%job%spreadsheet_safe, cells)
      do k = 1, size(case%stripes%thresholds)
         do j = 1, size(case%stripes%levels)
            call make_stripes_row(cells, case%stripes%scaling%name, case%stripes%levels(j), row%histories(j), &
               & row%reached(j, k), case%stripes%thresholds(k), line)
            if (allocated(row%uplift)) line = line//','//to_text(row%uplift(j))
            call files%line(line)
         end do
      end do
   end subroutine write_stripes

   !> Curves of a row
   subroutine write_fragility(case, member, row, files)
      type(case_type), intent(in) :: case
      type(member_type), intent(in) :: member
      type(row_counts_type), intent(in) :: row
      type(result_files_type), intent(inout) :: files

      character(len=:), allocatable :: cells, line
      integer :: k

      call make_wall_cells(member%wall, case%job%spreadsheet_safe, cells)
      do k = 1, size(case%stripes%thresholds)
         call make_fragility_row(cells, case%stripes%scaling%name, row%curve(k), case%stripes%thresholds(k), line)
         call files%line(line)
      end do
   end subroutine write_fragility

end module dondolo_row_reports
