!> Multiple stripe analysis: the outcome of records at levels of intensity. Every record runs at every level, unless
!> each level has records of its own.
!>
!> Section 3.3 of Nale et al. The histories of a wall run together, on several threads (dondolo_motion_ensemble).
module dondolo_fragility_stripes
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_error, only : error_type
   use dondolo_base_invariant, only : assert, checked
   use dondolo_base_kinds, only : wp
   use dondolo_base_memory, only : check_room
   use dondolo_building_floors, only : floors_type
   use dondolo_fragility_drift_note, only : largest_drift
   use dondolo_fragility_study, only : study_type
   use dondolo_motion_certified, only : certified_type
   use dondolo_motion_ensemble, only : ensemble_type, run_ensemble
   use dondolo_motion_queue, only : progress_interface
   use dondolo_motion_response, only : response_type
   use dondolo_motion_rest, only : new_rest, rest_type
   use dondolo_motion_work, only : work_type
   use dondolo_record_suite, only : suite_type
   use dondolo_wall_specimen, only : specimen_type
   implicit none
   private

   public :: stripes_type, multiple_stripe, plan_stripes, planned_work, run_histories, run_part, histories_of, take_motions, &
      & mark_lifts

   !> Memory that a history of the plan takes while it is run, once or three times [bytes]
   real(wp), parameter :: bytes_of_history = 114.0_wp, bytes_of_three_runs = 214.0_wp

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
      !> Which of the histories run at each level (histories, levels)
      logical, allocatable :: ran(:, :)
      !> Factor on the record (histories, levels), without the sign of the polarity; 0 where it does not run
      real(wp), allocatable :: scale(:, :)
      !> Responses (histories, levels), of those that do not run without collapse; not allocated: nothing has been run
      type(response_type), allocatable :: response(:, :)
      !> How they are certified (histories, levels); not allocated: they are not
      type(certified_type), allocatable :: certified(:, :)
      !> What was computed for them
      type(work_type) :: work
   contains
      !> Histories of each stripe
      procedure :: histories
      !> Collapses in each stripe
      procedure :: collapses
      !> Histories that reach a threshold in each stripe
      procedure :: exceedances
   end type stripes_type

