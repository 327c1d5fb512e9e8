!> Supports that move: share and tilt of every mechanism by positions alone, the filter of both supports and of a diaphragm, first
!> swings under the motion that a wall feels, and the limits in which a wall feels its floor alone.
!>
!> Values to 15 digits are those of an independent computation in 40 digits.
program test_supports
   use, intrinsic :: iso_fortran_env, only : real128
   use checks, only : check, check_close, check_error, check_ok, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_building, only : building_type, diaphragm_type
   use dondolo_building_floor_motion, only : filter_record
   use dondolo_motion_response, only : response_type
   use dondolo_motion_simulate, only : simulate
   use dondolo_motion_solver, only : solver_type
   use dondolo_record, only : new_record, record_type
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   implicit none

   integer, parameter :: qp = real128
   real(wp), parameter :: exact = 1.0e-12_wp, g = 9.81_wp

   !> A strip between two floors
   type :: strip_type
      real(wp) :: height, thickness, hinge, depth, weight, inertia, eccentricity
   end type strip_type

   !> The five strips of the tables
   type(strip_type), parameter :: strips(5) = [ &
      & strip_type(3.0_wp, 0.25_wp, 0.6_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp), &
      & strip_type(3.0_wp, 0.25_wp, 0.6_wp, 0.01_wp, 0.0_wp, 0.0_wp, 0.0_wp), &
      & strip_type(3.0_wp, 0.25_wp, 0.6_wp, 0.0_wp, 20.0e3_wp, 1.0_wp, 0.02_wp), &
      & strip_type(3.5_wp, 0.45_wp, 0.75_wp, 0.02_wp, 30.0e3_wp, 0.5_wp, -0.05_wp), &
      & strip_type(2.8_wp, 0.3_wp, 0.5_wp, 0.0_wp, 10.0e3_wp, 0.0_wp, 0.04_wp)]

   call test_strips()
   call test_positions()
   call test_facades()
   call test_filter()
   call test_limits()
   call test_swings()
   call test_refusals()
   call finish()

