!> The ties of a wall in the sheet of its check: bar, masonry round the plate, plate, and which of them gives way first.
module dondolo_check_tie_rows
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_check_sheet, only : sheet_type
   use dondolo_wall_anchor, only : anchor_type
   implicit none
   private

   public :: put_ties

contains

   !> Put all ties, in the order of the wall
   subroutine put_ties(sheet, anchors, knowledge_factor)
      type(sheet_type), intent(inout) :: sheet
      !> Anchors of the ties
      type(anchor_type), intent(in) :: anchors(:)
      !> Confidence factor of the check
      real(wp), intent(in) :: knowledge_factor

      character(len=20) :: item
      logical :: is_checked
      integer :: i

      do i = 1, size(anchors)
         item = 'tie '//to_text(i)
         associate (anchor => anchors(i))
            if (anchor%has_plate()) call put_plate(sheet, anchor, item)
            call put('bar_force_per_m', anchor%bar_force_per_metre())
            ! A greater confidence factor in the check would make the anchor weaker than it is in the curve
            is_checked = anchor%force_per_metre < huge(1.0_wp)
            if (anchor%has_plate()) is_checked = anchor%masonry%knowledge_factor >= knowledge_factor
            if (anchor%force_per_metre < huge(1.0_wp)) call put('anchor_force_per_m', anchor%force_per_metre)
            call put('tie_force_per_m', min(anchor%bar_force_per_metre(), anchor%force_per_metre))
            if (anchor%force_per_metre < huge(1.0_wp)) call put('hierarchy', merge(0.0_wp, 1.0_wp, anchor%is_brittle()))
            call put('anchor_checked', merge(1.0_wp, 0.0_wp, is_checked))
         end associate
      end do

   contains

      !> Put a number of the tie
      subroutine put(name, value)
         !> Name of the quantity
         character(len=*), intent(in) :: name
         !> Value, in its unit
         real(wp), intent(in) :: value

         call sheet%add('tie', '', name, value, item=item)
      end subroutine put

   end subroutine put_ties

   !> Put bar, plate and masonry of a tie whose plate is known
   subroutine put_plate(sheet, anchor, item)
      type(sheet_type), intent(inout) :: sheet
      type(anchor_type), intent(in) :: anchor
      !> Name of the tie
      character(len=*), intent(in) :: item

      !> Place of gamma_M
      character(len=*), parameter :: factor = 'C8.7.1'

      associate (masonry => anchor%masonry)
         call put('bar', anchor%bar)
         call put('spacing', anchor%spacing)
         call put('yield_stress', anchor%strength)
         if (anchor%diameter > 0.0_wp) then
            call put('plate_diameter', anchor%diameter)
         else
            call put('plate_width', anchor%width)
            call put('plate_height', anchor%height)
         end if
         call put('masonry_thickness', anchor%leaf)
         if (anchor%edge < anchor%leaf) call put('edge_distance', anchor%edge)
         call put('anchor_knowledge', masonry%knowledge_factor)
         call put('bearing_strength', masonry%bearing_factor*masonry%design_strength(masonry%compression), factor)
         call put('shear_strength', masonry%design_strength(masonry%shear), factor)
         call put('tensile_strength', masonry%design_strength(masonry%tension), factor)
         if (masonry%friction*anchor%compression > 0.0_wp) call put('friction_stress', masonry%friction*anchor%compression)
      end associate
      call put('bar_force', anchor%bar_force)
      call put('bearing_force', anchor%bearing_force)
      call put('shear_force', anchor%shear_force)
      call put('cone_force', anchor%cone_force)
      ! Plates that are far from each other do not pull out a band
      if (anchor%band_force <= anchor%force) call put('band_force', anchor%band_force)
      call put('anchor_force', anchor%force)
      call put('plate_needed', anchor%needed_thickness)
      call put('plate_thickness', anchor%thickness)
      call put('plate_verified', merge(1.0_wp, 0.0_wp, anchor%thickness >= anchor%needed_thickness))

   contains

      !> Put a number of the tie
      subroutine put(name, value, formula)
         !> Name of the quantity
         character(len=*), intent(in) :: name
         !> Value, in its unit
         real(wp), intent(in) :: value
         !> Where the code has the formula; absent: it has none
         character(len=*), intent(in), optional :: formula

         call sheet%add('tie', '', name, value, formula, item)
      end subroutine put

   end subroutine put_plate

end module dondolo_check_tie_rows
