!> Records: uploading, measuring, reading and making them.
module records
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use dondolo_base_error, only : error_type, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_text, only : to_text
   use dondolo_base_threads, only : check_threads
   use dondolo_boundary, only : check_room, next_line
   use dondolo_files_csv_row, only : cell_type
   use dondolo_files_number_table, only : read_table => read_number_table
   use dondolo_fragility_scaling, only : new_scaling, scaling_type
   use dondolo_interface_handles, only : find_suite, hold, records_type
   use dondolo_parcel, only : parcel_type, report, send
   use dondolo_record, only : new_record, record_type
   use dondolo_record_dead_channel, only : check_motion, check_vertical_motion
   use dondolo_record_energy_measures, only : times_of => significant_times
   use dondolo_record_ground_motion, only : velocity_of => ground_velocity
   use dondolo_record_intensity, only : measure_type, new_measure
   use dondolo_record_metadata, only : metadata_type
   use dondolo_record_parcel, only : pack_records, set_labels, set_records
   use dondolo_record_response_spectrum, only : largest_period, smallest_period, spectral_displacement
   use dondolo_record_rows, only : record_rows_type
   use dondolo_record_suite, only : suite_type
   use dondolo_record_synthetic, only : make_record => synthetic_record
   use dondolo_records_catalogue, only : read_catalogue
   use dondolo_records_clusters, only : cluster_label, gather_suite
   use dondolo_records_days, only : stated_date
   use dondolo_records_direction, only : find_direction, vertical
   use dondolo_records_earthquake, only : find_date, find_difference, find_earthquake
   use dondolo_records_reading_notes, only : list_reading_notes
   use dondolo_records_record_reader, only : read_all => read_records, read_record
   use dondolo_records_record_table, only : record_table
   implicit none
   private

   public :: new_suite, measure_suite, check_record, join_vertical, describe_measure, intensities, spectrum, ground_velocity, &
      & significant_times, check_motions, labels_of, component_of, difference_of, cluster_labels, read_records, &
      & read_number_table, catalogue_table, synthetic_record

