!> Where names stand: a hash table from names to lines of a file, 24 to 48 bytes for each name, 72 while it grows.
!>
!> Of a name only a fingerprint of 62 bits is kept: among a million names two are taken for the same once in 1e7 times.
module dondolo_files_name_index
   use, intrinsic :: iso_fortran_env, only : int64
   use dondolo_base_fingerprint, only : fingerprint_type
   implicit none
   private

   public :: name_index_type

   !> Names and their lines
   type :: name_index_type
      private
      !> Was there no memory for more names? What is new then is not noted
      logical, public :: lacks_memory = .false.
      !> Number of names
      integer :: names = 0
      !> Fingerprint of the name in each place; 0: the place is free
      integer(int64), allocatable :: key(:)
      !> Its line
      integer, allocatable :: line(:)
   contains
      !> Look a name up, and note it if it is new
      procedure :: note
   end type name_index_type

contains

   !> Look a name up, and note it if it is new
   subroutine note(self, name, line, known)
      class(name_index_type), intent(inout) :: self
      !> A name
      character(len=*), intent(in) :: name
      !> Its line
      integer, intent(in) :: line
      !> Line of the same name before; 0 if the name is new
      integer, intent(out) :: known

      integer(int64) :: key
      integer :: place

      known = 0
      if (.not. allocated(self%key)) call make_room(self, 1024)
      if (.not. self%lacks_memory) then
         if (2*self%names >= size(self%key)) call make_room(self, 2*size(self%key))
      end if
      if (self%lacks_memory) return
      ! Trailing blanks do not distinguish names
      key = key_of(trim(name))
      place = place_of(self, key)
      if (self%key(place) == key) then
         known = self%line(place)
         return
      end if
      self%key(place) = key
      self%line(place) = line
      self%names = self%names + 1
   end subroutine note

   !> Fingerprint of a name, not 0
   pure integer(int64) function key_of(name) result(key)
      !> Name
      character(len=*), intent(in) :: name

      type(fingerprint_type) :: fingerprint

      call fingerprint%add_text(name)
      key = ishft(fingerprint%value(1), 31) + fingerprint%value(2) + 1
   end function key_of

   !> The place of a key, or the free one that it would take
   pure integer function place_of(self, key) result(place)
      type(name_index_type), intent(in) :: self
      !> Key
      integer(int64), intent(in) :: key

      place = int(modulo(key, int(size(self%key), int64))) + 1
      do while (self%key(place) /= 0 .and. self%key(place) /= key)
         place = modulo(place, size(self%key)) + 1
      end do
   end function place_of

   !> Make room for more names
   subroutine make_room(self, places)
      type(name_index_type), intent(inout) :: self
      !> Number of places, a power of two
      integer, intent(in) :: places

      integer(int64), allocatable :: key(:)
      integer, allocatable :: line(:)
      integer :: i, place, stat

      call move_alloc(self%key, key)
      call move_alloc(self%line, line)
      allocate (self%key(places), stat=stat)
      if (stat == 0) allocate (self%line(places), stat=stat)
      self%lacks_memory = stat /= 0
      if (self%lacks_memory) return
      self%key = 0
      self%line = 0
      if (.not. allocated(key)) return
      do i = 1, size(key)
         if (key(i) == 0) cycle
         place = place_of(self, key(i))
         self%key(place) = key(i)
         self%line(place) = line(i)
      end do
   end subroutine make_room

end module dondolo_files_name_index
