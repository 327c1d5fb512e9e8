!> Typological fragility: the curves of a population of walls.
!>
!> The weighted mean of the walls' curves (the red line of figure 5 of Nale et al.), its fractiles, how much of the
!> scatter is between walls and how much between records, and a lognormal fitted to the mean: for each mechanism and for
!> all, for the whole population and for each of its groups (docs/theory.md, section 6). Walls come by one after the
!> other, in several passes, and are not kept: memory does not depend on their number.
module dondolo_typology
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_error, only : error_type, raise_input
   use dondolo_fractiles, only : bits_within, fractiles_type, new_fractiles
   use dondolo_fragility, only : fit_fragility, fragility_type
   use dondolo_kinds, only : wp
   use dondolo_population_sums, only : add_group, group_type, sum_wall, sums_type
   use dondolo_text, only : to_text
   use dondolo_wall_curves, only : wall_curves_type
   implicit none
   private

   public :: typology_type, combination_type, combine_population, whole_population, fractile_shares, most_groups

   !> Shares of the weight that the fractiles stand for: the median, and one standard deviation of a normal variable
   real(wp), parameter :: fractile_shares(3) = [0.16_wp, 0.5_wp, 0.84_wp]
   !> Most groups there can be
   integer, parameter :: most_groups = 64
   !> Memory for the fractiles of a population [bytes]
   integer(int64), parameter :: memory = 2_int64**25

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
      !> Histories at each level that the fit counts: number of walls by the weighted mean of their histories
      real(wp) :: histories = 0.0_wp
      !> Lognormal fitted to the mean fractions / saturation; its standard errors take the walls' histories for independent
      type(fragility_type) :: fit
   end type typology_type

   !> Curves of a population in the making: start, then passes over the walls, always in the same order, until complete;
   !> the first sums, the others look for the fractiles
   type :: combination_type
      private
      !> Levels of intensity
      real(wp), allocatable :: levels(:)
      !> The whole population and its groups: the first pass
      type(group_type), allocatable :: groups(:)
      !> Fractiles of each curve: the other passes
      type(fractiles_type), allocatable :: fractiles(:)
      !> The curves, complete after the last pass: those of the whole population, then those of each group in the order
      !> they appear in; mechanisms in the order they appear in, and 'all' last if several or if one may not occur
      type(typology_type), allocatable, public :: typologies(:)
      !> Have all passes been made?
      logical, public :: complete = .false.
   contains
      !> Begin
      procedure :: start
      !> Take in a wall
      procedure :: add
      !> All walls have come by
      procedure :: end_pass
      !> Is this the first pass, which needs the fits of the walls?
      procedure :: is_summing
   end type combination_type

