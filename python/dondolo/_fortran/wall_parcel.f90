!> Walls across the boundary: a line for each text and numbers with a mask of those given, in the order of their table.
module dondolo_wall_parcel
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use dondolo_base_error, only : add_place, error_type, raise_input
   use dondolo_base_lines, only : lines_type
   use dondolo_base_property, only : is_list, is_text, is_words
   use dondolo_base_text, only : to_text
   use dondolo_boundary, only : check_room, next_line
   use dondolo_interface_wall_statics, only : static_names, statics_of
   use dondolo_parcel, only : parcel_type
   use dondolo_population_wall_row, only : wall_row_type
   use dondolo_wall, only : new_wall, wall_type
   use dondolo_wall_properties, only : wall_input_type, wall_numbers, wall_properties
   use dondolo_wall_table, only : take_table
   implicit none
   private

   public :: set_walls, pack_walls, pack_rows

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
      integer :: i, k, at, number, next

      if (size(given, 1) /= wall_numbers) then
         call raise_input(error, 'walls: '//to_text(size(given, 1))//' numbers each: must be '//to_text(wall_numbers))
         return
      end if
      if (any(given < 0) .or. sum(given) > size(numbers)) then
         call raise_input(error, 'walls: '//to_text(size(numbers))//' numbers: must be '//to_text(int(sum(given))))
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

   !> Walls as they were understood: names, numbers and static quantities
   subroutine pack_walls(walls, parcel)
      !> The walls
      type(wall_type), intent(in) :: walls(:)
      !> Of each wall walls_given, how many values each of its numbers has, walls_two_sided, walls_statics, the static quantities,
      !> and walls_texts, one after the other; walls_values: the values of all walls
      type(parcel_type), intent(inout) :: parcel

      integer, parameter :: wall_reals = size(static_names)
      integer(c_int), allocatable :: integers(:, :), two_sided(:)
      type(lines_type) :: texts
      real(c_double), allocatable :: reals(:, :), values(:)
      integer, allocatable :: lengths(:)
      integer :: i, k, number, next

      allocate (integers(wall_numbers, size(walls)), two_sided(size(walls)), reals(wall_reals, size(walls)), values(16*size(walls)))
      next = 1
      do i = 1, size(walls)
         associate (input => walls(i)%input, mechanism => walls(i)%mechanism)
            number = 0
            lengths = input%lengths()
            if (next + sum(lengths) > size(values)) values = [values, spread(0.0_c_double, 1, sum(lengths) + size(values))]
            do k = 1, size(wall_properties)
               associate (property => wall_properties(k))
                  if (property%kind == is_text .or. property%kind == is_words) then
                     call texts%add(input%word(property%name))
                     cycle
                  end if
                  number = number + 1
                  integers(number, i) = lengths(k)
                  if (lengths(k) == 0) cycle
                  if (property%kind == is_list) values(next:next + lengths(k) - 1) = input%list(property%name)
                  if (property%kind /= is_list) values(next) = input%number(property%name)
                  next = next + lengths(k)
               end associate
            end do
            two_sided(i) = merge(1, 0, mechanism%two_sided)
            reals(:, i) = statics_of(walls(i))
         end associate
      end do
      call parcel%put('walls_given', reshape(integers, [size(integers)]), shape(integers))
      call parcel%put('walls_two_sided', two_sided)
      call parcel%put('walls_statics', reshape(reals, [size(reals)]), shape(reals))
      call parcel%put('walls_values', values(:next - 1))
      call parcel%put('walls_texts', texts)
   end subroutine pack_walls

   !> Rows of a population: walls as they were understood, weights, probabilities of their mechanisms, how these occur, groups
   !> and facades
   subroutine pack_rows(rows, parcel)
      !> The rows
      type(wall_row_type), intent(in) :: rows(:)
      !> Has walls_weight, walls_p_occ, walls_occurrence, walls_alternative, walls_group and walls_facade too
      type(parcel_type), intent(inout) :: parcel

      type(wall_type), allocatable :: walls(:)
      type(lines_type) :: occurrence, alternatives, groups, facades
      integer :: i

      allocate (walls(size(rows)))
      do i = 1, size(rows)
         walls(i) = rows(i)%wall
      end do
      call pack_walls(walls, parcel)
      do i = 1, size(rows)
         call occurrence%add(trim(rows(i)%occurrence))
         call alternatives%add(rows(i)%alternative)
         call groups%add(rows(i)%group)
         call facades%add(rows(i)%facade)
      end do
      call parcel%put('walls_weight', rows%weight)
      call parcel%put('walls_p_occ', rows%p_occ)
      call parcel%put('walls_occurrence', occurrence)
      call parcel%put('walls_alternative', alternatives)
      call parcel%put('walls_group', groups)
      call parcel%put('walls_facade', facades)
   end subroutine pack_rows

end module dondolo_wall_parcel
