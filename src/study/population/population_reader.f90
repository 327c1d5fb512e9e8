!> The rows of a population, one after the other, out of its table.
!>
!> A wall without a name is called 'wall' with the number of its row. Rows with the same name are mechanisms of the same
!> wall, rows of the same facade those of the facade; they stand one after the other. A row with hinge levels becomes a row
!> for each: the walls 'NAME at Z m' of the facade NAME. Rows are made one by one, so that a table may have more of them than
!> the memory has room for.
module dondolo_population_reader
   use dondolo_base_error, only : add_place, error_type, problems_type, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_limits, only : most_walls
   use dondolo_base_memory, only : check_room
   use dondolo_base_property, only : find_property
   use dondolo_base_settings, only : group_settings_type, new_settings
   use dondolo_base_settings_check, only : check_settings
   use dondolo_base_text, only : to_text
   use dondolo_files_csv_reader, only : csv_row_type
   use dondolo_population_table, only : population_table_type
   use dondolo_population_wall_names, only : wall_names_type
   use dondolo_population_wall_row, only : row_properties, wall_row_type
   use dondolo_population_wall_table, only : take_table
   use dondolo_wall, only : new_wall
   use dondolo_wall_hinge_level, only : read_hinge_levels, has_hinge_level
   use dondolo_wall_properties, only : wall_input_type, wall_properties
   implicit none
   private

   public :: population_reader_type, read_population

   !> Memory that a row takes where all are kept [bytes]
   real(wp), parameter :: bytes_of_row = 4000.0_wp

   !> Where in a population the reading is; without a value before its first row
   type :: population_reader_type
      !> Number of the row that was read last
      integer :: row = 0
      !> Walls and facades so far
      type(wall_names_type) :: names
      !> The row of the table
      type(csv_row_type), private :: cells
      !> Are all rows so far right, and has one of them a weight?
      logical, private :: is_right = .true., has_weight = .false.
      !> What the row says, hinges that it has, and the number of the last that was given out
      type(wall_input_type), private :: input
      type(wall_row_type), private :: own
      real(wp), allocatable, private :: levels(:)
      integer, private :: level = 0
   contains
      !> Read the next row
      procedure :: next
      !> Pass over rows
      procedure :: skip
      !> Where the row that was read last is
      procedure :: place
   end type population_reader_type

