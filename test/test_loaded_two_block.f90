!> Walls of two blocks with hinges behind their faces and with the mass of an overburden, against independently computed
!> values (15 digits): terms and histories from the positions of point masses alone.
!>
!> The wall, unless said otherwise: H = 3 m, t = 0.25 m, hinge at 0.6, 1800 kg/m3; its load 0.02 m off the centreline.
program test_loaded_two_block
   use checks, only : check, check_close, check_error, check_ok, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_motion_normal_form, only : new_normal_form, normal_form_type
   use dondolo_motion_response, only : response_type
   use dondolo_motion_rest, only : new_rest, rest_type
   use dondolo_motion_rk45, only : simulate_rk45
   use dondolo_record, only : record_type
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   use lane_runs, only : run_alone
   use motion_inputs, only : accelerogram, tight
   implicit none

   real(wp), parameter :: exact = 1.0e-12_wp, g = 9.81_wp

   call test_terms()
   call test_energy()
   call test_restitution()
   call test_first_swing()
   call test_hinge_by_strength()
   call test_lanes()
   call test_wrong_input()
   call finish()

contains

   !> A wall
   function strip(hinge_depth, overburden, inertia) result(input)
      real(wp), intent(in) :: hinge_depth, overburden, inertia
      type(wall_input_type) :: input

      call input%set('mechanism', 'two_block')
      call input%set('height', 3.0_wp)
      call input%set('thickness', 0.25_wp)
      call input%set('hinge', 0.6_wp)
      if (hinge_depth > 0.0_wp) call input%set('hinge_depth', hinge_depth)
      if (.not. overburden > 0.0_wp) return
      call input%set('overburden', overburden)
      call input%set('overburden_inertia', inertia)
      call input%set('eccentricity', 0.02_wp)
   end function strip

   !> A wall that must be right
   function made(input) result(wall)
      type(wall_input_type), intent(in) :: input
      type(wall_type) :: wall
      type(error_type), allocatable :: error

      call new_wall(wall, input, error)
      call check_ok(error, 'new_wall')
   end function made

   !> J, C, L, G and Q
   subroutine test_terms()

      call suite('terms')
      call check_terms(strip(0.01_wp, 0.0_wp, 0.0_wp), 0.0_wp, [1566.7425_wp, -659.0491875_wp, 1215.0_wp, 3046.005_wp, 0.0_wp])
      call check_terms(strip(0.01_wp, 0.0_wp, 0.0_wp), 0.05_wp, [1513.97327843668_wp, -397.214688993667_wp, &
         & 1221.24083240916_wp, 1847.27565078901_wp, 0.0_wp])
      call check_terms(strip(0.0_wp, 2.0e4_wp, 0.0_wp), 0.05_wp, [1526.01854363383_wp, -454.332678784079_wp, &
         & 1221.91555119431_wp, 2110.8889176245_wp, -4833.5197348008_wp])
      call check_terms(strip(0.0_wp, 2.0e4_wp, 1.0_wp), 0.0_wp, [2030.14099133537_wp, -5042.51968388974_wp, 1215.0_wp, &
         & 12660.875_wp, 0.0_wp])
      call check_terms(strip(0.0_wp, 2.0e4_wp, 1.0_wp), 0.05_wp, [1645.09557231226_wp, -2670.5975604036_wp, &
         & 1221.91555119431_wp, 6944.40865242531_wp, 0.0_wp])
      call check_terms(strip(0.01_wp, 2.0e4_wp, 1.0_wp), 0.05_wp, [1601.20184917312_wp, -2293.44035220874_wp, &
         & 1221.24083240916_wp, 5984.21238930563_wp, 0.0_wp])
   end subroutine test_terms

   !> The terms of a wall at a rotation
   subroutine check_terms(input, q, expected)
      type(wall_input_type), intent(in) :: input
      real(wp), intent(in) :: q, expected(5)
      type(wall_type) :: wall
      real(wp) :: j, c, gravity, l, load

      wall = made(input)
      call wall%mechanism%terms(q, j, c, gravity, l, load)
      call check_close(j, expected(1), exact, 'J')
      call check_close(c, expected(2), exact, 'C')
      call check_close(l, expected(3), exact, 'L')
      call check_close(gravity, expected(4), exact, 'G')
      call check_close(load, expected(5), exact, 'Q')
   end subroutine check_terms

   !> C = J'/2 and G - Q = V', by differences of high order
   subroutine test_energy()
      real(wp), parameter :: weights(4) = [0.8_wp, -0.2_wp, 4.0_wp/105.0_wp, -1.0_wp/280.0_wp]
      real(wp), parameter :: depths(3) = [0.0_wp, 0.02_wp, 0.01_wp], inertias(3) = [1.0_wp, 0.0_wp, 0.4_wp]
      type(wall_type) :: wall
      real(wp) :: q, step, slope_j, slope_v, j(-4:4), v(-4:4), c, gravity, l, load, ignored
      integer :: i, k, m

      call suite('C = J''/2 and G - Q = V''')
      do m = 1, 3
         wall = made(strip(depths(m), 3.0e4_wp, inertias(m)))
         do i = 1, 9
            q = 0.1_wp*real(i, wp)*wall%mechanism%capacity
            step = 0.01_wp*wall%mechanism%capacity
            do k = -4, 4
               call wall%mechanism%terms(q + k*step, j(k), ignored, gravity, l, load)
               v(k) = wall%mechanism%potential(q + k*step)
            end do
            slope_j = sum(weights*(j(1:) - j(-1:-4:-1)))/step
            slope_v = sum(weights*(v(1:) - v(-1:-4:-1)))/step
            call wall%mechanism%terms(q, ignored, c, gravity, l, load)
            call check_close(c, 0.5_wp*slope_j, 1.0e-9_wp, 'C', 1.0e-9_wp*j(0))
            call check_close(gravity - load, slope_v, 1.0e-9_wp, 'G - Q', 1.0e-10_wp*v(0))
         end do
         call wall%mechanism%terms(wall%mechanism%capacity, ignored, c, gravity, l, load)
         call check_close(gravity - load, 0.0_wp, 0.0_wp, 'G - Q at the capacity', 1.0e-9_wp)
      end do
   end subroutine test_energy

   !> The speed ratios, and which one the default is
   subroutine test_restitution()

      call suite('restitution')
      call check_impulse(0.0_wp, 0.0_wp, 0.85356762513312_wp)
      call check_impulse(0.01_wp, 0.0_wp, 0.874649950454526_wp)
      call check_impulse(0.0_wp, 1.0e4_wp, 0.650353158269627_wp)
      call check_impulse(0.0_wp, 2.0e4_wp, 0.48729473876118_wp)
      call check_impulse(0.01_wp, 2.0e4_wp, 0.548258604271712_wp)
   end subroutine test_restitution

   !> The speed ratio with a load on the centreline, and without its mass
   subroutine check_impulse(hinge_depth, overburden, expected)
      real(wp), intent(in) :: hinge_depth, overburden, expected
      type(wall_input_type) :: input
      type(wall_type) :: wall, dead

      input = strip(hinge_depth, overburden, 1.0_wp)
      if (overburden > 0.0_wp) call input%set('eccentricity', 0.0_wp)
      call input%set('restitution', 'impulse')
      wall = made(input)
      call check_close(wall%mechanism%restitution, expected, exact, 'impulse')
      if (.not. overburden > 0.0_wp) return
      call input%set('restitution', 'default')
      wall = made(input)
      call check_close(wall%mechanism%restitution, expected, exact, 'the default where a mass is lifted')
      call input%set('overburden_inertia', 0.0_wp)
      wall = made(input)
      dead = made(strip(hinge_depth, 0.0_wp, 0.0_wp))
      call check_close(wall%mechanism%restitution, dead%mechanism%restitution, 0.0_wp, 'a dead force has no impulse')
   end subroutine check_impulse

   !> The largest swing under a short motion with a speed ratio of 0.45, by both engines
   subroutine test_first_swing()
      type(wall_input_type) :: half

      call suite('first swing')
      call check_swing('hinge', strip(0.01_wp, 0.0_wp, 0.0_wp), 1.4_wp, 0.0596904761904762_wp, 0.0289473604982146_wp, &
         & 0.337609922607132_wp)
      call check_swing('dead', strip(0.0_wp, 2.0e4_wp, 0.0_wp), 5.0_wp, 0.0694698216735254_wp, 0.0995671624557555_wp, &
         & 0.368679327077538_wp)
      call check_swing('lifted', strip(0.0_wp, 2.0e4_wp, 1.0_wp), 5.0_wp, 0.0694698216735254_wp, 0.0706163360342382_wp, &
         & 0.339422264298881_wp)
      half = strip(0.015_wp, 1.2e4_wp, 0.5_wp)
      call half%set('height', 3.2_wp)
      call half%set('thickness', 0.3_wp)
      call half%set('hinge', 0.55_wp)
      call half%set('eccentricity', -0.03_wp)
      call check_swing('half', half, 3.0_wp, 0.0683699962588852_wp, 0.0444972903879172_wp, 0.325292076785739_wp)
   end subroutine test_first_swing

   !> Start, peak and its time
   subroutine check_swing(name, input, scale, start, peak, time)
      character(len=*), intent(in) :: name
      type(wall_input_type), intent(in) :: input
      real(wp), intent(in) :: scale, start, peak, time
      type(wall_input_type) :: with_ratio
      type(wall_type) :: wall
      type(record_type) :: record
      type(response_type) :: response
      type(rest_type) :: rest
      real(wp) :: side, begin
      integer :: first
      logical :: found

      with_ratio = input
      call with_ratio%set('restitution_value', 0.45_wp)
      wall = made(with_ratio)
      record = accelerogram([0.0_wp, -3.0_wp, -3.0_wp, 1.0_wp, 2.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], 0.1_wp)
      call simulate_rk45(wall%mechanism, record, scale, tight(1.0_wp), response)
      call check_close(response%edp*wall%mechanism%capacity, peak, 0.0_wp, name//': peak, rk45', exact)
      ! Where the speed vanishes rounding moves the time by more.
      call check_close(response%time_of_peak, time, 0.0_wp, name//': time, rk45', 1.0e-9_wp)
      rest = new_rest(wall%mechanism)
      first = 1
      begin = 0.0_wp
      side = 1.0_wp
      call rest%next_start(record, scale, first, begin, side, found)
      call check_close(0.1_wp*real(first - 1, wp) + begin, start, 0.0_wp, name//': start', exact)
      call run_alone(wall%mechanism, record, scale, tight(1.0_wp), response)
      call check_close(response%edp*wall%mechanism%capacity, peak, 0.0_wp, name//': peak, lanes', exact)
      call check_close(response%time_of_peak, time, 0.0_wp, name//': time, lanes', 1.0e-9_wp)
   end subroutine check_swing

   !> u = N/(2 beta f), N of the wall and its load
   subroutine test_hinge_by_strength()
      type(wall_input_type) :: by_strength, given
      type(wall_type) :: one, other

      call suite('hinge by strength')
      by_strength = strip(0.0_wp, 2.0e4_wp, 1.0_wp)
      call by_strength%set('compressive_strength', 2.0e6_wp)
      call by_strength%set('stress_block', 0.8_wp)
      given = strip((1350.0_wp*g + 2.0e4_wp)/3.2e6_wp, 2.0e4_wp, 1.0_wp)
      one = made(by_strength)
      other = made(given)
      call check_close(one%mechanism%capacity, other%mechanism%capacity, exact, 'capacity')
      call check_close(one%mechanism%trigger_acceleration(), other%mechanism%trigger_acceleration(), exact, 'trigger')
      call check_close(one%mechanism%restitution, other%mechanism%restitution, exact, 'speed ratio')
      call check(one%mechanism%capacity < 0.138_wp, 'less than about the edge')
   end subroutine test_hinge_by_strength

   !> lanes takes what real walls carry
   subroutine test_lanes()
      real(wp), parameter :: loads(4) = [5.0e3_wp, 2.0e4_wp, 4.0e4_wp, 6.0e4_wp]
      type(wall_input_type) :: input
      type(wall_type) :: wall
      type(normal_form_type) :: form
      integer :: i, k

      call suite('lanes')
      do i = 1, size(loads)
         do k = 1, 2
            input = strip(0.01_wp, loads(i), 1.0_wp)
            if (k == 2) call input%set('hinge', 0.5_wp)
            wall = made(input)
            form = new_normal_form(wall%mechanism, wall%mechanism%capacity)
            call check(form%exists, 'lanes takes it')
         end do
      end do
   end subroutine test_lanes

   subroutine test_wrong_input()
      type(wall_input_type) :: input

      call suite('wrong input')
      input = strip(0.0_wp, 2.0e4_wp, 1.0_wp)
      call input%clear('overburden_inertia')
      call refuse(input, 'overburden_inertia: must be given with overburden: 0 (a dead force')
      call input%set('overburden_inertia', 1.5_wp)
      call refuse(input, 'overburden_inertia = 1.5: must lie between 0 and 1')
      call input%set('overburden_inertia', 1.0_wp)
      call input%set('restitution', 'sorrentino')
      call refuse(input, 'restitution = ''sorrentino'': does not include the mass of an overburden; with '// &
         & 'overburden_inertia = 1 use ''impulse''')
      input = strip(0.125_wp, 0.0_wp, 0.0_wp)
      call refuse(input, 'hinge_depth: puts the hinge at depth 0.125 m, must be less deep than half the thickness, 0.125 m')
      input = strip(0.02_wp, 2.0e4_wp, 1.0_wp)
      call input%set('eccentricity', 0.11_wp)
      call refuse(input, 'hinge_depth: puts the hinge at depth 0.02 m, must be less deep than the overburden, 0.015 m')
      input = strip(0.0_wp, 2.0e4_wp, 1.0_wp)
      call input%set('compressive_strength', 1.0e5_wp)
      call refuse(input, 'compressive_strength: puts the hinge at depth 0.1956 m, must be less deep than half the thickness')
      call input%set('hinge_depth', 0.01_wp)
      call refuse(input, 'hinge_depth = 0.01: give either hinge_depth or compressive_strength')
      ! The load inside of both hinges, above a high intermediate one, folds the wall by itself.
      input = strip(0.06_wp, 1.0e6_wp, 1.0_wp)
      call input%set('hinge', 0.9_wp)
      call input%set('eccentricity', -0.125_wp)
      call refuse(input, 'overburden: the wall is not stable at rest; its own weight resists with')
      input = strip(0.0_wp, 0.0_wp, 0.0_wp)
      call input%set('edge_radius', 0.01_wp)
      call refuse(input, 'edge_radius = 0.01: only for mechanism = ''one_sided'' or ''free_standing''')
   end subroutine test_wrong_input

   !> Input that must be refused with a sentence
   subroutine refuse(input, sentence)
      type(wall_input_type), intent(in) :: input
      character(len=*), intent(in) :: sentence
      type(wall_type) :: wall
      type(error_type), allocatable :: error

      call new_wall(wall, input, error)
      call check_error(error, sentence, 'wrong wall')
   end subroutine refuse

end program test_loaded_two_block
