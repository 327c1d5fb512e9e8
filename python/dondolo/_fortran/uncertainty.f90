!> What the uncertainty of a model is made of.
module uncertainty
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use dondolo_base_error, only : error_type
   use dondolo_base_lines, only : lines_type
   use dondolo_boundary, only : check_room
   use dondolo_interface_handles, only : find_walls
   use dondolo_parcel, only : parcel_type, report, send
   use dondolo_population_sensitivity, only : new_sensitivity, sensitivity_type, smallest => smallest_sample
   use dondolo_wall, only : wall_type
   use dondolo_wall_restitution, only : published_factors
   use dondolo_wall_tested_restitution, only : check_published, make_restitution_sentence, published_parameters
   implicit none
   private

   public :: sensitivity, published, smallest_sample, check_factor, factor_parameters, restitution_sentence

contains

   !> Sobol indices of k quantities from n samples, first-order and total with their intervals; and the part that is not explained
   subroutine sensitivity(values, outcome, n, k, first, first_interval, total, total_interval, rest, failure)
      !f2py threadsafe
      integer(c_int), intent(in) :: n, k
      real(c_double), intent(in) :: values(n, k), outcome(n)
      real(c_double), intent(out) :: first(k), first_interval(2, k), total(k), total_interval(2, k), rest
      integer(c_int64_t), intent(out) :: failure(5)
      type(sensitivity_type) :: found
      type(error_type), allocatable :: error

      first = 0
      first_interval = 0
      total = 0
      total_interval = 0
      rest = 0
      call check_room(error, reals=4.0_c_double*n*k*(k + 4))
      if (.not. allocated(error)) call new_sensitivity(found, values, outcome, error)
      call report(error, failure)
      if (allocated(error)) return
      first = found%first
      first_interval = found%first_interval
      total = found%total
      total_interval = found%total_interval
      rest = found%rest
   end subroutine sensitivity

   !> Fewest samples for the indices of some quantities
   subroutine smallest_sample(quantities, samples)
      integer(c_int), intent(in) :: quantities
      integer(c_int), intent(out) :: samples

      samples = smallest(int(quantities))
   end subroutine smallest_sample

   !> Published ranges and distributions of the factor on restitution, as columns
   subroutine published(sent)
      integer(c_int64_t), intent(out) :: sent(5)
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      type(lines_type) :: names, kinds, sources
      integer :: i

      do i = 1, size(published_factors)
         call names%add(trim(published_factors(i)%name))
         call kinds%add(trim(published_factors(i)%kind))
         call sources%add(trim(published_factors(i)%source))
      end do
      call parcel%put('name', names)
      call parcel%put('kind', kinds)
      call parcel%put('first', published_factors%parameters(1))
      call parcel%put('second', published_factors%parameters(2))
      call parcel%put('source', sources)
      call send(parcel, error, sent)
   end subroutine published

   !> Check that a published range was measured against the restitution of a wall
   subroutine check_factor(walls, name, failure)
      integer(c_int64_t), intent(in) :: walls
      character(len=*), intent(in) :: name
      integer(c_int64_t), intent(out) :: failure(5)
      type(wall_type), pointer :: wall(:)
      type(error_type), allocatable :: error

      call find_walls(walls, wall, error)
      if (.not. allocated(error)) call check_published(name, wall(1), error)
      call report(error, failure)
   end subroutine check_factor

   !> Parameters of a published distribution for the variants of a wall
   subroutine factor_parameters(walls, name, sent)
      integer(c_int64_t), intent(in) :: walls
      character(len=*), intent(in) :: name
      integer(c_int64_t), intent(out) :: sent(5)
      type(wall_type), pointer :: variants(:)
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      call find_walls(walls, variants, error)
      if (.not. allocated(error)) call parcel%put('parameters', published_parameters(name, variants))
      call send(parcel, error, sent)
   end subroutine factor_parameters

   !> What the restitution of a wall assumes beside tests, as a line, empty where there are none
   subroutine restitution_sentence(walls, sent)
      integer(c_int64_t), intent(in) :: walls
      integer(c_int64_t), intent(out) :: sent(5)
      type(wall_type), pointer :: wall(:)
      character(len=:), allocatable :: line
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      call find_walls(walls, wall, error)
      if (.not. allocated(error)) then
         call make_restitution_sentence(wall(1), line)
         call parcel%lines%add(line)
      end if
      call send(parcel, error, sent)
   end subroutine restitution_sentence

end module uncertainty
