!> Warnings of --check: what the curve will lack, before anything is run.
module dondolo_case_plan_warnings
   use dondolo_case_warning, only : warning_type, warnings_type
   use dondolo_fragility_clustered, only : fewest_clusters
   use dondolo_motion_work, only : work_type
   implicit none
   private

   public :: warn_of_plan

contains

   !> Warn of levels and records from which no useful curve can come
   subroutine warn_of_plan(levels, clusters, work, warnings)
      !> Number of levels
      integer, intent(in) :: levels
      !> Cluster of each record
      integer, intent(in) :: clusters(:)
      !> Work of all histories
      type(work_type), intent(in) :: work
      !> Warnings to add to
      type(warnings_type), intent(inout) :: warnings

      type(warning_type) :: warning

      if (levels == 1) call warnings%add(warning_type('one_level'))
      if (work%histories > 0 .and. work%still >= work%histories) call warnings%add(warning_type('all_below_trigger'))
      if (size(clusters) == 1) then
         call warnings%add(warning_type('one_record'))
      else if (maxval(clusters) < fewest_clusters) then
         warning%code = 'few_clusters'
         call warning%with('records', size(clusters))
         call warning%with('clusters', maxval(clusters))
         call warning%with('limit', fewest_clusters)
         call warnings%add(warning)
      end if
   end subroutine warn_of_plan

end module dondolo_case_plan_warnings
