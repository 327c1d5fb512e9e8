!> A population whose histories have been run: its walls, and how many histories of each reach each damage state. All its
!> curves are made of it.
!>
!> It is kept in memory, in arrays: about 200 bytes a row and state at 20 levels.
module dondolo_population_counts
   use dondolo_error, only : error_type
   use dondolo_fragility, only : fit_fragility, fragility_type
   use dondolo_kinds, only : wp
   use dondolo_lines, only : lines_type
   use dondolo_memory, only : check_room
   use dondolo_roster, only : roster_type
   use dondolo_wall, only : mechanism_names
   use dondolo_wall_curves, only : wall_curves_type
   implicit none
   private

   public :: population_counts_type, new_population_counts

   !> A population and its counts. A row is one mechanism of a wall; the rows of a wall stand one after the other
   type :: population_counts_type
      !> Levels of intensity
      real(wp), allocatable :: levels(:)
      !> Names of the groups, in the order in which they appear
      type(lines_type) :: groups
      !> First row of each wall, and behind them the number of rows + 1
      integer, allocatable :: first(:)
      !> Number of the group of each row; 0: none. Rows of a wall have the same
      integer, allocatable :: group(:)
      !> Weight of the wall of each row, >= 0
      real(wp), allocatable :: weight(:)
      !> Number of the mechanism of each row among mechanism_names
      integer, allocatable :: mechanism(:)
      !> Probability that it can occur
      real(wp), allocatable :: p_occ(:)
      !> Histories of each row in each stripe (levels, rows)
      integer, allocatable :: histories(:, :)
      !> How many of them reach each damage state (levels, states, rows)
      integer, allocatable :: reached(:, :, :)
      !> Curves of the rows (states, rows), and of the walls as a whole (states, walls)
      type(fragility_type), allocatable :: curve(:, :), combined(:, :)
   contains
      !> Number of rows
      procedure :: rows
      !> Number of walls
      procedure :: walls
      !> Fit the curves of all rows and walls
      procedure :: fit
      !> A wall with the curves of its mechanisms
      procedure :: wall
   end type population_counts_type

contains

   !> A population without counts
   subroutine new_population_counts(population, roster, levels, states, error)
      !> The population, with no histories
      type(population_counts_type), intent(out) :: population
      type(roster_type), intent(in) :: roster
      !> Levels of intensity
      real(wp), intent(in) :: levels(:)
      !> Number of damage states
      integer, intent(in) :: states
      !> Lack of memory
      type(error_type), allocatable, intent(out) :: error

      real(wp), parameter :: bytes_of_row = 64.0_wp, bytes_of_count = 4.0_wp, bytes_of_curve = 192.0_wp
      integer :: rows

      rows = roster%count
      call check_room(real(rows, wp)*(bytes_of_row + real(states, wp)*(bytes_of_curve &
         & + bytes_of_count*real(size(levels), wp))), error)
      if (allocated(error)) return
      population%levels = levels
      population%groups = roster%groups
      population%first = roster%first_rows()
      population%group = roster%row(:rows)%group
      population%weight = roster%row(:rows)%weight
      population%mechanism = roster%row(:rows)%mechanism
      population%p_occ = roster%row(:rows)%p_occ
      allocate (population%histories(size(levels), rows), population%reached(size(levels), states, rows), source=0)
      allocate (population%curve(states, rows), population%combined(states, population%walls()))
   end subroutine new_population_counts

   !> Number of rows
   pure integer function rows(self)
      class(population_counts_type), intent(in) :: self

      rows = size(self%weight)
   end function rows

   !> Number of walls
   pure integer function walls(self)
      class(population_counts_type), intent(in) :: self

      walls = size(self%first) - 1
   end function walls

   !> Fit the curves of all rows and walls, in all states
   subroutine fit(self, error)
      !> The population: the curves are set
      class(population_counts_type), intent(inout) :: self
      !> Counts of the first wall that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      type(error_type), allocatable :: trouble
      integer :: i, k, first_failed

      first_failed = huge(1)
      !$omp parallel do default(none) private(k, trouble) shared(self, first_failed, error) schedule(dynamic, 8)
      do i = 1, self%walls()
         do k = 1, size(self%curve, 1)
            call fit_wall(self, i, k, trouble)
            if (.not. allocated(trouble)) cycle
            !$omp critical (first_wall_that_failed)
            if (i < first_failed) then
               first_failed = i
               call move_alloc(trouble, error)
            end if
            !$omp end critical (first_wall_that_failed)
            exit
         end do
      end do
      !$omp end parallel do
   end subroutine fit

   !> Fit the curves of a wall
   subroutine fit_wall(self, number, state, error)
      class(population_counts_type), intent(inout) :: self
      !> Number of the wall
      integer, intent(in) :: number
      !> Number of the state
      integer, intent(in) :: state
      !> Counts that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      type(wall_curves_type) :: curves
      real(wp) :: histories(size(self%levels))
      integer :: i

      do i = self%first(number), self%first(number + 1) - 1
         histories = real(self%histories(:, i), wp)
         call fit_fragility(self%curve(state, i), self%levels, real(self%reached(:, state, i), wp), histories, error)
         if (allocated(error)) return
      end do
      curves = self%wall(number, state)
      call curves%fit(self%levels, error)
      self%combined(state, number) = curves%combined
   end subroutine fit_wall

   !> A wall with the curves of its mechanisms
   function wall(self, number, state) result(curves)
      !> The population, fitted
      class(population_counts_type), intent(in) :: self
      !> Number of the wall
      integer, intent(in) :: number
      !> Number of the damage state
      integer, intent(in) :: state
      !> The wall
      type(wall_curves_type) :: curves

      integer :: last

      associate (i => self%first(number))
         last = self%first(number + 1) - 1
         curves%group = ''
         if (self%group(i) > 0) curves%group = self%groups%line(self%group(i))%text
         curves%weight = self%weight(i)
         curves%mechanism = mechanism_names(self%mechanism(i:last))
         curves%p_occ = self%p_occ(i:last)
         curves%curve = self%curve(state, i:last)
         curves%fraction = real(self%reached(:, state, i:last), wp)/real(self%histories(:, i:last), wp)
         curves%histories = self%histories(:, i:last)
         curves%combined = self%combined(state, number)
      end associate
   end function wall

end module dondolo_population_counts