contains

   !> Run a multiple stripe analysis of one wall
   subroutine multiple_stripe(stripes, wall, study, error, progress)
      type(stripes_type), intent(out) :: stripes
      class(specimen_type), intent(in) :: wall
      !> What it is tried with
      type(study_type), intent(in) :: study
      !> What cannot be run: `variable = value: what is allowed`; a history that was given up
      type(error_type), allocatable, intent(out) :: error
      !> Hears how far the work is
      procedure(progress_interface), optional :: progress

      call plan_stripes(stripes, wall, study, error)
      if (.not. allocated(error)) call run_histories(stripes, wall, study, study%threads, error, progress=progress)
   end subroutine multiple_stripe

   !> Check what is asked for and choose every history: its record, polarity and scale. Nothing is run
   subroutine plan_stripes(stripes, wall, study, error)
      !> Result, without responses
      type(stripes_type), intent(out) :: stripes
      class(specimen_type), intent(in) :: wall
      !> What it is tried with
      type(study_type), intent(in) :: study
      !> What cannot be run: `variable = value: what is allowed`; or lack of memory
      type(error_type), allocatable, intent(out) :: error

      integer :: i, j

      call study%check(wall, error)
      if (allocated(error)) return
      stripes%im = study%scaling%name
      stripes%levels = study%levels
      call choose_polarities(study, wall, stripes%record, stripes%polarity)
      associate (histories => size(stripes%record), levels => size(stripes%levels))
         call check_room(merge(bytes_of_three_runs, bytes_of_history, study%solver%estimate_error) &
            & *real(histories, wp)*real(levels, wp), error)
         if (allocated(error)) return
         associate (scales => study%scales(wall))
            call study%check_scales(scales, error)
            if (allocated(error)) return
            stripes%scale = scales(stripes%record, :)
         end associate
         allocate (stripes%ran(histories, levels))
         do j = 1, levels
            do i = 1, histories
               stripes%ran(i, j) = study%runs(stripes%record(i), j)
            end do
         end do
      end associate
   end subroutine plan_stripes

   !> Work of a plan, as far as it is known before the run: histories, sample intervals, and which histories never move
   function planned_work(stripes, wall, study) result(work)
      type(stripes_type), intent(in) :: stripes
      class(specimen_type), intent(in) :: wall
      !> What it is tried with
      type(study_type), intent(in) :: study
      !> Histories, still ones and intervals; the other counts are 0
      type(work_type) :: work

      type(floors_type), target :: own
      type(floors_type), pointer :: floors
      type(suite_type), pointer :: motions
      type(rest_type) :: rest
      integer :: i, j, place
      logical :: stays

      call take_motions(study, wall, study%threads, own, floors, place, motions)
      rest = new_rest(wall%mechanism)
      do j = 1, size(stripes%levels)
         do i = 1, size(stripes%record)
            if (.not. stripes%ran(i, j)) cycle
            associate (record => stripes%record(i), set => motions%set)
               work%histories = work%histories + 1
               work%intervals = work%intervals + set%length(record) - 1
               stays = rest%stays(motions%records(record), set, record, real(stripes%polarity(i), wp)*stripes%scale(i, j))
               if (stays) work%still = work%still + 1
            end associate
         end do
      end do
      if (place > 0) call floors%give_back(place)
   end function planned_work

   !> Run the histories of a plan, or some of them; those that run are numbered stripe by stripe, from the lowest level
   subroutine run_histories(stripes, wall, study, threads, error, first, last, progress)
      !> The plan; the responses of these histories are set, and all have room
      type(stripes_type), intent(inout) :: stripes
      class(specimen_type), intent(in) :: wall
      !> What it is tried with
      type(study_type), intent(in) :: study
      !> Number of threads instead of the study's; 0: all that OpenMP gives
      integer, intent(in) :: threads
      !> A history was given up
      type(error_type), allocatable, intent(out) :: error
      !> The first history to run, from 1, and the last; all if absent
      integer, intent(in), optional :: first, last
      !> Hears how far the work is
      procedure(progress_interface), optional :: progress

      type(ensemble_type) :: ensemble
      integer :: i, j, k, from, to

      from = 1
      if (present(first)) from = first
      to = count(stripes%ran)
      if (present(last)) to = last
      call run_part(ensemble, wall, study, threads, [from, to], error, progress)
      if (.not. allocated(stripes%response)) allocate (stripes%response(size(stripes%record), size(stripes%levels)))
      k = 0
      do j = 1, size(stripes%levels)
         do i = 1, size(stripes%record)
            if (.not. stripes%ran(i, j)) cycle
            k = k + 1
            if (k >= from .and. k <= to) stripes%response(i, j) = ensemble%response(k - from + 1)
         end do
      end do
      call stripes%work%add(ensemble%work)
   end subroutine run_histories

   !> Run some histories of a wall that a plan has checked, without the plan; they are numbered as in run_histories
   subroutine run_part(ensemble, wall, study, threads, range, error, progress)
      !> The histories and their responses
      type(ensemble_type), intent(out) :: ensemble
      class(specimen_type), intent(in) :: wall
      !> What it is tried with
      type(study_type), intent(in) :: study
      !> Number of threads instead of the study's; 0: all that OpenMP gives
      integer, intent(in) :: threads
      !> The first history to run, from 1, and the last
      integer, intent(in) :: range(2)
      !> A history was given up
      type(error_type), allocatable, intent(out) :: error
      !> Hears how far the work is
      procedure(progress_interface), optional :: progress

      type(floors_type), target :: own
      type(floors_type), pointer :: floors
      type(suite_type), pointer :: motions
      integer, allocatable :: record(:), polarity(:)
      real(wp), allocatable :: scales(:, :), drift(:)
      integer :: i, j, k, place

      call choose_polarities(study, wall, record, polarity)
      scales = study%scales(wall)
      allocate (ensemble%record(range(2) - range(1) + 1), ensemble%scale(range(2) - range(1) + 1))
      k = 0
      do j = 1, size(study%levels)
         if (k >= range(2)) exit
         do i = 1, size(record)
            if (.not. study%runs(record(i), j)) cycle
            k = k + 1
            if (k < range(1) .or. k > range(2)) cycle
            ensemble%record(k - range(1) + 1) = record(i)
            ensemble%scale(k - range(1) + 1) = real(polarity(i), wp)*scales(record(i), j)
         end do
      end do
      call take_motions(study, wall, threads, own, floors, place, motions, drift)
      call run_ensemble(ensemble, wall%mechanism, motions, study%solver, threads, error, progress)
      if (place > 0) call floors%give_back(place)
      ! With estimated errors every history counts as often as it was run
      if (allocated(drift)) ensemble%work%drifted = count(abs(ensemble%scale)*drift(ensemble%record) &
         & > largest_drift*wall%mechanism%capacity, kind=int64)*ensemble%work%histories/max(1, size(ensemble%record))
   end subroutine run_part

   !> Motions that a wall is tried with: those of the ground, or of the floor that it stands on
   subroutine take_motions(study, wall, threads, own, floors, place, motions, drift)
      !> What it is tried with
      type(study_type), intent(in) :: study
      class(specimen_type), intent(in) :: wall
      !> Number of threads that make them; 0: all that OpenMP gives
      integer, intent(in) :: threads
      !> Floors for this wall alone, where the study has none
      type(floors_type), intent(inout), target :: own
      !> Where they were taken, and what to give them back by; 0: they are those of the ground
      type(floors_type), pointer, intent(out) :: floors
      integer, intent(out) :: place
      !> Motions
      type(suite_type), pointer, intent(out) :: motions
      !> Greatest drift of the supports in each of them [rad]; not allocated: there is no building
      real(wp), allocatable, intent(out), optional :: drift(:)

      floors => own
      if (associated(study%floors)) floors => study%floors
      place = 0
      motions => study%suite
      if (allocated(wall%building)) call floors%take(wall%building, study%suite, threads, place, motions, drift)
   end subroutine take_motions

   !> Histories of all stripes of a wall
   pure integer function histories_of(study, wall) result(histories)
      !> What the wall is tried with
      type(study_type), intent(in) :: study
      class(specimen_type), intent(in) :: wall

      histories = size(study%suite%records)*size(study%levels)
      if (allocated(study%factor)) histories = count(abs(study%factor) > 0.0_wp)
      if (runs_twice(study, wall)) histories = 2*histories
   end function histories_of

   !> Does each record run in both polarities? Not of a wall that is the same to both sides
   pure logical function runs_twice(study, wall)
      !> What the wall is tried with
      type(study_type), intent(in) :: study
      class(specimen_type), intent(in) :: wall

      runs_twice = study%polarity == 'both' .and. .not. wall%mechanism%is_symmetric()
   end function runs_twice

   !> Which records run with which polarity
   pure subroutine choose_polarities(study, wall, record, polarity)
      !> What the wall is tried with
      type(study_type), intent(in) :: study
      class(specimen_type), intent(in) :: wall
      !> Record of each history of a stripe
      integer, allocatable, intent(out) :: record(:)
      !> Its polarity: +1 as recorded, -1 reversed
      integer, allocatable, intent(out) :: polarity(:)

      integer :: i

      record = [(i, i=1, size(study%suite%records))]
      polarity = spread(merge(-1, 1, study%polarity == 'reversed'), 1, size(record))
      if (runs_twice(study, wall)) then
         record = [record, record]
         polarity = [polarity, -polarity]
      end if
   end subroutine choose_polarities

   !> Histories of each stripe
   pure function histories(self) result(counts)
      class(stripes_type), intent(in) :: self
      !> Number of histories at each level
      integer :: counts(size(self%levels))

      counts = count(self%ran, dim=1)
   end function histories

   !> Collapses in each stripe
   pure function collapses(self) result(counts)
      class(stripes_type), intent(in) :: self
      !> Number of collapses at each level
      integer :: counts(size(self%levels))

      integer :: j

      do j = 1, size(counts)
         counts(j) = count(self%response(:, j)%collapsed)
      end do
      if (checked) call assert(all(counts <= self%histories()), 'collapses of a stripe are some of its histories')
   end function collapses

   !> In which histories the ground accelerates downwards by g or more at some instant
   pure subroutine mark_lifts(stripes, falls, gravity, lifts)
      type(stripes_type), intent(in) :: stripes
      !> Largest downward acceleration of the ground under each record [m/s2]
      real(wp), intent(in) :: falls(:)
      !> What g is [m/s2]
      real(wp), intent(in) :: gravity
      !> Does it fall away? (histories, levels)
      logical, allocatable, intent(out) :: lifts(:, :)

      integer :: j

      allocate (lifts(size(stripes%record), size(stripes%levels)))
      do j = 1, size(stripes%levels)
         lifts(:, j) = stripes%ran(:, j) .and. stripes%scale(:, j)*falls(stripes%record) >= gravity
      end do
   end subroutine mark_lifts

   !> Histories that reach a threshold in each stripe
   pure function exceedances(self, threshold) result(counts)
      class(stripes_type), intent(in) :: self
      !> Threshold, rotation / capacity, at most the limit
      real(wp), intent(in) :: threshold
      !> Number of histories at each level
      integer :: counts(size(self%levels))

      integer :: j

      do j = 1, size(counts)
         counts(j) = count(self%ran(:, j) .and. self%response(:, j)%edp >= threshold)
      end do
   end function exceedances

end module dondolo_fragility_stripes
