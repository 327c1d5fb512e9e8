!> Results on their way to Python: tables as columns, and of a case the text of the file of the run.
module dondolo_results_parcel
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_text, only : to_text
   use dondolo_boundary, only : check_room
   use dondolo_case, only : case_type
   use dondolo_case_columns, only : columns_type, text_column
   use dondolo_case_result_files, only : written_type
   use dondolo_case_result_tables, only : list_tables, table_kind_type
   use dondolo_case_results, only : results_type
   use dondolo_case_run_file, only : make_run
   use dondolo_parcel, only : parcel_type, send
   implicit none
   private

   public :: pack_results, send_table

contains

   !> The tables of a case: their names, as 'tables'; each, as pack_table has it; and the lines of the file of the run, as 'run'
   subroutine pack_results(case, results, parcel, error)
      type(case_type), intent(in), target :: case
      type(results_type), intent(inout) :: results
      !> Empty
      type(parcel_type), intent(inout) :: parcel
      !> Lack of memory, or a file that is read again has changed
      type(error_type), allocatable, intent(out) :: error

      type(table_kind_type), allocatable :: kinds(:)
      type(columns_type), allocatable :: tables(:)
      type(written_type) :: no_files(0)
      type(lines_type) :: names
      character(len=:), allocatable :: text
      integer :: i, k

      call list_tables(kinds)
      kinds = pack(kinds, [(kinds(k)%is_of(case), k=1, size(kinds))])
      allocate (tables(size(kinds)))
      do k = 1, size(kinds)
         call kinds(k)%fill(case, results, tables(k), error)
         if (allocated(error)) return
      end do
      call check_room(error, reals=sum([(real(tables(k)%rows, c_double)*tables(k)%names%count, k=1, size(tables))]))
      if (allocated(error)) return
      call parcel%expect_series(sum([(size(tables(k)%columns), k=1, size(tables))]))
      do k = 1, size(tables)
         call names%add(trim(kinds(k)%suffix))
         call pack_table(tables(k), trim(kinds(k)%suffix), parcel)
      end do
      call parcel%put('tables', names)
      call make_run(case, results, '', no_files, text)
      call parcel%put_block('run', text, 1 + count([(text(i:i) == new_line('a'), i=1, len(text))]))
   end subroutine pack_results

   !> A table under a name, its columns moved away: their names; NAME:kinds, what each holds (text_column, real_column,
   !> integer_column, degrees_column); NAME:rows, how many there are; NAME:NUMBER, texts that differ; and of each column a series
   !> of numbers, NaN where there is none, of texts which one it is, from 1
   subroutine pack_table(table, name, parcel)
      type(columns_type), intent(inout) :: table
      !> Without blanks
      character(len=*), intent(in) :: name
      !> Has room for the series
      type(parcel_type), intent(inout) :: parcel

      real(wp), allocatable :: values(:)
      integer :: i

      call parcel%put(name, table%names)
      call parcel%put(name//':kinds', int(table%columns%kind, c_int))
      call parcel%put(name//':rows', int(table%rows, c_int))
      do i = 1, size(table%columns)
         associate (column => table%columns(i))
            if (column%kind == text_column) then
               ! Each of its texts is ended, and the parcel ends the last
               call parcel%put_block(name//':'//to_text(i), column%text(:column%length - 1), column%words)
               deallocate (column%text)
            end if
            values = column%number(:table%rows)
            deallocate (column%number)
            call parcel%move_series(values)
         end associate
      end do
   end subroutine pack_table

   !> Send a table, as 'table'
   subroutine send_table(table, error, sent, warnings)
      type(columns_type), intent(inout) :: table
      !> Lack of memory: may be that of the table
      type(error_type), allocatable, intent(inout) :: error
      integer(c_int64_t), intent(out) :: sent(5)
      !> Warnings that come with it, an object each, as 'warnings'
      type(lines_type), intent(in), optional :: warnings

      type(parcel_type) :: parcel

      if (.not. allocated(error) .and. allocated(table%error)) call move_alloc(table%error, error)
      if (.not. allocated(error)) then
         call parcel%expect_series(size(table%columns))
         call pack_table(table, 'table', parcel)
         if (present(warnings)) call parcel%put('warnings', warnings)
      end if
      call send(parcel, error, sent)
   end subroutine send_table

end module dondolo_results_parcel
