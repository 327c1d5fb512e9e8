!> Invariants: what is asked of numbers, against numbers of which it is known, and whether the tests are built with it.
program test_invariants
   use, intrinsic :: ieee_arithmetic, only : ieee_quiet_nan, ieee_value
   use checks, only : check, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_invariant, only : are_probabilities, assert, checked, increases, is_covariance, lies_between
   use dondolo_base_kinds, only : wp
   use dondolo_fragility, only : fit_fragility, fragility_type
   implicit none

   real(wp) :: nan

   nan = ieee_value(nan, ieee_quiet_nan)
   call test_build()
   call test_orders()
   call test_probabilities()
   call test_covariances()
   call finish()

contains

   !> The tests themselves are built with invariants
   subroutine test_build()
      call suite('build')
      call check(checked, 'invariants are checked')
      call assert(.true., 'one that holds ends nothing')
   end subroutine test_build

   !> Increasing numbers, and places between two
   subroutine test_orders()
      call suite('orders')
      call check(increases([1.0_wp, 2.0_wp, 2.5_wp]) .and. increases([1.0_wp]) .and. increases([real(wp) ::]), 'increasing')
      call check(.not. increases([1.0_wp, 1.0_wp]) .and. .not. increases([2.0_wp, 1.0_wp, 3.0_wp]), 'not increasing')
      call check(.not. increases([1.0_wp, nan]) .and. .not. increases([nan, 1.0_wp]), 'NaN does not increase')
      call check(all(lies_between([1.0_wp, 2.0_wp, 1.5_wp], 2.0_wp, 1.0_wp)), 'the ends too, in either order')
      call check(.not. any(lies_between([0.9_wp, 2.1_wp, nan], 1.0_wp, 2.0_wp)), 'neither outside nor NaN')
      call check(.not. lies_between(1.0_wp, 0.0_wp, -1.0_wp), 'above both ends')
   end subroutine test_orders

   !> Probabilities
   subroutine test_probabilities()
      call suite('probabilities')
      call check(are_probabilities([0.0_wp, 0.5_wp, 1.0_wp]), '0 and 1 too')
      call check(are_probabilities([1.0_wp + 10.0_wp*epsilon(1.0_wp)]), 'a sum that rounding leaves above 1')
      call check(.not. are_probabilities([0.5_wp, 1.1_wp]) .and. .not. are_probabilities([-tiny(1.0_wp)]), 'outside')
      call check(.not. are_probabilities([nan]), 'NaN is none')
   end subroutine test_probabilities

   !> Covariances: correlations up to 1, and that of a fit
   subroutine test_covariances()
      type(fragility_type) :: curve
      type(error_type), allocatable :: error

      call suite('covariances')
      call check(is_covariance(matrix(4.0_wp, 5.9_wp, 9.0_wp)) .and. is_covariance(matrix(4.0_wp, -6.0_wp, 9.0_wp)), &
         & 'correlations within [-1, 1]')
      call check(is_covariance(matrix(0.0_wp, 0.0_wp, 0.0_wp)), 'none')
      call check(is_covariance(matrix(1.0e200_wp, 9.0e199_wp, 1.0e200_wp)), 'large ones')
      call check(.not. is_covariance(matrix(4.0_wp, 6.1_wp, 9.0_wp)), 'a correlation above 1')
      call check(.not. is_covariance(matrix(-1.0_wp, 0.0_wp, 1.0_wp)), 'a negative variance')
      call check(.not. is_covariance(reshape([1.0_wp, 0.2_wp, 0.3_wp, 1.0_wp], [2, 2])), 'not symmetric')
      call check(.not. is_covariance(matrix(1.0_wp, nan, 1.0_wp)) .and. .not. is_covariance(matrix(nan, 0.0_wp, 1.0_wp)), 'NaN')
      call fit_fragility(curve, [0.2_wp, 0.4_wp, 0.8_wp], [1.0_wp, 4.0_wp, 9.0_wp], spread(10.0_wp, 1, 3), error)
      call check(.not. allocated(error) .and. curve%has_fit() .and. is_covariance(curve%covariance), 'that of a fit')
   end subroutine test_covariances

   !> A symmetric matrix
   pure function matrix(first, both, second)
      !> Its entries
      real(wp), intent(in) :: first, both, second
      real(wp) :: matrix(2, 2)

      matrix = reshape([first, both, both, second], [2, 2])
   end function matrix

end program test_invariants
