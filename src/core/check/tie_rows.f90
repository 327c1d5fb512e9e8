!> The ties of a wall in the sheet of its check: bar, masonry round the plate, plate, and which of them gives way first.
module dondolo_check_tie_rows
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_check_sheet, only : sheet_type, shown, working_type
   use dondolo_wall, only : wall_type
   use dondolo_wall_anchor, only : anchor_type, partial_factor
   use dondolo_wall_chain_model, only : chain_model_type
   use dondolo_wall_one_block_model, only : one_block_model_type
   implicit none
   private

   public :: put_ties, open_anchors

contains

   !> Which ties of a wall have an anchor without a strength, so that the bar alone is checked
   pure function open_anchors(wall) result(is_open)
      type(wall_type), intent(in) :: wall
      logical, allocatable :: is_open(:)

      select type (model => wall%model)
      type is (one_block_model_type)
         if (allocated(model%body%anchors)) is_open = .not. model%body%anchors%has_strength()
      type is (chain_model_type)
         is_open = .not. model%anchors%has_strength()
      end select
      if (.not. allocated(is_open)) allocate (is_open(0))
   end function open_anchors

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
            call put('bar_force_per_m', anchor%bar_force_per_metre(), working_type('A f_yd', trim(shown(anchor%area))//' * '// &
               & trim(shown(anchor%strength))))
            ! A greater confidence factor in the check would make the anchor weaker than it is in the curve
            is_checked = anchor%has_strength()
            if (anchor%has_plate()) is_checked = anchor%masonry%knowledge_factor >= knowledge_factor
            if (anchor%has_plate()) then
               call put('anchor_force_per_m', anchor%force_per_metre, working_type('T_anchor/s', trim(shown(anchor%force))//'/'// &
                  & trim(shown(anchor%spacing))))
            else if (anchor%has_strength()) then
               call put('anchor_force_per_m', anchor%force_per_metre)
            end if
            call put('tie_force_per_m', min(anchor%bar_force_per_metre(), anchor%force_per_metre))
            if (anchor%has_strength()) call put('hierarchy', merge(0.0_wp, 1.0_wp, anchor%is_brittle()))
            call put('anchor_checked', merge(1.0_wp, 0.0_wp, is_checked))
         end associate
      end do

   contains

      !> Put a number of the tie
      subroutine put(name, value, working)
         !> Name of the quantity
         character(len=*), intent(in) :: name
         !> Value, in its unit
         real(wp), intent(in) :: value
         !> Its formula; absent: it has none
         type(working_type), intent(in), optional :: working

         call sheet%add('tie', '', name, value, item=item, working=working)
      end subroutine put

   end subroutine put_ties

   !> Put bar, plate and masonry of a tie whose plate is known
   subroutine put_plate(sheet, anchor, item)
      type(sheet_type), intent(inout) :: sheet
      type(anchor_type), intent(in) :: anchor
      !> Name of the tie
      character(len=*), intent(in) :: item

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
         call put_strength('bearing_strength', masonry%compression, 'f_m', masonry%bearing_factor)
         call put_strength('shear_strength', masonry%shear, 'f_v0')
         call put_strength('tensile_strength', masonry%tension, 'f_t')
         if (masonry%friction*anchor%compression > 0.0_wp) call put('friction_stress', masonry%friction*anchor%compression)
      end associate
      call put_forces(sheet, anchor, item)

   contains

      !> Put a number of the tie
      subroutine put(name, value)
         !> Name of the quantity
         character(len=*), intent(in) :: name
         !> Value, in its unit
         real(wp), intent(in) :: value

         call sheet%add('tie', '', name, value, item=item)
      end subroutine put

      !> Put a design strength of the masonry, with the place of gamma_M
      subroutine put_strength(name, mean, symbol, multiple)
         !> Name of the quantity
         character(len=*), intent(in) :: name
         !> Mean strength [Pa]
         real(wp), intent(in) :: mean
         !> Its symbol
         character(len=*), intent(in) :: symbol
         !> Factor k of the strength; absent: it has none
         real(wp), intent(in), optional :: multiple

         character(len=:), allocatable :: expression, numbers
         real(wp) :: strength

         associate (masonry => anchor%masonry)
            strength = masonry%design_strength(mean)
            expression = symbol//'/(FC gamma_M)'
            numbers = trim(shown(mean))//'/('//trim(shown(masonry%knowledge_factor))//' * '// &
               & trim(shown(partial_factor))//')'
         end associate
         if (present(multiple)) then
            strength = multiple*strength
            expression = 'k '//expression
            numbers = trim(shown(multiple))//' * '//numbers
         end if
         call sheet%add('tie', '', name, strength, 'C8.7.1', item, working=working_type(expression, numbers))
      end subroutine put_strength

   end subroutine put_plate

   !> Put the forces of bar and masonry, and the thickness that the plate needs, each with its formula
   subroutine put_forces(sheet, anchor, item)
      type(sheet_type), intent(inout) :: sheet
      type(anchor_type), intent(in) :: anchor
      !> Name of the tie
      character(len=*), intent(in) :: item

      character(len=:), allocatable :: plate, plate_numbers, least, least_numbers, size_numbers, faces, faces_numbers
      real(wp) :: bearing

      associate (masonry => anchor%masonry)
         bearing = masonry%bearing_factor*masonry%design_strength(masonry%compression)
      end associate
      plate = merge('pi D^2/4', 'a b     ', anchor%diameter > 0.0_wp)
      if (anchor%diameter > 0.0_wp) then
         plate_numbers = 'pi * '//trim(shown(anchor%diameter))//'^2/4'
         size_numbers = trim(shown(anchor%diameter))
      else
         plate_numbers = trim(shown(anchor%width))//' * '//trim(shown(anchor%height))
         size_numbers = trim(shown(min(anchor%width, anchor%height)))
      end if
      ! Horizontal faces: near the top of the wall the upper one is missing
      faces = ''
      faces_numbers = ''
      if (.not. anchor%is_at_edge()) then
         faces = '2 '
         faces_numbers = '2 * '
      end if
      call put('bar_force', anchor%bar_force, 'pi D_bar^2/4 f_yd', 'pi * '//trim(shown(anchor%bar))//'^2/4 * '// &
         & trim(shown(anchor%strength)))
      call put('bearing_force', anchor%bearing_force, 'k f_d '//trim(plate), trim(shown(bearing))//' * '//plate_numbers)
      call put_pulled('shear_force', anchor%shear_force, 'f_v0d', anchor%masonry%shear, .true.)
      call put_pulled('cone_force', anchor%cone_force, 'f_td', anchor%masonry%tension, .false.)
      least = 'T_bearing, T_shear, T_cone'
      least_numbers = trim(shown(anchor%bearing_force))//', '//trim(shown(anchor%shear_force))//', '// &
         & trim(shown(anchor%cone_force))
      ! Plates that are far from each other do not pull out a band
      if (anchor%band_force <= anchor%force) then
         call put_band()
         least = least//', T_band'
         least_numbers = least_numbers//', '//trim(shown(anchor%band_force))
      end if
      call put('anchor_force', anchor%force, 'min('//least//')', 'min('//least_numbers//')')
      call put('plate_needed', anchor%needed_thickness, '('//trim(merge('D        ', 'min(a, b)', anchor%diameter > 0.0_wp))// &
         & ' - D_bar)/2 sqrt[3 min(T_bar, T_bearing)/('//trim(plate)//' f_yd)]', '('//size_numbers//' - '// &
         & trim(shown(anchor%bar))//')/2 * sqrt(3 * '//trim(shown(min(anchor%bar_force, anchor%bearing_force)))//'/('// &
         & plate_numbers//' * '//trim(shown(anchor%strength))//'))')
      call put('plate_thickness', anchor%thickness, '', '')
      call put('plate_verified', merge(1.0_wp, 0.0_wp, anchor%thickness >= anchor%needed_thickness), '', '')

   contains

      !> Put a number of the tie with its formula
      subroutine put(name, value, expression, numbers)
         !> Name of the quantity
         character(len=*), intent(in) :: name
         !> Value, in its unit
         real(wp), intent(in) :: value
         !> Formula in symbols and in numbers
         character(len=*), intent(in) :: expression, numbers

         call sheet%add('tie', '', name, value, item=item, working=working_type(expression, numbers))
      end subroutine put

      !> Put the force of a band of masonry that goes from plate to plate
      subroutine put_band()
         character(len=:), allocatable :: shear, shear_numbers
         real(wp) :: friction

         shear = 'f_v0d'
         shear_numbers = trim(shown(anchor%masonry%design_strength(anchor%masonry%shear)))
         friction = anchor%masonry%friction*anchor%compression
         if (friction > 0.0_wp) then
            shear = shear//' + mu sigma_0'
            shear_numbers = shear_numbers//' + '//trim(shown(friction))
         end if
         call put('band_force', anchor%band_force, faces//'t s min('//shear//', f_td)', faces_numbers//trim(shown(anchor%leaf))// &
            & ' * '//trim(shown(anchor%spacing))//' * min('//shear_numbers//', '// &
            & trim(shown(anchor%masonry%design_strength(anchor%masonry%tension)))//')')
      end subroutine put_band

      !> Put a force at which masonry comes out, with the surface that the top of the wall leaves of it
      subroutine put_pulled(name, value, symbol, strength, has_shear_surface)
         !> Name of the quantity
         character(len=*), intent(in) :: name
         !> Force [N]
         real(wp), intent(in) :: value
         !> Symbol of the strength, and its mean value [Pa]
         character(len=*), intent(in) :: symbol
         real(wp), intent(in) :: strength
         !> Is it the surface at t/2 round the plate, on which friction holds too? Else the frustum, which reaches t
         logical, intent(in) :: has_shear_surface

         character(len=:), allocatable :: expression, numbers, t
         real(wp) :: friction

         if (anchor%diameter > 0.0_wp) then
            call find_round_surface(has_shear_surface, expression, numbers)
         else
            call find_surface(has_shear_surface, expression, numbers)
         end if
         expression = expression//' '//symbol
         numbers = numbers//' * '//trim(shown(anchor%masonry%design_strength(strength)))
         friction = anchor%masonry%friction*anchor%compression
         if (has_shear_surface .and. friction > 0.0_wp) then
            t = trim(shown(anchor%leaf))
            expression = expression//' + '//faces//'t ('//trim(merge('D', 'a', anchor%diameter > 0.0_wp))//' + t) mu sigma_0'
            numbers = numbers//' + '//faces_numbers//t//' * ('//trim(shown(max(anchor%width, anchor%diameter)))//' + '//t// &
               & ') * '//trim(shown(friction))
         end if
         call put(name, value, expression, numbers)
      end subroutine put_pulled

      !> Surface of a plate with edges, in symbols and in numbers
      subroutine find_surface(has_shear_surface, expression, numbers)
         !> Is it the surface at t/2 round the plate? Else the frustum
         logical, intent(in) :: has_shear_surface
         character(len=:), allocatable, intent(out) :: expression, numbers

         character(len=:), allocatable :: a, b, t, c

         a = trim(shown(anchor%width))
         b = trim(shown(anchor%height))
         t = trim(shown(anchor%leaf))
         c = trim(shown(anchor%edge))
         if (anchor%is_at_edge()) then
            ! The lower face, and side faces that end at the top of the wall
            expression = 't [a + t + 2 (b + t/2 + c)]'
            numbers = t//' * ('//a//' + '//t//' + 2 * ('//b//' + '//t//'/2 + '//c//'))'
            return
         end if
         expression = '2 t (a + b + 2 t)'
         numbers = '2 * '//t//' * ('//a//' + '//b//' + 2 * '//t//')'
         if (has_shear_surface .or. .not. anchor%edge < anchor%leaf) return
         ! The top of the wall cuts off the upper edge of the frustum
         expression = '['//expression//' - (a + 2 t) (t - c)]'
         numbers = '('//numbers//' - ('//a//' + 2 * '//t//') * ('//t//' - '//c//'))'
      end subroutine find_surface

      !> Surface of a circular plate, in symbols and in numbers
      subroutine find_round_surface(has_shear_surface, expression, numbers)
         !> Is it the surface at t/2 round the plate? Else the frustum
         logical, intent(in) :: has_shear_surface
         character(len=:), allocatable, intent(out) :: expression, numbers

         character(len=:), allocatable :: t

         t = trim(shown(anchor%leaf))
         expression = 'pi t (t + D)'
         numbers = 'pi * '//t//' * ('//t//' + '//trim(shown(anchor%diameter))//')'
         if (anchor%is_at_edge() .or. (.not. has_shear_surface .and. anchor%edge < anchor%leaf)) then
            expression = expression//'/2'
            numbers = numbers//'/2'
         end if
      end subroutine find_round_surface

   end subroutine put_forces

end module dondolo_check_tie_rows
