!> What a user says of a building: the rows of its properties, and the building that follows.
module dondolo_building_input
   use dondolo_base_error, only : not_given, not_together, out_of_range, problems_type, wrong_length
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : is_integer, is_list, property_type
   use dondolo_base_settings, only : settings_type
   use dondolo_base_text, only : rounded, to_text
   use dondolo_building, only : building_type, diaphragm_type, most_parts
   implicit none
   private

   public :: new_building, period_of_displacement, proposed_period
   public :: touches_base, leans, spans
   public :: building_properties, building_rows

   !> Damping of a mode and of a diaphragm unless it is given
   real(wp), parameter :: usual_damping = 0.05_wp

   !> Participation of a diaphragm that bends like a shear beam between two walls, at its middle: 4/pi
   real(wp), parameter :: usual_diaphragm = 1.27_wp

   !> What a wall touches of a building: nothing but what it stands on; transverse walls up to its top, which it leans on; or
   !> two floors, between which it spans
   integer, parameter :: touches_base = 0, leans = 1, spans = 2

   !> Properties of a building, none of which a wall on the ground has
   type(property_type), parameter :: building_rows(*) = [ &
      & property_type('period', is_list, unit='s', optional=.true., positive=.true., smallest=1.0e-6_wp, &
      &   largest=20.0_wp, usual_least=0.02_wp, usual_most=2.0_wp, example='0.30', &
      &   meaning='periods of the modes of the building that the wall stands on'), &
      & property_type('damping', is_list, optional=.true., smallest=0.0_wp, largest=1.0_wp, less=.true., &
      &   usual_most=0.4_wp, example='0.05', &
      &   meaning='their damping ratios, or one for all; 0.05 if not given'), &
      & property_type('participation', is_list, optional=.true., smallest=-10.0_wp, largest=10.0_wp, example='1.29', &
      &   not_with='storeys, level, building_height, level_top', &
      &   meaning='their participation factors times their shapes at the level of the wall, no percentages'), &
      & property_type('storeys', is_integer, optional=.true., smallest=1.0_wp, largest=1000.0_wp, example='3', &
      &   meaning='number n of storeys, instead of participation: 3 n / (2 n + 1) level / building_height'), &
      & property_type('level', unit='m', optional=.true., smallest=0.0_wp, largest=1.0e3_wp, usual_most=150.0_wp, example='9.0', &
      &   meaning='height of the wall''s floor above the ground, with storeys'), &
      & property_type('building_height', unit='m', optional=.true., positive=.true., largest=1.0e3_wp, usual_most=150.0_wp, &
      &   example='9.0', &
      &   meaning='height of the building, with storeys'), &
      & property_type('top_displacement', unit='m', optional=.true., positive=.true., smallest=1.0e-6_wp, largest=100.0_wp, &
      &   usual_least=1.0e-4_wp, usual_most=1.0_wp, example='0.02', &
      &   meaning='displacement d of the top of the building under its weights applied sideways, instead of period: 2 sqrt(d)'), &
      & property_type('level_top', unit='m', optional=.true., smallest=0.0_wp, largest=1.0e3_wp, usual_most=150.0_wp, &
      &   example='9.0', &
      &   meaning='height above the ground up to which the building moves the wall, with storeys; that of the top of the wall '// &
      &   'or of the building if not given', more='level: the wall leans on nothing, and moves with its base'), &
      & property_type('participation_top', is_list, optional=.true., smallest=-10.0_wp, largest=10.0_wp, example='1.29', &
      &   meaning='participation factors times shapes at the top of the wall, with participation; the same if not given'), &
      & property_type('diaphragm_period', unit='s', optional=.true., smallest=0.02_wp, largest=5.0_wp, &
      &   example='0.40', &
      &   meaning='period of the flexible floor that holds the top of a two_block wall; rigid if not given'), &
      & property_type('diaphragm_damping', optional=.true., smallest=0.0_wp, largest=1.0_wp, less=.true., &
      &   usual_most=0.4_wp, example='0.05', meaning='its damping ratio, 0.05 if not given'), &
      & property_type('diaphragm_participation', optional=.true., positive=.true., largest=10.0_wp, example='1.27', &
      &   meaning='its participation factor times its shape where the wall is, 1.27 if not given'), &
      & property_type('refine', is_integer, optional=.true., smallest=0.0_wp, largest=real(most_parts, wp), zero='auto', &
      &   example='0', meaning='parts that a step of a record is divided into; 0: as many as the shortest '// &
      &   'period needs, 0 if not given')]

   !> The same where pointers can point
   type(property_type), target, protected :: building_properties(size(building_rows)) = building_rows

