!> The criterion for time histories, C8.7.1.2.1.9: none beyond d_0*, and the mean of the largest displacements is allowed.
module dondolo_check_history_check
   use dondolo_base_kinds, only : wp
   use dondolo_check_input, only : state_names
   use dondolo_check_kinematic, only : kinematic_type
   use dondolo_check_nonlinear, only : capacity_displacement, shares
   use dondolo_check_sheet, only : sheet_type
   implicit none
   private

   public :: check_histories

contains

   !> Criterion for time histories at the peak acceleration of the site, C8.7.1.2.1.9
   pure subroutine check_histories(sheet, kinematic, state, pga, records, edp)
      !> The lines are added
      type(sheet_type), intent(inout) :: sheet
      type(kinematic_type), intent(in) :: kinematic
      !> 2: SLV, 3: SLC
      integer, intent(in) :: state
      !> Peak acceleration that the records were scaled to [g]
      real(wp), intent(in) :: pga
      !> Number of records
      integer, intent(in) :: records
      !> Largest rotation / capacity of each history, at least one; 1 or more where it collapsed
      real(wp), intent(in) :: edp(:)

      character(len=3) :: name
      real(wp) :: mean, allowed, untied
      integer :: beyond

      name = state_names(state)
      if (kinematic%is_without_spectrum) then
         call sheet%add('dynamic', name, 'applicable', 0.0_wp, 'C8.7.1.2.1.9')
         return
      end if
      beyond = count(edp >= 1.0_wp)
      ! At a PGA that is the trigger but for a rounding, the record exceeds it for a rounding of a time step: what follows, some
      ! 1e-49 of the capacity, is rest
      mean = sum(kinematic%displacement(merge(min(edp, 1.0_wp), 0.0_wp, edp > epsilon(edp))*kinematic%end_rotation()))/ &
         & real(size(edp), wp)
      allowed = capacity_displacement(kinematic, state)
      if (abs(kinematic%hinge - kinematic%weakest_hinge) > 0.0_wp) call sheet%add('dynamic', name, 'hinge', kinematic%hinge)
      call sheet%add('dynamic', name, 'pga', pga)
      call sheet%add('dynamic', name, 'records', real(records, wp))
      call sheet%add('dynamic', name, 'histories', real(size(edp), wp))
      call sheet%add('dynamic', name, 'beyond', real(beyond, wp), 'C8.7.1.2.1.9')
      call sheet%add('dynamic', name, 'mean_displacement', mean, 'C8.7.1.2.1.9')
      call sheet%add('dynamic', name, 'displacement', allowed)
      ! A tie that breaks early ends the capacity of a wall that without it would be allowed more
      untied = min(shares(state)*kinematic%end_displacement, kinematic%unseating)
      if (beyond == 0 .and. mean > allowed .and. mean <= untied) call sheet%add('dynamic', name, 'untied_displacement', untied)
      call sheet%add('dynamic', name, 'verified', merge(1.0_wp, 0.0_wp, beyond == 0 .and. mean <= allowed), 'C8.7.1.2.1.9')
   end subroutine check_histories

end module dondolo_check_history_check
