!> Walls and facades whose mechanisms share their records: how often any of them collapses, counted history by history.
!>
!> A record brings several mechanisms of a facade down together, or none. The product of their probabilities takes them as
!> independent given the intensity, and overstates; the union counts a history, of a record, polarity and level, as soon as
!> one of the mechanisms reaches the state in it. With p_m the probability that mechanism m can occur, and F_mh its flag,
!> history h counts 1 - prod_m (1 - p_m F_mh) (docs/theory.md, section 6).
module dondolo_unions
   use dondolo_clustered, only : cluster_errors
   use dondolo_error, only : error_type
   use dondolo_fragility, only : fit_fragility, fragility_type
   use dondolo_kinds, only : wp
   use dondolo_population_counts, only : population_counts_type
   use dondolo_row_result, only : row_result_type, shape_type
   use dondolo_typology, only : typology_type
   use dondolo_wall_curves, only : wall_curves_type
   implicit none
   private

   public :: union_type, union_builder_type, wall_union, mean_union

   !> Fractions of a wall with several mechanisms, or means over a population or a group
   type :: union_type
      !> Name of the wall or the facade; empty for a mean
      character(len=:), allocatable :: name
      !> Name of the group, empty if none
      character(len=:), allocatable :: group
      !> First and last row of the wall; 0 for a mean
      integer :: rows(2) = 0
      !> Histories of each stripe (levels)
      real(wp), allocatable :: histories(:)
      !> Part of them in which a state is reached, by the same histories, and by the product (levels, states)
      real(wp), allocatable :: fraction(:, :), independent(:, :)
      !> Probability that any mechanism can occur
      real(wp) :: saturation = 1.0_wp
      !> Lognormals of each state, fitted to both, divided by the saturation
      type(fragility_type), allocatable :: curve(:), product(:)
   end type union_type

   !> The mechanisms of a wall, one after the other
   type :: union_builder_type
      !> Probability that the wall does not reach a state in a history (histories, levels, states)
      real(wp), allocatable :: survival(:, :, :)
   contains
      !> Add a mechanism
      procedure :: add
   end type union_builder_type

