!> The bracket of a root: two ends between which a function changes its sign. Halving it until no number lies between the ends
!> gives the root to the last bit, of any function:
!>
!>     do while (bracket%is_divisible())
!>        call bracket%halve(function(bracket%middle()) > 0.0_wp)      of a function that is positive below its root
!>     end do
!>     root = bracket%middle()
module dondolo_base_bracket
   use dondolo_base_invariant, only : assert, checked, lies_between
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: bracket_type

   !> Two ends with a root between them; the first may be the greater one
   type :: bracket_type
      real(wp) :: first = 0.0_wp, last = 0.0_wp
   contains
      !> The place half way between its ends
      procedure :: middle
      !> Whether a number lies between its ends
      procedure :: is_divisible
      !> Keep the half that has the root
      procedure :: halve
      !> Replace one of its ends by a place within it
      procedure :: narrow
   end type bracket_type

contains

   !> The place half way between the ends
   elemental real(wp) function middle(self)
      class(bracket_type), intent(in) :: self

      middle = 0.5_wp*(self%first + self%last)
   end function middle

   !> Whether a number lies between the ends
   elemental logical function is_divisible(self)
      class(bracket_type), intent(in) :: self

      is_divisible = .not. (self%middle() == self%first .or. self%middle() == self%last)
   end function is_divisible

   !> Keep the half that has the root
   elemental subroutine halve(self, is_later)
      class(bracket_type), intent(inout) :: self
      !> Is the root between the middle and the last end?
      logical, intent(in) :: is_later

      call self%narrow(self%middle(), is_later)
   end subroutine halve

   !> Replace one of the ends by a place within the bracket
   elemental subroutine narrow(self, place, is_later)
      class(bracket_type), intent(inout) :: self
      !> The place
      real(wp), intent(in) :: place
      !> Is the root between it and the last end?
      logical, intent(in) :: is_later

      if (checked) call assert(lies_between(place, self%first, self%last), 'a place in a bracket lies between its ends')
      if (is_later) then
         self%first = place
      else
         self%last = place
      end if
   end subroutine narrow

end module dondolo_base_bracket
