!> Walls against independently computed values (15 digits; docs/theory.md, sections 2 and 3).
program test_wall
   use checks, only : check, check_close, check_error, check_ok, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   use dondolo_wall_single_block, only : housner_restitution, one_sided_restitution
   use dondolo_wall_two_block, only : two_block_impulse, two_block_sorrentino, two_block_type
   implicit none

   real(wp), parameter :: tight = 1.0e-12_wp, g = 9.81_wp

   call test_single_block()
   call test_two_block()
   call test_thin_two_block()
   call test_energy()
   call test_overburden()
   call test_bearing()
   call test_restitution_models()
   call test_wrong_input()
   call finish()

contains

   !> A wall that must be right
   function made(input) result(wall)
      type(wall_input_type), intent(in) :: input
      type(wall_type) :: wall
      type(error_type), allocatable :: error

      call new_wall(wall, input, error)
      call check_ok(error, 'new_wall')
   end function made

   !> The one-sided wall of the check values
   function parapet() result(input)
      type(wall_input_type) :: input

      call input%set('mechanism', 'one_sided')
      call input%set('height', 3.0_wp)
      call input%set('thickness', 0.25_wp)
   end function parapet

   !> A two-block wall
   function strip(height, thickness, hinge) result(input)
      real(wp), intent(in) :: height, thickness, hinge
      type(wall_input_type) :: input

      call input%set('mechanism', 'two_block')
      call input%set('height', height)
      call input%set('thickness', thickness)
      call input%set('hinge', hinge)
   end function strip

   subroutine test_single_block()
      type(wall_type) :: wall
      type(wall_input_type) :: input
      real(wp) :: j, c, gravity, l, load

      call suite('one block, H = 3, t = 0.25')
      wall = made(parapet())
      call check_close(wall%model%radius, 1.50519932234904_wp, tight, 'R')
      call check_close(wall%model%alpha, 0.0831412318884412_wp, tight, 'alpha')
      call check_close(wall%mechanism%capacity, 0.0831412318884412_wp, tight, 'capacity')
      call check_close(wall%mechanism%frequency_parameter(), 2.21089505499269_wp, tight, 'p')
      call wall%mechanism%terms(0.0_wp, j, c, gravity, l, load)
      call check_close(j, 4078.125_wp, tight, 'I_0')
      call check_close(c, 0.0_wp, 0.0_wp, 'C')
      call check_close(one_sided_restitution(wall%model%alpha), -0.479576776415597_wp, tight, 'equation (2)')
      call check_close(wall%mechanism%restitution, 0.479576776415597_wp, tight, 'speed ratio')
      call check_close(housner_restitution(wall%model%alpha), 0.989655172413793_wp, tight, 'Housner''s coefficient')
      call check_close(wall%mechanism%trigger_acceleration()/g, 0.0833333333333333_wp, tight, 'trigger')
      call check(.not. wall%mechanism%two_sided, 'it rocks to one side')
      input = parapet()
      call input%set('mechanism', 'free_standing')
      wall = made(input)
      call check(wall%mechanism%two_sided, 'a free-standing wall rocks to both')
      call check_close(wall%mechanism%restitution, 0.989655172413793_wp, tight, 'free-standing: speed ratio')
      input = parapet()
      call input%set('height', 6.0_wp)
      call input%set('thickness', 0.40_wp)
      wall = made(input)
      call check_close(wall%mechanism%frequency_parameter(), 1.56431074267338_wp, tight, 'H = 6, t = 0.40: p')
      call check_close(wall%mechanism%restitution, 0.486835501338626_wp, tight, 'H = 6, t = 0.40: speed ratio')
      ! A squat wall would be pushed through its restraint: the impact is plastic.
      call input%set('height', 1.0_wp)
      call input%set('thickness', 1.0_wp)
      wall = made(input)
      call check_close(wall%mechanism%restitution, 0.0_wp, 0.0_wp, 'squat wall: speed ratio')
   end subroutine test_single_block

   subroutine test_two_block()
      type(wall_type) :: wall

      call suite('two blocks, H = 3, t = 0.25, hinge 0.6')
      wall = made(strip(3.0_wp, 0.25_wp, 0.6_wp))
      call check_close(wall%model%alpha, 0.138006023657519_wp, tight, 'alpha1')
      call check_close(wall%mechanism%capacity, 0.138006023657519_wp, tight, 'capacity')
      call check_terms(wall, 0.0_wp, [1584.5625_wp, -717.5390625_wp, 3310.875_wp, 1215.0_wp])
      call check_terms(wall, 0.5_wp*wall%model%alpha, &
         & [1510.62905152394_wp, -355.601934879061_wp, 1655.01450775168_wp, 1223.74360745925_wp])
      call check_close(wall%mechanism%trigger_acceleration()/g, 0.277777777777778_wp, tight, 'trigger')
      call check_two_block_restitution(wall, 0.957519116397621_wp, 0.85356762513312_wp)
      wall = made(strip(3.0_wp, 0.25_wp, 0.5_wp))
      call check_close(wall%mechanism%trigger_acceleration()/g, 1.0_wp/3.0_wp, tight, 'hinge 0.5: trigger')
      call check_two_block_restitution(wall, 0.945945945945946_wp, 0.8125_wp)
      ! It grows with the height of the hinge (docs/theory.md, section 3).
      wall = made(strip(3.0_wp, 0.25_wp, 0.3_wp))
      call check_close(wall%mechanism%restitution, 0.899_wp, 0.0_wp, 'hinge 0.3: sorrentino', 5.0e-4_wp)
      wall = made(strip(3.0_wp, 0.25_wp, 0.7_wp))
      call check_close(wall%mechanism%restitution, 0.966_wp, 0.0_wp, 'hinge 0.7: sorrentino', 5.0e-4_wp)
      wall = made(strip(4.0_wp, 0.38_wp, 0.7_wp))
      call check_terms(wall, 0.5_wp*wall%model%alpha, &
         & [7420.00158382046_wp, -2070.03401639077_wp, 5059.50054100952_wp, 3856.72544168463_wp])
      call check_two_block_restitution(wall, 0.955508082903683_wp, 0.840676102576809_wp)
   end subroutine test_two_block

   !> J, C, G and L at a rotation
   subroutine check_terms(wall, q, expected)
      type(wall_type), intent(in) :: wall
      real(wp), intent(in) :: q, expected(4)
      real(wp) :: j, c, gravity, l, load

      call wall%mechanism%terms(q, j, c, gravity, l, load)
      call check_close(j, expected(1), tight, 'J')
      call check_close(c, expected(2), tight, 'C')
      call check_close(gravity, expected(3), tight, 'G')
      call check_close(l, expected(4), tight, 'L')
      call check_close(load, 0.0_wp, 0.0_wp, 'Q')
   end subroutine check_terms

   !> Both coefficients of restitution, and which one the wall uses
   subroutine check_two_block_restitution(wall, sorrentino, impulse)
      type(wall_type), intent(in) :: wall
      real(wp), intent(in) :: sorrentino, impulse

      select type (mechanism => wall%mechanism)
      type is (two_block_type)
         call check_close(two_block_sorrentino(mechanism%lower, mechanism%upper), sorrentino, tight, 'sorrentino')
         call check_close(two_block_impulse(mechanism%lower, mechanism%upper, mechanism%overburden), impulse, tight, 'impulse')
         call check_close(mechanism%restitution, sorrentino, tight, 'speed ratio')
      class default
         call check(.false., 'is a two-block wall')
      end select
   end subroutine check_two_block_restitution

   !> Hinge at mid height: closed forms
   subroutine test_thin_two_block()
      real(wp), parameter :: slenderness(5) = [10.0_wp, 13.0_wp, 15.0_wp, 17.0_wp, 20.0_wp]
      real(wp), parameter :: published(5) = [0.741_wp, 0.838_wp, 0.8755_wp, 0.902_wp, 0.928_wp]
      type(wall_type) :: wall
      real(wp) :: h, t, j, c, gravity, l, load
      integer :: i

      call suite('two blocks hinged at mid height')
      h = 3.2_wp
      do i = 1, size(slenderness)
         t = h/slenderness(i)
         wall = made(strip(h, t, 0.5_wp))
         select type (mechanism => wall%mechanism)
         type is (two_block_type)
            call check_close(two_block_impulse(mechanism%lower, mechanism%upper, mechanism%overburden), &
               & (h**2 - 14.0_wp*t**2)/(h**2 + 16.0_wp*t**2), tight, 'impulse, closed form')
            call check_close(two_block_impulse(mechanism%lower, mechanism%upper, mechanism%overburden), published(i), 0.0_wp, &
               & 'impulse, published', 5.0e-4_wp)
         end select
         call wall%mechanism%terms(0.0_wp, j, c, gravity, l, load)
         call check_close(j, 1800.0_wp*h*t/12.0_wp*(h**2 + 16.0_wp*t**2), tight, 'J(0)')
         call check_close(wall%mechanism%trigger_acceleration(), 4.0_wp*t*g/h, tight, 'trigger')
         call check_close(tan(wall%mechanism%capacity), 2.0_wp*t/h, tight, 'tan q_c')
      end do
   end subroutine test_thin_two_block

   !> C = J'/2 and G - Q = V', by differences of high order
   subroutine test_energy()
      type(wall_input_type) :: input
      type(wall_type) :: wall
      real(wp), parameter :: weights(4) = [0.8_wp, -0.2_wp, 4.0_wp/105.0_wp, -1.0_wp/280.0_wp]
      real(wp) :: q, step, slope_j, slope_v, j(-4:4), v(-4:4), c, gravity, l, load, ignored
      integer :: i, k, m

      call suite('C = J''/2 and G - Q = V''')
      do m = 1, 3
         input = strip(3.0_wp, 0.3_wp, 0.65_wp)
         if (m == 1) input = parapet()
         if (m == 3) call input%set('overburden', 4.0e4_wp)
         if (m == 3) call input%set('overburden_inertia', 0.0_wp)
         if (m == 3) call input%set('eccentricity', 0.05_wp)
         wall = made(input)
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
      end do
   end subroutine test_energy

   subroutine test_overburden()
      type(wall_input_type) :: input
      type(wall_type) :: bare, wall
      real(wp) :: j, c, gravity, l, load, t

      call suite('overburden')
      input = strip(3.0_wp, 0.25_wp, 0.6_wp)
      bare = made(input)
      call input%set('overburden', 2.0e4_wp)
      call input%set('overburden_inertia', 0.0_wp)
      wall = made(input)
      call wall%mechanism%terms(0.0_wp, j, c, gravity, l, load)
      ! At rest Q(0) = -N [2 b (1 + T) - (b - e) T] with T = 1.5, b = 0.125.
      t = 1.5_wp
      call check_close(load, -2.0e4_wp*(0.25_wp*(1.0_wp + t) - 0.125_wp*t), tight, 'Q(0)')
      call check(wall%mechanism%trigger_acceleration() > bare%mechanism%trigger_acceleration(), 'it stabilises at rest')
      call check(wall%mechanism%capacity < bare%mechanism%capacity, 'it takes capacity away')
      call wall%mechanism%terms(wall%mechanism%capacity, j, c, gravity, l, load)
      call check_close(gravity - load, 0.0_wp, 0.0_wp, 'G - Q at the capacity', 1.0e-9_wp)
      call check_close(wall%mechanism%frequency_parameter()**2, &
         & wall%mechanism%trigger_acceleration()*1215.0_wp/(1584.5625_wp*sin(wall%mechanism%capacity)), tight, 'p^2')
      call input%set('eccentricity', 0.125_wp)
      wall = made(input)
      call check_close(wall%mechanism%capacity, wall%model%alpha, 0.0_wp, 'load on the hinge: capacity')
      call input%set('overburden', 0.0_wp)
      wall = made(input)
      call check_terms(wall, 0.0_wp, [1584.5625_wp, -717.5390625_wp, 3310.875_wp, 1215.0_wp])
   end subroutine test_overburden

   !> A load by its bearing is the load of a wall that folds outwards
   subroutine test_bearing()
      type(wall_input_type) :: input
      type(wall_type) :: wall

      call suite('bearing')
      input = strip(3.0_wp, 0.25_wp, 0.6_wp)
      call input%set('overburden', 8.0e3_wp)
      call input%set('overburden_inertia', 0.0_wp)
      call input%set('bearing', 'inner')
      call input%set('bearing_distance', 0.06_wp)
      wall = made(input)
      call check_close(wall%input%number('eccentricity'), -0.065_wp, tight, 'inner face')
      call check(.not. (wall%input%has('bearing') .or. wall%input%has('bearing_distance')), 'one form is kept')
      call input%set('bearing', 'outer')
      wall = made(input)
      call check_close(wall%input%number('eccentricity'), 0.065_wp, tight, 'outer face')
      call input%set('bearing_distance', 0.0_wp)
      wall = made(input)
      call check_close(wall%mechanism%capacity, wall%model%alpha, 0.0_wp, 'on the outer edge: on the hinge')
      call input%set('eccentricity', 0.0_wp)
      call refuse(input, 'eccentricity = 0: give either eccentricity or bearing and bearing_distance')
      call input%clear('eccentricity')
      call input%set('bearing_distance', 0.3_wp)
      call refuse(input, 'bearing_distance = 0.3: must lie between 0 and 0.25 (the thickness)')
      call input%set('bearing', 'inside')
      call refuse(input, 'bearing = ''inside'': must be one of ''inner'', ''outer'', ''centre''')
      call input%set('bearing', 'centre')
      call refuse(input, 'bearing_distance = 0.3: not with bearing = ''centre'', measure it from a face')
      call input%clear('bearing')
      call refuse(input, 'bearing_distance = 0.3: only with bearing = ''inner'' or ''outer''')
      call input%clear('bearing_distance')
      call input%set('bearing', 'outer')
      call refuse(input, 'bearing_distance: must be given with bearing = ''outer''')
      call input%set('bearing', 'centre')
      wall = made(input)
      call check_close(wall%input%number('eccentricity'), 0.0_wp, 0.0_wp, 'centreline')
      input = parapet()
      call input%set('bearing', 'centre')
      call refuse(input, 'bearing = ''centre'': only for mechanism = ''two_block''')
   end subroutine test_bearing

   subroutine test_restitution_models()
      type(wall_input_type) :: input
      type(wall_type) :: wall

      call suite('models of restitution')
      input = strip(3.0_wp, 0.25_wp, 0.6_wp)
      call input%set('restitution', 'impulse')
      call input%set('restitution_factor', 0.87_wp)
      wall = made(input)
      call check_close(wall%mechanism%restitution, 0.87_wp*0.85356762513312_wp, tight, 'factor on impulse')
      call input%clear('restitution')
      call input%set('restitution_value', 0.5_wp)
      wall = made(input)
      call check_close(wall%mechanism%restitution, 0.435_wp, tight, 'factor on a number')
      input = parapet()
      call input%set('restitution', 'sorrentino')
      wall = made(input)
      call check_close(wall%mechanism%restitution, 0.479576776415597_wp, tight, 'one-sided, by name')
      call input%clear('restitution')
      call input%set('restitution_value', 0.0_wp)
      wall = made(input)
      call check_close(wall%mechanism%restitution, 0.0_wp, 0.0_wp, 'plastic')
   end subroutine test_restitution_models

   subroutine test_wrong_input()
      type(wall_input_type) :: input

      call suite('wrong input')
      call refuse(input, 'mechanism: must be given, one of ''one_sided'', ''free_standing'', ''two_block'', ''corner'', &
         &''tabulated'', ''chain'', ''horizontal''')
      input = parapet()
      call input%set('mechanism', 'three_block')
      call refuse(input, 'mechanism = ''three_block'': must be one of ''one_sided'', ''free_standing'', ''two_block'', &
         &''corner'', ''tabulated'', ''chain'', ''horizontal''')
      input = parapet()
      call input%clear('height')
      call refuse(input, 'height: must be given')
      input = parapet()
      call input%set('thickness', -0.25_wp)
      call refuse(input, 'thickness = -0.25: must be positive')
      input = parapet()
      call input%set('density', 0.0_wp)
      call refuse(input, 'density = 0: must be positive')
      input = parapet()
      call input%set('height', 1.0e5_wp)
      call refuse(input, 'height = 100000: must lie between 0.001 and 1000')
      input = parapet()
      call input%set('hinge', 0.5_wp)
      call refuse(input, 'hinge = 0.5: only for mechanism = ''two_block''')
      input = parapet()
      call input%set('overburden', 100.0_wp)
      call refuse(input, 'overburden = 100: only for mechanism = ''two_block''')
      input = parapet()
      call input%set('restitution', 'elastic')
      call refuse(input, 'restitution = ''elastic'': must be one of ''default'', ''sorrentino'', ''impulse''')
      call input%set('mechanism', 'free_standing')
      call input%set('restitution', 'sorrentino')
      call refuse(input, 'restitution = ''sorrentino'': must be one of ''default'', ''impulse''')
      call input%set('restitution', 'constant')
      call refuse(input, 'restitution = ''constant'': must be one of ''default'', ''impulse''')
      call input%set('restitution', 'impulse')
      call input%set('restitution_value', 0.5_wp)
      call refuse(input, 'restitution_value = 0.5: give either it or restitution')
      call input%clear('restitution')
      call input%set('restitution_value', 1.0_wp)
      call refuse(input, 'restitution_value = 1: must be at least 0 and less than 1')
      call input%clear('restitution_value')
      call input%set('restitution_factor', 1.1_wp)
      call refuse(input, 'must be less than 1')
      call input%set('restitution_factor', -1.0_wp)
      call refuse(input, 'restitution_factor = -1: must be positive')
      input = strip(3.0_wp, 0.25_wp, 1.0_wp)
      call refuse(input, 'hinge = 1: must lie between 0.01 and 0.99')
      input = strip(3.0_wp, 0.25_wp, 0.5_wp)
      call input%set('eccentricity', 0.2_wp)
      call refuse(input, 'eccentricity = 0.2: must lie between -0.125 and 0.125')
      call input%set('overburden', -1.0_wp)
      call refuse(input, 'overburden = -1: must lie between 0 and')
      call refuse(input, new_line('a')//'eccentricity = 0.2: must lie between -0.125 and 0.125')
      call input%set('thickness', -0.25_wp)
      call input%clear('height')
      call refuse(input, 'height: must be given'//new_line('a')//'thickness = -0.25: must be positive'// &
         & new_line('a')//'overburden = -1: must lie between 0 and')
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

end program test_wall
