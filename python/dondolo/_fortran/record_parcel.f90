!> Records across the boundary: one array of samples with their lengths, time steps and names (one a line).
module dondolo_record_parcel
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use dondolo_boundary, only : check_room, next_line
   use dondolo_error, only : error_type
   use dondolo_parcel, only : parcel_type
   use dondolo_record, only : record_type
   implicit none
   private

   public :: set_records, pack_records

contains

   !> Make records of what Python has checked when it made its own
   subroutine set_records(records, names, lengths, dt, acceleration, error)
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
      !> Lack of memory
      type(error_type), allocatable, intent(out) :: error

      integer :: i, from, at

      call check_room(error, records=size(lengths), samples=real(size(acceleration), c_double))
      if (allocated(error)) return
      allocate (records(size(lengths)))
      from = 0
      at = 1
      do i = 1, size(records)
         call next_line(names, at, records(i)%name)
         records(i)%dt = dt(i)
         records(i)%acceleration = acceleration(from + 1:from + lengths(i))
         from = from + lengths(i)
      end do
   end subroutine set_records

   !> Records in a parcel, after what is in it
   subroutine pack_records(records, parcel, error)
      !> The records
      type(record_type), intent(in) :: records(:)
      !> Integers: lengths, numbers of metadata; reals: time steps, all samples; text: names, then keys and values
      type(parcel_type), intent(inout) :: parcel
      !> Lack of memory to send them
      type(error_type), allocatable, intent(out) :: error

      real(c_double), allocatable :: reals(:)
      integer :: i, k, from, lengths(size(records))

      lengths = [(size(records(i)%acceleration), i=1, size(records))]
      call check_room(error, records=size(records), samples=sum(real(lengths, c_double)))
      if (allocated(error)) return
      call parcel%add(lengths)
      call parcel%add([(records(i)%metadata%count(), i=1, size(records))])
      allocate (reals(size(records) + sum(lengths)))
      from = size(records)
      do i = 1, size(records)
         call parcel%lines%add(records(i)%name)
         reals(i) = records(i)%dt
         reals(from + 1:from + lengths(i)) = records(i)%acceleration
         from = from + lengths(i)
      end do
      call parcel%add(reals)
      do i = 1, size(records)
         do k = 1, records(i)%metadata%count()
            associate (entry => records(i)%metadata%entries(k))
               call parcel%lines%add(entry%key)
               call parcel%lines%add(entry%value)
            end associate
         end do
      end do
   end subroutine pack_records

end module dondolo_record_parcel
