!> Results of a case, on their way to Python: the tables of its files as columns, and the text of the file of the run.
module dondolo_results_parcel
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_boundary, only : check_room
   use dondolo_case, only : case_type
   use dondolo_case_columns, only : columns_type, text_column
   use dondolo_case_result_files, only : written_type
   use dondolo_case_result_tables, only : list_tables, table_kind_type
   use dondolo_case_results, only : results_type
   use dondolo_case_run_file, only : make_run
   use dondolo_parcel, only : parcel_type
   implicit none
   private

   public :: pack_results

contains

   !> The tables of a case. Integers: their number; of each its columns, its rows, and what each column holds (text_column,
   !> real_column, integer_column). Lines: of each what the name of its file ends with, names of its columns, and of each
   !> column of texts its rows; then the lines of the file of the run. Series: columns of numbers, NaN where there is none
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
      call parcel%expect_series(sum([(count(tables(k)%columns%kind /= text_column), k=1, size(tables))]))
      call parcel%add([int(size(tables), c_int)])
      do k = 1, size(tables)
         call parcel%add(int([tables(k)%names%count, tables(k)%rows, tables(k)%columns%kind], c_int))
         call parcel%lines%add(trim(kinds(k)%suffix))
         do i = 1, tables(k)%names%count
            call parcel%lines%add(tables(k)%names%line(i)%text)
         end do
         call pack_columns(tables(k), parcel)
      end do
      call make_run(case, results, '', no_files, text)
      call parcel%lines%add(text)
   end subroutine pack_results

   !> The columns of a table, which are moved away
   subroutine pack_columns(table, parcel)
      type(columns_type), intent(inout) :: table
      type(parcel_type), intent(inout) :: parcel

      real(wp), allocatable :: values(:)
      integer :: i

      do i = 1, size(table%columns)
         associate (column => table%columns(i))
            if (column%kind == text_column) then
               ! Its texts, each ended but the last, which the parcel ends
               call parcel%lines%add(column%text(:column%length - 1))
               deallocate (column%text)
            else
               values = column%number(:table%rows)
               deallocate (column%number)
               call parcel%move_series(values)
            end if
         end associate
      end do
   end subroutine pack_columns

end module dondolo_results_parcel
