!> Motions of floors that many walls share: the records of a suite filtered by each building, made when they are first
!> needed and kept while there is room. Walls that feel one building otherwise share how it swings.
!>
!> Any number of threads may take motions at once. Those that a thread has taken stay until it gives them back.
module dondolo_building_floors
   use, intrinsic :: iso_fortran_env, only : int64
   use, intrinsic :: omp_lib, only : omp_init_lock, omp_lock_kind, omp_set_lock, omp_unset_lock
   use dondolo_base_error, only : error_type, out_of_range, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_limits, only : most_samples
   use dondolo_base_memory, only : check_room
   use dondolo_base_text, only : to_text
   use dondolo_base_threads, only : largest_threads, team_of
   use dondolo_building, only : building_type
   use dondolo_building_floor_motion, only : floor_samples, mix_swing, new_swing
   use dondolo_building_swing, only : swing_type
   use dondolo_record, only : record_type
   use dondolo_record_suite, only : new_motions, suite_type
   implicit none
   private

   public :: floors_type, check_floor

   !> Memory that a sample takes: in a record, and in the set of all; of the ground in what a building makes of it, horizontally
   !> and vertically; of each mode there; and while the motion of a wall is made [bytes]
   real(wp), parameter :: bytes_of_sample = 16.0_wp, bytes_of_ground = 16.0_wp, bytes_of_mode = 16.0_wp, bytes_while_made = 24.0_wp

   !> Memory that motions which no wall needs at the moment may fill, and that how buildings swing may fill, from which motions are
   !> made anew in little time [bytes]
   real(wp), parameter :: room_of_motions = 2.0_wp**25, room_of_swings = 2.0_wp**29

   !> The motions of a floor, or how a building swings
   type :: floor_type
      !> What filtered them
      type(building_type) :: building
      !> The suite that was filtered; null: there is no floor
      type(suite_type), pointer :: ground => null()
      !> Is it how the building swings, from which the motions of floors are made?
      logical :: is_swing = .false.
      !> Motions; not allocated: they are not made yet
      type(suite_type), allocatable :: motions
      !> How the building swings under each record; not allocated: it is not known yet
      type(swing_type), allocatable :: swing(:)
      !> Greatest drift of the supports of its wall in each of them [rad]
      real(wp), allocatable :: drift(:)
      !> How many walls need them now, and when the last of them took them
      integer :: users = 0
      integer(int64) :: taken = 0
      !> Memory that they take [bytes]
      real(wp) :: bytes = 0.0_wp
      !> Held while they are made
      integer(omp_lock_kind) :: making = 0
      logical :: has_lock = .false.
   end type floor_type

   !> Floors
   type :: floors_type
      private
      !> Their motions; places for more walls than threads can try at once, and for the buildings of them
      type(floor_type), allocatable :: floor(:)
      !> How many places were ever used
      integer :: count = 0
      !> How often motions were taken
      integer(int64) :: taken = 0
   contains
      !> Take the motions of a floor
      procedure :: take
      !> Give them back
      procedure :: give_back
   end type floors_type

