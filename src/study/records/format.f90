!> What a file of accelerograms says, and how the readers of formats read its blocks of numbers.
module dondolo_records_format
   use dondolo_base_error, only : error_type, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_printed, parse_real, take_real
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : blanks, brief, first_word, to_text
   use dondolo_files_text_file, only : is_blank, text_file_type
   use dondolo_record_metadata, only : metadata_type
   use dondolo_records_last_number, only : find_cut
   implicit none
   private

   public :: samples_type, channel_type, block_type, given_type, most_extra, step_tolerance
   public :: read_block, read_fixed, raise_at, check_duration, name_listed, note_extra

   !> Samples beyond those that a file states which are ignored: some programs count steps, or write both ends
   integer, parameter :: most_extra = 2

   !> Relative difference allowed between two time steps of a file, or between its own and one that is given
   real(wp), parameter :: step_tolerance = 0.01_wp

   !> One channel of a file, before units are converted
   type :: channel_type
      !> Name: the component as the file writes it, not allocated or empty if it does not say
      character(len=:), allocatable :: name
      !> Accelerations, in the file's units
      real(wp), allocatable :: values(:)
      !> Time step [s], 0 if the file does not state it
      real(wp) :: dt = 0.0_wp
      !> By how much it may be off where it follows from the print of times; 0 where the file states it [s]
      real(wp) :: dt_doubt = 0.0_wp
      !> Units, not allocated or empty if the file does not state them
      character(len=:), allocatable :: units
      !> The number that the file gives as largest value, of either sign, as it is printed; not allocated or empty
      !> if it gives none
      character(len=:), allocatable :: peak
      !> Units of that number, not allocated or empty if they are those of the values
      character(len=:), allocatable :: peak_units
      !> Line of that number
      integer :: peak_line = 1
      !> Why the values are no accelerations, with file and line; not allocated if they may be
      character(len=:), allocatable :: refusal
      !> What the file says of this channel alone
      type(metadata_type) :: metadata
   end type channel_type

   !> Numbers in columns of equal width
   type :: block_type
      !> Line of the first one; the last is (count - 1)/per_line lines later
      integer :: first_line = 1
      !> How many there are
      integer :: count = 0
      !> Characters of a column
      integer :: width = 1
      !> Columns of a line
      integer :: per_line = 1
   end type block_type

   !> What the caller, or the row of a catalogue, says of a file
   type :: given_type
      !> Time step [s]; not allocated: the file states it
      real(wp), allocatable :: dt
      !> Units, and what plain columns are (dondolo_records_column_layout); empty: not given
      character(len=:), allocatable :: units, columns
   end type given_type

   !> What a file says
   type :: samples_type
      !> Its channels, one at least
      type(channel_type), allocatable :: channels(:)
      !> What its header says of all channels
      type(metadata_type) :: metadata
   end type samples_type

