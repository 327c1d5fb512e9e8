!> The files that a chain of rigid bodies has its bodies, joints, actions and ties from, read where a wall is read.
!>
!> CSV tables with a unit in brackets in the name of each column that has one: 'depth [m]'. Rows become numbers
!> (dondolo_wall_chain_input); cells that are empty are 0.
module dondolo_population_chain_files
   use dondolo_base_error, only : add_place, error_type, not_a_word, not_given, not_together, raise_input, unknown_name
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : join, lower
   use dondolo_files_csv_reader, only : csv_row_type, csv_table_type
   use dondolo_files_paths, only : beside
   use dondolo_wall_chain_input, only : action_numbers, body_numbers, is_corner, is_mass, is_sector, joint_numbers
   use dondolo_wall_chain_ties, only : tie_numbers
   use dondolo_wall_properties, only : wall_input_type
   implicit none
   private

   public :: take_chain

   !> Columns of the four files, each with its unit
   character(len=16), parameter :: body_columns(*) = [character(len=16) :: 'body', 'part', 'width [m]', 'density [kg/m3]', &
      & 'depth [m]', 'height [m]', 'mass [kg]', 'inertia [kg m2]', 'inner [m]', 'outer [m]', 'from [deg]', 'to [deg]']
   character(len=16), parameter :: joint_columns(*) = [character(len=16) :: 'type', 'body', 'other', 'depth [m]', 'height [m]', &
      & 'angle [deg]', 'other_depth [m]', 'other_height [m]']
   character(len=16), parameter :: action_columns(*) = [character(len=16) :: 'body', 'depth [m]', 'height [m]', 'load [N]', &
      & 'inertia', 'held', 'mass [kg]', 'thrust [N]', 'angle [deg]']
   character(len=16), parameter :: tie_columns(*) = [character(len=16) :: 'body', 'other', 'depth [m]', 'height [m]', &
      & 'angle [deg]', 'other_depth [m]', 'other_height [m]', 'area [m2]', 'length [m]', 'modulus [Pa]', 'strength [Pa]', &
      & 'preload [Pa]', 'strain', 'anchor_force [N]']

   !> Columns of words, and the numbers that these become: those of a row are told apart by which column they are of
   character(len=8), parameter :: types(*) = [character(len=8) :: 'guide', 'pin'], answers(*) = [character(len=8) :: 'no', 'yes'], &
      & inertias(*) = [character(len=8) :: 'none', 'vertical', 'both']

