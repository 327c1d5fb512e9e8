!> Every row of every table of properties: has all that a reader of messages and templates needs, keeps its value from a
!> namelist to what is computed and back, and is refused in one line where it is out of range.
program test_properties
   use dondolo_case_check_group, only : read_check_group
   use dondolo_check_input, only : check_input_type, check_properties, put_check
   use checks, only : check, check_close, check_error, check_ok, check_text, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_property, only : check_number, check_word, choices_length, find_property, has_owner, hint_of, is_integer, &
      & is_list, is_logical, is_many, is_number_or_name, is_text, is_words, no_limit, number_of_choices, number_of_words, &
      & property_type, word_of
   use dondolo_base_settings, only : group_settings_type, new_settings
   use dondolo_base_text, only : to_text
   use dondolo_case_echo, only : echo_type
   use dondolo_case_history_group, only : history_input_type, read_history_group
   use dondolo_case_job_group, only : job_type, read_job, task_names
   use dondolo_case_namelist, only : namelist_type, read_namelist
   use dondolo_case_namelist_group, only : group_type
   use dondolo_case_population_group, only : put_population, read_population_group
   use dondolo_case_property_tables, only : property_table, table_names
   use dondolo_case_records_group, only : read_records_group, records_input_type
   use dondolo_case_settings_group, only : echo_settings, read_settings, read_values
   use dondolo_case_solver_group, only : read_solver_group, solver_input_type
   use dondolo_case_stripes_group, only : check_states, read_stripes_group, stripes_input_type
   use dondolo_case_uncertainty_group, only : read_uncertainty_group
   use dondolo_population_variants, only : base_wall_type
   use dondolo_wall, only : mechanism_names, new_wall, wall_type
   use dondolo_wall_properties, only : is_beyond_bare, wall_input_type
   implicit none

   character(len=*), parameter :: path = 'test_properties.nml'
   integer :: k

   do k = 1, size(table_names)
      call test_rows(trim(table_names(k)))
      call test_reading(trim(table_names(k)))
      call test_way(trim(table_names(k)))
   end do
   call test_walls()
   call test_unknown()
   call test_hints()
   call remove(path)
   call finish()

