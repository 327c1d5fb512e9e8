!> A catalogue of records: a CSV table with the columns file, dt_s, units, channel, format and name, level and factor, and
!> any others, which are metadata of the records; records of one `event` depend on each other (dondolo_clusters).
!>
!> With a column level a row is a record at a level of intensity, and a record may have several rows; where the cell is
!> empty it runs at every level. With a column factor a cell is the factor on the record there, instead of one computed
!> from the intensity measure. A column vertical names the vertical component of a record.
!>
!> Each record has a name of its own. Where the catalogue gives none and stems of files are the same, the names get the
!> extensions of the files; where these are the same too, the folders, as the catalogue writes them.
module dondolo_catalogue
   use dondolo_channel, only : stem
   use dondolo_csv_reader, only : csv_reader_type
   use dondolo_error, only : add_place, error_type, raise_input
   use dondolo_kinds, only : wp
   use dondolo_lines, only : lines_type
   use dondolo_limits, only : most_records
   use dondolo_memory, only : check_room
   use dondolo_name_index, only : name_index_type
   use dondolo_plain, only : name_problem, shown, visible
   use dondolo_record, only : record_type
   use dondolo_record_reader, only : read_record
   use dondolo_text, only : lower, to_text
   implicit none
   private

   public :: read_catalogue, record_rows_type

   !> Memory that a row takes, its samples and metadata left aside [bytes]
   real(wp), parameter :: bytes_of_row = 1000.0_wp

   !> Columns that say how a record is read and run; all others are metadata
   character(len=8), parameter :: own_columns(9) = [character(len=8) :: 'file', 'dt_s', 'units', 'channel', 'format', &
      & 'name', 'vertical', 'level', 'factor']

   !> How many of them say which record a row is of
   integer, parameter :: columns_of_record = 7

   !> Rows of a catalogue
   type :: record_rows_type
      !> Has the catalogue a column level?
      logical :: have_levels = .false.
      !> Record of each row
      integer, allocatable :: record(:)
      !> Level at which it runs, in the unit of the measure; 0: every level
      real(wp), allocatable :: level(:)
      !> Factor on it; 0: computed from the measure
      real(wp), allocatable :: factor(:)
      !> Where each row is, for messages
      type(lines_type) :: place
   end type record_rows_type

