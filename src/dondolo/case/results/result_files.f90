!> The result files of a run: all of them appear whole, or none does.
!>
!> Every file is first written as `<file>.part`; when all are written they get their names. That the place can be
!> written to is tried before the computation begins, and leaves nothing behind.
module dondolo_result_files
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_error, only : error_type, raise_failure, raise_input
   use dondolo_lines, only : lines_type
   use dondolo_system, only : is_folder, make_folder, remove_file, remove_folder, rename_file, same_file, writer_type
   implicit none
   private

   public :: result_files_type, check_output, make_folders

   !> The files of a run
   type :: result_files_type
      !> What all their names begin with
      character(len=:), allocatable :: prefix
      !> Paths of the files, in the order in which they were begun
      type(lines_type) :: paths
      !> Folders that were made for them
      type(lines_type) :: made
      !> The file that is being written
      type(writer_type) :: writer
      !> Has everything been written so far?
      logical :: ok = .true.
   contains
      !> Begin a file
      procedure :: begin
      !> Write a line to it
      procedure :: line
      !> Finish it
      procedure :: finish
      !> Give all files their names
      procedure :: commit
      !> Remove a file of an earlier run
      procedure :: remove_old
      !> Leave nothing of the run
      procedure :: abandon
   end type result_files_type

contains

   !> Try whether result files can be written, and leave no trace
   subroutine check_output(prefix, suffixes, inputs, error)
      !> What their names begin with
      character(len=*), intent(in) :: prefix
      !> What their names end with
      character(len=*), intent(in) :: suffixes(:)
      !> Paths of the files of the case, which no result may replace
      type(lines_type), intent(in) :: inputs
      !> They cannot: `'path': why`
      type(error_type), allocatable, intent(out) :: error

      type(lines_type) :: made
      type(writer_type) :: writer
      character(len=:), allocatable :: path
      logical :: ok
      integer :: i, j

      do i = 1, size(suffixes)
         path = prefix//trim(suffixes(i))
         if (is_folder(path)) then
            call raise_input(error, 'the result file '//path//' is a folder')
            return
         end if
         do j = 1, inputs%count
            if (.not. same_file(path, inputs%line(j)%text)) cycle
            call raise_input(error, 'the result file '//path//' would replace a file of the case')
            return
         end do
      end do
      call make_folders(prefix, made, ok)
      if (ok) then
         ! No name of a result file is longer than this one
         path = prefix//'_histories.csv.part'
         call try(writer, path, ok)
         if (.not. ok) call raise_input(error, 'the file '//path//' cannot be written')
      else
         call raise_input(error, 'the folder '//prefix(:folder_end(prefix))//' cannot be made')
      end if
      call remove_folders(made)
   end subroutine check_output

   !> Try to write one file; a file that is there already is left alone
   subroutine try(writer, path, ok)
      type(writer_type), intent(inout) :: writer
      !> Path
      character(len=*), intent(in) :: path
      !> It can be written
      logical, intent(out) :: ok

      logical :: there

      inquire (file=path, exist=there)
      if (there) then
         ! Left behind by a run that was killed: it will be replaced
         ok = .not. is_folder(path)
         return
      end if
      call writer%open(path, ok)
      if (.not. ok) return
      call writer%close(ok)
      call remove_file(path)
   end subroutine try

   !> Make the folders of a prefix that do not exist yet
   subroutine make_folders(prefix, made, ok)
      !> Prefix
      character(len=*), intent(in) :: prefix
      !> The folders that were made
      type(lines_type), intent(out) :: made
      !> All folders exist now
      logical, intent(out) :: ok

      integer :: i

      ok = .true.
      do i = 2, folder_end(prefix)
         if (prefix(i:i) /= '/') cycle
         if (is_folder(prefix(:i - 1))) cycle
         call make_folder(prefix(:i - 1), ok)
         if (.not. ok) return
         call made%add(prefix(:i - 1))
      end do
   end subroutine make_folders

   !> Remove folders that were made, the deepest first
   subroutine remove_folders(made)
      type(lines_type), intent(in) :: made

      integer :: i

      do i = made%count, 1, -1
         call remove_folder(made%line(i)%text)
      end do
   end subroutine remove_folders

   !> Position of the slash after the folders of a prefix, 0 if there are none
   pure integer function folder_end(prefix)
      !> Prefix
      character(len=*), intent(in) :: prefix

      folder_end = index(prefix, '/', back=.true.)
   end function folder_end

   !> Begin a file
   subroutine begin(self, suffix, error)
      !> The files of the run
      class(result_files_type), intent(inout) :: self
      !> What its name ends with
      character(len=*), intent(in) :: suffix
      !> It cannot be written
      type(error_type), allocatable, intent(out) :: error

      if (self%paths%count == 0) call make_folders(self%prefix, self%made, self%ok)
      if (self%ok) call self%writer%open(self%prefix//suffix//'.part', self%ok)
      if (self%ok) then
         call self%paths%add(self%prefix//suffix)
      else
         call self%abandon()
         call raise_failure(error, self%prefix//suffix//'.part: cannot be written')
      end if
   end subroutine begin

   !> Write a line
   subroutine line(self, text)
      !> The files of the run
      class(result_files_type), intent(inout) :: self
      !> The line
      character(len=*), intent(in) :: text

      if (self%ok) call self%writer%write(text//new_line('a'), self%ok)
   end subroutine line

   !> Finish a file
   subroutine finish(self, error)
      !> The files of the run
      class(result_files_type), intent(inout) :: self
      !> It could not be written whole; nothing of the run is left
      type(error_type), allocatable, intent(out) :: error

      call self%writer%close(self%ok)
      if (self%ok) return
      call raise_failure(error, self%paths%line(self%paths%count)%text//': cannot be written whole: is the disk full?')
      call self%abandon()
   end subroutine finish

   !> Give all files their names
   subroutine commit(self, error)
      !> The files of the run
      class(result_files_type), intent(inout) :: self
      !> One of them could not have its name
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      do i = 1, self%paths%count
         call rename_file(self%paths%line(i)%text//'.part', self%paths%line(i)%text, self%ok)
         if (self%ok) cycle
         call raise_failure(error, self%paths%line(i)%text//': cannot be replaced')
         call self%abandon()
         return
      end do
   end subroutine commit

   !> Remove a file that an earlier run has left; only what begins as a result file does, and is no input, is removed
   subroutine remove_old(self, suffix, mark, inputs)
      !> The files of the run
      class(result_files_type), intent(in) :: self
      !> What its name ends with
      character(len=*), intent(in) :: suffix
      !> What result files begin with
      character(len=*), intent(in) :: mark
      !> Paths of the files of the case
      type(lines_type), intent(in) :: inputs

      character(len=:), allocatable :: path
      character(len=len(mark)) :: begin
      integer(int64) :: bytes
      integer :: unit, stat, i

      path = self%prefix//suffix
      ! A pipe has no size, and would be waited for.
      inquire (file=path, size=bytes)
      if (bytes < len(mark)) return
      do i = 1, inputs%count
         if (same_file(path, inputs%line(i)%text)) return
      end do
      open (newunit=unit, file=path, access='stream', form='unformatted', action='read', status='old', iostat=stat)
      if (stat /= 0) return
      read (unit, iostat=stat) begin
      close (unit)
      if (stat == 0 .and. begin == mark) call remove_file(path)
   end subroutine remove_old

   !> Remove what has been written; folders that are not empty stay
   subroutine abandon(self)
      !> The files of the run; the one that is being written is closed
      class(result_files_type), intent(inout) :: self

      integer :: i
      logical :: ok

      call self%writer%close(ok)
      do i = 1, self%paths%count
         call remove_file(self%paths%line(i)%text//'.part')
      end do
      call remove_folders(self%made)
   end subroutine abandon

end module dondolo_result_files
