!> How many threads share some work.
module dondolo_base_threads
   use, intrinsic :: omp_lib, only : omp_get_max_threads, omp_get_num_threads
   use dondolo_base_error, only : error_type, raise_input
   use dondolo_base_text, only : to_text
   implicit none
   private

   public :: largest_threads, available_threads, given_threads, team_of, check_threads

   !> Most threads that are asked for
   integer, parameter :: largest_threads = 1024

contains

   !> Threads that share some work
   integer function team_of(threads, pieces)
      !> Number of threads that are asked for; 0: all that OpenMP gives
      integer, intent(in) :: threads
      !> Pieces of work
      integer, intent(in) :: pieces

      team_of = threads
      if (threads == 0) team_of = available_threads()
      team_of = max(1, min(team_of, pieces))
   end function team_of

   !> Threads that OpenMP gives, which honours OMP_NUM_THREADS and the processors of the process
   integer function available_threads()

      available_threads = min(omp_get_max_threads(), largest_threads)
   end function available_threads

   !> Threads that OpenMP gives where so many are asked for: fewer if OMP_THREAD_LIMIT or OMP_DYNAMIC says so
   integer function given_threads(threads)
      !> Number of threads that are asked for, at least 1
      integer, intent(in) :: threads

      given_threads = 1
      !$omp parallel num_threads(threads) default(none) shared(given_threads)
      !$omp single
      given_threads = omp_get_num_threads()
      !$omp end single
      !$omp end parallel
   end function given_threads

   !> Check a number of threads
   subroutine check_threads(threads, error)
      !> Number
      integer, intent(in) :: threads
      !> It is negative, or too large to be meant
      type(error_type), allocatable, intent(out) :: error

      if (threads < 0 .or. threads > largest_threads) call raise_input(error, 'threads = '//to_text(threads)// &
         & ': must lie between 0 (all) and '//to_text(largest_threads))
   end subroutine check_threads

end module dondolo_base_threads
