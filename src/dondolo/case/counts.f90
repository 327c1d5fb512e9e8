!> What is kept of one row of a population: how many histories reach each EDP threshold at each level, and the curves;
!> and how it stands in a file.
module dondolo_counts
   use, intrinsic :: iso_fortran_env, only : int32, int64
   use dondolo_fragility, only : fragility_type, status_names
   use dondolo_kinds, only : wp
   use dondolo_response, only : response_type
   use dondolo_stripe_counts, only : stripe_counts_type
   use dondolo_work, only : work_type
   implicit none
   private

   public :: counts_type, shape_type, pack_counts, unpack_counts

   !> Bytes of a real
   integer, parameter :: bytes_of_real = storage_size(1.0_wp)/8

   !> How many numbers there are of a row
   type :: shape_type
      !> Levels
      integer :: levels = 0
      !> EDP thresholds
      integer :: thresholds = 0
      !> Are all histories kept?
      logical :: keeps_histories = .false.
   end type shape_type

   !> Counts of a row
   type, extends(stripe_counts_type) :: counts_type
      !> Number of the row
      integer :: row = 0
      !> Is it a further mechanism of the wall in the row before?
      logical :: continues = .false.
      !> Number of its mechanism among mechanism_names
      integer :: mechanism = 0
      !> Number of its group; 0: none
      integer :: group = 0
      !> Weight of the wall
      real(wp) :: weight = 0.0_wp
      !> Probability that the mechanism can occur
      real(wp) :: p_occ = 0.0_wp
      !> All histories (histories, levels), if they are kept
      type(response_type), allocatable :: response(:, :)
   end type counts_type

   !> Integers of a row besides the counts, and reals besides the curves; reals of a curve; counts of work
   integer, parameter :: own_integers = 5, own_reals = 2, curve_reals = 8, work_counts = 8

