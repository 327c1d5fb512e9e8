!> The motion of a floor: the record filtered by the modes of a building, exactly.
!>
!> Between samples the ground acceleration is linear, and the state of a mode follows from that at the sample before by
!> the exponential of its matrix (Nigam and Jennings 1969). The result at refined samples is a record like any other:
!> linear between them (docs/theory.md, section 1).
module dondolo_floor_motion
   use dondolo_building, only : building_type
   use dondolo_error, only : error_type, raise_input
   use dondolo_kinds, only : pi, wp
   use dondolo_limits, only : most_samples
   use dondolo_record, only : record_type
   use dondolo_text, only : to_text
   implicit none
   private

   public :: filter_record, floor_samples

   !> Terms of the power series of the exponential: 0.5**18/18! is below rounding
   integer, parameter :: terms = 18

contains

   !> Number of samples of the motion of a floor
   pure real(wp) function floor_samples(building, record) result(samples)
      type(building_type), intent(in) :: building
      !> Acceleration of the ground
      type(record_type), intent(in) :: record

      real(wp) :: parts, free

      parts = real(building%parts(record%dt), wp)
      free = building%free_vibration()/record%dt*parts
      samples = real(size(record%acceleration) - 1, wp)*parts + 1.0_wp + aint(free) + merge(1.0_wp, 0.0_wp, free > 0.0_wp)
   end function floor_samples

   !> Absolute acceleration of the floor: u_g'' + sum participation d'', with d'' + 2 xi omega d' + omega**2 d = -u_g''.
   !> After the record the ground is still and the building swings freely
   subroutine filter_record(building, ground, floor, error)
      type(building_type), intent(in) :: building
      !> Acceleration of the ground
      type(record_type), intent(in) :: ground
      !> That of the floor, of the same name
      type(record_type), intent(out) :: floor
      !> It has too many samples
      type(error_type), allocatable, intent(out) :: error

      real(wp), allocatable :: input(:)
      integer :: i, j, k, parts, refined

      if (floor_samples(building, ground) > real(most_samples, wp)) then
         call raise_input(error, 'building: the motion of its floor under record '''//ground%name//''' has more than '// &
            & to_text(most_samples)//' samples')
         return
      end if
      parts = building%parts(ground%dt)
      refined = (size(ground%acceleration) - 1)*parts + 1
      allocate (input(nint(floor_samples(building, ground))), source=0.0_wp)
      input(1) = ground%acceleration(1)
      do i = 2, size(ground%acceleration)
         associate (before => ground%acceleration(i - 1), after => ground%acceleration(i), at => (i - 2)*parts + 1)
            do j = 1, parts - 1
               input(at + j) = before + (after - before)*real(j, wp)/real(parts, wp)
            end do
            input(at + parts) = after
         end associate
      end do
      floor%name = ground%name
      if (allocated(ground%file)) floor%file = ground%file
      floor%metadata = ground%metadata
      floor%dt = ground%dt/real(parts, wp)
      floor%acceleration = input
      if (allocated(ground%vertical)) call carry_vertical(floor, ground%vertical, parts)
      do k = 1, size(building%period)
         if (abs(building%participation(k)) > 0.0_wp) call add_mode(floor, input, refined, building%period(k), &
            & building%damping(k), building%participation(k))
      end do
   end subroutine filter_record

   !> Carry the vertical component up, at the samples of the floor: a building is rigid vertically
   pure subroutine carry_vertical(floor, vertical, parts)
      !> The motion of the floor
      type(record_type), intent(inout) :: floor
      !> Vertical acceleration of the ground [m/s2]
      real(wp), intent(in) :: vertical(:)
      !> Samples of the floor in one of the ground
      integer, intent(in) :: parts

      integer :: i, j

      allocate (floor%vertical(size(floor%acceleration)), source=0.0_wp)
      floor%vertical(1) = vertical(1)
      do i = 2, size(vertical)
         do j = 1, parts
            floor%vertical((i - 2)*parts + 1 + j) = vertical(i - 1) &
               & + (vertical(i) - vertical(i - 1))*(real(j, wp)/real(parts, wp))
         end do
      end do
   end subroutine carry_vertical

   !> Add the motion of a mode
   pure subroutine add_mode(floor, input, refined, period, damping, participation)
      !> Its acceleration is added to
      type(record_type), intent(inout) :: floor
      !> Acceleration of the ground at its samples [m/s2]
      real(wp), intent(in) :: input(:)
      !> Samples of the record; behind the last of them the ground is still at once
      integer, intent(in) :: refined
      !> Period [s]
      real(wp), intent(in) :: period
      !> Damping ratio
      real(wp), intent(in) :: damping
      !> Participation factor times shape
      real(wp), intent(in) :: participation

      real(wp) :: step(4, 4), u, w, next, damper, spring, start, rise
      integer :: i

      ! In units of time of one step and of d h**-2: displacement u, velocity w, acceleration -(a + damper w + spring u)
      spring = (2.0_wp*pi*floor%dt/period)**2
      damper = 2.0_wp*damping*(2.0_wp*pi*floor%dt/period)
      step = exponential(damper, spring)
      u = 0.0_wp
      w = 0.0_wp
      associate (a => floor%acceleration)
         a(1) = a(1) - participation*input(1)
         do i = 2, size(a)
            start = input(i - 1)
            if (i == refined + 1) start = 0.0_wp
            rise = input(i) - start
            next = step(1, 1)*u + step(1, 2)*w + (step(1, 3)*start + step(1, 4)*rise)
            w = step(2, 1)*u + step(2, 2)*w + (step(2, 3)*start + step(2, 4)*rise)
            u = next
            ! A swing that has died out would be counted in denormal numbers, which are slow
            if (abs(u) + abs(w) < tiny(u)) then
               u = 0.0_wp
               w = 0.0_wp
            end if
            a(i) = a(i) - participation*(input(i) + damper*w + spring*u)
         end do
      end associate
   end subroutine add_mode

   !> State after a step: displacement, velocity, ground acceleration and its rise in the step, from those before it.
   !> The power series of a part of the step, squared until the step is whole
   pure function exponential(damper, spring) result(step)
      !> 2 xi omega h
      real(wp), intent(in) :: damper
      !> (omega h)**2
      real(wp), intent(in) :: spring
      !> Their matrix
      real(wp) :: step(4, 4)

      real(wp) :: rate(4, 4), term(4, 4)
      integer :: k, halvings

      rate = 0.0_wp
      rate(1, 2) = 1.0_wp
      rate(2, :) = [-spring, -damper, -1.0_wp, 0.0_wp]
      rate(3, 4) = 1.0_wp
      halvings = max(0, 1 + exponent(maxval(sum(abs(rate), dim=2))))
      rate = scale(rate, -halvings)
      step = 0.0_wp
      do k = 1, 4
         step(k, k) = 1.0_wp
      end do
      term = step
      do k = 1, terms
         term = matmul(term, rate)/real(k, wp)
         step = step + term
      end do
      do k = 1, halvings
         step = matmul(step, step)
      end do
   end function exponential

end module dondolo_floor_motion
