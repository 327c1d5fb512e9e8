!> Rows of columns that are no samples: the number of samples above them, names that a program gives, and samples beyond the number
!> that is stated.
module dondolo_record_column_counts
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_integer, parse_real
   use dondolo_base_text, only : to_text
   use dondolo_base_text_file, only : text_file_type
   use dondolo_record_column_cells, only : find_cells, most_cells, separator_of
   use dondolo_record_column_roles, only : table_type
   use dondolo_record_column_top, only : top_type
   use dondolo_record_format, only : describe_extra, most_extra, raise_at
   implicit none
   private

   public :: are_names, check_count, drop_row, has_count_line, take_count_line

   !> Smallest number that can be one of samples
   real(wp), parameter :: smallest_count = 2.0_wp

contains

   !> Is a line one of the number of samples, and perhaps the step, above lines of another number of columns?
   logical function has_count_line(text, line, count, dt) result(has_count)
      type(text_file_type), intent(in) :: text
      !> Number of the line
      integer, intent(in) :: line
      !> Number of samples
      integer, intent(out) :: count
      !> Time step [s], 0 if the line has none
      real(wp), intent(out) :: dt

      integer :: first(most_cells), last(most_cells), cells, others(2), i

      has_count = .false.
      count = 0
      dt = 0.0_wp
      if (line + 2 > text%lines()) return
      do i = 1, 2
         call find_cells(text, line + i, separator_of(text, line + i), first, last, others(i))
      end do
      call find_cells(text, line, separator_of(text, line), first, last, cells)
      if (others(1) /= others(2) .or. cells == others(1) .or. cells > 2) return
      call parse_integer(text%text(first(1):last(1)), count, has_count)
      has_count = has_count .and. count > 1
      if (has_count .and. cells == 2) then
         call parse_real(text%text(first(2):last(2)), dt, has_count)
         has_count = has_count .and. dt > 0.0_wp .and. dt < 1.0_wp
      end if
   end function has_count_line

   !> Drop the first row
   pure subroutine drop_row(table, rows)
      type(table_type), intent(inout) :: table
      !> Number of rows
      integer, intent(inout) :: rows

      table%values = table%values(table%cells + 1:)
      table%begin = table%begin + 1
      rows = rows - 1
   end subroutine drop_row

   !> Is the first row one of names, the whole numbers from 0 on, above decimals?
   pure logical function are_names(text, table)
      type(text_file_type), intent(in) :: text
      type(table_type), intent(in) :: table

      !> Lines that are looked at
      integer, parameter :: some = 64
      integer :: i, k, line

      associate (values => table%values, cells => table%cells, begin => table%begin)
         are_names = size(values) > 2*cells
         if (are_names) are_names = all(abs(values(:cells) - [(real(i, wp), i=0, cells - 1)]) <= 0.0_wp)
         if (are_names) are_names = index(text%text(text%first(begin):text%last(begin)), '.') == 0
         if (.not. are_names) return
         do line = begin + 1, min(begin + some, text%lines())
            k = 0
            do i = text%first(line), text%last(line)
               if (text%text(i:i) == '.') k = k + 1
            end do
            if (k < cells) are_names = .false.
         end do
         ! A time of 0 and a sample of 1 are no names: the times go on
         if (are_names) are_names = any(values(cells + 1::cells) < values(:size(values) - cells:cells)) .or. &
            & .not. values(cells + 1) > 0.0_wp
      end associate
   end function are_names

   !> Take the first line of a single column as the number of the values below it, if it is
   subroutine take_count_line(text, table, rows, top, error)
      type(text_file_type), intent(in) :: text
      !> Values; the number is taken off
      type(table_type), intent(inout) :: table
      !> Number of rows
      integer, intent(inout) :: rows
      type(top_type), intent(inout) :: top
      !> The line is a number of samples, but not that of the values below it
      type(error_type), allocatable, intent(out) :: error

      !> Part of a whole number that no sample beside it exceeds
      real(wp), parameter :: small = 0.2_wp
      logical :: alone
      integer :: line

      if (rows < 3) return
      associate (values => table%values, begin => table%begin)
         if (values(1) < smallest_count .or. values(1) > anint(values(1))) return
         if (scan(text%text(text%first(begin):text%last(begin)), '.eEdD') > 0) return
         if (abs(values(1) - real(rows - 1, wp)) > 0.0_wp) then
            ! A whole number among decimals that is far the largest
            alone = all(abs(values(2:)) < small*values(1))
            do line = begin + 1, text%lines()
               if (alone) alone = index(text%text(text%first(line):text%last(line)), '.') > 0
            end do
            if (alone) call raise_at(error, text, begin, to_text(nint(min(values(1), real(huge(1), wp))))// &
               & ' may be the number of the values below it, but '//to_text(rows - 1)//' follow')
            return
         end if
         call top%statements%take_count(text, begin, rows - 1, error)
      end associate
      call drop_row(table, rows)
   end subroutine take_count_line

   !> The number of rows must be the one that is stated, or one or two more
   subroutine check_count(text, top, rows, note, error)
      type(text_file_type), intent(in) :: text
      type(top_type), intent(in) :: top
      !> Number of rows; those that are ignored are taken off
      integer, intent(inout) :: rows
      !> What to report of them
      character(len=:), allocatable, intent(out) :: note
      !> It is another
      type(error_type), allocatable, intent(out) :: error

      note = ''
      associate (stated => top%statements)
         if (stated%count_line == 0 .or. rows == stated%count) return
         if (rows < stated%count .or. rows > stated%count + most_extra) then
            call raise_at(error, text, stated%count_line, to_text(stated%count)//' samples stated: the file has '// &
               & to_text(rows))
            return
         end if
         call describe_extra(rows - stated%count, stated%count, note)
         rows = stated%count
      end associate
   end subroutine check_count

end module dondolo_record_column_counts
