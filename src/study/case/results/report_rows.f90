!> The rows of the result tables: values by the names of their columns.
module dondolo_case_report_rows
   use dondolo_base_kinds, only : wp
   use dondolo_base_lines, only : lines_type
   use dondolo_base_property, only : column_name, is_many, is_text, is_words, property_type, word_of
   use dondolo_case_table, only : table_type
   use dondolo_fragility, only : fit_status_names, fragility_type
   use dondolo_fragility_clustered, only : parameter_intervals
   use dondolo_motion_certified, only : certified_type, not_known, status_names
   use dondolo_motion_response, only : response_type, trace_type
   use dondolo_population_typology, only : typology_type
   use dondolo_population_unions, only : union_type
   use dondolo_population_wall_row, only : wall_row_type
   use dondolo_wall, only : wall_type
   use dondolo_wall_properties, only : is_extra, is_of_building, wall_properties
   implicit none
   private

   public :: put_names, put_wall, put_stripe, put_fragility, put_typology, put_union, put_history, put_certified, &
      & put_trace

contains

   !> Name and mechanism of a wall, which most rows begin with
   subroutine put_names(table, name, mechanism)
      class(table_type), intent(inout) :: table
      !> Empty for a curve without a wall
      character(len=*), intent(in) :: name, mechanism

      call table%put('wall', name)
      call table%put('mechanism', mechanism)
   end subroutine put_names

   !> A wall: its properties, empty cells for those that it does not have, and what follows from them
   subroutine put_wall(table, row, lengths, has_facades, has_alternatives, notes)
      class(table_type), intent(inout) :: table
      !> The wall, one mechanism of it
      type(wall_row_type), intent(in) :: row
      !> How many values each property has at most; as many columns has a list
      integer, intent(in) :: lengths(:)
      !> Are there walls that are part of a facade, or that have exclusive alternatives?
      logical, intent(in) :: has_facades, has_alternatives
      !> Names of what is kept with the walls as it stands
      type(lines_type), intent(in) :: notes

      integer :: i

      do i = 1, size(wall_properties)
         if (wall_properties(i)%replaced .or. (is_extra(i) .and. lengths(i) == 0)) cycle
         call put_property(table, row%wall, wall_properties(i), lengths(i))
      end do
      associate (wall => row%wall)
         call table%put('alpha_rad', wall%model%alpha, wall%model%alpha > 0.0_wp)
         call table%put('p_rad_s', wall%mechanism%frequency_parameter())
         call table%put('trigger_acceleration_m_s2', wall%mechanism%trigger_acceleration())
         call table%put('capacity_rad', wall%mechanism%capacity)
         call table%put('restitution', wall%mechanism%restitution)
      end associate
      call table%put('weight', row%weight)
      call table%put('group', row%group)
      call table%put('p_occ', row%p_occ)
      if (any(lengths > 0 .and. is_of_building)) call put_support(table, row%wall)
      if (has_facades) call table%put('facade', row%facade)
      if (has_alternatives) then
         call table%put('occurrence', trim(row%occurrence))
         call table%put('alternative', row%alternative)
      end if
      do i = 1, notes%count
         call table%put(notes%line(i)%text, row%notes%line(i)%text)
      end do
   end subroutine put_wall

   !> A property of a wall, of a list all values
   subroutine put_property(table, wall, property, length)
      class(table_type), intent(inout) :: table
      type(wall_type), intent(in) :: wall
      type(property_type), intent(in) :: property
      !> Columns of a list
      integer, intent(in) :: length

      real(wp), allocatable :: values(:)
      integer :: k

      if (property%kind == is_text) then
         call table%put(trim(column_name(property)), wall%input%word(property%name))
      else if (.not. is_many(property%kind)) then
         call table%put(trim(column_name(property)), wall%input%number(property%name), wall%input%has(property%name))
      else if (property%kind == is_words) then
         do k = 1, length
            call table%put(trim(column_name(property, k)), trim(word_of(wall%input%word(property%name), k)))
         end do
      else
         allocate (values(length), source=0.0_wp)
         associate (own => wall%input%list(property%name))
            values(:size(own)) = own
            do k = 1, length
               call table%put(trim(column_name(property, k)), values(k), k <= size(own))
            end do
         end associate
      end if
   end subroutine put_property

   !> What a wall feels of its supports, if it stands on a building
   subroutine put_support(table, wall)
      class(table_type), intent(inout) :: table
      type(wall_type), intent(in) :: wall

      real(wp) :: share, tilt

      share = 0.0_wp
      tilt = 0.0_wp
      if (allocated(wall%building)) then
         share = wall%building%share
         tilt = wall%building%tilt
      end if
      call table%put('support_share', share, allocated(wall%building))
      call table%put('support_tilt_1_s2', tilt, allocated(wall%building))
   end subroutine put_support

   !> Histories that reach an EDP threshold at a level
   subroutine put_stripe(table, im, level, histories, reached, threshold)
      class(table_type), intent(inout) :: table
      !> Intensity measure
      character(len=*), intent(in) :: im
      !> Level
      real(wp), intent(in) :: level
      !> Histories, and those that reach the threshold
      integer, intent(in) :: histories, reached
      !> The threshold
      real(wp), intent(in) :: threshold

      call table%put('im', im)
      call table%put('im_level', level)
      call table%put('histories', histories)
      call table%put('collapses', reached)
      call table%put('fraction', real(reached, wp)/real(histories, wp))
      call table%put('edp_threshold', threshold)
   end subroutine put_stripe

   !> The curve of a wall with its standard errors and 95 % intervals; cells are empty without a fit, without standard
   !> errors, and where a side is open
   subroutine put_fragility(table, im, curve, threshold)
      class(table_type), intent(inout) :: table
      !> Intensity measure
      character(len=*), intent(in) :: im
      type(fragility_type), intent(in) :: curve
      !> Its EDP threshold; 0: that of the histories is not known
      real(wp), intent(in) :: threshold

      real(wp) :: bounds(2, 2)
      logical :: has_fit, has_errors

      has_fit = curve%has_fit()
      has_errors = has_fit .and. curve%has_errors()
      bounds = 0.0_wp
      if (has_errors) bounds = parameter_intervals(curve)
      call table%put('im', im)
      call table%put('theta', curve%theta, has_fit)
      call table%put('beta', curve%beta, has_fit)
      call table%put('se_ln_theta', curve%se_ln_theta(), has_errors)
      call table%put('se_beta', curve%se_beta(), has_errors)
      call table%put('log_likelihood', curve%log_likelihood, has_fit)
      call table%put('status', trim(fit_status_names(curve%status)))
      call put_bound(table, 'bracket_low', curve%bracket(1))
      call put_bound(table, 'bracket_high', curve%bracket(2))
      call table%put('edp_threshold', threshold, threshold > 0.0_wp)
      call put_bound(table, 'theta_low', bounds(1, 1))
      call put_bound(table, 'theta_high', bounds(2, 1))
      call put_bound(table, 'beta_low', bounds(1, 2))
      call put_bound(table, 'beta_high', bounds(2, 2))
      call put_kind_of_errors(table, '', curve, has_fit)
      call table%put('naive_se_ln_theta', sqrt(curve%naive(1, 1)), has_fit)
      call table%put('naive_se_beta', sqrt(curve%naive(2, 2)), has_fit)
      call table%put('cov_ln_theta_beta', curve%covariance(1, 2), has_errors)
      call table%put('deviance', curve%deviance, has_fit)
      call table%put('deviance_dof', curve%deviance_dof, has_fit)
   end subroutine put_fragility

   !> A bound, empty where its side is open: 0 or huge
   subroutine put_bound(table, name, value)
      class(table_type), intent(inout) :: table
      !> Name of the column
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: value

      call table%put(name, value, value > 0.0_wp .and. value < huge(value))
   end subroutine put_bound

   !> What the standard errors of a curve are; degrees of freedom of records alone are whole numbers
   subroutine put_kind_of_errors(table, prefix, curve, given)
      class(table_type), intent(inout) :: table
      !> What the names of the columns begin with
      character(len=*), intent(in) :: prefix
      type(fragility_type), intent(in) :: curve
      !> Is there anything to say?
      logical, intent(in) :: given

      real(wp) :: degrees

      degrees = curve%degrees_of_freedom
      if (curve%errors /= 'clustered') degrees = real(max(curve%clusters - 1, 0), wp)
      call table%put(prefix//'errors', trim(curve%errors), given)
      call table%put(prefix//'clusters', curve%clusters, given)
      call table%put_degrees(prefix//'degrees_of_freedom', degrees, given)
   end subroutine put_kind_of_errors

   !> Standard errors of a curve
   subroutine put_errors(table, prefix, curve, given)
      class(table_type), intent(inout) :: table
      !> What the names of the columns begin with
      character(len=*), intent(in) :: prefix
      type(fragility_type), intent(in) :: curve
      !> Are they known?
      logical, intent(in) :: given

      logical :: has_fit, has_errors

      has_fit = given .and. curve%has_fit()
      has_errors = has_fit .and. curve%has_errors()
      call table%put(prefix//'se_ln_theta', curve%se_ln_theta(), has_errors)
      call table%put(prefix//'se_beta', curve%se_beta(), has_errors)
      call table%put(prefix//'cov_ln_theta_beta', curve%covariance(1, 2), has_errors)
      call put_kind_of_errors(table, prefix, curve, has_fit)
   end subroutine put_errors

   !> A curve of the population at a level
   subroutine put_typology(table, typology, im, level, threshold)
      class(table_type), intent(inout) :: table
      type(typology_type), intent(in) :: typology
      !> Intensity measure
      character(len=*), intent(in) :: im
      !> Number of the level
      integer, intent(in) :: level
      !> EDP threshold
      real(wp), intent(in) :: threshold

      associate (fit => typology%fit)
         call table%put('mechanism', typology%mechanism)
         call table%put('im', im)
         call table%put('im_level', typology%levels(level))
         call table%put('weight', typology%weight)
         call table%put('mean_fraction', typology%mean_fraction(level))
         call table%put('mean_curve', typology%mean_curve(level))
         call table%put('theta', fit%theta, fit%has_fit())
         call table%put('beta', fit%beta, fit%has_fit())
         call table%put('status', trim(fit_status_names(fit%status)))
         call table%put('group', typology%group)
         call table%put('fractile_16', typology%fractile(1, level))
         call table%put('fractile_50', typology%fractile(2, level))
         call table%put('fractile_84', typology%fractile(3, level))
         call table%put('beta_walls', typology%beta_walls, typology%fitted > 0.0_wp)
         call table%put('beta_records', typology%beta_records, typology%fitted > 0.0_wp)
         call table%put('upper_asymptote', typology%upper_asymptote)
         call table%put('edp_threshold', threshold)
         call put_errors(table, '', fit, given=.true.)
      end associate
   end subroutine put_typology

   !> A wall with several mechanisms, or a mean, at a level; cells are empty where a mean has no counts, and without a fit
   subroutine put_union(table, union, im, level, number, state, threshold)
      class(table_type), intent(inout) :: table
      type(union_type), intent(in) :: union
      !> Intensity measure
      character(len=*), intent(in) :: im
      !> Level, and its number
      real(wp), intent(in) :: level
      integer, intent(in) :: number
      !> Number of the damage state
      integer, intent(in) :: state
      !> Its EDP threshold
      real(wp), intent(in) :: threshold

      real(wp) :: collapses
      logical :: is_wall

      is_wall = union%rows(1) > 0
      collapses = 0.0_wp
      if (is_wall) collapses = union%collapses(number, state)
      associate (curve => union%curve(state), other => union%product(state))
         call table%put('wall', union%name)
         call table%put('group', union%group)
         call table%put('mechanisms', union%rows(2) - union%rows(1) + 1, is_wall)
         call table%put('im', im)
         call table%put('im_level', level)
         call table%put('histories', nint(union%histories(number)), is_wall)
         call table%put('collapses', collapses, is_wall)
         call table%put('fraction', union%fraction(number, state))
         call table%put('independent_fraction', union%independent(number, state))
         call table%put('edp_threshold', threshold)
         call table%put('theta', curve%theta, curve%has_fit())
         call table%put('beta', curve%beta, curve%has_fit())
         call table%put('status', trim(fit_status_names(curve%status)))
         call put_errors(table, '', curve, given=.true.)
         call table%put('independent_theta', other%theta, other%has_fit())
         call table%put('independent_beta', other%beta, other%has_fit())
         call put_errors(table, 'independent_', other, given=.true.)
      end associate
   end subroutine put_union

   !> A history
   subroutine put_history(table, record, polarity, im, level, scale, response)
      class(table_type), intent(inout) :: table
      !> Name of the record
      character(len=*), intent(in) :: record
      !> +1 as recorded, -1 reversed
      integer, intent(in) :: polarity
      !> Intensity measure
      character(len=*), intent(in) :: im
      !> Level
      real(wp), intent(in) :: level
      !> Factor on the record
      real(wp), intent(in) :: scale
      type(response_type), intent(in) :: response

      call table%put('record', record)
      call table%put('polarity', trim(merge('reversed   ', 'as_recorded', polarity < 0)))
      call table%put('im', im)
      call table%put('im_level', level)
      call table%put('scale', scale)
      call table%put('edp', response%edp)
      call table%put('collapsed', response%collapsed)
      call table%put('impacts', response%impacts)
      call table%put('time_of_peak_s', response%time_of_peak)
   end subroutine put_history

   !> How a history is certified; an empty cell where an interrupted run has left its doubt, or where it is not known how the record
   !> is printed
   subroutine put_certified(table, certified)
      class(table_type), intent(inout) :: table
      type(certified_type), intent(in) :: certified

      if (certified%status > 0) then
         call table%put('status', trim(status_names(certified%status)))
      else
         call table%put('status', '')
      end if
      call table%put('edp_lowest', certified%lowest)
      call table%put('edp_highest', certified%highest)
      call table%put('edp_rounded', certified%rounded, certified%rounded > not_known)
   end subroutine put_certified

   !> The rows of a time history
   subroutine put_trace(table, trace, capacity)
      class(table_type), intent(inout) :: table
      type(trace_type), intent(in) :: trace
      !> Rotation that the EDP is measured by [rad]
      real(wp), intent(in) :: capacity

      integer :: i

      do i = 1, trace%rows
         call table%put('time_s', trace%time(i))
         call table%put('ground_acceleration_m_s2', trace%acceleration(i))
         call table%put('rotation_rad', trace%rotation(i))
         call table%put('velocity_rad_s', trace%velocity(i))
         call table%put('edp', abs(trace%rotation(i))/capacity)
         call table%put('side', nint(trace%side(i)))
         call table%put('after_impact', trace%after_impact(i))
         call table%end_row()
      end do
   end subroutine put_trace

end module dondolo_case_report_rows
