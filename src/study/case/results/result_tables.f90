!> The tables of results: one list of the endings of their names, the cases that have them, and their rows.
module dondolo_case_result_tables
   use dondolo_base_error, only : error_type, raise_failure
   use dondolo_base_lines, only : lines_type
   use dondolo_base_property, only : find_property
   use dondolo_base_text, only : to_table, to_text
   use dondolo_case, only : case_type
   use dondolo_case_check_rows, only : put_item, put_sheet_row
   use dondolo_case_design_rows, only : put_design
   use dondolo_case_job_group, only : history_task, stripes_task, typology_task
   use dondolo_case_report_rows, only : put_trace, put_typology, put_union
   use dondolo_case_result_files, only : suffix_length
   use dondolo_case_results, only : results_type
   use dondolo_case_row_tables, only : each_row, put_check_row, put_fragility_rows, put_history_rows, put_stripe_rows, &
      & put_tie_rows, put_wall_row, row_interface
   use dondolo_case_source_rows, only : collapse_of, put_source
   use dondolo_case_table, only : table_type
   use dondolo_case_tie_rows, only : make_tie_comment
   use dondolo_check_calculation, only : item_type, list_items
   use dondolo_check_checked_wall, only : find_checked
   use dondolo_population_unions, only : union_type
   use dondolo_wall, only : wall_type
   use dondolo_wall_properties, only : wall_properties
   implicit none
   private

   public :: table_kind_type, list_tables, table_suffixes

   abstract interface

      !> Has a case such a table?
      logical function exists_interface(case)
         import :: case_type
         type(case_type), intent(in) :: case
      end function exists_interface

      !> Put all rows of a table
      subroutine put_interface(case, results, table, error)
         import :: case_type, results_type, table_type, error_type
         type(case_type), intent(in), target :: case
         type(results_type), intent(inout) :: results
         class(table_type), intent(inout) :: table
         !> A file that is read again has changed
         type(error_type), allocatable, intent(out) :: error
      end subroutine put_interface

      !> List the facts above the names of the columns
      subroutine facts_interface(case, results, lines)
         import :: case_type, results_type, lines_type
         type(case_type), intent(in) :: case
         type(results_type), intent(in) :: results
         type(lines_type), intent(out) :: lines
      end subroutine facts_interface

   end interface

   !> A kind of table
   type :: table_kind_type
      !> What the name of its file ends with
      character(len=suffix_length) :: suffix = ''
      !> Has a case such a table? Null: every case has
      procedure(exists_interface), pointer, nopass, private :: exists => null()
      !> Put its rows; null: they are of the rows of a population, or of the one wall, one after the other
      procedure(put_interface), pointer, nopass, private :: put => null()
      !> Put those of one of these
      procedure(row_interface), pointer, nopass, private :: put_row => null()
      !> Whether these come with their histories and ties
      logical, private :: is_stored = .false.
      !> List the facts above it, besides those of all tables; null: none
      procedure(facts_interface), pointer, nopass :: facts => null()
   contains
      !> Has a case such a table?
      procedure :: is_of
      !> Fill a table
      procedure :: fill
   end type table_kind_type

