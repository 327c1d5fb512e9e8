!> Headers of a COSMOS file: where their parts are, and what they say of the record.
module dondolo_records_cosmos_header
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_integer, parse_real
   use dondolo_base_text, only : first_word, lower, to_text
   use dondolo_files_text_file, only : text_file_type
   use dondolo_records_dates, only : find_moment
   use dondolo_records_header_fields, only : field_type, header_type
   use dondolo_records_header_text, only : after, before, join_comments, leading_number, line_after_comments, parse_format, &
      & squeezed, table_type
   use dondolo_records_format, only : channel_type, raise_at
   implicit none
   private

   public :: cosmos_header_type, find_headers

   !> Header of a record
   type, extends(header_type) :: cosmos_header_type
      !> Last line of the record
      integer :: last_of_record = 1
      !> Line of the first comment
      integer :: first_comment = 1
      !> Line before the values
      integer :: value_line = 1
   contains
      !> Keep what it says
      procedure :: keep_all
   end type cosmos_header_type

   !> Mark for no value, unless the file names another
   real(wp), parameter :: usual_mark = -999.0_wp

   !> Most numbers in a table: bounds a count that is wrong
   integer, parameter :: most_numbers = 100000

   !> Earthquake and its time. Where a name has no day of the week before the date, it has blanks
   type(field_type), parameter :: times(2) = [ &
      & field_type('event', form='as is', line=2, until='__'), &
      & field_type('event time', 'origin:', 'mdy', line=4)]

   !> Station
   type(field_type), parameter :: stations(3) = [ &
      & field_type('network', 'code:', 'word', line=5, until='-'), &
      & field_type('station', 'code:', 'word', line=5, then='-'), &
      & field_type('station name', line=5, column=41)]

   !> Magnitude, the moment magnitude last, and place of the station
   type(field_type), parameter :: numbers(6) = [ &
      & field_type('magnitude', real_at=16), field_type('magnitude', real_at=15), &
      & field_type('magnitude', real_at=14), field_type('magnitude', real_at=13), &
      & field_type('latitude', real_at=1), field_type('longitude', real_at=2)]

   !> All other fields
   type(field_type), parameter :: others(17) = [ &
      & field_type('processed', 'processed:', line=11, until='max'), &
      & field_type('origin', 'origin:', line=4), &
      & field_type('hypocenter', 'hypocenter:', line=3), &
      & field_type('statn no', 'statn no:', 'word', line=5), &
      & field_type('site geology', 'site geology:', line=6), &
      & field_type('recorder', 'recorder:', line=7, until='sensor:'), field_type('sensor', 'sensor:', line=7), &
      & field_type('rcrd start time', 'time:', line=8, until='rcrdid:'), field_type('rcrdid', 'rcrdid:', line=8), &
      & field_type('location', 'location:', line=9), &
      & field_type('raw record length', '=', line=10), &
      & field_type('elevation', real_at=3), &
      & field_type('event latitude', real_at=10), field_type('event longitude', real_at=11), &
      & field_type('depth', real_at=12), field_type('epicentral distance', real_at=17), &
      & field_type('azimuth', integer_at=54)]

