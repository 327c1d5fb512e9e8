!> Typological fragility: the curves of a population of walls.
!>
!> The weighted mean of the walls' curves (the red line of figure 5 of Nale et al.), its fractiles, how much of the
!> scatter is between walls and how much between records, and a lognormal fitted to the mean: for each mechanism and for
!> all, for the whole population and for each of its groups (docs/theory.md, section 6).
module dondolo_typology
   use dondolo_error, only : error_type, raise_input
   use dondolo_fragility, only : fit_fragility, fragility_type
   use dondolo_kinds, only : wp
   use dondolo_limits, only : most_groups
   use dondolo_members, only : choose_members, members_type, population_probabilities
   use dondolo_population_counts, only : population_counts_type
   use dondolo_population_sums, only : add_group, group_type, sum_wall, sums_type
   use dondolo_roster, only : number_of_group
   use dondolo_text, only : to_text
   use dondolo_wall_curves, only : wall_curves_type
   implicit none
   private

   public :: typology_type, combine_population, whole_population, fractile_shares

   !> Shares of the weight that the fractiles stand for: the median, and one standard deviation of a normal variable
   real(wp), parameter :: fractile_shares(3) = [0.16_wp, 0.5_wp, 0.84_wp]
   !> A curve of a population, or of one of its groups
   type :: typology_type
      !> Name of the group, empty for the whole population
      character(len=:), allocatable :: group
      !> Mechanism, 'all' for whatever makes the walls collapse
      character(len=:), allocatable :: mechanism
      !> Levels of intensity
      real(wp), allocatable :: levels(:)
      !> Sum of the weights of the walls; of one mechanism each counts as often as it can occur
      real(wp) :: weight = 0.0_wp
      !> Number of walls
      integer :: walls = 0
      !> Weighted mean of the walls' fractions of collapse at each level
      real(wp), allocatable :: mean_fraction(:)
      !> Weighted mean of the walls' curves at each level
      real(wp), allocatable :: mean_curve(:)
      !> Probability that so much of the weight does not exceed (fractile_shares, levels)
      real(wp), allocatable :: fractile(:, :)
      !> What the mean curve tends to: share of the weight in which any mechanism can occur, 1 for one mechanism
      real(wp) :: saturation = 1.0_wp
      !> Dispersion between walls: weighted standard deviation of ln theta over the walls with a curve
      real(wp) :: beta_walls = 0.0_wp
      !> Dispersion between records: weighted root mean square of their beta
      real(wp) :: beta_records = 0.0_wp
      !> Share of what can occur that has a curve
      real(wp) :: fitted = 0.0_wp
      !> Histories that the fit counts at each level: number of walls by the weighted mean of their histories
      real(wp), allocatable :: histories(:)
      !> Lognormal fitted to the mean fractions / saturation; its standard errors are naive until those by records and
      !> walls are set (dondolo_population_errors)
      type(fragility_type) :: fit
   end type typology_type

