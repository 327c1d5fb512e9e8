!> A table in the making: values are put under the names of their columns, row after row, so that head and cells cannot
!> disagree. What becomes of them is the matter of its extensions: lines of a file, or columns in memory.
module dondolo_case_table
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   implicit none
   private

   public :: table_type

   !> A table in the making
   type, abstract :: table_type
      !> Names of its columns, in the order of the first row
      type(lines_type) :: names
      !> Rows that are complete
      integer :: rows = 0
      !> Has every row had the columns of the first, in their order?
      logical :: is_regular = .true.
      !> Lack of memory; what is put from then on is lost
      type(error_type), allocatable :: error
      !> Column of the last value that was put
      integer :: column = 0
      !> Where it is written, is the text quoted in any case, is the real number written as an integer?
      logical :: is_quoted = .false., are_degrees = .false.
   contains
      !> Put the value of the next column of a row; where it is not `given` its cell is empty
      generic :: put => put_text, put_real, put_integer, put_logical
      procedure, private :: put_text, put_real, put_integer, put_logical, next_column
      !> Put a number, as a whole one where it is one
      procedure :: put_degrees
      !> The row is complete
      procedure :: end_row
      !> Take the value of the column
      procedure(take_text), deferred :: take_text
      procedure(take_real), deferred :: take_real
      procedure(take_integer), deferred :: take_integer
      !> Take a row that is complete
      procedure(take_row), deferred :: take_row
   end type table_type

   abstract interface

      !> Take a text
      subroutine take_text(self, text)
         import :: table_type
         class(table_type), intent(inout) :: self
         character(len=*), intent(in) :: text
      end subroutine take_text

      !> Take a real number
      subroutine take_real(self, value, given)
         import :: table_type, wp
         class(table_type), intent(inout) :: self
         real(wp), intent(in) :: value
         !> Is there one?
         logical, intent(in) :: given
      end subroutine take_real

      !> Take a whole number
      subroutine take_integer(self, value, given)
         import :: table_type
         class(table_type), intent(inout) :: self
         integer, intent(in) :: value
         !> Is there one?
         logical, intent(in) :: given
      end subroutine take_integer

      !> Take a row that is complete
      subroutine take_row(self)
         import :: table_type
         class(table_type), intent(inout) :: self
      end subroutine take_row

   end interface

contains

   !> Put a text
   subroutine put_text(self, name, text, given, is_quoted)
      class(table_type), intent(inout) :: self
      !> Name of the column
      character(len=*), intent(in) :: name
      character(len=*), intent(in) :: text
      !> Is there one?
      logical, intent(in), optional :: given
      !> Is it quoted in any case?
      logical, intent(in), optional :: is_quoted

      call self%next_column(name)
      self%is_quoted = .false.
      if (is_given(given)) then
         if (present(is_quoted)) self%is_quoted = is_quoted
         call self%take_text(text)
      else
         call self%take_text('')
      end if
   end subroutine put_text

   !> Put a real number
   subroutine put_real(self, name, value, given)
      class(table_type), intent(inout) :: self
      !> Name of the column
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: value
      !> Is there one?
      logical, intent(in), optional :: given

      call self%next_column(name)
      self%are_degrees = .false.
      call self%take_real(value, is_given(given))
   end subroutine put_real

   !> Put a number, as a whole one where it is one
   subroutine put_degrees(self, name, value, given)
      class(table_type), intent(inout) :: self
      !> Name of the column
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: value
      !> Is there one?
      logical, intent(in), optional :: given

      call self%next_column(name)
      self%are_degrees = .true.
      call self%take_real(value, is_given(given))
   end subroutine put_degrees

   !> Put a whole number
   subroutine put_integer(self, name, value, given)
      class(table_type), intent(inout) :: self
      !> Name of the column
      character(len=*), intent(in) :: name
      integer, intent(in) :: value
      !> Is there one?
      logical, intent(in), optional :: given

      call self%next_column(name)
      call self%take_integer(value, is_given(given))
   end subroutine put_integer

   !> Put a flag, 0 or 1
   subroutine put_logical(self, name, value, given)
      class(table_type), intent(inout) :: self
      !> Name of the column
      character(len=*), intent(in) :: name
      logical, intent(in) :: value
      !> Is there one?
      logical, intent(in), optional :: given

      call self%next_column(name)
      call self%take_integer(merge(1, 0, value), is_given(given))
   end subroutine put_logical

   !> Is a value given? It is unless something is said
   pure logical function is_given(given)
      logical, intent(in), optional :: given

      is_given = .true.
      if (present(given)) is_given = given
   end function is_given

   !> Go on to the next column, whose name the first row has given
   subroutine next_column(self, name)
      class(table_type), intent(inout) :: self
      character(len=*), intent(in) :: name

      self%column = self%column + 1
      if (self%rows == 0) then
         call self%names%add(name)
      else if (self%column > self%names%count) then
         self%is_regular = .false.
      else if (self%names%line(self%column)%text /= name) then
         self%is_regular = .false.
      end if
   end subroutine next_column

   !> The row is complete
   subroutine end_row(self)
      class(table_type), intent(inout) :: self

      if (self%column /= self%names%count) self%is_regular = .false.
      call self%take_row()
      self%rows = self%rows + 1
      self%column = 0
   end subroutine end_row

end module dondolo_case_table
