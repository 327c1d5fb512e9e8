!> Text that is safe on a terminal and in a table: one line of UTF-8 without characters that nobody sees but that steer
!> what is shown.
module dondolo_base_plain
   use dondolo_base_encoding, only : next_character
   use dondolo_base_limits, only : longest_name
   use dondolo_base_text, only : to_text
   implicit none
   private

   public :: is_plain, name_problem, visible, shown, blanked

   !> Message on a name that is not plain
   character(len=*), parameter :: must_be_plain = 'must be one line without control characters and marks of '// &
      & 'direction'

   !> Bytes of a text that a message shows at most
   integer, parameter :: longest_shown = 60

contains

   !> Does a character steer what is shown?
   !>
   !> Control characters (C0, DEL, C1), separators of lines and paragraphs, and marks, embeddings, overrides and isolates of
   !> the bidirectional algorithm (Unicode Standard Annex 9), with which a name could look like another; and the two
   !> codes that no XML may have, and so no document of Word, workbook or fragility model.
   pure logical function is_steering(code)
      !> Code point; -1 for a byte that is not UTF-8
      integer, intent(in) :: code

      select case (code)
      case (:31, 127:159, int(z'061c'), int(z'200e'):int(z'200f'), int(z'2028'):int(z'202e'), int(z'2066'):int(z'2069'), &
         & int(z'fffe'):int(z'ffff'))
         is_steering = .true.
      case default
         is_steering = .false.
      end select
   end function is_steering

   !> Is a text one line of UTF-8 without characters that steer what is shown?
   pure logical function is_plain(text)
      !> Any bytes
      character(len=*), intent(in) :: text

      integer :: at, next, code

      is_plain = .false.
      at = 1
      do while (at <= len(text))
         call next_character(text, at, next, code)
         if (is_steering(code)) return
         at = next
      end do
      is_plain = .true.
   end function is_plain

   !> What a name, a title or another word of the user's must be and is not; blank if nothing is wrong with it
   pure function name_problem(text)
      !> Any bytes
      character(len=*), intent(in) :: text
      !> Message, blank if nothing is wrong
      character(len=len(must_be_plain)) :: name_problem

      name_problem = ''
      if (len(text) > longest_name) then
         name_problem = 'must have at most '//to_text(longest_name)//' bytes'
      else if (.not. is_plain(text)) then
         name_problem = must_be_plain
      end if
   end function name_problem

   !> Length of a text with its escapes
   pure integer function visible_length(text) result(length)
      !> Any bytes
      character(len=*), intent(in) :: text

      integer :: at, next, code

      length = 0
      at = 1
      do while (at <= len(text))
         call next_character(text, at, next, code)
         length = length + next - at
         if (is_steering(code)) length = length - (next - at) + len_trim(escape(code, text(at:at)))
         at = next
      end do
   end function visible_length

   !> A text in which what is not plain can be seen: \n, \x1b, \u202e; a text that is plain stays as it is
   pure function visible(text)
      !> Any bytes
      character(len=*), intent(in) :: text
      !> One line of UTF-8
      character(len=visible_length(text)) :: visible

      integer :: at, next, code, length

      if (len(visible) == len(text)) then
         visible = text
         return
      end if
      length = 0
      at = 1
      do while (at <= len(text))
         call next_character(text, at, next, code)
         if (is_steering(code)) then
            associate (sign => escape(code, text(at:at)))
               visible(length + 1:length + len_trim(sign)) = sign
               length = length + len_trim(sign)
            end associate
         else
            visible(length + 1:length + next - at) = text(at:next - 1)
            length = length + next - at
         end if
         at = next
      end do
   end function visible

   !> A text with blanks in place of what is not plain, but for tabs: what files say of themselves, in which nobody wants it
   pure function blanked(text)
      !> Any bytes
      character(len=*), intent(in) :: text
      !> As many
      character(len=len(text)) :: blanked

      integer :: at, next, code

      blanked = text
      at = 1
      do while (at <= len(text))
         call next_character(text, at, next, code)
         if (is_steering(code) .and. code /= 9) blanked(at:next - 1) = ''
         at = next
      end do
   end function blanked

   !> How a character that steers is shown
   pure function escape(code, byte)
      !> Code point; -1 for a byte that is not UTF-8
      integer, intent(in) :: code
      !> That byte
      character(len=1), intent(in) :: byte
      !> Its sign, blanks after it
      character(len=6) :: escape

      character(len=*), parameter :: figures = '0123456789abcdef'
      integer :: value, i

      select case (code)
      case (9)
         escape = '\t'
      case (10)
         escape = '\n'
      case (13)
         escape = '\r'
      case (256:)
         escape = '\u0000'
      case default
         escape = '\x00'
      end select
      if (any(code == [9, 10, 13])) return
      value = code
      if (code < 0) value = iachar(byte)
      do i = len_trim(escape), 3, -1
         escape(i:i) = figures(modulo(value, 16) + 1:modulo(value, 16) + 1)
         value = value/16
      end do
   end function escape

   !> Bytes of the beginning of a text that messages show
   pure integer function shown_length(text) result(length)
      !> Text, of any length
      character(len=*), intent(in) :: text

      length = len(text)
      if (length <= longest_shown) return
      length = longest_shown
      ! Not in the middle of a character
      do while (length > longest_shown - 4 .and. iachar(text(length + 1:length + 1)) >= 128 .and. &
         & iachar(text(length + 1:length + 1)) < 192)
         length = length - 1
      end do
   end function shown_length

   !> A text as messages show it: its beginning, where it is long
   pure function shown(text)
      !> Text, of any length
      character(len=*), intent(in) :: text
      !> Its first characters
      character(len=shown_length(text) + merge(3, 0, len(text) > longest_shown)) :: shown

      shown = text(:shown_length(text))//'...'
   end function shown

end module dondolo_base_plain
