!> After the record: free motion, whose later peak follows from its energy without stepping.
!>
!> E = 1/2 J(q) q'^2 + V(q) is constant between impacts for every mechanism, since C = J'/2
!> (docs/theory.md, section 4).
module dondolo_motion_tail
   use dondolo_base_bracket, only : bracket_type
   use dondolo_base_kinds, only : wp
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: tail_type, free_motion
   public :: fall_time, inertia, leave, rise, time_between, turning_rotation, way_to_turn, work_between

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
   pure subroutine free_motion(mechanism, limit, reached, q, v, ratio, tail)
      class(mechanism_type), intent(in) :: mechanism
      !> Rotation that counts as collapse [rad]
      real(wp), intent(in) :: limit
      !> Largest rotation so far [rad]
      real(wp), intent(in) :: reached
      !> Rotation at the end of the record, less than the limit [rad]
      real(wp), intent(in) :: q
      !> Angular velocity, positive outwards [rad/s]
      real(wp), intent(in) :: v
      !> Speed after the next impact / speed before it
      real(wp), intent(in) :: ratio
      type(tail_type), intent(out) :: tail

      real(wp) :: kinetic, energy, energy_left, rest_energy
      logical :: falls

      call leave(mechanism, limit, reached, q, v, tail, kinetic, falls)
      if (.not. falls) return
      energy = kinetic + mechanism%potential(q)
      ! It falls to q = 0, loses 1 - e^2 of its kinetic energy there, and rises once more.
      rest_energy = mechanism%potential(0.0_wp)
      energy_left = rest_energy + ratio**2*(energy - rest_energy)
      if (.not. energy_left > mechanism%potential(min(reached, limit, mechanism%capacity))) return
      tail%delay = fall_time(mechanism, kinetic, q, 0.0_wp)
      kinetic = ratio**2*max(0.0_wp, kinetic - work_between(mechanism, q, -q))
      call rise(mechanism, limit, reached, 0.0_wp, energy_left, kinetic, tail)
   end subroutine free_motion

   !> Free motion outwards from the end of the record, at once or after a turn beyond the capacity; else the wall falls inwards
   pure subroutine leave(mechanism, limit, reached, q, v, tail, kinetic, falls)
      class(mechanism_type), intent(in) :: mechanism
      !> Rotation that counts as collapse, and the largest so far [rad]
      real(wp), intent(in) :: limit, reached
      !> Rotation [rad], and angular velocity, positive outwards [rad/s]
      real(wp), intent(in) :: q, v
      !> What happens, unless it falls
      type(tail_type), intent(out) :: tail
      !> Its kinetic energy [J]
      real(wp), intent(out) :: kinetic
      !> Does it fall?
      logical, intent(out) :: falls

      real(wp) :: energy, turn, way

      kinetic = 0.5_wp*inertia(mechanism, q)*v**2
      energy = kinetic + mechanism%potential(q)
      falls = .false.
      if (v > 0.0_wp .or. (.not. v < 0.0_wp .and. q > mechanism%capacity)) then
         call rise(mechanism, limit, reached, q, energy, kinetic, tail)
      else if (q > mechanism%capacity .and. energy <= mechanism%potential(mechanism%capacity)) then
         ! Moving inwards beyond the capacity, too slow to come back over it: it turns and falls outwards.
         turn = turning_rotation(mechanism, energy, mechanism%capacity, q)
         tail%collapsed = .true.
         tail%peak = limit
         way = way_to_turn(mechanism, kinetic, q, turn)
         tail%delay = time_between(mechanism, 0.0_wp, turn, -way) + time_between(mechanism, 0.0_wp, turn, (limit - q) - way)
      else
         falls = .true.
      end if
   end subroutine leave

   !> Outward motion with a given energy: it reaches the limit or a peak
   pure subroutine rise(mechanism, limit, reached, q, energy, kinetic, tail)
      class(mechanism_type), intent(in) :: mechanism
      !> Rotation that counts as collapse, and the largest so far [rad]
      real(wp), intent(in) :: limit, reached
      !> Where the motion begins [rad]
      real(wp), intent(in) :: q
      !> Energy [J], and the part of it that is kinetic, whose digits are not those that the sum has left of it
      real(wp), intent(in) :: energy, kinetic
      !> What happens; the delay is added to
      type(tail_type), intent(inout) :: tail

      real(wp) :: top, excess

      top = min(limit, mechanism%capacity)
      tail%collapsed = q >= top
      if (.not. tail%collapsed) tail%collapsed = energy > mechanism%potential(top)
      if (tail%collapsed) then
         tail%peak = limit
         ! The slowest place, the capacity, is an end of the integrals.
         excess = kinetic
         if (q < top) then
            excess = kinetic - work_between(mechanism, q, top - q)
            if (.not. excess > 0.0_wp) excess = max(0.0_wp, energy - mechanism%potential(top))
            tail%delay = tail%delay + time_between(mechanism, excess, top, q - top)
         end if
         if (limit > top) tail%delay = tail%delay + time_between(mechanism, excess, max(top, q), limit - max(top, q))
      else if (energy > mechanism%potential(min(reached, top))) then
         tail%peak = turning_rotation(mechanism, energy, top, q)
         ! No kinetic energy is left at the turning point: what the sum shows is rounding, and would be taken for speed there.
         tail%delay = tail%delay + time_between(mechanism, 0.0_wp, tail%peak, -way_to_turn(mechanism, kinetic, q, tail%peak))
      end if
   end subroutine rise

   !> Time of the fall from a rotation to another; a motion that passes the capacity is slowest there
   pure function fall_time(mechanism, kinetic, q, to) result(time)
      class(mechanism_type), intent(in) :: mechanism
      !> Kinetic energy at q [J]
      real(wp), intent(in) :: kinetic
      !> Rotation, and that to which it falls, less than the capacity [rad]
      real(wp), intent(in) :: q, to
      !> Time [s]
      real(wp) :: time

      real(wp) :: excess

      if (q > mechanism%capacity) then
         excess = max(0.0_wp, kinetic - work_between(mechanism, q, mechanism%capacity - q))
         time = time_between(mechanism, excess, mechanism%capacity, q - mechanism%capacity) &
            & + time_between(mechanism, excess, mechanism%capacity, to - mechanism%capacity)
      else
         time = time_between(mechanism, kinetic, q, to - q)
      end if
   end function fall_time

   !> The rotation between two others at which the potential energy equals the energy
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

      type(bracket_type) :: bracket

      bracket = bracket_type(low, high)
      do while (bracket%is_divisible())
         call bracket%halve(.not. mechanism%potential(bracket%middle()) > energy)
      end do
      turn = bracket%middle()
   end function turning_rotation

   !> Way from a rotation to the next turning point. Where it is short the difference of two rotations, which the potentials know
   !> to the rounding of the whole wall only, does not have its digits
   pure function way_to_turn(mechanism, kinetic, from, turn) result(way)
      class(mechanism_type), intent(in) :: mechanism
      !> Kinetic energy at the rotation [J]
      real(wp), intent(in) :: kinetic
      !> The rotation, and the turning point to rounding [rad]
      real(wp), intent(in) :: from, turn
      !> The way, signed [rad]
      real(wp) :: way

      ! More than rounding is not corrected: then the turn is next to an equilibrium.
      real(wp), parameter :: most = 1.0e-6_wp
      integer, parameter :: iterations = 4
      real(wp) :: better, left, moment
      integer :: i

      way = turn - from
      better = way
      do i = 1, iterations
         moment = mechanism%moment(from + better)
         left = kinetic - work_between(mechanism, from, better)
         if (.not. abs(left) < most*mechanism%capacity*abs(moment)) return
         better = better + left/moment
      end do
      way = better
   end function way_to_turn

   !> Work against the restoring moment on a way, which is what potentials differ by, by the Gauss-Legendre rule where their
   !> difference would be lost in their rounding
   pure function work_between(mechanism, from, way) result(work)
      class(mechanism_type), intent(in) :: mechanism
      !> Where it begins, and the way, signed [rad]
      real(wp), intent(in) :: from, way
      !> Work [J]
      real(wp) :: work

      real(wp), parameter :: short = 1.0e-3_wp
      real(wp), parameter :: nodes(2) = [sqrt(5.0_wp - 2.0_wp*sqrt(10.0_wp/7.0_wp))/3.0_wp, &
         & sqrt(5.0_wp + 2.0_wp*sqrt(10.0_wp/7.0_wp))/3.0_wp]
      real(wp), parameter :: weights(2) = [(322.0_wp + 13.0_wp*sqrt(70.0_wp))/1800.0_wp, &
         & (322.0_wp - 13.0_wp*sqrt(70.0_wp))/1800.0_wp]
      integer :: i

      if (abs(way) > short*mechanism%capacity) then
         work = mechanism%potential(from + way) - mechanism%potential(from)
         return
      end if
      work = 64.0_wp/225.0_wp*mechanism%moment(from + 0.5_wp*way)
      do i = 1, size(nodes)
         work = work + weights(i)*(mechanism%moment(from + 0.5_wp*(1.0_wp - nodes(i))*way) &
            & + mechanism%moment(from + 0.5_wp*(1.0_wp + nodes(i))*way))
      end do
      work = work*way
   end function work_between

   !> Time of the motion on a way, the integral of dq/q'; the motion is slowest where it begins, or ends.
   !> q = slow + way x^2 takes the singularity of a turning point out, and the double exponential
   !> rule (Takahasi and Mori 1974) what is left near an unstable equilibrium
   pure function time_between(mechanism, excess, slow, way) result(time)
      class(mechanism_type), intent(in) :: mechanism
      !> Kinetic energy where it is slowest [J]
      real(wp), intent(in) :: excess
      !> Rotation at which the motion is slowest, or turns [rad]
      real(wp), intent(in) :: slow
      !> Way from there to the other end, signed [rad]
      real(wp), intent(in) :: way
      !> Time [s]
      real(wp) :: time

      real(wp), parameter :: half_pi = acos(0.0_wp), reach = 3.6_wp, accuracy = 1.0e-10_wp
      integer, parameter :: finest = 9
      real(wp) :: step, total, before, x, weight, s
      integer :: level, i, n

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
            if (x > 0.0_wp) total = total + weight*2.0_wp*x*slowness(mechanism, excess, slow, way*x**2)
         end do
         time = total*step*abs(way)
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

      real(wp) :: drop

      if (abs(distance) < 1.0e-5_wp) then
         ! The difference of the potentials would be lost in their rounding.
         drop = -mechanism%moment(slow + 0.5_wp*distance)*distance
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

end module dondolo_motion_tail
