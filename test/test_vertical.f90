!> Vertical ground motion: independently computed values, a ground that makes gravity another, both engines, reading.
!>
!> The first swings of walls with loads under both components are in test_loaded_block.
program test_vertical
   use checks, only : check, check_close, check_error, check_ok, finish, suite
   use dondolo_base_error, only : error_type, problems_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_settings, only : group_settings_type, new_settings
   use dondolo_base_settings_check, only : check_settings
   use dondolo_building, only : building_type
   use dondolo_building_floor_motion, only : filter_record
   use dondolo_building_input, only : building_properties, new_building
   use dondolo_motion_response, only : response_type, trace_type
   use dondolo_motion_rest, only : new_rest, rest_type
   use dondolo_motion_rk45, only : simulate_rk45
   use dondolo_motion_solver, only : solver_type
   use dondolo_record, only : record_type
   use dondolo_record_set, only : new_record_set, record_set_type
   use dondolo_records_catalogue, only : read_catalogue
   use dondolo_wall, only : new_wall, wall_type
   use lane_runs, only : run_alone
   use motion_inputs, only : a_wall, accelerogram, made, tight
   implicit none

   real(wp), parameter :: exact = 1.0e-12_wp, g = 9.81_wp
   character(len=*), parameter :: lf = new_line('a'), scratch = 'out/test_vertical'

   call test_vertical_alone()
   call test_other_gravity()
   call test_polarity()
   call test_no_vertical()
   call test_search()
   call test_floor()
   call test_record()
   call test_two_steps()
   call test_catalogue()
   call finish()

