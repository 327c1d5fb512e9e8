!> What the stepper asks of a wall between two supports. Accelerations, displacements and rotations are positive outwards.
module rocking_wall
   use support_motion, only : rk
   implicit none
   private

   public :: wall_type, state_type, gravity, shortest

   real(rk), parameter :: gravity = 9.81_rk

   !> Bounces that would last less, s, end at rest
   real(rk), parameter :: shortest = 1.0e-4_rk

   type :: state_type
      !> How it moves or rests; 0 at the beginning
      integer :: mode = 0
      !> Rotation and its speed
      real(rk) :: y = 0.0_rk
      real(rk) :: v = 0.0_rk
      !> Largest elongation of its tie, m
      real(rk) :: most = 0.0_rk
   end type state_type

   type, abstract :: wall_type
      !> Rotation at which it collapses
      real(rk) :: limit = 0.0_rk
      !> Height over which the supports drift apart, m
      real(rk) :: span = 0.0_rk
      !> Ways in which a wall at rest may begin to move, and events of one that moves
      integer :: urges = 0
      integer :: levels = 0
   contains
      procedure(moves), deferred :: moves
      procedure(rate), deferred :: rate
      procedure(urge), deferred :: urge
      procedure(change), deferred :: leave
      procedure(remain), deferred :: carry
      procedure(level), deferred :: level
      procedure(counts), deferred :: counts
      procedure(change), deferred :: jump
   end type wall_type

   abstract interface
      !> Does it move by itself in this mode?
      pure logical function moves(wall, mode)
         import :: wall_type
         class(wall_type), intent(in) :: wall
         integer, intent(in) :: mode
      end function moves

      !> Angular acceleration at a rotation y and speed v
      pure function rate(wall, state, y, v, x) result(a)
         import :: wall_type, state_type, rk
         class(wall_type), intent(in) :: wall
         type(state_type), intent(in) :: state
         real(rk), intent(in) :: y, v, x(4)
         real(rk) :: a
      end function rate

      !> Positive where a wall at rest begins to move
      pure function urge(wall, number, state, x) result(a)
         import :: wall_type, state_type, rk
         class(wall_type), intent(in) :: wall
         integer, intent(in) :: number
         type(state_type), intent(in) :: state
         real(rk), intent(in) :: x(4)
         real(rk) :: a
      end function urge

      !> State after an urge or an event
      pure subroutine change(wall, number, state, x)
         import :: wall_type, state_type, rk
         class(wall_type), intent(in) :: wall
         integer, intent(in) :: number
         type(state_type), intent(inout) :: state
         real(rk), intent(in) :: x(4)
      end subroutine change

      !> A wall that rests follows its supports; one that moves keeps what it has to remember
      pure subroutine remain(wall, state, x)
         import :: wall_type, state_type, rk
         class(wall_type), intent(in) :: wall
         type(state_type), intent(inout) :: state
         real(rk), intent(in) :: x(4)
      end subroutine remain

      !> Function that falls through zero at an event, and its rate; a is the angular acceleration
      pure subroutine level(wall, number, state, y, v, a, x, g, slope)
         import :: wall_type, state_type, rk
         class(wall_type), intent(in) :: wall
         integer, intent(in) :: number
         type(state_type), intent(in) :: state
         real(rk), intent(in) :: y, v, a, x(4)
         real(rk), intent(out) :: g, slope
      end subroutine level

      !> Is the passage of a level an event?
      pure logical function counts(wall, number, state, y, x)
         import :: wall_type, state_type, rk
         class(wall_type), intent(in) :: wall
         integer, intent(in) :: number
         type(state_type), intent(in) :: state
         real(rk), intent(in) :: y, x(4)
      end function counts
   end interface

end module rocking_wall
