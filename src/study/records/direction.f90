!> Which way a component of a motion points: up and down, or sideways, by what its file says of it, or by its name.
!>
!> A wall that is moved by a vertical component as if it were horizontal is moved too little: verticals are left out of catalogues,
!> refused as parts of a horizontal motion, and named by a warning where they move a wall. Whatever says nothing is horizontal.
module dondolo_records_direction
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_real
   use dondolo_base_text, only : lower
   use dondolo_record_metadata, only : metadata_type
   implicit none
   private

   public :: find_direction, is_vertical, names_vertical
   public :: unknown, horizontal, vertical

   !> Directions
   integer, parameter :: unknown = 0, horizontal = 1, vertical = 2

   !> Keys of metadata that tell the component; what the first of them that says a direction says counts
   character(len=9), parameter :: keys(3) = [character(len=9) :: 'component', 'channel', 'axis']

   !> Words of other keys, of which only a vertical counts: many are numbers that are no azimuths
   character(len=12), parameter :: key_words(26) = [character(len=12) :: 'component', 'comp', 'cmp', 'channel', 'chan', 'cha', &
      & 'canale', 'axis', 'asse', 'eje', 'achse', 'direction', 'dir', 'orientation', 'azimuth', 'stream', 'motion', 'componente', &
      & 'composante', 'komponente', 'direzione', 'orientamento', 'direccion', 'richtung', 'bilesen', 'yon']

   !> The same of keys of codes and names, whose last word counts
   character(len=8), parameter :: code_words(9) = [character(len=8) :: 'id', 'seed', 'nslc', 'trace', 'record', 'name', 'title', &
      & 'file', 'filename']

   !> Codes that are vertical: of a format, a key of its metadata, and a value
   character(len=11), parameter :: codes(3, 5) = reshape([character(len=11) :: 'smc', 'inclination', '0', 'smc', 'inclination', &
      & '180', 'cosmos', 'azimuth', '400', 'cosmos', 'azimuth', '401', 'cosmos', 'azimuth', '402'], [3, 5])

   !> Words for a vertical component, which two figures may follow
   character(len=9), parameter :: verticals(24) = [character(len=9) :: 'up', 'upx', 'ud', 'du', 'dwn', 'updown', 'updo', 'vert', &
      & 'vrt', 'accz', 'accelz', 'accv', 'accud', 'accup', 'zacc', 'zx', 'chanz', 'chanv', 'compz', 'compv', 'cmpz', 'cmpv', &
      & 'dirz', 'axisz']

   !> The same where no other word follows
   character(len=4), parameter :: last_verticals(10) = [character(len=4) :: 'u', 'v', 'z', 'z1', 'az', 'dn', 'down', 'ver', 'upd', &
      & 'dnup']

   !> The same where they stand first, and no word says a direction
   character(len=1), parameter :: first_verticals(2) = ['v', 'z']

   !> Beginnings of words for vertical in other languages, without accents
   character(len=14), parameter :: stems(26) = [character(len=14) :: 'vertic', 'vertik', 'dusey', 'dikey', 'katakor', &
      & 'navpic', 'okomit', 'pionow', 'upward', 'downward', 'senkrecht', 'lotrecht', 'loodrecht', 'lodret', 'svisl', 'zvisl', &
      & 'pystysuor', 'zdir', 'zaxis', 'zcomp', 'zkomp', 'vcomp', 'κατακ', 'Κατακ', 'ΚΑΤΑΚ', 'вертик']

   !> The same in scripts without blanks, or with capitals that have other bytes
   character(len=12), parameter :: marks(7) = [character(len=12) :: '上下', '鉛直', '垂直', '竖', '豎', '수직', &
      & 'Вертик']

   !> Words that say nothing of the direction: of quantities, units, formats, and words for component itself
   character(len=12), parameter :: others(57) = [character(len=12) :: 'filtered', 'filt', 'filtrata', 'filtrato', &
      & 'bandpass', 'highpass', 'lowpass', 'raw', 'uncorrected', 'processed', 'baseline', 'scaled', &
      & 'a', 'ac', 'acc', 'accel', 'acceleration', 'at2', 'asc', &
      & 'txt', 'csv', 'dat', 'c', 'd', 'cor', 'corr', 'corrected', 'deg', 'axis', 'asse', 'eje', 'comp', 'component', &
      & 'componente', 'composante', 'komponente', 'bilesen', 'bileseni', 'direction', 'direzione', 'direccion', 'dir', 'channel', &
      & 'canale', 'canal', 'chan', 'ch', 'g', 'gal', 'm', 'cm', 'mm', 's2', 'sec2', 'v1', 'v2', 'motion']

   !> Those that a number may follow
   character(len=9), parameter :: numbered(7) = [character(len=9) :: 'channel', 'canale', 'canal', 'chan', 'ch', 'comp', &
      & 'component']

   !> Bands and instruments of SEED's channels: accelerometers, seismometers of high and low gain, gravimeters, mass positions
   character(len=*), parameter :: bands = 'bcdefghlmrsuv', instruments = 'hlgnm'

   !> SEED's channels that are known behind the code of a station without a mark between
   character(len=3), parameter :: glued(8) = ['hnz', 'hhz', 'hlz', 'hgz', 'bhz', 'bnz', 'ehz', 'shz']

   character(len=*), parameter :: digits = '0123456789', letters = 'abcdefghijklmnopqrstuvwxyz'

