!> Published distributions of restitution_factor: each is of ratios to the model that it was measured against, and to no other.
!>
!> Of two blocks that model is equation (4), 'sorrentino'. The same measured speeds are a larger ratio to the smaller speeds
!> of 'impulse': the range is then rescaled by the two coefficients of the wall. A load whose mass the wall lifts has no
!> place in equation (4), and no tests.
module dondolo_wall_tested_restitution
   use dondolo_base_error, only : error_type, out_of_range, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : choices_length
   use dondolo_base_text, only : lower, rounded, to_text
   use dondolo_wall, only : wall_type
   use dondolo_wall_restitution, only : cut_off, published_factors
   implicit none
   private

   public :: check_published, make_restitution_sentence, published_parameters, tested_range

contains

   !> Name of the model whose speed ratio a wall has: 'default' is another one for each mechanism; empty: it is a number
   pure character(len=choices_length) function model_of(wall) result(model)
      type(wall_type), intent(in) :: wall

      model = wall%input%word('restitution')
      if (model == 'default') model = wall%impacts%default()
      if (wall%input%has('restitution_value')) model = ''
   end function model_of

   !> Parameters of the published distribution that a text names, so that the speed ratio of no wall reaches 1
   pure function published_parameters(text, walls) result(parameters)
      !> Its name
      character(len=*), intent(in) :: text
      !> The walls, or variants of one, of its mechanism and its model
      type(wall_type), intent(in) :: walls(:)
      !> As of the distribution of its kind; none if it is no name
      real(wp), allocatable :: parameters(:)

      real(wp) :: largest
      integer :: i

      allocate (parameters(0))
      largest = 0.0_wp
      do i = 1, size(walls)
         if (allocated(walls(i)%impacts%impulse)) largest = max(largest, walls(i)%impacts%impulse)
      end do
      i = findloc(published_factors%name == lower(adjustl(text)), .true., dim=1)
      if (i > 0) parameters = cut_off(i, largest)
   end function published_parameters

   !> Parameters of a published distribution as ratios to the model of a wall
   pure subroutine tested_range(wall, number, parameters, is_known)
      type(wall_type), intent(in) :: wall
      !> Number of the range in published_factors
      integer, intent(in) :: number
      !> Factors on the model of the wall
      real(wp), intent(out) :: parameters(2)
      !> Do the tests say anything of this wall and this model?
      logical, intent(out) :: is_known

      character(len=choices_length) :: model

      associate (tests => published_factors(number), impacts => wall%impacts)
         parameters = tests%parameters
         model = model_of(wall)
         is_known = wall%input%word('mechanism') == tests%mechanism
         if (.not. is_known .or. model == tests%model) return
         is_known = model == 'impulse' .and. allocated(impacts%impulse) .and. allocated(impacts%sorrentino)
         if (is_known) is_known = impacts%impulse > 0.0_wp
         if (.not. is_known) return
         parameters = parameters*impacts%sorrentino/impacts%impulse
      end associate
   end subroutine tested_range

   !> Check that a published range, if a text names one, was measured against the model of a wall
   subroutine check_published(text, wall, error)
      !> Name of a range, or anything else
      character(len=*), intent(in) :: text
      !> The wall, of uncertain properties with all of them at their medians
      type(wall_type), intent(in) :: wall
      !> The range is of another mechanism, or a ratio to another model
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: shown
      character(len=choices_length) :: model
      real(wp) :: parameters(2)
      integer :: i
      logical :: is_known

      i = findloc(published_factors%name == lower(adjustl(text)), .true., dim=1)
      if (i == 0) return
      model = model_of(wall)
      shown = ''''//trim(model)//''''
      if (len_trim(model) == 0) shown = 'restitution_value'
      associate (tests => published_factors(i))
         if (wall%input%word('mechanism') /= tests%mechanism) then
            call raise_input(error, 'restitution_factor = '''//trim(text)//''': is of tests of mechanism = '''// &
               & trim(tests%mechanism)//''', must be a range or distribution for '''//wall%mechanism_name()//'''', &
               & out_of_range, 'restitution_factor')
         else if (model /= tests%model) then
            call tested_range(wall, i, parameters, is_known)
            call raise_input(error, 'restitution_factor = '''//trim(text)//''': is a ratio to restitution = '''// &
               & trim(tests%model)//''', must be a range or distribution for '//shown, out_of_range, 'restitution_factor')
            if (is_known) then
               error%message = error%message//'; the same speeds are '//trim(tests%kind)//'('//rounded(parameters(1))// &
                  & ', '//rounded(parameters(2))//') for this wall'
            else if (model == 'impulse') then
               error%message = error%message//', the model of a wall that lifts the mass of its overburden'
            end if
         end if
      end associate
   end subroutine check_published

   !> The restitution of a wall of two blocks beside the tests: no other choice moves its curve as much
   subroutine make_restitution_sentence(wall, line)
      type(wall_type), intent(in) :: wall
      !> The sentence without its subject; empty for other mechanisms and for a speed ratio by number
      character(len=:), allocatable, intent(out) :: line

      character(len=choices_length) :: model
      real(wp) :: own(2)
      integer :: i
      logical :: is_known

      line = ''
      model = model_of(wall)
      i = findloc(published_factors%mechanism == wall%mechanism_name(), .true., dim=1)
      if (wall%mechanism_name() /= 'two_block' .or. len_trim(model) == 0) return
      line = to_text(wall%input%number('restitution_factor'))//' times that of the model'
      associate (tests => published_factors(i), low => published_factors(i)%parameters(1), &
         & high => published_factors(i)%parameters(2))
         call tested_range(wall, i, own, is_known)
         if (model == tests%model) then
            line = line//'; tests on two-block walls gave '//to_text(low)//' to '//to_text(high)// &
               & ' times it; use &uncertainty to see its effect on theta'
            return
         end if
         line = line//' '''//trim(model)//'''; tests on two-block walls gave '//to_text(low)//' to '// &
            & to_text(high)//' times that of '''//trim(tests%model)//''', '
         if (is_known) then
            line = line//'which for this wall is '//rounded(own(1))//' to '//rounded(own(2))//' times that of '''//trim(model)//''''
         else
            line = line//'which has no mass of an overburden: they do not apply to this wall'
         end if
      end associate
   end subroutine make_restitution_sentence

end module dondolo_wall_tested_restitution
