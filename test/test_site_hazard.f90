!> a_g, F_0 and T_C* from coordinates, against an independent program (40 digits): with the digits that the grid is published with,
!> where the file is there, and with the three decimals of the decree.
program test_site_hazard
   use, intrinsic :: iso_fortran_env, only : iostat_end
   use checks, only : check, check_close, check_text, finish, skip, suite
   use dondolo_base_error, only : error_type, problems_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_settings, only : group_settings_type, new_settings
   use dondolo_base_text, only : to_text
   use dondolo_check_hazard_grid, only : corners_of, find_mesh, grid_years, mesh_type
   use dondolo_check_input, only : check_input_type, check_properties, put_check, take_check
   use dondolo_check_site_hazard, only : new_site_hazard, site_hazard_type, to_ed50
   implicit none

   !> The published file, beside the repository
   character(len=*), parameter :: published = '../shared/data/ntc_grid/ntc08_annex_b.txt.xz', plain = 'build/annex_b.txt'

   !> Largest difference of what has three decimals: a_g [g], F_0, T_C* [s]
   real(wp), parameter :: last_digit(3) = [5.0e-5_wp, 5.0e-4_wp, 5.0e-4_wp]
   real(wp), parameter :: printed = 1.0e-12_wp, exact = 1.0e-13_wp

   !> Latitude and longitude (WGS84) and longitude and latitude (ED50) of places, and a_g [g], F_0 and T_C* [s] of SLD, SLV and SLC
   !> for V_R 50 years
   character(len=*), parameter :: names(6) = [character(len=8) :: 'L''Aquila', 'Ferrara', 'Roma', 'Milano', 'Napoli', 'Catania']
   real(wp), parameter :: places(4, 6) = reshape([ &
      & 42.3498_wp, 13.3999_wp, 13.400812289_wp, 42.350772799_wp, 44.8378_wp, 11.6199_wp, 11.620892378_wp, 44.838728281_wp, &
      & 41.9028_wp, 12.4964_wp, 12.497326184_wp, 41.903790048_wp, 45.4642_wp, 9.1900_wp, 9.191059303_wp, 45.465134366_wp, &
      & 40.8518_wp, 14.2681_wp, 14.268972040_wp, 40.852798997_wp, 37.5027_wp, 15.0873_wp, 15.088113994_wp, 37.503758688_wp], &
      & [4, 6])
   real(wp), parameter :: hazards(3, 3, 6) = reshape([ &
      & 0.104165033378_wp, 2.331997325253_wp, 0.281098613827_wp, 0.260658083233_wp, 2.363514892764_wp, 0.346501218909_wp, &
      & 0.334052810628_wp, 2.399833135188_wp, 0.363834518785_wp, &
      & 0.045751306590_wp, 2.506442930396_wp, 0.275325700604_wp, 0.131547694328_wp, 2.595564212544_wp, 0.274033321541_wp, &
      & 0.176670607810_wp, 2.554765564184_wp, 0.279919762610_wp, &
      & 0.054851644979_wp, 2.503951032909_wp, 0.269939299050_wp, 0.120207284381_wp, 2.620191608673_wp, 0.297137070176_wp, &
      & 0.150397949019_wp, 2.614849821258_wp, 0.306556032992_wp, &
      & 0.024181256115_wp, 2.552547728215_wp, 0.190491974651_wp, 0.049773229719_wp, 2.654919386971_wp, 0.279603779098_wp, &
      & 0.059804304076_wp, 2.693999471464_wp, 0.299374629341_wp, &
      & 0.059501818375_wp, 2.334597196119_wp, 0.312190444700_wp, 0.167564738882_wp, 2.373150652870_wp, 0.338186235852_wp, &
      & 0.213175681886_wp, 2.440753223128_wp, 0.341144930917_wp, &
      & 0.076536771466_wp, 2.546585905914_wp, 0.263588557261_wp, 0.206386418932_wp, 2.456826215669_wp, 0.358112455224_wp, &
      & 0.283860055457_wp, 2.421718139949_wp, 0.442793161181_wp], [3, 3, 6])

   call test_datum()
   call test_places()
   call test_mesh()
   call test_years()
   call test_published()
   call test_input()
   call finish()

