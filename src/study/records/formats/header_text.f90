!> Words and numbers out of the header lines of archives: what stands after a label, before a mark, in a format,
!> in a table of numbers.
module dondolo_records_header_text
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_integer, parse_real
   use dondolo_base_text, only : blanks, lower, to_text
   use dondolo_files_text_file, only : text_file_type
   use dondolo_records_format, only : block_type, raise_at
   implicit none
   private

   public :: after, before, squeezed, leading_number, line_after_comments, join_comments, parse_format, table_type, is_mark
   public :: check_not_missing

   !> Digits
   character(len=*), parameter :: digits = '0123456789'

   !> Widest field of a format: more characters than any number needs
   integer, parameter :: widest_field = 99

   !> Most fields of a format in a line
   integer, parameter :: most_columns = 999

   !> Relative difference by which the print of a mark may be off
   real(wp), parameter :: mark_tolerance = 1.0e-6_wp

   !> A header that is a table of numbers in columns of equal width
   type, extends(block_type) :: table_type
      !> Number that stands for one that is not known; unless set, no number does
      real(wp) :: missing = huge(1.0_wp)
   contains
      !> A number as it is printed
      procedure :: field
      !> A number that is an integer
      procedure :: integer_of
      !> Line of a number
      procedure :: line_of
      !> Line after the table
      procedure :: next_line
   end type table_type

