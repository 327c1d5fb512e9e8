!> Periods of strips that bend, against finite elements and 12 digits of an independent program; what they do to medians.
program test_strip_bending
   use checks, only : check, check_close, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_warning, only : warnings_type
   use dondolo_case_wall_warnings, only : wall_warnings_type
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   use dondolo_wall_strip_bending, only : bends_before_opening, median_reduction, pinned_period
   implicit none

   real(wp), parameter :: g = 9.81_wp, turn = 2.0_wp*acos(-1.0_wp)

   call test_periods()
   call test_reductions()
   call test_condition()
   call test_warning()
   call finish()

contains

   !> The closed form; finite elements of the same strips differ by 1e-6
   subroutine test_periods()
      call suite('periods of pinned strips')
      call check_close(pinned_period(3.0_wp, 0.25_wp, 1800.0_wp, 5.0e3_wp, g, 1.0e9_wp), 0.106950818_wp, 1.0e-9_wp, 'docs')
      call check_close(pinned_period(2.85_wp, 0.21_wp, 1884.0_wp, 21.0e3_wp, g, 1.0e9_wp), 0.118771904401_wp, 1.0e-11_wp, 'stocky')
      call check_close(pinned_period(2.764_wp, 0.102_wp, 1835.0_wp, 10.2e3_wp, g, 3.0e9_wp), 0.131652126742_wp, 1.0e-11_wp, 'thin')
      call check_close(pinned_period(3.0_wp, 0.12_wp, 1800.0_wp, 30.0e3_wp, g, 5.0e8_wp), 0.412142920171_wp, 1.0e-11_wp, 'soft')
      call check_close(pinned_period(3.0_wp, 0.12_wp, 1800.0_wp, 30.0e3_wp, g, 5.0e8_wp), 0.412177047_wp, 1.0e-4_wp, &
         & 'soft, finite elements')
      call check(pinned_period(4.0_wp, 0.05_wp, 1800.0_wp, 30.0e3_wp, g, 1.0e9_wp) > 1.0e100_wp, 'its load buckles it')
   end subroutine test_periods

   !> Medians of four computed walls at a period of 0.10 and 0.15 s, whose p are 10.2, 10.3 and 5.4; to the 4 % that are said
   subroutine test_reductions()
      real(wp), parameter :: p(3) = [10.2_wp, 10.3_wp, 5.4_wp], ratio(2, 3) = reshape([0.829_wp, 0.705_wp, 0.827_wp, 0.710_wp, &
         & 0.943_wp, 0.911_wp], [2, 3])
      integer :: i

      call suite('medians')
      do i = 1, 3
         call check(abs(1.0_wp - median_reduction(0.10_wp*p(i)) - ratio(1, i)) <= 0.04_wp, '0.10 s')
         call check(abs(1.0_wp - median_reduction(0.15_wp*p(i)) - ratio(2, i)) <= 0.04_wp, '0.15 s')
      end do
      call check_close(median_reduction(0.0_wp), 0.0_wp, 0.0_wp, 'a rigid strip')
      call check_close(median_reduction(turn*0.075_wp), 0.05_wp, 1.0e-12_wp, 'between two points')
      call check_close(median_reduction(turn*0.31_wp), 0.37_wp, 1.0e-12_wp, 'the last point')
      call check_close(median_reduction(turn*3.0_wp), 0.37_wp, 1.0e-12_wp, 'beyond the last')
      call check(all([(median_reduction(turn*0.01_wp*real(i, wp)) <= median_reduction(turn*0.01_wp*real(i + 1, wp)), i=0, 40)]), &
         & 'longer periods lower it more')
   end subroutine test_reductions

   !> s = 0.06 is the limit
   subroutine test_condition()
      real(wp) :: limit

      call suite('condition')
      limit = 0.06_wp*turn/pinned_period(3.0_wp, 0.25_wp, 1800.0_wp, 5.0e3_wp, g, 1.0e9_wp)
      call check(.not. bends_before_opening(3.0_wp, 0.25_wp, 1800.0_wp, 5.0e3_wp, g, 0.999_wp*limit), 'below')
      call check(bends_before_opening(3.0_wp, 0.25_wp, 1800.0_wp, 5.0e3_wp, g, 1.001_wp*limit), 'above')
   end subroutine test_condition

   !> Once for all walls, with the numbers of the first; none of other mechanisms
   subroutine test_warning()
      type(wall_warnings_type) :: seen
      type(warnings_type) :: warnings
      type(lines_type) :: sentences

      call suite('warning')
      call seen%look(a_wall('one_sided', 0.25_wp, 0.0_wp))
      call seen%look(a_wall('free_standing', 0.25_wp, 0.0_wp))
      call seen%look(a_wall('two_block', 0.45_wp, 0.0_wp))
      call seen%warn(warnings)
      call check(warnings%count == 0, 'nothing that bends')
      call seen%look(a_wall('two_block', 0.21_wp, 21.0e3_wp))
      call seen%look(a_wall('two_block', 0.10_wp, 10.0e3_wp))
      call seen%warn(warnings)
      call warnings%put_sentences(sentences)
      call check(warnings%count == 1, 'one warning')
      call check(index(sentences%line(1)%text, 'about half of the trigger, and medians are 6 to 22 % lower at a period of '// &
         & '0.10 s, 7 to 37 % at 0.15 s') > 0 .and. index(sentences%line(1)%text, '(2 of 5 in all)') > 0, sentences%line(1)%text)
      call warnings%put_objects(sentences)
      call check(index(sentences%line(2)%text, 'bending_neglected') > 0, 'its code')
   end subroutine test_warning

   !> A wall 2.9 m high
   function a_wall(mechanism, thickness, load) result(wall)
      character(len=*), intent(in) :: mechanism
      !> Thickness [m], and load on top [N/m]
      real(wp), intent(in) :: thickness, load
      type(wall_type) :: wall

      type(wall_input_type) :: input
      type(error_type), allocatable :: error

      call input%set('mechanism', mechanism)
      call input%set('height', 2.9_wp)
      call input%set('thickness', thickness)
      if (load > 0.0_wp) call input%set('overburden', load)
      if (load > 0.0_wp) call input%set('overburden_inertia', 0.0_wp)
      call new_wall(wall, input, error)
      call check(.not. allocated(error), 'a wall')
   end function a_wall

end program test_strip_bending
