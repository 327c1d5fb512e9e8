!> Files that are written: locks, files that appear whole or not at all, and sets of results.
module files
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use dondolo_base_error, only : error_type
   use dondolo_base_lines, only : lines_type
   use dondolo_boundary, only : split_lines
   use dondolo_case_columns, only : degrees_column, integer_column, text_column
   use dondolo_case_csv_table, only : csv_table_type
   use dondolo_case_result_files, only : published => published_run, result_files_type, run_suffix
   use dondolo_case_result_tables, only : table_suffixes
   use dondolo_files_lock, only : lock_type
   use dondolo_files_whole_file, only : whole_file_type
   use dondolo_held_files, only : end_with, find_file, find_set
   use dondolo_interface_handles, only : hold, release
   use dondolo_parcel, only : report
   implicit none
   private

   public :: begin_file, publish_file, take_lock, begin_set, write_table, publish_set, close_files, published_run

contains

   !> Begin a file: its part, `PATH.RUN.new`, is there and empty. The handle must be given back by close_files
   subroutine begin_file(path, handle, run, failure)
      character(len=*), intent(in) :: path
      integer(c_int64_t), intent(out) :: handle
      character(len=33), intent(out) :: run
      integer(c_int64_t), intent(out) :: failure(5)
      type(whole_file_type), pointer :: file
      class(*), pointer :: content
      type(error_type), allocatable :: error

      handle = 0
      allocate (file)
      call file%begin(path, error)
      run = file%run
      if (allocated(error)) then
         deallocate (file)
      else
         content => file
         call hold(content, handle)
      end if
      call report(error, failure)
   end subroutine begin_file

   !> Let the part of a file take its place
   subroutine publish_file(handle, failure)
      integer(c_int64_t), intent(in) :: handle
      integer(c_int64_t), intent(out) :: failure(5)
      type(whole_file_type), pointer :: file
      type(error_type), allocatable :: error

      call find_file(handle, file, error)
      if (.not. allocated(error)) call file%publish(error)
      call report(error, failure)
   end subroutine publish_file

   !> Take the lock of a path, and sign it; was_killed is 1 where a process was killed that had it. The handle must be given back
   !> by close_files
   subroutine take_lock(path, handle, was_killed, failure)
      character(len=*), intent(in) :: path
      integer(c_int64_t), intent(out) :: handle
      integer(c_int), intent(out) :: was_killed
      integer(c_int64_t), intent(out) :: failure(5)
      type(lock_type), pointer :: lock
      class(*), pointer :: content
      type(error_type), allocatable :: error

      handle = 0
      was_killed = 0
      allocate (lock)
      call lock%take(path, error)
      if (.not. allocated(error)) then
         was_killed = merge(1, 0, len_trim(lock%killed) > 0)
         call lock%sign(error)
      end if
      if (allocated(error)) then
         deallocate (lock)
      else
         content => lock
         call hold(content, handle)
      end if
      call report(error, failure)
   end subroutine take_lock

   !> Take the lock of a prefix to write a set of results, and end what a killed run has left; run names it. The handle must be
   !> given back by close_files
   subroutine begin_set(prefix, handle, run, failure)
      character(len=*), intent(in) :: prefix
      integer(c_int64_t), intent(out) :: handle
      character(len=33), intent(out) :: run
      integer(c_int64_t), intent(out) :: failure(5)
      type(result_files_type), pointer :: set
      class(*), pointer :: content
      type(error_type), allocatable :: error

      handle = 0
      run = ''
      allocate (set)
      call set%claim(prefix, table_suffixes(), error)
      if (allocated(error)) then
         deallocate (set)
      else
         run = set%lock%run
         content => set
         call hold(content, handle)
      end if
      call report(error, failure)
   end subroutine begin_set

   !> Write a table of n rows and k columns: comments above it, a line each, names of its columns, kinds of these as
   !> dondolo_case_columns has them, numbers (NaN: an empty cell), of texts which line of the texts that differ it is. bytes and
   !> checksum are those of the file of the run
   subroutine write_table(handle, suffix, comments, names, kinds, k, numbers, n, texts, is_safe, bytes, checksum, failure)
      !f2py threadsafe
      integer(c_int64_t), intent(in) :: handle
      character(len=*), intent(in) :: suffix, comments, names, texts
      integer(c_int), intent(in) :: k, n, is_safe, kinds(k)
      real(c_double), intent(in) :: numbers(n, k)
      integer(c_int64_t), intent(out) :: bytes
      character(len=8), intent(out) :: checksum
      integer(c_int64_t), intent(out) :: failure(5)
      type(result_files_type), pointer :: set
      type(lines_type) :: heads, words, above
      type(csv_table_type) :: table
      type(error_type), allocatable :: error
      integer :: i

      bytes = 0
      checksum = ''
      call split_lines(comments, above)
      call split_lines(names, heads)
      call split_lines(texts, words)
      call find_set(handle, set, error)
      if (.not. allocated(error)) call set%begin(suffix, error)
      if (.not. allocated(error)) then
         do i = 1, above%count
            call set%line('# '//above%line(i)%text)
         end do
         table%files => set
         table%is_safe = is_safe == 1
         do i = 1, n
            call put_row(table, i, heads, kinds, numbers, words)
         end do
         call set%finish(error)
      end if
      if (.not. allocated(error)) then
         bytes = set%written(size(set%written))%bytes
         checksum = set%written(size(set%written))%checksum
      end if
      call report(error, failure)
   end subroutine write_table

   !> Put a row
   subroutine put_row(table, row, names, kinds, numbers, texts)
      type(csv_table_type), intent(inout) :: table
      !> Its number
      integer, intent(in) :: row
      type(lines_type), intent(in) :: names
      !> Kinds of the columns
      integer(c_int), intent(in) :: kinds(:)
      !> Numbers (rows, columns)
      real(c_double), intent(in) :: numbers(:, :)
      !> Texts that differ
      type(lines_type), intent(in) :: texts

      integer :: i

      do i = 1, size(kinds)
         associate (name => names%line(i)%text, value => numbers(row, i))
            if (kinds(i) == text_column) then
               call table%put(name, texts%line(nint(value))%text)
            else if (kinds(i) == integer_column) then
               if (value == value) call table%put(name, nint(value))
               if (value /= value) call table%put(name, 0, .false.)
            else if (kinds(i) == degrees_column) then
               call table%put_degrees(name, value, value == value)
            else
               call table%put(name, value, value == value)
            end if
         end associate
      end do
      call table%end_row()
   end subroutine put_row

   !> Publish a set: text is what the file of its run has
   subroutine publish_set(handle, text, failure)
      !f2py threadsafe
      integer(c_int64_t), intent(in) :: handle
      character(len=*), intent(in) :: text
      integer(c_int64_t), intent(out) :: failure(5)
      type(result_files_type), pointer :: set
      type(lines_type) :: no_inputs
      type(error_type), allocatable :: error

      call find_set(handle, set, error)
      if (.not. allocated(error)) call set%begin(run_suffix, error)
      if (.not. allocated(error)) then
         call set%line(text)
         call set%finish(error)
      end if
      if (.not. allocated(error)) call set%publish(no_inputs, error)
      call report(error, failure)
   end subroutine publish_set

   !> End with a file, a lock or a set, whatever has happened, and free its handle; nothing, if that was done before
   subroutine close_files(handle)
      integer(c_int64_t), intent(in) :: handle

      call end_with(handle)
      call release(handle)
   end subroutine close_files

   !> Name of the run whose results are published; blank if there is none
   subroutine published_run(prefix, run)
      character(len=*), intent(in) :: prefix
      character(len=33), intent(out) :: run

      run = published(prefix)
   end subroutine published_run

end module files
