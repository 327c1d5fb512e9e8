!> Motions of two supports: a mode of a building, with a diaphragm in series, under an acceleration that is linear between
!> samples. Within each sample interval they are power series in z = time since the sample over the interval.
module support_motion
   use, intrinsic :: iso_fortran_env, only : real64
   implicit none
   private

   public :: rk, base, delta, speed, rise
   public :: house_type, motion_type, new_motion, given_motion

   integer, parameter :: rk = real64

   !> Channels: acceleration of the base; displacement of the top relative to the base, and its two derivatives
   integer, parameter :: base = 1, delta = 2, speed = 3, rise = 4

   real(rk), parameter :: pi = acos(-1.0_rk)

   !> Terms of the series that are left out, as a part of the first
   real(rk), parameter :: truncation = 1.0e-12_rk

   !> Participations at base and top of one mode, and of a diaphragm in series with the top; periods in s, 0 for none
   type :: house_type
      real(rk) :: period = 0.0_rk
      real(rk) :: base = 0.0_rk
      real(rk) :: top = 0.0_rk
      real(rk) :: damping = 0.0_rk
      real(rk) :: diaphragm = 0.0_rk
      real(rk) :: diaphragm_damping = 0.0_rk
      real(rk) :: share = 0.0_rk
   end type house_type

   type :: motion_type
      !> Sample interval, s
      real(rk) :: h = 0.0_rk
      integer :: intervals = 0
      !> Series of the channels: (channel, term, interval)
      real(rk), allocatable :: series(:, :, :)
      !> More, m/s2, than a wall feels in each interval, and from its beginning on
      real(rk), allocatable :: strength(:)
      real(rk), allocatable :: to_come(:)
   contains
      procedure :: at
   end type motion_type