contains

   !> Combine the walls of a population that are all in memory
   subroutine combine_population(typologies, walls, levels, error)
      !> The curves, in the order of combination_type
      type(typology_type), allocatable, intent(out) :: typologies(:)
      !> The walls
      type(wall_curves_type), intent(in) :: walls(:)
      !> Levels of intensity
      real(wp), intent(in) :: levels(:)
      !> What end_pass finds
      type(error_type), allocatable, intent(out) :: error

      type(combination_type) :: combination
      integer :: i

      call combination%start(levels)
      do while (.not. combination%complete)
         do i = 1, size(walls)
            call combination%add(walls(i))
         end do
         call combination%end_pass(error)
         if (allocated(error)) return
      end do
      call move_alloc(combination%typologies, typologies)
   end subroutine combine_population

   !> Which of the curves is that of the whole population, all mechanisms together
   pure integer function whole_population(typologies)
      !> The curves
      type(typology_type), intent(in) :: typologies(:)

      do whole_population = 1, size(typologies) - 1
         if (len(typologies(whole_population + 1)%group) > 0) exit
      end do
   end function whole_population

   !> Begin
   subroutine start(self, levels)
      !> The curves in the making
      class(combination_type), intent(out) :: self
      !> Levels of intensity
      real(wp), intent(in) :: levels(:)

      self%levels = levels
      allocate (self%groups(0))
      call add_group(self%groups, '', levels)
   end subroutine start

   !> Take in a wall; those of no weight leave no trace
   subroutine add(self, wall)
      !> The curves in the making
      class(combination_type), intent(inout) :: self
      !> The wall
      type(wall_curves_type), intent(in) :: wall

      real(wp) :: p(size(self%levels), size(wall%p_occ) + 1)
      integer :: i, m

      if (self%complete .or. .not. wall%weight > 0.0_wp) return
      p = wall%probabilities(self%levels)
      if (.not. allocated(self%fractiles)) then
         call sum_wall(self%groups(1), wall, self%levels, p)
         if (len(wall%group) == 0) return
         do i = 2, size(self%groups)
            if (self%groups(i)%name == wall%group) exit
         end do
         ! One too many tells end_pass.
         if (i > most_groups + 2) return
         if (i > size(self%groups)) call add_group(self%groups, wall%group, self%levels)
         call sum_wall(self%groups(i), wall, self%levels, p)
         return
      end if
      do i = 1, size(self%typologies)
         associate (curve => self%typologies(i))
            if (len(curve%group) > 0 .and. curve%group /= wall%group) cycle
            if (curve%mechanism == 'all') then
               call self%fractiles(i)%add(p(:, size(p, 2)), wall%weight)
               cycle
            end if
            do m = 1, size(wall%p_occ)
               if (wall%mechanism(m) == curve%mechanism .and. wall%p_occ(m) > 0.0_wp) &
                  & call self%fractiles(i)%add(p(:, m), wall%weight*wall%p_occ(m))
            end do
         end associate
      end do
   end subroutine add

   !> Is this the first pass, which needs the fits of the walls?
   pure logical function is_summing(self)
      !> The curves in the making
      class(combination_type), intent(in) :: self

      is_summing = .not. allocated(self%fractiles)
   end function is_summing

   !> All walls have come by
   subroutine end_pass(self, error)
      !> The curves in the making
      class(combination_type), intent(inout) :: self
      !> Too many groups, no wall with a weight, or fractions that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      integer :: i, bits

      if (self%complete) return
      if (.not. allocated(self%fractiles)) then
         call make_curves(self, error)
         if (allocated(error)) return
         bits = bits_within(memory, size(fractile_shares)*size(self%levels)*size(self%typologies, kind=int64))
         allocate (self%fractiles(size(self%typologies)))
         do i = 1, size(self%typologies)
            call new_fractiles(self%fractiles(i), fractile_shares, size(self%levels), self%typologies(i)%weight, bits)
         end do
         return
      end if
      do i = 1, size(self%fractiles)
         call self%fractiles(i)%end_pass()
      end do
      self%complete = self%fractiles(1)%complete()
      if (.not. self%complete) return
      do i = 1, size(self%fractiles)
         self%typologies(i)%fractile = self%fractiles(i)%values()
      end do
   end subroutine end_pass

   !> The curves out of the sums
   subroutine make_curves(self, error)
      !> The curves in the making: typologies are set but for their fractiles
      class(combination_type), intent(inout) :: self
      !> Too many groups, no wall with a weight, or fractions that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      integer :: i, m, k

      if (self%groups(1)%all%walls == 0) then
         call raise_input(error, 'weight: must be positive for at least one wall')
         return
      end if
      if (size(self%groups) > most_groups + 1) then
         call raise_input(error, 'group = '''//self%groups(most_groups + 2)%name//''': is one too many, at most '// &
            & to_text(most_groups)//' are allowed')
         return
      end if
      allocate (self%typologies(sum([(size(self%groups(i)%mechanism), i=1, size(self%groups))]) &
         & + count([(self%groups(i)%has_all(), i=1, size(self%groups))])))
      k = 0
      do i = 1, size(self%groups)
         do m = 1, size(self%groups(i)%mechanism)
            k = k + 1
            call make_curve(self%typologies(k), self%groups(i)%name, self%groups(i)%mechanism(m), self%levels, error)
            if (allocated(error)) return
         end do
         if (.not. self%groups(i)%has_all()) cycle
         k = k + 1
         call make_curve(self%typologies(k), self%groups(i)%name, self%groups(i)%all, self%levels, error)
         if (allocated(error)) return
      end do
   end subroutine make_curves

   !> A curve out of its sums
   subroutine make_curve(curve, group, sums, levels, error)
      !> The curve, without fractiles
      type(typology_type), intent(out) :: curve
      !> Name of the group
      character(len=*), intent(in) :: group
      !> The sums
      type(sums_type), intent(in) :: sums
      !> Levels of intensity
      real(wp), intent(in) :: levels(:)
      !> Fractions that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: n(size(levels)), share(size(levels))

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
      n = curve%histories
      ! Divided first: where all that can collapse does, the share is 1 to the last bit and no survivor is made up.
      share = curve%mean_fraction
      if (curve%saturation > 0.0_wp) share = min(share/curve%saturation, 1.0_wp)
      call fit_fragility(curve%fit, levels, n*share, n, error)
   end subroutine make_curve

end module dondolo_typology
