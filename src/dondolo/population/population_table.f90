!> The table of a population: its columns, and the cells of its rows.
!>
!> A cell that is empty was not given. A list has a column for each of its values.
module dondolo_population_table
   use dondolo_csv_reader, only : csv_reader_type
   use dondolo_error, only : error_type, problems_type, raise_input
   use dondolo_kinds, only : wp
   use dondolo_member, only : member_properties
   use dondolo_odd_character, only : odd_character
   use dondolo_property, only : find_item, find_property, is_list, is_many, is_text, is_words, item_name, property_type
   use dondolo_settings, only : settings_type
   use dondolo_spelling, only : say_allowed
   use dondolo_text, only : lower
   use dondolo_wall_properties, only : wall_input_type, wall_properties
   implicit none
   private

   public :: population_table_type

   !> A table and its columns
   type :: population_table_type
      !> The table
      type(csv_reader_type) :: table
      !> Its columns of the properties of walls and of members; 0 where it has none
      integer :: wall_columns(size(wall_properties)) = 0, member_columns(size(member_properties)) = 0
      !> Columns of values of lists: place of each list among the properties of walls, number of the value and column, and
      !> in the order of the values of each list
      integer, allocatable :: items(:, :)
   contains
      !> Open the table and find its columns
      procedure :: open_table
      !> Has the row something in a column?
      procedure :: is_given
      !> Read the cells of a row that give properties
      procedure :: read_cells
      !> Read the cells of a row that give values of lists
      procedure :: read_lists
   end type population_table_type

