!> Where a polynomial first falls to zero: how events are found inside a step.
!>
!> A polynomial in Bernstein form, sum_j c_j B_j(x) on 0 <= x <= 1, lies between the smallest and the largest of
!> its coefficients and has no more roots than they have changes of sign. So a root that exists is never missed,
!> however close two of them lie, and coefficients of one sign prove that there is none.
module dondolo_motion_bernstein
   use dondolo_base_bracket, only : bracket_type
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: first_descent, nowhere, most_coefficients

   !> Most coefficients of a polynomial here; rooms of fixed size are on the stack, where they cost nothing
   integer, parameter :: most_coefficients = 10

   !> Answer of first_descent where the polynomial stays positive
   real(wp), parameter :: nowhere = 2.0_wp

   !> Width below which an interval that may hold two roots is called a touch
   real(wp), parameter :: narrowest = 4.0_wp*epsilon(1.0_wp)

contains

   !> First x in (0, 1] at which a polynomial that starts positive falls to zero. Roots at x = 0 itself are
   !> divided out: they are where the step began, not an event
   pure function first_descent(coefficients) result(x)
      !> Bernstein coefficients
      real(wp), intent(in) :: coefficients(0:)
      !> The place, or `nowhere`
      real(wp) :: x

      real(wp) :: c(0:most_coefficients - 1)
      integer :: j, n

      n = ubound(coefficients, 1)
      c(:n) = coefficients
      do while (c(0) == 0.0_wp .and. n > 0)
         do j = 0, n - 1
            c(j) = c(j + 1)*real(n, wp)/real(j + 1, wp)
         end do
         n = n - 1
      end do
      x = descent_between(c(:n), 0.0_wp, 1.0_wp)
   end function first_descent

   !> First descent of a polynomial given on part of the unit interval: halve until a root stands alone
   pure recursive function descent_between(c, start, width) result(x)
      !> Bernstein coefficients on the part
      real(wp), intent(in) :: c(0:)
      !> Where the part begins
      real(wp), intent(in) :: start
      !> Its width
      real(wp), intent(in) :: width
      !> The place, or `nowhere`
      real(wp) :: x

      real(wp) :: left(0:most_coefficients - 1), right(0:most_coefficients - 1)
      integer :: j, n

      n = ubound(c, 1)
      x = nowhere
      if (all(c > 0.0_wp)) return
      if (c(0) <= 0.0_wp .or. width < narrowest) then
         x = start
      else if (c(n) <= 0.0_wp .and. count(c(:n - 1) > 0.0_wp .neqv. c(1:) > 0.0_wp) == 1) then
         x = start + width*single_root(c)
      else
         ! de Casteljau at the middle
         right(:n) = c
         do j = 0, n
            left(j) = right(0)
            right(:n - j - 1) = 0.5_wp*(right(:n - j - 1) + right(1:n - j))
         end do
         x = descent_between(left(:n), start, 0.5_wp*width)
         if (x >= nowhere) x = descent_between(right(:n), start + 0.5_wp*width, 0.5_wp*width)
      end if
   end function descent_between

   !> The only root of a polynomial that is positive at 0 and not at 1: bisection, hastened by Newton's step
   !> where that stays in the bracket
   pure function single_root(c) result(x)
      !> Bernstein coefficients
      real(wp), intent(in) :: c(0:)
      !> The root
      real(wp) :: x

      type(bracket_type) :: bracket
      real(wp) :: next, b(0:most_coefficients - 1), slope
      integer :: j, n, iteration

      n = ubound(c, 1)
      bracket%last = 1.0_wp
      x = c(0)/(c(0) - c(n))
      do iteration = 1, 2*digits(x)
         b(:n) = c
         slope = 0.0_wp
         do j = n, 1, -1
            if (j == 1) slope = real(n, wp)*(b(1) - b(0))
            b(:j - 1) = (1.0_wp - x)*b(:j - 1) + x*b(1:j)
         end do
         call bracket%narrow(x, b(0) > 0.0_wp)
         next = bracket%middle()
         if (slope < 0.0_wp) next = x - b(0)/slope
         if (abs(next - x) <= 2.0_wp*epsilon(x)*x) exit
         if (.not. (next > bracket%first .and. next < bracket%last)) next = bracket%middle()
         if (next <= bracket%first .or. next >= bracket%last) exit
         x = next
      end do
   end function single_root

end module dondolo_motion_bernstein
