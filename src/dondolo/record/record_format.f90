!> What a file of accelerograms says, and how the readers of formats read its blocks of numbers.
module dondolo_record_format
   use dondolo_error, only : error_type, raise_input
   use dondolo_kinds, only : wp
   use dondolo_metadata, only : metadata_type
   use dondolo_numbers, only : parse_real, take_real
   use dondolo_plain, only : shown
   use dondolo_text, only : brief, to_text
   use dondolo_text_file, only : is_blank, text_file_type
   implicit none
   private

   public :: samples_type, channel_type, read_block, read_fixed, raise_at, check_duration

   !> One channel of a file, before units are converted
   type :: channel_type
      !> Name: the component as the file writes it, not allocated or empty if it does not say
      character(len=:), allocatable :: name
      !> Accelerations, in the file's units
      real(wp), allocatable :: values(:)
      !> Time step [s], 0 if the file does not state it
      real(wp) :: dt = 0.0_wp
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

   !> What a file says
   type :: samples_type
      !> Its channels, one at least
      type(channel_type), allocatable :: channels(:)
      !> What its header says of all channels
      type(metadata_type) :: metadata
   end type samples_type

contains

   !> Read numbers separated by blanks, tabs and line ends, from a line to the end of the file
   subroutine read_block(text, first_line, count, values, error)
      type(text_file_type), intent(in) :: text
      !> Line of the first number
      integer, intent(in) :: first_line
      !> How many there must be
      integer, intent(in) :: count
      !> The numbers
      real(wp), allocatable, intent(out) :: values(:)
      !> A text that is no number, or another count
      type(error_type), allocatable, intent(out) :: error

      integer :: line, at, first, finish, last, found
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
            if (found > count) then
               call raise_at(error, text, line, 'more values than the '//to_text(count)//' that the header states')
               return
            end if
            first = at
            call take_real(text%text, at, last, values(found), ok)
            if (ok .and. at <= last) ok = is_blank(text%text(at:at))
            if (.not. ok) then
               call text%next_word((first), last, first, finish)
               call raise_at(error, text, line, 'value '//to_text(found)//' = '''// &
                  & shown(text%text(first:finish))//''': must be a number')
               return
            end if
         end do
      end do
      if (found == count) return
      call raise_at(error, text, text%lines(), 'the file ends after '//to_text(found)//' values: the header states '// &
         & to_text(count))
   end subroutine read_block

   !> Read numbers that stand in columns of equal width, where they may touch
   !>
   !> Every line but the last is full; blanks at the end of a line may be missing.
   subroutine read_fixed(text, first_line, count, width, per_line, values, error)
      type(text_file_type), intent(in) :: text
      !> Line of the first number; the block ends (count - 1)/per_line lines later
      integer, intent(in) :: first_line
      !> How many there must be
      integer, intent(in) :: count
      !> Characters of a column
      integer, intent(in) :: width
      !> Columns of a line
      integer, intent(in) :: per_line
      !> The numbers
      real(wp), allocatable, intent(out) :: values(:)
      !> A text that is no number, text after the last column, or a file that ends before
      type(error_type), allocatable, intent(out) :: error

      integer :: line, at, finish, column, found
      logical :: ok

      ! A header may state any count; the text bounds how many numbers there can be
      allocate (values(max(0, min(count, len(text%text)))))
      found = 0
      do line = first_line, text%lines()
         if (found >= count) return
         at = text%first(line)
         do column = 1, min(per_line, count - found)
            finish = min(at + width - 1, text%last(line))
            found = found + 1
            if (finish < at) then
               ok = .false.
            else
               call parse_real(text%text(at:finish), values(found), ok)
            end if
            if (.not. ok) then
               call raise_at(error, text, line, 'value '//to_text(found)//' of '//to_text(count)//' = '''// &
                  & text%text(at:finish)//''': must be a number in column '//to_text(column)//' of width '// &
                  & to_text(width))
               return
            end if
            at = finish + 1
         end do
         if (verify(text%text(at:text%last(line)), ' '//achar(9)) == 0) cycle
         call raise_at(error, text, line, 'text after value '//to_text(found)//' of '//to_text(count)//': '''// &
            & shown(text%text(at:text%last(line)))//'''')
         return
      end do
      if (found == count) return
      call raise_at(error, text, text%lines(), 'the file ends after '//to_text(found)//' values: the header states '// &
         & to_text(count))
   end subroutine read_fixed

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

end module dondolo_record_format
