!> Samples that are printed unlike all others of their column: -777 among numbers with four decimals marks a missing value.
module dondolo_records_column_prints
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_files_text_file, only : text_file_type
   use dondolo_records_format, only : raise_at
   implicit none
   private

   public :: check_prints, decimals_of, find_odd_print

   !> What stands between numbers
   character(len=*), parameter :: separators = ' ,;"'''//achar(9)

   !> Print of whole numbers; that of numbers with an exponent is their decimals and this many
   integer, parameter :: whole = -1, with_exponent = 64, most = 127

   !> Fewest samples that show how all are printed
   integer, parameter :: fewest = 32

contains

   !> Refuse samples that are printed unlike all others
   subroutine check_prints(text, begin, columns, is_checked, values, error)
      type(text_file_type), intent(in) :: text
      !> First line of values
      integer, intent(in) :: begin
      !> Number of columns, 1 for values along the rows
      integer, intent(in) :: columns
      !> Columns of accelerations
      logical, intent(in) :: is_checked(:)
      !> Values, line by line; there may be more in the text
      real(wp), intent(in) :: values(:)
      !> One is printed unlike the others
      type(error_type), allocatable, intent(out) :: error

      integer, allocatable :: prints(:), lines(:)
      integer :: line, at, first, last, count, k, odd

      allocate (prints(size(values)), lines(size(values)))
      count = 0
      do line = begin, text%lines()
         at = text%first(line)
         do while (count < size(values))
            first = at - 1 + verify(text%text(at:text%last(line)), separators)
            if (first < at) exit
            last = first - 2 + scan(text%text(first:text%last(line))//' ', separators)
            count = count + 1
            prints(count) = decimals_of(text%text(first:last))
            lines(count) = line
            at = last + 1
         end do
      end do
      ! Columns that touch have no print of their own
      if (count < size(values)) return
      do k = 1, columns
         if (.not. is_checked(k)) cycle
         odd = find_odd_print(prints(k::columns), values(k::columns))
         if (odd == 0) cycle
         odd = k + (odd - 1)*columns
         call raise_at(error, text, lines(odd), 'value '//to_text(values(odd))//' is printed unlike the others: if it marks a '// &
            & 'missing value it must be replaced, and no counts may stand there')
         return
      end do
   end subroutine check_prints

   !> Decimals of a printed number, -1 of a whole one; with an exponent, more than 62
   pure integer function decimals_of(number) result(decimals)
      character(len=*), intent(in) :: number

      integer :: point, finish

      finish = scan(number, 'eEdD') - 1
      if (finish < 0) finish = len(number)
      point = index(number(:finish), '.')
      decimals = whole
      if (point > 0) decimals = min(finish - point, with_exponent - 2)
      if (finish < len(number)) decimals = decimals + with_exponent
   end function decimals_of

   !> Find a number that is printed unlike the others: a whole one where all others have the same decimals, or one with other
   !> decimals that is far from those beside it and larger than all, or the only one of its kind
   pure integer function find_odd_print(prints, values) result(odd)
      !> As `decimals_of` has them
      integer, intent(in) :: prints(:)
      real(wp), intent(in) :: values(:)
      !> 0 if there is none

      !> A mark is larger than all samples by this factor, and differs from those beside it by this part
      real(wp), parameter :: larger = 1.5_wp, isolated = 0.5_wp, decade = 0.1_wp
      integer :: found(whole:most), usual, i, others, n
      real(wp) :: largest, smallest
      logical :: all_are_whole, are_one, is_larger, is_mark

      n = size(prints)
      odd = 0
      if (n < fewest) return
      found = 0
      do i = 1, n
         found(prints(i)) = found(prints(i)) + 1
      end do
      usual = maxloc(found, dim=1) - 1 + whole
      if (found(usual) == n .or. 2*found(usual) < n) return
      largest = maxval(abs(values), mask=prints == usual)
      ! Numbers of equal significant digits have equal decimals within a decade only
      smallest = minval(abs(values), mask=prints == usual .and. abs(values) > 0.0_wp)
      others = 0
      are_one = .true.
      do i = 1, n
         if (prints(i) == usual .or. .not. abs(values(i)) > 0.0_wp) cycle
         if (.not. is_whole(i) .and. i < n) others = others + 1
         if (odd == 0) odd = i
         are_one = are_one .and. abs(values(i) - values(odd)) <= 0.0_wp
      end do
      ! Dropped zeros leave whole numbers among those of one decimal
      all_are_whole = others == 0 .and. usual > 1
      do i = 1, n
         if (prints(i) == usual .or. .not. abs(values(i)) > 0.0_wp) cycle
         odd = i
         ! A last value that is shorter may be cut off, which is reported; only one with an exponent is larger then
         if (is_whole(i) .and. all_are_whole .and. (i < n .or. abs(values(i)) > largest)) return
         if (i == n .and. usual >= with_exponent - 1) cycle
         is_larger = abs(values(i)) > larger*largest
         if (usual >= with_exponent - 1) then
            ! Where small numbers have exponents, larger ones may have none
            is_mark = is_larger .and. are_one
         else
            is_mark = is_larger .or. (are_one .and. i < n .and. abs(usual - prints(i)) > 1)
         end if
         if (.not. (is_mark .and. smallest < decade*largest)) cycle
         if (is_isolated(i)) return
      end do
      odd = 0

   contains

      !> Is a number printed as a whole one, with or without an exponent?
      pure logical function is_whole(place)
         integer, intent(in) :: place

         is_whole = usual /= whole .and. (prints(place) == whole .or. prints(place) == whole + with_exponent)
      end function is_whole

      !> Is a number far from those beside it that are printed as usual?
      pure logical function is_isolated(place)
         integer, intent(in) :: place

         is_isolated = .true.
         associate (value => values(place))
            if (place > 1) is_isolated = prints(place - 1) /= usual .or. abs(value - values(place - 1)) > isolated*abs(value)
            if (place < n) is_isolated = is_isolated .and. (prints(place + 1) /= usual .or. abs(value - values(place + 1)) > &
               & isolated*abs(value))
         end associate
      end function is_isolated

   end function find_odd_print

end module dondolo_records_column_prints
