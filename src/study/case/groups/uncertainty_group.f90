!> The group &uncertainty: what is not known for certain of the one wall of a case.
module dondolo_case_uncertainty_group
   use dondolo_base_error, only : error_type, not_given, out_of_range, problems_type, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : is_integer, is_text, name_length, property_type
   use dondolo_base_settings, only : group_settings_type, new_settings
   use dondolo_base_text, only : to_text
   use dondolo_case_namelist_group, only : group_type
   use dondolo_case_settings_group, only : read_settings
   use dondolo_population_distribution, only : distribution_type, new_distribution
   use dondolo_population_sensitivity, only : smallest_sample
   use dondolo_population_variants, only : sample_variants, base_wall_type
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   use dondolo_wall_tested_restitution, only : check_published, published_parameters
   implicit none
   private

   public :: read_uncertainty_group
   public :: uncertainty_properties

   !> Variables of the group; behind the first two properties of walls, by their names
   type(property_type), target, protected :: uncertainty_properties(20) = [ &
      & property_type('variants', is_integer, default=200.0_wp, smallest=8.0_wp, largest=10000.0_wp, &
      &   meaning='walls of the sample; of k properties at least 2 + 6 k + k (k - 1): 8 of one, 38 of four'), &
      & property_type('seed', is_integer, default=1.0_wp, smallest=1.0_wp, largest=1.0e6_wp, &
      &   meaning='seed of the random numbers; the same seed gives the same walls'), &
      & property_type('restitution_factor', is_text, optional=.true., example='graziotti_2016', meaning='its '// &
      &   'distribution, or a published one: ''graziotti_2016'' (two_block, model ''sorrentino''), ''colombo_2025'' '// &
      &   '(free_standing, stone), ''elgawady_2010'' (free_standing, concrete)'), &
      & property_type('hinge', is_text, optional=.true., example='triangular(0.5, 0.6, 0.75)', meaning='its distribution'), &
      & property_type('hinge_depth', is_text, optional=.true., example='lognormal(0.01, 0.4)', &
      &   meaning='its distribution, m'), &
      & property_type('compressive_strength', is_text, optional=.true., example='lognormal(2.0e6, 0.3)', &
      &   meaning='its distribution, Pa'), &
      & property_type('elastic_period', is_text, optional=.true., example='lognormal(0.107, 0.3, 0.04, 0.25)', &
      &   meaning='distribution of the period of a strip that bends before it rocks, s'), &
      & property_type('density', is_text, optional=.true., example='normal(1800.0, 90.0)', &
      &   meaning='its distribution, kg/m3'), &
      & property_type('height', is_text, optional=.true., example='uniform(2.9, 3.1)', meaning='its distribution, m'), &
      & property_type('thickness', is_text, optional=.true., example='normal(0.25, 0.01)', meaning='its distribution, m'), &
      & property_type('wedge_angle', is_text, optional=.true., example='uniform(15.0, 30.0)', &
      &   meaning='distribution of the one angle of all wedges, degrees'), &
      & property_type('wing_angle', is_text, optional=.true., example='uniform(10.0, 30.0)', &
      &   meaning='distribution of the angle of the cracks of a corner, degrees'), &
      & property_type('overburden', is_text, optional=.true., example='uniform(4.0e3, 8.0e3)', &
      &   meaning='its distribution, N/m'), &
      & property_type('eccentricity', is_text, optional=.true., example='uniform(-0.05, 0.05)', &
      &   meaning='its distribution, m'), &
      & property_type('period', is_text, optional=.true., example='uniform(0.30, 0.45)', &
      &   meaning='distribution of the period of a building of one mode, s'), &
      & property_type('damping', is_text, optional=.true., example='uniform(0.05, 0.15)', &
      &   meaning='its distributions damping ratio'), &
      & property_type('participation', is_text, optional=.true., example='uniform(0.8, 1.0)', &
      &   meaning='distribution of that of its mode at the base of the wall'), &
      & property_type('participation_top', is_text, optional=.true., example='uniform(1.2, 1.4)', &
      &   meaning='distribution of that of its mode at the top of the wall'), &
      & property_type('level_top', is_text, optional=.true., example='uniform(6.0, 9.0)', &
      &   meaning='distribution of the level up to which the building moves the wall, m'), &
      & property_type('diaphragm_period', is_text, optional=.true., example='uniform(0.2, 0.8)', &
      &   meaning='distribution of the period of a flexible floor at the top of the wall, s')]

