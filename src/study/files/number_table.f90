!> Tables of numbers alone, such as hazard curves.
module dondolo_files_number_table
   use dondolo_base_error, only : add_place, error_type, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_limits, only : most_numbers
   use dondolo_base_text, only : to_text
   use dondolo_files_csv_reader, only : csv_row_type, csv_table_type
   use dondolo_files_csv_row, only : cell_type
   implicit none
   private

   public :: read_number_table

contains

   !> Read a table of numbers
   subroutine read_number_table(file, columns, values, note, error)
      !> Path of the file
      character(len=*), intent(in) :: file
      !> Names of the columns
      type(cell_type), allocatable, intent(out) :: columns(:)
      !> Its numbers (columns, rows)
      real(wp), allocatable, intent(out) :: values(:, :)
      !> How it was read: a note, or empty
      character(len=:), allocatable, intent(out) :: note
      !> No table, a cell that is no number, or too many numbers
      type(error_type), allocatable, intent(out) :: error

      type(csv_table_type) :: table
      type(csv_row_type) :: row
      real(wp), allocatable :: more(:, :)
      integer :: i, rows
      logical :: found

      call table%read(file, error)
      if (allocated(error)) return
      call table%find_decimal_mark([(i, i=1, size(table%columns))])
      note = table%note()
      columns = table%columns
      allocate (values(size(columns), 8))
      rows = 0
      do
         call table%next(row, found, error)
         if (allocated(error) .or. .not. found) exit
         if (rows == size(values, 2)) then
            allocate (more(size(columns), 2*rows))
            more(:, :rows) = values
            call move_alloc(more, values)
         end if
         rows = rows + 1
         if (rows*size(columns) > most_numbers) then
            call raise_input(error, table%place(row)//': more than '//to_text(most_numbers)//' numbers')
            exit
         end if
         do i = 1, size(columns)
            call table%get_real(row, i, values(i, rows), error)
            call add_place(error, table%place(row))
            if (allocated(error)) exit
         end do
         if (allocated(error)) exit
      end do
      values = values(:, :rows)
   end subroutine read_number_table

end module dondolo_files_number_table
