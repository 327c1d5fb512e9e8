!> What lines above columns of numbers state in words: units, time step or sampling rate, number of samples, and quantities
!> other than acceleration. Comments and lines without a mark are read alike.
!>
!> A statement is `key: value` or `key = value`, several of them separated by commas, a key before a number, `dt 0.02`, or after
!> it, `200 Hz`. Free text states units in brackets, after `in` or beside an acceleration, and another quantity where it is a
!> title such as `Velocity time history`. Two statements that differ are an error; none is chosen.
module dondolo_record_column_statements
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_integer
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : blanks, first_word, lower, stripped, to_text
   use dondolo_base_text_file, only : text_file_type
   use dondolo_record_column_titles, only : find_units, has_word, is_other_unit, is_title_of_other
   use dondolo_record_column_words, only : acceleration_words, count_keys, has_letter, milli_units, quantity_keys, rate_keys, &
      & rate_units, second_units, split_number, step_keys, unit_words, without_brackets
   use dondolo_record_format, only : raise_at
   use dondolo_record_units, only : unit_factor
   implicit none
   private

   public :: statements_type

   !> Relative difference allowed between two steps
   real(wp), parameter :: tolerance = 0.01_wp

   !> Words of a line that is a title
   integer, parameter :: few_words = 4

   !> What lines state; a line is 0 where none does
   type :: statements_type
      !> Units of all columns
      character(len=:), allocatable :: units
      integer :: units_line = 0
      !> Time step [s]
      real(wp) :: dt = 0.0_wp
      integer :: dt_line = 0
      !> Number of samples
      integer :: count = 0
      integer :: count_line = 0
      !> A title of another quantity
      character(len=:), allocatable :: other
      integer :: other_line = 0
      !> Does a line name accelerations?
      logical :: has_acceleration = .false.
   contains
      !> Take what a line states
      procedure :: take
      !> Take a number of samples
      procedure :: take_count
      !> Take a time step
      procedure :: take_step
   end type statements_type

