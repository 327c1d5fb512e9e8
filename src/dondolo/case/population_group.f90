!> The group &population: the file of a population of walls.
module dondolo_population_group
   use dondolo_error, only : error_type
   use dondolo_namelist_group, only : group_type
   use dondolo_property, only : is_text, property_type
   use dondolo_settings, only : group_settings_type, new_settings
   use dondolo_settings_group, only : read_settings
   implicit none
   private

   public :: read_population_group, put_population
   public :: population_properties

   !> Variables of the group
   type(property_type), target, protected :: population_properties(1) = [ &
      & property_type('file', is_text, required=.true., names='a CSV table with one row a wall', changes_results=.false., &
      &   example='data/walls/population.csv', meaning='table with one row a wall, from the folder of this file')]

contains

   !> Read the group
   subroutine read_population_group(group, file, error)
      !> The group as it stands in the file
      type(group_type), intent(in) :: group
      !> Path of the table of walls, relative to the case
      character(len=:), allocatable, intent(out) :: file
      !> What is wrong with it
      type(error_type), allocatable, intent(out) :: error

      type(group_settings_type) :: settings

      call new_settings(settings, population_properties)
      call read_settings(group, settings, error)
      file = settings%word('file')
   end subroutine read_population_group

   !> The file as settings
   subroutine put_population(file, settings)
      !> Path of the table of walls as it was given
      character(len=*), intent(in) :: file
      !> Values of population_properties
      type(group_settings_type), intent(out) :: settings

      call new_settings(settings, population_properties)
      call settings%set('file', file)
   end subroutine put_population

end module dondolo_population_group
