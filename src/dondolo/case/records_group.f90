!> The group &records: the accelerograms and their polarity.
module dondolo_records_group
   use dondolo_error, only : error_type, raise_input
   use dondolo_namelist_group, only : group_type
   use dondolo_settings, only : settings_type
   use dondolo_study, only : polarity_names
   use dondolo_text, only : join, lower
   implicit none
   private

   public :: records_input_type, read_records_group, echo_records
   public :: records_variables

   !> Variables of the group
   character(len=9), parameter :: records_variables(2) = [character(len=9) :: 'catalogue', 'polarity']

   !> What is said of the accelerograms
   type :: records_input_type
      !> Path of the catalogue, relative to the case
      character(len=:), allocatable :: catalogue
      !> Polarity, one of polarity_names
      character(len=:), allocatable :: polarity
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

      records%catalogue = ''
      records%polarity = 'as_recorded'
      call group%check_names(records_variables, error)
      if (.not. allocated(error)) call group%get_text('catalogue', records%catalogue, error)
      if (.not. allocated(error)) call group%get_text('polarity', records%polarity, error)
      if (allocated(error)) return
      records%polarity = lower(trim(records%polarity))
      if (.not. group%has('catalogue')) then
         call raise_input(error, group%place()//': catalogue: must be given, a CSV table with one row a record'// &
            & group%in_line(''))
      else if (len_trim(records%catalogue) == 0) then
         call group%refuse('catalogue', 'must name a CSV table with one row a record', error)
      else if (.not. any(records%polarity == polarity_names)) then
         call group%refuse('polarity', 'must be one of '//join(polarity_names), error)
      end if
   end subroutine read_records_group

   !> Write the group as namelist text with every value in force
   subroutine echo_records(records, settings)
      !> What is said of the accelerograms
      type(records_input_type), intent(in) :: records
      !> Settings to add to
      type(settings_type), intent(inout) :: settings

      call settings%add('records', 'catalogue', records%catalogue)
      call settings%add('records', 'polarity', records%polarity)
   end subroutine echo_records

end module dondolo_records_group
