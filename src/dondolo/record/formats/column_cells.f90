!> The cells of a line of columns, what separates them, and the line in which values begin.
module dondolo_column_cells
   use dondolo_limits, only : most_columns
   use dondolo_text, only : blanks, lower
   use dondolo_text_file, only : text_file_type
   implicit none
   private

   public :: most_cells, find_cells, first_value_line, separator_of, unquoted

   !> Cells that are found in a line: one that is too many tells that there are
   integer, parameter :: most_cells = most_columns + 1

   !> What may stand around a title
   character(len=*), parameter :: around = blanks//'"'''

contains

   !> A title without blanks and quotes around it
   pure function unquoted(title)
      !> Title
      character(len=*), intent(in) :: title
      !> The same without blanks and quotes around
      character(len=verify(title, around, back=.true.) - max(verify(title, around), 1) + 1) :: unquoted

      unquoted = title(max(verify(title, around), 1):)
   end function unquoted

   !> First line that holds values: after comments and one line of titles
   function first_value_line(text) result(line)
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

   !> What separates the columns of a line
   pure function separator_of(text, line) result(separator)
      type(text_file_type), intent(in) :: text
      !> Number of the line
      integer, intent(in) :: line
      !> A semicolon, a comma, or a blank for blanks and tabs
      character(len=1) :: separator

      separator = ' '
      if (index(text%text(text%first(line):text%last(line)), ',') > 0) separator = ','
      if (index(text%text(text%first(line):text%last(line)), ';') > 0) separator = ';'
   end function separator_of

   !> Find the columns of a line
   pure subroutine find_cells(text, line, separator, first, last, cells)
      type(text_file_type), intent(in) :: text
      !> Number of the line
      integer, intent(in) :: line
      !> What separates them
      character(len=1), intent(in) :: separator
      !> Position of the first character of each cell; an empty line has one that is empty
      integer, intent(out) :: first(most_cells)
      !> Position of the last character of each cell
      integer, intent(out) :: last(most_cells)
      !> Number of cells, `most_cells` if there are more
      integer, intent(out) :: cells

      integer :: at, begin, finish
      logical :: by_blanks

      by_blanks = separator == ' '
      first(1) = 1
      last(1) = 0
      cells = 0
      at = text%first(line)
      do while (cells < most_cells .and. at <= text%last(line))
         if (by_blanks) then
            call text%next_word(at, text%last(line), begin, finish)
            if (begin > text%last(line)) return
         else
            begin = at
            do finish = begin, text%last(line)
               if (text%text(finish:finish) == separator) exit
            end do
            finish = finish - 1
         end if
         cells = cells + 1
         first(cells) = begin
         last(cells) = finish
         at = finish + 2
      end do
   end subroutine find_cells

end module dondolo_column_cells
