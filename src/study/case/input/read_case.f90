!> Reading a case: its namelist file and all that it names, checked before anything is computed.
module dondolo_case_read_case
   use dondolo_base_error, only : error_type, no_such_file, not_given, not_together, out_of_range, problems_type, raise_input, &
      & status_missing
   use dondolo_base_kinds, only : wp
   use dondolo_base_memory, only : check_room
   use dondolo_base_text, only : brief, rounded, to_text
   use dondolo_case, only : case_type
   use dondolo_case_building_group, only : read_building_group
   use dondolo_case_check_group, only : read_check_group
   use dondolo_case_history_group, only : find_record, read_history_group
   use dondolo_case_job_group, only : history_task, read_job, stripes_task, task_names, typology_task
   use dondolo_case_namelist, only : namelist_type, read_namelist
   use dondolo_case_namelist_group, only : group_type
   use dondolo_case_population_group, only : read_population_group
   use dondolo_case_property_tables, only : group_names
   use dondolo_case_records_group, only : read_records_group
   use dondolo_case_settings_group, only : read_values
   use dondolo_case_solver_group, only : read_solver_group
   use dondolo_case_stripes_group, only : check_states, read_stripes_group
   use dondolo_case_survey, only : survey_population
   use dondolo_case_uncertainty_group, only : read_uncertainty_group
   use dondolo_check_sheet, only : sheet_type
   use dondolo_check_strip_check, only : check_by_ntc
   use dondolo_files_paths, only : beside
   use dondolo_files_system, only : file_exists, is_folder
   use dondolo_fragility_study, only : study_type
   use dondolo_motion_ensemble, only : check_engine
   use dondolo_motion_lane_variants, only : check_variant
   use dondolo_motion_solver, only : check_limit
   use dondolo_population_reader, only : population_reader_type
   use dondolo_population_wall_row, only : wall_row_type
   use dondolo_population_wall_table, only : take_table
   use dondolo_record, only : largest_acceleration, record_type
   use dondolo_record_dead_channel, only : check_motion
   use dondolo_record_rows, only : record_rows_type
   use dondolo_record_suite, only : suite_type
   use dondolo_records_catalogue, only : read_catalogue
   use dondolo_records_clusters, only : gather_suite
   use dondolo_records_reading_notes, only : list_reading_notes
   use dondolo_wall, only : new_wall
   use dondolo_wall_properties, only : own_properties, wall_input_type, wall_properties
   implicit none
   private

   public :: read_case

   !> Memory that a sample of a record takes while the records are measured and joined [bytes]
   real(wp), parameter :: bytes_of_sample = 64.0_wp

