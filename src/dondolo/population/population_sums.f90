!> Sums over the walls of a population and of its groups, for each mechanism and for all.
module dondolo_population_sums
   use dondolo_fragility, only : fragility_type
   use dondolo_kinds, only : wp
   use dondolo_wall_curves, only : wall_curves_type
   implicit none
   private

   public :: sums_type, group_type, add_group, sum_wall

   !> A curve of which sums are known
   type :: sums_type
      !> Mechanism, or 'all'
      character(len=:), allocatable :: mechanism
      !> Sum of the weights
      real(wp) :: weight = 0.0_wp
      !> Sum of weight and probability that any mechanism can occur
      real(wp) :: occurring = 0.0_wp
      !> Number of walls
      integer :: walls = 0
      !> Sum of weight and fraction at each level
      real(wp), allocatable :: fraction(:)
      !> Sum of weight and curve at each level
      real(wp), allocatable :: curve(:)
      !> Sum of weight and histories at each level
      real(wp), allocatable :: histories(:)
      !> The same sum over the walls with a curve
      real(wp) :: fitted = 0.0_wp
      !> Mean of their ln theta, with these weights
      real(wp) :: centre = 0.0_wp
      !> Sum of these weights and the square of the distance from it
      real(wp) :: squares = 0.0_wp
      !> Sum of these weights and the square of beta
      real(wp) :: beta_squares = 0.0_wp
   end type sums_type

   !> The curves of a group of which sums are known
   type :: group_type
      !> Name
      character(len=:), allocatable :: name
      !> Curve of all mechanisms
      type(sums_type) :: all
      !> Curves of each mechanism, in the order they appear in
      type(sums_type), allocatable :: mechanism(:)
      !> Is there a wall with a mechanism that may not occur?
      logical :: uncertain = .false.
      !> Is there a wall with several mechanisms, even if they have one name?
      logical :: several = .false.
   contains
      !> Has it a curve of all mechanisms, beside that of its only one?
      procedure :: has_all
   end type group_type

contains

   !> Take a wall into the sums of a group
   subroutine sum_wall(group, wall, levels, p)
      type(group_type), intent(inout) :: group
      type(wall_curves_type), intent(in) :: wall
      !> Levels of intensity
      real(wp), intent(in) :: levels(:)
      !> Probabilities of collapse (levels, mechanisms and last the wall)
      real(wp), intent(in) :: p(:, :)

      real(wp) :: f(size(p, 1), size(p, 2))
      integer :: m, place

      f = wall%fractions()
      group%several = group%several .or. size(wall%p_occ) > 1
      do m = 1, size(wall%p_occ)
         if (wall%p_occ(m) < 1.0_wp) group%uncertain = .true.
         ! A product too small for a number counts as none.
         if (.not. wall%weight*wall%p_occ(m) > 0.0_wp) cycle
         do place = 1, size(group%mechanism)
            if (group%mechanism(place)%mechanism == wall%mechanism(m)) exit
         end do
         if (place > size(group%mechanism)) call add_mechanism(group, trim(wall%mechanism(m)), levels)
         call sum_row(group%mechanism(place), wall%weight*wall%p_occ(m), 1.0_wp, f(:, m), p(:, m), wall%histories(:, m), &
            & wall%curve(m))
      end do
      call sum_row(group%all, wall%weight, wall%occurrence(), f(:, m), p(:, m), wall%combined_histories(), wall%combined)
   end subroutine sum_wall

   !> Take a wall or one of its mechanisms into the sums of a curve
   pure subroutine sum_row(sums, weight, occurrence, fraction, p, histories, fit)
      type(sums_type), intent(inout) :: sums
      !> Its weight, positive
      real(wp), intent(in) :: weight
      !> Probability that any mechanism can occur in it
      real(wp), intent(in) :: occurrence
      !> Its fractions of collapse at each level
      real(wp), intent(in) :: fraction(:)
      !> Its probability of collapse at each level
      real(wp), intent(in) :: p(:)
      !> Its histories at each level
      integer, intent(in) :: histories(:)
      type(fragility_type), intent(in) :: fit

      real(wp) :: part, distance

      sums%walls = sums%walls + 1
      sums%weight = sums%weight + weight
      part = weight*occurrence
      sums%occurring = sums%occurring + part
      sums%fraction = sums%fraction + weight*fraction
      sums%curve = sums%curve + weight*p
      sums%histories = sums%histories + weight*real(histories, wp)
      if (.not. fit%has_fit()) return
      sums%fitted = sums%fitted + part
      ! The mean moves on with every wall, and the squares with it (West 1979): no difference of large sums.
      distance = log(fit%theta) - sums%centre
      sums%centre = sums%centre + distance*part/sums%fitted
      sums%squares = sums%squares + part*distance*(log(fit%theta) - sums%centre)
      sums%beta_squares = sums%beta_squares + part*fit%beta**2
   end subroutine sum_row

   !> Has a group a curve of all mechanisms, beside that of its only one?
   pure logical function has_all(self)
      class(group_type), intent(in) :: self

      has_all = size(self%mechanism) > 1 .or. self%uncertain .or. self%several
   end function has_all

   !> Add a group
   subroutine add_group(groups, name, levels)
      !> Groups
      type(group_type), allocatable, intent(inout) :: groups(:)
      !> Name of the new one
      character(len=*), intent(in) :: name
      !> Levels of intensity
      real(wp), intent(in) :: levels(:)

      type(group_type), allocatable :: more(:)
      integer :: number

      number = size(groups) + 1
      allocate (more(number))
      more(:number - 1) = groups
      more(number)%name = name
      allocate (more(number)%mechanism(0))
      call begin_sums(more(number)%all, 'all', levels)
      call move_alloc(more, groups)
   end subroutine add_group

   !> Add a mechanism to a group
   subroutine add_mechanism(group, name, levels)
      type(group_type), intent(inout) :: group
      !> Name of the mechanism
      character(len=*), intent(in) :: name
      !> Levels of intensity
      real(wp), intent(in) :: levels(:)

      type(sums_type), allocatable :: more(:)
      integer :: number

      number = size(group%mechanism) + 1
      allocate (more(number))
      more(:number - 1) = group%mechanism
      call begin_sums(more(number), name, levels)
      call move_alloc(more, group%mechanism)
   end subroutine add_mechanism

   !> Sums of nothing
   pure subroutine begin_sums(sums, name, levels)
      type(sums_type), intent(out) :: sums
      !> Name of the mechanism
      character(len=*), intent(in) :: name
      !> Levels of intensity
      real(wp), intent(in) :: levels(:)

      sums%mechanism = name
      allocate (sums%fraction(size(levels)), sums%curve(size(levels)), sums%histories(size(levels)), source=0.0_wp)
   end subroutine begin_sums

end module dondolo_population_sums
