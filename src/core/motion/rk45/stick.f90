!> A wall that sticks: friction stops it where its motion outwards has ended.
!>
!> There the ground pushes it outwards, but by less than the friction that a further motion would wake. At a rotation that does
!> not change both accelerations, without and with that friction, are linear between two samples, so that the instant at which
!> the wall falls back or goes on is known in closed form (docs/theory.md, section 4).
module dondolo_motion_stick
   use dondolo_base_kinds, only : wp
   use dondolo_motion_adaptive_step, only : most_stalled, motion_type
   use dondolo_motion_dormand_prince, only : angular_acceleration
   use dondolo_motion_step_limits, only : longest_step
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: look_for_stick, stay

contains

   !> Set whether friction stops the wall where its motion outwards has just ended
   pure subroutine look_for_stick(wall, motion)
      !> The wall without friction; with it if the motion outwards goes on
      class(mechanism_type), intent(inout) :: wall
      !> The motion: at its peak, without velocity
      type(motion_type), intent(inout) :: motion

      real(wp) :: free, resisted

      call both(wall, motion, motion%time, free, resisted)
      motion%sticks = free > 0.0_wp .and. resisted < free
      if (motion%sticks) motion%q = motion%peak
   end subroutine look_for_stick

   !> Stay until the wall is released, or to the next sample
   pure subroutine stay(wall, steps_per_sample, dt, motion, sample_reached)
      !> The wall without friction; with it if the motion outwards goes on
      class(mechanism_type), intent(inout) :: wall
      !> Least number of steps from a sample to the next
      integer, intent(in) :: steps_per_sample
      !> Sample interval [s]
      real(wp), intent(in) :: dt
      type(motion_type), intent(inout) :: motion
      !> Does it stay to the next sample?
      logical, intent(out) :: sample_reached

      real(wp) :: free(2), resisted(2), back, on, now

      now = motion%time
      call both(wall, motion, now, free(1), resisted(1))
      call both(wall, motion, dt, free(2), resisted(2))
      back = crossing(-free)
      on = crossing(resisted)
      ! Rounding may undo a release at once.
      sample_reached = motion%released > most_stalled .or. .not. min(back, on) < dt
      if (sample_reached) then
         motion%time = dt
         return
      end if
      motion%time = min(back, on)
      motion%released = motion%released + 1
      motion%sticks = .false.
      if (on < back) then
         call motion%restraints%cross(wall, motion%q, .true., 0.0_wp)
         call wall%set_restraints(motion%restraints%force, motion%restraints%stiffness)
      end if
      motion%f = angular_acceleration(wall, motion%excitation, motion%time, motion%q, 0.0_wp)
      if (on < back) then
         motion%f = max(0.0_wp, motion%f)
      else
         motion%f = min(0.0_wp, motion%f)
      end if
      motion%longest = longest_step(steps_per_sample, dt, motion%time)

   contains

      !> Time at which a linear function that is negative becomes positive; huge: it does not
      pure real(wp) function crossing(values) result(time)
         !> Now and at the next sample
         real(wp), intent(in) :: values(2)

         time = huge(time)
         if (values(1) > 0.0_wp) then
            time = now
         else if (values(2) > 0.0_wp) then
            time = now + (dt - now)*(values(1)/(values(1) - values(2)))
         end if
      end function crossing

   end subroutine stay

   !> Accelerations of the wall without velocity at its peak: without friction, and with that of a motion outwards
   pure subroutine both(wall, motion, time, free, resisted)
      !> The wall: as it is without friction
      class(mechanism_type), intent(inout) :: wall
      type(motion_type), intent(inout) :: motion
      !> Time since the last sample [s]
      real(wp), intent(in) :: time
      !> Accelerations [rad/s2]
      real(wp), intent(out) :: free, resisted

      free = angular_acceleration(wall, motion%excitation, time, motion%peak, 0.0_wp)
      call motion%restraints%cross(wall, motion%peak, .true., 0.0_wp)
      call wall%set_restraints(motion%restraints%force, motion%restraints%stiffness)
      resisted = angular_acceleration(wall, motion%excitation, time, motion%peak, 0.0_wp)
      call motion%restraints%turn(wall, motion%peak)
      call wall%set_restraints(motion%restraints%force, motion%restraints%stiffness)
   end subroutine both

end module dondolo_motion_stick
