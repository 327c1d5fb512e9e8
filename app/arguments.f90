!> The command line: which case, and what to do with it.
module dondolo_arguments
   use dondolo_base_error, only : error_type, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_numbers, only : parse_integer, parse_real
   use dondolo_base_spelling, only : meant
   use dondolo_base_text, only : join, replaced, to_text
   use dondolo_base_threads, only : largest_threads
   use dondolo_case_job_group, only : stripes_task, task_names
   use dondolo_example, only : example_names
   use dondolo_files_system, only : file_exists
   use dondolo_front_door, only : python_commands
   implicit none
   private

   public :: arguments_type, read_arguments, option_names

   !> Every option, in the order of the help page
   character(len=*), parameter :: option_names(*) = [character(len=12) :: '--check', '--walls', '--merge', '--status', &
      & '--template', '--example', '--benchmark', '--completion', '--cite', '--threads', '--quiet', '--version', '--verbose', &
      & '--help']

   !> Shells that --completion knows
   character(len=*), parameter :: shell_names(*) = [character(len=4) :: 'bash', 'zsh']

   !> Where an error sends the user
   character(len=*), parameter :: see_help = ' (dondolo --help lists the options)'

   !> What the command line asks for
   type :: arguments_type
      !> 'run', 'check', 'merge', 'status', 'template', 'example', 'benchmark', 'completion', 'cite', 'version', 'help' or 'python'
      character(len=:), allocatable :: action
      !> Path of the case, which 'cite' may leave out; of 'status' the output
      character(len=:), allocatable :: case_file
      !> Task of the template
      integer :: task = stripes_task
      !> Name of the example, or of the shell of the completion
      character(len=:), allocatable :: name
      !> Words of a command that Python carries out
      type(lines_type) :: command
      !> Length of a measurement of the benchmark [s]
      real(wp) :: seconds = 1.0_wp
      !> Number of threads; not allocated: the case's
      integer, allocatable :: threads
      !> First and last row of the population that are to be run; not allocated: all
      integer, allocatable :: rows(:)
      !> Files of counts to be taken together, or further outputs
      type(lines_type) :: parts
      !> Print errors and warnings only
      logical :: quiet = .false.
      !> Print more than the version
      logical :: verbose = .false.
   end type arguments_type

