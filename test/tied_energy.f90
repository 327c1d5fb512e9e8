!> The energy of a time history of a wall with ties and friction, step by step: from the start to the end the ground has done the
!> work that the wall and its ties hold, that they have dissipated and that was lost at impacts.
!>
!> The modes of the ties follow here from the rotation and the largest one so far, and not from the engine's events. Within a
!> step the modes do not change and the ground acceleration u is linear, so that its work is
!>
!>     - int u L q' dt = - u_2 Lambda(q_2) + u' int Lambda(q) dt,    Lambda(q) = int L dq from q_1,
!>
!> in which only q(t) is interpolated, by the polynomial of degree five through both states.
module tied_energy
   use dondolo_base_kinds, only : wp
   use dondolo_motion_dormand_prince, only : dense_rotation, state_type
   use dondolo_motion_response, only : trace_type
   use dondolo_record, only : record_type
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_restraint, only : restraint_type
   use dondolo_wall_travel, only : lever, travel
   implicit none
   private

   public :: tied_balance_type, tied_balance_of

   !> What a time history with rows at every step says about energy
   type :: tied_balance_type
      !> Sum of the errors of all steps, and all that is turned over: work of the ground and changes of the kinetic energy [J/m]
      real(wp) :: error = 0.0_wp, turnover = 0.0_wp
      !> Largest error of one step / turnover
      real(wp) :: worst_step = 0.0_wp
      !> Row at which that step begins
      integer :: worst_row = 0
      !> Impacts after which the wall is faster than e times its speed before
      integer :: wrong_impacts = 0
      !> Steps with flowing ties, with slack ones and with flowing friction
      integer :: flowing = 0, slack = 0, sliding = 0
      !> Those in which friction holds the wall out, and those in which nothing could
      integer :: held = 0, groundless = 0
   end type tied_balance_type

   !> One step: its length, states at both ends, ground acceleration at its start and its rate of change
   type :: step_type
      real(wp) :: h = 0.0_wp
      type(state_type) :: first, last
      real(wp) :: ground = 0.0_wp, slope = 0.0_wp
   end type step_type

   !> Nodes and weights of Gauss's rule with five points on (0, 1)
   real(wp), parameter :: outer = 0.906179845938663992797626878299_wp, inner = 0.538469310105683091036314420700_wp
   real(wp), parameter :: nodes(5) = 0.5_wp + 0.5_wp*[-outer, -inner, 0.0_wp, inner, outer]
   real(wp), parameter :: light = 0.236926885056189087514264040720_wp, heavy = 0.478628670499366468041291514836_wp
   real(wp), parameter :: weights(5) = 0.5_wp*[light, heavy, 128.0_wp/225.0_wp, heavy, light]

