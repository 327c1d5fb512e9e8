!> Walls above a hinge level, and of several leaves, against independently computed values (15 digits).
!>
!> The facade: storeys of 4, 3.5 and 3 m of 0.60, 0.45 and 0.30 m, floors of 12, 12 and 6 kN/m at their tops.
program test_facade
   use checks, only : check, check_close, check_error, check_ok, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_population_reader, only : population_reader_type, read_population
   use dondolo_population_table, only : population_table_type
   use dondolo_population_variants, only : base_wall_type
   use dondolo_population_wall_row, only : wall_row_type
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   implicit none

   real(wp), parameter :: exact = 1.0e-12_wp, g = 9.81_wp
   character(len=*), parameter :: folder = 'build/test_facade', table = folder//'/walls.csv'

   call test_levels()
   call test_same_wall()
   call test_lists()
   call test_gable()
   call test_building()
   call test_leaves()
   call test_wrong_input()
   call test_rows()
   call test_wrong_rows()
   call test_given_facade()
   call finish()

contains

   !> The facade
   function facade(inertia) result(input)
      !> What the loads move
      character(len=*), intent(in) :: inertia
      type(wall_input_type) :: input

      call input%set('mechanism', 'one_sided')
      call input%set('section_height', [4.0_wp, 3.5_wp, 3.0_wp])
      call input%set('section_thickness', [0.60_wp, 0.45_wp, 0.30_wp])
      call input%set('load', [12.0e3_wp, 12.0e3_wp, 6.0e3_wp])
      call input%set('load_height', [4.0_wp, 7.5_wp, 10.5_wp])
      call input%set('load_depth', [0.5_wp, 0.35_wp, 0.2_wp])
      call input%set('load_inertia', inertia)
   end function facade

   !> A wall
   function made(input) result(wall)
      type(wall_input_type), intent(in) :: input
      type(wall_type) :: wall

      type(error_type), allocatable :: error

      call new_wall(wall, input, error)
      call check_ok(error, 'the wall is right')
   end function made

   !> Trigger and capacity at three hinges, dead loads and masses that are pushed
   subroutine test_levels()

      real(wp), parameter :: level(3) = [0.0_wp, 4.0_wp, 7.5_wp], &
         & dead(3) = [0.0844850431275166_wp, 0.109586273564653_wp, 0.150339160091114_wp], &
         & pushed(3) = [0.0556394616924816_wp, 0.0671416144998685_wp, 0.0856590731458974_wp], &
         & capacity(3) = [0.0555821528209993_wp, 0.0670409951295991_wp, 0.0854504835372323_wp]
      type(wall_input_type) :: input
      type(wall_type) :: wall
      integer :: i

      call suite('hinge levels')
      do i = 1, size(level)
         input = facade('none')
         call input%set('hinge_level', [level(i)])
         wall = made(input)
         call check_close(wall%mechanism%trigger_acceleration()/g, dead(i), exact, 'trigger, dead loads')
         call check_close(wall%mechanism%capacity, capacity(i), exact, 'capacity, dead loads')
         input = facade('both')
         call input%set('hinge_level', [level(i)])
         wall = made(input)
         call check_close(wall%mechanism%trigger_acceleration()/g, pushed(i), exact, 'trigger, masses both ways')
         call check_close(wall%mechanism%capacity, capacity(i), exact, 'capacity, masses both ways')
      end do
   end subroutine test_levels

   !> A wall above a hinge is the wall that one would describe by itself, to the bit
   subroutine test_same_wall()

      type(wall_input_type) :: input, own
      type(wall_type) :: cut, whole

      call suite('the wall above a hinge')
      input = facade('both')
      call input%set('thrust', [1.0e3_wp])
      call input%set('thrust_height', [10.5_wp])
      call input%set('compressive_strength', 1.5e6_wp)
      whole = made(input)
      call input%set('hinge_level', [0.0_wp])
      call check_same(made(input), whole, 'a hinge at the base')
      call input%set('hinge_level', [7.5_wp])
      call own%set('mechanism', 'one_sided')
      call own%set('height', 3.0_wp)
      call own%set('thickness', 0.3_wp)
      call own%set('load', [6.0e3_wp])
      call own%set('load_height', [3.0_wp])
      call own%set('load_depth', [0.2_wp])
      call own%set('load_inertia', 'both')
      call own%set('thrust', [1.0e3_wp])
      call own%set('thrust_height', [3.0_wp])
      call own%set('compressive_strength', 1.5e6_wp)
      cut = made(input)
      call check_same(cut, made(own), 'a hinge at the last floor')
      call check(cut%model%hinge_depth < whole%model%hinge_depth, 'less weight crushes less')
      call input%set('hinge_level', [9.0_wp])
      cut = made(input)
      call check_close(cut%input%number('height'), 1.5_wp, exact, 'a hinge within a storey')
      call check_close(cut%input%number('thickness'), 0.3_wp, exact, 'its thickness')
   end subroutine test_same_wall

   !> Two walls move alike
   subroutine check_same(one, other, what)
      type(wall_type), intent(in) :: one, other
      !> What they are
      character(len=*), intent(in) :: what

      real(wp) :: a(5), b(5), q
      integer :: i

      do i = 0, 3
         q = 0.01_wp*i
         call one%mechanism%terms(q, a(1), a(2), a(3), a(4), a(5))
         call other%mechanism%terms(q, b(1), b(2), b(3), b(4), b(5))
         call check(.not. any(abs(a - b) > 1.0e-13_wp*abs(b)), what//': terms')
      end do
      call check_close(one%mechanism%capacity, other%mechanism%capacity, exact, what//': capacity')
      call check_close(one%mechanism%restitution, other%mechanism%restitution, exact, what//': restitution')
   end subroutine check_same

   !> Lists with one value for all, words for each, offsets, springs and distributed springs
   subroutine test_lists()

      type(wall_input_type) :: input
      type(wall_type) :: wall

      call suite('lists above a hinge')
      input = facade('none')
      call input%set('load_inertia', 'none,vertical,both')
      call input%set('section_offset', [0.0_wp, 0.1_wp, 0.15_wp])
      call input%set('section_fill', [0.8_wp])
      call input%set('load_depth', [0.3_wp])
      call input%set('load_seat', [0.1_wp, 0.2_wp, 0.3_wp])
      call input%set('inertia_mass', [100.0_wp, 200.0_wp])
      call input%set('inertia_depth', [0.3_wp])
      call input%set('inertia_height', [2.0_wp, 6.0_wp])
      call input%set('spring', [1.0e3_wp])
      call input%set('spring_depth', [0.2_wp])
      call input%set('spring_height', [3.0_wp])
      call input%set('distributed_spring', [1.0e3_wp, 2.0e3_wp])
      call input%set('distributed_spring_depth', [0.2_wp])
      call input%set('distributed_spring_bottom', [0.0_wp, 3.0_wp])
      call input%set('distributed_spring_top', [4.0_wp, 6.0_wp])
      call input%set('hinge_level', [4.0_wp])
      wall = made(input)
      associate (above => wall%input)
         call check_list(above%list('section_height'), [3.5_wp, 3.0_wp], 'storeys')
         call check_list(above%list('section_offset'), [0.0_wp, 0.05_wp], 'offsets')
         call check_list(above%list('section_fill'), [0.8_wp], 'one for all')
         call check_list(above%list('load'), [12.0e3_wp, 6.0e3_wp], 'loads')
         call check_list(above%list('load_height'), [3.5_wp, 6.5_wp], 'their heights')
         call check_list(above%list('load_depth'), [0.2_wp], 'their depth')
         call check_list(above%list('load_seat'), [0.2_wp, 0.3_wp], 'their seats')
         call check(above%word('load_inertia') == 'vertical,both', 'their inertias')
         call check_list(above%list('inertia_mass'), [200.0_wp], 'masses')
         call check_list(above%list('inertia_height'), [2.0_wp], 'their heights')
         call check(.not. above%has('spring') .and. .not. above%has('spring_height'), 'no spring is left')
         call check_list(above%list('distributed_spring'), [2.0e3_wp], 'distributed_springs')
         call check_list(above%list('distributed_spring_bottom'), [0.0_wp], 'a bed is cut')
         call check_list(above%list('distributed_spring_top'), [2.0_wp], 'its top')
      end associate
      call input%set('hinge_level', [7.5_wp])
      wall = made(input)
      call check(wall%input%word('load_inertia') == 'both', 'one load is left')
      call input%set('hinge_level', [10.4_wp])
      call input%clear('load')
      call input%clear('load_height')
      call input%clear('load_depth')
      call input%clear('load_seat')
      call input%clear('load_inertia')
      wall = made(input)
      call check_list(wall%input%list('section_height'), [0.1_wp], 'little is left')
   end subroutine test_lists

   !> Check a list
   subroutine check_list(actual, expected, what)
      real(wp), intent(in) :: actual(:), expected(:)
      character(len=*), intent(in) :: what

      call check(size(actual) == size(expected), what//': as many')
      if (size(actual) /= size(expected)) return
      call check(.not. any(abs(actual - expected) > exact*max(1.0_wp, abs(expected))), what)
   end subroutine check_list

   !> A gable that is cut is a smaller gable
   subroutine test_gable()

      type(wall_input_type) :: input
      type(wall_type) :: wall

      call suite('a gable above a hinge')
      call input%set('mechanism', 'one_sided')
      call input%set('section_height', [6.0_wp, 3.0_wp])
      call input%set('section_thickness', [0.3_wp])
      call input%set('section_top_width', [1.0_wp, 0.0_wp])
      call input%set('hinge_level', [7.0_wp])
      wall = made(input)
      call check_list(wall%input%list('section_base_width'), [2.0_wp/3.0_wp], 'its width at the hinge')
      ! The multiplier of a gable is t/2 / (H/3)
      call check_close(wall%mechanism%trigger_acceleration()/g, 0.15_wp/(2.0_wp/3.0_wp), exact, 'its trigger')
   end subroutine test_gable

   !> The hinge is on its own floor
   subroutine test_building()

      type(wall_input_type) :: input
      type(wall_type) :: wall
      type(error_type), allocatable :: error

      call suite('floors of a building')
      input = facade('none')
      call input%set('period', [0.3_wp])
      call input%set('storeys', 3)
      call input%set('level', 0.0_wp)
      call input%set('building_height', 10.5_wp)
      call input%set('hinge_level', [7.5_wp])
      wall = made(input)
      call check_close(wall%building%participation(1), 9.0_wp/7.0_wp*7.5_wp/10.5_wp, exact, 'participation')
      call input%clear('storeys')
      call input%clear('level')
      call input%clear('building_height')
      call input%set('participation', [0.5_wp])
      call new_wall(wall, input, error)
      call check_error(error, 'participation: not with hinge_level = 7.5', 'participation of one level')
   end subroutine test_building

   !> Leaves rock alone
   subroutine test_leaves()

      type(wall_input_type) :: input
      type(wall_type) :: wall
      type(error_type), allocatable :: error

      call suite('leaves')
      call input%set('mechanism', 'one_sided')
      call input%set('height', 3.0_wp)
      call input%set('thickness', 0.25_wp)
      wall = made(input)
      call check_close(wall%mechanism%capacity, 0.0831412318884412_wp, exact, 'one wall')
      call input%set('leaves', 2)
      wall = made(input)
      call check_close(wall%model%alpha, 0.0416425790985884_wp, exact, 'slenderness of a leaf')
      call check_close(wall%mechanism%capacity, 0.0416425790985884_wp, exact, 'its capacity')
      call input%set('load', [1.0e3_wp])
      call input%set('load_depth', [0.1_wp])
      call input%set('load_height', [3.0_wp])
      call input%set('load_inertia', 'none')
      call new_wall(wall, input, error)
      call check_error(error, 'load: not with leaves = 2', 'leaves with a load')
      call input%set('leaves', 1.5_wp)
      call new_wall(wall, input, error)
      call check_error(error, 'leaves = 1.5: must be an integer', 'one leaf and a half')
   end subroutine test_leaves

   !> What cannot be
   subroutine test_wrong_input()

      type(wall_input_type) :: input
      type(wall_type) :: wall
      type(error_type), allocatable :: error

      call suite('wrong hinges')
      input = facade('none')
      call input%set('hinge_level', [10.5_wp])
      call new_wall(wall, input, error)
      call check_error(error, 'hinge_level = 10.5: must be less than the height of the wall, 10.5 m', 'above the wall')
      call input%set('hinge_level', [4.0_wp, 4.0_wp])
      call new_wall(wall, input, error)
      call check_error(error, 'hinge_level = 4: must be more than 4 before it', 'twice')
      call input%set('hinge_level', [-1.0_wp])
      call new_wall(wall, input, error)
      call check_error(error, 'hinge_level = -1', 'below the wall')
      call input%set('hinge_level', [0.0_wp, 4.0_wp])
      call new_wall(wall, input, error)
      call check_error(error, 'hinge_level: has 2 values', 'several for one wall')
      call input%set('hinge_at', 'storeys')
      call new_wall(wall, input, error)
      call check_error(error, 'give either hinge_at or hinge_level', 'both')
      input = wall_input_type()
      call input%set('mechanism', 'one_sided')
      call input%set('height', 3.0_wp)
      call input%set('thickness', 0.25_wp)
      call input%set('hinge_at', 'storeys')
      call new_wall(wall, input, error)
      call check_error(error, 'only with section_height', 'no storeys')
      call input%clear('hinge_at')
      call input%set('mechanism', 'two_block')
      call input%set('hinge_level', [1.0_wp])
      call new_wall(wall, input, error)
      call check_error(error, 'hinge_level = 1: only for mechanism = ''one_sided''', 'another mechanism')
   end subroutine test_wrong_input

   !> Write a table of walls
   subroutine write_table(lines)
      !> Its lines
      character(len=*), intent(in) :: lines(:)

      integer :: unit, i

      call execute_command_line('mkdir -p '//folder)
      open (newunit=unit, file=table, action='write', status='replace')
      do i = 1, size(lines)
         write (unit, '(a)') trim(lines(i))
      end do
      close (unit)
   end subroutine write_table

   !> Rows of a population with hinges, and rows of one facade
   subroutine test_rows()

      character(len=*), parameter :: lines(6) = [character(len=80) :: &
         & 'name,mechanism,height,thickness,hinge1_level,hinge2_level,weight,facade,p_occ', &
         & 'a,one_sided,3,0.3,,,1,,1', &
         & 'b,one_sided,6,0.4,0,2.5,2,,1', &
         & 'outer,one_sided,3,0.12,,,1,leaves,1', &
         & 'inner,one_sided,3,0.12,,,1,leaves,1', &
         & 'inner,two_block,3,0.12,,,1,leaves,0.5']
      type(wall_row_type), allocatable :: rows(:)
      type(population_table_type) :: walls
      type(population_reader_type) :: reader
      type(wall_row_type) :: row
      type(error_type), allocatable :: error
      logical :: found

      call suite('rows of facades')
      call write_table(lines)
      call read_population(table, rows, error)
      call check_ok(error, 'the table is right')
      if (allocated(error)) return
      call check(size(rows) == 6, 'a row with two hinges is two')
      if (size(rows) /= 6) return
      call check(rows(1)%wall%name() == 'a' .and. rows(1)%facade == '', 'no facade')
      call check(rows(2)%wall%name() == 'b at 0 m' .and. rows(2)%facade == 'b', 'its first hinge')
      call check(rows(3)%wall%name() == 'b at 2.5 m' .and. rows(3)%facade == 'b', 'its second hinge')
      call check_close(rows(3)%wall%input%number('height'), 3.5_wp, exact, 'the wall above')
      call check_close(rows(3)%weight, 2.0_wp, exact, 'its weight')
      call check(all(rows%continues .eqv. [.false., .false., .true., .false., .true., .true.]), 'who goes on')
      call walls%read(table, error)
      call check_ok(error, 'the table is read')
      call reader%skip(walls, 2, error)
      call reader%next(walls, row, found, error)
      call check(found .and. row%wall%name() == 'b at 2.5 m' .and. row%continues, 'rows can be passed over')
   end subroutine test_rows

   !> Rows that do not go together
   subroutine test_wrong_rows()

      character(len=*), parameter :: head = 'name,mechanism,height,thickness,hinge1_level,hinge2_level,weight,facade'

      call suite('wrong rows of facades')
      call check_rows([character(len=80) :: head, 'a,one_sided,3,0.3,0,3,1,'], &
         & 'line 2: hinge_level = 3: must be less than the height')
      call check_rows([character(len=80) :: head, 'a,one_sided,-3,0.3,0,1,1,'], 'line 2: height = -3: must be positive')
      call check_rows([character(len=80) :: head, 'a,one_sided,3,0.3,,,1,f', 'b,one_sided,3,0.3,,,2,f'], &
         & 'line 3: weight = 2: must be 1 as in the row before, which is of the same facade')
      call check_rows([character(len=80) :: head, 'a,one_sided,3,0.3,,,1,f', 'a,one_sided,3,0.2,,,1,f'], &
         & 'line 3: name = ''a'': the row before gives this wall the same mechanism')
      call check_rows([character(len=80) :: head, 'a,one_sided,3,0.3,,,1,f', 'b,one_sided,3,0.3,,,1,', &
         & 'c,one_sided,3,0.3,,,1,f'], 'line 4: facade = ''f'': another facade has this name (line 2)')
      call check_rows([character(len=80) :: head, 'a,one_sided,3,0.3,0,1,1,', 'a at 1 m,one_sided,3,0.3,,,1,'], &
         & 'line 3: name = ''a at 1 m'': another wall has this name (line 2)')
   end subroutine test_wrong_rows

   !> Check that a table is refused with one line
   subroutine check_rows(lines, part)
      !> Its lines
      character(len=*), intent(in) :: lines(:)
      !> What the message says
      character(len=*), intent(in) :: part

      type(wall_row_type), allocatable :: rows(:)
      type(error_type), allocatable :: error

      call write_table(lines)
      call read_population(table, rows, error)
      call check_error(error, part, part)
      if (allocated(error)) call check(index(error%message, new_line('a')) == 0, part//': once')
   end subroutine check_rows

   !> A facade without a table
   subroutine test_given_facade()

      type(base_wall_type) :: input
      type(population_table_type) :: table
      type(population_reader_type) :: reader
      type(wall_row_type) :: row
      type(error_type), allocatable :: error
      logical :: found
      integer :: rows

      call suite('a facade alone')
      input%wall_input_type = facade('both')
      call input%set('name', 'F')
      call input%set('hinge_at', 'storeys')
      table%file = 'case.nml'
      table%base_wall = input
      rows = 0
      do
         call reader%next(table, row, found, error)
         call check_ok(error, 'a row')
         if (.not. found .or. allocated(error)) exit
         rows = rows + 1
         call check(row%facade == 'F' .and. (row%continues .eqv. rows > 1), 'one facade')
      end do
      call check(rows == 3, 'a hinge at each storey')
   end subroutine test_given_facade

end program test_facade
