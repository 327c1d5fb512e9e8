!> The anchor of a tie: a plate on the outer face of a wall. With s the spacing of the bars, a and b width and height of the plate,
!> t the thickness of the masonry that it bears on:
!>
!>     T_bar = A f_yd             T_bearing = k f_d a b
!>     T_shear = 2 t (a + b + 2 t) f_v0d + 2 t (a + t) mu sigma_0      on a surface at t/2 round the plate
!>     T_cone = 2 t (a + b + 2 t) f_td                                 on a frustum at 45 degrees
!>
!> and f_d = f/(FC gamma_M). Of a circular plate of diameter D the surface of both is pi t (t + D), its horizontal projection
!> 2 t (t + D) (docs/ties.md). The tie holds with the least of the four; the anchor, with the least of the last three, gives way at
!> once.
!>
!> Near the top of the wall the upper face is missing, and what the side faces would have above it. Neighbouring plates may also
!> come out together, at any spacing: the band between two horizontal faces, 2 t s.
module dondolo_wall_anchor
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: anchor_type, masonry_type, partial_factor, compute_anchor

   !> Partial factor of masonry gamma_M in seismic checks: Circolare 7/2019, C8.7.1
   real(wp), parameter :: partial_factor = 2.0_wp

   !> The masonry that plates bear on
   type :: masonry_type
      !> Mean strengths in compression, in shear without compression, and in tension [Pa]
      real(wp) :: compression = 0.0_wp, shear = 0.0_wp, tension = 0.0_wp
      !> Coefficient of friction on horizontal faces
      real(wp) :: friction = 0.0_wp
      !> Confidence factor FC that the strengths are divided by
      real(wp) :: knowledge_factor = 1.35_wp
      !> Strength under a plate / strength of the masonry
      real(wp) :: bearing_factor = 1.0_wp
   contains
      !> Design value of a strength
      procedure :: design_strength
   end type masonry_type

   !> A tie and its anchor
   type :: anchor_type
      !> Section per metre of wall [m2/m], and length that is free to stretch [m]
      real(wp) :: area = 0.0_wp, length = 0.0_wp
      !> Yield stress of bar and plate [Pa]
      real(wp) :: strength = 0.0_wp
      !> Diameter of the bar, and distance of two bars [m]; 0: not known
      real(wp) :: bar = 0.0_wp, spacing = 0.0_wp
      !> Width and height of the plate, or its diameter, and its thickness [m]; all 0: no plate is known
      real(wp) :: width = 0.0_wp, height = 0.0_wp, diameter = 0.0_wp, thickness = 0.0_wp
      !> Thickness of the masonry that it bears on, and distance from its upper edge to the top of the wall [m]
      real(wp) :: leaf = 0.0_wp, edge = 0.0_wp
      !> The masonry, and its vertical compression there [Pa]
      type(masonry_type) :: masonry
      real(wp) :: compression = 0.0_wp
      !> Yield force of the bar and forces at which the masonry gives way: crushed under the plate, sheared round it, pulled out as
      !> a frustum, and as a band with those of the neighbouring plates [N]
      real(wp) :: bar_force = 0.0_wp, bearing_force = 0.0_wp, shear_force = 0.0_wp, cone_force = 0.0_wp, band_force = 0.0_wp
      !> Least of these but the first [N], and per metre of wall, or as given [N/m]; huge: not known
      real(wp) :: force = huge(1.0_wp), force_per_metre = huge(1.0_wp)
      !> Thickness that the plate needs so as not to yield under the least of bar and bearing [m]
      real(wp) :: needed_thickness = 0.0_wp
   contains
      !> Is a plate known?
      procedure :: has_plate
      !> Is it known at which force it gives way?
      procedure :: has_strength
      !> Does the anchor give way before the bar yields?
      procedure :: is_brittle
      !> Is the top of the wall nearer to the plate than the surface at t/2?
      procedure :: is_at_edge
      !> Yield force of the bar per metre of wall
      procedure :: bar_force_per_metre
      procedure, private :: shear_area
      procedure, private :: horizontal_area
      procedure, private :: cone_area
      procedure, private :: band_area
   end type anchor_type

