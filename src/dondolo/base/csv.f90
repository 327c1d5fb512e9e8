!> Tables in CSV files as a whole; dondolo_csv_reader says how they are written.
module dondolo_csv
   use dondolo_csv_reader, only : cell_type, column_named, csv_reader_type, number_of
   use dondolo_error, only : add_place, error_type
   use dondolo_kinds, only : wp
   use dondolo_text, only : to_text
   implicit none
   private

   public :: csv_table_type, read_csv

   !> A table
   type :: csv_table_type
      !> Path of the file
      character(len=:), allocatable :: file
      !> Names of the columns
      type(cell_type), allocatable :: columns(:)
      !> Cells, cells(column, row)
      type(cell_type), allocatable :: cells(:, :)
      !> Line of the file in which each row begins
      integer, allocatable :: line(:)
   contains
      !> Number of rows
      procedure :: rows
      !> Number of a column from its name
      procedure :: column
      !> Where a row is, for messages
      procedure :: place
      !> A cell as text
      procedure :: get_text
      !> A cell as a number
      procedure :: get_real
   end type csv_table_type

contains

   !> Read a table
   subroutine read_csv(file, table, error)
      !> Path of the file
      character(len=*), intent(in) :: file
      !> The table
      type(csv_table_type), intent(out) :: table
      !> The file is missing or not a table
      type(error_type), allocatable, intent(out) :: error

      type(csv_reader_type) :: reader
      logical :: found

      table%file = file
      call reader%open(file, error)
      if (allocated(error)) return
      table%columns = reader%columns
      allocate (table%line(0), table%cells(size(table%columns), 0))
      do
         call reader%next(found, error)
         if (.not. found .or. allocated(error)) exit
         call add_row(table, reader)
      end do
      call reader%close()
      table%cells = table%cells(:, :table%rows())
   end subroutine read_csv

   !> Add a row to a table
   subroutine add_row(table, reader)
      !> The table
      type(csv_table_type), intent(inout) :: table
      !> The reader, a row of which was read; it is moved away
      type(csv_reader_type), intent(inout) :: reader

      type(cell_type), allocatable :: more(:, :)
      integer :: i, j

      if (table%rows() == size(table%cells, 2)) then
         allocate (more(size(table%columns), max(16, 2*table%rows())))
         do j = 1, table%rows()
            do i = 1, size(table%columns)
               call move_alloc(table%cells(i, j)%text, more(i, j)%text)
            end do
         end do
         call move_alloc(more, table%cells)
      end if
      table%line = [table%line, reader%line]
      do i = 1, size(table%columns)
         call move_alloc(reader%cells(i)%text, table%cells(i, table%rows())%text)
      end do
   end subroutine add_row

   !> Number of rows
   pure function rows(self)
      !> Table
      class(csv_table_type), intent(in) :: self
      !> Number of rows, without the header
      integer :: rows

      rows = size(self%line)
   end function rows

   !> Number of a column from its name
   pure function column(self, name)
      !> Table
      class(csv_table_type), intent(in) :: self
      !> Name, in upper or lower case
      character(len=*), intent(in) :: name
      !> Number of the column, 0 if there is none
      integer :: column

      column = column_named(self%columns, name)
   end function column

   !> Where a row is, for messages
   pure function place(self, row)
      !> Table
      class(csv_table_type), intent(in) :: self
      !> Number of the row
      integer, intent(in) :: row
      !> 'file: line 7'
      character(len=:), allocatable :: place

      place = self%file//': line '//to_text(self%line(row))
   end function place

   !> A cell as text
   pure function get_text(self, row, column) result(text)
      !> Table
      class(csv_table_type), intent(in) :: self
      !> Number of the row
      integer, intent(in) :: row
      !> Number of the column; 0 gives an empty text
      integer, intent(in) :: column
      !> Text of the cell
      character(len=:), allocatable :: text

      text = ''
      if (column > 0) text = self%cells(column, row)%text
   end function get_text

   !> A cell as a number
   subroutine get_real(self, row, column, value, error)
      !> Table
      class(csv_table_type), intent(in) :: self
      !> Number of the row
      integer, intent(in) :: row
      !> Number of the column
      integer, intent(in) :: column
      !> Number in the cell
      real(wp), intent(out) :: value
      !> The cell is not one finite decimal number
      type(error_type), allocatable, intent(out) :: error

      call number_of(self%cells(column, row)%text, self%columns(column)%text, value, error)
      call add_place(error, self%place(row))
   end subroutine get_real

end module dondolo_csv
