!> Settings of the C interface: values by the names that they have in cases.
module dondolo_interface_c_settings
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t, c_null_ptr, c_ptr
   use dondolo_base_error, only : error_type, not_a_flag, not_a_number, not_a_string, not_a_word, not_an_integer, out_of_range, &
      & problems_type, raise_input, wrong_length
   use dondolo_base_kinds, only : wp
   use dondolo_base_plain, only : shown
   use dondolo_base_property, only : find_property, is_integer, is_list, is_logical, is_text, is_words, name_length, property_type
   use dondolo_base_settings, only : group_settings_type, new_settings, settings_type
   use dondolo_base_settings_check, only : check_settings
   use dondolo_base_spelling, only : say_allowed
   use dondolo_base_text, only : join, lower, to_text
   use dondolo_case_records_group, only : records_properties
   use dondolo_case_stripes_group, only : stripes_properties
   use dondolo_interface_c_error, only : failure_type, is_ready, status_without_handle
   use dondolo_interface_c_text, only : as_handle, as_pointer, check_finite, take_numbers, take_text
   use dondolo_interface_handles, only : content_of, hold, refuse_handle
   use dondolo_motion_solver, only : solver_properties, solver_type, take_solver
   use dondolo_wall_gravity, only : gravity_property
   use dondolo_wall_properties, only : wall_properties
   implicit none
   private

   public :: c_settings_type, find_settings, copy_settings, solver_of

   !> Groups that settings can be of
   character(len=7), parameter :: group_names(3) = [character(len=7) :: 'wall', 'stripes', 'solver']

   !> Settings of a group
   type :: c_settings_type
      !> Their group
      character(len=:), allocatable :: group
      !> Their table
      type(property_type), allocatable :: table(:)
      !> Their values
      type(group_settings_type) :: values
   end type c_settings_type

