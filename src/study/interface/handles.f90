!> Objects of programs in other languages: records, walls, studies, stores and results are kept here, and a program refers to
!> each by its handle, a number to Python and a pointer to C.
!>
!> A handle is the number of a slot and, above it, how often the slot was used, not an address: one that was freed is never valid
!> again, and one of another kind of object is detected. One thread at a time fills or empties a slot; procedures that look one up
!> need no lock, since slots never move. Python's lock is held meanwhile too, so that no fork comes in between.
module dondolo_interface_handles
   use, intrinsic :: iso_c_binding, only : c_int64_t
   use dondolo_base_error, only : error_type, raise_input
   use dondolo_building_floors, only : floors_type
   use dondolo_fragility_study, only : study_type
   use dondolo_population_store, only : store_type
   use dondolo_record_rows, only : record_rows_type
   use dondolo_record_suite, only : suite_type
   use dondolo_wall, only : wall_type
   implicit none
   private

   public :: records_type, walls_type, held_study_type
   public :: hold, release, content_of, refuse_handle, find_records, find_suite, find_walls, find_study, find_store

   !> Records, with what their catalogue says of them
   type :: records_type
      !> The records
      type(suite_type) :: suite
      !> Which of them run at which levels; without levels: all at all
      type(record_rows_type) :: rows
      !> How their catalogue was read: notes; not allocated: there is no catalogue
      character(len=:), allocatable :: note
   end type records_type

   !> Walls, one or many
   type :: walls_type
      !> The walls
      type(wall_type), allocatable :: wall(:)
   end type walls_type

   !> A study and the handle of its suite, which must not be freed before it
   type :: held_study_type
      !> The study
      type(study_type) :: study
      !> Motions of the floors that its walls stand on
      type(floors_type) :: floors
      !> Handle of its suite
      integer(c_int64_t) :: suite = 0
   end type held_study_type

   !> The object of a handle that is not valid
   type :: nothing_type
   end type nothing_type

   !> Where something is kept
   type :: slot_type
      !> Handle of what it holds; 0: nothing
      integer(c_int64_t) :: handle = 0
      !> How often it was used
      integer(c_int64_t) :: uses = 0
      !> What it holds
      class(*), pointer :: content => null()
   end type slot_type

   !> Slots that were allocated together
   type :: chunk_type
      !> Twice as many as in the chunk before
      type(slot_type), pointer :: slot(:) => null()
   end type chunk_type

   !> Slots of the first chunk, and chunks: room for 2^30 handles
   integer, parameter :: first_slots = 64, chunks = 24

   !> Bits of a handle that number its slot
   integer, parameter :: slot_bits = 32

   type(chunk_type), target :: chunk(chunks)
   type(nothing_type), target :: nothing

   !> Slots that are free, those used last at the end, and how many there are
   integer, allocatable :: free_slots(:)
   integer :: free_count = 0, slot_count = 0

