!> Tests of populations that run in blocks: everything wrong at once, the same for any threads and blocks, runs that were
!> killed at any byte, parts that are merged.
program test_run_population
   use, intrinsic :: iso_fortran_env, only : int64
   use checks, only : check, check_error, check_ok, check_text, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_text, only : to_text
   use dondolo_case, only : case_type
   use dondolo_case_motion_warnings, only : scale_warnings_type
   use dondolo_case_population_case, only : find_start, merge_population, store_path
   use dondolo_case_read_case, only : read_case
   use dondolo_case_reports, only : write_reports
   use dondolo_case_result_files, only : result_files_type
   use dondolo_case_result_tables, only : table_suffixes
   use dondolo_case_results, only : results_type
   use dondolo_case_run_case, only : plan_case, run_case
   use dondolo_files_checksum, only : crc32_of_text
   use dondolo_files_system, only : remove_file
   use dondolo_fragility_study, only : study_type
   use dondolo_motion_work, only : work_type
   use dondolo_population_reader, only : read_population
   use dondolo_population_row_result, only : row_result_type
   use dondolo_population_run_rows, only : run_rows
   use dondolo_population_store, only : look_into_store, open_store, store_type
   use dondolo_population_store_format, only : make_head
   use dondolo_population_wall_row, only : wall_row_type
   implicit none

   character(len=*), parameter :: scratch = 'build/test_run_population', lf = new_line('a')

   !> Five walls of three groups, two with two mechanisms
   character(len=*), parameter :: population = 'name,mechanism,height,thickness,hinge,weight,group,p_occ'//lf// &
      & 'a,one_sided,3,0.25,,2,old,0.7'//lf//'a,two_block,3,0.25,0.6,2,old,0.4'//lf// &
      & 'b,one_sided,2,0.3,,1,new,'//lf//'c,free_standing,1,0.2,,1,,'//lf//'d,two_block,4,0.3,0.5,3,new,'//lf// &
      & 'e,one_sided,2.5,0.25,,1,old,1'//lf//'e,two_block,2.5,0.25,,1,old,0.5'//lf

   character(len=*), parameter :: case_text = "&job task = 'typology' output = '"//scratch//"/out/z' histories = T /"// &
      & lf//"&population file = 'walls.csv' /"//lf//"&records catalogue = 'records.csv' polarity = 'both' /"//lf// &
      & "&stripes levels = 0.1, 0.2, 0.35, 0.5, 0.8, 9, edp_thresholds = 0.2, 1 /"

   character(len=9), parameter :: tables(5) = [character(len=9) :: 'walls', 'histories', 'stripes', 'fragility', &
      & 'typology']

   integer :: last_done
   logical :: is_monotonic

   call make_files()
   call test_problems()
   call test_threads()
   call test_first_error()
   call test_file()
   call test_killed()
   call test_damaged()
   call test_meddled()
   call test_key()
   call test_parts()
   call finish()

