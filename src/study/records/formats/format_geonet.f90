!> Corrected accelerograms of GeoNet, New Zealand (.V2A): for each component 16 lines of text, tables of 40 integers and
!> 60 reals, then accelerations, velocities and displacements, ten a line and eight characters each.
!>
!> Source of all positions: GeoNet, Strong Motion File Formats
!> (geonet.org.nz/data/supplementary/strong_motion_file_formats).
module dondolo_records_format_geonet
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_numbers, only : parse_integer, parse_real
   use dondolo_base_text, only : first_word, lower, to_text
   use dondolo_files_text_file, only : text_file_type
   use dondolo_records_dates, only : find_moment
   use dondolo_records_header_fields, only : field_type, header_type
   use dondolo_records_header_text, only : after, before, leading_number, squeezed, table_type
   use dondolo_records_format, only : block_type, channel_type, raise_at, read_fixed, samples_type, step_tolerance
   implicit none
   private

   public :: recognises_geonet, read_geonet

   !> Lines of a component before its values: text, integers, reals
   integer, parameter :: text_lines = 16, integer_lines = 4, real_lines = 6

   !> Characters of a number, numbers in a line
   integer, parameter :: width = 8, per_line = 10

   !> Positions among the integers: accelerations, velocities, displacements
   integer, parameter :: counts_at(3) = [34, 35, 36]

   !> Position of the time step among the reals
   integer, parameter :: step_at = 26

   !> Lines of text, from the first of a component: count, step, component, peak
   integer, parameter :: count_line = 9, step_line = 10, component_line = 12, peak_line = 13

   !> What the header says of the station
   type(field_type), parameter :: sites(6) = [ &
      & field_type('time', line=8), &
      & field_type('station', 'site', 'word', line=2), &
      & field_type('station name', line=3), &
      & field_type('site', 'site', line=2), &
      & field_type('component', 'component', 'word', line=component_line + 1), &
      & field_type('magnitude', form='nonzero', real_at=15)]

   !> All other fields
   type(field_type), parameter :: others(9) = [ &
      & field_type('processing', lead='corrected;', line=12), &
      & field_type('processed', 'processed', line=6), &
      & field_type('accelerogram', 'accelerogram', 'word', line=1), &
      & field_type('source', 'accelerogram', line=1, then='_'), &
      & field_type('instrument', 'instrument', 'as is', line=4), &
      & field_type('resolution', 'resolution:', line=5), &
      & field_type('place', line=7), &
      & field_type('epicentral distance', form='nonzero', integer_at=30), &
      & field_type('component direction', integer_at=28)]

