!> The motion of a floor, or what a wall between its supports feels: records filtered by the modes of a building, exactly.
!>
!> The result at refined samples is a record like any other: linear between them (docs/theory.md, section 1). Records are filtered
!> side by side (dondolo_record_oscillators), in blocks: whatever a wall feels is mixed of the swing of a block at once, which is
!> not kept. Whoever's record is over takes the next.
module dondolo_building_floor_motion
   use dondolo_base_error, only : error_type, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_limits, only : most_samples
   use dondolo_base_memory, only : keep_freed
   use dondolo_base_order, only : make_order
   use dondolo_base_text, only : to_text
   use dondolo_base_threads, only : team_of
   use dondolo_building, only : building_type
   use dondolo_building_swing, only : new_swing, swing_type
   use dondolo_record, only : record_type
   use dondolo_record_oscillators, only : block, oscillators_type, side_by_side, swing, swing_driven
   implicit none
   private

   public :: filter_record, filter_records, floor_samples

   !> Records that several threads take from
   type :: queue_type
      !> The building under records of each time step, and which of them a record has
      type(swing_type), allocatable :: swings(:)
      integer, allocatable :: swing_of(:)
      !> Samples of the motion under each record
      real(wp), allocatable :: samples(:)
      !> Records in the order from the last of which they are taken, and how many of them are left
      integer, allocatable :: order(:)
      integer :: left = 0
   end type queue_type

   !> Places side by side, each with a record
   type :: places_type
      !> Number of the record in each; 0: none is left
      integer :: record(side_by_side) = 0
      !> Kind of its swing, last sample of its motion that is known, the one at which its ground comes to rest, and the last of all
      integer, dimension(side_by_side) :: swing = 0, at = 0, still_at = 0, last = 0
      !> Steps that the present block takes in each
      integer :: steps(side_by_side) = 0
      !> The oscillators, those of one number together
      type(oscillators_type), allocatable :: oscillators(:)
      !> How modes drive the diaphragm: displacement (1) and velocity (2) by those of each
      real(wp), allocatable :: driven_by_u(:, :, :), driven_by_w(:, :, :)
      !> What walls feel of the ground, and of each oscillator; what delta has of each
      real(wp) :: felt_of_ground(side_by_side) = 0.0_wp
      real(wp), allocatable :: felt_of_u(:, :), felt_of_w(:, :), drift_of_u(:, :)
      !> The ground of a block, from the start of its first step, and displacement and velocity of each oscillator
      real(wp), allocatable :: ground(:, :), u(:, :, :), w(:, :, :)
      !> What walls feel, delta, and the largest |delta| so far
      real(wp), allocatable :: felt(:, :), delta(:, :)
      real(wp) :: largest(side_by_side) = 0.0_wp
   end type places_type

