!> What comes of a case.
module dondolo_results
   use dondolo_counts, only : counts_type
   use dondolo_counts_stream, only : counts_stream_type
   use dondolo_ensemble, only : name_engines
   use dondolo_fragility, only : fragility_type
   use dondolo_response, only : response_type, trace_type
   use dondolo_typology, only : typology_type
   use dondolo_warning, only : warnings_type
   use dondolo_work, only : work_type
   implicit none
   private

   public :: results_type, shown_row_type
   public :: shown_rows

   !> Rows of a population that are shown one by one at the end of a run
   integer, parameter :: shown_rows = 20

   !> A row of a population that is shown
   type :: shown_row_type
      !> Name of the wall
      character(len=:), allocatable :: name
      !> Its mechanism
      character(len=:), allocatable :: mechanism
      !> Curve of collapse
      type(fragility_type) :: curve
   end type shown_row_type

   !> Results of a case; what its task does not make stays empty
   type :: results_type
      !> Counts and curves of the one wall, with all its histories: task 'stripes'
      type(counts_type) :: row
      !> Counts of all rows of the population: task 'typology'
      type(counts_stream_type) :: counts
      !> Curves of the population for each EDP threshold (curves, thresholds): task 'typology'; none if only some of its
      !> rows were run
      type(typology_type), allocatable :: typologies(:, :)
      !> The first rows of the population: task 'typology'
      type(shown_row_type), allocatable :: shown(:)
      !> Last row that an earlier run had left, 0 if there was none: task 'typology'
      integer :: resumed = 0
      !> The one response: task 'history'
      type(response_type) :: response
      !> Its time history
      type(trace_type) :: trace
      !> What was computed, of all walls: tasks 'stripes' and 'typology'
      type(work_type) :: work
      !> What the user should know
      type(warnings_type) :: warnings
   contains
      !> The engines that have run, with the build variant
      procedure :: name_engines => name_engines_that_ran
   end type results_type

contains

   !> The engines that have run, with the build variant; counts that were merged may be of another than this one
   subroutine name_engines_that_ran(self, text)
      !> Results
      class(results_type), intent(in) :: self
      !> See name_engines
      character(len=:), allocatable, intent(out) :: text

      if (allocated(self%counts%files)) then
         call name_engines(self%work, text, self%counts%files(1)%key%variant)
      else
         call name_engines(self%work, text)
      end if
   end subroutine name_engines_that_ran

end module dondolo_results
