!> Values of plain columns that are numbers but no accelerations: times, marks of missing samples, and points between thousands.
module dondolo_records_column_values
   use dondolo_base_error, only : error_type, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : occurrences, to_text
   use dondolo_files_text_file, only : text_file_type
   use dondolo_records_column_cells, only : find_cells, most_cells
   use dondolo_records_format, only : channel_type, raise_at
   implicit none
   private

   public :: are_times, check_channel, check_thousands, may_have_thousands

   !> A mark differs from the samples on both sides by more than this part of itself
   real(wp), parameter :: isolated = 0.5_wp

   !> How many times as large as all others a value is that stands alone, and one that does so again or is of nines
   real(wp), parameter :: far = 10.0_wp, far_again = 3.0_wp

   !> Fewest samples of which some can stand alone, or all are times
   integer, parameter :: fewest = 32

contains

   !> Refuse samples that are times, and marks of missing values: 999, -9999, 99.99 or the like between others, or one number that
   !> is far larger than all others
   subroutine check_channel(file, channel, error)
      !> Path of the file
      character(len=*), intent(in) :: file
      type(channel_type), intent(in) :: channel
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: largest, second
      integer :: i, next

      associate (a => channel%values, n => size(channel%values))
         if (are_times(a)) call raise_input(error, file//': samples that increase by equal steps, such as times, are no '// &
            & 'accelerations')
         if (allocated(error)) return
         largest = maxval(abs(a))
         second = maxval(abs(a), mask=abs(a) < largest)
         i = 1
         ! A last value that stands alone may be cut off, which is reported
         do while (i <= n)
            next = i + 1
            do while (next <= n)
               if (abs(a(next) - a(i)) > 0.0_wp) exit
               next = next + 1
            end do
            if (is_isolated(i, next) .and. (nines_of(a(i)) > 2 .or. (next <= n .and. &
               & stands_alone(a(i))))) then
               call raise_input(error, file//': sample '//to_text(i)//' = '//to_text(a(i))//' is far from those beside it: '// &
                  & 'if it marks a missing value it must be replaced')
               return
            end if
            i = next
         end do
      end associate

   contains

      !> Are equal samples far from those beside them?
      pure logical function is_isolated(first, after)
         !> The first of them, and the one after the last
         integer, intent(in) :: first, after

         associate (a => channel%values)
            is_isolated = abs(a(first)) > 0.0_wp .and. after - first < size(a)
            if (is_isolated .and. first > 1) is_isolated = abs(a(first - 1) - a(first)) > isolated*abs(a(first))
            if (is_isolated .and. after <= size(a)) is_isolated = abs(a(after) - a(first)) > isolated*abs(a(first))
         end associate
      end function is_isolated

      !> Is a value far larger than all others?
      pure logical function stands_alone(value)
         real(wp), intent(in) :: value

         stands_alone = size(channel%values) >= fewest .and. second > 0.0_wp .and. abs(value) >= largest
         if (stands_alone) stands_alone = largest > far*second .or. (largest > far_again*second .and. (nines_of(value) > 1 &
            & .or. count(abs(channel%values - value) <= 0.0_wp) > 1))
      end function stands_alone

   end subroutine check_channel

   !> Do values increase by equal steps, as times do?
   pure logical function are_times(values)
      real(wp), intent(in) :: values(:)

      !> Part of a step by which they may be off
      real(wp), parameter :: slack = 0.1_wp
      real(wp) :: step

      are_times = size(values) >= fewest
      if (.not. are_times) return
      step = (values(size(values)) - values(1))/real(size(values) - 1, wp)
      are_times = step > 0.0_wp .and. all(abs(values(2:) - values(:size(values) - 1) - step) <= slack*step)
   end function are_times

   !> How many nines a number is printed with that has no other digit, else 0
   pure integer function nines_of(value) result(nines)
      real(wp), intent(in) :: value

      character(len=:), allocatable :: printed

      nines = 0
      if (abs(value) < 9.85_wp) return
      if (abs(value) < 9.85_wp*10.0_wp**floor(log10(abs(value)))) return
      printed = to_text(abs(value))
      if (verify(printed, '9.') == 0) nines = occurrences(printed, '9')
   end function nines_of

   !> May points in a column stand between thousands? Not where a value is smaller than 1
   pure logical function may_have_thousands(values)
      real(wp), intent(in) :: values(:)

      may_have_thousands = .not. any(abs(values) > 0.0_wp .and. abs(values) < 1.0_wp)
   end function may_have_thousands

   !> Refuse points between thousands: 1.014 beside 685, where all numbers with a point have three figures after it
   subroutine check_thousands(text, begin, separator, column, error)
      type(text_file_type), intent(in) :: text
      !> First line of values
      integer, intent(in) :: begin
      !> What separates the columns
      character(len=1), intent(in) :: separator
      !> Number of the column, 0 for all of values along the rows
      integer, intent(in) :: column
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: odd
      integer :: first(most_cells), last(most_cells), line, odd_line, cells, point, k
      logical :: are_whole_beside

      odd_line = 0
      are_whole_beside = .false.
      do line = begin, text%lines()
         call find_cells(text, line, separator, first, last, cells)
         do k = 1, cells
            if (column > 0 .and. k /= column) cycle
            associate (cell => text%text(first(k):last(k)))
               point = index(cell, '.')
               ! 685. and 685.0 are whole, too
               if (point > 0 .and. len_trim(cell) - point /= 3) then
                  if (verify(trim(cell(point + 1:)), '0') == 0) point = 0
               end if
               if (point == 0) then
                  are_whole_beside = are_whole_beside .or. (scan(cell, '123456789') > 0 .and. scan(cell, 'eEdD') == 0)
                  cycle
               end if
               if (len_trim(cell) - point /= 3 .or. scan(cell, 'eEdD') > 0 .or. scan(cell(:point), '123456789') == 0 &
                  & .or. point - scan(cell, '123456789') > 3) return
               if (odd_line == 0) odd = cell
               if (odd_line == 0) odd_line = line
            end associate
         end do
      end do
      if (odd_line > 0 .and. are_whole_beside) call raise_at(error, text, odd_line, 'value '''//shown(trim(adjustl(odd)))// &
         & ''' beside whole numbers: a point between thousands must be left out, decimals must be written in all numbers')
   end subroutine check_thousands

end module dondolo_records_column_values