contains

   !> Take what a line states
   subroutine take(self, text, line, content, error)
      class(statements_type), intent(inout) :: self
      type(text_file_type), intent(in) :: text
      !> Number of the line
      integer, intent(in) :: line
      !> Its text without marks of comments
      character(len=*), intent(in) :: content
      !> A statement that cannot be read, or that contradicts another one
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: part, rest
      integer :: at, mark, parts, count
      real(wp) :: dt
      logical :: has_mark, is_count

      if (has_word(content, acceleration_words)) self%has_acceleration = .true.
      has_mark = scan(content, '=:') > 0
      ! Older files of PEER: `7999    .0050    NPTS, DT`
      if (has_word(content, [character(len=4) :: 'npts']) .and. has_word(content, [character(len=4) :: 'dt']) &
         & .and. .not. has_mark) then
         call parse_integer(first_word(content, blanks//','), count, is_count)
         if (is_count .and. count > 0) then
            call self%take_count(text, line, count, error)
            call split_number(stripped(content(index(content, first_word(content, blanks//',')) &
               & + len(first_word(content, blanks//',')):)), part, dt, is_count)
            if (.not. allocated(error) .and. is_count .and. dt > 0.0_wp) call self%take_step(text, line, dt, error)
            return
         end if
      end if
      rest = content//','
      parts = 0
      do while (len(rest) > 0)
         at = scan(rest, ',;')
         if (at == 0) at = len(rest) + 1
         part = stripped(rest(:at - 1))
         rest = rest(min(at + 1, len(rest) + 1):)
         if (len(part) == 0) cycle
         parts = parts + 1
         mark = scan(part, '=:')
         if (mark > 1) then
            call take_pair(self, text, line, part(:mark - 1), part(mark + 1:), error)
            ! `4000 points spaced at 0.02 sec (units: gal)`
            if (.not. allocated(error)) call take_numbered(self, text, line, part(:mark - 1), error)
         else if (.not. has_mark .and. parts == 1 .and. scan(rest, ',;') == len(rest) .and. len(rest) > 1 .and. &
            & has_letter(part) .and. (scan(adjustl(rest), '0123456789+-.') == 1 .or. has_word(part, unit_words))) then
            ! `Sampling Freq(Hz), 50`
            call take_pair(self, text, line, part, rest(:len(rest) - 1), error)
            rest = ''
         else
            call take_numbered(self, text, line, part, error)
         end if
         if (allocated(error)) return
      end do
      if (.not. has_mark) call take_text(self, text, line, stripped(content), error)
   end subroutine take

   !> Take a key and its value
   subroutine take_pair(self, text, line, key, value, error)
      class(statements_type), intent(inout) :: self
      type(text_file_type), intent(in) :: text
      integer, intent(in) :: line
      !> Key, perhaps with units in brackets
      character(len=*), intent(in) :: key
      character(len=*), intent(in) :: value
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: name, unit, number, word
      type(error_type), allocatable :: unknown
      integer :: opening, closing, count
      real(wp) :: amount, factor
      logical :: ok, is_step, is_rate

      unit = ''
      opening = scan(key, '([')
      name = lower(stripped(key))
      if (opening > 1) then
         closing = scan(key, ')]')
         if (closing > opening) unit = lower(stripped(key(opening + 1:closing - 1)))
         name = lower(stripped(key(:opening - 1)))
      end if
      word = stripped(value)
      if (has_word(key, unit_words) .and. .not. has_word(key, [character(len=8) :: 'time', 'tempo', 'temps'])) then
         word = first_word(value//' ', blanks//',;')
         call unit_factor(stripped(value), factor, unknown)
         if (.not. allocated(unknown)) word = stripped(value)
         if (len(word) > 0) call take_units(self, text, line, without_brackets(word), error)
         return
      end if
      if (any(quantity_keys == name)) then
         if (is_title_of_other(value) .and. .not. has_word(value, acceleration_words)) call note_other(self, line, value)
         return
      end if
      is_step = any(step_keys == name)
      is_rate = any(rate_keys == name)
      if (is_step .or. is_rate) then
         call split_number(word, number, amount, ok)
         if (len(number) > 0) unit = number
         if (.not. ok) then
            ! Words may say that none is known
            if (name == 'dt') call raise_at(error, text, line, 'the comment dt = '''//shown(word)// &
               & ''': must be a positive number')
            return
         end if
         call take_amount(self, text, line, stripped(key)//' = '//word, amount, unit, is_rate, error)
         return
      end if
      if (any(count_keys == name)) then
         call parse_integer(first_word(word//' ', blanks//',;.'), count, ok)
         if (ok .and. count > 0) call self%take_count(text, line, count, error)
      end if
   end subroutine take_pair

   !> Take an amount that is a time step, or a rate if its units or its key say so
   subroutine take_amount(self, text, line, statement, amount, unit, is_rate, error)
      class(statements_type), intent(inout) :: self
      type(text_file_type), intent(in) :: text
      integer, intent(in) :: line
      !> The statement, for messages
      character(len=*), intent(in) :: statement
      real(wp), intent(in) :: amount
      !> Units in lower case, empty if none are stated
      character(len=*), intent(in) :: unit
      !> Does the key name a rate?
      logical, intent(in) :: is_rate
      type(error_type), allocatable, intent(out) :: error

      !> Smallest rate of a record [1/s]
      real(wp), parameter :: smallest_rate = 1.0_wp, milli = 1.0e-3_wp
      real(wp) :: dt

      dt = 0.0_wp
      if (amount > 0.0_wp) then
         if (any(milli_units == unit)) then
            dt = amount*milli
         else if (any(rate_units == unit) .or. (is_rate .and. len_trim(unit) == 0)) then
            if (amount >= smallest_rate) dt = 1.0_wp/amount
         else if (any(second_units == unit)) then
            dt = amount
         end if
      end if
      if (.not. dt > 0.0_wp) then
         call raise_at(error, text, line, shown(statement)//': must be a time step in s or a rate in Hz, positive')
         return
      end if
      call self%take_step(text, line, dt, error)
   end subroutine take_amount

   !> Take statements of a key and a number without a mark between: `dt 0.02 s`, `200 Hz`, `4000 points spaced at 0.02 sec`
   subroutine take_numbered(self, text, line, part, error)
      class(statements_type), intent(inout) :: self
      type(text_file_type), intent(in) :: text
      integer, intent(in) :: line
      character(len=*), intent(in) :: part
      type(error_type), allocatable, intent(out) :: error

      character(len=*), parameter :: steps(*) = [character(len=9) :: 'interval', 'spac', 'increment']
      character(len=:), allocatable :: key, rest, unit
      integer :: at, from, count, i
      real(wp) :: amount
      logical :: ok, is_spaced

      is_spaced = any([(index(lower(part), trim(steps(i))) > 0, i=1, size(steps))])
      from = 1
      do
         at = scan(part(from:), '0123456789')
         if (at == 0) return
         at = from - 1 + at
         ! The sign and the point before the first digit
         do while (at > from)
            if (scan(part(at - 1:at - 1), '.+-') == 0) exit
            at = at - 1
         end do
         key = lower(stripped(part(from:at - 1)))
         call split_number(part(at:), rest, amount, ok)
         from = at + max(1, verify(part(at:)//' ', '0123456789.+-/eE') - 1)
         if (.not. ok) cycle
         unit = first_word(rest, blanks//',')
         if (any(step_keys == key) .or. any(rate_keys == key)) then
            if (any(second_units == unit) .or. any(milli_units == unit) .or. any(rate_units == unit)) then
              call take_amount(self, text, line, part, amount, unit, any(rate_keys == key), error)
            end if
         else if (any(count_keys == key) .and. len(unit) == 0) then
            call parse_integer(part(at:), count, ok)
            if (ok .and. count > 0) call self%take_count(text, line, count, error)
         else if (any(count_keys == rest) .or. any(['points ', 'samples'] == unit)) then
            if (len(key) == 0 .and. amount >= 2.0_wp .and. amount <= real(huge(count)/2, wp) &
               & .and. amount <= anint(amount) .and. index(rest, 'per ') == 0) then
              call self%take_count(text, line, nint(amount), error)
            end if
            if (any(rate_units == rest)) call take_amount(self, text, line, part, amount, rest, .true., error)
         else if (any(rate_units == unit) .and. (len(key) == 0 .or. index(key, 'sampl') > 0)) then
            call take_amount(self, text, line, part, amount, unit, .true., error)
         else if (is_spaced .and. len(unit) > 0 .and. (any(second_units == unit) .or. any(milli_units == unit))) then
            call take_amount(self, text, line, part, amount, unit, .false., error)
         end if
         if (allocated(error)) return
      end do
   end subroutine take_numbered

   !> Take what free text states: units, and another quantity
   subroutine take_text(self, text, line, content, error)
      class(statements_type), intent(inout) :: self
      type(text_file_type), intent(in) :: text
      integer, intent(in) :: line
      character(len=*), intent(in) :: content
      type(error_type), allocatable, intent(out) :: error

      type(error_type), allocatable :: unknown
      character(len=:), allocatable :: units, word, rest, before
      logical :: of_acceleration, is_short
      real(wp) :: factor
      integer :: words

      of_acceleration = has_word(content, acceleration_words)
      call find_units(content, units)
      if (len(units) > 0) then
         call unit_factor(units, factor, unknown)
         if (allocated(unknown)) units = ''
      end if
      words = 0
      rest = content
      before = ''
      do
         word = first_word(rest, blanks//',;')
         if (len(word) == 0) exit
         rest = rest(index(rest, word) + len(word):)
         words = words + 1
         if (len(units) == 0) then
            call unit_factor(without_brackets(word), factor, unknown)
            if (.not. allocated(unknown)) then
               ! A g, or gal, may be anything but after `in` or beside an acceleration
               if (lower(before) == 'in' .or. lower(before) == 'of' .or. of_acceleration .or. index(word, '/') > 0) then
                 units = without_brackets(word)
               end if
            else if ((lower(before) == 'in' .or. lower(before) == 'of') .and. is_other_unit(word) &
               & .and. is_title_of_other(content) .and. .not. of_acceleration) then
               call note_other(self, line, content)
            end if
         end if
         before = word
      end do
      if (len(units) > 0) call take_units(self, text, line, units, error)
      is_short = words <= few_words .or. has_word(content, [character(len=8) :: 'series', 'history', 'storia'])
      if (is_short .and. is_title_of_other(content) .and. .not. of_acceleration) call note_other(self, line, content)
   end subroutine take_text

   !> Note that a line names another quantity
   subroutine note_other(self, line, content)
      class(statements_type), intent(inout) :: self
      integer, intent(in) :: line
      character(len=*), intent(in) :: content

      if (self%other_line > 0) return
      self%other = stripped(content)
      self%other_line = line
   end subroutine note_other

   !> Take units of all columns
   subroutine take_units(self, text, line, units, error)
      class(statements_type), intent(inout) :: self
      type(text_file_type), intent(in) :: text
      integer, intent(in) :: line
      character(len=*), intent(in) :: units
      type(error_type), allocatable, intent(out) :: error

      type(error_type), allocatable :: one, other
      real(wp) :: factor, first
      logical :: differ

      if (is_other_unit(units)) then
         call note_other(self, line, text%line(line))
         return
      end if
      if (self%units_line == 0) then
         self%units = units
         self%units_line = line
         return
      end if
      call unit_factor(units, factor, one)
      call unit_factor(self%units, first, other)
      differ = allocated(one) .or. allocated(other)
      if (.not. differ) differ = factor < first .or. factor > first
      if (differ) call raise_at(error, text, line, 'units '''//shown(units)//''': line '//to_text(self%units_line)// &
         & ' states '''//shown(self%units)//'''')
   end subroutine take_units

   !> Take a number of samples
   subroutine take_count(self, text, line, count, error)
      class(statements_type), intent(inout) :: self
      type(text_file_type), intent(in) :: text
      integer, intent(in) :: line, count
      type(error_type), allocatable, intent(out) :: error

      if (self%count_line > 0 .and. count /= self%count) then
         call raise_at(error, text, line, to_text(count)//' samples: line '//to_text(self%count_line)//' states '// &
            & to_text(self%count))
         return
      end if
      self%count = count
      self%count_line = line
   end subroutine take_count

   !> Take a time step
   subroutine take_step(self, text, line, dt, error)
      class(statements_type), intent(inout) :: self
      type(text_file_type), intent(in) :: text
      integer, intent(in) :: line
      !> Time step [s]
      real(wp), intent(in) :: dt
      type(error_type), allocatable, intent(out) :: error

      if (self%dt_line > 0) then
         if (abs(dt - self%dt) > tolerance*self%dt) call raise_at(error, text, line, 'a time step of '//to_text(dt)// &
            & ' s: line '//to_text(self%dt_line)//' states '//to_text(self%dt)//' s')
         return
      end if
      self%dt = dt
      self%dt_line = line
   end subroutine take_step

end module dondolo_record_column_statements
