!> Checks of a wall by NTC 2018 and Circolare 7/2019, C8.7.1.2.1: kinematic, linear and nonlinear, and the criterion for
!> time histories. What is computed is a sheet, every number with its formula.
!>
!>     SLD, linear      a_Z <= a_0*, a_0* = alpha_0 g/(e* FC)                                        C8.7.1.8
!>     SLV, linear      a_g = q times that of the linear check that starts the mechanism, q = 2
!>     SLV, nonlinear   d_SLV = 0.4 d_0* or where ties break that carry more than half of the greatest a,
!>                      T = 1.68 pi sqrt(d/a(d)), xi = 8 %                                           C8.7.1.10
!>     SLC, nonlinear   d_SLC = 0.6 d_0* or where a load loses its seat, T = 1.56 pi sqrt(d/a(d)), xi = 10 %   C8.7.1.11
!>     dynamic          no history beyond d_0*, mean of the largest d at most d_SLV or d_SLC         C8.7.1.2.1.9
!>
!> The a_g that a wall withstands is the site's, scaled until capacity and demand are equal; shape and soil factor of the spectrum
!> stay. That of the nonlinear check is not below the one that starts the mechanism.
module dondolo_check_ntc_check
   use dondolo_base_kinds, only : wp
   use dondolo_check_code_spectrum, only : damping_factor
   use dondolo_check_floor_spectrum, only : floor_spectrum_type, new_floor_spectrum
   use dondolo_check_input, only : check_input_type, state_names
   use dondolo_check_kinematic, only : kinematic_type
   use dondolo_check_sheet, only : sheet_type, shown, working_type
   use dondolo_check_tie_rows, only : put_ties
   use dondolo_fragility, only : fragility_type
   implicit none
   private

   public :: check_ntc, check_histories, capacity_displacement

   !> Factors of the period and damping ratios of the nonlinear check, SLV and SLC
   real(wp), parameter :: period_factors(2:3) = [1.68_wp, 1.56_wp], dampings(2:3) = [0.08_wp, 0.10_wp]
   !> Displacements that it allows / d_0*
   real(wp), parameter :: shares(2:3) = [0.4_wp, 0.6_wp]
   !> Return periods beyond which only a bound is given [years]: assumed, no text of the code was read that has them
   real(wp), parameter :: first_year = 30.0_wp, last_year = 2475.0_wp

