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
   use dondolo_lines, only : line_type
   use dondolo_population_counts, only : population_counts_type
   use dondolo_roster, only : number_of_group
   use dondolo_row_result, only : row_result_type, shape_type
   use dondolo_typology, only : typology_type
   use dondolo_wall_curves, only : wall_curves_type
   implicit none
   private

   public :: union_type, unions_type, union_builder_type, wall_union, count_means, mean_unions

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

   !> The unions of a population. Of those of walls no more is kept than does not follow from the population: a large one
   !> has many
   type :: unions_type
      !> Number of the wall of each
      integer, allocatable :: wall(:)
      !> Names of the walls or facades
      type(line_type), allocatable :: name(:)
      !> Parts of the histories in which a state is reached (levels, states, unions)
      real(wp), allocatable :: fraction(:, :, :)
      !> Lognormals of each state (states, unions)
      type(fragility_type), allocatable :: curve(:, :)
      !> Means over the population and its groups
      type(union_type), allocatable :: mean(:)
   contains
      !> Make room for some
      procedure :: reserve
      !> Keep the union of a wall
      procedure :: keep
      !> How many there are, means included
      procedure :: count => count_unions
      !> Get one; the means stand behind the walls
      procedure :: get
   end type unions_type

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

   !> Make room for the unions of some walls
   subroutine reserve(self, number, levels, states, means)
      class(unions_type), intent(out) :: self
      !> How many walls, levels, damage states and means
      integer, intent(in) :: number, levels, states, means

      allocate (self%wall(number), self%name(number), self%fraction(levels, states, number), self%curve(states, number))
      allocate (self%mean(means))
   end subroutine reserve

   !> Keep the union of a wall
   subroutine keep(self, place, wall, union)
      class(unions_type), intent(inout) :: self
      !> Its place, and the number of its wall
      integer, intent(in) :: place, wall
      type(union_type), intent(in) :: union

      self%wall(place) = wall
      self%fraction(:, :, place) = union%fraction
      self%curve(:, place) = union%curve
   end subroutine keep

   !> How many unions there are, means included
   pure integer function count_unions(self) result(number)
      class(unions_type), intent(in) :: self

      number = 0
      if (allocated(self%wall)) number = size(self%wall) + size(self%mean)
   end function count_unions

   !> Get a union; the means stand behind the walls
   subroutine get(self, place, population, union)
      class(unions_type), intent(in) :: self
      !> Its place
      integer, intent(in) :: place
      !> The population, fitted
      type(population_counts_type), intent(in) :: population
      type(union_type), intent(out) :: union

      type(wall_curves_type) :: curves
      real(wp), allocatable :: together(:, :)
      integer :: k

      if (place > size(self%wall)) then
         union = self%mean(place - size(self%wall))
         return
      end if
      associate (wall => self%wall(place))
         union%rows = [population%first(wall), population%first(wall + 1) - 1]
         union%name = self%name(place)%text
         union%group = ''
         associate (number => population%group(population%first(wall)))
            if (number > 0) union%group = population%groups%line(number)%text
         end associate
         union%fraction = self%fraction(:, :, place)
         union%curve = self%curve(:, place)
         union%product = population%combined(:, wall)
         union%histories = real(minval(population%histories(:, union%rows(1):union%rows(2)), dim=2), wp)
         allocate (union%independent(size(union%fraction, 1), size(union%fraction, 2)))
         do k = 1, size(union%curve)
            curves = population%wall(wall, k)
            union%saturation = curves%occurrence()
            together = curves%fractions()
            union%independent(:, k) = together(:, size(together, 2))
         end do
      end associate
   end subroutine get

   !> Count and fit the union of the mechanisms of a wall
   subroutine wall_union(union, builder, population, wall, clusters, runs, error)
      !> The union: fractions and curves are set, what else it has follows from the population
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
      real(wp) :: changes(2, maxval(clusters)), all(size(runs, 2)), occurrence
      integer :: i, j, k, record

      allocate (union%fraction(size(runs, 2), size(builder%survival, 3)), union%curve(size(builder%survival, 3)))
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
         all = sum(histories, dim=2)
         curves = population%wall(wall, k)
         occurrence = curves%occurrence()
         union%fraction(:, k) = sum(counts, dim=2)/all
         if (occurrence > 0.0_wp) counts = counts/occurrence
         call fit_fragility(union%curve(k), population%levels, min(sum(counts, dim=2), all), all, error)
         if (allocated(error)) return
         call cluster_errors(union%curve(k), population%levels, counts, histories, changes)
      end do
   end subroutine wall_union

   !> How many means there are: of the population, and of its groups with walls of several mechanisms
   pure integer function count_means(population, typologies) result(number)
      !> The population
      type(population_counts_type), intent(in) :: population
      !> Its curves
      type(typology_type), intent(in) :: typologies(:)

      logical :: several(population%walls())
      integer :: i, group

      number = 0
      if (population%walls() == 1) return
      several = population%first(2:) - population%first(:population%walls()) > 1
      do i = 1, size(typologies)
         if (typologies(i)%mechanism /= 'all') cycle
         group = number_of_group(population%groups, typologies(i)%group)
         if (any(several .and. (group == 0 .or. population%group(population%first(:population%walls())) == group))) then
            number = number + 1
         end if
      end do
   end function count_means

   !> Weighted means of the unions of the walls of a population and of its groups
   subroutine mean_unions(unions, population, typologies, error)
      !> Unions of the walls with several mechanisms, in the order of walls: their means, as many as count_means says, are
      !> set, with naive standard errors
      type(unions_type), intent(inout) :: unions
      !> The population, fitted
      type(population_counts_type), intent(in) :: population
      !> Curves of the population and of its groups (curves, states), 'all' among them where walls have several mechanisms
      type(typology_type), intent(in) :: typologies(:, :)
      !> Fractions that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: sums(size(population%levels), size(typologies, 2), 0:population%groups%count)
      real(wp) :: weight(0:population%groups%count)
      logical :: has_union(0:population%groups%count)
      integer :: i, k, number

      call sum_unions(unions, population, sums, weight, has_union)
      k = 0
      do i = 1, size(typologies, 1)
         number = number_of_group(population%groups, typologies(i, 1)%group)
         if (typologies(i, 1)%mechanism /= 'all' .or. .not. has_union(number)) cycle
         k = k + 1
         call fit_mean(unions%mean(k), sums(:, :, number)/weight(number), typologies(i, :), population%levels, error)
         if (allocated(error)) return
      end do
   end subroutine mean_unions

   !> Sums of weights and of weighted fractions over the walls of a population and of its groups
   subroutine sum_unions(unions, population, sums, weight, has_union)
      !> Unions of the walls with several mechanisms, in the order of walls
      type(unions_type), intent(in) :: unions
      !> The population, fitted
      type(population_counts_type), intent(in) :: population
      !> Sum of weight and fraction (levels, states, groups from 0, the population)
      real(wp), intent(out) :: sums(:, :, 0:)
      !> Sum of the weights
      real(wp), intent(out) :: weight(0:)
      !> Has a wall several mechanisms?
      logical, intent(out) :: has_union(0:)

      type(wall_curves_type) :: wall
      real(wp), allocatable :: together(:, :)
      real(wp) :: share(size(sums, 1), size(sums, 2))
      integer :: i, k, next, group
      logical :: several

      sums = 0.0_wp
      weight = 0.0_wp
      has_union = .false.
      next = 1
      do i = 1, population%walls()
         several = population%first(i + 1) - population%first(i) > 1
         if (several) then
            share = unions%fraction(:, :, next)
            next = next + 1
         else
            do k = 1, size(sums, 2)
               wall = population%wall(i, k)
               together = wall%fractions()
               share(:, k) = together(:, size(together, 2))
            end do
         end if
         group = population%group(population%first(i))
         associate (own => population%weight(population%first(i)))
            weight(0) = weight(0) + own
            sums(:, :, 0) = sums(:, :, 0) + own*share
            has_union(0) = has_union(0) .or. several
            if (group == 0) cycle
            weight(group) = weight(group) + own
            sums(:, :, group) = sums(:, :, group) + own*share
            has_union(group) = has_union(group) .or. several
         end associate
      end do
   end subroutine sum_unions

   !> Fit a mean
   subroutine fit_mean(union, fraction, typologies, levels, error)
      !> The mean
      type(union_type), intent(out) :: union
      !> Its fractions (levels, states)
      real(wp), intent(in) :: fraction(:, :)
      !> Curves of the same walls, all mechanisms independent (states)
      type(typology_type), intent(in) :: typologies(:)
      !> Levels of intensity
      real(wp), intent(in) :: levels(:)
      !> Fractions that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: share(size(levels))
      integer :: k

      union%name = ''
      union%group = typologies(1)%group
      ! Rounding must not leave more collapses than histories.
      union%fraction = min(fraction, 1.0_wp)
      union%histories = typologies(1)%histories
      union%saturation = typologies(1)%saturation
      union%product = typologies%fit
      allocate (union%curve(size(typologies)), union%independent(size(levels), size(typologies)))
      do k = 1, size(typologies)
         union%independent(:, k) = typologies(k)%mean_fraction
         share = union%fraction(:, k)
         if (union%saturation > 0.0_wp) share = min(share/union%saturation, 1.0_wp)
         call fit_fragility(union%curve(k), levels, union%histories*share, union%histories, error)
         if (allocated(error)) return
      end do
   end subroutine fit_mean

end module dondolo_unions