contains

   !> Length of the text after a label
   pure integer function after_length(line, label)
      !> Header line, and label
      character(len=*), intent(in) :: line, label

      integer :: at

      after_length = 0
      at = index(lower(line), lower(label))
      if (at > 0) after_length = len_trim(adjustl(line(at + len(label):)))
   end function after_length

   !> The text after a label, whatever its case
   pure function after(line, label) result(rest)
      !> Header line
      character(len=*), intent(in) :: line
      !> Label
      character(len=*), intent(in) :: label
      !> The rest of the line without blanks around it, empty if the label is not there
      character(len=after_length(line, label)) :: rest

      if (len(rest) > 0) rest = adjustl(line(index(lower(line), lower(label)) + len(label):))
   end function after

   !> Length of the text before a mark
   pure integer function before_length(line, mark)
      !> Header line, and mark
      character(len=*), intent(in) :: line, mark

      ! A mark that is missing, at 0, counts as one after the end
      before_length = len_trim(adjustl(line(:modulo(index(lower(line), lower(mark)) - 1, len(line) + 1))))
   end function before_length

   !> The text before a mark, whatever its case
   pure function before(line, mark) result(start)
      !> Header line
      character(len=*), intent(in) :: line
      !> Mark
      character(len=*), intent(in) :: mark
      !> The line up to the mark, without blanks around it; all of it if the mark is not there
      character(len=before_length(line, mark)) :: start

      start = adjustl(line)
   end function before

   !> A text with one blank in place of several, filled up with blanks
   pure function with_single_blanks(text) result(buffer)
      !> Text
      character(len=*), intent(in) :: text
      !> The same without needless blanks
      character(len=len(text)) :: buffer

      integer :: i, length
      logical :: blank

      length = 0
      blank = .true.
      do i = 1, len(text)
         if (index(blanks, text(i:i)) > 0) then
            if (blank) cycle
            blank = .true.
         else
            blank = .false.
         end if
         length = length + 1
         buffer(length:length) = text(i:i)
         if (blank) buffer(length:length) = ' '
      end do
      buffer(length + 1:) = ' '
   end function with_single_blanks

   !> A text with one blank in place of several
   pure function squeezed(text)
      !> Text
      character(len=*), intent(in) :: text
      !> The same without needless blanks
      character(len=len_trim(with_single_blanks(text))) :: squeezed

      squeezed = with_single_blanks(text)
   end function squeezed

   !> Length of the number that a text begins with
   pure integer function number_length(text) result(length)
      !> Text
      character(len=*), intent(in) :: text

      real(wp) :: value
      integer :: first
      logical :: ok

      first = max(verify(text, blanks), 1)
      ! An exponent needs its digits: 35.908E is a longitude
      do length = verify(text(first:)//blanks, digits//'+-.eEdD') - 1, 1, -1
         call parse_real(text(first:first + length - 1), value, ok)
         if (ok) return
      end do
   end function number_length

   !> Number that a text begins with, whatever follows it: 6.5 in '6.5(BRK)', 35.908 in '35.908N'
   pure function leading_number(text) result(number)
      !> Text
      character(len=*), intent(in) :: text
      !> The number as it is printed, empty if the text begins with none
      character(len=number_length(text)) :: number

      number = text(max(verify(text, blanks), 1):)
   end function leading_number

   !> First line after comments, which begin with |
   pure integer function line_after_comments(text, first) result(line)
      type(text_file_type), intent(in) :: text
      !> Line of the first comment
      integer, intent(in) :: first

      line = first
      do while (index(adjustl(text%line(line)), '|') == 1)
         line = line + 1
      end do
   end function line_after_comments

   !> Join comments, which begin with |
   pure subroutine join_comments(text, first, comments)
      type(text_file_type), intent(in) :: text
      !> Line of the first comment
      integer, intent(in) :: first
      !> Their text
      character(len=:), allocatable, intent(out) :: comments

      integer :: line

      comments = ''
      do line = first, line_after_comments(text, first) - 1
         comments = comments//' '//after(text%line(line), '|')
      end do
   end subroutine join_comments

   !> Read a Fortran format of equal fields: (8F10.5), (1E15.6), (10I8), (1P8E10.3)
   !>
   !> Width and columns are all that is used: every number says itself where its point is.
   pure subroutine parse_format(text, width, per_line, ok)
      !> Format, with its brackets and perhaps text after them
      character(len=*), intent(in) :: text
      !> Characters in a field
      integer, intent(out) :: width
      !> Fields in a line
      integer, intent(out) :: per_line
      !> It is such a format
      logical, intent(out) :: ok

      character(len=:), allocatable :: format
      integer :: at

      per_line = 1
      width = 1
      ok = .false.
      format = lower(adjustl(text))
      if (index(format, '(') /= 1 .or. index(format, ')') == 0) return
      format = trim(adjustl(format(2:index(format, ')') - 1)))
      ! A scale factor before the fields
      at = max(verify(format, digits), 1)
      if (index(format(at:), 'p') == 1) format = format(at + 1:)
      format = format(max(verify(format, ' ,'), 1):)
      at = scan(format, 'fegdi')
      if (at == 0) return
      if (at > 1) then
         call parse_integer(format(:at - 1), per_line, ok)
         if (.not. ok) return
      end if
      ! ES and EN are E for a reader
      if (format(at:at) == 'e' .and. scan(format(at + 1:), 'sn') == 1) at = at + 1
      format = format(at + 1:)
      call parse_integer(format(:verify(format//'.', digits) - 1), width, ok)
      ok = ok .and. per_line > 0 .and. per_line <= most_columns .and. width > 0 .and. width <= widest_field
   end subroutine parse_format

   !> Does a number stand for one that is missing?
   elemental function is_mark(value, missing)
      !> Number
      real(wp), intent(in) :: value
      !> The mark
      real(wp), intent(in) :: missing
      !> They are equal but for the print
      logical :: is_mark

      ! Halves: the difference of two huge numbers overflows
      is_mark = abs(0.5_wp*value - 0.5_wp*missing) <= mark_tolerance*abs(0.5_wp*missing)
   end function is_mark

   !> None of the values of a block may be missing
   subroutine check_not_missing(text, first_line, per_line, values, missing, error)
      type(text_file_type), intent(in) :: text
      !> Line of the first value
      integer, intent(in) :: first_line
      !> Values in a line
      integer, intent(in) :: per_line
      !> The values
      real(wp), intent(in) :: values(:)
      !> Number that stands for a missing one
      real(wp), intent(in) :: missing
      !> One is missing
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      do i = 1, size(values)
         if (.not. is_mark(values(i), missing)) cycle
         call raise_at(error, text, first_line + (i - 1)/per_line, 'value '//to_text(i)//' of '// &
            & to_text(size(values))//' is missing: '//to_text(values(i))//' is the mark for no value')
         return
      end do
   end subroutine check_not_missing

   !> A number of a table as it is printed, filled up with blanks
   pure function print_of(self, text, i) result(printed)
      class(table_type), intent(in) :: self
      type(text_file_type), intent(in) :: text
      !> Which number
      integer, intent(in) :: i
      !> Its print, empty if it is not known
      character(len=widest_field) :: printed

      character(len=:), allocatable :: line
      real(wp) :: value
      integer :: first
      logical :: ok

      printed = ''
      if (i > self%count) return
      line = text%line(self%line_of(i))
      first = min(modulo(i - 1, self%per_line)*self%width, len(line)) + 1
      line = line(first:min(first + self%width - 1, len(line)))
      call parse_real(line, value, ok)
      if (ok .and. .not. is_mark(value, self%missing)) printed = adjustl(line)
   end function print_of

   !> A number of a table as it is printed
   pure function field(self, text, i)
      class(table_type), intent(in) :: self
      type(text_file_type), intent(in) :: text
      !> Which number
      integer, intent(in) :: i
      !> Its print, empty if it is not known
      character(len=len_trim(print_of(self, text, i))) :: field

      field = print_of(self, text, i)
   end function field

   !> A number of a table that is an integer
   pure subroutine integer_of(self, text, i, value, ok)
      class(table_type), intent(in) :: self
      type(text_file_type), intent(in) :: text
      !> Which number
      integer, intent(in) :: i
      !> Its value, 0 unless ok
      integer, intent(out) :: value
      !> It is known
      logical, intent(out) :: ok

      call parse_integer(self%field(text, i), value, ok)
   end subroutine integer_of

   !> Line of a number of a table
   elemental function line_of(self, i) result(line)
      class(table_type), intent(in) :: self
      !> Which number
      integer, intent(in) :: i
      !> Number of its line
      integer :: line

      line = self%first_line + (i - 1)/self%per_line
   end function line_of

   !> Line after a table
   elemental function next_line(self) result(line)
      class(table_type), intent(in) :: self
      !> Number of the line
      integer :: line

      line = self%first_line
      if (self%count > 0) line = self%line_of(self%count) + 1
   end function next_line

end module dondolo_records_header_text
