!> Statics of a strip between two floors whose middle hinge may lie at any height: multiplier, the hinge at which it is least, and
!> the forces on the floors.
!>
!> The hinge at the base is at (w, 0), that in the middle at (-w, r H), that on top at (w, H), with x from the centre line and
!> positive outwards. With T = r/(1 - r) a unit of rotation of the lower block moves a point by
!>
!>     z < r H:  dx = z             dy = w - x
!>     z > r H:  dx = (H - z) T     dy = 2 w + (x + w) T
!>
!>     alpha_0(r) = [2 W w + N (2 w + (w + e) T) + sum P dy - sum F dx]/[W H T/(2 (1 + T)) + sum D dx]
!>
!> with P weights on the strip, D the weights of what moves with it, and F forces outwards, thrusts less ties.
!>
!> Between two neighbouring heights of P, D and F it is (n0 + n1 T)/[d0 + d1 T + c T/(1 + T)], c = W H/2, whose extremes are roots
!> of a quadratic in T: with p = (n0, n0 + n1, n1) and q = (d0, d0 + d1 + c, d1)
!>
!>     (p2 q1 - p1 q2) T^2 + 2 (p2 q0 - p0 q2) T + p1 q0 - p0 q1 = 0
!>
!> At such a height a point goes with either block: the hinge opens a course below or above it (docs/theory.md, section 2).
module dondolo_wall_strip_statics
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: floor_forces_type, strip_point_type, strip_type

   !> Points as near as this to the hinge, of the height of the strip, may go with either block
   real(wp), parameter :: same_height = 1.0e-9_wp

   !> What acts on a strip at a point
   type :: strip_point_type
      !> Place: from the centre line outwards, and above the base [m]
      real(wp) :: x = 0.0_wp, z = 0.0_wp
      !> Weight P, weight D of the mass that moves with the strip, and horizontal force F outwards [N/m]
      real(wp) :: weight = 0.0_wp, moving = 0.0_wp, push = 0.0_wp
   end type strip_point_type

   !> Forces at the hinges when the mechanism starts
   type :: floor_forces_type
      !> Horizontal forces of the floors on the strip, inwards, at its top and at its base [N/m]
      real(wp) :: top = 0.0_wp, base = 0.0_wp
      !> Horizontal and vertical force, both positive, of the hinges at base, middle and top [N/m]
      real(wp) :: across(3) = 0.0_wp, down(3) = 0.0_wp
      !> What they follow from: distance of the hinge in the middle from the top [m]; moments about it of what moves with the upper
      !> block, times 1/alpha_0, and of its weights, of thrusts and of ties on it [N m/m]; sums of what moves, of thrusts and of
      !> ties, on all and on the upper block [N/m]
      real(wp) :: length = 0.0_wp, moving_moment = 0.0_wp, weight_moment = 0.0_wp, thrust_moment = 0.0_wp, tie_moment = 0.0_wp, &
         & moving(2) = 0.0_wp, thrust(2) = 0.0_wp, tie(2) = 0.0_wp
   end type floor_forces_type

   !> A strip between two floors
   type :: strip_type
      !> Height H, and lever w of the hinges: half the thickness less their depth [m]
      real(wp) :: height = 0.0_wp, lever = 0.0_wp
      !> Its weight W and the load N on its top [N/m], and the eccentricity e of that load outwards [m]
      real(wp) :: weight = 0.0_wp, load = 0.0_wp, eccentricity = 0.0_wp
      !> What acts between base and top
      type(strip_point_type), allocatable :: points(:)
   contains
      !> Multiplier of a hinge, the lesser where points are at its height
      procedure :: multiplier
      !> Do points at the height of the hinge go with the lower block?
      procedure :: rides_below
      !> Which points are above a hinge
      procedure :: is_above
      !> The hinge at which the multiplier is least
      procedure :: find_weakest
      !> Forces at the hinges
      procedure :: floor_forces
      procedure, private :: find_sums
      procedure, private :: multiplier_of
   end type strip_type

