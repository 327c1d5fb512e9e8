! The one boundary between Fortran and Python: all that f2py reads.
!
! Arguments are flat: c_double, c_int and bytes only, since f2py turns any other kind into a C float without a word.
! A wall is its properties in the order of their table (dondolo_wall_properties): a line for each text, q numbers with a
! mask of those given; and gravity;
! records are one array of samples with their lengths, time steps and names (one a line). Status and message come last:
! 0, or the kind of the error (dondolo_error). Procedures that compute release Python's lock (threadsafe); those that call
! functions with results of deferred length keep it, since gfortran's are not safe in several threads (see dondolo_text).

! Version, defaults and limits that Python must not repeat
subroutine constants(defaults, version, statuses)
   use, intrinsic :: iso_c_binding, only : c_double
   use dondolo_fragility, only : status_names
   use dondolo_solver, only : solver_type
   use dondolo_version, only : dondolo_version_text
   use dondolo_wall, only : standard_gravity
   implicit none
   ! rtol, atol, edp_limit, gravity
   real(c_double), intent(out) :: defaults(4)
   character(len=32), intent(out) :: version
   character(len=256), intent(out) :: statuses
   type(solver_type) :: solver
   integer :: i

   defaults = [solver%rtol, solver%atol, solver%edp_limit, standard_gravity]
   version = dondolo_version_text
   statuses = ''
   do i = 1, size(status_names)
      statuses = trim(statuses)//' '//status_names(i)
   end do
end subroutine constants

