!> Whether bytes are UTF-8 text.
module dondolo_encoding
   implicit none
   private

   public :: is_utf8, encoding_problem

   !> What is said of a text that is not UTF-8
   character(len=*), parameter :: other_bytes = 'is not UTF-8 (Windows-1252?)', other_text = 'is UTF-16, or no text'
   character(len=*), parameter :: remedy = ': save it as UTF-8 (in Excel: CSV UTF-8)'

contains

   !> Does a text look like UTF-16?
   pure logical function is_utf16(text)
      !> Bytes
      character(len=*), intent(in) :: text

      character(len=*), parameter :: little_endian = achar(255)//achar(254), big_endian = achar(254)//achar(255)

      is_utf16 = index(text, little_endian) == 1 .or. index(text, big_endian) == 1 .or. index(text, achar(0)) > 0
   end function is_utf16

   !> What is wrong with a text that is not UTF-8, and what to do, for messages
   pure function encoding_problem(text) result(problem)
      !> Bytes, such as a line
      character(len=*), intent(in) :: text
      !> Half a sentence
      character(len=merge(len(other_text), len(other_bytes), is_utf16(text)) + len(remedy)) :: problem

      problem = other_bytes//remedy
      if (is_utf16(text)) problem = other_text//remedy
   end function encoding_problem

   !> Is a text UTF-8, without NUL? (RFC 3629: no overlong forms, no surrogates, nothing beyond U+10FFFF)
   pure logical function is_utf8(text)
      !> Bytes
      character(len=*), intent(in) :: text

      integer :: i, k, byte, follow, lowest, highest

      is_utf8 = .false.
      i = 0
      do while (i < len(text))
         i = i + 1
         byte = iachar(text(i:i))
         if (byte > 0 .and. byte < 128) cycle
         ! The range of the second byte depends on the first
         lowest = 128
         highest = 191
         select case (byte)
         case (194:223)
            follow = 1
         case (224:239)
            follow = 2
            if (byte == 224) lowest = 160
            if (byte == 237) highest = 159
         case (240:244)
            follow = 3
            if (byte == 240) lowest = 144
            if (byte == 244) highest = 143
         case default
            return
         end select
         do k = 1, follow
            if (i == len(text)) return
            i = i + 1
            byte = iachar(text(i:i))
            if (byte < lowest .or. byte > highest) return
            lowest = 128
            highest = 191
         end do
      end do
      is_utf8 = .true.
   end function is_utf8

end module dondolo_encoding
