!> A population of walls: a CSV table with one row a mechanism of a wall, its columns those of &wall, and weight, group
!> and p_occ.
!>
!> A cell that is empty was not given. A wall without a name is called 'wall' with the number of its row. Rows with the
!> same name are mechanisms of the same wall; they stand one after the other.
module dondolo_population
   use dondolo_csv, only : csv_table_type, read_csv
   use dondolo_error, only : add_place, error_type, raise_input
   use dondolo_kinds, only : wp
   use dondolo_lines, only : line_type
   use dondolo_text, only : join, lower, to_text
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   use dondolo_wall_group, only : set_wall_number, set_wall_text, wall_numbers, wall_texts, wall_variables
   implicit none
   private

   public :: population_type, read_population

   !> Columns besides the variables of a wall
   character(len=6), parameter :: own_columns(3) = [character(len=6) :: 'weight', 'group', 'p_occ']

   !> Walls and what each stands for
   type :: population_type
      !> The walls
      type(wall_type), allocatable :: walls(:)
      !> Weight of each, >= 0, not all 0
      real(wp), allocatable :: weight(:)
      !> Probability that its mechanism can occur
      real(wp), allocatable :: p_occ(:)
      !> Name of its group, empty if none was given
      type(line_type), allocatable :: group(:)
   contains
      !> The last row of a wall
      procedure :: last_row
      !> How many walls there are, however many mechanisms each has
      procedure :: number_of_walls
   end type population_type

