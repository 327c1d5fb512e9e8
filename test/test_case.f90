!> Tests of the room case: the namelist reader, the groups, the echo, and what a run gives.
program test_case
   use checks, only : check, check_close, check_error, check_ok, check_text, finish, suite
   use dondolo_base_error, only : error_type, status_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_text, only : to_text
   use dondolo_case, only : case_type
   use dondolo_case_columns, only : columns_type, integer_column, real_column, text_column
   use dondolo_case_echo, only : echo_type
   use dondolo_case_job_group, only : stripes_task
   use dondolo_case_motion_warnings, only : scale_warnings_type
   use dondolo_case_namelist, only : namelist_type, read_namelist
   use dondolo_case_namelist_group, only : group_type
   use dondolo_case_read_case, only : read_case
   use dondolo_case_reports, only : check_reports, write_reports
   use dondolo_case_result_files, only : published_run, result_files_type
   use dondolo_case_result_tables, only : list_tables, table_kind_type, table_suffixes
   use dondolo_case_results, only : results_type
   use dondolo_case_run_case, only : plan_case, run_case
   use dondolo_files_system, only : is_folder, remove_folder, same_file
   use dondolo_fragility_study, only : study_type
   use dondolo_motion_error_estimate, only : runs_of_estimate
   use dondolo_motion_work, only : work_type
   use dondolo_population_reader, only : read_population
   use dondolo_population_wall_row, only : wall_row_type
   implicit none

   character(len=*), parameter :: scratch = 'build/test_case', lf = new_line('a')

   character(len=*), parameter :: one_sided = "&job output = '"//scratch//"/out/s' /"//lf// &
      & "&wall mechanism = 'one_sided' height = 3 thickness = 0.25 /"//lf
   !> A catalogue of two records, a case of each task
   character(len=*), parameter :: records = "&records catalogue = 'records.csv' polarity = 'reversed' /"//lf
   character(len=*), parameter :: wall = "&wall mechanism = 'two_block', height = 3, thickness = 0.25, hinge = 0.5, "// &
      & "restitution_value = 0.9, name = 'it''s' /"//lf
   character(len=*), parameter :: stripes_case = "&job output = '"//scratch//"/out/x' title = 'two words' /"//lf// &
      & wall//records//"&stripes levels = 0.3, 0.5, 1 /"//lf//"&solver rtol = 1e-7 edp_limit = 0.9 /"
   character(len=*), parameter :: history_case = "&job task = 'history' output = '"//scratch//"/out/y' /"//lf//wall// &
      & records//"&history record = 'two', im_level = 0.5 /"//lf//"&solver rtol = 1e-7 edp_limit = 0.9 /"
   character(len=*), parameter :: typology_case = "&job task = 'typology' output = '"//scratch//"/out/z' /"//lf// &
      & "&population file = 'walls.csv' /"//lf//records//"&stripes first = 0.3, last = 1.2, count = 4 /"

   !> What was last heard of the progress, and whether it never went back

   call execute_command_line('rm -rf '//scratch//' && mkdir -p '//scratch)
   call write_inputs()
   call test_values()
   call test_grammar()
   call test_commas()
   call test_defaults()
   call test_levels()
   call test_population()
   call test_echo()
   call test_run()
   call test_record_sets()
   call test_work()
   call test_output()
   call test_tables()
   call test_texts()
   call finish()

contains

   !> Values as they can be typed
   subroutine test_values()
      type(namelist_type) :: namelist
      type(group_type) :: group
      type(error_type), allocatable :: error
      character(len=:), allocatable :: text
      real(wp), allocatable :: list(:)
      real(wp) :: number
      integer :: whole

      call suite('values')
      call write_file('a.nml', "! comment"//lf// &
         & "&Job  Text='it''s / no & end ! of = it' , more=""say """"yes"""""""//lf// &
         & " number = -1.5D-3 whole= +7,"//lf//"list = 1, .5"//achar(9)//"2.e0"//lf//"  3 ! the last"//lf//"/ &other/")
      call read_namelist(scratch//'/a.nml', namelist, error)
      call check_ok(error, 'a good file')
      group = namelist%group('none')
      call check(group%line == 0, 'a group that is not there')
      group = namelist%group('job')
      call check(group%line == 2, 'line of the group')
      call group%get_text('text', text, error, '')
      call check_text(text, 'it''s / no & end ! of = it', 'text with everything in it')
      call group%get_text('more', text, error, '')
      call check_text(text, 'say "yes"', 'doubled double quotes')
      call group%get_real('number', number, error)
      call check_close(number, -1.5e-3_wp, 0.0_wp, 'a number')
      call group%get_integer('whole', whole, error)
      call check(whole == 7, 'an integer')
      call group%get_reals('list', list, error)
      call check_ok(error, 'a list over two lines')
      call check(size(list) == 4, 'length of the list')
      call check(all(list == [1.0_wp, 0.5_wp, 2.0_wp, 3.0_wp]), 'the list')
      number = 42.0_wp
      call group%get_real('absent', number, error)
      call check_ok(error, 'a variable that was not given')
      call check(number == 42.0_wp, 'keeps its default')
      call check(.not. group%has_text('whole'), 'a number is no text')
      call check(group%has_text('text'), 'a text is one')
      call group%get_integer('number', whole, error)
      call check_error(error, scratch//'/a.nml: &job: number = -1.5D-3: must be an integer', &
         & 'an integer from a real')
      call check(error%stat == status_input, 'wrong input')
      call group%get_text('number', text, error, '')
      call check_error(error, 'number = -1.5D-3: must be text in quotes', 'a text from a number')
      call group%get_real('text', number, error)
      call check_error(error, 'must be a number', 'a number from a text')
      call group%check_names([character(len=6) :: 'text', 'more'], error)
      call check_error(error, '&job: number (line 3): no such variable; there are ''text'', ''more''', &
         & 'unknown variable')
      call check(index(error%message, 'did you mean') == 0, 'a name like no other')
      call group%check_names([character(len=7) :: 'text', 'more', 'list', 'whole', 'numbre'], error)
      call check_error(error, '''numbre''; did you mean ''numbre''?', 'two letters that were swapped')
      call namelist%check_groups([character(len=3) :: 'job'], error)
      call check_error(error, '&other (line 6): no such group; there are &job', 'unknown group')
   end subroutine test_values

   !> What does not fit the grammar
   subroutine test_grammar()

      call suite('grammar')
      call check_refused('&a x = 1', '&a: not closed')
      call check_refused('&a x = 1 &b y = 2 /', '&a: not closed: a / is missing before &b')
      call check_refused('&a x = 1 / y = 2', 'y is outside a group')
      call check_refused('/', '/ is outside a group')
      call check_refused('&a x = 1,,2 /', 'x (line 1): a value is missing before a comma')
      call check_refused('&a x = , 1 /', 'a value is missing before a comma')
      call check_refused('&a x = /', 'x (line 1): no value follows its =')
      call check_refused('&a x = y = 1 /', 'x (line 1): no value follows its =')
      call check_refused('&a x = 1 = 2 /', 'a second = follows it')
      call check_refused('&a x(2) = 1 /', 'subscripts')
      call check_refused('&a x = 3*0.1 /', 'repeat counts')
      call check_refused('&a x = 1'//lf//'X = 2 /', 'x: given twice, in lines 1 and 2')
      call check_refused('&a x = 1 /'//lf//'&A x = 2 /', '&a: given twice, in lines 1 and 2')
      call check_refused('&a x = ''one /', 'the quote before ''one /'' is not closed')
      call check_refused('&a x = ../y /', 'text right after a /')
      call check_refused('& x = 1 /', 'an & without the name')
      call check_refused('&a ''x'' = 1 /', '''x'' (line 1): must be the name of a variable')
      call check_refused('&a x /', 'x (line 1): must be the name of a variable and =')
      call check_refused('!', 'no group')
      call check_refused('', 'the file is empty')
      call check_accepted('&a x = 1, / &b/ &c x=1,'//lf//'y=2/')
      call check_accepted('&a x = 1 &end')
      call check_accepted('&a x = 1/! comment')
   end subroutine test_grammar

   !> Commas between the values of a list, and those of decimals
   subroutine test_commas()

      call suite('commas of lists')
      call check_doubtful('8,5', 'x = 8,5: a decimal comma, or several values? Write 8.5, or 8, 5 with a blank')
      call check_doubtful('12,5e3', 'x = 12,5e3: a decimal comma')
      call check_doubtful('-2,5', 'x = -2,5: a decimal comma')
      call check_doubtful('2,5, 7,5', 'x = 2,5, 7,5: a decimal comma')
      call check_doubtful('2,5 7,5', 'x = 2,5, 7,5: a decimal comma')
      call check_doubtful('0.5, 1,5', 'Write 1.5, or 1, 5 with a blank')
      call check_list('8, 5', [8.0_wp, 5.0_wp])
      call check_list('8 ,5', [8.0_wp, 5.0_wp])
      call check_list('8 5', [8.0_wp, 5.0_wp])
      call check_list('8.0,5.0', [8.0_wp, 5.0_wp])
      call check_list('8.,5', [8.0_wp, 5.0_wp])
      call check_list('8e0,5', [8.0_wp, 5.0_wp])
      call check_list('8,-5', [8.0_wp, -5.0_wp])
      call check_list('1,2,3', [1.0_wp, 2.0_wp, 3.0_wp])
      call check_list('1,2,3, 4,5', [1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 5.0_wp])
      call check_list('1,'//lf//'2', [1.0_wp, 2.0_wp])
   end subroutine test_commas

   !> Check that a list is refused
   subroutine check_doubtful(typed, message)
      !> The list as it is typed, and part of what must be said of it
      character(len=*), intent(in) :: typed, message

      type(error_type), allocatable :: error
      real(wp), allocatable :: values(:)

      call read_list(typed, values, error)
      call check_error(error, message, typed)
   end subroutine check_doubtful

   !> Check that a list is read
   subroutine check_list(typed, expected)
      !> The list as it is typed
      character(len=*), intent(in) :: typed
      !> Its values
      real(wp), intent(in) :: expected(:)

      type(error_type), allocatable :: error
      real(wp), allocatable :: values(:)
      integer :: i

      call read_list(typed, values, error)
      call check_ok(error, typed)
      if (allocated(error)) return
      call check(size(values) == size(expected), typed//': number of values')
      if (size(values) /= size(expected)) return
      do i = 1, size(values)
         call check_close(values(i), expected(i), 0.0_wp, typed)
      end do
   end subroutine check_list

   !> Read a list
   subroutine read_list(typed, values, error)
      !> The list as it is typed
      character(len=*), intent(in) :: typed
      !> Its values
      real(wp), allocatable, intent(out) :: values(:)
      !> It is refused
      type(error_type), allocatable, intent(out) :: error

      type(namelist_type) :: namelist
      type(group_type) :: group

      call read_namelist('case.nml', namelist, error, '&a x = '//typed//' /')
      if (allocated(error)) return
      group = namelist%group('a')
      call group%get_reals('x', values, error)
   end subroutine read_list

   !> Defaults as the documentation says
   subroutine test_defaults()
      type(case_type), target :: case
      type(study_type) :: study
      type(error_type), allocatable :: error

      call suite('defaults')
      call write_file('a.nml', "&wall mechanism = 'one_sided' height = 3 thickness = 0.25 /"// &
         & "&records catalogue = 'records.csv' / &stripes levels = 0.1 /")
      call read_case(scratch//'/a.nml', case, error)
      call check_ok(error, 'a short case')
      if (allocated(error)) return
      call check(case%job%task == stripes_task, 'task')
      call check_text(case%job%output, 'dondolo', 'output')
      call check_text(case%job%title, '', 'title')
      call check(case%job%threads == 0, 'threads')
      call check_text(case%records_input%polarity, 'as_recorded', 'polarity')
      call check_text(case%stripes%scaling%name, 'pga', 'im')
      call check_text(trim(case%solver%solver%engine), 'auto', 'engine')
      call check_close(case%solver%gravity, 9.81_wp, 0.0_wp, 'gravity')
      call check_close(case%solver%solver%edp_limit, 1.0_wp, 0.0_wp, 'edp_limit')
      call check(.not. case%solver%solver%estimate_error, 'estimate_error')
      call check_close(case%wall%input%number('density'), 1800.0_wp, 0.0_wp, 'density')
      call check_close(case%wall%mechanism%trigger_acceleration(), 9.81_wp/12.0_wp, 1.0e-14_wp, &
         & 'trigger')
      call write_file('a.nml', "&wall mechanism = 'one_sided' height = 3 thickness = 0.25 /"// &
         & "&records catalogue = 'records.csv' / &stripes levels = 0.1 / &solver gravity = 5 /")
      call read_case(scratch//'/a.nml', case, error)
      call check_close(case%wall%mechanism%trigger_acceleration(), 5.0_wp/12.0_wp, 1.0e-14_wp, &
         & 'gravity enters the wall')
      call case%make_study(study)
      associate (scales => study%scales(case%wall))
         call check_close(scales(1, 1), 0.1_wp*5.0_wp/case%suite%peaks(1), 1.0e-15_wp, 'and the levels')
      end associate
   end subroutine test_defaults

   !> Levels from a grid
   subroutine test_levels()
      type(case_type) :: case
      type(error_type), allocatable :: error
      real(wp), parameter :: expected(9) = [0.1_wp, 0.2_wp, 0.3_wp, 0.4_wp, 0.5_wp, 0.6_wp, 0.7_wp, 0.8_wp, 0.9_wp]

      call suite('levels')
      call write_file('a.nml', wall//records//'&stripes first = 0.1, last = 0.9, count = 9 /')
      call read_case(scratch//'/a.nml', case, error)
      call check_ok(error, 'a grid')
      if (allocated(error)) return
      call check(size(case%stripes%levels) == 9, 'count')
      call check(all(case%stripes%levels == expected), 'the decimals a person would write')
      call write_file('a.nml', wall//records//'&stripes first = 0.12345678901234567, last = 0.9, count = 2 /')
      call read_case(scratch//'/a.nml', case, error)
      call check(all(case%stripes%levels == [0.12345678901234567_wp, 0.9_wp]), 'both ends as given')
   end subroutine test_levels

   !> A population
   subroutine test_population()
      type(wall_row_type), allocatable :: rows(:)
      type(error_type), allocatable :: error

      call suite('population')
      call read_population(scratch//'/walls.csv', rows, error)
      call check_ok(error, 'a population')
      if (allocated(error)) return
      call check(size(rows) == 3, 'walls')
      call check(all(rows%weight == [2.0_wp, 1.0_wp, 0.0_wp]), 'weights')
      call check(all(rows%p_occ == 1.0_wp) .and. .not. any(rows%continues), 'mechanisms that can occur')
      call check_text(rows(2)%wall%name(), 'wall 2', 'a name that is not given')
      call check_text(rows(3)%wall%name(), 'a, b', 'a name with a comma')
      call check_text(rows(3)%group, '', 'no group')
      call check_close(rows(2)%wall%input%number('hinge'), 0.6_wp, 0.0_wp, 'hinge')
      call check(.not. rows(1)%wall%input%has('hinge'), 'an empty cell was not given')
      call check(rows(2)%wall%mechanism%two_sided, 'mechanism')
      call read_population(scratch//'/walls.csv', rows, error, gravity=5.0_wp)
      call check_close(rows(1)%wall%mechanism%trigger_acceleration(), 5.0_wp/12.0_wp, 1.0e-14_wp, 'gravity')
      call write_file('notes.csv', 'x_Via,mechanism,height,NOTE 2,thickness'//lf//'"a, b",one_sided,2,,0.3'//lf// &
         & ',one_sided,2,  1.10 ,0.3'//lf)
      call read_population(scratch//'/notes.csv', rows, error)
      call check_ok(error, 'notes')
      call check_text(rows(1)%notes%line(1)%text, 'a, b', 'a note')
      call check_text(rows(1)%notes%line(2)%text//rows(2)%notes%line(1)%text, '', 'no note')
      call check_text(trim(adjustl(rows(2)%notes%line(2)%text)), '1.10', 'a note as it stands')
      call write_file('notes.csv', 'mechanism,height,thickness,notice,X-1'//lf//'one_sided,2,0.3,,'//lf)
      call read_population(scratch//'/notes.csv', rows, error)
      call check_error(error, 'notes.csv: column ''notice'': no such column', 'no note')
      call check_error(error, 'one that is only kept begins with x_ or note', 'what is kept')
   end subroutine test_population

   !> The echo of a case is a case with the same echo
   subroutine test_echo()

      call suite('echo')
      call check_echo(stripes_case, 'stripes')
      call check_echo(history_case, 'history')
      call check_echo(typology_case, 'typology')
   end subroutine test_echo

   !> Read a case, write its echo, read that
   subroutine check_echo(content, what)
      character(len=*), intent(in) :: content, what
      type(case_type) :: case
      type(echo_type) :: echo
      type(lines_type) :: first, second
      type(error_type), allocatable :: error
      character(len=:), allocatable :: text
      integer :: i

      call write_file('a.nml', content)
      call read_case(scratch//'/a.nml', case, error)
      call check_ok(error, what)
      if (allocated(error)) return
      call case%echo(echo)
      call echo%to_namelist(first)
      text = ''
      do i = 1, first%count
         text = text//first%line(i)%text//lf
      end do
      call write_file('b.nml', text)
      call read_case(scratch//'/b.nml', case, error)
      call check_ok(error, what//': the echo')
      if (allocated(error)) return
      call case%echo(echo)
      call echo%to_namelist(second)
      call check(first%count == second%count, what//': lines of the echo')
      do i = 1, min(first%count, second%count)
         call check_text(second%line(i)%text, first%line(i)%text, what//': line '//to_text(i))
      end do
   end subroutine check_echo

   !> Records of their own at each level: histories, counts and results are those of the records alone
   subroutine test_record_sets()
      character(len=*), parameter :: sets = "&records catalogue = 'sets.csv' polarity = 'both' /"//lf
      type(case_type) :: case
      type(results_type) :: whole, some
      type(error_type), allocatable :: error

      call suite('record sets')
      call write_file('sets.csv', 'file,dt_s,units,level,factor'//lf//'one.txt,0.01,m/s2,0.3,'//lf// &
         & 'two.txt,0.01,m/s2,0.5,'//lf//'one.txt,0.01,m/s2,1,'//lf//'two.txt,0.01,m/s2,1,'//lf)
      call write_file('a.nml', one_sided//"&records catalogue = 'records.csv' polarity = 'both' /"//lf// &
         & "&stripes levels = 0.3, 0.5, 1 /")
      call read_case(scratch//'/a.nml', case, error)
      if (.not. allocated(error)) call run_case(case, whole, error, threads=1)
      call check_ok(error, 'every record at every level')
      if (allocated(error)) return
      call write_file('a.nml', one_sided//sets//"&stripes levels = 0.3, 0.5, 1 /")
      call read_case(scratch//'/a.nml', case, error)
      if (.not. allocated(error)) call run_case(case, some, error, threads=1)
      call check_ok(error, 'records of each level')
      if (allocated(error)) return
      call check(size(case%suite%records) == 2, 'each record once')
      call check(all(some%row%histories == [2, 2, 4]), 'histories of each level')
      call check(some%work%histories == 8, 'nothing else runs')
      call check(maxval(abs(some%row%response([1, 3], 1)%edp - whole%row%response([1, 3], 1)%edp)) <= 0.0_wp .and. &
         & maxval(abs(some%row%response([2, 4], 2)%edp - whole%row%response([2, 4], 2)%edp)) <= 0.0_wp .and. &
         & maxval(abs(some%row%response(:, 3)%edp - whole%row%response(:, 3)%edp)) <= 0.0_wp, 'the same histories')
      call check(whole%row%response(1, 1)%edp > 0.0_wp, 'which move')
      call write_file('a.nml', one_sided//sets//"&stripes levels = 0.3, 1 /")
      call read_case(scratch//'/a.nml', case, error)
      call check_error(error, '&stripes: levels: do not include 0.5, the level of record ''two'' in '//scratch// &
         & '/sets.csv: line 3', 'a level that is not among the others')
      call write_file('a.nml', one_sided//sets//"&stripes levels = 0.3, 0.5, 0.7, 1 /")
      call read_case(scratch//'/a.nml', case, error)
      call check_error(error, 'levels = 0.7: no record runs at this level', 'a level without records')
      call write_file('sets.csv', 'file,dt_s,units,level'//lf//'one.txt,0.01,m/s2,0.3'//lf//'one.txt,0.01,m/s2,'//lf)
      call write_file('a.nml', one_sided//sets//"&stripes levels = 0.3, 1 /")
      call read_case(scratch//'/a.nml', case, error)
      call check_error(error, 'levels = 0.3: record ''one'' runs twice at this level', 'a record twice')
      call check_factors(one_sided//sets)
   end subroutine test_record_sets

   !> A factor that the catalogue gives is that of the histories
   subroutine check_factors(start)
      character(len=*), intent(in) :: start
      type(case_type) :: case
      type(study_type) :: study
      type(error_type), allocatable :: error

      call write_file('sets.csv', 'file,dt_s,units,level,factor'//lf//'one.txt,0.01,m/s2,0.3,1.25'//lf// &
         & 'two.txt,0.01,m/s2,,'//lf)
      call write_file('a.nml', start//"&stripes levels = 0.3, 0.5 /")
      call read_case(scratch//'/a.nml', case, error)
      call check_ok(error, 'factors')
      if (allocated(error)) return
      call case%make_study(study)
      call check(study%runs(1, 1) .and. .not. study%runs(1, 2) .and. study%runs(2, 1) .and. study%runs(2, 2), &
         & 'without a level a record runs at all')
      associate (scales => study%scales(case%wall))
         call check_close(scales(1, 1), 1.25_wp, 0.0_wp, 'factor that is given')
         call check_close(scales(2, 2), 0.5_wp*9.81_wp/case%suite%peaks(2), 1.0e-15_wp, 'and computed')
      end associate
      call check(maxval(abs(study%share() - [1.0_wp, 0.5_wp])) <= 0.0_wp, 'share of the records')
   end subroutine check_factors

   !> Tasks agree with each other
   subroutine test_run()
      type(case_type) :: case
      type(results_type) :: stripes, history, typology
      type(error_type), allocatable :: error
      integer :: i

      call suite('run')
      call write_file('a.nml', stripes_case)
      call read_case(scratch//'/a.nml', case, error)
      if (.not. allocated(error)) call run_case(case, stripes, error, threads=1)
      call check_ok(error, 'stripes')
      if (allocated(error)) return
      call check(all(stripes%row%reached(:, 1) == count(stripes%row%response%collapsed, dim=1)), 'collapses')
      call check(all(stripes%row%histories == 2), 'polarity does not double the histories of a symmetric wall')
      call check(any(stripes%row%response%edp > 0.0_wp), 'something moves')

      call write_file('a.nml', history_case)
      call read_case(scratch//'/a.nml', case, error)
      if (.not. allocated(error)) call run_case(case, history, error)
      call check_ok(error, 'history')
      if (allocated(error)) return
      call check(case%history%record == 2, 'record by name')
      ! Two engines, each with an error of its own: far above it, and far below what another record or scale would give.
      call check_close(history%response%edp, stripes%row%response(2, 2)%edp, 1.0e-6_wp, &
         & 'history and stripe give the same EDP')
      call check_close(history%response%time_of_peak, stripes%row%response(2, 2)%time_of_peak, 1.0e-6_wp, &
         & 'at the same time')
      call check_close(minval(history%trace%acceleration(:history%trace%rows)) &
         & *maxval(abs(case%suite%records(2)%acceleration))/maxval(case%suite%records(2)%acceleration), &
         & -0.5_wp*9.81_wp, 1.0e-12_wp, 'reversed and scaled to its level')

      call write_file('a.nml', typology_case)
      call read_case(scratch//'/a.nml', case, error)
      if (.not. allocated(error)) call run_case(case, typology, error)
      call check_ok(error, 'typology')
      if (allocated(error)) return
      call check(size(typology%shown) == 3, 'a curve for each wall')
      associate (whole => typology%typologies(size(typology%typologies, 1), 1), reached => typology%population%reached)
         do i = 1, 4
            call check_close(whole%mean_fraction(i), (2.0_wp*real(reached(i, 1, 1), wp) &
               & + real(reached(i, 1, 2), wp))/6.0_wp, 1.0e-14_wp, 'weighted mean', atol=1.0e-15_wp)
         end do
      end associate
      call typology%remove_stores()
      call remove_folder(scratch//'/out')
   end subroutine test_run

   !> What was computed, and what can be told of it before
   subroutine test_work()
      type(case_type) :: case
      type(results_type) :: results
      type(error_type), allocatable :: error
      type(work_type) :: planned
      type(scale_warnings_type) :: scales

      call suite('work')
      call write_file('a.nml', stripes_case)
      call read_case(scratch//'/a.nml', case, error)
      if (.not. allocated(error)) call run_case(case, results, error, threads=1)
      if (.not. allocated(error)) call plan_case(case, planned, scales, error)
      call check_ok(error, 'stripes')
      if (allocated(error)) return
      associate (work => results%work)
         call check(work%histories == 6, 'every history')
         call check(work%intervals == 6*500, 'every sample interval')
         call check(work%still == count(.not. results%row%response%edp > 0.0_wp), 'still ones have no EDP')
         call check(work%still > 0 .and. work%still < work%histories, 'some move, some do not')
         call check(work%rocked > 0 .and. work%rocked < work%intervals, 'some intervals rock, some do not')
         call check(work%steps >= work%rocked .and. work%evaluations >= work%steps, 'a step at least in each')
         call check(planned%histories == work%histories .and. planned%intervals == work%intervals, 'known before')
         call check(planned%still == work%still, 'so are those that never move')
      end associate

      ! Levels just below and just above the trigger acceleration: every record reaches the level as its peak, which
      ! is a minimum or a maximum, and this wall is one-sided
      associate (mechanism => case%wall%mechanism)
         case%stripes%levels = [0.999_wp, 1.001_wp]*mechanism%trigger_acceleration()/case%solver%gravity
      end associate
      call run_case(case, results, error)
      if (.not. allocated(error)) call plan_case(case, planned, scales, error)
      call check_ok(error, 'around the trigger')
      if (allocated(error)) return
      call check(results%work%still == planned%still, 'what moves is known to the last')
      case%stripes%levels = case%stripes%levels(:1)
      call run_case(case, results, error)
      call check(results%work%still == 2 .and. results%work%histories == 2, 'nothing moves below the trigger')
      call check(all([results%work%rocked, results%work%steps, results%work%evaluations, results%work%impacts] == 0), &
         & 'and nothing is computed')
      case%solver%solver%estimate_error = .true.
      call run_case(case, results, error)
      call check(results%work%histories == 2*runs_of_estimate, 'an estimate of errors runs everything twice more')
   end subroutine test_work

   !> Result files appear whole or not at all
   subroutine test_output()
      type(case_type) :: case
      type(results_type) :: results
      type(result_files_type) :: files, second
      type(error_type), allocatable :: error
      logical :: exists

      call suite('output')
      call write_file('a.nml', stripes_case)
      call read_case(scratch//'/a.nml', case, error)
      call check_reports(case, error)
      call check_ok(error, 'a folder that can be made')
      call check(.not. is_folder(scratch//'/out'), 'the trial leaves no folder')
      call files%claim(case%job%output, table_suffixes(), error)
      call check_ok(error, 'an output that nobody writes')
      call second%claim(case%job%output, table_suffixes(), error)
      call check_error(error, 'x: ', 'an output that another run writes')
      call run_case(case, results, error, threads=1)
      call write_reports(case, results, files, error)
      call check_ok(error, 'reports')
      call check(size(files%written) == 5, 'five files')
      call check(published_run(case%job%output) == files%lock%run, 'the set is that of the run')
      inquire (file=scratch//'/out/x_fragility.csv', exist=exists)
      call check(exists, 'a table is there')
      inquire (file=scratch//'/out/x_fragility.csv.'//files%lock%run//'.part', exist=exists)
      call check(.not. exists, 'and its part is not')
      call files%close()
      call check(same_file(scratch//'/out/x_walls.csv', scratch//'/out/../out/x_walls.csv'), 'two paths of one file')
      call check(.not. same_file(scratch//'/out/x_walls.csv', scratch//'/out/x_stripes.csv'), 'two files')
      call check(.not. same_file(scratch//'/none', scratch//'/none'), 'no file')
      case%job%output = scratch//'/a.nml/x'
      call check_reports(case, error)
      call check_error(error, 'a.nml: &job: output = '''//scratch//'/a.nml/x'': the folder', 'a file for a folder')
   end subroutine test_output

   !> Tables in memory are those of the files, and a row that differs from the first is found out
   subroutine test_tables()
      type(case_type) :: case
      type(results_type) :: results
      type(table_kind_type), allocatable :: kinds(:)
      type(columns_type) :: table, odd
      type(error_type), allocatable :: error
      character(len=:), allocatable :: head
      character(len=1024) :: line
      integer :: i, k, rows, unit, stat

      call suite('tables')
      call write_file('a.nml', stripes_case)
      call read_case(scratch//'/a.nml', case, error)
      call run_case(case, results, error, threads=1)
      call check_ok(error, 'a run')
      call list_tables(kinds)
      do k = 1, size(kinds)
         call check(index(kinds(k)%suffix, '.csv ') > 0, trim(kinds(k)%suffix)//' is not cut off')
         if (.not. kinds(k)%is_of(case)) cycle
         table = columns_type()
         call kinds(k)%fill(case, results, table, error)
         call check_ok(error, trim(kinds(k)%suffix)//' in memory')
         head = ''
         do i = 1, table%names%count
            head = head//','//table%names%line(i)%text
         end do
         ! As test_output has written it
         open (newunit=unit, file=scratch//'/out/x'//trim(kinds(k)%suffix), action='read', status='old')
         rows = -1
         do
            read (unit, '(a)', iostat=stat) line
            if (stat /= 0) exit
            if (line(1:1) == '#') cycle
            if (rows == -1) call check_text(head(2:), trim(line), 'columns of '//trim(kinds(k)%suffix))
            rows = rows + 1
         end do
         close (unit)
         call check(rows == table%rows .and. rows > 0, 'as many rows')
      end do
      associate (column => table%columns)
         call check(column(1)%kind == text_column .and. column(1)%text(:column(1)%length) == 'it''s'//lf, 'texts, each ended')
         call check(column(1)%words == 1 .and. all(column(1)%number(:table%rows) == 1.0_wp), 'texts that differ')
         call check(column(12)%kind == real_column, 'numbers')
         call check_close(column(12)%number(1), 0.9_wp, 0.0_wp, 'the threshold of the curve')
      end associate

      call odd%put('a', 1)
      call odd%put('b', 2.0_wp, given=.false.)
      call odd%end_row()
      call check(odd%is_regular .and. odd%columns(1)%kind == integer_column, 'a row makes the columns')
      call check(.not. odd%columns(2)%number(1) >= 0.0_wp .and. .not. odd%columns(2)%number(1) < 0.0_wp, 'no number')
      call odd%put('a', 1)
      call odd%put('c', 2.0_wp)
      call odd%end_row()
      call check(.not. odd%is_regular, 'another name')
      odd%is_regular = .true.
      call odd%put('a', 1)
      call odd%end_row()
      call check(.not. odd%is_regular, 'a column is left out')
      odd%is_regular = .true.
      call odd%put('a', 'x')
      call odd%put('b', 2.0_wp)
      call odd%put('c', 2.0_wp)
      call odd%end_row()
      call check(.not. odd%is_regular, 'a column too many, and another kind')
   end subroutine test_tables

   !> Texts that differ are kept once, whatever the number of rows: more than 2**31 bytes of them in all
   subroutine test_texts()
      integer, parameter :: rows = 2150000
      character(len=1000) :: long(2)
      type(columns_type) :: table
      integer :: i

      call suite('texts')
      long = [repeat('a', 999)//'b', repeat('a', 999)//'c']
      do i = 1, rows
         call table%put('record', long(1 + modulo(i/7, 2)))
         call table%end_row()
      end do
      call check(.not. allocated(table%error) .and. table%rows == rows, 'two billion characters')
      associate (column => table%columns(1))
         call check(column%words == 2 .and. len(column%text) < 10000, 'texts that differ')
         do i = 1, rows
            if (nint(column%number(i)) /= 1 + modulo(i/7, 2)) exit
         end do
         call check(i > rows, 'which of them each row has')
      end associate
      table = columns_type()
      do i = 1, 3000
         call table%put('name', 'wall'//repeat(' ', modulo(i, 3))//to_text(i/3))
         call table%put('other', repeat(' ', modulo(i, 3)))
         call table%end_row()
      end do
      associate (column => table%columns)
         call check(column(1)%words == 3000 .and. index(column(1)%text, lf//'wall  5'//lf) > 0, 'each of its own')
         ! The index does not tell them apart: those that it does not know are kept once more.
         call check(index(column(2)%text, ' '//lf//'  '//lf//lf) == 1 .and. column(2)%number(4) == 1.0_wp, 'blanks differ')
      end associate
   end subroutine test_texts

   !> A file that must be refused
   subroutine check_refused(content, part)
      character(len=*), intent(in) :: content, part
      type(namelist_type) :: namelist
      type(error_type), allocatable :: error

      call write_file('a.nml', content)
      call read_namelist(scratch//'/a.nml', namelist, error)
      call check_error(error, part, content)
   end subroutine check_refused

   !> A file that must be read
   subroutine check_accepted(content)
      character(len=*), intent(in) :: content
      type(namelist_type) :: namelist
      type(error_type), allocatable :: error

      call write_file('a.nml', content)
      call read_namelist(scratch//'/a.nml', namelist, error)
      call check_ok(error, content)
   end subroutine check_accepted

   !> The files that the cases name
   subroutine write_inputs()
      character(len=:), allocatable :: first, second
      real(wp) :: t
      integer :: i

      first = ''
      second = ''
      do i = 0, 500
         t = 0.01_wp*real(i, wp)
         first = first//to_text(real(nint(3.0e4_wp*sin(6.0_wp*t)*exp(-(t - 2.0_wp)**2)), wp)*1.0e-4_wp)//lf
         second = second//to_text(real(nint(4.0e4_wp*sin(3.0_wp*t)*exp(-(t - 2.2_wp)**2)), wp)*1.0e-4_wp)//lf
      end do
      call write_file('one.txt', first)
      call write_file('two.txt', second)
      call write_file('records.csv', 'file,dt_s,units'//lf//'one.txt,0.01,m/s2'//lf//'two.txt,0.01,m/s2'//lf)
      call write_file('walls.csv', 'name,mechanism,height,thickness,hinge,weight'//lf//'a,one_sided,3,0.25,,2'//lf// &
         & ',two_block,3,0.25,0.6,'//lf//'"a, b",free_standing,3,0.25,,0'//lf)
   end subroutine write_inputs

   !> Write a small file
   subroutine write_file(file, content)
      character(len=*), intent(in) :: file, content
      integer :: unit

      open (newunit=unit, file=scratch//'/'//file, access='stream', form='unformatted', action='write', &
         & status='replace')
      write (unit) content
      close (unit)
   end subroutine write_file

end program test_case
