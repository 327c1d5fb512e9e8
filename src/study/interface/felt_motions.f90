!> The motions that one wall feels, outside a study.
module dondolo_interface_felt_motions
   use dondolo_base_error, only : error_type, out_of_range, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_building_floors, only : check_floor, floors_type
   use dondolo_record, only : largest_acceleration
   use dondolo_record_suite, only : suite_type
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: check_scale, find_motions

contains

   !> Check the scale of a record
   subroutine check_scale(suite, number, scale, error)
      type(suite_type), intent(in) :: suite
      !> Number of the record
      integer, intent(in) :: number
      !> Factor on it
      real(wp), intent(in) :: scale
      !> It makes the record exceed what an acceleration can be
      type(error_type), allocatable, intent(out) :: error

      if (.not. abs(scale)*suite%peaks(number) <= largest_acceleration) call raise_input(error, 'scale = '// &
         & to_text(scale)//': makes record '''//suite%records(number)%name//''' exceed '// &
         & to_text(largest_acceleration)//' m/s2', out_of_range, 'scale')
   end subroutine check_scale

   !> Motions that move a wall: those of the ground, or of the floor that it stands on
   subroutine find_motions(wall, records, threads, floors, motions, error)
      type(wall_type), intent(in) :: wall
      !> Motions of the ground
      type(suite_type), pointer, intent(in) :: records
      !> Number of threads that make them; 0: all that OpenMP gives
      integer, intent(in) :: threads
      !> Keeps those of the floor
      type(floors_type), target, intent(inout) :: floors
      !> The motions
      type(suite_type), pointer, intent(out) :: motions
      !> They would be too long, or lack of memory
      type(error_type), allocatable, intent(out) :: error

      integer :: place

      motions => records
      if (.not. allocated(wall%building)) return
      call check_floor(wall%building, records, error)
      if (.not. allocated(error)) call floors%take(wall%building, records, threads, place, motions)
   end subroutine find_motions

end module dondolo_interface_felt_motions
