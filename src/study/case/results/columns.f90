!> A table in memory, column by column: what programs that call the library get in place of a file.
module dondolo_case_columns
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_memory, only : check_room, raise_shortage
   use dondolo_case_table, only : table_type
   use dondolo_files_name_index, only : name_index_type
   implicit none
   private

   public :: column_type, columns_type, text_column, real_column, integer_column, degrees_column

   !> What a column holds; degrees are real numbers, written as whole ones where they are whole
   integer, parameter :: text_column = 0, real_column = 1, integer_column = 2, degrees_column = 3

   !> A column
   type :: column_type
      !> text_column, real_column, integer_column or degrees_column; flags are integers, 0 or 1
      integer :: kind = text_column
      !> Numbers, those of integers too, NaN where there is none, and of a column of texts which one it is, from 1; those beyond
      !> the rows of the table are room
      real(wp), allocatable :: number(:)
      !> Texts that differ, each ended by new_line; what is beyond `length` is room
      character(len=:), allocatable :: text
      integer(int64) :: length = 0
      !> How many there are, the last character of each, and where they are found; ends beyond `words` are room
      integer :: words = 0
      integer(int64), allocatable, private :: last(:)
      type(name_index_type), private :: index
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

      integer :: known

      if (.not. self%has_column(text_column)) return
      associate (column => self%columns(self%column))
         ! Rows of one wall follow each other.
         known = 0
         if (self%rows > 0) known = nint(column%number(self%rows))
         if (.not. is_word(column, known, text)) call column%index%note(text, column%words + 1, known)
         ! The index takes texts with the same fingerprint, or that differ in blanks at their ends, for one.
         if (.not. is_word(column, known, text)) then
            call add_word(column, text, self%error)
            if (allocated(self%error)) return
            known = column%words
         end if
         column%number(self%rows + 1) = real(known, wp)
      end associate
   end subroutine take_text

   !> Is a text one of those of a column?
   pure logical function is_word(column, number, text)
      type(column_type), intent(in) :: column
      !> Its number, or 0
      integer, intent(in) :: number
      character(len=*), intent(in) :: text

      integer(int64) :: first

      is_word = number > 0
      if (.not. is_word) return
      first = 1
      if (number > 1) first = column%last(number - 1) + 2
      is_word = column%last(number) - first + 1 == len(text, int64)
      if (is_word) is_word = column%text(first:column%last(number)) == text
   end function is_word

   !> Add a text to those of a column
   subroutine add_word(column, text, error)
      type(column_type), intent(inout) :: column
      character(len=*), intent(in) :: text
      !> Lack of memory
      type(error_type), allocatable, intent(inout) :: error

      character(len=:), allocatable :: more
      integer(int64), allocatable :: ends(:)
      integer(int64) :: length, room
      integer :: stat

      length = column%length + len(text, int64) + 1
      stat = 0
      if (length > len(column%text, int64)) then
         room = 2*length
         call check_room(real(room, wp), error)
         if (allocated(error)) return
         allocate (character(len=room) :: more, stat=stat)
         if (stat == 0) then
            more(:column%length) = column%text(:column%length)
            call move_alloc(more, column%text)
         end if
      end if
      if (stat == 0 .and. column%words == size(column%last)) then
         room = 2_int64*storage_size(ends)/8*column%words
         allocate (ends(2_int64*column%words), stat=stat)
         if (stat == 0) then
            ends(:column%words) = column%last
            call move_alloc(ends, column%last)
         end if
      end if
      if (stat /= 0) then
         call raise_shortage(real(room, wp), error)
         return
      end if
      column%text(column%length + 1:length) = text//new_line('a')
      column%length = length
      column%words = column%words + 1
      column%last(column%words) = length - 1
   end subroutine add_word

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
      integer(int64) :: room
      integer :: i, stat

      if (allocated(self%error)) return
      do i = 1, size(self%columns)
         associate (column => self%columns(i))
            room = size(column%number, kind=int64)
            if (self%rows + 1 < room) cycle
            call check_room(bytes_of_number*2.0_wp*real(room, wp), self%error)
            if (allocated(self%error)) return
            allocate (more(2*room), stat=stat)
            if (stat /= 0) then
               call raise_shortage(bytes_of_number*2.0_wp*real(room, wp), self%error)
               return
            end if
            more(:room) = column%number
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

      if (.not. allocated(columns)) allocate (columns(0))
      allocate (more(size(columns) + 1))
      more(:size(columns)) = columns
      call move_alloc(more, columns)
      associate (column => columns(size(columns)))
         column%kind = kind
         allocate (column%number(first_rows))
         if (kind == text_column) allocate (character(len=16*first_rows) :: column%text)
         if (kind == text_column) allocate (column%last(first_rows))
      end associate
   end subroutine add_column

end module dondolo_case_columns
