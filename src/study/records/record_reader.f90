!> Accelerogram files of every known format, recognised by their content.
module dondolo_records_record_reader
   use dondolo_base_error, only : add_place, error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_limits, only : longest_record_file
   use dondolo_files_text_file, only : find_lines, load_text, text_file_type
   use dondolo_record, only : record_type
   use dondolo_records_channel, only : as_record, find_channel, name_channels
   use dondolo_records_column_values, only : check_channel
   use dondolo_records_formats, only : find_format, format_type, read_as, recognise_format
   use dondolo_records_format, only : given_type, samples_type
   use dondolo_records_single_column, only : read_single_column
   implicit none
   private

   public :: read_record, read_records

contains

   !> Read an accelerogram
   !>
   !> What the file states is used; a time step or units that are given as well must agree with it.
   subroutine read_record(file, record, error, dt, units, channel, format, columns)
      !> Path of the file
      character(len=*), intent(in) :: file
      !> The record; its name is the stem of the file, with the channel's if there are several
      type(record_type), intent(out) :: record
      !> The file is missing, unknown, wrong, says less than is needed, or holds several channels and none is chosen
      type(error_type), allocatable, intent(out) :: error
      !> Time step [s], needed where the file does not state it
      real(wp), intent(in), optional :: dt
      !> Units of the values, needed where the file does not state them; empty is not given
      character(len=*), intent(in), optional :: units
      !> Name of a channel, or its number; empty is not given
      character(len=*), intent(in), optional :: channel
      !> Name of the format that the file is in, not to be recognised; empty is not given
      character(len=*), intent(in), optional :: format
      !> What plain columns are, 'rows' or a word for each (dondolo_records_column_layout); empty is not given
      character(len=*), intent(in), optional :: columns

      type(text_file_type) :: text
      type(samples_type) :: samples
      integer :: i

      call read_samples(file, text, samples, error, format, dt, units, columns)
      if (allocated(error)) return
      call find_channel(samples, i, error, channel)
      call add_place(error, file)
      if (.not. allocated(error)) call as_record(text, samples, i, record, error, dt, units)
   end subroutine read_record

   !> Read all channels of a file
   subroutine read_records(file, records, error, dt, units, format, columns)
      !> Path of the file
      character(len=*), intent(in) :: file
      !> One record for each channel that holds accelerations
      type(record_type), allocatable, intent(out) :: records(:)
      !> As of `read_record`
      type(error_type), allocatable, intent(out) :: error
      !> Time step [s], needed where the file does not state it
      real(wp), intent(in), optional :: dt
      !> Units of the values, needed where the file does not state them; empty is not given
      character(len=*), intent(in), optional :: units
      !> Name of the format that the file is in, not to be recognised; empty is not given
      character(len=*), intent(in), optional :: format
      !> What plain columns are, 'rows' or a word for each (dondolo_records_column_layout); empty is not given
      character(len=*), intent(in), optional :: columns

      type(text_file_type) :: text
      type(samples_type) :: samples
      integer, allocatable :: ground(:)
      integer :: i

      call read_samples(file, text, samples, error, format, dt, units, columns)
      if (allocated(error)) return
      ground = pack([(i, i=1, size(samples%channels))], &
         & [(.not. allocated(samples%channels(i)%refusal), i=1, size(samples%channels))])
      ! If no channel is, the error is that of the first
      if (size(ground) == 0) ground = [1]
      allocate (records(size(ground)))
      do i = 1, size(records)
         call as_record(text, samples, ground(i), records(i), error, dt, units)
         if (.not. allocated(error)) cycle
         deallocate (records)
         return
      end do
   end subroutine read_records

   !> Read what a file says
   subroutine read_samples(file, text, samples, error, format, dt, units, columns)
      !> Path of the file
      character(len=*), intent(in) :: file
      type(text_file_type), intent(out) :: text
      !> What it says
      type(samples_type), intent(out) :: samples
      !> The file is missing, unknown or wrong
      type(error_type), allocatable, intent(out) :: error
      !> Name of the format that the file is in; empty is not given
      character(len=*), intent(in), optional :: format
      !> Time step [s], units and kinds of columns that the caller gives
      real(wp), intent(in), optional :: dt
      character(len=*), intent(in), optional :: units, columns

      type(format_type) :: chosen
      type(given_type) :: given
      integer :: i
      logical :: is_given, is_column

      given%units = ''
      given%columns = ''
      if (present(dt)) given%dt = dt
      if (present(units)) given%units = trim(units)
      if (present(columns)) given%columns = trim(columns)
      is_given = .false.
      if (present(format)) is_given = len_trim(format) > 0
      if (is_given) call find_format(format, chosen, error)
      call add_place(error, file)
      if (.not. allocated(error)) call load_text(file, text, error, longest_record_file)
      if (allocated(error)) return
      is_column = .false.
      if ((.not. is_given .or. chosen%is_plain) .and. len(given%columns) == 0) call read_single_column(text, samples, is_column, dt)
      if (is_column) then
         if (.not. is_given) call find_format('columns', chosen, error)
      else
         call find_lines(text, error, has_latin=.true.)
         if (allocated(error)) return
         if (.not. is_given) call recognise_format(text, chosen, error)
         call add_place(error, file)
         if (.not. allocated(error)) call read_as(chosen, text, given, samples, error)
      end if
      if (chosen%is_plain .and. .not. allocated(error)) then
         do i = 1, size(samples%channels)
            if (.not. (allocated(error) .or. allocated(samples%channels(i)%refusal))) call check_channel(file, &
               & samples%channels(i), error)
         end do
      end if
      if (allocated(error)) return
      call samples%metadata%set('format', chosen%name)
      call name_channels(samples%channels)
   end subroutine read_samples

end module dondolo_records_record_reader
