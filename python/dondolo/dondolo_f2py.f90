! The one boundary between Fortran and Python: all that f2py reads.
!
! Arguments are flat: c_double, c_int and bytes only, since f2py turns any other kind into a C float without a word.
! Records and walls are uploaded once and stay; every other procedure takes their handles (dondolo_handles). Records are
! one array of samples with their lengths, time steps and names (one a line); a wall is its properties in the order of
! their table (dondolo_wall_properties), a line for each text and q numbers with a mask of those given, and gravity.
! Status and message come last:
! 0, or the kind of the error (dondolo_error). Procedures that compute release Python's lock (threadsafe); those that call
! functions with results of deferred length keep it, since gfortran's are not safe in several threads (see dondolo_text).

! Version, defaults and limits that Python must not repeat
subroutine constants(defaults, version, statuses, errors)
   use, intrinsic :: iso_c_binding, only : c_double
   use dondolo_fragility, only : error_names, status_names
   use dondolo_solver, only : solver_type
   use dondolo_version, only : dondolo_version_text
   use dondolo_wall, only : standard_gravity
   implicit none
   ! rtol, atol, edp_limit, gravity
   real(c_double), intent(out) :: defaults(4)
   character(len=32), intent(out) :: version
   character(len=256), intent(out) :: statuses, errors
   type(solver_type) :: solver
   integer :: i

   defaults = [solver%rtol, solver%atol, solver%edp_limit, standard_gravity]
   version = dondolo_version_text
   statuses = ''
   do i = 1, size(status_names)
      statuses = trim(statuses)//' '//status_names(i)
   end do
   errors = ''
   do i = 1, size(error_names)
      errors = trim(errors)//' '//error_names(i)
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

! Free what a handle stands for; nothing, if that was done before
subroutine free(handle)
   use, intrinsic :: iso_c_binding, only : c_int64_t
   use dondolo_handles, only : release
   implicit none
   integer(c_int64_t), intent(in) :: handle

   call release(handle)
end subroutine free