contains

   !> From WGS84 to ED50
   subroutine test_datum()
      real(wp) :: latitude, longitude
      integer :: i

      call suite('datum')
      do i = 1, size(names)
         call to_ed50(places(1, i), places(2, i), latitude, longitude)
         call check_close(longitude, places(3, i), 0.0_wp, trim(names(i))//', longitude', atol=5.1e-10_wp)
         call check_close(latitude, places(4, i), 0.0_wp, trim(names(i))//', latitude', atol=5.1e-10_wp)
      end do
   end subroutine test_datum

   !> Places with what is shipped
   subroutine test_places()
      type(site_hazard_type) :: hazard
      integer :: i, state

      call suite('places')
      do i = 1, size(names)
         call new_site_hazard(hazard, places(1, i), places(2, i), 50.0_wp, 'II')
         do state = 1, 3
            call check(all(abs(hazard%values(state) - hazards(:, state, i)) <= last_digit), trim(names(i))//', state '// &
               & to_text(state))
         end do
         ! C_U 2, 25 years: the same reference period
         call new_site_hazard(hazard, places(1, i), places(2, i), 25.0_wp, 'IV')
         call check(all(abs(hazard%values(2) - hazards(:, 2, i)) <= last_digit), trim(names(i))//', class IV')
      end do
   end subroutine test_places

   !> On a node, beside it, on edges, and outside
   subroutine test_mesh()
      type(mesh_type) :: mesh, other
      real(wp) :: middle(2)
      integer :: i

      call suite('mesh')
      call find_mesh(mesh, 13.4_wp, 42.35_wp)
      call check(all(mesh%ids(2:) - mesh%ids(1) == [1, 223, 222]), 'neighbours')
      do i = 1, 4
         ! A node belongs to up to four meshes, whose values there are the same
         call find_mesh(other, mesh%longitude(i), mesh%latitude(i))
         call check(any(other%ids == mesh%ids(i)), 'a mesh has its node')
         associate (found => other%tabulated(mesh%longitude(i), mesh%latitude(i)))
            call check(all(abs(found - mesh%values(:, :, i)) <= exact*mesh%values(:, :, i)), 'values on a node')
         end associate
         associate (found => mesh%tabulated(mesh%longitude(i) + 1.0e-9_wp, mesh%latitude(i) - 1.0e-9_wp))
            call check(all(abs(found - mesh%values(:, :, i)) <= 1.0e-6_wp*mesh%values(:, :, i)), 'values beside a node')
         end associate
         middle = 0.5_wp*[mesh%longitude(i) + mesh%longitude(modulo(i, 4) + 1), mesh%latitude(i) &
            & + mesh%latitude(modulo(i, 4) + 1)]
         call find_mesh(other, middle(1), middle(2))
         call check(any(other%ids == mesh%ids(i)) .and. any(other%ids == mesh%ids(modulo(i, 4) + 1)) &
            & .and. other%ids(1) <= mesh%ids(1), 'on an edge the mesh of the least ID')
      end do
      ! Of two equally distant nodes the mean
      associate (values => mesh%tabulated(sum(mesh%longitude)/4, sum(mesh%latitude)/4))
         call check(all(values >= minval(mesh%values, dim=3) .and. values <= maxval(mesh%values, dim=3)), 'between the nodes')
      end associate
      call find_mesh(mesh, 9.1_wp, 39.2_wp)
      call check(all(mesh%ids == 0), 'Sardinia')
      call find_mesh(mesh, 0.0_wp, 0.0_wp)
      call check(all(mesh%ids == 0), 'the ocean')
   end subroutine test_mesh

   !> Return periods: those of the grid, and held at its ends
   subroutine test_years()
      type(site_hazard_type) :: hazard
      integer :: i

      call suite('return periods')
      do i = 1, size(grid_years)
         ! Life for which SLV has the return period
         call new_site_hazard(hazard, 42.35_wp, 13.4_wp, -grid_years(i)*log(0.9_wp), 'II')
         call check_close(hazard%years(2), grid_years(i), exact, 'T_R')
         call check(all(abs(hazard%values(2) - hazard%tabulated(:, i)) <= 1.0e-12_wp*hazard%tabulated(:, i)), 'T_R '// &
            & to_text(grid_years(i)))
      end do
      call new_site_hazard(hazard, 42.35_wp, 13.4_wp, 1.0_wp, 'I')
      call check(all([(abs(hazard%years(i) - 30.0_wp) < exact, i=1, 3)]), '30 years')
      call check(all(abs(hazard%values(3) - hazard%tabulated(:, 1)) <= exact*hazard%tabulated(:, 1)), 'values of 30 years')
      call new_site_hazard(hazard, 42.35_wp, 13.4_wp, 1000.0_wp, 'IV')
      call check_close(hazard%years(3), 2475.0_wp, exact, '2475 years')
      call check(all(abs(hazard%values(3) - hazard%tabulated(:, 9)) <= exact*hazard%tabulated(:, 9)), 'values of 2475 years')
   end subroutine test_years

   !> Places, and every number of the grid, with the published digits
   subroutine test_published()
      integer, allocatable :: ids(:), numbers(:, :)
      real(wp), allocatable :: longitudes(:), latitudes(:)
      type(mesh_type) :: mesh, shipped
      type(site_hazard_type) :: hazard
      integer, parameter :: most = 20000
      real(wp) :: values(3, size(grid_years)), worst(3)
      integer :: corners(4), count, i, k, state, stat, unit
      logical :: is_there

      call suite('published digits')
      inquire (file=published, exist=is_there)
      stat = 1
      if (is_there) call execute_command_line('xz -dc '//published//' >'//plain, exitstat=stat)
      if (stat /= 0) then
         call skip('no published grid: '//published//' is not there, or xz is not installed')
         return
      end if
      allocate (numbers(30, most))
      count = 0
      open (newunit=unit, file=plain, action='read', status='old')
      do
         read (unit, *, iostat=stat) numbers(:, count + 1)
         if (stat == iostat_end) exit
         count = count + 1
      end do
      close (unit, status='delete')
      call check(count == 10751, 'nodes')
      ids = numbers(1, :count)
      longitudes = 1.0e-6_wp*numbers(2, :count)
      latitudes = 1.0e-6_wp*numbers(3, :count)
      do i = 1, size(names)
         call new_site_hazard(hazard, places(1, i), places(2, i), 50.0_wp, 'II')
         corners = corners_of(ids, longitudes, latitudes, hazard%longitude_ed50, hazard%latitude_ed50)
         mesh%ids = ids(corners)
         mesh%longitude = longitudes(corners)
         mesh%latitude = latitudes(corners)
         do k = 1, 4
            mesh%values(:, :, k) = published_values(numbers(:, corners(k)))
         end do
         hazard%mesh = mesh
         hazard%tabulated = mesh%tabulated(hazard%longitude_ed50, hazard%latitude_ed50)
         do state = 1, 3
            call check(all(abs(hazard%values(state) - hazards(:, state, i)) <= 0.51_wp*printed), trim(names(i))//', state '// &
               & to_text(state))
         end do
      end do
      ! Nodes all over the grid as it is shipped
      worst = 0.0_wp
      do i = 1, count, 20
         call find_mesh(shipped, longitudes(i), latitudes(i))
         do k = 1, 4
            if (shipped%ids(k) == 0) cycle
            corners(k) = findloc(ids, shipped%ids(k), dim=1)
            call check(abs(shipped%longitude(k) - longitudes(corners(k))) + abs(shipped%latitude(k) - latitudes(corners(k))) &
               & <= 0.0_wp, 'place of a node')
            values = abs(shipped%values(:, :, k) - published_values(numbers(:, corners(k))))
            worst = max(worst, maxval(values, dim=2))
         end do
      end do
      call check(all(worst <= last_digit*(1.0_wp + 1.0e-9_wp)), 'three decimals')
   end subroutine test_published

   !> a_g [g], F_0 and T_C* [s] of a node for each return period
   pure function published_values(line) result(values)
      !> Its line of the published file
      integer, intent(in) :: line(:)
      real(wp) :: values(3, size(grid_years))

      values = reshape(real(line(4:), wp), [3, size(grid_years)])*spread([1.0e-6_wp, 1.0e-4_wp, 1.0e-6_wp], 2, size(grid_years))
   end function published_values

   !> What a user may say, and how it comes back
   subroutine test_input()
      type(group_settings_type) :: settings, again
      type(check_input_type) :: input, other
      type(problems_type) :: problems

      call suite('input')
      call give(settings, 42.3498_wp, 13.3999_wp)
      call take_check(input, settings, problems)
      call check(problems%count == 0, 'a place is enough')
      call check(size(input%ag) == 3 .and. input%has_states(), 'three limit states')
      call check_close(input%reference_life, 50.0_wp, 0.0_wp, 'V_R')
      call check_close(input%return_period(2), 474.56107905149526_wp, exact, 'T_R of SLV')
      call check_close(input%return_period_of(input%ag(3)), input%return_period(3), exact, 'T_R of a_g')
      call new_settings(again, check_properties)
      call put_check(input, again)
      call check(.not. again%has('ag') .and. .not. again%has('exceedance'), 'the place comes back, not what follows from it')
      call take_check(other, again, problems)
      call check(all(abs(other%ag - input%ag) <= 0.0_wp), 'and gives the same')
      call refuse(13.3999_wp, 42.3498_wp, '', 'latitude = 13.3999: must lie between 35 and 48 deg: is it the longitude?')
      call refuse(39.22_wp, 9.12_wp, '', 'latitude = 39.22, longitude = 9.12: outside the grid of hazard (D.M. 14-1-2008, '// &
         & 'annex B, table 1), which has the mainland and Sicily without Sardinia')
      call refuse(35.5_wp, 12.6_wp, '', 'latitude = 35.5, longitude = 12.6: outside')
      call refuse(46.05_wp, 14.51_wp, '', 'latitude = 46.05, longitude = 14.51: outside')
      call refuse(42.3498_wp, 13.3999_wp, 'ag', 'ag: not with latitude and longitude')
      call refuse(42.3498_wp, 13.3999_wp, 'exceedance', 'exceedance: not with latitude and longitude')
      call refuse(42.3498_wp, 13.3999_wp, '-longitude', 'longitude: must be given')
      call refuse(42.3498_wp, 13.3999_wp, '-nominal_life', 'nominal_life: must be given')
      call refuse(42.3498_wp, 13.3999_wp, 'V', 'use_class = ''v'': must be one of')
   end subroutine test_input

   !> A place with a nominal life of 50 years
   subroutine give(settings, latitude, longitude)
      type(group_settings_type), intent(out) :: settings
      real(wp), intent(in) :: latitude, longitude

      call new_settings(settings, check_properties)
      call settings%set('latitude', latitude)
      call settings%set('longitude', longitude)
      call settings%set('nominal_life', 50.0_wp)
   end subroutine give

   !> A place that is refused
   subroutine refuse(latitude, longitude, change, message)
      real(wp), intent(in) :: latitude, longitude
      !> A variable that is given besides, with a - before it one that is not, or a class of use
      character(len=*), intent(in) :: change
      !> How the message begins
      character(len=*), intent(in) :: message

      type(group_settings_type) :: settings
      type(check_input_type) :: input
      type(problems_type) :: problems
      type(error_type), allocatable :: error

      call give(settings, latitude, longitude)
      if (change == 'V') then
         call settings%set('use_class', 'v')
      else if (index(change, '-') == 1) then
         call settings%clear(change(2:))
      else if (change == 'exceedance') then
         call settings%set('exceedance', [0.63_wp, 0.1_wp, 0.05_wp])
      else if (len(change) > 0) then
         call settings%set(change, [0.2_wp])
      end if
      call take_check(input, settings, problems)
      call problems%raise(error)
      if (.not. allocated(error)) then
         call check(.false., 'not refused: '//message)
      else
         call check_text(error%message(:min(len(message), len(error%message))), message, 'message')
      end if
   end subroutine refuse

end program test_site_hazard
