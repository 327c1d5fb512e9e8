!> COSMOS strong motion files, version 1.20 (.V0c to .V2c): one record after another, each with lines of text, a table
!> of integers, one of reals, comments that begin with |, and the values in a Fortran format that the file states.
!>
!> Records of accelerations are channels; those of velocities and displacements beside them are skipped. The counts of
!> a raw record become accelerations by the least bit of the recorder, the sensitivity of the sensor and the gain, and
!> lose their mean, which holds the offset of the instrument.
!>
!> Source of positions and codes: COSMOS Strong Motion Programs Board (2001), COSMOS Strong Motion Data Format,
!> version 1.20, tables 1 and 2.
module dondolo_records_format_cosmos
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_integer, parse_real
   use dondolo_base_text, only : first_word, lower, to_text
   use dondolo_files_text_file, only : text_file_type
   use dondolo_records_cosmos_header, only : cosmos_header_type, find_headers
   use dondolo_records_header_text, only : after, before, check_not_missing, leading_number, parse_format, squeezed
   use dondolo_records_format, only : block_type, channel_type, raise_at, read_fixed, samples_type
   use dondolo_records_units, only : unit_factor
   implicit none
   private

   public :: recognises_cosmos, read_cosmos

   !> A unit of acceleration
   type :: unit_type
      !> Its code (table 2)
      integer :: code
      !> The unit of the library that it is a multiple of
      character(len=5) :: name
      !> How many of those it is
      real(wp) :: multiple
   end type unit_type

   !> Units of acceleration: g, cm/s2, in/s2, gal, mg, micro g (an inch is 2.54 cm)
   type(unit_type), parameter :: accelerations(6) = [ &
      & unit_type(2, 'g', 1.0_wp), unit_type(4, 'cm/s2', 1.0_wp), unit_type(7, 'cm/s2', 2.54_wp), &
      & unit_type(10, 'gal', 1.0_wp), unit_type(11, 'g', 1.0e-3_wp), unit_type(12, 'g', 1.0e-6_wp)]

   !> Code of counts of the recorder
   integer, parameter :: counts_code = 50

   !> Code of acceleration (table 1)
   integer, parameter :: acceleration_code = 1

   !> Positions among the integers: processing stage, quantity, units
   integer, parameter :: stage_at = 1, quantity_at = 2, units_at = 3

   !> Positions among the reals: least bit of the recorder [microvolt], time step of a raw record [s], sensitivity of
   !> the sensor [V/g], gain, time step [ms], length of the record [s], largest value
   integer, parameter :: bit_at = 22, raw_step_at = 34, sensitivity_at = 42, gain_at = 47, step_at = 62, &
      & length_at = 63, peak_at = 64

   !> Relative difference allowed between count times step and the length of the record
   real(wp), parameter :: length_tolerance = 0.01_wp

