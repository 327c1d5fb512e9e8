!> Walls and facades whose mechanisms share their records: how often any of them collapses, counted history by history.
!>
!> A record brings several mechanisms of a facade down together, or none. The product of their probabilities takes them as
!> independent given the intensity, and overstates; the union counts a history, of a record, polarity and level, as soon as
!> one of the mechanisms reaches the state in it. With p_m the probability that mechanism m can occur, and F_mh its flag,
!> history h counts 1 - prod_m (1 - p_m F_mh). Of alternatives a, of which one occurs with the probability p_a, it counts
!> sum_a p_a (1 - prod_m (1 - F_mh)) (docs/theory.md, section 6).
module dondolo_population_unions
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : line_type
   use dondolo_fragility, only : fit_fragility, fragility_type
   use dondolo_fragility_clustered, only : cluster_errors
   use dondolo_population, only : part_type, population_type
   use dondolo_population_occurrence, only : fit_share
   use dondolo_population_row_result, only : row_result_type
   use dondolo_population_typology, only : typology_type
   use dondolo_population_weights, only : weights_type
   implicit none
   private

   public :: union_type, unions_type, union_builder_type, wall_union, mean_unions, curves_with_mean

   !> Fractions of a wall with several mechanisms, or means over a population or a group
   type :: union_type
      !> Name of the wall or the facade; empty for a mean
      character(len=:), allocatable :: name
      !> Name of the group, empty if none
      character(len=:), allocatable :: group
      !> First and last row of the wall; 0 for a mean
      integer :: rows(2) = 0
      !> Histories of each stripe (levels), and of a wall how many of them reach a state (levels, states)
      real(wp), allocatable :: histories(:), collapses(:, :)
      !> Part of them in which a state is reached, by the same histories, and by the product (levels, states)
      real(wp), allocatable :: fraction(:, :), independent(:, :)
      !> Probability that any mechanism can occur
      real(wp) :: upper_asymptote = 1.0_wp
      !> Lognormals of each state, fitted to both, divided by the upper asymptote
      type(fragility_type), allocatable :: curve(:), product(:)
      !> Histories of each cluster of records in which each state is reached, over all histories of a stripe (levels, clusters,
      !> states), and change of ln theta and beta of each curve if each cluster is left out (parameter, cluster, state): of a
      !> wall that has just been counted
      real(wp), allocatable :: reached(:, :, :), change(:, :, :)
   end type union_type

   !> The unions of a population. Of those of walls no more is kept than does not follow from the population: a large one
   !> has many
   type :: unions_type
      !> Number of the wall of each
      integer, allocatable :: wall(:)
      !> Names of the walls or facades
      type(line_type), allocatable :: name(:)
      !> Histories of each stripe (levels, unions), and how many of them reach a state (levels, states, unions)
      real(wp), allocatable :: histories(:, :), collapses(:, :, :)
      !> Lognormals of each state (states, unions)
      type(fragility_type), allocatable :: curve(:, :)
      !> Change of ln theta and beta if each cluster of records is left out (parameter, cluster, state, union), if it is kept
      real(wp), allocatable :: change(:, :, :, :)
      !> Means over the population and its groups
      type(union_type), allocatable :: mean(:)
   contains
      !> Make room for some
      procedure :: reserve
      !> Keep the union of a wall
      procedure :: keep
      !> Take those of another, which has none afterwards
      procedure :: take
      !> How many there are, means included
      procedure :: count => count_unions
      !> Get one; the means come after the walls
      procedure :: get
      !> Part of the histories of a wall in which a state is reached
      procedure :: fraction => fraction_of_wall
   end type unions_type

   !> The mechanisms of a wall, one after the other
   type :: union_builder_type
      !> Probability that the wall does not reach a state in a history (histories, levels, states)
      real(wp), allocatable :: survival(:, :, :)
      !> The alternative that the last mechanism belongs to, 0 if they are independent, and whether one of its mechanisms
      !> reaches the state (histories, levels, states)
      integer, private :: alternative = 0
      logical, allocatable, private :: is_reached(:, :, :)
   contains
      !> Add a mechanism
      procedure :: add
   end type union_builder_type

