!> The grid of seismic hazard of D.M. 14 January 2008, annex B, table 1, which NTC 2018, 3.2 refers to, and what annex A makes of
!> it: between the nodes of a mesh, and between return periods.
!>
!>     p = sum(p_i/d_i)/sum(1/d_i)                                      of the four nodes, d_i their distances
!>     ln p = ln p_1 + ln(p_2/p_1) ln(T_R/T_1)/ln(T_2/T_1)              between two return periods of the table
!>
!> Places are in ED50. hazard_data.c has the numbers, with the three decimals that the decree prints.
module dondolo_check_hazard_grid
   use, intrinsic :: iso_c_binding, only : c_char, c_f_pointer, c_int, c_ptr
   use dondolo_base_kinds, only : pi, wp
   implicit none
   private

   public :: mesh_type, find_mesh, corners_of
   public :: grid_years

   !> Return periods of the table [years]
   real(wp), parameter :: grid_years(9) = [30.0_wp, 50.0_wp, 72.0_wp, 101.0_wp, 140.0_wp, 201.0_wp, 475.0_wp, 975.0_wp, &
      & 2475.0_wp]

   !> Units of longitudes and latitudes [deg], and of a_g [g], F_0 and T_C* [s]
   real(wp), parameter :: place_unit = 1.0e-6_wp, units(3) = [1.0e-4_wp, 1.0e-3_wp, 1.0e-3_wp]

   !> From a node to the next one in the south, and how far the nodes of a mesh are at most from a place in it [deg]
   integer, parameter :: south = 222
   real(wp), parameter :: near = 0.2_wp

   !> Digits of numbers begin at the character `first`, without the two characters `missing`; the last one of a number is less than
   !> `last`, and those before it are `others` more
   character(len=1), parameter :: first = '#', missing(2) = ['?', '\']
   integer, parameter :: last = 64, others = 26

   !> Mean radius of the Earth [km], for distances that are shown: only their ratios count
   real(wp), parameter :: radius = 6371.0_wp

   !> A mesh: a node and its neighbours in the east, in the south-east and in the south
   type :: mesh_type
      !> Their IDs
      integer :: ids(4) = 0
      !> Their longitudes and latitudes [deg]
      real(wp) :: longitude(4) = 0.0_wp, latitude(4) = 0.0_wp
      !> a_g [g], F_0 and T_C* [s] of each return period and node
      real(wp) :: values(3, size(grid_years), 4) = 0.0_wp
   contains
      !> How far the nodes are
      procedure :: distances
      !> a_g, F_0 and T_C* at a place for each return period of the table
      procedure :: tabulated
   end type mesh_type

   interface
      !> Number of runs of nodes whose IDs follow each other
      pure integer(c_int) function number_of_runs() bind(c, name='dondolo_hazard_runs')
         import :: c_int
      end function number_of_runs

      !> A run, from 0: ID of its first node, number of nodes, and the latitudes in place_unit that they lie between
      pure subroutine get_run(number, id, count, south, north) bind(c, name='dondolo_hazard_run')
         import :: c_int
         integer(c_int), intent(in), value :: number
         integer(c_int), intent(out) :: id, count, south, north
      end subroutine get_run

      !> The text of a run, of its places (0) or its values (1), and its length
      type(c_ptr) function get_text(number, is_of_values, length) bind(c, name='dondolo_hazard_text')
         import :: c_int, c_ptr
         integer(c_int), intent(in), value :: number, is_of_values
         integer(c_int), intent(out) :: length
      end function get_text
   end interface

contains

   !> Find the mesh that holds a place
   subroutine find_mesh(mesh, longitude, latitude)
      !> Its IDs are 0 where no mesh holds it
      type(mesh_type), intent(out) :: mesh
      !> [deg]
      real(wp), intent(in) :: longitude, latitude

      integer, allocatable :: ids(:), runs(:), places(:, :), values(:, :)
      integer :: id, count, south_end, north_end, run, corners(4), i, k

      allocate (ids(0), runs(0), places(2, 0))
      do run = 0, number_of_runs() - 1
         call get_run(run, id, count, south_end, north_end)
         if (latitude < place_unit*south_end - near .or. latitude > place_unit*north_end + near) cycle
         ids = [ids, [(id + i, i=0, count - 1)]]
         runs = [runs, [(run, i=1, count)]]
         places = reshape([places, read_run(run, 0, 2, count)], [2, size(ids)])
      end do
      corners = corners_of(ids, place_unit*places(1, :), place_unit*places(2, :), longitude, latitude)
      if (any(corners == 0)) return
      mesh%ids = ids(corners)
      mesh%longitude = place_unit*places(1, corners)
      mesh%latitude = place_unit*places(2, corners)
      do i = 1, size(corners)
         call get_run(runs(corners(i)), id, count, south_end, north_end)
         values = read_run(runs(corners(i)), 1, 3*size(grid_years), count)
         do k = 4, size(values, 1)
            values(k, :) = values(k, :) + values(k - 3, :)
         end do
         mesh%values(:, :, i) = reshape(values(:, mesh%ids(i) - id + 1), [3, size(grid_years)]) &
            & *spread(units, 2, size(grid_years))
      end do
   end subroutine find_mesh

   !> The nodes of the mesh that holds a place, of the least ID where two meet
   pure function corners_of(ids, longitudes, latitudes, longitude, latitude) result(corners)
      !> IDs of all nodes, which increase
      integer, intent(in) :: ids(:)
      !> Their places, and the place [deg]
      real(wp), intent(in) :: longitudes(:), latitudes(:), longitude, latitude
      !> Positions of the nodes in the lists; 0 where no mesh holds the place
      integer :: corners(4)

      !> Of a place that is on an edge but for rounding [deg2]
      real(wp), parameter :: rounding = 1.0e-13_wp
      integer, allocatable :: position(:)
      integer :: i, k

      corners = 0
      if (size(ids) == 0) return
      allocate (position(ids(1):ids(size(ids)) + south + 1), source=0)
      position(ids) = [(i, i=1, size(ids))]
      do i = 1, size(ids)
         if (max(abs(longitudes(i) - longitude), abs(latitudes(i) - latitude)) > near) cycle
         corners = position(ids(i) + [0, 1, south + 1, south])
         if (any(corners == 0)) cycle
         if (all([(is_inside(corners(k), corners(modulo(k, 4) + 1)), k=1, 4)])) return
      end do
      corners = 0

   contains

      !> Is the place on the inner side of an edge, which has the mesh to its right?
      pure logical function is_inside(from, to)
         !> Positions of its nodes
         integer, intent(in) :: from, to

         is_inside = (longitudes(to) - longitudes(from))*(latitude - latitudes(from)) &
            & - (latitudes(to) - latitudes(from))*(longitude - longitudes(from)) <= rounding
      end function is_inside

   end function corners_of

   !> Distances of the nodes from a place, by the haversine [km]
   pure function distances(self, longitude, latitude)
      class(mesh_type), intent(in) :: self
      !> [deg]
      real(wp), intent(in) :: longitude, latitude
      !> Of each node
      real(wp) :: distances(4)

      real(wp), parameter :: degree = pi/180.0_wp

      distances = 2.0_wp*radius*asin(sqrt(sin(0.5_wp*degree*(self%latitude - latitude))**2 &
         & + cos(degree*latitude)*cos(degree*self%latitude)*sin(0.5_wp*degree*(self%longitude - longitude))**2))
   end function distances

   !> a_g [g], F_0 and T_C* [s] at a place for each return period of the table
   pure function tabulated(self, longitude, latitude) result(values)
      class(mesh_type), intent(in) :: self
      !> [deg]
      real(wp), intent(in) :: longitude, latitude
      !> A column for each return period
      real(wp) :: values(3, size(grid_years))

      !> A place so near to a node has its values [km]
      real(wp), parameter :: same = 1.0e-30_wp
      real(wp) :: weights(4)
      integer :: i

      weights = 1.0_wp/max(self%distances(longitude, latitude), same)
      values = 0.0_wp
      do i = 1, size(weights)
         values = values + weights(i)/sum(weights)*self%values(:, :, i)
      end do
   end function tabulated

   !> Numbers of a run of nodes, a column for each node
   function read_run(run, is_of_values, many, count) result(numbers)
      !> The run, from 0; 0: longitudes and latitudes in place_unit, 1: values, of each return period less those of the one before;
      !> numbers of a node, and nodes
      integer, intent(in) :: run, is_of_values, many, count
      integer :: numbers(many, count)

      character(kind=c_char), pointer :: text(:)
      type(c_ptr) :: start
      integer(c_int) :: length

      start = get_text(run, is_of_values, length)
      call c_f_pointer(start, text, [length])
      call read_differences(text, numbers)
   end function read_run

   !> Read numbers, each of which is written as its difference from that of the column before
   pure subroutine read_differences(text, numbers)
      character(kind=c_char), intent(in) :: text(:)
      integer, intent(out) :: numbers(:, :)

      integer :: at, digit, high, i, k

      at = 0
      do k = 1, size(numbers, 2)
         do i = 1, size(numbers, 1)
            high = 0
            do
               at = at + 1
               digit = iachar(text(at)) - iachar(first) - count(iachar(text(at)) > iachar(missing))
               if (digit < last) exit
               high = others*high + digit - last + 1
            end do
            ! 0, 1, 2, 3, 4 ... are 0, 1, -1, 2, -2 ...
            digit = last*high + digit
            numbers(i, k) = merge((digit + 1)/2, -digit/2, modulo(digit, 2) == 1)
         end do
         if (k > 1) numbers(:, k) = numbers(:, k) + numbers(:, k - 1)
      end do
   end subroutine read_differences

end module dondolo_check_hazard_grid
