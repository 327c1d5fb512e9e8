!> Walls of the C interface.
module dondolo_interface_c_walls
   use, intrinsic :: iso_c_binding, only : c_int64_t, c_null_ptr, c_ptr
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_interface_c_error, only : failure_type, is_ready
   use dondolo_interface_c_settings, only : c_settings_type, copy_settings, find_settings
   use dondolo_interface_c_text, only : as_handle, as_pointer
   use dondolo_interface_handles, only : find_walls, hold, walls_type
   use dondolo_population_wall_table, only : take_table
   use dondolo_wall, only : new_wall, wall_type
   use dondolo_wall_gravity, only : gravity_property, standard_gravity
   use dondolo_wall_properties, only : wall_input_type
   implicit none
   private

   public :: find_wall

contains

   !> Make a wall
   type(c_ptr) function c_new_wall(error, settings) result(made) bind(c, name='dondolo_new_wall')
      type(c_ptr), intent(in), value :: error
      !> Settings of the group wall
      type(c_ptr), intent(in), value :: settings

      type(failure_type), pointer :: failure
      type(c_settings_type), pointer :: found
      type(walls_type), pointer :: held
      type(wall_input_type) :: input
      type(error_type), allocatable :: problem
      class(*), pointer :: content
      integer(c_int64_t) :: handle
      real(wp) :: gravity

      made = c_null_ptr
      if (.not. is_ready(error, failure)) return
      call find_settings(settings, found, problem, 'wall')
      if (.not. allocated(problem)) then
         call copy_settings(found, input)
         gravity = standard_gravity
         if (found%values%has(trim(gravity_property%name))) gravity = found%values%number(trim(gravity_property%name))
         allocate (held)
         allocate (held%wall(1))
         call take_table(input, '', problem)
         if (.not. allocated(problem)) call new_wall(held%wall(1), input, problem, gravity)
         if (allocated(problem)) then
            deallocate (held)
         else
            content => held
            call hold(content, handle)
            made = as_pointer(handle)
         end if
      end if
      call failure%take(problem)
   end function c_new_wall

   !> The wall of a handle
   subroutine find_wall(pointer, wall, error)
      !> The handle
      type(c_ptr), intent(in) :: pointer
      !> The wall
      type(wall_type), pointer, intent(out) :: wall
      !> It is a handle of something else, or was freed
      type(error_type), allocatable, intent(out) :: error

      type(wall_type), pointer :: walls(:)

      wall => null()
      call find_walls(as_handle(pointer), walls, error)
      if (.not. allocated(error)) wall => walls(1)
   end subroutine find_wall

end module dondolo_interface_c_walls
