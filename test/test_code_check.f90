!> Checks by NTC 2018 and Circolare 7/2019 against independently computed values (17 digits): a_g 0.2 g, F_0 2.5,
!> T_C* 0.35 s, soil B, FC 1.35; buildings of one mode, 0.3 s, 5 %, participation times shape 9/7.
program test_code_check
   use checks, only : check, check_close, check_ok, check_text, finish, suite
   use dondolo_base_error, only : error_type, problems_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_settings, only : group_settings_type, new_settings
   use dondolo_base_warning, only : warnings_type
   use dondolo_check_code_spectrum, only : elastic_spectrum_type, ntc_spectrum
   use dondolo_check_floor_spectrum, only : floor_spectrum_type, new_floor_spectrum
   use dondolo_check_input, only : check_input_type, check_properties, take_check
   use dondolo_check_kinematic, only : kinematic_type, new_kinematic
   use dondolo_check_history_check, only : check_histories
   use dondolo_check_notes, only : make_check_notes
   use dondolo_check_ntc_check, only : check_ntc
   use dondolo_check_sheet, only : sheet_type
   use dondolo_check_strip_check, only : check_by_ntc
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   implicit none

   real(wp), parameter :: exact = 1.0e-12_wp
   real(wp), parameter :: modes(3, 1) = reshape([0.3_wp, 0.05_wp, 9.0_wp/7.0_wp], [3, 1])

   call test_spectra()
   call test_walls()
   call test_states()
   call test_histories()
   call test_strips()
   call test_strip_in_a_building()
   call test_near_the_ground()
   call test_tie_curves()
   call test_building_states()
   call test_verdicts()
   call test_wrong_input()
   call finish()

