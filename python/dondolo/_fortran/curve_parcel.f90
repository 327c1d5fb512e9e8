!> Curves on their way to Python and back: each part has a name.
module dondolo_curve_parcel
   use, intrinsic :: iso_c_binding, only : c_double, c_int
   use dondolo_base_error, only : error_type, raise_input
   use dondolo_base_lines, only : lines_type
   use dondolo_boundary, only : check_room, split_lines
   use dondolo_fragility, only : error_names, fit_status_names, fragility_type
   use dondolo_parcel, only : parcel_type
   implicit none
   private

   public :: put_curves, put_fits, take_curves

contains

   !> Put curves in, each of their parts under its name: what put_fits has, kind of errors (place among the names), standard
   !> errors as the tables have them, clusters and degrees of freedom
   subroutine put_curves(parcel, prefix, curves)
      type(parcel_type), intent(inout) :: parcel
      !> What the names begin with
      character(len=*), intent(in) :: prefix
      type(fragility_type), intent(in) :: curves(:)

      integer :: i, n

      n = size(curves)
      call put_fits(parcel, prefix, curves)
      call parcel%put(prefix//'errors', [(int(findloc(error_names, curves(i)%errors, dim=1), c_int), i=1, n)])
      call parcel%put(prefix//'clusters', [(int(curves(i)%clusters, c_int), i=1, n)])
      call parcel%put(prefix//'se_ln_theta', [(curves(i)%se_ln_theta(), i=1, n)])
      call parcel%put(prefix//'se_beta', [(curves(i)%se_beta(), i=1, n)])
      call parcel%put(prefix//'cov_ln_theta_beta', [(curves(i)%covariance(1, 2), i=1, n)])
      call parcel%put(prefix//'degrees_of_freedom', [(curves(i)%degrees_of_freedom, i=1, n)])
   end subroutine put_curves

   !> Put in what was fitted: status (place among the names), theta, beta, log likelihood, deviance and its degrees of freedom,
   !> bracket (2, curves) and naive covariance (var ln theta, covariance, var beta; 3, curves)
   subroutine put_fits(parcel, prefix, curves)
      type(parcel_type), intent(inout) :: parcel
      !> What the names begin with
      character(len=*), intent(in) :: prefix
      type(fragility_type), intent(in) :: curves(:)

      integer :: i, n

      n = size(curves)
      call parcel%put(prefix//'status', int(curves%status, c_int))
      call parcel%put(prefix//'theta', [(curves(i)%theta, i=1, n)])
      call parcel%put(prefix//'beta', [(curves(i)%beta, i=1, n)])
      call parcel%put(prefix//'log_likelihood', [(curves(i)%log_likelihood, i=1, n)])
      call parcel%put(prefix//'deviance', [(curves(i)%deviance, i=1, n)])
      call parcel%put(prefix//'deviance_dof', [(int(curves(i)%deviance_dof, c_int), i=1, n)])
      call parcel%put(prefix//'bracket', [(curves(i)%bracket, i=1, n)], [2, n])
      call parcel%put(prefix//'naive_covariance', [(triangle(curves(i)%naive), i=1, n)], [3, n])
   end subroutine put_fits

   !> The numbers of a symmetric matrix
   pure function triangle(matrix) result(numbers)
      real(c_double), intent(in) :: matrix(2, 2)
      real(c_double) :: numbers(3)

      numbers = [matrix(1, 1), matrix(1, 2), matrix(2, 2)]
   end function triangle

   !> Take curves out of what Python gives of them
   subroutine take_curves(curves, names, texts, numbers, error, edp_thresholds)
      type(fragility_type), allocatable, intent(out) :: curves(:)
      !> Names of the numbers, a line each, in any order
      character(len=*), intent(in) :: names
      !> Status of each curve, and kind of its standard errors, a line each
      character(len=*), intent(in) :: texts
      !> Numbers of each curve (names, curves)
      real(c_double), intent(in) :: numbers(:, :)
      !> A name is missing, or a status unknown; or lack of memory
      type(error_type), allocatable, intent(out) :: error
      !> Rotation / capacity of their damage states, 0 where it is not known: no part of a curve
      real(c_double), allocatable, intent(out), optional :: edp_thresholds(:)

      type(lines_type) :: known, words
      character(len=len(fit_status_names)) :: status
      real(c_double) :: whole(size(numbers, 2))
      integer :: i

      call split_lines(names, known)
      call split_lines(texts, words)
      call check_room(error, reals=20.0_c_double*size(numbers, 2))
      if (allocated(error)) return
      allocate (curves(size(numbers, 2)))
      call take('theta', curves%theta)
      call take('beta', curves%beta)
      call take('naive_11', curves%naive(1, 1))
      call take('naive_12', curves%naive(1, 2))
      call take('naive_22', curves%naive(2, 2))
      curves%naive(2, 1) = curves%naive(1, 2)
      call take('covariance_11', curves%covariance(1, 1))
      call take('covariance_12', curves%covariance(1, 2))
      call take('covariance_22', curves%covariance(2, 2))
      curves%covariance(2, 1) = curves%covariance(1, 2)
      call take('log_likelihood', curves%log_likelihood)
      call take('bracket_low', curves%bracket(1))
      call take('bracket_high', curves%bracket(2))
      call take('degrees_of_freedom', curves%degrees_of_freedom)
      call take('deviance', curves%deviance)
      call take('deviance_dof', whole)
      curves%deviance_dof = nint(whole)
      call take('clusters', whole)
      curves%clusters = nint(whole)
      if (present(edp_thresholds)) then
         allocate (edp_thresholds(size(curves)))
         call take('edp_threshold', edp_thresholds)
      end if
      do i = 1, size(curves)
         status = words%line(2*i - 1)%text
         curves(i)%status = findloc(fit_status_names, status, dim=1)
         curves(i)%errors = words%line(2*i)%text
         if (curves(i)%status == 0) call raise_input(error, 'status: must be one of a fit')
      end do

   contains

      !> Take a number of all curves
      subroutine take(name, values)
         character(len=*), intent(in) :: name
         real(c_double), intent(out) :: values(:)

         integer :: k

         values = 0.0_c_double
         do k = 1, known%count
            if (known%line(k)%text /= name) cycle
            values = numbers(k, :)
            return
         end do
         call raise_input(error, name//': must be given of curves')
      end subroutine take

   end subroutine take_curves

end module dondolo_curve_parcel
