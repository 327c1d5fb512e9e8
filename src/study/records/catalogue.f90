!> A catalogue of records: a CSV table with the columns file, dt_s, units, channel, format, columns and name, level and factor, and
!> any others, which are metadata of the records; records of one `event` depend on each other (dondolo_records_clusters).
!>
!> With a column level a row is a record at a level of intensity, and a record may have several rows; where the cell is
!> empty it runs at every level. With a column factor a cell is the factor on the record there, instead of one computed
!> from the intensity measure. A column vertical names the vertical component of a record.
!>
!> Each record has a name of its own. Where the catalogue gives none and stems of files are the same, the names get the
!> extensions of the files; where these are the same too, the folders, as the catalogue writes them.
module dondolo_records_catalogue
   use dondolo_base_error, only : add_place, error_type, problems_type, raise_input, status_input, status_missing
   use dondolo_base_kinds, only : wp
   use dondolo_base_limits, only : most_records
   use dondolo_base_lines, only : lines_type
   use dondolo_base_memory, only : check_room
   use dondolo_base_plain, only : name_problem, shown, visible
   use dondolo_base_text, only : to_text
   use dondolo_base_threads, only : team_of
   use dondolo_files_csv_reader, only : csv_row_type, csv_table_type
   use dondolo_files_name_index, only : name_index_type
   use dondolo_record, only : record_type
   use dondolo_record_rows, only : record_rows_type
   use dondolo_records_catalogue_source, only : describe_source, read_source, source_type, take_source
   use dondolo_records_channel, only : stem
   use dondolo_records_record_reader, only : read_records
   implicit none
   private

   public :: read_catalogue

   !> Memory that a row takes, its samples and metadata left aside [bytes]
   real(wp), parameter :: bytes_of_row = 1000.0_wp

   !> What is wrong with one of several rows
   type :: failure_type
      !> Not allocated: nothing
      type(error_type), allocatable :: error
   end type failure_type

