!> What the rows of a population are taken from: a CSV table with one row a mechanism of a wall, its columns those of &wall,
!> and those of row_properties; or one facade or wall with variants, as &wall says it.
!>
!> A cell that is empty was not given. A list has a column for each of its values. The text of the table stays in memory.
module dondolo_population_table
   use dondolo_base_error, only : error_type, not_a_string, not_given, not_together, problems_type, raise_input, unknown_name
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_odd_character, only : odd_character
   use dondolo_base_plain, only : name_problem, shown
   use dondolo_base_property, only : choices_length, find_item, find_property, is_list, is_many, is_text, is_words, item_name, &
      & number_of_words, property_type, word_of
   use dondolo_base_settings, only : settings_type
   use dondolo_base_spelling, only : meant, say_allowed
   use dondolo_base_text, only : lower
   use dondolo_files_csv_reader, only : csv_row_type, csv_table_type
   use dondolo_population_occurrence, only : independent, occurrence_names
   use dondolo_population_variants, only : base_wall_type
   use dondolo_population_wall_row, only : is_note, note_prefixes, row_properties
   use dondolo_wall_properties, only : wall_input_type, wall_properties
   implicit none
   private

   public :: population_table_type

   !> A table and its columns, or the wall that takes its place
   type :: population_table_type
      !> Path of what is read, for messages
      character(len=:), allocatable :: file
      !> Gravity [m/s2]; not allocated: standard
      real(wp), allocatable :: gravity
      !> How the mechanisms of a wall occur whose row does not say it
      character(len=choices_length) :: occurrence = occurrence_names(independent)
      !> The wall of whose hinges or variants the rows are made; not allocated: there is a table
      type(base_wall_type), allocatable :: base_wall
      !> The table
      type(csv_table_type) :: csv
      !> Its columns of the properties of walls and of rows; 0 where it has none
      integer :: wall_columns(size(wall_properties)) = 0, row_columns(size(row_properties)) = 0
      !> Columns of values of lists: place of each list among the properties of walls, number of the value and column, and
      !> in the order of the values of each list
      integer, allocatable :: items(:, :)
      !> Names of the columns that are kept as they stand, and which ones they are
      type(lines_type) :: notes
      integer, allocatable :: note_columns(:)
   contains
      !> Read the table and find its columns
      procedure :: read => read_table
      !> Can a row become several?
      procedure :: has_hinges
      !> Has the row something in a column?
      procedure :: is_given
      !> Read the cells of a row that give properties
      procedure :: read_cells
      !> Read the cells of a row that give values of lists
      procedure :: read_lists
      !> Read the cells of a row that are kept as they stand
      procedure :: read_notes
   end type population_table_type

