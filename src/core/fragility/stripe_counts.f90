!> Results of stripes: how many histories reach each EDP threshold at each level, and the curves fitted to them.
module dondolo_fragility_stripe_counts
   use dondolo_base_error, only : error_type
   use dondolo_base_invariant, only : assert, checked
   use dondolo_base_kinds, only : wp
   use dondolo_fragility, only : fit_fragility, fragility_type
   use dondolo_fragility_clustered, only : cluster_errors
   use dondolo_fragility_ordinal, only : fit_ordinal, ordinal_errors
   use dondolo_fragility_stripes, only : stripes_type
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
   subroutine counts_of(self, stripes, thresholds, clusters, ordinal, error)
      !> Counts and curves
      class(stripe_counts_type), intent(inout) :: self
      !> Stripes, all of whose histories were run
      type(stripes_type), intent(in) :: stripes
      !> EDP thresholds
      real(wp), intent(in) :: thresholds(:)
      !> Number of the cluster of each record
      integer, intent(in) :: clusters(:)
      !> Do the curves of all thresholds have one dispersion? Else each is fitted on its own
      logical, intent(in) :: ordinal
      !> Counts that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      real(wp), allocatable :: reached(:, :, :), run(:, :), changes(:, :, :)
      integer :: i, j, k

      self%histories = stripes%histories()
      allocate (self%reached(size(stripes%levels), size(thresholds)), self%curve(size(thresholds)))
      do k = 1, size(thresholds)
         self%reached(:, k) = stripes%exceedances(thresholds(k))
      end do
      associate (levels => size(stripes%levels), states => size(thresholds), last => maxval(clusters))
         allocate (reached(levels, states, last), run(levels, last), source=0.0_wp)
         allocate (changes(2, states, last))
      end associate
      do i = 1, size(stripes%record)
         do j = 1, size(stripes%levels)
            if (.not. stripes%ran(i, j)) cycle
            associate (g => clusters(stripes%record(i)))
               run(j, g) = run(j, g) + 1.0_wp
               reached(j, :, g) = reached(j, :, g) + merge(1.0_wp, 0.0_wp, stripes%response(i, j)%edp >= thresholds)
            end associate
         end do
      end do
      if (checked) call assert(all(nint(sum(reached, dim=3)) == self%reached) .and. all(nint(sum(run, dim=2)) == self%histories), &
         & 'the histories of all clusters are those of the stripes')
      if (ordinal) then
         call fit_ordinal(self%curve, stripes%levels, real(self%reached, wp), real(self%histories, wp), error)
         if (.not. allocated(error)) call ordinal_errors(self%curve, stripes%levels, reached, run, changes)
         return
      end if
      do k = 1, size(thresholds)
         call fit_fragility(self%curve(k), stripes%levels, real(self%reached(:, k), wp), &
            & real(self%histories, wp), error)
         if (allocated(error)) return
         call cluster_errors(self%curve(k), stripes%levels, reached(:, k, :), run, changes(:, k, :))
      end do
   end subroutine counts_of

end module dondolo_fragility_stripe_counts
