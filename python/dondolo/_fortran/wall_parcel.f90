!> Walls across the boundary: a line for each text and numbers with a mask of those given, in the order of their table.
module dondolo_wall_parcel
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use, intrinsic :: iso_fortran_env, only : int16, int64
   use dondolo_base_error, only : add_place, error_type, problems_type, raise_input
   use dondolo_base_lines, only : lines_type
   use dondolo_base_property, only : is_list, is_text, is_words
   use dondolo_base_text, only : to_text
   use dondolo_boundary, only : check_room, next_line
   use dondolo_interface_wall_statics, only : static_names, statics_of
   use dondolo_parcel, only : parcel_type
   use dondolo_population_reader, only : population_reader_type
   use dondolo_population_table, only : population_table_type
   use dondolo_population_wall_row, only : wall_row_type
   use dondolo_population_wall_table, only : take_table
   use dondolo_wall, only : new_wall, wall_type
   use dondolo_wall_chain, only : motion_type
   use dondolo_wall_chain_model, only : chain_model_type
   use dondolo_wall_chain_terms, only : set_at_rest, walk_to
   use dondolo_wall_properties, only : wall_input_type, wall_numbers, wall_properties
   implicit none
   private

   public :: set_facts, set_positions, set_walls, take_rows, walls_parcel_type

   !> Lines in one text: many of them would each be a thing of its own
   type :: block_type
      private
      character(len=:), allocatable :: text
      integer(int64) :: length = 0
      integer :: lines = 0
   contains
      procedure :: add => add_line
      procedure :: put => put_lines
   end type block_type

   !> Walls on their way to Python, taken one by one: only what is sent of them is kept
   type :: walls_parcel_type
      private
      !> How many there are, and how many values they have
      integer :: walls = 0
      integer(int64) :: number = 0
      !> What there is of each wall, and room: how many values of each number, whether it rocks to both sides, static quantities,
      !> weight and probability of its mechanism
      integer(int16), allocatable :: given(:, :)
      integer(c_int), allocatable :: two_sided(:)
      real(c_double), allocatable :: statics(:, :), shares(:, :)
      !> Values of all walls, and room
      real(c_double), allocatable :: values(:)
      !> Their texts, and those of their rows
      type(block_type) :: texts, occurrence, alternatives, groups, facades, notes
   contains
      !> Take a wall, a row of a population, or all of them
      procedure :: add_wall
      procedure :: add_row
      procedure :: add_rows
      !> Put what was taken into a parcel
      procedure :: put_walls
      procedure :: put_rows
      procedure, private :: expect
   end type walls_parcel_type

