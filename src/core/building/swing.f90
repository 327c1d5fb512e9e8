!> How a building swings from a sample of its motion to the next, and what a wall feels of that.
!>
!> Between samples the ground acceleration is linear, and the state of a mode follows from that at the sample before by
!> the exponential of its matrix (Nigam and Jennings 1969; docs/theory.md, section 1).
!>
!> With k and tau of the wall, a_base and a_top the accelerations of its supports and delta their relative displacement, it feels
!> a_base + k (a_top - a_base) - tau delta.
module dondolo_building_swing
   use dondolo_base_kinds, only : pi, wp
   use dondolo_building, only : building_type
   implicit none
   private

   public :: swing_type, new_swing

   !> Terms of the power series of the exponential: 0.5**18/18! is below rounding
   integer, parameter :: terms = 18

   !> A building under records of one time step. Its oscillators are the modes that move the wall, and the diaphragm behind them;
   !> time is counted in refined steps, so that displacements are those over dt**2
   type :: swing_type
      !> Step of the records, and of the motion [s]; parts that the former is divided into
      real(wp) :: step = 0.0_wp, dt = 0.0_wp
      integer :: parts = 1
      !> Displacement (1) and velocity (2) of each oscillator after a step: by its own before it, and by the acceleration of the
      !> ground at the start and at the end
      real(wp), allocatable :: by_u(:, :), by_w(:, :), by_start(:, :), by_end(:, :)
      !> The same of the diaphragm by displacement and velocity of each mode
      real(wp), allocatable :: driven_by_u(:, :), driven_by_w(:, :)
      !> Is the last oscillator a diaphragm?
      logical :: has_diaphragm = .false.
      !> What the wall feels of the ground, and of the displacement and velocity of each oscillator
      real(wp) :: felt_of_ground = 1.0_wp
      real(wp), allocatable :: felt_of_u(:), felt_of_w(:)
      !> What delta has of each displacement
      real(wp), allocatable :: drift_of_u(:)
   end type swing_type

