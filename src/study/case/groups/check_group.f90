!> The group &check: a check by a building code beside the curve.
module dondolo_case_check_group
   use dondolo_base_error, only : error_type, problems_type
   use dondolo_base_settings, only : group_settings_type, new_settings
   use dondolo_case_namelist_group, only : group_type
   use dondolo_case_settings_group, only : read_values
   use dondolo_check_input, only : check_input_type, check_properties, take_check
   implicit none
   private

   public :: read_check_group

contains

   !> Read the group
   subroutine read_check_group(group, check, error)
      !> The group as read from the file
      type(group_type), intent(in) :: group
      !> The check; not allocated: the case has no such group
      type(check_input_type), allocatable, intent(out) :: check
      !> What is wrong with it
      type(error_type), allocatable, intent(out) :: error

      type(group_settings_type) :: settings
      type(problems_type) :: problems

      if (group%line == 0) return
      call new_settings(settings, check_properties)
      call read_values(group, settings, error)
      if (allocated(error)) return
      allocate (check)
      call take_check(check, settings, problems)
      call problems%raise(error)
      call group%locate(error)
   end subroutine read_check_group

end module dondolo_case_check_group