contains

   !> List all kinds of tables, in the order in which those of a case are written
   subroutine list_tables(kinds)
      type(table_kind_type), allocatable, intent(out) :: kinds(:)

      allocate (kinds(0))
      call add('_walls.csv', put_row=put_wall_row)
      call add('_histories.csv', keeps_histories, put_row=put_history_rows, is_stored=.true.)
      call add('_history.csv', is_history, put_motion, list_motion)
      call add('_stripes.csv', is_no_history, put_row=put_stripe_rows)
      call add('_fragility.csv', is_no_history, put_row=put_fragility_rows)
      call add('_typology.csv', has_means, put_typologies)
      call add('_ties.csv', has_ties, put_row=put_tie_rows, is_stored=.true.)
      call add('_unions.csv', has_unions, put_unions)
      call add('_designs.csv', has_designs, put_designs)
      call add('_check.csv', has_check, put_sheet)
      call add('_calculation.csv', has_check, put_calculation)
      call add('_checks.csv', has_checks, put_row=put_check_row)
      call add('_sources.csv', has_sources, put_sources)

   contains

      !> Add a kind
      subroutine add(suffix, exists, put, facts, put_row, is_stored)
         character(len=*), intent(in) :: suffix
         procedure(exists_interface), optional :: exists
         procedure(put_interface), optional :: put
         procedure(facts_interface), optional :: facts
         procedure(row_interface), optional :: put_row
         logical, intent(in), optional :: is_stored

         type(table_kind_type) :: kind

         kind%suffix = suffix
         if (present(exists)) kind%exists => exists
         if (present(put)) kind%put => put
         if (present(facts)) kind%facts => facts
         if (present(put_row)) kind%put_row => put_row
         if (present(is_stored)) kind%is_stored = is_stored
         kinds = [kinds, kind]
      end subroutine add

   end subroutine list_tables

   !> What the names of tables can end with, of any case
   function table_suffixes() result(suffixes)
      character(len=suffix_length), allocatable :: suffixes(:)

      type(table_kind_type), allocatable :: kinds(:)

      call list_tables(kinds)
      suffixes = kinds%suffix
   end function table_suffixes

   !> Fill a table of this kind
   subroutine fill(self, case, results, table, error)
      class(table_kind_type), intent(in) :: self
      type(case_type), intent(in), target :: case
      type(results_type), intent(inout) :: results
      class(table_type), intent(inout) :: table
      !> A file that is read again has changed; lack of memory; or its rows differ in their columns, an error of the program
      type(error_type), allocatable, intent(out) :: error

      if (associated(self%put)) then
         call self%put(case, results, table, error)
      else
         call each_row(case, results, self%put_row, self%is_stored, table, error)
      end if
      if (.not. allocated(error) .and. allocated(table%error)) call move_alloc(table%error, error)
      if (.not. allocated(error) .and. .not. table%is_regular) call raise_failure(error, trim(self%suffix)// &
         & ': its rows differ in their columns')
   end subroutine fill

   !> Has a case such a table?
   logical function is_of(self, case)
      class(table_kind_type), intent(in) :: self
      type(case_type), intent(in) :: case

      is_of = .true.
      if (associated(self%exists)) is_of = self%exists(case)
   end function is_of

   !> Is the task one history?
   logical function is_history(case)
      type(case_type), intent(in) :: case

      is_history = case%job%task == history_task
   end function is_history

   !> Is the task another?
   logical function is_no_history(case)
      type(case_type), intent(in) :: case

      is_no_history = case%job%task /= history_task
   end function is_no_history

   !> Are all histories kept?
   logical function keeps_histories(case)
      type(case_type), intent(in) :: case

      keeps_histories = case%job%task == stripes_task .or. (case%job%task == typology_task .and. case%job%histories)
   end function keeps_histories

   !> Is there a mean over walls?
   logical function has_means(case)
      type(case_type), intent(in) :: case

      has_means = case%job%task == typology_task .and. .not. case%designs
   end function has_means

   !> Has a wall ties, whose histories are counted?
   logical function has_ties(case)
      type(case_type), intent(in) :: case

      has_ties = .false.
      if (case%job%task == stripes_task) has_ties = case%wall%mechanism%ties > 0
      if (case%job%task == typology_task) has_ties = case%survey%lengths(find_property(wall_properties, 'tie_height')) > 0
   end function has_ties

   !> Has a wall several mechanisms?
   logical function has_unions(case)
      type(case_type), intent(in) :: case

      has_unions = case%job%task == typology_task .and. case%survey%walls < case%survey%rows
   end function has_unions

   !> Are the walls designs?
   logical function has_designs(case)
      type(case_type), intent(in) :: case

      has_designs = case%job%task == typology_task .and. case%designs
   end function has_designs

   !> Is the one wall checked?
   logical function has_check(case)
      type(case_type), intent(in) :: case

      has_check = case%job%task == stripes_task .and. allocated(case%check)
   end function has_check

   !> Are the walls of a population checked?
   logical function has_checks(case)
      type(case_type), intent(in) :: case

      has_checks = case%job%task == typology_task .and. allocated(case%check)
   end function has_checks

   !> Is it a wall with variants?
   logical function has_sources(case)
      type(case_type), intent(in) :: case

      has_sources = case%job%task == typology_task .and. allocated(case%uncertainty)
   end function has_sources

   !> Curves of the population
   subroutine put_typologies(case, results, table, error)
      type(case_type), intent(in), target :: case
      type(results_type), intent(inout) :: results
      class(table_type), intent(inout) :: table
      type(error_type), allocatable, intent(out) :: error

      integer :: i, j, k

      do k = 1, size(case%stripes%thresholds)
         do i = 1, size(results%typologies, 1)
            do j = 1, size(case%stripes%levels)
               call put_typology(table, results%typologies(i, k), case%stripes%scaling%name, j, case%stripes%thresholds(k))
               call table%end_row()
            end do
         end do
      end do
   end subroutine put_typologies

   !> Walls with several mechanisms, of the same histories
   subroutine put_unions(case, results, table, error)
      type(case_type), intent(in), target :: case
      type(results_type), intent(inout) :: results
      class(table_type), intent(inout) :: table
      type(error_type), allocatable, intent(out) :: error

      type(union_type) :: union
      integer :: i, j, k

      do i = 1, results%unions%count()
         call results%unions%get(i, results%population, union)
         do k = 1, size(case%stripes%thresholds)
            do j = 1, size(case%stripes%levels)
               call put_union(table, union, case%stripes%scaling%name, case%stripes%levels(j), j, k, &
                  & case%stripes%thresholds(k))
               call table%end_row()
            end do
         end do
      end do
   end subroutine put_unions

   !> Designs of one wall, each beside the first
   subroutine put_designs(case, results, table, error)
      type(case_type), intent(in), target :: case
      type(results_type), intent(inout) :: results
      class(table_type), intent(inout) :: table
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      do i = 1, size(results%designs)
         call put_design(table, results%designs(i), results%designs(1), case%stripes%scaling%name)
         call table%end_row()
      end do
   end subroutine put_designs

   !> The uncertain properties of a wall with variants
   subroutine put_sources(case, results, table, error)
      type(case_type), intent(in), target :: case
      type(results_type), intent(inout) :: results
      class(table_type), intent(inout) :: table
      type(error_type), allocatable, intent(out) :: error

      integer :: i, j

      associate (wall => case%table%base_wall)
         do i = 1, size(wall%sources)
            call put_source(table, trim(wall%sources(i)), case%uncertainty%word(trim(wall%sources(i))), &
               & [wall%values(i, wall%row_of_end(i, 1)), wall%values(i, wall%samples + 2), wall%values(i, wall%row_of_end(i, 2))], &
               & [(collapse_of(results, wall%row_of_end(i, j)), j=1, 2)], i, results%sensitivity)
            call table%end_row()
         end do
      end associate
   end subroutine put_sources

   !> The sheet of the check
   subroutine put_sheet(case, results, table, error)
      type(case_type), intent(in), target :: case
      type(results_type), intent(inout) :: results
      class(table_type), intent(inout) :: table
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      if (.not. allocated(case%check)) return
      do i = 1, size(results%check%rows)
         call put_sheet_row(table, results%check, i)
         call table%end_row()
      end do
   end subroutine put_sheet

   !> The items of the check
   subroutine put_calculation(case, results, table, error)
      type(case_type), intent(in), target :: case
      type(results_type), intent(inout) :: results
      class(table_type), intent(inout) :: table
      type(error_type), allocatable, intent(out) :: error

      type(item_type), allocatable :: items(:)
      type(wall_type) :: checked
      logical :: is_moved
      integer :: i

      call find_checked(case%wall, checked, is_moved, error)
      if (allocated(error)) return
      call list_items(checked, items)
      do i = 1, size(items)
         call put_item(table, items(i), checked%model%is_whole)
         call table%end_row()
      end do
   end subroutine put_calculation

   !> The time history
   subroutine put_motion(case, results, table, error)
      type(case_type), intent(in), target :: case
      type(results_type), intent(inout) :: results
      class(table_type), intent(inout) :: table
      type(error_type), allocatable, intent(out) :: error

      call put_trace(table, results%trace, case%wall%mechanism%capacity)
   end subroutine put_motion

   !> Facts of a time history
   subroutine list_motion(case, results, lines)
      type(case_type), intent(in) :: case
      type(results_type), intent(in) :: results
      type(lines_type), intent(out) :: lines

      character(len=:), allocatable :: line
      integer :: i

      associate (response => results%response, trace => results%trace)
         call lines%add('record: '//case%suite%records(case%history%record)%name)
         call lines%add('scale: '//to_table(case%history_scale()))
         call lines%add('initial_rotation_rad: '//to_table(case%history%initial%rotation))
         call lines%add('initial_velocity_rad_s: '//to_table(case%history%initial%velocity))
         call lines%add('edp: '//to_table(response%edp))
         call lines%add('collapsed: '//to_text(merge(1, 0, response%collapsed)))
         call lines%add('impacts: '//to_text(response%impacts))
         call lines%add('time_of_peak_s: '//to_table(response%time_of_peak))
         if (case%solver%solver%estimate_error) call lines%add('edp_error: '//to_table(response%edp_error))
         do i = 1, size(trace%ties)
            call make_tie_comment(i, trace%ties(i), line)
            call lines%add(line)
         end do
      end associate
   end subroutine list_motion

end module dondolo_case_result_tables