contains

   !> Rows as bytes: what was computed, the number of integers, all integers, all reals
   function pack_counts(rows, work) result(bytes)
      !> The rows
      type(counts_type), intent(in) :: rows(:)
      !> What was computed for them
      type(work_type), intent(in) :: work
      !> Bytes
      character(len=:), allocatable :: bytes

      integer(int32), allocatable :: integers(:)
      real(wp), allocatable :: reals(:)
      integer(int64) :: counted(work_counts)
      integer(int64) :: at, place, byte
      integer :: i, j, k

      at = 0
      place = 0
      do i = 1, size(rows)
         associate (states => size(rows(i)%curve))
            at = at + own_integers + states + size(rows(i)%reached)
            place = place + own_reals + curve_reals*states
         end associate
         if (.not. allocated(rows(i)%response)) cycle
         at = at + 2*size(rows(i)%response, kind=int64)
         place = place + 2*size(rows(i)%response, kind=int64)
      end do
      allocate (integers(at), reals(place))
      at = 0
      place = 0
      do i = 1, size(rows)
         associate (row => rows(i))
            integers(at + 1:at + own_integers) = [row%row, merge(1, 0, row%continues), row%mechanism, row%group, &
               & row%histories]
            at = at + own_integers
            reals(place + 1:place + own_reals) = [row%weight, row%p_occ]
            place = place + own_reals
            do k = 1, size(row%curve)
               integers(at + k) = findloc(status_names, row%curve(k)%status, dim=1)
               reals(place + 1:place + curve_reals) = numbers_of(row%curve(k))
               place = place + curve_reals
            end do
            at = at + size(row%curve)
            do k = 1, size(row%curve)
               integers(at + 1:at + size(row%reached, 1)) = row%reached(:, k)
               at = at + size(row%reached, 1)
            end do
            if (.not. allocated(row%response)) cycle
            do j = 1, size(row%response, 2)
               do k = 1, row%histories
                  integers(at + 1:at + 2) = [merge(1, 0, row%response(k, j)%collapsed), row%response(k, j)%impacts]
                  reals(place + 1:place + 2) = [row%response(k, j)%edp, row%response(k, j)%time_of_peak]
                  at = at + 2
                  place = place + 2
               end do
            end do
         end associate
      end do
      counted = [work%histories, work%still, work%in_lanes, work%intervals, work%rocked, work%steps, work%evaluations, &
         & work%impacts]
      allocate (character(len=8*work_counts + 4 + 4*size(integers, kind=int64) &
         & + bytes_of_real*size(reals, kind=int64)) :: bytes)
      bytes(:8*work_counts) = transfer(counted, bytes(:8*work_counts))
      byte = 8*work_counts
      bytes(byte + 1:byte + 4) = transfer(size(integers, kind=int32), bytes(byte + 1:byte + 4))
      byte = byte + 4
      at = 4*size(integers, kind=int64)
      bytes(byte + 1:byte + at) = transfer(integers, bytes(byte + 1:byte + at))
      byte = byte + at
      bytes(byte + 1:) = transfer(reals, bytes(byte + 1:))
   end function pack_counts

   !> Rows out of bytes; sizes are checked before anything is read
   subroutine unpack_counts(bytes, count, shape, rows, work, ok)
      !> Bytes
      character(len=*), intent(in) :: bytes
      !> Number of rows
      integer, intent(in) :: count
      !> How many numbers there are of a row
      type(shape_type), intent(in) :: shape
      !> The rows
      type(counts_type), allocatable, intent(out) :: rows(:)
      !> What was computed for them
      type(work_type), intent(out) :: work
      !> There are as many numbers as rows of this shape have
      logical, intent(out) :: ok

      integer(int32), allocatable :: integers(:)
      real(wp), allocatable :: reals(:)
      integer(int64) :: counted(work_counts)
      integer(int64) :: at, place, of_row
      integer :: i, j, k, number

      ok = len(bytes, int64) >= 8*work_counts + 4
      if (.not. ok) return
      counted = transfer(bytes(:8*work_counts), counted)
      work = work_type(histories=counted(1), still=counted(2), in_lanes=counted(3), intervals=counted(4), &
         & rocked=counted(5), steps=counted(6), evaluations=counted(7), impacts=counted(8))
      at = 8*work_counts
      number = transfer(bytes(at + 1:at + 4), number)
      at = at + 4
      place = at + 4*int(number, int64)
      ! Counts alone: with histories, each row says how many it has.
      of_row = own_integers + shape%thresholds*(1 + int(shape%levels, int64))
      ok = number >= count*of_row .and. place <= len(bytes, int64)
      if (.not. ok) return
      integers = transfer(bytes(at + 1:place), [0_int32])
      ok = all_there()
      if (.not. ok) return
      reals = transfer(bytes(place + 1:), [0.0_wp])
      allocate (rows(count))
      at = 0
      place = 0
      do i = 1, count
         associate (row => rows(i), m => shape%levels)
            row%row = integers(at + 1)
            row%continues = integers(at + 2) == 1
            row%mechanism = integers(at + 3)
            row%group = integers(at + 4)
            row%histories = integers(at + 5)
            row%weight = reals(place + 1)
            row%p_occ = reals(place + 2)
            at = at + own_integers
            place = place + own_reals
            allocate (row%curve(shape%thresholds))
            do k = 1, shape%thresholds
               call set_curve(row%curve(k), integers(at + k), reals(place + 1:place + curve_reals))
               place = place + curve_reals
            end do
            at = at + shape%thresholds
            row%reached = reshape(integers(at + 1:at + m*shape%thresholds), [m, shape%thresholds])
            at = at + m*shape%thresholds
            if (.not. shape%keeps_histories) cycle
            allocate (row%response(row%histories, m))
            do j = 1, m
               do k = 1, row%histories
                  row%response(k, j)%collapsed = integers(at + 1) == 1
                  row%response(k, j)%impacts = integers(at + 2)
                  row%response(k, j)%edp = reals(place + 1)
                  row%response(k, j)%time_of_peak = reals(place + 2)
                  at = at + 2
                  place = place + 2
               end do
            end do
         end associate
      end do

   contains

      !> Are there exactly the numbers of all rows?
      pure logical function all_there()

         integer(int64) :: at, histories
         integer :: i

         at = 0
         histories = 0
         do i = 1, count
            all_there = at + of_row <= size(integers, kind=int64)
            if (all_there) all_there = integers(at + own_integers) >= 0
            if (.not. all_there) return
            if (shape%keeps_histories) histories = histories + int(integers(at + own_integers), int64)*shape%levels
            at = i*of_row + 2*histories
         end do
         all_there = at == size(integers, kind=int64) .and. len(bytes, int64) == place + bytes_of_real* &
            & (count*int(own_reals + curve_reals*shape%thresholds, int64) + 2*histories)
      end function all_there

   end subroutine unpack_counts

   !> Numbers of a curve
   pure function numbers_of(curve) result(numbers)
      !> Curve
      type(fragility_type), intent(in) :: curve
      !> Numbers
      real(wp) :: numbers(curve_reals)

      numbers = [curve%theta, curve%beta, curve%covariance(1, 1), curve%covariance(1, 2), curve%covariance(2, 2), &
         & curve%log_likelihood, curve%bracket]
   end function numbers_of

   !> Set a curve
   pure subroutine set_curve(curve, code, numbers)
      !> Curve
      type(fragility_type), intent(inout) :: curve
      !> Place of its status among the names
      integer, intent(in) :: code
      !> Its numbers
      real(wp), intent(in) :: numbers(curve_reals)

      curve%status = status_names(code)
      curve%theta = numbers(1)
      curve%beta = numbers(2)
      curve%covariance = reshape([numbers(3), numbers(4), numbers(4), numbers(5)], [2, 2])
      curve%log_likelihood = numbers(6)
      curve%bracket = numbers(7:8)
   end subroutine set_curve

end module dondolo_counts
