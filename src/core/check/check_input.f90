!> What a user says of a check by a building code: the site's hazard, and what the code leaves to the engineer.
module dondolo_check_input
   use dondolo_base_error, only : not_given, not_increasing, not_together, out_of_range, problems_type, wrong_length
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : blank, choices_length, is_list, is_text, most_choices, property_type
   use dondolo_base_settings, only : settings_type
   use dondolo_base_settings_check, only : check_settings
   use dondolo_base_text, only : to_text
   use dondolo_check_code_spectrum, only : elastic_spectrum_type, ntc_spectrum, soil_names, topography_names
   use dondolo_check_site_hazard, only : new_site_hazard, return_period_of_exceedance => return_period, site_hazard_type, &
      & state_exceedance, use_classes
   implicit none
   private

   public :: check_input_type, take_check, put_check
   public :: check_properties, full_factor, state_names

   !> Limit states: damage, life safety, collapse
   character(len=*), parameter :: state_names(3) = [character(len=3) :: 'SLD', 'SLV', 'SLC']

   !> Codes
   character(len=choices_length), parameter :: code_names(*) = [character(len=choices_length) :: 'ntc2018']

   !> Confidence factor of the lowest level of knowledge, LC1
   real(wp), parameter :: full_factor = 1.35_wp

   !> What gives the hazard in place of its values, and what follows from it
   character(len=*), parameter :: coordinates = 'latitude and longitude'
   character(len=*), parameter :: determined(*) = [character(len=14) :: 'ag', 'f0', 'tc_star', 'reference_life', 'exceedance']

   !> What a user can set
   type(property_type), target, protected :: check_properties(18) = [ &
      & property_type('code', is_text, word='ntc2018', choices=reshape(code_names, [most_choices], pad=blank), &
      &   meaning='building code: NTC 2018 with Circolare 7/2019'), &
      & property_type('ag', is_list, unit='g', optional=.true., instead=coordinates, smallest=0.001_wp, largest=1.0_wp, &
      &   example='0.2', meaning='peak acceleration on rigid, level ground: one for all limit states, or those of SLD, SLV '// &
      &   'and SLC'), &
      & property_type('f0', is_list, optional=.true., instead=coordinates, smallest=2.2_wp, largest=5.0_wp, example='2.5', &
      &   meaning='largest amplification of the spectrum there, one or three'), &
      & property_type('tc_star', is_list, unit='s', optional=.true., instead=coordinates, smallest=0.05_wp, largest=2.0_wp, &
      &   example='0.35', meaning='period at which the constant velocity begins there, one or three'), &
      & property_type('latitude', unit='deg', optional=.true., smallest=35.0_wp, largest=48.0_wp, example='42.3498', &
      &   if_less='is it the longitude?', &
      &   meaning='latitude of the site (WGS84): with longitude and nominal_life it gives ag, f0 and tc_star of all limit '// &
      &   'states'), &
      & property_type('longitude', unit='deg', optional=.true., smallest=6.0_wp, largest=19.0_wp, example='13.3999', &
      &   if_more='is it the latitude?', meaning='longitude of the site (WGS84)'), &
      & property_type('nominal_life', unit='year', optional=.true., positive=.true., largest=1.0e3_wp, usual_least=10.0_wp, &
      &   example='50.0', meaning='nominal life V_N, with latitude and longitude; V_R = C_U V_N'), &
      & property_type('use_class', is_text, word='II', meaning='class of use, with its coefficient C_U', &
      &   choices=reshape([character(len=choices_length) :: use_classes], [most_choices], pad=blank)), &
      & property_type('soil', is_text, word='A', meaning='class of soil', &
      &   choices=reshape([character(len=choices_length) :: soil_names], [most_choices], pad=blank)), &
      & property_type('topography', is_text, word='T1', meaning='class of topography', &
      &   choices=reshape([character(len=choices_length) :: topography_names], [most_choices], pad=blank)), &
      & property_type('knowledge_factor', default=full_factor, smallest=1.0_wp, largest=full_factor, &
      &   meaning='confidence factor FC; the code has 1, 1.2 and 1.35, and the check takes the last of them for a wall '// &
      &   'without compressive_strength'), &
      & property_type('behaviour', default=2.0_wp, smallest=1.0_wp, largest=2.0_wp, &
      &   meaning='behaviour factor q of the linear check'), &
      & property_type('ultimate_state', is_text, word='SLV', meaning='ultimate limit state that the verdict rests on (NTC 8.3)', &
      &   choices=reshape([character(len=choices_length) :: state_names(2:3)], [most_choices], pad=blank)), &
      & property_type('friction', optional=.true., positive=.true., largest=2.0_wp, example='0.6', &
      &   meaning='coefficient of friction at the hinges, for which a wall is marked that slides before it turns'), &
      & property_type('building_period', is_list, unit='s', optional=.true., positive=.true., largest=20.0_wp, &
      &   usual_least=0.02_wp, usual_most=4.0_wp, example='0.30, 0.45, 0.60', &
      &   meaning='period of the first mode of the building, one for all limit states or those of SLD, SLV and SLC; if not '// &
      &   'given, SLV and SLC take the worst of 1 to 2 times that of &building'), &
      & property_type('building_damping', is_list, optional=.true., positive=.true., largest=1.0_wp, less=.true., &
      &   usual_most=0.4_wp, example='0.05, 0.10, 0.20', &
      &   meaning='damping ratio of the modes of the building, one or three, with building_period; that of &building if not '// &
      &   'given'), &
      & property_type('reference_life', unit='year', optional=.true., positive=.true., largest=1.0e3_wp, usual_least=10.0_wp, &
      &   example='50.0', meaning='reference period V_R, for return periods, with exceedance'), &
      & property_type('exceedance', is_list, optional=.true., positive=.true., largest=1.0_wp, less=.true., &
      &   example='0.63, 0.10, 0.05', &
      &   meaning='probabilities of exceedance in that period of SLD, SLV and SLC, whose return periods ag, f0 and tc_star have')]

   !> A check
   type :: check_input_type
      !> Of each limit state: peak acceleration on rigid ground [g], amplification, period [s]; of one element if all have
      !> the same
      real(wp), allocatable :: ag(:), f0(:), tc_star(:)
      !> Where these come from; not allocated: they are given
      type(site_hazard_type), allocatable :: place
      !> Class of use
      character(len=3) :: use_class = 'II'
      !> Classes of soil and of topography
      character(len=1) :: soil = 'A'
      character(len=2) :: topography = 'T1'
      !> Confidence factor FC, and that which is given where the code asks for more; 0: it does not
      real(wp) :: knowledge_factor = full_factor, knowledge_given = 0.0_wp
      !> Behaviour factor q
      real(wp) :: behaviour = 2.0_wp
      !> Ultimate limit state that the verdict rests on
      character(len=3) :: ultimate_state = 'SLV'
      !> Coefficient of friction at the hinges; 0: not given
      real(wp) :: friction = 0.0_wp
      !> Period of the first mode of the building [s] and damping ratio of its modes, of each limit state; of size 0: not given
      real(wp), allocatable :: building_period(:), building_damping(:)
      !> Reference period V_R [years], 0: not given; probabilities of exceedance in it, three or none
      real(wp) :: reference_life = 0.0_wp
      real(wp), allocatable :: exceedance(:)
   contains
      !> Spectrum of the ground in a limit state
      procedure :: spectrum
      !> Has each limit state its own hazard?
      procedure :: has_states
      !> Return period of the hazard of a limit state
      procedure :: return_period
      !> Return period of a peak acceleration
      procedure :: return_period_of
      procedure, private :: hazard
      procedure :: hold_knowledge
      !> Are period and damping of the building given for the limit states?
      procedure :: has_building_period, has_building_damping
      procedure :: requires
   end type check_input_type

