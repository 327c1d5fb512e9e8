!> What a case uses of the methods of others, in the words of dondolo_files_references.
module dondolo_case_cited
   use dondolo_base_lines, only : lines_type
   use dondolo_case, only : case_type
   use dondolo_case_job_group, only : history_task, typology_task
   use dondolo_case_survey, only : add_wall_words
   implicit none
   private

   public :: list_used

contains

   !> List what a case uses
   subroutine list_used(case, used)
      type(case_type), intent(in) :: case
      type(lines_type), intent(out) :: used

      integer :: i
      logical :: one_motion

      one_motion = case%job%task == history_task
      if (case%job%task == typology_task) then
         used = case%survey%used
      else
         call add_wall_words(used, case%wall)
      end if
      if (case%solver%solver%engine == 'rk45' .or. (one_motion .and. case%solver%solver%engine == 'auto')) call used%add('rk45')
      if (.not. one_motion) then
         call used%add('fit')
         call used%add('clustered')
         call used%add(trim(case%stripes%scaling%measure%kind))
         call used%add(case%stripes%scaling%name)
         if (case%stripes%states == 'ordinal') call used%add('ordinal')
      end if
      if (allocated(case%check)) call used%add('check')
      if (allocated(case%uncertainty)) then
         call used%add('uncertainty')
         ! A published range, or another distribution
         if (case%uncertainty%has('restitution_factor')) call used%add(case%uncertainty%word('restitution_factor'))
      end if
      do i = 1, size(case%suite%records)
         if (case%suite%records(i)%metadata%get('format') == 'synthetic') call used%add('synthetic')
      end do
   end subroutine list_used

end module dondolo_case_cited
