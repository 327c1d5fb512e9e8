!> Commands that the Python package carries out: the executable becomes Python.
module dondolo_front_door
   use, intrinsic :: iso_fortran_env, only : output_unit
   use dondolo_base_error, only : error_type, raise_failure
   use dondolo_base_lines, only : lines_type
   use dondolo_files_process, only : become, own_folder
   use dondolo_files_version, only : dondolo_version_text
   implicit none
   private

   public :: python_commands, hand_over

   !> Commands of `python -m dondolo`
   character(len=*), parameter :: python_commands(*) = [character(len=9) :: &
      & 'plot', 'report', 'relazione', 'xlsx', 'nrml', 'openquake', 'diff', 'records', 'catalogue', 'serve']

   !> What an installation without the package is told, before why, and the beginning of the names of its wheels
   character(len=*), parameter :: needs_package = ' needs the Python package dondolo', wheel = 'dondolo-'//dondolo_version_text//'-'

   !> What Python runs: the command, or the line above where the package is missing. The current folder, which Python puts first
   !> among those of modules, is a study: a file `numpy.py` or `dondolo.py` in it is no module of the command.
   character(len=*), parameter :: script = &
      & 'import sys'//new_line('a')// &
      & 'if sys.path[:1] == [""]: del sys.path[0]'//new_line('a')// &
      & 'try:'//new_line('a')// &
      & '    from dondolo.__main__ import main'//new_line('a')// &
      & 'except ModuleNotFoundError as error:'//new_line('a')// &
      & '    if (error.name or "").partition(".")[0] != "dondolo": raise'//new_line('a')// &
      & '    tag = "cp%d%d" % sys.version_info[:2]'//new_line('a')// &
      & '    end = tag + "-win_amd64" if sys.platform == "win32" else "*"'//new_line('a')// &
      & '    print("dondolo: " + sys.argv[1] + "'//needs_package//', which is not in " + sys.prefix + ": install '// &
      & 'its wheel, for Python 3.11 or later: \"" + sys.executable + "\" -m pip install '//wheel//'" + tag + "-" + end + '// &
      & '".whl", file=sys.stderr)'//new_line('a')// &
      & '    sys.exit(1)'//new_line('a')// &
      & 'sys.exit(main())'

contains

   !> Become Python: the one beside the executable, as in a virtual environment (on Windows also one folder up, as in Python's own
   !> folder), or else the one in PATH
   subroutine hand_over(words, error)
      !> The command and its arguments
      type(lines_type), intent(in) :: words
      !> There is no Python
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: folder
      type(lines_type) :: call_words
      integer :: i, pass

      flush (output_unit)
      call own_folder(folder)
      do pass = 1, 2
         call_words = lines_type()
         if (pass == 1) then
            if (len(folder) == 0) cycle
            call call_words%add(folder//'/python3')
         else
            call call_words%add('python3')
         end if
         call call_words%add('-c')
         call call_words%add(script)
         do i = 1, words%count
            call call_words%add(words%line(i)%text)
         end do
         call become(call_words)
      end do
      ! A path of Windows begins with a drive.
      call raise_failure(error, words%line(1)%text//needs_package//', and there is no '// &
         & trim(merge('python.exe', 'python3   ', index(folder, ':') == 2))// &
         & ' beside this executable or in PATH: install Python 3.11 or later, and then the wheel that fits it, for 3.13 '// &
         & trim(merge('py -m pip install     ', 'python3 -m pip install', index(folder, ':') == 2))//' '//wheel//'cp313-'// &
         & trim(merge('cp313-win_amd64', '*              ', index(folder, ':') == 2))//'.whl')
   end subroutine hand_over

end module dondolo_front_door
