!> The short way to what most files of plain columns hold: accelerations alone, one a line, without titles and comments.
!>
!> Such a text is read in one go. No other format recognises it, for their headers have words; of any other text nothing is
!> taken here, and the readers of the formats say what it is or what is wrong with it. They also read a column whose first number
!> may be that of the samples or the step, one that may have points between thousands, and one that may be cut off.
module dondolo_records_single_column
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : take_column
   use dondolo_files_text_file, only : find_content, text_file_type
   use dondolo_records_column_prints, only : decimals_of, find_odd_print
   use dondolo_records_column_values, only : may_have_thousands
   use dondolo_records_last_number, only : compared_lines, cut_in_lines
   use dondolo_records_format, only : samples_type
   implicit none
   private

   public :: read_single_column

contains

   !> Read a single column of numbers
   subroutine read_single_column(text, samples, is_column, dt)
      !> Text file whose lines need not be known
      type(text_file_type), intent(in) :: text
      !> One channel, as the format `columns` has it, if it is such a column
      type(samples_type), intent(out) :: samples
      !> Is it?
      logical, intent(out) :: is_column
      !> Time step that the caller gives [s]
      real(wp), intent(in), optional :: dt

      real(wp), allocatable :: values(:)
      integer :: begin, finish, count

      is_column = .false.
      call find_content(text%text, begin, finish)
      if (finish < begin) return
      ! Each has two characters at least but the last, which may have no line end
      allocate (values((finish - begin)/2 + 1))
      call take_column(text%text(begin:finish), values, count, is_column)
      if (is_column) is_column = .not. (begins_unlike(text%text(begin:finish)) .or. may_have_thousands(values(:count)) .or. &
         & is_cut(text%text, begin, finish) .or. has_odd_print(text%text(begin:finish), values(:count)))
      if (is_column .and. present(dt)) is_column = abs(values(1) - dt) > 1.0e-9_wp*abs(dt)
      if (.not. is_column) return
      allocate (samples%channels(1))
      samples%channels(1)%values = values(:count)
   end subroutine read_single_column

   !> Does a column begin with a number that has another number of decimals than the one below it?
   pure logical function begins_unlike(text) result(unlike)
      character(len=*), intent(in) :: text

      integer :: first, second, next, last

      ! Where the first two lines end; without a copy of the text, which a line end after it would need
      first = scan(text, achar(10)//achar(13)) - 1
      unlike = first < 0
      if (unlike) return
      next = first + verify(text(first + 1:), achar(10)//achar(13)//' ')
      second = scan(text(next:), achar(10)//achar(13)) - 1
      last = merge(next - 1 + second, len(text), second >= 0)
      unlike = len_trim(text(:first)) - index(text(:first), '.') /= len_trim(text(next:last)) - index(text(next:last), '.')
   end function begins_unlike

   !> Is a number printed unlike the others, so that it may mark a missing value?
   pure logical function has_odd_print(text, values)
      character(len=*), intent(in) :: text
      real(wp), intent(in) :: values(:)

      character(len=*), parameter :: ends = ' '//achar(9)//achar(10)//achar(13)
      integer, allocatable :: prints(:)
      integer :: i, at, length

      allocate (prints(size(values)))
      at = 1
      do i = 1, size(values)
         at = at - 1 + verify(text(at:), ends)
         length = scan(text(at:), ends) - 1
         if (length < 0) length = len(text) - at + 1
         prints(i) = decimals_of(text(at:at + length - 1))
         at = at + length
      end do
      has_odd_print = find_odd_print(prints, values) > 0
   end function has_odd_print

   !> Is the last number of a column printed shorter than those before it?
   pure logical function is_cut(text, begin, finish)
      character(len=*), intent(in) :: text
      !> First and last position of the column
      integer, intent(in) :: begin, finish

      integer :: first(compared_lines + 1), last(compared_lines + 1), i, at, lines
      logical :: ends_line

      ! From the end: the lines that are compared
      lines = 0
      at = finish
      do i = compared_lines + 1, 1, -1
         last(i) = at
         if (text(at:at) == achar(13) .and. at < finish) last(i) = at - 1
         first(i) = begin
         if (at >= begin) first(i) = begin + index(text(begin:at), achar(10), back=.true.)
         lines = lines + 1
         at = first(i) - 2
         if (at < begin) exit
      end do
      ends_line = finish < len(text)
      if (ends_line) ends_line = scan(text(finish + 1:finish + 1), achar(10)//achar(13)) == 1
      i = compared_lines + 2 - lines
      call cut_in_lines(text, first(i:), last(i:), 0, .false., ends_line, is_cut, at)
   end function is_cut

end module dondolo_records_single_column
