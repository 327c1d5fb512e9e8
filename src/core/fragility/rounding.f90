!> Histories under records that would be printed by the same digits: how many outcomes hang on digits that no file has
!> (docs/reading_a_curve.md).
module dondolo_fragility_rounding
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_memory, only : check_room
   use dondolo_building_floors, only : floors_type
   use dondolo_motion_certified, only : not_known
   use dondolo_motion_ensemble, only : ensemble_type, run_ensemble
   use dondolo_motion_queue, only : progress_interface
   use dondolo_motion_solver, only : solver_type
   use dondolo_record, only : record_type
   use dondolo_record_printed_digits, only : move_within_rounding
   use dondolo_record_suite, only : new_suite, suite_type
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: run_rounded

   !> Memory of a sample [bytes], and how often it is there: the record and its vertical component, moved and joined
   real(wp), parameter :: bytes_of_sample = 8.0_wp, copies = 4.0_wp

contains

   !> Run histories with every sample of their records moved at random within half a unit of its last digit; the factors on the
   !> records stay
   subroutine run_rounded(edp, wall, records, ensemble, solver, threads, error, progress)
      !> EDPs, one for each history; `not_known` where it is not known how the record is printed
      real(wp), allocatable, intent(out) :: edp(:)
      type(wall_type), intent(in) :: wall
      !> Accelerograms of the ground
      type(record_type), intent(in) :: records(:)
      !> The histories: records and factors
      type(ensemble_type), intent(in) :: ensemble
      !> Engine, tolerances and limit; errors are not estimated
      type(solver_type), intent(in) :: solver
      !> Number of threads; 0: all that OpenMP gives
      integer, intent(in) :: threads
      !> A history was given up
      type(error_type), allocatable, intent(out) :: error
      !> Hears how far the work is
      procedure(progress_interface), optional :: progress

      type(record_type), allocatable :: moved(:)
      type(suite_type), target :: ground
      type(suite_type), pointer :: on_ground, motions
      type(floors_type), target :: floors
      type(ensemble_type) :: known
      type(solver_type) :: once
      logical, allocatable :: is_known(:), runs(:)
      integer :: i, place

      allocate (edp(size(ensemble%record)), source=not_known)
      call check_room(copies*bytes_of_sample*sum([(real(size(records(i)%acceleration), wp), i=1, size(records))]), error)
      if (allocated(error)) return
      allocate (moved(size(records)), is_known(size(records)))
      do i = 1, size(records)
         call move_within_rounding(records(i), moved(i), is_known(i))
      end do
      runs = is_known(ensemble%record)
      if (.not. any(runs)) return
      call new_suite(ground, moved, threads)
      on_ground => ground
      motions => ground
      if (allocated(wall%building)) call floors%take(wall%building, on_ground, threads, place, motions)
      known%record = pack(ensemble%record, runs)
      known%scale = pack(ensemble%scale, runs)
      once = solver
      once%estimate_error = .false.
      call run_ensemble(known, wall%mechanism, motions, once, threads, error, progress)
      if (.not. allocated(error)) edp = unpack(known%response%edp, runs, edp)
   end subroutine run_rounded

end module dondolo_fragility_rounding
