!> Settings: the values that the properties of a table have, where they have one.
module dondolo_base_settings
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : find_property, has_owner, is_list, is_text, is_words, number_of_choices, number_of_words, &
      & property_type
   use dondolo_base_text, only : lower
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
      !> The first name that was set and that no row of the table has
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
      !> Substitute of a number that is not given beside the others of its kind
      procedure :: absent
      !> Range of the values in a row of the table
      procedure :: find_range
      !> Set a value
      generic :: set => set_number, set_integer, set_word, set_logical, set_list
      procedure, private :: set_number, set_integer, set_word, set_logical, set_list
      !> Which properties have a value
      procedure :: given
      !> How many values each property has
      procedure :: lengths
      !> Take a value away
      procedure :: clear
      !> Give properties without a value their defaults
      procedure :: fill
      !> The first name that was set and that no row of the table has
      procedure :: get_unknown
      !> Is the value of a property a list?
      procedure :: has_list
      procedure, private :: place, prepare, make_room, is_listed
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

#ifdef DONDOLO_CHECKED
      ! A look-up of a name that no row has would silently find nothing, so that tests end here.
      if (self%find(name) == 0) error stop 'dondolo: there are no settings '''//trim(name)//''''
#endif
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

   !> Which properties have a value
   pure subroutine given(self, properties)
      class(settings_type), intent(in) :: self
      !> Whether each one has, in the order of the table
      logical, intent(out) :: properties(:)

      properties = .false.
      if (allocated(self%known)) properties = self%known
   end subroutine given

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
         if (self%is_listed(i)) lengths(i) = size(self%lists(i)%values)
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

   !> The first name that was set and that no row of the table has
   pure subroutine get_unknown(self, name)
      class(settings_type), intent(in) :: self
      !> It; not allocated: there is none
      character(len=:), allocatable, intent(out) :: name

      if (allocated(self%unknown)) name = self%unknown
   end subroutine get_unknown

   !> Is the value of a property a list?
   pure logical function has_list(self, name)
      class(settings_type), intent(in) :: self
      !> Name of the property, in lower case
      character(len=*), intent(in) :: name

      integer :: i

      has_list = .false.
      i = self%place(name)
      if (i > 0) has_list = self%is_listed(i)
   end function has_list

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

   !> Substitute of a number that is not given beside the others of its kind
   real(wp) function absent(self, name)
      class(settings_type), intent(in) :: self
      !> Name of the property, in lower case
      character(len=*), intent(in) :: name

      type(property_type), pointer :: table(:)

      call self%get_table(table)
      absent = table(self%find(name))%absent
   end function absent

   !> Range of the values in a row of the table: of a number, or of a list
   pure subroutine find_range(self, row, least, most)
      class(settings_type), intent(in) :: self
      !> Row
      integer, intent(in) :: row
      !> Least positive value, huge() where there is none; largest value, 0 where there is none
      real(wp), intent(out) :: least, most

      least = huge(least)
      most = 0.0_wp
      if (.not. allocated(self%known)) return
      if (.not. self%known(row)) return
      if (self%is_listed(row)) then
         least = minval(self%lists(row)%values, mask=self%lists(row)%values > 0.0_wp)
         most = maxval(self%lists(row)%values)
      else
         most = self%numbers(row)
         if (most > 0.0_wp) least = most
      end if
   end subroutine find_range

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

   !> Set a number; of a list it is the only value
   subroutine set_number(self, name, value)
      class(settings_type), intent(inout) :: self
      !> Name of the property, in lower case
      character(len=*), intent(in) :: name
      !> Value
      real(wp), intent(in) :: value

      type(property_type), pointer :: table(:)
      integer :: at

      call self%prepare(name, at)
      if (at == 0) return
      call self%get_table(table)
      if (table(at)%kind == is_list) then
         call self%set_list(name, [value])
      else
         self%numbers(at) = value
      end if
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
      if (self%is_listed(at)) deallocate (self%lists(at)%values)
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

   !> Is a value a list of numbers?
   pure logical function is_listed(self, at)
      class(settings_type), intent(in) :: self
      !> Place of a property that has a value
      integer, intent(in) :: at

      is_listed = allocated(self%lists)
      if (is_listed) is_listed = allocated(self%lists(at)%values)
   end function is_listed

end module dondolo_base_settings
