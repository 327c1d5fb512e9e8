!> Inelastic impacts of one block with the masses that it carries.
!>
!> The velocities after an impact are the projection, in the metric of the masses, of those before it onto rotations about
!> the new hinge: eta = <v1, v2>/<v2, v2>, v the velocities for a rotation of 1 rad/s (Moreau's impact law without
!> rebound; docs/theory.md, section 3). For the bare block that is Housner's ratio and equation (2) of Nale et al.
module dondolo_wall_loaded_impact
   use dondolo_base_kinds, only : wp
   use dondolo_wall_body, only : wall_body_type
   use dondolo_wall_rigid_body, only : section_type
   implicit none
   private

   public :: two_sided_impulse, one_sided_impulse

contains

   !> From one edge of the base to the other
   pure function two_sided_impulse(wall) result(eta)
      type(wall_body_type), intent(in) :: wall
      !> Ratio of the angular velocities after and before an impact
      real(wp) :: eta

      eta = projection(wall, outer_hinge(wall), inner_hinge(wall))
   end function two_sided_impulse

   !> From the outer edge to the inner one, from there to the top of the transverse walls behind, and back to the outer edge;
   !> negative: the wall bounces off
   pure function one_sided_impulse(wall) result(eta)
      type(wall_body_type), intent(in) :: wall
      !> Ratio of the angular velocities after and before an impact
      real(wp) :: eta

      type(section_type) :: highest
      real(wp) :: top(2)

      highest = wall%sections(size(wall%sections))
      top = [highest%offset + highest%thickness, sum(wall%sections%height)]
      eta = projection(wall, outer_hinge(wall), inner_hinge(wall))*projection(wall, inner_hinge(wall), top) &
         & *projection(wall, inner_hinge(wall), outer_hinge(wall))
   end function one_sided_impulse

   !> Depth and height of the hinge at the outer edge [m]
   pure function outer_hinge(wall) result(place)
      type(wall_body_type), intent(in) :: wall
      !> Place
      real(wp) :: place(2)

      place = [wall%actions%hinge, 0.0_wp]
   end function outer_hinge

   !> Depth and height of the hinge at the inner edge, as far from its face [m]
   pure function inner_hinge(wall) result(place)
      type(wall_body_type), intent(in) :: wall
      !> Place
      real(wp) :: place(2)

      place = [wall%sections(1)%thickness - wall%actions%hinge, 0.0_wp]
   end function inner_hinge

   !> Ratio of the angular velocities when the hinge changes
   pure function projection(wall, before, after) result(ratio)
      type(wall_body_type), intent(in) :: wall
      !> Depth and height of the hinge before and after [m]
      real(wp), intent(in) :: before(2), after(2)
      !> The ratio
      real(wp) :: ratio

      ratio = inner_product(wall, before, after)/inner_product(wall, after, after)
   end function projection

   !> Inner product of the velocities of rotations about two points, weighted with the masses [kg m2]
   pure function inner_product(wall, one, other) result(product)
      type(wall_body_type), intent(in) :: wall
      !> Depth and height of both points [m]
      real(wp), intent(in) :: one(2), other(2)
      !> The product
      real(wp) :: product

      associate (body => wall%body, carried => wall%actions%carried)
         product = body%inertia + body%mass*((body%depth - one(1))*(body%depth - other(1)) &
            & + (body%height - one(2))*(body%height - other(2))) &
            & + sum(carried%pushed*(carried%height - one(2))*(carried%height - other(2)) &
            & + carried%lifted*(carried%depth - one(1))*(carried%depth - other(1)))
      end associate
   end function inner_product

end module dondolo_wall_loaded_impact
