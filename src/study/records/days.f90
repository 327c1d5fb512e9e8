!> The days that a stated date may mean: one, or several where it is not known which number is the month, or only month or year.
!>
!> Dates tell earthquakes of one name apart, and components of one motion. They do so where they have no day in common, however
!> little each of them says.
module dondolo_records_days
   use dondolo_base_numbers, only : parse_integer
   use dondolo_base_text, only : lower
   use dondolo_record_metadata, only : metadata_type
   use dondolo_records_dates, only : day_number, find_moment
   use dondolo_records_day_times, only : digits
   use dondolo_records_month_names, only : pass_name, which_month
   implicit none
   private

   public :: days_type, find_days, find_short_moment, stated_date

   !> Ranges of days, one for each way to read a date
   type :: days_type
      !> How many; 0: not known
      integer :: count = 0
      !> First and last day of each, as of `day_number`
      integer :: first(4) = 0, last(4) = 0
   contains
      !> May two dates be of one day, or of two that follow each other?
      procedure :: may_be
      !> Number of days
      procedure :: length
      !> Add a range, or the day of a moment if it has one
      procedure, private :: add, add_day
   end type days_type

   !> Days that the dates of one earthquake may be apart
   integer, parameter :: same_day = 1

   !> Accelerograms are from 1933 on: where a year has two digits, those below are of the century after
   character(len=2), parameter :: first_short = '33'

