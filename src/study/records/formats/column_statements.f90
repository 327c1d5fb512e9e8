!> What lines above plain columns state: units, time step or sampling rate, number, largest value and duration of the samples, and
!> quantities other than acceleration.
!>
!> A statement is `key: value` or `key = value`, several of them separated by commas. Keys before a number are a closed list
!> (dondolo_records_column_words), and the number is read whole. Lines without a number may name units, in brackets, after `in` or
!> beside an acceleration, and quantities. All else that holds a number, or names a factor, units or a quantity that is not known,
!> is refused, in words too: it may say what the values are. Words are compared without accents.
module dondolo_records_column_statements
   use dondolo_base_error, only : add_place, error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_integer
   use dondolo_base_plain, only : shown
   use dondolo_base_text, only : blanks, first_word, lower, stripped, to_text
   use dondolo_files_text_file, only : text_file_type
   use dondolo_records_column_layout, only : raise_unclear
   use dondolo_records_column_letters, only : digits, folded, has_word
   use dondolo_records_column_titles, only : find_units, is_acceleration_unit, is_other_unit, names_acceleration, names_counter, &
      & names_counts, names_factor, names_other
   use dondolo_records_column_words, only : count_key, duration_key, factor_key, has_number, kilo_units, kind_of_key, micro_units, &
      & milli_units, peak_key, quantity_key, rate_key, rate_units, remark_key, second_units, split_key, step_key, take_amount, &
      & within_brackets
   use dondolo_records_format, only : given_type, raise_at
   use dondolo_records_units, only : unit_factor
   implicit none
   private

   public :: statements_type

   !> Words that name units; what stands after `in` and its like may be units
   character(len=*), parameter :: unit_words(*) = [character(len=14) :: 'unit', 'units', 'unita', 'unidades', 'unidad', 'einheit', &
      & 'einheiten', 'masseinheit', 'masseinheiten', 'unite', 'unites', 'unidade', 'birim', 'birimi', 'eenheid', 'eenheden', &
      & 'jednotka', 'jednotky', 'jednostka', 'enhet', 'enhed', 'enota', 'jedinica', 'yksikko', 'mertekegyseg'], &
      & before_units(*) = [character(len=3) :: 'in', 'of', 'di', 'de', 'en', 'are', 'is', 'is:', 'to']

   !> Words that tell, with a number in a remark, its step, number or largest value
   character(len=*), parameter :: telling(*) = [character(len=10) :: 'dt', 'step', 'steps', 'sps', 'sampled', 'sampling', &
      & 'resampled', 'interval', 'rate', 'npts', 'samples', 'points', 'values', 'hz', 'khz', 'pga', 'peak', 'passo', 'campioni', &
      & 'campionato', 'punti', 'picco']

   !> Words of filters, whose remarks may have numbers of Hz
   character(len=*), parameter :: of_filters(*) = [character(len=12) :: 'filter', 'filtered', 'filtering', 'pass', 'highpass', &
      & 'lowpass', 'bandpass', 'corner', 'butterworth', 'filtro', 'filtrato', 'frequency', 'frequencies', 'hp', 'lp', 'bp']

   !> Words of a quantity that may be an acceleration
   character(len=*), parameter :: of_motions(*) = [character(len=14) :: 'corrected', 'uncorrected', 'processed', 'unprocessed', &
      & 'ground', 'motion', 'strong', 'earthquake', 'synthetic', 'recorded', 'natural', 'artificial', 'simulated', 'time', &
      & 'history', 'series', 'horizontal', 'component', 'seismic', 'base', 'input', 'free', 'field', 'accelerometer']

   !> Words with which a line about velocities, displacements or spectra is a remark on accelerations
   character(len=*), parameter :: of_processing(*) = [character(len=12) :: 'final', 'residual', 'initial', 'zero', 'matched', &
      & 'compatible', 'target', 'code']

   !> Relative difference allowed between two steps
   real(wp), parameter :: tolerance = 0.01_wp

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
      !> Largest value as it is printed, and its units, empty if none are stated
      character(len=:), allocatable :: peak, peak_units
      integer :: peak_line = 0
      !> Duration as it is printed [s]
      character(len=:), allocatable :: duration
      integer :: duration_line = 0
      !> A line that names another quantity
      character(len=:), allocatable :: other
      integer :: other_line = 0
   contains
      !> Take what a line states
      procedure :: take
      !> Take what words name
      procedure :: take_text
      !> Take a number of samples
      procedure :: take_count
      !> Take a time step
      procedure :: take_step
   end type statements_type

