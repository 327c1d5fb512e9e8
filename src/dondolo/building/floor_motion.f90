!> The motion of a floor, or what a wall between its supports feels: the record filtered by the modes of a building, exactly.
!>
!> Between samples the ground acceleration is linear, and the state of a mode follows from that at the sample before by
!> the exponential of its matrix (Nigam and Jennings 1969). The result at refined samples is a record like any other:
!> linear between them (docs/theory.md, section 1).
!>
!> With k and tau of the wall, a_base and a_top the accelerations of its supports and delta their relative displacement, it is
!> a_base + k (a_top - a_base) - tau delta.
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

   !> Absolute acceleration that moves the wall: u_g'' + sum P d'' - tau sum (p' - p) d, with
   !> d'' + 2 xi omega d' + omega**2 d = -u_g'' and P = p + k (p' - p), which is p of the floor where no wall is known.
   !> After the record the ground is still and the building swings freely
   subroutine filter_record(building, ground, floor, error, drift)
      type(building_type), intent(in) :: building
      !> Acceleration of the ground
      type(record_type), intent(in) :: ground
      !> That of the floor, of the same name
      type(record_type), intent(out) :: floor
      !> It has too many samples
      type(error_type), allocatable, intent(out) :: error
      !> Greatest |delta| over the height of the line through the supports [rad]
      real(wp), intent(out), optional :: drift

      real(wp), allocatable :: input(:), delta(:)
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
      allocate (delta(size(input)), source=0.0_wp)
      associate (felt => building%felt(), drifts => building%drifts())
         if (building%has_diaphragm()) then
            call add_series(floor%acceleration, delta, input, refined, floor%dt, building)
         else
            do k = 1, size(building%period)
               if (abs(felt(k)) + abs(drifts(k)) > 0.0_wp) call add_mode(floor, delta, input, refined, building%period(k), &
                  & building%damping(k), felt(k), drifts(k))
            end do
         end if
      end associate
      ! Equal supports move the wall as its floor does, to the bit
      if (abs(building%tilt) > 0.0_wp) floor%acceleration = floor%acceleration - building%tilt*delta
      if (.not. present(drift)) return
      drift = 0.0_wp
      if (building%height > 0.0_wp) drift = maxval(abs(delta))/building%height
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
   pure subroutine add_mode(floor, delta, input, refined, period, damping, participation, drift)
      !> Its acceleration is added to
      type(record_type), intent(inout) :: floor
      !> Relative displacement of the supports [m], added to as well
      real(wp), intent(inout) :: delta(:)
      !> Acceleration of the ground at its samples [m/s2]
      real(wp), intent(in) :: input(:)
      !> Samples of the record; behind the last of them the ground is still at once
      integer, intent(in) :: refined
      !> Period [s]
      real(wp), intent(in) :: period
      !> Damping ratio
      real(wp), intent(in) :: damping
      !> Participation factor times shape as the wall feels it, and of the top less that of the base
      real(wp), intent(in) :: participation, drift

      real(wp) :: rate(4, 4), step(4, 4), u, w, next, damper, spring, start, rise, share
      integer :: i

      ! In units of time of one step and of d h**-2: displacement u, velocity w, acceleration -(a + damper w + spring u)
      rate = 0.0_wp
      rate(3, 4) = 1.0_wp
      call set_oscillator(rate, 1, period, damping, floor%dt)
      spring = -rate(2, 1)
      damper = -rate(2, 2)
      step = exponential(rate)
      share = drift*floor%dt**2
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
            delta(i) = delta(i) + share*u
         end do
      end associate
   end subroutine add_mode

   !> Add the motion of all modes and of the diaphragm that the top floor moves. One exponential of the whole state: a filter of
   !> the filtered record would miss that the motion of the floor is not linear within a step
   pure subroutine add_series(acceleration, delta, input, refined, dt, building)
      !> Acceleration that moves the wall [m/s2] and relative displacement of its supports [m]: the motions are added to them
      real(wp), intent(inout) :: acceleration(:), delta(:)
      !> Acceleration of the ground at its samples [m/s2]
      real(wp), intent(in) :: input(:)
      !> Samples of the record; behind the last of them the ground is still at once
      integer, intent(in) :: refined
      !> Step [s]
      real(wp), intent(in) :: dt
      !> The building, with a diaphragm
      type(building_type), intent(in) :: building

      ! Displacement and velocity of each mode, and of the diaphragm, in the units of add_mode; ground acceleration and its rise
      real(wp), dimension(2*size(building%period) + 4) :: state, moved, drifted
      real(wp) :: rate(size(state), size(state)), step(size(state) - 2, size(state)), next(size(state) - 2)
      integer :: i, k, ground

      ground = size(state) - 1
      rate = 0.0_wp
      rate(ground, ground + 1) = 1.0_wp
      do k = 1, size(building%period)
         call set_oscillator(rate, k, building%period(k), building%damping(k), dt)
      end do
      associate (diaphragm => building%diaphragm, last => size(building%period) + 1, felt => building%felt(), &
         & drifts => building%drifts())
         call set_oscillator(rate, last, diaphragm%period, diaphragm%damping, dt)
         moved = 0.0_wp
         drifted = 0.0_wp
         do k = 1, size(building%period)
            associate (mode => rate(2*k, :))
               ! The floor, not the ground, moves the diaphragm: by the ground's acceleration and p' d'' of each mode
               rate(2*last, :) = rate(2*last, :) - building%participation_top(k)*mode
               moved = moved + felt(k)*mode
            end associate
            drifted(2*k - 1) = drifts(k)*dt**2
         end do
         moved = moved + building%share*diaphragm%participation*rate(2*last, :)
         drifted(2*last - 1) = diaphragm%participation*dt**2
      end associate
      rate = exponential(rate)
      step = rate(:ground - 1, :)
      state = 0.0_wp
      state(ground) = input(1)
      acceleration(1) = acceleration(1) + dot_product(moved, state)
      do i = 2, size(input)
         if (i == refined + 1) state(ground) = 0.0_wp
         state(ground + 1) = input(i) - state(ground)
         next = matmul(step, state)
         ! A swing that has died out would be counted in denormal numbers, which are slow
         if (sum(abs(next)) < tiny(dt)) next = 0.0_wp
         state(:ground - 1) = next
         state(ground) = input(i)
         acceleration(i) = acceleration(i) + dot_product(moved, state)
         delta(i) = dot_product(drifted, state)
      end do
   end subroutine add_series

   !> Set the rates of an oscillator in those of the whole state
   pure subroutine set_oscillator(rate, k, period, damping, dt)
      real(wp), intent(inout) :: rate(:, :)
      !> Its number
      integer, intent(in) :: k
      !> Period [s], damping ratio and step [s]
      real(wp), intent(in) :: period, damping, dt

      associate (omega => 2.0_wp*pi*dt/period)
         rate(2*k - 1, 2*k) = 1.0_wp
         rate(2*k, [2*k - 1, 2*k, size(rate, 1) - 1]) = [-omega**2, -2.0_wp*damping*omega, -1.0_wp]
      end associate
   end subroutine set_oscillator

   !> State after a step from that before it: the power series of a part of the step, squared until the step is whole
   pure function exponential(rates) result(step)
      !> Rates of the state in units of a step
      real(wp), intent(in) :: rates(:, :)
      !> Their matrix
      real(wp) :: step(size(rates, 1), size(rates, 1))

      real(wp), dimension(size(rates, 1), size(rates, 1)) :: rate, term
      integer :: k, halvings

      halvings = max(0, 1 + exponent(maxval(sum(abs(rates), dim=2))))
      rate = scale(rates, -halvings)
      step = 0.0_wp
      do k = 1, size(step, 1)
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
