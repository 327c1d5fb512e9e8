!> Columns as programs export them, made plain: cells without quotes, decimal points in place of commas, no rows of empty cells at
!> the end, and the line `sep=;` of spreadsheets as a comment. All characters keep their places.
!>
!> Decimal commas are read where they cannot be anything else: in quotes, or where columns are separated by semicolons or blanks, or
!> are said to be one, and no value has a point.
module dondolo_records_column_text
   use dondolo_base_text, only : blanks, lower
   use dondolo_files_text_file, only : text_file_type
   use dondolo_records_column_cells, only : first_value_line, unquoted
   implicit none
   private

   public :: look_at_columns, make_plain, irregularities_type

   !> What is not plain
   type :: irregularities_type
      !> Lines without rows of empty cells at the end
      integer :: lines = 0
      !> Lines that are dropped at the end
      logical :: has_empty_rows = .false.
      !> Decimal commas
      logical :: has_commas = .false.
      !> Quotes
      logical :: has_quotes = .false.
      !> A first line that names the separator
      logical :: has_separator_line = .false.
   contains
      !> Is there anything?
      procedure :: any => any_oddity
   end type irregularities_type

contains

   !> Is there anything that is not plain?
   pure logical function any_oddity(self)
      class(irregularities_type), intent(in) :: self

      any_oddity = self%has_empty_rows .or. self%has_commas .or. self%has_quotes .or. self%has_separator_line
   end function any_oddity

   !> Find out what is not plain in a text
   subroutine look_at_columns(text, is_single, odd)
      type(text_file_type), intent(in) :: text
      !> Is it said that there is one column?
      logical, intent(in) :: is_single
      type(irregularities_type), intent(out) :: odd

      character(len=:), allocatable :: line
      integer :: begin, lines

      do lines = text%lines(), 1, -1
         if (verify(text%text(text%first(lines):text%last(lines)), blanks//';,') > 0) exit
      end do
      odd%lines = lines
      odd%has_empty_rows = odd%lines < text%lines()
      if (text%lines() > 0) odd%has_separator_line = index(lower(unquoted(text%line(1))), 'sep=') == 1
      begin = first_value_line(text)
      if (begin > odd%lines) return
      associate (values => text%text(text%first(begin):text%last(odd%lines)))
         odd%has_quotes = scan(values, '"''') > 0
         ! A point is soon found, so that most files are not searched to their end.
         if (index(values, '.') > 0) return
         odd%has_commas = index(values, ',') > 0
         line = unquoted(text%line(begin))
         ! A comma beside a blank separates
         if (odd%has_commas .and. index(line, ';') == 0 .and. .not. is_single) odd%has_commas = scan(line, blanks) > 0 .and. &
            & index(values, ', ') == 0 .and. index(values, ' ,') == 0 .and. &
            & index(values, ','//achar(9)) == 0 .and. index(values, achar(9)//',') == 0
      end associate
   end subroutine look_at_columns

   !> Make a text plain
   subroutine make_plain(text, odd, plain)
      type(text_file_type), intent(in) :: text
      !> What is not plain in it; commas in quotes are added
      type(irregularities_type), intent(inout) :: odd
      !> The same made plain
      type(text_file_type), intent(out) :: plain

      integer :: i, begin, line

      plain%file = text%file
      plain%text = text%text
      plain%first = text%first(:odd%lines)
      plain%last = text%last(:odd%lines)
      if (odd%has_separator_line) plain%text(plain%first(1):plain%first(1)) = '#'
      begin = first_value_line(plain)
      if (begin > odd%lines) return
      if (odd%has_quotes) then
         do line = begin, odd%lines
            call unquote(plain%text(plain%first(line):plain%last(line)), odd%has_commas)
         end do
      end if
      if (.not. odd%has_commas) return
      if (index(plain%text(plain%first(begin):plain%last(odd%lines)), '.') > 0) return
      do i = plain%first(begin), plain%last(odd%lines)
         if (plain%text(i:i) == ',') plain%text(i:i) = '.'
      end do
   end subroutine make_plain

   !> Take the quotes off the cells of a line; commas in them are decimal
   pure subroutine unquote(line, has_commas)
      character(len=*), intent(inout) :: line
      !> Are there decimal commas?
      logical, intent(inout) :: has_commas

      integer :: i
      logical :: inside

      inside = .false.
      do i = 1, len(line)
         if (line(i:i) == '"' .or. line(i:i) == '''') then
            inside = .not. inside
            line(i:i) = ' '
         else if (inside .and. line(i:i) == ',') then
            line(i:i) = '.'
            has_commas = .true.
         end if
      end do
   end subroutine unquote

end module dondolo_records_column_text
