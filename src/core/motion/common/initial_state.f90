!> Rotation and velocity at the start of a history. A study begins at rest; tests of free rocking and restarts do not.
module dondolo_motion_initial_state
   use dondolo_base_error, only : error_type, not_a_number, not_together, out_of_range, raise_input
   use dondolo_base_kinds, only : wp
   use dondolo_base_text, only : brief, to_text
   use dondolo_motion_solver, only : solver_type
   use dondolo_wall_mechanism, only : mechanism_type
   implicit none
   private

   public :: initial_state_type, check_initial_state

   !> Signed, as a time history has them: positive towards side 1
   type :: initial_state_type
      !> Rotation [rad]
      real(wp) :: rotation = 0.0_wp
      !> Angular velocity [rad/s]
      real(wp) :: velocity = 0.0_wp
   contains
      !> Whether the wall is not at rest
      procedure :: moves
      !> Side to which it leans, or towards which it leaves its rest
      procedure :: side
      !> The same state in proportion
      procedure :: times
   end type initial_state_type

contains

   !> Whether the wall is not at rest
   elemental logical function moves(self)
      class(initial_state_type), intent(in) :: self

      moves = abs(self%rotation) > 0.0_wp .or. abs(self%velocity) > 0.0_wp
   end function moves

   !> Side to which the wall leans, +1 or -1; without a rotation that towards which it moves
   elemental real(wp) function side(self)
      class(initial_state_type), intent(in) :: self

      side = sign(1.0_wp, merge(self%rotation, self%velocity + 0.0_wp, abs(self%rotation) > 0.0_wp))
   end function side

   !> The same state in proportion
   elemental function times(self, factor) result(other)
      class(initial_state_type), intent(in) :: self
      real(wp), intent(in) :: factor
      !> Rotation and velocity times the factor
      type(initial_state_type) :: other

      other = initial_state_type(factor*self%rotation, factor*self%velocity)
   end function times

   !> Check that a wall can be in a state
   subroutine check_initial_state(initial, mechanism, solver, error)
      type(initial_state_type), intent(in) :: initial
      class(mechanism_type), intent(in) :: mechanism
      !> Engine, and rotation that counts as collapse
      type(solver_type), intent(in) :: solver
      !> `variable = value: what is allowed`
      type(error_type), allocatable, intent(out) :: error

      real(wp) :: limit

      if (.not. abs(initial%rotation) <= huge(1.0_wp)) then
         call raise_input(error, 'initial_rotation = '//to_text(initial%rotation)//': must be a number', &
            & not_a_number, 'initial_rotation')
      else if (.not. abs(initial%velocity) <= huge(1.0_wp)) then
         call raise_input(error, 'initial_velocity = '//to_text(initial%velocity)//': must be a number', &
            & not_a_number, 'initial_velocity')
      end if
      if (allocated(error) .or. .not. initial%moves()) return
      limit = min(solver%edp_limit*mechanism%capacity, mechanism%unseating)
      if (.not. mechanism%two_sided .and. initial%rotation < 0.0_wp) then
         call raise_input(error, 'initial_rotation = '//to_text(initial%rotation)// &
            & ': must not be negative, the wall is one-sided', out_of_range, 'initial_rotation')
      else if (.not. abs(initial%rotation) < limit) then
         call raise_input(error, 'initial_rotation = '//to_text(initial%rotation)//': must lie within '//brief(limit)// &
            & ' rad, which counts as collapse', out_of_range, 'initial_rotation')
      else if (.not. mechanism%two_sided .and. initial%side() < 0.0_wp) then
         call raise_input(error, 'initial_velocity = '//to_text(initial%velocity)// &
            & ': must not be negative without a rotation, the wall is one-sided', out_of_range, 'initial_velocity')
      else if (solver%engine == 'lanes') then
         call raise_input(error, 'engine = ''lanes'': begins every history at rest; must be ''auto'' or ''rk45'' '// &
            & 'with initial_rotation or initial_velocity', not_together, 'engine')
      end if
   end subroutine check_initial_state

end module dondolo_motion_initial_state
