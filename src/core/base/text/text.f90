!> Numbers and words as text: what messages, readers and tables share.
!>
!> Results have lengths that are specification expressions: that of a result of deferred length gfortran 12 keeps in one
!> place for each call in the source, for all threads.
module dondolo_base_text
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_decimals, only : make_figures, make_shortest, is_short, put_digits, rounded_to
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: to_text, make_real, to_table, rounded, brief, counted, lower, join, first_word, stripped, occurrences, replaced, left
   public :: right
   public :: blanks

   !> Significant digits of a result for people, and of a limit that was computed
   integer, parameter :: result_digits = 4, limit_digits = 8

   !> Blank and tab
   character(len=*), parameter :: blanks = ' '//achar(9)

   !> Decimals of a number in result tables: with the digit before them as many as read back exactly
   integer, parameter :: decimals = merge(16, 35, precision(1.0_wp) < 18)

   !> Readable text of a number, for messages
   interface to_text
      module procedure :: real_to_text
      module procedure :: integer_to_text
      module procedure :: count_to_text
   end interface to_text

contains

   ! The lengths precede the functions whose results they size; otherwise gfortran 12 reports an implicit interface.

   !> Length of the text of a number
   pure integer function real_length(value)
      !> Number
      real(wp), intent(in) :: value

      character(len=:), allocatable :: shortest

      call make_real(value, shortest)
      real_length = len(shortest)
   end function real_length

   !> Length of the text of a count
   pure integer function count_length(value)
      !> Count
      integer(int64), intent(in) :: value

      integer(int64) :: left

      count_length = merge(2, 1, value < 0)
      left = value/10
      do while (left /= 0)
         count_length = count_length + 1
         left = left/10
      end do
   end function count_length

   !> Digits of the exponent of a number in a table
   pure integer function exponent_width(value)
      !> Number
      real(wp), intent(in) :: value

      exponent_width = 2
      if (.not. is_short(value)) exponent_width = merge(3, 4, precision(value) < 18)
   end function exponent_width

   !> Length of a number in a table
   pure integer function table_length(value)
      !> Number
      real(wp), intent(in) :: value

      ! A figure, the point, the decimals, E and its sign, the exponent
      table_length = 1 + 1 + decimals + 2 + exponent_width(value)
      if (abs(value) > huge(value)) table_length = len('Infinity')
      if (sign(1.0_wp, value) < 0.0_wp) table_length = table_length + 1
      if (.not. abs(value) >= 0.0_wp) table_length = len('NaN')
   end function table_length

   !> Length of the first word of a text
   pure integer function word_length(text, separators)
      !> Text, and characters that separate words
      character(len=*), intent(in) :: text, separators

      integer :: first

      word_length = 0
      first = verify(text, separators)
      if (first > 0) word_length = scan(text(first:)//separators(1:1), separators) - 1
   end function word_length

   !> A decimal that reads back as the same number: of as few decimals as it has, else the nearest of 15, 16 or 17 digits
   pure function real_to_text(value) result(text)
      !> Number
      real(wp), intent(in) :: value
      !> Its text
      character(len=real_length(value)) :: text

      character(len=:), allocatable :: shortest

      call make_real(value, shortest)
      text = shortest
   end function real_to_text

   !> A number with four significant digits, for people
   pure function rounded(value) result(text)
      !> Number
      real(wp), intent(in) :: value
      !> Its text
      character(len=real_length(rounded_to(value, result_digits))) :: text

      text = real_to_text(rounded_to(value, result_digits))
   end function rounded

   !> A number with eight significant digits, for limits that were computed
   pure function brief(value) result(text)
      !> Number
      real(wp), intent(in) :: value
      !> Its text
      character(len=real_length(rounded_to(value, limit_digits))) :: text

      text = real_to_text(rounded_to(value, limit_digits))
   end function brief

   !> Write a number as real_to_text has it
   pure subroutine make_real(value, text)
      !> Number
      real(wp), intent(in) :: value
      !> Its text
      character(len=:), allocatable, intent(out) :: text

      character(len=48) :: figures
      integer :: exponent

      if (.not. abs(value) <= huge(value)) then
         text = 'NaN'
         if (value > 0.0_wp) text = 'Infinity'
         if (value < 0.0_wp) text = '-Infinity'
         return
      end if
      call make_short(value, text)
      if (allocated(text)) return
      call make_shortest(value, figures, exponent)
      call make_plain(sign(1.0_wp, value) < 0.0_wp, trim(figures), exponent, text)
   end subroutine make_real

   !> The text of a number of few decimals, as most are, without a WRITE: a whole number by a power of ten, both exact
   pure subroutine make_short(value, text)
      !> Number
      real(wp), intent(in) :: value
      !> Its text; not allocated: it is longer
      character(len=:), allocatable, intent(out) :: text

      integer, parameter :: most_decimals = 6
      real(wp), parameter :: smallest = 1.0e-4_wp, largest = 1.0e15_wp
      real(wp) :: power
      integer(int64) :: whole
      integer :: decimals, missing

      if (.not. (abs(value) >= smallest .and. abs(value) < largest)) return
      power = 1.0_wp
      do decimals = 0, most_decimals
         if (.not. abs(value)*power < largest) return
         whole = nint(abs(value)*power, int64)
         if (real(whole, wp)/power == abs(value)) exit
         power = 10.0_wp*power
      end do
      if (decimals > most_decimals) return
      text = count_to_text(whole)
      missing = decimals + 1 - len(text)
      if (missing > 0) text = repeat('0', missing)//text
      if (decimals > 0) text = text(:len(text) - decimals)//'.'//text(len(text) - decimals + 1:)
      if (value < 0.0_wp) text = '-'//text
   end subroutine make_short

   !> Write digits as a plain decimal where that is short, else with an exponent
   pure subroutine make_plain(is_negative, figures, exponent, text)
      !> Has the number a sign?
      logical, intent(in) :: is_negative
      !> Its significant digits
      character(len=*), intent(in) :: figures
      !> Power of ten of the first of them
      integer, intent(in) :: exponent
      !> Its text
      character(len=:), allocatable, intent(out) :: text

      character(len=:), allocatable :: digits
      integer :: point

      digits = figures(:max(1, verify(figures, '0', back=.true.)))
      text = ''
      if (is_negative) text = '-'
      if (exponent < -4 .or. exponent > 15) then
         text = text//digits(1:1)
         if (len(digits) > 1) text = text//'.'//digits(2:)
         text = text//'e'//integer_to_text(exponent)
         return
      end if
      if (exponent < 0) digits = repeat('0', -exponent)//digits
      point = max(exponent, 0) + 1
      if (len(digits) < point) digits = digits//repeat('0', point - len(digits))
      text = text//digits(:point)
      if (len(digits) > point) text = text//'.'//digits(point + 1:)
   end subroutine make_plain

   !> An integer without blanks
   pure function integer_to_text(value) result(text)
      !> Number
      integer, intent(in) :: value
      !> Its text
      character(len=count_length(int(value, int64))) :: text

      text = count_to_text(int(value, int64))
   end function integer_to_text

   !> A large count without blanks
   pure function count_to_text(value) result(text)
      !> Count
      integer(int64), intent(in) :: value
      !> Its text
      character(len=count_length(value)) :: text

      character(len=*), parameter :: figures = '0123456789'
      integer(int64) :: left
      integer :: i, figure

      ! Digit by digit: tables have many integers, and a WRITE of each takes longer than the rest of a row.
      left = value
      do i = len(text), merge(2, 1, value < 0), -1
         figure = int(abs(mod(left, 10_int64))) + 1
         text(i:i) = figures(figure:figure)
         left = left/10
      end do
      if (value < 0) text(1:1) = '-'
   end function count_to_text

   !> A count of things: 1 thread, 2 threads
   pure function counted(number, thing) result(text)
      !> Count
      integer, intent(in) :: number
      !> One of the things; it takes an s where there are more, or none
      character(len=*), intent(in) :: thing
      !> Both
      character(len=count_length(int(number, int64)) + 1 + len(thing) + merge(0, 1, number == 1)) :: text

      text = integer_to_text(number)//' '//thing//'s'
   end function counted

   !> A number as it stands in result tables: as many significant digits as read back exactly, 17 for real64
   pure function to_table(value) result(text)
      !> Number
      real(wp), intent(in) :: value
      !> Its text, e.g. 1.2500000000000000E+00 (more exponent digits only where needed)
      character(len=table_length(value)) :: text

      character(len=decimals + 1) :: figures
      character(len=4) :: power
      integer :: exponent, width

      if (.not. abs(value) <= huge(value)) then
         text = real_to_text(value)
         return
      end if
      call make_figures(value, figures, exponent)
      width = exponent_width(value)
      call put_digits(int(abs(exponent), int64), power(:width))
      text = figures(1:1)//'.'//figures(2:)//merge('E-', 'E+', exponent < 0)//power(:width)
      if (sign(1.0_wp, value) < 0.0_wp) text = '-'//text
   end function to_table

   !> Lower case
   pure function lower(text) result(lowered)
      !> Any text
      character(len=*), intent(in) :: text
      !> The same with A-Z in lower case
      character(len=len(text)) :: lowered

      integer :: i

      lowered = text
      do i = 1, len(text)
         if (text(i:i) >= 'A' .and. text(i:i) <= 'Z') lowered(i:i) = achar(iachar(text(i:i)) + 32)
      end do
   end function lower

   !> Words in quotes, separated by commas: 'a', 'b', 'c'
   pure function join(words) result(text)
      !> Words
      character(len=*), intent(in) :: words(:)
      !> The list, for messages that say what is allowed
      character(len=max(0, sum(len_trim(words)) + 4*size(words) - 2)) :: text

      integer :: i, length

      length = 0
      do i = 1, size(words)
         if (i > 1) text(length - 1:length) = ', '
         text(length + 1:) = ''''//trim(words(i))//''''
         length = length + len_trim(words(i)) + 4
      end do
   end function join

   !> First word of a text
   pure function first_word(text, separators) result(word)
      !> Text
      character(len=*), intent(in) :: text
      !> Characters that separate words
      character(len=*), intent(in) :: separators
      !> The word, empty if there is none
      character(len=word_length(text, separators)) :: word

      integer :: first

      first = max(verify(text, separators), 1)
      word = text(first:first + len(word) - 1)
   end function first_word

   !> A text without the blanks and tabs around it
   pure function stripped(text)
      !> Text
      character(len=*), intent(in) :: text
      !> The same without blanks around
      character(len=verify(text, blanks, back=.true.) - max(verify(text, blanks), 1) + 1) :: stripped

      stripped = text(max(verify(text, blanks), 1):)
   end function stripped

   !> How often a character stands in a text
   pure integer function occurrences(text, character)
      !> Text
      character(len=*), intent(in) :: text
      !> Character
      character(len=1), intent(in) :: character

      integer :: i

      occurrences = 0
      do i = 1, len(text)
         if (text(i:i) == character) occurrences = occurrences + 1
      end do
   end function occurrences

   !> Replace each occurrence of a part by one that is not longer and does not contain the part
   pure function replaced(text, part, by)
      !> Text
      character(len=*), intent(in) :: text
      !> Part to look for, and what to put in its place
      character(len=*), intent(in) :: part, by
      !> The text, filled up with blanks
      character(len=len(text)) :: replaced

      integer :: at

      replaced = text
      do
         at = index(trim(replaced), part)
         if (at == 0) exit
         replaced = replaced(:at - 1)//by//replaced(at + len(part):)
      end do
   end function replaced

   !> A text at the left of a column
   pure function left(text, width)
      !> Text
      character(len=*), intent(in) :: text
      !> Width
      integer, intent(in) :: width
      !> The text and blanks, or its beginning
      character(len=width) :: left

      left = text
   end function left

   !> A text at the right of a column
   pure function right(text, width)
      !> Text
      character(len=*), intent(in) :: text
      !> Width
      integer, intent(in) :: width
      !> Blanks and the text
      character(len=width) :: right

      right = repeat(' ', max(0, width - len(text)))//text
   end function right

end module dondolo_base_text
