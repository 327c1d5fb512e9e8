!> Bytes of files as text: UTF-8, UTF-16 that begins with a byte order mark, and what to say of all else.
module dondolo_base_encoding
   implicit none
   private

   public :: is_ascii, is_utf8, encoding_problem, next_character, utf16_order, from_utf16, from_latin
   public :: mend_line_ends
   public :: byte_order_mark

   !> Byte order mark that some programs put before UTF-8 text
   character(len=*), parameter :: byte_order_mark = achar(239)//achar(187)//achar(191)

   !> The same before UTF-16
   character(len=*), parameter :: little_endian = achar(255)//achar(254), big_endian = achar(254)//achar(255)

   !> Characters that no text has: NUL and other controls; tabs, line ends, form feeds and the end of a file under DOS left aside
   character(len=*), parameter :: controls = achar(0)//achar(1)//achar(2)//achar(3)//achar(4)//achar(5)//achar(6)//achar(7)// &
      & achar(8)//achar(14)//achar(15)//achar(16)//achar(17)//achar(18)//achar(19)//achar(20)//achar(21)//achar(22)//achar(23)// &
      & achar(24)//achar(25)

   !> U+FFFD, which stands for what is no character
   integer, parameter :: replacement = int(z'fffd')

contains

   !> Has a text bytes of ASCII only, and no NUL?
   pure logical function is_ascii(text)
      !> Bytes
      character(len=*), intent(in) :: text

      integer :: lowest, highest, i

      ! Without an exit, so that the loop becomes vector instructions
      lowest = 1
      highest = 1
      do i = 1, len(text)
         lowest = min(lowest, iachar(text(i:i)))
         highest = max(highest, iachar(text(i:i)))
      end do
      is_ascii = lowest > 0 .and. highest < 128
   end function is_ascii

   !> Is a text UTF-8, without NUL?
   pure logical function is_utf8(text)
      !> Bytes
      character(len=*), intent(in) :: text

      is_utf8 = is_ascii(text)
      if (.not. is_utf8) is_utf8 = first_wrong(text) == 0
   end function is_utf8

   !> Position of the first byte that is not UTF-8, or NUL; 0 if there is none
   pure integer function first_wrong(text) result(at)
      !> Bytes
      character(len=*), intent(in) :: text

      integer :: next, code

      at = 1
      do while (at <= len(text))
         call next_character(text, at, next, code)
         if (code <= 0) return
         at = next
      end do
      at = 0
   end function first_wrong

   !> The character at a place of UTF-8 (RFC 3629: no overlong forms, no surrogates, nothing beyond U+10FFFF)
   pure subroutine next_character(text, at, next, code)
      !> Bytes
      character(len=*), intent(in) :: text
      !> Position of its first byte
      integer, intent(in) :: at
      !> Position after its last byte
      integer, intent(out) :: next
      !> Its code point; -1 for a byte that begins no character
      integer, intent(out) :: code

      integer :: byte, follow, lowest, highest, first, i

      first = iachar(text(at:at))
      next = at + 1
      code = first
      if (first < 128) return
      code = -1
      ! The range of the second byte depends on the first
      lowest = 128
      highest = 191
      select case (first)
      case (194:223)
         follow = 1
      case (224:239)
         follow = 2
         if (first == 224) lowest = 160
         if (first == 237) highest = 159
      case (240:244)
         follow = 3
         if (first == 240) lowest = 144
         if (first == 244) highest = 143
      case default
         return
      end select
      if (at + follow > len(text)) return
      ! 5, 4 or 3 bits of the first byte, 6 of each that follows
      code = iand(first, 63/2**follow)
      do i = at + 1, at + follow
         byte = iachar(text(i:i))
         if (byte < lowest .or. byte > highest) then
            code = -1
            return
         end if
         code = 64*code + iand(byte, 63)
         lowest = 128
         highest = 191
      end do
      next = at + follow + 1
   end subroutine next_character

   !> What is wrong with a line that is not UTF-8, and what to do: half a sentence
   pure subroutine encoding_problem(line, problem)
      !> Bytes of the line
      character(len=*), intent(in) :: line
      !> 'byte 7 (E9) is not UTF-8 ...'
      character(len=:), allocatable, intent(out) :: problem

      character(len=*), parameter :: remedy = ': save it as UTF-8 (Excel: Save As, CSV UTF-8; Notepad: Save As, Encoding UTF-8)'
      character(len=32) :: place
      integer :: at

      at = max(first_wrong(line), 1)
      write (place, '(a, i0)') 'byte ', at
      if (line(at:at) == achar(0)) then
         problem = trim(place)//' is NUL: this is not a text file'
         if (is_wide(line)) problem = problem//', or it is UTF-16 without a byte order mark'//remedy
         return
      end if
      write (place, '(a, i0, a, z2.2, a)') 'byte ', at, ' (', iachar(line(at:at)), ')'
      problem = trim(place)//' is not UTF-8 (Windows-1252?)'//remedy
      if (scan(line, controls) > 0) problem = trim(place)//' is not UTF-8: this is not a text file'
   end subroutine encoding_problem

   !> Is a line UTF-16 in letters of ASCII? Every other byte is NUL, and the others are those of a text
   pure logical function is_wide(line)
      !> Bytes of the line
      character(len=*), intent(in) :: line

      integer :: first, i

      first = 1
      if (line(1:1) /= achar(0)) first = 2
      is_wide = len(line) > 1
      do i = 1, len(line)
         if (modulo(i - first, 2) == 0) then
            is_wide = is_wide .and. line(i:i) == achar(0)
         else
            is_wide = is_wide .and. scan(line(i:i), controls) == 0
         end if
      end do
   end function is_wide

   !> Byte order of a text that begins with the mark of UTF-16
   pure integer function utf16_order(text) result(order)
      !> First bytes of a file
      character(len=*), intent(in) :: text
      !> 1: the low byte comes first; 2: the high byte; 0: it is not UTF-16

      order = 0
      if (len(text) < 2) return
      if (text(1:2) == little_endian) order = 1
      if (text(1:2) == big_endian) order = 2
      ! UTF-32, which nobody writes, begins alike
      if (len(text) >= 4 .and. order == 1) order = merge(0, 1, text(3:4) == achar(0)//achar(0))
   end function utf16_order

   !> Make UTF-8 of UTF-16, without a byte order mark; a surrogate alone becomes U+FFFD
   pure subroutine from_utf16(bytes, order, text)
      !> UTF-16
      character(len=*), intent(in) :: bytes
      !> Byte order as of `utf16_order`
      integer, intent(in) :: order
      !> UTF-8; a character that is cut off is U+FFFD
      character(len=:), allocatable, intent(out) :: text

      integer :: at, length, code, low

      ! Two bytes become three at most
      allocate (character(len=3*(len(bytes)/2 + 1)) :: text)
      length = 0
      at = 1
      do while (at <= len(bytes) - 1)
         code = unit_at(at)
         at = at + 2
         if (code >= int(z'd800') .and. code <= int(z'dbff')) then
            low = 0
            if (at <= len(bytes) - 1) low = unit_at(at)
            if (low >= int(z'dc00') .and. low <= int(z'dfff')) then
               code = int(z'10000') + 1024*(code - int(z'd800')) + low - int(z'dc00')
               at = at + 2
            end if
         end if
         if (code >= int(z'd800') .and. code <= int(z'dfff')) code = replacement
         if (code /= int(z'feff')) call append_character(text, length, code)
      end do
      if (at == len(bytes)) call append_character(text, length, replacement)
      text = text(:length)

   contains

      !> A unit of 16 bits
      pure integer function unit_at(i)
         !> Position of its first byte
         integer, intent(in) :: i

         unit_at = iachar(bytes(i:i)) + 256*iachar(bytes(i + 1:i + 1))
         if (order == 2) unit_at = iachar(bytes(i + 1:i + 1)) + 256*iachar(bytes(i:i))
      end function unit_at

   end subroutine from_utf16

   !> Make UTF-8 of Latin-1; what only Windows-1252 has becomes U+FFFD
   pure subroutine from_latin(bytes, text)
      !> Latin-1
      character(len=*), intent(in) :: bytes
      !> UTF-8
      character(len=:), allocatable, intent(out) :: text

      integer :: i, length, code

      length = 0
      do i = 1, len(bytes)
         if (iachar(bytes(i:i)) >= 128) length = length + 2
      end do
      allocate (character(len=len(bytes) + length) :: text)
      length = 0
      do i = 1, len(bytes)
         code = iachar(bytes(i:i))
         if (code >= 128 .and. code < 160) code = replacement
         call append_character(text, length, code)
      end do
      text = text(:length)
   end subroutine from_latin

   !> Replace CR by LF where lines end in CR alone, as the first one shows
   pure subroutine mend_line_ends(text)
      character(len=*), intent(inout) :: text

      character(len=*), parameter :: line_feed = achar(10), return = achar(13)
      integer :: at, next, i

      at = scan(text, line_feed//return)
      if (at == 0) return
      next = verify(text(at:), return)
      if (next == 0) return
      if (text(at + next - 1:at + next - 1) == line_feed) return
      do i = 1, len(text)
         if (text(i:i) == return) text(i:i) = line_feed
      end do
   end subroutine mend_line_ends

   !> Append a character to a text that has room for it
   pure subroutine append_character(text, length, code)
      !> Text
      character(len=*), intent(inout) :: text
      !> Its length so far
      integer, intent(inout) :: length
      !> Code point
      integer, intent(in) :: code

      integer :: follow, i

      follow = count(code >= [int(z'80'), int(z'800'), int(z'10000')])
      length = length + 1
      if (follow == 0) then
         text(length:length) = achar(code)
         return
      end if
      ! As many ones as there are bytes, a zero, and the highest bits
      text(length:length) = achar(256 - 128/2**follow + code/64**follow)
      do i = follow - 1, 0, -1
         length = length + 1
         text(length:length) = achar(128 + iand(code/64**i, 63))
      end do
   end subroutine append_character

end module dondolo_base_encoding
