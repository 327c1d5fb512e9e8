!> The group &population: the file of a population of walls.
module dondolo_population_group
   use dondolo_error, only : error_type, raise_input
   use dondolo_namelist_group, only : group_type
   use dondolo_settings, only : settings_type
   implicit none
   private

   public :: read_population_group, echo_population
   public :: population_variables

   !> Variables of the group
   character(len=4), parameter :: population_variables(1) = ['file']

contains

   !> Read the group
   subroutine read_population_group(group, file, error)
      !> The group as it stands in the file
      type(group_type), intent(in) :: group
      !> Path of the table of walls, relative to the case
      character(len=:), allocatable, intent(out) :: file
      !> What is wrong with it
      type(error_type), allocatable, intent(out) :: error

      file = ''
      call group%check_names(population_variables, error)
      if (.not. allocated(error)) call group%get_text('file', file, error)
      if (allocated(error)) return
      if (.not. group%has('file')) then
         call raise_input(error, group%place()//': file: must be given, a CSV table with one row a wall'// &
            & group%in_line(''))
      else if (len_trim(file) == 0) then
         call group%refuse('file', 'must name a CSV table with one row a wall', error)
      end if
   end subroutine read_population_group

   !> Write the group as namelist text
   subroutine echo_population(file, settings)
      !> Path of the table of walls as it was given
      character(len=*), intent(in) :: file
      !> Settings to add to
      type(settings_type), intent(inout) :: settings

      call settings%add('population', 'file', file)
   end subroutine echo_population

end module dondolo_population_group
