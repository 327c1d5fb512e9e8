!> Random walls with random ties, and what must hold of their histories: above all that energy is balanced from the start to
!> the end, with what ties hold and dissipate as a function of the largest rotation so far.
module tied_history
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use checks, only : check, check_ok
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_motion_response, only : response_type, tie_response_type, trace_type
   use dondolo_motion_rk45, only : simulate_rk45
   use dondolo_motion_solver, only : solver_type
   use dondolo_record_random, only : new_random, random_type
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_restraint, only : tie_input_type
   use random_history, only : across, between, choice, history_type, random_record, random_solver
   use same_response, only : is_same
   use tied_energy, only : tied_balance_of, tied_balance_type
   implicit none
   private

   public :: new_tied_history, check_tied_history, print_ties

   !> Longest time of a history, which no machine should need [s]
   real(wp), parameter :: longest = 10.0_wp

   !> Largest error of the energy / all that is turned over
   real(wp), parameter :: largest_imbalance = 1.0e-9_wp

   !> Numbers of histories, of ties, and of histories with each kind of step
   integer :: histories = 0, yielded = 0, broken = 0, collapsed = 0, flowing = 0, slack = 0, sliding = 0, held = 0
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

   !> A wall of any size that ties of any kind hold, or friction, or both
   function random_tied_wall(random) result(wall)
      type(random_type), intent(inout) :: random
      type(wall_type) :: wall
      type(wall_input_type) :: input, wrong
      type(tie_input_type), allocatable :: ties(:)
      type(error_type), allocatable :: error
      real(wp) :: tall, thick
      integer :: kind, i

      tall = across(random, 0.5_wp, 20.0_wp)
      thick = tall/across(random, 5.0_wp, 40.0_wp)
      call input%set('mechanism', 'one_sided')
      call input%set('height', tall)
      call input%set('thickness', thick)
      if (choice(random, 3) == 1) call input%set('hinge_depth', 0.2_wp*random%next()*thick)
      if (choice(random, 4) == 1) call input%set('restitution_factor', between(random, 0.5_wp, 1.0_wp))
      kind = choice(random, 10)
      ! Friction with ties, and without
      if (kind <= 3) call add_interlocking(random, tall, input)
      select case (kind)
      case (1)
         allocate (ties(0))
      case (4)
         ! All at one height, where they yield together or one after the other
         allocate (ties(10))
         ties%height = tall*between(random, 0.1_wp, 1.0_wp)
      case default
         allocate (ties(choice(random, 4)))
         do i = 1, size(ties)
            ties(i)%height = tall*between(random, 0.1_wp, 1.0_wp)
         end do
      end select
      do i = 1, size(ties)
         call fill_in(random, tall, thick, ties(i))
      end do
      ! Some are one and the same
      if (kind == 4 .and. choice(random, 2) == 1) ties = ties(1)
      if (size(ties) > 0) call set_ties(input, ties)
      call new_wall(wall, input, error)
      call check_ok(error, 'random wall with ties')
      if (size(ties) == 0) return
      wrong = input
      i = choice(random, size(ties))
      if (choice(random, 2) == 1) then
         ties(i)%preload = ties(i)%strength*across(random, 1.0_wp, 10.0_wp)
         call set_ties(wrong, ties)
         call refuse(wrong, ': its tie_preload')
      else
         ties(i)%height = 0.0_wp
         call set_ties(wrong, ties)
         call refuse(wrong, ': its tie_height')
      end if
   end function random_tied_wall

   !> Anything of a tie but its height
   subroutine fill_in(random, tall, thick, tie)
      type(random_type), intent(inout) :: random
      !> Height and thickness of the wall [m]
      real(wp), intent(in) :: tall, thick
      type(tie_input_type), intent(inout) :: tie

      tie%depth = thick*random%next()
      tie%strength = across(random, 1.0e7_wp, 1.0e9_wp)
      tie%modulus = across(random, 1.0e10_wp, 3.0e11_wp)
      tie%strain = min(1.0_wp, tie%strength/tie%modulus*across(random, 1.01_wp, 1.0e3_wp))
      tie%length = across(random, 0.5_wp, 30.0_wp)
      ! Moments from a hundredth to ten times that of the weight
      tie%area = min(1.0e-2_wp, 1.8e4_wp*tall*thick**2/(tie%height*tie%strength)*across(random, 1.0e-2_wp, 10.0_wp))
      tie%anchor_force = 1.0e9_wp
      select case (choice(random, 8))
      case (1:3)
         tie%preload = tie%strength*random%next()
      case (4)
         ! It yields as soon as the wall moves, or almost, and may break at once too.
         tie%preload = tie%strength*(1.0_wp - across(random, 1.0e-15_wp, 1.0e-2_wp))
         if (choice(random, 2) == 1) tie%strain = tie%strength/tie%modulus*(1.0_wp + across(random, 1.0e-14_wp, 1.0e-2_wp))
      end select
      if (choice(random, 4) == 1) tie%anchor_force = tie%area*between(random, tie%preload, tie%strength)
      ! A quarter of these give way in the first motion.
      if (choice(random, 16) == 1) tie%anchor_force = tie%area*tie%preload*(1.0_wp + across(random, 1.0e-15_wp, 1.0e-2_wp))
      if (.not. tie%anchor_force > tie%area*tie%preload) tie%anchor_force = 1.0e9_wp
   end subroutine fill_in

   !> Enter ties
   subroutine set_ties(input, ties)
      type(wall_input_type), intent(inout) :: input
      type(tie_input_type), intent(in) :: ties(:)

      call input%set('tie_height', [ties%height])
      call input%set('tie_depth', [ties%depth])
      call input%set('tie_area', [ties%area])
      call input%set('tie_length', [ties%length])
      call input%set('tie_modulus', [ties%modulus])
      call input%set('tie_strength', [ties%strength])
      call input%set('tie_preload', [ties%preload])
      call input%set('tie_strain', [ties%strain])
      call input%set('tie_anchor_force', [ties%anchor_force])
   end subroutine set_ties

   !> Transverse walls whose stones overlap those of the wall by much or next to nothing
   subroutine add_interlocking(random, tall, input)
      type(random_type), intent(inout) :: random
      !> Height of the wall [m]
      real(wp), intent(in) :: tall
      type(wall_input_type), intent(inout) :: input

      call input%set('interlock_course', tall/across(random, 1.0_wp, 60.0_wp))
      call input%set('interlock_overlap', across(random, 1.0e-3_wp, 1.0_wp))
      call input%set('interlock_thickness', across(random, 0.1_wp, 1.0_wp))
      call input%set('interlock_spacing', across(random, 1.0_wp, 20.0_wp))
      if (choice(random, 2) == 1) call input%set('interlock_friction', across(random, 0.05_wp, 2.0_wp))
   end subroutine add_interlocking

   !> A wall that must be refused for what it says of a tie
   subroutine refuse(input, why)
      type(wall_input_type), intent(in) :: input
      character(len=*), intent(in) :: why
      type(wall_type) :: wall
      type(error_type), allocatable :: error

      call new_wall(wall, input, error)
      call check(allocated(error), 'refused'//why)
      if (allocated(error)) call check(index(error%message, why) > 0, 'refused'//why//', not '//error%message)
   end subroutine refuse

   !> Check what must hold of a history
   subroutine check_tied_history(history, what)
      type(history_type), intent(in) :: history
      character(len=*), intent(in) :: what
      type(response_type) :: response, again
      type(trace_type) :: trace
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
      call check_energy(history, what)
      histories = histories + 1
      if (response%collapsed) collapsed = collapsed + 1
   end subroutine check_tied_history

   !> What is left of the ties follows from the largest rotation
   subroutine check_ties(mechanism, response, ties, what)
      class(mechanism_type), intent(in) :: mechanism
      type(response_type), intent(in) :: response
      type(tie_response_type), intent(in) :: ties(:)
      character(len=*), intent(in) :: what

      associate (of => mechanism%restraints(:mechanism%ties), edp => response%edp)
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
   subroutine check_energy(history, what)
      type(history_type), intent(in) :: history
      character(len=*), intent(in) :: what
      type(solver_type) :: tight
      type(response_type) :: response
      type(trace_type) :: trace
      type(tied_balance_type) :: balance

      tight%rtol = 1.0e-13_wp
      tight%atol = 1.0e-15_wp
      tight%edp_limit = history%solver%edp_limit
      trace%every_step = .true.
      call simulate_rk45(history%wall%mechanism, history%record, history%scale, tight, response, trace)
      balance = tied_balance_of(history%wall%mechanism, history%record, history%scale, trace)
      call check(balance%wrong_impacts == 0, what//': an impact leaves at most e times the speed')
      call check(balance%groundless == 0, what//': without friction nothing holds it out')
      if (.not. balance%turnover > 0.0_wp) return
      worst = max(worst, abs(balance%error)/balance%turnover)
      call check(abs(balance%error) <= largest_imbalance*balance%turnover, what//': energy '// &
         & to_text(balance%error/balance%turnover)//', most of it '//to_text(balance%worst_step)//' at row '// &
         & to_text(balance%worst_row)//' of '//to_text(trace%rows))
      flowing = flowing + min(1, balance%flowing)
      slack = slack + min(1, balance%slack)
      sliding = sliding + min(1, balance%sliding)
      held = held + min(1, balance%held)
   end subroutine check_energy

   !> Print what the histories came to
   subroutine print_ties()

      print '(a, es9.2, a, es9.2)', to_text(yielded)//' ties yielded, '//to_text(broken)//' broke, '//to_text(collapsed)// &
         & ' collapses; '//to_text(held)//' held out; slowest ', slowest, ' s; energy, worst ', worst
      if (histories < 100) return
      call check(min(yielded, broken, collapsed) > histories/10, 'ties yield and break, walls fall')
      call check(min(flowing, slack, sliding) > histories/20, 'ties flow and are slack, friction rubs')
      ! Some 14 of 1000 are, by chance fewer than 10 in one part of a thousand out of seven.
      call check(held > histories/400, 'friction holds walls out')
   end subroutine print_ties

end module tied_history