contains

   !> Number of samples of the motion of a floor
   pure real(wp) function floor_samples(building, record) result(samples)
      type(building_type), intent(in) :: building
      !> Acceleration of the ground
      type(record_type), intent(in) :: record

      real(wp) :: parts, free

      parts = real(building%parts(record%dt), wp)
      free = building%free_vibration()/record%dt*parts
      samples = real(size(record%acceleration) - 1, wp)*parts + 1.0_wp + aint(free) + merge(1.0_wp, 0.0_wp, free > 0.0_wp)
   end function floor_samples

   !> Absolute acceleration that moves the wall under one record. After it the ground is still and the building swings freely
   subroutine filter_record(building, ground, floor, error)
      type(building_type), intent(in) :: building
      !> Acceleration of the ground
      type(record_type), intent(in) :: ground
      !> That of the floor, of the same name
      type(record_type), intent(out) :: floor
      !> It has too many samples
      type(error_type), allocatable, intent(out) :: error

      type(record_type), allocatable :: floors(:)
      real(wp), allocatable :: drift(:)

      if (floor_samples(building, ground) > real(most_samples, wp)) then
         call raise_input(error, 'building: the motion of its floor under record '''//ground%name//''' has more than '// &
            & to_text(most_samples)//' samples')
         return
      end if
      call filter_records(building, [ground], 1, floors, drift)
      floor = floors(1)
   end subroutine filter_record

   !> The same under several records, of which none has too many samples
   subroutine filter_records(building, ground, threads, floors, drift)
      type(building_type), intent(in) :: building
      !> Accelerations of the ground
      type(record_type), intent(in) :: ground(:)
      !> Number of threads; 0: all that OpenMP gives
      integer, intent(in) :: threads
      !> Those of the floor, of the same names
      type(record_type), allocatable, intent(out) :: floors(:)
      !> Greatest |delta| over the height of the line through the supports in each [rad]
      real(wp), allocatable, intent(out) :: drift(:)

      type(queue_type) :: queue
      integer :: i, k

      allocate (queue%swings(0), queue%swing_of(size(ground)), queue%samples(size(ground)))
      do i = 1, size(ground)
         queue%samples(i) = floor_samples(building, ground(i))
         do k = 1, size(queue%swings)
            if (.not. abs(queue%swings(k)%step - ground(i)%dt) > 0.0_wp) exit
         end do
         queue%swing_of(i) = k
         if (k > size(queue%swings)) queue%swings = [queue%swings, swing_of_step(building, ground(i)%dt)]
      end do
      ! Long ones first, so that places end together
      call make_order(queue%samples, queue%order)
      queue%left = size(ground)
      ! The motions of one wall after another
      call keep_freed()
      allocate (floors(size(ground)), drift(size(ground)))
      drift = 0.0_wp
      !$omp parallel num_threads(team_of(threads, (size(ground) - 1)/side_by_side + 1)) default(none) &
      !$omp & shared(building, ground, floors, drift, queue)
      call filter_some(building, ground, queue, floors, drift)
      !$omp end parallel
   end subroutine filter_records

   !> A swing as a value
   pure type(swing_type) function swing_of_step(building, step) result(swing)
      type(building_type), intent(in) :: building
      !> Time step of the records [s]
      real(wp), intent(in) :: step

      call new_swing(swing, building, step)
   end function swing_of_step

   !> Filter records until none is left; several threads do so at once
   subroutine filter_some(building, ground, queue, floors, drift)
      type(building_type), intent(in) :: building
      !> Accelerations of the ground
      type(record_type), intent(in) :: ground(:)
      !> Where they are taken from
      type(queue_type), intent(inout) :: queue
      !> Motions of the floor
      type(record_type), intent(inout) :: floors(:)
      !> Greatest drift in each [rad]
      real(wp), intent(inout) :: drift(:)

      type(places_type), allocatable :: places
      integer :: k

      allocate (places)
      call make_room(places, size(queue%swings(1)%by_u, 2), size(queue%swings(1)%driven_by_u, 2))
      do k = 1, side_by_side
         call take_next(k)
      end do
      do while (any(places%record > 0))
         do k = 1, side_by_side
            places%steps(k) = 0
            if (places%record(k) > 0) call load_ground(places, k, queue%swings(places%swing(k))%parts, &
               & ground(places%record(k))%acceleration)
         end do
         call advance(places, queue%swings(1)%has_diaphragm)
         do k = 1, side_by_side
            if (places%record(k) == 0) cycle
            call store(places, k, floors(places%record(k))%acceleration)
            if (places%at(k) < places%last(k)) cycle
            if (building%height > 0.0_wp) drift(places%record(k)) = places%largest(k)/building%height
            call take_next(k)
         end do
      end do

   contains

      !> Let a place take the next record, if there is one
      subroutine take_next(k)
         !> The place
         integer, intent(in) :: k

         integer :: place

         !$omp atomic capture
         place = queue%left
         queue%left = queue%left - 1
         !$omp end atomic
         places%record(k) = 0
         if (place < 1) return
         places%record(k) = queue%order(place)
         associate (i => places%record(k))
            places%swing(k) = queue%swing_of(i)
            call begin(places, k, queue%swings(places%swing(k)), ground(i), nint(queue%samples(i)), floors(i))
         end associate
      end subroutine take_next

   end subroutine filter_some

   !> Make room for a block and the oscillators, on the heap, for threads may have small stacks
   pure subroutine make_room(places, oscillators, driving)
      type(places_type), intent(inout) :: places
      !> Their number, and that of those which drive the last
      integer, intent(in) :: oscillators, driving

      allocate (places%ground(side_by_side, 0:block), places%felt(side_by_side, block), places%delta(side_by_side, block), &
         & source=0.0_wp)
      allocate (places%oscillators(oscillators))
      allocate (places%driven_by_u(side_by_side, 2, driving), places%driven_by_w(side_by_side, 2, driving), source=0.0_wp)
      allocate (places%felt_of_u(side_by_side, oscillators), places%felt_of_w(side_by_side, oscillators), &
         & places%drift_of_u(side_by_side, oscillators), source=0.0_wp)
      allocate (places%u(side_by_side, 0:block, oscillators), places%w(side_by_side, 0:block, oscillators), source=0.0_wp)
   end subroutine make_room

   !> Begin a record in a place, with all that is known before its first step
   pure subroutine begin(places, k, swing, ground, samples, floor)
      type(places_type), intent(inout) :: places
      !> The place
      integer, intent(in) :: k
      !> The building under records of its time step
      type(swing_type), intent(in) :: swing
      !> Acceleration of the ground
      type(record_type), intent(in) :: ground
      !> Samples of the motion
      integer, intent(in) :: samples
      !> The motion, with room for its samples and the first of them
      type(record_type), intent(inout) :: floor

      integer :: i

      places%at(k) = 1
      places%still_at(k) = (size(ground%acceleration) - 1)*swing%parts + 1
      places%last(k) = samples
      places%largest(k) = 0.0_wp
      places%ground(k, 0) = ground%acceleration(1)
      places%felt_of_ground(k) = swing%felt_of_ground
      do i = 1, size(places%oscillators)
         associate (oscillators => places%oscillators(i))
            oscillators%by_u(k, :) = swing%by_u(:, i)
            oscillators%by_w(k, :) = swing%by_w(:, i)
            oscillators%by_start(k, :) = swing%by_start(:, i)
            oscillators%by_end(k, :) = swing%by_end(:, i)
         end associate
         places%felt_of_u(k, i) = swing%felt_of_u(i)
         places%felt_of_w(k, i) = swing%felt_of_w(i)
         places%drift_of_u(k, i) = swing%drift_of_u(i)
         places%u(k, 0, i) = 0.0_wp
         places%w(k, 0, i) = 0.0_wp
      end do
      do i = 1, size(places%driven_by_u, 3)
         places%driven_by_u(k, :, i) = swing%driven_by_u(:, i)
         places%driven_by_w(k, :, i) = swing%driven_by_w(:, i)
      end do
      floor%name = ground%name
      if (allocated(ground%file)) floor%file = ground%file
      floor%metadata = ground%metadata
      floor%dt = swing%dt
      if (allocated(ground%vertical)) call carry_vertical(ground%vertical, swing%parts, samples, floor%vertical)
      allocate (floor%acceleration(samples))
      floor%acceleration(1) = swing%felt_of_ground*ground%acceleration(1)
   end subroutine begin

   !> Load the ground of the next block of a place. The block ends with the record, behind which the ground is still at once
   pure subroutine load_ground(places, k, parts, acceleration)
      type(places_type), intent(inout) :: places
      !> The place
      integer, intent(in) :: k
      !> Parts that a step of the record is divided into
      integer, intent(in) :: parts
      !> The record [m/s2]
      real(wp), contiguous, intent(in) :: acceleration(:)

      real(wp) :: part
      integer :: i, j, sample, intervals

      associate (ground => places%ground, a => acceleration, at => places%at(k), steps => places%steps(k))
         if (at >= places%still_at(k)) then
            steps = min(block, places%last(k) - at)
            ground(k, 0:steps) = 0.0_wp
         else if (parts <= block) then
            ! Whole intervals of the record
            sample = (at - 1)/parts + 1
            intervals = min(block/parts, size(a) - sample)
            steps = intervals*parts
            do j = 1, parts - 1
               part = real(j, wp)/real(parts, wp)
               do i = 0, intervals - 1
                  ground(k, i*parts + j) = a(sample + i) + (a(sample + i + 1) - a(sample + i))*part
               end do
            end do
            do i = 1, intervals
               ground(k, i*parts) = a(sample + i)
            end do
         else
            steps = min(block, places%still_at(k) - at)
            do i = 1, steps
               sample = (at + i - 2)/parts + 1
               j = at + i - 1 - (sample - 1)*parts
               ground(k, i) = a(sample + 1)
               if (j < parts) ground(k, i) = a(sample) + (a(sample + 1) - a(sample))*(real(j, wp)/real(parts, wp))
            end do
         end if
      end associate
   end subroutine load_ground

   !> Let all places swing over a block, and mix what their walls feel
   pure subroutine advance(places, has_diaphragm)
      type(places_type), intent(inout) :: places
      !> Is the last oscillator a diaphragm, which the others drive?
      logical, intent(in) :: has_diaphragm

      integer :: i, j, k, n, steps, fewest

      n = size(places%oscillators)
      steps = maxval(places%steps)
      fewest = minval(places%steps, places%record > 0)
      associate (ground => places%ground, felt => places%felt, delta => places%delta)
         do i = 1, n
            if (i == n .and. has_diaphragm) then
               places%u(:, 1:, n) = 0.0_wp
               places%w(:, 1:, n) = 0.0_wp
               do j = 1, n - 1
                  call drive(steps, places%driven_by_u(:, :, j), places%driven_by_w(:, :, j), places%u(:, :, j), &
                     & places%w(:, :, j), places%u(:, :, n), places%w(:, :, n))
               end do
               call swing_driven(places%oscillators(n), steps, ground, places%u(:, :, n), places%w(:, :, n))
            else
               call swing(places%oscillators(i), steps, ground, places%u(:, :, i), places%w(:, :, i))
            end if
         end do
         call begin_mix(places, steps)
         do i = 2, n
            call mix(steps, places%felt_of_u(:, i), places%felt_of_w(:, i), places%drift_of_u(:, i), places%u(:, :, i), &
               & places%w(:, :, i), felt, delta)
         end do
         do j = 1, fewest
            !$omp simd
            do k = 1, side_by_side
               places%largest(k) = max(places%largest(k), abs(delta(k, j)))
            end do
         end do
         do k = 1, side_by_side
            do j = fewest + 1, places%steps(k)
               places%largest(k) = max(places%largest(k), abs(delta(k, j)))
            end do
         end do
      end associate
   end subroutine advance

   !> Begin with what walls feel of the ground and of the first oscillator, if there is one
   pure subroutine begin_mix(places, steps)
      !> All have swung
      type(places_type), intent(inout) :: places
      !> Steps of the block
      integer, intent(in) :: steps

      integer :: i, k

      associate (of_ground => places%felt_of_ground, of_u => places%felt_of_u, of_w => places%felt_of_w, &
         & drift_of_u => places%drift_of_u, ground => places%ground, u => places%u, w => places%w, felt => places%felt, &
         & delta => places%delta)
         if (size(places%oscillators) == 0) then
            felt = spread(of_ground, 2, block)*ground(:, 1:)
            delta = 0.0_wp
            return
         end if
         do i = 1, steps
            !$omp simd
            do k = 1, side_by_side
               felt(k, i) = of_ground(k)*ground(k, i) + (of_u(k, 1)*u(k, i, 1) + of_w(k, 1)*w(k, i, 1))
               delta(k, i) = drift_of_u(k, 1)*u(k, i, 1)
            end do
         end do
      end associate
   end subroutine begin_mix

   !> Drive the diaphragm by a mode
   pure subroutine drive(steps, by_u, by_w, u, w, driven_u, driven_w)
      !> Steps of the block
      integer, intent(in) :: steps
      !> What displacement (1) and velocity (2) of the diaphragm become of those of the mode
      real(wp), intent(in) :: by_u(side_by_side, 2), by_w(side_by_side, 2)
      !> The mode
      real(wp), intent(in) :: u(side_by_side, 0:block), w(side_by_side, 0:block)
      !> The diaphragm: added to
      real(wp), intent(inout) :: driven_u(side_by_side, 0:block), driven_w(side_by_side, 0:block)

      integer :: i, k

      do i = 1, steps
         !$omp simd
         do k = 1, side_by_side
            driven_u(k, i) = driven_u(k, i) + (by_u(k, 1)*u(k, i - 1) + by_w(k, 1)*w(k, i - 1))
            driven_w(k, i) = driven_w(k, i) + (by_u(k, 2)*u(k, i - 1) + by_w(k, 2)*w(k, i - 1))
         end do
      end do
   end subroutine drive

   !> Add what walls feel of an oscillator
   pure subroutine mix(steps, felt_of_u, felt_of_w, drift_of_u, u, w, felt, delta)
      !> Steps of the block
      integer, intent(in) :: steps
      !> Factors
      real(wp), dimension(side_by_side), intent(in) :: felt_of_u, felt_of_w, drift_of_u
      !> The oscillator
      real(wp), intent(in) :: u(side_by_side, 0:block), w(side_by_side, 0:block)
      !> Acceleration and relative displacement of the supports: added to
      real(wp), intent(inout) :: felt(side_by_side, block), delta(side_by_side, block)

      integer :: i, k

      do i = 1, steps
         !$omp simd
         do k = 1, side_by_side
            felt(k, i) = felt(k, i) + (felt_of_u(k)*u(k, i) + felt_of_w(k)*w(k, i))
            delta(k, i) = delta(k, i) + drift_of_u(k)*u(k, i)
         end do
      end do
   end subroutine mix

   !> Store what the wall of a place feels, and go on from the end of its block
   pure subroutine store(places, k, acceleration)
      type(places_type), intent(inout) :: places
      !> The place
      integer, intent(in) :: k
      !> The motion [m/s2]
      real(wp), contiguous, intent(inout) :: acceleration(:)

      integer :: i

      associate (at => places%at(k), steps => places%steps(k))
         do i = 1, steps
            acceleration(at + i) = places%felt(k, i)
         end do
         places%ground(k, 0) = places%ground(k, steps)
         at = at + steps
         do i = 1, size(places%u, 3)
            places%u(k, 0, i) = places%u(k, steps, i)
            places%w(k, 0, i) = places%w(k, steps, i)
            ! A swing that has died out would be computed in denormal numbers, which are slow
            if (abs(places%u(k, 0, i)) + abs(places%w(k, 0, i)) < tiny(1.0_wp)) then
               places%u(k, 0, i) = 0.0_wp
               places%w(k, 0, i) = 0.0_wp
            end if
         end do
      end associate
   end subroutine store

   !> Carry the vertical component up, at the samples of the floor: a building is rigid vertically
   pure subroutine carry_vertical(vertical, parts, samples, upwards)
      !> Vertical acceleration of the ground [m/s2]
      real(wp), intent(in) :: vertical(:)
      !> Samples of the floor in one of the ground, and in all
      integer, intent(in) :: parts, samples
      !> That of the floor [m/s2]
      real(wp), allocatable, intent(out) :: upwards(:)

      integer :: i, j

      allocate (upwards(samples), source=0.0_wp)
      upwards(1) = vertical(1)
      do i = 2, size(vertical)
         do j = 1, parts
            upwards((i - 2)*parts + 1 + j) = vertical(i - 1) &
               & + (vertical(i) - vertical(i - 1))*(real(j, wp)/real(parts, wp))
         end do
      end do
   end subroutine carry_vertical

end module dondolo_building_floor_motion
