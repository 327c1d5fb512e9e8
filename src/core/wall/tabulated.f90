!> A mechanism whose terms are tables: anybody's, from a calculation by hand, another program or a test.
!>
!> J, L and G - Q over the rotation, and where the ground moves vertically the lever S of all masses, become polynomials
!> (dondolo_wall_table_fit). C is half the slope of J, V the integral of G - Q: nothing is differentiated numerically.
module dondolo_wall_tabulated
   use dondolo_base_bracket, only : bracket_type
   use dondolo_base_chebyshev, only : chebyshev_integral, chebyshev_slope, chebyshev_value
   use dondolo_base_error, only : error_type, not_at_rest, out_of_range, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : rounded
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_restraint, only : elastic, restraint_type
   use dondolo_wall_table_fit, only : fit_table
   implicit none
   private

   public :: tabulated_type, table_type, new_tabulated, largest_misfit

   !> Largest distance of a row from its polynomial / largest value of its column: a table that is further off is not smooth
   real(wp), parameter :: largest_misfit = 1.0e-3_wp

   !> What the moment may be at the last rotation / largest moment, where a table ends at its capacity
   real(wp), parameter :: least_moment = 1.0e-9_wp

   !> Part of the range that the polynomials go on for to both sides, for steps that look a little beyond
   real(wp), parameter :: beyond = 0.1_wp

   !> Places at which signs are checked
   integer, parameter :: places = 2000

   !> The terms over the rotation, per metre of wall; columns of a table
   type :: table_type
      !> Rotations, from 0 on [rad]
      real(wp), allocatable :: rotation(:)
      !> Inertia J [kg m2], excitation lever L [kg m] and restoring moment G - Q [N m]
      real(wp), allocatable :: inertia(:), lever(:), moment(:)
      !> Lever S of all masses that move up [kg m]; of size 0: not known
      real(wp), allocatable :: vertical_lever(:)
   end type table_type

   !> A mechanism whose terms are polynomials
   type, extends(mechanism_type) :: tabulated_type
      !> Last rotation of the table [rad]
      real(wp) :: last = 0.0_wp
      !> Chebyshev series of J, of its slope, of L, of G - Q, of its integral, and of S; that of S is not allocated: not known
      real(wp), allocatable :: inertia(:), slope(:), lever(:), restoring(:), work(:), vertical(:)
      !> Share k of the acceleration of its top, times its height [m], and tilt tau, times its height [m/s2]
      real(wp) :: share = 0.0_wp, tilt = 0.0_wp
      !> Forces of its ties, T = force + stiffness D; not allocated: it has none
      real(wp), allocatable, private :: force(:), stiffness(:)
   contains
      !> Give it ties, none of which has yielded yet
      procedure :: add_ties
      procedure :: set_restraints
      procedure :: terms
      procedure :: potential
      procedure :: geometric_end
      procedure :: support
      procedure :: knows_vertical
      procedure, private :: place
   end type tabulated_type