contains

   !> Find the days that a text may mean
   pure subroutine find_days(text, days)
      !> A date, as of find_moment; one whose year has two digits; a month and a year; or a year, perhaps among words
      character(len=*), intent(in) :: text
      type(days_type), intent(out) :: days

      character(len=3), parameter :: orders(3) = ['   ', 'dmy', 'mdy']
      character(len=:), allocatable :: moment
      integer :: i, year, month

      do i = 1, size(orders)
         call find_moment(text, trim(orders(i)), moment)
         call days%add_day(moment)
         if (i == 1 .and. days%count > 0) return
      end do
      if (days%count == 0) call add_short_years(text, days)
      if (days%count > 0) return
      call find_month(lower(text), year, month)
      if (year == 0) return
      if (month > 0) then
         call days%add(first_of(year, month), first_of(year + month/12, modulo(month, 12) + 1) - 1)
      else
         call days%add(first_of(year, 1), first_of(year + 1, 1) - 1)
      end if
   end subroutine find_days

   !> Add the days of a date whose year, its last or its first number, has two digits
   pure subroutine add_short_years(text, days)
      character(len=*), intent(in) :: text
      type(days_type), intent(inout) :: days

      character(len=*), parameter :: orders(2) = ['dmy', 'mdy']
      character(len=:), allocatable :: moment
      integer :: begin, i

      do i = 1, size(orders)
         call find_short_moment(text, orders(i), moment)
         call days%add_day(moment)
      end do
      begin = max(1, verify(text, ' '))
      if (begin + 2 > len(text)) return
      if (verify(text(begin:begin + 1), digits) > 0 .or. scan(text(begin + 2:begin + 2), digits) > 0) return
      call find_moment(full_year(text(begin:begin + 1))//text(begin + 2:), '', moment)
      call days%add_day(moment)
   end subroutine add_short_years

   !> Date, and time if it follows, that a text begins with, whose year is its third word and has two digits
   pure subroutine find_short_moment(text, order, moment)
      !> As of find_moment
      character(len=*), intent(in) :: text, order
      character(len=:), allocatable, intent(out) :: moment

      integer :: ends

      moment = ''
      call find_third(text, max(1, verify(text, ' ')), ends)
      if (ends > 0) call find_moment(text(:ends - 2)//full_year(text(ends - 1:ends))//text(ends + 1:), order, moment)
   end subroutine find_short_moment

   !> Find the year of a text, and its month: 1976-05, 05/1976, May 1976, autumn 1976
   pure subroutine find_month(text, year, month)
      !> Text in lower case
      character(len=*), intent(in) :: text
      !> 0 if they are not stated, or other numbers are
      integer, intent(out) :: year, month

      integer :: at, length, number, behind
      logical :: ok

      year = 0
      month = 0
      behind = 0
      at = 1
      do while (at <= len(text))
         length = verify(text(at:)//'x', digits) - 1
         if (length > 0) then
            call parse_integer(text(at:at + min(length, 8) - 1), number, ok)
            ! 2016, 3 shocks is no month
            ok = behind == 0
            if (behind > 1) ok = at == behind + 1 .and. scan(text(behind:behind), '-/.') > 0
            if (.not. ok) then
               year = 0
               return
            else if (length == 4 .and. year == 0) then
               year = number
            else if (length <= 2 .and. month == 0 .and. number >= 1 .and. number <= 12) then
               month = number
            else
               year = 0
               return
            end if
            at = at + length
            behind = at
         else
            if (which_month(text, at) > 0) month = which_month(text, at)
            length = at
            call pass_name(text, at)
            if (at == length) at = at + 1
         end if
      end do
      if (year < 1000) year = 0
   end subroutine find_month

   !> Find the end of the third of the words that a date begins with, if it has two digits
   pure subroutine find_third(text, begin, ends)
      character(len=*), intent(in) :: text
      !> Where the date begins
      integer, intent(in) :: begin
      !> Its last digit, 0 if there is none
      integer, intent(out) :: ends

      character(len=*), parameter :: separators = '/-., '
      integer :: i, at, length

      ends = 0
      at = begin
      do i = 1, 3
         length = scan(text(min(at, len(text) + 1):)//' ', separators) - 1
         if (length == 0) return
         if (i == 3) exit
         at = at + length
         if (at > len(text)) return
         at = at - 1 + verify(text(at:)//'x', separators)
      end do
      if (length /= 2) return
      if (verify(text(at:at + 1), digits) == 0) ends = at + 1
   end subroutine find_third

   !> Year that two digits mean
   pure function full_year(short) result(year)
      character(len=2), intent(in) :: short
      character(len=4) :: year

      year = merge('20', '19', short < first_short)//short
   end function full_year

   !> Number of the first day of a month
   pure integer function first_of(year, month)
      integer, intent(in) :: year, month

      character(len=10) :: date

      write (date, '(i4.4, a, i2.2, a)') year, '-', month, '-01'
      first_of = day_number(date)
   end function first_of

   pure subroutine add(self, first, last)
      class(days_type), intent(inout) :: self
      integer, intent(in) :: first, last

      if (self%count == size(self%first)) return
      self%count = self%count + 1
      self%first(self%count) = first
      self%last(self%count) = last
   end subroutine add

   pure subroutine add_day(self, moment)
      class(days_type), intent(inout) :: self
      character(len=*), intent(in) :: moment

      if (day_number(moment) > 0) call self%add(day_number(moment), day_number(moment))
   end subroutine add_day

   pure logical function may_be(self, other)
      class(days_type), intent(in) :: self
      !> Another date; two of which one is not known may be the same
      type(days_type), intent(in) :: other

      integer :: i, k, apart

      may_be = self%count == 0 .or. other%count == 0
      do i = 1, self%count
         do k = 1, other%count
            ! Years that follow each other are not the same
            apart = merge(same_day, 0, self%first(i) == self%last(i) .and. other%first(k) == other%last(k))
            may_be = may_be .or. (self%first(i) <= other%last(k) + apart .and. self%last(i) >= other%first(k) - apart)
         end do
      end do
   end function may_be

   pure integer function length(self)
      class(days_type), intent(in) :: self

      length = sum(self%last(:self%count) - self%first(:self%count) + 1)
   end function length

   !> The date of a record as its file states it, or its catalogue
   pure subroutine stated_date(metadata, text)
      type(metadata_type), intent(in) :: metadata
      !> Empty if none is stated
      character(len=:), allocatable, intent(out) :: text

      text = metadata%get('date')
      if (len(text) == 0) text = metadata%get('stated date')
   end subroutine stated_date

end module dondolo_records_days