! Upload records that Python has checked: a suite
subroutine new_suite(names, lengths, dt, r, acceleration, n, handle, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use dondolo_boundary, only : check_room, report, set_records
   use dondolo_error, only : error_type
   use dondolo_handles, only : hold
   use dondolo_record, only : record_type
   use dondolo_suite, only : make_suite => new_suite, suite_type
   implicit none
   character(len=*), intent(in) :: names
   integer(c_int), intent(in) :: r, n, lengths(r)
   real(c_double), intent(in) :: dt(r), acceleration(n)
   integer(c_int64_t), intent(out) :: handle
   integer(c_int), intent(out) :: stat
   character(len=2048), intent(out) :: message
   type(record_type), allocatable :: records(:)
   type(suite_type), pointer :: suite
   class(*), pointer :: content
   type(error_type), allocatable :: error

   handle = 0
   call check_room(error, records=r, samples=n)
   if (.not. allocated(error)) then
      call set_records(records, names, lengths, dt, acceleration)
      allocate (suite)
      call make_suite(suite, records)
      content => suite
      call hold(content, handle)
   end if
   call report(error, stat, message)
end subroutine new_suite

! Upload walls that Python has had described
subroutine new_walls(texts, numbers, given, q, gravity, w, handle, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use dondolo_boundary, only : check_room, report, set_walls
   use dondolo_error, only : error_type
   use dondolo_handles, only : hold, walls_type
   implicit none
   character(len=*), intent(in) :: texts
   integer(c_int), intent(in) :: q, w, given(q, w)
   real(c_double), intent(in) :: numbers(q, w), gravity(w)
   integer(c_int64_t), intent(out) :: handle
   integer(c_int), intent(out) :: stat
   character(len=2048), intent(out) :: message
   type(walls_type), pointer :: walls
   class(*), pointer :: content
   type(error_type), allocatable :: error

   handle = 0
   call check_room(error, walls=w)
   if (.not. allocated(error)) then
      allocate (walls)
      allocate (walls%wall(w))
      call set_walls(walls%wall, texts, numbers, given, gravity, error)
      content => walls
      if (allocated(error)) deallocate (walls)
   end if
   if (.not. allocated(error)) call hold(content, handle)
   call report(error, stat, message)
end subroutine new_walls

! Measure the records of a suite, which keeps the values for the studies to come
subroutine measure_suite(suite, im, threads, stat, message)
   use, intrinsic :: iso_c_binding, only : c_int, c_int64_t
   use dondolo_boundary, only : report
   use dondolo_error, only : error_type
   use dondolo_handles, only : find_suite
   use dondolo_scaling, only : new_scaling, scaling_type
   use dondolo_suite, only : suite_type
   use dondolo_threads, only : check_threads
   implicit none
   !f2py threadsafe
   integer(c_int64_t), intent(in) :: suite
   character(len=*), intent(in) :: im
   integer(c_int), intent(in) :: threads
   integer(c_int), intent(out) :: stat
   character(len=2048), intent(out) :: message
   type(suite_type), pointer :: records
   type(scaling_type) :: scaling
   type(error_type), allocatable :: error

   call find_suite(suite, records, error)
   if (.not. allocated(error)) call check_threads(threads, error)
   if (.not. allocated(error)) call new_scaling(scaling, im, error)
   if (.not. allocated(error)) call records%measure(scaling%measure, threads)
   call report(error, stat, message)
end subroutine measure_suite

! A study: a suite and how walls are tried under it. Without a measure its levels are factors on the records
subroutine new_study(suite, im, levels, m, polarity, engine, settings, threads, handle, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use dondolo_boundary, only : as_solver, report
   use dondolo_error, only : error_type
   use dondolo_handles, only : find_suite, held_study_type, hold
   use dondolo_scaling, only : new_scaling, scaling_type, unscaled
   use dondolo_study, only : make_study => new_study
   use dondolo_suite, only : suite_type
   use dondolo_threads, only : check_threads
   implicit none
   integer(c_int64_t), intent(in) :: suite
   character(len=*), intent(in) :: im, polarity, engine
   integer(c_int), intent(in) :: m, threads
   real(c_double), intent(in) :: levels(m), settings(5)
   integer(c_int64_t), intent(out) :: handle
   integer(c_int), intent(out) :: stat
   character(len=2048), intent(out) :: message
   type(suite_type), pointer :: records
   type(scaling_type) :: scaling
   type(held_study_type), pointer :: held
   class(*), pointer :: content
   type(error_type), allocatable :: error

   handle = 0
   call find_suite(suite, records, error)
   if (.not. allocated(error)) call check_threads(threads, error)
   if (.not. allocated(error)) then
      scaling = unscaled()
      if (len(im) > 0) call new_scaling(scaling, im, error)
   end if
   if (.not. allocated(error)) then
      allocate (held)
      held%suite = suite
      call make_study(held%study, records, scaling, levels, polarity, as_solver(engine, settings), threads)
      content => held
      call hold(content, handle)
   end if
   call report(error, stat, message)
end subroutine new_study

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
subroutine wall_terms(walls, rotation, n, terms, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use dondolo_boundary, only : check_rotations, report
   use dondolo_error, only : error_type
   use dondolo_handles, only : find_walls
   use dondolo_wall, only : wall_type
   implicit none
   !f2py threadsafe
   integer(c_int64_t), intent(in) :: walls
   integer(c_int), intent(in) :: n
   real(c_double), intent(in) :: rotation(n)
   real(c_double), intent(out) :: terms(n, 6)
   integer(c_int), intent(out) :: stat
   character(len=2048), intent(out) :: message
   type(wall_type), pointer :: people(:)
   type(error_type), allocatable :: error
   integer :: i

   terms = 0
   call find_walls(walls, people, error)
   if (.not. allocated(error)) call check_rotations(people(1)%mechanism, rotation, error)
   if (.not. allocated(error)) then
      associate (mechanism => people(1)%mechanism)
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

! Intensities of the records of a suite, in the unit of the levels
subroutine intensities(suite, im, r, gravity, threads, values, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use dondolo_boundary, only : report
   use dondolo_error, only : error_type
   use dondolo_handles, only : find_suite
   use dondolo_intensity, only : measure_type, new_measure
   use dondolo_suite, only : suite_type
   use dondolo_threads, only : check_threads
   implicit none
   !f2py threadsafe
   integer(c_int64_t), intent(in) :: suite
   character(len=*), intent(in) :: im
   integer(c_int), intent(in) :: r, threads
   real(c_double), intent(in) :: gravity
   real(c_double), intent(out) :: values(r)
   integer(c_int), intent(out) :: stat
   character(len=2048), intent(out) :: message
   type(measure_type) :: measure
   type(suite_type), pointer :: records
   type(error_type), allocatable :: error

   values = 0
   call find_suite(suite, records, error)
   if (.not. allocated(error)) call check_threads(threads, error)
   if (.not. allocated(error)) call new_measure(measure, im, error)
   if (.not. allocated(error)) then
      call records%measure(measure, threads)
      values = records%values(measure, threads)/measure%level_size(gravity)
   end if
   call report(error, stat, message)
end subroutine intensities

! Spectral displacements of a record
subroutine spectrum(suite, number, periods, m, damping, displacement, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use dondolo_boundary, only : check_room, check_spectrum, report
   use dondolo_error, only : error_type
   use dondolo_handles, only : find_suite
   use dondolo_response_spectrum, only : spectral_displacement
   use dondolo_suite, only : suite_type
   implicit none
   !f2py threadsafe
   integer(c_int64_t), intent(in) :: suite
   integer(c_int), intent(in) :: number, m
   real(c_double), intent(in) :: periods(m), damping
   real(c_double), intent(out) :: displacement(m)
   integer(c_int), intent(out) :: stat
   character(len=2048), intent(out) :: message
   type(suite_type), pointer :: records
   type(error_type), allocatable :: error

   displacement = 0
   call check_room(error, reals=10.0_c_double*m)
   if (.not. allocated(error)) call find_suite(suite, records, error)
   if (.not. allocated(error)) call check_spectrum(periods, damping, error)
   if (.not. allocated(error)) then
      displacement = spectral_displacement(records%records(number), periods, damping)
   end if
   call report(error, stat, message)
end subroutine spectrum

! Velocity of the ground at the samples of a record
subroutine ground_velocity(suite, number, n, velocity, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use dondolo_boundary, only : check_room, report
   use dondolo_error, only : error_type
   use dondolo_ground_motion, only : velocity_of => ground_velocity
   use dondolo_handles, only : find_suite
   use dondolo_suite, only : suite_type
   implicit none
   !f2py threadsafe
   integer(c_int64_t), intent(in) :: suite
   integer(c_int), intent(in) :: number, n
   real(c_double), intent(out) :: velocity(n)
   integer(c_int), intent(out) :: stat
   character(len=2048), intent(out) :: message
   type(suite_type), pointer :: records
   type(error_type), allocatable :: error

   velocity = 0
   call check_room(error, reals=3.0_c_double*n)
   if (.not. allocated(error)) call find_suite(suite, records, error)
   if (.not. allocated(error)) then
      velocity = velocity_of(records%records(number))
   end if
   call report(error, stat, message)
end subroutine ground_velocity

! Times at which the integral of the squared acceleration reaches two shares of its end value
subroutine significant_times(suite, number, low, high, times, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use dondolo_boundary, only : report
   use dondolo_energy_measures, only : times_of => significant_times
   use dondolo_error, only : error_type
   use dondolo_handles, only : find_suite
   use dondolo_suite, only : suite_type
   implicit none
   !f2py threadsafe
   integer(c_int64_t), intent(in) :: suite
   integer(c_int), intent(in) :: number
   real(c_double), intent(in) :: low, high
   real(c_double), intent(out) :: times(2)
   integer(c_int), intent(out) :: stat
   character(len=2048), intent(out) :: message
   type(suite_type), pointer :: records
   type(error_type), allocatable :: error

   times = 0
   call find_suite(suite, records, error)
   if (.not. allocated(error)) then
      times = times_of(records%records(number), low, high)
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
subroutine warn_of_motion(walls, record, pga, handle, sizes, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t, c_intptr_t
   use dondolo_boundary, only : pack_warnings, parcel_type, report, send
   use dondolo_error, only : error_type
   use dondolo_handles, only : find_walls
   use dondolo_plausibility, only : wall_warning_type
   use dondolo_record, only : record_type
   use dondolo_wall, only : wall_type
   use dondolo_warning, only : warnings_type
   use dondolo_warnings, only : warn_of_records
   implicit none
   integer(c_int64_t), intent(in) :: walls
   character(len=*), intent(in) :: record
   real(c_double), intent(in) :: pga
   integer(c_intptr_t), intent(out) :: handle
   integer(c_int), intent(out) :: sizes(3), stat
   character(len=2048), intent(out) :: message
   type(wall_type), pointer :: people(:)
   type(record_type) :: records(1)
   type(wall_warning_type) :: oddities
   type(warnings_type) :: warnings
   type(parcel_type) :: parcel
   type(error_type), allocatable :: error

   handle = 0
   sizes = 0
   call find_walls(walls, people, error)
   if (.not. allocated(error)) then
      call oddities%look(people(1))
      call oddities%warn(warnings)
      records(1)%name = record
      call warn_of_records(records, [pga], people(1)%gravity, warnings)
      if (warnings%count > 0) then
         call pack_warnings(warnings, parcel)
         call send(parcel, handle, sizes)
      end if
   end if
   call report(error, stat, message)
end subroutine warn_of_motion

! One motion; with history = 1 also the parcel of its rows: time, ground acceleration, rotation, velocity; as integers
! side and whether it is just after an impact
subroutine simulate(walls, suite, number, scale, engine, settings, history, &
      & edp, collapsed, impacts, time_of_peak, edp_error, handle, sizes, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t, c_intptr_t
   use dondolo_boundary, only : as_solver, check_interrupt, check_trace, pack_response, parcel_type, report, &
      & send
   use dondolo_error, only : error_type, raise_input
   use dondolo_handles, only : find_suite, find_walls
   use dondolo_record, only : largest_acceleration
   use dondolo_response, only : response_type, trace_type
   use dondolo_simulate, only : check_history, simulate_wall => simulate
   use dondolo_solver, only : check_limit, check_solver, solver_type
   use dondolo_suite, only : suite_type
   use dondolo_text, only : to_text
   use dondolo_wall, only : wall_type
   implicit none
   !f2py threadsafe
   integer(c_int64_t), intent(in) :: walls, suite
   character(len=*), intent(in) :: engine
   integer(c_int), intent(in) :: number, history
   real(c_double), intent(in) :: scale, settings(5)
   real(c_double), intent(out) :: edp, time_of_peak, edp_error
   integer(c_int), intent(out) :: collapsed, impacts
   integer(c_intptr_t), intent(out) :: handle
   integer(c_int), intent(out) :: sizes(3), stat
   character(len=2048), intent(out) :: message
   type(wall_type), pointer :: people(:)
   type(suite_type), pointer :: records
   type(solver_type) :: solver
   type(response_type) :: response
   type(trace_type) :: trace
   type(parcel_type) :: parcel
   type(error_type), allocatable :: error

   handle = 0
   sizes = 0
   call find_walls(walls, people, error)
   if (.not. allocated(error)) call find_suite(suite, records, error)
   solver = as_solver(engine, settings)
   if (.not. allocated(error)) call check_solver(solver, error)
   if (.not. allocated(error)) call check_limit(solver, people(1)%mechanism, error)
   if (.not. allocated(error)) call check_history(solver, people(1)%mechanism, history == 1, error)
   if (.not. allocated(error)) then
      if (.not. abs(scale)*records%peaks(number) <= largest_acceleration) call raise_input(error, 'scale = '// &
         & to_text(scale)//': makes record '''//records%records(number)%name//''' exceed '// &
         & to_text(largest_acceleration)//' m/s2')
   end if
   if (.not. allocated(error)) then
      if (history == 1) then
         call simulate_wall(people(1)%mechanism, records%records(number), scale, solver, response, trace)
         call check_interrupt(error)
         if (.not. allocated(error)) call check_trace(trace, error)
      else
         call simulate_wall(people(1)%mechanism, records%records(number), scale, solver, response)
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

! Check what stripes of walls would be, without running them: histories of a stripe of each, and the parcel of the warnings
subroutine plan(study, walls, w, histories, handle, sizes, stat, message)
   use, intrinsic :: iso_c_binding, only : c_int, c_int64_t, c_intptr_t
   use dondolo_boundary, only : pack_warnings, parcel_type, report, send
   use dondolo_error, only : add_place, error_type
   use dondolo_handles, only : find_study, find_walls
   use dondolo_plausibility, only : wall_warning_type
   use dondolo_solver, only : check_limit
   use dondolo_stripes, only : plan_stripes, stripes_type
   use dondolo_study, only : study_type
   use dondolo_wall, only : wall_type
   use dondolo_warning, only : warnings_type
   use dondolo_warnings, only : scale_warning_type, warn_of_records
   implicit none
   integer(c_int64_t), intent(in) :: study, walls
   integer(c_int), intent(in) :: w
   integer(c_int), intent(out) :: histories(w)
   integer(c_intptr_t), intent(out) :: handle
   integer(c_int), intent(out) :: sizes(3), stat
   character(len=2048), intent(out) :: message
   type(study_type), pointer :: chosen
   type(wall_type), pointer :: people(:)
   type(stripes_type) :: stripes
   type(scale_warning_type) :: scales
   type(wall_warning_type) :: oddities
   type(warnings_type) :: warnings
   type(parcel_type) :: parcel
   type(error_type), allocatable :: error
   integer :: i
   logical :: fresh

   handle = 0
   sizes = 0
   histories = 0
   call find_study(study, chosen, error)
   if (.not. allocated(error)) call find_walls(walls, people, error)
   do i = 1, w
      if (allocated(error)) exit
      ! Of a wall, sides and gravity alone count in most plans: most walls of a population share one.
      fresh = i == 1 .or. chosen%scaling%needs_wall()
      if (.not. fresh) fresh = people(i)%gravity < people(i - 1)%gravity .or. people(i)%gravity > people(i - 1)%gravity &
         & .or. (people(i)%mechanism%two_sided .neqv. people(i - 1)%mechanism%two_sided)
      if (fresh) then
         call plan_stripes(stripes, people(i), chosen, error)
      else
         call check_limit(chosen%solver, people(i)%mechanism, error)
      end if
      if (allocated(error)) then
         if (w > 1) call add_place(error, 'wall '''//people(i)%name()//'''')
         exit
      end if
      histories(i) = size(stripes%record)
      call scales%look(stripes, chosen%suite%records)
      call oddities%look(people(i))
   end do
   if (.not. allocated(error)) then
      call oddities%warn(warnings)
      call warn_of_records(chosen%suite%records, chosen%suite%peaks, people(1)%gravity, warnings)
      call scales%warn(warnings)
      if (warnings%count > 0) then
         call pack_warnings(warnings, parcel)
         call send(parcel, handle, sizes)
      end if
   end if
   call report(error, stat, message)
end subroutine plan

! Record (from 1) and polarity of the k histories of a stripe of one wall, and their scales at all levels
subroutine scales(study, walls, number, k, m, record, polarity, scale, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use dondolo_boundary, only : report
   use dondolo_error, only : error_type
   use dondolo_handles, only : find_study, find_walls
   use dondolo_stripes, only : plan_stripes, stripes_type
   use dondolo_study, only : study_type
   use dondolo_wall, only : wall_type
   implicit none
   integer(c_int64_t), intent(in) :: study, walls
   integer(c_int), intent(in) :: number, k, m
   integer(c_int), intent(out) :: record(k), polarity(k), stat
   real(c_double), intent(out) :: scale(k, m)
   character(len=2048), intent(out) :: message
   type(study_type), pointer :: chosen
   type(wall_type), pointer :: people(:)
   type(stripes_type) :: stripes
   type(error_type), allocatable :: error

   record = 0
   polarity = 0
   scale = 0
   call find_study(study, chosen, error)
   if (.not. allocated(error)) call find_walls(walls, people, error)
   if (.not. allocated(error)) call plan_stripes(stripes, people(number), chosen, error)
   if (.not. allocated(error)) then
      record = stripes%record
      polarity = stripes%polarity
      scale = stripes%scale
   end if
   call report(error, stat, message)
end subroutine scales

! Run `count` histories of walls `one` to `last`, which plan has checked, from number `first` of wall `one` on; they are
! numbered wall by wall and stripe by stripe. Counts of what was computed come in the order of work_names
subroutine run_block(study, walls, one, last, first, count, edp, collapsed, impacts, time_of_peak, edp_error, work, &
      & stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use dondolo_boundary, only : check_interrupt, check_room, report
   use dondolo_ensemble, only : ensemble_type
   use dondolo_error, only : error_type
   use dondolo_handles, only : find_study, find_walls
   use dondolo_stripes, only : histories_of, run_part
   use dondolo_study, only : study_type
   use dondolo_threads, only : team_of
   use dondolo_wall, only : wall_type
   use dondolo_work, only : work_type
   implicit none
   !f2py threadsafe
   integer(c_int64_t), intent(in) :: study, walls
   integer(c_int), intent(in) :: one, last, first, count
   real(c_double), intent(inout) :: edp(count), time_of_peak(count), edp_error(count)
   integer(c_int), intent(inout) :: collapsed(count), impacts(count)
   real(c_double), intent(out) :: work(7)
   integer(c_int), intent(out) :: stat
   character(len=2048), intent(out) :: message
   type(study_type), pointer :: chosen
   type(wall_type), pointer :: people(:)
   type(ensemble_type), allocatable :: part(:)
   type(work_type) :: total
   type(error_type), allocatable :: error
   integer, allocatable :: range(:, :)
   integer :: i, k, left, crew, shared_out

   call check_room(error, walls=last - one + 1, histories=real(count, c_double))
   if (.not. allocated(error)) call find_study(study, chosen, error)
   if (.not. allocated(error)) call find_walls(walls, people, error)
   if (.not. allocated(error)) then
      allocate (part(one:last), range(2, one:last))
      left = count
      range(1, :) = 1
      range(1, one) = first
      do i = one, last
         range(2, i) = min(histories_of(chosen, people(i))*size(chosen%levels), range(1, i) + left - 1)
         left = left - (range(2, i) - range(1, i) + 1)
      end do
      ! As in run_rows: as many walls as go round evenly are shared out, all threads work on each of the others.
      crew = team_of(chosen%threads, huge(1))
      shared_out = last - modulo(last - one + 1, crew)
      !$omp parallel do schedule(dynamic) num_threads(crew) if(shared_out >= one) default(none) &
      !$omp & shared(one, shared_out, chosen, people, range, part)
      do i = one, shared_out
         call run_part(part(i), people(i), chosen, 1, range(:, i))
      end do
      !$omp end parallel do
      do i = shared_out + 1, last
         call run_part(part(i), people(i), chosen, chosen%threads, range(:, i))
      end do
      k = 0
      do i = one, last
         call total%add(part(i)%work)
         associate (response => part(i)%response, to => k + size(part(i)%response))
            edp(k + 1:to) = response%edp
            collapsed(k + 1:to) = merge(1, 0, response%collapsed)
            impacts(k + 1:to) = response%impacts
            time_of_peak(k + 1:to) = response%time_of_peak
            edp_error(k + 1:to) = response%edp_error
         end associate
         k = k + size(part(i)%response)
      end do
      call check_interrupt(error)
   end if
   work = real(total%counts(), c_double)
   call report(error, stat, message)
end subroutine run_block

! Run k histories of one wall: each has its record (numbered from 1) and its factor, negative to reverse the polarity
subroutine run_scaled(walls, suite, record, scale, k, engine, settings, threads, edp, collapsed, impacts, time_of_peak, &
      & stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use dondolo_boundary, only : as_solver, check_interrupt, check_room, report
   use dondolo_ensemble, only : check_engine, ensemble_type, run_ensemble
   use dondolo_error, only : error_type, raise_input
   use dondolo_handles, only : find_suite, find_walls
   use dondolo_record, only : largest_acceleration
   use dondolo_solver, only : check_limit, check_solver, solver_type
   use dondolo_suite, only : suite_type
   use dondolo_text, only : to_text
   use dondolo_threads, only : check_threads
   use dondolo_wall, only : wall_type
   implicit none
   !f2py threadsafe
   integer(c_int64_t), intent(in) :: walls, suite
   character(len=*), intent(in) :: engine
   integer(c_int), intent(in) :: k, threads, record(k)
   real(c_double), intent(in) :: scale(k), settings(5)
   real(c_double), intent(out) :: edp(k), time_of_peak(k)
   integer(c_int), intent(out) :: collapsed(k), impacts(k), stat
   character(len=2048), intent(out) :: message
   type(wall_type), pointer :: people(:)
   type(suite_type), pointer :: records
   type(solver_type) :: solver
   type(ensemble_type) :: ensemble
   type(error_type), allocatable :: error
   integer :: i

   edp = 0
   collapsed = 0
   impacts = 0
   time_of_peak = 0
   solver = as_solver(engine, settings)
   call check_room(error, histories=real(k, c_double))
   if (.not. allocated(error)) call check_threads(threads, error)
   if (.not. allocated(error)) call find_walls(walls, people, error)
   if (.not. allocated(error)) call find_suite(suite, records, error)
   if (.not. allocated(error)) call check_solver(solver, error)
   if (.not. allocated(error)) call check_limit(solver, people(1)%mechanism, error)
   if (.not. allocated(error)) call check_engine(solver, people(1)%mechanism, error)
   do i = 1, k
      if (allocated(error)) exit
      if (.not. abs(scale(i))*records%peaks(record(i)) <= largest_acceleration) call raise_input(error, 'scale = '// &
         & to_text(scale(i))//': makes record '''//records%records(record(i))%name//''' exceed '// &
         & to_text(largest_acceleration)//' m/s2')
   end do
   if (.not. allocated(error)) then
      ensemble%record = record
      ensemble%scale = scale
      call run_ensemble(ensemble, people(1)%mechanism, records, solver, threads)
      edp = ensemble%response%edp
      collapsed = merge(1, 0, ensemble%response%collapsed)
      impacts = ensemble%response%impacts
      time_of_peak = ensemble%response%time_of_peak
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

! Clustered covariances (var ln theta, covariance, var beta) of k fitted curves from the collapses and histories of each of
! g clusters at each of m levels; the histories are the same for all curves if h is 1, else h is k. errors are places among
! the names, and clusters count those that have histories
subroutine cluster_curves(levels, collapses, histories, curves, statuses, m, g, k, h, covariances, errors, clusters, stat, &
      & message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use dondolo_boundary, only : check_room, report
   use dondolo_clustered, only : cluster_errors
   use dondolo_error, only : error_type
   use dondolo_fragility, only : error_names, fragility_type, status_names
   implicit none
   !f2py threadsafe
   integer(c_int), intent(in) :: m, g, k, h, statuses(k)
   real(c_double), intent(in) :: levels(m), collapses(m, g, k), histories(m, g, h), curves(8, k)
   real(c_double), intent(out) :: covariances(3, k)
   integer(c_int), intent(out) :: errors(k), clusters(k), stat
   character(len=2048), intent(out) :: message
   type(fragility_type) :: curve
   type(error_type), allocatable :: error
   real(c_double) :: changes(2, g)
   integer :: i

   covariances = 0
   errors = 0
   clusters = 0
   call check_room(error, reals=40.0_c_double*m)
   call report(error, stat, message)
   if (allocated(error)) return
   !$omp parallel do default(none) private(curve, changes) &
   !$omp & shared(k, h, levels, collapses, histories, curves, statuses, covariances) &
   !$omp & shared(errors, clusters)
   do i = 1, k
      curve = fragility_type(status=status_names(statuses(i)), theta=curves(1, i), beta=curves(2, i))
      call cluster_errors(curve, levels, collapses(:, :, i), histories(:, :, min(i, h)), changes)
      covariances(:, i) = [curve%covariance(1, 1), curve%covariance(1, 2), curve%covariance(2, 2)]
      errors(i) = findloc(error_names, curve%errors, dim=1)
      clusters(i) = curve%clusters
   end do
   !$omp end parallel do
end subroutine cluster_curves

! Change of ln theta and beta of a fitted curve if each of g clusters is left out, to first order; errors as cluster_curves
subroutine cluster_changes(levels, collapses, histories, theta, beta, m, g, changes, errors, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use dondolo_boundary, only : check_room, report
   use dondolo_clustered, only : cluster_errors
   use dondolo_error, only : error_type
   use dondolo_fragility, only : error_names, fragility_type
   implicit none
   integer(c_int), intent(in) :: m, g
   real(c_double), intent(in) :: levels(m), collapses(m, g), histories(m, g), theta, beta
   real(c_double), intent(out) :: changes(2, g)
   integer(c_int), intent(out) :: errors, stat
   character(len=2048), intent(out) :: message
   type(fragility_type) :: curve
   type(error_type), allocatable :: error

   changes = 0
   errors = 0
   call check_room(error, reals=40.0_c_double*m)
   call report(error, stat, message)
   if (allocated(error)) return
   curve = fragility_type(status='ok', theta=theta, beta=beta)
   call cluster_errors(curve, levels, collapses, histories, changes)
   errors = findloc(error_names, curve%errors, dim=1)
end subroutine cluster_changes

! Curves of rows (mechanisms of walls), of their walls and of the population. texts: mechanism and group of each row; names:
! of its wall; shares: weight and probability of occurrence of each row; rows: how many each wall has. Integers: number of
! the population's curves, statuses of the rows, of the walls and of the population's curves, and the number of walls in
! each of these; reals: numbers of the curves of the rows and of the walls, fractions of collapse of the walls, then for
! each of the population's curves weight, dispersions between walls and between records, share with a curve, saturation,
! histories, mean fractions, mean curve, fractiles (3 a level), numbers; text: group and mechanism of the population's
! curves, then warnings
subroutine fit_walls(texts, names, levels, collapses, m, r, histories, shares, rows, w, handle, sizes, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_intptr_t
   use dondolo_boundary, only : check_room, pack_curve, pack_lines, pack_warnings, parcel_type, report, send, split_lines, &
      & status_code
   use dondolo_error, only : error_type
   use dondolo_lines, only : lines_type
   use dondolo_population_boundary, only : new_population
   use dondolo_population_counts, only : population_counts_type
   use dondolo_typology, only : combine_population, typology_type
   use dondolo_wall_curves, only : wall_curves_type
   use dondolo_warning, only : warnings_type
   use dondolo_warnings, only : fit_warning_type
   implicit none
   character(len=*), intent(in) :: texts, names
   integer(c_int), intent(in) :: m, r, w, collapses(m, r), histories(r), rows(w)
   real(c_double), intent(in) :: levels(m), shares(2, r)
   integer(c_intptr_t), intent(out) :: handle
   integer(c_int), intent(out) :: sizes(3), stat
   character(len=2048), intent(out) :: message
   type(population_counts_type) :: population
   type(wall_curves_type) :: wall
   type(typology_type), allocatable :: groups(:)
   type(fit_warning_type) :: fits
   type(lines_type) :: words, lines
   type(warnings_type) :: warnings
   type(parcel_type) :: parcel
   type(error_type), allocatable :: error
   real(c_double), allocatable :: parts(:, :), whole(:, :)
   integer :: i

   handle = 0
   sizes = 0
   call check_room(error, r + w, reals=16.0_c_double*m*(real(r, c_double) + w))
   if (.not. allocated(error)) call new_population(population, texts, levels, collapses, histories, shares, rows, error)
   if (.not. allocated(error)) call population%fit(error)
   if (.not. allocated(error)) call combine_population(groups, population, 1, error)
   if (.not. allocated(error)) then
      call split_lines(names, words)
      do i = 1, r
         call fits%look(population%curve(1, i), words%line(i)%text)
      end do
      allocate (whole(m, w))
      do i = 1, w
         wall = population%wall(i, 1)
         parts = wall%fractions()
         whole(:, i) = parts(:, size(parts, 2))
      end do
      parcel%integers = [size(groups), (status_code(population%curve(1, i)), i=1, r), &
         & (status_code(population%combined(1, i)), i=1, w), (status_code(groups(i)%fit), i=1, size(groups)), &
         & (groups(i)%walls, i=1, size(groups))]
      parcel%reals = [(pack_curve(population%curve(1, i)), i=1, r), (pack_curve(population%combined(1, i)), i=1, w), &
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

! A curve of a population at n levels x: its weighted mean, and its fractiles for k shares of the weight. curves and
! statuses are those of the rows; mechanism 'all': the walls as a whole; group: empty for the whole population. With
! probabilities = 1 a parcel has their number as integer and their probabilities as reals (members, n)
subroutine curve_of_population(texts, levels, collapses, m, r, histories, shares, rows, w, curves, statuses, mechanism, group, &
      & x, n, q, k, probabilities, mean, fractiles, handle, sizes, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_intptr_t
   use dondolo_boundary, only : check_room, parcel_type, report, send
   use dondolo_error, only : error_type
   use dondolo_members, only : choose_members, members_type, population_probabilities
   use dondolo_population_boundary, only : new_population, set_curves
   use dondolo_population_counts, only : population_counts_type
   use dondolo_roster, only : number_of_group
   implicit none
   character(len=*), intent(in) :: texts, mechanism, group
   integer(c_int), intent(in) :: m, r, w, n, k, probabilities, collapses(m, r), histories(r), rows(w), statuses(r)
   real(c_double), intent(in) :: levels(m), shares(2, r), curves(8, r), x(n), q(k)
   real(c_double), intent(out) :: mean(n), fractiles(k, n)
   integer(c_intptr_t), intent(out) :: handle
   integer(c_int), intent(out) :: sizes(3), stat
   character(len=2048), intent(out) :: message
   ! Numbers that are held at a time: a few tens of MB
   integer, parameter :: most = 2000000
   type(population_counts_type) :: population
   type(members_type) :: members
   type(parcel_type) :: parcel
   type(error_type), allocatable :: error
   real(c_double), allocatable :: p(:, :), all(:, :)
   integer :: first, last, part

   handle = 0
   sizes = 0
   mean = 0
   fractiles = 0
   call check_room(error, r + w, reals=real(most, c_double))
   if (.not. allocated(error)) call new_population(population, texts, levels, collapses, histories, shares, rows, error)
   if (.not. allocated(error)) then
      call set_curves(population, curves, statuses)
      call choose_members(members, population, mechanism, number_of_group(population%groups, group))
      if (probabilities == 1) then
         call check_room(error, reals=4.0_c_double*real(size(members%column), c_double)*n)
         if (.not. allocated(error)) allocate (all(size(members%column), n))
      end if
   end if
   part = max(1, most/(r + w))
   do first = 1, n, part
      if (allocated(error)) exit
      last = min(first + part - 1, n)
      call population_probabilities(population, 1, x(first:last), p, error)
      if (allocated(error)) exit
      mean(first:last) = members%mean(p)
      fractiles(:, first:last) = members%fractiles(p, q)
      if (probabilities == 1) all(:, first:last) = transpose(p(:, members%column))
   end do
   if (.not. allocated(error) .and. probabilities == 1) then
      parcel%integers = [size(members%column)]
      parcel%reals = reshape(all, [size(all)])
      call send(parcel, handle, sizes)
   end if
   call report(error, stat, message)
end subroutine curve_of_population

! Open the store of walls, the rows of a population, under a study: a file, or memory where the path is empty. thresholds:
! EDP of the damage states, the last that of collapse. The handle must be given back by close_store
subroutine open_store(path, study, walls, thresholds, k, handle, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t, c_intptr_t
   use dondolo_boundary, only : report
   use dondolo_error, only : error_type
   use dondolo_fingerprint, only : fingerprint_type
   use dondolo_handles, only : find_study, find_walls
   use dondolo_identity, only : add_wall, study_identity
   use dondolo_population_boundary, only : hold_store
   use dondolo_store, only : open_file => open_store, store_type
   use dondolo_store_format, only : identity_type
   use dondolo_study, only : study_type
   use dondolo_wall, only : wall_type
   implicit none
   character(len=*), intent(in) :: path
   integer(c_int64_t), intent(in) :: study, walls
   integer(c_int), intent(in) :: k
   real(c_double), intent(in) :: thresholds(k)
   integer(c_intptr_t), intent(out) :: handle
   integer(c_int), intent(out) :: stat
   character(len=2048), intent(out) :: message
   type(study_type), pointer :: chosen
   type(wall_type), pointer :: people(:)
   type(study_type) :: own
   type(identity_type) :: identity
   type(store_type) :: store
   type(fingerprint_type) :: fingerprint
   type(error_type), allocatable :: error
   integer :: i

   handle = 0
   call find_study(study, chosen, error)
   if (.not. allocated(error)) call find_walls(walls, people, error)
   if (.not. allocated(error)) then
      own = chosen
      own%thresholds = thresholds
      do i = 1, size(people)
         call add_wall(fingerprint, people(i))
      end do
      call study_identity(own, fingerprint, size(people), 1, size(people), identity)
      call open_file(store, path, identity, error)
   end if
   if (.not. allocated(error)) call hold_store(store, handle)
   call report(error, stat, message)
end subroutine open_store

! Which of the w rows a store has (1), and the counts of what was computed for them in the order of work_names
subroutine store_state(handle, w, is_there, work)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_intptr_t
   use dondolo_population_boundary, only : store_of
   use dondolo_store, only : store_type
   implicit none
   integer(c_intptr_t), intent(in) :: handle
   integer(c_int), intent(in) :: w
   integer(c_int), intent(out) :: is_there(w)
   real(c_double), intent(out) :: work(7)
   type(store_type), pointer :: store
   integer :: i

   store => store_of(handle)
   is_there = [(merge(1, 0, store%has(i)), i=1, w)]
   work = real(store%work%counts(), c_double)
end subroutine store_state

! Make a store this process's to put rows in
subroutine claim_store(handle, stat, message)
   use, intrinsic :: iso_c_binding, only : c_int, c_intptr_t
   use dondolo_boundary, only : report
   use dondolo_error, only : error_type
   use dondolo_population_boundary, only : store_of
   use dondolo_store, only : store_type
   implicit none
   integer(c_intptr_t), intent(in) :: handle
   integer(c_int), intent(out) :: stat
   character(len=2048), intent(out) :: message
   type(store_type), pointer :: store
   type(error_type), allocatable :: error

   store => store_of(handle)
   call store%claim(error)
   call report(error, stat, message)
end subroutine claim_store

! Run w walls, rows of a population the first of which has number first, under a study; thresholds as for open_store.
! Integers: a block that put_block takes
subroutine run_rows(study, walls, w, thresholds, k, first, handle, sizes, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t, c_intptr_t
   use dondolo_boundary, only : check_interrupt, check_room, parcel_type, report, send
   use dondolo_error, only : error_type
   use dondolo_handles, only : find_study, find_walls
   use dondolo_population, only : member_type
   use dondolo_population_boundary, only : pack_block
   use dondolo_row_result, only : row_result_type, shape_type
   use dondolo_run_rows, only : run_block => run_rows
   use dondolo_study, only : study_type
   use dondolo_wall, only : wall_type
   implicit none
   !f2py threadsafe
   integer(c_int64_t), intent(in) :: study, walls
   integer(c_int), intent(in) :: w, k, first
   real(c_double), intent(in) :: thresholds(k)
   integer(c_intptr_t), intent(out) :: handle
   integer(c_int), intent(out) :: sizes(3), stat
   character(len=2048), intent(out) :: message
   type(study_type), pointer :: chosen
   type(wall_type), pointer :: people(:)
   type(study_type) :: own
   type(member_type), allocatable :: members(:)
   type(row_result_type), allocatable :: rows(:)
   type(parcel_type) :: parcel
   type(error_type), allocatable :: error
   integer :: i

   handle = 0
   sizes = 0
   call check_room(error, walls=w)
   if (.not. allocated(error)) call find_study(study, chosen, error)
   if (.not. allocated(error)) call find_walls(walls, people, error)
   if (.not. allocated(error)) then
      own = chosen
      own%thresholds = thresholds
      allocate (members(w))
      members%wall = people(:w)
      call run_block(own, members, rows, error, 0, 0)
   end if
   if (.not. allocated(error)) call check_interrupt(error)
   if (.not. allocated(error)) then
      rows%row = [(first + i - 1, i=1, w)]
      call pack_block(rows, shape_type(size(own%levels), size(thresholds)), parcel%integers)
      call send(parcel, handle, sizes)
   end if
   call report(error, stat, message)
end subroutine run_rows

! Put a block of rows into a store that was claimed; rows that are there already stay as they are
subroutine put_block(handle, block, n, count, stat, message)
   use, intrinsic :: iso_c_binding, only : c_int, c_intptr_t
   use dondolo_boundary, only : report
   use dondolo_error, only : error_type, raise_failure
   use dondolo_population_boundary, only : bytes_of_integers, store_of
   use dondolo_row_result, only : row_result_type
   use dondolo_store, only : store_type
   use dondolo_store_format, only : unpack_entries
   implicit none
   integer(c_intptr_t), intent(in) :: handle
   integer(c_int), intent(in) :: n, count, block(n)
   integer(c_int), intent(out) :: stat
   character(len=2048), intent(out) :: message
   type(store_type), pointer :: store
   type(row_result_type), allocatable :: rows(:)
   type(error_type), allocatable :: error
   character(len=:), allocatable :: bytes
   logical :: are_whole

   store => store_of(handle)
   call bytes_of_integers(block, bytes)
   call unpack_entries(bytes, store%identity%shape, count, rows, are_whole)
   if (.not. are_whole) then
      call raise_failure(error, 'a block of rows was damaged on its way')
   else
      call store%put(rows, error)
   end if
   call report(error, stat, message)
end subroutine put_block

! What a store has of its rows. Integers: histories of a stripe of each row, how many of them reach each state (levels,
! states, rows), 0 for rows that are not there; then the flags of the rows that are there, eight a byte, each row from a
! byte of its own on, and the number of these bytes last
subroutine read_store(handle, parcel_handle, sizes, stat, message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_intptr_t
   use dondolo_boundary, only : check_room, parcel_type, report, send
   use dondolo_error, only : error_type
   use dondolo_population_boundary, only : store_of
   use dondolo_row_result, only : row_result_type
   use dondolo_store, only : store_type
   implicit none
   integer(c_intptr_t), intent(in) :: handle
   integer(c_intptr_t), intent(out) :: parcel_handle
   integer(c_int), intent(out) :: sizes(3), stat
   character(len=2048), intent(out) :: message
   type(store_type), pointer :: store
   type(row_result_type) :: row
   type(parcel_type) :: parcel
   type(error_type), allocatable :: error
   integer(c_int), allocatable :: histories(:), reached(:, :, :)
   character(len=:), allocatable :: flags, more
   integer :: i, at

   parcel_handle = 0
   sizes = 0
   store => store_of(handle)
   associate (rows => store%identity%last, shape => store%identity%shape)
      call check_room(error, reals=8.0_c_double*rows*(shape%levels*shape%states + 16.0_c_double))
      if (.not. allocated(error)) then
         allocate (histories(rows), reached(shape%levels, shape%states, rows), source=0)
         allocate (character(len=1024) :: flags)
         at = 0
         do i = 1, rows
            if (.not. store%has(i)) cycle
            call store%read(i, row, error)
            if (allocated(error)) exit
            histories(i) = row%histories
            reached(:, :, i) = row%reached(shape)
            if (at + len(row%flags) > len(flags)) then
               allocate (character(len=2*(at + len(row%flags))) :: more)
               more(:at) = flags(:at)
               call move_alloc(more, flags)
            end if
            flags(at + 1:at + len(row%flags)) = row%flags
            at = at + len(row%flags)
         end do
      end if
   end associate
   if (.not. allocated(error)) then
      flags(at + 1:at + 3) = repeat(achar(0), 3)
      parcel%integers = [histories, reached, transfer(flags(:(at + 3)/4*4), [0_c_int]), at]
      call send(parcel, parcel_handle, sizes)
   end if
   call report(error, stat, message)
end subroutine read_store

! End with a store: its rows are brought into order if all are there, and its handle is of no use any more
subroutine close_store(handle)
   use, intrinsic :: iso_c_binding, only : c_intptr_t
   use dondolo_population_boundary, only : release_store
   implicit none
   integer(c_intptr_t), intent(in) :: handle

   call release_store(handle)
end subroutine close_store

! What the executable would warn of, of the curve of one wall; numbers and status as fit_curves has them
subroutine warn_of_curve(walls, levels, m, largest_edp, curve, status, handle, sizes, stat, &
      & message)
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t, c_intptr_t
   use dondolo_boundary, only : pack_warnings, parcel_type, report, send
   use dondolo_error, only : error_type
   use dondolo_handles, only : find_walls
   use dondolo_fragility, only : fragility_type, status_names
   use dondolo_stripes, only : stripes_type
   use dondolo_wall, only : wall_type
   use dondolo_warning, only : warnings_type
   use dondolo_warnings, only : warn_of_fit
   implicit none
   integer(c_int64_t), intent(in) :: walls
   integer(c_int), intent(in) :: m, status
   real(c_double), intent(in) :: levels(m), largest_edp, curve(8)
   integer(c_intptr_t), intent(out) :: handle
   integer(c_int), intent(out) :: sizes(3), stat
   character(len=2048), intent(out) :: message
   type(wall_type), pointer :: people(:)
   type(stripes_type) :: stripes
   type(fragility_type) :: fragility
   type(warnings_type) :: warnings
   type(parcel_type) :: parcel
   type(error_type), allocatable :: error

   handle = 0
   sizes = 0
   call find_walls(walls, people, error)
   if (.not. allocated(error)) then
      fragility%status = status_names(status)
      fragility%theta = curve(1)
      fragility%bracket = curve(7:8)
      stripes%levels = levels
      ! Of the responses the sentences need the largest only
      allocate (stripes%response(1, 1))
      stripes%response%edp = largest_edp
      call warn_of_fit(people(1), stripes, fragility, warnings)
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
