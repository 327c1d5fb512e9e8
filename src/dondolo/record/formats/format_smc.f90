!> Files of the United States Geological Survey in its SMC format: one channel, 11 lines of text, tables of 48 integers
!> and 50 reals, comments that begin with |, then the values.
!>
!> Source of all positions: USGS National Strong-Motion Program, SMC- and BBF-format Data Files (smcfmt.txt).
!> Accelerations are in cm/s2 by definition of the format; the file itself does not name its units.
module dondolo_record_format_smc
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_real
   use dondolo_base_text, only : lower, to_text
   use dondolo_base_text_file, only : text_file_type
   use dondolo_record_dates, only : take_moment
   use dondolo_record_format, only : after_block_type, channel_type, raise_at, read_fixed, samples_type
   use dondolo_record_header_text, only : after, before, check_not_missing, squeezed, table_type
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

      type(after_block_type) :: rest
      integer :: first_line, count, digits, width, per_line
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
         call read_fixed(text, first_line, count, width, per_line, channel%values, error, rest)
         if (allocated(error)) return
         call samples%metadata%append('reading', rest%note)
         call check_not_missing(text, first_line, per_line, channel%values, reals%missing, error)
         if (allocated(error)) return
         if (text%lines() >= rest%line) then
            call raise_at(error, text, rest%line, 'text after the '//to_text(count)// &
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

      line = first_comment
      do while (index(adjustl(text%line(line)), '|') == 1)
         line = line + 1
      end do
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

      character(len=:), allocatable :: line, date
      integer :: i, at

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
         call metadata%set('station', stated(text%line(3)))
         call metadata%set('station name', squeezed(before(after(text%line(6), 'station ='), 'component')))
         call metadata%set('network', after(text%line(8), 'data source ='))
         call metadata%set('component', samples%channels(1)%name)
         ! Moment magnitude, surface wave, local, other
         do i = 9, 6, -1
            call metadata%set('magnitude', plain(reals%field(text, i)))
         end do
         call metadata%set('latitude', plain(reals%field(text, 11)))
         call metadata%set('longitude', plain(reals%field(text, 12)))
         line = text%line(1)
         call metadata%set('processing', lower(squeezed(line(2:))))
         call metadata%set('magnitudes', stated(text%line(5)))
         call metadata%set('event latitude', plain(reals%field(text, 3)))
         call metadata%set('event longitude', plain(reals%field(text, 4)))
         call metadata%set('depth', plain(reals%field(text, 5)))
         call metadata%set('epicentral dist', plain(reals%field(text, 17)))
         call metadata%set('inst type', squeezed(before(after(text%line(8), 'inst type='), 'data source')))
         call metadata%set('azimuth', integers%field(text, 14))
         call metadata%set('inclination', integers%field(text, 13))
         do i = 9, 11
            call metadata%set('line '//to_text(i), stated(text%line(i)))
         end do
         line = ''
         i = first_comment
         do while (index(adjustl(text%line(i)), '|') == 1)
            line = line//' '//after(text%line(i), '|')
            i = i + 1
         end do
         call metadata%set('comments', squeezed(line))
      end associate
   end subroutine read_header

   !> A number without exponent
   pure function plain(printed)
      !> The number as the table of reals has it: 0.7100000E+01; empty if it is not known
      character(len=*), intent(in) :: printed
      !> The same as people write it: 7.1, filled up with blanks
      character(len=48) :: plain

      real(wp) :: value
      logical :: ok

      plain = ''
      call parse_real(printed, value, ok)
      if (ok) plain = to_text(value)
   end function plain

   !> A line of the header, where * says nothing
   pure function stated(line)
      !> The line
      character(len=*), intent(in) :: line
      !> Its text, filled up with blanks; empty if it says nothing
      character(len=len(line)) :: stated

      stated = squeezed(line)
      if (stated == '*') stated = ''
   end function stated

end module dondolo_record_format_smc
