!> The masonry of a wall as one rigid body: mass, centroid and inertia of its storeys, per metre of wall length.
module dondolo_wall_rigid_body
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: rigid_body_type, section_type, body_of_sections, faces_at, joined, same

   !> What rocks, without what it carries
   type :: rigid_body_type
      !> Mass M [kg/m]
      real(wp) :: mass = 0.0_wp
      !> Centroid: depth d_c behind the outer face and height z_c above the base [m]
      real(wp) :: depth = 0.0_wp, height = 0.0_wp
      !> Inertia about the centroid I_c [kg m2/m]
      real(wp) :: inertia = 0.0_wp
   end type rigid_body_type

   !> A storey of a wall
   type :: section_type
      !> Height and thickness [m]
      real(wp) :: height = 0.0_wp, thickness = 0.0_wp
      !> Part of it that is masonry, 1 without openings
      real(wp) :: fill = 1.0_wp
      !> Depth of its outer face behind that of the lowest section [m]
      real(wp) :: offset = 0.0_wp
      !> Width of its elevation at its bottom and at its top / width that all values per metre refer to
      real(wp) :: base_width = 1.0_wp, top_width = 1.0_wp
   end type section_type

   !> Lengths that differ by this part of the wall are the same
   real(wp), parameter :: same = 1.0e-9_wp

contains

   !> The body of sections that stand on one another; widths change linearly over a section, 1 and 0 are a gable
   pure function body_of_sections(sections, density) result(body)
      !> From the bottom
      type(section_type), intent(in) :: sections(:)
      !> Density of the masonry [kg/m3]
      real(wp), intent(in) :: density
      !> The body
      type(rigid_body_type) :: body

      real(wp), dimension(size(sections)) :: mass, depth, height, inertia
      real(wp) :: bottom, area, centroid
      integer :: i

      bottom = 0.0_wp
      do i = 1, size(sections)
         associate (part => sections(i), w0 => sections(i)%base_width, w1 => sections(i)%top_width)
            area = density*part%fill*part%thickness*part%height
            mass(i) = area*(w0 + w1)/2.0_wp
            centroid = part%height*(w0 + 2.0_wp*w1)/(3.0_wp*(w0 + w1))
            inertia(i) = area*part%height**2*(w0 + 3.0_wp*w1)/12.0_wp + mass(i)*(part%thickness**2/12.0_wp - centroid**2)
            height(i) = bottom + centroid
            depth(i) = part%offset + 0.5_wp*part%thickness
            bottom = bottom + part%height
         end associate
      end do
      body%mass = sum(mass)
      body%depth = sum(mass*depth)/body%mass
      body%height = sum(mass*height)/body%mass
      body%inertia = sum(inertia + mass*((depth - body%depth)**2 + (height - body%height)**2))
   end function body_of_sections

   !> Two bodies as one; one of them may be without mass, and the other is then the same to the bit
   pure function joined(one, other) result(body)
      type(rigid_body_type), intent(in) :: one, other
      type(rigid_body_type) :: body

      body = one
      if (.not. other%mass > 0.0_wp) return
      body = other
      if (.not. one%mass > 0.0_wp) return
      body%mass = one%mass + other%mass
      body%depth = (one%mass*one%depth + other%mass*other%depth)/body%mass
      body%height = (one%mass*one%height + other%mass*other%height)/body%mass
      body%inertia = one%inertia + other%inertia + one%mass*other%mass/body%mass*((one%depth - other%depth)**2 &
         & + (one%height - other%height)**2)
   end function joined

   !> Outer and inner face at a height; where sections meet, the outermost and the innermost
   pure function faces_at(sections, height) result(faces)
      !> From the bottom
      type(section_type), intent(in) :: sections(:)
      !> Height above the base [m]
      real(wp), intent(in) :: height
      !> Depths of both faces [m]; the first is greater than the second beyond the wall
      real(wp) :: faces(2)

      real(wp) :: bottom, slack
      integer :: i

      faces = [huge(1.0_wp), -huge(1.0_wp)]
      slack = same*sum(sections%height)
      bottom = 0.0_wp
      do i = 1, size(sections)
         associate (part => sections(i))
            if (height >= bottom - slack .and. height <= bottom + part%height + slack) then
               faces(1) = min(faces(1), part%offset)
               faces(2) = max(faces(2), part%offset + part%thickness)
            end if
            bottom = bottom + part%height
         end associate
      end do
   end function faces_at

end module dondolo_wall_rigid_body
