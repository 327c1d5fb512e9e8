!> What a user says of a free element, a wall that nothing holds above its base: whether it is one, and how stiff its masonry is.
!> The check by the code needs both (Circolare 7/2019, C8.7.1.2.1.3 and .5); time histories, of rigid blocks, need neither.
module dondolo_wall_free_wall
   use dondolo_base_error, only : not_together, out_of_range, problems_type, wrong_length
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : choices_length, is_list, is_logical, most_choices, property_type
   use dondolo_base_settings, only : settings_type
   use dondolo_base_text, only : to_text
   use dondolo_wall_rigid_body, only : section_type
   implicit none
   private

   public :: check_free, free_rows

   !> Owners: walls of one block, and those of them that need not be free
   character(len=choices_length), parameter :: one_block(most_choices) = [character(len=choices_length) :: 'one_sided', &
      & 'free_standing', '', '', '', '', '', ''], one_sided(most_choices) = [character(len=choices_length) :: 'one_sided', &
      & '', '', '', '', '', '', '']

   !> Its properties
   type(property_type), parameter :: free_rows(*) = [ &
      & property_type('young_modulus', is_list, unit='Pa', owners=one_block, optional=.true., changes_results=.false., &
      &   positive=.true., largest=1.0e12_wp, usual_least=1.0e8_wp, usual_most=2.0e10_wp, example='0.75e9, 1.5e9', &
      &   meaning='Young''s modulus of the masonry of a free element, reduced for cracks: one value or a range, for checks', &
      &   more='the wall is then a free element (C8.7.1.2.1.3)'), &
      & property_type('free', is_logical, owners=one_sided, optional=.true., changes_results=.false., example='.true.', &
      &   meaning='is the wall a free element, such as a parapet, which no transverse walls hold?', &
      &   more='free_standing always is')]

contains

   !> Check what is said of a free element
   subroutine check_free(input, sections, problems)
      !> Settings of the wall, ranges checked
      class(settings_type), intent(in) :: input
      !> Its storeys
      type(section_type), intent(in) :: sections(:)
      !> Takes what does not agree
      type(problems_type), intent(inout) :: problems

      character(len=:), allocatable :: name

      if (input%has('free')) then
         ! Cells of tables may be any number
         if (all(abs(input%number('free') - [0.0_wp, 1.0_wp]) > 0.0_wp)) call problems%note('free = '// &
            & to_text(input%number('free'))//': must be 1 or 0, .true. or .false. in a case', out_of_range, 'free')
         if (.not. input%number('free') > 0.0_wp .and. input%has('young_modulus')) call problems%note('free = .false.: not '// &
            & 'with young_modulus, which is of free elements', not_together, 'free')
      end if
      name = ''
      if (input%has('free')) then
         if (input%number('free') > 0.0_wp) name = 'free'
      end if
      if (input%has('young_modulus')) name = 'young_modulus'
      if (len(name) == 0) return
      if (input%has('interlock_overlap')) call problems%note(name//': not with interlock_overlap, by which transverse '// &
         & 'walls hold the wall: it is no free element', not_together, name)
      if (input%has('wedge_thickness')) call problems%note(name//': not with wedge_thickness, the wedges of transverse walls '// &
         & 'that the wall is bonded to: it is no free element', not_together, name)
      if (.not. input%has('young_modulus')) return
      if (size(input%list('young_modulus')) > 2) call problems%note('young_modulus: has '// &
         & to_text(size(input%list('young_modulus')))//' values, must have one, or two, the ends of a range', wrong_length, &
         & 'young_modulus')
      if (any(.not. min(sections%base_width, sections%top_width) > 0.0_wp)) call problems%note('young_modulus: not with a '// &
         & 'section that ends in a point (section_top_width = 0): the period T_0 [C8.7.1.7] is that of a cantilever of '// &
         & 'constant section', not_together, 'young_modulus')
   end subroutine check_free

end module dondolo_wall_free_wall