contains

   !> Read all records of a catalogue
   subroutine read_catalogue(file, records, error, note, rows, vertical_factor)
      !> Path of the catalogue; files in it are relative to its folder
      character(len=*), intent(in) :: file
      !> The records, each once
      type(record_type), allocatable, intent(out) :: records(:)
      !> The catalogue or one of its records is wrong
      type(error_type), allocatable, intent(out) :: error
      !> How the catalogue was read, where there is something to say of it, else empty
      character(len=:), allocatable, intent(out), optional :: note
      !> Its rows: which records run at which levels
      type(record_rows_type), intent(out), optional :: rows
      !> Factor on the vertical components; absent: they are not read
      real(wp), intent(in), optional :: vertical_factor

      type(csv_reader_type) :: table
      type(lines_type) :: paths, places, names
      type(name_index_type) :: sources
      type(record_rows_type) :: runs
      type(record_type), allocatable :: several(:)
      character(len=:), allocatable :: source
      integer :: number, count, row, earlier
      logical :: found

      call count_rows(file, number, error)
      if (.not. allocated(error)) call check_room(bytes_of_row*real(number, wp), error)
      if (.not. allocated(error)) call table%open(file, error)
      if (.not. allocated(error)) call table%find_decimal_mark([table%column('dt_s'), table%column('level'), &
         & table%column('factor')], error)
      if (allocated(error)) return
      if (present(vertical_factor) .and. table%column('vertical') == 0) then
         call raise_input(error, file//': no column ''vertical'': must name the vertical component of each record')
         return
      end if
      if (present(note)) note = table%note()
      runs%have_levels = table%column('level') > 0
      allocate (several(number), runs%record(number))
      allocate (runs%level(number), runs%factor(number), source=0.0_wp)
      count = 0
      do row = 1, number
         call table%next(found, error)
         if (.not. allocated(error) .and. .not. found) call raise_input(error, file//': has changed while it was read')
         if (.not. allocated(error)) call read_run(table, runs%level(row), runs%factor(row), error)
         if (allocated(error)) exit
         ! Of a record at several levels the first row reads it.
         earlier = 0
         if (runs%have_levels) then
            call describe_source(table, source)
            call sources%note(source, count + 1, earlier)
         end if
         if (earlier == 0) then
            count = count + 1
            earlier = count
            call read_row(table, several(count), error)
            if (.not. allocated(error) .and. present(vertical_factor)) then
               call read_vertical(table, several(count), vertical_factor, error)
            end if
            if (allocated(error)) exit
            call paths%add(table%get_text(table%column('file')))
            call places%add(table%place())
            call names%add(trim(adjustl(table%get_text(table%column('name')))))
         end if
         runs%record(row) = earlier
         call runs%place%add(table%place())
      end do
      call table%close()
      if (allocated(error)) return
      allocate (records(count))
      do row = 1, count
         call move_record(several(row), records(row))
      end do
      call name_records(paths, places, names, records, error)
      if (allocated(error)) then
         deallocate (records)
      else if (present(rows)) then
         rows = runs
      end if
   end subroutine read_catalogue

   !> Move a record to its place among those that a catalogue has once
   subroutine move_record(from, to)
      type(record_type), intent(inout) :: from
      type(record_type), intent(inout) :: to

      call move_alloc(from%name, to%name)
      call move_alloc(from%file, to%file)
      call move_alloc(from%acceleration, to%acceleration)
      if (allocated(from%vertical)) call move_alloc(from%vertical, to%vertical)
      if (allocated(from%vertical_file)) call move_alloc(from%vertical_file, to%vertical_file)
      call move_alloc(from%metadata%entries, to%metadata%entries)
      to%dt = from%dt
   end subroutine move_record

   !> What a row says of the record that it names, by which rows of the same record are recognised
   subroutine describe_source(table, text)
      !> The catalogue, with a row
      type(csv_reader_type), intent(in) :: table
      !> Its cells, with a character in between that none of them holds
      character(len=:), allocatable, intent(out) :: text

      integer :: i

      text = ''
      do i = 1, columns_of_record
         text = text//table%get_text(table%column(trim(own_columns(i))))//achar(0)
      end do
   end subroutine describe_source

   !> Read the level and the factor of a row
   subroutine read_run(table, level, factor, error)
      !> The catalogue, with a row
      type(csv_reader_type), intent(in) :: table
      !> Level; 0: every level
      real(wp), intent(inout) :: level
      !> Factor; 0: computed
      real(wp), intent(inout) :: factor
      !> A level or a factor that is none
      type(error_type), allocatable, intent(out) :: error

      call read_positive(table, 'level', level, error)
      if (.not. allocated(error)) call read_positive(table, 'factor', factor, error)
      if (allocated(error) .or. .not. factor > 0.0_wp .or. level > 0.0_wp) return
      call raise_input(error, table%place()//': factor = '//to_text(factor)//': needs the level at which it applies')
   end subroutine read_run

   !> Read a cell with a positive number
   subroutine read_positive(table, name, value, error)
      !> The catalogue, with a row
      type(csv_reader_type), intent(in) :: table
      !> Name of the column
      character(len=*), intent(in) :: name
      !> The number; stays as it is where the cell is empty
      real(wp), intent(inout) :: value
      !> No number, or not positive
      type(error_type), allocatable, intent(out) :: error

      if (len_trim(table%get_text(table%column(name))) == 0) return
      call table%get_real(table%column(name), value, error)
      if (allocated(error)) return
      if (.not. (value > 0.0_wp .and. value <= huge(value))) call raise_input(error, table%place()//': '//name//' = '// &
         & to_text(value)//': must be positive')
   end subroutine read_positive

   !> Look through a catalogue before its records are read
   subroutine count_rows(file, rows, error)
      !> Path of the catalogue
      character(len=*), intent(in) :: file
      !> Number of its rows
      integer, intent(out) :: rows
      !> It is no table, or not of records
      type(error_type), allocatable, intent(out) :: error

      type(csv_reader_type) :: table
      logical :: found

      rows = 0
      call table%open(file, error)
      if (allocated(error)) return
      if (table%column('file') == 0) then
         call raise_input(error, file//': no column ''file'': must have file, and dt_s and units '// &
            & 'where the files do not state them')
      else if (table%column('dt') > 0 .and. table%column('dt_s') == 0) then
         call raise_input(error, file//': column ''dt'': the time step must stand in the column dt_s, in seconds')
      else
         do
            call table%next(found, error)
            if (allocated(error) .or. .not. found) exit
            rows = rows + 1
            if (rows <= most_records) cycle
            call raise_input(error, file//': more than '//to_text(most_records)//' records')
            exit
         end do
         if (rows == 0 .and. .not. allocated(error)) call raise_input(error, file//': no records')
      end if
      call table%close()
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

   !> Read the record of a row
   subroutine read_row(table, record, error)
      !> The catalogue, with a row
      type(csv_reader_type), intent(in) :: table
      type(record_type), intent(out) :: record
      !> What is wrong
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: path
      integer :: i

      call find_path(table, 'file', path, error)
      if (.not. allocated(error)) call read_component(table, path, table%get_text(table%column('channel')), record, error)
      if (allocated(error)) return
      record%file = path
      do i = 1, size(table%columns)
         associate (title => table%columns(i)%text)
            if (.not. any(own_columns == lower(title))) call record%metadata%set(title, table%get_text(i))
         end associate
      end do
   end subroutine read_row

   !> Read the vertical component of the record of a row: a channel of the same file where the record is one, else a file
   subroutine read_vertical(table, record, factor, error)
      !> The catalogue, with a row
      type(csv_reader_type), intent(in) :: table
      !> The record, which gets it
      type(record_type), intent(inout) :: record
      !> Factor on it
      real(wp), intent(in) :: factor
      !> It is not given, cannot be read, or does not belong to the record
      type(error_type), allocatable, intent(out) :: error

      type(record_type) :: vertical
      character(len=:), allocatable :: path

      if (len_trim(table%get_text(table%column('vertical'))) == 0) then
         call raise_input(error, table%place()//': vertical is empty: must name the vertical component')
      else if (len_trim(table%get_text(table%column('channel'))) > 0) then
         call read_component(table, record%file, table%get_text(table%column('vertical')), vertical, error)
      else
         call find_path(table, 'vertical', path, error)
         if (.not. allocated(error)) call read_component(table, path, '', vertical, error)
         if (.not. allocated(error)) record%vertical_file = path
      end if
      if (allocated(error)) return
      call record%set_vertical(vertical%acceleration, vertical%dt, factor, error)
      call add_place(error, table%place())
   end subroutine read_vertical

   !> Path in a cell of a row, relative to the folder of the catalogue
   subroutine find_path(table, name, path, error)
      !> The catalogue, with a row
      type(csv_reader_type), intent(in) :: table
      !> Name of the column
      character(len=*), intent(in) :: name
      !> Path from the current folder
      character(len=:), allocatable, intent(out) :: path
      !> It is not given, or the folders in it are separated by a backslash
      type(error_type), allocatable, intent(out) :: error

      logical :: exists

      path = table%get_text(table%column(name))
      if (len_trim(path) == 0) then
         call raise_input(error, table%place()//': '//name//' is empty: must name a file')
         return
      end if
      associate (file => table%lines%file)
         if (.not. is_absolute(path)) path = file(:scan(file, '/\', back=.true.))//path
      end associate
      inquire (file=path, exist=exists)
      if (index(path, '\') > 0 .and. .not. exists) call raise_input(error, table%place()//': '//path// &
         & ': no such file: folders must be separated by /, not \')
   end subroutine find_path

   !> Read a component of the motion of a row, with the step, the units and the format that the row gives
   subroutine read_component(table, path, channel, record, error)
      !> The catalogue, with a row
      type(csv_reader_type), intent(in) :: table
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Name or number of the channel; empty: the only one
      character(len=*), intent(in) :: channel
      type(record_type), intent(out) :: record
      !> What is wrong
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: units
      real(wp), allocatable :: dt

      units = table%get_text(table%column('units'))
      if (len_trim(table%get_text(table%column('dt_s'))) > 0) then
         allocate (dt)
         call table%get_real(table%column('dt_s'), dt, error)
      end if
      ! A dt that is not allocated is an argument that is not present
      if (.not. allocated(error)) call read_record(path, record, error, dt, units, channel, &
         & table%get_text(table%column('format')))
      call add_place(error, table%place())
   end subroutine read_component

   !> Does a path begin at the root?
   pure function is_absolute(path)
      !> Path
      character(len=*), intent(in) :: path
      !> It begins with a slash, a backslash or a drive letter
      logical :: is_absolute

      is_absolute = scan(path(1:1), '/\') == 1 .or. index(path, ':') == 2
   end function is_absolute

end module dondolo_catalogue
