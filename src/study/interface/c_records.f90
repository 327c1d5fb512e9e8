!> Records of the C interface: a catalogue, a file or arrays.
module dondolo_interface_c_records
   use, intrinsic :: iso_c_binding, only : c_associated, c_double, c_f_pointer, c_int, c_int64_t, c_null_ptr, c_ptr
   use dondolo_base_error, only : add_place, error_type, out_of_range, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_memory, only : check_room
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : to_text
   use dondolo_interface_c_error, only : failure_type, is_ready
   use dondolo_interface_c_text, only : as_pointer, check_finite, take_numbers, take_text
   use dondolo_interface_handles, only : hold, records_type
   use dondolo_record, only : new_record, record_type
   use dondolo_records_catalogue, only : read_catalogue
   use dondolo_records_clusters, only : gather_suite
   use dondolo_records_record_reader, only : read_record
   implicit none
   private

   !> What each record and each sample takes at most while records are made [bytes]
   real(wp), parameter :: bytes_of_record = 2000.0_wp, bytes_of_sample = 64.0_wp

contains

   !> Read the records of a catalogue, with their vertical components unless the factor on these is 0
   type(c_ptr) function c_read_records(error, path, vertical_factor) result(made) bind(c, name='dondolo_read_records')
      type(c_ptr), intent(in), value :: error, path
      real(c_double), intent(in), value :: vertical_factor

      type(failure_type), pointer :: failure
      type(records_type), pointer :: held
      type(record_type), allocatable :: records(:)
      type(error_type), allocatable :: problem
      character(len=:), allocatable :: file

      made = c_null_ptr
      if (.not. is_ready(error, failure)) return
      call take_text(path, 'path', file, problem)
      if (.not. allocated(problem)) call check_finite([vertical_factor], 'vertical_factor', problem)
      if (.not. allocated(problem)) then
         allocate (held)
         if (abs(vertical_factor) > 0.0_c_double) then
            call read_catalogue(file, records, problem, held%note, held%rows, real(vertical_factor, wp))
         else
            call read_catalogue(file, records, problem, held%note, held%rows)
         end if
         if (allocated(problem)) then
            deallocate (held)
         else
            call keep(held, records, made)
         end if
      end if
      call failure%take(problem)
   end function c_read_records

   !> Read the one accelerogram of a file
   type(c_ptr) function c_read_record(error, path, dt, units) result(made) bind(c, name='dondolo_read_record')
      type(c_ptr), intent(in), value :: error, path
      !> Time step [s]; 0: as the file states it
      real(c_double), intent(in), value :: dt
      !> Units of the values; NULL: as the file states them
      type(c_ptr), intent(in), value :: units

      type(failure_type), pointer :: failure
      type(records_type), pointer :: held
      type(record_type), allocatable :: records(:)
      type(error_type), allocatable :: problem
      character(len=:), allocatable :: file, unit

      made = c_null_ptr
      if (.not. is_ready(error, failure)) return
      allocate (records(1))
      unit = ''
      call take_text(path, 'path', file, problem)
      if (.not. allocated(problem) .and. c_associated(units)) call take_text(units, 'units', unit, problem)
      if (.not. allocated(problem)) call check_finite([dt], 'dt', problem)
      if (.not. allocated(problem)) then
         if (abs(dt) > 0.0_c_double) then
            call read_record(file, records(1), problem, real(dt, wp), unit)
         else
            call read_record(file, records(1), problem, units=unit)
         end if
      end if
      if (.not. allocated(problem)) then
         allocate (held)
         call keep(held, records, made)
      end if
      call failure%take(problem)
   end function c_read_record

   !> Make records of arrays
   type(c_ptr) function c_new_records(error, count, lengths, dt, samples, names) result(made) &
      & bind(c, name='dondolo_new_records')
      type(c_ptr), intent(in), value :: error
      !> How many
      integer(c_int), intent(in), value :: count
      !> Numbers of samples of each
      type(c_ptr), intent(in), value :: lengths
      !> Time step of each [s]
      type(c_ptr), intent(in), value :: dt
      !> All samples, one record after the other [m/s2]
      type(c_ptr), intent(in), value :: samples
      !> Their names; NULL: their numbers
      type(c_ptr), intent(in), value :: names

      type(failure_type), pointer :: failure
      type(records_type), pointer :: held
      type(record_type), allocatable :: records(:)
      type(error_type), allocatable :: problem
      character(len=:), allocatable :: name
      type(c_ptr), pointer :: name_of(:)
      integer(c_int), pointer :: length(:)
      real(c_double), pointer :: step(:), sample(:)
      integer :: i, first

      made = c_null_ptr
      if (.not. is_ready(error, failure)) return
      nullify (sample, name_of)
      call take_numbers(dt, count, 'dt', step, problem)
      if (.not. allocated(problem)) then
         if (c_associated(lengths)) then
            call c_f_pointer(lengths, length, [count])
            call check_lengths(length, problem)
         else
            call raise_input(problem, 'lengths: must be numbers, not NULL', out_of_range, 'lengths')
         end if
      end if
      if (.not. allocated(problem)) call take_numbers(samples, int(sum(length), c_int), 'samples', sample, problem)
      if (.not. allocated(problem)) then
         if (c_associated(names)) call c_f_pointer(names, name_of, [count])
         allocate (records(count))
         first = 0
         do i = 1, size(records)
            name = to_text(i)
            if (associated(name_of)) call take_text(name_of(i), 'names', name, problem)
            if (.not. allocated(problem)) then
               call new_record(records(i), real(sample(first + 1:first + length(i)), wp), real(step(i), wp), name, &
                  & problem)
               call add_place(problem, 'record '''//shown(name)//'''')
            end if
            if (allocated(problem)) exit
            first = first + length(i)
         end do
      end if
      if (.not. allocated(problem)) then
         allocate (held)
         call keep(held, records, made)
      end if
      call failure%take(problem)
   end function c_new_records

   !> Check the lengths of records, and that there is room for them
   subroutine check_lengths(length, error)
      !> Numbers of samples
      integer(c_int), intent(in) :: length(:)
      !> One is negative, or all together are too many
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: whole
      integer :: i

      do i = 1, size(length)
         if (length(i) >= 0) cycle
         call raise_input(error, 'lengths = '//to_text(int(length(i)))//': must not be negative', out_of_range, 'lengths')
         return
      end do
      whole = sum(real(length, wp))
      if (whole > real(huge(length), wp)) call raise_input(error, 'lengths: records of '//to_text(whole)// &
         & ' samples, must have at most '//to_text(huge(length)), out_of_range, 'lengths')
      if (.not. allocated(error)) call check_room(bytes_of_record*size(length) + bytes_of_sample*whole, error)
   end subroutine check_lengths

   !> Keep records
   subroutine keep(held, records, made)
      type(records_type), pointer, intent(in) :: held
      !> They are moved away
      type(record_type), allocatable, intent(inout) :: records(:)
      !> Handle
      type(c_ptr), intent(out) :: made

      class(*), pointer :: content
      integer(c_int64_t) :: handle

      call gather_suite(held%suite, records)
      content => held
      call hold(content, handle)
      made = as_pointer(handle)
   end subroutine keep

end module dondolo_interface_c_records
