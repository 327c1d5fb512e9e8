!> A population of walls: its rows with their weights and groups, how many of their histories reach each damage state, and
!> their curves. All curves of the population are made of it.
!>
!> A row is one mechanism of a wall; the rows of a wall stand one after the other. What rows and walls both have stands in
!> columns: first those of the rows, behind them those of the walls as a whole. It is kept
!> in memory, in arrays: about 300 bytes a row and state at 20 levels; geometry is not kept.
module dondolo_population
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_memory, only : check_room
   use dondolo_fragility, only : fit_fragility, fragility_type
   use dondolo_population_occurrence, only : fit_share, occurrence_of, wall_probability
   use dondolo_wall, only : mechanism_names
   implicit none
   private

   public :: population_type, row_type, part_type, interpolated

   !> A row: one mechanism of a wall. Numbers of eight bytes come first: there are many rows, and nothing is to stand between
   type :: row_type
      !> Weight of the wall, >= 0
      real(wp) :: weight = 1.0_wp
      !> Probability that the mechanism can occur
      real(wp) :: p_occ = 1.0_wp
      !> Number of the wall
      integer :: wall = 0
      !> Number of the mechanism among mechanism_names
      integer :: mechanism = 0
      !> Number of the group of the wall; 0: none
      integer :: group = 0
      !> Number of its alternative among those of the wall; 0: the mechanisms of the wall are independent
      integer :: alternative = 0
   end type row_type

   !> A part of a population: the rows of one mechanism, or the walls as a whole, of one group or of all
   type :: part_type
      !> Number of the mechanism among mechanism_names, 0: the walls as a whole
      integer :: mechanism = 0
      !> Number of the group, 0: all walls
      integer :: group = 0
   end type part_type

   !> A population
   type :: population_type
      !> How many rows and walls there are
      integer :: rows = 0, walls = 0
      !> The rows; those beyond `rows` are room
      type(row_type), allocatable :: row(:)
      !> Names of the groups, in the order in which they appear
      type(lines_type) :: groups
      !> First row of each wall, and behind them the number of rows + 1
      integer, allocatable :: first(:)
      !> Levels of intensity
      real(wp), allocatable :: levels(:)
      !> Histories of each row in each stripe (levels, rows)
      integer, allocatable :: histories(:, :)
      !> How many of them reach each damage state (levels, states, rows)
      integer, allocatable :: reached(:, :, :)
      !> Curves (states, places). That of a wall is the lognormal of what can collapse: fitted to its fractions / occurrence,
      !> or that of its mechanism, if one always can occur
      type(fragility_type), allocatable :: curve(:, :)
      !> Place of the curve of each wall: one with a single mechanism that always can occur has that of its row
      integer, allocatable :: place_of_wall(:)
   contains
      !> Add a row
      procedure :: add
      !> All rows are there: give back room for more
      procedure :: trim_rows
      !> Take the rows of another, which has none afterwards
      procedure :: take_rows
      !> Make room for the histories of all rows
      procedure :: begin
      !> Fit the curves
      procedure :: fit
      !> Place of the curve of a column
      procedure :: place
      !> Rows of a wall
      procedure :: rows_of
      !> Has a wall several rows?
      procedure :: is_several
      !> Can mechanisms of a wall occur together?
      procedure :: can_coincide
      !> Weights of columns in a part
      procedure :: weight_in
      !> How many walls have a weight in a part
      procedure :: walls_in
      !> Number of a group
      procedure :: number_of_group
      !> Part of a mechanism and a group
      procedure :: part
      !> Probability that a column can collapse
      procedure :: occurrence
      !> How likely its mechanisms can occur, and which of them together
      procedure :: get_occurrence
      !> Histories of a column
      procedure :: histories_of
      !> Fractions of collapse of a column
      procedure :: fraction
      !> Probabilities of collapse of columns
      procedure :: probabilities
   end type population_type

