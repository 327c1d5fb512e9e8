!> What was computed, and what was not: counts that show that nothing is integrated that a result does not need.
module dondolo_motion_work
   use, intrinsic :: iso_fortran_env, only : int64
   implicit none
   private

   public :: work_type, work_names

   !> Names of the counts, in the order of `counts`
   character(len=11), parameter :: work_names(8) = [character(len=11) :: 'histories', 'still', 'intervals', 'rocked', &
      & 'steps', 'evaluations', 'impacts', 'drifted']

   !> Counts over histories
   type :: work_type
      !> Histories, those that never move, of which nothing is integrated, and those that the engine lanes computed
      integer(int64) :: histories = 0, still = 0, in_lanes = 0
      !> Sample intervals of all records of the histories, and those in which the wall rocks
      integer(int64) :: intervals = 0, rocked = 0
      !> Steps taken, and evaluations of the terms of the mechanism
      integer(int64) :: steps = 0, evaluations = 0
      !> Impacts that were located
      integer(int64) :: impacts = 0
      !> Histories in which the supports of the wall drift apart by more than a motion of both is good for
      integer(int64) :: drifted = 0
   contains
      !> Add other counts
      procedure :: add
      !> The counts as an array
      procedure :: counts
   end type work_type

contains

   !> Add other counts
   pure subroutine add(self, other)
      class(work_type), intent(inout) :: self
      !> Counts to add
      type(work_type), intent(in) :: other

      self%histories = self%histories + other%histories
      self%still = self%still + other%still
      self%in_lanes = self%in_lanes + other%in_lanes
      self%intervals = self%intervals + other%intervals
      self%rocked = self%rocked + other%rocked
      self%steps = self%steps + other%steps
      self%evaluations = self%evaluations + other%evaluations
      self%impacts = self%impacts + other%impacts
      self%drifted = self%drifted + other%drifted
   end subroutine add

   !> The counts as an array, in the order of work_names
   pure function counts(self)
      class(work_type), intent(in) :: self
      !> The same
      integer(int64) :: counts(size(work_names))

      counts = [self%histories, self%still, self%intervals, self%rocked, self%steps, self%evaluations, self%impacts, &
         & self%drifted]
   end function counts

end module dondolo_motion_work
