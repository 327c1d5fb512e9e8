!> The energy of a time history: E = 1/2 J q'^2 + V changes only by the work of the ground, dE/dt = -s L u_g'' q',
!> and at impacts, where the speed is multiplied by e. Coming to rest may lose some, nothing may create any.
module energy_balance
   use dondolo_base_kinds, only : wp
   use dondolo_motion_dormand_prince, only : angular_acceleration, dense_rotation, excitation_type, state_type
   use dondolo_motion_response, only : trace_type
   use dondolo_motion_solver, only : solver_type
   use dondolo_record, only : record_type
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: balance_type, energy_balance_of

   !> What a time history says about energy
   type :: balance_type
      !> Intervals between two rows with a motion that the rows resolve
      integer :: intervals = 0
      !> Largest error of the energy over an interval / what the tolerances allow one step
      real(wp) :: worst = 0.0_wp
      !> Impacts after which the speed is not e times that before
      integer :: wrong_impacts = 0
   end type balance_type

   !> Nodes and weights of Gauss's rule with five points on (0, 1)
   real(wp), parameter :: outer = 0.906179845938663992797626878299_wp, inner = 0.538469310105683091036314420700_wp
   real(wp), parameter :: nodes(5) = 0.5_wp + 0.5_wp*[-outer, -inner, 0.0_wp, inner, outer]
   real(wp), parameter :: light = 0.236926885056189087514264040720_wp, heavy = 0.478628670499366468041291514836_wp
   real(wp), parameter :: weights(5) = 0.5_wp*[light, heavy, 128.0_wp/225.0_wp, heavy, light]

