!> Settings out of the group of a namelist, and back: the table of their properties says what there is.
module dondolo_case_settings_group
   use dondolo_base_decimals, only : rounded_to
   use dondolo_base_error, only : error_type, problems_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : find_property, has_owner, is_integer, is_list, is_logical, is_number_or_name, is_text, &
      & is_words, name_length, property_type
   use dondolo_base_settings, only : settings_type
   use dondolo_base_settings_check, only : check_settings
   use dondolo_case_echo, only : echo_type
   use dondolo_case_namelist_group, only : group_type
   implicit none
   private

   public :: read_values, read_settings, echo_settings

contains

   !> Read the values that a group gives; their ranges are checked where they are used
   subroutine read_values(group, settings, error, rows)
      !> The group as read from the file
      type(group_type), intent(in) :: group
      !> Settings; what the group says is added
      class(settings_type), intent(inout) :: settings
      !> Variables that do not exist or have a value of the wrong type
      type(error_type), allocatable, intent(out) :: error
      !> Those of their properties that the group can have; all if absent
      type(property_type), target, intent(in), optional :: rows(:)

      type(property_type), pointer :: table(:)
      type(problems_type) :: problems
      character(len=name_length), allocatable :: names(:)
      integer :: i

      call settings%get_table(table)
      if (present(rows)) table => rows
      names = table%name
      call group%check_names(names, error)
      call problems%take(error)
      do i = 1, size(table)
         if (group%has(trim(table(i)%name))) call read_value(group, table, i, settings, error)
         call problems%take(error)
      end do
      call problems%raise(error)
   end subroutine read_values

   !> Read a value
   subroutine read_value(group, table, i, settings, error)
      !> The group as read from the file
      type(group_type), intent(in) :: group
      !> Its properties
      type(property_type), intent(in) :: table(:)
      !> Number of one that it gives
      integer, intent(in) :: i
      class(settings_type), intent(inout) :: settings
      !> It is of the wrong type
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: name, of_number, text
      real(wp), allocatable :: list(:)
      real(wp) :: number
      integer :: kind, whole
      logical :: yes

      name = trim(table(i)%name)
      kind = table(i)%kind
      if (kind == is_number_or_name) kind = merge(is_text, is_integer, group%has_text(name))
      select case (kind)
      case (is_text)
         ! Of a model that a number can take the place of, the property of the number is named after it
         of_number = ''
         if (find_property(table, name//'_value') > 0) of_number = name//'_value'
         call group%get_text(name, text, error, of_number)
         if (.not. allocated(error)) call settings%set(name, text)
      case (is_words)
         call group%get_words(name, text, error)
         if (.not. allocated(error)) call settings%set(name, text)
      case (is_integer)
         whole = 0
         call group%get_integer(name, whole, error)
         if (.not. allocated(error)) call settings%set(name, whole)
      case (is_logical)
         yes = .false.
         call group%get_logical(name, yes, error)
         if (.not. allocated(error)) call settings%set(name, yes)
      case (is_list)
         call group%get_reals(name, list, error)
         if (.not. allocated(error)) call settings%set(name, list)
      case default
         number = 0.0_wp
         call group%get_real(name, number, error)
         if (.not. allocated(error)) call settings%set(name, number)
      end select
   end subroutine read_value

   !> Read a group: defaults filled in, ranges checked
   subroutine read_settings(group, settings, error)
      !> The group as read from the file
      type(group_type), intent(in) :: group
      !> Settings, without a value
      class(settings_type), intent(inout) :: settings
      !> What is wrong with them, each with its place
      type(error_type), allocatable, intent(out) :: error

      type(problems_type) :: problems

      call read_values(group, settings, error)
      if (allocated(error)) return
      call settings%fill()
      call check_settings(settings, problems)
      call problems%raise(error)
      call group%locate(error)
   end subroutine read_settings

   !> Add settings to the echo of a case as a group, with every value in force
   subroutine echo_settings(name, settings, echo, owner, beside, last, rows)
      !> Name of the group
      character(len=*), intent(in) :: name
      class(settings_type), intent(in) :: settings
      !> Echo to add to
      type(echo_type), intent(inout) :: echo
      !> Task: only properties that it has; all if absent
      character(len=*), intent(in), optional :: owner
      !> A property, a number, that stands in the line of the one before
      character(len=*), intent(in), optional :: beside
      !> A property that stands after all others
      character(len=*), intent(in), optional :: last
      !> Those of their properties that the group can have; all if absent
      type(property_type), target, intent(in), optional :: rows(:)

      type(property_type), pointer :: table(:)
      integer :: i

      call settings%get_table(table)
      if (present(rows)) table => rows
      do i = 1, size(table)
         if (present(last)) then
            if (table(i)%name == last) cycle
         end if
         call add(table(i))
      end do
      if (present(last)) call add(table(find_property(table, last)))

   contains

      !> Add a property that has a value
      subroutine add(property)
         type(property_type), intent(in) :: property

         character(len=:), allocatable :: variable
         real(wp) :: number
         logical :: joins
         integer :: kind

         if (.not. settings%has(property%name)) return
         if (present(owner)) then
            if (.not. has_owner(property, owner)) return
         end if
         joins = .false.
         if (present(beside)) joins = property%name == beside
         kind = property%kind
         if (kind == is_number_or_name) kind = merge(is_text, is_integer, settings%has_word(property%name))
         variable = trim(property%name)
         select case (kind)
         case (is_text, is_words)
            call echo%add(name, variable, settings%word(variable))
         case (is_integer)
            call echo%add(name, variable, nint(settings%number(variable)))
         case (is_logical)
            call echo%add(name, variable, settings%holds(variable))
         case (is_list)
            call echo%add(name, variable, settings%list(variable))
         case default
            number = settings%number(variable)
            ! The sum of storeys, whose last digit is that of its rounding
            if (variable == 'height') then
               if (settings%has('section_height')) number = rounded_to(number, 15)
            end if
            call echo%add(name, variable, number, joins)
         end select
      end subroutine add

   end subroutine echo_settings

end module dondolo_case_settings_group