contains

   !> Supports in a building above ground accelerations in m/s2, with `after` s of free vibration
   function new_motion(house, ground, h, after) result(motion)
      type(house_type), intent(in) :: house
      real(rk), intent(in) :: ground(:), h, after
      type(motion_type) :: motion
      real(rk), allocatable :: mode(:), floor(:), drift(:)
      real(rk) :: u(0:1), own, of_floor, f
      integer :: last, i, n, terms

      own = 2.0_rk*pi/house%period*h
      of_floor = 0.0_rk
      if (house%diaphragm > 0.0_rk) of_floor = 2.0_rk*pi/house%diaphragm*h
      terms = terms_for(max(own, of_floor))
      last = size(ground) - 1
      call make(motion, h, last + nint(after/h), terms)
      allocate (mode(0:terms + 2), source=0.0_rk)
      allocate (floor(0:terms + 2), source=0.0_rk)
      do i = 1, motion%intervals
         u = 0.0_rk
         if (i <= last) u = [ground(i), ground(i + 1) - ground(i)]
         call extend(mode, own, house%damping, h**2*u)
         drift = (house%top - house%base)*mode
         if (house%diaphragm > 0.0_rk) then
            ! The floor that carries it moves by the whole series of the mode
            do n = 0, terms
               f = house%top*derivative(mode, n)
               if (n <= 1) f = f + h**2*u(n)
               floor(n + 2) = -(f + of_floor**2*floor(n) + 2.0_rk*house%diaphragm_damping*of_floor*real(n + 1, rk) &
                  & *floor(n + 1))/real((n + 1)*(n + 2), rk)
            end do
            drift = drift + house%share*floor
            call onwards(floor)
         end if
         call put(motion, i, drift)
         do n = 0, terms
            motion%series(base, n, i) = house%base*derivative(mode, n)/h**2
         end do
         motion%series(base, :1, i) = motion%series(base, :1, i) + u
         call onwards(mode)
      end do
      call measure(motion)
   end function new_motion

   !> Supports whose own accelerations are linear between samples, from rest
   function given_motion(of_base, of_top, h) result(motion)
      real(rk), intent(in) :: of_base(:), of_top(:), h
      type(motion_type) :: motion
      real(rk) :: d(0:5), a(2)
      integer :: i

      call make(motion, h, size(of_base) - 1, 3)
      d = 0.0_rk
      do i = 1, motion%intervals
         a = of_top(i:i + 1) - of_base(i:i + 1)
         d(2:3) = h**2*[a(1)/2.0_rk, (a(2) - a(1))/6.0_rk]
         call put(motion, i, d)
         motion%series(base, :, i) = 0.0_rk
         motion%series(base, :1, i) = [of_base(i), of_base(i + 1) - of_base(i)]
         call onwards(d)
      end do
      call measure(motion)
   end function given_motion

   !> Channels in interval i at z
   pure function at(motion, i, z) result(x)
      class(motion_type), intent(in) :: motion
      integer, intent(in) :: i
      real(rk), intent(in) :: z
      real(rk) :: x(4)
      integer :: n

      x = motion%series(:, ubound(motion%series, 2), i)
      do n = ubound(motion%series, 2) - 1, 0, -1
         x = x*z + motion%series(:, n, i)
      end do
   end function at

   !> Terms that a series needs, for an angular frequency times the interval
   pure integer function terms_for(angle)
      real(rk), intent(in) :: angle
      real(rk) :: term

      terms_for = 3
      term = angle**2/2.0_rk
      do while (term > truncation)
         term = term*angle/real(terms_for, rk)
         terms_for = terms_for + 1
      end do
   end function terms_for

   pure subroutine make(motion, h, intervals, terms)
      type(motion_type), intent(out) :: motion
      real(rk), intent(in) :: h
      integer, intent(in) :: intervals, terms

      motion%h = h
      motion%intervals = intervals
      allocate (motion%series(4, 0:terms, intervals))
   end subroutine make

   !> Relative displacement of an interval, with two terms more than the series keep, and its derivatives
   pure subroutine put(motion, i, d)
      type(motion_type), intent(inout) :: motion
      integer, intent(in) :: i
      real(rk), intent(in) :: d(0:)
      integer :: n

      do n = 0, ubound(motion%series, 2)
         motion%series(delta, n, i) = d(n)
         motion%series(speed, n, i) = real(n + 1, rk)*d(n + 1)/motion%h
         motion%series(rise, n, i) = derivative(d, n)/motion%h**2
      end do
   end subroutine put

   !> Series of d'' + 2 damping own d' + own**2 d = -push from its first two terms, all in z
   pure subroutine extend(d, own, damping, push)
      real(rk), intent(inout) :: d(0:)
      real(rk), intent(in) :: own, damping, push(0:1)
      real(rk) :: f
      integer :: n

      do n = 0, ubound(d, 1) - 2
         f = 0.0_rk
         if (n <= 1) f = push(n)
         d(n + 2) = -(f + own**2*d(n) + 2.0_rk*damping*own*real(n + 1, rk)*d(n + 1))/real((n + 1)*(n + 2), rk)
      end do
   end subroutine extend

   !> Term n of a series' second derivative
   pure real(rk) function derivative(d, n)
      real(rk), intent(in) :: d(0:)
      integer, intent(in) :: n

      derivative = real((n + 1)*(n + 2), rk)*d(n + 2)
   end function derivative

   !> The first two terms at the end of an interval
   pure subroutine onwards(d)
      real(rk), intent(inout) :: d(0:)
      real(rk) :: there(0:1)
      integer :: n

      there = 0.0_rk
      do n = ubound(d, 1), 0, -1
         there = [there(0) + d(n), there(1) + real(n, rk)*d(n)]
      end do
      d(:1) = there
   end subroutine onwards

   pure subroutine measure(motion)
      type(motion_type), intent(inout) :: motion
      integer :: i

      allocate (motion%strength(motion%intervals), motion%to_come(motion%intervals))
      do i = motion%intervals, 1, -1
         motion%strength(i) = max(strength(motion%at(i, 0.0_rk)), strength(motion%at(i, 1.0_rk)))
         motion%to_come(i) = motion%strength(i)
         if (i < motion%intervals) motion%to_come(i) = max(motion%to_come(i), motion%to_come(i + 1))
      end do
   end subroutine measure

   pure real(rk) function strength(x)
      real(rk), intent(in) :: x(4)

      strength = abs(x(base)) + 1.5_rk*abs(x(rise)) + 5.0_rk*abs(x(delta))
   end function strength

end module support_motion
