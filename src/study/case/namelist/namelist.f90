!> Namelist files, read strictly.
!>
!> Fortran's own namelist READ skips groups it does not know, takes the first of two groups of one name, cuts long
!> strings and reads `0,05` as two numbers, all in silence. Here tokens are put together to groups, variables and
!> values, and whatever does not fit is an error that names its line.
!>
!>     &wall  height = 3.0, thickness = 0.25   ! a comment
!>            name = 'facade' /
module dondolo_case_namelist
   use dondolo_base_error, only : error_type, problems_type, raise_input
   use dondolo_base_limits, only : longest_case
   use dondolo_base_text, only : lower, to_text
   use dondolo_case_namelist_group, only : group_type, variable_type
   use dondolo_case_namelist_tokens, only : comma, cut, end_of_file, equals, group_begin, group_end, quoted, token_type, word
   use dondolo_files_name_index, only : name_index_type
   use dondolo_files_text_file, only : find_lines, read_text_file, text_file_type
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
   subroutine read_namelist(file, namelist, error, content)
      !> Path of the file; with `content` its name in messages
      character(len=*), intent(in) :: file
      !> What stands in it
      type(namelist_type), intent(out) :: namelist
      !> The file cannot be read, is too long, or is no namelist file
      type(error_type), allocatable, intent(out) :: error
      !> What is in the file, which is not read then
      character(len=*), intent(in), optional :: content

      type(text_file_type) :: text
      type(token_type), allocatable :: tokens(:)

      if (.not. present(content)) then
         call read_text_file(file, text, error, longest_case)
      else if (len(content) > longest_case) then
         call raise_input(error, file//': has '//to_text(len(content))//' bytes: must be at most '//to_text(longest_case))
      else
         text%file = file
         text%text = content
         call find_lines(text, error)
      end if
      if (allocated(error)) return
      call refuse_table(file, error)
      if (.not. allocated(error)) call cut(text, tokens, error)
      if (allocated(error)) return
      namelist%file = file
      call take_groups(text, tokens, namelist, error)
   end subroutine read_namelist

   !> Refuse a table or a report in the place of a case
   subroutine refuse_table(file, error)
      !> Path of the file
      character(len=*), intent(in) :: file
      !> Its name says what it is
      type(error_type), allocatable, intent(inout) :: error

      character(len=5), parameter :: endings(6) = [character(len=5) :: '.csv', '.xlsx', '.ods', '.json', '.html', '.py']
      integer :: i

      do i = 1, size(endings)
         if (index(lower(file), trim(endings(i)), back=.true.) /= len(file) - len_trim(endings(i)) + 1) cycle
         call raise_input(error, file//': must be a case, a file of groups &name ... /, such as dondolo --template prints')
         return
      end do
   end subroutine refuse_table

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
      !> Names those that are not known; the first says which there are
      type(error_type), allocatable, intent(out) :: error

      type(problems_type) :: problems
      character(len=:), allocatable :: list
      integer :: i, j

      do i = 1, size(self%groups)
         if (any(self%groups(i)%name == names)) cycle
         list = ''
         if (problems%count == 0) list = '; there are &'//trim(names(1))
         do j = 2, merge(size(names), 0, problems%count == 0)
            list = list//', &'//trim(names(j))
         end do
         call problems%note(self%groups(i)%place()//' (line '//to_text(self%groups(i)%line)//'): no such group'//list)
      end do
      call problems%raise(error)
   end subroutine check_groups

   !> Put tokens together to groups
   subroutine take_groups(text, tokens, namelist, error)
      !> The file, for messages
      type(text_file_type), intent(in) :: text
      type(token_type), intent(in) :: tokens(:)
      type(namelist_type), intent(inout) :: namelist
      !> Text outside groups, a group that is not closed or is a duplicate
      type(error_type), allocatable, intent(out) :: error

      type(name_index_type) :: names
      integer :: at, i, before

      allocate (namelist%groups(number_before(tokens, 1, [group_begin], [end_of_file])))
      at = 1
      i = 0
      do while (tokens(at)%kind /= end_of_file)
         if (tokens(at)%kind /= group_begin) then
            call raise_input(error, text%place(tokens(at)%line)//': '//tokens(at)%typed// &
               & ' is outside a group: must be &name ... /')
            return
         end if
         i = i + 1
         associate (group => namelist%groups(i))
            group%file = text%file
            group%name = tokens(at)%text
            group%line = tokens(at)%line
            call names%note(group%name, group%line, before)
            if (before > 0) then
               call raise_input(error, group%place()//': given twice, in lines '//to_text(before)//' and '// &
                  & to_text(group%line))
               return
            end if
            at = at + 1
            call take_variables(tokens, at, group, error)
         end associate
         if (allocated(error)) return
      end do
      if (i == 0) call raise_input(error, text%file//': no group: a case is made of groups, &name ... /')
   end subroutine take_groups

   !> Put tokens together to the variables of a group
   subroutine take_variables(tokens, at, group, error)
      type(token_type), intent(in) :: tokens(:)
      !> The token after the name of the group, then the one after its end
      integer, intent(inout) :: at
      type(group_type), intent(inout) :: group
      !> What does not fit
      type(error_type), allocatable, intent(out) :: error

      type(name_index_type) :: names
      integer :: i, before

      ! One more: a word without = is refused only when it is taken
      allocate (group%variables(number_before(tokens, at, [equals], [group_begin, group_end, end_of_file]) + 1))
      i = 0
      do
         select case (tokens(at)%kind)
         case (group_end)
            at = at + 1
            group%variables = group%variables(:i)
            return
         case (group_begin)
            call raise_input(error, group%place()//': not closed: a / is missing before '//tokens(at)%typed// &
               & ' in line '//to_text(tokens(at)%line))
            return
         case (end_of_file)
            group%variables = group%variables(:i)
            call raise_input(error, group%place()//': not closed: a / is missing at its end'//group%in_line(''))
            return
         case (word)
            i = i + 1
            call take_variable(tokens, at, group%place()//': ', group%variables(i), error)
            if (allocated(error)) return
         case default
            call raise_input(error, group%place()//': '//tokens(at)%typed//' (line '//to_text(tokens(at)%line)// &
               & '): must be the name of a variable and =')
            return
         end select
         associate (variable => group%variables(i))
            call names%note(variable%name, variable%line, before)
            if (before > 0) then
               call raise_input(error, group%place()//': '//variable%name//': given twice, in lines '// &
                  & to_text(before)//' and '//to_text(variable%line))
               return
            end if
         end associate
      end do
   end subroutine take_variables

   !> Take one variable: name = value, value, ...
   subroutine take_variable(tokens, at, group, variable, error)
      type(token_type), intent(in) :: tokens(:)
      !> The name, then the token after the last value
      integer, intent(inout) :: at
      !> Where the group is, for messages
      character(len=*), intent(in) :: group
      type(variable_type), intent(out) :: variable
      !> What does not fit
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: place
      integer :: count
      logical :: after_comma

      variable%name = lower(tokens(at)%text)
      variable%line = tokens(at)%line
      place = group//variable%name//' (line '//to_text(variable%line)//'): '
      allocate (variable%values(number_before(tokens, at + 2, [word, quoted], [equals, group_begin, group_end, end_of_file])))
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
            count = count + 1
            associate (value => variable%values(count), token => tokens(at))
               value%typed = token%typed
               value%text = token%text
               value%quoted = token%kind == quoted
               value%line = token%line
               value%touches = after_comma .and. token%touches .and. tokens(at - 1)%touches
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

   !> How many tokens of some kinds stand before the next that ends a part of the file
   pure integer function number_before(tokens, at, kinds, ends) result(number)
      type(token_type), intent(in) :: tokens(:)
      !> Place of the first token that counts
      integer, intent(in) :: at
      !> Kinds to count, and kinds that end the part
      integer, intent(in) :: kinds(:), ends(:)

      integer :: i

      number = 0
      do i = at, size(tokens)
         if (any(tokens(i)%kind == ends)) exit
         if (any(tokens(i)%kind == kinds)) number = number + 1
      end do
   end function number_before

end module dondolo_case_namelist
