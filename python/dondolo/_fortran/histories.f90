!> Time histories of one wall.
module histories
   use, intrinsic :: iso_c_binding, only : c_double, c_int, c_int64_t
   use dondolo_base_error, only : error_type
   use dondolo_base_interrupt, only : check_interrupt
   use dondolo_base_lines, only : lines_type
   use dondolo_base_memory, only : check_memory => check_room
   use dondolo_base_threads, only : check_threads
   use dondolo_base_warning, only : warnings_type
   use dondolo_boundary, only : as_solver, check_room, split_lines, unpack_response
   use dondolo_building_floors, only : floors_type
   use dondolo_case_motion_warnings, only : scale_warnings_type, warn_of_fall, warn_of_records
   use dondolo_case_result_warnings, only : sentence => warn_of_error, sentences => warn_of_errors
   use dondolo_case_wall_warnings, only : wall_warnings_type
   use dondolo_fragility_rounding, only : run_within_rounding => run_rounded
   use dondolo_fragility_stripes, only : stripes_type
   use dondolo_interface_felt_motions, only : check_scale, find_motions
   use dondolo_interface_handles, only : find_suite, find_walls
   use dondolo_motion_certificate, only : certificate_type, certify_histories
   use dondolo_motion_certified, only : not_known
   use dondolo_motion_ensemble, only : check_engine, ensemble_type, run_ensemble
   use dondolo_motion_initial_state, only : initial_state_type
   use dondolo_motion_response, only : response_type, trace_type
   use dondolo_motion_simulate, only : simulate_wall => simulate
   use dondolo_motion_solver, only : check_limit, check_solver, solver_type
   use dondolo_parcel, only : parcel_type, report, send
   use dondolo_record, only : record_type
   use dondolo_record_suite, only : suite_type
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: certify, check_settings, is_doubtful, simulate, run_rounded, run_scaled
   public :: warn_of_motion, warn_of_levels, warn_of_scales, warn_of_errors

   !> Memory that sending a row of a time history takes: six columns, twice [bytes]
   real(c_double), parameter :: bytes_of_row = 96.0_c_double

