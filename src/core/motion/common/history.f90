!> State of a history that does not depend on the engine, and the decisions that every engine takes alike: start and end of
!> rocking, impacts, free motion after the record, result (docs/theory.md, section 4).
module dondolo_motion_history
   use dondolo_base_kinds, only : wp
   use dondolo_motion_response, only : response_type
   use dondolo_motion_rest, only : bounce_type, rest_type
   use dondolo_motion_step_limits, only : fewest_steps, most_steps, shortest_motion
   use dondolo_motion_tail, only : free_motion, tail_type
   use dondolo_motion_wall_constants, only : wall_constants_type
   use dondolo_motion_work, only : work_type
   use dondolo_record, only : record_type
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: history_type, starting_acceleration

   !> One wall under one accelerogram, up to the present
   type :: history_type
      !> Factor on the accelerogram, negative to reverse it
      real(wp) :: scale = 1.0_wp
      !> Side of the wall, +1 or -1
      real(wp) :: side = 1.0_wp
      !> Sample interval, from 1, and time since its first sample [s]
      integer :: interval = 1
      real(wp) :: time = 0.0_wp
      !> Largest rotation so far [rad] and its time [s]
      real(wp) :: peak = 0.0_wp, time_of_peak = 0.0_wp
      !> Impacts so far, and bounces in a row that are low, and lowest
      integer :: impacts = 0, low_bounces(2) = 0
      !> Whether the wall has moved, and whether it has collapsed
      logical :: moved = .false., collapsed = .false.
      !> Whether it was given up, which leaves no result
      logical :: given_up = .false.
      !> Sample intervals in which it has rocked, and the last of them
      integer, private :: rocked = 0, last_rocked = 0
      !> Instant at which it last began to rock: sample interval, and time in it [s]
      integer, private :: start_interval = 0
      real(wp), private :: start_time = 0.0_wp
      !> Sample that stops a chain of bounces, from the last look at one
      integer, private :: stopper = 0
      !> Place of the sample interval in which steps are counted, and how many there were
      integer, private :: counted = 0, steps_there = 0
   contains
      !> Count a step, and give the history up after too many
      procedure :: count_step
      !> Rocking begins now
      procedure :: begin_rocking
      !> Rocking ends now
      procedure :: end_rocking
      !> Leave the edge of the trigger
      procedure :: leave_edge
      !> Apply an impact
      procedure :: strike
      !> Whether the wall comes to rest after an impact
      procedure, private :: settle
      !> Add the free motion after the record
      procedure :: add_free_motion
      !> Take what happens after the record
      procedure :: take_tail
      !> Result, once the history is over
      procedure :: finish
   end type history_type

