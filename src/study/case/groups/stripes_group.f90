!> The group &stripes: the intensity measure and its levels.
module dondolo_case_stripes_group
   use dondolo_base_error, only : error_type, not_given, not_together, out_of_range, raise_input, wrong_length
   use dondolo_base_kinds, only : wp
   use dondolo_base_limits, only : most_levels, most_thresholds
   use dondolo_base_property, only : blank, choices_length, is_integer, is_list, is_text, most_choices, property_type
   use dondolo_base_settings, only : group_settings_type, new_settings
   use dondolo_base_text, only : to_text
   use dondolo_case_namelist_group, only : group_type
   use dondolo_case_settings_group, only : read_settings
   use dondolo_fragility_even_levels, only : even_levels, settle_levels
   use dondolo_fragility_scaling, only : new_scaling, scaling_type
   use dondolo_fragility_study, only : check_levels, check_thresholds
   implicit none
   private

   public :: stripes_input_type, read_stripes_group, check_states
   public :: stripes_properties

   !> How the curves of damage states are fitted
   character(len=8), parameter :: state_names(2) = [character(len=8) :: 'separate', 'ordinal']

   !> Variables of the group; first, last and count become levels
   type(property_type), target, protected :: stripes_properties(7) = [ &
      & property_type('im', is_text, word='pga', meaning='intensity measure: also ''sa(0.5)'', ''saavg(0.2:2)'' (periods '// &
      &   'in s; levels in g), ''pgv'', ''arias'', ''arias-trapz'', ''cav'', ''cav-trapz'' (m/s), ''pgd'', ''hi'' (m), '// &
      &   '''pga/a0'', ''p*pgv/a0'' (1)'), &
      & property_type('levels', is_list, optional=.true., instead='first, last and count', &
      &   example='0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8', meaning='levels of the measure, increasing, in its unit'), &
      & property_type('first', optional=.true., positive=.true., example='0.1', changes_results=.false., &
      &   meaning='instead of levels, with last and count: the first of equally spaced levels'), &
      & property_type('last', optional=.true., example='0.8', changes_results=.false., &
      &   meaning='the last of equally spaced levels'), &
      & property_type('count', is_integer, optional=.true., smallest=2.0_wp, largest=real(most_levels, wp), example='8', &
      &   changes_results=.false., meaning='number of equally spaced levels, both ends included, '// &
      &   'rounded to 14 digits; so are levels that are equally spaced but for rounding'), &
      & property_type('edp_thresholds', is_list, optional=.true., example='0.1, 0.4', &
      &   meaning='damage states before collapse, rotation / capacity'), &
      & property_type('states', is_text, word='separate', changes_results=.false., meaning='fits of damage states: each '// &
      &   'on its own, or ''ordinal'' with one beta, so that their curves never cross; not for a population', &
      &   choices=reshape([character(len=choices_length) :: state_names], [most_choices], pad=blank))]

   !> Those that give equally spaced levels
   character(len=5), parameter :: grid_variables(3) = [character(len=5) :: 'first', 'last', 'count']

   !> Input of the stripes
   type :: stripes_input_type
      !> Intensity measure that the records are scaled by
      type(scaling_type) :: scaling
      !> Levels, in the unit of the intensity measure; not allocated: not given
      real(wp), allocatable :: levels(:)
      !> EDP thresholds, each a damage state; the last is the limit of the solver, collapse
      real(wp), allocatable :: thresholds(:)
      !> One of state_names
      character(len=:), allocatable :: states
   contains
      !> The same as settings
      procedure :: put
   end type stripes_input_type

contains

   !> Read the group
   subroutine read_stripes_group(group, stripes, error)
      !> The group as read from the file
      type(group_type), intent(in) :: group
      !> Input of the stripes
      type(stripes_input_type), intent(out) :: stripes
      !> What is wrong with it
      type(error_type), allocatable, intent(out) :: error

      type(group_settings_type) :: settings

      call new_settings(settings, stripes_properties)
      call read_settings(group, settings, error)
      if (allocated(error)) return
      call new_scaling(stripes%scaling, settings%word('im'), error)
      call group%locate(error)
      if (.not. allocated(error)) call make_grid(group, settings, stripes, error)
      if (allocated(error)) return
      if (settings%has('levels')) then
         if (allocated(stripes%levels)) then
            call raise_input(error, 'levels: give either levels or first, last and count', not_together, 'levels')
            call group%locate(error)
            return
         end if
         stripes%levels = settings%list('levels')
         if (size(stripes%levels) > most_levels) then
            call group%refuse('levels', 'must be at most '//to_text(most_levels)//' values', wrong_length, error)
            return
         end if
      end if
      stripes%states = settings%word('states')
      stripes%thresholds = settings%list('edp_thresholds')
      if (size(stripes%thresholds) > most_thresholds) then
         call group%refuse('edp_thresholds', 'must be at most '//to_text(most_thresholds)//' values', wrong_length, error)
         return
      end if
      if (.not. allocated(stripes%levels)) return
      call check_levels(stripes%levels, error)
      call group%locate(error)
      if (.not. allocated(error)) call settle_levels(stripes%levels)
   end subroutine read_stripes_group

   !> Check the EDP thresholds, and make collapse the last of them
   subroutine check_states(stripes, edp_limit, error)
      !> Input of the stripes
      type(stripes_input_type), intent(inout) :: stripes
      !> Rotation / capacity at which the wall has collapsed
      real(wp), intent(in) :: edp_limit
      !> A threshold that cannot be
      type(error_type), allocatable, intent(out) :: error

      call check_thresholds(stripes%thresholds, edp_limit, error)
      if (allocated(error)) return
      stripes%thresholds = [pack(stripes%thresholds, stripes%thresholds < edp_limit), edp_limit]
   end subroutine check_states

   !> Make levels of first, last and count, if they were given
   subroutine make_grid(group, settings, stripes, error)
      !> The group as read from the file
      type(group_type), intent(in) :: group
      type(group_settings_type), intent(in) :: settings
      !> Input of the stripes: equally spaced levels, both ends included
      type(stripes_input_type), intent(inout) :: stripes
      !> What is wrong with it
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: first, last
      integer :: count, i

      if (.not. any([settings%has('first'), settings%has('last'), settings%has('count')])) return
      do i = 1, size(grid_variables)
         if (settings%has(trim(grid_variables(i)))) cycle
         call raise_input(error, trim(grid_variables(i))//': must be given: first, last and count belong together', not_given, &
            & trim(grid_variables(i)))
         call group%locate(error)
         return
      end do
      first = settings%number('first')
      last = settings%number('last')
      count = nint(settings%number('count'))
      if (.not. last > first) then
         call group%refuse('last', 'must be greater than first = '//to_text(first), out_of_range, error)
         return
      end if
      stripes%levels = even_levels(first, last, count)
   end subroutine make_grid

   !> Input of the stripes as settings; without levels only their measure
   subroutine put(self, settings)
      !> Input of the stripes
      class(stripes_input_type), intent(in) :: self
      !> Values of stripes_properties
      type(group_settings_type), intent(out) :: settings

      call new_settings(settings, stripes_properties)
      call settings%set('im', self%scaling%name)
      if (.not. allocated(self%levels)) return
      call settings%set('levels', self%levels)
      call settings%set('edp_thresholds', self%thresholds)
      call settings%set('states', self%states)
   end subroutine put

end module dondolo_case_stripes_group
