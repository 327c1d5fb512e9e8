!> The group &history: which record, and how strong, for one time history.
module dondolo_case_history_group
   use dondolo_base_error, only : error_type, not_together, out_of_range, raise_input, unknown_name
   use dondolo_base_kinds, only : wp
   use dondolo_base_property, only : is_number_or_name, property_type
   use dondolo_base_settings, only : group_settings_type, new_settings
   use dondolo_base_text, only : to_text
   use dondolo_case_namelist_group, only : group_type
   use dondolo_case_settings_group, only : read_settings
   use dondolo_motion_initial_state, only : initial_state_type
   use dondolo_record, only : record_type
   implicit none
   private

   public :: history_input_type, read_history_group, find_record
   public :: history_properties

   !> Variables of the group
   type(property_type), target, protected :: history_properties(5) = [ &
      & property_type('record', is_number_or_name, default=1.0_wp, &
      &   meaning='number in the catalogue from 1, or a record''s name in quotes'), &
      & property_type('scale', default=1.0_wp, positive=.true., meaning='factor on the record'), &
      & property_type('im_level', optional=.true., positive=.true., example='0.4', &
      &   meaning='instead of scale: level to scale the record to, in the unit of &stripes im'), &
      & property_type('initial_rotation', unit='rad', default=0.0_wp, &
      &   meaning='rotation of the wall at the start, positive towards side 1'), &
      & property_type('initial_velocity', unit='rad/s', default=0.0_wp, &
      &   meaning='angular velocity of the wall at the start, positive towards side 1')]

   !> Input of the time history
   type :: history_input_type
      !> Number of the record in the catalogue, from 1
      integer :: record = 1
      !> Name of the record; not allocated: its number was given
      character(len=:), allocatable :: record_name
      !> Factor on the record; not allocated: the level was given
      real(wp), allocatable :: scale
      !> Level of the intensity measure to scale to, in its unit
      real(wp), allocatable :: im_level
      !> Rotation and velocity of the wall at the start
      type(initial_state_type) :: initial
   contains
      !> The same as settings
      procedure :: put
   end type history_input_type

contains

   !> Read the group
   subroutine read_history_group(group, history, error)
      !> The group as read from the file
      type(group_type), intent(in) :: group
      !> Input of the time history
      type(history_input_type), intent(out) :: history
      !> What is wrong with it
      type(error_type), allocatable, intent(out) :: error

      type(group_settings_type) :: settings

      call new_settings(settings, history_properties)
      call read_settings(group, settings, error)
      if (allocated(error)) return
      if (settings%has_word('record')) then
         history%record_name = settings%word('record')
      else
         history%record = nint(settings%number('record'))
      end if
      history%initial = initial_state_type(settings%number('initial_rotation'), settings%number('initial_velocity'))
      if (group%has('scale') .and. group%has('im_level')) then
         call raise_input(error, 'im_level: give either scale or im_level', not_together, 'im_level')
         call group%locate(error)
      else if (group%has('im_level')) then
         history%im_level = settings%number('im_level')
      else
         history%scale = settings%number('scale')
      end if
   end subroutine read_history_group

   !> Find the record in the catalogue
   subroutine find_record(group, history, records, error)
      !> The group as read from the file
      type(group_type), intent(in) :: group
      !> Input of the time history: the number of the record is set from its name
      type(history_input_type), intent(inout) :: history
      !> The records of the catalogue
      type(record_type), intent(in) :: records(:)
      !> There is no such record
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: known
      integer :: i

      if (allocated(history%record_name)) then
         do i = 1, size(records)
            history%record = i
            if (records(i)%name == history%record_name) return
         end do
         call list_names(records, known)
         call group%refuse('record', 'no such record; there are '//known, unknown_name, error)
      else if (history%record < 1 .or. history%record > size(records)) then
         call group%refuse('record', 'must lie between 1 and '//to_text(size(records))// &
            & ', the number of records in the catalogue', out_of_range, error)
      end if
   end subroutine find_record

   !> The first names of a catalogue, as many as fit a message
   subroutine list_names(records, list)
      type(record_type), intent(in) :: records(:)
      !> 'a', 'b', ... and 30 more
      character(len=:), allocatable, intent(out) :: list

      integer, parameter :: shown = 8
      integer :: i

      list = ''
      do i = 1, min(shown, size(records))
         if (i > 1) list = list//', '
         list = list//''''//records(i)%name//''''
      end do
      if (size(records) > shown) list = list//' and '//to_text(size(records) - shown)//' more'
   end subroutine list_names

   !> Input of the time history as settings
   subroutine put(self, settings)
      !> Input of the time history
      class(history_input_type), intent(in) :: self
      !> Values of history_properties
      type(group_settings_type), intent(out) :: settings

      call new_settings(settings, history_properties)
      if (allocated(self%record_name)) then
         call settings%set('record', self%record_name)
      else
         call settings%set('record', self%record)
      end if
      if (allocated(self%im_level)) then
         call settings%set('im_level', self%im_level)
      else
         call settings%set('scale', self%scale)
      end if
      call settings%set('initial_rotation', self%initial%rotation)
      call settings%set('initial_velocity', self%initial%velocity)
   end subroutine put

end module dondolo_case_history_group
