!> The group &records: the accelerograms and their polarity.
module dondolo_case_records_group
   use dondolo_base_error, only : error_type, not_together
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : blank, choices_length, is_text, most_choices, property_type
   use dondolo_base_settings, only : group_settings_type, new_settings
   use dondolo_case_namelist_group, only : group_type
   use dondolo_case_settings_group, only : read_settings
   use dondolo_fragility_study, only : polarity_names
   implicit none
   private

   public :: records_input_type, read_records_group
   public :: records_properties

   !> What is done with vertical components
   character(len=choices_length), parameter :: vertical_names(2) = [character(len=choices_length) :: 'none', 'recorded']

   !> Largest factor on vertical components
   real(wp), parameter :: largest_factor = 100.0_wp

   !> Variables of the group
   type(property_type), target, protected :: records_properties(4) = [ &
      & property_type('catalogue', is_text, required=.true., names='a CSV table with one row per record', &
      &   changes_results=.false., example='data/records/synthetic44.csv', meaning='table with one row per record, from '// &
      &   'the folder of this file; its columns: file, dt_s, units, channel, format, vertical, and any others'), &
      & property_type('polarity', is_text, word='as_recorded', meaning='polarity of the records; ''both'' not for a '// &
      &   'time history', choices=reshape([character(len=choices_length) :: polarity_names], [most_choices], pad=blank)), &
      & property_type('vertical', is_text, word='none', meaning='vertical ground motion: ''recorded'' takes the '// &
      &   'components that the column vertical of the catalogue names', choices=reshape(vertical_names, [most_choices], &
      &   pad=blank)), &
      & property_type('vertical_factor', optional=.true., example='1.0', smallest=-largest_factor, largest=largest_factor, &
      &   meaning='factor on the vertical components beside that of their record, 1 if not given; negative: they are '// &
      &   'positive downwards')]

   !> Input of the accelerograms
   type :: records_input_type
      !> Path of the catalogue, relative to the case
      character(len=:), allocatable :: catalogue
      !> Polarity, one of polarity_names
      character(len=:), allocatable :: polarity
      !> What is done with vertical components, one of vertical_names
      character(len=:), allocatable :: vertical
      !> Factor on them; not allocated: they are left out
      real(wp), allocatable :: vertical_factor
   contains
      !> The same as settings
      procedure :: put
   end type records_input_type

contains

   !> Read the group
   subroutine read_records_group(group, records, error)
      !> The group as read from the file
      type(group_type), intent(in) :: group
      !> Input of the accelerograms
      type(records_input_type), intent(out) :: records
      !> What is wrong with it
      type(error_type), allocatable, intent(out) :: error

      type(group_settings_type) :: settings

      call new_settings(settings, records_properties)
      call read_settings(group, settings, error)
      records%catalogue = settings%word('catalogue')
      records%polarity = settings%word('polarity')
      records%vertical = settings%word('vertical')
      if (records%vertical == 'recorded') then
         records%vertical_factor = 1.0_wp
         if (settings%has('vertical_factor')) records%vertical_factor = settings%number('vertical_factor')
      else if (group%has('vertical_factor') .and. .not. allocated(error)) then
         call group%refuse('vertical_factor', 'only with vertical = ''recorded''', not_together, error)
      end if
   end subroutine read_records_group

   !> Input of the accelerograms as settings
   subroutine put(self, settings)
      !> Input of the accelerograms
      class(records_input_type), intent(in) :: self
      !> Values of records_properties
      type(group_settings_type), intent(out) :: settings

      call new_settings(settings, records_properties)
      if (allocated(self%catalogue)) call settings%set('catalogue', self%catalogue)
      call settings%set('polarity', self%polarity)
      call settings%set('vertical', self%vertical)
      if (allocated(self%vertical_factor)) call settings%set('vertical_factor', self%vertical_factor)
   end subroutine put

end module dondolo_case_records_group
