!> A catalogue of records: a CSV table with the columns file, dt_s, units, channel, format and name, and any others.
!>
!> Each record has a name of its own. Where the catalogue gives none and stems of files are the same, the names get the
!> extensions of the files; where these are the same too, the folders, as the catalogue writes them.
module dondolo_catalogue
   use dondolo_channel, only : stem
   use dondolo_csv, only : csv_table_type, read_csv
   use dondolo_error, only : add_place, error_type, raise_input
   use dondolo_kinds, only : wp
   use dondolo_record, only : record_type
   use dondolo_record_reader, only : read_record
   implicit none
   private

   public :: read_catalogue

contains

   !> Read all records of a catalogue
   subroutine read_catalogue(file, records, error)
      !> Path of the catalogue; files in it are relative to its folder
      character(len=*), intent(in) :: file
      !> The records
      type(record_type), allocatable, intent(out) :: records(:)
      !> The catalogue or one of its records is wrong
      type(error_type), allocatable, intent(out) :: error

      type(csv_table_type) :: table
      integer :: row

      call read_csv(file, table, error)
      if (allocated(error)) return
      if (table%column('file') == 0) then
         call raise_input(error, file//': no column ''file'': must have file, and dt_s and units '// &
            & 'where the files do not state them')
         return
      end if
      if (table%rows() == 0) then
         call raise_input(error, file//': no records')
         return
      end if
      allocate (records(table%rows()))
      do row = 1, table%rows()
         call read_row(table, row, records(row), error)
         if (.not. allocated(error)) cycle
         deallocate (records)
         return
      end do
      call name_records(table, records, error)
      if (allocated(error)) deallocate (records)
   end subroutine read_catalogue

   !> Give every record a name of its own
   subroutine name_records(table, records, error)
      !> The catalogue
      type(csv_table_type), intent(in) :: table
      !> The records, named by the stems of their files
      type(record_type), intent(inout) :: records(:)
      !> Two records are the same, or have the same name given
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: path, file
      logical :: is_given(size(records)), again(size(records))
      integer :: length(size(records)), row, k, level

      do row = 1, size(records)
         path = trim(adjustl(table%get_text(row, table%column('name'))))
         is_given(row) = len(path) > 0
         if (is_given(row)) records(row)%name = path
         ! What follows is the channel
         length(row) = len(stem(table%get_text(row, table%column('file'))))
      end do
      do level = 1, 2
         again = [(stands_twice(row), row=1, size(records))]
         do row = 1, size(records)
            if (is_given(row) .or. .not. again(row)) cycle
            path = trim(table%get_text(row, table%column('file')))
            file = path(scan(path, '/\', back=.true.) + 1:)
            if (level == 2) file = path
            records(row)%name = file//records(row)%name(length(row) + 1:)
            length(row) = len(file)
         end do
      end do
      do row = 1, size(records)
         do k = 1, row - 1
            if (records(k)%name /= records(row)%name) cycle
            call raise_input(error, table%place(row)//': record '''//records(row)%name//''' stands there twice')
            return
         end do
      end do

   contains

      !> Has another record the name of this one?
      pure function stands_twice(i)
         !> Number of the record
         integer, intent(in) :: i
         !> Another has its name
         logical :: stands_twice

         integer :: j

         stands_twice = .true.
         do j = 1, size(records)
            if (j /= i .and. records(j)%name == records(i)%name) return
         end do
         stands_twice = .false.
      end function stands_twice

   end subroutine name_records

   !> Read the record of one row
   subroutine read_row(table, row, record, error)
      !> The catalogue
      type(csv_table_type), intent(in) :: table
      !> Number of the row
      integer, intent(in) :: row
      !> The record
      type(record_type), intent(out) :: record
      !> What is wrong
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: path, units
      real(wp), allocatable :: dt

      path = table%get_text(row, table%column('file'))
      if (len_trim(path) == 0) then
         call raise_input(error, table%place(row)//': file is empty: must name a file')
         return
      end if
      if (.not. is_absolute(path)) path = table%file(:scan(table%file, '/\', back=.true.))//path
      units = table%get_text(row, table%column('units'))
      if (len_trim(table%get_text(row, table%column('dt_s'))) > 0) then
         allocate (dt)
         call table%get_real(row, table%column('dt_s'), dt, error)
         if (allocated(error)) return
      end if
      ! A dt that is not allocated is an argument that is not present
      call read_record(path, record, error, dt, units, table%get_text(row, table%column('channel')), &
         & table%get_text(row, table%column('format')))
      call add_place(error, table%place(row))
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