contains

   !> Keep something
   subroutine hold(content, handle)
      !> It belongs to its slot from now on
      class(*), pointer, intent(in) :: content
      !> Its handle
      integer(c_int64_t), intent(out) :: handle

      type(slot_type), pointer :: slot
      integer :: number

      !$omp critical (slots)
      if (free_count == 0) call add_chunk()
      number = free_slots(free_count)
      free_count = free_count - 1
      slot => slot_of(number)
      slot%uses = slot%uses + 1
      slot%content => content
      handle = ior(shiftl(slot%uses, slot_bits), int(number, c_int64_t))
      !$omp atomic write seq_cst
      slot%handle = handle
      !$omp end atomic
      !$omp end critical (slots)
   end subroutine hold

   !> Free the object of a handle; nothing, if it is not valid
   subroutine release(handle)
      !> The handle
      integer(c_int64_t), intent(in) :: handle

      type(slot_type), pointer :: slot
      class(*), pointer :: content

      nullify (content)
      !$omp critical (slots)
      slot => slot_of(number_of(handle))
      if (associated(slot) .and. handle /= 0) then
         if (slot%handle == handle) then
            !$omp atomic write seq_cst
            slot%handle = 0
            !$omp end atomic
            content => slot%content
            nullify (slot%content)
            free_count = free_count + 1
            free_slots(free_count) = number_of(handle)
         end if
      end if
      !$omp end critical (slots)
      if (associated(content)) deallocate (content)
   end subroutine release

   !> Make as many slots as there are, and have them all free
   subroutine add_chunk()

      integer :: k, i, more

      k = 1
      do while (associated(chunk(k)%slot))
         k = k + 1
      end do
      more = first_slots*2**(k - 1)
      allocate (chunk(k)%slot(more))
      slot_count = slot_count + more
      if (allocated(free_slots)) deallocate (free_slots)
      allocate (free_slots(slot_count))
      free_count = more
      free_slots(:more) = [(slot_count - i, i=0, more - 1)]
   end subroutine add_chunk

   !> Number of the slot of a handle
   pure integer function number_of(handle)
      !> The handle
      integer(c_int64_t), intent(in) :: handle

      number_of = int(ibits(handle, 0, slot_bits - 1))
   end function number_of

   !> The slot of a number
   function slot_of(number) result(slot)
      !> Number, from 1
      integer, intent(in) :: number
      !> Slot; null: there is none
      type(slot_type), pointer :: slot

      integer :: k, left

      slot => null()
      left = number
      if (left < 1) return
      do k = 1, chunks
         if (.not. associated(chunk(k)%slot)) return
         if (left <= size(chunk(k)%slot)) exit
         left = left - size(chunk(k)%slot)
      end do
      if (k <= chunks) slot => chunk(k)%slot(left)
   end function slot_of

   !> The object of a handle
   function content_of(handle) result(content)
      !> The handle
      integer(c_int64_t), intent(in) :: handle
      !> It; `nothing` where the handle is not valid
      class(*), pointer :: content

      type(slot_type), pointer :: slot
      integer(c_int64_t) :: held

      content => nothing
      slot => slot_of(number_of(handle))
      if (.not. associated(slot)) return
      !$omp atomic read seq_cst
      held = slot%handle
      !$omp end atomic
      if (held == handle .and. handle /= 0) content => slot%content
   end function content_of

   !> The records of a handle
   subroutine find_records(handle, records, error)
      !> The handle
      integer(c_int64_t), intent(in) :: handle
      !> The records
      type(records_type), pointer, intent(out) :: records
      !> The handle is that of no records, or was freed
      type(error_type), allocatable, intent(out) :: error

      class(*), pointer :: content

      records => null()
      content => content_of(handle)
      select type (content)
      type is (records_type)
         records => content
      class default
         call refuse_handle('records', handle, error)
      end select
   end subroutine find_records

   !> The suite of a handle
   subroutine find_suite(handle, suite, error)
      !> The handle
      integer(c_int64_t), intent(in) :: handle
      !> The suite
      type(suite_type), pointer, intent(out) :: suite
      !> The handle is that of no suite, or was freed
      type(error_type), allocatable, intent(out) :: error

      type(records_type), pointer :: records

      suite => null()
      call find_records(handle, records, error)
      if (.not. allocated(error)) suite => records%suite
   end subroutine find_suite

   !> The walls of a handle
   subroutine find_walls(handle, walls, error)
      !> The handle
      integer(c_int64_t), intent(in) :: handle
      !> The walls
      type(wall_type), pointer, intent(out) :: walls(:)
      !> The handle is that of no walls, or was freed
      type(error_type), allocatable, intent(out) :: error

      class(*), pointer :: content

      walls => null()
      content => content_of(handle)
      select type (content)
      type is (walls_type)
         walls => content%wall
      class default
         call refuse_handle('walls', handle, error)
      end select
   end subroutine find_walls

   !> The study of a handle
   subroutine find_study(handle, study, error)
      !> The handle
      integer(c_int64_t), intent(in) :: handle
      !> The study
      type(study_type), pointer, intent(out) :: study
      !> The handle is that of no study; it or its suite was freed
      type(error_type), allocatable, intent(out) :: error

      class(*), pointer :: content
      type(suite_type), pointer :: suite

      study => null()
      content => content_of(handle)
      select type (content)
      type is (held_study_type)
         call find_suite(content%suite, suite, error)
         if (.not. allocated(error)) study => content%study
      class default
         call refuse_handle('study', handle, error)
      end select
   end subroutine find_study

   !> The store of a handle
   subroutine find_store(handle, store, error)
      !> The handle
      integer(c_int64_t), intent(in) :: handle
      !> The store
      type(store_type), pointer, intent(out) :: store
      !> The handle is that of no store, or was freed
      type(error_type), allocatable, intent(out) :: error

      class(*), pointer :: content

      store => null()
      content => content_of(handle)
      select type (content)
      type is (store_type)
         store => content
      class default
         call refuse_handle('store', handle, error)
      end select
   end subroutine find_store

   !> Refuse a handle
   subroutine refuse_handle(name, handle, error)
      !> What it should be a handle of
      character(len=*), intent(in) :: name
      !> The handle
      integer(c_int64_t), intent(in) :: handle
      !> It is not
      type(error_type), allocatable, intent(out) :: error

      if (handle == 0) then
         call raise_input(error, name//': handle is not valid: it is NULL')
      else
         call raise_input(error, name//': handle is not valid: it belongs to something else, or was freed')
      end if
   end subroutine refuse_handle

end module dondolo_interface_handles