contains

   !> A strip, on a building if there is one
   function strip_input(strip) result(input)
      type(strip_type), intent(in) :: strip
      type(wall_input_type) :: input

      call input%set('mechanism', 'two_block')
      call input%set('height', strip%height)
      call input%set('thickness', strip%thickness)
      call input%set('hinge', strip%hinge)
      if (strip%depth > 0.0_wp) call input%set('hinge_depth', strip%depth)
      if (strip%weight > 0.0_wp) then
         call input%set('overburden', strip%weight)
         call input%set('overburden_inertia', strip%inertia)
         call input%set('eccentricity', strip%eccentricity)
      end if
   end function strip_input

   !> A wall
   function made(input) result(wall)
      type(wall_input_type), intent(in) :: input
      type(wall_type) :: wall

      type(error_type), allocatable :: error

      call new_wall(wall, input, error)
      call check_ok(error, 'wall')
   end function made

   !> Share and tilt of strips
   subroutine test_strips()
      real(wp), parameter :: share(5) = [0.544907407407407_wp, 0.543129629629630_wp, 0.572363224307102_wp, &
         & 0.627826841816124_wp, 0.522959183673469_wp]
      real(wp), parameter :: tilt(5) = [3.175381944444444_wp, 3.189915277777778_wp, 2.761001514631916_wp, &
         & 1.928507033016079_wp, 3.067923376833727_wp]
      type(wall_type) :: wall
      real(wp) :: length, acceleration
      integer :: i

      call suite('strips')
      do i = 1, size(strips)
         wall = made(strip_input(strips(i)))
         call wall%mechanism%support(length, acceleration)
         call check_close(length/strips(i)%height, share(i), exact, 'share')
         call check_close(acceleration/strips(i)%height, tilt(i), exact, 'tilt')
      end do
   end subroutine test_strips

   !> The same from where every mass is, by differences in 33 digits: nothing of the closed forms
   subroutine test_positions()
      real(qp), parameter :: h = 1.0e-8_qp
      type(wall_type) :: wall
      real(qp), dimension(8) :: of_opening, of_drift, masses, weights
      real(qp) :: lever, coupling, curvature, gravity
      real(wp) :: length, acceleration
      integer :: i

      call suite('positions')
      gravity = real(g, qp)
      do i = 1, size(strips)
         wall = made(strip_input(strips(i)))
         call wall%mechanism%support(length, acceleration)
         call weigh(strips(i), gravity, masses, weights)
         of_opening = (placed(strips(i), h, 0.0_qp) - placed(strips(i), -h, 0.0_qp))/(2.0_qp*h)
         of_drift = (placed(strips(i), 0.0_qp, h) - placed(strips(i), 0.0_qp, -h))/(2.0_qp*h)
         lever = sum(masses([1, 4])*of_opening([1, 4]))
         coupling = sum(masses*of_opening*of_drift)
         curvature = sum(weights*(placed(strips(i), h, h) - placed(strips(i), h, -h) - placed(strips(i), -h, h) &
            & + placed(strips(i), -h, -h)))/(4.0_qp*h**2)
         call check_close(length/strips(i)%height, real(coupling/lever, wp), 1.0e-12_wp, 'share by positions')
         call check_close(acceleration/strips(i)%height, real(-curvature/lever, wp), 1.0e-12_wp, 'tilt by positions')
      end do

   end subroutine test_positions

   !> Masses of the coordinates of `placed` [kg/m, kg m2/m], and what each weighs [N/m]
   subroutine weigh(strip, gravity, masses, weights)
      type(strip_type), intent(in) :: strip
      !> [m/s2]
      real(qp), intent(in) :: gravity
      real(qp), intent(out) :: masses(8), weights(8)

      real(qp) :: mass(2), height(2)

      height = real(strip%height, qp)*[real(strip%hinge, qp), 1.0_qp - real(strip%hinge, qp)]
      mass = 1800.0_qp*real(strip%thickness, qp)*height
      masses(:3) = [mass(1), mass(1), mass(1)*(height(1)**2 + real(strip%thickness, qp)**2)/12.0_qp]
      masses(4:6) = [mass(2), mass(2), mass(2)*(height(2)**2 + real(strip%thickness, qp)**2)/12.0_qp]
      ! The load: its mass moves up and down alone
      masses(7:) = [0.0_qp, real(strip%inertia*strip%weight, qp)/gravity]
      weights = 0.0_qp
      weights([2, 5]) = gravity*mass
      weights(8) = real(strip%weight, qp)
   end subroutine weigh

   !> Where a strip is that folds outwards: x, y and rotation of each block, then x and y of the load
   function placed(strip, opening, drift) result(places)
      type(strip_type), intent(in) :: strip
      !> Rotation of the lower block from the line through its supports [rad]; displacement of the top hinge [m]
      real(qp), intent(in) :: opening, drift
      real(qp) :: places(8)

      real(qp) :: b, lower, upper, first, second, hinge(2)

      b = real(strip%thickness, qp)/2.0_qp - real(strip%depth, qp)
      lower = real(strip%height, qp)*real(strip%hinge, qp)
      upper = real(strip%height, qp) - lower
      first = asin(drift/real(strip%height, qp)) + opening
      ! Base and top hinges lie at the outer side, the hinge between the blocks at the inner one
      hinge = turned(-2.0_qp*b, lower, first)
      ! 2 b cos(second) + upper sin(second) = drift - hinge
      second = asin((drift - hinge(1))/hypot(2.0_qp*b, upper)) - atan2(2.0_qp*b, upper)
      places(:3) = [turned(-b, lower/2.0_qp, first), first]
      places(4:6) = [hinge + turned(b, upper/2.0_qp, second), second]
      places(7:) = hinge + turned(b + real(strip%eccentricity, qp), upper, second)
   end function placed

   !> A point after a rotation outwards about the origin
   pure function turned(x, y, angle) result(point)
      real(qp), intent(in) :: x, y, angle
      real(qp) :: point(2)

      point = [x*cos(angle) + y*sin(angle), y*cos(angle) - x*sin(angle)]
   end function turned

   !> The stepped facade of docs/mechanisms.md
   function stepped(inertia) result(input)
      !> What its loads move
      character(len=*), intent(in) :: inertia
      type(wall_input_type) :: input

      call input%set('mechanism', 'one_sided')
      call input%set('section_height', [4.0_wp, 3.5_wp, 3.0_wp])
      call input%set('section_thickness', [0.60_wp, 0.45_wp, 0.30_wp])
      call input%set('load', [12.0e3_wp, 12.0e3_wp, 6.0e3_wp])
      call input%set('load_height', [4.0_wp, 7.5_wp, 10.5_wp])
      call input%set('load_depth', [0.5_wp, 0.35_wp, 0.2_wp])
      call input%set('load_inertia', inertia)
   end function stepped

   !> A rectangular wall
   function block_input(mechanism, height, thickness) result(input)
      character(len=*), intent(in) :: mechanism
      real(wp), intent(in) :: height, thickness
      type(wall_input_type) :: input

      call input%set('mechanism', mechanism)
      call input%set('height', height)
      call input%set('thickness', thickness)
   end function block_input

   !> Share and tilt times the height of the line through the supports, of one block
   subroutine test_facades()
      type(wall_input_type) :: input
      type(wall_type) :: wall
      real(wp) :: share, tilt, bare(2)

      call suite('facades')
      wall = made(block_input('one_sided', 9.0_wp, 0.5_wp))
      call wall%mechanism%support(share, tilt)
      call check_close(share, 6.018518518518519_wp, exact, 'J/L')
      call check_close(tilt, g, exact, 'B/L')
      wall = made(stepped('none'))
      call wall%mechanism%support(share, tilt)
      call check_close(share, 6.398067179049246_wp, exact, 'J/L, dead loads')
      call check_close(tilt, 14.8958715248126_wp, exact, 'B/L, dead loads')
      wall = made(stepped('both'))
      call wall%mechanism%support(share, tilt)
      call check_close(share, 6.817970428745355_wp, exact, 'J/L, masses')
      call check_close(tilt, g, exact, 'B/L, masses')
      ! A tie is fixed to what the facade leans on, and so is a spring
      bare = [share, tilt]
      input = stepped('both')
      call input%set('tie_height', [7.4_wp])
      call input%set('tie_area', [5.0e-5_wp])
      call input%set('tie_length', [8.0_wp])
      call input%set('tie_preload', [1.0e7_wp])
      call input%set('spring', [5.0e3_wp])
      call input%set('spring_height', [4.0_wp])
      call input%set('spring_depth', [0.0_wp])
      wall = made(input)
      call wall%mechanism%support(share, tilt)
      call check_close(share, bare(1), exact, 'J/L with a tie')
      call check_close(tilt, bare(2), exact, 'B/L with a tie')
      wall = made(block_input('free_standing', 1.5_wp, 0.3_wp))
      call wall%mechanism%support(share, tilt)
      call check(abs(share) + abs(tilt) <= 0.0_wp, 'a free-standing wall touches its base alone')
      ! A thin facade feels its building at two thirds of its height
      wall = made(block_input('one_sided', 9.0_wp, 0.009_wp))
      call wall%mechanism%support(share, tilt)
      call check_close(share, 6.0_wp, 1.1e-6_wp, 'two thirds')
   end subroutine test_facades

   !> A building with the numbers of a wall
   function building_of(period, damping, base, top, diaphragm, share, tilt) result(building)
      real(wp), intent(in) :: period(:), damping(:), base(:), top(:)
      !> Period, damping and participation; 0: none
      real(wp), intent(in) :: diaphragm(3), share, tilt
      type(building_type) :: building

      building%period = period
      building%damping = damping
      building%participation = base
      building%participation_top = top
      building%diaphragm = diaphragm_type(diaphragm(1), diaphragm(2), diaphragm(3))
      building%refine = 1
      building%height = 1.0_wp
      call building%lean(share, tilt)
   end function building_of

   !> Check the motion under a record at 0.05, 0.10 ... s
   subroutine check_motion(building, expected, what, less)
      type(building_type), intent(in) :: building
      real(wp), intent(in) :: expected(:)
      character(len=*), intent(in) :: what
      !> What is subtracted before the comparison
      type(building_type), intent(in), optional :: less

      type(record_type) :: ground, motion, other
      type(error_type), allocatable :: error
      real(wp) :: values(size(expected))
      integer :: i

      call new_record(ground, [0.0_wp, 1.0_wp, -1.0_wp, 0.0_wp], 0.05_wp, 'pulse', error)
      call filter_record(building, ground, motion, error)
      call check_ok(error, what)
      values = motion%acceleration(2:7)
      if (present(less)) then
         call filter_record(less, ground, other, error)
         values = other%acceleration(2:7) - values
      end if
      do i = 1, size(expected)
         call check_close(values(i), expected(i), exact, what, atol=exact*maxval(abs(expected)))
      end do
   end subroutine check_motion

   !> Base, top and drift of three buildings with diaphragms, and what walls feel
   subroutine test_filter()
      real(wp), parameter :: none(3) = 0.0_wp, sensitive = 1.0e6_wp
      type(building_type) :: top

      call suite('filter')
      top = building_of([0.3_wp], [0.05_wp], [6.0_wp/7.0_wp], [9.0_wp/7.0_wp], [0.4_wp, 0.10_wp, 1.3_wp], 1.0_wp, 0.0_wp)
      call check_motion(building_of([0.3_wp], [0.05_wp], [6.0_wp/7.0_wp], [9.0_wp/7.0_wp], none, 0.0_wp, 0.0_wp), &
         & [0.3269764737570011_wp, 0.3789313800132266_wp, -0.1014051812442816_wp, -0.6652606430405487_wp, &
         & -0.5414324539236993_wp, 0.08414060315139785_wp], 'base 1')
      call check_motion(top, [-0.03170419682706897_wp, -0.107224455755688_wp, 0.8745712061813077_wp, 0.923447045998603_wp, &
         & -0.3469344524463032_wp, -1.750660797521365_wp], 'top 1')
      call check_motion(with_tilt(top, sensitive), sensitive*[-7.18269851052766e-5_wp, -0.00102199285846769_wp, &
         & -0.002792160923449984_wp, -0.002325503645432566_wp, 0.00166703637330079_wp, 0.00600389741247371_wp], 'drift 1', top)
      top = building_of([0.3_wp], [0.05_wp], [0.0_wp], [3.0_wp/7.0_wp], [0.3_wp, 0.05_wp, 1.27_wp], 1.0_wp, 0.0_wp)
      call check_motion(top, [-0.01276627470990816_wp, 0.6875813000745213_wp, 0.3130061715940665_wp, -0.3502715167691154_wp, &
         & -0.9919372349725283_wp, -0.8998678973083414_wp], 'top 2, equal periods')
      call check_motion(with_tilt(top, sensitive), sensitive*[-0.0004604933404663881_wp, -0.001927994201548164_wp, &
         & -0.0007750763746912556_wp, 0.001552080281569532_wp, 0.003003505077653839_wp, 0.002133877644173627_wp], 'drift 2', top)
      top = building_of([0.3_wp, 0.1_wp], [0.05_wp, 0.05_wp], [0.8_wp, 0.2_wp], [1.2_wp, -0.3_wp], &
         & [0.6_wp, 0.07_wp, 1.0_wp], 1.0_wp, 0.0_wp)
      call check_motion(building_of([0.3_wp, 0.1_wp], [0.05_wp, 0.05_wp], [0.8_wp, 0.2_wp], [1.2_wp, -0.3_wp], none, &
         & 0.0_wp, 0.0_wp), [0.371630648943888_wp, 0.2880106847950316_wp, -0.09685370691591164_wp, -0.6176566335146065_wp, &
         & -0.5092843232528044_wp, 0.08290208106168603_wp], 'base 3')
      call check_motion(top, [0.004722982654231031_wp, 0.06202789161993307_wp, 0.3267515437841444_wp, 0.3379589846459052_wp, &
         & 0.06025638503726304_wp, -0.3858642664564186_wp], 'top 3')
      call check_motion(with_tilt(top, sensitive), sensitive*[-6.048819726221359e-5_wp, -0.0009874694815377814_wp, &
         & -0.002314152846871209_wp, -0.002605919877752347_wp, -0.0007361100059479233_wp, 0.002435032321472073_wp], 'drift 3', &
         & top)
      call check_motion(of_strip([0.4_wp, 0.10_wp, 1.3_wp]), [0.1317567975735123_wp, 0.1172666816185355_wp, &
         & 0.4392777591009501_wp, 0.2078223072094354_wp, -0.4407425293932408_wp, -0.9347209386365426_wp], 'strip')
      call check_motion(of_strip(none), [0.1441319537403464_wp, 0.756527047198882_wp, -0.129126984817468_wp, &
         & -0.848810173958564_wp, -0.6910480311346504_wp, 0.1071357934399539_wp], 'strip, rigid floors')
      ! The facade of 9 m on the ground
      top = building_of([0.3_wp], [0.05_wp], [0.0_wp], [9.0_wp/7.0_wp], none, 0.0_wp, 0.0_wp)
      top%height = 9.0_wp
      call top%lean(6.018518518518519_wp, g)
      call check_motion(top, [0.3254380639924479_wp, 0.3851446826517952_wp, -0.1018145351955559_wp, -0.66967916018372_wp, &
         & -0.545266425006219_wp, 0.08447317649909788_wp], 'facade')
   end subroutine test_filter

   !> The first strip on the first building
   function of_strip(diaphragm) result(building)
      real(wp), intent(in) :: diaphragm(3)
      type(building_type) :: building

      type(wall_type) :: wall
      real(wp) :: share, tilt

      wall = made(strip_input(strips(1)))
      call wall%mechanism%support(share, tilt)
      building = building_of([0.3_wp], [0.05_wp], [6.0_wp/7.0_wp], [9.0_wp/7.0_wp], diaphragm, share/3.0_wp, tilt/3.0_wp)
   end function of_strip

   !> A building with another tilt
   function with_tilt(building, tilt) result(other)
      type(building_type), intent(in) :: building
      real(wp), intent(in) :: tilt
      type(building_type) :: other

      other = building
      other%tilt = tilt
   end function with_tilt

   !> A wall on a building of one mode and three storeys
   function on_building(input, level, extra, value) result(wall)
      type(wall_input_type), intent(in) :: input
      !> Level of the base [m]
      real(wp), intent(in) :: level
      !> A further property of the building, and its value
      character(len=*), intent(in), optional :: extra
      real(wp), intent(in), optional :: value
      type(wall_type) :: wall

      type(wall_input_type) :: all

      all = input
      call all%set('period', [0.3_wp])
      call all%set('storeys', 3)
      call all%set('level', level)
      call all%set('building_height', 9.0_wp)
      if (present(extra)) call all%set(extra, value)
      wall = made(all)
   end function on_building

   !> The motion that a wall feels
   function felt_by(wall) result(motion)
      type(wall_type), intent(in) :: wall
      type(record_type) :: motion

      type(record_type) :: ground
      type(error_type), allocatable :: error

      call new_record(ground, [0.3_wp, 1.0_wp, -1.5_wp, 0.2_wp, 0.0_wp], 0.02_wp, 'ground', error)
      call filter_record(wall%building, ground, motion, error)
      call check_ok(error, 'motion')
   end function felt_by

   !> Where supports are equal a wall moves with its floor, to the bit; a reversed record mirrors, a doubled one doubles
   subroutine test_limits()
      type(wall_type) :: wall, alone
      type(record_type) :: motion, floor

      call suite('limits')
      alone = on_building(block_input('free_standing', 1.5_wp, 0.3_wp), 6.0_wp)
      floor = felt_by(alone)
      motion = felt_by(on_building(block_input('one_sided', 3.0_wp, 0.25_wp), 6.0_wp, 'level_top', 6.0_wp))
      call check(same(motion, floor), 'level_top = level of a facade')
      motion = felt_by(on_building(strip_input(strips(1)), 6.0_wp, 'level_top', 6.0_wp))
      call check(same(motion, floor), 'level_top = level of a strip')
      motion = felt_by(on_building(strip_input(strips(1)), 6.0_wp))
      call check(.not. same(motion, floor), 'two floors are not one')
      wall = on_building(block_input('one_sided', 1.5_wp, 0.25_wp), 9.0_wp)
      call check(same(felt_by(wall), felt_by(on_building(block_input('free_standing', 1.5_wp, 0.3_wp), 9.0_wp))), &
         & 'a parapet on the roof')
      call check_close(wall%building%level_top, 9.0_wp, exact, 'its top')
      ! A gable leans up to the eaves; the line that it leans on is shorter than it is
      wall = on_building(block_input('one_sided', 3.0_wp, 0.3_wp), 8.0_wp)
      call check_close(wall%building%level_top, 9.0_wp, exact, 'top of the building')
      call check_close(wall%building%height, 1.0_wp, exact, 'line that a gable leans on')
      call check_close(wall%building%share, 2.0_wp*1.01_wp, exact, 'its share')
      wall = on_building(strip_input(strips(1)), 8.0_wp)
      call check_close(wall%building%height, 3.0_wp, exact, 'hinges of a strip')
      ! A facade on the ground feels the building at J/L
      wall = on_building(block_input('one_sided', 9.0_wp, 0.5_wp), 0.0_wp)
      associate (felt => wall%building%felt())
         call check_close(felt(1), 9.0_wp/7.0_wp*6.018518518518519_wp/9.0_wp, exact, 'participation that it feels')
      end associate
   end subroutine test_limits

   !> Are two motions the same to the bit?
   logical function same(one, other)
      type(record_type), intent(in) :: one, other

      same = size(one%acceleration) == size(other%acceleration)
      if (same) same = all(abs(one%acceleration - other%acceleration) <= 0.0_wp)
   end function same

   !> Peak openings under the motion that strips feel, at the samples of the supports
   subroutine test_swings()
      real(wp), parameter :: base(11, 3) = reshape([0.0_wp, -2.5_wp, -4.0_wp, -3.0_wp, -1.0_wp, 1.0_wp, 2.0_wp, 1.0_wp, 0.0_wp, &
         & 0.0_wp, 0.0_wp, 0.0_wp, -3.0_wp, -5.0_wp, -4.0_wp, -1.0_wp, 2.0_wp, 2.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
         & 0.0_wp, -6.0_wp, -14.0_wp, -16.0_wp, -10.0_wp, 0.0_wp, 6.0_wp, 4.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], [11, 3])
      real(wp), parameter :: top(11, 3) = reshape([0.0_wp, -4.0_wp, -5.0_wp, -1.0_wp, 2.0_wp, 2.0_wp, 1.0_wp, 0.5_wp, 0.0_wp, &
         & 0.0_wp, 0.0_wp, 0.0_wp, -1.0_wp, -3.0_wp, -6.0_wp, -4.0_wp, 1.0_wp, 4.0_wp, 3.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, &
         & 0.0_wp, -10.0_wp, -20.0_wp, -14.0_wp, -4.0_wp, 6.0_wp, 8.0_wp, 4.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], [11, 3])
      ! The first swing alone: the records end behind its turn, and an impact ends the motion
      integer, parameter :: walls(3) = [1, 1, 4], samples(3) = [5, 7, 7]
      real(wp), parameter :: peak(3) = [0.00633890898881093_wp, 0.0143700267131148_wp, 0.0324063109714807_wp], &
         & untilted(3) = [0.0064586744_wp, 0.0138326750_wp, 0.0329941900_wp]
      real(wp), parameter :: dt = 0.05_wp
      type(wall_input_type) :: input
      type(wall_type) :: wall
      real(wp) :: share, tilt, delta(11), speed
      integer :: i, k

      call suite('swings')
      do k = 1, 3
         input = strip_input(strips(walls(k)))
         call input%set('restitution_value', 0.0_wp)
         wall = made(input)
         call wall%mechanism%support(share, tilt)
         share = share/strips(walls(k))%height
         tilt = tilt/strips(walls(k))%height
         delta = 0.0_wp
         speed = 0.0_wp
         associate (relative => top(:, k) - base(:, k))
            do i = 2, size(delta)
               delta(i) = delta(i - 1) + speed*dt + dt**2*(relative(i - 1)/3.0_wp + relative(i)/6.0_wp)
               speed = speed + dt*(relative(i - 1) + relative(i))/2.0_wp
            end do
            call check_close(greatest(wall, base(:samples(k), k) + share*relative(:samples(k)) &
               & - tilt*delta(:samples(k))), peak(k), 1.0e-9_wp, 'peak')
            call check_close(greatest(wall, base(:samples(k), k) + share*relative(:samples(k))), untilted(k), 1.0e-7_wp, &
               & 'peak without tilt')
         end associate
      end do
   end subroutine test_swings

   !> Greatest opening of a wall [rad]
   real(wp) function greatest(wall, acceleration) result(peak)
      type(wall_type), intent(in) :: wall
      real(wp), intent(in) :: acceleration(:)

      type(record_type) :: record
      type(response_type) :: response
      type(solver_type) :: solver
      type(error_type), allocatable :: error

      solver%rtol = 1.0e-12_wp
      solver%atol = 1.0e-14_wp
      call new_record(record, acceleration, 0.05_wp, 'swing', error)
      call simulate(wall%mechanism, record, 1.0_wp, solver, response, error)
      call check_ok(error, 'history')
      peak = response%edp*wall%mechanism%capacity
   end function greatest

   !> What does not belong together is refused
   subroutine test_refusals()
      call suite('refusals')
      call refused('one_sided', 'level_top', 9.5_wp, 'level_top = 9.5: must be at most building_height = 9')
      call refused('one_sided', 'level_top', 5.0_wp, 'level_top = 5: must be at least level = 6')
      call refused('one_sided', 'diaphragm_period', 0.4_wp, 'diaphragm_period = 0.4: only of a two_block wall; '// &
         & 'a one_sided wall and a corner lean on transverse walls, which do not move with a diaphragm')
      call refused('free_standing', 'level_top', 9.0_wp, 'level_top: not of a free-standing wall')
      call refused('free_standing', 'diaphragm_period', 0.4_wp, 'diaphragm_period: not of a free-standing wall')
      call refused('two_block', 'diaphragm_damping', 0.1_wp, 'diaphragm_damping: only with diaphragm_period')
      call refused('two_block', 'diaphragm_period', 0.01_wp, 'diaphragm_period = 0.01: must lie between 0.02 and 5 s')
      call refused('two_block', 'participation_top', 1.0_wp, 'participation_top: only with participation')
   end subroutine test_refusals

   !> A property that a wall on a building does not take
   subroutine refused(mechanism, name, value, sentence)
      character(len=*), intent(in) :: mechanism, name, sentence
      real(wp), intent(in) :: value

      type(wall_input_type) :: input
      type(wall_type) :: wall
      type(error_type), allocatable :: error

      input = block_input(mechanism, 3.0_wp, 0.25_wp)
      call input%set('period', [0.3_wp])
      call input%set('storeys', 3)
      call input%set('level', 6.0_wp)
      call input%set('building_height', 9.0_wp)
      if (name == 'participation_top') then
         call input%set(name, [value])
      else
         call input%set(name, value)
      end if
      call new_wall(wall, input, error)
      call check_error(error, sentence, name)
   end subroutine refused

end program test_supports
