!> A queue of histories of one wall that several threads take from.
module dondolo_motion_queue
   use, intrinsic :: iso_c_binding, only : c_int
   use, intrinsic :: omp_lib, only : omp_get_thread_num
   use dondolo_base_interrupt, only : look_for_interrupt
   use dondolo_base_kinds, only : wp
   use dondolo_motion_response, only : response_type
   implicit none
   private

   public :: queue_type, progress_interface

   abstract interface
      !> Progress callback; called by one thread only
      subroutine progress_interface(done, total)
         !> Histories computed
         integer, intent(in) :: done
         !> Histories in all
         integer, intent(in) :: total
      end subroutine progress_interface
   end interface

   !> Histories
   type :: queue_type
      !> Record of each history, and the factor on it, negative to reverse its polarity
      integer, allocatable :: record(:)
      real(wp), allocatable :: scale(:)
      !> Result of each history
      type(response_type), allocatable :: response(:)
      !> Their numbers, in the order from the last of which they are taken
      integer, allocatable, private :: order(:)
      !> Place of the next history in it; less than 1: none is left
      integer, private :: place = 0
      !> Histories done, and all that make up the work, which may be more than those in the queue
      integer, private :: done = 0, total = 0
      !> Progress callback, if there is one
      procedure(progress_interface), pointer, nopass, private :: progress => null()
   contains
      !> Announce the work to the progress callback
      procedure :: announce
      !> Put histories in
      procedure :: fill
      !> Take the number of a history
      procedure :: next
      !> One more is done
      procedure :: report
      !> All that were put in are done
      procedure :: report_all
   end type queue_type

contains

   !> Announce the work to the progress callback
   subroutine announce(self, total, progress)
      class(queue_type), intent(inout) :: self
      !> Histories in all
      integer, intent(in) :: total
      !> Progress callback
      procedure(progress_interface), optional :: progress

      self%total = total
      if (present(progress)) self%progress => progress
   end subroutine announce

   !> Put histories in
   subroutine fill(self, record, scale, by_duration)
      !> The queue; empty
      class(queue_type), intent(inout) :: self
      !> Record of each history
      integer, intent(in) :: record(:)
      !> Factor on it
      real(wp), intent(in) :: scale(:)
      !> All records, those last that take longest
      integer, intent(in) :: by_duration(:)

      integer :: place(size(by_duration)), i, before, number

      self%record = record
      self%scale = scale
      ! The results of those before may have been taken away.
      if (allocated(self%response)) deallocate(self%response)
      if (allocated(self%order)) deallocate(self%order)
      allocate(self%response(size(record)), self%order(size(record)))
      ! Those that take longest go first, so that no lane and no thread is left alone with them at the end: record by record,
      ! which keeps its samples in the caches, and high levels, which stand last, before low ones.
      place = 0
      do i = 1, size(record)
         place(record(i)) = place(record(i)) + 1
      end do
      before = 0
      do i = 1, size(by_duration)
         number = place(by_duration(i))
         place(by_duration(i)) = before
         before = before + number
      end do
      do i = 1, size(record)
         place(record(i)) = place(record(i)) + 1
         self%order(place(record(i))) = i
      end do
      self%place = size(record)
   end subroutine fill

   !> Take the number of a history; 0 if none is left, or after Ctrl-C
   integer function next(self)
      class(queue_type), intent(inout) :: self

      integer(c_int) :: interrupted
      integer :: place

      !$omp atomic capture
      place = self%place
      self%place = self%place - 1
      !$omp end atomic
      call look_for_interrupt(interrupted)
      next = 0
      if (place > 0 .and. interrupted == 0) next = self%order(place)
   end function next

   !> One more is done
   subroutine report(self)
      class(queue_type), intent(inout) :: self

      integer :: now

      !$omp atomic capture
      self%done = self%done + 1
      now = self%done
      !$omp end atomic
      if (associated(self%progress)) then
         if (omp_get_thread_num() == 0) call self%progress(now, self%total)
      end if
   end subroutine report

   !> All that were put in are done
   subroutine report_all(self)
      class(queue_type), intent(in) :: self

      if (associated(self%progress)) call self%progress(self%done, self%total)
   end subroutine report_all

end module dondolo_motion_queue
