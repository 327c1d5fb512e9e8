!> Peaks of strips whose joints bend before they open: joints FOLDER.
!>
!> FOLDER contains walls.bin (of each strip height, thickness, density, hinge, load, lifted part, eccentricity, speed ratio, period,
!> damping ratio, gravity), ground.bin (the accelerations of all records one after the other, m/s2) and histories.bin (of each
!> history the strip, from 1, first sample, from 1, and number of samples, step, factor, time after it, limit over the
!> capacity), all of doubles. Writes joints.bin: of each strip capacity, opening, e_0, L_y/J_y and k; and peaks.bin: of each history
!> peak, time, collapse, openings and passages.
program joints
   use, intrinsic :: iso_fortran_env, only : int64
   use bent_strip, only : new_strip, rk, strip_type
   use extrapolation, only : follow, outcome_type
   implicit none

   character(len=:), allocatable :: folder
   type(strip_type), allocatable :: strips(:)
   real(rk), allocatable :: walls(:, :), ground(:, :), histories(:, :), numbers(:, :)
   type(outcome_type) :: outcome
   integer :: length, k, unit

   call get_command_argument(1, length=length)
   allocate (character(len=length) :: folder)
   call get_command_argument(1, folder)
   call read_numbers('walls.bin', 11, walls)
   call read_numbers('ground.bin', 1, ground)
   call read_numbers('histories.bin', 7, histories)
   allocate (strips(size(walls, 2)))
   do k = 1, size(strips)
      associate (n => walls(:, k))
         strips(k) = new_strip(n(1), n(2), n(3), n(4), n(5), n(6), n(7), n(8), n(9), n(10), n(11))
      end associate
   end do
   open (newunit=unit, file=folder//'/joints.bin', access='stream', form='unformatted', action='write', status='replace')
   do k = 1, size(strips)
      associate (one => strips(k))
         write (unit) one%capacity, one%opening, one%ratio, one%lever/one%inertia, one%inertia*one%w**2
      end associate
   end do
   close (unit)
   allocate (numbers(5, size(histories, 2)))
   !$omp parallel do schedule(dynamic) private(outcome)
   do k = 1, size(histories, 2)
      associate (n => histories(:, k), strip => strips(nint(histories(1, k))), first => nint(histories(2, k)))
         call follow(strip, n(5)*ground(1, first:first + nint(n(3)) - 1), n(4), n(6), n(7)*strip%capacity, outcome)
         numbers(:, k) = [outcome%peak, outcome%time, merge(1.0_rk, 0.0_rk, outcome%collapsed), real(outcome%openings, rk), &
            & real(outcome%passages, rk)]
      end associate
   end do
   !$omp end parallel do
   open (newunit=unit, file=folder//'/peaks.bin', access='stream', form='unformatted', action='write', status='replace')
   write (unit) numbers
   close (unit)

contains

   !> All numbers of a file, so many in a column
   subroutine read_numbers(name, rows, numbers)
      character(len=*), intent(in) :: name
      integer, intent(in) :: rows
      real(rk), allocatable, intent(out) :: numbers(:, :)

      integer(int64) :: bytes
      integer :: unit

      open (newunit=unit, file=folder//'/'//name, access='stream', form='unformatted', action='read', status='old')
      inquire (unit=unit, size=bytes)
      allocate (numbers(rows, int(bytes/(8_int64*rows))))
      read (unit) numbers
      close (unit)
   end subroutine read_numbers

end program joints
