!> The criterion of a building code for time histories at the site's level, beside the kinematic check of a case.
module dondolo_case_check_case
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_case, only : case_type
   use dondolo_check_input, only : state_names
   use dondolo_check_kinematic, only : kinematic_type, new_kinematic
   use dondolo_check_history_check, only : check_histories
   use dondolo_check_sheet, only : sheet_type
   use dondolo_fragility_scaling, only : new_scaling
   use dondolo_fragility_stripes, only : multiple_stripe, stripes_type
   use dondolo_fragility_study, only : find_level, study_type
   use dondolo_motion_response, only : response_type
   implicit none
   private

   public :: check_stripes

contains

   !> Add the criterion for time histories, from a stripe that stands at the peak acceleration of the site or from one more;
   !> nothing where each level has records of its own and none stands there, or histories end before the capacity
   subroutine check_stripes(case, stripes, sheet, error, threads)
      type(case_type), intent(in), target :: case
      !> What was run
      type(stripes_type), intent(in) :: stripes
      type(sheet_type), intent(inout) :: sheet
      !> What cannot be run
      type(error_type), allocatable, intent(out) :: error
      !> Number of threads; 0: all
      integer, intent(in) :: threads

      type(kinematic_type) :: kinematic
      type(study_type) :: study
      type(stripes_type) :: more
      real(wp) :: level
      integer :: state, at
      logical :: ends_early

      ends_early = case%solver%solver%edp_limit < 1.0_wp
      call new_kinematic(kinematic, case%wall, error)
      if (.not. allocated(error) .and. kinematic%is_without_spectrum) return
      do state = 2, size(state_names)
         if (allocated(error)) return
         associate (spectrum => case%check%spectrum(state))
            level = spectrum%pga
         end associate
         at = 0
         if (stripes%im == 'pga' .and. .not. ends_early) at = find_level(stripes%levels, level)
         if (at > 0) then
            call put(stripes%response(:, at), stripes%ran(:, at))
         else if (.not. allocated(case%factor)) then
            if (state == 2 .or. case%check%has_states()) then
               ! d_0 belongs to the capacity rotation, whatever EDP is collapse in the stripes
               call case%make_study(study, threads)
               call new_scaling(study%scaling, 'pga', error)
               study%values = case%suite%values(study%scaling%measure, threads)
               study%levels = [level]
               study%solver%estimate_error = .false.
               study%solver%edp_limit = max(study%solver%edp_limit, 1.0_wp)
               if (.not. allocated(error)) call multiple_stripe(more, case%wall, study, error)
               if (allocated(error)) return
            end if
            call put(more%response(:, 1), more%ran(:, 1))
         end if
      end do

   contains

      !> Put the criterion of a stripe
      subroutine put(response, ran)
         type(response_type), intent(in) :: response(:)
         !> Which of the histories were run
         logical, intent(in) :: ran(:)

         call check_histories(sheet, kinematic, state, level, count_records(ran), pack(response%edp, ran))
      end subroutine put

      !> Records that were run
      pure integer function count_records(ran)
         !> Which of the histories were run
         logical, intent(in) :: ran(:)

         integer :: i

         count_records = count([(any(ran .and. stripes%record == i), i=1, size(case%suite%records))])
      end function count_records

   end subroutine check_stripes

end module dondolo_case_check_case
