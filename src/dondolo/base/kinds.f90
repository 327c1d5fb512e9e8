!> Kinds of real numbers.
!>
!> `wp` is the working precision of the rooms record, wall and motion; changing this one constant to
!> `real128` turns them into their own reference. `dp` is what LAPACK and the statistics work in.
module dondolo_kinds
   use, intrinsic :: iso_fortran_env, only : real64
   implicit none
   private

   public :: wp, dp

   !> Working precision of the physics
   integer, parameter :: wp = real64

   !> Precision of LAPACK and of the statistics
   integer, parameter :: dp = real64

end module dondolo_kinds
