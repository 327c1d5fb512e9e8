!> Checks of a wall by NTC 2018 and Circolare 7/2019, C8.7.1.2.1: kinematic, linear and nonlinear, and the criterion for
!> time histories. What is computed is a sheet, every number with its formula.
!>
!>     SLD, linear      a_Z <= a_0*, a_0* = alpha_0 g/(e* FC)                                        C8.7.1.8
!>                      of free elements S_eZ(T_0) <= a_0*                                           C8.7.1.9
!>     SLV, linear      a_g = q times that of the linear check that starts the mechanism, q = 2
!>     SLV, nonlinear   d_SLV = 0.4 d_0* or where ties break that carry more than half of the greatest a,
!>                      T = 1.68 pi sqrt(d/a(d)), xi = 8 %                                           C8.7.1.10
!>     SLC, nonlinear   d_SLC = 0.6 d_0* or where a load loses its seat, T = 1.56 pi sqrt(d/a(d)), xi = 10 %   C8.7.1.11
!>     SLV, SLC of a wall with ties: the greatest of what all ties give, and of the curves without those that break first
!>     dynamic          no history beyond d_0*, mean of the largest d at most d_SLV or d_SLC         C8.7.1.2.1.9
!>
!> The a_g that a wall withstands is the site's, scaled until capacity and demand are equal; shape and soil factor of the spectrum
!> stay. That of the nonlinear check is not below the one that starts the mechanism.
module dondolo_check_ntc_check
   use dondolo_base_kinds, only : wp
   use dondolo_building_input, only : proposed_period
   use dondolo_check_activation, only : activation, starting_demand, starting_symbol
   use dondolo_check_building_state, only : spectrum_of
   use dondolo_check_floor_spectrum, only : floor_spectrum_type
   use dondolo_check_free_rows, only : put_free_demand, put_free_element
   use dondolo_check_input, only : check_input_type, state_names
   use dondolo_check_joint_rows, only : put_joint, put_joint_demand
   use dondolo_check_kinematic, only : kinematic_type
   use dondolo_check_nonlinear_rows, only : put_activation, put_capacity, put_multiplier, put_nonlinear, times
   use dondolo_check_sheet, only : sheet_type, shown, working_type
   use dondolo_check_site_rows, only : put_hazard, put_place, put_years
   use dondolo_check_sliding_rows, only : put_sliding
   use dondolo_check_tie_curves, only : tie_curve_type
   use dondolo_check_tie_rows, only : put_ties
   use dondolo_fragility, only : fragility_type
   use dondolo_fragility_clustered, only : probability_interval
   implicit none
   private

   public :: check_ntc

