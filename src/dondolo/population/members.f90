!> The walls behind a curve of a population, and their probabilities of collapse at any levels of intensity.
module dondolo_members
   use dondolo_error, only : error_type
   use dondolo_fractiles, only : weighted_fractiles
   use dondolo_kinds, only : wp
   use dondolo_memory, only : check_room
   use dondolo_population_counts, only : population_counts_type
   use dondolo_wall, only : mechanism_names
   use dondolo_wall_curves, only : wall_curves_type
   implicit none
   private

   public :: members_type, choose_members, population_probabilities

   !> Who makes up a curve: walls, or the rows of one mechanism
   type :: members_type
      !> Their columns among the probabilities of a population
      integer, allocatable :: column(:)
      !> Their weights, positive
      real(wp), allocatable :: weight(:)
   contains
      !> Weighted mean of the probabilities
      procedure :: mean
      !> Weighted fractiles of the probabilities
      procedure :: fractiles
   end type members_type

contains

   !> Probabilities of collapse of all rows, if their mechanisms can occur, and of all walls, or of some members alone
   subroutine population_probabilities(population, state, x, p, error, members)
      !> The population, fitted
      type(population_counts_type), intent(in) :: population
      !> Number of the damage state
      integer, intent(in) :: state
      !> Levels of intensity, not negative
      real(wp), intent(in) :: x(:)
      !> Probabilities (x, rows and then walls)
      real(wp), allocatable, intent(out) :: p(:, :)
      !> Lack of memory
      type(error_type), allocatable, intent(out) :: error
      !> Whose columns are needed; those of other walls are left undefined
      type(members_type), intent(in), optional :: members

      type(wall_curves_type) :: wall
      real(wp), allocatable :: own(:, :)
      logical, allocatable :: needed(:)
      integer :: i, rows

      rows = population%rows()
      call check_room(real(storage_size(p)/8, wp)*real(size(x), wp)*real(rows + population%walls(), wp), error)
      if (allocated(error)) return
      allocate (p(size(x), rows + population%walls()))
      allocate (needed(size(p, 2)), source=.not. present(members))
      if (present(members)) needed(members%column) = .true.
      do i = 1, population%walls()
         if (.not. (needed(rows + i) .or. any(needed(population%first(i):population%first(i + 1) - 1)))) cycle
         wall = population%wall(i, state)
         own = wall%probabilities(population%levels, x)
         p(:, population%first(i):population%first(i + 1) - 1) = own(:, :size(own, 2) - 1)
         p(:, rows + i) = own(:, size(own, 2))
      end do
   end subroutine population_probabilities

   !> The members of a curve; those of no weight are left out
   subroutine choose_members(members, population, mechanism, group)
      type(members_type), intent(out) :: members
      type(population_counts_type), intent(in) :: population
      !> One of mechanism_names; any other name, such as 'all': the walls as a whole
      character(len=*), intent(in) :: mechanism
      !> Number of a group, 0: all walls
      integer, intent(in) :: group

      integer :: i, number

      number = findloc(mechanism_names == mechanism, .true., dim=1)
      if (number == 0) then
         members%column = [(i, i=1, population%walls())]
         members%weight = population%weight(population%first(members%column))
         if (group > 0) members%weight = merge(members%weight, 0.0_wp, &
            & population%group(population%first(members%column)) == group)
         members%column = members%column + population%rows()
      else
         members%column = [(i, i=1, population%rows())]
         ! A product too small for a number counts as none.
         members%weight = merge(population%weight*population%p_occ, 0.0_wp, population%mechanism == number)
         if (group > 0) members%weight = merge(members%weight, 0.0_wp, population%group == group)
      end if
      members%column = pack(members%column, members%weight > 0.0_wp)
      members%weight = pack(members%weight, members%weight > 0.0_wp)
   end subroutine choose_members

   !> Weighted mean of the probabilities
   pure function mean(self, p)
      class(members_type), intent(in) :: self
      !> Probabilities of the population (x, columns)
      real(wp), intent(in) :: p(:, :)
      !> Mean at each x
      real(wp) :: mean(size(p, 1))

      real(wp) :: total
      integer :: i

      mean = 0.0_wp
      total = 0.0_wp
      do i = 1, size(self%column)
         mean = mean + self%weight(i)*p(:, self%column(i))
         total = total + self%weight(i)
      end do
      mean = min(mean/total, 1.0_wp)
   end function mean

   !> Weighted fractiles of the probabilities
   pure function fractiles(self, p, shares)
      class(members_type), intent(in) :: self
      !> Probabilities of the population (x, columns)
      real(wp), intent(in) :: p(:, :)
      !> Shares of the weight, above 0 and up to 1
      real(wp), intent(in) :: shares(:)
      !> Fractiles (shares, x)
      real(wp) :: fractiles(size(shares), size(p, 1))

      real(wp), allocatable :: numbers(:)
      real(wp) :: total
      integer :: i

      if (size(shares) == 0) return
      total = 0.0_wp
      do i = 1, size(self%weight)
         total = total + self%weight(i)
      end do
      do i = 1, size(p, 1)
         numbers = p(i, self%column)
         call weighted_fractiles(numbers, self%weight, total, shares, fractiles(:, i))
      end do
   end function fractiles

end module dondolo_members