contains

   !> Read the command line
   subroutine read_arguments(arguments, error)
      !> What it asks for
      type(arguments_type), intent(out) :: arguments
      !> What is wrong with it
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: word
      integer :: i

      arguments%action = 'run'
      arguments%task = stripes_task
      i = 1
      call get_argument(1, word)
      if (any(word == python_commands)) then
         arguments%action = 'python'
         do i = 1, command_argument_count()
            call get_argument(i, word)
            call arguments%command%add(word)
         end do
         return
      end if
      if (word == 'run') i = 2
      do while (i <= command_argument_count())
         call get_argument(i, word)
         i = i + 1
         if (word == '--check') then
            call set_action('check')
         else if (word == '--version' .or. word == '--help' .or. word == '--cite') then
            call set_action(word(3:))
         else if (word == '-h') then
            call set_action('help')
         else if (word == '--quiet') then
            arguments%quiet = .true.
         else if (word == '--verbose') then
            arguments%verbose = .true.
         else if (word == '--template' .or. index(word, '--template=') == 1) then
            call set_action('template')
            if (.not. allocated(error)) call take_task(word, i, arguments, error)
         else if (word == '--example' .or. index(word, '--example=') == 1) then
            call set_action('example')
            if (.not. allocated(error)) call take_name(word, i, example_names, arguments, error)
         else if (word == '--completion' .or. index(word, '--completion=') == 1) then
            call set_action('completion')
            if (.not. allocated(error)) call take_name(word, i, shell_names, arguments, error)
         else if (word == '--benchmark' .or. index(word, '--benchmark=') == 1) then
            call set_action('benchmark')
            if (.not. allocated(error)) call take_seconds(word, i, arguments, error)
         else if (word == '--merge' .or. word == '--status') then
            call set_action(word(3:))
         else if (word == '--walls' .or. index(word, '--walls=') == 1) then
            call take_rows(word, i, arguments, error)
         else if (word == '--threads' .or. index(word, '--threads=') == 1) then
            call take_threads(word, i, arguments, error)
         else if (index(word, '-') == 1) then
            call raise_input(error, word//': no such option; there are '// &
               & trim(replaced(join(option_names), '''', '')))
         else if (len(word) == 0) then
            call raise_input(error, 'the name of the case is empty'//see_help)
         else if (allocated(arguments%case_file) .and. any(arguments%action == ['merge ', 'status'])) then
            call arguments%parts%add(word)
         else if (allocated(arguments%case_file)) then
            call look_for_command(arguments%case_file, error)
            if (.not. allocated(error)) call look_for_command(word, error)
            if (.not. allocated(error)) call raise_input(error, word//': one case at a time, '//arguments%case_file// &
               & ' was given before')
         else
            arguments%case_file = word
         end if
         if (allocated(error)) return
      end do
      if (arguments%verbose .and. arguments%action /= 'version') then
         call raise_input(error, '--verbose: goes with --version alone')
      else if (any(arguments%action == [character(len=5) :: 'run', 'check', 'merge'])) then
         if (.not. allocated(arguments%case_file)) then
            call raise_input(error, 'no case given: dondolo CASE.nml'//see_help)
         else if (arguments%action == 'run') then
            call look_for_command(arguments%case_file, error)
         end if
      else if (arguments%action == 'status' .and. .not. allocated(arguments%case_file)) then
         call raise_input(error, 'no output given: dondolo --status OUTPUT'//see_help)
      else if (allocated(arguments%case_file) .and. any(arguments%action == ['template', 'example '])) then
         call raise_input(error, arguments%case_file//': --'//arguments%action//' takes no case, it prints one')
      else if (allocated(arguments%case_file) .and. arguments%action == 'benchmark') then
         call raise_input(error, arguments%case_file//': --benchmark takes no case, it has its own')
      end if

      if (allocated(error)) return
      if (arguments%action == 'merge' .and. arguments%parts%count == 0) then
         call raise_input(error, '--merge: the files of counts must follow the case: dondolo --merge CASE.nml '// &
            & 'OUTPUT_walls_*.counts')
      else if (allocated(arguments%rows) .and. all(arguments%action /= [character(len=5) :: 'run', 'check'])) then
         call raise_input(error, '--walls: cannot go together with --'//arguments%action)
      end if

   contains

      !> Note what to do; two different things are an error
      subroutine set_action(action)
         !> What to do
         character(len=*), intent(in) :: action

         if (arguments%action == 'run') then
            arguments%action = action
         else if (arguments%action /= action) then
            call raise_input(error, '--'//action//': cannot go together with --'//arguments%action)
         end if
      end subroutine set_action

   !> Refuse the name of a case that is not there and that is an option without its dashes or nearly a command
   subroutine look_for_command(name, error)
      character(len=*), intent(in) :: name
      !> What may have been meant
      type(error_type), allocatable, intent(inout) :: error

      character(len=:), allocatable :: hint

      if (file_exists(name)) return
      if (any(option_names == '--'//name)) then
         call raise_input(error, name//': no such file or command; it is an option: dondolo --'//name)
         return
      end if
      hint = trim(meant(name, [character(len=12) :: python_commands, option_names]))
      if (len(hint) == 0) hint = trim(meant('--'//name, option_names))
      if (len(hint) > 0) call raise_input(error, name//': no such file or command'//hint)
   end subroutine look_for_command

   end subroutine read_arguments

   !> The task of --template: `--template=task`, or the next word if there is one
   subroutine take_task(word, i, arguments, error)
      !> The option as it was typed
      character(len=*), intent(in) :: word
      !> Number of the next argument
      integer, intent(inout) :: i
      !> What the command line asks for
      type(arguments_type), intent(inout) :: arguments
      !> No such task
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: name

      call take_value(word, i, name)
      if (.not. allocated(name)) return
      arguments%task = findloc(task_names == name, .true., dim=1)
      if (arguments%task == 0) then
         call raise_input(error, '--template '//name//': the task must be one of '//join(task_names))
      end if
   end subroutine take_task

   !> The name that --example or --completion asks for: `--example=name`, or the next word
   subroutine take_name(word, i, names, arguments, error)
      !> The option as it was typed
      character(len=*), intent(in) :: word
      !> Number of the next argument
      integer, intent(inout) :: i
      !> Names that are known
      character(len=*), intent(in) :: names(:)
      !> What the command line asks for
      type(arguments_type), intent(inout) :: arguments
      !> No such name
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: name

      call take_value(word, i, name)
      if (.not. allocated(name)) name = ''
      if (any(name == names) .and. len(name) > 0) then
         arguments%name = name
      else
         call raise_input(error, trim('--'//arguments%action//' '//name)//': must be one of '//join(names))
      end if
   end subroutine take_name

   !> The length of a measurement: `--benchmark=seconds`, or the next word if there is one
   subroutine take_seconds(word, i, arguments, error)
      !> The option as it was typed
      character(len=*), intent(in) :: word
      !> Number of the next argument
      integer, intent(inout) :: i
      !> What the command line asks for
      type(arguments_type), intent(inout) :: arguments
      !> No such length
      type(error_type), allocatable, intent(out) :: error

      real(wp), parameter :: shortest = 1.0e-3_wp, longest = 60.0_wp
      character(len=:), allocatable :: value
      logical :: ok

      call take_value(word, i, value)
      if (.not. allocated(value)) return
      call parse_real(value, arguments%seconds, ok)
      if (ok) ok = arguments%seconds >= shortest .and. arguments%seconds <= longest
      if (.not. ok) call raise_input(error, '--benchmark '//value//': must be a length of a measurement between '// &
         & to_text(shortest)//' and '//to_text(longest)//' s')
   end subroutine take_seconds

   !> The rows of --walls: `--walls=FIRST:LAST`, or the next word
   subroutine take_rows(word, i, arguments, error)
      !> The option as it was typed
      character(len=*), intent(in) :: word
      !> Number of the next argument
      integer, intent(inout) :: i
      !> What the command line asks for
      type(arguments_type), intent(inout) :: arguments
      !> Not two numbers
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: value
      integer :: first, last, colon
      logical :: ok, ok_too

      call take_value(word, i, value)
      if (.not. allocated(value)) value = ''
      colon = index(value, ':')
      call parse_integer(value(:colon - 1), first, ok)
      call parse_integer(value(colon + 1:), last, ok_too)
      ok = ok .and. ok_too .and. colon > 0
      if (ok) ok = first >= 1 .and. last >= first
      if (ok) then
         arguments%rows = [first, last]
      else
         call raise_input(error, '--walls '//value//': must be the first and the last row of the population that are '// &
            & 'to be run, counted from 1, such as --walls 1:500')
      end if
   end subroutine take_rows

   !> The number of --threads: `--threads=N`, or the next word
   subroutine take_threads(word, i, arguments, error)
      !> The option as it was typed
      character(len=*), intent(in) :: word
      !> Number of the next argument
      integer, intent(inout) :: i
      !> What the command line asks for
      type(arguments_type), intent(inout) :: arguments
      !> Not a number of threads
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: value
      integer :: number
      logical :: ok

      call take_value(word, i, value)
      if (.not. allocated(value)) then
         call raise_input(error, '--threads: a number must follow, such as --threads 4')
         return
      end if
      call parse_integer(value, number, ok)
      if (ok) ok = number >= 0 .and. number <= largest_threads
      if (ok) then
         arguments%threads = number
      else
         call raise_input(error, '--threads '//value//': must be an integer between 0 (all) and '// &
            & to_text(largest_threads))
      end if
   end subroutine take_threads

   !> The value of an option: what follows `=`, or the next word unless that is an option
   subroutine take_value(word, i, value)
      !> The option as it was typed
      character(len=*), intent(in) :: word
      !> Number of the next argument
      integer, intent(inout) :: i
      !> The value; not allocated if there is none
      character(len=:), allocatable, intent(out) :: value

      if (index(word, '=') > 0) then
         value = word(index(word, '=') + 1:)
         return
      end if
      call get_argument(i, value)
      if (i > command_argument_count() .or. index(value, '--') == 1) then
         deallocate (value)
      else
         i = i + 1
      end if
   end subroutine take_value

   !> One argument
   subroutine get_argument(i, word)
      !> Its number
      integer, intent(in) :: i
      !> Its text, empty if there is none
      character(len=:), allocatable, intent(out) :: word

      integer :: length

      length = 0
      if (i <= command_argument_count()) call get_command_argument(i, length=length)
      allocate (character(len=length) :: word)
      if (length > 0) call get_command_argument(i, value=word)
   end subroutine get_argument

end module dondolo_arguments
