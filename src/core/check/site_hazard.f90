!> The hazard of a place in Italy by NTC 2018, 3.2: from its coordinates, the nominal life and the class of use a_g, F_0 and T_C* of
!> each limit state.
module dondolo_check_site_hazard
   use dondolo_base_kinds, only : pi, wp
   use dondolo_check_hazard_grid, only : find_mesh, grid_years, mesh_type
   implicit none
   private

   public :: site_hazard_type, new_site_hazard, to_ed50, return_period
   public :: use_classes, use_coefficients, state_exceedance

   !> NTC 2018, table 2.4.II: classes of use and their coefficients C_U
   character(len=*), parameter :: use_classes(4) = [character(len=3) :: 'I', 'II', 'III', 'IV']
   real(wp), parameter :: use_coefficients(4) = [0.7_wp, 1.0_wp, 1.5_wp, 2.0_wp]

   !> Table 3.2.I: probabilities of exceedance P_VR of SLD, SLV and SLC
   real(wp), parameter :: state_exceedance(3) = [0.63_wp, 0.10_wp, 0.05_wp]

   !> The hazard of a place
   type :: site_hazard_type
      !> Place [deg], and nominal life V_N [years]
      real(wp) :: latitude = 0.0_wp, longitude = 0.0_wp, nominal_life = 0.0_wp
      !> Coefficient C_U of the class of use
      real(wp) :: use_coefficient = 1.0_wp
      !> The place in ED50 [deg]
      real(wp) :: latitude_ed50 = 0.0_wp, longitude_ed50 = 0.0_wp
      !> The mesh of the grid that holds it
      type(mesh_type) :: mesh
      !> a_g [g], F_0 and T_C* [s] there for each return period of the grid
      real(wp) :: tabulated(3, size(grid_years)) = 0.0_wp
   contains
      !> Does a mesh hold the place?
      procedure :: is_covered
      !> Reference period V_R
      procedure :: reference_life
      !> Return period of a limit state
      procedure :: years
      !> The two return periods of the grid that it lies between
      procedure :: bracket
      !> a_g, F_0 and T_C* of a limit state
      procedure :: values
   end type site_hazard_type

contains

   !> Hazard of a place
   subroutine new_site_hazard(hazard, latitude, longitude, nominal_life, use_class)
      !> `is_covered`: else it has no values
      type(site_hazard_type), intent(out) :: hazard
      !> In WGS84 [deg]
      real(wp), intent(in) :: latitude, longitude
      !> V_N [years]
      real(wp), intent(in) :: nominal_life
      !> One of use_classes
      character(len=*), intent(in) :: use_class

      hazard%latitude = latitude
      hazard%longitude = longitude
      hazard%nominal_life = nominal_life
      hazard%use_coefficient = use_coefficients(findloc(use_classes, use_class, dim=1))
      call to_ed50(latitude, longitude, hazard%latitude_ed50, hazard%longitude_ed50)
      call find_mesh(hazard%mesh, hazard%longitude_ed50, hazard%latitude_ed50)
      if (hazard%is_covered()) hazard%tabulated = hazard%mesh%tabulated(hazard%longitude_ed50, hazard%latitude_ed50)
   end subroutine new_site_hazard

   !> Convert a place from WGS84 to ED50, the datum of the grid: geocentric coordinates at the height 0, moved by the mean shift for
   !> Europe, 87, 98 and 121 m
   pure subroutine to_ed50(latitude, longitude, latitude_ed50, longitude_ed50)
      !> In WGS84 [deg]
      real(wp), intent(in) :: latitude, longitude
      !> In ED50 [deg]
      real(wp), intent(out) :: latitude_ed50, longitude_ed50

      real(wp), parameter :: degree = pi/180.0_wp, shift(3) = [87.0_wp, 98.0_wp, 121.0_wp]
      !> Semi-major axes [m] and flattenings of the ellipsoids WGS84 and International 1924
      real(wp), parameter :: axes(2) = [6378137.0_wp, 6378388.0_wp], flattenings(2) = 1.0_wp/[298.257223563_wp, 297.0_wp], &
         & squares(2) = flattenings*(2.0_wp - flattenings)
      !> Each step divides the error by more than 100
      integer, parameter :: steps = 12
      real(wp) :: point(3), normal, distance, angle
      integer :: i

      normal = axes(1)/sqrt(1.0_wp - squares(1)*sin(degree*latitude)**2)
      point = normal*[cos(degree*latitude)*cos(degree*longitude), cos(degree*latitude)*sin(degree*longitude), &
         & (1.0_wp - squares(1))*sin(degree*latitude)] + shift
      distance = hypot(point(1), point(2))
      angle = atan2(point(3), distance*(1.0_wp - squares(2)))
      do i = 1, steps
         normal = axes(2)/sqrt(1.0_wp - squares(2)*sin(angle)**2)
         angle = atan2(point(3) + squares(2)*normal*sin(angle), distance)
      end do
      latitude_ed50 = angle/degree
      longitude_ed50 = atan2(point(2), point(1))/degree
   end subroutine to_ed50

   !> Return period T_R = -V_R/ln(1 - P_VR) [years]: NTC 2018, 3.2.1
   elemental real(wp) function return_period(reference_life, exceedance) result(years)
      !> V_R [years]
      real(wp), intent(in) :: reference_life
      !> P_VR, less than 1
      real(wp), intent(in) :: exceedance

      years = -reference_life/log(1.0_wp - exceedance)
   end function return_period

   !> Does a mesh hold the place?
   pure logical function is_covered(self)
      class(site_hazard_type), intent(in) :: self

      is_covered = all(self%mesh%ids > 0)
   end function is_covered

   !> Reference period V_R = C_U V_N [years]: NTC 2018, 2.4.3
   pure real(wp) function reference_life(self)
      class(site_hazard_type), intent(in) :: self

      reference_life = self%use_coefficient*self%nominal_life
   end function reference_life

   !> Return period of a limit state, held in the range of the grid [years]
   pure real(wp) function years(self, state)
      class(site_hazard_type), intent(in) :: self
      !> 1 to 3: SLD, SLV, SLC
      integer, intent(in) :: state

      years = min(max(return_period(self%reference_life(), state_exceedance(state)), grid_years(1)), &
         & grid_years(size(grid_years)))
   end function years

   !> The first of the two return periods of the grid between which that of a limit state lies
   pure integer function bracket(self, state)
      class(site_hazard_type), intent(in) :: self
      !> 1 to 3: SLD, SLV, SLC
      integer, intent(in) :: state

      bracket = max(1, count(grid_years < self%years(state)))
   end function bracket

   !> a_g [g], F_0 and T_C* [s] of a limit state
   pure function values(self, state)
      class(site_hazard_type), intent(in) :: self
      !> 1 to 3: SLD, SLV, SLC
      integer, intent(in) :: state
      real(wp) :: values(3)

      integer :: i

      i = self%bracket(state)
      associate (one => self%tabulated(:, i), two => self%tabulated(:, i + 1), years => grid_years)
         values = one*(two/one)**(log(self%years(state)/years(i))/log(years(i + 1)/years(i)))
      end associate
   end function values

end module dondolo_check_site_hazard
