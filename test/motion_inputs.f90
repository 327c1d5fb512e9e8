!> What the tests of the motion start from: walls, accelerograms and tight tolerances.
module motion_inputs
   use checks, only : check_ok
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_motion_solver, only : solver_type
   use dondolo_record, only : new_record, record_type
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   implicit none
   private

   public :: accelerogram, stillness, made, a_wall, tight, loose

contains

   !> A record from its samples
   function accelerogram(a, dt) result(record)
      real(wp), intent(in) :: a(:), dt
      type(record_type) :: record
      type(error_type), allocatable :: error

      call new_record(record, a, dt, 'test', error)
      call check_ok(error, 'record')
   end function accelerogram

   !> Still ground
   function stillness(duration) result(record)
      real(wp), intent(in) :: duration
      type(record_type) :: record

      record = accelerogram(spread(0.0_wp, 1, 101), duration/100.0_wp)
   end function stillness

   !> A wall by its names
   function made(mechanism, height, thickness, restitution) result(wall)
      character(len=*), intent(in) :: mechanism
      real(wp), intent(in) :: height, thickness
      real(wp), intent(in), optional :: restitution
      type(wall_type) :: wall
      type(wall_input_type) :: input
      type(error_type), allocatable :: error

      call input%set('mechanism', mechanism)
      if (mechanism == 'two_block') call input%set('hinge', 0.5_wp)
      call input%set('height', height)
      call input%set('thickness', thickness)
      if (present(restitution)) then
         call input%set('restitution_value', restitution)
      end if
      call new_wall(wall, input, error)
      call check_ok(error, 'wall')
   end function made

   !> One wall of each mechanism: one-sided, free-standing, two-block, two-block that carries a load
   function a_wall(number) result(wall)
      integer, intent(in) :: number
      type(wall_type) :: wall
      type(wall_input_type) :: input
      type(error_type), allocatable :: error

      select case (number)
      case (1)
         wall = made('one_sided', 3.0_wp, 0.25_wp)
      case (2)
         wall = made('free_standing', 2.0_wp, 0.5_wp)
      case (3)
         wall = made('two_block', 3.0_wp, 0.25_wp)
      case default
         call input%set('mechanism', 'two_block')
         call input%set('height', 3.0_wp)
         call input%set('thickness', 0.3_wp)
         call input%set('hinge', 0.65_wp)
         call input%set('overburden', merge(8.0e4_wp, 1.0e4_wp, number == 5))
         call input%set('overburden_inertia', merge(1.0_wp, 0.0_wp, number == 5))
         call input%set('eccentricity', 0.05_wp)
         call new_wall(wall, input, error)
         call check_ok(error, 'wall that carries a load')
      end select
   end function a_wall

   !> Tight tolerances
   function tight(edp_limit) result(solver)
      real(wp), intent(in) :: edp_limit
      type(solver_type) :: solver

      solver%rtol = 1.0e-12_wp
      solver%atol = 1.0e-14_wp
      solver%edp_limit = edp_limit
   end function tight

   !> Tolerances that never shorten a step: the samples alone set it
   function loose(edp_limit) result(solver)
      real(wp), intent(in) :: edp_limit
      type(solver_type) :: solver

      solver%rtol = 1.0e6_wp
      solver%atol = 1.0e6_wp
      solver%edp_limit = edp_limit
   end function loose

end module motion_inputs