contains

   !> Take what a line states
   subroutine take(self, text, line, content, given, columns, error)
      class(statements_type), intent(inout) :: self
      type(text_file_type), intent(in) :: text
      !> Number of the line
      integer, intent(in) :: line
      !> Its text without marks of comments
      character(len=*), intent(in) :: content
      !> What the caller gives, and the number of columns, for messages
      type(given_type), intent(in) :: given
      integer, intent(in) :: columns
      !> A statement that is not clear, or that contradicts another one
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: rest
      integer :: mark, finish
      logical :: is_clear

      if (scan(content, '=:') == 0) then
         is_clear = .not. (has_number(content) .or. names_factor(content, .true.))
         if (is_clear) call self%take_text(text, line, content, is_clear, error)
      else
         rest = content
         is_clear = .true.
         do while (is_clear .and. len(rest) > 0 .and. .not. allocated(error))
            mark = scan(rest, '=:')
            finish = end_of_pair(rest)
            call take_pair(self, text, line, rest(:max(mark - 1, 0)), rest(mark + 1:finish), is_clear, error)
            rest = rest(min(finish + 2, len(rest) + 1):)
         end do
      end if
      if (.not. (is_clear .or. allocated(error))) call raise_unclear(error, text, line, ''''//shown(content)// &
         & ''' is no statement that is read', given, columns)
   end subroutine take

   !> Where the first `key: value` ends: before a comma or semicolon after which another key with letters begins, or a blank after
   !> which a key of numbers does
   pure integer function end_of_pair(text) result(finish)
      character(len=*), intent(in) :: text

      integer :: mark
      character(len=:), allocatable :: name, unit

      finish = scan(text, '=:')
      do while (finish < len(text))
         if (finish > scan(text, '=:') + 1 .and. scan(text(finish + 1:finish + 1), blanks) > 0) then
            mark = scan(text(finish + 2:), '=:')
            if (mark > 1 .and. len_trim(text(scan(text, '=:') + 1:finish)) > 0) then
               call split_key(text(finish + 2:finish + mark), name, unit)
               if (kind_of_key(name) > 0 .and. kind_of_key(name) < quantity_key) return
            end if
         end if
         if (scan(text(finish + 1:finish + 1), ',;') > 0) then
            associate (next => text(finish + 2:))
               mark = scan(next, '=:')
               if (mark > 1 .and. scan(next(:max(mark - 1, 0)), ',;') == 0) then
                  if (scan(lower(next(:mark - 1)), 'abcdefghijklmnopqrstuvwxyz') > 0) return
               end if
            end associate
         end if
         finish = finish + 1
      end do
   end function end_of_pair

   !> Take a key and its value
   subroutine take_pair(self, text, line, key, value, is_clear, error)
      class(statements_type), intent(inout) :: self
      type(text_file_type), intent(in) :: text
      integer, intent(in) :: line
      !> Key, perhaps with units in brackets
      character(len=*), intent(in) :: key
      character(len=*), intent(in) :: value
      !> It says nothing, or what it says is read
      logical, intent(out) :: is_clear
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: name, unit, own_unit
      integer :: kind, count
      real(wp) :: amount
      logical :: ok, has_figure

      has_figure = scan(value, '0123456789') > 0
      call split_key(key, name, own_unit)
      is_clear = .true.
      if (has_word(name, unit_words)) then
         if (index(name, 'time') + index(name, 'temp') > 0) then
            is_clear = any(second_units == lower(within_brackets(value)))
         else if (len_trim(value) > 0) then
            call take_units(self, text, line, within_brackets(value), error)
         end if
         return
      end if
      kind = kind_of_key(name)
      call take_amount(value, amount, unit, ok)
      if (ok .and. len(own_unit) > 0) then
         ! Units of the key and of the value must be the same
         ok = len(unit) == 0 .or. lower(unit) == lower(own_unit)
         unit = own_unit
      end if
      select case (kind)
      case (step_key, rate_key)
         ! 1.000 Hz may be one or a thousand
         if (kind == rate_key .and. ok .and. amount < 10.0_wp) ok = index(value, '.000') == 0
         is_clear = ok .or. .not. (has_figure .or. names_factor(value, .true.))
         if (ok) call take_period(self, text, line, stripped(key)//' = '//stripped(value), amount, lower(unit), &
            & kind == rate_key, error)
      case (count_key)
         call parse_integer(value, count, ok)
         is_clear = (ok .and. count > 0) .or. .not. has_figure
         if (ok .and. count > 0) call self%take_count(text, line, count, error)
      case (peak_key)
         is_clear = .not. has_figure
         if (ok) is_clear = len(unit) == 0 .or. is_acceleration_unit(unit)
         if (.not. (ok .and. is_clear)) return
         is_clear = self%peak_line == 0
         self%peak = first_word(value, blanks)
         self%peak_units = unit
         self%peak_line = line
      case (duration_key)
         is_clear = .not. has_figure
         if (ok) is_clear = any(second_units == lower(unit)) .and. self%duration_line == 0
         if (.not. (ok .and. is_clear)) return
         self%duration = to_text(amount)
         self%duration_line = line
      case (factor_key)
         ! A factor of 1 changes nothing
         if (ok .and. abs(amount - 1.0_wp) <= 0.0_wp .or. len_trim(value) == 0) return
         if (any([character(len=5) :: 'none', 'one', 'no', 'unity', '-', 'uno', 'eins'] == lower(stripped(value)))) return
         call raise_at(error, text, line, ''''//stripped(key)//' = '//shown(stripped(value))//''' is not applied: unless the '// &
            & 'values hold it already they must be multiplied by it in the file, and the line be removed')
      case (remark_key)
         is_clear = is_remark(name, value)
      case default
         is_clear = .not. (has_number(key//' '//value) .or. names_factor(key//' '//value, .true.))
         if (is_clear .and. kind == quantity_key) is_clear = is_quantity(value)
         if (is_clear) call self%take_text(text, line, stripped(key)//' '//stripped(value), is_clear, error)
      end select
   end subroutine take_pair

   !> Says the value of a known remark nothing of what the values are: no factor, counts, step, number or largest value?
   pure logical function is_remark(name, value)
      !> Its key, as `split_key` gives it
      character(len=*), intent(in) :: name, value

      character(len=len(value)) :: plain
      integer :: i

      plain = folded(value)
      is_remark = .true.
      if (index(name, 'file') == 1) return
      is_remark = .not. names_counter(plain)
      ! Dates and percentages are no factors
      do i = 1, len(plain)
         if (scan(plain(i:i), '/%') > 0) plain(i:i) = ','
      end do
      if (has_word(plain, ['times']) .or. scan(plain, digits) > 0) is_remark = is_remark .and. .not. names_factor(plain, .false.)
      if (.not. is_remark .or. scan(plain, digits) == 0) return
      is_remark = .not. has_word(plain, telling)
      if (.not. is_remark .and. (has_word(name, of_filters) .or. has_word(plain, of_filters))) is_remark = .not. has_word(plain, &
         & pack(telling, .not. (telling == 'hz' .or. telling == 'khz')))
   end function is_remark

   !> May a stated quantity be an acceleration, or is it another one that is known?
   logical function is_quantity(value)
      character(len=*), intent(in) :: value

      is_quantity = len_trim(value) == 0 .or. names_acceleration(value) .or. names_other(value) .or. has_word(value, of_motions) &
         & .or. is_acceleration_unit(within_brackets(value)) .or. names_counts(value)
   end function is_quantity

   !> Take an amount that is a time step, or a rate if its units or its key say so
   subroutine take_period(self, text, line, statement, amount, unit, is_rate, error)
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
         if (any(milli_units == unit) .and. .not. is_rate) then
            dt = amount*milli
         else if (any(micro_units == unit) .and. .not. is_rate) then
            dt = amount*milli*milli
         else if (any(kilo_units == unit)) then
            dt = milli/amount
         else if (any(rate_units == unit) .or. (is_rate .and. len(unit) == 0)) then
            if (amount >= smallest_rate) dt = 1.0_wp/amount
         else if (any(second_units == unit) .and. .not. is_rate) then
            dt = amount
         end if
      end if
      if (.not. dt > 0.0_wp) then
         call raise_at(error, text, line, shown(statement)//': must be a time step in s or a rate in Hz, positive')
         return
      end if
      call self%take_step(text, line, dt, error)
   end subroutine take_period

   !> Take what words name: units, accelerations, or another quantity, which is refused
   subroutine take_text(self, text, line, content, is_clear, error)
      class(statements_type), intent(inout) :: self
      type(text_file_type), intent(in) :: text
      integer, intent(in) :: line
      character(len=*), intent(in) :: content
      !> It names no units that are not known
      logical, intent(out) :: is_clear
      type(error_type), allocatable, intent(out) :: error

      !> Words of a line that is a title
      integer, parameter :: few_words = 4
      character(len=:), allocatable :: units, other, word, rest, before
      logical :: of_acceleration, is_alone
      integer :: words

      is_clear = .true.
      of_acceleration = names_acceleration(content)
      call find_units(content, units)
      other = ''
      if (len(units) > 0) then
         if (is_other_unit(units) .and. .not. is_of_time(units)) other = units
         if (any(['v ', 'du', '% '] == lower(units))) other = units
         if (.not. is_acceleration_unit(units)) units = ''
      end if
      words = 0
      rest = content
      before = ''
      do
         word = first_word(rest, blanks//',;')
         if (len(word) == 0) exit
         rest = rest(index(rest, word) + len(word):)
         words = words + 1
         is_alone = any(before_units == lower(before)) .or. has_word(before, unit_words) .or. index(word, '/') > 0
         if (len(units) == 0 .and. is_acceleration_unit(word)) then
            ! A g, or gal, may be anything but after `in` or beside an acceleration
            if (is_alone .or. of_acceleration .or. within_brackets(content) == word) units = within_brackets(word)
         else if (is_alone .and. is_other_unit(word) .and. .not. is_of_time(word)) then
            other = word
         end if
         before = word
      end do
      if (names_counts(content) .or. any(['v ', 'du'] == lower(within_brackets(content))) .or. (has_word(content, ['raw']) .and. &
         & .not. of_acceleration)) then
         call raise_at(error, text, line, ''''//shown(content)//''': counts of a digitizer are no accelerations')
      else if (len(units) > 0) then
         call take_units(self, text, line, units, error)
      else if (len(other) > 0) then
         call note_other(self, line, content)
      else
         is_clear = .not. (has_word(content, unit_words) .or. is_acceleration_unit(before))
      end if
      if (.not. names_other(content) .or. of_acceleration .or. allocated(error)) return
      if (words <= few_words .or. .not. has_word(content, of_processing)) call note_other(self, line, content)
   end subroutine take_text

   !> Are units those of times, frequencies or angles, which stand beside accelerations?
   pure logical function is_of_time(units)
      character(len=*), intent(in) :: units

      is_of_time = any(['s  ', 'sec', 'hz ', 'rad', 'deg'] == lower(within_brackets(units)))
   end function is_of_time

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
      !> They are no units of acceleration, or others than those of another line
      type(error_type), allocatable, intent(out) :: error

      type(error_type), allocatable :: known
      real(wp) :: factor, first

      if (is_other_unit(units)) then
         call note_other(self, line, text%line(line))
         return
      end if
      call unit_factor(units, factor, error)
      call add_place(error, text%place(line))
      if (allocated(error)) return
      if (self%units_line == 0) then
         self%units = units
         self%units_line = line
         return
      end if
      call unit_factor(self%units, first, known)
      if (factor < first .or. factor > first) call raise_at(error, text, line, 'units '''//shown(units)//''': line '// &
         & to_text(self%units_line)//' states '''//shown(self%units)//'''')
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

end module dondolo_records_column_statements