contains

   !> Read numbers separated by blanks, tabs and line ends, from a line to the end of the file; where they touch, they must
   !> stand in columns of equal width
   subroutine read_block(text, first_line, count, values, error, metadata)
      type(text_file_type), intent(in) :: text
      !> Line of the first number
      integer, intent(in) :: first_line
      !> How many there must be; up to `most_extra` more are ignored
      integer, intent(in) :: count
      !> The numbers
      real(wp), allocatable, intent(out) :: values(:)
      !> A text that is no number, another count, or a last number that is cut off
      type(error_type), allocatable, intent(out) :: error
      !> What to report of numbers beyond those that are stated is kept there
      type(metadata_type), intent(inout) :: metadata

      integer :: line, at, first, finish, last, found, width, per_line
      real(wp) :: value
      logical :: ok

      ! A header may state any count; the text bounds how many numbers there can be
      allocate (values(max(0, min(count, len(text%text)))))
      found = 0
      do line = first_line, text%lines()
         at = text%first(line)
         last = text%last(line)
         do
            call text%skip_blanks(at, last)
            if (at > last) exit
            found = found + 1
            first = at
            call take_real(text%text, at, last, value, ok)
            if (ok .and. at <= last) ok = is_blank(text%text(at:at))
            if (.not. ok) then
               call text%next_word((first), last, first, finish)
               call parse_printed(text%text(first:finish), value, ok)
               at = finish + 1
            end if
            if (.not. ok) then
               call find_columns(text, first_line, count, width, per_line)
               if (width > 0) then
                  call read_fixed(text, block_type(first_line, count, width, per_line), values, error)
                  return
               end if
               call raise_at(error, text, line, 'value '//to_text(found)//' = '''// &
                  & shown(text%text(first:finish))//''': must be a number')
               return
            end if
            if (found <= count) then
               values(found) = value
            else if (found > count + most_extra) then
               call raise_at(error, text, line, 'more values than the '//to_text(count)//' that the header states')
               return
            end if
         end do
      end do
      if (found < count) then
         call raise_at(error, text, text%lines(), 'the file ends after '//to_text(found)//' values: the header states '// &
            & to_text(count))
         return
      end if
      call note_extra(found - count, count, metadata)
      if (found == count) call check_whole(text, first_line, 0, error)
   end subroutine read_block

   !> Find the columns of a block in which numbers touch: lines of equal length, of which all but the last are full
   pure subroutine find_columns(text, first_line, count, width, per_line)
      type(text_file_type), intent(in) :: text
      !> Line of the first number; the block ends the file
      integer, intent(in) :: first_line
      !> How many numbers there must be
      integer, intent(in) :: count
      !> Characters of a column, 0 if there are no such columns
      integer, intent(out) :: width
      !> Columns of a line
      integer, intent(out) :: per_line

      integer :: line, rows, length

      width = 0
      rows = text%lines() - first_line + 1
      length = len_trim(text%line(first_line))
      do line = first_line + 1, text%lines() - 1
         if (len_trim(text%line(line)) /= length) return
      end do
      ! The numbers of a line follow from those of all lines
      do per_line = max(1, count/rows), length
         if ((count - 1)/per_line + 1 /= rows) cycle
         if (modulo(length, per_line) > 0) cycle
         width = length/per_line
         if (are_numbers(text%line(first_line), width)) return
      end do
      width = 0
   end subroutine find_columns

   !> Are all columns of a line numbers?
   pure logical function are_numbers(line, width) result(are)
      !> The line
      character(len=*), intent(in) :: line
      !> Characters of a column
      integer, intent(in) :: width

      real(wp) :: value
      integer :: at

      are = .true.
      do at = 1, len_trim(line), width
         if (are) call parse_printed(line(at:min(at + width - 1, len(line))), value, are)
      end do
   end function are_numbers

   !> Read numbers in columns of equal width, where they may touch
   !>
   !> Every line but the last is full; blanks at the end of a line may be missing.
   subroutine read_fixed(text, block, values, error, next, metadata)
      type(text_file_type), intent(in) :: text
      !> Where they must be
      type(block_type), intent(in) :: block
      !> The numbers
      real(wp), allocatable, intent(out) :: values(:)
      !> A text that is no number, text after the last column, a file that ends before, or within its last number
      type(error_type), allocatable, intent(out) :: error
      !> Line after them. Only with it may up to `most_extra` numbers more be there, which are ignored
      integer, intent(out), optional :: next
      !> What to report of those is kept there
      type(metadata_type), intent(inout), optional :: metadata

      integer :: line, at, finish, column, found, extra
      logical :: ok

      associate (first_line => block%first_line, count => block%count, width => block%width, per_line => block%per_line)
         if (present(next)) next = first_line
         ! A header may state any count; the text bounds how many numbers there can be
         allocate (values(max(0, min(count, len(text%text)))))
         found = 0
         at = 0
         do line = first_line, text%lines()
            if (found >= count) exit
            if (present(next)) next = line + 1
            at = text%first(line)
            do column = 1, min(per_line, count - found)
               finish = min(at + width - 1, text%last(line))
               found = found + 1
               if (finish < at) then
                  ok = .false.
               else
                  call parse_printed(text%text(at:finish), values(found), ok)
               end if
               if (.not. ok) then
                  call raise_at(error, text, line, 'value '//to_text(found)//' of '//to_text(count)//' = '''// &
                     & text%text(at:finish)//''': must be a number in column '//to_text(column)//' of width '// &
                     & to_text(width))
                  return
               end if
               at = finish + 1
            end do
            extra = 0
            ok = verify(text%text(at:text%last(line)), blanks) == 0
            if (ok .and. found < count) cycle
            if (present(next) .and. found == count) then
               if (.not. ok) call count_extra(text%text(at:text%last(line)), width, extra)
               ok = ok .or. extra > 0
               ! The next line may begin with them
               if (extra == 0 .and. modulo(count, per_line) == 0 .and. line < text%lines()) then
                  call count_extra(text%line(line + 1), width, extra)
                  if (extra > 0) next = line + 2
               end if
               if (present(metadata)) call note_extra(extra, count, metadata)
            end if
            if (.not. ok) then
               call raise_at(error, text, line, 'text after value '//to_text(found)//' of '//to_text(count)// &
                  & ': '''//shown(text%text(at:text%last(line)))//'''')
            else if (extra == 0 .and. line == text%lines()) then
               call check_whole(text, first_line, width, error)
            end if
            return
         end do
         if (found == count) return
         call raise_at(error, text, text%lines(), 'the file ends after '//to_text(found)//' values: the header states '// &
            & to_text(count))
      end associate
   end subroutine read_fixed

   !> Count the numbers of a text in columns of equal width
   pure subroutine count_extra(text, width, extra)
      character(len=*), intent(in) :: text
      !> Characters of a column
      integer, intent(in) :: width
      !> How many there are, 0 if more than `most_extra` or something else than numbers
      integer, intent(out) :: extra

      extra = (len_trim(text) - 1)/width + 1
      if (len_trim(text) == 0 .or. extra > most_extra) extra = 0
      if (extra == 0) return
      if (.not. are_numbers(text, width)) extra = 0
   end subroutine count_extra

   !> Note samples beyond those that a file states
   pure subroutine note_extra(extra, count, metadata)
      !> How many there are
      integer, intent(in) :: extra
      !> How many the file states
      integer, intent(in) :: count
      !> Where to note them
      type(metadata_type), intent(inout) :: metadata

      if (extra > 0) call metadata%append('reading', 'ignored '//to_text(extra)//trim(merge(' sample ', ' samples', extra == 1))// &
         & ' beyond the '//to_text(count)//' stated in the file')
   end subroutine note_extra

   !> Make channels of the names that a line lists
   pure subroutine name_listed(list, separators, most, channels)
      !> The names, of at most 16 characters
      character(len=*), intent(in) :: list
      !> Characters between them
      character(len=*), intent(in) :: separators
      !> How many are read
      integer, intent(in) :: most
      type(channel_type), allocatable, intent(out) :: channels(:)

      character(len=:), allocatable :: rest, word
      character(len=16) :: names(most)
      integer :: count, i

      rest = list
      do count = 0, most - 1
         word = first_word(rest, separators)
         if (len(word) == 0) exit
         rest = rest(index(rest, word) + len(word):)
         names(count + 1) = word
      end do
      allocate (channels(count))
      do i = 1, count
         channels(i)%name = trim(names(i))
      end do
   end subroutine name_listed

   !> The last number of a file must be printed like the others: a file that is cut inside it is not whole
   subroutine check_whole(text, first_line, width, error)
      type(text_file_type), intent(in) :: text
      !> Line of the first number; the last one ends the file
      integer, intent(in) :: first_line
      !> Characters of a column, 0 where blanks separate numbers
      integer, intent(in) :: width
      !> It is printed shorter
      type(error_type), allocatable, intent(out) :: error

      integer :: begin
      logical :: is_cut

      call find_cut(text, first_line, text%lines(), is_cut, begin, width, .true.)
      if (is_cut) call raise_at(error, text, text%lines(), 'the file is cut off: its last value, '''// &
         & shown(text%text(begin:text%last(text%lines())))//''', is printed shorter than the others')
   end subroutine check_whole

   !> The duration that a header states must be that of the values
   subroutine check_duration(text, line, stated, channel, error)
      type(text_file_type), intent(in) :: text
      !> Line of the duration
      integer, intent(in) :: line
      !> The duration [s]; what is no number, or not positive, says nothing
      character(len=*), intent(in) :: stated
      !> The channel, with values and time step
      type(channel_type), intent(in) :: channel
      !> The two differ by more than 2 % and five samples
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: duration, length
      logical :: ok

      call parse_real(stated, duration, ok)
      if (.not. ok) return
      length = channel%dt*real(size(channel%values), wp)
      if (.not. duration > 0.0_wp .or. abs(duration - length) <= max(0.02_wp*length, 5.0_wp*channel%dt)) return
      call raise_at(error, text, line, 'duration '//to_text(duration)//' s: count and time step make '// &
         & brief(length)//' s')
   end subroutine check_duration

   !> Report what is wrong in a line of a file
   subroutine raise_at(error, text, line, message)
      !> Error to allocate
      type(error_type), allocatable, intent(out) :: error
      type(text_file_type), intent(in) :: text
      !> Number of the line
      integer, intent(in) :: line
      !> Sentence for the user
      character(len=*), intent(in) :: message

      call raise_input(error, text%place(line)//': '//message)
   end subroutine raise_at

end module dondolo_records_format
