!> The group &records: the accelerograms and their polarity.
module dondolo_records_group
   use dondolo_error, only : error_type
   use dondolo_namelist_group, only : group_type
   use dondolo_property, only : blank, choices_length, is_text, most_choices, property_type
   use dondolo_settings, only : group_settings_type, new_settings
   use dondolo_settings_group, only : read_settings
   use dondolo_study, only : polarity_names
   implicit none
   private

   public :: records_input_type, read_records_group
   public :: records_properties

   !> Variables of the group
   type(property_type), target, protected :: records_properties(2) = [ &
      & property_type('catalogue', is_text, required=.true., names='a CSV table with one row a record', &
      &   changes_results=.false., example='data/records/synthetic44.csv', meaning='table with one row a record, from '// &
      &   'the folder of this file; its columns: file, dt_s, units, channel, format, and any others'), &
      & property_type('polarity', is_text, word='as_recorded', meaning='polarity of the records; ''both'' not for a '// &
      &   'time history', choices=reshape([character(len=choices_length) :: polarity_names], [most_choices], pad=blank))]

   !> What is said of the accelerograms
   type :: records_input_type
      !> Path of the catalogue, relative to the case
      character(len=:), allocatable :: catalogue
      !> Polarity, one of polarity_names
      character(len=:), allocatable :: polarity
   contains
      !> The same as settings
      procedure :: put
   end type records_input_type

contains

   !> Read the group
   subroutine read_records_group(group, records, error)
      !> The group as it stands in the file
      type(group_type), intent(in) :: group
      !> What is said of the accelerograms
      type(records_input_type), intent(out) :: records
      !> What is wrong with it
      type(error_type), allocatable, intent(out) :: error

      type(group_settings_type) :: settings

      call new_settings(settings, records_properties)
      call read_settings(group, settings, error)
      records%catalogue = settings%word('catalogue')
      records%polarity = settings%word('polarity')
   end subroutine read_records_group

   !> What is said of the accelerograms, as settings
   subroutine put(self, settings)
      !> What is said of the accelerograms
      class(records_input_type), intent(in) :: self
      !> Values of records_properties
      type(group_settings_type), intent(out) :: settings

      call new_settings(settings, records_properties)
      if (allocated(self%catalogue)) call settings%set('catalogue', self%catalogue)
      call settings%set('polarity', self%polarity)
   end subroutine put

end module dondolo_records_group
