!> What stripes come to: how many histories reach each EDP threshold at each level, and the curves fitted to them.
module dondolo_stripe_counts
   use dondolo_clustered, only : cluster_errors
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
   subroutine counts_of(self, stripes, thresholds, clusters, error)
      !> Counts and curves
      class(stripe_counts_type), intent(inout) :: self
      !> Stripes, all of whose histories were run
      type(stripes_type), intent(in) :: stripes
      !> EDP thresholds
      real(wp), intent(in) :: thresholds(:)
      !> Number of the cluster of each record
      integer, intent(in) :: clusters(:)
      !> Counts that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      real(wp), dimension(size(stripes%levels), maxval(clusters)) :: reached, run
      real(wp) :: changes(2, maxval(clusters))
      integer :: i, j, k

      self%histories = stripes%histories()
      allocate (self%reached(size(stripes%levels), size(thresholds)), self%curve(size(thresholds)))
      do k = 1, size(thresholds)
         self%reached(:, k) = stripes%exceedances(thresholds(k))
         call fit_fragility(self%curve(k), stripes%levels, real(self%reached(:, k), wp), &
            & real(self%histories, wp), error)
         if (allocated(error)) return
         reached = 0.0_wp
         run = 0.0_wp
         do i = 1, size(stripes%record)
            do j = 1, size(stripes%levels)
               if (.not. stripes%ran(i, j)) cycle
               associate (g => clusters(stripes%record(i)))
                  run(j, g) = run(j, g) + 1.0_wp
                  if (stripes%response(i, j)%edp >= thresholds(k)) reached(j, g) = reached(j, g) + 1.0_wp
               end associate
            end do
         end do
         call cluster_errors(self%curve(k), stripes%levels, reached, run, changes)
      end do
   end subroutine counts_of

end module dondolo_stripe_counts
