!> The normal form against the terms of the mechanism: y'' by the chain rule from q'', the energy, the rotation.
program test_normal_form
   use checks, only : check, check_close, check_ok, finish, suite
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : to_text
   use dondolo_motion_normal_form, only : degrees, harmonic_degrees, highest_restrained, new_normal_form, normal_form_type, &
      & restrained_degrees, y_limit
   use dondolo_motion_solver, only : check_limit, solver_type
   use dondolo_record_random, only : new_random, random_type
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   use dondolo_wall_mechanism, only : mechanism_type
   use tied_history, only : new_tied_history
   use motion_inputs, only : a_wall, made
   use random_history, only : across, between, history_type, random_wall
   implicit none

   real(wp), parameter :: eps = epsilon(1.0_wp)

   !> Limits in units of the capacity
   real(wp), parameter :: limits(8) = [0.01_wp, 0.1_wp, 0.3_wp, 0.5_wp, 1.0_wp, 1.5_wp, 2.0_wp, 3.0_wp]

   !> A two-block wall has no normal form where it is squat and goes far out: a block of it is lower than so many of its
   !> thicknesses, times the limit in units of the capacity
   real(wp), parameter :: squat = 2.4_wp

   type(random_type) :: random
   integer :: with_form = 0, without_form = 0, of_degree(size(degrees)) = 0, harmonic(size(harmonic_degrees)) = 0
   real(wp) :: worst(3) = 0.0_wp

   random = new_random(20261121, 0)
   call suite('walls of the tests')
   call test_named_walls()
   call suite('random walls')
   call test_random_walls()
   call test_degrees()
   call test_existence()
   call test_ties()
   print '(a, 3es9.1, 2(a, i0), a, *(1x, i0))', 'worst', worst, '; forms ', with_form, ', none ', without_form, &
      & '; of each degree, harmonic ones last', of_degree, harmonic
   call finish()

