!> Headers of a COSMOS file: where their parts are, and what they say of the record.
module dondolo_record_cosmos_header
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_integer, parse_real
   use dondolo_base_text, only : first_word, lower, to_text
   use dondolo_base_text_file, only : text_file_type
   use dondolo_record_dates, only : find_moment
   use dondolo_record_format, only : channel_type, raise_at
   use dondolo_record_header_text, only : after, before, leading_number, parse_format, squeezed, table_type
   implicit none
   private

   public :: cosmos_header_type, find_headers

   !> Header of a record
   type :: cosmos_header_type
      !> First line of the record
      integer :: first_line = 1
      !> Last line of the record
      integer :: last_line = 1
      !> Last line of text
      integer :: last_text = 1
      !> Table of integers
      type(table_type) :: integers
      !> Table of reals
      type(table_type) :: reals
      !> Line of the first comment
      integer :: first_comment = 1
      !> Line before the values
      integer :: value_line = 1
   contains
      !> Keep what the header says
      procedure :: keep
   end type cosmos_header_type

   !> Mark for no value, unless the file names another
   real(wp), parameter :: usual_mark = -999.0_wp

   !> Most numbers in a table: bounds a count that is wrong
   integer, parameter :: most_numbers = 100000

   !> Column of the name in the line of the station
   integer, parameter :: name_column = 41

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
         headers(i)%last_line = begins(i + 1) - 1
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
      !> The header, its first and last line known
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
      header%last_text = header%first_line + lines - 1
      call find_table(text, header%last_text + 1, 'integer-header', header%integers, error)
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
      header%value_line = line + 1
      do while (index(adjustl(text%line(header%value_line)), '|') == 1)
         header%value_line = header%value_line + 1
      end do
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
      line = header%last_text
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
   subroutine keep(self, text, channel)
      class(cosmos_header_type), intent(in) :: self
      type(text_file_type), intent(in) :: text
      !> The channel to keep it with
      type(channel_type), intent(inout) :: channel

      character(len=:), allocatable :: line, comments, moment, code
      integer :: i

      comments = ''
      do i = self%first_comment, self%value_line - 1
         comments = comments//' '//after(text%line(i), '|')
      end do
      associate (metadata => channel%metadata, reals => self%reals, integers => self%integers)
         ! Where a name has no day of the week before the date, it has blanks
         call metadata%set('event', before(adjustl(text%line(at(2))), '  '))
         call find_moment(after(text%line(at(4)), 'origin:'), 'mdy', moment)
         call metadata%set('event time', moment)
         if (len(moment) == 0) call find_start(moment)
         call metadata%set('date', moment)
         line = text%line(at(5))
         code = first_word(after(line, 'code:'), ' ')
         call metadata%set('network', before(code, '-'))
         call metadata%set('station', after(code, '-'))
         call metadata%set('station name', squeezed(line(min(name_column, len(line) + 1):)))
         ! Sta Chan   1: 340 deg (Rcrdr Chan  1) Location:
         channel%name = before(text%line(at(9)), '(rcrdr')
         channel%name = squeezed(channel%name(index(channel%name, ':', back=.true.) + 1:))
         call keep_code(after(comments, '<scnl>'))
         call metadata%set('component', channel%name)
         ! Other magnitude, local, surface wave, moment: the last one stays
         do i = 16, 13, -1
            call metadata%set('magnitude', reals%field(text, i))
         end do
         call metadata%set('latitude', reals%field(text, 1))
         call metadata%set('longitude', reals%field(text, 2))
         call metadata%set('processing', lower(before(text%line(at(1)), '('))//'; '//squeezed(text%line(at(12))))
         call metadata%set('processed', squeezed(before(after(text%line(at(11)), 'processed:'), 'max')))
         call metadata%set('origin', squeezed(after(text%line(at(4)), 'origin:')))
         call metadata%set('hypocenter', squeezed(after(text%line(at(3)), 'hypocenter:')))
         call metadata%set('statn no', first_word(after(line, 'statn no:'), ' '))
         call metadata%set('site geology', squeezed(after(text%line(at(6)), 'site geology:')))
         call metadata%set('recorder', squeezed(before(after(text%line(at(7)), 'recorder:'), 'sensor:')))
         call metadata%set('sensor', squeezed(after(text%line(at(7)), 'sensor:')))
         call metadata%set('rcrd start time', squeezed(before(after(text%line(at(8)), 'time:'), 'rcrdid:')))
         call metadata%set('rcrdid', squeezed(after(text%line(at(8)), 'rcrdid:')))
         call metadata%set('location', squeezed(after(text%line(at(9)), 'location:')))
         call metadata%set('raw record length', squeezed(after(text%line(at(10)), '=')))
         call metadata%set('elevation', reals%field(text, 3))
         call metadata%set('event latitude', reals%field(text, 10))
         call metadata%set('event longitude', reals%field(text, 11))
         call metadata%set('depth', reals%field(text, 12))
         call metadata%set('epicentral distance', reals%field(text, 17))
         call metadata%set('azimuth', integers%field(text, 54))
         call metadata%set('comments', squeezed(comments))
      end associate

   contains

      !> Where a line of the header's text is, 0 if there are fewer
      pure integer function at(number)
         !> Its number, from 1
         integer, intent(in) :: number

         at = self%first_line + number - 1
         if (at > self%last_text) at = 0
      end function at

      !> Find the day on which the record begins: by the table of integers, or else in words
      subroutine find_start(moment)
         !> The day; empty if it is not stated
         character(len=:), allocatable, intent(out) :: moment

         integer, parameter :: year = 40, month = 42, day = 43

         associate (integers => self%integers)
            call find_moment(integers%field(text, year)//'/'//integers%field(text, month)//'/'//integers%field(text, day), &
               & 'mdy', moment)
         end associate
         if (len(moment) == 0) call find_moment(after(text%line(at(8)), 'time:'), 'mdy', moment)
         moment = moment(:min(10, len(moment)))
      end subroutine find_start

      !> Keep station, channel, network and location as a comment writes them: BMR.BNZ.AK.--
      subroutine keep_code(code)
         !> The comment
         character(len=*), intent(in) :: code

         character(len=:), allocatable :: rest

         if (len(code) == 0) return
         rest = first_word(code, ' ')
         call channel%metadata%set('station', before(rest, '.'))
         rest = after(rest, '.')
         if (len(before(rest, '.')) > 0) channel%name = before(rest, '.')
         call channel%metadata%set('network', before(after(rest, '.'), '.'))
      end subroutine keep_code

   end subroutine keep

end module dondolo_record_cosmos_header
