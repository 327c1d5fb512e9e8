!> Names that were met, so that the next one is known to be new in a time that does not grow with their number.
!>
!> A hash table with open addressing (Knuth 1998, The Art of Computer Programming, volume 3, section 6.4, algorithm L).
module dondolo_name_index
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_lines, only : lines_type
   implicit none
   private

   public :: name_index_type

   !> Names, each once
   type :: name_index_type
      private
      !> The names in the order in which they were added
      type(lines_type) :: names
      !> Number of the name in each slot, 0 in an empty one; at most half of the slots are taken
      integer, allocatable :: slots(:)
   contains
      !> Add a name
      procedure :: add
   end type name_index_type

contains

   !> Add a name
   subroutine add(self, name, known)
      !> Names
      class(name_index_type), intent(inout) :: self
      !> A name
      character(len=*), intent(in) :: name
      !> It was there already, and is not added
      logical, intent(out) :: known

      integer :: slot

      if (.not. allocated(self%slots)) allocate (self%slots(32), source=0)
      slot = slot_of(self, name)
      known = self%slots(slot) > 0
      if (known) return
      call self%names%add(name)
      self%slots(slot) = self%names%count
      if (2*self%names%count > size(self%slots)) call grow(self)
   end subroutine add

   !> Double the number of slots
   subroutine grow(self)
      !> Names
      type(name_index_type), intent(inout) :: self

      integer :: slots, i

      slots = 2*size(self%slots)
      deallocate (self%slots)
      allocate (self%slots(slots), source=0)
      do i = 1, self%names%count
         self%slots(slot_of(self, self%names%line(i)%text)) = i
      end do
   end subroutine grow

   !> The slot that a name is in, or the empty one where it belongs
   pure function slot_of(self, name) result(slot)
      !> Names
      type(name_index_type), intent(in) :: self
      !> A name
      character(len=*), intent(in) :: name
      !> Number of the slot, from 1
      integer :: slot

      slot = int(modulo(hash_of(name), size(self%slots, kind=int64))) + 1
      do while (self%slots(slot) > 0)
         if (self%names%line(self%slots(slot))%text == name) exit
         slot = modulo(slot, size(self%slots)) + 1
      end do
   end function slot_of

   !> A number that hardly any two names share: FNV-1a of 32 bits (Fowler, Noll and Vo), without blanks at the end
   pure function hash_of(name) result(hash)
      !> A name
      character(len=*), intent(in) :: name
      !> Its number, 0 to 2**32 - 1
      integer(int64) :: hash

      integer(int64), parameter :: offset = 2166136261_int64, prime = 16777619_int64, mask = 4294967295_int64
      integer :: i

      hash = offset
      do i = 1, len_trim(name)
         hash = iand(ieor(hash, int(ichar(name(i:i)), int64))*prime, mask)
      end do
   end function hash_of

end module dondolo_name_index