contains

   !> Add a mechanism
   pure subroutine add(self, row, p_occ, shape)
      class(union_builder_type), intent(inout) :: self
      !> What came of its row
      type(row_result_type), intent(in) :: row
      !> Probability that it can occur
      real(wp), intent(in) :: p_occ
      !> How many levels and states there are
      type(shape_type), intent(in) :: shape

      logical :: flags(row%histories, shape%levels, shape%states)
      integer :: i, n

      call row%unpack_flags(flags)
      if (.not. allocated(self%survival)) then
         allocate (self%survival(row%histories, shape%levels, shape%states), source=1.0_wp)
      end if
      ! A wall that is the same from both sides runs each record once: reversed it ends alike.
      n = size(self%survival, 1)
      if (row%histories > n) self%survival = self%survival([(modulo(i - 1, n) + 1, i=1, row%histories)], :, :)
      do i = 1, size(self%survival, 1)
         where (flags(modulo(i - 1, row%histories) + 1, :, :)) self%survival(i, :, :) = (1.0_wp - p_occ)*self%survival(i, :, :)
      end do
   end subroutine add

   !> Count and fit the union of the mechanisms of a wall
   subroutine wall_union(union, builder, population, wall, clusters, runs, error)
      !> The union; its name and group are not set
      type(union_type), intent(out) :: union
      !> All mechanisms of the wall
      type(union_builder_type), intent(in) :: builder
      !> The population, fitted
      type(population_counts_type), intent(in) :: population
      !> Number of the wall
      integer, intent(in) :: wall
      !> Number of the cluster of each record
      integer, intent(in) :: clusters(:)
      !> Whether a record runs at a level (records, levels)
      logical, intent(in) :: runs(:, :)
      !> Counts that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      type(wall_curves_type) :: curves
      real(wp), dimension(size(runs, 2), maxval(clusters)) :: counts, histories
      real(wp) :: changes(2, maxval(clusters)), together(size(runs, 2), population%first(wall + 1) - population%first(wall) + 1)
      integer :: i, j, k, record

      union%rows = [population%first(wall), population%first(wall + 1) - 1]
      associate (levels => size(runs, 2), states => size(builder%survival, 3))
         allocate (union%histories(levels), union%fraction(levels, states), union%independent(levels, states))
         allocate (union%curve(states))
      end associate
      union%product = population%combined(:, wall)
      do k = 1, size(union%curve)
         counts = 0.0_wp
         histories = 0.0_wp
         do j = 1, size(runs, 2)
            do i = 1, size(builder%survival, 1)
               record = modulo(i - 1, size(clusters)) + 1
               if (.not. runs(record, j)) cycle
               associate (g => clusters(record))
                  histories(j, g) = histories(j, g) + 1.0_wp
                  counts(j, g) = counts(j, g) + 1.0_wp - builder%survival(i, j, k)
               end associate
            end do
         end do
         union%histories = sum(histories, dim=2)
         curves = population%wall(wall, k)
         union%saturation = curves%occurrence()
         union%fraction(:, k) = sum(counts, dim=2)/union%histories
         together = curves%fractions()
         union%independent(:, k) = together(:, size(together, 2))
         if (union%saturation > 0.0_wp) counts = counts/union%saturation
         call fit_fragility(union%curve(k), population%levels, min(sum(counts, dim=2), union%histories), union%histories, error)
         if (allocated(error)) return
         call cluster_errors(union%curve(k), population%levels, counts, histories, changes)
      end do
   end subroutine wall_union

   !> Weighted mean of the unions of the walls of a population or of a group
   subroutine mean_union(union, unions, population, group, typologies, error)
      !> The mean, with naive standard errors; without curves if no wall has several mechanisms
      type(union_type), intent(out) :: union
      !> Unions of the walls with several mechanisms, in the order of walls
      type(union_type), intent(in) :: unions(:)
      !> The population, fitted
      type(population_counts_type), intent(in) :: population
      !> Number of the group, 0: all walls
      integer, intent(in) :: group
      !> Curves of the same walls, all mechanisms independent (states)
      type(typology_type), intent(in) :: typologies(:)
      !> Fractions that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      type(wall_curves_type) :: wall
      real(wp), allocatable :: together(:, :)
      real(wp) :: weight, share(size(population%levels))
      integer :: i, k, next, found

      union%name = ''
      union%group = typologies(1)%group
      found = 0
      allocate (union%fraction(size(population%levels), size(typologies)), source=0.0_wp)
      do k = 1, size(typologies)
         weight = 0.0_wp
         next = 1
         do i = 1, population%walls()
            wall = population%wall(i, k)
            together = wall%fractions()
            share = together(:, size(together, 2))
            if (next <= size(unions)) then
               if (unions(next)%rows(1) == population%first(i)) then
                  share = unions(next)%fraction(:, k)
                  next = next + 1
                  if (group == 0 .or. population%group(population%first(i)) == group) found = found + 1
               end if
            end if
            if (group > 0 .and. population%group(population%first(i)) /= group) cycle
            weight = weight + wall%weight
            union%fraction(:, k) = union%fraction(:, k) + wall%weight*share
         end do
         union%fraction(:, k) = min(union%fraction(:, k)/weight, 1.0_wp)
      end do
      if (found == 0) return
      union%histories = typologies(1)%histories
      union%saturation = typologies(1)%saturation
      union%product = typologies%fit
      allocate (union%curve(size(typologies)), union%independent(size(population%levels), size(typologies)))
      do k = 1, size(typologies)
         union%independent(:, k) = typologies(k)%mean_fraction
         share = union%fraction(:, k)
         if (union%saturation > 0.0_wp) share = min(share/union%saturation, 1.0_wp)
         call fit_fragility(union%curve(k), population%levels, union%histories*share, union%histories, error)
         if (allocated(error)) return
      end do
   end subroutine mean_union

end module dondolo_unions
