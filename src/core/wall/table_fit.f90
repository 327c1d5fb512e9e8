!> Polynomials through tables of a smooth function: as few powers as the table asks for, as many as it can bear.
!>
!> Polynomials that are orthogonal on the rotations of the table (Forsythe 1957) give the least squares of every degree at
!> once. A degree is tried as long as the value of the polynomial between two rows is no less certain than that of a row: the
!> variance of the value at z is K(z) = sum p_k(z)^2 times that of a row, and K > 1 is where a polynomial begins to swing
!> between equal steps (Runge). Of those degrees the least is taken whose residual variance comes near the smallest.
module dondolo_wall_table_fit
   use dondolo_base_chebyshev, only : chebyshev_nodes, chebyshev_series
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: fit_table, least_rows, most_rows

   !> Rows that a table must have, and may have
   integer, parameter :: least_rows = 5, most_rows = 10000

   !> Highest degree
   integer, parameter :: highest_degree = 32

   !> What the rounding of a row leaves, relative to the largest value: that of double precision, which tables have in any
   !> precision of the program
   real(wp), parameter :: rounding = 2.2e-16_wp

   !> A residual variance comes near the smallest if it is no more than so many times it
   real(wp), parameter :: near = 2.0_wp

   !> Places between two rows at which the certainty is looked at
   integer, parameter :: between = 4

contains

   !> Fit a polynomial to a table
   subroutine fit_table(q, values, series, misfit)
      !> Rotations of the rows, from 0 on, each more than the one before [rad]
      real(wp), intent(in) :: q(:)
      !> Values
      real(wp), intent(in) :: values(:)
      !> Chebyshev series over z = 2 q/q_last - 1
      real(wp), allocatable, intent(out) :: series(:)
      !> Largest distance of a row from it / largest value
      real(wp), intent(out) :: misfit

      real(wp), allocatable :: z(:), p(:, :), left(:), squares(:), coefficients(:)
      real(wp) :: shift(0:highest_degree), length(0:highest_degree), largest, least, mean
      integer :: degree, k, n, most

      n = size(q)
      z = 2.0_wp*q/q(n) - 1.0_wp
      most = min(highest_degree, n - 2)
      largest = maxval(abs(values))
      call find_basis(z, most, p, shift, length)
      allocate (coefficients(0:most), squares(0:most), source=0.0_wp)
      left = values
      do k = 0, most
         coefficients(k) = sum(p(:, k)*left)
         left = left - coefficients(k)*p(:, k)
         ! Rounding errors do not count: they would raise the degree without end.
         squares(k) = max(sum(left**2)/real(n - k - 1, wp), (rounding*largest)**2)
      end do
      least = minval(squares)
      degree = findloc(squares <= near*least, .true., dim=1) - 1
      mean = coefficients(0)/sqrt(real(n, wp))
      associate (nodes => chebyshev_nodes(degree + 1))
         series = chebyshev_series(change_at(nodes))
      end associate
      series(1) = series(1) + mean
      ! What is left of rounding would be multiplied by the square of the degree in the slope.
      series = series(:max(1, findloc(abs(series) > rounding*largest, .true., dim=1, back=.true.)))
      misfit = 0.0_wp
      if (largest > 0.0_wp) misfit = maxval(abs(mean + change_at(z) - values))/largest

   contains

      !> The polynomial of the degree at some places, without its constant: what it changes by has then more digits
      function change_at(places) result(sums)
         !> Places
         real(wp), intent(in) :: places(:)
         !> Changes
         real(wp) :: sums(size(places))

         real(wp), dimension(size(places)) :: before, this, next
         integer :: i

         before = 0.0_wp
         this = 1.0_wp/sqrt(real(n, wp))
         sums = 0.0_wp
         do i = 1, degree
            call next_term(places, shift(i - 1), length(i - 1), length(i), before, this, next)
            sums = sums + coefficients(i)*this
         end do
      end function change_at

   end subroutine fit_table

   !> The orthogonal polynomials, up to the highest degree that the rows can bear
   subroutine find_basis(z, most, p, shift, length)
      !> Places of the rows, -1 to 1
      real(wp), intent(in) :: z(:)
      !> In: the highest degree that may be tried; out: that the rows can bear
      integer, intent(inout) :: most
      !> Values at the rows (rows, 0:), of the degrees that they can bear
      real(wp), allocatable, intent(out) :: p(:, :)
      !> Constants of the recurrence
      real(wp), intent(out) :: shift(0:), length(0:)

      real(wp), allocatable :: places(:), before(:), this(:), next(:), certainty(:), old(:)
      real(wp) :: part
      integer :: k, n

      n = size(z)
      allocate (p(n, 0:most), old(n), places(between*(n - 1)), source=0.0_wp)
      do k = 1, between
         part = (real(k, wp) - 0.5_wp)/real(between, wp)
         places(k::between) = z(:n - 1) + part*(z(2:) - z(:n - 1))
      end do
      allocate (before(size(places)), next(size(places)), source=0.0_wp)
      allocate (this(size(places)), source=1.0_wp/sqrt(real(n, wp)))
      certainty = this**2
      shift = 0.0_wp
      length = 0.0_wp
      p(:, 0) = 1.0_wp/sqrt(real(n, wp))
      do k = 1, most
         shift(k - 1) = sum(z*p(:, k - 1)**2)
         p(:, k) = (z - shift(k - 1))*p(:, k - 1) - length(k - 1)*old
         length(k) = norm2(p(:, k))
         p(:, k) = p(:, k)/length(k)
         old = p(:, k - 1)
         call next_term(places, shift(k - 1), length(k - 1), length(k), before, this, next)
         certainty = certainty + this**2
         if (any(certainty > 1.0_wp)) then
            most = k - 1
            exit
         end if
      end do
   end subroutine find_basis

   !> Go from one polynomial to the next
   pure subroutine next_term(z, shift, length, next_length, before, this, next)
      !> Places
      real(wp), intent(in) :: z(:)
      !> Constants of the recurrence
      real(wp), intent(in) :: shift, length, next_length
      !> The polynomial before, this one and room for the next
      real(wp), intent(inout) :: before(:), this(:), next(:)

      next = ((z - shift)*this - length*before)/next_length
      before = this
      this = next
   end subroutine next_term

end module dondolo_wall_table_fit
