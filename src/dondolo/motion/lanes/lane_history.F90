!> The histories in lanes: how each begins, what its events do to it, and its result.
!>
!> The loop over lanes flags a lane where something may happen; what does happen is decided here, lane by lane, by the
!> rules that all engines share (dondolo_history, dondolo_rest, dondolo_events; docs/theory.md, section 4).
module dondolo_lane_history
   use, intrinsic :: iso_c_binding, only : c_int
   use dondolo_events, only : impact, level_above, level_below, limit_reached, no_event, turning
   use dondolo_history, only : history_type, starting_acceleration
   use dondolo_interrupt, only : look_for_interrupt
   use dondolo_kinds, only : wp
   use dondolo_lane_constants, only : lane_constants_type
   use dondolo_lane_grip, only : lane_grip_type
   use dondolo_lane_state, only : event_possible, lane_width, lanes_type, part_if_held, step_too_long
   use dondolo_lane_series, only : allowed_part, find_first, find_first_level, rate, value
   use dondolo_mechanism, only : mechanism_type
   use dondolo_normal_form, only : y_limit
   use dondolo_queue, only : queue_type
   use dondolo_record, only : record_type
   use dondolo_record_set, only : record_set_type
   use dondolo_rest, only : rest_type
   use dondolo_step_limits, only : longest_step, shortest_motion, smallest_step
   use dondolo_tail, only : tail_type
   use dondolo_work, only : work_type
   implicit none
   private

   public :: lane_batch_type, begin, resolve

   !> A history in a lane. Its interval and time are those of its last event
   type, extends(history_type) :: lane_history_type
      !> Its number in the queue, and its record
      integer :: number = 0, record = 0
      !> The wall at rest, as its ties hold it
      type(rest_type) :: rest
      !> Whether it is over
      logical :: over = .false.
   end type lane_history_type

   !> The lanes of one thread, with all that their histories need
   type :: lane_batch_type
      !> State of the lanes
      type(lanes_type) :: lanes
      !> The history in each lane
      type(lane_history_type) :: history(lane_width)
      !> The ties in each lane; not allocated for a wall without
      type(lane_grip_type), allocatable :: grips(:)
      !> Counts
      type(work_type) :: work
      !> The wall
      class(mechanism_type), pointer :: mechanism => null()
      type(lane_constants_type), pointer :: constants => null()
      !> Accelerograms, and the same joined
      type(record_type), pointer :: records(:) => null()
      type(record_set_type), pointer :: set => null()
      !> Where histories come from and results go to
      type(queue_type), pointer :: queue => null()
   end type lane_batch_type

