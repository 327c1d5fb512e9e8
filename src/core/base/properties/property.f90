!> A property: one parameter of a wall, of the solver or of a task, with all that is known of it.
!>
!> Tables of properties (dondolo_wall_properties, dondolo_motion_solver, ...) are the one home of names, units, ranges, defaults
!> and meanings: readers of namelists and populations, messages, templates, tables of results, the identity of a
!> checkpoint and the Python package derive from them.
module dondolo_base_property
   use dondolo_base_kinds, only : wp
   use dondolo_base_odd_character, only : odd_character
   use dondolo_base_text, only : join, lower, to_text
   use dondolo_base_unit_hint, only : hint_length, unit_hint
   implicit none
   private

   public :: property_type, find_name, find_property, has_owner, number_of_choices, check_number, check_word
   public :: column_name, default_text, describe_property, hint_of
   public :: is_many, item_name, find_item, number_of_words, word_of
   public :: is_real, is_integer, is_text, is_logical, is_list, is_number_or_name, is_words
   public :: name_length, choices_length, most_choices, blank, no_limit

   !> Kinds of values: a real number, a whole number, a text, yes or no, a list of real numbers, a whole number or a name,
   !> a list of choices, which is kept as a text with a comma between two
   integer, parameter :: is_real = 1, is_integer = 2, is_text = 3, is_logical = 4, is_list = 5, is_number_or_name = 6, &
      & is_words = 7

   !> Length of a name
   integer, parameter :: name_length = 32

   !> Length of a choice, and how many a property can have
   integer, parameter :: choices_length = 16, most_choices = 8

   !> What fills a list of choices up: `reshape(names, [most_choices], pad=blank)`
   character(len=choices_length), parameter :: blank(1) = ''

   !> A limit that no number reaches
   real(wp), parameter :: no_limit = huge(1.0_wp)

   !> One property
   type :: property_type
      !> Name, in lower case, as in namelists, in the columns of populations and in Python
      character(len=name_length) :: name = ''
      !> Kind of its value
      integer :: kind = is_real
      !> Unit; empty for a number without one
      character(len=8) :: unit = ''
      !> One sentence: what it is
      character(len=180) :: meaning = ''
      !> What helps to choose it, for templates; empty: nothing more
      character(len=80) :: more = ''
      !> Must it be given?
      logical :: required = .false.
      !> Has it no value where it is not given? Else it has its default
      logical :: optional = .false.
      !> Default of a number; of a logical 1 for true
      real(wp) :: default = 0.0_wp
      !> Substitute of an optional number that is not given beside the others of its kind; no_limit: none
      real(wp) :: absent = no_limit
      !> Default of a text
      character(len=16) :: word = ''
      !> Must it be greater than 0?
      logical :: positive = .false.
      !> Smallest and largest value
      real(wp) :: smallest = -no_limit, largest = no_limit
      !> Must it be less than the largest value, not equal to it?
      logical :: less = .false.
      !> What 0 stands for, where it is no number like the others
      character(len=8) :: zero = ''
      !> Texts that it can be; empty: any
      character(len=choices_length) :: choices(most_choices) = ''
      !> Does what has it check which of its choices it is?
      logical :: checked_by_owner = .false.
      !> What has it, among mechanisms or tasks; empty: all
      character(len=choices_length) :: owners(most_choices) = ''
      !> What a text that must be given names, for messages
      character(len=40) :: names = ''
      !> What can take its place, where one of them must be given, with a comma between two
      character(len=40) :: instead = ''
      !> What a template shows, where it is not the default
      character(len=40) :: example = ''
      !> Column in tables of results, where it is not the name and the unit
      character(len=48) :: column = ''
      !> Does another property take its place when a wall is made of it?
      logical :: replaced = .false.
      !> Does what is computed depend on it? Files that keep intermediate results belong to one set of values
      logical :: changes_results = .true.
      !> Plausible range: values beyond it are most likely given in another unit
      real(wp) :: usual_least = 0.0_wp, usual_most = no_limit
      !> Question where a value is less, or more; empty: which unit it is most likely in (dondolo_base_unit_hint)
      character(len=32) :: if_less = '', if_more = ''
      !> Must a list have a value for each thing? Else one value is that of all
      logical :: one_each = .false.
      !> Optional properties of the same table beside which it cannot be given, with a comma between two; empty: it goes with all
      character(len=64) :: not_with = ''
      !> Why not, and what to do, for messages; empty: they stand for the same thing
      character(len=100) :: because = ''
      !> Value that is as good as none, such as one leaf; no_limit: every value counts
      real(wp) :: neutral = no_limit
   end type property_type

