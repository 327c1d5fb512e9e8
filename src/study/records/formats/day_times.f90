!> Times of the day in headers and catalogues, with their zones.
module dondolo_records_day_times
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_integer, parse_real
   use dondolo_base_text, only : blanks
   implicit none
   private

   public :: digits, letters, pass, take_time

   !> Digits
   character(len=*), parameter :: digits = '0123456789'

   !> Letters, in lower case
   character(len=*), parameter :: letters = 'abcdefghijklmnopqrstuvwxyz'

   !> Zones of time that have one meaning, and how they are written; that of Greenwich is not marked
   character(len=4), parameter :: zones(13) = [character(len=4) :: 'utc', 'gmt', 'ut', 'pst', 'pdt', 'mdt', 'edt', 'akst', &
      & 'akdt', 'hst', 'jst', 'nzst', 'nzdt']
   character(len=6), parameter :: offsets(13) = [character(len=6) :: '', '', '', '-08:00', '-07:00', '-06:00', '-04:00', &
      & '-09:00', '-08:00', '-10:00', '+09:00', '+12:00', '+13:00']

contains

   !> Take a time of the day and its zone: 15:23:09.25, 152309.25, 1523, 3:23 pm
   pure subroutine take_time(text, at, time)
      !> Text in lower case
      character(len=*), intent(in) :: text
      !> Where to look, and where what follows begins
      integer, intent(inout) :: at
      !> The time with the difference from that of Greenwich, empty if there is none
      character(len=:), allocatable, intent(out) :: time

      character(len=:), allocatable :: seconds, offset
      integer :: next, length, hour, minute
      real(wp) :: second
      logical :: ok, good

      time = ''
      seconds = ''
      next = at
      length = verify(text(next:)//'x', digits) - 1
      if (any(length == [4, 6])) then
         call parse_integer(text(next:next + 1), hour, ok)
         call parse_integer(text(next + 2:next + 3), minute, good)
         if (length == 6) seconds = text(next + 4:next + 5)
         next = next + length
         if (length == 6) call take_decimals(text, next, seconds)
         if (next <= len(text)) then
            if (scan(text(next:next), letters(:len(letters) - 1)) > 0) return
         end if
      else if (any(length == [1, 2])) then
         call parse_integer(text(next:next + length - 1), hour, ok)
         next = next + length
         if (next + 2 > len(text)) return
         if (text(next:next) /= ':' .or. verify(text(next + 1:next + 2), digits) > 0) return
         call parse_integer(text(next + 1:next + 2), minute, good)
         next = next + 3
         if (next <= len(text)) then
            if (text(next:next) == ':') then
               next = next + 1
               length = min(verify(text(next:)//'x', digits) - 1, 2)
               seconds = text(next:next + length - 1)
               next = next + length
               if (length > 0) call take_decimals(text, next, seconds)
            end if
         end if
      else
         return
      end if
      second = 0.0_wp
      if (len(seconds) > 0) call parse_real(seconds, second, ok)
      if (.not. (ok .and. good .and. hour < 24 .and. minute < 60 .and. second < 61.0_wp)) return
      if (next <= len(text)) then
         if (scan(text(next:next), digits//':') > 0) return
      end if
      call take_half(text, next, hour)
      call take_zone(text, next, offset)
      time = two(hour)//':'//two(minute)
      if (len(seconds) > 0) time = time//':'//seconds
      time = time//offset
      at = next
   end subroutine take_time

   !> Take the decimals of seconds
   pure subroutine take_decimals(text, at, seconds)
      !> Text
      character(len=*), intent(in) :: text
      !> Where their point may be, and where what follows begins
      integer, intent(inout) :: at
      !> Seconds, with them from now on
      character(len=:), allocatable, intent(inout) :: seconds

      integer :: length

      if (at > len(text)) return
      if (text(at:at) /= '.') return
      length = verify(text(at + 1:)//'x', digits) - 1
      if (length > 0) seconds = seconds//text(at:at + length)
      at = at + length + 1
   end subroutine take_decimals

   !> Take which half of the day a time is in
   pure subroutine take_half(text, at, hour)
      !> Text in lower case, and place as of take_time
      character(len=*), intent(in) :: text
      integer, intent(inout) :: at
      !> Hour, of the day from now on
      integer, intent(inout) :: hour

      character(len=2) :: word
      integer :: next

      next = at
      call pass(text, blanks, next)
      word = text(min(next, len(text) + 1):min(next + 1, len(text)))
      if (all(word /= ['am', 'pm']) .or. hour < 1 .or. hour > 12) return
      if (next + 2 <= len(text)) then
         if (scan(text(next + 2:next + 2), letters//digits) > 0) return
      end if
      hour = modulo(hour, 12) + merge(12, 0, word == 'pm')
      at = next + 2
   end subroutine take_half

   !> Take the zone of a time
   pure subroutine take_zone(text, at, offset)
      !> Text in lower case, and place as of take_time
      character(len=*), intent(in) :: text
      integer, intent(inout) :: at
      !> Difference from the time of Greenwich; empty if it is that, or not known
      character(len=:), allocatable, intent(out) :: offset

      integer :: next, length, i

      offset = ''
      next = at
      if (next > len(text)) return
      if (scan(text(next:next), '+-') > 0) then
         length = verify(text(next + 1:)//'x', digits//':') - 1
         i = next
         if (length == 5) then
            if (text(next + 3:next + 3) == ':') offset = text(i:i + 5)
         else if (length == 4 .and. index(text(next + 1:next + length), ':') == 0) then
            offset = text(i:i + 2)//':'//text(i + 3:i + 4)
         else if (length == 2 .and. index(text(next + 1:next + length), ':') == 0) then
            offset = text(i:i + 2)//':00'
         end if
         if (len(offset) > 0) at = next + length + 1
         return
      end if
      call pass(text, blanks, next)
      length = verify(text(min(next, len(text) + 1):)//'.', letters) - 1
      if (length == 0) return
      if (text(next:next + length - 1) == 'z') then
         offset = 'Z'
         at = next + length
      else
         i = findloc(zones == text(next:next + length - 1), .true., dim=1)
         if (i == 0) return
         offset = trim(offsets(i))
         at = next + length
      end if
   end subroutine take_zone

   !> Pass characters
   pure subroutine pass(text, characters, at)
      !> Text
      character(len=*), intent(in) :: text
      !> Characters to pass
      character(len=*), intent(in) :: characters
      !> Where they may be, and where what follows begins
      integer, intent(inout) :: at

      do while (at <= len(text))
         if (index(characters, text(at:at)) == 0) exit
         at = at + 1
      end do
   end subroutine pass

   !> Two digits
   pure function two(number)
      !> A number of at most two digits
      integer, intent(in) :: number
      !> The number with a leading zero
      character(len=2) :: two

      write (two, '(i2.2)') number
   end function two

end module dondolo_records_day_times
