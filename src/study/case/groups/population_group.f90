!> The group &population: the file of a population of walls, how their mechanisms occur, and whether they are designs of one
!> wall.
module dondolo_case_population_group
   use dondolo_base_error, only : error_type
   use dondolo_base_property, only : blank, is_logical, is_text, most_choices, property_type
   use dondolo_base_settings, only : group_settings_type, new_settings
   use dondolo_case_namelist_group, only : group_type
   use dondolo_case_settings_group, only : read_settings
   use dondolo_population_occurrence, only : independent, occurrence_names
   implicit none
   private

   public :: read_population_group, put_population
   public :: population_properties

   !> Variables of the group
   type(property_type), target, protected :: population_properties(3) = [ &
      & property_type('file', is_text, required=.true., names='a CSV table with one row per wall', changes_results=.false., &
      &   example='data/walls/population.csv', meaning='table with one row per wall, from the folder of this file'), &
      & property_type('occurrence', is_text, word=occurrence_names(independent), changes_results=.false., &
      &   choices=reshape(occurrence_names, [most_choices], pad=blank), meaning='whether the mechanisms of a wall can occur '// &
      &   'together, or exclude each other, where the table has no column occurrence'), &
      & property_type('designs', is_logical, changes_results=.false., &
      &   meaning='whether the walls are designs of one wall, each compared with the first')]

contains

   !> Read the group
   subroutine read_population_group(group, file, occurrence, designs, error)
      !> The group as read from the file
      type(group_type), intent(in) :: group
      !> Path of the table of walls, relative to the case
      character(len=:), allocatable, intent(out) :: file
      !> One of occurrence_names
      character(len=*), intent(out) :: occurrence
      !> Are the walls designs of one wall?
      logical, intent(out) :: designs
      !> What is wrong with it
      type(error_type), allocatable, intent(out) :: error

      type(group_settings_type) :: settings

      call new_settings(settings, population_properties)
      call read_settings(group, settings, error)
      file = settings%word('file')
      occurrence = settings%word('occurrence')
      designs = settings%holds('designs')
   end subroutine read_population_group

   !> The group as settings
   subroutine put_population(file, occurrence, designs, settings)
      !> Path of the table of walls as it was given
      character(len=*), intent(in) :: file
      !> One of occurrence_names
      character(len=*), intent(in) :: occurrence
      !> Are the walls designs of one wall?
      logical, intent(in) :: designs
      !> Values of population_properties
      type(group_settings_type), intent(out) :: settings

      call new_settings(settings, population_properties)
      call settings%set('file', file)
      call settings%set('occurrence', trim(occurrence))
      call settings%set('designs', designs)
   end subroutine put_population

end module dondolo_case_population_group