contains

   !> Kinematic check of a wall
   subroutine check_ntc(sheet, kinematic, input, curve)
      type(sheet_type), intent(out) :: sheet
      type(kinematic_type), intent(in) :: kinematic
      type(check_input_type), intent(in) :: input
      !> Curve of collapse over the peak acceleration at the site [g]: the sheet then has probabilities
      type(fragility_type), intent(in), optional :: curve

      type(floor_spectrum_type) :: spectrum
      integer :: i

      do i = 1, merge(3, 1, input%has_states())
         call put_site(sheet, kinematic, input, i)
      end do
      call put_mechanism(sheet, kinematic, input)
      call put_ties(sheet, kinematic%anchors, input%knowledge_factor)
      spectrum = spectrum_of(kinematic, input, 1)
      call put_linear(sheet, kinematic, input, spectrum, 1)
      spectrum = spectrum_of(kinematic, input, 2)
      call put_linear(sheet, kinematic, input, spectrum, 2)
      do i = 2, 3
         spectrum = spectrum_of(kinematic, input, i)
         call put_nonlinear(sheet, kinematic, input, spectrum, i)
      end do
      if (present(curve)) call put_probabilities(sheet, curve)
   end subroutine check_ntc

   !> Spectrum at the level of the wall
   pure function spectrum_of(kinematic, input, state) result(spectrum)
      type(kinematic_type), intent(in) :: kinematic
      type(check_input_type), intent(in) :: input
      !> Number of the limit state
      integer, intent(in) :: state
      !> The spectrum
      type(floor_spectrum_type) :: spectrum

      spectrum = new_floor_spectrum(input%spectrum(state), kinematic%period, kinematic%damping, kinematic%participation)
   end function spectrum_of

   !> Put the probability of collapse behind each peak acceleration at the site, the site's own and what the wall withstands
   pure subroutine put_probabilities(sheet, curve)
      type(sheet_type), intent(inout) :: sheet
      type(fragility_type), intent(in) :: curve

      type(sheet_type) :: longer
      integer :: i

      if (.not. curve%has_fit()) return
      do i = 1, size(sheet%rows)
         associate (row => sheet%rows(i))
            call longer%append(row)
            if (row%quantity%name == 'pga' .or. row%quantity%name == 'capacity_pga') call longer%add(row%method, row%state, &
               & 'probability', curve%probability(row%value))
         end associate
      end do
      sheet = longer
   end subroutine put_probabilities

   !> Put the hazard of the site
   pure subroutine put_site(sheet, kinematic, input, state)
      type(sheet_type), intent(inout) :: sheet
      type(kinematic_type), intent(in) :: kinematic
      type(check_input_type), intent(in) :: input
      !> Number of the limit state; all have the hazard of the first if there is only one
      integer, intent(in) :: state

      type(floor_spectrum_type) :: spectrum
      character(len=4) :: name
      real(wp) :: ag

      name = ''
      if (input%has_states()) name = state_names(state)
      spectrum = spectrum_of(kinematic, input, state)
      associate (ground => spectrum%ground)
         call sheet%add('site', name, 'ag', ground%pga/ground%soil_factor)
         call sheet%add('site', name, 'f0', ground%amplification)
         call sheet%add('site', name, 'tc_star', input%tc_star(min(state, size(input%tc_star))))
         ag = ground%pga/ground%soil_factor
         call sheet%add('site', name, 'stratigraphy', ground%soil_factor/ground%topography_factor, 'NTC 3.2.3.2.1')
         call sheet%add('site', name, 'topography', ground%topography_factor, 'NTC 3.2.3.2.1')
         call sheet%add('site', name, 'soil_factor', ground%soil_factor, 'NTC 3.2.3.2.1', working=working_type('S_S S_T', &
            & times(ground%soil_factor/ground%topography_factor, ground%topography_factor)))
         call sheet%add('site', name, 'tb', ground%corners(1), 'NTC 3.2.3.2.1', working=working_type('T_C/3', &
            & trim(shown(ground%corners(2)))//'/3'))
         call sheet%add('site', name, 'tc', ground%corners(2), 'NTC 3.2.3.2.1')
         call sheet%add('site', name, 'td', ground%corners(3), 'NTC 3.2.3.2.1', working=working_type('4 a_g + 1.6', &
            & '4 * '//trim(shown(ag))//' + 1.6'))
         call sheet%add('site', name, 'pga', ground%pga, working=working_type('a_g S', times(ag, ground%soil_factor)))
         if (input%reference_life > 0.0_wp .and. input%has_states()) then
            call sheet%add('site', name, 'reference_life', input%reference_life)
            call sheet%add('site', name, 'return_period_demand', input%return_period(state), 'NTC 3.2.1', &
               & working=working_type('-V_R/ln(1 - P_VR)', '-'//trim(shown(input%reference_life))//'/ln(1 - '// &
               & trim(shown(input%exceedance(state)))//')'))
         end if
         if (size(spectrum%period) > 0) call sheet%add('site', name, 'floor_pga', spectrum%peak_acceleration(), 'C7.2.3')
      end associate
   end subroutine put_site

   !> Put the numbers of the mechanism
   subroutine put_mechanism(sheet, kinematic, input)
      type(sheet_type), intent(inout) :: sheet
      type(kinematic_type), intent(in) :: kinematic
      type(check_input_type), intent(in) :: input

      call sheet%add('mechanism', '', 'knowledge_factor', input%knowledge_factor, 'C8.7.1.2.1.3')
      call sheet%add('mechanism', '', 'alpha_0', kinematic%multiplier, 'C8.7.1.1', &
         & working=working_type('(sum stabilising - sum overturning)/sum P z', '('//trim(shown(kinematic%stabilising))//' - '// &
         & trim(shown(kinematic%overturning))//')/'//shown(kinematic%first)))
      call sheet%add('mechanism', '', 'mass', kinematic%mass, 'C8.7.1.5', working=working_type('(sum P z)^2/(g sum P z^2)', &
         & trim(shown(kinematic%first))//'^2/('//times(kinematic%gravity, kinematic%second)//')'))
      call sheet%add('mechanism', '', 'mass_ratio', kinematic%mass_ratio, 'C8.7.1.5', working=working_type('g M*/sum P', &
         & times(kinematic%gravity, kinematic%mass)//'/'//shown(kinematic%weight)))
      call sheet%add('mechanism', '', 'a_0', kinematic%capacity(0.0_wp, input%knowledge_factor), 'C8.7.1.3', &
         & working=working_type('alpha_0 g/(e* FC)', times(kinematic%multiplier, kinematic%gravity)//'/('// &
         & times(kinematic%mass_ratio, input%knowledge_factor)//')'))
      call sheet%add('mechanism', '', 'd_0', kinematic%end_displacement, 'C8.7.1.4')
      if (kinematic%level > 0.0_wp) call sheet%add('mechanism', '', 'level', kinematic%level)
      if (kinematic%diaphragm_period > 0.0_wp) call sheet%add('mechanism', '', 'diaphragm_period', kinematic%diaphragm_period)
      if (kinematic%weakest_hinge > 0.0_wp) then
         call sheet%add('mechanism', '', 'weakest_hinge', kinematic%weakest_hinge)
         call sheet%add('mechanism', '', 'weakest_alpha_0', kinematic%weakest_multiplier, 'C8.7.1.1')
      end if
      if (kinematic%tie_fracture < huge(1.0_wp)) call sheet%add('mechanism', '', 'tie_fracture', kinematic%tie_fracture, &
         & 'C8.7.1.4')
   end subroutine put_mechanism

   !> Put a linear check: of SLD, or of SLV with the behaviour factor
   subroutine put_linear(sheet, kinematic, input, spectrum, state)
      type(sheet_type), intent(inout) :: sheet
      type(kinematic_type), intent(in) :: kinematic
      type(check_input_type), intent(in) :: input
      type(floor_spectrum_type), intent(in) :: spectrum
      !> Number of the limit state
      integer, intent(in) :: state

      character(len=3) :: name
      real(wp) :: factor
      logical :: is_brittle

      name = state_names(state)
      factor = 1.0_wp
      if (state == 2) then
         factor = input%behaviour
         call sheet%add('linear', name, 'behaviour', factor, 'C8.7.1.2.1.7')
      end if
      call sheet%add('linear', name, 'floor_pga', spectrum%peak_acceleration(), merge('C8.7.1.8', 'C7.2.3  ', &
         & size(spectrum%period) == 0))
      ! An anchor that gives way has none of the ductility that q stands for
      is_brittle = factor > 1.0_wp .and. any(kinematic%anchors%is_brittle())
      if (is_brittle) call sheet%add('linear', name, 'applicable', 0.0_wp)
      call put_capacity(sheet, 'linear', name, factor*activation(kinematic, input, spectrum), spectrum, input, .not. is_brittle, &
         & working=working_type('q a_0*/(g a_Z)', times(factor, kinematic%capacity(0.0_wp, input%knowledge_factor))//'/('// &
         & times(kinematic%gravity, spectrum%peak_acceleration())//')'))
   end subroutine put_linear

   !> Factor on the site's a_g at which the mechanism starts
   real(wp) function activation(kinematic, input, spectrum) result(factor)
      type(kinematic_type), intent(in) :: kinematic
      type(check_input_type), intent(in) :: input
      type(floor_spectrum_type), intent(in) :: spectrum

      factor = kinematic%capacity(0.0_wp, input%knowledge_factor)/(kinematic%gravity*spectrum%peak_acceleration())
   end function activation

   !> Displacement that the nonlinear check allows in a limit state [m]
   pure real(wp) function capacity_displacement(kinematic, state) result(d)
      type(kinematic_type), intent(in) :: kinematic
      !> 2: SLV, 3: SLC
      integer, intent(in) :: state

      ! The text names the loss of a seat for SLC alone, but SLV comes first
      d = min(shares(state)*kinematic%end_displacement, kinematic%unseating)
      if (state == 2) d = min(d, kinematic%tie_fracture)
   end function capacity_displacement

   !> Put a nonlinear check
   subroutine put_nonlinear(sheet, kinematic, input, spectrum, state)
      type(sheet_type), intent(inout) :: sheet
      type(kinematic_type), intent(in) :: kinematic
      type(check_input_type), intent(in) :: input
      type(floor_spectrum_type), intent(in) :: spectrum
      !> 2: SLV, 3: SLC
      integer, intent(in) :: state

      real(wp), parameter :: pi = acos(-1.0_wp)
      character(len=3) :: name
      character(len=:), allocatable :: expression, numbers
      real(wp) :: d, a, period, demand

      name = state_names(state)
      d = capacity_displacement(kinematic, state)
      a = kinematic%capacity(d, input%knowledge_factor)
      period = period_factors(state)*pi*sqrt(d/a)
      demand = spectrum%displacement(period, dampings(state), kinematic%gravity)
      expression = trim(merge('0.4 d_0*', '0.6 d_0*', state == 2))
      numbers = times(shares(state), kinematic%end_displacement)
      if (d < shares(state)*kinematic%end_displacement) then
         expression = trim(merge('where ties break     ', 'where a seat is lost ', d < kinematic%unseating))
         numbers = ''
      end if
      call sheet%add('nonlinear', name, 'displacement', d, 'C8.7.1.2.1.6', working=working_type(expression, numbers))
      call sheet%add('nonlinear', name, 'acceleration', a, 'C8.7.1.3', working=working_type('alpha(d_C) g/(e* FC)', &
         & times(a*kinematic%mass_ratio*input%knowledge_factor/kinematic%gravity, kinematic%gravity)//'/('// &
         & times(kinematic%mass_ratio, input%knowledge_factor)//')'))
      call sheet%add('nonlinear', name, 'period', period, merge('C8.7.1.10', 'C8.7.1.11', state == 2), &
         & working=working_type(merge('1.68', '1.56', state == 2)//' pi sqrt[d_C/a(d_C)]', &
         & merge('1.68', '1.56', state == 2)//' * pi * sqrt('//trim(shown(d))//'/'//trim(shown(a))//')'))
      call sheet%add('nonlinear', name, 'damping', dampings(state), 'C8.7.1.2.1.8')
      call sheet%add('nonlinear', name, 'eta', damping_factor(dampings(state)), 'NTC 3.2.3.2.1', &
         & working=working_type('sqrt[10/(5 + 100 xi)]', 'sqrt(10/(5 + 100 * '//trim(shown(dampings(state)))//'))'))
      call put_ordinate_formula(spectrum, period, dampings(state), expression, numbers)
      call sheet%add('nonlinear', name, 'spectral_demand', spectrum%acceleration(period, dampings(state)), &
         & merge('NTC 3.2.3.2.1', 'C7.2.3       ', size(spectrum%period) == 0), working=working_type(expression, numbers))
      call sheet%add('nonlinear', name, 'demand', demand, merge('NTC 3.2.3.2.3', 'C8.7.1.12    ', size(spectrum%period) == 0), &
         & working=working_type('S_e(T) g (T/2 pi)^2', times(spectrum%acceleration(period, dampings(state)), kinematic%gravity)// &
         & ' * ('//trim(shown(period))//'/(2 * pi))^2'))
      call put_capacity(sheet, 'nonlinear', name, max(d/demand, activation(kinematic, input, spectrum)), spectrum, input, &
         & is_applicable=.true., working=working_type('max[d_C/d_D, a_0*/(g a_Z)]', 'max('//trim(shown(d))//'/'// &
         & trim(shown(demand))//', '//trim(shown(kinematic%capacity(0.0_wp, input%knowledge_factor)))//'/('// &
         & times(kinematic%gravity, spectrum%peak_acceleration())//'))'))
   end subroutine put_nonlinear

   !> The formula of an ordinate of the spectrum of the ground; in a building it is a sum over modes
   pure subroutine put_ordinate_formula(spectrum, period, damping, expression, numbers)
      type(floor_spectrum_type), intent(in) :: spectrum
      !> Period [s] and damping ratio
      real(wp), intent(in) :: period, damping
      !> In symbols and in numbers
      character(len=:), allocatable, intent(out) :: expression, numbers

      expression = ''
      numbers = ''
      if (size(spectrum%period) > 0) return
      associate (ground => spectrum%ground, tb => spectrum%ground%corners(1), tc => spectrum%ground%corners(2), &
         & td => spectrum%ground%corners(3))
         numbers = times(ground%pga, damping_factor(damping))//' * '//trim(shown(ground%amplification))
         expression = 'a_g S eta F_0'
         if (period < tb) then
            expression = 'a_g S [1 + T/T_B (eta F_0 - 1)]'
            numbers = trim(shown(ground%pga))//' * (1 + '//trim(shown(period))//'/'//trim(shown(tb))//' * ('// &
               & times(damping_factor(damping), ground%amplification)//' - 1))'
         else if (period >= td) then
            expression = expression//' T_C T_D/T^2'
            numbers = numbers//' * '//times(tc, td)//'/'//trim(shown(period))//'^2'
         else if (period >= tc) then
            expression = expression//' T_C/T'
            numbers = numbers//' * '//trim(shown(tc))//'/'//trim(shown(period))
         end if
      end associate
   end subroutine put_ordinate_formula

   !> Length of a product
   pure integer function product_length(first, second) result(length)
      real(wp), intent(in) :: first, second

      length = len_trim(shown(first)) + len_trim(shown(second)) + 3
   end function product_length

   !> A product in a formula
   pure function times(first, second) result(text)
      real(wp), intent(in) :: first, second
      character(len=product_length(first, second)) :: text

      text = trim(shown(first))//' * '//trim(shown(second))
   end function times

   !> Put the a_g that a wall withstands
   pure subroutine put_capacity(sheet, method, state, factor, spectrum, input, is_applicable, working)
      type(sheet_type), intent(inout) :: sheet
      !> Part of the check and limit state
      character(len=*), intent(in) :: method, state
      !> a_g that the wall withstands / that of the site
      real(wp), intent(in) :: factor
      type(floor_spectrum_type), intent(in) :: spectrum
      type(check_input_type), intent(in) :: input
      !> Is the check one for the wall? Else it verifies nothing
      logical, intent(in) :: is_applicable
      !> Formula of the factor
      type(working_type), intent(in) :: working

      character(len=13) :: place
      real(wp) :: ag, years

      place = ''
      if (method == 'linear' .and. state == 'SLV') place = 'C8.7.1.2.1.7'
      if (method == 'nonlinear') place = 'C8.7.1.2.1.8'
      ag = factor*spectrum%ground%pga/spectrum%ground%soil_factor
      call sheet%add(method, state, 'capacity_ag', ag, place, working=working_type('a_gC/a_g a_g', times(factor, &
         & spectrum%ground%pga/spectrum%ground%soil_factor)))
      call sheet%add(method, state, 'capacity_pga', factor*spectrum%ground%pga, working=working_type('a_gC S', &
         & times(ag, spectrum%ground%soil_factor)))
      call sheet%add(method, state, 'ratio', factor, merge('NTC 8.3, C8.3', '             ', state == 'SLV'), &
         & working=working)
      if (is_applicable .and. state /= 'SLD') call sheet%add(method, state, 'zeta_e', factor, 'NTC 8.3, C8.3', &
         & working=working_type('a_gC S/(a_g S)', trim(shown(factor*spectrum%ground%pga))//'/'//shown(spectrum%ground%pga)))
      years = input%return_period_of(ag)
      if (is_applicable .and. years > 0.0_wp) then
         call sheet%add(method, state, 'return_period_capacity', min(max(years, first_year), last_year), &
            & working=working_type('ln T_R linear in ln a_g'))
         call sheet%make_bound(merge('<', merge('>', ' ', years > last_year), years < first_year))
         call sheet%add(method, state, 'extrapolated', merge(1.0_wp, 0.0_wp, ag < input%ag(1) .or. ag > input%ag(3)))
      end if
      call sheet%add(method, state, 'verified', merge(1.0_wp, 0.0_wp, is_applicable .and. factor >= 1.0_wp))
   end subroutine put_capacity

   !> Criterion for time histories at the peak acceleration of the site, C8.7.1.2.1.9
   pure subroutine check_histories(sheet, kinematic, state, pga, records, edp)
      !> The lines are added
      type(sheet_type), intent(inout) :: sheet
      type(kinematic_type), intent(in) :: kinematic
      !> 2: SLV, 3: SLC
      integer, intent(in) :: state
      !> Peak acceleration that the records were scaled to [g]
      real(wp), intent(in) :: pga
      !> Number of records
      integer, intent(in) :: records
      !> Largest rotation / capacity of each history, at least one; 1 or more where it collapsed
      real(wp), intent(in) :: edp(:)

      character(len=3) :: name
      real(wp) :: mean, allowed
      integer :: beyond

      name = state_names(state)
      beyond = count(edp >= 1.0_wp)
      ! At a PGA that is the trigger but for a rounding, the record exceeds it for a rounding of a time step: what follows, some
      ! 1e-49 of the capacity, is rest
      mean = sum(kinematic%displacement(merge(min(edp, 1.0_wp), 0.0_wp, edp > epsilon(edp))*kinematic%end_rotation()))/ &
         & real(size(edp), wp)
      allowed = capacity_displacement(kinematic, state)
      call sheet%add('dynamic', name, 'pga', pga)
      call sheet%add('dynamic', name, 'records', real(records, wp))
      call sheet%add('dynamic', name, 'histories', real(size(edp), wp))
      call sheet%add('dynamic', name, 'beyond', real(beyond, wp), 'C8.7.1.2.1.9')
      call sheet%add('dynamic', name, 'mean_displacement', mean, 'C8.7.1.2.1.9')
      call sheet%add('dynamic', name, 'displacement', allowed)
      call sheet%add('dynamic', name, 'verified', merge(1.0_wp, 0.0_wp, beyond == 0 .and. mean <= allowed), 'C8.7.1.2.1.9')
   end subroutine check_histories

end module dondolo_check_ntc_check
