!> Ctrl-C while histories run: what takes long looks now and then whether it is to end early.
!>
!> Only a program that listens is told, and what it gets then are no results: it must look too, and drop them. One that
!> does not listen, such as the executable, dies of the signal.
module dondolo_interrupt
   use, intrinsic :: iso_c_binding, only : c_int
   implicit none
   private

   public :: listen, end_listening, look_for_interrupt

   interface

      !> Begin to listen; the handler that was there before gets the signal too. One thread at a time listens
      subroutine listen() bind(c, name='dondolo_listen')
      end subroutine listen

      !> Listen no more
      subroutine end_listening() bind(c, name='dondolo_end_listening')
      end subroutine end_listening

      !> Look whether the signal has come
      pure subroutine look_for_interrupt(noted) bind(c, name='dondolo_look_for_interrupt')
         import :: c_int
         !> 1: it has, since listening began
         integer(c_int), intent(out) :: noted
      end subroutine look_for_interrupt

   end interface

end module dondolo_interrupt
