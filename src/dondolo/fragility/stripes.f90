!> Multiple stripe analysis: every record at every level of intensity, and who collapses.
!>
!> Section 3.3 of Nale et al. The histories of a wall run together, on several threads (dondolo_ensemble).
module dondolo_stripes
   use dondolo_ensemble, only : check_engine, ensemble_type, run_ensemble, team_of
   use dondolo_error, only : error_type, raise_input
   use dondolo_intensity, only : measure_type
   use dondolo_kinds, only : wp
   use dondolo_memory, only : check_room
   use dondolo_queue, only : progress_interface
   use dondolo_record, only : largest_acceleration, record_type
   use dondolo_record_set, only : new_record_set, record_set_type
   use dondolo_response, only : response_type
   use dondolo_rest, only : new_rest, rest_type
   use dondolo_scaling, only : new_scaling, scaling_type
   use dondolo_solver, only : check_limit, check_solver, solver_type
   use dondolo_text, only : join, to_text
   use dondolo_wall, only : wall_type
   use dondolo_work, only : work_type
   implicit none
   private

   public :: stripes_type, multiple_stripe, measure_records, plan_stripes, planned_work, run_histories
   public :: check_levels, check_polarity, check_thresholds, polarity_names

   !> Polarities a record can be used with
   character(len=11), parameter :: polarity_names(3) = [character(len=11) :: 'as_recorded', 'reversed', 'both']

   !> Memory that a history of the plan takes while it is run, once or twice [bytes]
   real(wp), parameter :: bytes_of_history = 110.0_wp, bytes_of_two_runs = 160.0_wp

   !> Result of a multiple stripe analysis
   type :: stripes_type
      !> Intensity measure
      character(len=:), allocatable :: im
      !> Levels of intensity, in the unit of the measure
      real(wp), allocatable :: levels(:)
      !> Record of each history of a stripe
      integer, allocatable :: record(:)
      !> Its polarity: +1 as recorded, -1 reversed
      integer, allocatable :: polarity(:)
      !> Factor on the record (histories, levels), without the sign of the polarity
      real(wp), allocatable :: scale(:, :)
      !> Responses (histories, levels)
      type(response_type), allocatable :: response(:, :)
      !> What was computed for them
      type(work_type) :: work
   contains
      !> Collapses in each stripe
      procedure :: collapses
      !> Histories that reach a threshold in each stripe
      procedure :: exceedances
   end type stripes_type

