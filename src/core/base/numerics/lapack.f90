!> Symmetric positive definite systems by LAPACK, which works in double precision whatever `wp` is.
module dondolo_base_lapack
   use dondolo_base_kinds, only : dp, wp
   implicit none
   private

   public :: solve_symmetric, invert_symmetric, lapack_version

   interface

      !> Version of LAPACK
      pure subroutine ilaver(major, minor, patch)
         integer, intent(out) :: major, minor, patch
      end subroutine ilaver

      !> Cholesky factorisation of a symmetric positive definite matrix
      pure subroutine dpotrf(uplo, n, a, lda, info)
         import :: dp
         !> 'U': the upper triangle is given
         character(len=1), intent(in) :: uplo
         !> Order
         integer, intent(in) :: n
         !> Leading dimension
         integer, intent(in) :: lda
         !> In: the matrix; out: its factor
         real(dp), intent(inout) :: a(lda, *)
         !> 0: done; > 0: not positive definite
         integer, intent(out) :: info
      end subroutine dpotrf

      !> Solution of linear equations from the Cholesky factor
      pure subroutine dpotrs(uplo, n, nrhs, a, lda, b, ldb, info)
         import :: dp
         !> 'U': the upper triangle is given
         character(len=1), intent(in) :: uplo
         !> Order
         integer, intent(in) :: n
         !> Number of right-hand sides
         integer, intent(in) :: nrhs
         !> Leading dimensions
         integer, intent(in) :: lda, ldb
         !> The factor
         real(dp), intent(in) :: a(lda, *)
         !> In: right-hand sides; out: solutions
         real(dp), intent(inout) :: b(ldb, *)
         !> 0: done
         integer, intent(out) :: info
      end subroutine dpotrs

   end interface

contains

   !> Version of LAPACK, as '3.11.0', filled up with blanks
   function lapack_version() result(version)
      character(len=32) :: version

      integer :: major, minor, patch

      call ilaver(major, minor, patch)
      write (version, '(i0, 2(".", i0))') major, minor, patch
   end function lapack_version

   !> Solve A x = b
   pure subroutine solve_symmetric(matrix, vector, solution, ok)
      !> A, symmetric
      real(wp), intent(in) :: matrix(:, :)
      !> b
      real(wp), intent(in) :: vector(:)
      !> x
      real(wp), intent(out) :: solution(:)
      !> False: the matrix is not positive definite
      logical, intent(out) :: ok

      real(dp) :: factor(size(vector), size(vector)), x(size(vector), 1)
      integer :: n, info

      n = size(vector)
      factor = real(matrix, dp)
      x(:, 1) = real(vector, dp)
      call dpotrf('U', n, factor, n, info)
      ok = info == 0
      if (ok) call dpotrs('U', n, 1, factor, n, x, n, info)
      solution = real(x(:, 1), wp)
   end subroutine solve_symmetric

   !> Inverse of a matrix
   pure subroutine invert_symmetric(matrix, inverse, ok)
      !> The matrix, symmetric
      real(wp), intent(in) :: matrix(:, :)
      !> Its inverse
      real(wp), intent(out) :: inverse(:, :)
      !> False: the matrix is not positive definite
      logical, intent(out) :: ok

      real(dp) :: factor(size(matrix, 1), size(matrix, 1)), columns(size(matrix, 1), size(matrix, 1))
      integer :: i, n, info

      n = size(matrix, 1)
      factor = real(matrix, dp)
      columns = 0.0_dp
      do i = 1, n
         columns(i, i) = 1.0_dp
      end do
      call dpotrf('U', n, factor, n, info)
      ok = info == 0
      if (ok) call dpotrs('U', n, n, factor, n, columns, n, info)
      inverse = real(columns, wp)
   end subroutine invert_symmetric

end module dondolo_base_lapack
