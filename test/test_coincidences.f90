!> Constructed coincidences (test/coincidence.f90) in both engines: every history ends, soon and whole, and they agree wherever
!> the input decides.
!>
!> Arguments: number of histories, and number of the first, to run one again by itself
program test_coincidences
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use checks, only : check, finish, suite
   use coincidence, only : kind_names, new_coincidence
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_motion_normal_form, only : new_normal_form, normal_form_type
   use dondolo_motion_response, only : response_type
   use dondolo_motion_rk45, only : simulate_rk45
   use lane_runs, only : run_alone
   use random_history, only : argument, history_type
   implicit none

   !> Longest time of a history, which no machine should need [s]
   real(wp), parameter :: longest = 2.0_wp
   !> Differences of the engines / what the tolerances and a change of the record by as much come to
   real(wp), parameter :: in_hand = 100.0_wp

   !> Histories that run whatever their number: friction at the edge of what it holds, where lanes moved up to 1e-3 of the capacity
   integer, parameter :: kept(*) = [1133, 10655, 11258, 11654]

   ! What the histories of each kind came to
   integer, dimension(size(kind_names)) :: histories = 0, compared = 0, moved = 0, collapsed = 0
   real(wp), dimension(size(kind_names)) :: slowest = 0.0_wp, worst = 0.0_wp
   integer :: i, first, kind

   first = argument(2, 1)
   call suite('coincidences')
   if (first == 1) then
      do i = 1, size(kept)
         call test_history(kept(i))
      end do
   end if
   do i = first, first + argument(1, 300) - 1
      call test_history(i)
   end do
   do kind = 1, size(kind_names)
      print '(a)', trim(kind_names(kind))//': '//to_text(histories(kind))//' histories, '//to_text(moved(kind))//' moved, '// &
         & to_text(collapsed(kind))//' collapsed, '//to_text(compared(kind))//' well-conditioned, worst difference '// &
         & to_text(worst(kind))//', slowest '//to_text(slowest(kind))//' s'
   end do
   call finish()

contains

   !> One history, in both engines if lanes knows its wall
   subroutine test_history(number)
      integer, intent(in) :: number
      type(history_type) :: history
      type(response_type) :: response, lane
      type(normal_form_type) :: form
      character(len=:), allocatable :: what
      integer :: kind

      call new_coincidence(number, history, kind)
      what = 'coincidence '//to_text(number)//', '//trim(kind_names(kind))
      histories(kind) = histories(kind) + 1
      call run_rk45(history, kind, response, what)
      if (response%edp > 0.0_wp) moved(kind) = moved(kind) + 1
      if (response%collapsed) collapsed(kind) = collapsed(kind) + 1
      form = new_normal_form(history%wall%mechanism, history%solver%edp_limit*history%wall%mechanism%capacity, &
         & allocated(history%record%vertical))
      if (.not. form%exists) return
      call run_lanes(history, kind, lane, what//' in lanes')
      call compare(history, kind, response, lane, what)
   end subroutine test_history

   !> It ends in rk45
   subroutine run_rk45(history, kind, response, what)
      type(history_type), intent(in) :: history
      integer, intent(in) :: kind
      type(response_type), intent(out) :: response
      character(len=*), intent(in) :: what
      real(wp) :: start, end

      call cpu_time(start)
      call simulate_rk45(history%wall%mechanism, history%record, history%scale, history%solver, response)
      call cpu_time(end)
      slowest(kind) = max(slowest(kind), end - start)
      call check(end - start <= longest, what//': seconds '//to_text(end - start))
      call check_result(response, history%solver%edp_limit, what)
   end subroutine run_rk45

   !> It ends in lanes
   subroutine run_lanes(history, kind, response, what)
      type(history_type), intent(in) :: history
      integer, intent(in) :: kind
      type(response_type), intent(out) :: response
      character(len=*), intent(in) :: what
      real(wp) :: start, end

      call cpu_time(start)
      call run_alone(history%wall%mechanism, history%record, history%scale, history%solver, response)
      call cpu_time(end)
      slowest(kind) = max(slowest(kind), end - start)
      call check(end - start <= longest, what//': seconds '//to_text(end - start))
      call check_result(response, history%solver%edp_limit, what)
   end subroutine run_lanes

   !> A whole result, within the limit, which is reached by collapses only
   subroutine check_result(response, limit, what)
      type(response_type), intent(in) :: response
      real(wp), intent(in) :: limit
      character(len=*), intent(in) :: what

      call check(response%is_whole, what//': computed to its end')
      call check(ieee_is_finite(response%edp) .and. response%edp >= 0.0_wp .and. response%edp <= limit, what//': within the limit')
      call check(response%collapsed .eqv. response%edp == limit, what//': collapsed at the limit')
      call check(ieee_is_finite(response%time_of_peak) .and. response%time_of_peak >= 0.0_wp, what//': time of the peak')
   end subroutine check_result

   !> The engines agree wherever a change of the record by the tolerances changes little
   subroutine compare(history, kind, response, lane, what)
      type(history_type), intent(in) :: history
      integer, intent(in) :: kind
      type(response_type), intent(in) :: response, lane
      character(len=*), intent(in) :: what
      real(wp), parameter :: largest_growth = 1.0e3_wp, parts(6) = [-1.0_wp, -0.3_wp, -1.0e-3_wp, 1.0e-3_wp, 0.3_wp, 1.0_wp]
      type(response_type) :: other
      real(wp) :: allowed, change, ratio
      integer :: j

      associate (solver => history%solver)
         allowed = solver%rtol*response%edp + solver%atol
         change = 0.0_wp
         do j = 1, size(parts)
            call simulate_rk45(history%wall%mechanism, history%record, history%scale*(1.0_wp + parts(j)*solver%rtol), solver, other)
            if (other%collapsed .neqv. response%collapsed) return
            change = max(change, abs(other%edp - response%edp))
            if (change > largest_growth*allowed) return
         end do
      end associate
      compared(kind) = compared(kind) + 1
      call check(lane%collapsed .eqv. response%collapsed, what//': the engines agree on the collapse')
      ratio = abs(lane%edp - response%edp)/(change + allowed)
      worst(kind) = max(worst(kind), ratio)
      call check(ratio <= in_hand, what//': lanes differ from rk45 by '//to_text(lane%edp - response%edp)//', tolerance '// &
         & to_text(change + allowed))
   end subroutine compare

end program test_coincidences
