!> Records across the boundary: one array of samples with their lengths, time steps and names (one a line), and one of the
!> samples of those vertical components that there are.
module dondolo_record_parcel
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_error, only : error_type
   use dondolo_base_lines, only : lines_type
   use dondolo_boundary, only : check_room, next_line
   use dondolo_parcel, only : parcel_type
   use dondolo_record, only : record_type
   implicit none
   private

   public :: set_records, set_labels, pack_records

contains

   !> Make records of what Python has checked when it made its own
   subroutine set_records(records, names, lengths, dt, acceleration, have_vertical, vertical, error)
      !> The records
      type(record_type), allocatable, intent(out) :: records(:)
      !> Their names, one a line
      character(len=*), intent(in) :: names
      !> Numbers of samples
      integer(c_int), intent(in) :: lengths(:)
      !> Time steps [s]
      real(c_double), intent(in) :: dt(:)
      !> All samples, one record after the other [m/s2]
      real(c_double), intent(in) :: acceleration(:)
      !> 1 for a record with a vertical component, else 0
      integer(c_int), intent(in) :: have_vertical(:)
      !> All samples of these, one after the other [m/s2]
      real(c_double), intent(in) :: vertical(:)
      !> Lack of memory
      type(error_type), allocatable, intent(out) :: error

      integer(int64) :: at
      integer :: i, from, from_vertical

      call check_room(error, records=size(lengths), samples=real(size(acceleration), c_double) &
         & + real(size(vertical), c_double))
      if (allocated(error)) return
      allocate (records(size(lengths)))
      from = 0
      from_vertical = 0
      at = 1
      do i = 1, size(records)
         call next_line(names, at, records(i)%name)
         records(i)%dt = dt(i)
         records(i)%acceleration = acceleration(from + 1:from + lengths(i))
         from = from + lengths(i)
         if (have_vertical(i) == 0) cycle
         records(i)%vertical = vertical(from_vertical + 1:from_vertical + lengths(i))
         from_vertical = from_vertical + lengths(i)
      end do
   end subroutine set_records

   !> Give records what their clusters, their directions and warnings of them follow from
   subroutine set_labels(records, labels)
      !> The records
      type(record_type), intent(inout) :: records(:)
      !> Event, station, date, format and motion of each, five lines, empty where they are not known, then the key that shows the
      !> direction and its value
      character(len=*), intent(in) :: labels

      character(len=7), parameter :: keys(5) = [character(len=7) :: 'event', 'station', 'date', 'format', 'motion']
      character(len=:), allocatable :: key, label
      integer(int64) :: at
      integer :: i, k

      at = 1
      do i = 1, size(records)
         do k = 1, size(keys)
            call next_line(labels, at, label)
            call records(i)%metadata%set(trim(keys(k)), label)
         end do
         call next_line(labels, at, key)
         call next_line(labels, at, label)
         call records(i)%metadata%set(key, label)
      end do
   end subroutine set_labels

   !> Records in a parcel, after what is in it
   subroutine pack_records(records, parcel, error)
      !> The records; their samples are moved away
      type(record_type), intent(inout) :: records(:)
      !> Of each record records_samples, their number, records_entries, the number of its metadata, records_verticals, samples of
      !> its vertical component, records_dt, records_pga and records_name; records_metadata: keys and values of all; series:
      !> samples of all, then those of vertical components
      type(parcel_type), intent(inout) :: parcel
      !> Lack of memory to send them
      type(error_type), allocatable, intent(out) :: error

      type(lines_type) :: names, metadata
      integer :: i, k, lengths(size(records)), verticals(size(records))

      lengths = [(size(records(i)%acceleration), i=1, size(records))]
      verticals = [(merge(lengths(i), 0, allocated(records(i)%vertical)), i=1, size(records))]
      call check_room(error, records=size(records), samples=sum(real(lengths + verticals, c_double)))
      if (allocated(error)) return
      call parcel%put('records_samples', lengths)
      call parcel%put('records_entries', [(records(i)%metadata%count(), i=1, size(records))])
      call parcel%put('records_verticals', verticals)
      call parcel%put('records_dt', records%dt)
      call parcel%put('records_pga', records%pga())
      call parcel%expect_series(size(records) + count(verticals > 0))
      do i = 1, size(records)
         call names%add(records(i)%name)
         call parcel%move_series(records(i)%acceleration)
      end do
      do i = 1, size(records)
         if (verticals(i) > 0) call parcel%move_series(records(i)%vertical)
      end do
      do i = 1, size(records)
         do k = 1, records(i)%metadata%count()
            associate (entry => records(i)%metadata%entries(k))
               call metadata%add(entry%key)
               call metadata%add(entry%value)
            end associate
         end do
      end do
      call parcel%put('records_name', names)
      call parcel%put('records_metadata', metadata)
   end subroutine pack_records

end module dondolo_record_parcel
