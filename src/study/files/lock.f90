!> Locks: one run at a time writes an output or a store. The lock of `out/city` is the file `out/city.lock`, which names its
!> holder; the kernel holds the lock itself (flock), and gives it back however the process ends. A file that a killed run
!> has left is therefore not a lock, but names that run.
module dondolo_files_lock
   use, intrinsic :: iso_c_binding, only : c_char, c_double, c_int, c_null_char, c_size_t
   use dondolo_base_error, only : error_type, raise_failure, raise_input
   use dondolo_base_numbers, only : parse_integer
   use dondolo_base_text, only : to_text
   use dondolo_files_origin, only : check_regular, run_length
   use dondolo_files_system, only : remove_file
   implicit none
   private

   public :: lock_type, holder_type, look_at_lock, new_run, run_length

   !> What the file begins with
   character(len=*), parameter :: mark = 'dondolo lock'

   !> Bytes of the file at most
   integer, parameter :: room = 500
   integer(c_size_t), parameter :: space = room

   !> Who has a lock, or had it
   type :: holder_type
      !> A process has it now
      logical :: is_alive = .false.
      !> Name of the run, of its machine, and when it began (UTC)
      character(len=room) :: run = '', host = '', since = ''
      !> Number of the process
      integer :: pid = 0
      !> Rows of the store that were there when it began; -1: no store
      integer :: rows = -1
      !> Seconds since it began
      real(c_double) :: seconds = 0.0_c_double
   end type holder_type

   !> A lock
   type :: lock_type
      !> Name of the run that has it: unique
      character(len=run_length) :: run = ''
      !> Name of a run that was killed while it had the lock; blank: there was none
      character(len=run_length) :: killed = ''
      !> The file and its descriptor
      character(len=:), allocatable, private :: path
      integer(c_int), private :: descriptor = -1
   contains
      !> Take it
      procedure :: take
      !> Say in its file who has it
      procedure :: sign
      !> Give it back
      procedure :: release
   end type lock_type

   interface

      integer(c_int) function c_take(path, descriptor, text, room) bind(c, name='dondolo_take_lock')
         import :: c_char, c_int, c_size_t
         character(kind=c_char), intent(in) :: path(*)
         integer(c_int), intent(out) :: descriptor
         character(kind=c_char), intent(inout) :: text(*)
         integer(c_size_t), value :: room
      end function c_take

      integer(c_int) function c_mark(descriptor, text) bind(c, name='dondolo_mark_lock')
         import :: c_char, c_int
         integer(c_int), value :: descriptor
         character(kind=c_char), intent(in) :: text(*)
      end function c_mark

      subroutine c_give_back(descriptor) bind(c, name='dondolo_give_back_lock')
         import :: c_int
         integer(c_int), value :: descriptor
      end subroutine c_give_back

      integer(c_int) function c_look(path, text, room) bind(c, name='dondolo_look_at_lock')
         import :: c_char, c_int, c_size_t
         character(kind=c_char), intent(in) :: path(*)
         character(kind=c_char), intent(inout) :: text(*)
         integer(c_size_t), value :: room
      end function c_look

      subroutine c_introduce(pid, host, host_room, since, since_room, run, run_room) bind(c, name='dondolo_introduce')
         import :: c_char, c_int, c_size_t
         integer(c_int), intent(out) :: pid
         character(kind=c_char), intent(inout) :: host(*), since(*), run(*)
         integer(c_size_t), value :: host_room, since_room, run_room
      end subroutine c_introduce

      real(c_double) function c_seconds_since(since) bind(c, name='dondolo_seconds_since')
         import :: c_char, c_double
         character(kind=c_char), intent(in) :: since(*)
      end function c_seconds_since

   end interface

