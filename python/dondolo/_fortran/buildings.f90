!> Buildings, and the motions of their floors.
module buildings
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_error, only : error_type, problems_type
   use dondolo_base_settings, only : group_settings_type
   use dondolo_base_settings_check, only : check_settings
   use dondolo_base_warning, only : warnings_type
   use dondolo_boundary, only : as_settings, check_room
   use dondolo_building, only : building_type
   use dondolo_building_floor_motion, only : filter_record, floor_samples
   use dondolo_building_input, only : building_properties, new_building
   use dondolo_fragility_drift_note, only : make_drift_note
   use dondolo_interface_handles, only : find_walls
   use dondolo_motion_work, only : work_type
   use dondolo_parcel, only : parcel_type, send
   use dondolo_record, only : new_record, record_type
   use dondolo_wall, only : wall_type
   use dondolo_wall_support_notes, only : supports_type
   implicit none
   private

   public :: describe_building, drift_note, felt_motion, floor_motion, support_notes

contains

   !> Of each mode its damping and its participation factor times its shape at the base and at the top; damping and participation
   !> of the diaphragm, 0 of none; how long the floor vibrates after a record [s]. Numbers are as as_settings takes them
   subroutine describe_building(numbers, n, given, q, sent)
      integer(c_int), intent(in) :: n, q, given(q)
      real(c_double), intent(in) :: numbers(n)
      integer(c_int64_t), intent(out) :: sent(5)
      type(building_type) :: building
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      call set_building(building, numbers, given, error)
      if (.not. allocated(error)) then
         call parcel%put('period', building%period)
         call parcel%put('damping', building%damping)
         call parcel%put('participation', building%participation)
         call parcel%put('participation_top', building%participation_top)
         call parcel%put('diaphragm_damping', building%diaphragm%damping)
         call parcel%put('diaphragm_participation', building%diaphragm%participation)
         call parcel%put('free_vibration', building%longest_vibration())
      end if
      call send(parcel, error, sent)
   end subroutine describe_building

   !> Motion of the floor under a record, which has a vertical component where m = k: as put_motion has it
   subroutine floor_motion(acceleration, k, vertical, m, dt, numbers, n, given, q, sent)
      !f2py threadsafe
      integer(c_int), intent(in) :: k, m, n, q, given(q)
      real(c_double), intent(in) :: acceleration(k), vertical(m), dt, numbers(n)
      integer(c_int64_t), intent(out) :: sent(5)
      type(building_type) :: building
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      call set_building(building, numbers, given, error)
      if (.not. allocated(error)) call put_motion(building, acceleration, vertical, dt, parcel, error)
      call send(parcel, error, sent)
   end subroutine floor_motion

   !> The motion that a wall on a building feels under a record, which has a vertical component where m = k, or the motion of its
   !> supports: 'felt', 'base' or 'top'
   subroutine felt_motion(acceleration, k, vertical, m, dt, walls, what, sent)
      !f2py threadsafe
      integer(c_int), intent(in) :: k, m
      integer(c_int64_t), intent(in) :: walls
      real(c_double), intent(in) :: acceleration(k), vertical(m), dt
      character(len=*), intent(in) :: what
      integer(c_int64_t), intent(out) :: sent(5)
      type(wall_type), pointer :: wall(:)
      type(building_type) :: building
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      call find_walls(walls, wall, error)
      if (.not. allocated(error)) then
         building = wall(1)%building
         building%refine = building%parts(dt)
         if (what == 'base') call building%lean(0.0_c_double, 0.0_c_double)
         if (what == 'top') call building%lean(building%height, 0.0_c_double)
         call put_motion(building, acceleration, vertical, dt, parcel, error)
      end if
      call send(parcel, error, sent)
   end subroutine felt_motion

   !> Notes on the supports that move walls, a JSON object on each line
   subroutine support_notes(walls, sent)
      integer(c_int64_t), intent(in) :: walls
      integer(c_int64_t), intent(out) :: sent(5)
      type(wall_type), pointer :: wall(:)
      type(supports_type) :: supports
      type(warnings_type) :: notes
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      integer :: i

      call find_walls(walls, wall, error)
      if (.not. allocated(error)) then
         do i = 1, size(wall)
            call supports%look(wall(i))
         end do
         call supports%make_notes(notes)
         call notes%put_objects(parcel%lines)
      end if
      call send(parcel, error, sent)
   end subroutine support_notes

   !> What there is to say of histories whose supports drift apart, as a line, empty where there are none
   subroutine drift_note(drifted, histories, sent)
      integer(c_int64_t), intent(in) :: drifted, histories
      integer(c_int64_t), intent(out) :: sent(5)
      type(work_type) :: work
      character(len=:), allocatable :: line
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      work = work_type(drifted=int(drifted, int64), histories=int(histories, int64))
      call make_drift_note(work, line)
      call parcel%lines%add(line)
      call send(parcel, error, sent)
   end subroutine drift_note

   !> Put the motion that a building makes of a record: into how many parts each step is divided, its samples, and those of its
   !> vertical component, if there is one
   subroutine put_motion(building, acceleration, vertical, dt, parcel, error)
      type(building_type), intent(in) :: building
      !> Motion of the ground [m/s2]; there is a vertical one if both have as many samples
      real(c_double), intent(in) :: acceleration(:), vertical(:), dt
      type(parcel_type), intent(inout) :: parcel
      !> It would be too long, or lack of memory
      type(error_type), allocatable, intent(out) :: error

      type(record_type) :: ground, floor
      logical :: has_vertical

      has_vertical = size(vertical) == size(acceleration)
      call new_record(ground, acceleration, dt, '', error)
      if (.not. allocated(error) .and. has_vertical) call ground%set_vertical(vertical, dt, 1.0_c_double, error)
      if (.not. allocated(error)) call check_room(error, samples=floor_samples(building, ground))
      if (.not. allocated(error)) call filter_record(building, ground, floor, error)
      if (allocated(error)) return
      call parcel%put('parts', building%parts(dt))
      call parcel%put('acceleration', floor%acceleration)
      if (has_vertical) call parcel%put('vertical', floor%vertical)
   end subroutine put_motion

   !> Make a building
   subroutine set_building(building, numbers, given, error)
      type(building_type), intent(out) :: building
      !> Values of building_properties, as as_settings takes them
      real(c_double), intent(in) :: numbers(:)
      integer(c_int), intent(in) :: given(:)
      !> Everything that is wrong
      type(error_type), allocatable, intent(out) :: error

      type(group_settings_type) :: settings
      type(problems_type) :: problems

      call as_settings(settings, building_properties, '', numbers, given, error)
      if (allocated(error)) return
      call check_settings(settings, problems)
      if (problems%count == 0) call new_building(building, settings, problems)
      call problems%raise(error)
   end subroutine set_building

end module buildings
