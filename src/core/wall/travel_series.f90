!> How far the anchor of a tie goes along it in a mechanism of which no formula is known: the lever X = dD/dq is a polynomial, and
!> the travel D is its integral from rest, so that the work of a force over D is what its moment does.
module dondolo_wall_travel_series
   use dondolo_base_bracket, only : bracket_type
   use dondolo_base_chebyshev, only : chebyshev_integral, chebyshev_value
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: travel_series_type, new_travel_series

   !> Travel over the rotation
   type :: travel_series_type
      !> Last rotation that was sampled [rad]
      real(wp), private :: last = 0.0_wp
      !> Chebyshev series of X and of D; not allocated: there is none
      real(wp), allocatable, private :: lever(:), travel(:)
   contains
      !> Is it known?
      procedure :: exists
      !> Travel D
      procedure :: travelled
      !> Lever X
      procedure :: lever_at
      !> Rotation after which it is a distance
      procedure :: rotation_after
   end type travel_series_type

contains

   !> Make it of its lever
   pure subroutine new_travel_series(series, last, lever)
      type(travel_series_type), intent(out) :: series
      !> Last rotation [rad]
      real(wp), intent(in) :: last
      !> Chebyshev series of X over the rotations up to the last [m]
      real(wp), intent(in) :: lever(:)

      series%last = last
      series%lever = lever
      series%travel = 0.5_wp*series%last*chebyshev_integral([series%lever, 0.0_wp])
   end subroutine new_travel_series

   !> Is it known?
   elemental logical function exists(self)
      class(travel_series_type), intent(in) :: self

      exists = allocated(self%lever)
   end function exists

   !> Travel D [m]
   elemental real(wp) function travelled(self, q)
      class(travel_series_type), intent(in) :: self
      !> Rotation [rad]
      real(wp), intent(in) :: q

      travelled = chebyshev_value(self%travel, 2.0_wp*q/self%last - 1.0_wp)
   end function travelled

   !> Lever X = dD/dq [m]
   elemental real(wp) function lever_at(self, q)
      class(travel_series_type), intent(in) :: self
      !> Rotation [rad]
      real(wp), intent(in) :: q

      lever_at = chebyshev_value(self%lever, 2.0_wp*q/self%last - 1.0_wp)
   end function lever_at

   !> Rotation after which D is a distance; huge: it is not up to the last rotation [rad]
   elemental real(wp) function rotation_after(self, distance) result(q)
      class(travel_series_type), intent(in) :: self
      !> The distance, at least 0 [m]
      real(wp), intent(in) :: distance

      type(bracket_type) :: bracket

      q = huge(q)
      if (.not. self%travelled(self%last) > distance) return
      bracket = bracket_type(0.0_wp, self%last)
      do while (bracket%is_divisible())
         call bracket%halve(.not. self%travelled(bracket%middle()) > distance)
      end do
      q = bracket%middle()
   end function rotation_after

end module dondolo_wall_travel_series
