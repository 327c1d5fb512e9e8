!> The machine the benchmark runs on: its processor, and the arithmetic that this build can do on it.
module dondolo_machine
   use, intrinsic :: iso_fortran_env, only : int64
   use, intrinsic :: omp_lib, only : omp_get_max_threads, omp_get_num_procs
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: processor_name, surroundings, arithmetic_rate, seconds_since

   !> Values that each chain of multiplications and additions runs over, as many as the engine has lanes; its length;
   !> passes between two looks at the clock
   integer, parameter :: width = 64, length = 16, passes = 2000

contains

   !> Name of the processor, where the system tells it
   function processor_name() result(name)
      !> Name, or 'unknown'; filled up with blanks
      character(len=256) :: name

      character(len=256) :: line
      integer :: unit, stat

      ! Of Windows
      call get_environment_variable('PROCESSOR_IDENTIFIER', name)
      if (len_trim(name) == 0) name = 'unknown'
      open (newunit=unit, file='/proc/cpuinfo', action='read', status='old', iostat=stat)
      if (stat /= 0) return
      do
         read (unit, '(a)', iostat=stat) line
         if (stat /= 0) exit
         if (index(line, 'model name') /= 1) cycle
         name = adjustl(line(index(line, ':') + 1:))
         exit
      end do
      close (unit)
   end function processor_name

   !> What else the speed depends on: threads and how they are bound, memory nodes, what else the machine does
   function surroundings() result(text)
      !> One line, filled up with blanks
      character(len=256) :: text

      character(len=*), parameter :: bindings(2) = [character(len=13) :: 'OMP_PROC_BIND', 'OMP_PLACES']
      character(len=64) :: value
      integer :: i, length

      write (text, '(i0, a, i0, a)') omp_get_max_threads(), ' threads that OpenMP gives, on ', omp_get_num_procs(), &
         & ' processors'
      do i = 1, size(bindings)
         call get_environment_variable(trim(bindings(i)), value, length)
         if (length > 0) text = trim(text)//', '//trim(bindings(i))//'='//trim(value)
      end do
      call first_line('/sys/devices/system/node/online', value)
      if (len_trim(value) > 0) text = trim(text)//'; memory nodes '//trim(value)
      call first_line('/proc/loadavg', value)
      if (len_trim(value) > 0) text = trim(text)//'; load average '//value(:index(value, ' ') - 1)
   end function surroundings

   !> First line of a file of the system
   subroutine first_line(file, line)
      !> Path of the file
      character(len=*), intent(in) :: file
      !> The line; empty where there is no such file
      character(len=*), intent(out) :: line

      integer :: unit, stat

      line = ''
      open (newunit=unit, file=file, action='read', status='old', iostat=stat)
      if (stat /= 0) return
      read (unit, '(a)', iostat=stat) line
      if (stat /= 0) line = ''
      close (unit)
   end subroutine first_line

   !> Multiplications and additions a second on all threads together, in a loop that does nothing else
   real(wp) function arithmetic_rate(threads, seconds)
      !> Number of threads
      integer, intent(in) :: threads
      !> How long to measure [s]
      real(wp), intent(in) :: seconds

      real(wp) :: rate
      integer :: thread

      rate = 0.0_wp
      !$omp parallel do num_threads(threads) schedule(static, 1) reduction(+ : rate)
      do thread = 1, threads
         rate = rate + rate_of_one(seconds)
      end do
      !$omp end parallel do
      arithmetic_rate = rate
   end function arithmetic_rate

   !> Multiplications and additions a second on this thread
   real(wp) function rate_of_one(seconds)
      !> How long to measure [s]
      real(wp), intent(in) :: seconds

      ! The values tend to 0.5/(1 - 0.999) = 500, so that no number is too large or too small for full speed.
      real(wp), parameter :: factor = 0.999_wp, term = 0.5_wp
      real(wp) :: x(width, 8), a, b, c, d, e, f, g, h, spent
      integer(int64) :: start
      integer :: rounds, i, j, k

      x = 1.0_wp
      rounds = 0
      call system_clock(start)
      do
         do j = 1, passes
            ! Eight chains that do not wait for each other, each in a vector register
            !$omp simd
            do i = 1, width
               a = x(i, 1)
               b = x(i, 2)
               c = x(i, 3)
               d = x(i, 4)
               e = x(i, 5)
               f = x(i, 6)
               g = x(i, 7)
               h = x(i, 8)
               !GCC$ unroll 16
               do k = 1, length
                  a = a*factor + term
                  b = b*factor + term
                  c = c*factor + term
                  d = d*factor + term
                  e = e*factor + term
                  f = f*factor + term
                  g = g*factor + term
                  h = h*factor + term
               end do
               x(i, 1) = a
               x(i, 2) = b
               x(i, 3) = c
               x(i, 4) = d
               x(i, 5) = e
               x(i, 6) = f
               x(i, 7) = g
               x(i, 8) = h
            end do
         end do
         rounds = rounds + 1
         spent = seconds_since(start)
         if (spent >= seconds) exit
      end do
      rate_of_one = 2.0_wp*real(length, wp)*real(size(x), wp)*real(passes, wp)*real(rounds, wp)/spent
      ! Keep the compiler from removing the computation of values that are not used.
      if (.not. all(x > 0.0_wp)) rate_of_one = 0.0_wp
   end function rate_of_one

   !> Time since an instant [s]
   real(wp) function seconds_since(start)
      !> The instant, by system_clock
      integer(int64), intent(in) :: start

      integer(int64) :: now, rate

      call system_clock(now, rate)
      seconds_since = real(now - start, wp)/real(rate, wp)
   end function seconds_since

end module dondolo_machine
