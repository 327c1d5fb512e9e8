!> Walls: uploading, describing and reading them.
module walls
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use dondolo_base_error, only : error_type, raise_input
   use dondolo_base_text, only : to_text
   use dondolo_boundary, only : check_room
   use dondolo_check_tie_rows, only : list_open_anchors => open_anchors
   use dondolo_fragility_tie_tallies, only : tally => tally_ties, tie_tally_type
   use dondolo_interface_handles, only : find_walls, hold, walls_type
   use dondolo_motion_response, only : response_type
   use dondolo_parcel, only : parcel_type, report, send
   use dondolo_population_table, only : population_table_type
   use dondolo_wall, only : wall_type
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_parcel, only : set_facts, set_positions, set_walls, take_rows, walls_parcel_type
   use dondolo_wall_strip_bending, only : pinned_period
   use dondolo_wall_tie_statics, only : ties_after
   implicit none
   private

   public :: new_walls, describe_walls, wall_terms, chain_motion, chain_facts, chain_rows, bending_period, tie_states, open_anchors
   public :: read_walls, tally_ties

contains

   !> Period of a strip between pinned ends, of a modulus of elasticity; infinite if its load buckles it
   subroutine bending_period(walls, modulus, period, failure)
      integer(c_int64_t), intent(in) :: walls
      real(c_double), intent(in) :: modulus
      real(c_double), intent(out) :: period
      integer(c_int64_t), intent(out) :: failure(5)
      type(wall_type), pointer :: wall(:)
      type(error_type), allocatable :: error

      period = 0.0_c_double
      call find_walls(walls, wall, error)
      if (.not. allocated(error)) then
         associate (wall => wall(1))
            period = pinned_period(wall%input%number('height'), wall%input%number('thickness'), wall%input%number('density'), &
               & wall%input%number('overburden'), wall%gravity, modulus)
         end associate
      end if
      call report(error, failure)
   end subroutine bending_period

   !> Upload walls that Python has had described
   subroutine new_walls(texts, numbers, n, given, q, gravity, w, handle, failure)
      character(len=*), intent(in) :: texts
      integer(c_int), intent(in) :: n, q, w, given(q, w)
      real(c_double), intent(in) :: numbers(n), gravity(w)
      integer(c_int64_t), intent(out) :: handle
      integer(c_int64_t), intent(out) :: failure(5)
      type(walls_type), pointer :: walls
      class(*), pointer :: content
      type(error_type), allocatable :: error

      handle = 0
      allocate (walls)
      call set_walls(walls%wall, texts, numbers, given, gravity, error)
      if (allocated(error)) then
         deallocate (walls)
      else
         content => walls
         call hold(content, handle)
      end if
      call report(error, failure)
   end subroutine new_walls

   !> Walls with their defaults filled in and their static quantities, as walls_parcel_type has them
   subroutine describe_walls(texts, numbers, n, given, q, gravity, w, sent)
      character(len=*), intent(in) :: texts
      integer(c_int), intent(in) :: n, q, w, given(q, w)
      real(c_double), intent(in) :: numbers(n), gravity(w)
      integer(c_int64_t), intent(out) :: sent(5)
      type(wall_type), allocatable :: walls(:)
      type(walls_parcel_type) :: packed
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      integer :: i

      call set_walls(walls, texts, numbers, given, gravity, error)
      if (.not. allocated(error)) then
         do i = 1, size(walls)
            call packed%add_wall(walls(i))
         end do
         call packed%put_walls(parcel)
      end if
      call send(parcel, error, sent)
   end subroutine describe_walls

   !> Terms J, C, G, L and Q of the equation of motion of a wall and its potential energy V, one column each, at n rotations
   subroutine wall_terms(walls, rotation, n, terms, failure)
      !f2py threadsafe
      integer(c_int64_t), intent(in) :: walls
      integer(c_int), intent(in) :: n
      real(c_double), intent(in) :: rotation(n)
      real(c_double), intent(out) :: terms(n, 6)
      integer(c_int64_t), intent(out) :: failure(5)
      type(wall_type), pointer :: wall(:)
      type(error_type), allocatable :: error
      integer :: i

      terms = 0
      call find_walls(walls, wall, error)
      if (.not. allocated(error)) call check_rotations(wall(1)%mechanism, rotation, error)
      if (.not. allocated(error)) then
         associate (mechanism => wall(1)%mechanism)
            do i = 1, n
               call mechanism%terms(rotation(i), terms(i, 1), terms(i, 2), terms(i, 3), terms(i, 4), terms(i, 5))
               terms(i, 6) = mechanism%potential(rotation(i))
            end do
         end associate
      end if
      call report(error, failure)
   end subroutine wall_terms

   !> Positions (x, y, phi) of the k bodies of a chain at n rotations
   subroutine chain_motion(walls, rotation, n, k, positions, failure)
      integer(c_int64_t), intent(in) :: walls
      integer(c_int), intent(in) :: n, k
      real(c_double), intent(in) :: rotation(n)
      real(c_double), intent(out) :: positions(3, k, n)
      integer(c_int64_t), intent(out) :: failure(5)
      type(wall_type), pointer :: wall(:)
      type(error_type), allocatable :: error

      positions = 0
      call find_walls(walls, wall, error)
      if (.not. allocated(error)) call check_rotations(wall(1)%mechanism, rotation, error)
      if (.not. allocated(error)) then
         call set_positions(wall(1), rotation, positions)
      end if
      call report(error, failure)
   end subroutine chain_motion

   !> Multipliers of a chain outwards and inwards and bound of its restitution, huge if they are not known; 1: it moves inwards as
   !> its mirror image, and 1: its masonry is one
   subroutine chain_facts(walls, facts, failure)
      integer(c_int64_t), intent(in) :: walls
      real(c_double), intent(out) :: facts(5)
      integer(c_int64_t), intent(out) :: failure(5)
      type(wall_type), pointer :: wall(:)
      type(error_type), allocatable :: error

      facts = 0
      call find_walls(walls, wall, error)
      if (.not. allocated(error)) call set_facts(wall(1), facts)
      call report(error, failure)
   end subroutine chain_facts

   !> Numbers of the rows of a chain, of its bodies (1), joints (2), actions (3) or ties (4): the first n of them, and how many
   !> there are
   subroutine chain_rows(walls, table, n, numbers, count, failure)
      integer(c_int64_t), intent(in) :: walls
      integer(c_int), intent(in) :: table, n
      real(c_double), intent(out) :: numbers(n)
      integer(c_int), intent(out) :: count
      integer(c_int64_t), intent(out) :: failure(5)
      type(wall_type), pointer :: wall(:)
      type(error_type), allocatable :: error

      numbers = 0
      count = 0
      call find_walls(walls, wall, error)
      if (.not. allocated(error)) call take_rows(wall(1), table, numbers, count)
      call report(error, failure)
   end subroutine chain_rows

   !> Plastic elongation of each of the k ties of a wall, energy dissipated, and 1 where it is broken, after n largest
   !> rotations / capacity
   subroutine tie_states(walls, edp, n, k, elongation, energy, broken, failure)
      integer(c_int64_t), intent(in) :: walls
      integer(c_int), intent(in) :: n, k
      real(c_double), intent(in) :: edp(n)
      real(c_double), intent(out) :: elongation(k, n), energy(k, n)
      integer(c_int), intent(out) :: broken(k, n)
      integer(c_int64_t), intent(out) :: failure(5)
      type(wall_type), pointer :: wall(:)
      type(error_type), allocatable :: error
      logical :: is_broken(k)
      integer :: i

      elongation = 0
      energy = 0
      broken = 0
      call find_walls(walls, wall, error)
      if (.not. allocated(error)) then
         do i = 1, n
            call ties_after(wall(1)%mechanism, edp(i), elongation(:, i), is_broken)
            energy(:, i) = wall(1)%mechanism%restraints(:k)%strength*elongation(:, i)
            broken(:, i) = merge(1, 0, is_broken)
         end do
      end if
      call report(error, failure)
   end subroutine tie_states

   !> 1 for each of the k ties of a wall whose anchor has no strength
   subroutine open_anchors(walls, k, is_open, failure)
      integer(c_int64_t), intent(in) :: walls
      integer(c_int), intent(in) :: k
      integer(c_int), intent(out) :: is_open(k)
      integer(c_int64_t), intent(out) :: failure(5)
      type(wall_type), pointer :: wall(:)
      type(error_type), allocatable :: error

      is_open = 0
      call find_walls(walls, wall, error)
      if (.not. allocated(error)) is_open = merge(1, 0, list_open_anchors(wall(1)))
      call report(error, failure)
   end subroutine open_anchors

   !> What the histories of m stripes of n each, of which some ran, do to the k ties of a wall
   subroutine tally_ties(walls, edp, ran, n, m, k, counts, elongations, failure)
      integer(c_int64_t), intent(in) :: walls
      integer(c_int), intent(in) :: n, m, k, ran(n, m)
      real(c_double), intent(in) :: edp(n, m)
      integer(c_int), intent(out) :: counts(2, k, m)
      real(c_double), intent(out) :: elongations(2, k, m)
      integer(c_int64_t), intent(out) :: failure(5)
      type(wall_type), pointer :: wall(:)
      type(response_type), allocatable :: response(:, :)
      type(tie_tally_type), allocatable :: tallies(:, :)
      type(error_type), allocatable :: error

      counts = 0
      elongations = 0
      call check_room(error, histories=real(n, c_double)*m)
      if (.not. allocated(error)) call find_walls(walls, wall, error)
      if (.not. allocated(error)) then
         allocate (response(n, m))
         response%edp = edp
         call tally(wall(1)%mechanism, response, ran == 1, tallies)
         counts(1, :, :) = tallies%yielded
         counts(2, :, :) = tallies%broken
         elongations(1, :, :) = tallies%mean
         elongations(2, :, :) = tallies%largest
      end if
      call report(error, failure)
   end subroutine tally_ties

   !> Check that a mechanism can have rotations
   subroutine check_rotations(mechanism, rotation, error)
      !> The mechanism
      class(mechanism_type), intent(in) :: mechanism
      !> Rotations [rad]
      real(c_double), intent(in) :: rotation(:)
      !> The first that is negative or beyond the geometric end
      type(error_type), allocatable, intent(out) :: error

      real(c_double) :: last
      integer :: i

      last = mechanism%geometric_end()
      do i = 1, size(rotation)
         if (rotation(i) >= 0.0_c_double .and. rotation(i) < last) cycle
         call raise_input(error, 'rotation = '//to_text(rotation(i))//': must be at least 0 and less than '// &
            & to_text(last)//', where the geometry of this wall ends')
         return
      end do
   end subroutine check_rotations

   !> Read a population: its rows as walls_parcel_type has them, and notes: how the table was read, where there is something to
   !> say of it.
   !> occurrence: how the mechanisms of a wall occur whose row does not say it
   subroutine read_walls(path, gravity, occurrence, sent)
      character(len=*), intent(in) :: path, occurrence
      real(c_double), intent(in) :: gravity
      integer(c_int64_t), intent(out) :: sent(5)
      type(population_table_type) :: table
      type(walls_parcel_type) :: packed
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      character(len=:), allocatable :: note

      table%occurrence = occurrence
      call table%read(path, error, gravity)
      if (.not. allocated(error)) call packed%add_rows(table, error)
      if (.not. allocated(error)) then
         call packed%put_rows(table%notes, parcel)
         note = table%csv%note()
      end if
      call parcel%put_note(note)
      call send(parcel, error, sent)
   end subroutine read_walls

end module walls
