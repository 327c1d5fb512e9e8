!> Dates and times of headers and catalogues, written one way: 1997-10-14T15:23:09+09:00, as ISO 8601 has it.
!>
!> What is no date of the calendar gives none: a text in its place is no date either.
module dondolo_records_dates
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_integer, parse_real
   use dondolo_base_text, only : blanks, lower
   use dondolo_records_day_times, only : digits, letters, pass, take_time
   use dondolo_records_month_names, only : pass_name, pass_weekday, which_month
   implicit none
   private

   public :: day_number, find_moment, make_stamp, take_moment

contains

   !> Date, and time if it follows, that a text begins with
   pure subroutine find_moment(text, order, moment)
      !> A date, perhaps after a day of the week, and perhaps with a time and its zone; what follows is ignored
      character(len=*), intent(in) :: text
      !> Which comes first where a year comes last in numbers, 'dmy' or 'mdy'; '': not known, and only one reading is a date
      character(len=*), intent(in) :: order
      !> The two as ISO 8601 has them, empty if the text begins with no date
      character(len=:), allocatable, intent(out) :: moment

      integer :: at

      at = 1
      call take_moment(text, order, at, moment)
   end subroutine find_moment

   !> Take a date, and a time if it follows, from a text
   pure subroutine take_moment(text, order, at, moment)
      !> Text, order and moment as of find_moment
      character(len=*), intent(in) :: text
      character(len=*), intent(in) :: order
      !> Where to look, and where what follows begins
      integer, intent(inout) :: at
      character(len=:), allocatable, intent(out) :: moment

      character(len=len(text)) :: lowered
      character(len=:), allocatable :: time
      character(len=10) :: date
      integer :: next

      lowered = lower(text)
      moment = ''
      next = at
      call pass_weekday(lowered, next)
      call take_date(lowered, order, next, date)
      if (date == '') return
      moment = trim(date)
      at = next
      ! 1997-10-14T15:23:09, 20140120_071240, 2018/02/06-23:50:42, May 2, 1983, 16:42
      if (next <= len(text)) then
         if (scan(lowered(next:next), 't_-,') > 0) next = next + 1
      end if
      call pass(lowered, blanks, next)
      call take_time(lowered, next, time)
      if (len(time) == 0) return
      moment = moment//'T'//time
      at = next
   end subroutine take_moment

   !> Take a date: in numbers, or with the name of a month
   pure subroutine take_date(text, order, at, date)
      !> Text in lower case, order and place as of take_moment
      character(len=*), intent(in) :: text
      character(len=*), intent(in) :: order
      integer, intent(inout) :: at
      !> The date, empty if there is none
      character(len=10), intent(out) :: date

      integer :: number(3), width(3), next, i, named
      logical :: ok

      date = ''
      next = at
      number = 0
      width = 0
      named = 0
      do i = 1, 3
         if (named == 0) call take_month(text, next, named)
         if (named == i) then
            number(i) = which_month(text, next)
            call pass_name(text, next)
         else
            call take_number(text, next, number(i), width(i), ok)
            ! Eight digits, and those of a time after them
            if (ok .and. i == 1 .and. any(width(1) == [8, 12, 14])) then
               call parse_integer(text(at:at + 3), number(1), ok)
               call parse_integer(text(at + 4:at + 5), number(2), ok)
               call parse_integer(text(at + 6:at + 7), number(3), ok)
               call write_date(number, date)
               if (date /= '') at = at + 8
               return
            end if
            if (.not. ok) return
            ! 2031/074 has the number of the day in the year
            if (i == 2 .and. width(1) == 4 .and. width(2) == 3 .and. text(at + 4:at + 4) == '/') then
               if (number(2) < 1 .or. number(2) > 337 + days_of(number(1), 2)) return
               call take_day(number(2) - 1, number(1), date)
               at = next
               return
            end if
         end if
         if (i < 3) call pass_separators(text, next)
      end do
      ! No date goes on with digits or letters, nor with a fourth number
      if (next <= len(text)) then
         if (scan(text(next:next), digits//letters//'/') > 0 .and. text(next:next) /= 't') return
         if (next < len(text)) then
            if (scan(text(next:next), '-.') > 0 .and. scan(text(next + 1:next + 1), digits) > 0 .and. &
               & index(text(next:min(next + 3, len(text))), ':') == 0) return
         end if
      end if
      call arrange(number, width, named, order, ok)
      if (ok) call write_date(number, date)
      if (date /= '') at = next

   contains

      !> The place of a month's name among the numbers, if it is here
      pure subroutine take_month(text, at, named)
         !> Text and place
         character(len=*), intent(in) :: text
         integer, intent(in) :: at
         !> It, or 0
         integer, intent(inout) :: named

         if (which_month(text, at) > 0) named = i
      end subroutine take_month

   end subroutine take_date

   !> The date of a day of a year
   pure subroutine take_day(days, year, date)
      !> How many are before it
      integer, intent(in) :: days, year
      character(len=10), intent(out) :: date

      integer :: number(3)

      number = [year, 1, 1]
      call move_days(number, days)
      call write_date(number, date)
   end subroutine take_day

   !> Put numbers into the order year, month, day
   pure subroutine arrange(number, width, named, order, ok)
      !> The numbers, and how many digits they have; 0 for a name
      integer, intent(inout) :: number(3)
      integer, intent(in) :: width(3)
      !> Which of them is the name of a month; 0: none
      integer, intent(in) :: named
      !> As of find_moment
      character(len=*), intent(in) :: order
      !> There is one way to read them
      logical, intent(out) :: ok

      character(len=3) :: way

      ok = .true.
      if (width(1) == 4 .and. all(width(2:) <= 2) .and. named /= 1) then
         if (named == 3) number = number([1, 3, 2])
         return
      end if
      ok = width(3) == 4 .and. all(width(:2) <= 2) .and. named /= 3
      if (.not. ok) return
      way = order
      if (named == 1) way = 'mdy'
      if (named == 2) way = 'dmy'
      if (way == '') then
         if (number(1) > 12 .or. number(1) == number(2)) way = 'dmy'
         if (number(2) > 12) way = 'mdy'
      end if
      ok = way /= ''
      if (way == 'mdy') then
         number = number([3, 1, 2])
      else
         number = number([3, 2, 1])
      end if
   end subroutine arrange

   !> Write a date of the calendar
   pure subroutine write_date(number, date)
      !> Year, month, day
      integer, intent(in) :: number(3)
      !> The date, empty if there is no such
      character(len=10), intent(out) :: date

      date = ''
      if (number(1) < 1000 .or. number(1) > 9999 .or. number(2) < 1 .or. number(2) > 12) return
      if (number(3) < 1 .or. number(3) > days_of(number(1), number(2))) return
      write (date, '(i4.4, a, i2.2, a, i2.2)') number(1), '-', number(2), '-', number(3)
   end subroutine write_date

   !> Days of a month
   pure integer function days_of(year, month)
      !> Year and month
      integer, intent(in) :: year, month

      integer, parameter :: usual(12) = [31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31]

      days_of = usual(month)
      if (month == 2 .and. modulo(year, 4) == 0 .and. (modulo(year, 100) /= 0 .or. modulo(year, 400) == 0)) days_of = 29
   end function days_of

   !> Take a number of at most 14 digits
   pure subroutine take_number(text, at, number, width, ok)
      !> Text
      character(len=*), intent(in) :: text
      !> Where it is, and where what follows begins
      integer, intent(inout) :: at
      !> Number, 0 if it is long, and how many digits it has
      integer, intent(out) :: number, width
      !> There is one
      logical, intent(out) :: ok

      logical :: fits

      number = 0
      width = 0
      if (at <= len(text)) width = verify(text(at:)//'x', digits) - 1
      ok = width > 0 .and. width <= 14
      if (.not. ok) return
      if (width <= 8) call parse_integer(text(at:at + width - 1), number, fits)
      at = at + width
   end subroutine take_number

   !> Pass what may stand between the parts of a date
   pure subroutine pass_separators(text, at)
      !> Text, and place
      character(len=*), intent(in) :: text
      integer, intent(inout) :: at

      if (at > len(text)) return
      if (scan(text(at:at), '/-.,') > 0) at = at + 1
      call pass(text, blanks, at)
      ! 6 de mayo de 1976
      if (index(text(at:), 'de ') == 1) at = at + 3
   end subroutine pass_separators

   !> Number of the day of a moment, counted from one day on; 0 if it is not known
   pure integer function day_number(moment)
      !> Date, perhaps with a time, as of find_moment; anything else is not known
      character(len=*), intent(in) :: moment

      integer :: date(3)
      logical :: ok

      day_number = 0
      call read_numbers(moment, date, ok)
      if (ok) ok = moment(5:5)//moment(8:8) == '--'
      if (.not. ok) return
      ! Years from March on, so that the day between leap years is the last one
      if (date(2) < 3) date(:2) = date(:2) + [-1, 12]
      day_number = 365*date(1) + date(1)/4 - date(1)/100 + date(1)/400 + (153*date(2) - 457)/5 + date(3)
   end function day_number

   !> Read the first numbers of a moment
   pure subroutine read_numbers(moment, number, ok)
      character(len=*), intent(in) :: moment
      !> Year, month, day, hour, minute
      integer, intent(out) :: number(:)
      !> They are there
      logical, intent(out) :: ok

      integer :: i

      ok = len(moment) >= 3*size(number) + 1
      do i = 1, size(number)
         if (ok) call parse_integer(moment(merge(1, 3*i, i == 1):3*i + 1), number(i), ok)
      end do
   end subroutine read_numbers

   !> A moment in the time of Greenwich, to the second, without separators: 20141231T144900Z
   pure subroutine make_stamp(moment, stamp)
      !> Date and time as of find_moment
      character(len=*), intent(in) :: moment
      !> The stamp, empty if there is no time
      character(len=:), allocatable, intent(out) :: stamp

      integer :: number(5), day, second, sign, ends, hours, minutes
      real(wp) :: seconds
      logical :: ok
      character(len=16) :: buffer

      stamp = ''
      call read_numbers(moment, number, ok)
      if (.not. ok) return
      seconds = 0.0_wp
      ends = scan(moment(17:)//'Z', '+-Z') + 15
      if (ends >= 18) call parse_real(moment(18:ends), seconds, ok)
      if (.not. ok) return
      second = 60*(60*number(4) + number(5)) + nint(seconds)
      if (len(moment) == ends + 6) then
         sign = merge(-1, 1, moment(ends + 1:ends + 1) == '-')
         call parse_integer(moment(ends + 2:ends + 3), hours, ok)
         if (ok) call parse_integer(moment(ends + 5:ends + 6), minutes, ok)
         if (.not. ok) return
         second = second - sign*60*(60*hours + minutes)
      end if
      day = (second - modulo(second, 86400))/86400
      second = modulo(second, 86400)
      call move_days(number(:3), day)
      write (buffer, '(i4.4, 2i2.2, a, 3i2.2, a)') number(:3), 'T', second/3600, modulo(second/60, 60), modulo(second, 60), 'Z'
      stamp = buffer
   end subroutine make_stamp

   !> Move a date by days
   pure subroutine move_days(date, days)
      !> Year, month, day
      integer, intent(inout) :: date(3)
      !> How many
      integer, intent(in) :: days

      integer :: i

      do i = 1, abs(days)
         date(3) = date(3) + merge(1, -1, days > 0)
         if (date(3) < 1) then
            date(2) = date(2) - 1
            if (date(2) < 1) date(:2) = [date(1) - 1, 12]
            date(3) = days_of(date(1), date(2))
         else if (date(3) > days_of(date(1), date(2))) then
            date(2:) = [date(2) + 1, 1]
            if (date(2) > 12) date(:2) = [date(1) + 1, 1]
         end if
      end do
   end subroutine move_days

end module dondolo_records_dates
