!> A study: the accelerograms, levels and settings under which walls are analysed.
!>
!> It is the same for all walls of a population and for a single wall: code that runs many walls makes it once.
module dondolo_fragility_study
   use dondolo_base_error, only : error_type, not_a_word, not_given, not_increasing, out_of_range, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_memory, only : check_room
   use dondolo_base_text, only : join, to_text
   use dondolo_building_floors, only : check_floor, floors_type
   use dondolo_fragility_scaling, only : scaling_type
   use dondolo_motion_ensemble, only : check_engine
   use dondolo_motion_solver, only : check_limit, check_solver, solver_type
   use dondolo_record, only : largest_acceleration
   use dondolo_record_dead_channel, only : check_motion
   use dondolo_record_rows, only : record_rows_type
   use dondolo_record_suite, only : suite_type
   use dondolo_wall_specimen, only : specimen_type
   implicit none
   private

   public :: runs_of, same_level, study_type, new_study
   public :: check_levels, check_thresholds, find_level, polarity_names

   !> Levels that differ by less than this part are the same: a table may give them in fewer digits than a computation
   real(wp), parameter :: same_level = 1.0e-9_wp

   !> Polarities a record can be used with
   character(len=11), parameter :: polarity_names(3) = [character(len=11) :: 'as_recorded', 'reversed', 'both']

   !> What walls are tried with
   type :: study_type
      !> The accelerograms; they belong to who made the study and must outlive it
      type(suite_type), pointer :: suite => null()
      !> Their motions on the floors of buildings, which walls share; they belong to who made the study. Null: each wall
      !> has its own
      type(floors_type), pointer :: floors => null()
      !> What they are scaled by
      type(scaling_type) :: scaling
      !> Values of its measure for the unscaled records
      real(wp), allocatable :: values(:)
      !> Levels of intensity, positive and increasing, in the unit of the measure
      real(wp), allocatable :: levels(:)
      !> Factor on each record at each level (records, levels), > 0 where it is given, < 0 where it follows from the
      !> measure, 0 where the record does not run; not allocated: every record runs at every level, scaled by the measure
      real(wp), allocatable :: factor(:, :)
      !> One of polarity_names; a two-sided wall is symmetric, so that 'both' runs once
      character(len=:), allocatable :: polarity
      !> EDP thresholds, each a damage state; the last is the limit of the solver, collapse
      real(wp), allocatable :: thresholds(:)
      !> Engine, tolerances and limit
      type(solver_type) :: solver
      !> Are all histories kept, or their counts alone?
      logical :: keeps_histories = .false.
      !> Number of threads; 0: all that OpenMP gives
      integer :: threads = 0
      !> Have levels, polarity and solver been checked?
      logical, private :: is_checked = .false.
   contains
      !> Check levels, polarity and solver once, whatever the walls
      procedure :: check_once
      !> Check that a wall can be tried
      procedure :: check
      !> Choose the records of each level
      procedure :: set_rows
      !> Does a record run at a level?
      procedure :: runs
      !> Share of the records that run at each level
      procedure :: share
      !> Factors that scale each record to each level for a wall
      procedure :: scales
      !> Check that no record is scaled beyond all measure
      procedure :: check_scales
      !> Check that every record that runs is a motion
      procedure :: check_motions
   end type study_type

