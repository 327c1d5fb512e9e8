!> Lists of a wall that go with one another, such as the heights of its loads with its loads.
module dondolo_wall_lists
   use dondolo_base_error, only : not_given, not_together, problems_type, wrong_length
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : property_type
   use dondolo_base_settings, only : settings_type
   use dondolo_base_text, only : to_text
   implicit none
   private

   public :: take

contains

   !> Values of a list that goes with another: one for each, or one for all where its property allows that
   subroutine take(input, problems, name, of, values, default)
      !> Settings of the wall
      class(settings_type), intent(in) :: input
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> Name of the list
      character(len=*), intent(in) :: name
      !> Name of the list that it goes with
      character(len=*), intent(in) :: of
      !> Its values, as many as that list has
      real(wp), allocatable, intent(out) :: values(:)
      !> Value where it is not given; absent: it must be given
      real(wp), intent(in), optional :: default

      type(property_type), pointer :: table(:)
      real(wp), allocatable :: given(:)
      logical :: one_each
      integer :: needed

      call input%get_table(table)
      one_each = table(input%find(name))%one_each
      needed = size(input%list(of))
      given = input%list(name)
      allocate (values(needed), source=0.0_wp)
      if (size(given) == 1 .and. needed > 1 .and. one_each) then
         call problems%note(name//' = '//to_text(given(1))//': is one value for '//to_text(needed)//' values of '//of// &
            & ', must be one for each, such as '//name//' = '//to_text(given(1))//', '//to_text(given(1)), wrong_length, name)
      else if (size(given) == 1 .and. needed > 0) then
         values = given(1)
      else if (size(given) > 0 .and. needed == 0) then
         call problems%note(name//': only with '//of, not_together, name)
      else if (size(given) == needed) then
         values = given
      else if (size(given) > 0) then
         call problems%note(name//': has '//to_text(size(given))//' values, must have '//to_text(needed)//' as '//of// &
            & trim(merge('                ', ', or one for all', one_each)), wrong_length, name)
      else if (present(default)) then
         values = default
      else
         call problems%note(name//': must be given with '//of, not_given, name)
      end if
   end subroutine take

end module dondolo_wall_lists
