!> What a user says of a check by a building code: the site's hazard, and what the code leaves to the engineer.
module dondolo_check_input
   use dondolo_base_error, only : not_given, not_increasing, out_of_range, problems_type, wrong_length
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : blank, choices_length, is_list, is_text, most_choices, property_type
   use dondolo_base_settings, only : settings_type
   use dondolo_base_settings_check, only : check_settings
   use dondolo_base_text, only : to_text
   use dondolo_check_code_spectrum, only : elastic_spectrum_type, ntc_spectrum, soil_names, topography_names
   implicit none
   private

   public :: check_input_type, take_check, put_check
   public :: check_properties, state_names

   !> Limit states: damage, life safety, collapse
   character(len=*), parameter :: state_names(3) = [character(len=3) :: 'SLD', 'SLV', 'SLC']

   !> Codes
   character(len=choices_length), parameter :: code_names(*) = [character(len=choices_length) :: 'ntc2018']

   !> What a user can set
   type(property_type), target, protected :: check_properties(10) = [ &
      & property_type('code', is_text, word='ntc2018', choices=reshape(code_names, [most_choices], pad=blank), &
      &   meaning='building code: NTC 2018 with Circolare 7/2019'), &
      & property_type('ag', is_list, unit='g', required=.true., smallest=0.001_wp, largest=1.0_wp, example='0.2', &
      &   meaning='peak acceleration on rigid, level ground: one for all limit states, or those of SLD, SLV and SLC'), &
      & property_type('f0', is_list, required=.true., smallest=2.2_wp, largest=5.0_wp, example='2.5', &
      &   meaning='largest amplification of the spectrum there, one or three'), &
      & property_type('tc_star', is_list, unit='s', required=.true., smallest=0.05_wp, largest=2.0_wp, example='0.35', &
      &   meaning='period at which the constant velocity begins there, one or three'), &
      & property_type('soil', is_text, word='A', meaning='class of soil', &
      &   choices=reshape([character(len=choices_length) :: soil_names], [most_choices], pad=blank)), &
      & property_type('topography', is_text, word='T1', meaning='class of topography', &
      &   choices=reshape([character(len=choices_length) :: topography_names], [most_choices], pad=blank)), &
      & property_type('knowledge_factor', default=1.35_wp, smallest=1.0_wp, largest=1.35_wp, &
      &   meaning='confidence factor FC; the code has 1, 1.2 and 1.35, the last of them where no compressive strength '// &
      &   'moves the hinge'), &
      & property_type('behaviour', default=2.0_wp, smallest=1.0_wp, largest=2.0_wp, &
      &   meaning='behaviour factor q of the linear check'), &
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
      !> Classes of soil and of topography
      character(len=1) :: soil = 'A'
      character(len=2) :: topography = 'T1'
      !> Confidence factor FC
      real(wp) :: knowledge_factor = 1.35_wp
      !> Behaviour factor q
      real(wp) :: behaviour = 2.0_wp
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
      call take_list('ag', input%ag)
      call take_list('f0', input%f0)
      call take_list('tc_star', input%tc_star)
      input%soil = settings%word('soil')
      input%topography = settings%word('topography')
      input%knowledge_factor = settings%number('knowledge_factor')
      input%behaviour = settings%number('behaviour')
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
         if (settings%has(name) .and. all(size(values) /= [1, 3])) call problems%note(name//': has '// &
            & to_text(size(values))//' values, must have one, or three: SLD, SLV, SLC', wrong_length, name)
         if (name == 'ag' .and. any(values(2:) < values(:size(values) - 1))) call problems%note('ag: must not decrease '// &
            & 'from SLD to SLC', not_increasing, 'ag')
      end subroutine take_list

   end subroutine take_check

   !> A check as settings
   subroutine put_check(input, settings)
      type(check_input_type), intent(in) :: input
      !> Values of check_properties
      class(settings_type), intent(inout) :: settings

      call settings%set('code', trim(code_names(1)))
      call settings%set('ag', input%ag)
      call settings%set('f0', input%f0)
      call settings%set('tc_star', input%tc_star)
      call settings%set('soil', input%soil)
      call settings%set('topography', input%topography)
      call settings%set('knowledge_factor', input%knowledge_factor)
      call settings%set('behaviour', input%behaviour)
      if (input%reference_life > 0.0_wp) call settings%set('reference_life', input%reference_life)
      if (size(input%exceedance) > 0) call settings%set('exceedance', input%exceedance)
   end subroutine put_check

   !> Has each limit state its own hazard?
   pure logical function has_states(self)
      class(check_input_type), intent(in) :: self

      has_states = max(size(self%ag), size(self%f0), size(self%tc_star)) > 1
   end function has_states

   !> Return period of the hazard of a limit state, T_R = -V_R/ln(1 - P_VR) [years]: NTC 2018, 3.2.1
   pure real(wp) function return_period(self, state)
      class(check_input_type), intent(in) :: self
      !> Its number in state_names
      integer, intent(in) :: state

      return_period = -self%reference_life/log(1.0_wp - self%exceedance(state))
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
