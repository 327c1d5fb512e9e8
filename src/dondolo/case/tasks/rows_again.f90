!> The rows of a population, read again for what its stores do not hold: names, mechanisms, walls.
module dondolo_rows_again
   use dondolo_case, only : case_type
   use dondolo_error, only : error_type, raise_failure
   use dondolo_member, only : member_type
   use dondolo_population_reader, only : population_reader_type
   implicit none
   private

   public :: rows_again_type

   !> A population that is read again
   type :: rows_again_type
      type(population_reader_type), private :: reader
      character(len=:), allocatable, private :: file
   contains
      !> Begin with the first row
      procedure :: open => open_rows
      !> The next row
      procedure :: next => next_row
      !> Stop reading
      procedure :: close => close_rows
   end type rows_again_type

contains

   !> Begin with the first row
   subroutine open_rows(self, case, error)
      class(rows_again_type), intent(inout) :: self
      type(case_type), intent(in) :: case
      !> The table cannot be read any more
      type(error_type), allocatable, intent(out) :: error

      self%file = case%population_path()
      call self%reader%open(self%file, error, case%solver%gravity, is_checked=.false., facade=case%facade)
   end subroutine open_rows

   !> The next row
   subroutine next_row(self, member, error)
      class(rows_again_type), intent(inout) :: self
      !> The row
      type(member_type), intent(inout) :: member
      !> The table has changed
      type(error_type), allocatable, intent(inout) :: error

      logical :: found

      if (allocated(error)) return
      call self%reader%next(member, found, error)
      if (.not. allocated(error) .and. .not. found) then
         call raise_failure(error, self%file//': has changed while it was read')
      end if
   end subroutine next_row

   !> Stop reading
   subroutine close_rows(self)
      class(rows_again_type), intent(inout) :: self

      call self%reader%close()
   end subroutine close_rows

end module dondolo_rows_again
