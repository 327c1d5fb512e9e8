!> Words above plain columns without case and accents, so that `Unità`, `UNITE` and `unité` are known by one spelling each.
module dondolo_records_column_letters
   use dondolo_base_text, only : lower
   implicit none
   private

   public :: folded, has_word, has_factor, letters, digits

   character(len=*), parameter :: letters = 'abcdefghijklmnopqrstuvwxyz', digits = '0123456789'

   !> Letters for those of U+00C0 to U+017F in UTF-8; of U+00D7 and U+00F7, the marks of products and quotients, too
   character(len=*), parameter :: latin = &
      & 'aaaaaaaceeeeiiiidnoooooxouuuuytsaaaaaaaceeeeiiiidnooooo/ouuuuyty'// &
      & 'aaaaaaccccccccddddeeeeeeeeeegggggggghhhhiiiiiiiiiiiijjkkklllllll'// &
      & 'lllnnnnnnnnnoooooooorrrrrrssssssssttttttuuuuuuuuuuuuwwyyyzzzzzzs'

contains

   !> A text in lower case without accents
   pure function folded(text) result(plain)
      !> In UTF-8
      character(len=*), intent(in) :: text
      !> Filled up with blanks
      character(len=len(text)) :: plain

      character(len=2) :: letter
      integer :: at, length, code, next

      plain = ''
      length = 0
      at = 0
      do while (at < len(text))
         at = at + 1
         letter = text(at:at)
         code = iachar(text(at:at))
         if (code >= 128 .and. at < len(text)) then
            next = iachar(text(at + 1:at + 1))
            letter = ''
            select case (code)
            case (195:197)
               letter = latin(1 + (code - 195)*64 + iand(next, 63):1 + (code - 195)*64 + iand(next, 63))
               ! The German sharp s
               if (code == 195 .and. next == 159) letter = 'ss'
            case (194)
               if (next == 178 .or. next == 179) letter = achar(next - 128)
               if (next == 181) letter = 'u'
            case (206)
               if (next == 148) letter = 'd'
               if (next == 188) letter = 'u'
            case (226)
               ! Apostrophe, minus
               if (index(text(at:), achar(226)//achar(128)//achar(153)) == 1) letter = ''''
               if (index(text(at:), achar(226)//achar(136)//achar(146)) == 1) letter = '-'
               at = at + 1
            case default
               at = at - 1
            end select
            at = at + 1
            ! An accent of its own, after its letter
            if (code == 204) at = at + 1
            if (code == 204) cycle
         end if
         length = length + max(1, len_trim(letter))
         plain(length - max(1, len_trim(letter)) + 1:length) = letter
      end do
      plain = lower(plain)
   end function folded

   !> Is one of some words in a text?
   pure function has_word(text, words)
      !> Text
      character(len=*), intent(in) :: text
      !> The words, in lower case without accents
      character(len=*), intent(in) :: words(:)
      !> One of them stands there, between characters that are no letters
      logical :: has_word

      character(len=:), allocatable :: rest
      integer :: first, last

      has_word = .true.
      rest = folded(text)//' '
      do
         first = scan(rest, letters)
         if (first == 0) exit
         last = first - 2 + verify(rest(first:), letters)
         if (any(words == rest(first:last))) return
         rest = rest(last + 1:)
      end do
      has_word = .false.
   end function has_word

   !> Is there a product, a quotient or a percentage of a number: `*100`, `x 0.01`, `/ 9.81`, `100 x`? The powers of m/s**2 and
   !> the name of the component X1 are none
   pure logical function has_factor(text)
      character(len=*), intent(in) :: text

      character(len=len(text) + 2) :: plain
      integer :: at, first, last, before, after

      plain = ' '//folded(text)
      at = 1
      do
         has_factor = .false.
         first = at - 1 + scan(plain(at:), digits)
         if (first < at) return
         last = first - 2 + verify(plain(first:), digits//'.,')
         at = last + 1
         before = max(1, verify(plain(:first - 1), ' .+-', back=.true.))
         after = last + max(1, verify(plain(last + 1:), ' '))
         has_factor = plain(after:after) == '*' .or. plain(after:after) == '%' .or. (is_times(after) .and. before < first - 1)
         if (.not. has_factor) then
            select case (plain(before:before))
            case ('*')
               has_factor = plain(before - 1:before - 1) /= '*'
            case ('/')
               has_factor = .true.
            case ('x')
               has_factor = is_times(before) .and. (before < first - 1 .or. last > first)
            end select
         end if
         if (has_factor) return
      end do

   contains

      !> Is a character an x alone?
      pure logical function is_times(place)
         integer, intent(in) :: place

         is_times = plain(place:place) == 'x'
         if (is_times .and. place > 1) is_times = scan(plain(place - 1:place - 1), letters) == 0
         if (is_times) is_times = scan(plain(place + 1:place + 1), letters) == 0
      end function is_times

   end function has_factor

end module dondolo_records_column_letters