contains

   !> Find the headers of all records
   subroutine find_headers(text, headers, error)
      type(text_file_type), intent(in) :: text
      !> The headers, one at least
      type(cosmos_header_type), allocatable, intent(out) :: headers(:)
      !> A header is not complete
      type(error_type), allocatable, intent(out) :: error

      integer, allocatable :: begins(:)
      integer :: i, line

      begins = pack([(line, line=1, text%lines())], [(is_first(line), line=1, text%lines())])
      if (size(begins) == 0) begins = [1]
      allocate (headers(size(begins)))
      begins = [begins, text%lines() + 1]
      do i = 1, size(headers)
         headers(i)%first_line = begins(i)
         headers(i)%last_of_record = begins(i + 1) - 1
         call find_parts(text, headers(i), error)
         if (allocated(error)) return
      end do

   contains

      !> Does a record begin in a line?
      pure function is_first(line)
         !> Number of the line
         integer, intent(in) :: line
         !> It names the format
         logical :: is_first

         is_first = index(lower(text%line(line)), '(format v') > 0
      end function is_first

   end subroutine find_headers

   !> Find the parts of a header
   subroutine find_parts(text, header, error)
      type(text_file_type), intent(in) :: text
      !> The header, the first and the last line of its record known
      type(cosmos_header_type), intent(inout) :: header
      !> A part is missing or its count wrong
      type(error_type), allocatable, intent(out) :: error

      integer :: lines, comments, line
      real(wp) :: mark
      logical :: ok

      call parse_integer(leading_number(after(text%line(header%first_line), 'with')), lines, ok)
      if (.not. (ok .and. lines > 0 .and. lines <= most_numbers)) then
         call raise_at(error, text, header%first_line, ''''//squeezed(text%line(header%first_line))// &
            & ''': must state the number of text lines')
         return
      end if
      header%last_line = header%first_line + lines - 1
      call find_table(text, header%last_line + 1, 'integer-header', header%integers, error)
      if (allocated(error)) return
      call find_table(text, header%integers%next_line(), 'real-header', header%reals, error)
      if (allocated(error)) return
      line = header%reals%next_line()
      call parse_integer(first_word(text%line(line), ' '), comments, ok)
      if (.not. (ok .and. index(lower(text%line(line)), 'comment') > 0)) then
         call raise_at(error, text, line, ''''//squeezed(text%line(line))//''': must state the number of comments')
         return
      end if
      header%first_comment = line + 1
      header%value_line = line_after_comments(text, line + 1)
      if (comments /= header%value_line - header%first_comment) then
         call raise_at(error, text, line, 'number of comments = '//to_text(comments)//': '// &
            & to_text(header%value_line - header%first_comment)//' lines begin with |')
         return
      end if
      if (index(lower(text%line(header%value_line)), 'pts') == 0) then
         call raise_at(error, text, header%value_line, ''''//squeezed(text%line(header%value_line))// &
            & ''': must state number, units and format of the values')
         return
      end if
      ! The last line of text names the marks for numbers that are not known
      line = header%last_line
      call parse_real(leading_number(after(after(text%line(line), 'unspecified:'), ',')), mark, ok)
      header%reals%missing = merge(mark, usual_mark, ok)
      call parse_real(leading_number(after(text%line(line), 'unspecified:')), mark, ok)
      header%integers%missing = merge(mark, usual_mark, ok)
   end subroutine find_parts

   !> Find a table of numbers
   subroutine find_table(text, line, title, table, error)
      type(text_file_type), intent(in) :: text
      !> Line before the table
      integer, intent(in) :: line
      !> What the line must hold, in lower case
      character(len=*), intent(in) :: title
      type(table_type), intent(out) :: table
      !> The line is another, or states no count and format
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: content
      logical :: ok

      content = text%line(line)
      ok = index(lower(content), title) > 0
      if (ok) call parse_integer(first_word(content, ' '), table%count, ok)
      ok = ok .and. table%count > 0 .and. table%count <= most_numbers
      if (ok) call parse_format(after(after(content, 'format'), '='), table%width, table%per_line, ok)
      table%first_line = line + 1
      if (.not. ok) call raise_at(error, text, min(line, text%lines()), ''''//squeezed(content)//''': must state '// &
         & 'number and format of the '//title//' values')
   end subroutine find_table

   !> Keep what the header says
   subroutine keep_all(self, text, channel)
      class(cosmos_header_type), intent(in) :: self
      type(text_file_type), intent(in) :: text
      !> The channel to keep it with
      type(channel_type), intent(inout) :: channel

      character(len=:), allocatable :: comments, moment, code

      call join_comments(text, self%first_comment, comments)
      associate (metadata => channel%metadata)
         call self%keep(text, times, metadata)
         moment = metadata%get('event time')
         if (len(moment) == 0) call find_start(moment)
         call metadata%set('date', moment)
         call self%keep(text, stations, metadata)
         ! Sta Chan   1: 340 deg (Rcrdr Chan  1) Location:
         channel%name = before(text%line(self%line(9)), '(rcrdr')
         channel%name = squeezed(channel%name(index(channel%name, ':', back=.true.) + 1:))
         ! Station, channel, network and location as a comment writes them: BMR.BNZ.AK.--
         code = first_word(after(comments, '<scnl>'), ' ')
         call metadata%set('station', before(code, '.'))
         code = after(code, '.')
         if (len(before(code, '.')) > 0) channel%name = before(code, '.')
         call metadata%set('network', before(after(code, '.'), '.'))
         call metadata%set('component', channel%name)
         call self%keep(text, numbers, metadata)
         call metadata%set('processing', lower(before(text%line(self%line(1)), '('))//'; '//squeezed(text%line(self%line(12))))
         call self%keep(text, others, metadata)
         call metadata%set('comments', squeezed(comments))
      end associate

   contains

      !> Find the day on which the record begins: by the table of integers, or else in words
      subroutine find_start(moment)
         !> The day; empty if it is not stated
         character(len=:), allocatable, intent(out) :: moment

         integer, parameter :: year = 40, month = 42, day = 43

         associate (integers => self%integers)
            call find_moment(integers%field(text, year)//'/'//integers%field(text, month)//'/'//integers%field(text, day), &
               & 'mdy', moment)
         end associate
         if (len(moment) == 0) call find_moment(after(text%line(self%line(8)), 'time:'), 'mdy', moment)
         moment = moment(:min(10, len(moment)))
      end subroutine find_start

   end subroutine keep_all

end module dondolo_records_cosmos_header
