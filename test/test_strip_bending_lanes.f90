!> Walls whose joints bend, in the engine lanes: against rk45, against the closed form, and what must not change their results.
program test_strip_bending_lanes
   use checks, only : check, check_close, check_ok, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_motion_bent_part, only : bent_part_type, new_bent_part, nothing, opens, passes
   use dondolo_motion_elastic_filter, only : elastic_filter_type, new_elastic_filter
   use dondolo_motion_elastic_flow, only : bent_type, elastic_flow_type, longest_angle, new_elastic_flow
   use dondolo_motion_one_history, only : simulate_one
   use dondolo_motion_response, only : response_type
   use dondolo_motion_solver, only : solver_type
   use dondolo_motion_work, only : work_type
   use dondolo_record, only : record_type
   use dondolo_record_random, only : new_random, random_type
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   use lane_runs, only : run_alone, run_lanes, runs_in_lanes
   use motion_inputs, only : accelerogram, tight
   use random_history, only : between
   use same_response, only : is_same
   implicit none

   real(wp), parameter :: periods(4) = [0.03_wp, 0.06_wp, 0.10_wp, 0.15_wp]

   type(wall_type) :: walls(4)
   integer :: i

   do i = 1, size(walls)
      walls(i) = strip(periods(i), merge(0.0_wp, 0.05_wp, i == 2))
   end do
   call test_parts()
   call test_quiet_samples()
   call test_after_the_record()
   call test_random_records()
   call test_neighbours()
   call finish()