contains

   !> One motion; with history = 1 also the columns of its rows, and of each tie the times of its yield and of its fracture,
   !> negative for never
   subroutine simulate(walls, suite, number, scale, engine, initial_rotation, initial_velocity, history, rtol, atol, edp_limit, &
         & estimate_error, collapses_only, edp, collapsed, impacts, time_of_peak, edp_error, sent)
      !f2py threadsafe
      integer(c_int64_t), intent(in) :: walls, suite
      character(len=*), intent(in) :: engine
      integer(c_int), intent(in) :: number, history, estimate_error, collapses_only
      real(c_double), intent(in) :: scale, initial_rotation, initial_velocity, rtol, atol, edp_limit
      real(c_double), intent(out) :: edp, time_of_peak, edp_error
      integer(c_int), intent(out) :: collapsed, impacts
      integer(c_int64_t), intent(out) :: sent(5)
      type(wall_type), pointer :: wall(:)
      type(suite_type), pointer :: records, motions
      type(floors_type), target :: own
      type(solver_type) :: solver
      type(initial_state_type) :: state
      type(response_type) :: response
      type(trace_type) :: trace
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      call find_walls(walls, wall, error)
      if (.not. allocated(error)) call find_suite(suite, records, error)
      solver = as_solver(engine, rtol, atol, edp_limit, estimate_error, collapses_only)
      if (.not. allocated(error)) call check_scale(records, number, scale, error)
      if (.not. allocated(error)) call find_motions(wall(1), records, 1, own, motions, error)
      state = initial_state_type(initial_rotation, initial_velocity)
      if (.not. allocated(error)) then
         if (history == 1) then
            call simulate_wall(wall(1)%mechanism, motions%records(number), scale, solver, response, error, trace, &
               & initial=state)
         else
            call simulate_wall(wall(1)%mechanism, motions%records(number), scale, solver, response, error, initial=state)
         end if
      end if
      if (.not. allocated(error) .and. history == 1) call check_memory(bytes_of_row*real(trace%rows, c_double), error)
      if (.not. allocated(error) .and. history == 1) then
         call parcel%put('time', trace%time)
         call parcel%put('ground_acceleration', trace%acceleration)
         call parcel%put('rotation', trace%rotation)
         call parcel%put('velocity', trace%velocity)
         call parcel%put('side', nint(trace%side))
         call parcel%put('after_impact', merge(1, 0, trace%after_impact))
         call parcel%put('time_of_yield', trace%ties%time_of_yield)
         call parcel%put('time_of_fracture', trace%ties%time_of_fracture)
      end if
      call unpack_response(response, edp, collapsed, impacts, time_of_peak, edp_error)
      call send(parcel, error, sent)
   end subroutine simulate

   !> Check what is known of settings without a wall
   subroutine check_settings(engine, rtol, atol, edp_limit, failure)
      character(len=*), intent(in) :: engine
      real(c_double), intent(in) :: rtol, atol, edp_limit
      integer(c_int64_t), intent(out) :: failure(5)
      type(error_type), allocatable :: error

      call check_solver(as_solver(engine, rtol, atol, edp_limit, 0_c_int, 0_c_int), error)
      call report(error, failure)
   end subroutine check_settings

   !> Run k histories of one wall: each has its record (numbered from 1) and its factor, negative to reverse the polarity
   subroutine run_scaled(walls, suite, record, scale, k, engine, threads, rtol, atol, edp_limit, estimate_error, &
         & collapses_only, edp, collapsed, impacts, time_of_peak, edp_error, failure)
      !f2py threadsafe
      integer(c_int64_t), intent(in) :: walls, suite
      character(len=*), intent(in) :: engine
      integer(c_int), intent(in) :: k, threads, record(k), estimate_error, collapses_only
      real(c_double), intent(in) :: scale(k), rtol, atol, edp_limit
      real(c_double), intent(out) :: edp(k), time_of_peak(k), edp_error(k)
      integer(c_int), intent(out) :: collapsed(k), impacts(k)
      integer(c_int64_t), intent(out) :: failure(5)
      type(wall_type), pointer :: wall(:)
      type(suite_type), pointer :: records, motions
      type(floors_type), target :: own
      type(solver_type) :: solver
      type(ensemble_type) :: ensemble
      type(error_type), allocatable :: error
      integer :: i

      edp = 0
      collapsed = 0
      impacts = 0
      time_of_peak = 0
      edp_error = 0
      solver = as_solver(engine, rtol, atol, edp_limit, estimate_error, collapses_only)
      call check_room(error, histories=real(k, c_double))
      if (.not. allocated(error)) call check_threads(threads, error)
      if (.not. allocated(error)) call find_walls(walls, wall, error)
      if (.not. allocated(error)) call find_suite(suite, records, error)
      if (.not. allocated(error)) call check_solver(solver, error)
      if (.not. allocated(error)) call check_limit(solver, wall(1)%mechanism, error)
      if (.not. allocated(error)) call check_engine(solver, wall(1)%mechanism, error, records%has_vertical)
      do i = 1, k
         if (allocated(error)) exit
         call check_scale(records, record(i), scale(i), error)
      end do
      if (.not. allocated(error)) call find_motions(wall(1), records, threads, own, motions, error)
      if (.not. allocated(error)) then
         ensemble%record = record
         ensemble%scale = scale
         call run_ensemble(ensemble, wall(1)%mechanism, motions, solver, threads, error)
         call unpack_response(ensemble%response, edp, collapsed, impacts, time_of_peak, edp_error)
         if (.not. allocated(error)) call check_interrupt(error)
      end if
      call report(error, failure)
   end subroutine run_scaled

   !> EDPs of k histories with every sample of their records moved within half a unit of its last printed digit; negative where it
   !> is not known how the record is printed
   subroutine run_rounded(walls, suite, record, scale, k, engine, threads, rtol, atol, edp_limit, edp, failure)
      !f2py threadsafe
      integer(c_int64_t), intent(in) :: walls, suite
      character(len=*), intent(in) :: engine
      integer(c_int), intent(in) :: k, threads, record(k)
      real(c_double), intent(in) :: scale(k), rtol, atol, edp_limit
      real(c_double), intent(out) :: edp(k)
      integer(c_int64_t), intent(out) :: failure(5)
      type(wall_type), pointer :: wall(:)
      type(suite_type), pointer :: records
      type(solver_type) :: solver
      type(ensemble_type) :: ensemble
      real(c_double), allocatable :: found(:)
      type(error_type), allocatable :: error
      integer :: i

      edp = not_known
      solver = as_solver(engine, rtol, atol, edp_limit, 0_c_int, 0_c_int)
      call check_room(error, histories=real(k, c_double))
      if (.not. allocated(error)) call check_threads(threads, error)
      if (.not. allocated(error)) call find_walls(walls, wall, error)
      if (.not. allocated(error)) call find_suite(suite, records, error)
      if (.not. allocated(error)) call check_solver(solver, error)
      if (.not. allocated(error)) call check_limit(solver, wall(1)%mechanism, error)
      do i = 1, k
         if (allocated(error)) exit
         call check_scale(records, record(i), scale(i), error)
      end do
      if (.not. allocated(error)) then
         ensemble%record = record
         ensemble%scale = scale
         call run_within_rounding(found, wall(1), records%records, ensemble, solver, threads, error)
      end if
      if (.not. allocated(error)) call check_interrupt(error)
      if (.not. allocated(error)) edp = found
      call report(error, failure)
   end subroutine run_rounded

   !> Certify k histories of one wall: each has its record (numbered from 1), its factor and its EDP in double precision
   subroutine certify(walls, suite, record, scale, double_edp, k, edp_limit, threads, &
         & status, edp, collapsed, impacts, time_of_peak, edp_error, lowest, highest, failure)
      !f2py threadsafe
      integer(c_int64_t), intent(in) :: walls, suite
      integer(c_int), intent(in) :: k, threads, record(k)
      real(c_double), intent(in) :: scale(k), double_edp(k), edp_limit
      real(c_double), intent(out) :: edp(k), time_of_peak(k), edp_error(k), lowest(k), highest(k)
      integer(c_int), intent(out) :: status(k), collapsed(k), impacts(k)
      integer(c_int64_t), intent(out) :: failure(5)
      type(wall_type), pointer :: wall(:)
      type(suite_type), pointer :: records, motions
      type(floors_type), target :: own
      type(ensemble_type) :: ensemble
      type(certificate_type), allocatable :: certificates(:)
      type(error_type), allocatable :: error
      integer :: i

      status = 0
      edp = 0
      collapsed = 0
      impacts = 0
      time_of_peak = 0
      edp_error = 0
      lowest = 0
      highest = 0
      call check_room(error, histories=real(k, c_double))
      if (.not. allocated(error)) call check_threads(threads, error)
      if (.not. allocated(error)) call find_walls(walls, wall, error)
      if (.not. allocated(error)) call find_suite(suite, records, error)
      if (.not. allocated(error)) call check_limit(solver_type(edp_limit=edp_limit), wall(1)%mechanism, error)
      do i = 1, k
         if (allocated(error)) exit
         call check_scale(records, record(i), scale(i), error)
      end do
      if (.not. allocated(error)) call find_motions(wall(1), records, threads, own, motions, error)
      if (.not. allocated(error)) then
         ensemble%record = record
         ensemble%scale = scale
         allocate (ensemble%response(k))
         ensemble%response%edp = double_edp
         call certify_histories(certificates, wall(1), motions%records, ensemble, edp_limit, threads, error)
      end if
      if (.not. allocated(error)) then
         status = certificates%status
         lowest = certificates%lowest
         highest = certificates%highest
         call unpack_response(certificates%response, edp, collapsed, impacts, time_of_peak, edp_error)
         call check_interrupt(error)
      end if
      call report(error, failure)
   end subroutine certify

   !> Do estimated errors leave a doubt about EDPs, or about collapses?
   subroutine is_doubtful(edp, edp_error, n, edp_limit, doubt, failure)
      integer(c_int), intent(in) :: n
      real(c_double), intent(in) :: edp(n), edp_error(n), edp_limit
      integer(c_int), intent(out) :: doubt(n)
      integer(c_int64_t), intent(out) :: failure(5)
      type(response_type), allocatable :: responses(:)
      type(error_type), allocatable :: error

      doubt = 0
      call check_room(error, histories=real(n, c_double))
      if (.not. allocated(error)) then
         allocate (responses(n))
         responses%edp = edp
         responses%edp_error = edp_error
         doubt = merge(1, 0, responses%is_doubtful(edp_limit))
      end if
      call report(error, failure)
   end subroutine is_doubtful

   !> What the executable would warn of, of a wall and a record, before it runs one motion
   subroutine warn_of_motion(walls, suite, number, scale, moves, sent)
      integer(c_int64_t), intent(in) :: walls, suite
      integer(c_int), intent(in) :: number, moves
      real(c_double), intent(in) :: scale
      integer(c_int64_t), intent(out) :: sent(5)
      type(wall_type), pointer :: wall(:)
      type(suite_type), pointer :: records
      type(wall_warnings_type) :: wall_warnings
      type(warnings_type) :: warnings
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      call find_walls(walls, wall, error)
      if (.not. allocated(error)) call find_suite(suite, records, error)
      if (.not. allocated(error)) call check_scale(records, number, scale, error)
      if (.not. allocated(error)) then
         call wall_warnings%look(wall(1))
         call wall_warnings%warn(warnings, records%records(number:number))
         call warn_of_records(records, wall(1)%gravity, warnings, number, moves == 1)
         call warn_of_fall(records%records(number), scale, wall(1)%gravity, warnings)
         call warnings%put_objects(parcel%lines)
      end if
      call send(parcel, error, sent)
   end subroutine warn_of_motion

   !> What the executable would warn of, of levels of a measure
   subroutine warn_of_levels(im, levels, n, sent)
      integer(c_int), intent(in) :: n
      character(len=*), intent(in) :: im
      real(c_double), intent(in) :: levels(n)
      integer(c_int64_t), intent(out) :: sent(5)
      type(scale_warnings_type) :: scales
      type(warnings_type) :: warnings
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      call scales%look_at_levels(im, levels)
      call scales%warn(warnings)
      call warnings%put_objects(parcel%lines)
      call send(parcel, error, sent)
   end subroutine warn_of_levels

   !> What the executable would warn of, of the factors of n histories at k levels, 0 where one does not run; the names of their
   !> records are lines
   subroutine warn_of_scales(levels, k, scale, n, names, sent)
      integer(c_int), intent(in) :: k, n
      real(c_double), intent(in) :: levels(k), scale(n, k)
      character(len=*), intent(in) :: names
      integer(c_int64_t), intent(out) :: sent(5)
      type(scale_warnings_type) :: scales
      type(stripes_type) :: stripes
      type(lines_type) :: records
      type(warnings_type) :: warnings
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error
      integer :: largest

      call check_room(error, histories=real(n, c_double)*k)
      if (.not. allocated(error)) then
         stripes%levels = levels
         stripes%scale = scale
         stripes%ran = scale > 0.0_c_double
         call split_lines(names, records)
         call scales%look_at_factors(stripes, largest)
         if (largest > 0) scales%record = records%line(largest)%text
         call scales%warn(warnings)
         call warnings%put_objects(parcel%lines)
      end if
      call send(parcel, error, sent)
   end subroutine warn_of_scales

   !> What the executable would warn of, of estimated errors; record and level are those of the largest, without a record
   !> it is one history
   subroutine warn_of_errors(edp, edp_error, n, edp_limit, record, level, sent)
      integer(c_int), intent(in) :: n
      real(c_double), intent(in) :: edp(n), edp_error(n), edp_limit, level
      character(len=*), intent(in) :: record
      integer(c_int64_t), intent(out) :: sent(5)
      type(record_type) :: records(1)
      type(stripes_type) :: stripes
      type(warnings_type) :: warnings
      type(parcel_type) :: parcel
      type(error_type), allocatable :: error

      call check_room(error, histories=real(n, c_double))
      if (.not. allocated(error)) then
         records(1)%name = record
         stripes%levels = [level]
         stripes%record = spread(1, 1, n)
         allocate (stripes%response(n, 1), stripes%ran(n, 1))
         stripes%ran = .true.
         stripes%response(:, 1)%edp = edp
         stripes%response(:, 1)%edp_error = edp_error
         if (len(record) == 0) then
            call sentence(stripes%response(1, 1), edp_limit, warnings)
         else
            call sentences(stripes, records, edp_limit, warnings)
         end if
         call warnings%put_objects(parcel%lines)
      end if
      call send(parcel, error, sent)
   end subroutine warn_of_errors

end module histories