! The table of properties of a group, one of table_names; a line for each, its entries separated by tabs
! (describe_property)
subroutine properties(group, handle, sizes, stat, message)
   use, intrinsic :: iso_c_binding, only : c_int, c_intptr_t
   use dondolo_boundary, only : pack_lines, parcel_type, report, send
   use dondolo_error, only : error_type, raise_input
   use dondolo_lines, only : lines_type
   use dondolo_property, only : describe_property, property_type
   use dondolo_property_tables, only : property_table, table_names
   use dondolo_text, only : join
   implicit none
   character(len=*), intent(in) :: group
   integer(c_intptr_t), intent(out) :: handle
   integer(c_int), intent(out) :: sizes(3), stat
   character(len=2048), intent(out) :: message
   type(property_type), allocatable :: table(:)
   type(lines_type) :: lines
   type(parcel_type) :: parcel
   type(error_type), allocatable :: error
   character(len=:), allocatable :: line
   integer :: i

   handle = 0
   sizes = 0
   table = property_table(group)
   do i = 1, size(table)
      call describe_property(table(i), line)
      call lines%add(line)
   end do
   if (size(table) == 0) call raise_input(error, 'group = '''//group//''': must be one of '//join(table_names))
   if (.not. allocated(error)) then
      parcel%text = pack_lines(lines)
      call send(parcel, handle, sizes)
   end if
   call report(error, stat, message)
end subroutine properties

! Build variant that the engine lanes runs; the environment may change it from call to call
subroutine variant(name, stat, message)
   use, intrinsic :: iso_c_binding, only : c_int
   use dondolo_boundary, only : report
   use dondolo_error, only : error_type
   use dondolo_lane_variants, only : build_variant, check_variant
   implicit none
   character(len=32), intent(out) :: name
   integer(c_int), intent(out) :: stat
   character(len=2048), intent(out) :: message
   type(error_type), allocatable :: error

   call check_variant(error)
   name = build_variant()
   call report(error, stat, message)
end subroutine variant

! Listen to Ctrl-C while something is computed: the main thread alone may
subroutine listen()
   use dondolo_interrupt, only : begin => listen
   implicit none

   call begin()
end subroutine listen

! Listen no more
subroutine end_listening()
   use dondolo_interrupt, only : finish => end_listening
   implicit none

   call finish()
end subroutine end_listening

! Let the thread that calls it work alone from now on: OpenMP's other threads do not survive a fork
subroutine work_alone()
   use, intrinsic :: omp_lib, only : omp_set_max_active_levels
   implicit none

   call omp_set_max_active_levels(0)
end subroutine work_alone

! Contents of a parcel that another procedure has sent
subroutine take_parcel(handle, m, n, k, integers, reals, characters)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_intptr_t
   use dondolo_boundary, only : take
   implicit none
   !f2py threadsafe
   integer(c_intptr_t), intent(in) :: handle
   integer(c_int), intent(in) :: m, n, k
   integer(c_int), intent(out) :: integers(m), characters(k)
   real(c_double), intent(out) :: reals(n)

   call take(handle, integers, reals, characters)
end subroutine take_parcel

! Walls with their defaults filled in and their static quantities, as pack_walls has them
subroutine describe_walls(texts, numbers, given, q, gravity, w, handle, sizes, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_intptr_t
   use dondolo_boundary, only : check_room, pack_walls, parcel_type, report, send, set_walls
   use dondolo_error, only : error_type
   use dondolo_wall, only : wall_type
   implicit none
   character(len=*), intent(in) :: texts
   integer(c_int), intent(in) :: q, w, given(q, w)
   real(c_double), intent(in) :: numbers(q, w), gravity(w)
   integer(c_intptr_t), intent(out) :: handle
   integer(c_int), intent(out) :: sizes(3), stat
   character(len=2048), intent(out) :: message
   type(wall_type), allocatable :: walls(:)
   type(parcel_type) :: parcel
   type(error_type), allocatable :: error

   handle = 0
   sizes = 0
   call check_room(error, walls=w)
   if (.not. allocated(error)) then
      allocate (walls(w))
      call set_walls(walls, texts, numbers, given, gravity, error)
   end if
   if (.not. allocated(error)) then
      call pack_walls(walls, parcel)
      call send(parcel, handle, sizes)
   end if
   call report(error, stat, message)
end subroutine describe_walls

! Terms J, C, G, L and Q of the equation of motion of a wall and its potential energy V, one column each, at n rotations
subroutine wall_terms(texts, numbers, given, q, gravity, rotation, n, terms, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use dondolo_boundary, only : check_rotations, report, set_walls
   use dondolo_error, only : error_type
   use dondolo_wall, only : wall_type
   implicit none
   !f2py threadsafe
   character(len=*), intent(in) :: texts
   integer(c_int), intent(in) :: q, n, given(q)
   real(c_double), intent(in) :: numbers(q), gravity, rotation(n)
   real(c_double), intent(out) :: terms(n, 6)
   integer(c_int), intent(out) :: stat
   character(len=2048), intent(out) :: message
   type(wall_type) :: walls(1)
   type(error_type), allocatable :: error
   integer :: i

   terms = 0
   call set_walls(walls, texts, reshape(numbers, [q, 1]), reshape(given, [q, 1]), [gravity], error)
   if (.not. allocated(error)) call check_rotations(walls(1)%mechanism, rotation, error)
   if (.not. allocated(error)) then
      associate (mechanism => walls(1)%mechanism)
         do i = 1, n
            call mechanism%terms(rotation(i), terms(i, 1), terms(i, 2), terms(i, 3), terms(i, 4), terms(i, 5))
            terms(i, 6) = mechanism%potential(rotation(i))
         end do
      end associate
   end if
   call report(error, stat, message)
end subroutine wall_terms

! Check what a record is to be made of
subroutine check_record(acceleration, n, dt, pga, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use dondolo_boundary, only : check_room, report
   use dondolo_error, only : error_type
   use dondolo_record, only : new_record, record_type
   implicit none
   !f2py threadsafe
   integer(c_int), intent(in) :: n
   real(c_double), intent(in) :: acceleration(n), dt
   real(c_double), intent(out) :: pga
   integer(c_int), intent(out) :: stat
   character(len=2048), intent(out) :: message
   type(record_type) :: record
   type(error_type), allocatable :: error

   pga = 0
   call check_room(error, samples=n)
   if (.not. allocated(error)) call new_record(record, acceleration, dt, '', error)
   if (.not. allocated(error)) pga = record%pga()
   call report(error, stat, message)
end subroutine check_record

! Name as dondolo writes it, unit of the levels and words of an intensity measure: three lines of text; and the power of a
! record's scale that it grows by: an integer. With of_record = 1 those that records have of themselves, durations too;
! else those that records can be scaled by
subroutine describe_measure(im, of_record, handle, sizes, stat, message)
   use, intrinsic :: iso_c_binding, only : c_int, c_intptr_t
   use dondolo_boundary, only : pack_lines, parcel_type, report, send
   use dondolo_error, only : error_type
   use dondolo_intensity, only : measure_type, new_measure
   use dondolo_lines, only : lines_type
   use dondolo_scaling, only : new_scaling, scaling_type
   implicit none
   character(len=*), intent(in) :: im
   integer(c_int), intent(in) :: of_record
   integer(c_intptr_t), intent(out) :: handle
   integer(c_int), intent(out) :: sizes(3), stat
   character(len=2048), intent(out) :: message
   type(measure_type) :: measure
   type(scaling_type) :: scaling
   type(lines_type) :: lines
   type(parcel_type) :: parcel
   type(error_type), allocatable :: error

   handle = 0
   sizes = 0
   if (of_record == 1) then
      call new_measure(measure, im, error)
   else
      call new_scaling(scaling, im, error)
   end if
   if (.not. allocated(error)) then
      if (of_record == 1) then
         call lines%add(measure%name)
         call lines%add(measure%unit())
         call lines%add(measure%title())
         parcel%integers = [measure%power()]
      else
         call lines%add(scaling%name)
         call lines%add(scaling%unit())
         call lines%add(scaling%title())
         parcel%integers = [scaling%measure%power()]
      end if
      parcel%text = pack_lines(lines)
      call send(parcel, handle, sizes)
   end if
   call report(error, stat, message)
end subroutine describe_measure

! Intensities of records, in the unit of the levels
subroutine intensities(im, names, lengths, dt, r, acceleration, n, gravity, threads, values, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use dondolo_boundary, only : check_room, report, set_records
   use dondolo_error, only : error_type
   use dondolo_intensity, only : measure_type, new_measure
   use dondolo_record, only : record_type
   use dondolo_suite, only : new_suite, suite_type
   use dondolo_threads, only : check_threads
   implicit none
   !f2py threadsafe
   character(len=*), intent(in) :: im, names
   integer(c_int), intent(in) :: r, n, threads, lengths(r)
   real(c_double), intent(in) :: dt(r), acceleration(n), gravity
   real(c_double), intent(out) :: values(r)
   integer(c_int), intent(out) :: stat
   character(len=2048), intent(out) :: message
   type(measure_type) :: measure
   type(suite_type) :: suite
   type(record_type), allocatable :: records(:)
   type(error_type), allocatable :: error

   values = 0
   call check_room(error, records=r, samples=n)
   if (.not. allocated(error)) call check_threads(threads, error)
   if (.not. allocated(error)) call new_measure(measure, im, error)
   if (.not. allocated(error)) then
      call set_records(records, names, lengths, dt, acceleration)
      call new_suite(suite, records)
      values = suite%values(measure, threads)/measure%level_size(gravity)
   end if
   call report(error, stat, message)
end subroutine intensities

! Values that plan and run_block scale records by
subroutine scaling_values(im, names, lengths, dt, r, acceleration, n, threads, values, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use dondolo_boundary, only : check_room, report, set_records
   use dondolo_error, only : error_type
   use dondolo_record, only : record_type
   use dondolo_scaling, only : new_scaling, scaling_type
   use dondolo_suite, only : new_suite, suite_type
   use dondolo_threads, only : check_threads
   implicit none
   !f2py threadsafe
   character(len=*), intent(in) :: im, names
   integer(c_int), intent(in) :: r, n, threads, lengths(r)
   real(c_double), intent(in) :: dt(r), acceleration(n)
   real(c_double), intent(out) :: values(r)
   integer(c_int), intent(out) :: stat
   character(len=2048), intent(out) :: message
   type(scaling_type) :: scaling
   type(suite_type) :: suite
   type(record_type), allocatable :: records(:)
   type(error_type), allocatable :: error

   values = 0
   call check_room(error, records=r, samples=n)
   if (.not. allocated(error)) call check_threads(threads, error)
   if (.not. allocated(error)) call new_scaling(scaling, im, error)
   if (.not. allocated(error)) then
      call set_records(records, names, lengths, dt, acceleration)
      call new_suite(suite, records)
      values = suite%values(scaling%measure, threads)
   end if
   call report(error, stat, message)
end subroutine scaling_values

! Spectral displacements of a record
subroutine spectrum(acceleration, n, dt, periods, m, damping, displacement, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use dondolo_boundary, only : check_room, check_spectrum, report
   use dondolo_error, only : error_type
   use dondolo_record, only : record_type
   use dondolo_response_spectrum, only : spectral_displacement
   implicit none
   !f2py threadsafe
   integer(c_int), intent(in) :: n, m
   real(c_double), intent(in) :: acceleration(n), dt, periods(m), damping
   real(c_double), intent(out) :: displacement(m)
   integer(c_int), intent(out) :: stat
   character(len=2048), intent(out) :: message
   type(record_type) :: record
   type(error_type), allocatable :: error

   displacement = 0
   call check_room(error, samples=n, reals=10.0_c_double*m)
   if (.not. allocated(error)) call check_spectrum(periods, damping, error)
   if (.not. allocated(error)) then
      record%dt = dt
      record%acceleration = acceleration
      displacement = spectral_displacement(record, periods, damping)
   end if
   call report(error, stat, message)
end subroutine spectrum

! Velocity of the ground at the samples of a record
subroutine ground_velocity(acceleration, n, dt, velocity, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use dondolo_boundary, only : check_room, report
   use dondolo_error, only : error_type
   use dondolo_ground_motion, only : velocity_of => ground_velocity
   use dondolo_record, only : record_type
   implicit none
   !f2py threadsafe
   integer(c_int), intent(in) :: n
   real(c_double), intent(in) :: acceleration(n), dt
   real(c_double), intent(out) :: velocity(n)
   integer(c_int), intent(out) :: stat
   character(len=2048), intent(out) :: message
   type(record_type) :: record
   type(error_type), allocatable :: error

   velocity = 0
   call check_room(error, samples=n)
   if (.not. allocated(error)) then
      record%dt = dt
      record%acceleration = acceleration
      velocity = velocity_of(record)
   end if
   call report(error, stat, message)
end subroutine ground_velocity

! Times at which the integral of the squared acceleration reaches two shares of its end value
subroutine significant_times(acceleration, n, dt, low, high, times, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use dondolo_boundary, only : check_room, report
   use dondolo_energy_measures, only : times_of => significant_times
   use dondolo_error, only : error_type
   use dondolo_record, only : record_type
   implicit none
   !f2py threadsafe
   integer(c_int), intent(in) :: n
   real(c_double), intent(in) :: acceleration(n), dt, low, high
   real(c_double), intent(out) :: times(2)
   integer(c_int), intent(out) :: stat
   character(len=2048), intent(out) :: message
   type(record_type) :: record
   type(error_type), allocatable :: error

   times = 0
   call check_room(error, samples=n)
   if (.not. allocated(error)) then
      record%dt = dt
      record%acceleration = acceleration
      times = times_of(record, low, high)
   end if
   call report(error, stat, message)
end subroutine significant_times

! Read accelerograms: what = 0 one channel of a file, 1 all of a catalogue, 2 all channels of a file; texts are empty
! where they are not given
subroutine read_records(path, what, dt_given, dt, units, channel, layout, handle, sizes, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_intptr_t
   use dondolo_boundary, only : check_parcel, pack_note, pack_records, parcel_type, report, send
   use dondolo_catalogue, only : read_catalogue
   use dondolo_error, only : error_type
   use dondolo_record, only : record_type
   use dondolo_record_reader, only : read_record, read_all => read_records
   implicit none
   character(len=*), intent(in) :: path, units, channel, layout
   integer(c_int), intent(in) :: what, dt_given
   real(c_double), intent(in) :: dt
   integer(c_intptr_t), intent(out) :: handle
   integer(c_int), intent(out) :: sizes(3), stat
   character(len=2048), intent(out) :: message
   type(record_type), allocatable :: records(:)
   type(parcel_type) :: parcel
   type(error_type), allocatable :: error
   character(len=:), allocatable :: note
   real(c_double), allocatable :: step

   handle = 0
   sizes = 0
   ! A step that is not allocated is an argument that is not present
   if (dt_given == 1) step = dt
   select case (what)
   case (0)
      allocate (records(1))
      call read_record(path, records(1), error, step, units, channel, layout)
   case (1)
      call read_catalogue(path, records, error, note)
   case default
      call read_all(path, records, error, step, units, layout)
   end select
   if (.not. allocated(error)) call check_parcel(error, 0, records)
   if (.not. allocated(error)) then
      call pack_records(records, parcel)
      call pack_note(note, parcel)
      call send(parcel, handle, sizes)
   end if
   call report(error, stat, message)
end subroutine read_records

! Read a table of numbers. Integers: columns, rows; reals: its numbers, row by row; text: names of the columns, and how it
! was read, where there is something to say of it
subroutine read_number_table(path, handle, sizes, stat, message)
   use, intrinsic :: iso_c_binding, only : c_int, c_intptr_t
   use dondolo_boundary, only : pack_lines, pack_note, parcel_type, report, send
   use dondolo_csv_row, only : cell_type
   use dondolo_error, only : error_type
   use dondolo_kinds, only : wp
   use dondolo_lines, only : lines_type
   use dondolo_number_table, only : read_table => read_number_table
   implicit none
   character(len=*), intent(in) :: path
   integer(c_intptr_t), intent(out) :: handle
   integer(c_int), intent(out) :: sizes(3), stat
   character(len=2048), intent(out) :: message
   type(cell_type), allocatable :: columns(:)
   type(lines_type) :: names
   type(parcel_type) :: parcel
   type(error_type), allocatable :: error
   real(wp), allocatable :: values(:, :)
   character(len=:), allocatable :: note
   integer :: i

   handle = 0
   sizes = 0
   call read_table(path, columns, values, note, error)
   if (.not. allocated(error)) then
      do i = 1, size(columns)
         call names%add(columns(i)%text)
      end do
      parcel%integers = shape(values)
      parcel%reals = reshape(values, [size(values)])
      parcel%text = pack_lines(names)
      call pack_note(note, parcel)
      call send(parcel, handle, sizes)
   end if
   call report(error, stat, message)
end subroutine read_number_table

! The table of the records of a catalogue. Integer: number of its lines; text: its lines, and how the catalogue was read,
! where there is something to say of it
subroutine catalogue_table(path, gravity, handle, sizes, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_intptr_t
   use dondolo_boundary, only : pack_lines, pack_note, parcel_type, report, send
   use dondolo_catalogue, only : read_catalogue
   use dondolo_error, only : error_type
   use dondolo_lines, only : lines_type
   use dondolo_record, only : record_type
   use dondolo_record_table, only : record_table
   implicit none
   character(len=*), intent(in) :: path
   real(c_double), intent(in) :: gravity
   integer(c_intptr_t), intent(out) :: handle
   integer(c_int), intent(out) :: sizes(3), stat
   character(len=2048), intent(out) :: message
   type(record_type), allocatable :: records(:)
   type(parcel_type) :: parcel
   type(error_type), allocatable :: error
   type(lines_type) :: table
   character(len=:), allocatable :: note

   handle = 0
   sizes = 0
   call read_catalogue(path, records, error, note)
   if (.not. allocated(error)) then
      table = record_table(records, gravity)
      parcel%integers = [table%count]
      parcel%text = pack_lines(table)
      call pack_note(note, parcel)
      call send(parcel, handle, sizes)
   end if
   call report(error, stat, message)
end subroutine catalogue_table

! Read a population: walls as pack_walls has them, then reals: their weights and the probabilities of their mechanisms;
! text: their groups, and how the table was read, where there is something to say of it
subroutine read_walls(path, gravity, handle, sizes, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_intptr_t
   use dondolo_boundary, only : check_room, pack_members, pack_note, parcel_type, report, send
   use dondolo_error, only : error_type
   use dondolo_population, only : member_type, read_population
   implicit none
   character(len=*), intent(in) :: path
   real(c_double), intent(in) :: gravity
   integer(c_intptr_t), intent(out) :: handle
   integer(c_int), intent(out) :: sizes(3), stat
   character(len=2048), intent(out) :: message
   type(member_type), allocatable :: members(:)
   type(parcel_type) :: parcel
   type(error_type), allocatable :: error
   character(len=:), allocatable :: note

   handle = 0
   sizes = 0
   call read_population(path, members, error, gravity, note)
   if (.not. allocated(error)) call check_room(error, walls=size(members))
   if (.not. allocated(error)) then
      call pack_members(members, parcel)
      call pack_note(note, parcel)
      call send(parcel, handle, sizes)
   end if
   call report(error, stat, message)
end subroutine read_walls

! What the executable would warn of, of a wall and a record, before it runs one motion
subroutine warn_of_motion(texts, numbers, given, q, gravity, record, pga, handle, sizes, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_intptr_t
   use dondolo_boundary, only : pack_warnings, parcel_type, report, send, set_walls
   use dondolo_error, only : error_type
   use dondolo_plausibility, only : wall_warning_type
   use dondolo_record, only : record_type
   use dondolo_wall, only : wall_type
   use dondolo_warning, only : warnings_type
   use dondolo_warnings, only : warn_of_records
   implicit none
   character(len=*), intent(in) :: texts, record
   integer(c_int), intent(in) :: q, given(q)
   real(c_double), intent(in) :: numbers(q), gravity, pga
   integer(c_intptr_t), intent(out) :: handle
   integer(c_int), intent(out) :: sizes(3), stat
   character(len=2048), intent(out) :: message
   type(wall_type) :: walls(1)
   type(record_type) :: records(1)
   type(wall_warning_type) :: oddities
   type(warnings_type) :: warnings
   type(parcel_type) :: parcel
   type(error_type), allocatable :: error

   handle = 0
   sizes = 0
   call set_walls(walls, texts, reshape(numbers, [q, 1]), reshape(given, [q, 1]), [gravity], error)
   if (.not. allocated(error)) then
      call oddities%look(walls(1))
      call oddities%warn(warnings)
      ! Of the samples the sentences need the largest only
      records(1)%name = record
      records(1)%acceleration = [pga]
      call warn_of_records(records, gravity, warnings)
      if (warnings%count > 0) then
         call pack_warnings(warnings, parcel)
         call send(parcel, handle, sizes)
      end if
   end if
   call report(error, stat, message)
end subroutine warn_of_motion

! One motion; with history = 1 also the parcel of its rows: time, ground acceleration, rotation, velocity; as integers
! side and whether it is just after an impact
subroutine simulate(texts, numbers, given, q, gravity, acceleration, n, dt, name, scale, engine, settings, history, &
      & edp, collapsed, impacts, time_of_peak, edp_error, handle, sizes, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_intptr_t
   use dondolo_boundary, only : as_solver, check_interrupt, check_room, check_trace, pack_response, parcel_type, report, &
      & send, set_records, set_walls
   use dondolo_error, only : error_type, raise_input
   use dondolo_record, only : largest_acceleration, record_type
   use dondolo_response, only : response_type, trace_type
   use dondolo_simulate, only : check_history, simulate_wall => simulate
   use dondolo_solver, only : check_limit, check_solver, solver_type
   use dondolo_text, only : to_text
   use dondolo_wall, only : wall_type
   implicit none
   !f2py threadsafe
   character(len=*), intent(in) :: texts, name, engine
   integer(c_int), intent(in) :: q, n, given(q), history
   real(c_double), intent(in) :: numbers(q), gravity, acceleration(n), dt, scale, settings(5)
   real(c_double), intent(out) :: edp, time_of_peak, edp_error
   integer(c_int), intent(out) :: collapsed, impacts
   integer(c_intptr_t), intent(out) :: handle
   integer(c_int), intent(out) :: sizes(3), stat
   character(len=2048), intent(out) :: message
   type(wall_type) :: walls(1)
   type(record_type), allocatable :: records(:)
   type(solver_type) :: solver
   type(response_type) :: response
   type(trace_type) :: trace
   type(parcel_type) :: parcel
   type(error_type), allocatable :: error

   handle = 0
   sizes = 0
   call check_room(error, samples=n)
   if (.not. allocated(error)) call set_walls(walls, texts, reshape(numbers, [q, 1]), reshape(given, [q, 1]), [gravity], error)
   solver = as_solver(engine, settings)
   if (.not. allocated(error)) call check_solver(solver, error)
   if (.not. allocated(error)) call check_limit(solver, walls(1)%mechanism, error)
   if (.not. allocated(error)) call check_history(solver, walls(1)%mechanism, history == 1, error)
   if (.not. allocated(error)) then
      call set_records(records, name, [n], [dt], acceleration)
      if (.not. abs(scale)*records(1)%pga() <= largest_acceleration) call raise_input(error, 'scale = '// &
         & to_text(scale)//': makes record '''//name//''' exceed '//to_text(largest_acceleration)//' m/s2')
   end if
   if (.not. allocated(error)) then
      if (history == 1) then
         call simulate_wall(walls(1)%mechanism, records(1), scale, solver, response, trace)
         call check_interrupt(error)
         if (.not. allocated(error)) call check_trace(trace, error)
      else
         call simulate_wall(walls(1)%mechanism, records(1), scale, solver, response)
         call check_interrupt(error)
      end if
   end if
   if (.not. allocated(error) .and. history == 1) then
      parcel%reals = [trace%time, trace%acceleration, trace%rotation, trace%velocity]
      parcel%integers = [nint(trace%side), merge(1, 0, trace%after_impact)]
      call send(parcel, handle, sizes)
   end if
   call pack_response(response, edp, collapsed, impacts, time_of_peak, edp_error)
   call report(error, stat, message)
end subroutine simulate

! Check what stripes of some walls would be, without running them. Integers: histories of a stripe of each wall, then
! record and polarity of each history of the last wall; reals: its scales (histories, levels); text: warnings
subroutine plan(texts, numbers, given, q, gravity, w, names, lengths, dt, r, acceleration, n, values, levels, m, im, &
      & polarity, engine, settings, threads, handle, sizes, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_intptr_t
   use dondolo_boundary, only : as_solver, check_room, pack_warnings, parcel_type, report, send, set_records, &
      & set_walls
   use dondolo_error, only : add_place, error_type
   use dondolo_plausibility, only : wall_warning_type
   use dondolo_record, only : record_type
   use dondolo_scaling, only : new_scaling, scaling_type
   use dondolo_solver, only : check_limit
   use dondolo_stripes, only : plan_stripes, stripes_type
   use dondolo_study, only : new_study, study_type
   use dondolo_suite, only : new_suite, suite_type
   use dondolo_threads, only : check_threads
   use dondolo_wall, only : wall_type
   use dondolo_warning, only : warnings_type
   use dondolo_warnings, only : scale_warning_type, warn_of_records
   implicit none
   character(len=*), intent(in) :: texts, names, im, polarity, engine
   integer(c_int), intent(in) :: q, w, r, n, m, threads, given(q, w), lengths(r)
   real(c_double), intent(in) :: numbers(q, w), gravity(w), dt(r), acceleration(n), values(r), levels(m), settings(5)
   integer(c_intptr_t), intent(out) :: handle
   integer(c_int), intent(out) :: sizes(3), stat
   character(len=2048), intent(out) :: message
   type(wall_type), allocatable :: walls(:)
   type(record_type), allocatable :: records(:)
   type(suite_type), target :: suite
   type(study_type) :: study
   type(scaling_type) :: scaling
   type(stripes_type) :: stripes
   type(scale_warning_type) :: scales
   type(wall_warning_type) :: oddities
   type(warnings_type) :: warnings
   type(parcel_type) :: parcel
   type(error_type), allocatable :: error
   integer, allocatable :: histories(:)
   integer :: i
   logical :: fresh

   handle = 0
   sizes = 0
   call check_room(error, w, r, n)
   if (.not. allocated(error)) call check_threads(threads, error)
   if (.not. allocated(error)) then
      allocate (walls(w), histories(w))
      call set_walls(walls, texts, numbers, given, gravity, error)
   end if
   if (.not. allocated(error)) call new_scaling(scaling, im, error)
   if (.not. allocated(error)) then
      call set_records(records, names, lengths, dt, acceleration)
      call new_suite(suite, records)
      call new_study(study, suite, scaling, levels, polarity, as_solver(engine, settings), threads)
      study%values = values
      do i = 1, w
         ! Of a wall, sides and gravity alone count in most plans: most walls of a population share one.
         fresh = i == 1 .or. scaling%needs_wall()
         if (.not. fresh) fresh = gravity(i) < gravity(i - 1) .or. gravity(i) > gravity(i - 1) &
            & .or. (walls(i)%mechanism%two_sided .neqv. walls(i - 1)%mechanism%two_sided)
         if (fresh) then
            call plan_stripes(stripes, walls(i), study, error)
         else
            call check_limit(study%solver, walls(i)%mechanism, error)
         end if
         if (allocated(error)) then
            if (w > 1) call add_place(error, 'wall '''//walls(i)%name()//'''')
            exit
         end if
         histories(i) = size(stripes%record)
         call scales%look(stripes, suite%records)
         call oddities%look(walls(i))
      end do
   end if
   if (.not. allocated(error)) then
      call oddities%warn(warnings)
      call warn_of_records(suite%records, gravity(1), warnings)
      call scales%warn(warnings)
      parcel%integers = [histories, stripes%record, stripes%polarity]
      parcel%reals = reshape(stripes%scale, [size(stripes%scale)])
      call pack_warnings(warnings, parcel)
      call send(parcel, handle, sizes)
   end if
   call report(error, stat, message)
end subroutine plan

! Run `count` histories of a plan from number `first` on; they are numbered wall by wall and stripe by stripe. Counts of
! what was computed come in the order of work_names
subroutine run_block(texts, numbers, given, q, gravity, w, names, lengths, dt, r, acceleration, n, values, levels, m, im, &
      & polarity, engine, settings, threads, first, count, edp, collapsed, impacts, time_of_peak, edp_error, work, &
      & stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use dondolo_boundary, only : as_solver, check_interrupt, check_room, pack_response, report, set_records, set_walls
   use dondolo_error, only : error_type
   use dondolo_record, only : record_type
   use dondolo_scaling, only : new_scaling, scaling_type
   use dondolo_stripes, only : plan_stripes, run_histories, stripes_type
   use dondolo_study, only : new_study, study_type
   use dondolo_suite, only : new_suite, suite_type
   use dondolo_threads, only : team_of
   use dondolo_wall, only : wall_type
   use dondolo_work, only : work_type
   implicit none
   !f2py threadsafe
   character(len=*), intent(in) :: texts, names, im, polarity, engine
   integer(c_int), intent(in) :: q, w, r, n, m, threads, first, count, given(q, w), lengths(r)
   real(c_double), intent(in) :: numbers(q, w), gravity(w), dt(r), acceleration(n), values(r), levels(m), settings(5)
   real(c_double), intent(out) :: edp(count), time_of_peak(count), edp_error(count), work(7)
   integer(c_int), intent(out) :: collapsed(count), impacts(count), stat
   character(len=2048), intent(out) :: message
   type(wall_type), allocatable :: walls(:)
   type(record_type), allocatable :: records(:)
   type(suite_type), target :: suite
   type(study_type) :: study
   type(scaling_type) :: scaling
   type(stripes_type), allocatable :: stripes(:)
   type(work_type) :: total
   type(error_type), allocatable :: error
   integer, allocatable :: before(:)
   integer :: i, k, done, crew, shared_out

   edp = 0
   collapsed = 0
   impacts = 0
   time_of_peak = 0
   edp_error = 0
   call check_room(error, w, r, n, 2.0_c_double*w*r*m)
   if (.not. allocated(error)) then
      allocate (walls(w), stripes(w), before(w + 1))
      call set_walls(walls, texts, numbers, given, gravity, error)
   end if
   if (.not. allocated(error)) call new_scaling(scaling, im, error)
   if (.not. allocated(error)) call set_records(records, names, lengths, dt, acceleration)
   if (.not. allocated(error)) then
      call new_suite(suite, records)
      call new_study(study, suite, scaling, levels, polarity, as_solver(engine, settings), threads)
      study%values = values
      before(1) = 0
   end if
   do i = 1, w
      if (allocated(error)) exit
      call plan_stripes(stripes(i), walls(i), study, error)
      if (.not. allocated(error)) before(i + 1) = before(i) + size(stripes(i)%response)
   end do
   if (.not. allocated(error)) then
      ! As in run_case: as many walls as go round evenly are shared out, all threads work on each of the others.
      crew = team_of(threads, huge(1))
      shared_out = w - modulo(w, crew)
      !$omp parallel do schedule(dynamic) num_threads(crew) if(shared_out > 0) default(none) &
      !$omp & shared(shared_out, stripes, walls, study, first, count, before)
      do i = 1, shared_out
         call run_histories(stripes(i), walls(i), study, 1, max(first - before(i), 1), &
            & min(first + count - 1 - before(i), size(stripes(i)%response)))
      end do
      !$omp end parallel do
      do i = shared_out + 1, w
         call run_histories(stripes(i), walls(i), study, threads, max(first - before(i), 1), &
            & min(first + count - 1 - before(i), size(stripes(i)%response)))
      end do
      done = 0
      do i = 1, w
         call total%add(stripes(i)%work)
         associate (response => stripes(i)%response, n => size(stripes(i)%record))
            do k = max(first - before(i), 1), min(first + count - 1 - before(i), size(response))
               done = done + 1
               call pack_response(response(modulo(k - 1, n) + 1, (k - 1)/n + 1), edp(done), collapsed(done), &
                  & impacts(done), time_of_peak(done), edp_error(done))
            end do
         end associate
      end do
      call check_interrupt(error)
   end if
   work = real(total%counts(), c_double)
   call report(error, stat, message)
end subroutine run_block

! Run k histories of one wall: each has its record (numbered from 1) and its factor, negative to reverse the polarity
subroutine run_scaled(texts, numbers, given, q, gravity, names, lengths, dt, r, acceleration, n, record, scale, k, &
      & engine, settings, threads, edp, collapsed, impacts, time_of_peak, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use dondolo_boundary, only : as_solver, check_interrupt, check_room, pack_response, report, set_records, &
      & set_walls
   use dondolo_ensemble, only : check_engine, ensemble_type, run_ensemble
   use dondolo_error, only : error_type, raise_input
   use dondolo_record, only : largest_acceleration, record_type
   use dondolo_solver, only : check_limit, check_solver, solver_type
   use dondolo_suite, only : new_suite, suite_type
   use dondolo_text, only : to_text
   use dondolo_threads, only : check_threads
   use dondolo_wall, only : wall_type
   implicit none
   !f2py threadsafe
   character(len=*), intent(in) :: texts, names, engine
   integer(c_int), intent(in) :: q, given(q), r, n, k, threads, lengths(r), record(k)
   real(c_double), intent(in) :: numbers(q), gravity, dt(r), acceleration(n), scale(k), settings(5)
   real(c_double), intent(out) :: edp(k), time_of_peak(k)
   integer(c_int), intent(out) :: collapsed(k), impacts(k), stat
   character(len=2048), intent(out) :: message
   type(wall_type) :: walls(1)
   type(record_type), allocatable :: records(:)
   type(solver_type) :: solver
   type(ensemble_type) :: ensemble
   type(suite_type) :: suite
   type(error_type), allocatable :: error
   real(c_double), allocatable :: edp_error(:)
   integer :: i

   edp = 0
   collapsed = 0
   impacts = 0
   time_of_peak = 0
   solver = as_solver(engine, settings)
   call check_room(error, 1, r, n, real(k, c_double))
   if (.not. allocated(error)) call check_threads(threads, error)
   if (.not. allocated(error)) call set_walls(walls, texts, reshape(numbers, [q, 1]), reshape(given, [q, 1]), &
      & [gravity], error)
   if (.not. allocated(error)) call check_solver(solver, error)
   if (.not. allocated(error)) call check_limit(solver, walls(1)%mechanism, error)
   if (.not. allocated(error)) call check_engine(solver, walls(1)%mechanism, error)
   if (.not. allocated(error)) then
      call set_records(records, names, lengths, dt, acceleration)
      do i = 1, k
         if (abs(scale(i))*records(record(i))%pga() <= largest_acceleration) cycle
         call raise_input(error, 'scale = '//to_text(scale(i))//': makes record '''//records(record(i))%name// &
            & ''' exceed '//to_text(largest_acceleration)//' m/s2')
         exit
      end do
   end if
   if (.not. allocated(error)) then
      ensemble%record = record
      ensemble%scale = scale
      call new_suite(suite, records)
      call run_ensemble(ensemble, walls(1)%mechanism, suite, solver, threads)
      allocate (edp_error(k))
      call pack_response(ensemble%response, edp, collapsed, impacts, time_of_peak, edp_error)
      call check_interrupt(error)
   end if
   call report(error, stat, message)
end subroutine run_scaled

! A synthetic record: one realisation of the model of Sabetta and Pugliese (1996)
subroutine synthetic_record(magnitude, distance, site, seed, stream, deviations, handle, sizes, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_intptr_t
   use dondolo_boundary, only : pack_records, parcel_type, report, send
   use dondolo_error, only : error_type
   use dondolo_record, only : record_type
   use dondolo_synthetic, only : make_record => synthetic_record
   implicit none
   character(len=*), intent(in) :: site
   integer(c_int), intent(in) :: seed, stream
   real(c_double), intent(in) :: magnitude, distance, deviations
   integer(c_intptr_t), intent(out) :: handle
   integer(c_int), intent(out) :: sizes(3), stat
   character(len=2048), intent(out) :: message
   type(record_type) :: records(1)
   type(parcel_type) :: parcel
   type(error_type), allocatable :: error

   handle = 0
   sizes = 0
   call make_record(records(1), magnitude, distance, site, seed, stream, deviations, error)
   if (.not. allocated(error)) then
      call pack_records(records, parcel)
      call send(parcel, handle, sizes)
   end if
   call report(error, stat, message)
end subroutine synthetic_record

! Fit k curves, each to m levels. A status of 0 is a fit that failed; message tells of the first that went wrong
subroutine fit_curves(levels, collapses, histories, m, k, curves, statuses, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use dondolo_boundary, only : check_room, pack_curve, report, status_code
   use dondolo_error, only : error_type
   use dondolo_fragility, only : fit_fragility, fragility_type
   implicit none
   !f2py threadsafe
   integer(c_int), intent(in) :: m, k
   real(c_double), intent(in) :: levels(m), collapses(m, k), histories(m, k)
   real(c_double), intent(out) :: curves(8, k)
   integer(c_int), intent(out) :: statuses(k), stat
   character(len=2048), intent(out) :: message
   type(fragility_type) :: curve
   type(error_type), allocatable :: error
   character(len=2048) :: sentence
   integer(c_int) :: this
   integer :: i, worst

   curves = 0
   statuses = 0
   call check_room(error, reals=40.0_c_double*m)
   call report(error, stat, message)
   if (allocated(error)) return
   worst = k + 1
   !$omp parallel do default(none) private(curve, error, sentence, this) &
   !$omp & shared(k, levels, collapses, histories, curves, statuses, worst, stat, message)
   do i = 1, k
      call fit_fragility(curve, levels, collapses(:, i), histories(:, i), error)
      if (allocated(error)) then
         call report(error, this, sentence)
         !$omp critical (first_error)
         if (i < worst) then
            worst = i
            stat = this
            message = sentence
         end if
         !$omp end critical (first_error)
      else
         statuses(i) = status_code(curve)
      end if
      curves(:, i) = pack_curve(curve)
   end do
   !$omp end parallel do
end subroutine fit_curves

! Curves of rows (mechanisms of walls), of their walls and of the population. texts: name, mechanism and group of each
! row; rows: how many each wall has. Integers: number of the population's curves, statuses of the rows, of the walls and
! of the population's curves, and the number of walls in each of these; reals: numbers of the curves of the rows and of
! the walls, fractions of collapse of the walls, then for each of the population's curves weight, dispersions between
! walls and between records, share with a curve, saturation, histories, mean fractions, mean curve, fractiles (3 a level), numbers;
! text: group and mechanism of the population's curves, then warnings
subroutine fit_walls(texts, levels, collapses, m, r, histories, weights, p_occ, rows, w, handle, sizes, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_intptr_t
   use dondolo_boundary, only : check_room, pack_curve, pack_lines, pack_warnings, parcel_type, report, send, split_lines, &
      & status_code
   use dondolo_error, only : error_type
   use dondolo_fragility, only : fit_fragility, fragility_type
   use dondolo_lines, only : lines_type
   use dondolo_typology, only : combine_population, typology_type
   use dondolo_wall_curves, only : mechanism_counts_type, new_wall_curves, wall_curves_type
   use dondolo_warning, only : warnings_type
   use dondolo_warnings, only : fit_warning_type
   implicit none
   character(len=*), intent(in) :: texts
   integer(c_int), intent(in) :: m, r, w, collapses(m, r), histories(r), rows(w)
   real(c_double), intent(in) :: levels(m), weights(r), p_occ(r)
   integer(c_intptr_t), intent(out) :: handle
   integer(c_int), intent(out) :: sizes(3), stat
   character(len=2048), intent(out) :: message
   type(wall_curves_type), allocatable :: walls(:)
   type(fragility_type), allocatable :: curves(:)
   type(typology_type), allocatable :: groups(:)
   type(fit_warning_type) :: fits
   type(lines_type) :: words, lines
   type(warnings_type) :: warnings
   type(parcel_type) :: parcel
   type(error_type), allocatable :: error
   type(mechanism_counts_type), allocatable :: counts(:)
   real(c_double), allocatable :: parts(:, :), whole(:, :)
   integer :: first, last, i

   handle = 0
   sizes = 0
   call check_room(error, r + w, reals=16.0_c_double*m*(real(r, c_double) + w))
   if (.not. allocated(error)) then
      allocate (walls(w), curves(r), counts(r), whole(m, w))
      call split_lines(texts, words)
   end if
   do i = 1, r
      if (allocated(error)) exit
      call fit_fragility(curves(i), levels, real(collapses(:, i), c_double), &
         & spread(real(histories(i), c_double), 1, m), error)
      if (allocated(error)) exit
      call fits%look(curves(i), words%line(3*i - 2)%text)
      counts(i) = mechanism_counts_type(words%line(3*i - 1)%text, p_occ(i), curves(i), collapses(:, i), histories(i))
   end do
   last = 0
   do i = 1, w
      if (allocated(error)) exit
      first = last + 1
      last = last + rows(i)
      call new_wall_curves(walls(i), words%line(3*first)%text, weights(first), counts(first:last), levels, &
         & error)
      parts = walls(i)%fractions()
      whole(:, i) = parts(:, size(parts, 2))
   end do
   if (.not. allocated(error)) call combine_population(groups, walls, levels, error)
   if (.not. allocated(error)) then
      parcel%integers = [size(groups), (status_code(curves(i)), i=1, r), (status_code(walls(i)%combined), i=1, w), &
         & (status_code(groups(i)%fit), i=1, size(groups)), (groups(i)%walls, i=1, size(groups))]
      parcel%reals = [(pack_curve(curves(i)), i=1, r), (pack_curve(walls(i)%combined), i=1, w), &
         & whole, (groups(i)%weight, groups(i)%beta_walls, groups(i)%beta_records, groups(i)%fitted, &
         & groups(i)%saturation, groups(i)%histories, groups(i)%mean_fraction, groups(i)%mean_curve, groups(i)%fractile, &
         & pack_curve(groups(i)%fit), i=1, size(groups))]
      do i = 1, size(groups)
         call lines%add(groups(i)%group)
         call lines%add(groups(i)%mechanism)
      end do
      call fits%warn(groups, warnings)
      parcel%text = pack_lines(lines)
      call pack_warnings(warnings, parcel)
      call send(parcel, handle, sizes)
   end if
   call report(error, stat, message)
end subroutine fit_walls

! What the executable would warn of, of the curve of one wall; numbers and status as fit_curves has them
subroutine warn_of_curve(texts, numbers, given, q, gravity, levels, m, largest_edp, curve, status, handle, sizes, stat, &
      & message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_intptr_t
   use dondolo_boundary, only : pack_warnings, parcel_type, report, send, set_walls
   use dondolo_error, only : error_type
   use dondolo_fragility, only : fragility_type, status_names
   use dondolo_stripes, only : stripes_type
   use dondolo_wall, only : wall_type
   use dondolo_warning, only : warnings_type
   use dondolo_warnings, only : warn_of_fit
   implicit none
   character(len=*), intent(in) :: texts
   integer(c_int), intent(in) :: q, m, given(q), status
   real(c_double), intent(in) :: numbers(q), gravity, levels(m), largest_edp, curve(8)
   integer(c_intptr_t), intent(out) :: handle
   integer(c_int), intent(out) :: sizes(3), stat
   character(len=2048), intent(out) :: message
   type(wall_type) :: walls(1)
   type(stripes_type) :: stripes
   type(fragility_type) :: fragility
   type(warnings_type) :: warnings
   type(parcel_type) :: parcel
   type(error_type), allocatable :: error

   handle = 0
   sizes = 0
   call set_walls(walls, texts, reshape(numbers, [q, 1]), reshape(given, [q, 1]), [gravity], error)
   if (.not. allocated(error)) then
      fragility%status = status_names(status)
      fragility%theta = curve(1)
      fragility%bracket = curve(7:8)
      stripes%levels = levels
      ! Of the responses the sentences need the largest only
      allocate (stripes%response(1, 1))
      stripes%response%edp = largest_edp
      call warn_of_fit(walls(1), stripes, fragility, warnings)
      call pack_warnings(warnings, parcel)
      call send(parcel, handle, sizes)
   end if
   call report(error, stat, message)
end subroutine warn_of_curve

! What the executable would warn of, of estimated errors; record and level are those of the largest, without a record
! it is one history
subroutine warn_of_errors(edp, edp_error, n, edp_limit, record, level, handle, sizes, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_intptr_t
   use dondolo_boundary, only : check_room, pack_warnings, parcel_type, report, send
   use dondolo_error, only : error_type
   use dondolo_record, only : record_type
   use dondolo_stripes, only : stripes_type
   use dondolo_warning, only : warnings_type
   use dondolo_warnings, only : sentence => warn_of_error, sentences => warn_of_errors
   implicit none
   integer(c_int), intent(in) :: n
   real(c_double), intent(in) :: edp(n), edp_error(n), edp_limit, level
   character(len=*), intent(in) :: record
   integer(c_intptr_t), intent(out) :: handle
   integer(c_int), intent(out) :: sizes(3), stat
   character(len=2048), intent(out) :: message
   type(record_type) :: records(1)
   type(stripes_type) :: stripes
   type(warnings_type) :: warnings
   type(parcel_type) :: parcel
   type(error_type), allocatable :: error

   call check_room(error, histories=real(n, c_double))
   if (allocated(error)) then
      call report(error, stat, message)
      return
   end if
   records(1)%name = record
   stripes%levels = [level]
   stripes%record = spread(1, 1, n)
   allocate (stripes%response(n, 1))
   stripes%response(:, 1)%edp = edp
   stripes%response(:, 1)%edp_error = edp_error
   if (len(record) == 0) then
      call sentence(stripes%response(1, 1), edp_limit, warnings)
   else
      call sentences(stripes, records, edp_limit, warnings)
   end if
   call pack_warnings(warnings, parcel)
   call send(parcel, handle, sizes)
   call report(error, stat, message)
end subroutine warn_of_errors

! Probabilities of collapse of a lognormal curve, equation (5) of Nale et al.
subroutine probability(theta, beta, x, n, p)
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use dondolo_fragility, only : fragility_type
   implicit none
   !f2py threadsafe
   integer(c_int), intent(in) :: n
   real(c_double), intent(in) :: theta, beta, x(n)
   real(c_double), intent(out) :: p(n)
   type(fragility_type) :: curve

   curve%theta = theta
   curve%beta = beta
   p = curve%probability(x)
end subroutine probability

! Read a case. Integers: number of walls, of levels, of records, of EDP thresholds, threads, record of the history from
! 1, then walls and records as they are packed; reals: rtol, atol, edp_limit, 1 where errors are to be estimated, scale of
! the history (with its sign), levels, thresholds, then walls with their weights and probabilities, and records; text:
! task, title, output, im, polarity, engine, then walls, their groups, and records, and how its tables were read, where
! there is something to say of it
subroutine read_case(path, handle, sizes, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_intptr_t
   use dondolo_boundary, only : check_parcel, pack_lines, pack_members, pack_records, parcel_type, report, send
   use dondolo_case, only : case_type, load_case => read_case
   use dondolo_error, only : error_type
   use dondolo_lines, only : lines_type
   use dondolo_population, only : member_type, read_population
   implicit none
   character(len=*), intent(in) :: path
   integer(c_intptr_t), intent(out) :: handle
   integer(c_int), intent(out) :: sizes(3), stat
   character(len=2048), intent(out) :: message
   type(case_type) :: case
   type(member_type), allocatable :: members(:)
   type(parcel_type) :: parcel
   type(error_type), allocatable :: error
   type(lines_type) :: lines
   real(c_double) :: scale

   handle = 0
   sizes = 0
   call load_case(path, case, error)
   if (.not. allocated(error)) then
      if (case%job%task == 'typology') then
         call read_population(case%population_path(), members, error, case%solver%gravity)
      else
         allocate (members(1))
         members(1)%wall = case%wall
         members(1)%group = ''
      end if
   end if
   if (.not. allocated(error)) call check_parcel(error, size(members), case%suite%records)
   if (.not. allocated(error)) then
      if (.not. allocated(case%stripes%levels)) allocate (case%stripes%levels(0))
      scale = 1
      if (case%job%task == 'history') scale = case%history_scale()
      parcel%integers = [size(members), size(case%stripes%levels), size(case%suite%records), &
         & size(case%stripes%thresholds), case%job%threads, case%history%record]
      parcel%reals = [case%solver%solver%rtol, case%solver%solver%atol, case%solver%solver%edp_limit, &
         & merge(1.0_c_double, 0.0_c_double, case%solver%solver%estimate_error), scale, case%stripes%levels, &
         & case%stripes%thresholds]
      call lines%add(case%job%task)
      call lines%add(case%job%title)
      call lines%add(case%job%output)
      call lines%add(case%stripes%scaling%name)
      call lines%add(case%records_input%polarity)
      call lines%add(trim(case%solver%solver%engine))
      parcel%text = pack_lines(lines)
      call pack_members(members, parcel)
      call pack_records(case%suite%records, parcel)
      parcel%text = parcel%text//pack_lines(case%notes)
      call send(parcel, handle, sizes)
   end if
   call report(error, stat, message)
end subroutine read_case
