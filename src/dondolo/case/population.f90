!> A population of walls: a CSV table with one row a wall, its columns those of &wall, and weight.
!>
!> A cell that is empty was not given. A wall without a name is called 'wall' with the number of its row.
module dondolo_population
   use dondolo_csv, only : csv_table_type, read_csv
   use dondolo_error, only : add_place, error_type, raise_input
   use dondolo_kinds, only : wp
   use dondolo_text, only : join, lower, to_text
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   use dondolo_wall_group, only : set_wall_number, set_wall_text, wall_numbers, wall_texts, wall_variables
   implicit none
   private

   public :: population_type, read_population

   !> Walls and what each stands for
   type :: population_type
      !> The walls
      type(wall_type), allocatable :: walls(:)
      !> Weight of each, >= 0, not all 0
      real(wp), allocatable :: weight(:)
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
      integer :: row, other

      call read_csv(file, table, error)
      if (allocated(error)) return
      call check_columns(table, error)
      if (allocated(error)) return
      allocate (population%walls(table%rows()), population%weight(table%rows()))
      do row = 1, table%rows()
         call read_row(table, row, input, population%weight(row), error)
         if (allocated(error)) return
         if (scan(input%name, new_line('a')//achar(13)) > 0) then
            call raise_input(error, table%place(row)//': name: must stand on one line')
            return
         end if
         call new_wall(population%walls(row), input, error, gravity)
         call add_place(error, table%place(row))
         if (allocated(error)) return
         do other = 1, row - 1
            if (population%walls(other)%input%name /= input%name) cycle
            call raise_input(error, table%place(row)//': name = '''//input%name//''': another wall has this name')
            return
         end do
      end do
      if (.not. any(population%weight > 0.0_wp)) &
         & call raise_input(error, file//': weight: must be positive for at least one wall')
   end subroutine read_population

   !> Check the names of the columns
   subroutine check_columns(table, error)
      !> The table
      type(csv_table_type), intent(in) :: table
      !> A column that does not exist, or no walls
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      do i = 1, size(table%columns)
         if (any(lower(table%columns(i)%text) == wall_variables)) cycle
         if (lower(table%columns(i)%text) == 'weight') cycle
         call raise_input(error, table%file//': column '''//table%columns(i)%text//''': no such column; there are '// &
            & join(wall_variables)//', ''weight''')
         return
      end do
      if (table%rows() == 0) call raise_input(error, table%file//': no walls under the header')
   end subroutine check_columns

   !> Read what one row says of a wall
   subroutine read_row(table, row, input, weight, error)
      !> The table
      type(csv_table_type), intent(in) :: table
      !> Number of the row
      integer, intent(in) :: row
      !> What is said of the wall
      type(wall_input_type), intent(out) :: input
      !> Its weight
      real(wp), intent(out) :: weight
      !> A cell that is not a number, or a weight out of range
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
      weight = 1.0_wp
      if (.not. given('weight')) return
      call table%get_real(row, table%column('weight'), weight, error)
      if (allocated(error)) return
      if (.not. (weight >= 0.0_wp .and. weight <= largest_weight)) call raise_input(error, table%place(row)// &
         & ': weight = '//to_text(weight)//': must lie between 0 and '//to_text(largest_weight))

   contains

      !> Is there such a column, and does this row have something in it?
      logical function given(name)
         !> Name of the column
         character(len=*), intent(in) :: name

         given = len_trim(table%get_text(row, table%column(trim(name)))) > 0
      end function given

   end subroutine read_row

end module dondolo_population
