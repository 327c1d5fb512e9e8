!> A block that rocks on either edge of its base before a surface that turns with the building, which it cannot enter.
module facade
   use rocking_wall, only : gravity, shortest, state_type, wall_type
   use support_motion, only : base, delta, rise, rk, speed
   implicit none
   private

   public :: facade_type, new_facade, tie_type

   !> On the surface and its outer edge, on its whole base, on its outer or inner edge, on the surface and its inner edge
   integer, parameter :: outer_contact = 0, standing = 1, outer = 2, inner = 3, inner_contact = 4

   !> Events: the surface is met, the edge changes, the tie no longer grows, the tie breaks
   integer, parameter :: met = 1, edge_changes = 2, flow_ends = 3, breaks = 4

   !> An elastic, perfectly plastic tie that cannot push, anchored to the building: height in m, stiffness in N/m and
   !> forces in N for each m of wall, elongation at which it breaks in m
   type :: tie_type
      real(rk) :: height = 0.0_rk
      real(rk) :: stiffness = 0.0_rk
      real(rk) :: preload = 0.0_rk
      real(rk) :: strength = 0.0_rk
      real(rk) :: longest = 0.0_rk
   end type tie_type

   !> y is the rotation outwards from the vertical
   type, extends(wall_type) :: facade_type
      private
      type(tie_type) :: tie
      !> Elongation at which the tie yields, m
      real(rk) :: yields = 0.0_rk
      !> Mass times distance of the centroid from an edge, across and up, kg m for each m, and inertia about it
      real(rk) :: across = 0.0_rk
      real(rk) :: up = 0.0_rk
      real(rk) :: inertia = 0.0_rk
      !> Ratios of speeds where the edge changes, and on the surface
      real(rk) :: edge_ratio = 0.0_rk
      real(rk) :: surface_ratio = 0.0_rk
   contains
      procedure :: moves
      procedure :: rate
      procedure :: urge
      procedure :: leave
      procedure :: carry
      procedure :: level
      procedure :: counts
      procedure :: jump
   end type facade_type

