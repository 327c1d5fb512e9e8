!> Walls of which the terms of the equation of motion are given as a table: 'tabulated'. Its name, its properties, and how it
!> becomes a mechanism (dondolo_wall_tabulated).
module dondolo_wall_tabulated_model
   use dondolo_base_error, only : error_type, not_given, not_increasing, out_of_range, problems_type, wrong_length
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_property, only : blank, choices_length, is_integer, is_list, is_text, most_choices, property_type
   use dondolo_base_settings, only : settings_type
   use dondolo_base_text, only : rounded, to_text
   use dondolo_building_input, only : spans
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_model, only : wall_model_type
   use dondolo_wall_restitution, only : impact_models_type
   use dondolo_wall_table_fit, only : least_rows, most_rows
   use dondolo_wall_tabulated, only : new_tabulated, table_type, tabulated_type
   implicit none
   private

   public :: chain_name, check_column_names, horizontal_name, tabulated_model_type, tabulated_name, tabulated_rows, term_names

   !> Name of the mechanism
   character(len=choices_length), parameter :: tabulated_name = 'tabulated'

   !> Names of those whose table follows from the joints of rigid bodies (dondolo_wall_chain_model): given by themselves, or those
   !> of a wall that bends horizontally (dondolo_wall_horizontal)
   character(len=choices_length), parameter :: chain_name = 'chain', horizontal_name = 'horizontal'

   !> Owners of what all of them have
   character(len=choices_length), parameter :: sampled(most_choices) = reshape([tabulated_name, chain_name, horizontal_name], &
      & [most_choices], pad=blank)

   !> Owners of what it alone has
   character(len=choices_length), parameter :: tabulated(most_choices) = reshape([tabulated_name], [most_choices], pad=blank)

   !> Lists of the table: the last may be left out
   character(len=14), parameter :: term_names(5) = [character(len=14) :: 'rotation', 'inertia', 'lever', 'moment', &
      & 'vertical_lever']

   !> Those that only checks need, over the rotation and of each body or load
   character(len=14), parameter :: check_column_names(2) = [character(len=14) :: 'travel', 'weighted_lever']
   character(len=12), parameter :: check_names(2) = [character(len=12) :: 'weight', 'displacement']

   !> Its properties
   type(property_type), parameter :: tabulated_rows(*) = [ &
      & property_type('table', is_text, owners=tabulated, optional=.true., replaced=.true., example='data/walls/arch.csv', &
      &   meaning='CSV file of the terms over the rotation, instead of the lists', &
      &   more='columns rotation [rad], inertia [kg m2/m], lever [kg m/m], moment [N m/m]'), &
      & property_type('rotation', is_list, unit='rad', owners=tabulated, optional=.true., smallest=0.0_wp, &
      &   largest=3.0_wp, example='0.0, 0.02, 0.04', &
      &   meaning='rotations q of the table, from 0 to where the restoring moment has vanished', &
      &   more='the last alone where the table is one of powers'), &
      & property_type('inertia', is_list, unit='kg m2/m', owners=tabulated, optional=.true., positive=.true., &
      &   largest=1.0e12_wp, example='4078.0, 4078.0, 4078.0', &
      &   meaning='inertia J at each rotation, per metre of wall'), &
      & property_type('lever', is_list, unit='kg m/m', owners=tabulated, optional=.true., smallest=-1.0e12_wp, &
      &   largest=1.0e12_wp, example='2025.0, 2030.0, 2034.0', &
      &   meaning='sum of the masses times their horizontal levers L at each rotation, per metre of wall'), &
      & property_type('moment', is_list, unit='N m/m', owners=tabulated, optional=.true., smallest=-1.0e12_wp, &
      &   largest=1.0e12_wp, example='1655.0, 1258.0, 860.0', &
      &   meaning='restoring moment G - Q at each rotation, per metre of wall'), &
      & property_type('vertical_lever', is_list, unit='kg m/m', owners=tabulated, optional=.true., smallest=-1.0e12_wp, &
      &   largest=1.0e12_wp, example='168.8, 108.0, 47.0', &
      &   meaning='sum of the masses times their vertical levers S at each rotation, for vertical ground motion'), &
      & property_type('travel', is_list, unit='m', owners=tabulated, optional=.true., changes_results=.false., smallest=0.0_wp, &
      &   largest=1.0e3_wp, example='0.0, 0.03, 0.06', &
      &   meaning='displacement d of the equivalent oscillator (C8.7.1.4) at each rotation, for checks'), &
      & property_type('weighted_lever', is_list, unit='N m/m', owners=tabulated, optional=.true., changes_results=.false., &
      &   smallest=-1.0e12_wp, largest=1.0e12_wp, example='19.9e3, 19.9e3, 20.0e3', &
      &   meaning='sum of all weights times their horizontal levers at each rotation, for checks; gravity times lever if not '// &
      &   'given and nothing is carried'), &
      & property_type('weight', is_list, unit='N/m', owners=tabulated, optional=.true., changes_results=.false., &
      &   positive=.true., largest=1.0e12_wp, example='13.2e3, 8.0e3', &
      &   meaning='weight of each body and load, for checks, per metre of wall'), &
      & property_type('displacement', is_list, unit='m', owners=tabulated, optional=.true., changes_results=.false., &
      &   smallest=-1.0e3_wp, largest=1.0e3_wp, example='1.5, 3.0', one_each=.true., &
      &   meaning='how far each of them moves outwards for a unit of rotation at rest'), &
      & property_type('sides', is_integer, owners=sampled, optional=.true., smallest=1.0_wp, largest=2.0_wp, example='1', &
      &   meaning='1: the wall can rock to one side only; 2: to both, and changes side at every impact'), &
      & property_type('top_share', owners=tabulated, optional=.true., smallest=-10.0_wp, largest=10.0_wp, example='0.5', &
      &   meaning='share k of the acceleration of its top, relative to that of its base, that moves the wall'), &
      & property_type('top_tilt', unit='1/s2', owners=tabulated, optional=.true., smallest=-1.0e4_wp, largest=1.0e4_wp, &
      &   example='3.0', meaning='tilt tau: factor on the displacement of the top relative to the base')]

   !> A wall whose terms are a table
   type, extends(wall_model_type) :: tabulated_model_type
      !> The table
      type(table_type) :: table
      !> For checks, of each body or load: weight [N/m], and how far it moves outwards for a unit of rotation [m]; of size 0: not
      !> known
      real(wp), allocatable :: weight(:), displacement(:)
      !> And over the rotation: displacement of the equivalent oscillator [m], and sum of weights times levers [N m/m]; that of
      !> size 0: gravity times lever
      real(wp), allocatable :: travel(:), weighted_lever(:)
   contains
      procedure :: prepare
      procedure :: read
      procedure :: make_mechanism
      procedure :: describe
   end type tabulated_model_type

