!> What stripes come to: how many histories reach each EDP threshold at each level, and the curves fitted to them.
module dondolo_stripe_counts
   use dondolo_error, only : error_type
   use dondolo_fragility, only : fit_fragility, fragility_type
   use dondolo_kinds, only : wp
   use dondolo_stripes, only : stripes_type
   implicit none
   private

   public :: stripe_counts_type

   !> Counts and curves of a wall, or of one of its mechanisms
   type :: stripe_counts_type
      !> Histories of each stripe
      integer, allocatable :: histories(:)
      !> Histories that reach a threshold (levels, thresholds)
      integer, allocatable :: reached(:, :)
      !> Curve of each threshold
      type(fragility_type), allocatable :: curve(:)
   contains
      !> Count and fit
      procedure :: of => counts_of
   end type stripe_counts_type

contains

   !> Count the histories of stripes and fit the curves
   subroutine counts_of(self, stripes, thresholds, error)
      !> Counts and curves
      class(stripe_counts_type), intent(inout) :: self
      !> Stripes, all of whose histories were run
      type(stripes_type), intent(in) :: stripes
      !> EDP thresholds
      real(wp), intent(in) :: thresholds(:)
      !> Counts that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      integer :: k

      self%histories = stripes%histories()
      allocate (self%reached(size(stripes%levels), size(thresholds)), self%curve(size(thresholds)))
      do k = 1, size(thresholds)
         self%reached(:, k) = stripes%exceedances(thresholds(k))
         call fit_fragility(self%curve(k), stripes%levels, real(self%reached(:, k), wp), &
            & real(self%histories, wp), error)
         if (allocated(error)) return
      end do
   end subroutine counts_of

end module dondolo_stripe_counts
