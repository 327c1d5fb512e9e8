!> The histories in lanes: how each begins, what its events do to it, and its result.
!>
!> The loop over lanes flags a lane where something may happen; what does happen is decided here, lane by lane, by the
!> rules that all engines share (dondolo_motion_history, dondolo_motion_rest, dondolo_motion_events; docs/theory.md, section 4).
module dondolo_motion_lane_history
   use, intrinsic :: iso_fortran_env, only : int8
   use dondolo_base_kinds, only : wp
   use dondolo_motion_elastic_filter, only : elastic_filter_type
   use dondolo_motion_elastic_flow, only : bent_type
   use dondolo_motion_events, only : impact, level_above, level_below, limit_reached, no_event, turning
   use dondolo_motion_history, only : history_type
   use dondolo_motion_lane_bending, only : bend, free_bent_motion, side_of
   use dondolo_motion_lane_constants, only : lane_constants_type
   use dondolo_motion_lane_events, only : find_event, found_type
   use dondolo_motion_lane_ground, only : aim, limit_span, next_sample, stop_between
   use dondolo_motion_lane_restraints, only : lane_restraints_type
   use dondolo_motion_lane_scatter, only : lane_scatter_type
   use dondolo_motion_lane_state, only : event_possible, lane_width, lanes_type
   use dondolo_motion_normal_form, only : power_series, y_limit
   use dondolo_motion_queue, only : queue_type
   use dondolo_motion_response, only : trace_type
   use dondolo_motion_rest, only : rest_type
   use dondolo_motion_step_limits, only : longest_step, shortest_motion
   use dondolo_motion_tail, only : tail_type
   use dondolo_motion_work, only : work_type
   use dondolo_record, only : record_type
   use dondolo_record_set, only : record_set_type
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: lane_batch_type, add_row, begin, begin_still, resolve

   !> A history in a lane. Its interval and time are those of its last event
   type, extends(history_type) :: lane_history_type
      !> Its number in the queue, and its record
      integer :: number = 0, record = 0
      !> The wall at rest, as its ties hold it
      type(rest_type) :: rest
      !> Signed motion of a wall that bends, when its joints last closed or its record ended
      type(bent_type) :: bent
      !> Whether it is over
      logical :: over = .false.
   end type lane_history_type

   !> The lanes of one thread, with all that their histories need
   type :: lane_batch_type
      !> State of the lanes, and the memory that it is in
      type(lanes_type), pointer :: lanes => null()
      integer(int8), allocatable :: room(:)
      !> Number of those at work, side by side
      integer :: active = 0
      !> Their events
      type(found_type) :: found
      !> The history in each lane
      type(lane_history_type) :: history(lane_width)
      !> The ties; not allocated for a wall without
      type(lane_restraints_type), allocatable :: restraints
      !> The speed ratios of impacts; not allocated for a wall with one for all
      type(lane_scatter_type), allocatable :: scatter
      !> Counts
      type(work_type) :: work
      !> The wall
      class(mechanism_type), pointer :: mechanism => null()
      type(lane_constants_type), pointer :: constants => null()
      !> Accelerograms, and the same joined
      type(record_type), pointer :: records(:) => null()
      type(record_set_type), pointer :: set => null()
      !> The motion of a wall that bends under each of them while its joints are closed; none for other walls
      type(elastic_filter_type), pointer :: filter(:) => null()
      !> Where histories come from and results go to
      type(queue_type), pointer :: queue => null()
      !> Where the rows of the one history go, if its motion is wanted
      type(trace_type), pointer :: trace => null()
      !> Time at which its present record begins [s]
      real(wp) :: start = 0.0_wp
      !> Steps since the last look whether the work is to end, and whether it is
      integer :: steps_since_look = 0
      logical :: is_broken_off = .false.
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
         lanes%released(i) = 0.0_wp
         if (allocated(batch%restraints)) call batch%restraints%begin(constants, lanes, i)
         if (allocated(batch%scatter)) call batch%scatter%begin(i, batch%records, history%record, history%scale)
         if (associated(batch%trace)) call batch%trace%add(0.0_wp, &
            & history%scale*batch%records(history%record)%acceleration(1), 0.0_wp, 0.0_wp, history%side)
         if (batch%mechanism%joint%exists) then
            call begin_bending(batch, i)
         else
            call wait(batch, i, 1)
         end if
         if (history%over) call finish(batch, i)
      end associate
   end subroutine begin

   !> Go on from the end of a record into another, of still ground; the result is left as it is
   pure subroutine begin_still(batch, i, record)
      !> The lanes, and the one, whose wall rocks
      type(lane_batch_type), intent(inout) :: batch
      integer, intent(in) :: i
      !> Number of the other record, of the same time step
      integer, intent(in) :: record

      associate (lanes => batch%lanes, history => batch%history(i), constants => batch%constants, set => batch%set)
         batch%start = batch%records(history%record)%duration()
         history = lane_history_type(number=history%number, record=record, scale=history%scale, side=history%side, &
            & peak=history%peak, rest=history%rest, bent=history%bent)
         if (batch%mechanism%joint%exists .and. .not. (lanes%y(i) > 0.0_wp .or. lanes%v(i) > 0.0_wp)) then
            lanes%last(i) = set%offset(record) + set%length(record)
            call go_on_bending(batch, i)
            return
         end if
         lanes%time(i) = 0.0_wp
         lanes%next(i) = set%offset(record) + 2
         lanes%last(i) = set%offset(record) + set%length(record)
         lanes%next_span(i) = longest_step(constants%solver%steps_per_sample, lanes%dt(i), 0.0_wp)
         lanes%span(i) = lanes%next_span(i)
         call aim(lanes, i, set, history%side*history%scale, constants%gravity)
         call history%begin_rocking()
      end associate
   end subroutine begin_still

   !> Take the step of a flagged lane, up to the first event in it
   pure subroutine resolve(batch, n)
      !> The lanes
      type(lane_batch_type), intent(inout) :: batch
      !> Place of the one among the flagged lanes
      integer, intent(in) :: n

      real(wp) :: part, h
      integer :: i, event
      logical :: may_hold

      i = batch%found%lane(n)
      may_hold = .false.
      associate (lanes => batch%lanes, history => batch%history(i), constants => batch%constants)
         if (lanes%flag(i) >= event_possible) call history%count_step(constants, int(lanes%next(i)), lanes%dt(i))
         if (history%given_up) then
            history%interval = interval_of(batch, i)
         else if (lanes%flag(i) >= event_possible) then
            call find_event(batch%found, n, lanes, batch%restraints, part, event)
            h = part*lanes%step(i)
            if (event == no_event .and. .not. lanes%time(i) + h < lanes%dt(i)) then
               call next_sample(lanes, i, batch%set)
               if (associated(batch%trace)) call add_row(batch, i)
            else
               call stop_between(lanes, i, batch%set, h)
               if (event /= no_event) call limit_span(lanes, i, constants%solver%steps_per_sample)
            end if
            if (event /= no_event) lanes%released(i) = 0.0_wp
            select case (event)
            case (impact)
               if (batch%mechanism%joint%exists) then
                  call close_joints(batch, i)
               else
                  call bounce(batch, i)
               end if
            case (level_above, level_below)
               call batch%restraints%cross(constants, lanes, i, event, time_of(batch, i), &
                  & h > shortest_motion*lanes%dt(i), may_hold)
            case (turning)
               lanes%v(i) = 0.0_wp
               ! Between two impacts it may turn below the peak.
               if (lanes%y(i) > lanes%peak(i)) call set_peak(batch, i)
               if (allocated(batch%restraints)) call batch%restraints%turn(constants, lanes, i, may_hold)
               history%collapsed = .not. lanes%y(i) < y_limit
               history%over = history%collapsed
            case (limit_reached)
               lanes%y(i) = y_limit
               call set_peak(batch, i)
               history%collapsed = .true.
               history%over = .true.
            end select
            if (may_hold .and. .not. history%over) call hold(batch, i)
            if (history%collapsed .and. associated(batch%trace)) call add_row(batch, i)
         end if
         history%over = history%over .or. history%given_up .or. lanes%next(i) > lanes%last(i)
         if (history%over) call finish(batch, i)
      end associate
   end subroutine resolve

   !> A motion outwards has ended: friction holds the wall there until the ground releases it, or the record is over
   pure subroutine hold(batch, i)
      !> The lanes, and the one
      type(lane_batch_type), intent(inout) :: batch
      integer, intent(in) :: i

      real(wp) :: back, on, b, d, now, next, going_back, going_on

      associate (lanes => batch%lanes, constants => batch%constants, form => batch%constants%form)
         call batch%restraints%held_between(constants, lanes, i, back, on)
         b = power_series(form%b, lanes%y(i) - 1.0_wp)
         d = power_series(form%d, lanes%y(i) - 1.0_wp)
         now = b*lanes%u(i) + d*lanes%heavier(i)
         ! Without friction it falls back at once.
         if (.not. now > back) return
         lanes%v(i) = 0.0_wp
         do
            next = b*lanes%u_next(i) + d*lanes%heavier_next(i)
            going_back = part_to_zero(back - now, back - next)
            going_on = part_to_zero(now - on, next - on)
            if (min(going_back, going_on) < 1.0_wp) exit
            call next_sample(lanes, i, batch%set)
            if (associated(batch%trace)) call add_row(batch, i)
            if (lanes%next(i) > lanes%last(i)) return
            now = next
         end do
         call stop_between(lanes, i, batch%set, min(going_back, going_on)*(lanes%dt(i) - lanes%time(i)))
         call limit_span(lanes, i, constants%solver%steps_per_sample)
         lanes%released(i) = -1.0_wp
         if (going_back < going_on) return
         lanes%released(i) = 1.0_wp
         call batch%restraints%go_on(constants, lanes, i, time_of(batch, i))
      end associate

   contains

      !> Part of the time at which a linear function becomes positive; huge: it does not
      pure real(wp) function part_to_zero(first, last) result(part)
         !> Its values at the beginning and at the end
         real(wp), intent(in) :: first, last

         part = huge(part)
         if (first > 0.0_wp) then
            part = 0.0_wp
         else if (last > 0.0_wp) then
            part = first/(first - last)
         end if
      end function part_to_zero

   end subroutine hold

   !> An impact: the wall turns back, or rocks on to the other side, or comes to rest
   pure subroutine bounce(batch, i)
      !> The lanes, and the one
      type(lane_batch_type), intent(inout) :: batch
      integer, intent(in) :: i

      real(wp) :: ratio
      logical :: at_rest

      associate (lanes => batch%lanes, history => batch%history(i), constants => batch%constants, &
         & record => batch%records(batch%history(i)%record))
         history%interval = interval_of(batch, i)
         history%time = lanes%time(i)
         lanes%y(i) = 0.0_wp
         lanes%v(i) = min(lanes%v(i), 0.0_wp)
         if (associated(batch%trace)) call add_row(batch, i)
         if (allocated(batch%restraints)) call batch%restraints%strike(constants, lanes, i, history%rest)
         ratio = history%rest%restitution
         if (allocated(batch%scatter)) then
            ratio = batch%scatter%next(i)
            call batch%scatter%go_on(i)
         end if
         call history%strike(history%rest, ratio, record, lanes%u(i), lanes%v(i), constants%form%unit, at_rest)
         if (allocated(batch%restraints)) call batch%restraints%face(constants, lanes, i, history%side, history%peak)
         if (associated(batch%trace)) call add_row(batch, i, after_impact=.true.)
         if (.not. at_rest) then
            call aim(lanes, i, batch%set, history%side*history%scale, constants%gravity)
            return
         end if
         lanes%v(i) = 0.0_wp
         call history%end_rocking(record)
         call history%leave_edge(record)
         call wait(batch, i, interval_of(batch, i))
      end associate
   end subroutine bounce

   !> A wall that bends, at rest at the start of its record
   pure subroutine begin_bending(batch, i)
      !> The lanes, and the one
      type(lane_batch_type), intent(inout) :: batch
      integer, intent(in) :: i

      associate (history => batch%history(i), filter => batch%filter(batch%history(i)%record))
         ! Most histories of low levels never open: their peak is that of the filter.
         history%over = filter%is_whole_motion(history%scale) .and. .not. associated(batch%trace)
         if (.not. history%over) then
            call go_on_bending(batch, i)
         else if (.not. batch%constants%first_peak > 0.0_wp) then
            history%peak = abs(history%scale)*filter%peak
            history%time_of_peak = filter%time_of_peak
         end if
      end associate
   end subroutine begin_bending

   !> The joints of a wall close that bends
   pure subroutine close_joints(batch, i)
      !> The lanes, and the one
      type(lane_batch_type), intent(inout) :: batch
      integer, intent(in) :: i

      associate (lanes => batch%lanes, history => batch%history(i), constants => batch%constants, &
         & joint => batch%mechanism%joint)
         history%interval = interval_of(batch, i)
         history%time = lanes%time(i)
         history%bent%x = history%side*joint%opening
         history%bent%v = history%side*min(lanes%v(i), 0.0_wp)*(constants%form%unit*sqrt(constants%rest%inertia/joint%inertia))
         lanes%y(i) = 0.0_wp
         lanes%v(i) = 0.0_wp
         call history%end_rocking(batch%records(history%record))
         call go_on_bending(batch, i)
      end associate
   end subroutine close_joints

   !> Joints that are closed: go to the instant at which they open, or to the end of the record
   pure subroutine go_on_bending(batch, i)
      !> The lanes, and the one
      type(lane_batch_type), intent(inout) :: batch
      integer, intent(in) :: i

      associate (lanes => batch%lanes, history => batch%history(i), constants => batch%constants, set => batch%set, &
         & record => batch%records(batch%history(i)%record), joint => batch%mechanism%joint)
         if (associated(batch%trace)) then
            call bend(constants, batch%filter(history%record), record, history%history_type, history%bent, &
               & batch%trace, batch%start)
         else
            call bend(constants, batch%filter(history%record), record, history%history_type, history%bent)
            if (.not. (history%given_up .or. history%peak >= joint%opening)) then
               ! It never opened. Jumps passed over its peak, which is where nothing else happened.
               history = lane_history_type(number=history%number, record=history%record, scale=history%scale, rest=history%rest)
               call bend(constants, batch%filter(history%record), record, history%history_type, history%bent, &
                  & without_jumps=.true.)
            end if
         end if
         lanes%next(i) = set%offset(history%record) + history%interval + 1
         ! Joints that open at the very end of the record do so in its free motion.
         history%over = history%given_up .or. history%interval == set%length(history%record)
         if (history%over) return
         history%side = side_of(history%bent, history%side)
         call history%begin_rocking()
         ! Joints that are only touched open with no speed at all; it takes one to leave y = 0.
         lanes%y(i) = 0.0_wp
         lanes%v(i) = max(abs(history%bent%v), shortest_motion*joint%speed)*sqrt(joint%inertia/constants%rest%inertia) &
            & /constants%form%unit
         lanes%time(i) = history%time
         lanes%next_span(i) = longest_step(constants%solver%steps_per_sample, record%dt, 0.0_wp)
         call limit_span(lanes, i, constants%solver%steps_per_sample)
         call aim(lanes, i, set, history%side*history%scale, constants%gravity)
      end associate
   end subroutine go_on_bending

   !> At rest: go to the instant at which rocking begins, or to the end of the record
   pure subroutine wait(batch, i, since)
      !> The lanes, and the one
      type(lane_batch_type), intent(inout) :: batch
      integer, intent(in) :: i
      !> Sample interval since which it rests
      integer, intent(in) :: since

      real(wp) :: side
      integer :: sample

      side = batch%history(i)%side
      call find_start(batch, i)
      if (.not. associated(batch%trace) .or. batch%start > 0.0_wp) return
      associate (history => batch%history(i), record => batch%records(batch%history(i)%record))
         do sample = since + 1, merge(size(record%acceleration), history%interval, history%over)
            call batch%trace%add(real(sample - 1, wp)*record%dt, history%scale*record%acceleration(sample), 0.0_wp, &
               & 0.0_wp, side)
         end do
      end associate
   end subroutine wait

   !> The instant at which rocking begins; the history is over if it does not
   pure subroutine find_start(batch, i)
      !> The lanes, and the one at rest
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
         if (allocated(batch%restraints)) call batch%restraints%face(constants, lanes, i, history%side, history%peak)
         lanes%next(i) = set%offset(history%record) + history%interval + 1
         lanes%time(i) = history%time
         lanes%next_span(i) = longest_step(constants%solver%steps_per_sample, record%dt, 0.0_wp)
         call limit_span(lanes, i, constants%solver%steps_per_sample)
         call aim(lanes, i, set, history%side*history%scale, constants%gravity)
      end associate
   end subroutine find_start

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
         ! Where ties hold on one side alone, peaks of that side matter that are not the largest of both.
         if (allocated(batch%restraints) .and. batch%constants%form%rotation(lanes%y(i)) < history%peak) return
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

      real(wp) :: q, v, ratio
      type(tail_type) :: tail
      logical :: is_open

      associate (lanes => batch%lanes, history => batch%history(i), constants => batch%constants, &
         & record => batch%records(batch%history(i)%record))
         is_open = lanes%y(i) > 0.0_wp .or. lanes%v(i) > 0.0_wp
         if (is_open) then
            history%interval = interval_of(batch, i)
            call history%end_rocking(record)
            ratio = batch%mechanism%restitution
            if (allocated(batch%scatter)) ratio = batch%scatter%next(i)
            if (history%collapsed .or. history%given_up) then
               continue
            else if (allocated(batch%restraints)) then
               call batch%restraints%after_record(constants, i, ratio, lanes%y(i), lanes%v(i), record%duration(), tail)
               call history%take_tail(tail, record)
            else if (batch%mechanism%joint%exists) then
               call find_motion(batch, i, q, v)
               history%bent = bent_type(q, v)
            else
               call find_motion(batch, i, q, v)
               call history%add_free_motion(batch%mechanism, record, constants%limit, q, v, ratio)
            end if
         end if
         if (batch%mechanism%joint%exists .and. .not. (history%collapsed .or. history%given_up)) then
            call free_bent_motion(batch%mechanism, constants%limit, history%peak, is_open, history%bent, tail)
            call history%take_tail(tail, record)
         end if
         ! The first peak is no rotation that was reached.
         if (constants%first_peak > 0.0_wp) history%peak = 0.0_wp
         call history%finish(constants, record, batch%queue%response(history%number), batch%work)
      end associate
   end subroutine finish

   !> Rotation and angular velocity of a lane
   pure subroutine find_motion(batch, i, q, v)
      !> The lanes, and the one
      type(lane_batch_type), intent(in) :: batch
      integer, intent(in) :: i
      !> Rotation [rad], and its rate, both seen from the side of the wall [rad/s]
      real(wp), intent(out) :: q, v

      real(wp) :: j, c, g, l, load

      associate (lanes => batch%lanes, constants => batch%constants)
         q = constants%form%rotation(lanes%y(i))
         call batch%mechanism%terms(q, j, c, g, l, load)
         v = lanes%v(i)*constants%form%unit*sqrt(constants%rest%inertia/j)
      end associate
   end subroutine find_motion

   !> Add the present motion of a lane to the trace
   pure subroutine add_row(batch, i, after_impact)
      !> The lanes, and the one
      type(lane_batch_type), intent(inout) :: batch
      integer, intent(in) :: i
      !> Is it the row just after an impact? No, if absent
      logical, intent(in), optional :: after_impact

      real(wp) :: q, v, ground

      associate (lanes => batch%lanes, history => batch%history(i), constants => batch%constants, trace => batch%trace)
         call find_motion(batch, i, q, v)
         if (lanes%y(i) == 0.0_wp) q = constants%form%first
         ! The lane sees the ground from the side that it was on before an impact.
         ground = lanes%u(i)*sign(1.0_wp, lanes%factor(i))*sign(1.0_wp, history%scale)
         call trace%add(batch%start + time_of(batch, i), ground, history%side*q, history%side*v, history%side)
         if (present(after_impact) .and. .not. trace%lacks_memory) trace%after_impact(trace%rows) = .true.
      end associate
   end subroutine add_row

end module dondolo_motion_lane_history
