!> Characters of print that look like a space, a sign or nothing, and that word processors and web pages put in their place:
!> messages name them, since they are invisible.
module dondolo_base_odd_character
   use dondolo_base_encoding, only : next_character
   implicit none
   private

   public :: odd_character, odd_length

   !> Length of a name
   integer, parameter :: odd_length = 48

contains

   !> The first such character of a text, by its name and code point; blank: there is none
   pure function odd_character(text) result(name)
      !> Any bytes
      character(len=*), intent(in) :: text
      !> Such as 'a no-break space (U+00A0)', blanks after it
      character(len=odd_length) :: name

      character(len=4) :: figures
      integer :: at, next, code

      name = ''
      at = 1
      do while (at <= len(text))
         call next_character(text, at, next, code)
         at = next
         if (code < 128) cycle
         name = kind_of(code)
         if (len_trim(name) == 0) cycle
         write (figures, '(z4.4)') code
         name = trim(name)//' (U+'//figures//')'
         return
      end do
   end function odd_character

   !> What a character is, blank for one that is like others
   pure function kind_of(code) result(name)
      !> Code point
      integer, intent(in) :: code
      character(len=odd_length) :: name

      select case (code)
      case (int(z'00a0'), int(z'202f'))
         name = 'a no-break space'
      case (int(z'2000'):int(z'200a'), int(z'205f'), int(z'3000'))
         name = 'a space that is not an ordinary one'
      case (int(z'200b'):int(z'200d'), int(z'2060'), int(z'feff'), int(z'00ad'))
         name = 'an invisible character'
      case (int(z'2010'):int(z'2015'), int(z'2212'))
         name = 'a dash that is not an ordinary -'
      case (int(z'ff0c'), int(z'201a'), int(z'060c'))
         name = 'a comma that is not an ordinary one'
      case default
         name = ''
      end select
   end function kind_of

end module dondolo_base_odd_character
