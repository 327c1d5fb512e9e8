!> Warnings of motions: levels that no ground motion has, large or wrong scale factors, records without motion.
module dondolo_case_motion_warnings
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : rounded, to_text
   use dondolo_base_warning, only : warning_type, warnings_type
   use dondolo_fragility_stripes, only : mark_lifts, stripes_type
   use dondolo_fragility_study, only : study_type
   use dondolo_record, only : record_type
   use dondolo_record_suite, only : suite_type
   use dondolo_records_direction, only : find_direction
   use dondolo_records_record_table, only : describe_pace, describe_pga, describe_start, is_of_shake_table, &
      & least_median_pace, pace_limit, pga_limit, set_is_quick, start_limit
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: scale_warnings_type, warn_of_fall, warn_of_records

   !> Codes
   character(len=*), parameter :: levels_above_usual = 'levels_above_usual', scale_factors_large = 'scale_factors_large', &
      & factors_off_levels = 'factors_off_levels', vertical_beyond_g = 'vertical_beyond_g', &
      & record_without_motion = 'record_without_motion', record_pga = 'record_pga', record_pgv_pga = 'record_pgv_pga', &
      & records_pgv_pga = 'records_pgv_pga', record_start = 'record_start', record_vertical = 'record_vertical'

   !> A record scaled by more than this hardly is the earthquake it was
   real(wp), parameter :: large_scale = 10.0_wp
   !> A factor that is given may take a record so far from its level
   real(wp), parameter :: off_level = 1.1_wp

   !> Parts of sentences that two warnings share
   character(len=*), parameter :: falls = 'the ground accelerates downwards by more than g', &
      & without_support = ': it leaves the wall without support, which the model does not describe'

   !> Levels that no ground motion has: of the PGA and of spectral accelerations [g], of the others [m/s, m]
   real(wp), parameter :: largest_pga = 4.0_wp, largest_sa = 10.0_wp, largest_pgv = 5.0_wp, largest_pgd = 5.0_wp, &
      & largest_hi = 25.0_wp, largest_cav = 200.0_wp, largest_arias = 100.0_wp

   !> Levels and scale factors looked at, and what to warn of
   type :: scale_warnings_type
      !> Largest level, its measure, and what is usual; 0: anything
      real(wp) :: highest = 0.0_wp, usual = 0.0_wp
      character(len=:), allocatable :: im
      !> Histories looked at
      integer(int64) :: histories = 0
      !> Histories with a large factor
      integer(int64) :: large = 0
      !> The largest factor
      real(wp) :: largest = 0.0_wp
      !> Its level
      real(wp) :: level = 0.0_wp
      !> Its record
      character(len=:), allocatable :: record
      !> Histories in which the ground falls away from the wall, and level and record of the first
      integer(int64) :: lifting = 0
      real(wp) :: lifting_level = 0.0_wp
      character(len=:), allocatable :: lifting_record
      !> Factors that are given, how many of them take a record far from its level, and the farthest: how many times the level,
      !> the level, and the record
      integer(int64) :: given = 0, off = 0
      real(wp) :: farthest = 1.0_wp, missed = 0.0_wp
      character(len=:), allocatable :: off_record
   contains
      !> Look at the levels and factors of a wall
      procedure :: look
      !> Look at levels or factors alone
      procedure :: look_at_levels, look_at_factors
      !> Warn, if there is reason to
      procedure :: warn
   end type scale_warnings_type

