!> The files that walls have their terms from, a table or those of a chain, read where a wall is read; a wall itself opens no file.
!>
!> A CSV table with a unit in the name of each column: 'rotation [mrad]', 'moment [kN m/m]'. In place of rotation it may have
!> 'power': its rows are then the coefficients of polynomials in the rotation, in rad, and the wall says how far they go.
module dondolo_population_wall_table
   use dondolo_base_error, only : add_place, error_type, not_given, not_together, out_of_range, raise_input, unknown_name
   use dondolo_base_kinds, only : pi, wp
   use dondolo_base_text, only : join, lower, to_text
   use dondolo_files_csv_row, only : cell_type
   use dondolo_files_number_table, only : read_number_table
   use dondolo_files_paths, only : beside
   use dondolo_population_chain_files, only : take_chain
   use dondolo_wall_properties, only : wall_input_type
   use dondolo_wall_tabulated_model, only : check_column_names, term_names
   implicit none
   private

   public :: take_table

   !> Names of the columns: the terms, and those for checks
   character(len=14), parameter :: column_names(*) = [term_names, check_column_names]

   !> Name of the column of powers
   character(len=*), parameter :: power_name = 'power'

   !> A unit that a column may have
   type :: unit_type
      !> Column
      character(len=14) :: column
      !> The unit, without blanks and without '/m' at its end, in lower case but for the letter of its factor
      character(len=6) :: unit
      !> How many units of the program it is
      real(wp) :: factor
   end type unit_type

   !> Units of the columns
   type(unit_type), parameter :: units(*) = [unit_type('rotation', 'rad', 1.0_wp), unit_type('rotation', 'mrad', 1.0e-3_wp), &
      & unit_type('rotation', 'deg', pi/180.0_wp), unit_type('inertia', 'kgm2', 1.0_wp), unit_type('inertia', 'tm2', 1.0e3_wp), &
      & unit_type('lever', 'kgm', 1.0_wp), unit_type('lever', 'tm', 1.0e3_wp), unit_type('moment', 'Nm', 1.0_wp), &
      & unit_type('moment', 'kNm', 1.0e3_wp), unit_type('vertical_lever', 'kgm', 1.0_wp), &
      & unit_type('vertical_lever', 'tm', 1.0e3_wp), unit_type('travel', 'm', 1.0_wp), unit_type('travel', 'mm', 1.0e-3_wp), &
      & unit_type('weighted_lever', 'Nm', 1.0_wp), unit_type('weighted_lever', 'kNm', 1.0e3_wp)]

   !> Points that polynomials of powers are given at, beyond their degree
   integer, parameter :: more_points = 8

