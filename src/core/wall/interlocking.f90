!> Friction between a wall and the transverse walls whose stones interlock with it.
!>
!> Of n courses of height h_b every stone overlaps the stones of the transverse wall by l; the masonry above presses the
!> overlaps together. Circolare 7/2019 has for a transverse wall of thickness t_s and weight w per volume
!>
!>     F = 0.4 n (n + 1) (h_b/l) mu l^2 t_s w      at h/3,
!>
!> eight tenths of what all courses could give. It resists only a motion to new rotations, and falls in proportion to the overlap
!> that is left: F (1 - D/l), D the travel at h/3 (docs/theory.md, section 2).
module dondolo_wall_interlocking
   use dondolo_base_error, only : not_given, out_of_range, problems_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_settings, only : settings_type
   use dondolo_base_text, only : to_text
   use dondolo_wall_restraint, only : new_friction, restraint_type
   use dondolo_wall_rigid_body, only : faces_at, same, section_type
   implicit none
   private

   public :: read_interlocking

   !> What belongs together; the last may be left out
   character(len=*), parameter :: names(5) = [character(len=19) :: 'interlock_overlap', 'interlock_course', &
      & 'interlock_thickness', 'interlock_spacing', 'interlock_friction']

contains

   !> Add the friction of the transverse walls to the ties of a wall
   subroutine read_interlocking(input, sections, gravity, hinge, edge, problems, restraints)
      !> Settings of the wall, ranges checked
      class(settings_type), intent(in) :: input
      !> Its storeys
      type(section_type), intent(in) :: sections(:)
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> Depth of the hinge, and radius of the edge [m]
      real(wp), intent(in) :: hinge, edge
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems
      !> Its ties; out: and the friction after them
      type(restraint_type), allocatable, intent(inout) :: restraints(:)

      type(restraint_type), allocatable :: more(:)
      real(wp) :: tall, faces(2), friction, force
      logical :: given(size(names))
      integer :: i

      given = [(input%has(trim(names(i))), i=1, size(names))]
      if (.not. any(given)) return
      do i = 1, size(names) - 1
         if (.not. given(i)) call problems%note(trim(names(i))//': must be given with '// &
            & trim(names(findloc(given, .true., dim=1))), not_given, trim(names(i)))
      end do
      if (.not. all(given(:size(names) - 1))) return
      tall = sum(sections%height)
      if (input%number('interlock_course') > tall*(1.0_wp + same)) call problems%note('interlock_course = '// &
         & to_text(input%number('interlock_course'))//': must be at most '//to_text(tall)//' m, the height of the wall', &
         & out_of_range, 'interlock_course')
      friction = input%absent('interlock_friction')
      if (input%has('interlock_friction')) friction = input%number('interlock_friction')
      force = friction_force(tall, input%number('interlock_course'), input%number('interlock_overlap'), &
         & input%number('interlock_thickness'), friction, gravity*input%number('density'))/input%number('interlock_spacing')
      faces = faces_at(sections, tall/3.0_wp)
      allocate (more(size(restraints) + 1))
      more(:size(restraints)) = restraints
      more(size(more)) = new_friction(faces(2), tall/3.0_wp, force, input%number('interlock_overlap'), hinge, edge)
      call move_alloc(more, restraints)
   end subroutine read_interlocking

   !> Friction that one transverse wall can give [N]
   pure real(wp) function friction_force(tall, course, overlap, thickness, friction, weight) result(force)
      !> Heights of the wall and of a course [m]
      real(wp), intent(in) :: tall, course
      !> Overlap and thickness of the transverse wall [m]
      real(wp), intent(in) :: overlap, thickness
      !> Coefficient of friction, and weight of the masonry [N/m3]
      real(wp), intent(in) :: friction, weight

      real(wp), parameter :: share = 0.4_wp
      real(wp) :: courses

      ! Whole courses; a height that is their multiple but for rounding has them all.
      courses = aint(tall/course*(1.0_wp + same))
      force = share*courses*(courses + 1.0_wp)*course*overlap*friction*thickness*weight
   end function friction_force

end module dondolo_wall_interlocking
