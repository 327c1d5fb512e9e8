!> A population of walls: a CSV table with one row a mechanism of a wall, its columns those of &wall, and weight, group,
!> p_occ and facade; or one facade alone, as &wall says it.
!>
!> A cell that is empty was not given. A wall without a name is called 'wall' with the number of its row. Rows with the
!> same name are mechanisms of the same wall, rows of the same facade those of the facade; they stand one after the other.
!> A row with hinge levels becomes a row for each: the walls 'NAME at Z m' of the facade NAME. Rows are read one by one, so
!> that a table may be longer than the memory.
module dondolo_population
   use dondolo_csv_reader, only : csv_reader_type
   use dondolo_error, only : add_place, error_type, problems_type, raise_input
   use dondolo_hinge_level, only : find_hinge_levels, has_hinge_level
   use dondolo_kinds, only : wp
   use dondolo_limits, only : most_walls
   use dondolo_memory, only : check_room, raise_shortage
   use dondolo_name_index, only : name_index_type
   use dondolo_property, only : find_item, find_property, is_list, is_many, is_text, is_words, item_name, property_type
   use dondolo_settings, only : group_settings_type, new_settings, settings_type
   use dondolo_spelling, only : meant
   use dondolo_text, only : join, lower, to_text
   use dondolo_variants, only : stated_wall_type
   use dondolo_wall, only : new_wall, wall_type
   use dondolo_wall_properties, only : wall_input_type, wall_properties
   implicit none
   private

   public :: member_type, population_reader_type, read_population
   public :: member_properties

   !> Columns besides the properties of a wall
   type(property_type), target, protected :: member_properties(4) = [ &
      & property_type('weight', default=1.0_wp, smallest=0.0_wp, largest=1.0e12_wp, &
      &   meaning='weight of the wall in its population, such as the number of walls like it'), &
      & property_type('group', is_text, meaning='group of the wall, which gets curves of its own'), &
      & property_type('p_occ', default=1.0_wp, smallest=0.0_wp, largest=1.0_wp, &
      &   meaning='probability that the mechanism can occur'), &
      & property_type('facade', is_text, meaning='facade that the wall is part of: its walls, on consecutive rows, collapse '// &
      &   'in series')]

   !> Memory that a row takes where all are kept, and what the index of names takes for it while it grows [bytes]
   real(wp), parameter :: bytes_of_row = 4000.0_wp, bytes_of_name = 72.0_wp

   !> A row: one mechanism of a wall
   type :: member_type
      !> The wall with this mechanism
      type(wall_type) :: wall
      !> Weight of the wall, >= 0
      real(wp) :: weight = 1.0_wp
      !> Probability that the mechanism can occur
      real(wp) :: p_occ = 1.0_wp
      !> Group of the wall, empty if none was given
      character(len=:), allocatable :: group
      !> Facade that the wall is part of, empty if none
      character(len=:), allocatable :: facade
      !> Is it a further mechanism of the wall, or of the facade, in the row before?
      logical :: continues = .false.
      !> Was its name given? A wall without one has one row
      logical :: has_name = .false.
   end type member_type

   !> A population that is being read
   type :: population_reader_type
      !> Number of the row that was read last
      integer :: row = 0
      !> The table
      type(csv_reader_type) :: table
      !> Its columns of the properties of walls and of members; 0 where it has none
      integer :: wall_columns(size(wall_properties)) = 0, member_columns(size(member_properties)) = 0
      !> Gravity [m/s2]
      real(wp), allocatable :: gravity
      !> Are names looked up, to find those that stand twice, and is a weight asked for? A table that was read before
      !> needs it no more
      logical :: is_checked = .true.
      !> Are all rows so far right, and has one of them a weight?
      logical :: is_right = .true., has_weight = .false.
      !> Columns of values of lists: place of each list among the properties of walls, number of the value and column, and
      !> in the order of the values of each list
      integer, allocatable :: items(:, :)
      !> Names of the walls so far
      type(name_index_type) :: names
      !> The wall of the row before, its first row
      type(member_type) :: wall
      !> Name of the row before, and the mechanisms that it has had, with a blank after each
      character(len=:), allocatable :: name, mechanisms
      !> Can a row become several?
      logical :: has_hinges = .false.
      !> What is read instead of a table: a facade, or a wall with variants; not allocated: the table
      type(stated_wall_type), allocatable :: facade
      !> Path of what is read, for messages
      character(len=:), allocatable :: file
      !> What the row says, hinges that it has, and the number of the last that was given out
      type(wall_input_type) :: input
      type(member_type) :: own
      real(wp), allocatable :: levels(:)
      integer :: level = 0
   contains
      !> Open a population
      procedure :: open => open_population
      !> Read the next row
      procedure :: next
      !> Pass over rows
      procedure :: skip
      !> Where the row that was read last is
      procedure :: place
      !> Close it before its end is reached
      procedure :: close => close_population
   end type population_reader_type

