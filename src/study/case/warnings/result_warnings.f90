!> Warnings of results: curves without a fit or with a doubtful one, levels and records from which none can come, and histories
!> whose numbers are in doubt.
module dondolo_case_result_warnings
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : line_type
   use dondolo_base_text, only : counted, rounded, to_text
   use dondolo_base_warning, only : warning_type, warnings_type
   use dondolo_fragility, only : fit_all_collapse, fit_decreasing, fit_extrapolated, fit_nearly_flat, fit_no_collapse, &
      & fit_not_converged, fit_ok, fit_separated, fit_single_level, fit_status_names, fragility_type, least_ratio
   use dondolo_fragility_clustered, only : fewest_clusters
   use dondolo_fragility_stripes, only : stripes_type
   use dondolo_motion_response, only : largest_sure_error, response_type
   use dondolo_motion_work, only : work_type
   use dondolo_population_typology, only : typology_type
   use dondolo_record, only : record_type
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: fit_warnings_type, warn_of_plan, warn_of_fit, warn_of_union, warn_of_error, warn_of_errors

   !> Codes; that of the curve of one wall is the name of its status
   character(len=*), parameter :: one_level = 'one_level', all_below_trigger = 'all_below_trigger', one_record = 'one_record', &
      & few_clusters = 'few_clusters', no_motion = 'no_motion', curves_without_fit = 'curves_without_fit', &
      & curves_extrapolated = 'curves_extrapolated', curves_nearly_flat = 'curves_nearly_flat', &
      & population_without_fit = 'population_without_fit', population_extrapolated = 'population_extrapolated', &
      & population_nearly_flat = 'population_nearly_flat', union_without_fit = 'union_without_fit', &
      & union_extrapolated = 'union_extrapolated', union_nearly_flat = 'union_nearly_flat', &
      & ill_conditioned = 'ill_conditioned', collapse_in_doubt = 'collapse_in_doubt'

   !> Parts of sentences that two warnings share
   character(len=*), parameter :: no_curve = ', no curve is fitted: ', &
      & outside = ', lies outside the levels: the fit extrapolates', &
      & unreliable = ', is not reliable: the probability of collapse hardly increases with the level', &
      & in_doubt = 'outcome uncertain within the estimated error'

   !> Statuses of a fit in the order in which populations warn of them
   integer, parameter :: warned(8) = [fit_no_collapse, fit_all_collapse, fit_separated, fit_single_level, fit_decreasing, &
      & fit_not_converged, fit_extrapolated, fit_nearly_flat]

   !> Curves looked at, and what to warn of
   type :: fit_warnings_type
      private
      !> Curves looked at
      integer :: curves = 0
      !> How many have each status
      integer :: number(size(fit_status_names)) = 0
      !> Wall of the first with each
      type(line_type) :: first(size(fit_status_names))
      !> Wall of the curve looked at last
      character(len=:), allocatable :: last
      !> Has a wall several mechanisms?
      logical :: several = .false.
   contains
      !> Look at the curve of a wall
      procedure :: look
      !> Warn, if there is reason to
      procedure :: warn
   end type fit_warnings_type

