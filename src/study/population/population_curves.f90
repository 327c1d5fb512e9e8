!> The curves of a population, of its groups, and of walls in which several mechanisms are counted in the same histories, with
!> their standard errors: from the flags of its rows, streamed one by one (docs/theory.md, section 6).
module dondolo_population_curves
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_memory, only : check_room
   use dondolo_fragility_clustered, only : cluster_errors
   use dondolo_population, only : population_type
   use dondolo_population_errors, only : population_errors_type
   use dondolo_population_row_result, only : row_result_type
   use dondolo_population_typology, only : combine_population, typology_type
   use dondolo_population_unions, only : mean_unions, union_builder_type, union_type, unions_type, wall_union
   implicit none
   private

   public :: population_curves_type

   !> Curves in the making
   type :: population_curves_type
      !> Curves of the population for each damage state (curves, states); of size 0 for alternatives, over which nothing is a
      !> mean
      type(typology_type), allocatable :: typologies(:, :)
      !> Walls with several mechanisms, and behind them the means over the population and its groups
      type(unions_type) :: unions
      !> Standard errors of the curves of the population
      type(population_errors_type) :: errors
      !> Number of the cluster of each record, and whether a record runs at a level (records, levels)
      integer, allocatable, private :: clusters(:)
      logical, allocatable, private :: runs(:, :)
      !> Histories of each cluster that reach each state, over all records, of the rows of a wall (levels, clusters, states,
      !> mechanisms)
      real(wp), allocatable, private :: counts(:, :, :, :)
      !> The mechanisms of a wall so far, and how many walls with several have been
      type(union_builder_type), private :: builder
      integer, private :: united = 0
   contains
      !> Take the population
      procedure :: begin
      !> Take the results of a row
      procedure :: add
      !> All rows have been
      procedure :: finish
   end type population_curves_type

