!> dondolo: from accelerograms and walls to fragility curves, on the command line.
program dondolo_main
   use, intrinsic :: iso_fortran_env, only : error_unit, int64, output_unit
   use dondolo_arguments, only : arguments_type, read_arguments
   use dondolo_benchmark, only : run_benchmark
   use dondolo_case, only : case_type, read_case
   use dondolo_error, only : error_type
   use dondolo_help, only : print_help
   use dondolo_kinds, only : wp
   use dondolo_lane_variants, only : build_variant
   use dondolo_lines, only : lines_type
   use dondolo_plan, only : print_plan
   use dondolo_progress_bar, only : erase_progress, show_progress, start_progress
   use dondolo_reports, only : check_reports, write_reports
   use dondolo_run_case, only : results_type, run_case
   use dondolo_ensemble, only : available_threads
   use dondolo_summary, only : print_summary
   use dondolo_system, only : stderr_is_terminal
   use dondolo_template, only : print_template
   use dondolo_version, only : dondolo_version_text
   implicit none

   type(arguments_type) :: arguments
   type(error_type), allocatable :: error

   call read_arguments(arguments, error)
   if (allocated(error)) call give_up(error)
   select case (arguments%action)
   case ('help')
      call print_help()
   case ('version')
      write (output_unit, '(a)') 'dondolo '//dondolo_version_text, 'build variant '//build_variant()
   case ('template')
      call print_template(arguments%task)
   case ('benchmark')
      call run_benchmark(arguments%seconds, team(0), arguments%quiet, error)
      if (allocated(error)) call give_up(error)
   case default
      call serve(arguments, error)
      if (allocated(error)) call give_up(error)
   end select

contains

   !> Check a case, or run it
   subroutine serve(arguments, error)
      !> What the command line asks for
      type(arguments_type), intent(in) :: arguments
      !> What went wrong
      type(error_type), allocatable, intent(out) :: error

      type(case_type) :: case
      type(results_type) :: results
      type(lines_type) :: paths
      integer(int64) :: start, finish, rate
      integer :: threads

      call read_case(arguments%case_file, case, error)
      if (.not. allocated(error)) call check_reports(case, error)
      if (allocated(error)) return
      if (arguments%action == 'check') then
         if (.not. arguments%quiet) call print_plan(case, error)
         return
      end if
      threads = team(case%job%threads)

      call system_clock(start, rate)
      if (stderr_is_terminal() .and. .not. arguments%quiet) then
         call start_progress()
         call run_case(case, results, error, threads, show_progress)
         call erase_progress()
      else
         call run_case(case, results, error, threads)
      end if
      if (allocated(error)) return
      call system_clock(finish)

      call write_reports(case, results, paths, error)
      if (allocated(error)) return
      call print_warnings(results%warnings)
      if (.not. arguments%quiet) &
         & call print_summary(case, results, paths, real(finish - start, wp)/real(rate, wp), threads)
   end subroutine serve

   !> Number of threads
   integer function team(threads)
      !> Number unless the command line gives one; 0: all
      integer, intent(in) :: threads

      team = threads
      if (allocated(arguments%threads)) team = arguments%threads
      if (team == 0) team = available_threads()
   end function team

   !> Print warnings
   subroutine print_warnings(warnings)
      !> Warnings
      type(lines_type), intent(in) :: warnings

      integer :: i

      do i = 1, warnings%count
         write (error_unit, '(a)') 'dondolo: warning: '//warnings%line(i)%text
      end do
   end subroutine print_warnings

   !> Print an error, one line for each thing that is wrong, and end with its exit code
   subroutine give_up(error)
      !> What went wrong
      type(error_type), intent(in) :: error

      integer :: first, length

      first = 1
      do while (first <= len(error%message))
         length = index(error%message(first:)//new_line('a'), new_line('a')) - 1
         write (error_unit, '(a)') 'dondolo: '//error%message(first:first + length - 1)
         first = first + length + 1
      end do
      stop error%stat, quiet=.true.
   end subroutine give_up

end program dondolo_main