contains

   !> Read all of a population
   subroutine read_population(file, rows, error, gravity, note, occurrence)
      !> Path of the table
      character(len=*), intent(in) :: file
      !> Its rows
      type(wall_row_type), allocatable, intent(out) :: rows(:)
      !> Everything that is wrong, or lack of memory
      type(error_type), allocatable, intent(out) :: error
      !> Gravity [m/s2], standard if absent
      real(wp), intent(in), optional :: gravity
      !> How the table was read: a note, or empty
      character(len=:), allocatable, intent(out), optional :: note
      !> How the mechanisms of a wall occur whose row does not say it, one of occurrence_names; independent if absent
      character(len=*), intent(in), optional :: occurrence

      type(population_table_type) :: table

      if (present(occurrence)) table%occurrence = occurrence
      call table%read(file, error, gravity)
      if (allocated(error)) return
      if (present(note)) note = table%csv%note()
      call read_rows(table, rows, error)
   end subroutine read_population

   !> Read all rows of a table, or of the wall that takes its place
   subroutine read_rows(table, rows, error)
      type(population_table_type), intent(in) :: table
      !> Its rows
      type(wall_row_type), allocatable, intent(out) :: rows(:)
      !> Everything that is wrong, or lack of memory
      type(error_type), allocatable, intent(out) :: error

      type(population_reader_type) :: reader
      type(problems_type) :: problems
      type(wall_row_type), allocatable :: more(:)
      logical :: found
      integer :: n

      allocate (rows(64))
      n = 0
      do
         if (n == size(rows)) then
            call check_room(2.0_wp*bytes_of_row*real(n, wp), error)
            if (allocated(error)) return
            allocate (more(2*n))
            more(:n) = rows
            call move_alloc(more, rows)
         end if
         call reader%next(table, rows(n + 1), found, error)
         if (found .and. .not. allocated(error)) n = n + 1
         call problems%take(error)
         if (.not. found) exit
      end do
      rows = rows(:n)
      call problems%raise(error)
   end subroutine read_rows

   !> Read the next row; after an error the rows behind it can be read
   subroutine next(self, table, row, found, error)
      class(population_reader_type), intent(inout) :: self
      !> What is read, the same for all rows
      type(population_table_type), intent(in) :: table
      type(wall_row_type), intent(out) :: row
      !> Was there a row, right or wrong?
      logical, intent(out) :: found
      !> Everything that is wrong with it, or at the end with the table
      type(error_type), allocatable, intent(out) :: error

      if (.not. allocated(self%levels)) self%levels = [real(wp) ::]
      found = self%level < size(self%levels)
      if (.not. found) call read_next(self, table, found, error)
      if (.not. found) then
         if (.not. allocated(error)) call check_end(self, table, error)
         return
      end if
      self%row = self%row + 1
      if (self%row > most_walls) then
         call raise_input(error, self%place(table)//': more than '//to_text(most_walls)//' rows')
         found = .false.
      end if
      self%is_right = self%is_right .and. .not. allocated(error)
      if (allocated(error)) return
      call make_row(self, table, row, error)
      if (.not. allocated(error)) then
         call self%names%place_row(self%cells%line, row, error)
      else
         call self%names%pass_over(row)
      end if
      if (.not. allocated(table%base_wall)) then
         call add_place(error, self%place(table))
      else if (table%base_wall%is_uncertain()) then
         call add_place(error, table%file//': &uncertainty: variant '''//trim(self%input%word('name'))//'''')
      end if
      self%is_right = self%is_right .and. .not. allocated(error)
      self%has_weight = self%has_weight .or. row%weight > 0.0_wp
   end subroutine next

   !> Read the next row of the table, or the facade once, or the next variant
   subroutine read_next(self, table, found, error)
      class(population_reader_type), intent(inout) :: self
      type(population_table_type), intent(in) :: table
      !> Was there one?
      logical, intent(out) :: found
      !> It is no row
      type(error_type), allocatable, intent(out) :: error

      self%level = 0
      self%levels = [real(wp) ::]
      if (allocated(table%base_wall)) then
         found = self%row < table%base_wall%rows()
      else
         call table%csv%next(self%cells, found, error)
      end if
   end subroutine read_next

   !> Make the next row: as the table has it, or of the next hinge of a facade
   subroutine make_row(self, table, row, error)
      class(population_reader_type), intent(inout) :: self
      type(population_table_type), intent(in) :: table
      !> The row: all but whether it continues the wall before
      type(wall_row_type), intent(inout) :: row
      !> Everything that is wrong with it
      type(error_type), allocatable, intent(out) :: error

      type(wall_input_type) :: input
      type(problems_type) :: problems
      type(error_type), allocatable :: wrong

      if (size(self%levels) == 0) then
         call read_own(self, table, wrong)
         call read_row(self, table, problems)
         ! A value that cannot be read would be reported once more, as missing
         if (problems%count == 0 .and. has_hinge_level(self%input)) call find_levels(self)
      end if
      input = self%input
      if (problems%count == 0 .and. size(self%levels) > 0) then
         self%level = self%level + 1
         call input%clear('hinge_at')
         call input%set('hinge_level', [self%levels(self%level)])
         call input%set('name', trim(input%word('name'))//' at '//to_text(anint(self%levels(self%level)*1.0e6_wp)/1.0e6_wp)//' m')
      end if
      row = self%own
      call row%wall%input%set('name', trim(input%word('name')))
      if (problems%count == 0) call new_wall(row%wall, input, error, table%gravity)
      ! An error of a facade is one of all its walls: the others are not tried
      if (allocated(error) .or. allocated(wrong) .or. problems%count > 0) self%levels = [real(wp) ::]
      call problems%take(error)
      call problems%take(wrong)
      call problems%raise(error)
   end subroutine make_row

   !> Find the hinges of the row; none if they are wrong, which is said where the wall is made
   subroutine find_levels(self)
      class(population_reader_type), intent(inout) :: self

      type(problems_type) :: problems

      self%level = 0
      call read_hinge_levels(self%input, problems, self%levels)
      if (problems%count > 0) self%levels = [real(wp) ::]
      if (len(self%own%facade) == 0) self%own%facade = trim(self%input%word('name'))
      self%own%has_name = .true.
   end subroutine find_levels

   !> Length of the place
   pure integer function place_length(self, table)
      class(population_reader_type), intent(in) :: self
      type(population_table_type), intent(in) :: table

      place_length = len(table%file)
      if (.not. allocated(table%base_wall)) place_length = len(table%csv%place(self%cells))
   end function place_length

   !> Where the row that was read last is
   pure function place(self, table)
      class(population_reader_type), intent(in) :: self
      type(population_table_type), intent(in) :: table
      !> File and line; of a facade the file
      character(len=place_length(self, table)) :: place

      if (allocated(table%base_wall)) then
         place = table%file
      else
         place = table%csv%place(self%cells)
      end if
   end function place

   !> Check that there are walls, and that one of them has a weight
   subroutine check_end(self, table, error)
      !> The reader, at the end of the table
      type(population_reader_type), intent(in) :: self
      type(population_table_type), intent(in) :: table
      !> There is none
      type(error_type), allocatable, intent(out) :: error

      if (self%row == 0) then
         call raise_input(error, table%file//': no walls under the header')
      else if (self%names%is_checked .and. self%is_right .and. .not. self%has_weight) then
         call raise_input(error, table%file//': weight: must be positive for at least one wall')
      end if
   end subroutine check_end

   !> Pass over rows
   subroutine skip(self, table, rows, error)
      class(population_reader_type), intent(inout) :: self
      type(population_table_type), intent(in) :: table
      !> Number of rows
      integer, intent(in) :: rows
      !> One of them is no row, or the last is wrong; a table that ends before is none
      type(error_type), allocatable, intent(out) :: error

      type(wall_row_type) :: row
      logical :: found
      integer :: i

      do i = 1, rows - 1
         if (table%has_hinges()) then
            ! How many rows a row becomes is known once it is read
            call self%next(table, row, found, error)
         else
            call table%csv%next(self%cells, found, error)
            self%row = self%row + 1
         end if
         if (allocated(error)) return
      end do
      ! The next row may be of the same wall
      if (rows > 0) call self%next(table, row, found, error)
   end subroutine skip

   !> Read the wall of a row
   subroutine read_row(self, table, problems)
      !> The reader, with a row: what it says is set
      class(population_reader_type), intent(inout) :: self
      type(population_table_type), intent(in) :: table
      !> Takes every cell that is not a number
      type(problems_type), intent(inout) :: problems

      type(error_type), allocatable :: error

      self%input = wall_input_type()
      self%own%has_name = .true.
      if (allocated(table%base_wall)) then
         self%input = table%base_wall%wall_input_type
         if (table%base_wall%is_uncertain()) call table%base_wall%vary(self%row, self%input)
         return
      end if
      call self%input%set('name', 'wall '//to_text(self%row))
      self%own%has_name = table%is_given(self%cells, table%wall_columns(find_property(wall_properties, 'name')))
      call table%read_cells(self%cells, table%wall_columns, self%input, problems)
      call table%read_lists(self%cells, self%input, problems)
      call take_table(self%input, table%file, error)
      call problems%take(error)
   end subroutine read_row

   !> Read what a row says besides the properties of its wall
   subroutine read_own(self, table, error)
      !> The reader, with a row: all but what is said of its wall is set
      class(population_reader_type), intent(inout) :: self
      type(population_table_type), intent(in) :: table
      !> Every cell that is not a number or out of range
      type(error_type), allocatable, intent(out) :: error

      type(group_settings_type) :: own
      type(problems_type) :: problems

      call new_settings(own, row_properties)
      if (.not. allocated(table%base_wall)) call table%read_cells(self%cells, table%row_columns, own, problems)
      if (.not. own%has_word('occurrence')) call own%set('occurrence', trim(table%occurrence))
      call own%fill()
      call check_settings(own, problems)
      if (.not. allocated(table%base_wall)) call table%read_notes(self%cells, self%own%notes, problems)
      ! Spreadsheets round to -0, whose bits are not in the order of values.
      self%own%weight = abs(own%number('weight'))
      if (allocated(table%base_wall)) self%own%weight = table%base_wall%weight(self%row)
      self%own%p_occ = abs(own%number('p_occ'))
      self%own%group = own%word('group')
      self%own%occurrence = own%word('occurrence')
      self%own%alternative = trim(own%word('alternative'))
      self%own%facade = trim(own%word('facade'))
      call problems%raise(error)
   end subroutine read_own

end module dondolo_population_reader
