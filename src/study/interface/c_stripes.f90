!> Stripes and fragility curves of the C interface.
module dondolo_interface_c_stripes
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t, c_null_ptr, c_ptr
   use dondolo_base_error, only : error_type, problems_type, wrong_length
   use dondolo_base_interrupt, only : check_interrupt
   use dondolo_base_kinds, only : wp
   use dondolo_base_limits, only : most_levels
   use dondolo_base_lines, only : lines_type
   use dondolo_base_settings, only : group_settings_type
   use dondolo_base_settings_check, only : check_settings
   use dondolo_base_text, only : to_text
   use dondolo_base_threads, only : check_threads
   use dondolo_base_warning, only : warnings_type
   use dondolo_case_elastic_warnings, only : elastic_warnings_type
   use dondolo_case_event_warnings, only : warn_of_events
   use dondolo_case_motion_warnings, only : scale_warnings_type, warn_of_records
   use dondolo_case_result_warnings, only : warn_of_errors, warn_of_fit
   use dondolo_case_wall_warnings, only : wall_warnings_type
   use dondolo_fragility, only : fit_fragility, fragility_type, refuse_fractions
   use dondolo_fragility_even_levels, only : settle_levels
   use dondolo_fragility_scaling, only : new_scaling, scaling_type
   use dondolo_fragility_stripe_counts, only : stripe_counts_type
   use dondolo_fragility_stripes, only : multiple_stripe, stripes_type
   use dondolo_fragility_study, only : check_levels, check_thresholds, new_study, study_type
   use dondolo_interface_c_error, only : failure_type, is_ready
   use dondolo_interface_c_settings, only : c_settings_type, find_settings, solver_of
   use dondolo_interface_c_text, only : as_handle, as_pointer, take_numbers
   use dondolo_interface_c_walls, only : find_wall
   use dondolo_interface_handles, only : content_of, find_records, hold, records_type, refuse_handle
   use dondolo_motion_solver, only : solver_type
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: c_stripes_type, c_curve_type

   !> Stripes, and what a fit needs besides
   type :: c_stripes_type
      type(stripes_type) :: stripes
      type(wall_type) :: wall
      !> Number of the cluster of each record
      integer, allocatable :: clusters(:)
      !> Rotation / capacity that counts as collapse
      real(wp) :: edp_limit = 1.0_wp
      !> Sentences of warnings
      type(lines_type) :: warnings
   end type c_stripes_type

   !> A fitted curve
   type :: c_curve_type
      type(fragility_type) :: fragility
      !> Sentences of warnings
      type(lines_type) :: warnings
   end type c_curve_type

