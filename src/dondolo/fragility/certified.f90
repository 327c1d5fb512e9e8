!> Certified stripes: every history whose estimated error leaves a doubt is run again in 33 digits, and counts with what it
!> comes to there (docs/certification.md).
module dondolo_certified
   use dondolo_certificate, only : certificate_type, certified_type, certify_histories, in_double, not_computable
   use dondolo_ensemble, only : ensemble_type
   use dondolo_error, only : error_type
   use dondolo_floors, only : floors_type
   use dondolo_fragility, only : fit_fragility, fragility_type
   use dondolo_kinds, only : wp
   use dondolo_memory, only : check_room
   use dondolo_queue, only : progress_interface
   use dondolo_stripes, only : stripes_type, take_motions
   use dondolo_study, only : study_type
   use dondolo_suite, only : suite_type
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: certify_stripes, theta_bounds

   !> Memory that a certified history takes [bytes]
   real(wp), parameter :: bytes_of_certified = 200.0_wp

contains

   !> Certify the histories of stripes
   subroutine certify_stripes(stripes, wall, study, error, progress)
      !> Stripes with estimated errors; the responses of those that are run again change
      type(stripes_type), intent(inout) :: stripes
      type(wall_type), intent(in) :: wall
      !> What it was tried with
      type(study_type), intent(in) :: study
      !> As of check_certificates; or lack of memory
      type(error_type), allocatable, intent(out) :: error
      !> Hears how far the work is
      procedure(progress_interface), optional :: progress

      type(certificate_type), allocatable :: certificates(:)
      type(floors_type), target :: own
      type(floors_type), pointer :: floors
      type(suite_type), pointer :: motions
      logical, allocatable :: doubtful(:, :)
      type(ensemble_type) :: ensemble
      integer :: i, j, k, place

      call check_room(bytes_of_certified*real(size(stripes%response), wp), error)
      if (allocated(error)) return
      associate (response => stripes%response)
         allocate (stripes%certified(size(response, 1), size(response, 2)))
         stripes%certified%status = merge(in_double, 0, stripes%ran)
         stripes%certified%lowest = response%edp
         stripes%certified%highest = response%edp
         doubtful = stripes%ran .and. response%is_doubtful(study%solver%edp_limit)
         ensemble%record = pack(spread(stripes%record, 2, size(stripes%levels)), doubtful)
         ensemble%scale = pack(spread(real(stripes%polarity, wp), 2, size(stripes%levels))*stripes%scale, doubtful)
         ensemble%response = pack(response, doubtful)
         call take_motions(study, wall, study%threads, own, floors, place, motions)
         call certify_histories(certificates, wall, motions%records, ensemble, study%solver%edp_limit, study%threads, &
            & error, progress)
         if (place > 0) call floors%give_back(place)
         if (allocated(error)) return
         k = 0
         do j = 1, size(response, 2)
            do i = 1, size(response, 1)
               if (.not. doubtful(i, j)) cycle
               k = k + 1
               response(i, j) = certificates(k)%response
               stripes%certified(i, j) = certificates(k)%certified_type
            end do
         end do
      end associate
   end subroutine certify_stripes

   !> Median capacities between which the histories lie that are not computable from this input
   subroutine theta_bounds(stripes, edp_limit, lowest, highest)
      !> Certified stripes
      type(stripes_type), intent(in) :: stripes
      !> Rotation / capacity at which the wall has collapsed
      real(wp), intent(in) :: edp_limit
      !> Theta with all of them collapsed that may be, and with none of them; 0 where there is no curve
      real(wp), intent(out) :: lowest, highest

      lowest = theta_of(stripes%certified%highest)
      highest = theta_of(stripes%certified%lowest)

   contains

      !> Theta with other EDPs
      real(wp) function theta_of(edp)
         !> EDPs (histories, levels)
         real(wp), intent(in) :: edp(:, :)

         type(fragility_type) :: curve
         type(error_type), allocatable :: error

         theta_of = 0.0_wp
         call fit_fragility(curve, stripes%levels, real(count(stripes%ran .and. edp >= edp_limit, dim=1), wp), &
            & real(stripes%histories(), wp), error)
         if (allocated(error)) return
         if (curve%has_fit()) theta_of = curve%theta
      end function theta_of

   end subroutine theta_bounds

end module dondolo_certified
