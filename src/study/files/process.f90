!> The process itself: where its program is, and how it becomes another one.
module dondolo_files_process
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_null_char, c_size_t
   use dondolo_base_lines, only : lines_type
   implicit none
   private

   public :: own_folder, become, sleep_while_waiting, hold_console, receive_file

   interface

      !> Path of the program; see process.c
      subroutine c_own_path(path, room) bind(c, name='dondolo_own_path')
         import :: c_char, c_size_t
         !> Room for the path
         character(kind=c_char), intent(out) :: path(*)
         !> Bytes of the room
         integer(c_size_t), value :: room
      end subroutine c_own_path

      !> Become another program; see process.c
      subroutine c_become(words, count) bind(c, name='dondolo_become')
         import :: c_char, c_int
         !> Name and arguments, each with a NUL at its end
         character(kind=c_char), intent(inout) :: words(*)
         !> Number of words
         integer(c_int), value :: count
      end subroutine c_become

      !> Begin again with threads that sleep while they wait; see process.c
      subroutine c_sleep_while_waiting(words, count) bind(c, name='dondolo_sleep_while_waiting')
         import :: c_char, c_int
         !> Name and arguments of the program, each with a NUL at its end
         character(kind=c_char), intent(inout) :: words(*)
         !> Number of words
         integer(c_int), value :: count
      end subroutine c_sleep_while_waiting

      !> Show a text in a console that ends with the program; see windows_process.c
      subroutine c_hold_console(text) bind(c, name='dondolo_hold_console')
         import :: c_char
         !> Text, with a NUL at its end
         character(kind=c_char), intent(in) :: text(*)
      end subroutine c_hold_console

      !> Work in the folder of a file that was dropped on the program; see windows_process.c
      subroutine c_receive_file(path) bind(c, name='dondolo_receive_file')
         import :: c_char
         !> Path, with a NUL at its end
         character(kind=c_char), intent(in) :: path(*)
      end subroutine c_receive_file

   end interface

contains

   !> The folder of the program that runs, without links
   subroutine own_folder(folder)
      !> Absolute path without a slash at the end; empty if the system does not tell
      character(len=:), allocatable, intent(out) :: folder

      ! PATH_MAX of Linux and macOS is 4096 or less
      integer, parameter :: room = 8192
      character(kind=c_char, len=room) :: path

      path = c_null_char
      call c_own_path(path, int(room, c_size_t))
      folder = path(:index(path, c_null_char) - 1)
      folder = folder(:max(index(folder, '/', back=.true.) - 1, 0))
   end subroutine own_folder

   !> Become another program. It returns only if there is no such program.
   subroutine become(words)
      !> Name of the program, searched in PATH if it has no slash, and its arguments
      type(lines_type), intent(in) :: words

      character(kind=c_char, len=:), allocatable :: joined

      call join_words(words, joined)
      call c_become(joined, int(words%count, c_int))
   end subroutine become

   !> Let the threads of OpenMP sleep while they wait, unless the user has chosen otherwise: on POSIX the program begins again.
   !>
   !> GNU's threads spin for milliseconds after each parallel region, and take the processor from what is serial in this
   !> program and from all others. To be called by a program of its own, before it has done anything.
   subroutine sleep_while_waiting()

      type(lines_type) :: words
      character(kind=c_char, len=:), allocatable :: joined
      character(len=:), allocatable :: word
      integer :: i, length

      do i = 0, command_argument_count()
         call get_command_argument(i, length=length)
         allocate (character(len=length) :: word)
         if (length > 0) call get_command_argument(i, value=word)
         call words%add(word)
         deallocate (word)
      end do
      call join_words(words, joined)
      call c_sleep_while_waiting(joined, int(words%count, c_int))
   end subroutine sleep_while_waiting

   !> Words as the functions in C have them: each with a NUL at its end
   pure subroutine join_words(words, joined)
      type(lines_type), intent(in) :: words
      !> All of them
      character(kind=c_char, len=:), allocatable, intent(out) :: joined

      integer :: i

      joined = ''
      do i = 1, words%count
         joined = joined//words%line(i)%text//c_null_char
      end do
   end subroutine join_words

   !> Where the console ends with the program, as after a double click on Windows, show a text and wait for a key
   subroutine hold_console(text)
      !> Text, with its line ends
      character(len=*), intent(in) :: text

      call c_hold_console(text//c_null_char)
   end subroutine hold_console

   !> Where a file was dropped on the program on Windows, work in its folder, and wait for a key at the end
   subroutine receive_file(path)
      !> The only word that the program was given; a path that is not absolute changes nothing
      character(len=*), intent(in) :: path

      call c_receive_file(path//c_null_char)
   end subroutine receive_file

end module dondolo_files_process
