!> Buildings, and the motions of their floors.
module buildings
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_error, only : error_type, problems_type, raise_input
   use dondolo_base_property, only : is_list
   use dondolo_base_settings, only : group_settings_type, new_settings
   use dondolo_base_settings_check, only : check_settings
   use dondolo_base_text, only : to_text
   use dondolo_boundary, only : check_room
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

   !> Reals: of each mode its damping and its participation factor times its shape at the base and at the top; damping and
   !> participation of the diaphragm, 0 of none; how long the floor vibrates after a record [s]. The numbers are those that were
   !> given, in the order of the table, and how many each has
   subroutine describe_building(numbers, n, given, q, sent)
      integer(c_int), intent(in) :: n, q, given(q)
      real(c_double), intent(in) :: numbers(n)
      integer(c_int64_t), intent(out) :: sent(5)
      type(building_type) :: building
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      call set_building(building, numbers, given, error)
      if (.not. allocated(error)) parcel%reals = [building%damping, building%participation, building%participation_top, &
         & building%diaphragm%damping, building%diaphragm%participation, building%free_vibration()]
      call send(parcel, error, sent)
   end subroutine describe_building

   !> Motion of the floor under a record, which has a vertical component where m = k. Integers: into how many parts each step
   !> is divided; reals: its samples, and those of its vertical component
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
   !> supports: 'felt', 'base' or 'top'. Integers: into how many parts each step is divided; reals: its samples, and those of its
   !> vertical component
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

   !> What there is to say of the supports that move walls, as lines; none where no wall has a building
   subroutine support_notes(walls, sent)
      integer(c_int64_t), intent(in) :: walls
      integer(c_int64_t), intent(out) :: sent(5)
      type(wall_type), pointer :: wall(:)
      type(supports_type) :: supports
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      integer :: i

      call find_walls(walls, wall, error)
      if (.not. allocated(error)) then
         do i = 1, size(wall)
            call supports%look(wall(i))
         end do
         call supports%make_notes(parcel%lines)
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

   !> Put the motion that a building makes of a record
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
      parcel%integers = [building%parts(dt)]
      parcel%reals = floor%acceleration
      if (has_vertical) parcel%reals = [floor%acceleration, floor%vertical]
   end subroutine put_motion

   !> Make a building
   subroutine set_building(building, numbers, given, error)
      type(building_type), intent(out) :: building
      !> All numbers that were given, in the order of the table
      real(c_double), intent(in) :: numbers(:)
      !> How many values each has: of a list any number, else 1 or 0
      integer(c_int), intent(in) :: given(:)
      !> Everything that is wrong
      type(error_type), allocatable, intent(out) :: error

      type(group_settings_type) :: settings
      type(problems_type) :: problems
      integer :: k, next

      if (size(given) /= size(building_properties) .or. any(given < 0) .or. sum(given) > size(numbers)) then
         call raise_input(error, 'building: must have '//to_text(size(building_properties))//' numbers')
         return
      end if
      call new_settings(settings, building_properties)
      next = 1
      do k = 1, size(given)
         if (given(k) < 1) cycle
         associate (property => building_properties(k))
            if (property%kind == is_list) then
               call settings%set(property%name, numbers(next:next + given(k) - 1))
            else
               call settings%set(property%name, numbers(next))
            end if
         end associate
         next = next + given(k)
      end do
      call check_settings(settings, problems)
      if (problems%count == 0) call new_building(building, settings, problems)
      call problems%raise(error)
   end subroutine set_building

end module buildings