contains

   !> Read all records of a catalogue
   subroutine read_catalogue(file, records, error, note, rows, vertical_factor, threads)
      !> Path of the catalogue; files in it are relative to its folder
      character(len=*), intent(in) :: file
      !> The records, each once
      type(record_type), allocatable, intent(out) :: records(:)
      !> What is wrong with the catalogue, or with each of its rows
      type(error_type), allocatable, intent(out) :: error
      !> How the catalogue was read: a note, or empty
      character(len=:), allocatable, intent(out), optional :: note
      !> Its rows: which records run at which levels
      type(record_rows_type), intent(out), optional :: rows
      !> Factor on the vertical components; absent: they are not read
      real(wp), intent(in), optional :: vertical_factor
      !> Threads that read the files; 0 or absent: all that OpenMP gives
      integer, intent(in), optional :: threads

      type(csv_table_type) :: table
      type(lines_type) :: paths, places, names
      type(record_rows_type) :: runs
      type(source_type), allocatable :: sources(:)
      type(failure_type), allocatable :: failures(:)
      integer :: number, count, row, asked

      call table%read(file, error)
      if (.not. allocated(error)) call count_rows(table, number, error)
      if (allocated(error)) then
         if (is_accelerogram(file)) then
            deallocate (error)
            call raise_input(error, file//': no column ''file'': it looks like an accelerogram, not a catalogue, which is '// &
               & 'a table of records: write one with a row for it, its path in the column file, or make one of a folder by '// &
               & 'dondolo catalogue FOLDER')
         end if
      end if
      if (.not. allocated(error)) call check_room(bytes_of_row*real(number, wp), error)
      if (allocated(error)) return
      call table%find_decimal_mark([table%column('dt_s'), table%column('level'), table%column('factor')])
      if (present(vertical_factor) .and. table%column('vertical') == 0) then
         call raise_input(error, file//': no column ''vertical'': must name the vertical component of each record')
         return
      end if
      if (present(note)) note = table%note()
      allocate (sources(number), failures(number))
      call take_rows(table, present(vertical_factor), runs, sources, count, failures)
      allocate (records(count))
      asked = 0
      if (present(threads)) asked = threads
      call read_files(sources(:count), team_of(asked, count), records, failures, vertical_factor)
      call join_failures(failures, error)
      if (.not. allocated(error)) then
         do row = 1, count
            call paths%add(sources(row)%written)
            call places%add(sources(row)%place)
            call names%add(sources(row)%name)
         end do
         call name_records(paths, places, names, records, error)
      end if
      if (allocated(error)) then
         deallocate (records)
      else if (present(rows)) then
         rows = runs
      end if
   end subroutine read_catalogue

   !> Take the rows
   subroutine take_rows(table, with_verticals, runs, sources, count, failures)
      !> The catalogue
      type(csv_table_type), intent(in) :: table
      !> Are vertical components read?
      logical, intent(in) :: with_verticals
      !> Which records run at which levels
      type(record_rows_type), intent(out) :: runs
      !> Where the records are, as many as there are rows at least
      type(source_type), intent(inout) :: sources(:)
      !> How many records there are, those of rows that are wrong left aside
      integer, intent(out) :: count
      !> What is wrong with each row
      type(failure_type), intent(inout) :: failures(:)

      type(csv_row_type) :: row
      type(name_index_type) :: known
      character(len=:), allocatable :: described
      integer :: i, earlier
      logical :: found

      runs%have_levels = table%column('level') > 0
      allocate (runs%record(size(sources)))
      allocate (runs%level(size(sources)), runs%factor(size(sources)), source=0.0_wp)
      count = 0
      do i = 1, size(sources)
         call table%next(row, found, failures(i)%error)
         ! What follows cannot be told into rows
         if (allocated(failures(i)%error)) return
         call read_run(table, row, runs%level(i), runs%factor(i), failures(i)%error)
         if (allocated(failures(i)%error)) cycle
         ! Of a record at several levels the first row reads it.
         earlier = 0
         if (runs%have_levels) then
            call describe_source(table, row, described)
            call known%note(described, count + 1, earlier)
         end if
         if (earlier == 0) then
            call take_source(table, row, with_verticals, sources(count + 1), failures(i)%error)
            if (allocated(failures(i)%error)) cycle
            count = count + 1
            sources(count)%row = i
            earlier = count
         end if
         runs%record(i) = earlier
         call runs%place%add(table%place(row))
      end do
   end subroutine take_rows

   !> Read the files of records side by side
   subroutine read_files(sources, threads, records, failures, vertical_factor)
      !> Where they are
      type(source_type), intent(in) :: sources(:)
      !> Threads
      integer, intent(in) :: threads
      type(record_type), intent(inout) :: records(:)
      !> What is wrong with each row; what is wrong with files is added
      type(failure_type), intent(inout) :: failures(:)
      !> Factor on the vertical components; absent: they are not read
      real(wp), intent(in), optional :: vertical_factor

      integer :: i

      !$omp parallel do num_threads(threads) default(none) shared(sources, records, failures, vertical_factor) schedule(dynamic)
      do i = 1, size(sources)
         call read_source(sources(i), records(i), failures(sources(i)%row)%error, vertical_factor)
      end do
      !$omp end parallel do
   end subroutine read_files

   !> Report what is wrong with rows, in their order
   subroutine join_failures(failures, error)
      !> What is wrong with each row; not allocated afterwards
      type(failure_type), intent(inout) :: failures(:)
      !> All of it that there is room for
      type(error_type), allocatable, intent(out) :: error

      type(problems_type) :: problems
      logical :: are_missing
      integer :: i

      are_missing = .true.
      do i = 1, size(failures)
         if (.not. allocated(failures(i)%error)) cycle
         select case (failures(i)%error%stat)
         case (status_missing)
         case (status_input)
            are_missing = .false.
         case default
            ! No memory, say: it is the machine's fault and not the catalogue's
            call move_alloc(failures(i)%error, error)
            return
         end select
         call problems%take(failures(i)%error)
      end do
      call problems%raise(error)
      if (allocated(error) .and. are_missing) error%stat = status_missing
   end subroutine join_failures

   !> Read the level and the factor of a row
   subroutine read_run(table, row, level, factor, error)
      !> The catalogue, and a row of it
      type(csv_table_type), intent(in) :: table
      type(csv_row_type), intent(in) :: row
      !> Level; 0: every level
      real(wp), intent(inout) :: level
      !> Factor; 0: computed
      real(wp), intent(inout) :: factor
      !> A level or a factor that is none
      type(error_type), allocatable, intent(out) :: error

      call read_positive(table, row, 'level', level, error)
      if (.not. allocated(error)) call read_positive(table, row, 'factor', factor, error)
      if (allocated(error) .or. .not. factor > 0.0_wp .or. level > 0.0_wp) return
      call raise_input(error, table%place(row)//': factor = '//to_text(factor)//': needs the level at which it applies')
   end subroutine read_run

   !> Read a cell with a positive number
   subroutine read_positive(table, row, name, value, error)
      !> The catalogue, and a row of it
      type(csv_table_type), intent(in) :: table
      type(csv_row_type), intent(in) :: row
      !> Name of the column
      character(len=*), intent(in) :: name
      !> The number; stays as it is where the cell is empty
      real(wp), intent(inout) :: value
      !> No number, or not positive
      type(error_type), allocatable, intent(out) :: error

      if (len_trim(row%get_text(table%column(name))) == 0) return
      call table%get_real(row, table%column(name), value, error)
      call add_place(error, table%place(row))
      if (allocated(error)) return
      if (.not. (value > 0.0_wp .and. value <= huge(value))) call raise_input(error, table%place(row)//': '//name//' = '// &
         & to_text(value)//': must be positive')
   end subroutine read_positive

   !> Can a file be read as an accelerogram, perhaps with a time step and units that it does not state?
   logical function is_accelerogram(file)
      !> Its path
      character(len=*), intent(in) :: file

      type(record_type), allocatable :: records(:)
      type(error_type), allocatable :: error
      real(wp), allocatable :: dt
      character(len=1) :: units
      integer :: attempt

      is_accelerogram = .false.
      do attempt = 0, 3
         units = ' '
         if (mod(attempt, 2) == 1) units = 'g'
         if (attempt == 2) allocate (dt, source=0.01_wp)
         ! A dt that is not allocated is an argument that is not present
         call read_records(file, records, error, dt, units)
         is_accelerogram = .not. allocated(error)
         if (is_accelerogram) return
      end do
   end function is_accelerogram

   !> Look through a catalogue before its records are read
   subroutine count_rows(table, rows, error)
      !> The catalogue
      type(csv_table_type), intent(in) :: table
      !> Number of its rows
      integer, intent(out) :: rows
      !> It is no table, or not of records
      type(error_type), allocatable, intent(out) :: error

      type(csv_row_type) :: row
      type(problems_type) :: problems
      logical :: found

      rows = 0
      if (table%column('file') == 0) call problems%note(table%file//': no column ''file'': must have file, and dt_s and '// &
         & 'units where the files do not state them')
      if (table%column('dt') > 0 .and. table%column('dt_s') == 0) call problems%note(table%file// &
         & ': column ''dt'': the time step must be in the column dt_s, in seconds')
      if (table%column('unit') > 0 .and. table%column('units') == 0) call problems%note(table%file// &
         & ': column ''unit'': the units of the accelerations must be in the column units')
      call problems%raise(error)
      if (allocated(error)) return
      do
         call table%next(row, found, error)
         if (allocated(error) .or. .not. found) exit
         rows = rows + 1
         if (rows <= most_records) cycle
         call raise_input(error, table%file//': more than '//to_text(most_records)//' records')
         exit
      end do
      if (rows == 0 .and. .not. allocated(error)) call raise_input(error, table%file//': no records')
   end subroutine count_rows

   !> Give every record a name of its own
   subroutine name_records(paths, places, names, records, error)
      !> Path of each file as the catalogue writes it
      type(lines_type), intent(in) :: paths
      !> Where each row is
      type(lines_type), intent(in) :: places
      !> Name of each that is given, or nothing
      type(lines_type), intent(in) :: names
      !> The records, named by the stems of their files
      type(record_type), intent(inout) :: records(:)
      !> Two records are the same, or have the same name given, or a name is not plain
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: path, file
      logical :: is_given(size(records)), again(size(records))
      integer :: length(size(records)), first(size(records)), row, level

      do row = 1, size(records)
         is_given(row) = len(names%line(row)%text) > 0
         if (is_given(row)) records(row)%name = names%line(row)%text
         if (len_trim(name_problem(records(row)%name)) > 0) then
            call raise_input(error, places%line(row)%text//': name = '''//shown(records(row)%name)//''': '// &
               & trim(name_problem(records(row)%name)))
            return
         end if
         ! What follows is the channel
         length(row) = len(stem(paths%line(row)%text))
      end do
      do level = 1, 2
         call find_first(records, first)
         again = .false.
         do row = 1, size(records)
            if (first(row) == row) cycle
            again(row) = .true.
            again(first(row)) = .true.
         end do
         do row = 1, size(records)
            if (is_given(row) .or. .not. again(row)) cycle
            path = trim(paths%line(row)%text)
            file = path(scan(path, '/\', back=.true.) + 1:)
            if (level == 2) file = path
            records(row)%name = visible(file)//records(row)%name(length(row) + 1:)
            length(row) = len(file)
         end do
      end do
      call find_first(records, first)
      do row = 1, size(records)
         if (first(row) == row) cycle
         call raise_input(error, places%line(row)%text//': record '''//records(row)%name//''' is a duplicate')
         return
      end do
   end subroutine name_records

   !> The first record that has the name of each
   subroutine find_first(records, first)
      type(record_type), intent(in) :: records(:)
      !> Number of the first record of the same name
      integer, intent(out) :: first(:)

      type(name_index_type) :: names
      integer :: row

      do row = 1, size(records)
         call names%note(records(row)%name, row, first(row))
         if (first(row) == 0) first(row) = row
      end do
   end subroutine find_first

end module dondolo_records_catalogue
