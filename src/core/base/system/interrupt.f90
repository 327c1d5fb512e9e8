!> Signals while histories run: long loops check now and then whether they should end early.
!>
!> Only a thread that listens, and the threads that work for it, see a signal. What it returns then are not results: the
!> listener must check too, and discard them. Python's main thread listens to Ctrl-C during a call, the executable to signals
!> that end it from its first history on; a program that does not listen is ended by the signal. A flag that another thread sets
!> ends the work of a thread in the same way.
module dondolo_base_interrupt
   use, intrinsic :: iso_c_binding, only : c_int, c_null_ptr, c_ptr
   use dondolo_base_error, only : error_type, raise_failure
   implicit none
   private

   public :: watched_type, listen, end_listening, end_in_order, die_of_signal, stop_at, get_watched, watch, look_for_interrupt, &
      & check_interrupt

   !> What a thread listens for: struct dondolo_watched of interrupt.h
   type, bind(c) :: watched_type
      integer(c_int) :: since = -1
      type(c_ptr) :: flag = c_null_ptr
   end type watched_type

   interface

      !> Begin to listen to SIGINT; the handler that was there before gets it too. One thread at a time listens
      subroutine listen() bind(c, name='dondolo_listen')
      end subroutine listen

      !> Listen no more
      subroutine end_listening() bind(c, name='dondolo_end_listening')
      end subroutine end_listening

      !> Listen to SIGINT, SIGTERM and SIGHUP until the program ends; a second one kills it
      subroutine end_in_order() bind(c, name='dondolo_end_in_order')
      end subroutine end_in_order

      !> Die of the signal that has come; nothing happens if none has
      subroutine die_of_signal() bind(c, name='dondolo_die_of_signal')
      end subroutine die_of_signal

      !> End the work of this thread once an integer(c_int) is not 0; no more with the null pointer
      subroutine stop_at(flag) bind(c, name='dondolo_stop_at')
         import :: c_ptr
         !> Its address; another thread writes it
         type(c_ptr), value :: flag
      end subroutine stop_at

      !> What this thread listens for
      subroutine get_watched(own) bind(c, name='dondolo_get_watched')
         import :: watched_type
         type(watched_type), intent(out) :: own
      end subroutine get_watched

      !> Listen for what another thread listens for: OpenMP's threads, for the one that they work for
      subroutine watch(other) bind(c, name='dondolo_watch')
         import :: watched_type
         !> As from get_watched in that thread
         type(watched_type), intent(in) :: other
      end subroutine watch

      !> Look whether the work should end
      pure subroutine look_for_interrupt(noted) bind(c, name='dondolo_look_for_interrupt')
         import :: c_int
         !> 1: a signal has come since this thread began to listen, or its flag is set
         integer(c_int), intent(out) :: noted
      end subroutine look_for_interrupt

   end interface

contains

   !> Report that the work should end
   subroutine check_interrupt(error)
      !> It should: what was computed since listening began is not whole
      type(error_type), allocatable, intent(out) :: error

      integer(c_int) :: interrupted

      call look_for_interrupt(interrupted)
      if (interrupted == 1) call raise_failure(error, 'interrupted')
   end subroutine check_interrupt

end module dondolo_base_interrupt
