!> Names of months and days of the week in dates: in English whole or by their first letters, in other languages whole.
module dondolo_records_month_names
   use dondolo_base_text, only : blanks
   use dondolo_records_day_times, only : letters, pass
   implicit none
   private

   public :: pass_name, pass_weekday, which_month

   !> Months and days of the week, by their first letters
   character(len=3), parameter :: months(12) = ['jan', 'feb', 'mar', 'apr', 'may', 'jun', 'jul', 'aug', 'sep', 'oct', 'nov', &
      & 'dec'], weekdays(7) = ['mon', 'tue', 'wed', 'thu', 'fri', 'sat', 'sun']

   !> Their other letters
   character(len=6), parameter :: rest_of_months(12) = [character(len=6) :: 'uary', 'ruary', 'ch', 'il', '', 'e', 'y', 'ust', &
      & 'tember', 'ober', 'ember', 'ember'], rest_of_days(7) = [character(len=6) :: 'day', 'sday', 'nesday', 'rsday', 'day', &
      & 'urday', 'day']

   !> Months in Italian, Spanish, Portuguese, French, German and Turkish, without accents and with them
   character(len=10), parameter :: foreign(12, 8) = reshape([character(len=10) :: &
      & 'gennaio', 'febbraio', 'marzo', 'aprile', 'maggio', 'giugno', 'luglio', 'agosto', 'settembre', 'ottobre', 'novembre', &
      &   'dicembre', &
      & 'enero', 'febrero', 'marzo', 'abril', 'mayo', 'junio', 'julio', 'agosto', 'septiembre', 'octubre', 'noviembre', &
      &   'diciembre', &
      & 'janeiro', 'fevereiro', 'marco', 'abril', 'maio', 'junho', 'julho', 'agosto', 'setembro', 'outubro', 'novembro', &
      &   'dezembro', &
      & 'janvier', 'fevrier', 'mars', 'avril', 'mai', 'juin', 'juillet', 'aout', 'septembre', 'octobre', 'novembre', 'decembre', &
      & 'januar', 'februar', 'maerz', 'april', 'mai', 'juni', 'juli', 'august', 'september', 'oktober', 'november', 'dezember', &
      & 'ocak', 'subat', 'mart', 'nisan', 'mayis', 'haziran', 'temmuz', 'agustos', 'eylul', 'ekim', 'kasim', 'aralik', &
      & 'ocak', 'şubat', 'märz', 'nisan', 'mayıs', 'haziran', 'temmuz', 'ağustos', 'eylül', 'ekim', 'kasım', 'aralık', &
      & 'janvier', 'février', 'março', 'avril', 'mai', 'juin', 'juillet', 'août', 'septembre', 'octobre', 'novembre', &
      &   'décembre'], [12, 8])

contains

   !> Number of the month whose name is at a place, 0 if there is none
   pure integer function which_month(text, at)
      !> Text in lower case
      character(len=*), intent(in) :: text
      integer, intent(in) :: at

      integer :: next, place(2)

      which_month = which_name(text, at, months, rest_of_months)
      if (which_month > 0) return
      next = at
      call pass_name(text, next)
      if (next == at) return
      place = findloc(foreign, text(at:next - 1))
      which_month = place(1)
   end function which_month

   !> Number of the name at a place, whole or its first letters, 0 if there is none
   pure integer function which_name(text, at, starts, rests) result(which)
      !> Text in lower case
      character(len=*), intent(in) :: text
      integer, intent(in) :: at
      !> First letters of the names, and the others
      character(len=*), intent(in) :: starts(:), rests(:)

      integer :: next

      next = at
      call pass_name(text, next)
      do which = size(starts), 1, -1
         if (text(at:next - 1) == starts(which) .or. text(at:next - 1) == starts(which)//rests(which)) return
         if (text(at:next - 1) == 'sept' .and. starts(which) == 'sep') return
      end do
   end function which_name

   !> Pass a day of the week
   pure subroutine pass_weekday(text, at)
      !> Text in lower case
      character(len=*), intent(in) :: text
      !> Where it may be, and where what follows begins
      integer, intent(inout) :: at

      call pass(text, blanks, at)
      if (which_name(text, at, weekdays, rest_of_days) == 0) return
      call pass_name(text, at)
      call pass(text, blanks//',.', at)
   end subroutine pass_weekday

   !> Pass letters, those beyond ASCII too
   pure subroutine pass_name(text, at)
      !> Text in lower case, and place
      character(len=*), intent(in) :: text
      integer, intent(inout) :: at

      do while (at <= len(text))
         if (scan(text(at:at), letters) == 0 .and. iachar(text(at:at)) < 128) return
         at = at + 1
      end do
   end subroutine pass_name

end module dondolo_records_month_names