contains

   !> A loaded strip whose joints bend
   function strip(period, damping) result(wall)
      !> Period [s], and damping ratio
      real(wp), intent(in) :: period, damping
      type(wall_type) :: wall

      type(wall_input_type) :: input
      type(error_type), allocatable :: error

      call input%set('mechanism', 'two_block')
      call input%set('height', 2.85_wp)
      call input%set('thickness', 0.21_wp)
      call input%set('hinge', 0.72_wp)
      call input%set('overburden', 21.0e3_wp)
      call input%set('overburden_inertia', 0.0_wp)
      call input%set('elastic_period', period)
      call input%set('elastic_damping', damping)
      call new_wall(wall, input, error)
      call check_ok(error, 'a strip that bends')
   end function strip

   !> A part by its series and in closed form, with the events that follow from many points of it
   subroutine test_parts()
      type(random_type) :: random
      type(bent_part_type) :: part
      type(elastic_flow_type) :: flow
      type(bent_type) :: here, next, exact
      real(wp) :: acceleration, slope, duration, place, top, place_of_top, size_of_it
      integer :: trial, event, seen(0:2)

      call suite('parts of the closed motion')
      random = new_random(20261129, 1)
      seen = 0
      do trial = 1, 4000
         associate (joint => walls(1 + modulo(trial, 4))%mechanism%joint)
            here = bent_type(joint%opening*between(random, -1.0_wp, 1.0_wp), 4.0_wp*joint%speed*between(random, -1.0_wp, 1.0_wp))
            acceleration = between(random, -9.0_wp, 9.0_wp)
            slope = between(random, -900.0_wp, 900.0_wp)
            duration = longest_angle/joint%frequency*between(random, 0.01_wp, 1.0_wp)
            part = new_bent_part(joint, here, acceleration, slope, duration)
            flow = new_elastic_flow(joint, here, acceleration, slope)
            call part%find_first(joint, here, next, event, place, top, place_of_top)
            seen(event) = seen(event) + 1
            exact = flow%at(place*duration)
            size_of_it = abs(here%x) + abs(here%v)/joint%frequency + joint%lever*(abs(acceleration) &
               & + abs(slope)*duration)/joint%frequency**2
            call check(abs(next%x - exact%x) <= 1.0e-12_wp*size_of_it, 'rotation')
            call check(abs(next%v - exact%v) <= 1.0e-12_wp*size_of_it*joint%frequency, 'velocity')
            select case (event)
            case (opens)
               call check(abs(next%x) == joint%opening .and. next%x*next%v >= 0.0_wp, 'outwards through q_y')
            case (passes)
               call check(.not. abs(next%x) > 0.0_wp .and. abs(next%v) > joint%speed, 'fast through 0')
            case (nothing)
               call check(place == 1.0_wp .and. abs(next%x) < joint%opening, 'nothing up to the end')
            end select
            call check(highest(flow, place*duration) <= max(top, joint%opening)*(1.0_wp + 1.0e-9_wp), 'nothing is missed')
            if (top > 0.0_wp) then
               exact = flow%at(place_of_top*duration)
               call check(abs(exact%v) <= 1.0e-11_wp*size_of_it*joint%frequency, 'the turn')
               call check(abs(top - abs(exact%x)) <= 1.0e-12_wp*size_of_it, 'its rotation')
            end if
         end associate
      end do
      call check(all(seen > 300), 'all that may happen')
   end subroutine test_parts

   !> Largest |x| at many points of a motion
   real(wp) function highest(flow, duration)
      type(elastic_flow_type), intent(in) :: flow
      !> How long it lasts [s]
      real(wp), intent(in) :: duration

      type(bent_type) :: state
      integer :: k

      highest = 0.0_wp
      do k = 1, 40
         state = flow%at(duration*real(k, wp)/40.0_wp)
         highest = max(highest, abs(state%x))
      end do
   end function highest

   !> A sample interval that is said to be quiet is: the joints stay closed, and no passage is fast
   subroutine test_quiet_samples()
      type(random_type) :: random
      type(elastic_filter_type) :: filter
      type(elastic_flow_type) :: flow
      type(record_type) :: record
      type(bent_type) :: here, next, then, before
      real(wp) :: dt, ground(2)
      integer :: trial, k, quiet
      logical :: is_quiet, is_fast

      call suite('quiet samples')
      random = new_random(20261129, 2)
      quiet = 0
      record = accelerogram([0.0_wp, 1.0_wp, 0.0_wp], 0.005_wp)
      do trial = 1, 8000
         associate (joint => walls(1 + modulo(trial, 4))%mechanism%joint)
            dt = merge(0.005_wp, 0.01_wp, modulo(trial, 8) < 4)
            record%dt = dt
            filter = new_elastic_filter(joint, record)
            here = bent_type(joint%opening*between(random, -1.0_wp, 1.0_wp), 1.3_wp*joint%speed*between(random, -1.0_wp, 1.0_wp))
            ground = [between(random, -9.0_wp, 9.0_wp), between(random, -9.0_wp, 9.0_wp)]
            call filter%look_ahead(here, ground(1), ground(2), next, is_quiet)
            if (.not. is_quiet) cycle
            quiet = quiet + 1
            flow = new_elastic_flow(joint, here, ground(1), (ground(2) - ground(1))/dt)
            before = here
            is_fast = .false.
            do k = 1, 200
               then = flow%at(dt*real(k, wp)/200.0_wp)
               is_fast = is_fast .or. (before%x*then%x < 0.0_wp .and. abs(then%v) > 1.001_wp*joint%speed)
               before = then
            end do
            call check(highest(flow, dt) < joint%opening, 'the joints stay closed')
            call check(.not. is_fast, 'slow through 0')
            call check(abs(next%x - then%x) <= 1.0e-12_wp*joint%opening, 'the state at its end')
         end associate
      end do
      call check(quiet > 800 .and. quiet < 7200, to_text(quiet)//' of 8000 are quiet')
   end subroutine test_quiet_samples

   !> Records that end in motion of every kind: the peak by energy, and by the steps of rk45
   subroutine test_after_the_record()
      real(wp), parameter :: a(7) = [0.0_wp, -1.0_wp, -2.0_wp, -2.5_wp, 0.5_wp, 2.0_wp, 0.0_wp]
      type(response_type) :: stepped, closed
      type(record_type) :: record
      integer :: m, k, collapses, later

      call suite('after the record')
      record = accelerogram(a, 0.04_wp)
      do m = 1, size(walls)
         collapses = 0
         later = 0
         do k = 1, 40
            call run_alone(walls(m)%mechanism, record, 0.4_wp*real(k, wp), tight(1.0_wp), closed)
            call simulate_one(walls(m)%mechanism, record, 0.4_wp*real(k, wp), tight(1.0_wp), stepped)
            call check(closed%collapsed .eqv. stepped%collapsed, 'same flag')
            call check_close(closed%edp, stepped%edp, 1.0e-9_wp, 'peak')
            call check_close(closed%time_of_peak, stepped%time_of_peak, 1.0e-7_wp, 'time of the peak')
            call check(closed%impacts == stepped%impacts, 'passages')
            if (closed%collapsed) collapses = collapses + 1
            if (closed%time_of_peak > record%duration()) later = later + 1
         end do
         call check(collapses > 0 .and. collapses < 40 .and. later > 4, &
            & to_text(collapses)//' collapse, '//to_text(later)//' have a later peak')
      end do
   end subroutine test_after_the_record

   !> Noise, whose steps both engines take at tight tolerances
   subroutine test_random_records()
      type(random_type) :: random
      type(response_type) :: stepped, closed
      real(wp) :: a(161)
      integer :: m, k, n, near, opened

      call suite('random records')
      random = new_random(20261129, 3)
      near = 0
      opened = 0
      do m = 1, size(walls)
         call check(runs_in_lanes(walls(m)%mechanism, tight(1.0_wp)), 'in lanes')
         do k = 1, 60
            do n = 1, size(a)
               a(n) = between(random, -1.0_wp, 1.0_wp)
            end do
            call run_alone(walls(m)%mechanism, accelerogram(a, 0.02_wp), 0.3_wp*real(k, wp), tight(1.0_wp), closed)
            call simulate_one(walls(m)%mechanism, accelerogram(a, 0.02_wp), 0.3_wp*real(k, wp), tight(1.0_wp), stepped)
            call check(closed%collapsed .eqv. stepped%collapsed, 'same flag')
            if (abs(closed%edp - stepped%edp) <= 1.0e-7_wp*stepped%edp) near = near + 1
            if (closed%edp > walls(m)%mechanism%joint%opening/walls(m)%mechanism%capacity) opened = opened + 1
         end do
      end do
      call check(near >= 238, to_text(near)//' of 240 within 1e-7')
      call check(opened > 100 .and. opened < 240, to_text(opened)//' open')
   end subroutine test_random_records

   !> Many histories at once, on several threads and alone; collapses alone; the mirror image
   subroutine test_neighbours()
      type(random_type) :: random
      type(record_type) :: records(3)
      type(response_type), allocatable :: one(:), many(:), mirrored(:), flags(:)
      type(response_type) :: alone
      type(solver_type) :: solver, fast
      type(work_type) :: work
      real(wp) :: a(400), scale(120)
      integer :: record(120), k, n

      call suite('neighbours')
      random = new_random(20261129, 4)
      do k = 1, size(records)
         do n = 1, size(a)
            a(n) = between(random, -1.0_wp, 1.0_wp)
         end do
         records(k) = accelerogram(a, 0.01_wp)
      end do
      record = [(1 + modulo(k, 3), k=1, size(record))]
      scale = [(0.3_wp*real(k, wp), k=1, size(scale))]
      fast = solver
      fast%collapses_only = .true.
      associate (mechanism => walls(3)%mechanism)
         call run_lanes(mechanism, records, record, scale, solver, one, work, 1)
         call run_lanes(mechanism, records, record, scale, solver, many, threads=3)
         call run_lanes(mechanism, records, record, -scale, solver, mirrored)
         call run_lanes(mechanism, records, record, scale, fast, flags)
         call check(all(is_same(one, many)), 'threads')
         call check(all(is_same(one, mirrored)), 'the mirror image')
         call check(all(one%collapsed .eqv. flags%collapsed), 'collapses alone')
         call check(work%in_lanes == size(one), 'all in lanes')
         call check(work%still == count(one%edp < mechanism%joint%opening/mechanism%capacity), 'those that never open')
         do k = 1, size(record), 7
            call run_alone(mechanism, records(record(k)), scale(k), solver, alone)
            call check(is_same(alone, one(k)), 'alone')
         end do
      end associate
   end subroutine test_neighbours

end program test_strip_bending_lanes
