!> One group of a namelist file, and how its values are taken: as text, as a number, as a list of numbers.
!>
!> What is refused is refused with its place and its value as it was typed:
!> `walls.nml: &wall: thickness = 'thin': must be a number, such as 0.25 (line 12)`.
module dondolo_case_namelist_group
   use dondolo_base_error, only : add_place, error_type, not_a_flag, not_a_number, not_a_string, not_an_integer, problems_type, &
      & raise_input, unknown_name, wrong_length
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_integer, parse_real
   use dondolo_base_plain, only : name_problem, shown
   use dondolo_base_spelling, only : meant, say_allowed
   use dondolo_base_text, only : first_word, lower, to_text
   implicit none
   private

   public :: group_type, variable_type, value_type

   !> Digits
   character(len=*), parameter :: figures = '0123456789', letters = 'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ'

   !> One value
   type :: value_type
      !> The value as it was typed, with its quotes
      character(len=:), allocatable :: typed
      !> The value without its quotes
      character(len=:), allocatable :: text
      !> Was it in quotes?
      logical :: quoted = .false.
      !> Its line in the file
      integer :: line = 0
      !> Is there only a comma between the value before and this one, and no blank?
      logical :: touches = .false.
   end type value_type

   !> One variable and its values
   type :: variable_type
      !> Name, in lower case
      character(len=:), allocatable :: name
      !> Its line in the file
      integer :: line = 0
      !> Its values, one at least
      type(value_type), allocatable :: values(:)
   end type variable_type

   !> One group
   type :: group_type
      !> Path of the file
      character(len=:), allocatable :: file
      !> Name, in lower case, without the ampersand
      character(len=:), allocatable :: name
      !> Line in which it begins; 0: the file does not have this group
      integer :: line = 0
      !> Its variables
      type(variable_type), allocatable :: variables(:)
   contains
      !> Where the group is, for messages
      procedure :: place
      !> In which line a variable is, for messages
      procedure :: in_line
      !> Put the place of what is wrong around the sentences of an error
      procedure :: locate
      !> Refuse variables that the group does not have
      procedure :: check_names
      !> Was a variable given?
      procedure :: has
      !> Was a variable given in quotes?
      procedure :: has_text
      !> Take a text
      procedure :: get_text
      !> Take a list of words
      procedure :: get_words
      !> Take a real number
      procedure :: get_real
      !> Take an integer
      procedure :: get_integer
      !> Take a list of real numbers
      procedure :: get_reals
      !> Take a yes or no
      procedure :: get_logical
      !> Refuse the value of a variable
      procedure :: refuse
   end type group_type

