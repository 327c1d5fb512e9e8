!> One history in a lane: how it begins, what its events do to it, and what it leaves.
!>
!> The loop over lanes flags a lane where something may happen; what does happen is decided here, lane by lane, with the
!> same rules as in every engine (dondolo_rest, dondolo_events, dondolo_tail; docs/theory.md, section 4).
module dondolo_lane_history
   use, intrinsic :: iso_c_binding, only : c_int
   use dondolo_events, only : impact, limit_reached, no_event, turning
   use dondolo_interrupt, only : look_for_interrupt
   use dondolo_kinds, only : wp
   use dondolo_lane_stage, only : stage_type
   use dondolo_lane_state, only : event_possible, lanes_type, step_too_long
   use dondolo_lane_series, only : allowed_step, find_first, rate, value
   use dondolo_mechanism, only : mechanism_type
   use dondolo_normal_form, only : y_limit
   use dondolo_record, only : record_type
   use dondolo_record_set, only : record_set_type
   use dondolo_response, only : response_type
   use dondolo_rest, only : leave_edge, shortest_motion
   use dondolo_tail, only : free_motion, tail_type
   use dondolo_work, only : work_type
   implicit none
   private

   public :: history_type, begin, resolve

   !> What a history is and where it is, besides the state in its lane
   type :: history_type
      !> Its number, its record and the factor on it, negative to reverse it
      integer :: number = 0, record = 0
      real(wp) :: scale = 0.0_wp
      !> Side the wall is on
      real(wp) :: side = 1.0_wp
      !> Where it began to rock: sample interval and time in it [s]
      integer :: start_interval = 0
      real(wp) :: start_time = 0.0_wp
      !> Last sample interval in which it rocked before
      integer :: last_rocked = 0
      !> Largest rotation so far [rad] and its time [s]
      real(wp) :: peak = 0.0_wp, time_of_peak = 0.0_wp
      !> Impacts so far, and tiny bounces in a row
      integer :: impacts = 0, tiny_bounces = 0
      !> Has it moved? Is it over, and how?
      logical :: moved = .false., over = .false., collapsed = .false.
   end type history_type

   !> Shortest step / sample interval
   real(wp), parameter :: smallest_step = 2.0_wp**(-20)

   !> Longer by a little, so that rounding never asks for one step more
   real(wp), parameter :: slack = 1.0001_wp