contains

   !> Make a check from its settings
   subroutine take_check(input, settings, problems)
      type(check_input_type), intent(out) :: input
      !> Values of check_properties, without defaults
      class(settings_type), intent(inout) :: settings
      !> Takes what is wrong
      type(problems_type), intent(inout) :: problems

      call settings%fill()
      call check_settings(settings, problems)
      input%use_class = settings%word('use_class')
      if (settings%has('latitude') .or. settings%has('longitude')) then
         call take_place(input, settings, problems)
      else
         call take_hazard(input, settings, problems)
      end if
      input%soil = settings%word('soil')
      input%topography = settings%word('topography')
      input%knowledge_factor = settings%number('knowledge_factor')
      input%behaviour = settings%number('behaviour')
      input%ultimate_state = settings%word('ultimate_state')
      if (settings%has('friction')) input%friction = settings%number('friction')
      call take_building(input, settings, problems)
      if (input%ultimate_state == 'SLC' .and. allocated(input%ag)) then
         if (size(input%ag) == 1) call problems%note('ultimate_state = ''SLC'': needs the hazard of SLC: give ag of SLD, SLV '// &
            & 'and SLC, or '//coordinates, not_together, 'ultimate_state')
      end if
   end subroutine take_check

   !> Take period and damping of the building in each limit state
   subroutine take_building(input, settings, problems)
      type(check_input_type), intent(inout) :: input
      class(settings_type), intent(in) :: settings
      type(problems_type), intent(inout) :: problems

      input%building_period = of_states('building_period')
      input%building_damping = of_states('building_damping')
      if (settings%has('building_damping') .and. .not. settings%has('building_period')) call problems%note( &
         & 'building_damping: only with building_period; more damping without a longer period is unconservative', &
         & not_together, 'building_damping')

   contains

      !> The values of the three limit states, of size 0 where none is given
      function of_states(name) result(values)
         !> Name of the property
         character(len=*), intent(in) :: name
         real(wp), allocatable :: values(:)

         integer :: i

         values = settings%list(name)
         if (settings%has(name) .and. all(size(values) /= [1, size(state_names)])) call problems%note(name//': has '// &
            & to_text(size(values))//' values, must have one, or three: SLD, SLV, SLC', wrong_length, name)
         if (size(values) == 1) values = [(values(1), i=1, size(state_names))]
      end function of_states

   end subroutine take_building

   !> Take the coordinates of the site, and from the grid of hazard what follows from them
   subroutine take_place(input, settings, problems)
      type(check_input_type), intent(inout) :: input
      class(settings_type), intent(in) :: settings
      type(problems_type), intent(inout) :: problems

      character(len=*), parameter :: needed(3) = [character(len=12) :: 'latitude', 'longitude', 'nominal_life']
      real(wp) :: values(3)
      integer :: i

      do i = 1, size(determined)
         if (settings%has(trim(determined(i)))) call problems%note(trim(determined(i))//': not with '//coordinates// &
            & ', from which it follows', not_together, trim(determined(i)))
      end do
      do i = 1, size(needed)
         if (.not. settings%has(trim(needed(i)))) call problems%note(trim(needed(i))//': must be given, since the site is '// &
            & 'given by '//coordinates, not_given, trim(needed(i)))
      end do
      if (problems%count > 0) return
      allocate (input%place)
      associate (found => input%place)
         call new_site_hazard(found, settings%number('latitude'), settings%number('longitude'), &
            & settings%number('nominal_life'), input%use_class)
         if (.not. found%is_covered()) then
            call problems%note('latitude = '//to_text(found%latitude)//', longitude = '//to_text(found%longitude)//': outside '// &
               & 'the grid of hazard (D.M. 14-1-2008, annex B, table 1), which has the mainland and Sicily without Sardinia, '// &
               & 'the Tuscan, Pontine, Tremiti, Aeolian and Egadi islands, Ustica, Pantelleria, Lampedusa and Linosa; give ag, '// &
               & 'f0 and tc_star', out_of_range, 'latitude')
            return
         end if
         allocate (input%ag(size(state_names)), input%f0(size(state_names)), input%tc_star(size(state_names)))
         do i = 1, size(state_names)
            values = found%values(i)
            input%ag(i) = values(1)
            input%f0(i) = values(2)
            input%tc_star(i) = values(3)
         end do
         input%reference_life = found%reference_life()
         input%exceedance = state_exceedance
      end associate
   end subroutine take_place

   !> Take a_g, F_0 and T_C*, with their return periods
   subroutine take_hazard(input, settings, problems)
      type(check_input_type), intent(inout) :: input
      class(settings_type), intent(in) :: settings
      type(problems_type), intent(inout) :: problems

      if (settings%has('nominal_life')) call problems%note('nominal_life: only with '//coordinates//'; give reference_life', &
         & not_together, 'nominal_life')
      call take_list('ag', input%ag)
      call take_list('f0', input%f0)
      call take_list('tc_star', input%tc_star)
      if (settings%has('reference_life')) input%reference_life = settings%number('reference_life')
      input%exceedance = settings%list('exceedance')
      if (settings%has('reference_life') .neqv. settings%has('exceedance')) call problems%note('reference_life: must be '// &
         & 'given with exceedance', not_given, 'reference_life')
      if (all(size(input%exceedance) /= [0, 3])) call problems%note('exceedance: has '//to_text(size(input%exceedance))// &
         & ' values, must have three: SLD, SLV, SLC', wrong_length, 'exceedance')
      if (any(input%exceedance(2:) >= input%exceedance(:size(input%exceedance) - 1))) call problems%note('exceedance: must '// &
         & 'decrease from SLD to SLC', out_of_range, 'exceedance')

   contains

      !> Take one value or three
      subroutine take_list(name, values)
         !> Name of the property
         character(len=*), intent(in) :: name
         !> Its values
         real(wp), allocatable, intent(out) :: values(:)

         values = settings%list(name)
         if (.not. settings%has(name)) call problems%note(name//': must be given, or '//coordinates, not_given, name)
         if (settings%has(name) .and. all(size(values) /= [1, 3])) call problems%note(name//': has '// &
            & to_text(size(values))//' values, must have one, or three: SLD, SLV, SLC', wrong_length, name)
         if (name == 'ag' .and. any(values(2:) < values(:size(values) - 1))) call problems%note('ag: must not decrease '// &
            & 'from SLD to SLC', not_increasing, 'ag')
      end subroutine take_list

   end subroutine take_hazard

   !> A check as settings
   subroutine put_check(input, settings)
      type(check_input_type), intent(in) :: input
      !> Values of check_properties
      class(settings_type), intent(inout) :: settings

      call settings%set('code', trim(code_names(1)))
      if (allocated(input%place)) then
         call settings%set('latitude', input%place%latitude)
         call settings%set('longitude', input%place%longitude)
         call settings%set('nominal_life', input%place%nominal_life)
      else
         call settings%set('ag', input%ag)
         call settings%set('f0', input%f0)
         call settings%set('tc_star', input%tc_star)
         if (input%reference_life > 0.0_wp) call settings%set('reference_life', input%reference_life)
         if (size(input%exceedance) > 0) call settings%set('exceedance', input%exceedance)
      end if
      call settings%set('use_class', trim(input%use_class))
      call settings%set('soil', input%soil)
      call settings%set('topography', input%topography)
      call settings%set('knowledge_factor', input%knowledge_factor)
      call settings%set('behaviour', input%behaviour)
      call settings%set('ultimate_state', input%ultimate_state)
      if (input%friction > 0.0_wp) call settings%set('friction', input%friction)
      if (input%has_building_period()) call settings%set('building_period', input%building_period)
      if (input%has_building_damping()) call settings%set('building_damping', input%building_damping)
   end subroutine put_check

   !> Take the confidence factor of LC1 for a wall whose multiplier does not account for its compressive strength, whatever is known
   !> of it: C8.7.1.2.1.3
   pure subroutine hold_knowledge(self)
      class(check_input_type), intent(inout) :: self

      if (.not. self%knowledge_factor < full_factor) return
      self%knowledge_given = self%knowledge_factor
      self%knowledge_factor = full_factor
   end subroutine hold_knowledge

   !> Is the period of the building given for the limit states?
   pure logical function has_building_period(self) result(has)
      class(check_input_type), intent(in) :: self

      has = allocated(self%building_period)
      if (has) has = size(self%building_period) > 0
   end function has_building_period

   !> Is its damping?
   pure logical function has_building_damping(self) result(has)
      class(check_input_type), intent(in) :: self

      has = allocated(self%building_damping)
      if (has) has = size(self%building_damping) > 0
   end function has_building_damping

   !> Does the verdict on a wall rest on a check? It does on that of the ultimate state, and for class IV on the damage state too:
   !> NTC 8.3
   pure logical function requires(self, method, state)
      class(check_input_type), intent(in) :: self
      !> Part of the check and limit state
      character(len=*), intent(in) :: method, state

      requires = (method == 'nonlinear' .and. state == self%ultimate_state) .or. (state == 'SLD' .and. self%use_class == 'IV')
   end function requires

   !> Has each limit state its own hazard?
   pure logical function has_states(self)
      class(check_input_type), intent(in) :: self

      has_states = max(size(self%ag), size(self%f0), size(self%tc_star)) > 1
   end function has_states

   !> Return period of the hazard of a limit state [years]
   pure real(wp) function return_period(self, state)
      class(check_input_type), intent(in) :: self
      !> Its number in state_names
      integer, intent(in) :: state

      if (allocated(self%place)) then
         return_period = self%place%years(state)
      else
         return_period = return_period_of_exceedance(self%reference_life, self%exceedance(state))
      end if
   end function return_period

   !> Return period of a peak acceleration at the site, linear in the logarithms of both between the hazards of the limit states,
   !> and along the nearer of these lines beyond [years]; 0 where fewer than three hazards or no reference period are given
   pure real(wp) function return_period_of(self, ag) result(years)
      class(check_input_type), intent(in) :: self
      !> [g]
      real(wp), intent(in) :: ag

      integer :: i

      years = 0.0_wp
      if (.not. self%reference_life > 0.0_wp .or. size(self%ag) < 3) return
      if (any(self%ag(2:) <= self%ag(:2))) return
      i = merge(1, 2, ag < self%ag(2))
      associate (a => self%ag(i:i + 1), first => self%return_period(i), second => self%return_period(i + 1))
         years = first*(second/first)**(log(ag/a(1))/log(a(2)/a(1)))
      end associate
   end function return_period_of

   !> a_g, F_0 and T_C* of a limit state
   pure function hazard(self, state) result(values)
      class(check_input_type), intent(in) :: self
      !> Its number in state_names
      integer, intent(in) :: state
      !> The values
      real(wp) :: values(3)

      values = [self%ag(min(state, size(self%ag))), self%f0(min(state, size(self%f0))), &
         & self%tc_star(min(state, size(self%tc_star)))]
   end function hazard

   !> Spectrum of the ground in a limit state
   pure function spectrum(self, state)
      class(check_input_type), intent(in) :: self
      !> Its number in state_names
      integer, intent(in) :: state
      !> The spectrum
      type(elastic_spectrum_type) :: spectrum

      real(wp) :: values(3)

      values = self%hazard(state)
      spectrum = ntc_spectrum(values(1), values(2), values(3), self%soil, self%topography)
   end function spectrum

end module dondolo_check_input