contains

   !> Run a multiple stripe analysis of one wall
   type(c_ptr) function c_run_stripes(error, wall, records, stripes, solver, threads) result(made) &
      & bind(c, name='dondolo_run_stripes')
      type(c_ptr), intent(in), value :: error, wall, records
      !> Settings of the group stripes, and of the group solver; NULL for the defaults of the latter
      type(c_ptr), intent(in), value :: stripes, solver
      !> Number of threads; 0: all that OpenMP gives
      integer(c_int), intent(in), value :: threads

      type(failure_type), pointer :: failure
      type(records_type), pointer :: found
      type(wall_type), pointer :: one
      type(c_stripes_type), pointer :: held
      type(study_type), allocatable :: study
      type(error_type), allocatable :: problem
      class(*), pointer :: content
      integer(c_int64_t) :: handle

      made = c_null_ptr
      if (.not. is_ready(error, failure)) return
      allocate (study)
      call find_wall(wall, one, problem)
      if (.not. allocated(problem)) call find_records(as_handle(records), found, problem)
      if (.not. allocated(problem)) call make_study(found, stripes, solver, int(threads), study, problem)
      if (.not. allocated(problem)) then
         allocate (held)
         call multiple_stripe(held%stripes, one, study, problem)
         if (.not. allocated(problem)) call check_interrupt(problem)
         if (allocated(problem)) then
            deallocate (held)
         else
            held%wall = one
            held%clusters = found%suite%clusters
            held%edp_limit = study%solver%edp_limit
            call warn(held, study)
            content => held
            call hold(content, handle)
            made = as_pointer(handle)
         end if
      end if
      call failure%take(problem)
   end function c_run_stripes

   !> Make the study that settings ask for
   subroutine make_study(records, stripes, solver, threads, study, error)
      type(records_type), intent(inout), target :: records
      !> Settings of the groups stripes and solver
      type(c_ptr), intent(in) :: stripes, solver
      !> Number of threads; 0: all that OpenMP gives
      integer, intent(in) :: threads
      type(study_type), intent(out) :: study
      !> A value that cannot be
      type(error_type), allocatable, intent(out) :: error

      type(c_settings_type), pointer :: found
      type(group_settings_type) :: settings
      type(problems_type) :: problems
      type(solver_type) :: how
      type(scaling_type) :: scaling
      real(wp), allocatable :: levels(:)

      call check_threads(threads, error)
      if (.not. allocated(error)) call find_settings(stripes, found, error, 'stripes')
      if (.not. allocated(error)) then
         settings = found%values
         call settings%fill()
         call check_settings(settings, problems)
         if (size(settings%list('levels')) > most_levels) call problems%note('levels: has '// &
            & to_text(size(settings%list('levels')))//' values, must have at most '//to_text(most_levels), wrong_length, 'levels')
         call problems%raise(error)
      end if
      if (.not. allocated(error)) call solver_of(solver, how, error)
      if (.not. allocated(error)) call new_scaling(scaling, settings%word('im'), error)
      if (.not. allocated(error)) then
         levels = settings%list('levels')
         call check_levels(levels, error)
      end if
      if (allocated(error)) return
      call settle_levels(levels)
      call records%suite%measure(scaling%measure, threads)
      call new_study(study, records%suite, scaling, levels, settings%word('polarity'), how, threads)
      call study%set_rows(records%rows, error)
   end subroutine make_study

   !> Note the warnings of a run
   subroutine warn(held, study)
      type(c_stripes_type), intent(inout) :: held
      type(study_type), intent(in) :: study

      type(wall_warnings_type) :: wall_warnings
      type(scale_warnings_type) :: scales
      type(warnings_type) :: warnings

      call wall_warnings%look(held%wall)
      call wall_warnings%warn(warnings, study%suite%records)
      call warn_of_records(study%suite, held%wall%gravity, warnings)
      call warn_of_events(study%suite, warnings)
      call scales%look(held%stripes, study, held%wall)
      call scales%warn(warnings)
      call warn_of_errors(held%stripes, study%suite%records, held%edp_limit, warnings)
      call warnings%put_sentences(held%warnings)
   end subroutine warn

   !> Fit a fragility curve to stripes
   type(c_ptr) function c_fit_stripes(error, stripes, edp_threshold) result(made) bind(c, name='dondolo_fit_stripes')
      type(c_ptr), intent(in), value :: error, stripes
      !> Rotation / capacity that makes a damage state, at most the limit of the solver; 0: this limit, collapse
      real(c_double), intent(in), value :: edp_threshold

      type(failure_type), pointer :: failure
      type(c_stripes_type), pointer :: held
      type(stripe_counts_type) :: counts
      type(error_type), allocatable :: problem
      type(elastic_warnings_type) :: elastic
      type(warnings_type) :: warnings
      class(*), pointer :: content
      real(wp) :: threshold

      made = c_null_ptr
      if (.not. is_ready(error, failure)) return
      held => null()
      content => content_of(as_handle(stripes))
      select type (content)
      type is (c_stripes_type)
         held => content
      class default
         call refuse_handle('stripes', as_handle(stripes), problem)
      end select
      if (.not. allocated(problem)) then
         threshold = edp_threshold
         if (abs(edp_threshold) <= 0.0_wp) threshold = held%edp_limit
         call check_thresholds([threshold], held%edp_limit, problem)
      end if
      if (.not. allocated(problem)) call counts%of(held%stripes, [threshold], held%clusters, .false., problem)
      if (.not. allocated(problem)) then
         call warn_of_fit(held%wall, held%stripes, counts%curve(1), warnings)
         call elastic%look(held%wall)
         call elastic%warn_of_thresholds([threshold], warnings)
         call keep_curve(counts%curve(1), warnings, made)
      end if
      call failure%take(problem)
   end function c_fit_stripes

   !> Fit a fragility curve to counts, as if all histories were independent
   type(c_ptr) function c_fit_counts(error, count, levels, collapses, histories) result(made) &
      & bind(c, name='dondolo_fit_counts')
      type(c_ptr), intent(in), value :: error
      !> Number of levels
      integer(c_int), intent(in), value :: count
      !> Levels of intensity, and collapses and histories at each
      type(c_ptr), intent(in), value :: levels, collapses, histories

      type(failure_type), pointer :: failure
      type(fragility_type) :: fragility
      type(stripes_type) :: stripes
      type(error_type), allocatable :: problem
      type(warnings_type) :: warnings
      real(c_double), pointer :: x(:), z(:), n(:)

      made = c_null_ptr
      if (.not. is_ready(error, failure)) return
      call take_numbers(levels, count, 'levels', x, problem)
      if (.not. allocated(problem)) call take_numbers(collapses, count, 'collapses', z, problem)
      if (.not. allocated(problem)) call take_numbers(histories, count, 'histories', n, problem)
      if (.not. allocated(problem)) call fit_fragility(fragility, real(x, wp), real(z, wp), real(n, wp), problem)
      if (.not. allocated(problem)) call refuse_fractions(real(z, wp), real(n, wp), problem)
      if (.not. allocated(problem)) then
         stripes%levels = x
         ! The status gives the reason for a missing curve: the sentence would refer to EDPs, which are not known
         if (fragility%has_fit()) call warn_of_fit(stripes=stripes, fragility=fragility, warnings=warnings)
         call keep_curve(fragility, warnings, made)
      end if
      call failure%take(problem)
   end function c_fit_counts

   !> Keep a curve
   subroutine keep_curve(fragility, warnings, made)
      type(fragility_type), intent(in) :: fragility
      type(warnings_type), intent(in) :: warnings
      !> Handle
      type(c_ptr), intent(out) :: made

      type(c_curve_type), pointer :: held
      class(*), pointer :: content
      integer(c_int64_t) :: handle

      allocate (held)
      held%fragility = fragility
      call warnings%put_sentences(held%warnings)
      content => held
      call hold(content, handle)
      made = as_pointer(handle)
   end subroutine keep_curve

end module dondolo_interface_c_stripes
