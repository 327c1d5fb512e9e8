!> Typological fragility: the curve of a population of walls.
!>
!> The weighted mean of the walls' curves (the red line of figure 5 of Nale et al.); a wall without a finite fit takes
!> part with its raw fractions. A lognormal is then fitted to the weighted counts (docs/theory.md, section 6).
module dondolo_typology
   use dondolo_error, only : error_type
   use dondolo_fragility, only : fit_fragility, fragility_type
   use dondolo_kinds, only : wp
   implicit none
   private

   public :: typology_type, combine_walls, combine_population

   !> The curve of a population, or of its walls of one mechanism
   type :: typology_type
      !> Mechanism of the walls, 'all' for walls of several
      character(len=:), allocatable :: mechanism
      !> Levels of intensity
      real(wp), allocatable :: levels(:)
      !> Sum of the weights of the walls
      real(wp) :: weight = 0.0_wp
      !> Weighted mean of the walls' fractions of collapse at each level
      real(wp), allocatable :: mean_fraction(:)
      !> Weighted mean of the walls' curves at each level
      real(wp), allocatable :: mean_curve(:)
      !> Lognormal fitted to the weighted counts; its standard errors take the walls' histories for independent
      type(fragility_type) :: fit
   end type typology_type

contains

   !> Combine a population: a curve for each of its mechanisms, as in figure 5 of Nale et al., and one for all
   subroutine combine_population(typologies, mechanisms, levels, collapses, histories, curves, weights, error)
      !> The curves: mechanisms in the order they appear in, those of no weight left out, and 'all' last if several
      type(typology_type), allocatable, intent(out) :: typologies(:)
      !> Mechanism of each wall
      character(len=*), intent(in) :: mechanisms(:)
      !> Levels of intensity
      real(wp), intent(in) :: levels(:)
      !> Collapses (levels, walls)
      integer, intent(in) :: collapses(:, :)
      !> Histories of a stripe of each wall
      integer, intent(in) :: histories(:)
      !> Curve of each wall
      type(fragility_type), intent(in) :: curves(:)
      !> Weight of each wall, not negative and not all zero
      real(wp), intent(in) :: weights(:)
      !> Counts that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      integer, allocatable :: walls(:), first(:)
      integer :: i

      first = pack([(i, i=1, size(mechanisms))], [(weights(i) > 0.0_wp &
         & .and. .not. any(mechanisms(:i - 1) == mechanisms(i) .and. weights(:i - 1) > 0.0_wp), i=1, size(mechanisms))])
      allocate(typologies(size(first) + merge(1, 0, size(first) > 1)))
      do i = 1, size(typologies)
         if (i <= size(first)) then
            walls = positions(mechanisms == mechanisms(first(i)))
         else
            walls = positions(weights >= 0.0_wp)
         end if
         call combine_walls(typologies(i), levels, collapses(:, walls), histories(walls), curves(walls), &
            & weights(walls), error)
         if (allocated(error)) return
         typologies(i)%mechanism = 'all'
         if (i <= size(first)) typologies(i)%mechanism = trim(mechanisms(first(i)))
      end do
   end subroutine combine_population

   !> Where a mask is true
   pure function positions(mask) result(places)
      !> The mask
      logical, intent(in) :: mask(:)
      !> The places
      integer, allocatable :: places(:)

      integer :: i

      places = pack([(i, i=1, size(mask))], mask)
   end function positions

   !> Combine walls
   subroutine combine_walls(typology, levels, collapses, histories, curves, weights, error)
      !> The curve of the population
      type(typology_type), intent(out) :: typology
      !> Levels of intensity
      real(wp), intent(in) :: levels(:)
      !> Collapses (levels, walls)
      integer, intent(in) :: collapses(:, :)
      !> Histories of a stripe of each wall
      integer, intent(in) :: histories(:)
      !> Curve of each wall
      type(fragility_type), intent(in) :: curves(:)
      !> Weight of each wall, not negative and not all zero
      real(wp), intent(in) :: weights(:)
      !> Counts that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: share(size(weights)), z(size(levels)), n(size(levels)), fraction(size(levels))
      integer :: i

      allocate(typology%mean_fraction(size(levels)), typology%mean_curve(size(levels)), source=0.0_wp)
      typology%levels = levels
      typology%weight = sum(weights)
      share = weights/typology%weight
      z = 0.0_wp
      n = 0.0_wp
      do i = 1, size(weights)
         fraction = real(collapses(:, i), wp)/real(histories(i), wp)
         typology%mean_fraction = typology%mean_fraction + share(i)*fraction
         if (curves(i)%has_fit()) fraction = curves(i)%probability(levels)
         typology%mean_curve = typology%mean_curve + share(i)*fraction
         ! Weights of mean 1, so that the counts of the population are those of its walls together.
         z = z + share(i)*real(size(weights)*collapses(:, i), wp)
         n = n + share(i)*real(size(weights)*histories(i), wp)
      end do
      ! Rounding must not leave more collapses than histories.
      call fit_fragility(typology%fit, levels, min(z, n), n, error)
   end subroutine combine_walls

end module dondolo_typology
