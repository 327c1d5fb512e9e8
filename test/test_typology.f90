!> Curves of populations: every formula by hand on small populations, fractiles against sorting
program test_typology
   use checks, only : check, check_close, check_error, check_ok, check_text, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_fragility, only : fit_fragility, fit_separated, fit_no_collapse, fit_status_names, fragility_type
   use dondolo_fragility_stripes, only : stripes_type
   use dondolo_fragility_study, only : check_thresholds
   use dondolo_population, only : part_type, population_type
   use dondolo_population_typology, only : combine_population, fractile_shares, typology_type, whole_population
   use dondolo_population_weights, only : weighted_fractiles, weights_type
   implicit none

   !> Levels of all populations here
   real(wp), parameter :: x(3) = [0.1_wp, 0.2_wp, 0.4_wp]
   !> Collapses of five walls of 44 histories; the second and the last have no curve
   integer, parameter :: z(3, 5) = reshape([4, 20, 40, 0, 0, 10, 1, 9, 30, 10, 30, 43, 0, 44, 44], [3, 5])

   !> A wall and what came of it
   type :: counted_wall_type
      !> Name of its group, empty if it has none
      character(len=:), allocatable :: group
      !> Its weight
      real(wp) :: weight = 1.0_wp
      !> Its mechanisms, and the probability that each can occur
      character(len=13), allocatable :: mechanism(:)
      real(wp), allocatable :: p_occ(:)
      !> Histories of each in each stripe, and how many collapse (levels, mechanisms)
      integer, allocatable :: histories(:, :), reached(:, :)
      !> Curve of each, and that of the wall as a whole
      type(fragility_type), allocatable :: curve(:)
      type(fragility_type) :: combined
   end type counted_wall_type

   call test_one_wall()
   call test_mean()
   call test_mixed_wall()
   call test_dispersion()
   call test_groups()
   call test_weights_of_nothing()
   call test_too_many_groups()
   call test_all_that_can()
   call test_weights_beyond_numbers()
   call test_signed_zero()
   call test_fractiles_by_hand()
   call test_fractiles_by_sorting()
   call test_order()
   call test_any_level()
   call test_thresholds()
   call finish()

