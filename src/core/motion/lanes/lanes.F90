!> The engine lanes: many histories of one wall in lockstep, a vector of them at a time.
!>
!> Each lane holds one history and has its own time. All lanes take a step at once (dondolo_motion_lane_kernel); flagged ones
!> are seen to one by one (dondolo_motion_lane_history). A lane whose history is over takes the next from the queue, so that
!> vectors stay full. What a history gives depends neither on its lane nor on those beside it.
module dondolo_motion_lanes
   use, intrinsic :: iso_c_binding, only : c_int
   use, intrinsic :: iso_fortran_env, only : compiler_options, int64
   use, intrinsic :: omp_lib, only : omp_get_num_threads
   use dondolo_base_interrupt, only : look_for_interrupt
   use dondolo_base_kinds, only : wp
   use dondolo_motion_elastic_filter, only : elastic_filter_type, new_elastic_filter
   use dondolo_motion_lane_constants, only : lane_constants_type
   use dondolo_motion_lane_events, only : find_lane_events
   use dondolo_motion_lane_history, only : add_row, begin, begin_still, lane_batch_type, resolve
   use dondolo_motion_lane_kernel, only : step_lanes
   use dondolo_motion_lane_restraints, only : lane_restraints_type
   use dondolo_motion_lane_state, only : event_possible, lane_width, move_lane, place_lanes, vector_width
   use dondolo_motion_queue, only : queue_type
   use dondolo_motion_response, only : intervals_after, trace_type
   use dondolo_motion_work, only : work_type
   use dondolo_record, only : record_type
   use dondolo_record_set, only : new_record_set, record_set_type
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: lane_options, simulate_lanes, trace_lanes

   !> Options of the compiler that the engine is compiled with
   character(len=*), parameter :: lane_options = compiler_options()

   !> A batch at its beginning. Each is a copy of it in memory of its own: a batch is larger than the stack that a thread may have,
   !> and gfortran takes a copy on the stack to initialise what is allocated without a source
   type(lane_batch_type), protected :: empty

