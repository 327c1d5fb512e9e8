!> A wall and its motion in 33 digits, for callers that work in double precision.
!>
!> This module and all that it uses are compiled a second time with DONDOLO_REAL128, under names that end in _quadruple
!> (meson.build beside it). Whatever crosses is a double: a wall is said again, property by property, and every number counts
!> for exactly what it is.
module dondolo_motion_quadruple_wall
   use, intrinsic :: iso_fortran_env, only : real64
   use dondolo_base_error, only : error_type
   use dondolo_base_kinds, only : wp
   use dondolo_motion_one_history, only : simulate_one
   use dondolo_motion_response, only : response_type
   use dondolo_motion_solver, only : solver_type
   use dondolo_record, only : record_type
   use dondolo_wall, only : new_wall, wall_input_type, wall_type
   implicit none
   private

   public :: quadruple_wall_type, quadruple_record_type, quadruple_response_type

   !> A wall in 33 digits
   type :: quadruple_wall_type
      private
      !> What was said of it
      type(wall_input_type) :: input
      !> What it is
      type(wall_type) :: wall
   contains
      !> Say a property
      generic :: say => say_word, say_number, say_list
      procedure, private :: say_word, say_number, say_list
      !> Make the wall of what was said
      procedure :: build
      !> Rotation at which the restoring moment vanishes
      procedure :: capacity
      !> Its motion
      procedure :: simulate
   end type quadruple_wall_type

   !> An accelerogram in 33 digits
   type :: quadruple_record_type
      private
      type(record_type) :: record
   contains
      !> Take one in double precision
      procedure :: take
   end type quadruple_record_type

   !> Result of a history, as response_type has it
   type :: quadruple_response_type
      !> Largest rotation / capacity
      real(real64) :: edp = 0.0_real64
      !> Did it reach the limit?
      logical :: collapsed = .false.
      !> Impacts before the end of the record
      integer :: impacts = 0
      !> Time of the largest rotation, or of reaching the limit [s]
      real(real64) :: time_of_peak = 0.0_real64
      !> Was it computed to its end?
      logical :: is_whole = .true.
   end type quadruple_response_type

contains

   !> Say a property that is a text
   subroutine say_word(self, name, word)
      class(quadruple_wall_type), intent(inout) :: self
      !> Its name and its value
      character(len=*), intent(in) :: name, word

      call self%input%set(name, word)
   end subroutine say_word

   !> Say a property that is a number
   subroutine say_number(self, name, number)
      class(quadruple_wall_type), intent(inout) :: self
      !> Its name
      character(len=*), intent(in) :: name
      !> Its value
      real(real64), intent(in) :: number

      call self%input%set(name, real(number, wp))
   end subroutine say_number

   !> Say a property that is a list of numbers
   subroutine say_list(self, name, list)
      class(quadruple_wall_type), intent(inout) :: self
      !> Its name
      character(len=*), intent(in) :: name
      !> Its values
      real(real64), intent(in) :: list(:)

      call self%input%set(name, real(list, wp))
   end subroutine say_list

   !> Make the wall of what was said
   subroutine build(self, gravity, message)
      class(quadruple_wall_type), intent(inout) :: self
      !> Gravity [m/s2]
      real(real64), intent(in) :: gravity
      !> What is wrong with it; not allocated: nothing
      character(len=:), allocatable, intent(out) :: message

      type(error_type), allocatable :: error

      call new_wall(self%wall, self%input, error, real(gravity, wp))
      if (allocated(error)) message = error%message
   end subroutine build

   !> Rotation at which the restoring moment vanishes [rad]
   pure real(real64) function capacity(self)
      class(quadruple_wall_type), intent(in) :: self

      capacity = real(self%wall%mechanism%capacity, real64)
   end function capacity

   !> Take an accelerogram
   subroutine take(self, name, dt, acceleration, vertical)
      class(quadruple_record_type), intent(out) :: self
      !> Its name
      character(len=*), intent(in) :: name
      !> Time between two samples [s]
      real(real64), intent(in) :: dt
      !> Ground acceleration [m/s2]
      real(real64), intent(in) :: acceleration(:)
      !> Vertical ground acceleration, if there is any [m/s2]
      real(real64), intent(in), optional :: vertical(:)

      self%record%name = name
      self%record%dt = real(dt, wp)
      self%record%acceleration = real(acceleration, wp)
      if (present(vertical)) self%record%vertical = real(vertical, wp)
   end subroutine take

   !> The motion under an accelerogram, at a relative tolerance and an absolute one of a hundredth of it
   subroutine simulate(self, record, scale, rtol, edp_limit, result)
      class(quadruple_wall_type), intent(in) :: self
      type(quadruple_record_type), intent(in) :: record
      !> Factor on it, negative to reverse its polarity
      real(real64), intent(in) :: scale
      !> Relative tolerance of a step
      real(real64), intent(in) :: rtol
      !> Rotation / capacity at which the wall has collapsed
      real(real64), intent(in) :: edp_limit
      type(quadruple_response_type), intent(out) :: result

      type(solver_type) :: solver
      type(response_type) :: response

      solver%rtol = real(rtol, wp)
      solver%atol = 0.01_wp*solver%rtol
      solver%edp_limit = real(edp_limit, wp)
      call simulate_one(self%wall%mechanism, record%record, real(scale, wp), solver, response)
      result = quadruple_response_type(real(response%edp, real64), response%collapsed, response%impacts, &
         & real(response%time_of_peak, real64), response%is_whole)
   end subroutine simulate

end module dondolo_motion_quadruple_wall
