!> What a store holds of a population, on its way to Python.
module dondolo_store_parcel
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_error, only : error_type
   use dondolo_base_memory, only : raise_shortage
   use dondolo_boundary, only : check_room
   use dondolo_fragility_tie_tallies, only : tie_tally_type
   use dondolo_parcel, only : parcel_type
   use dondolo_population_row_result, only : bytes_of_flags, pack_flags, row_result_type
   use dondolo_population_store, only : store_type
   implicit none
   private

   public :: pack_store

contains

   !> What a store has of its rows: histories of a stripe of each row, how many of them have reached each state (levels, states,
   !> rows), and ties of each row, 0 for rows that are not there; then of the rows that are there tie_counts, how many histories
   !> make each tie yield and how many break it (2, ties of all levels of all rows), elongations, mean and largest plastic ones
   !> (the same) [m], and the flags, eight a byte, each row from a byte of its own on, and flag_bytes, their number, a real
   subroutine pack_store(store, parcel, error)
      type(store_type), intent(inout) :: store
      !> Empty
      type(parcel_type), intent(inout) :: parcel
      !> Lack of memory, or the store cannot be read
      type(error_type), allocatable, intent(out) :: error

      type(row_result_type) :: row
      integer(c_int), allocatable :: histories(:), reached(:, :, :), ties(:), counts(:, :)
      real(c_double), allocatable :: elongations(:, :)
      character(len=:), allocatable :: flags, more
      integer(int64) :: at, bytes, number
      integer :: i, stat

      at = 0
      number = 0
      associate (rows => store%identity%last, shape => store%identity%shape)
         call check_room(error, reals=8.0_c_double*rows*(shape%levels*shape%states + 16.0_c_double))
         if (allocated(error)) return
         allocate (histories(rows), reached(shape%levels, shape%states, rows), ties(rows), source=0)
         allocate (character(len=1024) :: flags)
         allocate (counts(2, 1024), elongations(2, 1024))
         do i = 1, rows
            if (.not. store%has(i)) cycle
            call store%read(i, row, error)
            if (allocated(error)) return
            histories(i) = row%histories
            reached(:, :, i) = count(row%flags, dim=1)
            ties(i) = row%ties
            call add_tallies(counts, elongations, number, row%tallies, error)
            if (allocated(error)) return
            ! Room for the bytes that fill up the last integer, too
            bytes = bytes_of_flags(shape, row%histories)
            if (at + bytes + 3 > len(flags, int64)) then
               allocate (character(len=2*(at + bytes + 3)) :: more, stat=stat)
               if (stat /= 0) then
                  call raise_shortage(2.0_c_double*real(at + bytes + 3, c_double), error)
                  return
               end if
               more(:at) = flags(:at)
               call move_alloc(more, flags)
            end if
            call pack_flags(row%flags, flags(at + 1:at + bytes))
            at = at + bytes
         end do
      end associate
      flags(at + 1:at + 3) = repeat(achar(0), 3)
      call parcel%put('histories', histories)
      call parcel%put('reached', reshape(reached, [size(reached, kind=int64)]), shape(reached))
      call parcel%put('ties', ties)
      call parcel%put('tie_counts', reshape(counts(:, :number), [2*number]), [2, int(number)])
      call parcel%put('elongations', reshape(elongations(:, :number), [2*number]), [2, int(number)])
      call parcel%put('flags', transfer(flags(:(at + 3)/4*4), [0_c_int]))
      call parcel%put('flag_bytes', real(at, c_double))
   end subroutine pack_store

   !> Add what the histories of a row do to its ties behind that of others; there is room for as many again
   subroutine add_tallies(counts, elongations, number, more, error)
      integer(c_int), allocatable, intent(inout) :: counts(:, :)
      real(c_double), allocatable, intent(inout) :: elongations(:, :)
      !> How many there are
      integer(int64), intent(inout) :: number
      !> Those of the row (ties, levels)
      type(tie_tally_type), intent(in) :: more(:, :)
      !> Lack of memory
      type(error_type), allocatable, intent(out) :: error

      integer(c_int), allocatable :: wider(:, :)
      real(c_double), allocatable :: longer(:, :)
      integer(int64) :: room
      integer :: i, j, stat

      if (number + size(more) > size(counts, 2, int64)) then
         room = 2*(number + size(more))
         allocate (wider(2, room), stat=stat)
         if (stat == 0) allocate (longer(2, room), stat=stat)
         if (stat /= 0) then
            call raise_shortage(24.0_c_double*real(room, c_double), error)
            return
         end if
         wider(:, :number) = counts(:, :number)
         longer(:, :number) = elongations(:, :number)
         call move_alloc(wider, counts)
         call move_alloc(longer, elongations)
      end if
      do j = 1, size(more, 2)
         do i = 1, size(more, 1)
            number = number + 1
            counts(:, number) = [more(i, j)%yielded, more(i, j)%broken]
            elongations(:, number) = [more(i, j)%mean, more(i, j)%largest]
         end do
      end do
   end subroutine add_tallies

end module dondolo_store_parcel