contains


   !> Read a case and all its files, and check all of it
   subroutine read_case(file, case, error, rows, text, suite)
      !> Path of the namelist file; with `text` its name in messages
      character(len=*), intent(in) :: file
      type(case_type), intent(out) :: case
      !> Everything that is wrong with the groups, else the first thing; of a population, everything
      type(error_type), allocatable, intent(out) :: error
      !> First and last row of the population that are to be run, from 1; all if absent
      integer, intent(in), optional :: rows(2)
      !> Contents of the namelist file, which is not read then
      character(len=*), intent(in), optional :: text
      !> Accelerograms in the place of those of the catalogue. No file that the case names is opened then
      type(suite_type), intent(in), optional :: suite

      type(namelist_type) :: namelist
      type(record_rows_type) :: runs

      case%file = file
      call check_variant(error)
      if (allocated(error)) return
      if (.not. present(text)) then
         if (is_folder(file)) call raise_input(error, file//': is a folder, must be a namelist file')
         if (allocated(error)) return
      end if
      call read_namelist(file, namelist, error, text)
      if (allocated(error)) return
      call namelist%check_groups(group_names, error)
      if (present(suite) .and. .not. allocated(error)) call refuse_files(namelist, error)
      call read_groups(namelist, case, error)
      if (.not. allocated(error)) call check_combinations(namelist, case, error)
      if (present(suite)) then
         if (.not. allocated(error)) call take_suite(namelist%group('records'), suite, case, error)
      else
         if (.not. allocated(error)) call read_records(namelist%group('records'), case, runs, error)
      end if
      if (.not. allocated(error)) call measure_case(namelist, case, error)
      if (.not. allocated(error)) call choose_records(namelist, case, runs, error)
      if (allocated(error)) return
      if (case%job%task == stripes_task) then
         if (allocated(case%check) .and. case%records_input%polarity /= 'both' .and. .not. case%wall%mechanism%is_symmetric()) then
            call case%notes%add('&check: the criterion for time histories takes each record in one direction only; the wall '// &
               & 'feels their sign, and polarity = ''both'' in &records takes both')
         end if
      end if
      if (case%job%task == typology_task) then
         call survey(case, rows, error)
      else if (present(rows)) then
         call raise_input(error, '--walls: only for task = ''typology''')
      else
         call check_scales(namelist, case, error)
      end if
   end subroutine read_case

   !> Read the groups; what is wrong with any of them is reported at once
   subroutine read_groups(namelist, case, error)
      type(namelist_type), intent(in) :: namelist
      !> The case: its groups are read, its wall is made or its population found
      type(case_type), intent(inout) :: case
      !> What is wrong with the groups as a whole, if anything; what is wrong with each is added
      type(error_type), allocatable, intent(inout) :: error

      type(problems_type) :: problems
      type(wall_input_type) :: wall
      logical :: ready

      call problems%take(error)
      call read_job(namelist%group('job'), case%job, error)
      if (problems%count == 0 .and. .not. allocated(error)) call check_task(namelist, case%job%task, error)
      call problems%take(error)
      call read_solver_group(namelist%group('solver'), case%solver, error)
      call problems%take(error)
      ! A wall takes its gravity from the solver, and what it is from the task.
      ready = problems%count == 0
      call read_stripes_group(namelist%group('stripes'), case%stripes, error)
      call problems%take(error)
      call read_history_group(namelist%group('history'), case%history, error)
      call problems%take(error)
      call read_records_group(namelist%group('records'), case%records_input, error)
      call problems%take(error)
      call read_values(namelist%group('wall'), wall, error, wall_properties(:own_properties))
      if (.not. allocated(error)) call read_building_group(namelist%group('building'), wall, error)
      if (ready) then
         if (.not. allocated(error)) call read_table(namelist%group('wall'), wall, error)
         if (.not. allocated(error)) call make_wall(namelist, wall, case, error)
         if (.not. allocated(error)) call read_check(namelist, case, error)
      end if
      ! Alone it stays as it is: a file may be missing.
      if (problems%count == 0) return
      call problems%take(error)
      call problems%raise(error)
   end subroutine read_groups

   !> Refuse files beside the catalogue, for a case whose accelerograms are given
   subroutine refuse_files(namelist, error)
      type(namelist_type), intent(in) :: namelist
      !> Names the first
      type(error_type), allocatable, intent(out) :: error

      character(len=10), parameter :: groups(*) = [character(len=10) :: 'wall', 'wall', 'wall', 'wall', 'wall', 'population']
      character(len=7), parameter :: names(*) = [character(len=7) :: 'table', 'bodies', 'joints', 'actions', 'ties', 'file']
      type(group_type) :: group
      integer :: i

      do i = 1, size(groups)
         group = namelist%group(trim(groups(i)))
         if (group%has(trim(names(i))) .and. .not. allocated(error)) call group%refuse(trim(names(i)), &
            & 'no file is read for a case whose accelerograms are given', not_together, error)
      end do
   end subroutine refuse_files

   !> Take accelerograms that are given
   subroutine take_suite(group, suite, case, error)
      !> The group &records
      type(group_type), intent(in) :: group
      !> The accelerograms
      type(suite_type), intent(in) :: suite
      !> The case: it gets a copy of them
      type(case_type), intent(inout) :: case
      !> They have vertical components and the case takes none, or the other way round
      type(error_type), allocatable, intent(out) :: error

      call check_polarity(group, case, error)
      if (allocated(error)) return
      if (allocated(case%records_input%vertical_factor) .neqv. suite%has_vertical) then
         call raise_input(error, group%place()//': vertical = '''//case%records_input%vertical// &
            & ''': the accelerograms given have'//trim(merge('   ', ' no', suite%has_vertical))//' vertical components'// &
            & group%in_line('vertical'), not_together, 'vertical', group%place())
         return
      end if
      case%suite = suite
   end subroutine take_suite

   !> Check that the polarity suits the task
   subroutine check_polarity(group, case, error)
      !> The group &records
      type(group_type), intent(in) :: group
      !> The case
      type(case_type), intent(in) :: case
      !> Both polarities of one time history
      type(error_type), allocatable, intent(out) :: error

      if (case%job%task == history_task .and. case%records_input%polarity == 'both') call group%refuse('polarity', &
         & 'must be ''as_recorded'' or ''reversed'' for task = ''history''', not_together, error)
   end subroutine check_polarity

   !> Read the table of the terms of the wall
   subroutine read_table(group, wall, error)
      !> The group &wall
      type(group_type), intent(in) :: group
      !> Input of the wall: lists take the place of the table
      type(wall_input_type), intent(inout) :: wall
      !> No such file, or a table of something else
      type(error_type), allocatable, intent(out) :: error

      call take_table(wall, group%file, error)
      call group%locate(error)
   end subroutine read_table

   !> Survey the population
   subroutine survey(case, rows, error)
      !> The case: its survey is made
      type(case_type), intent(inout), target :: case
      !> First and last row that are to be run; all if absent
      integer, intent(in), optional :: rows(2)
      !> Everything that is wrong with the population
      type(error_type), allocatable, intent(out) :: error

      type(study_type) :: study
      character(len=:), allocatable :: note
      integer :: range(2)

      range = [1, huge(1)]
      if (present(rows)) range = rows
      call case%make_study(study)
      if (.not. allocated(case%table%base_wall)) call case%table%read(case%population_path(), error, case%solver%gravity)
      if (.not. allocated(error)) call survey_population(case%survey, case%table, study, range, error)
      if (allocated(error)) return
      if (len(case%survey%note) > 0) call case%notes%add(case%survey%note)
      if (case%survey%tabulated > 0) call case%notes%add(to_text(case%survey%tabulated)//' of '//to_text(case%survey%rows)// &
         & ' rows are tabulated: polynomials miss the values of their tables by '//rounded(100.0_wp*case%survey%misfit)// &
         & ' % of the largest at most (wall '''//case%survey%worst_fitted//''')')
      if (case%designs .and. (case%survey%rows < 2 .or. case%survey%walls < case%survey%rows)) then
         call raise_input(error, case%population_path()//': has '//to_text(case%survey%walls)//' walls in '// &
            & to_text(case%survey%rows)//' rows: designs = .true. needs two designs at least, each a wall of one row')
         return
      end if
      case%survey%is_part = present(rows)
      if (.not. present(rows) .or. case%survey%last == range(2)) return
      note = '--walls '//to_text(range(1))//':'//to_text(range(2))//': the population has '// &
         & to_text(case%survey%rows)//' rows'
      if (case%survey%first > case%survey%rows) then
         call raise_input(error, note)
      else
         call case%notes%add(note)
      end if
   end subroutine survey

   !> Check that the groups suit the task
   subroutine check_task(namelist, task, error)
      type(namelist_type), intent(in) :: namelist
      !> The task
      integer, intent(in) :: task
      !> A group too many or too few
      type(error_type), allocatable, intent(out) :: error

      character(len=10) :: needed, other
      type(group_type) :: group, variants
      logical :: is_of_wall

      needed = 'wall'
      other = 'population'
      if (task == typology_task) then
         needed = 'population'
         other = 'wall'
      end if
      group = namelist%group('wall')
      variants = namelist%group('uncertainty')
      if (variants%line > 0 .and. task /= typology_task) then
         call raise_input(error, variants%place()//' (line '//to_text(variants%line)//'): only for task = ''typology''')
         return
      else if (variants%line > 0 .and. (group%has('hinge_level') .or. group%has('hinge_at'))) then
         call raise_input(error, variants%place()//' (line '//to_text(variants%line)//'): not with hinge_level or hinge_at')
         return
      end if
      is_of_wall = task == typology_task .and. (group%has('hinge_level') .or. group%has('hinge_at') .or. variants%line > 0)
      group = namelist%group(trim(needed))
      if (variants%line > 0 .and. group%line > 0) then
         call raise_input(error, variants%place()//' (line '//to_text(variants%line)//'): takes &wall in place of &population')
         return
      end if
      if (group%line == 0 .and. .not. is_of_wall) then
         group = namelist%group('job')
         call raise_input(error, namelist%file//': &'//trim(needed)//': must be given for task = '''// &
            & trim(task_names(task))//''''//group%in_line('task'))
         return
      end if
      if (group%line > 0) group = namelist%group(trim(other))
      if (group%line > 0) call raise_input(error, group%place()//' (line '//to_text(group%line)// &
         & '): not for task = '''//trim(task_names(task))//''', which takes &'//trim(needed))
      if (allocated(error) .or. task /= typology_task .or. is_of_wall) return
      group = namelist%group('building')
      if (group%line > 0) call raise_input(error, group%place()//' (line '//to_text(group%line)// &
         & '): not for task = ''typology'', each wall of which has its own, in columns of &population')
   end subroutine check_task

   !> Make the wall, or find the population
   subroutine make_wall(namelist, input, case, error)
      type(namelist_type), intent(in) :: namelist
      !> Input of the wall
      type(wall_input_type), intent(in) :: input
      !> The case: its wall is made
      type(case_type), intent(inout) :: case
      !> What is wrong with it
      type(error_type), allocatable, intent(out) :: error

      type(group_type) :: group

      group = namelist%group('wall')
      if (case%job%task == typology_task .and. group%line > 0) then
         call make_facade(input, namelist%group('uncertainty'), case, error)
         if (.not. allocated(case%uncertainty)) call group%locate(error)
         return
      else if (case%job%task == typology_task) then
         group = namelist%group('population')
         call read_population_group(group, case%population_file, case%table%occurrence, case%designs, error)
         if (.not. allocated(error)) call check_file(group, 'file', case%population_file, error)
         return
      end if
      call new_wall(case%wall, input, error, case%solver%gravity)
      call group%locate(error)
      if (allocated(error)) return
      group = namelist%group('solver')
      call check_limit(case%solver%solver, case%wall%mechanism, error)
      if (.not. allocated(error)) call check_engine(case%solver%solver, case%wall%mechanism, error)
      call group%locate(error)
      if (allocated(error)) error%message = error%message//' (wall '''//case%wall%name()//''')'
   end subroutine make_wall

   !> Take a facade, or a wall with variants, and make all of its walls to check them
   subroutine make_facade(input, variants, case, error)
      !> Its input
      type(wall_input_type), intent(in) :: input
      !> The group of its variants, if there is one
      type(group_type), intent(in) :: variants
      !> The case: its facade, or its wall with variants, is set
      type(case_type), intent(inout) :: case
      !> What is wrong with it or one of its walls
      type(error_type), allocatable, intent(out) :: error

      type(population_reader_type) :: reader
      type(wall_row_type) :: row
      logical :: found

      case%table%file = case%file
      case%table%gravity = case%solver%gravity
      allocate (case%table%base_wall)
      case%table%base_wall%wall_input_type = input
      if (.not. case%table%base_wall%has('name')) call case%table%base_wall%set('name', trim(merge('wall  ', 'facade', &
         & variants%line > 0)))
      if (variants%line > 0) then
         allocate (case%uncertainty)
         call read_uncertainty_group(variants, case%table%base_wall, case%uncertainty, error)
         if (allocated(error)) return
      end if
      found = .true.
      do while (found .and. .not. allocated(error))
         call reader%next(case%table, row, found, error)
      end do
   end subroutine make_facade

   !> Read the check by a building code
   subroutine read_check(namelist, case, error)
      type(namelist_type), intent(in) :: namelist
      !> The case: its check is read
      type(case_type), intent(inout) :: case
      !> What is wrong with it, or a wall that it is not for
      type(error_type), allocatable, intent(out) :: error

      type(group_type) :: group
      type(sheet_type) :: sheet

      group = namelist%group('check')
      call read_check_group(group, case%check, error)
      if (allocated(error) .or. .not. allocated(case%check)) return
      if (case%job%task == stripes_task) then
         call check_by_ntc(sheet, case%wall, case%check, error)
         call group%locate(error)
      else if (case%job%task == history_task) then
         call raise_input(error, group%place()//' (line '//to_text(group%line)//'): not for task = ''history''')
      end if
   end subroutine read_check

   !> Check what belongs together
   subroutine check_combinations(namelist, case, error)
      type(namelist_type), intent(in) :: namelist
      type(case_type), intent(inout) :: case
      !> What is missing
      type(error_type), allocatable, intent(out) :: error

      type(group_type) :: group

      if (case%job%task /= stripes_task .and. case%solver%solver%certify) then
         group = namelist%group('solver')
         call group%refuse('certify', 'only for task = ''stripes'': populations and single histories are not certified', &
            & not_together, error)
         return
      end if
      if (case%job%task == typology_task .and. case%solver%solver%estimate_error) then
         group = namelist%group('solver')
         call group%refuse('estimate_error', 'only for task = ''stripes'' and ''history'', which keep every EDP', not_together, &
            & error)
         return
      end if
      group = namelist%group('stripes')
      if (case%job%task == typology_task .and. case%stripes%states == 'ordinal') then
         call group%refuse('states', 'must be ''separate'' for task = ''typology''', not_together, error)
         return
      end if
      call check_states(case%stripes, case%solver%solver%edp_limit, error)
      call group%locate(error)
      if (allocated(error)) return
      if (case%job%histories .and. case%job%task /= typology_task) then
         group = namelist%group('job')
         call group%refuse('histories', 'only for task = ''typology''; ''stripes'' writes all histories anyway', not_together, &
            & error)
         return
      end if
      if (case%job%task == history_task .or. allocated(case%stripes%levels)) return
      call raise_input(error, 'levels: must be given, such as levels = 0.1, 0.2, 0.3; or first, last and count', not_given, &
         & 'levels')
      call group%locate(error)
   end subroutine check_combinations

   !> Read the accelerograms
   subroutine read_records(group, case, rows, error)
      !> The group &records
      type(group_type), intent(in) :: group
      !> The case: its records are read
      type(case_type), intent(inout) :: case
      !> Rows of the catalogue
      type(record_rows_type), intent(out) :: rows
      !> What is wrong with them, or too little memory
      type(error_type), allocatable, intent(out) :: error

      type(record_type), allocatable :: records(:)
      character(len=:), allocatable :: note
      integer :: i

      call check_file(group, 'catalogue', case%records_input%catalogue, error)
      if (.not. allocated(error)) call check_polarity(group, case, error)
      if (allocated(error)) return
      ! A factor that is not allocated is an argument that is not present
      call read_catalogue(beside(case%records_input%catalogue, case%file), records, error, note, rows, &
         & case%records_input%vertical_factor, case%job%threads)
      if (.not. allocated(error)) call check_room(bytes_of_sample*sum([(real(size(records(i)%acceleration), wp), &
         & i=1, size(records))]), error)
      if (allocated(error)) return
      if (len(note) > 0) call case%notes%add(note)
      call list_reading_notes(records, case%notes)
      call gather_suite(case%suite, records, case%job%threads)
   end subroutine read_records

   !> Check that a variable names a file that exists
   subroutine check_file(group, name, path, error)
      !> Group of the variable
      type(group_type), intent(in) :: group
      !> Name of the variable
      character(len=*), intent(in) :: name
      !> Path as it was given
      character(len=*), intent(in) :: path
      !> There is no such file
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: file, hint
      file = beside(path, group%file)
      if (is_folder(file)) then
         call group%refuse(name, file//' is a folder, must be a file', no_such_file, error)
      else if (.not. file_exists(file)) then
         hint = ''
         if (index(path, '\') > 0) hint = '; folders must be separated by /, not \'
         call group%refuse(name, 'there is no file '//file//' (paths are relative to the case)'//hint, no_such_file, error)
         error%stat = status_missing
      end if
   end subroutine check_file

   !> Find the record of the time history, and measure the records where they are scaled to levels
   subroutine measure_case(namelist, case, error)
      type(namelist_type), intent(in) :: namelist
      type(case_type), intent(inout) :: case
      !> No such record
      type(error_type), allocatable, intent(out) :: error

      type(group_type) :: group

      group = namelist%group('history')
      if (case%job%task == history_task .or. group%line > 0) call find_record(group, case%history, case%suite%records, error)
      if (allocated(error)) return
      if (case%is_scaled()) call case%suite%measure(case%stripes%scaling%measure, case%job%threads)
   end subroutine measure_case

   !> Choose the records of each level
   subroutine choose_records(namelist, case, rows, error)
      type(namelist_type), intent(in) :: namelist
      type(case_type), intent(inout), target :: case
      !> Rows of the catalogue
      type(record_rows_type), intent(in) :: rows
      !> A level that is not among the others, or has no record; a record that runs without motion
      type(error_type), allocatable, intent(out) :: error

      type(group_type) :: group
      type(study_type) :: study

      if (case%job%task == history_task) return
      call case%make_study(study)
      call study%set_rows(rows, error)
      group = namelist%group('stripes')
      if (.not. allocated(error)) then
         call study%check_motions(error)
         group = namelist%group('records')
      end if
      call group%locate(error)
      if (.not. allocated(error)) call move_alloc(study%factor, case%factor)
   end subroutine choose_records

   !> Check that no record is scaled beyond all measure
   subroutine check_scales(namelist, case, error)
      type(namelist_type), intent(in) :: namelist
      type(case_type), intent(in), target :: case
      !> A scale that is too large
      type(error_type), allocatable, intent(out) :: error

      type(group_type) :: group
      type(study_type) :: study
      type(error_type), allocatable :: problem
      real(wp) :: scale

      if (case%job%task == history_task) then
         group = namelist%group('history')
         associate (record => case%suite%records(case%history%record))
            if (allocated(case%history%im_level)) call check_motion(record, problem)
            if (allocated(problem)) then
               call group%refuse('im_level', problem%message, out_of_range, error)
               return
            end if
            scale = abs(case%history_scale())
            if (scale*record%pga() <= largest_acceleration) return
            call raise_input(error, group%place()//': the scale '//brief(scale)//' makes record '''// &
               & record%name//''' exceed '//to_text(largest_acceleration)//' m/s2'// &
               & group%in_line(trim(merge('im_level', 'scale   ', allocated(case%history%im_level)))))
         end associate
         return
      end if
      call case%make_study(study)
      call study%check_scales(study%scales(case%wall), error)
      group = namelist%group('stripes')
      if (allocated(error)) error%message = group%place()//': '//error%message// &
         & group%in_line(trim(merge('levels', 'last  ', group%has('levels'))))
   end subroutine check_scales

end module dondolo_case_read_case
