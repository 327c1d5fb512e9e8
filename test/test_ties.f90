!> Walls with ties, against independently computed values (15 digits) and against limits that need no ties.
!>
!> The facade, unless said otherwise: H = 9 m, t = 0.5 m, 1800 kg/m3; its tie, 8.5 m above the base at the outer face, of
!> 5e-5 m2/m and 8 m, 1.8e8 Pa, stressed to 3e7 Pa.
program test_ties
   use checks, only : check, check_close, check_error, check_ok, finish, suite
   use dondolo_error, only : error_type
   use dondolo_grip, only : tie_response_type
   use dondolo_kinds, only : wp
   use dondolo_normal_form, only : new_normal_form, normal_form_type
   use dondolo_record, only : record_type
   use dondolo_response, only : response_type, trace_type
   use dondolo_rest, only : new_rest, rest_type
   use dondolo_rk45, only : simulate_rk45
   use dondolo_simulate, only : check_history
   use dondolo_solver, only : solver_type
   use dondolo_tie_statics, only : greatest_acceleration, plastic_acceleration
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   use motion_inputs, only : accelerogram, stillness, tight
   implicit none

   real(wp), parameter :: exact = 1.0e-12_wp, g = 9.81_wp

   call test_statics()
   call test_histories()
   call test_energy()
   call test_limits()
   call test_several()
   call test_after_the_record()
   call test_engines()
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
      call simulate_rk45(wall%mechanism, accelerogram(a, 0.1_wp), 1.0_wp, tight(1.0_wp), response, trace, ties=ties)
   end subroutine run

   !> Time of an impact and velocity just before it
   subroutine check_impact(trace, number, time, velocity)
      type(trace_type), intent(in) :: trace
      !> Number of the impact
      integer, intent(in) :: number
      real(wp), intent(in) :: time
      !> NaN-free marker: positive where it is not known
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

   subroutine test_energy()
   end subroutine test_energy

   subroutine test_limits()
   end subroutine test_limits

   subroutine test_several()
   end subroutine test_several

   subroutine test_after_the_record()
   end subroutine test_after_the_record

   subroutine test_engines()
   end subroutine test_engines

   subroutine test_wrong_input()
   end subroutine test_wrong_input

end program test_ties
