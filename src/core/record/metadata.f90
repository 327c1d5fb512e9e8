!> What the header of an accelerogram file says: keys and values, as texts, in the file's order.
!>
!> Keys that mean the same in every format are written alike: event, date, station, network, component, magnitude,
!> latitude, longitude, processing, reading, format, quantity, units. All others keep the name that the file gives them.
module dondolo_record_metadata
   use dondolo_base_plain, only : blanked
   use dondolo_base_text, only : blanks, lower, stripped
   implicit none
   private

   public :: entry_type, metadata_type

   !> Keys that mean the same in every format
   character(len=*), parameter :: common(13) = [character(len=10) :: 'event', 'date', 'station', 'network', &
      & 'component', 'magnitude', 'latitude', 'longitude', 'processing', 'reading', 'format', &
      & 'quantity', 'units']

   !> A key and its value
   type :: entry_type
      !> Key
      character(len=:), allocatable :: key
      !> Value, never empty
      character(len=:), allocatable :: value
   end type entry_type

   !> Keys and values
   type :: metadata_type
      !> The entries, in order; not allocated is empty
      type(entry_type), allocatable :: entries(:)
   contains
      !> Set the value of a key
      procedure :: set
      !> Add a sentence to the value of a key
      procedure :: append
      !> Value of a key
      procedure :: get
      !> Remove a key
      procedure :: remove
      !> Set all entries of another list
      procedure :: include
      !> Number of entries
      procedure :: count => count_entries
      !> Number of the entry of a key
      procedure, private :: find
   end type metadata_type

contains

   !> Set the value of a key: a new entry at the end, or another value for the entry there is
   pure subroutine set(self, key, value)
      class(metadata_type), intent(inout) :: self
      !> Key; upper and lower case are the same
      character(len=*), intent(in) :: key
      !> Value; blanks around it are dropped, as are control characters, and an empty one says nothing
      character(len=*), intent(in) :: value

      type(entry_type), allocatable :: longer(:)
      integer :: i, n

      if (verify(blanked(value), blanks) == 0) return
      n = self%count()
      i = self%find(key)
      if (i == 0) then
         allocate (longer(n + 1))
         do i = 1, n
            call move_alloc(self%entries(i)%key, longer(i)%key)
            call move_alloc(self%entries(i)%value, longer(i)%value)
         end do
         longer(n + 1)%key = trim(adjustl(blanked(key)))
         if (any(common == lower(longer(n + 1)%key))) longer(n + 1)%key = lower(longer(n + 1)%key)
         call move_alloc(longer, self%entries)
         i = n + 1
      end if
      self%entries(i)%value = stripped(blanked(value))
   end subroutine set

   !> Add a sentence to the value of a key, after a semicolon
   pure subroutine append(self, key, sentence)
      class(metadata_type), intent(inout) :: self
      !> Key
      character(len=*), intent(in) :: key
      !> Sentence without a full stop; an empty one adds nothing
      character(len=*), intent(in) :: sentence

      character(len=:), allocatable :: before

      if (len_trim(sentence) == 0) return
      before = self%get(key)
      if (len(before) > 0) before = before//'; '
      call self%set(key, before//sentence)
   end subroutine append

   !> Remove a key
   pure subroutine remove(self, key)
      class(metadata_type), intent(inout) :: self
      !> Key; one that is not there is left alone
      character(len=*), intent(in) :: key

      type(entry_type), allocatable :: shorter(:)
      integer :: i, k

      k = self%find(key)
      if (k == 0) return
      allocate (shorter(self%count() - 1))
      do i = 1, size(shorter)
         call move_alloc(self%entries(merge(i, i + 1, i < k))%key, shorter(i)%key)
         call move_alloc(self%entries(merge(i, i + 1, i < k))%value, shorter(i)%value)
      end do
      call move_alloc(shorter, self%entries)
   end subroutine remove

   !> Length of the value of a key
   pure integer function value_length(self, key)
      class(metadata_type), intent(in) :: self
      !> Key
      character(len=*), intent(in) :: key

      integer :: i

      value_length = 0
      i = self%find(key)
      if (i > 0) value_length = len(self%entries(i)%value)
   end function value_length

   !> Value of a key
   pure function get(self, key) result(value)
      class(metadata_type), intent(in) :: self
      !> Key; upper and lower case are the same
      character(len=*), intent(in) :: key
      !> Its value, empty if there is none
      character(len=value_length(self, key)) :: value

      if (len(value) > 0) value = self%entries(self%find(key))%value
   end function get

   !> Set all entries of another list
   pure subroutine include(self, other)
      class(metadata_type), intent(inout) :: self
      !> What to set
      type(metadata_type), intent(in) :: other

      integer :: i

      do i = 1, other%count()
         call self%set(other%entries(i)%key, other%entries(i)%value)
      end do
   end subroutine include

   !> Number of entries
   pure function count_entries(self) result(count)
      class(metadata_type), intent(in) :: self
      !> How many
      integer :: count

      count = 0
      if (allocated(self%entries)) count = size(self%entries)
   end function count_entries

   !> Number of the entry of a key
   pure function find(self, key) result(i)
      class(metadata_type), intent(in) :: self
      !> Key
      character(len=*), intent(in) :: key
      !> Number of the entry, 0 if there is none
      integer :: i

      do i = self%count(), 1, -1
         if (lower(self%entries(i)%key) == lower(trim(adjustl(key)))) exit
      end do
   end function find

end module dondolo_record_metadata
