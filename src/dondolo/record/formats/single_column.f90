!> The short way to what most files of plain columns hold: accelerations alone, one a line, without titles and comments.
!>
!> Such a text is read in one go. No other format recognises it, for their headers have words; of any other text nothing is
!> taken here, and the readers of the formats say what it is or what is wrong with it. They also read a column that begins with
!> a whole number, which may be that of the samples, and one that may be cut off.
module dondolo_record_single_column
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : take_column
   use dondolo_base_text_file, only : find_content, text_file_type
   use dondolo_record_format, only : samples_type
   use dondolo_record_last_number, only : compared_lines, cut_in_lines
   implicit none
   private

   public :: read_single_column

contains

   !> Read a single column of numbers
   subroutine read_single_column(text, samples, is_column)
      !> Text file whose lines need not be known
      type(text_file_type), intent(in) :: text
      !> One channel, as the format `columns` has it, if it is such a column
      type(samples_type), intent(out) :: samples
      !> Is it?
      logical, intent(out) :: is_column

      real(wp), allocatable :: values(:)
      integer :: begin, finish, count

      is_column = .false.
      call find_content(text%text, begin, finish)
      if (finish < begin) return
      ! Each has two characters at least but the last, which may have no line end
      allocate (values((finish - begin)/2 + 1))
      call take_column(text%text(begin:finish), values, count, is_column)
      if (is_column) is_column = .not. (begins_whole(text%text(begin:finish)) .or. is_cut(text%text, begin, finish))
      if (.not. is_column) return
      allocate (samples%channels(1))
      samples%channels(1)%values = values(:count)
   end subroutine read_single_column

   !> Does a column begin with a whole number beyond 1, printed without a point?
   pure logical function begins_whole(text)
      character(len=*), intent(in) :: text

      integer :: length

      ! Where the first line ends; without a copy of the text, which a line end after it would need
      length = scan(text, achar(10)//achar(13)) - 1
      if (length < 0) length = len(text)
      begins_whole = scan(text(:length), '.eEdD-') == 0 .and. (scan(text(:length), '23456789') > 0 .or. &
         & (len_trim(text(:length)) > 1 .and. scan(text(:length), '1') > 0))
   end function begins_whole

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

end module dondolo_record_single_column
