!> A rigid rectangular block: its geometry and its inertia, per metre of wall length.
module dondolo_block
   use dondolo_kinds, only : wp
   implicit none
   private

   public :: block_type, new_block

   !> Rectangular block of height 2h and thickness 2b
   type :: block_type
      !> Half thickness b [m]
      real(wp) :: b
      !> Half diagonal R [m]
      real(wp) :: radius
      !> Slenderness angle alpha = atan(b/h) [rad]
      real(wp) :: alpha
      !> Mass M [kg/m]
      real(wp) :: mass
      !> Inertia about a corner, 4/3 M R^2 [kg m2/m]
      real(wp) :: corner_inertia
      !> Inertia about the centroid, 1/3 M R^2 [kg m2/m]
      real(wp) :: central_inertia
   end type block_type

contains

   !> The block of a given size and density
   pure function new_block(height, thickness, density) result(block)
      !> Height 2h [m]
      real(wp), intent(in) :: height
      !> Thickness 2b [m]
      real(wp), intent(in) :: thickness
      !> Density [kg/m3]
      real(wp), intent(in) :: density
      !> The block
      type(block_type) :: block

      block%b = 0.5_wp*thickness
      block%radius = 0.5_wp*hypot(height, thickness)
      block%alpha = atan2(thickness, height)
      block%mass = density*height*thickness
      block%central_inertia = block%mass*block%radius**2/3.0_wp
      block%corner_inertia = 4.0_wp*block%central_inertia
   end function new_block

end module dondolo_block
