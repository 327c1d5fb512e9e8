!> Settings: the values that the properties of a table have, where they have one.
module dondolo_settings
   use dondolo_error, only : problems_type
   use dondolo_kinds, only : wp
   use dondolo_plain, only : name_problem, shown
   use dondolo_property, only : check_number, check_word, find_property, has_owner, is_integer, is_list, is_real, &
      & is_text, is_words, name_length, number_of_choices, number_of_words, property_type
   use dondolo_text, only : join, lower, to_text
   implicit none
   private

   public :: settings_type, group_settings_type, new_settings

   !> A list of numbers
   type :: list_type
      !> The numbers
      real(wp), allocatable :: values(:)
   end type list_type

   !> A text
   type :: word_type
      !> The text; not allocated: the property is a number, or has no value
      character(len=:), allocatable :: text
   end type word_type

   !> Values of the properties of a table, which an extension of this type names
   type, abstract :: settings_type
      private
      !> Has a property a value?
      logical, allocatable :: known(:)
      !> Numbers; 1 for true
      real(wp), allocatable :: numbers(:)
      !> Texts
      type(word_type), allocatable :: words(:)
      !> Lists; not allocated where there is none
      type(list_type), allocatable :: lists(:)
      !> The first name that was set and stands in no row of the table
      character(len=:), allocatable :: unknown
   contains
      !> The table
      procedure(table_interface), deferred :: get_table
      !> Place of a property in it
      procedure(find_interface), deferred :: find
      !> Has a property a value?
      procedure :: has
      !> Has any of some properties a value?
      procedure :: gives
      !> A number; 0 where there is none
      procedure :: number
      !> Yes or no
      procedure :: holds
      !> A text; empty where there is none
      procedure :: word
      !> Has a property a text for a value?
      procedure :: has_word
      !> A list of numbers; empty where there is none
      procedure :: list
      !> Set a value
      generic :: set => set_number, set_integer, set_word, set_logical, set_list
      procedure, private :: set_number, set_integer, set_word, set_logical, set_list
      !> How many values each property has
      procedure :: lengths
      !> Take a value away
      procedure :: clear
      !> Give properties without a value their defaults
      procedure :: fill
      !> Check what is there against the table
      procedure :: check
      procedure, private :: place, prepare, make_room
   end type settings_type

   abstract interface
      !> The table of properties
      subroutine table_interface(self, table)
         import :: property_type, settings_type
         class(settings_type), intent(in) :: self
         !> Their table, which stays as it is
         type(property_type), pointer, intent(out) :: table(:)
      end subroutine table_interface

      !> Place of a property in the table, 0 if it has none of this name
      pure integer function find_interface(self, name)
         import :: settings_type
         class(settings_type), intent(in) :: self
         !> Name of the property, in lower case
         character(len=*), intent(in) :: name
      end function find_interface
   end interface

   !> Settings of a group of a namelist
   type, extends(settings_type) :: group_settings_type
      private
      !> Their table
      type(property_type), pointer :: rows(:) => null()
   contains
      procedure :: get_table => get_group_table
      procedure :: find => find_in_group
   end type group_settings_type

