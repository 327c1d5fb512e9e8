!> Room for what grows with the input, tried before the work begins.
!>
!> Fortran ends the program where a temporary array, an assignment or a text finds no memory. So a work first asks
!> whether it can have as much as all of these will take, and gives it back at once. That takes longer than to plan a small
!> work. So small ones share what one trial has shown, unless the process has a limit that it may run into.
module dondolo_base_memory
   use, intrinsic :: iso_c_binding, only : c_int
   use, intrinsic :: iso_fortran_env, only : int8, int64
   use, intrinsic :: omp_lib, only : omp_get_max_threads
   use dondolo_base_error, only : error_type, raise_failure, status_memory
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   implicit none
   private

   public :: check_room, keep_freed, raise_shortage

   !> What all else may take: small things, and the stack of each thread [bytes]
   integer(int64), parameter :: small_things = 2_int64**26, stack = 2_int64**24

   !> What works may take together before room is tried again, a part of the small things [bytes]
   integer(int64), parameter :: shared = small_things/8

   !> What of it is left
   integer(int64) :: left = 0

   interface

      !> 1: the process may be refused memory; see process.c
      integer(c_int) function c_is_limited() bind(c, name='dondolo_is_limited')
         import :: c_int
      end function c_is_limited

      !> Let the process keep some memory that it gives back; see standard.c
      subroutine keep_freed() bind(c, name='dondolo_keep_freed')
      end subroutine keep_freed

   end interface

contains

   !> Check that there is room for some work
   subroutine check_room(bytes, error)
      !> What its arrays and texts take at once, all temporary ones included [bytes]
      real(wp), intent(in) :: bytes
      !> There is less
      type(error_type), allocatable, intent(out) :: error

      ! A volatile array is not optimised away, though nothing is ever put in it.
      integer(int8), allocatable, volatile :: room(:)
      real(wp) :: needed
      integer(int64) :: still
      integer :: stat

      if (bytes < real(shared, wp) .and. c_is_limited() == 0) then
         !$omp atomic capture
         left = left - int(bytes, int64)
         still = left
         !$omp end atomic
         if (still > 0) return
      end if
      needed = bytes + real(small_things + omp_get_max_threads()*stack, wp)
      stat = 1
      if (needed < real(huge(1_int64)/2, wp)) allocate (room(int(needed, int64)), stat=stat)
      still = 0
      if (stat == 0) still = shared
      !$omp atomic write
      left = still
      if (stat /= 0) call raise_shortage(needed, error)
   end subroutine check_room

   !> Report lack of memory
   pure subroutine raise_shortage(bytes, error)
      !> What is needed [bytes]
      real(wp), intent(in) :: bytes
      !> Error to allocate
      type(error_type), allocatable, intent(out) :: error

      call raise_failure(error, 'not enough memory: needs '//to_text(anint(bytes/1.0e6_wp))//' MB')
      error%stat = status_memory
   end subroutine raise_shortage

end module dondolo_base_memory
