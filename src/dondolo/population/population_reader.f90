!> A population of walls: a CSV table with one row a mechanism of a wall, its columns those of &wall, and weight, group,
!> p_occ and facade; or one facade alone, as &wall says it.
!>
!> A cell that is empty was not given. A wall without a name is called 'wall' with the number of its row. Rows with the
!> same name are mechanisms of the same wall, rows of the same facade those of the facade; they stand one after the other.
!> A row with hinge levels becomes a row for each: the walls 'NAME at Z m' of the facade NAME. Rows are read one by one, so
!> that a table may be longer than the memory.
module dondolo_population_reader
   use dondolo_error, only : add_place, error_type, problems_type, raise_input
   use dondolo_hinge_level, only : find_hinge_levels, has_hinge_level
   use dondolo_kinds, only : wp
   use dondolo_limits, only : most_walls
   use dondolo_member, only : member_properties, member_type
   use dondolo_memory, only : check_room
   use dondolo_population_roll, only : population_roll_type
   use dondolo_property, only : find_property
   use dondolo_settings, only : group_settings_type, new_settings
   use dondolo_settings_check, only : check_settings
   use dondolo_text, only : to_text
   use dondolo_variants, only : stated_wall_type
   use dondolo_wall, only : new_wall
   use dondolo_wall_properties, only : wall_input_type, wall_properties
   implicit none
   private

   public :: population_reader_type, read_population

   !> Memory that a row takes where all are kept [bytes]
   real(wp), parameter :: bytes_of_row = 4000.0_wp

   !> A population that is being read
   type, extends(population_roll_type) :: population_reader_type
      !> Gravity [m/s2]
      real(wp), allocatable :: gravity
      !> Are all rows so far right, and has one of them a weight?
      logical :: is_right = .true., has_weight = .false.
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
      call self%open_table(file, error)
      if (allocated(error)) return
      self%has_hinges = self%wall_columns(find_property(wall_properties, 'hinge_at')) > 0 &
         & .or. any(self%items(1, :) == find_property(wall_properties, 'hinge_level'))
   end subroutine open_population

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
         call self%place_row(member, error)
      else if (self%wall%has_name) then
         ! Rows behind a wall that is wrong do not go on with the one before it.
         self%wall%has_name = self%name == member%wall%name() .or. &
            & (len(member%facade) > 0 .and. self%wall%facade == member%facade)
      end if
      if (.not. allocated(self%facade)) then
         call add_place(error, self%place())
      else if (self%facade%is_uncertain()) then
         call add_place(error, self%file//': &uncertainty: variant '''//trim(self%input%word('name'))//'''')
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
      self%own%has_name = self%is_given(self%wall_columns(find_property(wall_properties, 'name')))
      call self%read_cells(self%wall_columns, self%input, problems)
      call self%read_lists(self%input, problems)
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
      if (.not. allocated(self%facade)) call self%read_cells(self%member_columns, own, problems)
      call own%fill()
      call check_settings(own, problems)
      ! Spreadsheets round to -0, whose bits do not stand in the order of its value.
      self%own%weight = abs(own%number('weight'))
      if (allocated(self%facade)) self%own%weight = self%facade%weight(self%row)
      self%own%p_occ = abs(own%number('p_occ'))
      self%own%group = own%word('group')
      self%own%facade = trim(own%word('facade'))
      call problems%raise(error)
   end subroutine read_own

   !> Close it before its end is reached
   subroutine close_population(self)
      class(population_reader_type), intent(inout) :: self

      call self%table%close()
   end subroutine close_population

end module dondolo_population_reader