contains

   !> Go through the rows of a time history
   function energy_balance_of(mechanism, record, solver, trace) result(balance)
      class(mechanism_type), intent(in) :: mechanism
      type(record_type), intent(in) :: record
      type(solver_type), intent(in) :: solver
      type(trace_type), intent(in) :: trace
      type(balance_type) :: balance
      integer :: i

      do i = 1, trace%rows - 1
         if (.not. trace%time(i + 1) > trace%time(i)) then
            call check_impact(balance, mechanism%restitution, trace%velocity(i:i + 1))
         else if (is_moving(trace, i) .and. is_moving(trace, i + 1)) then
            call check_interval(balance, mechanism, record, solver, trace, i)
         end if
      end do
   end function energy_balance_of

   !> Does the wall move?
   pure logical function is_moving(trace, i)
      type(trace_type), intent(in) :: trace
      integer, intent(in) :: i

      is_moving = abs(trace%rotation(i)) > 0.0_wp .or. abs(trace%velocity(i)) > 0.0_wp
   end function is_moving

   !> Two rows of one instant: an impact, or a sample next to one
   pure subroutine check_impact(balance, restitution, velocity)
      type(balance_type), intent(inout) :: balance
      real(wp), intent(in) :: restitution, velocity(2)
      real(wp) :: before, after

      before = abs(velocity(1))
      after = abs(velocity(2))
      if (after == before .and. before > 0.0_wp) return
      ! No speed at all: it came to rest.
      if (.not. (after == restitution*before .or. after == 0.0_wp)) balance%wrong_impacts = balance%wrong_impacts + 1
   end subroutine check_impact

   !> Two rows with a motion in between
   subroutine check_interval(balance, mechanism, record, solver, trace, i)
      type(balance_type), intent(inout) :: balance
      class(mechanism_type), intent(in) :: mechanism
      type(record_type), intent(in) :: record
      type(solver_type), intent(in) :: solver
      type(trace_type), intent(in) :: trace
      integer, intent(in) :: i
      type(excitation_type) :: ground
      real(wp) :: h, q(2), v(2), f(2), b(0:5), power(5), work, doubt, change, allowed, speed, scale, unit, side

      ! The side is that of the rotation, or of the velocity where the motion leaves or reaches q = 0.
      side = sign(1.0_wp, trace%velocity(i))
      if (abs(trace%rotation(i + 1)) > 0.0_wp) side = sign(1.0_wp, trace%rotation(i + 1))
      if (abs(trace%rotation(i)) > 0.0_wp) side = sign(1.0_wp, trace%rotation(i))
      q = side*trace%rotation(i:i + 1)
      v = side*trace%velocity(i:i + 1)
      ! A wall that came to rest and started again in between
      if (any(q < 0.0_wp)) return
      h = trace%time(i + 1) - trace%time(i)
      if (trace%time(i) < record%duration()) then
         ground%start = side*trace%acceleration(i)
         ground%slope = side*(trace%acceleration(i + 1) - trace%acceleration(i))/h
      end if
      f(1) = angular_acceleration(mechanism, ground, 0.0_wp, q(1), v(1))
      f(2) = angular_acceleration(mechanism, ground, h, q(2), v(2))
      b = dense_rotation(h, state_type(q(1), v(1), f(1)), state_type(q(2), v(2), f(2)))
      power = power_along(mechanism, ground, h, b)
      work = sum(weights*power)
      ! The cubic without the accelerations tells how well the rows describe the motion.
      doubt = sum(weights*abs(power - power_along(mechanism, ground, h, &
         & [q(1), q(1) + h*v(1)/3.0_wp, q(2) - h*v(2)/3.0_wp, q(2)])))
      change = kinetic(mechanism, q(2), v(2)) - kinetic(mechanism, q(1), v(1)) &
         & + mechanism%potential(q(2)) - mechanism%potential(q(1))
      ! What the rows do not resolve says nothing of the motion; next to the geometric end J grows without bound.
      if (any(b < 0.0_wp) .or. maxval(b) > 0.98_wp*mechanism%geometric_end()) return
      speed = maxval(abs(5.0_wp*(b(1:) - b(:4))/h))
      scale = kinetic(mechanism, q(1), speed) + abs(work)
      if (doubt > 1.0e-3_wp*scale) return
      ! Errors of the speed by rtol and by atol, of the work, and of rounding
      unit = kinetic(mechanism, q(1), mechanism%frequency_parameter()*mechanism%capacity)
      allowed = 2.0_wp*(solver%rtol*scale + solver%atol*sqrt(scale*unit)) + doubt &
         & + 50.0_wp*epsilon(unit)*abs(mechanism%potential(q(1)))
      balance%intervals = balance%intervals + 1
      balance%worst = max(balance%worst, abs(change - work)/allowed)
   end subroutine check_interval

   !> Kinetic energy
   real(wp) function kinetic(mechanism, q, v)
      class(mechanism_type), intent(in) :: mechanism
      real(wp), intent(in) :: q, v
      real(wp) :: j, c, g, l, load

      call mechanism%terms(q, j, c, g, l, load)
      kinetic = 0.5_wp*j*v**2
   end function kinetic

   !> Power of the ground, -L u q', times the interval, at Gauss's nodes of a motion in Bernstein form
   function power_along(mechanism, ground, h, b) result(power)
      class(mechanism_type), intent(in) :: mechanism
      type(excitation_type), intent(in) :: ground
      real(wp), intent(in) :: h, b(0:)
      real(wp) :: power(5)
      real(wp) :: c(0:ubound(b, 1)), x, slope, j, cc, g, l, load
      integer :: k, m, n

      n = ubound(b, 1)
      do k = 1, 5
         x = nodes(k)
         c = b
         do m = n, 1, -1
            if (m == 1) slope = real(n, wp)*(c(1) - c(0))
            c(:m - 1) = (1.0_wp - x)*c(:m - 1) + x*c(1:m)
         end do
         call mechanism%terms(c(0), j, cc, g, l, load)
         power(k) = -l*(ground%start + ground%slope*x*h)*slope
      end do
   end function power_along

end module energy_balance
