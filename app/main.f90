!> dondolo: from accelerograms and walls to fragility curves, on the command line.
program dondolo_main
   use, intrinsic :: iso_fortran_env, only : error_unit, int64, output_unit
   use dondolo_arguments, only : arguments_type, read_arguments
   use dondolo_base_error, only : error_type, raise_failure, status_failure, status_input, status_missing
   use dondolo_base_interrupt, only : die_of_signal, end_in_order
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_plain, only : visible
   use dondolo_base_threads, only : available_threads, given_threads
   use dondolo_benchmark, only : run_benchmark
   use dondolo_build_lines, only : print_build
   use dondolo_case, only : case_type
   use dondolo_case_cited, only : list_used
   use dondolo_case_job_group, only : typology_task
   use dondolo_case_population_case, only : merge_population
   use dondolo_case_read_case, only : read_case
   use dondolo_case_replaced, only : describe_replaced, list_outdated
   use dondolo_case_reports, only : check_reports, write_reports
   use dondolo_case_result_files, only : result_files_type
   use dondolo_case_result_tables, only : table_suffixes
   use dondolo_case_results, only : results_type
   use dondolo_case_run_case, only : run_case
   use dondolo_completion, only : print_completion
   use dondolo_example, only : print_example
   use dondolo_files_process, only : hold_console, receive_file, sleep_while_waiting
   use dondolo_files_references, only : list_bibtex
   use dondolo_files_system, only : output_arrives, set_up_process, stderr_is_terminal
   use dondolo_files_version, only : dondolo_version_text
   use dondolo_front_door, only : hand_over
   use dondolo_help, only : print_help
   use dondolo_motion_lane_variants, only : build_variant, check_variant
   use dondolo_plan, only : print_plan
   use dondolo_progress_bar, only : erase_progress, show_progress, start_progress
   use dondolo_status, only : print_status
   use dondolo_summary, only : print_summary
   use dondolo_template, only : print_template
   implicit none

   !> What a double click shows
   character(len=*), parameter :: first_steps = 'To run a case, drop its file on dondolo.exe. For all else, call dondolo in a'// &
      & new_line('a')//'command prompt: open the folder of your study, type cmd into the address bar of its'// &
      & new_line('a')//'window, press Enter, and then type'//new_line('a')//new_line('a')// &
      & '   dondolo --example parapet > parapet.nml     to print a ready case'//new_line('a')// &
      & '   dondolo parapet.nml                         to run it'//new_line('a')// &
      & '   dondolo --help                              to list the options'//new_line('a')//new_line('a')// &
      & 'with the path of this program in the place of dondolo if it is not in Path.'//new_line('a')// &
      & 'docs\windows.html, beside the folder bin, explains each step.'//new_line('a')//new_line('a')// &
      & 'Press any key to close this window.'//new_line('a')

   type(arguments_type) :: arguments
   type(error_type), allocatable :: error
   integer :: i

   call set_up_process()
   if (command_argument_count() == 0) call hold_console(first_steps)
   call read_arguments(arguments, error)
   if (allocated(error)) call give_up(error)
   if (arguments%action == 'run' .and. command_argument_count() == 1) call receive_file(arguments%case_file)
   ! What computes on several threads
   if (any(arguments%action == [character(len=9) :: 'run', 'check', 'merge', 'benchmark'])) then
      if (available_threads() > 1) call sleep_while_waiting()
   end if
   select case (arguments%action)
   case ('help')
      call print_help()
   case ('version')
      call check_variant(error)
      if (allocated(error)) call give_up(error)
      write (output_unit, '(a)') 'dondolo '//dondolo_version_text, 'build variant '//trim(build_variant())
      if (arguments%verbose) call print_build()
   case ('template')
      call print_template(arguments%task)
   case ('example')
      call print_example(arguments%name, error)
      if (allocated(error)) call give_up(error)
   case ('completion')
      call print_completion(arguments%name)
   case ('cite')
      call cite(error)
      if (allocated(error)) call give_up(error)
   case ('python')
      call hand_over(arguments%command, error)
      if (allocated(error)) call give_up(error)
   case ('benchmark')
      call check_variant(error)
      if (allocated(error)) call give_up(error)
      call run_benchmark(arguments%seconds, team(0), arguments%quiet, error)
      if (allocated(error)) call give_up(error)
   case ('status')
      call print_status(arguments%case_file, error)
      do i = 1, arguments%parts%count
         if (.not. allocated(error)) call print_status(arguments%parts%line(i)%text, error)
      end do
      if (allocated(error)) call give_up(error)
   case default
      call serve(arguments, error)
      if (allocated(error)) call give_up(error)
   end select
   if (.not. output_arrives()) then
      call raise_failure(error, 'standard output: cannot be written whole: is the disk full?')
      call give_up(error)
   end if