contains

   !> Kinematic check of a wall
   subroutine check_ntc(sheet, kinematic, input, curve, curves)
      type(sheet_type), intent(out) :: sheet
      type(kinematic_type), intent(in) :: kinematic
      type(check_input_type), intent(in) :: input
      !> Curve of collapse over the peak acceleration at the site [g]: the sheet then has probabilities
      type(fragility_type), intent(in), optional :: curve
      !> Curves without some ties, of which the better counts; absent: none
      type(tie_curve_type), intent(in), optional :: curves(:)

      type(tie_curve_type), allocatable :: others(:)
      type(floor_spectrum_type) :: spectrum
      integer :: i

      allocate (others(0))
      if (present(curves)) others = curves
      sheet%is_whole = kinematic%is_whole
      if (allocated(input%place)) call put_place(sheet, input%place)
      do i = 1, merge(3, 1, input%has_states())
         call put_site(sheet, kinematic, input, i)
      end do
      call put_mechanism(sheet, kinematic, input)
      ! Strengths at plates are those of the level of knowledge that is reached
      call put_ties(sheet, kinematic%anchors, merge(input%knowledge_given, input%knowledge_factor, input%knowledge_given > 0.0_wp))
      if (kinematic%is_without_spectrum) then
         call put_nothing(sheet, kinematic, input)
         return
      end if
      spectrum = spectrum_of(kinematic, input, 1)
      call put_linear(sheet, kinematic, input, spectrum, 1)
      spectrum = spectrum_of(kinematic, input, 2)
      call put_linear(sheet, kinematic, input, spectrum, 2)
      do i = 2, 3
         call put_nonlinear(sheet, kinematic, input, i, others)
      end do
      if (present(curve)) call put_probabilities(sheet, curve)
   end subroutine check_ntc

   !> Put the probability of collapse, with its interval, after each peak acceleration: that of the site and those that the checks
   !> allow
   pure subroutine put_probabilities(sheet, curve)
      type(sheet_type), intent(inout) :: sheet
      type(fragility_type), intent(in) :: curve

      type(sheet_type) :: longer
      real(wp) :: bounds(2)
      integer :: i

      if (.not. curve%has_fit()) return
      do i = 1, size(sheet%rows)
         associate (row => sheet%rows(i))
            call longer%append(row)
            if (row%quantity%name /= 'pga' .and. row%quantity%name /= 'capacity_pga') cycle
            call longer%add(row%method, row%state, 'probability', curve%probability(row%value))
            if (.not. curve%has_errors()) cycle
            bounds = probability_interval(curve, row%value)
            call longer%add(row%method, row%state, 'probability_low', bounds(1))
            call longer%add(row%method, row%state, 'probability_high', bounds(2))
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
         ag = ground%pga/ground%soil_factor
         call put_hazard(sheet, input, state, name, [ag, ground%amplification, input%tc_star(min(state, size(input%tc_star)))])
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
         if (input%reference_life > 0.0_wp .and. input%has_states()) call put_years(sheet, input, state, name)
         if (size(spectrum%period) > 0) call put_floor_pga(sheet, 'site', name, spectrum)
      end associate
   end subroutine put_site

   !> Put the peak acceleration of a floor, and that of the modes where it is less than the ground's
   pure subroutine put_floor_pga(sheet, method, state, spectrum)
      type(sheet_type), intent(inout) :: sheet
      !> Part of the check and limit state
      character(len=*), intent(in) :: method, state
      type(floor_spectrum_type), intent(in) :: spectrum

      associate (modal => spectrum%modal_peak(), ground => spectrum%ground%pga)
         if (modal < ground) then
            call sheet%add(method, state, 'modal_pga', modal, 'C7.2.3')
            call sheet%add(method, state, 'floor_pga', ground, working=working_type('max(a_Z,m, a_g S)', 'max('// &
               & trim(shown(modal))//', '//trim(shown(ground))//')'))
         else
            call sheet%add(method, state, 'floor_pga', modal, 'C7.2.3')
         end if
      end associate
   end subroutine put_floor_pga

   !> Put the numbers of the mechanism
   subroutine put_mechanism(sheet, kinematic, input)
      type(sheet_type), intent(inout) :: sheet
      type(kinematic_type), intent(in) :: kinematic
      type(check_input_type), intent(in) :: input

      call sheet%add('mechanism', '', 'knowledge_factor', input%knowledge_factor, 'C8.7.1.2.1.3')
      if (input%knowledge_given > 0.0_wp) call sheet%add('mechanism', '', 'knowledge_given', input%knowledge_given)
      call put_multiplier(sheet, 'mechanism', '', kinematic)
      if (kinematic%wedge_first > 0.0_wp) call put_bare_facade(sheet, kinematic)
      call sheet%add('mechanism', '', 'mass', kinematic%mass, 'C8.7.1.5', working=working_type('(sum P z)^2/(g sum P z^2)', &
         & trim(shown(kinematic%first))//'^2/('//times(kinematic%gravity, kinematic%second)//')'))
      call sheet%add('mechanism', '', 'mass_ratio', kinematic%mass_ratio, 'C8.7.1.5', working=working_type('g M*/sum P', &
         & times(kinematic%gravity, kinematic%mass)//'/'//shown(kinematic%weight)))
      call put_activation(sheet, 'mechanism', '', kinematic, input%knowledge_factor)
      call sheet%add('mechanism', '', 'd_0', kinematic%end_displacement, 'C8.7.1.4')
      if (kinematic%overlap > 0.0_wp) call sheet%add('mechanism', '', 'halves_overlap', kinematic%overlap)
      if (kinematic%level > 0.0_wp) call sheet%add('mechanism', '', 'level', kinematic%level)
      call put_building(sheet, input)
      if (kinematic%diaphragm_period > 0.0_wp) call sheet%add('mechanism', '', 'diaphragm_period', kinematic%diaphragm_period)
      if (kinematic%hinge > 0.0_wp) call put_strip(sheet, kinematic)
      call put_sliding(sheet, kinematic, input%friction)
      call put_free_element(sheet, kinematic, input%knowledge_factor)
      call put_joint(sheet, kinematic)
      if (kinematic%tie_fracture < huge(1.0_wp)) call sheet%add('mechanism', '', 'tie_fracture', kinematic%tie_fracture, &
         & 'C8.7.1.4')
   end subroutine put_mechanism

   !> Put the multiplier of a facade without its wedges of transverse walls, or of a corner without its wings, its hinge and its
   !> loads where they are
   pure subroutine put_bare_facade(sheet, kinematic)
      type(sheet_type), intent(inout) :: sheet
      type(kinematic_type), intent(in) :: kinematic

      associate (stabilising => kinematic%stabilising - kinematic%wedge_moment, first => kinematic%first - kinematic%wedge_first)
         call sheet%add('mechanism', '', 'bare_alpha_0', (stabilising - kinematic%overturning)/first, 'C8.7.1.1', &
            & working=working_type('(sum stabilising - sum overturning)/sum P z', '('//trim(shown(stabilising))//' - '// &
            & trim(shown(kinematic%overturning))//')/'//shown(first)))
      end associate
   end subroutine put_bare_facade

   !> Put period and damping of the building that are given for the limit states
   pure subroutine put_building(sheet, input)
      type(sheet_type), intent(inout) :: sheet
      type(check_input_type), intent(in) :: input

      integer :: i

      do i = 1, size(state_names)
         if (input%has_building_period()) call sheet%add('mechanism', state_names(i), 'given_period', &
            & input%building_period(i), 'C8.7.1.2.1.4')
      end do
      do i = 1, size(state_names)
         if (input%has_building_damping()) call sheet%add('mechanism', state_names(i), 'given_damping', &
            & input%building_damping(i), 'C8.7.1.2.1.4')
      end do
   end subroutine put_building

   !> Put the hinge of a strip, the weakest one, and the forces of its floors when the mechanism starts
   subroutine put_strip(sheet, kinematic)
      type(sheet_type), intent(inout) :: sheet
      type(kinematic_type), intent(in) :: kinematic

      real(wp) :: moment

      call sheet%add('mechanism', '', 'hinge', kinematic%hinge)
      call sheet%add('mechanism', '', 'weakest_hinge', kinematic%weakest_hinge, 'C8.7.1.2.1.1')
      call sheet%add('mechanism', '', 'weakest_alpha_0', kinematic%weakest_multiplier, 'C8.7.1.1')
      call sheet%add('mechanism', '', 'lowest_hinge', kinematic%hinge_range(1))
      call sheet%add('mechanism', '', 'highest_hinge', kinematic%hinge_range(2))
      associate (floors => kinematic%floors)
         moment = floors%weight_moment + floors%thrust_moment - floors%tie_moment
         call sheet%add('mechanism', '', 'upper_moment', moment, working=working_type( &
            & 'M_P,2 + M_H,2 - M_T,2', trim(shown(floors%weight_moment))//' + '// &
            & trim(shown(floors%thrust_moment))//' - '//shown(floors%tie_moment)))
         call sheet%add('mechanism', '', 'floor_top', floors%top, working=working_type('(alpha_0 M_Q,2 + M_2)/h_2', &
            & '('//times(kinematic%multiplier, floors%moving_moment)//' + '//trim(shown(moment))//')/'//shown(floors%length)))
         call sheet%add('mechanism', '', 'floor_base', floors%base, working=working_type('alpha_0 sum P + sum H - sum T - R_top', &
            & times(kinematic%multiplier, floors%moving(1))//' + '//trim(shown(floors%thrust(1)))//' - '// &
            & trim(shown(floors%tie(1)))//' - '//shown(floors%top)))
      end associate
   end subroutine put_strip

   !> Put that no check is applicable where the spectrum at the level of the wall is not known
   subroutine put_nothing(sheet, kinematic, input)
      type(sheet_type), intent(inout) :: sheet
      type(kinematic_type), intent(in) :: kinematic
      type(check_input_type), intent(in) :: input

      character(len=:), allocatable :: name
      integer :: i

      associate (height => kinematic%top)
         call sheet%add('mechanism', '', 'wall_top', height)
         call sheet%add('mechanism', '', 'proposed_period', proposed_period(height), 'C7.3.3.2', working=working_type( &
            & '0.05 H^(3/4)', '0.05 * '//trim(shown(height))//'^(3/4)'))
      end associate
      call sheet%add('linear', 'SLD', 'applicable', 0.0_wp, 'C8.7.1.2.1.5')
      call sheet%add('linear', 'SLV', 'behaviour', input%behaviour, 'C8.7.1.2.1.7')
      call sheet%add('linear', 'SLV', 'applicable', 0.0_wp, 'C8.7.1.2.1.7')
      call sheet%add('nonlinear', 'SLV', 'applicable', 0.0_wp, 'C8.7.1.2.1.8')
      call sheet%add('nonlinear', 'SLC', 'applicable', 0.0_wp, 'C8.7.1.2.1.8')
      ! The verdict rests on them all the same, so that nothing is satisfied
      do i = 1, size(state_names)
         name = trim(merge('linear   ', 'nonlinear', i == 1))
         call sheet%add(name, state_names(i), 'required', merge(1.0_wp, 0.0_wp, input%requires(name, state_names(i))), 'NTC 8.3')
      end do
   end subroutine put_nothing

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
      logical :: is_brittle, is_unknown

      name = state_names(state)
      factor = 1.0_wp
      if (state == 2) then
         factor = input%behaviour
         call sheet%add('linear', name, 'behaviour', factor, 'C8.7.1.2.1.7')
      end if
      if (size(spectrum%period) == 0) then
         call sheet%add('linear', name, 'floor_pga', spectrum%peak_acceleration(), 'C8.7.1.8')
      else
         call put_floor_pga(sheet, 'linear', name, spectrum)
      end if
      ! An anchor that gives way has none of the ductility that q stands for
      is_brittle = factor > 1.0_wp .and. any(kinematic%anchors%is_brittle())
      is_unknown = kinematic%element%is_unknown()
      if (is_brittle .or. is_unknown) call sheet%add('linear', name, 'applicable', 0.0_wp, merge('C8.7.1.2.1.5', '            ', &
         & is_unknown))
      call put_free_demand(sheet, 'linear', name, kinematic, spectrum)
      if (state == 1) call put_joint_demand(sheet, name, kinematic, input%knowledge_factor, spectrum)
      call put_capacity(sheet, 'linear', name, factor*activation(kinematic, input, spectrum), spectrum, input, &
         & .not. (is_brittle .or. is_unknown), working=working_type('q a_0*/(g '//starting_symbol(kinematic)//')', &
         & times(factor, kinematic%capacity(0.0_wp, input%knowledge_factor))//'/('// &
         & times(kinematic%gravity, starting_demand(kinematic, spectrum))//')'))
   end subroutine put_linear

end module dondolo_check_ntc_check
