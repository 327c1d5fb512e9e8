!> What stands above columns of numbers: comments, which are metadata and may state units and time step, and titles.
module dondolo_column_top
   use dondolo_column_cells, only : find_cells, most_cells, separator_of, unquoted
   use dondolo_column_titles, only : find_units, is_other_quantity, is_seconds
   use dondolo_error, only : error_type
   use dondolo_kinds, only : wp
   use dondolo_numbers, only : parse_real
   use dondolo_plain, only : shown
   use dondolo_record_format, only : raise_at, samples_type
   use dondolo_text, only : lower, to_text
   use dondolo_text_file, only : text_file_type
   implicit none
   private

   public :: read_top

   !> Relative difference allowed between the step of the times and one that a comment states
   real(wp), parameter :: step_tolerance = 0.01_wp

contains

   !> Read comments and titles
   subroutine read_top(text, begin, cells, samples, error)
      type(text_file_type), intent(in) :: text
      !> First line of values
      integer, intent(in) :: begin
      !> Number of columns
      integer, intent(in) :: cells
      !> What the file says
      type(samples_type), intent(inout) :: samples
      !> Times that are no seconds, or a time step that is another than that of the times
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: content, units
      integer :: line, mark, i, k, titles, first(most_cells), last(most_cells)

      do line = 1, begin - 1
         content = trim(adjustl(text%line(line)))
         if (index(content, '#') == 1) then
            mark = index(content, ':')
            if (mark > 2) call samples%metadata%set(content(2:mark - 1), content(mark + 1:))
            cycle
         end if
         call find_cells(text, line, separator_of(text, line), first, last, titles)
         ! Titles may hold blanks: between tabs; in a single column; and those of a time and one channel, where the last units
         ! of acceleration in the line are the channel's
         if (titles /= cells) call find_cells(text, line, achar(9), first, last, titles)
         if (cells == 1) then
            titles = 1
            first(1) = text%first(line)
            last(1) = text%last(line)
         else if (cells == 2 .and. titles /= 2 .and. line == begin - 1) then
            content = unquoted(text%line(line))
            call find_units(content, units)
            if (len(units) > 0) samples%channels(1)%units = units
            if (is_other_quantity(content, units)) samples%channels(1)%refusal = text%place(line)//': channel '''// &
               & shown(content)//''' is no acceleration'
         end if
         if (titles /= cells) cycle
         content = unquoted(text%text(first(1):last(1)))
         call find_units(content, units)
         if (cells > 1 .and. .not. is_seconds(content, units)) then
            call raise_at(error, text, line, 'title '''//shown(content)//''' of the times: they must be in s')
            return
         end if
         do i = 1, size(samples%channels)
            k = min(i + 1, cells)
            content = unquoted(text%text(first(k):last(k)))
            call find_units(content, units)
            if (len(units) > 0) samples%channels(i)%units = units
            if (is_other_quantity(content, units)) samples%channels(i)%refusal = text%place(line)//': channel '''// &
               & shown(content)//''' is no acceleration'
            if (cells > 2 .and. len(content) > 0) samples%channels(i)%name = content
         end do
      end do
      call take_comments(text, begin, samples, error)
   end subroutine read_top

   !> Take units and time step that comments state
   subroutine take_comments(text, begin, samples, error)
      type(text_file_type), intent(in) :: text
      !> First line of values
      integer, intent(in) :: begin
      !> What the file says
      type(samples_type), intent(inout) :: samples
      !> The time step is no positive number, or not that of the times
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: stated
      real(wp) :: dt
      integer :: i
      logical :: ok

      stated = samples%metadata%get('dt')
      if (len(stated) > 0) then
         i = len(stated) - merge(1, 0, lower(stated(len(stated):)) == 's')
         call parse_real(stated(:i), dt, ok)
         if (ok) ok = dt > 0.0_wp
         if (.not. ok) then
            call raise_at(error, text, begin, 'the comment dt = '''//shown(stated)//''': must be a positive number')
            return
         end if
         associate (step => samples%channels(1)%dt)
            if (step > 0.0_wp .and. abs(dt - step) > step_tolerance*step) then
               call raise_at(error, text, begin, 'the step of the times is '//to_text(step)// &
                  & ': a comment states dt = '//to_text(dt))
               return
            end if
            if (.not. step > 0.0_wp) step = dt
         end associate
      end if
      stated = samples%metadata%get('units')
      do i = 1, size(samples%channels)
         if (.not. allocated(samples%channels(i)%units)) samples%channels(i)%units = stated
      end do
   end subroutine take_comments

end module dondolo_column_top