contains

   !> Warn of levels and records from which no useful curve can come
   subroutine warn_of_plan(levels, clusters, work, warnings)
      !> Number of levels
      integer, intent(in) :: levels
      !> Cluster of each record
      integer, intent(in) :: clusters(:)
      !> Work of all histories
      type(work_type), intent(in) :: work
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning

      if (levels == 1) call warnings%add(warning_type(one_level), 'only one level: no curve can be fitted, at least two are '// &
         & 'needed')
      if (work%histories > 0 .and. work%still >= work%histories) call warnings%add(warning_type(all_below_trigger), &
         & 'every history stays below the trigger: nothing moves, higher levels are needed')
      if (size(clusters) == 1) then
         call warnings%add(warning_type(one_record), 'only one record: the curve does not cover other earthquakes and has no '// &
            & 'standard errors')
      else if (maxval(clusters) < fewest_clusters) then
         warning = warning_type(few_clusters)
         call warning%with('records', size(clusters))
         call warning%with('clusters', maxval(clusters))
         call warning%with('limit', fewest_clusters)
         call warnings%add(warning, 'only '//counted(maxval(clusters), 'cluster')//' of '//to_text(size(clusters))// &
            & ' records: standard errors need at least '//to_text(fewest_clusters))
      end if
   end subroutine warn_of_plan

   !> Warn of the curve of one wall, or of counts
   subroutine warn_of_fit(wall, stripes, fragility, warnings)
      !> The wall; absent: counts without a wall, of which there is a curve
      type(wall_type), intent(in), optional :: wall
      type(stripes_type), intent(in) :: stripes
      type(fragility_type), intent(in) :: fragility
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning
      character(len=:), allocatable :: levels, text
      real(wp) :: largest, trigger

      if (fragility%status == fit_ok) return
      warning = warning_type(fit_status_names(fragility%status))
      if (present(wall)) call warning%about('wall', wall%name())
      associate (first => minval(stripes%levels), last => maxval(stripes%levels))
         call warning%with('levels', size(stripes%levels))
         call warning%with('first_level', first)
         call warning%with('last_level', last)
         levels = to_text(first)
         if (size(stripes%levels) > 1) levels = levels//' to '//to_text(last)
      end associate
      select case (fragility%status)
      case (fit_no_collapse)
         largest = maxval(stripes%response%edp)
         call warning%with('largest_edp', largest)
         text = 'no collapse at levels '//levels//no_curve//'the largest EDP is '//rounded(largest)//', higher levels are needed'
         if (present(wall) .and. .not. largest > 0.0_wp) then
            trigger = wall%mechanism%trigger_acceleration()/wall%gravity
            warning%code = no_motion
            call warning%with('trigger_g', trigger)
            text = 'no motion at levels '//levels//no_curve//'the wall begins to rock at a PGA of '//rounded(trigger)// &
               & ' g, higher levels are needed'
         end if
      case (fit_all_collapse)
         text = 'every history collapses at levels '//levels//no_curve//'lower levels are needed'
      case (fit_single_level)
         text = 'only one level, '//levels//no_curve//'at least two are needed'
      case (fit_decreasing)
         text = 'collapses do not become more frequent with the level'//no_curve//'their trend is flat or falling'
      case (fit_not_converged)
         text = 'the fit does not converge at levels '//levels//', no curve is fitted'
      case (fit_separated)
         associate (low => fragility%bracket(1), high => fragility%bracket(2))
            call warning%with('bracket_low', low)
            text = 'between '//to_text(low)//' and '//to_text(high)
            if (.not. low > 0.0_wp) text = 'below '//to_text(high)
            if (high < huge(high)) then
               call warning%with('bracket_high', high)
            else
               text = 'above '//to_text(low)
            end if
         end associate
         text = 'collapses and survivals do not overlap over two or more levels'//no_curve//'the median lies '//text
         if (is_of_one_record(stripes)) then
            text = text//'; one record gives one threshold, whatever the levels: more records are needed'
         else
            text = text//', more levels there are needed'
         end if
      case (fit_extrapolated)
         call warning%with('theta', fragility%theta)
         text = 'theta = '//rounded(fragility%theta)//' lies outside the levels '//levels//': the fit extrapolates, '// &
            & trim(merge('higher', 'lower ', fragility%theta > maxval(stripes%levels)))//' levels are needed'
      case (fit_nearly_flat)
         call warning%with('theta', fragility%theta)
         call warning%with('beta', fragility%beta)
         text = 'collapses hardly become more frequent with the level (likelihood ratio against no slope below '// &
            & rounded(least_ratio)//', its 95 % quantile): theta = '//rounded(fragility%theta)//' and beta = '// &
            & rounded(fragility%beta)//' are not reliable, levels farther apart or more records are needed'
      end select
      call warnings%add(warning, text)
   end subroutine warn_of_fit

   !> Are all histories of one record? Not known of counts
   pure logical function is_of_one_record(stripes)
      type(stripes_type), intent(in) :: stripes

      is_of_one_record = .false.
      if (allocated(stripes%record)) is_of_one_record = size(stripes%record) > 0 .and. all(stripes%record == stripes%record(1))
   end function is_of_one_record

   !> Look at the curve of a wall, or of its mechanisms one after the other
   subroutine look(self, curve, name)
      class(fit_warnings_type), intent(inout) :: self
      !> Curve of the wall, or of one of its mechanisms
      type(fragility_type), intent(in) :: curve
      !> Name of the wall
      character(len=*), intent(in) :: name

      self%curves = self%curves + 1
      if (allocated(self%last)) self%several = self%several .or. self%last == name
      self%last = name
      associate (i => curve%status)
         self%number(i) = self%number(i) + 1
         if (self%number(i) == 1) self%first(i)%text = name
      end associate
   end subroutine look

   !> Warn of the curves of the walls, and of those fitted to the population
   subroutine warn(self, typologies, warnings)
      class(fit_warnings_type), intent(in) :: self
      !> The curves of the population
      type(typology_type), intent(in) :: typologies(:)
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      integer :: i

      do i = 1, size(warned)
         if (self%number(warned(i)) > 0) call warn_of_walls(self, warned(i), warnings)
      end do
      do i = 1, size(typologies)
         if (typologies(i)%fit%status /= fit_ok) call warn_of_population(typologies(i), warnings)
      end do
   end subroutine warn

   !> Warn of the walls whose curves have a status
   subroutine warn_of_walls(self, status, warnings)
      type(fit_warnings_type), intent(in) :: self
      !> Status of a fit
      integer, intent(in) :: status
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning
      character(len=:), allocatable :: of, name, text

      name = trim(fit_status_names(status))
      of = 'walls'
      if (self%several) of = 'mechanisms of walls'
      associate (curves => self%number(status))
         text = to_text(curves)//' of '//to_text(self%curves)//' '//of//trim(merge(' have', ' has ', curves > 1))//' '
         select case (status)
         case (fit_extrapolated)
            warning = warning_type(curves_extrapolated)
            text = text//'a median outside the levels'
         case (fit_nearly_flat)
            warning = warning_type(curves_nearly_flat)
            text = text//'collapses that hardly become more frequent with the level, so that theta and beta are not reliable'
         case default
            warning = warning_type(curves_without_fit)
            text = text//'no fit and '//trim(merge('take ', 'takes', curves > 1))// &
               & ' part with '//trim(merge('their', 'its  ', curves > 1))//' fractions of collapse, but not in dispersions'
         end select
         call warning%about('wall', self%first(status)%text)
         call warning%about('status', name)
         call warning%about('of', of)
         call warning%with('curves', curves)
         call warning%with('of_curves', self%curves)
         call warnings%add(warning, text//' ('//name//'; the first is '''//self%first(status)%text//''')')
      end associate
   end subroutine warn_of_walls

   !> Warn of the curve of a part of the population
   subroutine warn_of_population(curve, warnings)
      type(typology_type), intent(in) :: curve
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning
      character(len=:), allocatable :: part, mechanism, status, text

      part = 'the population'
      if (len(curve%group) > 0) part = 'group '''//curve%group//''''
      mechanism = trim(curve%mechanism)
      status = trim(fit_status_names(curve%fit%status))
      text = 'the median of '//part//', '//rounded(curve%fit%theta)//' (mechanism '//mechanism//')'
      select case (curve%fit%status)
      case (fit_extrapolated)
         warning = warning_type(population_extrapolated)
         text = text//outside
      case (fit_nearly_flat)
         warning = warning_type(population_nearly_flat)
         text = text//unreliable
      case default
         warning = warning_type(population_without_fit)
         text = part//' has no fit (mechanism '//mechanism//', status '//status//')'
      end select
      call warning%about('group', curve%group)
      call warning%about('mechanism', mechanism)
      call warning%about('status', status)
      if (curve%fit%has_fit()) call warning%with('theta', curve%fit%theta)
      call warnings%add(warning, text)
   end subroutine warn_of_population

   !> Warn of the curve of one facade, or one wall with several mechanisms, in the same histories
   subroutine warn_of_union(name, curve, warnings)
      !> Name of the facade or the wall
      character(len=*), intent(in) :: name
      type(fragility_type), intent(in) :: curve
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning
      character(len=:), allocatable :: status, text

      if (curve%status == fit_ok) return
      status = trim(fit_status_names(curve%status))
      select case (curve%status)
      case (fit_extrapolated)
         warning = warning_type(union_extrapolated)
         text = 'the median of the mechanisms of '''//name//''' in the same histories, '//rounded(curve%theta)//outside
      case (fit_nearly_flat)
         warning = warning_type(union_nearly_flat)
         text = 'the median of '''//name//''', '//rounded(curve%theta)//unreliable
      case default
         warning = warning_type(union_without_fit)
         text = 'the mechanisms of '''//name//''' in the same histories have no fit (status '//status//')'
      end select
      call warning%about('wall', name)
      call warning%about('status', status)
      if (curve%has_fit()) call warning%with('theta', curve%theta)
      call warnings%add(warning, text)
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
      integer :: at(2), beyond

      beyond = count(stripes%response%is_ill_conditioned())
      if (beyond > 0) then
         at = maxloc(stripes%response%edp_error)
         associate (record => records(stripes%record(at(1))), histories => count(stripes%ran), &
            & largest => stripes%response(at(1), at(2))%edp_error, level => stripes%levels(at(2)))
            warning = warning_type(ill_conditioned)
            call warning%about('record', record%name)
            call warning%with('limit', largest_sure_error)
            call warning%with('histories_beyond', beyond)
            call warning%with('histories', histories)
            call warning%with('largest', largest)
            call warning%with('level', level)
            call warnings%add(warning, 'ill-conditioned: '//to_text(beyond)//' of '//to_text(histories)//' histories with an '// &
               & 'estimated error of the EDP above '//to_text(largest_sure_error)//'; the largest is '//rounded(largest)// &
               & ' (record '''//record%name//''' at level '//rounded(level)//')')
         end associate
      end if
      beyond = count(stripes%response%is_unsure(edp_limit))
      if (beyond == 0) return
      warning = warning_type(collapse_in_doubt)
      call warning%with('histories_in_doubt', beyond)
      call warning%with('histories', count(stripes%ran))
      call warnings%add(warning, in_doubt//', in '//to_text(beyond)//' of '//to_text(count(stripes%ran))//' histories')
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
         warning = warning_type(ill_conditioned)
         call warning%with('limit', largest_sure_error)
         call warning%with('largest', response%edp_error)
         call warnings%add(warning, 'ill-conditioned: the estimated error of the EDP is '//rounded(response%edp_error)// &
            & ', above '//to_text(largest_sure_error))
      end if
      if (response%is_unsure(edp_limit)) call warnings%add(warning_type(collapse_in_doubt), in_doubt)
   end subroutine warn_of_error

end module dondolo_case_result_warnings
