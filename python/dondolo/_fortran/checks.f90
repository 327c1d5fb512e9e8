!> Checks by building codes, and elastic spectra.
module checks
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use dondolo_base_error, only : error_type, problems_type
   use dondolo_base_lines, only : lines_type
   use dondolo_base_settings, only : group_settings_type
   use dondolo_base_warning, only : warnings_type
   use dondolo_boundary, only : as_settings, split_lines
   use dondolo_case_check_rows, only : check_wall, put_check, put_sheet_row
   use dondolo_case_columns, only : columns_type
   use dondolo_case_report_rows, only : put_names
   use dondolo_case_wall_warnings, only : wall_warnings_type
   use dondolo_check_calculation, only : is_given, item_type, list_items
   use dondolo_check_checked_wall, only : find_checked
   use dondolo_check_code_spectrum, only : elastic_spectrum_type
   use dondolo_check_floor_spectrum, only : floor_spectrum_type, new_floor_spectrum
   use dondolo_check_hazard_grid, only : grid_years
   use dondolo_check_input, only : check_input_type, check_properties, take_check
   use dondolo_check_kinematic, only : kinematic_type, new_kinematic
   use dondolo_check_notes, only : make_check_notes
   use dondolo_check_history_check, only : check_peaks => check_histories
   use dondolo_check_sheet, only : sheet_type
   use dondolo_check_strip_check, only : check_by_ntc
   use dondolo_curve_parcel, only : take_curves
   use dondolo_fragility, only : fragility_type
   use dondolo_interface_handles, only : find_walls
   use dondolo_parcel, only : parcel_type, report, send
   use dondolo_results_parcel, only : send_table
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: ntc_parameters, site_hazard, code_spectrum, check_ntc, check_table, check_histories, check_notes, calculation_items, &
      & capacity_curve