contains

   !> Add a row
   subroutine add(self, mechanism, group, weight, p_occ, alternative, continues)
      class(population_type), intent(inout) :: self
      !> One of mechanism_names
      character(len=*), intent(in) :: mechanism
      !> Name of the group, empty if there is none
      character(len=*), intent(in) :: group
      !> Weight of the wall, >= 0
      real(wp), intent(in) :: weight
      !> Probability that the mechanism can occur
      real(wp), intent(in) :: p_occ
      !> Number of its alternative among those of the wall; 0: the mechanisms of the wall are independent
      integer, intent(in) :: alternative
      !> Is it a further mechanism of the wall in the row before?
      logical, intent(in) :: continues

      type(row_type), allocatable :: more(:)

      if (.not. allocated(self%row)) allocate (self%row(64))
      if (self%rows == size(self%row)) then
         allocate (more(2*self%rows))
         more(:self%rows) = self%row
         call move_alloc(more, self%row)
      end if
      self%rows = self%rows + 1
      if (.not. continues) self%walls = self%walls + 1
      if (len(group) > 0 .and. self%number_of_group(group) == 0) call self%groups%add(group)
      self%row(self%rows) = row_type(weight, p_occ, self%walls, &
         & findloc(mechanism_names == mechanism, .true., dim=1), self%number_of_group(group), alternative)
   end subroutine add

   !> All rows are there: give back room for more
   subroutine trim_rows(self)
      class(population_type), intent(inout) :: self

      if (.not. allocated(self%row)) return
      if (size(self%row) > self%rows) self%row = self%row(:self%rows)
   end subroutine trim_rows

   !> Take the rows of another, which has none afterwards: those of many walls are held once
   subroutine take_rows(self, other)
      class(population_type), intent(inout) :: self
      type(population_type), intent(inout) :: other

      self%rows = other%rows
      self%walls = other%walls
      self%groups = other%groups
      call move_alloc(other%row, self%row)
      other = population_type()
   end subroutine take_rows

   !> Make room for the histories of all rows, of which there are none so far
   subroutine begin(self, levels, states, error)
      class(population_type), intent(inout) :: self
      !> Levels of intensity
      real(wp), intent(in) :: levels(:)
      !> Number of damage states
      integer, intent(in) :: states
      !> Lack of memory
      type(error_type), allocatable, intent(out) :: error

      real(wp), parameter :: bytes_of_row = 64.0_wp, bytes_of_count = 4.0_wp, bytes_of_curve = 192.0_wp
      integer :: i, curves

      call check_room(real(self%rows, wp)*(bytes_of_row + real(states, wp)*bytes_of_count*real(size(levels), wp)) &
         & + real(self%rows + self%walls, wp)*real(states, wp)*bytes_of_curve, error)
      if (allocated(error)) return
      self%levels = levels
      call self%trim_rows()
      self%first = [(0, i=1, self%walls), self%rows + 1]
      do i = self%rows, 1, -1
         self%first(self%row(i)%wall) = i
      end do
      self%place_of_wall = self%first(:self%walls)
      curves = self%rows
      do i = 1, self%walls
         if (.not. self%is_several(i) .and. self%row(self%first(i))%p_occ >= 1.0_wp) cycle
         curves = curves + 1
         self%place_of_wall(i) = curves
      end do
      allocate (self%histories(size(levels), self%rows), self%reached(size(levels), states, self%rows), source=0)
      allocate (self%curve(states, curves))
   end subroutine begin

   !> Fit the curves of all rows and walls, in all states
   subroutine fit(self, error)
      !> The population: the curves are set
      class(population_type), intent(inout) :: self
      !> Counts of the first wall that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      type(error_type), allocatable :: trouble
      integer :: i, k, first_failed

      first_failed = huge(1)
      !$omp parallel do default(none) private(k, trouble) shared(self, first_failed, error) schedule(dynamic, 8)
      do i = 1, self%walls
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
   subroutine fit_wall(self, wall, state, error)
      class(population_type), intent(inout) :: self
      !> Number of the wall
      integer, intent(in) :: wall
      !> Number of the state
      integer, intent(in) :: state
      !> Counts that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      integer :: i, column, place

      do i = self%first(wall), self%first(wall + 1) - 1
         call fit_fragility(self%curve(state, i), self%levels, real(self%reached(:, state, i), wp), &
            & real(self%histories(:, i), wp), error)
         if (allocated(error)) return
      end do
      column = self%rows + wall
      place = self%place_of_wall(wall)
      if (place <= self%rows) return
      call fit_share(self%curve(state, place), self%levels, self%fraction(column, state), self%occurrence(column), &
         & real(self%histories_of(column), wp), error)
   end subroutine fit_wall

   !> Place of the curve of a column: that of a row is its number
   elemental integer function place(self, column)
      class(population_type), intent(in) :: self
      !> Number of the column
      integer, intent(in) :: column

      place = column
      if (column > self%rows) place = self%place_of_wall(column - self%rows)
   end function place

   !> Rows of a wall, or of a row itself
   pure function rows_of(self, column) result(rows)
      class(population_type), intent(in) :: self
      !> Number of the column
      integer, intent(in) :: column
      !> First and last row
      integer :: rows(2)

      rows = column
      if (column > self%rows) rows = [self%first(column - self%rows), self%first(column - self%rows + 1) - 1]
   end function rows_of

   !> Has a wall several rows?
   elemental logical function is_several(self, wall)
      class(population_type), intent(in) :: self
      !> Number of the wall
      integer, intent(in) :: wall

      is_several = self%first(wall + 1) - self%first(wall) > 1
   end function is_several

   !> Can any two mechanisms of a wall occur together?
   pure logical function can_coincide(self, wall)
      class(population_type), intent(in) :: self
      !> Number of the wall
      integer, intent(in) :: wall

      integer :: i

      can_coincide = .false.
      do i = self%first(wall) + 1, self%first(wall + 1) - 1
         can_coincide = can_coincide .or. self%row(i)%alternative == self%row(i - 1)%alternative
      end do
   end function can_coincide

   !> Weight of a column in a part of the population; 0: it does not belong to it. A row counts as often as it can occur
   elemental real(wp) function weight_in(self, part, column) result(weight)
      class(population_type), intent(in) :: self
      type(part_type), intent(in) :: part
      !> Number of the column
      integer, intent(in) :: column

      integer :: i

      i = column
      if (column > self%rows) i = self%first(column - self%rows)
      associate (row => self%row(i))
         weight = row%weight
         ! A product too small for a number counts as none.
         if (column <= self%rows) weight = weight*row%p_occ
         if (part%mechanism /= merge(row%mechanism, 0, column <= self%rows)) weight = 0.0_wp
         if (part%group > 0 .and. part%group /= row%group) weight = 0.0_wp
      end associate
   end function weight_in

   !> How many walls have a weight in a part, as a whole or with one of their rows
   pure integer function walls_in(self, part)
      class(population_type), intent(in) :: self
      type(part_type), intent(in) :: part

      integer :: i, k

      walls_in = 0
      do i = 1, self%walls
         if (self%weight_in(part, self%rows + i) > 0.0_wp .or. any(self%weight_in(part, [(k, k=self%first(i), &
            & self%first(i + 1) - 1)]) > 0.0_wp)) walls_in = walls_in + 1
      end do
   end function walls_in

   !> Number of a group
   pure integer function number_of_group(self, name) result(number)
      class(population_type), intent(in) :: self
      !> Name of a group; there is none of an empty name, whose number is 0
      character(len=*), intent(in) :: name

      do number = self%groups%count, 1, -1
         if (self%groups%line(number)%text == name) exit
      end do
   end function number_of_group

   !> Part of a mechanism and a group
   pure type(part_type) function part(self, mechanism, group)
      class(population_type), intent(in) :: self
      !> One of mechanism_names; any other name, such as 'all': the walls as a whole
      character(len=*), intent(in) :: mechanism
      !> Name of a group, empty for all walls
      character(len=*), intent(in) :: group

      part = part_type(findloc(mechanism_names == mechanism, .true., dim=1), self%number_of_group(group))
   end function part

   !> Probability that any mechanism of a column can occur, of which a row is what collapses if it does: 1 for a row
   pure real(wp) function occurrence(self, column)
      class(population_type), intent(in) :: self
      !> Number of the column
      integer, intent(in) :: column

      real(wp), allocatable :: p_occ(:)
      integer, allocatable :: alternative(:)

      occurrence = 1.0_wp
      if (column <= self%rows) return
      call self%get_occurrence(column, p_occ, alternative)
      occurrence = occurrence_of(p_occ, alternative)
   end function occurrence

   !> How likely the mechanisms of a column can occur, and which of them together
   pure subroutine get_occurrence(self, column, p_occ, alternative)
      class(population_type), intent(in) :: self
      !> Number of the column
      integer, intent(in) :: column
      !> Of each of its rows the probability that it can occur, and its alternative
      real(wp), allocatable, intent(out) :: p_occ(:)
      integer, allocatable, intent(out) :: alternative(:)

      integer :: of(2)

      of = self%rows_of(column)
      p_occ = self%row(of(1):of(2))%p_occ
      alternative = self%row(of(1):of(2))%alternative
   end subroutine get_occurrence

   !> Histories of a column in each stripe; a wall has no more than its rows have
   pure function histories_of(self, column) result(histories)
      class(population_type), intent(in) :: self
      !> Number of the column
      integer, intent(in) :: column
      !> Histories (levels)
      integer :: histories(size(self%levels))

      associate (of => self%rows_of(column))
         histories = minval(self%histories(:, of(1):of(2)), dim=2)
      end associate
   end function histories_of

   !> Fractions of collapse of a column
   pure function fraction(self, column, state) result(whole)
      class(population_type), intent(in) :: self
      !> Numbers of the column and of the damage state
      integer, intent(in) :: column, state
      !> Fractions (levels): of a row if it can occur
      real(wp) :: whole(size(self%levels))

      real(wp), allocatable :: p_occ(:)
      integer, allocatable :: alternative(:)
      integer :: of(2)

      of = self%rows_of(column)
      call self%get_occurrence(column, p_occ, alternative)
      associate (rows => real(self%reached(:, state, of(1):of(2)), wp)/real(self%histories(:, of(1):of(2)), wp))
         if (column <= self%rows) whole = rows(:, 1)
         if (column > self%rows) whole = wall_probability(p_occ, alternative, rows)
      end associate
   end function fraction

   !> Probabilities of collapse of columns at any levels. A row without a fit takes part with its fractions: between the levels
   !> they are interpolated linearly, from 0 at x = 0; above the highest level they stay
   subroutine probabilities(self, state, columns, x, p, error)
      !> The population, fitted
      class(population_type), intent(in) :: self
      !> Number of the damage state
      integer, intent(in) :: state
      !> Numbers of the columns
      integer, intent(in) :: columns(:)
      !> Levels of intensity, not negative
      real(wp), intent(in) :: x(:)
      !> Probabilities (columns, x): of a row if it can occur
      real(wp), allocatable, intent(out) :: p(:, :)
      !> Lack of memory
      type(error_type), allocatable, intent(out) :: error

      real(wp), allocatable :: p_occ(:), rows(:, :)
      integer, allocatable :: alternative(:)
      integer :: i, k, of(2)

      call check_room(real(storage_size(p)/8, wp)*real(size(x), wp)*real(size(columns), wp), error)
      if (allocated(error)) return
      allocate (p(size(columns), size(x)))
      do i = 1, size(columns)
         if (self%place(columns(i)) <= self%rows) then
            p(i, :) = probability_of_row(self, self%place(columns(i)), state, x)
            cycle
         end if
         of = self%rows_of(columns(i))
         allocate (rows(size(x), of(1):of(2)))
         do k = of(1), of(2)
            rows(:, k) = probability_of_row(self, k, state, x)
         end do
         call self%get_occurrence(columns(i), p_occ, alternative)
         p(i, :) = wall_probability(p_occ, alternative, rows)
         deallocate (rows)
      end do
   end subroutine probabilities

   !> Probability of collapse of a row, if it can occur
   pure function probability_of_row(self, row, state, x) result(p)
      class(population_type), intent(in) :: self
      !> Numbers of the row and of the damage state
      integer, intent(in) :: row, state
      !> Levels of intensity
      real(wp), intent(in) :: x(:)
      !> Probabilities there
      real(wp) :: p(size(x))

      if (self%curve(state, row)%has_fit()) then
         p = self%curve(state, row)%probability(x)
      else
         p = interpolated(self%levels, self%fraction(row, state), x)
      end if
   end function probability_of_row

   !> Fractions at any levels, on the lines between those that are known
   pure function interpolated(levels, fractions, x) result(p)
      !> Levels of intensity, positive and increasing
      real(wp), intent(in) :: levels(:)
      !> Fractions there
      real(wp), intent(in) :: fractions(:)
      !> Levels that are asked for
      real(wp), intent(in) :: x(:)
      !> Fractions at these
      real(wp) :: p(size(x))

      real(wp) :: below, before
      integer :: i, j

      do i = 1, size(x)
         j = count(levels <= x(i))
         below = 0.0_wp
         before = 0.0_wp
         if (j > 0) then
            below = fractions(j)
            before = levels(j)
         end if
         p(i) = below
         if (j < size(levels) .and. x(i) > before) then
            p(i) = below + (fractions(j + 1) - below)*(x(i) - before)/(levels(j + 1) - before)
         end if
      end do
   end function interpolated

end module dondolo_population
