!> After the record: free motion, whose later peak follows from its energy without stepping.
!>
!> E = 1/2 J(q) q'^2 + V(q) is constant between impacts for every mechanism, since C = J'/2
!> (docs/theory.md, section 4).
module dondolo_tail
   use dondolo_kinds, only : wp
   use dondolo_mechanism, only : mechanism_type
   implicit none
   private

   public :: tail_type, free_motion
   public :: inertia, time_between, turning_rotation

   !> What happens after the record
   type :: tail_type
      !> Largest rotation that is still to come [rad]; the limit for a collapse
      real(wp) :: peak = 0.0_wp
      !> Is the limit reached?
      logical :: collapsed = .false.
      !> Time from the end of the record until then [s]
      real(wp) :: delay = 0.0_wp
   end type tail_type

contains

   !> The largest rotation after the end of the record, if it exceeds what was reached before. Most do not: their times, which are
   !> integrals, are not needed then
   pure subroutine free_motion(mechanism, limit, reached, q, v, tail)
      class(mechanism_type), intent(in) :: mechanism
      !> Rotation that counts as collapse [rad]
      real(wp), intent(in) :: limit
      !> Largest rotation so far [rad]
      real(wp), intent(in) :: reached
      !> Rotation at the end of the record, less than the limit [rad]
      real(wp), intent(in) :: q
      !> Angular velocity, positive outwards [rad/s]
      real(wp), intent(in) :: v
      type(tail_type), intent(out) :: tail

      real(wp) :: j, energy, energy_left, rest_energy, turn

      j = inertia(mechanism, q)
      energy = 0.5_wp*j*v**2 + mechanism%potential(q)
      if (v > 0.0_wp .or. (.not. v < 0.0_wp .and. q > mechanism%capacity)) then
         call rise(mechanism, limit, reached, q, energy, tail)
      else if (q > mechanism%capacity .and. energy <= mechanism%potential(mechanism%capacity)) then
         ! Moving inwards beyond the capacity, too slow to come back over it: it turns and falls outwards.
         turn = turning_rotation(mechanism, energy, mechanism%capacity, q)
         tail%collapsed = .true.
         tail%peak = limit
         energy = mechanism%potential(turn)
         tail%delay = time_between(mechanism, energy, turn, q) + time_between(mechanism, energy, turn, limit)
      else
         ! It falls to q = 0, loses 1 - e^2 of its kinetic energy there, and rises once more.
         rest_energy = mechanism%potential(0.0_wp)
         energy_left = rest_energy + mechanism%restitution**2*(energy - rest_energy)
         if (.not. energy_left > mechanism%potential(min(reached, limit, mechanism%capacity))) return
         tail%delay = fall_time(mechanism, energy, q)
         call rise(mechanism, limit, reached, 0.0_wp, energy_left, tail)
      end if
   end subroutine free_motion

   !> Outward motion with a given energy: it reaches the limit or a peak
   pure subroutine rise(mechanism, limit, reached, q, energy, tail)
      class(mechanism_type), intent(in) :: mechanism
      !> Rotation that counts as collapse, and the largest so far [rad]
      real(wp), intent(in) :: limit, reached
      !> Where the motion begins [rad]
      real(wp), intent(in) :: q
      !> Energy [J]
      real(wp), intent(in) :: energy
      !> What happens; the delay is added to
      type(tail_type), intent(inout) :: tail

      real(wp) :: top

      top = min(limit, mechanism%capacity)
      tail%collapsed = q >= top
      if (.not. tail%collapsed) tail%collapsed = energy > mechanism%potential(top)
      if (tail%collapsed) then
         tail%peak = limit
         ! The slowest place, the capacity, is an end of the integrals.
         if (q < top) tail%delay = tail%delay + time_between(mechanism, energy, top, q)
         if (limit > top) tail%delay = tail%delay + time_between(mechanism, energy, max(top, q), limit)
      else if (energy > mechanism%potential(min(reached, top))) then
         tail%peak = turning_rotation(mechanism, energy, top, q)
         ! V at the turning point, not E: their difference is rounding, and would be taken for speed there.
         tail%delay = tail%delay + time_between(mechanism, mechanism%potential(tail%peak), tail%peak, q)
      end if
   end subroutine rise

   !> Time of the fall from q to 0; a motion that passes the capacity is slowest there
   pure function fall_time(mechanism, energy, q) result(time)
      class(mechanism_type), intent(in) :: mechanism
      !> Energy [J]
      real(wp), intent(in) :: energy
      !> Rotation [rad]
      real(wp), intent(in) :: q
      !> Time [s]
      real(wp) :: time

      if (q > mechanism%capacity) then
         time = time_between(mechanism, energy, mechanism%capacity, q) &
            & + time_between(mechanism, energy, mechanism%capacity, 0.0_wp)
      else
         time = time_between(mechanism, energy, q, 0.0_wp)
      end if
   end function fall_time

   !> The rotation between two others at which the potential energy equals the energy, by bisection
   pure function turning_rotation(mechanism, energy, high, low) result(turn)
      class(mechanism_type), intent(in) :: mechanism
      !> Energy [J]
      real(wp), intent(in) :: energy
      !> Rotation at which V >= E [rad]
      real(wp), intent(in) :: high
      !> Rotation at which V <= E [rad]
      real(wp), intent(in) :: low
      !> The rotation [rad]
      real(wp) :: turn

      real(wp) :: above, below

      above = high
      below = low
      do
         turn = 0.5_wp*(above + below)
         if (turn == above .or. turn == below) exit
         if (mechanism%potential(turn) > energy) then
            above = turn
         else
            below = turn
         end if
      end do
   end function turning_rotation

   !> Time of the motion between two rotations, the integral of dq/q'; the motion is slowest at the first.
   !> q = slow + (other - slow) x^2 takes the singularity of a turning point out, and the double exponential
   !> rule (Takahasi and Mori 1974) what is left near an unstable equilibrium
   pure function time_between(mechanism, energy, slow, other) result(time)
      class(mechanism_type), intent(in) :: mechanism
      !> Energy [J]
      real(wp), intent(in) :: energy
      !> Rotation at which the motion is slowest, or turns [rad]
      real(wp), intent(in) :: slow
      !> The other end [rad]
      real(wp), intent(in) :: other
      !> Time [s]
      real(wp) :: time

      real(wp), parameter :: half_pi = acos(0.0_wp), reach = 3.6_wp, accuracy = 1.0e-10_wp
      integer, parameter :: finest = 9
      real(wp) :: excess, step, total, before, x, weight, s
      integer :: level, i, n

      excess = max(energy - mechanism%potential(slow), 0.0_wp)
      total = 0.0_wp
      time = 0.0_wp
      do level = 3, finest
         n = 2**level
         step = reach/real(n, wp)
         before = time
         do i = -n, n
            ! Points of the coarser levels are in the sum already.
            if (level > 3 .and. modulo(i, 2) == 0) cycle
            s = real(i, wp)*step
            x = 0.5_wp*(1.0_wp + tanh(half_pi*sinh(s)))
            weight = 0.5_wp*half_pi*cosh(s)/cosh(half_pi*sinh(s))**2
            if (x > 0.0_wp) total = total + weight*2.0_wp*x*slowness(mechanism, excess, slow, (other - slow)*x**2)
         end do
         time = total*step*abs(other - slow)
         if (abs(time - before) <= accuracy*time) exit
      end do
   end function time_between

   !> 1/|q'| at a distance from the slowest rotation
   pure function slowness(mechanism, excess, slow, distance) result(inverse_speed)
      class(mechanism_type), intent(in) :: mechanism
      !> Kinetic energy at the slowest rotation [J]
      real(wp), intent(in) :: excess
      !> The slowest rotation [rad]
      real(wp), intent(in) :: slow
      !> Distance from it, signed [rad]
      real(wp), intent(in) :: distance
      !> 1/|q'| [s/rad]
      real(wp) :: inverse_speed

      real(wp) :: drop, j, c, g, l, load

      if (abs(distance) < 1.0e-5_wp) then
         ! The difference of the potentials would be lost in their rounding.
         call mechanism%terms(slow + 0.5_wp*distance, j, c, g, l, load)
         drop = -(g - load)*distance
      else
         drop = mechanism%potential(slow) - mechanism%potential(slow + distance)
      end if
      ! The root of the smallest number, so that the quotient stays finite.
      inverse_speed = sqrt(0.5_wp*inertia(mechanism, slow + distance)/max(excess + drop, sqrt(tiny(drop))))
   end function slowness

   !> Inertia J at a rotation
   pure function inertia(mechanism, q) result(j)
      class(mechanism_type), intent(in) :: mechanism
      !> Rotation [rad]
      real(wp), intent(in) :: q
      !> J [kg m2]
      real(wp) :: j

      real(wp) :: c, g, l, load

      call mechanism%terms(q, j, c, g, l, load)
   end function inertia

end module dondolo_tail