contains

   !> Find the direction of a component, and what shows it
   pure subroutine find_direction(metadata, name, direction, key, text)
      !> Metadata of the record
      type(metadata_type), intent(in) :: metadata
      !> Name of its file or of the record, which counts where the metadata say nothing
      character(len=*), intent(in) :: name
      integer, intent(out) :: direction
      !> Key of the metadata that shows it, 'name' for the name, and its text; empty where nothing does
      character(len=:), allocatable, intent(out) :: key, text

      integer :: i

      do i = 1, size(codes, 2)
         key = trim(codes(2, i))
         text = metadata%get(key)
         direction = merge(vertical, unknown, metadata%get('format') == codes(1, i) .and. text == codes(3, i))
         if (direction == vertical) return
      end do
      do i = 1, size(keys)
         key = trim(keys(i))
         text = metadata%get(key)
         direction = direction_of(text)
         ! Down, where nothing else is said: in a name it may be anything
         if (lower(text) == 'd') direction = vertical
         if (direction /= unknown) return
      end do
      do i = 1, metadata%count()
         key = metadata%entries(i)%key
         text = metadata%entries(i)%value
         direction = unknown
         if (has_word(key, key_words)) then
            direction = direction_of(text)
         else if (has_word(key, code_words)) then
            if (ends_upright(plain_of(text, .true.))) direction = vertical
         else if (has_word(key, ['station'])) then
            if (has_upright_channel(plain_of(text, .true.))) direction = vertical
         end if
         if (direction == vertical) return
      end do
      key = 'dip'
      text = metadata%get(key)
      if (is_upright(text)) then
         direction = vertical
         return
      end if
      key = 'name'
      text = name
      direction = direction_of(text)
      if (direction /= unknown) return
      key = ''
      text = ''
   end subroutine find_direction

   !> Is a record a vertical component?
   pure logical function is_vertical(metadata, name)
      type(metadata_type), intent(in) :: metadata
      !> Its name
      character(len=*), intent(in) :: name

      character(len=:), allocatable :: key, text
      integer :: direction

      call find_direction(metadata, name, direction, key, text)
      is_vertical = direction == vertical
   end function is_vertical

   !> Does a line say that what is below it is a vertical component? A few words, none of which is a direction of the plane
   pure logical function names_vertical(line)
      character(len=*), intent(in) :: line

      !> Words of such a line
      integer, parameter :: few_words = 5

      names_vertical = direction_of(line) == vertical .and. count_words(plain_of(line, .true.)) <= few_words
   end function names_vertical

   !> Is a dip, from the horizontal downwards, that of an upright instrument?
   pure logical function is_upright(dip)
      !> Angle [degrees]; what is no number is none
      character(len=*), intent(in) :: dip

      real(wp) :: angle

      call parse_real(dip, angle, is_upright)
      if (is_upright) is_upright = abs(abs(angle) - 90.0_wp) < 1.0_wp
   end function is_upright

   !> Direction that a text says; what stands in brackets counts where nothing else does
   pure integer function direction_of(text) result(direction)
      character(len=*), intent(in) :: text

      integer :: i, opening

      direction = vertical
      do i = 1, size(marks)
         if (index(text, trim(marks(i))) > 0) return
      end do
      direction = direction_of_words(plain_of(text, .false.))
      if (direction == unknown) direction = direction_of_words(plain_of(text, .true.))
      ! The channel 3 (Up) is no azimuth
      opening = scan(text, '([')
      if (direction == vertical .or. opening == 0) return
      if (verify(trim(adjustl(text(:opening - 1))), digits) > 0 .or. count_words(plain_of(text(opening:), .true.)) /= 1) return
      if (direction_of_words(plain_of(text(opening:), .true.)) == vertical) direction = vertical
   end function direction_of

   !> Number of words
   pure integer function count_words(plain) result(words)
      !> With blanks between
      character(len=*), intent(in) :: plain

      integer :: i

      words = count([(plain(i:i) /= ' ' .and. plain(max(1, i - 1):max(1, i - 1)) == ' ', i=2, len(plain))])
      if (len(plain) > 0) words = words + merge(1, 0, plain(1:1) /= ' ')
   end function count_words

   !> Does a text, such as a key, have one of some words?
   pure logical function has_word(text, words)
      character(len=*), intent(in) :: text
      character(len=*), intent(in) :: words(:)

      character(len=len(text) + 2) :: plain
      integer :: i

      plain = ' '//plain_of(text, .true.)
      has_word = any([(index(plain, ' '//trim(words(i))//' ') > 0, i=1, size(words))])
   end function has_word

   !> Says the last word of a name or a code vertical, beside another one, as in TOWN UP? Rue du Lac does not
   pure logical function ends_upright(plain)
      !> In lower case, with blanks between
      character(len=*), intent(in) :: plain

      integer :: first, last

      ends_upright = has_upright_channel(plain)
      last = len_trim(plain)
      first = index(plain(:last), ' ', back=.true.) + 1
      if (ends_upright .or. len_trim(plain(:first - 1)) == 0) return
      ends_upright = is_up(plain(first:last)) .and. plain(first:last) /= 'du'
   end function ends_upright

   !> Direction that words say, the last of them that says one
   pure integer function direction_of_words(plain) result(direction)
      !> In lower case, with blanks between
      character(len=*), intent(in) :: plain

      character(len=:), allocatable :: word
      integer :: first, last
      logical :: is_last, is_band

      direction = unknown
      if (index(' '//plain//' ', ' column ') > 0) return
      is_last = .true.
      is_band = .false.
      last = len_trim(plain)
      do while (last > 0)
         first = index(plain(:last), ' ', back=.true.) + 1
         word = plain(first:last)
         last = len_trim(plain(:first - 1))
         if (any(others == word)) cycle
         ! The figures of 0.1-25Hz are no azimuths
         if (is_band) is_band = verify(word, digits) == 0
         if (index(word, 'hz', back=.true.) == max(1, len(word) - 1)) is_band = is_band .or. verify(word, digits//'hz') == 0
         if (is_band) cycle
         if (verify(word, digits) == 0) then
            ! No azimuths are the number of a channel, as in Chan 3, and a location or a date behind the code of one
            if (any(numbered == plain(index(plain(:last), ' ', back=.true.) + 1:last))) cycle
            if (has_upright_channel(plain)) cycle
         end if
         if (is_up(word) .or. (is_last .and. any(last_verticals == word))) then
            direction = vertical
         else if (is_sideways(word)) then
            direction = horizontal
         end if
         if (direction /= unknown) return
         is_last = .false.
      end do
      first = index(trim(adjustl(plain)), ' ')
      if (first > 0) then
         if (any(first_verticals == word)) direction = vertical
      end if
   end function direction_of_words

   !> Is one of some words a channel of SEED that is vertical?
   pure logical function has_upright_channel(plain)
      character(len=*), intent(in) :: plain

      integer :: first, last

      has_upright_channel = .false.
      last = len_trim(plain)
      do while (last > 0 .and. .not. has_upright_channel)
         first = index(plain(:last), ' ', back=.true.) + 1
         has_upright_channel = is_channel(plain(first:last), 'z')
         last = len_trim(plain(:first - 1))
      end do
   end function has_upright_channel

   !> Does a word say vertical, wherever it stands?
   pure logical function is_up(word)
      character(len=*), intent(in) :: word

      integer :: i, n

      n = max(len_trim(word) - 2, verify(word, digits, back=.true.))
      is_up = any(verticals == word(:n)) .or. is_channel(word, 'z')
      n = len(word)
      do i = 1, size(stems)
         is_up = is_up .or. index(word, trim(stems(i))) == 1
      end do
      if (is_up .or. n < 4) return
      ! Behind the code of a station, as PEER has B-STUDWN and ICC000UP, or a number, as ESD has 000182za
      is_up = word(n - 2:) == 'dwn' .or. any(glued == word(n - 2:))
      is_up = is_up .or. (word(n - 1:) == 'up' .and. scan(word(n - 2:n - 2), digits) > 0)
      is_up = is_up .or. is_numbered(word, 'z')
   end function is_up

   !> Does a word say horizontal? A number is an azimuth
   pure logical function is_sideways(word)
      character(len=*), intent(in) :: word

      integer :: n, points

      n = len(word)
      points = verify(word//'-', 'nsew') - 1
      is_sideways = points > 0 .and. points <= 2 .and. (n == points .or. (n == points + 1 .and. &
         & scan(word(n:), 'x'//digits) > 0))
      is_sideways = is_sideways .or. (n <= 3 .and. verify(word, digits) == 0)
      is_sideways = is_sideways .or. word == 'x' .or. word == 'y' .or. is_channel(word, 'en123') .or. is_numbered(word, 'xy')
      if (is_sideways) return
      if (n <= 2) is_sideways = scan(word(1:1), 'hlrt') > 0 .and. verify(word(2:), digits) == 0
      ! N90E, S00E
      if (n > 2) is_sideways = scan(word(1:1), 'ns') > 0 .and. scan(word(n:), 'ew') > 0 .and. verify(word(2:n - 1), digits) == 0
   end function is_sideways

   !> Is a word a channel of SEED of some orientations, perhaps with the two figures of its location before or behind it?
   pure logical function is_channel(word, orientations)
      character(len=*), intent(in) :: word
      !> Letters or figures
      character(len=*), intent(in) :: orientations

      integer :: at

      at = 1
      if (len(word) >= 5) at = merge(3, 1, verify(word(:2), digits) == 0)
      is_channel = .false.
      if (len(word) < at + 2 .or. len(word) > at + 4) return
      is_channel = scan(word(at:at), bands) > 0 .and. scan(word(at + 1:at + 1), instruments) > 0 .and. &
         & scan(word(at + 2:at + 2), orientations) > 0 .and. verify(word(at + 3:), digits) == 0
   end function is_channel

   !> Is a word a number of four figures at least with the letter of an axis behind it, and perhaps one of the quantity?
   pure logical function is_numbered(word, axes)
      character(len=*), intent(in) :: word
      character(len=*), intent(in) :: axes

      integer :: figures

      figures = verify(word//'-', digits) - 1
      is_numbered = .false.
      if (figures < 4 .or. len(word) < figures + 1 .or. len(word) > figures + 2) return
      is_numbered = scan(word(figures + 1:figures + 1), axes) > 0 .and. verify(word(figures + 2:), letters) == 0
   end function is_numbered

   !> A text in lower case without accents, with blanks for all but letters and figures
   pure function plain_of(text, with_brackets) result(plain)
      character(len=*), intent(in) :: text
      !> What stands in brackets too?
      logical, intent(in) :: with_brackets
      character(len=len(text)) :: plain

      ! Letters of Turkish, Slovene and French, two bytes each; thorn is what their s becomes in a text that is taken for Latin-1
      character(len=2), parameter :: accented(14) = ['ü', 'Ü', 'ş', 'Ş', 'þ', 'Þ', 'ı', 'İ', 'č', 'Č', 'é', 'É', &
         & 'ó', 'Ó']
      character(len=1), parameter :: bare(14) = ['u', 'U', 's', 'S', 's', 'S', 'i', 'I', 'c', 'C', 'e', 'E', 'o', 'O']
      integer :: at, length, depth, i

      plain = ''
      length = 0
      depth = 0
      at = 0
      do while (at < len(text))
         at = at + 1
         if (scan(text(at:at), '([') > 0 .and. scan(text(at:), ')]') > 0 .and. .not. with_brackets) depth = depth + 1
         ! m/s^2 is m and s2, and the seconds of cm/s/s are no south
         if (text(at:at) == '^') cycle
         if (at > 1) then
            if (text(at - 1:at - 1) == '/' .and. scan(lower(text(at:at)), 's') > 0 .and. &
               & scan(lower(text(at + 1:min(at + 1, len(text)))), letters//digits//'^') == 0) cycle
         end if
         length = length + 1
         if (depth == 0 .and. iachar(text(at:at)) >= 128) then
            plain(length:length) = text(at:at)
            i = 0
            if (at < len(text)) i = findloc(accented, text(at:at + 1), dim=1)
            if (i > 0) then
               plain(length:length) = bare(i)
               at = at + 1
            end if
         else if (depth == 0 .and. scan(lower(text(at:at)), letters//digits) > 0) then
            plain(length:length) = text(at:at)
         end if
         if (scan(text(at:at), ')]') > 0) depth = max(0, depth - 1)
      end do
      plain = lower(plain)
   end function plain_of

end module dondolo_records_direction
