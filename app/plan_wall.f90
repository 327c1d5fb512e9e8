!> What --check prints of walls and buildings: their static quantities, and for one wall what holds it and what ends its motion.
module dondolo_plan_wall
   use, intrinsic :: iso_fortran_env, only : output_unit
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_text, only : left, rounded, to_text
   use dondolo_building, only : building_type
   use dondolo_record, only : record_type
   use dondolo_wall, only : new_wall, wall_type
   use dondolo_wall_properties, only : wall_input_type
   use dondolo_wall_tabulated_model, only : chain_name, horizontal_name
   use dondolo_wall_tie_statics, only : greatest_acceleration, plastic_acceleration
   implicit none
   private

   public :: print_wall, print_head, print_row, print_body, print_building

contains

   !> Print one wall and its static quantities
   subroutine print_wall(wall)
      type(wall_type), intent(in) :: wall

      associate (width => max(len('wall'), len(wall%name())))
         call print_head(width)
         call print_row(wall, width)
      end associate
   end subroutine print_wall

   !> Print the head of the table of walls
   subroutine print_head(width)
      !> Width of the column of names
      integer, intent(in) :: width

      write (output_unit, '(a, a15, 5a11, a13)') left('wall', width), 'mechanism', 'height', 'thickness', 'trigger', &
         & 'p', 'capacity', 'restitution'
      write (output_unit, '(a, a15, 5a11, a13)') left('', width), '', 'm', 'm', 'g', 'rad/s', 'rad', 'e'
   end subroutine print_head

   !> Print a wall and its static quantities
   subroutine print_row(wall, width)
      type(wall_type), intent(in) :: wall
      !> Width of the column of names
      integer, intent(in) :: width

      character(len=11) :: thickness

      thickness = repeat(' ', len(thickness) - 1)//'-'
      if (wall%input%has('thickness')) write (thickness, '(f11.3)') wall%input%number('thickness')
      write (output_unit, '(a, a15, f11.3, a, f11.4, f11.4, f11.5, f13.4, a)') left(wall%name(), width), &
         & wall%mechanism_name(), wall%input%number('height'), thickness, &
         & wall%mechanism%trigger_acceleration()/wall%gravity, wall%mechanism%frequency_parameter(), &
         & wall%mechanism%capacity, wall%mechanism%restitution, trim(load_of(wall))
   end subroutine print_row

   !> The loads on a wall and where an overburden bears, and what governs if it is not the face
   pure function load_of(wall) result(text)
      type(wall_type), intent(in) :: wall
      !> Blanks and a few words, filled up with blanks; empty for a bare wall
      character(len=360) :: text

      real(wp) :: half, eccentricity

      text = ''
      associate (input => wall%input)
         if (size(input%list('load_total')) > 0) text = '  loads '//rounded(sum(input%list('load_total')))//' N'
         if (size(input%list('thrust_total')) > 0) text = trim(text)//'  thrusts '//rounded(sum(input%list('thrust_total')))//' N'
         if (size(input%list('load')) > 0) text = '  loads '//rounded(sum(input%list('load')))//' N/m'
         if (size(input%list('thrust')) > 0) text = trim(text)//'  thrusts '//rounded(sum(input%list('thrust')))//' N/m'
         if (wall%mechanism%ties > 0) text = trim(text)//'  ties '//rounded(sum( &
            & wall%mechanism%restraints(:wall%mechanism%ties)%strength))//' N'//trim(merge('  ', '/m', wall%model%is_whole))
         if (input%number('overburden') > 0.0_wp) then
            half = 0.5_wp*input%number('thickness')
            text = '  load '//rounded(input%number('overburden'))//' N/m'
            eccentricity = input%number('eccentricity')
            if (eccentricity < 0.0_wp) then
               text = trim(text)//', '//rounded(half + eccentricity)//' m from the inner face, folding outwards'
            else if (eccentricity > 0.0_wp) then
               text = trim(text)//', '//rounded(half - eccentricity)//' m from the outer face, folding outwards'
            else
               text = trim(text)//', on the centreline'
            end if
         end if
         if (input%number('leaves') > 1.0_wp) text = trim(text)//'  '//rounded(input%number('leaves'))//' leaves of '// &
            & rounded(input%number('thickness')/input%number('leaves'))//' m, one of which rocks'
         if (allocated(wall%building)) text = trim(text)//trim(building_summary(wall%building))
         if (wall%model%hinge_depth > 0.0_wp) text = trim(text)//'  hinge '//rounded(wall%model%hinge_depth)//' m deep'
         if (wall%mechanism%unseating < wall%mechanism%capacity) text = trim(text)//'  unseating at '// &
            & rounded(wall%mechanism%unseating)//' rad'
      end associate
   end function load_of

   !> Print the masonry, what acts on it, what holds it, and what ends its motion
   subroutine print_body(wall)
      type(wall_type), intent(in) :: wall

      type(lines_type) :: lines
      character(len=:), allocatable :: per
      real(wp) :: j, c, g, l, load
      integer :: i, colon

      call wall%model%describe(wall%input, wall%gravity, lines)
      do i = 1, lines%count
         associate (line => lines%line(i)%text)
            colon = index(line, ': ')
            call print_line(line(:colon - 1), line(colon + 2:))
         end associate
      end do
      call print_hinge(wall)
      if (allocated(wall%mechanism%restraints)) call print_ties(wall)
      if (wall%mechanism%joint%exists) call print_joint(wall)
      call wall%mechanism%terms(0.0_wp, j, c, g, l, load)
      per = trim(merge('  ', '/m', wall%model%is_whole))
      call print_line('trigger', rounded(wall%mechanism%trigger_acceleration()/wall%gravity)//' g: restoring moment '// &
         & rounded(g - load)//' N m'//per//' over excitation lever '//rounded(l)//' kg m'//per)
      associate (q => wall%mechanism%capacity)
         if (wall%mechanism%unseating < q) then
            call print_line('collapse', 'unseating governs: a load loses its seat at '//rounded(wall%mechanism%unseating)// &
               & ' rad, '//rounded(wall%mechanism%unseating/q)//' of the capacity')
         else
            call print_line('collapse', 'overturning governs: the restoring moment vanishes at '//rounded(q)//' rad')
         end if
      end associate
   end subroutine print_body

   !> Print how a wall bends before its joints open
   subroutine print_joint(wall)
      type(wall_type), intent(in) :: wall

      associate (joint => wall%mechanism%joint)
         call print_line('joints', 'bend at T_1 = '//rounded(joint%period)//' s, '//rounded(100.0_wp*joint%damping)// &
            & ' % of critical damping, '//rounded(joint%stiffness)//' N m/m per rad; they open at '// &
            & rounded(joint%opening/wall%mechanism%capacity)//' of the capacity, where S_a(T_1) reaches '// &
            & rounded(joint%opening_acceleration()/wall%gravity)//' g; a passage keeps e_0 = '//rounded(joint%restitution)// &
            & ' of the speed')
      end associate
   end subroutine print_joint

   !> Print the ties of a wall and the accelerations that it withstands with them
   subroutine print_ties(wall)
      type(wall_type), intent(in) :: wall

      character(len=:), allocatable :: per, place
      integer :: i, number

      number = 0
      per = trim(merge('  ', '/m', wall%model%is_whole))
      do i = 1, size(wall%mechanism%restraints)
         associate (tie => wall%mechanism%restraints(i))
            if (tie%is_friction) then
               call print_line('friction', rounded(tie%strength)//' N/m of transverse walls, '//rounded(tie%edge + tie%f)// &
                  & ' m high, gone at '//trim(rotation(tie%fracture)))
               cycle
            end if
            number = number + 1
            place = ', '//rounded(tie%edge + tie%f)//' m above the hinge'
            if (tie%along%exists()) place = ', lever '//rounded(tie%lever_at(0.0_wp))//' m'
            call print_line('tie', to_text(number)//place//': stiffness '//rounded(tie%stiffness)//' N'//per//' per m, at rest '// &
               & rounded(tie%preload)//' N'//per//', yields at '//rounded(tie%strength)//' N'//per//' and '// &
               & trim(rotation(tie%yield))//', breaks at '//trim(rotation(tie%fracture)))
         end associate
      end do
      call print_line('statics', 'first motion at '//rounded(wall%mechanism%trigger_acceleration()/wall%gravity)// &
         & ' g, greatest static acceleration '//rounded(greatest_acceleration(wall%mechanism)/wall%gravity)// &
         & ' g, rigid-plastic '//rounded(plastic_acceleration(wall%mechanism)/wall%gravity)//' g (alpha_0 of design)')
      if (.not. allocated(wall%building)) call print_line('anchors', 'at rest, as is what the wall leans on; a building '// &
         & '(&building) that moves both lowers theta')
   end subroutine print_ties

   !> A rotation that may never be reached
   pure function rotation(q) result(text)
      !> Rotation [rad]; huge: never
      real(wp), intent(in) :: q
      !> Filled up with blanks
      character(len=40) :: text

      text = 'no rotation'
      if (q < huge(q)) text = rounded(q)//' rad'
   end function rotation

   !> Print where the hinge is, and what its depth takes away
   subroutine print_hinge(wall)
      type(wall_type), intent(in) :: wall

      type(wall_type) :: uncrushed
      type(wall_input_type) :: input
      type(error_type), allocatable :: error

      ! The hinges of a chain are its joints.
      if (wall%mechanism_name() == chain_name) return
      if (wall%model%is_whole) then
         ! A corner has no hinge at its edge to compare with, and nothing but its strength gives that of horizontal bending.
         call print_line('hinge', rounded(wall%model%hinge_depth)//' m behind the '//trim(merge('faces', 'edge ', &
            & wall%mechanism_name() == horizontal_name))//', '//trim(merge('of crushed masonry', &
            & 'given             ', wall%input%has('compressive_strength'))))
      else if (.not. wall%model%hinge_depth > 0.0_wp) then
         call print_line('hinge', 'at the face: geometry governs, no crushing')
      else if (.not. wall%input%has('compressive_strength')) then
         call print_line('hinge', rounded(wall%model%hinge_depth)//' m behind the face, given')
      else
         input = wall%input
         call input%clear('compressive_strength')
         call input%clear('stress_block')
         call new_wall(uncrushed, input, error, wall%gravity)
         if (allocated(error)) return
         call print_line('hinge', rounded(wall%model%hinge_depth)//' m behind the face: crushing governs, trigger and capacity '// &
            & 'are '//rounded(wall%mechanism%trigger_acceleration()/uncrushed%mechanism%trigger_acceleration())//' and '// &
            & rounded(wall%mechanism%capacity/uncrushed%mechanism%capacity)//' of those about the face')
      end if
   end subroutine print_hinge

   !> Print a line of what there is to say of a wall
   subroutine print_line(what, text)
      !> What it is
      character(len=*), intent(in) :: what
      !> What there is to say
      character(len=*), intent(in) :: text

      write (output_unit, '(a)') '   '//left(what//':', max(10, len(what) + 2))//text
   end subroutine print_line

   !> Print the modes of a building, and the motions of its floor
   subroutine print_building(building, records)
      type(building_type), intent(in) :: building
      !> Motions of the ground
      type(record_type), intent(in) :: records(:)

      character(len=:), allocatable :: line
      real(wp), allocatable :: felt(:)
      integer :: parts(size(records)), i

      felt = building%felt()
      do i = 1, size(building%period)
         line = '   building: mode '//to_text(i)//', period '//rounded(building%period(i))//' s ('// &
            & rounded(1.0_wp/building%period(i))//' Hz), damping '//rounded(building%damping(i))//', participation '// &
            & rounded(building%participation(i))
         if (building%share > 0.0_wp) line = line//' at the base, '//rounded(building%participation_top(i))// &
            & ' at the top, of which the wall feels '//rounded(felt(i))
         write (output_unit, '(a)') line
      end do
      if (building%share > 0.0_wp) call print_supports(building)
      parts = [(building%parts(records(i)%dt), i=1, size(records))]
      line = '   floor:    each step of a record in '//to_text(minval(parts))
      if (maxval(parts) > minval(parts)) line = line//' to '//to_text(maxval(parts))
      line = line//trim(merge(' part ', ' parts', maxval(parts) == 1))
      if (building%refine == 0) then
         line = line//' (refine = 0: as many as the shortest period needs)'
      else
         line = line//' (refine = '//to_text(building%refine)//')'
      end if
      write (output_unit, '(a)') line//'; after each record '//rounded(building%free_vibration())//' s of free vibration, '// &
         & 'the longest motion lasts '//rounded(maxval([(records(i)%duration(), i=1, size(records))]) &
         & + building%free_vibration())//' s'
   end subroutine print_building

   !> Print what the wall feels of its supports
   subroutine print_supports(building)
      type(building_type), intent(in) :: building

      associate (diaphragm => building%diaphragm)
         if (diaphragm%period > 0.0_wp) write (output_unit, '(a)') '   diaphragm: period '//rounded(diaphragm%period)// &
            & ' s, damping '//rounded(diaphragm%damping)//', participation '//rounded(diaphragm%participation)// &
            & ', at the top of the wall'
      end associate
      write (output_unit, '(a)') '   supports: '//rounded(building%height)//' m apart; the wall feels '// &
         & rounded(building%share)//' of the acceleration of its top relative to its base, less '//rounded(building%tilt)// &
         & ' 1/s2 times the relative displacement'
   end subroutine print_supports

   !> The building of a row of a population in a few words, filled up with blanks
   pure function building_summary(building) result(text)
      type(building_type), intent(in) :: building
      character(len=160) :: text

      integer :: i

      text = '  on a building: period'
      do i = 1, size(building%period)
         text = trim(text)//trim(merge(' ', ',', i == 1))//' '//rounded(building%period(i))
      end do
      text = trim(text)//' s, participation'
      do i = 1, size(building%period)
         text = trim(text)//trim(merge(' ', ',', i == 1))//' '//rounded(building%participation(i))
      end do
   end function building_summary

end module dondolo_plan_wall
