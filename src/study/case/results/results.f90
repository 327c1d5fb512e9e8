!> Results of a case.
module dondolo_case_results
   use dondolo_base_warning, only : warnings_type
   use dondolo_case_check_rows, only : verdicts_type
   use dondolo_check_sheet, only : sheet_type
   use dondolo_fragility, only : fragility_type
   use dondolo_fragility_certified, only : state_bounds_type
   use dondolo_fragility_stripe_counts, only : stripe_counts_type
   use dondolo_fragility_tie_tallies, only : tie_tally_type
   use dondolo_motion_certified, only : certified_type
   use dondolo_motion_ensemble, only : name_engines
   use dondolo_motion_response, only : response_type, trace_type
   use dondolo_motion_work, only : work_type
   use dondolo_population, only : population_type
   use dondolo_population_designs, only : design_type
   use dondolo_population_sensitivity, only : sensitivity_type
   use dondolo_population_store, only : store_type
   use dondolo_population_typology, only : typology_type
   use dondolo_population_unions, only : unions_type
   implicit none
   private

   public :: results_type, row_counts_type, shown_row_type
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

   !> Counts and curves of a wall, or of one of its mechanisms
   type, extends(stripe_counts_type) :: row_counts_type
      !> All its histories (histories, levels), if they are kept
      type(response_type), allocatable :: response(:, :)
      !> What they do to the ties of the wall (ties, levels)
      type(tie_tally_type), allocatable :: tallies(:, :)
      !> Histories of each stripe in which the ground falls away from the wall; not allocated without vertical motion
      integer, allocatable :: uplift(:)
      !> How they are certified, if they are (histories, levels)
      type(certified_type), allocatable :: certified(:, :)
      !> Then: bounds of each EDP threshold, since the last digit of the input decides some outcomes
      type(state_bounds_type), allocatable :: bounds(:)
   end type row_counts_type

   !> Results of a case; what its task does not make stays empty
   type :: results_type
      !> Counts and curves of the one wall, with all its histories: task 'stripes'
      type(row_counts_type) :: row
      !> What came of the rows of the population, in the order of rows: task 'typology'
      type(store_type), allocatable :: stores(:)
      !> Their counts and curves; none if only some of the rows were run
      type(population_type) :: population
      !> Curves of the population for each EDP threshold (curves, thresholds): task 'typology'; of size 0 for designs, which
      !> are alternatives; not allocated if only some of the rows were run
      type(typology_type), allocatable :: typologies(:, :)
      !> Of the same histories: walls with several mechanisms, and behind them the means over the population and its groups:
      !> task 'typology'
      type(unions_type) :: unions
      !> The walls as designs of one wall, in the order of rows; not allocated: they are none
      type(design_type), allocatable :: designs(:)
      !> Sobol indices of a wall with variants, or why there are none; neither where there are no variants
      type(sensitivity_type), allocatable :: sensitivity
      character(len=:), allocatable :: no_sensitivity
      !> The first rows of the population: task 'typology'
      type(shown_row_type), allocatable :: shown(:)
      !> How many rows an earlier run had left: task 'typology'
      integer :: resumed = 0
      !> Check by a building code; without rows: none was asked for
      type(sheet_type) :: check
      !> What came of the checks of a population, once their table is written
      type(verdicts_type) :: verdicts
      !> The one response: task 'history'
      type(response_type) :: response
      !> Its time history
      type(trace_type) :: trace
      !> What was computed, of all walls
      type(work_type) :: work
      !> What the user should know
      type(warnings_type) :: warnings
   contains
      !> The engines that have run, with the build variant
      procedure :: name_engines => name_engines_that_ran
      !> Remove the stores
      procedure :: remove_stores
   end type results_type

contains

   !> The engines that have run, with the build variant; counts that were merged may be of another than this one
   subroutine name_engines_that_ran(self, text)
      class(results_type), intent(in) :: self
      !> See name_engines
      character(len=:), allocatable, intent(out) :: text

      character(len=:), allocatable :: variant

      if (allocated(self%stores)) call self%stores(1)%identity%key%get('build variant', variant)
      ! A variant that is not allocated is an argument that is not present
      call name_engines(self%work, text, variant)
   end subroutine name_engines_that_ran

   !> Remove the stores
   subroutine remove_stores(self)
      class(results_type), intent(inout) :: self

      integer :: i

      do i = 1, size(self%stores)
         call self%stores(i)%remove()
      end do
   end subroutine remove_stores

end module dondolo_case_results
