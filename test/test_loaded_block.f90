!> Walls with loads, masses, thrusts, springs and hinges at some depth, against independently computed values (15 digits).
!>
!> The wall, unless said otherwise: H = 3 m, t = 0.25 m, 1800 kg/m3; its load: 10 kN/m at depth 0.175 m on the top.
program test_loaded_block
   use checks, only : check, check_close, check_error, check_ok, finish, suite
   use dondolo_base_error, only : error_type, problems_type
   use dondolo_base_kinds, only : wp
   use dondolo_motion_initial_state, only : initial_state_type
   use dondolo_motion_normal_form, only : new_normal_form, normal_form_type
   use dondolo_motion_response, only : response_type
   use dondolo_motion_rest, only : new_rest, rest_type
   use dondolo_motion_rk45, only : simulate_rk45
   use dondolo_record, only : record_type
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   use dondolo_wall_body, only : read_wall_body, wall_body_type
   use lane_runs, only : run_alone
   use motion_inputs, only : accelerogram, stillness, tight
   implicit none

   real(wp), parameter :: exact = 1.0e-12_wp, g = 9.81_wp

   call test_bodies()
   call test_terms()
   call test_statics()
   call test_energy()
   call test_first_swing()
   call test_restitution()
   call test_limits()
   call test_unseating()
   call test_given_body()
   call test_wrong_input()
   call finish()

