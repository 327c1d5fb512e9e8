!> Files of the United States Geological Survey in its SMC format: one channel, 11 lines of text, tables of 48 integers
!> and 50 reals, comments that begin with |, then the values.
!>
!> Source of all positions: USGS National Strong-Motion Program, SMC- and BBF-format Data Files (smcfmt.txt).
!> Accelerations are in cm/s2 by definition of the format; the file itself does not name its units.
module dondolo_records_format_smc
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_real
   use dondolo_base_text, only : lower, to_text
   use dondolo_files_text_file, only : text_file_type
   use dondolo_records_dates, only : take_moment
   use dondolo_records_header_fields, only : field_type, header_type
   use dondolo_records_header_text, only : after, check_not_missing, join_comments, line_after_comments, squeezed, table_type
   use dondolo_records_format, only : block_type, channel_type, raise_at, read_fixed, samples_type
   implicit none
   private

   public :: recognises_smc, read_smc

   !> The table of integers
   type(table_type), parameter :: integers = &
      & table_type(first_line=12, per_line=8, width=10, count=48, missing=-32768.0_wp)

   !> The table of reals
   type(table_type), parameter :: reals = &
      & table_type(first_line=18, per_line=5, width=15, count=50, missing=1.7e38_wp)

   !> Line of the first comment
   integer, parameter :: first_comment = 28

   !> What the first line may say after its digit
   character(len=*), parameter :: titles(7) = [character(len=24) :: 'unknown', 'uncorrected accelerogram', &
      & 'corrected accelerogram', 'velocity', 'displacement', 'response spectra', 'fourier']

   !> Positions among the integers: comments, values, digits of the values
   integer, parameter :: comments_at = 16, count_at = 17, digits_at = 47

   !> Positions among the reals: values per second, largest and smallest value
   integer, parameter :: rate_at = 2, largest_at = 30, smallest_at = 32

   !> What the header says after the earthquake. Magnitudes: another, local, of surface waves, moment magnitude
   type(field_type), parameter :: fields(22) = [ &
      & field_type('station', form='stated', line=3), &
      & field_type('station name', 'station =', line=6, until='component'), &
      & field_type('network', 'data source =', 'as is', line=8), &
      & field_type('component', 'component=', 'as is', line=6), &
      & field_type('magnitude', form='plain', real_at=9), field_type('magnitude', form='plain', real_at=8), &
      & field_type('magnitude', form='plain', real_at=7), field_type('magnitude', form='plain', real_at=6), &
      & field_type('latitude', form='plain', real_at=11), field_type('longitude', form='plain', real_at=12), &
      & field_type('processing', form='lower', line=1, column=2), &
      & field_type('magnitudes', form='stated', line=5), &
      & field_type('event latitude', form='plain', real_at=3), field_type('event longitude', form='plain', real_at=4), &
      & field_type('depth', form='plain', real_at=5), &
      & field_type('epicentral dist', form='plain', real_at=17), &
      & field_type('inst type', 'inst type=', line=8, until='data source'), &
      & field_type('azimuth', integer_at=14), field_type('inclination', integer_at=13), &
      & field_type('line 9', form='stated', line=9), field_type('line 10', form='stated', line=10), &
      & field_type('line 11', form='stated', line=11)]

   !> Digits of values that are written wide (D. M. Boore, SMCWrite: 5ES14.7, otherwise 8ES10.4)
   integer, parameter :: many_digits = 8

