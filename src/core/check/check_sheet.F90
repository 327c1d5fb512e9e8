!> The sheet of a check: every number with its name, symbol, formula and unit, in the order of the calculation.
module dondolo_check_sheet
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : brief
   implicit none
   private

   public :: item_length, sheet_row_type, sheet_type, shown, working_type

   !> Length of the names of methods, states and quantities, and of a formula's
   integer, parameter :: name_length = 24
   !> Length of the name of what a number is of
   integer, parameter :: item_length = 24
   !> And of a formula in symbols or numbers
   integer, parameter :: formula_length = 96

   !> A quantity of a check
   type :: quantity_type
      !> Name in tables and in Python
      character(len=name_length) :: name = ''
      !> Symbol in the code
      character(len=12) :: symbol = ''
      !> Unit; empty for a number
      character(len=8) :: unit = ''
      !> What it is
      character(len=80) :: meaning = ''
   end type quantity_type

   !> All that there are
   type(quantity_type), parameter :: quantities(*) = [ &
      & quantity_type('latitude', '', 'deg', 'latitude of the site, WGS84'), &
      & quantity_type('longitude', '', 'deg', 'longitude of the site, WGS84'), &
      & quantity_type('latitude_ed50', '', 'deg', 'latitude in ED50, the datum of the grid of hazard'), &
      & quantity_type('longitude_ed50', '', 'deg', 'longitude in ED50, the datum of the grid of hazard'), &
      & quantity_type('distance', 'd', 'km', 'distance of a node of the grid of hazard'), &
      & quantity_type('nominal_life', 'V_N', 'year', 'nominal life'), &
      & quantity_type('use_coefficient', 'C_U', '', 'coefficient of the class of use'), &
      & quantity_type('ag', 'a_g', 'g', 'peak acceleration on rigid, level ground'), &
      & quantity_type('f0', 'F_0', '', 'largest amplification on such ground'), &
      & quantity_type('tc_star', 'T_C*', 's', 'period at which the constant velocity begins there'), &
      & quantity_type('soil_factor', 'S', '', 'factor of soil and topography, S_S S_T'), &
      & quantity_type('stratigraphy', 'S_S', '', 'factor of the soil'), &
      & quantity_type('topography', 'S_T', '', 'factor of the topography'), &
      & quantity_type('tb', 'T_B', 's', 'period at which the constant acceleration begins at the site'), &
      & quantity_type('td', 'T_D', 's', 'period at which the constant displacement begins at the site'), &
      & quantity_type('eta', 'eta', '', 'factor of damping'), &
      & quantity_type('reference_life', 'V_R', 'year', 'reference period'), &
      & quantity_type('return_period_asked', '', 'year', 'return period by V_R and P_VR, beyond those of the grid'), &
      & quantity_type('return_period_demand', 'T_R,D', 'year', 'return period of the hazard'), &
      & quantity_type('return_period_capacity', 'T_R,C', 'year', 'return period of a_gC, along the hazards of the limit states'), &
      & quantity_type('extrapolated', '', '', '1: a_gC is below a_g of SLD or above that of SLC'), &
      & quantity_type('zeta_e', 'zeta_E', '', 'safety index of the mechanism in a_g S, with the shape of the spectrum kept'), &
      & quantity_type('tc', 'T_C', 's', 'period at which the constant velocity begins at the site'), &
      & quantity_type('pga', 'a_g S', 'g', 'peak acceleration at the site'), &
      & quantity_type('floor_pga', 'a_Z', 'g', 'peak acceleration of the ground, or at the level of the wall'), &
      & quantity_type('modal_pga', 'a_Z,m', 'g', 'what the modes of the building give there, less than the ground'), &
      & quantity_type('knowledge_factor', 'FC', '', 'confidence factor'), &
      & quantity_type('knowledge_given', 'FC_LC', '', 'confidence factor that is given, less than the code asks for'), &
      & quantity_type('behaviour', 'q', '', 'behaviour factor'), &
      & quantity_type('free_element', '', '', '1: a free element, which nothing holds above its base; 0: it may be one'), &
      & quantity_type('young_modulus', 'E', 'Pa', 'Young''s modulus of a free element, the greatest of a range'), &
      & quantity_type('least_modulus', 'E_min', 'Pa', 'least of the range'), &
      & quantity_type('t0', 'T_0', 's', 'elastic period of a free element before it rocks'), &
      & quantity_type('shortest_t0', 'T_0,min', 's', 'shortest period that it may have'), &
      & quantity_type('longest_t0', 'T_0,max', 's', 'longest period that it may have'), &
      & quantity_type('governing_t0', 'T_0,gov', 's', 'period between them at which the demand is greatest'), &
      & quantity_type('floor_t0', 'S_eZ(T_0)', 'g', 'spectral acceleration at that period, of the ground or at the level'), &
      & quantity_type('yield_displacement', 'd_y', 'm', 'displacement at which the elastic branch meets the capacity'), &
      & quantity_type('yield_acceleration', 'a_y', 'm/s2', 'spectral acceleration there'), &
      & quantity_type('elastic_period', 'T_e', 's', 'period of a strip before its joints open'), &
      & quantity_type('elastic_damping', 'xi_e', '', 'damping ratio of a strip before its joints open'), &
      & quantity_type('opening_acceleration', 'a_y', 'm/s2', 'spectral acceleration that opens the joints of a strip'), &
      & quantity_type('opening_demand', 'S_eZ(T_e)', 'g', 'spectral acceleration at that period, of the ground or at the level'), &
      & quantity_type('opening_ratio', '', '', 'capacity / demand of the opening; information, no check'), &
      & quantity_type('alpha_0', 'alpha_0', '', 'multiplier that starts the mechanism'), &
      & quantity_type('bare_alpha_0', 'alpha_0,bare', '', 'the same without wedges of transverse walls, or without wings'), &
      & quantity_type('mass', 'M*', 'kg/m', 'mass that takes part'), &
      & quantity_type('mass_ratio', 'e*', '', 'the same / the whole mass'), &
      & quantity_type('a_0', 'a_0*', 'm/s2', 'spectral acceleration that starts the mechanism, alpha_0 g/(e* FC)'), &
      & quantity_type('d_0', 'd_0*', 'm', 'displacement at which the multiplier vanishes'), &
      & quantity_type('halves_overlap', '', 'm', 'how far both halves of a gable would overlap there, which jam'), &
      & quantity_type('hinge', 'r', '', 'hinge of a strip, height / height of the wall'), &
      & quantity_type('lowest_hinge', 'r_min', '', 'lowest hinge among which the weakest is looked for'), &
      & quantity_type('highest_hinge', 'r_max', '', 'highest hinge among which the weakest is looked for'), &
      & quantity_type('upper_moment', 'M_2', 'N m/m', 'moment of weights, thrusts and ties of the upper block, middle hinge'), &
      & quantity_type('floor_top', 'R_top', 'N/m', 'horizontal force of the upper floor when the mechanism starts'), &
      & quantity_type('floor_base', 'R_base', 'N/m', 'horizontal force of the lower floor when the mechanism starts'), &
      & quantity_type('friction_needed', 'mu', '', 'friction that a hinge needs when the mechanism starts, |H|/V'), &
      & quantity_type('friction', 'mu_d', '', 'friction at the hinges that is given'), &
      & quantity_type('sliding_alpha', 'alpha_s', '', 'multiplier at which the hinge slides, by this friction'), &
      & quantity_type('turns_first', '', '', '1: the hinge turns before it slides, 0: it slides first'), &
      & quantity_type('least_zeta', 'zeta_E,min', '', 'least safety index of all hinges of the strip'), &
      & quantity_type('least_zeta_hinge', 'r', '', 'hinge of the strip where the safety index is least'), &
      & quantity_type('tied_zeta', 'zeta_E,tied', '', 'safety index with all ties up to the rotations at which they break'), &
      & quantity_type('less_zeta', 'zeta_E,less', '', 'greatest safety index without counting some ties, or any'), &
      & quantity_type('less_sld', '', '', 'capacity / demand of SLD without counting them'), &
      & quantity_type('less_hinge', '', '', 'weakest hinge of the strip without them, height / height of the wall'), &
      & quantity_type('linear_zeta_e', 'zeta_E', '', 'safety index of the mechanism by the linear check'), &
      & quantity_type('weakest_hinge', 'r*', '', 'hinge of a strip, height / height of the wall, at which alpha_0 is least'), &
      & quantity_type('weakest_alpha_0', 'alpha_0(r*)', '', 'multiplier there'), &
      & quantity_type('level', 'z', 'm', 'level above the ground whose spectrum is the demand'), &
      & quantity_type('wall_top', 'H', 'm', 'height of the top of the wall above the ground, as that of the building'), &
      & quantity_type('proposed_period', 'T_1', 's', 'first approximation of the period of the building'), &
      & quantity_type('given_period', 'T_1', 's', 'period of the first mode of the building that is given for the limit state'), &
      & quantity_type('given_damping', 'xi_1', '', 'damping ratio of the building that is given for the limit state'), &
      & quantity_type('building_period', 'T_1', 's', 'period of the first mode of the building that the demand has'), &
      & quantity_type('building_damping', 'xi_1', '', 'damping ratio of that mode'), &
      & quantity_type('building_zeta', 'zeta_E,T', '', 'safety index with another period and damping of the building'), &
      & quantity_type('diaphragm_period', 'T_d', 's', 'period of the flexible diaphragm at the top, not in the demand'), &
      & quantity_type('tie_fracture', '', 'm', 'displacement at which ties break that carry more than half'), &
      & quantity_type('bar', 'D_bar', 'm', 'diameter of the bar'), &
      & quantity_type('spacing', 's', 'm', 'distance of two bars'), &
      & quantity_type('yield_stress', 'f_yd', 'Pa', 'yield stress of the bar, of the plate too'), &
      & quantity_type('plate_width', 'a', 'm', 'width of the plate'), &
      & quantity_type('plate_height', 'b', 'm', 'height of the plate'), &
      & quantity_type('plate_diameter', 'D', 'm', 'diameter of the plate'), &
      & quantity_type('masonry_thickness', 't', 'm', 'thickness of the masonry that the plate bears on'), &
      & quantity_type('edge_distance', 'c', 'm', 'from the plate to the top of the wall'), &
      & quantity_type('anchor_knowledge', 'FC', '', 'confidence factor of the strengths of the masonry at the plate'), &
      & quantity_type('bearing_strength', 'k f_d', 'Pa', 'strength under the plate, k f_m/(FC gamma_M)'), &
      & quantity_type('shear_strength', 'f_v0d', 'Pa', 'shear strength without compression, f_v0/(FC gamma_M)'), &
      & quantity_type('tensile_strength', 'f_td', 'Pa', 'tensile strength, f_t/(FC gamma_M)'), &
      & quantity_type('friction_stress', 'mu sigma_0', 'Pa', 'friction on the horizontal faces round the plate'), &
      & quantity_type('bar_force', 'T_bar', 'N', 'yield force of the bar'), &
      & quantity_type('bearing_force', 'T_bearing', 'N', 'force that crushes the masonry under the plate'), &
      & quantity_type('shear_force', 'T_shear', 'N', 'force that shears the masonry round the plate'), &
      & quantity_type('cone_force', 'T_cone', 'N', 'force that pulls out a frustum of masonry'), &
      & quantity_type('band_force', 'T_band', 'N', 'force that pulls out a band of masonry from plate to plate'), &
      & quantity_type('anchor_force', 'T_anchor', 'N', 'least of these, at which the anchor gives way'), &
      & quantity_type('bar_force_per_m', 'T_bar/s', 'N/m', 'yield force of the bar per metre of wall'), &
      & quantity_type('anchor_force_per_m', 'T_anchor/s', 'N/m', 'force at which the anchor gives way, per metre of wall'), &
      & quantity_type('tie_force_per_m', 'T/s', 'N/m', 'largest force of the tie, per metre of wall'), &
      & quantity_type('plate_needed', '', 'm', 'thickness that the plate needs so as not to yield'), &
      & quantity_type('plate_thickness', 's_p', 'm', 'thickness of the plate'), &
      & quantity_type('plate_verified', '', '', '1: the plate is thick enough, 0: it is not'), &
      & quantity_type('hierarchy', '', '', '1: the bar yields before the anchor gives way, 0: it does not'), &
      & quantity_type('anchor_checked', '', '', '1: strength of the anchor computed or given; 0: not, or with less FC'), &
      & quantity_type('applicable', '', '', '0: not applicable, by a weak anchor, without E or without a spectrum'), &
      & quantity_type('capacity_ag', 'a_gC', 'g', 'a_g that the wall withstands'), &
      & quantity_type('capacity_pga', 'a_gC S', 'g', 'peak acceleration at the site that the wall withstands'), &
      & quantity_type('displacement', 'd_C', 'm', 'displacement that the wall withstands'), &
      & quantity_type('acceleration', 'a(d_C)', 'm/s2', 'spectral acceleration of capacity there'), &
      & quantity_type('period', 'T', 's', 'equivalent period'), &
      & quantity_type('damping', 'xi', '', 'equivalent damping ratio'), &
      & quantity_type('spectral_demand', 'S_eZ(T)', 'g', 'spectral acceleration of the ground, or at the level of the wall'), &
      & quantity_type('modal_demand', 'S_eZ,m', 'g', 'what the modes of the building give, less than the ground'), &
      & quantity_type('demand', 'd_D', 'm', 'displacement that the earthquake asks for'), &
      & quantity_type('ratio', 'C/D', '', 'capacity / demand, a_gC/a_g; at least 1: verified'), &
      & quantity_type('required', '', '', '1: the verdict on the wall rests on it, 0: it is information'), &
      & quantity_type('records', '', '', 'records'), &
      & quantity_type('histories', '', '', 'time histories at the peak acceleration of the site'), &
      & quantity_type('beyond', '', '', 'of these beyond d_0*; none may be'), &
      & quantity_type('mean_displacement', '', 'm', 'mean of the largest displacements, at most d_0* each'), &
      & quantity_type('untied_displacement', 'd_C', 'm', 'displacement that would be allowed if the ties were not counted'), &
      & quantity_type('verified', '', '', '1: verified, 0: not'), &
      & quantity_type('probability', 'P', '', 'probability of collapse at the peak acceleration, by the fragility curve'), &
      & quantity_type('probability_low', 'P', '', 'lower end of the 95 % confidence interval of this probability'), &
      & quantity_type('probability_high', 'P', '', 'upper end of the 95 % confidence interval of this probability')]

   !> A formula
   type :: working_type
      !> In symbols, and with numbers in their places; empty for a number that is given or has none
      character(len=formula_length) :: expression = '', numbers = ''
   end type working_type

   !> A line of a sheet
   type :: sheet_row_type
      !> Part of the check: 'site', 'mechanism', 'tie', 'linear', 'nonlinear', 'untied', 'dynamic', 'assigned'
      character(len=name_length) :: method = ''
      !> Limit state, 'SLD', 'SLV' or 'SLC'; empty: all
      character(len=4) :: state = ''
      !> What the number is
      type(quantity_type) :: quantity
      !> Value, in its unit
      real(wp) :: value = 0.0_wp
      !> '<' or '>' where only a bound is known; blank: the value is
      character(len=1) :: bound = ''
      !> Where the code has the formula
      character(len=name_length) :: formula = ''
      !> What of the wall it is of, such as 'tie 1'; empty: the wall
      character(len=item_length) :: item = ''
      !> Its formula
      type(working_type) :: working
   end type sheet_row_type

   !> A sheet
   type :: sheet_type
      !> Its lines
      type(sheet_row_type), allocatable :: rows(:)
      !> Are masses and forces those of a whole body, and not per metre of wall?
      logical :: is_whole = .false.
   contains
      !> Add a line
      procedure :: add
      procedure :: append
      !> Make the value of the last line a bound
      procedure :: make_bound
      !> The value of a line
      procedure :: value
      !> Whether it is only a bound
      procedure :: bound
      procedure, private :: find
      !> Is a quantity 1 in all lines that have it?
      procedure :: is_all_one
      procedure :: has_open_ties
      procedure :: slides
      procedure :: lacks_modulus
      procedure :: is_required
      procedure :: ultimate
      procedure :: is_satisfied
      procedure :: is_of_ground
      procedure :: has_ratios
   end type sheet_type

