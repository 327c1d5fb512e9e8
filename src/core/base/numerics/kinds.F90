!> Kinds of real numbers, and pi.
!>
!> `wp` is the working precision of everything. Compiled with -DDONDOLO_REAL128 the same sources are their own
!> reference, with 33 digits. `dp` is what LAPACK works in.
module dondolo_base_kinds
   use, intrinsic :: iso_fortran_env, only : real64, real128
   implicit none
   private

   public :: wp, dp, pi

   !> Working precision
#ifdef DONDOLO_REAL128
   integer, parameter :: wp = real128
#else
   integer, parameter :: wp = real64
#endif

   !> Precision of LAPACK
   integer, parameter :: dp = real64

   real(wp), parameter :: pi = acos(-1.0_wp)

end module dondolo_base_kinds
