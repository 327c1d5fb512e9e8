!> Multiple stripe analyses for tests: of records, levels and settings as they come.
module stripe_runs
   use checks, only : check_ok
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_fragility_scaling, only : new_scaling, scaling_type
   use dondolo_fragility_stripes, only : multiple_stripe, stripes_type
   use dondolo_fragility_study, only : new_study, study_type
   use dondolo_motion_solver, only : solver_type
   use dondolo_record, only : record_type
   use dondolo_record_suite, only : new_suite, suite_type
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: run_stripes, suite_of

contains

   !> A suite of copies of records
   function suite_of(records) result(suite)
      type(record_type), intent(in) :: records(:)
      type(suite_type) :: suite
      type(record_type), allocatable :: copies(:)

      copies = records
      call new_suite(suite, copies)
   end function suite_of

   !> Stripes that must be fine
   subroutine run_stripes(stripes, wall, records, levels, im, polarity, solver, threads)
      type(stripes_type), intent(out) :: stripes
      type(wall_type), intent(in) :: wall
      type(record_type), intent(in) :: records(:)
      real(wp), intent(in) :: levels(:)
      character(len=*), intent(in) :: im, polarity
      type(solver_type), intent(in) :: solver
      integer, intent(in) :: threads
      type(suite_type), target :: suite
      type(scaling_type) :: scaling
      type(study_type) :: study
      type(error_type), allocatable :: error

      call new_scaling(scaling, im, error)
      call check_ok(error, im)
      if (allocated(error)) return
      suite = suite_of(records)
      call new_study(study, suite, scaling, levels, polarity, solver, threads)
      call multiple_stripe(stripes, wall, study, error)
      call check_ok(error, 'stripes')
   end subroutine run_stripes

end module stripe_runs
