!> Walls with ties, against independently computed values (15 digits) and against limits that need no ties.
!>
!> The facade, unless said otherwise: H = 9 m, t = 0.5 m, 1800 kg/m3; its tie, 8.5 m above the base at the outer face, of
!> 5e-5 m2/m and 8 m, 1.8e8 Pa, stressed to 3e7 Pa.
program test_ties
   use checks, only : check, check_close, check_error, check_ok, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_motion_response, only : response_type, tie_response_type, trace_type
   use dondolo_motion_rest, only : new_rest, rest_type
   use dondolo_motion_restrained_tail, only : restrained_motion
   use dondolo_motion_restraint_state, only : restraint_state_type
   use dondolo_motion_rk45, only : simulate_rk45
   use dondolo_motion_solver, only : solver_type
   use dondolo_motion_tail, only : tail_type
   use dondolo_record, only : record_type
   use dondolo_record_random, only : new_random, random_type
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_tie_statics, only : greatest_acceleration, plastic_acceleration
   use motion_inputs, only : accelerogram, tight
   implicit none

   real(wp), parameter :: exact = 1.0e-12_wp, g = 9.81_wp

   call test_statics()
   call test_histories()
   call test_energy()
   call test_limits()
   call test_several()
   call test_after_the_record()
   call test_wrong_input()
   call finish()