contains

   !> Combine the walls of a population
   subroutine combine_population(typologies, population, state, error)
      !> The curves: those of the whole population, then those of each group in the order they appear in; mechanisms in
      !> the order they appear in, and 'all' last if several or if one may not occur
      type(typology_type), allocatable, intent(out) :: typologies(:)
      !> The population, fitted
      type(population_counts_type), intent(in) :: population
      !> Number of the damage state
      integer, intent(in) :: state
      !> Too many groups, no wall with a weight, fractions that cannot be fitted, or lack of memory
      type(error_type), allocatable, intent(out) :: error

      type(group_type), allocatable :: groups(:)
      type(members_type) :: members
      real(wp), allocatable :: p(:, :)
      integer :: i

      call population_probabilities(population, state, population%levels, p, error)
      if (.not. allocated(error)) call sum_population(groups, population, state, p, error)
      if (.not. allocated(error)) call make_curves(typologies, groups, population%levels, error)
      if (allocated(error)) return
      do i = 1, size(typologies)
         call choose_members(members, population, typologies(i)%mechanism, &
            & number_of_group(population%groups, typologies(i)%group))
         typologies(i)%fractile = members%fractiles(p, fractile_shares)
      end do
   end subroutine combine_population

   !> Sums over the walls of a population and of its groups
   subroutine sum_population(groups, population, state, p, error)
      !> The whole population, then its groups in the order they appear in; walls of no weight leave no trace
      type(group_type), allocatable, intent(out) :: groups(:)
      !> The population, fitted
      type(population_counts_type), intent(in) :: population
      !> Number of the damage state
      integer, intent(in) :: state
      !> Probabilities at the levels (levels, rows and then walls)
      real(wp), intent(in) :: p(:, :)
      !> Too many groups, no wall with a weight
      type(error_type), allocatable, intent(out) :: error

      type(wall_curves_type) :: wall
      integer, allocatable :: columns(:)
      integer :: place(0:population%groups%count), i, k, number

      allocate (groups(0))
      call add_group(groups, '', population%levels)
      place = 0
      do i = 1, population%walls()
         wall = population%wall(i, state)
         if (.not. wall%weight > 0.0_wp) cycle
         columns = [(k, k=population%first(i), population%first(i + 1) - 1), population%rows() + i]
         call sum_wall(groups(1), wall, population%levels, p(:, columns))
         number = population%group(population%first(i))
         if (number == 0) cycle
         if (place(number) == 0) then
            if (size(groups) > most_groups) then
               call raise_input(error, 'group = '''//wall%group//''': is one too many, at most '// &
                  & to_text(most_groups)//' are allowed')
               return
            end if
            call add_group(groups, wall%group, population%levels)
            place(number) = size(groups)
         end if
         call sum_wall(groups(place(number)), wall, population%levels, p(:, columns))
      end do
      if (groups(1)%all%walls == 0) call raise_input(error, 'weight: must be positive for at least one wall')
   end subroutine sum_population

   !> Which of the curves is that of the whole population, all mechanisms together
   pure integer function whole_population(typologies)
      type(typology_type), intent(in) :: typologies(:)

      do whole_population = 1, size(typologies) - 1
         if (len(typologies(whole_population + 1)%group) > 0) exit
      end do
   end function whole_population

   !> The curves out of the sums
   subroutine make_curves(typologies, groups, levels, error)
      !> The curves, without fractiles
      type(typology_type), allocatable, intent(out) :: typologies(:)
      !> The whole population and its groups
      type(group_type), intent(in) :: groups(:)
      !> Levels of intensity
      real(wp), intent(in) :: levels(:)
      !> Fractions that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      integer :: i, m, k

      allocate (typologies(sum([(size(groups(i)%mechanism), i=1, size(groups))]) &
         & + count([(groups(i)%has_all(), i=1, size(groups))])))
      k = 0
      do i = 1, size(groups)
         do m = 1, size(groups(i)%mechanism)
            k = k + 1
            call make_curve(typologies(k), groups(i)%name, groups(i)%mechanism(m), levels, error)
            if (allocated(error)) return
         end do
         if (.not. groups(i)%has_all()) cycle
         k = k + 1
         call make_curve(typologies(k), groups(i)%name, groups(i)%all, levels, error)
         if (allocated(error)) return
      end do
   end subroutine make_curves

   !> A curve out of its sums
   subroutine make_curve(curve, group, sums, levels, error)
      !> The curve, without fractiles
      type(typology_type), intent(out) :: curve
      !> Name of the group
      character(len=*), intent(in) :: group
      type(sums_type), intent(in) :: sums
      !> Levels of intensity
      real(wp), intent(in) :: levels(:)
      !> Fractions that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: share(size(levels))

      curve%group = group
      curve%mechanism = sums%mechanism
      curve%levels = levels
      curve%weight = sums%weight
      curve%walls = sums%walls
      ! Rounding must not leave more collapses than histories.
      curve%mean_fraction = min(sums%fraction/sums%weight, 1.0_wp)
      curve%mean_curve = min(sums%curve/sums%weight, 1.0_wp)
      curve%saturation = sums%occurring/sums%weight
      if (sums%occurring > 0.0_wp) curve%fitted = sums%fitted/sums%occurring
      if (sums%fitted > 0.0_wp) then
         curve%beta_walls = sqrt(max(sums%squares/sums%fitted, 0.0_wp))
         curve%beta_records = sqrt(sums%beta_squares/sums%fitted)
      end if
      curve%histories = real(sums%walls, wp)*(sums%histories/sums%weight)
      ! Divided first: where all that can collapse does, the share is 1 to the last bit and no survivor is made up.
      share = curve%mean_fraction
      if (curve%saturation > 0.0_wp) share = min(share/curve%saturation, 1.0_wp)
      call fit_fragility(curve%fit, levels, curve%histories*share, curve%histories, error)
   end subroutine make_curve

end module dondolo_typology
