!> A building that a wall stands on or hangs from: linear, its modes by period, damping and participation at the level of
!> the wall (docs/theory.md, section 1).
module dondolo_building
   use dondolo_error, only : problems_type
   use dondolo_kinds, only : pi, wp
   use dondolo_property, only : is_integer, is_list, property_type
   use dondolo_settings, only : settings_type
   use dondolo_text, only : to_text
   implicit none
   private

   public :: building_type, new_building
   public :: building_properties, building_rows

   !> Damping of a mode unless it is given
   real(wp), parameter :: usual_damping = 0.05_wp

   !> Part of the amplitude of a mode by which straight lines between refined samples may miss it
   real(wp), parameter :: tolerance = 1.0e-3_wp

   !> Part of its amplitude that the free vibration after a record is followed to, and the most periods that it is
   real(wp), parameter :: still = 1.0e-4_wp, most_periods = 300.0_wp

   !> Most parts that a step of a record is divided into
   integer, parameter :: most_parts = 100

   !> Properties of a building, none of which a wall on the ground has
   type(property_type), parameter :: building_rows(*) = [ &
      & property_type('period', is_list, unit='s', optional=.true., positive=.true., smallest=1.0e-6_wp, &
      &   largest=20.0_wp, usual_least=0.02_wp, usual_most=2.0_wp, example='0.30', &
      &   meaning='periods of the modes of the building that the wall stands on'), &
      & property_type('damping', is_list, optional=.true., smallest=0.0_wp, largest=1.0_wp, less=.true., &
      &   usual_most=0.4_wp, example='0.05', &
      &   meaning='their damping ratios, or one for all; 0.05 if not given'), &
      & property_type('participation', is_list, optional=.true., smallest=-10.0_wp, largest=10.0_wp, example='1.29', &
      &   meaning='their participation factors times their shapes at the level of the wall, no percentages'), &
      & property_type('storeys', is_integer, optional=.true., smallest=1.0_wp, largest=1000.0_wp, example='3', &
      &   meaning='number n of storeys, instead of participation: 3 n / (2 n + 1) level / building_height'), &
      & property_type('level', unit='m', optional=.true., smallest=0.0_wp, largest=1.0e3_wp, usual_most=150.0_wp, example='9.0', &
      &   meaning='height of the wall''s floor above the ground, with storeys'), &
      & property_type('building_height', unit='m', optional=.true., positive=.true., largest=1.0e3_wp, usual_most=150.0_wp, &
      &   example='9.0', &
      &   meaning='height of the building, with storeys'), &
      & property_type('refine', is_integer, optional=.true., smallest=0.0_wp, largest=real(most_parts, wp), zero='auto', &
      &   example='0', meaning='parts that a step of a record is divided into; 0: as many as the shortest '// &
      &   'period needs, 0 if not given')]

   !> The same where pointers can point
   type(property_type), target, protected :: building_properties(size(building_rows)) = building_rows

   !> A building as a wall at one level sees it
   type :: building_type
      !> Periods of its modes [s]
      real(wp), allocatable :: period(:)
      !> Their damping ratios, at least 0 and below 1
      real(wp), allocatable :: damping(:)
      !> Their participation factors times their shapes at the level
      real(wp), allocatable :: participation(:)
      !> Parts of a step; 0: as many as it needs
      integer :: refine = 0
   contains
      !> Parts that a step of a record is divided into
      procedure :: parts
      !> How long it vibrates after a record
      procedure :: free_vibration
      !> Is another building the same?
      procedure :: equals
   end type building_type