contains

   !> Take the population
   subroutine begin(self, population, clusters, runs, are_alternatives, keeps_changes, error)
      class(population_curves_type), intent(out) :: self
      !> The population, fitted
      type(population_type), intent(in) :: population
      !> Number of the cluster of each record
      integer, intent(in) :: clusters(:)
      !> Whether a record runs at a level (records, levels)
      logical, intent(in) :: runs(:, :)
      !> Are the walls designs, over which nothing is a mean?
      logical, intent(in) :: are_alternatives
      !> Are the changes of the curves kept, cluster by cluster and wall by wall?
      logical, intent(in) :: keeps_changes
      !> Fractions that cannot be fitted, too many groups, or lack of memory
      type(error_type), allocatable, intent(out) :: error

      type(typology_type), allocatable :: typologies(:)
      real(wp) :: share(size(runs, 2), maxval(clusters))
      integer :: i, k, states, united, kept

      self%clusters = clusters
      self%runs = runs
      states = size(population%curve, 1)
      if (are_alternatives) allocate (self%typologies(0, states))
      do k = 1, merge(0, states, are_alternatives)
         call combine_population(typologies, population, k, error)
         if (allocated(error)) return
         if (k == 1) allocate (self%typologies(size(typologies), states))
         self%typologies(:, k) = typologies
      end do
      united = count(population%is_several([(i, i=1, population%walls)]))
      kept = merge(size(share, 2), 0, keeps_changes)
      call check_room(real(size(share, 1)*8, wp)*real(2*united, wp)*real(states + 1, wp) &
         & + 16.0_wp*real(kept, wp)*real(united, wp)*real(states, wp), error)
      if (allocated(error)) return
      call share_clusters(clusters, runs, share)
      call self%errors%begin(self%typologies, population, share, error, keeps_changes)
      if (allocated(error)) return
      if (united > 0) call self%unions%reserve(united, size(share, 1), states, kept)
   end subroutine begin

   !> Share of all records that each cluster has and that run at each level
   pure subroutine share_clusters(clusters, runs, share)
      !> Number of the cluster of each record
      integer, intent(in) :: clusters(:)
      !> Whether a record runs at a level (records, levels)
      logical, intent(in) :: runs(:, :)
      !> Shares (levels, clusters)
      real(wp), intent(out) :: share(:, :)

      integer :: i, j

      share = 0.0_wp
      do j = 1, size(runs, 2)
         do i = 1, size(runs, 1)
            associate (g => clusters(i))
               if (runs(i, j)) share(j, g) = share(j, g) + 1.0_wp/real(size(runs, 1), wp)
            end associate
         end do
      end do
   end subroutine share_clusters

   !> Take the results of a row, in the order of rows
   subroutine add(self, row, name, population, change, error)
      class(population_curves_type), intent(inout) :: self
      !> What came of it
      type(row_result_type), intent(in) :: row
      !> Name of its wall, or of the facade
      character(len=*), intent(in) :: name
      !> The population: the standard errors of the curves of the row and, after its last row, of the wall are set
      type(population_type), intent(inout) :: population
      !> Change of ln theta and beta of the curve of the row in the last state if each cluster is left out (parameter, cluster)
      real(wp), intent(out) :: change(:, :)
      !> Counts that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      type(union_type) :: union
      integer :: wall, rows(2)

      wall = population%row(row%row)%wall
      rows = population%rows_of(population%rows + wall)
      associate (share => self%errors%share, states => size(population%curve, 1))
         if (row%row == rows(1)) then
            if (allocated(self%counts)) deallocate (self%counts)
            allocate (self%counts(size(share, 1), size(share, 2), states, rows(2) - rows(1) + 1))
         end if
         call count_clusters(self, row, population, self%counts(:, :, :, row%row - rows(1) + 1), change)
      end associate
      if (population%is_several(wall)) call self%builder%add(row, population%row(row%row)%p_occ, &
         & population%row(row%row)%alternative)
      if (row%row < rows(2)) return
      if (.not. population%is_several(wall)) then
         call self%errors%add(population, wall, self%counts)
         return
      end if
      self%united = self%united + 1
      call wall_union(union, self%builder, population, wall, self%clusters, self%runs, error)
      if (allocated(error)) return
      call self%errors%add(population, wall, self%counts, union%reached)
      union%name = name
      call self%unions%keep(self%united, wall, union)
      self%builder = union_builder_type()
   end subroutine add

   !> Count the histories of a row by clusters of records, and set the standard errors of its curves
   subroutine count_clusters(self, row, population, counts, change)
      class(population_curves_type), intent(in) :: self
      !> What came of the row
      type(row_result_type), intent(in) :: row
      !> The population: the standard errors of the row are set
      type(population_type), intent(inout) :: population
      !> Histories of each cluster that reach each state, over all records (levels, clusters, states)
      real(wp), intent(out) :: counts(:, :, :)
      !> Change of ln theta and beta in the last state if each cluster is left out (parameter, cluster)
      real(wp), intent(out) :: change(:, :)

      real(wp) :: histories(size(counts, 1), size(counts, 2))
      integer :: k

      do k = 1, size(counts, 3)
         call row%by_cluster(k, self%clusters, self%runs, counts(:, :, k), histories)
         call cluster_errors(population%curve(k, row%row), population%levels, counts(:, :, k), histories, change)
         counts(:, :, k) = counts(:, :, k)/real(row%histories, wp)
      end do
   end subroutine count_clusters

   !> All rows have been: set the standard errors of the curves of the population, and its unions
   subroutine finish(self, population, error)
      class(population_curves_type), intent(inout) :: self
      !> The population
      type(population_type), intent(in) :: population
      !> Fractions that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      call self%errors%finish(self%typologies)
      if (self%united == 0) return
      call mean_unions(self%unions, population, self%typologies, error)
      if (.not. allocated(error)) call self%errors%finish_means(self%unions, population)
   end subroutine finish

end module dondolo_population_curves