contains

   !> Make a building from its settings, ranges checked
   subroutine new_building(building, input, problems, contact, wall_height)
      type(building_type), intent(out) :: building
      !> Values of building_properties, among others; what has a value unless it is given is set
      class(settings_type), intent(inout) :: input
      !> Takes what is missing or does not agree: `variable = value: what is allowed`
      type(problems_type), intent(inout) :: problems
      !> What the wall touches of it, and the height of the wall [m]; not given: no wall is known
      integer, intent(in), optional :: contact
      real(wp), intent(in), optional :: wall_height

      call take_period(building, input, problems)
      if (problems%count > 0) return
      if (size(building%period) == 0) then
         if (input%has('building_height')) then
            ! A proposal, which nobody takes without reading it
            call problems%note('period: must be given of a building; for masonry of building_height = '// &
               & to_text(input%number('building_height'))//' a first approximation is 0.05 H^(3/4) = '// &
               & rounded(proposed_period(input%number('building_height')))//' s (Circolare 7/2019, C7.3.3.2)', not_given, 'period')
         else
            call problems%note('period: must be given of a building', not_given, 'period')
         end if
         return
      end if
      building%refine = nint(input%number('refine'))
      call take_damping(building, input%list('damping'), problems)
      call take_participation(building, input, problems)
      call take_diaphragm(building%diaphragm, input, problems)
      call input%set('damping', building%damping)
      if (problems%count > 0) return
      if (present(contact)) call take_wall(building, input, contact, wall_height, problems)
      if (problems%count == 0) call take_top(building, input, problems)
   end subroutine new_building

   !> Periods of the modes: as given, or of the first mode from the displacement of the top
   subroutine take_period(building, input, problems)
      !> The building: its periods are set, none if nothing is given
      type(building_type), intent(inout) :: building
      !> Its settings; out: with the period that follows
      class(settings_type), intent(inout) :: input
      !> Takes a period that is another than that of the displacement
      type(problems_type), intent(inout) :: problems

      building%period = input%list('period')
      if (.not. input%has('top_displacement')) return
      associate (period => [period_of_displacement(input%number('top_displacement'))])
         ! Settings that were filled here before have both
         if (size(building%period) > 0) then
            if (size(building%period) > 1 .or. abs(building%period(1) - period(1)) > 0.0_wp) call problems%note( &
               & 'period: not with top_displacement = '//to_text(input%number('top_displacement'))//', whose period '// &
               & '2 sqrt(d) is '//rounded(period(1))//' s', not_together, 'period')
         end if
         building%period = period
      end associate
      call input%set('period', building%period)
   end subroutine take_period

   !> Period of the first mode of a building [s]: 2 sqrt(d) (NTC 2018, 7.3.3.2, [7.3.6])
   pure real(wp) function period_of_displacement(displacement)
      !> That of its top under its weights applied sideways, d [m]
      real(wp), intent(in) :: displacement

      period_of_displacement = 2.0_wp*sqrt(displacement)
   end function period_of_displacement

   !> First approximation of the period of a building of masonry [s]: 0.05 H^(3/4) (Circolare 7/2019, C7.3.3.2)
   pure real(wp) function proposed_period(height)
      !> Its height H [m]
      real(wp), intent(in) :: height

      proposed_period = 0.05_wp*height**0.75_wp
   end function proposed_period

   !> Damping of the modes: one for each, or one for all
   subroutine take_damping(building, given, problems)
      !> The building with its periods: its damping is set
      type(building_type), intent(inout) :: building
      !> What was given
      real(wp), intent(in) :: given(:)
      !> Takes a list of another length
      type(problems_type), intent(inout) :: problems

      associate (modes => size(building%period))
         allocate (building%damping(modes), source=usual_damping)
         if (size(given) == 1) then
            building%damping = given(1)
         else if (size(given) == modes) then
            building%damping = given
         else if (size(given) > 0) then
            call problems%note('damping: has '//to_text(size(given))//' values, must have '//to_text(modes)// &
               & ' as period, or one for all', wrong_length, 'damping')
         end if
      end associate
   end subroutine take_damping

   !> Participation of the modes: as given, or of one mode that grows in proportion to height
   subroutine take_participation(building, input, problems)
      !> The building with its periods: its participation is set
      type(building_type), intent(inout) :: building
      !> Its settings
      class(settings_type), intent(in) :: input
      !> Takes what is missing, too much, or does not agree
      type(problems_type), intent(inout) :: problems

      character(len=15), parameter :: names(4) = [character(len=15) :: 'storeys', 'level', 'building_height', 'level_top']
      real(wp) :: storeys, level, height
      logical :: given(4)
      integer :: i

      associate (modes => size(building%period))
         if (input%has('participation')) then
            building%participation = input%list('participation')
            if (size(building%participation) /= modes) call problems%note('participation: has '// &
               & to_text(size(building%participation))//' values, must have '//to_text(modes)//' as period', &
               & wrong_length, 'participation')
            return
         end if
         if (input%has('participation_top')) call problems%note('participation_top: only with participation; with '// &
            & 'storeys, level and building_height it follows from level_top', not_together, 'participation_top')
         if (modes > 1) then
            call problems%note('participation: must be given of '//to_text(modes)//' modes', not_given, 'participation')
            return
         end if
         given = [(input%has(trim(names(i))), i=1, size(names))]
         if (.not. any(given)) then
            call problems%note('participation: must be given, or storeys, level and building_height in its place', &
               & not_given, 'participation')
            return
         else if (.not. all(given(:3))) then
            call problems%note(trim(names(findloc(given(:3), .false., dim=1)))// &
               & ': must be given, storeys, level and building_height belong together', not_given, &
               & trim(names(findloc(given(:3), .false., dim=1))))
            return
         end if
         storeys = input%number('storeys')
         level = input%number('level')
         height = input%number('building_height')
         if (level > height) call problems%note('level = '//to_text(level)//': must be at most building_height = '// &
            & to_text(height), out_of_range, 'level')
         building%participation = [of_storeys(storeys, level, height)]
         building%level_top = level
         if (input%has('level_top')) building%level_top = input%number('level_top')
      end associate
   end subroutine take_participation

   !> Participation times shape of a mode that grows in proportion to height, n storeys of equal mass (Circolare 7/2019, C7.2.10)
   pure real(wp) function of_storeys(storeys, level, height)
      !> Their number n
      real(wp), intent(in) :: storeys
      !> Height where the mode is looked at, and of the building [m]
      real(wp), intent(in) :: level, height

      of_storeys = 3.0_wp*storeys/(2.0_wp*storeys + 1.0_wp)*level/height
   end function of_storeys

   !> The diaphragm, with what it has unless it is given
   subroutine take_diaphragm(diaphragm, input, problems)
      type(diaphragm_type), intent(out) :: diaphragm
      !> Its settings; out: with its damping and its participation
      class(settings_type), intent(inout) :: input
      !> Takes what is given without it
      type(problems_type), intent(inout) :: problems

      character(len=23), parameter :: names(2) = [character(len=23) :: 'diaphragm_damping', 'diaphragm_participation']
      real(wp), parameter :: usual(2) = [usual_damping, usual_diaphragm]
      integer :: i

      do i = 1, size(names)
         if (input%has('diaphragm_period')) then
            if (.not. input%has(trim(names(i)))) call input%set(trim(names(i)), usual(i))
         else if (input%has(trim(names(i)))) then
            call problems%note(trim(names(i))//': only with diaphragm_period', not_together, trim(names(i)))
         end if
      end do
      diaphragm = diaphragm_type(input%number('diaphragm_period'), input%number(trim(names(1))), input%number(trim(names(2))))
   end subroutine take_diaphragm

   !> What the wall touches: the height of the line between its supports, and up to which level
   subroutine take_wall(building, input, contact, wall_height, problems)
      !> The building: its height of the line and the level of the top are set
      type(building_type), intent(inout) :: building
      !> Its settings
      class(settings_type), intent(in) :: input
      !> What the wall touches
      integer, intent(in) :: contact
      !> Its height [m]
      real(wp), intent(in) :: wall_height
      !> Takes what such a wall does not feel
      type(problems_type), intent(inout) :: problems

      character(len=17), parameter :: names(3) = [character(len=17) :: 'level_top', 'participation_top', 'diaphragm_period']
      real(wp) :: level
      integer :: i

      if (contact == touches_base) then
         do i = 1, size(names)
            if (input%has(trim(names(i)))) call problems%note(trim(names(i))//': not of a free-standing wall nor of one with '// &
               & 'an inclined axis, which touch nothing of the building but what they stand on', not_together, trim(names(i)))
         end do
         return
      end if
      if (contact == leans .and. input%has('diaphragm_period')) call problems%note('diaphragm_period = '// &
         & to_text(input%number('diaphragm_period'))//': only of a two_block wall; a one_sided wall and a corner lean on '// &
         & 'transverse walls, which do not move with a diaphragm', not_together, 'diaphragm_period')
      building%height = wall_height
      if (.not. input%has('level')) return
      level = input%number('level')
      if (.not. input%has('level_top')) building%level_top = max(level, min(level + wall_height, &
         & input%number('building_height')))
      if (contact == leans) building%height = building%level_top - level
   end subroutine take_wall

   !> Participation of the modes at the top: as given, or of one mode that grows in proportion to height; else that of the base
   subroutine take_top(building, input, problems)
      !> The building with that of the base: that of the top is set
      type(building_type), intent(inout) :: building
      !> Its settings
      class(settings_type), intent(in) :: input
      !> Takes what does not agree
      type(problems_type), intent(inout) :: problems

      building%participation_top = building%participation
      if (input%has('participation_top')) then
         building%participation_top = input%list('participation_top')
         if (size(building%participation_top) /= size(building%period)) call problems%note('participation_top: has '// &
            & to_text(size(building%participation_top))//' values, must have '//to_text(size(building%period))//' as period', &
            & wrong_length, 'participation_top')
      else if (input%has('level')) then
         associate (top => building%level_top, height => input%number('building_height'))
            if (top < input%number('level')) call problems%note('level_top = '//to_text(top)//': must be at least level = '// &
               & to_text(input%number('level')), out_of_range, 'level_top')
            if (top > height) call problems%note('level_top = '//to_text(top)//': must be at most building_height = '// &
               & to_text(height), out_of_range, 'level_top')
            building%participation_top = [of_storeys(input%number('storeys'), top, height)]
         end associate
      end if
   end subroutine take_top

end module dondolo_building_input
