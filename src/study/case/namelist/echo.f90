!> The echo of a case: groups of variables and their values in force, to be written as namelist text or as JSON.
module dondolo_case_echo
   use dondolo_base_json, only : json_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_text, only : to_text
   implicit none
   private

   public :: echo_type

   !> A variable and its value
   type :: setting_type
      character(len=:), allocatable :: group
      character(len=:), allocatable :: name
      !> Value in the notation of namelists and of JSON; not allocated for a text, whose quotes differ
      character(len=:), allocatable :: namelist, json
      !> Value of a text
      character(len=:), allocatable :: text
      !> Is the variable written on the line of the one before it?
      logical :: joins = .false.
   end type setting_type

   !> Variables in the order in which they were added; those of a group follow each other
   type :: echo_type
      integer, private :: count = 0
      type(setting_type), allocatable, private :: item(:)
   contains
      !> Add a variable of a group
      generic :: add => add_text, add_real, add_reals, add_integer, add_logical
      procedure, private :: add_text, add_real, add_reals, add_integer, add_logical
      !> Append them to lines as namelist text
      procedure :: to_namelist
      !> Write them as JSON
      procedure :: to_json
   end type echo_type

contains

   subroutine add_text(self, group, name, value)
      class(echo_type), intent(inout) :: self
      character(len=*), intent(in) :: group, name
      character(len=*), intent(in) :: value

      call append(self, group, name)
      self%item(self%count)%text = value
   end subroutine add_text

   !> Add a number; `joins`: on the line of the variable before it
   subroutine add_real(self, group, name, value, joins)
      class(echo_type), intent(inout) :: self
      character(len=*), intent(in) :: group, name
      real(wp), intent(in) :: value
      logical, intent(in), optional :: joins

      call append(self, group, name, to_text(value))
      if (present(joins)) self%item(self%count)%joins = joins
   end subroutine add_real

   subroutine add_reals(self, group, name, values)
      class(echo_type), intent(inout) :: self
      character(len=*), intent(in) :: group, name
      real(wp), intent(in) :: values(:)

      character(len=:), allocatable :: list
      integer :: i

      list = ''
      do i = 1, size(values)
         if (i > 1) list = list//', '
         list = list//to_text(values(i))
      end do
      call append(self, group, name, list, '['//list//']')
   end subroutine add_reals

   subroutine add_integer(self, group, name, value)
      class(echo_type), intent(inout) :: self
      character(len=*), intent(in) :: group, name
      integer, intent(in) :: value

      call append(self, group, name, to_text(value))
   end subroutine add_integer

   subroutine add_logical(self, group, name, value)
      class(echo_type), intent(inout) :: self
      character(len=*), intent(in) :: group, name
      logical, intent(in) :: value

      call append(self, group, name, trim(merge('.true. ', '.false.', value)), trim(merge('true ', 'false', value)))
   end subroutine add_logical

   !> Append a variable; JSON is the namelist's notation unless it is given
   subroutine append(self, group, name, namelist, json)
      class(echo_type), intent(inout) :: self
      character(len=*), intent(in) :: group, name
      character(len=*), intent(in), optional :: namelist, json

      integer, parameter :: room = 64
      type(setting_type), allocatable :: more(:)

      if (.not. allocated(self%item)) allocate (self%item(room))
      if (self%count == size(self%item)) then
         allocate (more(2*self%count))
         more(:self%count) = self%item
         call move_alloc(more, self%item)
      end if
      self%count = self%count + 1
      associate (item => self%item(self%count))
         item%group = group
         item%name = name
         if (present(namelist)) item%namelist = namelist
         if (present(namelist)) item%json = namelist
         if (present(json)) item%json = json
      end associate
   end subroutine append

   !> Append them to lines as namelist text: one variable a line, but for those that join
   subroutine to_namelist(self, lines)
      class(echo_type), intent(in) :: self
      type(lines_type), intent(inout) :: lines

      character(len=:), allocatable :: line, value
      integer :: i

      line = ''
      do i = 1, self%count
         associate (item => self%item(i))
            if (item%joins) then
               line = line//', '
            else if (is_first(self, i)) then
               line = '&'//item%group//' '
            else
               line = repeat(' ', len(item%group) + 2)
            end if
            if (allocated(item%text)) then
               call quote(item%text, value)
            else
               value = item%namelist
            end if
            line = line//item%name//' = '//value
            if (i == self%count) then
               call lines%add(line//' /')
            else if (is_first(self, i + 1)) then
               call lines%add(line//' /')
            else if (.not. self%item(i + 1)%joins) then
               call lines%add(line)
            end if
         end associate
      end do
   end subroutine to_namelist

   !> Write them as a JSON object of groups, each an object of variables
   subroutine to_json(self, json)
      class(echo_type), intent(in) :: self
      type(json_type), intent(inout) :: json

      integer :: i

      call json%open_object('settings')
      do i = 1, self%count
         associate (item => self%item(i))
            if (i > 1 .and. is_first(self, i)) call json%close_object()
            if (is_first(self, i)) call json%open_object(item%group)
            if (allocated(item%text)) then
               call json%put(item%name, item%text)
            else
               call json%put_raw(item%name, item%json)
            end if
         end associate
      end do
      if (self%count > 0) call json%close_object()
      call json%close_object()
   end subroutine to_json

   !> Is a variable the first of its group?
   pure logical function is_first(self, i)
      class(echo_type), intent(in) :: self
      integer, intent(in) :: i

      is_first = i == 1
      if (i > 1) is_first = self%item(i)%group /= self%item(i - 1)%group
   end function is_first

   !> A text in the quotes of a namelist: those within it are doubled
   pure subroutine quote(text, quoted)
      character(len=*), intent(in) :: text
      character(len=:), allocatable, intent(out) :: quoted

      integer :: i, at

      quoted = ''''//repeat('''', count([(text(i:i) == '''', i=1, len(text))]) + len(text) + 1)
      at = 1
      do i = 1, len(text)
         at = at + 1
         quoted(at:at) = text(i:i)
         if (text(i:i) == '''') at = at + 1
      end do
   end subroutine quote

end module dondolo_case_echo
