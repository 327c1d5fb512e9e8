!> A queue of histories that several threads take from.
module dondolo_queue
   use, intrinsic :: iso_c_binding, only : c_int
   use, intrinsic :: omp_lib, only : omp_get_thread_num
   use dondolo_interrupt, only : look_for_interrupt
   implicit none
   private

   public :: queue_type, progress_interface

   abstract interface
      !> Hears how far the work is; called by one thread only
      subroutine progress_interface(done, total)
         !> Histories computed
         integer, intent(in) :: done
         !> Histories in all
         integer, intent(in) :: total
      end subroutine progress_interface
   end interface

   !> Numbers from a last one down to a first
   type :: queue_type
      !> The next number; less than the first: no more are left
      integer :: last = 0
      !> The first number
      integer :: first = 1
      !> Histories that are done, and all that make up the work, which may be more than those in the queue
      integer :: done = 0, total = 0
   contains
      !> Take a number
      procedure :: next
      !> One more is done
      procedure :: report
   end type queue_type

contains

   !> Take a number; 0 if none is left, or after Ctrl-C
   integer function next(self)
      !> The queue
      class(queue_type), intent(inout) :: self

      integer(c_int) :: interrupted

      !$omp atomic capture
      next = self%last
      self%last = self%last - 1
      !$omp end atomic
      call look_for_interrupt(interrupted)
      if (next < self%first .or. interrupted == 1) next = 0
   end function next

   !> One more is done
   subroutine report(self, progress)
      !> The queue
      class(queue_type), intent(inout) :: self
      !> Hears of it
      procedure(progress_interface), optional :: progress

      integer :: now

      !$omp atomic capture
      self%done = self%done + 1
      now = self%done
      !$omp end atomic
      if (present(progress)) then
         if (omp_get_thread_num() == 0) call progress(now, self%total)
      end if
   end subroutine report

end module dondolo_queue
