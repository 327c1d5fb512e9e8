!> Survey of a population before anything is run: every row is read and checked, and everything that is wrong is reported
!> at once. The walls are not kept.
module dondolo_case_survey
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_error, only : add_place, error_type, problems_type, raise_input
   use dondolo_base_fingerprint, only : fingerprint_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_limits, only : most_groups
   use dondolo_base_lines, only : lines_type
   use dondolo_base_text, only : to_text
   use dondolo_case_motion_warnings, only : scale_warnings_type
   use dondolo_case_occurrence_warnings, only : occurrence_warnings_type
   use dondolo_case_wall_warnings, only : wall_warnings_type
   use dondolo_fragility_stripes, only : plan_stripes, stripes_type
   use dondolo_fragility_study, only : study_type
   use dondolo_motion_ensemble, only : check_engine
   use dondolo_motion_solver, only : check_limit
   use dondolo_population, only : population_type
   use dondolo_population_identity, only : add_wall
   use dondolo_population_reader, only : population_reader_type
   use dondolo_population_table, only : population_table_type
   use dondolo_population_wall_row, only : wall_row_type
   use dondolo_wall, only : wall_type
   use dondolo_wall_properties, only : wall_properties
   use dondolo_wall_support_notes, only : supports_type
   use dondolo_wall_tabulated_model, only : chain_name, horizontal_name, tabulated_name
   implicit none
   private

   public :: survey_type, survey_population, hand_rows_over, check_size, add_wall_words

   !> What a survey has found
   type :: survey_type
      !> Rows: mechanisms of walls
      integer :: rows = 0
      !> Walls
      integer :: walls = 0
      !> Is one of them part of a facade?
      logical :: has_facades = .false.
      !> Has one of them exclusive alternatives?
      logical :: has_alternatives = .false.
      !> Rows that are to be run
      integer :: first = 1, last = 0
      !> Were rows asked for, even if they are all of them?
      logical :: is_part = .false.
      !> Histories of these rows, all levels
      integer(int64) :: histories = 0
      !> Its rows, without histories, until they are handed over
      type(population_type) :: population
      !> Warnings of scale factors
      type(scale_warnings_type) :: scales
      !> Warnings of values that no masonry has
      type(wall_warnings_type) :: wall_warnings
      !> Warnings of the probabilities that mechanisms can occur
      type(occurrence_warnings_type) :: occurrence_warnings
      !> Fingerprint of the walls
      type(fingerprint_type) :: walls_fingerprint
      !> How many values each property of a wall has at most
      integer, allocatable :: lengths(:)
      !> What moves the walls
      type(supports_type) :: supports
      !> Files that tabulated walls have their terms from, each once
      type(lines_type) :: tables
      !> Rows of tabulated walls; largest misfit of their polynomials / largest value, and the wall that has it
      integer :: tabulated = 0
      real(wp) :: misfit = -1.0_wp
      character(len=:), allocatable :: worst_fitted
      !> What its walls use of the methods of others, in the words of dondolo_files_references, each once
      type(lines_type) :: used
      !> How the table was read: a note, or empty
      character(len=:), allocatable :: note
   end type survey_type