contains

   !> A wall out of rows of z
   function wall_of(rows, mechanisms, weight, p_occ, group, histories) result(wall)
      !> Rows of z, one a mechanism
      integer, intent(in) :: rows(:)
      !> Mechanisms
      character(len=*), intent(in) :: mechanisms(:)
      !> Weight of the wall
      real(wp), intent(in) :: weight
      !> Probabilities that the mechanisms can occur, 1 if absent
      real(wp), intent(in), optional :: p_occ(:)
      !> Its group, none if absent
      character(len=*), intent(in), optional :: group
      !> Histories of a stripe of each mechanism, 44 if absent
      integer, intent(in), optional :: histories(:)
      !> The wall
      type(counted_wall_type) :: wall

      type(population_type) :: alone

      wall%group = ''
      if (present(group)) wall%group = group
      wall%weight = weight
      wall%mechanism = mechanisms
      wall%p_occ = spread(1.0_wp, 1, size(rows))
      if (present(p_occ)) wall%p_occ = p_occ
      allocate (wall%histories(size(x), size(rows)), source=44)
      if (present(histories)) wall%histories = spread(histories, 1, size(x))
      wall%reached = z(:, rows)
      alone = population_of([wall])
      wall%curve = alone%curve(1, :size(rows))
      wall%combined = alone%curve(1, alone%place(size(rows) + 1))
   end function wall_of

   !> A population of walls
   function population_of(walls) result(population)
      !> The walls
      type(counted_wall_type), intent(in) :: walls(:)
      !> The population, fitted
      type(population_type) :: population

      type(error_type), allocatable :: error
      integer :: i, m, row

      do i = 1, size(walls)
         do m = 1, size(walls(i)%p_occ)
            call population%add(trim(walls(i)%mechanism(m)), walls(i)%group, walls(i)%weight, walls(i)%p_occ(m), 0, m > 1)
         end do
      end do
      call population%begin(x, 1, error)
      call check_ok(error, 'population')
      do i = 1, size(walls)
         row = population%first(i)
         population%histories(:, row:row + size(walls(i)%p_occ) - 1) = walls(i)%histories
         population%reached(:, 1, row:row + size(walls(i)%p_occ) - 1) = walls(i)%reached
      end do
      call population%fit(error)
      call check_ok(error, 'curves')
   end function population_of

   !> The curves of a population that must be fine
   function combined(walls) result(typologies)
      !> The walls
      type(counted_wall_type), intent(in) :: walls(:)
      !> The curves
      type(typology_type), allocatable :: typologies(:)

      type(error_type), allocatable :: error

      call combine_population(typologies, population_of(walls), 1, error)
      call check_ok(error, 'combine')
   end function combined

   !> Names of the curves, in order
   function names_of(typologies) result(names)
      !> The curves
      type(typology_type), intent(in) :: typologies(:)
      !> Group:mechanism, one after the other
      character(len=:), allocatable :: names

      integer :: i

      names = ''
      do i = 1, size(typologies)
         names = names//typologies(i)%group//':'//typologies(i)%mechanism//' '
      end do
   end function names_of

   !> Where all walls that can collapse do, rounding of the upper asymptote makes up no survivors
   subroutine test_all_that_can()
      type(counted_wall_type) :: wall
      type(typology_type), allocatable :: curves(:)
      type(error_type), allocatable :: error
      real(wp) :: p_occ
      integer :: i, k

      call suite('all that can')
      wall = wall_of([5], ['one_sided'], 1.0_wp)
      call check(wall%curve(1)%status == fit_separated, 'one mechanism')
      do i = 1, 200
         p_occ = 0.005_wp*real(i, wp)
         wall = wall_of([5], ['one_sided'], 1.0_wp + p_occ, [p_occ])
         call combine_population(curves, population_of([wall]), 1, error)
         call check_ok(error, 'population')
         if (allocated(error)) return
         do k = 1, size(curves)
            call check(curves(k)%fit%status == fit_separated, 'p_occ = '//to_text(p_occ)//': '// &
               & fit_status_names(curves(k)%fit%status))
         end do
      end do
   end subroutine test_all_that_can

   !> A weight of a mechanism that is too small for a number counts as none
   subroutine test_weights_beyond_numbers()
      type(counted_wall_type) :: walls(2)
      type(typology_type), allocatable :: curves(:)
      integer :: k

      call suite('weights beyond numbers')
      walls(1) = wall_of([1], ['one_sided'], sqrt(tiny(1.0_wp)), [sqrt(tiny(1.0_wp))*epsilon(1.0_wp)**2])
      walls(2) = wall_of([3], ['two_block'], 1.0_wp)
      curves = combined(walls(:1))
      do k = 1, size(curves)
         call check(.not. any(curves(k)%mean_fraction /= curves(k)%mean_fraction), 'no NaN alone')
      end do
      curves = combined(walls)
      call check_text(names_of(curves), ':two_block :all ', 'the mechanism has no curve')
   end subroutine test_weights_beyond_numbers

   !> A zero with a sign is a zero
   subroutine test_signed_zero()
      real(wp) :: values(3)
      integer :: i

      call suite('signed zero')
      call weighted_fractiles([-0.0_wp, -0.0_wp, 0.5_wp, 0.75_wp, 1.0_wp], spread(1.0_wp, 1, 5), &
         & [0.16_wp, 0.5_wp, 0.84_wp], values)
      call check_close(values(1), 0.0_wp, 0.0_wp, 'zero')
      call check(sign(1.0_wp, values(1)) > 0.0_wp, 'without its sign')
      do i = 2, 3
         call check_close(values(i), 0.5_wp*real(i - 1, wp), 0.0_wp, 'fractile '//to_text(i))
      end do
   end subroutine test_signed_zero

   !> One wall of one mechanism is its own population
   subroutine test_one_wall()
      type(counted_wall_type) :: wall
      type(typology_type), allocatable :: curves(:)
      integer :: k

      call suite('one wall')
      wall = wall_of([1], ['one_sided'], 3.0_wp)
      curves = combined([wall])
      call check_text(names_of(curves), ':one_sided ', 'curves')
      associate (curve => curves(1))
         call check_close(curve%weight, 3.0_wp, 0.0_wp, 'weight')
         call check(curve%walls == 1, 'number of walls')
         call check_close(curve%fit%theta, wall%curve(1)%theta, 1.0e-12_wp, 'theta')
         call check_close(curve%fit%se_beta(), wall%curve(1)%se_beta(), 1.0e-10_wp, 'standard error')
         call check_close(curve%beta_walls, 0.0_wp, 0.0_wp, 'dispersion between walls', atol=1.0e-14_wp)
         call check_close(curve%beta_records, wall%curve(1)%beta, 1.0e-14_wp, 'dispersion between records')
         call check_close(curve%fitted, 1.0_wp, 0.0_wp, 'share with a curve')
         do k = 1, 3
            call check_close(curve%fractile(k, 2), wall%curve(1)%probability(x(2)), 0.0_wp, 'fractile')
         end do
      end associate
      call check_close(wall%combined%theta, wall%curve(1)%theta, 0.0_wp, 'the wall is its mechanism')
   end subroutine test_one_wall

   !> Weighted means, and the lognormal fitted to them
   subroutine test_mean()
      type(counted_wall_type) :: walls(2)
      type(typology_type), allocatable :: curves(:)
      type(fragility_type) :: fit
      type(error_type), allocatable :: error
      real(wp) :: f(3), n

      call suite('mean')
      ! Reversed too, so that walls differ in their histories: 44 and 88.
      walls = [wall_of([1], ['one_sided'], 3.0_wp), wall_of([2], ['one_sided'], 1.0_wp, histories=[88])]
      curves = combined(walls)
      f = 0.75_wp*real(z(:, 1), wp)/44.0_wp + 0.25_wp*real(z(:, 2), wp)/88.0_wp
      n = 2.0_wp*(0.75_wp*44.0_wp + 0.25_wp*88.0_wp)
      call check_close(curves(1)%mean_fraction(3), f(3), 1.0e-15_wp, 'fraction')
      ! The second wall has no curve and takes part with its fractions.
      call check_close(curves(1)%mean_curve(3), 0.75_wp*walls(1)%curve(1)%probability(x(3)) &
         & + 0.25_wp*10.0_wp/88.0_wp, 1.0e-15_wp, 'curve')
      call check_close(curves(1)%fitted, 0.75_wp, 0.0_wp, 'share with a curve')
      call check_close(curves(1)%histories(1), n, 1.0e-15_wp, 'histories that the fit counts')
      call fit_fragility(fit, x, f*n, spread(n, 1, 3), error)
      call check_close(curves(1)%fit%theta, fit%theta, 1.0e-13_wp, 'theta')
      call check_close(curves(1)%fit%se_ln_theta(), fit%se_ln_theta(), 1.0e-12_wp, 'standard error')

      curves = combined([walls(1), walls(1)])
      call check_close(curves(1)%fit%theta, walls(1)%curve(1)%theta, 1.0e-12_wp, 'theta of two equal walls')
      call check_close(curves(1)%fit%se_beta(), walls(1)%curve(1)%se_beta()*sqrt(0.5_wp), 1.0e-10_wp, &
         & 'standard error of two')
   end subroutine test_mean

   !> Mechanisms in series, each with its chance to occur
   subroutine test_mixed_wall()
      type(counted_wall_type) :: mixed, plain, low, high
      type(typology_type), allocatable :: curves(:)
      type(population_type) :: population
      type(fragility_type) :: fit
      type(error_type), allocatable :: error
      real(wp) :: f(3), p(3), rest(3), can

      call suite('mixed wall')
      mixed = wall_of([1, 3], ['one_sided', 'two_block'], 2.0_wp, [0.3_wp, 0.8_wp], histories=[44, 88])
      plain = wall_of([4], ['one_sided'], 1.0_wp)
      f = 1.0_wp - (1.0_wp - 0.3_wp*real(z(:, 1), wp)/44.0_wp)*(1.0_wp - 0.8_wp*real(z(:, 3), wp)/88.0_wp)
      p = 1.0_wp - (1.0_wp - 0.3_wp*mixed%curve(1)%probability(x))*(1.0_wp - 0.8_wp*mixed%curve(2)%probability(x))
      ! A mechanism can occur in this share of such walls; their capacities are what the lognormal describes.
      can = 1.0_wp - 0.7_wp*0.2_wp
      population = population_of([mixed])
      call check_close(population%occurrence(3), can, 1.0e-15_wp, 'what the wall can come to')
      call check_close(population%occurrence(1), 1.0_wp, 0.0_wp, 'a mechanism if it can occur')
      call check(all(population%histories_of(3) == 44), 'no more histories than the mechanism with fewer')
      call check(all(abs(f - population%fraction(3, 1)) < 1.0e-15_wp), 'fractions of the wall')
      call fit_fragility(fit, x, 44.0_wp*f/can, spread(44.0_wp, 1, 3), error)
      call check_close(mixed%combined%theta, fit%theta, 1.0e-12_wp, 'theta of the wall')
      call check_close(mixed%combined%se_beta(), fit%se_beta(), 1.0e-11_wp, 'it counts the fewer histories')

      curves = combined([mixed, plain])
      call check_text(names_of(curves), ':one_sided :two_block :all ', 'curves')
      call check(whole_population(curves) == 3, 'the last is that of the population')
      ! Walls that can collapse so, as often as they can
      call check_close(curves(1)%weight, 0.6_wp + 1.0_wp, 1.0e-15_wp, 'weight of the first mechanism')
      call check_close(curves(2)%weight, 1.6_wp, 1.0e-15_wp, 'weight of the second mechanism')
      call check_close(curves(3)%weight, 3.0_wp, 0.0_wp, 'weight of all')
      call check_close(curves(1)%mean_fraction(2), (0.6_wp*20.0_wp + 30.0_wp)/44.0_wp/1.6_wp, 1.0e-15_wp, &
         & 'fraction of the first mechanism')
      call check_close(curves(2)%mean_curve(2), mixed%curve(2)%probability(x(2)), 1.0e-15_wp, &
         & 'curve of the second mechanism')
      call check_close(curves(3)%mean_fraction(2), (2.0_wp*f(2) + 30.0_wp/44.0_wp)/3.0_wp, 1.0e-15_wp, &
         & 'fraction of all')
      call check_close(curves(3)%mean_curve(2), (2.0_wp*p(2) + plain%curve(1)%probability(x(2)))/3.0_wp, 1.0e-14_wp, &
         & 'curve of all')
      call check_close(curves(2)%histories(1), 88.0_wp, 1.0e-15_wp, 'histories of the second mechanism')
      call check_close(curves(3)%histories(1), 88.0_wp, 1.0e-15_wp, 'histories of all')
      call check_close(curves(3)%beta_records, sqrt((2.0_wp*can*fit%beta**2 + plain%curve(1)%beta**2) &
         & /(2.0_wp*can + 1.0_wp)), 1.0e-12_wp, 'dispersion between records is that of the walls as a whole')
      call check_close(curves(3)%beta_walls, sqrt(2.0_wp*can)/(2.0_wp*can + 1.0_wp) &
         & *abs(log(fit%theta/plain%curve(1)%theta)), 1.0e-12_wp, 'dispersion between walls that can collapse')
      call check_close(curves(3)%upper_asymptote, (2.0_wp*can + 1.0_wp)/3.0_wp, 1.0e-15_wp, 'what the mean comes to')
      call check_close(curves(1)%upper_asymptote, 1.0_wp, 0.0_wp, 'one mechanism, if it can occur')
      call check_close(curves(3)%fitted, 1.0_wp, 1.0e-15_wp, 'all have a curve')
      call fit_fragility(fit, x, 88.0_wp*curves(3)%mean_fraction/curves(3)%upper_asymptote, spread(88.0_wp, 1, 3), error)
      call check_close(curves(3)%fit%theta, fit%theta, 1.0e-12_wp, 'the lognormal is that of walls that can collapse')

      ! Of one mechanism the wall counts as often as it can occur: 0.9 of 1 with the lower curve, then 0.1.
      low = wall_of([3], ['one_sided'], 1.0_wp, [0.9_wp])
      high = wall_of([1], ['one_sided'], 1.0_wp, [0.1_wp])
      curves = combined([low, high])
      call check_close(curves(1)%fractile(3, 2), low%curve(1)%probability(x(2)), 0.0_wp, 'low where it can occur')
      low%p_occ = 0.1_wp
      high%p_occ = 0.9_wp
      curves = combined([low, high])
      call check_close(curves(1)%fractile(1, 2), high%curve(1)%probability(x(2)), 0.0_wp, 'high where it can occur')

      ! A lone mechanism that may not occur
      curves = combined([wall_of([1], ['one_sided'], 1.0_wp, [0.25_wp])])
      call check_text(names_of(curves), ':one_sided :all ', 'a curve for all, too')
      call check_close(curves(1)%mean_fraction(3), 40.0_wp/44.0_wp, 1.0e-15_wp, 'given that it can occur')
      call check_close(curves(2)%mean_fraction(3), 10.0_wp/44.0_wp, 1.0e-15_wp, 'all in all')
      curves = combined([wall_of([1], ['one_sided'], 1.0_wp, [0.0_wp])])
      call check_text(names_of(curves), ':all ', 'a mechanism that never occurs')
      call check(curves(1)%fit%status == fit_no_collapse .and. .not. curves(1)%fitted > 0.0_wp, &
         & 'and never makes collapse')

      ! Three mechanisms
      mixed = wall_of([1, 3, 4], ['one_sided    ', 'two_block    ', 'free_standing'], 1.0_wp, [0.5_wp, 1.0_wp, 0.25_wp])
      rest = (1.0_wp - 0.5_wp*mixed%curve(1)%probability(x))*(1.0_wp - mixed%curve(2)%probability(x)) &
         & *(1.0_wp - 0.25_wp*mixed%curve(3)%probability(x))
      curves = combined([mixed])
      call check_close(curves(4)%mean_curve(2), 1.0_wp - rest(2), 1.0e-14_wp, 'three in series')
      call check_close(curves(4)%fractile(1, 2), 1.0_wp - rest(2), 1.0e-14_wp, 'three in series, fractile')
   end subroutine test_mixed_wall

   !> Dispersion between walls and between records
   subroutine test_dispersion()
      !> Weights; the second wall has no curve
      real(wp), parameter :: w(4) = [2.0_wp, 3.0_wp, 1.0_wp, 5.0_wp]
      type(counted_wall_type) :: walls(4)
      type(typology_type), allocatable :: curves(:)
      real(wp) :: ln(4), beta(4), share(4), mean
      integer :: i

      call suite('dispersion')
      do i = 1, 4
         walls(i) = wall_of([i], ['one_sided'], w(i))
         ln(i) = 0.0_wp
         if (walls(i)%curve(1)%has_fit()) ln(i) = log(walls(i)%curve(1)%theta)
         beta(i) = walls(i)%curve(1)%beta
      end do
      share = [2.0_wp, 0.0_wp, 1.0_wp, 5.0_wp]/8.0_wp
      mean = sum(share*ln)
      curves = combined(walls)
      call check(.not. walls(2)%curve(1)%has_fit(), 'one wall has no curve')
      call check_close(curves(1)%beta_walls, sqrt(sum(share*(ln - mean)**2)), 1.0e-13_wp, 'between walls')
      call check_close(curves(1)%beta_records, sqrt(sum(share*beta**2)), 1.0e-14_wp, 'between records')
      call check_close(curves(1)%fitted, 8.0_wp/11.0_wp, 1.0e-15_wp, 'share with a curve')
   end subroutine test_dispersion

   !> Curves by group
   subroutine test_groups()
      type(counted_wall_type) :: walls(4)
      type(typology_type), allocatable :: curves(:), alone(:)

      call suite('groups')
      walls(1) = wall_of([1], ['two_block'], 2.0_wp, group='towers')
      walls(2) = wall_of([3], ['one_sided'], 1.0_wp)
      walls(3) = wall_of([3, 4], ['one_sided', 'two_block'], 3.0_wp, [0.5_wp, 1.0_wp], group='facades')
      walls(4) = wall_of([4], ['two_block'], 1.0_wp, group='towers')
      curves = combined(walls)
      call check_text(names_of(curves), ':two_block :one_sided :all towers:two_block facades:one_sided '// &
         & 'facades:two_block facades:all ', 'curves')
      call check(whole_population(curves) == 3, 'the population')
      alone = combined(walls([1, 4]))
      call check_close(curves(4)%weight, 3.0_wp, 0.0_wp, 'weight of a group')
      call check_close(curves(4)%fit%beta, alone(1)%fit%beta, 0.0_wp, 'fit of a group')
      call check_close(curves(4)%beta_walls, alone(1)%beta_walls, 0.0_wp, 'dispersion of a group')
      call check_close(curves(4)%fractile(3, 2), alone(1)%fractile(3, 2), 0.0_wp, 'fractile of a group')
      alone = combined(walls([3]))
      call check_close(curves(7)%mean_curve(1), alone(3)%mean_curve(1), 0.0_wp, 'mean of a group')
      call check_close(curves(7)%fractile(2, 1), alone(3)%fractile(2, 1), 0.0_wp, 'fractile of a mixed group')
      call check_close(curves(3)%weight, 7.0_wp, 0.0_wp, 'weight of the population')
   end subroutine test_groups

   !> Walls of no weight leave no trace
   subroutine test_weights_of_nothing()
      type(counted_wall_type) :: walls(3)
      type(typology_type), allocatable :: curves(:)
      type(error_type), allocatable :: error

      call suite('no weight')
      walls(1) = wall_of([2], ['two_block'], 0.0_wp, group='ruins')
      walls(2) = wall_of([1], ['one_sided'], 2.0_wp)
      walls(3) = wall_of([4], ['one_sided'], 0.0_wp, [0.5_wp])
      curves = combined(walls)
      call check_text(names_of(curves), ':one_sided ', 'curves')
      call check(curves(1)%walls == 1, 'one wall')
      call check_close(curves(1)%fit%theta, walls(2)%curve(1)%theta, 1.0e-12_wp, 'theta')
      call check_close(curves(1)%fractile(1, 2), walls(2)%curve(1)%probability(x(2)), 0.0_wp, 'fractile')
      call combine_population(curves, population_of(walls([1, 3])), 1, error)
      call check_error(error, 'weight: must be positive for at least one wall', 'no weight at all')
   end subroutine test_weights_of_nothing

   !> A column of names is no group
   subroutine test_too_many_groups()
      type(counted_wall_type) :: walls(66), one
      type(typology_type), allocatable :: curves(:)
      type(error_type), allocatable :: error
      integer :: i

      call suite('too many groups')
      one = wall_of([1], ['one_sided'], 1.0_wp)
      do i = 1, size(walls)
         walls(i) = one
         walls(i)%group = 'g'//to_text(i)
      end do
      call combine_population(curves, population_of(walls(:64)), 1, error)
      call check_ok(error, '64 groups')
      call check(size(curves) == 65, 'a curve for each and for all')
      call combine_population(curves, population_of(walls), 1, error)
      call check_error(error, 'group = ''g65'': too many groups, at most 64 are allowed', '66 groups')
   end subroutine test_too_many_groups

   !> Fractiles of a few numbers
   subroutine test_fractiles_by_hand()
      real(wp) :: found(3)
      integer :: i

      call suite('fractiles by hand')
      found = fractiles_of([0.5_wp], [2.0_wp])
      call check(all(abs(found - 0.5_wp) <= 0.0_wp), 'one number')
      found = fractiles_of([0.75_wp, 0.25_wp], [1.0_wp, 1.0_wp])
      call check(all(abs(found - [0.25_wp, 0.25_wp, 0.75_wp]) <= 0.0_wp), 'half of two is the lower')
      found = fractiles_of([0.75_wp, 0.25_wp], [1.0_wp, 0.99_wp])
      call check(all(abs(found - [0.25_wp, 0.75_wp, 0.75_wp]) <= 0.0_wp), 'less than half')
      found = fractiles_of([1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp], spread(1.0_wp, 1, 5))
      call check(all(abs(found - [0.0_wp, 0.0_wp, 1.0_wp]) <= 0.0_wp), 'zeros and ones')
      ! Half of the weights is half of the weight, though rounding makes 0.3 twenty times less than half of forty times.
      found = fractiles_of([(real(modulo(7*i, 40) + 1, wp)/64.0_wp, i=1, 40)], spread(0.3_wp, 1, 40))
      call check(all(abs(found - [7.0_wp, 20.0_wp, 34.0_wp]/64.0_wp) <= 0.0_wp), 'forty alike')
      found = fractiles_of([1.0e-250_wp, 0.3_wp], [9.0_wp, 1.0_wp])
      call check(found(2) < 1.0e-200_wp .and. found(2) > 0.0_wp, 'a very small number is not zero')
   end subroutine test_fractiles_by_hand

   !> Fractiles of numbers of which some have no weight
   function fractiles_of(numbers, weights) result(found)
      !> The numbers
      real(wp), intent(in) :: numbers(:)
      !> Their weights
      real(wp), intent(in) :: weights(:)
      !> Their fractiles
      real(wp) :: found(3)

      call weighted_fractiles(pack(numbers, weights > 0.0_wp), pack(weights, weights > 0.0_wp), &
         & fractile_shares, found)
   end function fractiles_of

   !> The same by its definition: sorted, the first at which the weight is reached
   function sorted_fractiles(numbers, weights) result(found)
      !> The numbers
      real(wp), intent(in) :: numbers(:)
      !> Their weights
      real(wp), intent(in) :: weights(:)
      !> Their fractiles
      real(wp) :: found(3)

      integer :: i, k

      found = huge(1.0_wp)
      do k = 1, 3
         do i = 1, size(numbers)
            if (.not. weights(i) > 0.0_wp .or. numbers(i) >= found(k)) cycle
            if (sum(weights, numbers <= numbers(i)) >= (fractile_shares(k) - 1.0e-12_wp)*sum(weights)) then
               found(k) = numbers(i)
            end if
         end do
      end do
   end function sorted_fractiles

   !> Random numbers and weights, with ties, zeros, ones and weights of nothing
   subroutine test_fractiles_by_sorting()
      real(wp), allocatable :: numbers(:), weights(:), u(:)
      integer :: trial, n, wrong
      integer, allocatable :: seed(:)

      call suite('fractiles by sorting')
      call random_seed(size=n)
      seed = [(37*trial, trial=1, n)]
      call random_seed(put=seed)
      wrong = 0
      do trial = 1, 300
         n = 1 + modulo(7*trial, 120)
         if (allocated(numbers)) deallocate (numbers, weights, u)
         allocate (numbers(n), weights(n), u(n))
         call random_number(numbers)
         call random_number(weights)
         call random_number(u)
         if (modulo(trial, 3) == 0) numbers = real(nint(4.0_wp*numbers), wp)/4.0_wp
         if (modulo(trial, 4) == 0) numbers = numbers**40
         if (modulo(trial, 5) == 0) weights = 1.0_wp
         where (u < 0.2_wp) numbers = 0.0_wp
         where (u > 0.9_wp) numbers = 1.0_wp
         where (u > 0.4_wp .and. u < 0.5_wp) weights = 0.0_wp
         weights(1) = 0.5_wp
         if (any(abs(fractiles_of(numbers, weights) - sorted_fractiles(numbers, weights)) > 0.0_wp)) then
            wrong = wrong + 1
         end if
      end do
      call check(wrong == 0, to_text(wrong)//' of 300 samples differ from sorting')
   end subroutine test_fractiles_by_sorting

   !> The order of the walls changes rounding and the order of the curves, nothing else
   subroutine test_order()
      type(counted_wall_type) :: walls(4)
      type(typology_type), allocatable :: there(:), back(:), again(:)

      call suite('order')
      walls(1) = wall_of([1, 3], ['one_sided', 'two_block'], 0.1_wp, [0.5_wp, 0.7_wp])
      walls(2) = wall_of([2], ['one_sided'], 0.7_wp)
      walls(3) = wall_of([4], ['one_sided'], 1.3_wp)
      walls(4) = wall_of([3, 1], ['two_block', 'one_sided'], 0.3_wp, [0.7_wp, 0.5_wp])
      there = combined(walls)
      again = combined(walls)
      back = combined(walls([4, 3, 2, 1]))
      call check_text(names_of(back), ':two_block :one_sided :all ', 'curves')
      associate (all => there(3), other => back(3))
         call check_close(other%mean_curve(2), all%mean_curve(2), 1.0e-14_wp, 'mean')
         call check_close(other%fit%theta, all%fit%theta, 1.0e-12_wp, 'theta')
         call check_close(other%beta_walls, all%beta_walls, 1.0e-12_wp, 'dispersion')
         call check_close(other%fractile(2, 2), all%fractile(2, 2), 1.0e-14_wp, 'median')
         call check_close(again(3)%beta_walls, all%beta_walls, 0.0_wp, 'the same order, the same sums')
         call check_close(again(3)%mean_curve(2), all%mean_curve(2), 0.0_wp, 'the same order, the same mean')
      end associate
   end subroutine test_order

   !> At levels that were not run: curves where there are fits, lines between the fractions where there are none
   subroutine test_any_level()
      type(population_type) :: population
      type(weights_type) :: weights
      type(counted_wall_type) :: walls(3)
      type(error_type), allocatable :: error
      real(wp), allocatable :: p(:, :)
      real(wp), parameter :: levels(6) = [0.0_wp, 0.05_wp, 0.1_wp, 0.3_wp, 0.4_wp, 2.0_wp], &
         & lines(6) = [0.0_wp, 0.0_wp, 0.0_wp, 5.0_wp, 10.0_wp, 10.0_wp]/44.0_wp
      real(wp) :: mean(6), fractiles(2, 6)
      integer :: k

      call suite('any level')
      walls(1) = wall_of([1, 3], ['one_sided', 'two_block'], 2.0_wp, [0.3_wp, 0.8_wp])
      walls(2) = wall_of([2], ['one_sided'], 1.0_wp, group='b')
      walls(3) = wall_of([4], ['one_sided'], 4.0_wp, group='b')
      population = population_of(walls)
      call population%probabilities(1, [(k, k=1, 7)], levels, p, error)
      call check_ok(error, 'probabilities')
      call check(all(shape(p) == [7, 6]), 'rows and walls')
      do k = 1, size(levels)
         call check_close(p(3, k), lines(k), 1.0e-15_wp, 'a wall without a fit', atol=1.0e-16_wp)
         call check_close(p(5, k), 1.0_wp - (1.0_wp - 0.3_wp*p(1, k))*(1.0_wp - 0.8_wp*p(2, k)), 1.0e-14_wp, &
            & 'mechanisms in series', atol=1.0e-16_wp)
         call check_close(p(4, k), walls(3)%curve(1)%probability(levels(k)), 0.0_wp, 'a wall with a fit')
         call check(all(abs(p(6:, k) - p(3:4, k)) <= 0.0_wp), 'one mechanism that always can occur')
      end do
      call weights%take(population, population%part('all', ''))
      call check(all(weights%column == [5, 6, 7]), 'walls as a whole')
      mean = weights%mean(p(5:, :))
      fractiles = weights%fractiles(p(5:, :), [0.9_wp, 0.1_wp])
      do k = 1, size(levels)
         call check_close(mean(k), (2.0_wp*p(5, k) + p(6, k) + 4.0_wp*p(7, k))/7.0_wp, 1.0e-14_wp, 'mean', atol=1.0e-16_wp)
         call check(all(abs(fractiles(:, k) - [maxval(p(5:, k)), minval(p(5:, k))]) <= 0.0_wp), 'fractiles')
      end do
      call weights%take(population, population%part('one_sided', 'b'))
      call check(all(weights%column == [3, 4]) .and. all(weights%weight >= [1.0_wp, 4.0_wp]), 'a mechanism of a group')
      call weights%take(population, population%part('one_sided', ''))
      call check(all(weights%column == [1, 3, 4]), 'a mechanism')
      call check_close(weights%weight(1), 0.6_wp, 1.0e-15_wp, 'counts as often as it can occur')
      call weights%take(population, part_type(group=1))
      call check(all(weights%column == [6, 7]), 'a group')
      call population%probabilities(1, [3], levels, p, error)
      call check_ok(error, 'some columns')
      do k = 1, size(levels)
         call check_close(p(1, k), lines(k), 1.0e-15_wp, 'the column that was asked for', atol=1.0e-16_wp)
      end do

      ! A row that was not fitted
      population = population_type()
      call population%add('one_sided', '', 1.0_wp, 1.0_wp, 0, .false.)
      call population%begin([1.0_wp, 2.0_wp], 1, error)
      call check_ok(error, 'two levels')
      population%histories = 4
      population%reached(:, 1, 1) = [1, 2]
      call population%probabilities(1, [1], [0.5_wp, 1.5_wp, 2.5_wp], p, error)
      call check(all(abs(p(1, :) - [0.125_wp, 0.375_wp, 0.5_wp]) <= 0.0_wp), 'between two fractions')
   end subroutine test_any_level

   !> Damage states: thresholds and who reaches them
   subroutine test_thresholds()
      type(stripes_type) :: stripes
      type(error_type), allocatable :: error

      call suite('thresholds')
      stripes%levels = [1.0_wp, 2.0_wp]
      allocate (stripes%response(3, 2), stripes%ran(3, 2))
      stripes%ran = .true.
      stripes%response(:, 1)%edp = [0.0_wp, 0.1_wp, 0.09_wp]
      stripes%response(:, 2)%edp = [0.4_wp, 1.0_wp, 0.1_wp]
      stripes%response(2, 2)%collapsed = .true.
      call check(all(stripes%exceedances(0.1_wp) == [1, 3]), 'reached from below counts')
      call check(all(stripes%exceedances(0.4_wp) == [0, 2]), 'the second state')
      call check(all(stripes%exceedances(1.0_wp) == stripes%collapses()), 'the last state is collapse')
      call check_thresholds([0.1_wp, 0.4_wp, 1.0_wp], 1.0_wp, error)
      call check_ok(error, 'three states')
      call check_thresholds([0.4_wp, 0.4_wp], 1.0_wp, error)
      call check_error(error, 'edp_thresholds = 0.4, 0.4: must increase strictly', 'the same twice')
      call check_thresholds([0.0_wp], 1.0_wp, error)
      call check_error(error, 'edp_thresholds = 0: must be positive and at most edp_limit = 1', 'zero')
      call check_thresholds([0.5_wp, 1.5_wp], 1.25_wp, error)
      call check_error(error, 'edp_thresholds = 1.5: must be positive and at most edp_limit = 1.25', 'beyond the limit')
   end subroutine test_thresholds

end program test_typology
