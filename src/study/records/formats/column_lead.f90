!> A first line above a single column, or above values along the rows, that is no value: `count`, `step`, or `count step`, which
!> may be two lines.
module dondolo_records_column_lead
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_integer, parse_real
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : stripped, to_text
   use dondolo_files_text_file, only : text_file_type
   use dondolo_records_column_cells, only : find_cells, most_cells, separator_of
   use dondolo_records_column_layout, only : raise_unclear
   use dondolo_records_column_statements, only : statements_type
   use dondolo_records_format, only : given_type, raise_at
   implicit none
   private

   public :: take_lead, check_first

   !> Relative difference of two equal steps
   real(wp), parameter :: equal = 1.0e-9_wp

contains

   !> Take a line of `count`, `step` or `count step`, or two lines of `count` and `step`
   subroutine take_lead(text, line, below, given, statements, lines, note, error)
      type(text_file_type), intent(in) :: text
      !> Number of the line
      integer, intent(in) :: line
      !> How many values follow
      integer, intent(in) :: below
      type(given_type), intent(in) :: given
      type(statements_type), intent(inout) :: statements
      !> How many lines are no values
      integer, intent(out) :: lines
      !> What to report, empty if there is nothing
      character(len=:), allocatable, intent(out) :: note
      !> What it says contradicts other lines
      type(error_type), allocatable, intent(out) :: error

      integer :: first(most_cells), last(most_cells), cells, count
      real(wp) :: step
      logical :: is_count, is_step

      note = ''
      lines = 0
      call find_cells(text, line, separator_of(text, line), first, last, cells)
      if (cells < 1 .or. cells > 2) return
      call parse_integer(text%text(first(1):last(1)), count, is_count)
      if (cells == 2) then
         is_count = is_count .and. count == below .and. below > 1
         call parse_real(text%text(first(cells):last(cells)), step, is_step)
         is_step = is_step .and. step > 0.0_wp
         if (is_count .and. is_step) lines = 1
      else
         call parse_known(text%line(line), step, is_step)
         if (line < text%lines() .and. .not. is_step .and. is_count .and. count == below - 1 .and. below > 2) then
            call parse_known(text%line(line + 1), step, is_step)
            if (is_step) lines = 2
         else if (is_step .and. line < text%lines()) then
            call parse_integer(text%line(line + 1), count, is_count)
            is_count = is_count .and. count == below - 1 .and. below > 2
            lines = merge(2, 1, is_count)
         end if
         if (lines == 0) then
            is_count = is_count .and. count == below .and. below > 1
            if (is_count) lines = 1
         else if (lines == 1) then
            note = 'the first line, '//stripped(text%line(line))//', is the time step and no sample'
         end if
      end if
      if (lines == 0) return
      if (is_count) call statements%take_count(text, line, count, error)
      if (is_step .and. .not. allocated(error)) call statements%take_step(text, line, step, error)

   contains

      !> Is a line the time step that is given or stated?
      subroutine parse_known(content, step, is_step)
         character(len=*), intent(in) :: content
         real(wp), intent(out) :: step
         logical, intent(out) :: is_step

         real(wp) :: known

         known = statements%dt
         if (allocated(given%dt)) known = given%dt
         call parse_real(content, step, is_step)
         is_step = is_step .and. known > 0.0_wp .and. abs(step - known) <= equal*known
      end subroutine parse_known

   end subroutine take_lead

   !> The first of a single column must be a value like those below it, not a count or a step that is not known to be one
   subroutine check_first(text, line, given, error)
      type(text_file_type), intent(in) :: text
      !> Its line; the others stand in the lines after it
      integer, intent(in) :: line
      type(given_type), intent(in) :: given
      !> It is printed unlike the others
      type(error_type), allocatable, intent(out) :: error

      !> Lines that are compared with it, and how many they must be
      integer, parameter :: compared = 64, fewest = 3
      !> Part of a whole number that no sample beside it exceeds
      real(wp), parameter :: small = 0.2_wp
      real(wp) :: value, other, largest
      integer :: i, decimals
      logical :: ok, are_alike

      call parse_real(text%line(line), value, ok)
      if (.not. ok .or. .not. value > 0.0_wp .or. text%lines() - line < fewest) return
      decimals = decimals_of(text%line(line + 1))
      are_alike = .true.
      largest = 0.0_wp
      do i = line + 1, min(text%lines(), line + compared)
         are_alike = are_alike .and. decimals_of(text%line(i)) == decimals
         call parse_real(text%line(i), other, ok)
         if (ok) largest = max(largest, abs(other))
      end do
      if (.not. are_alike .or. decimals < 1 .or. decimals_of(text%line(line)) == decimals) return
      if (decimals_of(text%line(line)) == 0 .and. largest < small*value) then
         call raise_at(error, text, line, shown(stripped(text%line(line)))//' may be the number of the values below it, but '// &
            & to_text(text%lines() - line)//' follow')
      else
         call raise_unclear(error, text, line, ''''//shown(stripped(text%line(line)))//''' is printed unlike the values below '// &
            & 'it: if it is their time step, dt must be the same', given, 1)
      end if
   end subroutine check_first

   !> Digits after the point of a printed number; -1 with an exponent, 0 without a point
   pure integer function decimals_of(number)
      character(len=*), intent(in) :: number

      decimals_of = -1
      if (scan(number, 'eEdD') > 0) return
      decimals_of = 0
      if (index(number, '.') > 0) decimals_of = len_trim(number) - index(number, '.')
   end function decimals_of

end module dondolo_records_column_lead
