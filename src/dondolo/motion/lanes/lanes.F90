!> The engine lanes: many histories of one wall in lockstep, a vector of them at a time.
!>
!> Each lane holds one history and has its own time. All lanes take a step at once (dondolo_lane_kernel); flagged ones
!> are seen to one by one (dondolo_lane_history). A lane whose history is over takes the next from the queue, so that
!> vectors stay full. What a history gives depends neither on its lane nor on those beside it.
module dondolo_lanes
   use dondolo_kinds, only : wp
   use dondolo_lane_history, only : begin, history_type, resolve
   use dondolo_lane_kernel, only : step_lanes
   use dondolo_lane_stage, only : stage_type
   use dondolo_lane_state, only : lane_width, lanes_type, step_taken
   use dondolo_mechanism, only : mechanism_type
   use dondolo_queue, only : progress_interface, queue_type
   use dondolo_record, only : record_type
   use dondolo_record_set, only : record_set_type
   use dondolo_response, only : response_type
   use dondolo_work, only : work_type
   implicit none
   private

   public :: simulate_lanes

contains

   !> Histories of one wall, as long as the queue has some
   subroutine simulate_lanes(stage, mechanism, records, set, record, scale, queue, response, work, progress)
      !> The wall, prepared
      type(stage_type), intent(in) :: stage
      !> Its mechanism
      class(mechanism_type), intent(in) :: mechanism
      !> Accelerograms
      type(record_type), intent(in) :: records(:)
      !> The same, joined
      type(record_set_type), intent(in) :: set
      !> Record of each history, and the factor on it, negative to reverse it
      integer, intent(in) :: record(:)
      real(wp), intent(in) :: scale(:)
      !> Numbers of the histories to run; shared with other threads
      type(queue_type), intent(inout) :: queue
      !> Result of each history
      type(response_type), intent(inout) :: response(:)
      !> Counts, added to
      type(work_type), intent(inout) :: work
      !> Hears how far the work is
      procedure(progress_interface), optional :: progress

      type(lanes_type) :: lanes
      type(history_type) :: history(lane_width)
      integer :: active, i

      active = 0
      do while (active < lane_width)
         if (.not. is_filled(active + 1)) exit
         active = active + 1
      end do
      do while (active > 0)
         call step_lanes(lanes, active, stage%form, set%samples, stage%solver%rtol, stage%atol)
         work%steps = work%steps + active
         work%evaluations = work%evaluations + active
         i = 1
         do while (i <= active)
            if (lanes%flag(i) /= step_taken) then
               associate (h => history(i))
                  call resolve(stage, mechanism, records(h%record), set, lanes, i, h, response(h%number), work)
                  if (h%over) then
                     call queue%report(progress)
                     if (.not. is_filled(i)) then
                        ! The last lane moves in, so that those at work stay side by side.
                        call move(lanes, history, active, i)
                        ! What it leaves behind may be stepped as part of a vector, but gets nowhere: at y = 0 no
                        ! step is taken. Else it would run past the samples of its record.
                        lanes%y(active) = 0.0_wp
                        lanes%v(active) = 0.0_wp
                        active = active - 1
                        cycle
                     end if
                  end if
               end associate
            end if
            i = i + 1
         end do
      end do

   contains

      !> Put the next history that moves into a lane; false if there is none
      logical function is_filled(i)
         !> The lane
         integer, intent(in) :: i

         integer :: number

         do
            number = queue%next()
            is_filled = number > 0
            if (.not. is_filled) return
            history(i) = history_type(number=number, record=record(number), scale=scale(number))
            call begin(stage, mechanism, records(record(number)), set, lanes, i, history(i), response(number), work)
            if (.not. history(i)%over) return
            call queue%report(progress)
         end do
      end function is_filled

   end subroutine simulate_lanes

   !> Move a lane
   pure subroutine move(lanes, history, from, to)
      !> Lanes
      type(lanes_type), intent(inout) :: lanes
      !> Their histories
      type(history_type), intent(inout) :: history(:)
      !> The lane, and where it goes
      integer, intent(in) :: from, to

      history(to) = history(from)
      lanes%y(to) = lanes%y(from)
      lanes%v(to) = lanes%v(from)
      lanes%time(to) = lanes%time(from)
      lanes%dt(to) = lanes%dt(from)
      lanes%rate(to) = lanes%rate(from)
      lanes%u(to) = lanes%u(from)
      lanes%u_next(to) = lanes%u_next(from)
      lanes%slope(to) = lanes%slope(from)
      lanes%factor(to) = lanes%factor(from)
      lanes%span(to) = lanes%span(from)
      lanes%next_span(to) = lanes%next_span(from)
      lanes%peak(to) = lanes%peak(from)
      lanes%next(to) = lanes%next(from)
      lanes%last(to) = lanes%last(from)
      lanes%series(to, :) = lanes%series(from, :)
      lanes%step(to) = lanes%step(from)
      lanes%flag(to) = lanes%flag(from)
   end subroutine move

end module dondolo_lanes
