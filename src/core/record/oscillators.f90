!> Linear oscillators side by side, each under a ground of its own: u'' + damper u' + spring u = -a, exactly where a is linear
!> between samples (Nigam and Jennings 1969).
!>
!> Time is counted in steps h, so that the displacement u is that over h**2, in the units of a. A state needs the one before it, for
!> which a processor would wait; those of others it computes meanwhile, in vectors. A block of samples of all oscillators stays in
!> the fastest cache. What an oscillator does depends neither on its place nor on those beside it.
module dondolo_record_oscillators
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: oscillators_type, swing, swing_driven
   public :: block, side_by_side

   !> Oscillators side by side, of one or of several records, and steps of a block
   integer, parameter :: side_by_side = 8, block = 64

   !> What they become in a step: displacement (1) and velocity (2)
   type :: oscillators_type
      !> By displacement and velocity before it
      real(wp), dimension(side_by_side, 2) :: by_u = 0.0_wp, by_w = 0.0_wp
      !> By the acceleration of the ground at its start, and at its end
      real(wp), dimension(side_by_side, 2) :: by_start = 0.0_wp, by_end = 0.0_wp
   end type oscillators_type

contains

   !> Let them swing under the ground over a block
   pure subroutine swing(oscillators, steps, ground, u, w)
      type(oscillators_type), intent(in) :: oscillators
      !> Steps of the block
      integer, intent(in) :: steps
      !> Its acceleration, from the start of the first step
      real(wp), intent(in) :: ground(side_by_side, 0:block)
      !> Displacements and velocities, from the start of the first step; those after it are set
      real(wp), intent(inout) :: u(side_by_side, 0:block), w(side_by_side, 0:block)

      integer :: i, k

      associate (by_u => oscillators%by_u, by_w => oscillators%by_w, start => oscillators%by_start, finish => oscillators%by_end)
         do i = 1, steps
            !$omp simd
            do k = 1, side_by_side
               u(k, i) = (start(k, 1)*ground(k, i - 1) + finish(k, 1)*ground(k, i)) &
                  & + (by_u(k, 1)*u(k, i - 1) + by_w(k, 1)*w(k, i - 1))
               w(k, i) = (start(k, 2)*ground(k, i - 1) + finish(k, 2)*ground(k, i)) &
                  & + (by_u(k, 2)*u(k, i - 1) + by_w(k, 2)*w(k, i - 1))
            end do
         end do
      end associate
   end subroutine swing

   !> The same where others push them too
   pure subroutine swing_driven(oscillators, steps, ground, u, w)
      type(oscillators_type), intent(in) :: oscillators
      !> As of `swing`
      integer, intent(in) :: steps
      real(wp), intent(in) :: ground(side_by_side, 0:block)
      !> As of `swing`; in: behind the start of the first step, what the others make of each
      real(wp), intent(inout) :: u(side_by_side, 0:block), w(side_by_side, 0:block)

      integer :: i, k

      associate (by_u => oscillators%by_u, by_w => oscillators%by_w, start => oscillators%by_start, finish => oscillators%by_end)
         do i = 1, steps
            !$omp simd
            do k = 1, side_by_side
               u(k, i) = (u(k, i) + (start(k, 1)*ground(k, i - 1) + finish(k, 1)*ground(k, i))) &
                  & + (by_u(k, 1)*u(k, i - 1) + by_w(k, 1)*w(k, i - 1))
               w(k, i) = (w(k, i) + (start(k, 2)*ground(k, i - 1) + finish(k, 2)*ground(k, i))) &
                  & + (by_u(k, 2)*u(k, i - 1) + by_w(k, 2)*w(k, i - 1))
            end do
         end do
      end associate
   end subroutine swing_driven

end module dondolo_record_oscillators
