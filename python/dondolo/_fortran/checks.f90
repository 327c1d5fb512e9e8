!> Checks by building codes, and elastic spectra.
module checks
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use dondolo_base_error, only : error_type, problems_type
   use dondolo_base_lines, only : lines_type
   use dondolo_base_settings, only : group_settings_type, new_settings
   use dondolo_base_warning, only : warnings_type
   use dondolo_boundary, only : as_curve, next_line, split_lines
   use dondolo_case_check_rows, only : check_wall, put_check
   use dondolo_case_columns, only : columns_type
   use dondolo_case_report_rows, only : put_names
   use dondolo_case_wall_warnings, only : wall_warnings_type
   use dondolo_check_calculation, only : is_given, item_type, list_items
   use dondolo_check_code_spectrum, only : elastic_spectrum_type
   use dondolo_check_floor_spectrum, only : floor_spectrum_type, new_floor_spectrum
   use dondolo_check_input, only : check_input_type, check_properties, take_check
   use dondolo_check_kinematic, only : kinematic_type, new_kinematic
   use dondolo_check_ntc_check, only : check_by_ntc => check_ntc, check_peaks => check_histories
   use dondolo_check_notes, only : make_check_notes
   use dondolo_check_sheet, only : sheet_type
   use dondolo_interface_handles, only : find_walls
   use dondolo_parcel, only : parcel_type, report, send
   use dondolo_results_parcel, only : send_table
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: ntc_parameters, code_spectrum, check_ntc, check_table, check_histories, check_notes, calculation_items, &
      & capacity_curve