contains

   !> Acceleration, or a multiple of it: a wall at rest begins to rock where its moment is zero, thus never inwards,
   !> whatever rounding gives
   elemental real(wp) function starting_acceleration(q, v, f) result(outward)
      !> Rotation and velocity, in any unit
      real(wp), intent(in) :: q, v
      !> The acceleration as computed
      real(wp), intent(in) :: f

      outward = f
      if (q == 0.0_wp .and. v == 0.0_wp) outward = max(0.0_wp, f)
   end function starting_acceleration

   !> Count a step, or an event, of the present sample interval. A history that does not get out of one, whatever keeps it there,
   !> is given up: it must end, and must not pass for one that survived
   elemental subroutine count_step(self, constants, place, dt)
      class(history_type), intent(inout) :: self
      !> Constants of the wall
      class(wall_constants_type), intent(in) :: constants
      !> Place of the sample interval among those of the history, counted from anywhere
      integer, intent(in) :: place
      !> Its length [s]
      real(wp), intent(in) :: dt

      if (place /= self%counted) then
         self%counted = place
         self%steps_there = 0
      end if
      self%steps_there = self%steps_there + 1
      if (self%steps_there > fewest_steps) self%given_up = self%steps_there > most_steps(dt, constants%fastest)
   end subroutine count_step

   !> Rocking begins now
   elemental subroutine begin_rocking(self)
      class(history_type), intent(inout) :: self

      self%moved = .true.
      self%start_interval = self%interval
      self%start_time = self%time
   end subroutine begin_rocking

   !> Rocking ends now: at rest, by collapse, or since the record is over
   pure subroutine end_rocking(self, record)
      class(history_type), intent(inout) :: self
      type(record_type), intent(in) :: record

      integer :: interval

      interval = min(self%interval, size(record%acceleration) - 1)
      self%rocked = self%rocked + interval - max(self%start_interval - 1, self%last_rocked)
      self%last_rocked = interval
      self%low_bounces = 0
   end subroutine end_rocking

   !> Leave the edge of the trigger, if rounding undid the last start at once, so that it is not repeated forever.
   !>
   !> Nothing more starts on that side in this interval: go on to where the accelerogram changes its sign, or to the next
   !> sample
   pure subroutine leave_edge(self, record)
      !> The history: at rest
      class(history_type), intent(inout) :: self
      type(record_type), intent(in) :: record

      real(wp) :: crossing

      if (self%interval /= self%start_interval .or. self%time - self%start_time > shortest_motion*record%dt) return
      associate (here => record%acceleration(self%interval), next => record%acceleration(self%interval + 1))
         crossing = 0.0_wp
         if (here > 0.0_wp .neqv. next > 0.0_wp) crossing = record%dt*(here/(here - next))
      end associate
      if (crossing > self%time) then
         self%time = crossing
      else
         self%interval = self%interval + 1
         self%time = 0.0_wp
      end if
   end subroutine leave_edge

   !> Apply an impact: the wall loses speed, a two-sided wall changes side, and it may come to rest
   pure subroutine strike(self, rest, ratio, record, acceleration, v, unit, at_rest)
      class(history_type), intent(inout) :: self
      !> The wall at rest
      type(rest_type), intent(in) :: rest
      !> Speed after this impact / speed before it
      real(wp), intent(in) :: ratio
      !> The accelerogram; zero after its last sample
      type(record_type), intent(in) :: record
      !> Ground acceleration at the impact, seen from the side of the wall before it [m/s2]
      real(wp), intent(in) :: acceleration
      !> Velocity; in: before the impact, positive only by rounding; out: after it
      real(wp), intent(inout) :: v
      !> Its unit [rad/s]
      real(wp), intent(in) :: unit
      !> Whether the wall comes to rest
      logical, intent(out) :: at_rest

      real(wp) :: ground

      self%impacts = self%impacts + 1
      v = -ratio*min(v, 0.0_wp)
      ground = self%side*acceleration
      if (rest%two_sided) self%side = -self%side
      call self%settle(rest, record, ground, v*unit, at_rest)
   end subroutine strike

   !> Whether the wall comes to rest after an impact; otherwise it rocks on, or bounces and the next impact decides
   pure subroutine settle(self, rest, record, ground, speed, at_rest)
      !> The history: just after the impact
      class(history_type), intent(inout) :: self
      !> The wall at rest
      type(rest_type), intent(in) :: rest
      type(record_type), intent(in) :: record
      !> Ground acceleration [m/s2]
      real(wp), intent(in) :: ground
      !> Speed after the impact [rad/s]
      real(wp), intent(in) :: speed
      !> Whether it does
      logical, intent(out) :: at_rest

      real(wp) :: vertical, moment, energy

      energy = 0.5_wp*rest%inertia*speed**2
      self%low_bounces = merge(self%low_bounces + 1, 0, energy < rest%low_energy)
      vertical = 0.0_wp
      if (allocated(record%vertical)) vertical = abs(self%scale)*record%vertical_at(self%interval, self%time)
      moment = rest%inward_moment(self%side, ground, vertical)
      at_rest = speed == 0.0_wp .or. any(self%low_bounces > rest%most_low_bounces)
      if (at_rest .or. moment <= 0.0_wp) return
      at_rest = 2.0_wp*speed*rest%inertia <= shortest_motion*record%dt*moment
      ! A chain must not rise beyond its bounds. Where it has many bounces only some impacts look at it, since each look
      ! may go through the whole record.
      if (at_rest .or. energy > moment*min(rest%height, self%peak)) return
      if (modulo(self%impacts, rest%bounces_per_look) == 0) call rest%chain_ends(record, self%scale, &
         & bounce_type(self%interval, self%time, self%side, speed, self%peak), self%stopper, at_rest)
   end subroutine settle

   !> Add the free motion of a wall that still rocks when the record ends
   pure subroutine add_free_motion(self, mechanism, record, limit, q, v, ratio)
      class(history_type), intent(inout) :: self
      class(mechanism_type), intent(in) :: mechanism
      type(record_type), intent(in) :: record
      !> Rotation that counts as collapse [rad]
      real(wp), intent(in) :: limit
      !> Rotation [rad] and angular velocity, positive outwards [rad/s], at the end of the record
      real(wp), intent(in) :: q, v
      !> Speed ratio of the next impact
      real(wp), intent(in) :: ratio

      type(tail_type) :: tail

      call free_motion(mechanism, limit, self%peak, q, v, ratio, tail)
      call self%take_tail(tail, record)
   end subroutine add_free_motion

   !> Take what happens after the record: a collapse, a new peak
   pure subroutine take_tail(self, tail, record)
      class(history_type), intent(inout) :: self
      type(tail_type), intent(in) :: tail
      type(record_type), intent(in) :: record

      self%collapsed = tail%collapsed
      if (.not. tail%peak > self%peak) return
      self%peak = tail%peak
      self%time_of_peak = record%duration() + tail%delay
   end subroutine take_tail

   !> Result and counts of a history that is over
   pure subroutine finish(self, constants, record, response, work)
      class(history_type), intent(in) :: self
      class(wall_constants_type), intent(in) :: constants
      type(record_type), intent(in) :: record
      type(response_type), intent(out) :: response
      !> Counts, added to; steps and evaluations are counted by the engine
      type(work_type), intent(inout), optional :: work

      response%edp = self%peak/constants%capacity
      ! A peak that differs from the limit only by rounding is a collapse too.
      response%collapsed = self%collapsed .or. response%edp >= constants%solver%edp_limit .or. &
         & self%peak >= constants%limit
      if (response%collapsed) response%edp = constants%solver%edp_limit
      response%impacts = self%impacts
      response%time_of_peak = self%time_of_peak
      if (self%given_up) then
         ! Its callers report it; those that do not check must not count it as a survivor.
         response%is_whole = .false.
         response%collapsed = .true.
         response%edp = constants%solver%edp_limit
         response%time_of_peak = real(self%interval - 1, wp)*record%dt
      end if
      if (.not. present(work)) return
      work%histories = work%histories + 1
      if (.not. self%moved) work%still = work%still + 1
      work%intervals = work%intervals + size(record%acceleration) - 1
      work%rocked = work%rocked + self%rocked
      work%impacts = work%impacts + self%impacts
   end subroutine finish

end module dondolo_motion_history