contains

   !> Read the table and find its columns
   subroutine read_table(self, file, error, gravity)
      class(population_table_type), intent(inout) :: self
      !> Its path
      character(len=*), intent(in) :: file
      !> No table, or columns that do not exist, or that are missing
      type(error_type), allocatable, intent(out) :: error
      !> Gravity [m/s2], standard if absent
      real(wp), intent(in), optional :: gravity

      ! Properties of walls as columns: of a list its first value. An array, for gfortran 12 takes a wrong length for a text
      ! whose length follows from the result of a function.
      character(len=len(item_name(wall_properties(1)%name, 1))) :: shown(size(wall_properties))
      character(len=len(shown)) :: of_rows(size(row_properties))
      type(problems_type) :: problems
      character(len=:), allocatable :: allowed
      integer :: i, at, item, last

      do i = 1, size(shown)
         shown(i) = wall_properties(i)%name
         if (is_many(wall_properties(i)%kind)) shown(i) = item_name(trim(wall_properties(i)%name), 1)
      end do
      of_rows = row_properties%name
      self%file = file
      if (present(gravity)) self%gravity = gravity
      call self%csv%read(file, error)
      if (allocated(error)) return
      self%items = reshape([integer ::], [3, 0])
      self%notes = lines_type()
      self%note_columns = [integer ::]
      do i = 1, size(self%csv%columns)
         associate (column => self%csv%columns(i)%text)
            call find_item(wall_properties, lower(column), at, item)
            if (at > 0) self%items = reshape([self%items, at, item, i], [3, size(self%items, 2) + 1])
            if (at > 0 .or. any(lower(column) == shown) .or. any(lower(column) == of_rows)) cycle
            if (is_note(column) .and. len_trim(name_problem(column)) == 0) then
               call self%notes%add(column)
               self%note_columns = [self%note_columns, i]
               cycle
            end if
            ! A unit in brackets is no part of a name
            last = scan(column, '([') - 1
            if (last < 0) last = len(column)
            allowed = trim(meant(lower(trim(column(:last))), [shown, of_rows]))
            if (problems%count == 0) then
               call say_allowed(lower(trim(column(:last))), [shown, of_rows], '--template typology', allowed)
               allowed = allowed//'; one that is only kept begins with '//trim(note_prefixes(1))//' or '//trim(note_prefixes(2))
            end if
            if (len_trim(odd_character(column)) > 0) allowed = '; it has '//trim(odd_character(column))
            call raise_input(error, file//': column '''//column//''': no such column'//allowed, unknown_name, column, file)
            call problems%take(error)
         end associate
      end do
      call problems%raise(error)
      if (allocated(error)) return
      call sort_items(self%items)
      ! The values of lists have numbers at the ends of their names; without one 'weight' is that of the row
      self%wall_columns = [(merge(0, self%csv%column(trim(wall_properties(i)%name)), is_many(wall_properties(i)%kind)), &
         & i=1, size(wall_properties))]
      self%row_columns = [(self%csv%column(trim(row_properties(i)%name)), i=1, size(row_properties))]
      call find_missing(self, file, error)
      if (.not. allocated(error)) call self%csv%find_decimal_mark([pack(self%wall_columns, wall_properties%kind /= is_text), &
         & pack(self%row_columns, row_properties%kind /= is_text), &
         & pack(self%items(3, :), wall_properties(self%items(1, :))%kind == is_list)])
   end subroutine read_table

   !> Find columns that every wall needs and the table does not have: said once, not of each row
   subroutine find_missing(self, file, error)
      !> The table, its columns known
      class(population_table_type), intent(in) :: self
      !> Its path
      character(len=*), intent(in) :: file
      !> There are some
      type(error_type), allocatable, intent(out) :: error

      type(problems_type) :: problems
      integer :: i, k
      logical :: has_terms

      has_terms = self%wall_columns(find_property(wall_properties, 'table')) > 0 &
         & .or. self%wall_columns(find_property(wall_properties, 'bodies')) > 0 &
         & .or. any(self%items(1, :) == find_property(wall_properties, 'body_table')) &
         & .or. any(self%items(1, :) == find_property(wall_properties, 'rotation'))
      do i = 1, size(wall_properties)
         associate (property => wall_properties(i))
            if (.not. property%required .or. self%wall_columns(i) > 0) cycle
            ! A wall whose terms are given has no blocks: what these must have is asked of their rows.
            if (has_terms .and. len_trim(property%owners(1)) > 0) cycle
            if (any([(any(self%items(1, :) == find_property(wall_properties, trim(word_of(property%instead, k)))), k=1, &
               & number_of_words(property%instead))])) cycle
            call raise_input(error, file//': column '''//trim(property%name)//''': must be given', not_given, trim(property%name), &
               & file)
            call problems%take(error)
         end associate
      end do
      call problems%raise(error)
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

   !> Can a row become several, for each of its hinges?
   pure logical function has_hinges(self)
      class(population_table_type), intent(in) :: self

      has_hinges = allocated(self%base_wall)
      if (.not. has_hinges) has_hinges = self%wall_columns(find_property(wall_properties, 'hinge_at')) > 0 &
         & .or. any(self%items(1, :) == find_property(wall_properties, 'hinge_level'))
   end function has_hinges

   !> Has a row something in a column? Blanks alone are nothing
   logical function is_given(self, row, column)
      class(population_table_type), intent(in) :: self
      type(csv_row_type), intent(in) :: row
      !> Its number, or 0
      integer, intent(in) :: column

      is_given = len_trim(row%get_text(column)) > 0
   end function is_given

   !> Read the cells of a row that give properties
   subroutine read_cells(self, row, columns, settings, problems)
      class(population_table_type), intent(in) :: self
      type(csv_row_type), intent(in) :: row
      !> Columns of the properties
      integer, intent(in) :: columns(:)
      !> Contents of the row
      class(settings_type), intent(inout) :: settings
      !> Takes every cell that should be a number and is none
      type(problems_type), intent(inout) :: problems

      type(property_type), pointer :: table(:)
      type(error_type), allocatable :: error
      real(wp) :: number
      integer :: i

      call settings%get_table(table)
      do i = 1, size(table)
         if (.not. self%is_given(row, columns(i))) cycle
         if (table(i)%kind == is_text) then
            call settings%set(table(i)%name, row%get_text(columns(i)))
            cycle
         end if
         call self%csv%get_real(row, columns(i), number, error)
         if (.not. allocated(error)) call settings%set(table(i)%name, number)
         call problems%take(error)
      end do
   end subroutine read_cells

   !> Read the cells of a row that give values of lists; a list ends at the first cell that is empty
   subroutine read_lists(self, row, input, problems)
      class(population_table_type), intent(in) :: self
      type(csv_row_type), intent(in) :: row
      !> Input of the wall
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
            cell = trim(row%get_text(self%items(3, i)))
            if (len(cell) == 0) cycle
            if (item /= count + 1) then
               call problems%note(trim(item_name(trim(property%name), item))//': only behind '// &
                  & trim(item_name(trim(property%name), count + 1)), not_together, trim(item_name(trim(property%name), item)))
               cycle
            end if
            count = item
            if (property%kind == is_words) then
               if (item > 1) words = words//','
               words = words//cell
               call input%set(property%name, words)
               cycle
            end if
            call self%csv%get_real(row, self%items(3, i), number, error)
            call problems%take(error)
            values = [values, number]
            call input%set(property%name, values)
         end associate
      end do
   end subroutine read_lists

   !> Read the cells of a row that are kept as they stand
   subroutine read_notes(self, row, notes, problems)
      class(population_table_type), intent(in) :: self
      type(csv_row_type), intent(in) :: row
      !> Their texts, in the order of the columns
      type(lines_type), intent(out) :: notes
      !> Takes every text that is not one line
      type(problems_type), intent(inout) :: problems

      integer :: i

      do i = 1, self%notes%count
         call notes%add(trim(row%get_text(self%note_columns(i))))
         associate (name => self%notes%line(i)%text, text => notes%line(i)%text)
            if (len_trim(name_problem(text)) > 0) call problems%note(name//' = '''//shown(text)//''': '// &
               & trim(name_problem(text)), not_a_string, name)
         end associate
      end do
   end subroutine read_notes

end module dondolo_population_table