contains

   !> Read the group, and make the variants of the wall
   subroutine read_uncertainty_group(group, wall, settings, error)
      !> The group as read from the file
      type(group_type), intent(in) :: group
      !> The wall: its variants are set
      type(base_wall_type), intent(inout) :: wall
      !> What the group says
      type(group_settings_type), intent(out) :: settings
      !> What is wrong with it
      type(error_type), allocatable, intent(out) :: error

      type(distribution_type), allocatable :: distributions(:)
      type(distribution_type) :: one
      type(problems_type) :: problems
      character(len=name_length), allocatable :: sources(:)
      integer :: i

      call new_settings(settings, uncertainty_properties)
      call read_settings(group, settings, error)
      if (allocated(error)) return
      allocate (distributions(0), sources(0))
      do i = 3, size(uncertainty_properties)
         associate (name => uncertainty_properties(i)%name)
            if (.not. settings%has(trim(name))) cycle
            call new_distribution(one, trim(name), settings%word(trim(name)), error)
            call problems%take(error)
            sources = [character(len=name_length) :: sources, name]
            distributions = [distributions, one]
         end associate
      end do
      call problems%raise(error)
      if (.not. allocated(error) .and. size(sources) == 0) call raise_input(error, 'a property must have a distribution, '// &
         & 'such as hinge = ''triangular(0.5, 0.6, 0.75)''', not_given)
      associate (variants => nint(settings%number('variants')))
         if (.not. allocated(error) .and. variants < smallest_sample(size(sources))) call raise_input(error, 'variants = '// &
            & to_text(variants)//': must be at least '//to_text(smallest_sample(size(sources)))//' for the indices of '// &
            & to_text(size(sources))//' properties', out_of_range, 'variants')
         if (.not. allocated(error)) call sample_variants(wall, sources, distributions, variants, nint(settings%number('seed')))
         if (.not. allocated(error) .and. settings%has('restitution_factor')) then
            call check_factor(settings%word('restitution_factor'), wall, error)
            i = findloc(sources == 'restitution_factor', .true., dim=1)
            if (.not. allocated(error)) call cut_off(settings%word('restitution_factor'), wall, distributions(i))
            if (.not. allocated(error)) call sample_variants(wall, sources, distributions, variants, nint(settings%number('seed')))
         end if
      end associate
      call group%locate(error)
   end subroutine read_uncertainty_group

   !> Check that a published range is of the wall with all properties at their medians: an uncertain load whose mass it
   !> lifts changes the model
   subroutine check_factor(text, wall, error)
      !> What is given for the factor
      character(len=*), intent(in) :: text
      !> The wall with its variants
      type(base_wall_type), intent(in) :: wall
      !> It is not
      type(error_type), allocatable, intent(out) :: error

      type(wall_input_type) :: input
      type(wall_type) :: medians

      input = wall%wall_input_type
      call wall%vary(wall%row_of_medians(), input)
      call new_wall(medians, input, error)
      if (allocated(error)) then
         ! The variant is refused where all are made, with its name.
         deallocate (error)
         return
      end if
      call check_published(text, medians, error)
   end subroutine check_factor

   !> Cut a published distribution off where the most slender variant of the wall needs it
   subroutine cut_off(text, wall, distribution)
      !> What is given for the factor
      character(len=*), intent(in) :: text
      !> The wall with its variants
      type(base_wall_type), intent(in) :: wall
      !> The distribution; left as it is where a text is no name of one
      type(distribution_type), intent(inout) :: distribution

      type(wall_input_type) :: input
      type(wall_type), allocatable :: variants(:)
      type(error_type), allocatable :: error
      real(wp), allocatable :: parameters(:)
      integer :: row

      allocate (variants(wall%rows()))
      if (size(published_parameters(text, variants)) == 0) return
      do row = 1, size(variants)
         input = wall%wall_input_type
         call wall%vary(row, input)
         call input%set('restitution_factor', 1.0_wp)
         ! A variant that is impossible is refused where all are made, with its name
         call new_wall(variants(row), input, error)
      end do
      parameters = published_parameters(text, variants)
      distribution%parameters = parameters
   end subroutine cut_off

end module dondolo_case_uncertainty_group