contains

   !> Open the table and find its columns
   subroutine open_table(self, file, error)
      class(population_table_type), intent(inout) :: self
      !> Its path
      character(len=*), intent(in) :: file
      !> No table, or a column that does not exist, or one that is missing
      type(error_type), allocatable, intent(out) :: error

      ! Properties of walls as columns: of a list its first value. An array, for gfortran 12 takes a wrong length for a text
      ! whose length follows from the result of a function.
      character(len=len(item_name(wall_properties(1)%name, 1))) :: shown(size(wall_properties))
      character(len=len(shown)) :: of_members(size(member_properties))
      character(len=:), allocatable :: allowed
      integer :: i, at, item, last

      do i = 1, size(shown)
         shown(i) = wall_properties(i)%name
         if (is_many(wall_properties(i)%kind)) shown(i) = item_name(trim(wall_properties(i)%name), 1)
      end do
      of_members = member_properties%name
      call self%table%open(file, error)
      if (allocated(error)) return
      self%items = reshape([integer ::], [3, 0])
      do i = 1, size(self%table%columns)
         associate (column => self%table%columns(i)%text)
            call find_item(wall_properties, lower(column), at, item)
            if (at > 0) self%items = reshape([self%items, at, item, i], [3, size(self%items, 2) + 1])
            if (at > 0 .or. any(lower(column) == shown) .or. any(lower(column) == of_members)) cycle
            ! A unit in brackets is no part of a name
            last = scan(column, '([') - 1
            if (last < 0) last = len(column)
            call say_allowed(lower(trim(column(:last))), [shown, of_members], '--template typology', allowed)
            if (len_trim(odd_character(column)) > 0) allowed = '; it has '//trim(odd_character(column))
            call raise_input(error, file//': column '''//column//''': no such column'//allowed)
         end associate
         call self%table%close()
         return
      end do
      call sort_items(self%items)
      self%wall_columns = [(self%table%column(trim(wall_properties(i)%name)), i=1, size(wall_properties))]
      self%member_columns = [(self%table%column(trim(member_properties(i)%name)), i=1, size(member_properties))]
      call find_missing(self, file, error)
      if (allocated(error)) then
         call self%table%close()
         return
      end if
      call self%table%find_decimal_mark([pack(self%wall_columns, wall_properties%kind /= is_text), &
         & pack(self%member_columns, member_properties%kind /= is_text), &
         & pack(self%items(3, :), wall_properties(self%items(1, :))%kind == is_list)], error)
   end subroutine open_table

   !> Find a column that every wall needs and the table does not have: said once, not of each row
   subroutine find_missing(self, file, error)
      !> The table, its columns known
      class(population_table_type), intent(in) :: self
      !> Its path
      character(len=*), intent(in) :: file
      !> There is one
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      do i = 1, size(wall_properties)
         associate (property => wall_properties(i))
            if (.not. property%required .or. self%wall_columns(i) > 0) cycle
            if (len_trim(property%instead) > 0) then
               if (any(self%items(1, :) == find_property(wall_properties, trim(property%instead)))) cycle
            end if
            call raise_input(error, file//': column '''//trim(property%name)//''': must be given')
            return
         end associate
      end do
   end subroutine find_missing

   !> Put columns of lists in the order of the lists and of the values of each, by insertion: they are few
   pure subroutine sort_items(items)
      !> Place of the list, number of the value and column of each
      integer, intent(inout) :: items(:, :)

      integer :: i, k, item(3)

      do i = 2, size(items, 2)
         item = items(:, i)
         do k = i - 1, 1, -1
            if (items(1, k) < item(1) .or. (items(1, k) == item(1) .and. items(2, k) < item(2))) exit
            items(:, k + 1) = items(:, k)
         end do
         items(:, k + 1) = item
      end do
   end subroutine sort_items

   !> Has the row something in a column? Blanks alone are nothing
   logical function is_given(self, column)
      !> The table, at a row
      class(population_table_type), intent(in) :: self
      !> Its number, or 0
      integer, intent(in) :: column

      is_given = len_trim(self%table%get_text(column)) > 0
   end function is_given

   !> Read the cells of a row that give properties
   subroutine read_cells(self, columns, settings, problems)
      !> The table, at a row
      class(population_table_type), intent(in) :: self
      !> Columns of the properties
      integer, intent(in) :: columns(:)
      !> What is said in the row
      class(settings_type), intent(inout) :: settings
      !> Takes every cell that should be a number and is none
      type(problems_type), intent(inout) :: problems

      type(property_type), pointer :: table(:)
      type(error_type), allocatable :: error
      real(wp) :: number
      integer :: i

      call settings%get_table(table)
      do i = 1, size(table)
         if (.not. self%is_given(columns(i))) cycle
         if (table(i)%kind == is_text) then
            call settings%set(table(i)%name, self%table%get_text(columns(i)))
            cycle
         end if
         call self%table%get_real(columns(i), number, error)
         if (.not. allocated(error)) call settings%set(table(i)%name, number)
         call problems%take(error)
      end do
   end subroutine read_cells

   !> Read the cells of a row that give values of lists; a list ends at the first cell that is empty
   subroutine read_lists(self, input, problems)
      !> The table, at a row
      class(population_table_type), intent(in) :: self
      !> What is said of the wall
      type(wall_input_type), intent(inout) :: input
      !> Takes every cell that should be a number and is none, or that stands behind an empty one
      type(problems_type), intent(inout) :: problems

      type(error_type), allocatable :: error
      real(wp), allocatable :: values(:)
      character(len=:), allocatable :: cell, words
      real(wp) :: number
      integer :: i, count

      count = 0
      words = ''
      do i = 1, size(self%items, 2)
         associate (property => wall_properties(self%items(1, i)), item => self%items(2, i))
            if (i > 1) then
               if (self%items(1, i) /= self%items(1, i - 1)) count = 0
            end if
            if (count == 0) values = [real(wp) ::]
            if (count == 0) words = ''
            cell = trim(self%table%get_text(self%items(3, i)))
            if (len(cell) == 0) cycle
            if (item /= count + 1) then
               call problems%note(trim(item_name(trim(property%name), item))//': only behind '// &
                  & trim(item_name(trim(property%name), count + 1)))
               cycle
            end if
            count = item
            if (property%kind == is_words) then
               if (item > 1) words = words//','
               words = words//cell
               call input%set(property%name, words)
               cycle
            end if
            call self%table%get_real(self%items(3, i), number, error)
            call problems%take(error)
            values = [values, number]
            call input%set(property%name, values)
         end associate
      end do
   end subroutine read_lists

end module dondolo_population_table