contains

   !> Is a text in this format? The first line is a digit and one of the titles
   logical function recognises_smc(text) result(recognised)
      type(text_file_type), intent(in) :: text

      character(len=:), allocatable :: line
      integer :: i

      line = lower(trim(text%line(1)))
      recognised = .false.
      if (len(line) < 3) return
      recognised = verify(line(1:1), '0123456789') == 0 .and. line(2:2) == ' ' .and. &
         & any([(index(line(3:), trim(titles(i))) == 1, i=1, size(titles))])
   end function recognises_smc

   !> Read an SMC file
   subroutine read_smc(text, samples, error)
      type(text_file_type), intent(in) :: text
      !> What it says
      type(samples_type), intent(out) :: samples
      !> What is wrong, with file and line
      type(error_type), allocatable, intent(out) :: error

      integer :: first_line, count, digits, width, per_line, next
      real(wp) :: rate
      logical :: ok

      if (index(lower(text%line(1)), 'corrected accelerogram') == 0) then
         call raise_at(error, text, 1, ''''//squeezed(text%line(1))//''': must be an ACCELEROGRAM')
         return
      end if
      call find_values(text, first_line, error)
      if (allocated(error)) return
      call integers%integer_of(text, count_at, count, ok)
      if (.not. (ok .and. count > 0)) then
         call raise_at(error, text, integers%line_of(count_at), 'number of values = '''// &
            & integers%field(text, count_at)//''': must be a positive integer')
         return
      end if
      call parse_real(reals%field(text, rate_at), rate, ok)
      if (.not. (ok .and. rate > 0.0_wp)) then
         call raise_at(error, text, reals%line_of(rate_at), 'values per second = '''//reals%field(text, rate_at)// &
            & ''': the samples are unevenly spaced, pairs of time and value; they must be evenly spaced')
         return
      end if
      call integers%integer_of(text, digits_at, digits, ok)
      width = merge(14, 10, ok .and. digits == many_digits)
      per_line = merge(5, 8, ok .and. digits == many_digits)
      allocate (samples%channels(1))
      associate (channel => samples%channels(1))
         call read_fixed(text, block_type(first_line, count, width, per_line), channel%values, error, next, samples%metadata)
         if (allocated(error)) return
         call check_not_missing(text, first_line, per_line, channel%values, reals%missing, error)
         if (allocated(error)) return
         if (text%lines() >= next) then
            call raise_at(error, text, next, 'text after the '//to_text(count)// &
               & ' values that the header states')
            return
         end if
         channel%dt = 1.0_wp/rate
         channel%units = 'cm/s2'
         channel%name = after(text%line(6), 'component=')
         call find_peak(text, channel)
      end associate
      call read_header(text, samples)
   end subroutine read_smc

   !> Find the first value, after as many comments as the header states
   subroutine find_values(text, line, error)
      type(text_file_type), intent(in) :: text
      !> Line of the first value
      integer, intent(out) :: line
      !> The number of comments is not known or another
      type(error_type), allocatable, intent(out) :: error

      integer :: count
      logical :: ok

      line = line_after_comments(text, first_comment)
      call integers%integer_of(text, comments_at, count, ok)
      if (ok .and. count == line - first_comment) return
      call raise_at(error, text, integers%line_of(comments_at), 'number of comments = '''// &
         & integers%field(text, comments_at)//''': '//to_text(line - first_comment)//' lines begin with |')
   end subroutine find_values

   !> The largest value, of either sign
   subroutine find_peak(text, channel)
      type(text_file_type), intent(in) :: text
      type(channel_type), intent(inout) :: channel

      real(wp) :: largest, smallest
      logical :: ok, both
      integer :: at

      call parse_real(reals%field(text, largest_at), largest, ok)
      call parse_real(reals%field(text, smallest_at), smallest, both)
      if (.not. (ok .and. both)) return
      at = merge(largest_at, smallest_at, abs(largest) >= abs(smallest))
      channel%peak = reals%field(text, at)
      channel%peak_line = reals%line_of(at)
   end subroutine find_peak

   !> Keep what the header says
   subroutine read_header(text, samples)
      type(text_file_type), intent(in) :: text
      !> What it says
      type(samples_type), intent(inout) :: samples

      type(header_type) :: header
      character(len=:), allocatable :: line, date
      integer :: i, at

      header = header_type(last_line=integers%first_line - 1, integers=integers, reals=reals)
      associate (metadata => samples%metadata)
         ! Year, month, day, time, and the name of the earthquake
         line = squeezed(text%line(4))
         at = 1
         call take_moment(line, 'mdy', at, date)
         call metadata%set('event time', date)
         i = at - 1 + verify(line(at:)//'x', ' 0123456789:.')
         call metadata%set('event', line(i:))
         if (len(date) == 0) date = line(:i - 1)
         call metadata%set('date', date)
         call header%keep(text, fields, metadata)
         call join_comments(text, first_comment, line)
         call metadata%set('comments', squeezed(line))
      end associate
   end subroutine read_header

end module dondolo_records_format_smc
