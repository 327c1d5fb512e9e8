!> Random walls with random ties, and what must hold of their histories: above all that energy is balanced from the start to
!> the end, with what ties hold and dissipate as a function of the largest rotation so far.
module tied_history
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use checks, only : check, check_ok
   use dondolo_error, only : error_type
   use dondolo_kinds, only : wp
   use dondolo_mechanism, only : mechanism_type
   use dondolo_random, only : new_random, random_type
   use dondolo_record, only : new_record, record_type
   use dondolo_response, only : response_type, tie_response_type, trace_type
   use dondolo_rk45, only : simulate_rk45
   use dondolo_solver, only : solver_type
   use dondolo_text, only : to_text
   use dondolo_tie, only : tie_type
   use dondolo_travel, only : travel
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   use random_history, only : across, between, choice, history_type, random_record, random_solver
   use same_response, only : is_same
   implicit none
   private

   public :: new_tied_history, check_tied_history, print_ties

   !> Longest time of a history, which no machine should need [s]
   real(wp), parameter :: longest = 10.0_wp

   !> Largest error of the energy / all that is turned over. It is that of the cubics between rows: with four times as many
   !> rows it is a hundredth
   real(wp), parameter :: largest_imbalance = 1.0e-3_wp

   integer :: histories = 0, yielded = 0, broken = 0, collapsed = 0
   real(wp) :: slowest = 0.0_wp, worst = 0.0_wp

