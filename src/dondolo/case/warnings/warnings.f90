!> What a user should know of results that are correct but may mislead.
module dondolo_case_warnings
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : line_type
   use dondolo_case_warning, only : warning_type, warnings_type
   use dondolo_fragility, only : fragility_type, status_names
   use dondolo_fragility_stripes, only : find_lifts, stripes_type
   use dondolo_fragility_study, only : study_type
   use dondolo_motion_response, only : largest_sure_error, response_type
   use dondolo_population_typology, only : typology_type
   use dondolo_record, only : record_type
   use dondolo_record_suite, only : suite_type
   use dondolo_record_table, only : pace_limit, pga_limit
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: scale_warning_type, fit_warning_type, warn_of_events, warn_of_fall, warn_of_records, warn_of_fit, warn_of_error, &
      & warn_of_errors, warn_of_union

   !> A record scaled by more than this hardly is the earthquake it was
   real(wp), parameter :: large_scale = 10.0_wp
   !> A factor that is given may take a record so far from its level
   real(wp), parameter :: off_level = 1.1_wp

   !> Levels that no ground motion has: of the PGA and of spectral accelerations [g], of the others [m/s, m]
   real(wp), parameter :: largest_pga = 4.0_wp, largest_sa = 10.0_wp, largest_pgv = 5.0_wp, largest_pgd = 5.0_wp, &
      & largest_hi = 25.0_wp, largest_cav = 200.0_wp, largest_arias = 100.0_wp

   !> What there is to say of levels and scale factors
   type :: scale_warning_type
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
      !> Look at levels alone
      procedure :: look_at_levels
      !> Warn, if there is reason to
      procedure :: warn
   end type scale_warning_type

   !> Statuses of a fit that there is something to say of
   character(len=len(status_names)), parameter :: telling(8) = [character(len=len(status_names)) :: 'no_collapse', &
      & 'all_collapse', 'separated', 'single_level', 'decreasing', 'not_converged', 'extrapolated', 'nearly_flat']

   !> What there is to say of the curves of a population
   type :: fit_warning_type
      !> Curves looked at
      integer :: curves = 0
      !> How many have each status
      integer :: number(size(telling)) = 0
      !> Wall of the first with each
      type(line_type) :: first(size(telling))
      !> Wall of the curve looked at last
      character(len=:), allocatable :: last
      !> Has a wall several mechanisms?
      logical :: several = .false.
   contains
      !> Look at the curve of a wall
      procedure :: look => look_at_curve
      !> Warn, if there is reason to
      procedure :: warn => warn_of_fits
   end type fit_warning_type

