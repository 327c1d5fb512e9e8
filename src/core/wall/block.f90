!> A rigid rectangular block and the hinges that it turns about: geometry and inertia, per metre of wall length.
module dondolo_wall_block
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: block_type, new_block

   !> Rectangular block of height 2h, whose hinges lie 2b apart: at its faces, or behind them
   type :: block_type
      !> Half thickness b between the hinges [m]
      real(wp) :: b
      !> Distance of the centroid from a hinge R; half diagonal where hinges are at the faces [m]
      real(wp) :: radius
      !> Slenderness angle alpha = atan(b/h) [rad]
      real(wp) :: alpha
      !> Mass M [kg/m]
      real(wp) :: mass
      !> Inertia about a hinge, 4/3 M R^2 about a corner [kg m2/m]
      real(wp) :: corner_inertia
      !> Inertia about the centroid, 1/3 M R^2 where hinges are at the faces [kg m2/m]
      real(wp) :: central_inertia
   end type block_type

contains

   !> The block of a given size and density
   pure function new_block(height, thickness, density, hinge) result(block)
      !> Height 2h [m]
      real(wp), intent(in) :: height
      !> Thickness 2b [m]
      real(wp), intent(in) :: thickness
      !> Density [kg/m3]
      real(wp), intent(in) :: density
      !> Depth of its hinges behind both faces [m]
      real(wp), intent(in), optional :: hinge
      !> The block
      type(block_type) :: block

      block%b = 0.5_wp*thickness
      block%radius = 0.5_wp*hypot(height, thickness)
      block%alpha = atan2(thickness, height)
      block%mass = density*height*thickness
      block%central_inertia = block%mass*block%radius**2/3.0_wp
      block%corner_inertia = 4.0_wp*block%central_inertia
      if (.not. present(hinge)) return
      if (.not. hinge > 0.0_wp) return
      block%b = block%b - hinge
      block%radius = hypot(0.5_wp*height, block%b)
      block%alpha = atan2(block%b, 0.5_wp*height)
      block%corner_inertia = block%central_inertia + block%mass*block%radius**2
   end function new_block

end module dondolo_wall_block
