!> The impact of a chain that closes: which velocities it leaves.
!>
!> At rest all joints are closed. Of velocities v- of the parts between all possible joints the impact leaves those nearest in the
!> metric of the masses and close no edge of a joint (Moreau 1988, Unilateral contact and dry friction in finite freedom
!> dynamics):
!>
!>     v+ = v- + M^-1 B' lambda      lambda >= 0 at edges, of both signs along joints      e = sqrt(T+/T-)
!>
!> With one part this is the impact of Housner (1963). Where v+ is the velocity v_2 of one mechanism, it is the projection
!> <v_1, v_2>/<v_2, v_2> on it.
module dondolo_wall_chain_impact
   use dondolo_base_kinds, only : wp
   use dondolo_wall_chain_equations, only : nonnegative_least_squares
   use dondolo_wall_chain_part, only : chain_mass_type
   implicit none
   private

   public :: attached_type, contact_type, cone_ratio, projection, velocity_of

   !> A joint between two parts that can open at both of its ends
   type :: contact_type
      !> The part that moves away along `normal`, and the other; 0: the ground
      integer :: part = 0, other = 0
      !> Its two ends [m]
      real(wp) :: ends(2, 2) = 0.0_wp
      !> Direction in which the part opens
      real(wp) :: normal(2) = 0.0_wp
      !> Can it neither open nor close? It is then held along its normal alone
      logical :: is_guide = .false.
   end type contact_type

   !> Masses of a load at a point of a part
   type :: attached_type
      integer :: part = 0
      !> [m]
      real(wp) :: at(2) = 0.0_wp
      !> Pushed and lifted mass [kg]
      real(wp) :: mass(2) = 0.0_wp
   end type attached_type

contains

   !> Velocity (x, y, phi) of a point of a body that moves
   pure function velocity_of(at, centre, rate) result(v)
      !> The point and the centroid of the body [m]
      real(wp), intent(in) :: at(2), centre(2)
      !> Velocity (x, y, phi) of the body
      real(wp), intent(in) :: rate(3)
      real(wp) :: v(3)

      v = [rate(1) + rate(3)*(at(2) - centre(2)), rate(2) - rate(3)*(at(1) - centre(1)), rate(3)]
   end function velocity_of

   !> Restitution of the impact on the cone of velocities that close no joint
   real(wp) function cone_ratio(parts, contacts, attached, before) result(e)
      type(chain_mass_type), intent(in) :: parts(:)
      type(contact_type), intent(in) :: contacts(:)
      type(attached_type), intent(in) :: attached(:)
      !> Velocities before the impact (x, y, phi; part)
      real(wp), intent(in) :: before(:, :)

      real(wp) :: mass(3*size(parts), 3*size(parts)), rows(3*size(parts), 4*size(contacts)), v(3*size(parts)), root
      real(wp), allocatable :: x(:)
      integer :: i, j, k, n

      n = size(v)
      v = [before]
      mass = mass_matrix(parts, attached)
      ! Cholesky: M = R' R, in the upper triangle
      do j = 1, n
         do i = 1, j - 1
            mass(i, j) = (mass(i, j) - dot_product(mass(:i - 1, i), mass(:i - 1, j)))/mass(i, i)
         end do
         mass(j, j) = sqrt(mass(j, j) - sum(mass(:j - 1, j)**2))
         mass(j + 1:, j) = 0.0_wp
      end do
      rows = 0.0_wp
      k = 0
      do i = 1, size(contacts)
         associate (contact => contacts(i), along => [-contacts(i)%normal(2), contacts(i)%normal(1)])
            if (contact%is_guide) then
               call add(contact%ends(:, 1), contact%normal)
               call add(contact%ends(:, 1), -contact%normal)
               cycle
            end if
            call add(contact%ends(:, 1), contact%normal)
            call add(contact%ends(:, 2), contact%normal)
            call add(contact%ends(:, 1), along)
            call add(contact%ends(:, 1), -along)
         end associate
      end do
      v = matmul(mass, v)
      root = norm2(v)
      allocate (x(k))
      do j = 1, k
         ! R'^-1 B'
         do i = 1, n
            rows(i, j) = (rows(i, j) - dot_product(mass(:i - 1, i), rows(:i - 1, j)))/mass(i, i)
         end do
      end do
      call nonnegative_least_squares(-rows(:, :k), v, x)
      e = norm2(v + matmul(rows(:, :k), x))/root

   contains

      !> Add the velocity at a point in a direction
      subroutine add(at, along)
         real(wp), intent(in) :: at(2), along(2)

         k = k + 1
         associate (part => contacts(i)%part, other => contacts(i)%other)
            if (part > 0) rows(3*part - 2:3*part, k) = row(part, at, along)
            if (other > 0) rows(3*other - 2:3*other, k) = -row(other, at, along)
         end associate
      end subroutine add

      !> Velocity of a point in a direction for unit velocities of a part
      pure function row(part, at, along)
         integer, intent(in) :: part
         real(wp), intent(in) :: at(2), along(2)
         real(wp) :: row(3)

         associate (r => at - parts(part)%at)
            row = [along, along(1)*r(2) - along(2)*r(1)]
         end associate
      end function row

   end function cone_ratio

   !> Masses of parts and of what is attached to them
   pure function mass_matrix(parts, attached) result(mass)
      type(chain_mass_type), intent(in) :: parts(:)
      type(attached_type), intent(in) :: attached(:)
      real(wp) :: mass(3*size(parts), 3*size(parts))

      real(wp) :: row(3)
      integer :: i, j, k

      mass = 0.0_wp
      do i = 1, size(parts)
         k = 3*i
         mass(k - 2, k - 2) = parts(i)%mass
         mass(k - 1, k - 1) = parts(i)%mass
         mass(k, k) = parts(i)%inertia
      end do
      do i = 1, size(attached)
         k = 3*attached(i)%part
         associate (r => attached(i)%at - parts(attached(i)%part)%at)
            do j = 1, 2
               row = [real(2 - j, wp), real(j - 1, wp), merge(r(2), -r(1), j == 1)]
               mass(k - 2:k, k - 2:k) = mass(k - 2:k, k - 2:k) &
                  & + attached(i)%mass(j)*spread(row, 1, 3)*spread(row, 2, 3)
            end do
         end associate
      end do
   end function mass_matrix

   !> Restitution of an impact that leaves the mechanism of other velocities: <v_1, v_2>/<v_2, v_2>
   pure real(wp) function projection(parts, before, after)
      type(chain_mass_type), intent(in) :: parts(:)
      !> Velocities (x, y, phi; part) before, and those of the mechanism that opens
      real(wp), intent(in) :: before(:, :), after(:, :)

      real(wp) :: weights(3, size(parts))

      weights(1, :) = parts%mass
      weights(2, :) = parts%mass
      weights(3, :) = parts%inertia
      projection = sum(weights*before*after)/sum(weights*after**2)
   end function projection

end module dondolo_wall_chain_impact