contains

   !> Look at levels: does a ground motion have them?
   subroutine look_at_levels(self, im, levels)
      !> What there is to say
      class(scale_warning_type), intent(inout) :: self
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
      !> What there is to say
      class(scale_warning_type), intent(inout) :: self
      !> Stripes of the wall
      type(stripes_type), intent(in) :: stripes
      type(study_type), intent(in) :: study
      type(wall_type), intent(in) :: wall

      integer :: at(2)

      self%histories = self%histories + count(stripes%ran, kind=int64)
      self%large = self%large + count(stripes%scale > large_scale, kind=int64)
      call self%look_at_levels(stripes%im, stripes%levels)
      if (allocated(study%factor)) call look_at_given(self, study, wall)
      if (any(study%suite%falls > 0.0_wp)) call look_at_falls(self, stripes, study%suite, wall%gravity)
      at = maxloc(stripes%scale)
      if (.not. stripes%scale(at(1), at(2)) > self%largest) return
      self%largest = stripes%scale(at(1), at(2))
      self%level = stripes%levels(at(2))
      self%record = study%suite%records(stripes%record(at(1)))%name
   end subroutine look

   !> Look at the factors that are given: do they take the records to their levels?
   subroutine look_at_given(self, study, wall)
      class(scale_warning_type), intent(inout) :: self
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
      !> What there is to say
      type(scale_warning_type), intent(inout) :: self
      !> Stripes of the wall
      type(stripes_type), intent(in) :: stripes
      !> Its accelerograms
      type(suite_type), intent(in) :: suite
      !> What g is for the wall [m/s2]
      real(wp), intent(in) :: gravity

      logical, allocatable :: lifts(:, :)
      integer :: j

      call find_lifts(stripes, suite%falls, gravity, lifts)
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
      !> What there is to say
      class(scale_warning_type), intent(in) :: self
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning

      if (self%usual > 0.0_wp .and. self%highest > self%usual) then
         warning%code = 'levels_above_usual'
         call warning%about('im', self%im)
         call warning%with('largest', self%highest)
         call warning%with('limit', self%usual)
         call warnings%add(warning)
      end if
      if (self%lifting > 0) then
         warning = warning_type('vertical_beyond_g')
         call warning%about('record', self%lifting_record)
         call warning%with('histories_beyond', self%lifting)
         call warning%with('histories', self%histories)
         call warning%with('level', self%lifting_level)
         call warnings%add(warning)
      end if
      if (self%off > 0) then
         warning = warning_type('factors_off_levels')
         call warning%about('record', self%off_record)
         call warning%about('im', self%im)
         call warning%with('limit', 100.0_wp*(off_level - 1.0_wp))
         call warning%with('factors_beyond', self%off)
         call warning%with('factors', self%given)
         call warning%with('value', self%farthest*self%missed)
         call warning%with('level', self%missed)
         call warnings%add(warning)
      end if
      if (self%large == 0) return
      warning = warning_type('scale_factors_large')
      call warning%about('record', self%record)
      call warning%with('limit', large_scale)
      call warning%with('histories_beyond', self%large)
      call warning%with('histories', self%histories)
      call warning%with('largest', self%largest)
      call warning%with('level', self%level)
      call warnings%add(warning)
   end subroutine warn

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
      warning%code = 'vertical_beyond_g'
      call warning%about('record', record%name)
      call warnings%add(warning)
   end subroutine warn_of_fall

   !> Warn of records without motion, and of those whose PGA or PGV / PGA no accelerograph has measured
   subroutine warn_of_records(suite, gravity, warnings, number)
      type(suite_type), intent(in) :: suite
      !> What g is [m/s2]
      real(wp), intent(in) :: gravity
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings
      !> Number of the one record to look at; all if absent
      integer, intent(in), optional :: number

      character(len=16), parameter :: codes(2) = [character(len=16) :: 'record_pga', 'record_pgv_pga']
      character(len=8), parameter :: names(2) = [character(len=8) :: 'pga_g', 'ratio_s'], limit_names(2) = [character(len=8) :: &
         & 'limit_g', 'limit_s']
      type(warning_type) :: warning, strange(2)
      real(wp) :: values(2), limits(2)
      integer :: first, last, beyond(2), i, k

      first = 1
      last = size(suite%records)
      if (present(number)) then
         first = number
         last = number
      end if
      beyond = 0
      do i = first, last
         associate (pga => suite%peaks(i)/gravity)
            if (.not. pga > 0.0_wp) then
               warning = warning_type('record_without_motion')
               call warning%about('record', suite%records(i)%name)
               call warnings%add(warning)
               cycle
            end if
            values = [pga, suite%velocities(i)/suite%peaks(i)]
         end associate
         limits = [pga_limit(values(1)), pace_limit(values(2))]
         do k = 1, size(codes)
            if (.not. limits(k) > 0.0_wp) cycle
            beyond(k) = beyond(k) + 1
            if (beyond(k) > 1) cycle
            strange(k)%code = codes(k)
            call strange(k)%about('record', suite%records(i)%name)
            call strange(k)%with(trim(names(k)), values(k))
            call strange(k)%with(trim(limit_names(k)), limits(k))
         end do
      end do
      do k = 1, size(codes)
         if (beyond(k) == 0) cycle
         call strange(k)%with('records_beyond', beyond(k))
         call strange(k)%with('records', last - first + 1)
         call warnings%add(strange(k))
      end do
   end subroutine warn_of_records

   !> Warn of records whose earthquake is not known, which standard errors therefore take as independent
   subroutine warn_of_events(suite, warnings)
      type(suite_type), intent(in) :: suite
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning

      if (all(suite%has_event) .or. maxval(suite%clusters) == 1) return
      warning%code = 'records_without_event'
      call warning%about('record', suite%records(findloc(suite%has_event, .false., dim=1))%name)
      call warning%with('records_beyond', count(.not. suite%has_event))
      call warning%with('records', size(suite%records))
      call warnings%add(warning)
   end subroutine warn_of_events

   !> Warn of the curve of one wall, or of counts
   subroutine warn_of_fit(wall, stripes, fragility, warnings)
      !> The wall; absent: counts without a wall, of which there is a curve
      type(wall_type), intent(in), optional :: wall
      type(stripes_type), intent(in) :: stripes
      type(fragility_type), intent(in) :: fragility
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning
      real(wp) :: largest

      if (fragility%status == 'ok') return
      warning%code = fragility%status
      if (present(wall)) call warning%about('wall', wall%name())
      call warning%with('levels', size(stripes%levels))
      call warning%with('first_level', minval(stripes%levels))
      call warning%with('last_level', maxval(stripes%levels))
      select case (fragility%status)
      case ('no_collapse')
         largest = maxval(stripes%response%edp)
         call warning%with('largest_edp', largest)
         if (present(wall) .and. .not. largest > 0.0_wp) then
            warning%code = 'no_motion'
            call warning%with('trigger_g', wall%mechanism%trigger_acceleration()/wall%gravity)
         end if
      case ('separated')
         call warning%with('bracket_low', fragility%bracket(1))
         if (fragility%bracket(2) < huge(fragility%bracket)) call warning%with('bracket_high', fragility%bracket(2))
      case ('extrapolated', 'nearly_flat')
         call warning%with('theta', fragility%theta)
         if (fragility%status == 'nearly_flat') call warning%with('beta', fragility%beta)
      end select
      call warnings%add(warning)
   end subroutine warn_of_fit

   !> Look at the curve of a wall, or of its mechanisms one after the other
   subroutine look_at_curve(self, curve, name)
      !> What there is to say
      class(fit_warning_type), intent(inout) :: self
      !> Curve of the wall, or of one of its mechanisms
      type(fragility_type), intent(in) :: curve
      !> Name of the wall
      character(len=*), intent(in) :: name

      integer :: i

      self%curves = self%curves + 1
      if (allocated(self%last)) self%several = self%several .or. self%last == name
      self%last = name
      i = findloc(telling, curve%status, dim=1)
      if (i == 0) return
      self%number(i) = self%number(i) + 1
      if (self%number(i) == 1) self%first(i)%text = name
   end subroutine look_at_curve

   !> Warn of the curves of the walls, and of those fitted to the population
   subroutine warn_of_fits(self, typologies, warnings)
      !> What there is to say of the walls
      class(fit_warning_type), intent(in) :: self
      !> The curves of the population
      type(typology_type), intent(in) :: typologies(:)
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning
      integer :: i

      do i = 1, size(telling)
         if (self%number(i) == 0) cycle
         warning = warning_type('curves_without_fit')
         if (telling(i) == 'extrapolated') warning%code = 'curves_extrapolated'
         if (telling(i) == 'nearly_flat') warning%code = 'curves_nearly_flat'
         call warning%about('wall', self%first(i)%text)
         call warning%about('status', trim(telling(i)))
         if (self%several) then
            call warning%about('of', 'mechanisms of walls')
         else
            call warning%about('of', 'walls')
         end if
         call warning%with('curves', self%number(i))
         call warning%with('of_curves', self%curves)
         call warnings%add(warning)
      end do
      do i = 1, size(typologies)
         associate (curve => typologies(i))
            if (curve%fit%status == 'ok') cycle
            warning = warning_type('population_without_fit')
            if (curve%fit%status == 'extrapolated') warning%code = 'population_extrapolated'
            if (curve%fit%status == 'nearly_flat') warning%code = 'population_nearly_flat'
            call warning%about('group', curve%group)
            call warning%about('mechanism', trim(curve%mechanism))
            call warning%about('status', trim(curve%fit%status))
            if (curve%fit%has_fit()) call warning%with('theta', curve%fit%theta)
            call warnings%add(warning)
         end associate
      end do
   end subroutine warn_of_fits

   !> Warn of the curve of one facade, or one wall with several mechanisms, in the same histories
   subroutine warn_of_union(name, curve, warnings)
      !> Name of the facade or the wall
      character(len=*), intent(in) :: name
      type(fragility_type), intent(in) :: curve
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning

      if (curve%status == 'ok') return
      warning = warning_type('union_without_fit')
      if (curve%status == 'extrapolated') warning%code = 'union_extrapolated'
      if (curve%status == 'nearly_flat') warning%code = 'union_nearly_flat'
      call warning%about('wall', name)
      call warning%about('status', trim(curve%status))
      if (curve%has_fit()) call warning%with('theta', curve%theta)
      call warnings%add(warning)
   end subroutine warn_of_union

   !> Warn of histories whose estimated error is large, and of collapses in doubt
   subroutine warn_of_errors(stripes, records, edp_limit, warnings)
      !> Stripes with estimated errors
      type(stripes_type), intent(in) :: stripes
      type(record_type), intent(in) :: records(:)
      !> Rotation / capacity at which the wall has collapsed
      real(wp), intent(in) :: edp_limit
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning
      integer :: at(2), number

      number = count(stripes%response%is_ill_conditioned())
      if (number > 0) then
         at = maxloc(stripes%response%edp_error)
         warning%code = 'ill_conditioned'
         call warning%about('record', records(stripes%record(at(1)))%name)
         call warning%with('limit', largest_sure_error)
         call warning%with('histories_beyond', number)
         call warning%with('histories', count(stripes%ran))
         call warning%with('largest', stripes%response(at(1), at(2))%edp_error)
         call warning%with('level', stripes%levels(at(2)))
         call warnings%add(warning)
      end if
      number = count(stripes%response%is_unsure(edp_limit))
      if (number == 0) return
      warning = warning_type('collapse_in_doubt')
      call warning%with('histories_in_doubt', number)
      call warning%with('histories', count(stripes%ran))
      call warnings%add(warning)
   end subroutine warn_of_errors

   !> Warn of one history in the same words
   subroutine warn_of_error(response, edp_limit, warnings)
      !> The history with its estimated error
      type(response_type), intent(in) :: response
      !> Rotation / capacity at which the wall has collapsed
      real(wp), intent(in) :: edp_limit
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning

      if (response%is_ill_conditioned()) then
         warning%code = 'ill_conditioned'
         call warning%with('limit', largest_sure_error)
         call warning%with('largest', response%edp_error)
         call warnings%add(warning)
      end if
      if (response%is_unsure(edp_limit)) call warnings%add(warning_type('collapse_in_doubt'))
   end subroutine warn_of_error

end module dondolo_case_warnings