contains

   !> Every mechanism, slender and squat, to small and large limits
   subroutine test_named_walls()
      type(wall_type) :: walls(7)
      integer :: i, j

      do i = 1, 4
         walls(i) = a_wall(i)
      end do
      walls(5) = made('one_sided', 2.0_wp, 1.0_wp)
      walls(6) = made('free_standing', 1.0_wp, 0.9_wp)
      walls(7) = made('two_block', 3.0_wp, 0.8_wp)
      do i = 1, size(walls)
         do j = 1, size(limits)
            call test_form(walls(i), limits(j), 'wall '//to_text(i)//' to '//to_text(limits(j)))
         end do
      end do
      call test_form(a_wall(5), 1.0_wp, 'a wall that lifts a heavy mass')
   end subroutine test_named_walls

   !> Any wall to any limit
   subroutine test_random_walls()
      type(wall_type) :: wall
      integer :: i

      do i = 1, 400
         wall = random_wall(random)
         call test_form(wall, across(random, 0.01_wp, 3.0_wp), 'random wall '//to_text(i))
      end do
   end subroutine test_random_walls

   !> All that a form must hold, up to a limit
   subroutine test_form(wall, edp_limit, what)
      type(wall_type), intent(in) :: wall
      real(wp), intent(in) :: edp_limit
      character(len=*), intent(in) :: what
      type(normal_form_type) :: form
      type(error_type), allocatable :: error
      real(wp) :: limit

      call check_limit(solver_type(edp_limit=edp_limit), wall%mechanism, error)
      if (allocated(error)) return
      limit = edp_limit*wall%mechanism%capacity
      form = new_normal_form(wall%mechanism, limit)
      if (.not. form%exists) then
         without_form = without_form + 1
         call check(least_slenderness(wall) < squat*edp_limit, what//': no form')
         return
      end if
      with_form = with_form + 1
      if (form%is_harmonic) then
         where (harmonic_degrees == form%degree) harmonic = harmonic + 1
         call check(any(harmonic_degrees == form%degree), what//': degree of the cosine')
      else
         where (degrees == form%degree) of_degree = of_degree + 1
         call check(any(degrees == form%degree), what//': degree')
      end if
      call check_rotation(form, wall%mechanism, limit, what)
      call check_acceleration(form, wall%mechanism, what)
      call check_energy(form, wall%mechanism, what)
      call check_fifth(form, what)
   end subroutine test_form

   !> Height / thickness of the more squat one of two blocks; a single block has a form whatever it is
   real(wp) function least_slenderness(wall)
      type(wall_type), intent(in) :: wall

      least_slenderness = huge(1.0_wp)
      if (wall%input%has('hinge')) least_slenderness = min(wall%input%number('hinge'), 1.0_wp - wall%input%number('hinge')) &
         & *wall%input%number('height')/wall%input%number('thickness')
   end function least_slenderness

   !> The rotation rises from 0 to the limit, and the integral of sqrt(J/J(0)) leads back to y
   subroutine check_rotation(form, mechanism, limit, what)
      type(normal_form_type), intent(in) :: form
      class(mechanism_type), intent(in) :: mechanism
      real(wp), intent(in) :: limit
      character(len=*), intent(in) :: what
      integer, parameter :: n = 50
      real(wp) :: q(0:n), y, x, j0, j1, j2, j3
      integer :: i

      q = [(form%rotation(y_limit*i/n), i=0, n)]
      call check(all(q(1:) > q(:n - 1)), what//': rotation rises')
      call check_close(q(0), 0.0_wp, 0.0_wp, what//': rotation at rest', 20.0_wp*eps*limit)
      call check(q(0) >= 0.0_wp, what//': rotation at rest is negative')
      call check_close(q(n), limit, 20.0_wp*eps, what//': rotation at the limit')
      ! Gauss's rule with three points from y to y
      x = 0.0_wp
      j0 = inertia(mechanism, 0.0_wp)
      do i = 1, n
         associate (middle => 0.5_wp*(q(i) + q(i - 1)), half => 0.5_wp*(q(i) - q(i - 1)))
            j1 = inertia(mechanism, middle - sqrt(0.6_wp)*half)
            j2 = inertia(mechanism, middle)
            j3 = inertia(mechanism, middle + sqrt(0.6_wp)*half)
            x = x + half*(5.0_wp*sqrt(j1/j0) + 8.0_wp*sqrt(j2/j0) + 5.0_wp*sqrt(j3/j0))/9.0_wp
         end associate
         y = x/form%unit
         worst(1) = max(worst(1), abs(y - y_limit*i/n))
      end do
      call check_close(y, y_limit, 0.0_wp, what//': y from the inertia', 1.0e-9_wp)
   end subroutine check_rotation

   !> y'' at random y, q' and u: x' = r q' with r = sqrt(J/J(0)), so that x'' = r q'' + C q'^2/(r J(0))
   subroutine check_acceleration(form, mechanism, what)
      type(normal_form_type), intent(in) :: form
      class(mechanism_type), intent(in) :: mechanism
      character(len=*), intent(in) :: what
      real(wp) :: y, q, v, u, j, c, g, l, load, j0, r, bend, expected, actual, scale
      integer :: i

      j0 = inertia(mechanism, 0.0_wp)
      do i = 1, 20
         y = y_limit*random%next()
         if (i == 1) y = 0.0_wp
         if (i == 2) y = y_limit
         q = form%rotation(y)
         v = between(random, -2.0_wp, 2.0_wp)*mechanism%frequency_parameter()*mechanism%capacity
         u = between(random, -20.0_wp, 20.0_wp)
         call mechanism%terms(q, j, c, g, l, load)
         r = sqrt(j/j0)
         bend = (load - g - l*u - c*v**2)/j
         expected = (r*bend + c*v**2/(r*j0))/form%unit
         actual = horner(form%a, y - 1.0_wp) + horner(form%b, y - 1.0_wp)*u
         ! Rounding of the polynomials is that of their largest values.
         scale = maxval(abs([horner(form%a, -1.0_wp), horner(form%a, 1.0_wp), horner(form%b, -1.0_wp)*20.0_wp]))
         worst(2) = max(worst(2), abs(actual - expected)/scale)
         call check(abs(actual - expected) <= 1.0e-12_wp*scale, what//': acceleration at '//to_text(y)//' is '// &
            & to_text(actual)//', should be '//to_text(expected))
      end do
   end subroutine check_acceleration

   !> The work of A from rest to y is the fall of the potential energy, in units of J(0)
   subroutine check_energy(form, mechanism, what)
      type(normal_form_type), intent(in) :: form
      class(mechanism_type), intent(in) :: mechanism
      character(len=*), intent(in) :: what
      real(wp) :: integral(0:form%degree + 1), y, work, fall, scale
      integer :: i, k

      integral(0) = 0.0_wp
      integral(1:) = [(form%a(k)/real(k + 1, wp), k=0, form%degree)]
      scale = mechanism%potential(mechanism%capacity) - mechanism%potential(0.0_wp)
      do i = 1, 5
         y = 0.4_wp*i
         work = inertia(mechanism, 0.0_wp)*form%unit**2*(horner(integral, y - 1.0_wp) - horner(integral, -1.0_wp))
         fall = mechanism%potential(0.0_wp) - mechanism%potential(form%rotation(y))
         worst(3) = max(worst(3), abs(work - fall)/(scale + abs(fall)))
         call check(abs(work - fall) <= 1.0e-11_wp*(scale + abs(fall)) + 20.0_wp*eps*mechanism%potential(0.0_wp), &
            & what//': energy '//to_text(work)//', should be '//to_text(fall))
      end do
   end subroutine check_energy

   !> The bounds of the fifth derivatives hold
   subroutine check_fifth(form, what)
      type(normal_form_type), intent(in) :: form
      character(len=*), intent(in) :: what
      real(wp) :: z
      integer :: i

      do i = -10, 10
         z = 0.1_wp*i
         ! Polynomials stand for a cosine and a sine here, whose fifth derivatives they have to a part in a million.
         associate (margin => merge(1.0e-6_wp, 10.0_wp*eps, form%is_harmonic))
            call check(abs(fifth(form%a, z)) <= form%fifth_a*(1.0_wp + margin) .and. &
               & abs(fifth(form%b, z)) <= form%fifth_b*(1.0_wp + margin), what//': fifth derivatives')
         end associate
      end do
   end subroutine check_fifth

   !> Fifth derivative / 5!
   pure real(wp) function fifth(a, z)
      real(wp), intent(in) :: a(0:), z
      real(wp) :: d(0:ubound(a, 1))
      integer :: k, m

      d = a
      do m = 1, 5
         d(:ubound(a, 1) - m) = [(d(k)*k/real(m, wp), k=1, ubound(a, 1) - m + 1)]
      end do
      fifth = horner(d(:ubound(a, 1) - 5), z)
   end function fifth

   !> One body is harmonic, with a load or without, and a squat one needs the higher degree; a hinge that moves is not. A
   !> two-block wall far out or with a heavy mass needs the highest degrees
   subroutine test_degrees()

      call suite('degrees')
      call check(degree_of(a_wall(1), 1.0_wp) == harmonic_degrees(1), 'a slender block')
      call check(degree_of(made('one_sided', 1.0_wp, 0.9_wp), 1.5_wp) == harmonic_degrees(2), 'a squat block')
      call check(degree_of(made('two_block', 3.0_wp, 0.25_wp), 1.6_wp) == degrees(4), 'a two-block wall far out')
      call check(degree_of(made('two_block', 3.0_wp, 0.25_wp), 2.0_wp) == degrees(5), 'a two-block wall farther out')
      call check(degree_of(a_wall(5), 1.0_wp) == degrees(6), 'a wall that lifts a heavy mass')
   end subroutine test_degrees

   !> Degree of the form of a wall
   integer function degree_of(wall, edp_limit)
      type(wall_type), intent(in) :: wall
      real(wp), intent(in) :: edp_limit
      type(normal_form_type) :: form

      form = new_normal_form(wall%mechanism, edp_limit*wall%mechanism%capacity)
      degree_of = form%degree
      call check(form%exists, 'it exists')
   end function degree_of

   !> There is none next to the geometric end of a two-block wall, and for a limit that is next to nothing
   subroutine test_existence()
      type(wall_type) :: wall

      call suite('existence')
      call check(with_form > 15*without_form, 'nearly every wall has a form')
      wall = made('two_block', 3.0_wp, 0.25_wp)
      call check(.not. has_form(wall%mechanism, (1.0_wp - 1.0e-3_wp)*wall%mechanism%geometric_end()), 'next to the end')
      wall = a_wall(2)
      call check(has_form(wall%mechanism, 0.999_wp*wall%mechanism%geometric_end()), 'a block ends smoothly')
      call check(has_form(wall%mechanism, 1.0e-12_wp*wall%mechanism%capacity), 'a small limit')
      call check(.not. has_form(wall%mechanism, tiny(1.0_wp)), 'a limit that would overflow')
   end subroutine test_existence

   !> Walls with ties and friction in any mode, harmonic and not: y'' from the terms, and the bound of the fifth
   !> derivative, which fifth differences cannot exceed
   subroutine test_ties()
      integer, parameter :: n = 20
      type(history_type) :: history
      type(normal_form_type) :: form
      type(wall_type) :: squat_wall
      class(mechanism_type), allocatable :: wall
      real(wp), allocatable :: force(:), stiffness(:)
      real(wp) :: a(0:highest_restrained), fifth_a, value(0:n), scale, difference(0:n), largest
      integer :: found(4), i, k

      call suite('ties')
      found = 0
      largest = 0.0_wp
      do i = 1, 320
         history = new_tied_history(50000 + i)
         wall = history%wall%mechanism
         if (i > 300) then
            squat_wall = squat_with_tie(max(0.0_wp, 0.025_wp*(i - 310)))
            wall = squat_wall%mechanism
         end if
         if (allocated(force)) deallocate (force, stiffness)
         allocate (force(size(wall%restraints)), stiffness(size(wall%restraints)))
         form = new_normal_form(wall, merge(1.0_wp, across(random, 0.05_wp, 1.5_wp), modulo(i, 2) == 0) &
            & *merge(2.0_wp, 1.0_wp, i > 310)*wall%capacity)
         if (.not. form%exists) cycle
         if (form%is_harmonic) then
            found(findloc(harmonic_degrees, form%degree, dim=1)) = found(findloc(harmonic_degrees, form%degree, dim=1)) + 1
         else
            found(2 + findloc(restrained_degrees, form%degree, dim=1)) = &
               & found(2 + findloc(restrained_degrees, form%degree, dim=1)) + 1
         end if
         do k = 1, size(force)
            force(k) = between(random, -1.0_wp, 1.0_wp)*wall%restraints(k)%strength
            stiffness(k) = merge(0.0_wp, wall%restraints(k)%stiffness, modulo(i, 3) == 0)
            if (wall%restraints(k)%is_friction) stiffness(k) = -wall%restraints(k)%strength/wall%restraints(k)%fracture_travel
         end do
         call wall%set_restraints(force, stiffness)
         call form%restrained(force, stiffness, a, fifth_a)
         value = [(acceleration_at(form, wall, y_limit*k/n), k=0, n)]
         scale = maxval(abs(value)) + sum(abs(force)*wall%restraints%f)/(inertia(wall, 0.0_wp)*form%unit)
         do k = 0, n
            difference(k) = form%restrained_value(a, y_limit*k/n) - value(k)
         end do
         largest = max(largest, maxval(abs(difference))/scale)
         call check(maxval(abs(difference)) <= 1.0e-12_wp*scale, to_text(i)//': acceleration is off by '// &
            & to_text(maxval(abs(difference))/scale))
         difference = value
         do k = 1, 5
            difference(:n - k) = difference(1:n - k + 1) - difference(:n - k)
         end do
         call check(all(abs(difference(:n - 5)) <= 120.0_wp*fifth_a*(y_limit/n)**5 + 100.0_wp*eps*scale), &
            & to_text(i)//': fifth derivative')
      end do
      call check(all(found > 3), 'forms of every kind: '//to_text(found(1))//', '//to_text(found(2))//', '//to_text(found(3))// &
         & ' and '//to_text(found(4)))
      print '(a, es9.1, a, *(1x, i0))', 'worst with ties', largest, ', forms', found
   end subroutine test_ties

   !> A squat wall with a tie
   function squat_with_tie(edge_radius) result(wall)
      real(wp), intent(in) :: edge_radius
      type(wall_type) :: wall
      type(wall_input_type) :: input
      type(error_type), allocatable :: error

      call input%set('mechanism', 'one_sided')
      call input%set('height', 1.0_wp)
      call input%set('thickness', 0.9_wp)
      call input%set('edge_radius', edge_radius)
      call input%set('tie_height', [0.9_wp])
      call input%set('tie_area', [5.0e-5_wp])
      call input%set('tie_length', [8.0_wp])
      call new_wall(wall, input, error)
      call check_ok(error, 'squat wall')
   end function squat_with_tie

   !> y'' of a wall without velocity, over ground at rest
   real(wp) function acceleration_at(form, mechanism, y)
      type(normal_form_type), intent(in) :: form
      class(mechanism_type), intent(in) :: mechanism
      real(wp), intent(in) :: y
      real(wp) :: j, c, g, l, load

      call mechanism%terms(form%rotation(y), j, c, g, l, load)
      acceleration_at = (load - g)/(sqrt(j*inertia(mechanism, 0.0_wp))*form%unit)
   end function acceleration_at

   !> Does it have a form?
   logical function has_form(mechanism, limit)
      class(mechanism_type), intent(in) :: mechanism
      real(wp), intent(in) :: limit
      type(normal_form_type) :: form

      form = new_normal_form(mechanism, limit)
      has_form = form%exists
   end function has_form

   !> Inertia at a rotation
   real(wp) function inertia(mechanism, q)
      class(mechanism_type), intent(in) :: mechanism
      real(wp), intent(in) :: q
      real(wp) :: c, g, l, load

      call mechanism%terms(q, inertia, c, g, l, load)
   end function inertia

   !> Value of a polynomial in powers
   pure real(wp) function horner(a, z)
      real(wp), intent(in) :: a(0:), z
      integer :: k

      horner = 0.0_wp
      do k = ubound(a, 1), 0, -1
         horner = horner*z + a(k)
      end do
   end function horner

end program test_normal_form
