!> The ties of a wall as a user describes them.
module dondolo_wall_ties
   use dondolo_base_error, only : problems_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_settings, only : settings_type
   use dondolo_base_text, only : rounded, to_text
   use dondolo_base_unit_hint, only : unit_question
   use dondolo_wall_lists, only : take
   use dondolo_wall_rigid_body, only : faces_at, same, section_type
   use dondolo_wall_restraint, only : new_tie, tie_input_type, restraint_type
   implicit none
   private

   public :: read_ties

   !> How far outside the outer face an anchor may be [m]
   real(wp), parameter :: outside = 0.1_wp

contains

   !> Read the ties, and check each
   subroutine read_ties(input, sections, hinge, edge, problems, ties)
      !> What is said of the wall
      class(settings_type), intent(in) :: input
      !> Its storeys
      type(section_type), intent(in) :: sections(:)
      !> Depth of the hinge, and radius of the edge [m]
      real(wp), intent(in) :: hinge, edge
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> Ties; undefined if something is wrong
      type(restraint_type), allocatable, intent(out) :: ties(:)

      real(wp), allocatable :: depth(:), area(:), length(:), modulus(:), strength(:), preload(:), strain(:), anchor(:)
      type(tie_input_type), allocatable :: given(:)
      integer :: i

      call take(input, problems, 'tie_depth', 'tie_height', depth, input%absent('tie_depth'))
      call take(input, problems, 'tie_area', 'tie_height', area)
      call take(input, problems, 'tie_length', 'tie_height', length)
      call take(input, problems, 'tie_modulus', 'tie_height', modulus, input%absent('tie_modulus'))
      call take(input, problems, 'tie_strength', 'tie_height', strength, input%absent('tie_strength'))
      call take(input, problems, 'tie_preload', 'tie_height', preload, input%absent('tie_preload'))
      call take(input, problems, 'tie_strain', 'tie_height', strain, input%absent('tie_strain'))
      call take(input, problems, 'tie_anchor_force', 'tie_height', anchor, input%absent('tie_anchor_force'))
      allocate (given(size(depth)), ties(size(depth)))
      given%depth = depth
      given%height = input%list('tie_height')
      given%area = area
      given%length = length
      given%modulus = modulus
      given%strength = strength
      given%preload = preload
      given%strain = strain
      given%anchor_force = anchor
      do i = 1, size(given)
         if (.not. (area(i) > 0.0_wp .and. length(i) > 0.0_wp)) return
         call check_tie('tie '//to_text(i), given(i), sections, edge, problems)
         ties(i) = new_tie(given(i), hinge, edge)
      end do
   end subroutine read_ties

   !> Check one tie
   subroutine check_tie(name, tie, sections, edge, problems)
      !> What it is called in messages
      character(len=*), intent(in) :: name
      type(tie_input_type), intent(in) :: tie
      !> Storeys of the wall
      type(section_type), intent(in) :: sections(:)
      !> Radius of the edge [m]
      real(wp), intent(in) :: edge
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems

      real(wp) :: faces(2), tall

      tall = sum(sections%height)
      faces = faces_at(sections, tie%height)
      if (.not. tie%height > edge + same*tall .or. faces(1) > faces(2)) then
         call problems%note(name//': its tie_height = '//to_text(tie%height)//' must be above the hinge, '//to_text(edge)// &
            & ' m, and at most '//rounded(tall)//' m, the top of the wall'//trim(unit_question('m', tie%height, edge, tall, &
            & tall)))
      else if (tie%depth < faces(1) - outside - same*tall .or. tie%depth > faces(2) + same*tall) then
         call problems%note(name//': its tie_depth = '//to_text(tie%depth)//' must lie between '// &
            & rounded(faces(1) - outside)//' and '//rounded(faces(2))//' m, the faces of the wall at its height and 0.1 m '// &
            & 'outside for a plate'//trim(unit_question('m', tie%depth, 0.0_wp, faces(2), 0.5_wp*faces(2))))
      end if
      if (.not. tie%preload < tie%strength) then
         call problems%note(name//': its tie_preload = '//to_text(tie%preload)//' must be less than its tie_strength = '// &
            & to_text(tie%strength)//' Pa, at which it yields')
      else if (.not. tie%preload*tie%area < tie%anchor_force) then
         call problems%note(name//': its tie_preload = '//to_text(tie%preload)//' must be less than '// &
            & rounded(tie%anchor_force/tie%area)//' Pa, at which its anchor gives way')
      end if
      if (.not. tie%strain > tie%strength/tie%modulus) call problems%note(name//': its tie_strain = '// &
         & to_text(tie%strain)//' must be more than '//rounded(tie%strength/tie%modulus)//', at which it yields')
   end subroutine check_tie

end module dondolo_wall_ties
