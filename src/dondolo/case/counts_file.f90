!> Counts of a population on their way: a file that grows by a block of rows at a time, so that a run that was killed
!> goes on where it was, and that is read again, row by row, when curves and tables are made of it.
!>
!> It is binary, for the machine that wrote it and its like. Every block carries its length and a fingerprint: what a
!> killed run left of its last block is seen and cut off.
module dondolo_counts_file
   use, intrinsic :: iso_fortran_env, only : int32, int64
   use dondolo_counts, only : counts_type, pack_counts, shape_type, unpack_counts
   use dondolo_error, only : error_type, raise_failure, raise_input
   use dondolo_fingerprint, only : fingerprint_type
   use dondolo_kinds, only : wp
   use dondolo_system, only : cut_file, remove_file, writer_type
   use dondolo_text, only : to_text
   use dondolo_work, only : work_type
   implicit none
   private

   public :: counts_key_type, counts_file_type, create_counts, append_counts, inspect_counts

   !> What the file begins with
   character(len=*), parameter :: magic = 'dondolo counts 1'

   !> Bytes of the head of the file, of its part that the fingerprint at its end is of, and of a block before its
   !> contents: the number of rows, the length of the contents, and a fingerprint of all of them
   integer, parameter :: head_bytes = 128, fingerprint_at = head_bytes - 16, block_head_bytes = 28

   !> What must be the same in files of one study
   type :: counts_key_type
      !> Fingerprints of the table of walls, of the accelerograms, and of the levels and settings
      character(len=16) :: walls = '', records = '', settings = ''
      !> Build variant
      character(len=16) :: variant = ''
      !> Shape of the counts of a row
      type(shape_type) :: shape
   end type counts_key_type

   !> A file of counts that is read
   type :: counts_file_type
      !> Path
      character(len=:), allocatable :: path
      !> What it belongs to
      type(counts_key_type) :: key
      !> First and last row of the population that it is for
      integer :: first = 0, last = 0
      !> Last row that it has
      integer :: done = 0
      !> What was computed for these
      type(work_type) :: work
      !> Bytes up to the end of the last whole block
      integer(int64) :: bytes = 0
      !> Its unit while it is read; 0: not open
      integer :: unit = 0
      !> Rows of the block that was read last, and the place in it
      type(counts_type), allocatable :: rows(:)
      !> The row given out last
      integer :: at = 0
   contains
      !> Open it to read its rows
      procedure :: open => open_counts
      !> Read the next row
      procedure :: next
      !> Close it
      procedure :: close => close_counts
   end type counts_file_type

