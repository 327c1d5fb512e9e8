!> One step of the lanes: its series against the recurrence for polynomials, and what a step that is taken promises; and the move of
!> a lane.
program test_lane_kernel
   use, intrinsic :: iso_c_binding, only : c_f_pointer, c_loc
   use checks, only : check, finish, suite
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_motion_lane_kernel, only : step_lanes
   use dondolo_motion_lane_state, only : event_possible, lane_integer, lane_width, lanes_type, move_lane, step_too_long
   use dondolo_motion_normal_form, only : degrees, harmonic_degrees, new_normal_form, normal_form_type, y_limit
   use dondolo_record_random, only : new_random, random_type
   use dondolo_wall, only : wall_type
   use motion_inputs, only : a_wall, made
   use random_history, only : across, between, choice
   implicit none

   !> Samples that every lane reads
   real(wp), parameter :: samples(8) = [0.0_wp, 1.0_wp, -2.0_wp, 0.5_wp, 3.0_wp, -1.0_wp, 0.0_wp, 0.0_wp]

   type(random_type) :: random
   type(normal_form_type) :: forms(9)
   type(wall_type) :: wall
   integer :: i

   do i = 1, 4
      wall = a_wall(i)
      forms(i) = new_normal_form(wall%mechanism, wall%mechanism%capacity)
   end do
   wall = made('one_sided', 1.0_wp, 0.9_wp)
   forms(5) = new_normal_form(wall%mechanism, 1.5_wp*wall%mechanism%capacity)
   wall = made('two_block', 3.0_wp, 0.25_wp)
   forms(6) = new_normal_form(wall%mechanism, 2.0_wp*wall%mechanism%capacity)
   wall = a_wall(5)
   forms(7) = new_normal_form(wall%mechanism, wall%mechanism%capacity)
   wall = made('two_block', 6.0_wp, 0.1_wp)
   forms(8) = new_normal_form(wall%mechanism, 0.1_wp*wall%mechanism%capacity)
   wall = made('two_block', 3.0_wp, 0.25_wp)
   forms(9) = new_normal_form(wall%mechanism, 1.6_wp*wall%mechanism%capacity)
   random = new_random(31, 0)
   call suite('series')
   call check(all(forms%exists) .and. &
      & all([(any(forms%degree == degrees(i) .and. .not. forms%is_harmonic), i=1, size(degrees))]) .and. &
      & all([(any(forms%degree == harmonic_degrees(i) .and. forms%is_harmonic), i=1, size(harmonic_degrees))]), &
      & 'forms of every degree')
   call test_series()
   call suite('promises')
   call test_promises()
   call suite('starts')
   call test_starts()
   call suite('moves')
   call test_moves()
   call finish()

