!> Two functions of time at equal steps of different length, linear in between, on one grid that has the samples of both.
!>
!> Where the steps are to each other as two small whole numbers p and q there is a step that goes p times into one and q times into
!> the other. Both functions are linear between its samples too, so that nothing of either is lost or added.
module dondolo_record_common_steps
   use dondolo_base_kinds, only : wp
   implicit none
   private

   public :: compute_parts, refine, same_step, most_parts

   !> Steps that differ by this part are the same: files round them
   real(wp), parameter :: same_step = 1.0e-9_wp

   !> Most parts that a step is cut into
   integer, parameter :: most_parts = 50

contains

   !> Fewest parts of two steps that are equally long
   pure subroutine compute_parts(dt, other, parts, other_parts)
      !> The steps [s]
      real(wp), intent(in) :: dt, other
      !> Parts of each; 0: none of up to most_parts are
      integer, intent(out) :: parts, other_parts

      real(wp) :: wanted

      do parts = 1, most_parts
         wanted = real(parts, wp)*other/dt
         ! A whole number beyond the most need not be one.
         if (wanted > real(most_parts, wp) + 0.5_wp) exit
         other_parts = nint(wanted)
         if (abs(wanted - real(other_parts, wp)) <= same_step*wanted) return
      end do
      parts = 0
      other_parts = 0
   end subroutine compute_parts

   !> Put the samples of a function on a finer grid
   pure subroutine refine(samples, parts, finer, ok)
      !> Samples, two at least
      real(wp), intent(in) :: samples(:)
      !> Parts of a step
      integer, intent(in) :: parts
      !> Samples at these parts; those that were given stay as they are
      real(wp), allocatable, intent(out) :: finer(:)
      !> Is there memory for them?
      logical, intent(out) :: ok

      integer :: i, k, stat

      allocate (finer((size(samples) - 1)*parts + 1), stat=stat)
      ok = stat == 0
      if (.not. ok) return
      do i = 1, size(samples) - 1
         do k = 0, parts - 1
            finer((i - 1)*parts + k + 1) = samples(i) + real(k, wp)/real(parts, wp)*(samples(i + 1) - samples(i))
         end do
      end do
      finer(size(finer)) = samples(size(samples))
   end subroutine refine

end module dondolo_record_common_steps
