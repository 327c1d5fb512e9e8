!> The check of settings against their table, and the values as its messages show them.
submodule(dondolo_settings) dondolo_settings_check
   use dondolo_plain, only : name_problem, shown
   use dondolo_property, only : check_number, check_word, has_owner, is_integer, is_list, is_real, is_text, is_words, &
      & name_length, number_of_choices, number_of_words
   use dondolo_spelling, only : meant
   use dondolo_text, only : join, to_text
   implicit none

contains

   !> Check what is there against the table: `name = value: what is allowed`
   module procedure check
      type(property_type), pointer :: table(:)
      character(len=name_length), allocatable :: names(:)
      character(len=:), allocatable :: allowed
      integer :: i, k

      call self%get_table(table)
      if (allocated(self%unknown)) then
         names = table%name
         call problems%note(self%unknown//': no such variable; there are '//join(names)//trim(meant(self%unknown, names)))
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

   end procedure check

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

   !> Length of a value as it stands in messages
   pure integer function value_length(self, at)
      class(settings_type), intent(in) :: self
      !> Place of a property that has a value
      integer, intent(in) :: at

      integer :: i

      if (allocated(self%words(at)%text)) then
         value_length = len(shown(self%words(at)%text)) + 2
      else if (self%is_listed(at)) then
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
      else if (self%is_listed(at)) then
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

end submodule dondolo_settings_check
