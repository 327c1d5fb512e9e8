!> Motions of floors that many walls share: the records of a suite filtered by each building, made when they are first
!> needed and kept while there is room.
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
   use dondolo_base_threads, only : largest_threads
   use dondolo_building, only : building_type
   use dondolo_building_floor_motion, only : filter_records, floor_samples
   use dondolo_record, only : record_type
   use dondolo_record_suite, only : new_motions, suite_type
   implicit none
   private

   public :: floors_type, check_floor

   !> Memory that a sample takes in a record and in the set of all, and its vertical component as much again [bytes]
   real(wp), parameter :: bytes_of_sample = 16.0_wp

   !> Memory that motions which no wall needs at the moment may fill: they are made anew in little time [bytes]
   real(wp), parameter :: room_of_motions = 2.0_wp**25

   !> The motions of a floor
   type :: floor_type
      !> What filtered them
      type(building_type) :: building
      !> The suite that was filtered; null: there is no floor
      type(suite_type), pointer :: ground => null()
      !> Motions; not allocated: they are not made yet
      type(suite_type), allocatable :: motions
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
      !> Their motions; places for more walls than threads can try at once
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
      call check_room(bytes_of_sample*merge(2.0_wp, 1.0_wp, suite%has_vertical)*all, error)
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

      call take_place(self, building, ground, place)
      associate (floor => self%floor(place))
         call omp_set_lock(floor%making)
         if (.not. allocated(floor%motions)) call make_motions(floor, threads)
         call omp_unset_lock(floor%making)
      end associate
      motions => self%floor(place)%motions
      if (present(drift)) drift = self%floor(place)%drift
   end subroutine take

   !> Take the place of a floor: an old one, or one where nothing is made yet
   subroutine take_place(self, building, ground, place)
      class(floors_type), intent(inout) :: self
      type(building_type), intent(in) :: building
      !> Motions of the ground
      type(suite_type), pointer, intent(in) :: ground
      !> The place
      integer, intent(out) :: place

      !$omp critical (dondolo_building_floors)
      if (.not. allocated(self%floor)) allocate (self%floor(4*largest_threads))
      place = find_floor(self, building, ground)
      if (place == 0) call find_room(self, building, ground, place)
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

   !> Place of a floor; 0: it is not there
   integer function find_floor(self, building, ground) result(place)
      class(floors_type), intent(in) :: self
      type(building_type), intent(in) :: building
      !> Motions of the ground
      type(suite_type), pointer, intent(in) :: ground

      do place = self%count, 1, -1
         associate (floor => self%floor(place))
            if (.not. associated(floor%ground, ground)) cycle
            if (floor%building%equals(building)) return
         end associate
      end do
   end function find_floor

   !> A place for a floor: a new one while all fit into their room, else that of the one that was needed longest ago, and of none
   !> that is needed now
   subroutine find_room(self, building, ground, place)
      class(floors_type), intent(inout) :: self
      type(building_type), intent(in) :: building
      !> Motions of the ground
      type(suite_type), pointer, intent(in) :: ground
      !> The place
      integer, intent(out) :: place

      real(wp) :: bytes
      integer :: i, oldest

      bytes = 0.0_wp
      do i = 1, size(ground%records)
         bytes = bytes + floor_samples(building, ground%records(i))
      end do
      bytes = bytes*bytes_of_sample*merge(2.0_wp, 1.0_wp, ground%has_vertical)
      do
         place = 0
         oldest = 0
         do i = self%count, 1, -1
            if (.not. associated(self%floor(i)%ground)) then
               place = i
            else if (self%floor(i)%users == 0) then
               if (oldest == 0) oldest = i
               if (self%floor(i)%taken < self%floor(oldest)%taken) oldest = i
            end if
         end do
         if (place == 0 .and. self%count < size(self%floor)) place = self%count + 1
         if (place > 0) then
            if (oldest == 0 .or. bytes + sum(self%floor(:self%count)%bytes) <= room_of_motions) exit
         end if
         self%floor(oldest)%ground => null()
         self%floor(oldest)%bytes = 0.0_wp
         if (allocated(self%floor(oldest)%motions)) deallocate (self%floor(oldest)%motions)
      end do
      self%count = max(self%count, place)
      associate (floor => self%floor(place))
         if (.not. floor%has_lock) call omp_init_lock(floor%making)
         floor%has_lock = .true.
         floor%building = building
         floor%bytes = bytes
         floor%users = 0
      end associate
      self%floor(place)%ground => ground
   end subroutine find_room

   !> Make the motions of a floor
   subroutine make_motions(floor, threads)
      !> Its place, taken
      type(floor_type), intent(inout) :: floor
      !> Number of threads; 0: all that OpenMP gives
      integer, intent(in) :: threads

      type(record_type), allocatable :: records(:)

      call filter_records(floor%building, floor%ground%records, threads, records, floor%drift)
      allocate (floor%motions)
      call new_motions(floor%motions, records)
   end subroutine make_motions

end module dondolo_building_floors