contains

   !> Create a file without rows
   subroutine create_counts(path, key, first, last, error)
      !> Path
      character(len=*), intent(in) :: path
      !> What it belongs to
      type(counts_key_type), intent(in) :: key
      !> First row that it is for
      integer, intent(in) :: first
      !> Last row that it is for
      integer, intent(in) :: last
      !> It cannot be written
      type(error_type), allocatable, intent(out) :: error

      call write_bytes(path, head_of(key, first, last), .false., error)
   end subroutine create_counts

   !> Append a block of rows
   subroutine append_counts(file, rows, work, error)
      !> The file, which was inspected: what it has is kept up to date
      type(counts_file_type), intent(inout) :: file
      !> The rows
      type(counts_type), intent(in) :: rows(:)
      !> What was computed for them
      type(work_type), intent(in) :: work
      !> It cannot be written whole, or another run writes it too
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: contents
      character(len=12) :: head
      integer(int64) :: bytes

      inquire (file=file%path, size=bytes)
      if (bytes /= file%bytes) then
         call raise_failure(error, file%path//': has changed since this run began: does another run write it?')
         return
      end if
      contents = pack_counts(rows, work)
      head = bytes_of_integers([int(size(rows), int32), transfer(len(contents, int64), [0_int32, 0_int32])])
      call write_bytes(file%path, head//fingerprint_of(head//contents)//contents, .true., error)
      if (allocated(error)) return
      file%bytes = file%bytes + block_head_bytes + len(contents, int64)
      file%done = file%done + size(rows)
      call file%work%add(work)
   end subroutine append_counts

   !> Look into a file: what it belongs to and how far it is
   subroutine inspect_counts(path, file, exists, error)
      !> Path
      character(len=*), intent(in) :: path
      !> The file; it is closed again
      type(counts_file_type), intent(out) :: file
      !> Is there such a file, with at least a whole head?
      logical, intent(out) :: exists
      !> It is something else
      type(error_type), allocatable, intent(out) :: error

      type(counts_type), allocatable :: rows(:)
      character(len=head_bytes) :: head
      type(work_type) :: work
      integer(int64) :: bytes
      integer :: stat
      logical :: found

      file%path = path
      inquire (file=path, exist=exists, size=bytes)
      if (.not. exists) return
      ! A run was killed when it had hardly begun. A pipe has no size either, and would be waited for.
      exists = bytes >= head_bytes
      if (bytes == 0) return
      if (bytes > 0 .and. bytes < head_bytes) then
         if (starts_like_head(path, int(bytes))) return
      end if
      if (exists) then
         open (newunit=file%unit, file=path, access='stream', form='unformatted', action='read', status='old', &
            & iostat=stat)
         if (stat == 0) read (file%unit, iostat=stat) head
         if (stat == 0 .and. index(head, magic) /= 1) stat = 1
         if (stat == 0 .and. head(fingerprint_at + 1:) /= fingerprint_of(head(:fingerprint_at))) stat = 1
      else
         stat = 1
      end if
      if (stat /= 0) then
         call file%close()
         call raise_input(error, path//': is no file of counts of dondolo, or its head is damaged')
         return
      end if
      call read_head(head, file, error)
      if (allocated(error)) then
         call file%close()
         return
      end if
      file%done = file%first - 1
      file%bytes = head_bytes
      do
         call read_block(file, rows, work, bytes, found)
         if (.not. found) exit
         if (rows(1)%row /= file%done + 1) exit
         file%done = rows(size(rows))%row
         file%bytes = file%bytes + bytes
         call file%work%add(work)
      end do
      call file%close()
   end subroutine inspect_counts

   !> Does a file that is too short begin as one of counts does?
   logical function starts_like_head(path, bytes)
      !> Path
      character(len=*), intent(in) :: path
      !> Its length
      integer, intent(in) :: bytes

      character(len=bytes) :: begin
      integer :: unit, stat, length

      open (newunit=unit, file=path, access='stream', form='unformatted', action='read', status='old', iostat=stat)
      if (stat == 0) then
         read (unit, iostat=stat) begin
         close (unit)
      end if
      length = min(bytes, len(magic))
      starts_like_head = stat == 0
      if (starts_like_head) starts_like_head = begin(:length) == magic(:length)
   end function starts_like_head

   !> Open it to read its rows
   subroutine open_counts(self, error)
      !> The file, which was inspected
      class(counts_file_type), intent(inout) :: self
      !> It cannot be read any more
      type(error_type), allocatable, intent(out) :: error

      character(len=head_bytes) :: head
      integer :: stat

      call self%close()
      self%at = 0
      if (allocated(self%rows)) deallocate (self%rows)
      allocate (self%rows(0))
      open (newunit=self%unit, file=self%path, access='stream', form='unformatted', action='read', status='old', &
         & iostat=stat)
      if (stat == 0) read (self%unit, iostat=stat) head
      if (stat /= 0) call raise_failure(error, self%path//': cannot be read')
   end subroutine open_counts

   !> Read the next row
   subroutine next(self, counts, found, error)
      !> The file
      class(counts_file_type), intent(inout) :: self
      !> Counts of the row
      type(counts_type), intent(out) :: counts
      !> Was there one?
      logical, intent(out) :: found
      !> The file has changed since it was inspected
      type(error_type), allocatable, intent(out) :: error

      type(counts_type), allocatable :: rows(:)
      type(work_type) :: work
      integer(int64) :: bytes
      integer :: last

      found = .false.
      if (self%at == size(self%rows)) then
         last = self%first - 1
         if (self%at > 0) last = self%rows(self%at)%row
         if (last == self%done) return
         call read_block(self, rows, work, bytes, found)
         ! Two runs that wrote one file at a time would be seen here.
         if (found) found = rows(1)%row == last + 1
         if (.not. found) then
            call raise_failure(error, self%path//': has changed while it was read')
            return
         end if
         call move_alloc(rows, self%rows)
         self%at = 0
      end if
      self%at = self%at + 1
      found = .true.
      counts = self%rows(self%at)
   end subroutine next

   !> Close it
   subroutine close_counts(self)
      !> The file
      class(counts_file_type), intent(inout) :: self

      if (self%unit /= 0) close (self%unit)
      self%unit = 0
   end subroutine close_counts

   !> Read a block
   subroutine read_block(file, rows, work, bytes, found)
      !> The file, open
      type(counts_file_type), intent(in) :: file
      !> Its rows
      type(counts_type), allocatable, intent(out) :: rows(:)
      !> What was computed for them
      type(work_type), intent(out) :: work
      !> Its length in the file
      integer(int64), intent(out) :: bytes
      !> Was there a whole one?
      logical, intent(out) :: found

      character(len=12) :: head
      integer(int32) :: numbers(3)
      integer(int64) :: length, room
      character(len=16) :: fingerprint
      character(len=:), allocatable :: contents
      integer :: stat

      found = .false.
      bytes = 0
      read (file%unit, iostat=stat) head, fingerprint
      if (stat /= 0) return
      numbers = transfer(head, numbers)
      length = transfer(numbers(2:3), length)
      inquire (unit=file%unit, size=room)
      if (numbers(1) < 1 .or. length < 1 .or. length > room) return
      allocate (character(len=length) :: contents)
      read (file%unit, iostat=stat) contents
      if (stat /= 0) return
      if (fingerprint_of(head//contents) /= fingerprint) return
      call unpack_counts(contents, int(numbers(1)), file%key%shape, rows, work, found)
      if (found) bytes = length + block_head_bytes
   end subroutine read_block

   !> The head of a file
   function head_of(key, first, last) result(head)
      !> What it belongs to
      type(counts_key_type), intent(in) :: key
      !> First row that it is for
      integer, intent(in) :: first
      !> Last row that it is for
      integer, intent(in) :: last
      !> Head
      character(len=head_bytes) :: head

      head(:fingerprint_at) = magic//key%walls//key%records//key%settings//key%variant//bytes_of_integers( &
         & [int(first, int32), int(last, int32), int(storage_size(1.0_wp), int32), int(key%shape%levels, int32), &
         & int(key%shape%thresholds, int32), merge(1_int32, 0_int32, key%shape%keeps_histories)])
      head(fingerprint_at + 1:) = fingerprint_of(head(:fingerprint_at))
   end function head_of

   !> Read the head of a file
   subroutine read_head(head, file, error)
      !> Head
      character(len=*), intent(in) :: head
      !> The file: its key and rows are set
      type(counts_file_type), intent(inout) :: file
      !> It is of another precision
      type(error_type), allocatable, intent(out) :: error

      integer(int32) :: numbers(6)
      integer :: at

      at = len(magic)
      file%key%walls = head(at + 1:at + 16)
      file%key%records = head(at + 17:at + 32)
      file%key%settings = head(at + 33:at + 48)
      file%key%variant = head(at + 49:at + 64)
      numbers = transfer(head(at + 65:at + 88), numbers)
      file%first = numbers(1)
      file%last = numbers(2)
      file%key%shape = shape_type(numbers(4), numbers(5), numbers(6) == 1)
      if (numbers(3) /= storage_size(1.0_wp)) call raise_input(error, file%path//': was made in real'// &
         & to_text(int(numbers(3)))//', not in real'//to_text(storage_size(1.0_wp)))
   end subroutine read_head

   !> Fingerprint of bytes
   function fingerprint_of(contents) result(text)
      !> The bytes
      character(len=*), intent(in) :: contents
      !> Fingerprint
      character(len=16) :: text

      type(fingerprint_type) :: fingerprint

      call fingerprint%add_text(contents)
      text = fingerprint%text()
   end function fingerprint_of

   !> Integers as bytes
   pure function bytes_of_integers(integers) result(bytes)
      !> Integers
      integer(int32), intent(in) :: integers(:)
      !> Bytes
      character(len=4*size(integers)) :: bytes

      bytes = transfer(integers, bytes)
   end function bytes_of_integers

   !> Write bytes, whole or not at all
   subroutine write_bytes(path, bytes, behind, error)
      !> Path
      character(len=*), intent(in) :: path
      !> The bytes
      character(len=*), intent(in) :: bytes
      !> Behind what is there? Otherwise in its place
      logical, intent(in) :: behind
      !> They could not be written
      type(error_type), allocatable, intent(out) :: error

      type(writer_type) :: writer
      integer(int64) :: before
      logical :: ok

      before = 0
      if (behind) inquire (file=path, size=before)
      call writer%open(path, ok, append=behind)
      if (ok) then
         call writer%write(bytes, ok)
         call writer%close(ok)
      end if
      if (ok) return
      call raise_failure(error, path//': cannot be written whole: is the disk full?')
      if (behind) then
         call cut_file(path, before, ok)
      else
         call remove_file(path)
      end if
   end subroutine write_bytes

end module dondolo_counts_file
