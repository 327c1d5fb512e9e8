!> Dates and times of headers, written one way: 1997-10-14T15:23:09, as ISO 8601 has it.
module dondolo_dates
   use dondolo_numbers, only : parse_integer
   use dondolo_text, only : first_word
   implicit none
   private

   public :: iso_date, iso_time

contains

   !> A date as year-month-day
   pure function iso_date(text, order) result(date)
      !> Eight digits, year first, or three numbers between strokes, hyphens or points, one with four digits the year
      character(len=*), intent(in) :: text
      !> Which comes first where the year comes last: 'dmy' or 'mdy'
      character(len=3), intent(in) :: order
      !> The date, or the text itself where it is no such date; filled up with blanks
      character(len=max(len(text), 10)) :: date

      character(len=*), parameter :: separators = '/-.'
      character(len=:), allocatable :: rest, part
      integer :: number(3), width(3), i, year, month, day
      logical :: ok

      date = adjustl(text)
      if (len_trim(date) == 8 .and. verify(trim(date), '0123456789') == 0) then
         if (is_date(date(5:6), date(7:8))) date = date(1:4)//'-'//date(5:6)//'-'//date(7:8)
         return
      end if
      rest = trim(date)
      do i = 1, 3
         part = first_word(rest, separators)
         call parse_integer(part, number(i), ok)
         if (.not. ok .or. verify(part, '0123456789') > 0) return
         width(i) = len(part)
         rest = rest(index(rest, part) + len(part):)
      end do
      if (len(rest) > 0) return
      if (width(1) == 4 .and. all(width(2:) <= 2)) then
         year = number(1)
         month = number(2)
         day = number(3)
      else if (width(3) == 4 .and. all(width(:2) <= 2)) then
         year = number(3)
         month = merge(number(1), number(2), order == 'mdy')
         day = merge(number(2), number(1), order == 'mdy')
      else
         return
      end if
      if (.not. is_date(two(month), two(day))) return
      date = two(year/100)//two(modulo(year, 100))//'-'//two(month)//'-'//two(day)
   end function iso_date

   !> A time of the day as hours:minutes:seconds
   pure function iso_time(text) result(time)
      !> Six digits and maybe decimals, or numbers between colons
      character(len=*), intent(in) :: text
      !> The time, or the text itself where it is no such time; filled up with blanks
      character(len=max(len(text), 6) + 2) :: time

      time = adjustl(text)
      if (verify(time(1:6), '0123456789') > 0) return
      if (len_trim(time) > 6) then
         if (time(7:7) /= '.' .or. verify(trim(time(8:)), '0123456789') > 0) return
      end if
      time = time(1:2)//':'//time(3:4)//':'//time(5:)
   end function iso_time

   !> Can these be a month and a day?
   pure function is_date(month, day)
      !> Month
      character(len=2), intent(in) :: month
      !> Day
      character(len=2), intent(in) :: day
      !> They lie within 1 to 12 and 1 to 31
      logical :: is_date

      is_date = month >= '01' .and. month <= '12' .and. day >= '01' .and. day <= '31'
   end function is_date

   !> Two digits
   pure function two(number)
      !> A number of at most two digits
      integer, intent(in) :: number
      !> The number with a leading zero
      character(len=2) :: two

      write (two, '(i2.2)') number
   end function two

end module dondolo_dates