contains

   !> The random history of a number
   function new_tied_history(number) result(history)
      integer, intent(in) :: number
      type(history_type) :: history
      type(random_type) :: random
      integer :: i

      random = new_random(number, 0)
      do i = 1, 10
         history%scale = random%next()
      end do
      history%wall = random_tied_wall(random)
      history%record = random_record(random, history%wall%mechanism%trigger_acceleration(), 2 + choice(random, 300))
      history%scale = across(random, 0.3_wp, 3.0_wp)
      history%solver = random_solver(random, history%wall)
   end function new_tied_history

   !> A wall of any size with one to four ties of any kind
   function random_tied_wall(random) result(wall)
      type(random_type), intent(inout) :: random
      type(wall_type) :: wall
      type(wall_input_type) :: input
      type(error_type), allocatable :: error
      real(wp), dimension(4) :: height, depth, area, length, modulus, strength, preload, strain, anchor
      real(wp) :: tall, thick
      integer :: i, n

      tall = across(random, 0.5_wp, 20.0_wp)
      thick = tall/across(random, 5.0_wp, 40.0_wp)
      call input%set('mechanism', 'one_sided')
      call input%set('height', tall)
      call input%set('thickness', thick)
      if (choice(random, 3) == 1) call input%set('hinge_depth', 0.2_wp*random%next()*thick)
      if (choice(random, 4) == 1) call input%set('restitution_factor', between(random, 0.5_wp, 1.0_wp))
      n = choice(random, 4)
      do i = 1, n
         height(i) = tall*between(random, 0.1_wp, 1.0_wp)
         depth(i) = thick*random%next()
         strength(i) = across(random, 1.0e7_wp, 1.0e9_wp)
         modulus(i) = across(random, 1.0e10_wp, 3.0e11_wp)
         strain(i) = min(1.0_wp, strength(i)/modulus(i)*across(random, 1.01_wp, 1.0e3_wp))
         length(i) = across(random, 0.5_wp, 30.0_wp)
         ! Moments from a hundredth to ten times that of the weight
         area(i) = min(1.0e-2_wp, 1.8e4_wp*tall*thick**2/(height(i)*strength(i))*across(random, 1.0e-2_wp, 10.0_wp))
         preload(i) = 0.0_wp
         if (choice(random, 2) == 1) preload(i) = strength(i)*random%next()
         anchor(i) = 1.0e9_wp
         if (choice(random, 4) == 1) anchor(i) = area(i)*between(random, preload(i), strength(i))
      end do
      call input%set('tie_height', height(:n))
      call input%set('tie_depth', depth(:n))
      call input%set('tie_area', area(:n))
      call input%set('tie_length', length(:n))
      call input%set('tie_modulus', modulus(:n))
      call input%set('tie_strength', strength(:n))
      call input%set('tie_preload', preload(:n))
      call input%set('tie_strain', strain(:n))
      call input%set('tie_anchor_force', anchor(:n))
      call new_wall(wall, input, error)
      call check_ok(error, 'random wall with ties')
   end function random_tied_wall

   !> Check what must hold of a history
   subroutine check_tied_history(history, what)
      type(history_type), intent(in) :: history
      character(len=*), intent(in) :: what
      type(response_type) :: response, again
      type(trace_type) :: trace
      type(solver_type) :: tight
      real(wp) :: start, end, limit

      limit = history%solver%edp_limit
      call cpu_time(start)
      call simulate_rk45(history%wall%mechanism, history%record, history%scale, history%solver, response)
      call cpu_time(end)
      slowest = max(slowest, end - start)
      call check(end - start <= longest, what//': seconds '//to_text(end - start))
      call check(ieee_is_finite(response%edp) .and. ieee_is_finite(response%time_of_peak), what//': finite')
      call check(response%edp >= 0.0_wp .and. response%edp <= limit, what//': within the limit')
      call check(response%collapsed .eqv. response%edp == limit, what//': collapsed at the limit')
      call simulate_rk45(history%wall%mechanism, history%record, history%scale, history%solver, again, trace)
      call check(is_same(response, again), what//': the same with a time history')
      call check_ties(history%wall%mechanism, response, trace%ties, what)
      tight%rtol = 1.0e-11_wp
      tight%atol = 1.0e-13_wp
      tight%edp_limit = limit
      call check_energy(history, tight, what)
      histories = histories + 1
      if (response%collapsed) collapsed = collapsed + 1
   end subroutine check_tied_history

   !> What is left of the ties follows from the largest rotation
   subroutine check_ties(mechanism, response, ties, what)
      class(mechanism_type), intent(in) :: mechanism
      type(response_type), intent(in) :: response
      type(tie_response_type), intent(in) :: ties(:)
      character(len=*), intent(in) :: what

      associate (of => mechanism%restraints, edp => response%edp)
         ! A tie that never breaks has a fracture beyond all numbers.
         call check(all(ties%broken .eqv. edp >= min(of%fracture, huge(edp)*mechanism%capacity)/mechanism%capacity), &
            & what//': what breaks')
         call check(all(ties%broken .eqv. ties%time_of_fracture >= 0.0_wp), what//': times of fracture')
         call check(all(ties%time_of_yield < 0.0_wp .or. ties%plastic_elongation >= 0.0_wp), what//': what yields')
         call check(all(ties%plastic_elongation <= 0.0_wp .or. ties%time_of_yield >= 0.0_wp), what//': times of yield')
         call check(all(ties%time_of_fracture >= ties%time_of_yield .or. .not. ties%broken), what//': yields, then breaks')
      end associate
      yielded = yielded + count(ties%plastic_elongation > 0.0_wp)
      broken = broken + count(ties%broken)
   end subroutine check_ties

   !> From the start to the end the ground has done the work that is left, was dissipated or lost at impacts
   subroutine check_energy(history, solver, what)
      type(history_type), intent(in) :: history
      type(solver_type), intent(in) :: solver
      character(len=*), intent(in) :: what
      integer, parameter :: parts = 32
      type(record_type) :: fine
      type(response_type) :: response
      type(trace_type) :: trace
      type(error_type), allocatable :: error
      real(wp), allocatable :: a(:)
      real(wp) :: largest, balance, turnover, change, before, after, work
      integer :: i, k, n

      n = size(history%record%acceleration)
      allocate (a((n - 1)*parts + 1))
      do i = 1, n - 1
         do k = 0, parts - 1
            a((i - 1)*parts + k + 1) = history%record%acceleration(i) + real(k, wp)/real(parts, wp) &
               & *(history%record%acceleration(i + 1) - history%record%acceleration(i))
         end do
      end do
      a(size(a)) = history%record%acceleration(n)
      call new_record(fine, a, history%record%dt/real(parts, wp), 'fine', error)
      call check_ok(error, 'fine record')
      call simulate_rk45(history%wall%mechanism, fine, history%scale, solver, response, trace)
      largest = 0.0_wp
      balance = 0.0_wp
      turnover = 0.0_wp
      do i = 1, trace%rows - 1
         associate (h => trace%time(i + 1) - trace%time(i), q => trace%rotation(i:i + 1), v => trace%velocity(i:i + 1))
            before = kinetic(history%wall%mechanism, q(1), v(1)) + path_energy(history%wall%mechanism, q(1), largest)
            largest = max(largest, q(1), highest(h, q, v))
            after = kinetic(history%wall%mechanism, q(2), v(2)) + path_energy(history%wall%mechanism, q(2), largest)
            change = after - before
            if (.not. h > 0.0_wp) then
               call check(change <= 1.0e-12_wp*before, what//': an impact gives nothing')
               cycle
            end if
            ! It came to rest, with what was left of a bounce.
            if (.not. (q(2) > 0.0_wp .or. v(2) > 0.0_wp .or. v(2) < 0.0_wp)) cycle
            work = work_between(history%wall%mechanism, h, q, v, trace%acceleration(i:i + 1))
            if (trace%time(i) >= fine%duration()) work = 0.0_wp
            balance = balance + change - work
            turnover = turnover + abs(work) + abs(kinetic(history%wall%mechanism, q(2), v(2)) &
               & - kinetic(history%wall%mechanism, q(1), v(1)))
         end associate
      end do
      if (.not. turnover > 0.0_wp) return
      worst = max(worst, abs(balance)/turnover)
      call check(abs(balance) <= largest_imbalance*turnover, what//': energy '//to_text(abs(balance)/turnover))
   end subroutine check_energy

   !> Largest rotation between two rows, of the cubic through them
   real(wp) function highest(h, q, v)
      real(wp), intent(in) :: h, q(2), v(2)
      real(wp) :: a, b, c, x

      highest = maxval(q)
      if (.not. (v(1) > 0.0_wp .and. v(2) < 0.0_wp)) return
      ! q = q1 + h v1 x + b x^2 + a x^3
      a = h*(v(1) + v(2)) - 2.0_wp*(q(2) - q(1))
      b = 3.0_wp*(q(2) - q(1)) - h*(2.0_wp*v(1) + v(2))
      c = h*v(1)
      ! The root of 3 a x^2 + 2 b x + c where the cubic is highest
      x = c/(-b + sqrt(max(0.0_wp, b**2 - 3.0_wp*a*c)))
      highest = max(highest, q(1) + x*(c + x*(b + x*a)))
   end function highest

   !> Kinetic energy
   real(wp) function kinetic(mechanism, q, v)
      class(mechanism_type), intent(in) :: mechanism
      real(wp), intent(in) :: q, v
      real(wp) :: j, c, g, l, load

      call mechanism%terms(q, j, c, g, l, load)
      kinetic = 0.5_wp*j*v**2
   end function kinetic

   !> Work of the ground along the cubic between two rows, by Gauss's rule with three points
   real(wp) function work_between(mechanism, h, q, v, ground) result(work)
      class(mechanism_type), intent(in) :: mechanism
      real(wp), intent(in) :: h, q(2), v(2), ground(2)
      real(wp), parameter :: nodes(3) = 0.5_wp + 0.5_wp*sqrt(0.6_wp)*[-1.0_wp, 0.0_wp, 1.0_wp]
      real(wp), parameter :: weights(3) = [5.0_wp, 8.0_wp, 5.0_wp]/18.0_wp
      real(wp) :: a, b, x, j, c, g, l, load
      integer :: k

      a = h*(v(1) + v(2)) - 2.0_wp*(q(2) - q(1))
      b = 3.0_wp*(q(2) - q(1)) - h*(2.0_wp*v(1) + v(2))
      work = 0.0_wp
      do k = 1, 3
         x = nodes(k)
         call mechanism%terms(max(0.0_wp, q(1) + x*(h*v(1) + x*(b + x*a))), j, c, g, l, load)
         work = work - weights(k)*l*(ground(1) + x*(ground(2) - ground(1)))*(h*v(1) + x*(2.0_wp*b + 3.0_wp*x*a))
      end do
   end function work_between

   !> Energy that the wall and its ties hold, and that the ties have dissipated, at a rotation and a largest one so far
   real(wp) function path_energy(mechanism, q, largest) result(energy)
      class(mechanism_type), intent(in) :: mechanism
      real(wp), intent(in) :: q, largest
      class(mechanism_type), allocatable :: bare
      real(wp) :: nothing(size(mechanism%restraints))
      integer :: i

      nothing = 0.0_wp
      allocate (bare, source=mechanism)
      call bare%hold(nothing, nothing)
      energy = bare%potential(q) - bare%potential(0.0_wp)
      do i = 1, size(mechanism%restraints)
         energy = energy + tie_energy(mechanism%restraints(i), q, max(q, largest))
      end do
   end function path_energy

   !> Of one tie: what it holds, F_y times its set, and what it held when it broke
   real(wp) function tie_energy(tie, q, largest) result(energy)
      type(tie_type), intent(in) :: tie
      real(wp), intent(in) :: q, largest
      real(wp) :: set, force

      if (largest >= tie%fracture) then
         set = tie%fracture_travel - tie%yield_travel
         energy = tie%strength*set + tie%strength**2/(2.0_wp*tie%stiffness)
      else
         set = max(0.0_wp, travel(tie%edge, tie%e, tie%f, largest) - tie%yield_travel)
         force = max(0.0_wp, tie%preload + tie%stiffness*(travel(tie%edge, tie%e, tie%f, q) - set))
         energy = tie%strength*set + force**2/(2.0_wp*tie%stiffness)
      end if
   end function tie_energy

   !> Print what the histories came to
   subroutine print_ties()

      print '(a, es9.2, a, es9.2)', to_text(yielded)//' ties yielded, '//to_text(broken)//' broke, '//to_text(collapsed)// &
         & ' collapses; slowest ', slowest, ' s; energy, worst ', worst
      call check(histories < 100 .or. min(yielded, broken, collapsed) > histories/10, 'ties yield and break, walls fall')
   end subroutine print_ties

end module tied_history
