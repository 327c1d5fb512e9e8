!> What acts on a panel acts on its masonry: its place along the facade and its height lie on the elevation.
module dondolo_wall_panel_places
   use dondolo_base_error, only : out_of_range, problems_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_settings, only : settings_type
   use dondolo_base_text, only : rounded, to_text
   implicit none
   private

   public :: check_panel_places

   !> How far a point may lie outside the elevation, such as the end of a beam at its edge [m]
   real(wp), parameter :: outside = 0.1_wp

contains

   !> Check loads, masses and thrusts of a wall that turns about a line of its face
   subroutine check_panel_places(input, problems)
      !> Settings of the wall, with as many places and heights as there are corners, loads, masses and thrusts
      class(settings_type), intent(in) :: input
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems

      character(len=*), parameter :: kinds(3) = [character(len=7) :: 'load', 'inertia', 'thrust']
      real(wp), allocatable :: x(:), z(:)
      real(wp) :: distance
      integer :: i, kind

      do kind = 1, size(kinds)
         x = input%list(trim(kinds(kind))//'_x')
         z = input%list(trim(kinds(kind))//'_height')
         do i = 1, min(size(x), size(z))
            distance = distance_from([x(i), z(i)], input%list('elevation_x'), input%list('elevation_z'))
            if (distance > outside) call problems%note(trim(kinds(kind))//' '//to_text(i)//': at x = '//to_text(x(i))// &
               & ' m and a height of '//to_text(z(i))//' m it is '//rounded(distance)//' m off the elevation, must be on it or '// &
               & 'within '//rounded(outside)//' m', out_of_range, trim(kinds(kind))//'_x')
         end do
      end do
   end subroutine check_panel_places

   !> Distance of a point from a polygon, 0 within it [m]
   pure real(wp) function distance_from(at, x, z) result(distance)
      !> (x, z) [m]
      real(wp), intent(in) :: at(2)
      !> Corners [m]
      real(wp), intent(in) :: x(:), z(:)

      real(wp) :: along(2), to(2)
      logical :: is_within
      integer :: i, next

      is_within = .false.
      distance = huge(1.0_wp)
      do i = 1, size(x)
         next = modulo(i, size(x)) + 1
         along = [x(next) - x(i), z(next) - z(i)]
         to = at - [x(i), z(i)]
         distance = min(distance, norm2(to - along*max(0.0_wp, min(1.0_wp, sum(to*along)/sum(along**2)))))
         if (z(i) > at(2) .eqv. z(next) > at(2)) cycle
         if (to(1) < to(2)/along(2)*along(1)) is_within = .not. is_within
      end do
      if (is_within) distance = 0.0_wp
   end function distance_from

end module dondolo_wall_panel_places
