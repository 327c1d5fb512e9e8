!> Cut files: whether the last number of a file is printed shorter than those before it.
!>
!> A file that is cut off inside its last number has as many numbers as it should have, and the last of them is wrong: the
!> rest of 1.25E-05 is 1.25E-0. Its print gives it away: columns end at the same place, and numbers of one print have equal
!> numbers of decimals and of digits in the exponent.
module dondolo_records_last_number
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_printed
   use dondolo_files_text_file, only : text_file_type
   implicit none
   private

   public :: find_cut, cut_in_lines, compared_lines

   !> Lines before the last that are compared with it
   integer, parameter :: compared_lines = 64

   !> How many times as large as all before it a last sample can hardly be
   real(wp), parameter :: far = 10.0_wp

   !> Numbers that show how the others are printed
   integer, parameter :: fewest = 3

   !> Digits fewer than the middle of the others that no dropped zeros explain
   integer, parameter :: many_digits = 3

   !> Print of a number
   type :: print_type
      !> Column of its line in which it begins and ends
      integer :: begin = 0, finish = 0
      !> Blanks before it
      integer :: padding = 0
      !> Digits after the point, -1 without a point
      integer :: decimals = -1
      !> Digits of the exponent, 0 without an exponent
      integer :: exponent = 0
      !> Digits from the first that is not 0
      integer :: digits = 0
      !> Its value, 0 if it is no number
      real(wp) :: value = 0.0_wp
   end type print_type