contains

   !> Make a building of what is said of it, its ranges checked
   subroutine new_building(building, input, problems)
      type(building_type), intent(out) :: building
      !> Values of building_properties, among others; the damping that each mode has is set
      class(settings_type), intent(inout) :: input
      !> Takes what is missing or does not agree: `variable = value: what is allowed`
      type(problems_type), intent(inout) :: problems

      building%period = input%list('period')
      if (size(building%period) == 0) then
         call problems%note('period: must be given of a building')
         return
      end if
      call check_whole('storeys')
      call check_whole('refine')
      building%refine = nint(input%number('refine'))
      call take_damping(building, input%list('damping'), problems)
      call take_participation(building, input, problems)
      call input%set('damping', building%damping)

   contains

      !> Check that a number is whole: cells of tables may be any
      subroutine check_whole(name)
         !> Name of the property
         character(len=*), intent(in) :: name

         associate (number => input%number(name))
            if (abs(number - anint(number)) > 0.0_wp) call problems%note(name//' = '//to_text(number)// &
               & ': must be a whole number')
         end associate
      end subroutine check_whole

   end subroutine new_building

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
               & ' as period, or one for all')
         end if
      end associate
   end subroutine take_damping

   !> Participation of the modes: as given, or of one mode that grows in proportion to height
   subroutine take_participation(building, input, problems)
      !> The building with its periods: its participation is set
      type(building_type), intent(inout) :: building
      !> What is said of it
      class(settings_type), intent(in) :: input
      !> Takes what is missing, too much, or does not agree
      type(problems_type), intent(inout) :: problems

      character(len=15), parameter :: names(3) = [character(len=15) :: 'storeys', 'level', 'building_height']
      real(wp) :: storeys, level, height
      logical :: given(3)
      integer :: i

      associate (modes => size(building%period))
         if (input%has('participation')) then
            building%participation = input%list('participation')
            if (size(building%participation) /= modes) call problems%note('participation: has '// &
               & to_text(size(building%participation))//' values, must have '//to_text(modes)//' as period')
            do i = 1, size(names)
               if (input%has(trim(names(i)))) call problems%note(trim(names(i))//' = '// &
                  & to_text(input%number(trim(names(i))))// &
                  & ': give either participation or storeys, level and building_height')
            end do
            return
         end if
         if (modes > 1) then
            call problems%note('participation: must be given of '//to_text(modes)//' modes')
            return
         end if
         given = [(input%has(trim(names(i))), i=1, size(names))]
         if (.not. any(given)) then
            call problems%note('participation: must be given, or storeys, level and building_height in its place')
            return
         else if (.not. all(given)) then
            call problems%note(trim(names(findloc(given, .false., dim=1)))// &
               & ': must be given, storeys, level and building_height belong together')
            return
         end if
         storeys = input%number('storeys')
         level = input%number('level')
         height = input%number('building_height')
         if (level > height) call problems%note('level = '//to_text(level)//': must be at most building_height = '// &
            & to_text(height))
         building%participation = [3.0_wp*storeys/(2.0_wp*storeys + 1.0_wp)*level/height]
      end associate
   end subroutine take_participation

   !> Parts that a step of a record is divided into, so that straight lines between their ends miss no more of a mode's
   !> amplitude than the tolerance: (omega dt/n)**2/8. Beyond most_parts the mode follows the ground
   pure integer function parts(self, dt)
      class(building_type), intent(in) :: self
      !> Step of the record [s]
      real(wp), intent(in) :: dt

      real(wp) :: needed

      parts = self%refine
      if (parts > 0) return
      needed = 2.0_wp*pi*dt/sqrt(8.0_wp*tolerance)*maxval([0.0_wp, 1.0_wp/pack(self%period, moves(self))])
      parts = max(1, ceiling(min(needed, real(most_parts, wp))))
   end function parts

   !> How long it vibrates after a record, until little is left of every mode's amplitude [s]
   pure real(wp) function free_vibration(self) result(time)
      class(building_type), intent(in) :: self

      integer :: k

      time = 0.0_wp
      do k = 1, size(self%period)
         if (.not. abs(self%participation(k)) > 0.0_wp) cycle
         time = max(time, self%period(k)*min(most_periods, -log(still)/(2.0_wp*pi*max(self%damping(k), tiny(time)))))
      end do
   end function free_vibration

   !> Is another building the same?
   pure logical function equals(self, other)
      class(building_type), intent(in) :: self
      type(building_type), intent(in) :: other

      equals = size(self%period) == size(other%period) .and. self%refine == other%refine
      if (equals) equals = .not. any(abs(self%period - other%period) + abs(self%damping - other%damping) &
         & + abs(self%participation - other%participation) > 0.0_wp)
   end function equals

   !> Which modes move the level at all?
   pure function moves(building)
      class(building_type), intent(in) :: building
      !> An answer for each mode
      logical :: moves(size(building%period))

      moves = abs(building%participation) > 0.0_wp
   end function moves

end module dondolo_building
