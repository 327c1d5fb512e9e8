!> Rows of the sheet that a nonlinear check has, and of the capacity that any check comes to.
module dondolo_check_nonlinear_rows
   use dondolo_base_kinds, only : wp
   use dondolo_check_activation, only : activation, nonlinear_factor, starting_demand, starting_symbol
   use dondolo_check_building_state, only : damaged, is_searched, last_state, longest, softened, spectrum_of
   use dondolo_check_code_spectrum, only : damping_factor
   use dondolo_check_floor_spectrum, only : floor_spectrum_type
   use dondolo_check_free_rows, only : put_free_demand
   use dondolo_check_hazard_grid, only : grid_years
   use dondolo_check_input, only : check_input_type, state_names
   use dondolo_check_kinematic, only : kinematic_type
   use dondolo_check_nonlinear, only : compute_nonlinear, dampings, find_governing, index_at, index_with, &
      & period_factors, shares
   use dondolo_check_sheet, only : sheet_row_type, sheet_type, shown, working_type
   use dondolo_check_tie_curves, only : tie_curve_type
   implicit none
   private

   public :: put_activation, put_capacity, put_multiplier, put_nonlinear, times

   !> Return periods of the grid of hazard, beyond which only a bound is given [years]
   real(wp), parameter :: first_year = grid_years(1), last_year = grid_years(size(grid_years))

