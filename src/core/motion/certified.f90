!> How sure the outcome of a history is: decided in double precision, in 33 digits, or by neither (docs/reading_a_curve.md).
module dondolo_motion_certified
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: certified_type, in_double, in_quadruple, not_computable, not_known, status_names

   !> How a history is certified: its estimated error is small; two runs in 33 digits agree; the last digit of the input
   !> decides
   integer, parameter :: in_double = 1, in_quadruple = 2, not_computable = 3
   character(len=14), parameter :: status_names(3) = [character(len=14) :: 'double', 'quadruple', 'not_computable']

   !> EDP within the rounding of a record of which it is not known how it is printed
   real(wp), parameter :: not_known = -1.0_wp

   !> How a history is certified
   type :: certified_type
      !> One of the above; 0: it was not run
      integer :: status = 0
      !> EDPs between which the last digit of the input decides; equal but for `not_computable`
      real(wp) :: lowest = 0.0_wp, highest = 0.0_wp
      !> EDP with every sample moved within the rounding of its last printed digit (dondolo_fragility_rounding), or `not_known`
      real(wp) :: rounded = not_known
   end type certified_type

end module dondolo_motion_certified