contains

   !> Take the lock; its file says who had it before until `sign`, so that what a killed run has left can be mended first
   subroutine take(self, what, error)
      class(lock_type), intent(inout) :: self
      !> Path of what is to be written, without the end `.lock`
      character(len=*), intent(in) :: what
      !> Another run has it, or its file is something else, or cannot be written
      type(error_type), allocatable, intent(out) :: error

      character(kind=c_char, len=room) :: text
      type(holder_type) :: holder
      integer(c_int) :: stat

      self%path = what//'.lock'
      call check_regular(self%path, .false., error)
      if (allocated(error)) return
      text = c_null_char
      stat = c_take(self%path//c_null_char, self%descriptor, text, space)
      call read_holder(text, holder)
      if (stat == 1) then
         call raise_input(error, what//': is being written by another run'//trim(described(holder)))
      else if (stat == 2) then
         call raise_failure(error, self%path//': cannot be written')
      else if (stat == 3 .or. (text(1:1) /= c_null_char .and. index(text, mark) /= 1)) then
         if (stat == 0) call c_give_back(self%descriptor)
         call raise_input(error, self%path//': exists, and is not a lock of dondolo')
      end if
      if (allocated(error)) then
         self%descriptor = -1
      else
         self%killed = holder%run(:run_length)
         call new_run(self%run)
      end if
   end subroutine take

   !> Say in the file who has the lock
   subroutine sign(self, error, rows)
      class(lock_type), intent(inout) :: self
      !> It cannot be written; the lock is given back
      type(error_type), allocatable, intent(out) :: error
      !> Rows of a store that are there at the beginning
      integer, intent(in), optional :: rows

      character(len=*), parameter :: lf = new_line('a')
      character(len=:), allocatable :: text
      type(holder_type) :: holder

      call introduce(holder)
      text = mark//lf//'run '//self%run//lf//'pid '//to_text(holder%pid)//lf//'host '//trim(holder%host)//lf// &
         & 'since '//trim(holder%since)//lf
      if (present(rows)) text = text//'rows '//to_text(rows)//lf
      if (c_mark(self%descriptor, text//c_null_char) == 1) return
      call raise_failure(error, self%path//': cannot be written whole: is the disk full?')
      call self%release()
   end subroutine sign

   !> A name for a run that no other has: time (UTC) and 64 random bits
   subroutine new_run(run)
      !> Name
      character(len=run_length), intent(out) :: run

      type(holder_type) :: holder

      call introduce(holder)
      run = holder%run(:run_length)
   end subroutine new_run

   !> Who this process is, and a new name for its run
   subroutine introduce(holder)
      type(holder_type), intent(out) :: holder

      character(kind=c_char, len=room) :: host, since, run
      integer(c_int) :: pid

      call c_introduce(pid, host, space, since, space, run, space)
      holder%pid = int(pid)
      holder%host = host(:index(host, c_null_char) - 1)
      holder%since = since(:index(since, c_null_char) - 1)
      holder%run = run(:index(run, c_null_char) - 1)
   end subroutine introduce

   !> Give the lock back and remove its file; nothing happens if it was not taken
   subroutine release(self, keep_file)
      class(lock_type), intent(inout) :: self
      !> Leave the file, so that the next run completes what this one could not
      logical, intent(in), optional :: keep_file

      logical :: is_kept

      if (self%descriptor < 0) return
      is_kept = .false.
      if (present(keep_file)) is_kept = keep_file
      ! Removed while it is held: a waiting process sees that the file is gone, and makes another.
      if (.not. is_kept) call remove_file(self%path)
      call c_give_back(self%descriptor)
      self%descriptor = -1
      self%run = ''
   end subroutine release

   !> Look at a lock without taking it
   subroutine look_at_lock(what, holder, exists)
      !> Path of what is written, without the end `.lock`
      character(len=*), intent(in) :: what
      !> Who has it, or had it when it was killed
      type(holder_type), intent(out) :: holder
      !> Is there such a file?
      logical, intent(out) :: exists

      character(kind=c_char, len=room) :: text
      integer(c_int) :: stat

      text = c_null_char
      stat = c_look(what//'.lock'//c_null_char, text, space)
      exists = stat /= 2 .and. index(text, mark) == 1
      if (.not. exists) return
      call read_holder(text, holder)
      holder%is_alive = stat == 1
   end subroutine look_at_lock

   !> Read what a lock file says
   subroutine read_holder(text, holder)
      !> Its contents, ended by a null character
      character(len=*), intent(in) :: text
      type(holder_type), intent(out) :: holder

      integer :: at, ends, length
      logical :: ok

      length = index(text, c_null_char) - 1
      at = 1
      do while (at <= length)
         ends = index(text(at:length), new_line('a'))
         if (ends == 0) exit
         associate (line => text(at:at + ends - 2))
            if (index(line, 'run ') == 1) holder%run = line(5:)
            if (index(line, 'host ') == 1) holder%host = line(6:)
            if (index(line, 'since ') == 1) holder%since = line(7:)
            if (index(line, 'pid ') == 1) call parse_integer(line(5:), holder%pid, ok)
            if (index(line, 'rows ') == 1) call parse_integer(line(6:), holder%rows, ok)
         end associate
         at = at + ends
      end do
      ! It becomes part of the names of files.
      if (verify(trim(holder%run), '0123456789abcdefTZ-') > 0) holder%run = ''
      holder%seconds = c_seconds_since(trim(holder%since)//c_null_char)
   end subroutine read_holder

   !> Who has a lock, in parentheses
   pure function described(holder) result(text)
      type(holder_type), intent(in) :: holder
      character(len=merge(len_trim(holder%host) + len_trim(holder%since) + 42, 0, holder%pid > 0)) :: text

      text = ''
      if (holder%pid > 0) text = ' (process '//to_text(holder%pid)//' on '//trim(holder%host)//' since '// &
         & trim(holder%since)//')'
   end function described

end module dondolo_files_lock
