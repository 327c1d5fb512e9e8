!> Invariants: what holds at a place of the code whatever the input is, or the code is wrong.
!>
!> The tests are built with `DONDOLO_CHECKED` and end at the first invariant that does not hold. In all other builds `checked` is
!> false, and the compiler leaves out what depends on it:
!>
!>     if (checked) call assert(increases(knots), 'the knots of a table increase')
!>
!> What a user gives is no invariant: it is refused by an error.
module dondolo_base_invariant
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: checked, assert, are_probabilities, increases, is_covariance, lies_between

   !> Are invariants checked?
#ifdef DONDOLO_CHECKED
   logical, parameter :: checked = .true.
#else
   logical, parameter :: checked = .false.
#endif

   !> Relative error of a covariance and of a probability that rounding may leave
   real(wp), parameter :: rounding = 1.0e-6_wp

contains

   !> End the program if an invariant does not hold, in builds that check them
   pure subroutine assert(holds, what)
      !> Does it hold?
      logical, intent(in) :: holds
      !> The invariant, as a statement
      character(len=*), intent(in) :: what

      if (checked .and. .not. holds) error stop 'dondolo: an invariant does not hold: '//what
   end subroutine assert

   !> Does each number exceed the one before it? No if any is NaN
   pure logical function increases(x)
      real(wp), intent(in) :: x(:)

      increases = all(x(2:) > x(:size(x) - 1))
   end function increases

   !> Do numbers lie in [0, 1]? No if any is NaN
   pure logical function are_probabilities(p)
      real(wp), intent(in) :: p(:)

      are_probabilities = all(p >= 0.0_wp .and. p <= 1.0_wp + rounding)
   end function are_probabilities

   !> Does a number lie between two ends, in either order? No if any is NaN
   elemental logical function lies_between(x, first, last)
      real(wp), intent(in) :: x, first, last

      lies_between = x >= min(first, last) .and. x <= max(first, last)
   end function lies_between

   !> Is a matrix symmetric and, of two parameters each, not negative? No if a number is NaN or infinite
   pure logical function is_covariance(matrix)
      real(wp), intent(in) :: matrix(2, 2)

      real(wp) :: bound

      is_covariance = all(abs(matrix) <= huge(bound)) .and. matrix(1, 1) >= 0.0_wp .and. matrix(2, 2) >= 0.0_wp
      if (.not. is_covariance) return
      bound = sqrt(matrix(1, 1))*sqrt(matrix(2, 2))
      is_covariance = abs(matrix(1, 2) - matrix(2, 1)) <= rounding*bound .and. abs(matrix(1, 2)) <= (1.0_wp + rounding)*bound
   end function is_covariance

end module dondolo_base_invariant