contains

   !> The bare wall
   function plain_wall() result(input)
      type(wall_input_type) :: input

      call input%set('mechanism', 'one_sided')
      call input%set('height', 3.0_wp)
      call input%set('thickness', 0.25_wp)
   end function plain_wall

   !> A case by its name
   function a_case(name) result(input)
      character(len=*), intent(in) :: name
      type(wall_input_type) :: input

      input = plain_wall()
      select case (name)
      case ('dead', 'both', 'vertical')
         call set_load(input, trim(merge('none', name(:4), name == 'dead')))
         if (name == 'vertical') call input%set('load_inertia', 'vertical')
      case ('thrust')
         call set_load(input, 'none')
         call set_thrust(input, 1.0e3_wp)
      case ('pushed')
         call set_load(input, 'none')
         call input%set('inertia_mass', [600.0_wp])
         call input%set('inertia_depth', [0.175_wp])
         call input%set('inertia_height', [3.0_wp])
      case ('spring')
         call input%set('spring', [5.0e4_wp])
         call input%set('spring_depth', [0.0_wp])
         call input%set('spring_height', [3.0_wp])
      case ('distributed_spring')
         call input%set('distributed_spring', [2.0e4_wp])
         call input%set('distributed_spring_depth', [0.25_wp])
         call input%set('distributed_spring_bottom', [0.0_wp])
         call input%set('distributed_spring_top', [3.0_wp])
      case ('hinge')
         call input%set('hinge_depth', 0.02_wp)
      case ('edge')
         call input%set('edge_radius', 0.02_wp)
      case ('edge thrust')
         call input%set('edge_radius', 0.02_wp)
         call set_load(input, 'none')
         call set_thrust(input, 0.5e3_wp)
      case ('small thrust')
         call set_thrust(input, 0.2e3_wp)
      case ('stepped', 'floors', 'roof')
         call input%clear('height')
         call input%clear('thickness')
         call input%set('section_height', [4.0_wp, 3.5_wp, 3.0_wp])
         call input%set('section_thickness', [0.6_wp, 0.45_wp, 0.3_wp])
         if (name == 'stepped') return
         call input%set('load', [12.0e3_wp, 12.0e3_wp, 6.0e3_wp])
         call input%set('load_depth', [0.5_wp, 0.35_wp, 0.2_wp])
         call input%set('load_height', [4.0_wp, 7.5_wp, 10.5_wp])
         call input%set('load_inertia', 'none')
         if (name == 'floors') return
         call input%set('thrust', [2.0e3_wp])
         call input%set('thrust_height', [10.5_wp])
      case ('gable')
         call input%clear('height')
         call input%clear('thickness')
         call input%set('section_height', [3.0_wp])
         call input%set('section_thickness', [0.3_wp])
         call input%set('section_top_width', [0.0_wp])
      end select
   end function a_case

   !> The load
   subroutine set_load(input, inertia)
      type(wall_input_type), intent(inout) :: input
      character(len=*), intent(in) :: inertia

      call input%set('load', [1.0e4_wp])
      call input%set('load_depth', [0.175_wp])
      call input%set('load_height', [3.0_wp])
      call input%set('load_inertia', inertia)
   end subroutine set_load

   !> A thrust at the inner face of the top, where it is if nothing is said
   subroutine set_thrust(input, thrust)
      type(wall_input_type), intent(inout) :: input
      real(wp), intent(in) :: thrust

      call input%set('thrust', [thrust])
      call input%set('thrust_height', [3.0_wp])
   end subroutine set_thrust

   !> A wall that must be right
   function made(input) result(wall)
      type(wall_input_type), intent(in) :: input
      type(wall_type) :: wall
      type(error_type), allocatable :: error

      call new_wall(wall, input, error)
      call check_ok(error, 'new_wall')
   end function made

   !> Mass, centroid and inertia of sections
   subroutine test_bodies()

      call suite('bodies')
      call check_body('stepped', [8775.0_wp, 0.248076923076923_wp, 4.50384615384615_wp, 74321.9502403846_wp])
      call check_body('gable', [810.0_wp, 0.15_wp, 1.0_wp, 411.075_wp])
   end subroutine test_bodies

   !> The body of a case
   subroutine check_body(name, expected)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: expected(4)
      type(wall_type) :: wall
      type(wall_body_type) :: read
      type(problems_type) :: problems

      wall = made(a_case(name))
      call read_wall_body(wall%input, g, .false., problems, read)
      associate (body => read%body)
         call check_close(body%mass, expected(1), exact, name//': mass')
         call check_close(body%depth, expected(2), exact, name//': depth of the centroid')
         call check_close(body%height, expected(3), exact, name//': its height')
         call check_close(body%inertia, expected(4), exact, name//': inertia about it')
      end associate
   end subroutine check_body

   !> J, C, L, G and Q
   subroutine test_terms()

      call suite('terms')
      call check_terms('dead', 0.0_wp, [4078.125_wp, 0.0_wp, 2025.0_wp, 1655.4375_wp, -1750.0_wp])
      call check_terms('dead', 0.03_wp, [4078.125_wp, 0.0_wp, 2029.15055900087_wp, 1058.82449859671_wp, -849.347552985858_wp])
      call check_terms('thrust', 0.03_wp, [4078.125_wp, 0.0_wp, 2029.15055900087_wp, 1058.82449859671_wp, 2156.80142331173_wp])
      call check_terms('both', 0.03_wp, [13283.6550713558_wp, 0.0_wp, 5091.22937019598_wp, 1908.17205158257_wp, 0.0_wp])
      call check_terms('vertical', 0.0_wp, [4109.34314475025_wp, -535.168195718654_wp, 2025.0_wp, 3405.4375_wp, 0.0_wp])
      call check_terms('vertical', 0.03_wp, [4085.47863165915_wp, -260.076914533841_wp, 2029.15055900087_wp, &
         & 1908.17205158257_wp, 0.0_wp])
      call check_terms('pushed', 0.03_wp, [9492.17165240542_wp, 153.081271894619_wp, 3831.49014727031_wp, &
         & 1058.82449859671_wp, -849.347552985858_wp])
      call check_terms('spring', 0.03_wp, [4078.125_wp, 0.0_wp, 2029.15055900087_wp, 1058.82449859671_wp, -13491.901457875_wp])
      call check_terms('distributed_spring', 0.03_wp, &
         & [4078.125_wp, 0.0_wp, 2029.15055900087_wp, 1058.82449859671_wp, -5427.17480757054_wp])
      call check_terms('hinge', 0.03_wp, [4071.915_wp, 0.0_wp, 2028.3406804954_wp, 794.073681157618_wp, 0.0_wp])
      call check_terms('edge', 0.0_wp, [4071.915_wp, 2.835_wp, 2025.0_wp, 1390.5675_wp, 0.0_wp])
      call check_terms('edge', 0.03_wp, [4072.04911318337_wp, 1.63510415758665_wp, 2028.35282958418_wp, &
         & 802.018589296253_wp, 0.0_wp])
      call check_parts()
   end subroutine test_terms

   !> Terms are linear in the parts of a load that are masses
   subroutine check_parts()
      type(wall_input_type) :: input
      type(wall_type) :: walls(4)
      real(wp) :: terms(5, 4), expected(5)
      integer :: i

      input = a_case('both')
      call input%clear('load_inertia')
      walls = [made(a_case('dead')), made(a_case('vertical')), made(a_case('both')), made(a_case('both'))]
      call input%set('load_lifted', [0.7_wp])
      call input%set('load_pushed', [0.2_wp])
      walls(4) = made(input)
      do i = 1, 4
         call walls(i)%mechanism%terms(0.03_wp, terms(1, i), terms(2, i), terms(4, i), terms(3, i), terms(5, i))
      end do
      expected = 0.3_wp*terms(:, 1) + 0.5_wp*terms(:, 2) + 0.2_wp*terms(:, 3)
      do i = 1, 5
         call check_close(terms(i, 4), expected(i), exact, 'a load by parts')
      end do
   end subroutine check_parts

   !> The terms of a case at a rotation
   subroutine check_terms(name, q, expected)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: q, expected(5)
      type(wall_type) :: wall
      real(wp) :: j, c, gravity, l, load

      wall = made(a_case(name))
      call wall%mechanism%terms(q, j, c, gravity, l, load)
      call check_close(j, expected(1), exact, name//': J')
      call check_close(c, expected(2), exact, name//': C')
      call check_close(l, expected(3), exact, name//': L')
      call check_close(gravity, expected(4), exact, name//': G')
      call check_close(load, expected(5), exact, name//': Q')
   end subroutine check_terms

   !> Trigger, capacity and work to overturn
   subroutine test_statics()

      call suite('trigger, capacity, energy')
      call check_statics('dead', 0.171426863492783_wp, 0.0681869248009173_wp, 116.148161004923_wp)
      call check_statics('both', 0.0682927990935571_wp, 0.0681869248009173_wp, 116.148161004923_wp)
      call check_statics('thrust', 0.020409383219441_wp, 0.00808992582269057_wp, 1.63998859472575_wp)
      call check_statics('hinge', 0.07_wp, 0.0698860016346425_wp, 48.6103875430504_wp)
      call check_statics('edge', 0.07_wp, 0.0708272727453679_wp, 49.2656486231896_wp)
      call check_statics('edge thrust', 0.0725169580045557_wp, 0.0290850446054359_wp)
      call check_statics('stepped', 0.0550811272416738_wp, 0.0550255243184709_wp, 587.687282057317_wp)
      call check_statics('floors', 0.0844850431275166_wp, 0.0555821528209993_wp, 910.53513029038_wp)
      call check_statics('roof', 0.0303199349167535_wp, 0.0199448768451729_wp, 117.231333421555_wp)
      call check_statics('gable', 0.15_wp, 0.148889947609497_wp, 88.8963644811315_wp)
   end subroutine test_statics

   !> The static quantities of a case
   subroutine check_statics(name, trigger, capacity, work)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: trigger, capacity
      real(wp), intent(in), optional :: work
      type(wall_type) :: wall
      real(wp) :: energy(2)

      wall = made(a_case(name))
      call check_close(wall%mechanism%trigger_acceleration()/g, trigger, exact, name//': trigger')
      call check_close(wall%mechanism%capacity, capacity, exact, name//': capacity')
      if (.not. present(work)) return
      energy = [wall%mechanism%potential(0.0_wp), wall%mechanism%potential(capacity)]
      ! The energies themselves are rounded.
      call check_close(energy(2) - energy(1), work, exact, name//': V(q_c) - V(0)', 4.0_wp*epsilon(g)*energy(1))
   end subroutine check_statics

   !> C = J'/2 and G - Q = V', by differences of high order
   subroutine test_energy()
      character(len=*), parameter :: names(11) = [character(len=18) :: 'dead', 'both', 'vertical', 'pushed', 'thrust', &
         & 'spring', 'distributed_spring', 'edge', 'edge thrust', 'roof', 'gable']
      real(wp), parameter :: weights(4) = [0.8_wp, -0.2_wp, 4.0_wp/105.0_wp, -1.0_wp/280.0_wp]
      type(wall_input_type) :: input
      type(wall_type) :: wall
      real(wp) :: q, step, slope_j, slope_v, j(-4:4), v(-4:4), c, gravity, l, load, ignored
      integer :: i, k, m

      call suite('C = J''/2 and G - Q = V''')
      do m = 1, size(names)
         input = a_case(trim(names(m)))
         if (input%has('thrust')) call input%set('thrust_decay', [0.05_wp])
         if (names(m) == 'spring' .or. names(m) == 'distributed_spring') call input%set('edge_radius', 0.03_wp)
         wall = made(input)
         do i = 1, 9
            q = 0.1_wp*real(i, wp)*min(wall%mechanism%capacity, 0.2_wp)
            step = 0.01_wp*min(wall%mechanism%capacity, 0.2_wp)
            do k = -4, 4
               call wall%mechanism%terms(q + k*step, j(k), ignored, gravity, l, load)
               v(k) = wall%mechanism%potential(q + k*step)
            end do
            slope_j = sum(weights*(j(1:) - j(-1:-4:-1)))/step
            slope_v = sum(weights*(v(1:) - v(-1:-4:-1)))/step
            call wall%mechanism%terms(q, ignored, c, gravity, l, load)
            call check_close(c, 0.5_wp*slope_j, 1.0e-9_wp, trim(names(m))//': C', 1.0e-9_wp*j(0))
            call check_close(gravity - load, slope_v, 1.0e-9_wp, trim(names(m))//': G - Q', 1.0e-9_wp*v(0))
         end do
      end do
   end subroutine test_energy

   !> The first swing under a short motion, by both engines
   subroutine test_first_swing()

      call suite('first swing')
      call check_swing('bare', 1.0_wp, [0.02725_wp, 0.042965453921181_wp, 0.503160560273231_wp], &
         & [0.0288529411764706_wp, 0.0427066436662825_wp, 0.495265982627159_wp])
      call check_swing('dead', 1.0_wp, [0.0560565843621399_wp, 0.0151657576291272_wp, 0.347405694780592_wp], &
         & [0.0593540305010893_wp, 0.0152664737358552_wp, 0.347342754675119_wp])
      call check_swing('both', 1.0_wp, [0.0223317453035932_wp, 0.0410585988382851_wp, 0.711147692454775_wp], &
         & [0.0233969752573583_wp, 0.0403554317609037_wp, 0.685553014174345_wp])
      call check_swing('vertical', 1.0_wp, [0.0560565843621399_wp, 0.01505083629824_wp, 0.347199128341314_wp], &
         & [0.0632896106602507_wp, 0.0153181840267731_wp, 0.347485025595285_wp])
      call check_swing('pushed', 1.0_wp, [0.0296770152505447_wp, 0.0320231393846593_wp, 0.462819135041589_wp], &
         & [0.0305763187429854_wp, 0.0319350652036106_wp, 0.462971164273257_wp])
      call check_swing('small thrust', 0.6_wp, [0.0289557613168724_wp, 0.0240823572094711_wp, 0.466428370073956_wp], &
         & [0.0319104308390023_wp, 0.0239099331216592_wp, 0.466581857280992_wp])
      call check_swing('hinge', 0.8_wp, [0.0286125_wp, 0.0325859035070085_wp, 0.47122213028475_wp], &
         & [0.0303849557522124_wp, 0.0324108932279321_wp, 0.470928500020717_wp])
      call check_swing('edge', 0.8_wp, [0.0286125_wp, 0.0325299002154705_wp, 0.470102251857929_wp], &
         & [0.0303849557522124_wp, 0.0323569021237761_wp, 0.469923852677993_wp])
   end subroutine test_first_swing

   !> The first swing of a case without and with vertical motion, which is not scaled
   subroutine check_swing(name, scale, still, shaken)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: scale
      !> Start [s], peak [rad] and its time [s] without and with vertical motion
      real(wp), intent(in) :: still(3), shaken(3)
      real(wp), parameter :: vertical(10) = [0.0_wp, 2.0_wp, -4.0_wp, 3.0_wp, -2.0_wp, 4.0_wp, -1.0_wp, 0.0_wp, 0.0_wp, &
         & 0.0_wp]
      type(wall_type) :: wall
      type(record_type) :: record

      wall = made(a_case(name))
      record = accelerogram([0.0_wp, -3.0_wp, -3.0_wp, 1.0_wp, 2.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], 0.1_wp)
      call check_motion(name, wall, record, scale, still(1), still(2), still(3))
      record%vertical = vertical/scale
      call check_motion(name//', vertical', wall, record, scale, shaken(1), shaken(2), shaken(3))
   end subroutine check_swing

   !> Start, peak and its time
   subroutine check_motion(name, wall, record, scale, start, peak, time)
      character(len=*), intent(in) :: name
      type(wall_type), intent(in) :: wall
      type(record_type), intent(in) :: record
      real(wp), intent(in) :: scale, start, peak, time
      type(response_type) :: response
      type(rest_type) :: rest
      real(wp) :: side, begin
      integer :: first
      logical :: found

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
   end subroutine check_motion

   subroutine test_restitution()
      real(wp), parameter :: two_sided(3) = [0.989655172413793_wp, 0.991237176018464_wp, 0.992689557616011_wp]
      real(wp), parameter :: one_sided(3) = [0.479576776415597_wp, 0.481517820316845_wp, 0.483337679384323_wp]
      type(wall_input_type) :: input
      type(wall_type) :: wall
      integer :: i

      call suite('restitution')
      do i = 1, 3
         input = plain_wall()
         call input%set('hinge_depth', 0.01_wp*real(i - 1, wp))
         call input%set('restitution', 'impulse')
         wall = made(input)
         call check_close(wall%mechanism%restitution, one_sided(i), exact, 'one-sided, impulse')
         call input%set('restitution', 'default')
         wall = made(input)
         call check_close(wall%mechanism%restitution, one_sided(1), exact, 'one-sided, as the bare block')
         call input%set('mechanism', 'free_standing')
         wall = made(input)
         call check_close(wall%mechanism%restitution, two_sided(i), exact, 'free-standing')
      end do
      input = plain_wall()
      call input%set('mechanism', 'free_standing')
      call input%set('load', [300.0_wp*g])
      call input%set('load_depth', [0.125_wp])
      call input%set('load_height', [3.0_wp])
      call input%set('load_inertia', 'both')
      wall = made(input)
      call check_close(wall%mechanism%restitution, 0.99239806496199_wp, exact, 'coping')
      ! The same by parts
      call input%clear('load_inertia')
      call input%set('load_lifted', [1.0_wp])
      call refuse(input, 'load_pushed: must be given with load')
      call input%set('load_pushed', [1.0_wp])
      wall = made(input)
      call check_close(wall%mechanism%restitution, 0.99239806496199_wp, exact, 'coping, by parts')
      call input%set('load_inertia', 'both')
      call refuse(input, 'load_inertia: give either load_inertia or load_lifted and load_pushed')
      call input%clear('load_lifted')
      call input%clear('load_pushed')
      ! A dead force has no impulse.
      call input%set('load_inertia', 'none')
      wall = made(input)
      call check_close(wall%mechanism%restitution, two_sided(1), exact, 'dead load')
   end subroutine test_restitution

   !> What tends to nothing tends to the bare wall, and lanes takes all smooth walls
   subroutine test_limits()
      character(len=*), parameter :: names(11) = [character(len=18) :: 'dead', 'both', 'vertical', 'pushed', 'thrust', &
         & 'distributed_spring', 'hinge', 'edge', 'edge thrust', 'roof', 'gable']
      type(wall_input_type) :: input
      type(wall_type) :: bare, wall
      type(normal_form_type) :: form
      real(wp) :: terms(5), expected(5)
      integer :: i

      call suite('limits')
      bare = made(plain_wall())
      input = plain_wall()
      call input%clear('height')
      call input%clear('thickness')
      call input%set('section_height', [1.0_wp, 2.0_wp])
      call input%set('section_thickness', [0.25_wp, 0.25_wp])
      wall = made(input)
      call wall%mechanism%terms(0.02_wp, terms(1), terms(2), terms(3), terms(4), terms(5))
      call bare%mechanism%terms(0.02_wp, expected(1), expected(2), expected(3), expected(4), expected(5))
      do i = 1, 5
         call check_close(terms(i), expected(i), exact, 'two equal sections')
      end do
      call check_close(wall%input%number('height'), 3.0_wp, exact, 'height of the sections')
      call check_close(wall%input%number('thickness'), 0.25_wp, 0.0_wp, 'thickness of the lowest section')
      wall = made(wall%input)
      call check_close(wall%mechanism%capacity, bare%mechanism%capacity, exact, 'what was understood is understood again')
      ! Crushing: u = N/(2 0.85 f)
      input = a_case('both')
      call input%set('compressive_strength', 1.0e6_wp)
      wall = made(input)
      associate (u => (1350.0_wp*g + 1.0e4_wp)/1.7e6_wp)
         call check_close(wall%mechanism%trigger_acceleration(), (1350.0_wp*g*(0.125_wp - u) + 1.0e4_wp*(0.175_wp - u)) &
            & /(2025.0_wp + 3.0e4_wp/g), exact, 'hinge by strength')
      end associate
      do i = 1, size(names)
         input = a_case(trim(names(i)))
         if (names(i) == 'roof') call input%set('thrust_decay', [1.0_wp])
         wall = made(input)
         form = new_normal_form(wall%mechanism, wall%mechanism%capacity)
         call check(form%exists, trim(names(i))//': lanes takes it')
      end do
   end subroutine test_limits

   !> A load that loses its seat ends the history as a collapse
   subroutine test_unseating()
      type(wall_input_type) :: input
      type(wall_type) :: wall
      type(response_type) :: response

      call suite('unseating')
      input = a_case('dead')
      call input%set('load_seat', [0.06_wp])
      wall = made(input)
      associate (q => wall%mechanism%unseating)
         call check_close(3.0_wp*sin(q) + 0.175_wp*(1.0_wp - cos(q)), 0.06_wp, exact, 'travel of the load')
         call check(q < 0.5_wp*wall%mechanism%capacity, 'it comes before the capacity')
         call simulate_rk45(wall%mechanism, stillness(3.0_wp), 1.0_wp, tight(1.0_wp), response, &
            & initial=initial_state_type(0.99_wp*q))
         call check(.not. response%collapsed, 'released below it, the wall falls back')
      end associate
      call run_alone(wall%mechanism, accelerogram([0.0_wp, -5.0_wp, -5.0_wp, 0.0_wp, 0.0_wp], 0.1_wp), 1.0_wp, &
         & tight(1.0_wp), response)
      call check(response%collapsed, 'lanes: collapse')
      call check_close(response%edp, 1.0_wp, 0.0_wp, 'lanes: the limit')
   end subroutine test_unseating

   !> Mass, centroid and inertia given
   subroutine test_given_body()
      type(wall_input_type) :: input
      type(wall_type) :: bare, wall

      call suite('given body')
      bare = made(plain_wall())
      input = plain_wall()
      call input%set('mass', 1350.0_wp)
      call input%set('centroid_depth', 0.125_wp)
      call input%set('centroid_height', 1.5_wp)
      call input%set('hinge_inertia', 4078.125_wp)
      wall = made(input)
      call check_close(wall%mechanism%capacity, bare%mechanism%capacity, exact, 'capacity')
      call check_close(wall%mechanism%frequency_parameter(), bare%mechanism%frequency_parameter(), exact, 'p')
      call check_close(wall%mechanism%restitution, bare%mechanism%restitution, exact, 'restitution')
      call check_close(wall%input%number('density'), 1800.0_wp, exact, 'density')
      call input%set('hinge_inertia', 3000.0_wp)
      call refuse(input, 'hinge_inertia = 3000: must be at least 3058.59375, which the mass has at its centroid')
      call input%clear('hinge_inertia')
      call refuse(input, 'hinge_inertia: must be given with mass')
   end subroutine test_given_body

   subroutine test_wrong_input()
      type(wall_input_type) :: input

      call suite('wrong input')
      input = plain_wall()
      call set_thrust(input, 1.0e3_wp)
      call input%set('hinge_depth', 0.02_wp)
      call refuse(input, 'thrust: the wall is not stable at rest; its weights resist with 1391 N m per metre, '// &
         & 'thrusts push it out with 3000')
      input = a_case('dead')
      call input%clear('load_height')
      call refuse(input, 'load_height: must be given with load')
      input = a_case('dead')
      call input%clear('load_inertia')
      call refuse(input, 'load_inertia: must be given with load: ''none''')
      call input%set('load_inertia', 'some')
      call refuse(input, 'load_inertia = ''some'': each must be one of ''none'', ''vertical'', ''both''')
      input = a_case('dead')
      call input%set('load_height', [3.5_wp])
      call refuse(input, 'load 1: its height 3.5 must lie between 0 and 3 m, the wall')
      input = a_case('dead')
      call input%set('load_depth', [0.3_wp])
      call refuse(input, 'load 1: its depth 0.3 must lie between 0 and 0.25 m, the faces of the wall at its height')
      input = a_case('hinge')
      call input%set('hinge_depth', 0.125_wp)
      call refuse(input, 'hinge_depth: puts the hinge at depth 0.125 m, must be less deep than the centroid')
      input = a_case('dead')
      call input%set('load_depth', [0.03_wp])
      call input%set('hinge_depth', 0.04_wp)
      call refuse(input, 'hinge_depth: puts the hinge at depth 0.04 m, must be less deep than load 1, load_depth = 0.03')
      input = a_case('hinge')
      call input%set('compressive_strength', 1.0e6_wp)
      call refuse(input, 'hinge_depth = 0.02: give either hinge_depth or compressive_strength')
      input = a_case('edge')
      call input%set('hinge_depth', 0.01_wp)
      call refuse(input, 'edge_radius = 0.02: not with hinge_depth')
      input = a_case('dead')
      call input%set('mechanism', 'free_standing')
      call refuse(input, 'load_depth: a wall of mechanism = ''free_standing'' has loads and masses at half its thickness, 0.125')
      input = a_case('small thrust')
      call input%set('mechanism', 'free_standing')
      call refuse(input, 'thrust: not for mechanism = ''free_standing''')
      input = a_case('stepped')
      call input%set('mechanism', 'free_standing')
      call refuse(input, 'section_offset: a wall of mechanism = ''free_standing'' has sections at half its thickness, 0.3')
      input = a_case('stepped')
      call input%set('height', 10.0_wp)
      call refuse(input, 'height = 10: must be 10.5, the sum of section_height; leave it out')
      input = a_case('roof')
      call input%set('load_depth', [0.5_wp, 0.35_wp])
      call refuse(input, 'load_depth: has 2 values, must have 3 as load, or one for all')
      ! Heights are never shared: two loads at one height would be one
      input = a_case('roof')
      call input%set('load_height', [4.0_wp])
      call refuse(input, 'load_height = 4: is one value for 3 values of load, must be one for each, such as load_height = 4, 4')
      input = a_case('roof')
      call input%set('load_height', [4.0_wp, 7.5_wp])
      call refuse(input, 'load_height: has 2 values, must have 3 as load')
      call refuse_one_height('thrust', 'thrust_height')
      call refuse_one_height('spring', 'spring_height')
      call refuse_one_height('inertia_mass', 'inertia_height')
      input = plain_wall()
      call input%set('thrust_height', [3.0_wp])
      call refuse(input, 'thrust_height: only with thrust')
      input = a_case('dead')
      call input%set('load', [-5.0_wp])
      call refuse(input, 'load = -5: must lie between 0 and 1e9 N/m')
      input = a_case('dead')
      call input%set('mechanism', 'two_block')
      call input%set('load_seat', [0.15_wp])
      call refuse(input, 'load_seat = 0.15: only for mechanism = ''one_sided'' or ''free_standing''')
   end subroutine test_wrong_input

   !> Two things of a kind with one height between them
   subroutine refuse_one_height(list, height)
      !> Their property, and that of their heights
      character(len=*), intent(in) :: list, height
      type(wall_input_type) :: input

      input = plain_wall()
      call input%set(list, [400.0_wp, 600.0_wp])
      call input%set(height, [1.5_wp])
      call refuse(input, height//' = 1.5: is one value for 2 values of '//list)
   end subroutine refuse_one_height

   !> Input that must be refused with a sentence
   subroutine refuse(input, sentence)
      type(wall_input_type), intent(in) :: input
      character(len=*), intent(in) :: sentence
      type(wall_type) :: wall
      type(error_type), allocatable :: error

      call new_wall(wall, input, error)
      call check_error(error, sentence, 'wrong wall')
   end subroutine refuse

end program test_loaded_block
