!> The equation of motion without its velocity: x'' = A(x) + B(x) u, whatever the mechanism.
!>
!> In the coordinate x = integral of sqrt(J/J(0)) dq the kinetic energy is J(0) x'^2/2, so that C q'^2 disappears
!> (docs/theory.md, section 5):
!>
!>     A = -(G - Q)/sqrt(J J(0))        B = -L/sqrt(J J(0))        u = s u_g''
!>
!> Under vertical ground motion the part of gravity in A varies too: x'' = A(x) + B(x) u + D(x) v_g''/g with
!> D = -G/sqrt(J J(0)).
!>
!> A, B and D are smooth: polynomials in z, which runs from -1 at rest to 1 at the limit rotation, hold them to rounding,
!> and one branch-free loop serves every mechanism. Lengths are in halves of x at the limit, y = z + 1. Where joints bend before
!> they open z runs from -1 at the rotation q_y where they do, and x is measured from there.
!>
!> Those of one rigid body that turns about a fixed point are harmonic: e cos(w z) + f sin(w z), with w the rotation at
!> z = 1 less that at z = 0. Two short polynomials in z^2 then serve all of them and all their derivatives.
!>
!> Ties and friction add -(force + stiffness D) D'/sqrt(J J(0)) to A, with constants that change in the course of a history: two
!> more functions for each of them, from which `restrained` makes the A of the moment. They are polynomials, or harmonic with w
!> and 2 w.
module dondolo_motion_normal_form
   use dondolo_base_chebyshev, only : as_powers, chebyshev_integral, chebyshev_nodes, chebyshev_series, chebyshev_value
   use dondolo_base_kinds, only : wp
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_travel, only : lever, travel
   implicit none
   private

   public :: normal_form_type, new_normal_form, power_series
   public :: degrees, highest_degree, harmonic_degrees, highest_harmonic, restrained_degrees, highest_restrained

   !> Degrees of the polynomials to choose from: a slender block, most walls, stocky ones, walls that lift heavy masses
   integer, parameter :: degrees(6) = [8, 13, 15, 18, 22, 32]
   integer, parameter :: highest_degree = degrees(6)

   !> Degrees of the polynomials of cos(w z): up to a slender block, and up to one of w = pi/4
   integer, parameter :: harmonic_degrees(2) = [10, 16]
   integer, parameter :: highest_harmonic = harmonic_degrees(2)

   !> Degrees of the polynomials of walls with ties
   integer, parameter :: restrained_degrees(2) = [14, 22]
   integer, parameter :: highest_restrained = restrained_degrees(2)

   !> Last of the coefficients of a harmonic A with ties: of cos(w z), sin(w z), cos(2 w z) and sin(2 w z), from 0
   integer, parameter :: last_amplitude = 3

   !> Highest degree whose powers keep the rounding of the series that they are made of
   integer, parameter :: highest_full = degrees(5)

   !> Nodes that the functions are sampled at
   integer, parameter :: nodes = 40

   !> Coefficients that rounding alone may leave, relative to the largest value
   real(wp), parameter :: noise = 10.0_wp*epsilon(1.0_wp)

   !> What the polynomials of a harmonic form may leave out, relative to the largest value
   real(wp), parameter :: rounding = 0.25_wp*epsilon(1.0_wp)

   !> Least limit / capacity, so that powers of its inverse stay finite
   real(wp), parameter :: least_limit = 1.0e-20_wp

   !> A mechanism up to its limit rotation
   type :: normal_form_type
      !> Do polynomials hold its terms to rounding? If not, the rest is undefined
      logical :: exists = .false.
      !> Has the wall ties? Then a is that of the wall without them
      logical :: is_restrained = .false.
      !> Are its terms harmonic?
      logical :: is_harmonic = .false.
      !> Degree of the polynomials: one of `harmonic_degrees`, else of `restrained_degrees` or `degrees`
      integer :: degree = 0
      !> y'' = a(z) + b(z) u: coefficients of 1, z, z^2, ... [1/s2] and [1/m]
      real(wp) :: a(0:highest_degree) = 0.0_wp, b(0:highest_degree) = 0.0_wp
      !> Bounds of the fifth derivatives of a and b, divided by 5!
      real(wp) :: fifth_a = 0.0_wp, fifth_b = 0.0_wp
      !> Is there vertical motion? Then y'' has a term d(z) v_g''/g more, with the same bound [1/s2]
      logical :: is_shaken = .false.
      real(wp) :: d(0:highest_degree) = 0.0_wp, fifth_d = 0.0_wp
      !> Of a harmonic form: amplitudes e of the cosine and f of the sine in a, b and d, and the coefficients of
      !> 1, z^2, z^4, ... in cos(w z) and in sin(w z)/z
      real(wp) :: even(3) = 0.0_wp, odd(3) = 0.0_wp
      real(wp) :: cosine(0:highest_harmonic/2) = 0.0_wp, sine(0:highest_harmonic/2 - 1) = 0.0_wp
      !> Last coefficient of a with ties; those of a without them, and for each tie what a force of 1 and a stiffness of 1 add to
      !> them and, of polynomials, to the bound
      integer :: last = 0
      real(wp), allocatable, private :: free(:), by_force(:, :), by_stiffness(:, :), fifth_by_force(:), fifth_by_stiffness(:)
      !> x at y = 1 [rad]; w of a harmonic form
      real(wp) :: unit = 0.0_wp
      !> Are x and q the same?
      logical, private :: is_identity = .false.
      !> Series of the rotation [rad] over z, and of x [rad] over the rotation, as far as they are more than rounding
      real(wp), allocatable, private :: q(:), x(:)
      !> Limit rotation [rad]
      real(wp), private :: limit = 0.0_wp
      !> Rotation at y = 0: 0, or where joints open that bend before [rad]
      real(wp) :: first = 0.0_wp
   contains
      !> Rotation q
      procedure :: rotation
      !> Coordinate y
      procedure :: coordinate
      !> The coefficients of a with the forces of the ties
      procedure :: restrained
      !> a from these
      procedure :: restrained_value
      !> Bound of the fifth derivative
      procedure :: fifth
   end type normal_form_type

   !> y at the limit rotation
   real(wp), parameter, public :: y_limit = 2.0_wp

