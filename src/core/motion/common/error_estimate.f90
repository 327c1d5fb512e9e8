!> Estimated error of a history, from two more runs of it.
!>
!> One has halved steps and a slightly stronger record, the other the same steps and a record as much weaker. What is linear
!> in the strength cancels in the second difference of the three: it shows the error of the steps, which halving reduces to a
!> 32nd, and, at full size, any change of outcome within that change of the record: a grazing impact, a start at the trigger, a
!> collapse at the limit. The first difference is the condition of the history: scaled down to the rounding of double
!> precision, it estimates the effect of rounding (docs/theory.md, section 5).
module dondolo_motion_error_estimate
   use dondolo_base_kinds, only : wp
   use dondolo_motion_response, only : response_type
   use dondolo_motion_solver, only : refined, solver_type
   implicit none
   private

   public :: runs_of_estimate, other_run, estimated_error, certain

   !> Runs of a history whose error is estimated
   integer, parameter :: runs_of_estimate = 3

   !> Shift of a rotation / capacity at a collapse below which the collapse is certain
   real(wp), parameter :: certain = 1.0e-4_wp

   !> Change of the record, and the change of it that is equivalent to all rounding of a history, both relative
   real(wp), parameter :: change = 512.0_wp*epsilon(1.0_wp), rounding = 8.0_wp*epsilon(1.0_wp)

contains

   !> What another run of a history differs in
   elemental subroutine other_run(number, solver, scale, other_solver, other_scale)
      !> 1: halved steps, stronger; 2: weaker
      integer, intent(in) :: number
      !> Settings and factor on the record of the history itself
      type(solver_type), intent(in) :: solver
      real(wp), intent(in) :: scale
      !> Those of the other run
      type(solver_type), intent(out) :: other_solver
      real(wp), intent(out) :: other_scale

      if (number == 1) then
         other_solver = refined(solver)
         other_scale = scale*(1.0_wp + change)
      else
         other_solver = solver
         other_scale = scale*(1.0_wp - change)
      end if
   end subroutine other_run

   !> Estimated error of the EDP. Where all three runs collapse, their impacts and times are compared: with different
   !> impacts the outcome is uncertain; and beyond its capacity a wall falls as exp(p t), so that a shift by dt changes the
   !> rotation by p dt. If that is small, the collapse is certain and its EDP exact
   elemental real(wp) function estimated_error(one, stronger, weaker, rate, edp_limit) result(error)
      !> The history
      type(response_type), intent(in) :: one
      !> The other runs
      type(response_type), intent(in) :: stronger, weaker
      !> Frequency parameter p of the wall [rad/s]
      real(wp), intent(in) :: rate
      !> Rotation / capacity at which the wall has collapsed
      real(wp), intent(in) :: edp_limit

      if (one%collapsed .and. stronger%collapsed .and. weaker%collapsed) then
         error = min(1.0_wp, &
            & rate*of_changes(stronger%time_of_peak - one%time_of_peak, one%time_of_peak - weaker%time_of_peak))
         if (stronger%impacts /= one%impacts .or. weaker%impacts /= one%impacts) error = 1.0_wp
         error = merge(error*edp_limit, 0.0_wp, error > certain)
      else
         ! The error of an EDP cannot exceed its range, although the second difference may.
         error = min(edp_limit, of_changes(stronger%edp - one%edp, one%edp - weaker%edp))
      end if

   contains

      !> Error estimated from two changes of a result
      pure real(wp) function of_changes(rise, fall)
         !> From the history to the stronger one, from the weaker one to the history
         real(wp), intent(in) :: rise, fall

         of_changes = max(abs(rise - fall), (rounding/change)*max(abs(rise), abs(fall)))
      end function of_changes

   end function estimated_error

end module dondolo_motion_error_estimate