contains

   !> Check a case, or run it
   subroutine serve(arguments, error)
      !> What the command line asks for
      type(arguments_type), intent(in) :: arguments
      !> What went wrong
      type(error_type), allocatable, intent(out) :: error

      ! On the heap: stacks may be small.
      type(case_type), allocatable :: case
      type(results_type), allocatable :: results
      type(result_files_type) :: files
      type(lines_type) :: warnings, replaced
      integer(int64) :: start, finish, rate
      integer :: threads
      logical :: has_results

      allocate (case, results)
      if (allocated(arguments%rows)) then
         call read_case(arguments%case_file, case, error, arguments%rows)
      else
         call read_case(arguments%case_file, case, error)
      end if
      if (.not. allocated(error)) call check_reports(case, error)
      if (allocated(error)) return
      call print_lines('note', case%notes)
      if (arguments%action == 'check') then
         call print_plan(case, arguments%quiet, warnings, error)
         if (arguments%quiet) call print_lines('warning', warnings)
         return
      end if
      ! The rows of a part go into a file of counts, which has a lock of its own.
      has_results = .not. (case%job%task == typology_task .and. case%survey%is_part)
      threads = team(case%job%threads)
      call end_in_order()
      if (has_results) call files%claim(case%job%output, table_suffixes(), error)
      if (allocated(error)) return
      if (has_results) call describe_replaced(case%job%output, replaced)
      call system_clock(start, rate)
      ! Said before a run, which may take hours; a merge replaces nothing before its parts have been found to be whole.
      if (arguments%action == 'merge') then
         call merge_population(case, arguments%parts, results, error)
         if (.not. allocated(error)) call print_lines('note', replaced)
      else if (stderr_is_terminal() .and. .not. arguments%quiet) then
         call print_lines('note', replaced)
         call start_progress()
         call run_case(case, results, error, threads, show_progress)
         call erase_progress()
      else
         call print_lines('note', replaced)
         call run_case(case, results, error, threads)
      end if
      call system_clock(finish)
      if (arguments%action == 'merge') finish = start
      if (.not. allocated(error)) call finish_run(case, results, files, real(finish - start, wp)/real(rate, wp), &
         & threads, error)
      call files%close()
   end subroutine serve

   !> Print BibTeX of dondolo and of the sources of what a case uses, of the paper alone without a case
   subroutine cite(error)
      !> The case cannot be read
      type(error_type), allocatable, intent(out) :: error

      ! On the heap: stacks may be small.
      type(case_type), allocatable :: case
      type(lines_type) :: used, bibtex
      integer :: i

      if (allocated(arguments%case_file)) then
         allocate (case)
         call read_case(arguments%case_file, case, error)
         if (allocated(error)) return
         call list_used(case, used)
      end if
      call list_bibtex(used, bibtex)
      do i = 1, bibtex%count
         write (output_unit, '(a)') bibtex%line(i)%text
      end do
   end subroutine cite

   !> Write the reports, unless the run was one part of a population, and print the results at a glance
   subroutine finish_run(case, results, files, seconds, threads, error)
      type(case_type), intent(in) :: case
      type(results_type), intent(inout) :: results
      !> The files that are to be written, claimed
      type(result_files_type), intent(inout) :: files
      !> Time of the computation [s]
      real(wp), intent(in) :: seconds
      !> Number of threads
      integer, intent(in) :: threads
      !> The reports could not be written
      type(error_type), allocatable, intent(out) :: error

      type(lines_type) :: paths, warnings, outdated
      integer :: i

      if (case%job%task == typology_task .and. case%survey%is_part) then
         call paths%add(results%stores(1)%path)
      else
         call write_reports(case, results, files, error)
         if (allocated(error)) return
         do i = 1, size(files%written)
            call paths%add(files%prefix//trim(files%written(i)%suffix))
         end do
         ! The checkpoint of a whole population has served; parts are the user's
         if (case%job%task == typology_task .and. arguments%action == 'run') call results%remove_stores()
      end if
      call results%warnings%put_sentences(warnings)
      call print_lines('warning', warnings)
      call list_outdated(case%job%output, outdated)
      call print_lines('note', outdated)
      if (.not. arguments%quiet) call print_summary(case, results, paths, seconds, threads)
   end subroutine finish_run

   !> Number of threads that will run
   integer function team(threads)
      !> Number unless the command line gives one; 0: all
      integer, intent(in) :: threads

      team = threads
      if (allocated(arguments%threads)) team = arguments%threads
      if (team == 0) team = available_threads()
      team = given_threads(team)
   end function team

   !> Print notes or warnings
   subroutine print_lines(kind, lines)
      !> What they are
      character(len=*), intent(in) :: kind
      type(lines_type), intent(in) :: lines

      integer :: i

      do i = 1, lines%count
         write (error_unit, '(a)') 'dondolo: '//kind//': '//visible(lines%line(i)%text)
      end do
   end subroutine print_lines

   !> Print an error, one line for each thing that is wrong, and end with its exit code, or of the signal that has come
   subroutine give_up(error)
      !> What went wrong
      type(error_type), intent(in) :: error

      integer :: first, length

      first = 1
      do while (first <= len(error%message))
         length = index(error%message(first:)//new_line('a'), new_line('a')) - 1
         write (error_unit, '(a)') 'dondolo: '//visible(error%message(first:first + length - 1))
         first = first + length + 1
      end do
      flush (error_unit)
      call die_of_signal()
      select case (error%stat)
      case (status_input, status_missing)
         stop status_input, quiet=.true.
      case default
         stop status_failure, quiet=.true.
      end select
   end subroutine give_up

end program dondolo_main