contains

   !> The normal form of a mechanism up to a rotation
   function new_normal_form(mechanism, limit, is_shaken) result(form)
      class(mechanism_type), intent(in) :: mechanism
      !> Rotation up to which it is wanted [rad]
      real(wp), intent(in) :: limit
      !> Is it for vertical motion too? No, if absent
      logical, intent(in), optional :: is_shaken
      !> The normal form
      type(normal_form_type) :: form

      class(mechanism_type), allocatable :: wall
      real(wp), dimension(nodes) :: z, q, stretch, a, b, d
      real(wp) :: series(0:nodes - 1), inertia, target
      real(wp) :: length
      integer :: i, iteration, needed, kept

      form%first = mechanism%joint%opening
      length = limit - form%first
      if (length < least_limit*mechanism%capacity) return
      allocate (wall, source=mechanism)
      form%is_restrained = allocated(wall%restraints)
      if (form%is_restrained) call wall%set_restraints(spread(0.0_wp, 1, size(wall%restraints)), &
         & spread(0.0_wp, 1, size(wall%restraints)))
      if (present(is_shaken)) form%is_shaken = is_shaken
      form%limit = limit
      z = chebyshev_nodes(nodes)
      q = form%first + 0.5_wp*length*(1.0_wp + z)
      call sample(wall, q, inertia, stretch, a, b, d)
      form%is_identity = all(stretch == 1.0_wp)
      if (form%is_identity) then
         form%unit = 0.5_wp*length
      else
         ! x(q), and the rotations at the nodes in x by Newton's method
         series = chebyshev_series(stretch)
         if (degree_of(series) > highest_degree) return
         form%x = 0.5_wp*length*chebyshev_integral(series(:max(1, degree_of(series))))
         form%unit = 0.5_wp*sum(form%x)
         do i = 1, nodes
            target = form%unit*(1.0_wp + z(i))
            do iteration = 1, 10
               q(i) = q(i) - (chebyshev_value(form%x, 2.0_wp*(q(i) - form%first)/length - 1.0_wp) - target) &
                  & /chebyshev_value(series, 2.0_wp*(q(i) - form%first)/length - 1.0_wp)
               q(i) = min(max(q(i), form%first), limit)
            end do
         end do
         series = chebyshev_series(q)
         form%q = series(:degree_of(series))
         call sample(wall, q, inertia, stretch, a, b, d)
      end if
      a = a/form%unit
      b = b/form%unit
      d = d/form%unit
      if (form%is_identity) call fit_harmonic_form(form, z, a, b, d)
      if (form%is_harmonic .and. form%is_restrained) call add_harmonic_ties(form, wall, z, inertia)
      if (form%is_harmonic) return
      needed = max(degree_of(chebyshev_series(a)), degree_of(chebyshev_series(b)))
      if (form%is_shaken) needed = max(needed, degree_of(chebyshev_series(d)))
      if (form%is_restrained) then
         call add_ties(form, wall, q, stretch*inertia, needed)
         if (.not. form%exists) return
      else
         form%exists = needed <= highest_degree
         if (.not. form%exists) return
         form%degree = minval(degrees, degrees >= needed)
      end if
      ! Powers of a high degree enlarge rounding, which would rule the bound of the fifth derivative.
      kept = form%degree
      if (kept > highest_full) kept = needed
      call expand(a, kept, form%a, form%fifth_a)
      call expand(b, kept, form%b, form%fifth_b)
      if (form%is_shaken) call expand(d, kept, form%d, form%fifth_d)
      if (form%is_restrained) form%free = form%a(:form%last)
   end function new_normal_form

   !> What the ties of a harmonic form add to a, harmonic too unless the wall rolls on an edge: with D = f sin q + e (1 - cos q)
   !> and q = w (1 + z), D' = f cos q + e sin q and D D' = e f (cos q - cos 2q) + e^2 sin q + (f^2 - e^2)/2 sin 2q
   pure subroutine add_harmonic_ties(form, wall, z, inertia)
      !> The form; harmonic no more if the ties are not
      type(normal_form_type), intent(inout) :: form
      class(mechanism_type), intent(in) :: wall
      !> Nodes
      real(wp), intent(in) :: z(:)
      !> Inertia [kg m2]
      real(wp), intent(in) :: inertia

      integer :: i, ties

      ties = size(wall%restraints)
      form%last = last_amplitude
      form%free = [form%even(1), form%odd(1), 0.0_wp, 0.0_wp]
      allocate (form%by_force(0:last_amplitude, ties), form%by_stiffness(0:last_amplitude, ties), source=0.0_wp)
      associate (w => form%unit)
         do i = 1, ties
            associate (edge => wall%restraints(i)%edge, e => wall%restraints(i)%e, f => wall%restraints(i)%f, &
               & force => form%by_force(:, i), stiffness => form%by_stiffness(:, i))
               force(1:2) = turned(f, e, w)
               stiffness(1:2) = turned(e*f, e**2, w)
               stiffness(3:4) = turned(-e*f, 0.5_wp*(f**2 - e**2), 2.0_wp*w)
               force = -force/(inertia*w)
               stiffness = -stiffness/(inertia*w)
               ! Those along a mechanism have no place.
               form%is_harmonic = form%is_harmonic .and. .not. wall%restraints(i)%along%exists()
               if (.not. form%is_harmonic) exit
               form%is_harmonic = is_one(lever(edge, e, f, w*(1.0_wp + z)), force) &
                  & .and. is_one(lever(edge, e, f, w*(1.0_wp + z))*travel(edge, e, f, w*(1.0_wp + z)), stiffness)
            end associate
         end do
      end associate
      if (form%is_harmonic) return
      form%exists = .false.
      deallocate (form%by_force, form%by_stiffness)

   contains

      !> Amplitudes of the cosine and the sine of the angle from the middle of those of the angle from the beginning
      pure function turned(even, odd, angle)
         !> The amplitudes
         real(wp), intent(in) :: even, odd
         !> The angle to the middle [rad]
         real(wp), intent(in) :: angle
         real(wp) :: turned(2)

         turned = [even*cos(angle) + odd*sin(angle), odd*cos(angle) - even*sin(angle)]
      end function turned

      !> Do amplitudes give a function?
      pure logical function is_one(values, amplitudes)
         !> The function at the nodes, without its factor
         real(wp), intent(in) :: values(:)
         !> The amplitudes
         real(wp), intent(in) :: amplitudes(:)

         integer :: k

         is_one = all(abs([(form%restrained_value(amplitudes, 1.0_wp + z(k)), k=1, size(z))] &
            & + values/(inertia*form%unit)) <= noise*maxval(abs(values))/(inertia*form%unit))
      end function is_one

   end subroutine add_harmonic_ties

   !> What the ties add to a polynomial a
   pure subroutine add_ties(form, wall, q, inertia, least)
      !> The form; its unit is given
      type(normal_form_type), intent(inout) :: form
      class(mechanism_type), intent(in) :: wall
      !> Rotations at the nodes [rad], and sqrt(J J(0)) there [kg m2]
      real(wp), intent(in) :: q(:), inertia(:)
      !> Degree that its other terms need
      integer, intent(in) :: least

      real(wp), dimension(size(q), size(wall%restraints)) :: force, stiffness
      integer :: i, needed, ties

      ties = size(wall%restraints)
      needed = least
      do i = 1, ties
         associate (tie => wall%restraints(i))
            force(:, i) = -tie%lever_at(q)/(inertia*form%unit)
            stiffness(:, i) = force(:, i)*tie%elongation(q)
         end associate
         needed = max(needed, degree_of(chebyshev_series(force(:, i))), degree_of(chebyshev_series(stiffness(:, i))))
      end do
      form%exists = needed <= highest_restrained
      if (.not. form%exists) return
      form%degree = minval(restrained_degrees, restrained_degrees >= needed)
      form%last = form%degree
      allocate (form%by_force(0:form%last, ties), form%by_stiffness(0:form%last, ties))
      allocate (form%fifth_by_force(ties), form%fifth_by_stiffness(ties))
      do i = 1, ties
         call expand(force(:, i), form%degree, form%by_force(:, i), form%fifth_by_force(i))
         call expand(stiffness(:, i), form%degree, form%by_stiffness(:, i), form%fifth_by_stiffness(i))
      end do
   end subroutine add_ties

   !> Values at rotations
   pure subroutine sample(mechanism, q, inertia, stretch, a, b, d)
      class(mechanism_type), intent(in) :: mechanism
      !> Rotations [rad]
      real(wp), intent(in) :: q(:)
      !> Inertia J(0) [kg m2]
      real(wp), intent(out) :: inertia
      !> dx/dq, A [rad/s2], B [rad/m] and D [rad/s2] there
      real(wp), intent(out) :: stretch(:), a(:), b(:), d(:)

      real(wp) :: j, c, g, l, load
      integer :: i

      call mechanism%terms(0.0_wp, inertia, c, g, l, load)
      do i = 1, size(q)
         call mechanism%terms(q(i), j, c, g, l, load)
         stretch(i) = sqrt(j/inertia)
         a(i) = -(g - load)/(stretch(i)*inertia)
         b(i) = -l/(stretch(i)*inertia)
         d(i) = -g/(stretch(i)*inertia)
      end do
   end subroutine sample

   !> The harmonic form, if it is one to rounding
   pure subroutine fit_harmonic_form(form, z, a, b, d)
      !> The form; its unit is given
      type(normal_form_type), intent(inout) :: form
      !> Nodes, and the terms there
      real(wp), intent(in) :: z(:), a(:), b(:), d(:)

      logical :: are_harmonic(3)
      integer :: k, n

      associate (w => form%unit)
         call fit_amplitudes(w*z, a, form%even(1), form%odd(1), are_harmonic(1))
         call fit_amplitudes(w*z, b, form%even(2), form%odd(2), are_harmonic(2))
         call fit_amplitudes(w*z, d, form%even(3), form%odd(3), are_harmonic(3))
         do k = size(harmonic_degrees), 1, -1
            n = harmonic_degrees(k)
            if (last_term(w, n) > rounding) exit
            form%degree = n
         end do
         form%is_harmonic = all(are_harmonic) .and. form%degree > 0
         if (.not. form%is_harmonic) return
         form%exists = .true.
         form%fifth_a = hypot(form%even(1), form%odd(1))*w**5/120.0_wp
         form%fifth_b = hypot(form%even(2), form%odd(2))*w**5/120.0_wp
         if (form%is_shaken) form%fifth_d = hypot(form%even(3), form%odd(3))*w**5/120.0_wp
         form%cosine(0) = 1.0_wp
         form%sine(0) = w
         do k = 1, form%degree/2
            form%cosine(k) = -form%cosine(k - 1)*w**2/real((2*k - 1)*2*k, wp)
            if (k < form%degree/2) form%sine(k) = -form%sine(k - 1)*w**2/real(2*k*(2*k + 1), wp)
         end do
         n = form%degree
         form%a(0:n:2) = form%even(1)*form%cosine(:n/2)
         form%a(1:n - 1:2) = form%odd(1)*form%sine(:n/2 - 1)
         form%b(0:n:2) = form%even(2)*form%cosine(:n/2)
         form%b(1:n - 1:2) = form%odd(2)*form%sine(:n/2 - 1)
         if (.not. form%is_shaken) return
         form%d(0:n:2) = form%even(3)*form%cosine(:n/2)
         form%d(1:n - 1:2) = form%odd(3)*form%sine(:n/2 - 1)
      end associate
   end subroutine fit_harmonic_form

   !> What a sine loses by the degree n of the cosine beside it, relative to its value at 2 w: w^n/(2 (n + 1)!)
   pure real(wp) function last_term(w, n)
      !> Largest angle [rad]
      real(wp), intent(in) :: w
      !> Degree
      integer, intent(in) :: n

      integer :: k

      last_term = 0.5_wp
      do k = 2, n + 1
         last_term = last_term*w/real(k, wp)
      end do
   end function last_term

   !> Amplitudes of a harmonic function: at nodes that lie evenly about zero its two parts are orthogonal
   pure subroutine fit_amplitudes(angles, values, even, odd, is_harmonic)
      !> Angles w z [rad], and the function there
      real(wp), intent(in) :: angles(:), values(:)
      !> Amplitudes of the cosine and of the sine
      real(wp), intent(out) :: even, odd
      !> Is it harmonic?
      logical, intent(out) :: is_harmonic

      even = sum(values*cos(angles))/sum(cos(angles)**2)
      odd = sum(values*sin(angles))/sum(sin(angles)**2)
      is_harmonic = all(abs(even*cos(angles) + odd*sin(angles) - values) <= noise*maxval(abs(values)))
   end subroutine fit_amplitudes

   !> Degree beyond which a series is nothing but rounding
   pure integer function degree_of(series)
      !> Coefficients
      real(wp), intent(in) :: series(0:)

      degree_of = findloc(abs(series) > noise*maxval(abs(series)), .true., dim=1, back=.true.) - 1
   end function degree_of

   !> Powers of z through values at the nodes, and a bound of their fifth derivative / 5!
   pure subroutine expand(values, degree, powers, fifth)
      !> Values
      real(wp), intent(in) :: values(:)
      !> Degree to keep
      integer, intent(in) :: degree
      !> Coefficients of 1, z, z^2, ...
      real(wp), intent(out) :: powers(0:)
      !> sum of |coefficient| k!/(5! (k - 5)!)
      real(wp), intent(out) :: fifth

      real(wp) :: series(0:size(values) - 1)
      integer :: k

      series = chebyshev_series(values)
      powers = 0.0_wp
      powers(:degree) = as_powers(series(:degree))
      fifth = 0.0_wp
      do k = 5, ubound(powers, 1)
         fifth = fifth + abs(powers(k))*real(k*(k - 1)*(k - 2)*(k - 3)*(k - 4)/120, wp)
      end do
   end subroutine expand

   !> The coefficients of a with the forces of the ties
   pure subroutine restrained(self, force, stiffness, a, fifth_a)
      class(normal_form_type), intent(in) :: self
      !> Of each tie: T = force + stiffness D [N/m] and [N/m per m]
      real(wp), intent(in) :: force(:), stiffness(:)
      !> Coefficients up to `last` [1/s2], and the bound of the fifth derivative of a / 5!
      real(wp), intent(out) :: a(0:highest_restrained), fifth_a

      integer :: i

      a(:self%last) = self%free
      fifth_a = self%fifth_a
      do i = 1, size(force)
         if (force(i) == 0.0_wp .and. stiffness(i) == 0.0_wp) cycle
         a(:self%last) = a(:self%last) + (force(i)*self%by_force(:, i) + stiffness(i)*self%by_stiffness(:, i))
         if (.not. self%is_harmonic) fifth_a = fifth_a &
            & + abs(force(i))*self%fifth_by_force(i) + abs(stiffness(i))*self%fifth_by_stiffness(i)
      end do
      if (self%is_harmonic) fifth_a = (sqrt(a(0)**2 + a(1)**2) + 32.0_wp*sqrt(a(2)**2 + a(3)**2))*self%unit**5/120.0_wp
   end subroutine restrained

   !> a of a wall with ties [1/s2]
   pure real(wp) function restrained_value(self, a, y) result(value)
      class(normal_form_type), intent(in) :: self
      !> Its coefficients, from `restrained` [1/s2]
      real(wp), intent(in) :: a(0:)
      !> Coordinate
      real(wp), intent(in) :: y

      real(wp) :: angle

      if (self%is_harmonic) then
         angle = self%unit*(y - 1.0_wp)
         value = (a(0)*cos(angle) + a(1)*sin(angle)) + (a(2)*cos(2.0_wp*angle) + a(3)*sin(2.0_wp*angle))
      else
         value = power_series(a(:self%last), y - 1.0_wp)
      end if
   end function restrained_value

   !> Value of a polynomial
   pure real(wp) function power_series(c, z) result(value)
      !> Coefficients of 1, z, z^2, ...
      real(wp), intent(in) :: c(0:)
      !> Argument
      real(wp), intent(in) :: z

      integer :: k

      value = c(ubound(c, 1))
      do k = ubound(c, 1) - 1, 0, -1
         value = value*z + c(k)
      end do
   end function power_series

   !> Bound of the fifth derivative of y''/5! by y [1/s2]
   elemental real(wp) function fifth(self, fifth_a, u, heavier)
      class(normal_form_type), intent(in) :: self
      !> That of a/5! [1/s2]
      real(wp), intent(in) :: fifth_a
      !> Ground acceleration [m/s2]
      real(wp), intent(in) :: u
      !> Vertical ground acceleration / g
      real(wp), intent(in) :: heavier

      fifth = fifth_a + self%fifth_b*abs(u) + self%fifth_d*abs(heavier)
   end function fifth

   !> Coordinate y of a rotation; huge beyond the limit
   pure real(wp) function coordinate(self, q)
      class(normal_form_type), intent(in) :: self
      !> Rotation, at least that at y = 0 [rad]
      real(wp), intent(in) :: q

      coordinate = huge(q)
      if (q > self%limit) return
      if (self%is_identity) then
         coordinate = (q - self%first)/self%unit
      else
         coordinate = max(0.0_wp, chebyshev_value(self%x, 2.0_wp*(q - self%first)/(self%limit - self%first) - 1.0_wp)/self%unit)
      end if
   end function coordinate

   !> Rotation q [rad]
   pure real(wp) function rotation(self, y)
      class(normal_form_type), intent(in) :: self
      !> Coordinate, 0 <= y <= y_limit
      real(wp), intent(in) :: y

      if (self%is_identity) then
         rotation = self%first + self%unit*y
      else
         ! Rounding may lead below the first.
         rotation = max(self%first, chebyshev_value(self%q, y - 1.0_wp))
      end if
   end function rotation

end module dondolo_motion_normal_form
