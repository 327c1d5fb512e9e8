!> Namelist files, read strictly.
!>
!> Fortran's own namelist READ skips groups it does not know, takes the first of two groups of one name, cuts long
!> strings and reads `0,05` as two numbers, all in silence. Here tokens are put together to groups, variables and
!> values, and whatever does not fit is an error that names its line.
!>
!>     &wall  height = 3.0, thickness = 0.25   ! a comment
!>            name = 'facade' /
module dondolo_namelist
   use dondolo_error, only : error_type, raise_input
   use dondolo_limits, only : longest_case
   use dondolo_name_index, only : name_index_type
   use dondolo_namelist_group, only : group_type, value_type, variable_type
   use dondolo_namelist_tokens, only : comma, cut, end_of_file, equals, group_begin, group_end, quoted, token_type, word
   use dondolo_text, only : lower, to_text
   use dondolo_text_file, only : read_text_file, text_file_type
   implicit none
   private

   public :: namelist_type, read_namelist

   !> A namelist file
   type :: namelist_type
      !> Path of the file
      character(len=:), allocatable :: file
      !> Its groups
      type(group_type), allocatable :: groups(:)
   contains
      !> A group from its name
      procedure :: group
      !> Refuse groups that do not exist
      procedure :: check_groups
   end type namelist_type

