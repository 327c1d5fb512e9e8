!> What the title of a column says: units in its brackets, and whether its values are accelerations at all.
module dondolo_column_titles
   use dondolo_error, only : error_type
   use dondolo_kinds, only : wp
   use dondolo_text, only : lower
   use dondolo_units, only : unit_factor
   implicit none
   private

   public :: find_units, is_other_quantity, is_seconds

   !> Words of titles whose values are no accelerations of the ground in time
   character(len=*), parameter :: others(*) = [character(len=12) :: 'velocity', 'veloc', 'vel', 'displacement', &
      & 'displ', 'disp', 'period', 'frequency', 'freq', 'spectrum', 'spectral', 'pseudo', 'sa', 'psa', 'sv', 'psv', 'sd', &
      & 'velocit', 'velocita', 'spostamento', 'periodo', 'frequenza', 'spettro', 'spettrale', 'slo', 'sld', 'slv', 'slc']

   !> Units of other quantities
   character(len=*), parameter :: other_units(*) = [character(len=4) :: 'm', 'cm', 'mm', 'in', 'ft', 'm/s', 'cm/s', &
      & 'mm/s', 'in/s', 'ft/s', 'hz', 's', 'sec', 'rad', 'deg']

   !> Words for seconds, and for nothing that tells otherwise
   character(len=*), parameter :: seconds(*) = [character(len=7) :: 's', 'sec', 'secs', 'second', 'seconds']

   !> Words of a title of times that are in no seconds
   character(len=*), parameter :: no_seconds(*) = [character(len=12) :: 'ms', 'msec', 'millisecond', 'milliseconds', &
      & 'us', 'min', 'minute', 'minutes', 'hour', 'hours', 'h', 'hz', 'period', 'frequency', 'freq', 'periodo', 'frequenza']

contains

   !> Find the units in a title
   subroutine find_units(title, units)
      !> Title
      character(len=*), intent(in) :: title
      !> The last text in ( ) or [ ] that is a known unit of acceleration, else the last text in brackets, if any
      character(len=:), allocatable, intent(out) :: units

      type(error_type), allocatable :: error
      character(len=:), allocatable :: content
      real(wp) :: factor
      integer :: opening, closing, from

      units = ''
      from = 1
      do
         opening = scan(title(from:), '([')
         if (opening == 0) return
         opening = from - 1 + opening
         closing = scan(title(opening:), ')]')
         if (closing == 0) return
         closing = opening - 1 + closing
         from = closing + 1
         content = trim(adjustl(title(opening + 1:closing - 1)))
         if (len(content) == 0) cycle
         call unit_factor(content, factor, error)
         units = content
         if (.not. allocated(error)) return
      end do
   end subroutine find_units

   !> Does a title name something else than accelerations?
   pure function is_other_quantity(title, units) result(other)
      !> Title
      character(len=*), intent(in) :: title
      !> Units in it
      character(len=*), intent(in) :: units
      !> A word of it, or its units, belong to another quantity. Se is a spectrum of Eurocode 8, SE is a direction
      logical :: other

      other = has_word(title, others) .or. any(other_units == without_sec(lower(units))) .or. &
         & index(' '//title//' ', ' Se ') > 0 .or. index(' '//title, ' Se(') > 0
   end function is_other_quantity

   !> May the values under a title be seconds?
   pure function is_seconds(title, units)
      !> Title
      character(len=*), intent(in) :: title
      !> Units in it
      character(len=*), intent(in) :: units
      !> The units are seconds, or there are none and no word tells otherwise
      logical :: is_seconds

      if (len_trim(units) > 0) then
         is_seconds = any(seconds == lower(units))
      else
         is_seconds = .not. has_word(title, no_seconds)
      end if
   end function is_seconds

   !> Is one of some words in a title?
   pure function has_word(title, words)
      !> Title
      character(len=*), intent(in) :: title
      !> The words, in lower case
      character(len=*), intent(in) :: words(:)
      !> One of them stands there, between characters that are no letters
      logical :: has_word

      character(len=*), parameter :: letters = 'abcdefghijklmnopqrstuvwxyz'
      character(len=:), allocatable :: rest
      integer :: first, last

      has_word = .true.
      rest = lower(title)//' '
      do
         first = scan(rest, letters)
         if (first == 0) exit
         last = first - 2 + verify(rest(first:), letters)
         if (any(words == rest(first:last))) return
         rest = rest(last + 1:)
      end do
      has_word = .false.
   end function has_word

   !> Units with s for sec
   pure function without_sec(units) result(plain)
      !> Units in lower case
      character(len=*), intent(in) :: units
      !> The same; `sec` at the end is `s`
      character(len=len(units)) :: plain

      plain = units
      associate (last => len_trim(units))
         if (last < 4) return
         if (units(last - 3:last) == '/sec') plain(last - 1:) = ''
      end associate
   end function without_sec

end module dondolo_column_titles
