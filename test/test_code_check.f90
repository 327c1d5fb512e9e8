!> Checks by NTC 2018 and Circolare 7/2019 against independently computed values (17 digits): a_g 0.2 g, F_0 2.5,
!> T_C* 0.35 s, soil B, FC 1.35; buildings of one mode, 0.3 s, 5 %, participation times shape 9/7.
program test_code_check
   use checks, only : check, check_close, check_error, check_ok, check_text, finish, suite
   use dondolo_base_error, only : error_type, problems_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_settings, only : group_settings_type, new_settings
   use dondolo_check_code_spectrum, only : elastic_spectrum_type, ntc_spectrum
   use dondolo_check_floor_spectrum, only : floor_spectrum_type, new_floor_spectrum
   use dondolo_check_input, only : check_input_type, check_properties, take_check
   use dondolo_check_kinematic, only : kinematic_type, new_kinematic
   use dondolo_check_ntc_check, only : check_histories, check_ntc
   use dondolo_check_sheet, only : sheet_type
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   implicit none

   real(wp), parameter :: exact = 1.0e-12_wp
   real(wp), parameter :: modes(3, 1) = reshape([0.3_wp, 0.05_wp, 9.0_wp/7.0_wp], [3, 1])

   call test_spectra()
   call test_walls()
   call test_states()
   call test_histories()
   call test_wrong_input()
   call finish()

