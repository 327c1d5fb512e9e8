!> Random histories for the tests: any wall, record, scale and solver that the program accepts, and edges on purpose.
!> A history is made from its number alone, so one that fails can be run again by itself.
module random_history
   use checks, only : check_ok
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_motion_solver, only : check_limit, check_solver, solver_type
   use dondolo_record, only : largest_acceleration, new_record, record_type
   use dondolo_record_random, only : new_random, random_type
   use dondolo_wall, only : mechanism_names, new_wall, wall_input_type, wall_type
   implicit none
   private

   public :: history_type, new_history, random_wall, random_record, random_solver
   public :: across, argument, between, choice

   !> What one history is computed from
   type :: history_type
      type(wall_type) :: wall
      type(record_type) :: record
      real(wp) :: scale = 1.0_wp
      type(solver_type) :: solver
   end type history_type

contains

   !> The random history of a number
   function new_history(number) result(history)
      integer, intent(in) :: number
      type(history_type) :: history
      type(random_type) :: random
      integer :: i

      random = new_random(number, 0)
      ! Seeds that are neighbours begin alike
      do i = 1, 10
         history%scale = random%next()
      end do
      history%wall = random_wall(random)
      history%record = random_record(random, history%wall%mechanism%trigger_acceleration(), &
         & merge(2, 2 + choice(random, 600), choice(random, 8) == 1))
      history%scale = real(2*choice(random, 2) - 3, wp)
      if (choice(random, 2) == 1) history%scale = history%scale*across(random, 0.5_wp, 2.0_wp)
      history%solver = random_solver(random, history%wall)
   end function new_history

   !> A number among the arguments of the program
   integer function argument(position, default)
      integer, intent(in) :: position, default
      character(len=12) :: text

      argument = default
      call get_command_argument(position, text)
      if (text /= '') read (text, *) argument
   end function argument

   !> Uniform number between two bounds
   real(wp) function between(random, low, high)
      type(random_type), intent(inout) :: random
      real(wp), intent(in) :: low, high

      between = low + (high - low)*random%next()
   end function between

   !> Number between two bounds, uniform in its logarithm
   real(wp) function across(random, low, high)
      type(random_type), intent(inout) :: random
      real(wp), intent(in) :: low, high

      across = exp(between(random, log(low), log(high)))
   end function across

   !> One of n choices
   integer function choice(random, n)
      type(random_type), intent(inout) :: random
      integer, intent(in) :: n

      choice = min(n, 1 + int(random%next()*n))
   end function choice

   !> A wall of any size, shape and restitution
   function random_wall(random) result(wall)
      type(random_type), intent(inout) :: random
      type(wall_type) :: wall
      type(wall_input_type) :: input
      type(error_type), allocatable :: error

      call input%set('mechanism', trim(mechanism_names(choice(random, 3))))
      call input%set('height', across(random, 0.2_wp, 30.0_wp))
      call input%set('thickness', input%number('height')/across(random, 2.0_wp, 60.0_wp))
      if (input%word('mechanism') == 'two_block') then
         call input%set('hinge', between(random, 0.05_wp, 0.95_wp))
         if (choice(random, 2) == 1) call input%set('overburden', across(random, 1.0_wp, 1.0e5_wp))
         call input%set('overburden_inertia', 0.0_wp)
         call input%set('eccentricity', 0.5_wp*input%number('thickness'))
         select case (choice(random, 4))
         case (1)
            call input%set('eccentricity', -input%number('eccentricity'))
         case (2)
            call input%set('eccentricity', between(random, -1.0_wp, 1.0_wp)*input%number('eccentricity'))
         end select
      end if
      select case (choice(random, 6))
      case (1)
         call input%set('restitution_value', 0.0_wp)
      case (2)
         call input%set('restitution_value', 1.0_wp - across(random, 1.0e-4_wp, 1.0_wp))
      case default
         call input%set('restitution_factor', between(random, 0.5_wp, 1.0_wp))
      end select
      call new_wall(wall, input, error)
      call check_ok(error, 'random wall')
   end function random_wall

   !> Noise, waves, plateaus and spikes, and values exactly at the threshold
   function random_record(random, trigger, n) result(record)
      type(random_type), intent(inout) :: random
      real(wp), intent(in) :: trigger
      integer, intent(in) :: n
      type(record_type) :: record
      type(error_type), allocatable :: error
      real(wp), allocatable :: a(:)
      real(wp) :: peak, edge
      integer :: j

      allocate(a(n))
      peak = min(trigger*across(random, 0.5_wp, 50.0_wp), 98.1_wp)
      if (choice(random, 20) == 1) peak = 0.9_wp*largest_acceleration
      edge = min(trigger, 0.5_wp*largest_acceleration)
      select case (choice(random, 6))
      case (1)
         a = [(peak*between(random, -1.0_wp, 1.0_wp), j=1, n)]
      case (2)
         a = [(peak*sin(0.05_wp*j)*sin(0.37_wp*j)*exp(-((j - 0.4_wp*n)/(0.2_wp*n))**2), j=1, n)]
      case (3)
         ! Only -1, 0 and 1 times the trigger: the motion starts, and stops, on the edge
         a = [(edge*real(choice(random, 3) - 2, wp), j=1, n)]
      case (4)
         a = [(peak*real(choice(random, 3) - 2, wp)*merge(1.0_wp, 0.0_wp, choice(random, 5) == 1), j=1, n)]
      case (5)
         ! One spike in a record that is otherwise just below the threshold
         a = [((1.0_wp - epsilon(edge))*edge*sign(1.0_wp, random%next() - 0.5_wp), j=1, n)]
         a(choice(random, n)) = peak
      case default
         ! Pulses with quiet in between, as smooth as a filtered record
         a = [(peak*sin(0.02_wp*j)*max(0.0_wp, sin(0.003_wp*j))**2, j=1, n)]
      end select
      call new_record(record, a, across(random, 5.0e-4_wp, 5.0e-2_wp), 'random', error)
      call check_ok(error, 'random record')
   end function random_record

   !> Tolerances that have nothing to do with each other, and a limit that the wall can reach
   function random_solver(random, wall) result(solver)
      type(random_type), intent(inout) :: random
      type(wall_type), intent(in) :: wall
      type(solver_type) :: solver
      type(error_type), allocatable :: error

      solver%rtol = across(random, 1.0e-12_wp, 1.0e-2_wp)
      solver%atol = across(random, 1.0e-16_wp, 1.0e-2_wp)
      if (choice(random, 3) > 1) solver%edp_limit = across(random, 0.01_wp, 3.0_wp)
      if (choice(random, 20) == 1) solver%edp_limit = (1.0_wp - across(random, 1.0e-15_wp, 1.0e-2_wp)) &
         & *wall%mechanism%geometric_end()/wall%mechanism%capacity
      call check_limit(solver, wall%mechanism, error)
      if (allocated(error)) solver%edp_limit = 1.0_wp
      call check_solver(solver, error)
      call check_ok(error, 'random solver')
   end function random_solver

end module random_history