contains

   !> Go through the rows of a time history with rows at every step
   function tied_balance_of(mechanism, record, scale, trace) result(balance)
      !> The wall as built
      class(mechanism_type), intent(in) :: mechanism
      type(record_type), intent(in) :: record
      !> Factor on it
      real(wp), intent(in) :: scale
      type(trace_type), intent(in) :: trace
      type(tied_balance_type) :: balance
      class(mechanism_type), allocatable :: bare, held
      type(step_type) :: step
      real(wp), dimension(size(mechanism%restraints)) :: force, stiffness
      real(wp) :: largest, error, worst
      integer :: i, interval

      allocate (bare, held, source=mechanism)
      force = 0.0_wp
      call bare%set_restraints(force, force)
      largest = 0.0_wp
      worst = 0.0_wp
      do i = 1, trace%rows - 1
         associate (q => trace%rotation(i:i + 1), v => trace%velocity(i:i + 1))
            step%h = trace%time(i + 1) - trace%time(i)
            if (trace%after_impact(i + 1)) then
               if (abs(v(2)) > mechanism%restitution*abs(v(1))) balance%wrong_impacts = balance%wrong_impacts + 1
               cycle
            end if
            ! At rest, or it came to rest in a chain of bounces, each of which loses some of what is left.
            if (maxval(abs(q)) <= 0.0_wp .and. abs(v(2)) <= 0.0_wp) cycle
            if (abs(q(2) - q(1)) <= 0.0_wp .and. maxval(abs(v)) <= 0.0_wp .and. step%h > 0.0_wp) then
               ! Friction holds it where it is, and nothing does any work.
               if (size(mechanism%restraints) == mechanism%ties) balance%groundless = balance%groundless + 1
               balance%held = balance%held + 1
               cycle
            end if
            step%first = state_type(q(1), v(1), 0.0_wp)
            step%last = state_type(q(2), v(2), 0.0_wp)
            interval = 1 + int(0.5_wp*(trace%time(i) + trace%time(i + 1))/record%dt)
            step%ground = 0.0_wp
            step%slope = 0.0_wp
            if (interval < size(record%acceleration)) then
               step%ground = trace%acceleration(i)
               step%slope = scale*(record%acceleration(interval + 1) - record%acceleration(interval))/record%dt
            end if
            call pull_along(mechanism%restraints, q, largest, force, stiffness, balance)
            call held%set_restraints(force, stiffness)
            call close_step(bare, held, force, stiffness, step, balance, error)
            if (abs(error) > worst) then
               worst = abs(error)
               balance%worst_row = i
            end if
            largest = max(largest, q(2))
         end associate
      end do
      if (balance%turnover > 0.0_wp) balance%worst_step = worst/balance%turnover
   end function tied_balance_of

   !> Forces of the ties in a step, T = force + stiffness D, from the largest rotation before it alone
   subroutine pull_along(restraints, q, largest, force, stiffness, balance)
      type(restraint_type), intent(in) :: restraints(:)
      !> Rotations at both ends, and the largest before [rad]
      real(wp), intent(in) :: q(2), largest
      real(wp), intent(out) :: force(:), stiffness(:)
      type(tied_balance_type), intent(inout) :: balance
      real(wp) :: set, middle
      integer :: i

      middle = 0.5_wp*(q(1) + q(2))
      force = 0.0_wp
      stiffness = 0.0_wp
      do i = 1, size(restraints)
         associate (tie => restraints(i))
            if (largest >= tie%fracture) cycle
            if (tie%is_friction) then
               if (.not. (q(2) > q(1) .and. middle > largest)) cycle
               balance%sliding = balance%sliding + 1
               force(i) = tie%strength
               stiffness(i) = -tie%strength/tie%fracture_travel
            else if (q(2) > q(1) .and. middle > largest .and. middle > tie%yield) then
               balance%flowing = balance%flowing + 1
               force(i) = tie%strength
            else
               set = max(0.0_wp, travel(tie%edge, tie%e, tie%f, largest) - tie%yield_travel)
               if (tie%preload + tie%stiffness*(travel(tie%edge, tie%e, tie%f, middle) - set) > 0.0_wp) then
                  force(i) = tie%preload - tie%stiffness*set
                  stiffness(i) = tie%stiffness
               else
                  balance%slack = balance%slack + 1
               end if
            end if
         end associate
      end do
   end subroutine pull_along

   !> Error of the energy in one step
   subroutine close_step(bare, held, force, stiffness, step, balance, error)
      !> The wall without ties, and held by them
      class(mechanism_type), intent(in) :: bare, held
      !> T = force + stiffness D of each tie
      real(wp), intent(in) :: force(:), stiffness(:)
      type(step_type), intent(inout) :: step
      type(tied_balance_type), intent(inout) :: balance
      !> What is missing [J/m]
      real(wp), intent(out) :: error
      real(wp) :: b(0:5), kinetic(2), held_back, work, j(2), q, x, power
      integer :: k

      associate (first => step%first, last => step%last, h => step%h)
         first%f = acceleration(held, step, 0.0_wp, first)
         last%f = acceleration(held, step, h, last)
         ! Rotations from that at the start: their differences are small
         b = dense_rotation(h, state_type(0.0_wp, first%v, first%f), state_type(last%q - first%q, last%v, last%f))
         j = [inertia(bare, first%q), inertia(bare, last%q)]
         kinetic = 0.5_wp*j*[first%v, last%v]**2
         held_back = 0.0_wp
         power = 0.0_wp
         do k = 1, size(nodes)
            q = first%q + nodes(k)*(last%q - first%q)
            held_back = held_back + weights(k)*(last%q - first%q)*moment(bare, force, stiffness, q)
            x = de_casteljau(b, nodes(k))
            power = power + weights(k)*h*levers(bare, first%q, x)
         end do
         work = step%slope*power - (step%ground + step%slope*h)*levers(bare, first%q, last%q - first%q)
         error = kinetic(2) - kinetic(1) + held_back - work
         balance%error = balance%error + error
         balance%turnover = balance%turnover + abs(work) + abs(kinetic(2) - kinetic(1))
      end associate
   end subroutine close_step

   !> Angular acceleration at a time since the start of a step
   real(wp) function acceleration(held, step, time, state)
      class(mechanism_type), intent(in) :: held
      type(step_type), intent(in) :: step
      real(wp), intent(in) :: time
      type(state_type), intent(in) :: state
      real(wp) :: j, c, g, l, load

      call held%terms(state%q, j, c, g, l, load)
      acceleration = (load - g - l*(step%ground + step%slope*time) - c*state%v**2)/j
   end function acceleration

   !> Inertia
   real(wp) function inertia(bare, q)
      class(mechanism_type), intent(in) :: bare
      real(wp), intent(in) :: q
      real(wp) :: c, g, l, load

      call bare%terms(q, inertia, c, g, l, load)
   end function inertia

   !> Moment that holds the wall back: of gravity, and of its ties
   real(wp) function moment(bare, force, stiffness, q)
      class(mechanism_type), intent(in) :: bare
      real(wp), intent(in) :: force(:), stiffness(:), q
      real(wp) :: j, c, g, l, load

      call bare%terms(q, j, c, g, l, load)
      associate (tie => bare%restraints)
         moment = g - load + sum((force + stiffness*travel(tie%edge, tie%e, tie%f, q))*lever(tie%edge, tie%e, tie%f, q))
      end associate
   end function moment

   !> Lambda: integral of L from a rotation, over a way
   real(wp) function levers(bare, from, way)
      class(mechanism_type), intent(in) :: bare
      real(wp), intent(in) :: from, way
      real(wp), parameter :: three(3) = 0.5_wp + 0.5_wp*sqrt(0.6_wp)*[-1.0_wp, 0.0_wp, 1.0_wp]
      real(wp), parameter :: weight(3) = [5.0_wp, 8.0_wp, 5.0_wp]/18.0_wp
      real(wp) :: j, c, g, l, load
      integer :: k

      levers = 0.0_wp
      do k = 1, 3
         call bare%terms(max(0.0_wp, from + three(k)*way), j, c, g, l, load)
         levers = levers + weight(k)*l*way
      end do
   end function levers

   !> Polynomial in Bernstein form
   pure real(wp) function de_casteljau(b, x) result(value)
      real(wp), intent(in) :: b(0:), x
      real(wp) :: c(0:ubound(b, 1))
      integer :: m

      c = b
      do m = ubound(b, 1), 1, -1
         c(:m - 1) = (1.0_wp - x)*c(:m - 1) + x*c(1:m)
      end do
      value = c(0)
   end function de_casteljau

end module tied_energy