contains

   !> Place of a quantity, 0 if there is none of this name
   pure integer function find_quantity(name) result(at)
      !> Its name
      character(len=*), intent(in) :: name

      do at = size(quantities), 1, -1
         if (quantities(at)%name == name) exit
      end do
#ifdef DONDOLO_CHECKED
      ! A look-up of a name that no quantity has would silently find nothing, so that tests end here.
      if (at == 0) error stop 'dondolo: no quantity of a check is named '''//trim(name)//''''
#endif
   end function find_quantity

   !> Add a line
   pure subroutine add(self, method, state, name, value, formula, item, working)
      class(sheet_type), intent(inout) :: self
      !> Part of the check, limit state, and name of the quantity
      character(len=*), intent(in) :: method, state, name
      !> Value, in its unit
      real(wp), intent(in) :: value
      !> Where the code has the formula; absent: it has none
      character(len=*), intent(in), optional :: formula
      !> What of the wall it is of; absent: the wall
      character(len=*), intent(in), optional :: item
      !> Its formula; absent: it has none
      type(working_type), intent(in), optional :: working

      type(sheet_row_type) :: row
      integer :: at

      row%method = method
      row%state = state
      row%quantity%name = name
      at = find_quantity(name)
      if (at > 0) row%quantity = quantities(at)
      if (self%is_whole) row%quantity%unit = in_all(row%quantity%unit)
      row%value = value
      if (present(formula)) row%formula = formula
      if (present(item)) row%item = item
      if (present(working)) row%working = working
      call self%append(row)
   end subroutine add

   !> The unit of a quantity of a whole body, of which those per metre of wall have '/m' at their end
   elemental function in_all(unit) result(whole)
      character(len=*), intent(in) :: unit
      character(len=len(unit)) :: whole

      whole = unit
      if (index(unit, '/m ') > 0) whole = unit(:index(unit, '/m ') - 1)
   end function in_all

   !> Add a line that is made
   pure subroutine append(self, row)
      class(sheet_type), intent(inout) :: self
      type(sheet_row_type), intent(in) :: row

      if (.not. allocated(self%rows)) allocate (self%rows(0))
      self%rows = [self%rows, row]
   end subroutine append

   !> Make the value of the last line a bound
   pure subroutine make_bound(self, bound)
      class(sheet_type), intent(inout) :: self
      !> '<' or '>'; blank: it is none
      character(len=1), intent(in) :: bound

      self%rows(size(self%rows))%bound = bound
   end subroutine make_bound

   !> A number in a formula, to be computed with by hand
   pure function shown(value) result(text)
      real(wp), intent(in) :: value
      !> Its text, filled up with blanks
      character(len=24) :: text

      text = brief(value)
   end function shown

   !> Place of a line, of the first of its name; 0 where there is none
   pure integer function find(self, method, state, name, item) result(at)
      class(sheet_type), intent(in) :: self
      !> Part of the check, limit state, and name of the quantity; for the lines of all states any state
      character(len=*), intent(in) :: method, state, name
      !> What of the wall it is of; absent: the first
      character(len=*), intent(in), optional :: item

      at = 0
      if (.not. allocated(self%rows) .or. find_quantity(name) == 0) return
      do at = 1, size(self%rows)
         associate (row => self%rows(at))
            if (row%method /= method .or. row%quantity%name /= name) cycle
            if (row%state /= state .and. row%state /= '') cycle
            if (present(item)) then
               if (row%item /= item) cycle
            end if
            return
         end associate
      end do
      at = 0
   end function find

   !> The value of a line, of the first of its name; -1 where there is none
   pure real(wp) function value(self, method, state, name, item)
      class(sheet_type), intent(in) :: self
      !> Part of the check, limit state, and name of the quantity; for the lines of all states any state
      character(len=*), intent(in) :: method, state, name
      !> What of the wall it is of; absent: the first
      character(len=*), intent(in), optional :: item

      integer :: at

      value = -1.0_wp
      at = self%find(method, state, name, item)
      if (at > 0) value = self%rows(at)%value
   end function value

   !> '<' or '>' where the value of a line is only a bound; blank where it is none, and where there is no such line
   pure character(len=1) function bound(self, method, state, name)
      class(sheet_type), intent(in) :: self
      !> Part of the check, limit state, and name of the quantity
      character(len=*), intent(in) :: method, state, name

      integer :: at

      bound = ''
      at = self%find(method, state, name)
      if (at > 0) bound = self%rows(at)%bound
   end function bound

   !> Is a quantity, 1 or 0, 1 in all lines of a method that have it?
   pure logical function is_all_one(self, method, name, state)
      class(sheet_type), intent(in) :: self
      !> Part of the check, and name of the quantity
      character(len=*), intent(in) :: method, name
      !> Limit state; absent: of all
      character(len=*), intent(in), optional :: state

      integer :: i

      is_all_one = .true.
      if (.not. allocated(self%rows) .or. find_quantity(name) == 0) return
      do i = 1, size(self%rows)
         associate (row => self%rows(i))
            if (row%method /= method .or. row%quantity%name /= name) cycle
            if (present(state)) then
               if (row%state /= state) cycle
            end if
            is_all_one = is_all_one .and. row%value > 0.0_wp
         end associate
      end do
   end function is_all_one

   !> Is an anchor of a tie unchecked or weaker than its bar, or a plate too thin? The checks then hold only if it is made good.
   pure logical function has_open_ties(self)
      class(sheet_type), intent(in) :: self

      has_open_ties = .not. (self%is_all_one('tie', 'anchor_checked') .and. self%is_all_one('tie', 'hierarchy') .and. &
         & self%is_all_one('tie', 'plate_verified'))
   end function has_open_ties

   !> Does a hinge slide before it turns, by the friction that is given?
   pure logical function slides(self)
      class(sheet_type), intent(in) :: self

      slides = .not. self%is_all_one('mechanism', 'turns_first')
   end function slides

   !> Is the wall a free element whose Young's modulus is not given, so that what starts it is not known?
   pure logical function lacks_modulus(self)
      class(sheet_type), intent(in) :: self

      lacks_modulus = self%value('mechanism', '', 'free_element') > 0.0_wp .and. &
         & self%value('mechanism', '', 'young_modulus') < 0.0_wp
   end function lacks_modulus

   !> Does the verdict on the wall rest on a check?
   pure logical function is_required(self, method, state)
      class(sheet_type), intent(in) :: self
      !> Part of the check and limit state
      character(len=*), intent(in) :: method, state

      is_required = self%value(method, state, 'required') > 0.0_wp
   end function is_required

   !> The ultimate limit state that the verdict rests on, whose nonlinear ratio is the safety index of the wall
   pure character(len=3) function ultimate(self)
      class(sheet_type), intent(in) :: self

      ultimate = merge('SLC', 'SLV', self%is_required('nonlinear', 'SLC'))
   end function ultimate

   !> Are all checks satisfied that the verdict rests on, and is nothing open of ties or hinges?
   pure logical function is_satisfied(self)
      class(sheet_type), intent(in) :: self

      integer :: i

      is_satisfied = .not. (self%has_open_ties() .or. self%slides())
      do i = 1, size(self%rows)
         associate (row => self%rows(i))
            if (row%quantity%name /= 'required' .or. .not. row%value > 0.0_wp) cycle
            is_satisfied = is_satisfied .and. self%value(row%method, row%state, 'verified') > 0.0_wp
         end associate
      end do
   end function is_satisfied

   !> Has it any ratio? None without a spectrum at the level of the wall
   pure logical function has_ratios(self)
      class(sheet_type), intent(in) :: self

      has_ratios = any(self%rows%quantity%name == 'ratio' .and. self%rows%method == 'nonlinear')
   end function has_ratios

   !> Does the ground ask for more than the modes of the building, in any line?
   pure logical function is_of_ground(self)
      class(sheet_type), intent(in) :: self

      is_of_ground = any(self%rows%quantity%name == 'modal_pga' .or. self%rows%quantity%name == 'modal_demand')
   end function is_of_ground

end module dondolo_check_sheet
