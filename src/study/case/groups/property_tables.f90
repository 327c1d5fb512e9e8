!> All tables of properties, by the name of their group in a namelist.
module dondolo_case_property_tables
   ! First: gfortran 12 fails where these stand last.
   use dondolo_base_property, only : property_type
   use dondolo_building_input, only : building_properties
   use dondolo_case_history_group, only : history_properties
   use dondolo_case_job_group, only : job_properties
   use dondolo_case_population_group, only : population_properties
   use dondolo_case_records_group, only : records_properties
   use dondolo_case_stripes_group, only : stripes_properties
   use dondolo_case_uncertainty_group, only : uncertainty_properties
   use dondolo_check_input, only : check_properties
   use dondolo_motion_solver, only : solver_properties
   use dondolo_population_wall_row, only : row_properties
   use dondolo_wall_properties, only : own_properties, wall_properties
   implicit none
   private

   public :: property_table
   public :: group_names, table_names

   !> Groups of a namelist
   character(len=11), parameter :: group_names(*) = [character(len=11) :: 'job', 'wall', 'building', &
      & 'population', 'records', 'stripes', 'solver', 'history', 'check', 'uncertainty']

   !> The same, and what rows of a population have besides the properties of a wall
   character(len=11), parameter :: table_names(*) = [character(len=11) :: group_names, 'row']

contains

   !> The table of a group
   pure function property_table(name) result(table)
      !> One of table_names
      character(len=*), intent(in) :: name
      !> Its rows; none for another name
      type(property_type), allocatable :: table(:)

      select case (name)
      case ('job')
         table = job_properties
      case ('wall')
         table = wall_properties(:own_properties)
      case ('building')
         table = building_properties
      case ('uncertainty')
         table = uncertainty_properties
      case ('population')
         table = population_properties
      case ('records')
         table = records_properties
      case ('stripes')
         table = stripes_properties
      case ('solver')
         table = solver_properties
      case ('history')
         table = history_properties
      case ('check')
         table = check_properties
      case ('row')
         table = row_properties
      case default
         allocate (table(0))
      end select
   end function property_table

end module dondolo_case_property_tables