contains

   !> Length of the place
   pure integer function place_length(self)
      class(group_type), intent(in) :: self

      place_length = len(self%file//': &'//self%name)
   end function place_length

   !> Where the group is, for messages
   pure function place(self)
      class(group_type), intent(in) :: self
      !> 'file: &group'
      character(len=place_length(self)) :: place

      place = self%file//': &'//self%name
   end function place

   !> Line of a variable, or else of the group; 0 where the file does not have the group
   pure integer function line_of(self, name)
      class(group_type), intent(in) :: self
      !> Name in lower case; empty for the group
      character(len=*), intent(in) :: name

      integer :: i

      line_of = self%line
      i = position(self, name)
      if (i > 0) line_of = self%variables(i)%line
   end function line_of

   !> Length of the text of in_line
   pure integer function in_line_length(self, name)
      class(group_type), intent(in) :: self
      !> Name in lower case; empty for the group
      character(len=*), intent(in) :: name

      in_line_length = 0
      if (line_of(self, name) > 0) in_line_length = len(' (line '//to_text(line_of(self, name))//')')
   end function in_line_length

   !> In which line a variable is, for the end of a message; the line of the group where the variable was not given
   pure function in_line(self, name) result(text)
      class(group_type), intent(in) :: self
      !> Name in lower case; empty for the group
      character(len=*), intent(in) :: name
      !> ' (line 7)'; empty where the file does not have the group
      character(len=in_line_length(self, name)) :: text

      text = ' (line '//to_text(line_of(self, name))//')'
   end function in_line

   !> Put the place of what is wrong around the sentences of an error, each of which begins with the name of a variable
   pure subroutine locate(self, error)
      class(group_type), intent(in) :: self
      !> Error to extend; left alone when not allocated
      type(error_type), allocatable, intent(inout) :: error

      character(len=:), allocatable :: message, sentence
      integer :: first, length, i

      if (.not. allocated(error)) return
      message = ''
      first = 1
      do while (first <= len(error%message))
         length = index(error%message(first:)//new_line('a'), new_line('a')) - 1
         sentence = error%message(first:first + length - 1)
         if (first > 1) message = message//new_line('a')
         message = message//sentence//self%in_line(first_word(sentence, ' :'))
         first = first + length + 1
      end do
      error%message = message
      call add_place(error, self%place())
      do i = 1, size(error%problem)
         error%problem(i)%place = error%problem(i)%place//self%in_line(error%problem(i)%variable)
      end do
   end subroutine locate

   !> Number of a variable in the group
   pure function position(self, name)
      class(group_type), intent(in) :: self
      !> Name in lower case
      character(len=*), intent(in) :: name
      !> Its number, 0 if it was not given
      integer :: position

      position = 0
      if (.not. allocated(self%variables)) return
      do position = size(self%variables), 1, -1
         if (self%variables(position)%name == name) exit
      end do
   end function position

   !> Was a variable given?
   pure function has(self, name)
      class(group_type), intent(in) :: self
      !> Name in lower case
      character(len=*), intent(in) :: name
      !> It was
      logical :: has

      has = position(self, name) > 0
   end function has

   !> Was a variable given in quotes?
   pure function has_text(self, name)
      class(group_type), intent(in) :: self
      !> Name in lower case
      character(len=*), intent(in) :: name
      !> It was given, and its first value stands in quotes
      logical :: has_text

      integer :: i

      i = position(self, name)
      has_text = .false.
      if (i > 0) has_text = self%variables(i)%values(1)%quoted
   end function has_text

   !> Refuse variables that the group does not have
   subroutine check_names(self, names, error)
      class(group_type), intent(in) :: self
      !> Names of its variables
      character(len=*), intent(in) :: names(:)
      !> Names those that are not known; the first says which there are
      type(error_type), allocatable, intent(out) :: error

      type(problems_type) :: problems
      character(len=:), allocatable :: allowed, line
      integer :: i

      if (.not. allocated(self%variables)) return
      do i = 1, size(self%variables)
         if (any(self%variables(i)%name == names)) cycle
         allowed = trim(meant(self%variables(i)%name, names))
         if (problems%count == 0) call say_allowed(self%variables(i)%name, names, '--template', allowed)
         ! Not by in_line, which looks for the name among all of them
         line = ' (line '//to_text(self%variables(i)%line)//')'
         call raise_input(error, self%place()//': '//self%variables(i)%name//line//': no such variable'//allowed, &
            & unknown_name, self%variables(i)%name, self%place()//line)
         call problems%take(error)
      end do
      call problems%raise(error)
   end subroutine check_names

   !> Refuse the value of a variable: 'file: &group: name = value: what is allowed (line 7)'
   subroutine refuse(self, name, allowed, code, error)
      class(group_type), intent(in) :: self
      !> Name of a variable that was given
      character(len=*), intent(in) :: name
      !> What is allowed
      character(len=*), intent(in) :: allowed
      !> What is wrong, one of error_codes
      character(len=*), intent(in) :: code
      !> The error
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: typed
      integer :: i, j

      i = position(self, name)
      typed = shown(self%variables(i)%values(1)%typed)
      do j = 2, min(size(self%variables(i)%values), 6)
         typed = typed//','
         if (.not. self%variables(i)%values(j)%touches) typed = typed//' '
         typed = typed//shown(self%variables(i)%values(j)%typed)
      end do
      if (size(self%variables(i)%values) > 6) typed = typed//', ...'
      call raise_input(error, name//' = '//typed//': '//allowed, code, name)
      call self%locate(error)
   end subroutine refuse

   !> Find the one value of a variable that takes one
   subroutine single(self, name, found, value, error)
      class(group_type), intent(in) :: self
      !> Name of the variable
      character(len=*), intent(in) :: name
      !> It was given
      logical, intent(out) :: found
      type(value_type), intent(out) :: value
      !> It was given several values
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      i = position(self, name)
      found = i > 0
      if (.not. found) return
      associate (values => self%variables(i)%values)
         value = values(1)
         if (size(values) == 1) return
         if (size(values) == 2 .and. split_number(values(1), values(2))) then
            call self%refuse(name, 'must be one number; a decimal point is needed: '// &
               & values(1)%text//'.'//values(2)%text, not_a_number, error)
         else if (size(values) == 2 .and. is_unit(values(1), values(2))) then
            call self%refuse(name, 'must be a number without a unit', not_a_number, error)
         else if (values(2)%line > values(1)%line) then
            call self%refuse(name, 'must be one value, not '//to_text(size(values))//'; is an = missing in line '// &
               & to_text(values(2)%line)//'?', wrong_length, error)
         else
            call self%refuse(name, 'must be one value, not '//to_text(size(values)), wrong_length, error)
         end if
      end associate
   end subroutine single

   !> Do two values look like one number that was typed with a decimal comma?
   pure function split_number(first, second)
      !> The text before the comma
      type(value_type), intent(in) :: first
      !> The text after it
      type(value_type), intent(in) :: second
      !> Both are whole numbers without quotes, the second one unsigned; it may have an exponent
      logical :: split_number

      integer :: last

      last = scan(second%text, 'eEdD') - 1
      if (last < 0) last = len(second%text)
      split_number = .not. (first%quoted .or. second%quoted) .and. verify(first%text, figures//'+-') == 0 &
         & .and. last > 0 .and. verify(second%text(:last), figures) == 0
   end function split_number

   !> Which values of a list may be one number that was typed with a decimal comma: `2,5` or `2,5, 7,5`. Where three values
   !> have no blank between them, as in `1,2,3`, commas separate values
   pure integer function split_in_list(values) result(first)
      type(value_type), intent(in) :: values(:)

      integer :: i

      first = 0
      do i = 1, size(values) - 1
         if (.not. values(i + 1)%touches) cycle
         if (values(i)%touches) then
            first = 0
            return
         end if
         if (first == 0 .and. split_number(values(i), values(i + 1))) first = i
      end do
   end function split_in_list

   !> Does a second value look like the unit of the first?
   pure logical function is_unit(first, second)
      type(value_type), intent(in) :: first, second

      real(wp) :: number

      call to_real(first, number, is_unit)
      is_unit = is_unit .and. .not. second%quoted .and. second%line == first%line .and. scan(second%text(1:1), letters//'%') == 1
   end function is_unit

   !> Take a text
   subroutine get_text(self, name, value, error, of_number)
      class(group_type), intent(in) :: self
      !> Name of the variable
      character(len=*), intent(in) :: name
      !> Its value; left as it is when the variable was not given
      character(len=:), allocatable, intent(inout) :: value
      !> Not one text in quotes
      type(error_type), allocatable, intent(out) :: error
      !> Name of the variable that a number belongs to; empty: there is none
      character(len=*), intent(in) :: of_number

      type(value_type) :: found
      real(wp) :: number
      logical :: given, is_number

      call single(self, name, given, found, error)
      if (allocated(error) .or. .not. given) return
      call to_real(found, number, is_number)
      if (is_number .and. len(of_number) > 0) then
         call self%refuse(name, 'must be text in quotes; a number is given as '//of_number//' = '//found%text, not_a_string, &
            & error)
      else if (.not. found%quoted) then
         call self%refuse(name, 'must be text in quotes, such as '''//found%text//'''', not_a_string, error)
      else if (len_trim(name_problem(found%text)) > 0) then
         call self%refuse(name, trim(name_problem(found%text)), not_a_string, error)
      else
         value = found%text
      end if
   end subroutine get_text

   !> Take a list of words
   subroutine get_words(self, name, value, error)
      class(group_type), intent(in) :: self
      !> Name of the variable
      character(len=*), intent(in) :: name
      !> Its words, with a comma between two; left as it is when the variable was not given
      character(len=:), allocatable, intent(inout) :: value
      !> One of them is not in quotes
      type(error_type), allocatable, intent(out) :: error

      integer :: i, j

      i = position(self, name)
      if (i == 0) return
      value = ''
      associate (given => self%variables(i)%values)
         do j = 1, size(given)
            if (.not. given(j)%quoted) then
               call self%refuse(name, 'must be text in quotes, such as '''//given(j)%text//'''', not_a_string, error)
               return
            end if
            value = value//trim(merge(',', ' ', j > 1))//given(j)%text
         end do
      end associate
   end subroutine get_words

   !> Take a real number
   subroutine get_real(self, name, value, error)
      class(group_type), intent(in) :: self
      !> Name of the variable
      character(len=*), intent(in) :: name
      !> Its value; left as it is when the variable was not given
      real(wp), intent(inout) :: value
      !> Not one number
      type(error_type), allocatable, intent(out) :: error

      type(value_type) :: found
      real(wp) :: number
      logical :: given, ok

      call single(self, name, given, found, error)
      if (allocated(error) .or. .not. given) return
      call to_real(found, number, ok)
      if (ok) then
         value = number
      else
         call self%refuse(name, trim(number_problem(found)), not_a_number, error)
      end if
   end subroutine get_real

   !> Take an integer
   subroutine get_integer(self, name, value, error)
      class(group_type), intent(in) :: self
      !> Name of the variable
      character(len=*), intent(in) :: name
      !> Its value; left as it is when the variable was not given
      integer, intent(inout) :: value
      !> Not one whole number
      type(error_type), allocatable, intent(out) :: error

      type(value_type) :: found
      integer :: number
      logical :: given, ok

      call single(self, name, given, found, error)
      if (allocated(error) .or. .not. given) return
      call parse_integer(found%text, number, ok)
      if (ok .and. .not. found%quoted) then
         value = number
      else if (ok) then
         call self%refuse(name, 'must be an integer without quotes', not_an_integer, error)
      else if (verify(found%text, figures//'+-') == 0) then
         call self%refuse(name, 'must be an integer of at most '//to_text(huge(number)), not_an_integer, error)
      else
         call self%refuse(name, 'must be an integer', not_an_integer, error)
      end if
   end subroutine get_integer

   !> Take a list of real numbers
   subroutine get_reals(self, name, values, error)
      class(group_type), intent(in) :: self
      !> Name of the variable
      character(len=*), intent(in) :: name
      !> Its values; left as they are when the variable was not given
      real(wp), allocatable, intent(inout) :: values(:)
      !> A value that is not a number
      type(error_type), allocatable, intent(out) :: error

      real(wp), allocatable :: numbers(:)
      logical :: ok
      integer :: i, j

      i = position(self, name)
      if (i == 0) return
      associate (given => self%variables(i)%values)
         allocate (numbers(size(given)))
         do j = 1, size(given)
            call to_real(given(j), numbers(j), ok)
            if (.not. ok) then
               call raise_input(error, self%place()//': '//name//': value '//to_text(j)//' = '//given(j)%typed// &
                  & ': '//trim(number_problem(given(j)))//' (line '//to_text(given(j)%line)//')', not_a_number, name, &
                  & self%place()//' (line '//to_text(given(j)%line)//')')
               return
            end if
            if (j == 1) cycle
            if (given(j - 1)%text == '0' .and. given(j)%touches .and. split_number(given(j - 1), given(j))) then
               call self%refuse(name, 'a decimal point is needed, such as 0.'//given(j)%text, not_a_number, error)
               return
            end if
         end do
         j = split_in_list(given)
         if (j > 0) then
            call self%refuse(name, 'a decimal comma, or several values? Write '//given(j)%text//'.'//given(j + 1)%text// &
               & ', or '//given(j)%text//', '//given(j + 1)%text//' with a blank after the comma', not_a_number, error)
            return
         end if
      end associate
      call move_alloc(numbers, values)
   end subroutine get_reals

   !> Take a yes or no, in the words that Fortran's namelists have for it
   subroutine get_logical(self, name, value, error)
      class(group_type), intent(in) :: self
      !> Name of the variable
      character(len=*), intent(in) :: name
      !> Its value; left as it is when the variable was not given
      logical, intent(inout) :: value
      !> Neither true nor false
      type(error_type), allocatable, intent(out) :: error

      character(len=7), parameter :: yes(4) = [character(len=7) :: '.true.', '.t.', 'true', 't']
      character(len=7), parameter :: no(4) = [character(len=7) :: '.false.', '.f.', 'false', 'f']
      type(value_type) :: found
      logical :: given

      call single(self, name, given, found, error)
      if (allocated(error) .or. .not. given) return
      if (found%quoted .or. .not. any(lower(found%text) == [yes, no])) then
         call self%refuse(name, 'must be .true. or .false.', not_a_flag, error)
      else
         value = any(lower(found%text) == yes)
      end if
   end subroutine get_logical

   !> The number that a value is
   pure subroutine to_real(value, number, ok)
      type(value_type), intent(in) :: value
      !> Its number
      real(wp), intent(out) :: number
      !> It is one finite number without quotes
      logical, intent(out) :: ok

      call parse_real(value%text, number, ok)
      ok = ok .and. .not. value%quoted
   end subroutine to_real

   !> What to say of a value that should be a number
   pure function number_problem(value) result(allowed)
      type(value_type), intent(in) :: value
      !> What is allowed, filled up with blanks
      character(len=80) :: allowed

      real(wp) :: number
      logical :: ok

      allowed = 'must be a number, such as 0.25'
      call parse_real(value%text, number, ok)
      if (ok) then
         allowed = 'must be a number without quotes'
      else if (index(value%text, ';') > 0) then
         allowed = 'must be a number: a comma separates values, a point decimals, as in 0.2, 0.4'
      else if (index(value%text, ':') > 0 .or. index(value%text, 'linspace') > 0 .or. index(value%text, 'arange') > 0) then
         allowed = 'must be a number; first, last and count give equally spaced levels'
      else if (scan(value%text(1:1), '[({') == 1) then
         allowed = 'must be a number: a list has no brackets, as in 0.2, 0.4'
      else if (index(value%text, '%') > 0) then
         allowed = 'must be a number without a per cent sign, such as 0.25 for 25 %'
      else if (scan(value%text(1:1), figures//'+-.') == 1 .and. scan(value%text, letters) > 0 .and. &
         & scan(value%text, 'eEdD') == 0) then
         allowed = 'must be a number without a unit, such as 0.25'
      else if (.not. value%quoted .and. scan(value%text(1:1), figures//'+-.') == 1 &
         & .and. verify(value%text, figures//'+-.eEdD') == 0 .and. scan(value%text, figures) > 0 &
         & .and. scan(value%text, 'eEdD') > 0) then
         allowed = 'must be a number that the computer can hold, such as 1.5e3'
      end if
   end function number_problem

end module dondolo_case_namelist_group