contains

   !> Survey a population
   subroutine survey_population(survey, table, study, rows, error)
      !> What is found
      type(survey_type), intent(out) :: survey
      !> What it is taken from
      type(population_table_type), intent(in) :: table
      !> What the walls are tried with
      type(study_type), intent(in) :: study
      !> First and last row that are to be run
      integer, intent(in) :: rows(2)
      !> Everything that is wrong with the table, or the first level that asks too much
      type(error_type), allocatable, intent(out) :: error

      type(population_reader_type) :: reader
      type(wall_row_type) :: row
      type(stripes_type) :: plan
      type(problems_type) :: problems
      logical :: found

      survey%first = rows(1)
      survey%note = ''
      if (.not. allocated(table%base_wall)) survey%note = table%csv%note()
      allocate (survey%lengths(size(wall_properties)), source=0)
      do
         call reader%next(table, row, found, error)
         if (.not. found) exit
         survey%rows = reader%row
         if (.not. allocated(error)) then
            if (.not. row%continues) survey%walls = survey%walls + 1
            survey%has_facades = survey%has_facades .or. len(row%facade) > 0
            call add_row(survey%population, row)
            call survey%occurrence_warnings%look(row)
            survey%has_alternatives = survey%has_alternatives .or. row%number_of_alternative > 0
            survey%lengths = max(survey%lengths, row%wall%input%lengths())
            call survey%supports%look(row%wall)
            call add_wall_words(survey%used, row%wall)
            if (any(row%wall%mechanism_name() == [tabulated_name, chain_name, horizontal_name])) call look_at_table(survey, &
               & row%wall)
            call add_wall(survey%walls_fingerprint, row%wall)
            if (survey%population%groups%count > most_groups) call refuse_group(survey%population%groups, error)
            if (.not. allocated(error)) call check_limit(study%solver, row%wall%mechanism, error)
            if (.not. allocated(error)) call check_engine(study%solver, row%wall%mechanism, error)
            call add_place(error, reader%place(table))
         end if
         if (.not. allocated(error)) then
            call plan_stripes(plan, row%wall, study, error)
            if (allocated(error)) then
               call add_place(error, reader%place(table))
               return
            end if
            call survey%scales%look(plan, study, row%wall)
            call survey%wall_warnings%look(row%wall)
            if (reader%row >= rows(1) .and. reader%row <= rows(2)) then
               survey%histories = survey%histories + count(plan%ran)
            end if
         end if
         call problems%take(error)
      end do
      survey%last = min(rows(2), survey%rows)
      call survey%population%trim_rows()
      call problems%take(error)
      call problems%raise(error)
   end subroutine survey_population

   !> Hand the rows over to a population: those of many walls would not fit twice. A further run of the same case reads them again
   subroutine hand_rows_over(survey, table, population, error)
      type(survey_type), intent(inout) :: survey
      !> What it is taken from
      type(population_table_type), intent(in) :: table
      !> The population, empty: it gets the rows
      type(population_type), intent(inout) :: population
      !> A row is wrong
      type(error_type), allocatable, intent(out) :: error

      type(population_reader_type) :: reader
      type(wall_row_type) :: row
      logical :: found

      if (survey%population%rows > 0) then
         call population%take_rows(survey%population)
         return
      end if
      reader%names%is_checked = .false.
      do
         call reader%next(table, row, found, error)
         if (.not. found .or. allocated(error)) exit
         call add_row(population, row)
      end do
   end subroutine hand_rows_over

   !> Add a row to a population
   subroutine add_row(population, row)
      type(population_type), intent(inout) :: population
      type(wall_row_type), intent(in) :: row

      call population%add(row%wall%mechanism_name(), row%group, row%weight, row%p_occ, row%number_of_alternative, row%continues)
   end subroutine add_row

   !> Add the methods that a wall uses, unless they are listed: its mechanism, with its model of restitution, its building
   subroutine add_wall_words(used, wall)
      type(lines_type), intent(inout) :: used
      type(wall_type), intent(in) :: wall

      call add_once(used, wall%mechanism_name())
      call add_once(used, wall%mechanism_name()//'/'//wall%input%word('restitution'))
      if (allocated(wall%building)) call add_once(used, 'building')
   end subroutine add_wall_words

   !> Note the file of a tabulated wall, or those of a chain, and how far its polynomials miss its table
   subroutine look_at_table(survey, wall)
      type(survey_type), intent(inout) :: survey
      type(wall_type), intent(in) :: wall

      integer :: i

      survey%tabulated = survey%tabulated + 1
      if (allocated(wall%input%table_file)) call add_once(survey%tables, wall%input%table_file)
      do i = 1, wall%input%chain_files%count
         call add_once(survey%tables, wall%input%chain_files%line(i)%text)
      end do
      if (.not. wall%model%misfit > survey%misfit) return
      survey%misfit = wall%model%misfit
      survey%worst_fitted = wall%name()
   end subroutine look_at_table

   !> Add a line that is not listed
   subroutine add_once(lines, line)
      type(lines_type), intent(inout) :: lines
      character(len=*), intent(in) :: line

      integer :: i

      do i = 1, lines%count
         if (lines%line(i)%text == line) return
      end do
      call lines%add(line)
   end subroutine add_once

   !> Refuse a group that is one too many
   subroutine refuse_group(groups, error)
      !> Names of the groups; the last one is taken out again
      type(lines_type), intent(inout) :: groups
      !> There are too many
      type(error_type), allocatable, intent(out) :: error

      call raise_input(error, 'group = '''//groups%line(groups%count)%text//''': there may be at most '// &
         & to_text(most_groups)//' groups')
      groups%count = groups%count - 1
   end subroutine refuse_group

   !> Check that the histories of a run can be counted; those of parts that are merged may be more
   subroutine check_size(file, histories, error)
      !> Path of the table
      character(len=*), intent(in) :: file
      !> Histories of all rows that are to be run
      integer(int64), intent(in) :: histories
      !> They are too many
      type(error_type), allocatable, intent(out) :: error

      if (histories > huge(1)) call raise_input(error, file//': '//to_text(histories)//' histories: run at most '// &
         & to_text(huge(1))//' at a time, parts of the population with --walls FIRST:LAST')
   end subroutine check_size

end module dondolo_case_survey
