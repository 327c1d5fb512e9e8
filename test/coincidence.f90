!> Constructed coincidences for the tests: what measure zero forbids and round numbers bring. Levels exactly at the trigger, samples
!> on thresholds, impacts and turning points on samples or at the end of the record, peaks exactly at the limit, at the yield of a
!> tie or where a load loses its seat, walls without weight, plateaus, restitution 0, denormal numbers.
!> A history is made from its number alone.
module coincidence
   use checks, only : check_ok
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_motion_response, only : response_type
   use dondolo_motion_rk45, only : simulate_rk45
   use dondolo_motion_solver, only : check_limit
   use dondolo_record, only : new_record, record_type
   use dondolo_record_random, only : new_random, random_type
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   use random_history, only : across, choice, history_type
   implicit none
   private

   public :: new_coincidence, kind_names

   !> What coincides
   character(len=32), parameter :: kind_names(9) = [character(len=32) :: 'level at the trigger', 'plateaus at the trigger', &
      & 'samples on the thresholds', 'impact on a sample', 'turning point on a sample', 'peak at the limit', &
      & 'collapse in the balance', 'no weight', 'next to nothing']

   real(wp), parameter :: gravity = 9.81_wp, steps(*) = [0.001_wp, 0.002_wp, 0.0025_wp, 0.005_wp, 0.01_wp, 0.02_wp, 0.04_wp, 0.1_wp]