contains

   !> Make a study, with collapse as its only damage state
   subroutine new_study(study, suite, scaling, levels, polarity, solver, threads)
      type(study_type), intent(out) :: study
      type(suite_type), intent(in), target :: suite
      !> What they are scaled by
      type(scaling_type), intent(in) :: scaling
      !> Levels of intensity, in the unit of the measure
      real(wp), intent(in) :: levels(:)
      !> 'as_recorded', 'reversed' or 'both'
      character(len=*), intent(in) :: polarity
      !> Engine, tolerances and limit
      type(solver_type), intent(in) :: solver
      !> Number of threads; 0: all that OpenMP gives
      integer, intent(in) :: threads

      study%suite => suite
      study%scaling = scaling
      study%values = suite%values(scaling%measure, threads)
      study%levels = levels
      study%polarity = polarity
      study%solver = solver
      study%threads = threads
      study%thresholds = [solver%edp_limit]
   end subroutine new_study

   !> Check levels, polarity and solver once, whatever the walls; they must not change afterwards
   subroutine check_once(self, error)
      class(study_type), intent(inout) :: self
      !> `variable = value: what is allowed`
      type(error_type), allocatable, intent(out) :: error

      call check_settings(self, error)
      self%is_checked = .not. allocated(error)
   end subroutine check_once

   !> Check levels, polarity and solver
   subroutine check_settings(study, error)
      class(study_type), intent(in) :: study
      !> `variable = value: what is allowed`
      type(error_type), allocatable, intent(out) :: error

      call check_levels(study%levels, error)
      if (allocated(error)) return
      if (.not. any(study%polarity == polarity_names)) then
         call raise_input(error, 'polarity = '''//study%polarity//''': must be one of '//join(polarity_names), &
            & not_a_word, 'polarity')
         return
      end if
      call check_solver(study%solver, error)
   end subroutine check_settings

   !> Check that a wall can be tried: levels, polarity, whether the solver can follow it, and the motions of its floor
   subroutine check(self, wall, error)
      class(study_type), intent(in) :: self
      class(specimen_type), intent(in) :: wall
      !> `variable = value: what is allowed`
      type(error_type), allocatable, intent(out) :: error

      if (.not. self%is_checked) call check_settings(self, error)
      if (.not. allocated(error)) call self%check_motions(error)
      if (.not. allocated(error)) call check_limit(self%solver, wall%mechanism, error)
      if (.not. allocated(error)) call check_engine(self%solver, wall%mechanism, error, &
         & self%suite%has_vertical)
      if (.not. allocated(error) .and. allocated(wall%building)) call check_floor(wall%building, self%suite, error)
   end subroutine check

   !> Choose the records of each level, and factors on them, as the rows of a catalogue give them
   subroutine set_rows(self, rows, error)
      class(study_type), intent(inout) :: self
      type(record_rows_type), intent(in) :: rows
      !> A row at a level that there is not, or beside one for every level; a level without records; lack of memory
      type(error_type), allocatable, intent(out) :: error

      integer :: i, j, first, last

      if (.not. rows%have_levels) return
      associate (records => size(self%suite%records), levels => size(self%levels))
         call check_room(8.0_wp*real(records, wp)*real(levels, wp), error)
         if (allocated(error)) return
         allocate (self%factor(records, levels), source=0.0_wp)
         do i = 1, size(rows%record)
            first = 1
            last = levels
            if (rows%level(i) > 0.0_wp) then
               first = find_level(self%levels, rows%level(i))
               last = first
            end if
            if (first == 0) then
               call raise_input(error, 'levels: do not include '//to_text(rows%level(i))//', the level of record '''// &
                  & self%suite%records(rows%record(i))%name//''' in '//rows%place%line(i)%text, out_of_range, 'levels')
            else if (any(abs(self%factor(rows%record(i), first:last)) > 0.0_wp)) then
               call raise_input(error, 'levels = '//to_text(self%levels(max(first, 1)))//': record '''// &
                  & self%suite%records(rows%record(i))%name//''' runs twice at this level, see '//rows%place%line(i)%text, &
                  & out_of_range, 'levels')
            end if
            if (allocated(error)) return
            self%factor(rows%record(i), first:last) = merge(rows%factor(i), -1.0_wp, rows%factor(i) > 0.0_wp)
         end do
         do j = 1, levels
            if (any(abs(self%factor(:, j)) > 0.0_wp)) cycle
            call raise_input(error, 'levels = '//to_text(self%levels(j))//': no record runs at this level', out_of_range, 'levels')
            return
         end do
      end associate
   end subroutine set_rows

   !> Place of a level among others, 0 where it is none of them
   pure integer function find_level(levels, level) result(at)
      !> Levels
      real(wp), intent(in) :: levels(:)
      !> One that may have fewer digits
      real(wp), intent(in) :: level

      at = findloc(abs(levels - level) <= same_level*levels, .true., dim=1)
   end function find_level

   !> Does a record run at a level?
   pure logical function runs(self, record, level)
      class(study_type), intent(in) :: self
      !> Number of the record
      integer, intent(in) :: record
      !> Number of the level
      integer, intent(in) :: level

      runs = .true.
      if (allocated(self%factor)) runs = abs(self%factor(record, level)) > 0.0_wp
   end function runs

   !> Whether each record runs at each level
   pure function runs_of(study) result(runs)
      type(study_type), intent(in) :: study
      !> An answer for each (records, levels)
      logical :: runs(size(study%suite%clusters), size(study%levels))

      integer :: i, j

      do j = 1, size(runs, 2)
         do i = 1, size(runs, 1)
            runs(i, j) = study%runs(i, j)
         end do
      end do
   end function runs_of

   !> Share of the records that run at each level
   pure function share(self)
      class(study_type), intent(in) :: self
      !> More than 0, at most 1
      real(wp) :: share(size(self%levels))

      share = 1.0_wp
      if (allocated(self%factor)) share = real(count(abs(self%factor) > 0.0_wp, dim=1), wp)/ &
         & real(size(self%factor, 1), wp)
   end function share

   !> Factors that scale each record to each level for a wall
   pure function scales(self, wall)
      class(study_type), intent(in) :: self
      class(specimen_type), intent(in) :: wall
      !> A factor for each (records, levels); 0 where the record does not run
      real(wp) :: scales(size(self%values), size(self%levels))

      integer :: j

      do j = 1, size(self%levels)
         scales(:, j) = self%scaling%factors(self%levels(j), self%values, wall)
      end do
      if (.not. allocated(self%factor)) return
      where (.not. self%factor < 0.0_wp) scales = self%factor
   end function scales

   !> Check that every record that runs is a motion: no factor brings one that is none to a level, and it is no survivor
   subroutine check_motions(self, error)
      class(study_type), intent(in) :: self
      !> The first that is not
      type(error_type), allocatable, intent(out) :: error

      integer :: i, j

      do i = 1, size(self%suite%records)
         if (self%suite%moves(i)) cycle
         do j = 1, size(self%levels)
            if (.not. self%runs(i, j)) cycle
            call check_motion(self%suite%records(i), error)
            return
         end do
      end do
   end subroutine check_motions

   !> Check that no record is scaled beyond all measure
   subroutine check_scales(self, scales, error)
      class(study_type), intent(in) :: self
      !> Factors (records, levels), as from scales
      real(wp), intent(in) :: scales(:, :)
      !> The first that is, at its highest level
      type(error_type), allocatable, intent(out) :: error

      integer :: i, j

      do i = 1, size(self%suite%records)
         do j = size(self%levels), 1, -1
            if (.not. self%runs(i, j)) cycle
            if (.not. scales(i, j)*self%suite%peaks(i) <= largest_acceleration) then
               call raise_input(error, 'levels = '//to_text(self%levels(j))//': scales record '''// &
                  & self%suite%records(i)%name//''' beyond '//to_text(largest_acceleration)//' m/s2', out_of_range, 'levels')
               return
            end if
            ! The factors that the measure gives grow with the level.
            if (.not. allocated(self%factor)) exit
         end do
      end do
   end subroutine check_scales

   !> Check levels of intensity
   subroutine check_levels(levels, error)
      !> Levels
      real(wp), intent(in) :: levels(:)
      !> None at all, or not positive and increasing
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      if (size(levels) == 0) then
         call raise_input(error, 'levels: must be given', not_given, 'levels')
         return
      end if
      do i = 1, size(levels)
         if (.not. (levels(i) > 0.0_wp .and. levels(i) <= huge(levels))) then
            call raise_input(error, 'levels = '//to_text(levels(i))//': must be positive', out_of_range, 'levels')
            return
         end if
         if (i == 1) cycle
         if (levels(i) > levels(i - 1)) cycle
         call raise_input(error, 'levels = '//to_text(levels(i - 1))//', '//to_text(levels(i))// &
            & ': must increase strictly', not_increasing, 'levels')
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
               & 'edp_limit = '//to_text(edp_limit), out_of_range, 'edp_thresholds')
            return
         end if
         if (i == 1) cycle
         if (thresholds(i) > thresholds(i - 1)) cycle
         call raise_input(error, 'edp_thresholds = '//to_text(thresholds(i - 1))//', '//to_text(thresholds(i))// &
            & ': must increase strictly', not_increasing, 'edp_thresholds')
         return
      end do
   end subroutine check_thresholds

end module dondolo_fragility_study