contains

   !> What a row says is whole and does not contradict itself
   subroutine test_rows(name)
      character(len=*), intent(in) :: name

      type(property_type), allocatable :: table(:)
      character(len=:), allocatable :: allowed, what
      integer :: i, m

      call suite('rows of '//name)
      table = property_table(name)
      call check(size(table) > 0, 'there are rows')
      do i = 1, size(table)
         what = trim(table(i)%name)
         associate (property => table(i))
            call check(find_property(table, what) == i, what//': once')
            call check(len_trim(property%meaning) > 5, what//': has a meaning')
            call check(any(property%unit == [character(len=8) :: '', 'm', 's', 'g', 'kg/m3', 'N', 'N/m', 'N/m2', 'm/s2', 'N/m3', &
               & 'kg/m', 'kg m2/m', 'Pa', 'm2/m', 'rad', 'rad/s', 'kg m/m', 'N m/m', '1/s2', 'year', 'deg']), what//': its unit')
            call check(.not. (property%required .and. property%optional), what//': required or optional')
            if (property%required .or. property%optional) then
               call check(len_trim(property%example) > 0 .or. name == 'wall', what//': an example for the template')
            end if
            call check(property%smallest <= property%largest, what//': a range')
            call check(len_trim(property%not_with) > 0 .or. len_trim(property%because) == 0, what//': a reason for nothing')
            do m = 1, number_of_words(property%not_with)
               call check(property%optional, what//': optional')
               associate (other => find_property(table, trim(word_of(property%not_with, m))))
                  call check(other > 0 .and. other /= i, what//': not with a property of the table')
                  if (other > 0) call check(table(other)%optional, what//': not with one that is optional')
               end associate
            end do
            if (number_of_choices(property%choices) > 0) call check(any(property%kind == [is_text, is_words]), &
               & what//': choices of a text')
            do m = 1, number_of_choices(property%owners)
               call check(any(property%owners(m) == mechanism_names) .or. any(property%owners(m) == task_names), &
                  & what//': its owner '//trim(property%owners(m)))
            end do
            if (property%required .or. property%optional) cycle
            if (property%kind == is_text) then
               call check_word(property, trim(property%word), allowed)
            else
               call check_number(property, property%default, allowed)
            end if
            call check(.not. allocated(allowed), what//': its default lies in its range')
         end associate
      end do
   end subroutine test_rows

   !> A reader takes a value of each property, and refuses what it cannot be in one line with its place
   subroutine test_reading(name)
      character(len=*), intent(in) :: name

      type(property_type), allocatable :: table(:)
      type(group_settings_type) :: settings
      type(error_type), allocatable :: error
      character(len=:), allocatable :: what, text
      integer :: i

      call suite('reading of '//name)
      table = property_table(name)
      do i = 1, size(table)
         what = trim(table(i)%name)
         associate (property => table(i))
            call make_value(property, text)
            call read_alone(name, property, text, settings, error)
            call check_ok(error, what//' = '//text)
            if (allocated(error)) cycle
            call check(settings%has(what), what//': has a value')
            if (any(property%kind == [is_text, is_words]) .and. number_of_choices(property%choices) > 0 &
               & .and. .not. property%checked_by_owner) call refuse(name, property, '''nonsense''', 'must be one of ')
            if (property%kind == is_text) cycle
            if (is_many(property%kind)) cycle
            call refuse(name, property, '''nonsense'', 1', 'must be')
            if (property%kind == is_logical) cycle
            if (property%positive) call refuse(name, property, '0', 'must be positive')
            if (property%smallest > -no_limit .and. .not. property%positive) then
               call refuse(name, property, to_text(nint(property%smallest) - 1), 'must ')
            end if
            if (property%largest < 1.0e9_wp) call refuse(name, property, to_text(nint(property%largest) + 1), 'must ')
         end associate
      end do
   end subroutine test_reading

   !> Values that are plausible in another unit are refused, or warned of, with that unit
   subroutine test_hints()
      call suite('units of implausible values')
      call hint('height', 2700.0_wp, 'is it in millimetres?')
      call hint('height', 270.0_wp, 'is it in centimetres?')
      call hint('thickness', 380.0_wp, 'is it in millimetres?')
      call hint('thickness', 38.0_wp, 'is it in centimetres?')
      call hint('section_height', 3500.0_wp, 'is it in millimetres?')
      call hint('load_depth', 175.0_wp, 'is it in millimetres?')
      call hint('hinge_depth', 2.0_wp, 'is it in centimetres?')
      call hint('tie_area', 78.5_wp, 'is it in mm2 per metre of wall?')
      call hint('tie_area', 0.785_wp, 'is it in cm2 per metre of wall?')
      call hint('tie_modulus', 2.1e5_wp, 'is it in MPa?')
      call hint('tie_modulus', 210.0_wp, 'is it in GPa?')
      call hint('tie_strength', 235.0_wp, 'is it in MPa?')
      call hint('compressive_strength', 3.2_wp, 'is it in MPa?')
      call hint('compressive_strength', 3200.0_wp, 'is it in kPa?')
      call hint('load', 8.5_wp, 'is it in kN/m?')
      call hint('thrust', 1.2_wp, 'is it in kN/m?')
      call hint('load_total', 6.0_wp, 'is it in kN?')
      call hint('spring', 45.0_wp, 'is it in kN/m2?')
      call hint('distributed_spring', 25.0_wp, 'is it in kN/m3?')
      call hint('mass', 1.4_wp, 'is it in t/m?')
      call hint('inertia_mass', 0.7_wp, 'is it in t/m?')
      call hint('hinge_inertia', 4.1_wp, 'is it in t m2/m?')
      call hint('density', 17.5_wp, 'is it in kN/m3 or t/m3?')
      call hint('interlock_friction', 30.0_wp, 'is it an angle, or in per cent?')
      call hint('hinge', 60.0_wp, 'is it in per cent?')
      call hint('wedge_angle', 0.35_wp, 'is it in radians?')
      call hint('restitution_value', 88.0_wp, 'is it in per cent?')
      call hint('restitution_factor', 87.0_wp, 'is it in per cent?')
      call hint('section_fill', 80.0_wp, 'is it in per cent?')
      call hint('period', 3.5_wp, 'is it in Hz, a frequency?', 'building')
      call hint('period', 280.0_wp, 'is it in milliseconds?', 'building')
      call hint('damping', 5.0_wp, 'is it in per cent?', 'building')
      call hint('participation', 130.0_wp, 'is it in per cent?', 'building')
      call hint('ag', 2.4_wp, 'is it in m/s2?', 'check')
      call hint('ag', 24.0_wp, 'is it in per cent of g?', 'check')
      call hint('ag', 240.0_wp, 'is it in cm/s2?', 'check')
      call hint('tc_star', 350.0_wp, 'is it in milliseconds?', 'check')
      ! Plausible, or implausible in any unit
      call hint('height', 3.0_wp, '')
      call hint('height', -3.0_wp, '')
      call hint('height', 1.0e9_wp, '')
      call hint('leaves', 300.0_wp, '')
   end subroutine test_hints

   !> The question that is asked of a value, also by the refusal of one beyond the range
   subroutine hint(name, value, question, group)
      !> Property
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: value
      !> Empty: none
      character(len=*), intent(in) :: question
      !> Table; that of walls if absent
      character(len=*), intent(in), optional :: group

      type(property_type), allocatable :: table(:)
      character(len=:), allocatable :: allowed
      type(property_type) :: property

      if (present(group)) then
         table = property_table(group)
      else
         table = property_table('wall')
      end if
      property = table(find_property(table, name))
      call check_text(trim(hint_of(property, value)), question, name//' = '//to_text(value))
      call check_number(property, value, allowed)
      if (.not. allocated(allowed) .or. len(question) == 0) return
      call check(index(allowed, ': '//question) > 0, name//' = '//to_text(value)//': '//allowed)
   end subroutine hint

   !> A value that must be refused
   subroutine refuse(name, property, text, sentence)
      character(len=*), intent(in) :: name, text, sentence
      type(property_type), intent(in) :: property

      type(group_settings_type) :: settings
      type(error_type), allocatable :: error

      call read_alone(name, property, text, settings, error)
      call check_error(error, path//': &'//name//': '//trim(property%name)//' = ', trim(property%name)//' = '//text)
      if (.not. allocated(error)) return
      call check(index(error%message, sentence) > 0, trim(property%name)//' = '//text//': '//error%message)
      call check(index(error%message, new_line('a')) == 0, trim(property%name)//' = '//text//': one line')
      call check(index(error%message, '(line 2)') > 0, trim(property%name)//' = '//text//': the line')
   end subroutine refuse

   !> Read a group with one property in line 2, and what must be given besides it
   subroutine read_alone(name, property, text, settings, error)
      character(len=*), intent(in) :: name, text
      type(property_type), intent(in) :: property
      type(group_settings_type), intent(out) :: settings
      type(error_type), allocatable, intent(out) :: error

      type(property_type), allocatable, target, save :: table(:)
      type(group_type) :: group

      table = property_table(name)
      call new_settings(settings, table)
      call write_group(name, table, property, text)
      call get_group(name, group, error)
      if (.not. allocated(error)) call read_settings(group, settings, error)
   end subroutine read_alone

   !> Write a group with one property in line 2, and what must be given besides it
   subroutine write_group(name, table, property, text)
      character(len=*), intent(in) :: name, text
      type(property_type), intent(in) :: table(:), property

      character(len=*), parameter :: of_place(3) = [character(len=12) :: 'latitude', 'longitude', 'nominal_life'], &
         & of_hazard(3) = [character(len=7) :: 'ag', 'f0', 'tc_star']
      character(len=:), allocatable :: other
      integer :: i, unit

      open (newunit=unit, file=path, action='write', status='replace')
      write (unit, '(a)') '&'//name
      write (unit, '(a)') trim(property%name)//' = '//text
      do i = 1, size(table)
         if (table(i)%name == property%name) cycle
         ! A check has a hazard, or a place, which has those of all limit states
         if (name == 'check' .and. (any(property%name == of_place) .or. property%name == 'ultimate_state')) then
            if (.not. any(table(i)%name == of_place)) cycle
         else if (.not. table(i)%required .and. .not. (name == 'check' .and. any(table(i)%name == of_hazard))) then
            cycle
         end if
         call make_value(table(i), other)
         write (unit, '(a)') trim(table(i)%name)//' = '//other
      end do
      if (property%name == 'building_damping') write (unit, '(a)') 'building_period = 0.3'
      if (any(property%name == [character(len=8) :: 'first', 'last', 'count'])) then
         if (property%name /= 'first') write (unit, '(a)') 'first = 0.1'
         if (property%name /= 'last') write (unit, '(a)') 'last = 4'
         if (property%name /= 'count') write (unit, '(a)') 'count = 3'
      else if (name == 'stripes' .and. property%name /= 'levels') then
         write (unit, '(a)') 'levels = 0.1, 0.2'
      else if (name == 'uncertainty' .and. property%kind == is_integer) then
         write (unit, '(a)') 'hinge = ''uniform(0.5, 0.6)'''
      else if (property%name == 'reference_life') then
         write (unit, '(a)') 'exceedance = 0.6, 0.3, 0.2'
      else if (property%name == 'exceedance') then
         write (unit, '(a)') 'reference_life = 50'
      else if (property%name == 'vertical_factor') then
         write (unit, '(a)') 'vertical = ''recorded'''
      end if
      write (unit, '(a)') '/'
      close (unit)
   end subroutine write_group

   !> The group of the file
   subroutine get_group(name, group, error)
      character(len=*), intent(in) :: name
      type(group_type), intent(out) :: group
      type(error_type), allocatable, intent(out) :: error

      type(namelist_type) :: namelist

      call read_namelist(path, namelist, error)
      if (.not. allocated(error)) group = namelist%group(name)
   end subroutine get_group

   !> A value that a property can have and that is not its default, as it stands in a namelist
   subroutine make_value(property, text)
      type(property_type), intent(in) :: property
      character(len=:), allocatable, intent(out) :: text

      select case (property%kind)
      case (is_text, is_words)
         text = '''else'''
         if (property%name == 'im') text = '''pgv'''
         if (number_of_choices(property%choices) > 0) then
            text = ''''//trim(property%choices(number_of_choices(property%choices)))//''''
         end if
      case (is_logical)
         text = '.true.'
      case (is_list)
         text = '0.15, 0.25'
         ! Of a tie: section, modulus, yield stress, and a strain beyond that at yield
         if (property%name == 'tie_area') text = '5.0E-5, 6.0E-5'
         if (property%name == 'tie_bar') text = '0.015, 0.025'
         if (property%name == 'tie_spacing') text = '1.5, 2.5'
         if (property%name == 'tie_modulus') text = '2.1E+11, 2.2E+11'
         if (property%name == 'tie_strength') text = '1.8E+8, 2.0E+8'
         ! Depths are measured from the lowest section
         if (property%name == 'section_offset') text = '0.0, 0.25'
         ! One for all limit states
         if (any(property%name == [character(len=8) :: 'ag', 'tc_star'])) text = '0.25'
         if (property%name == 'f0') text = '2.5'
         if (index(property%name, 'building_') == 1) text = '0.15'
         if (property%name == 'exceedance') text = '0.6, 0.3, 0.2'
      case (is_integer, is_number_or_name)
         text = '3'
         ! As many as the indices of one property need
         if (property%name == 'variants') text = '60'
         if (property%name == 'sides') text = '2'
      case default
         text = to_text(0.9_wp*property%default + 0.1_wp*min(property%largest, 2.0_wp*property%default + 1.0_wp))
         if (property%required .or. property%optional) text = '0.2'
         if (property%name == 'masonry_knowledge_factor') text = '1.2'
         if (property%name == 'latitude') text = '43.5'
         if (property%name == 'longitude') text = '12.5'
         ! A speed ratio must stay below 1
         if (property%name == 'restitution_factor') text = '0.8'
         ! The hinge must lie in the wall
         if (property%name == 'compressive_strength') text = '2e6'
      end select
   end subroutine make_value

   !> The value of each property goes all the way: from a group to what is computed, and back to an echo and a key
   subroutine test_way(name)
      character(len=*), intent(in) :: name

      type(property_type), allocatable :: table(:)
      type(group_settings_type) :: settings
      type(echo_type) :: said
      type(lines_type) :: lines
      type(group_type) :: group
      type(error_type), allocatable :: error
      character(len=:), allocatable :: text, what, echo
      integer :: i, j

      if (any(name == [character(len=8) :: 'wall', 'building', 'row'])) return
      call suite('way of '//name)
      table = property_table(name)
      do i = 1, size(table)
         what = trim(table(i)%name)
         ! They become levels
         if (any(what == [character(len=8) :: 'first', 'last', 'count'])) cycle
         call make_value(table(i), text)
         if (name == 'uncertainty' .and. table(i)%kind == is_text) text = ''''//trim(table(i)%example)//''''
         call write_group(name, table, table(i), text)
         call get_group(name, group, error)
         if (.not. allocated(error)) call through(name, group, settings, error)
         call check_ok(error, what//' = '//text)
         if (allocated(error)) cycle
         said = echo_type()
         call echo_settings(name, settings, said)
         lines = lines_type()
         call said%to_namelist(lines)
         echo = ''
         do j = 1, lines%count
            echo = echo//lines%line(j)%text//' '
         end do
         call check(index(echo, what//' = '//text) > 0, what//' = '//text//' in '//echo)
      end do
   end subroutine test_way

   !> A group to what is computed and back
   subroutine through(name, group, settings, error)
      character(len=*), intent(in) :: name
      type(group_type), intent(in) :: group
      type(group_settings_type), intent(out) :: settings
      type(error_type), allocatable, intent(out) :: error

      type(job_type) :: job
      type(records_input_type) :: records
      type(stripes_input_type) :: stripes
      type(solver_input_type) :: solver
      type(history_input_type) :: history
      type(check_input_type), allocatable :: check_by_code
      type(base_wall_type) :: wall
      character(len=:), allocatable :: file
      character(len=choices_length) :: occurrence
      logical :: designs

      select case (name)
      case ('job')
         call read_job(group, job, error)
         if (.not. allocated(error)) call job%put(settings)
      case ('population')
         call read_population_group(group, file, occurrence, designs, error)
         if (.not. allocated(error)) call put_population(file, occurrence, designs, settings)
      case ('records')
         call read_records_group(group, records, error)
         if (.not. allocated(error)) call records%put(settings)
      case ('stripes')
         call read_stripes_group(group, stripes, error)
         if (.not. allocated(error)) call check_states(stripes, 1.0_wp, error)
         if (.not. allocated(error)) call stripes%put(settings)
      case ('solver')
         call read_solver_group(group, solver, error)
         if (.not. allocated(error)) call solver%put(settings)
      case ('history')
         call read_history_group(group, history, error)
         if (.not. allocated(error)) call history%put(settings)
      case ('uncertainty')
         call read_uncertainty_group(group, wall, settings, error)
      case ('check')
         call read_check_group(group, check_by_code, error)
         if (allocated(error)) return
         call new_settings(settings, check_properties)
         call put_check(check_by_code, settings)
      end select
   end subroutine through

   !> A wall keeps what is said of it, and has only what its mechanism has
   subroutine test_walls()
      type(property_type), allocatable :: table(:)
      type(wall_input_type) :: input
      type(wall_type) :: wall
      type(error_type), allocatable :: error
      type(group_type) :: group
      character(len=:), allocatable :: text, what
      integer :: i, j, m

      call suite('walls')
      table = property_table('wall')
      do m = 1, size(mechanism_names)
         do i = 1, size(table)
            what = trim(table(i)%name)
            ! What a wall that rocks to both sides carries stands in its middle: test_loaded_block
            if (what == 'mechanism' .or. (is_beyond_bare(i) .and. mechanism_names(m) == 'free_standing')) cycle
            ! Readers put what is in the file in its place
            if (any(what == [character(len=7) :: 'table', 'bodies', 'joints', 'actions', 'ties'])) cycle
            call make_value(table(i), text)
            if (what == 'restitution') text = '''default'''
            call write_group('wall', table(:0), table(i), text)
            call get_group('wall', group, error)
            input = wall_input_type()
            call read_values(group, input, error)
            call check_ok(error, what)
            call input%set('mechanism', trim(mechanism_names(m)))
            if (has_owner(table(i), trim(mechanism_names(m))) .and. (mechanism_names(m) == 'one_sided' .or. &
               & (mechanism_names(m) == 'two_block' .and. is_beyond_bare(i) .and. what /= 'hinge') .or. &
               & any(what == [character(len=12) :: 'overburden', 'stress_block']))) call complete(input, what)
            do j = 1, size(table)
               if (input%has('section_height') .and. any(table(j)%name == [character(len=9) :: 'height', 'thickness'])) cycle
               if (table(j)%required .and. has_owner(table(j), trim(mechanism_names(m))) .and. .not. &
                  & input%has(table(j)%name)) call input%set(table(j)%name, merge(3.0_wp, 0.5_wp, table(j)%name == 'height'))
            end do
            if (mechanism_names(m) == 'corner') call complete_corner(input, what)
            if (mechanism_names(m) == 'tabulated') call complete_table(input)
            if (mechanism_names(m) == 'chain') call complete_chain(input)
            if (mechanism_names(m) == 'horizontal') call complete_band(input, what)
            ! Less than walls of each mechanism allow, and what its seed is for
            if (index(what, 'restitution_s') == 1) call input%set('restitution_sd', 0.02_wp)
            if (what == 'elastic_damping' .and. mechanism_names(m) == 'two_block') call input%set('elastic_period', 0.05_wp)
            if (what == 'bearing') call input%set('bearing', 'centre')
            if (what == 'bearing_distance') call input%set('bearing', 'inner')
            call new_wall(wall, input, error)
            if (has_owner(table(i), trim(mechanism_names(m)))) then
               call check_ok(error, trim(mechanism_names(m))//' with '//what)
               if (allocated(error)) cycle
               call check(wall%input%has(what) .neqv. table(i)%replaced, what//': kept')
               if (table(i)%kind == is_text .or. is_many(table(i)%kind) .or. table(i)%replaced) cycle
               call check_close(wall%input%number(what), input%number(what), 0.0_wp, what)
            else
               call check_error(error, what//' = ', trim(mechanism_names(m))//' with '//what)
               if (allocated(error)) call check(index(error%message, 'only for mechanism = ') > 0, error%message)
            end if
         end do
      end do
   end subroutine test_walls

   !> Give the wings of a corner and its hinge, and what goes with a property of its loads and thrusts
   subroutine complete_corner(input, what)
      type(wall_input_type), intent(inout) :: input
      character(len=*), intent(in) :: what

      character(len=*), parameter :: names(7) = [character(len=13) :: 'load_total', 'load_depth', 'load_height', 'thrust_total', &
         & 'thrust_height', 'tie_height', 'tie_length']
      integer :: i

      if (.not. input%has('wing_angle')) call input%set('wing_angle', 20.0_wp)
      if (.not. any(what == [character(len=20) :: 'hinge_depth', 'compressive_strength', 'stress_block'])) then
         call input%set('hinge_depth', 0.02_wp)
      end if
      if (what == 'hinge_level') call input%set('hinge_level', [0.4_wp])
      ! One that is as low as it is thick does not bounce off by itself.
      if (what == 'height') call input%set('restitution_value', 0.5_wp)
      do i = 1, size(names)
         if (names(i)(:index(names(i), '_')) /= what(:index(what, '_')) .or. input%has(trim(names(i)))) cycle
         call input%set(trim(names(i)), [0.4_wp, 0.4_wp])
      end do
      if (index(what, 'tie_') == 1 .and. what /= 'tie_bar') call input%set('tie_bar', [0.02_wp, 0.02_wp])
      if (index(what, 'load_') /= 1) return
      if (what == 'load_lifted') call input%set('load_pushed', [0.4_wp, 0.4_wp])
      if (what == 'load_pushed') call input%set('load_lifted', [0.4_wp, 0.4_wp])
      if (.not. (input%has('load_lifted') .or. input%has('load_inertia'))) call input%set('load_inertia', 'both')
   end subroutine complete_corner

   !> Give the terms of a tabulated wall, and what belongs to them
   subroutine complete_table(input)
      type(wall_input_type), intent(inout) :: input

      real(wp), parameter :: q(*) = [0.0_wp, 0.02_wp, 0.04_wp, 0.06_wp, 0.08_wp, 0.1_wp]

      call input%set('rotation', q)
      call input%set('inertia', spread(1000.0_wp, 1, size(q)))
      call input%set('lever', spread(500.0_wp, 1, size(q)))
      call input%set('moment', 800.0_wp - 1.0e4_wp*q)
      if (any([input%has('weight'), input%has('displacement'), input%has('travel'), input%has('weighted_lever')])) then
         ! What checks need belongs together
         call input%set('weight', [4905.0_wp])
         call input%set('displacement', [1.0_wp])
         call input%set('travel', q)
         if (input%has('weighted_lever')) call input%set('weighted_lever', spread(4905.0_wp, 1, size(q)))
      end if
      if (input%has('vertical_lever')) call input%set('vertical_lever', 80.0_wp - 1.0e3_wp*q)
      if (.not. input%has('sides')) call input%set('sides', 2.0_wp)
      if (.not. input%has('restitution_value')) call input%set('restitution_value', 0.5_wp)
      if (input%has('top_share')) call input%set('top_tilt', 3.0_wp)
      if (input%has('top_tilt') .and. .not. input%has('top_share')) call input%set('top_share', 0.5_wp)
   end subroutine complete_table

   !> Give what holds a wall that bends horizontally, and what goes with a push
   subroutine complete_band(input, what)
      type(wall_input_type), intent(inout) :: input
      character(len=*), intent(in) :: what

      ! Its height is its length, however it is given.
      if (what == 'height') call input%set('length', input%number('height'))
      if (what /= 'height') call input%clear('height')
      if (.not. input%has('length')) call input%set('length', 4.0_wp)
      if (.not. input%has('end_thrust')) call input%set('end_thrust', 25.0e3_wp)
      if (what == 'stress_block') then
         call input%set('compressive_strength', 1.5e6_wp)
      else if (.not. (input%has('hinge_depth') .or. input%has('compressive_strength'))) then
         call input%set('hinge_depth', 0.02_wp)
      end if
      if (input%has('push') .and. .not. input%has('push_x')) call input%set('push_x', 1.5_wp + 0.0_wp*input%list('push'))
      if (input%has('push_x') .and. .not. input%has('push')) call input%set('push', 100.0_wp + 0.0_wp*input%list('push_x'))
      if (.not. input%has('sides')) call input%set('sides', 1.0_wp)
      if (.not. input%has('restitution_value')) call input%set('restitution_value', 0.5_wp)
   end subroutine complete_band

   !> Give the rows of a chain: a block with a load
   subroutine complete_chain(input)
      type(wall_input_type), intent(inout) :: input

      call input%set('body_table', [1.0_wp, 1.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.2_wp, 1.5_wp, 1350.0_wp, 1020.0_wp, 0.0_wp, 0.0_wp])
      call input%set('joint_table', [2.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp])
      if (input%has('action_table')) call input%set('action_table', [1.0_wp, 0.2_wp, 3.0_wp, 4.0e3_wp, 1.0_wp, 1.0_wp, 0.0_wp, &
         & 0.0_wp, 0.0_wp, 0.0_wp])
      if (input%has('tie_table')) call input%set('tie_table', [1.0_wp, 0.0_wp, 0.0_wp, 3.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 2.0e-4_wp, &
         & 6.0_wp, 2.06e11_wp, 1.8e8_wp, 0.0_wp, 0.02_wp, 0.0_wp])
      if (input%has('driver')) call input%set('driver', 1.0_wp)
      if (.not. input%has('sides')) call input%set('sides', 2.0_wp)
      if (.not. input%has('restitution_value')) call input%set('restitution_value', 0.5_wp)
   end subroutine complete_chain

   !> Give what must be given with a property
   subroutine complete(input, what)
      type(wall_input_type), intent(inout) :: input
      character(len=*), intent(in) :: what

      character(len=*), parameter :: names(20) = [character(len=20) :: 'section_height', 'section_thickness', &
         & 'mass', 'centroid_depth', 'centroid_height', 'hinge_inertia', 'stress_block', 'compressive_strength', &
         & 'load', 'load_depth', 'load_height', 'inertia_mass', 'inertia_depth', 'inertia_height', 'thrust', &
         & 'thrust_height', 'spring', 'spring_depth', 'spring_height', 'distributed_spring']
      integer :: i

      select case (what)
      case ('overburden')
         call input%set('overburden_inertia', 0.5_wp)
      case ('hinge_level')
         ! Several are for a population: test_facade
         call input%set('hinge_level', [0.4_wp])
      case ('hinge_at')
         call input%set('section_height', [2.0_wp])
         call input%set('section_thickness', [0.4_wp])
      case ('tie_bar', 'tie_spacing', 'tie_plate_width', 'tie_plate_height', 'tie_plate_diameter', 'tie_plate_thickness', &
         & 'tie_leaf', 'tie_compression', 'masonry_compression', 'masonry_shear', 'masonry_tension', 'masonry_friction', &
         & 'masonry_knowledge_factor', 'bearing_factor')
         call complete_plate(input, what)
      case ('tie_height', 'tie_depth', 'tie_area', 'tie_length', 'tie_modulus', 'tie_strength', 'tie_preload', 'tie_strain', &
         & 'tie_anchor_force')
         if (what /= 'tie_height') call input%set('tie_height', [0.4_wp, 0.5_wp])
         if (what /= 'tie_area') call input%set('tie_area', [5.0e-5_wp])
         if (what /= 'tie_length') call input%set('tie_length', [8.0_wp])
      case ('interlock_overlap', 'interlock_course', 'interlock_thickness', 'interlock_spacing', 'interlock_friction')
         if (what /= 'interlock_overlap') call input%set('interlock_overlap', 0.12_wp)
         if (what /= 'interlock_course') call input%set('interlock_course', 0.1_wp)
         if (what /= 'interlock_thickness') call input%set('interlock_thickness', 0.3_wp)
         if (what /= 'interlock_spacing') call input%set('interlock_spacing', 5.0_wp)
      case ('facade_length', 'wedge_thickness', 'wedge_angle', 'wedge_bottom', 'wedge_top', 'wedge_length')
         if (what /= 'facade_length') call input%set('facade_length', 6.0_wp)
         if (what /= 'wedge_thickness') call input%set('wedge_thickness', [0.05_wp, 0.05_wp])
         if (what /= 'wedge_angle') call input%set('wedge_angle', [20.0_wp, 25.0_wp])
         if (what /= 'wedge_bottom') call input%set('wedge_bottom', [0.0_wp, 0.1_wp])
         if (what /= 'wedge_top') call input%set('wedge_top', [2.9_wp, 3.0_wp])
         if (what /= 'wedge_length') call input%set('wedge_length', [4.0_wp, 0.5_wp])
      case ('elevation_x', 'elevation_z', 'opening_x', 'opening_z', 'opening_width', 'opening_height')
         call input%set('facade_length', 2.0_wp)
         if (what(:4) == 'elev') then
            ! A triangle
            call input%set('elevation_x', [0.0_wp, 2.0_wp, 1.0_wp])
            call input%set('elevation_z', [0.0_wp, 0.0_wp, 3.0_wp])
         else
            call input%set('elevation_x', [0.0_wp, 2.0_wp, 2.0_wp, 0.0_wp])
            call input%set('elevation_z', [0.0_wp, 0.0_wp, 3.0_wp, 3.0_wp])
            if (what /= 'opening_x') call input%set('opening_x', [0.1_wp, 1.0_wp])
            if (what /= 'opening_z') call input%set('opening_z', [0.1_wp, 1.0_wp])
            if (what /= 'opening_width') call input%set('opening_width', [0.05_wp, 0.05_wp])
            if (what /= 'opening_height') call input%set('opening_height', [0.05_wp, 0.05_wp])
         end if
      case ('axis_x', 'axis_z', 'load_x', 'inertia_x', 'thrust_x', 'half_gable')
         ! A panel that is 3 m high above a line that rises by 3 in 4
         call input%set('facade_length', 4.0_wp)
         call input%set('elevation_x', [0.0_wp, 4.0_wp, 0.0_wp])
         call input%set('elevation_z', [0.0_wp, 3.0_wp, 3.75_wp])
         call input%set('axis_x', [0.0_wp, 4.0_wp])
         call input%set('axis_z', [0.0_wp, 3.0_wp])
         if (index(what, '_x') > 0 .and. what /= 'axis_x') call input%set(what, [0.1_wp, 0.2_wp])
         if (what == 'load_x') call input%set('load_inertia', 'both')
      case ('load_lifted')
         call input%set('load_pushed', [0.5_wp, 0.5_wp])
      case ('load_pushed')
         call input%set('load_lifted', [0.5_wp, 0.5_wp])
      case default
         if (index(what, 'load') == 1 .and. .not. input%has('load_inertia')) call input%set('load_inertia', 'both')
      end select
      do i = 1, size(names)
         if (input%has(trim(names(i))) .or. .not. goes_with(trim(names(i)), what)) cycle
         select case (names(i))
         case ('mass', 'centroid_depth', 'centroid_height', 'hinge_inertia')
            call input%set(trim(names(i)), 0.2_wp)
         case ('compressive_strength')
            call input%set('compressive_strength', 2.0e6_wp)
         case default
            if (names(i) /= 'stress_block') call input%set(trim(names(i)), [0.4_wp, 0.4_wp])
         end select
      end do
      if (index(what, 'distributed_spring') /= 1) return
      if (.not. input%has('distributed_spring_depth')) call input%set('distributed_spring_depth', [0.1_wp])
      if (.not. input%has('distributed_spring_bottom')) call input%set('distributed_spring_bottom', [0.1_wp])
      if (.not. input%has('distributed_spring_top')) call input%set('distributed_spring_top', [1.0_wp])
   end subroutine complete

   !> Give a tie with a plate, and the masonry that it bears on
   subroutine complete_plate(input, what)
      type(wall_input_type), intent(inout) :: input
      character(len=*), intent(in) :: what

      character(len=*), parameter :: lists(6) = [character(len=19) :: 'tie_bar', 'tie_spacing', 'tie_plate_width', &
         & 'tie_plate_height', 'tie_plate_thickness', 'tie_length']
      character(len=*), parameter :: numbers(4) = [character(len=19) :: 'masonry_compression', 'masonry_shear', &
         & 'masonry_tension', 'masonry_friction']
      real(wp), parameter :: of_lists(6) = [0.02_wp, 2.0_wp, 0.2_wp, 0.2_wp, 0.02_wp, 8.0_wp]
      real(wp), parameter :: of_numbers(4) = [2.0e6_wp, 4.0e4_wp, 5.0e4_wp, 0.4_wp]
      integer :: i

      call input%set('tie_height', [0.4_wp, 0.5_wp])
      do i = 1, size(lists)
         if (what == 'tie_plate_diameter' .and. index(lists(i), 'tie_plate_') == 1 .and. i < 5) cycle
         if (what /= lists(i)) call input%set(trim(lists(i)), [of_lists(i)])
      end do
      do i = 1, size(numbers)
         if (numbers(i) == 'masonry_friction' .and. what /= 'tie_compression') cycle
         if (what /= numbers(i)) call input%set(trim(numbers(i)), of_numbers(i))
      end do
      if (what == 'masonry_friction') call input%set('tie_compression', [5.0e4_wp])
   end subroutine complete_plate

   !> Do two properties describe one thing?
   pure logical function goes_with(name, what)
      character(len=*), intent(in) :: name, what

      character(len=*), parameter :: body = 'mass centroid_depth centroid_height hinge_inertia', &
         & strength = 'compressive_strength stress_block'

      goes_with = (name(:scan(name//'_', '_') - 1) == what(:scan(what//'_', '_') - 1) .and. index(body, name) == 0) &
         & .or. (index(body, name) > 0 .and. index(body, what) > 0) &
         & .or. (index(strength, name) > 0 .and. index(strength, what) > 0)
   end function goes_with

   !> A name that there is not is told of
   subroutine test_unknown()
      type(wall_input_type) :: input
      type(wall_type) :: wall
      type(error_type), allocatable :: error

      call suite('unknown names')
      call input%set('mechanism', 'one_sided')
      call input%set('heigth', 3.0_wp)
      call new_wall(wall, input, error)
      call check_error(error, 'heigth: no such variable; did you mean ''height''? dondolo --template lists all', 'heigth')
   end subroutine test_unknown

   !> Remove a file
   subroutine remove(file)
      character(len=*), intent(in) :: file

      integer :: unit, stat

      open (newunit=unit, file=file, iostat=stat)
      if (stat == 0) close (unit, status='delete')
   end subroutine remove

end program test_properties