contains

   !> Take the terms of a wall out of the file that it names, or a chain out of its files
   subroutine take_table(input, file, error)
      !> Input of the wall; out: the terms are lists in place of the file, whose path is kept
      class(wall_input_type), intent(inout) :: input
      !> The file whose folder the path is relative to; empty: the current folder
      character(len=*), intent(in) :: file
      !> No such file, or a table of something else
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: path, note
      type(cell_type), allocatable :: columns(:)
      real(wp), allocatable :: values(:, :)
      integer :: at(0:size(column_names)), i

      call take_chain(input, file, error)
      if (allocated(error) .or. .not. input%has('table')) return
      path = beside(input%word('table'), file)
      do i = 2, size(column_names)
         if (.not. input%has(trim(column_names(i)))) cycle
         call raise_input(error, trim(column_names(i))//': give either it or table', not_together, trim(column_names(i)))
         return
      end do
      call read_number_table(path, columns, values, note, error)
      if (.not. allocated(error)) then
         call find_columns(columns, values, at, error)
         if (.not. allocated(error)) call set_terms(input, values, at, error)
         call add_place(error, path)
      end if
      call add_place(error, 'table')
      if (allocated(error)) return
      call input%clear('table')
      input%table_file = path
   end subroutine take_table

   !> Find the columns, and turn their units into those of the program
   subroutine find_columns(columns, values, at, error)
      !> Names of the columns
      type(cell_type), intent(in) :: columns(:)
      !> Values (columns, rows)
      real(wp), intent(inout) :: values(:, :)
      !> Columns of the powers and of the terms; 0 where there is none
      integer, intent(out) :: at(0:)
      !> A column that has no unit, or another one; one too many, or missing
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: name, unit
      integer :: i, k, term

      at = 0
      do i = 1, size(columns)
         associate (head => columns(i)%text)
            k = scan(head, '([') - 1
            if (k < 0) k = len(head)
            name = lower(trim(head(:k)))
            call plain_unit(head(k + 1:), unit)
            term = findloc(column_names == name, .true., dim=1)
            if (term == 0 .and. name /= power_name) then
               call raise_input(error, 'column '''//head//''': must be one of '//join([column_names, [character(len=14) :: &
                  & power_name]]), unknown_name, head)
               return
            end if
            if (at(term) > 0) then
               call raise_input(error, 'column '''//head//''': the table has '//name//' twice')
               return
            end if
            at(term) = i
            if (term == 0) cycle
            k = findloc(units%column == name .and. units%unit == unit, .true., dim=1)
            if (k == 0) then
               call raise_input(error, 'column '''//head//''': must have its unit in brackets, '//name//' ['// &
                  & trim(shown_unit(term, 1))//'] or '//name//' ['//trim(shown_unit(term, 2))//']')
               return
            end if
            values(i, :) = units(k)%factor*values(i, :)
         end associate
      end do
      if (at(0) > 0 .and. at(1) > 0) call raise_input(error, 'columns rotation and power: the table must have one of them')
      do i = 1, size(term_names) - 1
         if (at(i) > 0 .or. (i == 1 .and. at(0) > 0) .or. allocated(error)) cycle
         call raise_input(error, 'column '''//trim(column_names(i))//' ['//trim(shown_unit(i, 1))//']'': must be given', &
            & not_given, trim(column_names(i)))
      end do
   end subroutine find_columns

   !> A unit as it is looked for: without brackets, blanks and signs of a product, and without '/m' at its end
   pure subroutine plain_unit(text, unit)
      !> What stands behind the name of a column
      character(len=*), intent(in) :: text
      !> The unit
      character(len=:), allocatable, intent(out) :: unit

      integer :: i

      unit = ''
      do i = 1, len(text)
         if (scan(text(i:i), '()[] *.^') == 0) unit = unit//text(i:i)
      end do
      i = len(unit)
      if (i > 2) then
         if (unit(i - 1:) == '/m') unit = unit(:i - 2)
      end if
   end subroutine plain_unit

   !> A unit of a term as messages show it
   pure function shown_unit(term, which) result(unit)
      !> The term, and which of its units
      integer, intent(in) :: term, which
      !> The unit
      character(len=8) :: unit

      character(len=8), parameter :: shown(2, size(column_names)) = reshape([character(len=8) :: 'rad', 'mrad', 'kg m2/m', &
         & 't m2/m', 'kg m/m', 't m/m', 'N m/m', 'kN m/m', 'kg m/m', 't m/m', 'm', 'mm', 'N m/m', 'kN m/m'], &
         & [2, size(column_names)])

      unit = shown(which, term)
   end function shown_unit

   !> Set the terms of the wall
   subroutine set_terms(input, values, at, error)
      !> Input of the wall: its lists are set
      class(wall_input_type), intent(inout) :: input
      !> Values (columns, rows)
      real(wp), intent(in) :: values(:, :)
      !> Columns of the powers and of the terms
      integer, intent(in) :: at(0:)
      !> The rotations are given twice, or for powers not at all
      type(error_type), allocatable, intent(out) :: error

      real(wp), allocatable :: q(:)
      integer :: i, k, n

      if (at(0) == 0) then
         if (input%has('rotation')) then
            call raise_input(error, 'rotation: give either it or the column of the table', not_together, 'rotation')
            return
         end if
         do i = 1, size(column_names)
            if (at(i) > 0) call input%set(trim(column_names(i)), values(at(i), :))
         end do
         return
      end if
      if (size(input%list('rotation')) /= 1) then
         call raise_input(error, 'rotation: must be given with a table of powers, the last rotation that they hold for', &
            & not_given, 'rotation')
         return
      end if
      q = input%list('rotation')
      if (.not. q(1) > 0.0_wp) then
         call raise_input(error, 'rotation = '//to_text(q(1))//': must be positive', out_of_range, 'rotation')
         return
      else if (any(values(at(0), :) < 0.0_wp .or. abs(values(at(0), :) - anint(values(at(0), :))) > 0.0_wp &
         & .or. values(at(0), :) > 100.0_wp)) then
         call raise_input(error, 'column ''power'': must be integers from 0 to 100')
         return
      end if
      ! Chebyshev points, both ends included
      n = nint(maxval(values(at(0), :))) + more_points
      q = [(q(1)*sin(0.5_wp*pi*real(k, wp)/real(n, wp))**2, k=0, n - 1), q(1)]
      do i = 2, size(column_names)
         if (at(i) > 0) call input%set(trim(column_names(i)), [(sum(values(at(i), :)*q(k)**nint(values(at(0), :))), k=1, size(q))])
      end do
      call input%set('rotation', q)
   end subroutine set_terms

end module dondolo_population_wall_table
