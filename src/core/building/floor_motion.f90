!> The motion of a floor, or what a wall between its supports feels: the record filtered by the modes of a building, exactly.
!>
!> Between samples the ground acceleration is linear, and the state of a mode follows from that at the sample before by
!> the exponential of its matrix (Nigam and Jennings 1969). The result at refined samples is a record like any other:
!> linear between them (docs/theory.md, section 1).
!>
!> With k and tau of the wall, a_base and a_top the accelerations of its supports and delta their relative displacement, it is
!> a_base + k (a_top - a_base) - tau delta.
module dondolo_building_floor_motion
   use dondolo_base_error, only : error_type, raise_input
   use dondolo_base_kinds, only : pi, wp
   use dondolo_base_limits, only : most_samples
   use dondolo_base_text, only : to_text
   use dondolo_building, only : building_type
   use dondolo_building_swing, only : swing_type
   use dondolo_record, only : compute_extremes, record_type
   implicit none
   private

   public :: filter_record, floor_samples, mix_swing, new_swing

   !> Terms of the power series of the exponential: 0.5**18/18! is below rounding
   integer, parameter :: terms = 18

   !> Samples that are mixed at a time, so that they stay in the fastest cache
   integer, parameter :: block_size = 512

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
   subroutine filter_record(building, ground, floor, error)
      type(building_type), intent(in) :: building
      !> Acceleration of the ground
      type(record_type), intent(in) :: ground
      !> That of the floor, of the same name
      type(record_type), intent(out) :: floor
      !> It has too many samples
      type(error_type), allocatable, intent(out) :: error

      type(swing_type) :: swing

      if (floor_samples(building, ground) > real(most_samples, wp)) then
         call raise_input(error, 'building: the motion of its floor under record '''//ground%name//''' has more than '// &
            & to_text(most_samples)//' samples')
         return
      end if
      call new_swing(swing, building, ground)
      call mix_swing(swing, building, ground, floor)
   end subroutine filter_record

   !> Let a building swing; it and its walls swing alike where `swings_as` says so
   subroutine new_swing(swing, building, ground)
      type(swing_type), intent(out) :: swing
      type(building_type), intent(in) :: building
      !> Acceleration of the ground, of which there are not too many samples
      type(record_type), intent(in) :: ground

      integer :: i, j, k, parts, refined, channels

      parts = building%parts(ground%dt)
      refined = (size(ground%acceleration) - 1)*parts + 1
      swing%dt = ground%dt/real(parts, wp)
      allocate (swing%ground(nint(floor_samples(building, ground))), source=0.0_wp)
      swing%ground(1) = ground%acceleration(1)
      do i = 2, size(ground%acceleration)
         associate (before => ground%acceleration(i - 1), after => ground%acceleration(i), at => (i - 2)*parts + 1)
            do j = 1, parts - 1
               swing%ground(at + j) = before + (after - before)*real(j, wp)/real(parts, wp)
            end do
            swing%ground(at + parts) = after
         end associate
      end do
      if (allocated(ground%vertical)) call carry_vertical(swing, ground%vertical, parts)
      channels = size(building%period)
      if (building%has_diaphragm()) channels = channels + 1
      allocate (swing%acceleration(size(swing%ground), channels), swing%displacement(size(swing%ground), channels))
      if (building%has_diaphragm()) then
         call swing_in_series(swing, refined, building)
      else
         do k = 1, channels
            call swing_mode(swing, k, refined, building%period(k), building%damping(k))
         end do
      end if
      swing%largest = maxval(abs(swing%displacement), dim=1)
   end subroutine new_swing

   !> The motion that a wall feels of a building that swings
   subroutine mix_swing(swing, building, ground, floor, drift)
      type(swing_type), intent(in) :: swing
      !> The building as the wall sees it
      type(building_type), intent(in) :: building
      !> The record that it swings under
      type(record_type), intent(in) :: ground
      !> What the wall feels, of the same name
      type(record_type), intent(out) :: floor
      !> Greatest |delta| over the height of the line through the supports [rad]
      real(wp), intent(out), optional :: drift

      real(wp), dimension(size(swing%acceleration, 2)) :: felt, drifts
      real(wp) :: delta(block_size), lowest, highest, largest
      integer :: i, j, k, modes
      logical :: drifts_alone

      floor%name = ground%name
      if (allocated(ground%file)) floor%file = ground%file
      floor%metadata = ground%metadata
      floor%dt = swing%dt
      if (allocated(swing%vertical)) floor%vertical = swing%vertical
      modes = size(building%period)
      felt(:modes) = building%felt()
      drifts(:modes) = building%drifts()
      felt(modes + 1:) = building%share*building%diaphragm%participation
      drifts(modes + 1:) = building%diaphragm%participation
      drifts = drifts*swing%dt**2
      ! One mode that drifts, the usual case, is followed to its greatest displacement once for all walls
      drifts_alone = count(abs(drifts) > 0.0_wp) <= 1
      largest = 0.0_wp
      if (drifts_alone) largest = maxval(abs(drifts)*swing%largest)
      allocate (floor%acceleration(size(swing%ground)))
      do i = 1, size(swing%ground), block_size
         j = min(i + block_size - 1, size(swing%ground))
         associate (acceleration => floor%acceleration(i:j), relative => delta(:j - i + 1))
            acceleration = swing%ground(i:j)
            relative = 0.0_wp
            do k = 1, size(felt)
               if (abs(felt(k)) > 0.0_wp) call add(acceleration, felt(k), swing%acceleration(i:j, k))
               if (abs(drifts(k)) > 0.0_wp) call add(relative, drifts(k), swing%displacement(i:j, k))
            end do
            ! Equal supports move the wall as its floor does, to the bit
            if (abs(building%tilt) > 0.0_wp) call add(acceleration, -building%tilt, relative)
            if (.not. drifts_alone) then
               call compute_extremes(relative, lowest, highest)
               largest = max(largest, -lowest, highest)
            end if
         end associate
      end do
      if (.not. present(drift)) return
      drift = 0.0_wp
      if (building%height > 0.0_wp) drift = largest/building%height
   end subroutine mix_swing

   !> Add a motion times a factor to another
   pure subroutine add(sum, factor, motion)
      real(wp), contiguous, intent(inout) :: sum(:)
      real(wp), intent(in) :: factor
      !> As many samples
      real(wp), contiguous, intent(in) :: motion(:)

      sum = sum + factor*motion
   end subroutine add

   !> Carry the vertical component up, at the samples of the floor: a building is rigid vertically
   pure subroutine carry_vertical(swing, vertical, parts)
      !> Its refined samples are set
      type(swing_type), intent(inout) :: swing
      !> Vertical acceleration of the ground [m/s2]
      real(wp), intent(in) :: vertical(:)
      !> Samples of the floor in one of the ground
      integer, intent(in) :: parts

      integer :: i, j

      allocate (swing%vertical(size(swing%ground)), source=0.0_wp)
      swing%vertical(1) = vertical(1)
      do i = 2, size(vertical)
         do j = 1, parts
            swing%vertical((i - 2)*parts + 1 + j) = vertical(i - 1) &
               & + (vertical(i) - vertical(i - 1))*(real(j, wp)/real(parts, wp))
         end do
      end do
   end subroutine carry_vertical

   !> Let a mode swing
   pure subroutine swing_mode(swing, mode, refined, period, damping)
      !> Its ground is known; acceleration and displacement of the mode are set
      type(swing_type), intent(inout) :: swing
      !> Number of the mode
      integer, intent(in) :: mode
      !> Samples of the record; behind the last of them the ground is still at once
      integer, intent(in) :: refined
      !> Period [s]
      real(wp), intent(in) :: period
      !> Damping ratio
      real(wp), intent(in) :: damping

      real(wp) :: rate(4, 4), step(4, 4), u, w, next, damper, spring, start, rise
      integer :: i

      ! In units of time of one step and of d h**-2: displacement u, velocity w, acceleration -(a + damper w + spring u)
      rate = 0.0_wp
      rate(3, 4) = 1.0_wp
      call set_oscillator(rate, 1, period, damping, swing%dt)
      spring = -rate(2, 1)
      damper = -rate(2, 2)
      step = exponential(rate)
      u = 0.0_wp
      w = 0.0_wp
      associate (input => swing%ground)
         swing%acceleration(1, mode) = -input(1)
         swing%displacement(1, mode) = 0.0_wp
         do i = 2, size(input)
            start = input(i - 1)
            if (i == refined + 1) start = 0.0_wp
            rise = input(i) - start
            next = step(1, 1)*u + step(1, 2)*w + (step(1, 3)*start + step(1, 4)*rise)
            w = step(2, 1)*u + step(2, 2)*w + (step(2, 3)*start + step(2, 4)*rise)
            u = next
            ! A swing that has died out would be computed in denormal numbers, which are slow
            if (abs(u) + abs(w) < tiny(u)) then
               u = 0.0_wp
               w = 0.0_wp
            end if
            swing%acceleration(i, mode) = -(input(i) + damper*w + spring*u)
            swing%displacement(i, mode) = u
         end do
      end associate
   end subroutine swing_mode

   !> Let all modes swing, and the diaphragm that the top floor moves. One exponential of the whole state: a filter of the
   !> filtered record would miss that the motion of the floor is not linear within a step
   pure subroutine swing_in_series(swing, refined, building)
      !> Its ground is known; acceleration and displacement of the modes and of the diaphragm are set
      type(swing_type), intent(inout) :: swing
      !> Samples of the record; behind the last of them the ground is still at once
      integer, intent(in) :: refined
      !> The building, with a diaphragm
      type(building_type), intent(in) :: building

      ! Displacement and velocity of each mode, and of the diaphragm, in the units of swing_mode; ground acceleration and its rise
      real(wp) :: state(2*size(building%period) + 4), next(2*size(building%period) + 2)
      real(wp) :: rate(size(state), size(state)), whole(size(state), size(state)), step(size(next), size(state))
      integer :: i, k, ground, last

      ground = size(state) - 1
      last = size(building%period) + 1
      rate = 0.0_wp
      rate(ground, ground + 1) = 1.0_wp
      do k = 1, size(building%period)
         call set_oscillator(rate, k, building%period(k), building%damping(k), swing%dt)
      end do
      call set_oscillator(rate, last, building%diaphragm%period, building%diaphragm%damping, swing%dt)
      do k = 1, size(building%period)
         ! The floor, not the ground, moves the diaphragm: by the ground's acceleration and p' d'' of each mode
         rate(2*last, :) = rate(2*last, :) - building%participation_top(k)*rate(2*k, :)
      end do
      whole = exponential(rate)
      step = whole(:size(next), :)
      state = 0.0_wp
      associate (input => swing%ground)
         state(ground) = input(1)
         do i = 1, size(input)
            if (i > 1) then
               if (i == refined + 1) state(ground) = 0.0_wp
               state(ground + 1) = input(i) - state(ground)
               next = matmul(step, state)
               ! A swing that has died out would be computed in denormal numbers, which are slow
               if (sum(abs(next)) < tiny(swing%dt)) next = 0.0_wp
               state(:ground - 1) = next
               state(ground) = input(i)
            end if
            do k = 1, last
               swing%acceleration(i, k) = dot_product(rate(2*k, :), state)
               swing%displacement(i, k) = state(2*k - 1)
            end do
         end do
      end associate
   end subroutine swing_in_series

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

end module dondolo_building_floor_motion