contains

   !> Make the mechanism of a table
   subroutine new_tabulated(mechanism, table, gravity, two_sided, misfit, error)
      type(tabulated_type), intent(out) :: mechanism
      !> The table: five rows at least, the rotations from 0 on, each more than the one before
      type(table_type), intent(in) :: table
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> Does it rock to both sides?
      logical, intent(in) :: two_sided
      !> Largest distance of a row from its polynomial / largest value of its column, of all columns
      real(wp), intent(out) :: misfit
      !> The table is not smooth, or no wall's
      type(error_type), allocatable, intent(out) :: error

      misfit = 0.0_wp
      mechanism%two_sided = two_sided
      mechanism%gravity = gravity
      mechanism%last = table%rotation(size(table%rotation))
      mechanism%lowest = -beyond*mechanism%last
      mechanism%highest = (1.0_wp + beyond)*mechanism%last
      call fit('inertia', table%inertia, mechanism%inertia)
      call fit('lever', table%lever, mechanism%lever)
      call fit('moment', table%moment, mechanism%restoring)
      if (size(table%vertical_lever) > 0) call fit('vertical_lever', table%vertical_lever, mechanism%vertical)
      if (allocated(error)) return
      mechanism%slope = 2.0_wp/mechanism%last*chebyshev_slope(mechanism%inertia)
      mechanism%work = 0.5_wp*mechanism%last*chebyshev_integral([mechanism%restoring, 0.0_wp])
      call find_capacity(mechanism, misfit, error)
      if (.not. allocated(error)) call check_signs(mechanism, error)

   contains

      !> Fit a column
      subroutine fit(name, values, series)
         !> Its name, for messages
         character(len=*), intent(in) :: name
         !> Its values
         real(wp), intent(in) :: values(:)
         !> Its series
         real(wp), allocatable, intent(out) :: series(:)

         real(wp) :: own

         if (allocated(error)) return
         call fit_table(table%rotation, values, series, own)
         misfit = max(misfit, own)
         if (own <= largest_misfit) return
         call raise_input(error, name//': the smooth curve through its values misses them by up to '//rounded(100.0_wp*own)// &
            & ' % of the largest, must be within '//rounded(100.0_wp*largest_misfit)//' %: a table with a corner has to be '// &
            & 'rounded off, one with few or uneven rows needs more of them', out_of_range, name)
      end subroutine fit

   end subroutine new_tabulated

   !> Find the rotation at which the moment vanishes, and check that it does so once
   subroutine find_capacity(mechanism, misfit, error)
      !> The mechanism: its capacity is set
      type(tabulated_type), intent(inout) :: mechanism
      !> Misfit of its columns
      real(wp), intent(in) :: misfit
      !> It does not stand at rest, or never falls, or rights itself again
      type(error_type), allocatable, intent(out) :: error

      type(bracket_type) :: bracket
      real(wp) :: moment(0:places), largest
      integer :: first, i

      moment = [(mechanism%moment(mechanism%last*real(i, wp)/real(places, wp)), i=0, places)]
      largest = maxval(abs(moment))
      if (.not. moment(0) > 0.0_wp) then
         call raise_input(error, 'moment: is '//rounded(moment(0))//' N m at rotation 0, must be positive: else the wall is '// &
            & 'not stable at rest', not_at_rest, 'moment')
         return
      end if
      first = findloc(moment <= 0.0_wp, .true., dim=1) - 1
      if (first < 0 .and. moment(places) <= max(least_moment, misfit)*largest) then
         ! The table ends where the wall falls, to rounding.
         mechanism%capacity = mechanism%last
         return
      else if (first < 0) then
         call raise_input(error, 'moment: is '//rounded(moment(places))//' N m at the last rotation, '// &
            & rounded(mechanism%last)//' rad, must fall to 0: the table must extend to the rotation at which the wall falls', &
            & out_of_range, 'moment')
         return
      end if
      bracket = bracket_type(mechanism%last*real(first - 1, wp)/real(places, wp), mechanism%last*real(first, wp)/real(places, wp))
      do while (bracket%is_divisible())
         call bracket%halve(mechanism%moment(bracket%middle()) > 0.0_wp)
      end do
      mechanism%capacity = bracket%middle()
      i = findloc(moment(first + 1:) > max(least_moment, misfit)*largest, .true., dim=1)
      if (i > 0) call raise_input(error, 'moment: vanishes at '//rounded(mechanism%capacity)//' rad and is positive again at '// &
         & rounded(mechanism%last*real(first + i, wp)/real(places, wp))//' rad: the table must end before that', &
         & out_of_range, 'moment')
   end subroutine find_capacity

   !> Check that inertia and lever are those of a wall
   subroutine check_signs(mechanism, error)
      !> The mechanism with its capacity
      type(tabulated_type), intent(in) :: mechanism
      !> One of them is not positive
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: q
      integer :: i

      do i = 0, places
         q = mechanism%last*real(i, wp)/real(places, wp)
         if (.not. chebyshev_value(mechanism%inertia, mechanism%place(q)) > 0.0_wp) then
            call raise_input(error, 'inertia: must be positive, is not at '//rounded(q)//' rad', out_of_range, 'inertia')
         else if (q <= mechanism%capacity .and. .not. chebyshev_value(mechanism%lever, mechanism%place(q)) > 0.0_wp) then
            call raise_input(error, 'lever: must be positive up to the rotation at which the moment vanishes, is not at '// &
               & rounded(q)//' rad', out_of_range, 'lever')
         end if
         if (allocated(error)) return
      end do
   end subroutine check_signs

   !> Give it ties, none of which has yielded yet
   pure subroutine add_ties(self, ties)
      class(tabulated_type), intent(inout) :: self
      !> With their elongation along this mechanism
      type(restraint_type), intent(in) :: ties(:)

      real(wp), dimension(size(ties)) :: force, stiffness

      self%restraints = ties
      self%ties = size(ties)
      self%preload = sum(ties%preload*ties%lever_at(0.0_wp))
      call ties%linear_force(spread(elastic, 1, size(ties)), 0.0_wp, force, stiffness)
      call self%set_restraints(force, stiffness)
   end subroutine add_ties

   !> Set the forces of the ties
   pure subroutine set_restraints(self, force, stiffness)
      class(tabulated_type), intent(inout) :: self
      !> Of each of them: T = force + stiffness D [N/m] and [N/m per m], of a whole body [N] and [N/m]
      real(wp), intent(in) :: force(:), stiffness(:)

      self%force = force
      self%stiffness = stiffness
   end subroutine set_restraints

   !> Place of a rotation in the range of the series
   pure elemental real(wp) function place(self, q)
      class(tabulated_type), intent(in) :: self
      !> Rotation [rad]
      real(wp), intent(in) :: q

      place = 2.0_wp*q/self%last - 1.0_wp
   end function place

   !> Terms of the tables. Where no vertical lever is known all of the moment counts as that of gravity
   pure subroutine terms(self, q, j, c, g, l, load)
      class(tabulated_type), intent(in) :: self
      !> Rotation [rad]
      real(wp), intent(in) :: q
      !> Inertia J [kg m2]
      real(wp), intent(out) :: j
      !> C = 1/2 dJ/dq [kg m2]
      real(wp), intent(out) :: c
      !> Restoring moment G of the masses that move up [N m]
      real(wp), intent(out) :: g
      !> Excitation lever L [kg m]
      real(wp), intent(out) :: l
      !> Generalised force Q of all else [N m]
      real(wp), intent(out) :: load

      real(wp) :: z

      z = self%place(q)
      j = chebyshev_value(self%inertia, z)
      c = 0.5_wp*chebyshev_value(self%slope, z)
      l = chebyshev_value(self%lever, z)
      g = chebyshev_value(self%restoring, z)
      load = 0.0_wp
      if (allocated(self%vertical)) then
         load = -g
         g = self%gravity*chebyshev_value(self%vertical, z)
         load = load + g
      end if
      if (allocated(self%force)) load = load - sum((self%force + self%stiffness*self%restraints%elongation(q)) &
         & *self%restraints%lever_at(q))
   end subroutine terms

   !> Work against the moment from rest
   pure function potential(self, q) result(v)
      class(tabulated_type), intent(in) :: self
      !> Rotation [rad]
      real(wp), intent(in) :: q
      !> V [J]
      real(wp) :: v

      v = chebyshev_value(self%work, self%place(q))
      if (allocated(self%force)) v = v + sum((self%force + 0.5_wp*self%stiffness*self%restraints%elongation(q)) &
         & *self%restraints%elongation(q))
   end function potential

   !> The next rotation after the last of the table, which itself is one of its own
   pure function geometric_end(self) result(q)
      class(tabulated_type), intent(in) :: self
      !> Rotation [rad]
      real(wp) :: q

      q = nearest(self%last, 1.0_wp)
   end function geometric_end

   !> Its supports, as given
   pure subroutine support(self, share, tilt)
      class(tabulated_type), intent(in) :: self
      !> k h [m]
      real(wp), intent(out) :: share
      !> tau h [m/s2]
      real(wp), intent(out) :: tilt

      share = self%share
      tilt = self%tilt
   end subroutine support

   !> Whether it knows which part of the moment vertical motion of the ground changes
   pure logical function knows_vertical(self)
      class(tabulated_type), intent(in) :: self

      knows_vertical = allocated(self%vertical)
   end function knows_vertical

end module dondolo_wall_tabulated
