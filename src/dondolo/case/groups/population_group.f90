!> The group &population: the file of a population of walls, and whether they are designs of one wall.
module dondolo_case_population_group
   use dondolo_base_error, only : error_type
   use dondolo_base_property, only : is_logical, is_text, property_type
   use dondolo_base_settings, only : group_settings_type, new_settings
   use dondolo_case_namelist_group, only : group_type
   use dondolo_case_settings_group, only : read_settings
   implicit none
   private

   public :: read_population_group, put_population
   public :: population_properties

   !> Variables of the group
   type(property_type), target, protected :: population_properties(2) = [ &
      & property_type('file', is_text, required=.true., names='a CSV table with one row a wall', changes_results=.false., &
      &   example='data/walls/population.csv', meaning='table with one row a wall, from the folder of this file'), &
      & property_type('designs', is_logical, changes_results=.false., &
      &   meaning='are the walls designs of one wall, each to be compared with the first?')]

contains

   !> Read the group
   subroutine read_population_group(group, file, designs, error)
      !> The group as it stands in the file
      type(group_type), intent(in) :: group
      !> Path of the table of walls, relative to the case
      character(len=:), allocatable, intent(out) :: file
      !> Are the walls designs of one wall?
      logical, intent(out) :: designs
      !> What is wrong with it
      type(error_type), allocatable, intent(out) :: error

      type(group_settings_type) :: settings

      call new_settings(settings, population_properties)
      call read_settings(group, settings, error)
      file = settings%word('file')
      designs = settings%holds('designs')
   end subroutine read_population_group

   !> The group as settings
   subroutine put_population(file, designs, settings)
      !> Path of the table of walls as it was given
      character(len=*), intent(in) :: file
      !> Are the walls designs of one wall?
      logical, intent(in) :: designs
      !> Values of population_properties
      type(group_settings_type), intent(out) :: settings

      call new_settings(settings, population_properties)
      call settings%set('file', file)
      call settings%set('designs', designs)
   end subroutine put_population

end module dondolo_case_population_group
