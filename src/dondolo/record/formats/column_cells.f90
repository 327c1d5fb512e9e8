!> The cells of a line of columns, what separates them, and the line in which values begin.
module dondolo_record_column_cells
   use dondolo_base_limits, only : most_columns
   use dondolo_base_text, only : blanks, lower
   use dondolo_base_text_file, only : text_file_type
   implicit none
   private

   public :: most_cells, find_cells, find_titles, first_value_line, mark_length, separator_of, unquoted

   !> Cells that are found in a line: one that is too many tells that there are
   integer, parameter :: most_cells = most_columns + 1

   !> What may stand around a title
   character(len=*), parameter :: around = blanks//'"'''

   !> Marks of comments
   character(len=*), parameter :: marks(*) = [character(len=2) :: '#', '%', '!', '//']

   !> Words that tell a line of words after a number from a line of values
   character(len=*), parameter :: words(*) = [character(len=8) :: 'npts', 'points', 'samples', 'sec', 'seconds', 'hz', &
      & 'sps', 'dt', 'data', 'values', 'punti', 'campioni']

contains

   !> A title without blanks and quotes around it
   pure function unquoted(title)
      !> Title
      character(len=*), intent(in) :: title
      !> The same without blanks and quotes around
      character(len=verify(title, around, back=.true.) - max(verify(title, around), 1) + 1) :: unquoted

      unquoted = title(max(verify(title, around), 1):)
   end function unquoted

   !> Characters of the mark that a comment begins with, and the blanks and quotes before it
   pure integer function mark_length(line) result(length)
      character(len=*), intent(in) :: line
      !> 0 if the line is no comment

      integer :: i, first

      length = 0
      first = verify(line, around)
      if (first == 0) return
      do i = 1, size(marks)
         if (index(line(first:), trim(marks(i))) == 1) length = first - 1 + len_trim(marks(i))
         if (length > 0) exit
      end do
      if (length == 0) return
      ! Several marks in a row are one
      do while (length < len(line))
         if (index('#%!', line(length + 1:length + 1)) == 0) exit
         length = length + 1
      end do
   end function mark_length

   !> First line that holds values: after comments, titles and other lines of words
   function first_value_line(text) result(line)
      type(text_file_type), intent(in) :: text
      !> Number of the line, beyond the last if there is none
      integer :: line

      do line = 1, text%lines()
         if (.not. is_top(text%text(text%first(line):text%last(line)))) exit
      end do
   end function first_value_line

   !> Can a line stand above the values, so that it is no value that cannot be read?
   pure function is_top(line)
      !> The line
      character(len=*), intent(in) :: line
      !> It is empty, a comment, or begins with a letter, a bracket or an empty cell, and not with NaN or Infinity
      logical :: is_top

      character(len=:), allocatable :: content
      integer :: i

      is_top = verify(line, blanks) == 0
      if (is_top) return
      is_top = mark_length(line) > 0
      if (is_top) return
      content = lower(unquoted(line))
      is_top = len(content) == 0
      if (is_top) return
      if (index(content, 'nan') == 1 .or. index(content, 'inf') == 1) return
      ! A number that its column is too narrow for is a value
      if (verify(content, '*0123456789+-.eEdD,; ') == 0 .and. index(content, '*') > 0) return
      if (len(content) > 2 .and. verify(content, '-=+| ') == 0) then
         is_top = .true.
         return
      end if
      if (scan(content(1:1), '0123456789+-.') == 0) then
         ! An empty cell, where the index of a table has no title
         is_top = scan(content(1:1), ',;') == 0 .or. verify(content, ',; ') > 0
         return
      end if
      do i = 1, size(words)
         if (index(content, ' '//trim(words(i))) > 0) is_top = .true.
      end do
   end function is_top

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
   pure subroutine find_cells(text, line, separator, first, last, cells, from)
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
      !> Position to begin at, that of the line if absent
      integer, intent(in), optional :: from

      integer :: at, begin, finish
      logical :: by_blanks

      by_blanks = separator == ' '
      first(1) = 1
      last(1) = 0
      cells = 0
      at = text%first(line)
      if (present(from)) at = from
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

   !> Find the titles in a line, as many as there are columns, or one less where the first column has none
   pure subroutine find_titles(text, line, columns, first, last, titles)
      type(text_file_type), intent(in) :: text
      !> Number of the line
      integer, intent(in) :: line
      !> Number of columns
      integer, intent(in) :: columns
      !> Positions of the first and of the last character of each title
      integer, intent(out) :: first(most_cells), last(most_cells)
      !> Number of titles, 0 if they are not as many as the columns, or one less
      integer, intent(out) :: titles

      character(len=1), parameter :: separators(4) = [';', ',', achar(9), ' ']
      integer :: i, from, k, kept

      from = text%first(line) + mark_length(text%text(text%first(line):text%last(line)))
      titles = 0
      do i = 1, size(separators)
         if (i < size(separators) .and. index(text%text(from:text%last(line)), separators(i)) == 0) cycle
         call find_cells(text, line, separators(i), first, last, titles, from)
         if (separators(i) == ' ') then
            ! Units in brackets belong to the title before them
            kept = 0
            do k = 1, titles
               if (kept > 0 .and. scan(text%text(first(k):first(k)), '([') == 1) then
                  last(kept) = last(k)
               else
                  kept = kept + 1
                  first(kept) = first(k)
                  last(kept) = last(k)
               end if
            end do
            titles = kept
         else if (text%text(text%last(line):text%last(line)) == separators(i) .and. titles < most_cells) then
            ! An empty last cell
            if (titles < columns) then
               titles = titles + 1
               first(titles) = text%last(line) + 1
               last(titles) = text%last(line)
            end if
         end if
         if (titles == columns .or. (titles == columns - 1 .and. titles > 0)) return
      end do
      titles = 0
   end subroutine find_titles

end module dondolo_record_column_cells
