!> What the kinematic check asks of a chain (Circolare 7/2019, C8.7.1.1 to C8.7.1.5): weights W of bodies and loads, their
!> displacements delta = x'(0), and over the rotation sum W x' and the displacement d of the equivalent oscillator,
!>
!>     alpha = M/sum W x'      M* = (sum W delta)^2/(g sum W delta^2)      d = sum W delta Dx/sum W delta
!>
!> where Dx is the finite displacement: d needs no point of control, and does not depend on the body that drives the chain.
module dondolo_wall_chain_check
   use dondolo_base_kinds, only : wp
   use dondolo_wall_chain, only : chain_type, motion_type, point_motion
   implicit none
   private

   public :: chain_weights, chain_travel

contains

   !> Weights and displacements: of bodies, then of the loads and pushed masses that nothing else holds
   pure subroutine chain_weights(chain, at_rest, weight, displacement)
      class(chain_type), intent(in) :: chain
      !> The motion at rest
      type(motion_type), intent(in) :: at_rest
      !> [N] and [m]
      real(wp), allocatable, intent(out) :: weight(:), displacement(:)

      real(wp) :: place(2), rate(2), second(2)
      integer :: i

      weight = chain%gravity*chain%bodies%mass
      displacement = at_rest%rate(1, :)
      do i = 1, size(chain%actions)
         associate (action => chain%actions(i))
            if (action%is_held .or. .not. max(action%weight, action%pushed) > 0.0_wp) cycle
            call point_motion(chain, at_rest, action%body, action%at, place, rate, second)
            weight = [weight, merge(action%weight, chain%gravity*action%pushed, action%weight > 0.0_wp)]
            displacement = [displacement, rate(1)]
         end associate
      end do
   end subroutine chain_weights

   !> Displacement d [m] and sum W x' [N m] at a rotation
   pure subroutine chain_travel(chain, weight, displacement, motion, travel, lever)
      class(chain_type), intent(in) :: chain
      !> As of chain_weights
      real(wp), intent(in) :: weight(:), displacement(:)
      type(motion_type), intent(in) :: motion
      real(wp), intent(out) :: travel, lever

      real(wp) :: place(2), rate(2), second(2)
      integer :: i, k

      k = size(chain%bodies)
      travel = sum(weight(:k)*displacement(:k)*(motion%y(1, :) - chain%bodies%at(1)))
      lever = sum(weight(:k)*motion%rate(1, :))
      do i = 1, size(chain%actions)
         associate (action => chain%actions(i))
            if (action%is_held .or. .not. max(action%weight, action%pushed) > 0.0_wp) cycle
            k = k + 1
            call point_motion(chain, motion, action%body, action%at, place, rate, second)
            travel = travel + weight(k)*displacement(k)*(place(1) - action%at(1))
            lever = lever + weight(k)*rate(1)
         end associate
      end do
      travel = travel/sum(weight*displacement)
   end subroutine chain_travel

end module dondolo_wall_chain_check