contains

   !> Read a namelist file
   subroutine read_namelist(file, namelist, error)
      !> Path of the file
      character(len=*), intent(in) :: file
      !> What stands in it
      type(namelist_type), intent(out) :: namelist
      !> The file cannot be read, is too long, or is no namelist file
      type(error_type), allocatable, intent(out) :: error

      type(text_file_type) :: text
      type(token_type), allocatable :: tokens(:)

      call read_text_file(file, text, error, longest_case)
      if (allocated(error)) return
      call cut(text, tokens, error)
      if (allocated(error)) return
      namelist%file = file
      call take_groups(text, tokens, namelist, error)
   end subroutine read_namelist

   !> A group from its name
   function group(self, name) result(found)
      class(namelist_type), intent(in) :: self
      !> Name in lower case
      character(len=*), intent(in) :: name
      !> The group; its line is 0 if the file does not have it
      type(group_type) :: found

      integer :: i

      do i = 1, size(self%groups)
         if (self%groups(i)%name /= name) cycle
         found = self%groups(i)
         return
      end do
      found%file = self%file
      found%name = name
   end function group

   !> Refuse groups that do not exist
   subroutine check_groups(self, names, error)
      class(namelist_type), intent(in) :: self
      !> Names of the groups that exist, in lower case
      character(len=*), intent(in) :: names(:)
      !> Names the first one that is not known
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: list
      integer :: i, j

      do i = 1, size(self%groups)
         if (any(self%groups(i)%name == names)) cycle
         list = ''
         do j = 1, size(names)
            if (j > 1) list = list//', '
            list = list//'&'//trim(names(j))
         end do
         call raise_input(error, self%groups(i)%place()//' (line '//to_text(self%groups(i)%line)// &
            & '): no such group; there are '//list)
         return
      end do
   end subroutine check_groups

   !> Put tokens together to groups
   subroutine take_groups(text, tokens, namelist, error)
      !> The file, for messages
      type(text_file_type), intent(in) :: text
      type(token_type), intent(in) :: tokens(:)
      type(namelist_type), intent(inout) :: namelist
      !> Text outside groups, a group that is not closed or is a duplicate
      type(error_type), allocatable, intent(out) :: error

      type(group_type) :: next
      type(name_index_type) :: names
      integer :: at, count, before

      allocate (namelist%groups(8))
      count = 0
      at = 1
      do while (tokens(at)%kind /= end_of_file)
         if (tokens(at)%kind /= group_begin) then
            call raise_input(error, text%place(tokens(at)%line)//': '//tokens(at)%typed// &
               & ' is outside a group: must be &name ... /')
            return
         end if
         next%file = text%file
         next%name = tokens(at)%text
         next%line = tokens(at)%line
         call names%note(next%name, next%line, before)
         if (before > 0) then
            call raise_input(error, next%place()//': given twice, in lines '//to_text(before)//' and '// &
               & to_text(next%line))
            return
         end if
         at = at + 1
         call take_variables(tokens, at, next, error)
         if (allocated(error)) return
         if (count == size(namelist%groups)) call widen_groups(namelist%groups)
         count = count + 1
         call move_group(next, namelist%groups(count))
      end do
      namelist%groups = namelist%groups(:count)
      if (count == 0) call raise_input(error, text%file//': no group: a case is made of groups, &name ... /')
   end subroutine take_groups

   !> Put tokens together to the variables of a group
   subroutine take_variables(tokens, at, group, error)
      type(token_type), intent(in) :: tokens(:)
      !> The token after the name of the group, then the one after its end
      integer, intent(inout) :: at
      type(group_type), intent(inout) :: group
      !> What does not fit
      type(error_type), allocatable, intent(out) :: error

      type(variable_type) :: variable
      type(name_index_type) :: names
      integer :: count, before

      if (allocated(group%variables)) deallocate (group%variables)
      allocate (group%variables(8))
      count = 0
      do
         select case (tokens(at)%kind)
         case (group_end)
            at = at + 1
            group%variables = group%variables(:count)
            return
         case (group_begin)
            call raise_input(error, group%place()//': not closed: a / is missing before '//tokens(at)%typed// &
               & ' in line '//to_text(tokens(at)%line))
            return
         case (end_of_file)
            call raise_input(error, group%place()//': not closed: a / is missing at its end'//group%in_line(''))
            return
         case (word)
            call take_variable(tokens, at, group, variable, error)
            if (allocated(error)) return
         case default
            call raise_input(error, group%place()//': '//tokens(at)%typed//' (line '//to_text(tokens(at)%line)// &
               & '): must be the name of a variable and =')
            return
         end select
         call names%note(variable%name, variable%line, before)
         if (before > 0) then
            call raise_input(error, group%place()//': '//variable%name//': given twice, in lines '// &
               & to_text(before)//' and '//to_text(variable%line))
            return
         end if
         if (count == size(group%variables)) call widen_variables(group%variables)
         count = count + 1
         call move_variable(variable, group%variables(count))
      end do
   end subroutine take_variables

   !> Take one variable: name = value, value, ...
   subroutine take_variable(tokens, at, group, variable, error)
      type(token_type), intent(in) :: tokens(:)
      !> The name, then the token after the last value
      integer, intent(inout) :: at
      !> The group, for messages
      type(group_type), intent(in) :: group
      type(variable_type), intent(out) :: variable
      !> What does not fit
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: place
      integer :: count
      logical :: after_comma

      variable%name = lower(tokens(at)%text)
      variable%line = tokens(at)%line
      place = group%place()//': '//variable%name//' (line '//to_text(variable%line)//'): '
      allocate (variable%values(8))
      count = 0
      if (index(variable%name, '(') > 0) then
         call raise_input(error, place//'subscripts are not allowed: give the whole list, name = value, value, ...')
         return
      end if
      if (tokens(at + 1)%kind /= equals) then
         call raise_input(error, place//'must be the name of a variable and =')
         return
      end if
      at = at + 2
      after_comma = .true.
      do
         select case (tokens(at)%kind)
         case (word, quoted)
            if (tokens(at)%kind == word) then
               if (tokens(at + 1)%kind == equals .and. is_name(tokens(at)%text)) exit
               if (index(tokens(at)%text, '*') > 0) then
                  call raise_input(error, place//tokens(at)%typed// &
                     & ': repeat counts are not allowed: write every value')
                  return
               end if
            end if
            if (count == size(variable%values)) call widen_values(variable%values)
            count = count + 1
            associate (value => variable%values(count), token => tokens(at))
               value%typed = token%typed
               value%text = token%text
               value%quoted = token%kind == quoted
               value%line = token%line
            end associate
            after_comma = .false.
         case (comma)
            if (after_comma) then
               call raise_input(error, place//'a value is missing before a comma')
               return
            end if
            after_comma = .true.
         case (equals)
            call raise_input(error, place//'a second = follows it')
            return
         case default
            exit
         end select
         at = at + 1
      end do
      variable%values = variable%values(:count)
      if (count == 0) call raise_input(error, place//'no value follows its =')
   end subroutine take_variable

   !> Can a word be the name of a variable?
   pure logical function is_name(text)
      !> Word
      character(len=*), intent(in) :: text

      is_name = lower(text(1:1)) >= 'a' .and. lower(text(1:1)) <= 'z'
   end function is_name

   !> Double the room for values
   subroutine widen_values(values)
      !> Values
      type(value_type), allocatable, intent(inout) :: values(:)

      type(value_type), allocatable :: more(:)
      integer :: i

      allocate (more(2*size(values)))
      do i = 1, size(values)
         call move_alloc(values(i)%typed, more(i)%typed)
         call move_alloc(values(i)%text, more(i)%text)
         more(i)%quoted = values(i)%quoted
         more(i)%line = values(i)%line
      end do
      call move_alloc(more, values)
   end subroutine widen_values

   !> Double the room for variables
   subroutine widen_variables(variables)
      !> Variables
      type(variable_type), allocatable, intent(inout) :: variables(:)

      type(variable_type), allocatable :: more(:)
      integer :: i

      allocate (more(2*size(variables)))
      do i = 1, size(variables)
         call move_variable(variables(i), more(i))
      end do
      call move_alloc(more, variables)
   end subroutine widen_variables

   !> Double the room for groups
   subroutine widen_groups(groups)
      !> Groups
      type(group_type), allocatable, intent(inout) :: groups(:)

      type(group_type), allocatable :: more(:)
      integer :: i

      allocate (more(2*size(groups)))
      do i = 1, size(groups)
         call move_group(groups(i), more(i))
      end do
      call move_alloc(more, groups)
   end subroutine widen_groups

   !> Move a variable, since a copy would copy all its values
   subroutine move_variable(from, to)
      !> The variable; empty afterwards
      type(variable_type), intent(inout) :: from
      !> Its new place
      type(variable_type), intent(inout) :: to

      call move_alloc(from%name, to%name)
      call move_alloc(from%values, to%values)
      to%line = from%line
   end subroutine move_variable

   !> Move a group, since a copy would copy all its variables
   subroutine move_group(from, to)
      !> The group; empty afterwards
      type(group_type), intent(inout) :: from
      !> Its new place
      type(group_type), intent(inout) :: to

      call move_alloc(from%file, to%file)
      call move_alloc(from%name, to%name)
      call move_alloc(from%variables, to%variables)
      to%line = from%line
   end subroutine move_group

end module dondolo_namelist
