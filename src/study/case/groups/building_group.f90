!> The group &building: what the wall stands on, where that is not the ground.
module dondolo_case_building_group
   use dondolo_base_error, only : error_type, problems_type
   use dondolo_base_settings, only : group_settings_type, new_settings
   use dondolo_base_settings_check, only : check_settings
   use dondolo_building, only : building_type
   use dondolo_building_input, only : building_properties, new_building
   use dondolo_case_namelist_group, only : group_type
   use dondolo_case_settings_group, only : read_values
   use dondolo_wall_properties, only : wall_input_type
   implicit none
   private

   public :: read_building_group

contains

   !> Read the group, if the case has one
   subroutine read_building_group(group, wall, error)
      !> The group as read from the file
      type(group_type), intent(in) :: group
      !> Input of the wall: what it stands on is added
      type(wall_input_type), intent(inout) :: wall
      !> What is wrong with it
      type(error_type), allocatable, intent(out) :: error

      type(group_settings_type) :: settings
      type(building_type) :: building
      type(problems_type) :: problems

      if (group%line == 0) return
      call new_settings(settings, building_properties)
      call read_values(group, settings, error)
      if (allocated(error)) return
      call check_settings(settings, problems)
      if (problems%count == 0) call new_building(building, settings, problems)
      call problems%raise(error)
      call group%locate(error)
      if (.not. allocated(error)) call read_values(group, wall, error, building_properties)
   end subroutine read_building_group

end module dondolo_case_building_group
