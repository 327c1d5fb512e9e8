!> What is kept of a row of a population once its histories have been run - a flag for each history and damage state, what
!> they do to its ties, and where histories are kept all of their results - and how it stands in a store, as bytes.
!>
!> The flags are all that counts, curves and resampled records are made of. As bytes they are bits, eight a byte from the
!> highest on: state by state, level by level, history by history.
module dondolo_population_row_result
   use, intrinsic :: iso_c_binding, only : c_bool
   use, intrinsic :: iso_fortran_env, only : int32, int64
   use dondolo_base_kinds, only : wp
   use dondolo_fragility_tie_tallies, only : tie_tally_type
   use dondolo_motion_response, only : response_type
   use dondolo_motion_work, only : work_type
   implicit none
   private

   public :: row_result_type, shape_type, pack_row, unpack_row, bytes_of_row, bytes_of_flags, pack_flags, unpack_flags

   !> How many numbers there are of a row, besides its histories
   type :: shape_type
      !> Levels
      integer :: levels = 0
      !> Damage states; the last is collapse
      integer :: states = 0
      !> Are all histories kept?
      logical :: keeps_histories = .false.
   end type shape_type

   !> What came of a row
   type :: row_result_type
      !> Number of the row
      integer :: row = 0
      !> Histories of a stripe, and ties
      integer :: histories = 0, ties = 0
      !> What was computed
      type(work_type) :: work
      !> Does a history reach a state (histories, levels, states)? A byte each
      logical(c_bool), allocatable :: flags(:, :, :)
      !> What the histories do to the ties (ties, levels)
      type(tie_tally_type), allocatable :: tallies(:, :)
      !> All histories (histories, levels), if they are kept
      type(response_type), allocatable :: response(:, :)
   contains
      !> Set the flags
      procedure :: set_flags
      !> Histories that reach a state, and those that were run, of each cluster of records
      procedure :: by_cluster
   end type row_result_type

   !> Counts of work, bytes of them, and of the results of a history: edp and time of the peak, impacts
   integer, parameter :: work_counts = 9, work_bytes = 8*work_counts
   integer, parameter :: real_bytes = storage_size(1.0_wp)/8, history_bytes = 2*real_bytes + 4
   !> Bytes of what the histories of a stripe do to a tie
   integer, parameter :: tally_bytes = 2*real_bytes + 2*4

