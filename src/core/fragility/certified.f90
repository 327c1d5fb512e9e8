!> Certified stripes: every history whose estimated error leaves a doubt is run again in 33 digits, and counts with what it
!> comes to there (docs/reading_a_curve.md).
module dondolo_fragility_certified
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_memory, only : check_room
   use dondolo_building_floors, only : floors_type
   use dondolo_fragility, only : fit_fragility, fragility_type
   use dondolo_fragility_ordinal, only : fit_ordinal
   use dondolo_fragility_rounding, only : run_rounded
   use dondolo_fragility_stripes, only : stripes_type, take_motions
   use dondolo_fragility_study, only : study_type
   use dondolo_motion_certificate, only : certificate_type, certify_histories
   use dondolo_motion_certified, only : in_double, not_known
   use dondolo_motion_ensemble, only : ensemble_type
   use dondolo_motion_queue, only : progress_interface
   use dondolo_record_suite, only : suite_type
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: bound_states, certify_stripes, state_bounds_type

   !> Bounds of a damage state
   type :: state_bounds_type
      !> Histories of each level that reach it: of those that are not computable none, and all that may
      integer, allocatable :: fewest(:), most(:)
      !> Theta with all of them, and with none; 0 where there is no curve
      real(wp) :: theta_lowest = 0.0_wp, theta_highest = 0.0_wp
      !> Histories of which it is known how their records are printed, and those of them that reach the state either with the
      !> record as it is or within the rounding of its digits, but not with both
      integer :: rounded = 0, changed = 0
   end type state_bounds_type

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
      real(wp), allocatable :: rounded(:)
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
         ensemble%record = pack(spread(stripes%record, 2, size(stripes%levels)), stripes%ran)
         ensemble%scale = pack(spread(real(stripes%polarity, wp), 2, size(stripes%levels))*stripes%scale, stripes%ran)
         call run_rounded(rounded, wall, study%suite%records, ensemble, study%solver, study%threads, error, progress)
         if (allocated(error)) return
         stripes%certified%rounded = unpack(rounded, stripes%ran, not_known)
      end associate
   end subroutine certify_stripes

   !> Counts and median capacities between which the damage states lie, since histories are not computable from this input
   subroutine bound_states(stripes, thresholds, ordinal, bounds, error)
      !> Certified stripes
      type(stripes_type), intent(in) :: stripes
      !> EDP thresholds
      real(wp), intent(in) :: thresholds(:)
      !> Do the curves of all thresholds have one dispersion?
      logical, intent(in) :: ordinal
      !> Bounds of each threshold
      type(state_bounds_type), allocatable, intent(out) :: bounds(:)
      !> Counts that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      integer :: k

      allocate (bounds(size(thresholds)))
      do k = 1, size(thresholds)
         bounds(k)%fewest = count(stripes%ran .and. stripes%certified%lowest >= thresholds(k), dim=1)
         bounds(k)%most = count(stripes%ran .and. stripes%certified%highest >= thresholds(k), dim=1)
         bounds(k)%rounded = count(stripes%certified%rounded > not_known)
         bounds(k)%changed = count(stripes%certified%rounded > not_known .and. &
            & (stripes%certified%rounded >= thresholds(k) .neqv. stripes%response%edp >= thresholds(k)))
      end do
      call compute_thetas(stripes%certified%highest, bounds%theta_lowest)
      if (.not. allocated(error)) call compute_thetas(stripes%certified%lowest, bounds%theta_highest)

   contains

      !> Theta of each threshold with other EDPs; 0 where there is no curve
      subroutine compute_thetas(edp, thetas)
         !> EDPs (histories, levels)
         real(wp), intent(in) :: edp(:, :)
         !> Thetas
         real(wp), intent(out) :: thetas(:)

         type(fragility_type) :: curves(size(thresholds))
         real(wp) :: reached(size(stripes%levels), size(thresholds)), histories(size(stripes%levels))
         integer :: j

         thetas = 0.0_wp
         histories = real(stripes%histories(), wp)
         do j = 1, size(thresholds)
            reached(:, j) = real(count(stripes%ran .and. edp >= thresholds(j), dim=1), wp)
         end do
         if (ordinal) then
            call fit_ordinal(curves, stripes%levels, reached, histories, error)
            if (allocated(error)) return
         else
            do j = 1, size(thresholds)
               call fit_fragility(curves(j), stripes%levels, reached(:, j), histories, error)
               if (allocated(error)) return
            end do
         end if
         do j = 1, size(thresholds)
            if (curves(j)%has_fit()) thetas(j) = curves(j)%theta
         end do
      end subroutine compute_thetas

   end subroutine bound_states

end module dondolo_fragility_certified
