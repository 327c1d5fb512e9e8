!> Explicit interfaces of the LAPACK routines in use; always double precision.
module dondolo_lapack
   use dondolo_kinds, only : dp
   implicit none
   private

   public :: dpotrf, dpotri, dpotrs

   interface

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

      !> Inverse from the Cholesky factor
      pure subroutine dpotri(uplo, n, a, lda, info)
         import :: dp
         !> 'U': the upper triangle is given
         character(len=1), intent(in) :: uplo
         !> Order
         integer, intent(in) :: n
         !> Leading dimension
         integer, intent(in) :: lda
         !> In: the factor; out: the upper triangle of the inverse
         real(dp), intent(inout) :: a(lda, *)
         !> 0: done
         integer, intent(out) :: info
      end subroutine dpotri

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

end module dondolo_lapack
