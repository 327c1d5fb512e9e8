!> Warnings of strips whose joints bend before they open, beside their records and damage states: records too coarse for the period,
!> and states that are reached while the joints are closed.
module dondolo_case_elastic_warnings
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : rounded, to_text
   use dondolo_base_warning, only : warning_type, warnings_type
   use dondolo_record, only : record_type
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: elastic_warnings_type

   !> Codes
   character(len=*), parameter :: record_coarse = 'record_coarse', threshold_while_closed = 'threshold_while_closed'

   !> Samples in a period, below which straight lines between them are no motion of such a period
   real(wp), parameter :: fewest_samples = 6.0_wp

   !> Strips looked at, and what to warn of
   type :: elastic_warnings_type
      private
      !> The shortest period, and the strip that has it; huge: none bends [s]
      real(wp) :: period = huge(1.0_wp)
      character(len=:), allocatable :: quickest
      !> The latest opening / capacity, and the strip that has it; 0: none bends
      real(wp) :: opening = 0.0_wp
      character(len=:), allocatable :: latest
   contains
      !> Look at a wall
      procedure :: look
      !> Warn of records, and of damage states
      procedure :: warn_of_records, warn_of_thresholds
   end type elastic_warnings_type

contains

   !> Look at a wall
   subroutine look(self, wall)
      class(elastic_warnings_type), intent(inout) :: self
      type(wall_type), intent(in) :: wall

      if (.not. wall%mechanism%joint%exists) return
      associate (joint => wall%mechanism%joint, opening => wall%mechanism%joint%opening/wall%mechanism%capacity)
         if (joint%period < self%period) then
            self%period = joint%period
            self%quickest = wall%name()
         end if
         if (opening > self%opening) then
            self%opening = opening
            self%latest = wall%name()
         end if
      end associate
   end subroutine look

   !> Warn of records whose samples are too far apart for the shortest period
   subroutine warn_of_records(self, records, warnings)
      class(elastic_warnings_type), intent(in) :: self
      !> The accelerograms
      type(record_type), intent(in) :: records(:)
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning
      character(len=:), allocatable :: sentence
      integer :: first, beyond

      beyond = count(records%dt > self%period/fewest_samples)
      if (beyond == 0) return
      first = findloc(records%dt > self%period/fewest_samples, .true., dim=1)
      associate (record => records(first))
         warning = warning_type(record_coarse)
         call warning%about('record', record%name)
         call warning%about('wall', self%quickest)
         call warning%with('dt_s', record%dt)
         call warning%with('limit_s', self%period/fewest_samples)
         call warning%with('elastic_period_s', self%period)
         call warning%with('records_beyond', beyond)
         call warning%with('records', size(records))
         sentence = 'record '''//record%name//''': its step of '//rounded(record%dt)//' s is more than a sixth of '// &
            & 'elastic_period = '//to_text(self%period)//' s of wall '''//self%quickest//''': motion of this period is missing'
      end associate
      if (size(records) > 1) sentence = sentence//' ('//to_text(beyond)//' of '//to_text(size(records))//' in all)'
      call warnings%add(warning, sentence)
   end subroutine warn_of_records

   !> Warn of damage states that are reached while the joints are closed
   subroutine warn_of_thresholds(self, thresholds, warnings)
      class(elastic_warnings_type), intent(in) :: self
      !> EDP thresholds
      real(wp), intent(in) :: thresholds(:)
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning
      integer :: i

      do i = 1, size(thresholds)
         if (.not. thresholds(i) < self%opening) cycle
         warning = warning_type(threshold_while_closed)
         call warning%about('wall', self%latest)
         call warning%with('edp_threshold', thresholds(i))
         call warning%with('opening_edp', self%opening)
         call warnings%add(warning, 'wall '''//self%latest//''': the damage state of EDP '//to_text(thresholds(i))//' is '// &
            & 'reached while the joints are closed, which open at '//rounded(self%opening))
      end do
   end subroutine warn_of_thresholds

end module dondolo_case_elastic_warnings
