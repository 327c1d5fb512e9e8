!> Lines of text, one after the other: warnings, the echo of a case, names of files.
module dondolo_base_lines
   implicit none
   private

   public :: lines_type, line_type

   !> One line
   type :: line_type
      !> Its text
      character(len=:), allocatable :: text
   end type line_type

   !> Lines in the order in which they were added
   type :: lines_type
      !> How many there are
      integer :: count = 0
      !> The lines; those beyond `count` are room
      type(line_type), allocatable :: line(:)
   contains
      !> Add a line
      procedure :: add
   end type lines_type

contains

   !> Add a line
   subroutine add(self, text)
      class(lines_type), intent(inout) :: self
      !> Text of the new line
      character(len=*), intent(in) :: text

      type(line_type), allocatable :: more(:)
      integer :: i

      if (.not. allocated(self%line)) allocate (self%line(16))
      if (self%count == size(self%line)) then
         allocate (more(2*self%count))
         do i = 1, self%count
            call move_alloc(self%line(i)%text, more(i)%text)
         end do
         call move_alloc(more, self%line)
      end if
      self%count = self%count + 1
      self%line(self%count)%text = text
   end subroutine add

end module dondolo_base_lines