contains

   !> Run a multiple stripe analysis of one wall
   subroutine multiple_stripe(stripes, wall, records, levels, im, polarity, solver, threads, error, progress)
      !> Result
      type(stripes_type), intent(out) :: stripes
      !> The wall
      type(wall_type), intent(in) :: wall
      !> Accelerograms
      type(record_type), intent(in) :: records(:)
      !> Levels of intensity, positive and increasing, in the unit of the measure
      real(wp), intent(in) :: levels(:)
      !> Intensity measure, one of scaling_names
      character(len=*), intent(in) :: im
      !> 'as_recorded', 'reversed' or 'both'; a two-sided wall is symmetric, so that 'both' runs once
      character(len=*), intent(in) :: polarity
      !> Engine, tolerances and limit
      type(solver_type), intent(in) :: solver
      !> Number of threads; 0: all that OpenMP gives
      integer, intent(in) :: threads
      !> What cannot be run: `variable = value: what is allowed`
      type(error_type), allocatable, intent(out) :: error
      !> Hears how far the work is
      procedure(progress_interface), optional :: progress

      type(scaling_type) :: scaling
      type(record_set_type) :: set

      call new_scaling(scaling, im, error)
      if (.not. allocated(error)) call plan_stripes(stripes, wall, records, levels, scaling, &
         & measure_records(scaling%measure, records, threads), records%pga(), polarity, solver, error)
      if (allocated(error)) return
      call new_record_set(set, records)
      call run_histories(stripes, wall, records, set, solver, 1, size(stripes%response), threads, progress)
   end subroutine multiple_stripe

   !> Values of a measure for records as they stand
   function measure_records(measure, records, threads) result(values)
      !> The measure
      type(measure_type), intent(in) :: measure
      !> Accelerograms
      type(record_type), intent(in) :: records(:)
      !> Number of threads; 0: all that OpenMP gives
      integer, intent(in) :: threads
      !> Its values
      real(wp) :: values(size(records))

      integer :: i

      !$omp parallel do schedule(dynamic) num_threads(team_of(threads, size(records))) default(none) &
      !$omp & shared(measure, records, values)
      do i = 1, size(records)
         values(i) = measure%of(records(i))
      end do
      !$omp end parallel do
   end function measure_records

   !> Check what is asked for and choose every history: its record, polarity and scale. Nothing is run
   !>
   !> The values of the measure and the PGAs do not depend on the wall: who runs many walls computes them once.
   subroutine plan_stripes(stripes, wall, records, levels, scaling, values, peaks, polarity, solver, error)
      !> Result; the responses have room but no values
      type(stripes_type), intent(out) :: stripes
      !> The wall
      type(wall_type), intent(in) :: wall
      !> Accelerograms
      type(record_type), intent(in) :: records(:)
      !> Levels of intensity, positive and increasing, in the unit of the measure
      real(wp), intent(in) :: levels(:)
      !> What records are scaled by
      type(scaling_type), intent(in) :: scaling
      !> Values of its measure for the records as they stand
      real(wp), intent(in) :: values(:)
      !> Their PGA [m/s2]
      real(wp), intent(in) :: peaks(:)
      !> 'as_recorded', 'reversed' or 'both'; a two-sided wall is symmetric, so that 'both' runs once
      character(len=*), intent(in) :: polarity
      !> Engine, tolerances and limit
      type(solver_type), intent(in) :: solver
      !> What cannot be run: `variable = value: what is allowed`; or lack of memory
      type(error_type), allocatable, intent(out) :: error

      call check_levels(levels, error)
      if (.not. allocated(error)) call check_polarity(polarity, error)
      if (.not. allocated(error)) call check_solver(solver, error)
      if (.not. allocated(error)) call check_limit(solver, wall%mechanism, error)
      if (.not. allocated(error)) call check_engine(solver, wall%mechanism, error)
      if (allocated(error)) return
      stripes%im = scaling%name
      stripes%levels = levels
      call choose_polarities(stripes, size(records), polarity, wall%mechanism%two_sided)
      call check_room(merge(bytes_of_two_runs, bytes_of_history, solver%estimate_error) &
         & *real(size(stripes%record), wp)*real(size(levels), wp), error)
      if (allocated(error)) return
      call choose_scales(stripes, wall, records, scaling, values, peaks, error)
      if (allocated(error)) return
      allocate(stripes%response(size(stripes%record), size(levels)))
   end subroutine plan_stripes

   !> What can be told of a plan's work before it is run: histories, sample intervals, and which histories never move
   pure function planned_work(stripes, wall, set) result(work)
      !> The plan
      type(stripes_type), intent(in) :: stripes
      !> The wall
      type(wall_type), intent(in) :: wall
      !> Accelerograms, joined
      type(record_set_type), intent(in) :: set
      !> Histories, still ones and intervals; the other counts are 0
      type(work_type) :: work

      type(rest_type) :: rest
      real(wp) :: trigger, high
      integer :: i, j

      rest = new_rest(wall%mechanism)
      trigger = rest%trigger()
      high = merge(trigger, huge(trigger), rest%two_sided)
      do j = 1, size(stripes%levels)
         do i = 1, size(stripes%record)
            associate (record => stripes%record(i))
               work%histories = work%histories + 1
               work%intervals = work%intervals + set%length(record) - 1
               ! The wall moves as soon as a sample lies outside what it can bear at rest.
               if (set%next_outside(record, 1, real(stripes%polarity(i), wp)*stripes%scale(i, j), -trigger, high) &
                  & > set%length(record)) work%still = work%still + 1
            end associate
         end do
      end do
   end function planned_work

   !> Run some of the histories of a plan; they are numbered stripe by stripe, from the lowest level
   subroutine run_histories(stripes, wall, records, set, solver, first, last, threads, progress)
      !> The plan; the responses of these histories are set
      type(stripes_type), intent(inout) :: stripes
      !> The wall
      type(wall_type), intent(in) :: wall
      !> Accelerograms
      type(record_type), intent(in) :: records(:)
      !> The same, joined
      type(record_set_type), intent(in) :: set
      !> Engine, tolerances and limit
      type(solver_type), intent(in) :: solver
      !> The first history to run, from 1
      integer, intent(in) :: first
      !> The last history to run
      integer, intent(in) :: last
      !> Number of threads; 0: all that OpenMP gives
      integer, intent(in) :: threads
      !> Hears how far the work is
      procedure(progress_interface), optional :: progress

      type(ensemble_type) :: ensemble
      integer :: i, j, k, histories

      histories = size(stripes%record)
      allocate(ensemble%record(last - first + 1), ensemble%scale(last - first + 1))
      do k = first, last
         i = modulo(k - 1, histories) + 1
         j = (k - 1)/histories + 1
         ensemble%record(k - first + 1) = stripes%record(i)
         ensemble%scale(k - first + 1) = real(stripes%polarity(i), wp)*stripes%scale(i, j)
      end do
      call run_ensemble(ensemble, wall%mechanism, records, set, solver, threads, progress)
      do k = first, last
         stripes%response(modulo(k - 1, histories) + 1, (k - 1)/histories + 1) = ensemble%response(k - first + 1)
      end do
      call stripes%work%add(ensemble%work)
   end subroutine run_histories

   !> Which records run with which polarity
   subroutine choose_polarities(stripes, records, polarity, two_sided)
      !> Result: record and polarity are set
      type(stripes_type), intent(inout) :: stripes
      !> Number of records
      integer, intent(in) :: records
      !> 'as_recorded', 'reversed' or 'both'
      character(len=*), intent(in) :: polarity
      !> Is the wall symmetric?
      logical, intent(in) :: two_sided

      integer :: i

      stripes%record = [(i, i=1, records)]
      stripes%polarity = spread(merge(-1, 1, polarity == 'reversed'), 1, records)
      if (polarity == 'both' .and. .not. two_sided) then
         stripes%record = [stripes%record, stripes%record]
         stripes%polarity = [stripes%polarity, -stripes%polarity]
      end if
   end subroutine choose_polarities

   !> Factors that bring every record to every level; a record without motion stays as it is
   subroutine choose_scales(stripes, wall, records, scaling, values, peaks, error)
      !> Result: scale is set
      type(stripes_type), intent(inout) :: stripes
      !> The wall
      type(wall_type), intent(in) :: wall
      !> Accelerograms
      type(record_type), intent(in) :: records(:)
      !> What they are scaled by
      type(scaling_type), intent(in) :: scaling
      !> Values of its measure
      real(wp), intent(in) :: values(:)
      !> Their PGA [m/s2]
      real(wp), intent(in) :: peaks(:)
      !> A record scaled beyond all measure
      type(error_type), allocatable, intent(out) :: error

      integer :: i, j, highest

      highest = size(stripes%levels)
      allocate(stripes%scale(size(stripes%record), highest))
      do i = 1, size(stripes%record)
         associate (record => stripes%record(i))
            do j = 1, highest
               stripes%scale(i, j) = scaling%factor(stripes%levels(j), values(record), wall)
            end do
            if (stripes%scale(i, highest)*peaks(record) <= largest_acceleration) cycle
            call raise_input(error, 'levels = '//to_text(stripes%levels(highest))//': scales record '// &
               & records(record)%name//' beyond '//to_text(largest_acceleration)//' m/s2')
            return
         end associate
      end do
   end subroutine choose_scales

   !> Check levels of intensity
   subroutine check_levels(levels, error)
      !> Levels
      real(wp), intent(in) :: levels(:)
      !> None at all, or not positive and increasing
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      if (size(levels) == 0) then
         call raise_input(error, 'levels: must be given')
         return
      end if
      do i = 1, size(levels)
         if (.not. (levels(i) > 0.0_wp .and. levels(i) <= huge(levels))) then
            call raise_input(error, 'levels = '//to_text(levels(i))//': must be positive')
            return
         end if
         if (i == 1) cycle
         if (levels(i) > levels(i - 1)) cycle
         call raise_input(error, 'levels = '//to_text(levels(i - 1))//', '//to_text(levels(i))// &
            & ': must increase strictly')
         return
      end do
   end subroutine check_levels

   !> Check thresholds of the EDP, each a damage state
   subroutine check_thresholds(thresholds, edp_limit, error)
      !> Thresholds, rotation / capacity
      real(wp), intent(in) :: thresholds(:)
      !> Rotation / capacity at which the wall has collapsed
      real(wp), intent(in) :: edp_limit
      !> Not positive and increasing, or beyond the limit
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      do i = 1, size(thresholds)
         if (.not. (thresholds(i) > 0.0_wp .and. thresholds(i) <= edp_limit)) then
            call raise_input(error, 'edp_thresholds = '//to_text(thresholds(i))//': must be positive and at most '// &
               & 'edp_limit = '//to_text(edp_limit))
            return
         end if
         if (i == 1) cycle
         if (thresholds(i) > thresholds(i - 1)) cycle
         call raise_input(error, 'edp_thresholds = '//to_text(thresholds(i - 1))//', '//to_text(thresholds(i))// &
            & ': must increase strictly')
         return
      end do
   end subroutine check_thresholds

   !> Check the name of a polarity
   subroutine check_polarity(polarity, error)
      !> Name
      character(len=*), intent(in) :: polarity
      !> Not one of polarity_names
      type(error_type), allocatable, intent(out) :: error

      if (.not. any(polarity == polarity_names)) &
         & call raise_input(error, 'polarity = '''//polarity//''': must be one of '//join(polarity_names))
   end subroutine check_polarity

   !> Collapses in each stripe
   pure function collapses(self) result(counts)
      !> Stripes
      class(stripes_type), intent(in) :: self
      !> Number of collapses at each level
      integer :: counts(size(self%levels))

      integer :: j

      do j = 1, size(counts)
         counts(j) = count(self%response(:, j)%collapsed)
      end do
   end function collapses

   !> Histories that reach a threshold in each stripe
   pure function exceedances(self, threshold) result(counts)
      !> Stripes
      class(stripes_type), intent(in) :: self
      !> Threshold, rotation / capacity, at most the limit
      real(wp), intent(in) :: threshold
      !> Number of histories at each level
      integer :: counts(size(self%levels))

      integer :: j

      do j = 1, size(counts)
         counts(j) = count(self%response(:, j)%edp >= threshold)
      end do
   end function exceedances

end module dondolo_stripes
