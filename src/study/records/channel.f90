!> From a channel of a file to a record: which channel, its time step, its units, and a look at the header's own peak.
module dondolo_records_channel
   use dondolo_base_error, only : add_place, error_type, not_a_word, out_of_range, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_integer, parse_real
   use dondolo_base_plain, only : shown, visible
   use dondolo_base_text, only : brief, lower, to_text
   use dondolo_files_text_file, only : text_file_type
   use dondolo_record, only : move_to_record, record_type
   use dondolo_records_earthquake, only : settle_labels
   use dondolo_records_format, only : channel_type, raise_at, samples_type, step_tolerance
   use dondolo_records_units, only : unit_factor
   implicit none
   private

   public :: as_record, find_channel, name_channels, stem

   !> Longest time step of an accelerogram [s]
   real(wp), parameter :: largest_step = 1.0_wp

   !> Relative difference allowed between the peak and the header's, beyond the rounding of its print
   real(wp), parameter :: peak_tolerance = 0.01_wp

contains

   !> Make a record of a channel
   subroutine as_record(text, samples, number, record, error, dt, units)
      type(text_file_type), intent(in) :: text
      !> What it says; the values of the channel are moved away
      type(samples_type), intent(inout) :: samples
      !> Number of the channel
      integer, intent(in) :: number
      !> The record; its name is the stem of the file, with the channel's if there are several
      type(record_type), intent(out) :: record
      !> Step or units are missing or differ, or the values are no record
      type(error_type), allocatable, intent(out) :: error
      !> Time step that the caller gives [s]
      real(wp), intent(in), optional :: dt
      !> Units that the caller gives; empty is not given
      character(len=*), intent(in), optional :: units

      character(len=:), allocatable :: stated, name
      real(wp) :: step, factor
      logical :: is_given

      is_given = .false.
      if (present(units)) is_given = len_trim(units) > 0
      associate (channel => samples%channels(number))
         if (allocated(channel%refusal)) then
            call raise_input(error, channel%refusal)
            return
         end if
         stated = ''
         if (allocated(channel%units)) stated = channel%units
         if (.not. (present(dt) .or. channel%dt > 0.0_wp) .and. len_trim(stated) == 0 .and. .not. is_given) call raise_input( &
            & error, 'the file does not state its time step and its units: dt and units, such as ''g'' or ''m/s2'', must be '// &
            & 'given; in a catalogue they are the columns dt_s and units')
         if (.not. allocated(error)) call choose_step(channel%dt, channel%dt_doubt, step, error, dt)
         if (.not. allocated(error) .and. step > largest_step) call raise_input(error, 'time step '//to_text(step)// &
            & ' s: must be at most '//to_text(largest_step)//' s for an accelerogram')
         if (.not. allocated(error)) call choose_units(stated, factor, error, units)
         call add_place(error, text%file)
         if (.not. allocated(error)) call check_peak(text, channel, factor, error)
         if (allocated(error)) return
         name = stem(text%file)
         if (size(samples%channels) > 1) name = name//'.'//underscored(channel%name)
         channel%values = factor*channel%values
         call move_to_record(channel%values, step, visible(name), record, error)
         call add_place(error, text%file)
         if (allocated(error)) return
         record%metadata = samples%metadata
         call record%metadata%include(channel%metadata)
         if (size(samples%channels) > 1) call record%metadata%set('channel', channel%name)
         call record%metadata%set('quantity', 'acceleration')
         call record%metadata%set('units', stated)
         call settle_labels(record%metadata)
      end associate
   end subroutine as_record

   !> Give every channel a name of its own: an empty name, or one that stands there before, gets the channel's number
   subroutine name_channels(channels)
      type(channel_type), intent(inout) :: channels(:)

      integer :: i, other

      do i = 1, size(channels)
         if (.not. allocated(channels(i)%name)) channels(i)%name = ''
         channels(i)%name = trim(adjustl(channels(i)%name))
         if (len(channels(i)%name) == 0) channels(i)%name = to_text(i)
         do other = 1, i - 1
            if (lower(channels(other)%name) /= lower(channels(i)%name)) cycle
            channels(i)%name = channels(i)%name//' ('//to_text(i)//')'
            exit
         end do
      end do
   end subroutine name_channels

   !> Find the channel that is asked for, or the only one
   subroutine find_channel(samples, number, error, wanted)
      !> What the file says
      type(samples_type), intent(in) :: samples
      !> Number of the channel
      integer, intent(out) :: number
      !> There is no such channel, or there are several and none is asked for
      type(error_type), allocatable, intent(out) :: error
      !> Name of the channel, or its number; a name goes before a number; empty is not given
      character(len=*), intent(in), optional :: wanted

      character(len=:), allocatable :: name, names
      integer, allocatable :: ground(:)
      integer :: i
      logical :: ok

      name = ''
      if (present(wanted)) name = trim(adjustl(wanted))
      number = 1
      if (len(name) == 0) then
         ground = pack([(i, i=1, size(samples%channels))], &
            & [(.not. allocated(samples%channels(i)%refusal), i=1, size(samples%channels))])
         if (size(ground) == 1) number = ground(1)
         if (size(ground) < 2) return
         call list_names(samples%channels(ground), names)
         call raise_input(error, 'the file has '//to_text(size(ground))//' channels: channel must be one of '//names)
         return
      end if
      do i = 1, size(samples%channels)
         if (lower(samples%channels(i)%name) /= lower(name)) cycle
         number = i
         return
      end do
      call parse_integer(name, number, ok)
      if (ok) ok = number >= 1 .and. number <= size(samples%channels)
      if (ok) return
      call list_names(samples%channels, names)
      call raise_input(error, 'channel = '''//name//''': must be one of '//names//', or a number from 1 to '// &
         & to_text(size(samples%channels)), not_a_word, 'channel')
   end subroutine find_channel

   !> Take the time step from the file or from the caller
   subroutine choose_step(stated, doubt, step, error, given)
      !> Time step that the file states [s], 0 if none
      real(wp), intent(in) :: stated
      !> By how much it may be off where it follows from the print of times, 0 otherwise [s]
      real(wp), intent(in) :: doubt
      !> Time step [s]
      real(wp), intent(out) :: step
      !> There is none, or two that differ
      type(error_type), allocatable, intent(out) :: error
      !> Time step that the caller gives [s]
      real(wp), intent(in), optional :: given

      step = stated
      if (.not. present(given)) then
         if (.not. stated > 0.0_wp) call raise_input(error, 'the file does not state its time step: '// &
            & 'dt must be given, dt_s in a catalogue')
         return
      end if
      if (.not. (given > 0.0_wp .and. given <= huge(given))) then
         call raise_input(error, 'dt = '//to_text(given)//': must be positive', out_of_range, 'dt')
         return
      end if
      ! Within the rounding of the times the given step is the better one
      if (.not. stated > 0.0_wp .or. abs(given - stated) <= doubt) then
         step = given
      else if (abs(given - stated) <= step_tolerance*stated) then
         return
      else if (doubt > 0.0_wp) then
         call raise_input(error, 'dt = '//to_text(given)//': the times in the file are '//to_text(stated)//' s apart')
      else
         call raise_input(error, 'dt = '//to_text(given)//': the file states '//to_text(stated))
      end if
   end subroutine choose_step

   !> Take the units from the file or from the caller
   subroutine choose_units(stated, factor, error, given)
      !> Units that the file states, empty if none
      character(len=*), intent(in) :: stated
      !> Size of the unit [m/s2]
      real(wp), intent(out) :: factor
      !> There are none, two that differ, or one that is not known
      type(error_type), allocatable, intent(out) :: error
      !> Units that the caller gives
      character(len=*), intent(in), optional :: given

      real(wp) :: factor_given
      logical :: is_given

      factor = 1.0_wp
      is_given = .false.
      if (present(given)) is_given = len_trim(given) > 0
      if (is_given) then
         call unit_factor(given, factor_given, error)
         if (allocated(error)) return
      else
         if (len_trim(stated) == 0) then
            call raise_input(error, 'the file does not state its units: units must be given, such as ''g'' or ''m/s2''; in a '// &
               & 'catalogue they are the column units')
            return
         end if
      end if
      if (len_trim(stated) == 0) then
         factor = factor_given
         return
      end if
      call unit_factor(stated, factor, error)
      if (allocated(error) .or. .not. is_given) return
      if (factor_given < factor .or. factor_given > factor) then
         call raise_input(error, 'units = '''//trim(given)//''': the file states '''//trim(stated)//'''')
      end if
   end subroutine choose_units

   !> The largest value must be the one that the header states, if it states one
   subroutine check_peak(text, channel, factor, error)
      type(text_file_type), intent(in) :: text
      type(channel_type), intent(in) :: channel
      !> Size of the unit of its values [m/s2]
      real(wp), intent(in) :: factor
      !> The two disagree
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: stated, unit, peak, rounding
      logical :: ok

      if (.not. allocated(channel%peak)) return
      if (len_trim(channel%peak) == 0) return
      call parse_real(channel%peak, stated, ok)
      if (.not. ok) then
         call raise_at(error, text, channel%peak_line, 'peak value '''//shown(trim(adjustl(channel%peak)))// &
            & ''': must be a number')
         return
      end if
      unit = factor
      if (allocated(channel%peak_units)) then
         call unit_factor(channel%peak_units, unit, error)
         call add_place(error, text%place(channel%peak_line))
         if (allocated(error)) return
      end if
      peak = factor/unit*maxval(abs(channel%values))
      rounding = 0.5_wp*10.0_wp**(-decimals_of(channel%peak))
      if (abs(peak - abs(stated)) <= peak_tolerance*abs(stated) + rounding) return
      call raise_at(error, text, channel%peak_line, 'peak value '//to_text(stated)//': the largest value is '// &
         & brief(peak))
   end subroutine check_peak

   !> Decimals of a printed number
   pure function decimals_of(text) result(decimals)
      !> The number
      character(len=*), intent(in) :: text
      !> How many digits follow its point, less its exponent
      integer :: decimals

      integer :: point, mark, exponent
      logical :: ok

      mark = scan(text, 'eEdD')
      if (mark == 0) mark = len_trim(text) + 1
      exponent = 0
      if (mark < len_trim(text)) call parse_integer(text(mark + 1:), exponent, ok)
      point = index(text(:mark - 1), '.')
      decimals = -exponent
      if (point > 0) decimals = mark - 1 - point - exponent
   end function decimals_of

   !> Names of channels, for messages
   pure subroutine list_names(channels, names)
      type(channel_type), intent(in) :: channels(:)
      !> Their names in quotes, separated by commas
      character(len=:), allocatable, intent(out) :: names

      integer :: i

      names = ''
      do i = 1, size(channels)
         if (i > 1) names = names//', '
         names = names//''''//channels(i)%name//''''
      end do
   end subroutine list_names

   !> A name without blanks
   pure function underscored(name)
      !> Name
      character(len=*), intent(in) :: name
      !> The same with underscores for blanks
      character(len=len(name)) :: underscored

      integer :: i

      underscored = name
      do i = 1, len(name)
         if (name(i:i) == ' ') underscored(i:i) = '_'
      end do
   end function underscored

   !> Length of a stem
   pure integer function stem_length(file)
      !> Path
      character(len=*), intent(in) :: file

      associate (name => file(scan(file, '/\', back=.true.) + 1:))
         stem_length = index(name, '.', back=.true.) - 1
         if (stem_length < 1) stem_length = len_trim(name)
      end associate
   end function stem_length

   !> Name of a file without folder and last extension
   pure function stem(file)
      !> Path
      character(len=*), intent(in) :: file
      !> Its stem
      character(len=stem_length(file)) :: stem

      stem = file(scan(file, '/\', back=.true.) + 1:)
   end function stem

end module dondolo_records_channel