contains

   !> Put a nonlinear check, the greatest of the curve with all ties and of those without some
   subroutine put_nonlinear(sheet, kinematic, input, state, curves)
      type(sheet_type), intent(inout) :: sheet
      type(kinematic_type), intent(in) :: kinematic
      type(check_input_type), intent(in) :: input
      !> 2: SLV, 3: SLC
      integer, intent(in) :: state
      !> Curves without some ties, of size 0 where there are none
      type(tie_curve_type), intent(in) :: curves(:)

      type(sheet_type) :: other
      type(working_type) :: working
      type(floor_spectrum_type) :: spectrum
      real(wp) :: tied, index
      integer :: at, k

      call find_governing(kinematic, curves, input, state, at, k)
      spectrum = damaged(kinematic, input, state, at)
      call put_demand(sheet, kinematic, input, spectrum, state, tied, working)
      index = tied
      if (size(curves) > 0) then
         call sheet%add('nonlinear', state_names(state), 'tied_zeta', tied, 'C8.7.1.2.1.6', working=working)
         if (k == 0) k = maxloc([(index_at(curves(k)%kinematic, input, state, at), k=1, size(curves))], dim=1)
         call put_less(other, curves(k), input, state, at, index)
         associate (item => curves(k)%item)
            ! Its steps, if it is the curve that is taken
            if (index > tied) call take_rows(sheet, other, item)
            call sheet%add('nonlinear', state_names(state), 'less_sld', activation(curves(k)%kinematic, input, &
               & spectrum_of(curves(k)%kinematic, input, 1)), 'C8.7.1.2.1.5', item)
            call sheet%add('nonlinear', state_names(state), 'less_zeta', index, 'C8.7.1.2.1', item)
         end associate
         working = working_type('max[zeta_E,tied, zeta_E,less]', 'max('//trim(shown(tied))//', '//trim(shown(index))//')')
         index = max(tied, index)
      end if
      call put_capacity(sheet, 'nonlinear', state_names(state), index, spectrum, input, .true., working)
      if (is_searched(kinematic, input)) call put_search(sheet, kinematic, curves, input, state)
   end subroutine put_nonlinear

   !> Put safety indices with other states of the building than that which governs
   subroutine put_search(sheet, kinematic, curves, input, state)
      type(sheet_type), intent(inout) :: sheet
      type(kinematic_type), intent(in) :: kinematic
      type(tie_curve_type), intent(in) :: curves(:)
      type(check_input_type), intent(in) :: input
      !> 2: SLV, 3: SLC
      integer, intent(in) :: state

      integer, parameter :: shown_states(3) = [1, (last_state + 1)/2, last_state]
      character(len=*), parameter :: items(3) = [character(len=7) :: 'T_1', '1.5 T_1', '2 T_1']
      integer :: i

      do i = 1, size(shown_states)
         call sheet%add('nonlinear', state_names(state), 'building_zeta', index_with(kinematic, curves, input, &
            & damaged(kinematic, input, state, shown_states(i)), state), 'C8.7.1.2.1.4', items(i))
      end do
      ! Shown, not taken: 100 % more period and the least damping of the text
      call sheet%add('nonlinear', state_names(state), 'building_zeta', index_with(kinematic, curves, input, &
         & softened(kinematic, input, state, longest, spread(0.10_wp, 1, size(kinematic%period))), state), 'C8.7.1.2.1.4', &
         & '2 T_1, 10 %')
   end subroutine put_search

   !> Put the steps of a curve without some ties
   subroutine put_less(sheet, curve, input, state, at, index)
      type(sheet_type), intent(out) :: sheet
      type(tie_curve_type), intent(in) :: curve
      type(check_input_type), intent(in) :: input
      !> 2: SLV, 3: SLC
      integer, intent(in) :: state
      !> Number of the state of the building
      integer, intent(in) :: at
      !> Safety index
      real(wp), intent(out) :: index

      type(working_type) :: working

      associate (less => curve%kinematic)
         if (less%hinge > 0.0_wp) call sheet%add('nonlinear', state_names(state), 'hinge', less%hinge, 'C8.7.1.2.1.1')
         call put_multiplier(sheet, 'nonlinear', state_names(state), less)
         call put_activation(sheet, 'nonlinear', state_names(state), less, input%knowledge_factor)
         call sheet%add('nonlinear', state_names(state), 'd_0', less%end_displacement, 'C8.7.1.4')
         call put_demand(sheet, less, input, damaged(less, input, state, at), state, index, working)
         call sheet%add('nonlinear', state_names(state), 'less_zeta', index, 'C8.7.1.2.1', working=working)
      end associate
   end subroutine put_less

   !> Put the multiplier that starts a mechanism
   pure subroutine put_multiplier(sheet, method, state, kinematic)
      type(sheet_type), intent(inout) :: sheet
      !> Part of the check and limit state
      character(len=*), intent(in) :: method, state
      type(kinematic_type), intent(in) :: kinematic

      call sheet%add(method, state, 'alpha_0', kinematic%multiplier, 'C8.7.1.1', &
         & working=working_type('(sum stabilising - sum overturning)/sum P z', '('//trim(shown(kinematic%stabilising))//' - '// &
         & trim(shown(kinematic%overturning))//')/'//shown(kinematic%first)))
   end subroutine put_multiplier

   !> Put the spectral acceleration that starts it
   subroutine put_activation(sheet, method, state, kinematic, factor)
      type(sheet_type), intent(inout) :: sheet
      !> Part of the check and limit state
      character(len=*), intent(in) :: method, state
      type(kinematic_type), intent(in) :: kinematic
      !> Confidence factor
      real(wp), intent(in) :: factor

      call sheet%add(method, state, 'a_0', kinematic%capacity(0.0_wp, factor), 'C8.7.1.3', &
         & working=working_type('alpha_0 g/(e* FC)', times(kinematic%multiplier, kinematic%gravity)//'/('// &
         & times(kinematic%mass_ratio, factor)//')'))
   end subroutine put_activation

   !> Take the rows of a curve without some ties as method 'untied'
   pure subroutine take_rows(sheet, other, item)
      type(sheet_type), intent(inout) :: sheet
      type(sheet_type), intent(in) :: other
      !> Ties that it is without
      character(len=*), intent(in) :: item

      type(sheet_row_type) :: row
      integer :: i

      do i = 1, size(other%rows)
         row = other%rows(i)
         row%method = 'untied'
         row%item = item
         call sheet%append(row)
      end do
   end subroutine take_rows

   !> Put the displacement that a nonlinear check allows, its demand, and what it follows from
   subroutine put_demand(sheet, kinematic, input, spectrum, state, index, working)
      type(sheet_type), intent(inout) :: sheet
      type(kinematic_type), intent(in) :: kinematic
      type(check_input_type), intent(in) :: input
      type(floor_spectrum_type), intent(in) :: spectrum
      !> 2: SLV, 3: SLC
      integer, intent(in) :: state
      !> Safety index, and its formula
      real(wp), intent(out) :: index
      type(working_type), intent(out) :: working

      character(len=3) :: name
      character(len=:), allocatable :: expression, numbers
      type(floor_spectrum_type) :: given
      real(wp) :: d, a, period, demand, ratio

      name = state_names(state)
      call compute_nonlinear(kinematic, input, spectrum, state, d, a, period, demand)
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
         & working=working_type(trim(shown(period_factors(state)))// &
         & ' pi sqrt[d_C/a(d_C)]', trim(shown(period_factors(state)))//' * pi * sqrt('//trim(shown(d))//'/'//trim(shown(a))//')'))
      call sheet%add('nonlinear', name, 'damping', dampings(state), 'C8.7.1.2.1.8')
      call sheet%add('nonlinear', name, 'eta', damping_factor(dampings(state)), 'NTC 3.2.3.2.1', &
         & working=working_type('sqrt[10/(5 + 100 xi)]', 'sqrt(10/(5 + 100 * '//trim(shown(dampings(state)))//'))'))
      call put_ordinate_formula(spectrum, period, dampings(state), expression, numbers)
      if (size(spectrum%period) > 0) then
         ratio = maxval(spectrum%period)/maxval(kinematic%period)
         call sheet%add('nonlinear', name, 'building_period', ratio*kinematic%first_period, 'C8.7.1.2.1.4')
         call sheet%add('nonlinear', name, 'building_damping', spectrum%damping(maxloc(spectrum%period, dim=1)), 'C8.7.1.2.1.4')
         ! Beyond T_1 the code itself has the ground as a bound
         if (period <= maxval(spectrum%period) .and. spectrum%modal_acceleration(period, dampings(state)) &
            & < spectrum%ground%acceleration(period, dampings(state))) call sheet%add('nonlinear', name, 'modal_demand', &
            & spectrum%modal_acceleration(period, dampings(state)), 'C7.2.3')
      end if
      call sheet%add('nonlinear', name, 'spectral_demand', spectrum%acceleration(period, dampings(state)), &
         & merge('NTC 3.2.3.2.1', 'C7.2.3       ', size(spectrum%period) == 0), working=working_type(expression, numbers))
      call sheet%add('nonlinear', name, 'demand', demand, merge('NTC 3.2.3.2.3', 'C8.7.1.12    ', size(spectrum%period) == 0), &
         & working=working_type('S_eZ(T) g [T/(2 pi)]^2', times(spectrum%acceleration(period, dampings(state)), &
         & kinematic%gravity)//' * ('//trim(shown(period))//'/(2 * pi))^2'))
      given = spectrum_of(kinematic, input, state)
      call put_free_demand(sheet, 'nonlinear', name, kinematic, given)
      index = nonlinear_factor(kinematic, input, given, d/demand)
      expression = 'd_C/d_D'
      numbers = trim(shown(d))//'/'//trim(shown(demand))
      if (.not. kinematic%element%is_unknown()) then
         expression = 'max['//expression//', a_0*/(g '//starting_symbol(kinematic)//')]'
         numbers = 'max('//numbers//', '//trim(shown(kinematic%capacity(0.0_wp, input%knowledge_factor)))//'/('// &
            & times(kinematic%gravity, starting_demand(kinematic, given))//'))'
      end if
      working = working_type(expression, numbers)
   end subroutine put_demand

   !> The formula of an ordinate of the spectrum of the ground; in a building it is a sum over modes, which has none where they
   !> give more than the ground
   pure subroutine put_ordinate_formula(spectrum, period, damping, expression, numbers)
      type(floor_spectrum_type), intent(in) :: spectrum
      !> Period [s] and damping ratio
      real(wp), intent(in) :: period, damping
      !> In symbols and in numbers
      character(len=:), allocatable, intent(out) :: expression, numbers

      expression = ''
      numbers = ''
      if (size(spectrum%period) > 0) then
         associate (modal => spectrum%modal_acceleration(period, damping), ground => spectrum%ground%acceleration(period, damping))
            if (.not. modal < ground) return
            expression = 'max(S_eZ,m, S_e(T))'
            numbers = 'max('//trim(shown(modal))//', '//trim(shown(ground))//')'
         end associate
         return
      end if
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
      call sheet%add(method, state, 'required', merge(1.0_wp, 0.0_wp, input%requires(method, state)), 'NTC 8.3')
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

end module dondolo_check_nonlinear_rows