contains

   !> Spectra of the ground and of a floor
   subroutine test_spectra()
      type(elastic_spectrum_type) :: ground
      type(floor_spectrum_type) :: floor
      real(wp), parameter :: periods(5) = [0.0_wp, 0.1_wp, 0.3_wp, 0.6_wp, 1.0_wp], &
         & ordinates(5) = [0.77527611934361154_wp, 1.3941798041402019_wp, 3.3449714361931694_wp, &
         & 0.92781245815397021_wp, 0.38212923131786948_wp]
      integer :: i

      call suite('spectra')
      ground = ntc_spectrum(0.2_wp, 2.5_wp, 0.35_wp, 'B', 'T1')
      call check_close(ground%soil_factor, 1.2_wp, exact, 'S')
      call check_close(ground%corners(2), 0.47494915641893754_wp, exact, 'T_C')
      call check_close(ground%acceleration(0.0_wp, 0.08_wp), 0.24_wp, exact, 'S_e(0)')
      ground = ntc_spectrum(0.1_wp, 2.5_wp, 0.3_wp, 'D', 'T4')
      call check_close(ground%soil_factor, 1.8_wp*1.4_wp, exact, 'S of soil D at T4')
      ground = ntc_spectrum(0.2_wp, 2.5_wp, 0.35_wp, 'B', 'T1')
      floor = new_floor_spectrum(ground, modes(1, :), modes(2, :), modes(3, :))
      call check_close(floor%peak_acceleration(), 0.77527611934361154_wp, exact, 'a_Z')
      do i = 1, size(periods)
         call check_close(floor%acceleration(periods(i), 0.08_wp), ordinates(i), exact, 'S_eZ')
      end do
      ! Of a mode that hardly moves the level the ground's own ordinate is the least, but not below its period
      floor = new_floor_spectrum(ground, modes(1, :), modes(2, :), 0.01_wp*modes(3, :))
      call check_close(floor%acceleration(0.6_wp, 0.08_wp), ground%acceleration(0.6_wp, 0.08_wp), exact, 'S_eZ(0.6 s)')
      call check_close(floor%acceleration(0.1_wp, 0.08_wp), 0.013941798041402019_wp, exact, 'S_eZ(0.1 s)')
   end subroutine test_spectra

   !> The worked walls
   subroutine test_walls()
      type(wall_input_type) :: input

      call suite('wall W1')
      input = a_wall(3.0_wp, 0.25_wp)
      call check_wall(input, [0.083333333333333333_wp, 1.0_wp, 0.12456821978060995_wp, 0.049827287912243981_wp, &
         & 1.9553332040580721_wp, 0.12143859689909073_wp, 0.082061698973099817_wp, &
         & 0.10288065843621399_wp, 0.10772468928710098_wp])
      call suite('parapet')
      input = a_wall(1.5_wp, 0.25_wp)
      call check_wall(input, [0.16666666666666667_wp, 1.0_wp, 0.12329924047901797_wp, 0.049319696191607187_wp, &
         & 1.3772735015427938_wp, 0.085537422075448582_wp, 0.11531723775379757_wp, &
         & 0.20576131687242798_wp, 0.13339878866077423_wp])
      call suite('parapet on a building')
      call input%set('period', modes(1, :))
      call input%set('damping', modes(2, :))
      call input%set('participation', modes(3, :))
      call check_wall(input, [0.16666666666666667_wp, 1.0_wp, 0.12329924047901797_wp, 0.049319696191607187_wp, &
         & 1.3772735015427938_wp, 0.11062849122044122_wp, 0.08916273854504889_wp, &
         & 0.06369693947389048_wp, 0.10849563932308813_wp])
      call suite('facade F')
      input = a_wall(9.0_wp, 0.5_wp)
      call check_wall(input, [0.055555555555555556_wp, 1.0_wp, 0.2496150883013531_wp, 0.099846035320541242_wp, &
         & 3.3892057349752381_wp, 0.14905522595992381_wp, 0.1339718680476009_wp, &
         & 0.068587105624142661_wp, 0.21586330667640429_wp])
      call suite('facade with floors')
      call input%set('load', [8.0e3_wp, 8.0e3_wp, 5.0e3_wp])
      call input%set('load_depth', [0.4_wp])
      call input%set('load_height', [3.0_wp, 6.0_wp, 9.0_wp])
      call input%set('load_inertia', 'vertical')
      call check_wall(input, [0.05955914192608326_wp, 0.94431087467059074_wp, 0.29742085762810447_wp, 0.11896834305124179_wp, &
         & 3.4722200569912289_wp, 0.14905522595992381_wp, 0.15962988521211403_wp, &
         & 0.077866099839913614_wp, 0.25720500406860488_wp])
      call suite('facade with floors and thrust')
      call input%set('thrust', [1.5e3_wp])
      call input%set('thrust_height', [9.0_wp])
      call input%set('load_inertia', 'both')
      call check_wall(input, [0.031112607188123256_wp, 0.94431087467059074_wp, 0.15532203863974595_wp, 0.062128815455898379_wp, &
         & 3.47179191626491_wp, 0.14905522595992381_wp, 0.08336348498455577_wp, &
         & 0.040675827408612501_wp, 0.13432012098570745_wp])
   end subroutine test_walls

   !> Hold the check of a wall against: alpha_0, e*, d_0, d_SLV, T_SLV, demand, a_g,SLV, that of the linear check, a_g,SLC
   subroutine check_wall(input, expected)
      type(wall_input_type), intent(in) :: input
      real(wp), intent(in) :: expected(9)

      type(sheet_type) :: sheet

      call make_sheet(sheet, input, the_site([0.2_wp]))
      call check_close(sheet%value('mechanism', '', 'alpha_0'), expected(1), exact, 'alpha_0')
      call check_close(sheet%value('mechanism', '', 'mass_ratio'), expected(2), exact, 'e*')
      call check_close(sheet%value('mechanism', '', 'd_0'), expected(3), exact, 'd_0')
      call check_close(sheet%value('nonlinear', 'SLV', 'displacement'), expected(4), exact, 'd_SLV')
      call check_close(sheet%value('nonlinear', 'SLV', 'period'), expected(5), exact, 'T_SLV')
      call check_close(sheet%value('nonlinear', 'SLV', 'demand'), expected(6), exact, 'demand')
      call check_close(sheet%value('nonlinear', 'SLV', 'capacity_ag'), expected(7), exact, 'a_g,SLV')
      call check_close(sheet%value('linear', 'SLV', 'capacity_ag'), expected(8), exact, 'linear a_g,SLV')
      call check_close(sheet%value('nonlinear', 'SLC', 'capacity_ag'), expected(9), exact, 'a_g,SLC')
      call check_close(sheet%value('linear', 'SLD', 'ratio'), expected(8)/0.4_wp, exact, 'ratio of SLD')
      call check_close(sheet%value('nonlinear', 'SLC', 'displacement'), 0.6_wp*expected(3), exact, 'd_SLC')
   end subroutine check_wall

   !> What a limit state has of its own: hazard, unseating, a capacity not below the start of the mechanism
   subroutine test_states()
      type(wall_input_type) :: input
      type(sheet_type) :: sheet, alone
      real(wp) :: slc

      call suite('limit states')
      input = a_wall(3.0_wp, 0.25_wp)
      call make_sheet(sheet, input, the_site([0.1_wp, 0.2_wp, 0.3_wp]))
      call check_close(sheet%value('linear', 'SLD', 'ratio'), 0.0833333333333333_wp/1.35_wp/0.12_wp, exact, 'SLD at its a_g')
      call check_close(sheet%value('site', 'SLC', 'pga'), 0.33_wp, exact, 'a_g S of SLC')
      call make_sheet(alone, input, the_site([0.3_wp]))
      call check_close(sheet%value('nonlinear', 'SLC', 'demand'), alone%value('nonlinear', 'SLC', 'demand'), exact, &
         & 'demand of SLC')
      slc = sheet%value('nonlinear', 'SLC', 'displacement')
      call input%set('load', [1.0_wp])
      call input%set('load_depth', [0.125_wp])
      call input%set('load_height', [3.0_wp])
      call input%set('load_inertia', 'both')
      call input%set('load_seat', [0.1_wp])
      call make_sheet(sheet, input, the_site([0.2_wp]))
      ! The load at the top moves twice as far as the centroid
      call check(slc > 0.05_wp, 'd_SLC without a seat')
      call check_close(sheet%value('nonlinear', 'SLC', 'displacement'), 0.05_wp, 0.01_wp, 'd_SLC where the load falls')
      slc = sheet%value('nonlinear', 'SLC', 'displacement')
      call input%set('load_seat', [0.06_wp])
      call make_sheet(sheet, input, the_site([0.2_wp]))
      call check_close(sheet%value('nonlinear', 'SLC', 'displacement'), 0.6_wp*slc, 0.01_wp, 'd_SLC with a short seat')
      call check_close(sheet%value('nonlinear', 'SLV', 'displacement'), sheet%value('nonlinear', 'SLC', 'displacement'), &
         & exact, 'd_SLV is not beyond it')
      input = a_wall(0.3_wp, 0.25_wp)
      call make_sheet(sheet, input, the_site([0.2_wp]))
      call check_close(sheet%value('nonlinear', 'SLV', 'capacity_ag'), max(sheet%value('linear', 'SLD', 'capacity_ag'), &
         & 0.2_wp*sheet%value('nonlinear', 'SLV', 'displacement')/sheet%value('nonlinear', 'SLV', 'demand')), exact, &
         & 'a_g,SLV not below the start')
   end subroutine test_states

   !> The criterion for time histories
   subroutine test_histories()
      type(sheet_type) :: sheet
      type(kinematic_type) :: kinematic
      type(wall_type) :: wall
      type(error_type), allocatable :: error
      real(wp) :: alpha

      call suite('histories')
      call new_wall(wall, a_wall(3.0_wp, 0.25_wp), error)
      call new_kinematic(kinematic, wall, error)
      alpha = atan2(0.25_wp, 3.0_wp)
      call check_histories(sheet, kinematic, 2, 0.24_wp, 3, [0.0_wp, 0.5_wp, 0.6_wp])
      call check_close(sheet%value('dynamic', 'SLV', 'mean_displacement'), 0.5_wp*(sin(0.5_wp*alpha) + sin(0.6_wp*alpha)), &
         & exact, 'mean')
      call check_close(sheet%value('dynamic', 'SLV', 'verified'), 1.0_wp, exact, 'verified')
      call check_histories(sheet, kinematic, 3, 0.24_wp, 3, [0.0_wp, 0.0_wp, 1.0_wp])
      call check_close(sheet%value('dynamic', 'SLC', 'beyond'), 1.0_wp, exact, 'histories beyond d_0')
      call check_close(sheet%value('dynamic', 'SLC', 'verified'), 0.0_wp, exact, 'one history is enough')
      sheet%rows = sheet%rows(:0)
      call check_histories(sheet, kinematic, 2, 0.24_wp, 1, [0.45_wp])
      call check_close(sheet%value('dynamic', 'SLV', 'verified'), 0.0_wp, exact, 'a mean beyond d_SLV')
   end subroutine test_histories

   !> What cannot be checked
   subroutine test_wrong_input()
      type(wall_input_type) :: input
      type(wall_type) :: wall
      type(kinematic_type) :: kinematic
      type(error_type), allocatable :: error

      call suite('wrong input')
      call refuse([2.0_wp], 'B', 1.35_wp, 'ag = 2: must lie between 0.001 and 1 g: is it in m/s2?')
      call refuse([0.1_wp, 0.2_wp], 'B', 1.35_wp, 'ag: has 2 values, must have one, or three: SLD, SLV, SLC')
      call refuse([0.3_wp, 0.2_wp, 0.4_wp], 'B', 1.35_wp, 'ag: must not decrease from SLD to SLC')
      call refuse([0.2_wp], 'F', 1.35_wp, 'soil = ''f'': must be one of ''A'', ''B'', ''C'', ''D'', ''E''')
      call refuse([0.2_wp], 'B', 1.5_wp, 'knowledge_factor = 1.5: must lie between 1 and 1.35')
      input = a_wall(3.0_wp, 0.25_wp)
      call input%set('mechanism', 'two_block')
      call new_wall(wall, input, error)
      call new_kinematic(kinematic, wall, error)
      call check_error(error, 'the kinematic check is for one block', 'two blocks')
   end subroutine test_wrong_input

   !> A site that is wrong in one way
   subroutine refuse(ag, soil, factor, message)
      real(wp), intent(in) :: ag(:), factor
      character(len=*), intent(in) :: soil, message

      type(group_settings_type) :: settings
      type(check_input_type) :: input
      type(problems_type) :: problems

      call new_settings(settings, check_properties)
      call settings%set('ag', ag)
      call settings%set('f0', [2.5_wp])
      call settings%set('tc_star', [0.35_wp])
      call settings%set('soil', soil)
      call settings%set('knowledge_factor', factor)
      call take_check(input, settings, problems)
      call check(problems%count == 1, 'one thing is wrong')
      if (problems%count > 0) call check_text(problems%text, message, 'message')
   end subroutine refuse

   !> The site
   function the_site(ag) result(input)
      real(wp), intent(in) :: ag(:)
      type(check_input_type) :: input

      input%ag = ag
      input%f0 = [2.5_wp]
      input%tc_star = [0.35_wp]
      input%soil = 'B'
   end function the_site

   !> The check of a wall
   subroutine make_sheet(sheet, input, site)
      type(sheet_type), intent(out) :: sheet
      type(wall_input_type), intent(in) :: input
      type(check_input_type), intent(in) :: site

      type(wall_type) :: wall
      type(kinematic_type) :: kinematic
      type(error_type), allocatable :: error

      call new_wall(wall, input, error)
      call check_ok(error, 'wall')
      call new_kinematic(kinematic, wall, error)
      call check_ok(error, 'kinematic chain')
      call check_ntc(sheet, kinematic, site)
   end subroutine make_sheet

   !> A bare wall
   function a_wall(height, thickness) result(input)
      real(wp), intent(in) :: height, thickness
      type(wall_input_type) :: input

      call input%set('mechanism', 'one_sided')
      call input%set('height', height)
      call input%set('thickness', thickness)
   end function a_wall

end program test_code_check