contains

   !> Begin a history: at rest until its record first moves it, if it does
   pure subroutine begin(stage, mechanism, record, set, lanes, i, history, response, work)
      !> The wall
      type(stage_type), intent(in) :: stage
      !> Its mechanism
      class(mechanism_type), intent(in) :: mechanism
      !> The record of the history
      type(record_type), intent(in) :: record
      !> All records
      type(record_set_type), intent(in) :: set
      !> Lanes
      type(lanes_type), intent(inout) :: lanes
      !> Lane of the history
      integer, intent(in) :: i
      !> The history: number, record and scale are set
      type(history_type), intent(inout) :: history
      !> Its result, where it is over at once
      type(response_type), intent(inout) :: response
      !> Counts
      type(work_type), intent(inout) :: work

      work%histories = work%histories + 1
      work%intervals = work%intervals + set%length(history%record) - 1
      lanes%dt(i) = record%dt
      lanes%rate(i) = 1.0_wp/record%dt
      lanes%peak(i) = stage%first_peak
      history%peak = stage%first_rotation
      lanes%y(i) = 0.0_wp
      lanes%v(i) = 0.0_wp
      lanes%last(i) = set%offset(history%record) + set%length(history%record)
      call wait(stage, record, set, lanes, i, history, 1, 0.0_wp, work)
      if (history%over) call finish(stage, mechanism, record, set, lanes, i, history, response, work)
   end subroutine begin

   !> Take the step of a flagged lane, up to the first event in it
   pure subroutine resolve(stage, mechanism, record, set, lanes, i, history, response, work)
      !> The wall
      type(stage_type), intent(in) :: stage
      !> Its mechanism
      class(mechanism_type), intent(in) :: mechanism
      !> The record of the history
      type(record_type), intent(in) :: record
      !> All records
      type(record_set_type), intent(in) :: set
      !> Lanes
      type(lanes_type), intent(inout) :: lanes
      !> The lane
      integer, intent(in) :: i
      !> Its history
      type(history_type), intent(inout) :: history
      !> Its result, where it is over
      type(response_type), intent(inout) :: response
      !> Counts
      type(work_type), intent(inout) :: work

      real(wp) :: y, v, d(0:9), h
      integer :: event

      if (lanes%flag(i) >= event_possible) then
         d = [lanes%y(i), lanes%v(i), lanes%series(i, :)]
         ! A wall at rest begins to rock where its moment is zero: never inwards, whatever the rounding says.
         if (d(0) == 0.0_wp .and. d(1) == 0.0_wp) d(2) = max(0.0_wp, d(2))
         h = lanes%step(i)
         if (lanes%flag(i) == step_too_long) then
            h = allowed_step(d, h, smallest_step*lanes%dt(i), stage%form%fifth(lanes%u(i)), stage%solver%rtol, &
               & stage%atol)
            if (h < lanes%step(i)) then
               lanes%next_span(i) = h
               lanes%span(i) = h
            end if
         end if
         event = no_event
         if (h > shortest_motion*lanes%dt(i)) call find_first(d, lanes%peak(i), h, event)
         y = value(d, h)
         v = rate(d, h)
         lanes%y(i) = y
         lanes%v(i) = v
         if (event == no_event .and. .not. lanes%time(i) + h < lanes%dt(i)) then
            call next_sample(set, lanes, i)
         else
            call stop_between(stage, set, lanes, i, h, event /= no_event)
         end if
         select case (event)
         case (impact)
            call bounce(stage, record, set, lanes, i, history, work)
         case (turning)
            lanes%v(i) = 0.0_wp
            ! Between two impacts it may turn below the peak.
            if (y > lanes%peak(i)) call set_peak(stage, lanes, i, history, record, set)
            if (.not. y < y_limit) history%over = .true.
            history%collapsed = history%over
         case (limit_reached)
            lanes%y(i) = y_limit
            call set_peak(stage, lanes, i, history, record, set)
            history%over = .true.
            history%collapsed = .true.
         end select
      end if
      history%over = history%over .or. lanes%next(i) > lanes%last(i)
      if (history%over) call finish(stage, mechanism, record, set, lanes, i, history, response, work)
   end subroutine resolve

   !> The lane is on its next sample
   pure subroutine next_sample(set, lanes, i)
      !> All records
      type(record_set_type), intent(in) :: set
      !> Lanes
      type(lanes_type), intent(inout) :: lanes
      !> The lane
      integer, intent(in) :: i

      lanes%time(i) = 0.0_wp
      lanes%next(i) = lanes%next(i) + 1
      lanes%u(i) = lanes%u_next(i)
      lanes%u_next(i) = lanes%factor(i)*set%samples(lanes%next(i))
      lanes%slope(i) = (lanes%u_next(i) - lanes%u(i))*lanes%rate(i)
      lanes%span(i) = lanes%next_span(i)
   end subroutine next_sample

   !> The lane is between two samples
   pure subroutine stop_between(stage, set, lanes, i, h, at_event)
      !> The wall
      type(stage_type), intent(in) :: stage
      !> All records
      type(record_set_type), intent(in) :: set
      !> Lanes
      type(lanes_type), intent(inout) :: lanes
      !> The lane
      integer, intent(in) :: i
      !> Time since the last stop [s]
      real(wp), intent(in) :: h
      !> Is it an event?
      logical, intent(in) :: at_event

      lanes%time(i) = min(lanes%time(i) + h, lanes%dt(i))
      ! Of the time in the interval, not of the step: a sum of steps below the rounding of u would never move it, and a
      ! wall on the edge of its trigger would turn for ever.
      lanes%u(i) = lanes%factor(i)*set%samples(lanes%next(i) - 1) + lanes%slope(i)*lanes%time(i)
      if (at_event) call limit_span(stage, lanes, i)
   end subroutine stop_between

   !> From an event to the next sample there are at least as many steps as the solver asks for
   pure subroutine limit_span(stage, lanes, i)
      !> The wall
      type(stage_type), intent(in) :: stage
      !> Lanes
      type(lanes_type), intent(inout) :: lanes
      !> The lane: just after the event
      integer, intent(in) :: i

      real(wp) :: longest

      lanes%span(i) = lanes%next_span(i)
      if (stage%solver%steps_per_sample == 1) return
      longest = slack*(lanes%dt(i) - lanes%time(i))/real(stage%solver%steps_per_sample, wp)
      ! A step too short to move the time on would be taken for ever.
      lanes%span(i) = min(lanes%span(i), max(shortest_motion*lanes%dt(i), longest))
   end subroutine limit_span

   !> The ground seen from the side of the wall, at the lane's time
   pure subroutine aim(set, lanes, i, history)
      !> All records
      type(record_set_type), intent(in) :: set
      !> Lanes
      type(lanes_type), intent(inout) :: lanes
      !> The lane
      integer, intent(in) :: i
      !> Its history
      type(history_type), intent(in) :: history

      associate (here => set%samples(lanes%next(i) - 1), next => set%samples(lanes%next(i)))
         lanes%factor(i) = history%side*history%scale
         lanes%u_next(i) = lanes%factor(i)*next
         lanes%slope(i) = (lanes%u_next(i) - lanes%factor(i)*here)*lanes%rate(i)
         lanes%u(i) = lanes%factor(i)*here + lanes%slope(i)*lanes%time(i)
      end associate
   end subroutine aim

   !> An impact: the wall turns back, or rocks on to the other side, or comes to rest
   pure subroutine bounce(stage, record, set, lanes, i, history, work)
      !> The wall
      type(stage_type), intent(in) :: stage
      !> The record
      type(record_type), intent(in) :: record
      !> All records
      type(record_set_type), intent(in) :: set
      !> Lanes
      type(lanes_type), intent(inout) :: lanes
      !> The lane
      integer, intent(in) :: i
      !> Its history
      type(history_type), intent(inout) :: history
      !> Counts
      type(work_type), intent(inout) :: work

      real(wp) :: acceleration
      integer :: interval
      integer(c_int) :: interrupted
      logical :: at_rest

      history%impacts = history%impacts + 1
      call look_for_interrupt(interrupted)
      history%over = interrupted == 1
      if (history%over) return
      acceleration = history%side*lanes%u(i)
      lanes%y(i) = 0.0_wp
      lanes%v(i) = -stage%rest%restitution*min(lanes%v(i), 0.0_wp)
      if (stage%rest%two_sided) history%side = -history%side
      interval = interval_of(set, lanes, i, history)
      call stage%rest%settle(record, history%scale, interval, lanes%time(i), acceleration, history%side, &
         & lanes%v(i)*stage%form%unit, history%peak, history%impacts, history%tiny_bounces, &
         & at_rest)
      if (.not. at_rest) then
         call aim(set, lanes, i, history)
         return
      end if
      work%rocked = work%rocked + interval - max(history%start_interval - 1, history%last_rocked)
      history%last_rocked = interval
      history%tiny_bounces = 0
      lanes%v(i) = 0.0_wp
      ! A start on the very edge of the threshold that rounding undoes at once must not be tried for ever.
      associate (time => lanes%time(i))
         if (interval == history%start_interval .and. time - history%start_time <= shortest_motion*record%dt) &
            & call leave_edge(record, interval, time)
         call wait(stage, record, set, lanes, i, history, interval, time, work)
      end associate
   end subroutine bounce

   !> At rest: go to the instant at which rocking begins
   pure subroutine wait(stage, record, set, lanes, i, history, from, since, work)
      !> The wall
      type(stage_type), intent(in) :: stage
      !> The record
      type(record_type), intent(in) :: record
      !> All records
      type(record_set_type), intent(in) :: set
      !> Lanes
      type(lanes_type), intent(inout) :: lanes
      !> The lane
      integer, intent(in) :: i
      !> Its history
      type(history_type), intent(inout) :: history
      !> Sample interval from which on it is at rest, and time in it [s]
      integer, intent(in) :: from
      real(wp), intent(in) :: since
      !> Counts
      type(work_type), intent(inout) :: work

      integer :: interval, sample
      real(wp) :: time, trigger, acceleration
      logical :: found

      interval = from
      time = since
      trigger = stage%rest%trigger()
      associate (n => set%length(history%record), a => record%acceleration)
         history%over = interval >= n
         if (history%over) return
         acceleration = history%scale*(a(interval) + (a(interval + 1) - a(interval))*(time/record%dt))
         if (.not. (acceleration < -trigger .or. (stage%rest%two_sided .and. acceleration > trigger))) then
            sample = set%next_outside(history%record, interval + 1, history%scale, -trigger, &
               & merge(trigger, huge(trigger), stage%rest%two_sided))
            history%over = sample > n
            if (history%over) return
            if (sample - 1 > interval) time = 0.0_wp
            interval = sample - 1
         end if
      end associate
      call stage%rest%next_start(record, history%scale, interval, time, history%side, found)
      history%moved = .true.
      history%start_interval = interval
      history%start_time = time
      lanes%next(i) = set%offset(history%record) + interval + 1
      lanes%time(i) = time
      lanes%next_span(i) = huge(time)
      if (stage%solver%steps_per_sample > 1) &
         & lanes%next_span(i) = slack*record%dt/real(stage%solver%steps_per_sample, wp)
      call limit_span(stage, lanes, i)
      call aim(set, lanes, i, history)
   end subroutine wait

   !> Sample interval of a lane
   pure integer function interval_of(set, lanes, i, history) result(interval)
      !> All records
      type(record_set_type), intent(in) :: set
      !> Lanes
      type(lanes_type), intent(in) :: lanes
      !> The lane
      integer, intent(in) :: i
      !> Its history
      type(history_type), intent(in) :: history

      interval = int(lanes%next(i)) - 1 - set%offset(history%record)
   end function interval_of

   !> The coordinate is a new peak
   pure subroutine set_peak(stage, lanes, i, history, record, set)
      !> The wall
      type(stage_type), intent(in) :: stage
      !> Lanes
      type(lanes_type), intent(inout) :: lanes
      !> The lane
      integer, intent(in) :: i
      !> Its history
      type(history_type), intent(inout) :: history
      !> Its record
      type(record_type), intent(in) :: record
      !> All records
      type(record_set_type), intent(in) :: set

      lanes%peak(i) = lanes%y(i)
      history%peak = stage%form%rotation(lanes%y(i))
      history%time_of_peak = real(interval_of(set, lanes, i, history) - 1, wp)*record%dt + lanes%time(i)
   end subroutine set_peak

   !> The history is over: its result
   pure subroutine finish(stage, mechanism, record, set, lanes, i, history, response, work)
      !> The wall
      type(stage_type), intent(in) :: stage
      !> Its mechanism
      class(mechanism_type), intent(in) :: mechanism
      !> The record
      type(record_type), intent(in) :: record
      !> All records
      type(record_set_type), intent(in) :: set
      !> Lanes
      type(lanes_type), intent(in) :: lanes
      !> The lane
      integer, intent(in) :: i
      !> The history
      type(history_type), intent(in) :: history
      !> Its result
      type(response_type), intent(out) :: response
      !> Counts
      type(work_type), intent(inout) :: work

      type(tail_type) :: tail
      real(wp) :: q, v, peak, j, c, g, l, load
      logical :: rocking

      if (.not. history%moved) then
         work%still = work%still + 1
         return
      end if
      rocking = lanes%y(i) > 0.0_wp .or. lanes%v(i) > 0.0_wp
      work%impacts = work%impacts + history%impacts
      if (rocking) work%rocked = work%rocked - max(history%start_interval - 1, history%last_rocked) &
         & + min(interval_of(set, lanes, i, history), set%length(history%record) - 1)
      response%impacts = history%impacts
      response%time_of_peak = history%time_of_peak
      response%collapsed = history%collapsed
      peak = history%peak
      if (rocking .and. .not. history%collapsed) then
         ! Rocking when the record ends
         q = stage%form%rotation(lanes%y(i))
         call mechanism%terms(q, j, c, g, l, load)
         v = lanes%v(i)*stage%form%unit*sqrt(stage%rest%inertia/j)
         call free_motion(mechanism, stage%solver%edp_limit*mechanism%capacity, q, v, tail)
         response%collapsed = tail%collapsed
         if (tail%peak > peak) then
            peak = tail%peak
            response%time_of_peak = record%duration() + tail%delay
         end if
      end if
      if (.not. stage%solver%collapses_only) response%edp = peak/mechanism%capacity
      ! A peak that only rounding tells from the limit is a collapse too.
      response%collapsed = response%collapsed .or. response%edp >= stage%solver%edp_limit
      if (response%collapsed) response%edp = stage%solver%edp_limit
   end subroutine finish

end module dondolo_lane_history
