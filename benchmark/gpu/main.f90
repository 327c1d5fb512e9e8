!> Histories of many walls on a graphics processor beside all threads of the processor: the same results, and the time of both.
!>
!> dondolo-gpu [WALLS]: the number of walls of each mechanism, 40 if absent. Status 1: the results differ.
program dondolo_gpu
   use, intrinsic :: iso_fortran_env, only : error_unit, int64, output_unit
   use, intrinsic :: omp_lib, only : omp_get_max_threads
   use, intrinsic :: openacc, only : acc_device_host, acc_get_device_type
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_gpu_walls, only : gpu_study_type
   use dondolo_motion_response, only : response_type
   use dondolo_wall, only : masonry_names
   implicit none

   !> Rounds, in which both have their turn; the median counts
   integer, parameter :: rounds = 7

   !> What may differ, since rocking amplifies rounding: flags, and EDPs by more than this, of each so many histories
   real(wp), parameter :: same = 1.0e-6_wp, flags_allowed = 1.0e-5_wp, edps_allowed = 3.0_wp/880.0_wp

   type(error_type), allocatable :: error
   character(len=16) :: word
   logical :: agrees
   integer :: walls, i, length, status

   walls = 40
   call get_command_argument(1, word, length=length, status=status)
   if (length > 0) then
      read (word, *, iostat=status) walls
      if (status /= 0 .or. walls < 1) then
         write (error_unit, '(a)') 'dondolo-gpu: '''//trim(word)//''': must be a number of walls, 1 at least'
         stop 2, quiet=.true.
      end if
   end if
   agrees = .true.
   write (output_unit, '(a)') 'threads of the processor: '//to_text(omp_get_max_threads())
   if (acc_get_device_type() == acc_device_host) write (output_unit, '(a)') &
      & 'There is no graphics processor here: what follows is one thread of the processor in its place.'
   write (output_unit, '(a)') '', &
      & 'mechanism       walls  histories  processor [s]  graphics [s]  of it launch [s]         ratio (least to largest)'// &
      & '  other flags  EDPs beyond 1e-6  largest'
   do i = 1, size(masonry_names)
      call compare(trim(masonry_names(i)), error)
      if (.not. allocated(error)) cycle
      write (error_unit, '(a)') 'dondolo-gpu: '//error%message
      stop 1, quiet=.true.
   end do
   if (agrees) stop 0, quiet=.true.
   write (error_unit, '(a)') 'dondolo-gpu: the results differ by more than rounding'
   stop 1, quiet=.true.

contains

   !> Both, for the walls of one mechanism
   subroutine compare(mechanism, error)
      character(len=*), intent(in) :: mechanism
      !> It could not be run
      type(error_type), allocatable, intent(out) :: error

      type(gpu_study_type) :: study
      type(response_type), allocatable :: expected(:, :), found(:, :)
      real(wp), dimension(rounds) :: processor, launched, graphics
      character(len=160) :: line
      integer(int64) :: start
      integer :: round, flags, edps

      call study%make(mechanism, walls, error)
      if (allocated(error)) return
      if (size(study%wall) == 0) then
         write (output_unit, '(a14, a)') mechanism, '      0  no wall has a normal form that a kernel is there for'
         return
      end if
      allocate (expected(size(study%record), size(study%wall)), found(size(study%record), size(study%wall)))
      ! The first launch loads the program and makes machine code of it.
      call study%launch()
      do round = 1, rounds
         call system_clock(start)
         call study%run_on_processor(expected)
         processor(round) = seconds_since(start)
         call system_clock(start)
         call study%launch()
         launched(round) = seconds_since(start)
         call study%finish(found)
         graphics(round) = seconds_since(start)
      end do
      flags = count(found%collapsed .neqv. expected%collapsed)
      edps = count(abs(found%edp - expected%edp) > same)
      write (line, '(a14, i7, i11, f15.4, f14.4, f18.4, f14.2, a, f6.2, a, f6.2, a, i13, i18, es9.1)') mechanism, &
         & size(study%wall), size(found), median(processor), median(graphics), median(launched), median(processor/graphics), &
         & ' (', minval(processor/graphics), ' to', maxval(processor/graphics), ')', flags, edps, &
         & maxval(abs(found%edp - expected%edp))
      write (output_unit, '(a)') trim(line)
      flush (output_unit)
      agrees = agrees .and. real(flags, wp) <= 1.0_wp + flags_allowed*real(size(found), wp) &
         & .and. real(edps, wp) <= edps_allowed*real(size(found), wp)
   end subroutine compare

   !> Time since a count of the clock [s]
   real(wp) function seconds_since(start)
      integer(int64), intent(in) :: start

      integer(int64) :: now, per_second

      call system_clock(now, per_second)
      seconds_since = real(now - start, wp)/real(per_second, wp)
   end function seconds_since

   !> The middle one of the rounds
   pure real(wp) function median(values)
      real(wp), intent(in) :: values(rounds)

      integer :: i

      median = values(1)
      do i = 1, rounds
         if (count(values < values(i)) <= rounds/2 .and. count(values <= values(i)) > rounds/2) median = values(i)
      end do
   end function median

end program dondolo_gpu
