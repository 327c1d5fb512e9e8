!> What the histories of stripes do to the ties of a wall: how many make each yield and break, and how far they stretch it.
module dondolo_fragility_tie_tallies
   use dondolo_base_kinds, only : wp
   use dondolo_motion_response, only : response_type
   use dondolo_wall_mechanism, only : mechanism_type
   use dondolo_wall_tie_statics, only : ties_after
   implicit none
   private

   public :: tie_tally_type, tally_ties

   !> What the histories of one stripe do to one tie
   type :: tie_tally_type
      !> Histories that make it yield, and that break it
      integer :: yielded = 0, broken = 0
      !> Plastic elongation: mean of the histories, and the largest [m]
      real(wp) :: mean = 0.0_wp, largest = 0.0_wp
   end type tie_tally_type

contains

   !> Tallies of all ties in all stripes
   pure subroutine tally_ties(mechanism, response, ran, tallies)
      class(mechanism_type), intent(in) :: mechanism
      !> Histories (histories, levels)
      type(response_type), intent(in) :: response(:, :)
      !> Which of them were run
      logical, intent(in) :: ran(:, :)
      !> Tallies (ties, levels)
      type(tie_tally_type), allocatable, intent(out) :: tallies(:, :)

      real(wp), dimension(mechanism%ties) :: elongation, total
      logical :: broken(mechanism%ties)
      integer :: i, j

      allocate (tallies(mechanism%ties, size(response, 2)))
      if (mechanism%ties == 0) return
      do j = 1, size(response, 2)
         total = 0.0_wp
         do i = 1, size(response, 1)
            if (.not. ran(i, j)) cycle
            call ties_after(mechanism, response(i, j)%edp, elongation, broken)
            associate (tally => tallies(:, j))
               tally%yielded = tally%yielded + merge(1, 0, elongation > 0.0_wp)
               tally%broken = tally%broken + merge(1, 0, broken)
               tally%largest = max(tally%largest, elongation)
            end associate
            total = total + elongation
         end do
         tallies(:, j)%mean = total*(1.0_wp/real(max(1, count(ran(:, j))), wp))
      end do
   end subroutine tally_ties

end module dondolo_fragility_tie_tallies
