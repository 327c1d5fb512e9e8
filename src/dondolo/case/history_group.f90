!> The group &history: which record, and how strong, for one time history.
module dondolo_history_group
   use dondolo_error, only : error_type, raise_input
   use dondolo_kinds, only : wp
   use dondolo_namelist_group, only : group_type
   use dondolo_record, only : record_type
   use dondolo_settings, only : settings_type
   use dondolo_text, only : to_text
   implicit none
   private

   public :: history_input_type, read_history_group, find_record, echo_history
   public :: history_variables

   !> Variables of the group
   character(len=8), parameter :: history_variables(3) = [character(len=8) :: 'record', 'scale', 'im_level']

   !> What is said of the time history
   type :: history_input_type
      !> Number of the record in the catalogue, from 1
      integer :: record = 1
      !> Name of the record; not allocated: its number was given
      character(len=:), allocatable :: record_name
      !> Factor on the record; not allocated: the level was given
      real(wp), allocatable :: scale
      !> Level of the intensity measure to scale to, in its unit
      real(wp), allocatable :: im_level
   end type history_input_type

contains

   !> Read the group
   subroutine read_history_group(group, history, error)
      !> The group as it stands in the file
      type(group_type), intent(in) :: group
      !> What is said of the time history
      type(history_input_type), intent(out) :: history
      !> What is wrong with it
      type(error_type), allocatable, intent(out) :: error

      call group%check_names(history_variables, error)
      if (allocated(error)) return
      if (group%has_text('record')) then
         call group%get_text('record', history%record_name, error)
      else
         call group%get_integer('record', history%record, error)
      end if
      if (allocated(error)) return
      if (group%has('scale') .and. group%has('im_level')) then
         call raise_input(error, group%place()//': im_level: give either scale or im_level'// &
            & group%in_line('im_level'))
      else if (group%has('im_level')) then
         call get_positive(group, 'im_level', history%im_level, error)
      else if (group%has('scale')) then
         call get_positive(group, 'scale', history%scale, error)
      else
         history%scale = 1.0_wp
      end if
   end subroutine read_history_group

   !> Take a number that must be positive
   subroutine get_positive(group, name, value, error)
      !> The group
      type(group_type), intent(in) :: group
      !> Name of the variable
      character(len=*), intent(in) :: name
      !> Its value
      real(wp), allocatable, intent(inout) :: value
      !> Not a positive number
      type(error_type), allocatable, intent(out) :: error

      value = 0.0_wp
      call group%get_real(name, value, error)
      if (allocated(error)) return
      if (.not. value > 0.0_wp) call group%refuse(name, 'must be positive', error)
   end subroutine get_positive

   !> Find the record in the catalogue
   subroutine find_record(group, history, records, error)
      !> The group as it stands in the file
      type(group_type), intent(in) :: group
      !> What is said of the time history: the number of the record is set from its name
      type(history_input_type), intent(inout) :: history
      !> The records of the catalogue
      type(record_type), intent(in) :: records(:)
      !> There is no such record
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      if (allocated(history%record_name)) then
         do i = 1, size(records)
            history%record = i
            if (records(i)%name == history%record_name) return
         end do
         call group%refuse('record', 'no such record; there are '//some_names(records), error)
      else if (history%record < 1 .or. history%record > size(records)) then
         call group%refuse('record', 'must lie between 1 and '//to_text(size(records))// &
            & ', the number of records in the catalogue', error)
      end if
   end subroutine find_record

   !> The first names of a catalogue, as many as fit a message
   pure function some_names(records) result(list)
      !> The records
      type(record_type), intent(in) :: records(:)
      !> 'a', 'b', ... and 30 more
      character(len=:), allocatable :: list

      integer, parameter :: shown = 8
      integer :: i

      list = ''
      do i = 1, min(shown, size(records))
         if (i > 1) list = list//', '
         list = list//''''//records(i)%name//''''
      end do
      if (size(records) > shown) list = list//' and '//to_text(size(records) - shown)//' more'
   end function some_names

   !> Write the group as namelist text with every value in force
   subroutine echo_history(history, settings)
      !> What is said of the time history
      type(history_input_type), intent(in) :: history
      !> Settings to add to
      type(settings_type), intent(inout) :: settings

      if (allocated(history%record_name)) then
         call settings%add('history', 'record', history%record_name)
      else
         call settings%add('history', 'record', history%record)
      end if
      if (allocated(history%im_level)) then
         call settings%add('history', 'im_level', history%im_level)
      else
         call settings%add('history', 'scale', history%scale)
      end if
   end subroutine echo_history

end module dondolo_history_group