contains

   !> What a user says of a check: values of check_properties, as as_settings takes them
   subroutine read_input(texts, numbers, given, input, error)
      character(len=*), intent(in) :: texts
      real(c_double), intent(in) :: numbers(:)
      integer(c_int), intent(in) :: given(:)
      type(check_input_type), intent(out) :: input
      type(error_type), allocatable, intent(out) :: error

      type(group_settings_type) :: settings
      type(problems_type) :: problems

      call as_settings(settings, check_properties, texts, numbers, given, error)
      if (allocated(error)) return
      call take_check(input, settings, problems)
      call problems%raise(error)
   end subroutine read_input

   !> Spectrum of the ground of NTC 2018 in a limit state, 1 to 3
   subroutine ntc_parameters(texts, numbers, n, given, q, state, sent)
      character(len=*), intent(in) :: texts
      integer(c_int), intent(in) :: n, q, given(q), state
      real(c_double), intent(in) :: numbers(n)
      integer(c_int64_t), intent(out) :: sent(5)
      type(check_input_type) :: input
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      call read_input(texts, numbers, given, input, error)
      if (.not. allocated(error)) then
         associate (spectrum => input%spectrum(state))
            call parcel%put('pga', spectrum%pga)
            call parcel%put('amplification', spectrum%amplification)
            call parcel%put('corners', spectrum%corners)
         end associate
      end if
      call send(parcel, error, sent)
   end subroutine ntc_parameters

   !> Hazard of each limit state; of coordinates also the nodes of the grid and their values, a_g, F_0 and T_C* of the first return
   !> period, of the second ..., of the first node, of the second ...
   subroutine site_hazard(texts, numbers, n, given, q, sent)
      character(len=*), intent(in) :: texts
      integer(c_int), intent(in) :: n, q, given(q)
      real(c_double), intent(in) :: numbers(n)
      integer(c_int64_t), intent(out) :: sent(5)
      type(check_input_type) :: input
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      integer :: i

      call read_input(texts, numbers, given, input, error)
      if (.not. allocated(error)) then
         call parcel%put('ag', input%ag)
         call parcel%put('f0', input%f0)
         call parcel%put('tc_star', input%tc_star)
         call parcel%put('reference_life', input%reference_life)
         call parcel%put('exceedance', input%exceedance)
         call parcel%put('return_periods', [(input%return_period(i), i=1, size(input%exceedance))])
         if (allocated(input%place)) then
            associate (place => input%place, mesh => input%place%mesh)
               call parcel%put('latitude', place%latitude_ed50)
               call parcel%put('longitude', place%longitude_ed50)
               call parcel%put('use_coefficient', place%use_coefficient)
               call parcel%put('ids', mesh%ids)
               call parcel%put('latitudes', mesh%latitude)
               call parcel%put('longitudes', mesh%longitude)
               call parcel%put('distances', mesh%distances(place%longitude_ed50, place%latitude_ed50))
               call parcel%put('grid_years', grid_years)
               call parcel%put('values', reshape(mesh%values, [size(mesh%values)]))
               call parcel%put('tabulated', reshape(place%tabulated, [size(place%tabulated)]))
            end associate
         end if
      end if
      call send(parcel, error, sent)
   end subroutine site_hazard

   !> Ordinates [g] at n periods [s] of the spectrum of a code of acceleration a_g S [g], amplification F_0 and corners T_B, T_C
   !> and T_D [s]; with modes that of a floor: period [s], damping ratio, and participation times shape of each
   subroutine code_spectrum(pga, amplification, corners, damping, modes, mode_period, mode_damping, mode_participation, m, &
         & periods, n, ordinates)
      ! The first `modes` elements of their arrays are theirs
      integer(c_int), intent(in) :: modes, m, n
      real(c_double), intent(in) :: pga, amplification, corners(3), damping, mode_period(m), mode_damping(m), &
         & mode_participation(m), periods(n)
      real(c_double), intent(out) :: ordinates(n)
      type(floor_spectrum_type) :: floor
      integer :: i

      floor = new_floor_spectrum(elastic_spectrum_type(pga=pga, amplification=amplification, corners=corners), &
         & mode_period(:modes), mode_damping(:modes), mode_participation(:modes))
      do i = 1, n
         ordinates(i) = floor%acceleration(periods(i), damping)
      end do
   end subroutine code_spectrum

   !> Kinematic check of a wall: its sheet, and warnings
   subroutine check_ntc(walls, texts, numbers, n, given, q, sent)
      integer(c_int64_t), intent(in) :: walls
      character(len=*), intent(in) :: texts
      integer(c_int), intent(in) :: n, q, given(q)
      real(c_double), intent(in) :: numbers(n)
      integer(c_int64_t), intent(out) :: sent(5)
      type(wall_type), pointer :: wall(:)
      type(check_input_type) :: input
      type(sheet_type) :: sheet
      type(wall_warnings_type) :: wall_warnings
      type(warnings_type) :: warnings
      type(columns_type) :: table
      type(lines_type) :: found
      type(error_type), allocatable :: error

      call read_input(texts, numbers, given, input, error)
      if (.not. allocated(error)) call find_walls(walls, wall, error)
      if (.not. allocated(error)) call check_by_ntc(sheet, wall(1), input, error, searches=.true.)
      if (.not. allocated(error)) then
         call put_sheet(table, sheet)
         call wall_warnings%look(wall(1))
         call wall_warnings%warn(warnings)
         call warnings%put_objects(found)
      end if
      call send_table(table, error, sent, found)
   end subroutine check_ntc

   !> Kinematic checks of the k walls of a handle with their curves of collapse, as tables has them: a table of a row for each wall
   subroutine check_table(walls, texts, numbers, n, given, q, im, curve_names, curve_texts, curve_numbers, p, k, sent)
      integer(c_int64_t), intent(in) :: walls
      character(len=*), intent(in) :: texts, im, curve_names, curve_texts
      integer(c_int), intent(in) :: n, q, given(q), p, k
      real(c_double), intent(in) :: numbers(n), curve_numbers(p, k)
      integer(c_int64_t), intent(out) :: sent(5)
      type(wall_type), pointer :: wall(:)
      type(check_input_type) :: input
      type(sheet_type) :: sheet
      type(fragility_type), allocatable :: curves(:)
      type(columns_type) :: table
      type(error_type), allocatable :: error, reason
      integer :: i

      call read_input(texts, numbers, given, input, error)
      if (.not. allocated(error)) call find_walls(walls, wall, error)
      if (.not. allocated(error)) call take_curves(curves, curve_names, curve_texts, curve_numbers, error)
      if (.not. allocated(error)) then
         do i = 1, k
            call check_wall(wall(i), input, im, sheet, reason, curves(i))
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
      type(columns_type) :: table
      type(error_type), allocatable :: error

      call find_walls(walls, wall, error)
      if (.not. allocated(error)) call new_kinematic(kinematic, wall(1), error)
      if (.not. allocated(error)) then
         call check_peaks(sheet, kinematic, state, pga, records, edp)
         call put_sheet(table, sheet)
      end if
      call send_table(table, error, sent)
   end subroutine check_histories

   !> Items of the calculation of a wall as columns, NaN for a number that one has not
   subroutine calculation_items(walls, sent)
      integer(c_int64_t), intent(in) :: walls
      integer(c_int64_t), intent(out) :: sent(5)
      type(wall_type), pointer :: found(:)
      type(item_type), allocatable :: items(:)
      type(lines_type) :: names
      type(parcel_type) :: parcel
      type(wall_type) :: checked
      type(error_type), allocatable :: error
      logical :: is_moved
      integer :: i

      call find_walls(walls, found, error)
      if (.not. allocated(error)) call find_checked(found(1), checked, is_moved, error)
      if (.not. allocated(error)) then
         call list_items(checked, items)
         do i = 1, size(items)
            call names%add(trim(items(i)%name))
         end do
         call parcel%put('item', names)
         call parcel%put('force', or_nan(items%force))
         call parcel%put('depth', or_nan(items%depth))
         call parcel%put('arm', or_nan(items%arm))
         call parcel%put('lever', or_nan(items%lever))
         call parcel%put('stabilising', or_nan(items%stabilising))
         call parcel%put('overturning', or_nan(items%overturning))
         call parcel%put('force_lever', or_nan(items%first))
         call parcel%put('force_lever2', or_nan(items%second))
      end if
      call send(parcel, error, sent)
   end subroutine calculation_items

   !> A number of an item, NaN if it is not given
   elemental real(c_double) function or_nan(number)
      real(c_double), intent(in) :: number

      or_nan = number
      if (.not. is_given(number)) or_nan = ieee_value(number, ieee_quiet_nan)
   end function or_nan

   !> Curve of capacity of a wall: spectral accelerations [m/s2] at n displacements [m] from 0 to d_0*, equally spaced
   subroutine capacity_curve(walls, knowledge_factor, displacements, accelerations, n, failure)
      integer(c_int64_t), intent(in) :: walls
      real(c_double), intent(in) :: knowledge_factor
      integer(c_int), intent(in) :: n
      real(c_double), intent(out) :: displacements(n), accelerations(n)
      integer(c_int64_t), intent(out) :: failure(5)
      type(wall_type), pointer :: wall(:)
      type(wall_type) :: checked
      type(kinematic_type) :: kinematic
      type(error_type), allocatable :: error
      logical :: is_moved
      integer :: i

      displacements = 0
      accelerations = 0
      call find_walls(walls, wall, error)
      if (.not. allocated(error)) call find_checked(wall(1), checked, is_moved, error)
      if (.not. allocated(error)) call new_kinematic(kinematic, checked, error)
      if (.not. allocated(error)) then
         do i = 1, n
            displacements(i) = kinematic%end_displacement*real(i - 1, c_double)/real(n - 1, c_double)
            accelerations(i) = kinematic%capacity(displacements(i), knowledge_factor)
         end do
      end if
      call report(error, failure)
   end subroutine capacity_curve

   !> Notes on a sheet of n rows, whose texts are a line each: lines, JSON objects
   subroutine check_notes(method, limit_state, quantity, item, unit, values, n, sent)
      character(len=*), intent(in) :: method, limit_state, quantity, item, unit
      integer(c_int), intent(in) :: n
      real(c_double), intent(in) :: values(n)
      integer(c_int64_t), intent(out) :: sent(5)
      type(sheet_type) :: sheet
      type(lines_type) :: methods, states, quantities, items, units
      type(warnings_type) :: notes
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      integer :: i

      call split_lines(method, methods)
      call split_lines(limit_state, states)
      call split_lines(quantity, quantities)
      call split_lines(item, items)
      call split_lines(unit, units)
      allocate (sheet%rows(n))
      do i = 1, n
         associate (row => sheet%rows(i))
            row%method = methods%line(i)%text
            row%state = states%line(i)%text
            row%quantity%name = quantities%line(i)%text
            row%quantity%unit = units%line(i)%text
            row%item = items%line(i)%text
            row%value = values(i)
         end associate
      end do
      call make_check_notes(sheet, notes)
      call notes%put_objects(parcel%lines)
      call send(parcel, error, sent)
   end subroutine check_notes

   !> Put the rows of a sheet
   subroutine put_sheet(table, sheet)
      type(columns_type), intent(inout) :: table
      type(sheet_type), intent(in) :: sheet

      integer :: i

      do i = 1, size(sheet%rows)
         call put_sheet_row(table, sheet, i)
         call table%end_row()
      end do
   end subroutine put_sheet

end module checks