contains

   !> Read all of a population
   subroutine read_population(file, members, error, gravity, note, facade)
      !> Path of the table
      character(len=*), intent(in) :: file
      !> Its rows
      type(member_type), allocatable, intent(out) :: members(:)
      !> Everything that is wrong, or lack of memory
      type(error_type), allocatable, intent(out) :: error
      !> Gravity [m/s2], standard if absent
      real(wp), intent(in), optional :: gravity
      !> How the table was read, where there is something to say of it, else empty
      character(len=:), allocatable, intent(out), optional :: note
      !> The facade, or the wall with variants, that is the whole population; absent: the table
      type(stated_wall_type), intent(in), optional :: facade

      type(population_reader_type) :: reader
      type(problems_type) :: problems
      type(member_type), allocatable :: more(:)
      logical :: found
      integer :: rows

      call reader%open(file, error, gravity, facade=facade)
      if (allocated(error)) return
      allocate (members(64))
      rows = 0
      do
         if (rows == size(members)) then
            call check_room(2.0_wp*bytes_of_row*real(rows, wp), error)
            if (allocated(error)) then
               call reader%close()
               return
            end if
            allocate (more(2*rows))
            more(:rows) = members
            call move_alloc(more, members)
         end if
         call reader%next(members(rows + 1), found, error)
         if (found .and. .not. allocated(error)) rows = rows + 1
         call problems%take(error)
         if (.not. found) exit
      end do
      members = members(:rows)
      if (present(note)) note = reader%table%note()
      call problems%raise(error)
   end subroutine read_population

   !> Open a population
   subroutine open_population(self, file, error, gravity, is_checked, facade)
      class(population_reader_type), intent(inout) :: self
      !> Path of the table, or of what says the facade
      character(len=*), intent(in) :: file
      !> No table, or a column that does not exist
      type(error_type), allocatable, intent(out) :: error
      !> Gravity [m/s2], standard if absent
      real(wp), intent(in), optional :: gravity
      !> Is the table as a whole to be checked? Yes if absent
      logical, intent(in), optional :: is_checked
      !> The facade, or the wall with variants, that is the whole population; absent: there is a table
      type(stated_wall_type), intent(in), optional :: facade

      ! Properties of walls as columns: of a list its first value. An array, for gfortran 12 takes a wrong length for a text
      ! whose length follows from the result of a function.
      character(len=len(item_name(wall_properties(1)%name, 1))) :: shown(size(wall_properties))
      integer :: i, at, item

      do i = 1, size(shown)
         shown(i) = wall_properties(i)%name
         if (is_many(wall_properties(i)%kind)) shown(i) = item_name(trim(wall_properties(i)%name), 1)
      end do
      self%row = 0
      self%mechanisms = ''
      self%name = ''
      self%file = file
      allocate (self%levels(0))
      if (present(gravity)) self%gravity = gravity
      if (present(is_checked)) self%is_checked = is_checked
      self%has_hinges = present(facade)
      if (present(facade)) self%facade = facade
      if (present(facade)) return
      call self%table%open(file, error)
      if (allocated(error)) return
      self%items = reshape([integer ::], [3, 0])
      do i = 1, size(self%table%columns)
         associate (column => self%table%columns(i)%text)
            call find_item(wall_properties, lower(column), at, item)
            if (at > 0) self%items = reshape([self%items, at, item, i], [3, size(self%items, 2) + 1])
            if (at > 0 .or. any(lower(column) == shown) .or. any(lower(column) == member_properties%name)) cycle
            call raise_input(error, file//': column '''//column//''': no such column; there are '// &
               & join(shown)//', '//join(member_properties%name)//trim(meant(lower(column), shown)))
         end associate
         call self%close()
         return
      end do
      call sort_items(self%items)
      self%wall_columns = [(self%table%column(trim(wall_properties(i)%name)), i=1, size(wall_properties))]
      self%member_columns = [(self%table%column(trim(member_properties(i)%name)), i=1, size(member_properties))]
      call find_missing(self, error)
      if (allocated(error)) then
         call self%close()
         return
      end if
      self%has_hinges = self%wall_columns(find_property(wall_properties, 'hinge_at')) > 0 &
         & .or. any(self%items(1, :) == find_property(wall_properties, 'hinge_level'))
      call self%table%find_decimal_mark([pack(self%wall_columns, wall_properties%kind /= is_text), &
         & pack(self%member_columns, member_properties%kind /= is_text), &
         & pack(self%items(3, :), wall_properties(self%items(1, :))%kind == is_list)], error)

   end subroutine open_population

   !> Find a column that every wall needs and the table does not have: said once, not of each row
   subroutine find_missing(self, error)
      !> The reader, its columns known
      type(population_reader_type), intent(in) :: self
      !> There is one
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      do i = 1, size(wall_properties)
         associate (property => wall_properties(i))
            if (.not. property%required .or. self%wall_columns(i) > 0) cycle
            if (len_trim(property%instead) > 0) then
               if (any(self%items(1, :) == find_property(wall_properties, trim(property%instead)))) cycle
            end if
            call raise_input(error, self%file//': column '''//trim(property%name)//''': must be given')
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

   !> Read the next row; after an error the rows behind it can be read
   subroutine next(self, member, found, error)
      class(population_reader_type), intent(inout) :: self
      type(member_type), intent(out) :: member
      !> Was there a row, right or wrong?
      logical, intent(out) :: found
      !> Everything that is wrong with it, or at the end with the table
      type(error_type), allocatable, intent(out) :: error

      found = self%level < size(self%levels)
      if (.not. found) call read_next(self, found, error)
      if (.not. found) then
         if (.not. allocated(error)) call check_end(self, error)
         return
      end if
      self%row = self%row + 1
      if (self%row > most_walls) then
         call raise_input(error, self%place()//': more than '//to_text(most_walls)//' rows')
         found = .false.
         call self%close()
      end if
      self%is_right = self%is_right .and. .not. allocated(error)
      if (allocated(error)) return
      call make_member(self, member, error)
      if (.not. allocated(error)) then
         call place_row(self, member, error)
      else if (self%wall%has_name) then
         ! Rows behind a wall that is wrong do not go on with the one before it.
         self%wall%has_name = self%name == member%wall%name() .or. &
            & (len(member%facade) > 0 .and. self%wall%facade == member%facade)
      end if
      if (.not. allocated(self%facade)) then
         call add_place(error, self%place())
      else if (self%facade%is_uncertain()) then
         call add_place(error, self%file//': wall '''//trim(self%input%word('name'))//'''')
      end if
      self%is_right = self%is_right .and. .not. allocated(error)
      self%has_weight = self%has_weight .or. member%weight > 0.0_wp
   end subroutine next

   !> Read the next row of the table, or the facade once, or the next variant
   subroutine read_next(self, found, error)
      class(population_reader_type), intent(inout) :: self
      !> Was there one?
      logical, intent(out) :: found
      !> It is no row
      type(error_type), allocatable, intent(out) :: error

      self%level = 0
      self%levels = [real(wp) ::]
      if (.not. allocated(self%facade)) then
         call self%table%next(found, error)
         return
      end if
      found = self%row < self%facade%rows()
   end subroutine read_next

   !> Make the next member: that of the row, or of the next hinge of the row before
   subroutine make_member(self, member, error)
      class(population_reader_type), intent(inout) :: self
      !> The member: all but whether it continues the wall before
      type(member_type), intent(inout) :: member
      !> Everything that is wrong with it
      type(error_type), allocatable, intent(out) :: error

      type(wall_input_type) :: input
      type(problems_type) :: problems
      type(error_type), allocatable :: wrong

      if (size(self%levels) == 0) then
         call read_own(self, wrong)
         call read_row(self, problems)
         ! What cannot be read would be told of once more as missing
         if (problems%count == 0 .and. has_hinge_level(self%input)) call find_levels(self)
      end if
      input = self%input
      if (problems%count == 0 .and. size(self%levels) > 0) then
         self%level = self%level + 1
         call input%clear('hinge_at')
         call input%set('hinge_level', [self%levels(self%level)])
         call input%set('name', trim(input%word('name'))//' at '//to_text(anint(self%levels(self%level)*1.0e6_wp)/1.0e6_wp)//' m')
      end if
      member = self%own
      call member%wall%input%set('name', trim(input%word('name')))
      if (problems%count == 0) call new_wall(member%wall, input, error, self%gravity)
      ! What is wrong with a facade is wrong with all of its walls: the others are not tried
      if (allocated(error) .or. allocated(wrong) .or. problems%count > 0) self%levels = [real(wp) ::]
      call problems%take(error)
      call problems%take(wrong)
      call problems%raise(error)
   end subroutine make_member

   !> Find the hinges of the row; none if they are wrong, which is said where the wall is made
   subroutine find_levels(self)
      class(population_reader_type), intent(inout) :: self

      type(problems_type) :: problems

      self%level = 0
      call find_hinge_levels(self%input, problems, self%levels)
      if (problems%count > 0) self%levels = [real(wp) ::]
      if (len(self%own%facade) == 0) self%own%facade = trim(self%input%word('name'))
      self%own%has_name = .true.
   end subroutine find_levels

   !> Length of the place
   pure integer function place_length(self)
      class(population_reader_type), intent(in) :: self

      place_length = len(self%file)
      if (.not. allocated(self%facade)) place_length = len(self%table%place())
   end function place_length

   !> Where the row that was read last is
   pure function place(self)
      class(population_reader_type), intent(in) :: self
      !> File and line; of a facade the file
      character(len=place_length(self)) :: place

      if (allocated(self%facade)) then
         place = self%file
      else
         place = self%table%place()
      end if
   end function place

   !> Check that there are walls, and that one of them has a weight
   subroutine check_end(self, error)
      !> The reader, at the end of the table
      type(population_reader_type), intent(in) :: self
      !> There is none
      type(error_type), allocatable, intent(out) :: error

      if (self%row == 0) then
         call raise_input(error, self%file//': no walls under the header')
      else if (self%is_checked .and. self%is_right .and. .not. self%has_weight) then
         call raise_input(error, self%file//': weight: must be positive for at least one wall')
      end if
   end subroutine check_end

   !> Pass over rows
   subroutine skip(self, rows, error)
      class(population_reader_type), intent(inout) :: self
      !> Number of rows
      integer, intent(in) :: rows
      !> One of them is no row, or the last is wrong; a table that ends before is none
      type(error_type), allocatable, intent(out) :: error

      type(member_type) :: member
      logical :: found
      integer :: i

      do i = 1, rows - 1
         if (self%has_hinges) then
            ! How many rows a row becomes is known once it is read
            call self%next(member, found, error)
         else
            call self%table%next(found, error)
            self%row = self%row + 1
         end if
         if (allocated(error)) return
      end do
      ! The row after may go on with the wall of the last
      if (rows > 0) call self%next(member, found, error)
   end subroutine skip

   !> Read what a row says of its wall
   subroutine read_row(self, problems)
      !> The reader, with a row: what it says is set
      class(population_reader_type), intent(inout) :: self
      !> Takes every cell that is not a number
      type(problems_type), intent(inout) :: problems

      self%input = wall_input_type()
      self%own%has_name = .true.
      if (allocated(self%facade)) then
         self%input = self%facade%wall_input_type
         if (self%facade%is_uncertain()) call self%facade%vary(self%row, self%input)
         return
      end if
      call self%input%set('name', 'wall '//to_text(self%row))
      self%own%has_name = is_given(self, self%wall_columns(find_property(wall_properties, 'name')))
      call read_cells(self, self%wall_columns, self%input, problems)
      call read_lists(self, self%input, problems)
   end subroutine read_row

   !> Read what a row says of its weight, its group, its mechanism and its facade
   subroutine read_own(self, error)
      !> The reader, with a row: all but what is said of its wall is set
      class(population_reader_type), intent(inout) :: self
      !> Every cell that is not a number or out of range
      type(error_type), allocatable, intent(out) :: error

      type(group_settings_type) :: own
      type(problems_type) :: problems

      call new_settings(own, member_properties)
      if (.not. allocated(self%facade)) call read_cells(self, self%member_columns, own, problems)
      call own%fill()
      call own%check(problems)
      ! Spreadsheets round to -0, whose bits do not stand in the order of its value.
      self%own%weight = abs(own%number('weight'))
      if (allocated(self%facade)) self%own%weight = self%facade%weight(self%row)
      self%own%p_occ = abs(own%number('p_occ'))
      self%own%group = own%word('group')
      self%own%facade = trim(own%word('facade'))
      call problems%raise(error)
   end subroutine read_own

   !> Has the row something in a column? Blanks alone are nothing
   logical function is_given(reader, column)
      !> The reader, with a row
      type(population_reader_type), intent(in) :: reader
      !> Its number, or 0
      integer, intent(in) :: column

      is_given = len_trim(reader%table%get_text(column)) > 0
   end function is_given

   !> Read the cells of a row that give properties
   subroutine read_cells(reader, columns, settings, problems)
      !> The reader, with a row
      type(population_reader_type), intent(in) :: reader
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
         if (.not. is_given(reader, columns(i))) cycle
         if (table(i)%kind == is_text) then
            call settings%set(table(i)%name, reader%table%get_text(columns(i)))
            cycle
         end if
         call reader%table%get_real(columns(i), number, error)
         if (.not. allocated(error)) call settings%set(table(i)%name, number)
         call problems%take(error)
      end do
   end subroutine read_cells

   !> Read the cells of a row that give values of lists; a list ends at the first cell that is empty
   subroutine read_lists(reader, input, problems)
      !> The reader, with a row
      type(population_reader_type), intent(in) :: reader
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
      do i = 1, size(reader%items, 2)
         associate (property => wall_properties(reader%items(1, i)), item => reader%items(2, i))
            if (i > 1) then
               if (reader%items(1, i) /= reader%items(1, i - 1)) count = 0
            end if
            if (count == 0) values = [real(wp) ::]
            if (count == 0) words = ''
            cell = trim(reader%table%get_text(reader%items(3, i)))
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
            call reader%table%get_real(reader%items(3, i), number, error)
            call problems%take(error)
            values = [values, number]
            call input%set(property%name, values)
         end associate
      end do
   end subroutine read_lists

   !> Place a row among those before it: a further mechanism of the wall or the facade before, or a new one
   subroutine place_row(self, member, error)
      !> The reader; it remembers the wall
      type(population_reader_type), intent(inout) :: self
      !> The row: whether it continues the wall before is set
      type(member_type), intent(inout) :: member
      !> The name stands elsewhere too, or what is said of the wall differs
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: name, mechanism, what
      logical :: repeats

      name = member%wall%name()
      mechanism = member%wall%mechanism_name()
      what = 'wall'
      if (len(member%facade) > 0) what = 'facade'
      repeats = self%wall%has_name .and. member%has_name .and. self%name == name
      if (len(member%facade) > 0) then
         member%continues = self%wall%has_name .and. self%wall%facade == member%facade
      else if (repeats) then
         member%continues = len(self%wall%facade) == 0
      end if
      if (.not. member%continues) then
         if (len(member%facade) > 0) call note_name(self, 'facade', member%facade, error)
         if (.not. allocated(error)) call note_name(self, 'name', name, error)
         if (allocated(error)) return
         self%wall = member
         self%wall%has_name = member%has_name .or. len(member%facade) > 0
         self%name = name
         self%mechanisms = mechanism//' '
      else if (repeats .and. index(self%mechanisms, mechanism//' ') > 0) then
         call raise_input(error, 'name = '''//name//''': the row before gives this wall the same mechanism')
      else if (abs(self%wall%weight - member%weight) > 0.0_wp) then
         call raise_input(error, 'weight = '//to_text(member%weight)//': must be '//to_text(self%wall%weight)// &
            & ' as in the row before, which is of the same '//what)
      else if (self%wall%group /= member%group) then
         call raise_input(error, 'group = '''//member%group//''': must be '''//self%wall%group// &
            & ''' as in the row before, which is of the same '//what)
      else if (repeats) then
         self%mechanisms = self%mechanisms//mechanism//' '
      else
         call note_name(self, 'name', name, error)
         self%name = name
         self%mechanisms = mechanism//' '
      end if
   end subroutine place_row

   !> Note the name of a wall or a facade, which no other has; a wall may have that of its facade
   subroutine note_name(self, property, name, error)
      type(population_reader_type), intent(inout) :: self
      !> What it is the name of: 'name' or 'facade'
      character(len=*), intent(in) :: property
      !> The name
      character(len=*), intent(in) :: name
      !> Another has it
      type(error_type), allocatable, intent(out) :: error

      integer :: line

      if (.not. self%is_checked) return
      line = 0
      call self%names%note(property//' '//name, max(self%table%line, 1), line)
      if (self%names%lacks_memory) then
         call raise_shortage(bytes_of_name*real(self%row, wp), error)
      else if (line > 0 .and. property == 'name') then
         call raise_input(error, 'name = '''//name//''': another wall has this name (line '//to_text(line)// &
            & '); mechanisms of one wall must be on consecutive rows')
      else if (line > 0) then
         call raise_input(error, 'facade = '''//name//''': another facade has this name (line '//to_text(line)// &
            & '); walls of one facade must be on consecutive rows')
      end if
   end subroutine note_name

   !> Close it before its end is reached
   subroutine close_population(self)
      class(population_reader_type), intent(inout) :: self

      call self%table%close()
   end subroutine close_population

end module dondolo_population
