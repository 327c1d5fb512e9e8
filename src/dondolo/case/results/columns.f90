!> A table in memory, column by column: what programs that call the library get in place of a file.
module dondolo_case_columns
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use dondolo_base_kinds, only : wp
   use dondolo_base_memory, only : check_room
   use dondolo_case_table, only : table_type
   implicit none
   private

   public :: column_type, columns_type, text_column, real_column, integer_column, degrees_column

   !> What a column holds; degrees are real numbers, written as whole ones where they are whole
   integer, parameter :: text_column = 0, real_column = 1, integer_column = 2, degrees_column = 3

   !> A column
   type :: column_type
      !> text_column, real_column, integer_column or degrees_column; flags are integers, 0 or 1
      integer :: kind = text_column
      !> Numbers, those of integers too, NaN where there is none; those beyond the rows of the table are room
      real(wp), allocatable :: number(:)
      !> Texts, each ended by new_line, empty where there is none; what is beyond `length` is room
      character(len=:), allocatable :: text
      integer :: length = 0
   end type column_type

   !> A table in memory
   type, extends(table_type) :: columns_type
      !> Its columns, in the order of `names`
      type(column_type), allocatable :: columns(:)
   contains
      procedure :: take_text
      procedure :: take_real
      procedure :: take_integer
      procedure :: take_row
      procedure, private :: has_column
   end type columns_type

   !> Rows of a column at first
   integer, parameter :: first_rows = 64

contains

   !> Take a text
   subroutine take_text(self, text)
      class(columns_type), intent(inout) :: self
      character(len=*), intent(in) :: text

      character(len=:), allocatable :: more

      if (.not. self%has_column(text_column)) return
      associate (column => self%columns(self%column))
         if (column%length + len(text) + 1 > len(column%text)) then
            call check_room(2.0_wp*real(column%length + len(text) + 1, wp), self%error)
            if (allocated(self%error)) return
            allocate (character(len=2*(column%length + len(text) + 1)) :: more)
            more(:column%length) = column%text(:column%length)
            call move_alloc(more, column%text)
         end if
         column%text(column%length + 1:column%length + len(text) + 1) = text//new_line('a')
         column%length = column%length + len(text) + 1
      end associate
   end subroutine take_text

   !> Take a real number
   subroutine take_real(self, value, given)
      class(columns_type), intent(inout) :: self
      real(wp), intent(in) :: value
      !> Is there one?
      logical, intent(in) :: given

      if (.not. self%has_column(merge(degrees_column, real_column, self%are_degrees))) return
      self%columns(self%column)%number(self%rows + 1) = value
      if (.not. given) self%columns(self%column)%number(self%rows + 1) = ieee_value(value, ieee_quiet_nan)
   end subroutine take_real

   !> Take a whole number
   subroutine take_integer(self, value, given)
      class(columns_type), intent(inout) :: self
      integer, intent(in) :: value
      !> Is there one?
      logical, intent(in) :: given

      if (.not. self%has_column(integer_column)) return
      self%columns(self%column)%number(self%rows + 1) = real(value, wp)
      if (.not. given) self%columns(self%column)%number(self%rows + 1) = ieee_value(1.0_wp, ieee_quiet_nan)
   end subroutine take_integer

   !> Make room for another row
   subroutine take_row(self)
      class(columns_type), intent(inout) :: self

      real(wp), parameter :: bytes_of_number = real(storage_size(1.0_wp)/8, wp)
      real(wp), allocatable :: more(:)
      integer :: i

      if (allocated(self%error)) return
      do i = 1, size(self%columns)
         associate (column => self%columns(i))
            if (.not. allocated(column%number)) cycle
            if (self%rows + 1 < size(column%number)) cycle
            call check_room(bytes_of_number*2.0_wp*real(size(column%number), wp), self%error)
            if (allocated(self%error)) return
            allocate (more(2*size(column%number)))
            more(:size(column%number)) = column%number
            call move_alloc(more, column%number)
         end associate
      end do
   end subroutine take_row

   !> Is there a column of a kind for the next value? The first row makes its columns
   logical function has_column(self, kind)
      class(columns_type), intent(inout) :: self
      !> Kind of the value
      integer, intent(in) :: kind

      has_column = .false.
      if (allocated(self%error)) return
      if (self%rows == 0) call add_column(self%columns, kind)
      has_column = self%column <= size(self%columns)
      if (has_column) has_column = self%columns(self%column)%kind == kind
      self%is_regular = self%is_regular .and. has_column
   end function has_column

   !> Add a column
   subroutine add_column(columns, kind)
      !> The columns so far; not allocated: none
      type(column_type), allocatable, intent(inout) :: columns(:)
      !> Kind of the new one
      integer, intent(in) :: kind

      type(column_type), allocatable :: more(:)
      integer :: i

      if (.not. allocated(columns)) allocate (columns(0))
      allocate (more(size(columns) + 1))
      do i = 1, size(columns)
         more(i)%kind = columns(i)%kind
         more(i)%length = columns(i)%length
         if (allocated(columns(i)%number)) call move_alloc(columns(i)%number, more(i)%number)
         if (allocated(columns(i)%text)) call move_alloc(columns(i)%text, more(i)%text)
      end do
      call move_alloc(more, columns)
      associate (column => columns(size(columns)))
         column%kind = kind
         if (kind == text_column) then
            allocate (character(len=16*first_rows) :: column%text)
         else
            allocate (column%number(first_rows))
         end if
      end associate
   end subroutine add_column

end module dondolo_case_columns
