!> The record that a row of a catalogue names: where its files are and what the row says of them.
!>
!> Where a row states the checksum of a file, as `RecordSet.to_catalogue` writes it, a file of other bytes is refused: it was
!> changed since, or belongs to another version of the catalogue.
!>
!> What a row says is taken from the table row by row; the files are read from that alone, several at a time.
module dondolo_records_catalogue_source
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_error, only : add_place, error_type, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : lower, to_text
   use dondolo_files_checksum, only : crc32_length, crc32_of_file
   use dondolo_files_csv_reader, only : csv_row_type, csv_table_type
   use dondolo_files_system, only : file_exists
   use dondolo_record, only : record_type
   use dondolo_record_dead_channel, only : check_vertical_motion
   use dondolo_record_metadata, only : metadata_type
   use dondolo_records_earthquake, only : find_difference, settle_labels
   use dondolo_records_record_reader, only : read_record
   implicit none
   private

   public :: source_type, describe_source, take_source, read_source

   !> Columns that say how a record is read and run; all others are metadata
   character(len=14), parameter :: own_columns(12) = [character(len=14) :: 'file', 'dt_s', 'units', 'channel', 'format', &
      & 'columns', 'name', 'vertical', 'crc32', 'vertical_crc32', 'level', 'factor']

   !> How many of them say which record a row is of
   integer, parameter :: columns_of_record = 10

   !> Where a record is
   type :: source_type
      !> The row: its number, and for messages
      integer :: row = 0
      character(len=:), allocatable :: place
      !> Path of the file as the catalogue writes it, and from the current folder
      character(len=:), allocatable :: written, path
      !> Name given to the record, or empty
      character(len=:), allocatable :: name
      !> Time step [s]; not allocated: the file states it
      real(wp), allocatable :: dt
      !> Units, channel, format and what plain columns are; empty: not given
      character(len=:), allocatable :: units, channel, format, columns
      !> CRC-32 of the files, hexadecimal; empty: not given
      character(len=:), allocatable :: checksum, vertical_checksum
      !> Path of the file of the vertical component; not allocated: it is a channel of the same file, or not read
      character(len=:), allocatable :: vertical_path
      !> Channel of the vertical component; empty: the only one
      character(len=:), allocatable :: vertical_channel
      !> What is wrong with the cell of the vertical component: it matters once the record has been read
      type(error_type), allocatable :: vertical_error
      !> What the other columns say
      type(metadata_type) :: metadata
   end type source_type