contains

   !> Height, thickness and height of the surface in m, density in kg/m3; a tie of stiffness 0 is none
   pure function new_facade(height, thickness, span, density, tie) result(wall)
      real(rk), intent(in) :: height, thickness, span, density
      type(tie_type), intent(in) :: tie
      type(facade_type) :: wall
      real(rk) :: mass, radius, sine2

      wall%urges = 3
      wall%levels = 2
      wall%span = span
      wall%tie = tie
      if (tie%stiffness > 0.0_rk) then
         wall%levels = 4
         wall%yields = (tie%strength - tie%preload)/tie%stiffness
      end if
      radius = 0.5_rk*hypot(height, thickness)
      mass = density*height*thickness
      wall%limit = atan2(thickness, height)
      wall%across = 0.5_rk*mass*thickness
      wall%up = 0.5_rk*mass*height
      wall%inertia = 4.0_rk/3.0_rk*mass*radius**2
      sine2 = sin(wall%limit)**2
      wall%edge_ratio = 1.0_rk - 1.5_rk*sine2
      wall%surface_ratio = max(0.0_rk, -wall%edge_ratio**2*(1.0_rk - 1.5_rk*(1.0_rk - sine2)))
   end function new_facade

   pure logical function moves(wall, mode)
      class(facade_type), intent(in) :: wall
      integer, intent(in) :: mode

      moves = mode == outer .or. mode == inner
   end function moves

   pure function rate(wall, state, y, v, x) result(a)
      class(facade_type), intent(in) :: wall
      type(state_type), intent(in) :: state
      real(rk), intent(in) :: y, v, x(4)
      real(rk) :: a

      a = about(wall, state%mode == inner .or. state%mode == inner_contact, state%most, y, x)
   end function rate

   !> Angular acceleration about the inner or outer edge
   pure real(rk) function about(wall, inner_edge, most, q, x)
      type(facade_type), intent(in) :: wall
      logical, intent(in) :: inner_edge
      real(rk), intent(in) :: most, q, x(4)
      real(rk) :: edge, sine, cosine, pull, plastic

      edge = merge(-1.0_rk, 1.0_rk, inner_edge)
      sine = sin(q)
      cosine = cos(q)
      pull = 0.0_rk
      if (wall%tie%stiffness > 0.0_rk .and. most < wall%tie%longest) then
         plastic = max(0.0_rk, most - wall%yields)
         pull = wall%tie%preload + wall%tie%stiffness*(wall%tie%height*(sine - x(delta)/wall%span) - plastic)
         pull = min(max(pull, 0.0_rk), wall%tie%strength)*wall%tie%height*cosine
      end if
      ! Sine and cosine of limit - edge q, times the weight
      about = -(gravity*(edge*wall%across*cosine - wall%up*sine) + pull + (wall%up*cosine + edge*wall%across*sine)*x(base)) &
         & /wall%inertia
   end function about

   pure real(rk) function elongation(wall, q, x)
      type(facade_type), intent(in) :: wall
      real(rk), intent(in) :: q, x(4)

      elongation = wall%tie%height*(sin(q) - x(delta)/wall%span)
   end function elongation

   !> 1: it leaves outwards, 2: from its base inwards; 3: the surface passes through the vertical
   pure function urge(wall, number, state, x) result(a)
      class(facade_type), intent(in) :: wall
      integer, intent(in) :: number
      type(state_type), intent(in) :: state
      real(rk), intent(in) :: x(4)
      real(rk) :: a

      select case (number)
      case (1)
         if (state%mode == standing) then
            a = about(wall, .false., state%most, 0.0_rk, x)
         else
            a = about(wall, state%mode == inner_contact, state%most, x(delta)/wall%span, x) - x(rise)/wall%span
         end if
      case (2)
         a = -1.0_rk
         if (state%mode == standing) a = -about(wall, .true., state%most, 0.0_rk, x)
      case default
         a = x(delta)
         if (state%mode == outer_contact) a = -a
      end select
   end function urge

   pure subroutine leave(wall, number, state, x)
      class(facade_type), intent(in) :: wall
      integer, intent(in) :: number
      type(state_type), intent(inout) :: state
      real(rk), intent(in) :: x(4)

      call wall%carry(state, x)
      select case (number)
      case (1)
         state%mode = merge(inner, outer, state%mode == inner_contact)
      case (2)
         state%mode = inner
      case default
         state%y = 0.0_rk
         select case (state%mode)
         case (outer_contact)
            ! The surface goes on inwards, the wall over its other edge
            state%mode = inner
            state%v = wall%edge_ratio*x(speed)/wall%span
         case (inner_contact)
            state%mode = outer_contact
         case default
            ! The surface comes and kicks it
            state%mode = outer
            state%v = (1.0_rk + wall%surface_ratio)*x(speed)/wall%span
         end select
      end select
   end subroutine leave

   pure subroutine carry(wall, state, x)
      class(facade_type), intent(in) :: wall
      type(state_type), intent(inout) :: state
      real(rk), intent(in) :: x(4)

      if (.not. wall%moves(state%mode)) then
         state%y = 0.0_rk
         state%v = 0.0_rk
         if (state%mode /= standing) then
            state%y = x(delta)/wall%span
            state%v = x(speed)/wall%span
         end if
      end if
      if (wall%tie%stiffness > 0.0_rk) state%most = max(state%most, elongation(wall, state%y, x))
   end subroutine carry

   pure subroutine level(wall, number, state, y, v, a, x, g, slope)
      class(facade_type), intent(in) :: wall
      integer, intent(in) :: number
      type(state_type), intent(in) :: state
      real(rk), intent(in) :: y, v, a, x(4)
      real(rk), intent(out) :: g, slope

      select case (number)
      case (met)
         g = y - x(delta)/wall%span
         slope = v - x(speed)/wall%span
      case (edge_changes)
         g = merge(-y, y, state%mode == inner)
         slope = merge(-v, v, state%mode == inner)
      case (flow_ends)
         g = wall%tie%height*(cos(y)*v - x(speed)/wall%span)
         slope = wall%tie%height*(cos(y)*a - sin(y)*v**2 - x(rise)/wall%span)
      case default
         g = wall%tie%longest - elongation(wall, y, x)
         slope = -wall%tie%height*(cos(y)*v - x(speed)/wall%span)
      end select
   end subroutine level

   !> Ties remember where they no longer grow, if they have never been as long; broken ones do nothing
   pure logical function counts(wall, number, state, y, x)
      class(facade_type), intent(in) :: wall
      integer, intent(in) :: number
      type(state_type), intent(in) :: state
      real(rk), intent(in) :: y, x(4)

      counts = .true.
      if (number < flow_ends) return
      counts = state%most < wall%tie%longest
      if (counts .and. number == flow_ends) counts = elongation(wall, y, x) > state%most*(1.0_rk + 1.0e-12_rk)
   end function counts

   pure subroutine jump(wall, number, state, x)
      class(facade_type), intent(in) :: wall
      integer, intent(in) :: number
      type(state_type), intent(inout) :: state
      real(rk), intent(in) :: x(4)
      real(rk) :: place, away, pressed, holds

      call wall%carry(state, x)
      place = x(delta)/wall%span
      select case (number)
      case (met)
         away = wall%surface_ratio*max(x(speed)/wall%span - state%v, 0.0_rk)
         pressed = x(rise)/wall%span - wall%rate(state, place, state%v, x)
         state%y = place
         state%v = x(speed)/wall%span + away
         if (pressed > 0.0_rk .and. 2.0_rk*away < shortest*pressed) then
            state%v = x(speed)/wall%span
            state%mode = merge(inner_contact, outer_contact, state%mode == inner)
         end if
      case (edge_changes)
         state%y = 0.0_rk
         state%v = wall%edge_ratio*state%v
         holds = min(-about(wall, .false., state%most, 0.0_rk, x), about(wall, .true., state%most, 0.0_rk, x))
         state%mode = merge(outer, inner, state%mode == inner)
         if (holds > 0.0_rk .and. place < 0.0_rk .and. 2.0_rk*abs(state%v) < shortest*holds) then
            state%mode = standing
            state%v = 0.0_rk
         end if
      case (breaks)
         state%most = wall%tie%longest
      end select
   end subroutine jump

end module facade