contains

   !> Check that the motions of a floor can be made
   subroutine check_floor(building, suite, error)
      type(building_type), intent(in) :: building
      !> Motions of the ground
      type(suite_type), intent(in) :: suite
      !> One of them becomes too long, or lack of memory
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: samples, all
      integer :: i

      all = 0.0_wp
      do i = 1, size(suite%records)
         samples = floor_samples(building, suite%records(i))
         all = all + samples
         if (samples <= real(most_samples, wp)) cycle
         call raise_input(error, 'period: the motion of the floor under record '''//suite%records(i)%name// &
            & ''' has more than '//to_text(most_samples)//' samples', out_of_range, 'period')
         return
      end do
      call check_room((bytes_of_sample + bytes_while_made + bytes_of_swing(building))*all, error)
   end subroutine check_floor

   !> Take the motions of a floor; the first who does makes them
   subroutine take(self, building, ground, threads, place, motions, drift)
      class(floors_type), intent(inout), target :: self
      !> The building, which check_floor has checked
      type(building_type), intent(in) :: building
      !> Motions of the ground
      type(suite_type), pointer, intent(in) :: ground
      !> Number of threads that make them; 0: all that OpenMP gives
      integer, intent(in) :: threads
      !> What to give them back by
      integer, intent(out) :: place
      !> Motions of the floor
      type(suite_type), pointer, intent(out) :: motions
      !> Greatest drift of the supports of the wall in each of them [rad]
      real(wp), allocatable, intent(out), optional :: drift(:)

      call take_place(self, building, ground, .false., place)
      associate (floor => self%floor(place))
         call omp_set_lock(floor%making)
         if (.not. allocated(floor%motions)) call make_motions(self, place, threads)
         call omp_unset_lock(floor%making)
      end associate
      motions => self%floor(place)%motions
      if (present(drift)) drift = self%floor(place)%drift
   end subroutine take

   !> Take the place of a floor, or of how a building swings: an old one, or one where nothing is made yet
   subroutine take_place(self, building, ground, is_swing, place)
      class(floors_type), intent(inout) :: self
      type(building_type), intent(in) :: building
      !> Motions of the ground
      type(suite_type), pointer, intent(in) :: ground
      !> Is it how the building swings?
      logical, intent(in) :: is_swing
      !> The place
      integer, intent(out) :: place

      !$omp critical (dondolo_building_floors)
      if (.not. allocated(self%floor)) allocate (self%floor(4*largest_threads))
      place = find_floor(self, building, ground, is_swing)
      if (place == 0) call find_room(self, building, ground, is_swing, place)
      self%taken = self%taken + 1
      self%floor(place)%taken = self%taken
      self%floor(place)%users = self%floor(place)%users + 1
      !$omp end critical (dondolo_building_floors)
   end subroutine take_place

   !> Give motions back
   subroutine give_back(self, place)
      class(floors_type), intent(inout) :: self
      !> As take gave it
      integer, intent(in) :: place

      !$omp critical (dondolo_building_floors)
      self%floor(place)%users = self%floor(place)%users - 1
      !$omp end critical (dondolo_building_floors)
   end subroutine give_back

   !> Place of a floor, or of how a building swings; 0: it is not there
   integer function find_floor(self, building, ground, is_swing) result(place)
      class(floors_type), intent(in) :: self
      type(building_type), intent(in) :: building
      !> Motions of the ground
      type(suite_type), pointer, intent(in) :: ground
      !> Is it how the building swings?
      logical, intent(in) :: is_swing

      do place = self%count, 1, -1
         associate (floor => self%floor(place))
            if (.not. associated(floor%ground, ground) .or. (floor%is_swing .neqv. is_swing)) cycle
            if (is_swing) then
               if (floor%building%swings_as(building)) return
            else
               if (floor%building%equals(building)) return
            end if
         end associate
      end do
   end function find_floor

   !> A place for a floor, or for how a building swings: a new one while all of its kind fit into their room, else that of the one
   !> that was needed longest ago, and of none that is needed now
   subroutine find_room(self, building, ground, is_swing, place)
      class(floors_type), intent(inout) :: self
      type(building_type), intent(in) :: building
      !> Motions of the ground
      type(suite_type), pointer, intent(in) :: ground
      !> Is it for how the building swings?
      logical, intent(in) :: is_swing
      !> The place
      integer, intent(out) :: place

      real(wp) :: bytes, room
      integer :: i, oldest, oldest_alike

      bytes = 0.0_wp
      do i = 1, size(ground%records)
         bytes = bytes + floor_samples(building, ground%records(i))
      end do
      if (is_swing) then
         bytes = bytes*bytes_of_swing(building)
         room = room_of_swings
      else
         bytes = bytes*bytes_of_sample
         room = room_of_motions
      end if
      do
         place = 0
         oldest = 0
         oldest_alike = 0
         do i = self%count, 1, -1
            if (.not. associated(self%floor(i)%ground)) then
               place = i
            else if (self%floor(i)%users == 0) then
               if (oldest == 0) oldest = i
               if (self%floor(i)%taken < self%floor(oldest)%taken) oldest = i
               if (self%floor(i)%is_swing .neqv. is_swing) cycle
               if (oldest_alike == 0) oldest_alike = i
               if (self%floor(i)%taken < self%floor(oldest_alike)%taken) oldest_alike = i
            end if
         end do
         if (place == 0 .and. self%count < size(self%floor)) place = self%count + 1
         if (place > 0) then
            if (oldest_alike == 0 .or. bytes + sum(self%floor(:self%count)%bytes, &
               & mask=self%floor(:self%count)%is_swing .eqv. is_swing) <= room) exit
            oldest = oldest_alike
         end if
         self%floor(oldest)%ground => null()
         self%floor(oldest)%bytes = 0.0_wp
         if (allocated(self%floor(oldest)%motions)) deallocate (self%floor(oldest)%motions)
         if (allocated(self%floor(oldest)%swing)) deallocate (self%floor(oldest)%swing)
      end do
      self%count = max(self%count, place)
      associate (floor => self%floor(place))
         if (.not. floor%has_lock) call omp_init_lock(floor%making)
         floor%has_lock = .true.
         floor%building = building
         floor%is_swing = is_swing
         floor%bytes = bytes
         floor%users = 0
      end associate
      self%floor(place)%ground => ground
   end subroutine find_room

   !> Memory that a sample of how a building swings takes [bytes]
   pure real(wp) function bytes_of_swing(building) result(bytes)
      type(building_type), intent(in) :: building

      bytes = bytes_of_ground + bytes_of_mode*real(size(building%period) + merge(1, 0, building%has_diaphragm()), wp)
   end function bytes_of_swing

   !> Make the motions of a floor
   subroutine make_motions(self, place, threads)
      class(floors_type), intent(inout) :: self
      !> Place of the floor, taken
      integer, intent(in) :: place
      !> Number of threads; 0: all that OpenMP gives
      integer, intent(in) :: threads

      type(building_type) :: building
      type(suite_type), pointer :: ground
      integer :: source

      ground => self%floor(place)%ground
      building = self%floor(place)%building
      call take_place(self, building, ground, .true., source)
      call omp_set_lock(self%floor(source)%making)
      if (.not. allocated(self%floor(source)%swing)) call make_swing(self%floor(source), threads)
      call omp_unset_lock(self%floor(source)%making)
      call mix_motions(self%floor(place), self%floor(source)%swing, threads)
      call self%give_back(source)
   end subroutine make_motions

   !> Make the motions of a floor of how its building swings
   subroutine mix_motions(floor, swing, threads)
      !> Its place, taken
      type(floor_type), intent(inout) :: floor
      !> Under each record
      type(swing_type), intent(in) :: swing(:)
      !> Number of threads; 0: all that OpenMP gives
      integer, intent(in) :: threads

      type(record_type), allocatable :: records(:)
      integer :: i

      allocate (records(size(swing)))
      if (allocated(floor%drift)) deallocate (floor%drift)
      allocate (floor%drift(size(swing)))
      !$omp parallel do schedule(dynamic) num_threads(team_of(threads, size(records))) default(none) shared(floor, swing, records)
      do i = 1, size(records)
         call mix_swing(swing(i), floor%building, floor%ground%records(i), records(i), floor%drift(i))
      end do
      !$omp end parallel do
      allocate (floor%motions)
      call new_motions(floor%motions, records)
   end subroutine mix_motions

   !> Let a building swing
   subroutine make_swing(floor, threads)
      !> Its place, taken
      type(floor_type), intent(inout) :: floor
      !> Number of threads; 0: all that OpenMP gives
      integer, intent(in) :: threads

      integer :: i

      allocate (floor%swing(size(floor%ground%records)))
      !$omp parallel do schedule(dynamic) num_threads(team_of(threads, size(floor%swing))) default(none) shared(floor)
      do i = 1, size(floor%swing)
         call new_swing(floor%swing(i), floor%building, floor%ground%records(i))
      end do
      !$omp end parallel do
   end subroutine make_swing

end module dondolo_building_floors