contains

   !> Is a text in this format? The first line names the version of the format and the number of text lines
   logical function recognises_cosmos(text) result(recognised)
      type(text_file_type), intent(in) :: text

      recognised = index(lower(text%line(1)), '(format v') > 0 .and. index(lower(text%line(1)), 'text lines') > 0
   end function recognises_cosmos

   !> Read a COSMOS file: its records of acceleration
   subroutine read_cosmos(text, samples, error)
      type(text_file_type), intent(in) :: text
      !> What it says
      type(samples_type), intent(out) :: samples
      !> What is wrong, with file and line
      type(error_type), allocatable, intent(out) :: error

      type(cosmos_header_type), allocatable :: headers(:)
      character(len=:), allocatable :: quantity
      integer :: i, found

      call find_headers(text, headers, error)
      if (allocated(error)) return
      allocate (samples%channels(count([(is_acceleration(text, headers(i)), i=1, size(headers))])))
      if (size(samples%channels) == 0) then
         call find_quantity(text, headers(1), quantity)
         call raise_at(error, text, headers(1)%value_line, 'quantity = '''//quantity// &
            & ''', code '//headers(1)%integers%field(text, quantity_at)//': must be acceleration, code 1')
         return
      end if
      found = 0
      do i = 1, size(headers)
         if (.not. is_acceleration(text, headers(i))) then
            if (is_end(text%line(headers(i)%last_of_record))) cycle
            call raise_at(error, text, headers(i)%last_of_record, 'the record that begins in line '// &
               & to_text(headers(i)%first_line)//' is cut off: must end with End-of-data')
            return
         end if
         found = found + 1
         call headers(i)%keep_all(text, samples%channels(found))
         call read_values(text, headers(i), samples%channels(found), error)
         if (allocated(error)) return
      end do
   end subroutine read_cosmos

   !> Is a line the end of a record?
   pure function is_end(line)
      !> The line
      character(len=*), intent(in) :: line
      !> It says so
      logical :: is_end

      is_end = index(lower(line), 'end-of-data') == 1 .or. index(line, '/&') == 1
   end function is_end

   !> Find the quantity of a record in words
   subroutine find_quantity(text, header, quantity)
      type(text_file_type), intent(in) :: text
      !> Header of the record
      type(cosmos_header_type), intent(in) :: header
      !> What stands between count and `pts`
      character(len=:), allocatable, intent(out) :: quantity

      quantity = before(text%line(header%value_line), 'pts')
      quantity = lower(after(quantity, first_word(quantity, ' ')))
   end subroutine find_quantity

   !> Are the values of a record accelerations? Both words and code must say so, where they say anything.
   function is_acceleration(text, header)
      type(text_file_type), intent(in) :: text
      !> Header of the record
      type(cosmos_header_type), intent(in) :: header
      !> They are
      logical :: is_acceleration

      character(len=:), allocatable :: quantity
      integer :: code
      logical :: known

      call header%integers%integer_of(text, quantity_at, code, known)
      call find_quantity(text, header, quantity)
      is_acceleration = index(quantity, 'accel') > 0 .and. &
         & (.not. known .or. code == acceleration_code)
   end function is_acceleration

   !> Read the values of a record
   subroutine read_values(text, header, channel, error)
      type(text_file_type), intent(in) :: text
      !> Header of the record
      type(cosmos_header_type), intent(in) :: header
      type(channel_type), intent(inout) :: channel
      !> What is wrong, with file and line
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: line, format
      integer :: count, width, per_line, next
      real(wp) :: multiple, mean
      logical :: ok, raw

      line = text%line(header%value_line)
      call parse_integer(first_word(line, ' '), count, ok)
      if (.not. (ok .and. count > 0)) then
         call raise_at(error, text, header%value_line, ''''//squeezed(line)//''': must begin with the number of values')
         return
      end if
      format = after(after(line, 'format'), '=')
      call parse_format(format, width, per_line, ok)
      if (.not. ok) then
         call raise_at(error, text, header%value_line, 'format '''//format// &
            & ''': must be a Fortran format such as (8F10.5)')
         return
      end if
      call read_units(text, header, channel%units, multiple, raw, error)
      if (allocated(error)) return
      call read_fixed(text, block_type(header%value_line + 1, count, width, per_line), channel%values, error, next, &
         & channel%metadata)
      if (allocated(error)) return
      if (next > header%last_of_record .or. .not. is_end(text%line(next))) then
         call raise_at(error, text, next, 'after the '//to_text(count)// &
            & ' values that the header states: must be End-of-data')
         return
      end if
      call read_step(text, header, count, channel%dt, error)
      if (allocated(error)) return
      if (raw) then
         mean = sum(channel%values)/real(count, wp)
         channel%values = channel%values - mean
         call channel%metadata%set('processing', channel%metadata%get('processing')//'; mean of '// &
            & to_text(anint(mean))//' counts removed')
      else
         call check_not_missing(text, header%value_line + 1, per_line, channel%values, header%reals%missing, error)
         channel%peak = header%reals%field(text, peak_at)
         channel%peak_line = header%reals%line_of(peak_at)
      end if
      channel%values = multiple*channel%values
      ! The header's peak is in the units of the file: it can be looked at only where these need no multiple
      if (multiple < 1.0_wp .or. multiple > 1.0_wp) channel%peak = ''
   end subroutine read_values

   !> Read the units of a record
   subroutine read_units(text, header, units, multiple, raw, error)
      type(text_file_type), intent(in) :: text
      !> Header of the record
      type(cosmos_header_type), intent(in) :: header
      !> Units that the library knows
      character(len=:), allocatable, intent(out) :: units
      !> How many of those the unit of the file is
      real(wp), intent(out) :: multiple
      !> The values are counts of the recorder
      logical, intent(out) :: raw
      !> They are not known, or code and words differ
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: words, code_in_words
      integer :: code, other, i
      real(wp) :: factor, other_factor
      logical :: known, other_known
      type(error_type), allocatable :: unknown

      multiple = 1.0_wp
      raw = .false.
      words = before(after(text%line(header%value_line), 'units='), ',')
      code_in_words = leading_number(after(words, '('))
      words = before(words, '(')
      units = words
      call header%integers%integer_of(text, units_at, code, known)
      call parse_integer(code_in_words, other, other_known)
      if (known .and. other_known .and. code /= other) then
         call raise_at(error, text, header%value_line, 'units of code '//to_text(other)// &
            & ': the table of integers states code '//to_text(code))
         return
      end if
      if (.not. known) code = other
      raw = code == counts_code
      if (raw) then
         call read_scale(text, header, multiple, error)
         units = 'g'
         return
      end if
      if (.not. (known .or. other_known)) return
      i = findloc(accelerations%code, code, dim=1)
      if (i == 0) then
         call raise_at(error, text, header%value_line, 'units = '''//words//''', code '//to_text(code)// &
            & ': must be units of acceleration, code 2, 4, 7, 10, 11 or 12')
         return
      end if
      units = trim(accelerations(i)%name)
      multiple = accelerations(i)%multiple
      call unit_factor(words, other_factor, unknown)
      if (allocated(unknown)) return
      call unit_factor(units, factor, error)
      if (allocated(error)) return
      if (abs(other_factor - multiple*factor) <= epsilon(1.0_wp)*other_factor) return
      call raise_at(error, text, header%value_line, 'units = '''//words//''': their code '//to_text(code)// &
         & ' stands for other units')
   end subroutine read_units

   !> Read how many g a count of the recorder is
   subroutine read_scale(text, header, scale, error)
      type(text_file_type), intent(in) :: text
      !> Header of the record
      type(cosmos_header_type), intent(in) :: header
      !> Least bit over sensitivity and gain [g]
      real(wp), intent(out) :: scale
      !> One of them is not known
      type(error_type), allocatable, intent(out) :: error

      !> Volts in a microvolt
      real(wp), parameter :: micro = 1.0e-6_wp
      real(wp) :: bit, sensitivity, gain
      logical :: ok(3)

      scale = 1.0_wp
      call parse_real(header%reals%field(text, bit_at), bit, ok(1))
      call parse_real(header%reals%field(text, sensitivity_at), sensitivity, ok(2))
      call parse_real(header%reals%field(text, gain_at), gain, ok(3))
      if (.not. ok(3)) gain = 1.0_wp
      if (all(ok(:2)) .and. bit > 0.0_wp .and. abs(sensitivity) > 0.0_wp .and. gain > 0.0_wp) then
         scale = micro*bit/(sensitivity*gain)
         return
      end if
      call raise_at(error, text, header%value_line, 'units are counts: the table of reals must state the least bit '// &
         & 'of the recorder (number 22), the sensitivity of the sensor (42) and a positive gain (47)')
   end subroutine read_scale

   !> Read the time step of a record
   subroutine read_step(text, header, count, dt, error)
      type(text_file_type), intent(in) :: text
      !> Header of the record
      type(cosmos_header_type), intent(in) :: header
      !> Number of values
      integer, intent(in) :: count
      !> Time step [s]
      real(wp), intent(out) :: dt
      !> It is not known, or does not fit count and length
      type(error_type), allocatable, intent(out) :: error

      !> Milliseconds in a second
      real(wp), parameter :: milli = 1000.0_wp
      real(wp) :: length
      integer :: stage
      logical :: ok, raw

      call parse_real(header%reals%field(text, step_at), dt, ok)
      dt = dt/milli
      if (.not. ok) then
         ! The step of the raw record is that of the values only if these are raw
         call header%integers%integer_of(text, stage_at, stage, raw)
         if (raw .and. stage == 0) call parse_real(header%reals%field(text, raw_step_at), dt, ok)
      end if
      if (.not. (ok .and. dt > 0.0_wp)) then
         call raise_at(error, text, header%reals%line_of(step_at), 'time step (number 62) = '''// &
            & header%reals%field(text, step_at)//''': must be positive')
         return
      end if
      call parse_real(header%reals%field(text, length_at), length, ok)
      if (.not. ok) return
      if (abs(real(count, wp)*dt - length) <= length_tolerance*length + dt) return
      call raise_at(error, text, header%reals%line_of(length_at), 'length of the record (number 63) = '// &
         & to_text(length)//' s: '//to_text(count)//' values at '//to_text(dt)//' s')
   end subroutine read_step

end module dondolo_records_format_cosmos
