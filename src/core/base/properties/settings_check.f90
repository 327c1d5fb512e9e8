!> The check of settings against their table, and the values as its messages show them.
module dondolo_base_settings_check
   use dondolo_base_error, only : not_a_string, not_a_word, not_an_integer, not_given, not_together, out_of_range, &
      & problems_type, unknown_name
   use dondolo_base_kinds, only : wp
   use dondolo_base_plain, only : name_problem, shown
   use dondolo_base_property, only : check_number, check_word, has_owner, is_integer, is_list, is_real, is_text, is_words, &
      & name_length, no_limit, number_of_choices, number_of_words, property_type, word_of
   use dondolo_base_settings, only : settings_type
   use dondolo_base_spelling, only : say_allowed
   use dondolo_base_text, only : join, to_text
   implicit none
   private

   public :: check_settings

   !> Values of a list that a message shows at most, and what it shows in place of the others
   integer, parameter :: most_shown = 12
   character(len=*), parameter :: more = ', ...'

contains

   !> Check what is there against the table: `name = value: what is allowed`
   subroutine check_settings(settings, problems, label, owner)
      class(settings_type), intent(in) :: settings
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> Property that says what has properties, for messages: 'mechanism'
      character(len=*), intent(in), optional :: label
      !> Its value: what has only other properties is refused; empty: nothing is said of them
      character(len=*), intent(in), optional :: owner

      type(property_type), pointer :: table(:)
      character(len=name_length), allocatable :: names(:)
      character(len=:), allocatable :: allowed, code, unknown, word
      real(wp), allocatable :: list(:)
      logical, allocatable :: given(:)
      integer :: i, k

      call settings%get_table(table)
      allocate (given(size(table)))
      call settings%given(given)
      call settings%get_unknown(unknown)
      if (allocated(unknown)) then
         names = table%name
         call say_allowed(unknown, names, '--template', allowed)
         call problems%note(unknown//': no such variable'//allowed, unknown_name, unknown)
      end if
      do i = 1, size(table)
         associate (property => table(i))
            if (present(owner)) then
               if (.not. has_owner(property, owner)) then
                  if (len(owner) > 0 .and. given(i)) call problems%note(trim(property%name)//' = '// &
                     & value_text(settings, trim(property%name))//': only for '//label//' = '//one_of(property%owners), &
                     & not_together, trim(property%name))
                  cycle
               end if
            end if
            if (.not. given(i)) then
               if (.not. property%required) cycle
               allowed = 'must be given'
               if (len_trim(property%names) > 0) allowed = allowed//', '//trim(property%names)
               if (len_trim(property%choices(1)) > 0) allowed = allowed//', one of '// &
                  & join(property%choices(:number_of_choices(property%choices)))
               call problems%note(trim(property%name)//': '//allowed, not_given, trim(property%name))
               cycle
            end if
            call check_company(property)
            k = 0
            code = out_of_range
            select case (property%kind)
            case (is_text, is_words)
               word = settings%word(trim(property%name))
               code = not_a_word
               call check_word(property, word, allowed)
               if (len_trim(name_problem(word)) > 0) then
                  code = not_a_string
                  allowed = trim(name_problem(word))
               end if
            case (is_real, is_integer)
               call check_number(property, settings%number(trim(property%name)), allowed)
               ! Cells of tables may be any number
               if (property%kind == is_integer .and. .not. allocated(allowed)) then
                  associate (number => settings%number(trim(property%name)))
                     if (abs(number - anint(number)) > 0.0_wp) allowed = 'must be an integer'
                  end associate
                  code = not_an_integer
               end if
            case (is_list)
               if (allocated(allowed)) deallocate (allowed)
               list = settings%list(trim(property%name))
               do k = 1, size(list)
                  call check_number(property, list(k), allowed)
                  if (allocated(allowed)) exit
               end do
            case default
               if (allocated(allowed)) deallocate (allowed)
            end select
            if (.not. allocated(allowed)) cycle
            if (property%kind == is_list .and. k > most_shown) then
               call problems%note(trim(property%name)//' = '//value_text(settings, trim(property%name))//' (value '// &
                  & to_text(k)//' = '//to_text(list(k))//'): '//allowed, code, trim(property%name))
            else
               call problems%note(trim(property%name)//' = '//value_text(settings, trim(property%name))//': '//allowed, &
                  & code, trim(property%name))
            end if
         end associate
      end do

   contains

      !> Check that nothing is given beside a property that excludes it
      subroutine check_company(property)
         !> A property that is given
         type(property_type), intent(in) :: property

         character(len=:), allocatable :: text, other
         integer :: j, at, last

         if (len_trim(property%not_with) == 0) return
         if (.not. counts(property)) return
         text = trim(property%name)
         if (property%kind == is_real .or. property%kind == is_integer) text = text//' = '//value_text(settings, text)
         do j = 1, number_of_words(property%not_with)
            ! Programs that call the library have tables with fewer rows
            at = settings%find(trim(word_of(property%not_with, j)))
            if (at == 0) cycle
            associate (named => table(at))
               if (.not. counts(named)) cycle
               other = trim(named%name)
               if (named%kind == is_real .or. named%kind == is_integer) other = other//' = '//value_text(settings, other)
            end associate
            if (len_trim(property%because) == 0) then
               other = trim(property%not_with)
               last = index(other, ', ', back=.true.)
               if (last > 0) other = other(:last - 1)//' and '//other(last + 2:)
               call problems%note(text//': give either '//trim(property%name)//' or '//other, not_together, trim(property%name))
               return
            end if
            call problems%note(text//': not with '//other//', '//trim(property%because), not_together, trim(property%name))
         end do
      end subroutine check_company

      !> Has a property of this owner a value, other than one that is as good as none?
      logical function counts(property)
         type(property_type), intent(in) :: property

         counts = settings%has(trim(property%name))
         if (present(owner)) counts = counts .and. has_owner(property, owner)
         if (.not. counts .or. .not. property%neutral < no_limit) return
         if (property%kind == is_list) then
            counts = any(abs(settings%list(trim(property%name)) - property%neutral) > 0.0_wp)
         else
            counts = abs(settings%number(trim(property%name)) - property%neutral) > 0.0_wp
         end if
      end function counts

   end subroutine check_settings

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

   !> Length of a value as messages show it
   pure integer function value_length(settings, name)
      class(settings_type), intent(in) :: settings
      !> Name of a property that has a value
      character(len=*), intent(in) :: name

      real(wp), allocatable :: list(:)
      integer :: i

      if (settings%has_word(name)) then
         value_length = len(shown(settings%word(name))) + 2
      else if (settings%has_list(name)) then
         list = settings%list(name)
         value_length = merge(len(more), 0, size(list) > most_shown) - 2
         do i = 1, min(size(list), most_shown)
            value_length = value_length + len(to_text(list(i))) + 2
         end do
      else
         value_length = len(to_text(settings%number(name)))
      end if
   end function value_length

   !> A value as messages show it: of a list the first values
   pure function value_text(settings, name) result(text)
      class(settings_type), intent(in) :: settings
      !> Name of a property that has a value
      character(len=*), intent(in) :: name
      !> Text, in quotes if it is one
      character(len=value_length(settings, name)) :: text

      real(wp), allocatable :: list(:)
      integer :: i, length

      if (settings%has_word(name)) then
         text = ''''//shown(settings%word(name))//''''
      else if (settings%has_list(name)) then
         list = settings%list(name)
         length = 0
         do i = 1, min(size(list), most_shown)
            if (i > 1) text(length + 1:) = ', '
            if (i > 1) length = length + 2
            text(length + 1:) = to_text(list(i))
            length = length + len(to_text(list(i)))
         end do
         if (size(list) > most_shown) text(length + 1:) = more
      else
         text = to_text(settings%number(name))
      end if
   end function value_text

end module dondolo_base_settings_check