contains

   !> Read a population
   subroutine read_population(file, population, error, gravity)
      !> Path of the table
      character(len=*), intent(in) :: file
      !> The population
      type(population_type), intent(out) :: population
      !> The table or one of its walls is wrong
      type(error_type), allocatable, intent(out) :: error
      !> Gravity [m/s2], standard if absent
      real(wp), intent(in), optional :: gravity

      type(csv_table_type) :: table
      type(wall_input_type) :: input
      integer :: row

      call read_csv(file, table, error)
      if (allocated(error)) return
      call check_columns(table, error)
      if (allocated(error)) return
      allocate (population%walls(table%rows()), population%weight(table%rows()), population%p_occ(table%rows()), &
         & population%group(table%rows()))
      do row = 1, table%rows()
         call read_row(table, row, input, population%weight(row), population%p_occ(row), error)
         if (allocated(error)) return
         population%group(row)%text = table%get_text(row, table%column('group'))
         call check_line('name', input%name)
         if (.not. allocated(error)) call check_line('group', population%group(row)%text)
         if (allocated(error)) return
         call new_wall(population%walls(row), input, error, gravity)
         call add_place(error, table%place(row))
         if (allocated(error)) return
         call check_name(population, row, error)
         call add_place(error, table%place(row))
         if (allocated(error)) return
      end do
      if (.not. any(population%weight > 0.0_wp)) &
         & call raise_input(error, file//': weight: must be positive for at least one wall')

   contains

      !> Check that a text stands on one line
      subroutine check_line(name, text)
         !> Name of its column
         character(len=*), intent(in) :: name
         !> The text
         character(len=*), intent(in) :: text

         if (scan(text, new_line('a')//achar(13)) > 0) &
            & call raise_input(error, table%place(row)//': '//name//': must stand on one line')
      end subroutine check_line

   end subroutine read_population

   !> The last row of a wall
   pure integer function last_row(self, first)
      !> The population
      class(population_type), intent(in) :: self
      !> The first row of the wall
      integer, intent(in) :: first

      do last_row = first, size(self%walls) - 1
         if (self%walls(last_row + 1)%input%name /= self%walls(first)%input%name) exit
      end do
   end function last_row

   !> How many walls there are, however many mechanisms each has
   pure integer function number_of_walls(self)
      !> The population
      class(population_type), intent(in) :: self

      integer :: row

      number_of_walls = 0
      row = 0
      do while (row < size(self%walls))
         row = self%last_row(row + 1)
         number_of_walls = number_of_walls + 1
      end do
   end function number_of_walls

   !> Check a row against those before it: another mechanism of the wall before, or a new wall
   subroutine check_name(population, row, error)
      !> The walls up to this row
      type(population_type), intent(in) :: population
      !> Number of the row
      integer, intent(in) :: row
      !> The name stands elsewhere too, or what is said of the wall differs
      type(error_type), allocatable, intent(out) :: error

      integer :: other
      logical :: next_to_it

      next_to_it = .true.
      associate (name => population%walls(row)%input%name)
         do other = row - 1, 1, -1
            if (population%walls(other)%input%name /= name) then
               next_to_it = .false.
               cycle
            end if
            if (.not. next_to_it) then
               call raise_input(error, 'name = '''//name//''': another wall has this name; mechanisms of one wall '// &
                  & 'must stand in rows one after the other')
            else if (population%walls(other)%input%mechanism == population%walls(row)%input%mechanism) then
               call raise_input(error, 'name = '''//name//''': another row gives this wall the same mechanism')
            else if (abs(population%weight(other) - population%weight(row)) > 0.0_wp) then
               call raise_input(error, 'weight = '//to_text(population%weight(row))//': must be '// &
                  & to_text(population%weight(other))//' as in the row before, which is of the same wall')
            else if (population%group(other)%text /= population%group(row)%text) then
               call raise_input(error, 'group = '''//population%group(row)%text//''': must be '''// &
                  & population%group(other)%text//''' as in the row before, which is of the same wall')
            end if
            if (allocated(error)) return
         end do
      end associate
   end subroutine check_name

   !> Check the names of the columns
   subroutine check_columns(table, error)
      !> The table
      type(csv_table_type), intent(in) :: table
      !> A column that does not exist, or no walls
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      do i = 1, size(table%columns)
         if (any(lower(table%columns(i)%text) == wall_variables)) cycle
         if (any(lower(table%columns(i)%text) == own_columns)) cycle
         call raise_input(error, table%file//': column '''//table%columns(i)%text//''': no such column; there are '// &
            & join(wall_variables)//', '//join(own_columns))
         return
      end do
      if (table%rows() == 0) call raise_input(error, table%file//': no walls under the header')
   end subroutine check_columns

   !> Read what one row says of a wall
   subroutine read_row(table, row, input, weight, p_occ, error)
      !> The table
      type(csv_table_type), intent(in) :: table
      !> Number of the row
      integer, intent(in) :: row
      !> What is said of the wall
      type(wall_input_type), intent(out) :: input
      !> Its weight
      real(wp), intent(out) :: weight
      !> Probability that its mechanism can occur
      real(wp), intent(out) :: p_occ
      !> A cell that is not a number, a weight or a probability out of range
      type(error_type), allocatable, intent(out) :: error

      real(wp), parameter :: largest_weight = 1.0e12_wp
      real(wp) :: number
      integer :: i

      input%name = 'wall '//to_text(row)
      do i = 1, size(wall_texts)
         if (given(wall_texts(i))) &
            & call set_wall_text(input, wall_texts(i), table%get_text(row, table%column(trim(wall_texts(i)))))
      end do
      do i = 1, size(wall_numbers)
         if (.not. given(wall_numbers(i))) cycle
         call table%get_real(row, table%column(trim(wall_numbers(i))), number, error)
         if (allocated(error)) return
         call set_wall_number(input, wall_numbers(i), number)
      end do
      call read_share('weight', weight, largest_weight)
      if (.not. allocated(error)) call read_share('p_occ', p_occ, 1.0_wp)

   contains

      !> Read a number that is 1 where it was not given
      subroutine read_share(name, share, largest)
         !> Name of the column
         character(len=*), intent(in) :: name
         !> The number
         real(wp), intent(out) :: share
         !> The largest that is allowed; the smallest is 0
         real(wp), intent(in) :: largest

         share = 1.0_wp
         if (.not. given(name)) return
         call table%get_real(row, table%column(name), share, error)
         if (allocated(error)) return
         if (.not. (share >= 0.0_wp .and. share <= largest)) call raise_input(error, table%place(row)//': '//name// &
            & ' = '//to_text(share)//': must lie between 0 and '//to_text(largest))
      end subroutine read_share

      !> Is there such a column, and does this row have something in it?
      logical function given(name)
         !> Name of the column
         character(len=*), intent(in) :: name

         given = len_trim(table%get_text(row, table%column(trim(name)))) > 0
      end function given

   end subroutine read_row

end module dondolo_population
