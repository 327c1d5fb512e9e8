!> Rows of populations and the store that keeps them.
module stores
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_error, only : error_type, raise_failure
   use dondolo_base_fingerprint, only : fingerprint_type
   use dondolo_base_interrupt, only : check_interrupt
   use dondolo_boundary, only : check_room
   use dondolo_fragility_study, only : study_type
   use dondolo_interface_handles, only : find_store, find_study, find_walls, hold, release
   use dondolo_parcel, only : parcel_type, report, send
   use dondolo_population_identity, only : add_wall, study_identity
   use dondolo_population_row_result, only : row_result_type, shape_type
   use dondolo_population_run_rows, only : run_block => run_rows
   use dondolo_population_store, only : open_file => open_store, store_type
   use dondolo_population_store_format, only : bytes_of_entry, identity_type, pack_entry, unpack_entries
   use dondolo_population_wall_row, only : wall_row_type
   use dondolo_store_parcel, only : pack_store
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: open_store, store_state, claim_store, run_rows, put_block, read_store, close_store

contains

   !> Open the store of walls, the rows of a population, under a study: a file, or memory where the path is empty. thresholds:
   !> EDP of the damage states, the last that of collapse. The handle must be given back by close_store
   subroutine open_store(path, study, walls, thresholds, k, handle, failure)
      character(len=*), intent(in) :: path
      integer(c_int64_t), intent(in) :: study, walls
      integer(c_int), intent(in) :: k
      real(c_double), intent(in) :: thresholds(k)
      integer(c_int64_t), intent(out) :: handle
      integer(c_int64_t), intent(out) :: failure(5)
      type(study_type), pointer :: chosen
      type(wall_type), pointer :: wall(:)
      type(study_type) :: own
      type(identity_type) :: identity
      type(store_type), pointer :: store
      class(*), pointer :: content
      type(fingerprint_type) :: fingerprint
      type(error_type), allocatable :: error
      integer :: i

      handle = 0
      call find_study(study, chosen, error)
      if (.not. allocated(error)) call find_walls(walls, wall, error)
      if (.not. allocated(error)) then
         own = chosen
         own%thresholds = thresholds
         do i = 1, size(wall)
            call add_wall(fingerprint, wall(i))
         end do
         call study_identity(own, fingerprint, size(wall), 1, size(wall), identity)
         allocate (store)
         call open_file(store, path, identity, error)
         if (allocated(error)) then
            deallocate (store)
         else
            content => store
            call hold(content, handle)
         end if
      end if
      call report(error, failure)
   end subroutine open_store

   !> Which of the w rows a store has (1), and the counts of what was computed for them in the order of work_names
   subroutine store_state(handle, w, is_there, work, failure)
      integer(c_int64_t), intent(in) :: handle
      integer(c_int), intent(in) :: w
      integer(c_int), intent(out) :: is_there(w)
      integer(c_int64_t), intent(out) :: work(8)
      integer(c_int64_t), intent(out) :: failure(5)
      type(store_type), pointer :: store
      type(error_type), allocatable :: error
      integer :: i

      is_there = 0
      work = 0
      call find_store(handle, store, error)
      if (.not. allocated(error)) then
         is_there = [(merge(1, 0, store%has(i)), i=1, w)]
         work = store%work%counts()
      end if
      call report(error, failure)
   end subroutine store_state

   !> Make a store this process's to put rows in
   subroutine claim_store(handle, failure)
      integer(c_int64_t), intent(in) :: handle
      integer(c_int64_t), intent(out) :: failure(5)
      type(store_type), pointer :: store
      type(error_type), allocatable :: error

      call find_store(handle, store, error)
      if (.not. allocated(error)) call store%claim(error)
      call report(error, failure)
   end subroutine claim_store

   !> Run w walls, rows of a population the first of which has number first, under a study; thresholds as for open_store.
   !> Integers: a block that put_block takes
   subroutine run_rows(study, walls, w, thresholds, k, first, sent)
      !f2py threadsafe
      integer(c_int64_t), intent(in) :: study, walls
      integer(c_int), intent(in) :: w, k, first
      real(c_double), intent(in) :: thresholds(k)
      integer(c_int64_t), intent(out) :: sent(5)
      type(study_type), pointer :: chosen
      type(wall_type), pointer :: wall(:)
      type(study_type) :: own
      type(wall_row_type), allocatable :: rows(:)
      type(row_result_type), allocatable :: results(:)
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      integer :: i

      call check_room(error, walls=w)
      if (.not. allocated(error)) call find_study(study, chosen, error)
      if (.not. allocated(error)) call find_walls(walls, wall, error)
      if (.not. allocated(error)) then
         own = chosen
         own%thresholds = thresholds
         allocate (rows(w))
         rows%wall = wall(:w)
         call run_block(own, rows, results, error, 0, 0)
      end if
      if (.not. allocated(error)) call check_interrupt(error)
      if (.not. allocated(error)) then
         results%row = [(first + i - 1, i=1, w)]
         call pack_block(results, shape_type(size(own%levels), size(thresholds)), parcel%integers)
      end if
      call send(parcel, error, sent)
   end subroutine run_rows

   !> Put a block of rows into a store that was claimed; rows that are there already stay as they are
   subroutine put_block(handle, block, n, count, failure)
      integer(c_int64_t), intent(in) :: handle
      integer(c_int), intent(in) :: n, count, block(n)
      integer(c_int64_t), intent(out) :: failure(5)
      type(store_type), pointer :: store
      type(row_result_type), allocatable :: rows(:)
      type(error_type), allocatable :: error
      character(len=:), allocatable :: bytes
      logical :: are_whole

      call find_store(handle, store, error)
      if (.not. allocated(error)) then
         allocate (character(len=4*size(block, kind=int64)) :: bytes)
         bytes = transfer(block, bytes)
         call unpack_entries(bytes, store%identity%shape, count, rows, are_whole)
         if (.not. are_whole) call raise_failure(error, 'a block of rows was damaged on its way')
      end if
      if (.not. allocated(error)) call store%put(rows, error)
      call report(error, failure)
   end subroutine put_block

   !> What a store has of its rows, as pack_store says
   subroutine read_store(handle, sent)
      integer(c_int64_t), intent(in) :: handle
      integer(c_int64_t), intent(out) :: sent(5)
      type(store_type), pointer :: store
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      call find_store(handle, store, error)
      if (.not. allocated(error)) call pack_store(store, parcel, error)
      call send(parcel, error, sent)
   end subroutine read_store

   !> End with a store: its rows are brought into order if all are there, and its handle is freed; nothing, if
   !> that was done before
   subroutine close_store(handle)
      integer(c_int64_t), intent(in) :: handle
      type(store_type), pointer :: store
      type(error_type), allocatable :: error

      call find_store(handle, store, error)
      if (allocated(error)) return
      call store%close()
      call release(handle)
   end subroutine close_store

   !> Rows as integers that a store takes, from wherever they were computed
   subroutine pack_block(rows, shape, integers)
      !> The rows
      type(row_result_type), intent(in) :: rows(:)
      !> How many numbers there are of a row
      type(shape_type), intent(in) :: shape
      !> The bytes of the rows, zeros behind them
      integer(c_int), allocatable, intent(out) :: integers(:)

      character(len=:), allocatable :: bytes
      integer(int64) :: at, length
      integer :: i

      length = 0
      do i = 1, size(rows)
         length = length + bytes_of_entry(shape, rows(i)%histories, rows(i)%ties)
      end do
      allocate (character(len=(length + 3)/4*4) :: bytes)
      bytes(length + 1:) = repeat(achar(0), int(len(bytes, int64) - length))
      at = 0
      do i = 1, size(rows)
         length = bytes_of_entry(shape, rows(i)%histories, rows(i)%ties)
         call pack_entry(rows(i), bytes(at + 1:at + length))
         at = at + length
      end do
      integers = transfer(bytes, [0_c_int])
   end subroutine pack_block

end module stores