contains

   !> A building, as the wall sees it, under records of a time step
   pure subroutine new_swing(swing, building, step)
      type(swing_type), intent(out) :: swing
      type(building_type), intent(in) :: building
      !> [s]
      real(wp), intent(in) :: step

      integer, allocatable :: modes(:)
      real(wp), allocatable :: rate(:, :), whole(:, :)
      integer :: i, k, n

      swing%step = step
      swing%parts = building%parts(step)
      swing%dt = step/real(swing%parts, wp)
      swing%has_diaphragm = building%has_diaphragm()
      modes = pack([(k, k=1, size(building%period))], moving(building))
      n = size(modes) + merge(1, 0, swing%has_diaphragm)
      allocate (swing%by_u(2, n), swing%by_w(2, n), swing%by_start(2, n), swing%by_end(2, n))
      allocate (swing%driven_by_u(2, size(modes)), swing%driven_by_w(2, size(modes)), source=0.0_wp)
      do i = 1, size(modes)
         call take_oscillator(swing, i, building%period(modes(i)), building%damping(modes(i)))
      end do
      if (swing%has_diaphragm) then
         call set_rates(swing, building, modes, rate)
         whole = exponential(rate)
         associate (own => 2*n - 1, ground => 2*n + 1)
            swing%by_u(:, n) = whole(own:own + 1, own)
            swing%by_w(:, n) = whole(own:own + 1, own + 1)
            swing%by_start(:, n) = whole(own:own + 1, ground) - whole(own:own + 1, ground + 1)
            swing%by_end(:, n) = whole(own:own + 1, ground + 1)
            do i = 1, size(modes)
               swing%driven_by_u(:, i) = whole(own:own + 1, 2*i - 1)
               swing%driven_by_w(:, i) = whole(own:own + 1, 2*i)
            end do
         end associate
      end if
      call set_felt(swing, building, modes)
   end subroutine new_swing

   !> Modes of which the wall, or the diaphragm that holds it, feels anything
   pure function moving(building)
      type(building_type), intent(in) :: building
      !> An answer for each mode
      logical :: moving(size(building%period))

      moving = abs(building%felt()) > 0.0_wp .or. abs(building%drifts()) > 0.0_wp &
         & .or. (building%has_diaphragm() .and. abs(building%participation_top) > 0.0_wp)
   end function moving

   !> Take an oscillator that the ground alone moves
   pure subroutine take_oscillator(swing, i, period, damping)
      !> Its step is known
      type(swing_type), intent(inout) :: swing
      !> Number of the oscillator
      integer, intent(in) :: i
      !> Period [s]
      real(wp), intent(in) :: period
      !> Damping ratio
      real(wp), intent(in) :: damping

      real(wp) :: rate(4, 4), step(4, 4)

      rate = 0.0_wp
      rate(3, 4) = 1.0_wp
      call set_oscillator(rate, 1, period, damping, swing%dt)
      step = exponential(rate)
      swing%by_u(:, i) = step(:2, 1)
      swing%by_w(:, i) = step(:2, 2)
      swing%by_start(:, i) = step(:2, 3) - step(:2, 4)
      swing%by_end(:, i) = step(:2, 4)
   end subroutine take_oscillator

   !> Rates of the whole state: displacement and velocity of each mode and of the diaphragm, acceleration of the ground and its
   !> rise. A filter of the filtered record would miss that the motion of the floor is not linear within a step
   pure subroutine set_rates(swing, building, modes, rate)
      type(swing_type), intent(in) :: swing
      !> The building, with a diaphragm
      type(building_type), intent(in) :: building
      !> Numbers of the modes
      integer, intent(in) :: modes(:)
      !> In units of a step
      real(wp), allocatable, intent(out) :: rate(:, :)

      integer :: i, last

      last = size(modes) + 1
      allocate (rate(2*last + 2, 2*last + 2), source=0.0_wp)
      rate(2*last + 1, 2*last + 2) = 1.0_wp
      do i = 1, size(modes)
         call set_oscillator(rate, i, building%period(modes(i)), building%damping(modes(i)), swing%dt)
      end do
      call set_oscillator(rate, last, building%diaphragm%period, building%diaphragm%damping, swing%dt)
      do i = 1, size(modes)
         ! The floor, not the ground, moves the diaphragm: by the ground's acceleration and p' d'' of each mode
         rate(2*last, :) = rate(2*last, :) - building%participation_top(modes(i))*rate(2*i, :)
      end do
   end subroutine set_rates

   !> Set what the wall feels: u_g'' + sum P d'' - tau sum (p' - p) d, with d'' = -(u_g'' + damper d' + spring d) and
   !> P = p + k (p' - p), which is p of the floor where no wall is known; the diaphragm d'' is relative to the floor that moves it
   pure subroutine set_felt(swing, building, modes)
      type(swing_type), intent(inout) :: swing
      type(building_type), intent(in) :: building
      !> Numbers of the modes
      integer, intent(in) :: modes(:)

      real(wp), dimension(size(modes) + 1) :: felt, drift, damper, spring
      real(wp) :: of_all(size(building%period))
      integer :: i, n

      n = size(modes)
      of_all = building%felt()
      felt(:n) = of_all(modes)
      of_all = building%drifts()
      drift(:n) = of_all(modes)
      damper(:n) = 4.0_wp*pi*building%damping(modes)*swing%dt/building%period(modes)
      spring(:n) = (2.0_wp*pi*swing%dt/building%period(modes))**2
      if (swing%has_diaphragm) then
         associate (diaphragm => building%diaphragm)
            felt(n + 1) = building%share*diaphragm%participation
            drift(n + 1) = diaphragm%participation
            damper(n + 1) = 4.0_wp*pi*diaphragm%damping*swing%dt/diaphragm%period
            spring(n + 1) = (2.0_wp*pi*swing%dt/diaphragm%period)**2
            ! Its acceleration has -p' d'' of each mode.
            felt(:n) = felt(:n) - felt(n + 1)*building%participation_top(modes)
         end associate
         n = n + 1
      end if
      drift = drift*swing%dt**2
      swing%felt_of_ground = 1.0_wp
      do i = 1, n
         swing%felt_of_ground = swing%felt_of_ground - felt(i)
      end do
      swing%felt_of_w = -felt(:n)*damper(:n)
      swing%felt_of_u = -felt(:n)*spring(:n) - building%tilt*drift(:n)
      swing%drift_of_u = drift(:n)
   end subroutine set_felt

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

end module dondolo_building_swing