contains

   !> Design value of a strength of the masonry [Pa]
   elemental real(wp) function design_strength(self, strength)
      class(masonry_type), intent(in) :: self
      !> Mean value [Pa]
      real(wp), intent(in) :: strength

      design_strength = strength/(self%knowledge_factor*partial_factor)
   end function design_strength

   !> Is a plate known?
   elemental logical function has_plate(self)
      class(anchor_type), intent(in) :: self

      has_plate = self%width > 0.0_wp .or. self%diameter > 0.0_wp
   end function has_plate

   !> Is it known at which force it gives way?
   elemental logical function has_strength(self)
      class(anchor_type), intent(in) :: self

      has_strength = self%force_per_metre < huge(1.0_wp)
   end function has_strength

   !> Does the anchor give way before the bar yields?
   elemental logical function is_brittle(self)
      class(anchor_type), intent(in) :: self

      is_brittle = self%force_per_metre < self%bar_force_per_metre()
   end function is_brittle

   !> Yield force of the bar [N/m]
   elemental real(wp) function bar_force_per_metre(self) result(force)
      class(anchor_type), intent(in) :: self

      force = self%strength*self%area
   end function bar_force_per_metre

   !> Compute the forces at which bar and masonry give way
   pure subroutine compute_anchor(anchor)
      !> A tie with a plate
      type(anchor_type), intent(inout) :: anchor

      real(wp), parameter :: pi = acos(-1.0_wp)
      real(wp) :: plate, size, compression, shear, tension, friction

      associate (masonry => anchor%masonry)
         shear = masonry%design_strength(masonry%shear)
         tension = masonry%design_strength(masonry%tension)
         compression = masonry%bearing_factor*masonry%design_strength(masonry%compression)
         friction = masonry%friction*anchor%compression
      end associate
      if (anchor%diameter > 0.0_wp) then
         size = anchor%diameter
         plate = 0.25_wp*pi*size**2
      else
         size = min(anchor%width, anchor%height)
         plate = anchor%width*anchor%height
      end if
      anchor%bar_force = 0.25_wp*pi*anchor%bar**2*anchor%strength
      anchor%bearing_force = compression*plate
      anchor%shear_force = anchor%shear_area()*shear + anchor%horizontal_area()*friction
      anchor%cone_force = anchor%cone_area()*tension
      anchor%band_force = anchor%band_area()*min(shear + friction, tension)
      anchor%force = min(anchor%bearing_force, anchor%shear_force, anchor%cone_force, anchor%band_force)
      anchor%force_per_metre = anchor%force/anchor%spacing
      anchor%needed_thickness = 0.5_wp*(size - anchor%bar)*sqrt(3.0_wp*min(anchor%bar_force, anchor%bearing_force)/ &
         & (plate*anchor%strength))
   end subroutine compute_anchor

   !> Is the upper face of the surface at t/2 round the plate missing, since the top of the wall is nearer?
   elemental logical function is_at_edge(self)
      class(anchor_type), intent(in) :: self

      is_at_edge = self%edge < 0.5_wp*self%leaf
   end function is_at_edge

   !> Surface at t/2 round the plate through the masonry; of a circular plate at the top half of it is left [m2]
   elemental real(wp) function shear_area(self) result(area)
      class(anchor_type), intent(in) :: self

      real(wp), parameter :: pi = acos(-1.0_wp)

      associate (t => self%leaf, a => self%width, b => self%height)
         if (self%diameter > 0.0_wp) then
            area = pi*t*(t + self%diameter)
            if (self%is_at_edge()) area = 0.5_wp*area
         else
            area = 2.0_wp*t*(a + b + 2.0_wp*t)
            if (self%is_at_edge()) area = t*(a + t) + 2.0_wp*t*(b + 0.5_wp*t + self%edge)
         end if
      end associate
   end function shear_area

   !> Its horizontal faces, on which the compression acts [m2]
   elemental real(wp) function horizontal_area(self) result(area)
      class(anchor_type), intent(in) :: self

      area = merge(1.0_wp, 2.0_wp, self%is_at_edge())*self%leaf*(self%leaf + max(self%width, self%diameter))
   end function horizontal_area

   !> Projection of the frustum on the wall, the same where the top of the wall is far. The frustum reaches the inner face at t from
   !> the plate: between t/2 and t the top cuts off its corner, nearer the upper face is left out [m2]
   elemental real(wp) function cone_area(self) result(area)
      class(anchor_type), intent(in) :: self

      area = self%shear_area()
      associate (t => self%leaf)
         if (self%is_at_edge() .or. .not. self%edge < t) return
         if (self%diameter > 0.0_wp) area = 0.5_wp*area
         if (.not. self%diameter > 0.0_wp) area = area - (self%width + 2.0_wp*t)*(t - self%edge)
      end associate
   end function cone_area

   !> Horizontal faces of a band of masonry that goes from plate to plate [m2]
   elemental real(wp) function band_area(self) result(area)
      class(anchor_type), intent(in) :: self

      area = merge(1.0_wp, 2.0_wp, self%is_at_edge())*self%leaf*self%spacing
   end function band_area

end module dondolo_wall_anchor
