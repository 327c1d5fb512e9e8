!> Signals while histories run: long loops check now and then whether they should end early.
!>
!> Only a thread that listens, and the threads that work for it, see a signal. What it returns then are not results: the
!> listener must check too, and discard them. Python's main thread listens to Ctrl-C during a call, the executable to signals
!> that end it from its first history on; a program that does not listen is ended by the signal.
module dondolo_base_interrupt
   use, intrinsic :: iso_c_binding, only : c_int
   use dondolo_base_error, only : error_type, raise_failure
   implicit none
   private

   public :: listen, end_listening, end_in_order, die_of_signal, watched, watch, look_for_interrupt, check_interrupt

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

      !> What this thread listens for
      integer(c_int) function watched() bind(c, name='dondolo_watched')
         import :: c_int
      end function watched

      !> Listen for what another thread listens for: OpenMP's threads, for the one that they work for
      subroutine watch(since) bind(c, name='dondolo_watch')
         import :: c_int
         !> As from watched in that thread
         integer(c_int), value :: since
      end subroutine watch

      !> Look whether a signal has come
      pure subroutine look_for_interrupt(noted) bind(c, name='dondolo_look_for_interrupt')
         import :: c_int
         !> 1: it has, since this thread began to listen
         integer(c_int), intent(out) :: noted
      end subroutine look_for_interrupt

   end interface

contains

   !> Report a signal that has come
   subroutine check_interrupt(error)
      !> It has: what was computed since listening began is not whole
      type(error_type), allocatable, intent(out) :: error

      integer(c_int) :: interrupted

      call look_for_interrupt(interrupted)
      if (interrupted == 1) call raise_failure(error, 'interrupted')
   end subroutine check_interrupt

end module dondolo_base_interrupt
