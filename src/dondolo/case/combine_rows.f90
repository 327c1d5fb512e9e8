!> The curves of a population out of the counts of its rows, which are read as often as it takes (docs/theory.md,
!> section 6), and are not kept.
module dondolo_combine_rows
   use dondolo_case, only : case_type
   use dondolo_counts, only : counts_type
   use dondolo_error, only : error_type, raise_failure
   use dondolo_fragility, only : fragility_type
   use dondolo_kinds, only : wp
   use dondolo_population, only : member_type, population_reader_type
   use dondolo_results, only : results_type, shown_rows
   use dondolo_typology, only : combination_type
   use dondolo_wall, only : mechanism_names
   use dondolo_wall_curves, only : mechanism_counts_type, new_wall_curves, wall_curves_type
   use dondolo_warnings, only : fit_warning_type, warn_of_records
   implicit none
   private

   public :: combine_rows

contains

   !> Curves of the population, and what there is to warn of
   subroutine combine_rows(case, results, error)
      !> The case
      type(case_type), intent(in) :: case
      !> Its results: the counts are there, curves and warnings are set
      type(results_type), intent(inout) :: results
      !> What cannot be combined
      type(error_type), allocatable, intent(out) :: error

      type(combination_type) :: combination
      type(fit_warning_type) :: fits
      integer :: k, thresholds

      call look_at_rows(case, results, fits, error)
      thresholds = size(case%stripes%thresholds)
      do k = 1, thresholds
         call combination%start(case%stripes%levels)
         do while (.not. combination%complete .and. .not. allocated(error))
            call add_walls(case, results, k, combination, error)
            if (.not. allocated(error)) call combination%end_pass(error)
         end do
         if (allocated(error)) return
         if (k == 1) allocate (results%typologies(size(combination%typologies), thresholds))
         results%typologies(:, k) = combination%typologies
      end do
      call case%survey%oddities%warn(results%warnings)
      call warn_of_records(case%suite%records, case%suite%peaks, case%solver%gravity, results%warnings)
      call case%survey%scales%warn(results%warnings)
      call fits%warn(results%typologies(:, thresholds), results%warnings)
   end subroutine combine_rows

   !> Go through the rows and their names: what there is to say of the curves, and those that are shown
   subroutine look_at_rows(case, results, fits, error)
      !> The case
      type(case_type), intent(in) :: case
      !> Its results: the rows that are shown are set
      type(results_type), intent(inout) :: results
      !> What there is to say of the curves
      type(fit_warning_type), intent(inout) :: fits
      !> A file has changed
      type(error_type), allocatable, intent(out) :: error

      type(population_reader_type) :: reader
      type(member_type) :: member
      type(counts_type) :: counts
      logical :: found, is_there

      allocate (results%shown(min(shown_rows, case%survey%rows)))
      call results%counts%open(error)
      if (.not. allocated(error)) &
         & call reader%open(case%population_path(), error, case%solver%gravity, is_checked=.false.)
      do while (.not. allocated(error))
         call results%counts%next(counts, found, error)
         if (allocated(error) .or. .not. found) exit
         call reader%next(member, is_there, error)
         if (.not. allocated(error) .and. .not. is_there) &
            & call raise_failure(error, case%population_path()//': has changed while it was read')
         if (allocated(error)) exit
         associate (curve => counts%curve(size(counts%curve)))
            call fits%look(curve, member%wall%name())
            if (counts%row <= shown_rows) then
               results%shown(counts%row)%name = member%wall%name()
               results%shown(counts%row)%mechanism = member%wall%mechanism_name()
               results%shown(counts%row)%curve = curve
            end if
         end associate
      end do
      call reader%close()
   end subroutine look_at_rows

   !> Show all walls to a combination: a pass
   subroutine add_walls(case, results, threshold, combination, error)
      !> The case
      type(case_type), intent(in) :: case
      !> Its results: the counts
      type(results_type), intent(inout) :: results
      !> Number of the EDP threshold
      integer, intent(in) :: threshold
      !> The combination
      type(combination_type), intent(inout) :: combination
      !> A file has changed, or counts cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      type(counts_type) :: rows(size(mechanism_names)), counts
      integer :: number
      logical :: found

      number = 0
      call results%counts%open(error)
      do while (.not. allocated(error))
         call results%counts%next(counts, found, error)
         if (allocated(error)) return
         ! A wall is complete when the next one begins.
         if (number > 0 .and. .not. (found .and. counts%continues)) then
            call add_wall(case, rows(:number), threshold, combination, error)
            if (allocated(error)) return
            number = 0
         end if
         if (.not. found) exit
         number = number + 1
         rows(number) = counts
      end do
   end subroutine add_walls

   !> Show a wall to a combination
   subroutine add_wall(case, rows, threshold, combination, error)
      !> The case
      type(case_type), intent(in) :: case
      !> Its rows
      type(counts_type), intent(in) :: rows(:)
      !> Number of the EDP threshold
      integer, intent(in) :: threshold
      !> The combination
      type(combination_type), intent(inout) :: combination
      !> Counts that cannot be fitted
      type(error_type), allocatable, intent(out) :: error

      type(wall_curves_type) :: wall
      type(mechanism_counts_type) :: counts(size(rows))
      character(len=:), allocatable :: group
      integer :: m

      group = ''
      if (rows(1)%group > 0) group = case%survey%groups%line(rows(1)%group)%text
      do m = 1, size(rows)
         counts(m) = mechanism_counts_type(mechanism_names(rows(m)%mechanism), rows(m)%p_occ, &
            & rows(m)%curve(threshold), rows(m)%reached(:, threshold), rows(m)%histories)
      end do
      call new_wall_curves(wall, group, rows(1)%weight, counts, case%stripes%levels, error, combination%is_summing())
      if (.not. allocated(error)) call combination%add(wall)
   end subroutine add_wall

end module dondolo_combine_rows