contains

   !> Begin a history: at rest until its record first moves it, if it does
   pure subroutine begin(batch, i, number)
      !> The lanes, and the one
      type(lane_batch_type), intent(inout) :: batch
      integer, intent(in) :: i
      !> Number of the history
      integer, intent(in) :: number

      associate (lanes => batch%lanes, history => batch%history(i), constants => batch%constants, set => batch%set)
         history = lane_history_type(number=number, record=batch%queue%record(number), &
            & scale=batch%queue%scale(number), peak=constants%first_rotation, rest=constants%rest)
         lanes%dt(i) = batch%records(history%record)%dt
         lanes%rate(i) = 1.0_wp/lanes%dt(i)
         lanes%peak(i) = constants%first_peak
         lanes%y(i) = 0.0_wp
         lanes%v(i) = 0.0_wp
         lanes%last(i) = set%offset(history%record) + set%length(history%record)
         lanes%fifth_a(i) = constants%form%fifth_a
         if (allocated(batch%grips)) call batch%grips(i)%begin(batch%mechanism, constants, lanes, i)
         call wait(batch, i)
         if (history%over) call finish(batch, i)
      end associate
   end subroutine begin

   !> Take the step of a flagged lane, up to the first event in it
   pure subroutine resolve(batch, i)
      !> The lanes, and the one
      type(lane_batch_type), intent(inout) :: batch
      integer, intent(in) :: i

      real(wp) :: y, d(0:9), part, h
      logical :: heeds
      integer :: event

      associate (lanes => batch%lanes, history => batch%history(i), constants => batch%constants)
         if (lanes%flag(i) >= event_possible) then
            associate (step => lanes%step(i))
               d = [lanes%y(i), lanes%v(i)*step, lanes%series(i, :)]
               d(2) = starting_acceleration(d(0), d(1), d(2))
               part = 1.0_wp
               if (lanes%flag(i) == step_too_long) then
                  part = allowed_part(d, step, smallest_step*lanes%dt(i), merge(part_if_held, 1.0_wp, constants%form%is_held), &
                     & constants%form%fifth(lanes%fifth_a(i), lanes%u(i), lanes%heavier(i)), constants%solver%rtol, constants%atol)
                  if (part < 1.0_wp) then
                     lanes%next_span(i) = part*step
                     lanes%span(i) = part*step
                  end if
               end if
               event = no_event
               if (part*step > shortest_motion*lanes%dt(i)) then
                  call find_first(d, lanes%peak(i), part, event)
                  if (allocated(batch%grips)) then
                     call batch%grips(i)%heed(heeds)
                     if (heeds) call find_first_level(d, lanes%below(i), lanes%above(i), part, event)
                  end if
               end if
               h = part*step
               y = value(d, part)
               lanes%y(i) = y
               if (h > 0.0_wp) lanes%v(i) = rate(d, part)/step
            end associate
            if (event == no_event .and. .not. lanes%time(i) + h < lanes%dt(i)) then
               call next_sample(lanes, i, batch%set)
            else
               call stop_between(lanes, i, batch%set, h)
               if (event /= no_event) call limit_span(lanes, i, constants%solver%steps_per_sample)
            end if
            select case (event)
            case (impact)
               call bounce(batch, i)
            case (level_above, level_below)
               call batch%grips(i)%cross(constants, lanes, i, event, time_of(batch, i), h > shortest_motion*lanes%dt(i))
            case (turning)
               lanes%v(i) = 0.0_wp
               ! Between two impacts it may turn below the peak.
               if (y > lanes%peak(i)) call set_peak(batch, i)
               if (allocated(batch%grips)) call batch%grips(i)%turn(constants, lanes, i)
               history%collapsed = .not. y < y_limit
               history%over = history%collapsed
            case (limit_reached)
               lanes%y(i) = y_limit
               call set_peak(batch, i)
               history%collapsed = .true.
               history%over = .true.
            end select
         end if
         history%over = history%over .or. lanes%next(i) > lanes%last(i)
         if (history%over) call finish(batch, i)
      end associate
   end subroutine resolve

   !> The lane reaches its next sample
   pure subroutine next_sample(lanes, i, set)
      !> The lanes, and the one
      type(lanes_type), intent(inout) :: lanes
      integer, intent(in) :: i
      !> Accelerograms
      type(record_set_type), intent(in) :: set

      lanes%time(i) = 0.0_wp
      lanes%next(i) = lanes%next(i) + 1
      lanes%u(i) = lanes%u_next(i)
      lanes%u_next(i) = lanes%factor(i)*set%samples(lanes%next(i))
      lanes%slope(i) = (lanes%u_next(i) - lanes%u(i))*lanes%rate(i)
      if (allocated(set%verticals)) then
         lanes%heavier(i) = lanes%heavier_next(i)
         lanes%heavier_next(i) = lanes%vertical_factor(i)*set%verticals(lanes%next(i))
         lanes%heavier_slope(i) = (lanes%heavier_next(i) - lanes%heavier(i))*lanes%rate(i)
      end if
      lanes%span(i) = lanes%next_span(i)
   end subroutine next_sample

   !> The lane stops between two samples
   pure subroutine stop_between(lanes, i, set, h)
      !> The lanes, and the one
      type(lanes_type), intent(inout) :: lanes
      integer, intent(in) :: i
      !> Accelerograms
      type(record_set_type), intent(in) :: set
      !> Time since the last stop [s]
      real(wp), intent(in) :: h

      lanes%time(i) = min(lanes%time(i) + h, lanes%dt(i))
      ! Of the time in the interval, not of the step: a sum of steps below the rounding of u would never move it, and a
      ! wall on the edge of its trigger would turn forever.
      lanes%u(i) = lanes%factor(i)*set%samples(lanes%next(i) - 1) + lanes%slope(i)*lanes%time(i)
      if (allocated(set%verticals)) lanes%heavier(i) = lanes%vertical_factor(i)*set%verticals(lanes%next(i) - 1) &
         & + lanes%heavier_slope(i)*lanes%time(i)
   end subroutine stop_between

   !> Limit the steps from an event to the next sample
   pure subroutine limit_span(lanes, i, steps_per_sample)
      !> The lanes, and the one just after an event
      type(lanes_type), intent(inout) :: lanes
      integer, intent(in) :: i
      !> Least number of steps
      integer, intent(in) :: steps_per_sample

      lanes%span(i) = min(lanes%next_span(i), longest_step(steps_per_sample, lanes%dt(i), lanes%time(i)))
   end subroutine limit_span

   !> The ground seen from the side of the wall, at the lane's time
   pure subroutine aim(lanes, i, set, factor, gravity)
      !> The lanes, and the one
      type(lanes_type), intent(inout) :: lanes
      integer, intent(in) :: i
      !> Accelerograms
      type(record_set_type), intent(in) :: set
      !> Factor on them: side * scale
      real(wp), intent(in) :: factor
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity

      associate (here => set%samples(lanes%next(i) - 1), next => set%samples(lanes%next(i)))
         lanes%factor(i) = factor
         lanes%u_next(i) = lanes%factor(i)*next
         lanes%slope(i) = (lanes%u_next(i) - lanes%factor(i)*here)*lanes%rate(i)
         lanes%u(i) = lanes%factor(i)*here + lanes%slope(i)*lanes%time(i)
      end associate
      if (.not. allocated(set%verticals)) return
      associate (here => set%verticals(lanes%next(i) - 1), next => set%verticals(lanes%next(i)))
         lanes%vertical_factor(i) = abs(factor)/gravity
         lanes%heavier_next(i) = lanes%vertical_factor(i)*next
         lanes%heavier_slope(i) = (lanes%heavier_next(i) - lanes%vertical_factor(i)*here)*lanes%rate(i)
         lanes%heavier(i) = lanes%vertical_factor(i)*here + lanes%heavier_slope(i)*lanes%time(i)
      end associate
   end subroutine aim

   !> An impact: the wall turns back, or rocks on to the other side, or comes to rest
   pure subroutine bounce(batch, i)
      !> The lanes, and the one
      type(lane_batch_type), intent(inout) :: batch
      integer, intent(in) :: i

      integer(c_int) :: interrupted
      logical :: at_rest

      associate (lanes => batch%lanes, history => batch%history(i), constants => batch%constants, &
         & record => batch%records(batch%history(i)%record))
         call look_for_interrupt(interrupted)
         history%over = interrupted == 1
         if (history%over) return
         history%interval = interval_of(batch, i)
         history%time = lanes%time(i)
         lanes%y(i) = 0.0_wp
         if (allocated(batch%grips)) call batch%grips(i)%strike(constants, lanes, i, history%rest)
         call history%strike(history%rest, record, lanes%u(i), lanes%v(i), constants%form%unit, at_rest)
         if (.not. at_rest) then
            call aim(lanes, i, batch%set, history%side*history%scale, constants%gravity)
            return
         end if
         lanes%v(i) = 0.0_wp
         call history%end_rocking(record)
         call history%leave_edge(record)
         call wait(batch, i)
      end associate
   end subroutine bounce

   !> At rest: go to the instant at which rocking begins
   pure subroutine wait(batch, i)
      !> The lanes, and the one
      type(lane_batch_type), intent(inout) :: batch
      integer, intent(in) :: i

      integer :: sample
      real(wp) :: trigger, high, acceleration, widening
      logical :: found

      associate (lanes => batch%lanes, history => batch%history(i), constants => batch%constants, &
         & record => batch%records(batch%history(i)%record), set => batch%set)
         associate (n => set%length(history%record), a => record%acceleration, interval => history%interval)
            history%over = interval >= n
            if (history%over) return
            ! Records are long: jump over the intervals in which nothing can start.
            trigger = history%rest%trigger()
            high = merge(trigger, huge(trigger), history%rest%two_sided)
            acceleration = history%scale*(a(interval) + (a(interval + 1) - a(interval))*(history%time/record%dt))
            sample = interval + 1
            if (allocated(record%vertical)) then
               widening = history%rest%vertical_lever/history%rest%lever
               trigger = trigger + widening*abs(history%scale)*record%vertical_at(interval, history%time)
            end if
            if (.not. (acceleration < -trigger .or. (history%rest%two_sided .and. acceleration > trigger))) then
               if (allocated(record%vertical)) then
                  sample = set%next_outside_of_both(history%record, sample, history%scale, history%rest%trigger(), &
                     & widening, history%rest%two_sided)
               else
                  sample = set%next_outside(history%record, sample, history%scale, -trigger, high)
               end if
            end if
            history%over = sample > n
            if (history%over) return
            if (sample - 1 > interval) then
               history%time = 0.0_wp
               interval = sample - 1
            end if
         end associate
         call history%rest%next_start(record, history%scale, history%interval, history%time, history%side, found)
         history%over = .not. found
         if (history%over) return
         call history%begin_rocking()
         lanes%next(i) = set%offset(history%record) + history%interval + 1
         lanes%time(i) = history%time
         lanes%next_span(i) = longest_step(constants%solver%steps_per_sample, record%dt, 0.0_wp)
         call limit_span(lanes, i, constants%solver%steps_per_sample)
         call aim(lanes, i, set, history%side*history%scale, constants%gravity)
      end associate
   end subroutine wait

   !> Sample interval of a lane
   pure integer function interval_of(batch, i) result(interval)
      !> The lanes, and the one
      type(lane_batch_type), intent(in) :: batch
      integer, intent(in) :: i

      interval = int(batch%lanes%next(i)) - 1 - batch%set%offset(batch%history(i)%record)
   end function interval_of

   !> The coordinate is a new peak
   pure subroutine set_peak(batch, i)
      !> The lanes, and the one
      type(lane_batch_type), intent(inout) :: batch
      integer, intent(in) :: i

      associate (lanes => batch%lanes, history => batch%history(i))
         lanes%peak(i) = lanes%y(i)
         history%peak = batch%constants%form%rotation(lanes%y(i))
         history%time_of_peak = time_of(batch, i)
      end associate
   end subroutine set_peak

   !> Time of a lane since the start of its record [s]
   pure real(wp) function time_of(batch, i)
      !> The lanes, and the one
      type(lane_batch_type), intent(in) :: batch
      integer, intent(in) :: i

      time_of = real(interval_of(batch, i) - 1, wp)*batch%lanes%dt(i) + batch%lanes%time(i)
   end function time_of

   !> The history is over: its result
   pure subroutine finish(batch, i)
      !> The lanes, and the one
      type(lane_batch_type), intent(inout) :: batch
      integer, intent(in) :: i

      real(wp) :: q, v, j, c, g, l, load
      type(tail_type) :: tail

      associate (lanes => batch%lanes, history => batch%history(i), constants => batch%constants, &
         & record => batch%records(batch%history(i)%record))
         if (lanes%y(i) > 0.0_wp .or. lanes%v(i) > 0.0_wp) then
            history%interval = interval_of(batch, i)
            call history%end_rocking(record)
            if (history%collapsed) then
               continue
            else if (allocated(batch%grips)) then
               call batch%grips(i)%after_record(constants, lanes%y(i), lanes%v(i), record%duration(), tail)
               call history%take_tail(tail, record)
            else
               q = constants%form%rotation(lanes%y(i))
               call batch%mechanism%terms(q, j, c, g, l, load)
               v = lanes%v(i)*constants%form%unit*sqrt(constants%rest%inertia/j)
               call history%add_free_motion(batch%mechanism, record, constants%limit, q, v)
            end if
         end if
         ! The first peak is no rotation that was reached.
         if (constants%first_peak > 0.0_wp) history%peak = 0.0_wp
         call history%finish(constants, record, batch%queue%response(history%number), batch%work)
      end associate
   end subroutine finish

end module dondolo_lane_history