contains

   !> The history of a number, and what coincides in it
   subroutine new_coincidence(number, history, kind)
      integer, intent(in) :: number
      type(history_type), intent(out) :: history
      !> Place in kind_names
      integer, intent(out) :: kind
      type(random_type) :: random
      real(wp) :: trigger
      integer :: i

      random = new_random(number, 0)
      do i = 1, 10
         trigger = random%next()
      end do
      kind = 1 + modulo(number, size(kind_names))
      history%wall = round_wall(random)
      trigger = history%wall%mechanism%trigger_acceleration()
      history%solver%rtol = 10.0_wp**(-5 - choice(random, 6))
      history%solver%atol = 0.01_wp*history%solver%rtol
      select case (choice(random, 6))
      case (1)
         history%solver%edp_limit = 0.05_wp*real(choice(random, 40), wp)
      case (2)
         history%solver%edp_limit = 1.5_wp
      end select
      call keep_limit(history)
      history%scale = real(2*choice(random, 2) - 3, wp)
      select case (kind)
      case (1)
         history%record = decimal_record(random, nint(across(random, 3.0_wp, 1000.0_wp)))
         call scale_to(history, merge(round_level(history%wall), trigger, choice(random, 2) == 1))
      case (2)
         history%record = made_of(random, trigger*[-1.0_wp, -1.0_wp, -1.0_wp, 0.0_wp, 1.0_wp, 1.0_wp], 2 + choice(random, 60), &
            & longest_run=1 + choice(random, 20))
      case (3)
         history%record = made_of(random, trigger*[-2.0_wp, -1.0_wp, -0.5_wp, 0.0_wp, 0.5_wp, 1.0_wp, 2.0_wp], &
            & 2 + choice(random, 60), longest_run=choice(random, 3))
      case (4, 5)
         call put_on_sample(random, trigger, kind == 4, history)
      case (6)
         history%record = decimal_record(random, 20 + choice(random, 100))
         call scale_to(history, trigger*0.25_wp*real(4 + choice(random, 12), wp))
         call limit_at_peak(history)
      case (7)
         history%record = decimal_record(random, 20 + choice(random, 100))
         call balance(trigger, history)
      case (8)
         call take_weight(random, trigger, history)
      case default
         history%record = made_of(random, [0.0_wp, tiny(trigger), -epsilon(trigger)*tiny(trigger), trigger, -trigger, &
            & -nearest(trigger, 1.0_wp), nearest(trigger, 1.0_wp), -nearest(trigger, -1.0_wp)], 2 + choice(random, 60), &
            & longest_run=choice(random, 3))
      end select
      ! A few units in the last place to either side
      if (kind /= 4 .and. kind /= 5 .and. choice(random, 2) == 1) then
         history%scale = history%scale*(1.0_wp + real(choice(random, 9) - 5, wp)*epsilon(1.0_wp))
      end if
   end subroutine new_coincidence

   !> A wall of round measures
   type(wall_type) function round_wall(random) result(wall)
      type(random_type), intent(inout) :: random
      real(wp), parameter :: heights(*) = [1.0_wp, 1.5_wp, 2.0_wp, 2.5_wp, 3.0_wp, 4.0_wp, 5.0_wp, 6.0_wp, 7.5_wp, 10.0_wp]
      real(wp), parameter :: slenderness(*) = [4.0_wp, 5.0_wp, 8.0_wp, 10.0_wp, 12.5_wp, 20.0_wp, 25.0_wp]
      type(wall_input_type) :: input
      type(error_type), allocatable :: error
      real(wp) :: tall, thick
      integer :: kind

      tall = heights(choice(random, size(heights)))
      thick = tall/slenderness(choice(random, size(slenderness)))
      kind = choice(random, 8)
      select case (kind)
      case (1:2)
         call input%set('mechanism', 'one_sided')
      case (3:4)
         call input%set('mechanism', 'free_standing')
      case (5)
         call input%set('mechanism', 'two_block')
         call input%set('hinge', 0.5_wp + 0.05_wp*real(choice(random, 5), wp))
         if (choice(random, 2) == 1) then
            call input%set('overburden', 1.0e4_wp)
            call input%set('overburden_inertia', 0.0_wp)
            call input%set('eccentricity', 0.25_wp*thick*real(choice(random, 5) - 3, wp))
         end if
      case (6)
         call input%set('mechanism', 'one_sided')
         call input%set('load', [1.0e4_wp])
         call input%set('load_depth', [0.5_wp*thick])
         call input%set('load_height', [tall])
         call input%set('load_inertia', 'both')
         if (choice(random, 2) == 1) call input%set('load_seat', [0.1_wp*thick*real(choice(random, 8), wp)])
      case (7)
         call input%set('mechanism', 'one_sided')
         call set_round_ties(random, tall, thick, input)
      case default
         call input%set('mechanism', 'one_sided')
         call input%set('interlock_course', 0.25_wp)
         call input%set('interlock_overlap', 0.1_wp)
         call input%set('interlock_thickness', 0.5_wp)
         call input%set('interlock_spacing', 5.0_wp)
         call input%set('interlock_friction', 0.1_wp*real(choice(random, 6), wp))
      end select
      call input%set('height', tall)
      call input%set('thickness', thick)
      select case (choice(random, 6))
      case (1)
         call input%set('restitution_value', 0.0_wp)
      case (2)
         call input%set('restitution_value', 0.5_wp)
      case (3)
         call input%set('restitution_value', merge(0.999_wp, 0.9_wp, choice(random, 5) == 1))
      end select
      call new_wall(wall, input, error)
      call check_ok(error, 'round wall')
   end function round_wall

   !> Ties, some of which yield or break together, at rest or at once
   subroutine set_round_ties(random, tall, thick, input)
      type(random_type), intent(inout) :: random
      real(wp), intent(in) :: tall, thick
      type(wall_input_type), intent(inout) :: input
      real(wp), parameter :: stress = 200.0e6_wp, modulus = 200.0e9_wp
      real(wp) :: area, preload, strain
      integer :: n

      n = choice(random, 2)
      area = 1.8e4_wp*thick**2/stress*0.25_wp*real(choice(random, 8), wp)
      preload = stress*0.25_wp*real(choice(random, 4) - 1, wp)
      strain = stress/modulus*(1.0_wp + 1.0e-3_wp*10.0_wp**choice(random, 5))
      call input%set('tie_height', spread(0.5_wp*tall, 1, n))
      call input%set('tie_depth', spread(thick, 1, n))
      call input%set('tie_area', spread(area, 1, n))
      call input%set('tie_length', spread(2.0_wp, 1, n))
      call input%set('tie_modulus', spread(modulus, 1, n))
      call input%set('tie_strength', spread(stress, 1, n))
      call input%set('tie_preload', spread(preload, 1, n))
      call input%set('tie_strain', spread(strain, 1, n))
   end subroutine set_round_ties

   !> The limit, unless the wall cannot reach it
   subroutine keep_limit(history)
      type(history_type), intent(inout) :: history
      type(error_type), allocatable :: error

      call check_limit(history%solver, history%wall%mechanism, error)
      if (allocated(error)) history%solver%edp_limit = 1.0_wp
   end subroutine keep_limit

   !> A wave of a few decimals
   type(record_type) function decimal_record(random, n) result(record)
      type(random_type), intent(inout) :: random
      integer, intent(in) :: n
      type(error_type), allocatable :: error
      real(wp) :: a(n), unit, peak, period
      integer :: j

      unit = 10.0_wp**(-choice(random, 7))
      peak = real(choice(random, 40), wp)*0.1_wp
      period = across(random, 3.0_wp, 1000.0_wp)
      a = [(nint(peak*sin(6.28_wp*real(j - choice(random, 2), wp)/period)*sin(3.14_wp*real(j, wp)/real(n, wp))/unit)*unit, j=1, n)]
      if (.not. maxval(abs(a)) > 0.0_wp) a(1 + n/2) = peak
      call new_record(record, a, steps(choice(random, size(steps))), 'decimals', error)
      call check_ok(error, 'decimal record')
   end function decimal_record

   !> A record of few values
   type(record_type) function made_of(random, values, n, longest_run) result(record)
      type(random_type), intent(inout) :: random
      real(wp), intent(in) :: values(:)
      integer, intent(in) :: n
      !> Most times that a value is repeated
      integer, intent(in) :: longest_run
      type(error_type), allocatable :: error
      real(wp) :: a(n)
      integer :: j, k

      j = 0
      do while (j < n)
         k = min(n, j + choice(random, longest_run))
         a(j + 1:k) = values(choice(random, size(values)))
         j = k
      end do
      call new_record(record, a, steps(choice(random, size(steps))), 'few values', error)
      call check_ok(error, 'record of few values')
   end function made_of

   !> Scale a record so that its peak is an acceleration, as levels of PGA do
   subroutine scale_to(history, acceleration)
      type(history_type), intent(inout) :: history
      real(wp), intent(in) :: acceleration

      history%scale = history%scale*acceleration/maxval(abs(history%record%acceleration))
   end subroutine scale_to

   !> The trigger as a number of two decimals in g, as a user would write it
   real(wp) function round_level(wall) result(acceleration)
      type(wall_type), intent(in) :: wall

      acceleration = 0.01_wp*real(max(1, nint(100.0_wp*wall%mechanism%trigger_acceleration()/gravity)), wp)*gravity
   end function round_level

   !> A push, and a time step for which the first impact, or the peak, is on a sample to the last bits, or at the end of the record
   subroutine put_on_sample(random, trigger, at_impact, history)
      type(random_type), intent(inout) :: random
      real(wp), intent(in) :: trigger
      logical, intent(in) :: at_impact
      type(history_type), intent(inout) :: history
      integer, parameter :: n = 60
      type(error_type), allocatable :: error
      real(wp) :: push, low, high, middle
      integer :: pushed, k, i

      push = -trigger*(1.0_wp + 0.25_wp*real(choice(random, 8), wp))
      pushed = 1 + choice(random, 4)
      call new_record(history%record, [spread(push, 1, pushed), spread(0.0_wp, 1, n - pushed)], &
         & steps(choice(random, size(steps))), 'push', error)
      call check_ok(error, 'push')
      history%scale = 1.0_wp
      do k = pushed, n - 4
         if (comes_by(history, k, at_impact)) exit
      end do
      if (k > n - 4) return
      ! It comes by sample k and not by the one before; in samples it comes sooner with a longer time step.
      k = k - 1
      low = history%record%dt
      high = low
      do i = 1, 20
         high = 1.1_wp*high
         history%record%dt = high
         if (comes_by(history, k, at_impact)) exit
      end do
      do i = 1, 60
         middle = 0.5_wp*(low + high)
         history%record%dt = middle
         if (comes_by(history, k, at_impact)) then
            high = middle
         else
            low = middle
         end if
      end do
      history%record%dt = merge(low, high, choice(random, 2) == 1)
      select case (choice(random, 4))
      case (1)
         ! The record ends there.
         history%record%acceleration = history%record%acceleration(:k)
      case (2)
         ! The ground turns there, beyond the trigger or just to it.
         history%record%acceleration(k:) = 0.5_wp*push
         history%record%acceleration(k + 1:) = -trigger
      case (3)
         history%record%acceleration(k:) = trigger*real(choice(random, 3) - 2, wp)
      end select
   end subroutine put_on_sample

   !> Does the first impact, or the peak, come by a sample?
   logical function comes_by(history, sample, at_impact)
      type(history_type), intent(in) :: history
      integer, intent(in) :: sample
      logical, intent(in) :: at_impact
      type(record_type) :: record
      type(response_type) :: response

      record = history%record
      record%acceleration = record%acceleration(:sample)
      call simulate_rk45(history%wall%mechanism, record, history%scale, history%solver, response)
      comes_by = response%impacts > 0
      if (.not. at_impact) comes_by = response%time_of_peak < record%duration()
   end function comes_by

   !> A limit that is just the peak, or a limit at 1 that is met by a change of the record
   subroutine limit_at_peak(history)
      type(history_type), intent(inout) :: history
      type(response_type) :: response

      call simulate_rk45(history%wall%mechanism, history%record, history%scale, history%solver, response)
      if (response%collapsed .or. .not. response%edp > 1.0e-6_wp) return
      history%solver%edp_limit = response%edp
      call keep_limit(history)
   end subroutine limit_at_peak

   !> A scale at which the last bit decides whether the wall collapses
   subroutine balance(trigger, history)
      real(wp), intent(in) :: trigger
      type(history_type), intent(inout) :: history
      type(response_type) :: response
      real(wp) :: low, high
      integer :: i

      call scale_to(history, trigger)
      low = history%scale
      do i = 1, 12
         high = 2.0_wp*low
         history%scale = high
         call simulate_rk45(history%wall%mechanism, history%record, history%scale, history%solver, response)
         if (response%collapsed) exit
         low = high
      end do
      do i = 1, 60
         history%scale = 0.5_wp*(low + high)
         if (history%scale == low .or. history%scale == high) exit
         call simulate_rk45(history%wall%mechanism, history%record, history%scale, history%solver, response)
         if (response%collapsed) then
            high = history%scale
         else
            low = history%scale
         end if
      end do
   end subroutine balance

   !> Vertical motion that takes the weight away, exactly or but for the last bits
   subroutine take_weight(random, trigger, history)
      type(random_type), intent(inout) :: random
      real(wp), intent(in) :: trigger
      type(history_type), intent(inout) :: history
      real(wp), allocatable :: v(:)
      type(record_type) :: vertical

      associate (n => 2 + choice(random, 60))
         history%record = made_of(random, trigger*[-1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], n, longest_run=1 + choice(random, 10))
         vertical = made_of(random, gravity*[-1.0_wp, -1.0_wp, -0.5_wp, 0.0_wp, 1.0_wp], n, longest_run=1 + choice(random, 10))
      end associate
      v = vertical%acceleration
      call move_alloc(v, history%record%vertical)
      if (choice(random, 3) == 1) history%scale = 0.5_wp*history%scale
   end subroutine take_weight

end module coincidence
