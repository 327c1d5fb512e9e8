!> The depth of the hinges of a wall behind its faces: given, or from the strength of the masonry that is crushed there.
!>
!> The weight N on a hinge is carried by a block of the stress beta f over 2 u, whose resultant is the hinge:
!> u = N/(2 beta f) (equation (3) of AlShawa et al. 2023; docs/theory.md, section 2). At a corner of right angles the block is a
!> triangle on the bisector, a deep and 2 a wide: a = sqrt(N/(beta f)), u = 2 a/3.
module dondolo_wall_hinge_depth
   use dondolo_base_error, only : not_together, out_of_range, problems_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : hint_of, name_length, property_type
   use dondolo_base_settings, only : settings_type
   use dondolo_base_text, only : rounded
   use dondolo_base_unit_hint, only : unit_hint
   implicit none
   private

   public :: read_hinge_depth, check_hinge

contains

   !> The depth of the hinges, and the property that it follows from
   subroutine read_hinge_depth(input, weight, problems, depth, name, at_corner)
      !> Settings of the wall, defaults filled in
      class(settings_type), intent(in) :: input
      !> Weight on the base hinge, of the wall and all that it carries [N/m], of a corner in all [N]
      real(wp), intent(in) :: weight
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> Depth u [m]; 0: at the faces
      real(wp), intent(out) :: depth
      !> Name of the property
      character(len=name_length), intent(out) :: name
      !> Is the base a corner? Not present: no
      logical, intent(in), optional :: at_corner

      real(wp), parameter :: usual_block = 0.85_wp
      real(wp) :: block

      depth = input%number('hinge_depth')
      name = 'hinge_depth'
      block = usual_block
      if (input%has('stress_block')) block = input%number('stress_block')
      if (input%has('stress_block') .and. .not. input%has('compressive_strength')) call problems%note('stress_block: only '// &
         & 'with compressive_strength', not_together, 'stress_block')
      if (.not. input%has('compressive_strength')) return
      depth = weight/(2.0_wp*block*input%number('compressive_strength'))
      name = 'compressive_strength'
      if (.not. present(at_corner)) return
      if (at_corner) depth = 2.0_wp/3.0_wp*sqrt(2.0_wp*depth)
   end subroutine read_hinge_depth

   !> Check that a hinge is less deep than what it must hold
   subroutine check_hinge(input, problems, name, depth, limit, what, placed_by)
      !> Settings of the wall
      class(settings_type), intent(in) :: input
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> Name of the property that the depth of the hinge follows from
      character(len=*), intent(in) :: name
      !> Depth of the hinge, and of what it must hold [m]
      real(wp), intent(in) :: depth, limit
      !> What that is, and where; name of the property that places it
      character(len=*), intent(in) :: what, placed_by

      ! A hinge so many times too deep means that the strength is in another unit
      real(wp), parameter :: absurd = 10.0_wp
      type(property_type), pointer :: table(:)
      character(len=:), allocatable :: hint

      if (depth < limit) return
      if (depth > 0.0_wp) then
         hint = ''
         if (name /= 'compressive_strength') then
            hint = trim(unit_hint('m', depth, 0.0_wp, limit, 0.2_wp*limit))
         else if (depth > absurd*limit) then
            call input%get_table(table)
            hint = trim(hint_of(table(input%find(name)), input%number(name)))
         end if
         if (len(hint) > 0) hint = ': '//hint
         call problems%note(trim(name)//': puts the hinge at depth '//rounded(depth)//' m, must be less deep than '// &
            & what//hint, out_of_range, trim(name))
      else
         call problems%note(what//': must be deeper than the hinge, which is at the outer face', out_of_range, placed_by)
      end if
   end subroutine check_hinge

end module dondolo_wall_hinge_depth