contains

   !> Find whether the last number of a text file is cut off
   pure subroutine find_cut(text, first_line, last_line, is_cut, begin, width, alike)
      type(text_file_type), intent(in) :: text
      !> First line of numbers, and line of the last number, which ends the line
      integer, intent(in) :: first_line, last_line
      !> It is printed shorter than the others
      logical, intent(out) :: is_cut
      !> Position of its first character
      integer, intent(out) :: begin
      !> Characters of a column, 0 where blanks or marks separate numbers
      integer, intent(in) :: width
      !> Are the numbers of a line printed alike? Otherwise those of a column are
      logical, intent(in) :: alike

      integer :: from, next
      logical :: ends_line

      from = max(first_line, last_line - compared_lines)
      next = text%last(last_line) + 1
      ends_line = next <= len(text%text)
      if (ends_line) ends_line = scan(text%text(next:next), achar(10)//achar(13)) == 1
      call cut_in_lines(text%text, text%first(from:last_line), text%last(from:last_line), width, alike, ends_line, is_cut, &
         & begin)
   end subroutine find_cut

   !> Find whether the last number of some lines is cut off
   pure subroutine cut_in_lines(text, first, last, width, alike, ends_line, is_cut, begin)
      !> Text
      character(len=*), intent(in) :: text
      !> Positions of the first and of the last character of each line; the last line has the number
      integer, intent(in) :: first(:), last(:)
      !> As of `find_cut`
      integer, intent(in) :: width
      logical, intent(in) :: alike
      !> Does a line end follow the number?
      logical, intent(in) :: ends_line
      logical, intent(out) :: is_cut
      integer, intent(out) :: begin

      integer, parameter :: most = 512
      type(print_type) :: number, final, column(compared_lines + 1)
      ! On the heap: threads may have small stacks.
      type(print_type), allocatable :: others(:)
      integer :: at, line, cell, cells, wanted, count, aligned, lines
      logical :: found

      allocate (others(most))
      lines = size(first)
      cells = 0
      count = 0
      aligned = 0
      is_cut = .false.
      begin = last(lines) + 1
      ! The last line comes first: it has the number of the cell that counts
      at = first(lines)
      wanted = 0
      do
         call next_print(text, first(lines), last(lines), width, at, number, found)
         if (.not. found) exit
         if (wanted > 0 .and. alike .and. count < most) then
            count = count + 1
            others(count) = final
         end if
         wanted = wanted + 1
         final = number
      end do
      if (wanted == 0) return
      begin = first(lines) + final%begin - 1
      do line = lines - 1, 1, -1
         at = first(line)
         cell = 0
         do
            call next_print(text, first(line), last(line), width, at, number, found)
            if (.not. found) exit
            cell = cell + 1
            if (cell == wanted .and. aligned < compared_lines) then
               aligned = aligned + 1
               column(aligned) = number
            end if
            if ((alike .or. cell == wanted) .and. count < most) then
               count = count + 1
               others(count) = number
            end if
         end do
      end do
      is_cut = ends_early(final, column(:aligned), width > 0) .or. is_shorter(final, others(:count))
      if (is_cut .or. verify(text(begin:first(lines) + final%finish - 1), '+-0.') == 0) return
      is_cut = is_short(final, others(:count), ends_line)
      if (.not. alike) is_cut = is_cut .or. is_far(final, others(:count))
   end subroutine cut_in_lines

   !> Take the print of the next number of a line
   pure subroutine next_print(text, first, last, width, at, number, found)
      !> Text
      character(len=*), intent(in) :: text
      !> First and last position of the line
      integer, intent(in) :: first, last
      !> Characters of a column, 0 where marks separate numbers
      integer, intent(in) :: width
      !> Position from which to look, then the one after the number
      integer, intent(inout) :: at
      type(print_type), intent(out) :: number
      !> There is one
      logical, intent(out) :: found

      logical :: ok
      integer :: begin, finish, point, mark

      begin = at
      do while (begin <= last)
         if (.not. separates(text(begin:begin))) exit
         begin = begin + 1
      end do
      found = begin <= last
      if (.not. found) return
      finish = begin
      do while (finish < last)
         if (separates(text(finish + 1:finish + 1))) exit
         if (width > 0 .and. modulo(finish - first + 1, max(width, 1)) == 0) exit
         finish = finish + 1
      end do
      number%begin = begin - first + 1
      number%finish = finish - first + 1
      number%padding = begin - at
      at = finish + 1
      call parse_printed(text(begin:finish), number%value, ok)
      mark = scan(text(begin:finish), 'eEdD')
      if (mark > 0) number%exponent = count_figures(text(begin + mark:finish))
      if (mark == 0) mark = finish - begin + 2
      point = index(text(begin:begin + mark - 2), '.', back=.true.)
      if (point > 0) number%decimals = mark - 1 - point
      point = scan(text(begin:begin + mark - 2), '123456789')
      if (point > 0) number%digits = count_figures(text(begin + point - 1:begin + mark - 2))
   end subroutine next_print

   !> Does a character separate numbers? By codes, for INDEX takes longer than all the rest of a number
   pure logical function separates(sign)
      character(len=1), intent(in) :: sign

      select case (iachar(sign))
      case (iachar(' '), iachar(','), iachar(';'), 9)
         separates = .true.
      case default
         separates = .false.
      end select
   end function separates

   !> Number of digits in a text
   pure integer function count_figures(text) result(count)
      character(len=*), intent(in) :: text

      integer :: i

      count = 0
      do i = 1, len(text)
         if (iachar(text(i:i)) >= iachar('0') .and. iachar(text(i:i)) <= iachar('9')) count = count + 1
      end do
   end function count_figures

   !> Does a number end before its column does, whose numbers are aligned to the right?
   pure logical function ends_early(number, others, is_fixed)
      type(print_type), intent(in) :: number
      !> Those above it
      type(print_type), intent(in) :: others(:)
      !> Are columns of equal width?
      logical, intent(in) :: is_fixed

      ends_early = .false.
      if (size(others) < fewest) return
      if (any(others%finish /= others(1)%finish)) return
      ends_early = number%finish < others(1)%finish .and. &
         & (is_fixed .or. any(others%begin /= others(1)%begin) .or. all(others%padding > 1))
   end function ends_early

   !> Has a number fewer decimals, or fewer digits in its exponent, than all the others, which have the same of both?
   pure logical function is_shorter(number, others)
      type(print_type), intent(in) :: number
      type(print_type), intent(in) :: others(:)

      is_shorter = .false.
      if (size(others) < fewest) return
      if (any(others%decimals /= others(1)%decimals) .or. any(others%exponent /= others(1)%exponent)) return
      is_shorter = number%decimals < others(1)%decimals .or. number%exponent < others(1)%exponent
   end function is_shorter

   !> Is a number shorter than others that are printed with as many digits as each needs?
   pure logical function is_short(number, others, ends_line)
      type(print_type), intent(in) :: number
      type(print_type), intent(in) :: others(:)
      !> Does a line end follow it? Programs that write numbers without the zeros at their end may print the last one short
      logical, intent(in) :: ends_line

      integer :: longer

      is_short = .false.
      if (size(others) < fewest) return
      ! No program prints exponents of one digit beside those of two
      if (number%exponent == 1 .and. any(others%exponent > 1)) is_short = all(others%exponent /= 1)
      if (number%exponent == 0) is_short = all(others%exponent > 0)
      if (ends_line .or. is_short) return
      longer = count(others%digits >= number%digits + many_digits)
      is_short = number%digits < minval(others%digits) .or. 2*longer > size(others)
   end function is_short

   !> Is a number far larger than all before it, as no last sample is?
   pure logical function is_far(number, others)
      type(print_type), intent(in) :: number
      type(print_type), intent(in) :: others(:)

      is_far = .false.
      if (size(others) < compared_lines/2) return
      is_far = abs(number%value) > far*maxval(abs(others%value)) .and. maxval(abs(others%value)) > 0.0_wp
   end function is_far

end module dondolo_records_last_number