contains

   !> Which points are above a hinge, those at its height by the block that they go with
   pure function is_above(self, r, below) result(above)
      class(strip_type), intent(in) :: self
      !> Height of the hinge / H
      real(wp), intent(in) :: r
      !> Do points at its height go with the lower block?
      logical, intent(in) :: below
      logical :: above(size(self%points))

      above = self%points%z > (r + merge(same_height, -same_height, below))*self%height
   end function is_above

   !> Numerator n0 + n1 T and denominator d0 + d1 T + c T/(1 + T) of the multiplier
   pure subroutine find_sums(self, above, n, d)
      class(strip_type), intent(in) :: self
      !> Which points are above the hinge
      logical, intent(in) :: above(:)
      !> n0, n1 [N m/m], and d0, d1 [N m/m]
      real(wp), intent(out) :: n(0:1), d(0:1)

      associate (w => self%lever, point => self%points)
         n(0) = 2.0_wp*w*(self%weight + self%load) + sum(point%weight*(w - point%x) - point%push*point%z, mask=.not. above) &
            & + sum(2.0_wp*w*point%weight, mask=above)
         n(1) = self%load*(w + self%eccentricity) + sum(point%weight*(point%x + w) - point%push*(self%height - point%z), &
            & mask=above)
         d(0) = sum(point%moving*point%z, mask=.not. above)
         d(1) = sum(point%moving*(self%height - point%z), mask=above)
      end associate
   end subroutine find_sums

   !> Multiplier of a hinge, which points are above it known
   pure real(wp) function multiplier_of(self, r, above) result(alpha)
      class(strip_type), intent(in) :: self
      !> Height of the hinge / H
      real(wp), intent(in) :: r
      !> Which points are above it
      logical, intent(in) :: above(:)

      real(wp) :: n(0:1), d(0:1), t

      call self%find_sums(above, n, d)
      t = r/(1.0_wp - r)
      alpha = (n(0) + n(1)*t)/(d(0) + d(1)*t + 0.5_wp*self%weight*self%height*r)
   end function multiplier_of

   !> Multiplier of a hinge, the lesser where points are at its height
   pure real(wp) function multiplier(self, r)
      class(strip_type), intent(in) :: self
      !> Height of the hinge / H
      real(wp), intent(in) :: r

      multiplier = self%multiplier_of(r, self%is_above(r, self%rides_below(r)))
   end function multiplier

   !> Do points at the height of the hinge go with the lower block? With that for which the multiplier is less
   pure logical function rides_below(self, r)
      class(strip_type), intent(in) :: self
      !> Height of the hinge / H
      real(wp), intent(in) :: r

      rides_below = self%multiplier_of(r, self%is_above(r, .true.)) <= self%multiplier_of(r, self%is_above(r, .false.))
   end function rides_below

   !> The hinge at which the multiplier is least
   subroutine find_weakest(self, range, hinge, alpha)
      class(strip_type), intent(in) :: self
      !> Lowest and highest hinge / H
      real(wp), intent(in) :: range(2)
      !> The hinge, height / H, the lowest of those that are equal, and its multiplier
      real(wp), intent(out) :: hinge, alpha

      real(wp) :: ends(size(self%points) + 2), n(0:1), d(0:1), roots(2), left, right
      integer :: i, k

      ends = [range(1), self%points%z/self%height, range(2)]
      hinge = range(1)
      alpha = self%multiplier(hinge)
      do i = 1, size(ends)
         if (ends(i) < range(1) .or. ends(i) > range(2)) cycle
         left = ends(i)
         call try(left)
         right = minval(ends, mask=ends > left)
         if (.not. left < range(2)) cycle
         ! Between them: the points are above or below throughout
         call self%find_sums(self%is_above(0.5_wp*(left + right), .true.), n, d)
         roots = extremes(n, d, 0.5_wp*self%weight*self%height)
         do k = 1, size(roots)
            associate (r => roots(k)/(1.0_wp + roots(k)))
               if (roots(k) > 0.0_wp .and. r > left .and. r < right) call try(r)
            end associate
         end do
      end do

   contains

      !> Take a hinge that is weaker
      subroutine try(r)
         real(wp), intent(in) :: r

         real(wp) :: found

         found = self%multiplier(r)
         if (.not. (found < alpha .or. (found <= alpha .and. r < hinge))) return
         hinge = r
         alpha = found
      end subroutine try

   end subroutine find_weakest

   !> Values of T at which the slope of (n0 + n1 T)/[d0 + d1 T + c T/(1 + T)] vanishes; not positive where there is none
   pure function extremes(n, d, c) result(t)
      !> Numerator, denominator, and c [N m/m]
      real(wp), intent(in) :: n(0:1), d(0:1), c
      real(wp) :: t(2)

      real(wp) :: a, b, e, root

      associate (p0 => n(0), p1 => n(0) + n(1), p2 => n(1), q0 => d(0), q1 => d(0) + d(1) + c, q2 => d(1))
         a = p2*q1 - p1*q2
         b = p2*q0 - p0*q2
         e = p1*q0 - p0*q1
      end associate
      t = -1.0_wp
      root = b**2 - a*e
      if (root < 0.0_wp) return
      ! Without the cancellation of nearly equal numbers
      root = -(b + sign(sqrt(root), b))
      if (abs(a) > 0.0_wp) t(1) = root/a
      if (abs(root) > 0.0_wp) t(2) = e/root
   end function extremes

   !> Forces of the floors and at the hinges when the mechanism starts; before, the three hinges are not open and nothing
   !> determines them. Moments of the upper block about the hinge in the middle give that at the top
   pure function floor_forces(self, r) result(forces)
      class(strip_type), intent(in) :: self
      !> Height of the hinge / H
      real(wp), intent(in) :: r
      type(floor_forces_type) :: forces

      logical :: above(size(self%points))
      real(wp) :: alpha, upper

      above = self%is_above(r, self%rides_below(r))
      alpha = self%multiplier_of(r, above)
      upper = (1.0_wp - r)*self%weight
      forces%length = (1.0_wp - r)*self%height
      associate (w => self%lever, point => self%points, n => self%load)
         associate (z => point%z - r*self%height, thrust => max(point%push, 0.0_wp), tie => max(-point%push, 0.0_wp))
            forces%moving_moment = 0.5_wp*upper*forces%length + sum(point%moving*z, mask=above)
            forces%weight_moment = upper*w + n*(w + self%eccentricity) + sum(point%weight*(point%x + w), mask=above)
            forces%thrust_moment = sum(thrust*z, mask=above)
            forces%tie_moment = sum(tie*z, mask=above)
            forces%thrust = [sum(thrust), sum(thrust, mask=above)]
            forces%tie = [sum(tie), sum(tie, mask=above)]
         end associate
         forces%moving = [self%weight + sum(point%moving), upper + sum(point%moving, mask=above)]
         forces%down = [n + self%weight + sum(point%weight), n + upper + sum(point%weight, mask=above), n]
      end associate
      forces%top = (alpha*forces%moving_moment + forces%weight_moment + forces%thrust_moment - forces%tie_moment)/forces%length
      forces%base = alpha*forces%moving(1) + forces%thrust(1) - forces%tie(1) - forces%top
      forces%across = [abs(forces%base), abs(forces%top - alpha*forces%moving(2) - forces%thrust(2) + forces%tie(2)), &
         & abs(forces%top)]
   end function floor_forces

end module dondolo_wall_strip_statics