contains

   !> Place of a property in a table, 0 if it has none of this name
   pure integer function find_property(table, name)
      type(property_type), intent(in) :: table(:)
      !> Name in lower case, not empty
      character(len=*), intent(in) :: name

      ! Not by find_name: table%name is not contiguous, so each call would make a copy of all names.
      do find_property = size(table), 1, -1
         if (is_name(table(find_property)%name, name)) return
      end do
   end function find_property

   !> Place of a name among those of a table, 0 if it is none of them
   pure integer function find_name(names, name)
      character(len=*), intent(in) :: names(:)
      !> Name in lower case, not empty
      character(len=*), intent(in) :: name

      do find_name = size(names), 1, -1
         if (is_name(names(find_name), name)) return
      end do
   end function find_name

   !> Is an entry of a table this name? Comparing the first letter settles most cases, many times faster than the whole name.
   pure logical function is_name(entry, name)
      character(len=*), intent(in) :: entry
      !> Name in lower case, not empty
      character(len=*), intent(in) :: name

      is_name = entry(1:1) == name(1:1)
      if (is_name) is_name = entry == name
   end function is_name

   !> Does a mechanism or a task have a property?
   pure logical function has_owner(property, owner)
      type(property_type), intent(in) :: property
      !> Name of the mechanism or the task
      character(len=*), intent(in) :: owner

      integer :: i

      has_owner = len_trim(property%owners(1)) == 0
      if (has_owner .or. len_trim(owner) == 0) return
      do i = 1, number_of_choices(property%owners)
         has_owner = property%owners(i) == owner
         if (has_owner) exit
      end do
   end function has_owner

   !> Is a kind one of several values?
   elemental logical function is_many(kind)
      !> Kind of a property
      integer, intent(in) :: kind

      is_many = kind == is_list .or. kind == is_words
   end function is_many

   !> Name of one value of a list, as the columns of tables have it: load_height is load2_height
   pure function item_name(name, item) result(numbered)
      !> Name of the list
      character(len=*), intent(in) :: name
      !> Number of the value, from 1
      integer, intent(in) :: item
      !> The name with the number behind its first word; blanks after it
      character(len=name_length + 4) :: numbered

      integer :: stem

      stem = scan(name, '_ ') - 1
      if (stem < 0) stem = len(name)
      numbered = name(:stem)//to_text(item)//name(stem + 1:)
   end function item_name

   !> Which value of which list a column holds
   pure subroutine find_item(table, column, at, item)
      type(property_type), intent(in) :: table(:)
      !> Name of the column, in lower case
      character(len=*), intent(in) :: column
      !> Place of the list, 0 if it is none of a list
      integer, intent(out) :: at
      !> Number of the value, from 1
      integer, intent(out) :: item

      character(len=*), parameter :: figures = '0123456789'
      integer :: first, last, stat

      at = 0
      first = scan(column, figures)
      if (first == 0) return
      last = first + verify(column(first:)//' ', figures) - 2
      read (column(first:last), *, iostat=stat) item
      if (stat /= 0 .or. last - first > 3) return
      at = find_property(table, column(:first - 1)//column(last + 1:))
      if (at == 0) return
      if (.not. is_many(table(at)%kind) .or. item < 1) at = 0
   end subroutine find_item

   !> How many words a list of choices or of names has
   pure integer function number_of_words(text)
      !> The list, with commas
      character(len=*), intent(in) :: text

      integer :: i

      number_of_words = 0
      if (len_trim(text) > 0) number_of_words = 1 + count([(iachar(text(i:i)) == iachar(','), i=1, len(text))])
   end function number_of_words

   !> A word of a list of choices or of names; blank beyond the last
   pure function word_of(text, item) result(word)
      !> The list, with commas
      character(len=*), intent(in) :: text
      !> Number of the word, from 1
      integer, intent(in) :: item
      !> The word, blanks after it
      character(len=name_length) :: word

      integer :: first, length, i

      first = 1
      word = ''
      do i = 1, item
         if (first > len(text)) return
         length = index(text(first:)//',', ',') - 1
         if (i == item) word = adjustl(text(first:first + length - 1))
         first = first + length + 1
      end do
   end function word_of

   !> Column of a property in tables of results: its name and its unit
   pure function column_name(property, item) result(column)
      type(property_type), intent(in) :: property
      !> Number of a value of a list
      integer, intent(in), optional :: item
      !> Name of the column, such as density_kg_m3; blanks after it
      character(len=len(property%column)) :: column

      integer :: i

      column = property%column
      if (len_trim(column) > 0) return
      column = property%name
      if (present(item)) column = item_name(trim(property%name), item)
      if (len_trim(property%unit) > 0) column = trim(column)//'_'//lower(property%unit)
      do i = 1, len_trim(column)
         if (any(column(i:i) == ['/', ' '])) column(i:i) = '_'
      end do
   end function column_name

   !> How many texts a property, or its owners, are chosen from
   pure integer function number_of_choices(choices)
      !> Choices or owners
      character(len=*), intent(in) :: choices(:)

      do number_of_choices = 0, size(choices) - 1
         if (choices(number_of_choices + 1)(1:1) == ' ') exit
      end do
   end function number_of_choices

   !> A limit with few characters
   pure function short_limit(limit) result(text)
      !> Limit
      real(wp), intent(in) :: limit
      !> Its text, blanks after it
      character(len=40) :: text

      integer :: zeros

      text = to_text(limit)
      zeros = len_trim(text) - verify(trim(text), '0', back=.true.)
      if (index(text, '.') == 0 .and. zeros > 4) text = text(:len_trim(text) - zeros)//'e'//to_text(zeros)
   end function short_limit

   !> A limit as it stands in messages
   pure function limit_text(limit) result(text)
      !> Limit
      real(wp), intent(in) :: limit
      !> Its shortest text: 1e9 rather than 1000000000
      character(len=len_trim(short_limit(limit))) :: text

      text = short_limit(limit)
   end function limit_text

   !> A property as a line: name, kind, unit, 'required', 'optional' or its default, smallest and largest value,
   !> 'positive' or 'less' where one of them cannot be reached, choices, owners, what can take its place, column (empty
   !> where it has none), meaning, substitute where it is not given, and what it does not go with, with a tab between two;
   !> entries with several names have blanks between
   subroutine describe_property(property, line)
      type(property_type), intent(in) :: property
      !> Its line
      character(len=:), allocatable, intent(out) :: line

      character(len=7), parameter :: kinds(7) = [character(len=7) :: 'real', 'integer', 'text', 'logical', 'list', 'either', &
         & 'words']
      character(len=:), allocatable :: default

      call default_text(property, default)
      line = trim(property%name)
      call add(kinds(property%kind))
      call add(property%unit)
      call add(trim(merge('required', merge('optional', '        ', property%optional), property%required))//default)
      call add(to_text(property%smallest))
      call add(to_text(property%largest))
      call add(trim(merge('positive', merge('less    ', '        ', property%less), property%positive)))
      call add(listed(property%choices))
      call add(listed(property%owners))
      call add(property%instead)
      call add(merge(repeat(' ', len(property%column)), column_name(property), property%replaced))
      call add(property%meaning)
      call add(to_text(property%absent))
      call add(property%not_with)

   contains

      !> Add an entry
      subroutine add(entry)
         !> The entry
         character(len=*), intent(in) :: entry

         line = line//achar(9)//trim(entry)
      end subroutine add

      !> Names with blanks between
      pure function listed(names) result(text)
         !> Names, empty ones after them
         character(len=*), intent(in) :: names(:)
         !> Text
         character(len=(choices_length + 1)*most_choices) :: text

         integer :: i

         text = ''
         do i = 1, number_of_choices(names)
            text = trim(text)//' '//names(i)
         end do
         text = adjustl(text)
      end function listed

   end subroutine describe_property

   !> Default of a property as it stands in a namelist, without the quotes of a text; empty where it has none
   pure subroutine default_text(property, text)
      type(property_type), intent(in) :: property
      !> Text
      character(len=:), allocatable, intent(out) :: text

      text = ''
      if (property%required .or. property%optional) return
      select case (property%kind)
      case (is_text)
         text = trim(property%word)
      case (is_logical)
         text = trim(merge('.true. ', '.false.', property%default > 0.0_wp))
      case (is_list, is_words)
         text = ''
      case (is_integer, is_number_or_name)
         text = to_text(nint(property%default))
      case default
         text = to_text(property%default)
         if (verify(text, '-0123456789') == 0) text = text//'.0'
      end select
   end subroutine default_text

   !> What is allowed of a number, if it is not
   pure subroutine check_number(property, value, allowed)
      type(property_type), intent(in) :: property
      !> Its value
      real(wp), intent(in) :: value
      !> 'must be positive', 'must lie between 0 and 1', ...; not allocated: the value is right
      character(len=:), allocatable, intent(out) :: allowed

      character(len=:), allocatable :: unit

      associate (least => property%smallest, most => property%largest)
         ! What has no range of its own is checked against other properties
         if (.not. (property%positive .or. least > -no_limit .or. most < no_limit)) return
         unit = ''
         if (len_trim(property%unit) > 0) unit = ' '//trim(property%unit)
         if (property%positive .and. .not. value >= tiny(value)) then
            allowed = 'must be positive'
            if (.not. least > 0.0_wp .and. most < no_limit) allowed = allowed//' and at most '//limit_text(most)//unit
         else if (.not. (value >= least .and. (value < most .or. (value <= most .and. .not. property%less)))) then
            if (property%positive .and. .not. least > 0.0_wp) then
               allowed = 'must be positive'
               if (most < no_limit) allowed = allowed//' and at most '//limit_text(most)//unit
            else if (property%less) then
               allowed = 'must be at least '//limit_text(least)//' and less than '//limit_text(most)//unit
            else if (most < no_limit .and. len_trim(property%zero) > 0) then
               allowed = 'must lie between 0 ('//trim(property%zero)//') and '//limit_text(most)//unit
            else if (most < no_limit) then
               allowed = 'must lie between '//limit_text(least)//' and '//limit_text(most)//unit
            else
               allowed = 'must be at least '//limit_text(least)//unit
            end if
         end if
      end associate
      if (.not. allocated(allowed)) return
      if (len_trim(hint_of(property, value)) > 0) allowed = allowed//': '//trim(hint_of(property, value))
   end subroutine check_number

   !> The question to ask of a value beyond its range: 'is it in millimetres?'
   pure function hint_of(property, value) result(text)
      type(property_type), intent(in) :: property
      !> A value that is refused, or beyond the plausible range
      real(wp), intent(in) :: value
      !> The question, blanks after it; empty: nothing makes the value plausible
      character(len=hint_length) :: text

      real(wp) :: low, high

      text = ''
      low = max(property%smallest, property%usual_least, 0.0_wp)
      high = min(property%largest, property%usual_most)
      if (.not. (value > 0.0_wp .and. value <= huge(value)) .or. (value >= low .and. value <= high)) return
      text = property%if_more
      if (value < low) text = property%if_less
      if (len_trim(text) > 0 .or. all(property%kind /= [is_real, is_list])) return
      text = unit_hint(property%unit, value, low, high, usual_value(property))
   end function hint_of

   !> A usual value of a property: that of a template, else its default; 0 if it has none
   pure real(wp) function usual_value(property)
      type(property_type), intent(in) :: property

      integer :: stat

      usual_value = property%default
      if (len_trim(property%example) == 0) return
      read (property%example, *, iostat=stat) usual_value
      if (stat /= 0) usual_value = 0.0_wp
   end function usual_value

   !> What is allowed of a text, if it is not
   pure subroutine check_word(property, word, allowed)
      type(property_type), intent(in) :: property
      !> Its value
      character(len=*), intent(in) :: word
      !> 'must be one of ...'; not allocated: the value is right
      character(len=:), allocatable, intent(out) :: allowed

      integer :: count, i

      count = number_of_choices(property%choices)
      if (property%kind == is_words) then
         do i = 1, number_of_words(word)
            if (.not. any(property%choices(:count) == word_of(word, i))) allowed = 'each must be one of '// &
               & join(property%choices(:count))
         end do
      else if (property%required .and. len_trim(word) == 0 .and. len_trim(property%names) > 0) then
         allowed = 'must name '//trim(property%names)
      else if (count > 0 .and. .not. property%checked_by_owner) then
         if (.not. any(property%choices(:count) == word)) allowed = 'must be one of '//join(property%choices(:count))
         if (allocated(allowed) .and. len_trim(odd_character(word)) > 0) allowed = allowed//'; it has '// &
            & trim(odd_character(word))
      end if
   end subroutine check_word

end module dondolo_base_property
