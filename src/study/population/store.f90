!> Store of what came of the rows of a population: a file that grows with every block that is put in, so that a run that
!> was killed goes on where it was; or the memory.
!>
!> Rows come in any order, from one process or from many that hand them to one. One run at a time writes a file. When all
!> rows are there they are brought into their order: the same bytes, however the work was divided.
module dondolo_population_store
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_error, only : error_type, raise_failure, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : line_type
   use dondolo_base_memory, only : check_room
   use dondolo_base_text, only : to_text
   use dondolo_files_lock, only : holder_type, lock_type, look_at_lock
   use dondolo_files_origin, only : check_regular
   use dondolo_files_reader, only : file_size, reader_type
   use dondolo_files_system, only : cut_file, file_exists, is_folder, remove_file, rename_file, writer_type
   use dondolo_motion_work, only : work_type
   use dondolo_population_row_result, only : row_result_type
   use dondolo_population_store_format, only : is_cut_head, bytes_of_entry, identity_type, make_head, pack_entry, read_entry, &
      & read_head, unpack_entry
   implicit none
   private

   public :: store_type, open_store, look_into_store, read_result

   !> A store
   type :: store_type
      !> Path of its file; empty: it is in memory
      character(len=:), allocatable :: path
      !> What it is for
      type(identity_type) :: identity
      !> How many rows it has
      integer :: done = 0
      !> What was computed for them
      type(work_type) :: work
      !> Bytes of the file up to the end of its last whole row, and of all of it when it was read
      integer(int64), private :: bytes = 0, size = 0
      !> Where each row begins in the file; 0: it is not there
      integer(int64), allocatable, private :: place(:)
      !> Rows in memory, as in the file
      type(line_type), allocatable, private :: entry(:)
      !> The file while rows are read
      type(reader_type), private :: reader
      !> The file while rows are put in
      type(writer_type), private :: writer
      type(lock_type), private :: lock
      logical, private :: is_writing = .false.
   contains
      !> Is a row there?
      procedure :: has
      !> Are all rows there?
      procedure :: is_complete
      !> Make it this run's to put rows in
      procedure :: claim
      !> Put rows in
      procedure :: put
      !> Read a row
      procedure :: read => read_row
      !> End putting in and reading
      procedure :: close => close_store
      !> Remove it
      procedure :: remove
   end type store_type

