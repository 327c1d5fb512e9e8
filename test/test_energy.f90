!> Energy along a motion, E = 1/2 J(q) q'^2 + V(q) (docs/theory.md, sections 2 and 4): constant in still ground,
!> its kinetic part multiplied by e^2 at an impact, changed by the work of the ground and by nothing else.
program test_energy
   use checks, only : check, check_close, finish, suite
   use dondolo_base_kinds, only : wp
   use dondolo_motion_dormand_prince, only : angular_acceleration, dormand_prince_step, excitation_type, state_type
   use dondolo_motion_initial_state, only : initial_state_type
   use dondolo_motion_response, only : response_type, trace_type
   use dondolo_motion_rk45, only : simulate_rk45
   use dondolo_wall, only : wall_type
   use dondolo_wall_mechanism, only : mechanism_type
   use motion_inputs, only : a_wall, accelerogram, stillness, tight
   implicit none

   call test_still_ground()
   call test_impacts()
   call test_work()
   call finish()

contains

   !> Energy above that at rest, in units of the energy that it takes to overturn
   real(wp) function energy(mechanism, q, v)
      class(mechanism_type), intent(in) :: mechanism
      real(wp), intent(in) :: q, v
      real(wp) :: j, c, g, l, load

      call mechanism%terms(abs(q), j, c, g, l, load)
      energy = (0.5_wp*j*v**2 + (mechanism%potential(abs(q)) - mechanism%potential(0.0_wp))) &
         & /(mechanism%potential(mechanism%capacity) - mechanism%potential(0.0_wp))
   end function energy

   !> Is this row of a time history the one before an impact?
   pure logical function before_impact(trace, row)
      type(trace_type), intent(in) :: trace
      integer, intent(in) :: row

      before_impact = .false.
      if (row == trace%rows) return
      before_impact = trace%after_impact(row + 1)
   end function before_impact

   !> Free rocking from 0.9 q_c: between impacts the energy stays, at an impact it falls by e^2
   subroutine test_still_ground()
      type(wall_type) :: wall
      type(response_type) :: response
      type(trace_type) :: trace
      real(wp) :: now, level, worst
      integer :: i, m, impacts

      call suite('free rocking')
      do m = 1, 4
         wall = a_wall(m)
         trace%rows = 0
         call simulate_rk45(wall%mechanism, stillness(8.0_wp), 1.0_wp, tight(1.0_wp), response, trace, &
            & initial=initial_state_type(0.9_wp*wall%mechanism%capacity))
         level = energy(wall%mechanism, trace%rotation(1), 0.0_wp)
         worst = 0.0_wp
         impacts = 0
         do i = 2, trace%rows
            now = energy(wall%mechanism, trace%rotation(i), trace%velocity(i))
            if (before_impact(trace, i - 1)) then
               impacts = impacts + 1
               level = wall%mechanism%restitution**2*level
            end if
            ! A chain of bounces that is closed leaves no energy.
            if (now == 0.0_wp) exit
            worst = max(worst, abs(now - level))
         end do
         call check(impacts >= 5, 'impacts are seen')
         call check_close(worst, 0.0_wp, 0.0_wp, 'largest change of the energy', 1.0e-11_wp)
      end do
   end subroutine test_still_ground

   !> A ground motion that makes the walls rock and impact, and not collapse
   function rattle(number, mechanism) result(a)
      integer, intent(in) :: number
      class(mechanism_type), intent(in) :: mechanism
      real(wp), parameter :: amplitude(4) = [3.3_wp, 2.2_wp, 1.32_wp, 1.21_wp]
      real(wp) :: a(600)
      integer :: i

      a = [(sin(0.13_wp*i)*cos(0.031_wp*i**1.1_wp)*exp(-((i - 250)/150.0_wp)**2), i=1, 600)]
      a = amplitude(number)*mechanism%trigger_acceleration()*a
   end function rattle

   !> Kinetic energy at the impacts of a driven motion
   subroutine test_impacts()
      type(wall_type) :: wall
      type(response_type) :: response
      type(trace_type) :: trace
      real(wp) :: before, after
      integer :: i, m, impacts

      call suite('energy at impacts')
      do m = 1, 4
         wall = a_wall(m)
         trace%rows = 0
         call simulate_rk45(wall%mechanism, accelerogram(rattle(m, wall%mechanism), 0.01_wp), 1.0_wp, tight(1.0_wp), &
            & response, trace)
         impacts = 0
         do i = 1, trace%rows - 1
            if (.not. before_impact(trace, i)) cycle
            impacts = impacts + 1
            before = energy(wall%mechanism, 0.0_wp, trace%velocity(i))
            after = energy(wall%mechanism, 0.0_wp, trace%velocity(i + 1))
            call check_close(after, wall%mechanism%restitution**2*before, 1.0e-14_wp, 'kinetic energy')
         end do
         call check(.not. response%collapsed .and. impacts > 5, 'impacts are seen')
      end do
   end subroutine test_impacts

   !> Between two rows of a driven motion the energy changes by the integral of -s L u_g'' q' dt
   subroutine test_work()
      type(wall_type) :: wall
      type(response_type) :: response
      type(trace_type) :: trace
      real(wp) :: change, work, worst, total
      integer :: i, m, intervals

      call suite('work of the ground')
      do m = 1, 4
         wall = a_wall(m)
         trace%rows = 0
         call simulate_rk45(wall%mechanism, accelerogram(rattle(m, wall%mechanism), 0.01_wp), 1.0_wp, tight(1.0_wp), &
            & response, trace)
         intervals = 0
         worst = 0.0_wp
         total = 0.0_wp
         do i = 2, trace%rows
            ! From rest the start lies inside the interval; to rest a chain of bounces takes energy.
            if (at_rest(trace, i - 1) .or. at_rest(trace, i) .or. before_impact(trace, i - 1)) cycle
            if (trace%time(i) > 5.99_wp) exit
            change = energy(wall%mechanism, trace%rotation(i), trace%velocity(i)) &
               & - energy(wall%mechanism, trace%rotation(i - 1), trace%velocity(i - 1))
            work = work_between(wall%mechanism, trace, i - 1)
            worst = max(worst, abs(change - work))
            total = total + abs(work)
            intervals = intervals + 1
         end do
         call check(.not. response%collapsed .and. intervals > 100 .and. total > 0.05_wp, 'the ground does work')
         call check_close(worst, 0.0_wp, 0.0_wp, 'largest difference to the work', 1.0e-11_wp)
      end do
   end subroutine test_work

   !> Is the wall at rest in a row?
   pure logical function at_rest(trace, row)
      type(trace_type), intent(in) :: trace
      integer, intent(in) :: row

      at_rest = trace%rotation(row) == 0.0_wp .and. trace%velocity(row) == 0.0_wp
   end function at_rest

   !> Work of the ground from one row to the next, by Gauss's rule of three points, in units of the energy that it
   !> takes to overturn
   real(wp) function work_between(mechanism, trace, row)
      class(mechanism_type), intent(in) :: mechanism
      type(trace_type), intent(in) :: trace
      integer, intent(in) :: row
      real(wp), parameter :: root = sqrt(0.15_wp)
      real(wp), parameter :: nodes(3) = 0.5_wp + [-root, 0.0_wp, root]
      real(wp), parameter :: weights(3) = [5.0_wp, 8.0_wp, 5.0_wp]/18.0_wp
      type(excitation_type) :: ground
      type(state_type) :: start, node
      real(wp) :: h, side, ignored(2), j, c, g, l, load
      integer :: k

      h = trace%time(row + 1) - trace%time(row)
      ! The side is that of the rotation; at an impact the velocity shows it.
      side = sign(1.0_wp, merge(trace%velocity(row), trace%rotation(row), trace%rotation(row) == 0.0_wp))
      ground%start = side*trace%acceleration(row)
      ground%slope = side*(trace%acceleration(row + 1) - trace%acceleration(row))/h
      start%q = abs(trace%rotation(row))
      start%v = side*trace%velocity(row)
      start%f = angular_acceleration(mechanism, ground, 0.0_wp, start%q, start%v)
      work_between = 0.0_wp
      do k = 1, 3
         call dormand_prince_step(mechanism, ground, 0.0_wp, nodes(k)*h, start, node, ignored(1), ignored(2))
         call mechanism%terms(node%q, j, c, g, l, load)
         work_between = work_between - l*(ground%start + ground%slope*nodes(k)*h)*node%v*weights(k)*h
      end do
      work_between = work_between/(mechanism%potential(mechanism%capacity) - mechanism%potential(0.0_wp))
   end function work_between

end program test_energy
