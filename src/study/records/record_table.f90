!> Records at a glance: a table with what they are, how strong, how long, and what looks odd about them.
module dondolo_records_record_table
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_order, only : make_order
   use dondolo_base_plain, only : visible
   use dondolo_base_text, only : left, lower, rounded, to_text
   use dondolo_record, only : record_type
   use dondolo_record_dead_channel, only : check_motion
   use dondolo_record_ground_motion, only : ground_velocity, peak_velocity
   use dondolo_records_direction, only : is_vertical
   implicit none
   private

   public :: record_table, find_problems, pga_limit, describe_pga, pace_limit, describe_pace, start_limit, describe_start
   public :: set_is_quick, least_median_pace, is_of_shake_table

   !> First acceleration that is odd, as a part of the peak: the recorder was triggered late
   real(wp), parameter :: abrupt = 0.1_wp

   !> Last velocity that is odd, as a part of the peak: the baseline was not corrected
   real(wp), parameter :: drifted = 0.1_wp

   !> Samples in a row at the peak that are odd: the recorder reached its limit
   integer, parameter :: clipped = 4

   !> PGA that hardly any accelerograph has measured, or that nobody would use [g]: the units may be wrong
   real(wp), parameter :: strongest = 3.0_wp, weakest = 0.005_wp

   !> PGV / PGA that hardly any earthquake has [s], and its least median in a set: the time step may be wrong. Measured values
   !> are in docs/ground_motions.md
   real(wp), parameter :: slowest = 0.5_wp, quickest = 0.015_wp, least_median_pace = 0.03_wp

   !> Fewest records that are a set: one alone does not decide their median
   integer, parameter :: fewest_of_set = 3

   !> Widest column of names, and of events and stations
   integer, parameter :: widest = 40