contains

   !> What a row says of the record that it names, by which rows of the same record are recognised
   subroutine describe_source(table, row, text)
      !> The catalogue, and a row of it
      type(csv_table_type), intent(in) :: table
      type(csv_row_type), intent(in) :: row
      !> Its cells, with a character in between that none of them holds
      character(len=:), allocatable, intent(out) :: text

      integer :: i

      text = ''
      do i = 1, columns_of_record
         text = text//row%get_text(table%column(trim(own_columns(i))))//achar(0)
      end do
   end subroutine describe_source

   !> Take what a row says of a record
   subroutine take_source(table, row, with_vertical, source, error)
      !> The catalogue, and a row of it
      type(csv_table_type), intent(in) :: table
      type(csv_row_type), intent(in) :: row
      !> Is the vertical component read too?
      logical, intent(in) :: with_vertical
      !> Where the record is
      type(source_type), intent(out) :: source
      !> A cell is wrong
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      source%place = table%place(row)
      source%written = row%get_text(table%column('file'))
      source%name = trim(adjustl(row%get_text(table%column('name'))))
      call find_path(table, row, 'file', source%path, error)
      if (allocated(error)) return
      source%units = row%get_text(table%column('units'))
      source%channel = row%get_text(table%column('channel'))
      source%format = row%get_text(table%column('format'))
      source%columns = row%get_text(table%column('columns'))
      call take_checksum(table, row, 'crc32', source%checksum, error)
      if (.not. allocated(error)) call take_checksum(table, row, 'vertical_crc32', source%vertical_checksum, error)
      if (allocated(error)) return
      if (len_trim(row%get_text(table%column('dt_s'))) > 0) then
         allocate (source%dt)
         call table%get_real(row, table%column('dt_s'), source%dt, error)
         call add_place(error, source%place)
         if (allocated(error)) return
      end if
      do i = 1, size(table%columns)
         associate (title => table%columns(i)%text)
            if (.not. any(own_columns == lower(title))) call source%metadata%set(title, row%get_text(i))
         end associate
      end do
      if (with_vertical) call take_vertical(table, row, source)
   end subroutine take_source

   !> Take the checksum of a file
   subroutine take_checksum(table, row, name, checksum, error)
      !> The catalogue, and a row of it
      type(csv_table_type), intent(in) :: table
      type(csv_row_type), intent(in) :: row
      !> Name of the column
      character(len=*), intent(in) :: name
      !> Hexadecimal figures in lower case; empty: none is given
      character(len=:), allocatable, intent(out) :: checksum
      !> It is none
      type(error_type), allocatable, intent(out) :: error

      checksum = lower(trim(adjustl(row%get_text(table%column(name)))))
      if (len(checksum) == 0) return
      if (len(checksum) == crc32_length .and. verify(checksum, '0123456789abcdef') == 0) return
      call raise_input(error, table%place(row)//': '//name//' = '''//shown(checksum)//''': must be a CRC-32 of '// &
         & to_text(crc32_length)//' hexadecimal figures')
   end subroutine take_checksum

   !> Take where the vertical component is: a channel of the same file where the record is one, else a file
   subroutine take_vertical(table, row, source)
      !> The catalogue, and a row of it
      type(csv_table_type), intent(in) :: table
      type(csv_row_type), intent(in) :: row
      !> Where the record is
      type(source_type), intent(inout) :: source

      source%vertical_channel = ''
      if (len_trim(row%get_text(table%column('vertical'))) == 0) then
         call raise_input(source%vertical_error, source%place//': vertical is empty: must name the vertical component')
      else if (len_trim(source%channel) > 0) then
         source%vertical_channel = row%get_text(table%column('vertical'))
      else
         call find_path(table, row, 'vertical', source%vertical_path, source%vertical_error)
      end if
   end subroutine take_vertical

   !> Read a record
   subroutine read_source(source, record, error, vertical_factor)
      !> Where it is
      type(source_type), intent(in) :: source
      type(record_type), intent(out) :: record
      !> What is wrong
      type(error_type), allocatable, intent(out) :: error
      !> Factor on the vertical component; absent: it is not read
      real(wp), intent(in), optional :: vertical_factor

      type(record_type) :: vertical
      type(metadata_type) :: stated
      character(len=:), allocatable :: key, one, other

      call read_component(source, source%path, source%channel, source%checksum, record, error)
      if (allocated(error)) return
      record%file = source%path
      stated = record%metadata
      call record%metadata%include(source%metadata)
      call settle_labels(record%metadata)
      if (.not. present(vertical_factor)) return
      if (allocated(source%vertical_error)) then
         error = source%vertical_error
         return
      end if
      if (allocated(source%vertical_path)) then
         call read_component(source, source%vertical_path, source%vertical_channel, source%vertical_checksum, vertical, error)
         if (.not. allocated(error)) record%vertical_file = source%vertical_path
      else
         call read_component(source, source%path, source%vertical_channel, source%checksum, vertical, error)
      end if
      if (allocated(error)) return
      call find_difference(stated, vertical%metadata, key, one, other)
      if (len(key) > 0) call raise_input(error, 'vertical: its file has '//key//' = '''//shown(other)// &
         & ''', that of the record '''//shown(one)//''': must be the same')
      if (.not. allocated(error)) call check_vertical_motion(vertical%acceleration, error)
      if (.not. allocated(error)) call record%set_vertical(vertical%acceleration, vertical%dt, vertical_factor, error)
      call add_place(error, source%place)
   end subroutine read_source

   !> Read a component of a motion, with the step, the units, the format and the columns that the row gives
   subroutine read_component(source, path, channel, checksum, record, error)
      !> Where it is
      type(source_type), intent(in) :: source
      !> Path of the file
      character(len=*), intent(in) :: path
      !> Name or number of the channel; empty: the only one
      character(len=*), intent(in) :: channel
      !> Checksum of the file; empty: not given
      character(len=*), intent(in) :: checksum
      type(record_type), intent(out) :: record
      !> What is wrong
      type(error_type), allocatable, intent(out) :: error

      character(len=crc32_length) :: found
      integer(int64) :: bytes
      logical :: ok

      ! A dt that is not allocated is an argument that is not present
      call read_record(path, record, error, source%dt, source%units, channel, source%format, &
         & source%columns)
      if (.not. allocated(error) .and. len(checksum) > 0) then
         call crc32_of_file(path, found, bytes, ok)
         if (.not. ok .or. found /= checksum) call raise_input(error, path//': has the CRC-32 '//found// &
            & ', but the catalogue has '//checksum//': the file was changed, or belongs to another version of the catalogue')
      end if
      call add_place(error, source%place)
   end subroutine read_component

   !> Path in a cell of a row, relative to the folder of the catalogue
   subroutine find_path(table, row, name, path, error)
      !> The catalogue, and a row of it
      type(csv_table_type), intent(in) :: table
      type(csv_row_type), intent(in) :: row
      !> Name of the column
      character(len=*), intent(in) :: name
      !> Path from the current folder
      character(len=:), allocatable, intent(out) :: path
      !> It is not given, or the folders in it are separated by a backslash
      type(error_type), allocatable, intent(out) :: error

      path = row%get_text(table%column(name))
      if (len_trim(path) == 0) then
         call raise_input(error, table%place(row)//': '//name//' is empty: must name a file')
         return
      end if
      associate (file => table%file)
         if (.not. is_absolute(path)) path = file(:scan(file, '/\', back=.true.))//path
      end associate
      if (index(path, '\') > 0 .and. .not. file_exists(path)) call raise_input(error, table%place(row)//': '//path// &
         & ': no such file: folders must be separated by /, not \')
   end subroutine find_path

   !> Does a path begin at the root?
   pure function is_absolute(path)
      !> Path
      character(len=*), intent(in) :: path
      !> It begins with a slash, a backslash or a drive letter
      logical :: is_absolute

      is_absolute = scan(path(1:1), '/\') == 1 .or. index(path, ':') == 2
   end function is_absolute

end module dondolo_records_catalogue_source