contains

   !> Upload records that Python has checked: a suite
   subroutine new_suite(names, labels, lengths, dt, r, acceleration, n, have_vertical, vertical, k, threads, handle, failure)
      character(len=*), intent(in) :: names, labels
      integer(c_int), intent(in) :: r, n, k, lengths(r), have_vertical(r), threads
      real(c_double), intent(in) :: dt(r), acceleration(n), vertical(k)
      integer(c_int64_t), intent(out) :: handle
      integer(c_int64_t), intent(out) :: failure(5)
      type(record_type), allocatable :: records(:)
      type(records_type), pointer :: held
      class(*), pointer :: content
      type(error_type), allocatable :: error

      handle = 0
      call check_threads(threads, error)
      if (.not. allocated(error)) call set_records(records, names, lengths, dt, acceleration, have_vertical, vertical, error)
      if (.not. allocated(error)) then
         call set_labels(records, labels)
         allocate (held)
         call gather_suite(held%suite, records, threads)
         content => held
         call hold(content, handle)
      end if
      call report(error, failure)
   end subroutine new_suite

   !> Measure the records of a suite, which keeps the values for the studies to come
   subroutine measure_suite(suite, im, threads, failure)
      !f2py threadsafe
      integer(c_int64_t), intent(in) :: suite
      character(len=*), intent(in) :: im
      integer(c_int), intent(in) :: threads
      integer(c_int64_t), intent(out) :: failure(5)
      type(suite_type), pointer :: records
      type(scaling_type) :: scaling
      type(error_type), allocatable :: error

      call find_suite(suite, records, error)
      if (.not. allocated(error)) call check_threads(threads, error)
      if (.not. allocated(error)) call new_scaling(scaling, im, error)
      if (.not. allocated(error)) call records%measure(scaling%measure, threads)
      call report(error, failure)
   end subroutine measure_suite

   !> Check what a record is to be made of; one without a vertical component gives the horizontal one twice
   subroutine check_record(acceleration, n, dt, vertical, pga, failure)
      !f2py threadsafe
      integer(c_int), intent(in) :: n
      real(c_double), intent(in) :: acceleration(n), dt, vertical(n)
      real(c_double), intent(out) :: pga
      integer(c_int64_t), intent(out) :: failure(5)
      type(record_type) :: record
      type(error_type), allocatable :: error

      pga = 0
      call check_room(error, samples=real(n, c_double))
      if (.not. allocated(error)) call new_record(record, acceleration, dt, '', error)
      if (.not. allocated(error)) call record%set_vertical(vertical, dt, 1.0_c_double, error)
      if (.not. allocated(error)) pga = record%pga()
      call report(error, failure)
   end subroutine check_record

   !> A record of n samples and a vertical component of m, on one grid. Reals: its step, samples of the record and as many of the
   !> vertical component
   subroutine join_vertical(acceleration, n, dt, vertical, m, vertical_dt, factor, sent)
      integer(c_int), intent(in) :: n, m
      real(c_double), intent(in) :: acceleration(n), dt, vertical(m), vertical_dt, factor
      integer(c_int64_t), intent(out) :: sent(5)
      type(record_type) :: record
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      call check_room(error, samples=real(n, c_double) + real(m, c_double))
      if (.not. allocated(error)) call new_record(record, acceleration, dt, '', error)
      if (.not. allocated(error)) call check_vertical_motion(vertical, error)
      if (.not. allocated(error)) call record%set_vertical(vertical, vertical_dt, factor, error)
      if (.not. allocated(error)) then
         call parcel%put('dt', record%dt)
         call parcel%put('acceleration', record%acceleration)
         call parcel%put('vertical', record%vertical)
      end if
      call send(parcel, error, sent)
   end subroutine join_vertical

   !> Check that the records of a suite are motions
   subroutine check_motions(suite, failure)
      integer(c_int64_t), intent(in) :: suite
      integer(c_int64_t), intent(out) :: failure(5)
      type(suite_type), pointer :: records
      type(error_type), allocatable :: error
      integer :: i

      call find_suite(suite, records, error)
      if (.not. allocated(error)) then
         do i = 1, size(records%records)
            call check_motion(records%records(i), error)
            if (allocated(error)) exit
         end do
      end if
      call report(error, failure)
   end subroutine check_motions

   !> What metadata say of the earthquake of a record: its name or origin, the label of the cluster, and the date, as it is stated
   !> where it is none of the calendar, each empty if it is not known
   subroutine labels_of(metadata, n, sent)
      !> Keys and values in turn, one a line, and how many pairs
      character(len=*), intent(in) :: metadata
      integer(c_int), intent(in) :: n
      integer(c_int64_t), intent(out) :: sent(5)
      type(metadata_type) :: known
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      character(len=:), allocatable :: label

      call take_metadata(metadata, n, known)
      call find_earthquake(known, label)
      call parcel%put('earthquake', label)
      call cluster_label(known, label)
      call parcel%put('cluster', label)
      call find_date(known, label)
      if (len(label) == 0) call stated_date(known, label)
      call parcel%put('date', label)
      call send(parcel, error, sent)
   end subroutine labels_of

   !> Which way the component of a record points: whether it is vertical, and the key and the value that show it, '' if nothing does
   subroutine component_of(metadata, n, name, sent)
      !> As of labels_of
      character(len=*), intent(in) :: metadata
      integer(c_int), intent(in) :: n
      !> Name of the record, or of its file
      character(len=*), intent(in) :: name
      integer(c_int64_t), intent(out) :: sent(5)
      type(metadata_type) :: known
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      character(len=:), allocatable :: key, label
      integer :: direction

      call take_metadata(metadata, n, known)
      call find_direction(known, name, direction, key, label)
      call parcel%put('key', key)
      call parcel%put('text', label)
      call parcel%put('is_vertical', merge(1, 0, direction == vertical))
      call send(parcel, error, sent)
   end subroutine component_of

   !> What two records differ in that cannot be components of one motion: a key, '' for none, and the two values
   subroutine difference_of(first, n, second, k, sent)
      !> Metadata of each as of labels_of
      character(len=*), intent(in) :: first, second
      integer(c_int), intent(in) :: n, k
      integer(c_int64_t), intent(out) :: sent(5)
      type(metadata_type) :: known(2)
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      character(len=:), allocatable :: key, one, other

      call take_metadata(first, n, known(1))
      call take_metadata(second, k, known(2))
      call find_difference(known(1), known(2), key, one, other)
      call parcel%put('key', key)
      call parcel%put('one', one)
      call parcel%put('other', other)
      call send(parcel, error, sent)
   end subroutine difference_of

   !> Take metadata from lines
   subroutine take_metadata(lines, n, metadata)
      !> Keys and values in turn, one a line, and how many pairs
      character(len=*), intent(in) :: lines
      integer(c_int), intent(in) :: n
      type(metadata_type), intent(out) :: metadata
      character(len=:), allocatable :: key, label
      integer(c_int64_t) :: at
      integer :: i

      at = 1
      do i = 1, n
         call next_line(lines, at, key)
         call next_line(lines, at, label)
         call metadata%set(key, label)
      end do
   end subroutine take_metadata

   !> Labels of the clusters of the records of a suite, as lines
   subroutine cluster_labels(suite, sent)
      integer(c_int64_t), intent(in) :: suite
      integer(c_int64_t), intent(out) :: sent(5)
      type(suite_type), pointer :: records
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      call find_suite(suite, records, error)
      if (.not. allocated(error)) parcel%lines = records%labels
      call send(parcel, error, sent)
   end subroutine cluster_labels

   !> An intensity measure, with of_record = 1 one of those that records have of themselves, durations too; else of those that
   !> records can be scaled by
   subroutine describe_measure(im, of_record, sent)
      character(len=*), intent(in) :: im
      integer(c_int), intent(in) :: of_record
      integer(c_int64_t), intent(out) :: sent(5)
      type(measure_type) :: measure
      type(scaling_type) :: scaling
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      if (of_record == 1) then
         call new_measure(measure, im, error)
      else
         call new_scaling(scaling, im, error)
      end if
      if (.not. allocated(error)) then
         if (of_record == 1) then
            call put_measure(parcel, measure%name, measure%unit(), measure%title(), measure%power())
         else
            call put_measure(parcel, scaling%name, scaling%unit(), scaling%title(), scaling%measure%power())
         end if
      end if
      call send(parcel, error, sent)
   end subroutine describe_measure

   !> Put an intensity measure
   subroutine put_measure(parcel, name, unit, title, power)
      type(parcel_type), intent(inout) :: parcel
      !> Name as dondolo writes it, unit of its levels, and what it is in words
      character(len=*), intent(in) :: name, unit, title
      !> Power of a record's scale that it grows by
      integer, intent(in) :: power

      call parcel%put('name', name)
      call parcel%put('unit', unit)
      call parcel%put('title', title)
      call parcel%put('power', power)
   end subroutine put_measure

   !> Intensities of the records of a suite, in the unit of the levels
   subroutine intensities(suite, im, r, gravity, threads, values, failure)
      !f2py threadsafe
      integer(c_int64_t), intent(in) :: suite
      character(len=*), intent(in) :: im
      integer(c_int), intent(in) :: r, threads
      real(c_double), intent(in) :: gravity
      real(c_double), intent(out) :: values(r)
      integer(c_int64_t), intent(out) :: failure(5)
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
      call report(error, failure)
   end subroutine intensities

   !> Spectral displacements of a record
   subroutine spectrum(suite, number, periods, m, damping, displacement, failure)
      !f2py threadsafe
      integer(c_int64_t), intent(in) :: suite
      integer(c_int), intent(in) :: number, m
      real(c_double), intent(in) :: periods(m), damping
      real(c_double), intent(out) :: displacement(m)
      integer(c_int64_t), intent(out) :: failure(5)
      type(suite_type), pointer :: records
      type(error_type), allocatable :: error

      displacement = 0
      call check_room(error, reals=10.0_c_double*m)
      if (.not. allocated(error)) call find_suite(suite, records, error)
      if (.not. allocated(error)) call check_spectrum(periods, damping, error)
      if (.not. allocated(error)) displacement = spectral_displacement(records%records(number), periods, damping)
      call report(error, failure)
   end subroutine spectrum

   !> Check the oscillators of a response spectrum
   subroutine check_spectrum(periods, damping, error)
      !> Periods [s]
      real(c_double), intent(in) :: periods(:)
      !> Damping ratio
      real(c_double), intent(in) :: damping
      !> The first that cannot be
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      if (.not. (damping >= 0.0_c_double .and. damping < 1.0_c_double)) then
         call raise_input(error, 'damping = '//to_text(damping)//': must be at least 0 and below 1')
         return
      end if
      do i = 1, size(periods)
         if (periods(i) >= smallest_period .and. periods(i) <= largest_period) cycle
         call raise_input(error, 'periods = '//to_text(periods(i))//': must lie between '//to_text(smallest_period)// &
            & ' and '//to_text(largest_period)//' s')
         return
      end do
   end subroutine check_spectrum

   !> Velocity of the ground at the samples of a record
   subroutine ground_velocity(suite, number, n, velocity, failure)
      !f2py threadsafe
      integer(c_int64_t), intent(in) :: suite
      integer(c_int), intent(in) :: number, n
      real(c_double), intent(out) :: velocity(n)
      integer(c_int64_t), intent(out) :: failure(5)
      type(suite_type), pointer :: records
      type(error_type), allocatable :: error

      velocity = 0
      call check_room(error, reals=3.0_c_double*n)
      if (.not. allocated(error)) call find_suite(suite, records, error)
      if (.not. allocated(error)) velocity = velocity_of(records%records(number))
      call report(error, failure)
   end subroutine ground_velocity

   !> Times at which the integral of the squared acceleration reaches two shares of its end value
   subroutine significant_times(suite, number, low, high, times, failure)
      !f2py threadsafe
      integer(c_int64_t), intent(in) :: suite
      integer(c_int), intent(in) :: number
      real(c_double), intent(in) :: low, high
      real(c_double), intent(out) :: times(2)
      integer(c_int64_t), intent(out) :: failure(5)
      type(suite_type), pointer :: records
      type(error_type), allocatable :: error

      times = 0
      call find_suite(suite, records, error)
      if (.not. allocated(error)) times = times_of(records%records(number), low, high)
      call report(error, failure)
   end subroutine significant_times

   !> Read accelerograms: what = 0 one channel of a file, 1 all of a catalogue, 2 all channels of a file; texts are empty
   !> where they are not given. Vertical components of a catalogue are read with vertical = 1. Beside what pack_records has there
   !> are of a catalogue with levels row_record, row_level and row_factor of each row, 0 where it has none, and notes
   subroutine read_records(path, what, dt_given, dt, units, channel, layout, columns, vertical, vertical_factor, sent)
      !f2py threadsafe
      character(len=*), intent(in) :: path, units, channel, layout, columns
      integer(c_int), intent(in) :: what, dt_given, vertical
      real(c_double), intent(in) :: dt, vertical_factor
      integer(c_int64_t), intent(out) :: sent(5)
      type(record_type), allocatable :: records(:)
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      character(len=:), allocatable :: note
      real(c_double), allocatable :: step, factor
      type(record_rows_type) :: rows
      type(lines_type) :: notes, sentences
      integer :: i

      ! A step or a factor that is not allocated is an argument that is not present
      if (dt_given == 1) step = dt
      if (vertical == 1) factor = vertical_factor
      select case (what)
      case (0)
         allocate (records(1))
         call read_record(path, records(1), error, step, units, channel, layout, columns)
      case (1)
         call read_catalogue(path, records, error, note, rows, factor)
      case default
         call read_all(path, records, error, step, units, layout, columns)
      end select
      if (.not. allocated(error)) then
         call list_reading_notes(records, notes)
         if (rows%have_levels) then
            call parcel%put('row_record', rows%record)
            call parcel%put('row_level', rows%level)
            call parcel%put('row_factor', rows%factor)
         end if
         if (allocated(note)) then
            if (len(note) > 0) call sentences%add(note)
         end if
         do i = 1, notes%count
            call sentences%add(notes%line(i)%text)
         end do
         call parcel%put('notes', sentences)
         call pack_records(records, parcel, error)
      end if
      call send(parcel, error, sent)
   end subroutine read_records

   !> Read a table of numbers: the names of its columns, its numbers (columns, rows), and notes: how it was read, where there is
   !> something to say of it
   subroutine read_number_table(path, sent)
      character(len=*), intent(in) :: path
      integer(c_int64_t), intent(out) :: sent(5)
      type(cell_type), allocatable :: columns(:)
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      type(lines_type) :: names
      real(wp), allocatable :: values(:, :)
      character(len=:), allocatable :: note
      integer :: i

      call read_table(path, columns, values, note, error)
      if (.not. allocated(error)) then
         do i = 1, size(columns)
            call names%add(columns(i)%text)
         end do
         call parcel%put('columns', names)
         call parcel%put('numbers', reshape(values, [size(values)]), shape(values))
         call parcel%put_note(note)
      end if
      call send(parcel, error, sent)
   end subroutine read_number_table

   !> The table of the records of a catalogue, and notes: how the catalogue was read, where there is something to say of it
   subroutine catalogue_table(path, gravity, sent)
      character(len=*), intent(in) :: path
      real(c_double), intent(in) :: gravity
      integer(c_int64_t), intent(out) :: sent(5)
      type(record_type), allocatable :: records(:)
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      character(len=:), allocatable :: note

      call read_catalogue(path, records, error, note)
      if (.not. allocated(error)) then
         call parcel%put('table', record_table(records, gravity))
         call parcel%put_note(note)
      end if
      call send(parcel, error, sent)
   end subroutine catalogue_table

   !> A synthetic record: one realisation of the model of Sabetta and Pugliese (1996)
   subroutine synthetic_record(magnitude, distance, site, seed, stream, deviations, sent)
      character(len=*), intent(in) :: site
      integer(c_int), intent(in) :: seed, stream
      real(c_double), intent(in) :: magnitude, distance, deviations
      integer(c_int64_t), intent(out) :: sent(5)
      type(record_type) :: records(1)
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      call make_record(records(1), magnitude, distance, site, seed, stream, deviations, error)
      if (.not. allocated(error)) call pack_records(records, parcel, error)
      call send(parcel, error, sent)
   end subroutine synthetic_record

end module records