contains

   !> Settings without a value
   subroutine new_settings(settings, table)
      type(group_settings_type), intent(out) :: settings
      !> Their table
      type(property_type), target, intent(in) :: table(:)

      settings%rows => table
   end subroutine new_settings

   !> The table of the settings of a group
   subroutine get_group_table(self, table)
      class(group_settings_type), intent(in) :: self
      !> Their table
      type(property_type), pointer, intent(out) :: table(:)

      table => self%rows
   end subroutine get_group_table

   !> Place of a property in the table of a group
   pure integer function find_in_group(self, name) result(at)
      class(group_settings_type), intent(in) :: self
      !> Name of the property, in lower case
      character(len=*), intent(in) :: name

      at = find_property(self%rows, name)
   end function find_in_group

   !> Place of a property that has a value
   pure integer function place(self, name)
      class(settings_type), intent(in) :: self
      !> Name of the property, in lower case
      character(len=*), intent(in) :: name

      place = 0
      if (.not. allocated(self%known)) return
      place = self%find(name)
      if (place == 0) return
      if (.not. self%known(place)) place = 0
   end function place

   !> Has a property a value?
   pure logical function has(self, name)
      class(settings_type), intent(in) :: self
      !> Name of the property, in lower case
      character(len=*), intent(in) :: name

      has = self%place(name) > 0
   end function has

   !> Has any of some properties a value?
   pure logical function gives(self, asked)
      class(settings_type), intent(in) :: self
      !> Which properties of the table
      logical, intent(in) :: asked(:)

      gives = .false.
      if (allocated(self%known)) gives = any(self%known .and. asked)
   end function gives

   !> How many values each property has: those of a list, else 1 or 0
   pure function lengths(self)
      class(settings_type), intent(in) :: self
      !> Their numbers, in the order of the table; none if nothing has a value
      integer, allocatable :: lengths(:)

      integer :: i

      if (.not. allocated(self%known)) then
         allocate (lengths(0))
         return
      end if
      lengths = merge(1, 0, self%known)
      do i = 1, size(lengths)
         if (lengths(i) == 0) cycle
         if (is_listed(self, i)) lengths(i) = size(self%lists(i)%values)
         if (allocated(self%words(i)%text)) lengths(i) = max(1, number_of_words(self%words(i)%text))
      end do
   end function lengths

   !> A number
   pure real(wp) function number(self, name)
      class(settings_type), intent(in) :: self
      !> Name of the property, in lower case
      character(len=*), intent(in) :: name

      integer :: i

      number = 0.0_wp
      i = self%place(name)
      if (i > 0) number = self%numbers(i)
   end function number

   !> Yes or no
   pure logical function holds(self, name)
      class(settings_type), intent(in) :: self
      !> Name of the property, in lower case
      character(len=*), intent(in) :: name

      holds = self%number(name) > 0.0_wp
   end function holds

   !> Length of a text
   pure integer function word_length(self, name)
      class(settings_type), intent(in) :: self
      !> Name of the property, in lower case
      character(len=*), intent(in) :: name

      integer :: i

      word_length = 0
      i = self%place(name)
      if (i == 0) return
      if (allocated(self%words(i)%text)) word_length = len(self%words(i)%text)
   end function word_length

   !> A text
   pure function word(self, name)
      class(settings_type), intent(in) :: self
      !> Name of the property, in lower case
      character(len=*), intent(in) :: name
      !> Text; empty where there is none
      character(len=word_length(self, name)) :: word

      if (len(word) > 0) word = self%words(self%place(name))%text
   end function word

   !> Has a property a text for a value?
   pure logical function has_word(self, name)
      class(settings_type), intent(in) :: self
      !> Name of the property, in lower case
      character(len=*), intent(in) :: name

      integer :: i

      has_word = .false.
      i = self%place(name)
      if (i > 0) has_word = allocated(self%words(i)%text)
   end function has_word

   !> A list of numbers
   pure function list(self, name)
      class(settings_type), intent(in) :: self
      !> Name of the property, in lower case
      character(len=*), intent(in) :: name
      !> Its numbers; none where there is no value
      real(wp), allocatable :: list(:)

      integer :: i

      i = self%place(name)
      if (i > 0) list = self%lists(i)%values
      if (i == 0) allocate (list(0))
   end function list

   !> Make room, and note a name that is not there
   subroutine prepare(self, name, at)
      class(settings_type), intent(inout) :: self
      !> Name of the property
      character(len=*), intent(in) :: name
      !> Its place, 0 if there is none
      integer, intent(out) :: at

      at = self%find(name)
      if (at == 0) then
         if (.not. allocated(self%unknown)) self%unknown = name
         return
      end if
      call self%make_room()
      self%known(at) = .true.
   end subroutine prepare

   !> Make room for the values of all properties, where that was not done
   subroutine make_room(self)
      class(settings_type), intent(inout) :: self

      type(property_type), pointer :: table(:)

      if (allocated(self%known)) return
      call self%get_table(table)
      allocate (self%known(size(table)), source=.false.)
      allocate (self%numbers(size(table)), source=0.0_wp)
      allocate (self%words(size(table)))
   end subroutine make_room

   !> Set a number
   subroutine set_number(self, name, value)
      class(settings_type), intent(inout) :: self
      !> Name of the property, in lower case
      character(len=*), intent(in) :: name
      !> Value
      real(wp), intent(in) :: value

      integer :: at

      call self%prepare(name, at)
      if (at > 0) self%numbers(at) = value
   end subroutine set_number

   !> Set a whole number
   subroutine set_integer(self, name, value)
      class(settings_type), intent(inout) :: self
      !> Name of the property, in lower case
      character(len=*), intent(in) :: name
      !> Value
      integer, intent(in) :: value

      call self%set_number(name, real(value, wp))
   end subroutine set_integer

   !> Set yes or no
   subroutine set_logical(self, name, value)
      class(settings_type), intent(inout) :: self
      !> Name of the property, in lower case
      character(len=*), intent(in) :: name
      !> Value
      logical, intent(in) :: value

      call self%set_number(name, merge(1.0_wp, 0.0_wp, value))
   end subroutine set_logical

   !> Set a text; one of several choices is the same in upper and lower case and without blanks at its end
   subroutine set_word(self, name, value)
      class(settings_type), intent(inout) :: self
      !> Name of the property, in lower case
      character(len=*), intent(in) :: name
      !> Value
      character(len=*), intent(in) :: value

      type(property_type), pointer :: table(:)
      integer :: at, i

      call self%prepare(name, at)
      if (at == 0) return
      call self%get_table(table)
      self%words(at)%text = value
      if (len_trim(table(at)%choices(1)) == 0) return
      self%words(at)%text = lower(trim(value))
      associate (choices => table(at)%choices)
         if (any(choices == self%words(at)%text)) return
         do i = 1, number_of_choices(choices)
            if (lower(choices(i)) == self%words(at)%text) self%words(at)%text = trim(choices(i))
         end do
      end associate
   end subroutine set_word

   !> Set a list of numbers
   subroutine set_list(self, name, values)
      class(settings_type), intent(inout) :: self
      !> Name of the property, in lower case
      character(len=*), intent(in) :: name
      !> Values
      real(wp), intent(in) :: values(:)

      integer :: at

      call self%prepare(name, at)
      if (at == 0) return
      if (.not. allocated(self%lists)) allocate (self%lists(size(self%known)))
      self%lists(at)%values = values
   end subroutine set_list

   !> Take a value away
   subroutine clear(self, name)
      class(settings_type), intent(inout) :: self
      !> Name of the property, in lower case
      character(len=*), intent(in) :: name

      integer :: at

      at = self%place(name)
      if (at == 0) return
      self%known(at) = .false.
      if (allocated(self%words(at)%text)) deallocate (self%words(at)%text)
      if (is_listed(self, at)) deallocate (self%lists(at)%values)
   end subroutine clear

   !> Give properties without a value their defaults
   subroutine fill(self, owner)
      class(settings_type), intent(inout) :: self
      !> Mechanism or task: only what it has; all if absent
      character(len=*), intent(in), optional :: owner

      type(property_type), pointer :: table(:)
      integer :: i

      call self%get_table(table)
      call self%make_room()
      do i = 1, size(table)
         associate (property => table(i))
            if (property%required .or. property%optional .or. self%known(i)) cycle
            if (present(owner)) then
               if (.not. has_owner(property, owner)) cycle
            end if
            select case (property%kind)
            case (is_text, is_words)
               self%words(i)%text = trim(property%word)
            case (is_list)
               call self%set(property%name, [real(wp) ::])
            case default
               self%numbers(i) = property%default
            end select
            self%known(i) = .true.
         end associate
      end do
   end subroutine fill

   !> Length of names as a choice
   pure integer function one_of_length(names)
      !> Names, empty ones after them
      character(len=*), intent(in) :: names(:)

      one_of_length = sum(len_trim(names)) + 6*number_of_choices(names) - 4
   end function one_of_length

   !> Names as a choice: 'a' or 'b'
   pure function one_of(names) result(text)
      !> Names, empty ones after them
      character(len=*), intent(in) :: names(:)
      !> Text
      character(len=one_of_length(names)) :: text

      integer :: i, length

      length = 0
      do i = 1, number_of_choices(names)
         if (i > 1) text(length + 1:) = ' or '
         if (i > 1) length = length + 4
         text(length + 1:) = ''''//trim(names(i))//''''
         length = length + len_trim(names(i)) + 2
      end do
   end function one_of

   !> Is a value a list of numbers?
   pure logical function is_listed(self, at)
      class(settings_type), intent(in) :: self
      !> Place of a property that has a value
      integer, intent(in) :: at

      is_listed = allocated(self%lists)
      if (is_listed) is_listed = allocated(self%lists(at)%values)
   end function is_listed

   !> Length of a value as it stands in messages
   pure integer function value_length(self, at)
      class(settings_type), intent(in) :: self
      !> Place of a property that has a value
      integer, intent(in) :: at

      integer :: i

      if (allocated(self%words(at)%text)) then
         value_length = len(shown(self%words(at)%text)) + 2
      else if (is_listed(self, at)) then
         value_length = sum([(len(to_text(self%lists(at)%values(i))) + 2, i=1, size(self%lists(at)%values))]) - 2
      else
         value_length = len(to_text(self%numbers(at)))
      end if
   end function value_length

   !> A value as it stands in messages
   pure function value_text(self, at) result(text)
      class(settings_type), intent(in) :: self
      !> Place of a property that has a value
      integer, intent(in) :: at
      !> Text, in quotes if it is one
      character(len=value_length(self, at)) :: text

      integer :: i, length

      if (allocated(self%words(at)%text)) then
         text = ''''//shown(self%words(at)%text)//''''
      else if (is_listed(self, at)) then
         length = 0
         do i = 1, size(self%lists(at)%values)
            if (i > 1) text(length + 1:) = ', '
            if (i > 1) length = length + 2
            text(length + 1:) = to_text(self%lists(at)%values(i))
            length = length + len(to_text(self%lists(at)%values(i)))
         end do
      else
         text = to_text(self%numbers(at))
      end if
   end function value_text

   !> Check what is there against the table: `name = value: what is allowed`
   subroutine check(self, problems, label, owner)
      class(settings_type), intent(in) :: self
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> Property that says what has properties, for messages: 'mechanism'
      character(len=*), intent(in), optional :: label
      !> Its value: what has only other properties is refused; empty: nothing is said of them
      character(len=*), intent(in), optional :: owner

      type(property_type), pointer :: table(:)
      character(len=name_length), allocatable :: names(:)
      character(len=:), allocatable :: allowed
      integer :: i, k

      call self%get_table(table)
      if (allocated(self%unknown)) then
         names = table%name
         call problems%note(self%unknown//': no such variable; there are '//join(names))
      end if
      do i = 1, size(table)
         associate (property => table(i))
            if (present(owner)) then
               if (.not. has_owner(property, owner)) then
                  if (len(owner) > 0 .and. is_known(i)) call problems%note(trim(property%name)//' = '// &
                     & value_text(self, i)//': only for '//label//' = '//one_of(property%owners))
                  cycle
               end if
            end if
            if (.not. is_known(i)) then
               if (.not. property%required) cycle
               allowed = 'must be given'
               if (len_trim(property%names) > 0) allowed = allowed//', '//trim(property%names)
               if (len_trim(property%choices(1)) > 0) allowed = allowed//', one of '// &
                  & join(property%choices(:number_of_choices(property%choices)))
               call problems%note(trim(property%name)//': '//allowed)
               cycle
            end if
            select case (property%kind)
            case (is_text, is_words)
               call check_word(property, self%words(i)%text, allowed)
               if (len_trim(name_problem(self%words(i)%text)) > 0) allowed = trim(name_problem(self%words(i)%text))
            case (is_real, is_integer)
               call check_number(property, self%numbers(i), allowed)
            case (is_list)
               if (allocated(allowed)) deallocate (allowed)
               do k = 1, size(self%lists(i)%values)
                  if (.not. allocated(allowed)) call check_number(property, self%lists(i)%values(k), allowed)
               end do
            case default
               if (allocated(allowed)) deallocate (allowed)
            end select
            if (allocated(allowed)) call problems%note(trim(property%name)//' = '//value_text(self, i)//': '//allowed)
         end associate
      end do

   contains

      !> Has a property a value?
      pure logical function is_known(at)
         !> Its place
         integer, intent(in) :: at

         is_known = allocated(self%known)
         if (is_known) is_known = self%known(at)
      end function is_known

   end subroutine check

end module dondolo_settings