contains

   !> A lane that moves takes every word of its state with it, and leaves the others alone
   subroutine test_moves()
      type(lanes_type), allocatable, target :: lanes
      integer(lane_integer), pointer :: words(:, :)
      integer(lane_integer), allocatable :: before(:, :)
      integer :: j

      allocate (lanes)
      call check(modulo(storage_size(lanes), lane_width*storage_size(words)) == 0, 'each component has a word for each lane')
      call c_f_pointer(c_loc(lanes), words, [lane_width, storage_size(lanes)/storage_size(words)/lane_width])
      words = reshape([(int(j, lane_integer), j=1, size(words))], shape(words))
      before = words
      call move_lane(lanes, lane_width, 2)
      call check(all(words(2, :) == before(lane_width, :)), 'all words move')
      call check(all(words(1, :) == before(1, :)) .and. all(words(3:, :) == before(3:, :)), 'no other lane changes')
      call check(lanes%y(2) == lanes%y(lane_width) .and. lanes%flag(2) == lanes%flag(lane_width) &
         & .and. lanes%below(2) == lanes%below(lane_width), 'components of both kinds, the first and the last among them')
   end subroutine test_moves

   !> Lanes in states of all kinds
   subroutine fill(lanes, longest)
      type(lanes_type), intent(out) :: lanes
      real(wp), intent(in) :: longest
      integer :: j

      do j = 1, lane_width
         lanes%y(j) = y_limit*random%next()
         if (choice(random, 3) == 1) lanes%y(j) = across(random, 1.0e-8_wp, 1.0_wp)
         lanes%v(j) = between(random, -1.0_wp, 1.0_wp)*across(random, 1.0e-3_wp, 20.0_wp)
         lanes%dt(j) = across(random, 1.0e-3_wp, longest)
         lanes%time(j) = 0.0_wp
         if (choice(random, 2) == 1) lanes%time(j) = lanes%dt(j)*random%next()
         lanes%rate(j) = 1.0_wp/lanes%dt(j)
         lanes%u(j) = between(random, -20.0_wp, 20.0_wp)
         lanes%u_next(j) = between(random, -20.0_wp, 20.0_wp)
         lanes%slope(j) = (lanes%u_next(j) - lanes%u(j))/(lanes%dt(j) - lanes%time(j))
         lanes%factor(j) = between(random, -3.0_wp, 3.0_wp)
         lanes%span(j) = lanes%dt(j)*merge(0.3_wp, 2.0_wp, choice(random, 3) == 1)
         lanes%next_span(j) = lanes%span(j)
         lanes%peak(j) = y_limit*random%next()
         lanes%next(j) = choice(random, 6)
         lanes%last(j) = 6
      end do
   end subroutine fill

   !> The recurrence for y'' = a + b u with a and b to their fourth derivatives; what t^9 may leave out are the
   !> terms of x^3 and x^4
   subroutine test_series()
      type(lanes_type) :: lanes
      real(wp) :: d(0:9), p(0:4, 0:9), a(0:4), b(0:4), terms(2:9), left_out, h
      integer :: i, j, k, n, m
      logical :: good

      do i = 1, ubound(forms, 1)
         call fill(lanes, 0.5_wp)
         ! Without a tolerance no step is taken.
         call step_lanes(lanes, lane_width, forms(i), samples, 0.0_wp, 0.0_wp)
         good = all(lanes%flag == step_too_long)
         do j = 1, lane_width
            a = derivatives(forms(i)%a, lanes%y(j) - 1.0_wp)
            b = derivatives(forms(i)%b, lanes%y(j) - 1.0_wp)
            ! p(m, :) is the series of x^m, x the change of y; |...| of all terms tells the rounding.
            d = 0.0_wp
            d(1) = lanes%v(j)
            do k = 2, 9
               p = 0.0_wp
               p(0, 0) = 1.0_wp
               do m = 1, 4
                  do n = 1, k - 2
                     p(m, n) = sum(d(1:n)*p(m - 1, n - 1:0:-1))
                  end do
               end do
               n = k - 2
               d(k) = sum((a + b*lanes%u(j))*p(:, n))
               terms(k) = sum(abs((a + b*lanes%u(j))*p(:, n)))
               if (n > 0) d(k) = d(k) + sum(b*lanes%slope(j)*p(:, n - 1))
               if (n > 0) terms(k) = terms(k) + sum(abs(b*lanes%slope(j)*p(:, n - 1)))
               d(k) = d(k)/real(k*(k - 1), wp)
            end do
            left_out = sum(abs((a(3:) + b(3:)*lanes%u(j))*p(3:, 7)) + abs(b(3:)*lanes%slope(j)*p(3:, 6)))/72.0_wp
            h = lanes%step(j)
            do k = 2, 9
               good = good .and. abs(lanes%series(j, k) - d(k)*h**(k - 1)) <= (1.0e-10_wp*(terms(k) + abs(d(k))) &
                  & + merge(left_out, 0.0_wp, k == 9))*h**(k - 1)
            end do
         end do
         call check(good, 'form '//to_text(i))
      end do
   end subroutine test_series

   !> A step that is taken has no impact, no turning point above the peak and no limit in it, ends where its series
   !> does, and moves the lane on; one that is not leaves it where it was
   subroutine test_promises()
      type(lanes_type) :: lanes, before
      integer, parameter :: points = 200
      real(wp) :: y(0:points), h, rest, series(2:9)
      integer :: i, j, k, round, taken, wrong(5)

      taken = 0
      wrong = 0
      do round = 1, 300
         i = choice(random, ubound(forms, 1))
         call fill(lanes, 0.5_wp)
         call graze(lanes, forms(i))
         before = lanes
         call step_lanes(lanes, lane_width, forms(i), samples, 1.0e-2_wp, 1.0e-2_wp)
         do j = 1, lane_width
            rest = before%dt(j) - before%time(j)
            h = lanes%step(j)
            if (h > rest .or. h > before%span(j) .and. h < rest) wrong(1) = wrong(1) + 1
            if (lanes%flag(j) >= event_possible) then
               if (lanes%y(j) /= before%y(j) .or. lanes%v(j) /= before%v(j) .or. lanes%time(j) /= before%time(j) .or. &
                  & lanes%next(j) /= before%next(j)) wrong(2) = wrong(2) + 1
               cycle
            end if
            taken = taken + 1
            series = h*lanes%series(j, :)
            y = [(value(before%y(j), before%v(j)*h, series, real(k, wp)/points), k=0, points)]
            if (any(y < 0.0_wp)) wrong(3) = wrong(3) + 1
            ! A new peak only at the end, where the motion goes on to rise
            if (maxval(y) > max(before%peak(j), y(0), y(points)) .or. maxval(y) >= y_limit .or. &
               & (y(points) > before%peak(j) .and. y(points) > y(0) .and. &
               & any(y(1:) < y(:points - 1) - 4.0_wp*epsilon(h)*maxval(y)))) then
              wrong(4) = wrong(4) + 1
            end if
            if (h == rest .neqv. lanes%next(j) == before%next(j) + 1) wrong(5) = wrong(5) + 1
            if (h == rest .and. (lanes%time(j) /= 0.0_wp .or. lanes%u(j) /= before%u_next(j))) wrong(5) = wrong(5) + 1
            if (abs(lanes%y(j) - y(points)) > 1.0e-13_wp*maxval(y)) wrong(5) = wrong(5) + 1
         end do
      end do
      call check(taken > 2000, 'many steps are taken: '//to_text(taken))
      call check(wrong(1) == 0, 'steps too long: '//to_text(wrong(1)))
      call check(wrong(2) == 0, 'moved without a step: '//to_text(wrong(2)))
      call check(wrong(3) == 0, 'impacts in steps: '//to_text(wrong(3)))
      call check(wrong(4) == 0, 'peaks in steps: '//to_text(wrong(4)))
      call check(wrong(5) == 0, 'wrong ends: '//to_text(wrong(5)))
   end subroutine test_promises

   !> A step from rest, where the ground has just come to the trigger: if it is taken the motion rises all the way. It is where
   !> the ground goes on, and where it goes back it is not; nor is that of a wall that falls to the ground
   subroutine test_starts()
      type(lanes_type) :: lanes
      integer, parameter :: points = 200
      real(wp) :: a(0:4), b(0:4), outward, y(0:points)
      integer :: i, j, k, taken(2), wrong(3)

      taken = 0
      wrong = 0
      do i = 1, ubound(forms, 1)
         call fill(lanes, 0.02_wp)
         lanes%y = 0.0_wp
         lanes%v = 0.0_wp
         lanes%v(3::3) = -across(random, 1.0e-8_wp, 1.0_wp)
         a = derivatives(forms(i)%a, -1.0_wp)
         b = derivatives(forms(i)%b, -1.0_wp)
         do j = 1, lane_width
            lanes%u(j) = -a(0)/b(0)
            outward = sign(across(random, 1.0e-3_wp, 1.0e2_wp), b(0))
            if (modulo(j, 3) == 1) lanes%slope(j) = outward
            if (modulo(j, 3) == 2) lanes%slope(j) = -outward
         end do
         call step_lanes(lanes, lane_width, forms(i), samples, 1.0e-2_wp, 1.0e-2_wp)
         taken = taken + [count(lanes%flag(1::3) < event_possible), size(lanes%flag(1::3))]
         wrong(1) = wrong(1) + count(lanes%flag(2::3) < event_possible)
         wrong(2) = wrong(2) + count(lanes%flag(3::3) < event_possible)
         do j = 1, lane_width, 3
            if (lanes%flag(j) >= event_possible) cycle
            y = [(value(0.0_wp, 0.0_wp, lanes%step(j)*lanes%series(j, :), real(k, wp)/points), k=0, points)]
            if (any(y(1:) <= y(:points - 1)) .or. .not. y(points) < y_limit) wrong(3) = wrong(3) + 1
         end do
      end do
      call check(taken(1) > 0.95_wp*taken(2), 'starts that are taken: '//to_text(taken(1))//' of '//to_text(taken(2)))
      call check(wrong(1) == 0, 'the ground goes back: '//to_text(wrong(1)))
      call check(wrong(2) == 0, 'on the ground and falling: '//to_text(wrong(2)))
      call check(wrong(3) == 0, 'starts that do not rise: '//to_text(wrong(3)))
   end subroutine test_starts

   !> Lower the second half of the lanes so that their steps come next to y = 0, and put the peak of the first half next
   !> to that of the step
   subroutine graze(lanes, form)
      type(lanes_type), intent(inout) :: lanes
      type(normal_form_type), intent(in) :: form
      real(wp) :: y(0:50), off, series(2:9)
      integer :: j, k

      call step_lanes(lanes, lane_width, form, samples, 0.0_wp, 0.0_wp)
      do j = 1, lane_width
         series = lanes%step(j)*lanes%series(j, :)
         y = [(value(lanes%y(j), lanes%v(j)*lanes%step(j), series, k/50.0_wp), k=0, 50)]
         off = between(random, -1.0_wp, 1.0_wp)*across(random, 1.0e-8_wp, 1.0e-1_wp)
         if (j > lane_width/2) lanes%y(j) = min(max(1.0e-9_wp, lanes%y(j) - minval(y) + off), 0.999_wp*y_limit)
         if (j <= lane_width/2) lanes%peak(j) = min(max(0.0_wp, maxval(y) + off), y_limit)
      end do
   end subroutine graze

   !> Derivatives / k! of a polynomial in powers, up to the fourth
   pure function derivatives(a, z) result(c)
      real(wp), intent(in) :: a(0:), z
      real(wp) :: c(0:4)
      integer :: k, m

      c = 0.0_wp
      do k = ubound(a, 1), 0, -1
         do m = 4, 1, -1
            c(m) = c(m)*z + c(m - 1)
         end do
         c(0) = c(0)*z + a(k)
      end do
   end function derivatives

   !> The series of a step in the part x of it
   pure real(wp) function value(y, v, series, x)
      real(wp), intent(in) :: y, v, series(2:9), x
      integer :: k

      value = 0.0_wp
      do k = 9, 2, -1
         value = (value + series(k))*x
      end do
      value = y + (v + value)*x
   end function value

end program test_lane_kernel
