!> A mechanism that counts how often its terms are evaluated: the work of a history, the same on every machine.
module counting_mechanism
   use, intrinsic :: iso_c_binding, only : c_long
   use dondolo_base_kinds, only : wp
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: counting_type, new_counting
   public :: evaluations

   !> Evaluations so far; for one thread
   integer(c_long) :: evaluations = 0

   !> A mechanism under another name, counted
   type, extends(mechanism_type) :: counting_type
      class(mechanism_type), allocatable :: counted
   contains
      procedure :: terms
      procedure :: potential
      procedure :: geometric_end
      procedure :: support
   end type counting_type

   ! The motion is pure, a counter is not. The interface says what does no harm here.
   interface
      pure subroutine count_evaluation(total) bind(c, name='dondolo_test_count_evaluation')
         import :: c_long
         integer(c_long), intent(out) :: total
      end subroutine count_evaluation
   end interface

contains

   !> Count the evaluations of a mechanism
   function new_counting(mechanism) result(counting)
      class(mechanism_type), intent(in) :: mechanism
      type(counting_type) :: counting

      counting%two_sided = mechanism%two_sided
      counting%capacity = mechanism%capacity
      counting%restitution = mechanism%restitution
      counting%lowest = mechanism%lowest
      counting%highest = mechanism%highest
      counting%counted = mechanism
   end function new_counting

   pure subroutine terms(self, q, j, c, g, l, load)
      class(counting_type), intent(in) :: self
      real(wp), intent(in) :: q
      real(wp), intent(out) :: j, c, g, l, load
      integer(c_long) :: total

      call self%counted%terms(q, j, c, g, l, load)
      call count_evaluation(total)
   end subroutine terms

   pure function potential(self, q) result(v)
      class(counting_type), intent(in) :: self
      real(wp), intent(in) :: q
      real(wp) :: v

      v = self%counted%potential(q)
   end function potential

   pure function geometric_end(self) result(q)
      class(counting_type), intent(in) :: self
      real(wp) :: q

      q = self%counted%geometric_end()
   end function geometric_end

   pure subroutine support(self, share, tilt)
      class(counting_type), intent(in) :: self
      real(wp), intent(out) :: share, tilt

      call self%counted%support(share, tilt)
   end subroutine support

end module counting_mechanism

!> One evaluation more
subroutine count_evaluation(total) bind(c, name='dondolo_test_count_evaluation')
   use, intrinsic :: iso_c_binding, only : c_long
   use counting_mechanism, only : evaluations
   implicit none
   integer(c_long), intent(out) :: total

   evaluations = evaluations + 1
   total = evaluations
end subroutine count_evaluation
