!> After the record: free motion of a wall with ties, from its energy.
!>
!> Between two levels of the ties E = 1/2 J q'^2 + V is constant, with the potential of the forces that they have there. A
!> motion outwards that ends is followed by lower ones only, since ties give back at most what they took (docs/theory.md,
!> section 4).
module dondolo_motion_restrained_tail
   use dondolo_base_bracket, only : bracket_type
   use dondolo_base_kinds, only : wp
   use dondolo_motion_restraint_state, only : restraint_state_type
   use dondolo_motion_tail, only : inertia, tail_type, time_between, turning_rotation, way_to_turn, work_between
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: restrained_motion

   !> Parts of the way between two levels in which a change of sign of the moment is looked for
   integer, parameter :: parts = 64

contains

   !> The largest rotation after the end of the record
   pure subroutine restrained_motion(wall, restraints, limit, q, v, start, tail)
      !> The wall; its ties get the forces that they have
      class(mechanism_type), intent(inout) :: wall
      type(restraint_state_type), intent(inout) :: restraints
      !> Rotation that counts as collapse [rad]
      real(wp), intent(in) :: limit
      !> Rotation at the end of the record, less than the limit [rad]
      real(wp), intent(in) :: q
      !> Angular velocity, positive outwards [rad/s]
      real(wp), intent(in) :: v
      !> Duration of the record [s]
      real(wp), intent(in) :: start
      type(tail_type), intent(out) :: tail

      real(wp) :: at, goal, kinetic, lively
      logical :: outwards, has_struck, turns

      if (restraints%flows .and. .not. v > 0.0_wp) call restraints%turn(wall, q)
      call wall%set_restraints(restraints%force, restraints%stiffness)
      at = q
      kinetic = 0.5_wp*inertia(wall, q)*v**2
      lively = kinetic
      outwards = v > 0.0_wp .or. (.not. v < 0.0_wp .and. wall%moment(q) < 0.0_wp)
      has_struck = .false.
      do
         goal = max(0.0_wp, restraints%below)
         if (outwards) goal = min(limit, restraints%above)
         call go(wall, goal, at, kinetic, lively, tail%delay, turns)
         if (turns .and. .not. outwards) then
            outwards = .true.
         else if (turns) then
            call restraints%turn(wall, at)
            call wall%set_restraints(restraints%force, restraints%stiffness)
            tail%peak = at
            return
         else if (outwards .and. at >= limit) then
            tail%peak = limit
            tail%collapsed = .true.
            return
         else if (outwards .or. at > 0.0_wp) then
            call restraints%cross(wall, at, outwards, start + tail%delay)
            call wall%set_restraints(restraints%force, restraints%stiffness)
         else
            kinetic = wall%restitution**2*kinetic
            lively = wall%restitution**2*lively
            if (has_struck .or. .not. kinetic > 0.0_wp) return
            has_struck = .true.
            outwards = .true.
            call restraints%strike(wall)
            call restraints%face(wall, merge(-1.0_wp, 1.0_wp, restraints%holds))
            call wall%set_restraints(restraints%force, restraints%stiffness)
         end if
      end do
   end subroutine restrained_motion

   !> Go to a rotation, or to where the motion turns before it
   pure subroutine go(wall, goal, at, kinetic, lively, time, turns)
      class(mechanism_type), intent(in) :: wall
      !> The rotation [rad]
      real(wp), intent(in) :: goal
      !> Rotation [rad] and kinetic energy [J] at the start; out: at the end
      real(wp), intent(inout) :: at, kinetic
      !> The same kinetic energy with the digits that it loses in the sum with the potential, for times [J]
      real(wp), intent(inout) :: lively
      !> Time, added to [s]
      real(wp), intent(inout) :: time
      !> Does it turn?
      logical, intent(out) :: turns

      real(wp) :: energy, from, next, after
      integer :: i

      turns = .false.
      from = at
      energy = kinetic + wall%potential(at)
      do i = 1, parts
         next = from + (goal - from)*real(i, wp)/real(parts, wp)
         if (i == parts) then
            next = goal
         else
            ! The potential is monotone up to where the moment changes its sign.
            after = from + (goal - from)*real(i + 1, wp)/real(parts, wp)
            if (wall%moment(next) > 0.0_wp .eqv. wall%moment(after) > 0.0_wp) cycle
            next = balance(wall, next, after)
         end if
         turns = wall%potential(next) > energy
         if (turns) next = turning_rotation(wall, energy, next, at)
         if (turns) then
            time = time + time_between(wall, 0.0_wp, next, -way_to_turn(wall, lively, at, next))
            lively = 0.0_wp
         else if (abs(next - at) > 0.0_wp) then
            after = max(0.0_wp, lively - work_between(wall, at, next - at))
            if (after < lively) then
               time = time + time_between(wall, after, next, at - next)
            else
               time = time + time_between(wall, lively, at, next - at)
            end if
            lively = after
         end if
         at = next
         if (turns) exit
      end do
      kinetic = max(0.0_wp, energy - wall%potential(at))
      if (turns) kinetic = 0.0_wp
   end subroutine go

   !> Rotation between two others at which the moment changes its sign
   pure real(wp) function balance(wall, one, other) result(q)
      class(mechanism_type), intent(in) :: wall
      !> Rotations with moments of different signs [rad]
      real(wp), intent(in) :: one, other

      type(bracket_type) :: bracket
      logical :: rights

      bracket = bracket_type(one, other)
      rights = wall%moment(one) > 0.0_wp
      do while (bracket%is_divisible())
         call bracket%halve(wall%moment(bracket%middle()) > 0.0_wp .eqv. rights)
      end do
      q = bracket%middle()
   end function balance

end module dondolo_motion_restrained_tail
