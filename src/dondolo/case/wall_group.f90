!> The group &wall, and the same variables by name, as the columns of a population have them.
!>
!> Ranges are checked where the wall is made (dondolo_wall), so that they hold for every user of it.
module dondolo_wall_group
   use dondolo_error, only : error_type
   use dondolo_kinds, only : wp
   use dondolo_namelist_group, only : group_type
   use dondolo_settings, only : settings_type
   use dondolo_text, only : lower
   use dondolo_wall, only : wall_input_type
   implicit none
   private

   public :: read_wall, echo_wall, set_wall_text, set_wall_number
   public :: wall_texts, wall_numbers, wall_variables

   !> Variables that are texts
   character(len=18), parameter :: wall_texts(4) = [character(len=18) :: 'name', 'mechanism', 'restitution', 'bearing']

   !> Variables that are numbers
   character(len=18), parameter :: wall_numbers(9) = [character(len=18) :: 'height', 'thickness', 'density', &
      & 'hinge', 'restitution_value', 'restitution_factor', 'overburden', 'eccentricity', 'bearing_distance']

   !> All variables, in the order in which a user thinks of them
   character(len=18), parameter :: wall_variables(13) = [character(len=18) :: 'name', 'mechanism', 'height', &
      & 'thickness', 'density', 'hinge', 'restitution', 'restitution_value', 'restitution_factor', 'overburden', &
      & 'eccentricity', 'bearing', 'bearing_distance']

contains

   !> Read the group
   subroutine read_wall(group, input, error)
      !> The group as it stands in the file
      type(group_type), intent(in) :: group
      !> What is said of the wall
      type(wall_input_type), intent(out) :: input
      !> A variable that does not exist or has a value of the wrong type
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: text
      real(wp) :: number
      integer :: i

      call group%check_names(wall_variables, error)
      if (allocated(error)) return
      do i = 1, size(wall_texts)
         if (.not. group%has(trim(wall_texts(i)))) cycle
         call group%get_text(trim(wall_texts(i)), text, error)
         if (allocated(error)) return
         call set_wall_text(input, wall_texts(i), text)
      end do
      do i = 1, size(wall_numbers)
         if (.not. group%has(trim(wall_numbers(i)))) cycle
         number = 0.0_wp
         call group%get_real(trim(wall_numbers(i)), number, error)
         if (allocated(error)) return
         call set_wall_number(input, wall_numbers(i), number)
      end do
   end subroutine read_wall

   !> Set a variable that is a text
   subroutine set_wall_text(input, name, value)
      !> What is said of the wall
      type(wall_input_type), intent(inout) :: input
      !> One of wall_texts
      character(len=*), intent(in) :: name
      !> Value
      character(len=*), intent(in) :: value

      select case (name)
      case ('name')
         input%name = trim(value)
      case ('mechanism')
         input%mechanism = lower(trim(value))
      case ('restitution')
         input%restitution = lower(trim(value))
      case ('bearing')
         input%bearing = lower(trim(value))
      end select
   end subroutine set_wall_text

   !> Set a variable that is a number
   subroutine set_wall_number(input, name, value)
      !> What is said of the wall
      type(wall_input_type), intent(inout) :: input
      !> One of wall_numbers
      character(len=*), intent(in) :: name
      !> Value
      real(wp), intent(in) :: value

      select case (name)
      case ('height')
         input%height = value
      case ('thickness')
         input%thickness = value
      case ('density')
         input%density = value
      case ('hinge')
         input%hinge = value
      case ('restitution_value')
         input%restitution_value = value
      case ('restitution_factor')
         input%restitution_factor = value
      case ('overburden')
         input%overburden = value
      case ('eccentricity')
         input%eccentricity = value
      case ('bearing_distance')
         input%bearing_distance = value
      end select
   end subroutine set_wall_number

   !> Write the group as namelist text with every value in force
   subroutine echo_wall(input, settings)
      !> What is said of the wall, defaults filled in
      type(wall_input_type), intent(in) :: input
      !> Settings to add to
      type(settings_type), intent(inout) :: settings

      call settings%add('wall', 'name', input%name)
      call settings%add('wall', 'mechanism', input%mechanism)
      call settings%add('wall', 'height', input%height)
      call settings%add('wall', 'thickness', input%thickness)
      call settings%add('wall', 'density', input%density)
      call echo_number('hinge', input%hinge)
      call settings%add('wall', 'restitution', input%restitution)
      call echo_number('restitution_value', input%restitution_value)
      call echo_number('overburden', input%overburden)
      call echo_number('eccentricity', input%eccentricity)
      call settings%add('wall', 'restitution_factor', input%restitution_factor)

   contains

      !> Write a number that not every wall has
      subroutine echo_number(name, value)
         !> Name of the variable
         character(len=*), intent(in) :: name
         !> Its value
         real(wp), allocatable, intent(in) :: value

         if (allocated(value)) call settings%add('wall', name, value)
      end subroutine echo_number

   end subroutine echo_wall

end module dondolo_wall_group
