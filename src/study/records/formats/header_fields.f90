!> Headers of archives as tables: a row says where a field is, how it is written, and under which key it is kept.
!>
!> A header is lines `key: value`, lines of text in which labels lead to fields, tables of numbers, or all of these. One procedure
!> reads the rows of all formats, in their order. A field that is not stated leaves what an earlier row of its key found, so that of
!> several rows of one key the last one stated holds.
module dondolo_records_header_fields
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_real
   use dondolo_base_text, only : blanks, first_word, lower, replaced, to_text
   use dondolo_files_text_file, only : text_file_type
   use dondolo_record_metadata, only : metadata_type
   use dondolo_records_dates, only : find_moment
   use dondolo_records_header_text, only : after, before, leading_number, squeezed, table_type
   use dondolo_records_labels, only : labels_type
   implicit none
   private

   public :: field_type, header_type

   !> A row: a field of a header
   type :: field_type
      !> Key of the metadata; a date of the earthquake is its time too
      character(len=20) :: key = ''
      !> The key of a line `key: value`, or a text in lower case that leads to the field
      character(len=32) :: label = ''
      !> How it is written: 'word' ends with a blank; 'as is' may hold several blanks in a row; 'lower' is kept in lower case;
      !> 'number' begins with a number; 'plain' is a number that is kept without its exponent; 'nonzero' is none if it is zero;
      !> 'stated' is none if it is an asterisk; 'NS' and 'EW' are coordinates with these letters; 'dmy' and 'mdy' are dates, in
      !> this order; empty: in any way, with one blank in place of several where it is in a line of text
      character(len=7) :: form = ''
      !> Line of the header, from 1; 0: the first with something after the label
      integer :: line = 0
      !> Column in which it begins, if no label does
      integer :: column = 1
      !> Position in the table of integers, or in that of reals
      integer :: integer_at = 0, real_at = 0
      !> Text between the label and the field, in lower case, with _ for a blank
      character(len=8) :: then = ''
      !> What ends it, with _ for a blank; empty: the line
      character(len=12) :: until = ''
      !> What is kept before it, stated or not
      character(len=20) :: lead = ''
      !> Key of the line that has the time of a date
      character(len=24) :: clock = ''
      !> Zone of that time
      character(len=6) :: zone = ''
   end type field_type

   !> A header; the parts that a format does not have are left out
   type :: header_type
      !> First and last line of its text
      integer :: first_line = 1, last_line = 0
      !> Lines `key: value`
      type(labels_type) :: labels
      !> Keys and values where upper and lower case are the same, and the last of a key holds
      type(metadata_type) :: entries
      !> Tables of numbers
      type(table_type) :: integers, reals
   contains
      !> Keep fields as metadata
      procedure :: keep
      !> Where a line of the text is
      procedure :: line => line_of_text
      !> Find a field as it is written
      procedure :: find
   end type header_type

contains

   !> Keep the fields of a table, in its order
   subroutine keep(self, text, fields, metadata)
      class(header_type), intent(in) :: self
      type(text_file_type), intent(in) :: text
      !> The table
      type(field_type), intent(in) :: fields(:)
      !> Where to keep them
      type(metadata_type), intent(inout) :: metadata

      character(len=:), allocatable :: value
      integer :: i

      do i = 1, size(fields)
         call self%find(text, fields(i), value)
         call read_form(fields(i), value)
         if (fields(i)%lead /= '') value = trim(fields(i)%lead)//' '//value
         call metadata%set(trim(fields(i)%key), value)
         if (fields(i)%key == 'date') call metadata%set('event time', value)
      end do
   end subroutine keep

   !> Find a field as it is written
   pure subroutine find(self, text, field, value)
      class(header_type), intent(in) :: self
      type(text_file_type), intent(in) :: text
      type(field_type), intent(in) :: field
      !> Empty if it is not stated
      character(len=:), allocatable, intent(out) :: value

      logical :: is_words
      integer :: i

      value = ''
      is_words = .false.
      if (field%integer_at > 0) then
         value = self%integers%field(text, field%integer_at)
      else if (field%real_at > 0) then
         value = self%reals%field(text, field%real_at)
      else if (self%entries%count() > 0) then
         value = self%entries%get(trim(field%label))
      else if (allocated(self%labels%labels)) then
         value = self%labels%value_of(trim(field%label))
         if (field%clock /= '') value = value//' '//self%labels%value_of(trim(field%clock))
      else if (field%line > 0) then
         is_words = .true.
         value = text%line(self%line(field%line))
         value = adjustl(value(min(field%column, len(value) + 1):))
         if (field%label /= '') value = after(value, trim(field%label))
      else
         is_words = .true.
         do i = self%first_line, self%last_line
            if (len(value) == 0) value = after(squeezed(text%line(i)), trim(field%label))
         end do
      end if
      if (field%form == 'word') value = first_word(value, ' ')
      if (field%then /= '') value = after(value, replaced(trim(field%then), '_', ' '))
      if (field%until /= '') value = before(value, replaced(trim(field%until), '_', ' '))
      if (is_words .and. field%form /= 'as is') value = squeezed(value)
   end subroutine find

   !> Where a line of the text is, 0 if there are fewer
   pure integer function line_of_text(self, number) result(line)
      class(header_type), intent(in) :: self
      !> Its number, from 1
      integer, intent(in) :: number

      line = self%first_line + number - 1
      if (line > self%last_line) line = 0
   end function line_of_text

   !> Read a field in its form
   pure subroutine read_form(field, value)
      type(field_type), intent(in) :: field
      !> As it is written, then as it is kept; empty if it says nothing
      character(len=:), allocatable, intent(inout) :: value

      character(len=:), allocatable :: moment
      real(wp) :: number
      logical :: ok

      select case (field%form)
      case ('lower')
         value = lower(value)
      case ('number')
         value = leading_number(value)
      case ('plain')
         call parse_real(value, number, ok)
         if (ok) value = to_text(number)
      case ('nonzero')
         if (verify(value, '0.') == 0) value = ''
      case ('stated')
         if (value == '*') value = ''
      case ('NS', 'EW')
         value = trim(signed(value, field%form(1:1), field%form(2:2)))
      case ('dmy', 'mdy')
         call find_moment(value//trim(field%zone), field%form(:3), moment)
         value = moment
      end select
   end subroutine read_form

   !> A coordinate with its sign: `38.10000N`
   pure function signed(stated, positive, negative) result(degrees)
      character(len=*), intent(in) :: stated
      !> Letters of the two sides
      character(len=1), intent(in) :: positive, negative
      !> The coordinate, filled up with blanks; empty if it is not written so
      character(len=len(stated) + 1) :: degrees

      character(len=:), allocatable :: number
      integer :: side

      degrees = ''
      number = leading_number(stated)
      side = max(verify(stated, blanks), 1) + len(number)
      if (len(number) == 0 .or. side > len(stated)) return
      if (stated(side:side) == positive) degrees = number
      if (stated(side:side) == negative) degrees = '-'//number
   end function signed

end module dondolo_records_header_fields