contains

   !> A table of records
   function record_table(records, gravity, measure, unit, values) result(table)
      type(record_type), intent(in) :: records(:)
      !> What g is [m/s2]
      real(wp), intent(in) :: gravity
      !> Name and unit of an intensity measure to show as well, and its values
      character(len=*), intent(in), optional :: measure, unit
      real(wp), intent(in), optional :: values(:)
      !> Its lines, two of titles first
      type(lines_type) :: table

      character(len=60) :: numbers
      character(len=:), allocatable :: column, problems
      integer :: i, width, origins, measures

      width = 6
      origins = 0
      measures = 0
      if (present(values)) measures = max(len(measure), len(unit), 10) + 1
      allocate (character(len=measures) :: column)
      do i = 1, size(records)
         width = min(max(width, len(records(i)%name)), widest)
         origins = max(origins, len_trim(origin(records(i))))
      end do
      if (origins > 0) origins = min(max(origins, len('event, station')), widest)
      if (present(values)) column = repeat(' ', measures - len(measure))//measure
      write (numbers, '(a9, a10, a10, a11, a10)') 'samples', 'dt', 'length', 'PGA', 'PGV'
      call table%add('  no.  '//left('record', width)//trim(numbers)//column// &
         & titled('event, station', origins)//'  problems')
      write (numbers, '(a9, a10, a10, a11, a10)') '', 's', 's', 'g', 'cm/s'
      if (present(values)) column = repeat(' ', measures - len(unit))//unit
      call table%add('       '//left('', width)//trim(numbers)//column)
      do i = 1, size(records)
         associate (record => records(i))
            write (numbers, '(i9, f10.5, f10.2, f11.4, f10.2)') size(record%acceleration), record%dt, &
               & record%duration(), record%pga()/gravity, 100.0_wp*peak_velocity(record)
            if (present(values)) write (column, '(f'//to_text(measures)//'.4)') values(i)
            call find_problems(record, gravity, problems)
            call table%add(trim(visible(numbered(i)//narrowed(record%name, width)//trim(numbers)//column// &
               & titled(origin(record), origins)//'  '//problems)))
         end associate
      end do
   end function record_table

   !> A name in its column; of a longer one the beginning and the end, since names of records often differ in their ends
   pure function narrowed(name, width)
      character(len=*), intent(in) :: name
      !> Width of the column [bytes], more than 3
      integer, intent(in) :: width
      character(len=width) :: narrowed

      integer :: head, tail

      narrowed = name
      if (len(name) <= width) return
      head = (width - 3)/2
      tail = len(name) - (width - 3 - head) + 1
      ! Not in the middle of a character
      do while (head > 0 .and. is_continued(name(head + 1:head + 1)))
         head = head - 1
      end do
      do while (tail < len(name) .and. is_continued(name(tail:tail)))
         tail = tail + 1
      end do
      narrowed = name(:head)//'...'//name(tail:)

   contains

      !> Whether a byte continues a character of UTF-8
      pure logical function is_continued(byte)
         character(len=1), intent(in) :: byte

         is_continued = iachar(byte) >= 128 .and. iachar(byte) < 192
      end function is_continued

   end function narrowed

   !> What looks odd about a record
   subroutine find_problems(record, gravity, problems)
      type(record_type), intent(in) :: record
      !> What g is [m/s2]
      real(wp), intent(in) :: gravity
      !> Sentences separated by semicolons, empty if nothing does
      character(len=:), allocatable, intent(out) :: problems

      real(wp) :: velocity(size(record%acceleration)), peak
      real(wp) :: pga
      character(len=:), allocatable :: sentence
      type(error_type), allocatable :: error
      integer :: n, run, longest, i

      problems = record%metadata%get('reading')
      n = size(record%acceleration)
      pga = record%pga()
      if (is_vertical(record%metadata, record%name)) call append('a vertical component')
      call check_motion(record, error)
      if (allocated(error)) then
         call append('no motion')
         return
      end if
      if (pga_limit(pga/gravity) > 0.0_wp) then
         call describe_pga(pga/gravity, pga_limit(pga/gravity), sentence)
         call append(sentence)
      end if
      if (start_limit(abs(record%acceleration(1))/pga) > 0.0_wp) then
         call describe_start(abs(record%acceleration(1))/pga, sentence)
         call append(sentence)
      end if
      velocity = ground_velocity(record)
      peak = peak_velocity(record)
      if (abs(velocity(n)) > drifted*peak) call append('ends at '// &
         & to_text(nint(100.0_wp*(abs(velocity(n))/peak)))//' % of its PGV')
      if (pace_limit(peak/pga) > 0.0_wp .and. .not. is_of_shake_table(record)) then
         call describe_pace(peak/pga, pace_limit(peak/pga), sentence)
         call append(sentence)
      end if
      run = 0
      longest = 0
      do i = 1, n
         run = run + 1
         if (abs(record%acceleration(i)) < pga) run = 0
         longest = max(longest, run)
      end do
      if (longest >= clipped) call append(to_text(longest)//' samples in a row at its PGA')

   contains

      !> Append a sentence
      subroutine append(sentence)
         !> The sentence
         character(len=*), intent(in) :: sentence

         if (len(problems) > 0) problems = problems//'; '
         problems = problems//sentence
      end subroutine append

   end subroutine find_problems

   !> The limit that the PGA of a record that moves is beyond; 0 if it is beyond none
   pure real(wp) function pga_limit(pga)
      !> PGA [g]
      real(wp), intent(in) :: pga

      pga_limit = 0.0_wp
      if (pga > strongest) pga_limit = strongest
      if (pga < weakest) pga_limit = weakest
   end function pga_limit

   !> What looks odd about a PGA
   pure subroutine describe_pga(pga, limit, text)
      !> PGA [g]
      real(wp), intent(in) :: pga
      !> The limit that it is beyond [g]
      real(wp), intent(in) :: limit
      !> A sentence
      character(len=:), allocatable, intent(out) :: text

      text = ' g, more than '
      if (pga < limit) text = ' g, less than '
      text = 'a PGA of '//rounded(pga)//text//to_text(limit)//' g: wrong units?'
   end subroutine describe_pga

   !> The limit that the first acceleration / PGA of a record that moves is beyond; 0 if it is not
   pure real(wp) function start_limit(share)
      !> Size of the first acceleration / PGA
      real(wp), intent(in) :: share

      start_limit = 0.0_wp
      if (share > abrupt) start_limit = abrupt
   end function start_limit

   !> What looks odd about the first acceleration
   pure subroutine describe_start(share, text)
      !> Its size / PGA
      real(wp), intent(in) :: share
      !> A sentence
      character(len=:), allocatable, intent(out) :: text

      text = 'begins at '//to_text(nint(100.0_wp*share))//' % of its PGA'
   end subroutine describe_start

   !> The limit that PGV / PGA of a record that moves is beyond [s]; 0 if it is beyond none
   pure real(wp) function pace_limit(ratio)
      !> PGV / PGA [s]
      real(wp), intent(in) :: ratio

      pace_limit = 0.0_wp
      if (ratio > slowest) pace_limit = slowest
      if (ratio < quickest) pace_limit = quickest
   end function pace_limit

   !> Whether the metadata of a record say that it is the motion of a shake table, which is often quicker than an earthquake
   elemental logical function is_of_shake_table(record)
      type(record_type), intent(in) :: record

      is_of_shake_table = lower(record%metadata%get('motion')) == 'shake table'
   end function is_of_shake_table

   !> Is the median of PGV / PGA lower than that of any set of records?
   pure subroutine set_is_quick(ratios, is_quick, median)
      !> PGV / PGA of each record that moves [s]
      real(wp), intent(in) :: ratios(:)
      !> It is
      logical, intent(out) :: is_quick
      !> The median [s], 0 if there are too few records
      real(wp), intent(out) :: median

      integer, allocatable :: order(:)
      integer :: n

      is_quick = .false.
      median = 0.0_wp
      n = size(ratios)
      if (n < fewest_of_set) return
      call make_order(ratios, order)
      median = 0.5_wp*(ratios(order((n + 1)/2)) + ratios(order(n/2 + 1)))
      is_quick = median < least_median_pace
   end subroutine set_is_quick

   !> What looks odd about PGV / PGA
   pure subroutine describe_pace(ratio, limit, text)
      !> PGV / PGA [s]
      real(wp), intent(in) :: ratio
      !> The limit that it is beyond [s]
      real(wp), intent(in) :: limit
      !> A sentence
      character(len=:), allocatable, intent(out) :: text

      text = 'PGV / PGA = '//rounded(ratio)//' s, '
      if (ratio < limit) text = text//'less than '//to_text(limit)//' s: wrong time step?'
      if (ratio > limit) text = text//'more than '//to_text(limit)//' s: wrong time step, or a baseline that drifts?'
   end subroutine describe_pace

   !> Event and station of a record, as far as its file names them and they fit
   pure function origin(record)
      type(record_type), intent(in) :: record
      !> Event (or date) and station, empty if neither is known
      character(len=widest) :: origin

      character(len=:), allocatable :: event, station

      event = record%metadata%get('event')
      if (len(event) == 0) event = record%metadata%get('date')
      station = record%metadata%get('station')
      if (len(event) > 0 .and. len(station) > 0) event = event//', '
      origin = event//station
   end function origin

   !> A number of a row
   pure function numbered(i)
      !> Number
      integer, intent(in) :: i
      !> The number and two blanks
      character(len=7) :: numbered

      write (numbered, '(i5, 2x)') i
   end function numbered

   !> A column that is left out where it has no width
   pure function titled(text, width)
      !> Text
      character(len=*), intent(in) :: text
      !> Width, 0 for none
      integer, intent(in) :: width
      !> Two blanks and the text, or nothing
      character(len=merge(width + 2, 0, width > 0)) :: titled

      titled = '  '//text
   end function titled

end module dondolo_records_record_table
