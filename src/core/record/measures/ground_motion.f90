!> Velocity and displacement of the ground: the piecewise linear acceleration integrated twice, exactly.
!>
!> The ground is at rest at the first sample, and nothing is corrected: no baseline, no filter. Peaks are those of the
!> continuous functions, which lie between samples too, from the first sample to the last.
module dondolo_record_ground_motion
   use dondolo_base_kinds, only : wp
   use dondolo_record, only : record_type
   implicit none
   private

   public :: ground_velocity, ground_displacement, peak_velocity, peak_displacement

contains

   !> Velocity of the ground at every sample [m/s]
   pure function ground_velocity(record) result(velocity)
      type(record_type), intent(in) :: record
      !> Velocity, 0 at the first sample [m/s]
      real(wp) :: velocity(size(record%acceleration))

      integer :: i

      velocity(1) = 0.0_wp
      associate (a => record%acceleration)
         do i = 2, size(velocity)
            velocity(i) = velocity(i - 1) + 0.5_wp*record%dt*(a(i - 1) + a(i))
         end do
      end associate
   end function ground_velocity

   !> Displacement of the ground at every sample [m]
   pure function ground_displacement(record) result(displacement)
      type(record_type), intent(in) :: record
      !> Displacement, 0 at the first sample [m]
      real(wp) :: displacement(size(record%acceleration))

      real(wp) :: velocity(size(displacement))
      integer :: i

      velocity = ground_velocity(record)
      displacement(1) = 0.0_wp
      associate (a => record%acceleration, dt => record%dt)
         do i = 2, size(displacement)
            displacement(i) = displacement(i - 1) + dt*(velocity(i - 1) + dt*(2.0_wp*a(i - 1) + a(i))/6.0_wp)
         end do
      end associate
   end function ground_displacement

   !> Peak ground velocity [m/s]
   pure function peak_velocity(record) result(peak)
      type(record_type), intent(in) :: record
      !> max |v| [m/s]
      real(wp) :: peak

      real(wp) :: velocity
      integer :: i

      velocity = 0.0_wp
      peak = 0.0_wp
      associate (a => record%acceleration, dt => record%dt)
         do i = 2, size(a)
            ! Where the acceleration passes zero, after the part a0/(a0 - a1) of the step; seldom is that a new peak
            if (abs(velocity) + dt*abs(a(i - 1)) > peak .and. a(i - 1)*a(i) < 0.0_wp) then
               peak = max(peak, abs(velocity + 0.5_wp*dt*a(i - 1)**2/(a(i - 1) - a(i))))
            end if
            velocity = velocity + 0.5_wp*dt*(a(i - 1) + a(i))
            peak = max(peak, abs(velocity))
         end do
      end associate
   end function peak_velocity

   !> Peak ground displacement [m]
   pure function peak_displacement(record) result(peak)
      type(record_type), intent(in) :: record
      !> max |d| [m]
      real(wp) :: peak

      real(wp) :: velocity(size(record%acceleration)), displacement(size(record%acceleration))
      real(wp) :: jerk, root, swing, part(2)
      integer :: i, k

      velocity = ground_velocity(record)
      displacement = ground_displacement(record)
      peak = maxval(abs(displacement))
      associate (a => record%acceleration, dt => record%dt)
         do i = 2, size(velocity)
            ! Where the velocity v + a t + j t**2/2 is zero within the step, in the form that loses no digits
            jerk = (a(i) - a(i - 1))/dt
            root = a(i - 1)**2 - 2.0_wp*jerk*velocity(i - 1)
            if (root < 0.0_wp) cycle
            swing = -(a(i - 1) + sign(sqrt(root), a(i - 1)))
            part = -1.0_wp
            if (abs(jerk) > 0.0_wp) part(1) = swing/jerk
            if (abs(swing) > 0.0_wp) part(2) = 2.0_wp*velocity(i - 1)/swing
            do k = 1, 2
               if (.not. (part(k) > 0.0_wp .and. part(k) < dt)) cycle
               peak = max(peak, abs(displacement(i - 1) + part(k)*(velocity(i - 1) &
                  & + part(k)*(a(i - 1)/2.0_wp + part(k)*jerk/6.0_wp))))
            end do
         end do
      end associate
   end function peak_displacement

end module dondolo_record_ground_motion