contains

   !> Note whether a building holds its top
   subroutine prepare(self, input, problems)
      class(tabulated_model_type), intent(inout) :: self
      !> Properties as given
      class(settings_type), intent(inout) :: input
      !> Takes what does not agree
      type(problems_type), intent(inout) :: problems

      character(len=9), parameter :: names(2) = ['top_share', 'top_tilt ']
      integer :: i

      if (input%has('top_share') .or. input%has('top_tilt')) self%contact = spans
      do i = 1, 2
         if (self%contact == spans .and. .not. input%has(trim(names(i)))) call problems%note(trim(names(i))// &
            & ': must be given with '//trim(names(3 - i))//': both follow from the same supports', not_given, trim(names(i)))
      end do
   end subroutine prepare

   !> Read the table, and check its rows
   subroutine read(self, input, gravity, problems)
      class(tabulated_model_type), intent(inout) :: self
      !> Properties, defaults filled in
      class(settings_type), intent(inout) :: input
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> In: values beyond their ranges; takes what is wrong
      type(problems_type), intent(inout) :: problems

      integer :: i, n, rows

      if (.not. input%has('sides')) then
         call problems%note('sides: must be given with mechanism = ''tabulated'': 1 (one side only) or 2 (both)', &
            & not_given, 'sides')
      end if
      rows = size(input%list('rotation'))
      do i = 1, size(term_names)
         n = size(input%list(trim(term_names(i))))
         if (n == 0 .and. i == size(term_names)) cycle
         if (n == 0) then
            call problems%note(trim(term_names(i))//': must be given with mechanism = ''tabulated'', or table, which has it', &
               & not_given, trim(term_names(i)))
         else if (n /= rows .and. rows > 0) then
            call problems%note(trim(term_names(i))//': has '//to_text(n)//' values, must have '//to_text(rows)//' as rotation', &
               & wrong_length, trim(term_names(i)))
         end if
      end do
      if (problems%count > 0) return
      associate (q => input%list('rotation'))
         if (rows < least_rows) then
            call problems%note('rotation: has '//to_text(rows)//' values, must have '//to_text(least_rows)//' at least', &
               & wrong_length, 'rotation')
         else if (rows > most_rows) then
            call problems%note('rotation: has '//to_text(rows)//' values, must have '//to_text(most_rows)//' at most', &
               & wrong_length, 'rotation')
         else if (q(1) > 0.0_wp) then
            call problems%note('rotation: begins at '//to_text(q(1))//', must begin at 0', out_of_range, 'rotation')
         else if (any(q(2:) <= q(:rows - 1))) then
            i = findloc(q(2:) <= q(:rows - 1), .true., dim=1)
            call problems%note('rotation: '//to_text(q(i + 1))//' follows '//to_text(q(i))//', each must be more than the '// &
               & 'one before', not_increasing, 'rotation')
         end if
         self%table = table_type(q, input%list('inertia'), input%list('lever'), input%list('moment'), &
            & input%list('vertical_lever'))
      end associate
      call read_check(self, input, problems)
      associate (ignored => gravity)
      end associate
   end subroutine read

   !> Read what only checks need
   subroutine read_check(self, input, problems)
      type(tabulated_model_type), intent(inout) :: self
      !> Properties
      class(settings_type), intent(in) :: input
      !> Takes what is missing, or too much
      type(problems_type), intent(inout) :: problems

      character(len=14) :: names(4)
      integer :: i

      names = [character(len=14) :: check_names, check_column_names]
      self%weight = input%list('weight')
      self%displacement = input%list('displacement')
      self%travel = input%list('travel')
      self%weighted_lever = input%list('weighted_lever')
      if (.not. any([(input%has(trim(names(i))), i=1, size(names))])) return
      do i = 1, 3
         if (.not. input%has(trim(names(i)))) call problems%note(trim(names(i))//': must be given for checks, which need '// &
            & 'weight, displacement and travel', not_given, trim(names(i)))
      end do
      if (size(self%displacement) /= size(self%weight)) call problems%note('displacement: has '// &
         & to_text(size(self%displacement))//' values, must have '//to_text(size(self%weight))//' as weight', wrong_length, &
         & 'displacement')
      do i = 3, 4
         associate (n => size(input%list(trim(names(i)))), rows => size(self%table%rotation))
            if (n > 0 .and. n /= rows) call problems%note(trim(names(i))//': has '//to_text(n)//' values, must have '// &
               & to_text(rows)//' as rotation', wrong_length, trim(names(i)))
         end associate
      end do
   end subroutine read_check

   !> Make the mechanism
   subroutine make_mechanism(self, input, gravity, mechanism, impacts, error)
      class(tabulated_model_type), intent(inout) :: self
      !> Properties
      class(settings_type), intent(in) :: input
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> The mechanism
      class(mechanism_type), allocatable, intent(out) :: mechanism
      !> It has no model of its impacts
      type(impact_models_type), intent(out) :: impacts
      !> The table is not that of a wall
      type(error_type), allocatable, intent(out) :: error

      type(tabulated_type), allocatable :: made

      ! No model: the speed ratio is a number.
      impacts = impact_models_type()
      allocate (made)
      call new_tabulated(made, self%table, gravity, input%number('sides') > 1.0_wp, self%misfit, error)
      made%share = input%number('top_share')*input%number('height')
      made%tilt = input%number('top_tilt')*input%number('height')
      call move_alloc(made, mechanism)
   end subroutine make_mechanism

   !> Describe the table
   subroutine describe(self, input, gravity, lines)
      class(tabulated_model_type), intent(in) :: self
      !> Properties
      class(settings_type), intent(in) :: input
      !> Gravity [m/s2]
      real(wp), intent(in) :: gravity
      !> `subject: numbers with their units`
      type(lines_type), intent(inout) :: lines

      associate (of => input, ignored => gravity, q => self%table%rotation)
         call lines%add('table: '//to_text(size(q))//' rotations up to '//rounded(q(size(q)))//' rad; polynomials miss its '// &
            & 'values by '//rounded(100.0_wp*self%misfit)//' % of the largest at most')
      end associate
   end subroutine describe

end module dondolo_wall_tabulated_model
