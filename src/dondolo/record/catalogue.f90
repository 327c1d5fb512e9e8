!> A catalogue of records: a CSV table with the columns file, dt_s, units, channel, format, name and event, and any others.
!>
!> Each record has a name of its own. Where the catalogue gives none and stems of files are the same, the names get the
!> extensions of the files; where these are the same too, the folders, as the catalogue writes them.
module dondolo_catalogue
   use dondolo_channel, only : stem
   use dondolo_csv_reader, only : csv_reader_type
   use dondolo_error, only : add_place, error_type, raise_input
   use dondolo_kinds, only : wp
   use dondolo_lines, only : lines_type
   use dondolo_limits, only : longest_name, most_records
   use dondolo_memory, only : check_room
   use dondolo_name_index, only : name_index_type
   use dondolo_plain, only : is_plain, must_be_plain, shown, visible
   use dondolo_record, only : record_type
   use dondolo_record_reader, only : read_record
   use dondolo_text, only : to_text
   implicit none
   private

   public :: read_catalogue

   !> Memory that a row takes, its samples and metadata left aside [bytes]
   real(wp), parameter :: bytes_of_row = 1000.0_wp

contains

   !> Read all records of a catalogue
   subroutine read_catalogue(file, records, error, note)
      !> Path of the catalogue; files in it are relative to its folder
      character(len=*), intent(in) :: file
      !> The records
      type(record_type), allocatable, intent(out) :: records(:)
      !> The catalogue or one of its records is wrong
      type(error_type), allocatable, intent(out) :: error
      !> How the catalogue was read, where there is something to say of it, else empty
      character(len=:), allocatable, intent(out), optional :: note

      type(csv_reader_type) :: table
      type(lines_type) :: paths, places, names
      integer :: rows, row
      logical :: found

      call count_rows(file, rows, error)
      if (.not. allocated(error)) call check_room(bytes_of_row*real(rows, wp), error)
      if (.not. allocated(error)) call table%open(file, error)
      if (.not. allocated(error)) call table%find_decimal_mark([table%column('dt_s')], error)
      if (allocated(error)) return
      if (present(note)) note = table%note()
      allocate (records(rows))
      do row = 1, rows
         call table%next(found, error)
         if (.not. allocated(error) .and. .not. found) call raise_input(error, file//': has changed while it was read')
         if (.not. allocated(error)) call read_row(table, records(row), error)
         if (allocated(error)) exit
         call paths%add(table%get_text(table%column('file')))
         call places%add(table%place())
         call names%add(trim(adjustl(table%get_text(table%column('name')))))
      end do
      call table%close()
      if (.not. allocated(error)) call name_records(paths, places, names, records, error)
      if (allocated(error)) deallocate (records)
   end subroutine read_catalogue

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
         if (len(records(row)%name) > longest_name) then
            call raise_input(error, places%line(row)%text//': name = '''//shown(records(row)%name)// &
               & ''': must have at most '//to_text(longest_name)//' bytes')
            return
         else if (.not. is_plain(records(row)%name)) then
            call raise_input(error, places%line(row)%text//': name = '''//records(row)%name//''': '//must_be_plain)
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

      character(len=:), allocatable :: path, units
      real(wp), allocatable :: dt
      logical :: exists

      path = table%get_text(table%column('file'))
      if (len_trim(path) == 0) then
         call raise_input(error, table%place()//': file is empty: must name a file')
         return
      end if
      associate (file => table%lines%file)
         if (.not. is_absolute(path)) path = file(:scan(file, '/\', back=.true.))//path
      end associate
      inquire (file=path, exist=exists)
      if (index(path, '\') > 0 .and. .not. exists) then
         call raise_input(error, table%place()//': '//path//': no such file: folders must be separated by /, not \')
         return
      end if
      units = table%get_text(table%column('units'))
      if (len_trim(table%get_text(table%column('dt_s'))) > 0) then
         allocate (dt)
         call table%get_real(table%column('dt_s'), dt, error)
      end if
      ! A dt that is not allocated is an argument that is not present
      if (.not. allocated(error)) call read_record(path, record, error, dt, units, &
         & table%get_text(table%column('channel')), table%get_text(table%column('format')))
      record%file = path
      call record%metadata%set('event', table%get_text(table%column('event')))
      call add_place(error, table%place())
   end subroutine read_row

   !> Does a path begin at the root?
   pure function is_absolute(path)
      !> Path
      character(len=*), intent(in) :: path
      !> It begins with a slash, a backslash or a drive letter
      logical :: is_absolute

      is_absolute = scan(path(1:1), '/\') == 1 .or. index(path, ':') == 2
   end function is_absolute

end module dondolo_catalogue
