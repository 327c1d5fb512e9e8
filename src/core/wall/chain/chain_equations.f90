!> Small systems of linear equations in the working precision, with complete pivoting: LAPACK has no quadruple precision, and the
!> rows that a singular matrix leaves over are those of joints that depend on others.
module dondolo_wall_chain_equations
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: factor_type, factorise, nonnegative_least_squares

   !> A pivot below this part of the largest is none
   real(wp), parameter :: least_pivot = 1.0e-10_wp

   !> A factorised matrix
   type :: factor_type
      !> L and U
      real(wp), allocatable, private :: lu(:, :)
      !> Orders of rows and columns
      integer, allocatable :: row(:), column(:)
      !> Pivots before the first that is none
      integer :: rank = 0
      !> Sign of the determinant
      real(wp) :: sign = 1.0_wp
   contains
      !> Solve the equations
      procedure :: solve
   end type factor_type

contains

   !> Factorise a square matrix
   pure subroutine factorise(factor, matrix)
      type(factor_type), intent(out) :: factor
      !> The matrix
      real(wp), intent(in) :: matrix(:, :)

      real(wp) :: largest
      integer :: at(2), i, k, n

      n = size(matrix, 1)
      factor%lu = matrix
      factor%row = [(i, i=1, n)]
      factor%column = factor%row
      largest = 0.0_wp
      associate (a => factor%lu)
         do k = 1, n
            at = largest_place(a, k)
            if (at(1) /= k) then
               do i = 1, n
                  call swap(a(k, i), a(at(1), i))
               end do
               factor%row([k, at(1)]) = factor%row([at(1), k])
               factor%sign = -factor%sign
            end if
            if (at(2) /= k) then
               do i = 1, n
                  call swap(a(i, k), a(i, at(2)))
               end do
               factor%column([k, at(2)]) = factor%column([at(2), k])
               factor%sign = -factor%sign
            end if
            largest = max(largest, abs(a(k, k)))
            if (.not. abs(a(k, k)) > least_pivot*largest) return
            factor%rank = k
            factor%sign = sign(factor%sign, factor%sign*a(k, k))
            a(k + 1:, k) = a(k + 1:, k)/a(k, k)
            do i = k + 1, n
               a(k + 1:, i) = a(k + 1:, i) - a(k + 1:, k)*a(k, i)
            end do
         end do
      end associate
   end subroutine factorise

   !> Row and column of the largest element of what is left of a matrix
   pure function largest_place(a, first) result(at)
      real(wp), intent(in) :: a(:, :)
      !> First row and column that are left
      integer, intent(in) :: first
      integer :: at(2)

      real(wp) :: most
      integer :: i, k

      at = first
      most = -1.0_wp
      do k = first, size(a, 2)
         do i = first, size(a, 1)
            if (.not. abs(a(i, k)) > most) cycle
            most = abs(a(i, k))
            at = [i, k]
         end do
      end do
   end function largest_place

   !> Swap two numbers
   elemental subroutine swap(one, two)
      real(wp), intent(inout) :: one, two

      real(wp) :: kept

      kept = one
      one = two
      two = kept
   end subroutine swap

   !> Solve the equations of a matrix of full rank
   pure function solve(self, right) result(x)
      class(factor_type), intent(in) :: self
      !> Right-hand side
      real(wp), intent(in) :: right(:)
      !> Solution
      real(wp) :: x(size(right))

      real(wp) :: y(size(right))
      integer :: k

      y = right(self%row)
      do k = 1, size(y)
         y(k) = y(k) - dot_product(self%lu(k, :k - 1), y(:k - 1))
      end do
      do k = size(y), 1, -1
         y(k) = (y(k) - dot_product(self%lu(k, k + 1:), y(k + 1:)))/self%lu(k, k)
      end do
      x(self%column) = y
   end function solve

   !> Minimise |A x - b| over x >= 0 (Lawson and Hanson 1974, Solving least squares problems, chapter 23)
   pure subroutine nonnegative_least_squares(a, b, x)
      !> A and b
      real(wp), intent(in) :: a(:, :), b(:)
      !> x
      real(wp), intent(out) :: x(:)

      ! Gradients below this part of the largest there may be are rounding.
      real(wp), parameter :: rounding = 1.0e3_wp*epsilon(1.0_wp)
      real(wp) :: gradient(size(x)), trial(size(x)), part, scale
      logical :: is_free(size(x)), is_barred(size(x)), is_solved
      integer :: i, next

      x = 0.0_wp
      is_free = .false.
      is_barred = .false.
      scale = maxval(sqrt(sum(a**2, dim=1)))*norm2(b)
      do i = 1, 10*size(x)
         gradient = matmul(b - matmul(a, x), a)
         where (is_free .or. is_barred) gradient = 0.0_wp
         if (.not. maxval(gradient) > rounding*scale) return
         next = maxloc(gradient, dim=1)
         is_free(next) = .true.
         do
            call solve_free(a, b, is_free, trial, is_solved)
            if (.not. is_solved) then
               ! It depends on those that are free already.
               is_free(next) = .false.
               is_barred(next) = .true.
               exit
            end if
            if (.not. any(is_free .and. trial <= 0.0_wp)) then
               x = trial
               is_barred = .false.
               exit
            end if
            part = minval(x/(x - trial), mask=is_free .and. trial <= 0.0_wp)
            x = x + part*(trial - x)
            where (is_free .and. x <= rounding*maxval(abs(x))) is_free = .false.
            where (.not. is_free) x = 0.0_wp
         end do
      end do
   end subroutine nonnegative_least_squares

   !> Least squares of the columns that are free, by their normal equations
   pure subroutine solve_free(a, b, is_free, x, is_solved)
      !> A and b
      real(wp), intent(in) :: a(:, :), b(:)
      !> Which columns
      logical, intent(in) :: is_free(:)
      !> x, 0 elsewhere
      real(wp), intent(out) :: x(:)
      !> Do the columns not depend on one another?
      logical, intent(out) :: is_solved

      type(factor_type) :: factor
      real(wp), allocatable :: some(:, :)
      integer, allocatable :: columns(:)
      integer :: i

      columns = pack([(i, i=1, size(x))], is_free)
      some = a(:, columns)
      x = 0.0_wp
      call factorise(factor, matmul(transpose(some), some))
      is_solved = factor%rank == size(columns)
      if (is_solved) x(columns) = factor%solve(matmul(b, some))
   end subroutine solve_free

end module dondolo_wall_chain_equations