contains

   !> Rows of a table by their names
   pure function rows_of(table, names) result(rows)
      type(property_type), intent(in) :: table(:)
      character(len=*), intent(in) :: names(:)
      !> A row for each name
      type(property_type) :: rows(size(names))

      integer :: i

      do i = 1, size(names)
         rows(i) = table(find_property(table, trim(names(i))))
      end do
   end function rows_of

   !> Make settings of a group, without values
   type(c_ptr) function c_new_settings(error, group) result(made) bind(c, name='dondolo_new_settings')
      type(c_ptr), intent(in), value :: error, group

      type(failure_type), pointer :: failure
      type(c_settings_type), pointer :: settings
      type(error_type), allocatable :: problem
      class(*), pointer :: content
      character(len=:), allocatable :: name
      integer(c_int64_t) :: handle

      made = c_null_ptr
      if (.not. is_ready(error, failure)) return
      call take_text(group, 'group', name, problem)
      if (.not. allocated(problem) .and. .not. any(group_names == name)) call raise_input(problem, &
         & 'group = '''//shown(name)//''': must be one of '//join(group_names), not_a_word, 'group')
      if (.not. allocated(problem)) then
         allocate (settings)
         settings%group = name
         select case (name)
         case ('wall')
            settings%table = [wall_properties, gravity_property]
         case ('stripes')
            settings%table = [rows_of(stripes_properties, [character(len=7) :: 'im', 'levels']), &
               & rows_of(records_properties, ['polarity'])]
         case ('solver')
            settings%table = rows_of(solver_properties, [character(len=14) :: 'engine', 'rtol', 'atol', 'edp_limit', &
               & 'estimate_error'])
         end select
         call new_settings(settings%values, settings%table)
         content => settings
         call hold(content, handle)
         made = as_pointer(handle)
      end if
      call failure%take(problem)
   end function c_new_settings

   !> The settings of a handle
   subroutine find_settings(pointer, settings, error, group)
      !> The handle
      type(c_ptr), intent(in) :: pointer
      !> The settings
      type(c_settings_type), pointer, intent(out) :: settings
      !> It is a handle of something else, or was freed; settings of another group
      type(error_type), allocatable, intent(out) :: error
      !> Group that they must be of; any if absent
      character(len=*), intent(in), optional :: group

      class(*), pointer :: content

      settings => null()
      content => content_of(as_handle(pointer))
      select type (content)
      type is (c_settings_type)
         settings => content
      class default
         call refuse_handle('settings', as_handle(pointer), error)
         return
      end select
      if (.not. present(group)) return
      if (settings%group /= group) call raise_input(error, 'settings: belong to the group '''//settings%group// &
         & ''', must belong to '''//group//'''', out_of_range, 'settings')
   end subroutine find_settings

   !> Find the settings of a handle, and the row of a name in their table
   subroutine find_row(pointer, name, settings, row, error)
      !> The handle, and the name as C has it
      type(c_ptr), intent(in) :: pointer, name
      !> The settings
      type(c_settings_type), pointer, intent(out) :: settings
      !> Number of the row
      integer, intent(out) :: row
      !> No settings, or no such name: with those that there are
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: text, allowed
      character(len=name_length), allocatable :: names(:)

      row = 0
      call find_settings(pointer, settings, error)
      if (.not. allocated(error)) call take_text(name, 'name', text, error)
      if (allocated(error)) return
      if (len_trim(text) > 0) row = find_property(settings%table, lower(trim(text)))
      if (row > 0) return
      names = settings%table%name
      ! A hint compares whole texts, which may be of any length
      call say_allowed(lower(text(:min(len(text), 2*name_length))), names, '--template', allowed)
      call raise_input(error, settings%group//': '//shown(text)//': no such variable'//allowed)
   end subroutine find_row

   !> Set a number: a logical is 1 or 0, and of a list it is the only value
   integer(c_int) function set_number(error, settings, name, value) result(status) bind(c, name='dondolo_set_number')
      type(c_ptr), intent(in), value :: error, settings, name
      real(c_double), intent(in), value :: value

      type(failure_type), pointer :: failure
      type(c_settings_type), pointer :: found
      type(error_type), allocatable :: problem
      integer :: row

      status = status_without_handle
      if (is_ready(error, failure)) then
         call find_row(settings, name, found, row, problem)
         if (.not. allocated(problem)) call check_kind(found%table(row), [value], problem)
         if (.not. allocated(problem)) call found%values%set(trim(found%table(row)%name), real(value, wp))
         call failure%take(problem)
      end if
      if (associated(failure)) status = failure%status()
   end function set_number

   !> Set a list of numbers
   integer(c_int) function set_list(error, settings, name, values, count) result(status) bind(c, name='dondolo_set_list')
      type(c_ptr), intent(in), value :: error, settings, name, values
      integer(c_int), intent(in), value :: count

      type(failure_type), pointer :: failure
      type(c_settings_type), pointer :: found
      type(error_type), allocatable :: problem
      real(c_double), pointer :: numbers(:)
      integer :: row

      status = status_without_handle
      if (is_ready(error, failure)) then
         call find_row(settings, name, found, row, problem)
         if (.not. allocated(problem)) call take_numbers(values, count, trim(found%table(row)%name), numbers, problem)
         if (.not. allocated(problem)) call check_kind(found%table(row), numbers, problem)
         if (.not. allocated(problem)) call found%values%set(trim(found%table(row)%name), real(numbers, wp))
         call failure%take(problem)
      end if
      if (associated(failure)) status = failure%status()
   end function set_list

   !> Set a text
   integer(c_int) function set_text(error, settings, name, value) result(status) bind(c, name='dondolo_set_text')
      type(c_ptr), intent(in), value :: error, settings, name, value

      type(failure_type), pointer :: failure
      type(c_settings_type), pointer :: found
      type(error_type), allocatable :: problem
      character(len=:), allocatable :: text
      integer :: row

      status = status_without_handle
      if (is_ready(error, failure)) then
         call find_row(settings, name, found, row, problem)
         if (.not. allocated(problem)) call take_text(value, trim(found%table(row)%name), text, problem)
         if (.not. allocated(problem)) then
            select case (found%table(row)%kind)
            case (is_text, is_words)
               call found%values%set(trim(found%table(row)%name), text)
            case default
               call raise_input(problem, trim(found%table(row)%name)//' = '''//shown(text)//''': must be a number', &
                  & not_a_number, trim(found%table(row)%name))
            end select
         end if
         call failure%take(problem)
      end if
      if (associated(failure)) status = failure%status()
   end function set_text

   !> Check that a property can have numbers, as far as its kind says
   subroutine check_kind(property, numbers, error)
      type(property_type), intent(in) :: property
      !> One, or those of a list
      real(c_double), intent(in) :: numbers(:)
      !> A text is wanted, one number, a whole one, or 0 or 1
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: name

      name = trim(property%name)
      select case (property%kind)
      case (is_text, is_words)
         call raise_input(error, name//' = '//to_text(real(numbers(1), wp))//': must be a string', not_a_string, name)
      case (is_list)
         call check_finite(numbers, name, error)
      case default
         if (size(numbers) > 1) then
            call raise_input(error, name//': has '//to_text(size(numbers))//' values, must have 1', wrong_length, name)
         else
            call check_finite(numbers, name, error)
            if (.not. allocated(error)) call check_whole(numbers(1))
         end if
      end select

   contains

      !> Check one number against its kind
      subroutine check_whole(number)
         real(c_double), intent(in) :: number

         if (property%kind == is_logical .and. all(abs(number - [0.0_c_double, 1.0_c_double]) > 0.0_c_double)) then
            call raise_input(error, name//' = '//to_text(real(number, wp))//': must be 0 or 1', not_a_flag, name)
         else if (property%kind == is_integer .and. abs(number - anint(number)) > 0.0_c_double) then
            call raise_input(error, name//' = '//to_text(real(number, wp))//': must be an integer', not_an_integer, name)
         end if
      end subroutine check_whole

   end subroutine check_kind

   !> Copy the values that settings have into others, which have the same properties among theirs
   subroutine copy_settings(from, to)
      type(c_settings_type), intent(in) :: from
      class(settings_type), intent(inout) :: to

      character(len=:), allocatable :: name
      integer :: i

      do i = 1, size(from%table)
         name = trim(from%table(i)%name)
         if (.not. from%values%has(name) .or. name == gravity_property%name) cycle
         if (from%values%has_word(name)) then
            call to%set(name, from%values%word(name))
         else if (from%values%has_list(name)) then
            call to%set(name, from%values%list(name))
         else
            call to%set(name, from%values%number(name))
         end if
      end do
   end subroutine copy_settings

   !> How motions are to be computed
   subroutine solver_of(pointer, solver, error)
      !> Handle of settings of the group solver; NULL: the defaults
      type(c_ptr), intent(in) :: pointer
      type(solver_type), intent(out) :: solver
      !> No such settings, or a value that cannot be
      type(error_type), allocatable, intent(out) :: error

      type(c_settings_type), pointer :: settings
      type(group_settings_type) :: whole
      type(problems_type) :: problems

      if (as_handle(pointer) == 0) return
      call find_settings(pointer, settings, error, 'solver')
      if (allocated(error)) return
      call new_settings(whole, solver_properties)
      call copy_settings(settings, whole)
      call whole%fill()
      call check_settings(whole, problems)
      call problems%raise(error)
      if (.not. allocated(error)) call take_solver(solver, whole)
   end subroutine solver_of

end module dondolo_interface_c_settings