contains

   !> The files of the case
   subroutine make_files()

      call execute_command_line('rm -rf '//scratch//' && mkdir -p '//scratch//'/out')
      call write_file('records.csv', 'file,dt_s,units'//lf//'one.txt,0.02,m/s2'//lf//'two.txt,0.02,m/s2'//lf)
      call write_file('one.txt', waves(1.0_wp))
      call write_file('two.txt', waves(1.7_wp))
      call write_file('walls.csv', population)
      call write_file('a.nml', case_text)
   end subroutine make_files

   !> Ground motion: two waves that grow and fade
   function waves(frequency) result(text)
      real(wp), intent(in) :: frequency
      character(len=:), allocatable :: text

      character(len=16) :: number
      integer :: i

      text = ''
      do i = 0, 400
         associate (t => 0.02_wp*real(i, wp))
            write (number, '(f12.6)') sin(6.0_wp*frequency*t)*t*exp(-t) + 0.3_wp*sin(17.0_wp*t)*exp(-0.5_wp*t)
         end associate
         text = text//trim(adjustl(number))//lf
      end do
   end function waves

   !> Everything that is wrong with a population is said at once
   subroutine test_problems()
      type(case_type) :: case
      type(wall_row_type), allocatable :: table_rows(:)
      type(error_type), allocatable :: error
      integer :: i

      call suite('problems')
      call write_file('walls.csv', 'name,mechanism,height,thickness,weight,group,p_occ'//lf// &
         & 'a,one_sided,3,0.25,,,'//lf//'a,one_sided,3,0.25,,,'//lf//'b,one_sided,-3,0.25,,,'//lf// &
         & 'c,one_sided,x,0.25,,,'//lf//'d,one_sided,3'//lf//'e,one_sided,3,0.25,-1,,'//lf// &
         & 'f,one_sided,3,0.25,,,1.5'//lf//'g,one_sided,3,0.25,2,x,'//lf//'g,two_block,3,0.25,3,x,'//lf// &
         & 'h,one_sided,3,0.25,,x,'//lf//'h,two_block,3,0.25,,y,'//lf//'a,two_block,3,0.25,,,'//lf// &
         & 'i,"o'//lf//'n",3,0.25,,,'//lf)
      call read_population(scratch//'/walls.csv', table_rows, error)
      call check_problems(error)
      call read_case(scratch//'/a.nml', case, error)
      call check_problems(error)
      call write_file('walls.csv', population//'j,two_block,2,0.2,0.5,1,new,1'//lf)
      call write_file('a.nml', case_text//' &solver edp_limit = 25 /')
      call read_case(scratch//'/a.nml', case, error)
      call check_error(error, 'walls.csv: line 2: edp_limit = 25', 'a limit beyond the geometry')
      if (allocated(error)) call check(lines_of(error%message) == 8, 'of every wall')
      call write_file('a.nml', case_text)
      call write_file('walls.csv', 'name,mechanism,height,thickness,weight'//lf//'a,one_sided,3,0.25,0'//lf)
      call read_case(scratch//'/a.nml', case, error)
      call check_error(error, 'walls.csv: weight: must be positive for at least one wall', 'no weight at all')
      call write_file('walls.csv', 'name,mechanism,height,thickness,weight'//lf)
      call read_case(scratch//'/a.nml', case, error)
      call check_error(error, 'walls.csv: no walls under the header', 'no walls')
      call write_file('walls.csv', 'name,mechanism,height,thickness,group'//lf//'wall 2,one_sided,3,0.25,'//lf// &
         & ',two_block,3,0.25,'//lf//'"a'//achar(27)//'[1m",one_sided,3,0.25,'//lf//'b,one_sided,3,0.25,"c'//lf//'d"'//lf)
      call read_population(scratch//'/walls.csv', table_rows, error)
      call check_error(error, 'line 3: name = ''wall 2'': another wall has this name (line 2)', &
         & 'a wall without a name is no mechanism of the one before')
      if (allocated(error)) then
         call check(index(error%message, 'line 4: name = ''a\x1b[1m'': must be one line') > 0, 'a control character')
         call check(index(error%message, 'line 5: group = ''c\nd'': must be one line') > 0, 'a line end in a group')
      end if
      call write_file('walls.csv', 'name,mechanism,height,thickness'//lf//',one_sided,3,0.25'//lf// &
         & 'wall 1,two_block,3,0.25'//lf)
      call read_population(scratch//'/walls.csv', table_rows, error)
      call check_error(error, 'line 3: name = ''wall 1'': another wall has this name (line 2)', &
         & 'a wall called what one without a name is called')
      call write_file('walls.csv', 'name,mechanism,height,thickness'//lf//'a,one_sided,3,0.25'//lf// &
         & 'b,one_sided,x,0.25'//lf//'a,one_sided,3,0.25'//lf//'c,one_sided,3,0.25'//lf//'c,two_block,-3,0.25'//lf// &
         & 'c,free_standing,3,0.25'//lf)
      call read_population(scratch//'/walls.csv', table_rows, error)
      call check_error(error, 'line 4: name = ''a'': another wall has this name (line 2)', 'behind a wall that is wrong')
      if (allocated(error)) call check(lines_of(error%message) == 3, 'a wall goes on behind a row that is wrong')
      call write_file('walls.csv', 'mechanism,height,thickness,p_occ,weight'//lf//'one_sided,3,0.25,-0.00,-0'//lf// &
         & 'one_sided,3,0.25,1,1'//lf)
      call read_population(scratch//'/walls.csv', table_rows, error)
      call check_ok(error, 'zeros with a sign')
      if (allocated(table_rows)) call check(all(sign(1.0_wp, [table_rows%p_occ, table_rows%weight]) > 0.0_wp), 'lose it')
      call write_file('walls.csv', 'mechanism,height,thickness,group'//lf//'one_sided,3,0.25,"  "'//lf)
      call read_population(scratch//'/walls.csv', table_rows, error)
      call check_ok(error, 'a group of blanks')
      if (allocated(table_rows)) call check(len(table_rows(1)%group) == 0, 'is none')
      call write_file('walls.csv', 'name,mechanism,height,thickness,hinge,weight,p_occ,eccentricity'//lf// &
         & 'a,one_sided,-3,0,0.5,-1,2,'//lf//'b,two_block,3,0.3,1.5,y,1,4'//lf//'c,two_bloc,x,,,,,'//lf)
      call read_population(scratch//'/walls.csv', table_rows, error)
      call check_row(error, 2, [character(len=60) :: 'height = -3: must be positive', &
         & 'thickness = 0: must be positive', 'hinge = 0.5: only for mechanism = ''two_block''', &
         & 'weight = -1: must lie between 0 and', 'p_occ = 2: must lie between 0 and 1'])
      call check_row(error, 3, [character(len=60) :: 'hinge = 1.5: must lie between 0.01 and 0.99', &
         & 'eccentricity = 4: must lie between -0.15 and 0.15', 'weight = ''y'': must be a number'])
      call check_row(error, 4, [character(len=60) :: 'height = ''x'': must be a number'])
      if (allocated(error)) call check(lines_of(error%message) == 9, 'everything in a row is said, each once')
      call write_file('walls.csv', 'mechanism,height,thickness,group'//lf//repeat_groups(65))
      call read_case(scratch//'/a.nml', case, error)
      call check_error(error, 'walls.csv: line 66: group = ''g65'': there may be at most 64 groups', 'groups')
      call write_file('walls.csv', 'mechanism,height,thickness'//lf//repeat('one_sided,3,-0.25'//lf, 100))
      call read_case(scratch//'/a.nml', case, error)
      call check_error(error, 'more', 'more problems than fit')
      if (allocated(error)) then
         i = lines_of(error%message)
         call check_text(error%message(index(error%message, lf, back=.true.) + 1:), 'and '//to_text(101 - i)// &
            & ' more', 'the rest is counted')
      end if
      call write_file('walls.csv', population)
      call read_case(scratch//'/a.nml', case, error, [8, 9])
      call check_error(error, '--walls 8:9: the population has 7 rows', 'rows that are not there')
   end subroutine test_problems

   !> Rows of so many groups
   function repeat_groups(number) result(text)
      integer, intent(in) :: number
      character(len=:), allocatable :: text

      integer :: i

      text = ''
      do i = 1, number
         text = text//'one_sided,3,0.25,g'//to_text(i)//lf
      end do
   end function repeat_groups

   !> The problems of the first population above
   subroutine check_problems(error)
      type(error_type), allocatable, intent(in) :: error

      character(len=*), parameter :: problems(9) = [character(len=80) :: &
         & 'line 3: name = ''a'': the row before gives this wall the same mechanism', &
         & 'line 4: height = -3: must', 'line 5: height = ''x'': must be a number', 'line 6: 3 cells: must be 7', &
         & 'line 7: weight = -1: must lie between 0 and', 'line 8: p_occ = 1.5: must lie between 0 and 1', &
         & 'line 10: weight = 3: must be 2 as in the row before', 'line 12: group = ''y'': must be ''x'' as in the row', &
         & 'line 13: name = ''a'': another wall has this name (line 2)']
      integer :: i

      do i = 1, size(problems)
         call check_error(error, trim(problems(i)), 'problem '//to_text(i))
      end do
      call check_error(error, 'line 14: mechanism = ''o\nn'': must', 'a line end in a cell')
      if (allocated(error)) call check(lines_of(error%message) == 10, 'no more problems than there are')
   end subroutine check_problems

   !> What is wrong with one row
   subroutine check_row(error, line, problems)
      type(error_type), allocatable, intent(in) :: error
      integer, intent(in) :: line
      character(len=*), intent(in) :: problems(:)

      integer :: i

      do i = 1, size(problems)
         call check_error(error, scratch//'/walls.csv: line '//to_text(line)//': '//trim(problems(i)), &
            & 'line '//to_text(line)//', problem '//to_text(i))
      end do
   end subroutine check_row

   !> Number of lines of a text
   pure integer function lines_of(text)
      character(len=*), intent(in) :: text

      integer :: i

      lines_of = 1
      do i = 1, len(text)
         if (text(i:i) == lf) lines_of = lines_of + 1
      end do
   end function lines_of

   !> A population gives the same on any number of threads: rows shared out, some of them, none
   subroutine test_threads()
      type(case_type) :: case
      type(results_type) :: alone, several
      type(error_type), allocatable :: error
      type(lines_type) :: found, expected
      integer :: threads, i

      call suite('threads')
      call read_case(scratch//'/a.nml', case, error)
      if (.not. allocated(error)) call run_case(case, alone, error, 1)
      call check_ok(error, 'one thread')
      if (allocated(error)) return
      call check(alone%work%histories == case%survey%histories, 'work of all rows')
      call check(case%survey%rows == 7 .and. case%survey%walls == 5, 'rows and walls')
      call check(size(alone%typologies, 2) == 2, 'a typology for each threshold')
      call test_states(case, alone)
      call write_tables(case, alone, 'whole')
      call alone%warnings%put_sentences(expected)
      do threads = 2, 9
         last_done = 0
         is_monotonic = .true.
         call run_case(case, several, error, threads, hear)
         call check_ok(error, to_text(threads)//' threads')
         call check(last_done == case%survey%histories, 'all is reported done')
         call check(is_monotonic, 'the work never goes back')
         call check(all(several%work%counts() == alone%work%counts()), 'counts of work')
         call check(several%warnings%count == alone%warnings%count .and. alone%warnings%count > 0, 'warnings')
         found = lines_type()
         call several%warnings%put_sentences(found)
         do i = 1, expected%count
            call check_text(found%line(i)%text, expected%line(i)%text, 'warning '//to_text(i))
         end do
         call write_tables(case, several, 'threads')
         call compare_tables('threads', to_text(threads)//' threads')
      end do
   end subroutine test_threads

   !> Run rows of a case, on one thread unless another number is given; first is the number of the first of them
   subroutine run_some_rows(case, table_rows, first, rows, error, threads)
      type(case_type), intent(in), target :: case
      type(wall_row_type), intent(in) :: table_rows(:)
      integer, intent(in) :: first
      type(row_result_type), allocatable, intent(out) :: rows(:)
      type(error_type), allocatable, intent(out) :: error
      integer, intent(in), optional :: threads

      type(study_type) :: study
      integer :: i

      call case%make_study(study, 1)
      if (present(threads)) study%threads = threads
      call run_rows(study, table_rows, rows, error, 0, 0)
      rows%row = [(first + i - 1, i=1, size(rows))]
   end subroutine run_some_rows

   !> The curves of each threshold are made of the counts of that threshold
   subroutine test_states(case, results)
      type(case_type), intent(in) :: case
      type(results_type), intent(in) :: results

      type(wall_row_type), allocatable :: table_rows(:)
      type(row_result_type), allocatable :: rows(:)
      type(error_type), allocatable :: error
      integer :: reached(size(case%stripes%levels), 2)
      real(wp) :: fraction(size(case%stripes%levels)), weight
      integer :: i, k

      call read_population(scratch//'/walls.csv', table_rows, error)
      call run_some_rows(case, table_rows, 1, rows, error)
      call check_ok(error, 'rows')
      if (allocated(error)) return
      do k = 1, 2
         fraction = 0.0_wp
         weight = 0.0_wp
         do i = 1, size(rows)
            if (table_rows(i)%wall%mechanism_name() /= results%typologies(1, k)%mechanism) cycle
            weight = weight + table_rows(i)%weight*table_rows(i)%p_occ
            reached = count(rows(i)%flags, dim=1)
            fraction = fraction + table_rows(i)%weight*table_rows(i)%p_occ*real(reached(:, k), wp)/real(rows(i)%histories, wp)
         end do
         call check(all(abs(results%typologies(1, k)%mean_fraction - fraction/weight) < 1.0e-12_wp), &
            & 'fractions of threshold '//to_text(k))
      end do
      call check(any(results%typologies(1, 1)%mean_curve > results%typologies(1, 2)%mean_curve + 0.01_wp), &
         & 'another mean curve for each threshold')
   end subroutine test_states

   !> Hear how far the work is
   subroutine hear(done, total)
      integer, intent(in) :: done, total

      is_monotonic = is_monotonic .and. done >= last_done .and. done <= total
      last_done = done
   end subroutine hear

   !> Of several rows that cannot be run, the first is named, whichever thread meets the others
   subroutine test_first_error()
      type(case_type) :: case
      type(wall_row_type), allocatable :: table_rows(:)
      type(row_result_type), allocatable :: rows(:)
      type(error_type), allocatable :: error
      integer :: threads, i

      call suite('first error')
      call read_case(scratch//'/a.nml', case, error)
      call read_population(scratch//'/walls.csv', table_rows, error)
      call check_ok(error, 'population')
      if (allocated(error)) return
      associate (bad => table_rows(2)%wall%mechanism, good => table_rows(1)%wall%mechanism)
         case%solver%solver%edp_limit = 0.5_wp*(bad%geometric_end()/bad%capacity + good%geometric_end()/good%capacity)
      end associate
      ! The first row can be run, no other can.
      table_rows = table_rows([1, (2, i=1, 7)])
      call table_rows(2)%wall%input%set('name', 'the first')
      do threads = 1, 4
         call run_some_rows(case, table_rows, 1, rows, error, threads)
         call check_error(error, 'wall ''the first'': edp_limit', to_text(threads)//' threads')
      end do
   end subroutine test_first_error

   !> A store gives back what was put in, in any order and in memory too, and anything else is refused
   subroutine test_file()
      type(case_type) :: case
      type(wall_row_type), allocatable :: table_rows(:)
      type(row_result_type), allocatable :: rows(:)
      type(store_type) :: file, memory
      type(error_type), allocatable :: error
      character(len=*), parameter :: path = scratch//'/out/rows.counts'
      character(len=:), allocatable :: ordered
      logical :: exists
      integer :: i

      call suite('store')
      call read_case(scratch//'/a.nml', case, error)
      call read_population(scratch//'/walls.csv', table_rows, error)
      call run_some_rows(case, table_rows, 1, rows, error)
      call check_ok(error, 'rows')
      if (allocated(error)) return
      call make_part(case, path, 1, 7, [3, 4])
      call look_into_store(file, path, exists, error)
      call check_ok(error, 'file')
      call check(exists .and. file%is_complete() .and. file%identity%first == 1 .and. file%identity%last == 7, 'rows')
      call open_store(memory, '', file%identity, error)
      call memory%claim(error)
      call memory%put(rows, error)
      call check_ok(error, 'in memory')
      do i = 1, 7
         call check_row_of(file, rows(i))
         call check_row_of(memory, rows(i))
      end do
      call file%close()
      call check(all(file%work%counts() == memory%work%counts()) .and. file%work%histories > 0, 'work')
      ! Out of order, row by row and some of them twice: the same bytes in the end
      ordered = contents(path)
      call remove_file(path)
      call open_store(file, path, memory%identity, error)
      call file%claim(error)
      do i = 7, 1, -1
         call file%put(rows(i:min(i + 1, 7)), error)
         call check_ok(error, 'row '//to_text(i))
      end do
      call check(contents(path) /= ordered, 'rows are appended')
      call file%close()
      call check(contents(path) == ordered, 'and brought into order')
      call check_row_of(file, rows(4))
      call file%close()
      call write_file('out/rows.counts', 'name,mechanism,height,thickness'//lf)
      call look_into_store(file, path, exists, error)
      call check_error(error, 'not a dondolo counts file', 'a short file of something else')
      call write_file('out/rows.counts', repeat('name,mechanism,height,thickness'//lf, 9))
      call look_into_store(file, path, exists, error)
      call check_error(error, 'not a dondolo counts file', 'a long one')
      call write_file('out/rows.counts', 'dondolo counts 1'//repeat(' ', 112))
      call look_into_store(file, path, exists, error)
      call check_error(error, 'rows.counts: was written by another version of dondolo', 'another format')
      call remove_file(path)
      call look_into_store(file, path, exists, error)
      call check(.not. exists .and. .not. allocated(error), 'no file')
   end subroutine test_file

   !> A row of a store must be what was put in
   subroutine check_row_of(store, expected)
      type(store_type), intent(inout) :: store
      type(row_result_type), intent(in) :: expected

      type(row_result_type) :: row
      type(error_type), allocatable :: error

      call store%read(expected%row, row, error)
      call check_ok(error, 'row '//to_text(expected%row))
      if (allocated(error)) return
      call check(row%row == expected%row .and. row%histories == expected%histories, 'number and histories')
      call check(count(row%flags .neqv. expected%flags) == 0, 'flags')
      call check(all(row%work%counts() == expected%work%counts()), 'work of a row')
      call check(all(row%response%edp == expected%response%edp) .and. &
         & all(row%response%impacts == expected%response%impacts) .and. &
         & all(row%response%collapsed .eqv. expected%response%collapsed) .and. &
         & all(row%response%time_of_peak == expected%response%time_of_peak), 'histories')
   end subroutine check_row_of

   !> A run that was killed at any byte goes on, and ends with the same bytes
   subroutine test_killed()
      type(case_type) :: case
      type(results_type) :: results
      type(store_type) :: file
      type(error_type), allocatable :: error
      character(len=:), allocatable :: whole, path
      logical :: exists
      integer :: bytes, step, before

      call suite('killed')
      call read_case(scratch//'/a.nml', case, error)
      call check_ok(error, 'case')
      if (allocated(error)) return
      path = trim(store_path(case))
      call make_part(case, path, 1, 7, [2, 4])
      call look_into_store(file, path, exists, error)
      call check(file%done == 6, 'two blocks')
      whole = contents(path)
      step = max(1, len(whole)/40)
      before = 0
      do bytes = 0, len(whole) + step - 1, step
         call write_file('out/z.checkpoint', whole(:min(bytes, len(whole))))
         call run_case(case, results, error, 2)
         call check_ok(error, 'resumed after '//to_text(bytes)//' bytes')
         if (allocated(error)) return
         call check(results%resumed >= before, 'whole rows are taken')
         before = results%resumed
         call write_tables(case, results, 'resumed')
         call compare_tables('resumed', 'resumed after '//to_text(bytes)//' bytes')
      end do
      call check(before == 6, 'all rows in the end')
      ! A byte that was changed spoils its row and those behind it, which the run makes again.
      whole(len(whole)/2:len(whole)/2) = char(modulo(iachar(whole(len(whole)/2:len(whole)/2)) + 1, 256))
      call write_file('out/z.checkpoint', whole)
      call run_case(case, results, error, 1)
      call check_ok(error, 'a byte was changed')
      call check(results%resumed > 0 .and. results%resumed < 6, 'it spoils one row')
      call write_tables(case, results, 'resumed')
      call compare_tables('resumed', 'a byte was changed')

      call write_file('out/z.checkpoint', whole)
      call write_file('a.nml', case_text//' &solver rtol = 1e-9 /')
      call read_case(scratch//'/a.nml', case, error)
      call run_case(case, results, error, 1)
      call check_error(error, 'z.checkpoint: belongs to another study: rtol 1e-8 there, 1e-9 here', 'other settings')
      call write_file('a.nml', case_text)
      call write_file('walls.csv', population//'f,one_sided,3,0.2,,1,old,1'//lf)
      call read_case(scratch//'/a.nml', case, error)
      call run_case(case, results, error, 1)
      call check_error(error, 'belongs to another study: number of rows 7 there, 8 here; other walls; remove it', 'other walls')
      call write_file('walls.csv', population)
      call remove_file(path)
   end subroutine test_killed

   !> Any byte that is changed is seen: in the head, which is refused, or in a row, which is left with those behind it
   subroutine test_damaged()
      type(case_type) :: case
      type(store_type) :: file
      type(error_type), allocatable :: error
      character(len=*), parameter :: path = scratch//'/out/rows.counts'
      integer, parameter :: own = 40
      character(len=:), allocatable :: whole, spoilt, begin
      logical :: exists
      integer :: at, head, second, step, change

      call suite('damaged')
      call read_case(scratch//'/a.nml', case, error)
      call check_ok(error, 'case')
      if (allocated(error)) return
      call make_part(case, path, 1, 7, [1])
      whole = contents(path)
      second = len(whole)
      call make_part(case, path, 1, 7, [1, 6])
      whole = contents(path)
      call look_into_store(file, path, exists, error)
      call make_head(file%identity, begin)
      head = len(begin)
      do change = 1, 128, 127
         at = 1
         do while (at <= len(whole))
            spoilt = whole
            spoilt(at:at) = char(modulo(iachar(whole(at:at)) + change, 256))
            call write_file('out/rows.counts', spoilt)
            call look_into_store(file, path, exists, error)
            if (at <= head) then
               ! A length of the head beyond the file is that of a run that has hardly begun.
               if (exists .or. .not. (at > 17 .and. at < 26)) call check_error(error, 'rows.counts: ', 'byte '//to_text(at))
               call check(.not. exists, 'nothing is taken of it')
            else
               call check_ok(error, 'byte '//to_text(at))
               if (at <= second) call check(file%done == 0, 'rows before byte '//to_text(at))
               if (at > second) call check(file%done >= 1 .and. file%done < 7, 'rows before byte '//to_text(at))
            end if
            ! All of the head of the file and of the heads of rows, and some of the rest
            step = 1
            if (at > head + own) step = 211
            if (at < second - 1) step = min(step, second - at)
            if (at >= second .and. at < second + own) step = 1
            at = at + step
         end do
      end do
      call remove_file(path)
   end subroutine test_damaged

   !> A file that another run writes, or that has another name than its rows, and a table that changes during the run
   subroutine test_meddled()
      type(case_type) :: case, part
      type(results_type) :: results
      type(store_type) :: file, other
      type(row_result_type), allocatable :: rows(:)
      type(wall_row_type), allocatable :: table_rows(:)
      type(work_type) :: work, planned
      type(scale_warnings_type) :: scales
      type(error_type), allocatable :: error
      character(len=:), allocatable :: whole, path
      logical :: exists

      call suite('meddled')
      call read_case(scratch//'/a.nml', case, error)
      call read_population(scratch//'/walls.csv', table_rows, error)
      call check_ok(error, 'population')
      if (allocated(error)) return
      path = trim(store_path(case))

      call make_part(case, path, 1, 7, [2])
      call find_start(case, file, error)
      whole = contents(path)
      call run_some_rows(case, table_rows(3:4), 3, rows, error)
      call file%claim(error)
      call check_ok(error, 'one run')
      call find_start(case, other, error)
      call other%claim(error)
      call check_error(error, 'z.checkpoint: is being written by another run', 'two runs')
      call write_file('out/z.checkpoint', whole//'a block of another run')
      call file%put(rows, error)
      call check_error(error, 'z.checkpoint: has changed since this run began: does another run write it?', 'no locks')
      call check_text(contents(path), whole//'a block of another run', 'the other run is left alone')
      call remove_file(path)
      call file%put(rows, error)
      call check_error(error, 'has changed since this run began', 'another run has ended')
      inquire (file=path, exist=exists)
      call check(.not. exists, 'no file is left that does not begin as one')
      call file%close()
      ! Another run puts a row in between, and ends.
      call make_part(case, path, 1, 7, [1])
      call find_start(case, file, error)
      call check(file%done == 1, 'one row')
      call make_part(case, path, 1, 7, [3])
      call file%claim(error)
      call check_ok(error, 'after another run')
      call check(file%done == 3, 'its rows are taken')
      call file%close()
      call remove_file(path)

      call read_case(scratch//'/a.nml', part, error, [3, 7])
      call run_case(part, results, error, 1)
      call check_ok(error, 'part')
      call write_file('out/z.checkpoint', contents(trim(store_path(part))))
      call results%remove_stores()
      call run_case(case, results, error, 1)
      call check_error(error, 'z.checkpoint: is of rows 3 to 7; remove it', 'a part under the name of the whole')
      call remove_file(path)

      ! A run is of the table as it was read, whatever becomes of the file.
      call plan_case(case, planned, scales, error)
      call check_ok(error, 'a plan')
      call write_file('walls.csv', replaced(population, 'b,one_sided,2,', 'b,one_sided,3,'))
      call run_case(case, results, error, 1)
      call check_ok(error, 'another table')
      call write_file('walls.csv', population(:index(population, 'd,two_block') - 1))
      call write_tables(case, results, 'meddled')
      call compare_tables('meddled', 'the table as it was read')
      call check(index(contents(scratch//'/meddled/z_run.json'), '"crc32": "'//crc32_of_text(population)//'"') > 0, &
         & 'its checksum')
      call plan_case(case, work, scales, error)
      call check_ok(error, 'a table that is shorter than it was')
      call check(work%histories > 0 .and. work%histories == planned%histories, 'is planned as it was read')
      ! What a run has left is of the table that it has read.
      call write_file('walls.csv', population)
      call make_part(case, path, 1, 7, [3])
      call write_file('walls.csv', replaced(population, 'b,one_sided,2,', 'b,one_sided,3,'))
      call read_case(scratch//'/a.nml', case, error)
      call check_ok(error, 'the case with another table')
      call run_case(case, results, error, 1)
      call check_error(error, 'z.checkpoint: belongs to another study: other walls', 'a table that changed before a run goes on')
      call write_file('walls.csv', population)
      call remove_file(path)
   end subroutine test_meddled

   !> A checkpoint is of everything that results depend on
   subroutine test_key()
      type(case_type) :: case, other
      type(error_type), allocatable :: error
      character(len=*), parameter :: elsewhere = 'belongs to another study: ', shaken = elsewhere//'other records'

      call suite('key')
      call read_case(scratch//'/a.nml', case, error)
      call check_ok(error, 'case')
      if (allocated(error)) return
      call make_part(case, trim(store_path(case)), 1, 7, [2])
      other = case
      other%job%histories = .false.
      call refuse(case, other, elsewhere//'histories kept there, not kept here', 'histories')
      other%stripes%levels(1) = 0.11_wp
      call refuse(case, other, elsewhere//'levels 0.1, 0.2, 0.35, 0.5, 0.8, 9 there, 0.11', 'a level')
      other%stripes%thresholds(1) = 0.3_wp
      call refuse(case, other, elsewhere, 'a threshold')
      other%stripes%levels = case%stripes%levels(:5)
      other%stripes%thresholds = [case%stripes%levels(6), case%stripes%thresholds]
      call refuse(case, other, elsewhere, 'a level as a threshold')
      other%stripes%levels = [case%stripes%levels, case%stripes%thresholds(1)]
      other%stripes%thresholds = case%stripes%thresholds(2:)
      call refuse(case, other, elsewhere, 'a threshold as a level')
      other%stripes%scaling%name = 'pgv'
      call refuse(case, other, elsewhere//'im pga there, pgv here', 'the intensity measure')
      other%records_input%polarity = 'reversed'
      call refuse(case, other, elsewhere//'polarity both there, reversed here', 'the polarity')
      other%suite%records(1)%acceleration(100) = 2.0_wp
      call refuse(case, other, shaken, 'a sample of a record')
      other%suite%records(2)%dt = 0.01_wp
      call refuse(case, other, shaken, 'the step of a record')
      other%suite%records(2)%name = 'three'
      call refuse(case, other, shaken, 'the name of a record')
      other%solver%solver%rtol = 1.0e-9_wp
      call refuse(case, other, elsewhere, 'rtol')
      other%solver%solver%atol = 1.0e-9_wp
      call refuse(case, other, elsewhere, 'atol')
      other%solver%solver%edp_limit = 1.1_wp
      call refuse(case, other, elsewhere, 'the limit')
      other%solver%solver%engine = 'single'
      call refuse(case, other, elsewhere//'engine auto there, single here', 'the engine')
      call remove_file(trim(store_path(case)))
   end subroutine test_key

   !> The checkpoint of a case is not taken for another one, which is made the same again
   subroutine refuse(case, other, why, what)
      type(case_type), intent(in) :: case
      type(case_type), intent(inout) :: other
      character(len=*), intent(in) :: why, what

      type(results_type) :: results
      type(error_type), allocatable :: error

      call run_case(other, results, error, 1)
      call check_error(error, 'z.checkpoint: '//why, what)
      other = case
   end subroutine refuse

   !> A text with a part of it replaced
   function replaced(text, old, new)
      character(len=*), intent(in) :: text, old, new
      character(len=:), allocatable :: replaced

      integer :: at

      at = index(text, old)
      replaced = text(:at - 1)//new//text(at + len(old):)
   end function replaced

   !> Parts that are merged are the whole
   subroutine test_parts()
      type(case_type) :: case
      type(results_type) :: results
      type(lines_type) :: paths, some
      type(error_type), allocatable :: error
      integer :: i
      integer, parameter :: bounds(4) = [0, 1, 5, 7]

      call suite('parts')
      do i = size(bounds) - 1, 1, -1
         call read_case(scratch//'/a.nml', case, error, [bounds(i) + 1, merge(99, bounds(i + 1), i == 3)])
         call check_ok(error, 'part')
         if (allocated(error)) return
         call run_case(case, results, error, i)
         call check_ok(error, 'part '//to_text(i))
         call check(.not. allocated(results%typologies), 'a part has no curves')
         call paths%add(trim(store_path(case)))
      end do
      call check_text(paths%line(2)%text, scratch//'/out/z_walls_2-5.counts', 'name of a part')
      call read_case(scratch//'/a.nml', case, error)
      call merge_population(case, paths, results, error)
      call check_ok(error, 'merged')
      if (allocated(error)) return
      call write_tables(case, results, 'merged')
      call compare_tables('merged', 'merged')
      ! More histories than one run can count
      case%survey%histories = 3000000000_int64
      call merge_anew(case, paths, error)
      call check_ok(error, 'parts may have any number of histories together')
      call run_case(case, results, error, 1)
      call check_error(error, 'walls.csv: 3000000000 histories: run at most 2147483647 at a time', 'one run may not')
      call read_case(scratch//'/a.nml', case, error)
      call some%add(paths%line(3)%text)
      call some%add(paths%line(1)%text)
      call merge_anew(case, some, error)
      call check_error(error, '--merge: row 2 of 7 is missing from the files', 'a part missing')
      call some%add(paths%line(2)%text)
      call some%add(paths%line(1)%text)
      call merge_anew(case, some, error)
      call check_error(error, 'z_walls_6-7.counts: row 6 also occurs in another file', 'a part twice')
      call make_part(case, scratch//'/out/z_walls_2-5.counts', 2, 5, [2])
      call merge_anew(case, paths, error)
      call check_error(error, 'z_walls_2-5.counts: has 2 of 4 rows: run it again', 'a part not complete')
      call read_case(scratch//'/a.nml', case, error, [1, 9])
      call check_text(trim(store_path(case)), scratch//'/out/z_walls_1-7.counts', 'all rows, asked for, are a part')
      call write_file('a.nml', case_text//' &solver gravity = 9.8 /')
      call read_case(scratch//'/a.nml', case, error)
      call merge_anew(case, paths, error)
      call check_error(error, 'belongs to another study: other walls', 'another gravity')
      call write_file('a.nml', case_text)
   end subroutine test_parts

   !> Merge with new results
   subroutine merge_anew(case, paths, error)
      type(case_type), intent(inout) :: case
      type(lines_type), intent(in) :: paths
      type(error_type), allocatable, intent(out) :: error

      type(results_type) :: results

      call merge_population(case, paths, results, error)
   end subroutine merge_anew

   !> A store with blocks of given sizes
   subroutine make_part(case, path, first, last, blocks)
      type(case_type), intent(in) :: case
      character(len=*), intent(in) :: path
      integer, intent(in) :: first, last, blocks(:)

      type(wall_row_type), allocatable :: table_rows(:)
      type(row_result_type), allocatable :: rows(:)
      type(store_type) :: whole, file
      type(error_type), allocatable :: error
      integer :: i, from

      call read_population(scratch//'/walls.csv', table_rows, error)
      call remove_file(path)
      call remove_file(trim(store_path(case)))
      call find_start(case, whole, error)
      whole%identity%first = first
      whole%identity%last = last
      call open_store(file, path, whole%identity, error)
      call file%claim(error)
      from = first
      do i = 1, size(blocks)
         call run_some_rows(case, table_rows(from:from + blocks(i) - 1), from, rows, error)
         call file%put(rows, error)
         from = from + blocks(i)
      end do
      call file%close()
      call check_ok(error, 'blocks')
   end subroutine make_part

   !> Write the tables of a run elsewhere than its case says; its counts are removed unless they are parts
   subroutine write_tables(case, results, name)
      type(case_type), intent(in) :: case
      type(results_type), intent(inout) :: results
      character(len=*), intent(in) :: name

      type(case_type) :: elsewhere
      type(result_files_type) :: files
      type(error_type), allocatable :: error

      elsewhere = case
      elsewhere%job%output = scratch//'/'//name//'/z'
      call files%claim(elsewhere%job%output, table_suffixes(), error)
      if (.not. allocated(error)) call write_reports(elsewhere, results, files, error)
      call check_ok(error, 'tables '//name)
      call files%close()
      if (size(results%stores) == 1) call results%remove_stores()
   end subroutine write_tables

   !> Tables must be those of the whole run, but for their output and the name of the run
   subroutine compare_tables(name, what)
      character(len=*), intent(in) :: name, what

      character(len=:), allocatable :: path, expected, found
      integer :: i, at

      do i = 1, size(tables)
         path = '/z_'//trim(tables(i))//'.csv'
         expected = without_run(contents(scratch//'/whole'//path))
         found = without_run(contents(scratch//'/'//name//path))
         at = index(found, '/'//name//'/z')
         call check(at > 0 .and. found == expected(:at)//name//expected(at + 6:), what//': '//trim(tables(i)))
      end do
   end subroutine compare_tables

   !> A table but for the name of the run
   function without_run(table) result(text)
      character(len=*), intent(in) :: table
      character(len=:), allocatable :: text

      integer :: first, last

      first = index(table, '# run: ')
      last = first + index(table(first:), new_line('a'))
      text = table(:first - 1)//table(last:)
   end function without_run

   !> All of a file
   function contents(path) result(text)
      character(len=*), intent(in) :: path
      character(len=:), allocatable :: text

      integer(int64) :: bytes
      integer :: unit

      inquire (file=path, size=bytes)
      allocate (character(len=max(0, int(bytes))) :: text)
      open (newunit=unit, file=path, access='stream', form='unformatted', action='read', status='old')
      if (len(text) > 0) read (unit) text
      close (unit)
   end function contents

   !> Write a file
   subroutine write_file(name, text)
      character(len=*), intent(in) :: name, text

      integer :: unit

      open (newunit=unit, file=scratch//'/'//name, access='stream', form='unformatted', status='replace')
      write (unit) text
      close (unit)
   end subroutine write_file

end program test_run_population