contains

   !> Histories of one wall, as long as the queue has some
   subroutine simulate_lanes(mechanism, constants, records, set, filter, queue, work)
      class(mechanism_type), intent(in), target :: mechanism
      type(lane_constants_type), intent(in), target :: constants
      type(record_type), intent(in), target :: records(:)
      !> The same, joined
      type(record_set_type), intent(in), target :: set
      !> The motion of a wall that bends under each while its joints are closed; none for other walls
      type(elastic_filter_type), intent(in), target :: filter(:)
      !> The histories, and their results; shared with other threads
      type(queue_type), intent(inout), target :: queue
      !> Counts, added to
      type(work_type), intent(inout) :: work

      type(lane_batch_type), allocatable, target :: batch
      integer :: i, n, most

      allocate (batch, source=empty)
      call place_lanes(batch%room, batch%lanes)
      batch%mechanism => mechanism
      batch%constants => constants
      batch%records => records
      batch%set => set
      batch%filter => filter
      batch%queue => queue
      if (constants%form%is_restrained) then
         allocate (batch%restraints)
         call batch%restraints%make(mechanism, lane_width)
      end if
      if (mechanism%scatter%exists()) then
         allocate (batch%scatter)
         call batch%scatter%make(mechanism, size(records))
      end if
      most = most_lanes(size(queue%record), omp_get_num_threads())
      do while (batch%active < most)
         if (.not. is_filled(batch%active + 1)) exit
         batch%active = batch%active + 1
      end do
      do while (batch%active > 0 .and. .not. batch%is_broken_off)
         call step(batch)
         ! From the last on, so that the lane that moves in where no history is left has been seen
         do n = batch%found%n, 1, -1
            i = batch%found%lane(n)
            if (.not. batch%history(i)%over) cycle
            call queue%report()
            if (is_filled(i)) cycle
            ! The last lane moves in, so that those at work stay side by side.
            call move(batch, batch%active, i)
            ! What it leaves behind may be stepped as part of a vector, but gets nowhere: on the ground and falling, it takes
            ! no step. Else it would run past the samples of its record.
            batch%lanes%y(batch%active) = 0.0_wp
            batch%lanes%v(batch%active) = -1.0_wp
            batch%active = batch%active - 1
         end do
      end do
      batch%work%evaluations = batch%work%steps
      batch%work%in_lanes = batch%work%histories
      call work%add(batch%work)

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
            call begin(batch, i, number)
            if (.not. batch%history(i)%over) return
            call queue%report()
         end do
      end function is_filled

   end subroutine simulate_lanes

   !> Lanes for each thread of a team: no more than a part of its histories, so that none has all that are left at the end
   !> while others wait
   pure integer function most_lanes(histories, threads)
      !> Histories in the queue
      integer, intent(in) :: histories
      !> Threads that share them
      integer, intent(in) :: threads

      integer, parameter :: rounds = 4, fewest = 16

      most_lanes = lane_width
      if (threads > 1) most_lanes = min(lane_width, max(fewest, histories/(rounds*threads)/vector_width*vector_width))
   end function most_lanes

   !> A step of every lane at work, with what happens in it
   subroutine step(batch)
      type(lane_batch_type), intent(inout) :: batch

      ! To look whether the work is to end takes as long as an event; all these steps take less than a millisecond.
      integer, parameter :: steps_between_looks = 64
      integer(c_int) :: interrupted
      integer :: n

      associate (constants => batch%constants, set => batch%set)
         if (constants%form%is_shaken) then
            call step_lanes(batch%lanes, batch%active, constants%form, set%samples, constants%solver%rtol, constants%atol, &
               & set%verticals)
         else
            call step_lanes(batch%lanes, batch%active, constants%form, set%samples, constants%solver%rtol, constants%atol)
         end if
      end associate
      batch%work%steps = batch%work%steps + batch%active
      call find_lane_events(batch%found, batch%lanes, batch%active, batch%constants)
      do n = 1, batch%found%n
         call resolve(batch, n)
      end do
      batch%steps_since_look = batch%steps_since_look + 1
      if (batch%steps_since_look < steps_between_looks) return
      batch%steps_since_look = 0
      call look_for_interrupt(interrupted)
      batch%is_broken_off = interrupted == 1
   end subroutine step

   !> The motion of one history, by the steps that it takes in a batch: at every sample and before and after every impact,
   !> until rest or the end of the still ground after the record
   subroutine trace_lanes(mechanism, constants, record, scale, trace)
      class(mechanism_type), intent(in), target :: mechanism
      type(lane_constants_type), intent(in), target :: constants
      type(record_type), intent(in) :: record
      !> Factor on it, negative to reverse its polarity
      real(wp), intent(in) :: scale
      !> The motion
      type(trace_type), intent(inout), target :: trace

      type(lane_batch_type), allocatable, target :: batch
      type(record_type), target :: records(2)
      type(record_set_type), target :: set
      type(elastic_filter_type), allocatable, target :: filter(:)
      type(queue_type), target :: queue
      type(lane_restraints_type), allocatable :: kept
      integer(int64) :: next

      allocate (batch, source=empty)
      call place_lanes(batch%room, batch%lanes)
      records(1) = record
      records(2)%dt = record%dt
      allocate (records(2)%acceleration(intervals_after(record%dt) + 1), source=0.0_wp)
      call new_record_set(set, records)
      call queue%fill([1], [scale], [1])
      batch%mechanism => mechanism
      batch%constants => constants
      batch%records => records
      batch%set => set
      if (mechanism%joint%exists) then
         allocate (filter(2))
         filter = [new_elastic_filter(mechanism%joint, records(1)), new_elastic_filter(mechanism%joint, records(2))]
         batch%filter => filter
      end if
      batch%queue => queue
      batch%trace => trace
      if (constants%form%is_restrained) then
         allocate (batch%restraints)
         call batch%restraints%make(mechanism, 1)
      end if
      if (mechanism%scatter%exists()) then
         allocate (batch%scatter)
         call batch%scatter%make(mechanism, size(records))
      end if
      call begin(batch, 1, 1)
      batch%active = 1
      if (mechanism%joint%exists .and. batch%history(1)%over .and. rocks_on()) call begin_still(batch, 1, 2)
      do while (.not. (batch%history(1)%over .or. trace%lacks_memory .or. batch%is_broken_off))
         ! At its end a history looks ahead with its ties; the trace goes on from how they are now.
         if (allocated(batch%restraints)) kept = batch%restraints
         next = batch%lanes%next(1)
         call step(batch)
         ! Of a flagged lane it has been added.
         if (batch%lanes%flag(1) < event_possible .and. batch%lanes%next(1) > next) call add_row(batch, 1)
         if (.not. batch%history(1)%over .or. batch%history(1)%record /= 1) cycle
         if (allocated(batch%restraints)) call batch%restraints%responses(1, batch%history(1)%peak, trace%ties)
         if (.not. rocks_on()) cycle
         if (allocated(kept)) batch%restraints = kept
         call begin_still(batch, 1, 2)
      end do
      ! A wall that never moves has no step.
      if (allocated(batch%restraints) .and. .not. allocated(trace%ties)) call batch%restraints%responses(1, 0.0_wp, trace%ties)
      trace%is_whole = queue%response(1)%is_whole
      call trace%trim_rows()

   contains

      !> Does the wall still rock as the accelerogram ends? One that bends swings on
      pure logical function rocks_on()
         rocks_on = batch%lanes%next(1) > batch%lanes%last(1) .and. (batch%lanes%y(1) > 0.0_wp .or. batch%lanes%v(1) > 0.0_wp &
            & .or. mechanism%joint%exists)
      end function rocks_on

   end subroutine trace_lanes

   !> Move a lane
   subroutine move(batch, from, to)
      type(lane_batch_type), intent(inout) :: batch
      !> The lane, and where it goes
      integer, intent(in) :: from, to

      batch%history(to) = batch%history(from)
      if (allocated(batch%restraints)) call batch%restraints%move(from, to)
      if (allocated(batch%scatter)) call batch%scatter%move(from, to)
      call move_lane(batch%lanes, from, to)
   end subroutine move

end module dondolo_motion_lanes
