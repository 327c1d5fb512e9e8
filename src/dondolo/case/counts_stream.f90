!> Counts of a population, row by row, out of one file or of several that hold its parts.
module dondolo_counts_stream
   use dondolo_counts, only : counts_type
   use dondolo_counts_file, only : counts_file_type
   use dondolo_error, only : error_type
   use dondolo_system, only : remove_file
   implicit none
   private

   public :: counts_stream_type

   !> Counts that are read
   type :: counts_stream_type
      !> The files, in the order of their rows
      type(counts_file_type), allocatable :: files(:)
      !> The file that is read
      integer :: at = 0
   contains
      !> Begin with the first row
      procedure :: open => open_stream
      !> Read the next row
      procedure :: next
      !> Remove the files
      procedure :: remove
   end type counts_stream_type

contains

   !> Begin with the first row
   subroutine open_stream(self, error)
      !> The counts
      class(counts_stream_type), intent(inout) :: self
      !> A file cannot be read any more
      type(error_type), allocatable, intent(out) :: error

      if (self%at > 0) call self%files(self%at)%close()
      self%at = 1
      call self%files(1)%open(error)
   end subroutine open_stream

   !> Read the next row; after the last one nothing is open
   subroutine next(self, counts, found, error)
      !> The counts
      class(counts_stream_type), intent(inout) :: self
      !> Counts of the row
      type(counts_type), intent(out) :: counts
      !> Was there one?
      logical, intent(out) :: found
      !> A file cannot be read any more
      type(error_type), allocatable, intent(out) :: error

      do
         call self%files(self%at)%next(counts, found, error)
         if (found) return
         call self%files(self%at)%close()
         if (allocated(error) .or. self%at == size(self%files)) exit
         self%at = self%at + 1
         call self%files(self%at)%open(error)
         if (allocated(error)) exit
      end do
      self%at = 0
   end subroutine next

   !> Remove the files
   subroutine remove(self)
      !> The counts
      class(counts_stream_type), intent(inout) :: self

      integer :: i

      do i = 1, size(self%files)
         call remove_file(self%files(i)%path)
      end do
   end subroutine remove

end module dondolo_counts_stream