contains

   ! The lengths precede what is as long; otherwise gfortran 12 reports an implicit interface.

   !> Bytes that the flags of a row take
   pure integer(int64) function bytes_of_flags(shape, histories)
      !> How many levels and states there are
      type(shape_type), intent(in) :: shape
      !> Histories of a stripe
      integer, intent(in) :: histories

      bytes_of_flags = (int(shape%levels, int64)*shape%states*histories + 7_int64)/8_int64
   end function bytes_of_flags

   !> Bytes that a row takes
   pure integer(int64) function bytes_of_row(shape, histories, ties)
      !> How many numbers there are of a row
      type(shape_type), intent(in) :: shape
      !> Histories of a stripe, and ties
      integer, intent(in) :: histories, ties

      bytes_of_row = work_bytes + bytes_of_flags(shape, histories) + int(shape%levels, int64)*ties*tally_bytes
      if (shape%keeps_histories) bytes_of_row = bytes_of_row + int(shape%levels, int64)*histories*history_bytes
   end function bytes_of_row

   !> Set the flags: a history is in a state from a threshold of the EDP on
   pure subroutine set_flags(self, response, thresholds)
      !> The row: histories and flags are set
      class(row_result_type), intent(inout) :: self
      !> Its histories (histories, levels)
      type(response_type), intent(in) :: response(:, :)
      !> Thresholds of the states, rotation / capacity
      real(wp), intent(in) :: thresholds(:)

      integer :: k

      self%histories = size(response, 1)
      allocate (self%flags(self%histories, size(response, 2), size(thresholds)))
      do k = 1, size(thresholds)
         self%flags(:, :, k) = response%edp >= thresholds(k)
      end do
   end subroutine set_flags

   !> Flags as bytes
   pure subroutine pack_flags(flags, bytes)
      !> Flags (histories, levels, states)
      logical(c_bool), intent(in) :: flags(:, :, :)
      !> Bytes, as many as bytes_of_flags says
      character(len=*), intent(out) :: bytes

      integer :: i, j, k, byte, bit, value

      byte = 0
      bit = 8
      value = 0
      do k = 1, size(flags, 3)
         do j = 1, size(flags, 2)
            do i = 1, size(flags, 1)
               bit = bit - 1
               if (flags(i, j, k)) value = ibset(value, bit)
               if (bit > 0) cycle
               byte = byte + 1
               bytes(byte:byte) = char(value)
               bit = 8
               value = 0
            end do
         end do
      end do
      if (bit < 8) bytes(byte + 1:byte + 1) = char(value)
   end subroutine pack_flags

   !> Flags out of bytes
   pure subroutine unpack_flags(bytes, flags)
      !> Bytes as pack_flags makes them
      character(len=*), intent(in) :: bytes
      !> Flags (histories, levels, states)
      logical(c_bool), intent(out) :: flags(:, :, :)

      integer :: i, j, k, flag

      flag = 0
      do k = 1, size(flags, 3)
         do j = 1, size(flags, 2)
            do i = 1, size(flags, 1)
               flags(i, j, k) = btest(ichar(bytes(flag/8 + 1:flag/8 + 1)), 7 - modulo(flag, 8))
               flag = flag + 1
            end do
         end do
      end do
   end subroutine unpack_flags

   !> Histories that reach a state, and those that were run, of each cluster of records (levels, clusters)
   pure subroutine by_cluster(self, state, clusters, runs, counts, histories)
      class(row_result_type), intent(in) :: self
      !> Number of the state
      integer, intent(in) :: state
      !> Number of the cluster of each record; a stripe has all records, and again in the other polarity if there are two
      integer, intent(in) :: clusters(:)
      !> Whether a record runs at a level (records, levels)
      logical, intent(in) :: runs(:, :)
      !> Counts
      real(wp), intent(out) :: counts(:, :), histories(:, :)

      integer :: i, j, g, record

      counts = 0.0_wp
      histories = 0.0_wp
      do j = 1, size(counts, 1)
         do i = 1, self%histories
            record = modulo(i - 1, size(clusters)) + 1
            g = clusters(record)
            if (runs(record, j)) histories(j, g) = histories(j, g) + 1.0_wp
            if (self%flags(i, j, state)) counts(j, g) = counts(j, g) + 1.0_wp
         end do
      end do
   end subroutine by_cluster

   !> A row as bytes: what was computed, flags, what happens to the ties, and of the histories that are kept edp, time of the
   !> peak and impacts
   pure subroutine pack_row(row, bytes)
      type(row_result_type), intent(in) :: row
      !> Bytes, as many as bytes_of_row says
      character(len=*), intent(out) :: bytes

      real(wp), allocatable :: numbers(:)
      integer(int64) :: at, number

      bytes(:work_bytes) = transfer([row%work%histories, row%work%still, row%work%in_lanes, row%work%intervals, &
         & row%work%rocked, row%work%steps, row%work%evaluations, row%work%impacts, row%work%drifted], bytes(:work_bytes))
      at = work_bytes
      number = bytes_of_flags(shape_type(size(row%flags, 2), size(row%flags, 3)), row%histories)
      call pack_flags(row%flags, bytes(at + 1:at + number))
      at = at + number
      if (row%ties > 0) then
         number = 4*size(row%tallies, kind=int64)
         bytes(at + 1:at + number) = transfer(int([row%tallies%yielded], int32), bytes(at + 1:at + number))
         at = at + number
         bytes(at + 1:at + number) = transfer(int([row%tallies%broken], int32), bytes(at + 1:at + number))
         at = at + number
         number = real_bytes*size(row%tallies, kind=int64)
         numbers = [row%tallies%mean]
         bytes(at + 1:at + number) = transfer(numbers, bytes(at + 1:at + number))
         at = at + number
         numbers = [row%tallies%largest]
         bytes(at + 1:at + number) = transfer(numbers, bytes(at + 1:at + number))
         at = at + number
      end if
      if (.not. allocated(row%response)) return
      number = real_bytes*size(row%response, kind=int64)
      ! gfortran 12 transfers components of an array of a derived type as if they stood one after the other.
      numbers = [row%response%edp]
      bytes(at + 1:at + number) = transfer(numbers, bytes(at + 1:at + number))
      at = at + number
      numbers = [row%response%time_of_peak]
      bytes(at + 1:at + number) = transfer(numbers, bytes(at + 1:at + number))
      at = at + number
      number = 4*size(row%response, kind=int64)
      bytes(at + 1:at + number) = transfer(int(row%response%impacts, int32), bytes(at + 1:at + number))
   end subroutine pack_row

   !> A row out of bytes
   subroutine unpack_row(bytes, shape, row)
      !> Bytes, as many as bytes_of_row says
      character(len=*), intent(in) :: bytes
      !> How many numbers there are of a row
      type(shape_type), intent(in) :: shape
      !> The row: its number, its histories and its ties are given, all else is set
      type(row_result_type), intent(inout) :: row

      integer(int64) :: counts(work_counts), at, number

      counts = transfer(bytes(:work_bytes), counts)
      row%work = work_type(histories=counts(1), still=counts(2), in_lanes=counts(3), intervals=counts(4), &
         & rocked=counts(5), steps=counts(6), evaluations=counts(7), impacts=counts(8), drifted=counts(9))
      at = work_bytes
      if (allocated(row%flags)) deallocate (row%flags)
      if (allocated(row%tallies)) deallocate (row%tallies)
      allocate (row%flags(row%histories, shape%levels, shape%states), row%tallies(row%ties, shape%levels))
      number = bytes_of_flags(shape, row%histories)
      call unpack_flags(bytes(at + 1:at + number), row%flags)
      at = at + number
      if (row%ties > 0) then
         number = 4*size(row%tallies, kind=int64)
         row%tallies%yielded = reshape(int(transfer(bytes(at + 1:at + number), [0_int32])), [row%ties, shape%levels])
         at = at + number
         row%tallies%broken = reshape(int(transfer(bytes(at + 1:at + number), [0_int32])), [row%ties, shape%levels])
         at = at + number
         number = real_bytes*size(row%tallies, kind=int64)
         row%tallies%mean = reshape(transfer(bytes(at + 1:at + number), [0.0_wp]), [row%ties, shape%levels])
         at = at + number
         row%tallies%largest = reshape(transfer(bytes(at + 1:at + number), [0.0_wp]), [row%ties, shape%levels])
         at = at + number
      end if
      if (.not. shape%keeps_histories) return
      if (allocated(row%response)) deallocate (row%response)
      allocate (row%response(row%histories, shape%levels))
      number = real_bytes*size(row%response, kind=int64)
      row%response%edp = reshape(transfer(bytes(at + 1:at + number), [0.0_wp]), [row%histories, shape%levels])
      at = at + number
      row%response%time_of_peak = reshape(transfer(bytes(at + 1:at + number), [0.0_wp]), [row%histories, shape%levels])
      at = at + number
      number = 4*size(row%response, kind=int64)
      row%response%impacts = reshape(int(transfer(bytes(at + 1:at + number), [0_int32])), [row%histories, shape%levels])
      ! A history has collapsed where it reaches the last state.
      row%response%collapsed = row%flags(:, :, shape%states)
   end subroutine unpack_row

end module dondolo_population_row_result
