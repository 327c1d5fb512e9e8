!> The cells of a line of columns, what separates them, and the line in which values begin.
module dondolo_records_column_cells
   use dondolo_base_limits, only : most_columns
   use dondolo_base_text, only : blanks, lower
   use dondolo_files_text_file, only : text_file_type
   implicit none
   private

   public :: most_cells, find_cells, find_titles, first_value_line, is_values, mark_length, separator_of, unquoted

   !> Cells that are found in a line: one that is too many tells that there are
   integer, parameter :: most_cells = most_columns + 1

   !> What may stand around a title
   character(len=*), parameter :: around = blanks//'"'''

   !> Marks of comments
   character(len=*), parameter :: marks(*) = [character(len=2) :: '#', '%', '!', '//']

   !> What stands between numbers
   character(len=*), parameter :: between = blanks//',;"'''

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

   !> First line of values: of numbers alone, or of what should be some
   pure integer function first_value_line(text, columns) result(line)
      type(text_file_type), intent(in) :: text
      !> How many it must hold; absent: any number
      integer, intent(in), optional :: columns
      !> Its number is beyond the last if there is none

      integer :: first(most_cells), last(most_cells), cells

      do line = 1, text%lines()
         if (.not. is_values(text%text(text%first(line):text%last(line)))) cycle
         if (.not. present(columns)) return
         call find_cells(text, line, separator_of(text, line), first, last, cells)
         if (cells == columns) return
      end do
   end function first_value_line

   !> Does a line hold numbers alone, or what should be some? It is no comment
   pure logical function is_values(line)
      character(len=*), intent(in) :: line

      integer :: at, length

      is_values = .false.
      if (mark_length(line) > 0) return
      at = 1
      do
         length = verify(line(at:), between)
         if (length == 0) return
         at = at - 1 + length
         length = scan(line(at:)//' ', between) - 1
         is_values = begins_as_number(line(at:at + length - 1))
         if (.not. is_values) return
         at = at + length
      end do
   end function is_values

   !> Does a word begin with a digit, perhaps after a sign and a point, or stand for a number that cannot be?
   pure logical function begins_as_number(word) result(begins)
      character(len=*), intent(in) :: word

      integer :: first

      first = verify(word, '+-.')
      begins = first > 0 .and. first < 4
      if (begins) begins = index('0123456789*', word(first:first)) > 0 .or. any(['nan', 'inf'] == lower(word(first:min(len(word), &
         & first + 2))))
   end function begins_as_number

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

   !> Find the titles in a line, as many as there are columns
   pure subroutine find_titles(text, line, columns, first, last, found)
      type(text_file_type), intent(in) :: text
      !> Number of the line
      integer, intent(in) :: line
      !> Number of columns
      integer, intent(in) :: columns
      !> Positions of the first and of the last character of each title
      integer, intent(out) :: first(most_cells), last(most_cells)
      !> There are as many
      logical, intent(out) :: found

      character(len=1), parameter :: separators(4) = [';', ',', achar(9), ' ']
      integer :: i, from, k, kept, titles

      from = text%first(line) + mark_length(text%text(text%first(line):text%last(line)))
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
         end if
         found = titles == columns
         if (found) return
      end do
   end subroutine find_titles

end module dondolo_records_column_cells