contains

   !> Take a chain out of the files that a wall names
   subroutine take_chain(input, file, error)
      !> Input of the wall; out: lists take the place of the files, whose paths are kept
      class(wall_input_type), intent(inout) :: input
      !> The file whose folder the paths are relative to; empty: the current folder
      character(len=*), intent(in) :: file
      !> No such file, or a table of something else
      type(error_type), allocatable, intent(out) :: error

      real(wp), allocatable :: rows(:, :)

      call take('bodies', 'body_table', body_columns, [1, 5, 6])
      if (.not. allocated(error) .and. allocated(rows)) call input%set('body_table', [numbers_of_bodies(rows)])
      call take('joints', 'joint_table', joint_columns, [1, 2, 3, 4, 5])
      if (.not. allocated(error) .and. allocated(rows)) call input%set('joint_table', [numbers_of_joints(rows)])
      call take('actions', 'action_table', action_columns, [1, 2, 3])
      if (.not. allocated(error) .and. allocated(rows)) call input%set('action_table', [numbers_of_actions(rows)])
      call take('ties', 'tie_table', tie_columns, [1, 3, 4, 8, 9])
      if (.not. allocated(error) .and. allocated(rows)) call input%set('tie_table', [numbers_of_ties(rows, input)])

   contains

      !> Read a file
      subroutine take(name, list, columns, needed)
         !> Its property, and the list that takes its place
         character(len=*), intent(in) :: name, list
         !> Columns that it may have, and numbers of those that it must have
         character(len=*), intent(in) :: columns(:)
         integer, intent(in) :: needed(:)

         character(len=:), allocatable :: path

         if (allocated(rows)) deallocate (rows)
         if (allocated(error)) return
         if (.not. input%has(name)) return
         if (input%has(list)) then
            call raise_input(error, list//': give either it or '//name, not_together, list)
            return
         end if
         path = beside(input%word(name), file)
         call read_rows(path, columns, needed, rows, error)
         call add_place(error, name)
         if (allocated(error)) return
         call input%clear(name)
         call input%chain_files%add(path)
      end subroutine take

   end subroutine take_chain

   !> Read the rows of a file
   subroutine read_rows(path, columns, needed, rows, error)
      character(len=*), intent(in) :: path
      !> Columns that it may have, and numbers of those that it must have
      character(len=*), intent(in) :: columns(:)
      integer, intent(in) :: needed(:)
      !> A number for each column (column, row), of words their place among what is allowed, less 1
      real(wp), allocatable, intent(out) :: rows(:, :)
      !> No table, or one of something else
      type(error_type), allocatable, intent(out) :: error

      type(csv_table_type) :: table
      type(csv_row_type) :: row
      real(wp) :: values(size(columns))
      integer :: at(size(columns)), i, k
      logical :: found

      call table%read(path, error)
      if (allocated(error)) return
      do i = 1, size(table%columns)
         if (any([(lower(trim(columns(k))) == lower(table%columns(i)%text), k=1, size(columns))])) cycle
         call raise_input(error, path//': column '''//table%columns(i)%text//''': must be one of '//join(columns), unknown_name, &
            & table%columns(i)%text)
         return
      end do
      at = [(table%column(trim(columns(i))), i=1, size(columns))]
      if (any(at(needed) == 0)) then
         i = needed(findloc(at(needed), 0, dim=1))
         call raise_input(error, path//': column '''//trim(columns(i))//''': must be given', not_given, trim(columns(i)))
         return
      end if
      call table%find_decimal_mark(pack(at, at > 0 .and. [(.not. is_word(columns(i)), i=1, size(columns))]))
      allocate (rows(size(columns), 0))
      do
         call table%next(row, found, error)
         if (allocated(error) .or. .not. found) return
         values = 0.0_wp
         do i = 1, size(columns)
            if (at(i) == 0) cycle
            if (len(row%get_text(at(i))) == 0) then
               ! Body 0 stands still, so that it must be said which it is.
               if (columns(i) /= 'body') cycle
               call raise_input(error, 'body: must be given in each row', not_given, 'body')
               call add_place(error, table%place(row))
               return
            end if
            if (is_word(columns(i))) then
               call take_word(trim(columns(i)), row%get_text(at(i)), values(i), error)
            else
               call table%get_real(row, at(i), values(i), error)
            end if
            call add_place(error, table%place(row))
            if (allocated(error)) return
         end do
         rows = reshape([rows, values], [size(columns), size(rows, 2) + 1])
      end do
   end subroutine read_rows

   !> Has a column words? 'inertia' alone is one of loads, that of bodies has a unit
   pure logical function is_word(column)
      character(len=*), intent(in) :: column

      is_word = any(column == [character(len=7) :: 'type', 'inertia', 'held'])
   end function is_word

   !> Place of a word among those that a column has, less 1
   subroutine take_word(column, word, value, error)
      character(len=*), intent(in) :: column, word
      real(wp), intent(out) :: value
      !> Another word
      type(error_type), allocatable, intent(out) :: error

      select case (column)
      case ('type')
         call find(types)
      case ('held')
         call find(answers)
      case default
         call find(inertias)
      end select

   contains

      subroutine find(words)
         character(len=*), intent(in) :: words(:)

         value = real(findloc(words == lower(word), .true., dim=1) - 1, wp)
         if (value < 0.0_wp) call raise_input(error, column//' = '''//word//''': must be one of '//join(words), not_a_word, column)
      end subroutine find

   end subroutine take_word

   !> Rows of bodies: of a mass, of a sector, else of a corner
   pure function numbers_of_bodies(rows) result(numbers)
      real(wp), intent(in) :: rows(:, :)
      real(wp) :: numbers(body_numbers, size(rows, 2))

      integer :: i

      do i = 1, size(rows, 2)
         associate (row => rows(:, i))
            numbers(:, i) = [row(1:2), real(is_corner, wp), row(3:6), 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]
            if (row(7) > 0.0_wp) numbers(3:, i) = [real(is_mass, wp), 0.0_wp, 0.0_wp, row(5:8), 0.0_wp, 0.0_wp]
            if (row(10) > 0.0_wp) numbers(3:, i) = [real(is_sector, wp), row(3:6), row(9:12)]
         end associate
      end do
   end function numbers_of_bodies

   !> Rows of joints: a pin has two equations, a guide one; the points of both bodies are one unless the second is given
   pure function numbers_of_joints(rows) result(numbers)
      real(wp), intent(in) :: rows(:, :)
      real(wp) :: numbers(joint_numbers, size(rows, 2))

      numbers = rows
      numbers(1, :) = rows(1, :) + 1.0_wp
      where (.not. abs(rows(7, :)) + abs(rows(8, :)) > 0.0_wp)
         numbers(7, :) = rows(4, :)
         numbers(8, :) = rows(5, :)
      end where
   end function numbers_of_joints

   !> Rows of actions
   pure function numbers_of_actions(rows) result(numbers)
      real(wp), intent(in) :: rows(:, :)
      real(wp) :: numbers(action_numbers, size(rows, 2))

      numbers(:4, :) = rows(:4, :)
      numbers(5, :) = merge(1.0_wp, 0.0_wp, rows(5, :) > 0.5_wp)
      numbers(6, :) = merge(1.0_wp, 0.0_wp, rows(5, :) > 1.5_wp)
      numbers(7, :) = rows(7, :)
      numbers(8:9, :) = rows(8:9, :)
      numbers(10, :) = rows(6, :)
   end function numbers_of_actions

   !> Rows of ties: what the table does not say of a bar is what ties of other walls have
   function numbers_of_ties(rows, input) result(numbers)
      real(wp), intent(in) :: rows(:, :)
      type(wall_input_type), intent(in) :: input
      real(wp) :: numbers(tie_numbers, size(rows, 2))

      character(len=*), parameter :: names(3) = [character(len=12) :: 'tie_modulus', 'tie_strength', 'tie_strain']
      integer, parameter :: places(3) = [10, 11, 13]
      real(wp) :: usual
      integer :: i, k

      numbers = rows
      do i = 1, size(names)
         usual = input%absent(trim(names(i)))
         do k = 1, size(rows, 2)
            if (.not. abs(rows(places(i), k)) > 0.0_wp) numbers(places(i), k) = usual
         end do
      end do
   end function numbers_of_ties

end module dondolo_population_chain_files