contains

   !> Open a store, with what an earlier run has left in it; nothing is written
   subroutine open_store(store, path, identity, error)
      type(store_type), intent(out) :: store
      !> Path of its file, which need not be there; empty: in memory
      character(len=*), intent(in) :: path
      !> What it is for
      type(identity_type), intent(in) :: identity
      !> The file is something else, or of another study or other rows; or lack of memory
      type(error_type), allocatable, intent(out) :: error

      type(store_type) :: found
      logical :: exists

      exists = .false.
      ! What a link leads to is read, but never written.
      if (len(path) > 0) call check_regular(path, .false., error)
      if (len(path) > 0 .and. .not. allocated(error)) call look_into_store(found, path, exists, error)
      if (allocated(error)) return
      if (exists) then
         call identity%key%compare(found%identity%key, path, error)
         if (.not. allocated(error) .and. (found%identity%first /= identity%first .or. &
            & found%identity%last /= identity%last)) call raise_input(error, path//': is of rows '// &
            & to_text(found%identity%first)//' to '//to_text(found%identity%last))
         if (.not. allocated(error)) store = found
      else
         store%path = path
         store%identity = identity
         call make_room(store, error)
         store%size = max(found%size, 0_int64)
      end if
   end subroutine open_store

   !> Look into a file: what it is for, and which rows it has
   subroutine look_into_store(store, path, exists, error)
      type(store_type), intent(out) :: store
      !> Path of its file
      character(len=*), intent(in) :: path
      !> Is there such a file, with at least a whole head?
      logical, intent(out) :: exists
      !> It is something else
      type(error_type), allocatable, intent(out) :: error

      logical :: ok

      store%path = path
      exists = .false.
      store%size = file_size(path)
      if (.not. file_exists(path)) return
      call check_regular(path, .true., error)
      if (allocated(error)) return
      ! Some systems give folders no size.
      if (store%size == 0 .and. .not. is_folder(path)) return
      call store%reader%open(path, ok)
      if (.not. ok) then
         call raise_input(error, path//': not a dondolo counts file, or unreadable')
         return
      end if
      if (.not. is_cut_head(store%reader, store%size)) then
         call read_head(store%reader, path, store%identity, store%bytes, error)
         if (.not. allocated(error)) call make_room(store, error)
         if (.not. allocated(error)) call find_rows(store)
         exists = .not. allocated(error)
      end if
      call store%close()
   end subroutine look_into_store

   !> Make room for the places of all rows, none of which is there
   subroutine make_room(store, error)
      type(store_type), intent(inout) :: store
      !> Lack of memory
      type(error_type), allocatable, intent(out) :: error

      real(wp), parameter :: bytes_of_place = 8.0_wp

      associate (first => store%identity%first, last => store%identity%last)
         call check_room(bytes_of_place*(real(last, wp) - real(first, wp) + 1.0_wp), error)
         if (allocated(error)) return
         allocate (store%place(first:last), source=0_int64)
         if (len(store%path) == 0) allocate (store%entry(first:last))
      end associate
   end subroutine make_room

   !> Find the rows of a file, up to the first that is not whole
   subroutine find_rows(store)
      !> The store, its file open and its head read
      type(store_type), intent(inout) :: store

      type(row_result_type) :: row
      integer(int64) :: bytes

      do
         call read_entry(store%reader, store%bytes + 1, store%identity%shape, row, bytes)
         if (bytes == 0) exit
         if (row%row < store%identity%first .or. row%row > store%identity%last) exit
         if (store%has(row%row)) exit
         call note_row(store, row, bytes)
      end do
   end subroutine find_rows

   !> Note a row at the end of the file
   subroutine note_row(store, row, bytes)
      type(store_type), intent(inout) :: store
      type(row_result_type), intent(in) :: row
      !> Its length
      integer(int64), intent(in) :: bytes

      store%place(row%row) = store%bytes + 1
      store%bytes = store%bytes + bytes
      store%done = store%done + 1
      call store%work%add(row%work)
   end subroutine note_row

   !> Is a row there?
   pure logical function has(self, row)
      class(store_type), intent(in) :: self
      !> Number of the row
      integer, intent(in) :: row

      has = self%place(row) > 0
   end function has

   !> Are all rows there?
   pure logical function is_complete(self)
      class(store_type), intent(in) :: self

      is_complete = self%done == size(self%place)
   end function is_complete

   !> Claim the store for the rows of this run until it is closed; the incomplete row of a killed run is cut off. If all rows
   !> are there, only the remains of a killed run are cleared
   subroutine claim(self, error)
      class(store_type), intent(inout) :: self
      !> Another run is writing it, or it cannot be written
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: head
      type(store_type) :: now
      type(holder_type) :: holder
      integer(int64) :: size
      logical :: exists, ok

      if (len(self%path) == 0) return
      if (self%is_complete()) then
         call look_at_lock(self%path, holder, exists)
         if (.not. exists .or. holder%is_alive) return
      end if
      call self%lock%take(self%path, error)
      if (allocated(error)) return
      self%is_writing = .true.
      if (len_trim(self%lock%killed) > 0) call remove_file(ordered_path(self, self%lock%killed))
      call self%writer%append_to(self%path, ok)
      if (.not. ok) call raise_failure(error, self%path//': cannot be written')
      size = file_size(self%path)
      if (.not. allocated(error) .and. size /= self%size) then
         ! Another run has added rows meanwhile, and has ended.
         call open_store(now, self%path, self%identity, error)
         if (.not. allocated(error)) then
            self%done = now%done
            self%work = now%work
            self%bytes = now%bytes
            self%place = now%place
         end if
      end if
      if (.not. allocated(error)) then
         if (size > self%bytes) then
            call cut_file(self%path, self%bytes, ok)
            if (.not. ok) call raise_failure(error, self%path//': cannot be written')
         end if
         if (self%bytes == 0 .and. ok) then
            call make_head(self%identity, head)
            call append(self, head, error)
            if (.not. allocated(error)) self%bytes = len(head, int64)
         end if
      end if
      if (.not. allocated(error)) call self%lock%sign(error, self%done)
      if (allocated(error)) call self%close()
   end subroutine claim

   !> Path of the file while its rows are brought into their order
   pure function ordered_path(store, run) result(path)
      type(store_type), intent(in) :: store
      !> Name of the run that does so
      character(len=*), intent(in) :: run
      !> Path
      character(len=len(store%path) + len(run) + 6) :: path

      path = store%path//'.'//run//'.part'
   end function ordered_path

   !> Put rows in; those that are there already stay as they are
   subroutine put(self, rows, error)
      !> The store, claimed
      class(store_type), intent(inout) :: self
      type(row_result_type), intent(in) :: rows(:)
      !> They cannot be written whole, or another run writes the file too
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: entries
      integer(int64) :: bytes(size(rows)), at
      integer :: i

      bytes = 0
      do i = 1, size(rows)
         if (.not. self%has(rows(i)%row)) bytes(i) = bytes_of_entry(self%identity%shape, rows(i)%histories, rows(i)%ties)
      end do
      allocate (character(len=sum(bytes)) :: entries)
      at = 0
      do i = 1, size(rows)
         if (bytes(i) > 0) call pack_entry(rows(i), entries(at + 1:at + bytes(i)))
         at = at + bytes(i)
      end do
      if (len(self%path) > 0) call append(self, entries, error)
      if (allocated(error)) return
      at = 0
      do i = 1, size(rows)
         if (bytes(i) == 0) cycle
         call note_row(self, rows(i), bytes(i))
         if (len(self%path) == 0) self%entry(rows(i)%row)%text = entries(at + 1:at + bytes(i))
         at = at + bytes(i)
      end do
   end subroutine put

   !> Append bytes to the file, whole or not at all
   subroutine append(store, bytes, error)
      !> The store, claimed; what it has is known to its caller
      class(store_type), intent(inout) :: store
      !> The bytes
      character(len=*), intent(in) :: bytes
      !> They could not be written, or the file is not as this run has left it
      type(error_type), allocatable, intent(out) :: error

      logical :: ok

      ! Where the file system has no locks
      if (file_size(store%path) /= store%bytes) then
         call raise_failure(error, store%path//': has changed since this run began: does another run write it?')
         return
      end if
      ok = .true.
      call store%writer%write(bytes, ok)
      call store%writer%flush(ok)
      if (ok) return
      call raise_failure(error, store%path//': cannot be written whole: is the disk full? It holds '// &
         & to_text(store%done)//' of '//to_text(store%identity%last - store%identity%first + 1)//' rows')
      call store%close()
      if (store%bytes > 0) then
         call cut_file(store%path, store%bytes, ok)
      else
         call remove_file(store%path)
      end if
   end subroutine append

   !> Read a row
   subroutine read_row(self, number, row, error)
      class(store_type), intent(inout) :: self
      !> Number of the row, which is there
      integer, intent(in) :: number
      type(row_result_type), intent(out) :: row
      !> The file has changed
      type(error_type), allocatable, intent(out) :: error

      integer(int64) :: bytes
      logical :: ok

      if (len(self%path) == 0) then
         call unpack_entry(self%entry(number)%text, self%identity%shape, row, bytes)
         return
      end if
      ok = .true.
      if (.not. self%reader%is_open()) call self%reader%open(self%path, ok)
      if (.not. ok) then
         call raise_failure(error, self%path//': cannot be read')
         return
      end if
      call read_entry(self%reader, self%place(number), self%identity%shape, row, bytes)
      if (bytes == 0 .or. row%row /= number) call raise_failure(error, self%path//': has changed while it was read')
   end subroutine read_row

   !> Read what came of a row from the store that has it
   subroutine read_result(stores, number, row, error)
      !> Stores of all rows, complete and in their order
      type(store_type), intent(inout) :: stores(:)
      !> Number of the row
      integer, intent(in) :: number
      type(row_result_type), intent(out) :: row
      !> The file has changed
      type(error_type), allocatable, intent(out) :: error

      integer :: k

      do k = 1, size(stores) - 1
         if (number <= stores(k)%identity%last) exit
      end do
      call stores(k)%read(number, row, error)
      ! Rows are read in their order: many parts need not be open at once.
      if (number == stores(k)%identity%last) call stores(k)%close()
   end subroutine read_result

   !> End putting in and reading; a store that has all rows gets them in their order
   impure elemental subroutine close_store(self)
      class(store_type), intent(inout) :: self

      logical :: ok

      ok = .true.
      call self%reader%close()
      if (.not. self%is_writing) return
      self%is_writing = .false.
      if (self%is_complete()) then
         if (any(self%place(lbound(self%place, 1) + 1:) < self%place(:ubound(self%place, 1) - 1))) call bring_into_order(self)
      end if
      call self%writer%close(ok)
      call self%lock%release()
   end subroutine close_store

   !> Write the rows anew in their order; if there is no room for that the file stays as it is
   subroutine bring_into_order(store)
      !> The store, complete
      type(store_type), intent(inout) :: store

      type(writer_type) :: writer
      type(row_result_type) :: row
      type(error_type), allocatable :: error
      character(len=:), allocatable :: bytes, path
      integer(int64), allocatable :: place(:)
      integer(int64) :: at
      integer :: i
      logical :: ok

      path = ordered_path(store, store%lock%run)
      call writer%create(path, ok)
      if (.not. ok) return
      call make_head(store%identity, bytes)
      call writer%write(bytes, ok)
      at = len(bytes, int64)
      place = store%place
      do i = store%identity%first, store%identity%last
         call store%read(i, row, error)
         if (allocated(error)) exit
         deallocate (bytes)
         allocate (character(len=bytes_of_entry(store%identity%shape, row%histories, row%ties)) :: bytes)
         call pack_entry(row, bytes)
         call writer%write(bytes, ok)
         place(i) = at + 1
         at = at + len(bytes, int64)
      end do
      call writer%synchronize(ok)
      call writer%close(ok)
      call store%reader%close()
      ok = ok .and. .not. allocated(error)
      if (ok) call rename_file(path, store%path, ok)
      if (ok) store%place = place
      if (.not. ok) call remove_file(path)
   end subroutine bring_into_order

   !> Remove it
   subroutine remove(self)
      class(store_type), intent(inout) :: self

      type(error_type), allocatable :: error

      call self%close()
      if (len(self%path) == 0) return
      call self%lock%take(self%path, error)
      call remove_file(self%path)
      call self%lock%release()
   end subroutine remove

end module dondolo_population_store
