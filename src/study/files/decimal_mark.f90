!> The decimal mark of a table whose columns are not separated by commas: a comma, as spreadsheets write in much of
!> Europe, or a point.
!>
!> 1.800 and 1,800 are 1800 or 1.8; only other cells of the table can tell. All of its numbers are looked at first, and
!> what remains ambiguous is refused.
module dondolo_files_decimal_mark
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_real
   use dondolo_base_odd_character, only : odd_character
   implicit none
   private

   public :: decimal_mark_type

   !> What the numbers of a table have shown
   type :: decimal_mark_type
      !> Has one a comma that can only be a decimal comma?
      logical :: has_comma = .false.
      !> Has one a point that can only be a decimal point? To be unset before the first look
      logical :: has_point = .true.
   contains
      !> Look at a cell
      procedure :: look
      !> Read a cell
      procedure :: parse
      !> What to say of a cell that cannot be read
      procedure :: problem
   end type decimal_mark_type

   !> Characters of numbers
   character(len=*), parameter :: figures = '0123456789', signs = '+-'

contains

   !> Look at a cell; one that is no number says nothing
   pure subroutine look(self, cell)
      !> What is known
      class(decimal_mark_type), intent(inout) :: self
      !> The cell
      character(len=*), intent(in) :: cell

      real(wp) :: value
      logical :: ok

      if (index(cell, ',') > 0) then
         self%has_comma = self%has_comma .or. &
            & (verify(cell, figures//signs//'.,eEdD ') == 0 .and. .not. is_grouped(cell, ','))
      else if (index(cell, '.') > 0) then
         call parse_real(cell, value, ok)
         self%has_point = self%has_point .or. (ok .and. .not. is_grouped(cell, '.'))
      end if
   end subroutine look

   !> Read a cell, after all cells of the table were looked at
   pure subroutine parse(self, cell, value, ok)
      !> What is known
      class(decimal_mark_type), intent(in) :: self
      !> The cell
      character(len=*), intent(in) :: cell
      !> Its number, 0 unless ok
      real(wp), intent(out) :: value
      !> It is one number, and not one of two
      logical, intent(out) :: ok

      character(len=len(cell)) :: with_point
      integer :: comma

      if (self%has_comma) then
         with_point = cell
         comma = index(cell, ',')
         if (comma > 0) with_point(comma:comma) = '.'
         call parse_real(with_point, value, ok)
         ok = ok .and. index(cell, '.') == 0
      else
         call parse_real(cell, value, ok)
         ok = ok .and. .not. is_ambiguous(self, cell)
      end if
      if (.not. ok) value = 0.0_wp
   end subroutine parse

   !> What to say of a cell that is not one number
   pure function problem(self, cell)
      !> What is known
      class(decimal_mark_type), intent(in) :: self
      !> The cell
      character(len=*), intent(in) :: cell
      !> Half a sentence, filled up with blanks
      character(len=120) :: problem

      problem = 'must be a number, with a decimal point'
      if (self%has_comma) problem = 'must be a number, with a decimal comma as elsewhere in the table and no point'
      if (index(cell, '%') > 0) problem = 'must be a number without a per cent sign, such as 0.25 for 25 %'
      if (len_trim(odd_character(cell)) > 0) problem = 'must be a number, has '//trim(odd_character(cell))
      if (is_ambiguous(self, cell)) problem = 'may be thousands or decimals, and no other number of the table shows '// &
         & 'which: write it in another way'
   end function problem

   !> Does nothing show what the mark in a number is?
   pure logical function is_ambiguous(self, cell)
      !> What is known
      class(decimal_mark_type), intent(in) :: self
      !> A cell
      character(len=*), intent(in) :: cell

      is_ambiguous = .not. (self%has_point .or. self%has_comma) .and. (is_grouped(cell, '.') .or. is_grouped(cell, ','))
   end function is_ambiguous

   !> Can a mark in a number separate its thousands?
   pure logical function is_grouped(cell, mark)
      !> A cell
      character(len=*), intent(in) :: cell
      !> A point or a comma
      character(len=1), intent(in) :: mark

      integer :: first, point

      first = verify(cell, signs//' ')
      point = index(cell, mark)
      is_grouped = .false.
      if (first == 0 .or. point <= first .or. point > first + 3) return
      is_grouped = cell(first:first) /= '0' .and. verify(cell(first:point - 1), figures) == 0 &
         & .and. len_trim(cell) == point + 3 .and. verify(trim(cell(point + 1:)), figures) == 0
   end function is_grouped

end module dondolo_files_decimal_mark
