!> Typological fragility: the curves of a population of walls.
!>
!> The weighted mean of the walls' curves (the red line of figure 5 of Nale et al.), its fractiles, how much of the
!> scatter is between walls and how much between records, and a lognormal fitted to the mean: for each mechanism and for
!> all, for the whole population and for each of its groups (docs/theory.md, section 6). Each is the curve of a part of
!> the population, and all its numbers are weighted means over its rows or walls.
module dondolo_population_typology
   use dondolo_base_error, only : error_type, out_of_range, raise_input
   use dondolo_base_invariant, only : are_probabilities, assert, checked
   use dondolo_base_kinds, only : wp
   use dondolo_base_limits, only : most_groups
   use dondolo_base_text, only : to_text
   use dondolo_fragility, only : fragility_type
   use dondolo_population, only : part_type, population_type
   use dondolo_population_occurrence, only : fit_share
   use dondolo_population_weights, only : weights_type
   use dondolo_wall, only : mechanism_names
   implicit none
   private

   public :: typology_type, combine_population, whole_population, fractile_shares

   !> Shares of the weight that the fractiles stand for: the median, and one standard deviation of a normal variable
   real(wp), parameter :: fractile_shares(3) = [0.16_wp, 0.5_wp, 0.84_wp]
   !> A curve of a population, or of one of its groups
   type :: typology_type
      !> The part of the population that it is of
      type(part_type) :: part
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
      real(wp) :: upper_asymptote = 1.0_wp
      !> Dispersion between walls: weighted standard deviation of ln theta over the walls with a curve
      real(wp) :: beta_walls = 0.0_wp
      !> Dispersion between records: weighted root mean square of their beta
      real(wp) :: beta_records = 0.0_wp
      !> Share of what can occur that has a curve
      real(wp) :: fitted = 0.0_wp
      !> Histories that the fit counts at each level: number of walls by the weighted mean of their histories
      real(wp), allocatable :: histories(:)
      !> Lognormal fitted to the mean fractions / upper asymptote; its standard errors are naive until those by records and
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
      type(population_type), intent(in) :: population
      !> Number of the damage state
      integer, intent(in) :: state
      !> Too many groups, no wall with a weight, fractions that cannot be fitted, or lack of memory
      type(error_type), allocatable, intent(out) :: error

      type(part_type), allocatable :: parts(:)
      integer :: i

      call list_parts(parts, population, error)
      if (allocated(error)) return
      allocate (typologies(size(parts)))
      do i = 1, size(parts)
         call make_curve(typologies(i), population, parts(i), state, error)
         if (allocated(error)) return
      end do
   end subroutine combine_population

   !> List the parts of a population that have curves
   subroutine list_parts(parts, population, error)
      !> The parts, in the order of their curves; walls of no weight leave no trace
      type(part_type), allocatable, intent(out) :: parts(:)
      type(population_type), intent(in) :: population
      !> Too many groups, no wall with a weight
      type(error_type), allocatable, intent(out) :: error

      integer :: groups(0:most_groups), mechanism(size(mechanism_names), 0:population%groups%count)
      integer :: mechanisms(0:population%groups%count), i, k, g, last
      logical :: is_mixed(0:population%groups%count)

      groups = 0
      last = 0
      mechanisms = 0
      is_mixed = .false.
      do i = 1, population%rows
         associate (row => population%row(i))
            if (.not. row%weight > 0.0_wp) cycle
            if (row%group > 0 .and. all(groups(1:last) /= row%group)) then
               if (last == most_groups) then
                  call raise_input(error, 'group = '''//population%groups%line(row%group)%text// &
                     & ''': too many groups, at most '//to_text(most_groups)//' are allowed', out_of_range, 'group')
                  return
               end if
               last = last + 1
               groups(last) = row%group
            end if
            ! Of the whole population, and of the group
            do g = 0, row%group, max(row%group, 1)
               is_mixed(g) = is_mixed(g) .or. row%p_occ < 1.0_wp .or. population%is_several(row%wall)
               if (.not. population%weight_in(part_type(row%mechanism, g), i) > 0.0_wp) cycle
               if (any(mechanism(:mechanisms(g), g) == row%mechanism)) cycle
               mechanisms(g) = mechanisms(g) + 1
               mechanism(mechanisms(g), g) = row%mechanism
            end do
         end associate
      end do
      if (.not. any(population%row%weight > 0.0_wp)) call raise_input(error, 'weight: must be positive for at least one wall', &
         & out_of_range, 'weight')
      parts = [part_type ::]
      do i = 0, last
         g = groups(i)
         parts = [parts, (part_type(mechanism(k, g), g), k=1, mechanisms(g))]
         if (mechanisms(g) > 1 .or. is_mixed(g)) parts = [parts, part_type(0, g)]
      end do
   end subroutine list_parts

   !> Make the curve of a part
   subroutine make_curve(curve, population, part, state, error)
      type(typology_type), intent(out) :: curve
      !> The population, fitted
      type(population_type), intent(in) :: population
      type(part_type), intent(in) :: part
      !> Number of the damage state
      integer, intent(in) :: state
      !> Fractions that cannot be fitted, or lack of memory
      type(error_type), allocatable, intent(out) :: error

      type(weights_type) :: weights
      real(wp), allocatable :: p(:, :)
      integer :: first, last

      call weights%take(population, part)
      curve%part = part
      curve%group = ''
      if (part%group > 0) curve%group = population%groups%line(part%group)%text
      curve%mechanism = 'all'
      if (part%mechanism > 0) curve%mechanism = trim(mechanism_names(part%mechanism))
      curve%levels = population%levels
      curve%walls = size(weights%column)
      curve%weight = sum(weights%weight)
      allocate (curve%mean_curve(size(curve%levels)), curve%fractile(size(fractile_shares), size(curve%levels)))
      call sum_columns(curve, population, weights, state)
      call fit_share(curve%fit, curve%levels, curve%mean_fraction, curve%upper_asymptote, curve%histories, error)
      do first = 1, size(curve%levels), weights%levels_at_a_time()
         if (allocated(error)) return
         last = min(first + weights%levels_at_a_time() - 1, size(curve%levels))
         call population%probabilities(state, weights%column, curve%levels(first:last), p, error)
         if (allocated(error)) return
         curve%mean_curve(first:last) = weights%mean(p)
         curve%fractile(:, first:last) = weights%fractiles(p, fractile_shares)
      end do
   end subroutine make_curve

   !> Set the fractions of a part, what can occur in it, what has a curve, how its curves scatter, and its histories
   pure subroutine sum_columns(curve, population, weights, state)
      !> The curve: its weight and its number of walls are known
      type(typology_type), intent(inout) :: curve
      !> The population, fitted
      type(population_type), intent(in) :: population
      !> Weights of the part
      type(weights_type), intent(in) :: weights
      !> Number of the damage state
      integer, intent(in) :: state

      real(wp) :: share, occurring, fitted, centre, distance, squares, beta_squares
      integer :: i

      occurring = 0.0_wp
      fitted = 0.0_wp
      centre = 0.0_wp
      squares = 0.0_wp
      beta_squares = 0.0_wp
      allocate (curve%histories(size(population%levels)), curve%mean_fraction(size(population%levels)), source=0.0_wp)
      do i = 1, size(weights%column)
         associate (column => weights%column(i), weight => weights%weight(i), &
            & fit => population%curve(state, population%place(weights%column(i))))
            curve%mean_fraction = curve%mean_fraction + weight*population%fraction(column, state)
            curve%histories = curve%histories + weight*real(population%histories_of(column), wp)
            share = weight*population%occurrence(column)
            occurring = occurring + share
            if (.not. fit%has_fit()) cycle
            fitted = fitted + share
            ! The mean moves on with every wall, and the squares with it (West 1979): no difference of large sums.
            distance = log(fit%theta) - centre
            centre = centre + distance*share/fitted
            squares = squares + share*distance*(log(fit%theta) - centre)
            beta_squares = beta_squares + share*fit%beta**2
         end associate
      end do
      ! Rounding must not leave more collapses than histories.
      curve%mean_fraction = min(curve%mean_fraction/curve%weight, 1.0_wp)
      curve%histories = real(curve%walls, wp)*(curve%histories/curve%weight)
      curve%upper_asymptote = occurring/curve%weight
      if (checked) call assert(are_probabilities(curve%mean_fraction) .and. are_probabilities([curve%upper_asymptote]), &
         & 'fractions of a population lie in [0, 1]')
      if (occurring > 0.0_wp) curve%fitted = fitted/occurring
      if (fitted > 0.0_wp) then
         curve%beta_walls = sqrt(max(squares/fitted, 0.0_wp))
         curve%beta_records = sqrt(beta_squares/fitted)
      end if
   end subroutine sum_columns

   !> Which of the curves is that of the whole population, all mechanisms together
   pure integer function whole_population(typologies)
      type(typology_type), intent(in) :: typologies(:)

      do whole_population = 1, size(typologies) - 1
         if (len(typologies(whole_population + 1)%group) > 0) exit
      end do
   end function whole_population

end module dondolo_population_typology