contains

   !> Look at levels: does a ground motion have them?
   subroutine look_at_levels(self, im, levels)
      class(scale_warnings_type), intent(inout) :: self
      !> Name of the measure
      character(len=*), intent(in) :: im
      !> Levels of it, in its unit
      real(wp), intent(in) :: levels(:)

      if (.not. maxval(levels) > self%highest) return
      self%highest = maxval(levels)
      self%im = im
      if (im == 'pga') self%usual = largest_pga
      if (im == 'pgv') self%usual = largest_pgv
      if (im == 'pgd') self%usual = largest_pgd
      if (im == 'hi') self%usual = largest_hi
      if (im == 'cav' .or. im == 'cav-trapz') self%usual = largest_cav
      if (im == 'arias' .or. im == 'arias-trapz') self%usual = largest_arias
      if (im(:min(2, len(im))) == 'sa') self%usual = largest_sa
   end subroutine look_at_levels

   !> Look at the levels and factors of a wall
   subroutine look(self, stripes, study, wall)
      class(scale_warnings_type), intent(inout) :: self
      !> Stripes of the wall
      type(stripes_type), intent(in) :: stripes
      type(study_type), intent(in) :: study
      type(wall_type), intent(in) :: wall

      integer :: largest

      call self%look_at_levels(stripes%im, stripes%levels)
      if (allocated(study%factor)) call look_at_given(self, study, wall)
      if (any(study%suite%falls > 0.0_wp)) call look_at_falls(self, stripes, study%suite, wall%gravity)
      call self%look_at_factors(stripes, largest)
      if (largest > 0) self%record = study%suite%records(stripes%record(largest))%name
   end subroutine look

   !> Look at the factors of a wall's histories; the name of the record of the largest is left to the caller
   subroutine look_at_factors(self, stripes, largest)
      class(scale_warnings_type), intent(inout) :: self
      !> Stripes of the wall
      type(stripes_type), intent(in) :: stripes
      !> Number of the history whose factor is the largest of all that were looked at, 0 if none of these is
      integer, intent(out) :: largest

      integer :: at(2)

      largest = 0
      self%histories = self%histories + count(stripes%ran, kind=int64)
      self%large = self%large + count(stripes%scale > large_scale, kind=int64)
      at = maxloc(stripes%scale)
      if (.not. stripes%scale(at(1), at(2)) > self%largest) return
      self%largest = stripes%scale(at(1), at(2))
      self%level = stripes%levels(at(2))
      largest = at(1)
   end subroutine look_at_factors

   !> Look at the factors that are given: do they take the records to their levels?
   subroutine look_at_given(self, study, wall)
      class(scale_warnings_type), intent(inout) :: self
      type(study_type), intent(in) :: study
      type(wall_type), intent(in) :: wall

      real(wp) :: expected(size(study%values)), times
      integer :: i, j

      do j = 1, size(study%levels)
         expected = study%scaling%factors(study%levels(j), study%values, wall)
         do i = 1, size(study%factor, 1)
            if (.not. (study%factor(i, j) > 0.0_wp .and. expected(i) > 0.0_wp)) cycle
            self%given = self%given + 1
            times = (study%factor(i, j)/expected(i))**study%scaling%measure%power()
            if (max(times, 1.0_wp/times) <= off_level) cycle
            self%off = self%off + 1
            if (max(times, 1.0_wp/times) <= max(self%farthest, 1.0_wp/self%farthest)) cycle
            self%farthest = times
            self%missed = study%levels(j)
            self%off_record = study%suite%records(i)%name
         end do
      end do
   end subroutine look_at_given

   !> Look at histories in which the ground falls away from the wall
   subroutine look_at_falls(self, stripes, suite, gravity)
      type(scale_warnings_type), intent(inout) :: self
      !> Stripes of the wall
      type(stripes_type), intent(in) :: stripes
      !> Its accelerograms
      type(suite_type), intent(in) :: suite
      !> What g is for the wall [m/s2]
      real(wp), intent(in) :: gravity

      logical, allocatable :: lifts(:, :)
      integer :: j

      call mark_lifts(stripes, suite%falls, gravity, lifts)
      do j = 1, size(stripes%levels)
         if (self%lifting == 0 .and. any(lifts(:, j))) then
            self%lifting_level = stripes%levels(j)
            self%lifting_record = suite%records(stripes%record(findloc(lifts(:, j), .true., dim=1)))%name
         end if
         self%lifting = self%lifting + count(lifts(:, j), kind=int64)
      end do
   end subroutine look_at_falls

   !> Warn, if there is reason to
   subroutine warn(self, warnings)
      class(scale_warnings_type), intent(in) :: self
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      if (self%usual > 0.0_wp .and. self%highest > self%usual) call warn_of_levels(self, warnings)
      if (self%lifting > 0) call warn_of_lifts(self, warnings)
      if (self%off > 0) call warn_of_given(self, warnings)
      if (self%large > 0) call warn_of_scales(self, warnings)
   end subroutine warn

   !> Warn of levels that no ground motion has
   subroutine warn_of_levels(self, warnings)
      type(scale_warnings_type), intent(in) :: self
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning
      character(len=:), allocatable :: question

      if (self%im == 'pgd' .or. self%im == 'hi') then
         question = ' m: are they in cm?'
      else if (self%im(:min(2, len(self%im))) /= 'sa' .and. self%im /= 'pga') then
         question = ' m/s: are they in cm/s?'
      else if (self%highest >= 10.0_wp) then
         question = ' g: are they in m/s2, cm/s2 or per cent of g?'
      else
         question = ' g: are they in m/s2 or cm/s2?'
      end if
      warning = warning_type(levels_above_usual)
      call warning%about('im', self%im)
      call warning%with('largest', self%highest)
      call warning%with('limit', self%usual)
      call warnings%add(warning, 'levels up to '//rounded(self%highest)//' of '//self%im//', more than '// &
         & to_text(self%usual)//question)
   end subroutine warn_of_levels

   !> Warn of histories in which the ground falls away from the wall
   subroutine warn_of_lifts(self, warnings)
      type(scale_warnings_type), intent(in) :: self
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning

      warning = warning_type(vertical_beyond_g)
      call warning%about('record', self%lifting_record)
      call warning%with('histories_beyond', self%lifting)
      call warning%with('histories', self%histories)
      call warning%with('level', self%lifting_level)
      call warnings%add(warning, fall_sentence(' in '//to_text(self%lifting)//' of '//to_text(self%histories)// &
         & ' histories (record '''//self%lifting_record//''' from level '//rounded(self%lifting_level)//' on)'))
   end subroutine warn_of_lifts

   !> Warn of a motion in which the ground falls away from the wall
   subroutine warn_of_fall(record, scale, gravity, warnings)
      type(record_type), intent(in) :: record
      !> Factor on it
      real(wp), intent(in) :: scale
      !> What g is [m/s2]
      real(wp), intent(in) :: gravity
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning

      if (.not. abs(scale)*record%largest_fall() >= gravity) return
      warning = warning_type(vertical_beyond_g)
      call warning%about('record', record%name)
      call warnings%add(warning, fall_sentence(' (record '''//record%name//''')'))
   end subroutine warn_of_fall

   !> Sentence of a ground that falls away from the wall
   pure function fall_sentence(where) result(text)
      !> In which histories
      character(len=*), intent(in) :: where
      character(len=len(falls) + len(where) + len(without_support)) :: text

      text = falls//where//without_support
   end function fall_sentence

   !> Warn of given factors that take records off their levels
   subroutine warn_of_given(self, warnings)
      type(scale_warnings_type), intent(in) :: self
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      real(wp), parameter :: limit = 100.0_wp*(off_level - 1.0_wp)
      type(warning_type) :: warning

      warning = warning_type(factors_off_levels)
      call warning%about('record', self%off_record)
      call warning%about('im', self%im)
      call warning%with('limit', limit)
      call warning%with('factors_beyond', self%off)
      call warning%with('factors', self%given)
      call warning%with('value', self%farthest*self%missed)
      call warning%with('level', self%missed)
      call warnings%add(warning, 'given factors scale records more than '//rounded(limit)//' % off their levels: '// &
         & to_text(self%off)//' of '//to_text(self%given)//'; record '''//self%off_record//''' has '//self%im//' = '// &
         & rounded(self%farthest*self%missed)//' at level '//rounded(self%missed))
   end subroutine warn_of_given

   !> Warn of large scale factors
   subroutine warn_of_scales(self, warnings)
      type(scale_warnings_type), intent(in) :: self
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning

      warning = warning_type(scale_factors_large)
      call warning%about('record', self%record)
      call warning%with('limit', large_scale)
      call warning%with('histories_beyond', self%large)
      call warning%with('histories', self%histories)
      call warning%with('largest', self%largest)
      call warning%with('level', self%level)
      call warnings%add(warning, 'scale factors above '//to_text(large_scale)//' in '//to_text(self%large)//' of '// &
         & to_text(self%histories)//' histories, the largest '//rounded(self%largest)//' (record '''//self%record// &
         & ''' at level '//rounded(self%level)//')')
   end subroutine warn_of_scales

   !> Warn of records without motion, of those whose PGA or PGV / PGA no accelerograph has measured, and of those that begin
   !> in the middle of the motion
   subroutine warn_of_records(suite, gravity, warnings, number, moves)
      type(suite_type), intent(in) :: suite
      !> What g is [m/s2]
      real(wp), intent(in) :: gravity
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings
      !> Number of the one record to look at; all if absent
      integer, intent(in), optional :: number
      !> Whether the wall moves at the start, so that it may be meant to rock freely; no, if absent
      logical, intent(in), optional :: moves

      type(warning_type) :: warning
      character(len=:), allocatable :: text
      real(wp) :: pga, pace, ratio
      integer :: first, last, i, beyond(3), strange(3)

      first = 1
      last = size(suite%records)
      if (present(number)) then
         first = number
         last = number
      end if
      beyond = 0
      strange = 0
      do i = first, last
         pga = suite%peaks(i)/gravity
         if (.not. pga > 0.0_wp) then
            if (present(moves)) then
               if (moves) cycle
            end if
            warning = warning_type(record_without_motion)
            call warning%about('record', suite%records(i)%name)
            call warnings%add(warning, 'record '''//suite%records(i)%name//''' has a PGA of 0: it cannot be scaled and '// &
               & 'moves no wall')
            cycle
         end if
         pace = pace_limit(suite%velocities(i)/suite%peaks(i))
         if (is_of_shake_table(suite%records(i))) pace = 0.0_wp
         where ([pga_limit(pga), pace, start_limit(start_of(i))] > 0.0_wp)
            strange = merge(i, strange, beyond == 0)
            beyond = beyond + 1
         end where
      end do
      if (beyond(1) > 0) then
         pga = suite%peaks(strange(1))/gravity
         warning = warning_type(record_pga)
         call warning%about('record', suite%records(strange(1))%name)
         call warning%with('pga_g', pga)
         call warning%with('limit_g', pga_limit(pga))
         call describe_pga(pga, pga_limit(pga), text)
         call add_first(warning, suite%records(strange(1))%name, text, beyond(1), last - first + 1, warnings)
      end if
      if (beyond(2) > 0) then
         ratio = suite%velocities(strange(2))/suite%peaks(strange(2))
         warning = warning_type(record_pgv_pga)
         call warning%about('record', suite%records(strange(2))%name)
         call warning%with('ratio_s', ratio)
         call warning%with('limit_s', pace_limit(ratio))
         call describe_pace(ratio, pace_limit(ratio), text)
         call add_first(warning, suite%records(strange(2))%name, text, beyond(2), last - first + 1, warnings)
      end if
      if (.not. present(number)) call warn_of_set(suite, warnings)
      call warn_of_verticals(suite, first, last, warnings)
      if (beyond(3) > 0) then
         ratio = start_of(strange(3))
         warning = warning_type(record_start)
         call warning%about('record', suite%records(strange(3))%name)
         call warning%with('share', ratio)
         call warning%with('limit', start_limit(ratio))
         call describe_start(ratio, text)
         call add_first(warning, suite%records(strange(3))%name, text//': triggered late, or cut?', beyond(3), &
            & last - first + 1, warnings)
      end if

   contains

      !> Size of the first acceleration of a record / PGA
      pure real(wp) function start_of(i)
         !> Its number
         integer, intent(in) :: i

         start_of = abs(suite%records(i)%acceleration(1))/suite%peaks(i)
      end function start_of

   end subroutine warn_of_records

   !> Warn of records that are vertical components, by which a wall is moved as if they were horizontal
   subroutine warn_of_verticals(suite, first, last, warnings)
      type(suite_type), intent(in) :: suite
      !> The records to look at
      integer, intent(in) :: first, last
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning
      character(len=:), allocatable :: key, shown
      integer :: direction, strange, beyond

      beyond = count(suite%is_vertical(first:last))
      if (beyond == 0) return
      strange = first - 1 + findloc(suite%is_vertical(first:last), .true., dim=1)
      call find_direction(suite%records(strange)%metadata, suite%records(strange)%name, direction, key, shown)
      warning = warning_type(record_vertical)
      call warning%about('record', suite%records(strange)%name)
      call add_first(warning, suite%records(strange)%name, 'is a vertical component, by '''//shown//''', and moves the wall '// &
         & 'as if it were horizontal: leave it out, or name it in the column vertical of the catalogue', beyond, &
         & last - first + 1, warnings)
   end subroutine warn_of_verticals

   !> Warn of records whose PGV / PGA is too low all in all, though that of each might be
   subroutine warn_of_set(suite, warnings)
      type(suite_type), intent(in) :: suite
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning
      real(wp) :: median
      logical :: is_quick
      integer :: first

      associate (moves => suite%peaks > 0.0_wp .and. .not. is_of_shake_table(suite%records))
         call set_is_quick(pack(suite%velocities, moves)/pack(suite%peaks, moves), is_quick, median)
         if (.not. is_quick) return
         first = findloc(moves, .true., dim=1)
         warning = warning_type(records_pgv_pga)
         call warning%about('record', suite%records(first)%name)
         call warning%with('median_s', median)
         call warning%with('limit_s', least_median_pace)
         call warning%with('dt_s', suite%records(first)%dt)
         call warning%with('records', count(moves))
         call warnings%add(warning, 'median PGV / PGA of '//to_text(count(moves))//' records = '//rounded(median)//' s, less '// &
            & 'than '//to_text(least_median_pace)//' s: is their time step too small, '//to_text(suite%records(first)%dt)// &
            & ' s of record '''//suite%records(first)%name//'''?')
      end associate
   end subroutine warn_of_set

   !> Add a warning of the first of some records, and how many there are
   subroutine add_first(warning, name, text, beyond, records, warnings)
      type(warning_type), intent(inout) :: warning
      !> Name of the record, and what is odd of it
      character(len=*), intent(in) :: name, text
      !> Records of which it is true, and all that were looked at
      integer, intent(in) :: beyond, records
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      character(len=:), allocatable :: sentence

      call warning%with('records_beyond', beyond)
      call warning%with('records', records)
      sentence = 'record '''//name//''': '//text
      if (records > 1) sentence = sentence//' ('//to_text(beyond)//' of '//to_text(records)//' records)'
      call warnings%add(warning, sentence)
   end subroutine add_first

end module dondolo_case_motion_warnings
