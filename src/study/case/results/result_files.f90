!> The result files of a run, published at once: whoever reads them finds the whole set of one run, whatever moment a run
!> was killed at, and whatever other run is under way.
!>
!> 1. One run at a time writes an output: it has the lock of the prefix (dondolo_files_lock).
!> 2. Every file is written as PREFIX_table.csv.RUN.part, where RUN names the run. The name is new, and the file made
!>    by this run alone: nothing of anybody else is opened, followed or replaced. It is synchronized to the disk.
!> 3. The set is published by one rename, that of PREFIX_run.json, which names RUN. Before it the old set is in force, since
!>    its files have not been touched; after it the new one, each file of which stands under its own name or still under its
!>    name of 2. A rename is atomic, so that it is one or the other at any moment, and readers look for both.
!> 4. The tables are renamed. A run that was killed before that leaves its lock file, from which the next run learns RUN: it
!>    renames what was published, and removes what was not.
!>
!> The folder is synchronized between 3 and 4, so that a loss of power does not keep 4 without 3, and after 4, before a
!> checkpoint is removed. Tables begin with a line that names RUN, so that files that were brought together by other
!> means are found out.
module dondolo_case_result_files
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_null_char
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_error, only : error_type, raise_failure, raise_input, status_failure
   use dondolo_base_lines, only : lines_type
   use dondolo_files_checksum, only : crc32_length, crc32_of_file
   use dondolo_files_lock, only : lock_type
   use dondolo_files_origin, only : check_replaced, look_at_origin, origin_type, run_length
   use dondolo_files_system, only : file_exists, folder_of, is_folder, is_free, make_folder, remove_file, remove_folder, &
      & rename_file, same_file, synchronize_folder, try_file, writer_type
   use dondolo_files_version, only : dondolo_version_text
   implicit none
   private

   public :: result_files_type, written_type, check_output, make_folders, published_run, run_suffix, suffix_length

   !> What the name of the file ends with that publishes the set
   character(len=*), parameter :: run_suffix = '_run.json'

   !> Length of what the name of a table ends with, with room
   integer, parameter :: suffix_length = 24

   !> What every table begins with
   character(len=*), parameter :: mark = '# dondolo '

   !> How often a file is made, while another run that ends removes the folder that it has made
   integer, parameter :: tries = 3

   !> A file that was written
   type :: written_type
      !> What its name ends with
      character(len=suffix_length) :: suffix = ''
      !> Its length
      integer(int64) :: bytes = 0
      !> CRC-32 of what follows the line that names the run: the same for the same results
      character(len=crc32_length) :: checksum = ''
   end type written_type

   !> The files of a run
   type :: result_files_type
      !> What all their names begin with
      character(len=:), allocatable :: prefix
      !> The lock of the prefix, with the name of the run
      type(lock_type) :: lock
      !> What the names of tables can end with, of any run
      character(len=suffix_length), allocatable :: tables(:)
      !> The files, in the order in which they were begun
      type(written_type), allocatable :: written(:)
      !> Folders that were made for them
      type(lines_type), private :: made
      !> The file that is being written, and where in it the lines begin that are the same for the same results
      type(writer_type), private :: writer
      integer, private :: body = 0
      !> Has everything been written so far?
      logical, private :: ok = .true.
   contains
      !> Take the lock of a prefix, and complete or remove what a killed run has left
      procedure :: claim
      !> Begin a file
      procedure :: begin
      !> Write a line to it
      procedure :: line
      !> Finish it
      procedure :: finish
      !> Publish the set
      procedure :: publish
      !> Give the lock back; what was not published is removed
      procedure :: close => close_files
   end type result_files_type

   interface

      !> What keeps a path from being that of a file; see files.c
      integer(c_int) function path_problem(path) bind(c, name='dondolo_path_problem')
         import :: c_char, c_int
         !> Path, with a NUL at its end
         character(kind=c_char), intent(in) :: path(*)
      end function path_problem

   end interface

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

      ! The name of no run: a trial that was killed at once is found, and removed, by the next
      character(len=*), parameter :: trial = '00000000T000000Z-0000000000000000'
      type(lines_type) :: made
      character(len=:), allocatable :: path, longest
      logical :: ok
      integer :: i, j

      ! No name of a result file is longer than this one
      longest = staged(prefix//'_histories.csv', trial)
      call check_names(prefix, longest, error)
      if (allocated(error)) return
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
         call check_replaced(path, kind_of(suffixes(i)), error)
         if (.not. allocated(error) .and. .not. is_free(path)) call raise_input(error, 'the result file '//path// &
            & ' is open in another program, which keeps it from being replaced')
         if (allocated(error)) return
      end do
      do i = 1, tries
         call make_folders(prefix, made, ok)
         if (.not. ok) cycle
         call try_file(longest, ok)
         if (ok) exit
      end do
      if (.not. ok) then
         if (is_folder(folder_of(prefix))) then
            call raise_input(error, 'the file '//prefix//'_histories.csv cannot be written')
         else
            call raise_input(error, 'the folder '//prefix(:folder_end(prefix))//' cannot be made')
         end if
      end if
      call remove_folders(made)
   end subroutine check_output

   !> Refuse names that Windows has for devices, and paths that are too long for it
   subroutine check_names(prefix, longest, error)
      !> What the names of all files begin with; that of the lock is the shortest
      character(len=*), intent(in) :: prefix
      !> The longest path
      character(len=*), intent(in) :: longest
      !> `why`
      type(error_type), allocatable, intent(out) :: error

      ! MAX_PATH of Windows, less the NUL at the end
      integer, parameter :: most_letters = 259
      character(len=12) :: letters, most
      integer :: problem

      if (path_problem(prefix//'.lock'//c_null_char) < 0) then
         call raise_input(error, 'con, prn, aux, nul, com1 to com9 and lpt1 to lpt9 are devices of Windows: choose another name')
         return
      end if
      problem = path_problem(longest//c_null_char)
      if (problem <= 0) return
      write (letters, '(i0)') problem
      write (most, '(i0)') most_letters
      call raise_input(error, 'a path of '//trim(letters)//' letters would be written, Windows allows '//trim(most)// &
         & ': shorten it, or move the study to a folder nearer to the drive')
   end subroutine check_names

   !> What kind of file a result is
   pure function kind_of(suffix) result(kind)
      !> What its name ends with
      character(len=*), intent(in) :: suffix
      character(len=5) :: kind

      kind = merge('run  ', 'table', suffix == run_suffix)
   end function kind_of

   !> Path of a file before it is published
   pure function staged(path, run)
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Name of the run
      character(len=*), intent(in) :: run
      !> Path
      character(len=len(path) + len(run) + 6) :: staged

      staged = path//'.'//run//'.part'
   end function staged

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
         if (ok) then
            call made%add(prefix(:i - 1))
         else
            ! Another run may have made it meanwhile.
            ok = is_folder(prefix(:i - 1))
            if (.not. ok) return
         end if
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

   !> Take the lock of a prefix, and complete or remove what a killed run has left
   subroutine claim(self, prefix, tables, error)
      class(result_files_type), intent(inout) :: self
      !> What the names of the files begin with
      character(len=*), intent(in) :: prefix
      !> What the names of tables can end with, of any run
      character(len=suffix_length), intent(in) :: tables(:)
      !> Another run writes them, or they cannot be written
      type(error_type), allocatable, intent(out) :: error

      logical :: ok
      integer :: i

      self%prefix = prefix
      self%tables = tables
      allocate (self%written(0))
      do i = 1, tries
         call make_folders(prefix, self%made, ok)
         if (ok) then
            call self%lock%take(prefix, error)
         else
            call raise_failure(error, prefix//': its folder cannot be made')
         end if
         if (.not. allocated(error)) exit
         if (error%stat /= status_failure) exit
      end do
      if (.not. allocated(error)) then
         call end_publishing(prefix, tables, self%lock%killed)
         call self%lock%sign(error)
      end if
      if (allocated(error)) call remove_folders(self%made)
   end subroutine claim

   !> Rename tables of the published set that have not their names yet, and remove those that a killed run has not published
   subroutine end_publishing(prefix, tables, killed)
      !> What the names of the files begin with
      character(len=*), intent(in) :: prefix
      !> What the names of tables can end with
      character(len=suffix_length), intent(in) :: tables(:)
      !> Name of a run that was killed; blank if there was none
      character(len=run_length), intent(in) :: killed

      character(len=run_length) :: published
      character(len=:), allocatable :: path
      type(error_type), allocatable :: error
      integer :: i
      logical :: ok

      published = published_run(prefix)
      do i = 1, size(tables)
         path = prefix//trim(tables(i))
         call check_replaced(path, kind_of(tables(i)), error)
         if (len_trim(published) > 0 .and. .not. allocated(error)) call rename_file(staged(path, published), path, ok)
         if (len_trim(killed) > 0 .and. killed /= published) call remove_file(staged(path, killed))
      end do
      if (len_trim(killed) > 0) call remove_file(staged(prefix//run_suffix, killed))
   end subroutine end_publishing

   !> Name of the run whose results are published
   function published_run(prefix) result(run)
      !> What their names begin with
      character(len=*), intent(in) :: prefix
      !> Name of the run; blank if there is none
      character(len=run_length) :: run

      type(origin_type) :: origin

      run = ''
      call look_at_origin(prefix//run_suffix, origin)
      if (origin%kind == 'run') run = origin%run
   end function published_run

   !> Begin a file; a table begins with the line that names the run
   subroutine begin(self, suffix, error)
      !> The files of the run
      class(result_files_type), intent(inout) :: self
      !> What its name ends with
      character(len=*), intent(in) :: suffix
      !> It cannot be written
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: lines

      call self%writer%create(staged(self%prefix//suffix, self%lock%run), self%ok)
      if (.not. self%ok) then
         call raise_failure(error, self%prefix//suffix//': cannot be written')
         return
      end if
      self%written = [self%written, written_type(suffix=suffix)]
      if (suffix == run_suffix) return
      lines = mark//dondolo_version_text//new_line('a')//'# run: '//self%lock%run//new_line('a')
      self%body = len(lines)
      call self%writer%write(lines, self%ok)
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
      !> It could not be written whole
      type(error_type), allocatable, intent(out) :: error

      logical :: ok

      ok = .true.
      if (self%ok) call self%writer%synchronize(self%ok)
      call self%writer%close(self%ok)
      associate (file => self%written(size(self%written)))
         if (self%ok .and. file%suffix /= run_suffix) call crc32_of_file(staged(self%prefix//trim(file%suffix), &
            & self%lock%run), file%checksum, file%bytes, ok, behind=self%body)
         ! Without its checksum the table would be refused by every reader.
         self%ok = self%ok .and. ok
         if (.not. self%ok) call raise_failure(error, self%prefix//trim(file%suffix)// &
            & ': cannot be written whole: is the disk full?')
      end associate
   end subroutine finish

   !> Publish the set, and remove the tables of an earlier run that it does not replace
   subroutine publish(self, inputs, error)
      !> The files of the run, all of them written
      class(result_files_type), intent(inout) :: self
      !> Paths of the files of the case, which are not removed
      type(lines_type), intent(in) :: inputs
      !> A file cannot have its name
      type(error_type), allocatable, intent(out) :: error

      integer :: i
      logical :: ok

      do i = 1, size(self%written)
         call check_replaced(self%prefix//trim(self%written(i)%suffix), kind_of(self%written(i)%suffix), error)
         if (allocated(error)) return
      end do
      call rename_file(staged(self%prefix//run_suffix, self%lock%run), self%prefix//run_suffix, ok)
      if (.not. ok) then
         call raise_failure(error, self%prefix//run_suffix//': cannot be replaced: is it open in another program?')
         return
      end if
      ! The new set is in force.
      call synchronize_folder(self%prefix, ok)
      do i = 1, size(self%written)
         associate (path => self%prefix//trim(self%written(i)%suffix))
            if (self%written(i)%suffix /= run_suffix .and. ok) call rename_file(staged(path, self%lock%run), path, ok)
            if (ok) cycle
            call raise_failure(error, path//': cannot be replaced: is it open in another program? The new table is '// &
               & staged(path, self%lock%run)//', where dondolo finds it')
            return
         end associate
      end do
      call synchronize_folder(self%prefix, ok)
      do i = 1, size(self%tables)
         if (.not. is_written(self, self%tables(i))) call remove_old(self%prefix//trim(self%tables(i)), inputs)
      end do
   end subroutine publish

   !> Does a table belong to the set?
   pure logical function is_written(files, suffix)
      type(result_files_type), intent(in) :: files
      !> What its name ends with
      character(len=*), intent(in) :: suffix

      integer :: i

      is_written = any([(files%written(i)%suffix == suffix, i=1, size(files%written))])
   end function is_written

   !> Remove a table that an earlier run has left; only what begins as one, and is no input, is removed
   subroutine remove_old(path, inputs)
      !> Path
      character(len=*), intent(in) :: path
      !> Paths of the files of the case
      type(lines_type), intent(in) :: inputs

      type(origin_type) :: origin
      integer :: i

      call look_at_origin(path, origin)
      if (origin%kind /= 'table') return
      do i = 1, inputs%count
         if (same_file(path, inputs%line(i)%text)) return
      end do
      call remove_file(path)
   end subroutine remove_old

   !> Give the lock back; what was not published is removed, with folders that were made for it
   subroutine close_files(self)
      !> The files of the run; nothing happens if they were not claimed
      class(result_files_type), intent(inout) :: self

      integer :: i
      logical :: is_published, ok

      if (len_trim(self%lock%run) == 0) return
      ok = .true.
      call self%writer%close(ok)
      is_published = published_run(self%prefix) == self%lock%run
      do i = 1, size(self%written)
         if (.not. is_published) call remove_file(staged(self%prefix//trim(self%written(i)%suffix), self%lock%run))
      end do
      ! A table that could not be renamed stays for the next run to rename.
      call self%lock%release(keep_file=is_published .and. is_staged(self))
      if (.not. is_published) call remove_folders(self%made)
   end subroutine close_files

   !> Has a table not its own name yet?
   logical function is_staged(files)
      type(result_files_type), intent(in) :: files

      integer :: i

      is_staged = .false.
      do i = 1, size(files%written)
         is_staged = is_staged .or. file_exists(staged(files%prefix//trim(files%written(i)%suffix), files%lock%run))
      end do
   end function is_staged

end module dondolo_case_result_files