contains

   !> Add a mechanism
   pure subroutine add(self, row, p_occ, alternative)
      class(union_builder_type), intent(inout) :: self
      !> What came of its row
      type(row_result_type), intent(in) :: row
      !> Probability that it can occur
      real(wp), intent(in) :: p_occ
      !> Its alternative, 0 if the mechanisms of the wall are independent
      integer, intent(in) :: alternative

      logical :: reaches(size(row%flags, 2), size(row%flags, 3))
      integer :: i, n

      if (.not. allocated(self%survival)) allocate (self%survival(row%histories, size(row%flags, 2), size(row%flags, 3)), &
         & source=1.0_wp)
      ! A wall that is the same from both sides runs each record once: reversed it ends alike.
      n = size(self%survival, 1)
      if (row%histories > n) self%survival = self%survival([(modulo(i - 1, n) + 1, i=1, row%histories)], :, :)
      if (alternative > 0) then
         if (alternative == self%alternative .and. row%histories > n) then
            self%is_reached = self%is_reached([(modulo(i - 1, n) + 1, i=1, row%histories)], :, :)
         else if (alternative /= self%alternative) then
            self%is_reached = spread(spread(spread(.false., 1, size(self%survival, 1)), 2, size(reaches, 1)), 3, size(reaches, 2))
         end if
      end if
      self%alternative = alternative
      do i = 1, size(self%survival, 1)
         reaches = row%flags(modulo(i - 1, row%histories) + 1, :, :)
         if (alternative == 0) then
            where (reaches) self%survival(i, :, :) = (1.0_wp - p_occ)*self%survival(i, :, :)
         else
            where (reaches .and. .not. self%is_reached(i, :, :)) self%survival(i, :, :) = self%survival(i, :, :) - p_occ
            self%is_reached(i, :, :) = self%is_reached(i, :, :) .or. reaches
         end if
      end do
   end subroutine add

   !> Make room for the unions of some walls
   subroutine reserve(self, number, levels, states, clusters)
      class(unions_type), intent(out) :: self
      !> How many walls, levels and damage states, and clusters of records whose changes are kept
      integer, intent(in) :: number, levels, states, clusters

      allocate (self%wall(number), self%name(number), self%histories(levels, number), self%collapses(levels, states, number), &
         & self%curve(states, number), self%change(2, clusters, states, number))
   end subroutine reserve

   !> Keep the union of a wall
   subroutine keep(self, place, wall, union)
      class(unions_type), intent(inout) :: self
      !> Its place, and the number of its wall
      integer, intent(in) :: place, wall
      type(union_type), intent(in) :: union

      self%wall(place) = wall
      self%name(place)%text = union%name
      self%histories(:, place) = union%histories
      self%collapses(:, :, place) = union%collapses
      self%curve(:, place) = union%curve
      self%change(:, :, :, place) = union%change(:, :size(self%change, 2), :)
   end subroutine keep

   !> Take the unions of another, which has none afterwards: two of them at once would not fit where one does
   subroutine take(self, other)
      class(unions_type), intent(out) :: self
      class(unions_type), intent(inout) :: other

      call move_alloc(other%wall, self%wall)
      call move_alloc(other%name, self%name)
      call move_alloc(other%histories, self%histories)
      call move_alloc(other%collapses, self%collapses)
      call move_alloc(other%curve, self%curve)
      call move_alloc(other%change, self%change)
      call move_alloc(other%mean, self%mean)
   end subroutine take

   !> How many unions there are, means included
   pure integer function count_unions(self) result(number)
      class(unions_type), intent(in) :: self

      number = 0
      if (allocated(self%mean)) number = size(self%wall) + size(self%mean)
   end function count_unions

   !> Get a union; the means come after the walls
   subroutine get(self, place, population, union)
      class(unions_type), intent(in) :: self
      !> Its place
      integer, intent(in) :: place
      !> The population, fitted
      type(population_type), intent(in) :: population
      type(union_type), intent(out) :: union

      integer :: k, column

      if (place > size(self%wall)) then
         union = self%mean(place - size(self%wall))
         return
      end if
      column = population%rows + self%wall(place)
      union%rows = population%rows_of(column)
      union%name = self%name(place)%text
      union%group = ''
      associate (group => population%row(union%rows(1))%group)
         if (group > 0) union%group = population%groups%line(group)%text
      end associate
      union%histories = self%histories(:, place)
      union%collapses = self%collapses(:, :, place)
      union%curve = self%curve(:, place)
      union%product = population%curve(:, population%place(column))
      union%upper_asymptote = population%occurrence(column)
      allocate (union%fraction, mold=union%collapses)
      allocate (union%independent, mold=union%collapses)
      do k = 1, size(union%curve)
         union%fraction(:, k) = self%fraction(place, k)
         union%independent(:, k) = population%fraction(column, k)
      end do
   end subroutine get

   !> Part of the histories of a wall in which a state is reached
   pure function fraction_of_wall(self, place, state) result(fraction)
      class(unions_type), intent(in) :: self
      !> Place of its union, and number of the state
      integer, intent(in) :: place, state
      real(wp) :: fraction(size(self%histories, 1))

      fraction = self%collapses(:, state, place)/self%histories(:, place)
   end function fraction_of_wall

   !> Count and fit the union of the mechanisms of a wall
   subroutine wall_union(union, builder, population, wall, clusters, runs, error)
      !> The union: counts and curves are set, what else it has but its name follows from the population
      type(union_type), intent(out) :: union
      !> All mechanisms of the wall
      type(union_builder_type), intent(in) :: builder
      !> The population, fitted
      type(population_type), intent(in) :: population
      !> Number of the wall
      integer, intent(in) :: wall
      !> Number of the cluster of each record
      integer, intent(in) :: clusters(:)
      !> Whether a record runs at a level (records, levels)
      logical, intent(in) :: runs(:, :)
      !> Counts that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      real(wp), dimension(size(runs, 2), maxval(clusters)) :: counts, histories
      real(wp) :: occurrence
      integer :: i, j, k, record

      occurrence = population%occurrence(population%rows + wall)
      associate (states => size(builder%survival, 3))
         allocate (union%collapses(size(runs, 2), states), union%curve(states), union%change(2, size(counts, 2), states), &
            & union%reached(size(counts, 1), size(counts, 2), states))
      end associate
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
         union%collapses(:, k) = sum(counts, dim=2)
         union%reached(:, :, k) = counts/real(size(builder%survival, 1), wp)
         if (occurrence > 0.0_wp) counts = counts/occurrence
         associate (all => union%histories, collapses => union%collapses(:, k)/merge(occurrence, 1.0_wp, occurrence > 0.0_wp))
            call fit_fragility(union%curve(k), population%levels, min(collapses, all), all, error)
         end associate
         if (allocated(error)) return
         call cluster_errors(union%curve(k), population%levels, counts, histories, union%change(:, :, k))
      end do
   end subroutine wall_union

   !> Number of the curve that is of the same walls as each mean: of the population, and of its groups with walls of several
   !> mechanisms
   pure function curves_with_mean(population, typologies) result(numbers)
      !> The population
      type(population_type), intent(in) :: population
      !> Its curves
      type(typology_type), intent(in) :: typologies(:)
      !> Numbers among them; none for one wall
      integer, allocatable :: numbers(:)

      logical :: has_mean(size(typologies))
      integer :: i

      has_mean = .false.
      do i = 1, population%walls
         if (.not. population%is_several(i)) cycle
         associate (group => population%row(population%first(i))%group)
            has_mean = has_mean .or. typologies%part%group == 0 .or. typologies%part%group == group
         end associate
      end do
      has_mean = has_mean .and. typologies%part%mechanism == 0 .and. population%walls > 1
      numbers = pack([(i, i=1, size(typologies))], has_mean)
   end function curves_with_mean

   !> Weighted means of the unions of the walls of a population and of its groups
   subroutine mean_unions(unions, population, typologies, error)
      !> Unions of the walls with several mechanisms, in the order of walls: their means are set; their standard errors are
      !> naive until those by records and walls are set (dondolo_population_errors)
      type(unions_type), intent(inout) :: unions
      !> The population, fitted
      type(population_type), intent(in) :: population
      !> Curves of the population and of its groups (curves, states), 'all' among them where walls have several mechanisms
      type(typology_type), intent(in) :: typologies(:, :)
      !> Fractions that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      integer, allocatable :: curves(:)
      integer :: i, k

      curves = curves_with_mean(population, typologies(:, 1))
      allocate (unions%mean(size(curves)))
      do i = 1, size(curves)
         call begin_mean(unions%mean(i), typologies(curves(i), :))
         do k = 1, size(typologies, 2)
            associate (mean => unions%mean(i))
               mean%fraction(:, k) = mean_fraction(unions, population, typologies(curves(i), k)%part, k)
               call fit_share(mean%curve(k), population%levels, mean%fraction(:, k), mean%upper_asymptote, mean%histories, error)
            end associate
            if (allocated(error)) return
         end do
      end do
   end subroutine mean_unions

   !> Weighted mean of the fractions of the walls of a part: of those with several mechanisms, of their unions
   function mean_fraction(unions, population, part, state) result(mean)
      type(unions_type), intent(in) :: unions
      !> The population, fitted
      type(population_type), intent(in) :: population
      !> The walls as a whole, of a group or of all
      type(part_type), intent(in) :: part
      !> Number of the state
      integer, intent(in) :: state
      !> Mean at each level
      real(wp) :: mean(size(population%levels))

      type(weights_type) :: weights
      integer :: i, united

      call weights%take(population, part)
      united = 0
      mean = 0.0_wp
      do i = 1, size(weights%column)
         associate (wall => weights%column(i) - population%rows)
            if (.not. population%is_several(wall)) then
               mean = mean + weights%weight(i)*population%fraction(weights%column(i), state)
               cycle
            end if
            ! Unions stand in the order of walls, and each of them with several mechanisms has one.
            united = united + findloc(unions%wall(united + 1:), wall, dim=1)
         end associate
         mean = mean + weights%weight(i)*unions%fraction(united, state)
      end do
      ! Rounding must not leave more collapses than histories.
      mean = min(mean/sum(weights%weight), 1.0_wp)
   end function mean_fraction

   !> Begin a mean
   subroutine begin_mean(union, typologies)
      !> The mean: all but its fractions and their curves are set
      type(union_type), intent(out) :: union
      !> Curves of the same walls, all mechanisms independent (states)
      type(typology_type), intent(in) :: typologies(:)

      integer :: k

      union%name = ''
      union%group = typologies(1)%group
      union%histories = typologies(1)%histories
      union%upper_asymptote = typologies(1)%upper_asymptote
      union%product = typologies%fit
      allocate (union%fraction(size(union%histories), size(typologies)), union%independent(size(union%histories), size(typologies)))
      allocate (union%curve(size(typologies)))
      do k = 1, size(typologies)
         union%independent(:, k) = typologies(k)%mean_fraction
      end do
   end subroutine begin_mean

end module dondolo_population_unions