contains

   !> The facade without its tie
   function facade() result(input)
      type(wall_input_type) :: input

      call input%set('mechanism', 'one_sided')
      call input%set('height', 9.0_wp)
      call input%set('thickness', 0.5_wp)
   end function facade

   !> The facade with its tie
   function tied() result(input)
      type(wall_input_type) :: input

      input = facade()
      call input%set('tie_height', [8.5_wp])
      call input%set('tie_area', [5.0e-5_wp])
      call input%set('tie_length', [8.0_wp])
      call input%set('tie_preload', [3.0e7_wp])
   end function tied

   !> A wall
   function made(input) result(wall)
      type(wall_input_type), intent(in) :: input
      type(wall_type) :: wall
      type(error_type), allocatable :: error

      call new_wall(wall, input, error)
      call check_ok(error, 'wall')
   end function made

   subroutine test_statics()
      type(wall_type) :: wall
      type(wall_input_type) :: input

      call suite('statics')
      wall = made(tied())
      associate (tie => wall%mechanism%restraints(1))
         call check_close(tie%stiffness, 1287500.0_wp, exact, 'k')
         call check_close(tie%strength, 9000.0_wp, exact, 'F_y')
         call check_close(tie%preload, 1500.0_wp, exact, 'T_0')
         call check_close(tie%yield_travel, 0.0058252427184466_wp, exact, 'D_y')
         call check_close(tie%fracture_travel, 0.158834951456311_wp, exact, 'D_u')
         call check_close(tie%yield, 0.000685322726404028_wp, exact, 'q_y')
         call check_close(tie%fracture, 0.0186875525504614_wp, exact, 'q_u')
      end associate
      call check_close(wall%mechanism%capacity, 0.0554985052457168_wp, exact, 'capacity, of the wall without the tie')
      call check_close(wall%mechanism%trigger_acceleration()/g, 0.0912124606200946_wp, exact, 'trigger')
      call check_close(greatest_acceleration(wall%mechanism)/g, 0.268801428900375_wp, exact, 'greatest acceleration')
      call check_close(plastic_acceleration(wall%mechanism)/g, 0.26949698594279_wp, exact, 'rigid-plastic acceleration')
      call check_close(wall%mechanism%frequency_parameter(), made_p(facade()), exact, 'p, of the wall without the tie')
      ! An anchor of 6 kN/m breaks before the bar yields.
      input = tied()
      call input%set('tie_anchor_force', [6.0e3_wp])
      wall = made(input)
      associate (tie => wall%mechanism%restraints(1))
         call check_close(tie%strength, 6000.0_wp, exact, 'F_y of the anchor')
         call check(tie%yield >= tie%fracture, 'an anchor gives way at once')
      end associate
      ! One number is a list of one value.
      input = facade()
      call input%set('tie_height', 8.5_wp)
      call input%set('tie_area', 5.0e-5_wp)
      call input%set('tie_length', 8.0_wp)
      call input%set('tie_preload', 3.0e7_wp)
      call check(size(input%list('tie_height')) == 1, 'one number of a list')
      wall = made(input)
      call check_close(wall%mechanism%restraints(1)%fracture, 0.0186875525504614_wp, exact, 'q_u of a tie given by numbers')
      ! Without ties all three are the same.
      wall = made(facade())
      call check_close(greatest_acceleration(wall%mechanism), wall%mechanism%trigger_acceleration(), exact, 'greatest, bare')
      call check_close(plastic_acceleration(wall%mechanism), wall%mechanism%trigger_acceleration(), exact, 'plastic, bare')
   end subroutine test_statics

   !> Frequency parameter
   function made_p(input) result(p)
      type(wall_input_type), intent(in) :: input
      real(wp) :: p
      type(wall_type) :: wall

      wall = made(input)
      p = wall%mechanism%frequency_parameter()
   end function made_p

   !> A history of the facade
   subroutine run(input, a, response, trace, ties)
      type(wall_input_type), intent(in) :: input
      !> Accelerations every 0.1 s
      real(wp), intent(in) :: a(:)
      type(response_type), intent(out) :: response
      type(trace_type), intent(out) :: trace
      type(tie_response_type), allocatable, intent(out) :: ties(:)
      type(wall_type) :: wall

      wall = made(input)
      call simulate_rk45(wall%mechanism, accelerogram(a, 0.1_wp), 1.0_wp, tight(1.0_wp), response, trace)
      ties = trace%ties
   end subroutine run

   !> A history, and what it does to the ties
   subroutine run_tied(wall, record, scale, solver, response, ties)
      type(wall_type), intent(in) :: wall
      type(record_type), intent(in) :: record
      real(wp), intent(in) :: scale
      type(solver_type), intent(in) :: solver
      type(response_type), intent(out) :: response
      type(tie_response_type), allocatable, intent(out) :: ties(:)
      type(trace_type) :: trace

      call simulate_rk45(wall%mechanism, record, scale, solver, response, trace)
      ties = trace%ties
   end subroutine run_tied

   !> Time of an impact and velocity just before it
   subroutine check_impact(trace, number, time, velocity)
      type(trace_type), intent(in) :: trace
      !> Number of the impact
      integer, intent(in) :: number
      real(wp), intent(in) :: time
      !> Negative; positive where it is not known
      real(wp), intent(in) :: velocity
      integer, allocatable :: rows(:)
      integer :: i

      rows = pack([(i, i=1, trace%rows)], trace%after_impact(:trace%rows))
      call check(size(rows) >= number, 'enough impacts')
      if (size(rows) < number) return
      call check_close(trace%time(rows(number)), time, 0.0_wp, 'time of impact', exact)
      if (velocity < 0.0_wp) call check_close(trace%velocity(rows(number) - 1), velocity, 0.0_wp, 'velocity at impact', exact)
   end subroutine check_impact

   subroutine test_histories()
      real(wp), parameter :: unknown = 1.0_wp
      type(response_type) :: response
      type(trace_type) :: trace
      type(tie_response_type), allocatable :: ties(:)
      type(rest_type) :: rest
      type(wall_type) :: wall
      real(wp) :: side, begin, q, a
      integer :: first
      logical :: found

      a = 0.0_wp
      q = made_capacity(facade())
      call suite('histories: no tie')
      call run(facade(), [0.0_wp, -3.5_wp, -3.5_wp, -3.5_wp, -1.0_wp, 2.0_wp, 2.0_wp, a, a, a, a, a], response, trace, ties)
      call check(size(ties) == 0, 'no ties')
      call check(response%collapsed, 'collapses')
      call check_close(response%time_of_peak, 0.593565700087716_wp, 0.0_wp, 'time of the limit', exact)
      call check_close(trace%velocity(trace%rows), 0.109332943882211_wp, 0.0_wp, 'velocity at the limit', exact)

      call suite('histories: yields')
      wall = made(tied())
      rest = new_rest(wall%mechanism)
      first = 1
      begin = 0.0_wp
      side = 1.0_wp
      call rest%next_start(accelerogram([0.0_wp, -3.5_wp, -3.5_wp], 0.1_wp), 1.0_wp, first, begin, side, found)
      call check_close(begin, 0.0255655496766608_wp, 0.0_wp, 'start', exact)
      call run(tied(), [0.0_wp, -3.5_wp, -3.5_wp, -3.5_wp, -1.0_wp, 2.0_wp, 2.0_wp, a, a, a, a, a], response, trace, ties)
      call check_close(ties(1)%time_of_yield, 0.120984878596056_wp, 0.0_wp, 'time of yield', exact)
      call check(ties(1)%time_of_fracture < 0.0_wp .and. .not. ties(1)%broken, 'does not break')
      call check_close(response%edp*q, 0.012578250461766_wp, 0.0_wp, 'peak', exact)
      call check_close(response%time_of_peak, 0.484121051148929_wp, 0.0_wp, 'time of the peak', 1.0e-9_wp)
      call check_impact(trace, 1, 0.718660295925781_wp, -0.0841245954258608_wp)
      call check_close(ties(1)%plastic_elongation, 0.101087067012615_wp, 0.0_wp, 'set', exact)
      call check_close(ties(1)%energy, 9000.0_wp*0.101087067012615_wp, 0.0_wp, 'energy', 9000.0_wp*exact)
      first = minloc(abs(trace%time - 1.1_wp), dim=1)
      call check_close(trace%rotation(first), 0.00965987290950979_wp, 0.0_wp, 'rotation at 1.1 s', exact)
      call check_close(trace%velocity(first), 0.0103696563488995_wp, 0.0_wp, 'velocity at 1.1 s', exact)

      call suite('histories: breaks')
      call run(tied(), [0.0_wp, -6.0_wp, -6.0_wp, -6.0_wp, -1.0_wp, 2.0_wp, 2.0_wp, a, a, a, a, a], response, trace, ties)
      call check_close(ties(1)%time_of_yield, 0.0925904726953155_wp, 0.0_wp, 'time of yield', exact)
      call check_close(ties(1)%time_of_fracture, 0.306152136829063_wp, 0.0_wp, 'time of fracture', exact)
      call check(ties(1)%broken, 'breaks')
      call check_close(response%time_of_peak, 0.506199998997781_wp, 0.0_wp, 'time of the limit', exact)
      call check_close(trace%velocity(trace%rows), 0.181239138813113_wp, 0.0_wp, 'velocity at the limit', exact)

      call suite('histories: elastic')
      call run(tied(), [0.0_wp, -1.5_wp, -1.5_wp, a, a], response, trace, ties)
      call check_close(response%edp*q, 0.000460090131684594_wp, 0.0_wp, 'peak', exact)
      call check_close(response%time_of_peak, 0.224910192845897_wp, 0.0_wp, 'time of the peak', 1.0e-9_wp)
      call check_impact(trace, 1, 0.29579696597261_wp, unknown)
      call check_impact(trace, 2, 0.365422176717702_wp, unknown)
      call check(.not. ties(1)%plastic_elongation > 0.0_wp .and. ties(1)%time_of_yield < 0.0_wp, 'does not yield')

      call suite('histories: yields again and breaks')
      call run(tied(), [0.0_wp, -3.5_wp, -3.5_wp, -3.5_wp, -1.0_wp, 2.0_wp, 2.0_wp, a, -3.0_wp, -3.0_wp, -3.0_wp, a, 1.0_wp, &
         & 1.0_wp, a, a], response, trace, ties)
      call check_impact(trace, 1, 0.718725136714309_wp, -0.0832565209399566_wp)
      call check_close(ties(1)%time_of_fracture, 0.967472372826148_wp, 0.0_wp, 'time of fracture', exact)
      call check_close(response%time_of_peak, 1.24423791104001_wp, 0.0_wp, 'time of the limit', exact)
      call check_close(trace%velocity(trace%rows), 0.124347938964568_wp, 0.0_wp, 'velocity at the limit', exact)
   end subroutine test_histories

   !> Capacity
   function made_capacity(input) result(q)
      type(wall_input_type), intent(in) :: input
      real(wp) :: q
      type(wall_type) :: wall

      wall = made(input)
      q = wall%mechanism%capacity
   end function made_capacity

   !> Still ground, launched at q = 0 with 0.08 rad/s
   subroutine test_energy()
      type(wall_type) :: wall
      class(mechanism_type), allocatable :: held
      type(restraint_state_type) :: restraints
      type(tail_type) :: tail
      type(tie_response_type), allocatable :: ties(:)
      real(wp) :: at_rest, fall, level

      call suite('energy')
      wall = made(tied())
      allocate (held, source=wall%mechanism)
      call restraints%begin(held, 0.0_wp)
      call restrained_motion(held, restraints, wall%mechanism%capacity, 0.0_wp, 0.08_wp, 0.0_wp, tail)
      call check_close(tail%peak, 0.00761924908059266_wp, 0.0_wp, 'peak', exact)
      call restraints%responses(held, tail%peak, ties)
      call check_close(ties(1)%plastic_elongation, 0.0589377478485007_wp, 0.0_wp, 'set', exact)
      ! The wall comes back without what the tie has taken, but for what the tie had at rest.
      at_rest = 1500.0_wp**2/(2.0_wp*1287500.0_wp)
      call check_close(ties(1)%energy - at_rest, 529.565944228739_wp, exact, 'energy that the wall loses')
      level = restraints%below
      fall = held%potential(tail%peak) - held%potential(level)
      call restraints%cross(held, level, .false., 0.0_wp)
      call held%set_restraints(restraints%force, restraints%stiffness)
      fall = fall + held%potential(level) - held%potential(0.0_wp)
      call check_close(sqrt(2.0_wp*fall/219375.0_wp), 0.0396490652059264_wp, 0.0_wp, 'speed at impact', exact)
   end subroutine test_energy

   subroutine test_limits()
      type(wall_type) :: bare, wall, sprung
      type(wall_input_type) :: input
      type(record_type) :: record
      type(response_type) :: one, other
      real(wp) :: limit
      integer :: i

      call suite('limits')
      bare = made(facade())
      do i = 1, 8
         record = shaking(i, 200)
         ! Next to no tie
         input = tied()
         call input%set('tie_area', [1.0e-16_wp])
         wall = made(input)
         call simulate_rk45(bare%mechanism, record, 2.0_wp, tight(1.0_wp), one)
         call simulate_rk45(wall%mechanism, record, 2.0_wp, tight(1.0_wp), other)
         call check_close(other%edp, one%edp, 0.0_wp, 'a tie of no section', 1.0e-8_wp)
         ! A tie that never yields is a spring; with the spring the wall falls at another rotation.
         input = facade()
         call input%set('tie_height', [8.5_wp])
         call input%set('tie_area', [1.0e-6_wp])
         call input%set('tie_length', [8.0_wp])
         call input%set('tie_strength', [1.0e10_wp])
         call input%set('tie_strain', [1.0_wp])
         wall = made(input)
         input = facade()
         call input%set('spring', [25750.0_wp])
         call input%set('spring_depth', [0.0_wp])
         call input%set('spring_height', [8.5_wp])
         sprung = made(input)
         limit = 0.9_wp*min(1.0_wp, sprung%mechanism%capacity/wall%mechanism%capacity)
         call simulate_rk45(wall%mechanism, record, 3.0_wp, tight(limit), one)
         limit = limit*wall%mechanism%capacity/sprung%mechanism%capacity
         call simulate_rk45(sprung%mechanism, record, 3.0_wp, tight(limit), other)
         call check_close(other%edp*sprung%mechanism%capacity, one%edp*bare%mechanism%capacity, 0.0_wp, 'a spring', 1.0e-9_wp)
         ! A tie stronger than all moments: the wall does not fall within its capacity.
         input = tied()
         call input%set('tie_area', [1.0e-3_wp])
         call input%set('tie_strain', [1.0_wp])
         wall = made(input)
         call simulate_rk45(wall%mechanism, record, 4.0_wp, solver_type(), one)
         call check(.not. one%collapsed, 'a strong tie holds')
      end do
      ! A stiff tie lets the wall withstand what the rigid-plastic mechanism does.
      input = tied()
      call input%set('tie_modulus', [1.0e12_wp])
      call input%set('tie_length', [0.1_wp])
      wall = made(input)
      call check_close(greatest_acceleration(wall%mechanism), plastic_acceleration(wall%mechanism), 1.0e-3_wp, 'stiff tie')
   end subroutine test_limits

   !> Pseudorandom pulses, 0.01 s, a zero at both ends
   function shaking(number, samples) result(record)
      integer, intent(in) :: number, samples
      type(record_type) :: record
      type(random_type) :: random
      real(wp) :: a(samples), middle, width, height
      integer :: i, pulse

      random = new_random(number, 0)
      a = 0.0_wp
      do pulse = 1, 6
         middle = real(samples, wp)*random%next()
         width = 5.0_wp + 40.0_wp*random%next()
         height = 6.0_wp*(random%next() - 0.5_wp)
         a = a + height*exp(-(([(real(i, wp), i=1, samples)] - middle)/width)**2)
      end do
      a(1) = 0.0_wp
      a(samples) = 0.0_wp
      record = accelerogram(a, 0.01_wp)
   end function shaking

   !> Several ties: two halves are one, their order does not matter, and each has its own set
   subroutine test_several()
      type(wall_type) :: one, two, three
      type(wall_input_type) :: input
      type(response_type) :: response, other
      type(tie_response_type), allocatable :: ties(:), others(:)
      integer :: i

      call suite('several ties')
      one = made(tied())
      input = facade()
      call input%set('tie_height', [8.5_wp, 8.5_wp])
      call input%set('tie_area', [2.0e-5_wp, 3.0e-5_wp])
      call input%set('tie_length', [8.0_wp])
      call input%set('tie_preload', [3.0e7_wp])
      two = made(input)
      do i = 1, 10
         call run_tied(one, shaking(i, 300), 2.0_wp, tight(1.0_wp), response, ties)
         call run_tied(two, shaking(i, 300), 2.0_wp, tight(1.0_wp), other, others)
         call check_close(other%edp, response%edp, 0.0_wp, 'two halves', 1.0e-10_wp)
         call check_close(others(2)%plastic_elongation, ties(1)%plastic_elongation, 0.0_wp, 'set of a half', 1.0e-10_wp)
         call check_close(sum(others%energy), ties(1)%energy, 0.0_wp, 'energy of both', 1.0e-5_wp)
      end do
      three = made(three_ties([1, 2, 3]))
      two = made(three_ties([3, 1, 2]))
      do i = 1, 10
         call run_tied(three, shaking(i, 300), 3.0_wp, tight(1.0_wp), response, ties)
         call run_tied(two, shaking(i, 300), 3.0_wp, tight(1.0_wp), other, others)
         call check_close(other%edp, response%edp, 0.0_wp, 'another order', 1.0e-10_wp)
         call check_close(sum(abs(others([2, 3, 1])%energy - ties%energy)), 0.0_wp, 0.0_wp, 'energies', 1.0e-5_wp)
         call check_close(sum(abs(others([2, 3, 1])%time_of_yield - ties%time_of_yield)), 0.0_wp, 0.0_wp, 'times', 1.0e-9_wp)
         associate (peak => response%edp*three%mechanism%capacity, of => three%mechanism%restraints)
            call check(all(ties%broken .eqv. ties%time_of_fracture >= 0.0_wp), 'what is broken has a time of fracture')
            call check(all(ties%broken .eqv. peak*(1.0_wp + 1.0e-14_wp) >= of%fracture), 'what breaks')
            call check(all((ties%plastic_elongation > 0.0_wp) .eqv. ties%time_of_yield >= 0.0_wp), 'what yields')
         end associate
      end do
   end subroutine test_several

   !> Three ties: a ductile one, one with little strain, one whose anchor is weak
   function three_ties(order) result(input)
      integer, intent(in) :: order(3)
      type(wall_input_type) :: input
      real(wp), parameter :: height(3) = [8.5_wp, 5.5_wp, 3.0_wp], area(3) = [5.0e-5_wp, 8.0e-5_wp, 3.0e-5_wp]
      real(wp), parameter :: length(3) = [8.0_wp, 6.0_wp, 10.0_wp], preload(3) = [0.0_wp, 3.0e7_wp, 1.0e7_wp]
      real(wp), parameter :: strain(3) = [0.05_wp, 0.004_wp, 0.02_wp], anchor(3) = [1.0e8_wp, 1.0e8_wp, 4.0e3_wp]

      input = facade()
      call input%set('tie_height', height(order))
      call input%set('tie_area', area(order))
      call input%set('tie_length', length(order))
      call input%set('tie_preload', preload(order))
      call input%set('tie_strain', strain(order))
      call input%set('tie_anchor_force', anchor(order))
   end function three_ties

   !> A record that ends while the wall rocks, and the same with still ground after it, which is integrated
   subroutine test_after_the_record()
      real(wp), parameter :: limits(4) = [1.0_wp, 0.6_wp, 1.7_wp, 3.0_wp]
      type(wall_type) :: wall
      type(response_type) :: response, other
      type(tie_response_type), allocatable :: ties(:), others(:)
      type(record_type) :: record, longer
      type(solver_type) :: solver
      integer :: i, samples, collapses, broken, late

      call suite('after the record')
      collapses = 0
      broken = 0
      late = 0
      wall = made(three_ties([1, 2, 3]))
      do i = 1, 60
         solver = tight(limits(1 + modulo(i, 4)))
         samples = 60 + 3*modulo(7*i, 31)
         record = shaking(i, 150)
         record%acceleration = record%acceleration(:samples)
         record%acceleration(samples) = 0.0_wp
         longer = record
         longer%acceleration = [record%acceleration, spread(0.0_wp, 1, 3000)]
         call run_tied(wall, record, 3.0_wp, solver, response, ties)
         call run_tied(wall, longer, 3.0_wp, solver, other, others)
         call check(response%collapsed .eqv. other%collapsed, 'flag')
         call check_close(response%edp, other%edp, 0.0_wp, 'EDP', 1.0e-9_wp)
         call check_close(response%time_of_peak, other%time_of_peak, 0.0_wp, 'time of the peak', 1.0e-5_wp)
         call check(all(ties%broken .eqv. others%broken), 'what breaks')
         call check_close(sum(abs(ties%plastic_elongation - others%plastic_elongation)), 0.0_wp, 0.0_wp, 'sets', 1.0e-9_wp)
         call check_close(sum(abs(ties%time_of_yield - others%time_of_yield)), 0.0_wp, 0.0_wp, 'times of yield', 1.0e-7_wp)
         call check_close(sum(abs(ties%time_of_fracture - others%time_of_fracture)), 0.0_wp, 0.0_wp, 'times of fracture', &
            & 1.0e-7_wp)
         if (response%collapsed) collapses = collapses + 1
         broken = broken + count(ties%broken)
         late = late + count(ties%time_of_fracture > record%duration())
      end do
      call check(collapses > 5 .and. collapses < 55 .and. broken > 20 .and. late > 3, 'all kinds of ends')
   end subroutine test_after_the_record

   subroutine test_wrong_input()
      type(wall_input_type) :: input

      call suite('wrong input')
      input = tied()
      call input%set('tie_preload', [1.8e8_wp])
      call refuse(input, 'tie 1: its tie_preload = 180000000 must be less than its tie_strength = 180000000 Pa')
      input = tied()
      call input%set('tie_anchor_force', [1.0e3_wp])
      call refuse(input, 'tie 1: its tie_preload = 30000000 must be less than 20000000 Pa, at which its anchor gives way')
      input = tied()
      call input%set('tie_height', [0.0_wp])
      call refuse(input, 'tie 1: its tie_height = 0 must be above the hinge, 0 m, and at most 9 m, the top of the wall')
      input = tied()
      call input%set('edge_radius', 0.03_wp)
      call input%set('tie_height', [0.03_wp])
      call refuse(input, 'tie 1: its tie_height = 0.03 must be above the hinge, 0.03 m')
      input = tied()
      call input%set('tie_height', [9.5_wp])
      call refuse(input, 'tie 1: its tie_height = 9.5 must be above the hinge, 0 m, and at most 9 m')
      input = tied()
      call input%set('tie_depth', [0.6_wp])
      call refuse(input, 'tie 1: its tie_depth = 0.6 must lie between -0.1 and 0.5 m')
      input = tied()
      call input%set('tie_strain', [5.0e-4_wp])
      call refuse(input, 'tie 1: its tie_strain = 0.0005 must be more than')
      input = facade()
      call input%set('tie_area', [5.0e-5_wp])
      call refuse(input, 'tie_area: only with tie_height')
      input = tied()
      call input%clear('tie_length')
      call refuse(input, 'tie_length: must be given with tie_height')
      input = tied()
      call input%set('tie_area', [5.0e-5_wp, 5.0e-5_wp])
      call refuse(input, 'tie_area: has 2 values, must have 1 as tie_height, or one for all')
      input = tied()
      call input%set('mechanism', 'free_standing')
      call refuse(input, 'tie_height = 8.5: only for mechanism = ''one_sided'' or ''two_block''')
      input = tied()
      call input%set('tie_area', [0.0_wp])
      call refuse(input, 'tie_area: must be given with tie_height, or tie_bar and tie_spacing')
      input = tied()
      call input%set('hinge_depth', 0.2_wp)
      call input%set('tie_height', [1.0e-3_wp])
      call refuse(input, 'tie 1: its tie_height is too low for the depth of the hinge')
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

end program test_ties
