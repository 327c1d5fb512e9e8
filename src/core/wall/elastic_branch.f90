!> Where the joints of a wall open that bends first, and what a passage of its rest position loses (docs/theory.md, section 7).
!>
!> The closed branch of stiffness k = J(q_y) w^2 meets the restoring moment of the rigid blocks at q_y, the smallest root of
!>
!>     J(q) w^2 q = G(q) - Q(q)        0 < q < q_c        w = 2 pi/T_1
!>
!> Viscous damping takes 4 xi v_y/v of the speed v of a fast passage. Measured speed ratios contain that, so it is given back at the
!> speed w_h of a fall from q_c/2: e_0 = min(1, e + 4 xi w q_y/w_h), w_h^2 = 2 [V(q_c/2) - V(q_y)]/J(q_y).
module dondolo_wall_elastic_branch
   use dondolo_base_bracket, only : bracket_type
   use dondolo_base_error, only : error_type, out_of_range, raise_input
   use dondolo_base_kinds, only : pi, wp
   use dondolo_base_text, only : brief, rounded, to_text
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: add_elastic_joint, usual_damping

   !> Damping ratio of the closed branch, if it is not given
   real(wp), parameter :: usual_damping = 0.05_wp

   !> Largest q_y/q_c: a wall that opens later bends rather than rocks
   real(wp), parameter :: largest_opening = 0.25_wp

   !> Places at which the two branches are compared
   integer, parameter :: places = 200

contains

   !> Give a wall joints that bend before they open
   subroutine add_elastic_joint(mechanism, period, damping, error)
      !> A two-sided wall, its restitution known
      class(mechanism_type), intent(inout) :: mechanism
      !> Period T_1 of the closed wall [s]
      real(wp), intent(in) :: period
      !> Its damping ratio
      real(wp), intent(in) :: damping
      !> It opens too late, or closes again beyond the rotation at which it opens
      type(error_type), allocatable, intent(out) :: error

      type(bracket_type) :: bracket
      real(wp) :: j, c, g, l, load, fall
      integer :: i

      associate (joint => mechanism%joint, capacity => mechanism%capacity)
         joint%period = period
         joint%damping = damping
         joint%frequency = 2.0_wp*pi/period
         do i = 1, places
            if (excess(capacity*real(i, wp)/real(places, wp)) > 0.0_wp) exit
         end do
         bracket = bracket_type(capacity*real(i - 1, wp)/real(places, wp), capacity*real(min(i, places), wp)/real(places, wp))
         do while (bracket%is_divisible())
            call bracket%halve(.not. excess(bracket%middle()) > 0.0_wp)
         end do
         joint%opening = bracket%middle()
         if (.not. joint%opening <= largest_opening*capacity) then
            call raise_input(error, 'elastic_period = '//to_text(period)//': this wall does not rock, it bends: its joints '// &
               & 'would open at '//rounded(joint%opening/capacity)//' of its capacity; must be so short that they open at '// &
               & brief(largest_opening)//' at most', out_of_range, 'elastic_period')
            return
         end if
         call mechanism%terms(joint%opening, j, c, g, l, load)
         joint%inertia = j
         joint%lever = l/j
         joint%stiffness = j*joint%frequency**2
         joint%speed = joint%frequency*joint%opening
         do i = 1, places
            associate (q => joint%opening + (capacity - joint%opening)*real(i, wp)/real(places, wp))
               if (joint%stiffness*q < mechanism%moment(q)) then
                  call raise_input(error, 'elastic_period = '//to_text(period)//': the joints would close again at '// &
                     & rounded(q)//' rad; must be shorter', out_of_range, 'elastic_period')
                  return
               end if
            end associate
         end do
         fall = sqrt(2.0_wp*(mechanism%potential(0.5_wp*capacity) - mechanism%potential(joint%opening))/joint%inertia)
         joint%restitution = min(1.0_wp, mechanism%restitution + 4.0_wp*damping*joint%speed/fall)
         joint%exists = .true.
      end associate

   contains

      !> Moment of the closed branch less that of the rigid blocks [N m]
      real(wp) function excess(q)
         !> Rotation [rad]
         real(wp), intent(in) :: q

         call mechanism%terms(q, j, c, g, l, load)
         excess = j*mechanism%joint%frequency**2*q - (g - load)
      end function excess

   end subroutine add_elastic_joint

end module dondolo_wall_elastic_branch