contains

   !> Samples that look random, from -1 to 1
   pure function noise(n, seed) result(values)
      integer, intent(in) :: n, seed
      real(wp) :: values(n)

      integer :: i
      real(wp) :: x

      x = 0.1_wp + 0.01_wp*real(seed, wp)
      do i = 1, n
         x = 3.99_wp*x*(1.0_wp - x)
         values(i) = 2.0_wp*x - 1.0_wp
      end do
   end function noise

   !> A push too weak by itself: the wall starts as the ground falls
   subroutine test_vertical_alone()
      real(wp), parameter :: impacts(2) = [0.221024249655773_wp, 0.275384885216691_wp]
      type(wall_type) :: wall
      type(record_type) :: record
      type(response_type) :: response
      type(trace_type) :: trace
      type(rest_type) :: rest
      real(wp) :: begin, side
      integer :: first
      logical :: found

      call suite('vertical motion alone')
      wall = made('one_sided', 3.0_wp, 0.25_wp)
      record = accelerogram(spread(-0.7_wp, 1, 4), 0.1_wp)
      call simulate_rk45(wall%mechanism, record, 1.0_wp, tight(1.0_wp), response)
      call check(.not. response%edp > 0.0_wp, 'no motion without it')
      record%vertical = [0.0_wp, -3.0_wp, 3.0_wp, 0.0_wp]
      rest = new_rest(wall%mechanism)
      first = 1
      begin = 0.0_wp
      call rest%next_start(record, 1.0_wp, first, begin, side, found)
      call check(found .and. first == 1 .and. side > 0.0_wp, 'it starts')
      call check_close(begin, 0.047_wp, exact, 'start')
      call simulate_rk45(wall%mechanism, record, 1.0_wp, tight(1.0_wp), response, trace)
      call check_close(response%edp*wall%mechanism%capacity, 0.000173546350007885_wp, 0.0_wp, 'peak', exact)
      call check_close(response%time_of_peak, 0.172752597367923_wp, exact, 'turn')
      call check_close(maxval(abs(pack(trace%time, trace%after_impact .and. trace%time < 0.3_wp) - impacts)), 0.0_wp, 0.0_wp, &
         & 'impacts', exact)
      call run_alone(wall%mechanism, record, 1.0_wp, tight(1.0_wp), response)
      call check_close(response%edp*wall%mechanism%capacity, 0.000173546350007885_wp, 0.0_wp, 'peak, lanes', exact)
      call check_close(response%time_of_peak, 0.172752597367923_wp, exact, 'turn, lanes')
   end subroutine test_vertical_alone

   !> Ground that accelerates upwards for good is another gravity, for every mechanism
   subroutine test_other_gravity()
      real(wp), parameter :: up(3) = [3.0_wp, -4.0_wp, -8.0_wp]
      type(wall_type) :: wall, heavier
      type(record_type) :: record
      type(response_type) :: expected, response
      type(error_type), allocatable :: error
      real(wp) :: a(600)
      integer :: i, k, seed, moved

      call suite('another gravity')
      moved = 0
      do i = 1, 3
         wall = a_wall(i)
         do k = 1, size(up)
            call new_wall(heavier, wall%input, error, gravity=g + up(k))
            call check_ok(error, 'wall')
            do seed = 1, 4
               ! It ends at rest, since the ground after the record has gravity as it is.
               a = 0.0_wp
               a(:150) = 2.0_wp*real(seed, wp)*noise(150, seed)*heavier%mechanism%trigger_acceleration()
               record = accelerogram(a, 0.02_wp)
               call simulate_rk45(heavier%mechanism, record, 1.0_wp, tight(1.0_wp), expected)
               if (expected%edp > 0.0_wp) moved = moved + 1
               record%vertical = spread(up(k), 1, size(a))
               call simulate_rk45(wall%mechanism, record, 1.0_wp, tight(1.0_wp), response)
               call check_close(response%edp, expected%edp, 0.0_wp, 'rk45', 1.0e-9_wp)
               call check(response%impacts == expected%impacts, 'rk45: impacts')
               call run_alone(wall%mechanism, record, 1.0_wp, tight(1.0_wp), response)
               call check_close(response%edp, expected%edp, 0.0_wp, 'lanes', 1.0e-9_wp)
               call check(response%impacts == expected%impacts, 'lanes: impacts')
            end do
         end do
      end do
      call check(moved > 30, 'most of them move')
   end subroutine test_other_gravity

   !> The polarity of a record is that of its horizontal component
   subroutine test_polarity()
      type(wall_type) :: wall
      type(record_type) :: record
      type(response_type) :: response, reversed
      integer :: engine

      call suite('polarity')
      wall = a_wall(2)
      record = accelerogram([0.0_wp, 4.0_wp*noise(300, 5), 0.0_wp], 0.02_wp)
      record%vertical = [0.0_wp, 3.0_wp*noise(300, 6), 0.0_wp]
      do engine = 1, 2
         if (engine == 1) then
            call simulate_rk45(wall%mechanism, record, 1.0_wp, tight(1.0_wp), response)
            call simulate_rk45(wall%mechanism, record, -1.0_wp, tight(1.0_wp), reversed)
         else
            call run_alone(wall%mechanism, record, 1.0_wp, tight(1.0_wp), response)
            call run_alone(wall%mechanism, record, -1.0_wp, tight(1.0_wp), reversed)
         end if
         call check(response%edp > 0.01_wp, 'it rocks')
         call check_close(reversed%edp, response%edp, 1.0e-13_wp, 'a symmetric wall sees no polarity')
         record%vertical = -record%vertical
         call simulate_rk45(wall%mechanism, record, 1.0_wp, tight(1.0_wp), reversed)
         call check(abs(reversed%edp - response%edp) > 1.0e-3_wp, 'but the sign of the vertical component')
         record%vertical = -record%vertical
      end do
   end subroutine test_polarity

   !> A vertical component of zeros changes no bit of rk45, and lanes by rounding
   subroutine test_no_vertical()
      type(wall_type) :: wall
      type(record_type) :: record
      type(response_type) :: without, with
      integer :: i

      call suite('none')
      do i = 1, 5
         wall = a_wall(i)
         record = accelerogram([0.0_wp, 2.0_wp*wall%mechanism%trigger_acceleration()*noise(300, i)], 0.02_wp)
         call simulate_rk45(wall%mechanism, record, 1.0_wp, tight(1.0_wp), without)
         record%vertical = spread(0.0_wp, 1, 301)
         call simulate_rk45(wall%mechanism, record, 1.0_wp, tight(1.0_wp), with)
         call check_close(with%edp, without%edp, 0.0_wp, 'rk45')
         call check_close(with%time_of_peak, without%time_of_peak, 0.0_wp, 'rk45: time')
         call run_alone(wall%mechanism, record, 1.0_wp, tight(1.0_wp), with)
         call check_close(with%edp, without%edp, 0.0_wp, 'lanes', 1.0e-9_wp)
      end do
   end subroutine test_no_vertical

   !> The search by blocks finds the sample that a look at each finds
   subroutine test_search()
      integer, parameter :: n = 500
      type(record_set_type) :: set
      type(record_type) :: records(2)
      real(wp) :: limit(n), scale
      integer :: k, first, found, expected
      logical :: both_sides

      call suite('search')
      records(1) = accelerogram(noise(n, 1)**3, 0.01_wp)
      records(2) = accelerogram(noise(n, 2)**3, 0.01_wp)
      records(2)%vertical = 2.0_wp*noise(n, 3)**5
      call new_record_set(set, records)
      do k = 1, 40
         scale = 0.1_wp*real(k, wp)*merge(-1.0_wp, 1.0_wp, modulo(k, 2) == 0)
         both_sides = modulo(k, 3) == 0
         first = 1 + modulo(37*k, n)
         limit = 2.0_wp + 0.7_wp*abs(scale)*records(2)%vertical
         found = set%next_outside_of_both(2, first, scale, 2.0_wp, 0.7_wp, both_sides)
         associate (a => scale*records(2)%acceleration)
            expected = findloc(a(first:) < -limit(first:) .or. (both_sides .and. a(first:) > limit(first:)), .true., dim=1)
         end associate
         if (expected == 0) expected = n + 2 - first
         call check(found == first - 1 + expected, 'the next sample')
      end do
      call check(.not. any(abs(set%verticals(:n + 2)) > 0.0_wp), 'a record without vertical component has zeros')
   end subroutine test_search

   !> A building is rigid vertically
   subroutine test_floor()
      type(group_settings_type) :: settings
      type(building_type) :: building
      type(problems_type) :: problems
      type(record_type) :: ground, floor
      type(error_type), allocatable :: error

      call suite('floor')
      call new_settings(settings, building_properties)
      call settings%set('period', [0.2_wp])
      call settings%set('participation', [1.2_wp])
      call settings%set('refine', 4)
      call check_settings(settings, problems)
      call new_building(building, settings, problems)
      ground = accelerogram([0.0_wp, 1.0_wp, -1.0_wp, 0.5_wp], 0.05_wp)
      ground%vertical = [1.0_wp, 3.0_wp, -2.0_wp, 4.0_wp]
      call filter_record(building, ground, floor, error)
      call check_ok(error, 'floor')
      call check(size(floor%vertical) == size(floor%acceleration), 'as long')
      call check_close(maxval(abs(floor%vertical(1:13:4) - ground%vertical)), 0.0_wp, 0.0_wp, 'samples', 4.0_wp*epsilon(g))
      call check_close(floor%vertical(3), 2.0_wp, exact, 'between two samples')
      call check(.not. any(abs(floor%vertical(14:)) > 0.0_wp), 'still ground afterwards')
   end subroutine test_floor

   !> What a vertical component must be
   subroutine test_record()
      type(record_type) :: record
      type(error_type), allocatable :: error

      call suite('record')
      record = accelerogram([0.0_wp, 1.0_wp, -1.0_wp], 0.01_wp)
      call check_close(record%vertical_at(1, 0.005_wp), 0.0_wp, 0.0_wp, 'none')
      call check_close(record%largest_fall(), 0.0_wp, 0.0_wp, 'no fall')
      call record%set_vertical([1.0_wp, 2.0_wp], 0.01_wp, 1.0_wp, error)
      call check_error(error, 'vertical: has 2 samples, must have 3 as the record', 'length')
      call record%set_vertical([1.0_wp, 2.0_wp, 3.0_wp], 0.02_wp, 1.0_wp, error)
      call check_error(error, 'vertical: lasts 0.04 s, must last 0.02 s as the record, or by less than a step', 'duration')
      call record%set_vertical([1.0_wp, 2.0_wp, 3.0_wp], 0.01001_wp, 1.0_wp, error)
      call check_error(error, 'vertical: has a time step of 0.01001 s, whose ratio to 0.01 s of the record must be', 'steps')
      call record%set_vertical([1.0_wp, 2000.0_wp, 3.0_wp], 0.01_wp, 10.0_wp, error)
      call check_error(error, 'vertical: sample 2 = 20000 m/s2: must be a number between', 'size')
      call record%set_vertical([1.0_wp, 2.0_wp, -3.0_wp], 0.01_wp, 2.0_wp, error)
      call check_ok(error, 'vertical')
      call check_close(record%vertical_at(2, 0.0025_wp), 1.5_wp, exact, 'linear between samples')
      call check_close(record%vertical_at(3, 0.0_wp), 0.0_wp, 0.0_wp, 'still after the last')
      call check_close(record%largest_fall(), 6.0_wp, 0.0_wp, 'fall')
   end subroutine test_record

   !> Components of different steps: on the grid of both each is the function of time that it was
   subroutine test_two_steps()
      type(record_type) :: record, coarse
      type(error_type), allocatable :: error
      type(response_type) :: joined, same
      type(wall_type) :: wall
      real(wp), parameter :: steps(4) = [0.005_wp, 0.02_wp, 0.004_wp, 0.015_wp]
      real(wp), allocatable :: a(:), v(:)
      real(wp) :: time, worst
      integer :: i, k, n

      call suite('components of different steps')
      wall = made('free_standing', 3.0_wp, 0.25_wp)
      a = [(3.0_wp*sin(0.7_wp*i) - 4.0_wp*exp(-0.1_wp*(i - 12)**2), i=0, 60)]
      do k = 1, size(steps)
         record = accelerogram(a, 0.01_wp)
         n = nint(0.6_wp/steps(k)) + 1
         v = [(2.0_wp*cos(1.1_wp*i), i=1, n)]
         call record%set_vertical(v, steps(k), -0.5_wp, error)
         call check_ok(error, 'other step')
         call check_close(record%duration(), 0.6_wp, exact, 'as long as before')
         worst = 0.0_wp
         do i = 1, size(record%acceleration)
            time = real(i - 1, wp)*record%dt
            worst = max(worst, abs(record%acceleration(i) - at(a, 0.01_wp, time)), abs(record%vertical(i) + &
               & 0.5_wp*at(v, steps(k), time)))
         end do
         call check_close(worst, 0.0_wp, 0.0_wp, 'the same functions of time', 1.0e-12_wp)
         call check(all(record%acceleration(:size(record%acceleration):nint(0.01_wp/record%dt)) <= a) .and. &
            & all(record%acceleration(:size(record%acceleration):nint(0.01_wp/record%dt)) >= a), 'samples stay, to the bit')
         ! The vertical component resampled by hand
         coarse = accelerogram(record%acceleration, record%dt)
         call coarse%set_vertical([(-0.5_wp*at(v, steps(k), real(i, wp)*record%dt), i=0, size(record%acceleration) - 1)], &
            & record%dt, 1.0_wp, error)
         call check_ok(error, 'by hand')
         call simulate_rk45(wall%mechanism, coarse, 1.0_wp, solver_type(), same)
         call simulate_rk45(wall%mechanism, record, 1.0_wp, solver_type(), joined)
         call check(joined%edp > 1.0e-3_wp, 'it moves')
         call check_close(joined%edp, same%edp, 1.0e-9_wp, 'EDP')
      end do
      ! A vertical component on half the step does not change a horizontal motion but by the errors of steps
      record = accelerogram(a, 0.01_wp)
      call simulate_rk45(wall%mechanism, record, 1.0_wp, solver_type(rtol=1.0e-13_wp, atol=1.0e-15_wp), same)
      call record%set_vertical([(0.0_wp, i=0, 120)], 0.005_wp, 1.0_wp, error)
      call check_ok(error, 'half the step')
      call simulate_rk45(wall%mechanism, record, 1.0_wp, solver_type(rtol=1.0e-13_wp, atol=1.0e-15_wp), joined)
      call check_close(joined%edp, same%edp, 1.0e-10_wp, 'EDP without vertical motion')
      ! It ends before the record, by less than a step of its own, and is still afterwards; or after it
      record = accelerogram([0.0_wp, 1.0_wp, 2.0_wp, 3.0_wp], 0.01_wp)
      call record%set_vertical([1.0_wp, 3.0_wp], 0.02_wp, 1.0_wp, error)
      call check_ok(error, 'shorter')
      call check_close(maxval(abs(record%vertical - [1.0_wp, 2.0_wp, 3.0_wp, 0.0_wp])), 0.0_wp, 0.0_wp, 'still afterwards')
      call record%set_vertical([1.0_wp, 3.0_wp, 5.0_wp], 0.02_wp, 1.0_wp, error)
      call check_ok(error, 'longer')
      call check_close(maxval(abs(record%vertical - [1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp])), 0.0_wp, 0.0_wp, 'cut')
   end subroutine test_two_steps

   !> A function that is linear between its samples
   real(wp) function at(samples, dt, time)
      real(wp), intent(in) :: samples(:), dt, time
      integer :: i

      i = min(1 + int(time/dt*(1.0_wp + epsilon(dt))), size(samples) - 1)
      at = samples(i) + (samples(i + 1) - samples(i))*(time/dt - real(i - 1, wp))
   end function at

   !> The column vertical of a catalogue
   subroutine test_catalogue()
      type(record_type), allocatable :: records(:)
      type(error_type), allocatable :: error

      call suite('catalogue')
      call execute_command_line('mkdir -p '//scratch)
      call write_file('a.txt', '1'//lf//'2'//lf//'3'//lf)
      call write_file('up.txt', '4'//lf//'5'//lf//'-6'//lf)
      call write_file('short.txt', '4'//lf//'5'//lf)
      call write_file('channels.csv', 'time,NS,UD'//lf//'0,1,7'//lf//'0.01,2,8'//lf//'0.02,3,9'//lf)
      call write_file('all.csv', 'file,dt_s,units,channel,vertical,columns'//lf//'a.txt,.01,m/s2,,up.txt,'//lf// &
         & 'channels.csv,,m/s2,NS,UD,"time,acceleration,acceleration"'//lf)
      call read_catalogue(scratch//'/all.csv', records, error)
      call check_ok(error, 'left out')
      if (allocated(error)) return
      call check(.not. allocated(records(1)%vertical), 'left out')
      call read_catalogue(scratch//'/all.csv', records, error, vertical_factor=-2.0_wp)
      call check_ok(error, 'files and channels')
      if (allocated(error)) return
      call check_close(maxval(abs(records(1)%vertical - [-8.0_wp, -10.0_wp, 12.0_wp])), 0.0_wp, 0.0_wp, 'a file')
      call check_close(maxval(abs(records(2)%vertical - [-14.0_wp, -16.0_wp, -18.0_wp])), 0.0_wp, 0.0_wp, 'a channel')
      call check(records(1)%metadata%get('vertical') == '', 'no metadata')
      call refuse('file,dt_s,units'//lf//'a.txt,.01,g'//lf, 'bad.csv: no column ''vertical''')
      call refuse('file,dt_s,units,vertical'//lf//'a.txt,.01,g,'//lf, 'line 2: vertical is empty')
      call refuse('file,dt_s,units,vertical'//lf//'a.txt,.01,g,none.txt'//lf, 'line 2: '//scratch//'/none.txt: no such')
      call refuse('file,dt_s,units,vertical'//lf//'a.txt,.01,g,short.txt'//lf, &
         & 'line 2: vertical: has 2 samples, must have 3 as the record')
      call refuse('file,dt_s,units,channel,vertical,columns'//lf// &
         & 'channels.csv,,g,NS,EW,"time,acceleration,acceleration"'//lf, '''EW''')
      call refuse('file,dt_s,units,channel,vertical'//lf//'channels.csv,,g,NS,UD'//lf, 'title ''NS'' is not one of')
   end subroutine test_catalogue

   !> A catalogue that cannot be read with vertical components
   subroutine refuse(content, part)
      character(len=*), intent(in) :: content, part
      type(record_type), allocatable :: records(:)
      type(error_type), allocatable :: error

      call write_file('bad.csv', content)
      call read_catalogue(scratch//'/bad.csv', records, error, vertical_factor=1.0_wp)
      call check_error(error, part, 'catalogue '//content)
   end subroutine refuse

   !> Write a file
   subroutine write_file(name, content)
      character(len=*), intent(in) :: name, content
      integer :: unit

      open (newunit=unit, file=scratch//'/'//name, action='write', status='replace', access='stream', form='unformatted')
      write (unit) content
      close (unit)
   end subroutine write_file

end program test_vertical