contains

   !> What a user says of a check: a line each for code, soil and topography, and ag, f0, tc_star and exceedance with their
   !> counts, then knowledge_factor, behaviour and reference_life, 0 for none
   subroutine read_input(texts, numbers, given, input, error)
      character(len=*), intent(in) :: texts
      real(c_double), intent(in) :: numbers(:)
      integer(c_int), intent(in) :: given(4)
      type(check_input_type), intent(out) :: input
      type(error_type), allocatable, intent(out) :: error

      character(len=*), parameter :: lists(4) = [character(len=10) :: 'ag', 'f0', 'tc_star', 'exceedance']
      character(len=*), parameter :: words(2) = [character(len=10) :: 'soil', 'topography']
      type(group_settings_type) :: settings
      type(problems_type) :: problems
      character(len=:), allocatable :: text
      integer :: i, at, next

      call new_settings(settings, check_properties)
      at = 1
      do i = 1, size(words)
         call next_line(texts, at, text)
         call settings%set(trim(words(i)), text)
      end do
      next = 0
      do i = 1, size(lists)
         if (given(i) > 0) call settings%set(trim(lists(i)), numbers(next + 1:next + given(i)))
         next = next + given(i)
      end do
      call settings%set('knowledge_factor', numbers(next + 1))
      call settings%set('behaviour', numbers(next + 2))
      if (numbers(next + 3) > 0.0_c_double) call settings%set('reference_life', numbers(next + 3))
      call take_check(input, settings, problems)
      call problems%raise(error)
   end subroutine read_input

   !> Spectrum of the ground of NTC 2018 in a limit state, 1 to 3: a_g S [g], F_0, T_B, T_C and T_D [s]
   subroutine ntc_parameters(texts, numbers, n, given, state, parameters, failure)
      character(len=*), intent(in) :: texts
      integer(c_int), intent(in) :: n, given(4), state
      real(c_double), intent(in) :: numbers(n)
      real(c_double), intent(out) :: parameters(5)
      integer(c_int64_t), intent(out) :: failure(5)
      type(check_input_type) :: input
      type(elastic_spectrum_type) :: spectrum
      type(error_type), allocatable :: error

      parameters = 0
      call read_input(texts, numbers, given, input, error)
      if (.not. allocated(error)) then
         spectrum = input%spectrum(state)
         parameters = [spectrum%pga, spectrum%amplification, spectrum%corners]
      end if
      call report(error, failure)
   end subroutine ntc_parameters

   !> Ordinates [g] at n periods [s] of the spectrum of a code with the parameters that ntc_parameters has; with modes that of
   !> a floor: period [s], damping ratio, and participation times shape, of each mode one after the other
   subroutine code_spectrum(parameters, damping, modes, m, periods, n, ordinates)
      integer(c_int), intent(in) :: m, n
      real(c_double), intent(in) :: parameters(5), damping, modes(m), periods(n)
      real(c_double), intent(out) :: ordinates(n)
      type(elastic_spectrum_type) :: ground
      type(floor_spectrum_type) :: floor
      integer :: i

      ground = elastic_spectrum_type(pga=parameters(1), amplification=parameters(2), corners=parameters(3:))
      floor = new_floor_spectrum(ground, modes(1::3), modes(2::3), modes(3::3))
      do i = 1, n
         ordinates(i) = floor%acceleration(periods(i), damping)
      end do
   end subroutine code_spectrum

   !> Kinematic check of a wall: the lines of its sheet, as pack_sheet has them, then warnings
   subroutine check_ntc(walls, texts, numbers, n, given, sent)
      integer(c_int64_t), intent(in) :: walls
      character(len=*), intent(in) :: texts
      integer(c_int), intent(in) :: n, given(4)
      real(c_double), intent(in) :: numbers(n)
      integer(c_int64_t), intent(out) :: sent(5)
      type(wall_type), pointer :: wall(:)
      type(check_input_type) :: input
      type(kinematic_type) :: kinematic
      type(sheet_type) :: sheet
      type(wall_warnings_type) :: wall_warnings
      type(warnings_type) :: warnings
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      call read_input(texts, numbers, given, input, error)
      if (.not. allocated(error)) call find_walls(walls, wall, error)
      if (.not. allocated(error)) call new_kinematic(kinematic, wall(1), error)
      if (.not. allocated(error)) then
         call check_by_ntc(sheet, kinematic, input)
         call pack_sheet(sheet, parcel)
         call wall_warnings%look(wall(1))
         call wall_warnings%warn(warnings)
         call warnings%put_objects(parcel%lines)
      end if
      call send(parcel, error, sent)
   end subroutine check_ntc

   !> Kinematic checks of the k walls of a handle with their curves of collapse: a table of a row for each wall; lines, kinds of
   !> errors of the curves, as tables has them
   subroutine check_table(walls, texts, numbers, n, given, im, lines, curves, codes, k, sent)
      integer(c_int64_t), intent(in) :: walls
      character(len=*), intent(in) :: texts, im, lines
      integer(c_int), intent(in) :: n, given(4), k, codes(3, k)
      real(c_double), intent(in) :: numbers(n), curves(14, k)
      integer(c_int64_t), intent(out) :: sent(5)
      type(wall_type), pointer :: wall(:)
      type(check_input_type) :: input
      type(sheet_type) :: sheet
      type(lines_type) :: words
      type(columns_type) :: table
      type(error_type), allocatable :: error, reason
      integer :: i

      call read_input(texts, numbers, given, input, error)
      if (.not. allocated(error)) call find_walls(walls, wall, error)
      if (.not. allocated(error)) then
         call split_lines(lines, words)
         do i = 1, k
            call check_wall(wall(i), input, im, sheet, reason, as_curve(curves(:, i), codes(:, i), words%line(i)%text))
            call put_names(table, wall(i)%name(), wall(i)%mechanism_name())
            call put_check(table, '', sheet, reason)
            call table%end_row()
         end do
      end if
      call send_table(table, error, sent)
   end subroutine check_table

   !> Criterion for time histories in a limit state, 2 or 3, from their largest rotations / capacity, 1 where they collapsed
   subroutine check_histories(walls, state, pga, records, edp, n, sent)
      integer(c_int64_t), intent(in) :: walls
      integer(c_int), intent(in) :: state, records, n
      real(c_double), intent(in) :: pga, edp(n)
      integer(c_int64_t), intent(out) :: sent(5)
      type(wall_type), pointer :: wall(:)
      type(kinematic_type) :: kinematic
      type(sheet_type) :: sheet
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      call find_walls(walls, wall, error)
      if (.not. allocated(error)) call new_kinematic(kinematic, wall(1), error)
      if (.not. allocated(error)) then
         call check_peaks(sheet, kinematic, state, pga, records, edp)
         call pack_sheet(sheet, parcel)
      end if
      call send(parcel, error, sent)
   end subroutine check_histories

   !> Items of the calculation of a wall: lines, their names; reals, of each item the numbers of item_type, NaN for one that it has
   !> not
   subroutine calculation_items(walls, sent)
      integer(c_int64_t), intent(in) :: walls
      integer(c_int64_t), intent(out) :: sent(5)
      type(wall_type), pointer :: found(:)
      type(item_type), allocatable :: items(:)
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      real(c_double), allocatable :: numbers(:, :)
      integer :: i

      call find_walls(walls, found, error)
      if (.not. allocated(error)) then
         call list_items(found(1), items)
         allocate (numbers(8, size(items)))
         do i = 1, size(items)
            associate (item => items(i))
               call parcel%lines%add(trim(item%name))
               numbers(:, i) = [item%force, item%depth, item%arm, item%lever, item%stabilising, item%overturning, item%first, &
                  & item%second]
            end associate
         end do
         where (.not. is_given(numbers)) numbers = ieee_value(1.0_c_double, ieee_quiet_nan)
         call parcel%add(reshape(numbers, [size(numbers)]))
      end if
      call send(parcel, error, sent)
   end subroutine calculation_items

   !> Curve of capacity of a wall: spectral accelerations [m/s2] at n displacements [m] from 0 to d_0*, equally spaced
   subroutine capacity_curve(walls, knowledge_factor, displacements, accelerations, n, failure)
      integer(c_int64_t), intent(in) :: walls
      real(c_double), intent(in) :: knowledge_factor
      integer(c_int), intent(in) :: n
      real(c_double), intent(out) :: displacements(n), accelerations(n)
      integer(c_int64_t), intent(out) :: failure(5)
      type(wall_type), pointer :: wall(:)
      type(kinematic_type) :: kinematic
      type(error_type), allocatable :: error
      integer :: i

      displacements = 0
      accelerations = 0
      call find_walls(walls, wall, error)
      if (.not. allocated(error)) call new_kinematic(kinematic, wall(1), error)
      if (.not. allocated(error)) then
         do i = 1, n
            displacements(i) = kinematic%end_displacement*real(i - 1, c_double)/real(n - 1, c_double)
            accelerations(i) = kinematic%capacity(displacements(i), knowledge_factor)
         end do
      end if
      call report(error, failure)
   end subroutine capacity_curve

   !> Notes on a sheet, whose lines have a tab between method, limit state, name and item: lines, JSON objects
   subroutine check_notes(texts, values, n, sent)
      character(len=*), intent(in) :: texts
      integer(c_int), intent(in) :: n
      real(c_double), intent(in) :: values(n)
      integer(c_int64_t), intent(out) :: sent(5)
      character(len=*), parameter :: tab = achar(9)
      type(sheet_type) :: sheet
      type(warnings_type) :: notes
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      character(len=:), allocatable :: line
      integer :: i, at, ends(3)

      allocate (sheet%rows(n))
      at = 1
      do i = 1, n
         call next_line(texts, at, line)
         ends(1) = index(line, tab)
         ends(2) = ends(1) + index(line(ends(1) + 1:), tab)
         ends(3) = ends(2) + index(line(ends(2) + 1:), tab)
         associate (row => sheet%rows(i))
            row%method = line(:ends(1) - 1)
            row%state = line(ends(1) + 1:ends(2) - 1)
            row%quantity%name = line(ends(2) + 1:ends(3) - 1)
            row%item = line(ends(3) + 1:)
            row%value = values(i)
         end associate
      end do
      call make_check_notes(sheet, notes)
      call notes%put_objects(parcel%lines)
      call send(parcel, error, sent)
   end subroutine check_notes

   !> A sheet as lines, with a tab between method, limit state, name, symbol, unit, formula, meaning, item,
   !> expression, numbers and bound; reals: its values
   subroutine pack_sheet(sheet, parcel)
      type(sheet_type), intent(in) :: sheet
      type(parcel_type), intent(inout) :: parcel

      character(len=*), parameter :: tab = achar(9)
      integer :: i

      call parcel%add(real(sheet%rows%value, c_double))
      do i = 1, size(sheet%rows)
         associate (row => sheet%rows(i))
            call parcel%lines%add(trim(row%method)//tab//trim(row%state)//tab//trim(row%quantity%name)//tab// &
               & trim(row%quantity%symbol)//tab//trim(row%quantity%unit)//tab//trim(row%formula)//tab// &
               & trim(row%quantity%meaning)//tab//trim(row%item)//tab// &
               & trim(row%working%expression)//tab//trim(row%working%numbers)//tab//trim(row%bound))
         end associate
      end do
   end subroutine pack_sheet

end module checks