contains

   !> Make walls
   subroutine set_walls(walls, texts, numbers, given, gravity, error)
      !> The walls
      type(wall_type), allocatable, intent(out) :: walls(:)
      !> A line for each text of a wall, in the order of the table of properties; empty: not given
      character(len=*), intent(in) :: texts
      !> All numbers that were given, wall after wall, in the order of the table; what stands behind them is not looked at
      real(c_double), intent(in) :: numbers(:)
      !> How many values each number has: of a list any number, else 1 or 0 (numbers, walls)
      integer(c_int), intent(in) :: given(:, :)
      !> Gravity [m/s2]
      real(c_double), intent(in) :: gravity(:)
      !> The first thing that is wrong
      type(error_type), allocatable, intent(out) :: error

      type(wall_input_type) :: input
      character(len=:), allocatable :: text
      integer(int64) :: at, next
      integer :: i, k, number

      if (size(given, 1) /= wall_numbers) then
         call raise_input(error, 'walls: '//to_text(size(given, 1))//' numbers each: must be '//to_text(wall_numbers))
         return
      end if
      if (any(given < 0) .or. sum(int(given, int64)) > size(numbers, kind=int64)) then
         call raise_input(error, 'walls: '//to_text(size(numbers))//' numbers: must be '//to_text(sum(int(given, int64))))
         return
      end if
      call check_room(error, walls=size(gravity))
      if (allocated(error)) return
      allocate (walls(size(gravity)))
      at = 1
      next = 1
      do i = 1, size(walls)
         input = wall_input_type()
         number = 0
         do k = 1, size(wall_properties)
            associate (property => wall_properties(k))
               if (property%kind == is_text .or. property%kind == is_words) then
                  call next_line(texts, at, text)
                  if (len(text) > 0) call input%set(property%name, text)
                  cycle
               end if
               number = number + 1
               if (given(number, i) < 1) cycle
               if (property%kind == is_list) then
                  call input%set(property%name, numbers(next:next + given(number, i) - 1))
               else
                  call input%set(property%name, numbers(next))
               end if
               next = next + given(number, i)
            end associate
         end do
         call take_table(input, '', error)
         if (.not. allocated(error)) call new_wall(walls(i), input, error, gravity(i))
         if (.not. allocated(error)) cycle
         if (size(walls) > 1) call add_place(error, 'wall '''//walls(i)%name()//'''')
         return
      end do
   end subroutine set_walls

   !> Positions of the bodies of a chain; those of any other wall are left
   subroutine set_positions(wall, rotation, positions)
      type(wall_type), intent(in) :: wall
      !> Rotations that it can have [rad]
      real(c_double), intent(in) :: rotation(:)
      !> (x, y, phi; body, rotation)
      real(c_double), intent(inout) :: positions(:, :, :)

      type(motion_type) :: motion
      logical :: is_there
      integer :: i

      select type (model => wall%model)
      type is (chain_model_type)
         do i = 1, size(rotation)
            call set_at_rest(model%chain, motion)
            call walk_to(model%chain, rotation(i), motion, is_there)
            if (is_there) positions(:, :, i) = motion%y
            ! A chain that is seen from behind
            if (is_there .and. model%is_inward) positions([1, 3], :, i) = -positions([1, 3], :, i)
         end do
      end select
   end subroutine set_positions

   !> Take what is known of the sides and of the impact of a chain
   subroutine set_facts(wall, facts)
      type(wall_type), intent(in) :: wall
      !> As chain_facts has them
      real(c_double), intent(inout) :: facts(5)

      select type (model => wall%model)
      type is (chain_model_type)
         facts = [model%multiplier, model%bound, merge(1.0_c_double, 0.0_c_double, [model%is_mirrored, model%is_image])]
      end select
   end subroutine set_facts

   !> Take rows of a chain
   subroutine take_rows(wall, table, numbers, count)
      type(wall_type), intent(in) :: wall
      !> 1 to 4: bodies, joints, actions, ties
      integer(c_int), intent(in) :: table
      !> The first of them, and how many there are
      real(c_double), intent(inout) :: numbers(:)
      integer(c_int), intent(inout) :: count

      real(c_double), allocatable :: rows(:)

      allocate (rows(0))
      select type (model => wall%model)
      type is (chain_model_type)
         select case (table)
         case (1)
            rows = model%rows%bodies
         case (2)
            rows = model%rows%joints
         case (3)
            rows = model%rows%actions
         case (4)
            rows = model%rows%ties
         end select
      end select
      count = size(rows)
      associate (n => min(size(rows), size(numbers)))
         numbers(:n) = rows(:n)
      end associate
   end subroutine take_rows

   !> Pack a wall as it was understood
   subroutine add_wall(self, wall)
      class(walls_parcel_type), intent(inout) :: self
      type(wall_type), intent(in) :: wall

      integer, allocatable :: lengths(:)
      integer :: k, number

      lengths = wall%input%lengths()
      call self%expect(sum(lengths))
      self%walls = self%walls + 1
      number = 0
      do k = 1, size(wall_properties)
         associate (property => wall_properties(k), input => wall%input)
            if (property%kind == is_text .or. property%kind == is_words) then
               call self%texts%add(input%word(property%name))
               cycle
            end if
            number = number + 1
            self%given(number, self%walls) = int(lengths(k), int16)
            if (lengths(k) == 0) cycle
            associate (own => self%values(self%number + 1:self%number + lengths(k)))
               if (property%kind == is_list) own = input%list(property%name)
               if (property%kind /= is_list) own = input%number(property%name)
            end associate
            self%number = self%number + lengths(k)
         end associate
      end do
      self%two_sided(self%walls) = merge(1, 0, wall%mechanism%two_sided)
      self%statics(:, self%walls) = statics_of(wall)
   end subroutine add_wall

   !> Make room for a wall with so many values
   subroutine expect(self, values)
      class(walls_parcel_type), intent(inout) :: self
      integer, intent(in) :: values

      integer(int16), allocatable :: given(:, :)
      integer(c_int), allocatable :: two_sided(:)
      real(c_double), allocatable :: statics(:, :), more(:)
      integer :: room

      if (.not. allocated(self%given)) allocate (self%given(wall_numbers, 1), self%two_sided(1), &
         & self%statics(size(static_names), 1), self%values(16))
      if (self%walls == size(self%two_sided)) then
         room = 2*self%walls
         allocate (given(wall_numbers, room), two_sided(room), statics(size(static_names), room))
         given(:, :self%walls) = self%given
         two_sided(:self%walls) = self%two_sided
         statics(:, :self%walls) = self%statics
         call move_alloc(given, self%given)
         call move_alloc(two_sided, self%two_sided)
         call move_alloc(statics, self%statics)
      end if
      if (self%number + values > size(self%values, kind=int64)) then
         allocate (more(2*(self%number + values)))
         more(:self%number) = self%values(:self%number)
         call move_alloc(more, self%values)
      end if
   end subroutine expect

   !> Pack a row of a population
   subroutine add_row(self, row)
      class(walls_parcel_type), intent(inout) :: self
      type(wall_row_type), intent(in) :: row

      real(c_double), allocatable :: shares(:, :)
      integer :: i

      call self%add_wall(row%wall)
      if (.not. allocated(self%shares)) allocate (self%shares(2, 1))
      if (self%walls > size(self%shares, 2)) then
         allocate (shares(2, 2*size(self%shares, 2)))
         shares(:, :self%walls - 1) = self%shares
         call move_alloc(shares, self%shares)
      end if
      self%shares(:, self%walls) = [row%weight, row%p_occ]
      call self%occurrence%add(trim(row%occurrence))
      call self%alternatives%add(row%alternative)
      call self%groups%add(row%group)
      call self%facades%add(row%facade)
      do i = 1, row%notes%count
         call self%notes%add(row%notes%line(i)%text)
      end do
   end subroutine add_row

   !> Pack all rows of a table, or of the wall that takes its place; more than one at a time is not in memory
   subroutine add_rows(self, table, error)
      class(walls_parcel_type), intent(inout) :: self
      type(population_table_type), intent(in) :: table
      !> Everything that is wrong, or lack of memory
      type(error_type), allocatable, intent(out) :: error

      type(population_reader_type) :: reader
      type(problems_type) :: problems
      type(wall_row_type) :: row
      logical :: found

      do
         call reader%next(table, row, found, error)
         if (found .and. .not. allocated(error)) call self%add_row(row)
         call problems%take(error)
         if (.not. found) exit
         if (iand(self%walls, self%walls - 1) > 0) cycle
         ! There will be twice as many.
         call check_room(error, walls=2*self%walls)
         if (allocated(error)) return
      end do
      call problems%raise(error)
   end subroutine add_rows

   !> Put walls into a parcel: walls_numbers, which numbers any wall has, from 0; of each wall walls_given, how many values it has
   !> of each of these, walls_two_sided, walls_statics, the static quantities, and walls_texts, one after the other; walls_values:
   !> the values of all walls
   subroutine put_walls(self, parcel)
      class(walls_parcel_type), intent(inout) :: self
      type(parcel_type), intent(inout) :: parcel

      integer(c_int), allocatable :: numbers(:)
      integer :: k

      associate (walls => self%walls)
         numbers = pack([(k, k=1, wall_numbers)], [(any(self%given(k, :walls) > 0), k=1, wall_numbers)])
         call parcel%put('walls_numbers', numbers - 1)
         call parcel%put('walls_given', reshape(int(self%given(numbers, :walls), c_int), [size(numbers, kind=int64)*walls]), &
            & [size(numbers), walls])
         deallocate (self%given)
         call parcel%put('walls_two_sided', self%two_sided(:walls))
         call parcel%put('walls_statics', reshape(self%statics(:, :walls), [size(static_names, kind=int64)*walls]), &
            & [size(static_names), walls])
         deallocate (self%statics)
      end associate
      call parcel%put('walls_values', self%values(:self%number))
      deallocate (self%values)
      call self%texts%put('walls_texts', parcel)
   end subroutine put_walls

   !> Put rows into a parcel: walls, walls_weight, walls_p_occ, walls_occurrence, walls_alternative, walls_group and walls_facade;
   !> walls_note_names, and walls_notes, those of each row one after the other
   subroutine put_rows(self, names, parcel)
      class(walls_parcel_type), intent(inout) :: self
      !> Names of notes
      type(lines_type), intent(in) :: names
      type(parcel_type), intent(inout) :: parcel

      call self%put_walls(parcel)
      call parcel%put('walls_weight', self%shares(1, :self%walls))
      call parcel%put('walls_p_occ', self%shares(2, :self%walls))
      call self%occurrence%put('walls_occurrence', parcel)
      call self%alternatives%put('walls_alternative', parcel)
      call self%groups%put('walls_group', parcel)
      call self%facades%put('walls_facade', parcel)
      call parcel%put('walls_note_names', names)
      call self%notes%put('walls_notes', parcel)
   end subroutine put_rows

   !> Add a line to a block
   subroutine add_line(self, text)
      class(block_type), intent(inout) :: self
      character(len=*), intent(in) :: text

      character(len=:), allocatable :: more
      integer(int64) :: length

      if (.not. allocated(self%text)) allocate (character(len=1024) :: self%text)
      length = self%length + len(text, int64) + 1
      if (length > len(self%text, int64)) then
         allocate (character(len=2*length) :: more)
         more(:self%length) = self%text(:self%length)
         call move_alloc(more, self%text)
      end if
      self%text(self%length + 1:length) = text//new_line('a')
      self%length = length
      self%lines = self%lines + 1
   end subroutine add_line

   !> Put a block into a parcel, its text given back
   subroutine put_lines(self, name, parcel)
      class(block_type), intent(inout) :: self
      !> Name of the lines
      character(len=*), intent(in) :: name
      type(parcel_type), intent(inout) :: parcel

      type(lines_type) :: none

      if (self%lines > 0) then
         ! The parcel ends the last line.
         call parcel%put_block(name, self%text(:self%length - 1), self%lines)
         deallocate (self%text)
      else
         call parcel%put(name, none)
      end if
   end subroutine put_lines

end module dondolo_wall_parcel
