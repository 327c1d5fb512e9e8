!> After the record: the closed form of free motion against stepping on (docs/theory.md, section 4).
program test_tail
   use checks, only : check, check_close, check_ok, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_motion_adaptive_step, only : advance, motion_type
   use dondolo_motion_dormand_prince, only : angular_acceleration, excitation_type
   use dondolo_motion_events, only : impact, limit_reached
   use dondolo_motion_response, only : response_type
   use dondolo_motion_restrained_tail, only : restrained_motion
   use dondolo_motion_restraint_state, only : restraint_state_type
   use dondolo_motion_rk45, only : simulate_rk45
   use dondolo_motion_tail, only : free_motion, tail_type
   use dondolo_motion_wall_constants, only : new_wall_constants, wall_constants_type
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   use dondolo_wall_mechanism, only : mechanism_type
   use motion_inputs, only : a_wall, accelerogram, tight
   implicit none

   !> Limits / capacity
   real(wp), parameter :: limits(4) = [0.5_wp, 1.0_wp, 1.5_wp, 2.5_wp]

   call test_records()
   call test_states()
   call test_next_to_the_turn()
   call finish()

contains

   !> Records that end with motion of every kind, against the same with still ground after them
   subroutine test_records()
      real(wp), parameter :: a(6) = [0.0_wp, -1.0_wp, -2.0_wp, -2.5_wp, -1.0_wp, 0.0_wp]
      type(wall_type) :: wall
      type(response_type) :: stepped, closed
      real(wp) :: factor
      integer :: i, k, m, collapses

      call suite('after the record')
      do m = 1, 4
         wall = a_wall(m)
         do k = 1, size(limits)
            collapses = 0
            do i = 1, 20
               factor = 0.5_wp*real(i, wp)*wall%mechanism%trigger_acceleration()
               call simulate_rk45(wall%mechanism, accelerogram(a, 0.05_wp), factor, tight(limits(k)), closed)
               call simulate_rk45(wall%mechanism, accelerogram([a, spread(0.0_wp, 1, 400)], 0.05_wp), factor, &
                  & tight(limits(k)), stepped)
               call check(closed%collapsed .eqv. stepped%collapsed, 'same flag')
               call check_close(closed%edp, stepped%edp, 1.0e-10_wp, 'peak')
               call check_close(closed%time_of_peak, stepped%time_of_peak, 1.0e-8_wp, 'time of the peak')
               if (closed%collapsed) collapses = collapses + 1
            end do
            call check(collapses > 0 .and. collapses < 20, 'some collapse, some do not')
         end do
      end do
   end subroutine test_records

   !> Every state that a record can end in: within and beyond the capacity, moving out, in, and not at all
   subroutine test_states()
      real(wp), parameter :: places(7) = [0.0_wp, 0.1_wp, 0.35_wp, 0.6_wp, 0.8_wp, 0.95_wp, 0.999_wp]
      real(wp), parameter :: speeds(9) = [-3.0_wp, -1.1_wp, -0.7_wp, -0.23_wp, 0.0_wp, 0.12_wp, 0.5_wp, 0.9_wp, 1.7_wp]
      type(wall_type) :: wall
      type(tail_type) :: closed, stepped, again
      real(wp) :: q, v
      integer :: i, j, k, m, beyond

      call suite('free motion')
      beyond = 0
      do m = 1, 4
         wall = a_wall(m)
         associate (mechanism => wall%mechanism)
            do k = 1, size(limits)
               do i = 1, size(places)
                  do j = 1, size(speeds)
                     q = places(i)*limits(k)*mechanism%capacity
                     v = speeds(j)*mechanism%frequency_parameter()*mechanism%capacity
                     if (q == 0.0_wp .and. v <= 0.0_wp) cycle
                     call free_motion(mechanism, limits(k)*mechanism%capacity, 0.0_wp, q, v, mechanism%restitution, closed)
                     call step_on(mechanism, limits(k)*mechanism%capacity, q, v, stepped)
                     call check(closed%collapsed .eqv. stepped%collapsed, 'same flag')
                     call check_close(closed%peak, stepped%peak, 1.0e-9_wp, 'peak')
                     call check_close(closed%delay, stepped%delay, 1.0e-8_wp, 'time of the peak')
                     if (q > mechanism%capacity .and. .not. closed%collapsed) beyond = beyond + 1
                     ! A rotation that was reached before hides a lower peak, and nothing else.
                     call free_motion(mechanism, limits(k)*mechanism%capacity, 0.999_wp*closed%peak, q, v, &
                        & mechanism%restitution, again)
                     call check(again%peak == closed%peak .and. again%delay == closed%delay, 'a new peak')
                     call free_motion(mechanism, limits(k)*mechanism%capacity, 1.001_wp*closed%peak, q, v, &
                        & mechanism%restitution, again)
                     call check(again%collapsed .eqv. closed%collapsed, 'same flag whatever was reached before')
                     call check(again%peak == merge(closed%peak, 0.0_wp, closed%collapsed), 'no new peak')
                  end do
               end do
            end do
         end associate
      end do
      call check(beyond > 0, 'walls come back from beyond their capacity')
   end subroutine test_states

   !> A record that ends as the wall all but stands still, moving outwards: the peak follows after v/|q''|, for walls with and
   !> without ties. The kinetic energy is far below the rounding of the potential of a whole wall
   subroutine test_next_to_the_turn()
      real(wp), parameter :: places(3) = [0.05_wp, 0.3_wp, 0.7_wp]
      type(wall_type) :: wall
      type(wall_input_type) :: input
      type(error_type), allocatable :: error
      class(mechanism_type), allocatable :: held
      type(restraint_state_type) :: restraints
      type(tail_type) :: tail
      real(wp) :: q, v, f
      integer :: i, k, m

      call suite('next to the turn')
      do m = 1, 5
         if (m < 5) then
            wall = a_wall(m)
         else
            call input%set('mechanism', 'one_sided')
            call input%set('height', 3.0_wp)
            call input%set('thickness', 0.25_wp)
            call input%set('tie_height', [2.0_wp])
            call input%set('tie_depth', [0.25_wp])
            call input%set('tie_area', [5.0e-6_wp])
            call input%set('tie_length', [2.0_wp])
            call new_wall(wall, input, error)
            call check_ok(error, 'wall with a tie')
         end if
         do i = 1, size(places)
            do k = 4, 10
               q = places(i)*wall%mechanism%capacity
               v = 10.0_wp**(-k)*wall%mechanism%frequency_parameter()*wall%mechanism%capacity
               allocate (held, source=wall%mechanism)
               if (m < 5) then
                  call free_motion(held, held%capacity, 0.0_wp, q, v, held%restitution, tail)
               else
                  restraints = restraint_state_type()
                  call restraints%begin(held, 0.0_wp)
                  call restraints%cross(held, q, .true., 0.0_wp)
                  call restrained_motion(held, restraints, held%capacity, q, v, 0.0_wp, tail)
               end if
               f = angular_acceleration(held, excitation_type(), 0.0_wp, q, 0.0_wp)
               call check(.not. tail%collapsed, 'it turns')
               call check(abs(tail%delay + v/f) <= 1.0e-11_wp + 10.0_wp**(-k)*abs(v/f)*20.0_wp, 'time of the turn')
               deallocate (held)
            end do
         end do
      end do
   end subroutine test_next_to_the_turn

   !> Free motion step by step, until the limit, or the turn after which every rotation is lower
   subroutine step_on(mechanism, limit, q, v, tail)
      class(mechanism_type), intent(in) :: mechanism
      real(wp), intent(in) :: limit, q, v
      type(tail_type), intent(out) :: tail
      real(wp), parameter :: dt = 0.02_wp
      integer, parameter :: most_samples = 10000
      type(wall_constants_type) :: constants
      type(motion_type) :: motion
      logical :: sample_reached, outwards
      integer :: event, sample

      constants = new_wall_constants(mechanism, tight(1.0_wp))
      constants%limit = limit
      motion%q = q
      motion%v = v
      motion%f = angular_acceleration(mechanism, motion%excitation, 0.0_wp, q, v)
      motion%step = dt
      sample = 0
      do while (sample < most_samples)
         outwards = motion%v > 0.0_wp
         call advance(mechanism, constants, dt, motion, event, sample_reached)
         if (event == limit_reached .or. (outwards .and. motion%v <= 0.0_wp)) exit
         if (event == impact) then
            motion%v = -mechanism%restitution*motion%v
            motion%f = angular_acceleration(mechanism, motion%excitation, motion%time, motion%q, motion%v)
         end if
         if (.not. sample_reached) cycle
         sample = sample + 1
         motion%time = 0.0_wp
      end do
      call check(sample < most_samples, 'the motion ends')
      tail%collapsed = event == limit_reached
      tail%peak = motion%q
      tail%delay = sample*dt + motion%time
   end subroutine step_on

end program test_tail
