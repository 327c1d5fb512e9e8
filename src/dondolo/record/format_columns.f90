!> Plain columns of numbers: accelerations alone, one a line, or times and accelerations.
!>
!> At the top may stand comment lines that begin with # and one line of titles. Columns are separated by semicolons,
!> commas, or blanks and tabs.
module dondolo_format_columns
   use dondolo_equal_steps, only : check_equal_steps
   use dondolo_error, only : error_type
   use dondolo_kinds, only : wp
   use dondolo_numbers, only : parse_real
   use dondolo_record_format, only : format_type, raise_at, samples_type
   use dondolo_text, only : lower, to_text
   use dondolo_text_file, only : text_file_type
   implicit none
   private

   public :: columns_format_type

   !> The format of plain columns
   type, extends(format_type) :: columns_format_type
   contains
      !> Name of the format: one word in lower case
      procedure, nopass :: name
      !> Is a text in this format?
      procedure, nopass :: recognises
      !> Read a text in this format
      procedure, nopass :: read => read_columns
   end type columns_format_type

   !> Most columns that are told apart
   integer, parameter :: most_cells = 3

   !> Blanks
   character(len=*), parameter :: blanks = ' '//achar(9)

contains

   !> Name of the format: one word in lower case
   pure function name()
      !> Name
      character(len=:), allocatable :: name

      name = 'columns'
   end function name

   !> Is a text in this format?
   function recognises(text) result(recognised)
      !> The file
      type(text_file_type), intent(in) :: text
      !> The first line of values holds one or two, as the second or the third does, and one of them is a number
      logical :: recognised

      integer :: begin, line, first(most_cells), last(most_cells), cells, others
      real(wp) :: value
      logical :: a_number, alike

      recognised = .false.
      begin = first_value_line(text)
      if (begin > text%lines()) return
      call find_cells(text, begin, first, last, cells)
      if (cells > 2) return
      call parse_real(text%text(first(1):last(1)), value, a_number)
      alike = begin == text%lines()
      do line = begin + 1, min(begin + 2, text%lines())
         call find_cells(text, line, first, last, others)
         if (others == cells) alike = .true.
         if (.not. a_number) call parse_real(text%text(first(1):last(1)), value, a_number)
      end do
      recognised = alike .and. a_number
   end function recognises

   !> Read plain columns
   subroutine read_columns(text, samples, error)
      !> The file
      type(text_file_type), intent(in) :: text
      !> What it says
      type(samples_type), intent(out) :: samples
      !> What is wrong, with file and line
      type(error_type), allocatable, intent(out) :: error

      integer :: begin, line, cell, cells, found, i, first(most_cells), last(most_cells)
      real(wp), allocatable :: values(:, :)
      integer, allocatable :: time_first(:), time_last(:)
      logical :: ok

      begin = first_value_line(text)
      if (begin > text%lines()) then
         call raise_at(error, text, 1, 'no line of values')
         return
      end if
      call find_cells(text, begin, first, last, cells)
      allocate (values(text%lines() - begin + 1, cells), time_first(text%lines() - begin + 1))
      allocate (time_last(size(time_first)))
      do line = begin, text%lines()
         i = line - begin + 1
         call find_cells(text, line, first, last, found)
         if (found /= cells) then
            call raise_at(error, text, line, to_text(found)//' values: must be '//to_text(cells)//' as in line '// &
               & to_text(begin))
            return
         end if
         do cell = 1, cells
            call parse_real(text%text(first(cell):last(cell)), values(i, cell), ok)
            if (ok) cycle
            call raise_at(error, text, line, 'value '''//text%text(first(cell):last(cell))//''': must be a number')
            return
         end do
         time_first(i) = first(1)
         time_last(i) = last(1)
      end do
      allocate (samples%channels(1))
      samples%channels(1)%values = values(:, cells)
      if (cells == 2) call check_equal_steps(text, begin, values(:, 1), time_first, time_last, samples%channels(1)%dt, &
         & error)
   end subroutine read_columns

   !> First line that holds values: after comments and one line of titles
   function first_value_line(text) result(line)
      !> The file
      type(text_file_type), intent(in) :: text
      !> Number of the line, beyond the last if there is none
      integer :: line

      logical :: titled

      titled = .false.
      do line = 1, text%lines()
         associate (content => text%text(text%first(line):text%last(line)))
            if (verify(content, blanks) == 0) cycle
            if (index(adjustl(content), '#') == 1) cycle
            if (titled .or. .not. is_title(content)) exit
            titled = .true.
         end associate
      end do
   end function first_value_line

   !> Is a line one of titles, and not a value that cannot be read?
   pure function is_title(line)
      !> The line
      character(len=*), intent(in) :: line
      !> It begins with a letter, a quote or a bracket, and not with NaN or Infinity
      logical :: is_title

      character(len=:), allocatable :: word

      word = lower(line(verify(line, blanks):))
      is_title = scan(word(1:1), 'abcdefghijklmnopqrstuvwxyz"''([%!') == 1 .and. &
         & index(word, 'nan') /= 1 .and. index(word, 'inf') /= 1
   end function is_title

   !> Find the columns of a line
   pure subroutine find_cells(text, line, first, last, cells)
      !> The file
      type(text_file_type), intent(in) :: text
      !> Number of the line
      integer, intent(in) :: line
      !> Position of the first character of each cell
      integer, intent(out) :: first(most_cells)
      !> Position of the last character of each cell
      integer, intent(out) :: last(most_cells)
      !> Number of cells, `most_cells` if there are more
      integer, intent(out) :: cells

      character(len=1) :: separator
      integer :: at, finish, length

      first = 1
      last = 0
      cells = 0
      at = text%first(line)
      finish = text%last(line)
      separator = ' '
      if (index(text%text(at:finish), ',') > 0) separator = ','
      if (index(text%text(at:finish), ';') > 0) separator = ';'
      do while (cells < most_cells .and. at <= finish)
         if (separator == ' ') then
            length = verify(text%text(at:finish), blanks) - 1
            if (length < 0) return
            at = at + length
            length = scan(text%text(at:finish), blanks) - 1
         else
            length = index(text%text(at:finish), separator) - 1
         end if
         if (length < 0) length = finish - at + 1
         cells = cells + 1
         first(cells) = at
         last(cells) = at + length - 1
         at = at + length + 1
      end do
   end subroutine find_cells

end module dondolo_format_columns
