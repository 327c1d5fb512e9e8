!> A table as lines of a result file.
module dondolo_case_csv_table
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_table, to_text
   use dondolo_case_result_files, only : result_files_type
   use dondolo_case_table, only : table_type
   use dondolo_files_csv_row, only : text_cell
   implicit none
   private

   public :: csv_table_type

   !> A table that goes into a file
   type, extends(table_type) :: csv_table_type
      !> The files, one of which was begun
      type(result_files_type), pointer :: files => null()
      !> Are texts to be no formulas in a spreadsheet?
      logical :: is_safe = .false.
      !> Cells of the row so far, with commas between them, and their length
      character(len=:), allocatable, private :: cells
      integer, private :: length = 0
   contains
      procedure :: take_text
      procedure :: take_real
      procedure :: take_integer
      procedure :: take_row
      procedure, private :: append
   end type csv_table_type

contains

   !> Take a text
   subroutine take_text(self, text)
      class(csv_table_type), intent(inout) :: self
      character(len=*), intent(in) :: text

      if (self%is_quoted) then
         call self%append('"'//text//'"')
      else
         call self%append(text_cell(text, self%is_safe))
      end if
   end subroutine take_text

   !> Take a real number
   subroutine take_real(self, value, given)
      class(csv_table_type), intent(inout) :: self
      real(wp), intent(in) :: value
      !> Is there one?
      logical, intent(in) :: given

      if (.not. given) then
         call self%append('')
      else if (self%are_degrees .and. value == anint(value)) then
         call self%append(to_text(nint(value)))
      else
         call self%append(to_table(value))
      end if
   end subroutine take_real

   !> Take a whole number
   subroutine take_integer(self, value, given)
      class(csv_table_type), intent(inout) :: self
      integer, intent(in) :: value
      !> Is there one?
      logical, intent(in) :: given

      if (given) then
         call self%append(to_text(value))
      else
         call self%append('')
      end if
   end subroutine take_integer

   !> Write a row, below the names of the columns
   subroutine take_row(self)
      class(csv_table_type), intent(inout) :: self

      character(len=:), allocatable :: head
      integer :: i

      if (self%rows == 0) then
         head = text_cell(self%names%line(1)%text, self%is_safe)
         do i = 2, self%names%count
            head = head//','//text_cell(self%names%line(i)%text, self%is_safe)
         end do
         call self%files%line(head)
      end if
      call self%files%line(self%cells(:self%length))
      self%length = 0
   end subroutine take_row

   !> Append a cell
   subroutine append(self, cell)
      class(csv_table_type), intent(inout) :: self
      character(len=*), intent(in) :: cell

      character(len=:), allocatable :: more

      if (.not. allocated(self%cells)) allocate (character(len=512) :: self%cells)
      if (self%length + 1 + len(cell) > len(self%cells)) then
         allocate (character(len=2*(self%length + 1 + len(cell))) :: more)
         more(:self%length) = self%cells(:self%length)
         call move_alloc(more, self%cells)
      end if
      if (self%column > 1) then
         self%length = self%length + 1
         self%cells(self%length:self%length) = ','
      end if
      self%cells(self%length + 1:self%length + len(cell)) = cell
      self%length = self%length + len(cell)
   end subroutine append

end module dondolo_case_csv_table