contains

   !> Confidence factors, what the verdict rests on, and hinges that slide: worked values, L'Aquila, soil B
   subroutine test_verdicts()
      real(wp), parameter :: factors(3) = [1.0_wp, 1.2_wp, 1.35_wp], starts(3) = [0.981_wp, 0.8175_wp, 0.726666666666667_wp], &
         & zetas(3) = [0.686302384224736_wp, 0.626505495182443_wp, 0.617409401206005_wp]
      type(wall_input_type) :: input
      type(sheet_type) :: sheet
      type(check_input_type) :: site
      integer :: i

      call suite('verdicts')
      site = the_site([0.104_wp, 0.261_wp, 0.334_wp])
      site%f0 = [2.332_wp, 2.364_wp, 2.4_wp]
      site%tc_star = [0.281_wp, 0.347_wp, 0.364_wp]
      input = a_wall(6.0_wp, 0.6_wp)
      call input%set('density', 1900.0_wp)
      do i = 1, size(factors)
         site%knowledge_factor = factors(i)
         call make_sheet(sheet, input, site)
         call check_close(sheet%value('mechanism', '', 'a_0'), starts(i), exact, 'a_0')
         call check_close(sheet%value('nonlinear', 'SLV', 'ratio'), zetas(i), exact, 'zeta_E')
         call check_close(sheet%value('mechanism', '', 'friction_needed'), 0.1_wp, exact, 'friction')
         call check(sheet%is_required('nonlinear', 'SLV') .and. .not. sheet%is_required('linear', 'SLD'), 'class II')
         call check(.not. sheet%is_satisfied(), 'less than 1')
      end do
      site%use_class = 'IV'
      site%ultimate_state = 'SLC'
      input = a_wall(0.9_wp, 0.9_wp)
      call make_sheet(sheet, input, site)
      call check(sheet%is_required('linear', 'SLD') .and. .not. sheet%is_required('nonlinear', 'SLV'), 'class IV')
      call check_text(sheet%ultimate(), 'SLC', 'ultimate state')
      call check(sheet%is_satisfied(), 'a stocky wall')
      site%friction = 0.4_wp
      call make_sheet(sheet, input, site)
      call check_close(sheet%value('mechanism', '', 'sliding_alpha'), 0.4_wp, exact, 'slides')
      call check(sheet%slides() .and. .not. sheet%is_satisfied(), 'slides before it turns')
      site%friction = 1.0_wp
      call make_sheet(sheet, input, site)
      call check(.not. sheet%slides() .and. sheet%is_satisfied(), 'turns before it slides')
   end subroutine test_verdicts

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
      ! Of a mode that hardly moves the level the ground's own ordinate is the least, below its period too
      floor = new_floor_spectrum(ground, modes(1, :), modes(2, :), 0.01_wp*modes(3, :))
      call check_close(floor%peak_acceleration(), 0.24_wp, exact, 'a_Z')
      do i = 0, 100
         call check_close(floor%acceleration(0.02_wp*i, 0.08_wp), ground%acceleration(0.02_wp*i, 0.08_wp), exact, 'S_eZ')
      end do
      call check_close(floor%modal_acceleration(0.1_wp, 0.08_wp), 0.013941798041402019_wp, exact, 'S_eZ(0.1 s) of the mode')
      ! Where each governs at some periods, the greater of the two
      floor = new_floor_spectrum(ground, modes(1, :), modes(2, :), 0.28_wp*modes(3, :))
      do i = 0, 100
         call check_close(floor%acceleration(0.02_wp*i, 0.08_wp), max(ground%acceleration(0.02_wp*i, 0.08_wp), &
            & floor%modal_acceleration(0.02_wp*i, 0.08_wp)), exact, 'S_eZ, the greater')
      end do
      call check(floor%acceleration(0.3_wp, 0.08_wp) > 1.1_wp*ground%acceleration(0.3_wp, 0.08_wp), 'resonance governs')
      call check(floor%modal_acceleration(0.1_wp, 0.08_wp) < ground%acceleration(0.1_wp, 0.08_wp), 'the ground governs')
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
      ! At the trigger a record may exceed it by a rounding: what follows is rest
      sheet%rows = sheet%rows(:0)
      call check_histories(sheet, kinematic, 2, 0.24_wp, 1, [1.0e-49_wp, 2.0e-20_wp])
      call check_close(sheet%value('dynamic', 'SLV', 'mean_displacement'), 0.0_wp, exact, 'mean at rest')
      call check_histories(sheet, kinematic, 3, 0.24_wp, 3, [0.0_wp, 0.0_wp, 1.0_wp])
      call check_close(sheet%value('dynamic', 'SLC', 'beyond'), 1.0_wp, exact, 'histories beyond d_0')
      call check_close(sheet%value('dynamic', 'SLC', 'verified'), 0.0_wp, exact, 'one history is enough')
      sheet%rows = sheet%rows(:0)
      call check_histories(sheet, kinematic, 2, 0.24_wp, 1, [0.45_wp])
      call check_close(sheet%value('dynamic', 'SLV', 'verified'), 0.0_wp, exact, 'a mean beyond d_SLV')
   end subroutine test_histories

   !> Strips of 3 m by 0.25 m that bend at 0.6 of their height: bare, with 20 kN/m on top, and with hinges behind the faces, by
   !> closed forms and by virtual work of points in 40 digits
   subroutine test_strips()
      integer, parameter :: numbers = 16
      real(wp), parameter :: expected(numbers, 3) = reshape([ &
         & 0.277777777777778_wp, 0.9_wp, 0.185185185185185_wp, 2.01851851851852_wp, 0.125_wp, 0.05_wp, 1.20098233627676_wp, &
         & 1.07690116455661_wp, 0.0668823943414544_wp, 0.857338820301783_wp, 1.50191219874522_wp, 0.863683666465574_wp, &
         & 0.857338820301783_wp, 1.71467764060357_wp, 1350.0_wp, 1.0_wp, &
         & 1.06222968919764_wp, 0.628649400421723_wp, 1.05860929769251_wp, 7.71886907483615_wp, 0.100564623541844_wp, &
         & 0.0402258494167378_wp, 4.58712074821909_wp, 0.494244312062208_wp, 0.0306957073390998_wp, 3.27848669505443_wp, &
         & 0.689621194152562_wp, 3.27848669505443_wp, 3.27848669505443_wp, 6.55697339010886_wp, 1350.0_wp, 1.0_wp, &
         & 0.76733701648188_wp, 0.734405700081904_wp, 0.713622385343972_wp, 5.57598231976833_wp, 0.0727853505663464_wp, &
         & 0.0291141402265386_wp, 3.32153427009232_wp, 0.494130623952092_wp, 0.0306886465862072_wp, 2.36832412494407_wp, &
         & 0.689262772004421_wp, 2.36832412494407_wp, 2.36832412494407_wp, 4.73664824988815_wp, 1350.0_wp, 1.0_wp], &
         & [numbers, 3])
      ! alpha at a quarter, a half and three quarters of the rotation at which it vanishes
      real(wp), parameter :: curve(3, 3) = reshape([0.207429140801281_wp, 0.137861297493842_wp, 0.0688043371598809_wp, &
         & 0.792616580162765_wp, 0.52628461406741_wp, 0.262356745644458_wp, &
         & 0.57333818737247_wp, 0.381002501363287_wp, 0.189996599791452_wp], [3, 3])
      real(wp), parameter :: ends(3) = [0.138006023657519_wp, 0.111110501683207_wp, 0.0805454148688882_wp]
      type(wall_input_type) :: input
      type(wall_type) :: wall
      type(kinematic_type) :: kinematic
      type(sheet_type) :: sheet
      type(error_type), allocatable :: error
      real(wp), parameter :: n = 1.0e3_wp/13243.5_wp
      real(wp) :: found(numbers), d, j, c, g, l, load
      integer :: i, k

      call suite('strips')
      do i = 1, 3
         input = a_strip()
         if (i > 1) then
            call input%set('overburden', 20.0e3_wp)
            call input%set('overburden_inertia', 0.0_wp)
            call input%set('eccentricity', merge(0.02_wp, -0.065_wp, i == 2))
         end if
         if (i == 3) call input%set('hinge_depth', 0.01_wp)
         call make_sheet(sheet, input, the_site([0.2_wp]))
         found = [sheet%value('mechanism', '', 'alpha_0'), sheet%value('mechanism', '', 'weakest_hinge'), &
            & sheet%value('mechanism', '', 'weakest_alpha_0'), sheet%value('mechanism', '', 'a_0'), &
            & sheet%value('mechanism', '', 'd_0'), sheet%value('nonlinear', 'SLV', 'displacement'), &
            & sheet%value('nonlinear', 'SLV', 'acceleration'), sheet%value('nonlinear', 'SLV', 'period'), &
            & sheet%value('nonlinear', 'SLV', 'demand'), sheet%value('nonlinear', 'SLV', 'ratio'), &
            & sheet%value('nonlinear', 'SLC', 'period'), sheet%value('nonlinear', 'SLC', 'ratio'), &
            & sheet%value('linear', 'SLD', 'ratio'), sheet%value('linear', 'SLV', 'ratio'), &
            & sheet%value('mechanism', '', 'mass'), sheet%value('mechanism', '', 'mass_ratio')]
         do k = 1, numbers
            call check_close(found(k), expected(k, i), exact, 'strip')
         end do
         call new_wall(wall, input, error)
         call new_kinematic(kinematic, wall, error)
         call check_close(kinematic%end_rotation(), ends(i), exact, 'end')
         do k = 1, 3
            d = kinematic%displacement(0.25_wp*real(k, wp)*ends(i))
            call check_close(kinematic%capacity(d, 1.0_wp), 9.81_wp*curve(k, i), exact, 'capacity')
            call check_close(kinematic%rotation(d), 0.25_wp*real(k, wp)*ends(i), exact, 'rotation')
         end do
         ! What starts the check starts the histories
         call wall%mechanism%terms(0.0_wp, j, c, g, l, load)
         call check_close(kinematic%multiplier, (g - load)/(9.81_wp*l), exact, 'trigger')
      end do
      ! A load beyond the inner hinges makes the highest hinge of the range the weakest: w 0.075 m, n = 1000/13243.5
      input = a_strip()
      call input%set('overburden', 1.0e3_wp)
      call input%set('overburden_inertia', 0.0_wp)
      call input%set('eccentricity', -0.1_wp)
      call input%set('hinge_depth', 0.05_wp)
      call make_sheet(sheet, input, the_site([0.2_wp]))
      call check_close(sheet%value('mechanism', '', 'weakest_hinge'), 0.9_wp, exact, 'hinge at the top')
      call check_close(sheet%value('mechanism', '', 'weakest_alpha_0'), 4.0_wp*0.075_wp*(1.0_wp + n)/2.7_wp &
         & - 2.0_wp*n*0.025_wp/0.3_wp, exact, 'its multiplier')
   end subroutine test_strips

   !> The demand of a strip is that of the level between its floors
   subroutine test_strip_in_a_building()
      type(wall_input_type) :: input
      type(sheet_type) :: strip, between

      call suite('strip in a building')
      input = a_strip()
      call put_on_building(input, 3.0_wp, 6.0_wp)
      call make_sheet(strip, input, the_site([0.2_wp]))
      input = a_strip()
      call put_on_building(input, 4.5_wp, 4.5_wp)
      call make_sheet(between, input, the_site([0.2_wp]))
      call check_close(strip%value('mechanism', '', 'level'), 4.5_wp, exact, 'level')
      call check_close(strip%value('site', '', 'floor_pga'), between%value('site', '', 'floor_pga'), exact, 'a_Z')
      call check_close(strip%value('mechanism', '', 'diaphragm_period'), -1.0_wp, exact, 'a rigid floor')
      call check_close(strip%value('nonlinear', 'SLV', 'demand'), between%value('nonlinear', 'SLV', 'demand'), exact, 'demand')
   end subroutine test_strip_in_a_building

   !> Near the ground a wall is verified by no more than on it: values of an independent program, three digits
   subroutine test_near_the_ground()
      type(wall_input_type) :: input
      type(sheet_type) :: sheet, ground
      type(check_input_type) :: site
      type(warnings_type) :: notes
      type(lines_type) :: sentences
      real(wp), parameter :: levels(4) = [0.05_wp, 0.5_wp, 1.0_wp, 9.6_wp]
      real(wp) :: last
      integer :: i

      call suite('walls near the ground')
      site = the_site([0.2_wp])
      site%knowledge_factor = 1.2_wp
      call input%set('mechanism', 'two_block')
      call input%set('height', 3.2_wp)
      call input%set('thickness', 0.3_wp)
      call input%set('hinge', 0.6_wp)
      call put_on_building(input, 0.0_wp, 3.2_wp)
      call input%set('building_height', 9.6_wp)
      call make_sheet(sheet, input, site)
      call check_close(sheet%value('linear', 'SLD', 'ratio'), 1.085_wp, 5.0e-4_wp, 'SLD')
      call check_close(sheet%value('nonlinear', 'SLV', 'zeta_e'), 1.085_wp, 5.0e-4_wp, 'zeta_E')
      call check_close(sheet%value('nonlinear', 'SLV', 'displacement')/sheet%value('nonlinear', 'SLV', 'demand'), 0.920_wp, &
         & 5.0e-4_wp, 'd_C/d_D')
      call check_close(sheet%value('site', 'SLV', 'floor_pga'), sheet%value('site', 'SLV', 'pga'), exact, 'a_Z is a_g S')
      call check(sheet%value('site', 'SLV', 'modal_pga') < sheet%value('site', 'SLV', 'pga'), 'the modes give less')
      call make_check_notes(sheet, notes)
      call notes%put_sentences(sentences)
      call check(any([(index(sentences%line(i)%text, 'by analogy with [C7.2.11]') > 0, i=1, sentences%count)]), 'a note')
      input = a_wall(3.0_wp, 0.25_wp)
      call make_sheet(ground, input, site)
      call check_close(ground%value('linear', 'SLD', 'ratio'), 1.0_wp/(12.0_wp*1.2_wp*0.24_wp), exact, 'on the ground')
      last = huge(last)
      do i = 1, size(levels)
         call put_on_building(input, levels(i), min(levels(i) + 3.0_wp, 9.6_wp))
         call input%set('building_height', 9.6_wp)
         call make_sheet(sheet, input, site)
         call check(sheet%value('linear', 'SLD', 'ratio') <= ground%value('linear', 'SLD', 'ratio')*(1.0_wp + exact), &
            & 'SLD, not more')
         call check(sheet%value('nonlinear', 'SLV', 'ratio') <= ground%value('nonlinear', 'SLV', 'ratio')*(1.0_wp + exact), &
            & 'SLV, not more')
         call check(sheet%value('linear', 'SLD', 'ratio') <= last, 'less the higher')
         last = sheet%value('linear', 'SLD', 'ratio')
      end do
      call check(sheet%value('site', 'SLV', 'modal_pga') < 0.0_wp, 'on the roof the modes govern')
      call check(last < 0.5_wp*ground%value('linear', 'SLD', 'ratio'), 'and ask for more')
   end subroutine test_near_the_ground

   !> Check a wall at L'Aquila, which has the hazards of three limit states
   subroutine check_at_aquila(sheet, input, period)
      type(sheet_type), intent(out) :: sheet
      type(wall_input_type), intent(in) :: input
      !> Period of the building for the limit states [s]; absent: the worst is looked for
      real(wp), intent(in), optional :: period

      type(check_input_type) :: site
      type(wall_type) :: wall
      type(error_type), allocatable :: error

      site%ag = [0.104_wp, 0.261_wp, 0.334_wp]
      site%f0 = [2.332_wp, 2.364_wp, 2.4_wp]
      site%tc_star = [0.281_wp, 0.347_wp, 0.364_wp]
      site%soil = 'B'
      if (present(period)) site%building_period = spread(period, 1, 3)
      call new_wall(wall, input, error)
      call check_ok(error, 'wall')
      call check_by_ntc(sheet, wall, site, error)
      call check_ok(error, 'check')
   end subroutine check_at_aquila

   !> The better of the curves with a tie that breaks early and without it: an independent program, 40 digits
   subroutine test_tie_curves()
      type(wall_input_type) :: input
      type(sheet_type) :: sheet, bare

      call suite('curves without ties')
      input = a_wall(11.7_wp, 0.88_wp)
      call input%set('density', 1900.0_wp)
      call check_at_aquila(bare, input)
      call input%set('tie_height', [10.5_wp])
      call input%set('tie_depth', [0.0_wp])
      call input%set('tie_area', [4.5e-5_wp])
      call input%set('tie_strength', [2.0e8_wp])
      call input%set('tie_strain', [0.01_wp])
      call input%set('tie_length', [8.0_wp])
      call check_at_aquila(sheet, input)
      call check_close(sheet%value('mechanism', '', 'alpha_0'), 0.159388999889687_wp, exact, 'alpha_0')
      call check_close(sheet%value('nonlinear', 'SLV', 'tied_zeta'), 0.574141644034379_wp, exact, 'with the tie')
      call check_close(sheet%value('nonlinear', 'SLV', 'ratio'), 0.907486943671255_wp, exact, 'taken')
      call check_close(sheet%value('nonlinear', 'SLC', 'ratio'), 1.04222491973489_wp, exact, 'taken, SLC')
      call check(.not. abs(sheet%value('untied', 'SLV', 'demand') - bare%value('nonlinear', 'SLV', 'demand')) > 0.0_wp, &
         & 'its steps are those of the bare wall')
      call check(.not. abs(sheet%value('nonlinear', 'SLV', 'zeta_e') - bare%value('nonlinear', 'SLV', 'zeta_e')) > 0.0_wp, &
         & 'and so is zeta_E')
   end subroutine test_tie_curves

   !> Period and damping of the building at SLV: an independent program, 40 digits
   subroutine test_building_states()
      type(wall_input_type) :: input
      type(sheet_type) :: sheet

      call suite('states of the building')
      input = a_wall(1.2_wp, 0.4_wp)
      call input%set('density', 1800.0_wp)
      call input%set('period', [0.28_wp])
      call input%set('damping', [0.05_wp])
      call input%set('participation', [9.0_wp/7.0_wp])
      call check_at_aquila(sheet, input)
      call check_close(sheet%value('nonlinear', 'SLV', 'ratio'), 0.376549007263092_wp, exact, 'the worst')
      call check_close(sheet%value('nonlinear', 'SLV', 'building_period'), 1.7_wp*0.28_wp, exact, 'its period')
      call check_close(sheet%value('nonlinear', 'SLV', 'building_zeta', '1.5 T_1'), 0.417326147765334_wp, exact, '1.5 T')
      call check_close(sheet%value('nonlinear', 'SLV', 'building_zeta', '2 T_1'), 0.387431962974075_wp, exact, '2 T')
      call check_at_aquila(sheet, input, 0.28_wp)
      call check_close(sheet%value('nonlinear', 'SLV', 'ratio'), 0.684310316958439_wp, exact, 'as given')
      call check(sheet%value('nonlinear', 'SLV', 'building_zeta') < 0.0_wp, 'nothing is searched')
   end subroutine test_building_states

   !> Put a wall on a building of three storeys, 9 m high
   subroutine put_on_building(input, level, top)
      type(wall_input_type), intent(inout) :: input
      !> Levels of its base and of its top [m]
      real(wp), intent(in) :: level, top

      call input%set('period', [0.3_wp])
      call input%set('damping', [0.05_wp])
      call input%set('storeys', 3.0_wp)
      call input%set('level', level)
      call input%set('level_top', top)
      call input%set('building_height', 9.0_wp)
   end subroutine put_on_building

   !> What cannot be checked
   subroutine test_wrong_input()
      call suite('wrong input')
      call refuse([2.0_wp], 'B', 1.35_wp, 'ag = 2: must lie between 0.001 and 1 g: is it in m/s2?')
      call refuse([0.1_wp, 0.2_wp], 'B', 1.35_wp, 'ag: has 2 values, must have one, or three: SLD, SLV, SLC')
      call refuse([0.3_wp, 0.2_wp, 0.4_wp], 'B', 1.35_wp, 'ag: must not decrease from SLD to SLC')
      call refuse([0.2_wp], 'F', 1.35_wp, 'soil = ''f'': must be one of ''A'', ''B'', ''C'', ''D'', ''E''')
      call refuse([0.2_wp], 'B', 1.5_wp, 'knowledge_factor = 1.5: must lie between 1 and 1.35')
   end subroutine test_wrong_input

   !> A site that is wrong in one way
   subroutine refuse(ag, soil, factor, message)
      real(wp), intent(in) :: ag(:), factor
      character(len=*), intent(in) :: soil, message

      type(group_settings_type) :: settings
      type(check_input_type) :: input
      type(problems_type) :: problems
      type(error_type), allocatable :: error

      call new_settings(settings, check_properties)
      call settings%set('ag', ag)
      call settings%set('f0', [2.5_wp])
      call settings%set('tc_star', [0.35_wp])
      call settings%set('soil', soil)
      call settings%set('knowledge_factor', factor)
      call take_check(input, settings, problems)
      call check(problems%count == 1, 'one thing is wrong')
      call problems%raise(error)
      if (allocated(error)) call check_text(error%message, message, 'message')
   end subroutine refuse

   !> The site
   function the_site(ag) result(input)
      real(wp), intent(in) :: ag(:)
      type(check_input_type) :: input

      input%ag = ag
      input%f0 = [2.5_wp]
      input%tc_star = [0.35_wp]
      input%soil = 'B'
      ! Expected values are those of the elastic building
      input%building_period = [0.3_wp, 0.3_wp, 0.3_wp]
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

   !> A strip between two floors
   function a_strip() result(input)
      type(wall_input_type) :: input

      input = a_wall(3.0_wp, 0.25_wp)
      call input%set('mechanism', 'two_block')
      call input%set('hinge', 0.6_wp)
   end function a_strip

end program test_code_check