contains

   !> Is a text in this format? It begins with an accelerogram and a site
   logical function recognises_geonet(text) result(recognised)
      type(text_file_type), intent(in) :: text

      recognised = scan(lower(adjustl(text%line(1))), 'cu') == 1 .and. &
         & index(lower(text%line(1)), 'corrected accelerogram') > 0 .and. &
         & index(lower(adjustl(text%line(2))), 'site ') == 1
   end function recognises_geonet

   !> Read a GeoNet file
   subroutine read_geonet(text, samples, error)
      type(text_file_type), intent(in) :: text
      !> What it says
      type(samples_type), intent(out) :: samples
      !> What is wrong, with file and line
      type(error_type), allocatable, intent(out) :: error

      type(channel_type), allocatable :: longer(:)
      integer :: first, next, i

      allocate (samples%channels(0))
      first = 1
      do while (first <= text%lines())
         allocate (longer(size(samples%channels) + 1))
         do i = 1, size(samples%channels)
            longer(i) = samples%channels(i)
         end do
         call read_component(text, first, next, longer(size(longer)), error)
         if (allocated(error)) return
         call move_alloc(longer, samples%channels)
         first = next
      end do
   end subroutine read_geonet

   !> Read a component
   subroutine read_component(text, first, next, channel, error)
      type(text_file_type), intent(in) :: text
      !> Its first line
      integer, intent(in) :: first
      !> Line after its last
      integer, intent(out) :: next
      type(channel_type), intent(out) :: channel
      !> What is wrong, with file and line
      type(error_type), allocatable, intent(out) :: error

      type(header_type) :: header
      real(wp), allocatable :: others(:)
      integer :: counts(3), i

      next = first
      if (index(lower(adjustl(text%line(first))), 'corrected accelerogram') /= 1) then
         call raise_at(error, text, first, ''''//squeezed(text%line(first))//''': must be a Corrected accelerogram')
         return
      end if
      header%first_line = first
      header%last_line = first + text_lines - 1
      header%integers = table_type(first_line=first + text_lines, per_line=per_line, width=width, count=integer_lines*per_line)
      header%reals = table_type(first_line=header%integers%next_line(), per_line=per_line, width=width, &
         & count=real_lines*per_line)
      call read_counts(text, first, header%integers, counts, error)
      if (allocated(error)) return
      call read_step(text, first, header%reals, channel%dt, error)
      if (allocated(error)) return
      next = header%reals%next_line()
      call read_fixed(text, block_type(next, counts(1), width, per_line), channel%values, error, next, channel%metadata)
      if (allocated(error)) return
      ! Read, so that a count that is wrong does not go unseen
      do i = 2, 3
         call read_fixed(text, block_type(next, counts(i), width, per_line), others, error, next)
         if (allocated(error)) return
      end do
      call read_header(text, first, header, channel)
   end subroutine read_component

   !> Read the numbers of accelerations, velocities and displacements
   subroutine read_counts(text, first, integers, counts, error)
      type(text_file_type), intent(in) :: text
      !> First line of the component
      integer, intent(in) :: first
      !> The table of integers
      type(table_type), intent(in) :: integers
      !> The numbers
      integer, intent(out) :: counts(3)
      !> They are not known, or that of accelerations is another in words
      type(error_type), allocatable, intent(out) :: error

      integer :: i, in_words
      logical :: ok

      counts = 0
      do i = 1, 3
         call integers%integer_of(text, counts_at(i), counts(i), ok)
         if (ok .and. counts(i) >= merge(1, 0, i == 1) .and. counts(i) <= len(text%text)) cycle
         call raise_at(error, text, integers%line_of(counts_at(i)), 'number of values = '''// &
            & integers%field(text, counts_at(i))//''': must be a positive integer, and the values must be there')
         return
      end do
      call parse_integer(leading_number(after(text%line(first + count_line), 'number of points')), in_words, ok)
      if (ok .and. in_words == counts(1)) return
      call raise_at(error, text, first + count_line, ''''//squeezed(text%line(first + count_line))// &
         & ''': the table of integers states '//to_text(counts(1))//' accelerations')
   end subroutine read_counts

   !> Read the time step
   subroutine read_step(text, first, reals, dt, error)
      type(text_file_type), intent(in) :: text
      !> First line of the component
      integer, intent(in) :: first
      !> The table of reals
      type(table_type), intent(in) :: reals
      !> Time step [s]
      real(wp), intent(out) :: dt
      !> It is not known, or another in words
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: in_words
      logical :: ok

      call parse_real(reals%field(text, step_at), dt, ok)
      if (.not. (ok .and. dt > 0.0_wp)) then
         call raise_at(error, text, reals%line_of(step_at), 'time step = '''//reals%field(text, step_at)// &
            & ''': must be positive')
         return
      end if
      call parse_real(leading_number(after(text%line(first + step_line), ' at ')), in_words, ok)
      if (ok .and. abs(in_words - dt) <= step_tolerance*dt) return
      call raise_at(error, text, first + step_line, ''''//squeezed(text%line(first + step_line))// &
         & ''': the table of reals states a time step of '//to_text(dt)//' s')
   end subroutine read_step

   !> Keep what the header of a component says
   subroutine read_header(text, first, header, channel)
      type(text_file_type), intent(in) :: text
      !> First line of the component
      integer, intent(in) :: first
      type(header_type), intent(in) :: header
      type(channel_type), intent(inout) :: channel

      character(len=:), allocatable :: line, moment, station

      channel%name = first_word(after(text%line(first + component_line), 'component'), ' ')
      channel%peak_line = first + peak_line
      line = after(text%line(channel%peak_line), 'peak')
      channel%peak = leading_number(line)
      channel%units = before(after(line, channel%peak), ' at')
      associate (metadata => channel%metadata)
         call metadata%set('epicentre', squeezed(text%line(first + 8)))
         call find_origin(moment)
         call metadata%set('date', moment)
         call metadata%set('event time', moment)
         line = after(text%line(first + 8), 'epicentre')
         call metadata%set('event latitude', coordinate(line, 1, nonzero(header%reals%field(text, 13))))
         call metadata%set('event longitude', coordinate(line, 2, nonzero(header%reals%field(text, 14))))
         call header%keep(text, sites, metadata)
         line = metadata%get('site')
         station = first_word(line, ' ')
         call metadata%set('latitude', coordinate(after(line, station), 1, header%reals%field(text, 11)))
         call metadata%set('longitude', coordinate(after(line, station), 2, header%reals%field(text, 12)))
         call header%keep(text, others, metadata)
         call metadata%set('axis', squeezed(after(after(text%line(first + component_line), 'component'), channel%name)))
      end associate

   contains

      !> A coordinate, with the sign that its letter gives it
      function coordinate(place, which, printed) result(signed)
         !> Latitude and longitude in words: 39 56 38S  176 35 04E
         character(len=*), intent(in) :: place
         !> 1 latitude, 2 longitude
         integer, intent(in) :: which
         !> The coordinate in degrees; south and west may stand without sign
         character(len=*), intent(in) :: printed
         !> The coordinate, positive north and east, filled up with blanks; empty if there is no letter
         character(len=len(printed) + 1) :: signed

         character(len=:), allocatable :: rest, word
         integer :: i

         signed = ''
         word = ''
         rest = place
         ! Degrees, minutes, seconds and the letter, twice
         do i = 1, 3*which
            word = first_word(rest, ' ')
            rest = after(rest, word)
         end do
         if (len(word) == 0 .or. len(printed) == 0) return
         select case (lower(word(len(word):)))
         case ('n', 'e')
            signed = printed
         case ('s', 'w')
            signed = printed
            if (printed(1:1) /= '-') signed = '-'//printed
         end select
      end function coordinate

      !> Find the time of the earthquake
      subroutine find_origin(moment)
         !> Date and time as ISO 8601 has them: those of the table of integers, or else those in words
         character(len=:), allocatable, intent(out) :: moment

         integer :: number(6), i
         logical :: ok
         character(len=24) :: buffer
         character(len=:), allocatable :: stated

         call find_moment(text%line(first + 7), 'dmy', moment)
         ! Year, month, day, hour, minute, tenths of a second
         do i = 1, 6
            call header%integers%integer_of(text, i, number(i), ok)
            if (.not. ok) return
         end do
         if (any(number < 0) .or. any(number > 9999) .or. any(number(2:5) > 60)) return
         write (buffer, '(i4.4, a, i2.2, a, i2.2, a, i2.2, a, i2.2, a, i2.2, a, i1)') number(1), '-', number(2), '-', &
            & number(3), 'T', number(4), ':', number(5), ':', min(number(6)/10, 99), '.', modulo(number(6), 10)
         call find_moment(buffer, 'dmy', stated)
         if (len(stated) > 0) moment = stated
      end subroutine find_origin

   end subroutine read_header

   !> A number that is zero where it is not known
   pure function nonzero(printed)
      !> The number
      character(len=*), intent(in) :: printed
      !> The same, empty if it is zero
      character(len=merge(len(printed), 0, verify(printed, '0.') > 0)) :: nonzero

      nonzero = printed
   end function nonzero

end module dondolo_records_format_geonet
